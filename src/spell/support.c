// SPDX-License-Identifier: Apache-2.0
/* support: the table of the ops that a target can write, for tests. */
#include "spell/target.h"

/* The speller writes these ops itself: names, literals and constructors need no form. */
static bool is_structural(enum ir_op op)
{
    switch (op) {
    case IR_CONST:
    case IR_UNIFORM:
    case IR_STREAM:
    case IR_TEXTURE:
    case IR_PARAM:
    case IR_LOCAL:
    case IR_CONTEXT:
    case IR_SAMPLE:
    case IR_POISON:
    case IR_CONSTRUCT:
    case IR_SWIZZLE:
    case IR_MEMBER:
    case IR_CALL:
    case IR_VERBATIM:
    case IR_GRAPH_CALL:
    case IR_RESULT: return true;
    default: return false;
    }
}

/* The capability that an op needs beside a form; 0: none. */
static uint64_t needed_caps(enum ir_op op)
{
    switch (op) {
    case IR_BITNOT:
    case IR_SHL:
    case IR_SHR:
    case IR_AND:
    case IR_OR:
    case IR_XOR:
    case IR_FLOAT_TO_UINT_BITS:
    case IR_UINT_BITS_TO_FLOAT: return CAP_BITWISE;
    case IR_TEX: return CAP_IMPLICIT_LOD;
    default: return 0;
    }
}

enum spell_support spell_support(const struct target *target, enum ir_op op)
{
    if (is_structural(op))
        return SPELL_YES;
    if (op >= IR_LEAF)
        return target->closures ? SPELL_YES : SPELL_LOWERED;
    const struct lang_form *form = lang_syntax_form(target->syntax, op);
    if (!form || !form->text)
        return SPELL_NO;
    uint64_t caps = needed_caps(op);
    return (target->caps & caps) == caps ? SPELL_YES : SPELL_NO;
}
