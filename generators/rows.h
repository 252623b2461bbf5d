// SPDX-License-Identifier: Apache-2.0
/*
 * Rows that the tables of several languages share: struct lang_form, names of types, and the rows
 * of functions.def and images.def.
 */
#ifndef MXG_GENERATORS_ROWS_H
#define MXG_GENERATORS_ROWS_H

#define CALL(op, text) [IR_##op] = {text, LANG_PREC_POSTFIX, false}

/* struct target_function, and struct target_image with the functions that read and write it */
#define FUNCTION(name, text) {name, text},
#define IMAGE(kind, format, access, type, ...) {kind, format, access, type, {__VA_ARGS__}},

/* clang-format off */

/* Operators compare vectors, too, and give a vector. */
#define OPERATORS_OF_VECTORS \
    [IR_LXOR] = {"$0 != $1", LANG_PREC_EQUAL, true}, \
    [IR_LESS] = {"$0 < $1", LANG_PREC_COMPARE, true}, \
    [IR_LESS_EQUAL] = {"$0 <= $1", LANG_PREC_COMPARE, true}, \
    [IR_GREATER] = {"$0 > $1", LANG_PREC_COMPARE, true}, \
    [IR_GREATER_EQUAL] = {"$0 >= $1", LANG_PREC_COMPARE, true}, \
    [IR_EQUAL] = {"$0 == $1", LANG_PREC_EQUAL, true}, \
    [IR_NOT_EQUAL] = {"$0 != $1", LANG_PREC_EQUAL, true}, \
    [IR_NOT_EACH] = {"!$0", LANG_PREC_UNARY, false}

/* Names as float3 and float3x3. */
#define FLOAT3_TYPES \
    [IR_TYPE_BVEC2] = "bool2", [IR_TYPE_BVEC3] = "bool3", [IR_TYPE_BVEC4] = "bool4", \
    [IR_TYPE_IVEC2] = "int2", [IR_TYPE_IVEC3] = "int3", [IR_TYPE_IVEC4] = "int4", \
    [IR_TYPE_UVEC2] = "uint2", [IR_TYPE_UVEC3] = "uint3", [IR_TYPE_UVEC4] = "uint4", \
    [IR_TYPE_VEC2] = "float2", [IR_TYPE_VEC3] = "float3", [IR_TYPE_VEC4] = "float4", \
    [IR_TYPE_MAT2] = "float2x2", [IR_TYPE_MAT3] = "float3x3", [IR_TYPE_MAT4] = "float4x4"

/* Half floats as `type`, type2, type3 and type4. */
#define HALF_TYPES(type) \
    [IR_TYPE_FLOAT] = type, [IR_TYPE_VEC2] = type "2", [IR_TYPE_VEC3] = type "3", [IR_TYPE_VEC4] = type "4"

/* clang-format on */

#endif
