// SPDX-License-Identifier: Apache-2.0
/*
 * The partial evaluator. What a function is called with is gathered first, callers before callees,
 * and each variant of a function is then made once (plan.c):
 *
 *   forward  (statement.c, expression.c)  the source tree is rebuilt in the generated unit with
 * known values in place of variables; what they decide is folded and never-taken branches are not
 * built resolve  (resolve.c)            calls become calls of the callees' versions, or what
 * is simpler backward (sweep.c)              statements without a use are unlinked, uses of
 * slots counted single   (single.c)             variables that are read once become their
 * values finish   (specialise.c)              slots get their new numbers and the function its
 * description
 *
 * Until the last step, the new tree speaks of the source's slots.
 */
#ifndef MXG_SPECIALISE_SPEC_H
#define MXG_SPECIALISE_SPEC_H

#include "specialise/specialise.h"
#include "tree/ast.h"

enum {
    SPEC_MAX_PARAMS = 64, /* further ones are never bound, nor dropped */
};

/*
 * What is known of a parameter: FACT_UNSEEN, FACT_VARIES, or 1 + index of its value in the
 * generated unit's words. The same tells what is passed to it.
 */
typedef uint32_t fact;
enum { FACT_UNSEEN = 0 };
#define FACT_VARIES UINT32_MAX

struct variant {         /* a function with the strings and flags that choose what it is */
    uint32_t function;   /* id */
    uint32_t next;       /* 1 + index of another variant of it; 0 = none */
    uint32_t first_fact; /* in plan->facts: one per parameter */
    /* in plan->calls: its tree's, arguments before the call that they are for */
    uint32_t first_call, num_calls;
    lang_ref body;    /* its tree's first statement, once the forward step has been */
    uint32_t version; /* id of the function that it has become */
    bool changed;     /* its tree is not the source's */
    /* its source's tree is taken as it is, so far; first_call: the variants that it calls */
    bool is_final;
    bool keeps_unused; /* parameters that nobody uses: some argument has effects */
};

struct lang_plan {
    uint32_t *first_variant; /* by function id: 1 + index; 0 = not called */
    uint32_t num_ids;
    VEC(struct variant) variants;
    VEC(fact) facts;
    VEC(uint32_t) calls;
    bool is_open;      /* there are other calls than those seen: nothing is known of any argument */
    struct spec *spec; /* the one that makes all versions: its memory is used again */
};

struct chain { /* siblings */
    lang_ref first, last;
};

enum slot_use { SLOT_READ = 1, SLOT_WRITTEN = 2 };

struct spec_slot {    /* of the source */
    lang_ref mention; /* backward: the first statement behind the current one that names it */
    uint8_t uses;     /* enum slot_use */
    /* how often its value stands for it, where that is long to write (saturating) */
    uint8_t literals;
    uint8_t reads;     /* single: VAR nodes (saturating at 2) */
    bool is_dropped;   /* a parameter that the version does without */
    lang_ref declared; /* single: its DECLARE in the list at hand, when it may be forwarded */
    uint32_t number;   /* finish: in the result */
};

struct spec {
    struct lang_unit *unit; /* the generation's: the result goes there */
    uint32_t variant;
    const struct lang_unit *layer; /* of the source */
    struct lang_function fn;       /* the source; a copy, since its own place may move */
    bool changed;
    /* by slot, forward: an expression of constants which the slot equals here, or 0 */
    lang_ref *known;
    struct spec_slot *slots; /* by slot */
    uint32_t cap_slots;
    uint32_t num_effects; /* calls so far that assign to their arguments */
    lang_ref statement;   /* being swept */
    uint32_t num_lists;   /* swept so far */
    VEC(lang_ref) stack;  /* scratch of statements that hold others */
    VEC(lang_ref) vars;   /* nodes of the result that name a slot: VAR and DECLARE */
    /* CONST nodes of the result that stand for a slot and are long to write */
    VEC(lang_ref) longs;
    VEC(uint32_t) callees, globals; /* of the result, each once */
    uint32_t num_nodes;
    uint16_t flags; /* enum lang_function_flags of the result */
};

/* What a generated unit's nodes say. */
static inline struct lang_node *spec_node(struct spec *s, lang_ref ref)
{
    return &s->unit->nodes.items[ref];
}

lang_ref spec_add(struct spec *s, struct lang_node node); /* next is cleared */
void spec_append(struct spec *s, struct chain *chain, lang_ref ref);
/* node.c: the words of a type's components may be the unit's own. */
lang_ref spec_constant_words(struct spec *s, ir_type_id type, const union ir_word *words);
lang_ref spec_constant(struct spec *s, const struct ir_value *value);
bool spec_get(const struct spec *s, lang_ref ref, struct ir_value *out); /* the value of a CONST */

/* expression.c. A result of spec_expression may be of a kind other than the source's. */
lang_ref spec_expression(struct spec *s, lang_ref ref);
/* of an assignment or an out argument: stays what it is */
lang_ref spec_target(struct spec *s, lang_ref ref);
/* does it call anything that assigns to its arguments? */
bool spec_has_effects(const struct spec *s, lang_ref ref);

/* call.c. Until it is resolved, a call has 1 + the callee's variant in c. */
lang_ref spec_call(struct spec *s, struct lang_node call);
bool spec_is_finite(const struct ir_value *value); /* fold.c */

/* resolve.c: the calls of the variant. */
void spec_resolve(struct spec *s);

/*
 * inline.c: the expression that a call of a small function stands for; 0 where it stays a
 * call.
 */
lang_ref spec_inline(struct spec *s, const struct lang_node *call);

/* fold.c: an op over operands of the result: a constant, a simpler expression, or 0. */
lang_ref spec_fold(struct spec *s, const struct lang_node *op, const lang_ref *args,
                   unsigned num_args);

/* statement.c. False where control does not reach what follows. */
bool spec_statements(struct spec *s, lang_ref first, struct chain *out);

/* sweep.c: what remains of a body. */
lang_ref spec_sweep(struct spec *s, lang_ref first);

/* single.c: variables that are read once become their values. */
lang_ref spec_single(struct spec *s, lang_ref first);

/* plan.c: the unit's plan, made by the first call of this. */
struct lang_plan *plan_of(struct lang_unit *unit);

/*
 * plan.c: tells what a call passes. Returns the variant that is called, which may be moved by
 * further ones.
 */
/* makes the plan an open one: no parameter is bound, or dropped */
uint32_t plan_note_any(struct lang_unit *unit, uint32_t function);
uint32_t plan_note_call(struct lang_unit *unit, uint32_t function, const fact *args,
                        bool args_have_effects);

#endif
