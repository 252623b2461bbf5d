// SPDX-License-Identifier: Apache-2.0
#include "slabs/bytes.h"

enum stored_part {
#define STORED_PART(id, words, doc) STORED_##id,
#include "slabs/bytes.def"
#undef STORED_PART
    NUM_STORED_PARTS
};

enum { REMEMBERED_NORMALS = 3 }; /* that a slab refers to instead of a word of its own */

static const uint8_t words_of_parts[NUM_STORED_PARTS] = {
#define STORED_PART(id, words, doc) words,
#include "slabs/bytes.def"
#undef STORED_PART
};

struct stored_slab slab_stored(const struct ir_graph *g, ir_ref closure, bool is_whole)
{
    if (ir_get(g, closure)->op != IR_SLAB)
        return (struct stored_slab){.is_whole = is_whole, .is_other = true};
    const ir_ref *in = ir_args(g, closure);
    return (struct stored_slab){
        .diffuse_albedo = in[SLAB_diffuse_albedo],
        .f90 = in[SLAB_f90],
        .anisotropy = in[SLAB_anisotropy],
        .second_roughness_weight = in[SLAB_second_roughness_weight],
        .fuzz_amount = in[SLAB_fuzz_amount],
        .free_path = in[SLAB_mean_free_path],
        .normal = in[SLAB_normal],
        .has_tint = !ir_const_is(g, in[SLAB_specular_lut_weight], 0.0f),
        .has_glints = !ir_const_is(g, in[SLAB_glint_density], 0.0f),
        .is_whole = is_whole && ir_const_is(g, in[SLAB_coverage], 1.0f),
    };
}

static bool is_zero(const struct ir_graph *g, ir_ref value)
{
    return ir_const_is(g, value, 0.0f);
}

/* True for a grey constant: the hue of a reflectance without one. */
static bool is_grey(const struct ir_graph *g, ir_ref value)
{
    struct ir_value constant;
    return ir_get_const(g, value, &constant) && constant.w[0].u == constant.w[1].u
           && constant.w[0].u == constant.w[2].u;
}

/* Other closures may get any normal. */
static bool has_normal_of(const struct stored_slab *a, const struct stored_slab *b)
{
    return !a->is_other && !b->is_other && a->normal == b->normal;
}

static bool is_first_with_normal(const struct stored_slab *slabs, uint32_t i)
{
    for (uint32_t k = 0; k < i; k++)
        if (has_normal_of(&slabs[k], &slabs[i]))
            return false;
    return true;
}

static uint32_t count_normals(const struct stored_slab *slabs, uint32_t num_slabs)
{
    uint32_t num = 0;
    for (uint32_t i = 0; i < num_slabs; i++)
        num += is_first_with_normal(slabs, i);
    return num;
}

/* The parts that a slab may have, as bits of enum stored_part. */
static uint32_t parts_of(const struct ir_graph *g, const struct stored_slab *slab, bool is_over,
                         bool has_normal)
{
    bool is_clear = !slab->is_other && is_zero(g, slab->diffuse_albedo);
    bool has[NUM_STORED_PARTS] = {
        [STORED_ALBEDO] = !is_clear || !is_over, /* the word of the top has its roughness */
        [STORED_WEIGHTS] = !slab->is_whole,      [STORED_TINT] = slab->has_tint,
        [STORED_GLINTS] = slab->has_glints,      [STORED_NORMAL] = has_normal,
    };
    has[STORED_MEDIUM] = slab->is_other || (!is_clear && !is_zero(g, slab->free_path));
    has[STORED_LOBES] =
        slab->is_other || !is_zero(g, slab->second_roughness_weight) || !is_grey(g, slab->f90);
    has[STORED_FUZZ] = slab->is_other || !is_zero(g, slab->fuzz_amount);
    has[STORED_ANISOTROPY] = slab->is_other || !is_zero(g, slab->anisotropy);
    uint32_t bits = 0;
    for (unsigned part = 0; part < NUM_STORED_PARTS; part++)
        bits |= (uint32_t)has[part] << part;
    return bits;
}

uint32_t slab_stored_words(const struct ir_graph *g, const struct stored_slab *slab, bool is_over,
                           bool has_normal)
{
    uint32_t words = 1, parts = parts_of(g, slab, is_over, has_normal);
    for (unsigned part = 0; part < NUM_STORED_PARTS; part++)
        words += parts >> part & 1u ? words_of_parts[part] : 0u;
    return words;
}

uint32_t slab_stored_pixel(const struct ir_graph *g, const struct stored_slab *slabs,
                           uint32_t num_slabs)
{
    bool are_remembered = count_normals(slabs, num_slabs) <= REMEMBERED_NORMALS;
    uint32_t words = num_slabs > 0;
    for (uint32_t i = 0; i < num_slabs; i++) {
        bool has_normal = i > 0 && (!are_remembered || is_first_with_normal(slabs, i));
        words += slab_stored_words(g, &slabs[i], i == 0 && num_slabs > 1, has_normal);
    }
    return words;
}

struct stored_features slab_stored_features(const struct ir_graph *g,
                                            const struct stored_slab *slabs, uint32_t num_slabs)
{
    enum {
        NONE = 1u << STORED_ALBEDO,
        MANY = 1u << STORED_WEIGHTS | 1u << STORED_ANISOTROPY,
        SPECIAL = 1u << STORED_TINT | 1u << STORED_GLINTS
    };
    uint32_t parts = 0;
    for (uint32_t i = 0; i < num_slabs; i++)
        parts |= parts_of(g, &slabs[i], false, false);
    return (struct stored_features){.any = parts & ~(uint32_t)NONE,
                                    .many = num_slabs > 1 || parts & MANY,
                                    .special = parts & SPECIAL};
}
