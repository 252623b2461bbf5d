// SPDX-License-Identifier: Apache-2.0
/*
 * Node definitions and their implementations, indexed for lookup.
 *
 * A `library` is one layer: the compiled library image, an extra library, or a user's document.
 * Each stands on the one below and sees it; ids (of elements, nodedefs, functions…) count through
 * the layers, so a reference needs no layer beside it. A layer does not change once library_index
 * has run, and holds no pointers between its records, so that it can be written as an image and
 * mapped.
 */
#ifndef MXG_LIBRARY_LIBRARY_H
#define MXG_LIBRARY_LIBRARY_H

#include "document/document.h"
#include "lang/lang.h"

#define LIBRARY_NONE UINT32_MAX

enum port_flags {
    PORT_UNIFORM = 1,   /* uniform="true": may not be connected to something that varies */
    PORT_HAS_VALUE = 2, /* a default value stands in the definition */
    PORT_ENUM = 4,      /* has a list of allowed values */
};

struct port { /* an input or output of a definition */
    str_id name;
    doc_type type;
    uint16_t flags;
    str_id value;    /* default value as text */
    str_id geomprop; /* defaultgeomprop of an input; defaultinput of an output */
    elem_id element;
};

struct nodedef {
    str_id name, node, version, target;
    elem_id element;
    uint32_t first_port; /* inputs first, then outputs */
    uint16_t num_inputs, num_outputs;
    uint32_t first_impl;     /* of the same layer, chained by next; LIBRARY_NONE */
    uint32_t next_same_node; /* next definition of the same node in this layer; LIBRARY_NONE */
    bool is_default_version;
};

enum impl_kind {
    IMPL_EXPRESSION, /* ref: first of num_outputs expression functions in the layer's refs */
    IMPL_FUNCTION,   /* ref: lang function id */
    IMPL_FAMILY,     /* a closure leaf: ref: family index */
    IMPL_GRAPH,      /* ref: element of the nodegraph */
    IMPL_DYNAMIC,    /* built by C code chosen by the node's name */
    IMPL_VERBATIM,   /* ref: verbatim source */
    /* its diagnostics were deferred: [ref, ref + count) of the layer's deferred list */
    IMPL_BROKEN,
};

struct implementation {
    str_id name, target;
    uint32_t nodedef;
    uint32_t ref, count;
    uint32_t next;   /* next implementation of the same nodedef in this layer */
    elem_id element; /* <implementation> or functional <nodegraph> */
    uint8_t kind;    /* enum impl_kind */
};

/* Members of a closure leaf's family of functions (docs/library.md); LIBRARY_NONE where absent. */
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
    NUM_FAMILY_MEMBERS
};

struct family {
    str_id name;
    uint32_t functions[NUM_FAMILY_MEMBERS]; /* lang function ids */
    uint32_t nodedef;
};

struct verbatim {
    str_id source;   /* the text of the file with its includes */
    str_id function; /* 0: the text is an inline expression */
};

/* How an input of a node in a graph gets its value. */
enum binding_kind {
    BIND_DEFAULT, /* as the definition says */
    BIND_VALUE,   /* attribute `value` of `element` */
    BIND_NODE,    /* output `output` of node `ref` (an element) */
    /* the input named `ref` of the definition that the enclosing graph implements */
    BIND_INTERFACE,
    BIND_ERROR, /* reported; poison */
};

struct binding {
    uint8_t kind;   /* enum binding_kind */
    uint8_t output; /* BIND_NODE: which output */
    /* BIND_INTERFACE: where the definition has it, as far as that is known ahead */
    uint16_t input;
    uint32_t ref;
    elem_id element; /* the <input>; 0 where the node has none */
};

/* A node of a graph whose definition and connections are found. */
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
    uint32_t nodedef;       /* the node that gives it; LIBRARY_NONE: a named stream */
    elem_id element;
};

struct unit { /* <unit> of a <unitdef> */
    str_id name, type;
    float scale; /* to the base unit of its type; 0: it has none that counts */
    elem_id element;
};

struct user_type { /* <typedef> that is not a standard type */
    str_id name, semantic;
    ir_type_id ir; /* a struct of the lang unit, or VOID */
    elem_id element;
};

enum library_trust { /* in the source of implementations */
                     LIBRARY_TRUST_ALL,
                     LIBRARY_TRUST_PORTABLE, /* not in what would be emitted as it is */
                     LIBRARY_TRUST_GRAPHS,   /* in none */
};

struct library {
    struct library *base;
    /* of the bytes that the layer and those below it were read from; not of a document's */
    uint64_t digest;
    enum library_trust trust;
    struct strpool strings;
    struct document doc;
    struct lang_unit unit;
    uint32_t base_nodedefs, base_impls, base_families, base_verbatims, base_types, base_geomprops;
    VEC(struct nodedef) nodedefs;
    VEC(struct port) ports;
    VEC(struct implementation) impls;
    VEC(struct family) families;
    VEC(struct verbatim) verbatims;
    /* nodes of functional graphs, resolved ahead; image layers only */
    VEC(struct graph_node) graph_nodes;
    VEC(struct binding) bindings;
    VEC(struct geomprop) geomprops;
    VEC(struct user_type) types;
    VEC(struct unit) units; /* by name, then as they stand in the document */
    VEC(uint32_t) refs;
    /* open addressing by node name: first nodedef of that node (own index + 1) */
    VEC(uint32_t) node_table;
    /* per own element: 1 + own index of its nodedef, type, geomprop or graph_node; 0 = none */
    VEC(uint32_t) element_info;
    /* in place of `element_info` in an image layer of few definitions */
    const uint16_t *narrow_info;
    /*
     * per own element: 1 + the definition that it was found to be without a message; 0: not asked.
     * NULL: not kept
     */
    _Atomic uint32_t *matches;
    VEC(uint32_t) overrides;    /* impl indices (own) for nodedefs of lower layers */
    struct diag_list *deferred; /* faults of implementations, told when one is used */
};

/* library.c */

void library_init(struct library *lib, struct arena *arena, struct library *base);

const struct nodedef *library_nodedef(const struct library *lib, uint32_t id);
const struct implementation *library_impl(const struct library *lib, uint32_t id,
                                          const struct library **out_layer);
const struct family *library_family(const struct library *lib, uint32_t id);
const struct verbatim *library_verbatim(const struct library *lib, uint32_t id);
const struct geomprop *library_geomprop(const struct library *lib, str_id name);
uint32_t library_num_nodedefs(const struct library *lib); /* with lower layers */
/*
 * The first definition of a node in one layer, by its own index; LIBRARY_NONE. `next_same_node`
 * leads on.
 */
uint32_t library_first_of_node(const struct library *layer, str_id node);

/* The ports of a definition: inputs, then outputs. */
const struct port *library_ports(const struct library *lib, uint32_t nodedef,
                                 const struct library **out_layer);
int library_find_input(const struct library *lib, uint32_t nodedef, str_id name);  /* -1: none */
int library_find_output(const struct library *lib, uint32_t nodedef, str_id name); /* -1: none */

/* The layer that owns an element, and what its element_info says (own index; LIBRARY_NONE). */
const struct library *library_of_element(const struct library *lib, elem_id element);
uint32_t library_element_info(const struct library *lib, elem_id element,
                              const struct library **out_layer);

/* The id of the definition with this name; LIBRARY_NONE. */
uint32_t library_nodedef_by_name(const struct library *lib, str_id name);

/* A type by name, standard or from a typedef; 0: unknown. And back. */
doc_type library_type(const struct library *lib, str_id name);
str_id library_type_name(const struct library *lib, doc_type type);
ir_type_id library_type_ir(const struct library *lib, doc_type type);

/* unit.c: enters the units of a <unitdef>; to be sorted once all are in. */
void library_index_units(struct library *lib, elem_id unitdef);
void library_sort_units(struct library *lib);

/*
 * index.c: fills a layer from its document: definitions, implementations (sources are read by
 * `reader`), types, geomprops.
 */
void library_index(struct library *lib, const struct lang_reader *reader, struct diag_list *diags);
/* Resolves every functional graph of the layer ahead of time (what an image stores). */
void library_resolve_graphs(struct library *lib, struct diag_list *diags);

/* match.c */

/*
 * From now on what nodes of the layer match is kept, so that it is found once for all who ask, on
 * any thread. The tree stands.
 */
void library_keep_matches(struct library *lib, struct arena *arena);

/*
 * The definition of a node element: by its `nodedef` attribute, else by name, version, types and
 * target. LIBRARY_NONE after reporting why: unknown node, or each candidate with its reason.
 */
uint32_t library_match(const struct library *lib, elem_id node, struct diag_list *diags);

/* resolve.c */

/*
 * Finds definition and bindings of a node; bindings are written to `bindings` (room for the
 * definition's inputs).
 */
struct resolve_out {
    struct arena *arena;
    VEC(struct binding) bindings;
};
struct graph_node library_resolve_node(const struct library *lib, elem_id node,
                                       struct resolve_out *out, struct diag_list *diags);

/*
 * How an <input> or <output> element gets its value. Outputs and interface inputs of graphs that
 * define no node are followed to what stands behind them. `type` is what the port needs.
 */
struct binding library_resolve_connection(const struct library *lib, elem_id port, doc_type type,
                                          struct diag_list *diags);

/* " (did you mean 'x'?)" for the name of a definition. */
const char *library_suggest_nodedef(const struct library *lib, str_id name,
                                    struct diag_list *diags);

/*
 * The output of a node element that `output` names; without a name the only one or, with a warning,
 * the first of the type. -1 after an error. `port` is who asks.
 */
int library_resolve_output(const struct library *lib, elem_id port, elem_id node, str_id output,
                           doc_type type, struct diag_list *diags);

/* interface.c */

/* the nodegraph, 0: none */
elem_id library_graph_around(const struct library *lib, elem_id element);
/*
 * The definition that a graph of this layer implements, by its own word or that of an
 * <implementation>. LIBRARY_NONE.
 */
uint32_t library_implemented_nodedef(const struct library *lib, elem_id graph);
/*
 * Which input of a graph's definition `asker` takes its value from, a BIND_INTERFACE, for `port`.
 * -1 after reporting that there is none or that it has another type.
 */
int library_resolve_interface(const struct library *lib, elem_id asker, uint32_t nodedef,
                              const struct binding *binding, const struct port *port,
                              struct diag_list *diags);

/* colorspace.c */

/* The name by which the library knows a colour space: `space` itself, or what it is an alias of. */
const char *library_canonical_space(const char *space);
/* The definition that converts colours of a type; LIBRARY_NONE: the library knows none. */
uint32_t library_color_transform(const struct library *lib, const char *from, const char *to,
                                 const char *type);
extern const char *const library_color_hub; /* every space can be converted to it */
void library_report_space(const struct library *lib, const char *space, struct diag_place place,
                          struct diag_list *diags);

/* unit.c */

/* The first type that has a unit of this name; 0: none. */
str_id library_unit_type_of(const struct library *lib, str_id unit);
/* Tells that a unit is none, or none of its type. */
void library_report_unit(const struct library *lib, str_id type, str_id unit,
                         struct diag_place place, struct diag_list *diags);
/* The scale of a unit to its type's base unit; type 0: of any. False: unknown. */
bool library_unit_scale(const struct library *lib, str_id type, str_id unit, float *out_scale);
bool library_has_unit_type(const struct library *lib, str_id type);
const char *library_suggest_unit_type(const struct library *lib, str_id type,
                                      struct diag_list *diags);
const char *library_suggest_unit(const struct library *lib, str_id unit, struct diag_list *diags);

/*
 * validate.c: checks a document's layer against the definitions below it and its own, and
 * doc_validate's. `scratch` may be freed behind it.
 */
void library_validate(const struct library *lib, struct arena *scratch, struct diag_list *diags);

/*
 * enum.c: a string with an enum accepts its words only; others are reported. Not set, 0, is no
 * word.
 */
void library_check_enum(const struct library *lib, const struct port *port, str_id text,
                        struct diag_place place, struct diag_list *diags);

/* image.c */

/*
 * Writes the layer as one block. The library has no base. Only a build with the same layout of
 * records maps the block; mapping checks that. `syntax`: the block has the texts of functions in
 * it; NULL: in none.
 */
void library_write_image(const struct library *lib, const struct lang_syntax *syntax,
                         struct text *out);
/*
 * Makes `lib` refer into a mapped image, which must outlive it; NULL or why it was refused.
 * check_bytes: verify the checksum, for files.
 */
const char *library_map_image(struct library *lib, const void *data, size_t size, bool check_bytes);

#endif
