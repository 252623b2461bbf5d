// SPDX-License-Identifier: Apache-2.0
/*
 * Texture reads with the node's address modes, and its value for a missing image:
 *
 *     tex::lookup_float3(file, uv, tex::wrap_repeat, tex::wrap_clamp)
 */
#include "generators/mdl/mdl.h"

/* Outside the border with mode `constant`, the shader itself computes the default. */
static const char *wrap_of(const struct spell *spell, str_id mode)
{
    const char *word = str_text(spell->shader->strings, mode);
    return strcmp(word, "constant") == 0 || strcmp(word, "clamp") == 0 ? "tex::wrap_clamp"
           : strcmp(word, "mirror") == 0                               ? "tex::wrap_mirrored_repeat"
                                                                       : "tex::wrap_repeat";
}

/* A path begins at the file or at a root of the renderer's search path. */
void mdl_write_texture(struct spell *spell, const struct shader_variable *variable)
{
    const char *file = str_text(spell->shader->strings, variable->file);
    if (!*file) {
        spell_text(spell, "texture_2d()");
        return;
    }
    struct text *path = spell_new_text(spell);
    bool is_rooted = *file == '/' || *file == '.';
    text_fmt(path, "%s%s", is_rooted ? "" : "./", file);
    spell_text(spell, "texture_2d(");
    mdl_write_string(spell, text_cstr(path));
    spell_text(spell, ", tex::gamma_linear)");
}

/* The default of a missing image; false: it is black, which a lookup gives. */
static bool write_missing(struct spell *spell, const struct shader_variable *texture,
                          ir_type_id type, struct text *out)
{
    const struct ir_value *value = &texture->value;
    if (!texture->has_default || value->type != type)
        return false;
    if (texture->fallback) {
        const struct spell_name *name = &spell->variables[texture->fallback - 1];
        text_mem(out, name->text, name->len);
        return true;
    }
    struct ir_value black = {.type = type};
    if (memcmp(black.w, value->w, ir_type_components(type) * sizeof *value->w) == 0)
        return false;
    lang_print_value(spell->style, NULL, type, value->w, LANG_PREC_POSTFIX, out);
    return true;
}

static const struct shader_variable *texture_of(const struct spell *spell,
                                                const struct lang_use *use)
{
    const struct ir_graph *graph = spell->shader->graph;
    const struct ir_node *texture = use->node ? ir_get(graph, ir_arg(graph, use->node, 0)) : NULL;
    return texture && texture->op == IR_TEXTURE
               ? &spell->shader->interface.variables.items[texture->attr]
               : NULL;
}

const struct lang_pieces *mdl_texture_form(struct spell *spell, const struct lang_use *use)
{
    const struct shader_variable *texture = texture_of(spell, use);
    struct text *text = spell_new_text(spell), *missing = spell_new_text(spell);
    bool has_missing = texture && write_missing(spell, texture, use->type, missing);
    text_str(text, has_missing ? "tex::texture_isvalid($0) ? " : "");
    text_fmt(text, "tex::lookup_%s($0, $1", spell->style->types[use->type].bytes);
    if (texture)
        text_fmt(text, ", %s, %s", wrap_of(spell, texture->sampling.uaddressmode),
                 wrap_of(spell, texture->sampling.vaddressmode));
    text_char(text, ')');
    if (has_missing)
        text_fmt(text, " : %s", text_cstr(missing));
    return lang_form_of(spell->scratch, text_cstr(text),
                        has_missing ? LANG_PREC_TERNARY : LANG_PREC_POSTFIX);
}
