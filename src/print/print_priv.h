// SPDX-License-Identifier: Apache-2.0
/* Shared by print.c and value.c. */
#ifndef MXG_PRINT_PRINT_PRIV_H
#define MXG_PRINT_PRINT_PRIV_H

#include "print/print.h"
#include "tree/ast.h"

const char *print_function_name(const struct lang_names *names, const struct lang_unit *unit,
                                uint32_t id);
const char *print_global_name(const struct lang_names *names, const struct lang_unit *unit,
                              uint32_t id);
const char *print_struct_name(const struct lang_names *names, const struct lang_unit *unit,
                              ir_type_id type);

/* NULL: none */
const char *print_maker(const struct lang_names *names, const struct lang_unit *unit,
                        ir_type_id type);

/*
 * The text of a type before and after the name of a variable: the lengths of arrays follow the
 * name.
 */
/* The name of a built-in type. */
static inline void print_type_name(const struct lang_style *style, const struct lang_names *names,
                                   ir_type_id type, struct text *out)
{
    assert(type < IR_NUM_TYPES);
    if (names && names->type)
        names->type(names->user_data, type);
    text_put(out, style->types[type]);
}

void print_base_type(const struct lang_style *style, const struct lang_names *names,
                     const struct lang_unit *unit, ir_type_id type, struct text *out);
void print_lengths(const struct lang_unit *unit, ir_type_id type, struct text *out);

/* The start of an array constructor: "float[3](" or "{". */
void print_open_array(const struct lang_style *style, const struct lang_names *names,
                      const struct lang_unit *unit, ir_type_id type, struct text *out);

/*
 * texts.c: writes the text of a function from its image. false: the image has none, or the text
 * contains a name that differs here.
 */
bool print_from_image(const struct lang_style *style, const struct lang_names *names,
                      const struct lang_unit *unit, uint32_t id, struct text *out);

#endif
