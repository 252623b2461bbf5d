// SPDX-License-Identifier: Apache-2.0
#include "document/document.h"

/*
 * types.def and words.def list the types in the same order, so a type and its word differ by a
 * constant.
 */
enum { WORD_OF_FIRST_TYPE = STR_boolean, NUM_TABLE_TYPES = DOC_TYPE_material - DOC_TYPE_boolean };

#define DOC_TYPE(ID, ir, components, traits) \
    _Static_assert((int)STR_##ID - (int)WORD_OF_FIRST_TYPE \
                       == (int)DOC_TYPE_##ID - (int)DOC_TYPE_boolean, \
                   "types.def and words.def differ at " #ID);
#include "document/types.def"
#undef DOC_TYPE

enum { COLORLESS = 1, UNIT = 2 };
static const struct {
    ir_type_id ir;
    uint8_t components, traits;
} types[DOC_NUM_TYPES] = {
#define DOC_TYPE(ID, ir, components, traits) [DOC_TYPE_##ID] = {IR_TYPE_##ir, components, traits},
#include "document/types.def"
#undef DOC_TYPE
    [DOC_TYPE_material] = {IR_TYPE_MATERIAL, 0, 0},
};

doc_type doc_type_of(str_id name)
{
    if (name - WORD_OF_FIRST_TYPE < NUM_TABLE_TYPES)
        return (doc_type)(name - WORD_OF_FIRST_TYPE + DOC_TYPE_boolean);
    return name == STR_material      ? DOC_TYPE_material
           : name == STR_multioutput ? DOC_TYPE_multioutput
                                     : DOC_TYPE_NONE;
}

str_id doc_type_name(doc_type type)
{
    if (type == DOC_TYPE_NONE || type >= DOC_NUM_TYPES)
        return STR_EMPTY;
    if (type == DOC_TYPE_material || type == DOC_TYPE_multioutput)
        return type == DOC_TYPE_material ? STR_material : STR_multioutput;
    return (str_id)(type - DOC_TYPE_boolean + WORD_OF_FIRST_TYPE);
}

ir_type_id doc_type_ir(doc_type type)
{
    return type < DOC_NUM_TYPES ? types[type].ir : (ir_type_id)IR_TYPE_VOID;
}

bool doc_type_is_colorless(doc_type type)
{
    return type < DOC_NUM_TYPES && types[type].traits & COLORLESS;
}

bool doc_type_can_have_unit(doc_type type)
{
    return type < DOC_NUM_TYPES && types[type].traits & UNIT;
}

bool doc_type_is_measure(doc_type type)
{
    return doc_type_can_have_unit(type) && types[type].components;
}

unsigned doc_type_components(doc_type type)
{
    return type < DOC_NUM_TYPES ? types[type].components : 0;
}
