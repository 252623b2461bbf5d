// SPDX-License-Identifier: Apache-2.0
#include "render/scene.h"

#include <math.h>
#include <stdio.h>

/* IEC 61966-2-1 */
static float decode_srgb(uint8_t encoded)
{
    double x = encoded / 255.0;
    return (float)(x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4));
}

static bool make_linear(struct image *image)
{
    size_t count = (size_t)image->width * image->height * 4;
    float *linear = malloc(count * sizeof *linear);
    for (size_t i = 0; linear && i < count; ++i)
        linear[i] = decode_srgb(((const uint8_t *)image->pixels)[i]);
    image_finish(image);
    image->pixels = linear;
    image->is_float = true;
    return linear != NULL;
}

/* Light is neither negative nor without bound; one bad texel would darken or burn every pixel. */
static void make_sane(struct image *image)
{
    float *value = image->pixels;
    for (size_t i = 0; i < (size_t)image->width * image->height * 4; ++i) {
        image->num_bad += value[i] >= 1e9f;
        value[i] = value[i] > 0 && value[i] < 1e9f ? value[i] : 0;
    }
}

bool environment_read(const char *path, struct image *out, char *reason, size_t capacity)
{
    if (!image_read(path, "", out, reason, capacity))
        return false;
    if (!out->is_float && !make_linear(out)) {
        snprintf(reason, capacity, "out of memory");
        return false;
    }
    make_sane(out);
    return true;
}
