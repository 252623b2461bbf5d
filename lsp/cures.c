// SPDX-License-Identifier: Apache-2.0
#include "lsp/cures.h"

#include "program/cli.h"

#include <stdlib.h>
#include <string.h>

/* ---- Removing ---- */

static void remove_element(struct cure *cure)
{
    char category[QUERY_NAME];
    if (cure->place.element == MODEL_NONE)
        return;
    cure_remove_element(cure, cure->place.element);
    char *title = cli_format("Remove <%s>", query_category(&cure->query, cure->place.element,
                                                           category, sizeof category));
    cure_finish(cure, title, false);
    free(title);
}

static void remove_named(struct cure *cure, const char *name)
{
    const struct model_attribute *attribute =
        query_attribute(&cure->query, cure->place.element, name);
    if (!attribute)
        return;
    cure_remove_attribute(cure, attribute);
    char *title = cli_format("Remove '%s'", name);
    cure_finish(cure, title, false);
    free(title);
}

static void remove_attribute(struct cure *cure)
{
    if (!cure->place.attribute)
        return;
    struct span name = cure->place.attribute->name;
    char *text = cli_copy(cure->query.text->bytes + name.start, name.end - name.start);
    remove_named(cure, text);
    free(text);
}

static void remove_value(struct cure *cure)
{
    remove_named(cure, "value");
}

static void remove_interfacename(struct cure *cure)
{
    remove_named(cure, "interfacename");
}

static void remove_unit(struct cure *cure)
{
    remove_named(cure, "unit");
}

/* Removes what is in a part of the text beside white space. */
static void remove_words(struct cure *cure, struct span part)
{
    const char *bytes = cure->query.text->bytes;
    while (part.start < part.end && strchr(" \t\r\n", bytes[part.start]))
        ++part.start;
    while (part.end > part.start && strchr(" \t\r\n", bytes[part.end - 1]))
        --part.end;
    if (part.start < part.end)
        cure_replace(cure, part, "");
}

/* Text up to the next tag. */
static void remove_text(struct cure *cure)
{
    uint32_t end = cure->span.start;
    while (end < cure->query.text->len && cure->query.text->bytes[end] != '<')
        ++end;
    remove_words(cure, (struct span){cure->span.start, end});
    cure_finish(cure, "Remove the text", true);
}

/* All text of an element that is in none of its children. */
static void remove_stray_text(struct cure *cure)
{
    const struct model *model = cure->query.model;
    if (cure->place.element == MODEL_NONE)
        return;
    const struct model_element *element = &model->elements[cure->place.element];
    uint32_t at = element->tag_end;
    for (uint32_t child = cure->place.element + 1; child < element->after;
         child = model->elements[child].after) {
        remove_words(cure, (struct span){at, model->elements[child].start});
        at = model->elements[child].end;
    }
    remove_words(cure, (struct span){at, element->close});
    cure_finish(cure, "Remove the text", true);
}

static void remove_before(struct cure *cure)
{
    const char *declaration = strstr(cure->query.text->bytes, "<?xml");
    if (declaration)
        cure_replace(cure, (struct span){0, (uint32_t)(declaration - cure->query.text->bytes)}, "");
    cure_finish(cure, "Remove the text before the declaration", true);
}

static void remove_mark(struct cure *cure)
{
    if (strncmp(cure->query.text->bytes, "\xef\xbb\xbf", 3) == 0)
        cure_replace(cure, (struct span){0, 3}, "");
    cure_finish(cure, "Remove the byte-order mark", true);
}

/* ---- Attributes ---- */

static void set_attribute(struct cure *cure, const char *name, const char *value)
{
    if (cure->place.element == MODEL_NONE || !*name)
        return;
    cure_set_attribute(cure, cure->place.element, name, value);
    char *title = cli_format("Write %s=\"%s\"", name, value);
    cure_finish(cure, title, true);
    free(title);
}

/* How many numbers a value of a type has; 0: it has none, or any number of them. */
static unsigned num_numbers(const char *type)
{
    static const struct {
        const char *type;
        unsigned num;
    } types[] = {{"float", 1},   {"integer", 1}, {"vector2", 2},  {"vector3", 3},  {"color3", 3},
                 {"vector4", 4}, {"color4", 4},  {"matrix33", 9}, {"matrix44", 16}};
    for (size_t i = 0; i < sizeof types / sizeof *types; ++i)
        if (strcmp(types[i].type, type) == 0)
            return types[i].num;
    return 0;
}

/*
 * Gives a value as many numbers as its new type has: one number stands for all, and further ones
 * are cut. False: the text does not tell the others.
 */
static bool fit_value(struct cure *cure, const char *type)
{
    const struct model_attribute *value =
        query_attribute(&cure->query, cure->place.element, "value");
    unsigned wanted = num_numbers(type), num = 1;
    char text[QUERY_NAME];
    if (!value || !wanted)
        return true;
    query_text(&cure->query, cure->place.element, "value", text, sizeof text);
    for (char *comma = text; (comma = strchr(comma, ',')) != NULL; ++comma)
        if (num++ == wanted)
            *comma = '\0';
    if (num == wanted || strlen(text) > 32)
        return num == wanted;
    if (num > wanted) {
        cure_replace(cure, value->value, text);
        return true;
    }
    char all[QUERY_NAME * 4] = "";
    for (unsigned i = 0; i < wanted && num == 1; ++i)
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", i ? ", " : "", text);
    if (*all)
        cure_replace(cure, value->value, all);
    return num == 1;
}

static void set_input_type(struct cure *cure)
{
    if (fit_value(cure, cure_argument(cure, 2)))
        set_attribute(cure, "type", cure_argument(cure, 2));
}

static void set_version(struct cure *cure)
{
    set_attribute(cure, "version", "1.39");
}

static void set_output(struct cure *cure)
{
    set_attribute(cure, "output", cure_argument(cure, 2));
}

static void set_unittype(struct cure *cure)
{
    set_attribute(cure, "unittype", cure_argument(cure, 2));
}

/* The type that the definition of a node gives an input, or a node that has one definition. */
static void add_attribute(struct cure *cure)
{
    const struct lsp_query *query = &cure->query;
    uint32_t element = cure->place.element;
    mxg_port port;
    mxg_nodedef nodedef;
    if (element == MODEL_NONE || strcmp(cure_argument(cure, 1), "type") != 0)
        return;
    uint32_t index = query_is_node(query, element) ? catalogue_resolve(query, element) : MXG_NONE;
    if (catalogue_port_of(query, element, &port))
        set_attribute(cure, "type", port.type);
    else if (index != MXG_NONE && catalogue_nodedef(query, index, &nodedef)
             && nodedef.num_outputs == 1 && catalogue_port(query, index, nodedef.num_inputs, &port))
        set_attribute(cure, "type", port.type);
}

static void add_name(struct cure *cure)
{
    char category[QUERY_NAME], name[QUERY_NAME + 16];
    const struct lsp_query *query = &cure->query;
    uint32_t parent = cure->place.element == MODEL_NONE
                          ? MODEL_NONE
                          : query->model->elements[cure->place.element].parent,
             count = 0;
    query_category(query, cure->place.element, category, sizeof category);
    for (uint32_t child = model_first(query->model, parent); child != MODEL_NONE;
         child = model_next(query->model, child))
        ++count;
    snprintf(name, sizeof name, "%s%u", category, (unsigned)count);
    set_attribute(cure, "name", name);
}

static void rename_nodename(struct cure *cure)
{
    if (cure->place.attribute)
        cure_replace(cure, cure->place.attribute->name, "node");
    cure_finish(cure, "Write 'node'", true);
}

static void write_input(struct cure *cure)
{
    if (query_is(&cure->query, cure->place.element, "param")
        || query_is(&cure->query, cure->place.element, "parameter"))
        cure_rename_element(cure, cure->place.element, "input");
    cure_finish(cure, "Write an <input>", true);
}

/* ---- Values ---- */

/* The first place of a text in the value; empty: there is none. */
static struct span find_in_value(const struct cure *cure, const char *word)
{
    struct span value = cure->place.attribute ? cure->place.attribute->value : (struct span){0, 0};
    uint32_t len = (uint32_t)strlen(word);
    for (uint32_t at = value.start; len && at + len <= value.end; ++at)
        if (memcmp(cure->query.text->bytes + at, word, len) == 0)
            return (struct span){at, at + len};
    return (struct span){0, 0};
}

/* The message reads the value as this. */
static void replace_number(struct cure *cure)
{
    struct span word = find_in_value(cure, cure_argument(cure, 0));
    char *title = cli_format("Write %s", cure_argument(cure, 1));
    if (word.end)
        cure_replace(cure, word, cure_argument(cure, 1));
    cure_finish(cure, title, true);
    free(title);
}

static void replace_value(struct cure *cure)
{
    replace_number(cure);
}

/* Keeps as many numbers as the message says: "first" or "first 3". */
static void cut_numbers(struct cure *cure)
{
    unsigned long count = 1;
    for (size_t i = 0; i < cure->finding->num_arguments; ++i)
        if (strncmp(cure_argument(cure, i), "first ", 6) == 0)
            count = strtoul(cure_argument(cure, i) + 6, NULL, 10);
    struct span value = find_in_value(cure, cure_argument(cure, 0));
    uint32_t at = value.start;
    while (at < value.end && (count -= cure->query.text->bytes[at] == ',') != 0)
        ++at;
    if (at < value.end)
        cure_replace(cure, (struct span){at, value.end}, "");
    cure_finish(cure, "Remove the other numbers", true);
}

static void swap_range(struct cure *cure)
{
    const struct model_attribute *low = query_attribute(&cure->query, cure->place.element,
                                                        cure_argument(cure, 0)),
                                 *high = query_attribute(&cure->query, cure->place.element,
                                                         cure_argument(cure, 2));
    if (!low || !high)
        return;
    cure_replace(cure, low->value, cure_argument(cure, 3));
    cure_replace(cure, high->value, cure_argument(cure, 1));
    cure_finish(cure, "Exchange the values", true);
}

/* ---- XML ---- */

static void escape(struct cure *cure, char c, const char *entity)
{
    uint32_t at = cure->span.start;
    char *title = cli_format("Write '%s'", entity);
    if (cure->query.text->bytes[at] == c)
        cure_replace(cure, (struct span){at, at + 1}, entity);
    cure_finish(cure, title, true);
    free(title);
}

static void escape_ampersand(struct cure *cure)
{
    escape(cure, '&', "&amp;");
}

static void escape_less(struct cure *cure)
{
    escape(cure, '<', "&lt;");
}

static void declare_include(struct cure *cure)
{
    uint32_t root = query_root(&cure->query);
    if (root == MODEL_NONE || strcmp(cure_argument(cure, 0), "xi") != 0)
        return;
    cure_set_attribute(cure, root, "xmlns:xi", "http://www.w3.org/2001/XInclude");
    cure_finish(cure, "Declare the prefix 'xi'", true);
}

/* ---- Suggestions ---- */

/* The part of an argument between two texts; NULL: it is not there. The caller frees it. */
static char *between(const char *argument, const char *before, const char *after)
{
    const char *start = strstr(argument, before), *end = NULL;
    if (start)
        end = strstr(start + strlen(before), after);
    return end ? cli_copy(start + strlen(before), (size_t)(end - start) - strlen(before)) : NULL;
}

/* Replaces the word that the message is about: a category, an attribute, a value or a part of one.
 */
static bool replace_word(struct cure *cure, const char *suggestion)
{
    if (cure->place.part == PLACE_CATEGORY) {
        cure_rename_element(cure, cure->place.element, suggestion);
        return true;
    }
    if (cure->place.part == PLACE_ATTRIBUTE) {
        cure_replace(cure, cure->place.attribute->name, suggestion);
        return true;
    }
    for (size_t i = 0; cure->place.part == PLACE_VALUE && i < cure->finding->num_arguments; ++i) {
        struct span word = find_in_value(cure, cure_argument(cure, i));
        bool is_whole =
            word.end && query_is_same(cure->query.text, word, cure->place.attribute->value);
        bool is_here = word.end && word.start == cure->span.start && word.end == cure->span.end;
        if (!is_whole && !is_here)
            continue;
        cure_replace(cure, word, suggestion);
        return true;
    }
    return false;
}

/* A value that should be a connection: "did you mean nodename="x"?". */
static void suggest_connection(struct cure *cure, const char *argument)
{
    char *node = between(argument, "(did you mean nodename=\"", "\"?)");
    char *text = node ? cli_format("nodename=\"%s\"", node) : NULL,
         *title = node ? cli_format("Write %s", text) : NULL;
    if (node && cure->place.attribute)
        cure_replace(cure,
                     (struct span){cure->place.attribute->name.start, cure->place.attribute->end},
                     text);
    cure_finish(cure, title, true);
    free(title);
    free(text);
    free(node);
}

/* False if the name of an input is taken in its node, or stands for a value of another type. */
static bool can_take_name(const struct cure *cure, const char *name)
{
    const struct lsp_query *query = &cure->query;
    uint32_t input = cure->place.element;
    if (input == MODEL_NONE || !query_is(query, input, "input"))
        return true;
    uint32_t node = query->model->elements[input].parent;
    char other[QUERY_NAME], type[QUERY_NAME];
    mxg_port port;
    uint32_t child = model_first(query->model, node);
    for (; child != MODEL_NONE; child = model_next(query->model, child))
        if (strcmp(query_text(query, child, "name", other, sizeof other), name) == 0)
            return false;
    if (!query_is_node(query, node)
        || !catalogue_find_port(query, catalogue_resolve(query, node), name, false, &port))
        return true;
    query_text(query, input, "type", type, sizeof type);
    return !*type || strcmp(type, port.type) == 0;
}

static void suggest(struct cure *cure)
{
    if (strcmp(cure->finding->id, "excess-numbers") == 0)
        return; /* it suggests another input, whose type the text does not have */
    bool is_input = strcmp(cure->finding->id, "unknown-input") == 0;
    for (size_t i = 0; i < cure->finding->num_arguments; ++i) {
        char *suggestion = between(cure_argument(cure, i), "(did you mean '", "'?)");
        char *title = suggestion ? cli_format("Change to '%s'", suggestion) : NULL;
        if (suggestion && (!is_input || can_take_name(cure, suggestion))
            && replace_word(cure, suggestion))
            cure_finish(cure, title, true);
        else
            suggest_connection(cure, cure_argument(cure, i));
        free(title);
        free(suggestion);
    }
}

/* ---- The table ---- */

static const struct cure_row {
    const char *id;
    enum lsp_tag tag;
    void (*make)(struct cure *cure);
} cures[] = {
#define CURE(id, tag, make) {id, tag, make},
#include "lsp/cures.def"
#undef CURE
};
enum { NUM_CURES = sizeof cures / sizeof *cures };

enum lsp_tag cures_tag(const char *id)
{
    for (size_t i = 0; i < NUM_CURES; ++i)
        if (strcmp(cures[i].id, id) == 0)
            return cures[i].tag;
    return LSP_NO_TAG;
}

void cures_add(struct cure *cure)
{
    suggest(cure);
    for (size_t i = 0; i < NUM_CURES; ++i)
        if (cures[i].make && strcmp(cures[i].id, cure->finding->id) == 0)
            cures[i].make(cure);
}
