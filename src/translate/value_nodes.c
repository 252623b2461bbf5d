// SPDX-License-Identifier: Apache-2.0
/*
 * The nodes that compute a value: one walk up the array of the IR, whose operands precede their
 * users.
 */
#include "translate/value_nodes.h"
#include "base/hash.h"

#include <math.h>

/* ---- Types ---- */

static const struct {
    const char *name;
    ir_type_id type;
} types[NUM_VALUE_TYPES] = {
    [VALUE_NONE] = {"", IR_TYPE_VOID},           [VALUE_BOOLEAN] = {"boolean", IR_TYPE_BOOL},
    [VALUE_INTEGER] = {"integer", IR_TYPE_INT},  [VALUE_FLOAT] = {"float", IR_TYPE_FLOAT},
    [VALUE_VECTOR2] = {"vector2", IR_TYPE_VEC2}, [VALUE_COLOR3] = {"color3", IR_TYPE_VEC3},
    [VALUE_VECTOR3] = {"vector3", IR_TYPE_VEC3}, [VALUE_COLOR4] = {"color4", IR_TYPE_VEC4},
    [VALUE_VECTOR4] = {"vector4", IR_TYPE_VEC4},
};

enum value_type value_type_of(const char *name)
{
    for (int type = VALUE_NONE + 1; type < NUM_VALUE_TYPES; type++)
        if (strcmp(types[type].name, name) == 0)
            return (enum value_type)type;
    return VALUE_NONE;
}

const char *value_type_name(enum value_type type)
{
    return types[type].name;
}

static bool is_color(enum value_type type)
{
    return type == VALUE_COLOR3 || type == VALUE_COLOR4;
}

static enum value_type type_of(ir_type_id type, bool as_color)
{
    for (int i = VALUE_NONE + 1; i < NUM_VALUE_TYPES; i++)
        if (types[i].type == type
            && (is_color((enum value_type)i) == as_color || types[i].type < IR_TYPE_VEC3))
            return (enum value_type)i;
    return VALUE_NONE;
}

struct operand value_zero(enum value_type type)
{
    return (struct operand){.kind = OPERAND_CONSTANT, .type = type, .value.type = types[type].type};
}

void value_write(const struct operand *constant, struct text *out)
{
    const struct ir_value *value = &constant->value;
    unsigned count = ir_type_components(value->type);
    for (unsigned i = 0; i < count; i++) {
        text_str(out, i ? ", " : "");
        if (constant->type == VALUE_BOOLEAN)
            text_str(out, value->w[i].u ? "true" : "false");
        else if (constant->type == VALUE_INTEGER)
            text_i32(out, value->w[i].i);
        else
            text_float(out, value->w[i].f);
    }
}

/* ---- Nodes ---- */

static bool equal_operands(const struct operand *a, const struct operand *b)
{
    if (a->kind != b->kind || a->type != b->type || a->index != b->index)
        return false;
    return a->kind != OPERAND_CONSTANT || ir_value_equal(&a->value, &b->value);
}

static bool equal_nodes(const struct value_node *a, const struct value_node *b)
{
    bool equal = a->type == b->type && a->num_inputs == b->num_inputs
                 && strcmp(a->category, b->category) == 0;
    for (unsigned i = 0; i < a->num_inputs && equal; i++)
        equal = equal_operands(&a->inputs[i], &b->inputs[i]);
    return equal;
}

static uint32_t hash_of(const struct value_node *node)
{
    uint32_t hash = hash_pair(hash_bytes(node->category, strlen(node->category)), node->type);
    for (unsigned i = 0; i < node->num_inputs; i++)
        hash = hash_pair(hash, hash_pair(node->inputs[i].kind, node->inputs[i].index));
    return hash;
}

static struct operand add_node(struct value_nodes *nodes, const struct value_node *node)
{
    uint32_t hash = hash_of(node), index = nodes->nodes.len;
    for (uint32_t at = hash, found; (found = table_next(&nodes->table, hash, &at));)
        if (equal_nodes(&nodes->nodes.items[found - 1], node))
            return (struct operand){.kind = OPERAND_NODE, .type = node->type, .index = found - 1};
    vec_push(nodes->arena, &nodes->nodes, *node);
    table_add(&nodes->table, nodes->arena, hash, index + 1);
    return (struct operand){.kind = OPERAND_NODE, .type = node->type, .index = index};
}

struct operand value_nodes_call(struct value_nodes *nodes, const char *category,
                                enum value_type type, const char *name0, struct operand input0,
                                const char *name1, struct operand input1)
{
    const struct value_node node = {.category = category,
                                    .type = type,
                                    .num_inputs = name1 ? 2 : 1,
                                    .names = {name0, name1},
                                    .inputs = {input0, input1}};
    return add_node(nodes, &node);
}

static struct operand constant(const struct ir_value *value, enum value_type type)
{
    return (struct operand){.kind = OPERAND_CONSTANT, .type = type, .value = *value};
}

static struct operand number(float value)
{
    const struct ir_value v = ir_value_float(value);
    return constant(&v, VALUE_FLOAT);
}

/* The operand with another type: a colour for a vector, a number for all channels. */
static struct operand converted(struct value_nodes *nodes, struct operand operand,
                                enum value_type type)
{
    if (operand.type == type)
        return operand;
    if (operand.kind == OPERAND_CONSTANT) {
        struct ir_value value = {.type = types[type].type};
        bool is_scalar = ir_type_components(operand.value.type) == 1;
        for (unsigned i = 0; i < ir_type_components(value.type); i++)
            value.w[i] = operand.value.w[is_scalar ? 0 : i];
        return constant(&value, type);
    }
    return value_nodes_call(nodes, "convert", type, "in", operand, NULL, operand);
}

/* ---- Ops ---- */

enum operand_rule { RULE_NONE, RULE_SAME, RULE_FLOATS, RULE_VECTORS, RULE_NUMBER };

static const struct row {
    const char *category;
    enum operand_rule rule;
    const char *inputs[3];
} rows[IR_NUM_OPS] = {
#define VALUE_NODE(OP, category, operands, ...) \
    [IR_##OP] = {category, RULE_##operands, {__VA_ARGS__}},
#include "translate/value_nodes.def"
#undef VALUE_NODE
};

/* One call of value_nodes_add. */
struct writing {
    struct value_nodes *nodes;
    const struct ir_graph *graph;
    uint8_t *colors;          /* by node: it is used as a colour */
    struct operand *operands; /* by node */
};

static struct operand arg(const struct writing *w, ir_ref ref, unsigned i)
{
    return w->operands[ir_arg(w->graph, ref, i)];
}

static enum value_type result_type(const struct writing *w, ir_ref ref)
{
    return type_of(ir_type_of(w->graph, ref), w->colors[ref]);
}

static bool are_floats(const struct operand *operands, unsigned count)
{
    bool are = count > 0;
    for (unsigned i = 0; i < count; i++)
        are = are && operands[i].type == VALUE_FLOAT;
    return are;
}

/*
 * Only the second operand may be a float where the other is none, and a constant reads better
 * there.
 */
static bool is_better_swapped(const struct writing *w, ir_ref ref)
{
    const struct ir_node *node = ir_get(w->graph, ref);
    if (node->num_args != 2 || !(node->op == IR_MUL || ir_op_info(node->op)->flags & OP_COMMUTES))
        return false;
    struct operand first = arg(w, ref, 0), second = arg(w, ref, 1);
    bool is_float = first.type == VALUE_FLOAT, is_other = second.type != VALUE_FLOAT;
    return (is_float && is_other) || (is_float == !is_other && first.kind == OPERAND_CONSTANT);
}

static struct operand write_row(const struct writing *w, ir_ref ref, const struct row *row)
{
    const struct ir_node *node = ir_get(w->graph, ref);
    struct value_node out = {.category = row->category, .num_inputs = node->num_args};
    bool is_plain = row->rule == RULE_VECTORS || row->rule == RULE_NUMBER;
    enum value_type operand_type =
        row->rule == RULE_NUMBER ? type_of(ir_type_of(w->graph, ir_arg(w->graph, ref, 0)), false)
        : is_plain               ? type_of(node->type, false)
                                 : result_type(w, ref);
    bool swaps = is_better_swapped(w, ref);
    for (unsigned i = 0; i < node->num_args; i++) {
        out.names[i] = row->inputs[i];
        out.inputs[i] = arg(w, ref, swaps ? 1 - i : i);
    }
    bool keeps_floats = row->rule == RULE_FLOATS && are_floats(out.inputs + 1, node->num_args - 1);
    out.type = row->rule == RULE_NUMBER ? VALUE_FLOAT : operand_type;
    for (unsigned i = 0; i < node->num_args; i++)
        if (i == 0 || !keeps_floats)
            out.inputs[i] = converted(w->nodes, out.inputs[i], operand_type);
    return add_node(w->nodes, &out);
}

/* bg, fg and mix; MaterialX has the foreground first, and the IR the background. */
static struct operand write_mix(const struct writing *w, ir_ref ref)
{
    enum value_type type = result_type(w, ref);
    struct operand amount = arg(w, ref, 2);
    if (amount.type != VALUE_FLOAT)
        amount = converted(w->nodes, amount, type);
    const struct value_node node = {.category = "mix",
                                    .type = type,
                                    .num_inputs = 3,
                                    .names = {"bg", "fg", "mix"},
                                    .inputs = {converted(w->nodes, arg(w, ref, 0), type),
                                               converted(w->nodes, arg(w, ref, 1), type), amount}};
    return add_node(w->nodes, &node);
}

/* ---- Conditions ---- */

/* A comparison of two numbers or booleans as a node compares them. */
struct comparison {
    const char *category; /* NULL: no node compares so */
    bool swaps, negates;
};

static struct comparison comparison_of(enum ir_op op)
{
    switch (op) {
    case IR_GT: return (struct comparison){"ifgreater", false, false};
    case IR_GE: return (struct comparison){"ifgreatereq", false, false};
    case IR_LT: return (struct comparison){"ifgreater", true, false};
    case IR_LE: return (struct comparison){"ifgreatereq", true, false};
    case IR_EQ: return (struct comparison){"ifequal", false, false};
    case IR_NE: return (struct comparison){"ifequal", false, true};
    default: return (struct comparison){0};
    }
}

static struct operand component(struct value_nodes *nodes, struct operand of, unsigned index)
{
    if (of.kind == OPERAND_CONSTANT)
        return number(of.value.w[index].f);
    const struct ir_value at = ir_value_int((int32_t)index);
    return value_nodes_call(nodes, "extract", VALUE_FLOAT, "in", of, "index",
                            constant(&at, VALUE_INTEGER));
}

static struct operand compare(struct value_nodes *nodes, const struct comparison *how,
                              struct operand left, struct operand right)
{
    struct operand is =
        value_nodes_call(nodes, how->category, VALUE_BOOLEAN, "value1", how->swaps ? right : left,
                         "value2", how->swaps ? left : right);
    return how->negates ? value_nodes_call(nodes, "not", VALUE_BOOLEAN, "in", is, NULL, is) : is;
}

/* A vector equals another if all its components do. */
static struct operand write_comparison(const struct writing *w, ir_ref ref)
{
    const struct comparison how = comparison_of(ir_get(w->graph, ref)->op);
    struct operand left = arg(w, ref, 0), right = arg(w, ref, 1);
    unsigned count = ir_type_components(ir_type_of(w->graph, ir_arg(w->graph, ref, 0)));
    if (count == 1)
        return compare(w->nodes, &how, left, right);
    struct operand all = {0};
    for (unsigned i = 0; i < count; i++) {
        struct operand a = component(w->nodes, left, i);
        struct operand one = compare(w->nodes, &how, a, component(w->nodes, right, i));
        all = i ? value_nodes_call(w->nodes, how.negates ? "or" : "and", VALUE_BOOLEAN, "in1", all,
                                   "in2", one)
                : one;
    }
    return all;
}

/* A choice of booleans has no node: (c and a) or (not c and b). */
static struct operand choose_boolean(struct value_nodes *nodes, struct operand condition,
                                     struct operand yes, struct operand no)
{
    struct operand first =
        value_nodes_call(nodes, "and", VALUE_BOOLEAN, "in1", condition, "in2", yes);
    struct operand otherwise =
        value_nodes_call(nodes, "not", VALUE_BOOLEAN, "in", condition, NULL, condition);
    struct operand second =
        value_nodes_call(nodes, "and", VALUE_BOOLEAN, "in1", otherwise, "in2", no);
    return value_nodes_call(nodes, "or", VALUE_BOOLEAN, "in1", first, "in2", second);
}

static struct operand write_choice(const struct writing *w, ir_ref ref)
{
    ir_ref condition = ir_arg(w->graph, ref, 0);
    enum value_type type = result_type(w, ref);
    struct operand yes = converted(w->nodes, arg(w, ref, 1), type);
    struct operand no = converted(w->nodes, arg(w, ref, 2), type);
    if (type == VALUE_BOOLEAN)
        return choose_boolean(w->nodes, w->operands[condition], yes, no);
    struct comparison how = comparison_of(ir_get(w->graph, condition)->op);
    const struct ir_value right = ir_value_bool(true);
    struct operand a = w->operands[condition], b = constant(&right, VALUE_BOOLEAN);
    bool is_scalar =
        how.category
        && ir_type_components(ir_type_of(w->graph, ir_arg(w->graph, condition, 0))) == 1;
    if (is_scalar) {
        a = arg(w, condition, how.swaps);
        b = arg(w, condition, !how.swaps);
    } else {
        how = (struct comparison){"ifequal", false, false};
    }
    const struct value_node node = {
        .category = how.category,
        .type = type,
        .num_inputs = 4,
        .names = {"value1", "value2", "in1", "in2"},
        .inputs = {a, b, how.negates ? no : yes, how.negates ? yes : no}};
    return add_node(w->nodes, &node);
}

/* ---- Building and taking apart ---- */

/* A vector of single channels. */
static struct operand combine(struct value_nodes *nodes, enum value_type type,
                              const struct operand *channels, unsigned count)
{
    static const char *const categories[] = {"combine2", "combine3", "combine4"};
    bool is_splat = true;
    for (unsigned i = 1; i < count; i++)
        is_splat = is_splat && equal_operands(&channels[0], &channels[i]);
    if (is_splat)
        return converted(nodes, channels[0], type);
    struct value_node node = {.category = categories[count - 2],
                              .type = type,
                              .num_inputs = count,
                              .names = {"in1", "in2", "in3", "in4"}};
    for (unsigned i = 0; i < count; i++)
        node.inputs[i] = channels[i];
    return add_node(nodes, &node);
}

static struct operand write_construct(const struct writing *w, ir_ref ref)
{
    const struct ir_node *node = ir_get(w->graph, ref);
    struct operand channels[4] = {0};
    unsigned count = 0, wanted = ir_type_components(node->type);
    for (unsigned i = 0; i < node->num_args; i++) {
        unsigned parts = ir_type_components(ir_type_of(w->graph, ir_arg(w->graph, ref, i)));
        for (unsigned k = 0; k < parts && count < wanted; k++)
            channels[count++] =
                parts == 1 ? arg(w, ref, i) : component(w->nodes, arg(w, ref, i), k);
    }
    for (; count < wanted; count++)
        channels[count] = channels[0];
    return combine(w->nodes, result_type(w, ref), channels, wanted);
}

static struct operand write_swizzle(const struct writing *w, ir_ref ref)
{
    uint32_t attr = ir_get(w->graph, ref)->attr;
    struct operand channels[4] = {0};
    unsigned count = attr >> 8;
    for (unsigned i = 0; i < count; i++)
        channels[i] = component(w->nodes, arg(w, ref, 0), attr >> 2 * i & 3);
    return count == 1 ? channels[0] : combine(w->nodes, result_type(w, ref), channels, count);
}

/* 1 where a number is at least its edge, else 0. */
static struct operand write_step(const struct writing *w, ir_ref ref)
{
    struct operand edge = arg(w, ref, 0), value = arg(w, ref, 1), channels[4] = {0};
    unsigned count = ir_type_components(ir_get(w->graph, ref)->type);
    for (unsigned i = 0; i < count; i++) {
        struct value_node node = {.category = "ifgreatereq",
                                  .type = VALUE_FLOAT,
                                  .num_inputs = 4,
                                  .names = {"value1", "value2", "in1", "in2"},
                                  .inputs = {value, edge, number(1.0f), number(0.0f)}};
        if (count > 1)
            node.inputs[0] = component(w->nodes, value, i);
        if (edge.type != VALUE_FLOAT)
            node.inputs[1] = component(w->nodes, edge, i);
        channels[i] = add_node(w->nodes, &node);
    }
    return count == 1 ? channels[0] : combine(w->nodes, result_type(w, ref), channels, count);
}

/* The operand that is a matrix; 0: there is none. */
static ir_ref matrix_of(const struct ir_graph *graph, ir_ref ref)
{
    ir_ref matrix = 0;
    for (unsigned i = 0; i < ir_get(graph, ref)->num_args; i++)
        if (ir_type_is_matrix(ir_type_of(graph, ir_arg(graph, ref, i))))
            matrix = ir_arg(graph, ref, i);
    return matrix;
}

/* A constant matrix times a vector, or a vector times the matrix: products with its rows or
 * columns. */
static bool write_product(const struct writing *w, ir_ref ref, ir_ref matrix, struct operand *out)
{
    struct ir_value value, row = {.type = ir_type_of(w->graph, ref)};
    enum value_type type = type_of(row.type, false);
    if (ir_get(w->graph, ref)->op != IR_MUL || !ir_get_const(w->graph, matrix, &value))
        return false;
    bool is_left = ir_arg(w->graph, ref, 0) == matrix;
    struct operand vector = converted(w->nodes, arg(w, ref, is_left), type), channels[4] = {0};
    unsigned count = ir_type_components(row.type);
    for (unsigned i = 0; i < count; i++) {
        for (unsigned k = 0; k < count; k++)
            row.w[k] = value.w[is_left ? k * count + i : i * count + k];
        channels[i] = value_nodes_call(w->nodes, "dotproduct", VALUE_FLOAT, "in1", vector, "in2",
                                       constant(&row, type));
    }
    *out = combine(w->nodes, type, channels, count);
    return true;
}

/* ---- The walk ---- */

/* An op without a node of its own, by others; false: there are none. */
static bool write_special(const struct writing *w, ir_ref ref, struct operand *out)
{
    const struct ir_node *node = ir_get(w->graph, ref);
    enum value_type type = result_type(w, ref);
    switch (node->op) {
    case IR_MIX: *out = write_mix(w, ref); return true;
    case IR_SELECT: *out = write_choice(w, ref); return type != VALUE_NONE;
    case IR_CONSTRUCT: *out = write_construct(w, ref); return type != VALUE_NONE;
    case IR_STEP: *out = write_step(w, ref); return type != VALUE_NONE;
    case IR_SWIZZLE: *out = write_swizzle(w, ref); return type != VALUE_NONE;
    case IR_CONVERT: *out = converted(w->nodes, arg(w, ref, 0), type); return type != VALUE_NONE;
    case IR_NEG:
        *out = value_nodes_call(w->nodes, "multiply", type, "in1",
                                converted(w->nodes, arg(w, ref, 0), type), "in2", number(-1.0f));
        return type != VALUE_NONE;
    case IR_GT:
    case IR_GE:
    case IR_LT:
    case IR_LE:
    case IR_EQ:
    case IR_NE: *out = write_comparison(w, ref); return true;
    default: return false;
    }
}

static bool is_value(ir_type_id type)
{
    return type < IR_NUM_TYPES && type_of(type, false) != VALUE_NONE;
}

/* No text of a document stands for other numbers. */
static bool is_finite(const struct ir_value *value)
{
    bool is = true;
    for (unsigned i = 0; ir_type_is_float(value->type) && i < ir_type_components(value->type); i++)
        is = is && isfinite(value->w[i].f);
    return is;
}

static bool write_one(const struct writing *w, ir_ref ref)
{
    const struct ir_node *node = ir_get(w->graph, ref);
    struct operand *out = &w->operands[ref];
    ir_ref matrix = matrix_of(w->graph, ref);
    if (node->op == IR_CONST && ir_type_is_matrix(node->type))
        return true; /* products with it have its numbers */
    if (!is_value(node->type))
        return false;
    if (matrix)
        return write_product(w, ref, matrix, out);
    if (node->op == IR_CONST) {
        struct ir_value value;
        ir_get_const(w->graph, ref, &value);
        *out = constant(&value, result_type(w, ref));
        return is_finite(&value);
    }
    if (node->num_args == 0)
        return out->type != VALUE_NONE;
    if (!rows[node->op].category)
        return write_special(w, ref, out);
    *out = write_row(w, ref, &rows[node->op]);
    return true;
}

/* Ops whose operands have the meaning of their result, so a colour is made of colours. */
static bool keeps_meaning(enum ir_op op)
{
    return op == IR_MIX || op == IR_SELECT || op == IR_NEG || rows[op].rule == RULE_SAME
           || rows[op].rule == RULE_FLOATS;
}

/* Reads the leaves. What is made of a colour is a colour, and then what a colour is made of. */
static void find_colors(struct writing *w, const uint8_t *needed, ir_ref root)
{
    for (ir_ref ref = 1; ref <= root; ref++) {
        const struct ir_node *node = ir_get(w->graph, ref);
        bool is_leaf = needed[ref] && node->num_args == 0 && node->op != IR_CONST
                       && w->nodes->leaf(w->nodes->user_data, w->graph, ref, &w->operands[ref]);
        w->colors[ref] |= is_leaf && is_color(w->operands[ref].type);
        for (unsigned i = 0; needed[ref] && i < node->num_args && keeps_meaning(node->op); i++)
            w->colors[ref] |= w->colors[ir_arg(w->graph, ref, i)];
    }
    for (ir_ref ref = root; ref > 0; ref--)
        if (needed[ref] && w->colors[ref] && keeps_meaning(ir_get(w->graph, ref)->op))
            for (unsigned i = 0; i < ir_get(w->graph, ref)->num_args; i++)
                w->colors[ir_arg(w->graph, ref, i)] = 1;
}

const char *value_nodes_add(struct value_nodes *nodes, const struct ir_graph *graph, ir_ref root,
                            enum value_type type, struct operand *out)
{
    struct arena *arena = nodes->arena;
    const uint8_t *needed = ir_mark(graph, &root, 1, arena);
    struct writing w = {nodes, graph, ARENA_ARRAY(arena, uint8_t, root + 1),
                        ARENA_ARRAY(arena, struct operand, root + 1)};
    w.colors[root] = is_color(type);
    find_colors(&w, needed, root);
    for (ir_ref ref = 1; ref <= root; ref++)
        if (needed[ref] && !write_one(&w, ref))
            return ir_get(graph, ref)->op == IR_CONST ? "inf"
                                                      : ir_op_info(ir_get(graph, ref)->op)->text;
    *out = converted(nodes, w.operands[root], type);
    return NULL;
}
