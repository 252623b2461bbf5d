// SPDX-License-Identifier: Apache-2.0
/*
 * Binding: the layers of each primitive of a scene under a look (docs/slots.md).
 *
 * A walk down the scene keeps, for each matcher of the look, the deepest level where it matched:
 * a *state*. Primitives with equal states share one, so a scene of many primitives has few. The
 * layers follow from the state alone. States with equal layers have the same *stack*.
 *
 * A *level* counts from the root: 1 is "/", 2 is "/a"; 0 is none. It stands for the path above a
 * primitive that has so many names.
 */
#ifndef MXG_BIND_BIND_H
#define MXG_BIND_BIND_H

#include "bind/look.h"
#include "bind/primitives.h"

enum item_kind {
    ITEM_LAYER,
    ITEM_PRODUCT,  /* a product that the layer before takes from a weaker assignment */
    ITEM_OVERRIDE, /* of the layer before; a higher one stands behind a lower one */
    ITEM_VERTICAL, /* over the last ITEM_LAYER; products and overrides of its own follow */
    ITEM_VOLUME,   /* beside the stack */
    ITEM_LIGHT,
};

struct bind_item {
    uint32_t assign, level;
    uint8_t kind;    /* enum item_kind */
    uint8_t product; /* ITEM_PRODUCT: enum bind_product */
};

struct bind_entry {
    uint32_t matcher, level;
};

struct bind_state {
    uint32_t first_entry, num_entries; /* sorted by matcher */
    uint32_t first_item, num_items;    /* base first */
    uint32_t stack;                    /* STACK_NONE: only groups have these layers */
    prim_id first_prim;                /* 0: no primitive has it */
};
#define STACK_NONE UINT32_MAX

struct bind_stack {
    uint32_t state; /* one with its items */
    uint32_t num_prims;
    uint64_t hash; /* of the content: names, materials, variants; the same on every machine */
};

struct bindings {
    struct arena *arena;
    const struct scene *scene;
    struct bind_look look;
    VEC(struct bind_entry) entries;
    VEC(struct bind_state) states;
    VEC(struct bind_item) items;
    VEC(struct bind_stack) stacks;
    struct table stack_table;
    uint32_t *state_of;       /* by primitive */
    struct pattern_set added; /* again.c: the patterns that `before` did not have */
    uint32_t num_prims;       /* of the scene when it was resolved, with the root */
    uint32_t num_emptied;     /* of the scene, too */
    uint32_t num_resolved;    /* primitives whose matches were found, not taken from before */
};

struct bind_options {
    const char *const *solo, *const *mute; /* names of slots, layers or overrides */
    size_t num_solo, num_mute;
};

/*
 * Binds a look, which look_choose gives, to a scene. The arena keeps the result; `scratch` may be
 * freed afterwards, and the scene must stay. Call bindings_finish in the end, after a jump out of
 * memory, too.
 *
 * before: bindings of the scene from an earlier time, when it perhaps had fewer primitives; NULL:
 * none. Only primitives at or below a difference are then resolved. The result is the same.
 */
void bind_resolve(struct bindings *b, const struct library *lib, elem_id look,
                  const struct scene *scene, const struct bindings *before,
                  const struct bind_options *options, struct arena *arena, struct arena *scratch,
                  struct diag_list *diags);
void bindings_finish(struct bindings *b);

/* The state of a primitive, and the path above it (or its own) at a level. */
static inline const struct bind_state *bind_state_of(const struct bindings *b, prim_id prim)
{
    return &b->states.items[b->state_of[prim]];
}
prim_id bind_prim_at(const struct bindings *b, prim_id prim, uint32_t level);

/* ---- stand.c: which assignments stand where, in a state ---- */

struct stand {
    uint32_t name, level, assign;
};
struct stands { /* zero at first; serves one state after the other */
    struct stand *items;
    uint32_t len, cap;
    struct arena *scratch;
    VEC(uint32_t) reached; /* the collections that may hold the state */
    bool *is_reached;      /* by collection */
    uint32_t *levels;      /* by collection: the level of those that it includes */
    /* for assignments at one path */
    VEC(struct stand) rest;
    VEC(uint32_t) behind;
};
/*
 * The assignments that stand at a primitive of the state, sorted: by name, then the stronger first.
 */
void bind_stands(const struct bindings *b, const struct bind_state *state, struct stands *out);
/* True if an exclusion of the collection holds the primitives of a state. */
bool bind_is_excluded(const struct bindings *b, const struct bind_state *state,
                      uint32_t collection);

/* ---- idle.c: names that a state has, and no layer ---- */

struct bind_idle {
    struct bind_item item; /* without a kind */
    bool is_removed;       /* otherwise it sleeps */
};
struct idle_list { /* zero at first; serves one state after the other */
    struct bind_idle *items;
    uint32_t len, cap;
    uint32_t *marks, epoch; /* by assignment: the epoch in which it has an item */
};
/* Fills the list by name; `stands` is a work area. */
void bind_find_idle(const struct bindings *b, const struct bind_state *state, struct stands *stands,
                    struct idle_list *out);

/* ---- layer_stacks.c: the layers of a state ---- */

/* Notes about the layers of all states together, for warnings. */
struct layer_notes {
    uint32_t *sleeps_at; /* by name: 1 + a state where it sleeps */
    bool *has_layer;     /* by layer number: a state has it */
};
/* Fills the items of a state. */
void bind_layers(struct bindings *b, uint32_t state, struct stands *stands,
                 struct layer_notes *notes);
/* Finds the stack of a state; `adds` a new one if there is none. */
void bind_stack(struct bindings *b, uint32_t state, bool adds);

/*
 * scene_walk.c: fills the states of all primitives from b->look, without layers. The arena of b
 * keeps them. `before` is that of bind_resolve.
 */
void bind_find_states(struct bindings *b, const struct bindings *before, struct arena *scratch);

/* ---- facts.c: geometric properties, tokens, properties, visibility ---- */

enum bind_fact_kind { FACT_GEOMPROP, FACT_TOKEN, FACT_PROPERTY, FACT_VISIBILITY, NUM_FACTS };
extern const char *const bind_fact_words[NUM_FACTS];
/*
 * Bindings of facts instead of layers: the items of a state are the facts of its primitives, each
 * an assignment whose target is the element of the fact. Without facts there are no states. Call
 * bindings_finish in the end.
 */
void bind_facts(struct bindings *b, const struct library *lib, elem_id look,
                const struct scene *scene, const struct bindings *before, struct arena *arena,
                struct arena *scratch, struct diag_list *diags);
enum bind_fact_kind bind_fact_kind(const struct document *doc, elem_id fact);
/* Its name; the vistype of a visibility. */
const char *bind_fact_name(const struct document *doc, elem_id fact);

/* ---- reasons.c, binding_report.c ---- */

/* "stack_8a5f7a0f9c2f6f0e" and a NUL */
enum { BIND_STACK_NAME_SIZE = 6 + 16 + 1 };
void bind_stack_name(const struct bindings *b, uint32_t stack, char out[BIND_STACK_NAME_SIZE]);

/* unmatched.c: warns about each geometry name that matches no primitive. */
void bind_warn_unmatched(const struct bindings *b, struct arena *scratch, struct diag_list *diags);

/* Writes why each assignment that was considered for a primitive won, lost, removes or sleeps. */
void bind_explain(const struct bindings *b, prim_id prim, struct arena *scratch, struct text *out);

/*
 * Writes reports in pieces: whenever `out` is long, bind_flush may empty it.
 */
struct bind_writer {
    const struct bindings *b;
    struct text *out;
    struct arena *scratch;
    void (*flush)(void *user_data, struct text *out); /* may empty `out` */
    void *user_data;
    bool colour;
    struct text path, name; /* of the item at hand */
    const struct bind_state *idle_state;
    struct stands stands;
    struct idle_list idle; /* of idle_state */
};
/* Sets up a writer for the functions below; the members before `path` are the caller's. */
void bind_writer_init(struct bind_writer *writer);
void bind_write_table(struct bind_writer *writer);
void bind_write_json(struct bind_writer *writer);
/*
 * write_usda.c: returns how often a primitive has something that slot bindings cannot hold:
 * products of weaker assignments, variants, a volume beside a layer.
 */
uint32_t bind_write_usda(struct bind_writer *writer);

#endif
