// SPDX-License-Identifier: Apache-2.0
/*
 * Weights as text for people: `SR/coat * mix(...)`. A uniform has the path of its input. What is
 * deep inside has its name, or the name of its function; the text is not meant to be read back.
 */
#include "closure/closure_priv.h"

#include "print/print.h"

#include <assert.h>

enum {
    MAX_DEPTH = 5,   /* of operators; below, names stand for expressions */
    MAX_TEXT = 200,  /* bytes, after which an expression ends with names */
    PREC_LOWEST = 0, /* no parentheses */
};

struct describer {
    const struct shader *shader;
    const struct ir_graph *graph;
    struct text *out;
    size_t start;
};

static void describe(struct describer *d, ir_ref ref, unsigned depth, unsigned precedence);

static const char *name_of(const struct describer *d, str_id name)
{
    return str_text(d->shader->strings, name);
}

static void describe_value(struct describer *d, const struct ir_value *value)
{
    const struct ir_type_info *type = ir_type_info(value->type);
    unsigned count = type->components;
    bool is_splat = true;
    for (unsigned i = 1; i < count; i++)
        is_splat &= value->w[i].u == value->w[0].u;
    count = is_splat ? 1 : count;
    if (count > 4) { /* a matrix */
        text_str(d->out, type->text);
        return;
    }
    text_str(d->out, count > 1 ? "(" : "");
    for (unsigned i = 0; i < count; i++) {
        text_str(d->out, i ? ", " : "");
        if (type->scalar == IR_TYPE_FLOAT)
            text_float(d->out, value->w[i].f);
        else if (type->scalar == IR_TYPE_BOOL)
            text_str(d->out, value->w[i].u ? "true" : "false");
        else
            text_fmt(d->out, "%d", (int)value->w[i].i);
    }
    text_str(d->out, count > 1 ? ")" : "");
}

/* The name of what a node computes, without its operands. */
static void describe_name(struct describer *d, ir_ref ref)
{
    const struct ir_node *node = ir_get(d->graph, ref);
    const struct ir_label *label = &d->graph->labels.items[ref];
    str_id origin = d->graph->origins.items[node->origin].name;
    if (label->name)
        text_str(d->out, name_of(d, label->name));
    else if (origin)
        text_fmt(d->out, "%s(…)", name_of(d, origin));
    else
        text_fmt(d->out, "%s(…)", ir_op_info((enum ir_op)node->op)->text);
}

static void describe_args(struct describer *d, ir_ref ref, const char *name, unsigned depth)
{
    const struct ir_node *node = ir_get(d->graph, ref);
    text_fmt(d->out, "%s(", name);
    for (unsigned i = 0; i < node->num_args; i++) {
        text_str(d->out, i ? ", " : "");
        describe(d, ir_arg(d->graph, ref, i), depth, PREC_LOWEST);
    }
    text_char(d->out, ')');
}

static void describe_swizzle(struct describer *d, ir_ref ref, unsigned depth)
{
    uint32_t attr = ir_get(d->graph, ref)->attr;
    describe(d, ir_arg(d->graph, ref, 0), depth, LANG_PREC_POSTFIX);
    text_char(d->out, '.');
    for (unsigned i = 0; i < attr >> 8; i++)
        text_char(d->out, "xyzw"[attr >> (2 * i) & 3]);
}

/* An op by its form: "$0 * $1". */
static void describe_form(struct describer *d, ir_ref ref, const struct lang_form *form,
                          unsigned depth, unsigned precedence)
{
    bool is_inside = form->infix && form->precedence < precedence;
    text_str(d->out, is_inside ? "(" : "");
    for (const char *c = form->text; *c; c++) {
        if (*c == '$' && c[1] >= '0' && c[1] <= '9') {
            unsigned arg = (unsigned)(*++c - '0');
            if (arg < ir_get(d->graph, ref)->num_args)
                describe(d, ir_arg(d->graph, ref, arg), depth,
                         form->infix ? form->precedence + (arg > 0 ? 1u : 0u) : PREC_LOWEST);
        } else if (*c == '$' && c[1]) {
            c++; /* a type */
        } else {
            text_char(d->out, *c);
        }
    }
    text_str(d->out, is_inside ? ")" : "");
}

static void describe(struct describer *d, ir_ref ref, unsigned depth, unsigned precedence)
{
    const struct ir_node *node = ir_get(d->graph, ref);
    const struct lang_form *form = lang_syntax_form(&lang_syntax_portable, (enum ir_op)node->op);
    struct ir_value value;
    if (ir_get_const(d->graph, ref, &value)) {
        describe_value(d, &value);
        return;
    }
    bool is_deep = depth >= MAX_DEPTH || d->out->len - d->start > MAX_TEXT;
    switch ((enum ir_op)node->op) {
    case IR_UNIFORM:
    case IR_STREAM:
    case IR_TEXTURE: {
        assert(node->attr < d->shader->interface.variables.len);
        const struct shader_variable *v = &d->shader->interface.variables.items[node->attr];
        text_str(d->out, name_of(d, v->path ? v->path : v->name));
        return;
    }
    case IR_CONVERT: describe(d, ir_arg(d->graph, ref, 0), depth, precedence); return;
    case IR_CONSTRUCT:
        if (node->num_args == 1)
            describe(d, ir_arg(d->graph, ref, 0), depth, precedence);
        else if (is_deep)
            describe_name(d, ref);
        else
            describe_args(d, ref, "", depth + 1);
        return;
    case IR_SWIZZLE: describe_swizzle(d, ref, depth); return;
    case IR_CALL:
        if (is_deep)
            describe_name(d, ref);
        else
            describe_args(d, ref, name_of(d, d->graph->callees.items[node->attr].name), depth + 1);
        return;
    case IR_RESULT: describe(d, ir_arg(d->graph, ref, 0), depth, precedence); return;
    default: break;
    }
    if (is_deep || !form || !form->text)
        describe_name(d, ref);
    else
        describe_form(d, ref, form, depth + 1, precedence);
}

void closure_describe_weight(const struct shader *shader, const struct closure_leaf *leaf,
                             struct text *out)
{
    struct describer d = {shader, shader->graph, out, out->len};
    struct ir_value value;
    bool is_one =
        leaf->color && ir_get_const(d.graph, leaf->scalar, &value) && value.w[0].f == 1.0f;
    if (!is_one)
        describe(&d, leaf->scalar, 0, leaf->color ? LANG_PREC_PRODUCT : PREC_LOWEST);
    if (!leaf->color)
        return;
    text_str(out, is_one ? "" : " * ");
    text_str(out, leaf->steady ? "(" : "");
    d.start = out->len;
    if (leaf->steady) {
        describe(&d, leaf->steady, 0, PREC_LOWEST);
        text_str(out, " + ");
        d.start = out->len;
    }
    describe(&d, leaf->color, 0, is_one && !leaf->decay ? PREC_LOWEST : LANG_PREC_PRODUCT);
    if (leaf->decay) {
        text_str(out, " * ");
        d.start = out->len;
        describe(&d, leaf->decay, 0, LANG_PREC_POSTFIX);
        text_str(out, leaf->steady ? "^way)" : "^way");
    }
}

/* ---- All leaves ---- */

static void describe_list(struct shader *shader, const struct closure_host *host, ir_ref root,
                          struct text *out)
{
    struct closure_list list;
    closure_flatten(shader, host, root, &list);
    for (uint32_t i = 0; i < list.leaves.len; i++) {
        const struct ir_node *node = ir_get(shader->graph, list.leaves.items[i].leaf);
        const struct ir_origin *origin = &shader->graph->origins.items[node->origin];
        size_t begin = out->len;
        text_fmt(out, "  %-24s %-32s weight ", str_text(shader->strings, origin->name),
                 str_text(shader->strings, shader->graph->callees.items[node->attr].name));
        closure_describe_weight(shader, &list.leaves.items[i], out);
        text_show(out, begin);
        text_char(out, '\n');
    }
}

void closure_describe(struct shader *shader, const struct closure_host *host, ir_ref root,
                      struct text *out)
{
    const struct ir_graph *g = shader->graph;
    if (root && ir_get(g, root)->op == IR_MATERIAL)
        root = ir_arg(g, root, ir_arg(g, root, 3) ? 3 : 0);
    if (!root)
        return;
    ir_type_id type = ir_type_of(g, root);
    struct closure_surface s = closure_surface_of(shader, host, type == IR_TYPE_SURFACE ? root : 0);
    if (type == IR_TYPE_BSDF)
        s.bsdf = root;
    if (type == IR_TYPE_EDF)
        s.edf = root;
    if (type == IR_TYPE_VOLUME || type == IR_TYPE_VDF) {
        struct closure_volume volume;
        closure_volume(shader, host, root, &volume);
        text_str(out, "vdf\n");
        describe_list(shader, host, volume.vdf, out);
        s.edf = volume.edf;
    }
    text_str(out, "bsdf\n");
    describe_list(shader, host, s.bsdf, out);
    text_str(out, "edf\n");
    describe_list(shader, host, s.edf, out);
}
