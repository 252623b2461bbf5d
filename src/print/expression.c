// SPDX-License-Identifier: Apache-2.0
/* Printing functions: names of locals, and expressions. */
#include "print/print_priv.h"

#include <assert.h>

/*
 * Names. Pruning moves declarations into outer scopes, so names from separate scopes may collide.
 * The later one then gets another name.
 */

static bool is_same(const char *a, const char *b)
{
    return a[0] == b[0] && strcmp(a, b) == 0;
}

/* Takes the names at file scope that the function uses: of callees, then of globals. */
static uint32_t num_outer(const struct printer *p)
{
    return p->fn->num_callees + p->fn->num_globals;
}

static const char *outer_name(const struct printer *p, uint32_t index)
{
    assert(index < num_outer(p));
    uint32_t id = ast_callees(p->layer, p->fn)[index];
    return index < p->fn->num_callees ? print_function_name(p->names, p->unit, id)
                                      : print_global_name(p->names, p->unit, id);
}

static bool is_taken(const struct printer *p, struct text_word name)
{
    for (uint32_t i = 0; i < p->num_visible; i++)
        if (is_same(p->locals[p->visible[i]].bytes, name.bytes))
            return true;
    for (uint32_t i = 0; i < num_outer(p); i++)
        if (is_same(outer_name(p, i), name.bytes))
            return true;
    return lang_syntax_is_reserved(p->style->syntax, name.bytes, name.len);
}

/* Makes "x_", "x_2", "x_3" from x, and "x_2" from x_, because GLSL reserves "__". */
static struct text_word variant(struct printer *p, struct text_word name, uint32_t number)
{
    bool ends_low = name.len && name.bytes[name.len - 1] == '_';
    struct text text;
    text_init(&text, p->out->arena);
    text_str(&text, lang_syntax_beginning(p->style->syntax, name.bytes));
    text_put(&text, name);
    if (!ends_low)
        text_char(&text, '_');
    if (ends_low || number > 1)
        text_u32(&text, number + ends_low);
    text_cstr(&text);
    return (struct text_word){text.data, text.len};
}

struct text_word print_free_name(struct printer *p, struct text_word wanted)
{
    struct text_word name = wanted;
    for (uint32_t number = 1; is_taken(p, name); number++)
        name = variant(p, wanted, number);
    return name;
}

void print_bring_into_scope(struct printer *p, uint32_t slot)
{
    assert(slot < p->fn->num_slots && p->num_visible < p->fn->num_slots);
    str_id id = ast_slot(p->layer, p->fn, slot)->name;
    struct text_word own = {str_text(p->unit->strings, id), str_len(p->unit->strings, id)};
    p->locals[slot] = print_free_name(p, own);
    p->visible[p->num_visible++] = slot;
}

void print_variable(struct printer *p, enum lang_phrase phrase, uint32_t slot)
{
    lang_print_variable(p->style, p->names, p->unit, phrase, ast_slot(p->layer, p->fn, slot)->type,
                        p->locals[slot], p->out);
}

/* The value of a local, or of a parameter, which may be a reference. */
static void print_local(struct printer *p, uint32_t slot)
{
    assert(slot < p->fn->num_slots);
    bool is_plain = p->has_results || ast_slot(p->layer, p->fn, slot)->mode == LANG_IN;
    if (is_plain)
        text_put(p->out, p->locals[slot]);
    else
        lang_put_phrase(p->style->phrases[PHRASE_REFERENCED], p->locals[slot], p->out);
}

/* Expressions */

static void print_list(struct printer *p, lang_ref ref)
{
    while (ref) {
        const struct lang_node *node = node_at(p, ref);
        print_expression(p, node, lang_argument_level(p->style->syntax));
        ref = node->next;
        if (ref)
            text_mem(p->out, ", ", 2);
    }
}

/* Writes the argument for a result. A reference that the function itself received is passed on. */
static void print_reference(struct printer *p, const struct lang_node *node)
{
    const char *phrase = p->style->phrases[PHRASE_REFERENCE];
    if (node->kind == LANG_VAR && ast_slot(p->layer, p->fn, node->a)->mode != LANG_IN) {
        text_put(p->out, p->locals[node->a]);
        return;
    }
    while (lang_next(&phrase, p->out))
        print_expression(p, node, LANG_PREC_UNARY);
}

void print_arguments(struct printer *p, const struct lang_node *call)
{
    const struct lang_unit *layer;
    const struct lang_function *callee = lang_function(p->unit, call->a, &layer);
    bool in_struct = p->style->syntax->results_in_struct, is_first = true;
    lang_ref ref = call->b;
    for (uint32_t i = 0; ref; i++) {
        const struct lang_node *node = node_at(p, ref);
        assert(i < callee->num_params);
        uint8_t mode = ast_slot(layer, callee, i)->mode;
        ref = node->next;
        if (in_struct && mode == LANG_OUT)
            continue;
        text_str(p->out, is_first ? "" : ", ");
        is_first = false;
        if (mode != LANG_IN && !in_struct)
            print_reference(p, node);
        else
            print_expression(p, node, lang_argument_level(p->style->syntax));
        if (node->type == IR_TYPE_SAMPLER && p->style->syntax->sampler_type) {
            text_str(p->out, ", ");
            print_expression(p, node, LANG_PREC_POSTFIX);
            text_str(p->out, LANG_SAMPLER_SUFFIX);
        }
    }
}

/* "make_uint_4" in a language without array constructors; NULL: it has them. */
static const char *array_maker(struct printer *p, ir_type_id type)
{
    struct lang_type_text text = lang_type_text(p->style, p->names, p->unit, type);
    const char *name = print_array_name(p->names, text);
    struct text maker;
    if (!name)
        return NULL;
    text_init(&maker, p->out->arena);
    text_fmt(&maker, "make_%s", name);
    return text_cstr(&maker);
}

void print_initialiser(struct printer *p, const struct lang_node *node)
{
    bool is_array = node->kind == LANG_OP && node->op == IR_CONSTRUCT
                    && ast_is_user_type(node->type)
                    && lang_user_type(p->unit, node->type, NULL)->array_length;
    if (!is_array) {
        print_expression(p, node, LANG_PREC_ASSIGN);
        return;
    }
    print_open_array(p->style, p->names, p->unit, node->type, p->out);
    print_list(p, node->a);
    text_char(p->out, p->style->syntax->array_braces ? '}' : ')');
}

static void print_construct(struct printer *p, const struct lang_node *node)
{
    bool is_array =
        ast_is_user_type(node->type) && lang_user_type(p->unit, node->type, NULL)->array_length;
    bool is_struct = ast_is_user_type(node->type) && !is_array;
    const char *maker = is_struct  ? print_maker(p->names, p->unit, node->type)
                        : is_array ? array_maker(p, node->type)
                                   : NULL;
    if (is_array && !maker) {
        print_initialiser(p, node);
        return;
    }
    bool braces = is_struct && !maker && p->style->syntax->struct_braces;
    if (maker)
        text_str(p->out, maker);
    else
        lang_print_type(p->style, p->names, p->unit, node->type, p->out);
    text_char(p->out, braces ? '{' : '(');
    print_list(p, node->a);
    text_char(p->out, braces ? '}' : ')');
}

static void print_swizzle(struct printer *p, const struct lang_node *node)
{
    assert(node->b >> 8 >= 1 && node->b >> 8 <= 4);
    print_expression(p, node_at(p, node->a), LANG_PREC_POSTFIX);
    text_char(p->out, '.');
    for (unsigned i = 0; i < node->b >> 8; i++)
        text_char(p->out, "xyzw"[node->b >> 2 * i & 3]);
}

static void print_member(struct printer *p, const struct lang_node *node)
{
    const struct lang_node *whole = node_at(p, node->a);
    print_expression(p, whole, LANG_PREC_POSTFIX);
    const struct lang_unit *layer;
    const struct ir_user_type *user = lang_user_type(p->unit, whole->type, &layer);
    assert(node->b < user->num_members);
    text_char(p->out, '.');
    text_str(p->out, lang_member_name(p->style, p->unit->strings,
                                      layer->members.items[user->first_member + node->b].name));
}

/* Writes a constant beside a vector as a vector if the style spreads constants (style.c). */
static inline void print_operand(struct printer *p, const struct lang_node *operand,
                                 ir_type_id wide, enum lang_precedence least)
{
    if (!wide || operand->kind != LANG_CONST || operand->type != IR_TYPE_FLOAT) {
        print_expression(p, operand, least);
        return;
    }
    text_put(p->out, lang_type_name(p->style, p->names, wide));
    text_char(p->out, '(');
    print_expression(p, operand, LANG_PREC_ASSIGN);
    text_char(p->out, ')');
}

static unsigned op_of(const struct lang_node *node)
{
    return node->kind == LANG_OP ? node->op : IR_NUM_OPS;
}

void print_form(struct printer *p, const struct lang_pieces *form, ir_type_id type,
                const struct lang_node *const *operands)
{
    bool is_vector = type >= IR_TYPE_VEC2 && type <= IR_TYPE_VEC4;
    ir_type_id wide = form->spreads && is_vector ? type : IR_TYPE_VOID;
    const struct lang_piece *piece = form->pieces, *end = piece + form->num;
    for (; piece < end; piece++) {
        if (piece->before.len)
            text_put(p->out, piece->before);
        if (piece->index == LANG_PIECE_TYPE)
            lang_print_type(p->style, p->names, p->unit, type, p->out);
        else
            print_operand(p, operands[piece->index], wide,
                          lang_least(form, piece, op_of(operands[piece->index])));
    }
    if (form->rest.len)
        text_put(p->out, form->rest);
}

static void print_formed(struct printer *p, const struct lang_pieces *form,
                         const struct lang_node *node, const struct lang_node *const *operands,
                         enum lang_precedence least)
{
    bool parenthesised = form->precedence < least;
    if (lang_is_operand(form)) {
        print_expression(p, operands[0], least);
        return;
    }
    if (parenthesised)
        text_char(p->out, '(');
    print_form(p, form, node->type, operands);
    if (parenthesised)
        text_char(p->out, ')');
}

static void print_op(struct printer *p, const struct lang_node *node, enum lang_precedence least)
{
    const struct lang_node *operands[4] = {node_at(p, node->a)};
    for (unsigned i = 1; i < 4 && operands[i - 1]->next; i++)
        operands[i] = node_at(p, operands[i - 1]->next);
    print_formed(p, lang_style_form(p->style, node->op), node, operands, least);
}

/* True if the text may repeat the expression. */
static bool is_named(const struct printer *p, const struct lang_node *node)
{
    while (node->kind == LANG_OP && node->op == IR_MEMBER)
        node = node_at(p, node->a);
    bool is_number = node->kind == LANG_CONST && !ast_is_user_type(node->type)
                     && ir_type_info(node->type)->components == 1;
    return node->kind == LANG_VAR || is_number;
}

const struct lang_pieces *print_typed_form(struct printer *p, enum ir_op op, uint32_t attr,
                                           ir_type_id type, const struct lang_node *const *operands,
                                           unsigned num_operands)
{
    assert(num_operands <= AST_MAX_OPERANDS);
    ir_type_id types[AST_MAX_OPERANDS];
    const union ir_word *constants[AST_MAX_OPERANDS];
    struct lang_use use = {.op = op,
                           .type = type,
                           .attr = attr,
                           .operands = types,
                           .num_operands = num_operands,
                           .constants = constants};
    for (unsigned i = 0; i < num_operands; i++) {
        bool is_constant = operands[i]->kind == LANG_CONST && !ast_is_user_type(operands[i]->type);
        constants[i] = is_constant ? ast_words(p->layer, operands[i]) : NULL;
        types[i] = operands[i]->type;
        use.named |= (uint32_t)is_named(p, operands[i]) << i;
    }
    return lang_typed_form(p->style->syntax, p->names, &use, p->out->arena);
}

static bool print_typed(struct printer *p, const struct lang_node *node, enum lang_precedence least)
{
    lang_ref refs[AST_MAX_OPERANDS];
    const struct lang_node *operands[AST_MAX_OPERANDS];
    unsigned n = ast_list(p->layer, node->a, refs, AST_MAX_OPERANDS);
    if (n > AST_MAX_OPERANDS) /* arrays and structs have no form that depends on types */
        return false;
    for (unsigned i = 0; i < n; i++)
        operands[i] = node_at(p, refs[i]);
    const struct lang_pieces *form =
        print_typed_form(p, node->op, node->b, node->type, operands, n);
    if (form)
        print_formed(p, form, node, operands, least);
    return form != NULL;
}

static void print_op_or_part(struct printer *p, const struct lang_node *node,
                             enum lang_precedence least)
{
    if (p->is_typed && print_typed(p, node, least))
        return;
    switch (node->op) {
    case IR_CONSTRUCT: print_construct(p, node); break;
    case IR_SWIZZLE: print_swizzle(p, node); break;
    case IR_MEMBER: print_member(p, node); break;
    default: print_op(p, node, least);
    }
}

void print_expression(struct printer *p, const struct lang_node *node, enum lang_precedence least)
{
    if (print_result_value(p, node))
        return;
    switch (node->kind) {
    case LANG_CONST:
        lang_print_value(p->style, p->unit->strings, node->type, ast_words(p->layer, node), least,
                         p->out);
        break;
    case LANG_VAR: print_local(p, node->a); break;
    case LANG_GLOBAL: text_str(p->out, print_global_name(p->names, p->unit, node->a)); break;
    case LANG_INPUT:
        text_str(p->out, "{{");
        text_str(p->out, str_text(p->unit->strings, ast_slot(p->layer, p->fn, node->a)->name));
        text_str(p->out, "}}");
        break;
    case LANG_CALL:
        text_str(p->out, print_function_name(p->names, p->unit, node->a));
        text_char(p->out, '(');
        print_arguments(p, node);
        text_char(p->out, ')');
        break;
    default: print_op_or_part(p, node, least);
    }
}
