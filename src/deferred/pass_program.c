// SPDX-License-Identifier: Apache-2.0
/*
 * Texts of passes as programs (parse/parse.h), of which targets make their own languages: without
 * the directives of GLSL's preprocessor and without declarations of its interface, which the frame
 * of the target writes.
 *
 *     #if MX_STORAGE == 0 …            the lines whose condition holds
 *     layout(…) in;                    nothing
 *     layout(location = 1) out uint x; uint x;
 *     #define mx_word0 mx_packed0      the name, until #undef
 *     imageLoad(mx_word0, pixel)       mx_word0_load(pixel), a function without a body
 */
#include "deferred/deferred_priv.h"

#include <assert.h>
#include <ctype.h>
#include <stdlib.h>

enum { MAX_MACROS = 64, MAX_DEPTH = 8 };

struct macro {
    const char *name;
    size_t len;
    const char *word; /* what stands for it, if that is no number; NULL: a number */
    size_t word_len;
    int value;
};

struct reader {
    struct text *out;
    struct macro macros[MAX_MACROS];
    unsigned num_macros, depth;
    bool is_kept[MAX_DEPTH + 1]; /* by depth of conditions: the lines inside are written */
};

static bool is_word(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

static size_t word_length(const char *at)
{
    size_t len = 0;
    while (is_word(at[len]))
        len++;
    return len;
}

/* Moves *at behind a word and the blanks after it. */
static const char *read_word(const char **at, size_t *out_len)
{
    const char *word = *at;
    *out_len = word_length(word);
    *at += *out_len;
    while (**at == ' ')
        ++*at;
    return word;
}

static struct macro *find_macro(struct reader *r, const char *word, size_t len)
{
    for (unsigned i = 0; i < r->num_macros; i++)
        if (r->macros[i].len == len && memcmp(r->macros[i].name, word, len) == 0)
            return &r->macros[i];
    return NULL;
}

static int read_number(struct reader *r, const char **at)
{
    size_t len;
    const char *word = read_word(at, &len);
    assert(len > 0);
    if (isdigit((unsigned char)*word))
        return (int)strtol(word, NULL, 10);
    const struct macro *macro = find_macro(r, word, len);
    assert(macro); /* a line before it defines each number of a condition */
    return macro->value;
}

/* "MX_WORDS > 3": a number, an operator, a number. */
static bool read_condition(struct reader *r, const char *at)
{
    int a = read_number(r, &at);
    char operator= * at;
    at += strcspn(at, " ") + 1;
    int b = read_number(r, &at);
    assert(strchr("<>=", operator));
    return operator== '<' ? a < b : operator== '>' ? a > b : a == b;
}

static void read_directive(struct reader *r, const char *at)
{
    size_t len;
    const char *word = read_word(&at, &len);
    if (strncmp(word, "if ", 3) == 0) {
        assert(r->depth < MAX_DEPTH);
        bool holds = read_condition(r, at);
        r->is_kept[r->depth + 1] = r->is_kept[r->depth] && holds;
        r->depth++;
    } else if (len == 4 && strncmp(word, "else", len) == 0) {
        assert(r->depth > 0);
        r->is_kept[r->depth] = r->is_kept[r->depth - 1] && !r->is_kept[r->depth];
    } else if (len == 5 && strncmp(word, "endif", len) == 0) {
        assert(r->depth > 0);
        r->depth--;
    } else if (r->is_kept[r->depth] && len == 5 && strncmp(word, "undef", len) == 0) {
        word = read_word(&at, &len);
        find_macro(r, word, len)->len = 0;
    } else if (r->is_kept[r->depth]) {
        assert(len == 6 && strncmp(word, "define", len) == 0 && r->num_macros < MAX_MACROS);
        struct macro *macro = &r->macros[r->num_macros++];
        macro->name = read_word(&at, &macro->len);
        macro->word = isdigit((unsigned char)*at) ? NULL : read_word(&at, &macro->word_len);
        macro->value = macro->word ? 0 : (int)strtol(at, NULL, 10);
    }
}

/* The name of what a call at `at` does with a resource; NULL: it is no such call. */
static const char *call_of_resource(const char *at)
{
    static const struct {
        const char *call, *name;
    } calls[] = {{"imageLoad(", "load"},
                 {"imageStore(", "store"},
                 {"imageSize(", "size"},
                 {"texelFetch(", "fetch"}};
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++)
        if (strncmp(at, calls[i].call, strlen(calls[i].call)) == 0)
            return calls[i].name;
    return NULL;
}

/* Copies a word, or another character. */
static void copy_word(struct reader *r, const char *at, size_t len)
{
    const struct macro *macro = len ? find_macro(r, at, len) : NULL;
    if (macro && macro->word)
        text_mem(r->out, macro->word, macro->word_len);
    else
        text_mem(r->out, at, len ? len : 1);
}

/* Copies a line. A call of a resource becomes a call of its function. */
static void copy_line(struct reader *r, const char *at, const char *end)
{
    while (at < end) {
        const char *name = is_word(*at) ? call_of_resource(at) : NULL;
        size_t len = word_length(at);
        if (!name) {
            copy_word(r, at, len);
            at += len ? len : 1;
            continue;
        }
        at += len + 1;
        len = word_length(at); /* of the resource */
        text_fmt(r->out, "%.*s_%s(", (int)len, at, name);
        at += len;
        at += *at == ',' ? 2 : 0; /* and the blank behind it */
    }
}

static void read_line(struct reader *r, const char *at, const char *end)
{
    static const char layout[] = "layout(", output[] = ") out ";
    if (*at == '#') {
        read_directive(r, at + 1);
        return;
    }
    if (!r->is_kept[r->depth])
        return;
    if (strncmp(at, layout, sizeof layout - 1) == 0) {
        const char *close = memchr(at, ')', (size_t)(end - at));
        if (strncmp(close, output, sizeof output - 1) != 0)
            return;
        at = close + sizeof output - 1;
    }
    copy_line(r, at, end);
}

static void define_macros(const struct reader *r, struct text *out)
{
    for (unsigned i = 0; i < r->num_macros; i++)
        if (!r->macros[i].word)
            text_fmt(out, "#define %.*s %d\n", (int)r->macros[i].len, r->macros[i].name,
                     r->macros[i].value);
}

/* ---- Functions and variables of the frame ---- */

static void declare_image(const struct deferred_resource *r, struct text *out)
{
    const char *value = strcmp(r->format, "r32ui") == 0 ? "uvec4" : "vec4",
               *at = strcmp(r->kind, "image2DArray") == 0 ? "ivec3" : "ivec2";
    if (strcmp(r->kind, "sampler2D") == 0)
        text_fmt(out, "vec4 mx_%s_fetch(ivec2 at, int level);\n", r->name);
    else
        text_fmt(out,
                 "%s mx_%s_load(%s at);\nvoid mx_%s_store(%s at, %s value);\n"
                 "ivec3 mx_%s_size();\n",
                 value, r->name, at, r->name, at, value, r->name);
}

static void declare_resources(const struct source_resources *resources, struct text *out)
{
    for (uint32_t i = 0; i < NUM_RESOURCES; i++) {
        const struct deferred_resource *r = deferred_resource((enum deferred_binding)i);
        if ((resources->reads | resources->writes) >> i & 1 && !r->num_members)
            declare_image(r, out);
    }
}

void deferred_make_program(const char *glsl, const struct source_resources *resources,
                           struct text *out)
{
    static const char head[] = "uint packHalf2x16(vec2 v);\nvec2 unpackHalf2x16(uint v);\n"
                               "in vec4 gl_FragCoord;\n";
    struct text body;
    text_init(&body, out->arena);
    struct reader r = {.out = &body, .is_kept = {true}};
    while (*glsl) {
        const char *end = strchr(glsl, '\n');
        assert(end);
        read_line(&r, glsl, end + 1);
        glsl = end + 1;
    }
    define_macros(&r, out);
    text_str(out, head);
    declare_resources(resources, out);
    text_mem(out, body.data, body.len);
}
