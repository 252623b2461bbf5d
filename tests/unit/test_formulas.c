// SPDX-License-Identifier: Apache-2.0
/* The formulas that the compiler calls by name: their values, and what a call becomes. */
#include "shader/formula.h"
#include "shader_fixture.h"
#include "test.h"

#include <math.h>

enum { MAX_ARGS = 6 };

struct number { /* one component, or two to four */
    unsigned num;
    float at[4];
};
#define ONE(x) \
    { \
        1, \
        { \
            x \
        } \
    }
#define TWO(x, y) \
    { \
        2, \
        { \
            x, y \
        } \
    }
#define THREE(x, y, z) \
    { \
        3, \
        { \
            x, y, z \
        } \
    }
#define FOUR(x, y, z, w) \
    { \
        4, \
        { \
            x, y, z, w \
        } \
    }

static const struct row {
    const char *name;
    struct number args[MAX_ARGS], value;
} rows[] = {
    {"mx_spread_of_alpha", {ONE(0.25f)}, ONE(0.27818f)},
    {"mx_spread_of_alpha", {ONE(1.0f)}, ONE(999.0f)},
    {"mx_spread_widened", {ONE(0.5f), ONE(0.0f)}, ONE(0.5f)},
    {"mx_spread_alpha", {ONE(0.2f), ONE(0.6f), ONE(0.5f)}, ONE(0.16f)},
    {"mx_spread_presence", {THREE(0.01f, 0, 0), THREE(0, 1, 0)}, ONE(0.5f)},
    {"mx_spread_presence", {THREE(1, 1, 1), THREE(0, 0, 0)}, ONE(0)},
    {"mx_spread_slope", {ONE(0.5f), ONE(1), ONE(0.5f)}, ONE(0.0100125f)},
    {"mx_medium_straight", {THREE(0, 0.5f, 0.5f), THREE(1, 1, 0)}, THREE(1, 0.43717f, 0.60110f)},
    {"mx_medium_evened",
     {THREE(0.8f, 1, 0), THREE(0.25f, 0, 0.5f), THREE(0.5f, 0.5f, 0.5f)},
     THREE(0.75f, 1, 0.5f)},
    {"mx_layer_number", {THREE(1, 2, 3), ONE(0)}, ONE(0.61423165f)}, /* pcg3d in another language */
    {"mx_layer_number", {THREE(0.25f, -1, 0.5f), ONE(7)}, ONE(0.31091219f)},
    {"mx_added_throughput", {THREE(0.9f, 0.3f, 1), THREE(0.8f, 0.2f, 1)}, THREE(0.7f, 0, 1)},
    {"mx_extinction", {THREE(0.5f, 0, 2)}, THREE(2, 1e5f, 0.5f)},
    {"mx_scattering_albedo", {THREE(1, 0, 0.5f)}, THREE(0.998886f, 0, 0.912298f)},
    {"mx_exposed", {ONE(2), ONE(3)}, ONE(16)},
    {"mx_cone_share", {ONE(1.0471976f)}, ONE(0.25f)},
    {"mx_profile_place", {THREE(0, 0, 2), THREE(0, -0.8660254f, -0.5f), ONE(0.1f), ONE(9)}, ONE(6)},
    {"mx_profile_place", {THREE(0, 0, 1), THREE(0, 0, 1), ONE(0.1f), ONE(9)}, ONE(9)},
    {"mx_index_of_frontal", {ONE(0.04f)}, ONE(1.5f)},
    {"mx_rise_cosine", {THREE(0, 0, 1), THREE(0, 0.8f, -0.6f)}, ONE(0.6f)},
    {"mx_rise_above", {THREE(0.2f, 0.5f, 0.5f), THREE(1, 0.4f, 0.5f)}, THREE(0.8f, 0, 0)},
    {"mx_decal_over",
     {THREE(0.8f, 0.4f, 0), FOUR(0.1f, 0.2f, 0.3f, 0.5f)},
     THREE(0.5f, 0.4f, 0.3f)},
    {"mx_decal_over", {ONE(0.8f), FOUR(0.1f, 0, 0, 0.5f)}, ONE(0.5f)},
    {"mx_decal_left", {ONE(0.8f), FOUR(0.1f, 0, 0, 0.5f)}, ONE(0.4f)},
    {"mx_decal_hue", {THREE(1, 0.5f, 0), FOUR(0, 0, 0, 0.5f)}, THREE(1, 0.75f, 0.5f)},
    {"mx_decal_glints", {ONE(9), FOUR(0, 0, 0, 0.4f)}, ONE(0)},
    {"mx_decal_normal", {THREE(0, 0, 1), FOUR(0, 0, 0, 1)}, THREE(0, 0, 1)},
    {"mx_decal_normal", {THREE(0, 0, 1), FOUR(1, 0.5f, 0.5f, 0)}, THREE(1, 0, 0)},
    {"mx_decal_pixel_of_normal", {THREE(1, 0, 0), ONE(0.5f)}, FOUR(0.5f, 0.25f, 0.25f, 0.5f)},
    {"mx_blend_share", {ONE(1), ONE(3)}, ONE(0.75f)},
    {"mx_blend_share", {ONE(0), ONE(0)}, ONE(0)},
    {"mx_blend_share", {THREE(1, 1, 1), THREE(0, 3, 6)}, ONE(0.75f)},
    {"mx_blend_diffuse",
     {THREE(0, 0.5f, 1), THREE(0.8f, 0.8f, 0.8f), ONE(0.5f)},
     THREE(0.4f, 0.2f, 0)},
    {"mx_blend_seen", {THREE(0, 0.5f, 1), THREE(0.8f, 0.8f, 0.8f)}, THREE(0.8f, 0.9f, 1)},
    {"mx_blend_albedo", {THREE(0.5f, 0, 1), THREE(0.25f, 0.25f, 0)}, THREE(0.5f, 0.25f, 0)},
    {"mx_blend_fuzz_roughness", {ONE(-1), ONE(0.3f)}, ONE(0.3f)},
    {"mx_blend_coverage", {ONE(0.5f), ONE(0.5f)}, ONE(0.75f)},
    {"mx_blend_below", {THREE(0, 0.5f, 1), ONE(0.5f), ONE(0.5f)}, THREE(0.25f, 0.375f, 0.5f)},
    {"mx_blend_depth", {THREE(1, 2, 4), ONE(2)}, THREE(2, 1, 0.5f)},
    {"mx_blend_depth", {THREE(1, 2, 4), ONE(2), ONE(2), ONE(1)}, THREE(2, 1, 0.5f)},
    /* what lets exp(-1) and exp(-1) through lets exp(-1) through side by side */
    {"mx_blend_path_beside",
     {THREE(1, 1, 1), THREE(1, 1, 1), ONE(0.3f), ONE(0.5f), ONE(2)},
     THREE(1, 1, 1)},
    {"mx_blend_path_of",
     {THREE(0.36787944f, 1, 0), ONE(0.5f), ONE(2)},
     THREE(1, 99864, 0.10857362f)},
    {"mx_blend_roughness", {TWO(0.16f, 1)}, ONE(0.63245553f)},
    {"mx_mean", {THREE(1, 2, 3)}, ONE(2)},
    {"mx_brightness", {THREE(-1, -1, -1)}, ONE(0)},
    {"mx_weighted_throughput", {THREE(0, 0.5f, 1), ONE(0.5f)}, THREE(0.5f, 0.75f, 1)},
    {"mx_weighted_throughput", {THREE(0, 0.5f, 1), THREE(0, 1, 1)}, THREE(1, 0.5f, 1)},
    {"mx_closure_way", {THREE(0, 0, 1), THREE(0, 0, 1)}, ONE(1)},
    {"mx_closure_way", {THREE(0, 0, 1), THREE(1, 0, 0)}, ONE(1.3416408f)},
    /* 0.25 + 0.75 0.5^x at x = 0, 1 and 2 */
    {"mx_decay", {THREE(1, 1, 1), THREE(0.625f, 1, 0), THREE(0.4375f, 1, 0)}, THREE(0.5f, 0, 0)},
    {"mx_decaying", {THREE(1, 1, 1), THREE(0.625f, 1, 0), THREE(0.5f, 0, 0)}, THREE(0.75f, 0, 1)},
    {"mx_transmittance", {THREE(0, 1, 2)}, THREE(1, 0.36787944f, 0.13533528f)},
    {"mx_absorption", {THREE(1, 0.36787944f, 0)}, THREE(0, 1, 13.815511f)},
    {"mx_volume_depth", {ONE(2), THREE(0, 0, 1), THREE(0.6f, 0, 0.8f)}, ONE(1.6f)},
    {"mx_volume_depth", {ONE(2), THREE(0, 0, 1), THREE(0, 0, -1)}, ONE(0)},
    {"mx_volume_lost", {THREE(0, 1, 2)}, THREE(0, 0.63212056f, 0.86466472f)},
    {"mx_volume_path",
     {ONE(2), THREE(0, 1, 2), THREE(0, 0.63212056f, 0.86466472f)},
     THREE(2, 1.2642411f, 0.86466472f)},
    {"mx_light_of_emitter", {THREE(1, 2, 0), ONE(3), ONE(1), ONE(2)}, THREE(1.5f, 3, 0)},
    {"mx_sampled_share", {ONE(0.5f)}, ONE(0.55f)},
    {"mx_balanced", {THREE(1, 2, 3), ONE(0.5f), ONE(2)}, THREE(0.5f, 1, 1.5f)},
    {"mx_rest_of_number", {ONE(0.1f), ONE(0.2f)}, ONE(0.5f)},
    {"mx_rest_of_number", {ONE(0.6f), ONE(0.2f)}, ONE(0.5f)},
    {"mx_scale_of_coverage", {ONE(0.25f)}, ONE(4)},
    {"mx_mean", {THREE(1, 0, 0), THREE(0, 1, 0), THREE(0, 2, 3)}, THREE(0.33333333f, 1, 1)},
    {"mx_decayed", {THREE(1, 2, 0), THREE(0.25f, 1, 1), ONE(0.5f)}, THREE(0.5f, 2, 0)},
    {"mx_hidden", {THREE(1, 0.5f, 0)}, ONE(0.5f)},
    {"mx_hidden", {THREE(2, 2, 2)}, ONE(0)},
    {"mx_rest_of_choice", {ONE(0.2f), ONE(0.4f), ONE(1)}, ONE(0.5f)},
    {"mx_rest_of_choice", {ONE(0.7f), ONE(0.4f), ONE(1)}, ONE(0.5f)},
    {"mx_normal_under",
     {THREE(0, 0, 1), THREE(1, 0, 0), ONE(0.5f)},
     THREE(0.70710678f, 0, 0.70710678f)},
    {"mx_normal_bent", {THREE(0, 0, 1), THREE(1, 0, 0)}, THREE(0.70710678f, 0, 0.70710678f)},
    {"mx_normal_bent",
     {THREE(0, 0, 1), THREE(3, 0, -1), ONE(0.25f)},
     THREE(0.70710678f, 0, 0.70710678f)},
    {"mx_next_turn", {TWO(1, 0)}, TWO(-0.73736888f, 0.67549029f)}, /* by 137.5 degrees */
    {"mx_srgb_encoded", {THREE(0.001f, 0.5f, 1)}, THREE(0.01292f, 0.73535698f, 1)},
    {"mx_srgb_encoded", {THREE(-1, 0, 0.0031308f)}, THREE(-12.92f, 0, 0.04045f)},
    {"mx_tile_cell", {TWO(2, 1), ONE(3)}, ONE(5)},
    {"mx_spread_both", {ONE(1), ONE(2), ONE(3)}, ONE(7)},
    {"mx_spread_place", {ONE(1), ONE(1), ONE(7), ONE(3)}, ONE(25)},
    {"mx_displacement", {ONE(2), THREE(0, 0, 3)}, THREE(0, 0, 2)},
    {"mx_displacement", {THREE(1, 2, 3), THREE(0, 0, 3), THREE(2, 0, 0)}, THREE(1, 2, 3)},
    {"mx_shadow_lit", {ONE(0.2f), ONE(0.5f), ONE(0.3f)}, ONE(1)},
    {"mx_shadow_lit", {ONE(0.7f), ONE(0.5f), ONE(0.29f)}, ONE(0.5f)},
    {"mx_blur_over_length", {ONE(6), THREE(0, 3, 0)}, ONE(2)},
    {"mx_blur_skew", {THREE(2, 0, 0), THREE(1, 1, 0)}, ONE(0.5f)},
    {"mx_rise_schlick", {THREE(0.5f, 0.5f, 0.5f), THREE(1, 1, 1), ONE(5), ONE(0)}, THREE(2, 2, 2)},
    {"mx_rise_conductor", {THREE(1, 2, 3), THREE(2, 0, 0), ONE(0)}, THREE(2, 9, 4)},
    {"mx_rise_dielectric", {ONE(1.5f), ONE(1)}, ONE(1)},
    {"mx_rise_dielectric", {ONE(1.5f), ONE(0)}, ONE(25)},
    {"mx_rise_edge",
     {THREE(0, 0, 1), THREE(1, 0, 1), THREE(0.5f, 1, 1), ONE(5)},
     THREE(0.5f, 0, 1)},
    {"mx_blend_path_over", {THREE(1, 1, 1), THREE(1, 3, 0), ONE(2)}, THREE(1, 0.5f, 2)},
};

static ir_ref constant(struct fixture *f, const struct number *number)
{
    struct ir_value value = {.type = number->num == 1   ? IR_TYPE_FLOAT
                                     : number->num == 2 ? IR_TYPE_VEC2
                                     : number->num == 3 ? IR_TYPE_VEC3
                                                        : IR_TYPE_VEC4};
    for (unsigned i = 0; i < number->num; i++)
        value.w[i].f = number->at[i];
    return ir_const(&f->graph, &value);
}

static void test_values(void)
{
    struct fixture f;
    fixture_open(&f, NULL);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const struct row *row = &rows[i];
        ir_ref args[MAX_ARGS];
        unsigned num = 0;
        for (; num < MAX_ARGS && row->args[num].num; num++)
            args[num] = constant(&f, &row->args[num]);
        struct ir_value value;
        ir_ref result = shader_formula(&f.shader, row->name, args, num);
        if (!REQUIRE(ir_get_const(&f.graph, result, &value)))
            printf("%s does not fold\n", row->name);
        for (unsigned k = 0; k < row->value.num; k++)
            if (!REQUIRE(fabsf(value.w[k].f - row->value.at[k])
                         <= 1e-4f * fmaxf(1.0f, fabsf(row->value.at[k]))))
                printf("%s, component %u: %g\n", row->name, k, (double)value.w[k].f);
    }
    fixture_close(&f);
}

/* Anisotropies along perpendicular tangents cancel, along one tangent they add. */
static void test_anisotropies(void)
{
    struct fixture f;
    fixture_open(&f, NULL);
    const struct number normal = THREE(0, 0, 1), x = THREE(1, 0, 0), y = THREE(0, 1, 0);
    ir_ref some = ir_const_float(&f.graph, 0.5f), half = ir_const_float(&f.graph, 0.5f);
    ir_ref n = constant(&f, &normal), along = constant(&f, &x), across = constant(&f, &y);
    ir_ref none = FORMULA(&f.shader, "mx_blend_anisotropies", some, some, half, n, along, across);
    ir_ref all = FORMULA(&f.shader, "mx_blend_anisotropies", some, some, half, n, along, along);
    REQUIRE(ir_const_is(&f.graph, FORMULA(&f.shader, "mx_blend_anisotropy", none), 0.0f));
    REQUIRE(ir_const_is(&f.graph, FORMULA(&f.shader, "mx_blend_anisotropy", all), 0.5f));
    ir_ref tangent = FORMULA(&f.shader, "mx_blend_tangent", all, n, along);
    REQUIRE(ir_const_is(&f.graph, ir_component(&f.graph, tangent, 0), 1.0f));
    fixture_close(&f);
}

/* A grid of 3 columns and 1 row. */
static void test_tiles(void)
{
    struct fixture f;
    fixture_open(&f, NULL);
    static const struct {
        struct number tile;
        bool is_inside;
    } tiles[] = {{TWO(0, 0), true},   {TWO(2, 0), true},  {TWO(3, 0), false},
                 {TWO(-1, 0), false}, {TWO(1, 1), false}, {TWO(1, -1), false}};
    const struct number last = TWO(2, 0);
    for (size_t i = 0; i < sizeof tiles / sizeof *tiles; i++) {
        ir_ref tile = constant(&f, &tiles[i].tile), end = constant(&f, &last);
        ir_ref is_inside = FORMULA(&f.shader, "mx_tile_is_inside", tile, end);
        REQUIRE(is_inside == ir_const_bool(&f.graph, tiles[i].is_inside));
    }
    fixture_close(&f);
}

/* An argument has the name of its parameter, if that says something. */
static void test_names(void)
{
    struct fixture f;
    fixture_open(&f, NULL);
    ir_ref number = uniform(&f, "number", IR_TYPE_FLOAT), root = ir_op1(&f.graph, IR_SQRT, number);
    FORMULA(&f.shader, "mx_blend_share", root, number);
    REQUIRE(f.graph.labels.items[root].name == 0);
    FORMULA(&f.shader, "mx_rest_of_choice", root, number, number);
    REQUIRE(f.graph.labels.items[root].name == str_find(f.shader.strings, "point", 5));
    fixture_close(&f);
}

/* A formula of variables becomes nodes, and what is known of an operand makes it shorter. */
static void test_nodes(void)
{
    struct fixture f;
    fixture_open(&f, NULL);
    ir_ref a = uniform(&f, "a", IR_TYPE_FLOAT), none = ir_const_float(&f.graph, 0.0f);
    ir_ref share = FORMULA(&f.shader, "mx_blend_share", a, a);
    REQUIRE(ir_get(&f.graph, share)->op == IR_DIV);
    REQUIRE(ir_const_is(&f.graph, FORMULA(&f.shader, "mx_blend_share", none, a), 1.0f));
    REQUIRE(FORMULA(&f.shader, "mx_blend_coverage", none, a) == a);
    fixture_close(&f);
}

int main(void)
{
    test_values();
    test_anisotropies();
    test_tiles();
    test_names();
    test_nodes();
    return test_report("formulas");
}
