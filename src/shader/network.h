// SPDX-License-Identifier: Apache-2.0
/*
 * A shader as a network of small ones, for languages whose hosts put shaders together themselves:
 *
 *     document ─build→ layers: a node each, with values and connections
 *                      nodes: the kinds of layers, a shader each; what may vary is a parameter
 *
 * build records it, and the target makes a program of it (spell/target.h).
 */
#ifndef MXG_SHADER_NETWORK_H
#define MXG_SHADER_NETWORK_H

#include "shader/shader.h"

/* A definition, with the values of those inputs that must be known when its shader is made. */
struct network_node {
    str_id name; /* of the shader: "ND_dielectric_bsdf_scatter_mode_T" */
    uint32_t definition;
    str_id definition_name;
    uint32_t num_inputs, num_outputs;
    const str_id *ports;          /* names of inputs as the definition has them */
    const struct ir_value *fixed; /* per input; type VOID: a parameter */
    bool is_needed;               /* by the target: it has a shader */
    /* known when its shader stands */
    const str_id *inputs, *outputs; /* their names in the shader; 0: it has no such parameter */
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

/* One output of a node, as its shader gives it. */
struct network_output {
    ir_ref value;
    str_id name, doc_type;
};

/* A shader that layers are of. */
struct network_part {
    const char *name, *source;
    size_t size;
    const char *nodedef; /* "": of no node */
};

/* What an element gives: the operands of a material in their order, or the one value that it is. */
enum network_result {
    NETWORK_SURFACE,
    NETWORK_BACK_SURFACE,
    NETWORK_DISPLACEMENT,
    NETWORK_VOLUME,
    NETWORK_PLAIN_VALUE, /* always a layer's */
    NUM_NETWORK_RESULTS
};

struct network {
    struct arena *arena;
    struct strpool *strings;
    VEC(struct network_node) nodes;
    VEC(struct network_layer) layers; /* those that are connected to others come before them */
    VEC(struct network_input) inputs;
    struct network_input results[NUM_NETWORK_RESULTS]; /* type VOID: it gives no such thing */
    /* by the target */
    void *program;                  /* its own */
    VEC(struct network_part) parts; /* shaders of nodes first */
};

#endif
