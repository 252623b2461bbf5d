// SPDX-License-Identifier: Apache-2.0
/*
 * The triangles of shapes. A mesh with twice the cells has the point of the surface in the middle
 * of each cell, and the diagonal that halves the cell is the one that is nearer to it: a groove
 * across the grid has no teeth.
 */
#include "unit/test.h"

#include "render/mesh.h"

#include <math.h>
#include <string.h>

static double distance_of_middle(const struct mesh *mesh, uint32_t a, uint32_t b,
                                 const float *point)
{
    double sum = 0;
    for (size_t i = 0; i < 3; ++i) {
        double d =
            ((double)mesh->vertices[a].position[i] + mesh->vertices[b].position[i]) / 2 - point[i];
        sum += d * d;
    }
    return sqrt(sum);
}

/* The triangles of a cell are two that share a diagonal and turn the same way. */
static bool is_halved(const uint32_t *cell, uint32_t corner, uint32_t above, bool *out_falls)
{
    const uint32_t rising[6] = {corner, corner + 1, above + 1, corner, above + 1, above};
    const uint32_t falling[6] = {corner, corner + 1, above, corner + 1, above + 1, above};
    *out_falls = memcmp(cell, falling, sizeof falling) == 0;
    return *out_falls || memcmp(cell, rising, sizeof rising) == 0;
}

/* Checks the first patch of a shape, which has so many cells. */
static void check_patch(const char *name, uint32_t across, uint32_t up, bool has_falling)
{
    struct mesh mesh, fine;
    shape_make(name, 1, &mesh);
    shape_make(name, 2, &fine);
    uint32_t num_falling = 0, num_halved = 0, num_near = 0;
    for (uint32_t j = 0; j < up; ++j)
        for (uint32_t i = 0; i < across; ++i) {
            uint32_t corner = j * (across + 1) + i, above = corner + across + 1;
            const float *middle =
                fine.vertices[(2 * j + 1) * (2 * across + 1) + 2 * i + 1].position;
            bool falls;
            num_halved += is_halved(mesh.indices + 6 * (j * across + i), corner, above, &falls);
            double falling = distance_of_middle(&mesh, corner + 1, above, middle),
                   rising = distance_of_middle(&mesh, corner, above + 1, middle);
            num_near += (falls ? falling : rising) <= 1.001 * fmin(falling, rising) + 1e-6;
            num_falling += falls;
        }
    REQUIRE_EQ(num_halved, across * up);
    REQUIRE_EQ(num_near, across * up);
    REQUIRE_EQ(num_falling > 0, has_falling);
    mesh_finish(&mesh);
    mesh_finish(&fine);
}

int main(void)
{
    check_patch("ball", 192, 160, true);
    check_patch("cloth", 192, 192, true);
    check_patch("plane", 16, 16, false);
    return test_report("shapes");
}
