// SPDX-License-Identifier: Apache-2.0
/*
 * schedule: from effects to statements.
 *
 *     effects (in order)            accumulate += w · f(p, L)   inside of LIGHTS inside of IF
 *     graph                         w, p shared or invariant, f(…) used once
 *     statements                    IF { let w, let p; LIGHTS { accumulate += w * f(p, L) } }
 *
 * Three walks over the nodes that a list of effects reaches: collect them (operands first), find
 * each one's region and first use (users first), and choose the locals (operands first). All are
 * iterative and linear.
 *
 * needs: a graph without closures      keeps: order of effects
 * collects: reach, functions, the variables' stages
 */
#include "shader/schedule.h"

#include <assert.h>

unsigned shader_call_outs(const struct shader *shader, ir_ref call)
{
    const struct ir_node *node = ir_get(shader->graph, call);
    if (node->op == IR_GRAPH_CALL)
        return shader->graph->functions.items[node->attr].num_results - 1;
    if (node->op == IR_VERBATIM)
        return shader->sources.calls.items[shader_callee(shader, call)].num_results;
    const struct lang_unit *layer;
    const struct lang_function *fn =
        lang_function(shader->unit, shader_callee(shader, call), &layer);
    unsigned outs = 0;
    for (uint32_t i = 0; i < fn->num_params; i++)
        outs += layer->slots.items[fn->first_slot + i].mode != LANG_IN;
    return outs;
}

/* ---- Collect ---- */

static void need_verbatim(struct scheduler *s, uint32_t callee)
{
    assert(callee < s->shader->sources.calls.len);
    if (!s->is_needed[callee])
        vec_push(s->arena, &s->stage->verbatim, callee);
    s->is_needed[callee] = true;
}

/*
 * True if all pixels must run the call together. A call of an IR function counts if its body or its
 * arguments have derivatives.
 */
static bool needs_neighbours(const struct ir_graph *graph, const struct ir_node *call)
{
    return call->op == IR_GRAPH_CALL ? call->flags & IR_NODE_DERIVATIVE
                                     : graph->callees.items[call->attr].derivative;
}

/* Records the needs of a call; returns the flags that follow from them. */
static unsigned note_call(struct scheduler *s, ir_ref ref, const struct ir_node *node)
{
    if (node->op == IR_CALL)
        lang_reach_add(&s->stage->reach, s->shader->unit, shader_callee(s->shader, ref));
    else if (node->op == IR_VERBATIM)
        need_verbatim(s, shader_callee(s->shader, ref));
    else
        vec_push(s->arena, &s->called, node->attr);
    bool is_statement = node->type == IR_TYPE_VOID || shader_call_outs(s->shader, ref);
    return (is_statement ? PLAN_STATEMENT : 0u)
           | (needs_neighbours(s->graph, node) ? PLAN_NEIGHBOURS : 0u);
}

static void note_variable(const struct scheduler *s, uint32_t index)
{
    assert(index < s->shader->interface.variables.len);
    struct shader_variable *variable = &s->shader->interface.variables.items[index];
    variable->stages |= s->stage_bit;
    if (variable->fallback)
        s->shader->interface.variables.items[variable->fallback - 1].stages |= s->stage_bit;
}

/* Like note_call, for any node. */
static inline unsigned note_needs(struct scheduler *s, ir_ref ref, const struct ir_node *node)
{
    switch (node->op) {
    case IR_LOCAL:
        if (s->shader->effects.locals.items[node->attr].is_settled)
            return 0;
        s->any_local = true;
        return PLAN_LOCAL;
    case IR_CONTEXT:
        if (ir_is_light_member(node->attr))
            note_variable(s, node->attr);
        return 0;
    case IR_UNIFORM:
    case IR_STREAM:
    case IR_TEXTURE: note_variable(s, node->attr); return 0;
    case IR_CALL:
    case IR_VERBATIM:
    case IR_GRAPH_CALL: return note_call(s, ref, node);
    default: return ir_op_info(node->op)->flags & OP_DERIVATIVE ? PLAN_NEIGHBOURS : 0;
    }
}

static unsigned locals_below(const struct scheduler *s, const struct ir_node *node)
{
    unsigned flags = 0;
    for (uint32_t i = 0; i < node->num_args; i++)
        flags |= s->plans[s->graph->args.items[node->first_arg + i]].flags;
    return flags & PLAN_LOCAL;
}

/* Records a node after its operands, from which it inherits dependences. */
static inline void reach_node(struct scheduler *s, ir_ref ref)
{
    assert(s->reached.len < s->reached.cap);
    const struct ir_node *node = ir_get(s->graph, ref);
    unsigned flags = note_needs(s, ref, node) | (node->flags & PLAN_LOOP);
    if (s->any_local)
        flags |= locals_below(s, node);
    s->plans[ref] = (struct plan){.region = NO_REGION,
                                  .first = NO_EFFECT,
                                  .effect = NO_EFFECT,
                                  .num_args = node->num_args,
                                  .first_arg = node->first_arg,
                                  .type = node->type,
                                  .op = node->op,
                                  .flags = (uint8_t)flags};
    s->is_reached[ref] = true;
    s->reached.items[s->reached.len++] = ref;
}

/* Walks down from the value of an effect. Skips reached nodes. */
static void collect(struct scheduler *s, ir_ref ref)
{
    const struct ir_node *nodes = s->graph->nodes.items;
    const ir_ref *args = s->graph->args.items, *next = args + nodes[ref].first_arg,
                 *end = next + nodes[ref].num_args;
    const bool *is_reached = s->is_reached;
    if (is_reached[ref])
        return;
    for (;;) {
        while (next < end && is_reached[*next])
            next++;
        if (next < end) {
            vec_push(s->arena, &s->visits, (struct visit){ref, next + 1, end});
            ref = *next;
            next = args + nodes[ref].first_arg;
            end = next + nodes[ref].num_args;
            continue;
        }
        reach_node(s, ref);
        if (s->visits.len == 0)
            return;
        struct visit above = vec_pop(&s->visits);
        ref = above.ref;
        next = above.next;
        end = above.end;
    }
}

/* ---- Regions ---- */

static void find_regions(struct scheduler *s, const struct effect_list *effects)
{
    s->regions.len = s->region_of.len = 0;
    s->first_discard = NO_EFFECT;
    vec_push(s->arena, &s->regions, (struct region){0});
    uint32_t current = 0;
    for (uint32_t i = 0; i < effects->len; i++) {
        uint8_t kind = effects->items[i].kind;
        uint32_t ended = current;
        if (kind == EFFECT_END || kind == EFFECT_ELSE)
            current = s->regions.items[current].parent;
        vec_push(s->arena, &s->region_of, current);
        if (kind == EFFECT_DISCARD && s->first_discard == NO_EFFECT)
            s->first_discard = i;
        bool loop = kind == EFFECT_LIGHTS || kind == EFFECT_SAMPLES;
        if (kind != EFFECT_IF && kind != EFFECT_ELSE && !loop)
            continue;
        /* locals for both sides of a choice stand before its IF */
        uint32_t header = kind == EFFECT_ELSE ? s->regions.items[ended].header : i;
        struct region inner = {current, header, s->regions.items[current].depth + 1,
                               s->regions.len};
        bool in_loop = s->regions.items[current].outside != current;
        if (loop || in_loop)
            inner.outside = s->regions.items[current].outside;
        assert(inner.depth <= s->regions.len);
        current = s->regions.len;
        vec_push(s->arena, &s->regions, inner);
    }
    assert(current == 0);
    assert(s->region_of.len == effects->len);
}

static uint32_t common_region(const struct scheduler *s, uint32_t a, uint32_t b)
{
    while (a != b) {
        assert(a < s->regions.len && b < s->regions.len);
        if (s->regions.items[a].depth >= s->regions.items[b].depth)
            a = s->regions.items[a].parent;
        else
            b = s->regions.items[b].parent;
    }
    return a;
}

/* The effect in `region` that is `effect` or contains it. */
static uint32_t lift(const struct scheduler *s, uint32_t effect, uint32_t region)
{
    for (uint32_t r = s->region_of.items[effect]; r != region; r = s->regions.items[r].parent)
        effect = s->regions.items[r].header;
    assert(s->region_of.items[effect] == region);
    return effect;
}

/* Records a use of a node. Only nodes that read a LOCAL need `effect`. */
static inline void use(const struct scheduler *s, struct plan *plan, uint32_t uses, uint32_t region,
                       uint32_t first)
{
    if (plan->region != region)
        plan->region = plan->uses ? common_region(s, plan->region, region) : region;
    if (first < plan->first)
        plan->first = first;
    plan->uses += uses;
}

static inline void use_local(struct plan *plan, uint32_t effect)
{
    plan->effect = plan->effect == NO_EFFECT || plan->effect == effect ? effect : MANY_EFFECTS;
}

/* Moves a node out of loops and branches, as far as possible and useful. */
static inline void move_out(const struct scheduler *s, struct plan *plan)
{
    bool neighbours = plan->flags & PLAN_NEIGHBOURS;
    if (plan->flags & (PLAN_LOCAL | PLAN_LOOP) || (plan->region == 0 && !neighbours))
        return;
    uint32_t region = neighbours ? 0 : s->regions.items[plan->region].outside;
    if (region != plan->region) {
        plan->region = region;
        plan->flags |= PLAN_MOVED;
    }
    if (neighbours && plan->first > s->first_discard) {
        plan->first = s->first_discard;
        plan->flags |= PLAN_MOVED;
    }
}

/* True if all operands but the first are evaluated conditionally. */
static inline bool has_arms(const struct plan *plan)
{
    return plan->op == IR_SELECT || plan->op == IR_LAND || plan->op == IR_LOR;
}

/* Records the uses of a node's operands. The plan of the absent operand has no meaning. */
static inline void place_operands(const struct scheduler *s, struct plan *plans,
                                  const struct plan *plan)
{
    /* a RESULT is another name of its call */
    uint32_t uses = plan->op == IR_RESULT ? plan->uses : 1;
    uint32_t region = plan->region, first = plan->first;
    uint8_t in_arm = plan->flags & PLAN_IN_ARM;
    const ir_ref *args = args_of(s, plan), *end = args + plan->num_args;
    for (const ir_ref *arg = args; arg < end; arg++) {
        use(s, &plans[*arg], uses, region, first);
        plans[*arg].flags |= in_arm;
    }
    if (has_arms(plan))
        for (const ir_ref *arg = args + 1; arg < end; arg++)
            plans[*arg].flags |= PLAN_IN_ARM;
    if (plan->flags & PLAN_LOCAL)
        for (const ir_ref *arg = args; arg < end; arg++)
            use_local(&plans[*arg], plan->effect);
}

/* Finds the region of each node, users first. */
static void find_places(struct scheduler *s, const struct effect_list *effects)
{
    struct plan *plans = s->plans;
    for (uint32_t i = 0; i < effects->len; i++) {
        ir_ref value = effects->items[i].value;
        if (!value)
            continue;
        use(s, &plans[value], 1, s->region_of.items[i], i);
        use_local(&plans[value], i);
    }
    const ir_ref *reached = s->reached.items;
    for (uint32_t i = s->reached.len; i-- > 0;) {
        struct plan *plan = &plans[reached[i]];
        move_out(s, plan);
        if (plan->num_args)
            place_operands(s, plans, plan);
    }
}

/* ---- Statements ---- */

/*
 * Collects the nodes that become locals, in the order of their discovery. Each stands before the
 * first effect that needs it.
 */
static void find_lets(struct scheduler *s)
{
    const ir_ref *reached = s->reached.items, *end = reached + s->reached.len;
    s->lets.len = 0;
    for (; reached < end; reached++) {
        struct plan *plan = plan_of(s, *reached);
        if (!(plan->flags & PLAN_LET))
            continue;
        plan->first = lift(s, plan->first, plan->region);
        assert(plan->first < s->region_of.len && plan->region < s->regions.len);
        vec_push(s->arena, &s->lets, *reached);
    }
}

/* Writes the effects, with LETs before the first effects that need them. */
static void write_statements(struct scheduler *s, const struct effect_list *effects,
                             struct effect_list *out)
{
    /* by effect: the index of its first LET */
    uint32_t *first = ARENA_ARRAY(s->arena, uint32_t, effects->len + 1);
    for (uint32_t i = 0; i < s->lets.len; i++)
        first[plan_of(s, s->lets.items[i])->first + 1]++;
    for (uint32_t i = 1; i <= effects->len; i++)
        first[i] += first[i - 1];
    assert(first[effects->len] == s->lets.len);
    out->len = 0;
    struct effect *statements = vec_extend(s->arena, out, s->lets.len + effects->len);
    for (uint32_t i = 0; i < s->lets.len; i++) {
        uint32_t effect = plan_of(s, s->lets.items[i])->first;
        assert(first[effect] + effect < out->len);
        statements[first[effect]++ + effect] =
            (struct effect){.kind = EFFECT_LET, .value = s->lets.items[i]};
    }
    for (uint32_t i = 0; i < effects->len; i++)
        statements[first[i] + i] = effects->items[i];
}

static void forget_reached(struct scheduler *s)
{
    for (uint32_t i = 0; i < s->reached.len; i++)
        s->is_reached[s->reached.items[i]] = false;
}

static void schedule_effects(struct scheduler *s, const struct effect_list *effects,
                             struct effect_list *out)
{
    s->reached.len = s->called.len = 0;
    for (uint32_t i = 0; i < effects->len; i++)
        if (effects->items[i].value)
            collect(s, effects->items[i].value);
    find_regions(s, effects);
    find_places(s, effects);
    choose_locals(s);
    find_lets(s);
    write_statements(s, effects, out);
    forget_reached(s);
}

/* ---- IR functions ---- */

static void schedule_function(struct scheduler *s, uint32_t function, struct effect_list *out)
{
    const struct ir_function *fn = &s->graph->functions.items[function];
    struct effect_list effects = {0};
    assert(fn->num_results > 0);
    for (uint32_t i = fn->num_results; i-- > 0;) {
        ir_ref result = s->graph->function_results.items[fn->first_result + i];
        vec_push(s->arena, &effects,
                 (struct effect){.kind = EFFECT_RESULT, .index = i, .value = result});
    }
    schedule_effects(s, &effects, out);
}

/* Schedules the called functions, callees first. */
static void schedule_functions(struct scheduler *s)
{
    struct caller {
        struct shader_function function;
        VEC(uint32_t) called;
    };
    VEC(struct caller) stack = {0};
    uint8_t *seen = ARENA_ARRAY(s->arena, uint8_t, s->graph->functions.len + 1);
    vec_push(s->arena, &stack, (struct caller){.function = {.function = UINT32_MAX}}); /* main */
    for (;;) {
        struct caller *top = &vec_last(&stack);
        if (s->called.len) { /* the top of the stack was scheduled just now */
            memcpy(vec_extend(s->arena, &top->called, s->called.len), s->called.items,
                   s->called.len * sizeof *s->called.items);
            s->called.len = 0;
        }
        uint32_t next = UINT32_MAX;
        while (top->called.len && next == UINT32_MAX) {
            uint32_t callee = vec_pop(&top->called);
            if (!seen[callee])
                next = callee;
        }
        if (next != UINT32_MAX) {
            seen[next] = 1;
            assert(next < s->graph->functions.len);
            struct caller callee = {.function = {.function = next}};
            schedule_function(s, next, &callee.function.statements);
            vec_push(s->arena, &stack, callee);
            continue;
        }
        if (stack.len == 1)
            return;
        vec_push(s->arena, &s->stage->functions, top->function);
        stack.len--;
    }
}

void shader_schedule(struct shader *shader, enum shader_stage_id stage)
{
    struct scheduler s = {
        .shader = shader,
        .graph = shader->graph,
        .arena = shader->arena,
        .stage = &shader->stages[stage],
        .stage_bit = (uint8_t)(1u << stage),
        .is_reached = ARENA_ARRAY(shader->arena, bool, shader->graph->nodes.len),
        .is_needed = ARENA_ARRAY(shader->arena, bool, shader->sources.calls.len),
        .plans =
            arena_alloc(shader->arena, mem_array_size(shader->arena->mem, shader->graph->nodes.len,
                                                      sizeof(struct plan))),
    };
    vec_reserve(s.arena, &s.reached, shader->graph->nodes.len);
    s.plans[0] = (struct plan){0}; /* the plan of absent operands */
    s.is_reached[0] = true;
    s.stage->functions.len = s.stage->verbatim.len = 0;
    schedule_effects(&s, &s.stage->effects, &s.stage->statements);
    schedule_functions(&s);
    assert(s.visits.len == 0 && s.called.len == 0);
}
