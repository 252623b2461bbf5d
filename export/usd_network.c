// SPDX-License-Identifier: Apache-2.0
/*
 * The graph of a material of the user's document as prims `ND_…` (OpenUSD, usdMtlx): nodes of
 * nodegraphs stand beside the others, and read what their inputs' connections lead to.
 */
#define _POSIX_C_SOURCE 200809L
#include "export/usd.h"

#include "program/files.h"
#include "program/memory.h"
#include "program/relocate.h"
#include "render/bake_plan.h"
#include "render/default_tokens.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* A node that the surface reads. */
struct node {
    mxg_element element;
    uint32_t nodedef;
    char *name;
};

struct network {
    struct usd *usd;
    const struct flat_material *material;
    const char *path;
    const mxg_document *document;
    struct node *nodes; /* the surface first */
    size_t num;
};

static const struct {
    const char *type, *usd;
} types[] = {
    {"float", "float"},         {"integer", "int"},        {"boolean", "bool"},
    {"color3", "color3f"},      {"color4", "color4f"},     {"vector2", "float2"},
    {"vector3", "float3"},      {"vector4", "float4"},     {"matrix33", "matrix3d"},
    {"matrix44", "matrix4d"},   {"string", "string"},      {"filename", "asset"},
    {"surfaceshader", "token"}, {"volumeshader", "token"}, {"displacementshader", "token"},
    {"BSDF", "token"},          {"EDF", "token"},          {"VDF", "token"},
};

/* NULL: USD has no such type. */
static const char *type_of(const char *type)
{
    for (size_t i = 0; i < sizeof types / sizeof *types; ++i)
        if (strcmp(types[i].type, type) == 0)
            return types[i].usd;
    return NULL;
}

/* ---- What the surface reads ---- */

static size_t find(const struct network *network, mxg_element element)
{
    size_t i = 0;
    while (i < network->num && network->nodes[i].element != element)
        ++i;
    return i;
}

/* false: others do not have its definition. */
static bool add(struct network *network, mxg_element element, struct name_table *names)
{
    uint32_t nodedef = mxg_document_find_nodedef(network->document, element);
    if (nodedef == MXG_NONE
        || nodedef >= mxg_library_num_nodedefs(network->usd->writing->cli->library)) {
        flat_tell_loss(network->usd->flat, network->material, "graph",
                       "'%s' has a definition of the document, and none of MaterialX's",
                       bake_element(network->document, element).name);
        return false;
    }
    char *path = bake_path(network->document, element);
    MEMORY_PUSH(network->nodes, network->num,
                (struct node){element, nodedef, usd_name(names, path)});
    free(path);
    return true;
}

static bool collect(struct network *network, mxg_element surface, struct name_table *names)
{
    bool good = add(network, surface, names);
    for (size_t i = 0; good && i < network->num; ++i) {
        mxg_element child = bake_element(network->document, network->nodes[i].element).first_child;
        while (good && child) {
            struct bake_end end = bake_follow(network->document, child);
            if (end.node && find(network, end.node) == network->num)
                good = add(network, end.node, names);
            child = bake_element(network->document, child).next;
        }
    }
    return good;
}

/* ---- Files ---- */

/* Files that a package may have (USDZ File Format Specification). */
static bool has_package_format(const char *path)
{
    static const char *const endings[] = {".png", ".jpg", ".jpeg", ".exr", NULL};
    const char *dot = strrchr(files_base_name(path), '.');
    return dot && args_is_one_of(dot, endings);
}

/* The name of a texture in the package, to which it is added. NULL: there is none. */
static char *pack(struct network *network, const char *path)
{
    struct usd *usd = network->usd;
    char *key = cli_format("file|%s", path);
    const struct usd_file *file = usd_find_file(usd, key);
    const char *fault =
        mxg_context_file_fault(usd->writing->cli->context, usd->writing->source_path, path);
    if (!file && !fault && has_package_format(path)) {
        size_t size = 0;
        char *data = files_read(path, &size);
        file = data ? usd_add_file(usd, key, files_base_name(path), data, size) : NULL;
        fault = data ? NULL : strerror(errno);
    } else if (!file && !fault) {
        fault = "a package has no such files";
    }
    if (!file)
        flat_tell_loss(usd->flat, network->material, "graph", "'%s': %s", path, fault);
    free(key);
    return file ? cli_format("%s", file->name) : NULL;
}

/* The path of a file as the layer names it. */
static char *file_of(struct network *network, mxg_element origin, const char *file)
{
    const struct writing *writing = network->usd->writing;
    char *named = default_tokens_replace(writing->source, file),
         *path = bake_file_path(network->document, writing->source_path, origin, named),
         *folder = write_folder(writing->path);
    free(named);
    char *name = network->usd->is_package ? pack(network, path) : relocate_file(folder, path);
    free(path);
    free(folder);
    return name;
}

/* ---- Inputs ---- */

static const char *output_of(const struct network *network, const struct node *node,
                             const char *output, const char *type)
{
    mxg_nodedef nodedef = {sizeof nodedef};
    mxg_port port = {sizeof port};
    const char *first = "out";
    if (*output)
        return output;
    mxg_document_nodedef(network->document, node->nodedef, &nodedef);
    for (uint32_t i = nodedef.num_outputs; i-- > 0;)
        if (mxg_document_port(network->document, node->nodedef, nodedef.num_inputs + i, &port)
                == MXG_OK
            && (nodedef.num_outputs == 1 || strcmp(port.type, type) == 0))
            first = port.name;
    return first;
}

static void put_matrix(struct usd *usd, const mxg_value *value)
{
    unsigned side = value->num_values == 9 ? 3 : 4;
    fputs("(", usd->out);
    for (unsigned i = 0; i < side; ++i) {
        fputs(i ? ", " : "", usd->out);
        usd_put_numbers(usd, value->values + (size_t)i * side, side);
    }
    fputs(")", usd->out);
}

/* " (colorSpace = "acescg")" where the colour or the file has a space that is not the usual one. */
static void put_space(const struct network *network, mxg_element origin, const char *type)
{
    const char *space = bake_inherited(network->document, origin, "colorspace");
    if (space && strcmp(space, "lin_rec709") != 0
        && (strncmp(type, "color", 5) == 0 || strcmp(type, "filename") == 0)) {
        char *quoted = usd_quote(space);
        fprintf(network->usd->out, " (colorSpace = %s)", quoted);
        free(quoted);
    }
}

static bool put_value(struct network *network, const char *declaration, mxg_element origin)
{
    struct usd *usd = network->usd;
    mxg_value value = {sizeof value};
    char *text = NULL;
    if (mxg_document_value(network->document, origin, &value) != MXG_OK)
        return true;
    if (strcmp(value.type, "filename") == 0) {
        char *file = *value.text ? file_of(network, origin, value.text) : cli_format("%s", "");
        if (!file)
            return false;
        text = usd_asset(file);
        free(file);
    } else if (strcmp(value.type, "string") == 0) {
        text = usd_quote(value.text);
    } else if (!value.num_values) {
        return true;
    }
    fprintf(usd->out, "%*s%s = ", (int)usd->depth * 4, "", declaration);
    if (text)
        fputs(text, usd->out);
    else if (value.num_values > 4)
        put_matrix(usd, &value);
    else if (value.num_values == 1 && strcmp(value.type, "float") != 0)
        fprintf(usd->out, "%d", value.integer);
    else
        usd_put_numbers(usd, value.values, value.num_values);
    put_space(network, origin, value.type);
    fputc('\n', usd->out);
    free(text);
    return true;
}

static bool put_input(struct network *network, mxg_element port)
{
    mxg_element_info info = bake_element(network->document, port);
    const char *type = type_of(info.type);
    struct bake_end end = bake_follow(network->document, port);
    if (strcmp(info.category, "input") != 0 || (!end.node && !end.value))
        return true;
    if (!type) {
        flat_tell_loss(network->usd->flat, network->material, "graph",
                       "USD has no type for '%s', a %s", info.name, info.type);
        return false;
    }
    char *declaration = cli_format("%s inputs:%s", type, info.name);
    bool good = true;
    if (end.node) {
        const struct node *from = &network->nodes[find(network, end.node)];
        usd_put(network->usd, "%s.connect = <%s/%s.outputs:%s>", declaration, network->path,
                from->name, output_of(network, from, end.output, info.type));
    } else {
        good = put_value(network, declaration, end.value);
    }
    free(declaration);
    return good;
}

/* ---- Nodes ---- */

static bool put_node(struct network *network, const struct node *node)
{
    mxg_nodedef nodedef = {sizeof nodedef};
    mxg_port port = {sizeof port};
    mxg_document_nodedef(network->document, node->nodedef, &nodedef);
    usd_open(network->usd, "Shader", node->name);
    usd_put(network->usd, "uniform token info:id = \"%s\"", nodedef.name);
    bool good = true;
    mxg_element child = bake_element(network->document, node->element).first_child;
    while (good && child) {
        good = put_input(network, child);
        child = bake_element(network->document, child).next;
    }
    for (uint32_t i = 0; i < nodedef.num_outputs; ++i) {
        mxg_document_port(network->document, node->nodedef, nodedef.num_inputs + i, &port);
        const char *type = type_of(port.type);
        usd_put(network->usd, "%s outputs:%s", type ? type : "token", port.name);
    }
    usd_close(network->usd);
    return good;
}

/* True if a name is `clean` with '_' in place of characters that are neither letters nor digits. */
static bool is_same_name(const char *name, const char *clean)
{
    for (; *name && *clean; ++name, ++clean)
        if (*name != *clean && (isalnum((unsigned char)*name) || *clean != '_'))
            return false;
    return !*name && !*clean;
}

/* The surface of a material of the document, or the surface itself. 0: there is none. */
static mxg_element find_surface(const mxg_document *document, const char *name)
{
    mxg_element node = bake_element(document, 0).first_child;
    while (node && !is_same_name(bake_element(document, node).name, name))
        node = bake_element(document, node).next;
    mxg_element port = node ? mxg_document_find_element(document, node, "surfaceshader") : 0;
    return port ? bake_follow(document, port).node : node;
}

static bool put_nodes(struct network *network, struct name_table *names)
{
    struct usd *usd = network->usd;
    mxg_element surface = find_surface(network->document, network->material->name);
    if (!surface)
        flat_tell_loss(usd->flat, network->material, "graph",
                       "nothing of this name is in the document");
    bool good = surface && collect(network, surface, names);
    for (size_t i = 0; good && i < network->num; ++i)
        good = put_node(network, &network->nodes[i]);
    if (good)
        usd_put(usd, "token outputs:mtlx:surface.connect = <%s/%s.outputs:%s>", network->path,
                network->nodes[0].name,
                output_of(network, &network->nodes[0], "", "surfaceshader"));
    return good;
}

void usd_put_network(struct usd *usd, const struct flat_material *material, const char *path,
                     struct name_table *names)
{
    struct network network = {
        .usd = usd, .material = material, .path = path, .document = usd->writing->source};
    FILE *out = usd->out;
    char *text = NULL;
    size_t size = 0;
    usd->out = open_memstream(&text, &size);
    if (!usd->out)
        memory_fail();
    unsigned depth = usd->depth;
    bool is_whole = put_nodes(&network, names);
    if (fclose(usd->out) != 0)
        memory_fail();
    usd->out = out;
    usd->depth = depth;
    if (is_whole)
        fwrite(text, 1, size, out);
    for (size_t i = 0; i < network.num; ++i)
        free(network.nodes[i].name);
    free(network.nodes);
    free(text);
}
