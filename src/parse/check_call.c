// SPDX-License-Identifier: Apache-2.0
/*
 * Calls: the op table resolves built-in functions, overload resolution the functions of the file.
 */
#include "parse/parse_priv.h"

#include <assert.h>

/* Built-in functions that share their name in the language with another op. */
static const struct {
    uint8_t op; /* enum ir_op */
    const char *name;
    unsigned num_args;
} renamed[] = {
    {IR_ATAN2, "atan", 2},
    {IR_NOT_EACH, "not", 1},
};
enum { NUM_RENAMED = sizeof renamed / sizeof *renamed };

static bool is_text(const char *text, const char *name, size_t len)
{
    return strlen(text) == len && memcmp(text, name, len) == 0;
}

/* IR_NUM_OPS if there is no such built-in. */
static enum ir_op find_builtin(const char *name, size_t len, unsigned num_args)
{
    for (unsigned i = 0; i < NUM_RENAMED; i++)
        if (renamed[i].num_args == num_args && is_text(renamed[i].name, name, len))
            return (enum ir_op)renamed[i].op;
    for (int op = 0; op < IR_NUM_OPS; op++) {
        const struct ir_op_info *info = ir_op_info((enum ir_op)op);
        bool is_renamed = op == IR_ATAN2 || op == IR_NOT_EACH;
        if (is_text(info->text, name, len) && (info->flags & OP_BUILTIN) && !is_renamed)
            return (enum ir_op)op;
    }
    return IR_NUM_OPS;
}

bool check_is_builtin(const char *name, size_t len)
{
    return find_builtin(name, len, 1) != IR_NUM_OPS;
}

/* The result of the op for the arguments' types without conversion. */
static ir_type_id builtin_type(struct parser *p, enum ir_op op, const lang_ref *args,
                               unsigned num_args)
{
    ir_type_id types[4] = {0};
    assert(num_args <= sizeof types / sizeof *types);
    for (unsigned i = 0; i < num_args; i++)
        types[i] = tree_type(p, args[i]);
    return ir_op_result(op, types, num_args);
}

static lang_ref call_builtin(struct parser *p, enum ir_op op, lang_ref *args, unsigned num_args,
                             uint32_t place)
{
    if (num_args != (unsigned)ir_op_info(op)->arity)
        return 0;
    /* With bools as the third argument it is a choice: of scalars, or by component. */
    if (op == IR_MIX && ir_type_scalar(tree_type(p, args[2])) == IR_TYPE_BOOL
        && check_is_vector(tree_type(p, args[2])))
        op = IR_CHOOSE;
    if (op == IR_MIX && tree_type(p, args[2]) == IR_TYPE_BOOL) {
        bool fits = check_unify(p, args, 2, 0) && tree_type(p, args[0]) == tree_type(p, args[1])
                    && tree_type(p, args[0]) == ir_type_scalar(tree_type(p, args[0]));
        return fits ? check_select(p, args[2], args[1], args[0], place) : 0;
    }
    /*
     * First without conversion, then with all arguments of their highest scalar type, then all of
     * float.
     */
    ir_type_id type = builtin_type(p, op, args, num_args);
    for (unsigned min_rank = 0; type == IR_TYPE_VOID && min_rank <= 3; min_rank += 3)
        if (check_unify(p, args, num_args, min_rank))
            type = builtin_type(p, op, args, num_args);
    return type == IR_TYPE_VOID || p->panic ? 0 : tree_op(p, op, type, 0, args, num_args, place);
}

/* Messages */

static const char *types_text(struct parser *p, const lang_ref *args, unsigned num_args)
{
    struct text text;
    text_init(&text, p->diags->arena);
    for (unsigned i = 0; i < num_args; i++) {
        text_str(&text, i ? ", " : "");
        text_str(&text, parse_type_text(p, tree_type(p, args[i])));
    }
    return text_cstr(&text);
}

static void note_candidate(struct parser *p, uint32_t id)
{
    static const char *const modes[] = {"", "out ", "inout "};
    const struct lang_function *function = lang_function(p->unit, id, NULL);
    struct text text;
    text_init(&text, p->diags->arena);
    text_fmt(&text, "%s %s(", parse_type_text(p, function->return_type),
             parse_text(p, function->name));
    for (unsigned i = 0; i < function->num_params; i++) {
        const struct lang_slot *param = lookup_param(p->unit, id, i);
        text_fmt(&text, "%s%s%s", i ? ", " : "", modes[param->mode],
                 parse_type_text(p, param->type));
    }
    text_char(&text, ')');
    PARSE_NOTE(p, parse_where_function(p, function), lang_candidate, text_cstr(&text));
}

static void note_candidates(struct parser *p, str_id name)
{
    enum { MAX_SHOWN = 8 };
    struct lookup_cursor cursor = {0};
    for (unsigned n = 0; n < MAX_SHOWN; n++) {
        uint32_t id =
            lookup_next_function(p->unit, p->visible.items, p->visible.len, name, &cursor);
        if (id == LANG_NONE)
            break;
        note_candidate(p, id);
    }
}

static lang_ref no_function(struct parser *p, const struct token *name, str_id id,
                            const lang_ref *args, unsigned num_args)
{
    const char *word = parse_token_text(p, name);
    struct lookup_cursor cursor = {0};
    bool known = id
                 && lookup_next_function(p->unit, p->visible.items, p->visible.len, id, &cursor)
                        != LANG_NONE;
    if (!known && !check_is_builtin(name->text, name->len)) {
        PARSE_ERROR(p, parse_where_token(p, name), lang_unknown, "function", word,
                    lookup_suggest(p, word, LOOKUP_FUNCTIONS));
        return 0;
    }
    PARSE_ERROR(p, parse_where_token(p, name), lang_no_function, word,
                types_text(p, args, num_args));
    note_candidates(p, id);
    return 0;
}

/* Overloads */

/*
 * The function that accepts the arguments with the fewest conversions; *out_ambiguous if two do.
 */
static uint32_t find_overload(struct parser *p, str_id name, const lang_ref *args,
                              unsigned num_args, bool *out_ambiguous)
{
    ir_type_id *types = ARENA_ARRAY(p->unit->arena, ir_type_id, num_args);
    for (unsigned i = 0; i < num_args; i++)
        types[i] = tree_type(p, args[i]);
    return lookup_overload(p->unit, p->visible.items, p->visible.len, name, types, num_args,
                           out_ambiguous);
}

static lang_ref call_function(struct parser *p, uint32_t id, lang_ref *args, unsigned num_args,
                              uint32_t place)
{
    assert(num_args == lang_function(p->unit, id, NULL)->num_params);
    for (unsigned i = 0; i < num_args; i++) {
        const struct lang_slot *param = lookup_param(p->unit, id, i);
        ir_type_id type = param->type;
        const char *doing = param->mode == LANG_OUT ? "pass this as an out argument"
                                                    : "pass this as an inout argument";
        if (param->mode != LANG_IN && !check_assignable(p, args[i], doing))
            return 0;
        args[i] = check_cast(p, args[i], type);
        if (!args[i])
            return 0;
    }
    return tree_call(p, id, lang_function(p->unit, id, NULL)->return_type, args, num_args, place);
}

lang_ref check_call(struct parser *p, const struct token *name, lang_ref *args, unsigned num_args)
{
    str_id id = str_find(p->unit->strings, name->text, name->len);
    bool ambiguous = false;
    uint32_t function = id ? find_overload(p, id, args, num_args, &ambiguous) : LANG_NONE;
    if (ambiguous) {
        PARSE_ERROR(p, parse_where_token(p, name), lang_ambiguous, parse_text(p, id),
                    types_text(p, args, num_args));
        note_candidates(p, id);
        return 0;
    }
    if (function != LANG_NONE)
        return call_function(p, function, args, num_args, parse_place(name));
    enum ir_op op = find_builtin(name->text, name->len, num_args);
    lang_ref result = op == IR_NUM_OPS ? 0 : call_builtin(p, op, args, num_args, parse_place(name));
    return result || p->panic ? result : no_function(p, name, id, args, num_args);
}
