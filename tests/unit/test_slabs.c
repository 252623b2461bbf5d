// SPDX-License-Identifier: Apache-2.0
/*
 * Slabs: the weights of the walk against exact expectations, and the light that stacks reflect
 * against a random walk (slab_stacks.h). The graphs are those of the shaders; the IR's evaluator
 * computes them.
 */
#include "api/generation.h"

#include "lower/lower.h"
#include "slab_facets.h"
#include "slab_stacks.h"
#include "test.h"

#include <stdlib.h>

enum { NUM_STACKS = 200, NUM_PATHS = 20000 };

/*
 * Stacks and walks are the same in each run, so limits are about 1.3 times what the test prints:
 * another compiler rounds otherwise, and a change of the walk shows. docs/slabs.md has the results.
 */

struct run {
    mxg_context *context;
    mxg_library *library;
    mxg_options *options;
    struct generation *generation;
    double view, light;           /* cosines */
    double view_turn, light_turn; /* around the normal, from the tangent */
    int fineness;                 /* of integrals over light */
    enum role_id role;            /* whose slabs: light walks through those of scatter */
    void (*look)(struct run *run);
    void *wanted; /* of `look` */
    FILE *page;   /* for the stacks and their errors, as Markdown; NULL: none */
};

/* ---- Evaluation ---- */

static struct ir_value direction(double cosine, double turn)
{
    double sine = sqrt(1.0 - cosine * cosine);
    return (struct ir_value){
        IR_TYPE_VEC3,
        {{.f = (float)(sine * cos(turn))}, {.f = (float)(sine * sin(turn))}, {.f = (float)cosine}}};
}

static bool source(void *user_data, const struct ir_graph *graph, ir_ref ref, struct ir_value *out)
{
    const struct run *run = user_data;
    const struct shader *shader = &run->generation->result->shader;
    const struct ir_node *node = ir_get(graph, ref);
    if (node->op != IR_UNIFORM && node->op != IR_STREAM)
        return false;
    const struct shader_variable *variable = &shader->interface.variables.items[node->attr];
    const char *name = str_text(shader->strings, variable->name);
    *out = variable->value;
    if (strcmp(name, "viewWorld") == 0 || strcmp(name, "u_viewPosition") == 0)
        *out = direction(run->view, run->view_turn);
    else if (strcmp(name, "lightWorld") == 0)
        *out = direction(run->light, run->light_turn);
    else if (strcmp(name, "positionWorld") == 0)
        *out = (struct ir_value){IR_TYPE_VEC3, {{.f = 0.0f}}};
    else if (strcmp(name, "normalWorld") == 0)
        *out = direction(1.0, 0.0);
    else if (strcmp(name, "tangentWorld") == 0)
        *out = direction(0.0, 0.0);
    if (variable->type == IR_TYPE_VEC4)
        out->type = IR_TYPE_VEC4;
    return out->type == variable->type;
}

static uint32_t call(void *user_data, const struct ir_graph *graph, ir_ref ref,
                     const struct ir_value *args, struct ir_value *out)
{
    struct run *run = user_data;
    return lang_eval_node(&run->generation->result->unit, graph, ref, args,
                          &(uint32_t){LANG_MAX_STEPS}, &run->generation->scratch, out);
}

/* The red channel; NAN after a failure. */
static double value_of(struct run *run, ir_ref ref)
{
    const struct ir_eval_env env = {.user_data = run, .source = source, .call = call};
    struct ir_value value;
    bool good =
        ir_eval(&run->generation->result->graph, ref, &env, &run->generation->scratch, &value);
    return REQUIRE(good) ? (double)value.w[0].f : (double)NAN;
}

/* ---- Generation up to the lobes ---- */

static void steps(struct generation *generation)
{
    struct run *run = generation->user_data;
    run->generation = generation;
    if (!generation_start(generation) || !generation_build(generation))
        return;
    generation->role = generation->result->shader.role =
        &roles[ROLE_scatter]; /* the view is a stream */
    generation_start_closures(generation);
    generation->role = generation->result->shader.role = &roles[run->role];
    generation_walk_slabs(generation);
    run->look(run);
}

static void generate(struct run *run, const struct stack *stack, void (*look)(struct run *),
                     void *wanted)
{
    static char text[STACK_TEXT];
    mxg_document *document = NULL;
    mxg_result *result = NULL;
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "glsl";
    desc.options = run->options;
    run->look = look;
    run->wanted = wanted;
    stack_write(stack, text);
    REQUIRE(
        mxg_document_parse(run->context, run->library, "stack.mtlx", text, strlen(text), &document)
        == MXG_OK);
    REQUIRE(generation_run(run->context, document, &desc, steps, run, &result) == MXG_OK);
    mxg_result_destroy(result);
    mxg_document_destroy(document);
}

static struct closure_list lobes_of(struct run *run)
{
    struct generation *g = run->generation;
    struct closure_list list;
    ir_ref surface = g->root;
    REQUIRE(ir_get(&g->result->graph, surface)->op == IR_SURFACE_SHADER);
    closure_flatten(&g->result->shader, &g->closure_host, ir_arg(&g->result->graph, surface, 0),
                    &list);
    return list;
}

/* ---- Weights of the base below clear media ---- */

struct weights {
    double way, got;
};

/* The base is the first lobe that reflects evenly. */
static void weigh_base(struct run *run)
{
    struct weights *w = run->wanted;
    struct generation *g = run->generation;
    struct closure_list list = lobes_of(run);
    struct ir_graph *graph = &g->result->graph;
    for (uint32_t i = 0; i < list.leaves.len; i++) {
        ir_ref leaf = list.leaves.items[i].leaf;
        ir_ref albedo = closure_call(&g->result->shader, &g->closure_host, leaf, LEAF_ALBEDO, NULL);
        if (value_of(run, albedo) < 0.99)
            continue;
        ir_ref way = ir_const_float(graph, (float)w->way);
        w->got = value_of(run, closure_weight(&g->result->shader, &list.leaves.items[i], way));
        return;
    }
    REQUIRE(false); /* the base is in the list */
}

static double weight_error(struct run *run, const struct stack *stack, double view, double way)
{
    struct weights w = {.way = way};
    run->view = view;
    generate(run, stack, weigh_base, &w);
    double exact = stack_throughput(stack, stack->num_nodes - 1, 0.01, stack_way(view) + way);
    return fabs(w.got - exact);
}

/* Statements fix the order of the random numbers, which C leaves open for arguments. */
static double random_weight_error(struct run *run, const struct stack *stack)
{
    double way = stack_between(1.0, 1.342), cosine = stack_between(0.05, 1.0);
    return weight_error(run, stack, cosine, way);
}

static void test_one_top(struct run *run)
{
    double worst[2] = {0.0};
    for (int i = 0; i < 20; ++i) {
        struct stack stack;
        stack_make(&stack, 1, 1, 1.0);
        double error = random_weight_error(run, &stack);
        /* a mix of two media is a sum of two powers; other tops are exact */
        bool is_mix = stack.nodes[stack.nodes[stack.num_nodes - 1].a].kind == STACK_MIX;
        worst[is_mix] = fmax(worst[is_mix], error);
    }
    printf("weights below one top: within %.7f, of two media within %.5f\n", worst[0], worst[1]);
    REQUIRE(worst[0] < 2e-6 && worst[1] > 0.0 && worst[1] < 0.00054);
}

static void test_many_tops(struct run *run)
{
    double worst = 0.0;
    for (int i = 0; i < 60; ++i) {
        struct stack stack;
        stack_make(&stack, 2 + i % 4, 1, 1.0);
        worst = fmax(worst, random_weight_error(run, &stack));
    }
    printf("weights below 2 to 5 tops: within %.5f\n", worst);
    REQUIRE(worst < 0.00067);
}

/* ---- Light that stacks reflect ---- */

struct reflected {
    double whole;  /* by the walk */
    double plain;  /* without the way in, as a layer */
    double both;   /* by the product of two one-way throughputs */
    double passed; /* light that shines through to the viewer */
};

static void reflect(struct run *run)
{
    struct reflected *out = run->wanted;
    struct generation *g = run->generation;
    struct shader *shader = &g->result->shader;
    struct ir_graph *graph = &g->result->graph;
    struct closure_list list = lobes_of(run);
    *out = (struct reflected){.whole = 0.0};
    ir_ref mean = ir_const_float(graph, CLOSURE_MEAN_WAY), rest = ir_const_float(graph, 0.0f);
    for (uint32_t i = 0; i < list.leaves.len; i++) {
        const struct closure_leaf *leaf = &list.leaves.items[i];
        ir_ref albedo = closure_call(shader, &g->closure_host, leaf->leaf, LEAF_ALBEDO, NULL);
        double reflects = value_of(run, albedo),
               once = value_of(run, closure_weight(shader, leaf, rest));
        bool is_diffuse = closure_has(shader, &g->closure_host, leaf->leaf, LEAF_WAY);
        ir_ref way = is_diffuse ? mean : ir_const_float(graph, (float)stack_way(run->view));
        out->whole += reflects * value_of(run, closure_weight(shader, leaf, way));
        out->plain += reflects * once;
        out->both += reflects * once * once;
    }
    out->passed = value_of(run, ir_arg(graph, g->root, 2));
}

static struct reflected reflected_by(struct run *run, const struct stack *stack, double view)
{
    struct reflected result;
    run->view = view;
    generate(run, stack, reflect, &result);
    return result;
}

enum { WALK, PLAIN, BOTH, OPENPBR, NUM_MODELS };

static void begin_page(FILE *page)
{
    fputs("# Stacks against a random walk\n\n"
          "`build/tests/unit_slabs docs/slabs/stacks.md` writes this page; "
          "[slabs.md](../slabs.md#measured) explains it. `layer(x, y)` is x\n"
          "over y, 0.01 cm thick; `mix(m, x, y)` has the share m of x; `cover(c, x)` is there with "
          "the probability c; `slab(a, d)` has the\n"
          "albedo a and the optical depth d along the normal, and `slab(a)` is opaque. The truth "
          "is the share of light that returns to a\n"
          "viewer at the cosine; the other columns are what a model adds to it.\n\n"
          "| stack | cosine | truth | walk | without the way in | two throughputs | OpenPBR |\n"
          "| --- | --- | --- | --- | --- | --- | --- |\n",
          page);
}

static void write_row(FILE *page, const struct stack *stack, double view, double truth,
                      const double *error)
{
    fputs("| `", page);
    stack_print(stack, stack->num_nodes - 1, 0.01, page);
    fprintf(page, "` | %.2f | %.3f |", view, truth);
    for (int k = 0; k < NUM_MODELS; ++k)
        fprintf(page, " %+.3f |", error[k]);
    fputs("\n", page);
}

/* The walk is nearer to the truth than a layer in all stacks. */
static void test_truth(struct run *run)
{
    unsigned nearer_plain = 0, nearer_both = 0, nearer_openpbr = 0;
    double sum[NUM_MODELS] = {0.0}, worst = 0.0;
    for (int i = 0; i < NUM_STACKS; ++i) {
        struct stack stack;
        stack_make(&stack, 1 + i % 4, i % 3 == 0, stack_between(0.2, 1.0));
        double view = stack_between(0.1, 1.0), truth = stack_walk(&stack, view, NUM_PATHS).back;
        struct reflected got = reflected_by(run, &stack, view);
        double openpbr = stack_openpbr(&stack, stack.num_nodes - 1, 0.01,
                                       stack_way(view) + CLOSURE_MEAN_WAY, 0.0);
        double error[NUM_MODELS] = {got.whole - truth, got.plain - truth, got.both - truth,
                                    openpbr - truth};
        if (run->page)
            write_row(run->page, &stack, view, truth, error);
        for (int k = 0; k < NUM_MODELS; ++k)
            error[k] = fabs(error[k]);
        nearer_plain += error[WALK] < error[PLAIN];
        nearer_both += error[WALK] < error[BOTH];
        nearer_openpbr += error[WALK] < error[OPENPBR];
        for (int k = 0; k < NUM_MODELS; ++k)
            sum[k] += error[k] / NUM_STACKS;
        worst = fmax(worst, error[WALK]);
    }
    printf("%d stacks against a random walk: mean error %.4f, worst %.4f; without the way in %.4f; "
           "two one-way throughputs %.4f; OpenPBR %.4f\n",
           NUM_STACKS, sum[WALK], worst, sum[PLAIN], sum[BOTH], sum[OPENPBR]);
    printf(
        "nearer than without the way in: %u, than two one-way throughputs: %u, than OpenPBR: %u\n",
        nearer_plain, nearer_both, nearer_openpbr);
    REQUIRE_EQ(nearer_plain, NUM_STACKS);
    REQUIRE(nearer_both >= 164);    /* of 172: the same where all slabs are always there */
    REQUIRE(nearer_openpbr >= 156); /* of 166: it is exact where nothing scatters */
    REQUIRE(sum[WALK] < 0.0054 && worst < 0.04);
}

/* The light that white matter reflects: partly there, thin, rough. */
static void measure_furnace(struct run *run, double most_f0, double *least, double *most)
{
    *least = *most = 1.0;
    for (int i = 0; i < 40; ++i) {
        struct stack stack;
        stack_make(&stack, i % 5, 0, 1.0);
        for (int k = 0; k < stack.num_nodes; ++k) {
            stack.nodes[k].albedo = 1.0;
            stack_random_interface(&stack.nodes[k], most_f0);
        }
        double whole = reflected_by(run, &stack, stack_between(0.05, 1.0)).whole;
        *least = fmin(*least, whole);
        *most = fmax(*most, whole);
    }
}

/* White matter reflects all light. */
static void test_furnace(struct run *run)
{
    double least, most;
    measure_furnace(run, 0.0, &least, &most);
    printf("white stacks in a furnace: %.4f to %.7f\n", least, most);
    REQUIRE(least > 0.9976 && most < 1.00001);
    measure_furnace(run, 0.9, &least, &most);
    printf("with interfaces: %.4f to %.7f\n", least, most);
    REQUIRE(least > 0.9993 && most < 1.00001);
}

/* No stack sends back more light than it gets, whatever its matter is. */
static void test_energy(struct run *run)
{
    double most = 0.0;
    for (int i = 0; i < 100; ++i) {
        struct stack stack;
        stack_make(&stack, i % 5, i % 3 == 0, stack_random());
        for (int k = 0; k < stack.num_nodes; ++k)
            stack_random_interface(&stack.nodes[k], 1.0);
        most = fmax(most, reflected_by(run, &stack, stack_between(0.05, 1.0)).whole);
    }
    printf("100 stacks in a furnace: at most %.4f\n", most);
    REQUIRE(most <= 1.0);
}

/* A sheet that absorbs nothing loses no light: all of it comes back or shines through. */
static double worst_sheet(struct run *run, int num_layers)
{
    double worst = 0.0;
    for (int i = 0; i < 40; ++i) {
        struct stack stack;
        stack_make_sheet(&stack, num_layers);
        for (int k = 0; k < stack.num_nodes; ++k) {
            stack.nodes[k].albedo = 1.0;
            stack.nodes[k].f0 = i % 2 ? stack_between(0.0, 0.9) : 0.0;
            stack.nodes[k].roughness = stack_random();
        }
        struct reflected got = reflected_by(run, &stack, stack_between(0.05, 1.0));
        REQUIRE(got.whole > 0.01 && (run->role == ROLE_raster || got.passed > 0.01));
        worst = fmax(worst, fabs(got.whole + got.passed - 1.0));
    }
    return worst;
}

static void test_sheets(struct run *run)
{
    double one = worst_sheet(run, 1), two = worst_sheet(run, 2);
    printf("white sheets, of one slab within %.7f, of two within %.6f\n", one, two);
    REQUIRE(one < 1e-6); /* rounding alone */
    REQUIRE(two < 2.5e-4);
}

/* ---- Light from single directions ---- */

/* The part that the lobes send of the light from `run->light`, times its cosine. */
static ir_ref response_of(struct run *run)
{
    struct generation *g = run->generation;
    struct shader *shader = &g->result->shader;
    struct ir_graph *graph = &g->result->graph;
    struct closure_list list = lobes_of(run);
    ir_ref light = shader_stream(shader, STR_lightWorld, IR_TYPE_VEC4), parts[3];
    for (unsigned i = 0; i < 3; i++)
        parts[i] = ir_component(graph, light, i);
    ir_ref to_light = ir_construct(graph, IR_TYPE_VEC3, parts, 3),
           sum = ir_const_splat(graph, IR_TYPE_VEC3, 0.0f);
    ir_ref way = closure_way(shader, &g->closure_host, to_light);
    for (uint32_t i = 0; i < list.leaves.len; i++) {
        const struct closure_leaf *leaf = &list.leaves.items[i];
        ir_ref value = closure_call(shader, &g->closure_host, leaf->leaf, LEAF_EVAL, &to_light);
        value = ir_op2(graph, IR_MUL, value, closure_weight(shader, leaf, way));
        sum = ir_op2(graph, IR_ADD, sum, value);
    }
    return sum;
}

/* The integral of the response over light, by midpoints in the square of the cosine and the turn.
 */
static void integrate(struct run *run)
{
    const int along = 24 * run->fineness, around = 16 * (1 + run->fineness);
    ir_ref sum = response_of(run);
    double total = 0.0;
    for (int i = 0; i < along; ++i)
        for (int j = 0; j < around; ++j) {
            run->light = sqrt((i + 0.5) / along);
            run->light_turn = 2.0 * 3.14159265358979 * (j + 0.5) / around;
            total += value_of(run, sum) / run->light; /* d omega = d(cos^2) d turn / (2 cos) */
        }
    *(double *)run->wanted = total * 3.14159265358979 / (along * around);
}

static void test_lights(struct run *run)
{
    double worst = 0.0;
    for (int i = 0; i < 6; ++i) {
        struct stack stack;
        stack_make(&stack, i % 4, i % 2, 1.0);
        for (int k = 0; k < stack.num_nodes; ++k) {
            stack.nodes[k].f0 = i % 3 ? 0.1 : 0.0;
            stack.nodes[k].roughness = 0.8;
        }
        double total, view = stack_between(0.3, 1.0);
        double even = reflected_by(run, &stack, view).whole;
        run->view = view;
        generate(run, &stack, integrate, &total);
        worst = fmax(worst, fabs(total - even));
    }
    printf("light by light against even light: within %.4f\n", worst);
    REQUIRE(worst < 0.0052);
}

/* ---- White metal in a furnace ---- */

/* Metal of two lobes: the least and the most that returns of even light, over all views. */
struct furnace {
    struct facets lobes[2];
    double least, most;
};

/*
 * The share that the response has of each lobe's single reflections follows from two lights: that
 * of the mirror, and another. The shares times the integrals of these reflections are all the
 * light.
 */
static double returned(struct run *run, const struct furnace *furnace, ir_ref response)
{
    const double cosines[] = {run->view, 0.4},
                 turns[] = {run->view_turn + pi, run->view_turn + 1.0};
    struct vector v = vector_to(run->view, run->view_turn);
    double once[2][2], all[2];
    for (int i = 0; i < 2; ++i) {
        run->light = cosines[i];
        run->light_turn = turns[i];
        all[i] = value_of(run, response);
        for (int k = 0; k < 2; ++k)
            once[i][k] = reflected_once(furnace->lobes[k], v, vector_to(cosines[i], turns[i]));
    }
    double all_by_two = once[0][0] * once[1][1] - once[0][1] * once[1][0],
           first = (all[0] * once[1][1] - all[1] * once[0][1]) / all_by_two,
           second = (all[1] * once[0][0] - all[0] * once[1][0]) / all_by_two;
    return first * returned_once(furnace->lobes[0], v)
           + second * returned_once(furnace->lobes[1], v);
}

static void heat(struct run *run)
{
    struct furnace *furnace = run->wanted;
    ir_ref response = response_of(run);
    static const double cosines[] = {0.1, 0.2, 0.4, 0.7, 1.0};
    for (int i = 0; i < 4 * 5; ++i) {
        run->view = cosines[i / 4];
        run->view_turn = 0.5 * pi * (i % 4) / 3;
        double whole = returned(run, furnace, response);
        furnace->least = fmin(furnace->least, whole);
        furnace->most = fmax(furnace->most, whole);
    }
    run->view_turn = 0.0;
}

/* White metal returns all light, whatever its roughness, anisotropy and haze are. */
static void test_metal(struct run *run, const char *role)
{
    double least = 1.0, most = 1.0;
    REQUIRE(mxg_options_set(run->options, "role", role) == MXG_OK);
    for (int i = 0; i < 5 * 7 * 3; ++i) {
        struct stack stack = {.num_nodes = 1};
        struct stack_node *node = &stack.nodes[0];
        *node = (struct stack_node){.kind = STACK_SLAB,
                                    .f0 = 1.0,
                                    .roughness = 0.2 + 0.2 * (i % 5),
                                    .anisotropy = 0.3 * (i / 5 % 7 - 3),
                                    .second_roughness = 0.7,
                                    .second_weight = 0.5 * (i / 35)};
        struct furnace furnace = {{facets_of(node->roughness, node->anisotropy),
                                   facets_of(node->second_roughness, node->anisotropy)},
                                  1.0,
                                  1.0};
        generate(run, &stack, heat, &furnace);
        least = fmin(least, furnace.least);
        most = fmax(most, furnace.most);
    }
    printf("white metal in a furnace, %s: %.4f to %.4f\n", role, least, most);
    REQUIRE(least > 0.995 && most < 1.005);
}

/*
 * White matter below an interface returns all light at the edge of the fits, too: by its lobes in
 * each direction of the light.
 */
static void test_white(struct run *run)
{
    static const double roughnesses[] = {0.9, 1.0}, views[] = {0.1, 0.2, 0.5, 1.0};
    double least = 1.0, most = 1.0;
    run->fineness = 4;
    for (int i = 0; i < 2 * 4; ++i) {
        struct stack stack = {.num_nodes = 1};
        double whole = 0.0;
        stack.nodes[0] = (struct stack_node){
            .kind = STACK_SLAB, .albedo = 1.0, .f0 = 0.04, .roughness = roughnesses[i / 4]};
        run->view = views[i % 4];
        generate(run, &stack, integrate, &whole);
        least = fmin(least, whole);
        most = fmax(most, whole);
    }
    run->fineness = 1;
    printf("white dielectrics in a furnace: %.4f to %.4f\n", least, most);
    REQUIRE(least > 0.995 && most < 1.005);
}

/* ---- Mirrors below white media ---- */

/* Sums what the interfaces reflect. */
static void look_at_mirrors(struct run *run)
{
    struct generation *g = run->generation;
    struct shader *shader = &g->result->shader;
    struct closure_list list = lobes_of(run);
    double *out = run->wanted;
    *out = 0.0;
    for (uint32_t i = 0; i < list.leaves.len; i++) {
        ir_ref leaf = list.leaves.items[i].leaf;
        if (!closure_has(shader, &g->closure_host, leaf, LEAF_WAY))
            *out += value_of(run, closure_call(shader, &g->closure_host, leaf, LEAF_ALBEDO, NULL));
    }
}

/* The share of the light from a mirror below a white medium that went straight both ways. */
static void test_mirrors(struct run *run)
{
    static const double depths[] = {0.1, 0.2, 0.5, 1.0}, f0s[] = {0.5, 0.8, 1.0};
    double worst = 0.0;
    REQUIRE(mxg_options_set(run->options, "role", "raster") == MXG_OK);
    for (int i = 0; i < 4 * 3; ++i) {
        double depth = depths[i % 4], f0 = f0s[i / 4], mirrored;
        struct stack stack = {.num_nodes = 3};
        stack.nodes[0] = (struct stack_node){.kind = STACK_SLAB, .f0 = f0, .roughness = 0.1};
        stack.nodes[1] =
            (struct stack_node){.kind = STACK_SLAB, .albedo = 1.0, .mfp = 0.01 / depth};
        stack.nodes[2] =
            (struct stack_node){.kind = STACK_LAYER, .a = 1, .b = 0, .thickness = 0.01};
        run->view = 1.0;
        generate(run, &stack, look_at_mirrors, &mirrored);
        double truth = stack_straight_share(depth, f0, 4 * NUM_PATHS);
        worst = fmax(worst, fabs(mirrored / f0 - truth));
    }
    printf("light of mirrors below white media that went straight: within %.4f\n", worst);
    REQUIRE(worst < 0.05);
}

/* ---- Light from behind sheets ---- */

struct behind {
    double scattered, straight;
    bool is_opaque;
};

/* The lobe of the light from behind is the only one that lets nothing through. */
static void look_behind(struct run *run)
{
    struct behind *out = run->wanted;
    struct generation *g = run->generation;
    struct shader *shader = &g->result->shader;
    ir_ref through = ir_arg(&g->result->graph, g->root, 2);
    struct closure_list list = lobes_of(run);
    *out = (struct behind){.straight = value_of(run, through),
                           .is_opaque = ir_const_is(&g->result->graph, through, 0.0f)};
    for (uint32_t i = 0; i < list.leaves.len; i++) {
        ir_ref leaf = list.leaves.items[i].leaf;
        if (closure_has(shader, &g->closure_host, leaf, LEAF_THROUGHPUT))
            continue;
        ir_ref albedo = closure_call(shader, &g->closure_host, leaf, LEAF_ALBEDO, NULL),
               weight = closure_weight(shader, &list.leaves.items[i],
                                       ir_const_float(&g->result->graph, 0.0f));
        out->scattered += value_of(run, albedo) * value_of(run, weight);
    }
}

/* A raster has as much of the light behind a sheet as a random walk brings to the viewer. */
static void test_backlight(struct run *run)
{
    enum { NUM_SHEETS = 60 };
    double sum = 0.0, worst = 0.0, worst_straight = 0.0;
    for (int i = 0; i < NUM_SHEETS; ++i) {
        struct stack stack;
        struct behind got;
        stack_make_sheet(&stack, 1 + i % 2);
        run->view = stack_between(0.1, 1.0);
        struct stack_light truth = stack_walk(&stack, run->view, NUM_PATHS);
        generate(run, &stack, look_behind, &got);
        double error = fabs(got.scattered - truth.through);
        sum += error;
        worst = fmax(worst, error);
        worst_straight = fmax(worst_straight, fabs(got.straight - truth.straight));
    }
    printf("light from behind sheets: scattered mean error %.4f, worst %.4f; straight %.4f\n",
           sum / NUM_SHEETS, worst, worst_straight);
    REQUIRE(sum / NUM_SHEETS < 0.007 && worst < 0.03);
    REQUIRE(worst_straight < 0.01); /* the noise of the random walk */
}

/* Nothing is seen through a sheet of eight mean free paths, but light shines through it. */
static void test_deep_sheet(struct run *run)
{
    struct behind got;
    struct stack deep = {.num_nodes = 1, .is_sheet = 1};
    deep.nodes[0] = (struct stack_node){.kind = STACK_SLAB, .albedo = 1.0, .mfp = 0.01 / 8.0};
    run->view = 0.7;
    REQUIRE(mxg_options_set(run->options, "interface", "reduced") == MXG_OK);
    generate(run, &deep, look_behind, &got);
    REQUIRE(mxg_options_set(run->options, "interface", "complete") == MXG_OK);
    REQUIRE(got.is_opaque && got.scattered > 0.1);
}

/* Argument: the page to write. */
int main(int argc, char **argv)
{
    struct run run = {
        .page = argc > 1 ? fopen(argv[1], "w") : NULL, .role = ROLE_scatter, .fineness = 1};
    if (run.page)
        begin_page(run.page);
    REQUIRE(mxg_context_create(NULL, &run.context) == MXG_OK);
    run.library = mxg_library_builtin(run.context);
    REQUIRE(run.library != NULL);
    REQUIRE(mxg_options_create(run.context, &run.options) == MXG_OK
            && mxg_options_set(run.options, "role", "scatter") == MXG_OK);
    test_one_top(&run);
    test_many_tops(&run);
    test_truth(&run);
    test_furnace(&run);
    test_energy(&run);
    test_sheets(&run);
    run.role = ROLE_raster;
    test_sheets(&run);
    test_backlight(&run);
    test_deep_sheet(&run);
    run.role = ROLE_scatter;
    test_lights(&run);
    test_metal(&run, "scatter");
    test_metal(&run, "raster");
    test_white(&run);
    run.role = ROLE_raster;
    test_mirrors(&run);
    mxg_options_destroy(run.options);
    mxg_library_unref(run.library);
    mxg_context_destroy(run.context);
    REQUIRE(argc == 1 || (run.page && fclose(run.page) == 0));
    return test_report("slabs");
}
