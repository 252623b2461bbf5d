// SPDX-License-Identifier: Apache-2.0
#include "render/stage_picture.h"

#include "cli/memory.h"

#include <stdlib.h>
#include <string.h>

/* White Lambert: what a primitive without layers has (docs/slots.md). */
static const char standard_material[] =
    "<materialx version=\"1.39\">"
    "<oren_nayar_diffuse_bsdf name=\"white\" type=\"BSDF\">"
    "<input name=\"color\" type=\"color3\" value=\"0.8, 0.8, 0.8\"/>"
    "</oren_nayar_diffuse_bsdf>"
    "<surface name=\"standard\" type=\"surfaceshader\">"
    "<input name=\"bsdf\" type=\"BSDF\" nodename=\"white\"/></surface>"
    "<surfacematerial name=\"default\" type=\"material\">"
    "<input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"standard\"/>"
    "</surfacematerial></materialx>";

static bool load_standard(struct painter *painter, struct stage_subjects *out)
{
    return out->standard
           || report_status(&painter->cli->report,
                            mxg_document_parse(painter->cli->context, painter->cli->library,
                                               "default", standard_material,
                                               sizeof standard_material - 1, &out->standard));
}

/* The material of the highest layer; NULL: there is none. */
static const char *top_material(const mxg_bindings *bindings, uint32_t primitive)
{
    const char *material = NULL;
    for (uint32_t i = 0; i < mxg_bindings_num_layers(bindings, primitive); ++i) {
        mxg_layer layer = {sizeof layer};
        mxg_bindings_layer(bindings, primitive, i, &layer);
        if (layer.kind == MXG_LAYER)
            material = layer.material;
    }
    return material;
}

/* An object and what it has. */
struct dressed {
    const char *material; /* NULL: the standard one */
    uint32_t object;
};

/* Without a material first; then by name, and by the order of the stage. */
static int compare_dressed(const void *a, const void *b)
{
    const struct dressed *x = a, *y = b;
    int order = !x->material || !y->material ? (x->material != NULL) - (y->material != NULL)
                                             : strcmp(x->material, y->material);
    return order ? order : (x->object > y->object) - (x->object < y->object);
}

static bool is_like(const struct dressed *a, const struct dressed *b)
{
    return a->material && b->material ? strcmp(a->material, b->material) == 0
                                      : a->material == b->material;
}

static bool group(struct painter *painter, const struct stage *stage, const mxg_document *document,
                  const char *path, const struct dressed *dressed, struct stage_subjects *out)
{
    for (uint32_t i = 0; i < stage->num_objects; ++i) {
        out->objects[i] = stage->objects[dressed[i].object].object;
        if (i && is_like(&dressed[i], &dressed[i - 1])) {
            ++out->items[out->len - 1].num_objects;
            continue;
        }
        const char *material = dressed[i].material;
        if (!material && !load_standard(painter, out))
            return false;
        out->items[out->len++] =
            (struct subject){.document = material ? document : out->standard,
                             .path = material ? path : "default",
                             .element = material ? material : "default",
                             .objects = &out->objects[i],
                             .num_objects = 1};
    }
    return true;
}

bool stage_subjects_make(struct painter *painter, const struct stage *stage,
                         const mxg_document *document, const char *path, const char *look,
                         struct stage_subjects *out)
{
    struct report *report = &painter->cli->report;
    mxg_bind_desc desc = MXG_BIND_DESC_INIT;
    *out = (struct stage_subjects){0};
    desc.look = look;
    mxg_status status =
        mxg_bind(painter->cli->context, document, stage->scene, &desc, &out->bindings);
    if (out->bindings)
        report_list(report, mxg_bindings_diagnostics(out->bindings));
    if (!report_status(report, status))
        return false;
    struct dressed *dressed = memory_alloc(stage->num_objects * sizeof *dressed);
    out->items = memory_alloc(stage->num_objects * sizeof *out->items);
    out->objects = memory_alloc(stage->num_objects * sizeof *out->objects);
    for (uint32_t i = 0; i < stage->num_objects; ++i)
        dressed[i] = (struct dressed){top_material(out->bindings, stage->objects[i].primitive), i};
    qsort(dressed, stage->num_objects, sizeof *dressed, compare_dressed);
    bool good = group(painter, stage, document, path, dressed, out);
    free(dressed);
    return good;
}

void stage_subjects_finish(struct stage_subjects *subjects)
{
    free(subjects->items);
    free(subjects->objects);
    mxg_bindings_destroy(subjects->bindings);
    mxg_document_destroy(subjects->standard);
}
