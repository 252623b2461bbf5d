// SPDX-License-Identifier: Apache-2.0
/*
 * Drawing without Vulkan: what bind_shader bound is written as a line of JSON, a command reads all
 * lines, draws, and answers each with a line of JSON.
 *
 *     {"group": "add", "width": 4, "height": 4, "blend": false, "vertex": SOURCE, "pixel": SOURCE,
 *      "points": [37, …], "indices": HEX, "vertices": HEX, "attributes": [{"location", "format"}],
 *      "blocks": [{"set", "binding", "bytes": HEX}],
 *      "textures": [{"set", "binding", "samplerBinding", "file", "width", "height", "layers",
 *                    "levels", "u", "v", "filter"}]}
 *
 * Attribute i is at byte 16 i of a vertex; formats, address modes and filters are those of WebGPU.
 * Indices are uint32_t. "file" has floats RGBA, level after level, layer after layer, from v = 0
 * on. "points" are the vertices in the centres of the pixels, top row first, of the grid.
 *
 * An answer is {"pixels": HEX, "accuracy": 1e-3}, floats RGBA with the top row first, and how wrong
 * numbers of about 1 may be where the device says so, {"skip": REASON} or {"error": REASON}. A
 * command that cannot draw at all answers {"absent": REASON} once.
 */
#ifndef MXG_TESTS_CONFORMANCE_DRAWS_H
#define MXG_TESTS_CONFORMANCE_DRAWS_H

#include "program/scratch.h"
#include "render/bind_shader.h"

#include <stdio.h>

enum { DRAWS_MAX_IMAGES = 16 };

/* An image of a scene, which has a file for all draws. */
struct draws_image {
    const struct image *image;
    bool bottom_first, has_mips;
    size_t file;
};

struct draws {
    struct scratch scratch;
    char *path;      /* the file of lines, in the scratch folder */
    FILE *file;      /* the lines; then the answers */
    bool is_running; /* the command */
    struct draws_image images[DRAWS_MAX_IMAGES];
    size_t num_images, num_files;
    char *line; /* an answer */
    size_t room;
    char reason[1024];
    double accuracy; /* of the last answer; 0: exact */
};

enum draws_answer { DRAWS_DRAWN, DRAWS_SKIPPED, DRAWS_FAILED, DRAWS_ABSENT };

/* False after printing why. Call draws_close in any case. */
bool draws_open(struct draws *draws);
/* Adds a draw of a bound shader. The scene outlives `draws`. False after printing why. */
bool draws_add(struct draws *draws, const struct bind *bind, const char *group, uint32_t width,
               uint32_t height);
/* Starts the command, whose last argument is the file of lines. False after printing why. */
bool draws_run(struct draws *draws, const char *command);
/*
 * The next answer: the pixels, or the reason why there are none, which is valid until the next
 * call. An answer that does not come is a failure.
 */
enum draws_answer draws_next(struct draws *draws, float *out_pixels, size_t num_pixels,
                             const char **out_reason);
void draws_close(struct draws *draws);

#endif
