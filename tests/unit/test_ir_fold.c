// SPDX-License-Identifier: Apache-2.0
/*
 * Constant arithmetic against values worked out by hand or with other tools from the definitions in
 * GLSL 4.50 section 8 and 5. Every foldable op must stand in the table.
 */
#include "ir/ir.h"

#include "ir_text.h"
#include "test.h"

static const struct {
    const char *node;  /* as in the text form: op, type, operands */
    const char *value; /* "undefined" where GLSL leaves it so */
} cases[] = {
    /* operators on floats, vectors and matrices */
    {"neg float 1.5", "-1.5"},
    {"neg float 0.0", "-0.0"},
    {"neg mat2 mat2(1.0, 2.0, 3.0, 4.0)", "mat2(-1.0, -2.0, -3.0, -4.0)"},
    {"add float 0.1, 0.2", "0.3"}, /* 0.1f + 0.2f rounds to 0.3f */
    {"add float 16777216.0, 1.0", "16777216.0"},
    {"add vec3 vec3(1.0, 2.0, 3.0), 1.0", "vec3(2.0, 3.0, 4.0)"},
    {"add mat2 1.0, mat2(1.0, 2.0, 3.0, 4.0)", "mat2(2.0, 3.0, 4.0, 5.0)"},
    {"sub vec2 1.0, vec2(0.25, 2.0)", "vec2(0.75, -1.0)"},
    {"mul vec2 vec2(2.0, 3.0), vec2(4.0, 5.0)", "vec2(8.0, 15.0)"},
    {"mul mat2 mat2(1.0, 2.0, 3.0, 4.0), 2.0", "mat2(2.0, 4.0, 6.0, 8.0)"},
    /* columns (1 2) and (3 4) */
    {"mul vec2 mat2(1.0, 2.0, 3.0, 4.0), vec2(5.0, 6.0)", "vec2(23.0, 34.0)"},
    {"mul vec2 vec2(5.0, 6.0), mat2(1.0, 2.0, 3.0, 4.0)", "vec2(17.0, 39.0)"},
    {"mul mat2 mat2(1.0, 2.0, 3.0, 4.0), mat2(5.0, 6.0, 7.0, 8.0)", "mat2(23.0, 34.0, 31.0, 46.0)"},
    {"mul vec3 mat3(0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0), vec3(7.0, 8.0, 9.0)",
     "vec3(9.0, 7.0, 8.0)"},
    {"div vec2 1.0, vec2(2.0, 4.0)", "vec2(0.5, 0.25)"},
    {"div float 1.0, 0.0", "inf"},
    {"div float -1.0, 0.0", "-inf"},
    {"div mat2 mat2(2.0, 4.0, 6.0, 8.0), mat2(1.0, 2.0, 3.0, 4.0)", "mat2(2.0, 2.0, 2.0, 2.0)"},
    /* integers wrap */
    {"neg int -2147483648", "-2147483648"},
    {"neg uint 1u", "4294967295u"},
    {"add int 2147483647, 1", "-2147483648"},
    {"add ivec2 ivec2(1, 2), 3", "ivec2(4, 5)"},
    {"sub uint 1u, 2u", "4294967295u"},
    {"mul int 65536, 65536", "0"},
    {"mul uint 65537u, 65537u", "131073u"},
    {"div int -7, 2", "-3"},
    {"div int -2147483648, -1", "-2147483648"},
    {"div int 1, 0", "undefined"},
    {"div uint 4294967295u, 2u", "2147483647u"},
    {"div uint 1u, 0u", "undefined"},
    {"rem int 7, 3", "1"},
    {"rem int -7, 3", "undefined"},
    {"rem int 7, 0", "undefined"},
    {"rem uint 4294967295u, 10u", "5u"},
    {"bitnot int 0", "-1"},
    {"bitnot uint 1u", "4294967294u"},
    {"shl int 1, 31", "-2147483648"},
    {"shl int 1, 32", "undefined"},
    {"shl int 1, -1", "undefined"},
    {"shl int 3, 2u", "12"},
    {"shl uint 4294967295u, 4u", "4294967280u"},
    {"shr int -8, 1", "-4"},
    {"shr int -1, 31", "-1"},
    {"shr uint 4294967288u, 1u", "2147483644u"},
    {"and int 12, 10", "8"},
    {"or int 12, 10", "14"},
    {"xor uint 12u, 10u", "6u"},
    {"xor ivec2 ivec2(1, 2), ivec2(3, 3)", "ivec2(2, 1)"},
    /* comparisons and logic */
    {"lt bool 1.0, 2.0", "true"},
    {"lt bool nan#2143289344, 1.0", "false"},
    {"lt bool -1, 1", "true"},
    {"lt bool 4294967295u, 1u", "false"},
    {"le bool 2.0, 2.0", "true"},
    {"gt bool 2, 1", "true"},
    {"ge bool 1.0, 2.0", "false"},
    {"eq bool 0.0, -0.0", "true"},
    {"eq bool nan#2143289344, nan#2143289344", "false"},
    {"eq bool vec3(1.0, 2.0, 3.0), vec3(1.0, 2.0, 3.0)", "true"},
    {"eq bool vec3(1.0, 2.0, 3.0), vec3(1.0, 2.0, 4.0)", "false"},
    {"eq bool true, false", "false"},
    {"eq bool \"a\", \"a\"", "true"},
    {"ne bool nan#2143289344, 1.0", "true"},
    {"ne bool ivec2(1, 2), ivec2(1, 2)", "false"},
    {"ne bool \"a\", \"b\"", "true"},
    {"not bool true", "false"},
    {"land bool true, false", "false"},
    {"lor bool true, false", "true"},
    {"lxor bool true, true", "false"},
    {"lxor bool false, true", "true"},
    {"select float true, 1.0, 2.0", "1.0"},
    {"select vec2 false, vec2(1.0, 1.0), vec2(2.0, 3.0)", "vec2(2.0, 3.0)"},
    {"select string false, \"a\", \"b\"", "\"b\""},
    /* building and taking apart */
    {"construct vec3 1.5", "vec3(1.5, 1.5, 1.5)"},
    {"construct vec4 vec2(1.0, 2.0), 3.0, 4.0", "vec4(1.0, 2.0, 3.0, 4.0)"},
    {"construct ivec2 1, 2", "ivec2(1, 2)"},
    {"construct mat2 2.0", "mat2(2.0, 0.0, 0.0, 2.0)"},
    {"construct mat3 vec3(1.0, 2.0, 3.0), vec3(4.0, 5.0, 6.0), vec3(7.0, 8.0, 9.0)",
     "mat3(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0)"},
    {"construct mat2 1.0, vec2(2.0, 3.0), 4.0", "mat2(1.0, 2.0, 3.0, 4.0)"},
    {"convert float -3", "-3.0"},
    {"convert float 4294967295u", "4.2949673e9"},
    {"convert float true", "1.0"},
    {"convert int -2.75", "-2"},
    {"convert int 2147483648.0", "undefined"},
    {"convert int nan#2143289344", "undefined"},
    {"convert uint 3.75", "3u"},
    {"convert uint -1.0", "undefined"},
    {"convert uint -1", "4294967295u"},
    {"convert int 4294967295u", "-1"},
    {"convert int true", "1"},
    {"convert bool 0.5", "true"},
    {"convert bool -0.0", "false"},
    {"convert bool 2", "true"},
    {"convert vec2 ivec2(1, -2)", "vec2(1.0, -2.0)"},
    {"convert ivec2 vec2(1.9, -2.9)", "ivec2(1, -2)"},
    {"convert vec2 vec4(1.0, 2.0, 3.0, 4.0)", "vec2(1.0, 2.0)"},
    {"convert mat2 mat3(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0)", "mat2(1.0, 2.0, 4.0, 5.0)"},
    {"convert mat3 mat2(1.0, 2.0, 3.0, 4.0)", "mat3(1.0, 2.0, 0.0, 3.0, 4.0, 0.0, 0.0, 0.0, 1.0)"},
    {"swizzle vec2 .zx vec3(1.0, 2.0, 3.0)", "vec2(3.0, 1.0)"},
    {"swizzle float .w vec4(1.0, 2.0, 3.0, 4.0)", "4.0"},
    {"swizzle vec4 .xxxx 2.0", "vec4(2.0, 2.0, 2.0, 2.0)"},
    {"index float vec3(1.0, 2.0, 3.0), 2", "3.0"},
    {"index float vec3(1.0, 2.0, 3.0), 3", "undefined"},
    {"index float vec3(1.0, 2.0, 3.0), -1", "undefined"},
    {"index vec2 mat2(1.0, 2.0, 3.0, 4.0), 1u", "vec2(3.0, 4.0)"},
    {"index vec2 mat2(1.0, 2.0, 3.0, 4.0), 2", "undefined"},
    /* trigonometry */
    {"radians float 180.0", "3.1415927"},
    {"radians vec2 vec2(0.0, 45.0)", "vec2(0.0, 0.7853982)"},
    {"degrees float 1.0", "57.29578"},
    {"sin float 0.5", "0.47942555"},
    {"cos float 0.5", "0.87758255"},
    {"cos float 1.5707964", "0.0"},
    {"cos float 1.5707962", "7.54979e-8"},
    {"sin float -3.1415927", "0.0"},
    {"sin float -1.5707964", "-1.0"},
    {"tan float 1.0", "1.5574077"},
    {"asin float 0.5", "0.5235988"},
    {"asin float 1.5", "undefined"},
    {"acos float 0.5", "1.0471976"},
    {"acos float -1.5", "undefined"},
    {"atan float 2.0", "1.1071488"},
    {"atan2 float 1.0, -1.0", "2.3561945"},
    {"atan2 float 0.0, -1.0", "3.1415927"},
    {"atan2 float 0.0, 0.0", "undefined"},
    {"sinh float 1.0", "1.1752012"},
    {"cosh float 1.0", "1.5430807"},
    {"tanh float 1.0", "0.7615942"},
    {"asinh float 1.0", "0.8813736"},
    {"acosh float 2.0", "1.316958"},
    {"acosh float 0.5", "undefined"},
    {"atanh float 0.5", "0.54930615"},
    {"atanh float 1.0", "undefined"},
    /* exponentials */
    {"pow float 2.0, 0.5", "1.4142135"},
    {"pow vec2 vec2(0.5, 3.0), vec2(3.0, 2.0)", "vec2(0.125, 9.0)"},
    {"pow float 0.0, 2.0", "0.0"},
    {"pow float 0.0, 0.0", "undefined"},
    {"pow float -2.0, 2.0", "undefined"},
    {"exp float 1.0", "2.7182817"},
    {"exp float 100.0", "inf"},
    {"log float 10.0", "2.3025851"},
    {"log float 0.0", "undefined"},
    {"exp2 float 0.5", "1.4142135"},
    {"log2 float 10.0", "3.321928"},
    {"log2 float -1.0", "undefined"},
    {"sqrt float 2.0", "1.4142135"},
    {"sqrt float -1.0", "undefined"},
    {"inversesqrt float 2.0", "0.70710677"},
    {"inversesqrt float 0.0", "undefined"},
    /* common functions */
    {"abs float -1.5", "1.5"},
    {"abs int -3", "3"},
    {"sign vec3 vec3(-2.0, 0.0, 3.0)", "vec3(-1.0, 0.0, 1.0)"},
    {"sign int -7", "-1"},
    {"floor vec2 vec2(-1.5, 1.5)", "vec2(-2.0, 1.0)"},
    {"trunc vec2 vec2(-1.5, 1.5)", "vec2(-1.0, 1.0)"},
    {"round vec4 vec4(0.5, 1.5, -0.5, 2.4)", "vec4(0.0, 2.0, -0.0, 2.0)"},
    {"ceil vec2 vec2(-1.5, 1.5)", "vec2(-1.0, 2.0)"},
    {"fract vec2 vec2(-1.25, 1.25)", "vec2(0.75, 0.25)"},
    {"mod float 5.5, 2.0", "1.5"},
    {"mod float -1.0, 3.0", "2.0"},
    {"mod vec2 vec2(5.5, 5.5), vec2(-2.0, 4.0)", "vec2(-0.5, 1.5)"},
    {"min vec2 vec2(1.0, 3.0), 2.0", "vec2(1.0, 2.0)"},
    {"min int -1, 1", "-1"},
    {"min uint 4294967295u, 1u", "1u"},
    {"max float -1.0, 1.0", "1.0"},
    {"max int -1, 1", "1"},
    {"max uint 4294967295u, 1u", "4294967295u"},
    {"clamp vec3 vec3(-1.0, 0.5, 2.0), 0.0, 1.0", "vec3(0.0, 0.5, 1.0)"},
    {"clamp vec2 vec2(-1.0, 5.0), vec2(0.0, 1.0), vec2(1.0, 4.0)", "vec2(0.0, 4.0)"},
    {"clamp float 0.5, 1.0, 0.0", "0.0"}, /* min(max(x, low), high) */
    {"clamp int 7, -1, 5", "5"},
    {"clamp uint 0u, 2u, 4294967295u", "2u"},
    {"mix float 2.0, 4.0, 0.25", "2.5"},
    {"mix vec2 vec2(0.0, 1.0), vec2(2.0, 3.0), 0.5", "vec2(1.0, 2.0)"},
    {"mix vec2 vec2(0.0, 0.0), vec2(1.0, 1.0), vec2(-1.0, 2.0)", "vec2(-1.0, 2.0)"},
    {"step float 0.5, 0.5", "1.0"},
    {"step vec2 0.5, vec2(0.4, 0.6)", "vec2(0.0, 1.0)"},
    {"step vec2 vec2(0.0, 1.0), vec2(0.5, 0.5)", "vec2(1.0, 0.0)"},
    {"smoothstep float 0.0, 2.0, 0.5", "0.15625"},
    {"smoothstep vec2 0.0, 1.0, vec2(-1.0, 2.0)", "vec2(0.0, 1.0)"},
    /* edges the wrong way round: as the formula says */
    {"smoothstep float 1.0, 0.0, 0.25", "0.84375"},
    {"smoothstep float 1.0, 1.0, 1.0", "undefined"},
    {"isnan bool nan#2143289344", "true"},
    {"isnan bool inf", "false"},
    {"isinf bool -inf", "true"},
    {"isinf bool 1.0", "false"},
    {"isnan bvec2 vec2(nan#2143289344, 1.0)", "bvec2(true, false)"},
    {"isinf bvec3 vec3(1.0, inf, -inf)", "bvec3(false, true, true)"},
    /* relations of vectors */
    {"lessThan bvec3 vec3(1.0, 2.0, 3.0), vec3(2.0, 2.0, 2.0)", "bvec3(true, false, false)"},
    {"lessThan bvec2 vec2(nan#2143289344, -0.0), vec2(1.0, 0.0)", "bvec2(false, false)"},
    {"lessThan bvec2 ivec2(-1, 1), ivec2(1, 1)", "bvec2(true, false)"},
    {"lessThan bvec2 uvec2(4294967295u, 0u), uvec2(1u, 1u)", "bvec2(false, true)"},
    {"lessThanEqual bvec4 vec4(1.0, 2.0, 3.0, -1.0), vec4(2.0, 2.0, 2.0, 0.0)",
     "bvec4(true, true, false, true)"},
    {"lessThanEqual bvec3 uvec3(1u, 2u, 3u), uvec3(2u, 2u, 2u)", "bvec3(true, true, false)"},
    {"greaterThan bvec2 vec2(3.0, 2.0), vec2(2.0, 2.0)", "bvec2(true, false)"},
    {"greaterThan bvec4 ivec4(0, -1, 5, 2), ivec4(-1, 0, 5, 1)", "bvec4(true, false, false, true)"},
    {"greaterThanEqual bvec2 vec2(3.0, 2.0), vec2(2.0, 2.0)", "bvec2(true, true)"},
    {"greaterThanEqual bvec2 uvec2(4294967295u, 0u), uvec2(1u, 1u)", "bvec2(true, false)"},
    {"equal bvec2 vec2(0.0, nan#2143289344), vec2(-0.0, nan#2143289344)", "bvec2(true, false)"},
    {"equal bvec3 ivec3(1, 2, -3), ivec3(1, 0, -3)", "bvec3(true, false, true)"},
    {"equal bvec2 bvec2(true, false), bvec2(true, true)", "bvec2(true, false)"},
    {"notEqual bvec2 vec2(0.0, nan#2143289344), vec2(-0.0, nan#2143289344)", "bvec2(false, true)"},
    {"notEqual bvec4 uvec4(1u, 2u, 3u, 4u), uvec4(1u, 2u, 3u, 5u)",
     "bvec4(false, false, false, true)"},
    {"notEqual bvec2 bvec2(true, false), bvec2(true, true)", "bvec2(false, true)"},
    {"any bool bvec3(false, false, true)", "true"},
    {"any bool bvec4(false, false, false, false)", "false"},
    {"all bool bvec2(true, true)", "true"},
    {"all bool bvec4(true, true, true, false)", "false"},
    {"notEach bvec3 bvec3(true, false, true)", "bvec3(false, true, false)"},
    {"choose vec3 vec3(1.0, 2.0, 3.0), vec3(4.0, 5.0, 6.0), bvec3(true, false, true)",
     "vec3(4.0, 2.0, 6.0)"},
    {"choose vec2 vec2(nan#2143289344, 1.0), vec2(3.0, inf), bvec2(true, false)", "vec2(3.0, 1.0)"},
    {"eq bool bvec2(true, false), bvec2(true, false)", "true"},
    {"ne bool uvec3(1u, 2u, 3u), uvec3(1u, 2u, 4u)", "true"},
    {"index bool bvec3(false, true, false), 1", "true"},
    {"swizzle bvec2 .zy bvec3(false, true, false)", "bvec2(false, true)"},
    {"construct uvec4 uvec3(1u, 2u, 3u), 4u", "uvec4(1u, 2u, 3u, 4u)"},
    {"construct bvec3 true", "bvec3(true, true, true)"},
    {"convert vec3 bvec3(true, false, true)", "vec3(1.0, 0.0, 1.0)"},
    {"convert uvec3 vec3(1.5, 2.0, -0.5)", "uvec3(1u, 2u, 0u)"},
    {"convert bvec4 vec4(0.0, 0.5, -0.0, 2.0)", "bvec4(false, true, false, true)"},
    {"add uvec3 uvec3(4294967295u, 1u, 2u), 1u", "uvec3(0u, 2u, 3u)"},
    {"and uvec3 uvec3(255u, 256u, 511u), 255u", "uvec3(255u, 0u, 255u)"},
    {"shr uvec2 uvec2(256u, 4294967295u), ivec2(8, 31)", "uvec2(1u, 1u)"},
    {"mul ivec4 3, ivec4(1, -2, 3, 0)", "ivec4(3, -6, 9, 0)"},
    {"floatBitsToInt ivec3 vec3(1.0, 0.0, -1.0)", "ivec3(1065353216, 0, -1082130432)"},
    {"floatBitsToUint uvec4 vec4(1.0, 0.0, -1.0, 2.0)",
     "uvec4(1065353216u, 0u, 3212836864u, 1073741824u)"},
    {"uintBitsToFloat vec3 uvec3(1065353216u, 0u, 1073741824u)", "vec3(1.0, 0.0, 2.0)"},
    {"floatBitsToInt int -1.0", "-1082130432"}, /* 0xbf800000 */
    {"floatBitsToInt ivec2 vec2(1.0, 0.0)", "ivec2(1065353216, 0)"},
    {"floatBitsToUint uint -1.0", "3212836864u"},
    {"intBitsToFloat float 1065353216", "1.0"},
    {"intBitsToFloat vec2 ivec2(0, 1073741824)", "vec2(0.0, 2.0)"},
    {"uintBitsToFloat float 3212836864u", "-1.0"},
    /* geometry */
    {"length float -2.0", "2.0"},
    {"length float vec3(1.0, 2.0, 3.0)", "3.7416575"},
    {"distance float vec2(1.0, 2.0), vec2(4.0, 6.0)", "5.0"},
    {"dot float vec3(1.0, 2.0, 3.0), vec3(4.0, -5.0, 6.0)", "12.0"},
    {"cross vec3 vec3(1.0, 2.0, 3.0), vec3(4.0, 5.0, 6.0)", "vec3(-3.0, 6.0, -3.0)"},
    {"normalize vec3 vec3(1.0, 2.0, -2.0)", "vec3(0.33333334, 0.6666667, -0.6666667)"},
    {"normalize vec3 vec3(0.0, 0.0, 0.0)", "undefined"},
    {"faceforward vec2 vec2(1.0, 2.0), vec2(0.0, -1.0), vec2(0.0, 1.0)", "vec2(1.0, 2.0)"},
    {"faceforward vec2 vec2(1.0, 2.0), vec2(0.0, 1.0), vec2(0.0, 1.0)", "vec2(-1.0, -2.0)"},
    {"reflect vec2 vec2(0.5, -1.0), vec2(0.0, 1.0)", "vec2(0.5, 1.0)"},
    {"refract vec2 vec2(0.6, -0.8), vec2(0.0, 1.0), 0.5", "vec2(0.3, -0.9539392)"},
    {"refract vec2 vec2(0.8, -0.6), vec2(0.0, 1.0), 1.5", "vec2(0.0, 0.0)"}, /* total reflection */
    /* matrices */
    {"matrixCompMult mat2 mat2(1.0, 2.0, 3.0, 4.0), mat2(5.0, 6.0, 7.0, 8.0)",
     "mat2(5.0, 12.0, 21.0, 32.0)"},
    {"transpose mat2 mat2(1.0, 2.0, 3.0, 4.0)", "mat2(1.0, 3.0, 2.0, 4.0)"},
    {"transpose mat3 mat3(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0)",
     "mat3(1.0, 4.0, 7.0, 2.0, 5.0, 8.0, 3.0, 6.0, 9.0)"},
    {"determinant float mat2(1.0, 2.0, 3.0, 4.0)", "-2.0"},
    {"determinant float mat3(2.0, 0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 4.0)", "24.0"},
    {"determinant float mat3(0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)", "-1.0"},
    {"determinant float mat2(1.0, 2.0, 2.0, 4.0)", "0.0"},
    {"inverse mat2 mat2(1.0, 2.0, 3.0, 4.0)", "mat2(-2.0, 1.0, 1.5, -0.5)"},
    {"inverse mat2 mat2(1.0, 2.0, 2.0, 4.0)", "undefined"},
    {"inverse mat3 mat3(0.0, 1.0, 0.0, 0.0, 0.0, 2.0, 4.0, 0.0, 0.0)",
     "mat3(0.0, 0.0, 0.25, 1.0, 0.0, 0.0, 0.0, 0.5, 0.0)"},
    {"inverse mat4 mat4(1.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 4.0, 0.0, 3.0, 6.0, 8.0, "
     "1.0)",
     "mat4(1.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.25, 0.0, -3.0, -3.0, -2.0, 1.0)"},
};

static bool seen[IR_NUM_OPS];

/* The value of the node as the text form writes constants. */
static const char *evaluate(struct ir_graph *graph, const char *node)
{
    struct text text;
    ir_ref *roots;
    uint32_t num_roots;
    text_init(&text, graph->arena);
    text_fmt(&text, "%%r = %s\nreturn %%r\n", node);
    if (ir_text_read(graph, text_cstr(&text), &roots, &num_roots))
        return "no IR";
    seen[ir_get(graph, roots[0])->op] = true;
    struct ir_value value;
    if (!ir_eval(graph, roots[0], NULL, graph->arena, &value))
        return "undefined";
    ir_ref constant = ir_const(graph, &value);
    text_init(&text, graph->arena);
    ir_print(graph, &constant, 1, &text);
    text.len--; /* the line break */
    return text_cstr(&text) + strlen("return ");
}

static void test_values(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct mem mem;
        struct arena arena;
        struct strpool strings;
        struct ir_graph graph;
        mem_init(&mem, NULL, NULL);
        arena_init(&arena, &mem);
        strpool_init(&strings, &arena, NULL);
        ir_graph_init(&graph, &arena, &strings);
        graph.no_fold = true;
        if (!REQUIRE_STR(evaluate(&graph, cases[i].node), cases[i].value))
            printf("    in %s\n", cases[i].node);
        arena_finish(&arena);
    }
}

/* The answer is a constant, whatever the graph folds. */
static void test_known(void)
{
    for (int no_fold = 0; no_fold < 2; no_fold++) {
        struct mem mem;
        struct arena arena;
        struct strpool strings;
        struct ir_graph graph;
        mem_init(&mem, NULL, NULL);
        arena_init(&arena, &mem);
        strpool_init(&strings, &arena, NULL);
        ir_graph_init(&graph, &arena, &strings);
        graph.no_fold = no_fold;
        ir_ref a = ir_build(&graph, IR_UNIFORM, IR_TYPE_FLOAT, 0, NULL, 0);
        ir_ref b = ir_build(&graph, IR_UNIFORM, IR_TYPE_FLOAT, 1, NULL, 0);
        ir_ref same = ir_op2(&graph, IR_EQ, a, a), other = ir_op2(&graph, IR_EQ, a, b);
        REQUIRE_EQ(ir_op1(&graph, IR_KNOWN, same), ir_const_bool(&graph, !no_fold));
        REQUIRE_EQ(ir_op1(&graph, IR_KNOWN, other), ir_const_bool(&graph, false));
        arena_finish(&arena);
    }
}

static void test_coverage(void)
{
    for (unsigned op = 0; op < IR_NUM_OPS; op++) {
        bool foldable = (ir_op_info((enum ir_op)op)->flags & OP_PURE) && op != IR_CONST
                        && op != IR_MEMBER && op != IR_KNOWN; /* test_known */
        if (!REQUIRE_EQ(seen[op], foldable))
            printf("    op %s\n", ir_op_info((enum ir_op)op)->text);
    }
}

/* The answers of op_types.c to operand types that do not fit, or fit in more than one way. */
static const struct {
    uint8_t op;
    ir_type_id result, args[3];
} typings[] = {
    {IR_ADD, IR_TYPE_VOID, {IR_TYPE_FLOAT, IR_TYPE_INT}},
    {IR_ADD, IR_TYPE_VOID, {IR_TYPE_VEC2, IR_TYPE_VEC3}},
    {IR_ADD, IR_TYPE_VOID, {IR_TYPE_BOOL, IR_TYPE_BOOL}},
    {IR_ADD, IR_TYPE_MAT3, {IR_TYPE_FLOAT, IR_TYPE_MAT3}},
    {IR_ADD, IR_TYPE_VOID, {IR_TYPE_MAT3, IR_TYPE_VEC3}},
    {IR_MUL, IR_TYPE_VEC3, {IR_TYPE_MAT3, IR_TYPE_VEC3}},
    {IR_MUL, IR_TYPE_VEC3, {IR_TYPE_VEC3, IR_TYPE_MAT3}},
    {IR_MUL, IR_TYPE_VOID, {IR_TYPE_MAT3, IR_TYPE_VEC4}},
    {IR_MUL, IR_TYPE_VOID, {IR_TYPE_MAT3, IR_TYPE_MAT4}},
    {IR_DIV, IR_TYPE_VOID, {IR_TYPE_VEC3, IR_TYPE_MAT3}},
    {IR_NEG, IR_TYPE_VOID, {IR_TYPE_BOOL}},
    {IR_SIN, IR_TYPE_VOID, {IR_TYPE_INT}},
    {IR_SIN, IR_TYPE_VOID, {IR_TYPE_MAT2}},
    {IR_ABS, IR_TYPE_VOID, {IR_TYPE_UINT}},
    {IR_ABS, IR_TYPE_IVEC2, {IR_TYPE_IVEC2}},
    {IR_MIN, IR_TYPE_VOID, {IR_TYPE_FLOAT, IR_TYPE_VEC2}},
    {IR_MIN, IR_TYPE_UINT, {IR_TYPE_UINT, IR_TYPE_UINT}},
    {IR_CLAMP, IR_TYPE_VOID, {IR_TYPE_VEC2, IR_TYPE_VEC2, IR_TYPE_FLOAT}},
    {IR_MIX, IR_TYPE_VEC2, {IR_TYPE_VEC2, IR_TYPE_VEC2, IR_TYPE_FLOAT}},
    {IR_MIX, IR_TYPE_VOID, {IR_TYPE_VEC2, IR_TYPE_FLOAT, IR_TYPE_FLOAT}},
    {IR_STEP, IR_TYPE_VEC3, {IR_TYPE_FLOAT, IR_TYPE_VEC3}},
    {IR_STEP, IR_TYPE_VOID, {IR_TYPE_VEC3, IR_TYPE_FLOAT}},
    {IR_SMOOTHSTEP, IR_TYPE_VOID, {IR_TYPE_FLOAT, IR_TYPE_VEC3, IR_TYPE_VEC3}},
    {IR_SMOOTHSTEP, IR_TYPE_VEC3, {IR_TYPE_FLOAT, IR_TYPE_FLOAT, IR_TYPE_VEC3}},
    {IR_REFRACT, IR_TYPE_VOID, {IR_TYPE_VEC3, IR_TYPE_VEC3, IR_TYPE_VEC3}},
    {IR_REFRACT, IR_TYPE_VEC3, {IR_TYPE_VEC3, IR_TYPE_VEC3, IR_TYPE_FLOAT}},
    {IR_DOT, IR_TYPE_FLOAT, {IR_TYPE_VEC4, IR_TYPE_VEC4}},
    {IR_DOT, IR_TYPE_VOID, {IR_TYPE_VEC4, IR_TYPE_VEC3}},
    {IR_CROSS, IR_TYPE_VOID, {IR_TYPE_VEC2, IR_TYPE_VEC2}},
    {IR_LT, IR_TYPE_VOID, {IR_TYPE_VEC2, IR_TYPE_VEC2}},
    {IR_EQ, IR_TYPE_BOOL, {IR_TYPE_MAT4, IR_TYPE_MAT4}},
    {IR_EQ, IR_TYPE_VOID, {IR_TYPE_SAMPLER, IR_TYPE_SAMPLER}},
    {IR_LAND, IR_TYPE_VOID, {IR_TYPE_BOOL, IR_TYPE_INT}},
    {IR_SHL, IR_TYPE_INT, {IR_TYPE_INT, IR_TYPE_UINT}},
    {IR_SHL, IR_TYPE_IVEC2, {IR_TYPE_IVEC2, IR_TYPE_INT}},
    {IR_AND, IR_TYPE_VOID, {IR_TYPE_INT, IR_TYPE_UINT}},
    {IR_AND, IR_TYPE_UVEC3, {IR_TYPE_UVEC3, IR_TYPE_UINT}},
    {IR_AND, IR_TYPE_UVEC3, {IR_TYPE_UINT, IR_TYPE_UVEC3}},
    {IR_AND, IR_TYPE_VOID, {IR_TYPE_UVEC3, IR_TYPE_UVEC2}},
    {IR_AND, IR_TYPE_VOID, {IR_TYPE_UVEC3, IR_TYPE_IVEC3}},
    {IR_AND, IR_TYPE_VOID, {IR_TYPE_BVEC3, IR_TYPE_BVEC3}},
    {IR_SHL, IR_TYPE_VOID, {IR_TYPE_UINT, IR_TYPE_UVEC2}},
    {IR_SHL, IR_TYPE_UVEC2, {IR_TYPE_UVEC2, IR_TYPE_IVEC2}},
    {IR_ADD, IR_TYPE_VOID, {IR_TYPE_BVEC2, IR_TYPE_BVEC2}},
    {IR_MUL, IR_TYPE_VOID, {IR_TYPE_UVEC3, IR_TYPE_MAT3}},
    {IR_LESS, IR_TYPE_BVEC3, {IR_TYPE_UVEC3, IR_TYPE_UVEC3}},
    {IR_LESS, IR_TYPE_VOID, {IR_TYPE_BVEC3, IR_TYPE_BVEC3}},
    {IR_LESS, IR_TYPE_VOID, {IR_TYPE_FLOAT, IR_TYPE_FLOAT}},
    {IR_LESS, IR_TYPE_VOID, {IR_TYPE_MAT2, IR_TYPE_MAT2}},
    {IR_LESS, IR_TYPE_VOID, {IR_TYPE_VEC3, IR_TYPE_IVEC3}},
    {IR_EQUAL, IR_TYPE_BVEC3, {IR_TYPE_BVEC3, IR_TYPE_BVEC3}},
    {IR_EQUAL, IR_TYPE_VOID, {IR_TYPE_MAT2, IR_TYPE_MAT2}},
    {IR_ANY, IR_TYPE_BOOL, {IR_TYPE_BVEC4}},
    {IR_ANY, IR_TYPE_VOID, {IR_TYPE_BOOL}},
    {IR_ALL, IR_TYPE_VOID, {IR_TYPE_VEC2}},
    {IR_NOT_EACH, IR_TYPE_VOID, {IR_TYPE_BOOL}},
    {IR_NOT_EACH, IR_TYPE_BVEC2, {IR_TYPE_BVEC2}},
    {IR_CHOOSE, IR_TYPE_VEC3, {IR_TYPE_VEC3, IR_TYPE_VEC3, IR_TYPE_BVEC3}},
    {IR_CHOOSE, IR_TYPE_VOID, {IR_TYPE_VEC3, IR_TYPE_VEC3, IR_TYPE_BVEC2}},
    {IR_CHOOSE, IR_TYPE_VOID, {IR_TYPE_IVEC3, IR_TYPE_IVEC3, IR_TYPE_BVEC3}},
    {IR_CHOOSE, IR_TYPE_VOID, {IR_TYPE_FLOAT, IR_TYPE_FLOAT, IR_TYPE_BOOL}},
    {IR_ISNAN, IR_TYPE_BVEC3, {IR_TYPE_VEC3}},
    {IR_ISNAN, IR_TYPE_VOID, {IR_TYPE_MAT3}},
    {IR_SELECT, IR_TYPE_BSDF, {IR_TYPE_BOOL, IR_TYPE_BSDF, IR_TYPE_BSDF}},
    {IR_SELECT, IR_TYPE_VOID, {IR_TYPE_INT, IR_TYPE_FLOAT, IR_TYPE_FLOAT}},
    {IR_DETERMINANT, IR_TYPE_FLOAT, {IR_TYPE_MAT4}},
    {IR_INVERSE, IR_TYPE_VOID, {IR_TYPE_VEC4}},
    {IR_ISNAN, IR_TYPE_VOID, {IR_TYPE_INT}},
    {IR_TEX, IR_TYPE_VEC4, {IR_TYPE_SAMPLER, IR_TYPE_VEC2}},
    {IR_TEX, IR_TYPE_VOID, {IR_TYPE_SAMPLER, IR_TYPE_VEC3}},
    {IR_TEX_SIZE, IR_TYPE_IVEC2, {IR_TYPE_SAMPLER, IR_TYPE_INT}},
    {IR_UNIFORM, IR_TYPE_VOID, {IR_TYPE_VOID}},
    {IR_CONVERT, IR_TYPE_VOID, {IR_TYPE_FLOAT}},
};

static void test_typing(void)
{
    for (size_t i = 0; i < sizeof typings / sizeof *typings; i++) {
        enum ir_op op = (enum ir_op)typings[i].op;
        int8_t arity = ir_op_info(op)->arity;
        if (!REQUIRE_EQ(ir_op_result(op, typings[i].args, (unsigned)arity), typings[i].result))
            printf("    typing %zu, op %s\n", i, ir_op_info(op)->text);
    }
    REQUIRE_EQ(ir_op_result(IR_ADD, (ir_type_id[]){IR_TYPE_FLOAT}, 1), IR_TYPE_VOID);
    REQUIRE_EQ(ir_type_vector(IR_TYPE_FLOAT, 1), IR_TYPE_FLOAT);
    REQUIRE_EQ(ir_type_vector(IR_TYPE_FLOAT, 4), IR_TYPE_VEC4);
    REQUIRE_EQ(ir_type_vector(IR_TYPE_FLOAT, 5), IR_TYPE_VOID);
    REQUIRE_EQ(ir_type_vector(IR_TYPE_INT, 2), IR_TYPE_IVEC2);
    REQUIRE_EQ(ir_type_vector(IR_TYPE_BOOL, 2), IR_TYPE_BVEC2);
    REQUIRE_EQ(ir_type_vector(IR_TYPE_UINT, 4), IR_TYPE_UVEC4);
    REQUIRE_EQ(ir_type_vector(IR_TYPE_STRING, 2), IR_TYPE_VOID);
    REQUIRE_EQ(ir_type_vector(IR_TYPE_VEC2, 1), IR_TYPE_VOID);
}

/* Functions of one number that are undefined for more than single ones: IR_NODE_PARTIAL. */
static void test_partial(void)
{
    static const float numbers[] = {-2, -1.5f, -0.5f, 0.5f, 1.5f, 2};
    struct mem mem;
    struct arena arena;
    struct ir_graph graph;
    mem_init(&mem, NULL, NULL);
    arena_init(&arena, &mem);
    ir_graph_init(&graph, &arena, NULL);
    ir_ref any = ir_build(&graph, IR_UNIFORM, IR_TYPE_FLOAT, 0, NULL, 0);
    for (unsigned op = 0; op < IR_NUM_OPS; op++) {
        const struct ir_op_info *info = ir_op_info((enum ir_op)op);
        unsigned num_undefined = 0;
        if (info->rule != IR_RULE_SAME || info->arity != 1)
            continue;
        for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
            struct ir_value in = ir_value_float(numbers[i]), out;
            num_undefined += !ir_eval_op((enum ir_op)op, IR_TYPE_FLOAT, 0, &in, 1, &out);
        }
        if (num_undefined == sizeof numbers / sizeof *numbers) /* not to be computed */
            continue;
        const struct ir_node *node = ir_get(&graph, ir_op1(&graph, (enum ir_op)op, any));
        bool is_partial = node->flags & IR_NODE_PARTIAL;
        if (node->op == op && !REQUIRE_EQ(is_partial, num_undefined > 0))
            printf("    %s\n", info->text);
    }
    arena_finish(&arena);
}

int main(void)
{
    test_values();
    test_coverage();
    test_known();
    test_typing();
    test_partial();
    return test_report("ir_fold");
}
