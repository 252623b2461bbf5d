// SPDX-License-Identifier: Apache-2.0
/* The IR: builder, simplification, text form, marks, checker, evaluation, long chains. */
#include "base/trap.h"
#include "ir/ir.h"

#include "ir_text.h"
#include "test.h"

#include <stdlib.h>

struct fixture {
    struct mem mem;
    struct arena arena;
    struct strpool strings;
    struct ir_graph graph;
};

static void setup(struct fixture *f)
{
    mem_init(&f->mem, NULL, NULL);
    arena_init(&f->arena, &f->mem);
    strpool_init(&f->strings, &f->arena, NULL);
    ir_graph_init(&f->graph, &f->arena, &f->strings);
}

static void teardown(struct fixture *f)
{
    ir_ref node;
    const char *problem = ir_check(&f->graph, &node);
    if (problem)
        printf("node %u: %s\n", (unsigned)node, problem);
    REQUIRE(!problem);
    arena_finish(&f->arena);
    REQUIRE_EQ(f->mem.used, 0);
}

static const char *print(struct fixture *f, const ir_ref *roots, uint32_t num_roots)
{
    struct text text;
    text_init(&text, &f->arena);
    ir_print(&f->graph, roots, num_roots, &text);
    return text_cstr(&text);
}

/* Reads, prints: with folding, what the builder makes of the text. "": it is no IR. */
static const char *reprint(struct fixture *f, const char *text)
{
    ir_ref *roots;
    uint32_t num_roots;
    return ir_text_read(&f->graph, text, &roots, &num_roots) ? "" : print(f, roots, num_roots);
}

/* Sources that the cases of test_builder use. */
#define SOURCES \
    "%f = uniform float\n%g = uniform float @1\n%v = uniform vec3 @2\n%w = uniform vec3 @3\n" \
    "%b = uniform bool @4\n%i = uniform int @5\n%q = uniform vec4 @6\n%m = uniform mat3 @7\n" \
    "%u = uniform uint @8\n%j = uniform ivec2 @9\n%n = uniform mat4 @10\n%k = uniform vec2 @11\n"

/* Nodes, the last of which is %r; and a graph equal to what the builder makes of it. */
static const struct {
    const char *in, *out;
} builder_cases[] = {
    /* folding */
    {"%r = add float 1.0, 2.0", "return 3.0"},
    {"%r = add vec3 vec3(1.0, 2.0, 3.0), 0.5", "return vec3(1.5, 2.5, 3.5)"},
    /* infinities and NaN are values like others */
    {"%r = div float 1.0, 0.0", "return inf"},
    {"%r = div float 0.0, 0.0", "return nan#2143289344"},
    {"%r = sub float inf, inf", "return nan#2143289344"},
    {"%r = neg float nan#2143289344", "return nan#2143289344"},
    {"%r = convert int inf", "%r = convert int inf\nreturn %r"},
    {"%r = add float %f, -inf", "%r = sub float %f, inf\nreturn %r"},
    {"%r = add vec3 %v, -inf", "%r = sub vec3 %v, vec3(inf, inf, inf)\nreturn %r"},
    {"%r = sub vec2 %k, inf", "%r = sub vec2 %k, vec2(inf, inf)\nreturn %r"},
    {"%r = sub vec3 vec3(1.0, 0.5, 0.0), inf", "return vec3(-inf, -inf, -inf)"},
    {"%r = add vec3 %v, nan#2143289344",
     "%r = add vec3 %v, vec3(nan#2143289344, nan#2143289344, nan#2143289344)\nreturn %r"},
    {"%r = div vec3 %v, inf", "%r = div vec3 %v, vec3(inf, inf, inf)\nreturn %r"},
    {"%r = div int 1, 0", "%r = div int 1, 0\nreturn %r"},
    {"%r = lt bool 1.0, 2.0", "return true"},
    {"%r = eq bool \"clamp\", \"clamp\"", "return true"},
    {"%r = eq bool \"clamp\", \"mirror\"", "return false"},
    {"%r = log float 0.0", "%r = log float 0.0\nreturn %r"},
    /* commutative order: constants last, otherwise by age */
    {"%r = add float 2.0, %f", "%r = add float %f, 2.0\nreturn %r"},
    {"%r = add float %g, %f", "%r = add float %f, %g\nreturn %r"},
    {"%r = sub float %g, %f", "%r = sub float %g, %f\nreturn %r"},
    {"%r = mul vec3 %v, %m", "%r = mul vec3 %v, %m\nreturn %r"},
    {"%r = mul mat3 %m, 2.0", "%r = mul mat3 %m, 2.0\nreturn %r"},
    {"%r = mul mat3 2.0, %m", "%r = mul mat3 %m, 2.0\nreturn %r"},
    /* neutral elements, with the type kept */
    {"%r = mul float %f, 1.0", "return %f"},
    {"%r = mul vec3 %f, vec3(1.0, 1.0, 1.0)", "%r = construct vec3 %f\nreturn %r"},
    {"%r = mul vec3 %v, 1.0", "return %v"},
    {"%r = add vec3 %f, vec3(0.0, 0.0, 0.0)", "%r = construct vec3 %f\nreturn %r"},
    {"%r = mul vec3 %v, 0.0", "return vec3(0.0, 0.0, 0.0)"},
    {"%r = mul vec3 %m, vec3(0.0, 0.0, 0.0)", "return vec3(0.0, 0.0, 0.0)"},
    {"%r = mul vec3 %m, vec3(1.0, 1.0, 1.0)", "%r = mul vec3 %m, vec3(1.0, 1.0, 1.0)\nreturn %r"},
    {"%r = mul vec3 mat3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0), %v", "return %v"},
    {"%r = mul vec3 %v, mat3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)", "return %v"},
    {"%r = mul mat3 %m, mat3(1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0)",
     "%r = mul mat3 %m, mat3(1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0)\nreturn %r"},
    {"%r = mul mat3 %m, 1.0", "return %m"},
    {"%r = mul mat3 %f, mat3(1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0)",
     /* a matrix is not filled by a scalar */
     "%r = mul mat3 %f, mat3(1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0)\nreturn %r"},
    {"%r = sub vec3 0.0, %v", "%r = neg vec3 %v\nreturn %r"},
    {"%r = sub vec3 %v, %v", "return vec3(0.0, 0.0, 0.0)"},
    {"%r = sub vec2 %k, vec2(-0.0, 0.0)", "return %k"},
    {"%a = sub vec2 %k, vec2(0.0, 1.0)\n%r = add vec2 %a, vec2(0.0, 1.0)", "return %k"},
    {"%r = mul int %i, 1", "return %i"},
    {"%r = add uint %u, 0u", "return %u"},
    {"%r = div float %f, -1.0", "%r = neg float %f\nreturn %r"},
    {"%r = pow float %f, 2.0", "%r = mul float %f, %f\nreturn %r"},
    {"%r = mix vec3 %v, %w, 0.0", "return %v"},
    {"%r = mix vec3 %v, %w, 1.0", "return %w"},
    {"%r = mix vec3 %v, %w, vec3(1.0, 1.0, 1.0)", "return %w"},
    {"%r = mix vec3 %v, %v, %f", "return %v"},
    {"%r = mix vec3 vec3(0.0, 0.0, 0.0), %v, %f", "%r = mul vec3 %f, %v\nreturn %r"},
    {"%r = mix float 1.0, 0.0, %f", "%r = sub float 1.0, %f\nreturn %r"},
    {"%r = clamp vec3 %v, %f, %f", "%r = construct vec3 %f\nreturn %r"},
    {"%a = construct vec3 %f\n%r = mix vec3 %a, vec3(2.0, 2.0, 2.0), %g",
     "%a = mix float %f, 2.0, %g\n%r = construct vec3 %a\nreturn %r"},
    {"%a = construct vec3 %f\n%r = pow vec3 %a, %v",
     "%a = construct vec3 %f\n%r = pow vec3 %a, %v\nreturn %r"},
    {"%a = mul vec3 %v, %f\n%r = mul vec3 %a, %g",
     "%a = mul float %f, %g\n%r = mul vec3 %v, %a\nreturn %r"},
    {"%h = sample int\n%l = convert float %h\n%a = mul vec3 %v, %f\n%r = mul vec3 %a, %l",
     "%h = sample int\n%l = convert float %h\n%a = mul vec3 %f, %v\n%r = mul vec3 %l, %a\nreturn "
     "%r"},
    {"%r = select vec3 true, %v, %w", "return %v"},
    {"%r = select vec3 %b, %v, %v", "return %v"},
    {"%r = select bool %b, true, false", "return %b"},
    {"%r = eq bool %b, false", "%r = not bool %b\nreturn %r"},
    {"%r = dFdx vec3 vec3(1.0, 2.0, 3.0)", "return vec3(0.0, 0.0, 0.0)"},
    /* constants as people write them */
    {"%r = sub float %f, -1.0", "%r = add float %f, 1.0\nreturn %r"},
    {"%r = add vec3 %v, vec3(-1.0, -2.0, -3.0)",
     "%r = sub vec3 %v, vec3(1.0, 2.0, 3.0)\nreturn %r"},
    {"%r = add vec3 %v, vec3(-1.0, 2.0, -3.0)",
     "%r = add vec3 %v, vec3(-1.0, 2.0, -3.0)\nreturn %r"},
    {"%r = sub float -1.0, %f", "%r = sub float -1.0, %f\nreturn %r"},
    {"%r = add int %i, -1", "%r = add int %i, -1\nreturn %r"},
    {"%r = div float %f, 2.0", "%r = mul float %f, 0.5\nreturn %r"},
    {"%r = div vec2 %k, vec2(-4.0, 0.25)", "%r = mul vec2 %k, vec2(-0.25, 4.0)\nreturn %r"},
    {"%r = div mat3 %m, 2.0", "%r = mul mat3 %m, 0.5\nreturn %r"},
    {"%r = div mat3 %m, mat3(2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0)",
     /* that is no product of matrices */
     "%r = div mat3 %m, mat3(2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0)\nreturn %r"},
    {"%r = div float %f, 3.0", "%r = div float %f, 3.0\nreturn %r"}, /* a third is no float */
    {"%r = div float %f, 1e38", "%r = div float %f, 1e38\nreturn %r"},
    {"%a = clamp float %f, 0.1, %g\n%r = abs float %a", "%r = clamp float %f, 0.1, %g\nreturn %r"},
    {"%a = clamp vec2 %k, vec2(0.0, -1.0), vec2(1.0, 1.0)\n%r = abs vec2 %a",
     "%a = clamp vec2 %k, vec2(0.0, -1.0), vec2(1.0, 1.0)\n%r = abs vec2 %a\nreturn %r"},
    {"%a = clamp float %f, %g, 1.0\n%r = min float %a, 1.0",
     "%r = clamp float %f, %g, 1.0\nreturn %r"},
    /* swizzles, constructors, conversions */
    {"%r = swizzle vec3 .xyz %v", "return %v"},
    {"%a = neg vec3 %v\n%r = swizzle float .y %a",
     "%a = swizzle float .y %v\n%r = neg float %a\nreturn %r"},
    {"%r = swizzle float .x %f", "return %f"},
    {"%r = swizzle vec3 .xxx %f", "%r = construct vec3 %f\nreturn %r"},
    {"%r = swizzle vec2 .xy %v", "%r = swizzle vec2 .xy %v\nreturn %r"},
    {"%a = swizzle vec3 .zyx %v\n%r = swizzle vec2 .xy %a", "%r = swizzle vec2 .zy %v\nreturn %r"},
    {"%a = construct vec3 %f, %g, 1.0\n%r = swizzle vec2 .yx %a",
     "%r = construct vec2 %g, %f\nreturn %r"},
    {"%a = construct vec3 %f, %g, 1.0\n%r = swizzle vec2 .zz %a", "return vec2(1.0, 1.0)"},
    {"%a = construct vec4 %v, %f\n%r = swizzle vec3 .xyz %a", "return %v"},
    {"%a = construct vec4 %v, %f\n%r = swizzle float .w %a", "return %f"},
    {"%a = construct vec3 %f\n%r = swizzle vec2 .zx %a", "%r = construct vec2 %f\nreturn %r"},
    {"%x = swizzle float .x %v\n%y = swizzle float .y %v\n%z = swizzle float .z %v\n%r = construct "
     "vec3 %x, %y, %z",
     "return %v"},
    {"%x = swizzle float .x %q\n%y = swizzle float .z %q\n%r = construct vec3 %y, %x, %f",
     "%1 = swizzle vec2 .zx %q\n%r = construct vec3 %1, %f\nreturn %r"},
    {"%a = construct vec2 %f, %g\n%r = construct vec4 %a, %a",
     "%r = construct vec4 %f, %g, %f, %g\nreturn %r"},
    {"%r = construct vec3 %f, %f, %f", "%r = construct vec3 %f\nreturn %r"},
    {"%r = construct vec3 vec2(1.0, 2.0), %f", "%r = construct vec3 1.0, 2.0, %f\nreturn %r"},
    {"%r = convert vec2 %v", "%r = swizzle vec2 .xy %v\nreturn %r"},
    {"%r = convert vec2 %j", "%r = convert vec2 %j\nreturn %r"},
    {"%r = convert mat3 %n", "%r = convert mat3 %n\nreturn %r"},
    {"%r = convert float 3", "return 3.0"},
    {"%r = index float %v, 1", "%r = swizzle float .y %v\nreturn %r"},
    {"%r = index float %v, %i", "%r = index float %v, %i\nreturn %r"},
    {"%r = index float %v, 3", "%r = swizzle float .z %v\nreturn %r"},
    {"%r = index vec3 %m, 1", "%r = index vec3 %m, 1\nreturn %r"},
    {"%a = construct mat3 %v, %w, %v\n%r = index vec3 %a, 1", "return %w"},
    {"%a = construct mat3 %f\n%r = index vec3 %a, 0",
     "%1 = construct mat3 %f\n%r = index vec3 %1, 0\nreturn %r"},
    /* poison spreads through arithmetic, but not past a known choice */
    {"%p = poison float\n%r = add float %p, %f", "%r = poison float\nreturn %r"},
    {"%p = poison float\n%r = select float true, %f, %p", "return %f"},
    /* derivatives merge, they do not fold */
    {"%a = dFdx float %f\n%c = dFdx float %f\n%r = sub float %a, %c", "return 0.0"},
};

/* Both have equal sources in one order, so that equal graphs print equal. */
static void test_builder_case(const char *in, const char *out)
{
    struct fixture built, expected;
    struct text text;
    setup(&built);
    setup(&expected);
    text_init(&text, &built.arena);
    text_fmt(&text, "%s%s\nreturn %%r\n", SOURCES, in);
    const char *is = reprint(&built, text_cstr(&text));
    text_init(&text, &expected.arena);
    text_fmt(&text, "%s%s\n", SOURCES, out);
    expected.graph.no_fold = true;
    if (!REQUIRE_STR(is, reprint(&expected, text_cstr(&text))))
        printf("    from %s\n", in);
    teardown(&built);
    teardown(&expected);
}

static void test_builder(void)
{
    for (size_t i = 0; i < sizeof builder_cases / sizeof *builder_cases; i++)
        test_builder_case(builder_cases[i].in, builder_cases[i].out);
}

/* Hash-consing, origins and flags. */
static void test_sharing(void)
{
    struct fixture f;
    setup(&f);
    struct ir_graph *g = &f.graph;
    ir_ref x = ir_build(g, IR_UNIFORM, IR_TYPE_FLOAT, 0, NULL, 0),
           y = ir_build(g, IR_UNIFORM, IR_TYPE_FLOAT, 1, NULL, 0);
    REQUIRE(x != y);
    REQUIRE_EQ(ir_build(g, IR_UNIFORM, IR_TYPE_FLOAT, 0, NULL, 0), x);
    ir_ref sum = ir_op2(g, IR_ADD, x, y);
    uint32_t num_nodes = g->nodes.len;
    REQUIRE_EQ(ir_op2(g, IR_ADD, y, x), sum);
    REQUIRE_EQ(ir_const_float(g, 0.5f), ir_const_splat(g, IR_TYPE_FLOAT, 0.5f));
    REQUIRE_EQ(g->nodes.len, num_nodes + 1);
    REQUIRE(ir_const_float(g, 0.0f) != ir_const_float(g, -0.0f));
    REQUIRE(ir_const_int(g, 0) != ir_const_float(g, 0.0f));
    REQUIRE_EQ(ir_op2(g, IR_ADD, x, ir_const_int(g, 1)), 0); /* types do not fit */
    REQUIRE_EQ(ir_op1(g, IR_NOT, x), 0);

    ir_push_origin(g, ir_add_origin(g, str_intern_z(&f.strings, "roughness"), 7, 0));
    ir_ref product = ir_op2(g, IR_MUL, x, y);
    ir_pop_origin(g);
    REQUIRE_EQ(ir_op2(g, IR_MUL, x, y), product);
    REQUIRE_EQ(g->origins.items[ir_get(g, product)->origin].element, 7);

    ir_ref slope = ir_op1(g, IR_DFDX, product);
    REQUIRE(!(ir_get(g, product)->flags & IR_NODE_DERIVATIVE));
    REQUIRE(ir_get(g, slope)->flags & IR_NODE_DERIVATIVE);
    REQUIRE(ir_get(g, ir_op2(g, IR_ADD, slope, x))->flags & IR_NODE_DERIVATIVE);
    uint32_t callee = ir_add_callee(
        g, (struct ir_callee){.kind = IR_CALLEE_FAMILY, .index = 3, .derivative = true});
    REQUIRE_EQ(ir_add_callee(g, (struct ir_callee){.kind = IR_CALLEE_FAMILY, .index = 3}), callee);
    REQUIRE(ir_add_callee(g, (struct ir_callee){.index = 4}) != callee);
    ir_ref leaf = ir_build(g, IR_LEAF, IR_TYPE_BSDF, callee, &x, 1);
    REQUIRE_EQ(ir_get(g, leaf)->flags, IR_NODE_DERIVATIVE | IR_NODE_CLOSURE);

    ir_ref parts[] = {x, y};
    ir_ref pair = ir_construct(g, IR_TYPE_VEC2, parts, 2);
    /* operands inside of the graph */
    ir_ref wide = ir_build(g, IR_CONSTRUCT, IR_TYPE_VEC2, 0, ir_args(g, pair), 2);
    REQUIRE_EQ(wide, pair);
    teardown(&f);
}

/* dot(vec3(x), k) is x times the sum of k, and x where k is a mean. */
static void test_dot_of_scalar(void)
{
    struct fixture f;
    setup(&f);
    struct ir_graph *g = &f.graph;
    ir_ref x = ir_build(g, IR_UNIFORM, IR_TYPE_FLOAT, 0, NULL, 0),
           v = ir_build(g, IR_UNIFORM, IR_TYPE_VEC3, 1, NULL, 0);
    ir_ref same = ir_construct(g, IR_TYPE_VEC3, &x, 1), two = ir_const_splat(g, IR_TYPE_VEC3, 2.0f),
           third = ir_const_splat(g, IR_TYPE_VEC3, 1.0f / 3.0f);
    REQUIRE_EQ(ir_op2(g, IR_DOT, same, two), ir_op2(g, IR_MUL, x, ir_const_float(g, 6.0f)));
    REQUIRE_EQ(ir_op2(g, IR_DOT, third, same), x);
    REQUIRE_EQ(ir_get(g, ir_op2(g, IR_DOT, v, two))->op, IR_DOT);
    g->exact = true;
    REQUIRE_EQ(ir_get(g, ir_op2(g, IR_DOT, same, third))->op, IR_DOT);
    teardown(&f);
}

static void test_convert(void)
{
    struct fixture f;
    setup(&f);
    struct ir_graph *g = &f.graph;
    ir_ref i = ir_build(g, IR_UNIFORM, IR_TYPE_INT, 0, NULL, 0),
           v = ir_build(g, IR_UNIFORM, IR_TYPE_VEC3, 1, NULL, 0);
    ir_ref m = ir_build(g, IR_UNIFORM, IR_TYPE_MAT3, 2, NULL, 0),
           b = ir_build(g, IR_UNIFORM, IR_TYPE_BSDF, 3, NULL, 0);
    REQUIRE_EQ(ir_convert(g, IR_TYPE_INT, i), i);
    REQUIRE_EQ(ir_type_of(g, ir_convert(g, IR_TYPE_VEC3, i)), IR_TYPE_VEC3);
    REQUIRE_EQ(ir_type_of(g, ir_convert(g, IR_TYPE_MAT3, i)), IR_TYPE_MAT3);
    REQUIRE_EQ(ir_get(g, ir_convert(g, IR_TYPE_VEC2, v))->op, IR_SWIZZLE);
    REQUIRE_EQ(ir_convert(g, IR_TYPE_VEC4, v), 0);
    REQUIRE_EQ(ir_convert(g, IR_TYPE_VEC3, m), 0);
    REQUIRE_EQ(ir_type_of(g, ir_convert(g, IR_TYPE_MAT4, m)), IR_TYPE_MAT4);
    REQUIRE_EQ(ir_convert(g, IR_TYPE_FLOAT, b), 0);
    REQUIRE_EQ(ir_construct(g, IR_TYPE_VEC4, (ir_ref[]){i, v}, 2),
               ir_construct(g, IR_TYPE_VEC4, (ir_ref[]){i, v}, 2));
    REQUIRE_EQ(ir_construct(g, IR_TYPE_VEC2, (ir_ref[]){i, v}, 2), 0);
    REQUIRE_EQ(ir_construct(g, IR_TYPE_VEC4, (ir_ref[]){b, v}, 2), 0);
    REQUIRE(ir_const_is(g, ir_const_splat(g, IR_TYPE_VEC3, 2.0f), 2.0f));
    REQUIRE(ir_const_is(g, ir_const_int(g, 1), 1.0f));
    REQUIRE(!ir_const_is(g, ir_const_splat(g, IR_TYPE_MAT2, 1.0f), 1.0f));
    REQUIRE(!ir_const_is(g, v, 0.0f));
    teardown(&f);
}

/*
 * Structs and arrays are taken apart where they were put together, and structs put together where
 * they were taken apart.
 */
static void test_user_types(void)
{
    struct fixture f;
    setup(&f);
    struct ir_graph *g = &f.graph;
    str_id name = str_intern_z(&f.strings, "Ray");
    struct ir_member members[] = {{str_intern_z(&f.strings, "origin"), IR_TYPE_VEC3},
                                  {name, IR_TYPE_FLOAT}};
    ir_type_id ray = (ir_type_id)ir_add_struct(g, name, members, 2),
               rays = (ir_type_id)ir_add_array(g, ray, 2);
    REQUIRE_EQ(ir_add_struct(g, name, members, 2), ray);
    REQUIRE_EQ(ir_add_array(g, ray, 2), rays);
    REQUIRE(ir_add_array(g, ray, 3) != rays);
    ir_ref v = ir_build(g, IR_UNIFORM, IR_TYPE_VEC3, 0, NULL, 0),
           t = ir_build(g, IR_UNIFORM, IR_TYPE_FLOAT, 1, NULL, 0);
    ir_ref a = ir_construct(g, ray, (ir_ref[]){v, t}, 2);
    REQUIRE_EQ(ir_construct(g, ray, (ir_ref[]){t, v}, 2), 0);
    ir_ref both = ir_construct(g, rays, (ir_ref[]){a, a}, 2);
    REQUIRE_EQ(ir_build(g, IR_MEMBER, IR_TYPE_FLOAT, 1, &a, 1), t);
    REQUIRE_EQ(ir_build(g, IR_INDEX, ray, 0, (ir_ref[]){both, ir_const_int(g, 1)}, 2), a);
    ir_ref any = ir_build(g, IR_UNIFORM, rays, 2, NULL, 0),
           i = ir_build(g, IR_UNIFORM, IR_TYPE_INT, 3, NULL, 0);
    ir_ref one = ir_build(g, IR_INDEX, ray, 0, (ir_ref[]){any, i}, 2);
    ir_ref root = ir_build(g, IR_MEMBER, IR_TYPE_VEC3, 0, &one, 1),
           last = ir_build(g, IR_MEMBER, IR_TYPE_FLOAT, 1, &one, 1);
    REQUIRE_EQ(ir_construct(g, ray, (ir_ref[]){root, last}, 2), one);
    REQUIRE(ir_construct(g, ray, (ir_ref[]){root, t}, 2) != one);
    REQUIRE_STR(print(&f, &root, 1), "struct \"Ray\" vec3 \"origin\", float \"Ray\"\n"
                                     "array $0 2\n"
                                     "array $0 3\n"
                                     "%1 = uniform $1 @2\n"
                                     "%2 = uniform int @3\n"
                                     "%3 = index $0 %1, %2\n"
                                     "%4 = member vec3 %3\n"
                                     "return %4\n");
    teardown(&f);
}

/* A printed graph parses back to itself, whether folded or not. */
static const char *const round_trips[] = {
    "return 1.0, -0.0, 1e-45, 3.4028235e38, inf, -inf, nan#2143289344, 7, -2147483648, "
    "4294967295u, true, \"a\\\"b\\\\\\u0001\"\n",
    "return vec3(1.0, 2.0, 3.0), ivec2(1, -2), mat2(1.0, 0.0, 0.0, 1.0)\n",
    "callee \"mx_noise\" function 255 derivative pure\n"
    "callee \"oren\" family 4294967295\n"
    "%1 = stream vec3 @4\n"
    "%2 = call void %1, 0.5\n"
    "%3 = result float %2\n"
    "%4 = result vec3 @1 %2\n"
    "%5 = leaf BSDF @1 %3, %4, _\n"
    "%6 = leaf BSDF @1 1.0, %4, %5\n"
    "%7 = surface surfaceshader %6, _, 1.0, false\n"
    "%8 = material material %7, _, _, _\n"
    "return %8, %3\n",
    "function \"NG_brick/a\" float, vec3\n"
    "function \"unused\"\n"
    "%1 = param float @0:0\n"
    "%2 = param vec3 @0:1\n"
    "%3 = mul vec3 %1, %2\n"
    "%4 = uniform vec3\n"
    "results 0 = %3, 2.0\n"
    "%5 = graph_call void 0.5, %4\n"
    "%6 = result vec3 %5\n"
    "%7 = result float @1 %5\n"
    "%8 = mul vec3 %6, %7\n"
    "return %8\n",
    "%1 = texture_input sampler2D\n"
    "%2 = stream vec2\n"
    "%3 = texture vec4 %1, %2\n"
    "%4 = swizzle vec3 .xyz %3\n"
    "%5 = textureGrad vec4 %1, %2, %2, %2\n"
    "%6 = context vec3 @1\n"
    "return %4, %5, %6\n",
    "",
};

static void test_round_trip(void)
{
    for (size_t i = 0; i < sizeof round_trips / sizeof *round_trips; i++) {
        for (int no_fold = 0; no_fold < 2; no_fold++) {
            struct fixture f;
            setup(&f);
            f.graph.no_fold = no_fold;
            REQUIRE_STR(reprint(&f, round_trips[i]), round_trips[i]);
            teardown(&f);
        }
    }
}

/* Texts that the reader refuses, and so a mutation of a text is sound, or refused. */
static void test_refused(void)
{
    static const char *const texts[] = {
        "%1 = nosuch float",
        "%1 = add float 1.0",
        "%1 = uniform float\n%1 = uniform float",
        "%1 = neg float %2",
        "return vec3(1.0, 2.0)",
        "return 2147483648",
        "return \"open",
        "array float 2\narray float 2",
        "%1 = param float @0:0",
        "function \"f\"\nresults 0 = 1.0\nresults 0 = 1.0",
        "return 1.0 2.0",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct fixture f;
        setup(&f);
        REQUIRE_STR(reprint(&f, texts[i]), "");
        teardown(&f);
    }
}

static void test_marks(void)
{
    struct fixture f;
    setup(&f);
    ir_ref *roots;
    uint32_t num_roots;
    static const char text[] = "function \"f\" float\n"
                               "%p = param float @0:0\n"
                               "%body = sin float %p\n"
                               "results 0 = %body\n"
                               "%x = uniform float\n"
                               "%dead = uniform float @1\n"
                               "%twice = mul float %x, %x\n"
                               "%call = graph_call void %twice\n"
                               "%again = graph_call void %x\n"
                               "%r = result float %call\n"
                               "%s = result float %again\n"
                               "return %r, %s, %x, %dead\n";
    REQUIRE(!ir_text_read(&f.graph, text, &roots, &num_roots));
    REQUIRE_EQ(num_roots, 4);
    uint8_t *marked = ir_mark(&f.graph, roots, 2, &f.arena);
    ir_ref x = roots[2], dead = roots[3], body = f.graph.function_results.items[0];
    REQUIRE_EQ(marked[0], 0);
    REQUIRE_EQ(marked[roots[0]], 1);
    REQUIRE_EQ(marked[x], 1);
    REQUIRE_EQ(marked[body], 1);
    REQUIRE_EQ(marked[dead], 0);
    teardown(&f);
}

static bool source_value(void *user_data, const struct ir_graph *graph, ir_ref ref,
                         struct ir_value *out);

/*
 * Uniform 2 in the place of uniform 1: in the graph, in functions, and in functions that only they
 * call.
 */
static void test_replace(void)
{
    static const char text[] =
        "function \"inner\" float\n%p = param float @0:0\n%n = uniform float @1\n%q = mul float "
        "%p, %n\nresults 0 = %q\n"
        "function \"same\" float\n%s = param float @1:0\n%t = mul float %s, 2.0\nresults 1 = %t\n"
        "function \"outer\" float\n%x = param float @2:0\n%y = graph_call float @0 %x\n%z = "
        "graph_call float @1 %y\n"
        "results 2 = %z, %y\n"
        "%k = uniform float @3\n%a = graph_call void @2 %k\n%b = result float %a\n%c = result "
        "float @1 %a\n"
        "%d = add float %b, %c\n%e = mul float %d, %n\n%m = uniform float @2\nreturn %e, %n, %m\n";
    struct fixture f;
    setup(&f);
    ir_ref *roots;
    uint32_t num_roots;
    struct ir_value value;
    struct ir_eval_env env = {.source = source_value};
    REQUIRE(!ir_text_read(&f.graph, text, &roots, &num_roots));
    REQUIRE(ir_eval(&f.graph, roots[0], &env, &f.arena, &value)
            && value.w[0].f == 3.0f * 11.0f * 13.0f * 11.0f);
    ir_ref replaced = ir_replace(&f.graph, roots[0], roots[1], roots[2], &f.arena);
    REQUIRE(ir_eval(&f.graph, replaced, &env, &f.arena, &value)
            && value.w[0].f == 3.0f * 12.0f * 13.0f * 12.0f);
    REQUIRE_EQ(ir_mark(&f.graph, &replaced, 1, &f.arena)[roots[1]], 0);
    REQUIRE_EQ(ir_replace(&f.graph, replaced, roots[1], roots[2], &f.arena), replaced);
    str_id name = str_intern_z(&f.strings, "area");
    ir_suggest_name(&f.graph, roots[0], name, IR_NAME_LOCAL);
    ir_ref named = ir_replace(&f.graph, roots[0], roots[1], ir_const_float(&f.graph, 5), &f.arena);
    REQUIRE_EQ(ir_label(&f.graph, named)->name, name);
    REQUIRE_EQ(ir_label(&f.graph, replaced)->name, 0); /* the copy is older than the name */
    teardown(&f);
}

/*
 * Uniform k has the value 10 + k, or is unknown from 8 on; calls give their first argument plus the
 * index of the result.
 */
static bool source_value(void *user_data, const struct ir_graph *graph, ir_ref ref,
                         struct ir_value *out)
{
    (void)user_data;
    const struct ir_node *node = ir_get(graph, ref);
    if (node->attr >= 8)
        return false;
    *out = node->type == IR_TYPE_BOOL ? ir_value_bool(node->attr & 1)
                                      : ir_value_float(10.0f + (float)node->attr);
    return true;
}

static uint32_t call_value(void *user_data, const struct ir_graph *graph, ir_ref call,
                           const struct ir_value *args, struct ir_value *out)
{
    (void)user_data, (void)graph, (void)call;
    for (uint32_t i = 0; i < IR_MAX_RESULTS; i++)
        out[i] = ir_value_float(args[0].w[0].f + (float)i);
    return IR_MAX_RESULTS;
}

static const struct {
    const char *text;
    float value; /* NAN: unknown */
} eval_cases[] = {
    {"%a = uniform float @1\n%b = mul float %a, %a\nreturn %b", 121.0f},
    {"return 3.0", 3.0f},
    {"%a = uniform float @9\nreturn %a", 0.0f / 0.0f},
    /* an unknown or undefined value that is not chosen does no harm */
    {"%b = uniform bool @1\n%a = uniform float @9\n%c = select float %b, 2.0, %a\nreturn %c", 2.0f},
    {"%b = uniform bool @0\n%a = uniform float @9\n%c = select float %b, 2.0, %a\nreturn %c",
     0.0f / 0.0f},
    {"%a = uniform bool @9\n%b = uniform bool @0\n%c = land bool %a, %b\n%d = select float %c, "
     "1.0, 2.0\nreturn %d",
     2.0f},
    {"%a = uniform bool @9\n%b = uniform bool @1\n%c = lor bool %a, %b\n%d = select float %c, 1.0, "
     "2.0\nreturn %d",
     1.0f},
    /* calls */
    {"callee \"f\" function 1\n%a = uniform float @2\n%b = call void %a, 1.0\n%c = result float @5 "
     "%b\nreturn %c",
     17.0f},
    {"callee \"f\" function 1\n%a = uniform float @2\n%b = call float %a\nreturn %b", 12.0f},
    {"function \"f\" float\n%p = param float @0:0\n%q = mul float %p, 2.0\n%s = add float %p, "
     "1.0\nresults 0 = %q, %s\n"
     "function \"g\" float, float\n%x = param float @1:0\n%y = param float @1:1\n"
     "%c = graph_call void @0 %x\n%d = graph_call void @0 %y\n%e = result float @0 %c\n%h = result "
     "float @1 %d\n"
     "%i = sub float %e, %h\nresults 1 = %i\n"
     /* 2·13 - (1 + 1) */
     "%u = uniform float @3\n%v = graph_call float @1 %u, 1.0\nreturn %v",
     24.0f},
};

static void test_eval(void)
{
    struct ir_eval_env env = {.source = source_value, .call = call_value};
    for (size_t i = 0; i < sizeof eval_cases / sizeof *eval_cases; i++) {
        struct fixture f;
        setup(&f);
        ir_ref *roots;
        uint32_t num_roots;
        struct ir_value value;
        const char *text = eval_cases[i].text;
        float expected = eval_cases[i].value;
        REQUIRE(!ir_text_read(&f.graph, text, &roots, &num_roots));
        bool known = ir_eval(&f.graph, roots[0], &env, &f.arena, &value);
        if (!REQUIRE_EQ(known, expected == expected)
            || (known && !REQUIRE(value.w[0].f == expected)))
            printf("    in %s\n", text);
        teardown(&f);
    }
}

/* A million nodes in a row: nothing may recurse, nothing may cost more than its share. */
static void test_chain(void)
{
    enum { LENGTH = 1000000 };
    struct fixture f;
    setup(&f);
    struct ir_graph *g = &f.graph;
    ir_ref x = ir_build(g, IR_UNIFORM, IR_TYPE_FLOAT, 0, NULL, 0), node = x;
    for (uint32_t i = 0; i < LENGTH; i++)
        node = ir_op2(g, i & 1 ? IR_SUB : IR_MUL, node, i & 1 ? x : ir_const_float(g, 2.0f));
    REQUIRE(g->nodes.len > LENGTH);
    uint8_t *marked = ir_mark(g, &node, 1, &f.arena);
    REQUIRE_EQ(marked[x], 1);
    struct ir_eval_env env = {.source = source_value};
    struct ir_value value;
    REQUIRE(ir_eval(g, node, &env, &f.arena, &value)); /* 2·10 - 10 = 10, again and again */
    REQUIRE(value.w[0].f == 10.0f);
    const char *text = print(&f, &node, 1);
    struct fixture again;
    setup(&again);
    const char *second = reprint(&again, text);
    REQUIRE(strcmp(text, second) == 0);
    teardown(&again);
    teardown(&f);
}

static void test_limits(void)
{
    struct fixture f;
    setup(&f);
    f.graph.max_nodes = 10;
    ir_ref x = ir_build(&f.graph, IR_UNIFORM, IR_TYPE_FLOAT, 0, NULL, 0);
    for (unsigned i = 0; i < 100; i++)
        x = ir_op1(&f.graph, IR_SIN, x);
    REQUIRE(f.graph.overflow);
    REQUIRE_EQ(ir_get(&f.graph, x)->op, IR_POISON);
    REQUIRE(f.graph.nodes.len < 14);
    teardown(&f);
}

static uint32_t random_below(uint32_t n)
{
    static uint64_t state = 1;
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(state >> 33) % n;
}

/* Replaces, removes or repeats some bytes; text has room for them. */
static void mutate(char *text, size_t cap)
{
    static const char bytes[] = "%@=,. \n;_$\"0123456789uefx-abcfgv";
    for (unsigned times = 1 + random_below(3); times > 0; times--) {
        size_t len = strlen(text), at = random_below((uint32_t)len), run = 1 + random_below(12);
        switch (random_below(3)) {
        case 0: text[at] = bytes[random_below(sizeof bytes - 1)]; break;
        case 1:
            if (at + run < len)
                memmove(text + at, text + at + run, len - at - run + 1);
            break;
        default:
            if (at + run < len && len + run < cap)
                memmove(text + at + run, text + at, len - at + 1);
        }
    }
}

/* Whatever the text: it is refused, or gives a sound graph whose print is read back as the same. */
static void test_mutation(const char *original)
{
    char text[2048];
    struct fixture f, again;
    setup(&f);
    snprintf(text, sizeof text, "%s", original);
    mutate(text, sizeof text);
    ir_ref *roots, node;
    uint32_t num_roots;
    if (!ir_text_read(&f.graph, text, &roots, &num_roots)) {
        if (!REQUIRE(!ir_check(&f.graph, &node)))
            printf("    %s\n", text);
        const char *printed = print(&f, roots, num_roots);
        setup(&again);
        REQUIRE_STR(reprint(&again, printed), printed);
        teardown(&again);
    }
    teardown(&f);
}

static void test_mutations(void)
{
    char text[2048];
    for (unsigned i = 0; i < 4000; i++) {
        size_t num_trips = sizeof round_trips / sizeof *round_trips - 1; /* the last one is empty */
        size_t num_cases = sizeof builder_cases / sizeof *builder_cases;
        size_t k = random_below((uint32_t)(num_trips + num_cases));
        if (k < num_trips)
            snprintf(text, sizeof text, "%s", round_trips[k]);
        else
            snprintf(text, sizeof text, "%s%s\nreturn %%r\n", SOURCES,
                     builder_cases[k - num_trips].in);
        test_mutation(text);
    }
}

/* The C library's allocator until `left` allocations are done. */
static void *failing_realloc(void *user_data, void *block, size_t old_size, size_t new_size)
{
    size_t *left = user_data;
    (void)old_size;
    if (new_size == 0) {
        free(block);
        return NULL;
    }
    if (*left == 0)
        return NULL;
    --*left;
    return realloc(block, new_size);
}

static bool try_work(struct fixture *f, size_t left)
{
    struct trap trap;
    mem_init(&f->mem, failing_realloc, &left);
    arena_init(&f->arena, &f->mem);
    f->mem.trap = &trap;
    if (setjmp(trap.place))
        return false;
    strpool_init(&f->strings, &f->arena, NULL);
    ir_graph_init(&f->graph, &f->arena, &f->strings);
    ir_ref x = ir_build(&f->graph, IR_UNIFORM, IR_TYPE_FLOAT, 0, NULL, 0);
    for (unsigned i = 0; i < 3000; i++)
        x = ir_op2(&f->graph, IR_MUL, x, ir_const_float(&f->graph, 2.0f + (float)i));
    reprint(f, print(f, &x, 1));
    return true;
}

static void test_memory(void)
{
    struct fixture f;
    size_t k = 0;
    for (bool done = false; !done && k < 1000; k++) {
        done = try_work(&f, k);
        arena_finish(&f.arena);
        REQUIRE_EQ(f.mem.used, 0);
    }
    REQUIRE(k > 10 && k < 1000);
}

int main(void)
{
    test_builder();
    test_sharing();
    test_dot_of_scalar();
    test_convert();
    test_user_types();
    test_round_trip();
    test_refused();
    test_marks();
    test_replace();
    test_eval();
    test_chain();
    test_limits();
    test_mutations();
    test_memory();
    return test_report("ir");
}
