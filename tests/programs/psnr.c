// SPDX-License-Identifier: Apache-2.0
/*
 * psnr [--srgb] A B: how near picture B is to picture A, which has floats, in decibels of a peak of
 * 1; "inf" where they are equal. With --srgb B is encoded, and A is, too, before they are compared.
 * --at-least DB: fails below it, and prints nothing.
 */
#include "render/image.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void read_picture(const char *path, struct image *out)
{
    char reason[256];
    if (image_read(path, "", out, reason, sizeof reason))
        return;
    fprintf(stderr, "%s: %s\n", path, reason);
    exit(1);
}

/* IEC 61966-2-1 */
static double encode(double x)
{
    x = fmin(fmax(x, 0.0), 1.0);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
}

int main(int argc, char **argv)
{
    bool is_srgb = argc > 1 && strcmp(argv[1], "--srgb") == 0;
    double least = -1;
    argv += is_srgb, argc -= is_srgb;
    if (argc > 2 && strcmp(argv[1], "--at-least") == 0) {
        least = strtod(argv[2], NULL);
        argv += 2, argc -= 2;
    }
    if (argc != 3)
        return 2;
    struct image a = {0}, b = {0};
    read_picture(argv[1], &a);
    read_picture(argv[2], &b);
    if (a.width != b.width || a.height != b.height) {
        fprintf(stderr, "%ux%u and %ux%u\n", a.width, a.height, b.width, b.height);
        return 1;
    }
    double sum = 0;
    size_t texels = (size_t)a.width * a.height;
    for (size_t i = 0; i < 4 * texels; ++i) {
        double x = (double)image_channel(&a, i), y = (double)image_channel(&b, i);
        double d = (is_srgb ? encode(x) : x) - y;
        sum += i % 4 == 3 ? 0 : d * d;
    }
    double decibels = -10 * log10(sum / (3 * (double)texels));
    image_finish(&a);
    image_finish(&b);
    if (least < 0 || decibels < least)
        printf("%.2f\n", decibels);
    return decibels >= least ? 0 : 1;
}
