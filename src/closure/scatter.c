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
 *     out4 = vec4(medium, 0)
 *     out5 = vec4(Σ wᵢ · evalᵢ(lightWorld.xyz) / (1 + lightWorld.w · Pᵢ · pdfᵢ(lightWorld.xyz)), 0)
 *     out6, out7: one of the bound lights, see light_up
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
 * of the solid first, so lights do not shine through it: there density is 0 and out5 black.
 */
#include "closure/closure_priv.h"

#include <assert.h>

struct closure_scatter {
    struct shader *shader;
    struct ir_graph *graph;
    const struct closure_host *host;
    const struct closure_lighting *lighting;
    const struct closure_list *list; /* of the layer at hand */
    /* p of each leaf; 0: never picked */
    ir_ref *shares;
    uint32_t pick, direction, is_inside, weight, density, medium; /* locals */
    ir_ref total;
    /* 1 / alpha, where the weights have the alpha that the tracer applies by chance; 0 = 1 */
    ir_ref scale;
    struct closure_copies copies; /* of the layer, whose light loop is its own */
    /* of a stack: locals for what the picked layer gives; of a surface: what it gives */
    bool is_stack;
    uint32_t emission_local, seen_local, lit_local, to_light, away;
    uint32_t *aov_locals; /* by number of the AOV */
    struct closure_aovs aovs;
    ir_ref emission, seen, lit;
};

static void effect(struct closure_scatter *s, enum effect_kind kind, uint32_t index, ir_ref value)
{
    value = closure_in_loop(&s->copies, value);
    shader_effect(s->shader, STAGE_PIXEL,
                  (struct effect){.kind = (uint8_t)kind, .index = index, .value = value});
}

static uint32_t local(struct closure_scatter *s, str_id name, ir_ref value)
{
    uint32_t index = shader_add_local(s->shader, name, ir_type_of(s->graph, value));
    effect(s, EFFECT_VAR, index, value);
    return index;
}

static ir_ref read(struct closure_scatter *s, uint32_t index)
{
    assert(index < s->shader->locals.len);
    return ir_build(s->graph, IR_LOCAL, s->shader->locals.items[index].type, index, NULL, 0);
}

static ir_ref number(struct closure_scatter *s, float value)
{
    return ir_const_float(s->graph, value);
}

static ir_ref grey(struct closure_scatter *s, float value)
{
    return ir_const_splat(s->graph, IR_TYPE_VEC3, value);
}

static ir_ref op2(struct closure_scatter *s, enum ir_op op, ir_ref a, ir_ref b)
{
    return ir_op2(s->graph, op, a, b);
}

static ir_ref mean_of(struct closure_scatter *s, ir_ref color)
{
    return op2(s, IR_DOT, color, grey(s, 1.0f / 3.0f));
}

/* The weight for light on a way through the media above. */
static ir_ref weight_along(struct closure_scatter *s, const struct closure_leaf *leaf, ir_ref way)
{
    ir_ref weight = closure_mul(s->graph, closure_weight(s->shader, leaf, way), s->scale);
    return ir_convert(s->graph, IR_TYPE_VEC3, weight);
}

/* The weight for light from a direction. */
static ir_ref weight_from(struct closure_scatter *s, const struct closure_leaf *leaf,
                          ir_ref direction)
{
    return weight_along(s, leaf, leaf->decay ? closure_way(s->shader, s->host, direction) : 0);
}

static bool has(const struct closure_scatter *s, const struct closure_leaf *leaf,
                enum leaf_function which)
{
    return closure_has(s->shader, s->host, leaf->leaf, which);
}

static bool refracts(struct closure_scatter *s, const struct closure_leaf *leaf)
{
    ir_ref any = closure_view(s->shader, s->host);
    ir_ref refraction = has(s, leaf, LEAF_REFRACTION)
                            ? closure_call(s->shader, s->host, leaf->leaf, LEAF_REFRACTION, &any)
                            : 0;
    return refraction && !ir_const_is(s->graph, refraction, 0.0f);
}

/*
 * p of a leaf: the chance to pick it times the sum of all p. It follows the scattered light, so
 * that paths keep their weight. An albedo covers only reflection; refraction loses no light. The
 * tenth is a reserve, because albedos are fits.
 */
static ir_ref share_of(struct closure_scatter *s, const struct closure_leaf *leaf)
{
    struct ir_graph *g = s->graph;
    ir_ref albedo = closure_call(s->shader, s->host, leaf->leaf, LEAF_ALBEDO, NULL),
           light = weight_along(s, leaf, number(s, CLOSURE_MEAN_WAY));
    if (albedo && !refracts(s, leaf)) {
        albedo = op2(s, IR_MUL, grey(s, 0.9f), ir_convert(g, IR_TYPE_VEC3, albedo));
        light = op2(s, IR_MUL, light, op2(s, IR_ADD, grey(s, 0.1f), albedo));
    }
    assert(ir_type_of(g, light) == IR_TYPE_VEC3);
    return op2(s, IR_MAX, mean_of(s, light), number(s, 0.0f));
}

/* True if the light from L comes from the visible side. */
static ir_ref is_in_front(struct closure_scatter *s, ir_ref direction)
{
    ir_ref normal = closure_normal(s->shader, s->host), view = closure_view(s->shader, s->host);
    ir_ref of_view = op2(s, IR_DOT, normal, view), of_light = op2(s, IR_DOT, normal, direction);
    return op2(s, IR_GT, op2(s, IR_MUL, of_view, of_light), number(s, 0.0f));
}

static void sample(struct closure_scatter *s, const struct closure_leaf *leaf, ir_ref share)
{
    struct ir_graph *g = s->graph;
    ir_ref pick = read(s, s->pick), nothing = number(s, 0.0f), one = number(s, 1.0f);
    ir_ref is_it = op2(s, IR_GE, pick, nothing);
    is_it = op2(s, IR_LAND, is_it, op2(s, IR_LT, pick, share));
    ir_ref results[3]; /* direction, f cos / pdf, pdf */
    closure_call_all(s->shader, s->host, leaf->leaf, LEAF_SAMPLE, NULL, results);
    ir_ref weight = op2(s, IR_MUL, weight_from(s, leaf, results[0]), results[1]);
    weight = op2(s, IR_MUL, weight, op2(s, IR_DIV, s->total, share));
    ir_ref density = op2(s, IR_MUL, results[2], op2(s, IR_DIV, share, s->total));
    effect(s, EFFECT_IF, 0, is_it);
    effect(s, EFFECT_ASSIGN, s->direction, results[0]);
    effect(s, EFFECT_ASSIGN, s->weight, weight);
    if (has(s, leaf, LEAF_REFRACTION)) {
        ir_ref in_front = is_in_front(s, results[0]);
        density = ir_op3(g, IR_SELECT, in_front, density, nothing);
        effect(s, EFFECT_ASSIGN, s->is_inside, ir_op3(g, IR_SELECT, in_front, nothing, one));
        if (leaf->medium)
            effect(s, EFFECT_ASSIGN, s->medium, ir_convert(g, IR_TYPE_VEC3, leaf->medium));
    }
    effect(s, EFFECT_ASSIGN, s->density, density);
    effect(s, EFFECT_END, 0, 0);
    effect(s, EFFECT_ACCUMULATE, s->pick, ir_op1(g, IR_NEG, share));
}

static void find_shares(struct closure_scatter *s)
{
    s->shares = ARENA_ARRAY(s->shader->arena, ir_ref, s->list->leaves.len);
    s->total = number(s, 0.0f);
    for (uint32_t i = 0; i < s->list->leaves.len; i++) {
        const struct closure_leaf *leaf = &s->list->leaves.items[i];
        ir_ref share = has(s, leaf, LEAF_SAMPLE) ? share_of(s, leaf) : 0;
        if (!share || ir_const_is(s->graph, share, 0.0f))
            continue;
        s->shares[i] = share;
        s->total = op2(s, IR_ADD, s->total, share);
        shader_add_closure(s->shader, leaf->leaf);
    }
}

static ir_ref random_number(struct shader *shader)
{
    return ir_component(shader->graph, shader_stream(shader, STR_random, IR_TYPE_VEC4), 3);
}

static void declare_locals(struct closure_scatter *s, ir_ref pick)
{
    s->pick = local(s, STR_pick, pick);
    s->direction = local(s, STR_L, grey(s, 0.0f));
    s->is_inside = local(s, STR_inside, number(s, 0.0f));
    s->weight = local(s, STR_weight, grey(s, 0.0f));
    s->density = local(s, STR_density, number(s, 0.0f));
    s->medium = local(s, STR_medium, grey(s, 1.0f));
}

static void sample_leaves(struct closure_scatter *s)
{
    for (uint32_t i = 0; i < s->list->leaves.len; i++)
        if (s->shares[i])
            sample(s, &s->list->leaves.items[i], s->shares[i]);
}

/*
 * The response of all leaves to light from a direction. solid_angle 0: the light of a point, which
 * no sample finds.
 */
static ir_ref response(struct closure_scatter *s, ir_ref direction, ir_ref solid_angle)
{
    struct ir_graph *g = s->graph;
    ir_ref sum = grey(s, 0.0f);
    for (uint32_t i = 0; i < s->list->leaves.len; i++) {
        const struct closure_leaf *leaf = &s->list->leaves.items[i];
        ir_ref value = closure_call(s->shader, s->host, leaf->leaf, LEAF_EVAL, &direction);
        if (!value || !s->shares[i])
            continue;
        value = ir_convert(g, IR_TYPE_VEC3, value);
        value = op2(s, IR_MUL, value, weight_from(s, leaf, direction));
        if (solid_angle) {
            ir_ref density = closure_call(s->shader, s->host, leaf->leaf, LEAF_PDF, &direction);
            density = op2(s, IR_MUL, density, op2(s, IR_DIV, s->shares[i], s->total));
            value = op2(s, IR_DIV, value,
                        op2(s, IR_ADD, number(s, 1.0f), op2(s, IR_MUL, solid_angle, density)));
        }
        if (has(s, leaf, LEAF_REFRACTION))
            value = ir_op3(g, IR_SELECT, is_in_front(s, direction), value, grey(s, 0.0f));
        sum = op2(s, IR_ADD, sum, value);
    }
    return sum;
}

static void write_output(struct closure_scatter *s, str_id name, ir_ref rgb, ir_ref a)
{
    uint32_t out = shader_output(s->shader, name, IR_TYPE_VEC4);
    ir_ref parts[2] = {rgb, a};
    effect(s, EFFECT_OUTPUT, out, ir_construct(s->graph, IR_TYPE_VEC4, parts, 2));
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
 */
static void light_up(struct closure_scatter *s)
{
    struct ir_graph *g = s->graph;
    ir_ref nothing = number(s, 0.0f), random = random_number(s->shader);
    uint32_t chance =
        local(s, STR_chance, ir_op1(g, IR_FRACT, op2(s, IR_MUL, random, number(s, 4096.0f))));
    uint32_t sum = local(s, STR_sum, nothing), kept = local(s, STR_light, grey(s, 0.0f));
    uint32_t to_light = s->to_light, away = s->away;
    if (!s->is_stack) {
        to_light = s->to_light = local(s, STR_L, grey(s, 0.0f));
        away = s->away = local(s, STR_distance, nothing);
    }
    effect(s, EFFECT_LIGHTS, 0, 0);
    struct closure_light light;
    closure_sample_light(s->shader, s->host, &light);
    for (uint32_t i = 0; i < light.choice.len; i++) {
        const struct effect *part = &light.choice.items[i];
        effect(s, (enum effect_kind)part->kind, part->index, part->value);
    }
    ir_ref lit = op2(s, IR_MUL, light.intensity, response(s, light.direction, 0));
    ir_ref mean = op2(s, IR_MAX, mean_of(s, lit), nothing);
    effect(s, EFFECT_ACCUMULATE, sum, mean);
    ir_ref all = read(s, sum), point = op2(s, IR_MUL, read(s, chance), all),
           is_it = op2(s, IR_LT, point, mean);
    effect(s, EFFECT_IF, 0, is_it);
    effect(s, EFFECT_ASSIGN, to_light, light.direction);
    effect(s, EFFECT_ASSIGN, away, closure_light_distance(s->shader, s->host));
    effect(s, EFFECT_ASSIGN, kept, op2(s, IR_DIV, lit, mean));
    effect(s, EFFECT_END, 0, 0);
    ir_ref rest = op2(s, IR_SUB, point, mean);
    rest = op2(s, IR_DIV, rest, op2(s, IR_SUB, read(s, sum), mean));
    rest = ir_op3(g, IR_SELECT, is_it, op2(s, IR_DIV, point, mean), rest);
    effect(s, EFFECT_IF, 0, op2(s, IR_GT, mean, nothing));
    effect(s, EFFECT_ASSIGN, chance, rest);
    effect(s, EFFECT_END, 0, 0);
    effect(s, EFFECT_END, 0, 0);
    s->lit = read(s, kept);
    s->lit = op2(s, IR_MUL, s->lit, read(s, sum));
    s->shader->lit = true;
}

ir_ref closure_scatter_number(struct shader *shader, ir_ref alpha)
{
    return ir_op2(shader->graph, IR_MUL, random_number(shader), alpha);
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
                                  .copies = {.shader = shader}};
    return s;
}

/* The light of a BSDF needs the whole path. */
static bool has_value(const struct closure_scatter *s, uint32_t aov)
{
    const struct shader_aov *a = &s->shader->aovs.items[aov];
    return a->is_output && a->type != IR_TYPE_BSDF;
}

/* The locals that the layers of a stack fill; before the first one. */
static void declare_layers(struct closure_scatter *s)
{
    ir_ref black = grey(s, 0.0f), nothing = number(s, 0.0f);
    declare_locals(s, nothing);
    s->emission_local = local(s, STR_emission, black);
    s->seen_local = local(s, STR_response, black);
    if (s->lighting->lights) {
        s->lit_local = local(s, STR_light, black);
        s->to_light = local(s, STR_L, black);
        s->away = local(s, STR_distance, nothing);
    }
    s->aov_locals = ARENA_ARRAY(s->shader->arena, uint32_t, s->shader->aovs.len);
    for (uint32_t i = 0; i < s->shader->aovs.len; i++)
        if (has_value(s, i))
            s->aov_locals[i] =
                local(s, s->shader->aovs.items[i].name, closure_aov_value(s->shader, i, 0));
    s->is_stack = true;
}

/* The response to the light of the host's direction. */
static ir_ref seen_of(struct closure_scatter *s)
{
    ir_ref light = shader_stream(s->shader, STR_lightWorld, IR_TYPE_VEC4), direction[3];
    for (unsigned i = 0; i < 3; i++)
        direction[i] = ir_component(s->graph, light, i);
    ir_ref solid_angle = ir_component(s->graph, light, 3);
    return response(s, ir_construct(s->graph, IR_TYPE_VEC3, direction, 3), solid_angle);
}

/* Moves what the layer gives to the locals of the stack. */
static void keep_layer(struct closure_scatter *s)
{
    effect(s, EFFECT_ASSIGN, s->emission_local, s->emission);
    effect(s, EFFECT_ASSIGN, s->seen_local, seen_of(s));
    for (uint32_t i = 0; i < s->aovs.num; i++)
        if (has_value(s, i) && s->aovs.items[i].value)
            effect(s, EFFECT_ASSIGN, s->aov_locals[i],
                   closure_aov_value(s->shader, i, s->aovs.items[i].value));
    if (!s->lighting->lights)
        return;
    light_up(s);
    effect(s, EFFECT_ASSIGN, s->lit_local, s->lit);
}

static ir_ref scale_of(struct closure_scatter *s, ir_ref alpha)
{
    if (closure_is_opaque(s->graph, alpha))
        return 0;
    return op2(s, IR_DIV, number(s, 1.0f), op2(s, IR_MAX, alpha, number(s, 1e-6f)));
}

void closure_scatter_layer(struct closure_scatter *s, const struct closure_scatter_layer *layer)
{
    s->list = &layer->list;
    s->scale = scale_of(s, layer->alpha);
    s->aovs = s->scale ? closure_aovs_scaled(s->graph, layer->aovs, s->scale) : layer->aovs;
    s->emission = layer->emission ? ir_convert(s->graph, IR_TYPE_VEC3,
                                               closure_mul(s->graph, layer->emission, s->scale))
                                  : grey(s, 0.0f);
    find_shares(s);
    if (!layer->chance) {
        declare_locals(s, op2(s, IR_MUL, random_number(s->shader), s->total));
        sample_leaves(s);
        return;
    }
    if (!s->is_stack)
        declare_layers(s);
    if (layer->is_it)
        effect(s, EFFECT_IF, 0, layer->is_it);
    effect(s, EFFECT_ASSIGN, s->pick, op2(s, IR_MUL, layer->chance, s->total));
    sample_leaves(s);
    keep_layer(s);
    closure_enter_loop(&s->copies, s->copies.loop + 1);
    if (layer->is_it)
        effect(s, EFFECT_END, 0, 0);
}

static void write_aovs(struct closure_scatter *s)
{
    for (uint32_t i = 0; i < s->shader->aovs.len; i++) {
        if (!has_value(s, i))
            continue;
        ir_ref value =
            s->is_stack ? read(s, s->aov_locals[i])
                        : closure_aov_value(s->shader, i, s->aovs.num ? s->aovs.items[i].value : 0);
        effect(s, EFFECT_OUTPUT, closure_aov_output(s->shader, i, ir_type_of(s->graph, value)),
               value);
    }
}

static void write_lit(struct closure_scatter *s)
{
    ir_ref to_light = read(s, s->to_light), away = read(s, s->away);
    write_output(s, STR_out6, to_light, away);
    write_output(s, STR_out7, s->lit, number(s, 0.0f));
}

void closure_scatter_end(struct closure_scatter *s, ir_ref alpha)
{
    ir_ref one = number(s, 1.0f), nothing = number(s, 0.0f);
    assert(!alpha || ir_type_of(s->graph, alpha) == IR_TYPE_FLOAT);
    closure_enter_loop(&s->copies, 0);
    if (!s->list) /* a stack of nothing */
        declare_layers(s);
    if (s->is_stack)
        s->emission = read(s, s->emission_local);
    write_output(s, STR_out1, s->emission, alpha ? alpha : one);
    ir_ref direction = read(s, s->direction), is_inside = read(s, s->is_inside);
    write_output(s, STR_out2, direction, is_inside);
    ir_ref weight = read(s, s->weight), density = read(s, s->density);
    write_output(s, STR_out3, weight, density);
    write_output(s, STR_out4, read(s, s->medium), nothing);
    write_output(s, STR_out5, s->is_stack ? read(s, s->seen_local) : seen_of(s), nothing);
    if (s->lighting->lights && !s->is_stack)
        light_up(s);
    else if (s->lighting->lights)
        s->lit = read(s, s->lit_local);
    if (s->lighting->lights)
        write_lit(s);
    write_aovs(s);
    s->shader->transparent = alpha && !ir_const_is(s->graph, alpha, 1.0f);
}
