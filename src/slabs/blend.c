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

/* ---- Arithmetic ---- */

static ir_ref num(struct ir_graph *g, float f)
{
    return ir_const_float(g, f);
}

static ir_ref white(struct ir_graph *g)
{
    return ir_const_splat(g, IR_TYPE_VEC3, 1.0f);
}

static ir_ref mul(struct ir_graph *g, ir_ref a, ir_ref b)
{
    return ir_op2(g, IR_MUL, a, b);
}

static ir_ref add(struct ir_graph *g, ir_ref a, ir_ref b)
{
    return ir_op2(g, IR_ADD, a, b);
}

static ir_ref mean(struct ir_graph *g, ir_ref color)
{
    return ir_op2(g, IR_DOT, color, ir_const_splat(g, IR_TYPE_VEC3, 1.0f / 3.0f));
}

static ir_ref at_least(struct ir_graph *g, ir_ref x, float low)
{
    ir_ref limit = ir_const_splat(g, ir_type_of(g, x), low);
    return ir_op2(g, IR_MAX, x, limit);
}

static ir_ref between(struct ir_graph *g, ir_ref x, float low, float high)
{
    ir_ref least = num(g, low), most = num(g, high);
    return ir_op3(g, IR_CLAMP, x, least, most);
}

/* b / (a + b); 0 where both are 0. */
static ir_ref share_of(struct ir_graph *g, ir_ref a, ir_ref b)
{
    if (ir_const_is(g, a, 0.0f) && !ir_const_is(g, b, 0.0f))
        return num(g, 1.0f);
    return ir_op2(g, IR_DIV, b, at_least(g, add(g, a, b), 1e-6f));
}

static ir_ref mixed(struct ir_graph *g, ir_ref a, ir_ref b, ir_ref share)
{
    return a == b ? a : ir_op3(g, IR_MIX, a, b, share);
}

/* The part of the light behind the interface. */
static ir_ref entering(struct ir_graph *g, ir_ref f0)
{
    return at_least(g, closure_one_minus(g, f0), 0.001f);
}

static ir_ref scattered(struct ir_graph *g, const ir_ref *in)
{
    ir_ref below = closure_one_minus(g, in[SLAB_f0]);
    return mul(g, below, in[SLAB_diffuse_albedo]);
}

/* ---- The slab of two parts ---- */

/* f0 and albedo; returns the share of b in what interfaces reflect. */
static ir_ref blend_colors(struct ir_graph *g, const struct part *a, const struct part *b,
                           ir_ref *out)
{
    ir_ref of_a = mul(g, a->in[SLAB_f0], a->weight), of_b = mul(g, b->in[SLAB_f0], b->weight);
    out[SLAB_f0] = between(g, add(g, of_a, of_b), 0.0f, 1.0f);
    ir_ref below = entering(g, out[SLAB_f0]), diffuse = add(g, a->diffuse, b->diffuse);
    out[SLAB_diffuse_albedo] = between(g, ir_op2(g, IR_DIV, diffuse, below), 0.0f, 1.0f);
    ir_ref mean_a = mean(g, of_a), mean_b = mean(g, of_b);
    return share_of(g, mean_a, mean_b);
}

/* True for a part whose interface sends nothing back. */
static bool is_dark(const struct ir_graph *g, const struct part *part)
{
    return ir_const_is(g, part->in[SLAB_f0], 0.0f);
}

static ir_ref mean_roughness(struct ir_graph *g, const struct part *part)
{
    return mixed(g, part->in[SLAB_roughness], part->in[SLAB_second_roughness],
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
    out[SLAB_second_roughness_weight] = num(g, 0.0f);
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
        set_one_lobe(g, a, mixed(g, of_a, of_b, share), out);
        return;
    }
    if (constant_lobes(g, a, b, share, lobes)) {
        if (!two_lobes(lobes, best)) {
            set_one_lobe(g, a, num(g, best[0].roughness), out);
            return;
        }
        out[SLAB_roughness] = num(g, best[0].roughness);
        out[SLAB_second_roughness] = num(g, best[1].roughness);
        out[SLAB_second_roughness_weight] = num(g, best[1].share);
        return;
    }
    /* the first one is also the roughness of the diffuse light */
    bool is_b_first = ir_const_is(g, a->diffuse, 0.0f);
    out[SLAB_roughness] = is_b_first ? of_b : of_a;
    out[SLAB_second_roughness] = is_b_first ? of_a : of_b;
    out[SLAB_second_roughness_weight] = is_b_first ? closure_one_minus(g, share) : share;
}

/* Anisotropies along tangents add like vectors of the doubled angle. */
static void blend_anisotropy(struct ir_graph *g, const struct part *a, const struct part *b,
                             ir_ref share, ir_ref *out)
{
    ir_ref of_a = a->in[SLAB_anisotropy], of_b = b->in[SLAB_anisotropy];
    ir_ref tangent = a->in[SLAB_tangent], other = b->in[SLAB_tangent];
    out[SLAB_anisotropy] = mixed(g, of_a, of_b, share);
    out[SLAB_tangent] = ir_const_is(g, of_a, 0.0f) ? other : tangent;
    if (tangent == other || ir_const_is(g, of_a, 0.0f) || ir_const_is(g, of_b, 0.0f))
        return;
    ir_ref across = ir_op2(g, IR_CROSS, out[SLAB_normal], tangent);
    ir_ref c = ir_op2(g, IR_DOT, tangent, other), s = ir_op2(g, IR_DOT, across, other);
    ir_ref weight = mul(g, share, of_b), even = mul(g, closure_one_minus(g, share), of_a);
    ir_ref cosine = mul(g, c, c), twice = mul(g, add(g, s, s), c);
    cosine = ir_op2(g, IR_SUB, cosine, mul(g, s, s));
    ir_ref x = add(g, even, mul(g, weight, cosine)), y = mul(g, weight, twice);
    ir_ref square = mul(g, x, x);
    out[SLAB_anisotropy] = ir_op1(g, IR_SQRT, add(g, square, mul(g, y, y)));
    ir_ref away = at_least(g, ir_op1(g, IR_ABS, x), 1e-6f); /* atan(0, 0) is open */
    ir_ref is_back = ir_op2(g, IR_LT, x, num(g, 0.0f));
    ir_ref front = ir_op3(g, IR_SELECT, is_back, ir_op1(g, IR_NEG, away), away);
    ir_ref angle = ir_op2(g, IR_ATAN2, y, front), half = num(g, 0.5f);
    angle = mul(g, angle, half);
    ir_ref along = mul(g, tangent, ir_op1(g, IR_COS, angle));
    out[SLAB_tangent] = add(g, along, mul(g, across, ir_op1(g, IR_SIN, angle)));
}

static ir_ref roughness_of_fuzz(struct ir_graph *g, const struct part *part)
{
    ir_ref own = part->in[SLAB_fuzz_roughness];
    ir_ref is_slabs = ir_op2(g, IR_LT, own, num(g, 0.0f));
    return ir_op3(g, IR_SELECT, is_slabs, part->in[SLAB_roughness], own);
}

static void blend_fuzz(struct ir_graph *g, const struct part *a, const struct part *b, ir_ref *out)
{
    ir_ref of_a = mul(g, a->fuzz, a->in[SLAB_fuzz_amount]),
           of_b = mul(g, b->fuzz, b->in[SLAB_fuzz_amount]);
    ir_ref share = share_of(g, of_a, of_b);
    out[SLAB_fuzz_amount] = between(g, add(g, of_a, of_b), 0.0f, 1.0f);
    out[SLAB_fuzz_color] = mixed(g, a->in[SLAB_fuzz_color], b->in[SLAB_fuzz_color], share);
    out[SLAB_fuzz_roughness] = a->in[SLAB_fuzz_roughness];
    if (ir_const_is(g, out[SLAB_fuzz_amount], 0.0f))
        return;
    ir_ref rough_a = roughness_of_fuzz(g, a), rough_b = roughness_of_fuzz(g, b);
    out[SLAB_fuzz_roughness] = mixed(g, rough_a, rough_b, share);
}

/* The normal follows all light that a part sends back. */
static void blend_normal(struct ir_graph *g, const struct part *a, const struct part *b,
                         ir_ref *out)
{
    out[SLAB_normal] = a->in[SLAB_normal];
    if (a->in[SLAB_normal] == b->in[SLAB_normal])
        return;
    ir_ref of_a = add(g, mul(g, a->in[SLAB_f0], a->weight), a->diffuse),
           of_b = add(g, mul(g, b->in[SLAB_f0], b->weight), b->diffuse);
    ir_ref mean_a = mean(g, of_a), mean_b = mean(g, of_b);
    ir_ref normal = mixed(g, a->in[SLAB_normal], b->in[SLAB_normal], share_of(g, mean_a, mean_b));
    out[SLAB_normal] = ir_op1(g, IR_NORMALIZE, normal);
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
    ir_ref part = is_of_b ? share : closure_one_minus(g, share);
    bool is_same = a->in[SLAB_specular_lut] == b->in[SLAB_specular_lut];
    out[SLAB_specular_lut] = in[SLAB_specular_lut];
    out[SLAB_specular_lut_weight] =
        is_same ? mixed(g, a->in[SLAB_specular_lut_weight], b->in[SLAB_specular_lut_weight], share)
                : mul(g, in[SLAB_specular_lut_weight], part);
}

/* All but the medium's depth, which differs by operator. */
static void blend_parts(const struct slab_blend *blend, const struct part *a, const struct part *b,
                        ir_ref *out)
{
    struct ir_graph *g = blend->shader->graph;
    ir_ref share = blend_colors(g, a, b, out);
    blend_roughness(blend, a, b, share, out);
    blend_normal(g, a, b, out);
    blend_anisotropy(g, a, b, share, out);
    blend_fuzz(g, a, b, out);
    blend_glints(g, a, b, out);
    blend_tint(g, a, b, share, out);
    out[SLAB_f90] = mixed(g, a->in[SLAB_f90], b->in[SLAB_f90], share);
    ir_ref light_a = mean(g, a->diffuse), light_b = mean(g, b->diffuse);
    ir_ref of_media = share_of(g, light_a, light_b);
    out[SLAB_phase_anisotropy] =
        mixed(g, a->in[SLAB_phase_anisotropy], b->in[SLAB_phase_anisotropy], of_media);
    ir_ref glow = mul(g, a->glow, a->in[SLAB_emission]);
    out[SLAB_emission] = add(g, glow, mul(g, b->glow, b->in[SLAB_emission]));
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
    return num(g, spot->is_sheet ? CLOSURE_MEAN_WAY : 2.0f * CLOSURE_MEAN_WAY);
}

/* exp(-ways thickness / path) */
static ir_ref let_through(struct ir_graph *g, ir_ref path, ir_ref thickness, ir_ref ways)
{
    ir_ref depth = mul(g, thickness, ways);
    depth = ir_op2(g, IR_DIV, depth, at_least(g, path, 1e-6f));
    return ir_op1(g, IR_EXP, ir_op1(g, IR_NEG, depth));
}

/* -log(through) / ways */
static ir_ref depth_of(struct ir_graph *g, ir_ref through, ir_ref ways)
{
    ir_ref depth = ir_op1(g, IR_NEG, ir_op1(g, IR_LOG, between(g, through, 1e-30f, 0.99999f)));
    return ir_op2(g, IR_DIV, depth, ways);
}

/* In a body paths mix; a layer lets as much through as both parts. */
static ir_ref path_beside(struct ir_graph *g, const struct part *a, const struct part *b,
                          ir_ref share, const struct slab_spot *spot)
{
    ir_ref path_a = a->in[SLAB_mean_free_path], path_b = b->in[SLAB_mean_free_path];
    if (!spot->thickness || path_a == path_b || (is_opaque(g, a) && is_opaque(g, b)))
        return mixed(g, path_a, path_b, share);
    ir_ref ways = ways_of(g, spot);
    ir_ref through_a = let_through(g, path_a, spot->thickness, ways),
           through_b = let_through(g, path_b, spot->thickness, ways);
    ir_ref depth = depth_of(g, mixed(g, through_a, through_b, share), ways);
    return at_least(g, ir_op2(g, IR_DIV, spot->thickness, depth), 1e-6f);
}

static struct part whole_part(struct ir_graph *g, ir_ref slab)
{
    struct part part = {.weight = white(g), .lacks = ir_get(g, slab)->attr};
    part.glow = part.weight;
    part.fuzz = num(g, 1.0f);
    memcpy(part.in, ir_args(g, slab), sizeof part.in);
    return part;
}

static void set_share(struct ir_graph *g, struct part *part, ir_ref share)
{
    part->weight = part->glow = ir_construct(g, IR_TYPE_VEC3, &share, 1);
    part->fuzz = share;
    part->diffuse = mul(g, scattered(g, part->in), share);
}

static bool is_zero_or_one(const struct ir_graph *g, ir_ref ref)
{
    return ir_const_is(g, ref, 0.0f) || ir_const_is(g, ref, 1.0f);
}

/* True where one of the parts is there alone, as <slab_select> has it. A slab has one table. */
static bool is_either(const struct ir_graph *g, const struct part *bg, const struct part *fg,
                      ir_ref mix)
{
    ir_ref of_bg = bg->in[SLAB_specular_lut], of_fg = fg->in[SLAB_specular_lut];
    return ir_get(g, mix)->op == IR_SELECT && is_zero_or_one(g, ir_arg(g, mix, 1))
           && is_zero_or_one(g, ir_arg(g, mix, 2)) && (!of_bg || !of_fg || of_bg == of_fg);
}

static void select_inputs(struct ir_graph *g, const struct part *bg, const struct part *fg,
                          ir_ref mix, ir_ref *out)
{
    for (int i = 0; i < NUM_SLAB_OPERANDS; i++)
        if (i != SLAB_specular_lut)
            out[i] = mixed(g, bg->in[i], fg->in[i], mix);
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
        ir_ref of_bg = mul(g, closure_one_minus(g, mix), bg->in[SLAB_coverage]),
               of_fg = mul(g, mix, fg->in[SLAB_coverage]);
        share = share_of(g, of_bg, of_fg);
        out[SLAB_coverage] = add(g, of_bg, of_fg);
    }
    set_share(g, bg, closure_one_minus(g, share));
    set_share(g, fg, share);
    blend_parts(blend, bg, fg, out);
    out[SLAB_mean_free_path] = path_beside(g, bg, fg, share, spot);
}

/* ---- A over B ---- */

/* The top alone, seen along its normal. */
struct top {
    ir_ref through; /* vec3: of light that comes in and goes out */
    ir_ref shines;  /* vec3: of light from below */
    ir_ref diffuse; /* vec3: what its medium sends back */
};

static ir_ref axis(struct ir_graph *g, unsigned which)
{
    struct ir_value value = {.type = IR_TYPE_VEC3};
    value.w[which].f = 1.0f;
    return ir_const(g, &value);
}

static struct top look_along_normal(const struct slab_blend *blend, const struct part *a,
                                    const struct part *b, ir_ref thickness)
{
    struct shader *shader = blend->shader;
    struct ir_graph *g = shader->graph;
    /* in the frame of the surface, so that constant slabs stay constant */
    ir_ref in[NUM_SLAB_OPERANDS], normal = axis(g, 2);
    memcpy(in, a->in, sizeof in);
    in[SLAB_normal] = normal;
    in[SLAB_tangent] = axis(g, 0);
    struct closure_point point = {.normal = normal, .view = normal};
    struct closure_host host = *blend->host->closures;
    host.point = &point;
    ir_ref below = add(g, b->in[SLAB_f0], scattered(g, b->in));
    struct slab_place place = {.thickness = thickness, .below = between(g, below, 0.0f, 1.0f)};
    place.is_body = place.walks = num(g, 0.0f);
    place.unit = num(g, 1.0f);
    ir_ref lobes = blend->host->lobes(blend->host->user_data, in, &place);
    ir_ref mean_way = num(g, CLOSURE_MEAN_WAY);
    struct closure_list list;
    struct top top = {.through = closure_throughput(shader, &host, lobes, mean_way)};
    top.shines = closure_throughput(shader, &host, lobes, num(g, 0.0f));
    top.diffuse = ir_const_splat(g, IR_TYPE_VEC3, 0.0f);
    closure_flatten(shader, &host, lobes, &list);
    for (uint32_t i = 0; i < list.leaves.len; i++) {
        const struct closure_leaf *leaf = &list.leaves.items[i];
        if (!closure_has(shader, &host, leaf->leaf, LEAF_WAY))
            continue; /* only media reflect along all ways */
        ir_ref albedo = closure_call(shader, &host, leaf->leaf, LEAF_ALBEDO, NULL);
        ir_ref light = mul(g, albedo, closure_weight(shader, leaf, mean_way));
        top.diffuse = add(g, top.diffuse, ir_convert(g, IR_TYPE_VEC3, light));
    }
    return top;
}

/* 1 - coverage (1 - x) */
static ir_ref where_covered(struct ir_graph *g, ir_ref coverage, ir_ref x)
{
    return closure_one_minus(g, mul(g, coverage, closure_one_minus(g, x)));
}

/* Depths add up; an opaque base, or the scattering one of a body, keeps its medium. */
static void blend_depths(struct ir_graph *g, const struct part *a, const struct part *b,
                         ir_ref thickness, const struct slab_spot *spot, ir_ref *out)
{
    ir_ref path = b->in[SLAB_mean_free_path];
    bool scatters = !ir_const_is(g, b->in[SLAB_diffuse_albedo], 0.0f);
    out[SLAB_mean_free_path] = path;
    if (is_opaque(g, b) || !spot->thickness || ir_const_is(g, b->weight, 0.0f))
        return;
    ir_ref ways = ways_of(g, spot);
    ir_ref through = let_through(g, a->in[SLAB_mean_free_path], thickness, ways);
    ir_ref depth_a = depth_of(g, where_covered(g, a->in[SLAB_coverage], through), ways);
    ir_ref depth_b = ir_op2(g, IR_DIV, spot->thickness, at_least(g, path, 1e-6f));
    ir_ref depth = at_least(g, add(g, depth_a, depth_b), 1e-6f);
    out[SLAB_mean_free_path] = ir_op2(g, IR_DIV, spot->thickness, depth);
    if (!scatters && ir_const_is(g, a->in[SLAB_diffuse_albedo], 0.0f))
        return;
    ir_ref share = ir_op2(g, IR_DIV, depth_b, depth);
    out[SLAB_diffuse_albedo] =
        mixed(g, a->in[SLAB_diffuse_albedo], b->in[SLAB_diffuse_albedo], share);
}

/* The light of both over the coverage of both, because the slab is there that often. */
static void divide_by(struct ir_graph *g, struct part *part, ir_ref coverage)
{
    if (ir_const_is(g, coverage, 1.0f))
        return;
    ir_ref some = at_least(g, coverage, 1e-6f);
    part->weight = ir_op2(g, IR_DIV, part->weight, some);
    part->diffuse = ir_op2(g, IR_DIV, part->diffuse, some);
    part->fuzz = ir_op2(g, IR_DIV, part->fuzz, some);
    part->glow = ir_op2(g, IR_DIV, part->glow, some);
}

static void blend_over(const struct slab_blend *blend, struct part *a, struct part *b,
                       ir_ref thickness, const struct slab_spot *spot, ir_ref *out)
{
    struct ir_graph *g = blend->shader->graph;
    if (!(a->lacks & 1u << SLAB_ROUGHNESS))
        slab_widen(g, slab_spread(g, a->in), b->in);
    struct top top = look_along_normal(blend, a, b, thickness);
    ir_ref coverage = a->in[SLAB_coverage], of_b = b->in[SLAB_coverage];
    ir_ref missing = closure_one_minus(g, coverage);
    missing = mul(g, missing, closure_one_minus(g, of_b));
    out[SLAB_coverage] = closure_one_minus(g, missing);
    set_share(g, a, coverage);
    a->diffuse = mul(g, top.diffuse, coverage);
    b->weight = mul(g, where_covered(g, coverage, top.through), of_b);
    b->diffuse = mul(g, scattered(g, b->in), b->weight);
    b->fuzz = mean(g, b->weight);
    b->glow = mul(g, where_covered(g, coverage, top.shines), of_b);
    divide_by(g, a, out[SLAB_coverage]);
    divide_by(g, b, out[SLAB_coverage]);
    blend_parts(blend, a, b, out);
    blend_depths(g, a, b, thickness, spot, out);
}

/* ---- A plus B, A times a colour ---- */

static void blend_sum(const struct slab_blend *blend, struct part *a, struct part *b,
                      const struct slab_spot *spot, ir_ref *out)
{
    struct ir_graph *g = blend->shader->graph;
    bool is_same = a->in[SLAB_coverage] == b->in[SLAB_coverage];
    out[SLAB_coverage] = is_same ? a->in[SLAB_coverage] : num(g, 1.0f);
    set_share(g, a, is_same ? num(g, 1.0f) : a->in[SLAB_coverage]);
    set_share(g, b, is_same ? num(g, 1.0f) : b->in[SLAB_coverage]);
    blend_parts(blend, a, b, out);
    ir_ref light_a = mean(g, a->diffuse), light_b = mean(g, b->diffuse);
    out[SLAB_mean_free_path] = path_beside(g, a, b, share_of(g, light_a, light_b), spot);
}

static void blend_scaled(struct ir_graph *g, const struct part *a, ir_ref factor, ir_ref *out)
{
    ir_ref weight = between(g, ir_convert(g, IR_TYPE_VEC3, factor), 0.0f, 1.0f);
    memcpy(out, a->in, sizeof a->in);
    out[SLAB_f0] = mul(g, a->in[SLAB_f0], weight);
    ir_ref diffuse = mul(g, scattered(g, a->in), weight);
    out[SLAB_diffuse_albedo] = ir_op2(g, IR_DIV, diffuse, entering(g, out[SLAB_f0]));
    out[SLAB_fuzz_amount] = mul(g, a->in[SLAB_fuzz_amount], mean(g, weight));
    out[SLAB_emission] = mul(g, a->in[SLAB_emission], weight);
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
    ir_ref coverage = num(g, 1.0f), slab = covered_slab(g, ref);
    for (; ref != slab; ref = ir_arg(g, ref, 0) ? ir_arg(g, ref, 0) : ir_arg(g, ref, 1)) {
        ir_ref mix = ir_arg(g, ref, 2);
        coverage = mul(g, coverage, ir_arg(g, ref, 0) ? closure_one_minus(g, mix) : mix);
    }
    struct part part = whole_part(g, slab);
    part.in[SLAB_coverage] = mul(g, part.in[SLAB_coverage], coverage);
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
        blend_scaled(g, &a, second, out);
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
        a.lacks &= b.lacks;
    }
    ir_ref slab = ir_build(g, IR_SLAB, IR_TYPE_BSDF, a.lacks, out, NUM_SLAB_OPERANDS);
    ir_pop_origin(g);
    return slab;
}
