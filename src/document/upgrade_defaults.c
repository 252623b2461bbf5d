// SPDX-License-Identifier: Apache-2.0
/*
 * Inputs that a document leaves out, and whose default was another one in its version. Defaults of
 * shading models are those of the current libraries: docs/library.md says so.
 */
#include "document/upgrade.h"

static const struct old_default {
    int minor; /* the step that gives the input another default */
    const char *category, *type, *input, *input_type, *value; /* `type` NULL: any */
} old_defaults[] = {
    {37, "compare", NULL, "intest", "float", "0.0"},
    {38, "dielectric_brdf", NULL, "roughness", "vector2", "0.0, 0.0"},
    {38, "dielectric_btdf", NULL, "roughness", "vector2", "0.0, 0.0"},
    {38, "generalized_schlick_brdf", NULL, "roughness", "vector2", "0.0, 0.0"},
    {38, "conductor_brdf", NULL, "roughness", "vector2", "0.0, 0.0"},
    {38, "thin_film_brdf", NULL, "thickness", "float", "1000.0"},
    {38, "mix", "BSDF", "mix", "float", "1.0"},
    {38, "mix", "EDF", "mix", "float", "1.0"},
    {38, "mix", "VDF", "mix", "float", "1.0"},
    {39, "thin_film_bsdf", NULL, "thickness", "float", "550.0"},
};

static bool counts(const struct upgrade *u, elem_id node, const struct old_default *row)
{
    return row->minor == u->minor && upgrade_is_category(u, node, row->category)
           && (!row->type || upgrade_is(u, doc_attr_value(u->doc, node, STR_type), row->type))
           && !upgrade_child(u, node, row->input);
}

void upgrade_defaults(struct upgrade *u)
{
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e))
        for (size_t i = 0; upgrade_is_node(u, e) && i < sizeof old_defaults / sizeof *old_defaults;
             i++) {
            const struct old_default *row = &old_defaults[i];
            if (!counts(u, e, row))
                continue;
            upgrade_add_input(u, e, row->input, upgrade_word(u, row->input_type),
                              upgrade_word(u, row->value));
            upgrade_note(u, e, "the default of '%s' was %s", row->input, row->value);
        }
}
