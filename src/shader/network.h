// SPDX-License-Identifier: Apache-2.0
/*
 * A network: one small shader per node, for languages whose hosts combine shaders.
 *
 *     document ─build→ layers: one per node, with values and connections
 *                      nodes: the kinds of layers, one shader each; varying inputs are parameters
 *
 * Closures that no layer of its own gives, such as slabs, are one shader for the whole element: the
 * last layer of its group, whose parameters are outputs of the other layers.
 *
 * build records the network, and the target makes a program of it (spell/target.h).
 */
#ifndef MXG_SHADER_NETWORK_H
#define MXG_SHADER_NETWORK_H

#include "shader/shader.h"

/* The shader of a kind of layer. */
struct network_part {
    const char *name, *source;
    size_t size;
    const char *nodedef; /* "": not from a node */
};

/* A definition, and the values of the inputs that are compiled into its shader. */
struct network_node {
    str_id name; /* of the shader: "ND_dielectric_bsdf_scatter_mode_T" */
    /* its shader, if that is made of the closures of the whole element; source NULL: it is not */
    struct network_part whole;
    uint32_t definition;
    str_id definition_name;
    uint32_t num_inputs, num_outputs;
    const str_id *ports;          /* names of the inputs in the definition */
    const struct ir_value *fixed; /* per input; type VOID: a parameter */
    bool is_needed;               /* set by the target: the node has a shader */
    /* valid after its shader is complete */
    const str_id *inputs, *outputs; /* names in the shader; 0: no such parameter */
};

enum network_input_kind { NETWORK_DEFAULT, NETWORK_VALUE, NETWORK_FILE, NETWORK_LAYER };

struct network_input {
    uint8_t kind;   /* enum network_input_kind */
    uint8_t output; /* of the layer */
    uint32_t layer; /* source of the connection */
    ir_type_id type;
    str_id doc_type;
    str_id file;
    /* path of the document's input with the value; 0: the input of the layer itself */
    str_id path;
    struct ir_value value;
};

struct network_layer {
    str_id name; /* unique: "NG_marble_noise" */
    str_id path; /* "NG_marble/noise" */
    uint32_t node;
    uint32_t first_input;
};

/* One output of a node in its shader. */
struct network_output {
    ir_ref value;
    str_id name, doc_type;
};

/* An AOV of the surface (docs/slots.md): a value that the host may read. */
struct network_aov {
    str_id name, doc_type;
    struct network_input value; /* from a layer */
};

/* The results of an element: the operands of a material in order, or a single value. */
enum network_result {
    NETWORK_SURFACE,
    NETWORK_BACK_SURFACE,
    NETWORK_DISPLACEMENT,
    NETWORK_VOLUME,
    NETWORK_PLAIN_VALUE, /* always from a layer */
    NUM_NETWORK_RESULTS
};

struct network {
    struct arena *arena;
    struct strpool *strings;
    const char *end_layer; /* name of the last layer of a group: no other layer has it */
    bool is_whole;         /* one shader has all closures, because a layer cannot give them */
    VEC(struct network_node) nodes;
    VEC(struct network_layer) layers; /* in topological order */
    VEC(struct network_input) inputs;
    VEC(struct network_aov) aovs;
    struct network_input results[NUM_NETWORK_RESULTS]; /* type VOID: absent */
    /* for the target */
    void *program;                  /* for the target's use */
    VEC(struct network_part) parts; /* shaders of nodes first */
};

#endif
