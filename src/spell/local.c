// SPDX-License-Identifier: Apache-2.0
/*
 * Names of locals. A local has the name that the library or the document gives its value: `H`,
 * `alpha`, `coat_roughness`. If several locals of a function want one name, each has its origin as
 * prefix: `coat_alpha`, `metal_alpha`. If the value has no name, its operation gives the name:
 * `n_dot_l`, `clamped_roughness`, `metal_product`. A value with several origins has no prefix.
 */
#include "spell/spell.h"

#include "base/num.h"

#include <assert.h>
#include <ctype.h>
#include <stdlib.h>

enum { MAX_OPERAND_NAME = 24 };

/*
 * The words for the result of an operation: alone, and as prefix of the name of the operand, if
 * only one operand is not a constant and the words differ.
 */
static const struct {
    const char *alone, *of_operand;
} nouns[IR_NUM_OPS] = {
    [IR_NEG] = {"negative"},
    [IR_NOT] = {"is_not", "not"},
    [IR_ADD] = {"sum", "shifted"},
    [IR_SUB] = {"difference", "shifted"},
    [IR_MUL] = {"product", "scaled"},
    [IR_DIV] = {"ratio", "scaled"},
    [IR_REM] = {"remainder"},
    [IR_LT] = {"is_below"},
    [IR_LE] = {"is_below"},
    [IR_GT] = {"is_above"},
    [IR_GE] = {"is_above"},
    [IR_EQ] = {"is_equal"},
    [IR_NE] = {"is_different"},
    [IR_LAND] = {"are_both"},
    [IR_LOR] = {"is_any"},
    [IR_LXOR] = {"is_one"},
    [IR_SELECT] = {"choice"},
    [IR_CONVERT] = {"converted"},
    [IR_CONSTRUCT] = {"vector"},
    [IR_SWIZZLE] = {"part", "part_of"},
    [IR_INDEX] = {"element", "element_of"},
    [IR_MEMBER] = {"member", "member_of"},
    [IR_RADIANS] = {"angle"},
    [IR_DEGREES] = {"angle"},
    [IR_SIN] = {"sine"},
    [IR_COS] = {"cosine_of"},
    [IR_TAN] = {"slope"},
    [IR_ASIN] = {"angle"},
    [IR_ACOS] = {"angle"},
    [IR_ATAN] = {"angle"},
    [IR_ATAN2] = {"angle"},
    [IR_POW] = {"power", "power_of"},
    [IR_EXP] = {"exponential"},
    [IR_EXP2] = {"exponential"},
    [IR_LOG] = {"logarithm"},
    [IR_LOG2] = {"logarithm"},
    [IR_SQRT] = {"root", "root_of"},
    [IR_RSQRT] = {"inverse_root"},
    [IR_ABS] = {"absolute"},
    [IR_SIGN] = {"sign_of"},
    [IR_FLOOR] = {"whole"},
    [IR_CEIL] = {"whole"},
    [IR_ROUND] = {"rounded"},
    [IR_TRUNC] = {"whole"},
    [IR_FRACT] = {"fraction"},
    [IR_MOD] = {"remainder"},
    [IR_MIN] = {"lesser", "limited"},
    [IR_MAX] = {"greater", "limited"},
    [IR_CLAMP] = {"clamped"},
    [IR_MIX] = {"blend", "blended"},
    [IR_STEP] = {"threshold"},
    [IR_SMOOTHSTEP] = {"transition", "smooth"},
    [IR_LENGTH] = {"magnitude"},
    [IR_DISTANCE] = {"separation"},
    [IR_DOT] = {"cosine"},
    [IR_CROSS] = {"cross_product"},
    [IR_NORMALIZE] = {"direction", "unit"},
    [IR_FACEFORWARD] = {"facing"},
    [IR_REFLECT] = {"reflected"},
    [IR_REFRACT] = {"refracted"},
    [IR_TRANSPOSE] = {"transposed"},
    [IR_INVERSE] = {"inverted"},
    [IR_DFDX] = {"slope_x", "slope_x_of"},
    [IR_DFDY] = {"slope_y", "slope_y_of"},
    [IR_FWIDTH] = {"footprint", "footprint_of"},
    [IR_TEX] = {"texel"},
    [IR_TEX_LOD] = {"texel"},
    [IR_TEX_GRAD] = {"texel"},
    [IR_TEX_FETCH] = {"texel"},
    [IR_TEX_SIZE] = {"texture_size"},
    [IR_CONST] = {"constant"},
    [IR_LEAF] = {"lobe"},
    [IR_CLOSURE_ADD] = {"lobes"},
    [IR_CLOSURE_MIX] = {"lobes"},
    [IR_CLOSURE_SCALE] = {"lobes"},
    [IR_LAYER] = {"layers"},
    [IR_SLAB] = {"slab"},
    [IR_SLAB_LAYER] = {"layers"},
};

static struct spell_name without(struct spell_name name, size_t len)
{
    assert(len <= name.len);
    return (struct spell_name){name.text + len, name.len - len};
}

static struct spell_name word(const char *text)
{
    return (struct spell_name){text, strlen(text)};
}

static struct spell_name joined(struct spell *spell, struct spell_name a, const char *between,
                                struct spell_name b)
{
    struct text text;
    text_init(&text, spell->scratch);
    text_mem(&text, a.text, a.len);
    text_str(&text, between);
    text_mem(&text, b.text, b.len);
    return (struct spell_name){text_cstr(&text), text.len};
}

/* "coat" of the input whose path is "NG/metal/coat", "alphaThreshold" of u_alphaThreshold. */
static struct spell_name input_name(const struct spell *spell,
                                    const struct shader_variable *variable)
{
    struct spell_name name = spell_name_of(spell->shader->strings, variable->name);
    if (!variable->path)
        return strncmp(name.text, "u_", 2) == 0 ? without(name, 2) : name;
    struct spell_name path = spell_name_of(spell->shader->strings, variable->path);
    const char *slash = strrchr(path.text, '/');
    return slash ? without(path, (size_t)(slash + 1 - path.text)) : path;
}

/* "noise" of the function mx_noise. */
static struct spell_name bare_name(const struct spell *spell, str_id id)
{
    struct spell_name name = spell_name_of(spell->shader->strings, id);
    return strncmp(name.text, "mx_", 3) == 0 ? without(name, 3) : name;
}

/* The name of an operand in the code above; no text if the operand is an expression. */
static struct spell_name operand_name(const struct spell *spell, ir_ref ref)
{
    assert(spell->local_of[ref] <= spell->let_names.len);
    const struct ir_node *node = ir_get(spell->shader->graph, ref);
    str_id own = ir_label(spell->shader->graph, ref)->name;
    /* a name that describes another description says nothing */
    if (spell->local_of[ref] && (own || node->op == IR_CONTEXT))
        return spell->let_names.items[spell->local_of[ref] - 1];
    if (node->op == IR_UNIFORM)
        return input_name(spell, &spell->shader->interface.variables.items[node->attr]);
    return own ? bare_name(spell, own) : (struct spell_name){0};
}

/* The only operand that is not a constant; 0: there are several. */
static ir_ref only_operand(const struct ir_graph *graph, ir_ref ref)
{
    ir_ref only = 0;
    for (uint32_t i = 0; i < ir_get(graph, ref)->num_args; i++) {
        ir_ref arg = ir_arg(graph, ref, i);
        if (ir_is_const(graph, arg))
            continue;
        if (only && only != arg)
            return 0;
        only = arg;
    }
    return only;
}

/* "n_dot_v" for the normal and the view direction; no text if they have no short names. */
static struct spell_name dot_name(struct spell *spell, ir_ref ref)
{
    assert(ir_get(spell->shader->graph, ref)->num_args == 2);
    struct spell_name a = operand_name(spell, ir_arg(spell->shader->graph, ref, 0)),
                      b = operand_name(spell, ir_arg(spell->shader->graph, ref, 1));
    if (!a.len || !b.len || a.len + b.len > MAX_OPERAND_NAME)
        return (struct spell_name){0};
    struct spell_name name = joined(spell, a, "_dot_", b);
    char *lower = arena_strndup(spell->scratch, name.text, name.len);
    for (size_t i = 0; i < name.len; i++)
        lower[i] = (char)tolower((unsigned char)lower[i]);
    return (struct spell_name){lower, name.len};
}

/* "clamped_roughness": the operation, and the name of its only variable operand. */
static struct spell_name name_by_operand(struct spell *spell, ir_ref ref)
{
    const struct ir_graph *graph = spell->shader->graph;
    enum ir_op op = (enum ir_op)ir_get(graph, ref)->op;
    if (op == IR_DOT)
        return dot_name(spell, ref);
    ir_ref only = only_operand(graph, ref);
    struct spell_name operand = only ? operand_name(spell, only) : (struct spell_name){0};
    if (!operand.len || operand.len > MAX_OPERAND_NAME)
        return (struct spell_name){0};
    const char *verb = nouns[op].of_operand ? nouns[op].of_operand : nouns[op].alone;
    if (op == IR_GT && ir_const_is(graph, ir_arg(graph, ref, 1), 0.0f))
        verb = "has";
    else if (op == IR_SUB && ir_const_is(graph, ir_arg(graph, ref, 0), 1.0f))
        verb = "one_minus";
    return verb ? joined(spell, word(verb), "_", operand) : (struct spell_name){0};
}

/* "ggx_lobe" of the struct mx_GgxLobe. */
static struct spell_name struct_name(const struct spell *spell, str_id id)
{
    struct spell_name type = bare_name(spell, id);
    struct text name;
    text_init(&name, spell->scratch);
    for (size_t i = 0; i < type.len; i++) {
        bool is_capital = isupper((unsigned char)type.text[i]) != 0;
        text_str(&name, i && is_capital ? "_" : "");
        text_char(&name, (char)tolower((unsigned char)type.text[i]));
    }
    return (struct spell_name){text_cstr(&name), name.len};
}

static struct spell_name name_by_operation(const struct spell *spell, ir_ref ref)
{
    const struct ir_graph *graph = spell->shader->graph;
    const struct ir_user_type *user_types = graph->user_types.items;
    const struct ir_node *node = ir_get(graph, ref);
    switch (node->op) {
    case IR_CALL: {
        uint32_t id = shader_callee(spell->shader, ref);
        return bare_name(spell, lang_function(spell->shader->unit, id, NULL)->name);
    }
    case IR_GRAPH_CALL: return bare_name(spell, graph->functions.items[node->attr].name);
    case IR_CONSTRUCT:
        if (node->type < IR_TYPE_FIRST_USER || !user_types[node->type - IR_TYPE_FIRST_USER].name)
            return word(nouns[IR_CONSTRUCT].alone);
        return struct_name(spell, user_types[node->type - IR_TYPE_FIRST_USER].name);
    default: return word(nouns[node->op].alone ? nouns[node->op].alone : "value");
    }
}

/* ---- Names that several locals want ---- */

/* 0: it declares nothing, or what has no name. */
static str_id declared_name(const struct shader *shader, const struct effect *effect)
{
    return effect->kind == EFFECT_LET   ? ir_label(shader->graph, effect->value)->name
           : effect->kind == EFFECT_VAR ? shader->effects.locals.items[effect->index].name
                                        : 0;
}

void spell_plan_locals(struct spell *spell, const struct effect_list *statements)
{
    spell->wanted_names.len = 0;
    for (uint32_t i = 0; i < statements->len; i++) {
        str_id name = declared_name(spell->shader, &statements->items[i]);
        if (name)
            vec_push(spell->scratch, &spell->wanted_names, name);
    }
    num_sort(spell->wanted_names.items, spell->wanted_names.len);
}

static bool is_wanted_twice(const struct spell *spell, str_id name)
{
    const str_id *first = spell->wanted_names.items, *end = first + spell->wanted_names.len;
    const str_id *found = bsearch(&name, first, spell->wanted_names.len, sizeof name, num_compare);
    return found && ((found > first && found[-1] == name) || (found + 1 < end && found[1] == name));
}

/* "coat_alpha" of the alpha of the node "coat". */
static struct spell_name with_origin(struct spell *spell, ir_ref ref, struct spell_name name)
{
    const struct ir_graph *graph = spell->shader->graph;
    str_id origin = graph->origins.items[ir_get(graph, ref)->origin].name;
    if (!origin || ir_label(graph, ref)->is_shared)
        return name;
    struct spell_name owner = spell_name_of(spell->shader->strings, origin);
    bool is_in_it = name.len >= owner.len && memcmp(name.text, owner.text, owner.len) == 0;
    return is_in_it ? name : joined(spell, owner, "_", name);
}

struct spell_name spell_call_base(struct spell *spell, ir_ref call)
{
    const struct ir_graph *graph = spell->shader->graph;
    const struct ir_label *label = ir_label(graph, call);
    str_id origin = graph->origins.items[ir_get(graph, call)->origin].name;
    bool is_own = origin && !label->name && !label->is_shared
                  && !spell->shader->interface.rules.neutral_names;
    return is_own ? spell_name_of(spell->shader->strings, origin) : spell_local_base(spell, call);
}

struct spell_name spell_local_base(struct spell *spell, ir_ref ref)
{
    const struct ir_node *node = ir_get(spell->shader->graph, ref);
    if (spell->shader->interface.rules.neutral_names)
        return word("v");
    if (node->op == IR_CONTEXT && !ir_is_light_member(node->attr))
        return word("light");
    if (node->op == IR_CONTEXT || node->op == IR_UNIFORM) {
        const struct shader_variable *variable =
            &spell->shader->interface.variables.items[node->attr];
        if (node->op == IR_UNIFORM)
            return input_name(spell, variable);
        return joined(spell, word("light"), "_",
                      spell_name_of(spell->shader->strings, variable->name));
    }
    const struct ir_label *label = ir_label(spell->shader->graph, ref);
    if (label->name) {
        struct spell_name name = bare_name(spell, label->name);
        bool is_own = label->rank == IR_NAME_RESULT || !is_wanted_twice(spell, label->name);
        return is_own ? name : with_origin(spell, ref, name);
    }
    struct spell_name name = name_by_operand(spell, ref);
    return name.len ? name : with_origin(spell, ref, name_by_operation(spell, ref));
}
