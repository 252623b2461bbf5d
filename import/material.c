// SPDX-License-Identifier: Apache-2.0
/* A material: a surface whose inputs are the members of glTF, and a nodegraph of its textures. */
#include "import/import.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define UNLIT "KHR_materials_unlit"

/* ---- Members ---- */

static const json_t *extension_of(const struct import_material *material, const char *name)
{
    return json_object_get(json_object_get(material->json, "extensions"), name);
}

/* The object with the members of a row; NULL: the material has none. */
static const json_t *object_of(const struct import_material *material, const struct gltf_input *row)
{
    return !row->object                           ? material->json
           : strncmp(row->object, "KHR_", 4) == 0 ? extension_of(material, row->object)
                                                  : json_object_get(material->json, row->object);
}

/* The numbers of a row: its part of the factor, or what glTF has without it. */
static void read_factor(const json_t *object, const struct gltf_input *row, float out[4])
{
    const json_t *factor = row->factor ? json_object_get(object, row->factor) : NULL;
    for (unsigned i = 0; i < row->count; ++i) {
        const json_t *item = row->has_array ? json_array_get(factor, row->at + i) : factor;
        out[i] = json_is_number(item) ? (float)json_number_value(item) : row->omitted;
    }
}

static void read_color(const struct import_material *material, float out[4])
{
    const json_t *factor =
        json_object_get(json_object_get(material->json, "pbrMetallicRoughness"), "baseColorFactor");
    for (size_t i = 0; i < 4; ++i) {
        const json_t *item = json_array_get(factor, i);
        out[i] = json_is_number(item) ? (float)json_number_value(item) : 1;
    }
}

/* ---- Inputs ---- */

static mxg_element open_graph(struct import_material *material)
{
    struct importing *importing = material->importing;
    if (!material->graph) {
        char *wanted = cli_format("NG_%s", material->name),
             *name = import_name(importing, 0, wanted);
        material->graph = mxg_edit_add_element(importing->edit, 0, "nodegraph", name, NULL);
        free(wanted);
        free(name);
    }
    return material->graph;
}

/* Connects an input through an output of the graph. */
static void connect(struct import_material *material, mxg_element shader, const char *input,
                    const char *type, struct import_port port)
{
    mxg_edit *edit = material->importing->edit;
    char *name = cli_format("%s_out", input);
    mxg_element output = mxg_edit_add_element(edit, material->graph, "output", name, type);
    mxg_edit_connect_input(edit, output, NULL, port.node, port.output);
    mxg_edit_connect_input(edit, shader, input, material->graph, name);
    free(name);
}

static const char *type_of(const struct gltf_input *row)
{
    return row->count == 1                                  ? "float"
           : gltf_images[row->image].is_srgb || row->factor ? "color3"
                                                            : "vector3";
}

/* Reads the image of a row; a node of 0: it has none. */
static struct import_port read_texture(struct import_material *material,
                                       const struct gltf_input *row, const float *factor)
{
    const json_t *object = object_of(material, row),
                 *info = row->texture ? json_object_get(object, row->texture) : NULL;
    float color[4];
    if (!info)
        return (struct import_port){0, NULL};
    read_color(material, color);
    open_graph(material);
    return import_texture(material, row, info, factor, color);
}

/* Gives an input of the surface the image of a row, or else the numbers. */
static void add_value(struct import_material *material, mxg_element shader,
                      const struct gltf_input *row, const char *input, const float *factor)
{
    struct import_port port = read_texture(material, row, factor);
    if (port.node)
        connect(material, shader, input, type_of(row), port);
    else if (row->factor)
        mxg_edit_set_numbers(material->importing->edit, shader, input, type_of(row), factor,
                             row->count);
}

static void add_input(struct import_material *material, mxg_element shader,
                      const struct gltf_input *row)
{
    float factor[4];
    const json_t *object = object_of(material, row);
    if (!object)
        return;
    read_factor(object, row, factor);
    bool differs = row->texture && json_object_get(object, row->texture);
    for (unsigned i = 0; i < row->count; ++i)
        differs = differs || factor[i] != row->value;
    if (differs)
        add_value(material, shader, row, row->name, factor);
}

/* ---- Surfaces ---- */

/* 0 opaque, 1 mask, 2 blend */
static int alpha_mode_of(const struct import_material *material)
{
    const char *mode = json_text_of(material->json, "alphaMode");
    return strcmp(mode, "MASK") == 0 ? 1 : strcmp(mode, "BLEND") == 0 ? 2 : 0;
}

static void add_lit(struct import_material *material, mxg_element shader)
{
    mxg_edit *edit = material->importing->edit;
    int mode = alpha_mode_of(material);
    for (size_t i = 0; i < gltf_num_inputs; ++i) {
        const char *name = gltf_inputs[i].name;
        bool is_idle = strcmp(name, "alpha") == 0          ? mode == 0
                       : strcmp(name, "alpha_cutoff") == 0 ? mode != 1
                                                           : false;
        if (!is_idle)
            add_input(material, shader, &gltf_inputs[i]);
    }
    if (mode)
        mxg_edit_set_value(edit, shader, "alpha_mode", "integer", mode == 1 ? "1" : "2");
}

/* A mask as a number: 1 where alpha reaches the cutoff. */
static void add_mask(struct import_material *material, mxg_element shader, float alpha)
{
    mxg_edit *edit = material->importing->edit;
    const float one = 1;
    float cutoff[4];
    read_factor(material->json, gltf_find_input("alpha_cutoff"), cutoff);
    struct import_port port = read_texture(material, gltf_find_input("alpha"), &alpha);
    open_graph(material);
    mxg_element mask = import_node(material, "ifgreatereq", "opaque", "float");
    if (port.node)
        mxg_edit_connect_input(edit, mask, "value1", port.node, port.output);
    else
        mxg_edit_set_numbers(edit, mask, "value1", "float", &alpha, 1);
    mxg_edit_set_numbers(edit, mask, "value2", "float", cutoff, 1);
    mxg_edit_set_numbers(edit, mask, "in1", "float", &one, 1);
    connect(material, shader, "opacity", "float", (struct import_port){mask, NULL});
}

/* KHR_materials_unlit: the base colour as it is. */
static void add_unlit(struct import_material *material, mxg_element shader)
{
    float color[4];
    int mode = alpha_mode_of(material);
    read_color(material, color);
    add_value(material, shader, gltf_find_input("base_color"), "emission_color", color);
    if (mode == 1)
        add_mask(material, shader, color[3]);
    else if (mode == 2)
        add_value(material, shader, gltf_find_input("alpha"), "opacity", &color[3]);
}

/* ---- Losses ---- */

static bool is_known(const char *extension)
{
    bool found = strcmp(extension, UNLIT) == 0;
    for (size_t i = 0; i < gltf_num_inputs && !found; ++i)
        found = gltf_inputs[i].object && strcmp(gltf_inputs[i].object, extension) == 0;
    return found;
}

static void tell_extensions(struct import_material *material)
{
    const char *name;
    const json_t *value;
    json_object_foreach((json_t *)(uintptr_t)json_object_get(material->json, "extensions"), name,
                        value)
    {
        if (!is_known(name))
            import_tell_loss(material->importing, material->name,
                             "gltf_pbr has nothing like the extension '%s'", name);
    }
}

char *import_add_material(struct importing *importing, size_t index)
{
    mxg_edit *edit = importing->edit;
    const json_t *json = gltf_source_item(&importing->source, "materials", index);
    const char *own = json_text_of(json, "name");
    char *wanted = *own ? cli_format("%s", own) : cli_format("material_%zu", index),
         *name = import_name(importing, 0, wanted), *shader_wanted = cli_format("SR_%s", name),
         *shader_name = import_name(importing, 0, shader_wanted);
    struct import_material material = {.importing = importing, .json = json, .name = name};
    bool is_unlit = extension_of(&material, UNLIT) != NULL;
    mxg_element shader = mxg_edit_add_element(edit, 0, is_unlit ? "surface_unlit" : "gltf_pbr",
                                              shader_name, "surfaceshader");
    (is_unlit ? add_unlit : add_lit)(&material, shader);
    import_check_members(importing, name, json);
    tell_extensions(&material);
    mxg_element element = mxg_edit_add_element(edit, 0, "surfacematerial", name, "material");
    mxg_edit_connect_input(edit, element, "surfaceshader", shader, NULL);
    free(wanted);
    free(shader_wanted);
    free(shader_name);
    return name;
}
