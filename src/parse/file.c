// SPDX-License-Identifier: Apache-2.0
/* Files, their includes and other directives. */
#include "parse/parse_priv.h"

#include <assert.h>

static uint32_t parse_file(struct lang_unit *unit, const struct lang_reader *reader,
                           const char *from, const char *ref, struct diag_place where,
                           struct diag_list *diags, const struct parser *includer);

/* Directives */

static bool is_word(const struct token *token, const char *word)
{
    return token->len == strlen(word) && memcmp(token->text, word, token->len) == 0;
}

/* A lexer for the text after '#'. */
static struct lexer directive_lexer(const struct token *directive)
{
    assert(directive->kind == TOKEN_DIRECTIVE && directive->len > 0);
    struct lexer lexer;
    lex_begin(&lexer, directive->text + 1, directive->len - 1, directive->line,
              directive->column + 1);
    lexer.line_begins = false;
    return lexer;
}

/* Skips includes, which are parsed already. */
void parse_directive(struct parser *p)
{
    static const char *const skipped[] = {"include", "version", "extension", "pragma"};
    struct lexer outer = p->lexer, inner = directive_lexer(&p->token);
    struct token name;
    lex_next(&inner, &name);
    bool skip = name.kind == TOKEN_END;
    for (size_t i = 0; i < sizeof skipped / sizeof skipped[0]; i++)
        skip |= is_word(&name, skipped[i]);
    if (is_word(&name, "define")) {
        p->lexer = inner;
        parse_advance(p);
        parse_define(p);
    } else if (!skip) {
        const char *text = parse_say(p, "#%s", parse_token_text(p, &name));
        PARSE_ERROR(p, parse_where_token(p, &name), lang_unsupported, text, "");
    }
    p->panic = false; /* a directive ends with its line */
    p->lexer = outer;
    if (p->stopped)
        p->lexer.at = p->lexer.end;
    parse_advance(p);
}

static void see_file(struct parser *p, uint32_t file)
{
    for (uint32_t i = 0; i < p->visible.len; i++)
        if (p->visible.items[i] == file)
            return;
    vec_push(p->unit->arena, &p->visible, file);
}

static bool last_error_is_in(const struct diag_list *diags, const char *file_name)
{
    if (diags->last >= diags->items.len)
        return false;
    const char *file = diags->items.items[diags->last].place.file;
    return file && strcmp(file, file_name) == 0;
}

static void parse_include(struct parser *p, const struct token *directive, struct lexer lexer)
{
    struct token path;
    lex_next(&lexer, &path);
    if (path.kind != TOKEN_STRING || path.len == 0) {
        PARSE_SYNTAX_ERROR(p, directive, "#include needs the name of a file in quotes");
        return;
    }
    const char *ref = arena_strndup(p->unit->arena, path.text, path.len);
    struct diag_place where = parse_where_token(p, &path);
    uint32_t num_errors = p->diags->num_errors;
    uint32_t file = parse_file(p->unit, p->reader, p->file_name, ref, where, p->diags, p);
    if (file == LANG_NONE) {
        p->num_errors++;
        if (p->diags->num_errors > num_errors && !last_error_is_in(p->diags, p->file_name))
            diag_add(p->diags, DIAG_ID_include_from, where);
        return;
    }
    see_file(p, file);
    const struct lang_unit *layer;
    const struct lang_file *included = lang_file(p->unit, file, &layer);
    assert(included->first_include + included->num_includes <= layer->refs.len);
    for (uint32_t i = 0; i < included->num_includes; i++)
        see_file(p, layer->refs.items[included->first_include + i]);
}

/* Parses all includes first, so that the functions of a file have contiguous ids. */
static void parse_includes(struct parser *p, const char *text, size_t len)
{
    struct lexer lexer;
    struct token token;
    lex_begin(&lexer, text, len, 1, 1);
    do {
        lex_next(&lexer, &token);
        if (token.kind != TOKEN_DIRECTIVE)
            continue;
        struct lexer inner = directive_lexer(&token);
        struct token name;
        lex_next(&inner, &name);
        if (is_word(&name, "include"))
            parse_include(p, &token, inner);
    } while (token.kind != TOKEN_END);
}

/* Files */

static uint32_t find_file(const struct lang_unit *unit, str_id name)
{
    for (; unit; unit = unit->base)
        for (uint32_t i = 0; i < unit->files.len; i++)
            if (unit->files.items[i].name == name)
                return unit->base_files + i;
    return LANG_NONE;
}

/* Reports a file that includes itself, and includes that nest too deep. */
static bool check_nesting(const struct parser *includer, const char *name, struct diag_place where,
                          struct diag_list *diags)
{
    unsigned depth = 0;
    for (const struct parser *p = includer; p; p = p->includer) {
        if (strcmp(p->file_name, name) == 0) {
            diag_add(diags, DIAG_ID_include_cycle, where, name,
                     includer == p ? "directly" : includer->file_name);
            return false;
        }
        depth++;
    }
    if (depth > PARSE_MAX_INCLUDES)
        diag_add(diags, DIAG_ID_include_depth, where, (unsigned)PARSE_MAX_INCLUDES);
    return depth <= PARSE_MAX_INCLUDES;
}

/*
 * True if the file has failed before: a file with many includers is parsed once and reports its
 * errors once.
 */
static bool failed_before(const struct diag_list *diags, const char *name)
{
    for (uint32_t i = 0; i < diags->items.len; i++) {
        const struct diag *diag = &diags->items.items[i];
        if (diag->severity == DIAG_ERROR && diag->place.file && strcmp(diag->place.file, name) == 0)
            return true;
    }
    return false;
}

static void begin_file(struct parser *p, str_id name)
{
    struct lang_unit *unit = p->unit;
    struct lang_file file = {.name = name,
                             .first_include = unit->refs.len,
                             .num_includes = p->visible.len,
                             .first_function = unit->base_functions + unit->functions.len,
                             .first_global = unit->base_globals + unit->globals.len};
    for (uint32_t i = 0; i < p->visible.len; i++)
        vec_push(unit->arena, &unit->refs, p->visible.items[i]);
    assert(file.first_include + file.num_includes == unit->refs.len);
    vec_push(unit->arena, &unit->files, file);
    p->file = unit->base_files + unit->files.len - 1;
    p->first_user_type = IR_TYPE_FIRST_USER + unit->base_user_types + unit->user_types.len;
    p->first_node = unit->nodes.len;
    vec_push(unit->arena, &p->visible, p->file);
}

static uint32_t parse_text_of_file(struct parser *p, str_id name, const char *text, size_t len)
{
    static const char byte_order_mark[] = "\xef\xbb\xbf";
    if (len >= 3 && memcmp(text, byte_order_mark, 3) == 0) {
        text += 3;
        len -= 3;
    }
    parse_includes(p, text, len);
    if (p->num_errors) /* after errors in an include, its names would be undeclared here */
        return LANG_NONE;
    struct parse_mark mark = parse_mark(p->unit);
    begin_file(p, name);
    uint32_t first_function = p->unit->base_functions + p->unit->functions.len;
    parse_begin(p, p->file_name, text, len, 1, 1, false);
    parse_declarations(p);
    assert(p->depth == 0 && p->operands.len == 0);
    if (p->stopped)
        diag_add(p->diags, DIAG_ID_too_many_errors, parse_where_token(p, &p->last),
                 (unsigned)PARSE_MAX_ERRORS);
    if (p->num_errors == 0 && check_finish_functions(p, first_function))
        return p->file;
    parse_roll_back(p->unit, &mark);
    return LANG_NONE;
}

static uint32_t parse_file(struct lang_unit *unit, const struct lang_reader *reader,
                           const char *from, const char *ref, struct diag_place where,
                           struct diag_list *diags, const struct parser *includer)
{
    const char *read_name = ref, *text = NULL, *reason = "it was not found";
    size_t len = 0;
    if (!reader->read(reader->user_data, from, ref, &read_name, &text, &len, &reason)) {
        diag_add(diags, DIAG_ID_missing_source_file, where, ref, from, reason);
        return LANG_NONE;
    }
    str_id name = str_intern_z(unit->strings, read_name);
    uint32_t known = find_file(unit, name);
    if (known != LANG_NONE)
        return known;
    if (failed_before(diags, read_name))
        return LANG_NONE;
    if (!check_nesting(includer, read_name, where, diags))
        return LANG_NONE;
    struct parser p;
    parse_init(&p, unit, diags);
    p.reader = reader;
    p.includer = includer;
    p.file_name = str_text(unit->strings, name);
    return parse_text_of_file(&p, name, text, len);
}

uint32_t lang_parse_file(struct lang_unit *unit, const struct lang_reader *reader, const char *from,
                         const char *ref, struct diag_place where, struct diag_list *diags)
{
    return parse_file(unit, reader, from, ref, where, diags, NULL);
}

uint32_t lang_parse_program(struct lang_unit *unit, const char *name, const char *text, size_t len,
                            struct diag_list *diags)
{
    struct parser p;
    parse_init(&p, unit, diags);
    p.file_name = name;
    p.is_program = true;
    return parse_text_of_file(&p, str_intern_z(unit->strings, name), text, len);
}
