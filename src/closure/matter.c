// SPDX-License-Identifier: Apache-2.0
/*
 * A pile of matter, for path tracers that walk through media at random: the leaves of a tree from
 * above, each one level. A mix of closures puts one or the other into the pile, and a weight puts a
 * leaf there or not, all by one random number that stays the same while light is in the pile (Guo,
 * Hašan, Zhao 2018, "Position-Free Monte Carlo Simulation for Arbitrary Layered BSDFs").
 *
 * The tracer asks for one level after the other:
 *
 *     matter = vec2(level, or below 0 the first one; random number)
 *         the number is from 0 to below 1 for the surface, and k higher for the BSDF of the AOV k,
 *         which is a pile of its own and has the weight 1 where its light is asked for
 *     a lobe: light from above is reflected by it, or goes on as it came:
 *         out2 = vec4(L, 2 where it goes on);  out3 = vec4(weight, density)
 *     a medium, where the extinction is not 0: the tracer walks through it, and lights it itself:
 *         out5, out7 = the light of a surface that reflects 1 from everywhere
 *     a body, where out4.w is 1: the same, but light goes on inside the mesh
 *     out9 = vec4(scattering, phase anisotropy), out10 = vec4(extinction, the level below or -1),
 *         both over the thickness, or of a body over a unit of the world
 *     out11 = vec4(what goes straight through the whole pile, the medium above or -1)
 *     out12 = vec4(extinction, level) of the body that is there; the level is -1 where none is
 *         there, and -2 in a pile that has none
 *
 * A tracer that does not follow light into a body takes the levels below, which stand for it. Light
 * that comes back from below pays for media alone, as in docs/slabs.md; where a level is asked for,
 * out11 is what it lets through.
 */
#include "closure/scatter.h"

#include <assert.h>

enum { MAX_LEVELS = 48 };

/* ---- Finding the levels ---- */

struct finder {
    struct shader *shader;
    struct ir_graph *graph;
    const struct closure_host *host;
    struct closure_pile *pile;
    ir_ref number; /* not used so far: even from 0 to below 1 */
};

struct operand {
    ir_ref ref, is_here;
};

static ir_ref both(struct ir_graph *g, ir_ref a, ir_ref b)
{
    return a && b ? ir_op2(g, IR_LAND, a, b) : a ? a : b;
}

/* True with this chance; the number becomes another one, which a chance above 1 would crowd. */
static ir_ref draw(struct finder *f, ir_ref chance)
{
    struct ir_graph *g = f->graph;
    chance = ir_op3(g, IR_CLAMP, chance, ir_const_float(g, 0.0f), ir_const_float(g, 1.0f));
    if (ir_const_is(g, chance, 0.0f) || ir_const_is(g, chance, 1.0f))
        return ir_const_bool(g, ir_const_is(g, chance, 1.0f));
    ir_ref is_it = ir_op2(g, IR_LT, f->number, chance);
    ir_ref low = ir_op2(g, IR_DIV, f->number, chance), high = ir_op2(g, IR_SUB, f->number, chance);
    high = ir_op2(g, IR_DIV, high, closure_one_minus(g, chance));
    ir_ref number = ir_op3(g, IR_SELECT, is_it, low, high);
    f->number = ir_op2(g, IR_MIN, number, ir_const_float(g, 0.9999999f));
    return is_it;
}

static bool is_color_free(const struct ir_graph *g, ir_ref chance)
{
    return chance && ir_type_of(g, chance) == IR_TYPE_FLOAT;
}

/* The coefficients of a medium over its thickness; 0: the leaf is none. */
static void find_medium(struct finder *f, struct closure_level *level)
{
    ir_ref absorption = closure_call(f->shader, f->host, level->leaf, LEAF_ABSORPTION, NULL),
           scattering = closure_call(f->shader, f->host, level->leaf, LEAF_SCATTERING, NULL);
    if (!absorption || !scattering)
        return;
    ir_ref extinction = ir_op2(f->graph, IR_ADD, absorption, scattering);
    if (ir_const_is(f->graph, extinction, 0.0f))
        return;
    level->scattering = scattering;
    level->extinction = extinction;
    level->anisotropy = closure_call(f->shader, f->host, level->leaf, LEAF_ANISOTROPY, NULL);
    level->is_body = !closure_has(f->shader, f->host, level->leaf, LEAF_SAMPLE);
}

static bool is_lobe(struct finder *f, ir_ref leaf)
{
    struct closure_scatter s = {.shader = f->shader, .graph = f->graph, .host = f->host};
    return ir_type_of(f->graph, leaf) == IR_TYPE_BSDF && !closure_source(f->shader, leaf)
           && !closure_has(f->shader, f->host, leaf, LEAF_FACTOR) && !scatter_refracts(&s, leaf);
}

/* False: the leaf cannot be a level. */
static bool add_leaf(struct finder *f, ir_ref leaf, ir_ref is_here)
{
    ir_ref weight = ir_arg(f->graph, leaf, 0);
    if (!is_lobe(f, leaf) || !is_color_free(f->graph, weight) || f->pile->levels.len == MAX_LEVELS)
        return false;
    if (ir_const_is(f->graph, weight, 0.0f))
        return true;
    if (!ir_const_is(f->graph, weight, 1.0f))
        is_here = both(f->graph, is_here, draw(f, weight));
    struct closure_level level = {.leaf = leaf, .is_here = is_here};
    find_medium(f, &level);
    vec_push(f->shader->arena, &f->pile->levels, level);
    return true;
}

/* Light of a surface, as a level. */
static void add_light(struct finder *f, ir_ref edf, ir_ref is_here)
{
    struct closure_level level = {.is_here = is_here};
    struct closure_list list;
    ir_ref at_rest = ir_const_float(f->graph, 0.0f);
    level.emission = ir_const_splat(f->graph, IR_TYPE_VEC3, 0.0f);
    closure_flatten(f->shader, f->host, edf, &list);
    for (uint32_t i = 0; i < list.leaves.len; i++) {
        const struct closure_leaf *leaf = &list.leaves.items[i];
        ir_ref light = closure_call(f->shader, f->host, leaf->leaf, LEAF_EMISSION, NULL);
        if (!light)
            continue;
        shader_add_closure(f->shader, leaf->leaf);
        ir_ref weight = closure_weight(f->shader, leaf, at_rest);
        light = ir_op2(f->graph, IR_MUL, ir_convert(f->graph, IR_TYPE_VEC3, light), weight);
        level.emission = ir_op2(f->graph, IR_ADD, level.emission, light);
    }
    vec_push(f->shader->arena, &f->pile->levels, level);
}

/* Opens the operands of an operator, the first one last. False: it is none of a pile. */
static bool open_operands(struct finder *f, struct operand of, struct operand out[2])
{
    const struct ir_node node = *ir_get(f->graph, of.ref);
    if (node.op != IR_LAYER && node.op != IR_CLOSURE_MIX)
        return false;
    out[0] = (struct operand){ir_arg(f->graph, of.ref, 1), of.is_here};
    out[1] = (struct operand){ir_arg(f->graph, of.ref, 0), of.is_here};
    if (node.op == IR_LAYER)
        return !out[0].ref || ir_type_of(f->graph, out[0].ref) == IR_TYPE_BSDF;
    ir_ref share = ir_arg(f->graph, of.ref, 2);
    if (!is_color_free(f->graph, share))
        return false;
    ir_ref is_second = draw(f, share);
    ir_ref is_first = ir_op1(f->graph, IR_NOT, is_second);
    out[0].is_here = both(f->graph, of.is_here, is_second);
    out[1].is_here = both(f->graph, of.is_here, is_first);
    return true;
}

static bool find_levels(struct finder *f, struct operand root)
{
    VEC(struct operand) open = {0};
    vec_push(f->shader->arena, &open, root);
    while (open.len) {
        struct operand at = vec_last(&open), operands[2];
        open.len--;
        bool is_good = true;
        if (!at.ref)
            continue;
        ir_push_origin_of(f->graph, at.ref);
        if (ir_type_of(f->graph, at.ref) == IR_TYPE_EDF) {
            is_good = f->pile->levels.len < MAX_LEVELS;
            add_light(f, at.ref, at.is_here);
        } else if (ir_get(f->graph, at.ref)->op == IR_LEAF) {
            is_good = add_leaf(f, at.ref, at.is_here);
        } else if ((is_good = open_operands(f, at, operands))) {
            vec_push(f->shader->arena, &open, operands[0]);
            vec_push(f->shader->arena, &open, operands[1]);
        }
        ir_pop_origin(f->graph);
        if (!is_good)
            return false;
    }
    return true;
}

static bool any_walks(const struct ir_graph *g, const struct closure_pile *pile,
                      bool is_seen_through)
{
    for (uint32_t i = 0; i < pile->levels.len; i++) {
        const struct closure_level *level = &pile->levels.items[i];
        if (level->is_body)
            return true;
        if (level->extinction && (is_seen_through || !ir_const_is(g, level->scattering, 0.0f)))
            return true;
    }
    return false;
}

/* The number between the whole ones, and which of those it follows. */
static void find_parts(struct finder *f, uint32_t num)
{
    struct ir_graph *g = f->graph;
    ir_ref part = ir_op1(g, IR_FLOOR, f->number);
    f->number = ir_op2(g, IR_SUB, f->number, part);
    f->pile->is_part = ARENA_ARRAY(f->shader->arena, ir_ref, num);
    for (uint32_t i = 0; i < num; i++)
        f->pile->is_part[i] = ir_op2(g, IR_EQ, part, ir_const_float(g, (float)i));
}

bool closure_find_pile(struct shader *shader, const struct closure_host *host,
                       const ir_ref *closures, uint32_t num_closures, bool is_seen_through,
                       struct closure_pile *out)
{
    struct finder f = {shader, shader->graph, host, out, 0};
    ir_ref matter = shader_stream(shader, STR_matter, IR_TYPE_VEC2);
    *out = (struct closure_pile){0};
    f.number = ir_component(shader->graph, matter, 1);
    if (num_closures > 1)
        find_parts(&f, num_closures);
    ir_ref number = f.number;
    for (uint32_t i = 0; i < num_closures; i++, f.number = number)
        if (!find_levels(&f, (struct operand){closures[i], out->is_part ? out->is_part[i] : 0}))
            return false;
    return any_walks(f.graph, out, is_seen_through);
}

/* ---- Values of levels ---- */

static ir_ref where(struct closure_scatter *s, ir_ref condition, ir_ref value, ir_ref other)
{
    return condition ? ir_op3(s->graph, IR_SELECT, condition, value, other) : value;
}

static ir_ref is_at(struct closure_scatter *s, uint32_t i)
{
    return scatter_op2(s, IR_EQ, s->level, scatter_number(s, (float)i));
}

/* The value of the level at hand among values[i], where 0 is `other`. */
static ir_ref at_hand(struct closure_scatter *s, const ir_ref *values, ir_ref other)
{
    for (uint32_t i = s->pile->levels.len; i-- > 0;)
        if (values[i])
            other = ir_op3(s->graph, IR_SELECT, is_at(s, i), values[i], other);
    return other;
}

static const struct closure_level *level_of(const struct closure_scatter *s, uint32_t i)
{
    return &s->pile->levels.items[i];
}

static ir_ref *new_values(struct closure_scatter *s)
{
    return ARENA_ARRAY(s->shader->arena, ir_ref, s->pile->levels.len);
}

static ir_ref has_extinction(struct closure_scatter *s, const struct closure_level *level)
{
    ir_ref sum = scatter_op2(s, IR_DOT, level->extinction, scatter_grey(s, 1.0f));
    return scatter_op2(s, IR_GT, sum, scatter_number(s, 0.0f));
}

static ir_ref attenuation(struct closure_scatter *s, ir_ref depth, ir_ref slope)
{
    return ir_op1(s->graph, IR_EXP, ir_op1(s->graph, IR_NEG, scatter_op2(s, IR_MUL, depth, slope)));
}

static ir_ref throughput(struct closure_scatter *s, ir_ref leaf)
{
    ir_ref through = closure_call(s->shader, s->host, leaf, LEAF_THROUGHPUT, NULL);
    return through ? ir_convert(s->graph, IR_TYPE_VEC3, through) : scatter_grey(s, 0.0f);
}

/* What a level lets through of light that goes straight on, towards the viewer. */
static ir_ref straight(struct closure_scatter *s, const struct closure_level *level, ir_ref slope)
{
    if (!level->leaf)
        return scatter_grey(s, 1.0f);
    ir_ref through = throughput(s, level->leaf);
    if (!level->extinction)
        return where(s, s->enters, through, scatter_grey(s, 1.0f));
    ir_ref is_medium = has_extinction(s, level);
    return where(s, is_medium, attenuation(s, level->extinction, slope), through);
}

/* The same of the whole pile, down to a body. */
static ir_ref straight_through(struct closure_scatter *s)
{
    ir_ref view = closure_view(s->shader, s->host), product = scatter_grey(s, 1.0f);
    ir_ref slope = closure_way(s->shader, s->host, view), is_above = 0;
    for (uint32_t i = 0; i < s->pile->levels.len; i++) {
        const struct closure_level *level = level_of(s, i);
        if (level->is_body) {
            ir_ref is_free = level->is_here ? ir_op1(s->graph, IR_NOT, level->is_here)
                                            : ir_const_bool(s->graph, false);
            is_above = both(s->graph, is_above, is_free);
            continue;
        }
        ir_ref passed = scatter_op2(s, IR_MUL, product, straight(s, level, slope));
        product = where(s, both(s->graph, is_above, level->is_here), passed, product);
    }
    return product;
}

/* The chances of the lobe and of going on, as sums of light. */
static ir_ref share_of_lobe(struct closure_scatter *s, ir_ref leaf)
{
    ir_ref albedo = closure_call(s->shader, s->host, leaf, LEAF_ALBEDO, NULL);
    if (!albedo)
        return scatter_number(s, 1.0f);
    return scatter_likely(s, scatter_mean_of(s, ir_convert(s->graph, IR_TYPE_VEC3, albedo)));
}

struct choice {
    ir_ref through, lobe, passes, all; /* lobe, passes: shares of `all` */
};

static struct choice choose(struct closure_scatter *s, ir_ref leaf)
{
    struct choice c = {.through = throughput(s, leaf), .lobe = share_of_lobe(s, leaf)};
    c.passes = scatter_mean_of(s, c.through);
    c.passes = scatter_op2(s, IR_MAX, c.passes, scatter_number(s, 0.0f));
    c.all = scatter_op2(s, IR_ADD, c.lobe, c.passes);
    return c;
}

static bool scatters(const struct closure_scatter *s, ir_ref leaf)
{
    return leaf && closure_has(s->shader, s->host, leaf, LEAF_SAMPLE);
}

/* ---- Light ---- */

static ir_ref lobe_response(struct closure_scatter *s, ir_ref leaf, ir_ref direction,
                            ir_ref solid_angle)
{
    ir_ref value =
        scatters(s, leaf) ? closure_call(s->shader, s->host, leaf, LEAF_EVAL, &direction) : 0;
    if (!value)
        return scatter_grey(s, 0.0f);
    value = ir_convert(s->graph, IR_TYPE_VEC3, value);
    if (!solid_angle)
        return value;
    struct choice c = choose(s, leaf);
    ir_ref density = closure_call(s->shader, s->host, leaf, LEAF_PDF, &direction);
    density = scatter_op2(s, IR_MUL, density, scatter_op2(s, IR_DIV, c.lobe, c.all));
    return scatter_balanced(s, value, density, solid_angle);
}

ir_ref matter_response(struct closure_scatter *s, ir_ref direction, ir_ref solid_angle)
{
    ir_ref *values = new_values(s), black = scatter_grey(s, 0.0f), above = black;
    ir_ref way = closure_way(s->shader, s->host, direction);
    for (uint32_t i = 0; i < s->pile->levels.len; i++) {
        const struct closure_level *level = level_of(s, i);
        ir_ref lobe = lobe_response(s, level->leaf, direction, solid_angle);
        values[i] = scatter_op2(s, IR_MUL, lobe, attenuation(s, above, way));
        if (!level->extinction)
            continue;
        ir_ref is_medium = has_extinction(s, level);
        values[i] = where(s, is_medium, scatter_grey(s, 1.0f), values[i]);
        if (level->is_body)
            continue;
        ir_ref more = scatter_op2(s, IR_ADD, above, level->extinction);
        above = where(s, level->is_here, more, above);
    }
    return at_hand(s, values, black);
}

/* ---- The function ---- */

/* The first level that is there: from `after` on, or for 0 of all. */
static ir_ref next_level(struct closure_scatter *s, ir_ref after)
{
    ir_ref next = scatter_number(s, -1.0f);
    for (uint32_t i = s->pile->levels.len; i-- > 0;) {
        ir_ref number = scatter_number(s, (float)i), is_it = level_of(s, i)->is_here;
        if (after)
            is_it = both(s->graph, is_it, scatter_op2(s, IR_LT, after, number));
        next = where(s, is_it, number, next);
    }
    return next;
}

/* The last medium that is there above the level at hand. */
static ir_ref medium_above(struct closure_scatter *s)
{
    ir_ref above = scatter_number(s, -1.0f);
    for (uint32_t i = 0; i < s->pile->levels.len; i++) {
        const struct closure_level *level = level_of(s, i);
        if (!level->extinction || level->is_body)
            continue;
        ir_ref number = scatter_number(s, (float)i);
        ir_ref is_it = scatter_op2(s, IR_GT, s->level, number);
        above = where(s, both(s->graph, is_it, level->is_here), number, above);
    }
    return above;
}

/* A lobe reflects light, or lets it go on. */
static void sample_lobe(struct closure_scatter *s, ir_ref leaf)
{
    struct choice c = choose(s, leaf);
    ir_ref results[3];          /* direction, f cos / pdf, pdf */
    ir_ref passing = c.through; /* where nothing passes, the lobe is picked */
    if (!ir_const_is(s->graph, c.passes, 0.0f))
        passing = scatter_op2(s, IR_MUL, c.through, scatter_op2(s, IR_DIV, c.all, c.passes));
    scatter_effect(s, EFFECT_ASSIGN, s->parts[0].weight, passing);
    closure_call_all(s->shader, s->host, leaf, LEAF_SAMPLE, NULL, results);
    ir_ref point = scatter_op2(s, IR_MUL, scatter_random_number(s->shader), c.all);
    ir_ref weight = scatter_op2(s, IR_MUL, results[1], scatter_op2(s, IR_DIV, c.all, c.lobe));
    ir_ref density = scatter_op2(s, IR_MUL, results[2], scatter_op2(s, IR_DIV, c.lobe, c.all));
    scatter_effect(s, EFFECT_IF, 0, scatter_op2(s, IR_LT, point, c.lobe));
    scatter_effect(s, EFFECT_ASSIGN, s->direction, results[0]);
    scatter_effect(s, EFFECT_ASSIGN, s->is_inside, scatter_number(s, 0.0f));
    scatter_effect(s, EFFECT_ASSIGN, s->parts[0].weight, weight);
    scatter_effect(s, EFFECT_ASSIGN, s->density, density);
    scatter_effect(s, EFFECT_END, 0, 0);
}

static ir_ref emission_at_hand(struct closure_scatter *s)
{
    ir_ref *values = new_values(s);
    for (uint32_t i = 0; i < s->pile->levels.len; i++) {
        const struct closure_level *level = level_of(s, i);
        values[i] = level->leaf ? closure_call(s->shader, s->host, level->leaf, LEAF_EMISSION, NULL)
                                : level->emission;
    }
    return at_hand(s, values, scatter_grey(s, 0.0f));
}

void matter_sample(struct closure_scatter *s)
{
    ir_ref matter = shader_stream(s->shader, STR_matter, IR_TYPE_VEC2);
    ir_ref asked = ir_component(s->graph, matter, 0), nothing = scatter_number(s, 0.0f);
    ir_ref enters = scatter_op2(s, IR_LT, asked, nothing);
    s->enters = enters;
    s->level = where(s, enters, next_level(s, 0), asked);
    /* what lies on the pile shines once */
    ir_ref on_top = where(s, enters, s->emission, scatter_grey(s, 0.0f));
    s->emission = scatter_op2(s, IR_ADD, on_top, emission_at_hand(s));
    scatter_declare_locals(s, nothing);
    ir_ref on = ir_op1(s->graph, IR_NEG, closure_view(s->shader, s->host));
    scatter_effect(s, EFFECT_ASSIGN, s->direction, on);
    scatter_effect(s, EFFECT_ASSIGN, s->is_inside, scatter_number(s, 2.0f));
    scatter_effect(s, EFFECT_ASSIGN, s->parts[0].weight, scatter_grey(s, 1.0f));
    ir_ref white = scatter_grey(s, 1.0f), black = scatter_grey(s, 0.0f);
    for (uint32_t p = 1; p < s->num_parts; p++)
        scatter_effect(s, EFFECT_ASSIGN, s->parts[p].weight,
                       where(s, s->pile->is_part[p], white, black));
    for (uint32_t i = 0; i < s->pile->levels.len; i++) {
        ir_ref leaf = level_of(s, i)->leaf;
        if (leaf)
            shader_add_closure(s->shader, leaf);
        if (!scatters(s, leaf))
            continue;
        scatter_effect(s, EFFECT_IF, 0, is_at(s, i));
        sample_lobe(s, leaf);
        scatter_effect(s, EFFECT_END, 0, 0);
    }
}

ir_ref matter_is_body(struct closure_scatter *s)
{
    ir_ref *values = new_values(s);
    for (uint32_t i = 0; i < s->pile->levels.len; i++)
        values[i] = level_of(s, i)->is_body ? scatter_number(s, 1.0f) : 0;
    return at_hand(s, values, scatter_number(s, 0.0f));
}

/* The body that is there. */
static void write_body(struct closure_scatter *s)
{
    ir_ref extinction = scatter_grey(s, 0.0f), at = scatter_number(s, -2.0f);
    for (uint32_t i = s->pile->levels.len; i-- > 0;) {
        const struct closure_level *level = level_of(s, i);
        if (!level->is_body)
            continue;
        ir_ref none = ir_const_is(s->graph, at, -2.0f) ? scatter_number(s, -1.0f) : at;
        extinction = where(s, level->is_here, level->extinction, extinction);
        at = where(s, level->is_here, scatter_number(s, (float)i), none);
    }
    scatter_write_output(s, STR_out12, extinction, at);
}

void matter_write(struct closure_scatter *s)
{
    ir_ref *scattering = new_values(s), *extinction = new_values(s), *anisotropy = new_values(s);
    ir_ref black = scatter_grey(s, 0.0f), nothing = scatter_number(s, 0.0f);
    for (uint32_t i = 0; i < s->pile->levels.len; i++) {
        scattering[i] = level_of(s, i)->scattering;
        extinction[i] = level_of(s, i)->extinction;
        anisotropy[i] = level_of(s, i)->anisotropy;
    }
    ir_ref rgb = at_hand(s, scattering, black), a = at_hand(s, anisotropy, nothing);
    scatter_write_output(s, STR_out9, rgb, a);
    rgb = at_hand(s, extinction, black);
    a = next_level(s, s->level);
    scatter_write_output(s, STR_out10, rgb, a);
    ir_ref whole = straight_through(s);
    a = medium_above(s);
    scatter_write_output(s, STR_out11, whole, a);
    write_body(s);
    s->shader->transparent |= !ir_const_is(s->graph, whole, 0.0f);
}
