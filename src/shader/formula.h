// SPDX-License-Identifier: Apache-2.0
/*
 * Formulas: functions of the portable language that the compiler calls by their names, in place of
 * arithmetic in C. libraries/ has them; library/formulas.h brings them to the lowest unit.
 */
#ifndef MXG_SHADER_FORMULA_H
#define MXG_SHADER_FORMULA_H

#include "shader/shader.h"

/*
 * The value of a function for operands of the types of its parameters, which choose among
 * overloads. Constants fold, and short functions become nodes. The function exists and has one
 * result.
 */
ir_ref shader_formula(struct shader *shader, const char *name, const ir_ref *args,
                      unsigned num_args);
/* shader_formula(shader, "mx_name", a, b) with the operands in a list. */
#define FORMULA(shader, name, ...) \
    shader_formula(shader, name, (const ir_ref[]){__VA_ARGS__}, \
                   sizeof((const ir_ref[]){__VA_ARGS__}) / sizeof(ir_ref))

#endif
