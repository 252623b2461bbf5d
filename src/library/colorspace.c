// SPDX-License-Identifier: Apache-2.0
/*
 * Names of colour spaces. A transform is a node `<space>_to_<space>` of the library (cmlib), so the
 * library defines the spaces.
 */
#include "library/library.h"
#include "lower/lower.h"
#include "tree/interpret.h"

#include <assert.h>
#include <stdio.h>

/*
 * Other names of colour spaces: an alias in the specification ("Color Spaces and Color Management
 * Systems"), names in old documents, recommendations of the ASWF's Color Interop Forum, and names
 * in OpenColorIO's configuration for ACES.
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
    {"srgb_ap1_scene", "srgb_ap1"},
    {"g24_rec709_scene", "rec709_display"},
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

const char *library_canonical_space(const char *space)
{
    for (size_t i = 0; i < sizeof aliases / sizeof *aliases; i++)
        if (strcmp(space, aliases[i][0]) == 0)
            return aliases[i][1];
    return space;
}

uint32_t library_color_transform(const struct library *lib, const char *from, const char *to,
                                 const char *type)
{
    char name[256];
    int len = snprintf(name, sizeof name, "ND_%s_to_%s_%s", from, to, type);
    str_id id =
        len > 0 && (size_t)len < sizeof name ? str_find(&lib->strings, name, (size_t)len) : 0;
    return id ? library_nodedef_by_name(lib, id) : LIBRARY_NONE;
}

const char *const library_color_hub = "lin_rec709";

/* The function of a definition with one output that serves every target; LIBRARY_NONE: none. */
static uint32_t portable_function(const struct library *lib, uint32_t nodedef)
{
    for (uint32_t i = library_nodedef(lib, nodedef)->first_impl; i != LIBRARY_NONE;) {
        const struct library *layer;
        const struct implementation *impl = library_impl(lib, i, &layer);
        bool is_portable = library_is_portable(lib, impl);
        if (impl->kind == IMPL_EXPRESSION && is_portable)
            return layer->refs.items[impl->ref];
        if (impl->kind == IMPL_FUNCTION && is_portable)
            return impl->ref;
        i = impl->next;
    }
    return LIBRARY_NONE;
}

bool library_convert_color(const struct library *lib, const char *space, float *rgb,
                           struct arena *scratch)
{
    uint32_t nodedef = library_color_transform(lib, space, library_color_hub, "color3"),
             function = nodedef == LIBRARY_NONE ? LIBRARY_NONE : portable_function(lib, nodedef),
             steps_left = LANG_MAX_STEPS;
    struct ir_value color = {.type = IR_TYPE_VEC3}, result;
    for (unsigned i = 0; i < 3; i++)
        color.w[i].f = rgb[i];
    if (function == LIBRARY_NONE
        || !lang_eval_call(&lib->unit, function, &color, &result, &steps_left, scratch))
        return false;
    for (unsigned i = 0; i < 3; i++)
        rgb[i] = result.w[i].f;
    return true;
}

/* "; expected one of: lin_rec709, …": the spaces that the library can convert to the hub. */
static const char *known_spaces(const struct library *lib, struct arena *arena)
{
    struct text out;
    text_init(&out, arena);
    text_fmt(&out, "; expected one of: %s", library_color_hub);
    for (; lib; lib = lib->base)
        for (uint32_t i = 0; i < lib->nodedefs.len; i++) {
            const char *name = str_text(&lib->strings, lib->nodedefs.items[i].node);
            const char *to = strstr(name, "_to_");
            bool again = i > 0 && lib->nodedefs.items[i - 1].node == lib->nodedefs.items[i].node;
            if (to && !again && strcmp(to + 4, library_color_hub) == 0)
                text_fmt(&out, ", %.*s", (int)(to - name), name);
        }
    return text_cstr(&out);
}

const char *library_expect_working_space(const struct library *lib, const char *space,
                                         struct diag_list *diags)
{
    struct text names;
    struct diag_guess guess;
    text_init(&names, diags->arena);
    text_fmt(&names, "one of: none, %s", library_color_hub);
    bool may_guess = diag_guess_begin(&guess, diags, space);
    if (may_guess)
        diag_guess_add(&guess, library_color_hub);
    size_t len = strlen(library_color_hub);
    for (; lib; lib = lib->base)
        for (uint32_t i = 0; i < lib->nodedefs.len; i++) {
            const char *name = str_text(&lib->strings, lib->nodedefs.items[i].node);
            bool again = i > 0 && lib->nodedefs.items[i - 1].node == lib->nodedefs.items[i].node,
                 is_from_hub = strncmp(name, library_color_hub, len) == 0
                               && strncmp(name + len, "_to_", 4) == 0;
            if (!is_from_hub || again)
                continue;
            text_fmt(&names, ", %s", name + len + 4);
            if (may_guess)
                diag_guess_add(&guess, name + len + 4);
        }
    if (guess.best) {
        text_init(&names, diags->arena);
        text_fmt(&names, "%s, perhaps", guess.best);
    }
    return text_cstr(&names);
}

static const char *suggest_space(const char *space, struct diag_list *diags)
{
    const char *names[sizeof aliases / sizeof *aliases * 2];
    size_t count = 0;
    for (size_t i = 0; i < sizeof aliases / sizeof *aliases; i++)
        for (size_t k = 0; k < 2; k++)
            names[count++] = aliases[i][k];
    assert(count == sizeof names / sizeof *names);
    return diag_suggest(diags, space, names, count);
}

void library_report_space(const struct library *lib, const char *space, struct diag_place place,
                          struct diag_list *diags)
{
    const char *suggestion = suggest_space(space, diags);
    diag_add(diags, DIAG_ID_unknown_colorspace, place, space,
             *suggestion ? suggestion : known_spaces(lib, diags->arena));
}
