// SPDX-License-Identifier: Apache-2.0
/*
 * Colour spaces and units of literals. A transform is a node of the library (cmlib), `<space>_to_<working space>`; the set of
 * known spaces is thus the library's.
 */
#include "build/build_priv.h"

/*
 * Other names of colour spaces: an alias of the specification ("Color Spaces and Color Management Systems"), those of old
 * documents, those that the ASWF's Color Interop Forum recommends, and those of OpenColorIO's configuration for ACES.
 */
static const char *const aliases[][2] = {
    {"lin_ap1", "acescg"},
    {"lin_srgb", "lin_rec709"},
    {"gamma18", "g18_rec709"},
    {"gamma22", "g22_rec709"},
    {"gamma24", "rec709_display"},
    {"lin_ap1_scene", "acescg"},
    {"lin_rec709_scene", "lin_rec709"},
    {"lin_p3d65_scene", "lin_displayp3"},
    {"lin_adobergb_scene", "lin_adobergb"},
    {"srgb_rec709_scene", "srgb_texture"},
    {"srgb_p3d65_scene", "srgb_displayp3"},
    {"g18_rec709_scene", "g18_rec709"},
    {"g22_rec709_scene", "g22_rec709"},
    {"g22_ap1_scene", "g22_ap1"},
    {"g22_adobergb_scene", "adobergb"},
    {"lin_ap0_scene", "lin_ap0"},
    {"lin_rec2020_scene", "lin_rec2020"},
    {"lin_ciexyzd65_scene", "lin_ciexyzd65"},
    {"Raw", "none"},
    {"raw", "none"},
    {"srgb_tx", "srgb_texture"},
    {"sRGB - Texture", "srgb_texture"},
    {"Utility - sRGB - Texture", "srgb_texture"},
    {"sRGB Encoded Rec.709 (sRGB)", "srgb_texture"},
    {"Linear Rec.709 (sRGB)", "lin_rec709"},
    {"ACEScg", "acescg"},
    {"ACES2065-1", "lin_ap0"},
    {"Linear Rec.2020", "lin_rec2020"},
    {"CIE XYZ-D65 - Scene-referred", "lin_ciexyzd65"},
    {"Linear P3-D65", "lin_displayp3"},
    {"sRGB Encoded P3-D65", "srgb_displayp3"},
    {"Linear AdobeRGB", "lin_adobergb"},
    {"Gamma 2.2 Encoded AdobeRGB", "adobergb"},
    {"Gamma 2.2 Encoded AP1", "g22_ap1"},
    {"Gamma 1.8 Encoded Rec.709", "g18_rec709"},
    {"Gamma 2.2 Encoded Rec.709", "g22_rec709"},
    {"Gamma 2.4 Encoded Rec.709", "rec709_display"},
};

static str_id canonical_space(struct builder *b, str_id space)
{
    for (size_t i = 0; i < sizeof aliases / sizeof *aliases; i++)
        if (strcmp(build_text(b, space), aliases[i][0]) == 0)
            return str_intern_z(b->shader->strings, aliases[i][1]);
    return space;
}

str_id build_colorspace(struct builder *b, elem_id element)
{
    str_id space = doc_inherited_attr(&b->lib->doc, element, STR_colorspace);
    if (!space || space == STR_none || space == b->options->colorspace)
        return 0;
    space = canonical_space(b, space);
    return space == STR_none || space == b->options->colorspace ? 0 : space;
}

/* Every space can be converted to it. */
static const char *const hub = "lin_rec709";

/* "lin_rec709, srgb_texture, …": what the library can convert to the hub. */
static const char *known_spaces(struct builder *b)
{
    struct text out;
    text_init(&out, b->arena);
    text_str(&out, hub);
    for (const struct library *lib = b->lib; lib; lib = lib->base)
        for (uint32_t i = 0; i < lib->nodedefs.len; i++) {
            const char *name = build_text(b, lib->nodedefs.items[i].node);
            const char *to = strstr(name, "_to_");
            bool again = i > 0 && lib->nodedefs.items[i - 1].node == lib->nodedefs.items[i].node;
            if (!to || again || strcmp(to + 4, hub) != 0)
                continue;
            text_fmt(&out, ", %.*s", (int)(to - name), name);
        }
    return text_cstr(&out);
}

static const char *suggest_space(struct builder *b, const char *space)
{
    const char *names[sizeof aliases / sizeof *aliases * 2];
    size_t count = 0;
    for (size_t i = 0; i < sizeof aliases / sizeof *aliases; i++)
        for (size_t k = 0; k < 2; k++)
            names[count++] = aliases[i][k];
    return diag_suggest(b->arena, space, names, count);
}

/* 0: the library has no such transform. */
static ir_ref transform(struct builder *b, ir_ref value, doc_type type, const char *from, const char *to)
{
    struct text name;
    text_init(&name, b->arena);
    text_fmt(&name, "ND_%s_to_%s_%s", from, to, build_text(b, library_type_name(b->lib, type)));
    str_id id = str_find(b->shader->strings, name.data, name.len);
    uint32_t nodedef = id ? library_nodedef_by_name(b->lib, id) : LIBRARY_NONE;
    if (!value || nodedef == LIBRARY_NONE)
        return 0;
    ir_ref results[BUILD_MAX_OUTPUTS];
    build_apply(b, nodedef, b->document->node, &value, results);
    return results[0];
}

void build_check_colorspace(struct builder *b)
{
    const char *space = build_text(b, canonical_space(b, b->options->colorspace));
    ir_ref black = ir_const_splat(b->graph, IR_TYPE_VEC3, 0.0f);
    b->has_colorspace = strcmp(space, hub) == 0 || strcmp(space, "none") == 0 || transform(b, black, DOC_TYPE_color3, hub, space);
    if (!b->has_colorspace)
        diag_add(b->diags, DIAG_ID_bad_option, (struct diag_place){0}, space, "colorspace",
                 "a linear colour space that the library converts lin_rec709 to");
}

ir_ref build_color_transform(struct builder *b, ir_ref value, doc_type type, str_id space, struct diag_place place)
{
    const char *from = build_text(b, space), *to = build_text(b, canonical_space(b, b->options->colorspace));
    ir_ref result = strcmp(from, to) == 0 ? value : transform(b, value, type, from, to);
    if (!result)
        result = transform(b, strcmp(from, hub) == 0 ? value : transform(b, value, type, from, hub), type, hub, to);
    if (!result && b->has_colorspace)
        diag_add(b->diags, DIAG_ID_unknown_colorspace, place, from, suggest_space(b, from), known_spaces(b));
    return result ? result : ir_poison(b->graph, ir_type_of(b->graph, value));
}

/* ---- units ---- */

/* The scale of a unit of a type, to the type's base unit, from <unitdef> elements; false: unknown. */
static bool unit_scale(const struct builder *b, str_id type, str_id unit, float *out_scale)
{
    for (const struct library *lib = b->lib; lib; lib = lib->base) {
        const struct document *doc = &lib->doc;
        for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next) {
            if (doc_element(doc, e)->kind != KIND_UNITDEF || (type && doc_attr_value(doc, e, STR_unittype) != type))
                continue;
            elem_id found = doc_child_of_kind(doc, e, KIND_UNIT, unit);
            str_id scale = found ? doc_attr_value(doc, found, STR_scale) : 0;
            struct ir_value value;
            if (!scale || !doc_parse_value(DOC_TYPE_float, build_text(b, scale), str_len(&b->lib->strings, scale), NULL, &value))
                continue;
            *out_scale = value.w[0].f;
            return true;
        }
    }
    return false;
}

ir_ref build_unit_conversion(struct builder *b, ir_ref value, elem_id element, const struct port *port)
{
    const struct document *doc = &b->lib->doc;
    str_id unit = doc_attr_value(doc, element, STR_unit);
    if (!unit || !ir_type_is_float(ir_type_of(b->graph, value)))
        return value;
    str_id type = doc_attr_value(doc, element, STR_unittype);
    if (!type)
        type = doc_attr_value(doc, port->element, STR_unittype);
    /* What the definition works in, else the option's unit (specification, "Units"). */
    str_id target = doc_attr_value(doc, port->element, STR_unit);
    if (!target)
        target = type == STR_angle ? b->options->angle_unit : b->options->distance_unit;
    float from, to;
    if (!unit_scale(b, type, unit, &from) || !unit_scale(b, type, target, &to)) {
        diag_add(b->diags, DIAG_ID_unknown_unit, doc_attr_place(doc, element, STR_unit), build_text(b, unit), "");
        return value;
    }
    return from == to ? value : ir_op2(b->graph, IR_MUL, value, ir_const_float(b->graph, from / to));
}
