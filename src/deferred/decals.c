// SPDX-License-Identifier: Apache-2.0
/*
 * Decals in images of their own (docs/deferred.md): a pixel of an image is what decals put there,
 * and the part of the base that they leave, so decals over each other are blended by the device.
 * Materials read them at their pixel; a payload returns the values that a decal blends in.
 */
#include "deferred/deferred_priv.h"
#include "deferred/texts.h"
#include "shader/formula.h"

#include <assert.h>

enum decal_image { ALBEDO, F0, NORMAL, ROUGHNESS };

/* ---- Images ---- */

static uint32_t add_source(struct shader *shader, const struct deferred_layout *layout)
{
    const struct source_resources resources = {.reads = DEFERRED_DECAL_IMAGES, .set = layout->set};
    struct text text;
    text_init(&text, shader->arena);
    for (uint32_t i = 0; !layout->parse && i < NUM_DECAL_IMAGES; i++)
        deferred_declare((enum deferred_binding)(RESOURCE_DECAL_ALBEDO + i), layout, true, false,
                         &text);
    deferred_write_lines(deferred_decals, false, &text);
    return deferred_add_source(shader, layout, &resources, &text);
}

/* The callee of passes/decals.glsl; the first base adds it. */
static uint32_t callee(struct shader *shader, const struct deferred_layout *layout)
{
    str_id name = str_intern_z(shader->strings, "mx_decal");
    const struct ir_graph *g = shader->graph;
    for (uint32_t i = 0; i < g->callees.len; i++)
        if (g->callees.items[i].kind == IR_CALLEE_VERBATIM && g->callees.items[i].name == name)
            return i;
    return deferred_callee(shader, name, add_source(shader, layout));
}

static str_id name_of(const struct shader *shader, enum decal_image image)
{
    enum deferred_binding binding = (enum deferred_binding)(RESOURCE_DECAL_ALBEDO + image);
    return str_intern_z(shader->strings, deferred_resource(binding)->name);
}

/* A function has no pixel to read at: the caller gives it the values. */
static ir_ref decal_at(struct shader *shader, const struct deferred_layout *layout,
                       enum decal_image image)
{
    struct ir_graph *g = shader->graph;
    str_id name = name_of(shader, image);
    if (layout->role->returns == RETURNS_WORDS)
        return deferred_given(shader, name, IR_TYPE_VEC4);
    const char *value = str_text(shader->strings, name) + strlen("decal_");
    ir_ref number = ir_const_int(g, (int)image);
    ir_push_name(g, str_intern_z(shader->strings, value)); /* "f0_decal" */
    ir_ref pixel = ir_build(g, IR_VERBATIM, IR_TYPE_VEC4, callee(shader, layout), &number, 1);
    ir_pop_origin(g);
    return pixel;
}

/* ---- Bases ---- */

/* Decals change operands of a mark by a formula and an image, which may have such a value itself.
 */
static const struct {
    enum mark_operand operand;
    enum decal_image image;
    bool is_in_image;
    const char *formula;
} changes[] = {
    {MARK_diffuse_albedo, ALBEDO, true, "mx_decal_over"},
    {MARK_f0, F0, true, "mx_decal_over"},
    {MARK_normal, NORMAL, true, "mx_decal_normal"},
    {MARK_roughness, ROUGHNESS, true, "mx_decal_over"},
    {MARK_free_path, ALBEDO, false, "mx_decal_left"},
    {MARK_fuzz_amount, ALBEDO, false, "mx_decal_left"},
    {MARK_f90, F0, false, "mx_decal_hue"},
    {MARK_tint_weight, F0, false, "mx_decal_left"},
    {MARK_anisotropy, ROUGHNESS, false, "mx_decal_left"},
    {MARK_second_roughness_weight, ROUGHNESS, false, "mx_decal_left"},
    {MARK_glint_density, ROUGHNESS, false, "mx_decal_glints"},
};

static ir_ref painted_mark(struct shader *shader, const struct deferred_layout *layout, ir_ref mark)
{
    struct ir_graph *g = shader->graph;
    const struct ir_node node = *ir_get(g, mark);
    ir_ref args[NUM_MARK_OPERANDS];
    assert(node.num_args == NUM_MARK_OPERANDS);
    memcpy(args, ir_args(g, mark), sizeof args);
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        ir_ref *value = &args[changes[i].operand];
        if (changes[i].is_in_image || deferred_has_part(g, mark, changes[i].operand))
            *value = FORMULA(shader, changes[i].formula, *value,
                             decal_at(shader, layout, changes[i].image));
    }
    return ir_build(g, IR_LEAF, node.type, node.attr, args, NUM_MARK_OPERANDS);
}

ir_ref deferred_painted(struct shader *shader, const struct closure_host *host, ir_ref base)
{
    struct ir_graph *g = shader->graph;
    bool has_lobes = ir_get(g, base)->op == IR_LAYER;
    ir_ref args[2] = {has_lobes ? ir_arg(g, base, 0) : base, has_lobes ? ir_arg(g, base, 1) : 0};
    if (!deferred_is_mark(shader, args[0]))
        return base;
    args[0] = painted_mark(shader, host->store_data, args[0]);
    return has_lobes ? ir_build(g, IR_LAYER, IR_TYPE_BSDF, 0, args, 2) : args[0];
}

ir_ref deferred_painted_light(struct shader *shader, const struct deferred_layout *layout,
                              ir_ref emission)
{
    if (!emission || !layout->has_decals || layout->role->returns == RETURNS_PAYLOAD)
        return emission;
    ir_ref light = ir_convert(shader->graph, IR_TYPE_VEC3, emission);
    ir_ref decal = decal_at(shader, layout, ALBEDO);
    return FORMULA(shader, "mx_decal_left", light, decal);
}

/* ---- Decals ---- */

static void put(struct shader *shader, enum decal_image image, ir_ref pixel)
{
    uint32_t output = shader_output(shader, name_of(shader, image), IR_TYPE_VEC4);
    deferred_assign(shader, EFFECT_OUTPUT, output, pixel);
}

/* A decal without a slab is black, and leaves normals and roughness as they are. */
static void put_black(struct shader *shader, ir_ref opacity)
{
    struct ir_graph *g = shader->graph;
    ir_ref parts[2] = {ir_black(g), opacity}, black = ir_construct(g, IR_TYPE_VEC4, parts, 2),
           nothing = ir_const_splat(g, IR_TYPE_VEC4, 0.0f);
    put(shader, ALBEDO, black);
    put(shader, F0, black);
    put(shader, NORMAL, nothing);
    put(shader, ROUGHNESS, nothing);
}

void deferred_put_decal(struct shader *shader, ir_ref mark, ir_ref weight, ir_ref opacity,
                        ir_ref usual_normal)
{
    struct ir_graph *g = shader->graph;
    if (!mark) {
        put_black(shader, opacity);
        return;
    }
    ir_ref args[NUM_MARK_OPERANDS], none = ir_const_float(g, 0.0f);
    memcpy(args, ir_args(g, mark), sizeof args);
    ir_ref rough[4] = {ir_mul(g, args[MARK_roughness], opacity), none, none, opacity};
    ir_ref of_normal = args[MARK_normal] == usual_normal ? none : opacity;
    put(shader, ALBEDO,
        FORMULA(shader, "mx_decal_pixel", args[MARK_diffuse_albedo], weight, opacity));
    put(shader, F0, FORMULA(shader, "mx_decal_pixel", args[MARK_f0], weight, opacity));
    put(shader, NORMAL, FORMULA(shader, "mx_decal_pixel_of_normal", args[MARK_normal], of_normal));
    put(shader, ROUGHNESS, ir_construct(g, IR_TYPE_VEC4, rough, 4));
}
