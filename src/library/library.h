// SPDX-License-Identifier: Apache-2.0
/*
 * Node definitions and their implementations, indexed for lookup.
 *
 * A `library` is one library layer: the library image, an extra library, or a document. A layer
 * stacks on the layer below and reads it. Ids (of elements, nodedefs, functions…) count through the
 * layers, so a reference is an id without a layer. A layer does not change after library_index and
 * has no pointers between its records, so mxgen can write it as an image and map it.
 */
#ifndef MXG_LIBRARY_LIBRARY_H
#define MXG_LIBRARY_LIBRARY_H

#include "document/document.h"
#include "parse/parse.h"
#include "print/print.h"
#include "shader/verbatim.h"

#define LIBRARY_NONE UINT32_MAX

enum port_flags {
    PORT_UNIFORM = 1,   /* uniform="true": the source of a connection must not vary */
    PORT_HAS_VALUE = 2, /* the definition has a default value */
    PORT_ENUM = 4,      /* has an enumeration */
};

struct port { /* an input or output of a definition */
    str_id name;
    doc_type type;
    uint16_t flags;
    str_id value;    /* default value as text */
    str_id geomprop; /* defaultgeomprop of an input; defaultinput of an output */
    elem_id element;
};

enum { LIBRARY_MAX_OUTPUTS = 64 }; /* of a definition: the builder has room for them */

struct nodedef {
    str_id name, node, version;
    uint32_t first_target; /* in refs: the names of the targets that it is for */
    elem_id element;
    uint32_t first_port; /* inputs first, then outputs */
    uint16_t num_inputs, num_outputs;
    uint32_t first_impl;     /* of the same layer, linked by next; LIBRARY_NONE */
    uint32_t next_same_node; /* next definition of the same node in this layer; LIBRARY_NONE */
    uint16_t num_targets;    /* 0: it is for all */
    bool is_default_version;
    uint8_t reserved; /* 0: no record of a library image has padding, which would be garbage */
};

enum impl_kind {
    IMPL_EXPRESSION, /* ref: first of num_outputs expression functions in the layer's refs */
    IMPL_FUNCTION,   /* ref: lang function id; count: bits of library_extra_inputs */
    IMPL_FAMILY,     /* ref: index of the leaf family */
    IMPL_GRAPH,      /* ref: element of the nodegraph */
    /* C code builds it; the node's name selects the code, or `ref` if that is chosen_input */
    IMPL_DYNAMIC,
    IMPL_VERBATIM, /* ref: verbatim source */
    IMPL_FOREIGN,  /* for a target that mxgen does not have: its source is unread */
    /* its diagnostics are deferred: [ref, ref + count) of the layer's deferred list */
    IMPL_BROKEN,
    IMPL_CODE, /* C code of a host; ref: its index. No library has this kind */
};

struct implementation {
    str_id name, target;
    uint32_t nodedef;
    uint32_t ref, count;
    uint32_t next;   /* next implementation of the same nodedef in this layer */
    elem_id element; /* <implementation> or functional <nodegraph> */
    uint8_t kind;    /* enum impl_kind */
    uint8_t reserved[3];
};

/* The functions of a leaf family (docs/library.md); LIBRARY_NONE if absent. */
enum family_member {
    FAMILY_EVAL,
    FAMILY_ENVIRONMENT,
    FAMILY_TRANSMISSION,
    FAMILY_THROUGHPUT,
    FAMILY_EMISSION,
    FAMILY_FACTOR,
    FAMILY_ABSORPTION,
    FAMILY_SCATTERING,
    FAMILY_ANISOTROPY,
    FAMILY_ALBEDO,
    FAMILY_REFRACTION,
    FAMILY_SAMPLE,
    FAMILY_PDF,
    FAMILY_TRANSMITTANCE,
    FAMILY_WAY,
    FAMILY_TINT,
    FAMILY_FACET,
    NUM_FAMILY_MEMBERS
};

struct family {
    str_id name;
    uint32_t functions[NUM_FAMILY_MEMBERS]; /* lang function ids */
    uint32_t nodedef;
};

/* A file with source for one target. */
struct source_file {
    str_id name; /* as the reader gave it */
    str_id text;
    uint32_t first_include, num_includes; /* in refs: source files, one per #include, in order */
};

/*
 * A file that a generator of MaterialX adds for a function that no file includes: the environment.
 * `environment` is the value of the option that selects the file; -1: any.
 */
struct implied_include {
    const char *target, *function, *file;
    int environment;
};
extern const struct implied_include library_implied_includes[];

/* Parameters that a function may have after the inputs of its node, with their values. */
struct extra_input {
    const char *name;
    ir_type_id type;
    float value; /* of every component */
};
enum { LIBRARY_NUM_EXTRA_INPUTS = 2 };
extern const struct extra_input library_extra_inputs[LIBRARY_NUM_EXTRA_INPUTS];

struct verbatim {
    uint32_t file;                       /* source file; LIBRARY_NONE: there is none */
    str_id function;                     /* 0: expressions */
    uint32_t first_expression;           /* in refs: str_id per output */
    uint32_t first_implied, num_implied; /* in refs: pairs of implied include and source file */
    bool is_plain;                       /* f(inputs, results): no convention */
    bool has_suffixes;                   /* a function per context: f_reflection */
    uint8_t convention;                  /* enum source_convention */
    uint8_t contexts;                    /* of a closure: bits by enum source_context */
    uint8_t extra;                       /* bits: which of library_extra_inputs it takes */
    /* the first reason why it is not portable, and its place */
    str_id reason, reason_file;
    uint32_t reason_line, reason_column;
};

/* The source of the value of a node's input. */
enum binding_kind {
    BIND_DEFAULT, /* the default of the definition */
    BIND_VALUE,   /* attribute `value` of `element` */
    BIND_NODE,    /* output `output` of node `ref` (an element) */
    /* the input named `ref` of the definition that the enclosing nodegraph implements */
    BIND_INTERFACE,
    BIND_ERROR, /* reported; use poison */
};

struct binding {
    uint8_t kind;   /* enum binding_kind */
    uint8_t output; /* BIND_NODE: which output */
    /* BIND_INTERFACE: a guess of the input's index in the definition */
    uint16_t input;
    uint32_t ref;
    elem_id element; /* the <input>; 0 if the node does not have it */
};

/* A node of a nodegraph with its resolved definition and connections. */
struct graph_node {
    elem_id element;
    uint32_t nodedef;       /* LIBRARY_NONE after an error */
    uint32_t first_binding; /* num_inputs of the nodedef, in its order */
};

struct geomprop { /* <geompropdef> */
    str_id name;
    doc_type type;
    uint16_t index;
    str_id geomprop, space; /* "normal", "world" */
    uint32_t nodedef;       /* the node that computes it; LIBRARY_NONE: a named stream */
    elem_id element;
};

struct unit { /* <unit> of a <unitdef> */
    str_id name, type;
    float scale; /* factor to the base unit of its type; 0: no valid scale */
    elem_id element;
};

struct user_type { /* <typedef> that is not a standard type */
    str_id name, semantic;
    ir_type_id ir; /* a struct of the lang unit, or VOID */
    uint16_t reserved;
    elem_id element;
};

enum library_trust { /* which source of implementations a layer may contain */
                     LIBRARY_TRUST_ALL,
                     LIBRARY_TRUST_PORTABLE, /* only source in the portable language */
                     LIBRARY_TRUST_GRAPHS,   /* no source */
};

struct library {
    struct library *base;
    /* hash of the bytes of this layer and the layers below; unused for documents */
    uint64_t digest;
    enum library_trust trust;
    /* true for the MaterialX name of a target that mxgen has; NULL: it has all */
    bool (*knows_target)(const void *user_data, const char *materialx_name);
    const void *target_user_data;
    /* of a generation: the target and what it inherits, nearest first; 0: no target is meant */
    const str_id *targets;
    unsigned num_targets;
    const struct strpool *target_strings;
    struct strpool strings;
    struct document doc;
    struct lang_unit unit;
    uint32_t base_nodedefs, base_impls, base_families, base_verbatims, base_sources, base_types,
        base_geomprops;
    VEC(struct nodedef) nodedefs;
    VEC(struct port) ports;
    VEC(struct implementation) impls;
    VEC(struct family) families;
    VEC(struct verbatim) verbatims;
    VEC(struct source_file) sources;
    /*
     * nodes of nodegraphs with a nodedef, resolved before use; image layers only; saves a sixth of
     * mxgen check (docs/benchmarks.md)
     */
    VEC(struct graph_node) graph_nodes;
    VEC(struct binding) bindings;
    VEC(struct geomprop) geomprops;
    VEC(struct user_type) types;
    VEC(struct unit) units; /* sorted by name, then by document order */
    VEC(uint32_t) refs;
    /* node name → first nodedef of that node (own index + 1) */
    struct table node_table;
    /*
     * per own element: 1 + own index of its nodedef, type, geomprop or graph_node, or of the first
     * implementation that is this nodegraph; 0 = none
     */
    VEC(uint32_t) element_info;
    /* replaces `element_info` in an image layer whose indices fit in 16 bits */
    const uint16_t *narrow_info;
    /* nodedef of a lower layer → its first implementation in this layer (own index + 1) */
    struct table overrides;
    struct diag_list *deferred; /* errors of implementations, which appear when a node uses one */
};

/* library.c */

/*
 * Takes the definitions of another layer for the document and the strings of this one: those of the
 * other layer, and more. The other layer lives as long.
 */
void library_share(struct library *lib, const struct library *from);
void library_init(struct library *lib, struct arena *arena, struct library *base);

const struct nodedef *library_nodedef(const struct library *lib, uint32_t id);
const struct implementation *library_impl(const struct library *lib, uint32_t id,
                                          const struct library **out_layer);
const struct family *library_family(const struct library *lib, uint32_t id);
const struct verbatim *library_verbatim(const struct library *lib, uint32_t id,
                                        const struct library **out_layer);
const struct source_file *library_source(const struct library *lib, uint32_t id,
                                         const struct library **out_layer);
/* Adds a source file and its includes to `out`, each once. */
struct library_sources { /* layout of VEC(uint32_t) */
    uint32_t *items;
    uint32_t len, cap;
};
void library_collect_sources(const struct library *lib, uint32_t file, struct arena *arena,
                             struct library_sources *out);
const struct geomprop *library_geomprop(const struct library *lib, str_id name);
uint32_t library_num_nodedefs(const struct library *lib); /* including lower layers */
/*
 * The first definition of a node in one layer, as an index in this layer; LIBRARY_NONE.
 * `next_same_node` links the others.
 */
uint32_t library_first_of_node(const struct library *layer, str_id node);
/*
 * The first implementation that a layer has for a definition of a lower layer; LIBRARY_NONE. `next`
 * links the others.
 */
uint32_t library_first_override(const struct library *layer, uint32_t nodedef);

/*
 * True if an implementation serves every target: it names none, it is code of mxgen, or its source
 * for MaterialX's GLSL is portable.
 */
bool library_is_portable(const struct library *lib, const struct implementation *impl);

/*
 * Leaves out the definitions of files before 1.39 that a lower layer has by their names, with their
 * implementations: before the layer is indexed. Warns of them once.
 */
void library_leave_older(struct library *lib, struct diag_list *diags);

/* Reports how many implementations of a layer are for targets that mxgen does not have. */
void library_report_foreign(const struct library *lib, struct arena *scratch,
                            struct diag_list *diags);

/* The ports of a definition: inputs, then outputs. */
const struct port *library_ports(const struct library *lib, uint32_t nodedef,
                                 const struct library **out_layer);
int library_find_input(const struct library *lib, uint32_t nodedef, str_id name);  /* -1: none */
int library_find_output(const struct library *lib, uint32_t nodedef, str_id name); /* -1: none */

/*
 * The layer of an element, and the element's element_info (an index in this layer; LIBRARY_NONE).
 */
const struct library *library_of_element(const struct library *lib, elem_id element);
uint32_t library_element_info(const struct library *lib, elem_id element,
                              const struct library **out_layer);

/* The id of the definition of this name; LIBRARY_NONE. */
uint32_t library_nodedef_by_name(const struct library *lib, str_id name);

/* A type by name, standard or from a typedef; 0: unknown. And the inverse. */
doc_type library_type(const struct library *lib, str_id name);
str_id library_type_name(const struct library *lib, doc_type type);
elem_id library_typedef(const struct library *lib,
                        doc_type type); /* of a type that is not standard */
ir_type_id library_type_ir(const struct library *lib, doc_type type);

/* units.c: adds the units of a <unitdef>. The caller sorts the units afterwards. */
void library_index_units(struct library *lib, elem_id unitdef);
void library_sort_units(struct library *lib);

/*
 * layer_index.c: fills a layer from its document: definitions, implementations (`reader` reads
 * their source), types, geomprops.
 */
void library_index(struct library *lib, const struct lang_reader *reader, struct diag_list *diags);
/* Resolves every nodegraph with a nodedef in the layer. An image stores the result. */
void library_resolve_graphs(struct library *lib, struct diag_list *diags);

/* targets.c */

/*
 * How fit a definition is for the target of a generation; higher is better, 0: it is for others.
 * Without a target, a definition for all targets is better than one for some.
 */
unsigned library_target_fit(const struct library *lib, uint32_t nodedef);
/* True if there is a target for both definitions, which are of this layer; for all is none. */
bool library_share_target(const struct library *layer, const struct nodedef *a,
                          const struct nodedef *b);
/* True if the definition of a node may depend on the target. */
bool library_depends_on_target(const struct library *lib, elem_id node);

/* match.c */

/*
 * The definition of a node element: by its `nodedef` attribute, otherwise by name, version, types
 * and the target. If none matches, the closest one that gives the node's type, after a diagnostic
 * for each fault of the node. LIBRARY_NONE after a diagnostic: an unknown node, or one of another
 * type.
 */
uint32_t library_match(const struct library *lib, elem_id node, struct diag_list *diags);

/* connections.c */

/*
 * Inputs of nodes and of plain nodegraphs that other ports drive: the input has the value or the
 * connection of `source`, an <output> or <input>, in the place of its own. Tokens that a <token>
 * drives are in the same list, because an owner has no input and token of one name.
 */
struct library_drive {
    elem_id owner;
    str_id input;
    elem_id source;
};
struct library_drives {
    VEC(struct library_drive) items;
    struct table table;
};
/* Adds a drive; a later one of the same input replaces an earlier one. */
void library_drive(struct library_drives *drives, struct arena *arena, struct library_drive drive);
/* The source that drives an input; 0: none. drives may be NULL. */
elem_id library_driver(const struct library_drives *drives, elem_id owner, str_id input);

/*
 * True if an input of one type takes what has another: they are equal, or a string is the name of a
 * file (specification, "Inputs").
 */
static inline bool library_accepts(doc_type input, doc_type have)
{
    return input == have || (input == DOC_TYPE_filename && have == DOC_TYPE_string);
}

/*
 * The ends of chains of ports, so that each port is followed once, however many chains go through
 * it. They hold for one set of drives, and faults of a chain are reported once: empty it for other
 * drives and for another list of diagnostics.
 */
struct library_chain {
    elem_id port;
    doc_type type; /* that is wanted */
    struct binding end;
};
struct library_chains {
    VEC(struct library_chain) items;
    struct table table;
};

/*
 * Resolves the definition and the bindings of a node. `bindings` needs room for the inputs of the
 * definition.
 */
struct resolve_out {
    struct arena *arena;
    VEC(struct binding) bindings;
    const struct library_drives *drives; /* NULL: nothing is driven */
    struct library_chains chains;
};
struct graph_node library_resolve_node(const struct library *lib, elem_id node,
                                       struct resolve_out *out, struct diag_list *diags);

/*
 * The <output> of a nodegraph that implements a definition, for an output of the definition; 0:
 * none. A single output may have any name (specification, "Functional Nodegraphs"). The graph is in
 * `doc`.
 */
elem_id library_inner_output(const struct library *lib, uint32_t nodedef, unsigned output,
                             const struct document *doc, elem_id graph);

/*
 * The source of the value of an <input> or <output> element. Looks through outputs and interface
 * inputs of nodegraphs without a nodedef. `type` is the type of the port.
 */
struct binding library_resolve_port(const struct library *lib, elem_id port, doc_type type,
                                    struct resolve_out *out, struct diag_list *diags);

/* Reports the unknown name of a definition in the attribute `nodedef` of an element. */
void library_report_nodedef(const struct library *lib, elem_id element, str_id name,
                            struct diag_list *diags);

/*
 * False after reporting that the name of an element stands for two elements. `attr` of `from` has
 * the reference.
 */
bool library_is_unique(const struct library *lib, elem_id element, elem_id from, str_id attr,
                       struct diag_list *diags);

/*
 * The output of a node element with the name `output`. Without a name, the only output or, with a
 * warning, the first of the type. -1 after an error. `port` is the connected port.
 */
int library_resolve_output(const struct library *lib, elem_id port, elem_id node, str_id output,
                           doc_type type, struct diag_list *diags);

/* interface_names.c */

/* The enclosing nodegraph; 0: none. */
elem_id library_graph_around(const struct library *lib, elem_id element);
/* True if something in the nodegraph reads this input of its definition. */
bool library_graph_reads(const struct library *lib, elem_id graph, str_id input);
/* True if an element in it that reads this input has the attribute. */
bool library_graph_says(const struct library *lib, elem_id graph, str_id input, str_id attr);
/*
 * attr: STR_colorspace or STR_unit, of files that a definition's nodegraph reads. True if its
 * images convert what they read: a result is a closure or a shader, or none is of a kind that has a
 * space (colours) or a unit (floats and vectors). Else the results of the node are converted, as
 * renderers do for definitions around an image.
 */
bool library_images_convert(const struct library *lib, uint32_t nodedef, str_id attr);
/*
 * True if a nodegraph hands its input to a node that reads a file, as the value that stands in for
 * the file: to `default` of an image, or `fallback` of a UsdUVTexture.
 */
bool library_graph_has_border(const struct library *lib, elem_id graph, str_id input);
/*
 * The definition that a nodegraph implements, by its own attribute or by the first
 * <implementation> of its layer. LIBRARY_NONE.
 */
uint32_t library_implemented_nodedef(const struct library *lib, elem_id graph);
/*
 * The input of a nodegraph's definition that `asker` refers to with interfacename (BIND_INTERFACE)
 * for `port`. -1 after reporting that it is missing or has another type.
 */
int library_resolve_interface(const struct library *lib, elem_id asker, uint32_t nodedef,
                              const struct binding *binding, const struct port *port,
                              struct diag_list *diags);

/*
 * defaultgeomprop.c: the property of an input's attribute `defaultgeomprop`, which it has. NULL
 * after a report: no layer defines it, or it is not of the type.
 */
const struct geomprop *library_default_geomprop(const struct library *lib, elem_id element,
                                                doc_type type, struct diag_list *diags);

/* colorspace.c */

/* The canonical name of a colour space: `space` itself, or the name that it is an alias of. */
const char *library_canonical_space(const char *space);
/* The definition that converts colours of a type; LIBRARY_NONE if there is none. */
uint32_t library_color_transform(const struct library *lib, const char *from, const char *to,
                                 const char *type);
extern const char *const library_color_hub; /* the library can convert every space to this one */
/*
 * Converts a colour of a canonical space to the hub; false: the library has no transform that can
 * run here.
 */
bool library_convert_color(const struct library *lib, const char *space, float *rgb,
                           struct arena *scratch);
/* The working space that the user may mean by an unknown word, or a list of all. */
const char *library_expect_working_space(const struct library *lib, const char *space,
                                         struct diag_list *diags);
void library_report_space(const struct library *lib, const char *space, struct diag_place place,
                          struct diag_list *diags);

/* units.c */

/* The first type that has a unit of this name; 0: none. */
str_id library_unit_type_of(const struct library *lib, str_id unit);
/* Reports that a unit is unknown, has no scale or belongs to another type. */
void library_report_unit(const struct library *lib, str_id type, str_id unit,
                         struct diag_place place, struct diag_list *diags);
/* The scale of a unit to the base unit of its type; type 0: any type. false: unknown. */
bool library_unit_scale(const struct library *lib, str_id type, str_id unit, float *out_scale);
bool library_has_unit_type(const struct library *lib, str_id type);
const char *library_suggest_unit_type(const struct library *lib, str_id type,
                                      struct diag_list *diags);
const char *library_suggest_unit(const struct library *lib, str_id unit, struct diag_list *diags);

/*
 * validate_nodes.c: checks the layer of a document against the definitions, after doc_validate. The
 * caller may free `scratch` afterwards.
 */
void library_validate(const struct library *lib, struct arena *scratch, struct diag_list *diags);

/*
 * enum.c: reports a string outside the words of its input's enumeration. 0 means an unset value,
 * which is valid.
 */
void library_check_enum(const struct library *lib, const struct port *port, str_id text,
                        struct diag_place place, struct diag_list *diags);
/* The index of a word in a list of words; -1: it is not there. */
int library_enum_index(const char *list, const char *word);
/*
 * The <input> of an <implementation> that has values of its own for the words of the definition's
 * input (specification, "Implementation Elements": enumvalues); 0: there is none.
 */
elem_id library_source_words(const struct library *lib, elem_id implementation,
                             const struct port *port);
/* The type of an input in the source of an implementation: `impltype` of such values, or its own.
 */
doc_type library_source_type(const struct library *lib, elem_id implementation,
                             const struct port *port);
/* The value at an index of a list of values of a type; len 0: the list is shorter. */
struct text_word library_enum_value(const char *list, doc_type type, unsigned index);

/*
 * shader_inputs.c: reports values where a node of this layer takes a shader, and a material without
 * any shader. An input that names a source or an input of a definition counts as given; an input of
 * a graph counts if something stands there. `bindings` are those of the node.
 */
void library_check_shaders(const struct library *lib, elem_id node, uint32_t nodedef,
                           const struct binding *bindings, struct diag_list *diags);

/* ---- struct_value.c ---- */

struct member_value {
    doc_type type;
    struct text_word text;
};
struct member_values { /* layout of VEC(struct member_value) */
    struct member_value *items;
    uint32_t len, cap;
};
/*
 * Splits "{0.5;true}" into the values of the members of a struct type, which may be none of their
 * types; false: there is not one for each. A default has no text: its members have the values of
 * the <typedef>.
 */
bool library_split_struct(const struct library *lib, doc_type type, struct text_word text,
                          bool is_default, struct arena *arena, struct member_values *out);
void library_report_struct(const struct library *lib, doc_type type, const char *text,
                           struct diag_place place, struct diag_list *diags);
/* Reports the attribute `value` of an element of a struct type, if it is no value of this type. */
void library_check_struct(const struct library *lib, elem_id element, struct arena *scratch,
                          struct diag_list *diags);

/*
 * loose.c: reports a value with more numbers than the type of its port has, with the input of the
 * same definition that the author may mean, or with text behind a number.
 */
void library_report_loose(const struct library *lib, elem_id element, doc_type type,
                          struct diag_list *diags);

/*
 * write_library.c: writes the layer as MaterialX. A definition with both code and a nodegraph,
 * which mxgen does not use, keeps the graph alone, behind a comment with the inputs that it does
 * not read.
 */
void library_write(const struct library *lib, struct text *out);
/* Warns of each of these inputs. */
void library_report_losses(const struct library *lib, struct diag_list *diags);

/* image.c */

/*
 * Writes the layer as one block. The library has no base. Only a build with the same layout of
 * records maps the block; mapping checks that. `syntax`: the block has the texts of functions in
 * it; NULL: in none.
 */
void library_write_image(const struct library *lib, const struct lang_syntax *syntax,
                         struct text *out);
/*
 * Makes `lib` refer to a mapped image, which must outlive it. Returns NULL or the reason of a
 * failure. check_bytes: verify the checksum, for files.
 */
const char *library_map_image(struct library *lib, const void *data, size_t size, bool check_bytes);

#endif
