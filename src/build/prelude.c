// SPDX-License-Identifier: Apache-2.0
/*
 * Names that MaterialX's generator puts above source for one target. Source that uses them gives
 * way to portable source of another target, which needs nothing above it.
 */
#include "base/scan.h"
#include "build/build_priv.h"
#include "shader/verbatim.h"

#include <string.h>

struct search {
    const struct source_language *language;
    struct strpool *strings;
    struct arena *arena;
    VEC(struct scan_word) used;
    VEC(struct scan_word) declared;
    bool has_structs; /* it computes with values that OSL has no operators for */
    bool is_list;     /* an expression is a list of members, whose type depends on the place */
};

static bool is_helper(const struct source_language *language, const struct scan_word *word)
{
    for (unsigned i = 0; i < language->num_helpers; i++)
        if (scan_is(word, language->helpers[i].name))
            return true;
    return false;
}

static const char *absent_name(const struct source_language *language, const struct scan_word *word)
{
    for (unsigned i = 0; i < language->num_absent; i++)
        if (scan_is(word, language->absent[i]))
            return language->absent[i];
    return NULL;
}

/* Notes the names of the prelude that a text uses and declares: "struct color4 {", "#define BSDF".
 */
static void scan_text(struct search *s, const char *text, size_t len)
{
    struct scan scan;
    struct scan_word word, last = {.kind = SCAN_MARK, .text = ";", .len = 1};
    unsigned depth = 0;
    scan_begin(&scan, text, len);
    while (scan_next(&scan, &word)) {
        depth += scan_is_mark(&word, '{') || scan_is_mark(&word, '(');
        depth -= depth > 0 && (scan_is_mark(&word, '}') || scan_is_mark(&word, ')'));
        if (word.kind == SCAN_NAME
            && (is_helper(s->language, &word) || absent_name(s->language, &word))) {
            bool is_declared =
                depth == 0 && (last.kind == SCAN_NAME || last.kind == SCAN_DIRECTIVE);
            if (is_declared)
                vec_push(s->arena, &s->declared, word);
            else
                vec_push(s->arena, &s->used, word);
        }
        last = word;
    }
}

static bool is_declared(const struct search *s, const struct scan_word *word)
{
    for (uint32_t i = 0; i < s->declared.len; i++)
        if (s->declared.items[i].len == word->len
            && memcmp(s->declared.items[i].text, word->text, word->len) == 0)
            return true;
    return false;
}

static void scan_id(struct search *s, str_id text)
{
    scan_text(s, str_text(s->strings, text), str_len(s->strings, text));
}

static void scan_implementation(struct search *s, const struct builder *b,
                                const struct implementation *impl)
{
    const struct library *layer;
    const struct verbatim *verbatim = library_verbatim(b->lib, impl->ref, &layer);
    if (verbatim->function) {
        struct library_sources files = {0};
        library_collect_sources(b->lib, verbatim->file, b->arena, &files);
        for (uint32_t i = 0; i < files.len; i++)
            scan_id(s, library_source(b->lib, files.items[i], NULL)->text);
        return;
    }
    const struct nodedef *def = library_nodedef(b->lib, impl->nodedef);
    const struct port *ports = library_ports(b->lib, impl->nodedef, NULL);
    for (unsigned i = 0; i < def->num_inputs + def->num_outputs; i++) {
        ir_type_id type = build_type(b, ports[i].type);
        s->has_structs |= type == IR_TYPE_VEC2 || type == IR_TYPE_VEC4;
    }
    for (uint32_t i = 0; i < def->num_outputs; i++) {
        str_id text = layer->refs.items[verbatim->first_expression + i];
        const char *expression = str_text(s->strings, text);
        s->is_list |= expression[0] == '{' && expression[1] != '{';
        scan_id(s, text);
    }
}

static struct search search(const struct builder *b, const struct implementation *impl)
{
    struct search s = {
        .language = b->shader->sources.language, .strings = b->shader->strings, .arena = b->arena};
    if (s.language && s.language->num_absent && impl->kind == IMPL_VERBATIM)
        scan_implementation(&s, b, impl);
    return s;
}

bool build_uses_prelude(const struct builder *b, const struct implementation *impl)
{
    struct search s = search(b, impl);
    for (uint32_t i = 0; i < s.used.len; i++)
        if (!is_declared(&s, &s.used.items[i]))
            return true;
    return s.is_list || s.has_structs;
}

const char *build_absent_name(const struct builder *b, const struct implementation *impl)
{
    struct search s = search(b, impl);
    for (uint32_t i = 0; i < s.used.len; i++) {
        const char *name = absent_name(s.language, &s.used.items[i]);
        if (name && !is_declared(&s, &s.used.items[i]))
            return name;
    }
    return s.is_list ? "{" : NULL;
}
