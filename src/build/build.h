// SPDX-License-Identifier: Apache-2.0
/*
 * From an element of a document to IR: asks for the value of the element and, by need, for
 * everything upstream.
 *
 *     node ─resolve→ definition + bindings ─implementation for the target→ IR of its outputs
 *
 * Nothing recurses on the C stack: requests are frames of an explicit one, so graphs may be as deep
 * as memory allows.
 */
#ifndef MXG_BUILD_BUILD_H
#define MXG_BUILD_BUILD_H

#include "library/library.h"
#include "shader/network.h"

/* Which inputs stay variable: the option `interface`. */
enum build_interface { INTERFACE_COMPLETE, INTERFACE_AUTHORED, INTERFACE_REDUCED };

enum { TEXTURE_MODES_BUT_BORDERS = 3 }; /* libraries/stdlib/image.glsl tells them all */

struct build_options {
    /* MaterialX names of the target and those it inherits: "essl", "genglsl" */
    const str_id *targets;
    unsigned num_targets;
    enum build_interface interface;
    /* element paths that stay variable, or do not */
    const char *const *uniform_globs, *const *constant_globs;
    unsigned num_uniform_globs, num_constant_globs;
    str_id colorspace; /* working space: "lin_rec709" */
    str_id distance_unit, angle_unit;
    bool strings;       /* the target has strings at run time */
    bool neutral_names; /* uniforms are named by number */
    bool short_names;   /* inputs have their own names, without that of their node */
    int environment;    /* values of option_environment… */
    int albedo;
    int sample_filter;
    int texture_modes;
    /* texture() gives another colour where there is no image, which may be a variable */
    bool missing_colors;
    /* tangents follow the coordinates of their index; else, as in MaterialX, the first */
    bool indexed_tangents;
    bool tiles;                       /* images of several tiles are texture arrays */
    const struct lang_reader *reader; /* of photometric files; may be NULL */
    /* As mxg_resolver.list_folder, to find tiles; may be NULL. */
    size_t (*list_folder)(void *user_data, const char *from, const char *folder, char *names,
                          size_t capacity);
    void *list_user_data;
    int integrator;
    bool (*cancel)(void *user_data);
    void *cancel_user_data;
};

struct builder;

/* Everything that `build` makes lives in the shader's arena. `lib` is the document's layer. */
struct builder *build_start(const struct library *lib, const struct build_options *options,
                            struct shader *shader, struct diag_list *diags);

/*
 * The value of an element: output `output` of a material, shader or other node, or an <output>. The
 * type tells what it is. 0 after an error. Inputs of the element itself (for materials: of its
 * shaders) are the shader's interface.
 */
ir_ref build_element(struct builder *builder, elem_id element, unsigned output);

/*
 * network.c: from now on builder notes layers in `network`, and what build_element gives is over
 * sources that stand for them. (The second function says what such a value is.)
 */
void build_record_network(struct builder *builder, struct network *network);
struct network_input build_network_input(struct builder *builder, ir_ref value);
/* A layer that gives a value which is no layer's; UINT32_MAX: there is none of its type. */
uint32_t build_constant_layer(struct builder *builder, ir_ref value, str_id doc_type);
/*
 * With a builder of its own: the results of a node of a network over parameters, whose names are
 * noted, and the names of its outputs.
 */
void build_network_node(struct builder *builder, struct network_node *node, ir_ref *results);
str_id build_network_output(struct builder *builder, const struct network_node *node,
                            uint32_t index, str_id *out_type);

/* True where the work stopped because of builder->options->cancel. */
bool build_cancelled(const struct builder *builder);

/* How functions' globals become IR: for lang_lower_call by the closure room. */
const struct lang_host *build_lang_host(struct builder *builder);

/* The family behind a LEAF node's callee. */
const struct family *build_leaf_family(struct builder *builder, uint32_t callee);
/* The name of the input that a LEAF node's operand `index` + 1 is; NULL beyond the last. */
const char *build_leaf_input(struct builder *builder, uint32_t callee, unsigned index);

/* Whether a path matches: '*' is any run without '/', '**' any run, '?' one character but '/'. */
bool build_glob_matches(const char *glob, const char *path);

/* A light shader's implementation function for the target; LIBRARY_NONE. */
uint32_t build_light_function(struct builder *builder, uint32_t nodedef);
/* What an input of a definition is when nothing is said; false: no number is known. */
bool build_port_value(struct builder *builder, const struct port *port, struct ir_value *out);
/*
 * The LIGHT_SHADER that a definition made of nodes gives for its inputs; 0 after an error. `where`
 * is told in messages.
 */
ir_ref build_light_shader(struct builder *builder, uint32_t nodedef, elem_id where,
                          const ir_ref *args);

struct structure_options {
    enum build_interface interface;
    const char *colorspace;
    uint64_t seed; /* of what else programs depend on */
};

/*
 * structure.c: one number for what an element is but for names, places and what becomes uniforms;
 * equal numbers, equal programs. 0: that cannot be told without a generation, of elements with
 * faults among others.
 */
uint64_t build_structure(const struct library *lib, const struct structure_options *options,
                         elem_id element, unsigned output, struct arena *scratch);

#endif
