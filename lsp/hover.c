// SPDX-License-Identifier: Apache-2.0
/* The subject under the cursor: the definition of a node, an input, a texture, an attribute. */
#include "lsp/check_document.h"
#include "lsp/element_infos.h"
#include "lsp/handlers.h"
#include "lsp/image_header.h"
#include "lsp/named_elements.h"
#include "lsp/system.h"
#include "lsp/wire.h"
#include "program/cli.h"
#include "program/file_name.h"
#include "program/memory.h"

#include <stdarg.h>
#include <stdlib.h>
#include <stdio.h>
#include <string.h>

/* Markdown that grows. */
struct page {
    char *text;
};

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static void
put(struct page *page, const char *format, ...)
{
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    int len = vsnprintf(NULL, 0, format, args);
    size_t old = page->text ? strlen(page->text) : 0;
    page->text = memory_resize(page->text, old + (size_t)(len > 0 ? len : 0) + 1);
    page->text[old] = '\0';
    if (len > 0)
        vsnprintf(page->text + old, (size_t)len + 1, format, again);
    va_end(again);
    va_end(args);
}

/* A line of a port: `name`: type = default, unit, range, values. */
static void put_port(struct page *page, const mxg_port *port)
{
    put(page, "`%s`: %s", port->name, port->type);
    if (*port->defaultgeomprop)
        put(page, " = geometric property `%s`", port->defaultgeomprop);
    else if (*port->value)
        put(page, " = `%s`", port->value);
    if (*port->unit)
        put(page, " %s", port->unit);
    if (port->uniform)
        put(page, ", uniform");
}

static void put_range(struct page *page, const mxg_port *port)
{
    const char *low = *port->uimin ? port->uimin : port->uisoftmin,
               *high = *port->uimax ? port->uimax : port->uisoftmax;
    if (*low || *high)
        put(page, "\n\nRange: %s to %s", *low ? low : "any", *high ? high : "any");
    if (*port->enum_names)
        put(page, "\n\nValues: %s", port->enum_names);
}

static bool put_input(struct page *page, const mxg_port *port)
{
    put_port(page, port);
    if (*port->uiname)
        put(page, " — %s", port->uiname);
    if (*port->doc)
        put(page, "\n\n%s", port->doc);
    put_range(page, port);
    return true;
}

static void put_picture(struct page *page, const struct lsp_query *query, const char *node)
{
    const char *folder = query->session->desc.pictures;
    if (!folder)
        return;
    char *name = file_name_of_element(node), *path = cli_format("%s/%s.png", folder, name),
         *uri = wire_uri(path);
    size_t size;
    char *begin = system_read(path, 1, &size);
    if (begin)
        put(page, "\n\n![picture of %s](<%s>)", node, uri);
    free(begin);
    free(uri);
    free(path);
    free(name);
}

/* The definition that the text chooses, with its picture, its outputs and inputs. */
static bool put_node(struct page *page, const struct lsp_query *query, uint32_t element)
{
    uint32_t index = catalogue_resolve(query, element);
    mxg_nodedef nodedef;
    if (index == MXG_NONE || !catalogue_nodedef(query, index, &nodedef))
        return false;
    put(page, "**%s**", nodedef.node);
    if (*nodedef.group)
        put(page, " (%s)", nodedef.group);
    put_picture(page, query, nodedef.node);
    put(page, "\n\n%s%sDefinition `%s`%s%s", nodedef.doc, *nodedef.doc ? "\n\n" : "", nodedef.name,
        *nodedef.version ? ", version " : "", nodedef.version);
    for (uint32_t i = 0; i < nodedef.num_outputs; ++i) {
        mxg_port port;
        if (catalogue_port(query, index, nodedef.num_inputs + i, &port))
            put(page, "%s`%s`: %s", i ? ", " : "\n\nGives ", port.name, port.type);
    }
    for (uint32_t i = 0; i < nodedef.num_inputs; ++i) {
        mxg_port port;
        put(page, i ? "\n* " : "\n\n* ");
        if (catalogue_port(query, index, i, &port))
            put_port(page, &port);
    }
    return true;
}

static bool put_element(struct page *page, const struct lsp_query *query, uint32_t element)
{
    char category[QUERY_NAME];
    mxg_port port;
    query_category(query, element, category, sizeof category);
    const struct element_info *info = elements_find(category);
    if (!info)
        return put_node(page, query, element);
    if (strcmp(category, "input") == 0 && catalogue_port_of(query, element, &port))
        return put_input(page, &port);
    put(page, "**%s**\n\n%s", category, info->doc);
    if (strcmp(category, "nodegraph") == 0) {
        struct page node = {0};
        if (put_node(&node, query, element))
            put(page, "\n\n%s", node.text);
        free(node.text);
    }
    return true;
}

/* ---- Values ---- */

/* The colour space of a value: that of the element or of the nearest one around it. */
static void put_colorspace(struct page *page, const struct lsp_query *query, uint32_t element)
{
    char space[QUERY_NAME] = "";
    while (element != MODEL_NONE && !*query_text(query, element, "colorspace", space, sizeof space))
        element = query->model->elements[element].parent;
    if (*space)
        put(page, "\n\nColour space: %s", space);
}

static bool put_texture(struct page *page, const struct lsp_query *query, uint32_t element,
                        struct span value)
{
    char prefix[QUERY_NAME];
    names_file_prefix(query, element, prefix, sizeof prefix);
    char *file = cli_format("%s%.*s", prefix, (int)(value.end - value.start),
                            query->text->bytes + value.start),
         *path = disk_join(query->document->path, file);
    struct image_header header;
    size_t size;
    query->session->disk.from = check_origin(query->document);
    char *bytes = disk_read(&query->session->disk, path, IMAGE_HEADER_SIZE, &size);
    put(page, "`%s`", file);
    if (!bytes)
        put(page, "\n\nThe file is not there, or outside of the workspace.");
    else if (image_header_read(bytes, size, &header))
        put(page, "\n\n%s, %u × %u", header.format, (unsigned)header.width,
            (unsigned)header.height);
    put_colorspace(page, query, element);
    free(bytes);
    free(path);
    free(file);
    return true;
}

/* The element that a value names. */
static bool put_target(struct page *page, const struct lsp_query *query, const struct place *place)
{
    uint32_t target = names_target(query, place->element, place->attribute);
    char category[QUERY_NAME], name[QUERY_NAME], type[QUERY_NAME];
    mxg_element_info info;
    if (target == MODEL_NONE && names_other_files(query, place->element, place->attribute)
        && names_find_included(query, place->attribute->value, &info)) {
        put(page, "`<%s name=\"%s\" type=\"%s\">` in %s", info.category, info.name, info.type,
            info.file);
        return true;
    }
    if (target == MODEL_NONE || query_equals(query->text, place->attribute->name, "name"))
        return false;
    query_category(query, target, category, sizeof category);
    query_text(query, target, "name", name, sizeof name);
    names_own_type(query, target, type, sizeof type);
    put(page, "`<%s name=\"%s\" type=\"%s\">`\n\n", category, name, type);
    put_element(page, query, target);
    return true;
}

static bool put_nodedef(struct page *page, const struct lsp_query *query, struct span value)
{
    char *name = cli_copy(query->text->bytes + value.start, value.end - value.start);
    uint32_t index = catalogue_find_nodedef(query, name);
    mxg_nodedef nodedef;
    bool is_known = index != MXG_NONE && catalogue_nodedef(query, index, &nodedef);
    if (is_known)
        put(page, "**%s** `%s`\n\n%s", nodedef.node, nodedef.name, nodedef.doc);
    free(name);
    return is_known;
}

static bool put_value(struct page *page, const struct lsp_query *query, const struct place *place)
{
    char type[QUERY_NAME];
    mxg_port port;
    const struct model_attribute *attribute = place->attribute;
    bool is_value = query_equals(query->text, attribute->name, "value");
    names_type(query, place->element, type, sizeof type);
    if (is_value && strcmp(type, "filename") == 0)
        return put_texture(page, query, place->element, attribute->value);
    if (query_equals(query->text, attribute->name, "nodedef"))
        return put_nodedef(page, query, attribute->value);
    if (put_target(page, query, place))
        return true;
    if (is_value || query_equals(query->text, attribute->name, "name"))
        return catalogue_port_of(query, place->element, &port)
                   ? put_input(page, &port)
                   : put_element(page, query, place->element);
    return false;
}

static bool put_attribute(struct page *page, const struct lsp_query *query,
                          const struct place *place)
{
    char *name = cli_copy(query->text->bytes + place->attribute->name.start,
                          place->attribute->name.end - place->attribute->name.start);
    const struct attribute_info *info = attributes_find(name);
    if (info)
        put(page, "`%s`: %s", name, info->doc);
    free(name);
    return info != NULL;
}

json_t *handle_hover(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    struct lsp_query query;
    if (!lsp_query(session, params, &query, error))
        return NULL;
    struct place place = query_place(&query);
    struct page page = {0};
    struct span span = {query.offset, query.offset};
    bool has_text = false;
    if (place.part == PLACE_CATEGORY) {
        span = query.model->elements[place.element].name;
        has_text = put_element(&page, &query, place.element);
    } else if (place.part == PLACE_VALUE) {
        span = place.attribute->value;
        has_text = put_value(&page, &query, &place);
    } else if (place.part == PLACE_ATTRIBUTE) {
        span = place.attribute->name;
        has_text = put_attribute(&page, &query, &place);
    }
    json_t *hover = has_text ? json_object() : NULL;
    if (hover) {
        json_object_set_new(hover, "contents", wire_markdown(page.text));
        json_object_set_new(hover, "range", wire_range(session, query.text, span));
    }
    free(page.text);
    return hover;
}
