// SPDX-License-Identifier: Apache-2.0
/* Types of operators, implicit conversions, assignable expressions. GLSL 4.50, 4.1.10 and 5.9. */
#include "parse/parse_priv.h"

#include <assert.h>

/* Conversions */

lang_ref check_cast(struct parser *p, lang_ref a, ir_type_id type)
{
    if (tree_type(p, a) == type)
        return a;
    uint32_t place = tree_place(p, a);
    struct ir_value from, to;
    if (tree_node(p, a)->kind == LANG_CONST && check_value(p, a, &from)
        && ir_eval_op(IR_CONVERT, type, 0, &from, 1, &to))
        return tree_const(p, &to, place);
    return tree_op(p, IR_CONVERT, type, 0, &a, 1, place);
}

lang_ref check_convert(struct parser *p, lang_ref a, ir_type_id type, const char *what)
{
    ir_type_id from = tree_type(p, a);
    if (check_converts(from, type))
        return check_cast(p, a, type);
    PARSE_TYPE_ERROR(p, tree_place(p, a), "%s is %s; %s was expected", what,
                     parse_type_text(p, from), parse_type_text(p, type));
    return 0;
}

bool check_unify(struct parser *p, lang_ref *args, unsigned num_args, unsigned min_rank)
{
    unsigned rank = min_rank;
    for (unsigned i = 0; i < num_args; i++)
        rank = check_rank_of(tree_type(p, args[i])) > rank ? check_rank_of(tree_type(p, args[i]))
                                                           : rank;
    for (unsigned i = 0; i < num_args; i++) {
        ir_type_id type = tree_type(p, args[i]);
        if (!check_rank_of(type) || check_rank_of(type) == rank)
            continue;
        if (check_with_rank(type, rank) == IR_TYPE_VOID)
            return false;
        args[i] = check_cast(p, args[i], check_with_rank(type, rank));
        if (!args[i])
            return false;
    }
    return true;
}

/* Operators */

lang_ref check_unary(struct parser *p, enum ir_op op, lang_ref a, uint32_t place)
{
    ir_type_id type = tree_type(p, a);
    bool fits = op == IR_NOT ? type == IR_TYPE_BOOL
                : op == IR_BITNOT
                    ? ir_type_scalar(type) == IR_TYPE_INT || ir_type_scalar(type) == IR_TYPE_UINT
                    : check_rank_of(type) != 0;
    if (!fits) {
        const char *text = op == IR_NOT ? "!" : op == IR_BITNOT ? "~" : op == IR_NEG ? "-" : "+";
        PARSE_TYPE_ERROR(p, place, "'%s' cannot be applied to %s", text, parse_type_text(p, type));
        return 0;
    }
    return op == IR_NUM_OPS ? a : tree_op(p, op, type, 0, &a, 1, place);
}

/*
 * The type of `a op b` after implicit conversions, which replace the operands; VOID if the types do
 * not match.
 */
static ir_type_id binary_type(struct parser *p, enum ir_op op, lang_ref operands[2])
{
    bool is_shift = op == IR_SHL || op == IR_SHR;
    ir_type_id types[2] = {tree_type(p, operands[0]), tree_type(p, operands[1])};
    if (check_rank_of(types[0]) && check_rank_of(types[1]) && !is_shift
        && !check_unify(p, operands, 2, 0))
        return IR_TYPE_VOID;
    types[0] = tree_type(p, operands[0]);
    types[1] = tree_type(p, operands[1]);
    return ir_op_result(op, types, 2);
}

static const char *symbol_text(enum ir_op op)
{
    for (int kind = 0; kind < TOKEN_NUM_KINDS; kind++) {
        const struct symbol *symbol = lex_symbol((enum token_kind)kind);
        if (symbol && symbol->role == SYMBOL_BINARY && symbol->op == op)
            return symbol->text;
    }
    return "?";
}

lang_ref check_binary(struct parser *p, enum ir_op op, lang_ref a, lang_ref b, uint32_t place)
{
    lang_ref operands[2] = {a, b};
    ir_type_id type = binary_type(p, op, operands);
    if (type != IR_TYPE_VOID)
        return tree_op(p, op, type, 0, operands, 2, place);
    PARSE_TYPE_ERROR(p, place, "'%s' cannot be applied to %s and %s", symbol_text(op),
                     parse_type_text(p, tree_type(p, a)), parse_type_text(p, tree_type(p, b)));
    return 0;
}

lang_ref check_select(struct parser *p, lang_ref condition, lang_ref a, lang_ref b, uint32_t place)
{
    condition = check_convert(p, condition, IR_TYPE_BOOL, "the condition");
    if (!condition)
        return 0;
    lang_ref operands[3] = {condition, a, b};
    if (check_rank_of(tree_type(p, a)) && check_rank_of(tree_type(p, b)))
        check_unify(p, operands + 1, 2, 0);
    ir_type_id type = tree_type(p, operands[1]);
    bool is_value = type >= IR_TYPE_FIRST_USER
                    || (type != IR_TYPE_STRING && ir_type_info(type)->components > 0);
    if (!is_value || tree_type(p, operands[2]) != type) {
        PARSE_TYPE_ERROR(p, place, "'?:' cannot choose between %s and %s",
                         parse_type_text(p, tree_type(p, a)), parse_type_text(p, tree_type(p, b)));
        return 0;
    }
    return tree_op(p, IR_SELECT, type, 0, operands, 3, place);
}

/* Parts */

static lang_ref check_struct_member(struct parser *p, lang_ref a, const struct token *name)
{
    const struct lang_unit *layer;
    const struct ir_user_type *user = lang_user_type(p->unit, tree_type(p, a), &layer);
    assert(user->first_member + user->num_members <= layer->members.len);
    str_id id = str_find(p->unit->strings, name->text, name->len);
    const char **names = ARENA_ARRAY(p->unit->arena, const char *, user->num_members);
    for (uint32_t i = 0; i < user->num_members; i++) {
        const struct ir_member *member = &layer->members.items[user->first_member + i];
        if (id && member->name == id)
            return tree_op(p, IR_MEMBER, member->type, i, &a, 1, parse_place(name));
        names[i] = parse_text(p, member->name);
    }
    const char *word = parse_token_text(p, name);
    const char *what = parse_say(p, "member of %s", parse_type_text(p, tree_type(p, a)));
    PARSE_ERROR(p, parse_where_token(p, name), lang_unknown, what, word,
                diag_suggest(p->diags, word, names, user->num_members));
    return 0;
}

/* The components that ".name" selects; 0 if it is no swizzle of a vector of this size. */
static unsigned read_swizzle(const struct token *name, unsigned size, uint8_t out_components[4])
{
    assert(size >= 1 && size <= 4);
    static const char *const sets[] = {"xyzw", "rgba", "stpq"};
    if (name->len > 4)
        return 0;
    for (size_t set = 0; set < 3; set++) {
        unsigned n = 0;
        for (; n < name->len; n++) {
            const char *found = memchr(sets[set], name->text[n], size);
            if (!found)
                break;
            out_components[n] = (uint8_t)(found - sets[set]);
        }
        if (n == name->len)
            return n;
    }
    return 0;
}

lang_ref check_member(struct parser *p, lang_ref a, const struct token *name)
{
    ir_type_id type = tree_type(p, a);
    ir_type_id element;
    uint32_t length;
    if (type >= IR_TYPE_FIRST_USER && !check_is_array(p, type, &element, &length))
        return check_struct_member(p, a, name);
    uint8_t components[4];
    bool has_components =
        check_is_vector(type) || (check_rank_of(type) && !ir_type_is_matrix(type));
    unsigned size = has_components ? ir_type_info(type)->components : 0;
    unsigned count = size ? read_swizzle(name, size, components) : 0;
    if (!count || ir_type_vector(ir_type_scalar(type), count) == IR_TYPE_VOID) {
        PARSE_ERROR(
            p, parse_where_token(p, name), lang_type,
            parse_say(p, "%s has no '.%s'", parse_type_text(p, type), parse_token_text(p, name)));
        return 0;
    }
    if (size == 1) /* only GLSL 4.20 and later allow swizzles of scalars */
        return count == 1 ? a
                          : tree_op(p, IR_CONSTRUCT, ir_type_vector(type, count), 0, &a, 1,
                                    parse_place(name));
    return tree_swizzle(p, a, components, count, parse_place(name));
}

static bool indexed(struct parser *p, ir_type_id type, ir_type_id *out_element,
                    uint32_t *out_length)
{
    if (type >= IR_TYPE_FIRST_USER)
        return check_is_array(p, type, out_element, out_length);
    const struct ir_type_info *info = ir_type_info(type);
    if (!check_is_vector(type) && !ir_type_is_matrix(type))
        return false;
    unsigned length = info->columns > 1 ? info->columns : info->components;
    *out_length = length;
    assert(info->components % length == 0);
    *out_element = ir_type_vector(info->scalar, info->components / length);
    return true;
}

lang_ref check_index(struct parser *p, lang_ref a, lang_ref index, uint32_t place)
{
    ir_type_id element;
    uint32_t length;
    if (!indexed(p, tree_type(p, a), &element, &length)) {
        PARSE_TYPE_ERROR(p, place, "%s cannot be indexed", parse_type_text(p, tree_type(p, a)));
        return 0;
    }
    ir_type_id type = tree_type(p, index);
    if (type != IR_TYPE_INT && type != IR_TYPE_UINT) {
        PARSE_TYPE_ERROR(p, tree_place(p, index), "an index is %s; int was expected",
                         parse_type_text(p, type));
        return 0;
    }
    struct ir_value value;
    /* a negative int becomes a large uint */
    if (check_value(p, index, &value) && value.w[0].u >= length) {
        PARSE_TYPE_ERROR(p, tree_place(p, index), "index %d is outside of %s", value.w[0].i,
                         parse_type_text(p, tree_type(p, a)));
        return 0;
    }
    lang_ref operands[2] = {a, index};
    return tree_op(p, IR_INDEX, element, 0, operands, 2, place);
}

/* Assignment */

static bool repeats_component(uint32_t attr)
{
    assert(attr >> 8 <= 4);
    unsigned seen = 0;
    for (unsigned i = 0; i < attr >> 8; i++) {
        unsigned bit = 1u << (attr >> (2 * i) & 3);
        if (seen & bit)
            return true;
        seen |= bit;
    }
    return false;
}

static bool refuse_assignment(struct parser *p, lang_ref target, const char *doing, const char *why)
{
    PARSE_ERROR(p, parse_where(p, tree_place(p, target), 0), lang_not_assignable, doing, why);
    return false;
}

static const struct local *local_of_slot(const struct parser *p, uint32_t slot)
{
    for (uint32_t i = p->locals.len; i-- > 0;)
        if (p->locals.items[i].slot == slot)
            return &p->locals.items[i];
    return NULL;
}

bool check_assignable(struct parser *p, lang_ref target, const char *doing)
{
    const struct lang_node *node = tree_node(p, target);
    while (node->kind == LANG_OP) {
        bool is_part = node->op == IR_SWIZZLE || node->op == IR_INDEX || node->op == IR_MEMBER;
        if (!is_part)
            return refuse_assignment(p, target, doing, "it is the result of an operation");
        if (node->op == IR_SWIZZLE && repeats_component(node->b))
            return refuse_assignment(p, target, doing, "a component stands in it twice");
        node = tree_node(p, node->a);
    }
    if (node->kind == LANG_GLOBAL && p->is_program
        && lang_global(p->unit, node->a, NULL)->kind != LANG_GLOBAL_CONST)
        return true;
    if (node->kind == LANG_GLOBAL) {
        static const char *const reasons[] = {[LANG_GLOBAL_CONST] = "it is a constant",
                                              [LANG_GLOBAL_UNIFORM] = "it is a uniform",
                                              [LANG_GLOBAL_STREAM] = "it is an input of the stage",
                                              [LANG_GLOBAL_OPTION] = "it is an option"};
        return refuse_assignment(p, target, doing,
                                 reasons[lang_global(p->unit, node->a, NULL)->kind]);
    }
    if (node->kind != LANG_VAR)
        return refuse_assignment(p, target, doing,
                                 node->kind == LANG_CONST   ? "it is a constant"
                                 : node->kind == LANG_INPUT ? "it is an input"
                                                            : "it is the result of a call");
    const struct local *local = local_of_slot(p, node->a);
    if (local && local->read_only)
        return refuse_assignment(p, target, doing,
                                 parse_say(p, "'%s' is const", parse_text(p, local->name)));
    assert(p->first_slot + node->a < p->unit->slots.len);
    p->unit->slots.items[p->first_slot + node->a].assigned = 1;
    return true;
}

lang_ref check_assign(struct parser *p, enum ir_op op, lang_ref target, lang_ref value,
                      uint32_t place)
{
    if (!check_assignable(p, target, "assign"))
        return 0;
    ir_type_id type = tree_type(p, target);
    if (op == IR_NUM_OPS) {
        value = check_convert(p, value, type, "the value");
    } else {
        lang_ref operands[2] = {target, value};
        bool fits = binary_type(p, op, operands) == type && operands[0] == target;
        if (!fits)
            PARSE_TYPE_ERROR(p, place, "'%s=' cannot be applied to %s and %s", symbol_text(op),
                             parse_type_text(p, type), parse_type_text(p, tree_type(p, value)));
        value = fits ? operands[1] : 0;
    }
    if (!value)
        return 0;
    lang_ref ref = tree_new(p, LANG_ASSIGN, op, IR_TYPE_VOID, place);
    tree_node(p, ref)->a = target;
    tree_node(p, ref)->b = value;
    return ref;
}
