// SPDX-License-Identifier: Apache-2.0
/* The reference as Markdown, with tables in GitHub's form. */
#include "doc/manual.h"

#include <string.h>

/* A character of a text; the end of a line would end a cell. */
static void put_character(FILE *out, char c)
{
    putc(c == '\n' || c == '\r' ? ' ' : c, out);
}

/* Plain text, with markup characters escaped. */
static void put(FILE *out, const char *text)
{
    for (; *text; ++text) {
        if (strchr("\\`*_[]<>|#&", *text))
            putc('\\', out);
        put_character(out, *text);
    }
}

/* The most backquotes of a text that follow each other. */
static size_t longest_quotes(const char *text)
{
    size_t longest = 0;
    for (; *text; text += *text != '\0') {
        size_t len = strspn(text, "`");
        longest = len > longest ? len : longest;
        text += len;
    }
    return longest;
}

/*
 * Code keeps every character except the bar, which ends a cell even in code. As many backquotes as
 * the text does not have surround it, with a space if it has any (CommonMark 0.31, section 6.1).
 */
static void put_code(FILE *out, const char *text)
{
    const size_t quotes = longest_quotes(text);
    for (size_t i = 0; i <= quotes; ++i)
        putc('`', out);
    fputs(quotes ? " " : "", out);
    for (; *text; ++text) {
        fputs(*text == '|' ? "\\" : "", out);
        put_character(out, *text);
    }
    fputs(quotes ? " " : "", out);
    for (size_t i = 0; i <= quotes; ++i)
        putc('`', out);
}

static void put_cell(FILE *out, const struct manual_texts *texts, bool is_code)
{
    for (size_t i = 0; i < texts->len; ++i) {
        fputs(i ? (is_code ? " " : "; ") : "", out);
        (is_code ? put_code : put)(out, texts->items[i]);
    }
    fputs(" | ", out);
}

static void put_table(FILE *out, const struct manual_edition *edition)
{
    if (edition->num_ports == 0)
        return;
    fputs("| input | type | default | values | meaning |\n| --- | --- | --- | --- | --- |\n", out);
    for (size_t i = 0; i < edition->num_ports; ++i) {
        const struct manual_port *port = &edition->ports[i];
        fputs(port->is_output ? "| \xe2\x86\x92 " : "| ", out);
        put_code(out, port->name);
        fputs(port->uniform ? " (uniform) | " : " | ", out);
        put_cell(out, &port->cells[MANUAL_TYPE], false);
        put_cell(out, &port->cells[MANUAL_DEFAULT], true);
        put_cell(out, &port->cells[MANUAL_VALUES], false);
        put_cell(out, &port->cells[MANUAL_MEANING], false);
        putc('\n', out);
    }
    putc('\n', out);
}

static void put_signatures(FILE *out, const struct manual_edition *edition)
{
    for (size_t i = 0; i < edition->num_variants; ++i) {
        fputs("* ", out);
        put_code(out, edition->variants[i].def.name);
        if (edition->num_variants > 1) {
            putc(' ', out);
            put(out, edition->variants[i].signature);
        }
        putc('\n', out);
    }
    putc('\n', out);
}

static void put_older(FILE *out, const struct manual_edition *edition,
                      const struct manual_edition *first)
{
    bool same = edition->num_ports == 0 && edition->missing.len == 0;
    fputs("Version ", out);
    put(out, edition->version);
    fprintf(out, " %s ", same ? "has the same inputs as" : "differs from");
    put(out, *first->version ? first->version : "the version above");
    for (size_t i = 0; i < edition->missing.len; ++i) {
        fputs(i ? ", " : "; it lacks ", out);
        put_code(out, edition->missing.items[i]);
    }
    fputs(".\n\n", out);
    put_table(out, edition);
    put_signatures(out, edition);
}

static void put_facts(const struct manual *manual, FILE *out, const struct manual_node *node)
{
    put_code(out, node->file);
    if (*node->editions[0].version) {
        fputs(", version ", out);
        put(out, node->editions[0].version);
    }
    fputs(node->targets.len == manual->num_targets ? ", all targets"
          : node->targets.len                      ? ", only "
                                                   : ", not implemented",
          out);
    for (size_t i = 0; node->targets.len < manual->num_targets && i < node->targets.len; ++i) {
        fputs(i ? ", " : "", out);
        put(out, node->targets.items[i]);
    }
    fputs("\n\n", out);
}

static void put_node(const struct manual *manual, FILE *out, const struct manual_node *node)
{
    fputs("### ", out);
    put(out, node->name);
    fputs("\n\n", out);
    if (node->picture)
        fprintf(out, "![Picture of %s](%s)\n\n", node->name, node->picture);
    if (*node->text) {
        put(out, node->text);
        fputs("\n\n", out);
    }
    put_facts(manual, out, node);
    put_table(out, &node->editions[0]);
    put_signatures(out, &node->editions[0]);
    for (size_t i = 1; i < node->num_editions; ++i)
        put_older(out, &node->editions[i], &node->editions[0]);
}

void manual_write_markdown(const struct manual *manual, FILE *out)
{
    fprintf(out,
            "# Node reference\n\n%zu nodes with %zu signatures, written by mxgen %s. A default "
            "that is a name, as `Nworld`, is "
            "a property of the geometry.\nOne number stands for equal components.\n\n",
            manual->num_nodes, manual->num_variants, mxg_version_string());
    const char *group = "";
    for (size_t i = 0; i < manual->num_nodes; ++i) {
        if (strcmp(manual->nodes[i].group, group) != 0) {
            group = manual->nodes[i].group;
            fputs("## ", out);
            put(out, group);
            fputs("\n\n", out);
        }
        put_node(manual, out, &manual->nodes[i]);
    }
}
