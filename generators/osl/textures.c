// SPDX-License-Identifier: Apache-2.0
/*
 * Texture reads with the node's address modes, filter, and colour for a missing image.
 *
 *     color c = (color)texture(file, uv.x, 1 - uv.y, "swrap", "clamp", "twrap", "periodic");
 */
#include "generators/osl/osl.h"

/* Outside the border with mode `constant`, the shader itself computes the default. */
static const char *const wraps[][2] = {
    {"constant", "clamp"}, {"clamp", "clamp"}, {"periodic", "periodic"}, {"mirror", "mirror"}};
/* "linear" is the default of texture(), which filters better than the explicit mode. */
static const char *const filters[][2] = {
    {"closest", "closest"}, {"linear", "smartcubic"}, {"cubic", "cubic"}};

static const char *translate(const char *const (*words)[2], size_t count, const char *word,
                             const char *otherwise)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(words[i][0], word) == 0)
            return words[i][1];
    return otherwise;
}

struct modes {
    const char *swrap, *twrap, *interp;
    const char *layer; /* name of a subimage; "" for the first */
};

static struct modes modes_of(const struct spell *spell, const struct shader_variable *texture)
{
    const struct strpool *strings = spell->shader->strings;
    const char *layer = str_text(strings, texture->sampling.layer);
    return (struct modes){
        .swrap = translate(wraps, 4, str_text(strings, texture->sampling.uaddressmode), "periodic"),
        .twrap = translate(wraps, 4, str_text(strings, texture->sampling.vaddressmode), "periodic"),
        .interp =
            translate(filters, 3, str_text(strings, texture->sampling.filtertype), "smartcubic"),
        /* the name becomes part of a form, in which '$' marks an operand */
        .layer = strchr(layer, '$') ? "" : layer,
    };
}

/*
 * Images have their first row at the top, texture coordinates have it at the bottom. texture()
 * finds a tile of <UDIM> by the whole part of the coordinates, so only the fraction is flipped.
 */
static bool has_tiles(const struct spell *spell, const struct shader_variable *texture)
{
    const char *file = str_text(spell->shader->strings, texture->file);
    return strstr(file, "<UDIM>") || strstr(file, "<UVTILE>");
}

/* A channel of the parameter that holds the default; the parameter has `n` channels. */
static void write_part_of(const struct spell *spell, uint32_t parameter, unsigned n,
                          unsigned channel, struct text *out)
{
    bool is_struct = n == 2 || n == 4;
    text_str(out, spell->variables[parameter].text);
    if (is_struct)
        text_fmt(out, ".%c", "xyzw"[channel]);
    else if (n == 3)
        text_fmt(out, "[%u]", channel);
}

/* The default for a missing image, as four channels. */
static void write_missing(const struct spell *spell, const struct shader_variable *texture,
                          unsigned count, struct text *out)
{
    const struct ir_value *value = &texture->value;
    bool is_number = texture->has_default && value->type < IR_NUM_TYPES;
    unsigned n = is_number ? ir_type_info(value->type)->components : 0;
    for (unsigned i = 0; i < count; i++) {
        bool has_channel = n && (i < n || (n == 1 && i < 3));
        union ir_word word = {.f = i == 3 && n < 4 ? 1.0f : 0.0f};
        text_str(out, i ? ", " : "");
        if (has_channel && texture->fallback) {
            write_part_of(spell, texture->fallback - 1, n, n == 1 ? 0 : i, out);
            continue;
        }
        if (has_channel)
            word = value->w[n == 1 ? 0 : i];
        lang_print_value(spell->style, NULL, IR_TYPE_FLOAT, &word, LANG_PREC_COMMA, out);
    }
}

static bool is_color(const struct spell *spell, uint32_t parameter)
{
    return spell->shader->interface.variables.items[parameter].doc_type == STR_color3;
}

/* OSL's texture() returns one or three channels. */
static void write_call(const struct spell *spell, const struct shader_variable *texture,
                       ir_type_id type, struct text *out)
{
    struct modes modes = modes_of(spell, texture);
    text_fmt(out, "(%s)texture($0, $1.x, %s1 - $1.y", type == IR_TYPE_FLOAT ? "float" : "color",
             has_tiles(spell, texture) ? "2 * floor($1.y) + " : "");
    if (strcmp(modes.swrap, modes.twrap) == 0)
        text_fmt(out, ", \"wrap\", \"%s\"", modes.swrap);
    else
        text_fmt(out, ", \"swrap\", \"%s\", \"twrap\", \"%s\"", modes.swrap, modes.twrap);
    if (strcmp(modes.interp, "smartcubic") != 0)
        text_fmt(out, ", \"interp\", \"%s\"", modes.interp);
    if (*modes.layer) {
        text_str(out, ", \"subimage\", ");
        text_json_string(out, modes.layer, strlen(modes.layer));
    }
    text_str(out, ", \"missingcolor\", ");
    if (texture->fallback && is_color(spell, texture->fallback - 1)) {
        text_fmt(out, "%s)", spell->variables[texture->fallback - 1].text);
        return;
    }
    text_str(out, "color(");
    write_missing(spell, texture, 3, out);
    text_str(out, "))");
}

static const char whole_texel[] =
    "vector4 texel(string file, float s, float t, string swrap, string twrap, string interp, "
    "string layer, vector4 missing)\n"
    "{\n    float alpha;\n"
    "    color c = texture(file, s, t, \"swrap\", swrap, \"twrap\", twrap, \"interp\", interp, "
    "\"subimage\", layer, \"alpha\", alpha,\n"
    "                      \"missingcolor\", color(missing.x, missing.y, missing.z), "
    "\"missingalpha\", missing.w);\n"
    "    return vector4(c[0], c[1], c[2], alpha);\n}\n";

static void write_whole(struct osl *osl, const struct shader_variable *texture, struct text *out)
{
    struct modes modes = modes_of(osl->spell, texture);
    osl_type(osl, IR_TYPE_VEC4);
    osl_add_helper(osl, whole_texel);
    text_fmt(out, "texel($0, $1.x, %s1 - $1.y, \"%s\", \"%s\", \"%s\", ",
             has_tiles(osl->spell, texture) ? "2 * floor($1.y) + " : "", modes.swrap, modes.twrap,
             modes.interp);
    text_json_string(out, modes.layer, strlen(modes.layer));
    text_str(out, ", vector4(");
    write_missing(osl->spell, texture, 4, out);
    text_str(out, "))");
}

const char *osl_texture_call(struct osl *osl, const struct lang_use *use)
{
    const struct spell *spell = osl->spell;
    const struct ir_node *texture =
        use->node ? ir_get(spell->shader->graph, ir_arg(spell->shader->graph, use->node, 0)) : NULL;
    if (!texture || texture->op != IR_TEXTURE)
        return NULL;
    const struct shader_variable *variable =
        &spell->shader->interface.variables.items[texture->attr];
    struct text text;
    text_init(&text, spell->scratch);
    if (use->type == IR_TYPE_VEC4)
        write_whole(osl, variable, &text);
    else
        write_call(spell, variable, use->type, &text);
    return text_cstr(&text);
}
