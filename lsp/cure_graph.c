// SPDX-License-Identifier: Apache-2.0
/* Cures that change several elements: a conversion, one connection of several, a valid name. */
#include "lsp/cures.h"
#include "lsp/references.h"
#include "program/cli.h"
#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

static const char *const connections[] = {"nodename", "nodegraph", "interfacename"};
enum { NUM_CONNECTIONS = 3 };

/* The port at the place: an <input> or <output>. */
static uint32_t port_at(const struct cure *cure)
{
    uint32_t element = cure->place.element;
    bool is_port =
        query_is(&cure->query, element, "input") || query_is(&cure->query, element, "output");
    return is_port ? element : MODEL_NONE;
}

/* The text of an attribute with a space before it; "" if the element lacks it. Freed by the caller.
 */
static char *copy_attribute(const struct cure *cure, uint32_t element, const char *name)
{
    const struct model_attribute *attribute = query_attribute(&cure->query, element, name);
    uint32_t start = attribute ? attribute->name.start : 0, end = attribute ? attribute->end : 0;
    return cli_format("%s%.*s", attribute ? " " : "", (int)(end - start),
                      cure->query.text->bytes + start);
}

/* A name that no element of the scope has. */
static char *new_name(const struct cure *cure, uint32_t scope, const char *stem)
{
    for (unsigned number = 0;; ++number) {
        char *name = number ? cli_format("%s%u", stem, number) : cli_format("%s", stem);
        uint32_t child = model_first(cure->query.model, scope);
        while (child != MODEL_NONE
               && !query_equals(cure->query.text, query_value(&cure->query, child, "name"), name))
            child = model_next(cure->query.model, child);
        if (child == MODEL_NONE)
            return name;
        free(name);
    }
}

/* True if the library says that a <convert> does it. */
static bool can_convert(const struct cure *cure)
{
    for (size_t i = 0; i < cure->finding->num_notes; ++i)
        if (strncmp(cure->finding->notes[i].message, "insert a <convert>", 18) == 0)
            return true;
    return false;
}

/* The connection moves to the input of the new node, whose name takes its place. */
static void insert_convert(struct cure *cure, uint32_t port, uint32_t before, const char *name)
{
    const struct text *text = cure->query.text;
    uint32_t at = cure->query.model->elements[before].start,
             line = text->lines[text_line(text, at)];
    char *indent = cli_format("%.*s", (int)(at - line), text->bytes + line);
    indent[strspn(indent, " \t")] = '\0';
    char *parts[NUM_CONNECTIONS + 1];
    for (size_t i = 0; i <= NUM_CONNECTIONS; ++i)
        parts[i] = copy_attribute(cure, port, i < NUM_CONNECTIONS ? connections[i] : "output");
    char *node = cli_format(
        "<convert name=\"%s\" type=\"%s\">\n%s  <input name=\"in\" type=\"%s\"%s%s%s%s/>\n"
        "%s</convert>\n%s",
        name, cure_argument(cure, 2), indent, cure_argument(cure, 3), parts[0], parts[1], parts[2],
        parts[3], indent, indent);
    cure_replace(cure, (struct span){at, at}, node);
    free(node);
    for (size_t i = 0; i <= NUM_CONNECTIONS; ++i)
        free(parts[i]);
    free(indent);
}

void cure_convert(struct cure *cure)
{
    uint32_t port = port_at(cure);
    if (port == MODEL_NONE || !can_convert(cure))
        return;
    bool is_output = query_is(&cure->query, port, "output");
    uint32_t before = is_output ? port : cure->query.model->elements[port].parent,
             scope = before == MODEL_NONE ? before : cure->query.model->elements[before].parent;
    if (scope == MODEL_NONE)
        return;
    char *stem = cli_format("%s_of_%s", cure_argument(cure, 1), cure_argument(cure, 2)),
         *name = new_name(cure, scope, stem);
    insert_convert(cure, port, before, name);
    const struct model_attribute *node = query_attribute(&cure->query, port, "nodename");
    if (node)
        cure_replace(cure, node->value, name);
    for (size_t i = 0; i <= NUM_CONNECTIONS; ++i) {
        const struct model_attribute *moved =
            query_attribute(&cure->query, port, i < NUM_CONNECTIONS ? connections[i] : "output");
        if (!moved || moved == node)
            continue;
        char *text = cli_format("nodename=\"%s\"", name);
        if (!node && i < NUM_CONNECTIONS)
            cure_replace(cure, (struct span){moved->name.start, moved->end}, text);
        else
            cure_remove_attribute(cure, moved);
        free(text);
    }
    cure_finish(cure, "Insert a <convert>", true);
    free(name);
    free(stem);
}

void cure_keep_one(struct cure *cure)
{
    uint32_t port = port_at(cure);
    for (size_t kept = 0; kept < NUM_CONNECTIONS && port != MODEL_NONE; ++kept) {
        if (!query_attribute(&cure->query, port, connections[kept]))
            continue;
        for (size_t i = 0; i < NUM_CONNECTIONS; ++i) {
            const struct model_attribute *other =
                query_attribute(&cure->query, port, connections[i]);
            if (other && i != kept)
                cure_remove_attribute(cure, other);
        }
        char *title = cli_format("Keep '%s'", connections[kept]);
        cure_finish(cure, title, false);
        free(title);
    }
}

/* ---- Names ---- */

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

struct renaming {
    struct cure *cure;
    const char *name;
};

static void rename_reference(void *user_data, uint32_t element,
                             const struct model_attribute *attribute, struct span name)
{
    const struct renaming *renaming = user_data;
    (void)element;
    (void)attribute;
    cure_replace(renaming->cure, name, renaming->name);
}

void cure_bad_name(struct cure *cure)
{
    struct span old = query_value(&cure->query, cure->place.element, "name");
    if (old.start == old.end)
        return;
    char *name = memory_alloc(old.end - old.start + 2), *out = name;
    if (!is_letter(cure->query.text->bytes[old.start]))
        *out++ = '_';
    for (uint32_t at = old.start; at < old.end; ++at) {
        char c = cure->query.text->bytes[at];
        *out++ = is_letter(c) || (c >= '0' && c <= '9') ? c : '_';
    }
    char *title = cli_format("Change the name to '%s'", name);
    struct renaming renaming = {cure, name};
    cure_replace(cure, old, name);
    references_each(&cure->query, cure->place.element, rename_reference, &renaming);
    cure_finish(cure, title, true);
    free(title);
    free(name);
}
