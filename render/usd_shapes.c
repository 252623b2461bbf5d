// SPDX-License-Identifier: Apache-2.0
/*
 * The shapes of USD: Sphere, Cube, Cylinder, Cone, Capsule and Plane. A round shape is a profile
 * that turns around the z axis; the attribute `axis` then moves z to another axis.
 */
#include "render/site.h"

#include "program/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

enum { AROUND = 64, ALONG = 32, CELLS = 4 };

/* A point of a profile: distance from the axis, height, and the normal there. */
struct profile_point {
    double r, z, normal_r, normal_z;
};

struct shape {
    struct mesh mesh;
    uint32_t num_vertices, num_indices;
};

static void begin(struct shape *shape, uint32_t num_vertices, uint32_t num_indices)
{
    mesh_allocate(&shape->mesh, num_vertices, num_indices);
}

/* Gives back the memory that the shape does not need. */
static void end(struct shape *shape)
{
    struct mesh *mesh = &shape->mesh;
    mesh->num_vertices = shape->num_vertices;
    mesh->num_indices = shape->num_indices;
    mesh->vertices = memory_resize(mesh->vertices, mesh->num_vertices * sizeof *mesh->vertices);
    mesh->indices = memory_resize(mesh->indices, mesh->num_indices * sizeof *mesh->indices);
}

static void add_vertex(struct shape *shape, const double at[3], const double normal[3], double s,
                       double t)
{
    struct vertex *vertex = &shape->mesh.vertices[shape->num_vertices++];
    for (size_t i = 0; i < 3; ++i) {
        vertex->position[i] = (float)at[i];
        vertex->normal[i] = (float)normal[i];
    }
    vertex->texcoord[0] = (float)s;
    vertex->texcoord[1] = (float)t;
}

/* Cells between (across + 1) * (up + 1) vertices from `first` on. */
static void add_cells(struct shape *shape, uint32_t first, uint32_t across, uint32_t up)
{
    for (uint32_t y = 0; y < up; ++y)
        for (uint32_t x = 0; x < across; ++x) {
            uint32_t a = first + y * (across + 1) + x, b = a + across + 1;
            const uint32_t cell[6] = {a, a + 1, b + 1, a, b + 1, b};
            memcpy(shape->mesh.indices + shape->num_indices, cell, sizeof cell);
            shape->num_indices += 6;
        }
}

/* Turns a part of a profile, from below to above, around the z axis. */
static void turn(struct shape *shape, const struct profile_point *profile, uint32_t count,
                 double low, double high)
{
    uint32_t first = shape->num_vertices;
    for (uint32_t p = 0; p < count; ++p)
        for (uint32_t i = 0; i <= AROUND; ++i) {
            double angle = 2 * PI * i / AROUND, c = cos(angle), s = sin(angle);
            const struct profile_point *at = &profile[p];
            const double position[3] = {at->r * c, at->r * s, at->z};
            const double normal[3] = {at->normal_r * c, at->normal_r * s, at->normal_z};
            add_vertex(shape, position, normal, (double)i / AROUND,
                       low + (high - low) * p / (count - 1));
        }
    add_cells(shape, first, AROUND, count - 1);
}

/* A quarter or half of a circle of `radius` about height z. */
static void turn_arc(struct shape *shape, double radius, double z, double from, double to,
                     double low, double high)
{
    struct profile_point profile[ALONG + 1];
    for (uint32_t i = 0; i <= ALONG; ++i) {
        double angle = from + (to - from) * i / ALONG;
        profile[i] = (struct profile_point){radius * fabs(cos(angle)), z + radius * sin(angle),
                                            cos(angle), sin(angle)};
    }
    turn(shape, profile, ALONG + 1, low, high);
}

static void turn_line(struct shape *shape, double r0, double z0, double r1, double z1, double low,
                      double high)
{
    struct profile_point profile[CELLS + 1];
    double length = hypot(r1 - r0, z1 - z0), normal_r = (z1 - z0) / length,
           normal_z = (r0 - r1) / length;
    for (uint32_t i = 0; i <= CELLS; ++i)
        profile[i] = (struct profile_point){r0 + (r1 - r0) * i / CELLS, z0 + (z1 - z0) * i / CELLS,
                                            normal_r, normal_z};
    turn(shape, profile, CELLS + 1, low, high);
}

/* ---- The shapes ---- */

enum { ROUND_VERTICES = (AROUND + 1) * (ALONG + 1), ROUND_INDICES = AROUND * ALONG * 6 };

/* The radii below and above, and the height. */
struct round {
    double low, high, height;
};

static void make_sphere(struct shape *shape, const struct round *round)
{
    turn_arc(shape, round->low, 0, -PI / 2, PI / 2, 0, 1);
}

static void make_cylinder(struct shape *shape, const struct round *round)
{
    const double half = round->height / 2;
    turn_line(shape, 0, -half, round->low, -half, 0, 0.25);
    turn_line(shape, round->low, -half, round->high, half, 0.25, 0.75);
    turn_line(shape, round->high, half, 0, half, 0.75, 1);
}

static void make_cone(struct shape *shape, const struct round *round)
{
    const double half = round->height / 2;
    turn_line(shape, 0, -half, round->low, -half, 0, 0.25);
    turn_line(shape, round->low, -half, 0, half, 0.25, 1);
}

static void make_capsule(struct shape *shape, const struct round *round)
{
    const double half = round->height / 2;
    turn_arc(shape, round->low, -half, -PI / 2, 0, 0, 0.25);
    turn_line(shape, round->low, -half, round->high, half, 0.25, 0.75);
    turn_arc(shape, round->high, half, 0, PI / 2, 0.75, 1);
}

/* A rectangle with the normal `normal`; `right` and `up` are half its sides. */
static void add_quad(struct shape *shape, const double centre[3], const double right[3],
                     const double up[3], const double normal[3])
{
    uint32_t first = shape->num_vertices;
    for (uint32_t y = 0; y <= CELLS; ++y)
        for (uint32_t x = 0; x <= CELLS; ++x) {
            double s = (double)x / CELLS, t = (double)y / CELLS, at[3];
            for (size_t i = 0; i < 3; ++i)
                at[i] = centre[i] + (2 * s - 1) * right[i] + (2 * t - 1) * up[i];
            add_vertex(shape, at, normal, s, t);
        }
    add_cells(shape, first, CELLS, CELLS);
}

static void make_cube(struct shape *shape, double half)
{
    for (size_t axis = 0; axis < 3; ++axis)
        for (int side = -1; side <= 1; side += 2) {
            double normal[3] = {0}, right[3] = {0}, up[3] = {0}, centre[3] = {0};
            normal[axis] = side;
            centre[axis] = side * half;
            right[(axis + 1) % 3] = side * half; /* right x up = normal */
            up[(axis + 2) % 3] = half;
            add_quad(shape, centre, right, up, normal);
        }
}

/* z becomes the axis, and the others follow in their circle. */
static void set_axis(struct mesh *mesh, char axis)
{
    size_t shift = axis == 'X' ? 1 : axis == 'Y' ? 2 : 0;
    for (uint32_t v = 0; v < mesh->num_vertices; ++v) {
        struct vertex before = mesh->vertices[v];
        for (size_t i = 0; i < 3; ++i) {
            mesh->vertices[v].position[(i + shift) % 3] = before.position[i];
            mesh->vertices[v].normal[(i + shift) % 3] = before.normal[i];
        }
    }
}

static char axis_of(const struct site *site, uint32_t primitive)
{
    return usd_is(site, primitive, "axis", "X")   ? 'X'
           : usd_is(site, primitive, "axis", "Y") ? 'Y'
                                                  : 'Z';
}

static const struct {
    const char *type;
    const char *low, *high; /* the properties with its radii */
    double radius, height;  /* where the file has none: the schema's */
    void (*make)(struct shape *shape, const struct round *round);
} round_shapes[] = {{"Sphere", "radius", "radius", 1, 0, make_sphere},
                    {"Cylinder", "radius", "radius", 1, 2, make_cylinder},
                    {"Cylinder_1", "radiusBottom", "radiusTop", 1, 2, make_cylinder},
                    {"Cone", "radius", "radius", 1, 2, make_cone},
                    {"Capsule", "radius", "radius", 0.5, 1, make_capsule},
                    {"Capsule_1", "radiusBottom", "radiusTop", 0.5, 1, make_capsule}};
enum { NUM_ROUND = sizeof round_shapes / sizeof *round_shapes };

struct measures {
    size_t type; /* index in round_shapes; NUM_ROUND: it is flat */
    bool is_cube;
    struct round round;
    double a, b; /* half the sides of a flat one */
    char axis;
};

static bool measure(struct site *site, uint32_t primitive, const char *type, struct measures *out)
{
    *out = (struct measures){.is_cube = strcmp(type, "Cube") == 0, .axis = 'Z'};
    while (out->type < NUM_ROUND && strcmp(type, round_shapes[out->type].type) != 0)
        ++out->type;
    if (out->type < NUM_ROUND) {
        const double radius = round_shapes[out->type].radius;
        out->round = (struct round){
            .low = usd_number(site, primitive, round_shapes[out->type].low, radius),
            .high = usd_number(site, primitive, round_shapes[out->type].high, radius),
            .height = usd_number(site, primitive, "height", round_shapes[out->type].height)};
    } else if (out->is_cube) {
        out->a = usd_number(site, primitive, "size", 2) / 2;
        return true;
    } else if (strcmp(type, "Plane") == 0) {
        out->a = usd_number(site, primitive, "width", 2) / 2;
        out->b = usd_number(site, primitive, "length", 2) / 2;
    } else {
        return false;
    }
    out->axis = axis_of(site, primitive);
    return true;
}

static struct mesh make_mesh(const struct measures *m)
{
    struct shape shape = {0};
    begin(&shape, 3 * ROUND_VERTICES, 3 * ROUND_INDICES);
    if (m->type < NUM_ROUND)
        round_shapes[m->type].make(&shape, &m->round);
    else if (m->is_cube)
        make_cube(&shape, m->a);
    else
        add_quad(&shape, (const double[3]){0, 0, 0}, (const double[3]){m->a, 0, 0},
                 (const double[3]){0, m->b, 0}, (const double[3]){0, 0, 1});
    end(&shape);
    set_axis(&shape.mesh, m->axis);
    mesh_complete(&shape.mesh, MESH_TANGENTS);
    return shape.mesh;
}

/* Equal shapes have one mesh, which belongs to the first of them. */
bool usd_add_shape(struct site *site, uint32_t primitive, const char *type, struct matrix world)
{
    struct measures measures;
    bool is_new;
    if (!measure(site, primitive, type, &measures))
        return false;
    char *key =
        cli_format("%s %.17g %.17g %.17g %.17g %.17g %c", type, measures.a, measures.b,
                   measures.round.low, measures.round.high, measures.round.height, measures.axis);
    struct name_entry *first = names_add(&site->shapes, key, &is_new);
    struct mesh mesh = is_new ? make_mesh(&measures) : site->objects[first->value - 1].object.mesh;
    free(key);
    if (!site_has_room(site, primitive, mesh.num_indices / 3)) {
        if (is_new)
            mesh_finish(&mesh);
        return true;
    }
    struct scene_object *object = site_add(site, primitive, world);
    object->mesh = mesh;
    site->objects[site->num_objects - 1].shares_mesh = !is_new;
    if (is_new)
        first->value = site->num_objects;
    const struct usd_corners constant = {.count = mesh.num_vertices};
    usd_add_primvars(site, primitive, &constant, object);
    return true;
}
