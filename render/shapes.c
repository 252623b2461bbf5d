// SPDX-License-Identifier: Apache-2.0
/*
 * Meshes from formulas: a shape consists of a few patches, and a patch is a grid over 0 <= u, v <=
 * 1. The derivatives of the formula give normals and tangents.
 */
#include "render/matrix.h"
#include "render/mesh.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

struct patch {
    void (*point)(double u, double v, double out[3]);
    unsigned across, up; /* cells */
};

#define MAX_PATCHES 6

struct shape {
    const char *name;
    struct patch patches[MAX_PATCHES];
};

static void set(double out[3], double x, double y, double z)
{
    out[0] = x, out[1] = y, out[2] = z;
}

/* ---- Formulas ---- */

/* Around y, v upwards; u = 0 points along z. */
static void on_sphere(double u, double v, double out[3])
{
    double theta = 2 * PI * u, phi = PI * v;
    set(out, sin(phi) * sin(theta), -cos(phi), sin(phi) * cos(theta));
}

static void on_plane(double u, double v, double out[3])
{
    set(out, 1.6 * u - 0.8, 1.6 * v - 0.8, 0);
}

#define HALF_CUBE 0.6

/* Faces: around the y axis, then top and bottom. */
static void on_cube_side(double degrees, double u, double v, double out[3])
{
    double x = HALF_CUBE * (2 * u - 1), c = cos(degrees * PI / 180), s = sin(degrees * PI / 180);
    set(out, c * x + s * HALF_CUBE, HALF_CUBE * (2 * v - 1), -s * x + c * HALF_CUBE);
}

static void on_cube_front(double u, double v, double out[3])
{
    on_cube_side(0, u, v, out);
}

static void on_cube_right(double u, double v, double out[3])
{
    on_cube_side(90, u, v, out);
}

static void on_cube_back(double u, double v, double out[3])
{
    on_cube_side(180, u, v, out);
}

static void on_cube_left(double u, double v, double out[3])
{
    on_cube_side(270, u, v, out);
}

static void on_cube_top(double u, double v, double out[3])
{
    set(out, HALF_CUBE * (2 * u - 1), HALF_CUBE, HALF_CUBE * (1 - 2 * v));
}

static void on_cube_bottom(double u, double v, double out[3])
{
    set(out, HALF_CUBE * (2 * u - 1), -HALF_CUBE, HALF_CUBE * (2 * v - 1));
}

/*
 * A square laid over a ball: up to some distance r from its centre it follows the ball, then it
 * hangs down in folds.
 */
#define CLOTH_HALF 1.05   /* half of the square's side */
#define CLOTH_RADIUS 0.52 /* of the ball */
#define CLOTH_BEND 1.25   /* angle at which it leaves the ball */

static void on_cloth(double u, double v, double out[3])
{
    double x = CLOTH_HALF * (2 * u - 1), z = CLOTH_HALF * (1 - 2 * v), r = hypot(x, z),
           around = atan2(z, x);
    double bend = fmin(r / CLOTH_RADIUS, CLOTH_BEND), hang = fmax(r - CLOTH_BEND * CLOTH_RADIUS, 0);
    double fold = sin(8 * around + 0.6) + 0.3 * sin(13 * around - 1.1);
    double away = CLOTH_RADIUS * sin(bend) + hang * (0.2 + 0.28 * fold * hang / (hang + 0.12));
    double height = CLOTH_RADIUS * cos(bend) - 0.93 * hang;
    set(out, away * cos(around), height + 0.22, away * sin(around));
}

/* A ball with a groove around it, leaning to the right. */
#define BALL_RADIUS 0.74
#define BALL_HEIGHT 0.22

static void on_ball(double u, double v, double out[3])
{
    on_sphere(u, v, out);
    double latitude = asin(fmax(-1, fmin(1, 0.35 * out[0] + 0.88 * out[1] - 0.32 * out[2]))) - 0.15;
    double groove = 1 / (1 + exp(-70 * (latitude + 0.09))) - 1 / (1 + exp(-70 * (latitude - 0.09)));
    double radius = BALL_RADIUS * (1 - 0.055 * groove);
    set(out, radius * out[0], radius * out[1] + BALL_HEIGHT, radius * out[2]);
}

/* The profile of the foot: (radius, height), from the centre of its top to its rim and below. */
static void on_foot(double u, double v, double out[3])
{
    static const double profile[][2] = {{0, -0.5},     {0, -0.5},    {0.24, -0.5},  {0.32, -0.53},
                                        {0.34, -0.62}, {0.4, -0.72}, {0.54, -0.76}, {0.58, -0.79},
                                        {0.57, -0.84}, {0.5, -0.86}, {0, -0.86},    {0, -0.86}};
    enum { SPANS = sizeof profile / sizeof *profile - 3 };
    double at = (1 - v) * SPANS;
    int span = at >= SPANS ? SPANS - 1 : (int)at;
    double t = at - span, p[2];
    for (size_t i = 0; i < 2; ++i) { /* a uniform cubic B-spline */
        double a = profile[span][i], b = profile[span + 1][i], c = profile[span + 2][i],
               d = profile[span + 3][i];
        p[i] = (pow(1 - t, 3) * a + (3 * t * t * t - 6 * t * t + 4) * b
                + (-3 * t * t * t + 3 * t * t + 3 * t + 1) * c + t * t * t * d)
               / 6;
    }
    set(out, p[0] * sin(2 * PI * u), p[1], p[0] * cos(2 * PI * u));
}

/* ---- Grids ---- */

static const struct shape shapes[] = {
    {"sphere", {{on_sphere, 128, 64}}},
    {"plane", {{on_plane, 16, 16}}},
    {"cube",
     {{on_cube_front, 16, 16},
      {on_cube_right, 16, 16},
      {on_cube_back, 16, 16},
      {on_cube_left, 16, 16},
      {on_cube_top, 16, 16},
      {on_cube_bottom, 16, 16}}},
    {"cloth", {{on_cloth, 192, 192}}},
    {"ball", {{on_ball, 192, 160}, {on_foot, 128, 64}}},
};
enum { NUM_SHAPES = sizeof shapes / sizeof *shapes };

const char *const *shape_names(void)
{
    static const char *names[NUM_SHAPES + 1];
    for (size_t i = 0; i < NUM_SHAPES; ++i)
        names[i] = shapes[i].name;
    return names;
}

/* dP/du or dP/dv, by differences inside the patch. */
static void derivative(const struct patch *patch, double u, double v, double du, double dv,
                       double out[3])
{
    double a[3], b[3];
    patch->point(u - du, v - dv, a);
    patch->point(u + du, v + dv, b);
    for (size_t i = 0; i < 3; ++i)
        out[i] = b[i] - a[i];
}

static double inside(double x)
{
    return fmax(1e-4, fmin(1 - 1e-4, x)); /* away from poles, where a patch has no tangent */
}

static void make_vertex(const struct patch *patch, double u, double v, struct vertex *out)
{
    double p[3], x[3], y[3], n[3];
    patch->point(u, v, p);
    derivative(patch, inside(u), inside(v), 1e-5, 0, x);
    derivative(patch, inside(u), inside(v), 0, 1e-5, y);
    vector_cross(x, y, n);
    vector_normalize(n);
    vector_normalize(x);
    for (size_t i = 0; i < 3; ++i) {
        out->position[i] = (float)p[i];
        out->normal[i] = (float)n[i];
        out->tangent[i] = (float)x[i];
    }
    out->texcoord[0] = out->parameter[0] = (float)u;
    out->texcoord[1] = out->parameter[1] = (float)v;
}

/* The square of the distance of a point from the middle between two vertices. */
static double miss(const struct vertex *vertices, uint32_t a, uint32_t b, const double point[3])
{
    double sum = 0;
    for (size_t i = 0; i < 3; ++i) {
        double d = ((double)vertices[a].position[i] + vertices[b].position[i]) / 2 - point[i];
        sum += d * d;
    }
    return sum;
}

/*
 * True if a cell is halved from its upper left to its lower right corner, because that diagonal is
 * nearer to the surface: the cells of a groove that crosses the grid do not look like teeth.
 */
static bool falls(const struct patch *patch, const struct vertex *vertices, uint32_t corner,
                  uint32_t above, double u, double v)
{
    double middle[3];
    patch->point(u, v, middle);
    return miss(vertices, corner + 1, above, middle)
           < 0.999 * miss(vertices, corner, above + 1, middle);
}

static void make_patch(const struct patch *patch, unsigned detail, struct mesh *mesh,
                       uint32_t *vertex, uint32_t *index)
{
    uint32_t across = patch->across * detail, up = patch->up * detail, first = *vertex;
    for (uint32_t j = 0; j <= up; ++j)
        for (uint32_t i = 0; i <= across; ++i)
            make_vertex(patch, (double)i / across, (double)j / up, &mesh->vertices[(*vertex)++]);
    for (uint32_t j = 0; j < up; ++j)
        for (uint32_t i = 0; i < across; ++i, *index += 6) {
            uint32_t corner = first + j * (across + 1) + i, above = corner + across + 1;
            const uint32_t rising[6] = {corner, corner + 1, above + 1, corner, above + 1, above},
                           falling[6] = {corner, corner + 1, above, corner + 1, above + 1, above};
            bool is_falling =
                falls(patch, mesh->vertices, corner, above, (i + 0.5) / across, (j + 0.5) / up);
            memcpy(mesh->indices + *index, is_falling ? falling : rising, sizeof rising);
        }
}

void shape_make(const char *name, unsigned detail, struct mesh *out)
{
    const struct shape *shape = shapes;
    while (strcmp(shape->name, name) != 0)
        ++shape;
    uint32_t vertices = 0, indices = 0;
    for (const struct patch *p = shape->patches; p < shape->patches + MAX_PATCHES && p->point;
         ++p) {
        vertices += (p->across * detail + 1) * (p->up * detail + 1);
        indices += p->across * detail * p->up * detail * 6;
    }
    mesh_allocate(out, vertices, indices);
    vertices = indices = 0;
    for (const struct patch *p = shape->patches; p < shape->patches + MAX_PATCHES && p->point; ++p)
        make_patch(p, detail, out, &vertices, &indices);
}
