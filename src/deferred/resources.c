// SPDX-License-Identifier: Apache-2.0
/*
 * The images and buffers that the passes share: what reflection says about them, and their
 * declarations in the texts.
 */
#include "deferred/deferred_priv.h"

#include <assert.h>
#include <ctype.h>

enum { WORD = 4, COMMAND = 4 * WORD }; /* bytes of a uint and of a command of a dispatch */

/* "|classes|bytes…" */
static const char views[] =
#define VIEW(id, name) "|" name
#include "deferred/views.def"
#undef VIEW
    ;

static const struct deferred_member tiles[] = {
    {.name = "mx_dispatch",
     .type = "uvec4",
     .array_length = NUM_CLASSES,
     .array_stride = COMMAND,
     .doc = "a command of an indirect dispatch for each class, (0, 1, 1, 0) at first"},
    {.name = "mx_tile",
     .type = "uint",
     .offset = NUM_CLASSES * COMMAND,
     .array_length = NUM_CLASSES,
     .array_stride = WORD,
     .per = "tile",
     .doc = "lists of tiles by class, one after the other, with room for all tiles in each"},
};

static const struct deferred_member frame[] = {
    {.name = "mx_to_world",
     .type = "mat4",
     .matrix_stride = 16,
     .doc = "from (x, y, depth, 1) in pixels, depth as stored, to the world, times w"},
    {.name = "mx_size", .type = "uvec2", .offset = 64, .doc = "width and height of the picture"},
    {.name = "mx_tiles_per_row",
     .type = "uint",
     .offset = 72,
     .doc = "tiles of 8x8 pixels beside each other"},
    {.name = "mx_num_tiles", .type = "uint", .offset = 76, .doc = "all tiles of the picture"},
    {.name = "mx_show",
     .type = "uint",
     .offset = 80,
     .values = views + 1,
     .doc = "what the pass 'show' draws"},
};

static const struct deferred_member payloads[] = {
    {.name = "mx_payloads",
     .type = "MxPayload",
     .array_length = 1,
     .array_stride = DEFERRED_PAYLOAD_WORDS * WORD,
     .per = "pixel",
     .doc = "row by row"},
    {.name = "words",
     .type = "uint",
     .array_length = DEFERRED_PAYLOAD_WORDS,
     .array_stride = WORD,
     .doc = "as the function of a payload gives them",
     .is_nested = true},
};

static const struct deferred_member rays[] = {
    {.name = "mx_rays",
     .type = "MxRay",
     .array_length = 1,
     .array_stride = 32,
     .per = "pixel",
     .doc = "row by row"},
    {.name = "point",
     .type = "vec4",
     .doc = "where the ray hits, in the world; w is not read",
     .is_nested = true},
    {.name = "view",
     .type = "vec4",
     .offset = 16,
     .doc = "unit direction back along the ray, in the world; w is not read",
     .is_nested = true},
};

#define DECAL_IMAGE(parameter, what) \
    { \
        .name = "decal_" parameter, .kind = "sampler2D", .format = "", \
        .doc = "with the option 'decals' images: " what "; alpha is what they leave of the base" \
    }
#define MEMBERS(list) .members = list, .num_members = sizeof(list) / sizeof *(list)

static const struct deferred_resource resources[NUM_RESOURCES] = {
    [RESOURCE_WORDS] = {.name = "words",
                        .kind = "image2DArray",
                        .format = "r32ui",
                        .doc = "word 3 and the following ones, one per layer"},
    [RESOURCE_WORD0] = {.name = "word0",
                        .kind = "image2D",
                        .format = "r32ui",
                        .doc = "target 1 of material passes, cleared to 0"},
    [RESOURCE_WORD1] = {.name = "word1",
                        .kind = "image2D",
                        .format = "r32ui",
                        .doc = "target 2 of material passes"},
    [RESOURCE_WORD2] = {.name = "word2",
                        .kind = "image2D",
                        .format = "r32ui",
                        .doc = "target 3 of material passes"},
    [RESOURCE_DEPTH] = {.name = "depth",
                        .kind = "sampler2D",
                        .format = "",
                        .doc = "depth of the material passes, as stored"},
    [RESOURCE_COLOR] = {.name = "color",
                        .kind = "sampler2D",
                        .format = "",
                        .doc = "target 0 of material passes: light of surfaces; with the option "
                               "'occlusion-map' alpha is the part of the environment that arrives"},
    [RESOURCE_LIT] = {.name = "lit",
                      .kind = "image2D",
                      .format = DEFERRED_ANY_FORMAT,
                      .doc = "the picture"},
    [RESOURCE_TILES] = {.name = "tiles",
                        .kind = "buffer",
                        .format = "std430",
                        .size = NUM_CLASSES * COMMAND,
                        MEMBERS(tiles),
                        .doc = "the tiles of 8x8 pixels of each class"},
    [RESOURCE_FRAME] = {.name = "frame",
                        .kind = "uniform",
                        .format = "std140",
                        .size = 96,
                        MEMBERS(frame),
                        .doc = "what all passes know of the picture"},
    [RESOURCE_PAYLOADS] = {.name = "payloads",
                           .kind = "buffer",
                           .format = "std430",
                           MEMBERS(payloads),
                           .doc = "a payload of a ray for each pixel"},
    [RESOURCE_RAYS] = {.name = "rays",
                       .kind = "buffer",
                       .format = "std430",
                       MEMBERS(rays),
                       .doc = "a ray for each pixel"},
    [RESOURCE_SCATTERED] =
        {.name = "scattered",
         .kind = "image2DArray",
         .format = "rgba16f",
         .layers = 2,
         .doc = "with the option 'sss' diffusion: light that enters bodies over their "
                "albedo, and other light of the same pixels"},
    [RESOURCE_BELOW] =
        {.name = "below",
         .kind = "image2DArray",
         .format = "rgba16f",
         .layers = 2,
         .doc = "with the option 'rough-refraction' blur: light from below rough interfaces "
                "with the width of its blur, and other light of the same pixels"},
    [RESOURCE_DECAL_ALBEDO] = DECAL_IMAGE("albedo", "diffuse albedo of decals"),
    [RESOURCE_DECAL_F0] = DECAL_IMAGE("f0", "f0 of decals"),
    [RESOURCE_DECAL_NORMAL] =
        DECAL_IMAGE("normal", "normals of decals in the world, -1 to 1 as 0 to 1"),
    [RESOURCE_DECAL_ROUGHNESS] = DECAL_IMAGE("roughness", "roughness of decals in red"),
};

const struct deferred_resource *deferred_resource(enum deferred_binding binding)
{
    assert(binding < NUM_RESOURCES);
    return &resources[binding];
}

/* ---- Declarations ---- */

static void write_member(const struct deferred_member *m, struct text *out)
{
    text_fmt(out, "    %s %s", m->type, m->name);
    if (m->array_length && m->per)
        text_str(out, "[]");
    else if (m->array_length)
        text_fmt(out, "[%u]", (unsigned)m->array_length);
    text_str(out, ";\n");
}

static void write_members(const struct deferred_resource *r, bool are_nested, struct text *out)
{
    for (uint32_t i = 0; i < r->num_members; i++)
        if (r->members[i].is_nested == are_nested)
            write_member(&r->members[i], out);
}

/* The struct of the elements of a buffer, if these are structs. */
static void write_element(const struct deferred_resource *r, struct text *out)
{
    if (r->num_members < 2 || !r->members[1].is_nested)
        return;
    text_fmt(out, "struct %s\n{\n", r->members[0].type);
    write_members(r, true, out);
    text_str(out, "};\n");
}

static void write_place(enum deferred_binding binding, const struct deferred_layout *layout,
                        struct text *out)
{
    const char *format = resources[binding].format;
    text_str(out, "layout(");
    if (layout->sets)
        text_fmt(out, "set = %u, ", (unsigned)layout->set);
    text_fmt(out, "binding = %u", (unsigned)binding);
    if (*format && strcmp(format, DEFERRED_ANY_FORMAT) != 0)
        text_fmt(out, ", %s", format);
    text_str(out, ") ");
}

static void declare_buffer(const struct deferred_resource *r, const char *access, struct text *out)
{
    bool is_uniform = strcmp(r->kind, "uniform") == 0;
    text_fmt(out, "%s%s Mx%c%s\n{\n", is_uniform ? "" : access, r->kind,
             toupper((unsigned char)r->name[0]), r->name + 1);
    write_members(r, false, out);
    text_str(out, "};\n");
}

void deferred_declare_buffers(struct text *out)
{
    for (uint32_t i = 0; i < NUM_RESOURCES; i++) {
        const struct deferred_resource *r = &resources[i];
        bool is_uniform = strcmp(r->kind, "uniform") == 0;
        write_element(r, out);
        for (uint32_t k = 0; is_uniform && k < r->num_members; k++)
            text_fmt(out, "uniform %s %s;\n", r->members[k].type, r->members[k].name);
        if (r->num_members && !is_uniform)
            text_fmt(out,
                     "uint mx_%s_load(uint at);\nvoid mx_%s_store(uint at, uint value);\n"
                     "uint mx_%s_add(uint at, uint value);\n",
                     r->name, r->name, r->name);
    }
    text_fmt(out, "#define MX_FIRST_TILE %u\n", (unsigned)tiles[1].offset / WORD);
}

void deferred_declare(enum deferred_binding binding, const struct deferred_layout *layout,
                      bool reads, bool writes, struct text *out)
{
    const struct deferred_resource *r = deferred_resource(binding);
    const char *access = !writes ? "readonly " : !reads ? "writeonly " : "";
    assert(reads || writes);
    write_element(r, out);
    write_place(binding, layout, out);
    if (r->num_members)
        declare_buffer(r, access, out);
    else if (strcmp(r->kind, "sampler2D") == 0)
        text_fmt(out, "uniform %s mx_%s;\n", r->kind, r->name);
    else
        text_fmt(out, "uniform %srestrict %s%s mx_%s;\n", access,
                 strcmp(r->format, "r32ui") == 0 ? "u" : "", r->kind, r->name);
}

/* Passes call these to read and to write a buffer; passes/buffers.glsl has them for programs. */
static const char *const readers[NUM_RESOURCES] = {
    [RESOURCE_TILES] = "// The tile number i of the list of the pass.\nuint mx_tile_at(uint "
                       "i)\n{\n    return mx_tile[i];\n}\n",
    [RESOURCE_PAYLOADS] = "MxPayload mx_payload_at(uint i)\n{\n    return mx_payloads[i];\n}\n",
    [RESOURCE_RAYS] = "MxRay mx_ray_at(uint i)\n{\n    return mx_rays[i];\n}\n",
};
static const char *const writers[NUM_RESOURCES] = {
    [RESOURCE_TILES] = "void mx_add_tile(uint class_, uint tile)\n{\n"
                       "    mx_tile[class_ * mx_num_tiles + atomicAdd(mx_dispatch[class_].x, 1u)] "
                       "= tile;\n}\n",
};

void deferred_write_access(uint32_t reads, uint32_t writes, struct text *out)
{
    for (uint32_t i = 0; i < NUM_RESOURCES; i++) {
        text_str(out, reads >> i & 1 && readers[i] ? readers[i] : "");
        text_str(out, writes >> i & 1 && writers[i] ? writers[i] : "");
    }
}
