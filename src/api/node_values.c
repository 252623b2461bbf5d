// SPDX-License-Identifier: Apache-2.0
/* The values that the code of a node builds. */
#include "dynamic/code.h"
#include "ir/arithmetic.h"

#include "base/hash.h"
#include "lower/lower.h"

#include <math.h>

/* ---- Constants ---- */

static bool read_number(float number, ir_type_id scalar, union ir_word *out)
{
    switch (scalar) {
    case IR_TYPE_FLOAT: out->f = number; return isfinite(number);
    case IR_TYPE_BOOL: out->u = number != 0.0f; return true;
    case IR_TYPE_INT:
        if (!(number >= -2147483648.0f && number < 2147483648.0f))
            return false;
        out->i = (int32_t)number;
        return true;
    default:
        if (!(number >= 0.0f && number < 4294967296.0f))
            return false;
        out->u = (uint32_t)number;
        return true;
    }
}

bool code_numbers(struct mxg_build *build, ir_type_id type, const float *numbers, uint32_t n,
                  struct ir_value *out)
{
    *out = (struct ir_value){.type = type};
    if (!build_is_number(type) || !numbers || n != ir_type_info(type)->components) {
        code_fault(build,
                   "gives another number of components than the type has:", ir_type_text(type));
        return false;
    }
    for (uint32_t i = 0; i < n; i++)
        if (!read_number(numbers[i], ir_type_info(type)->scalar, &out->w[i])) {
            code_fault(build, "gives a number that is not one of the type", ir_type_text(type));
            return false;
        }
    return true;
}

static void make_number(void *request)
{
    struct code_request *r = request;
    struct ir_value value;
    ir_type_id type = code_type(r->build, r->type);
    if (type != IR_TYPE_VOID && code_numbers(r->build, type, r->numbers, r->num, &value))
        r->result = code_issue(r->build, ir_const(r->build->b->graph, &value));
}

mxg_ref mxg_build_number(mxg_build *build, const char *type, const float *values,
                         uint32_t num_values)
{
    return code_request(
        &(struct code_request){.build = build, .type = type, .numbers = values, .num = num_values},
        make_number);
}

static void make_string(void *request)
{
    struct code_request *r = request;
    struct builder *b = r->build->b;
    str_id id = str_intern_z(b->shader->strings, r->text ? r->text : "");
    r->result = code_issue(r->build, ir_const_string(b->graph, id));
}

mxg_ref mxg_build_string(mxg_build *build, const char *text)
{
    return code_request(&(struct code_request){.build = build, .text = text}, make_string);
}

/* ---- Ops ---- */

#define OF(type) ((uint32_t)1 << IR_TYPE_##type)
#define CLOSURES (OF(BSDF) | OF(EDF) | OF(VDF))
#define SHADERS (OF(SURFACE) | OF(VOLUME) | OF(DISPLACEMENT))
static_assert(IR_NUM_TYPES <= 32, "a set of types has 32 bits");

/* Ops of closures and shaders: sets of types. A result of 0 has the type of the first operand. */
static const struct opaque_op {
    uint8_t op;
    ir_type_id result;
    bool is_uniform; /* the first two operands have one type */
    uint32_t operands[4];
    unsigned share; /* the operand that is one, from 0 to 1; 0: none. A factor is that of a BSDF. */
} opaque_ops[] = {
    {IR_LAYER, 0, false, {OF(BSDF), OF(BSDF) | OF(VDF)}},
    {IR_CLOSURE_MIX, 0, true, {CLOSURES, CLOSURES, OF(FLOAT)}, 2},
    {IR_CLOSURE_ADD, 0, true, {CLOSURES, CLOSURES}},
    {IR_CLOSURE_SCALE, 0, false, {CLOSURES, OF(FLOAT) | OF(VEC3)}, 1},
    {IR_SURFACE_SHADER, IR_TYPE_SURFACE, false, {OF(BSDF), OF(EDF), OF(FLOAT), OF(BOOL)}, 2},
    {IR_SURFACE_UNLIT, IR_TYPE_SURFACE, false, {OF(VEC3), OF(VEC3), OF(FLOAT)}, 2},
    {IR_VOLUME_SHADER, IR_TYPE_VOLUME, false, {OF(VDF), OF(EDF)}},
    {IR_DISPLACEMENT_SHADER, IR_TYPE_DISPLACEMENT, false, {OF(FLOAT) | OF(VEC3), OF(FLOAT)}},
    {IR_LIGHT_SHADER, IR_TYPE_LIGHT, false, {OF(EDF), OF(FLOAT), OF(FLOAT)}},
    {IR_SHADER_MIX, 0, true, {SHADERS, SHADERS, OF(FLOAT)}, 2},
    {IR_MATERIAL,
     IR_TYPE_MATERIAL,
     false,
     {OF(SURFACE), OF(SURFACE), OF(DISPLACEMENT), OF(VOLUME)}},
};

static const struct opaque_op *find_opaque(enum ir_op op)
{
    for (size_t i = 0; i < sizeof opaque_ops / sizeof *opaque_ops; i++)
        if (opaque_ops[i].op == op)
            return &opaque_ops[i];
    return NULL;
}

/* Closures and shaders may be absent; numbers may not. */
static bool fits_opaque(const struct ir_graph *g, const struct opaque_op *row, const ir_ref *args)
{
    for (unsigned i = 0; i < 4 && row->operands[i]; i++) {
        ir_type_id type = args[i] ? ir_type_of(g, args[i]) : IR_TYPE_VOID;
        bool may_be_absent = !(row->operands[i] & ~(CLOSURES | SHADERS));
        if (args[i] ? type >= IR_NUM_TYPES || !(row->operands[i] >> type & 1) : !may_be_absent)
            return false;
    }
    return !row->is_uniform || !args[0] || !args[1]
           || ir_type_of(g, args[0]) == ir_type_of(g, args[1]);
}

/*
 * True if the op is one of its operands, which *out receives: an absent closure is the neutral
 * element of these ops.
 */
static bool is_operand(const struct ir_graph *g, enum ir_op op, const ir_ref *args, ir_ref *out)
{
    bool is_mix = op == IR_CLOSURE_MIX || op == IR_SHADER_MIX;
    *out = args[0];
    if (op == IR_LAYER || op == IR_CLOSURE_ADD) {
        if (args[0] && args[1])
            return false;
        *out = ir_other_operand(g, op, args[0], args[1]);
        return true;
    }
    if (op == IR_CLOSURE_SCALE)
        return !args[0] || ir_const_is(g, args[1], 1.0f);
    if (is_mix && ir_const_is(g, args[2], 1.0f)) {
        *out = args[1];
        return true;
    }
    return is_mix && (ir_const_is(g, args[2], 0.0f) || args[0] == args[1]);
}

/* False: the operands do not fit. */
static bool build_opaque(struct ir_graph *g, const struct opaque_op *row, ir_ref *args, unsigned n,
                         ir_ref *out)
{
    if (!fits_opaque(g, row, args))
        return false;
    bool is_factor =
        row->op == IR_CLOSURE_SCALE && args[0] && ir_type_of(g, args[0]) != IR_TYPE_BSDF;
    if (row->share && !is_factor)
        args[row->share] = ir_share(g, args[row->share]);
    if (is_operand(g, (enum ir_op)row->op, args, out))
        return true;
    ir_type_id type = row->result ? row->result : ir_type_of(g, args[0] ? args[0] : args[1]);
    *out = ir_build(g, (enum ir_op)row->op, type, 0, args, n);
    return true;
}

/* The op for the types: 0 if the operands do not fit. */
static ir_ref build_plain(struct ir_graph *g, enum ir_op op, ir_type_id wanted, const ir_ref *args,
                          unsigned n)
{
    ir_type_id types[4];
    for (unsigned i = 0; i < n; i++) {
        if (!args[i])
            return 0;
        if (i < 4)
            types[i] = ir_type_of(g, args[i]);
    }
    if (op == IR_CONSTRUCT)
        return build_is_number(wanted) ? ir_construct(g, wanted, args, n) : 0;
    if (op == IR_CONVERT)
        return n == 1 && build_is_number(wanted) ? ir_convert(g, wanted, args[0]) : 0;
    ir_type_id type = n <= 4 ? ir_op_result(op, types, n) : IR_TYPE_VOID;
    return type == IR_TYPE_VOID ? 0 : ir_build(g, op, type, 0, args, n);
}

/* False for an op that node.h does not offer: a source, a call, or one with an attribute. */
static bool is_offered(enum ir_op op)
{
    bool is_source = op <= IR_POISON, is_special = op == IR_SWIZZLE || op == IR_MEMBER,
         is_call = op >= IR_CALL && op <= IR_LEAF;
    return !is_source && !is_special && !is_call;
}

/* IR_NUM_OPS: there is no op of this name that node.h offers. */
static enum ir_op find_op(const char *name)
{
    for (unsigned op = 0; name && op < IR_NUM_OPS; op++) {
        const char *text = ir_op_info((enum ir_op)op)->text;
        if (text[0] == name[0] && strcmp(text, name) == 0)
            return is_offered((enum ir_op)op) ? (enum ir_op)op : IR_NUM_OPS;
    }
    return IR_NUM_OPS;
}

static void make_op(void *request)
{
    struct code_request *r = request;
    struct ir_graph *g = r->build->b->graph;
    enum ir_op op = find_op(r->name);
    ir_type_id wanted = IR_TYPE_VOID;
    ir_ref *args, made = 0;
    if (op == IR_NUM_OPS) {
        code_fault(r->build, "names an unknown op:", r->name);
        return;
    }
    if (r->type && (wanted = code_type(r->build, r->type)) == IR_TYPE_VOID)
        return;
    if (!code_refs(r->build, r->args, r->num, &args))
        return;
    const struct opaque_op *row = find_opaque(op);
    bool is_counted = ir_op_info(op)->arity < 0 || (unsigned)ir_op_info(op)->arity == r->num;
    bool is_good = is_counted && r->num > 0
                   && (row ? build_opaque(g, row, args, r->num, &made)
                           : (made = build_plain(g, op, wanted, args, r->num)) != 0);
    is_good = is_good && (!made || wanted == IR_TYPE_VOID || ir_type_of(g, made) == wanted);
    if (is_good)
        r->result = code_issue(r->build, made);
    else
        code_fault(r->build, "passes operands that do not fit the op", r->name);
}

mxg_ref mxg_build_op(mxg_build *build, const char *op, const char *type, const mxg_ref *args,
                     uint32_t num_args)
{
    return code_request(
        &(struct code_request){
            .build = build, .name = op, .type = type, .args = args, .num = num_args},
        make_op);
}

static void make_swizzle(void *request)
{
    struct code_request *r = request;
    struct ir_graph *g = r->build->b->graph;
    static const char names[] = "xyzw";
    uint8_t components[4];
    unsigned n = 0;
    ir_ref value;
    if (!code_ref(r->build, r->value, &value))
        return;
    const struct ir_type_info *info = value && ir_type_of(g, value) < IR_NUM_TYPES
                                          ? ir_type_info(ir_type_of(g, value))
                                          : ir_type_info(IR_TYPE_VOID);
    bool is_good = r->name && info->components > 1 && info->columns <= 1;
    for (const char *c = r->name; is_good && *c; c++) {
        const char *found = strchr(names, *c);
        is_good = found && found - names < info->components && n < 4;
        if (is_good)
            components[n++] = (uint8_t)(found - names);
    }
    if (is_good && n)
        r->result = code_issue(r->build, ir_swizzle(g, value, components, n));
    else
        code_fault(r->build,
                   "asks for components that the value does not have:", r->name ? r->name : "NULL");
}

mxg_ref mxg_build_swizzle(mxg_build *build, mxg_ref value, const char *components)
{
    return code_request(&(struct code_request){.build = build, .name = components, .value = value},
                        make_swizzle);
}

/* ---- Expressions ---- */

/* Text and types of an expression: equal ones are parsed once. */
static str_id key_of(const struct builder *b, const struct code_request *r,
                     const struct lang_input *inputs)
{
    struct text key;
    text_init(&key, b->arena);
    text_fmt(&key, "{{%s", r->type);
    for (uint32_t i = 0; i < r->num; i++)
        text_fmt(&key, " %s:%u", r->names[i], (unsigned)inputs[i].type);
    text_fmt(&key, "}}%s", r->text);
    return str_intern(b->shader->strings, text_cstr(&key), key.len);
}

static uint32_t parse(struct code_request *r, const struct lang_input *inputs, ir_type_id type)
{
    struct builder *b = r->build->b;
    str_id key = key_of(b, r, inputs);
    uint32_t hash = hash_pair(key, 0);
    for (uint32_t at = hash, found; (found = table_next(&b->code_expressions, hash, &at));)
        if (b->code_parsed.items[found - 1].key == key)
            return b->code_parsed.items[found - 1].function;
    struct text file;
    text_init(&file, b->arena);
    text_fmt(&file, "code of %s", build_text(b, r->build->def->name));
    uint32_t function = lang_parse_expression(
        b->shader->unit, r->text, strlen(r->text), inputs, r->num, type, LANG_NONE,
        (struct diag_place){.file = text_cstr(&file), .line = 1, .column = 1}, b->diags);
    vec_push(b->arena, &b->code_parsed, (struct code_parsed){key, function});
    table_add(&b->code_expressions, b->arena, hash, b->code_parsed.len);
    return function;
}

/* False after a report: a value has no type of the portable language. */
static bool name_inputs(struct code_request *r, const ir_ref *args, struct lang_input *inputs)
{
    struct builder *b = r->build->b;
    for (uint32_t i = 0; i < r->num; i++) {
        ir_type_id type = args[i] ? ir_type_of(b->graph, args[i]) : IR_TYPE_VOID;
        type = type == IR_TYPE_SAMPLER_ARRAY ? IR_TYPE_SAMPLER : type;
        bool is_value = build_is_number(type) || type == IR_TYPE_STRING || type == IR_TYPE_SAMPLER;
        if (!r->names || !r->names[i] || !is_value) {
            code_fault(r->build, "passes no value that an expression can read for",
                       r->names && r->names[i] ? r->names[i] : "NULL");
            return false;
        }
        inputs[i] = (struct lang_input){str_intern_z(b->shader->strings, r->names[i]), type};
    }
    return true;
}

enum { MAX_INPUTS = 64 };

static void make_expression(void *request)
{
    struct code_request *r = request;
    struct builder *b = r->build->b;
    struct lang_input inputs[MAX_INPUTS];
    ir_ref *args, result;
    ir_type_id type = code_type(r->build, r->type);
    if (type == IR_TYPE_VOID)
        return;
    if (!build_is_number(type) || !r->text || r->num > MAX_INPUTS) {
        code_fault(r->build, "gives an expression without text, or of the type", r->type);
        return;
    }
    if (!code_refs(r->build, r->args, r->num, &args) || !name_inputs(r, args, inputs))
        return;
    uint32_t function = parse(r, inputs, type);
    if (function == LANG_NONE) {
        r->build->has_failed = true;
        return;
    }
    lang_lower_call(b->shader->unit, b->graph, &b->host, function, args, &result);
    r->result = code_issue(r->build, result);
}

mxg_ref mxg_build_expression(mxg_build *build, const char *type, const char *source,
                             const char *const *names, const mxg_ref *args, uint32_t num_args)
{
    return code_request(&(struct code_request){.build = build,
                                               .type = type,
                                               .text = source,
                                               .names = names,
                                               .args = args,
                                               .num = num_args},
                        make_expression);
}
