// SPDX-License-Identifier: Apache-2.0
/*
 * Shaders of the draft's surfaces tell if an input does something, and where they cannot, because
 * no shader reads the input, its weight does.
 */
#include "api/translate.h"

#include "api/edit.h"

#include <mxgen/reflection.h>

/* ---- Shaders ---- */

static void generate(struct translation *t, const struct target *target, unsigned step,
                     const char *uniforms)
{
    translate_generate_for(t, target, t->draft, translate_step_name(t, step), uniforms,
                           generation_run_all, NULL);
}

static bool reads(struct translation *t, const struct target *target, unsigned step,
                  const char *path, const char *uniforms)
{
    generate(t, target, step, uniforms);
    return !t->value->has_shader || mxg_result_find_variable(t->value, path) != MXG_NONE;
}

static const char *path_of(const struct translation *t, unsigned step, const char *input)
{
    struct text path;
    text_init(&path, t->arena);
    text_fmt(&path, "%s/%s", translate_step_name(t, step), input);
    return text_cstr(&path);
}

bool translate_surface_reads(struct translation *t, unsigned step, const char *input,
                             const char *uniforms)
{
    const char *path = path_of(t, step, input);
    for (size_t i = 0; targets[i]; i++) /* rasters read alike; renderers with closures read more */
        if ((!i || targets[i]->closures) && reads(t, targets[i], step, path, uniforms))
            return true;
    return false;
}

static void change_draft(struct translation *t, unsigned step, const char *input, const char *value)
{
    translate_expect(t, mxg_edit_create(t->context, t->library, t->draft, NULL, &t->draft_edit)
                            == MXG_OK);
    mxg_element node = mxg_edit_find_element(t->draft_edit, 0, translate_step_name(t, step));
    mxg_element port = mxg_edit_find_element(t->draft_edit, node, input);
    translate_expect(t, mxg_edit_set_attribute(t->draft_edit, port, "value", value) == MXG_OK);
    translate_commit_draft(t);
}

/* The shaders of a surface: one of rasters, and one of each renderer with closures. */
static mxg_shader_info *shaders_of(struct translation *t, unsigned step, const char *uniforms,
                                   size_t *out_num)
{
    VEC(mxg_shader_info) infos = {0};
    for (size_t i = 0; targets[i]; i++) {
        mxg_shader_info info = {.size = sizeof info};
        if (i && !targets[i]->closures)
            continue;
        generate(t, targets[i], step, uniforms);
        mxg_result_info(t->value, &info); /* nothing if there is no shader */
        vec_push(t->arena, &infos, info);
    }
    *out_num = infos.len;
    return infos.items;
}

bool translate_surface_differs(struct translation *t, unsigned step, const char *input,
                               const char *own, const char *other, const char *uniforms)
{
    size_t num;
    bool differs = false;
    const mxg_shader_info *before = shaders_of(t, step, uniforms, &num);
    change_draft(t, step, input, other);
    const mxg_shader_info *after = shaders_of(t, step, uniforms, &num);
    change_draft(t, step, input, own);
    for (size_t i = 0; i < num; i++)
        differs = differs || before[i].topology != after[i].topology
                  || before[i].alpha != after[i].alpha
                  || before[i].transparent != after[i].transparent
                  || before[i].displaced != after[i].displaced;
    return differs;
}

/* ---- Inputs that no shader reads ---- */

bool translate_is_for_others(const struct translation *t, uint32_t definition, const char *input)
{
    const struct library *lib = &t->document->layer;
    elem_id graph = edit_find_graph(lib, definition);
    return graph
           && !library_graph_reads(lib, graph, str_find(lib->doc.strings, input, strlen(input)));
}

/* The input that switches another one off where it is 0; NULL: there is none. */
static const struct port *weight_of(const struct library *lib, uint32_t definition, str_id input)
{
    const struct port *ports = library_ports(lib, definition, NULL), *found = NULL;
    uint32_t num = library_nodedef(lib, definition)->num_inputs;
    str_id weight = 0;
    for (uint32_t i = 0; i < num && !weight; i++)
        if (ports[i].name == input)
            weight = doc_attr_value(&lib->doc, ports[i].element, STR_weight);
    for (uint32_t i = 0; i < num && weight && !found; i++)
        if (ports[i].name == weight && weight != input)
            found = &ports[i];
    return found;
}

bool translate_is_off(struct translation *t, uint32_t definition, const char *input,
                      const char *value_of(struct translation *t, const char *input))
{
    const struct library *lib = &t->document->layer;
    const struct port *port =
        weight_of(lib, definition, str_find(lib->doc.strings, input, strlen(input)));
    const unsigned num = library_nodedef(lib, definition)->num_inputs; /* weights may be a cycle */
    for (unsigned i = 0; i < num && port; i++) {
        const char *value = value_of(t, str_text(&lib->strings, port->name));
        enum value_type type = value_type_of(str_text(&lib->strings, doc_type_name(port->type)));
        if (value && type != VALUE_NONE
            && doc_is_same_value(port->type, value, translate_text_of_zero(t, type)))
            return true;
        port = weight_of(lib, definition, port->name);
    }
    return false;
}
