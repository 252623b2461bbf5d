// SPDX-License-Identifier: Apache-2.0
/*
 * Formulas: functions of libraries/ that the compiler itself calls by their names
 * (shader/formula.h). A library may have no base, as MaterialX's own has none, so the compiler has
 * their texts, and each library without a base has their functions.
 */
#ifndef MXG_LIBRARY_FORMULAS_H
#define MXG_LIBRARY_FORMULAS_H

#include "tree/tree.h"

struct formula_file {
    const char *name;
    const char *const *lines; /* NULL ends them */
};
/* formulas.c.in */
extern const struct formula_file formula_files[];
extern const unsigned num_formula_files;

/* Parses the formulas as the first files of a unit without a base. */
void library_add_formulas(struct lang_unit *unit);

#endif
