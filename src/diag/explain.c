// SPDX-License-Identifier: Apache-2.0
/* The explanations of the messages. */
#include "diag/diag.h"

static const struct diag_explanation explanations[DIAG_NUM_IDS] = {
#define EXPLAIN(id, cause, cure, example) [DIAG_ID_##id] = {cause, cure, example},
#include "diag/explain.def"
#undef EXPLAIN
};

/* Each id exactly once: the compiler rejects a repeated id and names a missing one. */
enum {
#define EXPLAIN(id, cause, cure, example) explanation_of_##id,
#include "diag/explain.def"
#undef EXPLAIN
};
enum {
#define DIAG(id, severity, stable, format) has_##id = explanation_of_##id,
#include "diag/catalogue.def"
#undef DIAG
};

const struct diag_explanation *diag_explain(enum diag_id id)
{
    return &explanations[id];
}
