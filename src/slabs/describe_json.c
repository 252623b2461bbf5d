// SPDX-License-Identifier: Apache-2.0
/* The sheet as JSON. */
#include "slabs/sheet.h"

#include "base/json.h"

static void put_value(struct json *json, const struct slab_sheet *sheet, const char *key,
                      ir_ref ref)
{
    struct text value;
    text_init(&value, sheet->shader->arena);
    slab_write_value(sheet, ref, &value);
    json_put_text(json, key, text_cstr(&value));
}

/* An item of a list. */
static void put_name(struct json *json, const struct slab_sheet *sheet, ir_ref ref)
{
    const char *name = slabs_name(sheet->shader, ref);
    json_item(json);
    text_json_string(json->out, name, strlen(name));
}

static void put_float(struct json *json, const char *key, float value)
{
    if (value < 0.0f)
        return;
    json_key(json, key);
    slab_write_number(value, json->out);
}

static void put_cost(struct json *json, const char *key, const struct slab_cost *cost)
{
    json_key(json, key);
    json_open_flat(json, '{');
    json_put_number(json, "closures", cost->closures);
    json_put_number(json, "bytes", cost->bytes);
    json_close(json, '}');
}

static void put_slab(struct json *json, const struct slab_sheet *sheet, const struct slab_row *row)
{
    const struct ir_graph *g = sheet->shader->graph;
    json_put_text(json, "regime", row->regime);
    if (row->thickness)
        put_value(json, sheet, "thickness", row->thickness);
    for (unsigned i = 0; i < num_slab_shown; i++)
        put_value(json, sheet, slab_shown[i].name, ir_arg(g, row->ref, slab_shown[i].input));
    json_key(json, "features");
    json_open_flat(json, '[');
    for (unsigned i = 0; i < NUM_SLAB_FEATURES; i++)
        if (row->features & 1u << i) {
            json_item(json);
            text_json_string(json->out, slab_feature_names[i], strlen(slab_feature_names[i]));
        }
    json_close(json, ']');
    json_put_number(json, "tangentBasis", row->basis);
    json_put_number(json, "bytes", row->bytes);
    put_float(json, "lightFromAbove", row->through);
}

static void put_row(struct json *json, const struct slab_sheet *sheet, const struct slab_row *row)
{
    ir_ref value = slab_operator_value(sheet, row);
    json_item(json);
    json_open(json, '{');
    json_put_text(json, "kind", slab_row_names[row->kind]);
    json_put_text(json, "name", slabs_name(sheet->shader, row->ref));
    json_put_text(json, "role", row->role);
    json_put_number(json, "depth", row->depth);
    if (row->is_repeated)
        json_put_bool(json, "repeated", true);
    else if (row->kind == SLAB_ROW_SLAB)
        put_slab(json, sheet, row);
    else if (value)
        put_value(json, sheet, row->kind == SLAB_ROW_LAYER ? "thickness" : "share", value);
    json_close(json, '}');
}

static void put_tree(struct json *json, const struct slab_sheet *sheet,
                     const struct slab_tree *tree)
{
    json_item(json);
    json_open(json, '{');
    json_put_text(json, "name", slabs_name(sheet->shader, tree->root));
    json_put_bool(json, "sheet", tree->is_sheet);
    json_put_number(json, "tangentBases", tree->num_bases);
    put_cost(json, "cost", &tree->cost);
    json_key(json, "rows");
    json_open(json, '[');
    for (uint32_t i = 0; i < tree->rows.len; i++)
        put_row(json, sheet, &tree->rows.items[i]);
    json_close(json, ']');
    json_key(json, "sharedMasks");
    json_open_flat(json, '[');
    for (uint32_t i = 0; i < tree->shared.len; i++) {
        put_name(json, sheet, tree->shared.items[i].first);
        put_name(json, sheet, tree->shared.items[i].second);
    }
    json_close(json, ']');
    json_close(json, '}');
}

static void put_step(struct json *json, const struct slab_sheet *sheet,
                     const struct slab_step *step)
{
    struct text what;
    text_init(&what, sheet->shader->arena);
    slabs_describe_step(sheet->shader, step, &what);
    json_item(json);
    json_open(json, '{');
    json_put_text(json, "step", text_cstr(&what));
    put_cost(json, "before", &step->before);
    put_cost(json, "after", &step->after);
    put_float(json, "estimatedError", step->error);
    json_close(json, '}');
}

void slabs_write_json(const struct slab_sheet *sheet, struct text *out)
{
    struct json json = {.out = out};
    json_open(&json, '{');
    json_put_bool(&json, "recognised", sheet->is_recognised);
    json_key(&json, "trees");
    json_open(&json, '[');
    for (uint32_t i = 0; i < sheet->trees.len; i++)
        put_tree(&json, sheet, &sheet->trees.items[i]);
    json_close(&json, ']');
    json_put_bool(&json, "toBudget", sheet->is_asked);
    json_put_bool(&json, "budgetIsMet", sheet->is_asked && sheet->report.is_met);
    json_key(&json, "steps");
    json_open(&json, '[');
    for (uint32_t i = 0; i < sheet->report.steps.len; i++)
        put_step(&json, sheet, &sheet->report.steps.items[i]);
    json_close(&json, ']');
    json_key(&json, "notRead");
    json_open_flat(&json, '[');
    for (uint32_t i = 0; i < sheet->unread.len; i++)
        put_name(&json, sheet, sheet->unread.items[i]);
    json_close(&json, ']');
    json_close(&json, '}');
    text_char(out, '\n');
}
