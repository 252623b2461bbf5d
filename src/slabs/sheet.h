// SPDX-License-Identifier: Apache-2.0
/*
 * `mxgen inspect --slabs` shows this sheet, as data: sheet.c fills it in, and two files write it,
 * as text and as JSON.
 */
#ifndef MXG_SLABS_SHEET_H
#define MXG_SLABS_SHEET_H

#include "slabs/budget.h"
#include "slabs/features.h"

enum slab_row_kind {
    SLAB_ROW_SLAB,
    SLAB_ROW_LAYER,
    SLAB_ROW_MIX,
    SLAB_ROW_COVERAGE,
    SLAB_ROW_OTHER
};

/* A slab or operator; the operands of an operator follow it, one level deeper. */
struct slab_row {
    enum slab_row_kind kind;
    ir_ref ref;
    ir_ref thickness; /* 0: of the body */
    uint32_t depth;
    const char *role;   /* "top", "base", "fg"; "" at the top */
    const char *regime; /* of a slab: "opaque" */
    bool is_repeated;   /* it stands above with its operands */
    uint32_t features;  /* of a slab */
    uint32_t bytes;     /* of a slab, with its share of the pixel */
    uint32_t basis;     /* of a slab: the number of its tangent basis in the tree, from 1 */
    float through; /* of a slab: light that what is above lets through, along the normal; below 0:
                      unknown */
};

/* Operators that one value drives: the walk takes them as independent. */
struct slab_shared {
    ir_ref first, second;
};

struct slab_tree {
    ir_ref root;
    bool is_sheet;
    VEC(struct slab_row) rows;
    VEC(struct slab_shared) shared;
    uint32_t num_slabs, num_bases;
    struct slab_cost cost;
};

struct slab_sheet {
    const struct shader *shader;
    const char *body; /* what tells the thickness of a slab at the bottom of a body */
    VEC(struct slab_tree) trees;
    VEC(ir_ref) unread;        /* what the estimate knows no value of */
    bool is_recognised;        /* the slabs stand for other closures */
    struct slab_report report; /* of the budget */
    bool is_asked;             /* the caller has a budget; otherwise it is one closure */
};

void slabs_fill_sheet(struct shader *shader, const struct slabs_host *host,
                      const struct slab_budget *budget, ir_ref root, struct slab_sheet *out);

/* The inputs of a slab that both show. */
struct slab_shown {
    enum slab_operand input;
    const char *name; /* "mean free path" */
};
extern const struct slab_shown slab_shown[];
extern const unsigned num_slab_shown;
extern const char *const slab_row_names[]; /* by enum slab_row_kind */

/* sheet.c: a number with four digits. */
void slab_write_number(float value, struct text *out);
/* A value as text: a number, a colour or the name of what computes it. */
void slab_write_value(const struct slab_sheet *sheet, ir_ref ref, struct text *out);
/* The input of an operator: the thickness of a layer, the share of a mix; 0: it has none. */
ir_ref slab_operator_value(const struct slab_sheet *sheet, const struct slab_row *row);

void slabs_write_text(const struct slab_sheet *sheet, struct text *out);
void slabs_write_json(const struct slab_sheet *sheet, struct text *out);

#endif
