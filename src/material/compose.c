// SPDX-License-Identifier: Apache-2.0
/*
 * From the parts of layers to one material (docs/slots.md, "Weights"):
 *
 *     hides  h = clamp(mask) · opacity of the surface; 0 without a surface
 *     weight w = cutout · clamp(mask) · Π (1 - h) of the layers above
 *     alpha    = cutout · (1 - Π (1 - h))
 *     displacement, from the base up: add  D + m·d,  mix  D + m·(d - D),  none  + d in the end
 *
 * w multiplies a layer before its own opacity does. The closure room makes the normals, after the
 * displacement.
 */
#include "build/build_priv.h"

#include "closure/closure.h"
#include "ir/arithmetic.h"

enum { MODE_BITS = 2, MODE_MASK = 3 };

static const char *const mode_words[] = {
    [IR_SLOT_ADD] = "add", [IR_SLOT_MIX] = "mix", [IR_SLOT_NONE] = "none"};

uint32_t build_modes(unsigned displacement, unsigned normal)
{
    return displacement | normal << MODE_BITS;
}

int build_mode(const char *word)
{
    for (unsigned i = 0; i < sizeof mode_words / sizeof *mode_words; i++)
        if (strcmp(mode_words[i], word) == 0)
            return (int)i;
    return -1;
}

/* "050_mask" */
static void name_value(struct builder *b, ir_ref value, const struct build_part *part,
                       const char *role)
{
    struct text name;
    size_t len;
    text_init(&name, b->arena);
    text_fmt(&name, "%s_%s", role, part->slot);
    const char *identifier = identifier_from(text_cstr(&name), name.len, b->arena, &len);
    if (*part->slot)
        ir_suggest_name(b->graph, value, str_intern(b->shader->strings, identifier, len),
                        IR_NAME_ROLE);
}

/* ---- Weights ---- */

/* A walk to slabs reads the whole graph, so layers walk only where there are any. */
static bool has_slabs(const struct builder *b)
{
    for (ir_ref ref = 1; b->without_slabs && ref < b->graph->nodes.len; ref++)
        if (ir_get(b->graph, ref)->op == IR_SLAB_SURFACE || ir_get(b->graph, ref)->op == IR_SLAB)
            return true;
    return false;
}

/* The opacity of slabs is that of their lobes. The layer keeps the slabs. */
static ir_ref alpha_of(struct builder *b, ir_ref surface, bool walks)
{
    return closure_surface_alpha(b->shader, walks ? b->without_slabs(b, surface) : surface);
}

/* How much of what is below a layer hides, and its share of displacement and normal. */
static void find_presence(struct builder *b, struct build_part *part, const struct build_part *base,
                          unsigned side, bool walks)
{
    ir_ref surface = part->sides[side] ? part->sides[side] : part->sides[0];
    ir_ref opacity = surface ? ir_share(b->graph, alpha_of(b, surface, walks)) : 0;
    ir_ref presence = ir_product(b->graph, part->mask, opacity);
    part->presence = presence ? presence : ir_const_float(b->graph, 1.0f);
    part->hides = surface ? part->presence : ir_const_float(b->graph, 0.0f);
    name_value(b, part->presence, part, "presence");
    if (part->is_vertical && base) /* a coat is where its base is */
        part->presence = ir_product(b->graph, part->presence, base->presence);
}

static void find_presences(struct builder *b, struct build_part *parts, uint32_t num, unsigned side)
{
    const struct build_part *base = NULL;
    bool walks = has_slabs(b);
    for (uint32_t i = 0; i < num; i++) {
        find_presence(b, &parts[i], base, side, walks);
        base = parts[i].is_vertical ? base : &parts[i];
    }
}

static ir_ref shape_of(struct builder *b, const struct build_part *parts, uint32_t num)
{
    ir_ref shape = ir_const_float(b->graph, 1.0f);
    for (uint32_t i = 0; i < num; i++)
        shape = ir_product(b->graph, shape, parts[i].cutout);
    return shape;
}

/*
 * True if the only layer of a stack is not simply its surface: without one it is nothing, and where
 * it is not opaque it moves vertices less, and may be picked or not. A material that is no layer
 * keeps what the specification says of it.
 */
static bool is_partial(struct builder *b, const struct build_part *part)
{
    if (!*part->slot)
        return false;
    if (!part->sides[0])
        return !part->sides[1];
    ir_ref alpha = alpha_of(b, part->sides[0], has_slabs(b));
    return (b->shader->picks || part->displacement) && alpha && !ir_const_is(b->graph, alpha, 1.0f);
}

/* True if a material of one layer is its surface alone. */
static bool is_plain(struct builder *b, const struct build_part *parts, uint32_t num)
{
    return num == 1 && !parts->mask && !parts->cutout && !parts->normal && !is_partial(b, parts);
}

static bool has_back(const struct build_part *parts, uint32_t num)
{
    bool any = false;
    for (uint32_t i = 0; i < num; i++)
        any |= parts[i].sides[1] != 0;
    return any;
}

static void put_slot(struct builder *b, const struct build_part *part, unsigned side, ir_ref weight,
                     ir_ref *args)
{
    unsigned mode = part->normal_mode + (part->is_vertical ? IR_SLOT_VERTICAL : 0u);
    args[0] = part->sides[side] ? part->sides[side] : part->sides[0];
    args[1] = weight;
    args[2] = part->mask ? part->mask : ir_const_float(b->graph, 1.0f);
    args[3] = part->presence;
    args[4] = part->normal;
    args[5] = ir_const_int(b->graph, (int32_t)mode);
}

static ir_ref compose_side(struct builder *b, struct build_part *parts, uint32_t num, unsigned side)
{
    ir_ref shape = shape_of(b, parts, num), through = ir_const_float(b->graph, 1.0f);
    const uint32_t num_args = IR_SLOTS_FIRST + num * IR_SLOT_OPERANDS;
    ir_ref *args = ARENA_ARRAY(b->arena, ir_ref, num_args);
    find_presences(b, parts, num, side);
    for (uint32_t i = num; i-- > 0;) {
        ir_ref mask = parts[i].mask ? parts[i].mask : ir_const_float(b->graph, 1.0f), weight = mask;
        if (!parts[i].is_vertical) {
            weight = ir_product(b->graph, ir_product(b->graph, mask, through), shape);
            through = ir_product(b->graph, through, ir_one_minus(b->graph, parts[i].hides));
            name_value(b, weight, &parts[i], "weight");
        }
        put_slot(b, &parts[i], side, weight, args + IR_SLOTS_FIRST + i * IR_SLOT_OPERANDS);
    }
    args[0] = ir_product(b->graph, ir_one_minus(b->graph, through), shape);
    args[1] = shape;
    return ir_build(b->graph, IR_SLOTS, IR_TYPE_SURFACE, 0, args, num_args);
}

/* ---- Displacement ---- */

static ir_ref sum(struct builder *b, ir_ref x, ir_ref y)
{
    ir_ref args[2] = {x, y};
    if (!x || !y)
        return x ? x : y;
    return ir_build(b->graph, IR_CLOSURE_ADD, IR_TYPE_DISPLACEMENT, 0, args, 2);
}

static ir_ref scaled(struct builder *b, ir_ref x, ir_ref factor)
{
    ir_ref args[2] = {x, factor};
    if (ir_const_is(b->graph, factor, 1.0f))
        return x;
    return ir_build(b->graph, IR_CLOSURE_SCALE, IR_TYPE_DISPLACEMENT, 0, args, 2);
}

static ir_ref mixed(struct builder *b, ir_ref x, ir_ref y, ir_ref factor)
{
    ir_ref args[3] = {x, y, factor};
    if (ir_const_is(b->graph, factor, 1.0f))
        return y;
    return ir_build(b->graph, IR_SHADER_MIX, IR_TYPE_DISPLACEMENT, 0, args, 3);
}

static ir_ref displacement_of(struct builder *b, const struct build_part *parts, uint32_t num)
{
    ir_ref all = 0, everywhere = 0;
    for (uint32_t i = 0; i < num; i++) {
        ir_ref own = parts[i].displacement;
        if (!own)
            continue;
        switch (parts[i].displacement_mode) {
        case IR_SLOT_ADD: all = sum(b, all, scaled(b, own, parts[i].presence)); break;
        case IR_SLOT_NONE: everywhere = sum(b, everywhere, own); break;
        case IR_SLOT_MIX:
        case IR_SLOT_VERTICAL: all = mixed(b, all, own, parts[i].presence); break;
        }
    }
    return sum(b, all, everywhere);
}

/* ---- Materials ---- */

ir_ref build_compose(struct builder *b, struct build_part *parts, uint32_t num)
{
    ir_ref args[4] = {0};
    if (is_plain(b, parts, num)) {
        args[0] = parts->sides[0];
        args[1] = parts->sides[1];
        args[2] = parts->displacement;
        return ir_build(b->graph, IR_MATERIAL, IR_TYPE_MATERIAL, 0, args, 4);
    }
    if (has_back(parts, num))
        args[1] = compose_side(b, parts, num, 1);
    args[0] = compose_side(b, parts, num, 0);
    args[2] = displacement_of(b, parts, num); /* with the presences of the front */
    return ir_build(b->graph, IR_MATERIAL, IR_TYPE_MATERIAL, 0, args, 4);
}

struct build_part build_part_of(struct builder *b, ir_ref material)
{
    struct ir_graph *g = b->graph;
    struct build_part part = {
        .slot = "", .displacement_mode = IR_SLOT_MIX, .normal_mode = IR_SLOT_MIX};
    if (material && ir_get(g, material)->op == IR_SUBSTANCE) {
        uint32_t modes = ir_get(g, material)->attr;
        part.normal = ir_arg(g, material, 1);
        part.mask = ir_arg(g, material, 2) ? ir_share(b->graph, ir_arg(g, material, 2)) : 0;
        part.cutout = ir_arg(g, material, 3) ? ir_share(b->graph, ir_arg(g, material, 3)) : 0;
        part.displacement_mode = (enum ir_slot_mode)(modes & MODE_MASK);
        part.normal_mode = (enum ir_slot_mode)(modes >> MODE_BITS);
        material = ir_arg(g, material, 0);
    }
    if (!material || ir_get(g, material)->op != IR_MATERIAL)
        return part;
    part.sides[0] = ir_arg(g, material, 0);
    part.sides[1] = ir_arg(g, material, 1);
    part.displacement = ir_arg(g, material, 2);
    return part;
}

ir_ref build_lone_substance(struct builder *b, ir_ref substance)
{
    struct build_part part = build_part_of(b, substance);
    return build_compose(b, &part, 1);
}
