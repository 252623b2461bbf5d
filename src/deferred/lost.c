// SPDX-License-Identifier: Apache-2.0
/* Tells what a payload or a decal has no room for: nothing goes silently. */
#include "deferred/deferred_priv.h"

enum form { PAYLOAD = 1, DECAL = 2 };

static const struct {
    enum mark_operand operand;
    unsigned forms;
    const char *part; /* the input of a slab */
} parts[] = {
    {MARK_glint_density, PAYLOAD | DECAL, "glint_density"},
    {MARK_tint_weight, PAYLOAD | DECAL, "specular_lut"},
    {MARK_fuzz_amount, DECAL, "fuzz_amount"},
    {MARK_anisotropy, DECAL, "anisotropy"},
    {MARK_second_roughness_weight, DECAL, "second_roughness_weight"},
    {MARK_free_path, DECAL, "mean_free_path"},
    {MARK_f90, DECAL, "f90"},
};

bool deferred_has_part(const struct ir_graph *g, ir_ref mark, enum mark_operand operand)
{
    return !ir_const_is(g, ir_arg(g, mark, operand), operand == MARK_f90 ? 1.0f : 0.0f);
}

static const char why_decal[] = "images of decals have diffuse_albedo, f0, normal and roughness";

static void note(struct shader *shader, ir_ref at, const char *part, const char *why)
{
    struct shader_lost lost = {ir_get(shader->graph, at)->origin, part, why};
    vec_push(shader->arena, &shader->reflection.lost, lost);
}

void deferred_note_lost(struct shader *shader, const struct deferred_layout *layout,
                        const struct closure_list *all, const struct closure_list *marks)
{
    const struct ir_graph *g = shader->graph;
    enum form form = deferred_is_decal(layout) ? DECAL : PAYLOAD;
    const char *why = form == DECAL ? why_decal : "a payload has no room for it";
    ir_ref backlight = deferred_backlight(shader, all);
    if (layout->role->returns != RETURNS_PAYLOAD)
        return;
    if (backlight)
        note(shader, backlight, "thin", "no light comes from behind what is stored");
    for (uint32_t i = 0; i < marks->leaves.len; i++)
        for (size_t k = 0; k < sizeof parts / sizeof *parts; k++) {
            ir_ref mark = marks->leaves.items[i].leaf;
            if (!(parts[k].forms & form) || !deferred_has_part(g, mark, parts[k].operand))
                continue;
            note(shader, mark, parts[k].part, why);
        }
}

void deferred_note_lost_light(struct shader *shader, ir_ref emission)
{
    if (emission && !ir_const_is(shader->graph, emission, 0.0f))
        note(shader, emission, "emission", why_decal);
}

void deferred_note_lost_weight(struct shader *shader, ir_ref mark, const char *part)
{
    note(shader, mark, part, "a sum of equal slabs has more of it than 1, which is the most");
}
