// SPDX-License-Identifier: Apache-2.0
#include "slabs/features.h"

#include "slabs/spread.h"

const char *const slab_feature_keys[NUM_SLAB_FEATURES] = {
#define SLAB_FEATURE(id, key, doc) key,
#include "slabs/features.def"
#undef SLAB_FEATURE
};

const char *const slab_feature_names[NUM_SLAB_FEATURES] = {
#define SLAB_FEATURE(id, key, doc) doc,
#include "slabs/features.def"
#undef SLAB_FEATURE
};

/* The features that one input tells. */
static const struct {
    enum slab_feature feature;
    enum slab_operand input;
    float off; /* its value without the feature */
} by_input[] = {
    {SLAB_GLINTS, SLAB_glint_density, 0.0f},
    {SLAB_LUT, SLAB_specular_lut_weight, 0.0f},
    {SLAB_FUZZ, SLAB_fuzz_amount, 0.0f},
    {SLAB_SECOND_LOBE, SLAB_second_roughness_weight, 0.0f},
    {SLAB_F90, SLAB_f90, 1.0f},
    {SLAB_ANISOTROPY, SLAB_anisotropy, 0.0f},
};
enum { NUM_BY_INPUT = sizeof by_input / sizeof *by_input };

static bool differs(const struct ir_graph *g, ir_ref slab, enum slab_operand input, float off)
{
    return !ir_const_is(g, ir_arg(g, slab, input), off);
}

uint32_t slab_features(const struct ir_graph *g, const struct slab_spot *spot)
{
    uint32_t bits = 0;
    if (ir_get(g, spot->ref)->op != IR_SLAB)
        return 0;
    for (size_t i = 0; i < NUM_BY_INPUT; i++)
        bits |= (uint32_t)differs(g, spot->ref, by_input[i].input, by_input[i].off)
                << by_input[i].feature;
    if (!spot->thickness && differs(g, spot->ref, SLAB_mean_free_path, 0.0f)
        && differs(g, spot->ref, SLAB_diffuse_albedo, 0.0f))
        bits |= 1u << SLAB_SUBSURFACE;
    if (spot->below && slab_spreads(g, ir_args(g, spot->ref)))
        bits |= SLAB_FEATURES_BELOW & ~ir_get(g, spot->ref)->attr;
    return bits;
}

ir_ref slab_without(struct ir_graph *g, const struct slab_spot *spot, uint32_t features)
{
    ir_ref in[NUM_SLAB_OPERANDS];
    uint32_t gone = slab_features(g, spot) & features;
    uint32_t lacks = ir_get(g, spot->ref)->attr | (gone & SLAB_FEATURES_BELOW);
    memcpy(in, ir_args(g, spot->ref), sizeof in);
    if (gone & 1u << SLAB_SECOND_LOBE) {
        ir_ref share = in[SLAB_second_roughness_weight];
        in[SLAB_roughness] =
            ir_op3(g, IR_MIX, in[SLAB_roughness], in[SLAB_second_roughness], share);
    }
    if (gone & 1u << SLAB_LUT)
        in[SLAB_specular_lut] = 0;
    if (gone & 1u << SLAB_SUBSURFACE)
        in[SLAB_mean_free_path] = ir_const_splat(g, IR_TYPE_VEC3, 0.0f);
    for (size_t i = 0; i < NUM_BY_INPUT; i++) {
        ir_ref *input = &in[by_input[i].input];
        if (gone & 1u << by_input[i].feature)
            *input = ir_const_splat(g, ir_type_of(g, *input), by_input[i].off);
    }
    ir_push_origin_of(g, spot->ref);
    ir_ref slab = ir_build(g, IR_SLAB, IR_TYPE_BSDF, lacks, in, NUM_SLAB_OPERANDS);
    ir_pop_origin(g);
    return slab;
}
