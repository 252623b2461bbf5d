// SPDX-License-Identifier: Apache-2.0
/* explain: what is behind each message. */
#include "diag/diag.h"

static const struct diag_explanation explanations[DIAG_NUM_IDS] = {
#define EXPLAIN(id, cause, cure, example) [DIAG_ID_##id] = {cause, cure, example},
#include "diag/explain.def"
#undef EXPLAIN
};

/*
 * Each id once, and none left out: the compiler refuses two of one name, and names what is missing.
 */
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
