// SPDX-License-Identifier: Apache-2.0
/* Combines closures: sums, factors, mixes. Constants simplify the result. */
#include "generators/mdl/closure_tree.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"

#include <assert.h>

ir_ref mdl_call(struct mdl_tree *t, const char *form, ir_type_id type, const ir_ref *args,
                unsigned n)
{
    assert(ir_type_is_closure(type) && strchr(form, '('));
    str_id id = str_intern_z(t->shader->strings, form);
    uint32_t callee = ir_add_callee(
        t->graph, (struct ir_callee){.kind = IR_CALLEE_CLOSURE, .index = id, .name = id});
    return ir_build(t->graph, IR_LEAF, type, callee, args, n);
}

const char *mdl_lacks(struct mdl_tree *t, const char *format, const char *name)
{
    struct text text;
    text_init(&text, t->shader->arena);
    text_fmt(&text, format, name);
    return text_cstr(&text);
}

static bool is_float(const struct mdl_tree *t, ir_ref value)
{
    return ir_type_of(t->graph, value) == IR_TYPE_FLOAT;
}

ir_ref mdl_transparent(struct mdl_tree *t, ir_ref color)
{
    return mdl_call(t, "df::specular_bsdf(tint: color($0), mode: df::scatter_transmit)",
                    IR_TYPE_BSDF, &color, 1);
}

ir_ref mdl_scaled(struct mdl_tree *t, ir_ref bsdf, ir_ref factor)
{
    if (!bsdf || !factor || ir_const_is(t->graph, factor, 1.0f))
        return bsdf;
    if (ir_const_is(t->graph, factor, 0.0f))
        return 0;
    ir_ref args[2] = {factor, bsdf};
    return mdl_call(t, MDL_TINT "tint: color($0), base: $1)", IR_TYPE_BSDF, args, 2);
}

ir_ref mdl_sum(struct mdl_tree *t, ir_ref a, ir_ref b)
{
    ir_ref args[2] = {a, b};
    if (!a || !b)
        return a ? a : b;
    return mdl_call(t,
                    "df::unbounded_mix(df::bsdf_component[](df::bsdf_component(1.0, $0), "
                    "df::bsdf_component(1.0, $1)))",
                    IR_TYPE_BSDF, args, 2);
}

ir_ref mdl_mixed(struct mdl_tree *t, ir_ref bg, ir_ref fg, ir_ref mix)
{
    struct ir_graph *g = t->graph;
    if (ir_const_is(g, mix, 0.0f) || bg == fg)
        return bg;
    if (ir_const_is(g, mix, 1.0f))
        return fg;
    if (!fg)
        return mdl_scaled(t, bg, ir_one_minus(g, mix));
    ir_ref args[3] = {mix, fg, bg};
    if (is_float(t, mix))
        return mdl_call(t,
                        bg ? "df::weighted_layer(weight: $0, layer: $1, base: $2)"
                           : "df::weighted_layer(weight: $0, layer: $1)",
                        IR_TYPE_BSDF, args, bg ? 3 : 2);
    return mdl_call(t,
                    bg ? "df::color_weighted_layer(weight: color($0), layer: $1, base: $2)"
                       : "df::color_weighted_layer(weight: color($0), layer: $1)",
                    IR_TYPE_BSDF, args, bg ? 3 : 2);
}

ir_ref mdl_attenuated(struct mdl_tree *t, ir_ref base, const ir_ref *through)
{
    static const char *const names[MDL_ANGLES] = {"passed_at_0_degrees",  "passed_at_15_degrees",
                                                  "passed_at_30_degrees", "passed_at_45_degrees",
                                                  "passed_at_60_degrees", "passed_at_75_degrees",
                                                  "passed_at_90_degrees"};
    ir_ref args[MDL_ANGLES + 1];
    bool all_white = true, all_black = true;
    for (unsigned i = 0; i < MDL_ANGLES; i++) {
        args[i] = through[i];
        ir_suggest_name(t->graph, args[i], str_intern_z(t->shader->strings, names[i]),
                        IR_NAME_COPY);
        all_white &= ir_const_is(t->graph, through[i], 1.0f);
        all_black &= ir_const_is(t->graph, through[i], 0.0f);
    }
    if (!base || all_white || all_black)
        return all_black ? 0 : base;
    args[MDL_ANGLES] = base;
    return mdl_call(t,
                    "df::measured_curve_factor(curve_values: color[](color($0), color($1), "
                    "color($2), color($3), color($4), color($5), color($6)), base: $7)",
                    IR_TYPE_BSDF, args, MDL_ANGLES + 1);
}

/* ---- Parts ---- */

const struct mdl_light *mdl_light(struct mdl_tree *t, ir_ref edf, ir_ref radiance)
{
    if (!radiance || ir_const_is(t->graph, radiance, 0.0f))
        return NULL;
    struct mdl_light *light = ARENA_NEW(t->shader->arena, struct mdl_light);
    *light = (struct mdl_light){edf, radiance, NULL};
    return light;
}

static const struct mdl_light *lights_scaled(struct mdl_tree *t, const struct mdl_light *light,
                                             ir_ref factor)
{
    struct mdl_light *first = NULL, **last = &first;
    for (; light; light = light->next) {
        struct mdl_light *scaled = ARENA_NEW(t->shader->arena, struct mdl_light);
        *scaled = (struct mdl_light){light->edf, ir_mul(t->graph, light->radiance, factor), NULL};
        *last = scaled;
        last = &scaled->next;
    }
    return first;
}

/* Lights of one edf are one light. */
static const struct mdl_light *lights_sum(struct mdl_tree *t, const struct mdl_light *a,
                                          const struct mdl_light *b)
{
    for (; b; b = b->next) {
        ir_ref sum = b->radiance;
        struct mdl_light *rest = NULL;
        for (const struct mdl_light *light = a; light; light = light->next) {
            struct mdl_light *kept = ARENA_NEW(t->shader->arena, struct mdl_light);
            *kept = (struct mdl_light){light->edf, light->radiance, rest};
            if (light->edf == b->edf)
                sum = ir_add(t->graph, light->radiance, sum);
            else
                rest = kept;
        }
        struct mdl_light *whole = ARENA_NEW(t->shader->arena, struct mdl_light);
        *whole = (struct mdl_light){b->edf, sum, rest};
        a = whole;
    }
    return a;
}

static ir_ref times(struct mdl_tree *t, ir_ref value, ir_ref factor)
{
    return value ? ir_mul(t->graph, value, factor) : 0;
}

struct mdl_parts mdl_parts_scaled(struct mdl_tree *t, struct mdl_parts p, ir_ref factor,
                                  bool is_medium)
{
    if (!factor || ir_const_is(t->graph, factor, 1.0f))
        return p;
    p.bsdf = mdl_scaled(t, p.bsdf, factor);
    p.light = lights_scaled(t, p.light, factor);
    p.into = times(t, p.into, is_float(t, factor) ? factor : FORMULA(t->shader, "mx_mean", factor));
    if (is_medium) {
        p.absorption = times(t, p.absorption, factor);
        p.scattering = times(t, p.scattering, factor);
    }
    return p;
}

/* The mean of two anisotropies by what scatters, summed over channels. */
static ir_ref mean_anisotropy(struct mdl_tree *t, const struct mdl_parts *a,
                              const struct mdl_parts *b)
{
    if (!a->anisotropy || !b->anisotropy || a->anisotropy == b->anisotropy)
        return a->anisotropy ? a->anisotropy : b->anisotropy;
    ir_ref share = FORMULA(t->shader, "mx_blend_share", a->scattering, b->scattering);
    return ir_mix(t->graph, a->anisotropy, b->anisotropy, share);
}

/* The media of two ways into a body, each for its part of the light. */
static void share_body(struct mdl_tree *t, struct mdl_parts *a, struct mdl_parts *b)
{
    ir_ref share = FORMULA(t->shader, "mx_blend_share", a->into, b->into),
           rest = ir_one_minus(t->graph, share);
    a->absorption = times(t, a->absorption, rest);
    a->scattering = times(t, a->scattering, rest);
    b->absorption = times(t, b->absorption, share);
    b->scattering = times(t, b->scattering, share);
}

struct mdl_parts mdl_parts_sum(struct mdl_tree *t, struct mdl_parts a, struct mdl_parts b)
{
    /* One statement each: an initializer has no order of evaluation, and the order of ops is that
     * of the shader. */
    struct mdl_parts sum = {.hair = a.hair ? a.hair : b.hair};
    sum.bsdf = mdl_sum(t, a.bsdf, b.bsdf);
    sum.light = lights_sum(t, a.light, b.light);
    sum.into = ir_sum(t->graph, a.into, b.into);
    if (a.into && b.into)
        share_body(t, &a, &b);
    sum.absorption = ir_sum(t->graph, a.absorption, b.absorption);
    sum.scattering = ir_sum(t->graph, a.scattering, b.scattering);
    sum.anisotropy = mean_anisotropy(t, &a, &b);
    return sum;
}

struct mdl_parts mdl_parts_mixed(struct mdl_tree *t, struct mdl_parts bg, struct mdl_parts fg,
                                 ir_ref mix, bool is_medium)
{
    ir_ref bsdf = mdl_mixed(t, bg.bsdf, fg.bsdf, mix);
    ir_ref into = bg.into == fg.into ? bg.into : 0; /* of closures that differ in a film alone */
    bg.bsdf = fg.bsdf = 0;
    struct mdl_parts behind = mdl_parts_scaled(t, bg, ir_one_minus(t->graph, mix), is_medium);
    struct mdl_parts before = mdl_parts_scaled(t, fg, mix, is_medium);
    struct mdl_parts sum = mdl_parts_sum(t, behind, before);
    sum.bsdf = bsdf;
    sum.into = into ? into : sum.into;
    return sum;
}
