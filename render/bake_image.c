// SPDX-License-Identifier: Apache-2.0
/* A drawing becomes a value, or a file for each tile. */
#define _POSIX_C_SOURCE 200809L
#include "render/bake.h"
#include "render/dilate.h"
#include "render/image_rows.h"

#include "program/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SLACK 1e-3f           /* values so far outside 0 to 1 are rounded */
#define MOST_OF_HALF 65504.0f /* the largest number of a float of 16 bits */

static bool is_color(const struct bake_drawing *drawing)
{
    return strncmp(drawing->type, "color", 5) == 0;
}

/* ---- Values ---- */

static void measure(struct bake_drawing *drawing, const struct spool *spools, uint32_t num)
{
    bool is_one = num == 1;
    drawing->low = INFINITY;
    drawing->high = -INFINITY;
    for (uint32_t t = 0; t < num; ++t)
        for (uint32_t c = 0; c < spools[t].channels; ++c) {
            drawing->low = fminf(drawing->low, spools[t].low[c]);
            drawing->high = fmaxf(drawing->high, spools[t].high[c]);
            drawing->value[c] = spools[t].low[c];
            is_one = is_one && spools[t].low[c] == spools[t].high[c];
        }
    drawing->is_value = is_one && !drawing->is_direction;
}

/* ---- Formats ---- */

/* ---- What outputs ask for ---- */

/* The <output> that a drawing is the image of; 0: none. */
static mxg_element output_of(const struct baking *baking, const struct bake_drawing *drawing)
{
    mxg_connection connection = {.size = sizeof connection};
    const mxg_document *document = baking->document;
    if (strcmp(bake_element(document, drawing->port).category, "output") == 0)
        return drawing->port;
    if (mxg_document_connection(document, drawing->port, &connection) != MXG_OK
        || strcmp(bake_element(document, connection.source).category, "nodegraph") != 0)
        return 0;
    return bake_find_output(document, connection.source, connection.output);
}

/* A whole number of the output of a drawing; 0: it has none. */
static uint32_t asked(const struct baking *baking, const struct bake_drawing *drawing,
                      const char *name)
{
    mxg_element output = output_of(baking, drawing);
    const char *text = output ? bake_attribute(baking->document, output, name) : NULL;
    bool is_number = text && strlen(text) < 6 && !text[strspn(text, "0123456789")];
    return is_number ? (uint32_t)strtoul(text, NULL, 10) : 0;
}

uint32_t bake_asked_size(const struct baking *baking, const struct bake_drawing *drawing)
{
    uint32_t width = asked(baking, drawing, "width"), height = asked(baking, drawing, "height"),
             side = width ? width : height;
    bool is_square = !width || !height || width == height;
    return is_square && side >= BAKE_MIN_SIZE && side <= BAKE_MAX_SIZE ? side : 0;
}

/* The depth of the options, or what the output asks for, if the format has it; 0: neither. */
static uint32_t depth_of(const struct baking *baking, const struct bake_drawing *drawing,
                         const char *ending)
{
    uint32_t bits = asked(baking, drawing, "bitdepth");
    bool is_float = strcmp(ending, "exr") == 0, is_jpeg = strcmp(ending, "jpg") == 0,
         has = bits == 16 ? !is_jpeg : bits == (is_float ? 32u : 8u);
    return baking->options.depth ? (uint32_t)baking->options.depth : has ? bits : 0;
}

/* ---- Formats ---- */

static void tell_clamped(struct baking *baking, const struct bake_drawing *drawing,
                         const char *format, double low, double high)
{
    report_warning(&baking->cli.report, "bake-clamped",
                   "'%s' has values from %g to %g; %s keeps those from %g to %g", drawing->path,
                   (double)drawing->low, (double)drawing->high, format, low, high);
}

static bool fits_half(const struct bake_drawing *drawing)
{
    return drawing->low >= -MOST_OF_HALF && drawing->high <= MOST_OF_HALF;
}

static const char *ending_of(struct baking *baking, const struct bake_drawing *drawing)
{
    enum { DEPTH_OF_EXR = 32 };
    const char *said = baking->options.format;
    bool is_within = drawing->low >= -SLACK && drawing->high <= 1 + SLACK,
         has_four = bake_channels(drawing->type) == 4;
    if (!said || (has_four && strcmp(said, "jpg") == 0)) /* JPEG has no fourth channel */
        return is_within && !has_four && baking->options.depth != DEPTH_OF_EXR ? "png" : "exr";
    if (!is_within && strcmp(said, "exr") != 0)
        tell_clamped(baking, drawing, said, 0, 1);
    return said;
}

/* An image of two numbers has a third one: grey with alpha is another thing. */
static uint32_t file_channels(const struct bake_drawing *drawing)
{
    uint32_t channels = bake_channels(drawing->type);
    return channels == 2 ? 3 : channels;
}

static struct image_format format_of(struct baking *baking, const struct bake_drawing *drawing,
                                     const char *ending, uint32_t size)
{
    bool is_float = strcmp(ending, "exr") == 0;
    uint32_t said = depth_of(baking, drawing, ending);
    bool is_half = said >= 16 ? said < 32 : is_color(drawing) && fits_half(drawing);
    uint32_t float_depth = is_half ? 16 : 32, whole_depth = said ? said : 8;
    if (is_float && is_half && !fits_half(drawing))
        tell_clamped(baking, drawing, "exr with 16 bits", (double)-MOST_OF_HALF,
                     (double)MOST_OF_HALF);
    return (struct image_format){.width = size,
                                 .height = size,
                                 .channels = file_channels(drawing),
                                 .depth = is_float ? float_depth : whole_depth,
                                 .is_float = is_float,
                                 .is_srgb = drawing->spaces
                                            && strcmp(drawing->spaces, "srgb_texture") == 0};
}

/* IEC 61966-2-1 */
static float encode_srgb(float linear)
{
    float x = fminf(fmaxf(linear, 0.0f), 1.0f);
    return x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1 / 2.4f) - 0.055f;
}

/* A number as the file keeps it. */
static float keep(const struct image_format *format, float value)
{
    if (format->is_float && format->depth == 32)
        return value;
    return format->is_float ? fminf(fmaxf(value, -MOST_OF_HALF), MOST_OF_HALF)
                            : fminf(fmaxf(value, 0.0f), 1.0f);
}

/* Texels of a spool as those of a file. */
static void convert(const struct image_format *format, uint32_t channels, size_t count,
                    const float *in, float *out)
{
    for (size_t i = 0; i < count; ++i, in += channels, out += format->channels)
        for (uint32_t c = 0; c < format->channels; ++c) {
            float value = c < channels ? in[c] : 0.0f;
            out[c] = format->is_srgb && c < 3 ? encode_srgb(value) : keep(format, value);
        }
}

/* ---- Files ---- */

static bool write_rows(struct image_rows *rows, const struct image_format *format,
                       struct dilation *dilation, char *reason, size_t capacity)
{
    uint32_t channels = dilation->spool->channels;
    size_t texels = (size_t)format->width * DILATION_BAND;
    float *in = memory_alloc(texels * channels * sizeof *in),
          *out = memory_alloc(texels * format->channels * sizeof *out);
    bool good = true;
    for (uint32_t y = 0; good && y < format->height; y += DILATION_BAND) {
        uint32_t rest = format->height - y, count = rest < DILATION_BAND ? rest : DILATION_BAND;
        const char *fault = dilation_read(dilation, y, count, in);
        if (fault)
            snprintf(reason, capacity, "%s", fault);
        convert(format, channels, (size_t)format->width * count, in, out);
        good = !fault && image_rows_add(rows, count, out, reason, capacity);
    }
    free(in);
    free(out);
    return good;
}

/* Writes a file of the batch. */
static void write_image(struct baking *baking, const struct image_format *format, const char *path,
                        const struct spool *spool, char *reason, size_t capacity)
{
    char later[256];
    struct dilation dilation;
    const struct files_stream *stream;
    const char *fault = batch_begin(&baking->written, path, &stream);
    if (fault) {
        snprintf(reason, capacity, "%s", fault);
        return;
    }
    dilation_begin(&dilation, spool, (uint32_t)baking->options.padding);
    struct image_rows *rows = image_rows_begin(stream->out, path, format, reason, capacity);
    if (rows && write_rows(rows, format, &dilation, reason, capacity))
        image_rows_end(rows, reason, capacity);
    else
        image_rows_end(rows, later, sizeof later);
    dilation_end(&dilation);
}

static bool write_file(struct baking *baking, const struct image_format *format, const char *name,
                       const struct spool *spool)
{
    char reason[256] = "", *path = cli_format("%s/%s", baking->options.output, name);
    bool is_free = outputs_write(&baking->files, &baking->cli.report, path, "an image");
    if (is_free)
        write_image(baking, format, path, spool, reason, sizeof reason);
    if (*reason)
        report_error(&baking->cli.report, "output-failed", "cannot write '%s': %s", path, reason);
    baking->num_images += is_free && !*reason;
    free(path);
    return is_free && !*reason;
}

static void tell_overlap(struct baking *baking, struct bake_tile tile, uint32_t size)
{
    double part = bake_surface_overlap(&baking->surface, tile, size);
    const double told = 1e-3;
    if (part > told && !baking->has_told_overlap)
        report_warning(&baking->cli.report, "bake-overlap",
                       "triangles of '%s' lie over each other in the image, on %.1f percent of "
                       "what they cover; one of them gives its values",
                       baking->options.mesh, 100 * part);
    baking->has_told_overlap |= part > told;
}

/* ---- Outputs ---- */

static void tell_asked(struct baking *baking, mxg_element output, const char *name, const char *has)
{
    const char *asked = bake_attribute(baking->document, output, name);
    if (!asked || strcmp(asked, has) == 0)
        return;
    char *path = bake_path(baking->document, output), *place = bake_place(baking, output);
    report_warning(&baking->cli.report, "bake-output",
                   "'%s' (%s) asks for %s '%s', and its image has '%s': images are square, and "
                   "the options size, depth and format come first",
                   path, place, name, asked, has);
    free(path);
    free(place);
}

/* Tells what an output says of its image and the image does not have. */
static void tell_output(struct baking *baking, const struct bake_drawing *drawing,
                        const struct image_format *format)
{
    mxg_element output = output_of(baking, drawing);
    if (!output)
        return;
    char *size = cli_format("%u", format->width), *depth = cli_format("%u", format->depth);
    tell_asked(baking, output, "width", size);
    tell_asked(baking, output, "height", size);
    tell_asked(baking, output, "bitdepth", depth);
    if (drawing->spaces)
        tell_asked(baking, output, "colorspace", drawing->spaces);
    free(size);
    free(depth);
}

bool bake_finish_drawing(struct baking *baking, struct bake_drawing *drawing,
                         const struct spool *spools, uint32_t num_spools)
{
    measure(drawing, spools, num_spools);
    if (drawing->is_value)
        return true;
    const char *ending = ending_of(baking, drawing);
    const struct bake_tiles *all = bake_tiles_of(baking, drawing);
    const struct bake_tile *tiles = all->items;
    bool is_set = all->is_set || num_spools > 1 || tiles[0].u || tiles[0].v, good = true;
    drawing->spaces = !is_color(drawing)                              ? NULL
                      : strcmp(ending, "exr") == 0 || !baking->is_709 ? baking->space
                                                                      : "srgb_texture";
    struct image_format format = format_of(baking, drawing, ending, spools[0].width);
    if (!baking->source) /* the files of an export are others */
        tell_output(baking, drawing, &format);
    drawing->file = cli_format(is_set ? "%s.<UDIM>.%s" : "%s.%s", drawing->name, ending);
    for (uint32_t t = 0; good && t < num_spools; ++t) {
        char *name = is_set ? cli_format("%s.%d.%s", drawing->name,
                                         1001 + tiles[t].u + 10 * tiles[t].v, ending)
                            : cli_format("%s", drawing->file);
        if (baking->surface.objects)
            tell_overlap(baking, tiles[t], format.width);
        good = write_file(baking, &format, name, &spools[t]);
        free(name);
    }
    return good;
}
