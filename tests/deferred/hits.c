// SPDX-License-Identifier: Apache-2.0
#include "deferred/hits.h"

#include "unit/test.h"

#include <math.h>

/* A ray per pixel to the ball, without a mesh. OF_OBJECT: the matrix of the object. */
static const char rays[] =
    "layout(local_size_x = 8, local_size_y = 8) in;\n"
    "layout(set = 1, binding = 8, std140) uniform Frame { mat4 to_world; uvec4 size; };\n"
    "bool hit(vec2 at, out vec3 point, out vec3 way)\n"
    "{\n"
    "    vec4 a = to_world * vec4(at, 0.0, 1.0), b = to_world * vec4(at, 1.0, 1.0);\n"
    "    vec3 from = a.xyz / a.w, out_of = from - OF_OBJECT[3].xyz;\n"
    "    way = normalize(b.xyz / b.w - from);\n"
    "    float along = dot(out_of, way), inside = along * along - dot(out_of, out_of) + 1.0;\n"
    "    point = from - (along + sqrt(max(inside, 0.0))) * way;\n"
    "    return inside >= 0.0;\n"
    "}\n"
    "vec2 unwrapped(vec3 local)\n"
    "{\n"
    "    return vec2(fract(atan(local.x, local.z) / 6.2831853), acos(-local.y) / 3.1415927);\n"
    "}\n";

/* The parameters of the function. */
static const char main_begin[] =
    "void main()\n"
    "{\n"
    "    ivec2 place = ivec2(gl_GlobalInvocationID.xy);\n"
    "    vec2 at = vec2(place) + 0.5;\n"
    "    vec3 point, way, dx, dy, ignored;\n"
    "    if (!hit(at, point, way))\n"
    "        return;\n"
    "    dx = hit(at + vec2(1.0, 0.0), dx, ignored) ? dx - point : vec3(0.0);\n"
    "    dy = hit(at + vec2(0.0, 1.0), dy, ignored) ? dy - point : vec3(0.0);\n"
    "    vec3 normal = point - OF_OBJECT[3].xyz, local = normal * mat3(OF_OBJECT);\n" /* rotates */
    "    vec3 tangent = mat3(OF_OBJECT) * normalize(vec3(local.z, 0.0, -local.x));\n"
    "    keep(place, point, way, surface(";

static const char *const keepers[] = {
    [HITS_STORED] =
        "layout(set = 1, binding = 9, std430) buffer Payloads { Surface payloads[]; };\n"
        "struct Ray { vec4 point, view; };\n"
        "layout(set = 1, binding = 10, std430) buffer Rays { Ray rays[]; };\n"
        "void keep(ivec2 place, vec3 point, vec3 way, Surface s)\n"
        "{\n"
        "    uint pixel = uint(place.y) * size.x + uint(place.x);\n"
        "    rays[pixel] = Ray(vec4(point, 0.0), vec4(-way, 0.0));\n"
        "    payloads[pixel] = s;\n"
        "}\n",
    /* as a device blends: factors 1 and 1 - alpha, of alpha 0 and 1 - alpha */
    [HITS_BLENDED] =
        "layout(set = 1, binding = 17, rgba16f) uniform image2D albedo;\n"
        "layout(set = 1, binding = 18, rgba16f) uniform image2D f0;\n"
        "layout(set = 1, binding = 19, rgba16f) uniform image2D normals;\n"
        "layout(set = 1, binding = 20, rgba16f) uniform image2D roughness;\n"
        "vec4 blended(vec4 before, vec4 decal)\n"
        "{\n"
        "    return vec4(decal.xyz, 0.0) + (1.0 - decal.w) * before;\n"
        "}\n"
        "void keep(ivec2 place, vec3 point, vec3 way, Surface s)\n"
        "{\n"
        "    imageStore(albedo, place, blended(imageLoad(albedo, place), s.decal_albedo));\n"
        "    imageStore(f0, place, blended(imageLoad(f0, place), s.decal_f0));\n"
        "    imageStore(normals, place, blended(imageLoad(normals, place), s.decal_normal));\n"
        "    imageStore(roughness, place, blended(imageLoad(roughness, place), "
        "s.decal_roughness));\n"
        "}\n"};

/* Vertex data of a hit. */
static const char *hit_value(const char *name)
{
    static const char *const values[][2] = {
        {"positionWorld", "point"},
        {"normalWorld", "normal"},
        {"tangentWorld", "tangent"},
        {"viewWorld", "-way"},
        {"positionObject", "local"},
        {"dx_positionWorld", "dx"},
        {"dx_normalWorld", "dx"},
        {"dx_texcoord_0", "unwrapped(local + dx * mat3(OF_OBJECT)) - unwrapped(local)"},
        {"dy_positionWorld", "dy"},
        {"dy_normalWorld", "dy"},
        {"dy_texcoord_0", "unwrapped(local + dy * mat3(OF_OBJECT)) - unwrapped(local)"},
        {"pixel", "at"},
        {"texcoord_0", "unwrapped(local)"}};
    for (size_t i = 0; i < sizeof values / sizeof *values; ++i)
        if (strcmp(values[i][0], name) == 0)
            return values[i][1];
    return NULL;
}

static size_t write_arguments(const mxg_result *result, char *out, size_t room)
{
    size_t len = 0;
    const char *between = "";
    for (uint32_t i = 0; i < mxg_result_num_variables(result) && len < room; ++i) {
        mxg_variable variable = {sizeof variable};
        mxg_result_variable(result, i, &variable);
        if (variable.block != MXG_BLOCK_VERTEX_DATA)
            continue;
        const char *value = hit_value(variable.name);
        if (!REQUIRE(value))
            printf("    a hit has no %s\n", variable.name);
        len += (size_t)snprintf(out + len, room - len, "%s%s", between, value ? value : "vec3(0)");
        between = ", ";
    }
    return len;
}

bool hits_write(const struct bench *b, const mxg_result *result, enum hits hits, char *out,
                size_t room)
{
    size_t len = (size_t)snprintf(out, room, "#version 450\n%s\nconst mat4 OF_OBJECT = mat4(",
                                  mxg_result_source(result, MXG_STAGE_PIXEL, NULL));
    for (size_t i = 0; i < 16 && len < room; ++i)
        len += (size_t)snprintf(out + len, room - len, "%s%.9g", i ? ", " : "",
                                b->scene.object.world.m[i / 4][i % 4]);
    if (len < room)
        len +=
            (size_t)snprintf(out + len, room - len, ");\n%s%s%s", rays, keepers[hits], main_begin);
    if (len < room)
        len += write_arguments(result, out + len, room - len);
    if (len < room)
        len += (size_t)snprintf(out + len, room - len, "));\n}\n");
    return REQUIRE(len < room);
}

bool hits_faces(size_t pixel)
{
    double x = (double)(pixel % SIZE) + 0.5 - SIZE / 2, y = (double)(pixel / SIZE) + 0.5 - SIZE / 2;
    return hypot(x, y) < 0.36 * SIZE;
}
