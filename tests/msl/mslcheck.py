#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""mslcheck.py FILE.metal | mslcheck.py --serve
Checks Metal Shading Language source with stock clang (draw.py runs it on the CPU). Debian 12: clang python3-clang-14.
 1. check pass: C++ for OpenCL with real address spaces     2. C++17 without address spaces (catches what 1 has to waive; the one that runs)
 3. lint on clang's AST: attributes and their targets, indices, address-space words, stage structs, what Metal bans
 --serve: answers requests of compile/compiler_process.c, whose form is in compile/answer.mjs"""
import os, re, sys, tempfile
import clang.cindex as ci
from clang.cindex import CursorKind as K, TypeKind as T

HERE = os.path.dirname(os.path.abspath(__file__))
FLAGS = ['-isystem', HERE + '/include', '-Xclang', '-cl-single-precision-constant', '-Wno-macro-redefined', '-Werror=return-type', '-Werror=uninitialized', '-Werror=sometimes-uninitialized']
CHECK = ['-x', 'clcpp', '-cl-std=clc++2021', '-cl-no-stdinc'] + FLAGS + ['-Xclang', '-cl-ext=-__opencl_c_device_enqueue,-__opencl_c_program_scope_global_variables,-cl_khr_fp64,-__opencl_c_fp64']
RUN = ['-x', 'c++', '-std=c++17', '-Werror=pre-c++17-compat', '-nostdinc', '-nostdinc++', '-fno-lax-vector-conversions', '-Xclang', '-fnative-half-type', '-Xclang', '-fallow-half-arguments-and-returns', '-fno-exceptions', '-fno-rtti'] + FLAGS + ['-DMSL_RUN']
STD_ATTRS = {'maybe_unused', 'nodiscard', 'fallthrough', 'likely', 'unlikely', 'noreturn', 'deprecated'}
INTERP = {'flat', 'center_perspective', 'center_no_perspective', 'centroid_perspective', 'centroid_no_perspective', 'sample_perspective', 'sample_no_perspective'}
# where an attribute may stand: struct fields by the role of the struct, parameters by stage, functions
FIELDS = {'vertex-in': {'attribute'},
          'vertex-out': {'position', 'user', 'point_size', 'clip_distance', 'invariant', 'render_target_array_index', 'viewport_array_index', 'shared'} | INTERP,
          'fragment-in': {'position', 'user', 'color', 'point_coord', 'front_facing', 'render_target_array_index', 'viewport_array_index', 'sample_id', 'primitive_id', 'barycentric_coord', 'clip_distance', 'shared'} | INTERP,
          'fragment-out': {'color', 'depth', 'stencil', 'sample_mask', 'index', 'raster_order_group'}}
RESOURCES = {'buffer', 'texture', 'sampler'}
PARAMS = {'vertex': RESOURCES | {'stage_in', 'vertex_id', 'instance_id', 'base_vertex', 'base_instance', 'amplification_id'},
          'fragment': RESOURCES | {'stage_in', 'position', 'front_facing', 'point_coord', 'sample_id', 'sample_mask', 'primitive_id', 'color', 'barycentric_coord', 'viewport_array_index', 'render_target_array_index'},
          'kernel': RESOURCES | {'threadgroup', 'thread_position_in_grid', 'thread_position_in_threadgroup', 'thread_index_in_threadgroup', 'threadgroup_position_in_grid', 'threads_per_grid', 'threads_per_threadgroup', 'threadgroups_per_grid'}}
FUNCS = {'vertex', 'fragment', 'kernel', 'early_fragment_tests', 'visible', 'stitchable', 'max_total_threads_per_threadgroup', 'host_name', 'patch'}
TYPES = {'position': 'float4', 'front_facing': 'bool', 'vertex_id': 'uint|ushort', 'instance_id': 'uint|ushort', 'sample_id': 'uint', 'point_coord': 'float2',
         'point_size': 'float', 'depth': 'float', 'sample_mask': 'uint', 'primitive_id': 'uint',
         'thread_position_in_grid': 'u(int|short)[23]?', 'thread_position_in_threadgroup': 'u(int|short)[23]?'}
LIMITS = {'buffer': 31, 'texture': 128, 'sampler': 16, 'attribute': 31, 'color': 8, 'threadgroup': 31}
BANNED = {K.LAMBDA_EXPR: 'lambda', K.GOTO_STMT: 'goto', K.CXX_NEW_EXPR: 'new', K.CXX_DELETE_EXPR: 'delete', K.CXX_TRY_STMT: 'try', K.CXX_THROW_EXPR: 'throw', K.CXX_DYNAMIC_CAST_EXPR: 'dynamic_cast'}

errors = []
def err(line, msg):
    if (line, msg) not in errors: errors.append((line, msg))

def annotate(src):
    """[[a(x), b]] -> annotate attributes, so that they reach the AST (lines unchanged)"""
    def one(m):
        parts = [re.sub(r'\s+', '', p) for p in re.findall(r'\w+(?:\s*\([^()]*\))?', m.group(1))]
        if all(p.split('(')[0] in STD_ATTRS for p in parts): return m.group(0)
        return '[[%s]]' % ', '.join('clang::annotate("msl:%s")' % p for p in parts) + '\n' * m.group(0).count('\n')
    src = re.sub(r'//[^\n]*|/\*.*?\*/', lambda m: '\n' * m.group(0).count('\n') or ' ', src, flags=re.S)
    src = re.sub(r'(?<![\w.])(\d+\.?\d*(?:[eE][+-]?\d+)?)[hH]\b', r'half(\1)', src)          # 1.0h
    return re.sub(r'\[\[([^\[\]]*)\]\]', one, src)

def attrs(c): return [re.match(r'msl:(\w+)(?:\((.*)\))?$', k.spelling).groups() for k in c.get_children() if k.kind == K.ANNOTATE_ATTR and k.spelling.startswith('msl:')]
def short(t): return re.sub(r'__(private|generic|constant|global|local)\s+|\bconst\s+|\bmetal::', '', t.spelling)
def is_vec(t): return t.get_canonical().kind in (T.EXTVECTOR, T.VECTOR)
def compares(e):                              # is this expression a comparison of vectors? (an int vector for clang, a bool vector in Metal)
    while e.kind in (K.UNEXPOSED_EXPR, K.PAREN_EXPR) and len(list(e.get_children())) == 1: e = next(e.get_children())
    c = list(e.get_children())
    return e.kind == K.BINARY_OPERATOR and is_vec(e.type) and e.type.get_canonical().element_type.kind == T.INT and any(is_vec(x.type) and x.type.get_canonical().element_type.kind != T.INT for x in c)

units = {}
PREAMBLE = 0x4 | 0x100                        # a precompiled preamble from the first parse on: the headers, which all shaders share
def parse(path, args):
    key = path, args[1]
    if key in units: units[key].reparse()
    else: units[key] = ci.Index.create().parse(path, args + ['-ferror-limit=0'], options=PREAMBLE)
    return units[key]

def in_kernel(lines, line):
    """whether a line is in the body of a kernel; functions begin in the first column"""
    heads = [text for text in lines[:line] if re.match(r'\w', text)]
    return bool(heads) and heads[-1].startswith('kernel ')

def diagnostics(path, args, waive):
    tu = parse(path, args)
    text = open(path).read().split('\n')
    for d in tu.diagnostics:
        if d.severity < ci.Diagnostic.Error: continue
        notes = ' '.join(n.spelling for n in d.children)
        # clang's C++ for OpenCL cannot copy a user struct out of constant or device space, and *this is __generic in a method; Metal can.
        # Kernels are no kernels of OpenCL here, but may have threadgroup variables.
        # (a __generic value comes from *this or from an unqualified pointer or reference, which lint() reports)
        if waive and ((d.spelling.startswith('non-kernel function variable cannot be declared in local') and in_kernel(text, d.location.line)) or
                      (d.spelling.startswith('program scope variable must') and re.match(r'\s*(static )?constexpr sampler', text[d.location.line - 1])) or
                      re.search(r"binding reference of type '__private .* to value of type '__generic", d.spelling) or
                      ('no matching' in d.spelling and re.search(r"cannot (bind reference|pass pointer) (in|to) address space '__generic'", notes)) or
                      re.match(r"no viable conversion from '(?:const )?__(constant|global) \w+' to", d.spelling) or
                      ('no matching constructor' in d.spelling and re.search(r'implicit copy constructor\) not viable: cannot bind reference in address space .__(constant|global)', notes))): continue
        where = d.location.line if d.location.file and d.location.file.name == path else next((n.location.line for n in d.children if n.location.file and n.location.file.name == path), 0)
        err(where, d.spelling)
    return tu

def check_struct(decl, role):
    seen = {}
    for f in decl.type.get_canonical().get_fields():
        line, at = f.location.line, attrs(f)
        for name, arg in at:
            if name not in FIELDS[role]: err(line, "attribute '%s' cannot be applied to a field of a %s struct" % (name, role))
            if name in TYPES and not re.fullmatch(TYPES[name], short(f.type)): err(line, "type '%s' is not valid for attribute '%s'" % (short(f.type), name))
            if name in ('attribute', 'color', 'user') and seen.setdefault((name, arg, dict(at).get('index')), f) != f: err(line, "'%s(%s)' is used twice" % (name, arg))
        names = {a for a, _ in at}
        if role == 'vertex-in' and 'attribute' not in names: err(line, "vertex input field '%s' has no [[attribute(n)]]" % f.spelling)
        if role != 'vertex-in' and (f.type.get_canonical().kind in (T.BOOL, T.RECORD, T.POINTER, T.LVALUEREFERENCE) and 'front_facing' not in names): err(line, "field '%s' of type '%s' cannot be passed between stages" % (f.spelling, short(f.type)))
    if role == 'vertex-out' and not any(a == 'position' for f in decl.type.get_canonical().get_fields() for a, _ in attrs(f)): err(decl.location.line, 'vertex output struct has no [[position]]')

def check_entry(f, stage):
    used, stage_in = {}, 0
    for p in f.get_arguments():
        at, line, t = attrs(p), p.location.line, p.type
        if not at: err(line, "parameter '%s' of %s function has no attribute" % (p.spelling, stage))
        for name, arg in at:
            if name not in PARAMS[stage]: err(line, "attribute '%s' cannot be applied to a parameter of a %s function" % (name, stage)); continue
            if name in TYPES and not re.fullmatch(TYPES[name], short(t)): err(line, "type '%s' is not valid for attribute '%s'" % (short(t), name))
            pointee = t.get_pointee().spelling if t.kind in (T.POINTER, T.LVALUEREFERENCE) else ''
            ok = {'buffer': '__constant' in pointee or '__global' in pointee, 'texture': bool(re.match('(texture|depth)', short(t.get_canonical()))),
                  'sampler': short(t.get_canonical()) == 'sampler', 'stage_in': t.get_canonical().kind == T.RECORD, 'threadgroup': '__local' in pointee}.get(name, True)
            if not ok: err(line, "attribute '%s' cannot be applied to type '%s'" % (name, short(t)))
            if name in LIMITS:
                if not re.fullmatch(r'\d+', arg or '') or int(arg) >= LIMITS[name]: err(line, "'%s' index must be 0..%d" % (name, LIMITS[name] - 1))
                if used.setdefault((name, arg), p.spelling) != p.spelling: err(line, "'%s(%s)' is used twice ('%s' and '%s')" % (name, arg, used[name, arg], p.spelling))
            if name == 'stage_in':
                stage_in += 1
                if ok and stage != 'kernel': check_struct(t.get_canonical().get_declaration(), stage + '-in')
    if stage_in > 1: err(f.location.line, 'more than one [[stage_in]]')
    if f.result_type.get_canonical().kind == T.RECORD and stage != 'kernel': check_struct(f.result_type.get_canonical().get_declaration(), stage + '-out')
    elif stage == 'vertex' and short(f.result_type) not in ('float4', 'void'): err(f.location.line, 'a vertex function returns a struct with [[position]], float4 or void')
    elif stage == 'kernel' and f.result_type.kind != T.VOID: err(f.location.line, 'a kernel returns void')

def lint(tu, path):
    calls, text = {}, open(path).read()
    def walk(c, func):
        for k in c.get_children():
            if not k.location.file or k.location.file.name != path:
                if k.kind in (K.CXX_BASE_SPECIFIER,) or not k.kind.is_declaration(): walk(k, func)
                continue
            line = k.location.line
            if k.kind in BANNED: err(line, "'%s' is not allowed in Metal" % BANNED[k.kind])
            for t in [k.type] if k.kind in (K.PARM_DECL, K.VAR_DECL, K.FIELD_DECL) else [k.result_type] if k.kind in (K.FUNCTION_DECL, K.CXX_METHOD) else []:
                if t.kind in (T.POINTER, T.LVALUEREFERENCE, T.INCOMPLETEARRAY) and '__generic' in t.get_pointee().spelling: err(line, "pointer or reference '%s' must have an explicit address space" % k.spelling)
            if k.kind == K.VAR_DECL and short(k.type.get_canonical()) == 'sampler' and not re.search(r'\bconstexpr\b', re.split(r'[;{}]', text[:k.location.offset])[-1]): err(line, "sampler '%s' declared in a shader must be constexpr" % k.spelling)
            if k.kind == K.VAR_DECL and re.match('u?int[234]', short(k.type)) and any(compares(e) for e in k.get_children()): err(line, 'a vector comparison is a bool vector in Metal, not ' + short(k.type))
            if k.kind == K.CALL_EXPR and k.spelling == 'msl_make' and not re.match(r'bool\d', text[k.extent.start.offset:]) and any(compares(a) for a in k.get_arguments()): err(line, 'conversion of a vector comparison: gives 0/1 in Metal but 0/-1 here, use select()')
            inner = func
            if k.kind in (K.FUNCTION_DECL, K.CXX_METHOD, K.CONSTRUCTOR):
                inner = k.get_usr(); calls.setdefault(inner, set())
                at = [a for a, _ in attrs(k)]
                for a in at:
                    if a not in FUNCS: err(line, "attribute '%s' cannot be applied to a function" % a)
                for s in ('vertex', 'fragment', 'kernel'):
                    if s in at and k.is_definition(): check_entry(k, s)
            elif k.kind in (K.VAR_DECL,) and any(a not in ('function_constant',) for a, _ in attrs(k)): err(line, "attribute on variable '%s'" % k.spelling)
            if k.kind == K.CALL_EXPR and func and k.referenced is not None: calls[func].add(k.referenced.get_usr())
            walk(k, inner)
    walk(tu.cursor, None)
    def reaches(a, b, seen):
        return any(n == b or (n not in seen and not seen.add(n) and reaches(n, b, seen)) for n in calls.get(a, ()))
    for f in calls:
        if reaches(f, f, set()): err(0, 'recursion through %s' % f)

def check(src, path):
    errors.clear()
    if re.search(r'^\s*#\s*include\s*<(?!metal_|simd/)', src, re.M): err(0, 'only metal_* and simd/ headers exist')
    open(path, 'w').write(annotate(src))
    tu = diagnostics(path, CHECK, True)
    diagnostics(path, RUN, False)
    lint(tu, path)
    return sorted(errors)

def serve(path):
    requests, answers = sys.stdin.buffer, sys.stdout.buffer
    for line in iter(requests.readline, b''):
        sources = [requests.read(int(size)).decode() for size in line.split()]
        log = ''.join('%d 1 %d %s\n' % (stage, at, msg.replace('\n', ' ')) for stage, src in enumerate(sources) if src for at, msg in check(src, path)).encode()
        answers.write(b'%d 0 0 0\n' % len(log) + log); answers.flush()

def main():
    keep = tempfile.TemporaryDirectory(prefix='mslcheck'); path = keep.name + '/shader.metal'
    if sys.argv[1] == '--serve': return serve(path)
    found = check(open(sys.argv[1]).read(), path)
    for line, msg in found: print('%s:%d: error: %s' % (sys.argv[1], line, msg))
    print('%s: %d errors' % (sys.argv[1], len(found)))
    sys.exit(1 if found else 0)
main()
