// SPDX-License-Identifier: Apache-2.0
#include "export/dressed_site.h"

#include "program/memory.h"
#include "program/scene_file.h"
#include "render/look_parts.h"
#include "render/site_picture.h"

#include <stdlib.h>
#include <string.h>

bool dressed_site_open(struct dressed_site *stage, struct cli *cli, const char *path)
{
    *stage = (struct dressed_site){0};
    return site_open(&stage->site, cli, path, NULL);
}

void dressed_site_close(struct dressed_site *stage)
{
    for (size_t i = 0; stage->dresses && i < stage->num_looks * stage->site.num_objects; ++i)
        free(stage->dresses[i].material);
    free(stage->dresses);
    free(stage->looks);
    names_finish(&stage->worn);
    names_finish(&stage->told);
    site_close(&stage->site);
}

const struct site_dress *dressed_site_dress(const struct dressed_site *stage, size_t look,
                                            uint32_t object)
{
    return &stage->dresses[look * stage->site.num_objects + object];
}

bool dressed_site_shows(const struct dressed_site *stage, uint32_t object)
{
    for (size_t i = 0; i < stage->num_looks; ++i)
        if (!dressed_site_dress(stage, i, object)->is_hidden)
            return true;
    return false;
}

/* ---- Layers ---- */

/* The base of a primitive, and the layers that the file lacks. */
struct layers {
    mxg_layer base, lost; /* the first that is lost; size 0: there is none */
    uint32_t num_lost;
};

static struct layers read_layers(const mxg_bindings *bindings, uint32_t primitive)
{
    struct layers layers = {0};
    uint32_t num = mxg_bindings_num_layers(bindings, primitive);
    for (uint32_t i = 0; i < num; ++i) {
        mxg_layer layer = {sizeof layer};
        mxg_bindings_layer(bindings, primitive, i, &layer);
        if (layer.kind == MXG_LAYER && !layer.is_nodegraph && !layers.base.size)
            layers.base = layer;
        else if (!layers.num_lost++)
            layers.lost = layer;
    }
    return layers;
}

/* Tells lost layers once, with the first primitive that has them. */
static void tell_lost(struct dressed_site *stage, uint32_t primitive, const struct layers *layers)
{
    const mxg_layer *lost = &layers->lost;
    char *path = scene_file_path(stage->site.scene, primitive),
         *key = cli_format("%s:%u:%s:%s:%u", lost->file, (unsigned)lost->line, lost->slot,
                           lost->material, (unsigned)layers->num_lost);
    bool is_new;
    names_add(&stage->told, key, &is_new);
    free(key);
    char *others = layers->num_lost == 1
                       ? cli_format("this layer is")
                       : cli_format("%u layers and overrides are", (unsigned)layers->num_lost);
    if (is_new)
        report_warning(
            stage->site.report, "export-loss",
            "'%s/%s' (%s:%u) is not in the file: a primitive of this format has one material, that "
            "of its base, and %s left out",
            path, *lost->slot ? lost->slot : lost->material, lost->file, (unsigned)lost->line,
            others);
    free(others);
    free(path);
}

/* ---- Looks ---- */

static void add_look(struct dressed_site *stage, const char *name)
{
    MEMORY_PUSH(stage->looks, stage->num_looks, name);
}

/* Layers are told where they are lost: tell_lost. */
static void tell_variant(void *user_data, const char *look, const mxg_element_info *part)
{
    const struct dressed_site *stage = user_data;
    if (strcmp(part->category, "variantassign") == 0)
        report_warning(stage->site.report, "export-loss",
                       "'%s/%s' (%s:%u) is not in the file: its materials have their own values, "
                       "without those of variants",
                       look, part->name, part->file, (unsigned)part->line);
}

static void list_looks(struct dressed_site *stage, const mxg_document *document, const char *look,
                       bool has_variants)
{
    mxg_element_info info = {sizeof info};
    mxg_document_element(document, mxg_document_find_element(document, 0, ""), &info);
    for (mxg_element child = look ? 0 : info.first_child; child; child = info.next) {
        mxg_document_element(document, child, &info);
        if (strcmp(info.category, "look") != 0)
            continue;
        if (has_variants || !stage->num_looks)
            add_look(stage, info.name);
        else
            report_warning(stage->site.report, "export-loss",
                           "'%s/%s' (%s:%u) is not in the file as it is: the format has one look",
                           stage->site.file, info.name, info.file, (unsigned)info.line);
    }
    if (!stage->num_looks)
        add_look(stage, look);
    for (size_t i = 0; i < stage->num_looks; ++i)
        look_parts(document, stage->looks[i], tell_variant, stage);
}

static void dress(struct dressed_site *stage, const mxg_bindings *bindings,
                  struct site_dress *dresses)
{
    for (uint32_t i = 0; i < stage->site.num_objects; ++i) {
        uint32_t primitive = site_bound_primitive(&stage->site, &stage->site.objects[i]);
        const struct layers layers = read_layers(bindings, primitive);
        bool is_new;
        dresses[i].is_hidden = !site_is_visible(bindings, primitive);
        if (dresses[i].is_hidden)
            continue;
        if (layers.base.size) {
            dresses[i].material = cli_format("%s", layers.base.material);
            names_add(&stage->worn, layers.base.material, &is_new);
        }
        if (layers.num_lost)
            tell_lost(stage, primitive, &layers);
    }
}

/* False after reporting an error: the looks hide all that the stage has. */
static bool shows_any(struct dressed_site *stage)
{
    for (uint32_t i = 0; i < stage->site.num_objects; ++i)
        if (dressed_site_shows(stage, i))
            return true;
    report_error(stage->site.report, "empty-mesh", "the look hides all primitives of the stage");
    return false;
}

bool dressed_site_bind(struct dressed_site *stage, struct cli *cli, const mxg_document *document,
                       const char *look, bool has_variants)
{
    bool good = true;
    list_looks(stage, document, look, has_variants);
    stage->dresses =
        memory_alloc((stage->num_looks * stage->site.num_objects + 1) * sizeof *stage->dresses);
    for (size_t i = 0; good && i < stage->num_looks; ++i) {
        mxg_bindings *bindings = NULL;
        mxg_bindings_desc desc = MXG_BINDINGS_DESC_INIT;
        desc.look = stage->looks[i];
        mxg_status status =
            mxg_bindings_create(cli->context, document, stage->site.scene, &desc, &bindings);
        if (bindings)
            report_list(&cli->report, mxg_bindings_diagnostics(bindings));
        good = report_status(&cli->report, status) && status == MXG_OK;
        if (good)
            dress(stage, bindings, stage->dresses + i * stage->site.num_objects);
        mxg_bindings_destroy(bindings);
    }
    return good && shows_any(stage);
}
