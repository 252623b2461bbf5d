// SPDX-License-Identifier: Apache-2.0
/*
 * The partial evaluator. It first collects the arguments of each function, callers before callees,
 * and then makes each variant of a function once (plan.c):
 *
 *     forward    rebuilds the source tree in the unit of the generation, with constants for
 *                variables; folds, and skips branches that never run (statement.c, expression.c)
 *     resolve    redirects calls to versions, or simplifies them (redirect_calls.c)
 *     backward   unlinks statements without a use, and counts the uses of slots (sweep.c)
 *     single     replaces variables with a single read by their values (single.c)
 *     finish     renumbers slots, and completes the function's record (specialise.c)
 *
 * Until the last step, the new tree uses the slots of the source.
 */
#ifndef MXG_SPECIALISE_SPEC_H
#define MXG_SPECIALISE_SPEC_H

#include "specialise/specialise.h"
#include "tree/ast.h"
#include "tree/uses.h"
#include "tree/walk.h"

enum {
    SPEC_MAX_PARAMS = 64, /* parameters beyond this are never bound or dropped */
};

/*
 * The value of a parameter or argument: FACT_UNSEEN, FACT_VARIES, or 1 + index of a constant in the
 * generated unit's words.
 */
typedef uint32_t fact;
enum { FACT_UNSEEN = 0 };
#define FACT_VARIES UINT32_MAX

struct variant {         /* a function with the strings and flags that choose its code */
    uint32_t function;   /* id */
    uint32_t next;       /* 1 + index of another variant of the function; 0 = none */
    uint32_t first_fact; /* in plan->facts: one per parameter */
    /* in plan->calls: the calls of its tree; a call comes after the calls in its arguments */
    uint32_t first_call, num_calls;
    lang_ref body;    /* first statement of its tree, after the forward step */
    uint32_t version; /* id of the resulting function */
    bool changed;     /* its tree differs from the source */
    /* its source tree is unchanged so far; first_call: the variants that it calls */
    bool is_final;
    bool keeps_unused; /* some argument has effects, so unused parameters stay */
};

struct lang_plan {
    uint32_t *first_variant; /* by function id: 1 + index; 0 = no call */
    uint32_t num_ids;
    VEC(struct variant) variants;
    VEC(fact) facts;
    VEC(uint32_t) calls;
    bool is_open;      /* unseen calls exist, so all arguments vary and no parameter is dropped */
    struct spec *spec; /* makes all versions and reuses its memory */
};

struct chain { /* siblings */
    lang_ref first, last;
};

enum slot_use { SLOT_READ = 1, SLOT_WRITTEN = 2 };

struct spec_slot {    /* a slot of the source */
    lang_ref mention; /* backward: the first statement after the current one that names it */
    uint8_t uses;     /* enum slot_use */
    /* how many long literals stand for it (saturating) */
    uint8_t literals;
    uint8_t reads;     /* single: number of VAR nodes (saturating at 2) */
    bool is_dropped;   /* the version lacks this parameter */
    lang_ref declared; /* single: its DECLARE in the current list, if the value may move */
    uint32_t number;   /* finish: its number in the result */
};

struct spec {
    struct lang_unit *unit; /* the unit of the generation, which receives the result */
    uint32_t variant;
    const struct lang_unit *layer; /* the layer of the source */
    struct lang_function fn; /* a copy of the source function, because the original may move */
    bool changed;
    /* by slot, forward: a constant expression that equals the slot here, or 0 */
    lang_ref *known;
    struct spec_slot *slots; /* by slot */
    uint32_t cap_slots;
    uint32_t num_effects; /* number of calls so far that assign to their arguments */
    lang_ref statement;   /* the statement in the sweep */
    uint32_t num_lists;   /* number of swept lists */
    VEC(lang_ref) stack;  /* scratch memory of nested statements */
    VEC(lang_ref) vars;   /* nodes of the result that name a slot: VAR and DECLARE */
    /* long CONST nodes of the result that stand for a slot */
    VEC(lang_ref) longs;
    struct lang_uses uses; /* in the result */
};

/* The content of a node of the generated unit. */
static inline struct lang_node *spec_node(struct spec *s, lang_ref ref)
{
    return &s->unit->nodes.items[ref];
}

lang_ref spec_add(struct spec *s, struct lang_node node); /* clears next */
void spec_append(struct spec *s, struct chain *chain, lang_ref ref);
/* result_nodes.c: the words may belong to the unit. */
lang_ref spec_constant_words(struct spec *s, ir_type_id type, const union ir_word *words);
lang_ref spec_constant(struct spec *s, const struct ir_value *value);
bool spec_get(const struct spec *s, lang_ref ref, struct ir_value *out); /* the value of a CONST */

/* expression.c. The kind of the result may differ from the source. */
lang_ref spec_expression(struct spec *s, lang_ref ref);
/* the target of an assignment or an out argument: keeps its kind */
lang_ref spec_target(struct spec *s, lang_ref ref);

/* call.c. Before resolve, a call has 1 + the callee's variant in c. */
lang_ref spec_call(struct spec *s, struct lang_node call);

/* redirect_calls.c: resolves the calls of the variant. */
void spec_resolve(struct spec *s);

/*
 * inline_calls.c: the expression that replaces a call of a small function; 0 if the call stays.
 */
lang_ref spec_inline(struct spec *s, const struct lang_node *call);

/* fold_ops.c: an op over operands of the result: a constant, a simpler expression, or 0. */
lang_ref spec_fold(struct spec *s, const struct lang_node *op, const lang_ref *args,
                   unsigned num_args);

/* statement.c. False if control does not reach the end of the statements. */
bool spec_statements(struct spec *s, lang_ref first, struct chain *out);

/* sweep.c: removes unused statements of a body. */
lang_ref spec_sweep(struct spec *s, lang_ref first);

/* single.c: replaces variables with a single read by their values. */
lang_ref spec_single(struct spec *s, lang_ref first);

/* plan.c: the unit's plan; the first call makes it. */
struct lang_plan *plan_of(struct lang_unit *unit);

/* plan.c: records calls with unknown arguments. The plan is open from then on. */
uint32_t plan_note_any(struct lang_unit *unit, uint32_t function);

/*
 * plan.c: records the arguments of a call; NULL: all vary. Returns the variant of the callee; later
 * calls may move it.
 */
uint32_t plan_note_call(struct lang_unit *unit, uint32_t function, const fact *args,
                        bool args_have_effects);

#endif
