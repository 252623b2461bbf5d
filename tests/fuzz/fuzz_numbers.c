// SPDX-License-Identifier: Apache-2.0
/*
 * Numbers through the whole compiler: a node of the library whose inputs have the floats that the
 * bytes are, as infinite, tiny or undefined as they come, for a target and an interface that the
 * first bytes choose. What is folded, specialised and printed must be numbers that the target's
 * language can read.
 */
#include "files.h"

#include "base/num.h"
#include "base/scan.h"
#include "base/text.h"

#include <math.h>
#include <string.h>

static const char *const targets[] = {"glsl", "vulkan", "essl", "hlsl", "osl", "essl310"};
static const char *const interfaces[] = {"reduced", "authored", "complete"};

/* ---- The bytes ---- */

struct bytes {
    const char *data;
    size_t size, at;
};

static unsigned next_byte(struct bytes *bytes)
{
    return bytes->at < bytes->size ? (unsigned char)bytes->data[bytes->at++] : 0;
}

/* A number where numbers are at risk, or any bits. */
static float next_float(struct bytes *bytes)
{
    static const float risky[] = {
        0.0f,          -0.0f,          1.0f,          -1.0f,         0.5f,   INFINITY, -INFINITY,
        NAN,           3.402823e38f,   -3.402823e38f, 1.175494e-38f, 1e-45f, -1e-45f,  16777217.0f,
        2147483648.0f, -2147483649.0f, 4294967296.0f, 0.99999994f,   1e19f,  88.72284f};
    enum { NUM = sizeof risky / sizeof *risky };
    unsigned choice = next_byte(bytes);
    if (choice < 8 * NUM)
        return risky[choice % NUM];
    unsigned char bits[sizeof(float)];
    for (size_t i = 0; i < sizeof bits; i++)
        bits[i] = (unsigned char)next_byte(bytes);
    float value;
    memcpy(&value, bits, sizeof value);
    return value;
}

/* ---- The document ---- */

/* How many floats a value of the type has; 0: it has none. */
static unsigned num_floats(const char *type)
{
    static const struct {
        const char *type;
        unsigned count;
    } types[] = {{"float", 1},  {"vector2", 2}, {"vector3", 3},  {"vector4", 4},
                 {"color3", 3}, {"color4", 4},  {"matrix33", 9}, {"matrix44", 16}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (strcmp(types[i].type, type) == 0)
            return types[i].count;
    return 0;
}

static void write_value(struct text *text, struct bytes *bytes, const char *type)
{
    for (unsigned i = 0; i < num_floats(type); i++) {
        char number[NUM_FLOAT_MAX];
        float value = next_float(bytes);
        text_str(text, i ? ", " : "");
        if (isfinite(value))
            text_mem(text, number, num_print_float(number, value));
        else /* documents have infinities only, as numbers beyond the range */
            text_str(text, signbit(value) ? "-1e39" : "1e39");
    }
    if (strcmp(type, "integer") == 0) {
        uint32_t bits = 0;
        for (unsigned i = 0; i < sizeof bits; i++)
            bits = bits << 8 | next_byte(bytes);
        text_fmt(text, "%d", (int)bits);
    }
    if (strcmp(type, "boolean") == 0)
        text_str(text, next_byte(bytes) & 1 ? "true" : "false");
}

static void write_input(struct text *text, struct bytes *bytes, const mxg_port *port)
{
    bool is_integer = !strcmp(port->type, "integer") || !strcmp(port->type, "boolean");
    if (!num_floats(port->type) && !is_integer)
        return;
    text_fmt(text, "<input name='%s' type='%s' value='", port->name, port->type);
    write_value(text, bytes, port->type);
    text_str(text, "'/>");
}

/* A node that draws the first output of the node. */
static void write_use(struct text *text, const char *type)
{
    bool is_bsdf = strcmp(type, "BSDF") == 0, is_edf = strcmp(type, "EDF") == 0;
    if (is_bsdf || is_edf)
        text_fmt(text,
                 "<surface name='s' type='surfaceshader'><input name='%s' type='%s' nodename='n'/>"
                 "</surface>",
                 is_bsdf ? "bsdf" : "edf", type);
    else
        text_fmt(text, "<output name='o' type='%s' nodename='n'/>", type);
}

static void write_document(struct text *text, struct bytes *bytes, const mxg_library *library,
                           uint32_t id)
{
    mxg_nodedef def = {sizeof def};
    mxg_port port = {sizeof port};
    FUZZ_REQUIRE(mxg_library_nodedef(library, id, &def) == MXG_OK);
    FUZZ_REQUIRE(mxg_library_port(library, id, def.num_inputs, &port) == MXG_OK);
    char type[64];
    snprintf(type, sizeof type, "%s", port.type);
    text_fmt(text, "<materialx version='1.39'><%s name='n' type='%s' nodedef='%s'>", def.node,
             def.num_outputs > 1 ? "multioutput" : type, def.name);
    for (uint32_t i = 0; i < def.num_inputs; i++) {
        FUZZ_REQUIRE(mxg_library_port(library, id, i, &port) == MXG_OK);
        write_input(text, bytes, &port);
    }
    text_fmt(text, "</%s>", def.node);
    write_use(text, type);
    text_str(text, "</materialx>");
}

/* ---- The source ---- */

static void check_number(const struct scan_word *word)
{
    char copy[64];
    FUZZ_REQUIRE(word->len < sizeof copy);
    memcpy(copy, word->text, word->len);
    copy[word->len] = '\0';
    bool is_infinity = strcmp(copy, "1e39") == 0; /* docs/ir.md has the spellings */
    bool is_readable = is_infinity || strchr(copy, 'x') || isfinite(strtof(copy, NULL));
    if (!is_readable)
        fprintf(stderr, "no number: %s\n", copy);
    FUZZ_REQUIRE(is_readable);
}

/* No language has a word for an infinite or undefined number. */
static void check_source(const char *source)
{
    static const char *const wrong[] = {"nan", "inf", "NaN", "INF", "infinity", "Infinity"};
    struct scan scan;
    struct scan_word word;
    scan_begin(&scan, source, strlen(source));
    while (scan_next(&scan, &word)) {
        if (word.kind == SCAN_NUMBER)
            check_number(&word);
        for (size_t i = 0; i < sizeof wrong / sizeof *wrong && word.kind == SCAN_NAME; i++)
            FUZZ_REQUIRE(!scan_is(&word, wrong[i]));
    }
}

static void generate(mxg_context *context, const mxg_document *document, unsigned choice)
{
    mxg_options *options = NULL;
    mxg_result *result = NULL;
    if (mxg_options_create(context, &options) == MXG_OK)
        mxg_options_set(options, "interface", interfaces[choice / 8 % 3]);
    mxg_generate_desc desc = {sizeof desc, targets[choice % 6], NULL, options};
    mxg_status status = mxg_generate(context, document, &desc, &result);
    FUZZ_REQUIRE(status == MXG_OK || status == MXG_ERROR_DOCUMENT || status == MXG_ERROR_MEMORY);
    for (int stage = 0; stage < MXG_NUM_STAGES; stage++) {
        const char *source = mxg_result_source(result, (mxg_stage)stage, NULL);
        if (source)
            check_source(source);
    }
    mxg_result_destroy(result);
    mxg_options_destroy(options);
}

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    struct fuzz_files none = {.num = 0};
    mxg_context *context = fuzz_files_context(&none, heap, (mxg_context_desc){.max_memory = 0});
    if (!context)
        return;
    struct bytes bytes = {data, size, 0};
    unsigned choice = next_byte(&bytes), high = next_byte(&bytes), low = next_byte(&bytes);
    mxg_library *library = mxg_library_builtin(context);
    struct mem mem; /* of this test, which never fails */
    struct arena arena;
    struct text text;
    mem_init(&mem, NULL, NULL);
    arena_init(&arena, &mem);
    text_init(&text, &arena);
    write_document(&text, &bytes, library, (high << 8 | low) % mxg_library_num_nodedefs(library));
    mxg_document *document = NULL;
    if (mxg_document_parse(context, library, "n.mtlx", text.data, text.len, &document) == MXG_OK)
        generate(context, document, choice);
    arena_finish(&arena);
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
}
