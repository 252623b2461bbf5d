// SPDX-License-Identifier: Apache-2.0
/*
 * Lights of UsdLux. The power of a light is that of the schema's properties; sizes are in the
 * world:
 *
 *     radiance = color · temperature · intensity · 2^exposure / (normalize ? size : 1)
 *
 * The size is the area of a light. That of a DistantLight, of an angular diameter of 2 a, is the
 * illuminance of radiance 1: π sin² a, up to a = 90°.
 */
#include "render/site.h"

#include "program/files.h"
#include "program/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846
#define POINT_RADIUS 1e-4 /* of a light without a size, which is normalized */

/* A light that is read. */
struct lamp {
    struct site *site;
    uint32_t primitive;
    struct matrix world;
    struct scene_light light; /* its colour is read, and its intensity without the size */
    bool is_normalized;
};

/* ---- Properties ---- */

static bool has_property(const struct lamp *lamp, const char *name)
{
    return mxg_scene_find_property(lamp->site->scene, lamp->primitive, name) != MXG_NONE;
}

/* The name in a file: older ones have no "inputs:" in front. */
static bool find_input(const struct lamp *lamp, const char *input, char name[64])
{
    snprintf(name, 64, "inputs:%s", input);
    if (has_property(lamp, name))
        return true;
    snprintf(name, 64, "%s", input);
    return has_property(lamp, name);
}

static double input(const struct lamp *lamp, const char *name, double otherwise)
{
    char property[64];
    find_input(lamp, name, property);
    return usd_number(lamp->site, lamp->primitive, property, otherwise);
}

/* Warns of what the picture does not have. */
static void tell_unread(const struct lamp *lamp)
{
    static const struct {
        const char *input;
        bool is_word;   /* any word says something */
        double neutral; /* the number that says nothing */
    } inputs[] = {{"diffuse", false, 1},
                  {"specular", false, 1},
                  {"shaping:focus", false, 0},
                  {"shaping:ies:file", true, 0},
                  {"shadow:enable", false, 1},
                  {"shadow:color", false, 0},
                  {"shadow:distance", false, -1},
                  {"light:filters", true, 0},
                  {"filters", true, 0},
                  {"collection:lightLink:includes", true, 0},
                  {"collection:lightLink:excludes", true, 0},
                  {"collection:shadowLink:includes", true, 0},
                  {"collection:shadowLink:excludes", true, 0}};
    for (size_t i = 0; i < sizeof inputs / sizeof *inputs; ++i) {
        char name[64], word[8];
        if (!find_input(lamp, inputs[i].input, name))
            continue;
        double value = usd_number(lamp->site, lamp->primitive, name, inputs[i].neutral);
        bool has_word =
            mxg_scene_property_word(lamp->site->scene, lamp->primitive, name, 0, word, sizeof word)
                > 0
            && strcmp(word, "None") != 0;
        if (inputs[i].is_word ? has_word : value != inputs[i].neutral)
            site_warn(lamp->site, "light-unread", lamp->primitive, name,
                      "has no effect on the picture");
    }
}

/*
 * The colour of a black body in linear sRGB, with a luminance of 1: the chromaticity of Kim et al.
 * 2002, "Design of Advanced Color - Temperature Control System for HDTV Applications", which begins
 * at 1667 K.
 */
static void black_body(double kelvin, double out[3])
{
    double t = 1000 / fmin(fmax(kelvin, 1667), 25000);
    double x = kelvin < 4000 ? ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.179910
                             : ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.240390;
    double y = kelvin < 2222   ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
               : kelvin < 4000 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                               : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
    double xyz[3] = {x / y, 1, (1 - x - y) / y};
    /* IEC 61966-2-1 */
    static const double rgb[3][3] = {
        {3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}};
    for (size_t i = 0; i < 3; ++i)
        out[i] = fmax(rgb[i][0] * xyz[0] + rgb[i][1] * xyz[1] + rgb[i][2] * xyz[2], 0);
}

static void read_power(struct lamp *lamp, double intensity)
{
    char name[64];
    double color[3] = {1, 1, 1}, tint[3] = {1, 1, 1};
    find_input(lamp, "color", name);
    mxg_scene_property_numbers(lamp->site->scene, lamp->primitive, name, color, 3);
    if (input(lamp, "enableColorTemperature", 0) != 0)
        black_body(input(lamp, "colorTemperature", 6500), tint);
    for (size_t i = 0; i < 3; ++i)
        lamp->light.color[i] = color[i] * tint[i];
    lamp->light.intensity = input(lamp, "intensity", intensity) * exp2(input(lamp, "exposure", 0));
    lamp->is_normalized = input(lamp, "normalize", 0) != 0;
}

/* ---- Types ---- */

static void add(struct lamp *lamp)
{
    struct site *site = lamp->site;
    tell_unread(lamp);
    site_add_light(site, lamp->light);
}

static void set_cone(struct lamp *lamp)
{
    char name[64];
    lamp->light.inner = lamp->light.outer = NO_CONE;
    if (!find_input(lamp, "shaping:cone:angle", name))
        return;
    double angle = input(lamp, "shaping:cone:angle", 90),
           softness = fmin(fmax(input(lamp, "shaping:cone:softness", 0), 0), 1);
    if (angle >= 180)
        return;
    lamp->light.outer = cos(angle * PI / 180);
    lamp->light.inner = cos(angle * (1 - softness) * PI / 180);
}

/* A light of a radiance, which shines from its centre; its area is unit_area · radius². */
static void add_area(struct lamp *lamp, enum light_type type, double radius, double unit_area)
{
    read_power(lamp, 1);
    if (!(radius > 0) && !lamp->is_normalized) {
        site_warn(lamp->site, "light-left-out", lamp->primitive, NULL,
                  "is a light without a size, which gives no light");
        return;
    }
    if (!(radius > 0))
        radius = POINT_RADIUS;
    lamp->light.type = type;
    lamp->light.radius = radius;
    lamp->light.intensity /= lamp->is_normalized ? unit_area * radius * radius : 1;
    memcpy(lamp->light.position, lamp->world.m[3], sizeof lamp->light.position);
    set_cone(lamp);
    add(lamp);
}

static double determinant(const struct matrix *m)
{
    double normal[3];
    vector_cross(m->m[0], m->m[1], normal);
    return normal[0] * m->m[2][0] + normal[1] * m->m[2][1] + normal[2] * m->m[2][2];
}

static void add_sphere(struct lamp *lamp)
{
    double radius = input(lamp, "radius", 0.5) * cbrt(fabs(determinant(&lamp->world)));
    add_area(lamp, LIGHT_SPHERE, radius, 4 * PI);
}

/* A flat light in the plane z = 0, which faces -z. */
static void add_flat(struct lamp *lamp, double area)
{
    double normal[3], size = 0;
    vector_cross(lamp->world.m[0], lamp->world.m[1], normal);
    double side = determinant(&lamp->world) < 0 ? 1 : -1;
    for (size_t i = 0; i < 3; ++i) {
        size += normal[i] * normal[i];
        lamp->light.direction[i] = side * normal[i];
    }
    add_area(lamp, LIGHT_DISK, sqrt(fmax(area * sqrt(size), 0) / PI), PI);
}

static void add_disk(struct lamp *lamp)
{
    double radius = input(lamp, "radius", 0.5);
    add_flat(lamp, PI * radius * radius);
}

static void add_rect(struct lamp *lamp)
{
    char name[64];
    if (find_input(lamp, "texture:file", name))
        site_warn(lamp->site, "light-unread", lamp->primitive, name,
                  "has no effect on the picture");
    add_flat(lamp, input(lamp, "width", 1) * input(lamp, "height", 1));
}

static void add_distant(struct lamp *lamp)
{
    double half = fmin(fmax(input(lamp, "angle", 0.53), 0), 360) / 2 * PI / 180;
    double sine = sin(half), size = half <= PI / 2 ? sine * sine : 2 - sine * sine;
    read_power(lamp, 50000);
    lamp->light.type = LIGHT_DIRECTIONAL;
    lamp->light.intensity *= lamp->is_normalized || !(half > 0) ? 1 : PI * size;
    add(lamp);
}

/* The rotation from USD's map, whose middle is at +z, to the world. */
static struct matrix dome_frame(const struct lamp *lamp, bool has_pole)
{
    const struct site *site = lamp->site;
    bool is_z = has_pole
                && (usd_is(site, lamp->primitive, "poleAxis", "Z")
                    || (!usd_is(site, lamp->primitive, "poleAxis", "Y")
                        && mxg_scene_up_axis(site->scene) == 'Z'));
    struct matrix upright =
        is_z ? matrix_rotation((const double[3]){1, 0, 0}, 90) : matrix_identity();
    return matrix_multiply(site_rigid(lamp->world), upright);
}

/* Reads the map of a dome, relative to the site. */
static bool read_map(struct lamp *lamp, struct image *out)
{
    char name[64], file[1024], reason[256];
    if (!find_input(lamp, "texture:file", name)
        || mxg_scene_property_word(lamp->site->scene, lamp->primitive, name, 0, file, sizeof file)
               < 3)
        return environment_make_plain(1, out);
    size_t marks = strncmp(file, "@@@", 3) == 0 ? 3 : 1, len = strlen(file);
    file[len - marks] = '\0';
    char *path = cli_beside(lamp->site->file, file + marks);
    const char *fault = mxg_context_file_fault(lamp->site->context, lamp->site->file, path);
    bool good = !fault && environment_read(path, out, reason, sizeof reason);
    if (fault)
        site_fail(lamp->site, lamp->primitive, name, "cannot be used: %s", fault);
    else if (!good)
        site_fail(lamp->site, lamp->primitive, name, "cannot be used: %s", reason);
    free(path);
    return good;
}

static void add_dome_of(struct lamp *lamp, bool has_pole)
{
    struct site *site = lamp->site;
    char name[64];
    find_input(lamp, "texture:format", name);
    char format[32] = "automatic";
    mxg_scene_property_word(site->scene, lamp->primitive, name, 0, format, sizeof format);
    if (site->has_dome || (strcmp(format, "automatic") != 0 && strcmp(format, "latlong") != 0)) {
        site_warn(site, "light-left-out", lamp->primitive, site->has_dome ? NULL : name,
                  site->has_dome ? "is a second dome; the first lights the picture"
                                 : "is no 'latlong', the only map that mxgen reads");
        return;
    }
    if (!read_map(lamp, &site->dome))
        return;
    read_power(lamp, 1);
    tell_unread(lamp);
    float *texel = site->dome.pixels;
    for (size_t i = 0; i < (size_t)site->dome.width * site->dome.height; ++i, texel += 4)
        for (size_t c = 0; c < 3; ++c)
            texel[c] *= (float)(lamp->light.color[c] * lamp->light.intensity);
    site->has_dome = true;
    site->dome_world = dome_frame(lamp, has_pole);
}

static void add_dome(struct lamp *lamp)
{
    add_dome_of(lamp, false);
}

static void add_dome_1(struct lamp *lamp)
{
    add_dome_of(lamp, true);
}

/* ---- All ---- */

/* True if USD says that a primitive gives light: a type of UsdLux, or a mesh with its interface. */
static bool is_other_light(const struct lamp *lamp, const char *type)
{
    static const char *const ends[] = {"Light", "LightFilter"};
    for (size_t i = 0; i < sizeof ends / sizeof *ends; ++i)
        if (files_ends_with(type, ends[i]))
            return true;
    return has_property(lamp, "inputs:intensity") || has_property(lamp, "light:shaderId");
}

void usd_add_light(struct site *site, uint32_t primitive, const char *type, struct matrix world)
{
    static const struct {
        const char *type;
        void (*add)(struct lamp *lamp);
    } types[] = {{"DistantLight", add_distant}, {"SphereLight", add_sphere},
                 {"RectLight", add_rect},       {"DiskLight", add_disk},
                 {"DomeLight", add_dome},       {"DomeLight_1", add_dome_1}};
    struct lamp lamp = {.site = site, .primitive = primitive, .world = world};
    for (size_t i = 0; i < 3; ++i)
        lamp.light.direction[i] = -world.m[2][i];
    for (size_t i = 0; i < sizeof types / sizeof *types; ++i)
        if (strcmp(type, types[i].type) == 0) {
            site->is_lit = true;
            types[i].add(&lamp);
            return;
        }
    if (!is_other_light(&lamp, type))
        return;
    site->is_lit = true;
    site_warn(site, "light-left-out", primitive, NULL, "is a light (%s) that mxgen does not draw",
              type);
}
