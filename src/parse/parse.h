// SPDX-License-Identifier: Apache-2.0
/* From text to typed trees. */
#ifndef MXG_PARSE_PARSE_H
#define MXG_PARSE_PARSE_H

#include "diag/diag.h"
#include "tree/tree.h"

/*
 * The source of files: false, with *out_reason, if a file cannot be read. `from` is the including
 * file or "".
 */
struct lang_reader {
    void *user_data;
    bool (*read)(void *user_data, const char *from, const char *ref, const char **out_name,
                 const char **out_text, size_t *out_len, const char **out_reason);
};

/*
 * Parses a file with its includes, each file once in the unit and the layers below. LANG_NONE after
 * errors, which go to diags.
 */
uint32_t lang_parse_file(struct lang_unit *unit, const struct lang_reader *reader, const char *from,
                         const char *ref, struct diag_place where, struct diag_list *diags);

/*
 * Parses a program: functions that no node of a document calls and nothing evaluates, which are
 * only printed. Beside the portable language it has variables at file scope, "++" and "--" inside
 * of expressions (not of the conditions of loops), functions without a body, and assignments to
 * uniforms and inputs: what the frame around the program declares. `name` stands in messages.
 * LANG_NONE after errors, which go to diags.
 */
uint32_t lang_parse_program(struct lang_unit *unit, const char *name, const char *text, size_t len,
                            struct diag_list *diags);

struct lang_input {
    str_id name;
    ir_type_id type;
};

/*
 * Parses an inline expression; {{name}} stands for an input. `file` (or LANG_NONE) makes its
 * functions and declarations visible. The result is a function of the unit with LANG_FN_EXPRESSION:
 * its slots are the inputs in order (all of them, used or not), its body returns the expression,
 * converted to `type`. `where` is the place of the first character. LANG_NONE after errors.
 */
uint32_t lang_parse_expression(struct lang_unit *unit, const char *text, size_t len,
                               const struct lang_input *inputs, unsigned num_inputs,
                               ir_type_id type, uint32_t file, struct diag_place where,
                               struct diag_list *diags);

/*
 * Finds a function by name in a file and its includes. `params` chooses among overloads, by exact
 * types, then by implicit conversion; NULL: the name must be unique. LANG_NONE if no function
 * matches.
 */
uint32_t lang_find_function(const struct lang_unit *unit, uint32_t file, str_id name,
                            const ir_type_id *params, unsigned num_params);

#endif
