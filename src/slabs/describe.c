// SPDX-License-Identifier: Apache-2.0
/*
 * The tree of slabs as text, before the walk: `mxgen inspect --slabs`. Operators are indented below
 * each other; a subtree with several uses stands once.
 */
#include "slabs/slabs.h"

#include <assert.h>

struct line {
    ir_ref ref;
    ir_ref thickness; /* 0: of the body */
    uint32_t depth;
    const char *role; /* "top", "base"; "" for roots */
};

struct tree {
    const struct shader *shader;
    const struct ir_graph *graph;
    struct text *out;
    uint8_t *is_written; /* per node */
    VEC(struct line) open;
    VEC(ir_ref) masks; /* in pairs: what drives an operator, the operator */
    VEC(ir_ref) bases; /* in pairs: normal and tangent of slabs, each pair once */
    ir_ref layer;      /* the thickness of a layer without one */
    uint32_t num_slabs;
};

static const char *name_of(const struct tree *t, ir_ref ref)
{
    uint32_t origin = ir_get(t->graph, ref)->origin;
    str_id name = t->graph->origins.items[origin].name;
    return name ? str_text(t->shader->strings, name) : "?";
}

/* A number or colour, or the name of what computes it. */
static void write_value(struct tree *t, ir_ref ref)
{
    struct ir_value value;
    const struct ir_node *node = ir_get(t->graph, ref);
    if (node->op == IR_UNIFORM) {
        const struct shader_variable *v = &t->shader->variables.items[node->attr];
        text_str(t->out, str_text(t->shader->strings, v->path ? v->path : v->name));
        return;
    }
    if (!ir_get_const(t->graph, ref, &value)) {
        text_str(t->out, name_of(t, ref));
        return;
    }
    unsigned count = ir_type_info(value.type)->components;
    bool is_splat = count == 3 && value.w[0].u == value.w[1].u && value.w[0].u == value.w[2].u;
    for (unsigned i = 0; i < (is_splat ? 1 : count); i++) {
        text_str(t->out, i ? ", " : "");
        text_float(t->out, value.w[i].f);
    }
}

static void indent(struct tree *t, const struct line *line)
{
    for (uint32_t i = 0; i < line->depth; i++)
        text_str(t->out, "  ");
    if (*line->role)
        text_fmt(t->out, "%s: ", line->role);
}

/* ---- Slabs ---- */

static const char *medium_of(const struct tree *t, ir_ref slab, bool is_body)
{
    ir_ref free_path = ir_arg(t->graph, slab, SLAB_mean_free_path);
    if (ir_const_is(t->graph, free_path, 0.0f))
        return "opaque";
    if (!ir_is_const(t->graph, free_path))
        return "of a medium that varies";
    if (ir_const_is(t->graph, ir_arg(t->graph, slab, SLAB_diffuse_albedo), 0.0f))
        return "translucent";
    return is_body ? "thick" : "thin";
}

static const struct {
    enum slab_operand input;
    float off; /* the value without the feature */
    const char *text;
} features[] = {
    {SLAB_second_roughness_weight, 0.0f, "second lobe"},
    {SLAB_fuzz_amount, 0.0f, "fuzz"},
    {SLAB_anisotropy, 0.0f, "anisotropy"},
    {SLAB_f90, 1.0f, "f90"},
    {SLAB_phase_anisotropy, 0.0f, "phase anisotropy"},
    {SLAB_emission, 0.0f, "emission"},
};

static void note_basis(struct tree *t, ir_ref normal, ir_ref tangent)
{
    for (uint32_t i = 0; i < t->bases.len; i += 2)
        if (t->bases.items[i] == normal && t->bases.items[i + 1] == tangent)
            return;
    vec_push(t->shader->arena, &t->bases, normal);
    vec_push(t->shader->arena, &t->bases, tangent);
}

static void write_slab(struct tree *t, const struct line *line)
{
    static const struct {
        enum slab_operand input;
        const char *text;
    } shown[] = {{SLAB_diffuse_albedo, "albedo"},
                 {SLAB_f0, "f0"},
                 {SLAB_roughness, "roughness"},
                 {SLAB_mean_free_path, "mean free path"}};
    bool is_opaque = ir_const_is(t->graph, ir_arg(t->graph, line->ref, SLAB_mean_free_path), 0.0f);
    text_fmt(t->out, "slab %s, %s", name_of(t, line->ref),
             medium_of(t, line->ref, !line->thickness));
    text_str(t->out, is_opaque ? "" : ", thickness ");
    if (!is_opaque && line->thickness)
        write_value(t, line->thickness);
    else if (!is_opaque)
        text_str(t->out, "u_slabThickness");
    for (size_t i = 0; i < sizeof shown / sizeof *shown; i++) {
        text_fmt(t->out, "; %s ", shown[i].text);
        write_value(t, ir_arg(t->graph, line->ref, shown[i].input));
    }
    for (size_t i = 0; i < sizeof features / sizeof *features; i++)
        if (!ir_const_is(t->graph, ir_arg(t->graph, line->ref, features[i].input), features[i].off))
            text_fmt(t->out, "; %s", features[i].text);
    text_char(t->out, '\n');
    note_basis(t, ir_arg(t->graph, line->ref, SLAB_normal),
               ir_const_is(t->graph, ir_arg(t->graph, line->ref, SLAB_anisotropy), 0.0f)
                   ? 0
                   : ir_arg(t->graph, line->ref, SLAB_tangent));
    t->num_slabs++;
}

/* ---- Operators ---- */

static void push(struct tree *t, const struct line *from, ir_ref ref, ir_ref thickness,
                 const char *role)
{
    if (ref)
        vec_push(t->shader->arena, &t->open, (struct line){ref, thickness, from->depth + 1, role});
}

static void write_layer(struct tree *t, const struct line *line)
{
    const struct ir_node *node = ir_get(t->graph, line->ref);
    ir_ref thickness = node->op == IR_SLAB_LAYER ? ir_arg(t->graph, line->ref, 2) : 0;
    text_fmt(t->out, "layer %s, thickness ", name_of(t, line->ref));
    if (thickness)
        write_value(t, thickness);
    else
        text_float(t->out, SLABS_LAYER_THICKNESS);
    text_char(t->out, '\n');
    push(t, line, ir_arg(t->graph, line->ref, 1), line->thickness, "base");
    push(t, line, ir_arg(t->graph, line->ref, 0), thickness ? thickness : t->layer, "top");
}

static void write_mix(struct tree *t, const struct line *line)
{
    ir_ref bg = ir_arg(t->graph, line->ref, 0), fg = ir_arg(t->graph, line->ref, 1),
           share = ir_arg(t->graph, line->ref, 2);
    text_fmt(t->out, "%s %s, %s ", bg && fg ? "mix" : "coverage", name_of(t, line->ref),
             bg && fg ? "share of fg" : "weight");
    write_value(t, share);
    text_char(t->out, '\n');
    if (!ir_is_const(t->graph, share)) {
        vec_push(t->shader->arena, &t->masks, share);
        vec_push(t->shader->arena, &t->masks, line->ref);
    }
    push(t, line, fg, line->thickness, bg ? "fg" : "in");
    push(t, line, bg, line->thickness, fg ? "bg" : "in");
}

static void write_other(struct tree *t, const struct line *line)
{
    const struct ir_node *node = ir_get(t->graph, line->ref);
    text_fmt(t->out, "%s %s, no slab\n", ir_op_info((enum ir_op)node->op)->text,
             name_of(t, line->ref));
    for (uint32_t i = node->num_args; i-- > 0;) {
        ir_ref arg = ir_arg(t->graph, line->ref, i);
        if (arg && ir_type_is_closure(ir_type_of(t->graph, arg)))
            push(t, line, arg, line->thickness, "in");
    }
}

static void write_line(struct tree *t, const struct line *line)
{
    uint8_t op = ir_get(t->graph, line->ref)->op;
    indent(t, line);
    if (t->is_written[line->ref]) {
        text_fmt(t->out, "%s, as above\n", name_of(t, line->ref));
        return;
    }
    t->is_written[line->ref] = op != IR_SLAB; /* a slab has another thickness elsewhere */
    if (op == IR_SLAB)
        write_slab(t, line);
    else if (op == IR_LAYER || op == IR_SLAB_LAYER)
        write_layer(t, line);
    else if (op == IR_CLOSURE_MIX)
        write_mix(t, line);
    else
        write_other(t, line);
}

/* Operators that one value drives: the walk takes them as independent. */
static void write_shared_masks(struct tree *t)
{
    for (uint32_t i = 0; i < t->masks.len; i += 2)
        for (uint32_t k = i + 2; k < t->masks.len; k += 2)
            if (t->masks.items[i] == t->masks.items[k]) {
                text_fmt(t->out, "  %s and %s share a mask, but count as independent\n",
                         name_of(t, t->masks.items[i + 1]), name_of(t, t->masks.items[k + 1]));
                break;
            }
}

/* ---- Roots ---- */

static void write_root(struct tree *t, ir_ref ref, ir_ref bsdf)
{
    struct ir_value thin = {.type = IR_TYPE_VOID};
    bool is_root = ir_get(t->graph, ref)->op == IR_SLAB_SURFACE;
    bool is_sheet =
        is_root && ir_get_const(t->graph, ir_arg(t->graph, ref, 1), &thin) && thin.w[0].u;
    text_fmt(t->out, "%s, %s\n", name_of(t, ref), is_sheet ? "a sheet" : "a body");
    t->num_slabs = t->bases.len = t->masks.len = 0;
    struct line root = {.depth = 0};
    push(t, &root, bsdf, is_sheet ? ir_arg(t->graph, ref, 2) : 0, "");
    while (t->open.len) {
        struct line line = vec_last(&t->open);
        t->open.len--;
        write_line(t, &line);
    }
    write_shared_masks(t);
    text_fmt(t->out, "  %u slabs, %u tangent bases\n", (unsigned)t->num_slabs,
             (unsigned)t->bases.len / 2);
}

void slabs_describe(const struct shader *shader, ir_ref root, struct text *out)
{
    const struct ir_graph *g = shader->graph;
    struct tree t = {.shader = shader, .graph = g, .out = out};
    t.layer = ir_const_float(shader->graph, SLABS_LAYER_THICKNESS);
    size_t before = out->len;
    const uint8_t *needed = ir_mark(g, &root, 1, shader->arena);
    t.is_written = ARENA_ARRAY(shader->arena, uint8_t, root + 1);
    assert(root < g->nodes.len);
    for (ir_ref ref = 1; root && ref <= root; ref++) {
        uint8_t op = ir_get(g, ref)->op;
        bool is_surface = op == IR_SLAB_SURFACE || op == IR_SURFACE_SHADER;
        if (needed[ref] && is_surface && slabs_has(shader, ir_arg(g, ref, 0)))
            write_root(&t, ref, ir_arg(g, ref, 0));
    }
    if (root && ir_type_is_closure(ir_type_of(g, root)) && slabs_has(shader, root))
        write_root(&t, root, root);
    if (out->len == before)
        text_str(out, "no slabs\n");
}
