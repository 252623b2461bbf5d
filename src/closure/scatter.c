// SPDX-License-Identifier: Apache-2.0
/*
 * The function that a path tracer calls for a surface: emission, opacity, one sampled direction,
 * and the response to the direction of a light.
 *
 *     out1 = vec4(emission, opacity)
 *     pick = random.w · Σ pᵢ    pᵢ = the mean of wᵢ · (1 + 9 albedoᵢ) / 10,  Pᵢ = pᵢ / Σ pᵢ
 *     for each leaf:
 *         if (0 <= pick < pᵢ) {
 *             L, f cos / pdf, pdf = sample(random.xyz)
 *             weight = wᵢ · f cos / pdf / Pᵢ;  density = Pᵢ · pdf
 *         }
 *         pick -= pᵢ
 *     out2 = vec4(L, is it inside)
 *     out3 = vec4(weight, density)
 *     out4 = vec4(medium, 0), see matter_levels.c for its w
 *     out5 = vec4(Σ wᵢ · evalᵢ(lightWorld.xyz) / (1 + lightWorld.w · Pᵢ · pdfᵢ(lightWorld.xyz)), 0)
 *     out6, out7: one of the bound lights, see light_up
 *     for each BSDF of an AOV: what stands in out3, out5 and out7, for that BSDF
 *
 * The BSDF of an AOV is another *part* of the light, with weights of its own for the same leaves
 * and for further ones. All parts share directions, and a leaf is picked for its greatest weight.
 *
 * The code picks one leaf. The weight of its sample is the response of this leaf alone, divided by
 * the chance to pick it, so the expectation is the sum of all leaves (Pharr, Jakob, Humphreys,
 * "Physically Based Rendering", section 2.2.3, on a discrete choice). The densities of other leaves
 * have no effect, so lobes may be as sharp as mirrors; and weights stay near Σ pᵢ, because a leaf's
 * own sample is near its albedo.
 *
 * The balance heuristic (Veach and Guibas 1995, "Optimally Combining Sampling Techniques") weighs
 * light samples against these directions, for each leaf by itself: lightWorld.w is 1 / the density
 * of the light's direction, and 0 for a point light. Light that enters a solid meets the other side
 * of the solid first, so lights do not shine through it: there density is 0 and out5 black. Inside
 * of a solid the light of a point comes through the surface; that of the environment meets paths
 * that go out.
 */
#include "closure/scatter.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"

#include <assert.h>

void scatter_effect(struct closure_scatter *s, enum effect_kind kind, uint32_t index, ir_ref value)
{
    value = closure_in_loop(&s->copies, value);
    shader_effect(s->shader, STAGE_PIXEL,
                  (struct effect){.kind = (uint8_t)kind, .index = index, .value = value});
}

uint32_t scatter_local(struct closure_scatter *s, str_id name, ir_ref value)
{
    uint32_t index = shader_add_local(s->shader, name, ir_type_of(s->graph, value));
    scatter_effect(s, EFFECT_VAR, index, value);
    return index;
}

/* A local of a part: "weight", or "NAME_weight" for the AOV NAME. */
static uint32_t part_local(struct closure_scatter *s, uint32_t part, str_id name, ir_ref value)
{
    struct strpool *strings = s->shader->strings;
    struct text text;
    if (part == 0)
        return scatter_local(s, name, value);
    text_init(&text, s->shader->arena);
    str_id aov = s->shader->interface.aovs.items[s->parts[part].aov].name;
    text_fmt(&text, "%s_%s", str_text(strings, aov), str_text(strings, name));
    return scatter_local(s, str_intern(strings, text.data, text.len), value);
}

ir_ref scatter_read(struct closure_scatter *s, uint32_t index)
{
    assert(index < s->shader->effects.locals.len);
    return ir_build(s->graph, IR_LOCAL, s->shader->effects.locals.items[index].type, index, NULL,
                    0);
}

ir_ref scatter_number(struct closure_scatter *s, float value)
{
    return ir_const_float(s->graph, value);
}

ir_ref scatter_grey(struct closure_scatter *s, float value)
{
    return ir_const_splat(s->graph, IR_TYPE_VEC3, value);
}

ir_ref scatter_op2(struct closure_scatter *s, enum ir_op op, ir_ref a, ir_ref b)
{
    return ir_op2(s->graph, op, a, b);
}

ir_ref scatter_both(struct ir_graph *g, ir_ref a, ir_ref b)
{
    return a && b ? ir_op2(g, IR_LAND, a, b) : a ? a : b;
}

ir_ref scatter_named(struct closure_scatter *s, ir_ref value, const char *name)
{
    ir_suggest_name(s->graph, value, str_intern_z(s->shader->strings, name), IR_NAME_ROLE);
    return value;
}

ir_ref scatter_mean_of(struct closure_scatter *s, ir_ref color)
{
    return FORMULA(s->shader, "mx_mean", color);
}

ir_ref scatter_likely(struct closure_scatter *s, ir_ref albedo)
{
    return FORMULA(s->shader, "mx_sampled_share", albedo);
}

ir_ref scatter_balanced(struct closure_scatter *s, ir_ref value, ir_ref density, ir_ref solid_angle)
{
    return FORMULA(s->shader, "mx_balanced", value, density, solid_angle);
}

/* The weight for light on a way through the media above. */
static ir_ref weight_along(struct closure_scatter *s, const struct closure_leaf *leaf, ir_ref way)
{
    ir_ref weight = ir_product(s->graph, closure_weight(s->shader, leaf, way), s->scale);
    closure_name(s->shader, weight, leaf->leaf, "weight");
    return ir_convert(s->graph, IR_TYPE_VEC3, weight);
}

/* The weight for light from a direction. */
static ir_ref weight_from(struct closure_scatter *s, const struct closure_leaf *leaf,
                          ir_ref direction)
{
    return weight_along(s, leaf, leaf->decay ? closure_way(s->shader, s->host, direction) : 0);
}

static bool has(const struct closure_scatter *s, ir_ref leaf, enum leaf_function which)
{
    return closure_has(s->shader, s->host, leaf, which);
}

bool scatter_refracts(struct closure_scatter *s, ir_ref leaf)
{
    ir_ref any = closure_view(s->shader, s->host);
    ir_ref refraction = has(s, leaf, LEAF_REFRACTION)
                            ? closure_call(s->shader, s->host, leaf, LEAF_REFRACTION, &any)
                            : 0;
    return refraction && !ir_const_is(s->graph, refraction, 0.0f);
}

/*
 * p of a leaf in a part: the chance to pick it times the sum of all p. It follows the scattered
 * light, so that paths keep their weight. An albedo covers only reflection; refraction loses no
 * light.
 */
static ir_ref share_of(struct closure_scatter *s, const struct closure_leaf *leaf)
{
    ir_ref albedo = closure_call(s->shader, s->host, leaf->leaf, LEAF_ALBEDO, NULL),
           light = weight_along(s, leaf, scatter_number(s, CLOSURE_MEAN_WAY));
    if (ir_type_of(s->graph, leaf->leaf) == IR_TYPE_VDF) {
        ir_ref scattering = closure_call(s->shader, s->host, leaf->leaf, LEAF_SCATTERING, NULL);
        light = scattering ? scatter_op2(s, IR_MUL, light, scattering) : scatter_grey(s, 0.0f);
    }
    if (albedo && !scatter_refracts(s, leaf->leaf))
        light = scatter_op2(s, IR_MUL, light,
                            scatter_likely(s, ir_convert(s->graph, IR_TYPE_VEC3, albedo)));
    assert(ir_type_of(s->graph, light) == IR_TYPE_VEC3);
    ir_ref share = FORMULA(s->shader, "mx_brightness", light);
    closure_name(s->shader, share, leaf->leaf, "share");
    return share;
}

/* True if the light from L comes from the visible side. */
ir_ref scatter_is_in_front(struct closure_scatter *s, ir_ref direction)
{
    ir_ref normal = closure_normal(s->shader, s->host), view = closure_view(s->shader, s->host);
    return FORMULA(s->shader, "mx_is_in_front", normal, view, direction);
}

/* The weights of a sample in all parts that have the leaf. */
static void weigh(struct closure_scatter *s, const struct scattering *leaf, ir_ref direction,
                  ir_ref response)
{
    for (uint32_t p = 0; p < s->num_parts; p++) {
        if (!leaf->in[p])
            continue;
        ir_ref weight = scatter_op2(s, IR_MUL, weight_from(s, leaf->in[p], direction), response);
        weight = scatter_op2(s, IR_MUL, weight, scatter_op2(s, IR_DIV, s->total, leaf->share));
        scatter_effect(s, EFFECT_ASSIGN, s->parts[p].weight, weight);
    }
}

void scatter_take_side(struct closure_scatter *s, ir_ref direction, ir_ref medium, ir_ref interior,
                       ir_ref *density)
{
    ir_ref in_front = scatter_is_in_front(s, direction), nothing = scatter_number(s, 0.0f),
           one = scatter_number(s, 1.0f);
    *density = ir_op3(s->graph, IR_SELECT, in_front, *density, nothing);
    ir_ref is_inside = ir_op3(s->graph, IR_SELECT, in_front, nothing, one);
    scatter_effect(s, EFFECT_ASSIGN, s->is_inside, is_inside);
    if (medium)
        scatter_effect(s, EFFECT_ASSIGN, s->medium, ir_convert(s->graph, IR_TYPE_VEC3, medium));
    interior_take(s, interior);
}

static void sample(struct closure_scatter *s, const struct scattering *leaf)
{
    ir_ref pick = scatter_read(s, s->pick), nothing = scatter_number(s, 0.0f);
    ir_ref is_it = scatter_op2(s, IR_GE, pick, nothing);
    is_it = scatter_op2(s, IR_LAND, is_it, scatter_op2(s, IR_LT, pick, leaf->share));
    ir_ref results[3]; /* direction, f cos / pdf, pdf */
    closure_call_all(s->shader, s->host, leaf->leaf, LEAF_SAMPLE, NULL, results);
    scatter_effect(s, EFFECT_IF, 0, is_it);
    scatter_effect(s, EFFECT_ASSIGN, s->direction, results[0]);
    weigh(s, leaf, results[0], results[1]);
    ir_ref density =
        scatter_op2(s, IR_MUL, results[2], scatter_op2(s, IR_DIV, leaf->share, s->total));
    const struct closure_leaf *solid = interior_behind(s, leaf);
    if (has(s, leaf->leaf, LEAF_REFRACTION))
        scatter_take_side(s, results[0], solid ? solid->medium : 0, solid ? solid->interior : 0,
                          &density);
    scatter_effect(s, EFFECT_ASSIGN, s->density, density);
    scatter_effect(s, EFFECT_END, 0, 0);
}

/* The leaf among those of all parts, new or not. */
static struct scattering *find_leaf(struct closure_scatter *s, ir_ref leaf)
{
    for (uint32_t i = 0; i < s->leaves.len; i++)
        if (s->leaves.items[i].leaf == leaf)
            return &s->leaves.items[i];
    struct scattering new_leaf = {
        .leaf = leaf,
        .in = ARENA_ARRAY(s->shader->arena, const struct closure_leaf *, s->num_parts)};
    vec_push(s->shader->arena, &s->leaves, new_leaf);
    return &s->leaves.items[s->leaves.len - 1];
}

static void find_leaves(struct closure_scatter *s)
{
    s->leaves.len = 0;
    for (uint32_t p = 0; p < s->num_parts; p++) {
        const struct closure_list *list = s->parts[p].list;
        for (uint32_t i = 0; i < list->leaves.len; i++)
            find_leaf(s, list->leaves.items[i].leaf)->in[p] = &list->leaves.items[i];
    }
}

static void find_shares(struct closure_scatter *s)
{
    s->total = scatter_number(s, 0.0f);
    for (uint32_t i = 0; i < s->leaves.len; i++) {
        struct scattering *leaf = &s->leaves.items[i];
        ir_ref share = 0;
        for (uint32_t p = 0; p < s->num_parts && has(s, leaf->leaf, LEAF_SAMPLE); p++) {
            ir_ref more = leaf->in[p] ? share_of(s, leaf->in[p]) : 0;
            share = share && more ? scatter_op2(s, IR_MAX, share, more) : share ? share : more;
        }
        if (!share || ir_const_is(s->graph, share, 0.0f))
            continue;
        leaf->share = share;
        s->total = scatter_op2(s, IR_ADD, s->total, share);
        shader_add_closure(s->shader, leaf->leaf);
    }
    if (s->leaves.len > 1) /* else it is the only share */
        scatter_named(s, s->total, "shares");
}

ir_ref scatter_random_number(struct shader *shader)
{
    return ir_component(shader->graph, shader_stream(shader, STR_random, IR_TYPE_VEC4), 3);
}

void scatter_declare_locals(struct closure_scatter *s, ir_ref pick)
{
    s->pick = scatter_local(s, STR_pick, pick);
    s->direction = scatter_local(s, STR_L, scatter_grey(s, 0.0f));
    s->is_inside = scatter_local(s, STR_inside, scatter_number(s, 0.0f));
    for (uint32_t p = 0; p < s->num_parts; p++)
        s->parts[p].weight = part_local(s, p, STR_weight, scatter_grey(s, 0.0f));
    s->density = scatter_local(s, STR_density, scatter_number(s, 0.0f));
    s->medium = scatter_local(s, STR_medium, scatter_grey(s, 1.0f));
    interior_declare(s);
}

static void sample_leaves(struct closure_scatter *s)
{
    ir_ref above = 0; /* the share of the leaf before */
    for (uint32_t i = 0; i < s->leaves.len; i++) {
        const struct scattering *leaf = &s->leaves.items[i];
        if (!leaf->share)
            continue;
        ir_push_origin_of(s->graph, leaf->leaf);
        if (above)
            scatter_effect(s, EFFECT_ACCUMULATE, s->pick, ir_op1(s->graph, IR_NEG, above));
        sample(s, leaf);
        ir_pop_origin(s->graph);
        above = leaf->share;
    }
}

/*
 * A leaf that refracts sends light of its own side, `value`, and to a viewer inside the solid also
 * that of a point behind the surface. A direction that refracts has no density (scatter_take_side),
 * so no other light is weighed against it.
 */
static ir_ref through_surface(struct closure_scatter *s, const struct closure_leaf *leaf,
                              ir_ref direction, ir_ref value, bool is_point)
{
    struct ir_graph *g = s->graph;
    ir_ref in_front = scatter_is_in_front(s, direction), other = scatter_grey(s, 0.0f), behind = 0;
    if (is_point)
        behind = closure_call(s->shader, s->host, leaf->leaf, LEAF_REFRACTION, &direction);
    if (behind && !ir_const_is(g, behind, 0.0f)) {
        ir_ref normal = closure_normal(s->shader, s->host), view = closure_view(s->shader, s->host);
        ir_ref cosine = ir_op2(g, IR_DOT, normal, view), nothing = scatter_number(s, 0.0f),
               is_inside = scatter_op2(s, IR_LT, cosine, nothing),
               weight = weight_from(s, leaf, direction);
        behind = ir_mul(g, ir_convert(g, IR_TYPE_VEC3, behind), weight);
        other = ir_op3(g, IR_SELECT, is_inside, behind, other);
    }
    return ir_op3(g, IR_SELECT, in_front, value, other);
}

/* 0: it sends no light of this direction. */
static ir_ref leaf_response(struct closure_scatter *s, const struct scattering *leaf,
                            const struct closure_leaf *weighed, ir_ref direction,
                            ir_ref solid_angle)
{
    ir_ref value = closure_call(s->shader, s->host, leaf->leaf, LEAF_EVAL, &direction);
    if (!value)
        return 0;
    value = ir_convert(s->graph, IR_TYPE_VEC3, value);
    value = scatter_op2(s, IR_MUL, value, weight_from(s, weighed, direction));
    if (solid_angle) {
        ir_ref density = closure_call(s->shader, s->host, leaf->leaf, LEAF_PDF, &direction);
        density = scatter_op2(s, IR_MUL, density, scatter_op2(s, IR_DIV, leaf->share, s->total));
        value = scatter_balanced(s, value, density, solid_angle);
    }
    if (has(s, leaf->leaf, LEAF_REFRACTION))
        value = through_surface(s, weighed, direction, value, !solid_angle);
    return value;
}

/*
 * The response of a part to light from a direction. solid_angle 0: the light of a point, which no
 * sample finds.
 */
static ir_ref response(struct closure_scatter *s, uint32_t part, ir_ref direction,
                       ir_ref solid_angle)
{
    struct ir_graph *g = s->graph;
    ir_ref sum = scatter_grey(s, 0.0f);
    if (s->pile) /* a path has the light of one part */
        return part ? sum : matter_response(s, direction, solid_angle);
    for (uint32_t i = 0; i < s->leaves.len; i++) {
        const struct scattering *leaf = &s->leaves.items[i];
        ir_push_origin_of(g, leaf->leaf);
        ir_ref value = leaf->in[part] && leaf->share
                           ? leaf_response(s, leaf, leaf->in[part], direction, solid_angle)
                           : 0;
        ir_pop_origin(g);
        if (value)
            sum = scatter_named(s, scatter_op2(s, IR_ADD, sum, value), "response");
    }
    return sum;
}

void scatter_write_output(struct closure_scatter *s, str_id name, ir_ref rgb, ir_ref a)
{
    uint32_t out = shader_output(s->shader, name, IR_TYPE_VEC4);
    ir_ref parts[2] = {rgb, a};
    scatter_effect(s, EFFECT_OUTPUT, out, ir_construct(s->graph, IR_TYPE_VEC4, parts, 2));
}

/* The light of each part from one of the lights; returns the mean of the greatest. */
static ir_ref lit_parts(struct closure_scatter *s, const struct closure_light *light)
{
    ir_ref most = 0;
    for (uint32_t p = 0; p < s->num_parts; p++) {
        ir_ref seen = response(s, p, light->direction, 0);
        s->parts[p].lit = scatter_op2(s, IR_MUL, light->intensity, seen);
        most = most ? scatter_op2(s, IR_MAX, most, s->parts[p].lit) : s->parts[p].lit;
    }
    scatter_named(s, most, "lit");
    ir_ref brightness = FORMULA(s->shader, "mx_brightness", most);
    return scatter_named(s, brightness, "brightness");
}

/* The choice of a light: locals. */
struct choice_of_light {
    uint32_t chance, sum, to_light, away;
    uint32_t *kept; /* per part */
};

/* Keeps the light of the loop, or not; the chance becomes that of the next one. */
static void consider_light(struct closure_scatter *s, const struct closure_light *light,
                           const struct choice_of_light *c)
{
    ir_ref mean = lit_parts(s, light), nothing = scatter_number(s, 0.0f);
    if (ir_const_is(s->graph, mean, 0.0f)) /* nothing is lit */
        return;
    scatter_effect(s, EFFECT_ACCUMULATE, c->sum, mean);
    ir_ref all = scatter_read(s, c->sum),
           point =
               scatter_named(s, scatter_op2(s, IR_MUL, scatter_read(s, c->chance), all), "point"),
           is_it = scatter_op2(s, IR_LT, point, mean);
    scatter_effect(s, EFFECT_IF, 0, is_it);
    scatter_effect(s, EFFECT_ASSIGN, c->to_light, light->direction);
    scatter_effect(s, EFFECT_ASSIGN, c->away, light->distance);
    for (uint32_t p = 0; p < s->num_parts; p++)
        scatter_effect(s, EFFECT_ASSIGN, c->kept[p], scatter_op2(s, IR_DIV, s->parts[p].lit, mean));
    scatter_effect(s, EFFECT_END, 0, 0);
    ir_ref rest = FORMULA(s->shader, "mx_rest_of_choice", point, mean, scatter_read(s, c->sum));
    scatter_effect(s, EFFECT_IF, 0, scatter_op2(s, IR_GT, mean, nothing));
    scatter_effect(s, EFFECT_ASSIGN, c->chance, rest);
    scatter_effect(s, EFFECT_END, 0, 0);
}

/*
 * One of the bound lights, in one pass, with a probability proportional to its unshadowed
 * contribution (reservoir sampling: Chao 1982, "A General Purpose Unequal Probability Sampling
 * Plan"):
 *
 *     for each light:
 *         c = intensity · Σ wᵢ · evalᵢ,  m = mean(c),  sum += m
 *         if (chance · sum < m) { keep L, distance, c / m }
 *         rescale chance for the next light
 *     out6 = vec4(L, distance)
 *     out7 = vec4(kept · sum, 0)
 *
 * Several parts keep their own c, and m is the mean of the greatest.
 */
static void light_up(struct closure_scatter *s)
{
    ir_ref nothing = scatter_number(s, 0.0f), random = scatter_random_number(s->shader);
    ir_ref further = scatter_op2(s, IR_MUL, random, scatter_number(s, 4096.0f));
    struct choice_of_light c = {.to_light = s->to_light, .away = s->away};
    c.chance = scatter_local(s, STR_chance, ir_op1(s->graph, IR_FRACT, further));
    c.sum = scatter_local(s, STR_brightness_sum, nothing);
    c.kept = ARENA_ARRAY(s->shader->arena, uint32_t, s->num_parts);
    for (uint32_t p = 0; p < s->num_parts; p++)
        c.kept[p] = part_local(s, p, STR_light, scatter_grey(s, 0.0f));
    if (!s->is_stack) {
        c.to_light = s->to_light = scatter_local(s, STR_light_L, scatter_grey(s, 0.0f));
        c.away = s->away = scatter_local(s, STR_light_distance, nothing);
    }
    scatter_effect(s, EFFECT_LIGHTS, 0, 0);
    struct closure_light light;
    closure_sample_light(s->shader, s->host, &light);
    for (uint32_t i = 0; i < light.choice.len; i++) {
        const struct effect *part = &light.choice.items[i];
        scatter_effect(s, (enum effect_kind)part->kind, part->index, part->value);
    }
    consider_light(s, &light, &c);
    scatter_effect(s, EFFECT_END, 0, 0);
    for (uint32_t p = 0; p < s->num_parts; p++) {
        ir_ref lit = scatter_read(s, c.kept[p]);
        s->parts[p].lit = scatter_op2(s, IR_MUL, lit, scatter_read(s, c.sum));
    }
    s->shader->reflection.lit = true;
}

ir_ref closure_scatter_number(struct shader *shader, ir_ref alpha)
{
    return ir_op2(shader->graph, IR_MUL, scatter_random_number(shader), alpha);
}

struct closure_scatter *closure_scatter_begin(struct shader *shader,
                                              const struct closure_host *host,
                                              const struct closure_lighting *lighting)
{
    struct closure_scatter *s = ARENA_NEW(shader->arena, struct closure_scatter);
    *s = (struct closure_scatter){.shader = shader,
                                  .graph = shader->graph,
                                  .host = host,
                                  .lighting = lighting,
                                  .scattering = UINT32_MAX,
                                  .copies = {.shader = shader}};
    s->parts = ARENA_ARRAY(shader->arena, struct part, shader->interface.aovs.len + 1);
    s->num_parts = 1;
    for (uint32_t i = 0; i < shader->interface.aovs.len; i++)
        if (shader->interface.aovs.items[i].is_output
            && shader->interface.aovs.items[i].type == IR_TYPE_BSDF)
            s->parts[s->num_parts++].aov = i;
    return s;
}

/* The locals that the layers of a stack fill; before the first one. */
static void declare_layers(struct closure_scatter *s)
{
    ir_ref black = scatter_grey(s, 0.0f), nothing = scatter_number(s, 0.0f);
    s->is_stack = true;
    scatter_declare_locals(s, nothing);
    s->emission_local = scatter_local(s, STR_emission, black);
    for (uint32_t p = 0; p < s->num_parts; p++)
        s->parts[p].seen_local = part_local(s, p, STR_response, black);
    for (uint32_t p = 0; s->lighting->lights && p < s->num_parts; p++)
        s->parts[p].lit_local = part_local(s, p, STR_light, black);
    if (s->lighting->lights) {
        s->to_light = scatter_local(s, STR_light_L, black);
        s->away = scatter_local(s, STR_light_distance, nothing);
    }
    s->aov_locals = ARENA_ARRAY(s->shader->arena, uint32_t, s->shader->interface.aovs.len);
    for (uint32_t i = 0; i < s->shader->interface.aovs.len; i++)
        if (s->shader->interface.aovs.items[i].is_output)
            s->aov_locals[i] = scatter_local(s, s->shader->interface.aovs.items[i].name,
                                             closure_aov_value(s->shader, i, 0));
}

/* The response of a part to the light of the host's direction. */
static ir_ref seen_of(struct closure_scatter *s, uint32_t part)
{
    ir_ref light = shader_stream(s->shader, STR_lightWorld, IR_TYPE_VEC4), direction[3];
    for (unsigned i = 0; i < 3; i++)
        direction[i] = ir_component(s->graph, light, i);
    ir_ref solid_angle = ir_component(s->graph, light, 3);
    return response(s, part, ir_construct(s->graph, IR_TYPE_VEC3, direction, 3), solid_angle);
}

/* Moves what the layer gives to the locals of the stack. */
static void keep_layer(struct closure_scatter *s)
{
    scatter_effect(s, EFFECT_ASSIGN, s->emission_local, s->emission);
    for (uint32_t p = 0; p < s->num_parts; p++)
        scatter_effect(s, EFFECT_ASSIGN, s->parts[p].seen_local, seen_of(s, p));
    for (uint32_t i = 0; i < s->aovs.num; i++)
        if (s->shader->interface.aovs.items[i].is_output && s->aovs.items[i].value)
            scatter_effect(s, EFFECT_ASSIGN, s->aov_locals[i],
                           closure_aov_value(s->shader, i, s->aovs.items[i].value));
    if (!s->lighting->lights)
        return;
    light_up(s);
    for (uint32_t p = 0; p < s->num_parts; p++)
        scatter_effect(s, EFFECT_ASSIGN, s->parts[p].lit_local, s->parts[p].lit);
}

static ir_ref scale_of(struct closure_scatter *s, ir_ref alpha)
{
    if (closure_is_opaque(s->graph, alpha))
        return 0;
    return FORMULA(s->shader, "mx_scale_of_coverage", alpha);
}

void closure_scatter_layer(struct closure_scatter *s, const struct closure_scatter_layer *layer)
{
    const struct closure_list *none = ARENA_NEW(s->shader->arena, struct closure_list);
    s->has_layer = true;
    s->parts[0].list = &layer->list;
    for (uint32_t p = 1; p < s->num_parts; p++)
        s->parts[p].list = layer->aov_lists ? &layer->aov_lists[s->parts[p].aov] : none;
    s->scale = scale_of(s, layer->alpha);
    s->aovs = s->scale ? closure_aovs_scaled(s->graph, layer->aovs, s->scale) : layer->aovs;
    s->pile = layer->pile;
    ir_ref scale = s->pile ? 0 : s->scale; /* light of a pile is not lit by chance */
    s->emission = layer->emission ? ir_convert(s->graph, IR_TYPE_VEC3,
                                               ir_product(s->graph, layer->emission, scale))
                                  : scatter_grey(s, 0.0f);
    if (s->pile) {
        matter_sample(s);
        return;
    }
    find_leaves(s);
    find_shares(s);
    if (!layer->chance) {
        scatter_declare_locals(s,
                               scatter_op2(s, IR_MUL, scatter_random_number(s->shader), s->total));
        sample_leaves(s);
        return;
    }
    if (!s->is_stack)
        declare_layers(s);
    if (layer->is_it)
        scatter_effect(s, EFFECT_IF, 0, layer->is_it);
    scatter_effect(s, EFFECT_ASSIGN, s->pick, scatter_op2(s, IR_MUL, layer->chance, s->total));
    sample_leaves(s);
    keep_layer(s);
    closure_enter_loop(&s->copies, s->copies.loop + 1);
    if (layer->is_it)
        scatter_effect(s, EFFECT_END, 0, 0);
}

static void write_part(struct closure_scatter *s, const struct part *part, enum aov_output which,
                       ir_ref value)
{
    uint32_t output = closure_aov_output(s->shader, part->aov, which, IR_TYPE_VEC3);
    scatter_effect(s, EFFECT_OUTPUT, output, value);
}

static void write_aovs(struct closure_scatter *s)
{
    for (uint32_t i = 0; i < s->shader->interface.aovs.len; i++) {
        if (!s->shader->interface.aovs.items[i].is_output)
            continue;
        ir_ref value =
            s->is_stack ? scatter_read(s, s->aov_locals[i])
                        : closure_aov_value(s->shader, i, s->aovs.num ? s->aovs.items[i].value : 0);
        scatter_effect(s, EFFECT_OUTPUT,
                       closure_aov_output(s->shader, i, AOV_VALUE, ir_type_of(s->graph, value)),
                       value);
    }
    for (uint32_t p = 1; p < s->num_parts; p++) {
        const struct part *part = &s->parts[p];
        ir_ref seen = s->is_stack ? scatter_read(s, part->seen_local) : seen_of(s, p);
        write_part(s, part, AOV_WEIGHT, scatter_read(s, part->weight));
        write_part(s, part, AOV_RESPONSE, seen);
        if (s->lighting->lights)
            write_part(s, part, AOV_LIGHT, part->lit);
    }
}

static void write_lit(struct closure_scatter *s)
{
    ir_ref to_light = scatter_read(s, s->to_light), away = scatter_read(s, s->away);
    scatter_write_output(s, STR_out6, to_light, away);
    scatter_write_output(s, STR_out7, s->parts[0].lit, scatter_number(s, 0.0f));
}

void closure_scatter_medium(struct closure_scatter *s, const struct closure_medium *medium,
                            bool varies)
{
    ir_ref nothing = scatter_number(s, 0.0f);
    const struct shader_variable extinction = {
        .name = STR_out10, .block = BLOCK_OUTPUTS, .type = IR_TYPE_VEC4, .semantic = STR_varies};
    if (varies)
        shader_add_variable(s->shader, &extinction);
    scatter_write_output(s, STR_out9, medium->scattering, nothing);
    scatter_write_output(s, STR_out10, medium->extinction, nothing);
}

void closure_scatter_end(struct closure_scatter *s, ir_ref alpha)
{
    ir_ref one = scatter_number(s, 1.0f), nothing = scatter_number(s, 0.0f);
    assert(!alpha || ir_type_of(s->graph, alpha) == IR_TYPE_FLOAT);
    closure_enter_loop(&s->copies, 0);
    if (!s->has_layer) /* a stack of nothing */
        declare_layers(s);
    if (s->is_stack)
        s->emission = scatter_read(s, s->emission_local);
    scatter_write_output(s, STR_out1, s->emission, alpha ? alpha : one);
    ir_ref direction = scatter_read(s, s->direction), is_inside = scatter_read(s, s->is_inside);
    scatter_write_output(s, STR_out2, direction, is_inside);
    ir_ref weight = scatter_read(s, s->parts[0].weight), density = scatter_read(s, s->density);
    scatter_write_output(s, STR_out3, weight, density);
    ir_ref inside = s->pile ? matter_inside(s) : nothing, medium = scatter_read(s, s->medium);
    scatter_write_output(s, STR_out4, medium, inside);
    ir_ref seen = s->is_stack ? scatter_read(s, s->parts[0].seen_local) : seen_of(s, 0);
    scatter_write_output(s, STR_out5, seen, nothing);
    interior_write(s);
    if (s->lighting->lights && !s->is_stack)
        light_up(s);
    for (uint32_t p = 0; s->lighting->lights && s->is_stack && p < s->num_parts; p++)
        s->parts[p].lit = scatter_read(s, s->parts[p].lit_local);
    if (s->lighting->lights)
        write_lit(s);
    write_aovs(s);
    s->shader->reflection.transparent = alpha && !ir_const_is(s->graph, alpha, 1.0f);
    if (s->pile)
        matter_write(s);
}
