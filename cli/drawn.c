// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "cli/drawn.h"
#include "cli/files.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define SIZE "48" /* pixels */
#define BALL 0.36 /* of the height: its radius, without the edge, which neighbours soften */

/* ---- Difference ---- */

struct picture {
    int width, height;
    const unsigned char *pixels;
};

static bool read_picture(const char *ppm, size_t size, struct picture *out)
{
    int most = 0, head = 0;
    if (!ppm || sscanf(ppm, "P6 %d %d %d%n", &out->width, &out->height, &most, &head) != 3)
        return false;
    out->pixels = (const unsigned char *)ppm + head + 1;
    return most == 255 && out->width > 0 && out->height > 0
           && size >= (size_t)head + 1 + 3 * (size_t)out->width * (size_t)out->height;
}

static void linear_of(const unsigned char *srgb, float out[3])
{
    for (size_t c = 0; c < 3; ++c) {
        double v = srgb[c] / 255.0;
        out[c] = (float)(v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4));
    }
}

double drawn_difference(const char *a, size_t size_a, const char *b, size_t size_b)
{
    struct picture p, q;
    double sum = 0;
    size_t count = 0;
    if (!read_picture(a, size_a, &p) || !read_picture(b, size_b, &q) || p.width != q.width
        || p.height != q.height)
        return -1;
    for (int i = 0; i < p.width * p.height; ++i) {
        float one[3], other[3];
        double x = i % p.width + 0.5 - p.width / 2.0, y = i / p.width + 0.5 - p.height / 2.0;
        if (hypot(x, y) >= BALL * p.height)
            continue;
        linear_of(p.pixels + (size_t)i * 3, one);
        linear_of(q.pixels + (size_t)i * 3, other);
        sum += mxg_color_difference(one, other);
        ++count;
    }
    return count ? sum / (double)count : -1;
}

/* ---- Pictures ---- */

/* What is drawn, and the steps of its budget. */
struct subject {
    const char *file, *element, *path; /* path: of the picture */
    unsigned num_steps;
    bool is_asked; /* options have the budget; otherwise it is one closure */
};

/* The steps that a report of the slabs lists. */
static void count_steps(struct cli *cli, const mxg_document *document, struct subject *subject)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_result *result = NULL;
    desc.target = "glsl";
    desc.element = subject->element;
    desc.options = cli->options;
    mxg_inspect(cli->context, document, MXG_VIEW_SLABS, &desc, &result);
    const char *text = result ? mxg_result_text(result, NULL) : NULL;
    subject->is_asked = text && !strstr(text, "\nto one closure\n");
    for (; text && (text = strstr(text, ", estimated error ")); ++text)
        ++subject->num_steps;
    mxg_result_destroy(result);
}

/* After the first steps; 0: the full material. NULL after a message. */
static char *draw(struct cli *cli, const struct subject *subject, unsigned steps, size_t *out_size)
{
    struct arg_list args = {0};
    int status = -1;
    args_append(&args, cli_program("mxgen-render"));
    args_append(&args, cli_format("%s", subject->file));
    if (subject->element)
        args_append(&args, cli_format("--element=%s", subject->element));
    args_append(&args, cli_format("--output=%s", subject->path));
    args_append(&args, cli_format("--size=" SIZE));
    args_append(&args, cli_format("--mesh=sphere"));
    args_append(&args, cli_format("--missing-texture=checker"));
    if (steps)
        cli_forward(cli, &args);
    else
        cli_forward_full(cli, &args);
    if (steps && !subject->is_asked)
        args_append(&args, cli_format("--max-closures=1"));
    args_append(&args, cli_format("--max-steps=%u", steps));
    args_append(&args, NULL);
    bool good = cli_run(&cli->report, (char *const *)(uintptr_t)args.items, &status);
    if (good && status != 0)
        report_error(&cli->report, "no-picture",
                     "there are no drawn errors: the renderer made no picture of '%s'",
                     subject->element ? subject->element : subject->file);
    args_free(&args);
    char *data = good && status == 0 ? files_read(subject->path, out_size) : NULL;
    unlink(subject->path);
    return data;
}

static bool compare_all(struct cli *cli, const struct subject *subject, FILE *out)
{
    size_t size = 0, other_size = 0;
    char *full = subject->num_steps ? draw(cli, subject, 0, &size) : NULL;
    bool good = full || !subject->num_steps;
    for (unsigned n = 1; good && n <= subject->num_steps; ++n) {
        char *cheaper = draw(cli, subject, n, &other_size);
        double error = drawn_difference(full, size, cheaper, other_size);
        good = cheaper && error >= 0;
        if (good)
            fprintf(out, "%s%u=%.4f", n > 1 ? "," : "", n, error);
        free(cheaper);
    }
    free(full);
    return good;
}

bool drawn_errors(struct cli *cli, const mxg_document *document, const char *file,
                  const char *element, char **out)
{
    const char *root = getenv("TMPDIR");
    char *folder = cli_format("%s/mxgen-drawn-XXXXXX", root && *root ? root : "/tmp");
    size_t size = 0;
    *out = NULL;
    FILE *stream = open_memstream(out, &size);
    bool good = stream && mkdtemp(folder);
    if (good) {
        char *path = cli_format("%s/ball.ppm", folder);
        struct subject subject = {.file = file, .element = element, .path = path};
        count_steps(cli, document, &subject);
        good = compare_all(cli, &subject, stream);
        free(path);
        rmdir(folder);
    } else {
        report_error(&cli->report, "no-picture", "there is no folder for pictures: '%s'", folder);
    }
    if (stream)
        fclose(stream);
    free(folder);
    return good;
}
