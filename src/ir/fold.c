// SPDX-License-Identifier: Apache-2.0
/*
 * fold: the arithmetic of constants.
 *
 * Componentwise ops have one kernel per op and scalar type (kernels.def), which runs on each
 * component; scalars are spread. Each op over whole vectors, and each constructor or part, has a
 * function.
 */
#include "ir/ir_priv.h"

#include <math.h>

#define PI 3.14159265358979323846

static float clamp_float(float x, float low, float high)
{
    float raised = x < low ? low : x;
    return high < raised ? high : raised;
}

static int32_t clamp_int(int32_t x, int32_t low, int32_t high)
{
    int32_t raised = x < low ? low : x;
    return high < raised ? high : raised;
}

static uint32_t clamp_uint(uint32_t x, uint32_t low, uint32_t high)
{
    uint32_t raised = x < low ? low : x;
    return high < raised ? high : raised;
}

static float hermite_step(float low, float high, float x)
{
    float t = clamp_float((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/*
 * The sine of x + `quarters` quarter turns. A float that is nearest to a number of quarter turns
 * stands for it: the cosine of 90 degrees is 0, not the error of the float.
 */
static float sine(float x, unsigned quarters)
{
    static const float exact[] = {0.0f, 1.0f, 0.0f, -1.0f};
    enum { MOST = 1024 }; /* more of them lie nearer than the floats around them */
    double turns = round((double)x / (PI / 2.0));
    if (turns != 0.0 && fabs(turns) < MOST && (float)(turns * (PI / 2.0)) == x)
        return exact[((int)turns + (int)quarters) & 3];
    return (float)(quarters ? cos((double)x) : sin((double)x));
}

/* w: three operand words, 0 if the op has fewer. */
typedef bool kernel_fn(const union ir_word *w, union ir_word *out);

#define KERNEL(name, T, member, defined, assignment) \
    static bool name(const union ir_word *w, union ir_word *out) \
    { \
        const T a = w[0].member, b = w[1].member, c = w[2].member; \
        const uint32_t ua = w[0].u, ub = w[1].u; \
        (void)a, (void)b, (void)c, (void)ua, (void)ub; \
        if (!(defined)) \
            return false; \
        assignment; \
        return true; \
    }
#define FLOAT(ID, defined, value) KERNEL(float_##ID, float, f, defined, out->f = (value))
#define FLOAT_TEST(ID, value) KERNEL(float_##ID, float, f, 1, out->u = (value) ? 1u : 0u)
#define INT(ID, defined, value) KERNEL(int_##ID, int32_t, i, defined, out->u = (value))
#define INT_TEST(ID, value) KERNEL(int_##ID, int32_t, i, 1, out->u = (value) ? 1u : 0u)
#define UINT(ID, defined, value) KERNEL(uint_##ID, uint32_t, u, defined, out->u = (value))
#define UINT_TEST(ID, value) KERNEL(uint_##ID, uint32_t, u, 1, out->u = (value) ? 1u : 0u)
#define BOOL(ID, value) KERNEL(bool_##ID, uint32_t, u, 1, out->u = (value) ? 1u : 0u)
#include "ir/kernels.def"
#undef FLOAT
#undef FLOAT_TEST
#undef INT
#undef INT_TEST
#undef UINT
#undef UINT_TEST
#undef BOOL

/* Columns: bool, int, uint, float, in the order of their types. */
static kernel_fn *const kernels[IR_NUM_OPS][4] = {
#define BOOL(ID, value) [IR_##ID][0] = bool_##ID,
#define INT(ID, defined, value) [IR_##ID][1] = int_##ID,
#define INT_TEST(ID, value) [IR_##ID][1] = int_##ID,
#define UINT(ID, defined, value) [IR_##ID][2] = uint_##ID,
#define UINT_TEST(ID, value) [IR_##ID][2] = uint_##ID,
#define FLOAT(ID, defined, value) [IR_##ID][3] = float_##ID,
#define FLOAT_TEST(ID, value) [IR_##ID][3] = float_##ID,
#include "ir/kernels.def"
};

static unsigned components_of(const struct ir_value *value)
{
    return ir_type_info(value->type)->components;
}

static ir_type_id scalar_of(const struct ir_value *value)
{
    return ir_type_info(value->type)->scalar;
}

static bool eval_components(enum ir_op op, const struct ir_value *args, unsigned num_args,
                            struct ir_value *out)
{
    ir_type_id scalar = scalar_of(&args[0]);
    if (scalar < IR_TYPE_BOOL || scalar > IR_TYPE_FLOAT || num_args > 3)
        return false;
    kernel_fn *kernel = kernels[op][scalar - IR_TYPE_BOOL];
    if (!kernel)
        return false;
    unsigned step[3] = {0};
    for (unsigned k = 0; k < num_args; k++)
        step[k] = components_of(&args[k]) > 1;
    unsigned count = components_of(out);
    for (unsigned i = 0; i < count; i++) {
        union ir_word w[3] = {{.u = 0}};
        for (unsigned k = 0; k < num_args; k++)
            w[k] = args[k].w[i * step[k]];
        if (!kernel(w, &out->w[i]))
            return false;
    }
    return true;
}

/* Whole vectors and matrices: w[column * rows + row] */

static float dot(const union ir_word *a, const union ir_word *b, unsigned n)
{
    float sum = a[0].f * b[0].f;
    for (unsigned i = 1; i < n; i++)
        sum += a[i].f * b[i].f;
    return sum;
}

static bool eval_dot(const struct ir_value *args, struct ir_value *out)
{
    out->w[0].f = dot(args[0].w, args[1].w, components_of(&args[0]));
    return true;
}

static bool eval_length(const struct ir_value *args, struct ir_value *out)
{
    out->w[0].f = sqrtf(dot(args[0].w, args[0].w, components_of(&args[0])));
    return true;
}

static bool eval_distance(const struct ir_value *args, struct ir_value *out)
{
    struct ir_value difference = args[0];
    for (unsigned i = 0; i < components_of(&args[0]); i++)
        difference.w[i].f -= args[1].w[i].f;
    return eval_length(&difference, out);
}

static bool eval_cross(const struct ir_value *args, struct ir_value *out)
{
    for (unsigned i = 0; i < 3; i++) {
        unsigned j = (i + 1) % 3, k = (i + 2) % 3;
        out->w[i].f = args[0].w[j].f * args[1].w[k].f - args[1].w[j].f * args[0].w[k].f;
    }
    return true;
}

static bool eval_normalize(const struct ir_value *args, struct ir_value *out)
{
    unsigned n = components_of(&args[0]);
    float length = sqrtf(dot(args[0].w, args[0].w, n));
    if (!(length > 0.0f))
        return false;
    for (unsigned i = 0; i < n; i++)
        out->w[i].f = args[0].w[i].f / length;
    return true;
}

static bool eval_faceforward(const struct ir_value *args, struct ir_value *out)
{
    unsigned n = components_of(&args[0]);
    float sign = dot(args[2].w, args[1].w, n) < 0.0f ? 1.0f : -1.0f;
    for (unsigned i = 0; i < n; i++)
        out->w[i].f = sign * args[0].w[i].f;
    return true;
}

static bool eval_reflect(const struct ir_value *args, struct ir_value *out)
{
    unsigned n = components_of(&args[0]);
    float twice = 2.0f * dot(args[1].w, args[0].w, n);
    for (unsigned i = 0; i < n; i++)
        out->w[i].f = args[0].w[i].f - twice * args[1].w[i].f;
    return true;
}

static bool eval_refract(const struct ir_value *args, struct ir_value *out)
{
    unsigned n = components_of(&args[0]);
    float eta = args[2].w[0].f, cosine = dot(args[1].w, args[0].w, n);
    float k = 1.0f - eta * eta * (1.0f - cosine * cosine);
    for (unsigned i = 0; i < n; i++)
        out->w[i].f =
            k < 0.0f ? 0.0f : eta * args[0].w[i].f - (eta * cosine + sqrtf(k)) * args[1].w[i].f;
    return true;
}

/*
 * matrix·matrix, matrix·vector (a column) and vector·matrix (a row): result[c][r] = Σ a[k][r] ·
 * b[c][k].
 */
static bool eval_linear_mul(const struct ir_value *args, struct ir_value *out)
{
    bool row = !ir_type_is_matrix(args[0].type);
    unsigned n = ir_type_info(row ? args[1].type : args[0].type)->columns;
    unsigned rows = row ? 1 : n, columns = components_of(&args[1]) / n;
    for (unsigned c = 0; c < columns; c++)
        for (unsigned r = 0; r < rows; r++) {
            float sum = 0.0f;
            for (unsigned k = 0; k < n; k++)
                sum += args[0].w[k * rows + r].f * args[1].w[c * n + k].f;
            out->w[c * rows + r].f = sum;
        }
    return true;
}

static bool eval_transpose(const struct ir_value *args, struct ir_value *out)
{
    unsigned n = ir_type_info(args[0].type)->columns;
    for (unsigned c = 0; c < n; c++)
        for (unsigned r = 0; r < n; r++)
            out->w[c * n + r] = args[0].w[r * n + c];
    return true;
}

/*
 * Gauss-Jordan elimination with row pivots, in double. Returns the determinant of the n×n matrix m.
 * If no pivot is left, m is singular and the result is 0; otherwise `inverse` receives the inverse.
 */
static double invert(double m[16], double inverse[16], unsigned n)
{
    double determinant = 1.0;
    for (unsigned i = 0; i < n * n; i++)
        inverse[i] = i % (n + 1) == 0;
    for (unsigned c = 0; c < n; c++) {
        unsigned pivot = c;
        for (unsigned r = c + 1; r < n; r++)
            pivot = fabs(m[r * n + c]) > fabs(m[pivot * n + c]) ? r : pivot;
        double p = m[pivot * n + c];
        if (p == 0.0)
            return 0.0;
        determinant *= pivot == c ? p : -p;
        for (unsigned k = 0; k < n; k++) { /* swap the pivot's row up, and scale the pivot to 1 */
            double a = m[pivot * n + k], b = inverse[pivot * n + k];
            m[pivot * n + k] = m[c * n + k];
            inverse[pivot * n + k] = inverse[c * n + k];
            m[c * n + k] = a / p;
            inverse[c * n + k] = b / p;
        }
        for (unsigned r = 0; r < n; r++) {
            double factor = r == c ? 0.0 : m[r * n + c];
            for (unsigned k = 0; k < n; k++) {
                m[r * n + k] -= factor * m[c * n + k];
                inverse[r * n + k] -= factor * inverse[c * n + k];
            }
        }
    }
    return determinant;
}

/*
 * The inverse of the transpose is the transpose of the inverse, so columns can serve as rows.
 */
static double invert_value(const struct ir_value *value, double inverse[16])
{
    double m[16];
    for (unsigned i = 0; i < components_of(value); i++)
        m[i] = (double)value->w[i].f;
    return invert(m, inverse, ir_type_info(value->type)->columns);
}

static bool eval_determinant(const struct ir_value *args, struct ir_value *out)
{
    double inverse[16];
    out->w[0].f = (float)invert_value(&args[0], inverse);
    return true;
}

static bool eval_inverse(const struct ir_value *args, struct ir_value *out)
{
    double inverse[16];
    if (invert_value(&args[0], inverse) == 0.0)
        return false;
    for (unsigned i = 0; i < components_of(&args[0]); i++)
        out->w[i].f = (float)inverse[i];
    return true;
}

static bool eval_bits(const struct ir_value *args, struct ir_value *out)
{
    memcpy(out->w, args[0].w, components_of(&args[0]) * sizeof *out->w);
    return true;
}

static bool whole_equal(const struct ir_value *a, const struct ir_value *b)
{
    bool is_float = scalar_of(a) == IR_TYPE_FLOAT;
    for (unsigned i = 0; i < components_of(a); i++)
        if (is_float ? a->w[i].f != b->w[i].f : a->w[i].u != b->w[i].u)
            return false;
    return true;
}

static bool eval_eq(const struct ir_value *args, struct ir_value *out)
{
    out->w[0].u = whole_equal(&args[0], &args[1]);
    return true;
}

static bool eval_ne(const struct ir_value *args, struct ir_value *out)
{
    out->w[0].u = !whole_equal(&args[0], &args[1]);
    return true;
}

static bool eval_known(const struct ir_value *args, struct ir_value *out)
{
    out->w[0].u = args[0].w[0].u != 0;
    return true;
}

static unsigned count_true(const struct ir_value *value)
{
    unsigned n = 0;
    for (unsigned i = 0; i < components_of(value); i++)
        n += value->w[i].u != 0;
    return n;
}

static bool eval_any(const struct ir_value *args, struct ir_value *out)
{
    out->w[0].u = count_true(&args[0]) > 0;
    return true;
}

static bool eval_all(const struct ir_value *args, struct ir_value *out)
{
    out->w[0].u = count_true(&args[0]) == components_of(&args[0]);
    return true;
}

static bool eval_select(const struct ir_value *args, struct ir_value *out)
{
    *out = args[args[0].w[0].u ? 1 : 2];
    return true;
}

typedef bool whole_fn(const struct ir_value *args, struct ir_value *out);

static whole_fn *const wholes[IR_NUM_OPS] = {
    [IR_DOT] = eval_dot,
    [IR_LENGTH] = eval_length,
    [IR_DISTANCE] = eval_distance,
    [IR_CROSS] = eval_cross,
    [IR_NORMALIZE] = eval_normalize,
    [IR_FACEFORWARD] = eval_faceforward,
    [IR_REFLECT] = eval_reflect,
    [IR_REFRACT] = eval_refract,
    [IR_TRANSPOSE] = eval_transpose,
    [IR_DETERMINANT] = eval_determinant,
    [IR_INVERSE] = eval_inverse,
    [IR_FLOAT_TO_INT_BITS] = eval_bits,
    [IR_FLOAT_TO_UINT_BITS] = eval_bits,
    [IR_INT_BITS_TO_FLOAT] = eval_bits,
    [IR_UINT_BITS_TO_FLOAT] = eval_bits,
    [IR_EQ] = eval_eq,
    [IR_NE] = eval_ne,
    [IR_KNOWN] = eval_known,
    [IR_ANY] = eval_any,
    [IR_ALL] = eval_all,
    [IR_SELECT] = eval_select,
};

/* ---- Constructors and parts ---- */

/* GLSL 4.50, 5.4.1. Floats outside an integer's range are undefined. */
static bool convert_word(ir_type_id from, ir_type_id to, union ir_word w, union ir_word *out)
{
    if (from == to || (from != IR_TYPE_FLOAT && (to == IR_TYPE_INT || to == IR_TYPE_UINT))) {
        *out = w;
        return true;
    }
    switch (to) {
    case IR_TYPE_BOOL: out->u = from == IR_TYPE_FLOAT ? w.f != 0.0f : w.u != 0; return true;
    case IR_TYPE_FLOAT: out->f = from == IR_TYPE_INT ? (float)w.i : (float)w.u; return true;
    case IR_TYPE_INT:
        if (!(w.f >= -0x1p31f && w.f < 0x1p31f))
            return false;
        out->i = (int32_t)w.f;
        return true;
    case IR_TYPE_UINT:
        if (!(w.f > -1.0f && w.f < 0x1p32f))
            return false;
        out->u = (uint32_t)w.f;
        return true;
    default: return false;
    }
}

static bool is_convertible(ir_type_id scalar)
{
    return scalar >= IR_TYPE_BOOL && scalar <= IR_TYPE_FLOAT;
}

static void put_diagonal(struct ir_value *matrix, float f)
{
    unsigned n = ir_type_info(matrix->type)->columns;
    for (unsigned i = 0; i < n * n; i++)
        matrix->w[i].f = i % (n + 1) == 0 ? f : 0.0f;
}

static bool eval_convert(const struct ir_value *arg, struct ir_value *out)
{
    if (ir_type_is_matrix(out->type)) {
        unsigned from = ir_type_info(arg->type)->columns, to = ir_type_info(out->type)->columns;
        put_diagonal(out, 1.0f);
        for (unsigned c = 0; c < to && c < from; c++)
            memcpy(out->w + c * to, arg->w + c * from, (to < from ? to : from) * sizeof *out->w);
        return true;
    }
    ir_type_id from = scalar_of(arg), to = scalar_of(out);
    if (!is_convertible(from) || !is_convertible(to))
        return false;
    for (unsigned i = 0; i < components_of(out); i++)
        if (!convert_word(from, to, arg->w[i], &out->w[i]))
            return false;
    return true;
}

static bool eval_construct(const struct ir_value *args, unsigned num_args, struct ir_value *out)
{
    ir_type_id to = scalar_of(out);
    unsigned count = components_of(out), at = 0;
    for (unsigned k = 0; k < num_args; k++) {
        ir_type_id from = scalar_of(&args[k]);
        if (from != to && (!is_convertible(from) || !is_convertible(to)))
            return false;
        for (unsigned i = 0; i < components_of(&args[k]) && at < count; i++, at++)
            if (!convert_word(from, to, args[k].w[i], &out->w[at]))
                return false;
    }
    if (at == 1 && ir_type_is_matrix(out->type))
        put_diagonal(out, out->w[0].f);
    else if (at == 1)
        for (unsigned i = 1; i < count; i++)
            out->w[i] = out->w[0];
    return at == 1 || at == count;
}

static bool eval_swizzle(const struct ir_value *arg, uint32_t attr, struct ir_value *out)
{
    unsigned count = components_of(arg);
    for (unsigned i = 0; i < components_of(out); i++) {
        unsigned from = attr >> (2 * i) & 3;
        if (from >= count)
            return false;
        out->w[i] = arg->w[from];
    }
    return true;
}

static bool eval_index(const struct ir_value *args, struct ir_value *out)
{
    unsigned size = components_of(out); /* 1, or the size of a column */
    if (args[1].w[0].u >= components_of(&args[0]) / size)
        return false;
    memcpy(out->w, args[0].w + args[1].w[0].u * size, size * sizeof *out->w);
    return true;
}

static bool is_value_type(ir_type_id type)
{
    return ir_type_components(type) > 0;
}

static bool eval_op(enum ir_op op, uint32_t attr, const struct ir_value *args, unsigned num_args,
                    struct ir_value *out)
{
    switch (op) {
    case IR_CONSTRUCT: return eval_construct(args, num_args, out);
    case IR_CONVERT: return eval_convert(&args[0], out);
    case IR_SWIZZLE: return eval_swizzle(&args[0], attr, out);
    case IR_INDEX: return eval_index(args, out);
    case IR_MUL:
        if (ir_is_linear_mul(args[0].type, args[1].type))
            return eval_linear_mul(args, out);
        break;
    default:
        if (wholes[op])
            return wholes[op](args, out);
    }
    return eval_components(op, args, num_args, out);
}

/* Machines differ in the sign and payload of the NaN that they compute. */
static void unify_nans(struct ir_value *value)
{
    for (unsigned i = 0; i < components_of(value); i++)
        if (isnan(value->w[i].f))
            value->w[i].u = IR_NAN;
}

bool ir_eval_op(enum ir_op op, ir_type_id type, uint32_t attr, const struct ir_value *args,
                unsigned num_args, struct ir_value *out)
{
    if (!(ir_op_info(op)->flags & OP_PURE) || num_args == 0 || !is_value_type(type))
        return false;
    out->type = type;
    if (!eval_op(op, attr, args, num_args, out))
        return false;
    if (scalar_of(out) == IR_TYPE_FLOAT)
        unify_nans(out);
    return true;
}
