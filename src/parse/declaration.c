// SPDX-License-Identifier: Apache-2.0
/* Declarations at file scope: structs, globals, functions. */
#include "parse/parse_priv.h"

#include <assert.h>

enum { MAX_MEMBERS = 255, MAX_PARAMS = 255 };

static struct lang_file *own_file(struct parser *p)
{
    assert(p->file - p->unit->base_files < p->unit->files.len);
    return &p->unit->files.items[p->file - p->unit->base_files];
}

/* Parses TYPE or TYPE[n], the start of a struct member, a parameter or a global. */
static ir_type_id parse_sized_type(struct parser *p, bool *out_unsized)
{
    bool bad;
    ir_type_id type = parse_type(p, false, &bad);
    if (p->panic || p->token.kind != TOKEN_OPEN_INDEX)
        return type;
    ir_type_id array = parse_array_suffix(p, type, out_unsized);
    return out_unsized && *out_unsized ? type : array;
}

/* Structs */

static bool parse_member(struct parser *p, uint32_t first)
{
    ir_type_id base = parse_sized_type(p, NULL);
    do {
        struct token at = p->token;
        ir_type_id type = base;
        str_id name = p->panic ? 0 : parse_name(p);
        if (!name)
            return false;
        if (p->token.kind == TOKEN_OPEN_INDEX)
            type = parse_array_suffix(p, type, NULL);
        if (type == IR_TYPE_STRING || type == IR_TYPE_SAMPLER)
            PARSE_TYPE_ERROR(p, parse_place(&at), "a member cannot have type %s",
                             parse_type_text(p, type));
        for (uint32_t i = first; i < p->unit->members.len; i++)
            if (p->unit->members.items[i].name == name)
                PARSE_ERROR(p, parse_where_token(p, &at), redefinition, parse_text(p, name));
        vec_push(p->unit->arena, &p->unit->members, (struct ir_member){.name = name, .type = type});
    } while (parse_accept(p, TOKEN_COMMA));
    return parse_expect(p, TOKEN_SEMICOLON);
}

static bool same_members(const struct parser *p, ir_type_id type, uint32_t first)
{
    const struct lang_unit *layer;
    const struct ir_user_type *user = lang_user_type(p->unit, type, &layer);
    if (user->num_members != p->unit->members.len - first)
        return false;
    for (uint32_t i = 0; i < user->num_members; i++) {
        struct ir_member a = layer->members.items[user->first_member + i],
                         b = p->unit->members.items[first + i];
        if (a.name != b.name || a.type != b.type)
            return false;
    }
    return true;
}

/*
 * Structs have one name space per unit: an equal struct of another file is the same type, a
 * different one hides it.
 */
static void declare_struct(struct parser *p, const struct token *at, str_id name, uint32_t first)
{
    assert(first <= p->unit->members.len);
    uint32_t num_members = p->unit->members.len - first;
    ir_type_id known = lookup_type(p->unit, at->text, at->len);
    if (known >= IR_TYPE_FIRST_USER && known < p->first_user_type && same_members(p, known, first))
        p->unit->members.len = first;
    else if (known != IR_TYPE_VOID && (known < IR_TYPE_FIRST_USER || known >= p->first_user_type))
        PARSE_ERROR(p, parse_where_token(p, at), redefinition, parse_text(p, name));
    else if (num_members == 0 || num_members > MAX_MEMBERS)
        PARSE_ERROR(p, parse_where_token(p, at), lang_limit,
                    parse_say(p, "a struct has 1 to %d members", MAX_MEMBERS));
    else if (lang_add_type(p->unit, (struct ir_user_type){.name = name,
                                                          .num_members = (uint16_t)num_members,
                                                          .first_member = first})
             == IR_TYPE_VOID)
        PARSE_ERROR(p, parse_where_token(p, at), lang_limit,
                    parse_say(p,
                              "there are too many structs and arrays, or this one has more "
                              "than %d numbers",
                              LANG_MAX_WORDS));
}

static void parse_struct(struct parser *p)
{
    assert(p->token.kind == TOKEN_STRUCT);
    parse_advance(p);
    struct token at = p->token;
    str_id name = parse_name(p);
    uint32_t first = p->unit->members.len;
    if (!name || !parse_expect(p, TOKEN_OPEN_BLOCK))
        return;
    while (p->token.kind != TOKEN_CLOSE_BLOCK)
        if (!parse_member(p, first))
            return;
    parse_advance(p);
    declare_struct(p, &at, name, first);
    parse_expect(p, TOKEN_SEMICOLON);
}

/* Globals */

/* `a` has its words in its own layer, `b` in this unit. */
static bool same_value(struct parser *p, const struct lang_global *a, const struct lang_unit *layer,
                       const struct lang_global *b)
{
    for (uint32_t i = 0; i < a->num_words && a->num_words == b->num_words; i++)
        if (layer->words.items[a->words + i].u != p->unit->words.items[b->words + i].u)
            return false;
    return a->num_words == b->num_words && a->array_length == b->array_length;
}

/*
 * A repeated equal declaration refers to the first one. Constants may repeat only by #define.
 */
static void declare_global(struct parser *p, const struct token *at, struct lang_global global,
                           bool may_repeat)
{
    assert(global.words + global.num_words <= p->unit->words.len);
    uint32_t known = lookup_global(p->unit, p->visible.items, p->visible.len, global.name);
    if (known != LANG_NONE) {
        const struct lang_unit *layer;
        const struct lang_global *other = lang_global(p->unit, known, &layer);
        bool same = other->kind == global.kind && other->type == global.type
                    && same_value(p, other, layer, &global);
        if (!may_repeat || !same)
            PARSE_ERROR(p, parse_where_token(p, at), redefinition, parse_text(p, global.name));
        return;
    }
    global.file = p->file;
    vec_push(p->unit->arena, &p->unit->globals, global);
    own_file(p)->num_globals++;
    assert(own_file(p)->first_global + own_file(p)->num_globals
           == p->unit->base_globals + p->unit->globals.len);
}

static void parse_constant(struct parser *p, const struct token *at, str_id name, ir_type_id type,
                           bool unsized)
{
    static const char option_prefix[] = "option_";
    struct parse_mark mark = parse_mark(p->unit);
    struct lang_global global = {.name = name, .kind = LANG_GLOBAL_CONST};
    if (at->len > sizeof option_prefix - 1
        && memcmp(at->text, option_prefix, sizeof option_prefix - 1) == 0)
        global.kind = LANG_GLOBAL_OPTION;
    if (!parse_expect(p, TOKEN_SET))
        return;
    lang_ref value = parse_initialiser(p, type, unsized);
    if (value) {
        global.type = tree_type(p, value);
        uint32_t place = tree_place(p, value);
        bool scalar = global.type == ir_type_scalar(global.type);
        if (!check_words(p, value, &global.words, &global.num_words))
            PARSE_ERROR(p, parse_where(p, place, 0), lang_not_constant,
                        parse_say(p, "the value of '%s'", parse_text(p, name)));
        else if (global.kind == LANG_GLOBAL_OPTION && !scalar)
            PARSE_TYPE_ERROR(p, parse_place(at), "an option is a bool, int or float");
    } else { /* a replacement value, so that uses of the name cause no more errors */
        global.type = type;
        global.num_words = unsized ? 0 : ir_type_components(type);
        for (uint32_t i = 0; i < global.num_words; i++)
            vec_push(p->unit->arena, &p->unit->words, (union ir_word){0});
    }
    parse_drop_tree(p, &mark, global.num_words);
    global.words = mark.words;
    assert(global.words + global.num_words == p->unit->words.len);
    declare_global(p, at, global, false);
}

void parse_define(struct parser *p)
{
    struct parse_mark mark = parse_mark(p->unit);
    struct token at = p->token;
    str_id name = parse_name(p);
    if (!name || p->token.kind == TOKEN_END) /* a flag without a value declares nothing */
        return;
    if (p->token.kind == TOKEN_OPEN && p->token.text == at.text + at.len) {
        PARSE_ERROR(p, parse_where_token(p, &at), lang_unsupported, "#define",
                    " with parameters; write a function");
        return;
    }
    struct lang_global global = {.name = name, .kind = LANG_GLOBAL_CONST};
    lang_ref value = parse_expression(p);
    if (!p->panic && p->token.kind != TOKEN_END)
        parse_unexpected(p, "the end of the line");
    if (!value)
        return;
    global.type = tree_type(p, value);
    if (!check_words(p, value, &global.words, &global.num_words)) {
        PARSE_ERROR(p, parse_where_token(p, &at), lang_not_constant,
                    parse_say(p, "the value of '%s'", parse_text(p, name)));
        return;
    }
    parse_drop_tree(p, &mark, global.num_words);
    global.words = mark.words;
    assert(global.words + global.num_words == p->unit->words.len);
    declare_global(p, &at, global, true);
}

static void parse_host_variable(struct parser *p, const struct token *at, str_id name,
                                enum lang_global_kind kind, ir_type_id type)
{
    uint32_t length = 0;
    /* A stream is a scalar or a vector: no vertex attribute of a host is more. */
    bool is_bad_stream =
        type == IR_TYPE_SAMPLER || type >= IR_TYPE_FIRST_USER || ir_type_is_matrix(type);
    if (type == IR_TYPE_STRING || (kind == LANG_GLOBAL_STREAM && is_bad_stream))
        PARSE_TYPE_ERROR(p, parse_place(at), "'%s' cannot have type %s", parse_text(p, name),
                         parse_type_text(p, type));
    check_is_array(p, type, &type, &length); /* then `type` is the type of its elements */
    struct lang_global global = {
        .name = name, .kind = (uint8_t)kind, .type = type, .array_length = length};
    declare_global(p, at, global, true);
}

/* Parses const, uniform or in; the current token is this keyword. */
static void parse_globals(struct parser *p)
{
    enum token_kind keyword = p->token.kind;
    bool base_unsized = false;
    assert(keyword == TOKEN_CONST || keyword == TOKEN_UNIFORM || keyword == TOKEN_IN);
    parse_advance(p);
    ir_type_id base = parse_sized_type(p, &base_unsized);
    do {
        bool unsized = base_unsized;
        ir_type_id type = base;
        struct token at = p->token;
        str_id name = p->panic ? 0 : parse_name(p);
        if (!name)
            return;
        if (p->token.kind == TOKEN_OPEN_INDEX) {
            type = parse_array_suffix(p, base, &unsized);
            type = unsized ? base : type;
        }
        if (keyword == TOKEN_CONST)
            parse_constant(p, &at, name, type, unsized);
        else if (unsized)
            PARSE_TYPE_ERROR(p, parse_place(&at), "this array needs a length");
        else
            parse_host_variable(
                p, &at, name, keyword == TOKEN_IN ? LANG_GLOBAL_STREAM : LANG_GLOBAL_UNIFORM, type);
    } while (parse_accept(p, TOKEN_COMMA));
    parse_expect(p, TOKEN_SEMICOLON);
}

/* Variables of a program */

/* The words of a first value; none: it has no value. */
static void parse_first_value(struct parser *p, const struct token *at, struct lang_global *global)
{
    struct parse_mark mark = parse_mark(p->unit);
    lang_ref value = parse_initialiser(p, global->type, false);
    if (value && !check_words(p, value, &global->words, &global->num_words))
        PARSE_ERROR(p, parse_where_token(p, at), lang_not_constant,
                    parse_say(p, "the value of '%s'", parse_text(p, global->name)));
    parse_drop_tree(p, &mark, global->num_words);
    global->words = mark.words;
}

static void parse_variable(struct parser *p, const struct token *at, str_id name, ir_type_id type)
{
    struct lang_global global = {.name = name, .kind = LANG_GLOBAL_VARIABLE, .type = type};
    if (p->token.kind == TOKEN_OPEN_INDEX)
        global.type = parse_array_suffix(p, type, NULL);
    if (parse_accept(p, TOKEN_SET))
        parse_first_value(p, at, &global);
    if (global.type != IR_TYPE_VOID)
        declare_global(p, at, global, false);
}

static void parse_variables(struct parser *p, const struct token *at, str_id name, ir_type_id type)
{
    parse_variable(p, at, name, type);
    while (!p->panic && parse_accept(p, TOKEN_COMMA)) {
        struct token next = p->token;
        str_id other = parse_name(p);
        if (other)
            parse_variable(p, &next, other, type);
    }
    parse_expect(p, TOKEN_SEMICOLON);
}

/* Functions */

/* [const] [in|out|inout] TYPE [NAME] */
static void parse_param(struct parser *p)
{
    uint32_t slot = p->unit->slots.len - p->first_slot;
    bool read_only = parse_accept(p, TOKEN_CONST);
    enum lang_param_mode mode = p->token.kind == TOKEN_OUT     ? LANG_OUT
                                : p->token.kind == TOKEN_INOUT ? LANG_INOUT
                                                               : LANG_IN;
    struct token at = p->token;
    if (mode != LANG_IN || at.kind == TOKEN_IN)
        parse_advance(p);
    ir_type_id type = parse_sized_type(p, NULL);
    str_id name = 0;
    if (!p->panic && p->token.kind == TOKEN_NAME) {
        at = p->token;
        name = parse_name(p);
    }
    if (!p->panic && p->token.kind == TOKEN_OPEN_INDEX)
        type = parse_array_suffix(p, type, NULL);
    bool opaque = type == IR_TYPE_STRING || type == IR_TYPE_SAMPLER;
    if (mode != LANG_IN && (opaque || read_only))
        PARSE_TYPE_ERROR(p, parse_place(&at), "a %s parameter is always in",
                         opaque ? parse_type_text(p, type) : "const");
    for (uint32_t i = 0; i < p->locals.len; i++)
        if (name && p->locals.items[i].name == name)
            PARSE_ERROR(p, parse_where_token(p, &at), redefinition, parse_text(p, name));
    vec_push(p->unit->arena, &p->unit->slots,
             (struct lang_slot){.name = name, .type = type, .mode = (uint8_t)mode});
    vec_push(p->unit->arena, &p->locals,
             (struct local){.name = name,
                            .type = type,
                            .slot = (uint16_t)slot,
                            .read_only = read_only || opaque,
                            .place = parse_place(&at)});
    assert(p->locals.len == p->unit->slots.len - p->first_slot);
}

static bool parse_params(struct parser *p)
{
    assert(p->token.kind == TOKEN_OPEN);
    parse_advance(p);
    p->first_slot = p->unit->slots.len;
    p->locals.len = 0;
    p->scope = 0;
    if (parse_is_word(&p->token, "void") && parse_peek(p).kind == TOKEN_CLOSE)
        parse_advance(p);
    if (parse_accept(p, TOKEN_CLOSE))
        return true;
    do
        parse_param(p);
    while (!p->panic && parse_accept(p, TOKEN_COMMA));
    return parse_expect(p, TOKEN_CLOSE);
}

static uint32_t find_declared(struct parser *p, str_id name, unsigned num_params)
{
    assert(num_params <= MAX_PARAMS);
    ir_type_id types[MAX_PARAMS];
    for (unsigned i = 0; i < num_params; i++)
        types[i] = p->unit->slots.items[p->first_slot + i].type;
    return lookup_exact(p->unit, p->visible.items, p->visible.len, name, types, num_params);
}

static bool check_repeats(struct parser *p, const struct token *at, uint32_t id,
                          ir_type_id return_type, bool is_definition)
{
    const struct lang_function *known = lang_function(p->unit, id, NULL);
    assert(known->num_params == p->unit->slots.len - p->first_slot);
    bool same = known->return_type == return_type;
    for (unsigned i = 0; i < known->num_params; i++)
        same &= lookup_param(p->unit, id, i)->mode == p->unit->slots.items[p->first_slot + i].mode;
    if (same && !(is_definition && known->body))
        return true;
    PARSE_ERROR(p, parse_where_token(p, at), lang_type,
                parse_say(p,
                          same ? "'%s' is defined already"
                               : "'%s' was declared with another return type or out parameters",
                          parse_token_text(p, at)));
    PARSE_NOTE(p, parse_where_function(p, known), defined_here, parse_token_text(p, at));
    return false;
}

/*
 * The file's function with this signature: from a prototype, or new. LANG_NONE if it already has a
 * body.
 */
static uint32_t declare_function(struct parser *p, const struct token *at, str_id name,
                                 ir_type_id return_type, bool is_definition)
{
    unsigned num_params = p->unit->slots.len - p->first_slot;
    if (num_params > MAX_PARAMS) {
        PARSE_ERROR(p, parse_where_token(p, at), lang_limit,
                    parse_say(p, "a function has at most %d parameters", MAX_PARAMS));
        return LANG_NONE;
    }
    if (check_is_builtin(at->text, at->len)
        || lookup_type(p->unit, at->text, at->len) != IR_TYPE_VOID)
        PARSE_TYPE_ERROR(p, parse_place(at), "'%s' is the name of a built-in function or type",
                         parse_token_text(p, at));
    uint32_t id = find_declared(p, name, num_params);
    if (id != LANG_NONE)
        return check_repeats(p, at, id, return_type, is_definition) ? id : LANG_NONE;
    vec_push(p->unit->arena, &p->unit->functions,
             (struct lang_function){.name = name,
                                    .return_type = return_type,
                                    .num_params = (uint16_t)num_params,
                                    .num_slots = (uint16_t)num_params,
                                    .first_slot = p->first_slot,
                                    .file = p->file,
                                    .place = parse_place(at)});
    own_file(p)->num_functions++;
    assert(own_file(p)->first_function + own_file(p)->num_functions
           == p->unit->base_functions + p->unit->functions.len);
    return p->unit->base_functions + p->unit->functions.len - 1;
}

/* Moves *at behind the slashes and blanks that begin a line of a comment. Returns the blanks. */
static size_t open_comment_line(const char **at, const char *end)
{
    while (*at < end && (**at == ' ' || **at == '\t'))
        ++*at;
    while (*at < end && **at == '/')
        ++*at;
    const char *slashes_end = *at;
    while (*at < end && (**at == ' ' || **at == '\t'))
        ++*at;
    return (size_t)(*at - slashes_end);
}

static size_t length_of_line(const char *at, const char *end)
{
    size_t len = 0;
    while (at + len < end && at[len] != '\n')
        len++;
    while (len > 0 && (at[len - 1] == ' ' || at[len - 1] == '\t' || at[len - 1] == '\r'))
        len--;
    return len;
}

/*
 * The first paragraph of a comment, without slashes; 0 if it is empty. Its lines are joined, but a
 * line that is set in (a formula) stays a line.
 */
static str_id doc_of(struct parser *p, const struct token *first)
{
    enum { SET_IN = 3 }; /* blanks after the slashes */
    struct text doc;
    text_init(&doc, p->unit->arena);
    const char *at = first->comment, *end = at ? at + first->comment_len : NULL;
    bool is_own = false;
    while (at && at < end) {
        bool was_own = is_own;
        is_own = open_comment_line(&at, end) >= SET_IN;
        size_t len = length_of_line(at, end);
        if (len == 0)
            break;
        if (doc.len)
            text_char(&doc, is_own || was_own ? '\n' : ' ');
        text_str(&doc, is_own ? "    " : "");
        text_mem(&doc, at, len);
        at = memchr(at, '\n', (size_t)(end - at));
        at += at != NULL;
    }
    return doc.len ? str_intern(p->unit->strings, doc.data, doc.len) : 0;
}

static void parse_function(struct parser *p, const struct token *first, const struct token *at,
                           str_id name, ir_type_id return_type)
{
    if (!parse_params(p))
        return;
    bool is_definition = p->token.kind == TOKEN_OPEN_BLOCK;
    if (!is_definition && !parse_expect(p, TOKEN_SEMICOLON))
        return;
    uint32_t id = declare_function(p, at, name, return_type, is_definition);
    if (!is_definition)
        return;
    p->return_type = return_type;
    p->loops = 0;
    lang_ref body = parse_block(p);
    if (return_type != IR_TYPE_VOID && body && !parse_returns(p, tree_node(p, body)->a))
        PARSE_TYPE_ERROR(p, parse_place(at), "'%s' does not return a value on every path",
                         parse_token_text(p, at));
    if (id != LANG_NONE) {
        struct lang_function *function = &p->unit->functions.items[id - p->unit->base_functions];
        function->first_slot = p->first_slot;
        function->num_slots = (uint16_t)(p->unit->slots.len - p->first_slot);
        function->body = body;
        function->place = parse_place(at);
        function->doc = doc_of(p, first);
    }
    p->locals.len = 0;
}

static void parse_function_or_global(struct parser *p)
{
    bool bad, unsized = false;
    struct token first = p->token;
    ir_type_id type = parse_type(p, true, &bad);
    if (!p->panic && p->token.kind == TOKEN_OPEN_INDEX)
        type = parse_array_suffix(p, type, &unsized);
    struct token at = p->token;
    str_id name = p->panic ? 0 : parse_name(p);
    if (!name)
        return;
    if (p->token.kind != TOKEN_OPEN && p->is_program) {
        parse_variables(p, &at, name, type);
        return;
    }
    if (p->token.kind != TOKEN_OPEN) {
        PARSE_TYPE_ERROR(p, parse_place(&at),
                         "'%s' must be const, uniform or in: there are no other global variables",
                         parse_text(p, name));
        p->panic = true;
        return;
    }
    if (unsized || type == IR_TYPE_STRING || type == IR_TYPE_SAMPLER)
        PARSE_TYPE_ERROR(p, parse_place(&at), "a function cannot return %s",
                         unsized ? "an array without length" : parse_type_text(p, type));
    parse_function(p, &first, &at, name, type);
}

void parse_declarations(struct parser *p)
{
    while (p->token.kind != TOKEN_END) {
        switch (p->token.kind) {
        case TOKEN_DIRECTIVE: parse_directive(p); break;
        case TOKEN_SEMICOLON: parse_advance(p); break;
        case TOKEN_STRUCT: parse_struct(p); break;
        case TOKEN_CONST:
        case TOKEN_UNIFORM:
        case TOKEN_IN: parse_globals(p); break;
        case TOKEN_NAME: parse_function_or_global(p); break;
        default: parse_unexpected(p, "a declaration"); break;
        }
        if (p->panic)
            parse_recover(p, true);
    }
}
