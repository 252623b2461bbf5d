// SPDX-License-Identifier: Apache-2.0
/* Declarations that the files of the build room share. */
#ifndef MXG_BUILD_BUILD_PRIV_H
#define MXG_BUILD_BUILD_PRIV_H

#include "build/build.h"

#include <assert.h>

/*
 * A scope whose nodes the builder visits: the document, or one use of a nodegraph with a nodedef.
 */
struct instance {
    struct instance *parent;
    elem_id graph; /* the nodegraph; 0: the document itself */
    elem_id first; /* its elements are [first, first + num_slots) */
    uint32_t num_slots;
    /* per element: enum slot_state, or SLOT_RESULTS + index of its first result */
    uint32_t *slots;
    uint32_t nodedef;   /* the definition that the nodegraph implements */
    const ir_ref *args; /* one per input of the definition; 0: absent closure */
    uint32_t origin;
    elem_id node; /* the node that uses it */
    uint32_t depth;
    /* by input of the definition: how the images inside convert a file; NULL: they do not */
    const struct build_meaning *files;
};

enum slot_state { SLOT_EMPTY, SLOT_BUSY, SLOT_ERROR, SLOT_RESULTS };

struct frame {
    struct instance *scope;
    struct instance *inner; /* the inner scope, if the node is a nodegraph */
    struct graph_node node;
    const struct binding *bindings;
    const struct implementation *impl;
    uint32_t first_aov; /* in builder->aovs: those of the inner scope */
    uint32_t next;      /* index of the next input or output to visit */
    uint8_t phase;      /* enum frame_phase */
    ir_ref *args;
    bool is_alone; /* it sets tokens or says how files are converted, which no other use does */
    uint32_t memo_key;
    /* memo of the function that `inner` becomes; LIBRARY_NONE: inlined */
    uint32_t outline;
    uint32_t function; /* of the nodegraph; valid with `outline` */
};

/* A height, or a vector, that a surface itself moves its vertices by. */
struct own_displacement {
    const struct instance *scope;
    elem_id surface;
    ir_ref height;
    doc_type type;
};

/*
 * The results of nodegraphs, and the functions of graph_functions.c, by definition and arguments:
 * the builder builds equal uses once.
 */
struct memo {
    uint32_t hash, impl;
    const ir_ref *args;
    uint32_t num_args;
    uint32_t first_result; /* + 1 */
    uint32_t uses;         /* number of uses of a function */
    uint32_t function;     /* + 1, after its body is complete */
};

/* An <aov> that was built. aov.c */
struct aov_use {
    const struct instance *scope;
    elem_id node;
    str_id name, type;
    str_id source; /* of an <aovpass>: the name in the shader, 0: none */
    ir_ref value;
};

struct code_value { /* a value that the code of a node has */
    ir_ref ref;
    uint32_t serial; /* of the use */
};

struct code_parsed { /* an expression in the code of a node */
    str_id key;
    uint32_t function; /* LANG_NONE: its errors are reported */
};

/* The numbers in the names of the variables of a property. */
struct property_name {
    str_id semantic;
    ir_type_id scalar;
    unsigned last;
};

struct builder {
    struct library view;       /* the layer of the document, for the target */
    const struct library *lib; /* the view */
    const struct build_options *options;
    struct shader *shader;
    struct ir_graph *graph;
    struct arena *arena;
    struct diag_list *diags;
    /*
     * build_apply, as a pointer: demand.c visits inputs, and an input may need a definition applied
     */
    void (*apply)(struct builder *b, uint32_t nodedef, elem_id where, const ir_ref *args,
                  ir_ref *results);
    struct lang_host host;
    ir_ref (*without_slabs)(struct builder *b, ir_ref root); /* NULL: there are none */
    struct instance *document;
    VEC(struct frame) frames;
    VEC(ir_ref) results;
    struct resolve_out resolved;
    VEC(elem_id) public_nodes; /* nodes whose inputs form the shader's interface */
    /* the input whose value is sought, which gives the name with the option publish=all */
    struct {
        elem_id node;
        str_id input;
        bool transforms; /* between colour spaces */
    } reader;
    elem_id root_graph;    /* the nodegraph whose output is generated; 0: none */
    struct table compiled; /* the inputs in shader->compiled + 1: published.c */
    VEC(struct memo) memos;
    uint32_t *memo_table;
    uint32_t memo_mask;
    VEC(struct own_displacement) own_displacements;
    struct ir_evaluator initial; /* build_evaluate */
    struct ir_eval_env initial_env;
    VEC(ir_ref) geomprops; /* value per geomprop name, in pairs (name, ref) */
    /* property.c */
    struct table properties; /* by the property: indices of variables + 1 */
    struct table property_table;
    VEC(struct property_name) property_names;
    ir_ref *globals;             /* by id: host data of functions, after the first use */
    struct text scratch;         /* for a path or a name */
    elem_id called;              /* the node whose implementation is lowered; 0: none */
    ir_ref missing_texel;        /* the current node's texel outside all tiles of its image */
    struct recorder *recorder;   /* network.c; NULL: one shader is built */
    struct recorder *recorded;   /* that of a network whose layers are complete */
    VEC(struct aov_use) aovs;    /* of the scopes that are in work, and of the layer */
    VEC(elem_id) aov_graphs;     /* the nodegraphs of the layer's overrides; a later one wins */
    struct aov_nodes *aov_nodes; /* of the document; NULL: not yet collected */
    unsigned num_occlusions;     /* streams occlusion_0… of path tracers */
    str_id slot;           /* the name of the layer that is built, for names of variables; 0 */
    struct texels *texels; /* texels.c: textures that were read, the last one first */
    /* code.h */
    VEC(struct code_value) code_values;
    struct table code_names; /* by name: indices of options->codes + 1 */
    struct table code_table; /* by definition: indices of code_impls + 1 */
    VEC(const struct implementation *) code_impls;
    struct table code_expressions; /* by key: indices of code_parsed + 1 */
    VEC(struct code_parsed) code_parsed;
    uint32_t code_serial, code_depth;
    uint32_t without_code;  /* 1 + the definition whose code does not count; 0: all codes count */
    bool has_colorspace;    /* the library has transforms to the option's colour space */
    bool has_distance_unit; /* the library has the option's unit */
    bool cancelled;
};

/* True if the shader has a vertex stage, which can compute values for the pixels. */
static inline bool build_has_vertex_stage(const struct builder *b)
{
    return (b->options->caps & CAP_VERTEX_STAGE) && b->shader->role->stages != STAGES_NONE;
}

static inline const char *build_text(const struct builder *b, str_id id)
{
    return str_text(b->shader->strings, id);
}

static inline const struct document *build_doc(const struct builder *b)
{
    return &b->lib->doc;
}

/* True for types whose values are numbers: the types of parameters and uniforms. */
static inline bool build_is_number(ir_type_id type)
{
    return type >= IR_TYPE_BOOL && type <= IR_TYPE_MAT4;
}

/* scope.c */
static inline uint32_t *build_slot(struct instance *scope, elem_id node)
{
    assert(node - scope->first < scope->num_slots);
    return &scope->slots[node - scope->first];
}
/* The scope of a nodegraph inside another scope. */
struct instance *build_new_instance(struct builder *b, struct instance *parent, elem_id graph);
/* Output `output` of a node that build_demand has visited; POISON of `type` after an error. */
ir_ref build_result(struct builder *b, struct instance *scope, elem_id node, unsigned output,
                    doc_type type);

/* demand.c: computes the results of a node. Afterwards its slot is SLOT_ERROR or holds results. */
void build_demand(struct builder *b, struct instance *scope, elem_id node);
/* the value of builder->apply */
void build_apply_definition(struct builder *b, uint32_t nodedef, elem_id where, const ir_ref *args,
                            ir_ref *results);

/*
 * Applies a definition to arguments without a document node, for geometric properties and colour
 * transforms. `where` is the element that needs it, for diagnostics. Writes one ref per output;
 * poison after an error.
 */
static inline void build_apply(struct builder *b, uint32_t nodedef, elem_id where,
                               const ir_ref *args, ir_ref *results)
{
    b->apply(b, nodedef, where, args, results);
}

/*
 * memo.c: the memo of a nodegraph with these arguments; adds it if absent. A later addition moves
 * it.
 */
struct memo *build_memo(struct builder *b, uint32_t impl, const ir_ref *args, uint32_t n);

/*
 * unread.c: the inputs that a surface has, and the nodegraph of its definition does not read. Keeps
 * a displacement for the material that the surface is built for, and warns of the others.
 */
void build_unread_inputs(struct builder *b, const struct frame *surface, elem_id graph);
/* The displacement that was kept for a material without a displacement shader; 0: none. */
ir_ref build_own_displacement(struct builder *b, const struct frame *material);

/* graph_functions.c: the memo of the function for a nodegraph, or LIBRARY_NONE to inline it. */
uint32_t build_outlined(struct builder *b, const struct frame *frame);
/* Replaces the arguments of frame->inner by parameters. */
void build_begin_function(struct builder *b, struct frame *frame);
/* Writes one ref per output of the definition. */
void build_call_function(struct builder *b, const struct frame *frame, uint32_t function,
                         ir_ref *results);

/*
 * trace.c: adds notes with the nodes that use the current nodegraph; the `trace` of a struct
 * diag_list.
 */
void build_trace(void *builder, struct diag_list *list);

/* input.c */

/* The value of a binding. The bound node must have results already. `node` owns the input. */
ir_ref build_input(struct builder *b, struct instance *scope, elem_id node, const struct port *port,
                   const struct binding *binding);
/* build_input without the conversion: in the colour space and the unit that it is written in. */
ir_ref build_written_input(struct builder *b, struct instance *scope, elem_id node,
                           const struct port *port, const struct binding *binding);

/* published.c */

/* The interface variable for an input of a node. `element` holds its value; 0: no element does. */
struct shader_variable build_describe(struct builder *b, elem_id node, const struct port *port,
                                      elem_id element, str_id input, str_id path);
/*
 * A literal or default of an input of a document node: a uniform or a constant, according to the
 * interface mode. `authored`: the document holds the value.
 */
ir_ref build_publish(struct builder *b, elem_id node, const struct port *port, elem_id element,
                     str_id input, ir_ref value, bool authored);
/*
 * Lists an input of the document among those whose value is compiled in, once. Inputs of nodes in
 * the library are not listed. `element` holds the value; 0: the definition does.
 */
void build_compile_in(struct builder *b, elem_id node, const struct port *port, elem_id element);
/* The path of an input: "SR_gold/base_color". */
str_id build_input_path(struct builder *b, elem_id node, str_id input, elem_id element);
/* The reason why no shader can have this uniform; NULL: it can. Hosts bind uniforms by name. */
const char *build_uniform_fault(const struct builder *b, str_id name, ir_type_id type);

/* unconnected.c */

/*
 * The constant in attribute `value` of an element, given as `text`; poison and a diagnostic if it
 * does not parse.
 */
ir_ref build_constant(struct builder *b, const struct port *port, str_id text, elem_id element);
/* The default of an input: default value, geometric property, or absent (0 for closures). */
ir_ref build_default(struct builder *b, const struct port *port);
/* property.c */
struct property {
    str_id name; /* "st" */
    ir_type_id type;
    /* of a geometry without the property; NULL: 0, or no file */
    const struct ir_value *value;          /* of the type */
    const struct shader_variable *texture; /* for the type SAMPLER */
};
/* A property of the geometry: a stream, or for booleans and textures a uniform. */
ir_ref build_property(struct builder *b, const struct property *property);

/* The value of a geometric property. */
ir_ref build_geomprop(struct builder *b, const struct geomprop *prop);
/* The value of `defaultgeomprop`, an attribute of an input of a type; poison after a report. */
ir_ref build_default_geomprop(struct builder *b, elem_id element, doc_type type);
/*
 * The value of a constant, or the initial value of a uniform, for compile-time decisions; false for
 * other nodes. The uniform is then listed as compiled in, because another value may decide
 * otherwise.
 */
bool build_initial(struct builder *b, ir_ref value, struct ir_value *out);
/* The value of a node that needs constants and uniforms only, by their initial values. */
bool build_evaluate(struct builder *b, ir_ref value, struct ir_value *out);

/*
 * color.c: converts a color3 or color4 from `space` to the working space, with the transform nodes
 * of the library.
 */
ir_ref build_color_transform(struct builder *b, ir_ref value, doc_type type, str_id space,
                             struct diag_place place);
/* build_color_transform without a report; 0: the library has no such transform. */
ir_ref build_find_transform(struct builder *b, ir_ref value, doc_type type, str_id space);
/* Reports an option with an unsupported space or unit. */
void build_check_colorspace(struct builder *b);
void build_check_distance_unit(struct builder *b);
/*
 * The factor from the unit that an element names to the unit that `declared` names, or to that of
 * the options; 1 after a report. `declared` 0: there is no definition.
 */
float build_unit_factor(struct builder *b, elem_id of_unit, elem_id declared);
/* The colour space of an element, from itself or an ancestor; 0: none, or the working space. */
str_id build_colorspace(struct builder *b, elem_id element);

/*
 * The colour space and the unit of a value. The element that has the value says it, wherever it
 * stands; otherwise the input that reads the value through an interface; of spaces otherwise the
 * parents of the value.
 */
struct build_meaning {
    const struct port *port;
    elem_id of_space, of_unit; /* the elements that say so; of_unit 0: no unit */
    str_id space;              /* 0: the working space */
};
/* `node` has the input with the binding: a value, or BIND_INTERFACE. */
struct build_meaning build_meaning_of(struct builder *b, elem_id node, const struct port *port,
                                      const struct binding *binding);
/* The default of a definition: in the space that its input, or the user's document, says. */
struct build_meaning build_meaning_of_default(struct builder *b, const struct port *port);
/*
 * The meaning of what a file contains, which a node reads through an input of its definition: the
 * element that names the file says it, also where the file comes from another node.
 */
struct build_meaning build_meaning_of_file(struct builder *b, const struct frame *frame,
                                           uint32_t input);
/*
 * The meaning of a property of the geometry, which a node reads: of colours the space that the node
 * itself has, not its parents; false: it has none (specification, "Geometric Node Notes").
 */
bool build_meaning_of_property(struct builder *b, elem_id node, struct build_meaning *out);
/* A value of a type in the working space and the unit of the target; other types stay. */
ir_ref build_convert(struct builder *b, ir_ref value, doc_type type,
                     const struct build_meaning *meaning);

/*
 * inverse.c: the value that build_convert turns into a value of the type; 0 with the reason: there
 * is none. Colours are constants, or have their initial values.
 */
ir_ref build_unconvert(struct builder *b, ir_ref value, doc_type type,
                       const struct build_meaning *meaning, const char **out_fault);

/*
 * node_files.c: the meaning of a node's results, from which they are converted: that of the files
 * that it reads, unless an input inside of its definition says it, or of a property of the
 * geometry; false: they are not.
 */
bool build_meaning_of_results(struct builder *b, const struct frame *frame,
                              struct build_meaning *out);
/* instance.files of a node that is a graph */
const struct build_meaning *build_meaning_inside(struct builder *b, const struct frame *frame);
/*
 * True for an input, of such a node, that stands in where a file has no texels, or a geometry no
 * property: `default`. It is converted with them afterwards, so build_border gives it in the space
 * and the unit of the results.
 */
bool build_is_border(const struct builder *b, const struct frame *frame, const struct port *port);
ir_ref build_border(struct builder *b, const struct frame *frame, uint32_t input);

/* texture.c: the file of the document that has an element; "": the library has it. */
const char *build_file_of(const struct builder *b, elem_id element);
/* Why a sandbox does not let the document refer to a texture; NULL: it may. */
const char *build_texture_fault(const struct builder *b, str_id file, elem_id element);
/* A variable for the file of `variable`. */
ir_ref build_texture(struct builder *b, struct shader_variable variable, elem_id element);
/*
 * Records how a node reads its textures before the node is built. Replaces its arguments by
 * textures with these address modes. True if a texture has tiles.
 */
bool build_note_textures(struct builder *b, const struct frame *frame);
/* lang_host.texture: reads the current tile. */
ir_ref build_read_tiles(void *user_data, enum ir_op op, const ir_ref *args);
/*
 * Reports tile reads that could not become nodes, in the IR of a document node from `first_node`
 * on.
 */
void build_check_tiles(struct builder *b, const struct frame *frame, uint32_t first_node);

/* tiles.c: finds the tiles of a filename; false: it is a single image, or an error was reported. */
bool build_find_tiles(struct builder *b, elem_id element, struct shader_variable *texture);
/* The array layer at texture coordinates, as a float, and whether a tile exists there. */
ir_ref build_tile_layer(struct builder *b, const struct shader_variable *texture, ir_ref uv,
                        ir_ref *out_inside);

/* filename.c: the value of a filename element with its prefix and tokens. */
str_id build_file_name(struct builder *b, const struct instance *scope, elem_id element);
/* The file that the definition of a node has for an input; its tokens may be those of the node. */
str_id build_default_file_name(struct builder *b, const struct instance *scope, elem_id node,
                               const struct port *port);
/* True if a node sets tokens, so that its results cannot be shared. */
bool build_has_tokens(const struct builder *b, elem_id node, uint32_t nodedef);

/* choose.c */

/* The implementation of a definition for the target; NULL after a diagnostic. */
const struct implementation *build_choose(struct builder *b, uint32_t nodedef, elem_id node);
/* The implementation of a definition for the target; NULL: there is none. */
const struct implementation *build_best_implementation(struct builder *b, uint32_t nodedef);

/* code_table.c: finds the codes that the target has. */
void code_find_all(struct builder *b);
/* An implementation of kind IMPL_CODE for a definition; NULL: no code of a host serves it. */
const struct implementation *code_implementation(struct builder *b, uint32_t nodedef);

/* prelude.c */

/*
 * True if source for the target uses names that MaterialX's generator puts above it, without
 * declaring them.
 */
bool build_uses_prelude(const struct builder *b, const struct implementation *impl);
/* The first such name that mxgen has no helper for; NULL: there is none. */
const char *build_absent_name(const struct builder *b, const struct implementation *impl);
/*
 * The definition of a node for a type: "ND_constant_color3" for "constant"; LIBRARY_NONE if the
 * library has none.
 */
uint32_t build_definition_of(const struct builder *b, const char *node, str_id type);

/* node_results.c: results of a node from its arguments, except graphs. Writes one ref per output.
 */
void build_node(struct builder *b, const struct frame *frame, ir_ref *results);
/* The callee index of a leaf family, for a LEAF. */
uint32_t build_leaf_callee(struct builder *b, uint32_t family);
/* Calls an expression or function implementation. */
void build_call(struct builder *b, const struct implementation *impl, const ir_ref *args,
                ir_ref *results);

/* struct.c */

/* The type of a graph's nodes for a type of the document. */
ir_type_id build_type(const struct builder *b, doc_type type);
/* The value of a struct type: its text, or without text its default. Poison after a report. */
ir_ref build_struct(struct builder *b, const struct port *port, str_id text, elem_id element);

/* verbatim.c: calls source for one target. Source that mxgen cannot call is an error. */
void build_verbatim(struct builder *b, const struct frame *frame, ir_ref *results);
/*
 * The arguments of a portable function for one target: a string is the index of its word where the
 * parameter is an int, and extra inputs follow.
 */
const ir_ref *build_function_arguments(struct builder *b, const struct frame *frame);
/* source_words.c: the arguments of a call with the values that the source has for words. */
ir_ref *build_source_arguments(struct builder *b, const struct frame *frame);
/* True if the source is the function of a light shader. */
bool build_is_light_source(const struct builder *b, const struct implementation *impl);
/* Adds the function of a light shader to the shader; UINT32_MAX after a diagnostic. */
uint32_t build_light_source(struct builder *b, const struct implementation *impl);

/*
 * aov.c: surfaces and materials with the AOVs of a scope (docs/slots.md, "AOVs"). The code of <aov>
 * and <aovpass> notes each that is built in builder->aovs.
 */
/* The next <aov> or <aovpass> of a nodegraph from `element` on; 0: none. */
elem_id build_next_aov(const struct builder *b, elem_id element);
/*
 * Gives the results of a nodegraph, whose <aov> nodes are all built, their values: those of
 * builder->aovs from `first` on, which are then gone.
 */
void build_finish_graph_aovs(struct builder *b, const struct frame *frame, ir_ref *results);
bool build_is_aov(const struct document *doc, elem_id element);
void build_leave_out_aov(struct builder *b, const struct aov_use *use, const char *why);
/* Gives the surfaces of a root the value of an AOV, unless it reports a fault. */
void build_add_aov(struct builder *b, const struct aov_use *use, ir_ref *root);
/* Reports two AOVs of one name in one material; false. */
bool build_report_second_aov(struct builder *b, const struct aov_use *first,
                             const struct aov_use *second);
/*
 * aov_document.c: builds the AOVs of a surface or material of the document, and gives it their
 * values. 0 stays 0.
 */
ir_ref build_element_aovs(struct builder *b, ir_ref root);

/* film.c: a thin film on a BSDF, as inputs of its microfacet leaves. `node` is the film node. */
ir_ref build_film(struct builder *b, ir_ref thickness, ir_ref ior, ir_ref base, elem_id node);

/* slab.c: the lobes of a slab at a place, by the definition ND_slab_lobes of the library. */
ir_ref build_slab_lobes(struct builder *b, const ir_ref *inputs, const struct slab_place *place);
/* With a mark, where the surface is stored. */
ir_ref build_marked_lobes(struct builder *b, const ir_ref *inputs, const struct slab_place *place);
/* slabs_host.slab_of: by the library's definition ND_slab_of_ and the name of the leaf's function.
 */
ir_ref build_slab_of(struct builder *b, ir_ref leaf, bool is_top, bool loosely);
/* True if a slab stands for all parts of a leaf. */
bool build_fits_slab(struct builder *b, ir_ref leaf);
/* slabs_host.slab_like */
ir_ref build_slab_like(struct builder *b, ir_ref leaf, ir_ref albedo);
/* The origin of what is built, as far as it has an element of a document. */
const struct ir_origin *build_element_origin(const struct ir_graph *graph);
/* The attribute of a SLAB that the document describes. */
uint32_t build_slab_lacks(const struct builder *b);
/* The definition of this name; LIBRARY_NONE: the library has none. */
uint32_t build_definition_named(const struct builder *b, const char *name);
/* A closure by the definition of this name, with defaults but its colour; 0: the library has none.
 */
ir_ref build_leaf_of_color(struct builder *b, const char *definition, ir_ref color);
/* The definition of the lobes of slabs; LIBRARY_NONE: the library has none. */
uint32_t build_slab_definition(const struct builder *b);

/* blur.c: averages `in` over texture coordinates. `node` is the blur node. */
ir_ref build_blur(struct builder *b, ir_ref in, ir_ref size, ir_ref filtertype, elem_id node);
/*
 * Averages `in` over the surface around `position`, a vec3, by a normal distribution; its deviation
 * along each axis of the surface, a float, is in units of the world.
 */
ir_ref build_blur_around(struct builder *b, ir_ref in, ir_ref position, ir_ref deviation);

/*
 * profile.c: emission with the photometric file of a texture; even emission if the file is
 * unreadable.
 */
ir_ref build_measured_edf(struct builder *b, ir_ref color, ir_ref normal, ir_ref file,
                          elem_id node);

/*
 * network.c, for builders that record a network. build_node: records a layer for results that are
 * no plain values. The results become sources that stand for the layer; closures stay.
 */
void build_record_node(struct builder *b, const struct frame *frame, ir_ref *results);
/* The closure of the node at hand changes other closures, which no layer of a network can. */
void build_leave_layer(struct builder *b);
/* True after a report: the network has too many layers, and the work ends. */
bool build_network_is_full(const struct builder *b);
/* The default of an input in the network's layers; type VOID or 0: it has no number. */
struct ir_value build_network_default(struct builder *b, const struct port *port);

/*
 * dynamic.c. True if the node makes a closure or shader of other closures and shaders, as layers
 * do: mxgen's own code for such a node also serves where a library has source for it, because the
 * closures below it are no values. For targets with closures this holds for all shaders.
 */
bool build_is_combined(const struct builder *b, const struct frame *frame);
/* compose.c: the parts of a layer of a stack. */
struct build_part {
    const char *slot; /* for names of values; "" if it is in no stack */
    ir_ref sides[2];  /* surface and back */
    ir_ref displacement, normal;
    ir_ref mask, cutout; /* floats; 0: 1 */
    enum ir_slot_mode displacement_mode, normal_mode;
    bool is_vertical;
    ir_ref hides, presence; /* of the side at hand */
};
/* The parts of a built material. */
struct build_part build_part_of(struct builder *b, ir_ref material);
/* Layers, base first, as one MATERIAL. */
ir_ref build_compose(struct builder *b, struct build_part *parts, uint32_t num);
/* A SUBSTANCE, which is not in a stack, as a MATERIAL. */
ir_ref build_lone_substance(struct builder *b, ir_ref substance);
/* The attr of a SUBSTANCE; the mode of a word, -1: it is none. */
uint32_t build_modes(unsigned displacement, unsigned normal);
int build_mode(const char *word);

/* lang_host.too_large and bad_index. */
void build_report_large(void *user_data);
void build_report_index(void *user_data, int32_t index, uint32_t length);

/*
 * dynamic.c: builds nodes in the C code of mxgen. Poison after a report: there is no code for the
 * node, or the definition differs from its needs.
 */
void build_dynamic(struct builder *b, const struct frame *frame, ir_ref *results);

#endif
