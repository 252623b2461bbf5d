// SPDX-License-Identifier: Apache-2.0
/*
 * The reference as one self-contained page of HTML, with pictures beside it. It is well-formed XML
 * too, so any XML tool can read it.
 */
#include "doc/manual.h"
#include "program/markup.h"

#include <string.h>

static void put_element(FILE *out, const char *tag, const char *text)
{
    fprintf(out, "<%s>", tag);
    markup_text(out, text);
    fprintf(out, "</%s>", tag);
}

/* ---- Tables ---- */

static void put_cell(FILE *out, const struct manual_texts *texts, const char *tag,
                     const char *class)
{
    fprintf(out, "<td class=\"%s\">", class);
    for (size_t i = 0; i < texts->len; ++i) {
        putc(i ? ' ' : '\n', out);
        put_element(out, tag, texts->items[i]);
    }
    fputs("</td>", out);
}

static void put_row(FILE *out, const struct manual_port *port)
{
    fprintf(out, "<tr%s><th scope=\"row\">", port->is_output ? " class=\"output\"" : "");
    put_element(out, "code", port->name);
    if (port->uniform)
        fputs(" <small title=\"May not be connected to something that varies\">uniform</small>",
              out);
    fputs("</th>", out);
    put_cell(out, &port->cells[MANUAL_TYPE], "i", "type");
    put_cell(out, &port->cells[MANUAL_DEFAULT], "code", "default");
    put_cell(out, &port->cells[MANUAL_VALUES], "span", "values");
    put_cell(out, &port->cells[MANUAL_MEANING], "span", "meaning");
    fputs("</tr>\n", out);
}

static void put_table(FILE *out, const struct manual_edition *edition)
{
    if (edition->num_ports == 0)
        return;
    fputs("<table><thead><tr><th>Input</th><th>Type</th><th>Default</th><th>Values</"
          "th><th>Meaning</th></tr></thead>\n"
          "<tbody>\n",
          out);
    const char *folder = "";
    for (size_t i = 0; i < edition->num_ports; ++i) {
        const struct manual_port *port = &edition->ports[i];
        if (!port->is_output && strcmp(port->folder, folder) != 0) {
            folder = port->folder;
            fputs("<tr class=\"folder\"><th colspan=\"5\" scope=\"rowgroup\">", out);
            markup_text(out, folder);
            fputs("</th></tr>\n", out);
        }
        put_row(out, port);
    }
    fputs("</tbody></table>\n", out);
}

/* ---- Nodes ---- */

static void put_signatures(FILE *out, const struct manual_edition *edition)
{
    if (edition->num_variants == 1) {
        fputs("<p class=\"def\">", out);
        put_element(out, "code", edition->variants[0].def.name);
        fputs("</p>\n", out);
        return;
    }
    fprintf(out, "<details><summary>%zu signatures</summary><ul>\n", edition->num_variants);
    for (size_t i = 0; i < edition->num_variants; ++i) {
        fputs("<li>", out);
        put_element(out, "code", edition->variants[i].def.name);
        putc(' ', out);
        put_element(out, "span", edition->variants[i].signature);
        fputs("</li>\n", out);
    }
    fputs("</ul></details>\n", out);
}

/* An older version: its differences. */
static void put_older(FILE *out, const struct manual_edition *edition,
                      const struct manual_edition *first)
{
    fputs("<details><summary>Version ", out);
    markup_text(out, edition->version);
    fputs("</summary>\n<p>", out);
    if (edition->num_ports == 0 && edition->missing.len == 0)
        fputs("The same inputs as ", out);
    else
        fputs("Differs from ", out);
    markup_text(out, *first->version ? first->version : "the version above");
    for (size_t i = 0; i < edition->missing.len; ++i) {
        fputs(i ? ", " : "; it lacks ", out);
        put_element(out, "code", edition->missing.items[i]);
    }
    fputs(".</p>\n", out);
    put_table(out, edition);
    put_signatures(out, edition);
    fputs("</details>\n", out);
}

static void put_targets(const struct manual *manual, FILE *out, const struct manual_node *node)
{
    if (node->targets.len == manual->num_targets) {
        fputs("all targets", out);
        return;
    }
    for (size_t i = 0; i < node->targets.len; ++i) {
        fputs(i ? ", " : "", out);
        markup_text(out, node->targets.items[i]);
    }
    if (node->targets.len == 0)
        fputs("<strong>not implemented</strong>", out);
}

static void put_picture(FILE *out, const struct manual_node *node)
{
    if (!node->picture)
        return;
    fputs("<a class=\"picture\" title=\"The document of this picture\" href=\"pictures/", out);
    markup_text(out, node->id);
    fputs(".mtlx\"><img loading=\"lazy\" width=\"144\" height=\"144\" src=\"", out);
    markup_text(out, node->picture);
    fputs("\" alt=\"Picture of ", out);
    markup_text(out, node->name);
    fputs("\"/></a>\n", out);
}

static void put_node(const struct manual *manual, FILE *out, const struct manual_node *node)
{
    const struct manual_edition *first = &node->editions[0];
    fputs("<article id=\"", out);
    markup_text(out, node->id);
    fputs("\">\n", out);
    put_picture(out, node);
    fputs("<h3><a href=\"#", out);
    markup_text(out, node->id);
    fputs("\">", out);
    markup_text(out, node->name);
    fputs("</a>", out);
    if (*first->version) {
        fputs(" <small>", out);
        markup_text(out, first->version);
        fputs("</small>", out);
    }
    fputs("</h3>\n", out);
    put_element(out, "p", node->text);
    fputs("\n<p class=\"facts\">", out);
    markup_text(out, node->file);
    fputs(" \xc2\xb7 ", out);
    put_targets(manual, out, node);
    fputs("</p>\n", out);
    put_table(out, first);
    put_signatures(out, first);
    for (size_t i = 1; i < node->num_editions; ++i)
        put_older(out, &node->editions[i], first);
    fputs("</article>\n", out);
}

/* ---- The page ---- */

static bool begins_group(const struct manual *manual, size_t i)
{
    return i == 0 || strcmp(manual->nodes[i - 1].group, manual->nodes[i].group) != 0;
}

static void put_navigation(const struct manual *manual, FILE *out)
{
    fputs("<nav>\n<h1><a href=\"#top\">Nodes</a></h1>\n"
          "<input type=\"search\" placeholder=\"Search  /\" aria-label=\"Search\" "
          "hidden=\"hidden\"/>\n<div>\n",
          out);
    for (size_t i = 0; i < manual->num_nodes; ++i) {
        if (begins_group(manual, i)) {
            fputs(i ? "</ul></section>\n<section>" : "<section>", out);
            put_element(out, "h2", manual->nodes[i].group);
            fputs("<ul>\n", out);
        }
        fputs("<li><a href=\"#", out);
        markup_text(out, manual->nodes[i].id);
        fputs("\">", out);
        markup_text(out, manual->nodes[i].name);
        fputs("</a></li>\n", out);
    }
    fputs(manual->num_nodes ? "</ul></section>\n</div></nav>\n" : "</div></nav>\n", out);
}

static void put_nodes(const struct manual *manual, FILE *out)
{
    for (size_t i = 0; i < manual->num_nodes; ++i) {
        if (begins_group(manual, i)) {
            fputs(i ? "</section>\n<section>" : "<section>", out);
            put_element(out, "h2", manual->nodes[i].group);
        }
        put_node(manual, out, &manual->nodes[i]);
    }
    fputs(manual->num_nodes ? "</section>\n" : "", out);
}

void manual_write_html(const struct manual *manual, FILE *out)
{
    fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
          "<meta name=\"color-scheme\" content=\"light dark\"/>\n<title>Node "
          "reference</title>\n<style>\n",
          out);
    markup_lines(out, manual_style);
    fputs("</style>\n</head>\n<body id=\"top\">\n", out);
    put_navigation(manual, out);
    fprintf(out,
            "<main>\n<header>\n<p><strong>%zu</strong> nodes with <strong>%zu</strong> signatures, "
            "written by mxgen %s.</p>\n",
            manual->num_nodes, manual->num_variants, mxg_version_string());
    fputs("<p>An input without a value of its own takes the default. A default that is a name, as "
          "<code>Nworld</code>, is a "
          "property of the geometry. One number stands for equal components; where variants of a "
          "node differ, "
          "all types and defaults are listed.</p>\n</header>\n",
          out);
    put_nodes(manual, out);
    fputs("<p id=\"none\" hidden=\"hidden\">Nothing has these words.</p>\n</main>\n<script>\n",
          out);
    markup_lines(out, manual_script);
    fputs("</script>\n</body>\n</html>\n", out);
}
