// SPDX-License-Identifier: Apache-2.0
/* Source for genosl: what MaterialX's generator gives it. */
#include "generators/osl/osl.h"

#include "base/scan.h"
#include "shader/verbatim.h"

static const struct source_helper helpers[] = {
#define HELPER(name, text) {name, text, NULL},
#define ABSENT(name)
#include "generators/osl/prelude.def"
#undef HELPER
#undef ABSENT
};

static const char *const absent[] = {
#define HELPER(name, text)
#define ABSENT(name) name,
#include "generators/osl/prelude.def"
#undef HELPER
#undef ABSENT
};

/*
 * Operators and functions that OSL lacks for structs of numbers, and source may use. Operands: 'T'
 * is the struct, 'f' a float.
 */
static const struct {
    uint8_t op;
    const char *word, *operands;
    bool gives_float;
} of_structs[] = {
    {IR_NEG, "-", "T", false},         {IR_ADD, "+", "TT", false},
    {IR_ADD, "+", "Tf", false},        {IR_ADD, "+", "fT", false},
    {IR_SUB, "-", "TT", false},        {IR_SUB, "-", "Tf", false},
    {IR_SUB, "-", "fT", false},        {IR_MUL, "*", "TT", false},
    {IR_MUL, "*", "Tf", false},        {IR_MUL, "*", "fT", false},
    {IR_DIV, "/", "TT", false},        {IR_DIV, "/", "Tf", false},
    {IR_DIV, "/", "fT", false},        {IR_ABS, "abs", "T", false},
    {IR_FLOOR, "floor", "T", false},   {IR_CEIL, "ceil", "T", false},
    {IR_SQRT, "sqrt", "T", false},     {IR_EXP, "exp", "T", false},
    {IR_LOG, "log", "T", false},       {IR_SIN, "sin", "T", false},
    {IR_COS, "cos", "T", false},       {IR_SIGN, "sign", "T", false},
    {IR_MIN, "min", "TT", false},      {IR_MIN, "min", "Tf", false},
    {IR_MAX, "max", "TT", false},      {IR_MAX, "max", "Tf", false},
    {IR_MIX, "mix", "TTf", false},     {IR_MIX, "mix", "TTT", false},
    {IR_CLAMP, "clamp", "TTT", false}, {IR_CLAMP, "clamp", "Tff", false},
    {IR_POW, "pow", "TT", false},      {IR_POW, "pow", "Tf", false},
    {IR_ATAN2, "atan2", "TT", false},  {IR_NORMALIZE, "normalize", "T", false},
    {IR_DOT, "dot", "TT", true},       {IR_LENGTH, "length", "T", true},
};

static bool has_word(const char *text, const char *name)
{
    struct scan scan;
    struct scan_word word;
    scan_begin(&scan, text, strlen(text));
    while (scan_next(&scan, &word))
        if ((word.kind == SCAN_NAME || word.kind == SCAN_MARK) && scan_is(&word, name))
            return true;
    return false;
}

void osl_add_struct_functions(struct osl *osl, ir_type_id type, const char *text)
{
    for (size_t i = 0; i < sizeof of_structs / sizeof *of_structs; i++) {
        if (!has_word(text, of_structs[i].word))
            continue;
        ir_type_id operands[3];
        struct lang_use use = {.op = (enum ir_op)of_structs[i].op,
                               .type = of_structs[i].gives_float ? IR_TYPE_FLOAT : type,
                               .operands = operands,
                               .num_operands = (unsigned)strlen(of_structs[i].operands)};
        for (unsigned k = 0; k < use.num_operands; k++)
            operands[k] = of_structs[i].operands[k] == 'T' ? type : IR_TYPE_FLOAT;
        osl_form(osl->spell, &use);
    }
}

_Static_assert(sizeof helpers / sizeof *helpers <= SOURCE_MAX_HELPERS, "a bit for each helper");

const struct source_language osl_source = {
    .helpers = helpers,
    .absent = absent,
    .num_helpers = sizeof helpers / sizeof *helpers,
    .num_absent = sizeof absent / sizeof *absent,
};
