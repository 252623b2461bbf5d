// SPDX-License-Identifier: Apache-2.0
/*
 * The effects of a shader in OSL, which has its own closures: one output, or two for a surface with
 * a back. Every node is older than its users, so one pass upwards rewrites the tree.
 */
#include "generators/osl/closure_tree.h"

#include "shader/formula.h"

#include <assert.h>

/* ---- Shaders ---- */

static ir_ref seen_through(struct osl_tree *t, ir_ref closure, ir_ref opacity)
{
    if (!opacity || ir_const_is(t->graph, opacity, 1.0f))
        return closure;
    t->shader->reflection.transparent = true;
    return osl_mixed(t, osl_transparent(t), closure, opacity);
}

static ir_ref unlit(struct osl_tree *t, ir_ref emitted, ir_ref transmitted, ir_ref opacity)
{
    ir_ref glow = osl_emission(t, ir_convert(t->graph, IR_TYPE_VEC3, emitted)), through = 0;
    if (!ir_const_is(t->graph, transmitted, 0.0f)) {
        t->shader->reflection.transparent = true;
        through = osl_transparent(t);
        through = osl_scaled(t, through, ir_convert(t->graph, IR_TYPE_VEC3, transmitted));
    }
    return seen_through(t, osl_sum(t, glow, through), opacity);
}

/* intensity · 2^exposure of the emitted light */
static ir_ref light(struct osl_tree *t, ir_ref edf, ir_ref intensity, ir_ref exposure)
{
    return osl_scaled(t, edf, FORMULA(t->shader, "mx_exposed", intensity, exposure));
}

/*
 * True for the parts of slabs. Light of matter itself is no layer of OSL, either; nor is an
 * interface with a tint, because what the tint takes does not reach the base. A BSDF that a sum of
 * closures stands for lets through what its own function says.
 */
static bool is_of_slab(const struct osl_tree *t, ir_ref ref)
{
    return osl_is_fitted(t, ref) || closure_has(t->shader, t->host, ref, LEAF_TINT)
           || closure_has(t->shader, t->host, ref, LEAF_TRANSMITTANCE)
           || (ir_type_of(t->graph, ref) == IR_TYPE_BSDF
               && closure_has(t->shader, t->host, ref, LEAF_EMISSION));
}

static bool has_slab(const struct osl_tree *t, ir_ref ref)
{
    const struct ir_node *node = ir_get(t->graph, ref);
    bool has = node->op == IR_LEAF && is_of_slab(t, ref);
    for (uint32_t i = 0; node->op != IR_LEAF && i < node->num_args; i++)
        has |= t->slabs[ir_arg(t->graph, ref, i)];
    return has;
}

/*
 * OSL's layer knows reflection alone. In slabs the base has the weight of the walk, with the way of
 * the mirrored view, because a closure does not know the light.
 */
static ir_ref layered(struct osl_tree *t, ir_ref top, ir_ref base)
{
    if (!top || !base || !(t->slabs[top] || t->slabs[base]))
        return osl_layered(t, t->of[top], t->of[base]);
    ir_ref view = closure_view(t->shader, t->host), way = closure_way(t->shader, t->host, view);
    ir_ref through = closure_throughput(t->shader, t->host, top, way);
    return osl_sum(t, t->of[top], osl_scaled(t, t->of[base], through));
}

/* The opacity is already in the closure of matter, which has what it lets through. */
static ir_ref matter(struct osl_tree *t, ir_ref closure, ir_ref through)
{
    if (ir_const_is(t->graph, through, 0.0f))
        return closure;
    t->shader->reflection.transparent = true;
    return osl_sum(t, closure, osl_scaled(t, osl_transparent(t), through));
}

static ir_ref rewrite(struct osl_tree *t, ir_ref ref)
{
    ir_ref a[4] = {0};
    const struct ir_node *node = ir_get(t->graph, ref);
    if (node->op == IR_LEAF)
        return osl_leaf(t, ref);
    memcpy(a, ir_args(t->graph, ref), (node->num_args < 4 ? node->num_args : 4) * sizeof *a);
    bool is_matter = node->attr != 0; /* of a surface */
    switch (node->op) {
    case IR_LAYER: return layered(t, a[0], a[1]);
    case IR_CLOSURE_MIX:
    case IR_SHADER_MIX: return osl_mixed(t, t->of[a[0]], t->of[a[1]], a[2]);
    case IR_CLOSURE_ADD: return osl_sum(t, t->of[a[0]], t->of[a[1]]);
    case IR_CLOSURE_SCALE: return osl_scaled(t, t->of[a[0]], a[1]);
    case IR_SURFACE_SHADER: {
        ir_ref closure = osl_sum(t, t->of[a[0]], t->of[a[1]]);
        return is_matter ? matter(t, closure, a[2]) : seen_through(t, closure, a[2]);
    }
    case IR_SURFACE_UNLIT: return unlit(t, a[0], a[1], a[2]);
    case IR_AOV: return t->of[a[0]];
    case IR_VOLUME_SHADER: return osl_sum(t, t->of[a[0]], t->of[a[1]]);
    case IR_LIGHT_SHADER: return light(t, t->of[a[0]], a[1], a[2]);
    case IR_UNIFORM: /* an output of another OSL layer */
        return ir_build(t->graph, IR_UNIFORM, IR_TYPE_BSDF, node->attr, NULL, 0);
    default: return 0;
    }
}

/* Notes whether a surface is a thin-walled shell, and what rays come through. */
static void set_shell(struct osl_tree *t, ir_ref surface)
{
    surface = closure_without_aovs(t->graph, surface);
    bool is_surface = ir_get(t->graph, surface)->op == IR_SURFACE_SHADER;
    ir_ref opacity = is_surface ? ir_arg(t->graph, surface, 2) : 0,
           thin = is_surface ? ir_arg(t->graph, surface, 3) : 0;
    t->thin = osl_is_false(t, thin) ? 0 : thin;
    float all = is_surface && ir_get(t->graph, surface)->attr ? 0.0f : 1.0f;
    t->seen_through = opacity && !ir_const_is(t->graph, opacity, all);
}

/* The closure of a closure or shader. */
static ir_ref closure_below(struct osl_tree *t, ir_ref root)
{
    if (!root)
        return 0;
    t->of = ARENA_ARRAY(t->shader->arena, ir_ref, root + 1);
    t->slabs = ARENA_ARRAY(t->shader->arena, uint8_t, root + 1);
    uint8_t *needed = ir_mark(t->graph, &root, 1, t->shader->arena);
    for (ir_ref ref = 1; ref <= root; ref++) {
        if (!needed[ref] || !(ir_get(t->graph, ref)->flags & IR_NODE_CLOSURE))
            continue;
        t->slabs[ref] = has_slab(t, ref);
        ir_push_origin_of(t->graph, ref);
        t->of[ref] = rewrite(t, ref);
        ir_pop_origin(t->graph);
        assert(!t->of[ref] || ir_is_closure(t->graph, t->of[ref]));
    }
    return t->of[root];
}

static ir_ref closure_of(struct osl_tree *t, ir_ref root)
{
    if (root)
        set_shell(t, root);
    return closure_below(t, root);
}

/* ---- Stacks ---- */

static ir_ref parts_of(struct osl_tree *t, const struct closure_surface *s)
{
    ir_ref closure = closure_below(t, s->bsdf);
    closure = osl_sum(t, closure, closure_below(t, s->edf));
    ir_ref glow = s->unlit ? osl_emission(t, ir_convert(t->graph, IR_TYPE_VEC3, s->unlit)) : 0;
    return osl_sum(t, closure, glow);
}

/* All layers, weighted, and what is left is transparent. */
static ir_ref blended(struct osl_tree *t, ir_ref slots)
{
    struct ir_graph *g = t->graph;
    const struct closure_surface *layers = closure_slot_surfaces(t->shader, t->host, slots);
    ir_ref sum = 0, alpha = ir_arg(g, slots, 0);
    for (unsigned i = 0; i < ir_num_slots(g, slots); i++) {
        struct ir_slot slot = ir_slot(g, slots, i);
        if (!slot.surface || ir_slot_is_vertical(g, &slot) || ir_const_is(g, slot.weight, 0.0f))
            continue;
        struct closure_surface layer = closure_weighted(g, layers[i], slot.weight);
        set_shell(t, slot.surface);
        t->seen_through |= !ir_const_is(g, alpha, 1.0f);
        sum = osl_sum(t, sum, parts_of(t, &layer));
    }
    if (ir_const_is(g, alpha, 1.0f))
        return sum;
    t->shader->reflection.transparent = true;
    ir_ref through = osl_transparent(t);
    return osl_sum(t, sum, osl_scaled(t, through, ir_one_minus(g, alpha)));
}

/* ---- Effects ---- */

static ir_ref incident(struct shader *shader)
{
    str_id name = str_intern_z(shader->strings, "u_incident");
    return shader_read(shader, shader_private_uniform(shader, name, IR_TYPE_VEC3, 0));
}

/* An OSL shader receives the direction from the eye. */
static ir_ref with_incident(struct shader *shader, ir_ref root)
{
    uint32_t eye = shader_find_variable(shader, BLOCK_PRIVATE_UNIFORMS, STR_u_viewPosition);
    if (eye == UINT32_MAX)
        return root;
    ir_ref point = shader_stream(shader, STR_positionWorld, IR_TYPE_VEC3),
           from = shader_read(shader, eye), way = incident(shader);
    root = ir_replace(shader->graph, root, ir_op2(shader->graph, IR_SUB, point, from), way,
                      shader->arena);
    ir_ref back = ir_op1(shader->graph, IR_NEG, way);
    return ir_replace(shader->graph, root, ir_op2(shader->graph, IR_SUB, from, point), back,
                      shader->arena);
}

/* OSL also provides a unit normal. It is the surface's normal if nothing has changed it. */
static ir_ref with_unit_normal(struct shader *shader, ir_ref root)
{
    ir_ref normal = shader_stream(shader, STR_normalWorld, IR_TYPE_VEC3),
           unit = ir_op1(shader->graph, IR_NORMALIZE, normal);
    return ir_replace(shader->graph, root, unit, normal, shader->arena);
}

static void effect(struct osl_tree *t, enum effect_kind kind, uint32_t index, ir_ref value)
{
    if (kind == EFFECT_OUTPUT)
        value = with_unit_normal(t->shader, with_incident(t->shader, value));
    shader_effect(t->shader, STAGE_PIXEL,
                  (struct effect){.kind = (uint8_t)kind, .index = index, .value = value});
}

static uint32_t output(struct osl_tree *t, str_id name, ir_type_id type, str_id doc_type)
{
    return shader_add_variable(
        t->shader, &(struct shader_variable){
                       .name = name, .block = BLOCK_OUTPUTS, .type = type, .doc_type = doc_type});
}

/* An absent closure is black. */
static ir_ref or_black(struct osl_tree *t, ir_ref closure)
{
    ir_ref black = ir_const_splat(t->graph, IR_TYPE_VEC3, 0.0f);
    return closure ? closure : osl_emission(t, black);
}

/* True if the leaf is counted for the first time. */
static bool is_new(struct osl_tree *t, ir_ref leaf)
{
    for (uint32_t at = leaf, found; (found = table_next(&t->counted, leaf, &at));)
        if (found == leaf)
            return false;
    table_add(&t->counted, t->shader->arena, leaf, leaf);
    return true;
}

/* Counts the remaining leaves; weights of 0 have removed some. */
static void add_closures(struct osl_tree *t, ir_ref root)
{
    const uint8_t *needed = ir_mark(t->graph, &root, 1, t->shader->arena);
    for (ir_ref ref = 1; ref <= root; ref++)
        if (needed[ref] && ir_get(t->graph, ref)->op == IR_LEAF && is_new(t, ref))
            shader_add_closure(t->shader, ref);
}

static void declare_aovs(struct osl_tree *t)
{
    t->aovs = ARENA_ARRAY(t->shader->arena, uint32_t, t->shader->interface.aovs.len);
    for (uint32_t i = 0; i < t->shader->interface.aovs.len; i++) {
        ir_type_id type = t->shader->interface.aovs.items[i].type;
        type = ir_type_is_closure(type) ? IR_TYPE_BSDF : closure_aov_type(t->shader, i);
        if (t->shader->interface.aovs.items[i].is_output)
            t->aovs[i] = closure_aov_output(t->shader, i, AOV_VALUE, type);
    }
}

static void put_aovs(struct osl_tree *t, struct closure_aovs aovs)
{
    for (uint32_t i = 0; i < aovs.num; i++) {
        ir_ref value = aovs.items[i].value;
        bool is_closure = ir_type_is_closure(t->shader->interface.aovs.items[i].type);
        if (!t->shader->interface.aovs.items[i].is_output)
            continue;
        value = is_closure ? or_black(t, closure_below(t, value))
                           : closure_aov_value(t->shader, i, value);
        effect(t, EFFECT_OUTPUT, t->aovs[i], value);
    }
}

/* The AOVs of a surface, seen through its alpha. */
static struct closure_aovs aovs_of(struct osl_tree *t, ir_ref surface)
{
    if (!surface || !t->shader->interface.aovs.len)
        return (struct closure_aovs){0};
    struct closure_surface s = closure_surface_of(t->shader, t->host, surface);
    bool has_alpha = !s.alpha || s.premultiplied;
    return has_alpha ? s.aovs : closure_aovs_scaled(t->graph, s.aovs, s.alpha);
}

static void put_closure(struct osl_tree *t, uint32_t out, ir_ref closure, struct closure_aovs aovs,
                        ir_ref condition)
{
    closure = or_black(t, closure);
    add_closures(t, closure);
    if (condition)
        effect(t, EFFECT_IF, 0, condition);
    effect(t, EFFECT_OUTPUT, out, closure);
    put_aovs(t, aovs);
    if (condition)
        effect(t, EFFECT_END, 0, 0);
}

/* The layer that a number picks, which the renderer gives: a hash of the point. */
static void emit_picked(struct osl_tree *t, uint32_t out, ir_ref slots)
{
    struct closure_choices choices = {0};
    ir_ref number = shader_read(
        t->shader, shader_private_uniform(t->shader, STR_u_layerSample, IR_TYPE_FLOAT, 0));
    closure_choose(t->shader, t->host, slots, number, &choices);
    t->seen_through = choices.covered != 0;
    for (uint32_t i = 0; i < choices.items.len; i++) {
        const struct closure_choice *choice = &choices.items.items[i];
        put_closure(t, out, parts_of(t, &choice->layer), choice->layer.aovs, choice->is_it);
    }
    if (!choices.covered)
        return;
    t->shader->reflection.transparent = true;
    struct closure_aovs none = {0};
    ir_ref through = osl_transparent(t);
    put_closure(t, out, through, none, ir_op2(t->graph, IR_GE, number, choices.covered));
}

static void emit_side(struct osl_tree *t, uint32_t out, ir_ref surface)
{
    bool is_stack = surface && ir_get(t->graph, surface)->op == IR_SLOTS;
    if (is_stack)
        surface = closure_shade_slots(t->shader, surface, 0);
    if (is_stack && t->shader->picks) {
        emit_picked(t, out, surface);
        return;
    }
    ir_ref closure = is_stack ? blended(t, surface) : closure_of(t, surface);
    put_closure(t, out, closure, aovs_of(t, surface), 0);
}

static void emit_sides(struct osl_tree *t, ir_ref front, ir_ref back)
{
    struct ir_graph *g = t->graph;
    uint32_t out = output(t, str_intern_z(t->shader->strings, "Ci"), IR_TYPE_BSDF, 0);
    declare_aovs(t);
    if (!back) {
        emit_side(t, out, front);
        return;
    }
    ir_ref behind = osl_behind(t);
    effect(t, EFFECT_IF, 0, ir_op1(g, IR_NOT, behind));
    emit_side(t, out, front);
    effect(t, EFFECT_END, 0, 0);
    effect(t, EFFECT_IF, 0, behind);
    emit_side(t, out, back);
    effect(t, EFFECT_END, 0, 0);
}

/* A separate shader, the vertex stage, moves the point. */
static void emit_displacement(struct osl_tree *t, ir_ref displacement)
{
    ir_ref offset = displacement ? closure_offset(t->shader, displacement) : 0;
    if (!offset)
        return;
    ir_ref before = shader_stream(t->shader, STR_positionWorld, IR_TYPE_VEC3);
    ir_ref moved = with_unit_normal(t->shader, ir_op2(t->graph, IR_ADD, before, offset));
    t->shader->reflection.displaced = true;
    shader_effect(t->shader, STAGE_VERTEX,
                  (struct effect){.kind = EFFECT_POSITION, .value = moved});
}

static bool emit_value(struct osl_tree *t, ir_ref root)
{
    ir_type_id type = ir_type_of(t->graph, root);
    if (type >= IR_NUM_TYPES || type == IR_TYPE_SAMPLER || type == IR_TYPE_VOID)
        return false;
    t->shader->reflection.kind = SHADER_VALUE;
    uint32_t out =
        output(t, str_intern_z(t->shader->strings, "out"), type, t->shader->reflection.value_type);
    effect(t, EFFECT_OUTPUT, out, root);
    return true;
}

/* ---- Hooks ---- */

/* OSL sees the shaded point along a ray, which it provides. */
static struct osl_tree start(struct shader *shader, const struct closure_host *host)
{
    struct ir_graph *g = shader->graph;
    ir_push_name(g, str_intern_z(shader->strings, "incident"));
    ir_ref way = ir_op1(g, IR_NORMALIZE, incident(shader));
    ir_change_name(g, STR_V);
    host->point->view = ir_op1(g, IR_NEG, way);
    ir_pop_origin(g);
    return (struct osl_tree){.shader = shader, .graph = g, .host = host};
}

static bool emit(struct shader *shader, const struct closure_host *host, ir_ref root,
                 const char **out_lacks)
{
    struct osl_tree t = start(shader, host);
    struct closure_sides sides = closure_sides_of(t.graph, root);
    closure_find_aovs(shader, root);
    emit_displacement(&t, sides.displacement);
    if (sides.displacement == root)
        return shader->reflection.displaced;
    ir_type_id type = sides.front ? ir_type_of(t.graph, sides.front) : IR_TYPE_SURFACE;
    if (!ir_type_is_closure(type) && !ir_type_is_shader(type))
        return emit_value(&t, sides.front);
    shader->reflection.kind =
        type == IR_TYPE_VOLUME || type == IR_TYPE_VDF ? SHADER_VOLUME : SHADER_SURFACE;
    emit_sides(&t, sides.front, sides.back);
    *out_lacks = t.lacks;
    return !t.lacks;
}

const struct target_closures osl_closures = {.emit = emit};

/* The value of a node's output: a displacement becomes its offset, any other shader a closure. */
static void emit_output(struct osl_tree *t, const struct network_output *of)
{
    ir_type_id type = ir_type_of(t->graph, of->value);
    ir_ref value = of->value;
    str_id doc_type = of->doc_type;
    if (type == IR_TYPE_DISPLACEMENT) {
        value = closure_offset(t->shader, value);
        type = IR_TYPE_VEC3;
        doc_type = 0;
    } else if (ir_type_is_closure(type) || ir_type_is_shader(type)) {
        value = closure_of(t, value);
        type = IR_TYPE_BSDF;
    }
    uint32_t out = output(t, of->name, type, doc_type);
    if (!value && type == IR_TYPE_VEC3)
        value = ir_const_splat(t->graph, type, 0.0f);
    if (value) /* an output starts as an empty closure */
        effect(t, EFFECT_OUTPUT, out, value);
    else
        t->shader->interface.variables.items[out].stages = 1 << STAGE_PIXEL;
}

bool osl_emit_node(struct shader *shader, const struct closure_host *host,
                   const struct network_output *outputs, unsigned n, const char **out_lacks)
{
    struct osl_tree t = start(shader, host);
    shader->reflection.kind = SHADER_VALUE;
    bool good = true;
    for (unsigned i = 0; i < n; i++) {
        good &= outputs[i].value != 0;
        if (outputs[i].value)
            emit_output(&t, &outputs[i]);
    }
    const struct effect_list *effects = &shader->stages[STAGE_PIXEL].effects;
    for (uint32_t i = 0; i < effects->len; i++)
        add_closures(&t, effects->items[i].value);
    *out_lacks = t.lacks;
    return good && !t.lacks;
}
