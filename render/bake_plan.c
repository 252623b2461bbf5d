// SPDX-License-Identifier: Apache-2.0
#include "render/bake_plan.h"

#include "program/cli.h"
#include "program/files.h"
#include "program/memory.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_STEPS = 10000 }; /* of connections; more are a cycle */

/* ---- The document ---- */

char *bake_path(const mxg_document *document, mxg_element element)
{
    size_t len = mxg_document_element_path(document, element, NULL, 0);
    char *path = memory_alloc(len + 1);
    mxg_document_element_path(document, element, path, len + 1);
    return path;
}

/* 0 is the root, as in mxg_document_find_element. */
static mxg_element or_root(const mxg_document *document, mxg_element element)
{
    return element ? element : mxg_document_find_element(document, 0, "");
}

mxg_element_info bake_element(const mxg_document *document, mxg_element element)
{
    mxg_element_info info = {sizeof info};
    mxg_document_element(document, or_root(document, element), &info);
    return info;
}

const char *bake_attribute(const mxg_document *document, mxg_element element, const char *name)
{
    mxg_attribute attribute = {sizeof attribute};
    element = or_root(document, element);
    uint32_t index = mxg_document_find_attribute(document, element, name);
    return index != MXG_NONE
                   && mxg_document_attribute(document, element, index, &attribute) == MXG_OK
               ? attribute.value
               : NULL;
}

const char *bake_inherited(const mxg_document *document, mxg_element element, const char *name)
{
    const char *value = bake_attribute(document, element, name);
    while (!value && element) {
        element = bake_element(document, element).parent;
        value = bake_attribute(document, element, name);
    }
    return value;
}

mxg_element bake_find_output(const mxg_document *document, mxg_element graph, const char *name)
{
    mxg_element child = bake_element(document, graph).first_child;
    while (child) {
        mxg_element_info info = bake_element(document, child);
        if (strcmp(info.category, "output") == 0 && (!*name || strcmp(info.name, name) == 0))
            return child;
        child = info.next;
    }
    return 0;
}

static bool is_category(const mxg_document *document, mxg_element element, const char *category)
{
    return strcmp(bake_element(document, element).category, category) == 0;
}

struct bake_end bake_follow(const mxg_document *document, mxg_element port)
{
    for (int step = 0; port && step < MAX_STEPS; ++step) {
        mxg_connection connection = {sizeof connection};
        if (mxg_document_connection(document, port, &connection) != MXG_OK)
            return (struct bake_end){.value = bake_attribute(document, port, "value") ? port : 0,
                                     .output = ""};
        if (is_category(document, connection.source, "nodegraph"))
            port = bake_find_output(document, connection.source, connection.output);
        else if (*connection.interfacename || is_category(document, connection.source, "output"))
            port = connection.source;
        else if (is_category(document, connection.source, "dot"))
            port = mxg_document_find_element(document, connection.source, "in");
        else
            return (struct bake_end){connection.source, connection.output, 0};
    }
    return (struct bake_end){.output = ""};
}

/* ---- Nodes that stay ---- */

/* True for the texture coordinates that an image has by itself. */
static bool is_default_place(const mxg_document *document, mxg_element node)
{
    mxg_element index = mxg_document_find_element(document, node, "index");
    return is_category(document, node, "texcoord")
           && (!index || strcmp(bake_attribute(document, index, "value"), "0") == 0);
}

/* True if all inputs of a node are values, but for texture coordinates as they are, or of `place`.
 */
static bool has_values(const mxg_document *document, mxg_element node, mxg_element place)
{
    for (mxg_element child = bake_element(document, node).first_child; child;) {
        mxg_element_info input = bake_element(document, child);
        struct bake_end from = bake_follow(document, child);
        bool is_place = strcmp(input.name, "texcoord") == 0;
        if (strcmp(input.category, "input") == 0 && from.node
            && !(is_place && (from.node == place || is_default_place(document, from.node))))
            return false;
        child = input.next;
    }
    return true;
}

/* True for texture coordinates that are scaled and moved, but not turned. */
static bool is_plain_place(const struct bake_plan *plan, mxg_element node)
{
    const mxg_document *document = plan->document;
    mxg_value value = {sizeof value};
    mxg_element turn = mxg_document_find_element(document, node, "rotate");
    if (!plan->keeps_places || !is_category(document, node, "place2d")
        || !mxg_document_find_element(document, node, "texcoord") || !has_values(document, node, 0))
        return false;
    mxg_element from = turn ? bake_follow(document, turn).value : 0;
    return !turn || (mxg_document_value(document, from, &value) == MXG_OK && value.values[0] == 0);
}

/* True for an image whose reader does not know the space of its colors. */
static bool has_other_space(const struct bake_plan *plan, mxg_element image)
{
    mxg_element file = mxg_document_find_element(plan->document, image, "file");
    const char *space = file ? bake_inherited(plan->document, file, "colorspace") : NULL;
    return plan->spaces && space && !args_is_one_of(space, plan->spaces)
           && strncmp(bake_element(plan->document, image).type, "color", 5) == 0;
}

/* True for an image that is drawn because its file is missing. */
static bool is_missing(const struct bake_plan *plan, mxg_element image)
{
    mxg_element port = mxg_document_find_element(plan->document, image, "file"),
                value = port ? bake_follow(plan->document, port).value : 0;
    const char *file = value ? bake_attribute(plan->document, value, "value") : "";
    if (!plan->drawn_missing || !*file || bake_is_set(file))
        return false;
    char *path = bake_file_path(plan->document, plan->drawn_missing, value, file);
    bool is_there = files_is_regular(path);
    free(path);
    return !is_there;
}

/* True if the sizes of a tiled image in the world are of one unit, so their ratio needs none. */
static bool has_one_unit(const mxg_document *document, mxg_element node)
{
    static const char *const names[] = {"realworldimagesize", "realworldtilesize"};
    const char *units[2];
    for (size_t i = 0; i < 2; ++i) {
        mxg_element size = mxg_document_find_element(document, node, names[i]);
        const char *unit = size ? bake_attribute(document, size, "unit") : NULL;
        units[i] = unit ? unit : "";
    }
    return strcmp(units[0], units[1]) == 0;
}

/* True for an image node whose inputs are values. */
static bool passes(const struct bake_plan *plan, mxg_element node)
{
    const mxg_document *document = plan->document;
    mxg_element port = mxg_document_find_element(document, node, "texcoord"),
                place = port ? bake_follow(document, port).node : 0;
    bool is_image = is_category(document, node, "image"),
         is_tiled = plan->keeps_places && is_category(document, node, "tiledimage")
                    && has_one_unit(document, node);
    if ((!is_image && !is_tiled) || has_other_space(plan, node) || is_missing(plan, node))
        return false;
    return has_values(document, node, is_image && is_plain_place(plan, place) ? place : 0);
}

/* Materials, shaders, closures, maps of normals, images without changes, and what places them. */
static bool stays(const struct bake_plan *plan, mxg_element node)
{
    static const char *const types[] = {
        "material", "surfaceshader", "displacementshader", "volumeshader", "BSDF", "EDF", "VDF",
        NULL};
    mxg_element_info info = bake_element(plan->document, node);
    return args_is_one_of(info.type, types) || strcmp(info.category, "normalmap") == 0
           || passes(plan, node) || is_plain_place(plan, node)
           || (plan->keeps_places && is_default_place(plan->document, node));
}

/* ---- The plan ---- */

/* Takes a name; false: it is taken. File systems may not tell "gold" from "Gold". */
static bool take(struct bake_plan *plan, const char *name, bool is_file)
{
    bool is_new, is_new_file = true;
    char *key = cli_format("/%s", name);
    for (char *c = key; *c; ++c)
        *c = (char)tolower((unsigned char)*c);
    names_add(&plan->names, name, &is_new);
    if (is_new && is_file)
        names_add(&plan->names, key, &is_new_file);
    free(key);
    return is_new && is_new_file;
}

static bool is_letter(char c, bool is_first)
{
    static const char letters[] = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
    return c && strchr(is_first ? letters + 10 : letters, c);
}

/*
 * Letters, digits and '_', and no digit first, as names are in documents. What is no file may have
 * a namespace, "show:gold". The caller frees it.
 */
static char *valid_name(const char *wanted, bool is_file)
{
    enum { MAX_NAME = 120 };
    char *name = cli_format("%s%.*s", isdigit((unsigned char)*wanted) ? "_" : "", MAX_NAME, wanted);
    for (char *c = name; *c; ++c) {
        bool is_colon = *c == ':' && !is_file && c > name && is_letter(c[1], true);
        *c = is_colon || is_letter(*c, false) ? *c : '_';
    }
    return name;
}

/*
 * A name that is not taken yet. The caller frees it. A name that has to change gives way to an
 * element of the document that has such a name already.
 */
static char *free_name(struct bake_plan *plan, const char *wanted, bool is_file)
{
    char *base = valid_name(wanted, is_file), *name = cli_format("%s", base);
    bool is_changed = strcmp(base, wanted) != 0;
    for (unsigned number = 2; (is_changed && mxg_document_find_element(plan->document, 0, name))
                              || !take(plan, name, is_file);
         ++number) {
        free(name);
        name = cli_format("%s_%u", base, number);
    }
    free(base);
    return name;
}

char *bake_plan_name(struct bake_plan *plan, const char *wanted)
{
    return free_name(plan, wanted, false);
}

char *bake_plan_file(struct bake_plan *plan, const char *wanted)
{
    return free_name(plan, wanted, true);
}

static bool is_same_drawing(const struct bake_drawing *drawing, const struct bake_end *end,
                            bool is_direction)
{
    return drawing->source == end->node && drawing->is_direction == is_direction
           && strcmp(drawing->output, end->output) == 0;
}

/* The output that a connection without a name means, of a node with several: the first of its type.
 * "": the only one. */
static const char *default_output(const mxg_document *document, mxg_element node, const char *type)
{
    mxg_port port = {sizeof port};
    mxg_nodedef nodedef = {sizeof nodedef};
    uint32_t index = mxg_document_find_nodedef(document, node);
    if (index == MXG_NONE || mxg_document_nodedef(document, index, &nodedef) != MXG_OK
        || nodedef.num_outputs == 1)
        return "";
    for (uint32_t i = 0; i < nodedef.num_outputs; ++i)
        if (mxg_document_port(document, index, nodedef.num_inputs + i, &port) == MXG_OK
            && strcmp(port.type, type) == 0)
            return port.name;
    return "";
}

static size_t add_drawing(struct bake_plan *plan, const struct bake_node *node,
                          const struct bake_input *input, const struct bake_end *end,
                          bool is_direction)
{
    for (size_t i = 0; i < plan->num_drawings; ++i)
        if (is_same_drawing(&plan->drawings[i], end, is_direction))
            return i;
    plan->drawings = memory_grow(plan->drawings, plan->num_drawings, sizeof *plan->drawings);
    char *name = cli_format("%s_%s", node->name, node->is_output ? "image" : input->name);
    char *path = bake_path(plan->document, end->node);
    plan->drawings[plan->num_drawings] =
        (struct bake_drawing){.source = end->node,
                              .output = end->output,
                              .type = input->type,
                              .is_direction = is_direction,
                              .port = input->port,
                              .name = free_name(plan, name, true),
                              .path = cli_format(*end->output ? "%s/%s" : "%s", path, end->output)};
    free(name);
    free(path);
    return plan->num_drawings++;
}

/* True for an input whose default is a direction of the surface in the world. */
static bool is_direction(const mxg_document *document, mxg_element node, const char *input)
{
    mxg_port port = {sizeof port};
    mxg_nodedef nodedef = {sizeof nodedef};
    uint32_t index = mxg_document_find_nodedef(document, node);
    if (index == MXG_NONE || mxg_document_nodedef(document, index, &nodedef) != MXG_OK)
        return false;
    for (uint32_t i = 0; i < nodedef.num_inputs; ++i)
        if (mxg_document_port(document, index, i, &port) == MXG_OK && strcmp(port.name, input) == 0)
            return strcmp(port.defaultgeomprop, "Nworld") == 0
                   || strcmp(port.defaultgeomprop, "Tworld") == 0
                   || strcmp(port.defaultgeomprop, "Bworld") == 0;
    return false;
}

size_t bake_plan_find(const struct bake_plan *plan, mxg_element element)
{
    size_t i = 0;
    while (i < plan->num_nodes && plan->nodes[i].element != element)
        ++i;
    return i;
}

/* A node whose inputs are being followed. */
struct visit {
    struct bake_node node;
    mxg_element next; /* the child to look at */
};

struct visits {
    struct visit *items;
    size_t num;
};

/* An output stands beside all else in the new document: "NG_color" for "NG/color". */
static void begin_node(struct bake_plan *plan, struct visits *visits, mxg_element element)
{
    mxg_element_info info = bake_element(plan->document, element);
    bool is_output = is_category(plan->document, element, "output");
    char *path = is_output ? bake_path(plan->document, element) : NULL;
    struct visit visit = {{.element = element,
                           .category = info.category,
                           .type = info.type,
                           .name = free_name(plan, path ? path : info.name, false),
                           .is_output = is_output},
                          is_output ? element : info.first_child};
    MEMORY_PUSH(visits->items, visits->num, visit);
    free(path);
}

static void end_node(struct bake_plan *plan, struct visits *visits)
{
    MEMORY_PUSH(plan->nodes, plan->num_nodes, visits->items[--visits->num].node);
}

/*
 * Adds an input of the node on top. false: it reads a node that must come first, which is now on
 * top.
 */
static bool add_input(struct bake_plan *plan, struct visits *visits, mxg_element port)
{
    const mxg_document *document = plan->document;
    struct bake_node *node = &visits->items[visits->num - 1].node;
    mxg_element_info info = bake_element(document, port);
    struct bake_end end = bake_follow(document, port);
    struct bake_input input = {.port = port, .name = info.name, .type = info.type};
    bool is_image =
        strcmp(node->category, "image") == 0 || strcmp(node->category, "tiledimage") == 0;
    if ((!end.node && !end.value) || (end.node && is_image && is_default_place(document, end.node)))
        return true;
    if (end.node && stays(plan, end.node)) {
        input.way = BAKE_NODE;
        input.index = bake_plan_find(plan, end.node);
        if (input.index == plan->num_nodes) {
            begin_node(plan, visits, end.node);
            return false;
        }
    } else if (end.value) {
        input.way = BAKE_KEEPS;
        input.origin = end.value;
    } else {
        input.way = BAKE_DRAWS;
        if (!*end.output)
            end.output = default_output(document, end.node, info.type);
        input.index =
            add_drawing(plan, node, &input, &end, is_direction(document, node->element, info.name));
    }
    MEMORY_PUSH(node->inputs, node->num_inputs, input);
    return true;
}

/* Adds the next child of the node on top, or what an output reads. */
static void add_child(struct bake_plan *plan, struct visits *visits)
{
    size_t top = visits->num - 1;
    bool is_output = visits->items[top].node.is_output;
    mxg_element child = visits->items[top].next;
    bool is_port = is_output || is_category(plan->document, child, "input");
    if (!is_port || add_input(plan, visits, child))
        visits->items[top].next = is_output ? 0 : bake_element(plan->document, child).next;
}

/* True if an <implementation> names a nodegraph. */
static bool implements(const mxg_document *document, const char *graph)
{
    for (mxg_element child = bake_element(document, 0).first_child; child;) {
        mxg_element_info info = bake_element(document, child);
        const char *named = bake_attribute(document, child, "nodegraph");
        if (strcmp(info.category, "implementation") == 0 && named && strcmp(named, graph) == 0)
            return true;
        child = info.next;
    }
    return false;
}

bool bake_is_definition(const mxg_document *document, mxg_element element)
{
    static const char *const categories[] = {"nodedef",     "implementation", "typedef",
                                             "targetdef",   "unitdef",        "unittypedef",
                                             "geompropdef", "attributedef",   NULL};
    mxg_element_info info = bake_element(document, element);
    return args_is_one_of(info.category, categories)
           || (strcmp(info.category, "nodegraph") == 0
               && (bake_attribute(document, element, "nodedef")
                   || implements(document, info.name)));
}

void bake_plan_begin(struct bake_plan *plan, const mxg_document *document, struct report *report)
{
    *plan = (struct bake_plan){.document = document, .report = report};
    for (mxg_element child = bake_element(document, 0).first_child; child;) {
        mxg_element_info info = bake_element(document, child);
        if (*info.name && (bake_is_definition(document, child) || bake_is_of_look(document, child)))
            take(plan, info.name, false);
        child = info.next;
    }
}

bool bake_plan_add(struct bake_plan *plan, const char *path)
{
    struct visits visits = {0};
    mxg_element root = mxg_document_find_element(plan->document, 0, path);
    if (!stays(plan, root) && !is_category(plan->document, root, "output")) {
        report_error(plan->report, "nothing-to-bake",
                     "'%s' is no material, no surface and no output, so it has no inputs to bake",
                     path);
        return false;
    }
    if (bake_plan_find(plan, root) == plan->num_nodes)
        begin_node(plan, &visits, root);
    while (visits.num) {
        if (visits.items[visits.num - 1].next)
            add_child(plan, &visits);
        else
            end_node(plan, &visits);
    }
    free(visits.items);
    return true;
}

void bake_plan_finish(struct bake_plan *plan)
{
    for (size_t i = 0; i < plan->num_nodes; ++i) {
        for (size_t k = 0; k < plan->nodes[i].num_inputs; ++k)
            free(plan->nodes[i].inputs[k].copy);
        free(plan->nodes[i].name);
        free(plan->nodes[i].inputs);
    }
    for (size_t i = 0; i < plan->num_drawings; ++i) {
        free(plan->drawings[i].name);
        free(plan->drawings[i].path);
        free(plan->drawings[i].file);
        free(plan->drawings[i].tiles.items);
    }
    free(plan->nodes);
    free(plan->drawings);
    names_finish(&plan->names);
}
