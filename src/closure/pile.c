// SPDX-License-Identifier: Apache-2.0
/*
 * The levels of a pile of matter (matter_levels.c), from above, and what a random number decides
 * about them; shares and weights are floats:
 *
 *     layer(top, base)   the levels of both
 *     mix(bg, fg, m)     one or the other
 *     a leaf's weight    whether it is there
 *     add(a, b)          one or the other behind a gate of 2, where neither lets light through
 *     scale(a, c)        behind a gate of c, where a lets no light through, or nothing lies below;
 *                        or of a leaf that is no medium, what it reflects
 *
 * A leaf that refracts leads into a solid, so nothing may lie below it but the medium of the solid.
 */
#include "closure/scatter.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"

enum { MAX_LEVELS = 48, MAX_STEPS = 1024 }; /* steps: a closure may have several parents */

static const char share_has_colors[] = "a share of its tree has colours",
                  scaled_medium[] = "a scaled closure has a medium and lets light through",
                  too_large[] = "its tree is too large";

struct finder {
    struct shader *shader;
    struct ir_graph *graph;
    const struct closure_host *host;
    struct closure_pile *pile;
    ir_ref number; /* not used so far: even from 0 to below 1 */
    bool is_seen_through, any_medium, any_walk, any_solid; /* any_walk: of a medium */
    const char *why;                                       /* the closure is no pile; NULL: it is */
};

struct operand {
    ir_ref ref, is_here;
    ir_ref scale;    /* of what its leaves reflect; 0: 1 */
    ir_ref medium;   /* transmittance of the solid behind; 0: 1 */
    ir_ref interior; /* VDF of this solid; 0: none */
    bool is_last;    /* nothing lies below it */
};

static bool is_float(const struct ir_graph *g, ir_ref value)
{
    return value && ir_type_of(g, value) == IR_TYPE_FLOAT;
}

static ir_ref limited(struct ir_graph *g, ir_ref chance)
{
    return ir_saturate(g, chance);
}

/* True with this chance; the number becomes another one, which a chance above 1 would crowd. */
static ir_ref draw(struct finder *f, ir_ref chance)
{
    struct ir_graph *g = f->graph;
    chance = limited(g, chance);
    if (ir_const_is(g, chance, 0.0f) || ir_const_is(g, chance, 1.0f))
        return ir_const_bool(g, ir_const_is(g, chance, 1.0f));
    ir_ref is_it = ir_op2(g, IR_LT, f->number, chance);
    f->number = FORMULA(f->shader, "mx_rest_of_number", f->number, chance);
    return is_it;
}

static void refuse(struct finder *f, const char *why)
{
    f->why = f->why ? f->why : why;
}

/* ---- Leaves ---- */

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
    f->any_medium = true;
    f->any_walk |= level->is_body || f->is_seen_through || !ir_const_is(f->graph, scattering, 0.0f);
}

static void add_level(struct finder *f, struct closure_level level)
{
    if (f->pile->levels.len == MAX_LEVELS)
        refuse(f, too_large);
    else
        vec_push(f->shader->arena, &f->pile->levels, level);
}

static bool is_lobe(struct finder *f, ir_ref leaf)
{
    return ir_type_of(f->graph, leaf) == IR_TYPE_BSDF && !closure_source(f->shader, leaf)
           && !closure_has(f->shader, f->host, leaf, LEAF_FACTOR);
}

static void add_leaf(struct finder *f, struct operand at)
{
    struct closure_scatter s = {.shader = f->shader, .graph = f->graph, .host = f->host};
    ir_ref weight = ir_arg(f->graph, at.ref, 0);
    if (ir_const_is(f->graph, weight, 0.0f))
        return;
    if (!is_lobe(f, at.ref)) {
        refuse(f, "one of its closures comes from a library");
        return;
    }
    struct closure_level level = {.leaf = at.ref,
                                  .is_here = at.is_here,
                                  .scale = at.scale,
                                  .solid = at.medium,
                                  .interior = at.interior};
    level.refracts = scatter_refracts(&s, at.ref);
    f->any_solid |= level.refracts;
    find_medium(f, &level);
    if (!is_float(f->graph, weight))
        refuse(f, share_has_colors);
    else if (!ir_const_is(f->graph, weight, 1.0f))
        level.is_here = scatter_both(f->graph, at.is_here, draw(f, weight));
    if (level.refracts && !at.is_last)
        refuse(f, "a closure that refracts lies on another one");
    if (level.scale && level.extinction)
        refuse(f, scaled_medium);
    add_level(f, level);
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
    add_level(f, level);
}

/* ---- Operators ---- */

static bool is_opaque(struct finder *f, ir_ref closure)
{
    ir_ref at_rest = ir_const_float(f->graph, 0.0f);
    return closure
           && ir_const_is(f->graph, closure_throughput(f->shader, f->host, closure, at_rest), 0.0f);
}

/* Adds a gate, which multiplies the operand's light. */
static void add_gate(struct finder *f, struct operand of, ir_ref gate)
{
    struct closure_level level = {.is_here = of.is_here,
                                  .gate = ir_convert(f->graph, IR_TYPE_VEC3, gate)};
    add_level(f, level);
}

static struct operand open_scale(struct finder *f, struct operand of)
{
    struct operand out = of;
    ir_ref scale = limited(f->graph, ir_arg(f->graph, of.ref, 1));
    out.ref = ir_arg(f->graph, of.ref, 0);
    if (is_opaque(f, out.ref) || (of.is_last && !f->is_seen_through)) {
        add_gate(f, of, scale);
        return out;
    }
    scale = ir_convert(f->graph, IR_TYPE_VEC3, scale);
    out.scale = of.scale ? ir_op2(f->graph, IR_MUL, of.scale, scale) : scale;
    return out;
}

/* Puts one or the other into the pile. */
static void choose(struct finder *f, struct operand out[2], ir_ref share, ir_ref is_here)
{
    ir_ref is_second = draw(f, share);
    out[0].is_here = scatter_both(f->graph, is_here, is_second);
    out[1].is_here = scatter_both(f->graph, is_here, ir_op1(f->graph, IR_NOT, is_second));
}

/* Opens the operands of an operator, the first one last; 0: none. */
static void open_operands(struct finder *f, struct operand of, struct operand out[2])
{
    const struct ir_node node = *ir_get(f->graph, of.ref);
    out[0] = out[1] = (struct operand){0};
    if (node.op == IR_CLOSURE_SCALE) {
        out[1] = open_scale(f, of);
        return;
    }
    if (of.scale) /* of more than a lobe */
        refuse(f, scaled_medium);
    out[0] = out[1] = of;
    out[0].ref = ir_arg(f->graph, of.ref, 1);
    out[1].ref = ir_arg(f->graph, of.ref, 0);
    if (node.op == IR_LAYER && out[0].ref && ir_type_of(f->graph, out[0].ref) == IR_TYPE_VDF) {
        ir_ref medium = closure_transmittance(f->shader, f->host, out[0].ref);
        out[1].medium = ir_product(f->graph, of.medium, medium);
        out[1].interior = closure_joined(f->graph, of.interior, out[0].ref);
        out[0].ref = 0;
    } else if (node.op == IR_LAYER) {
        out[1].is_last = of.is_last && !out[0].ref;
    } else if (node.op == IR_CLOSURE_MIX) {
        ir_ref share = ir_arg(f->graph, of.ref, 2);
        if (is_float(f->graph, share))
            choose(f, out, share, of.is_here);
        else
            refuse(f, share_has_colors);
    } else if (node.op == IR_CLOSURE_ADD) {
        if (!is_opaque(f, out[0].ref) || !is_opaque(f, out[1].ref))
            refuse(f, "closures that it adds let light through");
        choose(f, out, ir_const_float(f->graph, 0.5f), of.is_here);
        add_gate(f, of, ir_const_float(f->graph, 2.0f));
    } else {
        refuse(f, "its tree has another operator");
        out[0].ref = out[1].ref = 0;
    }
}

static void find_levels(struct finder *f, struct operand root)
{
    VEC(struct operand) open = {0};
    vec_push(f->shader->arena, &open, root);
    for (uint32_t steps = 0; open.len && f->why != too_large; steps++) {
        struct operand at = vec_last(&open), operands[2];
        if (steps == MAX_STEPS)
            f->why = too_large;
        open.len--;
        if (!at.ref)
            continue;
        ir_push_origin_of(f->graph, at.ref);
        if (ir_type_of(f->graph, at.ref) == IR_TYPE_EDF) {
            add_light(f, at.ref, at.is_here);
        } else if (ir_get(f->graph, at.ref)->op == IR_LEAF) {
            add_leaf(f, at);
        } else {
            open_operands(f, at, operands);
            vec_push(f->shader->arena, &open, operands[0]);
            vec_push(f->shader->arena, &open, operands[1]);
        }
        ir_pop_origin(f->graph);
    }
}

/* ---- Parts ---- */

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
    struct finder f = {.shader = shader,
                       .graph = shader->graph,
                       .host = host,
                       .pile = out,
                       .is_seen_through = is_seen_through};
    ir_ref matter = shader_stream(shader, STR_matter, IR_TYPE_VEC2);
    *out = (struct closure_pile){0};
    f.number = ir_component(shader->graph, matter, 1);
    if (num_closures > 1)
        find_parts(&f, num_closures);
    ir_ref number = f.number;
    for (uint32_t i = 0; i < num_closures; i++, f.number = number)
        find_levels(&f, (struct operand){.ref = closures[i],
                                         .is_here = out->is_part ? out->is_part[i] : 0,
                                         .is_last = true});
    /* refracted light pays for clear media where it goes in, and where it comes out */
    bool walks = f.any_walk || (f.any_medium && f.any_solid);
    shader->reflection.not_walked = walks ? f.why : NULL;
    return walks && !f.why;
}
