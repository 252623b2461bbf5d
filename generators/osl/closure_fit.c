// SPDX-License-Identifier: Apache-2.0
/*
 * Least squares with weights that are not negative, at the views of the knots. The squares are over
 * what the BSDF sends there, so sharp and even light count by their energy. Directions are drawn
 * from all lobes together, so no lobe is sharper than they are dense (Veach 1995, "Optimally
 * Combining Sampling Techniques").
 */
#include "generators/osl/closure_fit.h"

#include <math.h>

enum { NUM_SWEEPS = 200, DRAWS_OF_LOBE = 12, DRAWS_OF_EVEN_LOBE = 32 };
enum { MAX_DRAWS = OSL_NUM_LOBES * DRAWS_OF_EVEN_LOBE };
#define GRAZING 0.02   /* the cosine of the first knot */
#define EVEN 0.05      /* even light that the measure of errors adds */
#define OF_ENERGY 20.0 /* how much the light as a whole counts */
#define LEAST_SHARE 0.02
#define STEPS_OF_ONE 1000.0 /* of a weight in the text */

struct direction {
    double l[3], weight;
    double lobes[OSL_NUM_LOBES];
    double values[OSL_MAX_TURNS][3];
};

struct view {
    double v[3];
    struct direction *directions;
    unsigned num;
    double albedo[3]; /* of the target, as the mean of its turns */
    double albedos[OSL_NUM_LOBES];
    double gram[OSL_NUM_LOBES][OSL_NUM_LOBES], along[3][OSL_NUM_LOBES];
    double weights[3][OSL_NUM_LOBES];
};

/* ---- Directions ---- */

static unsigned draws_of(const struct lobe *lobe, const struct osl_target *target)
{
    if (lobe->shape == LOBE_ROUGH_DIFFUSE || (lobe->shape == LOBE_THROUGH && !target->passes))
        return 0;
    return osl_lobe_is_compensated(lobe) ? DRAWS_OF_LOBE : DRAWS_OF_EVEN_LOBE;
}

/* Points of a plane that fill it evenly (Roberts 2018, "The Unreasonable Effectiveness of
 * Quasirandom Sequences"). */
static void point_of(unsigned number, double out[2])
{
    double x = 0.5 + 0.75487766624669276 * number, y = 0.5 + 0.56984029099805327 * number;
    out[0] = x - floor(x);
    out[1] = y - floor(y);
}

static double density(const struct osl_target *target, const double v[3], const double l[3])
{
    double sum = 0.0;
    for (unsigned i = 0; i < OSL_NUM_LOBES; i++)
        sum += draws_of(&osl_lobes[i], target) * osl_lobe_density(&osl_lobes[i], v, l);
    return sum;
}

static void draw_directions(struct view *view, const struct osl_target *target, struct arena *arena)
{
    view->directions = ARENA_ARRAY(arena, struct direction, MAX_DRAWS);
    for (unsigned i = 0; i < OSL_NUM_LOBES; i++)
        for (unsigned k = 0; k < draws_of(&osl_lobes[i], target); k++) {
            struct direction *to = &view->directions[view->num];
            double xi[2];
            point_of(k + DRAWS_OF_EVEN_LOBE * i, xi);
            osl_lobe_draw(&osl_lobes[i], view->v, xi, to->l);
            double sum = density(target, view->v, to->l);
            to->weight = sum > 0.0 ? 1.0 / sum : 0.0;
            bool is_into = to->l[2] <= 0.0 && osl_lobes[i].shape != LOBE_THROUGH;
            view->num += !is_into && sum > 0.0;
        }
}

/* ---- Values ---- */

static double mean(const double color[3])
{
    return (color[0] + color[1] + color[2]) / 3.0;
}

static void find_lobes(struct view *view)
{
    for (unsigned k = 0; k < OSL_NUM_LOBES; k++) {
        for (unsigned i = 0; i < view->num; i++) {
            struct direction *to = &view->directions[i];
            to->lobes[k] = osl_lobe_value(&osl_lobes[k], view->v, to->l);
            view->albedos[k] += to->weight * to->lobes[k];
        }
        if (!osl_lobe_is_compensated(&osl_lobes[k]) || !(view->albedos[k] > 0.0))
            continue;
        for (unsigned i = 0; i < view->num; i++)
            view->directions[i].lobes[k] /= view->albedos[k];
        view->albedos[k] = 1.0;
    }
}

static bool find_values(struct view *view, const struct osl_target *target)
{
    for (unsigned i = 0; i < view->num; i++)
        for (unsigned turn = 0; turn < target->num_turns; turn++) {
            struct direction *to = &view->directions[i];
            double *values = to->values[turn];
            if (!target->value(target->user_data, view->v, to->l, turn, values))
                return false;
            for (unsigned c = 0; c < 3; c++) {
                if (!(fabs(values[c]) < 1e30))
                    return false;
                values[c] = fmax(values[c], 0.0);
                view->albedo[c] += to->weight * values[c] / target->num_turns;
            }
        }
    return true;
}

/* A direction counts in squares of errors by the reciprocal of the light there. */
static double importance(const struct view *view, const struct direction *to,
                         const struct osl_target *target)
{
    double light = EVEN * mean(view->albedo) * fabs(to->l[2]);
    for (unsigned turn = 0; turn < target->num_turns; turn++)
        light += mean(to->values[turn]) / target->num_turns;
    return light > 0.0 ? to->weight / light : 0.0;
}

static void find_equations(struct view *view, const struct osl_target *target)
{
    double whole = mean(view->albedo) > 0.0 ? OF_ENERGY / mean(view->albedo) : 0.0;
    for (unsigned k = 0; k < OSL_NUM_LOBES; k++) {
        for (unsigned j = 0; j < OSL_NUM_LOBES; j++)
            view->gram[k][j] = whole * view->albedos[k] * view->albedos[j];
        for (unsigned c = 0; c < 3; c++)
            view->along[c][k] = whole * view->albedos[k] * view->albedo[c];
    }
    for (unsigned i = 0; i < view->num; i++) {
        const struct direction *to = &view->directions[i];
        double counts = importance(view, to, target), sum[3] = {0};
        for (unsigned turn = 0; turn < target->num_turns; turn++)
            for (unsigned c = 0; c < 3; c++)
                sum[c] += to->values[turn][c] / target->num_turns;
        for (unsigned k = 0; k < OSL_NUM_LOBES; k++) {
            for (unsigned j = 0; j < OSL_NUM_LOBES; j++)
                view->gram[k][j] += counts * to->lobes[k] * to->lobes[j];
            for (unsigned c = 0; c < 3; c++)
                view->along[c][k] += counts * to->lobes[k] * sum[c];
        }
    }
}

static bool open_view(double cosine, const struct osl_target *target, struct arena *arena,
                      struct view *out)
{
    *out = (struct view){.v = {sqrt(1.0 - cosine * cosine), 0.0, cosine}};
    draw_directions(out, target, arena);
    find_lobes(out);
    return find_values(out, target);
}

/* Gives the directions back: they are more than all else of a generation. */
static void close_view(struct view *view, struct arena *arena)
{
    arena_release(arena, view->directions, MAX_DRAWS * sizeof *view->directions);
    view->directions = NULL;
}

/* ---- Weights ---- */

/* Coordinate descent: each weight in turn is the best for the others, and at least 0. */
static void solve(struct view *view, const bool *is_in)
{
    for (unsigned c = 0; c < 3; c++) {
        double *w = view->weights[c];
        for (unsigned k = 0; k < OSL_NUM_LOBES; k++)
            w[k] = is_in[k] ? w[k] : 0.0;
        for (unsigned i = 0; i < NUM_SWEEPS; i++)
            for (unsigned k = 0; k < OSL_NUM_LOBES; k++) {
                double slope = -view->along[c][k];
                if (!is_in[k] || !(view->gram[k][k] > 0.0))
                    continue;
                for (unsigned j = 0; j < OSL_NUM_LOBES; j++)
                    slope += view->gram[k][j] * w[j];
                w[k] = fmax(w[k] - slope / view->gram[k][k], 0.0);
            }
    }
}

/* How much of the light of all views a lobe sends. */
static double share_of(const struct view *views, unsigned lobe)
{
    double own = 0.0, all = 0.0;
    for (unsigned i = 0; i < OSL_KNOTS; i++) {
        all += mean(views[i].albedo);
        for (unsigned c = 0; c < 3; c++)
            own += views[i].weights[c][lobe] * views[i].albedos[lobe] / 3.0;
    }
    return all > 0.0 ? own / all : 0.0;
}

/* Leaves lobes out, the least first, until few are left and each counts. */
static void choose(struct view *views, bool *is_in)
{
    for (;;) {
        unsigned num = 0, least = OSL_NUM_LOBES;
        double share = 0.0;
        for (unsigned i = 0; i < OSL_KNOTS; i++)
            solve(&views[i], is_in);
        for (unsigned k = 0; k < OSL_NUM_LOBES; k++) {
            double own = is_in[k] ? share_of(views, k) : 0.0;
            if (is_in[k] && own <= 0.0)
                is_in[k] = false;
            num += is_in[k];
            if (is_in[k] && (least == OSL_NUM_LOBES || own < share)) {
                least = k;
                share = own;
            }
        }
        if (!num || (num <= OSL_MAX_PARTS && share >= LEAST_SHARE))
            return;
        is_in[least] = false;
    }
}

static void take_parts(const struct view *views, const bool *is_in, struct osl_fit *out)
{
    for (unsigned k = 0; k < OSL_NUM_LOBES; k++) {
        if (!is_in[k])
            continue;
        struct osl_part *part = &out->parts[out->num++];
        part->lobe = &osl_lobes[k];
        for (unsigned i = 0; i < OSL_KNOTS; i++)
            for (unsigned c = 0; c < 3; c++)
                part->weights[i][c] =
                    (float)(round(views[i].weights[c][k] * STEPS_OF_ONE) / STEPS_OF_ONE);
    }
}

/* ---- The error ---- */

/* The value of the sum between two knots. */
static double sum_of(const struct osl_fit *fit, const struct direction *to, unsigned knot,
                     unsigned channel)
{
    double sum = 0.0;
    for (unsigned i = 0; i < fit->num; i++) {
        const struct osl_part *part = &fit->parts[i];
        double weight =
            0.5 * ((double)part->weights[knot][channel] + (double)part->weights[knot + 1][channel]);
        sum += weight * to->lobes[part->lobe - osl_lobes];
    }
    return sum;
}

/* Half of the differences over all directions. */
static double differences(const struct view *view, const struct osl_target *target,
                          const struct osl_fit *fit, unsigned knot)
{
    double sum = 0.0;
    for (unsigned i = 0; i < view->num; i++)
        for (unsigned turn = 0; turn < target->num_turns; turn++)
            for (unsigned c = 0; c < 3; c++) {
                const struct direction *to = &view->directions[i];
                double gap = fabs(to->values[turn][c] - sum_of(fit, to, knot, c));
                sum += to->weight * gap / (6.0 * target->num_turns);
            }
    return sum;
}

/* Half of all differences, over the light, for views halfway between the knots. */
static bool measure(const struct osl_target *target, struct arena *arena, struct osl_fit *out)
{
    double differs = 0.0, light = 0.0;
    for (unsigned knot = 0; knot + 1 < OSL_KNOTS; knot++) {
        double cosine = (knot + 0.5) / (OSL_KNOTS - 1);
        struct view view;
        bool is_known = open_view(cosine, target, arena, &view);
        light += cosine * mean(view.albedo);
        differs += cosine * differences(&view, target, out, knot);
        close_view(&view, arena);
        if (!is_known)
            return false;
    }
    out->error = light > 0.0 ? differs / light : 0.0;
    return true;
}

bool osl_fit(const struct osl_target *target, struct arena *arena, struct osl_fit *out)
{
    struct view *views = ARENA_ARRAY(arena, struct view, OSL_KNOTS);
    bool is_in[OSL_NUM_LOBES], is_known = true;
    *out = (struct osl_fit){0};
    for (unsigned i = 0; i < OSL_KNOTS && is_known; i++) {
        double cosine = i ? (double)i / (OSL_KNOTS - 1) : GRAZING;
        is_known = open_view(cosine, target, arena, &views[i]);
        find_equations(&views[i], target);
        close_view(&views[i], arena);
    }
    for (unsigned k = 0; k < OSL_NUM_LOBES; k++)
        is_in[k] = target->passes || osl_lobes[k].shape != LOBE_THROUGH;
    if (is_known) {
        choose(views, is_in);
        take_parts(views, is_in, out);
    }
    arena_release(arena, views, OSL_KNOTS * sizeof *views);
    return is_known && measure(target, arena, out);
}
