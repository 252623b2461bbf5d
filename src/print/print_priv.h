// SPDX-License-Identifier: Apache-2.0
/* Shared by the files of this room. */
#ifndef MXG_PRINT_PRINT_PRIV_H
#define MXG_PRINT_PRINT_PRIV_H

#include "print/print.h"
#include "tree/ast.h"

/* ---- value_text.c ---- */

const char *print_function_name(const struct lang_names *names, const struct lang_unit *unit,
                                uint32_t id);
const char *print_global_name(const struct lang_names *names, const struct lang_unit *unit,
                              uint32_t id);
const char *print_struct_name(const struct lang_names *names, const struct lang_unit *unit,
                              ir_type_id type);

/* NULL: none */
const char *print_maker(const struct lang_names *names, const struct lang_unit *unit,
                        ir_type_id type);

/* lang_names.array; NULL: the type is no array, or has its own name */
const char *print_array_name(const struct lang_names *names, struct lang_type_text type);

/* The start of an array constructor: "float[3](" or "{". */
void print_open_array(const struct lang_style *style, const struct lang_names *names,
                      const struct lang_unit *unit, ir_type_id type, struct text *out);

/* Writes a value of any type but structs from consecutive words. Returns the word after it. */
const union ir_word *print_words(const struct lang_style *style, const struct lang_unit *unit,
                                 ir_type_id type, const union ir_word *words, struct text *out);

/* ---- The state while a function is printed ---- */

struct printed_value {
    const struct lang_node *node;
    const char *text;
};

struct printer {
    struct lang_style *style;
    const struct lang_names *names;
    const struct lang_unit *unit, *layer;
    const struct lang_function *fn;
    uint32_t id;      /* of fn */
    bool has_results; /* it returns a struct of its results */
    struct text *out;
    struct text_word *locals; /* by slot: its name in the output */
    uint32_t *visible;        /* slots in scope, innermost last */
    uint32_t num_visible;
    unsigned indent;
    bool is_typed; /* the target has forms that depend on types */
    /* expressions of the current statement that stand before it, and their texts (results.c) */
    VEC(struct printed_value) values;
    uint32_t num_results; /* names made for them */
};

static inline const struct lang_node *node_at(const struct printer *p, lang_ref ref)
{
    return ast_node(p->layer, ref);
}

/* ---- expression.c ---- */

/* The arguments of a call, without the results of a language with results_in_struct. */
void print_arguments(struct printer *p, const struct lang_node *call);
/* Names a slot, by the names in scope. */
void print_bring_into_scope(struct printer *p, uint32_t slot);
/* A name like `wanted` that nothing in scope has. */
struct text_word print_free_name(struct printer *p, struct text_word wanted);
/* Declares a slot by a phrase. */
void print_variable(struct printer *p, enum lang_phrase phrase, uint32_t slot);
void print_expression(struct printer *p, const struct lang_node *node, enum lang_precedence least);
void print_form(struct printer *p, const struct lang_pieces *form, ir_type_id type,
                const struct lang_node *const *operands);
/* The form of the target for the types of the operands; NULL: it has none. */
const struct lang_pieces *print_typed_form(struct printer *p, enum ir_op op, uint32_t attr,
                                           ir_type_id type, const struct lang_node *const *operands,
                                           unsigned num_operands);

/* The first value of a variable: of an array, its elements. */
void print_initialiser(struct printer *p, const struct lang_node *node);

/* ---- statement.c ---- */

void print_indent(struct printer *p);

/*
 * Writes the statements between braces in their own scope. `body` is a block or a single statement;
 * NULL: it is empty.
 */
void print_body(struct printer *p, const struct lang_node *body);

/* ---- results.c ---- */

/* "struct mdl_results_f {…};" above a function that returns it. */
void print_results_struct(struct printer *p, uint32_t id);
/* Its type, as the result of the function. */
struct lang_type_text print_results_type(struct printer *p, uint32_t id);
/* Declares the results of the function, which are locals. */
void print_result_locals(struct printer *p);
/* "return mdl_results_f(value, a, b)"; value 0: there is none. */
void print_return_results(struct printer *p, uint32_t id, lang_ref value);
/*
 * Writes the calls of a statement or expression that return such a struct, before it, with the
 * assignments of their results. True if there were any.
 */
bool print_result_calls(struct printer *p, lang_ref ref);
/* True if an expression has such calls; 0 has none. */
bool print_has_result_calls(struct printer *p, lang_ref expression);
/* Writes the value of an expression that stands before its statement. false: it does not. */
bool print_result_value(struct printer *p, const struct lang_node *node);
/* A name that nothing else in the function has: "mdl_r1". */
const char *print_result_name(struct printer *p);

/*
 * texts.c: writes the text of a function from its image. false: the image has none, or the text
 * contains a name that differs here.
 */
bool print_from_image(const struct lang_style *style, const struct lang_names *names,
                      const struct lang_unit *unit, uint32_t id, struct text *out);

#endif
