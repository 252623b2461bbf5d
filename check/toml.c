// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen.toml. The reader supports the part of TOML 1.0 that budgets need: comments, tables and keys
 * with whole numbers:
 *
 *     [budget]
 *     max-instructions = 3_000
 *     [budget.essl]
 *     max-instructions = 2_000
 *
 * The reader skips tables of other programs.
 */
#include "check/budget.h"
#include "cli/cli.h"

#include <stdlib.h>
#include <string.h>

#define TABLE "budget"

struct toml {
    struct store *store;
    const char *path;
    uint32_t line;
    bool is_ours;       /* the current table is a budget */
    const char *target; /* target of the table; "": all */
    struct budget_rules *rules;
    struct check_message *fault;
};

static void fail(struct toml *toml, const char *what)
{
    if (toml->fault->id)
        return;
    char *rendered =
        toml->line ? cli_format("%s:%u: error: %s [budget-invalid]\n", toml->path, toml->line, what)
                   : cli_format("%s: error: %s [budget-invalid]\n", toml->path, what);
    *toml->fault =
        (struct check_message){.id = "budget-invalid",
                               .text = store_text(toml->store, what, strlen(what)),
                               .file = toml->path,
                               .line = toml->line,
                               .element = "",
                               .target = "",
                               .rendered = store_text(toml->store, rendered, strlen(rendered))};
    free(rendered);
}

static bool is_target(const char *name)
{
    mxg_target target = {sizeof target};
    for (uint32_t i = 0; mxg_get_target(i, &target) == MXG_OK; ++i)
        if (strcmp(target.name, name) == 0)
            return true;
    return false;
}

/* Reads the rest of a line that begins with '['. */
static void read_table(struct toml *toml, char *text)
{
    size_t len = strlen(TABLE);
    text += strspn(text, " \t");
    /* or at its end */
    toml->is_ours = strncmp(text, TABLE, len) == 0 && strchr("]. \t", text[len]);
    if (!toml->is_ours)
        return;
    char *name = text + len + (text[len] == '.'), *end = name + strcspn(name, "] \t"),
         *bracket = end + strspn(end, " \t");
    if (*bracket != ']' || bracket[1 + strspn(bracket + 1, " \t")]
        || (text[len] != '.' && end != name)) {
        fail(toml, "a table is a name in brackets: [" TABLE "] or [" TABLE ".TARGET]");
        return;
    }
    toml->target = store_text(toml->store, name, (size_t)(end - name));
    if (text[len] == '.' && !is_target(toml->target))
        fail(toml, "there is no target of this name; 'mxgen --help' lists them");
}

/* A whole number; '_' may stand between digits. */
static bool read_number(const char *text, uint64_t *out)
{
    *out = 0;
    for (const char *c = text; *c; ++c) {
        bool is_digit = *c >= '0' && *c <= '9';
        if ((!is_digit && (*c != '_' || c == text || c[-1] == '_' || !c[1]))
            || *out > UINT64_MAX / 10 - 1)
            return false;
        if (is_digit)
            *out = *out * 10 + (uint64_t)(*c - '0');
    }
    return *text != '\0';
}

static void read_key(struct toml *toml, char *text)
{
    char *equals = strchr(text, '=');
    if (!equals) {
        fail(toml, "a line is a table, a key with a value, or a comment");
        return;
    }
    char *value = equals + 1 + strspn(equals + 1, " \t");
    while (equals > text && (equals[-1] == ' ' || equals[-1] == '\t'))
        --equals;
    *equals = '\0';
    for (int measure = 0; measure < NUM_MEASURES; ++measure) {
        uint64_t limit;
        if (strcmp(text, measure_infos[measure].option) != 0)
            continue;
        if (read_number(value, &limit))
            budget_add_rule(toml->store, toml->rules,
                            (struct budget_rule){(enum measure)measure, toml->target, limit});
        else
            fail(toml, "a budget is a whole number");
        return;
    }
    fail(toml, "there is no such budget; 'mxgen check --help' lists them, without the dashes");
}

static void read_line(struct toml *toml, char *text)
{
    text[strcspn(text, "#\r")] = '\0'; /* values are no strings */
    for (size_t len = strlen(text); len && (text[len - 1] == ' ' || text[len - 1] == '\t');)
        text[--len] = '\0';
    text += strspn(text, " \t");
    if (*text == '[')
        read_table(toml, text + 1);
    else if (*text && toml->is_ours)
        read_key(toml, text);
}

void budget_refuse_toml(struct store *store, const char *path, const char *reason,
                        struct check_message *fault)
{
    struct toml toml = {.store = store, .path = path, .fault = fault};
    char *what = cli_format("cannot be read: %s", reason);
    fail(&toml, what);
    free(what);
}

void budget_read_toml(struct store *store, const char *path, const char *text,
                      struct budget_rules *out, struct check_message *fault)
{
    struct toml toml = {.store = store, .path = path, .target = "", .rules = out, .fault = fault};
    while (*text) {
        size_t len = strcspn(text, "\n");
        ++toml.line;
        read_line(&toml, store_text(store, text, len));
        text += len + (text[len] == '\n');
    }
}
