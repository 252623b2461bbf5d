// SPDX-License-Identifier: Apache-2.0
/*
 * The walk from a root to its slabs. An operator tells its operands where they lie:
 *
 *     layer(top, base)     base lies where the layer lies; top lies on base, with the thickness of
 *                          the layer
 *     all other operators  both operands lie where the operator lies
 *     root                 a body, or a sheet with a thickness
 *
 * One slab may lie at several places. A visit is one node at one place; equal visits are one visit,
 * and a stack of open visits takes the place of recursion. A base is visited before its top,
 * because a top that scatters light needs the albedo of what lies below: light bounces between
 * both.
 */
#include "slabs/slabs.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"
#include "slabs/slab_nodes.h"
#include "slabs/regime.h"
#include "slabs/spread.h"

#include "base/hash.h"
#include "base/table.h"

#include <assert.h>

/* Thicknesses over the mean free path, from which on nothing is seen through: exp(-7) is 1/1097. */
#define MOST_STRAIGHT 7.0f

/*
 * The way of the view behind rough interfaces: covariance of its slope and its place along an axis
 * of the surface, floats; all 0: the interfaces above are smooth, or nobody blurs.
 */
struct way {
    ir_ref slope, both, place;
};

struct where {
    ir_ref thickness; /* float, centimetres */
    ir_ref below;     /* closure: the lobes of everything below; 0: nothing */
    ir_ref spread;    /* float: of the interfaces above; 0: there are none */
    ir_ref depth;     /* vec3: optical, of what scatters light above; 0: nothing does */
    struct way way;
    uint32_t is_body;
    uint32_t is_straight; /* for light that nothing scatters: media only absorb */
};

struct visit {
    ir_ref node;
    struct where where;
    ir_ref result; /* valid once the visit is closed */
    bool is_closed;
};

struct known_albedo {
    ir_ref lobes, albedo;
};

struct walk {
    struct shader *shader;
    struct ir_graph *graph;
    const struct slabs_host *host;
    struct slab_nodes nodes; /* below the root */
    uint8_t *has_slabs;      /* per node */
    VEC(struct visit) visits;
    struct table known; /* visits by hash */
    VEC(uint32_t) open;
    VEC(struct known_albedo) albedos;
    struct table albedos_by_lobes; /* by hash */
    /* per node, of a closure, a float; 0: none */
    ir_ref *spreads, *slopes;
    /*
     * per node, vec3, 0: none: optical depth for scattering of the layers in it, and of a
     * centimetre of the rest; NULL: light walks through all of it
     */
    ir_ref *depths, *scattering;
};

static bool has_slabs(const struct walk *w, ir_ref ref)
{
    return w->has_slabs[slab_node_at(&w->nodes, ref)];
}

/* Returns what an array of the walk has for a node. */
static ir_ref known_for(const struct walk *w, const ir_ref *values, ir_ref ref)
{
    return values[slab_node_at(&w->nodes, ref)];
}

/* ---- Visits ---- */

static uint32_t hash_of(ir_ref node, const struct where *where)
{
    return hash_pair(node, hash_bytes(where, sizeof *where));
}

static bool is_visit(const struct visit *visit, ir_ref node, const struct where *where)
{
    return visit->node == node && memcmp(&visit->where, where, sizeof *where) == 0;
}

/* The number of a visit + 1; 0: there is none yet. */
static uint32_t find_visit(const struct walk *w, uint32_t hash, ir_ref node,
                           const struct where *where)
{
    for (uint32_t at = hash, found; (found = table_next(&w->known, hash, &at));)
        if (is_visit(&w->visits.items[found - 1], node, where))
            return found;
    return 0;
}

/* The result of a visit. False: the visit is open now; the one that asks runs again after it. */
static bool visited(struct walk *w, ir_ref node, struct where where, ir_ref *out_result)
{
    if (!has_slabs(w, node)) {
        *out_result = node;
        return true;
    }
    uint32_t hash = hash_of(node, &where), found = find_visit(w, hash, node, &where);
    if (found) {
        assert(w->visits.items[found - 1].is_closed); /* operands are older than operators */
        *out_result = w->visits.items[found - 1].result;
        return true;
    }
    vec_push(w->shader->arena, &w->visits, (struct visit){.node = node, .where = where});
    table_add(&w->known, w->shader->arena, hash, w->visits.len);
    vec_push(w->shader->arena, &w->open, w->visits.len - 1);
    return false;
}

/* ---- Slabs ---- */

/* Returns what a leaf reflects, with its weight. */
static ir_ref leaf_albedo(struct walk *w, ir_ref leaf)
{
    struct ir_graph *g = w->graph;
    struct closure_list list;
    ir_ref sum = ir_const_splat(g, IR_TYPE_VEC3, 0.0f), way = ir_const_float(g, CLOSURE_MEAN_WAY);
    closure_flatten(w->shader, w->host->closures, leaf, &list);
    for (uint32_t i = 0; i < list.leaves.len; i++) {
        const struct closure_leaf *part = &list.leaves.items[i];
        ir_ref albedo = closure_call(w->shader, w->host->closures, part->leaf, LEAF_ALBEDO, NULL);
        if (!albedo)
            continue;
        albedo = ir_op2(g, IR_MUL, albedo, closure_weight(w->shader, part, way));
        sum = ir_op2(g, IR_ADD, sum, ir_convert(g, IR_TYPE_VEC3, albedo));
    }
    return sum;
}

/* 0: it is unknown. What is no BSDF reflects nothing. */
static ir_ref known_albedo(const struct walk *w, ir_ref lobes)
{
    uint32_t hash = hash_bytes(&lobes, sizeof lobes);
    for (uint32_t at = hash, found; (found = table_next(&w->albedos_by_lobes, hash, &at));)
        if (w->albedos.items[found - 1].lobes == lobes)
            return w->albedos.items[found - 1].albedo;
    return lobes && ir_type_of(w->graph, lobes) == IR_TYPE_BSDF
               ? 0
               : ir_const_splat(w->graph, IR_TYPE_VEC3, 0.0f);
}

static void note_albedo(struct walk *w, ir_ref lobes, ir_ref albedo)
{
    struct arena *arena = w->shader->arena;
    vec_push(arena, &w->albedos, (struct known_albedo){lobes, albedo});
    table_add(&w->albedos_by_lobes, arena, hash_bytes(&lobes, sizeof lobes), w->albedos.len);
}

/*
 * An operator over the albedos of its operands: all light goes the mean way, so the throughput of a
 * layer is exact. Each operator adds a few values, so a stack of layers takes linear code.
 */
static ir_ref operator_albedo(struct walk *w, ir_ref ref)
{
    struct ir_graph *g = w->graph;
    const struct ir_node node = *ir_get(g, ref);
    ir_ref a = known_albedo(w, ir_arg(g, ref, 0));
    if (node.op == IR_CLOSURE_SCALE)
        return ir_op2(g, IR_MUL, a, ir_arg(g, ref, 1));
    ir_ref b = known_albedo(w, ir_arg(g, ref, 1));
    if (node.op == IR_CLOSURE_MIX)
        return ir_op3(g, IR_MIX, a, b, ir_arg(g, ref, 2));
    if (node.op == IR_LAYER) {
        ir_ref way = ir_const_float(g, CLOSURE_MEAN_WAY);
        ir_ref through = closure_throughput(w->shader, w->host->closures, ir_arg(g, ref, 0), way);
        b = ir_op2(g, IR_MUL, b, through);
    }
    return ir_op2(g, IR_ADD, a, b);
}

/* The operand of an operator whose albedo is unknown; 0: there is none. */
static ir_ref unknown_operand(const struct walk *w, ir_ref ref)
{
    const struct ir_node *node = ir_get(w->graph, ref);
    uint32_t num = ir_is_operator((enum ir_op)node->op) ? node->op == IR_CLOSURE_SCALE ? 1 : 2 : 0;
    for (uint32_t i = 0; i < num; i++)
        if (!known_albedo(w, ir_arg(w->graph, ref, i)))
            return ir_arg(w->graph, ref, i);
    return 0;
}

/* Returns what lobes reflect towards the viewer of even light from above. */
static ir_ref albedo_of(struct walk *w, ir_ref lobes)
{
    VEC(ir_ref) open = {0};
    vec_push(w->shader->arena, &open, lobes);
    while (open.len) {
        ir_ref ref = vec_last(&open), operand = unknown_operand(w, ref);
        if (operand) {
            vec_push(w->shader->arena, &open, operand);
            continue;
        }
        open.len--;
        ir_ref albedo = ir_is_operator((enum ir_op)ir_get(w->graph, ref)->op)
                            ? operator_albedo(w, ref)
                            : leaf_albedo(w, ref);
        note_albedo(w, ref, albedo);
    }
    return known_albedo(w, lobes);
}

/* False: all light that the medium stops is lost, or none goes through. */
static bool may_bounce(const struct walk *w, const ir_ref *inputs)
{
    return !ir_const_is(w->graph, inputs[SLAB_diffuse_albedo], 0.0f)
           && !ir_const_is(w->graph, inputs[SLAB_mean_free_path], 0.0f);
}

static ir_ref unit_of_world(struct walk *w)
{
    uint32_t unit = shader_private_uniform(w->shader, STR_u_slabUnit, IR_TYPE_FLOAT, 0);
    return shader_read(w->shader, unit);
}

/* The deviation of the place of the view, in centimetres. */
static ir_ref deviation_at(struct walk *w, const struct where *where)
{
    ir_ref place = where->way.place;
    return place ? ir_op1(w->graph, IR_SQRT, place) : ir_const_float(w->graph, 0.0f);
}

/* A value of what lies there, as the view sees it through rough interfaces. */
static ir_ref seen_at(struct walk *w, ir_ref value, const struct where *where)
{
    const struct slabs_host *host = w->host;
    if (!host->blurred || !where->way.place || !value || ir_is_const(w->graph, value))
        return value;
    ir_ref deviation = deviation_at(w, where);
    if (host->walks)
        deviation = ir_op2(w->graph, IR_DIV, deviation, unit_of_world(w));
    ir_ref position = closure_position(w->shader, host->closures);
    return host->blurred(host->user_data, value, position, deviation);
}

/* Directions and coordinates have no mean. */
static bool has_mean(enum slab_operand operand)
{
    return operand != SLAB_normal && operand != SLAB_tangent && operand != SLAB_glint_uv
           && operand != SLAB_specular_lut;
}

/* The medium as light sees it that goes straight on: each collision takes it away. */
static void take_scattered(const struct walk *w, const struct where *where, ir_ref *inputs)
{
    struct ir_graph *g = w->graph;
    struct ir_value path, thickness;
    bool is_known = ir_get_const(g, inputs[SLAB_mean_free_path], &path)
                    && ir_get_const(g, where->thickness, &thickness);
    bool is_deep = is_known;
    for (unsigned c = 0; c < 3 && is_deep; c++)
        is_deep = thickness.w[0].f > MOST_STRAIGHT * path.w[c].f;
    inputs[SLAB_diffuse_albedo] = ir_const_splat(g, IR_TYPE_VEC3, 0.0f);
    if (is_deep)
        inputs[SLAB_mean_free_path] = inputs[SLAB_diffuse_albedo];
}

static ir_ref slab_at(struct walk *w, ir_ref slab, const struct where *where)
{
    struct ir_graph *g = w->graph;
    ir_ref inputs[NUM_SLAB_OPERANDS];
    uint32_t attr = ir_get(g, slab)->attr;
    assert(ir_get(g, slab)->num_args == NUM_SLAB_OPERANDS);
    memcpy(inputs, ir_args(g, slab), sizeof inputs);
    for (int i = 0; i < NUM_SLAB_OPERANDS; i++)
        if (has_mean((enum slab_operand)i))
            inputs[i] = seen_at(w, inputs[i], where);
    slab_widen(w->shader, where->spread, inputs);
    slab_even(w->shader, where->depth, inputs);
    inputs[SLAB_diffuse_albedo] =
        slab_regime_albedo(g, attr, inputs[SLAB_mean_free_path], inputs[SLAB_diffuse_albedo]);
    if (where->is_straight)
        take_scattered(w, where, inputs);
    bool never_clear = attr & SLAB_NEVER_CLEAR;
    bool walks = where->is_body && w->host->walks;
    struct slab_place place = {
        .thickness = where->thickness,
        .below = ir_const_splat(g, IR_TYPE_VEC3, 0.0f),
        .is_body = ir_const_float(g, where->is_body ? 1.0f : 0.0f),
        .scatters = ir_const_float(g, never_clear ? 1.0f : 0.0f),
        .is_sheet = ir_const_float(g, never_clear && where->is_body ? 0.0f : 1.0f),
        .walks = ir_const_float(g, walks ? 1.0f : 0.0f),
        .unit = walks ? unit_of_world(w) : ir_const_float(g, 1.0f),
        .blur = w->host->blurred ? ir_const_float(g, 0.0f) : deviation_at(w, where)};
    if (where->below && may_bounce(w, inputs))
        place.below = albedo_of(w, where->below);
    ir_ref lobes = w->host->lobes(w->host->user_data, inputs, &place);
    if (!where->below && w->host->closures->painted)
        lobes = w->host->closures->painted(w->shader, w->host->closures, lobes);
    if (ir_const_is(g, inputs[SLAB_coverage], 1.0f))
        return lobes;
    ir_ref args[3] = {0, lobes, inputs[SLAB_coverage]};
    return ir_build(g, IR_CLOSURE_MIX, IR_TYPE_BSDF, 0, args, 3);
}

/* ---- Operators ---- */

static ir_ref layered(struct walk *w, ir_ref top, ir_ref base)
{
    ir_ref args[2] = {top, base};
    if (!top || !base)
        return ir_other_operand(w->graph, IR_LAYER, top, base);
    return ir_build(w->graph, IR_LAYER, IR_TYPE_BSDF, 0, args, 2);
}

/* Goes through an interface and then a thickness: a shear, place += thickness * slope. */
static struct way way_below(struct shader *shader, struct way way, ir_ref slope, ir_ref thickness)
{
    struct ir_graph *g = shader->graph;
    way.slope = ir_sum(g, way.slope, slope);
    if (!way.slope)
        return way;
    ir_ref none = ir_const_float(g, 0.0f), before = way.both ? way.both : none,
           place = way.place ? way.place : none;
    way.both = FORMULA(shader, "mx_spread_both", before, way.slope, thickness);
    way.place = FORMULA(shader, "mx_spread_place", place, before, way.both, thickness);
    return way;
}

/* The optical depth for scattering of matter with a thickness; 0: light goes straight through it.
 */
static ir_ref depth_at(struct walk *w, ir_ref ref, ir_ref thickness)
{
    ir_ref rest = known_for(w, w->scattering, ref), depth = known_for(w, w->depths, ref);
    return ir_sum(w->graph, depth, rest ? ir_op2(w->graph, IR_MUL, rest, thickness) : 0);
}

/* A layer. False: an operand is open. */
static bool visit_layer(struct walk *w, ir_ref ref, struct where where, ir_ref *out_result)
{
    struct ir_graph *g = w->graph;
    ir_ref top = ir_arg(g, ref, 0), base = ir_arg(g, ref, 1);
    ir_ref thickness = seen_at(w, slabs_layer_thickness(g, ref), &where);
    struct where below = where;
    below.spread = ir_sum(g, where.spread, known_for(w, w->spreads, top));
    below.depth = ir_sum(g, where.depth, w->depths ? depth_at(w, top, thickness) : 0);
    below.way = way_below(w->shader, where.way, known_for(w, w->slopes, top), thickness);
    if (!visited(w, base, below, &base))
        return false;
    struct where above = where;
    above.thickness = thickness;
    above.is_body = false;
    bool is_surface = base && ir_type_of(g, base) == IR_TYPE_BSDF;
    above.below = is_surface ? layered(w, base, where.below) : where.below;
    if (!visited(w, top, above, &top))
        return false;
    *out_result = layered(w, top, base);
    return true;
}

/* Any other operator: its closures lie where it lies. False: an operand is open. */
static bool visit_operands(struct walk *w, ir_ref ref, struct where where, ir_ref *out_result)
{
    struct ir_graph *g = w->graph;
    const struct ir_node node = *ir_get(g, ref);
    ir_ref *args = ARENA_ARRAY(w->shader->arena, ir_ref, node.num_args);
    for (uint32_t i = 0; i < node.num_args; i++) {
        args[i] = ir_arg(g, ref, i);
        if (ir_is_closure(w->graph, args[i]) && !visited(w, args[i], where, &args[i]))
            return false;
    }
    if (node.op == IR_CLOSURE_MIX)
        args[2] = seen_at(w, args[2], &where);
    uint32_t attr = node.op == IR_LEAF ? node.attr : 0; /* elsewhere it asks to blend parameters */
    *out_result = ir_copy_as(g, ref, node.type, attr, args, node.num_args);
    return true;
}

/* Closes the visit on top of the stack, or opens one that it needs. */
static void step(struct walk *w)
{
    uint32_t index = vec_last(&w->open);
    const struct visit visit = w->visits.items[index];
    uint8_t op = ir_get(w->graph, visit.node)->op;
    ir_ref result = 0;
    bool is_done = true;
    ir_push_origin_of(w->graph, visit.node);
    if (op == IR_SLAB)
        result = slab_at(w, visit.node, &visit.where);
    else if (slabs_is_layer(w->graph, visit.node))
        is_done = visit_layer(w, visit.node, visit.where, &result);
    else
        is_done = visit_operands(w, visit.node, visit.where, &result);
    ir_pop_origin(w->graph);
    if (!is_done)
        return;
    assert(vec_last(&w->open) == index);
    w->visits.items[index].result = result;
    w->visits.items[index].is_closed = true;
    w->open.len--;
}

static ir_ref walk_closure(struct walk *w, ir_ref root, struct where where)
{
    ir_ref result;
    while (!visited(w, root, where, &result))
        while (w->open.len)
            step(w);
    return result;
}

/* ---- Roots ---- */

/* How far a body reaches below its surface, in centimetres. */
static ir_ref depth_of_body(struct walk *w)
{
    struct ir_graph *g = w->graph;
    if (!w->host->asks_thickness) {
        uint32_t depth = shader_private_uniform(w->shader, STR_u_slabThickness, IR_TYPE_FLOAT, 0);
        return shader_read(w->shader, depth);
    }
    const struct closure_host *closures = w->host->closures;
    ir_ref inwards = ir_op1(g, IR_NEG, closure_normal(w->shader, closures));
    ir_ref way = closure_host_thickness(w->shader, closures, inwards);
    return ir_mul(g, way, unit_of_world(w));
}

static struct where body(struct walk *w)
{
    return (struct where){.thickness = depth_of_body(w), .is_body = true};
}

/* Where the closures of a surface lie. */
static struct where place_of(struct walk *w, ir_ref surface)
{
    ir_ref thickness = slabs_sheet_thickness(w->graph, closure_without_aovs(w->graph, surface));
    return thickness ? (struct where){.thickness = thickness} : body(w);
}

/* Returns what lobes let through towards the viewer, of light that comes from behind them. */
static ir_ref light_through(struct walk *w, ir_ref lobes)
{
    ir_ref at_rest = ir_const_float(w->graph, 0.0f);
    return closure_throughput(w->shader, w->host->closures, lobes, at_rest);
}

/*
 * A sheet is seen through as far as light goes straight through it. What its media scatter of even
 * light from behind is one more lobe: evenly, as light leaves them. A path tracer walks through the
 * sheet instead. *through: what goes through at all, then what goes straight.
 */
static ir_ref lit_from_behind(struct walk *w, ir_ref slabs, struct where where, ir_ref lobes,
                              ir_ref *through)
{
    struct ir_graph *g = w->graph;
    where.is_straight = true;
    ir_ref straight = light_through(w, walk_closure(w, slabs, where)), all = *through;
    *through = straight;
    if (straight == all)
        return lobes;
    ir_ref scattered = ir_op2(g, IR_MAX, ir_sub(g, all, straight), ir_black(g));
    ir_suggest_name(g, scattered, str_intern_z(w->shader->strings, "backlight"), IR_NAME_ROLE);
    ir_ref args[2] = {lobes, w->host->lit_from_behind(w->host->user_data, scattered)};
    return args[1] ? ir_build(g, IR_CLOSURE_ADD, IR_TYPE_BSDF, 0, args, 2) : lobes;
}

static ir_ref slab_surface(struct walk *w, ir_ref ref, bool is_on_matter)
{
    struct ir_graph *g = w->graph;
    ir_ref slabs = ir_arg(g, ref, 0), thin = ir_arg(g, ref, 1), lobes = slabs;
    struct where where = place_of(w, ref);
    if (has_slabs(w, slabs))
        lobes = walk_closure(w, slabs, where);
    ir_ref through = light_through(w, lobes);
    if (!where.is_body && !is_on_matter && !w->host->walks && has_slabs(w, slabs))
        lobes = lit_from_behind(w, slabs, where, lobes, &through);
    ir_ref args[4] = {lobes, 0, through, thin};
    return ir_build(g, IR_SURFACE_SHADER, IR_TYPE_SURFACE, 1, args, 4);
}

/* replaced: per node. */
static ir_ref rewrite_root(struct walk *w, ir_ref ref, bool is_on_matter, const ir_ref *replaced)
{
    struct ir_graph *g = w->graph;
    const struct ir_node node = *ir_get(g, ref);
    if (node.op == IR_SLAB_SURFACE)
        return slab_surface(w, ref, is_on_matter);
    ir_ref *args = ARENA_ARRAY(w->shader->arena, ir_ref, node.num_args);
    for (uint32_t i = 0; i < node.num_args; i++) {
        args[i] = ir_arg(g, ref, i);
        if (ir_is_closure(w->graph, args[i]) && has_slabs(w, args[i]))
            args[i] = walk_closure(w, args[i], place_of(w, ref));
        else if (known_for(w, replaced, args[i]))
            args[i] = known_for(w, replaced, args[i]);
    }
    return ir_copy(g, ref, args);
}

/* Marks surfaces that lie on others: all layers of stacks, because light goes on to those below. */
static uint8_t *find_layers(const struct walk *w)
{
    uint32_t num = w->nodes.items.len;
    uint8_t *is_layer = ARENA_ARRAY(w->shader->arena, uint8_t, num);
    is_layer[num - 1] = w->host->is_on_matter;
    for (uint32_t at = num; --at > 0;) {
        ir_ref ref = w->nodes.items.items[at];
        const struct ir_node *node = ir_get(w->graph, ref);
        bool holds = w->has_slabs[at] && (node->op == IR_SLOTS || is_layer[at]);
        for (uint32_t i = 0; holds && i < node->num_args; i++)
            is_layer[slab_node_at(&w->nodes, ir_arg(w->graph, ref, i))] = true;
    }
    return is_layer;
}

static bool is_slab(const struct ir_node *node)
{
    return node->op == IR_SLAB || node->op == IR_SLAB_LAYER || node->op == IR_SLAB_SURFACE;
}

/* Marks the nodes that depend on a slab. */
static uint8_t *find_slabs(const struct shader *shader, const struct slab_nodes *nodes)
{
    const struct ir_graph *g = shader->graph;
    uint8_t *has = ARENA_ARRAY(shader->arena, uint8_t, nodes->items.len);
    for (uint32_t at = 1; at < nodes->items.len; at++) {
        ir_ref ref = nodes->items.items[at];
        const struct ir_node *node = ir_get(g, ref);
        has[at] = is_slab(node);
        for (uint32_t i = 0; i < node->num_args; i++)
            has[at] |= has[slab_node_at(nodes, ir_arg(g, ref, i))];
    }
    return has;
}

/* A variance of an operator, from those of its operands: the sum of a layer, the mean of a mix. */
static ir_ref variance_of_operator(struct walk *w, ir_ref ref, const ir_ref *variances)
{
    struct ir_graph *g = w->graph;
    const struct ir_node node = *ir_get(g, ref);
    ir_ref a = known_for(w, variances, ir_arg(g, ref, 0));
    if (node.op == IR_CLOSURE_SCALE)
        return a;
    ir_ref b = known_for(w, variances, ir_arg(g, ref, 1));
    if (node.op != IR_CLOSURE_MIX || (!a && !b))
        return ir_sum(g, a, b);
    ir_ref nothing = ir_const_splat(g, ir_type_of(g, a ? a : b), 0.0f);
    return ir_op3(g, IR_MIX, a ? a : nothing, b ? b : nothing, ir_arg(g, ref, 2));
}

/* The variances of all nodes: `of_slab` says those of slabs with a feature. */
static ir_ref *find_variances(struct walk *w, enum slab_feature feature,
                              ir_ref (*of_slab)(struct shader *shader, const ir_ref *inputs))
{
    ir_ref *variances = ARENA_ARRAY(w->shader->arena, ir_ref, w->nodes.items.len);
    for (uint32_t at = 1; at < w->nodes.items.len; at++) {
        ir_ref ref = w->nodes.items.items[at];
        if (!w->has_slabs[at])
            continue;
        const struct ir_node node = *ir_get(w->graph, ref);
        bool is_layer = slabs_is_layer(w->graph, ref);
        if (node.op == IR_SLAB && !(node.attr & 1u << feature)) {
            ir_ref in[NUM_SLAB_OPERANDS];
            memcpy(in, ir_args(w->graph, ref), sizeof in);
            variances[at] = of_slab(w->shader, in);
        } else if (node.type == IR_TYPE_BSDF && (is_layer || ir_is_operator((enum ir_op)node.op))) {
            variances[at] = variance_of_operator(w, ref, variances);
        }
    }
    return variances;
}

/* The scattering above all nodes: the tops of layers have thicknesses, the rest gets one later. */
static void find_scattering(struct walk *w)
{
    struct ir_graph *g = w->graph;
    w->depths = ARENA_ARRAY(w->shader->arena, ir_ref, w->nodes.items.len);
    w->scattering = ARENA_ARRAY(w->shader->arena, ir_ref, w->nodes.items.len);
    for (uint32_t at = 1; at < w->nodes.items.len; at++) {
        ir_ref ref = w->nodes.items.items[at];
        const struct ir_node node = *ir_get(g, ref);
        if (!w->has_slabs[at] || node.type != IR_TYPE_BSDF)
            continue;
        if (node.op == IR_SLAB && !(node.attr & 1u << SLAB_ROUGHNESS)) {
            ir_ref in[NUM_SLAB_OPERANDS];
            memcpy(in, ir_args(g, ref), sizeof in);
            w->scattering[at] = slab_scattering(w->shader, in);
        } else if (slabs_is_layer(g, ref)) {
            ir_ref top = ir_arg(g, ref, 0), base = ir_arg(g, ref, 1);
            ir_ref above = depth_at(w, top, slabs_layer_thickness(g, ref));
            w->depths[at] = ir_sum(g, above, known_for(w, w->depths, base));
            w->scattering[at] = known_for(w, w->scattering, base);
        } else if (ir_is_operator((enum ir_op)node.op)) {
            w->depths[at] = variance_of_operator(w, ref, w->depths);
            w->scattering[at] = variance_of_operator(w, ref, w->scattering);
        }
    }
}

/* False: no node up to this one is a slab, so none depends on one. */
static bool may_have_slabs(const struct ir_graph *g, ir_ref last)
{
    while (last && !is_slab(ir_get(g, last)))
        last--;
    return last != 0;
}

bool slabs_has(const struct shader *shader, ir_ref ref)
{
    struct slab_nodes nodes;
    if (!may_have_slabs(shader->graph, ref))
        return false;
    slabs_find_nodes(shader->graph, ref, shader->arena, &nodes);
    return find_slabs(shader, &nodes)[nodes.items.len - 1];
}

bool slabs_has_media(const struct shader *shader, ir_ref ref)
{
    const struct ir_graph *g = shader->graph;
    struct slab_nodes nodes;
    slabs_find_nodes(shader->graph, ref, shader->arena, &nodes);
    for (uint32_t i = 1; i < nodes.items.len; i++) {
        ir_ref at = nodes.items.items[i];
        if (ir_get(g, at)->op == IR_SLAB
            && !ir_const_is(g, ir_arg(g, at, SLAB_mean_free_path), 0.0f))
            return true;
    }
    return false;
}

ir_ref slabs_walk(struct shader *shader, const struct slabs_host *host, ir_ref root)
{
    struct ir_graph *g = shader->graph;
    struct walk w = {.shader = shader, .graph = g, .host = host};
    if (!may_have_slabs(g, root))
        return root;
    slabs_find_nodes(g, root, shader->arena, &w.nodes);
    w.has_slabs = find_slabs(shader, &w.nodes);
    if (!has_slabs(&w, root))
        return root;
    w.spreads = find_variances(&w, SLAB_ROUGHNESS, slab_spread);
    w.slopes = find_variances(&w, SLAB_REFRACTION, slab_slope);
    if (!host->walks)
        find_scattering(&w);
    if (ir_is_closure(g, root))
        return walk_closure(&w, root, body(&w));
    ir_ref *replaced = ARENA_ARRAY(shader->arena, ir_ref, w.nodes.items.len);
    const uint8_t *is_layer = find_layers(&w);
    for (uint32_t at = 1; at < w.nodes.items.len; at++) {
        ir_ref ref = w.nodes.items.items[at];
        if (!w.has_slabs[at] || !ir_type_is_shader(ir_type_of(g, ref)))
            continue;
        ir_push_origin_of(g, ref);
        replaced[at] = rewrite_root(&w, ref, is_layer[at], replaced);
        ir_pop_origin(g);
    }
    return replaced[w.nodes.items.len - 1];
}
