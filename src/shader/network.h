// SPDX-License-Identifier: Apache-2.0
/*
 * A shader as a network of small ones, for languages whose hosts put shaders together themselves
 * (OSL's shader groups):
 *
 *     document ─build→ layers: a node each, with values and connections
 *                      nodes: what the layers are, one shader each, with everything of them that
 * may vary as a parameter
 */
#ifndef MXG_SHADER_NETWORK_H
#define MXG_SHADER_NETWORK_H

#include "shader/shader.h"

/* A definition, and what of its inputs must be known when its shader is made. */
struct network_node {
    str_id name; /* of the shader: "ND_dielectric_bsdf_scatter_mode_T" */
    uint32_t definition;
    str_id definition_name;
    uint32_t num_inputs, num_outputs;
    const str_id *ports;          /* names of inputs as the definition has them */
    const struct ir_value *fixed; /* per input; type VOID: a parameter */
    /* known when its shader stands */
    const str_id *inputs, *outputs; /* their names in the shader; 0: it has no such parameter */
    const char *source;
    size_t size;
};

enum network_input_kind { NETWORK_DEFAULT, NETWORK_VALUE, NETWORK_FILE, NETWORK_LAYER };

struct network_input {
    uint8_t kind;   /* enum network_input_kind */
    uint8_t output; /* of the layer */
    uint32_t layer; /* connected to it */
    ir_type_id type;
    str_id doc_type;
    str_id file;
    /* of the document's input that says the value; 0: no other than the layer's own */
    str_id path;
    struct ir_value value;
};

struct network_layer {
    str_id name; /* unique: "NG_marble_noise" */
    str_id path; /* "NG_marble/noise" */
    uint32_t node;
    uint32_t first_input;
};

struct network {
    struct arena *arena;
    struct strpool *strings;
    VEC(struct network_node) nodes;
    VEC(struct network_layer) layers; /* those that are connected to others come before them */
    VEC(struct network_input) inputs;
};

/* What a shader group does with its last layer. */
enum network_use {
    NETWORK_SURFACE,
    NETWORK_VOLUME,
    NETWORK_DISPLACEMENT,
    NETWORK_VALUE_OF,
    NUM_NETWORK_USES
};

/*
 * A shader that stands behind the layers of a group and takes what they give; without a name there
 * is none.
 */
struct network_end {
    const char *name, *inputs[2], *source;
};
#define NETWORK_END_LAYER "root" /* the name of its layer */

/*
 * A shader group: the layers that its ends need, and behind them the shader of its use, which takes
 * them.
 */
struct network_group {
    const struct network *network;
    enum network_use use;
    const bool *needed; /* per layer */
    const struct network_end *end;
    /*
     * what the end takes, front and back of a surface; or the value that the group is for. DEFAULT:
     * none
     */
    struct network_input results[2];
};

/* network.c */
const char *network_use_text(enum network_use use);
void network_find_needed(struct network_group *group); /* by its results */
/* of everything but values */
uint64_t network_topology(const struct network_group *groups, uint32_t num_groups);
struct reflect;
/* keys of the object at hand */
void network_reflect(struct reflect *r, const struct network_group *groups, uint32_t num_groups);

#endif
