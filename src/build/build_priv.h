// SPDX-License-Identifier: Apache-2.0
/* Shared by the files of this room. */
#ifndef MXG_BUILD_BUILD_PRIV_H
#define MXG_BUILD_BUILD_PRIV_H

#include "build/build.h"

/* A scope whose nodes are being built: the document, or one use of a functional graph. */
struct instance {
    struct instance *parent;
    elem_id graph; /* the nodegraph; 0: the document itself */
    elem_id first; /* elements [first, first + num_slots) belong to it */
    uint32_t num_slots;
    /* per element: enum slot_state or SLOT_RESULTS + index of its first result */
    uint32_t *slots;
    uint32_t nodedef;   /* what the graph implements */
    const ir_ref *args; /* one per input of the definition; 0: an absent closure */
    uint32_t origin;
    elem_id node; /* the node that uses it */
    uint32_t depth;
};

enum slot_state { SLOT_EMPTY, SLOT_BUSY, SLOT_ERROR, SLOT_RESULTS };

struct frame {
    struct instance *scope;
    struct instance *inner; /* of a node that is a graph */
    struct graph_node node;
    const struct binding *bindings;
    const struct implementation *impl;
    uint32_t next; /* next input or output to ask for */
    uint8_t phase; /* enum frame_phase */
    ir_ref *args;
    bool has_tokens; /* it is no equal of another use, whatever its arguments */
    uint32_t memo_key;
    /* memo of the function that `inner` becomes; LIBRARY_NONE: it is built into the graph */
    uint32_t outline;
    uint32_t function; /* of the graph; only with `outline` */
};

/*
 * Results of functional graphs by definition and arguments: equal uses are built once. And
 * functions made of them (outline.c).
 */
struct memo {
    uint32_t hash, impl;
    const ir_ref *args;
    uint32_t num_args;
    uint32_t first_result; /* + 1 */
    uint32_t uses;         /* of a function: times it was asked for */
    uint32_t function;     /* + 1, once it stands */
};

/* A text that begins as the one before did, since it belongs to the same element. */
struct build_prefix {
    elem_id owner;
    size_t len;
    struct text text;
};

struct builder {
    const struct library *lib;
    const struct build_options *options;
    struct shader *shader;
    struct ir_graph *graph;
    struct arena *arena;
    struct diag_list *diags;
    struct lang_host host;
    struct instance *document;
    VEC(struct frame) frames;
    VEC(ir_ref) results;
    struct resolve_out resolved;
    VEC(elem_id) public_nodes; /* nodes whose own inputs are the shader's interface */
    VEC(struct memo) memos;
    uint32_t *memo_table;
    uint32_t memo_mask;
    VEC(ir_ref) geomprops; /* value per geomprop name, in pairs (name, ref) */
    ir_ref *globals;       /* by id: what functions see of the host, once it was asked for */
    struct build_prefix path, name; /* in front of the paths and names of a node's inputs */
    ir_ref missing_texel;           /* what the node at hand reads where its image has no tile */
    struct recorder *recorder;      /* network.c; NULL: one shader is built */
    bool has_colorspace;            /* the option names a space that the library converts to */
    bool has_distance_unit;         /* the option names a unit that the library knows */
    bool cancelled;
};

static inline const char *build_text(const struct builder *b, str_id id)
{
    return str_text(b->shader->strings, id);
}

enum { BUILD_MAX_OUTPUTS = 64 };

/* demand.c: asks for a node's results; afterwards its slot is SLOT_ERROR or holds results. */
void build_demand(struct builder *b, struct instance *scope, elem_id node);
/* Output `output` of a node that was asked for; POISON of `type` after an error. */
ir_ref build_result(struct builder *b, struct instance *scope, elem_id node, unsigned output,
                    doc_type type);

/*
 * Applies a definition to arguments, outside of any document graph: geometric properties, colour
 * transforms. `where` is the element that needs it, for messages. Writes one ref per output; poison
 * after an error.
 */
void build_apply(struct builder *b, uint32_t nodedef, elem_id where, const ir_ref *args,
                 ir_ref *results);

/*
 * The memo of a graph used with these arguments, made when it is new. It moves when another is
 * made.
 */
struct memo *build_memo(struct builder *b, uint32_t impl, const ir_ref *args, uint32_t n);

/*
 * outline.c: the memo of the function that a graph is by now, or LIBRARY_NONE where it is built in
 * place.
 */
uint32_t build_outlined(struct builder *b, const struct frame *frame);
/* Gives frame->inner parameters for arguments. */
void build_begin_function(struct builder *b, struct frame *frame);
/* One ref per output of the definition. */
void build_call_function(struct builder *b, const struct frame *frame, uint32_t function,
                         ir_ref *results);

/*
 * trace.c: adds notes that tell which nodes use the graph that is being built; a struct diag_list's
 * `trace`.
 */
void build_trace(void *builder, struct diag_list *list);

/* input.c */

/* The value of a binding whose node, if it has one, was asked for. `node` owns the input. */
ir_ref build_input(struct builder *b, struct instance *scope, elem_id node, const struct port *port,
                   const struct binding *binding);
/*
 * What an input is when nothing is said: default value, geometric property, or nothing (0 for
 * closures).
 */
ir_ref build_default(struct builder *b, const struct port *port);
/* The value of a geometric property by name: defaultgeomprop. */
ir_ref build_geomprop(struct builder *b, str_id name, doc_type type, struct diag_place place);
/*
 * A constant, or what a uniform is at first, for what is settled when the shader is made; false: it
 * is neither.
 */
bool build_initial(const struct builder *b, ir_ref value, struct ir_value *out);
/* The path of an input: "SR_gold/base_color". */
str_id build_input_path(struct builder *b, elem_id node, str_id input, elem_id element);

/*
 * color.c: from `space` to the working space, by the library's transform nodes; value of a color3
 * or color4.
 */
ir_ref build_color_transform(struct builder *b, ir_ref value, doc_type type, str_id space,
                             struct diag_place place);
/* Told where an option names a space that nothing converts to, or a unit that nobody knows. */
void build_check_colorspace(struct builder *b);
void build_check_distance_unit(struct builder *b);
/* The colour space that is said for an element, itself or around; 0: none, or the working one. */
str_id build_colorspace(struct builder *b, elem_id element);

/* A value given in `unit`, in the target's unit; nothing changes without a unit. */
ir_ref build_unit_conversion(struct builder *b, ir_ref value, elem_id element,
                             const struct port *port);

/* texture.c: a variable for the file that `variable` says. */
ir_ref build_texture(struct builder *b, struct shader_variable variable, elem_id element);
/*
 * Tells hosts how a node reads its textures, before it is built: its arguments become those that
 * read so. True where a texture has tiles.
 */
bool build_note_textures(struct builder *b, const struct frame *frame);
/* lang_host.texture: reads the tile at hand. */
ir_ref build_read_tiles(void *user_data, enum ir_op op, const ir_ref *args);
/*
 * Tells of tiles that are read in what was built for a node from `first_node` on and could not
 * become nodes.
 */
void build_check_tiles(struct builder *b, const struct frame *frame, uint32_t first_node);

/*
 * tiles.c: finds the tiles that the file's name stands for; false: it is one image, or an error was
 * reported.
 */
bool build_find_tiles(struct builder *b, elem_id element, struct shader_variable *texture);
/* The layer at texture coordinates, as a float, and whether there is a tile. */
ir_ref build_tile_layer(struct builder *b, const struct shader_variable *texture, ir_ref uv,
                        ir_ref *out_inside);

/* filename.c: the value of a filename's element with its prefix and tokens. */
str_id build_file_name(struct builder *b, const struct instance *scope, elem_id element);
/* Whether a node sets tokens: then what is built for it is for no other. */
bool build_has_tokens(const struct builder *b, elem_id node);

/* node.c: results of a node from its arguments, except graphs. Writes one ref per output. */
void build_node(struct builder *b, const struct frame *frame, ir_ref *results);
/* The graph's number for a family that a LEAF calls. */
uint32_t build_leaf_callee(struct builder *b, uint32_t family);
/* The implementation of a definition for the target; NULL after a diagnostic. */
const struct implementation *build_choose(struct builder *b, uint32_t nodedef, elem_id node);
/* Calls an expression or function implementation. */
void build_call(struct builder *b, const struct implementation *impl, const ir_ref *args,
                ir_ref *results);

/* blur.c: `in`, averaged over texture coordinates. `node` is who asks. */
ir_ref build_blur(struct builder *b, ir_ref in, ir_ref size, ir_ref filtertype, elem_id node);

/*
 * profile.c: emission by the photometric file that a texture names; evenly where it cannot be read.
 */
ir_ref build_measured_edf(struct builder *b, ir_ref color, ir_ref normal, ir_ref file,
                          elem_id node);

/*
 * network.c, where there is a recorder. build_node: notes a layer for results that are no plain
 * values; they become sources that stand for it.
 */
void build_record_node(struct builder *b, const struct frame *frame, ir_ref *results);
/* A geometric property that no node gives, by a node that reads it. */
ir_ref build_property_layer(struct builder *b, const struct geomprop *prop);

/* dynamic.c: nodes that C code builds; false: there is none for the definition. */
bool build_dynamic(struct builder *b, const struct frame *frame, ir_ref *results);

#endif
