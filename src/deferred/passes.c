// SPDX-License-Identifier: Apache-2.0
/* The texts of the passes that belong to no material, from the files of src/deferred/passes. */
#include "deferred/deferred_priv.h"
#include "deferred/texts.h"

#include "base/hash.h"

#include <assert.h>

/* The resources, by binding. Materials write the first one. */
static const struct {
    const char *macro; /* of its place, in the texts */
    struct deferred_resource about;
} resources[] = {
    {"MX_STORED_IMAGE",
     {"words", "image2DArray", "r32ui", "word 3 and the following ones, one per layer"}},
    {"MX_WORD_0", {"word0", "image2D", "r32ui", "target 1 of material passes, cleared to 0"}},
    {"MX_WORD_1", {"word1", "image2D", "r32ui", "target 2 of material passes"}},
    {"MX_WORD_2", {"word2", "image2D", "r32ui", "target 3 of material passes"}},
    {"MX_DEPTH", {"depth", "sampler2D", "", "depth of the material passes, as stored"}},
    {"MX_COLOR", {"color", "sampler2D", "", "target 0 of material passes: light of surfaces"}},
    {"MX_LIT", {"lit", "image2D", "", "the picture: any format of floats"}},
    {"MX_TILES",
     {"tiles", "buffer", "std430",
      "five commands of dispatches, (0, 1, 1, 0) at first, by class; then room for the number of "
      "every tile, five times"}},
    {"MX_FRAME",
     {"frame", "uniform", "std140",
      "mat4 from (x, y, depth, 1) in pixels to the world; uvec4 width, height, tiles in a row, "
      "tiles; uvec4 debug view, 0, 0, 0"}},
    {"MX_PAYLOADS", {"payloads", "buffer", "std430", "16 words for each pixel, row by row"}},
    {"MX_RAYS",
     {"rays", "buffer", "std430",
      "vec4 point and vec4 direction back along the ray, in the world, for each pixel"}},
    {"MX_SCATTERED",
     {"scattered", "image2DArray", "rgba16f",
      "two layers, with --sss diffusion: light that enters bodies over their albedo, and other "
      "light of the same pixels"}},
    {"MX_BELOW",
     {"below", "image2DArray", "rgba16f",
      "two layers, with --rough-refraction blur: light from below rough interfaces with the width "
      "of its blur, and other light of the same pixels"}},
};
#define NUM_RESOURCES (sizeof resources / sizeof *resources)
enum { SCATTERED = NUM_RESOURCES - 2, BELOW }; /* those that depend on options */

static const struct {
    const char *name;
    enum deferred_class which; /* of its tiles; CLASS_EMPTY without indirect: all tiles */
    bool is_indirect;
    const char *const *text;
    uint32_t reads; /* bits of resources */
} passes[NUM_PASSES] = {
    [PASS_CLASSIFY] = {"classify", CLASS_EMPTY, false, deferred_classify, 0x1982},
    [PASS_COMPOSE] = {"compose", CLASS_EMPTY, true, deferred_compose, 0x1e2},
    [PASS_SIMPLE] = {"light_simple", CLASS_SIMPLE, true, deferred_light, 0x1ff},
    [PASS_SINGLE] = {"light_single", CLASS_SINGLE, true, deferred_light, 0x9ff},
    [PASS_COMPLEX] = {"light_complex", CLASS_COMPLEX, true, deferred_light, 0x19ff},
    [PASS_SPECIAL] = {"light_special", CLASS_SPECIAL, true, deferred_light, 0x19ff},
    [PASS_DIFFUSE] = {"diffuse", CLASS_EMPTY, false, deferred_diffuse, 0x195f},
    [PASS_BLUR] = {"blur", CLASS_EMPTY, false, deferred_blur, 0x1150},
    [PASS_SHOW] = {"show", CLASS_EMPTY, false, deferred_show, 0x14f},
    [PASS_LIGHT_RAYS] = {"light_rays", CLASS_COMPLEX, false, deferred_light_rays, 0x740},
};

bool deferred_resource(uint32_t index, struct deferred_resource *out)
{
    if (index < NUM_RESOURCES)
        *out = resources[index].about;
    return index < NUM_RESOURCES;
}

/* Options turn these on. */
static bool has_resource(const struct deferred_layout *layout, uint32_t resource)
{
    return resource == SCATTERED ? layout->diffuses : resource == BELOW ? layout->blurs : true;
}

static bool has_pass(const struct deferred_layout *layout, enum deferred_pass pass)
{
    return pass == PASS_DIFFUSE ? layout->diffuses : pass == PASS_BLUR ? layout->blurs : true;
}

bool deferred_reads(enum deferred_pass pass, const struct deferred_layout *layout,
                    uint32_t resource)
{
    assert(pass < NUM_PASSES && resource < NUM_RESOURCES);
    return passes[pass].reads >> resource & 1 && has_resource(layout, resource)
           && has_pass(layout, pass);
}

bool deferred_is_indirect(enum deferred_pass pass)
{
    assert(pass < NUM_PASSES);
    return passes[pass].is_indirect;
}

const char *deferred_pass_name(enum deferred_pass pass)
{
    assert(pass < NUM_PASSES);
    return passes[pass].name;
}

enum deferred_class deferred_pass_class(enum deferred_pass pass)
{
    assert(pass < NUM_PASSES);
    return passes[pass].which;
}

const char *deferred_element(enum deferred_class which)
{
    static const char *const elements[NUM_CLASSES] = {"empty", "simple", "single", "complex",
                                                      "special"};
    assert(which < NUM_CLASSES);
    return elements[which];
}

void deferred_write_lines(const char *const *lines, struct text *out)
{
    for (; *lines; lines++)
        text_str(out, *lines);
}

size_t deferred_closures_size(void)
{
    size_t size = 0;
    for (const char *const *line = deferred_closures; *line; line++)
        size += strlen(*line);
    return size;
}

void deferred_copy_closures(char *out)
{
    for (const char *const *line = deferred_closures; *line; line++) {
        size_t len = strlen(*line);
        memcpy(out, *line, len);
        out += len;
    }
}

void deferred_write_storage(const struct deferred_layout *layout, struct text *out)
{
    text_fmt(out, "#define MX_STORAGE %u\n#define MX_BLUR %d\n", (unsigned)layout->storage,
             layout->blurs);
    for (unsigned i = 0; i < NUM_RESOURCES; i++) {
        text_fmt(out, "#define %s ", resources[i].macro);
        if (layout->sets)
            text_fmt(out, "set = %u, ", (unsigned)layout->set);
        text_fmt(out, "binding = %u\n", i);
    }
    deferred_write_lines(deferred_record, out);
}

uint32_t deferred_layout_number(const struct deferred_layout *layout)
{
    uint64_t h = HASH_STABLE_SEED;
    uint32_t storage = (uint32_t)layout->storage | (uint32_t)layout->is_payload << 8
                       | (uint32_t)layout->diffuses << 9 | (uint32_t)layout->blurs << 10;
    for (const char *const *line = deferred_record; *line; line++)
        h = hash_stable(h, *line, strlen(*line));
    h = hash_stable(h, &storage, sizeof storage);
    return (uint32_t)(h ^ h >> 32);
}

/* What a lighting pass gives a stream of its surface; NULL: the closure has it. */
static const char *stream_value(const char *name)
{
    static const struct {
        const char *name, *value;
    } values[] = {{"positionWorld", "point"}, {"normalWorld", "top"}, {"viewWorld", "mx_view"}};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        if (strcmp(values[i].name, name) == 0)
            return values[i].value;
    return NULL;
}

/* mx_fill(): the values of the closure become those that surface() reads. */
static void write_fill(const struct shader *surface, struct text *out)
{
    static const char prefix[] = "geomprop_";
    text_str(out, "void mx_fill(MxClosure closure, vec3 point, vec3 top)\n{\n");
    for (uint32_t i = surface->first_of_block[BLOCK_VERTEX_DATA];
         i < surface->first_of_block[BLOCK_VERTEX_DATA + 1]; i++) {
        const struct shader_variable *v = &surface->variables.items[surface->interface.items[i]];
        const char *name = str_text(surface->strings, v->name), *value = stream_value(name);
        assert(value || strncmp(name, prefix, sizeof prefix - 1) == 0);
        text_fmt(out, "    vd.%s = %s%s;\n", name, value ? "" : "closure.",
                 value ? value : name + sizeof prefix - 1);
    }
    text_str(out, "}\n\n");
}

void deferred_write_pass(enum deferred_pass pass, const struct deferred_layout *layout,
                         const char *version, const struct shader *surface, const char *source,
                         struct text *out)
{
    enum deferred_class which = deferred_pass_class(pass);
    assert((which != CLASS_EMPTY) == (surface && source));
    if (surface)
        text_fmt(out, "%s\n#define MX_CLASS %u\n", source, (unsigned)which);
    else
        text_fmt(out, "#version %s\n", version);
    /* only the pass that makes the lists writes them */
    text_fmt(out, "#define MX_SSS %d\n", layout->diffuses);
    text_fmt(out, "#define MX_TILES_ACCESS %s\n", pass == PASS_CLASSIFY ? "" : "readonly");
    deferred_write_storage(layout, out);
    deferred_write_lines(pass == PASS_LIGHT_RAYS ? deferred_unpack : deferred_read, out);
    deferred_write_lines(deferred_frame, out);
    if ((pass == PASS_DIFFUSE || pass == PASS_BLUR) && has_pass(layout, pass))
        deferred_write_lines(deferred_plane, out);
    if (surface)
        write_fill(surface, out);
    deferred_write_lines(passes[pass].text, out);
}

/* ---- lighting ---- */

static ir_ref stored(struct shader *shader, const char *name, ir_type_id type)
{
    return shader_stream(shader, str_intern_z(shader->strings, name), type);
}

struct closure_above deferred_above(struct shader *shader)
{
    struct closure_above above;
    above.steady = stored(shader, "geomprop_steady", IR_TYPE_VEC3);
    above.color = stored(shader, "geomprop_color", IR_TYPE_VEC3);
    above.decay = stored(shader, "geomprop_decay", IR_TYPE_VEC3);
    above.spreads = stored(shader, "geomprop_spreads", IR_TYPE_FLOAT);
    return above;
}
