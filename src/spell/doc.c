// SPDX-License-Identifier: Apache-2.0
/*
 * The comment above a function: what its library says of it, and of a version the constants that it
 * has compiled in, which tell two versions apart.
 *
 *     // Schlick's curve between f0 and f90.
 *     // Here exponent = 5.0.
 *     vec3 mx_fresnel_schlick(const float cosine, const vec3 f0, const vec3 f90)
 *
 * A version explains no parameter that it lacks: sentences after the first that name one whose
 * value no constant tells are left out.
 */
#include "specialise/specialise.h"
#include "spell/spell.h"
#include "tree/ast.h"
#include "tree/walk.h"

#include <assert.h>
#include <ctype.h>

struct subject {
    struct spell *spell;
    const struct lang_unit *unit, *layer; /* layer: of the origin */
    uint32_t id, origin;
    const struct lang_function *function; /* the origin */
};

static const char *param_name(const struct subject *s, uint32_t index)
{
    return str_text(s->unit->strings, ast_slot(s->layer, s->function, index)->name);
}

static bool is_part_of_name(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

static bool names(const char *text, const char *end, const char *name)
{
    size_t len = strlen(name);
    for (const char *at = text; at + len <= end; at++) {
        bool begins = at == text || !is_part_of_name(at[-1]);
        if (begins && memcmp(at, name, len) == 0 && (at + len == end || !is_part_of_name(at[len])))
            return true;
    }
    return false;
}

/* True for a printable character of ASCII that continues no line. */
static inline bool is_plain(char c)
{
    return (unsigned char)(c - ' ') < 0x7f - ' ' && c != '\\';
}

/*
 * The bytes at `text` that end a line or join it with the next one; 0: it is another character. The
 * line ends of Unicode (U+0085, U+2028 and U+2029) end comments of WGSL.
 */
static size_t ends_line(const char *text, size_t len)
{
    unsigned char byte = (unsigned char)*text;
    if (byte < 0x80)
        return byte < 0x20 || byte == 0x7f || byte == '\\';
    if (len > 1 && memcmp(text, "\xc2\x85", 2) == 0)
        return 2;
    bool is_separator =
        len > 2 && memcmp(text, "\xe2\x80", 2) == 0 && (text[2] == '\xa8' || text[2] == '\xa9');
    return is_separator ? 3 : 0;
}

void spell_comment(struct spell *spell, const char *text, size_t len)
{
    size_t begin = spell->out->len;
    text_mem(spell->out, text, len);
    char *out = spell->out->data + begin;
    for (size_t i = 0; i < len; i++)
        if (!is_plain(out[i]))
            memset(out + i, '?', ends_line(out + i, len - i));
}

/* True if a sentence names a parameter that the version lacks and that is no constant. */
static bool explains_absent(const struct subject *s, const char *text, const char *end)
{
    for (uint32_t i = 0; i < s->function->num_params; i++)
        if (lang_param_dropped(s->unit, s->id, s->origin, i) && !lang_param_bound(s->unit, s->id, i)
            && names(text, end, param_name(s, i)))
            return true;
    return false;
}

/* The end of the sentence or line at `text`. */
static const char *end_of_sentence(const char *text, const char *end)
{
    const char *newline = memchr(text, '\n', (size_t)(end - text));
    end = newline ? newline : end;
    for (const char *at = text; (at = memchr(at, '.', (size_t)(end - at))); at++)
        if (at + 2 < end && at[1] == ' ' && isupper((unsigned char)at[2]))
            return at + 1;
    return end;
}

static void write_doc(const struct subject *s, const char *text, const char *end)
{
    struct spell *spell = s->spell;
    bool is_line_open = false, is_first = true;
    while (text < end) {
        const char *stop = end_of_sentence(text, end);
        if (is_first || !explains_absent(s, text, stop)) {
            spell_text(spell, is_line_open ? " " : "// ");
            spell_comment(spell, text, (size_t)(stop - text));
            is_line_open = true;
        }
        is_first = false;
        if (stop < end && *stop == '\n' && is_line_open) {
            spell_text(spell, "\n");
            is_line_open = false;
        }
        text = stop + (stop < end);
    }
    if (is_line_open)
        spell_text(spell, "\n");
}

/* True for a word that the function's name has. */
static bool is_in_name(const struct subject *s, ir_type_id type, const union ir_word *words)
{
    return type == IR_TYPE_STRING
           && strstr(str_text(s->unit->strings, s->function->name),
                     str_text(s->unit->strings, words->u));
}

/* Writes "Here a = 1.0, b = 2.0.": the constants of parameters that the origin reads. */
static void write_constants(const struct subject *s)
{
    const char *before = "// Here ";
    for (uint32_t i = 0; i < s->function->num_params; i++) {
        const union ir_word *words = lang_param_bound(s->unit, s->id, i);
        ir_type_id type = ast_slot(s->layer, s->function, i)->type;
        if (!words || ir_type_is_matrix(type) || is_in_name(s, type, words)
            || !lang_names_slot(s->layer, s->function->body, i))
            continue;
        SPELL(s->spell, before, param_name(s, i), " = ");
        lang_print_value(s->spell->style, s->unit->strings, type, words, LANG_PREC_COMMA,
                         s->spell->out);
        before = ", ";
    }
    if (before[0] == ',')
        spell_text(s->spell, ".\n");
}

void spell_doc(struct spell *spell, str_id doc)
{
    const struct lang_function none = {0};
    const struct subject s = {.spell = spell, .function = &none};
    const char *text = str_text(spell->shader->strings, doc);
    if (spell->options->comments && !spell->shader->interface.rules.neutral_names)
        write_doc(&s, text, text + str_len(spell->shader->strings, doc));
}

void spell_function_doc(struct spell *spell, uint32_t function)
{
    const struct lang_unit *unit = spell->shader->unit;
    const struct lang_version *version = lang_version_of(unit, function);
    struct subject s = {.spell = spell,
                        .unit = unit,
                        .id = function,
                        .origin = version ? version->origin : function};
    s.function = lang_function(unit, s.origin, &s.layer);
    if (!spell->options->comments || spell->shader->interface.rules.neutral_names)
        return;
    if (s.function->doc) {
        const char *text = str_text(unit->strings, s.function->doc);
        write_doc(&s, text, text + str_len(unit->strings, s.function->doc));
    }
    if (version)
        write_constants(&s);
}
