// SPDX-License-Identifier: Apache-2.0
/*
 * The texts of the passes that belong to no material: numbers that C shares with them, record.glsl,
 * declarations of resources, and files of src/deferred/passes.
 */
#include "deferred/deferred_priv.h"
#include "deferred/texts.h"

#include "base/hash.h"

#include <assert.h>

#define BIT(resource) (1u << RESOURCE_##resource)
enum {
    CLOSURES = BIT(WORDS) | BIT(WORD0) | BIT(WORD1) | BIT(WORD2),
    LIT_FROM = CLOSURES | BIT(DEPTH) | BIT(COLOR) | BIT(TILES) | BIT(FRAME),
    LIT_TO = BIT(LIT) | BIT(SCATTERED) | BIT(BELOW)
};

enum { MAX_TEXTS = 5 };
/* is_part: functions without a main, for passes of the host. */
static const struct {
    const char *name;
    enum deferred_class which; /* of its tiles; CLASS_EMPTY without indirect: all tiles */
    bool is_indirect, is_part;
    uint32_t reads, writes; /* bits of resources; options take some away */
    const char *const *texts[MAX_TEXTS];
} passes[NUM_PASSES] = {
    [PASS_CLASSIFY] = {"classify",
                       CLASS_EMPTY,
                       false,
                       false,
                       BIT(WORD0) | BIT(TILES) | BIT(FRAME),
                       BIT(TILES) | BIT(SCATTERED) | BIT(BELOW),
                       {deferred_frame, deferred_classify}},
    [PASS_COMPOSE] = {"compose",
                      CLASS_EMPTY,
                      true,
                      false,
                      BIT(WORD0) | BIT(COLOR) | BIT(TILES) | BIT(FRAME),
                      BIT(LIT),
                      {deferred_frame, deferred_tile, deferred_compose}},
    [PASS_SIMPLE] = {"light_simple",
                     CLASS_SIMPLE,
                     true,
                     false,
                     LIT_FROM,
                     BIT(LIT),
                     {deferred_read, deferred_frame, deferred_tile, deferred_light}},
    [PASS_SINGLE] = {"light_single",
                     CLASS_SINGLE,
                     true,
                     false,
                     LIT_FROM,
                     BIT(LIT) | BIT(SCATTERED),
                     {deferred_read, deferred_frame, deferred_tile, deferred_light}},
    [PASS_COMPLEX] = {"light_complex",
                      CLASS_COMPLEX,
                      true,
                      false,
                      LIT_FROM,
                      LIT_TO,
                      {deferred_read, deferred_frame, deferred_tile, deferred_light}},
    [PASS_SPECIAL] = {"light_special",
                      CLASS_SPECIAL,
                      true,
                      false,
                      LIT_FROM,
                      LIT_TO,
                      {deferred_read, deferred_frame, deferred_tile, deferred_light}},
    [PASS_DIFFUSE] = {"diffuse",
                      CLASS_EMPTY,
                      false,
                      false,
                      CLOSURES | BIT(DEPTH) | BIT(FRAME) | BIT(SCATTERED),
                      BIT(LIT) | BIT(BELOW),
                      {deferred_read, deferred_frame, deferred_plane, deferred_diffuse}},
    [PASS_BLUR] = {"blur",
                   CLASS_EMPTY,
                   false,
                   false,
                   BIT(DEPTH) | BIT(FRAME) | BIT(BELOW),
                   BIT(LIT),
                   {deferred_frame, deferred_plane, deferred_blur}},
    [PASS_SHOW] = {"show",
                   CLASS_EMPTY,
                   false,
                   false,
                   CLOSURES | BIT(FRAME),
                   BIT(LIT),
                   {deferred_read, deferred_frame, deferred_show}},
    [PASS_LIGHT_RAYS] = {"light_rays",
                         CLASS_COMPLEX,
                         false,
                         false,
                         BIT(PAYLOADS) | BIT(RAYS) | BIT(FRAME),
                         BIT(LIT),
                         {deferred_unpack, deferred_frame, deferred_light_rays}},
    [PASS_READ] = {"read", CLASS_EMPTY, false, true, CLOSURES, 0, {deferred_read}},
    [PASS_OVER] = {"over",
                   CLASS_EMPTY,
                   false,
                   false,
                   CLOSURES | BIT(PAYLOADS) | BIT(FRAME),
                   CLOSURES,
                   {deferred_read, deferred_over_head, deferred_write, deferred_frame,
                    deferred_over}},
};

bool deferred_has_pass(enum deferred_pass pass, const struct deferred_layout *layout)
{
    return pass == PASS_DIFFUSE ? layout->diffuses : pass == PASS_BLUR ? layout->blurs : true;
}

/* The resources that the options leave. */
static uint32_t resources_of(const struct deferred_layout *layout)
{
    return ~((layout->diffuses ? 0 : BIT(SCATTERED)) | (layout->blurs ? 0 : BIT(BELOW)));
}

uint32_t deferred_reads(enum deferred_pass pass, const struct deferred_layout *layout)
{
    assert(pass < NUM_PASSES);
    return passes[pass].reads & resources_of(layout);
}

uint32_t deferred_writes(enum deferred_pass pass, const struct deferred_layout *layout)
{
    assert(pass < NUM_PASSES);
    return passes[pass].writes & resources_of(layout);
}

bool deferred_is_part(enum deferred_pass pass)
{
    assert(pass < NUM_PASSES);
    return passes[pass].is_part;
}

bool deferred_is_indirect(enum deferred_pass pass)
{
    assert(pass < NUM_PASSES);
    return passes[pass].is_indirect;
}

uint32_t deferred_dispatch_offset(enum deferred_pass pass)
{
    return deferred_resource(RESOURCE_TILES)->members[0].array_stride
           * (uint32_t)deferred_pass_class(pass);
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

static const struct {
    const char *name, *macro;
} classes[NUM_CLASSES] = {
#define CLASS(id, name) {name, "MX_" #id},
#include "deferred/classes.def"
#undef CLASS
};

static const char *const view_macros[] = {
#define VIEW(id, name) "MX_SHOW_" #id,
#include "deferred/views.def"
#undef VIEW
};

const char *deferred_element(enum deferred_class which)
{
    assert(which < NUM_CLASSES);
    return classes[which].name;
}

void deferred_write_lines(const char *const *lines, bool is_hosts, struct text *out)
{
    for (; *lines; lines++) {
        bool is_marked = **lines == '@' || **lines == '%';
        if (!is_marked || (**lines == '@') == is_hosts)
            text_str(out, *lines + is_marked);
    }
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

static void define(const char *macro, uint32_t number, struct text *out)
{
    text_fmt(out, "#define %s %u\n", macro, (unsigned)number);
}

void deferred_write_storage(const struct deferred_layout *layout, struct text *out)
{
    define("MX_STORAGE", layout->storage, out);
    define("MX_BLUR", layout->blurs, out);
    define("MX_PAYLOAD_WORDS", DEFERRED_PAYLOAD_WORDS, out);
    for (uint32_t i = 0; i < NUM_CLASSES; i++)
        define(classes[i].macro, i, out);
    deferred_write_struct(out);
    deferred_write_lines(deferred_record, false, out);
}

uint32_t deferred_layout_number(const struct deferred_layout *layout)
{
    uint64_t h = deferred_hash_values(HASH_STABLE_SEED);
    uint32_t storage = (uint32_t)layout->storage | (uint32_t)role_is_of_rays(layout->role) << 8
                       | (uint32_t)layout->diffuses << 9 | (uint32_t)layout->blurs << 10
                       | (uint32_t)layout->has_occlusion << 11;
    for (const char *const *line = deferred_record; *line; line++)
        h = hash_stable(h, *line, strlen(*line));
    for (uint32_t i = 0; i < NUM_CLASSES; i++)
        h = hash_stable(h, classes[i].macro, strlen(classes[i].macro));
    h = hash_stable(h, &storage, sizeof storage);
    return (uint32_t)(h ^ h >> 32);
}

/* Returns what a lighting pass gives a stream of its surface; NULL: the closure has it. */
static const char *stream_value(const char *name)
{
    static const struct {
        const char *name, *value;
    } values[] = {{"positionWorld", "point"},
                  {"normalWorld", "top"},
                  {"viewWorld", "mx_view"},
                  {"geomprop_open", "open"}};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        if (strcmp(values[i].name, name) == 0)
            return values[i].value;
    return NULL;
}

#define EACH_STREAM(i, surface) \
    uint32_t i = (surface)->interface.first_of_block[BLOCK_VERTEX_DATA]; \
    i < (surface)->interface.first_of_block[BLOCK_VERTEX_DATA + 1]; \
    i++

/* mx_fill(): the values of the closure become those that surface() reads, members of `instance`. */
static void write_fill(const struct shader *surface, const char *instance, struct text *out)
{
    static const char prefix[] = "geomprop_";
    text_str(out,
             "// Gives surface() a closure at a point, below a top with this normal and opacity.\n"
             "void mx_fill(MxClosure closure, vec3 point, vec3 top, float open)\n{\n");
    for (EACH_STREAM(i, surface)) {
        const struct shader_variable *v = shader_interface_variable(surface, i);
        const char *name = str_text(surface->strings, v->name), *value = stream_value(name);
        assert(value || strncmp(name, prefix, sizeof prefix - 1) == 0);
        text_fmt(out, "    %s%s = %s%s;\n", instance, name, value ? "" : "closure.",
                 value ? value : name + sizeof prefix - 1);
    }
    text_str(out, "}\n\n");
}

/* Declares the function of the surface, its inputs and its result for a program. */
static void declare_surface(const struct shader *surface, struct text *out)
{
    for (EACH_STREAM(i, surface)) {
        const struct shader_variable *v = shader_interface_variable(surface, i);
        text_fmt(out, "in %s %s;\n", ir_type_text(v->type), str_text(surface->strings, v->name));
    }
    text_str(out, "in vec4 out1;\nvoid surface();\n");
}

/* The numbers that the texts of passes share with C. */
static void write_numbers(enum deferred_pass pass, const struct deferred_layout *layout,
                          struct text *out)
{
    uint32_t used = deferred_reads(pass, layout) | deferred_writes(pass, layout);
    if (passes[pass].is_part)
        return;
    if (pass == PASS_OVER)
        define("MX_WORDS", DEFERRED_TARGET_WORDS + 1, out); /* at least: there is an image */
    define("MX_CLASS", passes[pass].which, out);
    define("MX_NUM_CLASSES", NUM_CLASSES, out);
    define("MX_TILE", DEFERRED_TILE, out);
    define("MX_SCATTERED", (used & BIT(SCATTERED)) != 0, out);
    define("MX_BELOW", (used & BIT(BELOW)) != 0, out);
    for (uint32_t i = 0; pass == PASS_SHOW && i < sizeof view_macros / sizeof *view_macros; i++)
        define(view_macros[i], i, out);
}

static bool has_host_functions(enum deferred_pass pass, const struct shader *surface)
{
    return passes[pass].is_part || pass == PASS_OVER
           || (surface && surface->reflection.host_functions.len);
}

/* The files of a pass, with mx_fill() before the last one. */
static void write_texts(enum deferred_pass pass, const struct deferred_layout *layout,
                        const struct shader *surface, const char *instance, struct text *out)
{
    for (unsigned i = 0; i < MAX_TEXTS && passes[pass].texts[i]; i++) {
        bool is_last = i + 1 == MAX_TEXTS || !passes[pass].texts[i + 1];
        text_str(out, i ? "\n" : "");
        if (surface && is_last)
            write_fill(surface, instance, out);
        deferred_write_lines(passes[pass].texts[i], has_host_functions(pass, surface), out);
        if (passes[pass].texts[i] == deferred_read && layout->storage == STORAGE_FLOAT)
            deferred_write_get(out);
        if (passes[pass].texts[i] == deferred_write && layout->storage == STORAGE_FLOAT)
            deferred_write_put(out);
    }
}

static struct source_resources resources_of_pass(enum deferred_pass pass,
                                                 const struct deferred_layout *layout)
{
    return (struct source_resources){.reads = deferred_reads(pass, layout),
                                     .writes = deferred_writes(pass, layout),
                                     .set = layout->set};
}

void deferred_write_pass(enum deferred_pass pass, const struct deferred_layout *layout,
                         const char *version, const struct shader *surface, const char *source,
                         struct text *out)
{
    const struct source_resources of = resources_of_pass(pass, layout);
    assert((deferred_pass_class(pass) != CLASS_EMPTY) == (surface && source));
    if (surface)
        text_fmt(out, "%s\n", source);
    else if (!passes[pass].is_part)
        text_fmt(out, "#version %s\n", version);
    write_numbers(pass, layout, out);
    deferred_write_storage(layout, out);
    for (uint32_t i = 0; i < NUM_RESOURCES; i++)
        if ((of.reads | of.writes) >> i & 1)
            deferred_declare((enum deferred_binding)i, layout, of.reads >> i & 1,
                             of.writes >> i & 1, out);
    deferred_write_access(of.reads, of.writes, out);
    if (pass == PASS_CLASSIFY)
        deferred_write_lines(deferred_group, false, out);
    write_texts(pass, layout, surface, "vd.", out);
    if (!passes[pass].is_part)
        deferred_write_lines(deferred_main, false, out);
}

void deferred_add_pass(enum deferred_pass pass, const struct deferred_layout *layout,
                       struct shader *shader)
{
    const struct source_resources of = resources_of_pass(pass, layout);
    bool is_lit = deferred_pass_class(pass) != CLASS_EMPTY;
    struct text text, program;
    text_init(&text, shader->arena);
    text_init(&program, shader->arena);
    write_numbers(pass, layout, &text);
    deferred_write_storage(layout, &text);
    if (!passes[pass].is_part) {
        deferred_declare_buffers(&text);
        deferred_write_lines(deferred_buffers, false, &text);
    }
    if (is_lit)
        declare_surface(shader, &text);
    write_texts(pass, layout, is_lit ? shader : NULL, "", &text);
    deferred_make_program(text_cstr(&text), &of, &program);
    uint32_t source =
        shader_add_program(shader, str_intern(shader->strings, program.data, program.len),
                           layout->parse(shader, &program), of);
    shader->sources.pass = (struct source_pass){.program = source + 1,
                                                .lacks_surface = !is_lit,
                                                .runs = !passes[pass].is_part,
                                                .has_group = pass == PASS_CLASSIFY};
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
