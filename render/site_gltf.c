// SPDX-License-Identifier: Apache-2.0
/*
 * A site from a file of glTF 2.0. Its nodes are primitives; a node with a mesh of several
 * primitives has one of the stage for each below it.
 */
#include "import/gltf_accessor.h"
#include "import/gltf_nodes.h"
#include "program/memory.h"
#include "render/gltf_geometry.h"
#include "render/site.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define HALF_TURN 3.14159265358979323846

/* A primitive of a mesh that a node has. */
struct part {
    const json_t *node;
    size_t number, mesh, index; /* of the node, and of the primitive in its mesh */
    uint32_t primitive;         /* of the stage */
};

struct importer {
    struct site *site;
    struct gltf_source source;
    struct gltf_nodes nodes;
    struct gltf_pose pose;
    struct gltf_numbering numbering;
    struct part *parts;
    size_t num_parts;
    struct name_table made; /* by mesh, primitive and skin: 1 + its object; 0: it has none */
    uint32_t num_undrawn, first_undrawn; /* primitives that are points or lines */
};

/* ---- Cameras and lights ---- */

static uint32_t add_path(struct importer *in, const char *path)
{
    if (!report_status(in->site->report, mxg_scene_add_paths(in->site->scene, &path, 1)))
        return MXG_NONE;
    return mxg_scene_find_primitive(in->site->scene, path);
}

/* glTF 2.0, 3.10. */
static bool add_camera(struct importer *in, const struct gltf_node *node, uint32_t primitive)
{
    size_t index = gltf_index_of(node->json, "camera");
    const json_t *camera = gltf_source_item(&in->source, "cameras", index),
                 *lens = json_object_get(camera, "perspective");
    double angle = json_number_value(json_object_get(lens, "yfov")),
           aspect = json_number_value(json_object_get(lens, "aspectRatio"));
    if (index == SIZE_MAX)
        return true;
    if (camera && strcmp(json_text_of(camera, "type"), "orthographic") == 0) {
        site_warn(in->site, "not-drawn", primitive, NULL,
                  "is an orthographic camera, which mxgen does not draw");
        return true;
    }
    if (!(angle > 0 && angle < HALF_TURN) || !(aspect >= 0))
        return gltf_source_fail(&in->source,
                                "cameras[%zu].perspective has the yfov %g and the aspectRatio %g; "
                                "expected an angle between 0 and pi",
                                index, angle, aspect);
    double height = tan(angle / 2);
    site_add_camera(in->site, (struct site_camera){.world = in->pose.worlds[node->index],
                                                   .width = aspect * height,
                                                   .height = height,
                                                   .path = cli_format("%s", node->path)});
    return true;
}

/* KHR_lights_punctual. A light shines along -z. */
static bool add_light(struct importer *in, const struct gltf_node *node)
{
    static const char extension[] = "KHR_lights_punctual";
    const json_t *user = json_object_get(json_object_get(node->json, "extensions"), extension);
    const json_t *own = json_object_get(json_object_get(in->source.root, "extensions"), extension);
    size_t index = gltf_index_of(user, "light");
    const json_t *light = json_array_get(json_object_get(own, "lights"), index),
                 *spot = json_object_get(light, "spot"),
                 *outer = json_object_get(spot, "outerConeAngle"),
                 *intensity = json_object_get(light, "intensity");
    const char *type = json_text_of(light, "type");
    bool is_far = strcmp(type, "directional") == 0, is_spot = strcmp(type, "spot") == 0;
    struct scene_light added = {.type = is_far ? LIGHT_DIRECTIONAL : LIGHT_POINT,
                                .color = {1, 1, 1},
                                .inner = NO_CONE,
                                .outer = NO_CONE};
    if (!user)
        return true;
    if (!is_far && !is_spot && strcmp(type, "point") != 0)
        return gltf_source_fail(&in->source,
                                "light %zu of %s has the type '%.40s'; expected directional, point "
                                "or spot",
                                index, extension, type);
    if (!gltf_pose_numbers(&in->source, light, "color", 3, added.color))
        return false;
    for (size_t i = 0; i < 3; ++i)
        added.color[i] *= intensity ? json_number_value(intensity) : 1;
    if (is_spot) {
        added.inner = cos(json_number_value(json_object_get(spot, "innerConeAngle")));
        added.outer = cos(outer ? json_number_value(outer) : HALF_TURN / 4);
    }
    const double along[3] = {0, 0, -1}, at[3] = {0};
    matrix_direction(in->pose.worlds[node->index], along, added.direction);
    matrix_point(in->pose.worlds[node->index], at, added.position);
    site_add_lamp(in->site, added);
    return true;
}

/* ---- The walk ---- */

static bool add_part(struct importer *in, const struct gltf_node *node, size_t mesh, size_t index)
{
    const char *path = gltf_nodes_add_part(&in->nodes, node, index);
    if (!path)
        return false;
    uint32_t primitive =
        path == node->path ? mxg_scene_find_primitive(in->site->scene, path) : add_path(in, path);
    if (primitive == MXG_NONE)
        return false;
    MEMORY_PUSH(in->parts, in->num_parts,
                (struct part){node->json, node->index, mesh, index, primitive});
    return true;
}

/* Adds the paths, and what needs no other node: joints may come later. */
static bool visit_node(void *user_data, const struct gltf_node *node)
{
    struct importer *in = user_data;
    size_t mesh = gltf_index_of(node->json, "mesh");
    const json_t *json = gltf_source_item(&in->source, "meshes", mesh);
    uint32_t primitive = add_path(in, node->path);
    if (primitive == MXG_NONE || !gltf_pose_place(&in->pose, node->index, node->parent))
        return false;
    if (mesh != SIZE_MAX && !json)
        return gltf_source_fail(&in->source, "nodes[%zu] has the mesh %zu, which is missing",
                                node->index, mesh);
    for (size_t i = 0; i < json_array_size(json_object_get(json, "primitives")); ++i)
        if (!add_part(in, node, mesh, i))
            return false;
    return add_camera(in, node, primitive) && add_light(in, node);
}

/* ---- Objects ---- */

/* Makes the object of a part. *out_object is its number; MXG_NONE: there are no triangles. */
static bool make_object(struct importer *in, const struct part *part,
                        const struct gltf_shape *shape, struct matrix world, uint32_t *out_object)
{
    struct scene_object made = {0};
    unsigned parts;
    *out_object = MXG_NONE;
    bool good = gltf_geometry_read(&in->source, shape, &in->numbering, &made, &parts);
    good = good
           && (!made.mesh.num_indices
               || site_has_room(in->site, part->primitive, made.mesh.num_indices / 3));
    if (!good || !made.mesh.num_indices) {
        object_finish(&made);
        return good;
    }
    struct scene_object *object = site_add(in->site, part->primitive, world);
    made.world = object->world;
    made.path = object->path;
    *object = made;
    *out_object = in->site->num_objects - 1;
    in->site->objects[*out_object].made = parts;
    return true;
}

/* Adds the object of a part, which others of its mesh and skin share. */
static bool add_object(struct importer *in, const struct part *part, struct matrix world)
{
    const json_t *mesh = gltf_source_item(&in->source, "meshes", part->mesh),
                 *own_weights = json_object_get(part->node, "weights");
    struct gltf_shape shape = {
        .primitive = json_array_get(json_object_get(mesh, "primitives"), part->index),
        .weights = own_weights ? own_weights : json_object_get(mesh, "weights")};
    size_t skin = gltf_index_of(part->node, "skin"),
           size = sizeof(struct site_object)
                  + mxg_scene_primitive_path(in->site->scene, part->primitive, NULL, 0);
    if (!gltf_source_spend(&in->source, size)) /* instances may be many */
        return false;
    if (skin != SIZE_MAX && !(shape.skin = gltf_pose_skin(&in->pose, skin)))
        return false;
    /* joints place a mesh in the world */
    struct matrix place = shape.skin ? matrix_identity() : world;
    char *key = cli_format("%zu/%zu/%zu/%zu", part->mesh, part->index, skin,
                           own_weights ? part->number : SIZE_MAX);
    bool is_new, good;
    struct name_entry *entry = names_add(&in->made, key, &is_new);
    free(key);
    if (is_new) {
        uint32_t object;
        good = make_object(in, part, &shape, place, &object);
        entry->value = good && object != MXG_NONE ? object + 1 : 0;
    } else {
        good = !entry->value
               || site_share(in->site, (uint32_t)entry->value - 1, part->primitive, place);
    }
    return good;
}

/* ---- Instances: EXT_mesh_gpu_instancing ---- */

struct instances {
    struct gltf_accessor shifts, turns, scales; /* count 0: there are none */
};

static bool open_instances(struct importer *in, const json_t *attributes, struct instances *out)
{
    const struct {
        const char *name;
        unsigned width;
        struct gltf_accessor *accessor;
    } members[] = {
        {"TRANSLATION", 3, &out->shifts}, {"ROTATION", 4, &out->turns}, {"SCALE", 3, &out->scales}};
    size_t count = 0;
    *out = (struct instances){0};
    for (size_t i = 0; i < sizeof members / sizeof *members; ++i) {
        size_t index = gltf_index_of(attributes, members[i].name);
        struct gltf_accessor *accessor = members[i].accessor;
        if (index == SIZE_MAX)
            continue;
        if (!gltf_accessor_open(&in->source, index, members[i].width, members[i].width, accessor))
            return false;
        if (count && accessor->count != count)
            return gltf_source_fail(&in->source,
                                    "accessors[%zu] has %zu elements; the instances are %zu", index,
                                    accessor->count, count);
        count = accessor->count;
    }
    return true;
}

static bool read_instance(struct importer *in, const struct instances *from, size_t at,
                          struct matrix *out)
{
    const struct gltf_accessor *const accessors[] = {&from->shifts, &from->turns, &from->scales};
    double numbers[3][4] = {{0}, {0, 0, 0, 1}, {1, 1, 1}};
    for (size_t i = 0; i < 3; ++i) {
        float read[GLTF_MAX_WIDTH];
        if (!accessors[i]->count)
            continue;
        if (!gltf_accessor_floats(&in->source, accessors[i], at, read))
            return false;
        for (size_t k = 0; k < accessors[i]->width; ++k)
            numbers[i][k] = (double)read[k];
    }
    *out = gltf_pose_matrix(numbers[0], numbers[1], numbers[2]);
    return true;
}

/* Adds a part once, or for each instance that its node has. */
static bool add_part_objects(struct importer *in, const struct part *part)
{
    const json_t *own =
        json_object_get(json_object_get(part->node, "extensions"), "EXT_mesh_gpu_instancing");
    const json_t *mesh = gltf_source_item(&in->source, "meshes", part->mesh),
                 *primitive = json_array_get(json_object_get(mesh, "primitives"), part->index);
    struct matrix world = in->pose.worlds[part->number];
    struct instances instances;
    if (!gltf_geometry_has_triangles(primitive)) {
        in->first_undrawn = in->num_undrawn++ ? in->first_undrawn : part->primitive;
        return true;
    }
    if (!own)
        return add_object(in, part, world);
    if (!open_instances(in, json_object_get(own, "attributes"), &instances))
        return false;
    size_t num = instances.shifts.count  ? instances.shifts.count
                 : instances.turns.count ? instances.turns.count
                                         : instances.scales.count;
    for (size_t i = 0; i < num; ++i) {
        struct matrix local;
        if (!read_instance(in, &instances, i, &local)
            || !add_object(in, part, matrix_multiply(world, local)))
            return false;
    }
    return true;
}

/* ---- All ---- */

/* Tells what the file has and the picture lacks. */
static void tell_undrawn(const struct importer *in)
{
    char more[64] = "";
    if (in->num_undrawn > 1)
        snprintf(more, sizeof more, "and %u more have", (unsigned)in->num_undrawn - 1);
    if (in->num_undrawn)
        site_warn(in->site, "not-drawn", in->first_undrawn, NULL,
                  "%s points or lines, which mxgen does not draw", *more ? more : "has");
    if (json_array_size(json_object_get(in->source.root, "animations")) && !in->site->report->quiet)
        fprintf(stderr,
                "note: '%s' has animations, which mxgen does not play: nodes, weights and joints "
                "are as the file has them without\n",
                in->site->file);
}

static bool read_scene(struct importer *in)
{
    bool good = gltf_nodes_walk(&in->nodes, &in->source, visit_node, in) && !*in->source.fault;
    for (size_t i = 0; good && i < in->num_parts; ++i)
        good = add_part_objects(in, &in->parts[i]);
    if (good)
        tell_undrawn(in);
    return good;
}

bool site_read_gltf(struct site *site)
{
    struct importer in = {.site = site};
    json_use_memory();
    bool good = gltf_source_open(&in.source, site->context, site->file);
    if (good) {
        gltf_pose_begin(&in.pose, &in.source);
        good = read_scene(&in);
        gltf_pose_finish(&in.pose);
    }
    if (*in.source.fault)
        report_error(site->report, "bad-mesh", "cannot use the mesh '%s': %s", site->file,
                     in.source.fault);
    site->meters_per_unit = 1;
    site->file_size = in.source.size;
    gltf_nodes_finish(&in.nodes);
    gltf_source_close(&in.source);
    names_finish(&in.made);
    free(in.numbering.items);
    free(in.parts);
    return good;
}
