// SPDX-License-Identifier: Apache-2.0
/*
 * A whole shader of standard_surface in a language that is no GLSL (toy.c), from the document to
 * the text. With a folder as argument, the texts are written there.
 */
#include <mxgen/mxgen.h>

#include "unit/test.h"

#include <ctype.h>
#include <stdlib.h>

static const char document[] =
    "<materialx version='1.39'><nodegraph name='NG'>"
    "<image name='image' type='color3'><input name='file' type='filename' value='a.png'/></image>"
    "<fractal3d name='dust' type='float'/><noise2d name='grain' type='color3'/>"
    "<fractal3d name='veins' type='color3'/>"
    "<add name='base' type='color3'><input name='in1' type='color3' nodename='image'/>"
    "<input name='in2' type='color3' nodename='grain'/></add>"
    "<add name='both' type='color3'><input name='in1' type='color3' nodename='base'/>"
    "<input name='in2' type='color3' nodename='veins'/></add>"
    "<output name='color' type='color3' nodename='both'/>"
    "<output name='dusty' type='float' nodename='dust'/></nodegraph>"
    "<standard_surface name='SR' type='surfaceshader'>"
    "<input name='base_color' type='color3' nodegraph='NG' output='color'/>"
    "<input name='specular_roughness' type='float' nodegraph='NG' output='dusty'/>"
    "<input name='thin_walled' type='boolean' value='false'/></standard_surface>"
    "<surfacematerial name='M' type='material'>"
    "<input name='surfaceshader' type='surfaceshader' "
    "nodename='SR'/></surfacematerial></materialx>";

/* ---- Words of a text ---- */

struct word {
    const char *text;
    size_t len;
};

static bool is_part(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

/* The next word from *at on, without comments; no length: there is none. */
static struct word next_word(const char **at)
{
    const char *p = *at;
    while (*p && !is_part(*p)) {
        const char *end = p[0] == '/' && p[1] == '/' ? strchr(p, '\n') : NULL;
        p = end ? end : p + 1;
    }
    struct word word = {p, 0};
    while (is_part(p[word.len]))
        word.len++;
    *at = p + word.len;
    return word;
}

static bool is_word(struct word word, const char *text)
{
    return word.len == strlen(text) && memcmp(word.text, text, word.len) == 0;
}

static bool is_any(struct word word, const char *const *words)
{
    while (*words && !is_word(word, *words))
        words++;
    return *words != NULL;
}

static unsigned count(const char *text, const char *part)
{
    unsigned n = 0;
    for (const char *p = text; (p = strstr(p, part)); p += strlen(part))
        n++;
    return n;
}

/* ---- Properties of the text ---- */

static const char *const toy_types[] = {"flag",    "i32",     "u32",     "f32",
                                        "f32x2",   "f32x3",   "f32x4",   "f32x3x3",
                                        "f32x4x4", "texture", "sampler", NULL};
static const char *const glsl_words[] = {
    "bool",  "int",  "uint", "float", "vec2",   "vec3",    "vec4",      "mat3",      "mat4",
    "ivec2", "void", "out",  "inout", "layout", "uniform", "sampler2D", "texture2D", NULL};

/* No type stands before a name, and no word of GLSL is left. */
static void check_words(const char *text)
{
    unsigned faults = 0, types = 0;
    struct word word;
    for (const char *at = text; (word = next_word(&at)).len;) {
        bool is_type = is_any(word, toy_types);
        types += is_type;
        bool is_declared = is_type && at[0] == ' ' && is_part(at[1]);
        if (!is_declared && !is_any(word, glsl_words))
            continue;
        printf("    %.60s\n", word.text);
        faults++;
    }
    REQUIRE_EQ(faults, 0);
    REQUIRE(types > 50);
}

/* Functions have names of their own; of some, the source has several. */
static void check_functions(const char *text)
{
    unsigned functions = 0, twice = 0, numbered = 0;
    for (const char *p = text; (p = strstr(p, "\nfn ")); functions++) {
        p += strlen("\nfn ");
        size_t len = strcspn(p, "(");
        numbered += len > 2 && p[len - 2] == '_' && isdigit((unsigned char)p[len - 1]);
        for (const char *other = p; (other = strstr(other, "\nfn "));) {
            other += strlen("\nfn ");
            twice += strcspn(other, "(") == len && memcmp(other, p, len) == 0;
        }
    }
    REQUIRE_EQ(twice, 0);
    REQUIRE(functions > 10);
    REQUIRE(numbered > 0);
}

/* Results return through pointers: each has an address at its calls, and is read through. */
static void check_pointers(const char *text)
{
    REQUIRE(count(text, ": ptr<f32") > 0);
    REQUIRE(count(text, "(&") + count(text, ", &") > 0);
    REQUIRE(count(text, "(*") > 0);
}

/* Blocks have no booleans. */
static void check_blocks(const char *text)
{
    unsigned blocks = 0, flags = 0;
    for (const char *p = text; (p = strstr(p, " block ")); blocks++) {
        const char *end = strstr(p, "\n}"), *flag = strstr(p, ": flag");
        flags += flag && flag < end;
        p = end;
    }
    REQUIRE_EQ(blocks, 3);
    REQUIRE_EQ(flags, 0);
    REQUIRE(strstr(text, "thin_walled: u32,") != NULL);
    REQUIRE(count(text, "thin_walled != 0u") == count(text, "thin_walled") - 1);
}

static void check_balance(const char *text)
{
    int braces = 0, lowest = 0;
    for (const char *p = text; *p; p++) {
        braces += *p == '{' ? 1 : *p == '}' ? -1 : 0;
        lowest = braces < lowest ? braces : lowest;
    }
    REQUIRE_EQ(braces, 0);
    REQUIRE_EQ(lowest, 0);
    REQUIRE(!strchr(text, '$'));
}

/* ---- Reflection ---- */

static void check_textures(const mxg_result *result, const char *text)
{
    unsigned textures = 0;
    uint64_t taken = 7; /* of the blocks */
    for (uint32_t i = 0; i < mxg_result_num_variables(result); i++) {
        mxg_variable v = {sizeof v};
        REQUIRE(mxg_result_variable(result, i, &v) == MXG_OK);
        if (strstr(v.name, "thin_walled"))
            REQUIRE_STR(v.type, "u32");
        if (v.block != MXG_BLOCK_TEXTURES)
            continue;
        char line[256];
        (void)snprintf(line, sizeof line,
                       "@%u shared %s: texture;\n@%u shared %s_sampler: sampler;\n", v.binding,
                       v.name, v.sampler_binding, v.name);
        REQUIRE(strstr(text, line) != NULL);
        REQUIRE(!(taken >> v.binding & 1) && !(taken >> v.sampler_binding & 1));
        REQUIRE(v.binding != v.sampler_binding);
        taken |= 1ull << v.binding | 1ull << v.sampler_binding;
        textures++;
    }
    REQUIRE_EQ(textures, 3); /* the image, and two of the environment */
    const char *json = mxg_result_reflection_json(result, NULL);
    REQUIRE_EQ(count(json, "\"samplerBinding\""), 3);
}

static void write_file(const char *folder, const char *name, const char *text)
{
    char path[512];
    (void)snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    if (file) {
        fputs(text, file);
        fclose(file);
    }
}

int main(int argc, char **argv)
{
    mxg_context *context = NULL;
    mxg_document *doc = NULL;
    mxg_result *result = NULL;
    REQUIRE(mxg_context_create(NULL, &context) == MXG_OK);
    mxg_library *library = mxg_library_builtin(context);
    REQUIRE(mxg_document_parse(context, library, "toy.mtlx", document, sizeof document - 1, &doc)
            == MXG_OK);
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "toy";
    if (REQUIRE(mxg_generate(context, doc, &desc, &result) == MXG_OK)) {
        const char *pixel = mxg_result_source(result, MXG_STAGE_PIXEL, NULL),
                   *vertex = mxg_result_source(result, MXG_STAGE_VERTEX, NULL);
        if (argc > 1) {
            write_file(argv[1], "pixel.toy", pixel);
            write_file(argv[1], "vertex.toy", vertex);
        }
        check_words(pixel);
        check_functions(pixel);
        check_pointers(pixel);
        check_blocks(pixel);
        check_balance(pixel);
        check_balance(vertex);
        check_textures(result, pixel);
    }
    mxg_result_destroy(result);
    mxg_document_destroy(doc);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return test_report("toy");
}
