// SPDX-License-Identifier: Apache-2.0
/* The bindings that a host gives the primitives of a scene. */
#include "api/scene.h"

struct binding_change {
    mxg_scene *scene;
    prim_id prim;
    const char *slot, *material; /* material NULL: remove */
};

static void change_binding(void *arg)
{
    struct binding_change *change = arg;
    struct slot_name slot;
    const char *fault = slot_parse(change->slot, strlen(change->slot), &slot);
    struct diag_list *diags = &change->scene->object.diagnostics.list;
    if (fault)
        diag_add(diags, DIAG_ID_bad_slot, (struct diag_place){0},
                 arena_strndup(diags->arena, change->slot, strlen(change->slot)), fault);
    else if (change->material)
        scene_bind(&change->scene->scene, change->prim, &slot, change->material);
    else
        scene_unbind(&change->scene->scene, change->prim, &slot);
}

/* MXG_NONE is the whole scene, the root inside. */
static bool is_place(const mxg_scene *scene, uint32_t primitive)
{
    return primitive == MXG_NONE || has_primitive(scene, primitive);
}

static mxg_status run_change(struct binding_change change, uint32_t primitive)
{
    if (!change.scene || !change.slot || !is_place(change.scene, primitive))
        return MXG_ERROR_ARGUMENT;
    struct object *object = &change.scene->object;
    uint32_t errors = object->diagnostics.list.num_errors;
    change.prim = primitive + 1;
    change.scene->version++;
    mxg_status status = object_run(object, change_binding, &change);
    if (status != MXG_OK)
        return status;
    return object->diagnostics.list.num_errors > errors ? MXG_ERROR_DOCUMENT : MXG_OK;
}

mxg_status mxg_scene_set_binding(mxg_scene *scene, uint32_t primitive, const char *slot,
                                 const char *material)
{
    struct binding_change change = {.scene = scene, .slot = slot, .material = material};
    return material ? run_change(change, primitive) : MXG_ERROR_ARGUMENT;
}

mxg_status mxg_scene_remove_binding(mxg_scene *scene, uint32_t primitive, const char *slot)
{
    struct binding_change change = {.scene = scene, .slot = slot};
    return run_change(change, primitive);
}

/* ---- The list ---- */

uint32_t mxg_scene_num_bindings(const mxg_scene *scene, uint32_t primitive)
{
    if (!scene || !is_place(scene, primitive))
        return 0;
    uint32_t num = 0;
    for (uint32_t i = scene_first_binding(&scene->scene, primitive + 1); i;
         i = scene->scene.bindings.items[i - 1].next)
        num++;
    return num;
}

mxg_status mxg_scene_binding(const mxg_scene *scene, uint32_t primitive, uint32_t index,
                             mxg_slot_binding *out)
{
    if (index >= mxg_scene_num_bindings(scene, primitive))
        return MXG_ERROR_ARGUMENT;
    const struct scene_binding *items = scene->scene.bindings.items;
    uint32_t at = scene_first_binding(&scene->scene, primitive + 1);
    for (; index; index--)
        at = items[at - 1].next;
    const struct scene_binding *binding = &items[at - 1];
    mxg_slot_binding full = {
        .slot = binding->name,
        .material = binding->material,
        .is_collection = binding->is_collection,
        .is_strong = binding->is_strong,
        .is_purpose = binding->is_purpose,
        .file = binding->place.file ? binding->place.file : "",
        .line = binding->place.line,
    };
    return struct_write(out, &full, sizeof full);
}
