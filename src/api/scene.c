// SPDX-License-Identifier: Apache-2.0
/* Scenes: the paths of primitives; and the names of slots. */
#include "api/scene.h"

#include <assert.h>

/* ---- Names of slots ---- */

/* Parts of a name, and what stands between them, in one form or the other. */
static size_t write_name(const struct slot_name *name, const char *const joints[NUM_SLOT_PARTS],
                         const char *prefix, char *buffer, size_t capacity)
{
    size_t len = 0;
    for (unsigned i = 0; i < NUM_SLOT_PARTS; i++) {
        const struct text_word words[] = {
            {joints[i], strlen(joints[i])}, {prefix, strlen(prefix)}, name->parts[i]};
        for (unsigned k = 0; k < 3 && name->parts[i].len; k++) {
            size_t left = len < capacity ? capacity - len : 0;
            text_copy(words[k].bytes, words[k].len, left ? buffer + len : NULL, left);
            len += words[k].len;
        }
    }
    return len;
}

size_t mxg_slot_encode(const char *name, char *buffer, size_t capacity)
{
    static const char *const joints[] = {"", ":over:", ":_:"};
    struct slot_name parsed;
    if (!name || slot_parse(name, strlen(name), &parsed))
        return 0;
    return write_name(&parsed, joints, "_", buffer, capacity);
}

size_t mxg_slot_decode(const char *identifiers, char *buffer, size_t capacity)
{
    static const char *const joints[] = {"", "|", "::"};
    struct slot_name parsed;
    const char *rest = identifiers ? slot_decode(identifiers, strlen(identifiers), &parsed) : NULL;
    return rest && !*rest ? write_name(&parsed, joints, "", buffer, capacity) : 0;
}

/* ---- Scenes ---- */

static void init_scene(void *arg)
{
    mxg_scene *scene = arg;
    scene_init(&scene->scene, &scene->object.arena);
}

mxg_status mxg_scene_create(mxg_context *context, mxg_scene **out_scene)
{
    if (out_scene)
        *out_scene = NULL;
    if (!context || !out_scene)
        return MXG_ERROR_ARGUMENT;
    mxg_scene *scene = object_new(context, sizeof *scene, NULL);
    if (!scene)
        return MXG_ERROR_MEMORY;
    mxg_status status = object_run(&scene->object, init_scene, scene);
    if (status == MXG_OK)
        *out_scene = scene;
    else
        object_unref(&scene->object);
    return status;
}

struct scene_load {
    mxg_scene *scene;
    const char *path, *purpose;
    struct file_source files;
};

static bool is_usda(const char *path)
{
    static const char *const endings[] = {".usda", ".usd", ".usdc", ".usdz"};
    const char *dot = strrchr(path, '.');
    for (size_t i = 0; dot && i < sizeof endings / sizeof *endings; i++)
        if (strcmp(dot, endings[i]) == 0)
            return true;
    return false;
}

static void read_scene(void *arg)
{
    struct scene_load *load = arg;
    struct diag_list *diags = &load->scene->object.diagnostics.list;
    const char *data;
    size_t size;
    if (!file_source_read(&load->files, load->path, &data, &size, diags))
        return;
    if (is_usda(load->path)) { /* the scene keeps the text */
        scene_read_usda(&load->scene->scene, load->path, data, size, load->purpose,
                        &load->files.scratch, diags);
        return;
    }
    scene_read_list(&load->scene->scene, load->path, data, size, diags);
    /* the scene keeps the names */
    arena_release(&load->scene->object.arena, (void *)(uintptr_t)data, size + 1);
}

mxg_status mxg_scene_load(mxg_context *context, const char *path, const char *purpose,
                          mxg_scene **out_scene)
{
    if (out_scene)
        *out_scene = NULL;
    if (!path)
        return MXG_ERROR_ARGUMENT;
    struct scene_load load = {.path = path, .purpose = purpose ? purpose : ""};
    mxg_status status = mxg_scene_create(context, &load.scene);
    if (status != MXG_OK)
        return status;
    struct object *object = &load.scene->object;
    if (!sandbox_admit_file(context, path)) {
        object_unref(object);
        return MXG_ERROR_MEMORY;
    }
    file_source_init(&load.files, object);
    status = object_run(object, read_scene, &load);
    file_source_finish(&load.files);
    if (status != MXG_OK) {
        object_unref(object);
        return status;
    }
    *out_scene = load.scene;
    return object_status(object);
}

void mxg_scene_destroy(mxg_scene *scene)
{
    object_unref(scene ? &scene->object : NULL);
}

const mxg_diagnostics *mxg_scene_diagnostics(const mxg_scene *scene)
{
    return scene ? &scene->object.diagnostics : NULL;
}

struct addition {
    mxg_scene *scene;
    const char *const *paths;
    size_t num;
};

static void add_paths(void *arg)
{
    struct addition *a = arg;
    struct diag_list *diags = &a->scene->object.diagnostics.list;
    for (size_t i = 0; i < a->num; i++) {
        scene_add_path(&a->scene->scene, a->paths[i], strlen(a->paths[i]), (struct diag_place){0},
                       diags);
    }
}

mxg_status mxg_scene_add(mxg_scene *scene, const char *const *paths, size_t num_paths)
{
    if (!scene || (!paths && num_paths) || scene->is_bound)
        return MXG_ERROR_ARGUMENT;
    uint32_t errors = scene->object.diagnostics.list.num_errors;
    struct addition addition = {scene, paths, num_paths};
    mxg_status status = object_run(&scene->object, add_paths, &addition);
    if (status != MXG_OK)
        return status;
    return scene->object.diagnostics.list.num_errors > errors ? MXG_ERROR_DOCUMENT : MXG_OK;
}

/* Inside, 0 is the root; the numbers of the interface leave it out. */
static uint32_t number_of(prim_id prim)
{
    return prim ? prim - 1 : UINT32_MAX;
}

uint32_t mxg_scene_num_primitives(const mxg_scene *scene)
{
    return scene ? scene->scene.prims.len - 1 : 0;
}

mxg_status mxg_scene_primitive(const mxg_scene *scene, uint32_t index, mxg_primitive *out)
{
    if (index >= mxg_scene_num_primitives(scene))
        return MXG_ERROR_ARGUMENT;
    const struct scene_prim *prim = &scene->scene.prims.items[index + 1];
    mxg_primitive full = {.parent = number_of(prim->parent),
                          .first_child = number_of(prim->first_child),
                          .next_sibling = number_of(prim->next),
                          .name = prim->name,
                          .name_len = prim->name_len,
                          .type = ""};
    for (uint32_t i = scene_source(&scene->scene, index + 1); i && !full.type_len;
         i = scene->scene.sources.items[i - 1].next) {
        const struct text_word type =
            scene->scene.layer.prims.items[scene->scene.sources.items[i - 1].prim].type;
        full.type = type.len ? type.bytes : "";
        full.type_len = type.len;
    }
    return struct_write(out, &full, sizeof full);
}

uint32_t mxg_scene_find(const mxg_scene *scene, const char *path)
{
    return scene && path ? number_of(scene_find(&scene->scene, path, strlen(path))) : UINT32_MAX;
}

size_t mxg_scene_path(const mxg_scene *scene, uint32_t index, char *buffer, size_t capacity)
{
    if (index >= mxg_scene_num_primitives(scene))
        return 0;
    const struct scene_prim *prims = scene->scene.prims.items;
    size_t len = 0;
    for (prim_id prim = index + 1; prim; prim = prims[prim].parent)
        len += prims[prim].name_len + 1;
    size_t end = len;
    for (prim_id prim = index + 1; prim; prim = prims[prim].parent) {
        end -= prims[prim].name_len + 1;
        for (size_t i = 0; i <= prims[prim].name_len && buffer; i++)
            if (end + i + 1 < capacity)
                buffer[end + i] = i ? prims[prim].name[i - 1] : '/';
    }
    if (buffer && capacity)
        buffer[len < capacity ? len : capacity - 1] = '\0';
    return len;
}
