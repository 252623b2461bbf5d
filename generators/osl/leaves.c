// SPDX-License-Identifier: Apache-2.0
/*
 * Leaves become calls of OSL closures: a row of closures.def gives the closure and its arguments.
 */
#include "generators/osl/closure_tree.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"

#include <assert.h>

/* ---- The table ---- */

enum leaf_input {
#define INPUT(name) INPUT_##name,
#include "generators/osl/closures.def"
    NUM_INPUTS,
    INPUT_white = NUM_INPUTS, /* replaces a tint */
};

static const char *const input_names[NUM_INPUTS] = {
#define INPUT(name) #name,
#include "generators/osl/closures.def"
};

enum argument_kind {
    ARGUMENT_END,
    ARGUMENT_INPUT,
    ARGUMENT_X,
    ARGUMENT_Y,
    ARGUMENT_FACING,
    ARGUMENT_REFLECTED,
    ARGUMENT_TRANSMITTED,
    ARGUMENT_BENT,
    ARGUMENT_FACETS,
    ARGUMENT_TEXT,
    ARGUMENT_INT,
    ARGUMENT_FLOAT,
    ARGUMENT_GREY,
    ARGUMENT_ALBEDO,
    ARGUMENT_FACET,
    ARGUMENT_FACET_X,
    ARGUMENT_FACET_Y,
};

struct argument {
    enum argument_kind kind;
    enum leaf_input input;
    const char *text;
    int number;
};

/* Optional arguments of a closure, written if an input differs from its default. */
struct option {
    enum leaf_input input;
    const char *word; /* for strings: the only value that adds the arguments */
    const struct argument *arguments;
};

struct row {
    const char *family; /* family of the leaf: "mx_dielectric_bsdf" */
    const char *closure;
    const struct argument *arguments;
    struct option option; /* arguments NULL: no option */
};

#define ARG(name) \
    { \
        .kind = ARGUMENT_INPUT, .input = INPUT_##name \
    }
#define ARG_X(name) \
    { \
        .kind = ARGUMENT_X, .input = INPUT_##name \
    }
#define ARG_Y(name) \
    { \
        .kind = ARGUMENT_Y, .input = INPUT_##name \
    }
#define ARG_FACING(name) \
    { \
        .kind = ARGUMENT_FACING, .input = INPUT_##name \
    }
#define ARG_REFLECTED(name) \
    { \
        .kind = ARGUMENT_REFLECTED, .input = INPUT_##name \
    }
#define ARG_TRANSMITTED(name) \
    { \
        .kind = ARGUMENT_TRANSMITTED, .input = INPUT_##name \
    }
#define ARG_BENT(name) \
    { \
        .kind = ARGUMENT_BENT, .input = INPUT_##name \
    }
#define ARG_FACETS(name) \
    { \
        .kind = ARGUMENT_FACETS, .input = INPUT_##name \
    }
#define ARG_TEXT(word) \
    { \
        .kind = ARGUMENT_TEXT, .text = word \
    }
#define ARG_INT(value) \
    { \
        .kind = ARGUMENT_INT, .number = value \
    }
#define ARG_FLOAT(value) \
    { \
        .kind = ARGUMENT_FLOAT, .number = value \
    }
#define ARG_GREY(value) \
    { \
        .kind = ARGUMENT_GREY, .number = value \
    }
#define ARG_ALBEDO \
    { \
        .kind = ARGUMENT_ALBEDO \
    }
#define ARG_FACET \
    { \
        .kind = ARGUMENT_FACET \
    }
#define ARG_FACET_X(name) \
    { \
        .kind = ARGUMENT_FACET_X, .input = INPUT_##name \
    }
#define ARG_FACET_Y(name) \
    { \
        .kind = ARGUMENT_FACET_Y, .input = INPUT_##name \
    }
#define ARG_KEYWORD(name) ARG_TEXT(#name), ARG(name)
#define ARGUMENTS(...) ((const struct argument[]){__VA_ARGS__, {.kind = ARGUMENT_END}})
#define GIVEN(name, ...) \
    { \
        INPUT_##name, NULL, ARGUMENTS(__VA_ARGS__) \
    }
#define GIVEN_AS(name, word, ...) \
    { \
        INPUT_##name, word, ARGUMENTS(__VA_ARGS__) \
    }
#define NO_OPTION \
    { \
        .arguments = NULL \
    }

static const struct row rows[] = {
#define CLOSURE(leaf, closure, arguments, ...) {"mx_" #leaf, closure, arguments, __VA_ARGS__},
#include "generators/osl/closures.def"
};

static const struct row *find_row(const char *family)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (strcmp(rows[i].family, family) == 0)
            return &rows[i];
    return NULL;
}

bool osl_fits_family(const char *family, const uint32_t *functions)
{
    return functions[LEAF_FACTOR] == LANG_NONE && functions[LEAF_EMISSION] == LANG_NONE
           && !find_row(family);
}

bool osl_is_fitted(const struct osl_tree *t, ir_ref ref)
{
    const struct ir_node *node = ir_get(t->graph, ref);
    if (node->op != IR_LEAF || node->type != IR_TYPE_BSDF || closure_source(t->shader, ref))
        return false;
    return osl_fits_family(str_text(t->shader->strings, t->graph->callees.items[node->attr].name),
                           t->host->leaf_functions(t->host->user_data, node->attr));
}

/* ---- Inputs of the current leaf ---- */

enum side { BOTH_SIDES, REFLECTED, TRANSMITTED };

struct leaf {
    struct osl_tree *tree;
    ir_ref ref;
    ir_ref inputs[NUM_INPUTS]; /* 0: the leaf lacks this input */
    ir_ref turned;             /* true if it reflects light back to its source; 0: false */
    enum side side;            /* the side of the closure */
};

static void find_inputs(struct leaf *leaf)
{
    const struct closure_host *host = leaf->tree->host;
    const struct ir_node *node = ir_get(leaf->tree->graph, leaf->ref);
    for (unsigned i = 0; i + 1u < node->num_args; i++) {
        const char *name = host->leaf_input(host->user_data, node->attr, i);
        for (unsigned k = 0; name && k < NUM_INPUTS; k++)
            if (strcmp(input_names[k], name) == 0)
                leaf->inputs[k] = ir_arg(leaf->tree->graph, leaf->ref, i + 1);
    }
}

static bool is_string(const struct osl_tree *t, ir_ref value, const char *text)
{
    struct ir_value constant;
    return value && ir_get_const(t->graph, value, &constant) && constant.type == IR_TYPE_STRING
           && strcmp(str_text(t->shader->strings, constant.w[0].u), text) == 0;
}

bool osl_is_false(const struct osl_tree *t, ir_ref value)
{
    struct ir_value constant;
    return !value || (ir_get_const(t->graph, value, &constant) && constant.w[0].u == 0);
}

static bool scatters(const struct leaf *leaf, enum side side)
{
    return !is_string(leaf->tree, leaf->inputs[INPUT_scatter_mode], side == REFLECTED ? "T" : "R");
}

/* ---- Arguments ---- */

/* Retroreflecting facets send light back along the view direction. */
static ir_ref facing(const struct leaf *leaf, ir_ref normal)
{
    struct osl_tree *t = leaf->tree;
    ir_ref args[3] = {leaf->turned, leaf->turned ? closure_view(t->shader, t->host) : 0, normal};
    return leaf->turned ? ir_build(t->graph, IR_SELECT, IR_TYPE_VEC3, 0, args, 3) : normal;
}

/* The tint of one side; black if the current closure is for the other side. */
static ir_ref scattered(const struct leaf *leaf, ir_ref tint, enum side side)
{
    bool counts = scatters(leaf, side) && (leaf->side == BOTH_SIDES || leaf->side == side);
    return counts ? tint : ir_const_splat(leaf->tree->graph, IR_TYPE_VEC3, 0.0f);
}

/*
 * The input color82 bends Schlick's curve. OSL closures lack this colour, so the colour at 90
 * degrees changes.
 */
static ir_ref bent_edge(const struct leaf *leaf, ir_ref color90)
{
    struct ir_graph *g = leaf->tree->graph;
    ir_ref color82 = leaf->inputs[INPUT_color82], color0 = leaf->inputs[INPUT_color0];
    if (ir_const_is(g, color82, 1.0f))
        return color90;
    return FORMULA(leaf->tree->shader, "mx_rise_edge", color0, color82, color90,
                   leaf->inputs[INPUT_exponent]);
}

static ir_ref word(const struct leaf *leaf, const char *text)
{
    return ir_const_string(leaf->tree->graph, str_intern_z(leaf->tree->shader->strings, text));
}

/* ShaderX leaves out the last letter of the second distribution. */
static ir_ref facets(const struct leaf *leaf, ir_ref distribution)
{
    struct ir_graph *g = leaf->tree->graph;
    ir_ref is_short = ir_op2(g, IR_EQ, distribution, word(leaf, "beckman"));
    ir_ref args[3] = {is_short, word(leaf, "beckmann"), distribution};
    return ir_build(g, IR_SELECT, IR_TYPE_STRING, 0, args, 3);
}

/* True for componentwise ops that have the same meaning for scalars. */
static bool is_componentwise(enum ir_op op)
{
    uint8_t rule = ir_op_info(op)->rule;
    return rule == IR_RULE_SAME
               ? op != IR_NORMALIZE && op != IR_CROSS && op != IR_REFLECT && op != IR_FACEFORWARD
           : rule == IR_RULE_SPLAT ? op != IR_REFRACT
                                   : rule == IR_RULE_ARITH || op == IR_SELECT;
}

enum { MAX_DEPTH = 12 };

/*
 * A component of a vector, through its operands as far as possible: roughness has two components,
 * which OSL would hold in a struct.
 */
static ir_ref component(struct ir_graph *g, ir_ref value, unsigned index, unsigned depth)
{
    const struct ir_node node = *ir_get(g, value);
    bool is_plain = depth && is_componentwise(node.op) && ir_type_info(node.type)->columns == 1;
    for (uint32_t i = 0; i < node.num_args; i++)
        is_plain &= !ir_type_is_matrix(ir_type_of(g, ir_arg(g, value, i)));
    if (!is_plain || node.num_args > 3)
        return ir_component(g, value, index);
    ir_ref args[3];
    for (uint32_t i = 0; i < node.num_args; i++) {
        args[i] = ir_arg(g, value, i);
        if (ir_type_info(ir_type_of(g, args[i]))->components > 1)
            args[i] = component(g, args[i], index, depth - 1);
    }
    return ir_copy_as(g, value, ir_type_info(node.type)->scalar, node.attr, args, node.num_args);
}

static ir_ref facet_of(const struct leaf *leaf)
{
    return closure_call(leaf->tree->shader, leaf->tree->host, leaf->ref, LEAF_FACET, NULL);
}

/* A component of an input, as much of it as the leaf's facet has. */
static ir_ref facet_part(const struct leaf *leaf, ir_ref value, unsigned index)
{
    struct ir_graph *g = leaf->tree->graph;
    ir_ref share = component(g, facet_of(leaf), 3, MAX_DEPTH);
    return ir_op2(g, IR_MUL, component(g, value, index, MAX_DEPTH), share);
}

/* An argument that is no input; 0: it is one. */
static ir_ref other_argument(const struct leaf *leaf, const struct argument *argument)
{
    const struct osl_tree *t = leaf->tree;
    switch (argument->kind) {
    case ARGUMENT_TEXT: return word(leaf, argument->text);
    case ARGUMENT_INT: return ir_const_int(t->graph, argument->number);
    case ARGUMENT_FLOAT: return ir_const_float(t->graph, (float)argument->number);
    case ARGUMENT_GREY: return ir_const_splat(t->graph, IR_TYPE_VEC3, (float)argument->number);
    case ARGUMENT_ALBEDO: return closure_call(t->shader, t->host, leaf->ref, LEAF_ALBEDO, NULL);
    case ARGUMENT_FACET: return ir_convert(t->graph, IR_TYPE_VEC3, facet_of(leaf));
    default: return 0;
    }
}

static ir_ref argument(const struct leaf *leaf, const struct argument *argument)
{
    struct ir_graph *g = leaf->tree->graph;
    ir_ref other = other_argument(leaf, argument);
    if (other)
        return other;
    ir_ref value = argument->input == INPUT_white ? ir_const_splat(g, IR_TYPE_VEC3, 1.0f)
                                                  : leaf->inputs[argument->input];
    assert(value); /* a row names only inputs of its leaf */
    switch (argument->kind) {
    case ARGUMENT_X: return component(g, value, 0, MAX_DEPTH);
    case ARGUMENT_Y: return component(g, value, 1, MAX_DEPTH);
    case ARGUMENT_FACET_X: return facet_part(leaf, value, 0);
    case ARGUMENT_FACET_Y: return facet_part(leaf, value, 1);
    case ARGUMENT_FACING: return facing(leaf, value);
    case ARGUMENT_REFLECTED: return scattered(leaf, value, REFLECTED);
    case ARGUMENT_TRANSMITTED: return scattered(leaf, value, TRANSMITTED);
    case ARGUMENT_BENT: return bent_edge(leaf, value);
    case ARGUMENT_FACETS: return facets(leaf, value);
    default: assert(argument->kind == ARGUMENT_INPUT); return value;
    }
}

struct argument_list {
    ir_ref refs[32];
    unsigned len;
};

static void add_arguments(const struct leaf *leaf, const struct argument *from,
                          struct argument_list *out)
{
    for (; from->kind != ARGUMENT_END; from++) {
        assert(out->len < sizeof out->refs / sizeof *out->refs);
        out->refs[out->len++] = argument(leaf, from);
    }
}

/* ---- Closures of the table ---- */

static bool is_given(const struct leaf *leaf, const struct option *option)
{
    const struct osl_tree *t = leaf->tree;
    ir_ref value = leaf->inputs[option->input];
    struct ir_value constant;
    if (!value || !ir_get_const(t->graph, value, &constant))
        return value != 0;
    assert((constant.type == IR_TYPE_STRING) == (option->word != NULL));
    return option->word ? is_string(t, value, option->word)
                        : !osl_is_false(t, value) && !ir_const_is(t->graph, value, 0.0f);
}

static ir_ref side_call(struct leaf *leaf, const struct row *row, enum side side)
{
    struct argument_list list = {.len = 0};
    leaf->side = side;
    add_arguments(leaf, row->arguments, &list);
    if (row->option.arguments && is_given(leaf, &row->option))
        add_arguments(leaf, row->option.arguments, &list);
    return osl_call(leaf->tree, row->closure, ir_type_of(leaf->tree->graph, leaf->ref), list.refs,
                    list.len);
}

/* The increase of the reflectance of a leaf at a cosine. */
static ir_ref rise(const struct leaf *leaf, ir_ref cosine)
{
    struct shader *shader = leaf->tree->shader;
    struct ir_graph *g = shader->graph;
    const ir_ref *in = leaf->inputs;
    ir_ref edge = in[INPUT_color90] ? in[INPUT_color90] : ir_white(g),
           exponent = in[INPUT_exponent] ? in[INPUT_exponent] : ir_const_float(g, 5.0f);
    if (in[INPUT_color0])
        return FORMULA(shader, "mx_rise_schlick", in[INPUT_color0], edge, exponent, cosine);
    if (in[INPUT_extinction])
        return FORMULA(shader, "mx_rise_conductor", in[INPUT_ior], in[INPUT_extinction], cosine);
    return FORMULA(shader, "mx_rise_dielectric", in[INPUT_ior], cosine);
}

/* The reflectance of facets that send light back, over that facing the viewer. */
static ir_ref turned_factor(const struct leaf *leaf)
{
    struct ir_graph *g = leaf->tree->graph;
    ir_ref view = closure_view(leaf->tree->shader, leaf->tree->host);
    ir_ref cosine = FORMULA(leaf->tree->shader, "mx_rise_cosine", leaf->inputs[INPUT_normal], view);
    ir_ref more = rise(leaf, cosine);
    ir_ref one = ir_const_splat(g, ir_type_of(g, more), 1.0f);
    return ir_build(g, IR_SELECT, ir_type_of(g, more), 0, (ir_ref[]){leaf->turned, more, one}, 3);
}

/* The tint of transmission; NULL: the leaf of the row does not transmit. */
static const struct argument *transmitted_argument(const struct row *row)
{
    const struct argument *at = row->arguments;
    while (at->kind != ARGUMENT_END && at->kind != ARGUMENT_TRANSMITTED)
        at++;
    return at->kind == ARGUMENT_END ? NULL : at;
}

/*
 * One closure. For leaves that transmit, one closure per side if the sides differ in more than
 * tints. Light passes straight through a thin-walled shell, in the colour of transmission.
 */
static ir_ref row_call(struct leaf *leaf, const struct row *row)
{
    struct osl_tree *t = leaf->tree;
    const struct argument *tint = transmitted_argument(row);
    bool transmits = tint && scatters(leaf, TRANSMITTED),
         reflects = !tint || scatters(leaf, REFLECTED);
    ir_ref turned = reflects ? leaf->inputs[INPUT_retroreflective] : 0,
           thin = transmits ? t->thin : 0;
    leaf->turned = osl_is_false(t, turned) ? 0 : turned;
    ir_ref whole = leaf->turned && transmits ? 0 : side_call(leaf, row, BOTH_SIDES);
    ir_ref reflected = reflects && (!whole || thin) ? side_call(leaf, row, REFLECTED) : 0;
    if (leaf->turned) {
        ir_ref factor = turned_factor(leaf);
        whole = osl_scaled(t, whole, factor);
        reflected = osl_scaled(t, reflected, factor);
    }
    leaf->turned = 0;
    if (!whole)
        whole = osl_sum(t, reflected, side_call(leaf, row, TRANSMITTED));
    if (!thin)
        return whole;
    leaf->side = BOTH_SIDES;
    ir_ref color = argument(leaf, tint), straight = osl_scaled(t, osl_transparent(t), color),
           shell = osl_layered(t, reflected, straight);
    return osl_mixed(t, whole, shell, ir_convert(t->graph, IR_TYPE_FLOAT, thin));
}

/*
 * The closures below a slab have the weight that the front leaves. A closure that is seen from
 * behind reflects all light beyond the critical angle of the index that fits its f0, but a ray that
 * came straight through a surface is not inside of matter. No index fits 1 or 0, so from behind the
 * curve is a sum: f0 · 1 + (f90 - f0) (1 - cos)^5.
 */
static ir_ref seen_from_behind(struct leaf *leaf, const struct row *row)
{
    struct osl_tree *t = leaf->tree;
    struct ir_graph *g = t->graph;
    ir_ref f0 = leaf->inputs[INPUT_f0];
    ir_ref more = FORMULA(t->shader, "mx_rise_above", f0, leaf->inputs[INPUT_f90]);
    leaf->inputs[INPUT_f0] = leaf->inputs[INPUT_f90] = ir_const_splat(g, IR_TYPE_VEC3, 1.0f);
    ir_ref even = osl_scaled(t, row_call(leaf, row), f0);
    leaf->inputs[INPUT_f0] = ir_const_splat(g, IR_TYPE_VEC3, 0.0f);
    leaf->inputs[INPUT_f90] = more;
    return osl_sum(t, even, row_call(leaf, row));
}

static ir_ref closure_of_row(struct leaf *leaf, const struct row *row)
{
    struct osl_tree *t = leaf->tree;
    ir_ref front = row_call(leaf, row);
    if (!t->seen_through || !leaf->inputs[INPUT_f0])
        return front;
    ir_ref behind = seen_from_behind(leaf, row);
    return osl_mixed(t, front, behind, ir_convert(t->graph, IR_TYPE_FLOAT, osl_behind(t)));
}

/* ---- Leaves without a row: the value of their own functions for the current view ---- */

static ir_ref emission(struct osl_tree *t, ir_ref leaf)
{
    ir_ref radiance = closure_call(t->shader, t->host, leaf, LEAF_EMISSION, NULL);
    return radiance && !ir_const_is(t->graph, radiance, 0.0f) ? osl_emission(t, radiance) : 0;
}

static ir_ref medium(struct osl_tree *t, ir_ref leaf)
{
    struct ir_graph *g = t->graph;
    ir_ref zero = ir_const_splat(g, IR_TYPE_VEC3, 0.0f);
    ir_ref absorption = closure_call(t->shader, t->host, leaf, LEAF_ABSORPTION, NULL);
    ir_ref scattering = closure_call(t->shader, t->host, leaf, LEAF_SCATTERING, NULL);
    ir_ref anisotropy = closure_call(t->shader, t->host, leaf, LEAF_ANISOTROPY, NULL);
    absorption = absorption ? absorption : zero;
    ir_ref extinction = scattering ? ir_op2(g, IR_ADD, absorption, scattering) : absorption;
    ir_ref albedo = scattering ? ir_op2(g, IR_DIV, scattering, extinction) : zero;
    ir_ref args[3] = {albedo, extinction, anisotropy ? anisotropy : ir_const_float(g, 0.0f)};
    return osl_call(t, "anisotropic_vdf", IR_TYPE_VDF, args, 3);
}

/* A leaf in source: an expression or function whose operands and result are closures of OSL. */
static ir_ref source_leaf(struct osl_tree *t, ir_ref ref)
{
    struct ir_graph *g = t->graph;
    const struct source_leaf source = *closure_source(t->shader, ref);
    const struct ir_node node = *ir_get(g, ref);
    assert(source.convention == SOURCE_NATIVE);
    const struct shader_verbatim *verbatim = &t->shader->sources.calls.items[source.verbatim[0]];
    ir_ref *args = ARENA_ARRAY(t->shader->arena, ir_ref, node.num_args);
    for (unsigned i = 1; i < node.num_args; i++) {
        ir_ref arg = ir_arg(g, ref, i);
        bool is_closure = ir_type_is_closure(source.operand_types[i - 1]);
        ir_ref closure = is_closure && arg ? t->of[arg] : 0;
        if (is_closure)
            arg = closure ? closure : osl_emission(t, ir_const_splat(g, IR_TYPE_VEC3, 0.0f));
        args[i - 1] = arg;
    }
    uint32_t callee =
        ir_add_callee(g, (struct ir_callee){.kind = IR_CALLEE_VERBATIM,
                                            .index = source.verbatim[0],
                                            .name = g->callees.items[node.attr].name,
                                            .derivative = verbatim->needs_neighbours});
    ir_type_id type = verbatim->function ? IR_TYPE_VOID : node.type;
    ir_ref call = ir_build(g, IR_VERBATIM, type, callee, args, node.num_args - 1);
    return verbatim->function ? ir_build(g, IR_RESULT, node.type, 1, &call, 1) : call;
}

ir_ref osl_leaf(struct osl_tree *t, ir_ref ref)
{
    const struct ir_node node = *ir_get(t->graph, ref);
    if (closure_source(t->shader, ref))
        return source_leaf(t, ref);
    const uint32_t *functions = t->host->leaf_functions(t->host->user_data, node.attr);
    if (functions[LEAF_FACTOR] != LANG_NONE)
        return osl_scaled(t, t->of[ir_arg(t->graph, ref, node.num_args - 1)],
                          closure_call(t->shader, t->host, ref, LEAF_FACTOR, NULL));
    str_id family = t->graph->callees.items[node.attr].name;
    const struct row *row = find_row(str_text(t->shader->strings, family));
    ir_ref result = 0;
    bool is_clear =
        closure_has(t->shader, t->host, ref, LEAF_TRANSMITTANCE)
        && ir_const_is(t->graph, closure_call(t->shader, t->host, ref, LEAF_ALBEDO, NULL), 0.0f);
    if (is_clear) {
        return 0;
    } else if (row) {
        struct leaf leaf = {.tree = t, .ref = ref};
        find_inputs(&leaf);
        result = closure_of_row(&leaf, row);
        result = osl_scaled(t, result, closure_call(t->shader, t->host, ref, LEAF_TINT, NULL));
    } else if (node.type == IR_TYPE_EDF || functions[LEAF_EMISSION] != LANG_NONE) {
        result = emission(t, ref);
    } else if (node.type == IR_TYPE_VDF) {
        result = medium(t, ref);
    } else {
        result = osl_fitted(t, ref);
    }
    return osl_scaled(t, result, ir_arg(t->graph, ref, 0));
}
