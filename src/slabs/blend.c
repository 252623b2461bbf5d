// SPDX-License-Identifier: Apache-2.0
/*
 * Parameter blending: the parts a and b of an operator become one slab. Each part has a weight for
 * its interface, and sends back some diffuse light:
 *
 *                     interface weight        diffuse light
 *     a beside b      share of a, of b        share (1 - f0) albedo
 *     a over b        coverage of a, W        of the medium of a; W (1 - f0) albedo of b
 *     a plus b        1, 1                    (1 - f0) albedo
 *     a times c       c                       c (1 - f0) albedo
 *
 * W is the light that the walk lets through a along its normal, on both ways. The slab has
 *
 *     f0 = sum of weight f0,    albedo = diffuse light / (1 - f0)
 *
 * so along the normal it reflects as much as the operator, and 1 - E takes the diffuse light back
 * at grazing angles in both.
 */
#include "slabs/blend.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"
#include "slabs/cost.h"
#include "slabs/spread.h"

#include <assert.h>

/* A part of the slab. */
struct part {
    ir_ref in[NUM_SLAB_OPERANDS];
    uint32_t lacks; /* features, as the attribute of a SLAB */
    ir_ref weight;  /* vec3: of its interface, where the slab is */
    ir_ref diffuse; /* vec3: light that its medium sends back */
    ir_ref fuzz;    /* float: its weight */
    ir_ref glow;    /* vec3: of its emission */
};

/* ---- The slab of two parts ---- */

/* f0 and albedo; returns the share of b in what interfaces reflect. */
static ir_ref blend_colors(struct shader *shader, const struct part *a, const struct part *b,
                           ir_ref *out)
{
    struct ir_graph *g = shader->graph;
    ir_ref of_a = ir_mul(g, a->in[SLAB_f0], a->weight), of_b = ir_mul(g, b->in[SLAB_f0], b->weight);
    out[SLAB_f0] = FORMULA(shader, "mx_blend_f0", of_a, of_b);
    out[SLAB_diffuse_albedo] =
        FORMULA(shader, "mx_blend_albedo", out[SLAB_f0], a->diffuse, b->diffuse);
    return FORMULA(shader, "mx_blend_share", of_a, of_b);
}

/* True for a part whose interface sends nothing back. */
static bool is_dark(const struct ir_graph *g, const struct part *part)
{
    return ir_const_is(g, part->in[SLAB_f0], 0.0f);
}

static ir_ref mean_roughness(struct ir_graph *g, const struct part *part)
{
    return ir_mix(g, part->in[SLAB_roughness], part->in[SLAB_second_roughness],
                  part->in[SLAB_second_roughness_weight]);
}

/* A lobe of a part, of light that the whole slab reflects. */
struct lobe {
    float roughness, share;
};

enum { MAX_LOBES = 4 };

/* The lobes of both parts; 0: some depend on the pixel. */
static unsigned constant_lobes(const struct ir_graph *g, const struct part *a, const struct part *b,
                               ir_ref share, struct lobe *out)
{
    struct ir_value of_b, weight, first, second;
    if (!ir_get_const(g, share, &of_b))
        return 0;
    for (unsigned i = 0; i < 2; i++) {
        const ir_ref *in = i ? b->in : a->in;
        float whole = i ? of_b.w[0].f : 1.0f - of_b.w[0].f;
        if (!ir_get_const(g, in[SLAB_second_roughness_weight], &weight)
            || !ir_get_const(g, in[SLAB_roughness], &first)
            || !ir_get_const(g, in[SLAB_second_roughness], &second))
            return 0;
        *out++ = (struct lobe){first.w[0].f, whole * (1.0f - weight.w[0].f)};
        *out++ = (struct lobe){second.w[0].f, whole * weight.w[0].f};
    }
    return MAX_LOBES;
}

/* The mean of the lobes in a set, as bits; returns the spread around it. */
static float gather(const struct lobe *lobes, unsigned set, struct lobe *out)
{
    float spread = 0.0f;
    *out = (struct lobe){0.0f, 0.0f};
    for (unsigned i = 0; i < MAX_LOBES; i++) {
        out->share += set >> i & 1u ? lobes[i].share : 0.0f;
        out->roughness += set >> i & 1u ? lobes[i].share * lobes[i].roughness : 0.0f;
    }
    out->roughness /= out->share > 1e-6f ? out->share : 1.0f;
    for (unsigned i = 0; i < MAX_LOBES; i++) {
        float away = lobes[i].roughness - out->roughness;
        spread += set >> i & 1u ? lobes[i].share * away * away : 0.0f;
    }
    return spread;
}

/* The two lobes that are nearest to all, the first with the rough one: false if one is enough. */
static bool two_lobes(const struct lobe *lobes, struct lobe *out)
{
    enum { ALL = (1 << MAX_LOBES) - 1 };
    float least = gather(lobes, ALL, &out[0]);
    out[1] = (struct lobe){out[0].roughness, 0.0f};
    if (least < 1e-6f)
        return false;
    for (unsigned set = 1; set < ALL; set++) {
        struct lobe pair[2];
        float spread = gather(lobes, set, &pair[0]);
        spread += gather(lobes, ALL & ~set, &pair[1]);
        if (spread < least && pair[0].roughness >= pair[1].roughness) {
            least = spread;
            memcpy(out, pair, sizeof pair);
        }
    }
    return true;
}

static void set_one_lobe(struct ir_graph *g, const struct part *a, ir_ref roughness, ir_ref *out)
{
    out[SLAB_roughness] = roughness;
    out[SLAB_second_roughness] = a->in[SLAB_second_roughness];
    out[SLAB_second_roughness_weight] = ir_const_float(g, 0.0f);
}

/*
 * Two lobes for those of both parts, so that a sharp highlight stays beside a wide one: the best
 * two of constant ones, otherwise one for each part.
 */
static void blend_roughness(const struct slab_blend *blend, const struct part *a,
                            const struct part *b, ir_ref share, ir_ref *out)
{
    struct ir_graph *g = blend->shader->graph;
    struct lobe lobes[MAX_LOBES], best[2];
    bool is_b_alone = is_dark(g, a) && !is_dark(g, b), is_a_alone = is_dark(g, b) && !is_dark(g, a);
    if (is_a_alone || is_b_alone) {
        const ir_ref *in = is_a_alone ? a->in : b->in;
        out[SLAB_roughness] = in[SLAB_roughness];
        out[SLAB_second_roughness] = in[SLAB_second_roughness];
        out[SLAB_second_roughness_weight] = in[SLAB_second_roughness_weight];
        return;
    }
    ir_ref of_a = mean_roughness(g, a), of_b = mean_roughness(g, b);
    if (of_a == of_b || blend->off & 1u << SLAB_SECOND_LOBE) {
        set_one_lobe(g, a, ir_mix(g, of_a, of_b, share), out);
        return;
    }
    if (constant_lobes(g, a, b, share, lobes)) {
        if (!two_lobes(lobes, best)) {
            set_one_lobe(g, a, ir_const_float(g, best[0].roughness), out);
            return;
        }
        out[SLAB_roughness] = ir_const_float(g, best[0].roughness);
        out[SLAB_second_roughness] = ir_const_float(g, best[1].roughness);
        out[SLAB_second_roughness_weight] = ir_const_float(g, best[1].share);
        return;
    }
    /* the first one is also the roughness of the diffuse light */
    bool is_b_first = ir_const_is(g, a->diffuse, 0.0f);
    out[SLAB_roughness] = is_b_first ? of_b : of_a;
    out[SLAB_second_roughness] = is_b_first ? of_a : of_b;
    out[SLAB_second_roughness_weight] = is_b_first ? ir_one_minus(g, share) : share;
}

static void blend_anisotropy(struct shader *shader, const struct part *a, const struct part *b,
                             ir_ref share, ir_ref *out)
{
    struct ir_graph *g = shader->graph;
    ir_ref of_a = a->in[SLAB_anisotropy], of_b = b->in[SLAB_anisotropy];
    ir_ref tangent = a->in[SLAB_tangent], other = b->in[SLAB_tangent];
    out[SLAB_anisotropy] = ir_mix(g, of_a, of_b, share);
    out[SLAB_tangent] = ir_const_is(g, of_a, 0.0f) ? other : tangent;
    if (tangent == other || ir_const_is(g, of_a, 0.0f) || ir_const_is(g, of_b, 0.0f))
        return;
    ir_ref sum = FORMULA(shader, "mx_blend_anisotropies", of_a, of_b, share, out[SLAB_normal],
                         tangent, other);
    out[SLAB_anisotropy] = FORMULA(shader, "mx_blend_anisotropy", sum);
    out[SLAB_tangent] = FORMULA(shader, "mx_blend_tangent", sum, out[SLAB_normal], tangent);
}

static ir_ref roughness_of_fuzz(struct shader *shader, const struct part *part)
{
    return FORMULA(shader, "mx_blend_fuzz_roughness", part->in[SLAB_fuzz_roughness],
                   part->in[SLAB_roughness]);
}

static void blend_fuzz(struct shader *shader, const struct part *a, const struct part *b,
                       ir_ref *out)
{
    struct ir_graph *g = shader->graph;
    ir_ref of_a = ir_mul(g, a->fuzz, a->in[SLAB_fuzz_amount]),
           of_b = ir_mul(g, b->fuzz, b->in[SLAB_fuzz_amount]);
    ir_ref share = FORMULA(shader, "mx_blend_share", of_a, of_b);
    out[SLAB_fuzz_amount] = FORMULA(shader, "mx_blend_fuzz", of_a, of_b);
    out[SLAB_fuzz_color] = ir_mix(g, a->in[SLAB_fuzz_color], b->in[SLAB_fuzz_color], share);
    out[SLAB_fuzz_roughness] = a->in[SLAB_fuzz_roughness];
    if (ir_const_is(g, out[SLAB_fuzz_amount], 0.0f))
        return;
    ir_ref rough_a = roughness_of_fuzz(shader, a), rough_b = roughness_of_fuzz(shader, b);
    out[SLAB_fuzz_roughness] = ir_mix(g, rough_a, rough_b, share);
}

/* The normal follows all light that a part sends back. */
static void blend_normal(struct shader *shader, const struct part *a, const struct part *b,
                         ir_ref *out)
{
    struct ir_graph *g = shader->graph;
    out[SLAB_normal] = a->in[SLAB_normal];
    if (a->in[SLAB_normal] == b->in[SLAB_normal])
        return;
    ir_ref of_a = ir_add(g, ir_mul(g, a->in[SLAB_f0], a->weight), a->diffuse),
           of_b = ir_add(g, ir_mul(g, b->in[SLAB_f0], b->weight), b->diffuse);
    ir_ref share = FORMULA(shader, "mx_blend_share", of_a, of_b);
    out[SLAB_normal] =
        FORMULA(shader, "mx_blend_normal", a->in[SLAB_normal], b->in[SLAB_normal], share);
}

/* The glints of the part that has some: those of a, where both have. */
static void blend_glints(struct ir_graph *g, const struct part *a, const struct part *b,
                         ir_ref *out)
{
    bool are_of_b = is_dark(g, a) || ir_const_is(g, a->in[SLAB_glint_density], 0.0f);
    const ir_ref *in = are_of_b && !is_dark(g, b) ? b->in : a->in;
    out[SLAB_glint_density] = in[SLAB_glint_density];
    out[SLAB_glint_uv] = in[SLAB_glint_uv];
}

/* One tint, of a where both have one, by the share of its part in what interfaces reflect. */
static void blend_tint(struct ir_graph *g, const struct part *a, const struct part *b, ir_ref share,
                       ir_ref *out)
{
    bool is_of_b = ir_const_is(g, a->in[SLAB_specular_lut_weight], 0.0f);
    const ir_ref *in = is_of_b ? b->in : a->in;
    ir_ref part = is_of_b ? share : ir_one_minus(g, share);
    bool is_same = a->in[SLAB_specular_lut] == b->in[SLAB_specular_lut];
    out[SLAB_specular_lut] = in[SLAB_specular_lut];
    out[SLAB_specular_lut_weight] =
        is_same ? ir_mix(g, a->in[SLAB_specular_lut_weight], b->in[SLAB_specular_lut_weight], share)
                : ir_mul(g, in[SLAB_specular_lut_weight], part);
}

/* All but the medium's depth, which differs by operator. */
static void blend_parts(const struct slab_blend *blend, const struct part *a, const struct part *b,
                        ir_ref *out)
{
    struct shader *shader = blend->shader;
    struct ir_graph *g = shader->graph;
    ir_ref share = blend_colors(shader, a, b, out);
    blend_roughness(blend, a, b, share, out);
    blend_normal(shader, a, b, out);
    blend_anisotropy(shader, a, b, share, out);
    blend_fuzz(shader, a, b, out);
    blend_glints(g, a, b, out);
    blend_tint(g, a, b, share, out);
    out[SLAB_f90] = ir_mix(g, a->in[SLAB_f90], b->in[SLAB_f90], share);
    ir_ref of_media = FORMULA(shader, "mx_blend_share", a->diffuse, b->diffuse);
    out[SLAB_phase_anisotropy] =
        ir_mix(g, a->in[SLAB_phase_anisotropy], b->in[SLAB_phase_anisotropy], of_media);
    ir_ref glow = ir_mul(g, a->glow, a->in[SLAB_emission]);
    out[SLAB_emission] = ir_add(g, glow, ir_mul(g, b->glow, b->in[SLAB_emission]));
}

/* ---- A beside B ---- */

static bool is_opaque(const struct ir_graph *g, const struct part *part)
{
    return ir_const_is(g, part->in[SLAB_mean_free_path], 0.0f);
}

/*
 * How often light goes through a medium: out of a sheet once, through a layer on both ways. The
 * media of a mix let through the mean of their powers, not the power of their mean.
 */
static ir_ref ways_of(struct ir_graph *g, const struct slab_spot *spot)
{
    return ir_const_float(g, spot->is_sheet ? CLOSURE_MEAN_WAY : 2.0f * CLOSURE_MEAN_WAY);
}

/* In a body paths mix; a layer lets as much through as both parts. */
static ir_ref path_beside(struct shader *shader, const struct part *a, const struct part *b,
                          ir_ref share, const struct slab_spot *spot)
{
    struct ir_graph *g = shader->graph;
    ir_ref path_a = a->in[SLAB_mean_free_path], path_b = b->in[SLAB_mean_free_path];
    if (!spot->thickness || path_a == path_b || (is_opaque(g, a) && is_opaque(g, b)))
        return ir_mix(g, path_a, path_b, share);
    return FORMULA(shader, "mx_blend_path_beside", path_a, path_b, share, spot->thickness,
                   ways_of(g, spot));
}

static struct part whole_part(struct ir_graph *g, ir_ref slab)
{
    struct part part = {.weight = ir_white(g), .lacks = ir_get(g, slab)->attr};
    part.glow = part.weight;
    part.fuzz = ir_const_float(g, 1.0f);
    memcpy(part.in, ir_args(g, slab), sizeof part.in);
    return part;
}

static void set_share(struct shader *shader, struct part *part, ir_ref share)
{
    part->weight = part->glow = ir_construct(shader->graph, IR_TYPE_VEC3, &share, 1);
    part->fuzz = share;
    part->diffuse = FORMULA(shader, "mx_blend_diffuse", part->in[SLAB_f0],
                            part->in[SLAB_diffuse_albedo], share);
}

/* True where one of the parts is there alone, as <slab_select> has it. A slab has one table. */
static bool is_either(const struct ir_graph *g, const struct part *bg, const struct part *fg,
                      ir_ref mix)
{
    ir_ref of_bg = bg->in[SLAB_specular_lut], of_fg = fg->in[SLAB_specular_lut];
    return slab_is_choice(g, mix) && (!of_bg || !of_fg || of_bg == of_fg);
}

static void select_inputs(struct ir_graph *g, const struct part *bg, const struct part *fg,
                          ir_ref mix, ir_ref *out)
{
    for (int i = 0; i < NUM_SLAB_OPERANDS; i++)
        if (i != SLAB_specular_lut)
            out[i] = ir_mix(g, bg->in[i], fg->in[i], mix);
    bool has_fg = fg->in[SLAB_specular_lut] != 0;
    out[SLAB_specular_lut] = has_fg ? fg->in[SLAB_specular_lut] : bg->in[SLAB_specular_lut];
}

static void blend_beside(const struct slab_blend *blend, struct part *bg, struct part *fg,
                         ir_ref mix, const struct slab_spot *spot, ir_ref *out)
{
    struct ir_graph *g = blend->shader->graph;
    ir_ref share = mix;
    if (is_either(g, bg, fg, mix)) {
        select_inputs(g, bg, fg, mix, out);
        return;
    }
    out[SLAB_coverage] = bg->in[SLAB_coverage];
    if (bg->in[SLAB_coverage] != fg->in[SLAB_coverage]) {
        ir_ref of_bg = ir_mul(g, ir_one_minus(g, mix), bg->in[SLAB_coverage]),
               of_fg = ir_mul(g, mix, fg->in[SLAB_coverage]);
        share = FORMULA(blend->shader, "mx_blend_share", of_bg, of_fg);
        out[SLAB_coverage] = ir_add(g, of_bg, of_fg);
    }
    set_share(blend->shader, bg, ir_one_minus(g, share));
    set_share(blend->shader, fg, share);
    blend_parts(blend, bg, fg, out);
    out[SLAB_mean_free_path] = path_beside(blend->shader, bg, fg, share, spot);
}

/* ---- A over B ---- */

/* The top alone, seen along its normal. */
struct top {
    ir_ref through; /* vec3: of light that comes in and goes out */
    ir_ref shines;  /* vec3: of light from below */
    ir_ref diffuse; /* vec3: what its medium sends back */
};

static struct top look_along_normal(const struct slab_blend *blend, const struct part *a,
                                    const struct part *b, ir_ref thickness)
{
    struct shader *shader = blend->shader;
    struct ir_graph *g = shader->graph;
    /* in the frame of the surface, so that constant slabs stay constant */
    ir_ref in[NUM_SLAB_OPERANDS], normal = ir_axis(g, 2);
    memcpy(in, a->in, sizeof in);
    in[SLAB_normal] = normal;
    in[SLAB_tangent] = ir_axis(g, 0);
    struct closure_point point = {.normal = normal, .view = normal};
    struct closure_host host = *blend->host->closures;
    host.point = &point;
    ir_ref none = ir_const_float(g, 0.0f), one = ir_const_float(g, 1.0f);
    struct slab_place place = {
        .thickness = thickness,
        .below = FORMULA(shader, "mx_blend_seen", b->in[SLAB_f0], b->in[SLAB_diffuse_albedo]),
        .is_body = none,
        .scatters = none,
        .is_sheet = one,
        .walks = none,
        .unit = one};
    ir_ref lobes = blend->host->lobes(blend->host->user_data, in, &place);
    ir_ref mean_way = ir_const_float(g, CLOSURE_MEAN_WAY);
    struct closure_list list;
    struct top top = {.through = closure_throughput(shader, &host, lobes, mean_way)};
    top.shines = closure_throughput(shader, &host, lobes, none);
    top.diffuse = ir_black(g);
    closure_flatten(shader, &host, lobes, &list);
    for (uint32_t i = 0; i < list.leaves.len; i++) {
        const struct closure_leaf *leaf = &list.leaves.items[i];
        if (!closure_has(shader, &host, leaf->leaf, LEAF_WAY))
            continue; /* only media reflect along all ways */
        ir_ref albedo = closure_call(shader, &host, leaf->leaf, LEAF_ALBEDO, NULL);
        ir_ref light = ir_mul(g, albedo, closure_weight(shader, leaf, mean_way));
        top.diffuse = ir_add(g, top.diffuse, ir_convert(g, IR_TYPE_VEC3, light));
    }
    return top;
}

/* Depths add up; an opaque base, or the scattering one of a body, keeps its medium. */
static void blend_depths(struct shader *shader, const struct part *a, const struct part *b,
                         ir_ref thickness, const struct slab_spot *spot, ir_ref *out)
{
    struct ir_graph *g = shader->graph;
    ir_ref path = b->in[SLAB_mean_free_path];
    bool scatters = !ir_const_is(g, b->in[SLAB_diffuse_albedo], 0.0f);
    out[SLAB_mean_free_path] = path;
    if (is_opaque(g, b) || !spot->thickness || ir_const_is(g, b->weight, 0.0f))
        return;
    ir_ref depth_a = FORMULA(shader, "mx_blend_depth", a->in[SLAB_mean_free_path], thickness,
                             ways_of(g, spot), a->in[SLAB_coverage]);
    ir_ref depth_b = FORMULA(shader, "mx_blend_depth", path, spot->thickness);
    out[SLAB_mean_free_path] =
        FORMULA(shader, "mx_blend_path_over", depth_a, depth_b, spot->thickness);
    if (!scatters && ir_const_is(g, a->in[SLAB_diffuse_albedo], 0.0f))
        return;
    out[SLAB_diffuse_albedo] = FORMULA(shader, "mx_blend_albedo_over", a->in[SLAB_diffuse_albedo],
                                       b->in[SLAB_diffuse_albedo], depth_a, depth_b);
}

/* The light of both over the coverage of both, because the slab is there that often. */
static void divide_by(struct shader *shader, struct part *part, ir_ref coverage)
{
    if (ir_const_is(shader->graph, coverage, 1.0f))
        return;
    part->weight = FORMULA(shader, "mx_blend_per_coverage", part->weight, coverage);
    part->diffuse = FORMULA(shader, "mx_blend_per_coverage", part->diffuse, coverage);
    part->fuzz = FORMULA(shader, "mx_blend_per_coverage", part->fuzz, coverage);
    part->glow = FORMULA(shader, "mx_blend_per_coverage", part->glow, coverage);
}

static void blend_over(const struct slab_blend *blend, struct part *a, struct part *b,
                       ir_ref thickness, const struct slab_spot *spot, ir_ref *out)
{
    struct shader *shader = blend->shader;
    struct ir_graph *g = shader->graph;
    if (!(a->lacks & 1u << SLAB_ROUGHNESS)) {
        slab_widen(shader, slab_spread(shader, a->in), b->in);
        ir_ref scattering = slab_scattering(shader, a->in);
        slab_even(shader, scattering ? ir_op2(g, IR_MUL, scattering, thickness) : 0, b->in);
    }
    struct top top = look_along_normal(blend, a, b, thickness);
    ir_ref coverage = a->in[SLAB_coverage], of_b = b->in[SLAB_coverage];
    out[SLAB_coverage] = FORMULA(shader, "mx_blend_coverage", coverage, of_b);
    set_share(shader, a, coverage);
    a->diffuse = ir_mul(g, top.diffuse, coverage);
    b->weight = FORMULA(shader, "mx_blend_below", top.through, coverage, of_b);
    b->diffuse =
        FORMULA(shader, "mx_blend_diffuse", b->in[SLAB_f0], b->in[SLAB_diffuse_albedo], b->weight);
    b->fuzz = FORMULA(shader, "mx_mean", b->weight);
    b->glow = FORMULA(shader, "mx_blend_below", top.shines, coverage, of_b);
    divide_by(shader, a, out[SLAB_coverage]);
    divide_by(shader, b, out[SLAB_coverage]);
    blend_parts(blend, a, b, out);
    blend_depths(shader, a, b, thickness, spot, out);
}

/* ---- A plus B, A times a colour ---- */

static void blend_sum(const struct slab_blend *blend, struct part *a, struct part *b,
                      const struct slab_spot *spot, ir_ref *out)
{
    struct shader *shader = blend->shader;
    ir_ref one = ir_const_float(shader->graph, 1.0f);
    bool is_same = a->in[SLAB_coverage] == b->in[SLAB_coverage];
    out[SLAB_coverage] = is_same ? a->in[SLAB_coverage] : one;
    set_share(shader, a, is_same ? one : a->in[SLAB_coverage]);
    set_share(shader, b, is_same ? one : b->in[SLAB_coverage]);
    blend_parts(blend, a, b, out);
    ir_ref share = FORMULA(shader, "mx_blend_share", a->diffuse, b->diffuse);
    out[SLAB_mean_free_path] = path_beside(shader, a, b, share, spot);
}

static void blend_scaled(struct shader *shader, const struct part *a, ir_ref factor, ir_ref *out)
{
    struct ir_graph *g = shader->graph;
    ir_ref weight = ir_share(g, ir_convert(g, IR_TYPE_VEC3, factor));
    memcpy(out, a->in, sizeof a->in);
    out[SLAB_f0] = ir_mul(g, a->in[SLAB_f0], weight);
    ir_ref diffuse =
        FORMULA(shader, "mx_blend_diffuse", a->in[SLAB_f0], a->in[SLAB_diffuse_albedo], weight);
    out[SLAB_diffuse_albedo] = FORMULA(shader, "mx_blend_albedo", out[SLAB_f0], diffuse);
    ir_ref mean = FORMULA(shader, "mx_mean", weight);
    out[SLAB_fuzz_amount] = ir_mul(g, a->in[SLAB_fuzz_amount], mean);
    out[SLAB_emission] = ir_mul(g, a->in[SLAB_emission], weight);
}

/* ---- Operators ---- */

/* The slab below coverages; 0: there is none. */
static ir_ref covered_slab(const struct ir_graph *g, ir_ref ref)
{
    while (ref && ir_get(g, ref)->op == IR_CLOSURE_MIX
           && (!ir_arg(g, ref, 0) || !ir_arg(g, ref, 1)))
        ref = ir_arg(g, ref, 0) ? ir_arg(g, ref, 0) : ir_arg(g, ref, 1);
    return ref && ir_get(g, ref)->op == IR_SLAB ? ref : 0;
}

bool slab_can_blend(const struct ir_graph *g, ir_ref ref)
{
    const struct ir_node *node = ir_get(g, ref);
    if (node->type != IR_TYPE_BSDF)
        return false;
    if (node->op == IR_CLOSURE_SCALE)
        return covered_slab(g, ir_arg(g, ref, 0)) != 0;
    if (!slabs_is_layer(g, ref) && node->op != IR_CLOSURE_MIX && node->op != IR_CLOSURE_ADD)
        return false;
    ir_ref a = ir_arg(g, ref, 0), b = ir_arg(g, ref, 1);
    return (!a || covered_slab(g, a)) && (!b || covered_slab(g, b));
}

/* The inputs of a slab below coverages, with its coverage. */
static struct part part_of(struct ir_graph *g, ir_ref ref)
{
    ir_ref coverage = ir_const_float(g, 1.0f), slab = covered_slab(g, ref);
    for (; ref != slab; ref = ir_arg(g, ref, 0) ? ir_arg(g, ref, 0) : ir_arg(g, ref, 1)) {
        ir_ref mix = ir_arg(g, ref, 2);
        coverage = ir_mul(g, coverage, ir_arg(g, ref, 0) ? ir_one_minus(g, mix) : mix);
    }
    struct part part = whole_part(g, slab);
    part.in[SLAB_coverage] = ir_mul(g, part.in[SLAB_coverage], coverage);
    return part;
}

ir_ref slab_blended(const struct slab_blend *blend, const struct slab_spot *spot)
{
    struct ir_graph *g = blend->shader->graph;
    const struct ir_node node = *ir_get(g, spot->ref);
    ir_ref first = ir_arg(g, spot->ref, 0), second = ir_arg(g, spot->ref, 1);
    ir_ref out[NUM_SLAB_OPERANDS];
    struct part a;
    assert(slab_can_blend(g, spot->ref) && (first || second));
    ir_push_origin_of(g, spot->ref);
    if (node.op == IR_CLOSURE_SCALE) {
        a = part_of(g, first);
        blend_scaled(blend->shader, &a, second, out);
    } else if (!first || !second) {
        a = part_of(g, node.op == IR_CLOSURE_MIX ? spot->ref : first ? first : second);
        memcpy(out, a.in, sizeof out);
    } else {
        a = part_of(g, first);
        struct part b = part_of(g, second);
        if (slabs_is_layer(g, spot->ref))
            blend_over(blend, &a, &b, slabs_layer_thickness(g, spot->ref), spot, out);
        else if (node.op == IR_CLOSURE_ADD)
            blend_sum(blend, &a, &b, spot, out);
        else
            blend_beside(blend, &a, &b, ir_arg(g, spot->ref, 2), spot, out);
        bool hides = slabs_is_layer(g, spot->ref) || node.op == IR_CLOSURE_ADD;
        uint32_t regime = hides ? (a.lacks | b.lacks) & SLAB_NEVER_CLEAR : 0;
        a.lacks = (a.lacks & b.lacks) | regime;
    }
    ir_ref slab = ir_build(g, IR_SLAB, IR_TYPE_BSDF, a.lacks, out, NUM_SLAB_OPERANDS);
    ir_pop_origin(g);
    return slab;
}
