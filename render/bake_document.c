// SPDX-License-Identifier: Apache-2.0
/* The new document: nodes that stay, values, and images. */
#include "render/bake.h"

#include "program/files.h"
#include "program/memory.h"
#include "program/relocate.h"

#include <stdlib.h>
#include <string.h>

struct writer {
    struct baking *baking;
    mxg_edit *edit;
    mxg_element *nodes;    /* of the plan, in the edit */
    mxg_element *drawings; /* what gives their values; 0: a value, or not yet there */
};

/* ---- Files ---- */

/* The name of a file that an element of the document has, for the new one. The caller frees it. */
static char *name_file(const struct baking *baking, mxg_element origin, const char *file)
{
    char *path = *file ? bake_file_path(baking->document, baking->path, origin, file) : NULL;
    char *name = path ? relocate_file(baking->options.output, path) : cli_format("%s", "");
    free(path);
    return name;
}

/* ---- Inputs ---- */

static void set_attribute(struct writer *writer, mxg_element node, const char *input,
                          const char *name, const char *value)
{
    mxg_element port = mxg_edit_find_element(writer->edit, node, input);
    if (value)
        mxg_edit_set_attribute(writer->edit, port, name, value);
}

/* Says the colour space of an input where the document does not say it for all. */
static void set_space(struct writer *writer, mxg_element node, const char *input, const char *space)
{
    const char *usual = bake_inherited(writer->baking->document, 0, "colorspace");
    if (space && (!usual || strcmp(space, usual) != 0))
        set_attribute(writer, node, input, "colorspace", space);
}

/* An input that stays: its value is that of its origin. */
static void keep(struct writer *writer, mxg_element node, const struct bake_input *kept)
{
    const mxg_document *document = writer->baking->document;
    const char *input = kept->name, *type = kept->type;
    mxg_element origin = kept->origin;
    const char *value = bake_attribute(document, origin, "value");
    bool is_file = strcmp(type, "filename") == 0, is_color = strncmp(type, "color", 5) == 0;
    char *file = kept->copy ? cli_format("%s", kept->copy)
                 : is_file  ? name_file(writer->baking, origin, value)
                            : NULL;
    mxg_edit_set_value(writer->edit, node, input, type, file ? file : value);
    if (is_file || is_color)
        set_space(writer, node, input, bake_inherited(document, origin, "colorspace"));
    set_attribute(writer, node, input, "unit", bake_attribute(document, origin, "unit"));
    set_attribute(writer, node, input, "unittype", bake_attribute(document, origin, "unittype"));
    free(file);
}

/* The image of a drawing, made once; behind it a map of normals for a direction. */
static mxg_element draw(struct writer *writer, size_t index)
{
    const struct bake_drawing *drawing = &writer->baking->plan.drawings[index];
    mxg_edit *edit = writer->edit;
    if (writer->drawings[index])
        return writer->drawings[index];
    mxg_element image = mxg_edit_add_element(edit, 0, "image", drawing->name, drawing->type);
    mxg_edit_set_value(edit, image, "file", "filename", drawing->file);
    if (drawing->spaces)
        set_space(writer, image, "file", drawing->spaces);
    writer->drawings[index] = image;
    if (!drawing->is_direction)
        return image;
    char *wanted = cli_format("%s_map", drawing->name),
         *name = bake_plan_name(&writer->baking->plan, wanted);
    free(wanted);
    mxg_element map = mxg_edit_add_element(edit, 0, "normalmap", name, "vector3");
    mxg_edit_connect_input(edit, map, "in", image, NULL);
    free(name);
    return writer->drawings[index] = map;
}

static bool is_drawn(const struct writer *writer, const struct bake_input *input)
{
    return input->way == BAKE_DRAWS && !writer->baking->plan.drawings[input->index].is_value;
}

static void add_input(struct writer *writer, mxg_element node, const struct bake_input *input)
{
    struct baking *baking = writer->baking;
    const struct bake_drawing *drawing =
        input->way == BAKE_DRAWS ? &baking->plan.drawings[input->index] : NULL;
    if (input->way == BAKE_KEEPS) {
        keep(writer, node, input);
    } else if (drawing && drawing->is_value) {
        mxg_edit_set_numbers(writer->edit, node, input->name, input->type, drawing->value,
                             bake_channels(drawing->type));
        if (strncmp(input->type, "color", 5) == 0
            && bake_inherited(baking->document, 0, "colorspace"))
            set_space(writer, node, input->name, baking->space);
    } else {
        mxg_element from =
            input->way == BAKE_NODE ? writer->nodes[input->index] : draw(writer, input->index);
        mxg_edit_connect_input(writer->edit, node, input->name, from, NULL);
    }
}

/* ---- Nodes ---- */

/* An output reads a node: a value is one of a <constant>. */
static void add_output(struct writer *writer, size_t index)
{
    struct bake_plan *plan = &writer->baking->plan;
    const struct bake_node *node = &plan->nodes[index];
    mxg_element from = 0;
    if (node->num_inputs && is_drawn(writer, node->inputs)) {
        from = draw(writer, node->inputs->index);
    } else if (node->num_inputs && node->inputs->way == BAKE_NODE) {
        from = writer->nodes[node->inputs->index];
    } else if (node->num_inputs) {
        struct bake_input value = *node->inputs;
        char *wanted = cli_format("%s_value", node->name), *name = bake_plan_name(plan, wanted);
        value.name = "value";
        from = mxg_edit_add_element(writer->edit, 0, "constant", name, node->type);
        add_input(writer, from, &value);
        free(wanted);
        free(name);
    }
    writer->nodes[index] =
        mxg_edit_add_element(writer->edit, 0, node->category, node->name, node->type);
    if (from)
        mxg_edit_connect_input(writer->edit, writer->nodes[index], NULL, from, NULL);
}

/* The definition of a node may read its tokens; those of nodegraphs around it are values now. */
static void add_tokens(struct writer *writer, mxg_element to, mxg_element from)
{
    const mxg_document *document = writer->baking->document;
    for (mxg_element child = bake_element(document, from).first_child; child;) {
        mxg_element_info info = bake_element(document, child);
        const char *value =
            bake_is_token(document, child) ? bake_token_value(document, child) : NULL;
        mxg_element token =
            value ? mxg_edit_add_element(writer->edit, to, "token", info.name, info.type) : 0;
        if (token)
            mxg_edit_set_attribute(writer->edit, token, "value", value);
        child = info.next;
    }
}

static void add_node(struct writer *writer, size_t index)
{
    static const char *const others[] = {"name",       "type",      "colorspace",
                                         "fileprefix", "nodegraph", "nodename",
                                         "output",     "namespace", NULL};
    const mxg_document *document = writer->baking->document;
    const struct bake_node *node = &writer->baking->plan.nodes[index];
    mxg_element_info info = bake_element(document, node->element);
    for (size_t i = 0; i < node->num_inputs; ++i) /* images stand before their readers */
        if (is_drawn(writer, &node->inputs[i]))
            draw(writer, node->inputs[i].index);
    mxg_element made =
        mxg_edit_add_element(writer->edit, 0, node->category, node->name, node->type);
    writer->nodes[index] = made;
    for (uint32_t i = 0; i < info.num_attributes; ++i) {
        mxg_attribute attribute = {sizeof attribute};
        mxg_document_attribute(document, node->element, i, &attribute);
        if (!args_is_one_of(attribute.name, others))
            mxg_edit_set_attribute(writer->edit, made, attribute.name, attribute.value);
    }
    for (size_t i = 0; i < node->num_inputs; ++i)
        add_input(writer, made, &node->inputs[i]);
    add_tokens(writer, made, node->element);
}

/* ---- Elements that stay as they are ---- */

/* Files that an element names are relative to the new document, and have their prefix. */
static void rename_files(const struct baking *baking, mxg_edit *edit, mxg_element from)
{
    const mxg_document *document = baking->document;
    const char *type = bake_element(document, from).type,
               *file = bake_attribute(document, from, "file"),
               *value =
                   strcmp(type, "filename") == 0 ? bake_attribute(document, from, "value") : NULL;
    char *path = bake_path(document, from);
    mxg_element copy = mxg_edit_find_element(edit, 0, path);
    if (copy && (file || value)) {
        char *name = name_file(baking, from, file ? file : value);
        mxg_edit_set_attribute(edit, copy, file ? "file" : "value", name);
        free(name);
    }
    if (copy)
        mxg_edit_set_attribute(edit, copy, "fileprefix", NULL);
    free(path);
}

void bake_copy(const struct baking *baking, mxg_edit *edit, mxg_element top)
{
    mxg_edit_copy_element(edit, 0, baking->document, top, NULL);
    for (mxg_element e = top; e; e = cli_next_element(baking->document, top, e))
        rename_files(baking, edit, e);
}

/* ---- Definitions ---- */

/* True if a node that stays has a definition of the document. */
static bool needs_definitions(const struct baking *baking)
{
    uint32_t of_library = mxg_library_num_nodedefs(baking->cli.library);
    for (size_t i = 0; i < baking->plan.num_nodes; ++i) {
        uint32_t index = mxg_document_find_nodedef(baking->document, baking->plan.nodes[i].element);
        if (index != MXG_NONE && index >= of_library)
            return true;
    }
    return false;
}

/* Types, units and properties stay in any case: values that stay may have them. */
static void copy_definitions(struct writer *writer)
{
    static const char *const of_nodes[] = {"nodedef", "implementation", "nodegraph", NULL};
    const mxg_document *document = writer->baking->document;
    const bool has_nodes = needs_definitions(writer->baking);
    for (mxg_element child = bake_element(document, 0).first_child; child;) {
        mxg_element_info info = bake_element(document, child);
        if (bake_is_definition(document, child)
            && (has_nodes || !args_is_one_of(info.category, of_nodes)))
            bake_copy(writer->baking, writer->edit, child);
        child = info.next;
    }
}

static char *text_of(struct baking *baking, mxg_edit *edit, size_t *out_size)
{
    struct report *report = &baking->cli.report;
    char reason[256] = "";
    mxg_document *document = NULL;
    mxg_edit_error(edit, reason, sizeof reason);
    mxg_status status = *reason ? MXG_OK : mxg_edit_commit(edit, &document);
    if (*reason)
        report_error(report, "render-failed", "cannot bake '%s': %s", baking->path, reason);
    if (document)
        report_list(report, mxg_document_diagnostics(document));
    const char *text = document ? mxg_document_xml(document, out_size) : NULL;
    char *copy = text && status == MXG_OK ? cli_copy(text, *out_size) : NULL;
    if (!copy && !*reason)
        report_status(report, status == MXG_OK ? MXG_ERROR_MEMORY : status);
    mxg_document_destroy(document);
    return copy;
}

char *bake_write_document(struct baking *baking, size_t *out_size)
{
    const struct bake_plan *plan = &baking->plan;
    struct writer writer = {.baking = baking,
                            .nodes = memory_alloc((plan->num_nodes + 1) * sizeof *writer.nodes),
                            .drawings =
                                memory_alloc((plan->num_drawings + 1) * sizeof *writer.drawings)};
    mxg_status status =
        mxg_edit_create(baking->cli.context, baking->cli.library, NULL, baking->path, &writer.edit);
    const char *space = bake_inherited(baking->document, 0, "colorspace");
    char *text = NULL;
    if (report_status(&baking->cli.report, status)) {
        if (space)
            mxg_edit_set_attribute(writer.edit, mxg_edit_find_element(writer.edit, 0, ""),
                                   "colorspace", space);
        copy_definitions(&writer);
        for (size_t i = 0; i < plan->num_nodes; ++i)
            (plan->nodes[i].is_output ? add_output : add_node)(&writer, i);
        bake_add_looks(baking, writer.edit);
        text = text_of(baking, writer.edit, out_size);
    }
    mxg_edit_destroy(writer.edit);
    free(writer.nodes);
    free(writer.drawings);
    return text;
}
