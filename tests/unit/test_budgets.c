// SPDX-License-Identifier: Apache-2.0
/*
 * Budgets of slabs: sizes, colour differences, and for examples and random stacks that each step
 * makes the tree cheaper, and that blended slabs are nearer to the whole than the heaviest of its
 * slabs.
 */
#include "api/generation.h"
#include "build/build_priv.h"
#include "slabs/blend.h"
#include "slabs/difference.h"
#include "slabs/estimate.h"
#include "slabs/search.h"

#include "slab_stacks.h"
#include "test.h"

#include <stdlib.h>

enum { NUM_STACKS = 40, MAX_CLOSURES = 3, MAX_ERRORS = 256 };

struct run {
    mxg_context *context;
    mxg_library *library;
    struct generation *generation;
    struct arena scratch;
    float blended[MAX_ERRORS], heaviest[MAX_ERRORS];
    unsigned num_errors;
};

/* ---- Colour differences ---- */

static void test_difference(void)
{
    static const struct {
        double a[3], b[3], difference;
    } pairs[] = {
#define PAIR(la, aa, ba, lb, ab, bb, difference) {{la, aa, ba}, {lb, ab, bb}, difference},
#include "differences.def"
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        REQUIRE(fabs(lab_difference(pairs[i].a, pairs[i].b) - pairs[i].difference) < 1e-4);
    const float white[3] = {1, 1, 1}, black[3] = {0, 0, 0}, brighter[3] = {9, 9, 9};
    REQUIRE(fabs(color_difference(white, black) - 100.0) < 0.01);
    REQUIRE(color_difference(white, brighter) == 0.0);
}

/* ---- Generations ---- */

static void with_document(struct run *run, mxg_document *document, const char *element,
                          void (*steps)(struct generation *))
{
    mxg_result *result = NULL;
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "glsl";
    desc.element = element;
    REQUIRE(generation_run(run->context, document, &desc, steps, run, &result) == MXG_OK);
    mxg_result_destroy(result);
}

static bool begin(struct generation *g)
{
    struct run *run = g->user_data;
    run->generation = g;
    if (!REQUIRE(generation_start(g) && generation_build(g)))
        return false;
    generation_start_closures(g);
    return true;
}

static ir_ref lobes(void *user_data, const ir_ref *inputs, const struct slab_place *place)
{
    return build_slab_lobes(user_data, inputs, place);
}

static struct slabs_host host_of(struct generation *g)
{
    return (struct slabs_host){.user_data = g->builder,
                               .lobes = lobes,
                               .closures = &g->closure_host,
                               .scratch = &g->estimates};
}

/* ---- The heaviest slabs ---- */

/* Without some slabs, by their number. */
static ir_ref without(struct generation *g, ir_ref root, const struct slab_spots *spots,
                      uint32_t dropped)
{
    struct ir_graph *graph = &g->result->graph;
    unsigned number = 0;
    for (uint32_t i = 0; i < spots->items.len; i++) {
        ir_ref slab = spots->items.items[i].ref, in[NUM_SLAB_OPERANDS];
        if (ir_get(graph, slab)->op != IR_SLAB || !(dropped >> number++ & 1u))
            continue;
        memcpy(in, ir_args(graph, slab), sizeof in);
        in[SLAB_coverage] = ir_const_float(graph, 0.0f);
        ir_ref absent = ir_build(graph, IR_SLAB, IR_TYPE_BSDF, 0, in, NUM_SLAB_OPERANDS);
        root = ir_replace(graph, root, slab, absent, g->result->shader.arena);
    }
    return root;
}

/* Drops the slabs that are missed least, one by one, until `num` are left. */
static float error_of_heaviest(struct generation *g, uint32_t num_slabs, uint32_t num)
{
    struct slabs_host host = host_of(g);
    uint32_t dropped = 0;
    float error = 0.0f;
    struct slab_spots spots;
    slabs_find_spots(g->result->shader.graph, g->root, g->result->shader.arena, &spots);
    struct slab_eye *eye = slabs_open_eye(&g->result->shader, &host, g->root);
    for (uint32_t left = num_slabs; left > num; left--) {
        uint32_t best = 0;
        for (uint32_t i = 0; i < num_slabs; i++) {
            if (dropped >> i & 1u)
                continue;
            float e = slabs_estimate(eye, without(g, g->root, &spots, dropped | 1u << i));
            if (!best || e < error) {
                best = 1u << i;
                error = e;
            }
        }
        dropped |= best;
    }
    return error;
}

/* ---- Budgets ---- */

static void check_steps(const struct slab_report *report)
{
    struct slab_cost at = report->before;
    for (uint32_t i = 0; i < report->steps.len; i++) {
        const struct slab_step *step = &report->steps.items[i];
        REQUIRE(step->before.closures == at.closures && step->before.bytes == at.bytes);
        REQUIRE(step->after.closures <= at.closures && step->after.bytes <= at.bytes);
        REQUIRE(step->error >= 0.0f);
        at = step->after;
    }
    REQUIRE(at.closures == report->after.closures && at.bytes == report->after.bytes);
}

static void save_closures(struct generation *g)
{
    struct run *run = g->user_data;
    struct slab_report report;
    if (!begin(g))
        return;
    struct slab_cost whole = slabs_cost(g->result->shader.graph, g->root, g->result->shader.arena);
    for (uint32_t num = 1; num <= MAX_CLOSURES && num < whole.closures; num++) {
        struct slab_budget budget = {.max_slabs = num, .max_error = -1.0f, .max_steps = -1};
        ir_ref root = build_budget_slabs(g->builder, &g->closure_host, &g->estimates, &budget,
                                         g->root, &report);
        REQUIRE(report.is_met && report.after.closures == num);
        check_steps(&report);
        REQUIRE_EQ(slabs_cost(g->result->shader.graph, root, g->result->shader.arena).closures,
                   num);
        if (!REQUIRE(run->num_errors < MAX_ERRORS))
            return;
        run->heaviest[run->num_errors] = error_of_heaviest(g, whole.closures, num);
        run->blended[run->num_errors++] = report.error;
    }
}

static int by_size(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Examples by the file that has them: the number of an argument. */
struct example {
    int path;
    const char *element;
};
static const struct example examples[] = {
    {1, "CoatedMetal"},    {1, "DustyFibre"},   {1, "WrappedSilk"},    {1, "CarPaint"},
    {1, "MilkySheet"},     {3, "SkinIntoGold"}, {3, "CoatedSkin"},     {3, "MetalToPlastic"},
    {3, "CarbonAndMetal"}, {3, "Opal"},         {4, "HazyMetal"},      {4, "DustyLacquer"},
    {4, "FlipFlop"},       {4, "AmberOnOak"},   {4, "ScreenInVelvet"}, {5, "FlakePaint"},
    {5, "PearlPaint"}};
enum { NUM_EXAMPLES = sizeof examples / sizeof *examples };

static mxg_document *load(const struct run *run, const char *path)
{
    mxg_document *document = NULL;
    REQUIRE(mxg_document_load(run->context, run->library, path, &document) == MXG_OK);
    return document;
}

static void test_closures(struct run *run, char **paths)
{
    stack_seed(0);
    for (size_t i = 0; i < NUM_EXAMPLES; i++) {
        mxg_document *document = load(run, paths[examples[i].path]);
        with_document(run, document, examples[i].element, save_closures);
        mxg_document_destroy(document);
    }
    for (int i = 0; i < NUM_STACKS; i++) {
        static char text[STACK_TEXT];
        struct stack stack;
        mxg_document *of_stack = NULL;
        stack_make(&stack, 1 + i % 3, i % 2, stack_between(0.2, 0.9));
        for (int k = 0; k < stack.num_nodes; k++) {
            stack.nodes[k].f0 = stack_random() < 0.7 ? 0.04 : stack_between(0.3, 0.9);
            stack.nodes[k].roughness = stack_between(0.1, 1.0);
        }
        stack_write(&stack, text);
        REQUIRE(mxg_document_parse(run->context, run->library, "stack.mtlx", text, strlen(text),
                                   &of_stack)
                == MXG_OK);
        with_document(run, of_stack, NULL, save_closures);
        mxg_document_destroy(of_stack);
    }
    unsigned num = run->num_errors, nearer = 0;
    for (unsigned i = 0; i < num; i++)
        nearer += run->blended[i] < run->heaviest[i];
    qsort(run->blended, num, sizeof *run->blended, by_size);
    qsort(run->heaviest, num, sizeof *run->heaviest, by_size);
    printf("%u budgets: median and worst error %.2f, %.2f; the heaviest slabs %.2f, %.2f; nearer "
           "%u\n",
           num, (double)run->blended[num / 2], (double)run->blended[num - 1],
           (double)run->heaviest[num / 2], (double)run->heaviest[num - 1], nearer);
    REQUIRE(2.0f * run->blended[num / 2] < run->heaviest[num / 2]);
    REQUIRE(2.0f * run->blended[num - 1] < run->heaviest[num - 1]);
}

/* The smallest shader within an error. */
static void save_error(struct generation *g)
{
    struct slab_report tight, loose;
    if (!begin(g))
        return;
    struct slab_budget budget = {.max_error = 0.3f, .max_steps = -1};
    build_budget_slabs(g->builder, &g->closure_host, &g->estimates, &budget, g->root, &tight);
    budget.max_error = 5.0f;
    build_budget_slabs(g->builder, &g->closure_host, &g->estimates, &budget, g->root, &loose);
    check_steps(&tight);
    check_steps(&loose);
    REQUIRE(tight.is_met && tight.error <= 0.3f && tight.after.closures == 2);
    REQUIRE(loose.is_met && loose.error <= 5.0f && loose.after.closures == 1);
    REQUIRE(loose.after.bytes <= tight.after.bytes);
}

/* ---- The smallest within an error ---- */

enum { MAX_FIXED = 1024 };

/* Results of budgets of closures and features. */
struct fixed {
    struct slab_report reports[MAX_FIXED];
    unsigned num;
};

static void spend(struct generation *g, const struct slab_budget *budget, struct slab_report *out)
{
    build_budget_slabs(g->builder, &g->closure_host, &g->estimates, budget, g->root, out);
}

static void spend_all(struct generation *g, struct fixed *out)
{
    struct slab_cost whole = slabs_cost(g->result->shader.graph, g->root, g->result->shader.arena);
    for (uint32_t off = 0; off < 1u << NUM_SLAB_FEATURES; off++)
        for (uint32_t num = whole.closures; num && !(off & ~whole.features); num--) {
            struct slab_budget budget = {
                .max_slabs = num, .max_error = -1.0f, .off = off, .max_steps = -1};
            if (REQUIRE(out->num < MAX_FIXED))
                spend(g, &budget, &out->reports[out->num++]);
        }
}

static bool is_smaller(struct slab_cost a, struct slab_cost b)
{
    return a.closures != b.closures ? a.closures < b.closures : a.bytes < b.bytes;
}

/* No budget of closures and features within an error is smaller than what the error gives. */
static void save_most(struct generation *g)
{
    static const float errors[] = {0.2f, 0.7f, 1.52f, 3.0f, 6.0f};
    static struct fixed fixed;
    fixed.num = 0;
    if (!begin(g))
        return;
    spend_all(g, &fixed);
    for (size_t i = 0; i < sizeof errors / sizeof *errors; i++) {
        struct slab_budget budget = {.max_error = errors[i], .max_steps = -1};
        struct slab_report report;
        spend(g, &budget, &report);
        check_steps(&report);
        REQUIRE(report.is_met && report.error <= errors[i]);
        for (unsigned k = 0; k < fixed.num; k++) {
            const struct slab_report *other = &fixed.reports[k];
            bool is_within = other->is_met && other->error >= 0.0f && other->error <= errors[i];
            REQUIRE(!is_within || !is_smaller(other->after, report.after));
        }
    }
}

static void test_errors(struct run *run, char **paths)
{
    for (size_t i = 0; i < NUM_EXAMPLES; i++) {
        mxg_document *document = load(run, paths[examples[i].path]);
        with_document(run, document, examples[i].element, save_most);
        mxg_document_destroy(document);
    }
}

/* Features go where blending is not enough; nothing keeps to 8 bytes. */
static void save_bytes(struct generation *g)
{
    struct slab_report report;
    if (!begin(g))
        return;
    for (uint32_t bytes = 8; bytes <= 64; bytes += 4) {
        struct slab_budget budget = {.max_bytes = bytes, .max_error = -1.0f, .max_steps = -1};
        build_budget_slabs(g->builder, &g->closure_host, &g->estimates, &budget, g->root, &report);
        check_steps(&report);
        REQUIRE(report.is_met == (bytes >= 12));
        REQUIRE(report.after.bytes <= (bytes < 12 ? 12 : bytes));
    }
}

/* Without options nothing changes, and nothing is looked at. */
static void save_nothing(struct generation *g)
{
    struct slab_report report;
    if (!begin(g))
        return;
    struct slab_budget budget = {.max_error = -1.0f, .max_steps = -1};
    uint32_t before = g->result->graph.nodes.len;
    ir_ref root =
        build_budget_slabs(g->builder, &g->closure_host, &g->estimates, &budget, g->root, &report);
    REQUIRE(root == g->root && report.steps.len == 0 && report.is_met);
    REQUIRE(g->result->graph.nodes.len <= before + 1);
}

/* ---- Bytes: what a budget counts before the walk is what the deferred pipeline stores ---- */

/* tests/deferred counts the stored words in images. */
static unsigned compare_bytes(const struct run *run, mxg_document *document, const char *element,
                              bool is_exact)
{
    mxg_result *result = NULL;
    mxg_options *options = NULL;
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    REQUIRE(mxg_options_create(run->context, &options) == MXG_OK);
    mxg_options_set(options, "role", "deferred");
    mxg_options_set(options, "storage", "round");
    mxg_options_set(options, "interface", "reduced");
    mxg_options_set(options, "slabs", "true");
    desc.target = "vulkan";
    desc.element = element;
    desc.options = options;
    REQUIRE(mxg_generate(run->context, document, &desc, &result) == MXG_OK);
    uint32_t stored = 4 * result->shader.reflection.stored_words,
             counted = result->slabs.after.bytes;
    bool has_slabs = result->shader.reflection.closures.len > 0;
    REQUIRE(is_exact ? stored == counted : stored <= counted || !has_slabs);
    mxg_result_destroy(result);
    mxg_options_destroy(options);
    return stored > 0;
}

/* Other materials; the first has a base whose lobes exist before those of its top. */
static unsigned compare_materials(const struct run *run)
{
    static const char *const texts[] = {
        "<standard_surface name='M' type='surfaceshader'>"
        "<input name='base' type='float' value='1'/>"
        "<input name='subsurface' type='float' value='0.4'/></standard_surface>",
        "<surface_unlit name='M' type='surfaceshader'/>",
        "<dielectric_bsdf name='d' type='BSDF'><input name='ior' type='float' value='3'/>"
        "</dielectric_bsdf><oren_nayar_diffuse_bsdf name='o' type='BSDF'/>"
        "<mix name='m' type='BSDF'><input name='fg' type='BSDF' nodename='d'/>"
        "<input name='bg' type='BSDF' nodename='o'/>"
        "<input name='mix' type='float' value='0.5'/></mix>"
        "<layer name='l' type='BSDF'><input name='top' type='BSDF' nodename='d'/>"
        "<input name='base' type='BSDF' nodename='m'/></layer>"
        "<surface name='M' type='surfaceshader'><input name='bsdf' type='BSDF' nodename='l'/>"
        "</surface>",
        /* one slab over itself: two closures, because other matter lies below each */
        "<slab name='a' type='BSDF'>"
        "<input name='mean_free_path' type='vector3' value='0.1, 0.2, 0.3'/></slab>"
        "<slab name='b' type='BSDF'/><slab_layer name='u' type='BSDF'>"
        "<input name='top' type='BSDF' nodename='a'/><input name='base' type='BSDF' nodename='b'/>"
        "</slab_layer><slab_layer name='t' type='BSDF'>"
        "<input name='top' type='BSDF' nodename='a'/><input name='base' type='BSDF' nodename='u'/>"
        "</slab_layer><slab_surface name='M' type='surfaceshader'>"
        "<input name='bsdf' type='BSDF' nodename='t'/></slab_surface>",
        /* one slab below a rough interface and beside it, where it looks smoother */
        "<slab name='a' type='BSDF'/><slab name='c' type='BSDF'>"
        "<input name='mean_free_path' type='vector3' value='0.3, 0.2, 0.1'/></slab>"
        "<slab_layer name='u' type='BSDF'><input name='top' type='BSDF' nodename='c'/>"
        "<input name='base' type='BSDF' nodename='a'/></slab_layer>"
        "<slab_mix name='t' type='BSDF'><input name='fg' type='BSDF' nodename='a'/>"
        "<input name='bg' type='BSDF' nodename='u'/><input name='mix' type='float' value='0.3'/>"
        "</slab_mix><slab_surface name='M' type='surfaceshader'>"
        "<input name='bsdf' type='BSDF' nodename='t'/></slab_surface>"};
    unsigned stored = 0;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        mxg_document *document = NULL;
        char text[2048];
        int len = snprintf(text, sizeof text, "<materialx version='1.39'>%s</materialx>", texts[i]);
        REQUIRE(
            mxg_document_parse(run->context, run->library, "m.mtlx", text, (size_t)len, &document)
            == MXG_OK);
        stored += compare_bytes(run, document, "M", i != 1);
        mxg_document_destroy(document);
    }
    return stored;
}

static void test_bytes(const struct run *run, char **paths)
{
    static const struct example rows[] = {{2, "Plain"},      {2, "Wax"},         {2, "Hazy"},
                                          {2, "Downy"},      {2, "Satin"},       {2, "Lacquered"},
                                          {2, "Chipped"},    {2, "Lantern"},     {1, "CoatedMetal"},
                                          {1, "DustyFibre"}, {1, "WrappedSilk"}, {1, "CarPaint"}};
    enum { NUM_ROWS = sizeof rows / sizeof *rows };
    unsigned stored = 0;
    stack_seed(1);
    for (size_t i = 0; i < NUM_ROWS; i++) {
        mxg_document *document = load(run, paths[rows[i].path]);
        stored += compare_bytes(run, document, rows[i].element, true);
        mxg_document_destroy(document);
    }
    REQUIRE_EQ(stored, NUM_ROWS);
    stored += compare_materials(run);
    for (int i = 0; i < NUM_STACKS; i++) {
        static char text[STACK_TEXT];
        struct stack stack;
        mxg_document *document = NULL;
        stack_make(&stack, 1 + i % 4, i % 2, stack_between(0.2, 0.9));
        for (int k = 0; k < stack.num_nodes; k++)
            stack.nodes[k].f0 = stack_random() < 0.7 ? 0.04 : stack_between(0.3, 0.9);
        stack_write(&stack, text);
        REQUIRE(mxg_document_parse(run->context, run->library, "stack.mtlx", text, strlen(text),
                                   &document)
                == MXG_OK);
        stored += compare_bytes(run, document, NULL, false);
        mxg_document_destroy(document);
    }
    printf("%u surfaces are stored as they are counted\n", stored);
    REQUIRE(stored > NUM_ROWS + NUM_STACKS / 2);
}

/* ---- Within bytes ---- */

/*
 * Features go before blends, where that is better: nothing that gives one up first is nearer, also
 * the second lobe that blends make. Those of what lies below take no bytes, so they stay.
 */
static void save_best(struct generation *g)
{
    if (!begin(g))
        return;
    struct slab_cost whole = slabs_cost(g->result->shader.graph, g->root, g->result->shader.arena);
    for (uint32_t bytes = 16; bytes < whole.bytes; bytes += 16) {
        struct slab_budget budget = {.max_bytes = bytes, .max_error = -1.0f, .max_steps = -1};
        struct slab_report best, other;
        spend(g, &budget, &best);
        REQUIRE(best.is_met && best.after.bytes <= bytes);
        REQUIRE(best.error >= 0.0f || whole.features & 1u << SLAB_GLINTS);
        for (uint32_t i = 0; i < NUM_SLAB_FEATURES; i++) {
            budget.off = 1u << i;
            if (budget.off & SLAB_FEATURES_BELOW)
                continue;
            spend(g, &budget, &other);
            REQUIRE(other.error < 0.0f || best.error <= other.error + 1e-5f);
        }
    }
}

/* Eight slabs: the nearest of two slabs in 48 bytes has no second lobe. */
static void save_eight(struct generation *g)
{
    static const struct {
        uint32_t bytes;
        float error;
    } rows[] = {{136, 0.003f}, {96, 0.15f}, {48, 1.3f}};
    if (!begin(g))
        return;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct slab_budget budget = {
            .max_bytes = rows[i].bytes, .max_error = -1.0f, .max_steps = -1};
        struct slab_report report;
        spend(g, &budget, &report);
        check_steps(&report);
        REQUIRE(report.is_met && report.after.bytes <= rows[i].bytes);
        REQUIRE(report.error <= rows[i].error && report.num_steps < SLAB_SEARCH_STEPS);
    }
}

static void test_within_bytes(struct run *run, char **paths)
{
    for (size_t i = 0; i < NUM_EXAMPLES; i++) {
        mxg_document *document = load(run, paths[examples[i].path]);
        with_document(run, document, examples[i].element, save_best);
        mxg_document_destroy(document);
    }
    mxg_document *document = load(run, paths[6]);
    with_document(run, document, "Soup8", save_eight);
    mxg_document_destroy(document);
}

/* ---- Large stacks ---- */

/* A stack of operators on slabs whose media scatter: each has the stack before as an operand. */
struct operator
{
    const char *node, *upper, *lower;
};
static const struct operator layer = {"slab_layer", "top", "base"};
static const struct operator mix = {"slab_mix", "fg", "bg"};

static mxg_document *stack_of(const struct run *run, int num, const struct operator* op)
{
    static char text[STACK_TEXT];
    mxg_document *document = NULL;
    size_t len = (size_t)snprintf(text, sizeof text,
                                  "<materialx version='1.39'><slab name='l0' type='BSDF'/>"
                                  "<noise2d name='noise' type='float'/>");
    for (int i = 1; i <= num; i++)
        len += (size_t)snprintf(
            text + len, sizeof text - len,
            "<slab name='s%d' type='BSDF'><input name='diffuse_albedo' type='color3' "
            "value='0.5,0.%d,0.4'/><input name='roughness' type='float' value='0.%d'/>"
            "<input name='mean_free_path' type='vector3' value='0.0%d,0.02,0.02'/></slab>"
            "<%s name='l%d' type='BSDF'><input name='%s' type='BSDF' nodename='s%d'/>"
            "<input name='%s' type='BSDF' nodename='l%d'/>%s</%s>",
            i, i % 8 + 1, i % 9 + 1, i % 7 + 1, op->node, i, op->upper, i, op->lower, i - 1,
            op == &mix ? "<input name='mix' type='float' nodename='noise'/>" : "", op->node);
    snprintf(text + len, sizeof text - len,
             "<slab_surface name='out' type='surfaceshader'><input name='bsdf' type='BSDF' "
             "nodename='l%d'/></slab_surface></materialx>",
             num);
    REQUIRE(mxg_document_parse(run->context, run->library, "l.mtlx", text, strlen(text), &document)
            == MXG_OK);
    return document;
}

/* A search that tried all orders of 23 steps would not end. */
static void search_stack(struct generation *g)
{
    struct slab_budget budget = {.max_error = 100.0f, .max_steps = -1};
    struct slab_report report;
    if (!begin(g))
        return;
    build_budget_slabs(g->builder, &g->closure_host, &g->estimates, &budget, g->root, &report);
    REQUIRE(report.is_met && report.before.closures == 24 && report.after.closures == 1);
    REQUIRE(report.num_steps < SLAB_SEARCH_STEPS);
}

static void search_stacks(struct run *run)
{
    static const struct operator* const operators[] = {&layer, &mix};
    for (size_t i = 0; i < sizeof operators / sizeof *operators; i++) {
        mxg_document *document = stack_of(run, 23, operators[i]);
        with_document(run, document, NULL, search_stack);
        mxg_document_destroy(document);
    }
}

/* The bytes of the shader of a stack of layers. */
static size_t size_of_layers(const struct run *run, int num)
{
    mxg_document *document = stack_of(run, num, &layer);
    mxg_result *result = NULL;
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    size_t size = 0;
    desc.target = "glsl";
    REQUIRE(mxg_generate(run->context, document, &desc, &result) == MXG_OK);
    mxg_result_source(result, MXG_STAGE_PIXEL, &size);
    mxg_result_destroy(result);
    mxg_document_destroy(document);
    return size;
}

/* Eight more layers take no more code than the eight before, but for the functions that those
 * share. */
static void test_code(const struct run *run)
{
    size_t two = size_of_layers(run, 2), ten = size_of_layers(run, 10),
           eighteen = size_of_layers(run, 18);
    printf("bytes of 2, 10 and 18 layers that scatter: %zu, %zu, %zu\n", two, ten, eighteen);
    REQUIRE(two > 0 && (eighteen - ten) * 10 < (ten - two) * 13);
}

int main(int argc, char **argv)
{
    struct run run = {.num_errors = 0};
    test_difference();
    REQUIRE(argc == 7 && mxg_context_create(NULL, &run.context) == MXG_OK);
    run.library = mxg_library_builtin(run.context);
    mxg_document *document = load(&run, argv[1]);
    test_code(&run);
    test_closures(&run, argv);
    test_errors(&run, argv);
    with_document(&run, document, "CarPaint", save_error);
    with_document(&run, document, "WrappedSilk", save_bytes);
    with_document(&run, document, "CarPaint", save_nothing);
    test_bytes(&run, argv);
    test_within_bytes(&run, argv);
    mxg_document_destroy(document);
    search_stacks(&run);
    mxg_library_unref(run.library);
    mxg_context_destroy(run.context);
    return test_report("budgets");
}
