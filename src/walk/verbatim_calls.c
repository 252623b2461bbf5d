// SPDX-License-Identifier: Apache-2.0
/* Calls of source for one target, which mxgen copies into the shader. */
#include "shader/verbatim.h"

#include "build/build_priv.h"

#include <ctype.h>

struct source_call {
    struct builder *b;
    const struct frame *frame;
    const struct implementation *impl;
    const struct verbatim *verbatim;
    const struct library *layer; /* of the verbatim source */
    const struct nodedef *def;
    const struct port *ports;
};

static ir_type_id type_of(const struct source_call *c, unsigned port)
{
    return build_type(c->b, c->ports[port].type);
}

/* True for a function with a calling convention of closures in hardware targets. */
static bool has_convention(const struct source_call *c)
{
    return c->verbatim->function && !c->verbatim->is_plain;
}

/* ---- Messages ---- */

static void fail(const struct source_call *c, ir_ref *results)
{
    for (uint32_t i = 0; i < c->def->num_outputs; i++)
        results[i] = ir_poison(c->b->graph, type_of(c, c->def->num_inputs + i));
}

/* The node that needs the source, after a message at its implementation. */
static void report_use(const struct source_call *c)
{
    const struct document *doc = &c->b->lib->doc;
    elem_id node = c->frame ? c->frame->node.element : 0;
    if (node && doc_element(doc, node)->kind == KIND_NODE) /* default lights have no node */
        diag_add(c->b->diags, DIAG_ID_needed_by, doc_place(doc, node),
                 build_text(c->b, doc_element(doc, node)->name));
}

static void report_absent(const struct source_call *c, const char *name)
{
    struct builder *b = c->b;
    struct text what;
    text_init(&what, b->arena);
    if (*name == '{')
        text_str(&what, "members in braces, which have no type here");
    else
        text_fmt(&what, "'%s' of MaterialX's mx_funcs.h, which mxgen does not have", name);
    diag_add(b->diags, DIAG_ID_absent_prelude, doc_place(&b->lib->doc, c->impl->element),
             build_text(b, c->impl->name), text_cstr(&what));
    report_use(c);
}

/* Reports source that mxgen cannot call, with the reason why it is not portable. */
static void report_unusable(const struct source_call *c, const struct port *port)
{
    struct builder *b = c->b;
    diag_add(b->diags, DIAG_ID_unusable_source, doc_place(&b->lib->doc, c->impl->element),
             build_text(b, c->impl->name), build_text(b, port->name),
             build_text(b, library_type_name(b->lib, port->type)));
    str_id file = c->verbatim->reason_file;
    if (c->verbatim->reason)
        diag_add(b->diags, DIAG_ID_not_portable,
                 (struct diag_place){.file = file ? build_text(b, file) : NULL,
                                     .line = c->verbatim->reason_line,
                                     .column = c->verbatim->reason_column},
                 build_text(b, c->verbatim->reason));
    report_use(c);
}

static void report_token(const struct source_call *c, const struct source_file *file,
                         const struct source_fault *fault)
{
    struct builder *b = c->b;
    diag_add(b->diags, DIAG_ID_unknown_source_token,
             (struct diag_place){
                 .file = build_text(b, file->name), .line = fault->line, .column = fault->column},
             fault->token);
    diag_add(b->diags, DIAG_ID_source_used_by, doc_place(&b->lib->doc, c->impl->element),
             build_text(b, c->impl->name));
    report_use(c);
}

/* ---- Files ---- */

/* The shader's source of a file and of its includes; UINT32_MAX after a diagnostic. */
static uint32_t add_file(const struct source_call *c, uint32_t id, unsigned depth)
{
    enum { MAX_INCLUDES = 64 };
    const struct library *layer;
    const struct source_file *file = library_source(c->b->lib, id, &layer);
    uint32_t *includes = ARENA_ARRAY(c->b->arena, uint32_t, file->num_includes);
    assert(depth < MAX_INCLUDES);
    for (uint32_t i = 0; i < file->num_includes; i++) {
        includes[i] = add_file(c, layer->refs.items[file->first_include + i], depth + 1);
        if (includes[i] == UINT32_MAX)
            return UINT32_MAX;
    }
    struct source_fault fault;
    uint32_t source =
        shader_add_source(c->b->shader, file->text, includes, file->num_includes, &fault);
    if (source == UINT32_MAX)
        report_token(c, file, &fault);
    return source;
}

/* The files of a call in their order: those that MaterialX adds, then its own. */
static bool add_files(const struct source_call *c, struct shader_verbatim *v)
{
    const struct verbatim *verbatim = c->verbatim;
    struct shader *shader = c->b->shader;
    struct source_list files = {0};
    if (verbatim->file == LIBRARY_NONE)
        return true;
    for (uint32_t i = 0; i < verbatim->num_implied; i++) {
        const uint32_t *pair = &c->layer->refs.items[verbatim->first_implied + 2 * i];
        int environment = library_implied_includes[pair[0]].environment;
        if (environment < 0 || environment == c->b->options->environment)
            vec_push(c->b->arena, &files, add_file(c, pair[1], 0));
    }
    vec_push(c->b->arena, &files, add_file(c, verbatim->file, 0));
    v->first_source = shader->sources.refs.len;
    v->num_sources = files.len;
    for (uint32_t i = 0; i < files.len; i++) {
        if (files.items[i] == UINT32_MAX)
            return false;
        vec_push(shader->arena, &shader->sources.refs, files.items[i]);
    }
    return true;
}

static bool same_sources(const struct shader *shader, const struct shader_verbatim *a,
                         const struct shader_verbatim *b)
{
    if (a->num_sources != b->num_sources)
        return false;
    for (uint32_t i = 0; i < a->num_sources; i++)
        if (shader->sources.refs.items[a->first_source + i]
            != shader->sources.refs.items[b->first_source + i])
            return false;
    return true;
}

/* Adds a verbatim source, unless an equal one exists. */
static uint32_t add_verbatim(const struct source_call *c, const struct shader_verbatim *v)
{
    struct shader *shader = c->b->shader;
    shader_index_helpers(shader);
    for (uint32_t i = 0; i < shader->sources.calls.len; i++) {
        const struct shader_verbatim *have = &shader->sources.calls.items[i];
        if (have->function == v->function && have->expression == v->expression
            && have->num_results == v->num_results && same_sources(shader, have, v))
            return i;
    }
    vec_push(shader->arena, &shader->sources.calls, *v);
    vec_last(&shader->sources.calls).needs_neighbours =
        shader_needs_neighbours(shader, v, c->b->arena);
    return shader->sources.calls.len - 1;
}

static uint32_t callee_of(const struct source_call *c, uint32_t verbatim)
{
    return ir_add_callee(
        c->b->graph,
        (struct ir_callee){.kind = IR_CALLEE_VERBATIM,
                           .index = verbatim,
                           .name = c->def->name,
                           .derivative =
                               c->b->shader->sources.calls.items[verbatim].needs_neighbours});
}

/* ---- Arguments ---- */

/* The index of a word in the enumeration of an input; -1: it has none. */
static int index_in_enum(const struct source_call *c, const struct port *port, str_id word)
{
    const struct document *doc = &c->b->lib->doc;
    elem_id words = library_source_words(c->b->lib, c->impl->element, port);
    str_id of_port = port->flags & PORT_ENUM ? doc_attr_value(doc, port->element, STR_enum) : 0;
    const char *list =
        build_text(c->b, words ? doc_attr_value(doc, words, STR_enumvalues) : of_port);
    return library_enum_index(list, build_text(c->b, word));
}

/* A string as the integer that libraries expect: its index in the enumeration, else 0. */
static ir_ref number_of_string(const struct source_call *c, const struct port *port, ir_ref value)
{
    struct ir_value word;
    if (ir_get(c->b->graph, value)->op == IR_POISON)
        return ir_poison(c->b->graph, IR_TYPE_INT);
    if (!ir_get_const(c->b->graph, value, &word)) {
        diag_add(c->b->diags, DIAG_ID_input_must_be_constant,
                 doc_place(&c->b->lib->doc, c->frame->node.element), build_text(c->b, port->name),
                 build_text(c->b, c->def->node));
        return ir_poison(c->b->graph, IR_TYPE_INT);
    }
    int index = index_in_enum(c, port, word.w[0].u);
    return ir_const_int(c->b->graph, index < 0 ? 0 : index);
}

/* The extra inputs of these bits. Returns their number. */
static unsigned put_extra(struct ir_graph *graph, uint32_t extra, ir_ref *out)
{
    unsigned n = 0;
    for (unsigned i = 0; i < LIBRARY_NUM_EXTRA_INPUTS; i++)
        if (extra >> i & 1)
            out[n++] =
                ir_const_splat(graph, library_extra_inputs[i].type, library_extra_inputs[i].value);
    return n;
}

/* The inputs in order, then the extra inputs. Returns their number. */
static unsigned put_arguments(const struct source_call *c, ir_ref *out)
{
    unsigned n = 0;
    for (unsigned i = 0; i < c->def->num_inputs; i++) {
        bool is_number = ir_type_of(c->b->graph, c->frame->args[i]) == IR_TYPE_STRING
                         && !(c->b->options->caps & CAP_STRINGS);
        out[n++] =
            is_number ? number_of_string(c, &c->ports[i], c->frame->args[i]) : c->frame->args[i];
    }
    return n + put_extra(c->b->graph, c->verbatim->extra, out + n);
}

const ir_ref *build_function_arguments(struct builder *b, const struct frame *frame)
{
    const struct implementation *impl = frame->impl;
    struct source_call c = {.b = b,
                            .frame = frame,
                            .impl = impl,
                            .def = library_nodedef(b->lib, impl->nodedef),
                            .ports = library_ports(b->lib, impl->nodedef, NULL)};
    const struct lang_unit *unit;
    const struct lang_function *fn = lang_function(b->shader->unit, impl->ref, &unit);
    if (!impl->target)
        return frame->args;
    ir_ref *args = ARENA_ARRAY(b->arena, ir_ref, c.def->num_inputs + LIBRARY_NUM_EXTRA_INPUTS);
    for (unsigned i = 0; i < c.def->num_inputs; i++) {
        bool is_number = ir_type_of(b->graph, frame->args[i]) == IR_TYPE_STRING
                         && unit->slots.items[fn->first_slot + i].type == IR_TYPE_INT;
        args[i] = is_number ? number_of_string(&c, &c.ports[i], frame->args[i]) : frame->args[i];
    }
    put_extra(b->graph, impl->count, args + c.def->num_inputs);
    return args;
}

/* ---- Expressions ---- */

/* The length of the word between "{{" and "}}" at p; 0: none is there. */
static size_t placeholder_length(const char *p)
{
    size_t len = 0;
    if (p[0] == '{' && p[1] == '{')
        while (isalnum((unsigned char)p[2 + len]) || p[2 + len] == '_' || p[2 + len] == ':')
            len++;
    return len && p[2 + len] == '}' && p[3 + len] == '}' ? len : 0;
}

/*
 * "{{in1}}" becomes "{{0}}": verbatim expressions of the shader refer to operands by number. 0
 * after a report: the definition has no such input.
 */
static str_id number_inputs(const struct source_call *c, str_id source)
{
    struct builder *b = c->b;
    struct text out;
    text_init(&out, b->arena);
    for (const char *p = build_text(b, source); *p;) {
        size_t len = placeholder_length(p);
        if (!len) {
            text_char(&out, *p++);
            continue;
        }
        str_id name = str_intern(b->shader->strings, p + 2, len);
        int index = library_find_input(b->lib, c->impl->nodedef, name);
        if (index < 0) {
            diag_add(b->diags, DIAG_ID_lang_unknown, doc_place(&b->lib->doc, c->impl->element),
                     "input", build_text(b, name), "");
            report_use(c);
            return 0;
        }
        text_fmt(&out, "{{%d}}", index);
        p += len + 4;
    }
    return str_intern(b->shader->strings, out.data, out.len);
}

static void call_expressions(const struct source_call *c, const struct shader_verbatim *v,
                             const ir_ref *args, unsigned num_args, ir_ref *results)
{
    for (uint32_t i = 0; i < c->def->num_outputs; i++) {
        struct shader_verbatim one = *v;
        one.expression = number_inputs(c, c->layer->refs.items[c->verbatim->first_expression + i]);
        if (!one.expression) {
            fail(c, results);
            return;
        }
        uint32_t callee = callee_of(c, add_verbatim(c, &one));
        results[i] = ir_build(c->b->graph, IR_VERBATIM, type_of(c, c->def->num_inputs + i), callee,
                              args, num_args);
    }
}

/* ---- Functions ---- */

/* The type of a result in the source: shaders are structs. */
static ir_type_id result_type(const struct source_call *c, ir_type_id type)
{
    if (type == IR_TYPE_SURFACE)
        return shader_source_struct(c->b->shader, SOURCE_STRUCT_SURFACE);
    if (type == IR_TYPE_DISPLACEMENT)
        return shader_source_struct(c->b->shader, SOURCE_STRUCT_DISPLACEMENT);
    return type;
}

static ir_ref member(const struct source_call *c, ir_ref value, unsigned index, ir_type_id type)
{
    return ir_build(c->b->graph, IR_MEMBER, type, index, &value, 1);
}

/*
 * The shader of a struct. MaterialX adds the colour of a surface to the pixel, and the mean of its
 * transparency to the background.
 */
static ir_ref shader_of_struct(const struct source_call *c, ir_ref value, ir_type_id type)
{
    struct ir_graph *g = c->b->graph;
    if (type == IR_TYPE_SURFACE) {
        ir_ref args[] = {member(c, value, 0, IR_TYPE_VEC3), member(c, value, 1, IR_TYPE_VEC3),
                         ir_const_float(g, 1.0f)};
        return ir_build(g, IR_SURFACE_UNLIT, type, 0, args, 3);
    }
    ir_ref args[] = {member(c, value, 0, IR_TYPE_VEC3), member(c, value, 1, IR_TYPE_FLOAT)};
    return type == IR_TYPE_DISPLACEMENT ? ir_build(g, IR_DISPLACEMENT_SHADER, type, 0, args, 2)
                                        : value;
}

static void call_function(const struct source_call *c, struct shader_verbatim *v,
                          const ir_ref *args, unsigned num_args, ir_ref *results)
{
    struct ir_graph *g = c->b->graph;
    struct shader *shader = c->b->shader;
    unsigned first = c->def->num_inputs;
    v->function = c->verbatim->function;
    v->num_results = c->def->num_outputs;
    v->first_result = shader->sources.result_types.len;
    for (unsigned i = 0; i < v->num_results; i++)
        vec_push(shader->arena, &shader->sources.result_types,
                 result_type(c, type_of(c, first + i)));
    uint32_t callee = callee_of(c, add_verbatim(c, v));
    ir_ref call = ir_build(g, IR_VERBATIM, IR_TYPE_VOID, callee, args, num_args);
    for (uint32_t i = 0; i < v->num_results; i++) {
        ir_type_id type = type_of(c, first + i);
        ir_ref result = ir_build(g, IR_RESULT, result_type(c, type), i + 1, &call, 1);
        results[i] = ir_type_is_shader(type) ? shader_of_struct(c, result, type) : result;
    }
}

/* ---- Closures ---- */

static uint32_t add_context(const struct source_call *c, const struct shader_verbatim *files,
                            enum source_context context)
{
    static const char *const suffixes[NUM_SOURCE_CONTEXTS] = {
        [SOURCE_REFLECTION] = "_reflection",
        [SOURCE_TRANSMISSION] = "_transmission",
        [SOURCE_INDIRECT] = "_indirect",
        [SOURCE_EMISSION] = "",
    };
    struct shader *shader = c->b->shader;
    struct shader_verbatim v = *files;
    struct text name;
    text_init(&name, c->b->arena);
    text_str(&name, build_text(c->b, c->verbatim->function));
    text_str(&name, c->verbatim->has_suffixes ? suffixes[context] : "");
    v.function = str_intern(shader->strings, name.data, name.len);
    v.num_results = 1;
    v.first_result = shader->sources.result_types.len;
    v.has_initial = true;
    vec_push(
        shader->arena, &shader->sources.result_types,
        shader_closure_struct(shader, c->verbatim->convention, type_of(c, c->def->num_inputs)));
    return add_verbatim(c, &v);
}

/*
 * The contexts in which a closure contributes: the nodedef's attribute `bsdf` is "R", "T" or "RT"
 * (MaterialX: ShaderNode::Classification). A throughput counts in every context.
 */
static uint8_t answers_of(const struct source_call *c)
{
    const char *bsdf = build_text(c->b, doc_attr_value(&c->b->lib->doc, c->def->element, STR_bsdf));
    uint8_t all = c->verbatim->contexts;
    if (!*bsdf)
        return all;
    if (!strchr(bsdf, 'T'))
        all &= (uint8_t) ~(1u << SOURCE_TRANSMISSION);
    if (!strchr(bsdf, 'R'))
        all &= (uint8_t) ~(1u << SOURCE_REFLECTION | 1u << SOURCE_INDIRECT);
    return all;
}

/* Adds a leaf, unless an equal one exists. */
static uint32_t add_leaf(struct shader *shader, const struct source_leaf *leaf)
{
    for (uint32_t i = 0; i < shader->sources.leaves.len; i++) {
        const struct source_leaf *have = &shader->sources.leaves.items[i];
        if (have->convention == leaf->convention && have->answers == leaf->answers
            && have->nodedef == leaf->nodedef
            && memcmp(have->verbatim, leaf->verbatim, sizeof have->verbatim) == 0)
            return i;
    }
    vec_push(shader->arena, &shader->sources.leaves, *leaf);
    return shader->sources.leaves.len - 1;
}

/* An expression or a function whose result is a closure of the target. */
static uint32_t add_native(const struct source_call *c, const struct shader_verbatim *files)
{
    struct shader *shader = c->b->shader;
    struct shader_verbatim v = *files;
    v.function = c->verbatim->function;
    if (!v.function)
        v.expression = number_inputs(c, c->layer->refs.items[c->verbatim->first_expression]);
    v.num_results = v.function ? 1 : 0;
    v.first_result = shader->sources.result_types.len;
    if (v.function)
        vec_push(shader->arena, &shader->sources.result_types, type_of(c, c->def->num_inputs));
    return add_verbatim(c, &v);
}

static void build_leaf(const struct source_call *c, const struct shader_verbatim *files,
                       const ir_ref *args, unsigned num_args, ir_ref *results)
{
    struct shader *shader = c->b->shader;
    struct source_leaf leaf = {.convention = c->verbatim->convention,
                               .answers = answers_of(c),
                               .nodedef = c->impl->nodedef};
    bool is_native = !has_convention(c);
    ir_type_id *types = ARENA_ARRAY(shader->arena, ir_type_id, num_args);
    for (unsigned i = 0; i < c->def->num_inputs; i++)
        types[i] = ir_type_of(c->b->graph, args[i]);
    leaf.operand_types = types;
    for (unsigned i = 0; i < NUM_SOURCE_CONTEXTS; i++)
        leaf.verbatim[i] = c->verbatim->contexts >> i & 1
                               ? add_context(c, files, (enum source_context)i)
                               : UINT32_MAX;
    if (is_native) {
        leaf.convention = SOURCE_NATIVE;
        leaf.verbatim[0] = add_native(c, files);
    }
    uint32_t index = add_leaf(shader, &leaf);
    shader->sources.is_1_38 |= !is_native && !source_has_closure_data(leaf.convention);
    ir_ref *operands = ARENA_ARRAY(c->b->arena, ir_ref, num_args + 1);
    operands[0] = ir_const_float(c->b->graph, 1.0f);
    memcpy(operands + 1, args, num_args * sizeof *args);
    uint32_t callee = ir_add_callee(c->b->graph, (struct ir_callee){.kind = IR_CALLEE_SOURCE,
                                                                    .index = index,
                                                                    .name = c->verbatim->function});
    results[0] = ir_build(c->b->graph, IR_LEAF, type_of(c, c->def->num_inputs), callee, operands,
                          num_args + 1);
}

/* ---- All ---- */

/*
 * The first input or output that the source cannot take: a shader, or a closure where the source
 * has no calling convention for closures. NULL: there is none.
 */
static const struct port *unusable_port(const struct source_call *c)
{
    bool is_value = !ir_type_is_closure(type_of(c, c->def->num_inputs));
    for (unsigned i = 0; i < c->def->num_inputs + c->def->num_outputs; i++) {
        ir_type_id type = type_of(c, i);
        bool is_result = i >= c->def->num_inputs && c->verbatim->function
                         && (type == IR_TYPE_SURFACE || type == IR_TYPE_DISPLACEMENT);
        bool is_shader = ir_type_is_shader(type) && !is_result;
        bool is_wrong =
            is_value || has_convention(c) == ((c->b->options->caps & CAP_CLOSURES) != 0);
        if (is_shader || (ir_type_is_closure(type) && is_wrong))
            return &c->ports[i];
    }
    return NULL;
}

static struct source_call start(struct builder *b, const struct implementation *impl)
{
    struct source_call c = {.b = b, .impl = impl};
    c.verbatim = library_verbatim(b->lib, impl->ref, &c.layer);
    c.def = library_nodedef(b->lib, impl->nodedef);
    c.ports = library_ports(b->lib, impl->nodedef, NULL);
    return c;
}

bool build_is_light_source(const struct builder *b, const struct implementation *impl)
{
    const struct verbatim *verbatim = library_verbatim(b->lib, impl->ref, NULL);
    const struct nodedef *def = library_nodedef(b->lib, impl->nodedef);
    const struct port *ports = library_ports(b->lib, impl->nodedef, NULL);
    return ports[def->num_inputs].type == DOC_TYPE_lightshader && verbatim->function
           && !verbatim->is_plain;
}

uint32_t build_light_source(struct builder *b, const struct implementation *impl)
{
    struct source_call c = start(b, impl);
    struct shader *shader = b->shader;
    struct shader_verbatim v = {.function = c.verbatim->function, .num_results = 1};
    if (!add_files(&c, &v))
        return UINT32_MAX;
    v.first_result = shader->sources.result_types.len;
    vec_push(shader->arena, &shader->sources.result_types,
             shader_source_struct(shader, SOURCE_STRUCT_LIGHT));
    return add_verbatim(&c, &v);
}

void build_verbatim(struct builder *b, const struct frame *frame, ir_ref *results)
{
    struct source_call c = start(b, frame->impl);
    c.frame = frame;
    const struct port *unusable = unusable_port(&c);
    struct shader_verbatim v = {0};
    const char *absent = unusable ? NULL : build_absent_name(b, c.impl);
    if (unusable)
        report_unusable(&c, unusable);
    if (absent)
        report_absent(&c, absent);
    if (unusable || absent || !add_files(&c, &v)) {
        fail(&c, results);
        return;
    }
    ir_ref *args = ARENA_ARRAY(b->arena, ir_ref, c.def->num_inputs + LIBRARY_NUM_EXTRA_INPUTS);
    unsigned num_args = put_arguments(&c, args);
    if (ir_type_is_closure(type_of(&c, c.def->num_inputs)))
        build_leaf(&c, &v, args, num_args, results);
    else if (!c.verbatim->function)
        call_expressions(&c, &v, args, num_args, results);
    else
        call_function(&c, &v, args, num_args, results);
}
