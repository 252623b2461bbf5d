// SPDX-License-Identifier: Apache-2.0
/*
 * A look for binding: its assignments with those of its parents, their names in the order of the
 * layers, and everything that says where they stand.
 */
#ifndef MXG_BIND_LOOK_H
#define MXG_BIND_LOOK_H

#include "bind/name.h"
#include "bind/pattern.h"
#include "bind/primitives.h"
#include "library/library.h"

/* The products of a material that `exclusive` takes from a weaker assignment. */
enum bind_product {
#define PRODUCT(id, word) PRODUCT_##id,
#include "bind/products.def"
#undef PRODUCT
    NUM_PRODUCTS
};
extern const char *const bind_product_names[NUM_PRODUCTS];

enum assign_kind {
    ASSIGN_REMOVAL,
    ASSIGN_LAYER,  /* a material that makes a layer; of an override, the material */
    ASSIGN_GRAPH,  /* a nodegraph, of an override */
    ASSIGN_VOLUME, /* a material that binds beside the stack */
    ASSIGN_LIGHT,
};

/* A name that the assignments of a look have. */
struct look_name {
    struct slot_name name;
    const char *text;               /* "050::010" */
    uint32_t ranks[NUM_SLOT_PARTS]; /* by the slotorder; UINT32_MAX: not in it */
    uint32_t number;                /* as it was met */
    uint32_t slot, layer;           /* numbers, equal for names of one slot, of one layer */
    bool is_muted;
};

struct look_variant {
    elem_id set, variant;
};
struct variant_list {
    struct look_variant *items;
    uint32_t len, cap;
};

struct look_assign {
    elem_id element, look;
    uint32_t ordinal;    /* in its look, from 1 */
    uint32_t binding;    /* 1 + a binding of the scene, which has no element; 0: none */
    uint32_t name;       /* index in `names` */
    elem_id target;      /* the material or nodegraph; 0: a removal */
    uint32_t collection; /* 1 + index; 0: it has a geom, or stands nowhere */
    uint32_t members;    /* 1 + index in `members`: it is for a collection of USD; 0: it is not */
    uint32_t first_variant, num_variants; /* inside of it */
    struct variant_list variants;         /* all that apply, in order; a later one wins */
    /* of a fact: its value where that is not as in the document; the renderer or the viewers */
    const char *value, *fact_target;
    uint8_t kind;     /* enum assign_kind */
    uint8_t products; /* bits of enum bind_product: the inputs that the material has */
    bool is_shared;   /* exclusive="false" */
};

/* A primitive of an instance that a matcher names. */
struct look_instance {
    prim_id prim;
    uint32_t matcher;
};

struct look_collection {
    elem_id element;
    uint32_t first_nested, num_nested; /* in `nested` */
    uint32_t include, exclude;         /* 1 + matcher; 0: none */
};

/* The members of a collection of USD, which many bindings may share. */
struct look_members {
    uint32_t first_member, num_members; /* in the scene */
    uint32_t include, exclude;          /* matchers */
};

/* Lists of numbers, one for each of some other numbers: `first` has one more than there are. */
struct look_lists {
    uint32_t *first, *items;
};

/*
 * The kinds of statements that a matcher makes about a path. It matches a list of geometry, or
 * primitives of the scene.
 */
enum matcher_kind {
    MATCHER_ASSIGN,
    MATCHER_INCLUDE,
    MATCHER_EXCLUDE, /* its first match on a path counts, of others the deepest */
    MATCHER_BOUND,   /* a primitive whose binding is for a collection of USD */
    MATCHER_MEMBER,  /* of such a collection */
};
struct look_matcher {
    uint32_t owner;                 /* the assignment or the collection; of members none */
    uint8_t kind;                   /* enum matcher_kind */
    bool has_fault;                 /* a name was reported */
    const char *prefix, *list;      /* the names and the geomprefix in front; NULL: primitives */
    uint32_t first_prim, num_prims; /* in `matched` */
};

struct bind_look {
    const struct library *lib;
    const struct document *doc; /* that of `lib` */
    struct arena *arena;
    struct diag_list *diags;
    elem_id element; /* the look; 0: only the bindings of the scene */
    const struct scene *scene;
    struct pattern_set patterns;
    VEC(struct look_matcher) matchers;
    VEC(prim_id) matched; /* primitives that matchers name one by one */
    VEC(struct look_instance) instances;
    VEC(struct look_assign) assigns; /* a stronger one stands behind a weaker one */
    VEC(struct look_name) names;     /* sorted: base first; a slot, its overrides, its verticals */
    struct table name_table;
    VEC(struct look_collection) collections; /* a nested one stands before its users */
    VEC(uint32_t) nested;
    struct table collection_table;
    VEC(struct look_members) members;
    struct table member_table;
    struct look_lists users;    /* by collection: those that include it */
    struct look_lists assigned; /* by collection: its assignments */
    VEC(uint64_t) contains;     /* bit sets: the collections in a collection, at any depth */
    uint32_t *rows;             /* by collection: 1 + its row in `contains`; 0: it contains none */
    VEC(struct look_variant) variants; /* those of the looks, then those of the assignments */
    uint32_t num_look_variants;
    elem_id order; /* the look whose slotorder counts; 0: none */
    VEC(struct text_word) order_parts;
    struct table order_table; /* part → 1 + its rank in order_parts */
    struct text written;      /* a path at hand */
};

/*
 * The look of a name, or the only look of the document for NULL; the default look of a group. 0
 * after a diagnostic.
 */
elem_id look_choose(const struct document *doc, const char *name, struct diag_list *diags);

/* Reports that the default of a <lookgroup>, if it has one, is none of its looks. */
void look_check_group(const struct document *doc, elem_id group, struct diag_list *diags);

/* The number of looks of a document. */
uint32_t look_count(const struct document *doc);

/*
 * Reads the bindings of a scene, and a look with its parents. Errors leave an assignment out. The
 * arena keeps everything. Call look_finish in the end.
 */
void look_read(struct bind_look *look, const struct library *lib, elem_id element,
               const struct scene *scene, struct arena *arena, struct diag_list *diags);
void look_finish(struct bind_look *look);

/* facts.c: reports the faults of what a look says beside materials; for 0, of what no look says. */
void look_check_facts(const struct library *lib, elem_id element, const struct scene *scene,
                      struct arena *arena, struct diag_list *diags);

/*
 * Builds a look in parts, for what stands at paths beside materials: begins with an empty look;
 * visits it and its parents, the parents first.
 */
void look_begin(struct bind_look *look, const struct library *lib, elem_id element,
                const struct scene *scene, struct arena *arena, struct diag_list *diags);
void look_each_ancestor(struct bind_look *look,
                        void (*visit)(struct bind_look *look, elem_id element));

/* ---- message_words.c ---- */

/* "day/dust", "day/#3" if it has no name; "/set.material:binding" of a scene. */
void look_assign_name(const struct bind_look *look, uint32_t assign, struct text *out);

/* The place of an assignment, and of its slot. */
struct diag_place look_assign_place(const struct bind_look *look, const struct look_assign *assign);
struct diag_place look_slot_place(const struct bind_look *look, const struct look_assign *assign);

/* Reports that the top-level element that an attribute names does not exist. */
void look_report_unknown(struct bind_look *look, elem_id element, str_id attr, const char *what,
                         enum element_kind kind);
/* Adds the names of a kind of elements to a guess; of nodes those of materials. */
void look_guess(const struct bind_look *look, struct diag_guess *guess, enum element_kind kind);

/* True if collection `outer` includes collection `inner`, at any depth. Numbers from 1. */
static inline bool look_contains(const struct bind_look *look, uint32_t outer, uint32_t inner)
{
    uint32_t words = (look->collections.len + 63) / 64, row = look->rows[outer - 1];
    return row
           && look->contains.items[(size_t)(row - 1) * words + (inner - 1) / 64] >> (inner - 1) % 64
                  & 1;
}

/* ---- Shared by the files of the room that read a look ---- */

/* assignments.c: the number of a name; adds it. Keeps `text`. */
uint32_t look_intern_name(struct bind_look *look, const struct slot_name *name, const char *text,
                          size_t len);
/* Reports an element that has both of two attributes. */
bool look_has_both(struct bind_look *look, elem_id element, str_id one, str_id other);
/*
 * Reports an element that stands nowhere, or at a list of geometry and at a collection: then false.
 */
bool look_check_place(struct bind_look *look, elem_id element);
/* Where the next assignment stands: a list of geometry, or a collection; false after an error. */
bool look_read_place(struct bind_look *look, struct look_assign *assign);
/* Reads one <materialassign>, and one <variantassign>. */
void look_read_assign(struct bind_look *look, elem_id element, uint32_t ordinal);
void look_read_variant(struct bind_look *look, elem_id element);
void look_read_binding(struct bind_look *look, uint32_t binding);
/* A new matcher at a primitive, 0 for "/", of the assignment that comes next. */
void look_match_prim(struct bind_look *look, enum matcher_kind kind, prim_id prim);

/* worn_variants.c: fills the lists of all assignments. */
void look_apply_variants(struct bind_look *look);

/* collection.c: the number of a collection, from 1; 0 after a diagnostic at the element's
 * attribute. */
uint32_t look_read_collection(struct bind_look *look, str_id name, elem_id user, str_id attr);
/* Fills `contains` and `rows`, after all collections are read. */
void look_close_collections(struct bind_look *look);
/*
 * Adds the names of a list of geometry to the patterns, as a new matcher; gives 1 + its number, 0
 * for an empty list. Reports faults at the attribute.
 */
uint32_t look_read_geometry(struct bind_look *look, elem_id element, str_id attr,
                            struct look_matcher matcher);

/* The next name of a list of geometry, without blanks; empty at its end. Moves the list on. */
struct text_word look_next_name(const char **list);

/* ---- instances.c ---- */

/* Adds the primitives of the instances that a document names. */
void scene_add_instances(struct scene *scene, const struct document *doc);
/* Adds the primitives of the instance that a name is to a matcher; false: it is no instance. */
bool look_match_instance(struct bind_look *look, struct text_word name, uint32_t matcher);
/* Sorts them by primitive, for look_instances_of. */
void look_sort_instances(struct bind_look *look);
/* The matchers that name an instance's primitive, ascending. */
const struct look_instance *look_instances_of(const struct bind_look *look, prim_id prim,
                                              uint32_t *out_num);

/* order.c: reads the slotorder of look->order into `order_parts`, and reports its faults. */
void look_read_order(struct bind_look *look);
/* Reads it, too, and sorts the names, with warnings about their order. */
void look_sort_names(struct bind_look *look);

#endif
