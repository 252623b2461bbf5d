// SPDX-License-Identifier: Apache-2.0
/*
 * Stacks of slabs without mxgen: trees, their documents, and the light that they reflect. The truth
 * is a position-free random walk (Guo, Hašan, Zhao 2018, "Position-Free Monte Carlo Simulation for
 * Arbitrary Layered BSDFs"): each path draws which branch of a mix and which covered slab is there,
 * then follows light from the viewer through the media. All media have the index 1.5, and no
 * interface reflects.
 */
#ifndef MXG_TESTS_UNIT_SLAB_STACKS_H
#define MXG_TESTS_UNIT_SLAB_STACKS_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { STACK_NODES = 32, STACK_SLABS = 16, STACK_TEXT = 1 << 14 };

enum stack_kind { STACK_SLAB, STACK_LAYER, STACK_MIX, STACK_COVER };

struct stack_node {
    enum stack_kind kind;
    int a, b;           /* operands: top and base, fg and bg, the covered node */
    double share;       /* of fg; how likely a covered node is there */
    double thickness;   /* of a layer, cm */
    double albedo, mfp; /* of a slab; mfp 0 is opaque */
    double f0, roughness, anisotropy;
    double second_roughness, second_weight; /* of the second lobe */
    double fuzz;
};

struct stack {
    struct stack_node nodes[STACK_NODES]; /* operands first; the last one is the root */
    int num_nodes;
    int is_sheet; /* 0.01 cm thick */
};

/* ---- Numbers ---- */

static uint64_t stack_state = 0x853c49e6748fea9bULL;

/* A test begins its own sequence, whatever tests ran before. */
static inline void stack_seed(uint64_t number)
{
    stack_state = 0x853c49e6748fea9bULL + number * 0x9e3779b97f4a7c15ULL;
}

/* PCG (O'Neill 2014), in (0, 1). */
static inline double stack_random(void)
{
    stack_state = stack_state * 6364136223846793005ULL + 1442695040888963407ULL;
    uint32_t word = (uint32_t)(((stack_state >> 18) ^ stack_state) >> 27),
             turn = (uint32_t)(stack_state >> 59);
    word = (word >> turn) | (word << ((0u - turn) & 31u));
    return (word + 0.5) / 4294967296.0;
}

static inline double stack_between(double low, double high)
{
    return low + (high - low) * stack_random();
}

static inline double stack_way(double cosine)
{
    return 1.0 / sqrt(1.0 - (1.0 - cosine * cosine) / 2.25);
}

/* ---- Trees ---- */

static inline int stack_add(struct stack *stack, struct stack_node node)
{
    stack->nodes[stack->num_nodes] = node;
    return stack->num_nodes++;
}

/* A slab, alone, with a coverage, or beside another. `clear`: its medium does not scatter. */
static inline int stack_random_top(struct stack *stack, int clear)
{
    struct stack_node slab = {.kind = STACK_SLAB, .roughness = 0.5};
    slab.albedo = clear ? 0.0 : stack_between(0.3, 1.0);
    slab.mfp = 0.01 / stack_between(0.05, 3.0);
    int a = stack_add(stack, slab);
    double choice = stack_random();
    if (choice < 0.35)
        return a;
    if (choice < 0.7)
        return stack_add(stack, (struct stack_node){
                                    .kind = STACK_COVER, .a = a, .share = stack_between(0.1, 0.9)});
    slab.mfp = 0.01 / stack_between(0.05, 3.0);
    int b = stack_add(stack, slab);
    return stack_add(
        stack,
        (struct stack_node){.kind = STACK_MIX, .a = a, .b = b, .share = stack_between(0.1, 0.9)});
}

/* Any interface: one of every two slabs is anisotropic, has a second lobe, or fuzz. */
static inline void stack_random_interface(struct stack_node *slab, double most_f0)
{
    slab->f0 = stack_between(0.0, most_f0);
    slab->roughness = stack_random();
    slab->anisotropy = stack_random() < 0.5 ? stack_between(-0.95, 0.95) : 0.0;
    slab->second_roughness = stack_random();
    slab->second_weight = stack_random() < 0.5 ? stack_random() : 0.0;
    slab->fuzz = stack_random() < 0.5 ? stack_random() : 0.0;
}

/* Tops over an opaque base of this albedo. */
static inline void stack_make(struct stack *stack, int num_tops, int clear, double base_albedo)
{
    stack->num_nodes = stack->is_sheet = 0;
    int below = stack_add(
        stack, (struct stack_node){.kind = STACK_SLAB, .albedo = base_albedo, .roughness = 0.5});
    for (int i = 0; i < num_tops; ++i) {
        int top = stack_random_top(stack, clear);
        below = stack_add(stack, (struct stack_node){
                                     .kind = STACK_LAYER, .a = top, .b = below, .thickness = 0.01});
    }
}

/* A sheet of one or two random slabs whose media scatter. */
static inline void stack_make_sheet(struct stack *stack, int num_layers)
{
    stack->num_nodes = 0;
    stack->is_sheet = 1;
    int below = stack_random_top(stack, 0);
    for (int i = 1; i < num_layers; ++i) {
        int top = stack_random_top(stack, 0);
        below = stack_add(stack, (struct stack_node){
                                     .kind = STACK_LAYER, .a = top, .b = below, .thickness = 0.01});
    }
}

/* A tree in one line; `thickness` is that of slabs which lie in no top. */
static inline void stack_print(const struct stack *stack, int node, double thickness, FILE *out)
{
    const struct stack_node *n = &stack->nodes[node];
    switch (n->kind) {
    case STACK_SLAB: fprintf(out, "slab(%.2f", n->albedo); break;
    case STACK_LAYER: fputs("layer(", out); break;
    case STACK_MIX: fprintf(out, "mix(%.2f, ", n->share); break;
    case STACK_COVER: fprintf(out, "cover(%.2f, ", n->share); break;
    }
    if (n->kind != STACK_SLAB)
        stack_print(stack, n->a, n->kind == STACK_LAYER ? n->thickness : thickness, out);
    else if (n->mfp > 0.0)
        fprintf(out, ", %.2f", thickness / n->mfp);
    if (n->kind == STACK_LAYER || n->kind == STACK_MIX) {
        fputs(", ", out);
        stack_print(stack, n->b, thickness, out);
    }
    fputs(")", out);
}

/* ---- Documents ---- */

static inline int stack_write_node(const struct stack_node *node, int i, char *out, size_t room)
{
    switch (node->kind) {
    case STACK_SLAB:
        return snprintf(
            out, room,
            "<slab name='n%d' type='BSDF'>"
            "<input name='diffuse_albedo' type='color3' value='%.9g,%.9g,%.9g'/>"
            "<input name='f0' type='color3' value='%.9g,%.9g,%.9g'/>"
            "<input name='roughness' type='float' value='%.9g'/>"
            "<input name='anisotropy' type='float' value='%.9g'/>"
            "<input name='second_roughness' type='float' value='%.9g'/>"
            "<input name='second_roughness_weight' type='float' value='%.9g'/>"
            "<input name='fuzz_amount' type='float' value='%.9g'/>"
            "<input name='mean_free_path' type='vector3' value='%.9g,%.9g,%.9g'/></slab>",
            i, node->albedo, node->albedo, node->albedo, node->f0, node->f0, node->f0,
            node->roughness, node->anisotropy, node->second_roughness, node->second_weight,
            node->fuzz, node->mfp, node->mfp, node->mfp);
    case STACK_LAYER:
        return snprintf(out, room,
                        "<slab_layer name='n%d' type='BSDF'>"
                        "<input name='top' type='BSDF' nodename='n%d'/>"
                        "<input name='base' type='BSDF' nodename='n%d'/>"
                        "<input name='thickness' type='float' value='%.9g'/></slab_layer>",
                        i, node->a, node->b, node->thickness);
    case STACK_MIX:
        return snprintf(out, room,
                        "<slab_mix name='n%d' type='BSDF'>"
                        "<input name='fg' type='BSDF' nodename='n%d'/>"
                        "<input name='bg' type='BSDF' nodename='n%d'/>"
                        "<input name='mix' type='float' value='%.9g'/></slab_mix>",
                        i, node->a, node->b, node->share);
    default:
        return snprintf(out, room,
                        "<slab_coverage name='n%d' type='BSDF'>"
                        "<input name='in' type='BSDF' nodename='n%d'/>"
                        "<input name='weight' type='float' value='%.9g'/></slab_coverage>",
                        i, node->a, node->share);
    }
}

/* The document of a stack, whose shader is named "out". */
static inline void stack_write(const struct stack *stack, char out[STACK_TEXT])
{
    size_t len = (size_t)snprintf(out, STACK_TEXT, "<materialx version='1.39'>");
    for (int i = 0; i < stack->num_nodes; ++i)
        len += (size_t)stack_write_node(&stack->nodes[i], i, out + len, STACK_TEXT - len);
    snprintf(out + len, STACK_TEXT - len,
             "<slab_surface name='out' type='surfaceshader'>"
             "<input name='bsdf' type='BSDF' nodename='n%d'/>"
             "<input name='thin' type='boolean' value='%s'/></slab_surface></materialx>",
             stack->num_nodes - 1, stack->is_sheet ? "true" : "false");
}

/* ---- Throughput of clear media, exactly ---- */

/* The mean of what clear media let through on both ways; an opaque slab counts as none. */
static inline double stack_throughput(const struct stack *stack, int at, double thickness,
                                      double ways)
{
    const struct stack_node *node = &stack->nodes[at];
    double a = 0.0, b = 0.0;
    if (node->kind == STACK_SLAB)
        return node->mfp > 0.0 ? exp(-ways * thickness / node->mfp) : 1.0;
    a = stack_throughput(stack, node->a, node->kind == STACK_LAYER ? node->thickness : thickness,
                         ways);
    if (node->kind == STACK_COVER)
        return 1.0 - node->share * (1.0 - a);
    b = stack_throughput(stack, node->b, thickness, ways);
    return node->kind == STACK_LAYER ? a * b : node->share * a + (1.0 - node->share) * b;
}

/* ---- OpenPBR's layering (version 1.1, "Coat") ---- */

/*
 * Light that comes back from above `base`: a coat absorbs on both ways, and covers with its share.
 * It does not scatter, and no light bounces below it.
 */
static inline double stack_openpbr(const struct stack *stack, int at, double thickness, double ways,
                                   double base)
{
    const struct stack_node *node = &stack->nodes[at];
    double a;
    switch (node->kind) {
    case STACK_SLAB:
        return node->mfp > 0.0 ? base * exp(-ways * thickness / node->mfp) : node->albedo;
    case STACK_LAYER:
        base = stack_openpbr(stack, node->b, thickness, ways, base);
        return stack_openpbr(stack, node->a, node->thickness, ways, base);
    case STACK_MIX:
        a = stack_openpbr(stack, node->a, thickness, ways, base);
        return node->share * a
               + (1.0 - node->share) * stack_openpbr(stack, node->b, thickness, ways, base);
    default:
        a = stack_openpbr(stack, node->a, thickness, ways, base);
        return node->share * a + (1.0 - node->share) * base;
    }
}

/* ---- The random walk ---- */

struct stack_pile { /* the slabs that one path meets, from above */
    double albedo[STACK_SLABS],
        depth[STACK_SLABS]; /* of one scattering; optical, INFINITY: opaque */
    int num;
};

/* Kulla and Conty 2017: of one scattering, from the albedo of a thick medium. */
static inline double stack_single_albedo(double c)
{
    double s = 4.09712 + 4.20863 * c - sqrt(9.59217 + 41.6808 * c + 17.7126 * c * c);
    return c <= 0.0 ? 0.0 : 1.0 - fmin(fmax(s, 0.0), 1.0) * fmin(fmax(s, 0.0), 1.0);
}

static inline void stack_draw(const struct stack *stack, int at, double thickness,
                              struct stack_pile *pile)
{
    const struct stack_node *node = &stack->nodes[at];
    switch (node->kind) {
    case STACK_SLAB:
        pile->albedo[pile->num] =
            node->mfp > 0.0 ? stack_single_albedo(node->albedo) : node->albedo;
        pile->depth[pile->num++] = node->mfp > 0.0 ? thickness / node->mfp : INFINITY;
        break;
    case STACK_LAYER:
        stack_draw(stack, node->a, node->thickness, pile);
        stack_draw(stack, node->b, thickness, pile);
        break;
    case STACK_MIX:
        stack_draw(stack, stack_random() < node->share ? node->a : node->b, thickness, pile);
        break;
    case STACK_COVER:
        if (stack_random() < node->share)
            stack_draw(stack, node->a, thickness, pile);
        break;
    }
}

/* Where light from the viewer goes, as shares: through is what a medium scattered. */
struct stack_light {
    double back, through, straight;
};

/* Adds the light of one path through a pile. down: the cosine inside. */
static inline void stack_follow(const struct stack_pile *pile, double down, struct stack_light *sum)
{
    int at = 0;
    double depth = 0.0, carried = 1.0; /* depth: from the top of slab `at` */
    double *below = &sum->straight;
    while (at >= 0 && at < pile->num) {
        if (isinf(pile->depth[at])) { /* reflects evenly into what is outside */
            carried *= pile->albedo[at];
            down = -1.0 / stack_way(sqrt(stack_random()));
            if (at-- == 0)
                break;
            depth = pile->depth[at];
        }
        depth -= log(stack_random()) * down;
        if (depth >= pile->depth[at]) {
            ++at;
            depth = 0.0;
        } else if (depth <= 0.0) {
            depth = --at >= 0 ? pile->depth[at] : 0.0;
        } else {
            carried *= pile->albedo[at];
            down = 2.0 * stack_random() - 1.0;
            below = &sum->through;
        }
        if (carried < 1e-6)
            return;
    }
    *(at < 0 ? &sum->back : below) += carried;
}

/* Where even light goes, seen from a viewer: the stack reflects it, or it comes from behind. */
static inline struct stack_light stack_walk(const struct stack *stack, double cosine, int num_paths)
{
    struct stack_light sum = {0.0, 0.0, 0.0};
    for (int i = 0; i < num_paths; ++i) {
        struct stack_pile pile = {.num = 0};
        stack_draw(stack, stack->num_nodes - 1, 0.01, &pile);
        stack_follow(&pile, 1.0 / stack_way(cosine), &sum);
    }
    return (struct stack_light){sum.back / num_paths, sum.through / num_paths,
                                sum.straight / num_paths};
}

/*
 * Even light that comes back from a mirror below a white medium: the share of it that nothing has
 * scattered on its way.
 */
static inline double stack_straight_share(double depth, double f0, int num_paths)
{
    double all = 0.0, straight = 0.0;
    for (int i = 0; i < num_paths; ++i) {
        double down = 1.0 / stack_way(sqrt(stack_random())), at = 0.0, carried = 1.0;
        int is_scattered = 0, is_mirrored = 0;
        while (carried > 1e-6) {
            at -= log(stack_random()) * down;
            if (at <= 0.0)
                break;
            if (at >= depth) {
                at = depth;
                down = -down;
                carried *= f0;
                is_mirrored = 1;
            } else {
                down = 2.0 * stack_random() - 1.0;
                is_scattered = 1;
            }
        }
        all += is_mirrored ? carried : 0.0;
        straight += is_mirrored && !is_scattered ? carried : 0.0;
    }
    return straight / all;
}

#endif
