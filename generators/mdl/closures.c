// SPDX-License-Identifier: Apache-2.0
/*
 * The effects of a material: its parts, as outputs. Every node is older than its users, so one pass
 * upwards rewrites the tree.
 */
#include "generators/mdl/closure_tree.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"

#include <math.h>

static const double HALF_PI = 1.57079632679489661923;

/* ---- Layers ---- */

/*
 * The light that a closure lets through at an angle from its normal. No material knows the view, so
 * the normals of all leaves become the z axis, and the view a constant.
 */
static ir_ref through_at(struct mdl_tree *t, ir_ref top, double angle)
{
    struct ir_graph *g = t->graph;
    struct closure_point *point = t->host->point;
    ir_ref view = point->view;
    union ir_word z[3] = {[2] = {.f = 1.0f}},
                  v[3] = {{.f = (float)sin(angle)}, {.f = 0.0f}, {.f = (float)cos(angle)}};
    ir_ref axis = ir_const_words(g, IR_TYPE_VEC3, z);
    point->view = ir_const_words(g, IR_TYPE_VEC3, v);
    ir_ref through =
        closure_throughput(t->shader, t->host, top, closure_way(t->shader, t->host, point->view));
    point->view = view;
    through = ir_replace(g, through, closure_normal(t->shader, t->host), axis, t->shader->arena);
    const uint8_t *below = ir_mark(g, &top, 1, t->shader->arena);
    for (ir_ref ref = 1; ref <= top; ref++) {
        ir_ref normal =
            below[ref] && ir_get(g, ref)->op == IR_LEAF ? mdl_leaf_input(t, ref, "normal") : 0;
        if (normal)
            through = ir_replace(g, through, normal, axis, t->shader->arena);
    }
    return ir_convert(g, IR_TYPE_VEC3, through);
}

/* The base has the weight that the top leaves at each angle. */
static ir_ref over_any(struct mdl_tree *t, ir_ref top, ir_ref base)
{
    ir_ref through[MDL_ANGLES];
    for (unsigned i = 0; i < MDL_ANGLES; i++)
        through[i] = through_at(t, top, HALF_PI * i / (MDL_ANGLES - 1));
    return mdl_sum(t, t->of[top].bsdf, mdl_attenuated(t, base, through));
}

enum { MAX_DEPTH = 32 };

/* A mix lies over a base as each of its sides does, and a layer as its top over its base. */
static ir_ref over(struct mdl_tree *t, ir_ref top, ir_ref base, unsigned depth)
{
    const struct ir_node node = *ir_get(t->graph, top);
    ir_ref a[3] = {0}, first;
    memcpy(a, ir_args(t->graph, top), (node.num_args < 3 ? node.num_args : 3) * sizeof *a);
    if (!base)
        return t->of[top].bsdf;
    if (depth == MAX_DEPTH)
        return over_any(t, top, base);
    switch (node.op) {
    case IR_LEAF:
        if (!t->of[top].bsdf && !closure_has(t->shader, t->host, top, LEAF_TRANSMITTANCE))
            return base;
        return mdl_leaf_covers(t, top) ? mdl_leaf_over(t, top, base) : over_any(t, top, base);
    case IR_LAYER: return over(t, a[0], over(t, a[1], base, depth + 1), depth + 1);
    case IR_CLOSURE_MIX:
        first = over(t, a[0], base, depth + 1);
        return mdl_mixed(t, first, over(t, a[1], base, depth + 1), a[2]);
    case IR_CLOSURE_SCALE: return mdl_mixed(t, base, over(t, a[0], base, depth + 1), a[1]);
    default: return over_any(t, top, base);
    }
}

static struct mdl_parts layered(struct mdl_tree *t, ir_ref top, ir_ref base)
{
    if (!top || !base)
        return t->of[top ? top : base];
    struct mdl_parts above = t->of[top], below = t->of[base];
    ir_ref bsdf = over(t, top, below.bsdf, 0);
    above.bsdf = below.bsdf = 0;
    if (below.light) { /* by what the top lets through along the normal */
        struct mdl_parts light = {.light = below.light};
        below.light = mdl_parts_scaled(t, light, through_at(t, top, 0.0), false).light;
    }
    struct mdl_parts sum = mdl_parts_sum(t, above, below);
    sum.bsdf = bsdf;
    return sum;
}

/* ---- The tree ---- */

static bool is_volume(ir_type_id type)
{
    return type == IR_TYPE_VOLUME || type == IR_TYPE_VDF;
}

static struct mdl_parts rewrite(struct mdl_tree *t, ir_ref ref)
{
    ir_ref a[4] = {0};
    const struct ir_node *node = ir_get(t->graph, ref);
    if (node->op == IR_LEAF)
        return mdl_leaf(t, ref);
    memcpy(a, ir_args(t->graph, ref), (node->num_args < 4 ? node->num_args : 4) * sizeof *a);
    bool fills = is_volume(node->type);
    switch (node->op) {
    case IR_LAYER: return layered(t, a[0], a[1]);
    case IR_CLOSURE_MIX:
    case IR_SHADER_MIX: return mdl_parts_mixed(t, t->of[a[0]], t->of[a[1]], a[2], fills);
    case IR_CLOSURE_ADD:
    case IR_VOLUME_SHADER: return mdl_parts_sum(t, t->of[a[0]], t->of[a[1]]);
    case IR_CLOSURE_SCALE: return mdl_parts_scaled(t, t->of[a[0]], a[1], fills);
    case IR_LIGHT_SHADER:
        return mdl_parts_scaled(t, t->of[a[0]], FORMULA(t->shader, "mx_exposed", a[1], a[2]),
                                false);
    default: return (struct mdl_parts){0};
    }
}

static struct mdl_parts parts_of(struct mdl_tree *t, ir_ref root)
{
    if (!root)
        return (struct mdl_parts){0};
    t->of = ARENA_ARRAY(t->shader->arena, struct mdl_parts, root + 1);
    const uint8_t *needed = ir_mark(t->graph, &root, 1, t->shader->arena);
    for (ir_ref ref = 1; ref <= root; ref++) {
        if (!needed[ref] || !(ir_get(t->graph, ref)->flags & IR_NODE_CLOSURE))
            continue;
        if (ir_get(t->graph, ref)->op == IR_LEAF)
            shader_add_closure(t->shader, ref);
        ir_push_origin_of(t->graph, ref);
        t->of[ref] = rewrite(t, ref);
        ir_pop_origin(t->graph);
    }
    return t->of[root];
}

/* ---- Surfaces ---- */

/* The parts of a surface and its alpha, 0: 1. */
static struct mdl_parts surface_parts(struct mdl_tree *t, const struct closure_surface *s)
{
    struct mdl_parts parts = parts_of(t, s->bsdf);
    parts = mdl_parts_sum(t, parts, parts_of(t, s->edf));
    struct mdl_parts glow = {0};
    if (s->unlit)
        glow.light = mdl_light(t, 0, ir_convert(t->graph, IR_TYPE_VEC3, s->unlit));
    return mdl_parts_sum(t, parts, glow);
}

/*
 * Where the parts have the weight of the alpha already, or the surface is seen through in a colour,
 * light goes straight on in that colour; otherwise the alpha cuts the geometry.
 */
static struct mdl_parts with_alpha(struct mdl_tree *t, const struct closure_surface *s,
                                   struct mdl_parts parts, ir_ref *out_cutout)
{
    bool is_opaque = !s->alpha || ir_const_is(t->graph, s->alpha, 1.0f);
    *out_cutout = 0;
    if (is_opaque && !s->through)
        return parts;
    t->shader->reflection.transparent = true;
    if (!s->premultiplied && !s->through && !s->is_matter) {
        *out_cutout = s->alpha;
        return parts;
    }
    ir_ref through = closure_surface_through(t->graph, s);
    through = ir_convert(t->graph, IR_TYPE_VEC3, through);
    if (!ir_const_is(t->graph, through, 0.0f))
        parts.bsdf = mdl_sum(t, parts.bsdf, mdl_transparent(t, through));
    return parts;
}

/* All layers of a stack, weighted, and what is left is transparent. */
static struct mdl_parts blended(struct mdl_tree *t, ir_ref slots)
{
    struct ir_graph *g = t->graph;
    const struct closure_surface *layers = closure_slot_surfaces(t->shader, t->host, slots);
    struct mdl_parts sum = {0};
    ir_ref alpha = ir_arg(g, slots, 0);
    for (unsigned i = 0; i < ir_num_slots(g, slots); i++) {
        struct ir_slot slot = ir_slot(g, slots, i);
        if (!slot.surface || ir_slot_is_vertical(g, &slot) || ir_const_is(g, slot.weight, 0.0f))
            continue;
        struct closure_surface layer = closure_weighted(g, layers[i], slot.weight);
        sum = mdl_parts_sum(t, sum, surface_parts(t, &layer));
    }
    if (ir_const_is(g, alpha, 1.0f))
        return sum;
    t->shader->reflection.transparent = true;
    ir_ref through = ir_convert(g, IR_TYPE_VEC3, ir_one_minus(g, alpha));
    sum.bsdf = mdl_sum(t, sum.bsdf, mdl_transparent(t, through));
    return sum;
}

static struct mdl_parts side_parts(struct mdl_tree *t, ir_ref surface, ir_ref *out_cutout)
{
    *out_cutout = 0;
    if (!surface)
        return (struct mdl_parts){0};
    if (ir_get(t->graph, surface)->op == IR_SLOTS)
        return blended(t, closure_shade_slots(t->shader, surface, 0));
    ir_type_id type = ir_type_of(t->graph, surface);
    if (type != IR_TYPE_SURFACE)
        return parts_of(t, surface);
    struct closure_surface s = closure_surface_of(t->shader, t->host, surface);
    return with_alpha(t, &s, surface_parts(t, &s), out_cutout);
}

/* ---- Effects ---- */

static void put(struct mdl_tree *t, enum mdl_part part, ir_type_id type, ir_ref value)
{
    if (!value)
        return;
    str_id name = str_intern_z(t->shader->strings, mdl_part_names[part]);
    struct shader_variable variable = {
        .name = name, .semantic = name, .block = BLOCK_OUTPUTS, .type = type};
    uint32_t index = shader_add_variable(t->shader, &variable);
    shader_effect(t->shader, STAGE_PIXEL,
                  (struct effect){.kind = EFFECT_OUTPUT, .index = index, .value = value});
}

static ir_ref even_emission(struct mdl_tree *t)
{
    return mdl_call(t, "df::diffuse_edf()", IR_TYPE_EDF, NULL, 0);
}

/* One edf and its colour; of several edfs the sum, each in its colour. */
static void put_light(struct mdl_tree *t, const struct mdl_light *light, enum mdl_part part)
{
    struct ir_graph *g = t->graph;
    ir_ref sum = 0, intensity = light ? ir_scaled(g, light->radiance, (float)(2.0 * HALF_PI)) : 0;
    for (const struct mdl_light *at = light; at; at = at->next) {
        ir_ref args[3] = {ir_scaled(g, at->radiance, (float)(2.0 * HALF_PI)),
                          at->edf ? at->edf : even_emission(t), sum};
        bool is_only = !sum && !at->next;
        sum = is_only ? args[1]
                      : mdl_call(t,
                                 sum ? "df::color_unbounded_mix(df::color_edf_component[]("
                                       "df::color_edf_component(color($0), $1), "
                                       "df::color_edf_component(color(1.0), $2)))"
                                     : "df::color_unbounded_mix(df::color_edf_component[]("
                                       "df::color_edf_component(color($0), $1)))",
                                 IR_TYPE_EDF, args, sum ? 3 : 2);
        if (!is_only)
            intensity = ir_white(g);
    }
    put(t, part, IR_TYPE_EDF, sum);
    put(t, part + 1, IR_TYPE_VEC3, intensity);
}

/* Coefficients are per metre. */
static ir_ref per_metre(struct mdl_tree *t, ir_ref coefficient)
{
    str_id name = str_intern_z(t->shader->strings, "u_sceneUnitsPerMeter");
    uint32_t units = shader_private_uniform(t->shader, name, IR_TYPE_FLOAT, 0);
    return coefficient ? ir_mul(t->graph, coefficient, shader_read(t->shader, units)) : 0;
}

static void put_volume(struct mdl_tree *t, const struct mdl_parts *parts)
{
    if (parts->scattering) {
        ir_ref bias = parts->anisotropy ? parts->anisotropy : ir_const_float(t->graph, 0.0f);
        put(t, MDL_VOLUME, IR_TYPE_VDF,
            mdl_call(t, "df::anisotropic_vdf(directional_bias: $0)", IR_TYPE_VDF, &bias, 1));
    }
    put(t, MDL_ABSORPTION, IR_TYPE_VEC3, per_metre(t, parts->absorption));
    put(t, MDL_SCATTER, IR_TYPE_VEC3, per_metre(t, parts->scattering));
}

static ir_ref thin_walled(struct mdl_tree *t, ir_ref surface)
{
    struct ir_value value;
    surface = surface ? closure_without_aovs(t->graph, surface) : 0;
    ir_ref thin = surface && ir_get(t->graph, surface)->op == IR_SURFACE_SHADER
                      ? ir_arg(t->graph, surface, 3)
                      : 0;
    bool is_false = !thin || (ir_get_const(t->graph, thin, &value) && value.w[0].u == 0);
    return is_false ? 0 : thin;
}

static void emit_sides(struct mdl_tree *t, ir_ref front, ir_ref back)
{
    ir_ref cutout, none;
    struct mdl_parts parts = side_parts(t, front, &cutout), behind = side_parts(t, back, &none);
    bool fills = front && is_volume(ir_type_of(t->graph, front));
    if (fills) /* a volume has no surface of its own: light enters it straight on */
        parts.bsdf = mdl_transparent(t, ir_white(t->graph));
    put(t, MDL_SCATTERING, IR_TYPE_BSDF, parts.bsdf);
    put_light(t, fills ? NULL : parts.light, MDL_EMISSION);
    put(t, MDL_BACK_SCATTERING, IR_TYPE_BSDF, behind.bsdf);
    put_light(t, behind.light, MDL_BACK_EMISSION);
    /* only a thin wall has another side */
    put(t, MDL_THIN_WALLED, IR_TYPE_BOOL,
        back ? ir_const_bool(t->graph, true) : thin_walled(t, front));
    put(t, MDL_IOR, IR_TYPE_VEC3, t->ior);
    put_volume(t, &parts);
    if (fills && parts.light)
        put(t, MDL_VOLUME_INTENSITY, IR_TYPE_VEC3, per_metre(t, parts.light->radiance));
    put(t, MDL_OPACITY, IR_TYPE_FLOAT, cutout);
    put(t, MDL_HAIR, IR_TYPE_BSDF, parts.hair);
}

static void emit_displacement(struct mdl_tree *t, ir_ref displacement)
{
    ir_ref offset = displacement ? closure_offset(t->shader, displacement) : 0;
    if (!offset)
        return;
    t->shader->reflection.displaced = true;
    put(t, MDL_DISPLACEMENT, IR_TYPE_VEC3, offset);
}

/* A value that is no closure is light. */
static bool emit_value(struct mdl_tree *t, ir_ref root)
{
    struct ir_graph *g = t->graph;
    ir_type_id type = ir_type_of(g, root);
    bool is_number = type < IR_NUM_TYPES && type != IR_TYPE_VOID && type != IR_TYPE_STRING
                     && type != IR_TYPE_SAMPLER && type != IR_TYPE_SAMPLER_ARRAY
                     && !ir_type_is_matrix(type);
    if (!is_number)
        return false;
    ir_ref parts[3];
    unsigned n = ir_type_info(type)->components;
    for (unsigned i = 0; i < 3; i++) {
        ir_ref part = n == 1 ? root : i < n ? ir_component(g, root, i) : ir_const_float(g, 0.0f);
        parts[i] = ir_convert(g, IR_TYPE_FLOAT, part);
    }
    ir_ref color = type == IR_TYPE_VEC3 ? root : ir_construct(g, IR_TYPE_VEC3, parts, 3);
    put_light(t, mdl_light(t, 0, color), MDL_EMISSION);
    return true;
}

/* ---- Hook ---- */

/* A step becomes sharp without derivatives, but a height has no normal. */
static bool needs_slopes(const struct mdl_tree *t, ir_ref call)
{
    const struct lang_function *fn =
        lang_function(t->shader->unit, shader_callee(t->shader, call), NULL);
    return strcmp(str_text(t->shader->strings, fn->name), "mx_slopes_to_normal") == 0
           || strcmp(str_text(t->shader->strings, fn->name), "mx_heighttonormal") == 0;
}

/* Names something that the effects read and a material cannot have; NULL: all is there. */
static const char *missing(struct mdl_tree *t)
{
    const struct effect_list *effects = &t->shader->stages[STAGE_PIXEL].effects;
    for (uint32_t i = 0; i < effects->len; i++) {
        ir_ref root = effects->items[i].value;
        const uint8_t *needed = ir_mark(t->graph, &root, 1, t->shader->arena);
        for (ir_ref ref = 1; ref <= root; ref++) {
            const struct ir_node *node = ir_get(t->graph, ref);
            if (needed[ref] && node->op == IR_CALL && needs_slopes(t, ref))
                return "no slopes of a height, which need derivatives";
            if (!needed[ref] || node->op != IR_UNIFORM)
                continue;
            const struct shader_variable *v = &t->shader->interface.variables.items[node->attr];
            const char *semantic = str_text(t->shader->strings, v->semantic);
            if (v->block == BLOCK_PRIVATE_UNIFORMS && mdl_lacks_uniform(semantic))
                return mdl_lacks(t, "no %s where a material is evaluated", semantic);
        }
    }
    return NULL;
}

static bool emit(struct shader *shader, const struct closure_host *host, ir_ref root,
                 const char **out_lacks)
{
    struct mdl_tree t = {.shader = shader, .graph = shader->graph, .host = host};
    struct closure_sides sides = closure_sides_of(t.graph, root);
    bool is_good = true;
    emit_displacement(&t, sides.displacement);
    ir_type_id type = sides.front ? ir_type_of(t.graph, sides.front) : IR_TYPE_SURFACE;
    if (!ir_type_is_closure(type) && !ir_type_is_shader(type))
        is_good = emit_value(&t, sides.front);
    else
        emit_sides(&t, sides.front, sides.back);
    shader->reflection.kind = is_volume(type) ? SHADER_VOLUME : SHADER_SURFACE;
    t.lacks = t.lacks ? t.lacks : missing(&t);
    *out_lacks = t.lacks;
    return is_good && !t.lacks;
}

const struct target_closures mdl_closures = {.lacks_view = true, .emit = emit};
