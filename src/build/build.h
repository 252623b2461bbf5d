// SPDX-License-Identifier: Apache-2.0
/*
 * Builds the IR of a document element: starts at the element and walks to the inputs that it needs.
 *
 *     node ─resolve→ definition + bindings ─implementation for the target→ IR of its outputs
 *
 * The walk uses an explicit stack of frames, so memory alone limits the depth of graphs.
 */
#ifndef MXG_BUILD_BUILD_H
#define MXG_BUILD_BUILD_H

#include "base/folder_names.h"
#include "library/library.h"
#include "shader/network.h"
#include "slabs/sheet.h"

/* The inputs that become uniforms: the option `interface`. */
enum build_interface { INTERFACE_COMPLETE, INTERFACE_AUTHORED, INTERFACE_REDUCED };

/* Where <ambientocclusion> comes from: the option `ambient-occlusion`. */
enum build_occlusion { OCCLUSION_MAP, OCCLUSION_PRIMVAR, OCCLUSION_NONE };

/* libraries/stdlib/image.glsl lists all values */
enum { TEXTURE_MODES_SHARED = 1, TEXTURE_MODES_BUT_BORDERS = 3 };

struct mxg_node_code; /* mxgen/node.h */

struct build_options {
    /*
     * MaterialX names of the target and of what it inherits, nearest first: "essl", "genglsl". The
     * language of the first ones is the target's; of the others it has graphs, but not the source.
     */
    const str_id *targets;
    unsigned num_targets, num_languages;
    enum build_interface interface;
    const struct lang_syntax *syntax; /* of the target, whose words no uniform may have as name */
    /* patterns of element paths that become uniforms, or constants */
    bool publish_all; /* the option `publish` */
    const char *const *uniform_globs, *const *constant_globs;
    unsigned num_uniform_globs, num_constant_globs;
    str_id colorspace; /* working colour space: "lin_rec709" */
    str_id distance_unit, angle_unit;
    uint64_t caps;      /* enum target_caps */
    bool neutral_names; /* uniform names are numbers */
    int environment;    /* values of option_environment… */
    bool host_environment;
    int albedo;
    int quality;
    int texture_modes;
    int texture_origin;               /* 1: v is 0 at the top of images */
    bool tiles;                       /* images with tiles are texture arrays */
    const struct lang_reader *reader; /* for photometric files; may be NULL */
    /* Like mxg_resolver.list_folder, to find tiles; may be NULL. */
    names_fn *list_folder;
    void *list_user_data;
    /* The reason why a document may not refer to a texture; NULL: it may. NULL: all are allowed. */
    const char *(*texture_fault)(void *user_data, const char *from, const char *file);
    void *texture_user_data;
    /* mxg_context_desc.read_texels; NULL: no texture can be read */
    bool (*read_texels)(void *user_data, const char *from, const char *file, const char *layer,
                        uint32_t size, float *out_texels);
    void *texels_user_data;
    uint32_t max_inline_nodes; /* functions with more tree nodes stay calls; 0: the usual number */
    bool keeps_absent;         /* closures of weight 0 hide what lies below them */
    int sss;                   /* 1: a pass of the deferred pipeline spreads the light of bodies */
    bool blurs;                /* what lies below rough interfaces is blurred */
    bool mattes;               /* each layer of a stack has an AOV of its own */
    enum build_occlusion occlusion;
    bool asks_thickness;               /* the host tells the way of light through bodies */
    const struct mxg_node_code *codes; /* nodes in C: code.h */
    uint32_t num_codes;
    bool (*cancel)(void *user_data);
    void *cancel_user_data;
};

struct builder;

/* The arena of the shader owns the results. `lib` is the layer of the document. */
struct builder *build_start(const struct library *lib, const struct build_options *options,
                            struct shader *shader, struct diag_list *diags);

/*
 * The value of an element: output `output` of a material, shader or other node, or an <output>. The
 * type of the node is the kind of the value. 0 after an error. The inputs of the element itself
 * (for materials: of its shaders) are the shader's interface.
 */
ir_ref build_element(struct builder *builder, elem_id element, unsigned output);

/*
 * stack_material.c: the material of a stack: all its layers as one; of a primitive without layers
 * the default substance. 0 after an error. `bindings` are those of the builder's document.
 */
struct bindings;
ir_ref build_stack(struct builder *builder, const struct bindings *bindings, uint32_t stack);

/*
 * network.c: makes the builder record layers in `network`. The value of build_element or
 * build_stack then depends on sources that stand for the layers. fits_family: as in target_network.
 */
void build_record_network(struct builder *builder, struct network *network, const char *end_layer,
                          bool (*fits_family)(const char *family, const uint32_t *functions));
/*
 * Fills network->results for the root that was built, or sets network->is_whole. `type` is the type
 * of a plain value; false: the library has no node for a constant of this type. The builder records
 * no more.
 */
bool build_network_results(struct builder *builder, ir_ref root, str_id type);
/*
 * network_whole.c. For a whole shader, after its effects and before shader_finish: the sources
 * become parameters.
 */
void build_network_parameters(struct builder *builder);
/*
 * Adds the whole shader of a stage, which is finished, as the layer of its result, with the layers
 * of its parameters.
 */
void build_network_whole(struct builder *builder, enum shader_stage_id stage,
                         const struct network_part *part);
/*
 * Builds one node of a network over parameters, with a separate builder. Returns the results, the
 * names of the parameters, and the names of the outputs.
 */
void build_network_node(struct builder *builder, struct network_node *node, ir_ref *results);
str_id build_network_output(struct builder *builder, const struct network_node *node,
                            uint32_t index, str_id *out_type);

/*
 * aov.c: before build_element: the AOVs that become outputs, in this order, whether the element has
 * them or not: "NAME=TYPE"; "none" drops the items before it.
 */
void build_list_aovs(struct builder *builder, const char *const *items, uint32_t num_items);

/* True if builder->options->cancel stopped the work. */
bool build_cancelled(const struct builder *builder);

/* Resolves the globals of functions to IR, for lang_lower_call in the closure room. */
const struct lang_host *build_lang_host(struct builder *builder);

/* The leaf family of a LEAF node's callee. */
const struct family *build_leaf_family(struct builder *builder, uint32_t callee);
/* The input name of operand `index` + 1 of a LEAF node; NULL after the last. */
const char *build_leaf_input(struct builder *builder, uint32_t callee, unsigned index);

/* closures.c: what the closure room asks. */
struct closure_host build_closure_host(struct builder *builder, struct closure_point *point);
/* Before the build: the layers of stacks may have slabs. */
void build_know_slabs(struct builder *builder);
/*
 * hidden_closures.c: a root without the BSDFs that no slab stands for, as far as the values of the
 * document hide them.
 */
ir_ref build_without_hidden(struct builder *builder, ir_ref root);
/* slabs_walk with the library's slabs; for path tracers slabs_join_matter before it. */
ir_ref build_walk_slabs(struct builder *builder, const struct closure_host *closures, ir_ref root);
/* slabs_fill_sheet with the library's slabs; scratch as below. */
void build_fill_sheet(struct builder *builder, const struct closure_host *closures,
                      struct arena *scratch, const struct slab_budget *budget, ir_ref root,
                      struct slab_sheet *out);
/* slabs_budget with the library's slabs. scratch: empty, and again after the call. */
ir_ref build_budget_slabs(struct builder *builder, const struct closure_host *closures,
                          struct arena *scratch, const struct slab_budget *budget, ir_ref root,
                          struct slab_report *out);

/* Matches a path: '*' is any run without '/', '**' any run, '?' one character except '/'. */
bool build_glob_matches(const char *glob, const char *path);

/*
 * lights.c: fills shader->lights. An item names the node of a light shader, or is the path of a
 * <light> of the document; "=" and the light's number may follow. Without a number, it is the
 * item's position, from 1. "none" is no light. `is_explicit` is false for the default list, whose
 * lights may be absent.
 */
void build_lights(struct builder *builder, const char *const *items, uint32_t num_items,
                  bool is_explicit);

#endif
