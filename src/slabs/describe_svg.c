// SPDX-License-Identifier: Apache-2.0
/* The sheet as a picture: a row per slab and operator, with the colours of the matter. */
#include "slabs/sheet.h"

#include <math.h>

enum { ROW = 28, INDENT = 22, WIDTH = 900, MARGIN = 12, SWATCH = 16 };

static void write_escaped(const char *text, struct text *out)
{
    for (; *text; text++)
        if (*text == '<')
            text_str(out, "&lt;");
        else if (*text == '&')
            text_str(out, "&amp;");
        else
            text_char(out, *text);
}

/* The transfer function of sRGB (IEC 61966-2-1), 0 to 255. */
static unsigned encoded(float linear)
{
    float x = fminf(fmaxf(linear, 0.0f), 1.0f);
    float y = x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1.0f / 2.4f) - 0.055f;
    return (unsigned)lrintf(255.0f * y);
}

/* A square with a constant colour; a hatched one for a value that varies. */
static void write_swatch(const struct slab_sheet *sheet, ir_ref color, unsigned x, unsigned y,
                         struct text *out)
{
    struct ir_value value;
    text_fmt(out, "<rect class='swatch' x='%u' y='%u' width='%u' height='%u' fill='", x, y,
             (unsigned)SWATCH, (unsigned)SWATCH);
    if (ir_get_const(sheet->shader->graph, color, &value))
        text_fmt(out, "rgb(%u,%u,%u)", encoded(value.w[0].f), encoded(value.w[1].f),
                 encoded(value.w[2].f));
    else
        text_str(out, "url(#varies)");
    text_str(out, "'/>");
}

static void write_slab(const struct slab_sheet *sheet, const struct slab_tree *tree,
                       const struct slab_row *row, unsigned x, unsigned y, struct text *out)
{
    const struct ir_graph *g = sheet->shader->graph;
    write_swatch(sheet, ir_arg(g, row->ref, SLAB_diffuse_albedo), x, y - SWATCH + 3, out);
    write_swatch(sheet, ir_arg(g, row->ref, SLAB_f0), x + SWATCH + 4, y - SWATCH + 3, out);
    text_fmt(out, "<text x='%u' y='%u'><tspan class='role'>%s</tspan> <tspan class='name'>",
             x + 2 * SWATCH + 12, y, row->role);
    write_escaped(slabs_name(sheet->shader, row->ref), out);
    text_fmt(out, "</tspan> %s, %u bytes", row->regime, (unsigned)row->bytes);
    for (unsigned i = 0; i < NUM_SLAB_FEATURES; i++)
        if (row->features & 1u << i)
            text_fmt(out, ", %s", slab_feature_names[i]);
    if (tree->num_bases > 1)
        text_fmt(out, ", tangent basis %u", (unsigned)row->basis);
    text_str(out, "</text>");
    if (row->through >= 0.0f)
        text_fmt(out,
                 "<rect class='bar' x='%d' y='%u' width='100' height='10'/>"
                 "<rect class='light' x='%d' y='%u' width='%u' height='10'><title>light from "
                 "above</title></rect>",
                 WIDTH - 112, y - 9, WIDTH - 112, y - 9,
                 (unsigned)lrintf(100.0f * fminf(row->through, 1.0f)));
}

static void write_row(const struct slab_sheet *sheet, const struct slab_tree *tree,
                      const struct slab_row *row, unsigned y, struct text *out)
{
    unsigned x = MARGIN + row->depth * INDENT;
    ir_ref value = slab_operator_value(sheet, row);
    if (row->kind == SLAB_ROW_SLAB && !row->is_repeated) {
        write_slab(sheet, tree, row, x, y, out);
        text_char(out, '\n');
        return;
    }
    text_fmt(out, "<text x='%u' y='%u'><tspan class='role'>%s</tspan> %s <tspan class='name'>", x,
             y, row->role, slab_row_names[row->kind]);
    write_escaped(slabs_name(sheet->shader, row->ref), out);
    text_str(out, row->is_repeated ? "</tspan>, as above" : "</tspan> ");
    if (value && !row->is_repeated) {
        struct text written;
        text_init(&written, sheet->shader->arena);
        slab_write_value(sheet, value, &written);
        write_escaped(text_cstr(&written), out);
    }
    text_str(out, "</text>\n");
}

static void write_step(const struct slab_sheet *sheet, const struct slab_step *step, unsigned y,
                       struct text *out)
{
    struct text what;
    text_init(&what, sheet->shader->arena);
    slabs_describe_step(sheet->shader, step, &what);
    text_fmt(out, "<text x='%u' y='%u'>", (unsigned)(MARGIN + INDENT), y);
    write_escaped(text_cstr(&what), out);
    text_fmt(out, ": %u closures, %u bytes", (unsigned)step->after.closures,
             (unsigned)step->after.bytes);
    if (step->error >= 0.0f) {
        text_str(out, ", estimated error ");
        slab_write_number(step->error, out);
    }
    text_str(out, "</text>\n");
}

/* Writes what the estimates of the steps do not read. */
static void write_unread(const struct slab_sheet *sheet, unsigned y, struct text *out)
{
    text_fmt(out, "<text x='%u' y='%u'>the estimate does not read ", (unsigned)(MARGIN + INDENT),
             y);
    for (uint32_t i = 0; i < sheet->unread.len; i++) {
        text_str(out, i ? ", " : "");
        write_escaped(slabs_name(sheet->shader, sheet->unread.items[i]), out);
    }
    text_str(out, "</text>\n");
}

static unsigned num_rows(const struct slab_sheet *sheet)
{
    unsigned rows = sheet->report.steps.len + (sheet->report.steps.len || !sheet->trees.len)
                    + (sheet->unread.len != 0);
    for (uint32_t i = 0; i < sheet->trees.len; i++)
        rows += 1 + sheet->trees.items[i].rows.len;
    return rows;
}

static void write_head(unsigned height, struct text *out)
{
    text_fmt(
        out,
        "<svg xmlns='http://www.w3.org/2000/svg' width='%d' height='%u' font-family='sans-serif' "
        "font-size='14'>\n"
        "<style>.name{font-weight:bold}.role{fill:#777}.swatch,.bar{stroke:#999}.bar{fill:none}"
        ".light{fill:#e8b000}</style>\n"
        "<defs><pattern id='varies' width='4' height='4' patternUnits='userSpaceOnUse'><rect "
        "width='2' height='4' fill='#bbb'/></pattern></defs>\n"
        "<rect width='100%%' height='100%%' fill='white'/>\n",
        WIDTH, height);
}

static void write_steps(const struct slab_sheet *sheet, unsigned y, struct text *out)
{
    const char *goal = sheet->is_asked ? "To the budget" : "To one slab";
    if (sheet->report.steps.len || !sheet->trees.len)
        text_fmt(out, "<text x='%d' y='%u' class='name'>%s</text>\n", MARGIN, y,
                 sheet->trees.len ? goal : "no slabs");
    for (uint32_t i = 0; i < sheet->report.steps.len; i++)
        write_step(sheet, &sheet->report.steps.items[i], y += ROW, out);
    if (sheet->unread.len)
        write_unread(sheet, y + ROW, out);
}

void slabs_write_svg(const struct slab_sheet *sheet, struct text *out)
{
    unsigned y = MARGIN + ROW / 2;
    write_head(num_rows(sheet) * ROW + 2 * MARGIN, out);
    for (uint32_t i = 0; i < sheet->trees.len; i++) {
        const struct slab_tree *tree = &sheet->trees.items[i];
        text_fmt(out, "<text x='%d' y='%u' class='name'>", MARGIN, y);
        write_escaped(slabs_name(sheet->shader, tree->root), out);
        text_fmt(out, ": %u closures, %u bytes, %u tangent bases</text>\n",
                 (unsigned)tree->cost.closures, (unsigned)tree->cost.bytes,
                 (unsigned)tree->num_bases);
        for (uint32_t k = 0; k < tree->rows.len; k++)
            write_row(sheet, tree, &tree->rows.items[k], y += ROW, out);
        y += ROW;
    }
    write_steps(sheet, y, out);
    text_str(out, "</svg>\n");
}
