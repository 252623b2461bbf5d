// SPDX-License-Identifier: Apache-2.0
/*
 * The element tree of a MaterialX document: flat arrays addressed by 32-bit index, strings
 * interned, no pointers inside.
 *
 * Documents form layers like string pools: a document stands on its library, whose elements it sees
 * and never changes. Element and attribute indices count through the layers. The tree is what the
 * file says after XInclude, templates and upgrade; looking things up by meaning is the library
 * room's work.
 */
#ifndef MXG_DOCUMENT_DOCUMENT_H
#define MXG_DOCUMENT_DOCUMENT_H

#include "base/strpool.h"
#include "diag/diag.h"
#include "ir/ir.h"

/* types.c, value.c */

/* 0 = none; standard types; types of typedef elements from DOC_TYPE_FIRST_USER */
typedef uint16_t doc_type;
enum {
    DOC_TYPE_NONE,
#define DOC_TYPE(ID, ir, components) DOC_TYPE_##ID,
#include "document/types.def"
#undef DOC_TYPE
    DOC_TYPE_material,
    DOC_TYPE_multioutput,
    DOC_NUM_TYPES,
    DOC_TYPE_FIRST_USER = 64
};

/* The standard type of a type name, 0 for others (user types are the library's business). */
doc_type doc_type_of(str_id name);
str_id doc_type_name(doc_type type); /* of a standard type */
/* of a standard type; IR_TYPE_VOID for arrays and multioutput */
ir_type_id doc_type_ir(doc_type type);
unsigned doc_type_components(doc_type type); /* numbers in a value: 3 for color3; 0: not a number */

/*
 * Parses a value as MaterialX writes it ("0.5", "1, 0, 0", "true") of a type with an ir type that
 * holds components. Strings give their str_id, interned in `strings` when that is not NULL.
 * Surrounding spaces are allowed, trailing text is not. false: not a value of the type.
 */
bool doc_parse_value(doc_type type, const char *text, size_t len, struct strpool *strings,
                     struct ir_value *out);

/*
 * Whether a text is a value of the type; arrays too. Types without a form of their own (strings,
 * file names, shaders): always.
 */
bool doc_value_is_valid(doc_type type, const char *text, size_t len);
/* What is wrong with a value that is not valid, to be said behind it. */
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
    uint32_t line;   /* of the start tag, from 1 */
    uint16_t column; /* in code points, from 1; saturates */
    uint16_t file;   /* number of its file (through the layers); 0 = none */
    uint16_t num_attrs;
    uint16_t kind; /* enum element_kind */
};

struct attribute {
    str_id name, value;
    uint16_t line_delta; /* from the element's line; saturates */
    uint16_t column;     /* of the value's first character */
};

/* What building needs beside the tree: appending and removing in constant time. */
struct doc_link {
    elem_id last_child, previous;
};

struct document {
    const struct document *base;                    /* the layer below or NULL */
    struct strpool *strings;                        /* this layer's pool */
    struct arena *arena;                            /* NULL in an image layer */
    uint32_t first_element, first_attr, first_file; /* first own index of each */
    elem_id root;
    uint32_t max_elements;  /* own ones, for what multiplies input (doc_is_full); 0 = no limit */
    bool has_templates;     /* a <template> was added since the last expansion */
    bool has_attributedefs; /* an <attributedef> was added, wherever it is now */
    bool is_global;         /* no namespace is in it, as doc_qualify_names found */
    VEC(struct element) elements; /* own ones */
    VEC(struct attribute) attrs;
    VEC(str_id) files;            /* names as the user gave them or as included */
    VEC(struct doc_link) links;   /* beside `elements`; empty in an image layer */
    uint32_t *name_table;         /* (parent, name) → element: open addressing; doc_index_names */
    const uint16_t *narrow_names; /* in place of that, of an image whose elements' ids fit */
    uint32_t name_mask;
    uint32_t num_names; /* slots taken */
};

/* An empty document with its root element <materialx>. */
void doc_init(struct document *doc, struct arena *arena, struct strpool *strings,
              const struct document *base);

/*
 * Building: children are appended in order; parent 0 gives an element outside of the tree. `name`
 * is kept apart from the attributes. Every function takes elements of this layer only and costs
 * constant time, beside the element's own attributes.
 */
elem_id doc_add_element(struct document *doc, elem_id parent, str_id category, str_id name,
                        uint16_t file, uint32_t line, uint16_t column);
void doc_add_attr(struct document *doc, elem_id element, struct attribute attr);
/* A new element at the place (file, line, column) of another: what upgrade and templates make. */
elem_id doc_add_like(struct document *doc, elem_id parent, str_id category, str_id name,
                     elem_id origin);
/* Replaces or adds an attribute. */
void doc_set_attr(struct document *doc, elem_id element, str_id name, str_id value);
void doc_remove_attr(struct document *doc, elem_id element, str_id name);
void doc_set_category(struct document *doc, elem_id element, str_id category); /* kind follows */
void doc_set_name(struct document *doc, elem_id element, str_id name);
void doc_set_place(struct document *doc, elem_id element, uint16_t file, uint32_t line,
                   uint16_t column);
/* unlinks it from its parent, which becomes 0 */
void doc_remove_element(struct document *doc, elem_id element);
/* to the end of its children */
void doc_move_element(struct document *doc, elem_id element, elem_id new_parent);
void doc_move_before(struct document *doc, elem_id element, elem_id sibling);
static inline bool doc_is_full(const struct document *doc)
{
    return doc->max_elements && doc->elements.len >= doc->max_elements;
}
/*
 * The number of a file name, which is added where this layer does not have it. 0: more than 65,535
 * files.
 */
uint16_t doc_add_file(struct document *doc, str_id name);

/*
 * A point to go back to: what was added after the mark goes, and `root`, which must be childless
 * then, is as it was.
 */
struct doc_mark {
    uint32_t num_elements, num_attrs;
    struct element root;
    bool has_templates;
};
struct doc_mark doc_mark(const struct document *doc, elem_id root);
void doc_rollback(struct document *doc, elem_id root, const struct doc_mark *mark);

/*
 * The element behind `element` in document order inside the subtree of `root`; 0: that was the
 * last. Starts with root itself.
 */
elem_id doc_next_in_tree(const struct document *doc, elem_id root, elem_id element);

/*
 * Called once the tree stands, and again after additions: what doc_child and doc_find look into.
 * Reports duplicate names, and removes elements that repeat an equal one, where `diags` is given.
 */
void doc_index_names(struct document *doc, struct diag_list *diags);
/* The same for one element that was added, renamed or moved since. */
void doc_index_element(struct document *doc, elem_id element);

/* The layer that an element is of. */
static inline const struct document *doc_layer(const struct document *doc, elem_id element)
{
    while (element < doc->first_element)
        doc = doc->base;
    assert(element - doc->first_element < doc->elements.len);
    return doc;
}
static inline const struct element *doc_element(const struct document *doc, elem_id element)
{
    doc = doc_layer(doc, element);
    return &doc->elements.items[element - doc->first_element];
}
/* Pointer to the element's num_attrs attributes. */
const struct attribute *doc_attrs(const struct document *doc, elem_id element);
/* NULL: absent */
const struct attribute *doc_attr(const struct document *doc, elem_id element, str_id name);
/* 0: absent or empty */
str_id doc_attr_value(const struct document *doc, elem_id element, str_id name);
bool doc_attr_is_true(const struct document *doc, elem_id element, str_id name);
/*
 * The same, looked for in the element and then in its ancestors (colorspace, fileprefix,
 * geomprefix). The nearest one counts, an empty one too.
 */
str_id doc_inherited_attr(const struct document *doc, elem_id element, str_id name);

elem_id doc_child(const struct document *doc, elem_id parent, str_id name);
elem_id doc_child_of_kind(const struct document *doc, elem_id parent, enum element_kind kind,
                          str_id name);

/*
 * An element by path: "NG_marble1/out", "/NG_marble1/out"; 0: none. Looked for in this layer, then
 * in those below. Where the root has a namespace, the first name may leave it out.
 */
elem_id doc_find(const struct document *doc, const char *path, size_t len);
void doc_path(const struct document *doc, elem_id element, char separator, struct text *out);

enum element_kind doc_kind_of(str_id category);

const char *doc_file_name(const struct document *doc, uint16_t file); /* NULL for 0 */
struct diag_place doc_place(const struct document *doc, elem_id element);
/* The place of an attribute's value; of the element where it is absent. */
struct diag_place doc_attr_place(const struct document *doc, elem_id element, str_id attr);

/* template.c: expands the <template> elements of this layer's tree in place (docs/library.md). */
void doc_expand_templates(struct document *doc, struct diag_list *diags);

/*
 * upgrade.c: from the version that `root`, a file's <materialx>, says (1.22 to 1.38) to 1.39, with
 * an `upgraded` note for each change. Elements from `root` to before `end` are the file's own and
 * are upgraded; all others may be referred to.
 */
void doc_upgrade(struct document *doc, elem_id root, elem_id end, struct diag_list *diags);

/*
 * namespace.c: qualifies the names of top-level elements that have a `namespace` as "ns:name" and
 * the references to them from inside the namespace ("MaterialX Namespaces"): afterwards every
 * reference is the name of what it refers to.
 */
void doc_qualify_names(struct document *doc);

/*
 * write.c: the tree as MaterialX XML, two spaces per level: `mxgen library expand`, later `format`.
 */
void doc_write(const struct document *doc, elem_id root, struct text *out);

/* validate.c: checks that need no library: names, attributes, values that parse, structure. */
void doc_validate(const struct document *doc, struct diag_list *diags);
/*
 * What of it concerns how the children of an element stand: their place, their required attributes,
 * and that none is connected twice.
 */
void doc_check_children(const struct document *doc, elem_id parent, struct diag_list *diags);

/* Tells that the type which an element says is none, or that it says none. */
void doc_report_type(const struct document *doc, elem_id element, struct diag_list *diags);

#endif
