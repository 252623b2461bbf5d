// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen.toml:
 *
 *     [budget]
 *     max-instructions = 3_000
 *     [budget.essl]
 *     max-instructions = 2_000
 */
#include "check/measure_budget.h"
#include "program/args.h"
#include "program/cli.h"
#include "program/cli_targets.h"
#include "program/toml.h"
#include "program/utf8.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#define TABLE "budget"
enum { MAX_TARGETS = 64 }; /* that a suggestion considers */

struct reader {
    const struct cli *cli;
    struct toml toml;
    const char *path;
    const char *target;  /* of the table; "": all; NULL: no table yet */
    const char **tables; /* targets of the tables so far */
    size_t num_tables;
    struct budget_rules *rules;
    size_t first_rule; /* of the table */
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
static char *show(const char *line, const char *at, size_t len, size_t *out_column,
                  size_t *out_length)
{
    char *margin = cli_copy(line, strlen(line)), *under = cli_copy(line, strlen(line));
    *out_column = mark(margin, line, (size_t)(at - line), ' ') + 1;
    *out_length = mark(under, at, len, '~');
    char *shown = cli_format("    %s\n    %s^%s\n", line, margin, *out_length ? under + 1 : "");
    free(margin);
    free(under);
    return shown;
}

static void set_fault(struct reader *reader, const char *what, size_t column, size_t length,
                      const char *shown)
{
    char *place = reader->toml.number
                      ? cli_format("%s:%u:%zu", reader->path, reader->toml.number, column)
                      : cli_format("%s", reader->path);
    char *rendered = cli_format("%s: error: %s [budget-invalid]\n%s", place, what, shown);
    utf8_clean(rendered);
    *reader->fault = (struct check_message){
        .id = "budget-invalid",
        .text = store_text(reader->toml.store, what, strlen(what)),
        .file = reader->path,
        .line = reader->toml.number,
        .column = (uint32_t)column,
        .length = (uint32_t)length,
        .element = "",
        .target = "",
        .rendered = store_text(reader->toml.store, rendered, strlen(rendered)),
        .state = ""};
    free(place);
    free(rendered);
}

/* The first fault counts. Frees the text. */
static void fail(struct reader *reader, const char *at, size_t len, char *what)
{
    if (!reader->fault->id) {
        size_t column, length;
        char *shown = show(reader->toml.line, at, len, &column, &length);
        set_fault(reader, what, column, length, shown);
        free(shown);
    }
    free(what);
}

/* "there is no budget 'max-closure'; did you mean 'max-closures'?" */
static void fail_name(struct reader *reader, const char *what, const char *at, size_t len,
                      const char *name, const char *const *names, size_t num_names,
                      const char *otherwise)
{
    const char *near = args_closest(name, names, num_names);
    fail(reader, at, len,
         near ? cli_format("there is no %s '%s'; did you mean '%s'?", what, name, near)
              : cli_format("there is no %s '%s'; %s", what, name, otherwise));
}

/* ---- Tables ---- */

static const char *find_target(const struct cli *cli, const char *name, const char **names,
                               size_t *num_names)
{
    const char *found = NULL;
    mxg_target target;
    *num_names = 0;
    for (uint32_t i = 0; cli_target(cli, i, &target); ++i) {
        if (*num_names < MAX_TARGETS)
            names[(*num_names)++] = target.name;
        if (strcmp(target.name, name) == 0)
            found = target.name;
    }
    return found;
}

static void begin_table(struct reader *reader, struct toml_part part)
{
    const char *names[MAX_TARGETS];
    size_t num_names;
    const char *target =
        reader->toml.sub.at ? find_target(reader->cli, part.text, names, &num_names) : "";
    if (!target) {
        fail_name(reader, "target", part.at, part.len, part.text, names, num_names,
                  "'mxgen --help' lists the targets");
        return;
    }
    for (size_t i = 0; i < reader->num_tables; ++i) {
        if (strcmp(reader->tables[i], target) == 0) {
            fail(reader, part.at, part.len, cli_format("this table stands above already"));
            return;
        }
    }
    reader->tables =
        store_grow(reader->toml.store, reader->tables, reader->num_tables, sizeof *reader->tables);
    reader->tables[reader->num_tables++] = target;
    reader->target = target;
    reader->first_rule = reader->rules->len;
}

/* "[budget]" or "[budget.glsl]" */
static void read_table(struct reader *reader)
{
    static const char *const tables[] = {TABLE};
    const struct toml *toml = &reader->toml;
    const struct toml_part name = toml->name;
    if (*name.at == '[')
        fail(reader, name.at, 1, cli_format("a table has one pair of brackets: [" TABLE "]"));
    else if (name.text && strcmp(name.text, TABLE) != 0)
        fail_name(reader, "table", name.at, name.len, name.text, tables, 1,
                  "tables are [" TABLE "] and [" TABLE ".TARGET]");
    else if (toml->stop)
        fail(reader, toml->stop, 1,
             cli_format("a table is a name in brackets: [" TABLE "] or [" TABLE ".TARGET]"));
    else
        begin_table(reader, toml->sub.at ? toml->sub : name);
}

/* ---- Keys ---- */

static void read_value(struct reader *reader, enum measure measure)
{
    const struct toml_part value = reader->toml.value;
    const char *type = toml_type(value);
    uint64_t limit;
    if (toml_number(value, &limit))
        budget_add_rule(reader->toml.store, reader->rules,
                        (struct budget_rule){measure, reader->target, limit});
    else
        fail(reader, value.at, value.len,
             *value.at == '-' && isdigit((unsigned char)value.at[1])
                 ? cli_format("a budget is a whole number from 0, not a negative one")
             : type ? cli_format("a budget is a whole number, not %s", type)
                    : cli_format("a budget is a whole number; '%.*s' is none", (int)value.len,
                                 value.at));
}

static bool is_set(const struct reader *reader, enum measure measure)
{
    for (size_t i = reader->first_rule; i < reader->rules->len; ++i)
        if (reader->rules->items[i].measure == measure)
            return true;
    return false;
}

static void read_pair(struct reader *reader)
{
    const struct toml_part key = reader->toml.name;
    const char *names[NUM_MEASURES];
    if (!reader->target) {
        fail(reader, key.at, key.len, cli_format("a key stands below a table: [" TABLE "]"));
        return;
    }
    for (int measure = 0; measure < NUM_MEASURES; ++measure) {
        names[measure] = measure_infos[measure].option;
        if (strcmp(key.text, names[measure]) != 0)
            continue;
        if (is_set(reader, (enum measure)measure))
            fail(reader, key.at, key.len, cli_format("'%s' stands above already", key.text));
        else
            read_value(reader, (enum measure)measure);
        return;
    }
    fail_name(reader, "budget", key.at, key.len, key.text, names, NUM_MEASURES,
              "'mxgen check --help all' lists them, without the dashes");
}

void budget_refuse_toml(struct store *store, const char *path, const char *reason,
                        struct check_message *fault)
{
    struct reader reader = {.toml.store = store, .path = path, .fault = fault};
    char *what = cli_format("cannot be read: %s", reason);
    set_fault(&reader, what, 0, 0, "");
    free(what);
}

void budget_read_toml(const struct cli *cli, struct store *store, const char *path,
                      const char *text, struct budget_rules *out, struct check_message *fault)
{
    struct reader reader = {.cli = cli,
                            .toml = {.store = store, .rest = text},
                            .path = path,
                            .rules = out,
                            .fault = fault};
    const struct toml_part *name = &reader.toml.name;
    while (!fault->id && toml_next(&reader.toml)) {
        if (reader.toml.kind == TOML_TABLE)
            read_table(&reader);
        else if (reader.toml.kind == TOML_PAIR)
            read_pair(&reader);
        else
            fail(&reader, name->at, name->len,
                 cli_format("a line is a table, a key with '=' and a value, or a comment"));
    }
}
