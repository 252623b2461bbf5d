// SPDX-License-Identifier: Apache-2.0
/*
 * The slab that stands for a leaf: libraries/slabs/recognise.mtlx has a definition for each leaf
 * that is a part of matter.
 */
#include "material/changed_closures.h"
#include "slabs/regime.h"

#include "shader/formula.h"

static uint32_t definition_for(struct builder *b, const struct family *family)
{
    struct text name;
    const char *function = build_text(b, family->name);
    text_init(&name, b->arena);
    text_fmt(&name, "ND_slab_of_%s", strncmp(function, "mx_", 3) == 0 ? function + 3 : function);
    return build_definition_named(b, text_cstr(&name));
}

/* True for 0 and false, also as the document's value of a uniform. */
static bool is_zero(struct builder *b, ir_ref ref)
{
    struct ir_value value;
    return !ref || (build_initial(b, ref, &value) && value.w[0].u == 0);
}

/* True for an input that is this word, or that the leaf does not have. */
static bool is_word(struct builder *b, ir_ref ref, const char *word)
{
    struct ir_value value;
    return !ref
           || (ir_get_const(b->graph, ref, &value)
               && strcmp(build_text(b, value.w[0].u), word) == 0);
}

/*
 * False for a leaf with a part that no slab has: transmitted light; films, retroreflection, facets
 * of another distribution.
 */
static bool fits(struct builder *b, ir_ref leaf, bool loosely)
{
    ir_ref film = build_leaf_operand(b, leaf, "thinfilm_thickness"),
           returns = build_leaf_operand(b, leaf, "retroreflective"),
           facets = build_leaf_operand(b, leaf, "distribution");
    if (!is_word(b, build_leaf_operand(b, leaf, "scatter_mode"), "R"))
        return false;
    return loosely || (is_zero(b, film) && is_zero(b, returns) && is_word(b, facets, "ggx"));
}

/*
 * The values of the outputs of a definition, over the operands of a leaf. A definition without the
 * input is_top is of a medium: over other matter its weight is a coverage, which this returns, and
 * elsewhere, or where it hides all below (--layering occluding), a part of its albedo.
 */
static ir_ref apply_to(struct builder *b, uint32_t id, ir_ref leaf, bool is_top, ir_ref *results)
{
    const struct nodedef *def = library_nodedef(b->lib, id);
    const struct port *ports = library_ports(b->lib, id, NULL);
    ir_ref *args = ARENA_ARRAY(b->arena, ir_ref, def->num_inputs);
    ir_ref one = ir_const_float(b->graph, 1.0f), top = ir_const_float(b->graph, is_top);
    bool covers =
        is_top && !b->options->keeps_absent && library_find_input(b->lib, id, STR_is_top) < 0;
    for (unsigned i = 0; i < def->num_inputs; i++) {
        const char *name = build_text(b, ports[i].name);
        args[i] = ports[i].name == STR_is_top             ? top
                  : covers && strcmp(name, "weight") == 0 ? one
                                                          : build_leaf_operand(b, leaf, name);
        args[i] = args[i] ? args[i] : build_default(b, &ports[i]);
    }
    build_apply(b, id, build_doc(b)->root, args, results);
    return covers ? ir_arg(b->graph, leaf, 0) : one;
}

/* An input of <slab>: the output "slab_" of a definition, or the default. */
static ir_ref input_of(struct builder *b, uint32_t id, const ir_ref *results, str_id name)
{
    const struct nodedef *def = library_nodedef(b->lib, id);
    const struct port *outputs = library_ports(b->lib, id, NULL) + def->num_inputs;
    const char *wanted = build_text(b, name);
    for (unsigned i = 0; i < def->num_outputs && results; i++)
        if (strcmp(build_text(b, outputs[i].name) + strlen("slab_"), wanted) == 0)
            return results[i];
    uint32_t slab = build_definition_named(b, "ND_slab");
    int at = library_find_input(b->lib, slab, name);
    assert(at >= 0);
    return build_default(b, &library_ports(b->lib, slab, NULL)[at]);
}

/* Turns a slab to the frame of a leaf. */
static void take_frame(struct builder *b, ir_ref leaf, ir_ref *in)
{
    ir_ref normal = build_leaf_operand(b, leaf, "normal"),
           tangent = build_leaf_operand(b, leaf, "tangent");
    in[SLAB_normal] = normal ? normal : in[SLAB_normal];
    in[SLAB_tangent] = tangent ? tangent : in[SLAB_tangent];
}

static ir_ref made(struct builder *b, const ir_ref *in)
{
    uint32_t attr = build_slab_lacks(b) | slab_regime(b->graph, in);
    return ir_build(b->graph, IR_SLAB, IR_TYPE_BSDF, attr, in, NUM_SLAB_OPERANDS);
}

static ir_ref slab_with(struct builder *b, uint32_t id, const ir_ref *results, ir_ref leaf,
                        ir_ref coverage, ir_ref albedo)
{
    static const str_id names[NUM_SLAB_INPUTS] = {
#define SLAB_INPUT(name, type) STR_##name,
#include "slabs/slabs.def"
#undef SLAB_INPUT
    };
    ir_ref in[NUM_SLAB_OPERANDS];
    for (unsigned i = 0; i < NUM_SLAB_INPUTS; i++)
        in[i] = input_of(b, id, results, names[i]);
    take_frame(b, leaf, in);
    in[SLAB_coverage] = coverage;
    in[SLAB_specular_lut] = 0;
    in[SLAB_specular_lut_weight] = ir_const_float(b->graph, 0.0f);
    if (albedo) {
        in[SLAB_diffuse_albedo] = albedo;
        in[SLAB_f0] = ir_const_splat(b->graph, IR_TYPE_VEC3, 0.0f);
    }
    return made(b, in);
}

bool build_fits_slab(struct builder *b, ir_ref leaf)
{
    return !closure_source(b->shader, leaf)
           && definition_for(b, build_leaf_family(b, ir_get(b->graph, leaf)->attr)) != LIBRARY_NONE
           && fits(b, leaf, false);
}

ir_ref build_slab_of(struct builder *b, ir_ref leaf, bool is_top, bool loosely)
{
    ir_ref results[LIBRARY_MAX_OUTPUTS] = {0};
    if (closure_source(b->shader, leaf))
        return 0;
    uint32_t id = definition_for(b, build_leaf_family(b, ir_get(b->graph, leaf)->attr));
    if (id == LIBRARY_NONE || !fits(b, leaf, loosely))
        return 0;
    ir_ref coverage = apply_to(b, id, leaf, is_top, results);
    return slab_with(b, id, results, leaf, coverage, 0);
}

/* The roughness of a slab for that of a leaf, which may be the widths of a lobe; 0: it has none. */
static ir_ref mean_roughness(struct builder *b, ir_ref leaf)
{
    struct ir_graph *g = b->graph;
    ir_ref roughness = build_leaf_operand(b, leaf, "roughness");
    if (!roughness || ir_type_of(g, roughness) != IR_TYPE_VEC2)
        return roughness && ir_type_of(g, roughness) == IR_TYPE_FLOAT ? roughness : 0;
    return FORMULA(b->shader, "mx_blend_roughness", roughness);
}

ir_ref build_slab_like(struct builder *b, ir_ref leaf, ir_ref albedo)
{
    ir_ref one = ir_const_float(b->graph, 1.0f);
    ir_ref slab = slab_with(b, build_definition_named(b, "ND_slab"), NULL, leaf, one, albedo);
    ir_ref roughness = mean_roughness(b, leaf), in[NUM_SLAB_OPERANDS];
    if (!roughness)
        return slab;
    memcpy(in, ir_args(b->graph, slab), sizeof in);
    in[SLAB_roughness] = roughness;
    return made(b, in);
}
