// SPDX-License-Identifier: Apache-2.0
/*
 * Annotations of parameters for user interfaces:
 *
 *     float roughness = 0.3 [[ anno::display_name("Roughness"), anno::in_group("Coat"),
 * anno::hard_range(0.0, 1.0) ]]
 */
#include "generators/mdl/mdl.h"

#include "base/num.h"

void mdl_write_string(struct spell *spell, const char *text)
{
    text_char(spell->out, '"');
    for (; *text; text++) {
        unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\')
            text_char(spell->out, '\\');
        text_char(spell->out, c < 0x20 || c == 0x7f ? ' ' : *text);
    }
    text_char(spell->out, '"');
}

static void begin(struct spell *spell, unsigned *count, const char *annotation)
{
    SPELL(spell, (*count)++ ? ", anno::" : " [[ anno::", annotation, "(");
}

static void write_text(struct spell *spell, unsigned *count, const char *annotation,
                       const char *text)
{
    if (!text || !*text)
        return;
    begin(spell, count, annotation);
    mdl_write_string(spell, text);
    spell_text(spell, ")");
}

/* True for a number as MDL writes it, and no more. */
static bool is_number(const char *text, bool is_int)
{
    if (!text || !*text)
        return false;
    text += *text == '-';
    size_t digits = strspn(text, "0123456789");
    text += digits;
    if (*text == '.' && !is_int) {
        size_t more = strspn(text + 1, "0123456789");
        digits += more;
        text += 1 + more;
    }
    return digits && !*text;
}

/* Both ends are numbers: "hard_range(0.0, 1.0)". */
static void write_range(struct spell *spell, unsigned *count, const char *annotation,
                        const struct shader_variable *variable, const char *low, const char *high)
{
    bool is_int = variable->type == IR_TYPE_INT;
    if ((!is_int && variable->type != IR_TYPE_FLOAT) || !is_number(low, is_int)
        || !is_number(high, is_int))
        return;
    begin(spell, count, annotation);
    SPELL(spell, low, is_int || strchr(low, '.') ? ", " : ".0, ", high,
          is_int || strchr(high, '.') ? ")" : ".0)");
}

/* False if the document's value is outside: MDL takes no such value for a hard range. */
static bool has_default(const char *low, const char *high, const struct shader_variable *variable)
{
    union ir_word value = variable->value.w[0];
    float x = variable->type == IR_TYPE_INT ? (float)value.i : value.f, from, to;
    return !low || !high || !num_parse_float(low, strlen(low), &from)
           || !num_parse_float(high, strlen(high), &to) || (from <= x && x <= to);
}

void mdl_write_annotations(struct spell *spell, const struct shader_variable *variable)
{
    const struct spell_options *options = spell->options;
    struct shader_ui ui = {0};
    unsigned count = 0;
    if (options->metadata == 0)
        return;
    if (options->ui)
        options->ui(options->user_data, variable, &ui);
    write_text(spell, &count, "display_name", ui.uiname);
    write_text(spell, &count, "in_group", ui.uifolder);
    if (has_default(ui.uimin, ui.uimax, variable))
        write_range(spell, &count, "hard_range", variable, ui.uimin, ui.uimax);
    write_range(spell, &count, "soft_range", variable, ui.uisoftmin, ui.uisoftmax);
    if (options->metadata > 1)
        write_text(spell, &count, "description", ui.doc);
    spell_text(spell, count ? " ]]" : "");
}
