// SPDX-License-Identifier: Apache-2.0
#include "slabs/sheet.h"

#include "slabs/bytes.h"
#include "slabs/estimate.h"
#include "slabs/hidden_slabs.h"
#include "slabs/recognise.h"
#include "slabs/joined_surfaces.h"

#include <math.h>
#include <string.h>

const struct slab_shown slab_shown[] = {{SLAB_diffuse_albedo, "albedo"},
                                        {SLAB_f0, "f0"},
                                        {SLAB_roughness, "roughness"},
                                        {SLAB_mean_free_path, "mean free path"}};
const unsigned num_slab_shown = sizeof slab_shown / sizeof *slab_shown;

const char *const slab_row_names[] = {[SLAB_ROW_SLAB] = "slab",
                                      [SLAB_ROW_LAYER] = "layer",
                                      [SLAB_ROW_MIX] = "mix",
                                      [SLAB_ROW_COVERAGE] = "coverage",
                                      [SLAB_ROW_OTHER] = "no slab"};

/* The input that drives an operator. */
struct mask {
    ir_ref value, driven;
};

/* The tangent is 0 for an even slab. */
struct basis {
    ir_ref normal, tangent;
};

struct filler {
    struct slab_sheet *sheet;
    struct shader *shader;
    const struct ir_graph *graph;
    const struct slabs_host *host;
    struct slab_tree *tree;
    struct slab_spots spots; /* of the tree */
    uint8_t *is_written;     /* per node */
    struct line {
        ir_ref ref, thickness, above; /* above: vec3, what the tops let through */
        uint32_t depth;
        const char *role;
        bool is_alone; /* no other matter is in its pixels */
    } line;
    VEC(struct line) open;
    VEC(struct mask) masks;
    VEC(struct basis) bases; /* of slabs, each once */
};

/* ---- Names and values ---- */

void slab_write_number(float value, struct text *out)
{
    enum { DIGITS = 4 };
    double scale = value == 0.0f ? 1.0 : pow(10.0, DIGITS - 1 - floor(log10(fabs(value))));
    text_float(out, isfinite(scale) ? (float)(round(value * scale) / scale) : value);
}

void slab_write_value(const struct slab_sheet *sheet, ir_ref ref, struct text *out)
{
    struct ir_value value;
    const struct ir_graph *g = sheet->shader->graph;
    const struct ir_node *node = ir_get(g, ref);
    if (node->op == IR_UNIFORM) {
        const struct shader_variable *v = &sheet->shader->interface.variables.items[node->attr];
        text_str(out, str_text(sheet->shader->strings, v->path ? v->path : v->name));
        return;
    }
    if (!ir_get_const(g, ref, &value)) {
        text_str(out, slabs_name(sheet->shader, ref));
        return;
    }
    unsigned count = ir_type_info(value.type)->components;
    bool is_splat = count == 3 && value.w[0].u == value.w[1].u && value.w[0].u == value.w[2].u;
    for (unsigned i = 0; i < (is_splat ? 1 : count); i++) {
        text_str(out, i ? ", " : "");
        slab_write_number(value.w[i].f, out);
    }
}

ir_ref slab_operator_value(const struct slab_sheet *sheet, const struct slab_row *row)
{
    const struct ir_graph *g = sheet->shader->graph;
    bool has_one = row->kind != SLAB_ROW_SLAB && row->kind != SLAB_ROW_OTHER;
    return has_one && ir_get(g, row->ref)->num_args > 2 ? ir_arg(g, row->ref, 2) : 0;
}

/* ---- Slabs ---- */

static const char *regime_of(const struct ir_graph *g, ir_ref slab, bool is_body)
{
    ir_ref free_path = ir_arg(g, slab, SLAB_mean_free_path);
    if (ir_const_is(g, free_path, 0.0f))
        return "opaque";
    if (!ir_is_const(g, free_path))
        return "of a medium that varies";
    if (ir_const_is(g, ir_arg(g, slab, SLAB_diffuse_albedo), 0.0f))
        return "translucent";
    return is_body ? "thick" : "thin";
}

/* The number of the basis of a slab, from 1. */
static uint32_t note_basis(struct filler *f, ir_ref slab)
{
    bool is_even = ir_const_is(f->graph, ir_arg(f->graph, slab, SLAB_anisotropy), 0.0f);
    struct basis basis = {.normal = ir_arg(f->graph, slab, SLAB_normal),
                          .tangent = is_even ? 0 : ir_arg(f->graph, slab, SLAB_tangent)};
    for (uint32_t i = 0; i < f->bases.len; i++)
        if (f->bases.items[i].normal == basis.normal && f->bases.items[i].tangent == basis.tangent)
            return i + 1;
    vec_push(f->shader->arena, &f->bases, basis);
    f->tree->num_bases = f->bases.len;
    return f->bases.len;
}

/* True if neither the top nor an earlier row has the normal of a slab. */
static bool has_new_normal(const struct filler *f, ir_ref slab, ir_ref top)
{
    ir_ref normal = ir_arg(f->graph, slab, SLAB_normal);
    bool is_new =
        ir_get(f->graph, top)->op != IR_SLAB || ir_arg(f->graph, top, SLAB_normal) != normal;
    for (uint32_t i = 0; is_new && i < f->bases.len; i++)
        is_new = f->bases.items[i].normal != normal;
    return is_new;
}

/* The top has the word of its normal and roughness, which all pixels have. */
static uint32_t bytes_of(const struct filler *f, const struct line *line)
{
    struct slab_top top = slabs_top(f->graph, f->tree->root);
    bool is_top = line->ref == top.ref || line->is_alone,
         is_over = is_top && !line->is_alone && f->tree->cost.closures > 1,
         is_whole = is_top && (top.is_whole || line->is_alone),
         has_normal = !line->is_alone && has_new_normal(f, line->ref, top.ref);
    struct stored_slab slab = slab_stored(f->graph, line->ref, is_whole);
    uint32_t words = slab_stored_words(f->graph, &slab, is_over, has_normal);
    return SLAB_WORD_BYTES * (words + is_top);
}

static void fill_slab(struct filler *f, const struct line *line, struct slab_row *row)
{
    row->regime = regime_of(f->graph, line->ref, !line->thickness);
    row->features = slab_features(f->graph, slab_spot_at(&f->spots, line->ref, line->thickness));
    row->bytes = bytes_of(f, line);
    row->through = slabs_brightness(f->shader, f->host, line->above);
    f->tree->num_slabs++;
    row->basis = note_basis(f, line->ref);
}

/* ---- Operators ---- */

static void push(struct filler *f, const struct line *from, ir_ref ref, ir_ref thickness,
                 ir_ref above, const char *role)
{
    const struct ir_node *node = from->ref ? ir_get(f->graph, from->ref) : NULL;
    bool is_alone = !node
                    || (from->is_alone && node->op == IR_CLOSURE_MIX
                        && slab_is_choice(f->graph, ir_arg(f->graph, from->ref, 2)));
    if (ref)
        vec_push(f->shader->arena, &f->open,
                 (struct line){ref, thickness, above, from->depth + 1, role, is_alone});
}

static void fill_layer(struct filler *f, const struct line *line)
{
    struct ir_graph *g = f->shader->graph;
    ir_ref top = ir_arg(g, line->ref, 0), base = ir_arg(g, line->ref, 1);
    ir_ref thickness = slabs_layer_thickness(g, line->ref);
    ir_ref through = top && base ? slabs_through(f->shader, f->host, top, thickness) : 0;
    ir_ref below = through ? ir_op2(g, IR_MUL, line->above, through) : line->above;
    push(f, line, base, line->thickness, below, "base");
    push(f, line, top, thickness, line->above, "top");
}

static void fill_mix(struct filler *f, const struct line *line)
{
    ir_ref bg = ir_arg(f->graph, line->ref, 0), fg = ir_arg(f->graph, line->ref, 1),
           share = ir_arg(f->graph, line->ref, 2);
    if (!ir_is_const(f->graph, share))
        vec_push(f->shader->arena, &f->masks, (struct mask){share, line->ref});
    push(f, line, fg, line->thickness, line->above, bg ? "fg" : "in");
    push(f, line, bg, line->thickness, line->above, fg ? "bg" : "in");
}

static void fill_other(struct filler *f, const struct line *line)
{
    const struct ir_node *node = ir_get(f->graph, line->ref);
    for (uint32_t i = node->num_args; i-- > 0;) {
        ir_ref arg = ir_arg(f->graph, line->ref, i);
        if (ir_is_closure(f->graph, arg))
            push(f, line, arg, line->thickness, line->above, "in");
    }
}

static enum slab_row_kind kind_of(const struct ir_graph *g, ir_ref ref)
{
    switch (ir_get(g, ref)->op) {
    case IR_SLAB: return SLAB_ROW_SLAB;
    case IR_LAYER:
    case IR_SLAB_LAYER: return SLAB_ROW_LAYER;
    case IR_CLOSURE_MIX:
        return ir_arg(g, ref, 0) && ir_arg(g, ref, 1) ? SLAB_ROW_MIX : SLAB_ROW_COVERAGE;
    default: return SLAB_ROW_OTHER;
    }
}

static void fill_row(struct filler *f, const struct line *line)
{
    struct slab_row row = {.kind = kind_of(f->graph, line->ref),
                           .ref = line->ref,
                           .thickness = line->thickness,
                           .depth = line->depth,
                           .role = line->role,
                           .is_repeated = f->is_written[line->ref] != 0};
    f->is_written[line->ref] = row.kind != SLAB_ROW_SLAB; /* it has another thickness elsewhere */
    if (row.kind == SLAB_ROW_SLAB)
        fill_slab(f, line, &row);
    else if (!row.is_repeated && row.kind == SLAB_ROW_LAYER)
        fill_layer(f, line);
    else if (!row.is_repeated && row.kind != SLAB_ROW_OTHER)
        fill_mix(f, line);
    else if (!row.is_repeated)
        fill_other(f, line);
    vec_push(f->shader->arena, &f->tree->rows, row);
}

static void note_shared_masks(struct filler *f)
{
    for (uint32_t i = 0; i < f->masks.len; i++)
        for (uint32_t k = i + 1; k < f->masks.len; k++) {
            struct mask a = f->masks.items[i], b = f->masks.items[k];
            if (a.value != b.value)
                continue;
            vec_push(f->shader->arena, &f->tree->shared, (struct slab_shared){a.driven, b.driven});
            break;
        }
}

/* ---- Roots ---- */

static void fill_tree(struct filler *f, ir_ref root, ir_ref bsdf)
{
    struct ir_graph *g = f->shader->graph;
    vec_push(f->shader->arena, &f->sheet->trees, (struct slab_tree){.root = root});
    f->tree = &vec_last(&f->sheet->trees);
    ir_ref thickness = slabs_sheet_thickness(g, root);
    f->tree->is_sheet = thickness != 0;
    slabs_find_spots(g, root, f->shader->arena, &f->spots);
    f->tree->cost = slabs_cost(g, root, f->shader->arena);
    f->bases.len = f->masks.len = 0;
    ir_ref white = ir_const_splat(g, IR_TYPE_VEC3, 1.0f);
    push(f, &(struct line){.depth = 0}, bsdf, thickness, white, "");
    while (f->open.len) {
        struct line line = vec_last(&f->open);
        f->open.len--;
        fill_row(f, &line);
    }
    note_shared_masks(f);
}

/*
 * A host alone knows textures that cannot be read, its uniforms, data of its vertices. The
 * estimate has views of its own, in which the spaces of object and world are the same.
 */
static bool is_unread(const struct slab_sheet *sheet, const struct slabs_host *host,
                      const struct ir_node *node)
{
    const struct shader *shader = sheet->shader;
    if (node->op == IR_TEXTURE)
        return !(host->texels && host->texels(host->user_data, node->attr));
    if (node->op != IR_UNIFORM && node->op != IR_STREAM)
        return false;
    const struct shader_variable *variable = &shader->interface.variables.items[node->attr];
    const char *semantic = variable->semantic ? str_text(shader->strings, variable->semantic) : "";
    return node->op == IR_UNIFORM
               ? !variable->path && variable->type != IR_TYPE_MAT4
                     && variable->name != STR_u_viewPosition
               : strncmp(semantic, "geomprop:", 9) == 0 || strncmp(semantic, "color:", 6) == 0;
}

static void note_unread(struct slab_sheet *sheet, const struct slabs_host *host,
                        const uint8_t *needed, ir_ref root)
{
    for (ir_ref ref = 1; ref <= root; ref++)
        if (needed[ref] && is_unread(sheet, host, ir_get(sheet->shader->graph, ref)))
            vec_push(sheet->shader->arena, &sheet->unread, ref);
}

void slabs_fill_sheet(struct shader *shader, const struct slabs_host *host,
                      const struct slab_budget *budget, ir_ref root, struct slab_sheet *out)
{
    const struct ir_graph *g = shader->graph;
    const struct slab_budget one = {
        .max_slabs = 1, .max_error = -1.0f, .max_steps = budget->max_steps};
    *out = (struct slab_sheet){.shader = shader,
                               .body = host->closures->asks_thickness ? "mxg_thickness"
                                                                      : "u_slabThickness",
                               .is_asked = slabs_is_asked(budget)};
    slabs_budget(shader, host, out->is_asked ? budget : &one, root, &out->report);
    if (out->report.is_too_much)
        return;
    root = slabs_join_stacks(shader, host, root);
    out->is_recognised = root && !slabs_has(shader, root);
    if (out->is_recognised)
        root = slabs_recognise(shader, host, false, root);
    root = slabs_visible(shader->graph, root, shader->arena);
    if (!slabs_has(shader, root))
        return;
    struct filler f = {.sheet = out, .shader = shader, .graph = g, .host = host};
    const uint8_t *needed = ir_mark(g, &root, 1, shader->arena);
    f.is_written = ARENA_ARRAY(shader->arena, uint8_t, root + 1);
    if (out->report.steps.len)
        note_unread(out, host, needed, root);
    for (ir_ref ref = 1; ref <= root; ref++) {
        uint8_t op = ir_get(g, ref)->op;
        bool is_surface = op == IR_SLAB_SURFACE || op == IR_SURFACE_SHADER;
        if (needed[ref] && is_surface && slabs_has(shader, ir_arg(g, ref, 0)))
            fill_tree(&f, ref, ir_arg(g, ref, 0));
    }
    if (ir_is_closure(g, root))
        fill_tree(&f, root, root);
}
