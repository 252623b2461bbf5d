// SPDX-License-Identifier: Apache-2.0
/* Verbatim source in the text of a stage (shader/verbatim.h). */
#include "shader/verbatim.h"

#include "base/hash.h"
#include "base/scan.h"
#include "spell/spell.h"

#include <assert.h>
#include <stdio.h>

struct writer {
    struct spell *spell;
    bool *written; /* per source */
};

static void write_token(struct spell *spell, const struct scan_word *word)
{
    const struct shader_token *token = shader_find_token(spell->shader, word->text, word->len);
    assert(token && (token->text || token->variable < spell->shader->interface.variables.len));
    if (token->text)
        spell_text(spell, token->text);
    else
        spell_name(spell, spell->variables[token->variable]);
}

void spell_once(struct spell *spell, const char *text, size_t len)
{
    char guard[32];
    if (!spell->shader->role->is_in_host_file || spell->style->syntax->no_directives) {
        text_mem(spell->out, text, len);
        return;
    }
    snprintf(guard, sizeof guard, "MXG_%016llx", (unsigned long long)hash_stable(0, text, len));
    SPELL(spell, "#ifndef ", guard, "\n#define ", guard, "\n");
    text_mem(spell->out, text, len);
    spell_text(spell, len && text[len - 1] == '\n' ? "#endif\n" : "\n#endif\n");
}

/* Copies the text. The nesting of includes is bounded (library/source_files.c), so this recursion
 * is, too. */
static void write_source(struct writer *w, uint32_t index)
{
    struct spell *spell = w->spell;
    const struct shader_source *source = &spell->shader->sources.all.items[index];
    if (w->written[index])
        return;
    w->written[index] = true;
    if (source->program) /* program.c writes it */
        return;
    struct text own, *out = spell->out;
    text_init(&own, spell->scratch);
    spell->out = &own;
    struct scan scan;
    struct scan_word word;
    uint32_t include = 0;
    const char *text = str_text(spell->shader->strings, source->text), *from = text;
    scan_begin(&scan, text, str_len(spell->shader->strings, source->text));
    while (scan_next(&scan, &word)) {
        bool includes = word.kind == SCAN_DIRECTIVE && scan_is(&word, "include");
        if (!includes && word.kind != SCAN_TOKEN)
            continue;
        text_mem(spell->out, from, (size_t)(word.begin - from));
        if (includes) {
            scan_next(&scan, &word); /* its file */
            assert(include < source->num_includes);
            write_source(w, spell->shader->sources.refs.items[source->first_include + include++]);
        } else {
            write_token(spell, &word);
        }
        from = scan.at;
        bool is_instance = word.kind == SCAN_TOKEN && scan_is(&word, SOURCE_INSTANCE);
        from += is_instance && from < scan.end && *from == '.';
    }
    text_mem(spell->out, from, (size_t)(scan.end - from));
    spell_text(spell, scan.end > text && scan.end[-1] == '\n' ? "" : "\n");
    spell->out = out;
    spell_once(spell, own.data, own.len);
}

static void write_root(struct writer *w, uint32_t index)
{
    if (w->written[index])
        return;
    write_source(w, index);
    spell_text(w->spell, "\n");
}

static void write_helpers(struct spell *spell, uint64_t helpers)
{
    const struct source_language *language = spell->shader->sources.language;
    for (unsigned i = 0; language && i < language->num_helpers; i++)
        if (helpers >> i & 1) {
            const char *text = shader_helper_text(spell->shader, i);
            spell_once(spell, text, strlen(text));
            spell_text(spell, "\n");
        }
}

void spell_verbatim_sources(struct spell *spell)
{
    const struct shader *shader = spell->shader;
    struct writer w = {spell, ARENA_ARRAY(spell->scratch, bool, shader->sources.all.len + 1)};
    spell->verbatim_begin = spell->out->len;
    write_helpers(spell, shader_stage_helpers(shader, spell->stage, spell->scratch));
    for (uint32_t i = 0; i < spell->stage->verbatim.len; i++) {
        assert(spell->stage->verbatim.items[i] < shader->sources.calls.len);
        const struct shader_verbatim *v =
            &shader->sources.calls.items[spell->stage->verbatim.items[i]];
        for (uint32_t k = 0; k < v->num_sources; k++)
            write_root(&w, shader->sources.refs.items[v->first_source + k]);
    }
    spell->verbatim_end = spell->out->len;
}

void spell_take_source_names(struct spell *spell)
{
    const struct shader *shader = spell->shader;
    uint64_t helpers = shader_stage_helpers(shader, spell->stage, spell->scratch);
    for (unsigned i = 0; shader->sources.language && i < shader->sources.language->num_helpers;
         i++) {
        const char *name = shader->sources.language->helpers[i].name;
        if (helpers >> i & 1)
            names_take(&spell->names, name, strlen(name));
    }
    struct source_list all = {0};
    for (uint32_t i = 0; i < spell->stage->verbatim.len; i++) {
        const struct shader_verbatim *v =
            &shader->sources.calls.items[spell->stage->verbatim.items[i]];
        for (uint32_t k = 0; k < v->num_sources; k++)
            shader_collect_sources(shader, shader->sources.refs.items[v->first_source + k],
                                   spell->scratch, &all);
    }
    for (uint32_t i = 0; i < all.len; i++) {
        const struct shader_source *source = &shader->sources.all.items[all.items[i]];
        for (uint32_t k = 0; k < source->num_names; k++) {
            str_id name = shader->sources.refs.items[source->first_name + k];
            names_take(&spell->names, str_text(shader->strings, name),
                       str_len(shader->strings, name));
        }
    }
}
