// SPDX-License-Identifier: Apache-2.0
/*
 * The closure room: the weights of flattened trees, by hand from the algebra in closure/flatten.c,
 * and what roots of each type become. Every tree is flattened twice: with constant weights, which
 * fold, and with uniforms of the same values, which do not.
 */
#include "closure/closure_priv.h"

#include "shader_fixture.h"
#include "test.h"

#include <math.h>

/* ---- Leaves: functions by family, as a library has them ---- */

static const char source[] =
    "vec3 matte_eval(float shade, vec3 L) { return vec3(shade * L.z); }\n"
    "vec3 glass_eval(float clear, vec3 L) { return vec3(clear * L.z); }\n"
    "vec3 glass_throughput(float clear, vec3 V) { return vec3(clear * V.z); }\n"
    "vec3 film_factor(float tint) { return vec3(tint, tint, 1.0); }\n"
    "vec3 glow_emission(float strength) { return vec3(strength, 2.0 * strength, 0.0); }\n"
    "vec3 fog_absorption(float density) { return vec3(density); }\n"
    "vec3 fog_scattering(float density) { return vec3(0.0); }\n";

enum family_id { MATTE, GLASS, FILM, GLOW, FOG, NUM_FAMILIES };

static const struct {
    const char *name;
    ir_type_id type;
} families[NUM_FAMILIES] = {
    [MATTE] = {"matte", IR_TYPE_BSDF}, [GLASS] = {"glass", IR_TYPE_BSDF},
    [FILM] = {"film", IR_TYPE_BSDF},   [GLOW] = {"glow", IR_TYPE_EDF},
    [FOG] = {"fog", IR_TYPE_VDF},
};
static const struct {
    enum leaf_function which;
    const char *suffix;
} members[] = {
    {LEAF_EVAL, "eval"},         {LEAF_THROUGHPUT, "throughput"}, {LEAF_FACTOR, "factor"},
    {LEAF_EMISSION, "emission"}, {LEAF_ABSORPTION, "absorption"}, {LEAF_SCATTERING, "scattering"}};

struct scene {
    struct fixture base;
    uint32_t functions[NUM_FAMILIES][NUM_LEAF_FUNCTIONS];
    uint32_t callees[NUM_FAMILIES];
    struct lang_host lang;
    struct closure_point point;
    struct closure_host host;
    bool variable;     /* numbers are uniforms */
    VEC(float) values; /* of the uniforms */
};

static const uint32_t *leaf_functions(void *user_data, uint32_t callee)
{
    struct scene *s = user_data;
    unsigned family = 0;
    while (s->callees[family] != callee)
        family++;
    return s->functions[family];
}

static ir_ref vec3(struct scene *s, float x, float y, float z)
{
    struct ir_value v = {IR_TYPE_VEC3, {{.f = x}, {.f = y}, {.f = z}}};
    return ir_const(&s->base.graph, &v);
}

static void scene_open(struct scene *s, bool variable)
{
    struct fixture *f = &s->base;
    memset(s, 0, sizeof *s);
    fixture_open(f, source);
    for (unsigned i = 0; i < NUM_FAMILIES; i++) {
        for (unsigned k = 0; k < NUM_LEAF_FUNCTIONS; k++)
            s->functions[i][k] = LANG_NONE;
        for (size_t k = 0; k < sizeof members / sizeof *members; k++) {
            char name[64];
            snprintf(name, sizeof name, "%s_%s", families[i].name, members[k].suffix);
            s->functions[i][members[k].which] = function(f, name);
        }
        s->callees[i] =
            ir_add_callee(&f->graph, (struct ir_callee){.kind = IR_CALLEE_FAMILY,
                                                        .index = i + 1,
                                                        .name = word(f, families[i].name)});
    }
    s->lang.max_inline_nodes = 1000;
    s->point = (struct closure_point){vec3(s, 0, 0, 0), vec3(s, 0, 0, 1), vec3(s, 0, 0, 1)};
    s->host = (struct closure_host){
        .user_data = s, .point = &s->point, .leaf_functions = leaf_functions, .lang = &s->lang};
    s->variable = variable;
}

static void scene_close(struct scene *s)
{
    ir_ref at = 0;
    const char *fault = ir_check(&s->base.graph, &at);
    if (!REQUIRE(!fault))
        printf("    node %u: %s\n", at, fault);
    fixture_close(&s->base);
}

/* ---- Trees ---- */

static ir_ref num(struct scene *s, float value)
{
    char name[32];
    if (!s->variable)
        return number(&s->base, value);
    snprintf(name, sizeof name, "u%u", s->values.len);
    ir_ref ref = uniform(&s->base, name, IR_TYPE_FLOAT);
    vec_push(&s->base.arena, &s->values, value);
    return ref;
}

/* `base`: of a film, which modifies it; else 0. */
static ir_ref leaf_over(struct scene *s, enum family_id family, float weight, float input,
                        ir_ref base)
{
    ir_ref args[3] = {num(s, weight), number(&s->base, input), base};
    return ir_build(&s->base.graph, IR_LEAF, families[family].type, s->callees[family], args,
                    family == FILM ? 3 : 2);
}
static ir_ref leaf(struct scene *s, enum family_id family, float weight, float input)
{
    return leaf_over(s, family, weight, input, 0);
}
static ir_ref tree(struct scene *s, enum ir_op op, ir_ref a, ir_ref b, ir_ref c)
{
    ir_ref args[3] = {a, b, c};
    return ir_build(&s->base.graph, op, ir_type_of(&s->base.graph, a), 0, args, c ? 3 : 2);
}
static ir_ref layer(struct scene *s, ir_ref top, ir_ref base)
{
    return tree(s, IR_LAYER, top, base, 0);
}
static ir_ref mix(struct scene *s, ir_ref bg, ir_ref fg, float share)
{
    return tree(s, IR_CLOSURE_MIX, bg, fg, num(s, share));
}
static ir_ref add(struct scene *s, ir_ref a, ir_ref b)
{
    return tree(s, IR_CLOSURE_ADD, a, b, 0);
}
static ir_ref scale(struct scene *s, ir_ref a, ir_ref factor)
{
    return tree(s, IR_CLOSURE_SCALE, a, factor, 0);
}
static ir_ref color(struct scene *s, float x, float y, float z)
{
    ir_ref parts[3] = {num(s, x), num(s, y), num(s, z)};
    return ir_construct(&s->base.graph, IR_TYPE_VEC3, parts, 3);
}

/* ---- What comes of them ---- */

static bool value_of_uniform(void *user_data, const struct ir_graph *graph, ir_ref ref,
                             struct ir_value *out)
{
    const struct scene *s = user_data;
    const struct ir_node *node = ir_get(graph, ref);
    if (node->op != IR_UNIFORM || node->type != IR_TYPE_FLOAT || node->attr >= s->values.len)
        return false;
    *out = ir_value_float(s->values.items[node->attr]);
    return true;
}

static struct ir_value evaluate(struct scene *s, ir_ref ref)
{
    struct ir_value out = {0};
    struct ir_eval_env env = {.user_data = s, .source = value_of_uniform};
    REQUIRE(ir_eval(&s->base.graph, ref, &env, &s->base.arena, &out));
    return out;
}

/* "0.5" where all components are equal, else "0.5 0.25 0". */
static void write_value(struct text *out, const struct ir_value *v)
{
    unsigned n = ir_type_info(v->type)->components;
    bool is_grey = true;
    for (unsigned i = 1; i < n; i++)
        is_grey = is_grey && fabsf(v->w[i].f - v->w[0].f) < 1e-6f;
    for (unsigned i = 0; i < (is_grey ? 1 : n); i++)
        text_fmt(out, "%s%.6g", i ? " " : "", (double)v->w[i].f);
}

static ir_ref total(struct scene *s, const struct closure_leaf *leaf)
{
    ir_ref scalar = ir_convert(&s->base.graph, IR_TYPE_VEC3, leaf->scalar);
    return ir_product(&s->base.graph, leaf->color, scalar);
}

static bool is_zero(const struct ir_value *v)
{
    return v->w[0].f == 0 && v->w[1].f == 0 && v->w[2].f == 0;
}

/*
 * "matte 0.5" or "glass 1 behind 0.25": a leaf with its weight, and what comes through a volume.
 * NULL where the weight is 0, which the compiler may not know of uniforms.
 */
static const char *weighted(struct scene *s, const struct closure_leaf *leaf)
{
    const struct ir_graph *g = &s->base.graph;
    struct text out;
    text_init(&out, &s->base.arena);
    REQUIRE_EQ(ir_get(g, leaf->leaf)->op, IR_LEAF);
    REQUIRE(ir_const_is(g, ir_arg(g, leaf->leaf, 0), 1.0f));
    REQUIRE_EQ(ir_type_of(g, leaf->scalar), IR_TYPE_FLOAT);
    REQUIRE(!leaf->color || ir_type_of(g, leaf->color) == IR_TYPE_VEC3);
    struct ir_value weight = evaluate(s, total(s, leaf));
    if (s->variable && is_zero(&weight))
        return NULL;
    uint32_t callee = ir_get(g, leaf->leaf)->attr;
    text_fmt(&out, "%s ", str_text(&s->base.strings, g->callees.items[callee].name));
    write_value(&out, &weight);
    if (leaf->medium) {
        struct ir_value medium = evaluate(s, leaf->medium);
        text_str(&out, " behind ");
        write_value(&out, &medium);
    }
    return text_cstr(&out);
}

static int compare_texts(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* All leaves by their texts, since arguments of calls in C have no order. */
static const char *flattened(struct scene *s, ir_ref root)
{
    const char *texts[16];
    struct closure_list list;
    struct text out;
    size_t count = 0;
    text_init(&out, &s->base.arena);
    closure_flatten(&s->base.shader, &s->host, root, &list);
    for (uint32_t i = 0; i < list.leaves.len && REQUIRE(count < 16); i++)
        if ((texts[count] = weighted(s, &list.leaves.items[i])) != NULL)
            count++;
    qsort(texts, count, sizeof *texts, compare_texts);
    for (size_t i = 0; i < count; i++)
        text_fmt(&out, "%s%s", i ? ", " : "", texts[i]);
    return text_cstr(&out);
}

/* Requires the weights of a tree, which is an expression over the scene s. */
#define REQUIRE_WEIGHTS(expression, expected) \
    for (int variable_ = 0; variable_ < 2; variable_++) { \
        struct scene scene_, *s = &scene_; \
        scene_open(s, variable_ == 1); \
        ir_ref root_ = (expression); \
        REQUIRE_STR(flattened(s, root_), (expected)); \
        scene_close(s); \
    }

/* ---- Flattening ---- */

static void test_leaves(void)
{
    REQUIRE_WEIGHTS(0, "");
    REQUIRE_WEIGHTS(leaf(s, MATTE, 0.5f, 1), "matte 0.5");
    REQUIRE_WEIGHTS(leaf(s, MATTE, 0, 1), "");
    REQUIRE_WEIGHTS(leaf(s, GLOW, 3, 1), "glow 3");
}

static void test_layers(void)
{
    /* T = 0.25 */
    REQUIRE_WEIGHTS(layer(s, leaf(s, GLASS, 1, 0.25f), leaf(s, MATTE, 0.5f, 1)),
                    "glass 1, matte 0.125");
    /* T = 1 - 0.5 (1 - 0.25) = 0.625 */
    REQUIRE_WEIGHTS(layer(s, leaf(s, GLASS, 0.5f, 0.25f), leaf(s, MATTE, 1, 1)),
                    "glass 0.5, matte 0.625");
    /* without a throughput T = 1 - weight */
    REQUIRE_WEIGHTS(layer(s, leaf(s, MATTE, 0.75f, 2), leaf(s, GLASS, 1, 1)),
                    "glass 0.25, matte 0.75");
    REQUIRE_WEIGHTS(layer(s, leaf(s, MATTE, 1, 2), leaf(s, GLASS, 1, 1)), "matte 1");
    /* a top of weight 0 hides nothing */
    REQUIRE_WEIGHTS(layer(s, leaf(s, MATTE, 0, 2), leaf(s, GLASS, 1, 1)), "glass 1");
    /* three layers, in both orders of association: 0.5 · 0.25 = 0.125 */
    REQUIRE_WEIGHTS(
        layer(s, leaf(s, GLASS, 1, 0.5f), layer(s, leaf(s, GLASS, 1, 0.25f), leaf(s, MATTE, 1, 1))),
        "glass 0.5, glass 1, matte 0.125");
    REQUIRE_WEIGHTS(
        layer(s, layer(s, leaf(s, GLASS, 1, 0.5f), leaf(s, GLASS, 1, 0.25f)), leaf(s, MATTE, 1, 1)),
        "glass 0.5, glass 1, matte 0.125");
}

static void test_mixes(void)
{
    REQUIRE_WEIGHTS(mix(s, leaf(s, MATTE, 1, 1), leaf(s, GLASS, 1, 1), 0.25f),
                    "glass 0.25, matte 0.75");
    REQUIRE_WEIGHTS(mix(s, leaf(s, MATTE, 1, 1), leaf(s, GLASS, 1, 1), 0), "matte 1");
    REQUIRE_WEIGHTS(mix(s, leaf(s, MATTE, 1, 1), leaf(s, GLASS, 1, 1), 1), "glass 1");
    /* T = 0.75 · 0.5 + 0.25 · 0.25 = 0.4375 */
    REQUIRE_WEIGHTS(layer(s, mix(s, leaf(s, GLASS, 1, 0.5f), leaf(s, GLASS, 1, 0.25f), 0.25f),
                          leaf(s, MATTE, 1, 1)),
                    "glass 0.25, glass 0.75, matte 0.4375");
    /* weights of a mix of mixes multiply: 0.5 · 0.75, 0.5 · 0.25 */
    REQUIRE_WEIGHTS(mix(s, mix(s, leaf(s, MATTE, 1, 1), leaf(s, GLASS, 1, 1), 0.25f),
                        leaf(s, MATTE, 1, 2), 0.5f),
                    "glass 0.125, matte 0.375, matte 0.5");
}

static void test_sums(void)
{
    REQUIRE_WEIGHTS(add(s, leaf(s, MATTE, 0.5f, 1), leaf(s, GLASS, 0.25f, 1)),
                    "glass 0.25, matte 0.5");
    /* T = 1 - (0.25 + 0.5), and never less than 0 */
    REQUIRE_WEIGHTS(
        layer(s, add(s, leaf(s, GLASS, 1, 0.75f), leaf(s, GLASS, 1, 0.5f)), leaf(s, MATTE, 1, 1)),
        "glass 1, glass 1, matte 0.25");
    REQUIRE_WEIGHTS(
        layer(s, add(s, leaf(s, GLASS, 1, 0.25f), leaf(s, GLASS, 1, 0.5f)), leaf(s, MATTE, 1, 1)),
        "glass 1, glass 1");
}

static void test_scales(void)
{
    REQUIRE_WEIGHTS(scale(s, leaf(s, MATTE, 0.5f, 1), num(s, 0.5f)), "matte 0.25");
    REQUIRE_WEIGHTS(scale(s, leaf(s, MATTE, 0.5f, 1), color(s, 1, 0.5f, 0.25f)),
                    "matte 0.5 0.25 0.125");
    REQUIRE_WEIGHTS(scale(s, leaf(s, MATTE, 1, 1), color(s, 0, 0, 0)), "");
    REQUIRE_WEIGHTS(scale(s, leaf(s, GLOW, 1, 1), num(s, 2)), "glow 2");
    /* a scaled top hides as much as before */
    REQUIRE_WEIGHTS(
        layer(s, scale(s, leaf(s, GLASS, 1, 0.25f), num(s, 0.5f)), leaf(s, MATTE, 1, 1)),
        "glass 0.5, matte 0.25");
    /* colours of nested scales multiply */
    REQUIRE_WEIGHTS(
        scale(s, scale(s, leaf(s, MATTE, 1, 1), color(s, 1, 0.5f, 0.5f)), color(s, 0.5f, 1, 0.5f)),
        "matte 0.5 0.5 0.25");
}

/* Leaves with the same inputs are one, whatever the way to them. */
static void test_equal_leaves(void)
{
    REQUIRE_WEIGHTS(add(s, leaf(s, MATTE, 0.5f, 1), leaf(s, MATTE, 0.25f, 1)), "matte 0.75");
    REQUIRE_WEIGHTS(add(s, leaf(s, MATTE, 0.5f, 1), leaf(s, MATTE, 0.25f, 2)),
                    "matte 0.25, matte 0.5");
    REQUIRE_WEIGHTS(mix(s, leaf(s, MATTE, 1, 1), leaf(s, MATTE, 0.5f, 1), 0.5f), "matte 0.75");
    /* 0.5 (1, 0.5, 0.25) + 0.5 (0, 1, 0.25) */
    REQUIRE_WEIGHTS(add(s, scale(s, leaf(s, MATTE, 0.5f, 1), color(s, 1, 0.5f, 0.25f)),
                        scale(s, leaf(s, MATTE, 0.5f, 1), color(s, 0, 1, 0.25f))),
                    "matte 0.5 0.75 0.25");
}

/* A node that is used twice: its weights add up, as those of equal nodes do. */
static ir_ref twice(struct scene *s, ir_ref closure)
{
    return add(s, mix(s, closure, leaf(s, GLASS, 1, 1), 0.25f), scale(s, closure, num(s, 0.5f)));
}

static void test_shared_nodes(void)
{
    /* 0.75 + 0.5 */
    REQUIRE_WEIGHTS(twice(s, leaf(s, MATTE, 1, 1)), "glass 0.25, matte 1.25");
    /* 1.25 (0.5, 0.5, 1) */
    REQUIRE_WEIGHTS(twice(s, leaf_over(s, FILM, 1, 0.5f, leaf(s, MATTE, 1, 1))),
                    "glass 0.25, matte 0.625 0.625 1.25");
}

/* A film takes the place of its base, whose response it multiplies: (0.5, 0.5, 1). */
static void test_modifiers(void)
{
    REQUIRE_WEIGHTS(leaf_over(s, FILM, 1, 0.5f, leaf(s, MATTE, 0.5f, 1)), "matte 0.25 0.25 0.5");
    /* and hides as much as its base: T = 0.25 */
    REQUIRE_WEIGHTS(
        layer(s, leaf_over(s, FILM, 1, 0.5f, leaf(s, GLASS, 1, 0.25f)), leaf(s, MATTE, 1, 1)),
        "glass 0.5 0.5 1, matte 0.25");
}

/* A volume behind a surface colours the light that is refracted: exp(-density). */
static void test_volumes_behind(void)
{
    REQUIRE_WEIGHTS(layer(s, leaf(s, GLASS, 1, 0.25f), leaf(s, FOG, 1, 0.5f)),
                    "glass 1 behind 0.606531");
    REQUIRE_WEIGHTS(layer(s, leaf(s, GLASS, 1, 0.25f),
                          add(s, leaf(s, FOG, 0.5f, 0.5f), leaf(s, FOG, 1, 0.25f))),
                    "glass 1 behind 0.606531"); /* 0.5 · 0.5 + 0.25 */
    /* the same leaf with and without a volume are two */
    REQUIRE_WEIGHTS(add(s, layer(s, leaf(s, GLASS, 1, 0.25f), leaf(s, FOG, 1, 0.5f)),
                        leaf(s, GLASS, 0.5f, 0.25f)),
                    "glass 0.5, glass 1 behind 0.606531");
}

/* Light that a layer takes from on its way in, too: T(V) · T(L), where V.z = 1 and L.z = 0.5. */
static void test_way_in(void)
{
    for (int variable = 0; variable < 2; variable++) {
        struct scene s;
        scene_open(&s, variable == 1);
        ir_ref light = vec3(&s, 0, 0, 0.5f);
        s.host.way_in = &light;
        ir_ref root = layer(&s, leaf(&s, GLASS, 1, 0.5f), leaf(&s, MATTE, 1, 1));
        REQUIRE_STR(flattened(&s, root), "glass 1, matte 0.125"); /* 0.5 · 0.25 */
        REQUIRE(s.point.view == vec3(&s, 0, 0, 1));
        scene_close(&s);
    }
}

/* Nothing recurses: a tree is as deep as memory allows. */
static void test_depth(void)
{
    struct scene s;
    scene_open(&s, false);
    ir_ref matte = leaf(&s, MATTE, 1, 1), glass = leaf(&s, GLASS, 1, 1);
    ir_ref root = matte, share = uniform(&s.base, "share", IR_TYPE_FLOAT);
    for (int i = 0; i < 20000; i++)
        root = tree(&s, IR_CLOSURE_MIX, i % 2 ? glass : matte, root, share);
    struct closure_list list;
    closure_flatten(&s.base.shader, &s.host, root, &list);
    REQUIRE_EQ(list.leaves.len, 2);
    scene_close(&s);
}

/* ---- Roots ---- */

/* The value of the only output of the pixel stage. */
static const char *written(struct scene *s, ir_ref root)
{
    struct closure_lighting lighting = {0};
    struct text out;
    text_init(&out, &s->base.arena);
    const struct effect_list *effects = &s->base.shader.stages[STAGE_PIXEL].effects;
    if (!closure_emit(&s->base.shader, &s->host, &lighting, root))
        return "no meaning";
    for (uint32_t i = 0; i < effects->len; i++) {
        const struct effect *e = &effects->items[i];
        if (e->kind != EFFECT_OUTPUT)
            continue;
        REQUIRE_EQ(ir_type_of(&s->base.graph, e->value), IR_TYPE_VEC4);
        struct ir_value value = evaluate(s, e->value);
        text_str(&out, out.len ? ", " : "");
        write_value(&out, &value);
    }
    return text_cstr(&out);
}

#define REQUIRE_WRITTEN(expression, expected) \
    do { \
        struct scene scene_, *s = &scene_; \
        scene_open(s, false); \
        ir_ref root_ = (expression); \
        REQUIRE_STR(written(s, root_), (expected)); \
        scene_close(s); \
    } while (0)

static ir_ref swizzled(struct scene *s, unsigned count)
{
    static const uint8_t components[] = {0, 1, 2, 0};
    return ir_swizzle(&s->base.graph, color(s, 0.25f, 0.5f, 0.75f), components, count);
}

static ir_ref surface(struct scene *s, ir_ref bsdf, ir_ref edf, float opacity)
{
    ir_ref args[4] = {bsdf, edf, number(&s->base, opacity), ir_const_bool(&s->base.graph, false)};
    return ir_build(&s->base.graph, IR_SURFACE_SHADER, IR_TYPE_SURFACE, 0, args, 4);
}

static ir_ref unlit(struct scene *s, float transmitted, float opacity)
{
    ir_ref args[3] = {vec3(s, 1, 0.5f, 0), vec3(s, transmitted, transmitted, transmitted),
                      number(&s->base, opacity)};
    return ir_build(&s->base.graph, IR_SURFACE_UNLIT, IR_TYPE_SURFACE, 0, args, 3);
}

static ir_ref shader_mix(struct scene *s, ir_ref bg, ir_ref fg, float share)
{
    ir_ref args[3] = {bg, fg, number(&s->base, share)};
    return ir_build(&s->base.graph, IR_SHADER_MIX, IR_TYPE_SURFACE, 0, args, 3);
}

static void test_values(void)
{
    REQUIRE_WRITTEN(number(&s->base, 0.5f), "0.5 0.5 0.5 1");
    REQUIRE_WRITTEN(ir_const_bool(&s->base.graph, true), "1");
    REQUIRE_WRITTEN(ir_const_int(&s->base.graph, 3), "3 3 3 1");
    REQUIRE_WRITTEN(swizzled(s, 2), "0.25 0.5 0 1");
    REQUIRE_WRITTEN(swizzled(s, 3), "0.25 0.5 0.75 1");
    REQUIRE_WRITTEN(swizzled(s, 4), "0.25 0.5 0.75 0.25");
    REQUIRE_WRITTEN(ir_const_splat(&s->base.graph, IR_TYPE_MAT3, 1), "no meaning");
    REQUIRE_WRITTEN(ir_const_string(&s->base.graph, word(&s->base, "a")), "no meaning");
}

static void test_surfaces(void)
{
    REQUIRE_WRITTEN(0, "0 0 0 1"); /* black, and opaque */
    REQUIRE_WRITTEN(leaf(s, GLOW, 0.5f, 1), "0.5 1 0 1");
    REQUIRE_WRITTEN(surface(s, 0, leaf(s, GLOW, 1, 0.5f), 1), "0.5 1 0 1");
    /* colours are scaled by alpha */
    REQUIRE_WRITTEN(surface(s, 0, leaf(s, GLOW, 1, 0.5f), 0.5f), "0.25 0.5 0 0.5");
    /* alpha = opacity (1 - transmitted) */
    REQUIRE_WRITTEN(unlit(s, 0, 1), "1 0.5 0 1");
    REQUIRE_WRITTEN(unlit(s, 0, 0.5f), "0.5 0.25 0 0.5");
    REQUIRE_WRITTEN(unlit(s, 0.25f, 0.5f), "0.5 0.25 0 0.375");
    /* 0.75 (1, 0.5, 0) + 0.25 · 0.5 (1, 0.5, 0); 0.75 + 0.25 · 0.5 */
    REQUIRE_WRITTEN(shader_mix(s, unlit(s, 0, 1), unlit(s, 0, 0.5f), 0.25f),
                    "0.875 0.4375 0 0.875");
    /* what glows and what is unlit, each half: 0.5 (0.5, 1, 0) + 0.5 (1, 0.5, 0) */
    REQUIRE_WRITTEN(shader_mix(s, surface(s, 0, leaf(s, GLOW, 1, 0.5f), 1), unlit(s, 0, 1), 0.5f),
                    "0.75 0.75 0 1");
    /* without lights a BSDF is black */
    REQUIRE_WRITTEN(surface(s, leaf(s, MATTE, 1, 1), 0, 1), "0 0 0 1");
}

static void test_is_surface(void)
{
    struct scene s;
    scene_open(&s, false);
    const struct shader *shader = &s.base.shader;
    REQUIRE(closure_is_surface(shader, 0));
    REQUIRE(closure_is_surface(shader, leaf(&s, MATTE, 1, 1)));
    REQUIRE(closure_is_surface(shader, leaf(&s, GLOW, 1, 1)));
    REQUIRE(closure_is_surface(shader, surface(&s, 0, 0, 1)));
    REQUIRE(!closure_is_surface(shader, leaf(&s, FOG, 1, 1)));
    REQUIRE(!closure_is_surface(shader, num(&s, 1)));
    scene_close(&s);
}

static void test_description(void)
{
    struct scene s;
    struct text out;
    scene_open(&s, false);
    text_init(&out, &s.base.arena);
    name(&s.base, "coat");
    ir_ref top = leaf(&s, GLASS, 1, 0.25f);
    name(&s.base, "base");
    ir_ref bottom = leaf(&s, MATTE, 0.5f, 1);
    closure_describe(&s.base.shader, &s.host, mix(&s, top, bottom, 0.75f), &out);
    const char *text = text_cstr(&out);
    REQUIRE_STR(text, "bsdf\n"
                      "  coat                     glass                            weight 0.25\n"
                      "  base                     matte                            weight 0.375\n"
                      "edf\n");
    scene_close(&s);
}

/* ---- Parts ---- */

static enum shader_alpha alpha_of(struct scene *s, enum ir_op op, ir_ref a, ir_ref b)
{
    return closure_alpha(&s->base.shader, op2(&s->base, op, a, b));
}

static void test_alpha(void)
{
    struct scene s;
    scene_open(&s, true);
    ir_ref cut = op2(&s.base, IR_STEP, num(&s, 0.5f), num(&s, 0.25f)), smooth = num(&s, 0.5f);
    REQUIRE_EQ(closure_alpha(&s.base.shader, cut), ALPHA_MASK);
    REQUIRE_EQ(closure_alpha(&s.base.shader, smooth), ALPHA_BLEND);
    ir_ref other = op2(&s.base, IR_STEP, smooth, num(&s, 1));
    REQUIRE_EQ(alpha_of(&s, IR_MUL, cut, other), ALPHA_MASK);
    REQUIRE_EQ(alpha_of(&s, IR_MUL, cut, smooth), ALPHA_BLEND);
    REQUIRE_EQ(alpha_of(&s, IR_SUB, number(&s.base, 1), cut), ALPHA_MASK);
    REQUIRE_EQ(alpha_of(&s, IR_ADD, cut, other), ALPHA_BLEND); /* may be 2 */
    scene_close(&s);
}

/* Whatever the order of factors, the product is the same. */
static void test_product(void)
{
    struct scene s;
    scene_open(&s, true);
    struct ir_graph *g = &s.base.graph;
    ir_ref tint = color(&s, 0.5f, 0.25f, 1), shade = num(&s, 0.5f), weight = num(&s, 4);
    ir_ref value = ir_product(g, ir_product(g, tint, shade), color(&s, 2, 2, 3));
    struct ir_value product = evaluate(&s, closure_product(g, value, weight, NULL));
    REQUIRE(product.w[0].f == 2 && product.w[1].f == 1 && product.w[2].f == 6);
    ir_ref invariant = value;
    REQUIRE_EQ(closure_product(g, value, 0, &invariant), value);
    REQUIRE_EQ(invariant, 0);
    ir_ref light = ir_build(g, IR_CONTEXT, IR_TYPE_FLOAT, 0, NULL, 0);
    ir_ref lit = closure_product(g, ir_product(g, light, tint), weight, &invariant);
    REQUIRE_EQ(invariant, ir_product(g, tint, weight));
    REQUIRE_EQ(lit, ir_product(g, light, invariant));
    REQUIRE_EQ(ir_product(g, 0, tint), tint);
    REQUIRE_EQ(ir_product(g, tint, 0), tint);
    struct ir_value rest = evaluate(&s, ir_one_minus(g, tint));
    REQUIRE(rest.w[0].f == 0.5f && rest.w[1].f == 0.75f && rest.w[2].f == 0);
    scene_close(&s);
}

int main(void)
{
    test_leaves();
    test_layers();
    test_mixes();
    test_sums();
    test_scales();
    test_equal_leaves();
    test_shared_nodes();
    test_modifiers();
    test_volumes_behind();
    test_way_in();
    test_depth();
    test_values();
    test_surfaces();
    test_is_surface();
    test_description();
    test_alpha();
    test_product();
    return test_report("closure");
}
