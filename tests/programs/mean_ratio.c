// SPDX-License-Identifier: Apache-2.0
/*
 * mean_ratio A B: the mean of picture A over that of B, of all colours together; their sizes may
 * differ.
 */
#include "render/image.h"

#include <stdio.h>

static double mean_of(const char *path)
{
    struct image image;
    char reason[256];
    if (!image_read(path, "", &image, reason, sizeof reason) || !image.is_float) {
        fprintf(stderr, "%s: %s\n", path, image.pixels ? "not floats" : reason);
        exit(1);
    }
    double sum = 0;
    for (size_t i = 0; i < (size_t)image.width * image.height * 4; ++i)
        sum += i % 4 == 3 ? 0 : ((float *)image.pixels)[i];
    image_finish(&image);
    return sum / ((double)image.width * image.height);
}

int main(int argc, char **argv)
{
    if (argc != 3)
        return 2;
    printf("%.4f\n", mean_of(argv[1]) / mean_of(argv[2]));
    return 0;
}
