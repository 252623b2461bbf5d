// SPDX-License-Identifier: Apache-2.0
/*
 * Chooses the nodes that become locals. Measures nodes, operands first, and limits an expression to
 * about one line.
 */
#include "shader/schedule.h"

#include <assert.h>

/*
 * Characters of an expression. All names count alike, so that shaders that differ only in names
 * have the same statements.
 */
enum {
    GOOD_CHARS = 110,
    MAX_CHARS = 220,
    MIN_SPLIT_CHARS = 40,
    MAX_REPEATED_CHARS = 32,
    MAX_CLOSURE_CHARS = 64,
    NAME_CHARS = 10
};
/* a copy of a uniform is for the reader: a GPU reads it once anyway */
enum { MIN_USES_OF_COPY = 5 };
/*
 * The cost model of GPUs (docs/architecture.md): instructions per component. Roots, exponentials
 * and reciprocals run at a quarter of the rate of additions. Drivers find equal expressions in
 * straight code themselves, but they move nothing out of loops, so two limits decide what a GPU
 * does; bench/gpu measures them.
 */
enum {
    COST_OPERATOR = 1,
    COST_CHOICE = 3,
    COST_BUILTIN = 4,
    COST_CALL = 32,
    COST_LOCAL = 2,
    /* cheaper to compute in each round of a loop than to keep in a register */
    MAX_COST_IN_LOOP = 3,
    /* the same for a condition, which needs no register and reads better in its place */
    MAX_COST_OF_CONDITION = 3,
    /* a dearer arm of a choice is worth a branch, which a GPU takes where all pixels agree */
    MAX_COST_OF_ARM = 3
};

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

/*
 * Sets cost and length of the nodes that are never locals of their own: names and small constants.
 */
static bool is_source(const struct scheduler *s, struct plan *plan)
{
    const struct ir_node *node = node_of(s, plan);
    switch (plan->op) {
    case IR_CONST: {
        bool splat = is_splat(plan->type, s->graph->words.items + node->attr);
        uint32_t components = splat ? 1 : ir_type_info(plan->type)->components;
        plan->chars = clamp16(components == 1 ? 5 : 4 + 6 * components);
        return components <= 2 || plan->uses < (components > 4 ? 2u : 3u);
    }
    case IR_CONTEXT: /* u_lightData[i].member */
        plan->cost = 3;
        plan->chars = clamp16(NAME_CHARS + 15);
        return plan->uses < 3 || !ir_is_light_member(node->attr);
    case IR_UNIFORM:
        plan->cost = 2;
        plan->chars = clamp16(NAME_CHARS + 3);
        return !s->shader->interface.rules.blocks || plan->uses < MIN_USES_OF_COPY
               || ir_type_is_matrix(node->type);
    case IR_STREAM:
    case IR_TEXTURE:
        plan->cost = 2;
        plan->chars = clamp16(NAME_CHARS + 3);
        return true;
    case IR_LEAF: /* "transparent_bsdf()" */
        plan->cost = 1;
        plan->chars = NAME_CHARS + 2;
        return true;
    case IR_PARAM:
    case IR_LOCAL:
    case IR_SAMPLE:
    case IR_POISON:
        plan->cost = 1;
        plan->chars = 4;
        return true;
    default: return false;
    }
}

/*
 * The part of an operation in its expression: cost, characters, and characters per operand. All
 * calls count alike.
 */
static const struct {
    uint8_t cost, chars, chars_each, unused; /* elements of a size that an address can scale */
} measures[IR_NUM_OPS] = {
#define OP(ID, text, arity, rule, flags, doc) \
    [IR_##ID] = {(flags)&OP_BUILTIN ? COST_BUILTIN : COST_OPERATOR, \
                 (flags)&OP_BUILTIN        ? sizeof text - 1 \
                 : IR_##ID == IR_CONSTRUCT ? 4 \
                                           : 0, \
                 (flags)&OP_BUILTIN ? 2 : 3, 0},
#include "ir/ops.def"
#undef OP
};

static void own_measure(const struct scheduler *s, const struct plan *plan, uint32_t *out_cost,
                        uint32_t *out_chars)
{
    *out_cost = measures[plan->op].cost;
    *out_chars = measures[plan->op].chars + measures[plan->op].chars_each * plan->num_args;
    if (is_call(plan->op)) {
        uint32_t attr = node_of(s, plan)->attr;
        str_id name = plan->op == IR_GRAPH_CALL ? s->graph->functions.items[attr].name
                                                : s->graph->callees.items[attr].name;
        *out_cost = COST_CALL;
        *out_chars = (uint32_t)str_len(s->shader->strings, name) + 2 * plan->num_args;
    } else if (plan->op == IR_CONVERT && plan_of(s, *args_of(s, plan))->type == IR_TYPE_BOOL) {
        *out_cost = COST_CHOICE;
    }
}

static bool may_let(const struct scheduler *s, const struct plan *plan)
{
    ir_type_id type = plan->type;
    if (plan->flags & PLAN_LOCAL && plan->effect == MANY_EFFECTS)
        return false;
    if (plan->flags & PLAN_LOOP && s->regions.items[plan->region].outside == plan->region)
        return false;
    bool is_opaque =
        type == IR_TYPE_SAMPLER || type == IR_TYPE_SAMPLER_ARRAY || type == IR_TYPE_STRING;
    return plan->flags & PLAN_STATEMENT || (type != IR_TYPE_VOID && !is_opaque);
}

/* The name stands for the node from here on; its origin gives the name. */
static void let(struct plan *plan)
{
    plan->flags |= PLAN_LET;
    plan->cost = 1;
    plan->chars = NAME_CHARS + 2;
}

/* The longest operand that may become a local to shorten the line; NULL: there is none. */
static struct plan *longest_operand(const struct scheduler *s, const struct plan *plan)
{
    struct plan *longest = NULL;
    const ir_ref *args = args_of(s, plan), *end = args + plan->num_args;
    for (; args < end; args++) {
        struct plan *operand = plan_of(s, *args);
        bool is_long =
            operand->chars >= MIN_SPLIT_CHARS && (!longest || operand->chars > longest->chars);
        if (is_long && operand->num_args > 0 && !(operand->flags & PLAN_LET) && may_let(s, operand))
            longest = operand;
    }
    return longest;
}

/*
 * Sums up the operands. The longest ones become locals until the expression fits in a line. The
 * line may be longer if little of it would remain.
 */
static void measure(const struct scheduler *s, struct plan *plan)
{
    uint32_t own_cost, own_chars;
    const struct plan *plans = s->plans;
    const ir_ref *args = args_of(s, plan), *end = args + plan->num_args;
    own_measure(s, plan, &own_cost, &own_chars);
    for (;;) {
        uint32_t cost = own_cost, chars = own_chars;
        for (const ir_ref *arg = args; arg < end; arg++) {
            const struct plan *operand = &plans[*arg];
            cost += operand->cost;
            chars += operand->chars;
        }
        struct plan *longest = chars > GOOD_CHARS ? longest_operand(s, plan) : NULL;
        if (!longest || (chars <= MAX_CHARS && chars - longest->chars < MIN_SPLIT_CHARS)) {
            plan->cost = clamp16(cost);
            plan->chars = clamp16(chars);
            return;
        }
        let(longest);
    }
}

/* An operator on locals and variables costs less to repeat than to store. */
static bool is_cheap(const struct plan *plan)
{
    if (!(ir_op_info(plan->op)->flags & OP_OPERATOR) || plan->op == IR_SELECT
        || plan->chars > MAX_REPEATED_CHARS)
        return false;
    if (plan->flags & PLAN_MOVED)
        return plan->cost
               <= (plan->type == IR_TYPE_BOOL ? MAX_COST_OF_CONDITION : MAX_COST_IN_LOOP);
    return (uint32_t)plan->cost * plan->uses <= (uint32_t)plan->cost + COST_LOCAL + plan->uses;
}

/* True for a part of a local or variable. */
static bool is_part(struct scheduler *s, const struct plan *plan)
{
    if (plan->op == IR_RESULT)
        return true;
    if (plan->op != IR_SWIZZLE && plan->op != IR_MEMBER)
        return false;
    assert(plan->num_args == 1);
    const struct plan *whole = plan_of(s, args_of(s, plan)[0]);
    return whole->flags & PLAN_LET || whole->op == IR_RESULT || whole->num_args == 0;
}

/* True if an arm may become a local for let_arms. A local or variable needs no copy. */
static bool is_little_work(struct scheduler *s, const struct plan *arm)
{
    return arm->flags & PLAN_LOOP && (arm->num_args > 0 || arm->op == IR_CONTEXT)
           && !is_part(s, arm) && arm->cost <= MAX_COST_OF_ARM && may_let(s, arm)
           && !(arm->flags & PLAN_LOCAL);
}

/*
 * A choice between locals and constants is one operation, and a choice between expressions is a
 * branch. So arms become locals in a loop if they cost less than the branch; elsewhere one line
 * reads better.
 */
static void let_arms(struct scheduler *s, const struct plan *plan)
{
    assert(plan->op == IR_SELECT && plan->num_args == 3);
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

/* For targets in which only variables have parts: the operand of a part becomes a local. */
static void let_wholes(struct scheduler *s, const struct plan *plan)
{
    uint8_t op = plan->op;
    if (op != IR_SWIZZLE && op != IR_MEMBER && op != IR_INDEX && op != IR_CONVERT
        && op != IR_CONSTRUCT && op != IR_TEX)
        return;
    for (uint32_t a = 0; a < plan->num_args; a++) {
        struct plan *whole = plan_of(s, args_of(s, plan)[a]);
        bool has_parts = whole->type >= IR_NUM_TYPES || ir_type_info(whole->type)->components > 1;
        bool is_named = whole->num_args == 0 && whole->op != IR_CONST;
        if (has_parts && !is_named && whole->op != IR_RESULT && may_let(s, whole))
            let(whole);
    }
}

/* True if the node becomes a local. */
static bool is_wanted(const struct plan *plan)
{
    unsigned flags = plan->flags;
    bool is_long_closure = plan->op == IR_LEAF && plan->chars > MAX_CLOSURE_CHARS;
    if (flags & PLAN_STATEMENT || is_long_closure
        || (flags & PLAN_NEIGHBOURS && flags & (PLAN_IN_ARM | PLAN_MOVED)))
        return true;
    return (plan->uses > 1 || flags & PLAN_MOVED) && !is_cheap(plan);
}

/* Chooses locals, operands first. */
void choose_locals(struct scheduler *s)
{
    bool names_wholes = s->shader->interface.rules.names_wholes;
    for (uint32_t i = 0; i < s->reached.len; i++) {
        struct plan *plan = plan_of(s, s->reached.items[i]);
        /* an operand numbers the loop of a CONTEXT or SAMPLE, and the light of a LOCAL */
        bool is_name = plan->num_args == 0 || plan->op == IR_CONTEXT || plan->op == IR_SAMPLE
                       || plan->op == IR_LOCAL;
        if (is_name && is_source(s, plan))
            continue;
        if (plan->op == IR_SELECT)
            let_arms(s, plan);
        if (names_wholes)
            let_wholes(s, plan);
        measure(s, plan);
        if (is_wanted(plan) && may_let(s, plan) && !is_part(s, plan))
            let(plan);
    }
}
