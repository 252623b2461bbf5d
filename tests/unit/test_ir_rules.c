// SPDX-License-Identifier: Apache-2.0
/*
 * Tests derived from rules.def. Of every rule: what stands on the right stands on the left; the
 * right costs less, so that rewriting ends; both sides have the same value, on special and random
 * inputs and in every typing that fits; and the builder makes the same node of both sides.
 */
#include "ir/ir_priv.h"

#include "test.h"

#include <math.h>

enum { NUM_VARIABLES = RULE_VARIABLES, NUM_SAMPLES = 60, NUM_TYPINGS = 3 * 243 };

/* rules.def says what an op costs. */
static unsigned cost_of(enum ir_op op)
{
    switch (op) {
    case IR_NEG:
    case IR_NOT: return 1;
    case IR_SELECT:
    case IR_DISTANCE:
    case IR_POW: return 3;
    case IR_MIX: return 5;
    default: return 2;
    }
}

static unsigned cost(const uint8_t *tokens)
{
    unsigned sum = 0;
    for (; *tokens != RULE_END; tokens++)
        sum += *tokens < RULE_A ? cost_of((enum ir_op) * tokens) : 0;
    return sum;
}

static bool occurs(unsigned token, const uint8_t *tokens)
{
    while (*tokens != RULE_END && *tokens != token)
        tokens++;
    return *tokens == token;
}

/* A random number; its middle bits are good enough. */
static uint32_t random_bits(void)
{
    static uint64_t state = 1;
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(state >> 32);
}

static float random_float(bool exact)
{
    static const uint32_t specials[] = {0x7fc00000, 0x7f800000, 0xff800000, 1,
                                        0x80000001, 0x7f7fffff, 0xff7fffff};
    static const float common[] = {0.0f, -0.0f, 1.0f, -1.0f, 0.5f, 2.0f};
    uint32_t bits = random_bits();
    if (bits % 4 == 0)
        return common[bits / 4 % 6];
    if (exact && bits % 4 == 1) {
        union ir_word w = {.u = specials[bits / 4 % 7]};
        return w.f;
    }
    return ((float)(bits % 100000) - 50000.0f) / 12500.0f;
}

static struct ir_value random_value(ir_type_id type, bool exact)
{
    static const uint32_t integers[] = {0, 1, UINT32_MAX, 0x80000000, 0x7fffffff, 2};
    const struct ir_type_info *info = ir_type_info(type);
    struct ir_value value = {.type = type};
    for (unsigned i = 0; i < info->components; i++) {
        uint32_t bits = random_bits();
        if (info->scalar == IR_TYPE_FLOAT)
            value.w[i].f = random_float(exact);
        else if (info->scalar == IR_TYPE_BOOL)
            value.w[i].u = bits & 1;
        else
            value.w[i].u = bits & 1 ? integers[bits / 2 % 6] : bits;
    }
    return value;
}

/*
 * One way to give types to a rule: each variable has one of three types, and so have the constants.
 */
struct typing {
    struct ir_graph *graph;
    const ir_type_id *types;
    unsigned choice[NUM_VARIABLES + 1]; /* A B C D E, constants */
    bool linear;                        /* constants are for a product of linear algebra */
};

static ir_ref constant(const struct typing *t, unsigned token)
{
    static const float values[] = {0.0f, 1.0f, 2.0f, 0.5f, -1.0f, 1.0f};
    if (token >= RULE_TRUE)
        return ir_const_bool(t->graph, token == RULE_TRUE);
    ir_type_id type = t->types[t->choice[NUM_VARIABLES]];
    if (type == IR_TYPE_BOOL)
        return 0;
    struct ir_value value = {.type = type};
    const struct ir_type_info *info = ir_type_info(type);
    float f = token == RULE_K ? 3.0f : values[token - RULE_ZERO];
    if (token == RULE_IDENTITY)
        return t->linear && ir_type_is_matrix(type) ? ir_const_splat(t->graph, type, 1.0f) : 0;
    if (t->linear && token != RULE_ZERO)
        return 0;
    for (unsigned i = 0; i < info->components; i++) {
        if (info->scalar == IR_TYPE_FLOAT)
            value.w[i].f = f;
        else if (f != floorf(f) || (f < 0.0f && info->scalar == IR_TYPE_UINT))
            return 0;
        else
            value.w[i].i = (int32_t)f;
    }
    return ir_const(t->graph, &value);
}

/* Builds a side of a rule; 0 where the types do not fit. */
static ir_ref build_side(const struct typing *t, const uint8_t **tokens)
{
    unsigned token = *(*tokens)++;
    if (token >= RULE_K)
        return constant(t, token);
    if (token >= RULE_A)
        return ir_build(t->graph, IR_UNIFORM, t->types[t->choice[token - RULE_A]], token - RULE_A,
                        NULL, 0);
    ir_ref args[3] = {0};
    ir_type_id types[3];
    unsigned arity = (unsigned)ir_op_info((enum ir_op)token)->arity;
    for (unsigned i = 0; i < arity; i++) {
        args[i] = build_side(t, tokens);
        if (!args[i])
            return 0;
        types[i] = ir_type_of(t->graph, args[i]);
    }
    ir_type_id type = ir_op_result((enum ir_op)token, types, arity);
    if (type == IR_TYPE_VOID
        || (token == IR_MUL && ir_is_linear_mul(types[0], types[1]) != t->linear))
        return 0;
    return ir_build(t->graph, (enum ir_op)token, type, 0, args, arity);
}

/*
 * The right side: constants that stand alone have the root's type, others are scalars; then it is
 * widened.
 */
static ir_ref build_right(const struct typing *t, const struct rule *rule, ir_type_id type)
{
    static const float values[] = {0.0f, 1.0f, 2.0f, 0.5f, -1.0f, 1.0f, 1.0f, 0.0f};
    const uint8_t *tokens = rule->replacement;
    if (tokens[0] >= RULE_ZERO)
        return ir_const_splat(t->graph, type, values[tokens[0] - RULE_ZERO]);
    ir_type_id scalars[] = {ir_type_info(type)->scalar};
    struct typing right = *t;
    right.choice[NUM_VARIABLES] = 3;
    ir_type_id types[] = {t->types[0], t->types[1], t->types[2], scalars[0]};
    right.types = types;
    ir_ref ref = build_side(&right, &tokens);
    if (!ref || ir_type_of(t->graph, ref) == type)
        return ref;
    return ir_type_is_matrix(type) ? 0 : ir_convert(t->graph, type, ref);
}

struct sample {
    const struct typing *typing;
    bool exact;
    struct ir_value values[NUM_VARIABLES];
};

static bool sample_source(void *user_data, const struct ir_graph *graph, ir_ref ref,
                          struct ir_value *out)
{
    const struct sample *sample = user_data;
    *out = sample->values[ir_get(graph, ref)->attr];
    return true;
}

static bool same_word(union ir_word a, union ir_word b, bool is_float, bool exact)
{
    if (!is_float || (exact && !(isnan(a.f) && isnan(b.f))))
        return a.u == b.u;
    return exact || fabsf(a.f - b.f) <= 1e-4f * (1.0f + fabsf(a.f));
}

static bool is_finite(const struct ir_value *value)
{
    for (unsigned i = 0; i < ir_type_info(value->type)->components; i++)
        if (ir_type_info(value->type)->scalar == IR_TYPE_FLOAT && !isfinite(value->w[i].f))
            return false;
    return true;
}

/* Whether both sides agree on one sample; also where the left side is undefined there. */
static bool agrees(const struct ir_graph *graph, ir_ref left, ir_ref right, struct sample *sample,
                   struct arena *scratch)
{
    struct ir_eval_env env = {.user_data = sample, .source = sample_source};
    struct ir_value a, b;
    if (!ir_eval(graph, left, &env, scratch, &a) || (!sample->exact && !is_finite(&a)))
        return true;
    if (!ir_eval(graph, right, &env, scratch, &b) || a.type != b.type)
        return false;
    const struct ir_type_info *info = ir_type_info(a.type);
    for (unsigned i = 0; i < info->components; i++)
        if (!same_word(a.w[i], b.w[i], info->scalar == IR_TYPE_FLOAT, sample->exact))
            return false;
    return true;
}

static void print_typing(const struct rule *rule, const struct typing *t)
{
    printf("    rule %s, types", rule->name);
    for (unsigned k = 0; k <= NUM_VARIABLES; k++)
        printf(" %s", ir_type_text(t->types[t->choice[k]]));
    printf("\n");
}

/* Tests a rule in one typing. False where the types do not fit. */
static bool test_typing(const struct rule *rule, struct typing *t)
{
    bool fits = false;
    struct mem mem;
    struct arena arena;
    struct ir_graph plain, folding;
    mem_init(&mem, NULL, NULL);
    arena_init(&arena, &mem);
    ir_graph_init(&plain, &arena, NULL);
    ir_graph_init(&folding, &arena, NULL);
    plain.no_fold = true;
    const uint8_t *pattern = rule->pattern;
    t->graph = &plain;
    ir_ref left = build_side(t, &pattern);
    ir_ref right = left ? build_right(t, rule, ir_type_of(&plain, left)) : 0;
    if (left && right) {
        fits = true;
        /* derivatives are of constants here, and 0 */
        bool derivative = ir_get(&plain, left)->flags & IR_NODE_DERIVATIVE;
        for (unsigned i = 0; i < NUM_SAMPLES && !derivative; i++) {
            struct sample sample = {.typing = t, .exact = rule->exact};
            for (unsigned k = 0; k < NUM_VARIABLES; k++)
                sample.values[k] = random_value(t->types[t->choice[k]], rule->exact);
            if (!REQUIRE(agrees(&plain, left, right, &sample, &arena)))
                print_typing(rule, t);
        }
        t->graph = &folding;
        pattern = rule->pattern;
        left = build_side(t, &pattern);
        right = build_right(t, rule, ir_type_of(&folding, left));
        if (!REQUIRE_EQ(left, right))
            printf("    rule %s\n", rule->name);
    }
    arena_finish(&arena);
    return fits;
}

static unsigned test_typings(const struct rule *rule)
{
    static const ir_type_id families[][3] = {
        {IR_TYPE_BOOL, IR_TYPE_FLOAT, IR_TYPE_VEC3}, {IR_TYPE_BOOL, IR_TYPE_INT, IR_TYPE_IVEC2},
        {IR_TYPE_BOOL, IR_TYPE_UINT, IR_TYPE_UINT},  {IR_TYPE_BOOL, IR_TYPE_FLOAT, IR_TYPE_MAT2},
        {IR_TYPE_BOOL, IR_TYPE_VEC2, IR_TYPE_MAT2},
    };
    unsigned num_fits = 0;
    for (size_t family = 0; family < sizeof families / sizeof *families; family++) {
        unsigned num_choices = rule->pattern[0] == IR_MUL ? 2 * NUM_TYPINGS : NUM_TYPINGS;
        for (unsigned n = 0; n < num_choices; n++) {
            struct typing t = {.types = families[family], .linear = n >= NUM_TYPINGS};
            unsigned rest = n % NUM_TYPINGS;
            bool wanted = true;
            for (unsigned k = 0; k <= NUM_VARIABLES; k++, rest /= 3) {
                t.choice[k] = rest % 3;
                bool used = k == NUM_VARIABLES || occurs(RULE_A + k, rule->pattern);
                wanted = wanted && (used || t.choice[k] == 0);
            }
            num_fits += wanted && test_typing(rule, &t);
        }
    }
    return num_fits;
}

static void test_shape(enum ir_op op, const struct rule *rule)
{
    bool bound = true;
    for (const uint8_t *token = rule->replacement; *token != RULE_END; token++)
        if (*token >= RULE_A && *token < RULE_K)
            bound = bound && occurs(*token, rule->pattern);
    if (!REQUIRE_EQ(rule->pattern[0], op) || !REQUIRE(bound)
        || !REQUIRE(cost(rule->replacement) < cost(rule->pattern)))
        printf("    rule %s\n", rule->name);
}

/* The matcher looks no deeper than RULE_DEPTH ops. Returns the end of the expression. */
static const uint8_t *test_depth(const uint8_t *token, unsigned depth)
{
    unsigned op = *token++;
    if (op >= RULE_A)
        return token;
    REQUIRE(depth <= RULE_DEPTH);
    for (int8_t i = 0; i < ir_op_info((enum ir_op)op)->arity; i++)
        token = test_depth(token, depth + 1);
    return token;
}

int main(void)
{
    unsigned num_rules = 0;
    for (unsigned op = 0; op < IR_NUM_OPS; op++) {
        const struct rule *rules = ir_rules[op].rules;
        for (unsigned i = 0; i < ir_rules[op].num; i++, num_rules++) {
            test_shape((enum ir_op)op, &rules[i]);
            REQUIRE_EQ(*test_depth(rules[i].pattern, 1), RULE_END);
            if (!REQUIRE(test_typings(&rules[i]) > 0))
                printf("    rule %s fits no types\n", rules[i].name);
        }
    }
    REQUIRE(num_rules > 80);
    return test_report("ir_rules");
}
