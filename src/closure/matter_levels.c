// SPDX-License-Identifier: Apache-2.0
/*
 * A pile of matter, for path tracers that walk through media at random: the leaves of a tree from
 * above, each one level. A random number that stays the same while light is in the pile decides
 * which of them are there (pile.c; Guo, Hašan, Zhao 2018, "Position-Free Monte Carlo Simulation for
 * Arbitrary Layered BSDFs").
 *
 * The tracer asks for one level after the other:
 *
 *     matter = vec2(level, or -1 the first one, or -2 for light in a solid; random number)
 *         the number is from 0 to below 1 for the surface, and k higher for the BSDF of the AOV k,
 *         which is a pile of its own and has the weight 1 where its light is asked for
 *     a lobe: light from above is reflected by it, goes on as it came, or is refracted:
 *         out2 = vec4(L, 2 where it goes on, 1 where it is refracted)
 *         out3 = vec4(weight, density)
 *     a lobe that refracts, where out4.w is 2: it comes first for light in a solid
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

#include "ir/arithmetic.h"
#include "shader/formula.h"

#include <assert.h>

/* ---- Values of levels ---- */

static ir_ref where(struct closure_scatter *s, ir_ref condition, ir_ref value, ir_ref other)
{
    return condition ? ir_op3(s->graph, IR_SELECT, condition, value, other) : value;
}

static ir_ref is_at(struct closure_scatter *s, uint32_t i)
{
    struct text name;
    text_init(&name, s->shader->arena);
    text_fmt(&name, "is_level_%u", (unsigned)i);
    return scatter_named(s, scatter_op2(s, IR_EQ, s->level, scatter_number(s, (float)i)),
                         text_cstr(&name));
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
    return FORMULA(s->shader, "mx_is_medium", level->extinction);
}

static ir_ref attenuation(struct closure_scatter *s, ir_ref depth, ir_ref slope)
{
    return FORMULA(s->shader, "mx_transmittance", ir_mul(s->graph, depth, slope));
}

static ir_ref throughput(struct closure_scatter *s, ir_ref leaf)
{
    ir_ref through = closure_call(s->shader, s->host, leaf, LEAF_THROUGHPUT, NULL);
    return through ? ir_convert(s->graph, IR_TYPE_VEC3, through) : scatter_grey(s, 0.0f);
}

/* Returns what a level lets through of light that goes straight on, towards the viewer. */
static ir_ref straight(struct closure_scatter *s, const struct closure_level *level, ir_ref slope)
{
    ir_ref black = scatter_grey(s, 0.0f), white = scatter_grey(s, 1.0f);
    if (!level->leaf)
        return level->gate ? where(s, s->enters, level->gate, white) : white;
    if (level->refracts)
        return ir_op3(s->graph, IR_SELECT, s->enters, black, white);
    ir_ref through = throughput(s, level->leaf);
    if (!level->extinction)
        return where(s, s->enters, through, white);
    ir_ref is_medium = has_extinction(s, level);
    return where(s, is_medium, attenuation(s, level->extinction, slope), through);
}

/* Returns what the whole pile lets through straight on, down to a body. */
static ir_ref straight_through(struct closure_scatter *s)
{
    ir_ref view = closure_view(s->shader, s->host), product = scatter_grey(s, 1.0f);
    ir_ref slope = closure_way(s->shader, s->host, view), is_above = 0;
    for (uint32_t i = 0; i < s->pile->levels.len; i++) {
        const struct closure_level *level = level_of(s, i);
        if (level->is_body) {
            ir_ref is_free = level->is_here ? ir_op1(s->graph, IR_NOT, level->is_here)
                                            : ir_const_bool(s->graph, false);
            is_above = scatter_both(s->graph, is_above, is_free);
            continue;
        }
        ir_ref passed = scatter_op2(s, IR_MUL, product, straight(s, level, slope));

        product = where(s, scatter_both(s->graph, is_above, level->is_here), passed, product);
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

static struct choice choose(struct closure_scatter *s, const struct closure_level *level)
{
    struct choice c = {.lobe = share_of_lobe(s, level->leaf)};
    c.through = level->refracts ? scatter_grey(s, 0.0f) : throughput(s, level->leaf);
    c.passes = FORMULA(s->shader, "mx_brightness", c.through);
    c.all = scatter_op2(s, IR_ADD, c.lobe, c.passes);
    closure_name(s->shader, c.lobe, level->leaf, "chance");
    closure_name(s->shader, c.passes, level->leaf, "passing");
    closure_name(s->shader, c.all, level->leaf, "chances");
    return c;
}

static bool scatters(const struct closure_scatter *s, ir_ref leaf)
{
    return leaf && closure_has(s->shader, s->host, leaf, LEAF_SAMPLE);
}

/* ---- Light ---- */

static ir_ref lobe_response(struct closure_scatter *s, const struct closure_level *level,
                            ir_ref direction, ir_ref solid_angle)
{
    ir_ref leaf = level->leaf, black = scatter_grey(s, 0.0f);
    ir_ref value =
        scatters(s, leaf) ? closure_call(s->shader, s->host, leaf, LEAF_EVAL, &direction) : 0;
    if (!value)
        return black;
    value = ir_product(s->graph, ir_convert(s->graph, IR_TYPE_VEC3, value), level->scale);
    if (level->refracts)
        value = where(s, scatter_is_in_front(s, direction), value, black);
    if (!solid_angle)
        return value;
    struct choice c = choose(s, level);
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
        ir_ref lobe = lobe_response(s, level, direction, solid_angle);
        ir_ref passed = attenuation(s, above, way);
        if (level->refracts)
            passed = where(s, s->exits, scatter_grey(s, 1.0f), passed);
        values[i] = scatter_op2(s, IR_MUL, lobe, passed);
        if (!level->extinction)
            continue;
        ir_ref is_medium = has_extinction(s, level);
        values[i] = where(s, is_medium, scatter_grey(s, 1.0f), values[i]);
        if (level->is_body)
            continue;
        ir_ref more = scatter_op2(s, IR_ADD, above, level->extinction);
        above = scatter_named(s, where(s, level->is_here, more, above), "extinction_above");
    }
    return scatter_named(s, at_hand(s, values, black), "response");
}

/* ---- The function ---- */

/* The first level that is there: from `after` on, or for 0 of all. */
static ir_ref next_level(struct closure_scatter *s, ir_ref after)
{
    ir_ref next = scatter_number(s, -1.0f);
    for (uint32_t i = s->pile->levels.len; i-- > 0;) {
        ir_ref number = scatter_number(s, (float)i), is_it = level_of(s, i)->is_here;
        if (after)
            is_it = scatter_both(s->graph, is_it, scatter_op2(s, IR_LT, after, number));
        next = where(s, is_it, number, next);
    }
    return scatter_named(s, next, after ? "next_level" : "first_level");
}

/* The lobe that leads out of a solid, where one is there; else `other`. */
static ir_ref way_out(struct closure_scatter *s, ir_ref other)
{
    for (uint32_t i = s->pile->levels.len; i-- > 0;)
        if (level_of(s, i)->refracts)
            other = where(s, level_of(s, i)->is_here, scatter_number(s, (float)i), other);
    return other;
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
        above = where(s, scatter_both(s->graph, is_it, level->is_here), number, above);
    }
    return scatter_named(s, above, "medium_above");
}

/* A lobe reflects light, or lets it go on. */
static void sample_lobe(struct closure_scatter *s, const struct closure_level *level)
{
    struct choice c = choose(s, level);
    ir_ref results[3];          /* direction, f cos / pdf, pdf */
    ir_ref passing = c.through; /* where nothing passes, the lobe is picked */
    if (!ir_const_is(s->graph, c.passes, 0.0f))
        passing = scatter_op2(s, IR_MUL, c.through, scatter_op2(s, IR_DIV, c.all, c.passes));
    scatter_effect(s, EFFECT_ASSIGN, s->parts[0].weight, passing);
    closure_call_all(s->shader, s->host, level->leaf, LEAF_SAMPLE, NULL, results);
    ir_ref point = scatter_op2(s, IR_MUL, scatter_random_number(s->shader), c.all);
    ir_ref weight = scatter_op2(s, IR_MUL, results[1], scatter_op2(s, IR_DIV, c.all, c.lobe));
    ir_ref density = scatter_op2(s, IR_MUL, results[2], scatter_op2(s, IR_DIV, c.lobe, c.all));
    scatter_effect(s, EFFECT_IF, 0, scatter_op2(s, IR_LT, point, c.lobe));
    scatter_effect(s, EFFECT_ASSIGN, s->direction, results[0]);
    scatter_effect(s, EFFECT_ASSIGN, s->is_inside, scatter_number(s, 0.0f));
    if (level->refracts)
        scatter_take_side(s, results[0], level->solid, level->interior, &density);
    scatter_effect(s, EFFECT_ASSIGN, s->parts[0].weight,
                   ir_product(s->graph, weight, level->scale));
    scatter_effect(s, EFFECT_ASSIGN, s->density, density);
    scatter_effect(s, EFFECT_END, 0, 0);
}

/* Returns what goes on has this weight unless a lobe has another one. */
static ir_ref gate_at_hand(struct closure_scatter *s)
{
    ir_ref *values = new_values(s);
    for (uint32_t i = 0; i < s->pile->levels.len; i++)
        values[i] = level_of(s, i)->gate;
    return at_hand(s, values, scatter_grey(s, 1.0f));
}

static ir_ref emission_of(struct closure_scatter *s, const struct closure_level *level)
{
    if (!level->leaf)
        return level->emission;
    ir_ref light = closure_call(s->shader, s->host, level->leaf, LEAF_EMISSION, NULL);
    return light && level->scale ? scatter_op2(s, IR_MUL, light, level->scale) : light;
}

static ir_ref emission_at_hand(struct closure_scatter *s)
{
    ir_ref *values = new_values(s);
    for (uint32_t i = 0; i < s->pile->levels.len; i++)
        values[i] = emission_of(s, level_of(s, i));
    return at_hand(s, values, scatter_grey(s, 0.0f));
}

void matter_sample(struct closure_scatter *s)
{
    ir_ref matter = shader_stream(s->shader, STR_matter, IR_TYPE_VEC2);
    ir_ref asked = ir_component(s->graph, matter, 0), nothing = scatter_number(s, 0.0f);
    ir_ref enters = scatter_named(s, scatter_op2(s, IR_LT, asked, nothing), "enters");
    ir_ref first = next_level(s, 0);
    s->enters = enters;
    s->exits = scatter_op2(s, IR_LT, asked, scatter_number(s, -1.5f));
    s->level = where(s, enters, where(s, s->exits, way_out(s, first), first), asked);
    scatter_named(s, s->level, "level");
    /* what lies on the pile shines once */
    ir_ref on_top = where(s, enters, s->emission, scatter_grey(s, 0.0f));
    s->emission = scatter_op2(s, IR_ADD, on_top, emission_at_hand(s));
    scatter_declare_locals(s, nothing);
    ir_ref on = ir_op1(s->graph, IR_NEG, closure_view(s->shader, s->host));
    scatter_effect(s, EFFECT_ASSIGN, s->direction, on);
    scatter_effect(s, EFFECT_ASSIGN, s->is_inside, scatter_number(s, 2.0f));
    scatter_effect(s, EFFECT_ASSIGN, s->parts[0].weight, gate_at_hand(s));
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
        sample_lobe(s, level_of(s, i));
        scatter_effect(s, EFFECT_END, 0, 0);
    }
}

ir_ref matter_inside(struct closure_scatter *s)
{
    ir_ref *values = new_values(s);
    for (uint32_t i = 0; i < s->pile->levels.len; i++) {
        const struct closure_level *level = level_of(s, i);
        values[i] = level->is_body    ? scatter_number(s, 1.0f)
                    : level->refracts ? scatter_number(s, 2.0f)
                                      : 0;
    }
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
    s->shader->reflection.transparent |= !ir_const_is(s->graph, whole, 0.0f);
}
