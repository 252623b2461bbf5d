// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen.toml. The reader knows all of TOML 1.0 that can stand in a line, so that it can say where a
 * file has something else than budgets:
 *
 *     [budget]
 *     max-instructions = 3_000
 *     [budget.essl]
 *     max-instructions = 2_000
 */
#include "check/budget.h"
#include "program/args.h"
#include "program/cli.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#define TABLE "budget"
enum { MAX_TOML_NAMES = 64 }; /* targets that a suggestion considers */

struct toml {
    struct store *store;
    const char *path;
    const char *text; /* the current line, without its end */
    size_t len;
    uint32_t line;
    bool is_known;       /* the current table is a budget; keys of an unknown one are not read */
    const char *target;  /* target of the table; "": all; NULL: no table yet */
    const char **tables; /* targets of the tables so far */
    size_t num_tables;
    struct budget_rules *rules;
    size_t first_rule; /* index of the first rule of the table */
    struct check_message *fault;
};

/* ---- Faults ---- */

/* Fills in a mark per code point of the text; tabs stay tabs. Returns the number of marks. */
static size_t mark(char *out, const char *text, size_t len, char mark_of_code_point)
{
    size_t count = 0;
    for (size_t i = 0; i < len && text[i]; ++i)
        if (((unsigned char)text[i] & 0xc0) != 0x80)
            out[count++] = text[i] == '\t' ? '\t' : mark_of_code_point;
    out[count] = '\0';
    return count;
}

/* The line with a caret under a part of `len` bytes; sets its place in code points. */
static char *show(const struct toml *toml, const char *at, size_t len, size_t *out_column,
                  size_t *out_length)
{
    char *margin = cli_copy(toml->text, toml->len), *under = cli_copy(toml->text, toml->len);
    *out_column = mark(margin, toml->text, (size_t)(at - toml->text), ' ') + 1;
    *out_length = mark(under, at, len, '~');
    char *shown = cli_format("    %.*s\n    %s^%s\n", (int)toml->len, toml->text, margin,
                             *out_length ? under + 1 : "");
    free(margin);
    free(under);
    return shown;
}

static void set_fault(struct toml *toml, const char *what, size_t column, size_t length,
                      const char *shown)
{
    char *place = toml->line ? cli_format("%s:%u:%zu", toml->path, toml->line, column)
                             : cli_format("%s", toml->path);
    char *rendered = cli_format("%s: error: %s [budget-invalid]\n%s", place, what, shown);
    *toml->fault =
        (struct check_message){.id = "budget-invalid",
                               .text = store_text(toml->store, what, strlen(what)),
                               .file = toml->path,
                               .line = toml->line,
                               .column = (uint32_t)column,
                               .length = (uint32_t)length,
                               .element = "",
                               .target = "",
                               .rendered = store_text(toml->store, rendered, strlen(rendered)),
                               .state = ""};
    free(place);
    free(rendered);
}

/* The first fault counts. Frees the text. */
static void fail(struct toml *toml, const char *at, size_t len, char *what)
{
    if (!toml->fault->id) {
        size_t column, length;
        char *shown = show(toml, at, len, &column, &length);
        set_fault(toml, what, column, length, shown);
        free(shown);
    }
    free(what);
}

/* "there is no budget 'max-closure'; did you mean 'max-closures'?" */
static void fail_name(struct toml *toml, const char *what, const char *at, size_t len,
                      const char *name, const char *const *names, size_t num_names,
                      const char *otherwise)
{
    const char *near = args_closest(name, names, num_names);
    fail(toml, at, len,
         near ? cli_format("there is no %s '%s'; did you mean '%s'?", what, name, near)
              : cli_format("there is no %s '%s'; %s", what, name, otherwise));
}

/* ---- Names ---- */

static const char *skip_space(const char *at)
{
    return at + strspn(at, " \t");
}

static bool ends(const char *at)
{
    at = skip_space(at);
    return !*at || *at == '#';
}

/* A bare or quoted key; moves behind it. NULL: there is none. */
static const char *read_key(struct toml *toml, const char **at)
{
    const char *begin = *at;
    if (*begin == '"' || *begin == '\'') {
        size_t len = strcspn(begin + 1, *begin == '"' ? "\"" : "'");
        *at = begin + len + 1 + (begin[len + 1] != '\0');
        return store_text(toml->store, begin + 1, len);
    }
    size_t len = 0;
    while (isalnum((unsigned char)begin[len]) || begin[len] == '_' || begin[len] == '-')
        ++len;
    *at = begin + len;
    return len ? store_text(toml->store, begin, len) : NULL;
}

static const char *find_target(const char *name, const char **names, size_t *num_names)
{
    const char *found = NULL;
    mxg_target target = {sizeof target};
    *num_names = 0;
    for (uint32_t i = 0; mxg_get_target(i, &target) == MXG_OK; ++i) {
        if (*num_names < MAX_TOML_NAMES)
            names[(*num_names)++] = target.name;
        if (strcmp(target.name, name) == 0)
            found = target.name;
    }
    return found;
}

/* ---- Tables ---- */

/* Sets the target of a table; false after a fault. */
static bool begin_table(struct toml *toml, const char *name, const char *at, size_t len)
{
    const char *names[MAX_TOML_NAMES];
    size_t num_names;
    const char *target = *name ? find_target(name, names, &num_names) : "";
    if (!target) {
        fail_name(toml, "target", at, len, name, names, num_names,
                  "'mxgen --help' lists the targets");
        return false;
    }
    for (size_t i = 0; i < toml->num_tables; ++i) {
        if (strcmp(toml->tables[i], target) == 0) {
            fail(toml, at, len, cli_format("this table stands above already"));
            return false;
        }
    }
    toml->tables = store_grow(toml->store, toml->tables, toml->num_tables, sizeof *toml->tables);
    toml->tables[toml->num_tables++] = target;
    toml->target = target;
    toml->first_rule = toml->rules->len;
    return true;
}

/* "[budget]" or "[budget.glsl]"; `at` is behind the bracket. */
static void read_table(struct toml *toml, const char *at)
{
    static const char *const tables[] = {TABLE};
    const char *begin = at = skip_space(at), *name = read_key(toml, &at), *target = "";
    const char *target_at = begin;
    size_t len = (size_t)(at - begin);
    toml->is_known = false;
    if (*begin == '[') {
        fail(toml, begin, 1, cli_format("a table has one pair of brackets: [" TABLE "]"));
        return;
    }
    if (name && strcmp(name, TABLE) != 0) {
        fail_name(toml, "table", begin, len, name, tables, 1,
                  "tables are [" TABLE "] and [" TABLE ".TARGET]");
        return;
    }
    at = skip_space(at);
    if (name && *at == '.') {
        target_at = at = skip_space(at + 1);
        target = read_key(toml, &at);
        len = (size_t)(at - target_at);
    }
    at = skip_space(at);
    if (!name || !target || *at != ']' || !ends(at + 1))
        fail(toml, at, 1,
             cli_format("a table is a name in brackets: [" TABLE "] or [" TABLE ".TARGET]"));
    else
        toml->is_known = begin_table(toml, target, target_at, len);
}

/* ---- Values ---- */

/* The word for the type of a value that is no whole number; NULL: it has none. */
static const char *type_of(const char *at)
{
    size_t digits = strspn(at, "0123456789_");
    if (*at == '"' || *at == '\'')
        return "a string";
    if (*at == '[')
        return "an array";
    if (*at == '{')
        return "a table";
    if (strncmp(at, "true", 4) == 0 || strncmp(at, "false", 5) == 0)
        return "a boolean";
    if (digits && at[digits] == '-')
        return "a date";
    if (digits && at[digits] == ':')
        return "a time";
    at += *at == '+' || *at == '-';
    digits = strspn(at, "0123456789_");
    if ((digits && at[digits] && strchr(".eE", at[digits])) || strncmp(at, "inf", 3) == 0
        || strncmp(at, "nan", 3) == 0)
        return "a number with a fraction";
    return NULL;
}

/* The digits of a base, by the prefix of a number; moves behind the prefix. */
static unsigned base_of(const char **at)
{
    static const struct {
        const char *prefix;
        unsigned base;
    } bases[] = {{"0x", 16}, {"0o", 8}, {"0b", 2}};
    for (size_t i = 0; i < sizeof bases / sizeof *bases; ++i) {
        if (strncmp(*at, bases[i].prefix, 2) == 0) {
            *at += 2;
            return bases[i].base;
        }
    }
    *at += **at == '+';
    return 10;
}

static unsigned digit_of(char c)
{
    return c >= '0' && c <= '9'   ? (unsigned)(c - '0')
           : c >= 'a' && c <= 'f' ? (unsigned)(c - 'a') + 10
           : c >= 'A' && c <= 'F' ? (unsigned)(c - 'A') + 10
                                  : 99;
}

/*
 * A whole number: digits with a '_' between two of them, no 0 in front. False: it is none, or it is
 * larger than 64 bits.
 */
static bool read_number(const char **at, uint64_t *out)
{
    unsigned base = base_of(at);
    const char *begin = *at;
    *out = 0;
    for (; digit_of(**at) < base || **at == '_'; ++*at) {
        if (**at == '_' && (*at == begin || (*at)[-1] == '_' || digit_of((*at)[1]) >= base))
            return false;
        if (**at != '_' && *out > (UINT64_MAX - digit_of(**at)) / base)
            return false;
        if (**at != '_')
            *out = *out * base + digit_of(**at);
    }
    return *at > begin && !(base == 10 && *begin == '0' && *at > begin + 1);
}

static void read_value(struct toml *toml, enum measure measure, const char *at)
{
    uint64_t limit;
    const char *begin = at = skip_space(at);
    if (read_number(&at, &limit) && ends(at)) {
        budget_add_rule(toml->store, toml->rules,
                        (struct budget_rule){measure, toml->target, limit});
        return;
    }
    size_t len = strcspn(begin, "#");
    while (len && (begin[len - 1] == ' ' || begin[len - 1] == '\t'))
        --len;
    const char *type = type_of(begin);
    fail(toml, begin, len,
         *begin == '-' && isdigit((unsigned char)begin[1])
             ? cli_format("a budget is a whole number from 0, not a negative one")
         : type ? cli_format("a budget is a whole number, not %s", type)
                : cli_format("a budget is a whole number; '%.*s' is none", (int)len, begin));
}

/* ---- Keys ---- */

static bool is_set(const struct toml *toml, enum measure measure)
{
    for (size_t i = toml->first_rule; i < toml->rules->len; ++i)
        if (toml->rules->items[i].measure == measure)
            return true;
    return false;
}

static void read_pair(struct toml *toml, const char *at)
{
    const char *begin = at, *name = read_key(toml, &at);
    size_t len = (size_t)(at - begin);
    const char *names[NUM_MEASURES];
    at = skip_space(at);
    if (!name || *at != '=') {
        fail(toml, begin, len,
             cli_format("a line is a table, a key with '=' and a value, or a comment"));
        return;
    }
    if (!toml->target) {
        fail(toml, begin, len, cli_format("a key stands below a table: [" TABLE "]"));
        return;
    }
    for (int measure = 0; measure < NUM_MEASURES; ++measure) {
        names[measure] = measure_infos[measure].option;
        if (strcmp(name, names[measure]) != 0)
            continue;
        if (is_set(toml, (enum measure)measure))
            fail(toml, begin, len, cli_format("'%s' stands above already", name));
        else
            read_value(toml, (enum measure)measure, at + 1);
        return;
    }
    fail_name(toml, "budget", begin, len, name, names, NUM_MEASURES,
              "'mxgen check --help all' lists them, without the dashes");
}

static void read_line(struct toml *toml, const char *text)
{
    const char *at = skip_space(text);
    toml->text = text;
    toml->len = strlen(text);
    if (*at == '[')
        read_table(toml, at + 1);
    else if (!ends(at) && (toml->is_known || !toml->target))
        read_pair(toml, at);
}

void budget_refuse_toml(struct store *store, const char *path, const char *reason,
                        struct check_message *fault)
{
    struct toml toml = {.store = store, .path = path, .fault = fault};
    char *what = cli_format("cannot be read: %s", reason);
    set_fault(&toml, what, 0, 0, "");
    free(what);
}

void budget_read_toml(struct store *store, const char *path, const char *text,
                      struct budget_rules *out, struct check_message *fault)
{
    struct toml toml = {.store = store, .path = path, .rules = out, .fault = fault};
    while (*text && !fault->id) {
        size_t len = strcspn(text, "\n");
        ++toml.line;
        read_line(&toml, store_text(store, text, len && text[len - 1] == '\r' ? len - 1 : len));
        text += len + (text[len] == '\n');
    }
}
