// SPDX-License-Identifier: Apache-2.0
#include "slabs/places.h"

#include <math.h>

#define PI 3.14159265f
#define GOLDEN_ANGLE 2.3999632f
#define GOLDEN_SECTION 0.6180340f

/* ---- The ball ---- */

static float fraction(float x)
{
    return x - floorf(x);
}

/* A spiral of equal areas around the axis y (Vogel 1979). */
static void point_of_spiral(unsigned at, unsigned num, float out[3])
{
    float y = 1.0f - (2.0f * (float)at + 1.0f) / (float)num, radius = sqrtf(1.0f - y * y),
          turn = GOLDEN_ANGLE * (float)at;
    out[0] = radius * cosf(turn);
    out[1] = y;
    out[2] = radius * sinf(turn);
}

static void position_at(unsigned at, float out[3])
{
    point_of_spiral(at, SLAB_NUM_PLACES, out);
}

/* How much of a picture from one side a place is; 0 behind the edge. */
static float area_of(unsigned at, unsigned side)
{
    float position[3], to_viewer[3], cosine = 0.0f;
    position_at(at, position);
    point_of_spiral(side, SLAB_NUM_SIDES, to_viewer);
    for (unsigned c = 0; c < 3; c++)
        cosine += position[c] * to_viewer[c];
    return fmaxf(cosine, 0.0f);
}

/* Longitude and latitude, and a third number for data of vertices. */
static void coordinates_at(unsigned at, float out[3])
{
    float position[3];
    position_at(at, position);
    out[0] = fraction(GOLDEN_SECTION * (float)at);
    out[1] = 1.0f - acosf(position[1]) / PI;
    out[2] = fraction(GOLDEN_SECTION * GOLDEN_SECTION * (float)at + 0.5f);
}

void slabs_place_stream(unsigned at, str_id name, struct ir_value *out)
{
    static const struct {
        str_id name;
        float value[3];
    } frame[] = {{STR_normalWorld, {0, 0, 1}},
                 {STR_normalObject, {0, 0, 1}},
                 {STR_tangentWorld, {1, 0, 0}},
                 {STR_bitangentWorld, {0, 1, 0}}};
    float value[3];
    if (name == STR_positionObject || name == STR_positionWorld)
        position_at(at, value);
    else
        coordinates_at(at, value);
    for (size_t i = 0; i < sizeof frame / sizeof *frame; i++)
        if (frame[i].name == name)
            memcpy(value, frame[i].value, sizeof value);
    for (unsigned i = 0; i < 16; i++)
        out->w[i].f = i < 3 ? value[i] : i == 3 ? 1.0f : 0.0f;
}

/* ---- Choice ---- */

enum { MAX_CHOSEN = 12 };
#define LIKE 0.02f /* values that are as near to each other are one */

static float distance(const float a[3], const float b[3])
{
    float square = 0.0f;
    for (unsigned c = 0; c < 3; c++) {
        float step = a[c] - b[c];
        square += step * step;
    }
    return sqrtf(square);
}

/* The chosen place that is nearest to a place, and how far it is. */
struct nearest {
    unsigned chosen;
    float distance;
};

/* Compares all places with one more chosen place. Returns the place that is farthest from all. */
static unsigned add_place(const float *values, unsigned place, unsigned chosen,
                          struct nearest *nearest)
{
    unsigned farthest = 0;
    for (unsigned i = 0; i < SLAB_NUM_PLACES; i++) {
        float away = distance(values + i * 3, values + place * 3);
        if (chosen == 0 || away < nearest[i].distance)
            nearest[i] = (struct nearest){chosen, away};
        if (nearest[i].distance > nearest[farthest].distance)
            farthest = i;
    }
    return farthest;
}

/* The member of a group that is nearest to its mean. */
static unsigned middle_of(const float *values, const struct nearest *nearest, unsigned chosen)
{
    float mean[3] = {0}, least = INFINITY;
    unsigned num = 0, middle = 0;
    for (unsigned i = 0; i < SLAB_NUM_PLACES; i++) {
        if (nearest[i].chosen != chosen)
            continue;
        num++;
        for (unsigned c = 0; c < 3; c++)
            mean[c] += values[i * 3 + c];
    }
    for (unsigned c = 0; c < 3; c++)
        mean[c] /= (float)num;
    for (unsigned i = 0; i < SLAB_NUM_PLACES; i++) {
        float away = distance(values + i * 3, mean);
        if (nearest[i].chosen == chosen && away < least) {
            least = away;
            middle = i;
        }
    }
    return middle;
}

/* ---- Glances ---- */

/* The parts of a picture from one side that each chosen place stands for. */
static void add_side(const struct nearest *nearest, unsigned side,
                     float weights[MAX_CHOSEN][SLAB_NUM_SIDES])
{
    float sum = 0.0f;
    for (unsigned i = 0; i < SLAB_NUM_PLACES; i++)
        sum += area_of(i, side);
    for (unsigned i = 0; i < SLAB_NUM_PLACES; i++)
        weights[nearest[i].chosen][side] += area_of(i, side) / sum;
}

/* A place that stands for little of each side is looked at from few directions. */
static void add_glances(struct arena *arena, unsigned at, const float weights[SLAB_NUM_SIDES],
                        struct slab_glances *out)
{
    const unsigned few = 2;
    float most = 0.0f;
    for (unsigned i = 0; i < SLAB_NUM_SIDES; i++)
        most = fmaxf(most, weights[i]);
    unsigned num = most * SLAB_NUM_VIEWS < 1.0f ? few : SLAB_NUM_VIEWS;
    for (unsigned i = 0; i < num; i++) {
        struct slab_glance glance = {.at = at,
                                     .view = (at + i * (SLAB_NUM_VIEWS / num)) % SLAB_NUM_VIEWS};
        for (unsigned side = 0; side < SLAB_NUM_SIDES; side++)
            glance.weights[side] = weights[side] / (float)num;
        vec_push(arena, &out->items, glance);
    }
}

/* The farthest place comes next (Gonzalez 1985), so that no small patch is missed. */
void slabs_choose_glances(const float *values, struct arena *arena, struct slab_glances *out)
{
    struct nearest nearest[SLAB_NUM_PLACES] = {0};
    float weights[MAX_CHOSEN][SLAB_NUM_SIDES] = {0};
    unsigned num = values ? 0 : 1, next = 0;
    while (values && num < MAX_CHOSEN && (num == 0 || nearest[next].distance > LIKE))
        next = add_place(values, next, num++, nearest);
    for (unsigned side = 0; side < SLAB_NUM_SIDES; side++)
        add_side(nearest, side, weights);
    for (unsigned i = 0; i < num; i++)
        add_glances(arena, values ? middle_of(values, nearest, i) : 0, weights[i], out);
}
