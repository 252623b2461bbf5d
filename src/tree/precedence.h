// SPDX-License-Identifier: Apache-2.0
/* The precedence of operators, for the parser and the printers. */
#ifndef MXG_TREE_PRECEDENCE_H
#define MXG_TREE_PRECEDENCE_H

/* in increasing order; printers parenthesise an operand of lower precedence */
enum lang_precedence {
    LANG_PREC_COMMA,
    LANG_PREC_ASSIGN,
    LANG_PREC_TERNARY,
    LANG_PREC_LOR,
    LANG_PREC_LXOR,
    LANG_PREC_LAND,
    LANG_PREC_OR,
    LANG_PREC_XOR,
    LANG_PREC_AND,
    LANG_PREC_EQUAL,
    LANG_PREC_COMPARE,
    LANG_PREC_SHIFT,
    LANG_PREC_SUM,
    LANG_PREC_PRODUCT,
    LANG_PREC_UNARY,
    LANG_PREC_POSTFIX,
    LANG_PREC_PRIMARY
};

#endif
