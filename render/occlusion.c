// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "render/occlusion.h"

#include "program/batch.h"
#include "program/memory.h"
#include "render/bvh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A point of a primitive: where it is, and the mean of what its corners see. */
struct point {
    float position[3];
    double sum;
    uint32_t num;
};

struct occlusion {
    struct site *site;
    struct bvh bvh;
    double (*rays)[3]; /* of the cone around z, with a density like their cosine */
    size_t num_rays;
    double near;       /* how far a ray begins from its point */
    uint32_t *last_of; /* by primitive: 1 + the last object of a mesh; 0: there is none */
    uint32_t *before;  /* by object: 1 + the one before it of its mesh */
    bool *is_above;    /* by primitive: it is such a mesh, or one is below it */
    bool *is_told;     /* by primitive: a warning said that it has no points */
    FILE *out;
    unsigned depth;
};

/* ---- Rays ---- */

/* Malley's method (Pharr, Jakob, Humphreys, section A.5.3) over the disk of Vogel's spiral. */
static void make_rays(struct occlusion *occlusion)
{
    const double golden_angle = 2.39996322972865332;
    occlusion->rays = memory_alloc(occlusion->num_rays * sizeof *occlusion->rays);
    for (size_t i = 0; i < occlusion->num_rays; ++i) {
        double square = ((double)i + 0.5) / (double)occlusion->num_rays,
               turn = golden_angle * (double)i;
        occlusion->rays[i][0] = sqrt(square) * cos(turn);
        occlusion->rays[i][1] = sqrt(square) * sin(turn);
        occlusion->rays[i][2] = sqrt(1 - square);
    }
}

/* The part of the rays from a place in the world that meets nothing. */
static double open_part(const struct occlusion *occlusion, const double place[3],
                        const double normal[3])
{
    double x[3] = {0, normal[2], -normal[1]}, y[3], from[3], direction[3];
    if (fabs(normal[0]) > 0.5) {
        x[0] = -normal[2];
        x[1] = 0;
        x[2] = normal[0];
    }
    vector_normalize(x);
    vector_cross(normal, x, y);
    size_t num_open = 0;
    for (size_t k = 0; k < 3; ++k)
        from[k] = place[k] + occlusion->near * normal[k];
    for (size_t i = 0; i < occlusion->num_rays; ++i) {
        const double *ray = occlusion->rays[i];
        for (size_t k = 0; k < 3; ++k)
            direction[k] = ray[0] * x[k] + ray[1] * y[k] + ray[2] * normal[k];
        num_open += !bvh_is_closed(&occlusion->bvh, from, direction);
    }
    return (double)num_open / (double)occlusion->num_rays;
}

/* ---- Points ---- */

static int compare_points(const void *a, const void *b)
{
    return memcmp(a, b, sizeof((const struct point *)a)->position);
}

/*
 * Where a corner of a triangle looks from, and along which normal, in the world; `turn` is the
 * matrix of the object's normals.
 */
static void place_corner(const struct scene_object *object, struct matrix turn,
                         const uint32_t *triangle, uint32_t corner, double out_place[3],
                         double out_normal[3])
{
    const double inwards = 0.05; /* of the way to the centre: another mesh may touch the corner */
    const struct vertex *vertices = object->mesh.vertices;
    for (size_t k = 0; k < 3; ++k) {
        double centre = 0, at = (double)vertices[triangle[corner]].position[k];
        for (size_t i = 0; i < 3; ++i)
            centre += (double)vertices[triangle[i]].position[k] / 3;
        out_place[k] = at + inwards * (centre - at);
        out_normal[k] = (double)vertices[triangle[corner]].normal[k];
    }
    matrix_point(object->world, out_place, out_place);
    matrix_direction(turn, out_normal, out_normal);
    vector_normalize(out_normal);
}

/* The first of the points at a place; NULL: there is none. They stand in order. */
static struct point *find_point(struct point *points, size_t num, const float position[3])
{
    struct point key = {.num = 0};
    memcpy(key.position, position, sizeof key.position);
    struct point *point = bsearch(&key, points, num, sizeof *points, compare_points);
    while (point && point > points && compare_points(point, point - 1) == 0)
        --point;
    return point;
}

/* Adds what the corners of an object see to the points. */
static void see(const struct occlusion *occlusion, const struct scene_object *object,
                struct point *points, size_t num)
{
    const struct mesh *mesh = &object->mesh;
    const struct matrix turn = matrix_transpose(matrix_inverse(object->world));
    for (uint32_t i = 0; i + 2 < mesh->num_indices; i += 3)
        for (uint32_t k = 0; k < 3; ++k) {
            double place[3], normal[3];
            struct point *point =
                find_point(points, num, mesh->vertices[mesh->indices[i + k]].position);
            if (!point)
                continue;
            place_corner(object, turn, mesh->indices + i, k, place, normal);
            point->sum += open_part(occlusion, place, normal);
            ++point->num;
        }
}

/* ---- The layer ---- */

static void put_indent(const struct occlusion *occlusion)
{
    fprintf(occlusion->out, "%*s", (int)occlusion->depth * 4, "");
}

/* The points of a mesh as floats, in their order. The caller frees them. */
static struct point *read_points(const struct occlusion *occlusion, uint32_t primitive,
                                 size_t *out_num)
{
    size_t num;
    double *values = usd_numbers(occlusion->site, primitive, "points", &num);
    *out_num = num / 3;
    struct point *points = memory_alloc((*out_num + 1) * sizeof *points);
    for (size_t i = 0; i < 3 * *out_num; ++i)
        points[i / 3].position[i % 3] = (float)values[i];
    free(values);
    return points;
}

/* Writes the primvar: 1 where no face has the point. */
static void put_primvar(const struct occlusion *occlusion, uint32_t primitive)
{
    size_t num;
    struct point *points = read_points(occlusion, primitive, &num),
                 *sorted = memory_alloc((num + 1) * sizeof *sorted);
    memcpy(sorted, points, num * sizeof *sorted);
    qsort(sorted, num, sizeof *sorted, compare_points);
    for (uint32_t i = occlusion->last_of[primitive]; i; i = occlusion->before[i - 1])
        see(occlusion, &occlusion->site->objects[i - 1].object, sorted, num);
    put_indent(occlusion);
    fputs("float[] primvars:ambientocclusion = [", occlusion->out);
    for (size_t i = 0; i < num; ++i) {
        const struct point *point = find_point(sorted, num, points[i].position);
        fprintf(occlusion->out, "%s%.4g", i ? ", " : "",
                point->num ? point->sum / point->num : 1.0);
    }
    fputs("] (interpolation = \"vertex\")\n", occlusion->out);
    free(points);
    free(sorted);
}

/* ---- Primitives ---- */

static bool is_type(const mxg_primitive *primitive, const char *type)
{
    return primitive->type_len == strlen(type)
           && memcmp(primitive->type, type, primitive->type_len) == 0;
}

static mxg_primitive primitive_of(const struct occlusion *occlusion, uint32_t index)
{
    mxg_primitive primitive = {sizeof primitive};
    mxg_scene_primitive(occlusion->site->scene, index, &primitive);
    return primitive;
}

/* The mesh of an object: its primitive, or the one around the subset that it is. */
static uint32_t mesh_of(const struct occlusion *occlusion, uint32_t object)
{
    uint32_t index = occlusion->site->objects[object].primitive;
    mxg_primitive primitive = primitive_of(occlusion, index);
    return is_type(&primitive, "GeomSubset") ? primitive.parent : index;
}

/* Lists the objects by their meshes, and marks what is above these. */
static void list_drawn(struct occlusion *occlusion)
{
    struct site *site = occlusion->site;
    const size_t num = mxg_scene_num_primitives(site->scene) + (size_t)1;
    occlusion->last_of = memory_alloc(num * sizeof *occlusion->last_of);
    occlusion->before = memory_alloc((site->num_objects + (size_t)1) * sizeof(uint32_t));
    occlusion->is_above = memory_alloc(num * sizeof *occlusion->is_above);
    occlusion->is_told = memory_alloc(num * sizeof *occlusion->is_told);
    for (uint32_t i = 0; i < site->num_objects; ++i) {
        uint32_t mesh = mesh_of(occlusion, i);
        mxg_primitive primitive = primitive_of(occlusion, mesh);
        if (!is_type(&primitive, "Mesh")) {
            if (!occlusion->is_told[mesh])
                site_warn(site, "occlusion-left-out", mesh, NULL,
                          "has no points that could have an occlusion: it is no Mesh");
            occlusion->is_told[mesh] = true;
            continue;
        }
        occlusion->before[i] = occlusion->last_of[mesh];
        occlusion->last_of[mesh] = i + 1;
        for (; mesh != MXG_NONE && !occlusion->is_above[mesh];
             mesh = primitive_of(occlusion, mesh).parent)
            occlusion->is_above[mesh] = true;
    }
}

static void put_primitive(struct occlusion *occlusion, uint32_t index)
{
    const mxg_primitive primitive = primitive_of(occlusion, index);
    put_indent(occlusion);
    fprintf(occlusion->out, "over \"%.*s\"\n", (int)primitive.name_len, primitive.name);
    put_indent(occlusion);
    fputs("{\n", occlusion->out);
    ++occlusion->depth;
    if (occlusion->last_of[index])
        put_primvar(occlusion, index);
    for (uint32_t child = primitive.first_child; child != MXG_NONE;
         child = primitive_of(occlusion, child).next_sibling)
        if (occlusion->is_above[child])
            put_primitive(occlusion, child);
    --occlusion->depth;
    put_indent(occlusion);
    fputs("}\n", occlusion->out);
}

/* ---- The whole ---- */

static bool build(struct occlusion *occlusion)
{
    const struct site *site = occlusion->site;
    const struct scene_object **objects =
        memory_alloc((site->num_objects + (size_t)1) * sizeof *objects);
    double reach = 0;
    for (uint32_t i = 0; i < site->num_objects; ++i)
        objects[i] = &site->objects[i].object;
    bool good = bvh_build(objects, site->num_objects, &occlusion->bvh);
    for (size_t k = 0; good && k < 3 && occlusion->bvh.num_nodes; ++k)
        reach = fmax(reach,
                     (double)occlusion->bvh.nodes->high[k] - (double)occlusion->bvh.nodes->low[k]);
    occlusion->near = 1e-5 * reach;
    free(objects);
    return good;
}

static void write_layer(struct occlusion *occlusion)
{
    fprintf(occlusion->out, "#usda 1.0\n(\n    doc = \"ambient occlusion, mxgen %s\"\n)\n\n",
            mxg_version_string());
    uint32_t num = mxg_scene_num_primitives(occlusion->site->scene);
    for (uint32_t i = 0; i < num; ++i)
        if (occlusion->is_above[i] && primitive_of(occlusion, i).parent == MXG_NONE)
            put_primitive(occlusion, i);
}

bool occlusion_bake(struct site *site, size_t num_rays, const char *path)
{
    struct occlusion occlusion = {.site = site, .num_rays = num_rays};
    struct batch files = {0};
    char *text = NULL;
    size_t size = 0;
    bool good = build(&occlusion);
    if (!good)
        report_status(site->report, MXG_ERROR_MEMORY);
    make_rays(&occlusion);
    list_drawn(&occlusion);
    occlusion.out = open_memstream(&text, &size);
    if (!occlusion.out)
        memory_fail();
    if (good)
        write_layer(&occlusion);
    if (fclose(occlusion.out) != 0)
        memory_fail();
    const char *reason = good ? batch_write(&files, path, text, size) : NULL;
    if (reason)
        report_error(site->report, "output-failed", "cannot write '%s': %s", path, reason);
    good = batch_end(&files, site->report, good && !reason && !site->report->errors);
    bvh_finish(&occlusion.bvh);
    free(occlusion.rays);
    free(occlusion.last_of);
    free(occlusion.before);
    free(occlusion.is_above);
    free(occlusion.is_told);
    free(text);
    return good;
}
