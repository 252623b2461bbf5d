// SPDX-License-Identifier: Apache-2.0
/*
 * The reference as one self-contained page of HTML, with pictures beside it. It is well-formed XML
 * too, so any XML tool can read it.
 */
#include "doc/manual.h"
#include "program/file_name.h"
#include "program/markup.h"

#include <stdlib.h>
#include <string.h>

static void put_element(struct markup *out, const char *tag, const char *text)
{
    markup_put(out, "<%s>", tag);
    markup_put(out, "%s", text);
    markup_put(out, "</%s>", tag);
}

/* ---- Tables ---- */

static void put_cell(struct markup *out, const struct manual_texts *texts, const char *tag,
                     const char *class)
{
    markup_put(out, "<td class=\"%s\">", class);
    for (size_t i = 0; i < texts->len; ++i) {
        markup_put(out, i ? " " : "\n");
        put_element(out, tag, texts->items[i]);
    }
    markup_put(out, "</td>");
}

static void put_row(struct markup *out, const struct manual_port *port)
{
    markup_put(out, port->is_output ? "<tr class=\"output\"><th scope=\"row\">"
                                    : "<tr><th scope=\"row\">");
    put_element(out, "code", port->name);
    if (port->uniform)
        markup_put(
            out, " <small title=\"May not be connected to something that varies\">uniform</small>");
    markup_put(out, "</th>");
    put_cell(out, &port->cells[MANUAL_TYPE], "i", "type");
    put_cell(out, &port->cells[MANUAL_DEFAULT], "code", "default");
    put_cell(out, &port->cells[MANUAL_VALUES], "span", "values");
    put_cell(out, &port->cells[MANUAL_MEANING], "span", "meaning");
    markup_put(out, "</tr>\n");
}

static void put_table(struct markup *out, const struct manual_edition *edition)
{
    if (edition->num_ports == 0)
        return;
    markup_put(out, "<table><thead><tr><th>Input</th><th>Type</th><th>Default</th><th>Values</"
                    "th><th>Meaning</th></tr></thead>\n"
                    "<tbody>\n");
    const char *folder = "";
    for (size_t i = 0; i < edition->num_ports; ++i) {
        const struct manual_port *port = &edition->ports[i];
        if (!port->is_output && strcmp(port->folder, folder) != 0) {
            folder = port->folder;
            markup_put(out, "<tr class=\"folder\"><th colspan=\"5\" scope=\"rowgroup\">");
            markup_put(out, "%s", folder);
            markup_put(out, "</th></tr>\n");
        }
        put_row(out, port);
    }
    markup_put(out, "</tbody></table>\n");
}

/* ---- Nodes ---- */

static void put_signatures(struct markup *out, const struct manual_edition *edition)
{
    if (edition->num_variants == 1) {
        markup_put(out, "<p class=\"def\">");
        put_element(out, "code", edition->variants[0].def.name);
        markup_put(out, "</p>\n");
        return;
    }
    markup_put(out, "<details><summary>%zu signatures</summary><ul>\n", edition->num_variants);
    for (size_t i = 0; i < edition->num_variants; ++i) {
        markup_put(out, "<li>");
        put_element(out, "code", edition->variants[i].def.name);
        markup_put(out, " ");
        put_element(out, "span", edition->variants[i].signature);
        markup_put(out, "</li>\n");
    }
    markup_put(out, "</ul></details>\n");
}

/* An older version: its differences. */
static void put_older(struct markup *out, const struct manual_edition *edition,
                      const struct manual_edition *first)
{
    markup_put(out, "<details><summary>Version ");
    markup_put(out, "%s", edition->version);
    markup_put(out, "</summary>\n<p>");
    if (edition->num_ports == 0 && edition->missing.len == 0)
        markup_put(out, "The same inputs as ");
    else
        markup_put(out, "Differs from ");
    markup_put(out, "%s", *first->version ? first->version : "the version above");
    for (size_t i = 0; i < edition->missing.len; ++i) {
        markup_put(out, i ? ", " : "; it lacks ");
        put_element(out, "code", edition->missing.items[i]);
    }
    markup_put(out, ".</p>\n");
    put_table(out, edition);
    put_signatures(out, edition);
    markup_put(out, "</details>\n");
}

static void put_targets(const struct manual *manual, struct markup *out,
                        const struct manual_node *node)
{
    if (node->targets.len == manual->num_targets) {
        markup_put(out, "all targets");
        return;
    }
    for (size_t i = 0; i < node->targets.len; ++i) {
        markup_put(out, i ? ", " : "");
        markup_put(out, "%s", node->targets.items[i]);
    }
    if (node->targets.len == 0)
        markup_put(out, "<strong>not implemented</strong>");
}

static void put_picture(struct markup *out, const struct manual_node *node)
{
    if (!node->picture)
        return;
    char *name = file_name_of_element(node->id);
    markup_put(out,
               "<a class=\"picture\" title=\"The document of this picture\" "
               "href=\"pictures/%s.mtlx\"><img loading=\"lazy\" width=\"144\" height=\"144\" "
               "src=\"%s\" alt=\"Picture of %s",
               name, node->picture, node->name);
    free(name);
    markup_put(out, "\"/></a>\n");
}

static void put_node(const struct manual *manual, struct markup *out,
                     const struct manual_node *node)
{
    const struct manual_edition *first = &node->editions[0];
    markup_put(out, "<article id=\"");
    markup_put(out, "%s", node->id);
    markup_put(out, "\">\n");
    put_picture(out, node);
    markup_put(out, "<h3><a href=\"#");
    markup_put(out, "%s", node->id);
    markup_put(out, "\">");
    markup_put(out, "%s", node->name);
    markup_put(out, "</a>");
    if (*first->version) {
        markup_put(out, " <small>");
        markup_put(out, "%s", first->version);
        markup_put(out, "</small>");
    }
    markup_put(out, "</h3>\n");
    put_element(out, "p", node->text);
    markup_put(out, "\n<p class=\"facts\">");
    markup_put(out, "%s", node->file);
    markup_put(out, " \xc2\xb7 ");
    put_targets(manual, out, node);
    markup_put(out, "</p>\n");
    put_table(out, first);
    put_signatures(out, first);
    for (size_t i = 1; i < node->num_editions; ++i)
        put_older(out, &node->editions[i], first);
    markup_put(out, "</article>\n");
}

/* ---- The page ---- */

static bool begins_group(const struct manual *manual, size_t i)
{
    return i == 0 || strcmp(manual->nodes[i - 1].group, manual->nodes[i].group) != 0;
}

static void put_navigation(const struct manual *manual, struct markup *out)
{
    markup_put(out, "<nav>\n<h1><a href=\"#top\">Nodes</a></h1>\n"
                    "<input type=\"search\" placeholder=\"Search  /\" aria-label=\"Search\" "
                    "hidden=\"hidden\"/>\n<div>\n");
    for (size_t i = 0; i < manual->num_nodes; ++i) {
        if (begins_group(manual, i)) {
            markup_put(out, i ? "</ul></section>\n<section>" : "<section>");
            put_element(out, "h2", manual->nodes[i].group);
            markup_put(out, "<ul>\n");
        }
        markup_put(out, "<li><a href=\"#");
        markup_put(out, "%s", manual->nodes[i].id);
        markup_put(out, "\">");
        markup_put(out, "%s", manual->nodes[i].name);
        markup_put(out, "</a></li>\n");
    }
    markup_put(out, manual->num_nodes ? "</ul></section>\n</div></nav>\n" : "</div></nav>\n");
}

static void put_nodes(const struct manual *manual, struct markup *out)
{
    for (size_t i = 0; i < manual->num_nodes; ++i) {
        if (begins_group(manual, i)) {
            markup_put(out, i ? "</section>\n<section>" : "<section>");
            put_element(out, "h2", manual->nodes[i].group);
        }
        put_node(manual, out, &manual->nodes[i]);
    }
    markup_put(out, manual->num_nodes ? "</section>\n" : "");
}

void manual_write_html(const struct manual *manual, FILE *file)
{
    struct markup page = {file}, *out = &page;
    markup_put(out, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
                    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
                    "<meta name=\"color-scheme\" content=\"light dark\"/>\n<title>Node "
                    "reference</title>\n<style>\n");
    markup_lines(out, manual_style);
    markup_put(out, "</style>\n</head>\n<body id=\"top\">\n");
    put_navigation(manual, out);
    markup_put(
        out,
        "<main>\n<header>\n<p><strong>%zu</strong> nodes with <strong>%zu</strong> signatures, "
        "written by mxgen %s.</p>\n",
        manual->num_nodes, manual->num_variants, mxg_version_string());
    markup_put(
        out,
        "<p>An input without a value of its own takes the default. A default that is a name, as "
        "<code>Nworld</code>, is a "
        "property of the geometry. One number stands for equal components; where variants of a "
        "node differ, "
        "all types and defaults are listed.</p>\n</header>\n");
    put_nodes(manual, out);
    markup_put(
        out, "<p id=\"none\" hidden=\"hidden\">Nothing has these words.</p>\n</main>\n<script>\n");
    markup_lines(out, manual_script);
    markup_put(out, "</script>\n</body>\n</html>\n");
}
