// SPDX-License-Identifier: Apache-2.0
#include "render/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

/* ---- Attributes ---- */

/* Attributes that are linear in (s, t): value = at[0] + at[1] s + at[2] t for each component. */
struct linear {
    const char *name;
    bool is_family; /* any name that begins so */
    double at[4][3];
};

static const struct linear linear_attributes[] = {
    {"i_texcoord_", true, {{1.21, -0.83, 0.31}, {-0.37, 0.29, 1.13}, {0, 0, 0}, {0, 0, 0}}},
    {"i_color_0", false, {{0.11, 0.67, 0.13}, {0.83, -0.21, -0.47}, {0.29, -0.17, 0.59}, {0.41, 0.37, 0.19}}},
    {"i_color_", true, {{0.29, -0.17, 0.59}, {0.11, 0.67, 0.13}, {0.83, -0.21, -0.47}, {0.41, 0.37, 0.19}}},
    {"i_geomprop_", true, {{0.23, 0.71, -0.11}, {-0.43, 0.31, 0.53}, {0.79, -0.61, 0.23}, {0.51, 0.17, -0.37}}},
};

static double linear(const double at[3], double s, double t)
{
    return at[0] + at[1] * s + at[2] * t;
}

bool scene_attribute(const struct scene *scene, const char *name, uint32_t vertex, float out[4])
{
    static const char *const frame_names[] = {"i_position", "i_normal", "i_tangent", "i_bitangent"};
    float s = scene->parameters[vertex][0], t = scene->parameters[vertex][1];
    float frame[4][3];
    for (size_t i = 0; i < 4; ++i) {
        if (strcmp(name, frame_names[i]) == 0) {
            scene->geometry(s, t, frame[0], frame[1], frame[2], frame[3]);
            memcpy(out, frame[i], sizeof frame[i]);
            return true;
        }
    }
    if (strcmp(name, "i_texcoord_0") == 0) {
        scene->texcoord(s, t, out);
        return true;
    }
    for (size_t i = 0; i < sizeof linear_attributes / sizeof *linear_attributes; ++i) {
        const struct linear *a = &linear_attributes[i];
        if (a->is_family ? strncmp(name, a->name, strlen(a->name)) != 0 : strcmp(name, a->name) != 0)
            continue;
        for (size_t c = 0; c < 4; ++c)
            out[c] = (float)linear(a->at[c], s, t);
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

/* Cuts `end` off the word; false where it does not end so. */
static bool strip_end(const char *word, size_t *len, const char *end)
{
    size_t end_len = strlen(end);
    if (*len < end_len || memcmp(word + *len - end_len, end, end_len) != 0)
        return false;
    *len -= end_len;
    return true;
}

/* u_<world|view|projection and their products>[Inverse][Transpose]Matrix */
static unsigned matrix_uniform(const struct scene *scene, const char *name, float out[16])
{
    struct matrix world_view = matrix_multiply(scene->view, scene->world);
    struct matrix view_projection = matrix_multiply(scene->projection, scene->view);
    const struct {
        const char *name;
        struct matrix matrix;
    } matrices[] = {
        {"world", scene->world},
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
    bool transposed = strip_end(word, &len, "Transpose"), inverted = strip_end(word, &len, "Inverse");
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

unsigned scene_uniform(const struct scene *scene, const char *name, float out[16])
{
    const struct {
        const char *name;
        double value;
    } numbers[] = {
        {"u_frame", 33},
        {"u_time", 1.37},
        {"u_numActiveLightSources", scene->num_lights},
        {"u_envRadianceMips", image_num_mips(&scene->radiance)},
        {"u_envRadianceSamples", scene->environment_samples},
        {"u_envLightIntensity", 1},
        {"u_alphaThreshold", 0.001},
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
        return store_matrix(matrix_scale(-1, 1, -1), out);
    if (strncmp(name, "u_geomprop_", 11) == 0) {
        for (size_t i = 0; i < 4; ++i)
            out[i] = 1.0f;
        return 4;
    }
    return matrix_uniform(scene, name, out);
}

/* ---- Lights ---- */

enum light_type { LIGHT_DIRECTIONAL = 1, LIGHT_POINT = 2 };

struct light {
    enum light_type type;
    double direction[3]; /* not unit */
    double position[3], color[3], intensity, decay_rate;
};

static const struct light lights[SCENE_NUM_LIGHTS] = {
    {LIGHT_DIRECTIONAL, {-0.6, -0.7, -0.4}, {0, 0, 0}, {1.0, 0.95, 0.9}, 2.0, 0},
    {LIGHT_DIRECTIONAL, {0.8, -0.2, -0.55}, {0, 0, 0}, {0.4, 0.55, 0.9}, 0.9, 0},
    {LIGHT_POINT, {0, -1, 0}, {1.4, 1.1, 2.2}, {1.0, 0.8, 0.6}, 9.0, 2.0},
};

unsigned scene_light(uint32_t index, const char *member, float out[3])
{
    const struct light *light = &lights[index];
    double direction[3] = {light->direction[0], light->direction[1], light->direction[2]};
    vector_normalize(direction);
    if (strcmp(member, "direction") == 0)
        return store_vector(direction, out);
    if (strcmp(member, "position") == 0)
        return store_vector(light->position, out);
    if (strcmp(member, "color") == 0)
        return store_vector(light->color, out);
    if (strcmp(member, "type") == 0)
        out[0] = (float)light->type;
    else if (strcmp(member, "intensity") == 0)
        out[0] = (float)light->intensity;
    else if (strcmp(member, "decay_rate") == 0)
        out[0] = (float)light->decay_rate;
    else
        return 0;
    return 1;
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

static bool allocate_mesh(struct scene *scene, uint32_t num_vertices, uint32_t num_indices)
{
    scene->num_vertices = num_vertices;
    scene->num_indices = num_indices;
    scene->parameters = malloc(num_vertices * sizeof *scene->parameters);
    scene->indices = malloc(num_indices * sizeof *scene->indices);
    return scene->parameters && scene->indices;
}

static void set_camera(struct scene *scene, const double eye[3], const double target[3])
{
    memcpy(scene->eye, eye, sizeof scene->eye);
    memcpy(scene->target, target, sizeof scene->target);
    scene->view = matrix_look_at(eye, target);
}

static void sphere_geometry(float s, float t, float position[3], float normal[3], float tangent[3], float bitangent[3])
{
    double theta = 2.0 * PI * s, phi = PI * t;
    const double n[3] = {sin(phi) * sin(theta), -cos(phi), sin(phi) * cos(theta)}, x[3] = {cos(theta), 0, -sin(theta)};
    double y[3];
    vector_cross(n, x, y);
    for (size_t i = 0; i < 3; ++i) {
        position[i] = normal[i] = (float)n[i];
        tangent[i] = (float)x[i];
        bitangent[i] = (float)y[i];
    }
}

static void plain_texcoord(float s, float t, float out[2])
{
    out[0] = s;
    out[1] = t;
}

static bool make_sphere(struct scene *scene)
{
    enum { AROUND = 128, UP = 64 };
    if (!allocate_mesh(scene, (AROUND + 1) * (UP + 1), AROUND * UP * 6))
        return false;
    for (uint32_t i = 0; i < scene->num_vertices; ++i) {
        scene->parameters[i][0] = (float)(i % (AROUND + 1)) / AROUND;
        scene->parameters[i][1] = (float)(i / (AROUND + 1)) / UP;
    }
    for (uint32_t i = 0; i < AROUND * UP; ++i) {
        uint32_t corner = i / AROUND * (AROUND + 1) + i % AROUND, above = corner + AROUND + 1;
        const uint32_t quad[6] = {corner, corner + 1, above + 1, corner, above + 1, above};
        memcpy(scene->indices + i * 6, quad, sizeof quad);
    }
    return true;
}

bool scene_init_sphere(struct scene *scene, double aspect)
{
    *scene = (struct scene){.geometry = sphere_geometry,
                            .texcoord = plain_texcoord,
                            .num_lights = SCENE_NUM_LIGHTS,
                            .environment_samples = 64};
    set_camera(scene, (const double[3]){0.5, 0.7, 3.4}, (const double[3]){0.05, -0.03, 0.1});
    scene->projection = matrix_perspective(40.0, aspect, 0.1, 20.0);
    scene->world = matrix_multiply(matrix_translation(0.05, -0.03, 0.1),
                                   matrix_rotation((const double[3]){0.3, 1, 0.2}, 25.0));
    return environment_make(&scene->radiance, &scene->irradiance) && make_sphere(scene);
}

static const double grid_position[3][3] = {{-0.83, 1.71, 0.09}, {-0.57, 0.12, 1.37}, {0.31, 0.43, -0.58}};

static void grid_geometry(float s, float t, float position[3], float normal[3], float tangent[3], float bitangent[3])
{
    static const double normals[3][3] = {{-0.25, 0.61, 0.07}, {0.35, -0.11, -0.53}, {0.91, 0.08, -0.05}};
    static const double bitangents[3][3] = {{0.06, -0.21, 0.17}, {0.94, 0.13, -0.04}, {-0.31, 0.09, 0.44}};
    for (size_t i = 0; i < 3; ++i) {
        position[i] = (float)linear(grid_position[i], s, t);
        normal[i] = (float)linear(normals[i], s, t);
        bitangent[i] = (float)linear(bitangents[i], s, t);
    }
    tangent[0] = normal[2];
    tangent[1] = 0.0f;
    tangent[2] = -normal[0];
}

static void grid_texcoord(float s, float t, float out[2])
{
    out[0] = (float)linear((const double[3]){0.0313, 0.9371, 0.0129}, s, t);
    out[1] = (float)linear((const double[3]){0.0217, 0.0171, 0.9331}, s, t);
}

/* Each cell is four triangles that meet in its centre, so that the value there is the vertex's. */
static bool make_grid(struct scene *scene)
{
    enum { CELLS = 4, CORNERS = (CELLS + 1) * (CELLS + 1) };
    if (!allocate_mesh(scene, CORNERS + CELLS * CELLS, CELLS * CELLS * 12))
        return false;
    for (uint32_t i = 0; i < CORNERS; ++i) {
        scene->parameters[i][0] = (float)(i % (CELLS + 1)) / CELLS;
        scene->parameters[i][1] = (float)(i / (CELLS + 1)) / CELLS;
    }
    for (uint32_t i = 0; i < CELLS * CELLS; ++i) {
        uint32_t corner = i / CELLS * (CELLS + 1) + i % CELLS, centre = CORNERS + i, above = corner + CELLS + 1;
        scene->parameters[centre][0] = ((float)(i % CELLS) + 0.5f) / CELLS;
        scene->parameters[centre][1] = ((float)(i / CELLS) + 0.5f) / CELLS;
        const uint32_t fan[12] = {corner,    corner + 1, centre, corner + 1, above + 1, centre,
                                  above + 1, above,      centre, above,      corner,    centre};
        memcpy(scene->indices + i * 12, fan, sizeof fan);
    }
    return true;
}

/* The projection that puts the quad 0 <= s, t <= 1 over the whole picture, in front of the camera or not. */
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
    struct matrix from_plane = matrix_multiply(scene->view, matrix_multiply(scene->world, plane));
    return matrix_multiply(to_clip, matrix_inverse(from_plane));
}

bool scene_init_grid(struct scene *scene)
{
    *scene = (struct scene){.geometry = grid_geometry, .texcoord = grid_texcoord, .environment_samples = 64};
    const double axis[3] = {1, 2, 3}, target[3] = {0.4, -0.3, 0.7};
    scene->world = matrix_multiply(matrix_translation(target[0], target[1], target[2]),
                                   matrix_multiply(matrix_rotation(axis, 40.0), matrix_scale(1.3, 0.8, 1.6)));
    set_camera(scene, (const double[3]){1.1, 0.9, 4.3}, target);
    scene->projection = quad_projection(scene, grid_position);
    return environment_make(&scene->radiance, &scene->irradiance) && environment_make_test_texture(&scene->texture) &&
           make_grid(scene);
}

/* The quad -1 <= x, y <= 1 without any distortion. */
static const double plane_position[3][3] = {{-1, 2, 0}, {-1, 0, 2}, {0, 0, 0}};

static void plane_geometry(float s, float t, float position[3], float normal[3], float tangent[3], float bitangent[3])
{
    for (size_t i = 0; i < 3; ++i) {
        position[i] = (float)linear(plane_position[i], s, t);
        tangent[i] = i == 0 ? 1.0f : 0.0f;
        bitangent[i] = i == 1 ? 1.0f : 0.0f;
        normal[i] = i == 2 ? 1.0f : 0.0f;
    }
}

bool scene_init_plane(struct scene *scene)
{
    *scene = (struct scene){.geometry = plane_geometry,
                            .texcoord = plain_texcoord,
                            .num_lights = SCENE_NUM_LIGHTS,
                            .environment_samples = 64,
                            .world = matrix_identity()};
    set_camera(scene, (const double[3]){0, 0, 3.4}, (const double[3]){0, 0, 0});
    scene->projection = quad_projection(scene, plane_position);
    return environment_make(&scene->radiance, &scene->irradiance) && environment_make_test_texture(&scene->texture) &&
           make_grid(scene);
}

void scene_finish(struct scene *scene)
{
    free(scene->parameters);
    free(scene->indices);
    image_finish(&scene->radiance);
    image_finish(&scene->irradiance);
    image_finish(&scene->texture);
}
