// SPDX-License-Identifier: Apache-2.0
/* Tree walks that lower, specialise, evaluate, reach and print share. */
#ifndef MXG_TREE_AST_H
#define MXG_TREE_AST_H

#include "tree/tree.h"

#include <assert.h>

static inline const struct lang_node *ast_node(const struct lang_unit *layer, lang_ref ref)
{
    return &layer->nodes.items[ref];
}

/* The step statement of a loop; 0 if it has none. */
static inline lang_ref ast_step(const struct lang_unit *layer, const struct lang_node *loop)
{
    return loop->kind == LANG_FOR ? ast_node(layer, loop->c)->b : 0;
}

static inline const struct lang_slot *ast_slot(const struct lang_unit *layer,
                                               const struct lang_function *fn, uint32_t slot)
{
    return &layer->slots.items[fn->first_slot + slot];
}

/* Ids of the functions that it calls directly. */
static inline const uint32_t *ast_callees(const struct lang_unit *layer,
                                          const struct lang_function *fn)
{
    return layer->refs.items + fn->first_ref;
}

/* Ids of the globals that it reads directly. */
static inline const uint32_t *ast_globals(const struct lang_unit *layer,
                                          const struct lang_function *fn)
{
    return ast_callees(layer, fn) + fn->num_callees;
}

/* The CALL nodes of a LANG_FN_FINAL. */
static inline const lang_ref *ast_calls(const struct lang_unit *layer,
                                        const struct lang_function *fn)
{
    return ast_globals(layer, fn) + fn->num_globals;
}

static inline const union ir_word *ast_words(const struct lang_unit *layer,
                                             const struct lang_node *constant)
{
    return layer->words.items + constant->a;
}

static inline bool ast_is_user_type(ir_type_id type)
{
    return type >= IR_TYPE_FIRST_USER;
}

/* A constant of a built-in type from its words. */
static inline struct ir_value ast_value(ir_type_id type, const union ir_word *words)
{
    struct ir_value value = {.type = type};
    memcpy(value.w, words, ir_type_info(type)->components * sizeof *words);
    return value;
}

/*
 * The number of scalars in a value of a type, including members and elements; 0 for opaque types.
 */
static inline uint32_t ast_type_words(const struct lang_unit *unit, ir_type_id type)
{
    return ast_is_user_type(type) ? lang_user_type(unit, type, NULL)->num_words
                                  : ir_type_info(type)->components;
}

/*
 * The number of leaves in a value of a type: 1 for a vector, the sum over the members for a struct.
 */
static inline uint32_t ast_type_leaves(const struct lang_unit *unit, ir_type_id type)
{
    return ast_is_user_type(type) ? lang_user_type(unit, type, NULL)->num_leaves
                                  : type != IR_TYPE_VOID;
}

/*
 * The offset and type of member `index` of a struct. `size_of`, one of the two functions above,
 * gives the unit.
 */
uint32_t ast_member_offset(const struct lang_unit *unit, ir_type_id type, uint32_t index,
                           uint32_t (*size_of)(const struct lang_unit *, ir_type_id),
                           ir_type_id *out_type);

/* The slot of a target expression: a VAR, or a SWIZZLE, INDEX or MEMBER of one. */
uint32_t ast_target_slot(const struct lang_unit *layer, lang_ref target);

/* The number of elements, columns or components that an index selects from. */
uint32_t ast_num_parts(const struct lang_unit *unit, ir_type_id type);

/* enum lang_param_mode of a function's parameter. */
uint8_t ast_param_mode(const struct lang_unit *unit, uint32_t function, uint32_t param);

enum { AST_MAX_OPERANDS = 16 }; /* operands of a CONSTRUCT of a built-in type */

/* Writes operands or arguments to out[], at most `max`; returns their number. */
unsigned ast_list(const struct lang_unit *layer, lang_ref first, lang_ref *out, unsigned max);

/* The expression of a function that consists of `return expression;`, or 0. */
lang_ref ast_returned(const struct lang_unit *layer, const struct lang_function *fn);

#endif
