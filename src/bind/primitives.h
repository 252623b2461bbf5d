// SPDX-License-Identifier: Apache-2.0
/*
 * The primitives of a scene: a tree of paths. Groups are primitives, too.
 */
#ifndef MXG_BIND_PRIMITIVES_H
#define MXG_BIND_PRIMITIVES_H

#include "base/table.h"
#include "bind/name.h"
#include "diag/diag.h"
#include "usda/usda.h"

typedef uint32_t prim_id; /* 0: the root "/", which is no primitive of its own */

struct scene_prim {
    const char *name;
    uint32_t name_len;
    prim_id parent, first_child, last_child, next; /* 0: none */
    uint32_t depth;                                /* 0 of the root */
};
enum { SCENE_MAX_DEPTH = 1000 };
enum prim_kind { PRIM_DRAWN, PRIM_GROUP, PRIM_GONE };
#define PRIM_REMOVED UINT32_MAX /* as a parent: the primitive is gone; its number stays unused */

/* A type that a host gives to primitives. */
struct host_type {
    struct text_word name;
    bool is_group;
};

/* A binding that the scene brings itself; it is weaker than those of a look at the same path. */
struct scene_binding {
    prim_id prim;
    const char *name;     /* of the slot */
    const char *material; /* "": a removal */
    const char *leaf;     /* the name of the material's prim, which a document may have; or NULL */
    const char *property; /* of the primitive: "material:binding" */
    struct diag_place place;
    bool is_strong;     /* it beats the bindings of the scene below it */
    bool is_purpose;    /* it is for the asked purpose, and beats those for all purposes */
    bool is_collection; /* it is for the members of a collection */
    bool is_removed;    /* scene_bind uses the place again */
    uint32_t first_member, num_members;
    uint32_t next; /* of the primitive, or of those that are removed: 1 + index; 0: none */
};

/* A path that a collection of USD names. */
struct scene_member {
    prim_id prim;
    bool is_excluded;
};

/*
 * A prim of the USD layer whose properties a primitive has; the strongest comes first. Paths at or
 * below `from` lead to primitives at or below `to`: an instance of an internal reference.
 */
struct scene_source {
    usda_prim_id prim, from;
    prim_id to;
    uint32_t next; /* 1 + index; 0: none */
};

/* A Material or NodeGraph of the layer. */
struct scene_material {
    usda_prim_id prim;
    bool is_graph;
    const char *name;               /* of the prim; "assetA_mtl_paint" where others have the same */
    uint32_t next;                  /* with the same name of the prim: 1 + index; 0: none */
    uint32_t last, num, num_graphs; /* of the first one: the last, and how many there are */
};

/* The arrays of a PointInstancer. */
struct scene_instancer {
    prim_id prim;
    uint32_t num, num_ids;
    int64_t *prototypes, *ids; /* without ids, the number of an instance is its id */
    struct table by_id;        /* id → 1 + number of the instance */
};

/* The primitives of a prototype that are drawn, which each of its instances has: found once. */
struct scene_prototype {
    prim_id root;
    VEC(prim_id) drawn;
};

/* A primitive that stands for a primitive of one instance; it is the child of that one. */
struct scene_instance {
    prim_id node, instancer;
    int64_t id;
};

struct scene {
    struct arena *arena;          /* owns everything */
    uint32_t max_prims;           /* a limit of the context; readers report more */
    VEC(struct scene_prim) prims; /* a parent stands before its children */
    VEC(uint8_t) kinds;           /* enum prim_kind, by primitive: few bytes for loops over all */
    struct table table;           /* (parent, name) → primitive */
    VEC(prim_id) last; /* the levels of the path that was added last; the next often shares some */
    VEC(struct scene_binding) bindings;
    VEC(uint32_t) first_binding; /* by primitive, like first_source */
    VEC(uint32_t) last_binding;  /* as long as first_binding */
    uint32_t removed_binding;    /* the first one; 1 + index; 0: none */
    uint32_t num_bindings;       /* without those that are removed */
    VEC(prim_id) emptied;        /* whose last child was removed, in this order */
    VEC(struct scene_member) members;
    struct usda_layer layer; /* of a stage of USD; otherwise without prims */
    VEC(struct scene_material) materials;
    struct table namesakes;      /* name of the prim → 1 + index of the first material */
    struct table material_names; /* name → 1 + index */
    struct table material_prims; /* prim → 1 + index of its material */
    VEC(struct scene_source) sources;
    VEC(uint32_t) first_source; /* by primitive: 1 + index; shorter than prims: 0 */
    const char *purpose;        /* whose bindings it has: "full", "preview"; "": of all purposes */
    const char *slot_order;     /* with commas; NULL: the scene has none */
    struct diag_place slot_order_place;
    VEC(struct scene_instancer) instancers;
    VEC(struct scene_prototype) prototypes;
    struct table prototype_table;         /* root → 1 + index */
    VEC(struct scene_instance) instances; /* by primitive; those of one instance in a row */
    struct table instance_table;          /* (instancer, id) → 1 + index of the first */
    VEC(const char *) words;              /* those that a host gives again and again */
    struct table words_table;
    struct text written; /* a name at hand */
    VEC(struct host_type) host_types;
    struct table host_types_table;
    VEC(uint32_t) types; /* that a host gives, by primitive, like first_source */
    char *names;         /* free part of the block of names */
    size_t names_left;
};

void scene_init(struct scene *scene, uint32_t max_prims, struct arena *arena);

/* The child of this name; adds it if there is none. Keeps `name`, which lives as long as the scene.
 */
prim_id scene_child(struct scene *scene, prim_id parent, const char *name, size_t len);
/* Adds a path below a primitive, "b/c"; an empty path is the primitive. Copies it. */
prim_id scene_add_below(struct scene *scene, prim_id prim, const char *path, size_t len);
/*
 * Reports a path below a primitive that is none, "/b" or "b//c", or for which the scene has no
 * room; false then.
 */
bool scene_check_name(const struct scene *scene, prim_id prim, struct text_word name,
                      struct diag_list *diags);
/* Keeps a text with a NUL, once for all equal ones. */
const char *scene_keep_word(struct scene *scene, struct text_word word);
/* True if a number is that of a primitive, or of the root. */
static inline bool scene_has(const struct scene *scene, prim_id prim)
{
    return prim < scene->kinds.len && scene->kinds.items[prim] != PRIM_GONE;
}
/*
 * Removes primitives of the scene, with all below them and their bindings. A number may come twice,
 * and one below another. All stay if memory runs out.
 */
void scene_remove(struct scene *scene, const prim_id *prims, size_t num);
/* Sets the type that a host gives a primitive. Copies it. */
void scene_set_type(struct scene *scene, prim_id prim, struct text_word type);
prim_id scene_find_child(const struct scene *scene, prim_id parent, const char *name, size_t len);

/* The primitive at a path, "/a/b"; 0: none. */
prim_id scene_find(const struct scene *scene, const char *path, size_t len);

/* Finds the rest of a path below a primitive, "/b". */
prim_id scene_find_below(const struct scene *scene, prim_id prim, const char *path, size_t len);

/* Writes the path of a primitive: "/a/b"; "/" for 0. */
void scene_path(const struct scene *scene, prim_id prim, struct text *out);
/* The number of levels below the root: 0 for 0. */
static inline uint32_t scene_depth(const struct scene *scene, prim_id prim)
{
    return scene->prims.items[prim].depth;
}
/* The next primitive in the order of the tree; 0 after the last. Begins with 0. */
prim_id scene_next(const struct scene *scene, prim_id prim);

/*
 * Adds the primitive at a path, "/a/b", and those above it. Keeps `path`, which lives as long as
 * the scene. A fault is reported at the place.
 */
void scene_add_path(struct scene *scene, const char *path, size_t len, struct diag_place place,
                    struct diag_list *diags);

/*
 * Adds the primitives of a list: one path in each line, blanks around it and empty lines say
 * nothing, '#' begins a comment line. Adds the paths above each one, too. `file` is the name of the
 * list for messages.
 */
void scene_read_list(struct scene *scene, const char *file, const char *text, size_t len,
                     struct diag_list *diags);

/* ---- instances.c: instances of a PointInstancer ---- */

bool scene_has_instancers(const struct scene *scene);
/* Reads "/set/forest[12]"; false: it does not name an instancer and a number. */
bool scene_parse_instance(const struct scene *scene, struct text_word name, prim_id *out_instancer,
                          int64_t *out_id);
/* True for a primitive of an instance. */
bool scene_is_instance(const struct scene *scene, prim_id prim);
/* True if no primitive stands below, other than of instances. */
bool scene_is_leaf(const struct scene *scene, prim_id prim);

/* ---- Bindings ---- */

/* Adds a binding behind the others of its primitive: its index. */
uint32_t scene_add_binding(struct scene *scene, struct scene_binding binding);
/* "/set/table.material:binding" */
void scene_write_binding(const struct scene *scene, const struct scene_binding *binding,
                         struct text *out);
/*
 * Removes the direct bindings of a slot from a primitive, and adds one of this material ("" removes
 * the slot there). Copies the material.
 */
void scene_bind(struct scene *scene, prim_id prim, const struct slot_name *slot,
                const char *material);
/* Removes all bindings of a primitive. */
void scene_unbind_all(struct scene *scene, prim_id prim);
/* Removes the direct bindings of a slot from a primitive. */
void scene_unbind(struct scene *scene, prim_id prim, const struct slot_name *slot);
/* The first binding of a primitive, 1 + index; 0: none. */
static inline uint32_t scene_first_binding(const struct scene *scene, prim_id prim)
{
    return prim < scene->first_binding.len ? scene->first_binding.items[prim] : 0;
}

/*
 * scene_usda.c: adds the primitives of a USD text layer, with their bindings. Instances of an
 * internal reference are primitives of their own. purpose: "full", "preview", or "" for all
 * purposes. Keeps `text`, which ends with a NUL and lives as long as the scene.
 */
void scene_read_usda(struct scene *scene, const char *file, const char *text, size_t len,
                     const char *purpose, struct arena *scratch, struct diag_list *diags);

/* scene_materials.c: finds the materials of the layer, and names them. */
void scene_name_materials(struct scene *scene);
/* The material at a path of the layer, also below an instance; NULL: none. */
const struct scene_material *scene_material_at(const struct scene *scene, struct text_word path);
/* The material of the layer that has this name in documents; NULL: none. */
const struct scene_material *scene_material_named(const struct scene *scene, const char *name);
/* The first material whose prim has this name, and the one after it; NULL: none. */
const struct scene_material *scene_namesakes(const struct scene *scene, struct text_word name);
const struct scene_material *scene_next_namesake(const struct scene *scene,
                                                 const struct scene_material *material);

/* The strongest prim of the layer that a primitive comes from: 1 + index in `sources`; 0: none. */
static inline uint32_t scene_source(const struct scene *scene, prim_id prim)
{
    return prim < scene->first_source.len ? scene->first_source.items[prim] : 0;
}
/* Its type, "Mesh"; empty: unknown, or none. */
struct text_word scene_type(const struct scene *scene, prim_id prim);
/* True for what is never drawn itself: a group, a camera, a light. Its layers are for others. */
static inline bool scene_is_group(const struct scene *scene, prim_id prim)
{
    return scene->kinds.items[prim] == PRIM_GROUP;
}
/* After a change of what the type of a primitive follows from. */
void scene_find_kind(struct scene *scene, prim_id prim);
/*
 * The strongest property of a name (usda_find_attribute), and its source in *out_source, which may
 * be NULL; NULL: none.
 */
const struct usda_property *scene_property(const struct scene *scene, prim_id prim,
                                           const char *name, uint32_t *out_source);
/* The primitive that a path in a property of a source names; 0: none. */
prim_id scene_target(const struct scene *scene, uint32_t source, struct text_word path);

#endif
