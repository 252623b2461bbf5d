// SPDX-License-Identifier: Apache-2.0
/*
 * schedule: from effects to statements.
 *
 *     effects (in order)            accumulate += w · f(p, L)   inside of LIGHTS inside of IF
 *     graph                         w, p shared or invariant, f(…) used once
 *     statements                    IF { let w, let p; LIGHTS { accumulate += w * f(p, L) } }
 *
 * Three walks over the nodes that a list of effects reaches: collect them (operands first), find each one's region and first use
 * (users first), and choose the locals (operands first). All are iterative and linear.
 *
 * needs: a graph without closures      keeps: order of effects      collects: reach, functions, the variables' stages
 */
#include "shader/shader.h"

#include <assert.h>

#define NO_REGION UINT32_MAX
#define NO_EFFECT UINT32_MAX
#define MANY_EFFECTS (UINT32_MAX - 1)

enum plan_flags {
    PLAN_LOCAL = 1,      /* reads a LOCAL: may be shared within one effect only */
    PLAN_LOOP = 2,       /* reads the light or sample at hand: may not leave its loop */
    PLAN_IN_ARM = 4,     /* some use stands in an expression that is not always evaluated */
    PLAN_MOVED = 8,      /* its region lies outside of that of a use */
    PLAN_STATEMENT = 16, /* a call that cannot stand in an expression */
    PLAN_LET = 32,
    PLAN_NEIGHBOURS = 64, /* to be evaluated by all pixels together */
};

struct plan { /* what is known of a reached node, and what of the node itself is often asked for */
    uint32_t uses;
    uint32_t region;
    uint32_t first;  /* the first effect that needs it */
    uint32_t effect; /* where it reads a LOCAL: the only effect that needs it, or MANY_EFFECTS */
    uint32_t first_arg, num_args;
    uint16_t cost;   /* instructions to compute it from locals and interface variables */
    uint16_t chars;  /* its length as an expression, about */
    ir_type_id type;
    uint8_t op;
    uint8_t flags;   /* enum plan_flags */
};

struct region {
    uint32_t parent, header, depth; /* header: the effect that opens it */
    uint32_t outside; /* the innermost region around it that is in no loop: itself where it is in none */
};

struct visit { /* a node whose operands are being collected */
    ir_ref ref;
    uint32_t next, end; /* those that are left, in graph->args */
};

struct scheduler {
    struct shader *shader;
    const struct ir_graph *graph;
    struct arena *arena;
    struct shader_stage *stage;
    uint8_t stage_bit;
    bool *is_reached;    /* by node */
    bool any_local;      /* a node that reads a LOCAL has been reached */
    struct plan *plans;  /* by node; of reached nodes only, and of the absent one */
    VEC(ir_ref) reached; /* operands before users; there is room for all nodes */
    VEC(struct visit) visits;
    VEC(struct region) regions;
    VEC(uint32_t) region_of; /* the region that each effect stands in */
    VEC(uint32_t) called;  /* IR functions called from the effects at hand */
    uint32_t first_discard;
};

unsigned shader_call_outs(const struct shader *shader, ir_ref call)
{
    const struct ir_node *node = ir_get(shader->graph, call);
    if (node->op == IR_GRAPH_CALL)
        return shader->graph->functions.items[node->attr].num_results - 1;
    if (node->op == IR_VERBATIM)
        return shader->verbatim.items[shader_callee(shader, call)].num_results;
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(shader->unit, shader_callee(shader, call), &layer);
    unsigned outs = 0;
    for (uint32_t i = 0; i < fn->num_params; i++)
        outs += layer->slots.items[fn->first_slot + i].mode != LANG_IN;
    return outs;
}

static inline struct plan *plan_of(struct scheduler *s, ir_ref ref)
{
    return &s->plans[ref];
}

static inline ir_ref ref_of(const struct scheduler *s, const struct plan *plan)
{
    return (ir_ref)(plan - s->plans);
}

static inline const struct ir_node *node_of(const struct scheduler *s, const struct plan *plan)
{
    return ir_get(s->graph, ref_of(s, plan));
}

static inline const ir_ref *args_of(const struct scheduler *s, const struct plan *plan)
{
    return s->graph->args.items + plan->first_arg;
}

static bool is_call(const struct ir_node *node)
{
    return node->op == IR_CALL || node->op == IR_VERBATIM || node->op == IR_GRAPH_CALL;
}

/* Must it be evaluated by all pixels together? An IR function counts as soon as derivatives are in it or in its arguments. */
static bool needs_neighbours(const struct ir_graph *graph, const struct ir_node *node)
{
    if (node->op == IR_GRAPH_CALL)
        return node->flags & IR_NODE_DERIVATIVE;
    if (is_call(node))
        return graph->callees.items[node->attr].derivative;
    return ir_op_info(node->op)->flags & OP_DERIVATIVE;
}

/* ---- Collect ---- */

static void need_verbatim(struct scheduler *s, uint32_t callee)
{
    for (uint32_t i = 0; i < s->stage->verbatim.len; i++)
        if (s->stage->verbatim.items[i] == callee)
            return;
    vec_push(s->arena, &s->stage->verbatim, callee);
}

/* What the shader must have for a call; returns flags that follow from it. */
static unsigned note_call(struct scheduler *s, ir_ref ref, const struct ir_node *node)
{
    if (node->op == IR_CALL)
        lang_reach_add(&s->stage->reach, s->shader->unit, shader_callee(s->shader, ref));
    else if (node->op == IR_VERBATIM)
        need_verbatim(s, shader_callee(s->shader, ref));
    else
        vec_push(s->arena, &s->called, node->attr);
    bool is_statement = node->type == IR_TYPE_VOID || shader_call_outs(s->shader, ref);
    return (is_statement ? PLAN_STATEMENT : 0u) | (needs_neighbours(s->graph, node) ? PLAN_NEIGHBOURS : 0u);
}

/* The same for any node. */
static inline unsigned note_needs(struct scheduler *s, ir_ref ref, const struct ir_node *node)
{
    switch (node->op) {
    case IR_LOCAL:
        s->any_local = true;
        return PLAN_LOCAL;
    case IR_CONTEXT:
    case IR_UNIFORM:
    case IR_STREAM:
    case IR_TEXTURE:
        s->shader->variables.items[node->attr].stages |= s->stage_bit;
        if (s->shader->variables.items[node->attr].fallback)
            s->shader->variables.items[s->shader->variables.items[node->attr].fallback - 1].stages |= s->stage_bit;
        return 0;
    case IR_CALL:
    case IR_VERBATIM:
    case IR_GRAPH_CALL:
        return note_call(s, ref, node);
    default:
        return ir_op_info(node->op)->flags & OP_DERIVATIVE ? PLAN_NEIGHBOURS : 0;
    }
}

static unsigned locals_below(const struct scheduler *s, const struct ir_node *node)
{
    unsigned flags = 0;
    for (uint32_t i = 0; i < node->num_args; i++)
        flags |= s->plans[s->graph->args.items[node->first_arg + i]].flags;
    return flags & PLAN_LOCAL;
}

/* What the node depends on follows from its operands, which are reached before. */
static inline void reach_node(struct scheduler *s, ir_ref ref)
{
    const struct ir_node *node = &s->graph->nodes.items[ref];
    unsigned flags = note_needs(s, ref, node);
    if (node->flags & IR_NODE_LOOP && node->op != IR_LOCAL)
        flags |= PLAN_LOOP;
    if (s->any_local)
        flags |= locals_below(s, node);
    s->plans[ref] = (struct plan){.region = NO_REGION, .first = NO_EFFECT, .effect = NO_EFFECT, .first_arg = node->first_arg,
                                  .num_args = node->num_args, .type = node->type, .op = node->op, .flags = (uint8_t)flags};
    s->is_reached[ref] = true;
    s->reached.items[s->reached.len++] = ref;
}

static inline struct visit visit_of(const struct scheduler *s, ir_ref ref)
{
    const struct ir_node *node = &s->graph->nodes.items[ref];
    return (struct visit){ref, node->first_arg, node->first_arg + node->num_args};
}

static void collect(struct scheduler *s, ir_ref root)
{
    const bool *is_reached = s->is_reached;
    const ir_ref *args = s->graph->args.items;
    if (is_reached[root])
        return;
    struct visit top = visit_of(s, root);
    for (;;) {
        while (top.next < top.end && is_reached[args[top.next]])
            top.next++;
        ir_ref ref = top.ref;
        if (top.next < top.end) {
            ref = args[top.next++];
            struct visit operand = visit_of(s, ref);
            if (operand.next < operand.end) {
                vec_push(s->arena, &s->visits, top);
                top = operand;
                continue;
            }
        }
        reach_node(s, ref);
        if (ref != top.ref)
            continue;
        if (s->visits.len == 0)
            return;
        top = vec_pop(&s->visits);
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
        if (kind == EFFECT_END)
            current = s->regions.items[current].parent;
        vec_push(s->arena, &s->region_of, current);
        if (kind == EFFECT_DISCARD && s->first_discard == NO_EFFECT)
            s->first_discard = i;
        bool loop = kind == EFFECT_LIGHTS || kind == EFFECT_SAMPLES;
        if (kind != EFFECT_IF && !loop)
            continue;
        struct region inner = {current, i, s->regions.items[current].depth + 1, s->regions.len};
        bool in_loop = s->regions.items[current].outside != current;
        if (loop || in_loop)
            inner.outside = s->regions.items[current].outside;
        current = s->regions.len;
        vec_push(s->arena, &s->regions, inner);
    }
    assert(current == 0);
}

static uint32_t common_region(const struct scheduler *s, uint32_t a, uint32_t b)
{
    while (a != b) {
        if (s->regions.items[a].depth >= s->regions.items[b].depth)
            a = s->regions.items[a].parent;
        else
            b = s->regions.items[b].parent;
    }
    return a;
}

/* The effect that stands directly in `region` and is, or holds, `effect`. */
static uint32_t lift(const struct scheduler *s, uint32_t effect, uint32_t region)
{
    for (uint32_t r = s->region_of.items[effect]; r != region; r = s->regions.items[r].parent)
        effect = s->regions.items[r].header;
    return effect;
}

/* What one use says of a node; of `effect` only nodes that read a LOCAL want to know. */
static inline void use(const struct scheduler *s, struct plan *plan, uint32_t uses, uint32_t region, uint32_t first)
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

/* Out of loops and branches, as far as the node may and should go. */
static void move_out(struct scheduler *s, struct plan *plan)
{
    if (plan->flags & (PLAN_LOCAL | PLAN_LOOP))
        return;
    uint32_t region = s->regions.items[plan->region].outside;
    bool neighbours = plan->flags & PLAN_NEIGHBOURS;
    if (neighbours)
        region = 0;
    if (region != plan->region) {
        plan->region = region;
        plan->flags |= PLAN_MOVED;
    }
    if (neighbours && plan->first > s->first_discard) {
        plan->first = s->first_discard;
        plan->flags |= PLAN_MOVED;
    }
}

/* Are all operands but the first evaluated only sometimes? */
static bool has_arms(const struct plan *plan)
{
    return plan->op == IR_SELECT || plan->op == IR_LAND || plan->op == IR_LOR;
}

/* What a node's place says of its operands. */
static inline void place_operands(const struct scheduler *s, struct plan *plans, const struct plan *plan)
{
    uint32_t uses = plan->op == IR_RESULT ? plan->uses : 1; /* a result is another name of its call */
    uint32_t region = plan->region, first = plan->first, effect = plan->effect;
    uint8_t in_arm = plan->flags & PLAN_IN_ARM, arms = has_arms(plan) ? PLAN_IN_ARM : in_arm;
    bool reads_local = plan->flags & PLAN_LOCAL;
    const ir_ref *args = args_of(s, plan), *end = args + plan->num_args;
    for (; args < end; args++, in_arm = arms) {
        struct plan *operand = &plans[*args]; /* that of the absent one stands for nothing */
        use(s, operand, uses, region, first);
        operand->flags |= in_arm;
        if (reads_local)
            use_local(operand, effect);
    }
}

/* Users first: where each node belongs. */
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

/* ---- Locals ---- */

/*
 * Expressions are kept to about a line. Costs are those of SPIR-V before any optimiser: reading a block's member takes an access chain
 * and a load, a local a variable, a store and a load per use.
 */
/* Characters. A name counts as any other, however long it is: shaders that differ in names alone have the same statements. */
enum { GOOD_CHARS = 110, MAX_CHARS = 220, MIN_SPLIT_CHARS = 40, MAX_REPEATED_CHARS = 32, NAME_CHARS = 10 };
enum { MIN_USES_OF_COPY = 5 }; /* an access and a load each time, or once, a store, and a load each time */
enum { COST_OPERATOR = 1, COST_CHOICE = 3, COST_BUILTIN = 4, COST_CALL = 32, COST_LOCAL = 2, MAX_COST_IN_LOOP = 3, MAX_COST_OF_ARM = 24 };

static bool is_splat(ir_type_id type, const union ir_word *words)
{
    for (uint32_t i = 1; i < ir_type_info(type)->components; i++)
        if (words[i].u != words[0].u)
            return false;
    return true;
}

static uint16_t clamp16(uint32_t n)
{
    return n < UINT16_MAX ? (uint16_t)n : UINT16_MAX;
}

/* Nodes that never become locals for their own sake: names, and small constants. Fills cost and chars. */
static bool is_source(const struct scheduler *s, struct plan *plan)
{
    const struct ir_node *node = node_of(s, plan);
    switch (plan->op) {
    case IR_CONST: {
        bool splat = is_splat(plan->type, s->graph->words.items + node->attr);
        uint32_t components = splat ? 1 : ir_type_info(plan->type)->components;
        plan->chars = clamp16(components == 1 ? 5 : 4 + 6 * components);
        return components == 1 || plan->uses < (components > 4 ? 2u : 3u);
    }
    case IR_CONTEXT: /* u_lightData[i].member */
        plan->cost = 3;
        plan->chars = clamp16(NAME_CHARS + 15);
        return plan->uses < 3;
    case IR_UNIFORM:
        plan->cost = 2;
        plan->chars = clamp16(NAME_CHARS + 3);
        return !s->shader->in_blocks || plan->uses < MIN_USES_OF_COPY || ir_type_is_matrix(node->type);
    case IR_STREAM:
    case IR_TEXTURE:
        plan->cost = 2;
        plan->chars = clamp16(NAME_CHARS + 3);
        return true;
    case IR_PARAM:
    case IR_LOCAL:
    case IR_SAMPLE:
    case IR_POISON:
        plan->cost = 1;
        plan->chars = 4;
        return true;
    default:
        return false;
    }
}

/* What an operation adds to its operands. */
static void own_measure(const struct scheduler *s, const struct plan *plan, uint32_t *out_cost, uint32_t *out_chars)
{
    const struct ir_op_info *info = ir_op_info(plan->op);
    const struct ir_node *node = node_of(s, plan);
    if (is_call(node)) {
        str_id name = node->op == IR_GRAPH_CALL ? s->graph->functions.items[node->attr].name
                                                : s->graph->callees.items[node->attr].name;
        *out_cost = COST_CALL;
        *out_chars = (uint32_t)str_len(s->shader->strings, name) + 2 * node->num_args;
    } else if (info->flags & OP_BUILTIN) {
        *out_cost = COST_BUILTIN;
        *out_chars = info->text_len + 2 * plan->num_args;
    } else {
        bool chooses = node->op == IR_CONVERT && ir_type_of(s->graph, s->graph->args.items[node->first_arg]) == IR_TYPE_BOOL;
        *out_cost = chooses ? COST_CHOICE : COST_OPERATOR;
        *out_chars = 3 * plan->num_args + (plan->op == IR_CONSTRUCT ? 4 : 0);
    }
}

static bool may_let(const struct scheduler *s, const struct plan *plan)
{
    ir_type_id type = plan->type;
    if (plan->flags & PLAN_LOCAL && plan->effect == MANY_EFFECTS)
        return false;
    if (plan->flags & PLAN_LOOP && s->regions.items[plan->region].outside == plan->region)
        return false;
    bool is_opaque = type == IR_TYPE_SAMPLER || type == IR_TYPE_SAMPLER_ARRAY || type == IR_TYPE_STRING;
    return plan->flags & PLAN_STATEMENT || (type != IR_TYPE_VOID && !is_opaque);
}

/* From here on it is read by its name, which its origin gives. */
static void let(struct plan *plan)
{
    plan->flags |= PLAN_LET;
    plan->cost = 1;
    plan->chars = NAME_CHARS + 2;
}

/*
 * Sums the operands up; the longest of them become locals until the whole is no longer than a line. Where hardly anything would
 * remain without them, the line may be longer.
 */
static void measure(struct scheduler *s, struct plan *plan)
{
    uint32_t own_cost, own_chars;
    own_measure(s, plan, &own_cost, &own_chars);
    for (;;) {
        uint32_t cost = own_cost, chars = own_chars;
        struct plan *longest = NULL;
        const ir_ref *args = args_of(s, plan), *end = args + plan->num_args;
        for (; args < end; args++) {
            struct plan *operand = plan_of(s, *args);
            cost += operand->cost;
            chars += operand->chars;
            bool is_long = operand->chars >= MIN_SPLIT_CHARS && (!longest || operand->chars > longest->chars);
            if (is_long && operand->num_args > 0 && !(operand->flags & PLAN_LET) && may_let(s, operand))
                longest = operand;
        }
        bool long_rest = longest && chars - longest->chars >= MIN_SPLIT_CHARS;
        if (chars <= GOOD_CHARS || !longest || (chars <= MAX_CHARS && !long_rest)) {
            plan->cost = clamp16(cost);
            plan->chars = clamp16(chars);
            return;
        }
        let(longest);
    }
}

/* Operators on what is at hand are cheaper repeated than stored. */
static bool is_cheap(const struct plan *plan)
{
    if (!(ir_op_info(plan->op)->flags & OP_OPERATOR) || plan->op == IR_SELECT || plan->chars > MAX_REPEATED_CHARS)
        return false;
    if (plan->flags & PLAN_MOVED)
        return plan->cost <= MAX_COST_IN_LOOP;
    return (uint32_t)plan->cost * plan->uses <= (uint32_t)plan->cost + COST_LOCAL + plan->uses;
}

/* A part of something that has a name. */
static bool is_part(struct scheduler *s, const struct plan *plan)
{
    if (plan->op == IR_RESULT)
        return true;
    if (plan->op != IR_SWIZZLE && plan->op != IR_MEMBER)
        return false;
    const struct plan *whole = plan_of(s, args_of(s, plan)[0]);
    return whole->flags & PLAN_LET || whole->op == IR_RESULT || whole->num_args == 0;
}

/* May an arm become a local for the sake of let_arms? What has a name already is not copied. */
static bool is_little_work(struct scheduler *s, const struct plan *arm)
{
    return arm->flags & PLAN_LOOP && (arm->num_args > 0 || arm->op == IR_CONTEXT) && !is_part(s, arm)
           && arm->cost <= MAX_COST_OF_ARM && may_let(s, arm) && !(arm->flags & PLAN_LOCAL);
}

/*
 * A choice between locals and constants is one operation; between expressions it is a branch. In a loop, what is little
 * work is rather done in vain; elsewhere one line reads better.
 */
static void let_arms(struct scheduler *s, const struct plan *plan)
{
    bool all = true;
    struct plan *arms[2];
    for (unsigned i = 0; i < 2; i++) {
        arms[i] = plan_of(s, args_of(s, plan)[i + 1]);
        all &= arms[i]->flags & PLAN_LET || arms[i]->op == IR_CONST || is_little_work(s, arms[i]);
    }
    for (unsigned i = 0; all && i < 2; i++)
        if (!(arms[i]->flags & PLAN_LET) && arms[i]->op != IR_CONST)
            let(arms[i]);
}

/* Where only variables have parts, what a part is taken of becomes one. */
static void let_wholes(struct scheduler *s, const struct plan *plan)
{
    uint8_t op = plan->op;
    if (op != IR_SWIZZLE && op != IR_MEMBER && op != IR_INDEX && op != IR_CONVERT && op != IR_CONSTRUCT
        && op != IR_TEX)
        return;
    for (uint32_t a = 0; a < plan->num_args; a++) {
        struct plan *whole = plan_of(s, args_of(s, plan)[a]);
        bool has_parts = whole->type >= IR_NUM_TYPES || ir_type_info(whole->type)->components > 1;
        if (has_parts && whole->num_args > 0 && whole->op != IR_RESULT && may_let(s, whole))
            let(whole);
    }
}

static bool is_closure_call(const struct plan *plan)
{
    return plan->op == IR_LEAF && plan->num_args > 0;
}

/* Operands first: which nodes become locals. */
static void choose_locals(struct scheduler *s)
{
    for (uint32_t i = 0; i < s->reached.len; i++) {
        struct plan *plan = plan_of(s, s->reached.items[i]);
        if (plan->num_args == 0 && is_source(s, plan))
            continue;
        if (plan->op == IR_SELECT)
            let_arms(s, plan);
        if (s->shader->names_wholes)
            let_wholes(s, plan);
        measure(s, plan);
        unsigned flags = plan->flags;
        bool wanted = flags & PLAN_STATEMENT || is_closure_call(plan)
                      || (flags & PLAN_NEIGHBOURS && flags & (PLAN_IN_ARM | PLAN_MOVED));
        if (!wanted && (plan->uses > 1 || flags & PLAN_MOVED))
            wanted = !is_cheap(plan);
        if (wanted && may_let(s, plan) && !is_part(s, plan))
            let(plan);
    }
}

/* The effects with the LETs in front of those that need them first. */
static void write_statements(struct scheduler *s, const struct effect_list *effects, struct effect_list *out)
{
    uint32_t *first = ARENA_ARRAY(s->arena, uint32_t, effects->len + 1); /* per effect: where its LETs begin */
    uint32_t lets = 0;
    for (uint32_t i = 0; i < s->reached.len; i++) {
        struct plan *plan = plan_of(s, s->reached.items[i]);
        if (!(plan->flags & PLAN_LET))
            continue;
        plan->first = lift(s, plan->first, plan->region);
        first[plan->first + 1]++;
        lets++;
    }
    for (uint32_t i = 1; i <= effects->len; i++)
        first[i] += first[i - 1];
    out->len = 0;
    struct effect *statements = vec_extend(s->arena, out, lets + effects->len);
    for (uint32_t i = 0; i < s->reached.len; i++) {
        const struct plan *plan = plan_of(s, s->reached.items[i]);
        if (plan->flags & PLAN_LET)
            statements[first[plan->first]++ + plan->first] = (struct effect){.kind = EFFECT_LET, .value = ref_of(s, plan)};
    }
    for (uint32_t i = 0; i < effects->len; i++)
        statements[first[i] + i] = effects->items[i];
}

static void schedule_effects(struct scheduler *s, const struct effect_list *effects, struct effect_list *out)
{
    s->reached.len = s->called.len = 0;
    for (uint32_t i = 0; i < effects->len; i++)
        if (effects->items[i].value)
            collect(s, effects->items[i].value);
    find_regions(s, effects);
    find_places(s, effects);
    choose_locals(s);
    write_statements(s, effects, out);
    for (uint32_t i = 0; i < s->reached.len; i++)
        s->is_reached[s->reached.items[i]] = false;
}

/* ---- IR functions ---- */

static void schedule_function(struct scheduler *s, uint32_t function, struct effect_list *out)
{
    const struct ir_function *fn = &s->graph->functions.items[function];
    struct effect_list effects = {0};
    for (uint32_t i = fn->num_results; i-- > 0;) {
        ir_ref result = s->graph->function_results.items[fn->first_result + i];
        vec_push(s->arena, &effects, (struct effect){.kind = EFFECT_RESULT, .index = i, .value = result});
    }
    schedule_effects(s, &effects, out);
}

/* Schedules functions and what they call, callees first. */
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
        if (s->called.len) { /* just scheduled */
            memcpy(vec_extend(s->arena, &top->called, s->called.len), s->called.items, s->called.len * sizeof *s->called.items);
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
        .plans = arena_alloc(shader->arena, mem_array_size(shader->arena->mem, shader->graph->nodes.len, sizeof(struct plan))),
    };
    vec_reserve(s.arena, &s.reached, shader->graph->nodes.len);
    s.plans[0] = (struct plan){0}; /* of absent operands */
    s.is_reached[0] = true;
    s.stage->functions.len = s.stage->verbatim.len = 0;
    schedule_effects(&s, &s.stage->effects, &s.stage->statements);
    schedule_functions(&s);
}
