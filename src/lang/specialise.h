// SPDX-License-Identifier: Apache-2.0
/*
 * The partial evaluator, in three steps over one function:
 *
 *   forward  (spec_stmt.c, spec_expr.c)  the source tree is rebuilt in the generated unit with known values in place of
 *                                        variables; what they decide is folded and never-taken branches are not built
 *   backward (spec_sweep.c)              statements without a use are unlinked, uses of slots counted
 *   finish   (specialise.c)              slots get their new numbers and the function its description
 *
 * Until the last step, the new tree speaks of the source's slots.
 */
#ifndef MXG_LANG_SPECIALISE_H
#define MXG_LANG_SPECIALISE_H

#include "lang/ast.h"

enum {
    SPEC_MAX_PARAMS = 64, /* further ones are never bound, nor dropped */
    SPEC_MAX_DEPTH = 100, /* of calls inside of calls; deeper ones stay as they are */
};

struct version {
    uint32_t from, to; /* function ids */
    uint32_t hash;
    uint32_t first_bound; /* in versions->bound */
    bool keeps_unused;
};

struct lang_versions {
    VEC(struct version) items;
    VEC(lang_ref) bound; /* per version and parameter: a constant of the unit or 0 */
    uint32_t *table;     /* open addressing: index in items + 1 */
    uint32_t table_mask;
    unsigned depth;      /* of functions being specialised */
    VEC(lang_ref) stack; /* scratch of functions being specialised */
};

struct chain { /* siblings */
    lang_ref first, last;
};

enum slot_use { SLOT_READ = 1, SLOT_WRITTEN = 2 };

struct spec {
    struct lang_unit *unit; /* the generation's: the result goes there */
    const struct lang_bindings *options;
    const struct lang_unit *layer; /* of the source */
    struct lang_function fn;       /* the source; a copy, since its own place may move */
    bool keeps_unused;             /* keep parameters that nobody uses */
    bool changed;
    lang_ref *known;       /* by slot: an expression of constants which the slot equals here, or 0 */
    uint8_t *uses;         /* by slot: enum slot_use; filled backward */
    lang_ref *mentions;    /* by slot: the first statement behind the current one that names it */
    lang_ref statement;    /* being swept */
    uint32_t num_lists;    /* swept so far */
    uint8_t *literals;     /* by slot: how often its value stands for it, where that is long to write (saturating) */
    VEC(lang_ref) vars;    /* nodes of the result that name a slot: VAR and DECLARE */
    VEC(lang_ref) longs;   /* CONST nodes of the result that stand for a slot and are long to write */
    VEC(uint32_t) callees, globals; /* of the result, each once */
    uint32_t num_nodes;
    uint16_t flags;        /* enum lang_function_flags of the result */
};

/* What a generated unit's nodes say. */
static inline struct lang_node *spec_node(struct spec *s, lang_ref ref)
{
    return &s->unit->nodes.items[ref];
}

lang_ref spec_add(struct spec *s, struct lang_node node); /* next is cleared */
void spec_append(struct spec *s, struct chain *chain, lang_ref ref);
lang_ref spec_constant(struct spec *s, const struct ir_value *value, uint32_t place);
bool spec_get(const struct spec *s, lang_ref ref, struct ir_value *out); /* the value of a CONST */

/* spec_expr.c. A result of spec_expression may be of a kind other than the source's. */
lang_ref spec_expression(struct spec *s, lang_ref ref);
lang_ref spec_target(struct spec *s, lang_ref ref); /* of an assignment or an out argument: stays what it is */
bool spec_has_effects(const struct spec *s, lang_ref ref); /* does it call anything that assigns to its arguments? */

/* spec_call.c */
lang_ref spec_call(struct spec *s, struct lang_node call);
bool spec_is_finite(const struct ir_value *value); /* spec_fold.c */

/* spec_inline.c: the expression that a call of a small function stands for; 0 where it stays a call. */
lang_ref spec_inline(struct spec *s, const struct lang_node *call);

/* spec_fold.c: an op over operands of the result: a constant, a simpler expression, or 0. */
lang_ref spec_fold(struct spec *s, const struct lang_node *op, const lang_ref *args, unsigned num_args);

/* spec_stmt.c. False where control does not reach what follows. */
bool spec_statements(struct spec *s, lang_ref first, struct chain *out);

/* spec_forward.c: variables that are read once become their values. */
lang_ref spec_forward(struct spec *s, lang_ref first);

/* spec_sweep.c: what remains of a body. */
lang_ref spec_sweep(struct spec *s, lang_ref first);

/* specialise.c: bound by CONST nodes of the unit, one per parameter, 0 for free ones. */
uint32_t spec_function(struct lang_unit *unit, const struct lang_bindings *options, uint32_t id, const lang_ref *bound,
                       bool keeps_unused);
/* Does a constant argument make a version of its own? Strings and flags do; numbers are planned (plan.c). */
bool spec_is_worth_binding(const struct ir_value *value);
/* The forward step alone, for the calls that it meets. */
void spec_visit(struct lang_unit *unit, uint32_t id, const lang_ref *bound);

/* plan.c */
bool spec_is_planned(const struct lang_unit *unit);    /* versions are those of the plan */
bool spec_is_collecting(const struct lang_unit *unit); /* calls are only noted */
/* Constants that all calls of a function pass, as CONST nodes of the unit, 0 for the others: one per parameter. */
void spec_planned_params(struct lang_unit *unit, uint32_t id, lang_ref *bound);

#endif
