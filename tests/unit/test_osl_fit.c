// SPDX-License-Identifier: Apache-2.0
/* Sums of OSL closures for BSDFs: what is a sum of lobes is found again, and what is none is told.
 */
#include "generators/osl/closure_fit.h"
#include "test.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979324

static void *reallocate(void *user_data, void *block, size_t old_size, size_t new_size)
{
    (void)user_data, (void)old_size;
    if (new_size)
        return realloc(block, new_size);
    free(block);
    return NULL;
}

/* Two lobes in three colours, and the light of a view that all goes to one side of the normal. */
struct two {
    struct lobe lobes[2];
    double weights[2][3], sideways, turning;
};

static bool value(void *user_data, const double v[3], const double l[3], unsigned turn,
                  double out[3])
{
    const struct two *two = user_data;
    for (unsigned c = 0; c < 3; c++) {
        out[c] = l[2] > 0.0 && l[1] > 0.0 ? two->sideways * 2.0 * l[2] / PI : 0.0;
        if (l[2] > 0.0)
            out[c] += two->turning * (turn % 2 ? 0.5 : 1.5) * l[2] / PI;
        for (unsigned i = 0; i < 2; i++)
            out[c] += two->weights[i][c] * osl_lobe_value(&two->lobes[i], v, l);
    }
    return true;
}

static struct osl_fit fit_of(const struct two *two, unsigned num_turns, bool passes)
{
    struct mem mem;
    struct arena arena;
    struct osl_fit fit = {0};
    struct osl_target target = {.user_data = (void *)(uintptr_t)two,
                                .value = value,
                                .num_turns = num_turns,
                                .passes = passes};
    mem_init(&mem, reallocate, NULL);
    arena_init(&arena, &mem);
    REQUIRE(osl_fit(&target, &arena, &fit));
    arena_finish(&arena);
    return fit;
}

/* The weight of the lobes of a shape at a knot, together. */
static double weight_of(const struct osl_fit *fit, enum lobe_shape shape, unsigned knot, unsigned c)
{
    double sum = 0.0;
    for (unsigned i = 0; i < fit->num; i++)
        if (fit->parts[i].lobe->shape == shape)
            sum += (double)fit->parts[i].weights[knot][c];
    return sum;
}

static bool near(double a, double b, double tolerance)
{
    bool is_near = fabs(a - b) <= tolerance;
    if (!is_near)
        printf("    %g, not %g\n", a, b);
    return is_near;
}

/* Colours of each lobe come back in their channels, at all views where both send much light. */
static void test_own_lobes(void)
{
    const struct two front = {.lobes = {{LOBE_DIFFUSE, 0.0f}, {LOBE_SHEEN, 0.35f}},
                              .weights = {{0.2, 0.4, 0.6}, {0.5, 0.3, 0.1}}},
                     both = {.lobes = {{LOBE_DIFFUSE, 0.0f}, {LOBE_THROUGH, 0.0f}},
                             .weights = {{0.2, 0.4, 0.1}, {0.1, 0.3, 0.05}}};
    struct osl_fit fit = fit_of(&front, 1, false), through = fit_of(&both, 1, true);
    REQUIRE(near(fit.error, 0.0, 0.005));
    for (unsigned i = 1; i + 1 < OSL_KNOTS; i++)
        for (unsigned c = 0; c < 3; c++) {
            REQUIRE(near(weight_of(&fit, LOBE_DIFFUSE, i, c), front.weights[0][c], 0.03));
            REQUIRE(near(weight_of(&fit, LOBE_SHEEN, i, c), front.weights[1][c], 0.06));
        }
    REQUIRE_EQ(through.num, 2);
    REQUIRE(near(through.error, 0.0, 0.001));
    REQUIRE(near(weight_of(&through, LOBE_THROUGH, 3, 1), 0.3, 0.001));
}

/* Between two lobes of the table. A narrow one loses no light, so its weight is its albedo. */
static void test_between(void)
{
    const struct two two = {.lobes = {{LOBE_MIRROR, 0.1f}, {LOBE_DIFFUSE, 0.0f}},
                            .weights = {{0.5, 0.5, 0.5}, {0.25, 0.25, 0.25}}};
    struct osl_fit fit = fit_of(&two, 1, false);
    REQUIRE(near(fit.error, 0.0, 0.03));
    for (unsigned i = 2; i < OSL_KNOTS; i++) {
        REQUIRE(near(weight_of(&fit, LOBE_MIRROR, i, 0), 0.5, 0.03));
        REQUIRE(near(weight_of(&fit, LOBE_DIFFUSE, i, 0), 0.25, 0.03));
    }
}

/*
 * Lobes are the same on both sides of the view, so half of the light that goes to one side goes to
 * the other. Light that is half and three halves of its mean by turns is a quarter elsewhere.
 */
static void test_errors(void)
{
    const struct two sideways = {.lobes = {{LOBE_DIFFUSE, 0.0f}, {LOBE_DIFFUSE, 0.0f}},
                                 .sideways = 1.0},
                     turning = {.lobes = {{LOBE_DIFFUSE, 0.0f}, {LOBE_DIFFUSE, 0.0f}},
                                .turning = 0.8};
    REQUIRE(near(fit_of(&sideways, 1, false).error, 0.5, 0.03));
    struct osl_fit fit = fit_of(&turning, OSL_MAX_TURNS, false);
    REQUIRE(near(fit.error, 0.25, 0.01));
    REQUIRE(near(weight_of(&fit, LOBE_DIFFUSE, 4, 0), 0.8, 0.01));
}

/* Drawn directions have the density that is told: its integral over them is that over all. */
static void test_densities(void)
{
    const double v[3] = {0.6, 0.0, 0.8};
    enum { STEPS = 400 };
    for (unsigned i = 0; i < OSL_NUM_LOBES; i++) {
        double kept = 0.0, integral = 0.0;
        bool is_behind = osl_lobes[i].shape == LOBE_THROUGH;
        for (unsigned k = 0; k < STEPS * STEPS; k++) {
            double xi[2] = {(k / STEPS + 0.5) / STEPS, (k % STEPS + 0.5) / STEPS}, l[3];
            osl_lobe_draw(&osl_lobes[i], v, xi, l);
            kept += (l[2] < 0.0) == is_behind;
            double height = xi[0], sine = sqrt(1.0 - height * height), turn = 2.0 * PI * xi[1];
            const double even[3] = {sine * cos(turn), sine * sin(turn),
                                    is_behind ? -height : height};
            integral += osl_lobe_density(&osl_lobes[i], v, even) * 2.0 * PI;
        }
        REQUIRE(near(integral / (STEPS * STEPS), kept / (STEPS * STEPS), 0.03));
    }
}

int main(void)
{
    test_own_lobes();
    test_between();
    test_errors();
    test_densities();
    return test_report("osl_fit");
}
