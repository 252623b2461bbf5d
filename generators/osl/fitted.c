// SPDX-License-Identifier: Apache-2.0
/*
 * A BSDF that OSL has no closure for becomes a sum of closures, found by evaluating its functions
 * (closure_fit.h). An input that only scales the light stays an input; any other is compiled in.
 */
#include "generators/osl/closure_fit.h"
#include "generators/osl/closure_tree.h"

#include "ir/arithmetic.h"
#include "lower/lower.h"
#include "shader/formula.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

/* A sum that sends more of the light elsewhere is another material. */
#define MOST_ERROR 0.3
#define SAME 1e-4

enum { MAX_OPERANDS = 64, NUM_TRIES = 6 };

/* The leaf in a frame whose third axis is the normal, seen from a direction that is a variable. */
struct subject {
    struct osl_tree *tree;
    ir_ref leaf;
    unsigned num_inputs;
    struct ir_value values[MAX_OPERANDS]; /* of inputs that are numbers */
    bool is_number[MAX_OPERANDS], is_known[MAX_OPERANDS];
    ir_ref normal, tangent; /* of the leaf; 0: it has none */
    ir_ref view, light, turned, value, passed;
    struct ir_value view_value, light_value, turned_value;
};

/* ---- Evaluation ---- */

static struct ir_value vector(double x, double y, double z)
{
    return (struct ir_value){.type = IR_TYPE_VEC3,
                             .w = {{.f = (float)x}, {.f = (float)y}, {.f = (float)z}}};
}

static bool source(void *user_data, const struct ir_graph *graph, ir_ref ref, struct ir_value *out)
{
    const struct subject *s = user_data;
    const struct ir_node *node = ir_get(graph, ref);
    if (node->op == IR_LOCAL) {
        *out = ref == s->view ? s->view_value : ref == s->light ? s->light_value : s->turned_value;
        return true;
    }
    if (node->op != IR_UNIFORM)
        return false;
    *out = s->tree->shader->interface.variables.items[node->attr].value;
    return out->type == node->type;
}

static uint32_t call(void *user_data, const struct ir_graph *graph, ir_ref ref,
                     const struct ir_value *args, struct ir_value *out)
{
    struct subject *s = user_data;
    return lang_eval_node(s->tree->shader->unit, graph, ref, args, &(uint32_t){LANG_MAX_STEPS},
                          s->tree->host->scratch, out);
}

static bool evaluate(struct subject *s, ir_ref value, struct ir_value *out)
{
    const struct ir_eval_env env = {.user_data = s, .source = source, .call = call};
    bool good = ir_eval(s->tree->graph, value, &env, s->tree->host->scratch, out);
    arena_finish(s->tree->host->scratch);
    return good;
}

/* The leaf with numbers as inputs. */
static ir_ref leaf_of_values(struct subject *s)
{
    struct ir_graph *g = s->tree->graph;
    const struct ir_node node = *ir_get(g, s->leaf);
    ir_ref *args = ARENA_ARRAY(s->tree->shader->arena, ir_ref, node.num_args);
    const struct ir_value up = vector(0.0, 0.0, 1.0);
    args[0] = ir_const_float(g, 1.0f);
    for (unsigned i = 0; i < s->num_inputs; i++) {
        ir_ref own = ir_arg(g, s->leaf, i + 1);
        args[i + 1] = own == s->normal    ? ir_const(g, &up)
                      : own == s->tangent ? s->turned
                      : s->is_number[i]   ? ir_const(g, &s->values[i])
                                          : own;
    }
    return ir_build(g, IR_LEAF, node.type, node.attr, args, node.num_args);
}

/* Makes the nodes of the light that the leaf sends to the viewer, for the values as they are. */
static void look(struct subject *s)
{
    struct osl_tree *t = s->tree;
    struct ir_graph *g = t->graph;
    struct ir_value up = vector(0.0, 0.0, 1.0), here = vector(0.0, 0.0, 0.0);
    struct closure_probe probe;
    closure_probe(t->host, s->view, &probe);
    probe.point.normal = ir_const(g, &up);
    probe.point.position = ir_const(g, &here);
    ir_ref leaf = leaf_of_values(s);
    s->value = closure_call(t->shader, &probe.host, leaf, LEAF_EVAL, &s->light);
    s->passed = closure_call(t->shader, &probe.host, leaf, LEAF_REFRACTION, &s->light);
}

static bool value(void *user_data, const double v[3], const double l[3], unsigned turn,
                  double out[3])
{
    struct subject *s = user_data;
    struct ir_value known = {.type = IR_TYPE_VEC3};
    double angle = 0.78539816339744831 * turn;
    ir_ref asked = l[2] < 0.0 ? s->passed : s->value;
    s->view_value = vector(v[0], v[1], v[2]);
    s->light_value = vector(l[0], l[1], l[2]);
    s->turned_value = vector(cos(angle), sin(angle), 0.0);
    if (asked && !evaluate(s, asked, &known))
        return false;
    for (unsigned c = 0; c < 3; c++)
        out[c] = (double)known.w[c].f;
    return true;
}

/* ---- Inputs ---- */

static struct ir_value all(ir_type_id type, float number)
{
    return (struct ir_value){.type = type,
                             .w = {{.f = number}, {.f = number}, {.f = number}, {.f = number}}};
}

static void open_subject(struct osl_tree *t, ir_ref leaf, struct subject *s)
{
    const struct ir_node node = *ir_get(t->graph, leaf);
    *s = (struct subject){.tree = t, .leaf = leaf};
    s->view = closure_probe_direction(t->graph, 0);
    s->light = closure_probe_direction(t->graph, 1);
    s->turned = closure_probe_direction(t->graph, 2);
    s->num_inputs = node.num_args - 1;
    for (unsigned i = 0; i < s->num_inputs && i < MAX_OPERANDS; i++) {
        ir_ref own = ir_arg(t->graph, leaf, i + 1);
        const char *name = t->host->leaf_input(t->host->user_data, node.attr, i);
        ir_type_id type = ir_type_of(t->graph, own);
        if (type == IR_TYPE_VEC3 && strcmp(name, "normal") == 0)
            s->normal = own;
        if (type == IR_TYPE_VEC3 && strcmp(name, "tangent") == 0)
            s->tangent = own;
        s->is_number[i] = own != s->normal && own != s->tangent && type != IR_TYPE_STRING;
        s->is_known[i] = !s->is_number[i] || evaluate(s, own, &s->values[i]);
        if (!s->is_known[i])
            s->values[i] = all(type, 0.5f);
    }
}

/* True if input i scales the light: three numbers give the light of 1 times themselves. */
static bool only_scales(struct subject *s, unsigned i)
{
    static const double ways[NUM_TRIES][6] = {
        {0.6, 0, 0.8, -0.6, 0, 0.8},       {0.6, 0, 0.8, 0.48, 0.64, 0.6},
        {0.8, 0, 0.6, -0.28, 0, 0.96},     {0, 0, 1, 0.28, 0.768, 0.576},
        {0.96, 0, 0.28, -0.8, 0.36, 0.48}, {0.6, 0, 0.8, 0.6, 0, -0.8},
    };
    static const float factors[3] = {0.2f, 0.55f, 0.9f};
    struct ir_value kept = s->values[i];
    bool is_color = kept.type == IR_TYPE_VEC3, scales = is_color || kept.type == IR_TYPE_FLOAT;
    double whole[NUM_TRIES][3], part[3];
    if (!scales)
        return false;
    s->values[i] = all(kept.type, 1.0f);
    look(s);
    double light = 0.0;
    for (unsigned k = 0; k < NUM_TRIES && scales; k++) {
        scales = value(s, ways[k], ways[k] + 3, 1, whole[k]);
        light += whole[k][0] + whole[k][1] + whole[k][2];
    }
    scales &= light > 0.0; /* else another input takes all */
    for (unsigned c = 0; c < 3; c++)
        s->values[i].w[c].f = factors[c];
    look(s);
    for (unsigned k = 0; k < NUM_TRIES && scales; k++) {
        scales = value(s, ways[k], ways[k] + 3, 1, part);
        for (unsigned c = 0; c < 3; c++) {
            double expected = whole[k][c] * (double)factors[is_color ? c : 0];
            scales &= fabs(part[c] - expected) <= SAME * (fabs(expected) + SAME);
        }
    }
    s->values[i] = scales ? all(kept.type, 1.0f) : kept;
    return scales;
}

/* An edit of these inputs needs a new shader. In networks the list of layers has their values. */
static void compile_in(struct osl_tree *t, ir_ref below)
{
    const uint8_t *needed = ir_mark(t->graph, &below, 1, t->shader->arena);
    for (ir_ref ref = 1; ref <= below; ref++) {
        const struct ir_node *node = ir_get(t->graph, ref);
        if (!needed[ref] || node->op != IR_UNIFORM)
            continue;
        struct shader_variable *v = &t->shader->interface.variables.items[node->attr];
        if (v->update == UPDATE_SHADER || !v->path || !v->has_default)
            continue;
        v->update = UPDATE_SHADER;
        struct shader_compiled_input input = {v->element, v->definition, v->doc_type};
        vec_push(t->shader->arena, &t->shader->reflection.compiled, input);
    }
}

/* Notes what keeps the leaf from having closures. */
static void lack(struct subject *s, const char *format, ...)
{
    struct osl_tree *t = s->tree;
    str_id family = t->graph->callees.items[ir_get(t->graph, s->leaf)->attr].name;
    struct text text;
    text_init(&text, t->shader->arena);
    text_fmt(&text, "no closure for '%s', and ", str_text(t->shader->strings, family));
    va_list args;
    va_start(args, format);
    text_vfmt(&text, format, args);
    va_end(args);
    t->lacks = text_cstr(&text);
}

/* The product of the inputs that scale the light; 0: 1. False, and t->lacks, if another varies. */
static bool settle_inputs(struct subject *s, ir_ref *out_factor)
{
    struct osl_tree *t = s->tree;
    *out_factor = 0;
    for (unsigned i = 0; i < s->num_inputs; i++) {
        ir_ref own = ir_arg(t->graph, s->leaf, i + 1);
        if (s->is_number[i] && only_scales(s, i)) {
            *out_factor = ir_product(t->graph, *out_factor, own);
        } else if (s->is_known[i]) {
            compile_in(t, own);
        } else {
            uint32_t callee = ir_get(t->graph, s->leaf)->attr;
            lack(s,
                 "its input '%s' varies: a sum of closures is found for constants, and for factors "
                 "of the light",
                 t->host->leaf_input(t->host->user_data, callee, i));
            return false;
        }
    }
    look(s);
    return true;
}

/* ---- Closures ---- */

/* The weight of a part in a channel at the view. */
static ir_ref weight_in(struct osl_tree *t, const struct osl_part *part, unsigned channel,
                        ir_ref cosine)
{
    ir_ref args[1 + OSL_KNOTS] = {cosine};
    bool is_even = true;
    for (unsigned i = 0; i < OSL_KNOTS; i++) {
        float weight = part->weights[i][channel];
        is_even &= weight == part->weights[0][channel];
        args[1 + i] = ir_const_float(t->graph, weight);
    }
    return is_even ? args[1] : shader_formula(t->shader, "mx_between", args, 1 + OSL_KNOTS);
}

static ir_ref weight_of(struct osl_tree *t, const struct osl_part *part, ir_ref cosine)
{
    ir_ref channels[3];
    for (unsigned c = 0; c < 3; c++)
        channels[c] = weight_in(t, part, c, cosine);
    bool is_grey = channels[0] == channels[1] && channels[0] == channels[2];
    return is_grey ? channels[0] : ir_construct(t->graph, IR_TYPE_VEC3, channels, 3);
}

/* A white closure of the shape of a lobe. */
static ir_ref closure_of_lobe(struct osl_tree *t, const struct lobe *lobe, ir_ref normal)
{
    struct ir_graph *g = t->graph;
    ir_ref white = ir_white(g), roughness = ir_const_float(g, lobe->roughness);
    ir_ref few[3] = {normal, white, roughness};
    if (lobe->shape == LOBE_THROUGH)
        return osl_call(t, "translucent_bsdf", IR_TYPE_BSDF, few, 2);
    if (lobe->shape == LOBE_SHEEN)
        return osl_call(t, "sheen_bsdf", IR_TYPE_BSDF, few, 3);
    if (lobe->shape == LOBE_DIFFUSE || lobe->shape == LOBE_ROUGH_DIFFUSE)
        return osl_call(t, "oren_nayar_diffuse_bsdf", IR_TYPE_BSDF, few, 3);
    ir_ref tangent = shader_stream(t->shader, STR_tangentWorld, IR_TYPE_VEC3);
    ir_ref ggx = ir_const_string(g, str_intern_z(t->shader->strings, "ggx"));
    ir_ref facing = lobe->shape == LOBE_RETRO ? closure_view(t->shader, t->host) : normal;
    ir_ref args[] = {facing,      tangent,   white,
                     ir_black(g), roughness, roughness,
                     white,       white,     ir_const_float(g, 5.0f),
                     ggx};
    return osl_call(t, "generalized_schlick_bsdf", IR_TYPE_BSDF, args, sizeof args / sizeof *args);
}

static ir_ref sum_of_parts(struct subject *s, const struct osl_fit *fit)
{
    struct osl_tree *t = s->tree;
    ir_ref normal = s->normal ? s->normal : closure_normal(t->shader, t->host), sum = 0;
    ir_ref view = closure_view(t->shader, t->host);
    ir_ref cosine = ir_op1(t->graph, IR_ABS, ir_op2(t->graph, IR_DOT, normal, view));
    for (unsigned i = 0; i < fit->num; i++) {
        ir_ref part = closure_of_lobe(t, fit->parts[i].lobe, normal);
        sum = osl_sum(t, sum, osl_scaled(t, part, weight_of(t, &fit->parts[i], cosine)));
    }
    return sum;
}

ir_ref osl_fitted(struct osl_tree *t, ir_ref leaf)
{
    struct subject s;
    struct osl_fit fit;
    ir_ref factor;
    open_subject(t, leaf, &s);
    if (!settle_inputs(&s, &factor))
        return 0;
    struct osl_target target = {.user_data = &s,
                                .value = value,
                                .num_turns = s.tangent ? OSL_MAX_TURNS : 1,
                                .passes = s.passed && !ir_const_is(t->graph, s.passed, 0.0f)};
    if (!osl_fit(&target, t->shader->arena, &fit)) {
        lack(&s, "its functions cannot be evaluated without a shader");
        return 0;
    }
    if (fit.error > MOST_ERROR) {
        char share[16];
        snprintf(share, sizeof share, "%.0f", 100.0 * fit.error);
        lack(&s, "the closest sum of closures sends %s %% of its light elsewhere", share);
        return 0;
    }
    struct shader_stand_in made = {ir_get(t->graph, leaf)->origin, fit.num, fit.error};
    vec_push(t->shader->arena, &t->shader->reflection.stand_ins, made);
    return osl_scaled(t, sum_of_parts(&s, &fit), factor);
}
