// SPDX-License-Identifier: Apache-2.0
/*
 * The element tree of a MaterialX document: flat arrays, 32-bit indices, interned strings, no
 * pointers.
 *
 * A document stacks on the documents of its library: it reads their elements and never changes
 * them. Element and attribute indices count through these layers. The tree is the file after
 * XInclude, templates and upgrade. The library room resolves references.
 */
#ifndef MXG_DOCUMENT_DOCUMENT_H
#define MXG_DOCUMENT_DOCUMENT_H

#include "base/strpool.h"
#include "diag/diag.h"
#include "ir/ir.h"

/* document_types.c, value.c */

/* 0 = none; standard types; from DOC_TYPE_FIRST_USER the types of <typedef> elements */
typedef uint16_t doc_type;
enum {
    DOC_TYPE_NONE,
#define DOC_TYPE(ID, ir, components, traits) DOC_TYPE_##ID,
#include "document/types.def"
#undef DOC_TYPE
    DOC_TYPE_material,
    DOC_TYPE_multioutput,
    DOC_NUM_TYPES,
    DOC_TYPE_FIRST_USER = 64
};

/* The standard type of a type name; 0 for other names. The library room handles user types. */
doc_type doc_type_of(str_id name);
str_id doc_type_name(doc_type type); /* for standard types */
/* For standard types. IR_TYPE_VOID for arrays and multioutput. */
ir_type_id doc_type_ir(doc_type type);
/* number of numeric components: 3 for color3; 0 if the type is not numeric */
unsigned doc_type_components(doc_type type);
/* Numbers and texts without a colour space; types of documents may contain colours. */
bool doc_type_is_colorless(doc_type type);
/* Floats, vectors, arrays of these, and filenames. */
bool doc_type_can_have_unit(doc_type type);

/*
 * Parses a value in MaterialX syntax ("0.5", "1, 0, 0", "true"). The type must have an IR type with
 * components. A string returns its str_id, interned in `strings` unless that is NULL. Accepts
 * surrounding blanks but no trailing text. false: the text is not a value of the type.
 */
bool doc_parse_value(doc_type type, const char *text, size_t len, struct strpool *strings,
                     struct ir_value *out);

/* True if two texts are one value of the type, however it is spelt. */
bool doc_is_same_value(doc_type type, const char *one, const char *other);

/*
 * True if the text is a value of the type; also for arrays. Always true for types without a syntax
 * (strings, filenames, shaders).
 */
bool doc_value_is_valid(doc_type type, const char *text, size_t len);
/*
 * How many numbers the text has, if they are more than the type has, or if other text follows a
 * number, as in "0.5.0"; otherwise 0. `out`, which may be NULL, gets the first ones, which are what
 * MaterialX reads.
 */
unsigned doc_read_loosely(doc_type type, const char *text, size_t len, struct ir_value *out);
/* True for numbers with a fraction, and arrays of them. */
bool doc_type_is_float(doc_type type);
bool doc_type_is_color(doc_type type);
bool doc_type_is_measure(doc_type type); /* a float or a vector: a type that has a unit */
/* The reason why a value is invalid, as a suffix for a message. */
const char *doc_value_fault(doc_type type, const char *text, size_t len, struct arena *arena);

/* document.c */

enum element_kind {
    KIND_NODE, /* every category without a meaning of its own */
#define KIND(ID, word) KIND_##ID,
#include "document/kinds.def"
#undef KIND
    NUM_ELEMENT_KINDS
};

typedef uint32_t elem_id; /* 0 = none; the root of the lowest document is 1 */

struct element {
    str_id category, name;             /* name 0: none */
    elem_id parent, first_child, next; /* 0 = none */
    uint32_t first_attr;
    uint32_t line;   /* line of the start tag, from 1 */
    uint16_t column; /* in code points, from 1; saturates */
    uint16_t file;   /* number of the file, through the layers; 0 = none */
    uint16_t num_attrs;
    uint16_t kind; /* enum element_kind */
};

struct attribute {
    str_id name, value;
    int16_t line_delta; /* from the element's line; saturates */
    uint16_t column;    /* of the value's first character */
};

/* The path of an element without a line. */
struct doc_place_path {
    elem_id element;
    const char *path;
};

/*
 * A tree in memory has links for constant-time insertion and removal while it grows,
 * and the place of an element's name, for messages.
 */
struct doc_link {
    elem_id last_child, previous;
    uint32_t comments;    /* index in `comment_lists`, plus 1; 0 = none */
    uint16_t name_line;   /* from the element's line; saturates */
    uint16_t name_column; /* of the name's first character; 0: unknown */
};

/* Two elements of one scope and name. The second is no longer in the tree. */
struct doc_double {
    elem_id first, second;
};

/* An element that is left out of the tree, because another one of its scope has its name. */
struct doc_left_out {
    elem_id element, anchor; /* it stands behind the anchor */
    uint32_t next;           /* the next one behind the same anchor: an index plus 1; 0 = none */
    uint32_t last;           /* of the first one behind the anchor: the last one, an index plus 1 */
};

/* The place of a comment relative to its element. */
enum comment_place {
    COMMENT_BEFORE, /* on the lines before the element */
    COMMENT_LAST,   /* inside the element, after its last child */
    COMMENT_BEHIND, /* on the line on which the element ends */
    NUM_COMMENT_PLACES
};

/* A comment or a processing instruction of the file, or a blank line. Only doc_write reads them. */
struct doc_comment {
    str_id text;   /* with "<!--" and "-->", or "<?" and "?>"; 0: a blank line */
    uint32_t next; /* in the same place: index plus 1; 0 = none */
};

/* The comments of an element by place: indices plus 1; 0 = none. */
struct comment_lists {
    uint32_t first[NUM_COMMENT_PLACES], last[NUM_COMMENT_PLACES];
};

/* An element of an edited document that differs from its origin's, or is not in the origin. */
struct doc_change {
    uint32_t index; /* from first_element */
    bool is_fresh;  /* of this edit, not of one before it */
    struct element element;
    struct doc_link link;
};

/* How many items the documents have whose items a document shares. */
struct doc_counts {
    uint32_t elements, attrs, comments, comment_lists;
};

/* An attribute of an element that names an element of a scope (name_uses.c). */
struct doc_reference {
    elem_id scope; /* 0: the name counts anywhere */
    str_id name;
    elem_id element;
    uint32_t next; /* of the same scope and name: index plus 1; 0 = none */
};

/* Elements from `first` to before `end`. */
struct doc_range {
    elem_id first, end;
};

/* graph_outputs.c: the first two outputs of a nodegraph with a type; 0: of any type. */
struct doc_outputs {
    elem_id graph;
    str_id type;
    elem_id first, second; /* 0 = none */
};

struct document {
    const struct document *base;                    /* the layer below, or NULL */
    struct strpool *strings;                        /* the pool of this layer */
    struct arena *arena;                            /* NULL in an image layer */
    uint32_t first_element, first_attr, first_file; /* first index of this layer */
    elem_id root;
    /* limit of this layer for steps that multiply elements (doc_is_full); 0 = unlimited */
    uint32_t max_elements;
    bool has_templates;     /* a <template> was added after the last expansion */
    bool has_attributedefs; /* an <attributedef> was added somewhere */
    bool has_aovs;          /* an <aov> or <aovpass> was added somewhere */
    bool is_global;         /* no element has a namespace (set by doc_qualify_names) */
    bool keeps_comments;    /* the reader adds the comments of files */
    /* blanks surround some '=', so no place of an attribute's name is known */
    bool has_loose_attrs;
    /*
     * The document whose items this one shares, which lives as long; NULL: all elements are in the
     * arrays below. Otherwise `changes` has the elements that differ, and the arrays have only
     * items behind those of the origin. An origin may have an origin: `whole` is the last one,
     * which is in one piece.
     */
    const struct document *origin, *whole;
    struct doc_counts shared; /* items of the origin, with those that it shares */
    VEC(struct doc_change *) changes;
    struct table changed;         /* index of an element → position in `changes` + 1 */
    uint32_t num_added;           /* elements that the origin does not have */
    VEC(struct element) elements; /* elements of this layer */
    VEC(struct attribute) attrs;
    VEC(str_id) files;           /* names from the user or from includes */
    VEC(struct doc_range) older; /* elements of files of older versions, which are upgraded */
    VEC(elem_id) bases;          /* nodes from which others inherit in the text */
    VEC(struct doc_link) links;  /* parallel to `elements`; empty in an image layer */
    VEC(struct doc_comment) comments;
    VEC(struct comment_lists) comment_lists;
    VEC(struct doc_place_path) paths; /* ascending by element: doc_keep_paths */
    struct table names;               /* (parent, name) → element: doc_index_names */
    /* names that differing elements share, and a table by the first element */
    VEC(struct doc_double) doubles;
    struct table double_table;
    VEC(struct doc_left_out) left_out; /* in the order in which they left the tree */
    struct table left_out_table;       /* by element, and the first one by anchor: index plus 1 */
    /* who names whom, and a table (scope, name) → the last reference + 1: doc_index_references */
    VEC(struct doc_reference) references;
    struct table reference_table;
    /* the outputs of graphs by type, but for the graphs whose outputs changed: doc_index_outputs */
    bool has_outputs;
    VEC(struct doc_outputs) outputs;
    struct table output_table, touched;
};

/* Makes an empty document with a root element <materialx>. */
void doc_init(struct document *doc, struct arena *arena, struct strpool *strings,
              const struct document *base);

/*
 * Appends a child. parent 0 makes an element outside the tree. The name is not an attribute. All
 * functions that change the tree take elements of this layer, and need constant time plus the time
 * for the element's attributes.
 */
elem_id doc_add_element(struct document *doc, elem_id parent, str_id category, str_id name,
                        uint16_t file, uint32_t line, uint16_t column);
void doc_add_attr(struct document *doc, elem_id element, struct attribute attr);
/*
 * Adds an element with the place (file, line, column) of another element. Upgrade and templates use
 * it.
 */
elem_id doc_add_like(struct document *doc, elem_id parent, str_id category, str_id name,
                     elem_id origin);
/* Replaces or adds an attribute. */
void doc_set_attr(struct document *doc, elem_id element, str_id name, str_id value);
void doc_remove_attr(struct document *doc, elem_id element, str_id name);
/* also updates the kind */
void doc_set_category(struct document *doc, elem_id element, str_id category);
void doc_set_name(struct document *doc, elem_id element, str_id name);
/* The place of the name, in lines from the element's. */
void doc_set_name_place(struct document *doc, elem_id element, uint32_t line, uint32_t column);
void doc_set_place(struct document *doc, elem_id element, uint16_t file, uint32_t line,
                   uint16_t column);
/*
 * Unlinks the element from its parent. Its parent becomes 0. Its comments go to the next sibling,
 * or to the end of the parent.
 */
void doc_remove_element(struct document *doc, elem_id element);
/* As above, but the element keeps its comments. */
void doc_unlink_element(struct document *doc, elem_id element);
/* Puts an element, which may be outside the tree, behind another one. */
void doc_link_after(struct document *doc, elem_id element, elem_id sibling);
/* Appends the element to the children of another parent. */
void doc_move_element(struct document *doc, elem_id element, elem_id new_parent);
void doc_move_before(struct document *doc, elem_id element, elem_id sibling);
/* comment.c */

/* Appends a comment, or a blank line (text 0), to the element's comments in a place. */
void doc_add_comment(struct document *doc, elem_id element, enum comment_place place, str_id text);
/* Moves the comments of an element before another one, or to the end of the other's children. */
void doc_move_comments(struct document *doc, elem_id from, elem_id to, enum comment_place place);
/* The first comment of an element in a place: an index plus 1; 0 = none. */
uint32_t doc_first_comment(const struct document *doc, elem_id element, enum comment_place place);

/* document.c */

/* The number of a file name; adds the name if this layer lacks it. 0: more than 65,535 files. */
uint16_t doc_add_file(struct document *doc, str_id name);

/*
 * A restore point. Restoring removes everything added after the mark, and restores `root`, which
 * must have no children at the mark.
 */
struct doc_mark {
    uint32_t num_elements, num_attrs, num_comments, num_comment_lists;
    struct element root;
    bool has_templates;
};
struct doc_mark doc_mark(const struct document *doc, elem_id root);
void doc_rollback(struct document *doc, elem_id root, const struct doc_mark *mark);

/*
 * The next element in document order in the subtree of `root`; 0 after the last. Starts with `root`
 * itself.
 */
elem_id doc_next_in_tree(const struct document *doc, elem_id root, elem_id element);
/* True if an element is `outer`, or somewhere below it. Time: linear in its depth. */
bool doc_is_within(const struct document *doc, elem_id element, elem_id outer);

/*
 * Builds the index for doc_child and doc_find. Call it after the tree is complete, and again after
 * additions. With `diags` it reports duplicate names and leaves out the second element.
 */
void doc_index_names(struct document *doc, struct diag_list *diags);

/* duplicates.c: reports the second element of a name, and takes it out of the tree. */
void doc_leave_out_duplicate(struct document *doc, elem_id first, elem_id second,
                             struct diag_list *diags);
/* The sibling and the parent of an element in the tree with those that were left out; 0: none. */
elem_id doc_next_written(const struct document *doc, elem_id element);
elem_id doc_parent_written(const struct document *doc, elem_id element);
/*
 * Puts the elements that `from` leaves out into an edited copy of it, which must then be indexed as
 * a whole. false: there are none.
 */
bool doc_restore_left_out(struct document *doc, const struct document *from);
/* Indexes those whose name no other element has any more, after a change. */
void doc_index_restored(struct document *doc);
/* The second element of this one's scope and name, which the index left out; 0: none. */
elem_id doc_second_of_name(const struct document *doc, elem_id element);
/* Indexes one element that was added, renamed or moved since. */
void doc_index_element(struct document *doc, elem_id element);

/* naming.c: the attributes that name elements (references.def) */
enum doc_name_place {
    NAME_AT_ROOT,
    NAME_IN_SCOPE, /* beside the node or graph that has the port (doc_port_scope) */
    NAME_IN_SCOPE_OR_AT_ROOT,
    NAME_BESIDE, /* beside the user */
    NAME_BESIDE_OR_AT_ROOT,
    NAME_IN_INTERFACE, /* in the graph around the port, or in the definition that it implements */
    NAME_IN_SOURCE,    /* in the node or graph that the port names; if it names none, at the root */
    NAME_IN_DEFINITION, /* in the definition that has the user */
    NAME_IN_UNITS,      /* in a <unitdef> of the user's unit type */
    NAME_IN_VARIANTSET, /* in the set of variants that the user names */
};
struct doc_naming {
    str_id attr;
    enum doc_name_place place;
    uint64_t users, targets, checked; /* of kinds: references.def */
};
enum {
#define REFERENCE(attribute, users, targets, place, checked) DOC_NAMING_##attribute,
#include "document/references.def"
#undef REFERENCE
    DOC_NUM_NAMINGS
};
extern const struct doc_naming doc_namings[DOC_NUM_NAMINGS];
/*
 * How an attribute of an element names others; NULL: it names none, a type of MaterialX, or an
 * output of a node or graph.
 */
const struct doc_naming *doc_naming(const struct document *doc, elem_id user, str_id attr);
/*
 * The parent of the elements that a port can name: for an input of a node the graph of the node,
 * for an input of a graph the parent of the graph, for an output its graph.
 */
elem_id doc_port_scope(const struct document *doc, elem_id port);
/* True if the named element is a child of doc_naming_scope, which is 0 for other places. */
bool doc_is_local_name(enum doc_name_place place);
elem_id doc_naming_scope(const struct document *doc, elem_id user, enum doc_name_place place);
/* True if an attribute of `user`, which has the name of the element, names it. */
bool doc_can_name(const struct document *doc, elem_id user, str_id attr, elem_id element);
/* True if a name in a checked attribute of `user` is that of an element, here or in a library. */
bool doc_names_element(const struct document *doc, elem_id user, const struct doc_naming *naming,
                       str_id name);
/* A name in a list "a, b" or alone, from *text, which moves behind it; its length is 0 at the end.
 */
const char *doc_next_name(const char **text, size_t *len);
/* True if an attribute has the name, alone or in a list. */
bool doc_has_name(const struct document *doc, elem_id user, str_id attr, str_id name);

/*
 * name_uses.c: which elements name an element. Builds the index for doc_rename; call it after
 * doc_index_names.
 */
void doc_index_references(struct document *doc);

/* graph_outputs.c */
void doc_index_outputs(struct document *doc);
/* After a change, `element`, if it is an output, is or was below `parent`, if that is not 0. */
void doc_touch_outputs(struct document *doc, elem_id element, elem_id parent);
/* The first two outputs of a nodegraph with this type; type 0: of any type. */
struct doc_outputs doc_outputs(const struct document *doc, elem_id graph, str_id type);

/* True if a port names a node of the document beside it. */
bool doc_is_used(const struct document *doc, elem_id node);
/* Visits each attribute of the document that names an element. A visit may change the attribute. */
void doc_visit_users(struct document *doc, elem_id element,
                     void (*visit)(void *arg, elem_id user, str_id attr), void *arg);
/* Replaces a name in an attribute; `name` 0 removes it, and the attribute with the last one. */
void doc_replace_name(struct document *doc, elem_id user, str_id attr, str_id old, str_id name);
/* The attributes that connect a port, and whether it has one of them. */
enum { DOC_NUM_CONNECTIONS = 4 };
extern const str_id doc_connections[DOC_NUM_CONNECTIONS];
bool doc_is_connected(const struct document *doc, elem_id port);
void doc_disconnect(struct document *doc, elem_id port);
/* The node that a port names; 0: none. */
elem_id doc_named_node(const struct document *doc, elem_id port);
/* Indexes the name and the references of an element that an edit has changed. */
void doc_index_change(struct document *doc, elem_id element);
/*
 * Renames an element, indexes it, and changes the references to it. Time: linear in the references
 * to elements of its name.
 */
void doc_rename(struct document *doc, elem_id element, str_id name);

/*
 * complete.c: completes a tree that has all its elements: expands templates, mends file names,
 * qualifies and indexes names, copies inherited values. A tree that an edit has changed is
 * completed again.
 */
void doc_complete(struct document *doc, struct diag_list *diags);
/* inherited_values.c: copies what nodes inherit from others; the names are indexed */
void doc_inherit_values(struct document *doc, struct diag_list *diags);
/* True for a node that doc_inherit_values has not given the values yet. */
bool doc_inherits_values(const struct document *doc, elem_id element);

/* The number of elements of this layer, removed ones included. */
static inline uint32_t doc_num_elements(const struct document *doc)
{
    return doc->shared.elements + doc->num_added + doc->elements.len;
}
static inline bool doc_is_full(const struct document *doc)
{
    return doc->max_elements && doc_num_elements(doc) >= doc->max_elements;
}
/* The last change of an element by its index; NULL: it is as in `whole`. */
const struct doc_change *doc_find_change(const struct document *doc, uint32_t index);

/* The layer of an element. */
static inline const struct document *doc_layer(const struct document *doc, elem_id element)
{
    while (element < doc->first_element)
        doc = doc->base;
    assert(element - doc->first_element < doc_num_elements(doc));
    return doc;
}
static inline const struct element *doc_element(const struct document *doc, elem_id element)
{
    doc = doc_layer(doc, element);
    uint32_t index = element - doc->first_element;
    if (doc->origin) {
        const struct doc_change *change = doc_find_change(doc, index);
        return change ? &change->element : &doc->whole->elements.items[index];
    }
    return &doc->elements.items[index];
}
static inline const char *doc_name(const struct document *doc, elem_id element)
{
    return str_text(doc->strings, doc_element(doc, element)->name);
}
/* True for inputs and outputs, which can read others. */
static inline bool doc_is_port(const struct document *doc, elem_id element)
{
    uint16_t kind = doc_element(doc, element)->kind;
    return kind == KIND_INPUT || kind == KIND_OUTPUT;
}
/* The change of an element in an edit, made if there is none: then it is empty. */
struct doc_change *doc_add_change(struct document *doc, uint32_t index);
/* To be changed. */
struct doc_link *doc_own_link(struct document *doc, elem_id element);
/* Returns what only a tree in memory has; NULL: an image has none. */
const struct doc_link *doc_link(const struct document *doc, elem_id element);
/* The num_attrs attributes of the element. */
const struct attribute *doc_attrs(const struct document *doc, elem_id element);
/* NULL if absent. */
const struct attribute *doc_attr(const struct document *doc, elem_id element, str_id name);
/* 0 if absent or empty. */
str_id doc_attr_value(const struct document *doc, elem_id element, str_id name);
bool doc_attr_is_true(const struct document *doc, elem_id element, str_id name);
/*
 * Finds the value of an inherited attribute (colorspace, fileprefix, geomprefix): the value on the
 * closest element, from the element upwards, which doc_attr_owner returns (0: none has it). An
 * empty value counts.
 */
elem_id doc_attr_owner(const struct document *doc, elem_id element, str_id name);
str_id doc_inherited_attr(const struct document *doc, elem_id element, str_id name);

elem_id doc_child(const struct document *doc, elem_id parent, str_id name);
elem_id doc_child_of_kind(const struct document *doc, elem_id parent, enum element_kind kind,
                          str_id name);
/* A top-level element of a kind in this layer or the next one below that has it; 0: none. */
elem_id doc_top_level(const struct document *doc, enum element_kind kind, str_id name);

/*
 * Finds an element by path: "NG_marble1/out", "/NG_marble1/out"; 0: none. Searches this layer
 * first, then the layers below. The first name may omit the namespace of the root.
 */
elem_id doc_find(const struct document *doc, const char *path, size_t len);
/* Finds a path below an element of this layer; an empty path is the element. 0: none. */
elem_id doc_find_below(const struct document *doc, elem_id below, const char *path, size_t len);
void doc_path(const struct document *doc, elem_id element, char separator, struct text *out);

enum element_kind doc_kind_of(str_id category);

const char *doc_file_name(const struct document *doc, uint16_t file); /* NULL for 0 */
/* The place of the beginning of the start tag, with the category. */
struct diag_place doc_place(const struct document *doc, elem_id element);
/* The place of the element's name, or of the element if the text has no name for it. */
struct diag_place doc_name_place(const struct document *doc, elem_id element);
/* The place of an attribute's value, or of the element if the attribute is absent. */
struct diag_place doc_attr_place(const struct document *doc, elem_id element, str_id attr);
/* The place of an attribute's name. */
struct diag_place doc_attr_name_place(const struct document *doc, elem_id element, str_id attr);

/* aovoutput.c: makes nodes <aov> and <aovpass> of the <aovoutput> in nodegraphs. */
void doc_rewrite_aovs(struct document *doc);

/* template.c: expands the <template> elements of this layer in place (docs/library.md). */
void doc_expand_templates(struct document *doc, struct diag_list *diags);

/*
 * upgrade.c: upgrades a file from the version of `root`, its <materialx> (1.22 to 1.38), to 1.39,
 * with an `upgraded` note per change. The elements from `root` to before `end` are those of the
 * file; only they change.
 */
void doc_upgrade(struct document *doc, elem_id root, elem_id end, struct diag_list *diags);
/* Upgrades what an edit made, as the reader does for 1.39. */
void doc_upgrade_edit(struct document *doc, struct diag_list *diags);
/* True if doc_upgrade_edit may change the element. */
bool doc_needs_upgrade(const struct document *doc, elem_id element);
/* True for a text of a version 1.39, which the reader does not upgrade. */
bool doc_is_current_version(const char *text);

/*
 * namespace.c: renames top-level elements with a `namespace` to "ns:name", and the references to
 * them from inside the namespace ("MaterialX Namespaces"). Afterwards every reference equals the
 * name of its target.
 */
void doc_qualify_names(struct document *doc, struct diag_list *diags);

/*
 * paths.c: replaces the backslashes of file names by '/', with a warning for each name: the names
 * are those of this layer.
 */
void doc_fix_paths(struct document *doc, struct diag_list *diags);
/* Corrects the paths of one element. */
void doc_fix_paths_of(struct document *doc, elem_id element, struct diag_list *diags);
/* Corrects one name; `where` is its place. */
str_id doc_fix_path(struct strpool *strings, str_id path, struct diag_place where,
                    struct diag_list *diags);

/* validate_geometry.c: the names of geometry in an attribute, each with the geomprefix in front. */
const char *doc_prefixed_geometry(const struct document *doc, elem_id element, str_id attr,
                                  struct arena *arena);
/* True if the attribute holds names of geometry, which a geomprefix begins. */
bool doc_is_geometry(const struct document *doc, elem_id element, str_id attr);

/*
 * edit.c: edits of a complete document. The numbers of elements stay.
 */

/*
 * The document that an edit of `from` shares: `from`, or one of its origins, so that few changes
 * are copied and few origins lie above each other.
 */
const struct document *doc_to_share(const struct document *from);
/*
 * Makes a document like `from` that shares the items of `origin`, which is doc_to_share(from). Its
 * strings are above those of the origin. Time and memory: linear in the changes of `from` and of
 * the origins between them.
 */
void doc_begin_edit(struct document *doc, struct arena *arena, struct strpool *strings,
                    const struct document *from, const struct document *origin);
/* How many items a document has beside those of its `whole`. */
uint64_t doc_num_changes(const struct document *doc);
/* Takes all elements out of the origins. The strings become those of the whole layer. */
void doc_leave_origin(struct document *doc);
/* True if an element of the origin has other siblings or children at most. */
bool doc_is_same(const struct document *doc, const struct doc_change *change);
/* True if an element of the origin has another name or parent, so that paths below it change. */
bool doc_is_renamed(const struct document *doc, const struct doc_change *change);
/* A comment by its index plus 1. */
const struct doc_comment *doc_comment_at(const struct document *doc, uint32_t comment);
/*
 * Appends a copy of an element of any document, with all below it and their comments; `name` 0
 * keeps the name. The copies have no line. 0: the document is full (doc_is_full).
 */
elem_id doc_copy_element(struct document *doc, elem_id parent, const struct document *from,
                         elem_id element, str_id name);
/* True for the root and for elements of this layer that are below it. */
bool doc_has_element(const struct document *doc, elem_id element);
/* True if an element can have this name ("MaterialX Names": letters, digits, '_', namespaces). */
bool doc_is_name(const char *text);
/* Keeps the paths of elements without a line, for doc_place. Call it when the tree is complete. */
void doc_keep_paths(struct document *doc);

/*
 * way.c: the `fileprefix` by which an element with the name of a file leads to this file from the
 * folder of the file `from`; NULL: that which it has, or the way is unknown.
 */
const char *doc_prefix_from(const struct document *doc, elem_id element, const char *from,
                            struct arena *arena);

/*
 * write_document.c: writes the tree as MaterialX XML: an element per line, two spaces per level,
 * the name first, then the attributes in their order, with the comments and single blank lines of
 * the file. Reading the text gives an equal tree, but for the way to files that an include names.
 */
void doc_write(const struct document *doc, elem_id root, struct text *out);

/* Tells whether to write a child of the root; may write lines before it. */
struct doc_choice {
    void *user_data;
    bool (*take)(void *user_data, elem_id child, struct text *out);
};

/* Writes `root` with those of its children that the choice takes; NULL: all. */
void doc_write_part(const struct document *doc, elem_id root, const struct doc_choice *choice,
                    struct text *out);

/*
 * cycle.c: reports a cycle; may change `links`. Each node reads the next one through `port`, the
 * last one the first.
 */
struct doc_cycle_link {
    elem_id node, port; /* the port has the connection; it may belong to a nodegraph between them */
};
void doc_report_cycle(const struct document *doc, struct doc_cycle_link *links, uint32_t n,
                      struct diag_list *diags);

/* validate_elements.c: checks that need no library: names, attributes, value syntax, structure. */
void doc_validate(const struct document *doc, struct diag_list *diags);
/*
 * The part of doc_validate for the children of one element: their places, their required
 * attributes, and repeated connections.
 */
void doc_check_children(const struct document *doc, elem_id parent, struct diag_list *diags);

/*
 * True for an element of an earlier version that the version of the document does not have, such as
 * the <material> of 1.37.
 */
bool doc_is_outdated(const struct document *doc, elem_id element);
void doc_report_outdated(const struct document *doc, elem_id element, struct diag_list *diags);

/*
 * value.c: reports excess numbers in a value, and text behind a number; `suggestion` is the end of
 * the first message.
 */
void doc_report_loose(const struct document *doc, elem_id element, doc_type type,
                      const char *suggestion, struct diag_list *diags);
/* Reports an attribute whose value has not the type of attributes.def, such as visible="maybe". */
void doc_check_attribute(const struct document *doc, elem_id element, str_id name,
                         struct diag_list *diags);
/* Reports a text that is no value of the type. */
void doc_report_value(doc_type type, const char *type_name, const char *text,
                      struct diag_place place, struct diag_list *diags);
/* Reports the first number in a value that a float cannot hold; the value is infinite. */
void doc_report_infinite(const char *text, struct diag_place place, struct diag_list *diags);
/* Reports the type of an element if it is unknown or missing. */
void doc_report_type(const struct document *doc, elem_id element, struct diag_list *diags);

#endif
