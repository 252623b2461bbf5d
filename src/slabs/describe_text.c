// SPDX-License-Identifier: Apache-2.0
/* The sheet as text: operators are indented below each other. */
#include "slabs/sheet.h"

static void put_name(const struct slab_sheet *sheet, ir_ref ref, struct text *out)
{
    size_t begin = out->len;
    text_str(out, slabs_name(sheet->shader, ref));
    text_show(out, begin);
}

static void write_slab(const struct slab_sheet *sheet, const struct slab_tree *tree,
                       const struct slab_row *row, struct text *out)
{
    const struct ir_graph *g = sheet->shader->graph;
    text_fmt(out, "slab %s, %s", slabs_name(sheet->shader, row->ref), row->regime);
    if (!ir_const_is(g, ir_arg(g, row->ref, SLAB_mean_free_path), 0.0f)) {
        text_str(out, ", thickness ");
        if (row->thickness)
            slab_write_value(sheet, row->thickness, out);
        else
            text_str(out, sheet->body);
    }
    for (unsigned i = 0; i < num_slab_shown; i++) {
        text_fmt(out, "; %s ", slab_shown[i].name);
        slab_write_value(sheet, ir_arg(g, row->ref, slab_shown[i].input), out);
    }
    for (unsigned i = 0; i < NUM_SLAB_FEATURES; i++)
        if (row->features & 1u << i)
            text_fmt(out, "; %s", slab_feature_names[i]);
    if (tree->num_bases > 1)
        text_fmt(out, "; tangent basis %u", (unsigned)row->basis);
    text_fmt(out, "; %u bytes", (unsigned)row->bytes);
    if (row->through >= 0.0f) {
        text_str(out, "; light from above ");
        slab_write_number(row->through, out);
    }
}

static void write_operator(const struct slab_sheet *sheet, const struct slab_row *row,
                           struct text *out)
{
    static const char *const values[] = {[SLAB_ROW_LAYER] = "thickness",
                                         [SLAB_ROW_MIX] = "share of fg",
                                         [SLAB_ROW_COVERAGE] = "weight",
                                         [SLAB_ROW_OTHER] = ""};
    ir_ref value = slab_operator_value(sheet, row);
    if (row->kind == SLAB_ROW_OTHER) {
        uint8_t op = ir_get(sheet->shader->graph, row->ref)->op;
        text_fmt(out, "%s %s, no slab", ir_op_info((enum ir_op)op)->text,
                 slabs_name(sheet->shader, row->ref));
        return;
    }
    text_fmt(out, "%s %s, %s ", slab_row_names[row->kind], slabs_name(sheet->shader, row->ref),
             values[row->kind]);
    if (value)
        slab_write_value(sheet, value, out);
    else
        text_float(out, SLABS_LAYER_THICKNESS);
}

static void write_row(const struct slab_sheet *sheet, const struct slab_tree *tree,
                      const struct slab_row *row, struct text *out)
{
    for (uint32_t i = 0; i < row->depth; i++)
        text_str(out, "  ");
    size_t begin = out->len;
    if (*row->role)
        text_fmt(out, "%s: ", row->role);
    if (row->is_repeated)
        text_fmt(out, "%s, as above", slabs_name(sheet->shader, row->ref));
    else if (row->kind == SLAB_ROW_SLAB)
        write_slab(sheet, tree, row, out);
    else
        write_operator(sheet, row, out);
    text_show(out, begin);
    text_char(out, '\n');
}

static void write_tree(const struct slab_sheet *sheet, const struct slab_tree *tree,
                       struct text *out)
{
    put_name(sheet, tree->root, out);
    text_fmt(out, ", %s%s\n", tree->is_sheet ? "a sheet" : "a body",
             sheet->is_recognised ? ", as slabs" : "");
    for (uint32_t i = 0; i < tree->rows.len; i++)
        write_row(sheet, tree, &tree->rows.items[i], out);
    for (uint32_t i = 0; i < tree->shared.len; i++) {
        text_str(out, "  ");
        put_name(sheet, tree->shared.items[i].first, out);
        text_str(out, " and ");
        put_name(sheet, tree->shared.items[i].second, out);
        text_str(out, " share a mask, but count as independent\n");
    }
    text_str(out, "  ");
    text_count(out, tree->num_slabs, "slab", "slabs");
    text_str(out, ", ");
    text_count(out, tree->num_bases, "tangent basis", "tangent bases");
    text_str(out, ", ");
    text_count(out, tree->cost.closures, "closure", "closures");
    text_fmt(out, ", %u bytes\n", (unsigned)tree->cost.bytes);
}

static void write_error(float error, struct text *out)
{
    if (error < 0.0f)
        text_str(out, "unknown");
    else
        slab_write_number(error, out);
}

static void write_steps(const struct slab_sheet *sheet, struct text *out)
{
    const struct slab_report *report = &sheet->report;
    if (report->steps.len)
        text_str(out, sheet->is_asked ? "to the budget\n" : "to one slab\n");
    for (uint32_t i = 0; i < report->steps.len; i++) {
        const struct slab_step *step = &report->steps.items[i];
        text_str(out, "  ");
        size_t begin = out->len;
        slabs_describe_step(sheet->shader, step, out);
        text_show(out, begin);
        text_fmt(out, ": slabs %u to %u, bytes %u to %u, estimated error ",
                 (unsigned)step->before.closures, (unsigned)step->after.closures,
                 (unsigned)step->before.bytes, (unsigned)step->after.bytes);
        write_error(step->error, out);
        text_char(out, '\n');
    }
    if (sheet->is_asked && !report->is_met)
        text_fmt(out, "  nothing keeps to the budget; the least are %u slabs, %u bytes\n",
                 (unsigned)report->after.closures, (unsigned)report->after.bytes);
    for (uint32_t i = 0; i < sheet->unread.len; i++) {
        text_str(out, i ? ", " : "  the estimate does not read ");
        put_name(sheet, sheet->unread.items[i], out);
        text_str(out, i + 1 == sheet->unread.len ? "\n" : "");
    }
}

void slabs_write_text(const struct slab_sheet *sheet, struct text *out)
{
    for (uint32_t i = 0; i < sheet->trees.len; i++)
        write_tree(sheet, &sheet->trees.items[i], out);
    if (!sheet->trees.len)
        text_str(out, "no slabs\n");
    write_steps(sheet, out);
}
