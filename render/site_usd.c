// SPDX-License-Identifier: Apache-2.0
/* The objects of a scene of USD: a walk down its primitives, with instances of PointInstancer. */
#include "render/site.h"

#include "program/memory.h"
#include "program/scene_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Properties ---- */

double *usd_numbers(struct site *site, uint32_t primitive, const char *name, size_t *out_count)
{
    *out_count = mxg_scene_property_numbers(site->scene, primitive, name, NULL, 0);
    if (!*out_count)
        return NULL;
    double *numbers = memory_alloc(*out_count * sizeof *numbers);
    mxg_scene_property_numbers(site->scene, primitive, name, numbers, *out_count);
    for (size_t i = 0; i < *out_count; ++i)
        if (!isfinite(numbers[i])) {
            site_fail(site, primitive, name, "has %g as number %zu of %zu; expected finite numbers",
                      numbers[i], i + 1, *out_count);
            free(numbers);
            *out_count = 0;
            return NULL;
        }
    return numbers;
}

double usd_number(struct site *site, uint32_t primitive, const char *name, double otherwise)
{
    double number = otherwise;
    mxg_scene_property_numbers(site->scene, primitive, name, &number, 1);
    if (isfinite(number))
        return number;
    site_fail(site, primitive, name, "has %g; expected a finite number", number);
    return otherwise;
}

bool usd_is(const struct site *site, uint32_t primitive, const char *name, const char *value)
{
    char word[64];
    return mxg_scene_property_word(site->scene, primitive, name, 0, word, sizeof word)
           && strcmp(word, value) == 0;
}

/* ---- The walk ---- */

struct visit {
    uint32_t primitive;
    struct matrix parent;
    uint32_t depth;    /* of instancers around it */
    uint32_t instance; /* 1 + index in the instances of the site; 0: none */
    bool is_beside;    /* the purpose of its parent is no picture: "guide", "proxy" */
};

/* Primitives that are told instead of drawn, and what is told. */
#define NOT_DRAWN "which mxgen does not draw"
static const struct {
    const char *type, *told;
} undrawn[] = {{"BasisCurves", NOT_DRAWN},
               {"NurbsCurves", NOT_DRAWN},
               {"HermiteCurves", NOT_DRAWN},
               {"NurbsPatch", NOT_DRAWN},
               {"TetMesh", NOT_DRAWN},
               {"Volume", NOT_DRAWN},
               {"SkelRoot", "whose joints and blend shapes move nothing here: meshes have the "
                            "points of the file"}};
enum { NUM_UNDRAWN = sizeof undrawn / sizeof *undrawn };

struct walk {
    struct site *site;
    struct visit *visits;
    size_t num_visits, num_instances;
    struct made *made; /* by primitive */
    struct {
        uint32_t first, num;
    } undrawn[NUM_UNDRAWN]; /* primitives of these types */
};

/* The objects of a primitive, which its other instances share. */
struct made {
    uint32_t first, num;
    bool is_known;
};

enum { MAX_DEPTH = 16, MAX_INSTANCES = 1 << 20 };

/* Children are visited in their order: the last one is pushed first. */
static void push_children(struct walk *walk, uint32_t first, struct visit below)
{
    size_t begin = walk->num_visits;
    mxg_primitive at = {sizeof at};
    for (below.primitive = first; below.primitive != UINT32_MAX;
         below.primitive = at.next_sibling) {
        MEMORY_PUSH(walk->visits, walk->num_visits, below);
        mxg_scene_primitive(walk->site->scene, below.primitive, &at);
    }
    for (size_t i = begin, k = walk->num_visits; i + 1 < k; ++i) {
        struct visit swapped = walk->visits[--k];
        walk->visits[k] = walk->visits[i];
        walk->visits[i] = swapped;
    }
}

/* True if a primitive is no part of a picture by its purpose, or that of what it stands in. */
static bool is_beside(const struct site *site, uint32_t primitive, bool is_parent_beside)
{
    char purpose[64];
    if (!mxg_scene_property_word(site->scene, primitive, "purpose", 0, purpose, sizeof purpose))
        return is_parent_beside;
    return strcmp(purpose, "guide") == 0 || strcmp(purpose, "proxy") == 0;
}

static bool is_regular(struct matrix m)
{
    double normal[3];
    vector_cross(m.m[0], m.m[1], normal);
    return fabs(normal[0] * m.m[2][0] + normal[1] * m.m[2][1] + normal[2] * m.m[2][2]) > 0;
}

/* ---- Cameras ---- */

static void add_camera(struct site *site, uint32_t primitive, struct matrix world)
{
    /* the defaults of the schema, all in tenths of a unit */
    double focal = usd_number(site, primitive, "focalLength", 50);
    if (usd_is(site, primitive, "projection", "orthographic") || !(focal > 0)) {
        site_fail(site, primitive, focal > 0 ? "projection" : "focalLength",
                  "is no perspective, which is the only one that mxgen draws");
        return;
    }
    struct site_camera camera = {
        .world = world,
        .width = usd_number(site, primitive, "horizontalAperture", 20.955) / 2 / focal,
        .height = usd_number(site, primitive, "verticalAperture", 15.2908) / 2 / focal,
        .centre = {usd_number(site, primitive, "horizontalApertureOffset", 0) / focal,
                   usd_number(site, primitive, "verticalApertureOffset", 0) / focal},
        .path = scene_file_path(site->scene, primitive)};
    site_add_camera(site, camera);
}

/* ---- Instances ---- */

/* The arrays of a PointInstancer. */
struct instances {
    double *positions, *orientations, *scales, *prototypes, *hidden, *inactive, *ids;
    uint32_t *targets; /* by number of prototype */
    size_t num, num_orientations, num_scales, num_prototypes, num_hidden, num_inactive, num_ids,
        num_targets;
};

static int compare_numbers(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

static double id_of(const struct instances *instances, size_t i)
{
    return i < instances->num_ids ? instances->ids[i] : (double)i;
}

/* True if a sorted list has the id. */
static bool has_id(const double *ids, size_t num, double id)
{
    return num && bsearch(&id, ids, num, sizeof id, compare_numbers);
}

static bool is_masked(const struct instances *in, size_t i)
{
    double id = id_of(in, i);
    return has_id(in->hidden, in->num_hidden, id) || has_id(in->inactive, in->num_inactive, id);
}

static double *read_ids(struct site *site, uint32_t primitive, const char *name, size_t *out_num)
{
    double *ids = usd_numbers(site, primitive, name, out_num);
    if (ids)
        qsort(ids, *out_num, sizeof *ids, compare_numbers);
    return ids;
}

/* The prototypes of an instancer by their numbers; MXG_NONE: the stage lacks one. */
static uint32_t *find_prototypes(const struct site *site, uint32_t primitive, size_t *out_num)
{
    *out_num = mxg_scene_property_targets(site->scene, primitive, "prototypes", NULL, 0);
    uint32_t *targets = memory_alloc(*out_num * sizeof *targets + 1);
    mxg_scene_property_targets(site->scene, primitive, "prototypes", targets, *out_num);
    return targets;
}

/* Reads the arrays; false after an error. */
static bool read_instances(struct site *site, uint32_t primitive, struct instances *out)
{
    *out = (struct instances){0};
    out->positions = usd_numbers(site, primitive, "positions", &out->num);
    out->orientations = usd_numbers(site, primitive, "orientationsf", &out->num_orientations);
    if (!out->orientations) /* in half precision */
        out->orientations = usd_numbers(site, primitive, "orientations", &out->num_orientations);
    out->scales = usd_numbers(site, primitive, "scales", &out->num_scales);
    out->prototypes = usd_numbers(site, primitive, "protoIndices", &out->num_prototypes);
    out->hidden = read_ids(site, primitive, "invisibleIds", &out->num_hidden);
    out->inactive = read_ids(site, primitive, "inactiveIds", &out->num_inactive);
    out->ids = usd_numbers(site, primitive, "ids", &out->num_ids);
    out->targets = find_prototypes(site, primitive, &out->num_targets);
    out->num /= 3;
    out->num_orientations /= 4;
    out->num_scales /= 3;
    if (out->num_prototypes != out->num)
        site_fail(site, primitive, "protoIndices", "has %zu numbers for %zu positions",
                  out->num_prototypes, out->num);
    return out->num_prototypes == out->num;
}

static void free_instances(struct instances *instances)
{
    double *const arrays[] = {instances->positions,  instances->orientations, instances->scales,
                              instances->prototypes, instances->hidden,       instances->inactive,
                              instances->ids};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i)
        free(arrays[i]);
    free(instances->targets);
}

static struct matrix instance_matrix(const struct instances *instances, size_t i)
{
    const double *at = &instances->positions[3 * i];
    struct matrix out = matrix_translation(at[0], at[1], at[2]);
    if (i < instances->num_orientations)
        out = matrix_multiply(out, matrix_orientation(&instances->orientations[4 * i]));
    if (i < instances->num_scales) {
        const double *scale = &instances->scales[3 * i];
        out = matrix_multiply(out, matrix_scale(scale[0], scale[1], scale[2]));
    }
    return out;
}

static uint32_t add_instance(struct site *site, struct visit at, size_t number, double id)
{
    MEMORY_PUSH(site->instances, site->num_instances,
                (struct site_instance){at.primitive, at.instance, number, id});
    return site->num_instances;
}

static void add_instances(struct walk *walk, struct visit at, struct matrix world)
{
    struct site *site = walk->site;
    struct instances in;
    bool good = read_instances(site, at.primitive, &in);
    walk->num_instances += in.num;
    if (good && walk->num_instances > MAX_INSTANCES) {
        site_fail(site, at.primitive, NULL, "and others have more than %d instances",
                  MAX_INSTANCES);
        good = false;
    }
    for (size_t i = good ? in.num : 0; i-- > 0;) {
        double number = in.prototypes[i];
        bool is_known = number >= 0 && number < (double)in.num_targets;
        uint32_t prototype = is_known ? in.targets[(size_t)number] : MXG_NONE;
        if (prototype == MXG_NONE) {
            site_fail(site, at.primitive, "protoIndices", "has %g, which is no prototype", number);
            break;
        }
        if (!is_masked(&in, i))
            MEMORY_PUSH(walk->visits, walk->num_visits,
                        (struct visit){prototype, matrix_multiply(world, instance_matrix(&in, i)),
                                       at.depth + 1, add_instance(site, at, i, id_of(&in, i)),
                                       at.is_beside});
    }
    free_instances(&in);
}

/* Notes the instances that objects are parts of, and adds their primvars; the innermost first. */
static void set_instance(struct walk *walk, uint32_t first, uint32_t instance)
{
    struct site *site = walk->site;
    for (uint32_t i = first; i < site->num_objects; ++i)
        site->objects[i].instance = instance;
    for (; instance; instance = site->instances[instance - 1].above)
        for (uint32_t i = first; i < site->num_objects; ++i)
            usd_add_instance_primvars(site, site->instances[instance - 1].instancer,
                                      site->instances[instance - 1].number, &site->objects[i]);
}

static void note_undrawn(struct walk *walk, uint32_t primitive, const char *type)
{
    for (size_t i = 0; i < NUM_UNDRAWN; ++i)
        if (strcmp(type, undrawn[i].type) == 0 && !walk->undrawn[i].num++)
            walk->undrawn[i].first = primitive;
}

/* One warning for each type, at its first primitive. */
static void tell_undrawn(const struct walk *walk)
{
    for (size_t i = 0; i < NUM_UNDRAWN; ++i)
        if (walk->undrawn[i].num > 1)
            site_warn(walk->site, "not-drawn", walk->undrawn[i].first, NULL,
                      "and %u more are %s, %s", (unsigned)walk->undrawn[i].num - 1, undrawn[i].type,
                      undrawn[i].told);
        else if (walk->undrawn[i].num)
            site_warn(walk->site, "not-drawn", walk->undrawn[i].first, NULL, "is %s, %s",
                      undrawn[i].type, undrawn[i].told);
}

/* Adds the geometry of a primitive, for the first time or again. */
static void add_objects(struct walk *walk, uint32_t primitive, const char *type,
                        struct matrix world)
{
    struct site *site = walk->site;
    struct made *made = &walk->made[primitive];
    if (made->is_known) {
        site_repeat(site, made->first, made->num, world);
        return;
    }
    *made = (struct made){.first = site->num_objects, .is_known = true};
    if (strcmp(type, "Mesh") == 0)
        usd_add_mesh(site, primitive, world);
    else if (strcmp(type, "Points") == 0)
        usd_add_points(site, primitive, world);
    else if (!usd_add_shape(site, primitive, type, world))
        note_undrawn(walk, primitive, type);
    made->num = site->num_objects - made->first;
}

static void add_geometry(struct walk *walk, struct visit at, const char *type, struct matrix world)
{
    uint32_t first = walk->site->num_objects;
    add_objects(walk, at.primitive, type, world);
    set_instance(walk, first, at.instance);
}

/* Adds what stands at a primitive itself. */
static void add_primitive(struct walk *walk, struct visit at, const char *type, struct matrix world)
{
    struct site *site = walk->site;
    if (strcmp(type, "Camera") == 0)
        add_camera(site, at.primitive, world);
    else if (strcmp(type, "PointInstancer") != 0 && is_regular(world))
        add_geometry(walk, at, type, world);
    if (is_regular(world))
        usd_add_light(site, at.primitive, type, world);
}

static void visit(struct walk *walk, struct visit at)
{
    struct site *site = walk->site;
    mxg_primitive primitive = {sizeof primitive};
    bool resets;
    if (usd_is(site, at.primitive, "visibility", "invisible"))
        return;
    at.is_beside = is_beside(site, at.primitive, at.is_beside);
    mxg_scene_primitive(site->scene, at.primitive, &primitive);
    struct matrix local = usd_transform(site, at.primitive, &resets);
    struct matrix world = resets ? local : matrix_multiply(at.parent, local);
    char *type = cli_format("%.*s", (int)primitive.type_len, primitive.type);
    if (!at.is_beside)
        add_primitive(walk, at, type, world);
    /* prototypes below an instancer are drawn as its instances only */
    if (strcmp(type, "PointInstancer") != 0)
        push_children(walk, primitive.first_child,
                      (struct visit){0, world, at.depth, at.instance, at.is_beside});
    else if (at.depth == MAX_DEPTH)
        site_fail(site, at.primitive, NULL, "has instances that contain it");
    else
        add_instances(walk, at, world);
    free(type);
}

void site_read_usd(struct site *site)
{
    struct walk walk = {.site = site};
    mxg_primitive at = {sizeof at};
    uint32_t num = mxg_scene_num_primitives(site->scene);
    walk.made = memory_alloc(num * sizeof *walk.made);
    site->num_primitives = num;
    for (uint32_t i = num; i-- > 0;) { /* roots in their order: the first is visited first */
        mxg_scene_primitive(site->scene, i, &at);
        if (at.parent == UINT32_MAX)
            MEMORY_PUSH(walk.visits, walk.num_visits,
                        (struct visit){.primitive = i, .parent = matrix_identity()});
    }
    while (walk.num_visits && !site->has_fault)
        visit(&walk, walk.visits[--walk.num_visits]);
    tell_undrawn(&walk);
    free(walk.made);
    free(walk.visits);
}

uint32_t site_bound_primitive(const struct site *site, const struct site_object *object)
{
    uint32_t found = MXG_NONE;
    if (mxg_scene_num_primitives(site->scene) == site->num_primitives)
        return object->primitive;
    for (uint32_t i = object->instance; i && found == MXG_NONE; i = site->instances[i - 1].above) {
        const struct site_instance *instance = &site->instances[i - 1];
        char *instancer = scene_file_path(site->scene, instance->instancer);
        for (char *c = instancer; *c; ++c)
            *c = *c == '/' ? ':' : *c;
        char *path = cli_format("%s/%s[%.0f]", object->object.path, instancer + 1, instance->id);
        found = mxg_scene_find_primitive(site->scene, path);
        free(path);
        free(instancer);
    }
    return found == MXG_NONE ? object->primitive : found;
}
