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
    uint32_t limit = scene->object.context->xml_limits.max_elements;
    scene_init(&scene->scene, limit ? limit : 16000000, &scene->object.arena);
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
    const char *text; /* of USD; NULL: read the file `path` */
    size_t size;
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
    struct arena *arena = &load->scene->object.arena;
    const char *name = arena_strndup(arena, load->path, strlen(load->path)), *data;
    size_t size = load->size;
    if (load->text)
        data = arena_strndup(arena, load->text, size);
    else if (!file_source_read(&load->files, name, &data, &size, diags))
        return;
    if (load->text || is_usda(name)) { /* the scene keeps the text */
        scene_read_usda(&load->scene->scene, name, data, size, load->purpose, &load->files.scratch,
                        diags);
        return;
    }
    scene_read_list(&load->scene->scene, name, data, size, diags);
    arena_release(arena, (void *)(uintptr_t)data, size + 1); /* the scene keeps the names */
}

static mxg_status load_scene(mxg_context *context, struct scene_load *load, mxg_scene **out_scene)
{
    if (out_scene)
        *out_scene = NULL;
    if (!load->path || !out_scene)
        return MXG_ERROR_ARGUMENT;
    mxg_status status = mxg_scene_create(context, &load->scene);
    if (status != MXG_OK)
        return status;
    struct object *object = &load->scene->object;
    if (!sandbox_admit_file(context, load->path)) {
        object_unref(object);
        return MXG_ERROR_MEMORY;
    }
    file_source_init(&load->files, object);
    status = object_run(object, read_scene, load);
    file_source_finish(&load->files);
    if (status != MXG_OK) {
        object_unref(object);
        return status;
    }
    *out_scene = load->scene;
    return object_status(object);
}

mxg_status mxg_scene_load(mxg_context *context, const char *path, const char *purpose,
                          mxg_scene **out_scene)
{
    struct scene_load load = {.path = path, .purpose = purpose ? purpose : ""};
    return load_scene(context, &load, out_scene);
}

mxg_status mxg_scene_parse(mxg_context *context, const char *name, const char *data, size_t size,
                           const char *purpose, mxg_scene **out_scene)
{
    struct scene_load load = {.path = data || !size ? name : NULL,
                              .purpose = purpose ? purpose : "",
                              .text = data ? data : "",
                              .size = size};
    return load_scene(context, &load, out_scene);
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
    bool (*next)(void *user_data, uint32_t last, mxg_primitive *out);
    void *user_data;
};

static mxg_status run_addition(struct addition *addition, void (*work)(void *arg))
{
    struct object *object = &addition->scene->object;
    uint32_t errors = object->diagnostics.list.num_errors;
    addition->scene->version++;
    mxg_status status = object_run(object, work, addition);
    if (status != MXG_OK)
        return status;
    return object->diagnostics.list.num_errors > errors ? MXG_ERROR_DOCUMENT : MXG_OK;
}

static void add_paths(void *arg)
{
    struct addition *a = arg;
    struct diag_list *diags = &a->scene->object.diagnostics.list;
    for (size_t i = 0; i < a->num; i++) {
        scene_add_path(&a->scene->scene, a->paths[i], strlen(a->paths[i]), (struct diag_place){0},
                       diags);
    }
}

mxg_status mxg_scene_add_paths(mxg_scene *scene, const char *const *paths, size_t num_paths)
{
    if (!scene || (!paths && num_paths))
        return MXG_ERROR_ARGUMENT;
    struct addition addition = {.scene = scene, .paths = paths, .num = num_paths};
    return run_addition(&addition, add_paths);
}

/* Adds what the callback gave; its number inside, or 0 after a diagnostic. */
static prim_id add_given(mxg_scene *scene, const mxg_primitive *given)
{
    struct diag_list *diags = &scene->object.diagnostics.list;
    struct text_word name = {given->name ? given->name : "", given->name_len},
                     type = {given->type ? given->type : "", given->type_len};
    bool is_known = given->parent == MXG_NONE || has_primitive(scene, given->parent);
    if (!is_known)
        diag_add(diags, DIAG_ID_bad_path, (struct diag_place){0},
                 arena_strndup(diags->arena, name.bytes, name.len),
                 "has a parent that the scene does not have");
    if (!is_known || !scene_check_name(&scene->scene, given->parent + 1, name, diags))
        return 0;
    prim_id added = scene_add_below(&scene->scene, given->parent + 1, name.bytes, name.len);
    if (type.len)
        scene_set_type(&scene->scene, added, type);
    return added;
}

static void add_each(void *arg)
{
    struct addition *a = arg;
    prim_id last = 0;
    for (;;) {
        mxg_primitive given = {.size = sizeof given, .parent = MXG_NONE};
        if (!a->next(a->user_data, scene_number(last), &given))
            return;
        last = add_given(a->scene, &given);
    }
}

mxg_status mxg_scene_add_primitives(mxg_scene *scene,
                                    bool (*next_primitive)(void *user_data, uint32_t last,
                                                           mxg_primitive *out),
                                    void *user_data)
{
    if (!scene || !next_primitive)
        return MXG_ERROR_ARGUMENT;
    struct addition addition = {.scene = scene, .next = next_primitive, .user_data = user_data};
    return run_addition(&addition, add_each);
}

struct removal {
    mxg_scene *scene;
    const uint32_t *primitives;
    size_t num;
};

static void remove_primitives(void *arg)
{
    struct removal *r = arg;
    prim_id *prims = ARENA_ARRAY(&r->scene->object.arena, prim_id, r->num);
    for (size_t i = 0; i < r->num; i++)
        prims[i] = r->primitives[i] + 1;
    scene_remove(&r->scene->scene, prims, r->num);
    arena_release(&r->scene->object.arena, prims, r->num * sizeof *prims);
}

mxg_status mxg_scene_remove_primitives(mxg_scene *scene, const uint32_t *primitives,
                                       size_t num_primitives)
{
    if (!scene || (!primitives && num_primitives))
        return MXG_ERROR_ARGUMENT;
    for (size_t i = 0; i < num_primitives; i++)
        if (!has_primitive(scene, primitives[i]))
            return MXG_ERROR_ARGUMENT;
    if (!num_primitives)
        return MXG_OK;
    struct removal removal = {scene, primitives, num_primitives};
    scene->version++;
    return object_run(&scene->object, remove_primitives, &removal);
}

uint32_t mxg_scene_num_primitives(const mxg_scene *scene)
{
    return scene ? scene->scene.prims.len - 1 : 0;
}

mxg_status mxg_scene_primitive(const mxg_scene *scene, uint32_t index, mxg_primitive *out)
{
    if (!has_primitive(scene, index))
        return MXG_ERROR_ARGUMENT;
    const struct scene_prim *prim = &scene->scene.prims.items[index + 1];
    struct text_word type = scene_type(&scene->scene, index + 1);
    mxg_primitive full = {.parent = scene_number(prim->parent),
                          .first_child = scene_number(prim->first_child),
                          .next_sibling = scene_number(prim->next),
                          .name = prim->name,
                          .name_len = prim->name_len,
                          .type = type.len ? type.bytes : "",
                          .type_len = type.len};
    return struct_write(out, &full, sizeof full);
}

uint32_t mxg_scene_find_primitive(const mxg_scene *scene, const char *path)
{
    return scene && path ? scene_number(scene_find(&scene->scene, path, strlen(path))) : MXG_NONE;
}

size_t mxg_scene_primitive_path(const mxg_scene *scene, uint32_t index, char *buffer,
                                size_t capacity)
{
    if (!has_primitive(scene, index))
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
