// SPDX-License-Identifier: Apache-2.0
/*
 * The way back from the working space and the target's unit to those of a file.
 *
 * Units are factors. Of colours the library has the way there alone, so Newton's method finds the
 * constant whose transform is the wanted one: each step solves the linear map that differences of
 * the transform give, and is halved until it comes nearer.
 */
#include "build/build_priv.h"

#include <math.h>

enum { MAX_STEPS = 40, MAX_HALVES = 12 };

struct color {
    double v[3];
};

/* A transform, and the colour that it is to give. */
struct way {
    struct builder *b;
    struct ir_value wanted; /* a color3 or color4; alpha has no space */
    doc_type type;
    str_id space;
};

/* False: the library has no such transform, or it has no value there. */
static bool transform(const struct way *way, const struct color *at, struct color *out)
{
    struct ir_value value = way->wanted;
    for (unsigned i = 0; i < 3; i++)
        value.w[i].f = (float)at->v[i];
    ir_ref result =
        build_find_transform(way->b, ir_const(way->b->graph, &value), way->type, way->space);
    if (!result || !build_evaluate(way->b, result, &value))
        return false;
    bool is_finite = true;
    for (unsigned i = 0; i < 3; i++) {
        out->v[i] = (double)value.w[i].f;
        is_finite &= isfinite(value.w[i].f) != 0;
    }
    return is_finite;
}

/* How far the transform of a colour is from what is wanted; negative: it has no transform. */
static double find_rest(const struct way *way, const struct color *at, struct color *out)
{
    double most = 0.0;
    if (!transform(way, at, out))
        return -1.0;
    for (unsigned i = 0; i < 3; i++) {
        out->v[i] = (double)way->wanted.w[i].f - out->v[i];
        most = fmax(most, fabs(out->v[i]));
    }
    return most;
}

/* Columns: the change of the transform with each channel. */
static bool find_slopes(const struct way *way, const struct color *at, struct color slopes[3])
{
    for (unsigned i = 0; i < 3; i++) {
        struct color low = *at, high = *at, below, above;
        double reach = 1e-3 * (fabs(at->v[i]) + 0.1);
        low.v[i] -= reach;
        high.v[i] += reach;
        if (!transform(way, &low, &below) || !transform(way, &high, &above))
            return false;
        for (unsigned k = 0; k < 3; k++)
            slopes[i].v[k] = (above.v[k] - below.v[k]) / (2.0 * reach);
    }
    return true;
}

static double determinant(const struct color *a, const struct color *b, const struct color *c)
{
    return a->v[0] * (b->v[1] * c->v[2] - b->v[2] * c->v[1])
           - a->v[1] * (b->v[0] * c->v[2] - b->v[2] * c->v[0])
           + a->v[2] * (b->v[0] * c->v[1] - b->v[1] * c->v[0]);
}

/* Cramer's rule; false: the slopes have no inverse. */
static bool solve(const struct color slopes[3], const struct color *rest, struct color *out)
{
    double whole = determinant(&slopes[0], &slopes[1], &slopes[2]);
    if (whole == 0.0)
        return false;
    out->v[0] = determinant(rest, &slopes[1], &slopes[2]) / whole;
    out->v[1] = determinant(&slopes[0], rest, &slopes[2]) / whole;
    out->v[2] = determinant(&slopes[0], &slopes[1], rest) / whole;
    return true;
}

/* One step from `at` to a colour that is nearer; false: there is none. */
static bool approach(const struct way *way, struct color *at, struct color *rest, double *distance)
{
    struct color slopes[3], step, next, next_rest;
    if (!find_slopes(way, at, slopes) || !solve(slopes, rest, &step))
        return false;
    double part = 1.0;
    for (unsigned i = 0; i < MAX_HALVES; i++, part *= 0.5) {
        for (unsigned k = 0; k < 3; k++)
            next.v[k] = (double)(float)(at->v[k] + part * step.v[k]);
        double d = find_rest(way, &next, &next_rest);
        if (d < 0.0 || d >= *distance)
            continue;
        *at = next;
        *rest = next_rest;
        *distance = d;
        return true;
    }
    return false;
}

static ir_ref invert(const struct way *way)
{
    struct ir_value result = way->wanted;
    struct color at, rest;
    double scale = 1.0;
    for (unsigned i = 0; i < 3; i++) {
        at.v[i] = (double)way->wanted.w[i].f;
        scale = fmax(scale, fabs(at.v[i]));
    }
    double distance = find_rest(way, &at, &rest);
    if (distance == 0.0)
        return ir_const(way->b->graph, &result);
    for (unsigned i = 0; i < 3; i++) /* curves may be flat at 0 */
        at.v[i] = fmax(at.v[i], 0.2);
    distance = find_rest(way, &at, &rest);
    for (unsigned i = 0; i < MAX_STEPS && distance > 0.0; i++)
        if (!approach(way, &at, &rest, &distance))
            break;
    if (distance < 0.0 || distance > 1e-5 * scale)
        return 0;
    for (unsigned i = 0; i < 3; i++)
        result.w[i].f = (float)at.v[i];
    return ir_const(way->b->graph, &result);
}

static ir_ref unconvert_color(struct builder *b, ir_ref color, doc_type type, str_id space,
                              const char **out_fault)
{
    struct way way = {.b = b, .type = type, .space = space};
    *out_fault = "it varies";
    if (!build_evaluate(b, color, &way.wanted))
        return 0;
    struct recorder *recorder = b->recorder;
    b->recorder = NULL; /* these transforms are no part of a network */
    bool has_way = build_find_transform(b, ir_const(b->graph, &way.wanted), type, space) != 0;
    ir_ref result = has_way ? invert(&way) : color; /* the file's conversion reports its space */
    b->recorder = recorder;
    *out_fault = "that space has no such colour";
    /* black is black in most spaces, and stays what it is: perhaps a uniform */
    return result == ir_const(b->graph, &way.wanted) ? color : result;
}

ir_ref build_unconvert(struct builder *b, ir_ref value, doc_type type,
                       const struct build_meaning *meaning, const char **out_fault)
{
    if (doc_type_is_color(type) && meaning->space)
        return unconvert_color(b, value, type, meaning->space, out_fault);
    if (!doc_type_is_measure(type) || !meaning->of_unit)
        return value;
    float factor = build_unit_factor(b, meaning->of_unit, meaning->port->element);
    return ir_op2(b->graph, IR_DIV, value, ir_const_float(b->graph, factor));
}
