// SPDX-License-Identifier: Apache-2.0
#include "render/scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

/* ---- Attributes ---- */

/* Attributes that are linear in (s, t): value = at[0] + at[1] s + at[2] t for each component. */
struct linear {
    const char *name;
    bool is_family; /* any name with this prefix */
    double at[4][3];
};

static const struct linear linear_attributes[] = {
    {"i_texcoord_", true, {{1.21, -0.83, 0.31}, {-0.37, 0.29, 1.13}, {0, 0, 0}, {0, 0, 0}}},
    {"i_color_0",
     false,
     {{0.11, 0.67, 0.13}, {0.83, -0.21, -0.47}, {0.29, -0.17, 0.59}, {0.41, 0.37, 0.19}}},
    {"i_color_",
     true,
     {{0.29, -0.17, 0.59}, {0.11, 0.67, 0.13}, {0.83, -0.21, -0.47}, {0.41, 0.37, 0.19}}},
    {"i_geomprop_",
     true,
     {{0.23, 0.71, -0.11}, {-0.43, 0.31, 0.53}, {0.79, -0.61, 0.23}, {0.51, 0.17, -0.37}}},
};

static double linear(const double at[3], double s, double t)
{
    return at[0] + at[1] * s + at[2] * t;
}

/* "i_position"…: three components of a vertex; NULL for other names. */
static const float *frame_attribute(const struct vertex *vertex, const char *name)
{
    const struct {
        const char *name;
        const float *value;
    } frame[] = {{"i_position", vertex->position},
                 {"i_normal", vertex->normal},
                 {"i_tangent", vertex->tangent}};
    for (size_t i = 0; i < sizeof frame / sizeof *frame; ++i) {
        if (strcmp(name, frame[i].name) == 0)
            return frame[i].value;
    }
    return NULL;
}

const char *scene_name(const char *name, const char *semantic, char buffer[SCENE_MAX_NAME])
{
    static const char *const families[][2] = {{"geomprop:", "i_geomprop_"},
                                              {"geomprop_", "u_geomprop_"}};
    for (size_t i = 0; i < sizeof families / sizeof *families; ++i) {
        size_t len = strlen(families[i][0]);
        if (strncmp(semantic, families[i][0], len) != 0)
            continue;
        snprintf(buffer, SCENE_MAX_NAME, "%s%s", families[i][1], semantic + len);
        return buffer;
    }
    return name;
}

void scene_primvar_name(const char *attribute, char out[SCENE_MAX_NAME])
{
    static const struct {
        const char *prefix, *first, *others;
    } families[] = {{"i_texcoord_", "st", "st"}, {"i_color_", "displayColor", "displayColor"}};
    for (size_t i = 0; i < sizeof families / sizeof *families; ++i) {
        size_t len = strlen(families[i].prefix);
        if (strncmp(attribute, families[i].prefix, len) != 0)
            continue;
        bool is_first = strcmp(attribute + len, "0") == 0;
        snprintf(out, SCENE_MAX_NAME, "%s%s", is_first ? families[i].first : families[i].others,
                 is_first ? "" : attribute + len);
        return;
    }
    snprintf(out, SCENE_MAX_NAME, "%s",
             strncmp(attribute, "i_geomprop_", 11) == 0 ? attribute + 11 : attribute);
}

const struct primvar *scene_primvar(const struct scene_object *object, const char *name)
{
    char wanted[SCENE_MAX_NAME];
    scene_primvar_name(name, wanted);
    if (!object->path)
        return NULL;
    const struct primvar *found = object_primvar(object, wanted);
    bool may_stand_in = !found && strcmp(wanted, "displayColor") == 0;
    return may_stand_in ? object_primvar(object, "geomcolor") : found; /* of a <geominfo> */
}

static bool store_primvar(const struct primvar *primvar, uint32_t index, float *out)
{
    if (!primvar || !primvar->components)
        return false;
    memcpy(out, primvar->values[primvar->num == 1 ? 0 : index], primvar->components * sizeof *out);
    return true;
}

/* The alpha of a colour is a primvar of its own: displayOpacity of displayColor. */
static bool primvar_attribute(const struct scene_object *object, const char *name, uint32_t index,
                              float out[4])
{
    bool is_color = strncmp(name, "i_color_", 8) == 0;
    const struct primvar *primvar = scene_primvar(object, name);
    if (is_color && primvar && primvar->components == 3) {
        out[3] = 1;
        if (strcmp(name, "i_color_0") == 0)
            store_primvar(object_primvar(object, "displayOpacity"), index, &out[3]);
    }
    return store_primvar(primvar, index, out);
}

/* In USD, Blender and glTF's importers, Houdini, and Maya. */
const char *const scene_texcoords[] = {"i_geomprop_st", "i_geomprop_UVMap", "i_geomprop_uv",
                                       "i_geomprop_map1", NULL};

bool scene_is_texcoord(const char *attribute)
{
    for (size_t i = 0; scene_texcoords[i]; ++i)
        if (strcmp(attribute, scene_texcoords[i]) == 0)
            return true;
    return false;
}

bool scene_attribute(const struct scene_object *object, const char *name, uint32_t index,
                     float out[4])
{
    const struct vertex *vertex = &object->mesh.vertices[index];
    const float *frame = frame_attribute(vertex, name);
    if (frame) {
        memcpy(out, frame, 3 * sizeof *out);
        return true;
    }
    bool is_first = strcmp(name, "i_texcoord_0") == 0;
    if (!is_first && object->path && primvar_attribute(object, name, index, out))
        return true;
    if (is_first || (object->names_texcoords && scene_is_texcoord(name))) {
        memcpy(out, vertex->texcoord, sizeof vertex->texcoord);
        return true;
    }
    if (object->path)
        return false;
    for (size_t i = 0; i < sizeof linear_attributes / sizeof *linear_attributes; ++i) {
        const struct linear *a = &linear_attributes[i];
        if (a->is_family ? strncmp(name, a->name, strlen(a->name)) != 0
                         : strcmp(name, a->name) != 0)
            continue;
        for (size_t c = 0; c < 4; ++c)
            out[c] = (float)linear(a->at[c], vertex->parameter[0], vertex->parameter[1]);
        return true;
    }
    return false;
}

/* ---- Uniforms ---- */

static unsigned store_matrix(struct matrix matrix, float out[16])
{
    for (size_t i = 0; i < 16; ++i)
        out[i] = (float)matrix.m[i / 4][i % 4];
    return 16;
}

/* Removes the suffix `end` from the word; false if it does not have it. */
static bool strip_end(const char *word, size_t *len, const char *end)
{
    size_t end_len = strlen(end);
    if (*len < end_len || memcmp(word + *len - end_len, end, end_len) != 0)
        return false;
    *len -= end_len;
    return true;
}

/* u_<world|view|projection and their products>[Inverse][Transpose]Matrix */
static unsigned matrix_uniform(const struct scene *scene, const struct matrix *world,
                               const char *name, float out[16])
{
    struct matrix world_view = matrix_multiply(scene->view, *world);
    struct matrix view_projection = matrix_multiply(scene->projection, scene->view);
    const struct {
        const char *name;
        struct matrix matrix;
    } matrices[] = {
        {"world", *world},
        {"view", scene->view},
        {"projection", scene->projection},
        {"worldView", world_view},
        {"viewProjection", view_projection},
        {"worldViewProjection", matrix_multiply(scene->projection, world_view)},
    };
    const char *word = name + 2;
    size_t len = strlen(word);
    if (!strip_end(word, &len, "Matrix"))
        return 0;
    bool transposed = strip_end(word, &len, "Transpose"),
         inverted = strip_end(word, &len, "Inverse");
    for (size_t i = 0; i < sizeof matrices / sizeof *matrices; ++i) {
        if (strlen(matrices[i].name) != len || memcmp(word, matrices[i].name, len) != 0)
            continue;
        struct matrix matrix = inverted ? matrix_inverse(matrices[i].matrix) : matrices[i].matrix;
        return store_matrix(transposed ? matrix_transpose(matrix) : matrix, out);
    }
    return 0;
}

static unsigned store_vector(const double v[3], float out[3])
{
    for (size_t i = 0; i < 3; ++i)
        out[i] = (float)v[i];
    return 3;
}

unsigned scene_uniform(const struct scene *scene, const struct scene_object *object,
                       const char *name, float out[16])
{
    const struct {
        const char *name;
        double value;
    } numbers[] = {
        {"u_frame", scene->frame},
        {"u_layerSample", scene->layer_sample},
        {"u_time", 1.37},
        {"u_numActiveLightSources", scene->num_lights},
        {"u_envRadianceMips", image_num_mips(&scene->radiance)},
        {"u_envRadianceSamples", scene->environment_samples},
        {"u_envLightIntensity", 1},
        {"u_alphaThreshold", 0.001},
        {"u_volumeDepth", 2},
        {"u_slabThickness", 0.1},
        {"u_slabUnit", scene->unit > 0 ? scene->unit : 1},
    };
    if (strncmp(name, "u_", 2) != 0)
        return 0;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i) {
        if (strcmp(name, numbers[i].name) == 0) {
            out[0] = (float)numbers[i].value;
            return 1;
        }
    }
    double direction[3] = {scene->target[0] - scene->eye[0], scene->target[1] - scene->eye[1],
                           scene->target[2] - scene->eye[2]};
    vector_normalize(direction);
    if (strcmp(name, "u_viewPosition") == 0)
        return store_vector(scene->eye, out);
    if (strcmp(name, "u_viewDirection") == 0)
        return store_vector(direction, out);
    if (strcmp(name, "u_envMatrix") == 0)
        return store_matrix(scene->environment, out);
    if (object->path && strncmp(name, "u_geomprop_", 11) == 0) {
        char attribute[SCENE_MAX_NAME];
        snprintf(attribute, sizeof attribute, "i_%s", name + 2);
        return primvar_attribute(object, attribute, 0, out) ? 4 : 0;
    }
    if (strncmp(name, "u_geomprop_", 11) == 0) {
        for (size_t i = 0; i < 4; ++i)
            out[i] = 1.0f;
        return 4;
    }
    return matrix_uniform(scene, &object->world, name, out);
}

/* ---- Lights ---- */

static const struct scene_light studio_lights[SCENE_NUM_LIGHTS] = {
    {LIGHT_DIRECTIONAL, {-0.6, -0.7, -0.4}, {0}, {1.0, 0.95, 0.9}, 2.0, 0, 0, 0, 0},
    {LIGHT_DIRECTIONAL, {0.8, -0.2, -0.55}, {0}, {0.4, 0.55, 0.9}, 0.9, 0, 0, 0, 0},
    {LIGHT_POINT, {-1.4, -1.1, -2.2}, {1.4, 1.1, 2.2}, {1.0, 0.8, 0.6}, 9.0, 2.0, 0, 0, 0},
};

/* How much larger the world is than the studio. */
static double studio_scale(const struct scene *scene)
{
    const double *column = scene->studio.m[0];
    return sqrt(column[0] * column[0] + column[1] * column[1] + column[2] * column[2]);
}

static const struct scene_light *light_at(const struct scene *scene, uint32_t index)
{
    return scene->site_lights ? &scene->site_lights[index % scene->num_site_lights]
                              : &studio_lights[index % SCENE_NUM_LIGHTS];
}

unsigned scene_light(const struct scene *scene, uint32_t index, const char *member, float out[3])
{
    const struct scene_light *light = light_at(scene, index);
    double direction[3], position[3], scale = studio_scale(scene);
    bool has_size = light->type == LIGHT_SPHERE || light->type == LIGHT_DISK;
    const struct {
        const char *name;
        double value;
        bool is_given;
    } numbers[] = {{"type", light->type, true},
                   {"intensity", light->intensity * pow(scale, light->decay_rate), true},
                   {"decay_rate", light->decay_rate, true},
                   {"radius", light->radius, has_size},
                   {"inner_angle", light->inner, has_size},
                   {"outer_angle", light->outer, has_size}};
    matrix_direction(scene->studio, light->direction, direction);
    vector_normalize(direction);
    matrix_point(scene->studio, light->position, position);
    if (strcmp(member, "direction") == 0)
        return store_vector(direction, out);
    if (strcmp(member, "position") == 0)
        return store_vector(position, out);
    if (strcmp(member, "color") == 0)
        return store_vector(light->color, out);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i)
        if (numbers[i].is_given && strcmp(member, numbers[i].name) == 0) {
            out[0] = (float)numbers[i].value;
            return 1;
        }
    return 0;
}

const struct image *scene_image(const struct scene *scene, const char *name)
{
    if (strcmp(name, "u_envRadiance") == 0)
        return &scene->radiance;
    if (strcmp(name, "u_envIrradiance") == 0)
        return &scene->irradiance;
    return NULL;
}

/* ---- Meshes ---- */

void scene_set_camera(struct scene *scene, const double eye[3], const double target[3])
{
    memcpy(scene->eye, eye, sizeof scene->eye);
    memcpy(scene->target, target, sizeof scene->target);
    scene->view = matrix_look_at(eye, target);
}

void scene_backdrop(const struct scene *scene, double x, double y, double out[3])
{
    const struct matrix *m = &scene->projection;
    const double ray[3] = {(x + m->m[2][0]) / m->m[0][0], (y + m->m[2][1]) / m->m[1][1], -1};
    double world[3], d[3];
    matrix_direction(matrix_transpose(scene->view), ray, world); /* the inverse of a rotation */
    matrix_direction(scene->environment, world, d);
    vector_normalize(d);
    environment_lookup(&scene->radiance, d, out);
}

static struct scene start(unsigned num_lights)
{
    return (struct scene){.num_lights = num_lights,
                          .environment_samples = 64,
                          .frame = SCENE_FRAME,
                          .layer_sample = -1,
                          .object.world = matrix_identity(),
                          .studio = matrix_identity(),
                          .near = SCENE_NEAR,
                          /* maps begin behind the viewer, as in MaterialX */
                          .environment = matrix_scale(-1, 1, -1)};
}

bool scene_init_sphere(struct scene *scene, double aspect)
{
    *scene = start(SCENE_NUM_LIGHTS);
    scene_set_camera(scene, (const double[3]){0.5, 0.7, 3.4}, (const double[3]){0.05, -0.03, 0.1});
    scene->projection = matrix_perspective(40.0, aspect, 0.1, 20.0);
    scene->object.world = matrix_multiply(matrix_translation(0.05, -0.03, 0.1),
                                          matrix_rotation((const double[3]){0.3, 1, 0.2}, 25.0));
    shape_make("sphere", 1, &scene->object.mesh);
    return environment_make(&scene->radiance, &scene->irradiance);
}

/* A quad by (s, t), with linear parts. The tangent is (n.z, 0, -n.x). */
struct quad {
    double position[3][3], normal[3][3], texcoord[2][3];
};

static void make_vertex(const struct quad *quad, float s, float t, struct vertex *out)
{
    for (size_t i = 0; i < 3; ++i) {
        out->position[i] = (float)linear(quad->position[i], s, t);
        out->normal[i] = (float)linear(quad->normal[i], s, t);
    }
    out->tangent[0] = out->normal[2];
    out->tangent[2] = -out->normal[0];
    for (size_t i = 0; i < 2; ++i)
        out->texcoord[i] = (float)linear(quad->texcoord[i], s, t);
    out->parameter[0] = s;
    out->parameter[1] = t;
}

/*
 * Each cell has four triangles that meet in its centre, so the value there is the value of the
 * vertex.
 */
static void make_quad(const struct quad *quad, struct mesh *mesh)
{
    enum { CELLS = 4, CORNERS = (CELLS + 1) * (CELLS + 1) };
    mesh_allocate(mesh, CORNERS + CELLS * CELLS, CELLS * CELLS * 12);
    for (uint32_t i = 0; i < CORNERS; ++i)
        make_vertex(quad, (float)(i % (CELLS + 1)) / CELLS, (float)(i / (CELLS + 1)) / CELLS,
                    &mesh->vertices[i]);
    for (uint32_t i = 0; i < CELLS * CELLS; ++i) {
        uint32_t corner = i / CELLS * (CELLS + 1) + i % CELLS, centre = CORNERS + i,
                 above = corner + CELLS + 1;
        make_vertex(quad, ((float)(i % CELLS) + 0.5f) / CELLS, ((float)(i / CELLS) + 0.5f) / CELLS,
                    &mesh->vertices[centre]);
        const uint32_t fan[12] = {corner,    corner + 1, centre, corner + 1, above + 1, centre,
                                  above + 1, above,      centre, above,      corner,    centre};
        memcpy(mesh->indices + i * 12, fan, sizeof fan);
    }
}

/*
 * The projection that fits the quad 0 <= s, t <= 1 to the picture, in front of or behind the
 * camera.
 */
static struct matrix quad_projection(const struct scene *scene, const double position[3][3])
{
    double origin[3], ds[3], dt[3], normal[3];
    for (size_t i = 0; i < 3; ++i) {
        origin[i] = position[i][0];
        ds[i] = position[i][1];
        dt[i] = position[i][2];
    }
    vector_cross(ds, dt, normal);
    struct matrix plane = matrix_identity();
    for (size_t i = 0; i < 3; ++i) {
        plane.m[0][i] = ds[i];
        plane.m[1][i] = dt[i];
        plane.m[2][i] = normal[i];
        plane.m[3][i] = origin[i];
    }
    struct matrix to_clip = {{{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 0.25, 0}, {-1, -1, 0.5, 1}}};
    struct matrix from_plane =
        matrix_multiply(scene->view, matrix_multiply(scene->object.world, plane));
    return matrix_multiply(to_clip, matrix_inverse(from_plane));
}

/* The quad fills the picture of the camera. */
static bool show_quad(struct scene *scene, const struct quad *quad)
{
    scene->projection = quad_projection(scene, quad->position);
    make_quad(quad, &scene->object.mesh);
    return environment_make(&scene->radiance, &scene->irradiance)
           && environment_make_test_texture(&scene->texture);
}

bool scene_init_grid(struct scene *scene)
{
    static const struct quad grid = {
        .position = {{-0.83, 1.71, 0.09}, {-0.57, 0.12, 1.37}, {0.31, 0.43, -0.58}},
        .normal = {{-0.25, 0.61, 0.07}, {0.35, -0.11, -0.53}, {0.91, 0.08, -0.05}},
        .texcoord = {{0.0313, 0.9371, 0.0129}, {0.0217, 0.0171, 0.9331}},
    };
    *scene = start(0);
    const double axis[3] = {1, 2, 3}, target[3] = {0.4, -0.3, 0.7};
    scene->object.world =
        matrix_multiply(matrix_translation(target[0], target[1], target[2]),
                        matrix_multiply(matrix_rotation(axis, 40.0), matrix_scale(1.3, 0.8, 1.6)));
    scene_set_camera(scene, (const double[3]){1.1, 0.9, 4.3}, target);
    return show_quad(scene, &grid);
}

bool scene_init_plane(struct scene *scene)
{
    static const struct quad plane = {
        /* -1 <= x, y <= 1 without any distortion */
        .position = {{-1, 2, 0}, {-1, 0, 2}, {0, 0, 0}},
        .normal = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}},
        .texcoord = {{0, 1, 0}, {0, 0, 1}},
    };
    *scene = start(SCENE_NUM_LIGHTS);
    scene_set_camera(scene, (const double[3]){0, 0, 3.4}, (const double[3]){0, 0, 0});
    return show_quad(scene, &plane);
}

void scene_finish(struct scene *scene)
{
    object_finish(&scene->object);
    image_finish(&scene->radiance);
    image_finish(&scene->irradiance);
    image_finish(&scene->albedo);
    image_finish(&scene->texture);
}
