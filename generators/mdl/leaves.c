// SPDX-License-Identifier: Apache-2.0
/* Leaves become closures of MDL: rows of closures.def are texts with the names of inputs. */
#include "generators/mdl/closure_tree.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"

#include <assert.h>

/* ---- The table ---- */

enum leaf_input {
#define INPUT(name) INPUT_##name,
#include "generators/mdl/closures.def"
    NUM_INPUTS,
};

static const char *const input_names[NUM_INPUTS] = {
#define INPUT(name) #name,
#include "generators/mdl/closures.def"
};

struct row {
    const char *family, *mode, *form;
};

static const struct row lobes[] = {
#define LOBE(leaf, mode, ...) {"mx_" #leaf, mode, __VA_ARGS__},
#include "generators/mdl/closures.def"
    {NULL, NULL, NULL}};
static const struct row retros[] = {
#define RETRO(leaf, ...) {"mx_" #leaf, "", __VA_ARGS__},
#include "generators/mdl/closures.def"
    {NULL, NULL, NULL}};
static const struct row covers[] = {
#define COVER(leaf, mode, ...) {"mx_" #leaf, mode, __VA_ARGS__},
#include "generators/mdl/closures.def"
    {NULL, NULL, NULL}};

/* ---- Inputs of the current leaf ---- */

struct leaf {
    struct mdl_tree *tree;
    ir_ref ref, weight;
    const char *family, *mode; /* mode: "R", "T" or "RT" */
    ir_ref inputs[NUM_INPUTS]; /* 0: the leaf lacks this input */
    ir_ref lobe, base;         /* for forms; 0: none */
};

ir_ref mdl_leaf_input(const struct mdl_tree *t, ir_ref leaf, const char *wanted)
{
    const struct ir_node *node = ir_get(t->graph, leaf);
    for (unsigned i = 0; i + 1u < node->num_args; i++) {
        const char *name = t->host->leaf_input(t->host->user_data, node->attr, i);
        if (name && strcmp(name, wanted) == 0)
            return ir_arg(t->graph, leaf, i + 1);
    }
    return 0;
}

/* A constant string; NULL: it is none. */
static const char *word_of(const struct mdl_tree *t, ir_ref value)
{
    struct ir_value constant;
    bool is_word =
        value && ir_get_const(t->graph, value, &constant) && constant.type == IR_TYPE_STRING;
    return is_word ? str_text(t->shader->strings, constant.w[0].u) : NULL;
}

static bool is_false(const struct mdl_tree *t, ir_ref value)
{
    struct ir_value constant;
    return !value || (ir_get_const(t->graph, value, &constant) && constant.w[0].u == 0);
}

/* True if a value is divided by what the weight is made of. */
static bool divides_by(const struct mdl_tree *t, ir_ref weight, ir_ref value)
{
    const uint8_t *of_weight = ir_mark(t->graph, &weight, 1, t->shader->arena),
                  *needed = ir_mark(t->graph, &value, 1, t->shader->arena);
    for (ir_ref ref = 1; ref <= value; ref++) {
        if (!needed[ref] || ir_get(t->graph, ref)->op != IR_DIV)
            continue;
        ir_ref divisor = ir_arg(t->graph, ref, 1);
        if (divisor <= weight && of_weight[divisor] && !ir_is_const(t->graph, divisor))
            return true;
    }
    return false;
}

/*
 * Graphs divide by the weight of a closure, such as for a colour without its intensity. A weight of
 * 0 does not hide what that gives: in MDL it is no number.
 */
static void define_inputs(struct leaf *leaf)
{
    struct ir_graph *g = leaf->tree->graph;
    ir_ref zero = ir_const_float(g, 0.0f);
    if (ir_is_const(g, leaf->weight))
        return;
    for (unsigned i = 0; i < NUM_INPUTS; i++) {
        ir_ref value = leaf->inputs[i];
        ir_type_id type = value ? ir_type_of(g, value) : IR_TYPE_VOID;
        if (!value || !ir_type_is_float(type) || !divides_by(leaf->tree, leaf->weight, value))
            continue;
        ir_ref args[3] = {ir_op2(g, IR_GT, leaf->weight, zero), value,
                          ir_const_splat(g, type, 0.0f)};
        leaf->inputs[i] = ir_build(g, IR_SELECT, type, 0, args, 3);
    }
}

static struct leaf leaf_of(struct mdl_tree *t, ir_ref ref)
{
    const struct ir_node node = *ir_get(t->graph, ref);
    struct leaf leaf = {.tree = t, .ref = ref, .weight = ir_arg(t->graph, ref, 0)};
    leaf.family = str_text(t->shader->strings, t->graph->callees.items[node.attr].name);
    for (unsigned i = 0; i < NUM_INPUTS; i++)
        leaf.inputs[i] = mdl_leaf_input(t, ref, input_names[i]);
    const char *mode = word_of(t, leaf.inputs[INPUT_scatter_mode]);
    leaf.mode = mode ? mode : "R";
    define_inputs(&leaf);
    return leaf;
}

static const char *find(const struct row *row, const struct leaf *leaf)
{
    for (; row->family; row++)
        if (strcmp(row->family, leaf->family) == 0
            && (!*row->mode || strcmp(row->mode, leaf->mode) == 0))
            return row->form;
    return NULL;
}

/* ---- Forms ---- */

struct writer {
    struct leaf *leaf;
    struct text text;
    ir_ref args[8];
    unsigned num_args;
};

/* Constants of a colour are numbers: "color(0.8, 0.2, 0.1)". */
static bool put_constant(struct writer *w, ir_ref value)
{
    struct ir_value constant;
    size_t len = strlen(MDL_COLOR);
    bool is_color =
        w->text.len >= len && memcmp(w->text.data + w->text.len - len, MDL_COLOR, len) == 0;
    if (!is_color || !ir_get_const(w->leaf->tree->graph, value, &constant)
        || constant.type != IR_TYPE_VEC3)
        return false;
    const union ir_word *words = constant.w;
    unsigned n = words[0].u == words[1].u && words[0].u == words[2].u ? 1 : 3;
    for (unsigned i = 0; i < n; i++) {
        text_str(&w->text, i ? ", " : "");
        text_float(&w->text, words[i].f);
    }
    return true;
}

static void put_value(struct writer *w, ir_ref value)
{
    if (put_constant(w, value))
        return;
    assert(value && w->num_args < sizeof w->args / sizeof *w->args);
    text_fmt(&w->text, "$%u", w->num_args);
    w->args[w->num_args++] = value;
}

static void put_normal(struct writer *w)
{
    struct mdl_tree *t = w->leaf->tree;
    ir_ref normal = w->leaf->inputs[INPUT_normal];
    ir_ref own =
        ir_op1(t->graph, IR_NORMALIZE, shader_stream(t->shader, STR_normalWorld, IR_TYPE_VEC3));
    if (!normal || normal == own)
        return;
    text_str(&w->text, ", normal: mdl_normal_to_internal(");
    put_value(w, normal);
    text_char(&w->text, ')');
}

static ir_ref part(const struct writer *w, enum leaf_input input, unsigned index)
{
    return ir_component(w->leaf->tree->graph, w->leaf->inputs[input], index);
}

static void put_tangent(struct writer *w)
{
    ir_ref tangent = w->leaf->inputs[INPUT_tangent];
    if (!tangent || part(w, INPUT_roughness, 0) == part(w, INPUT_roughness, 1))
        return;
    text_str(&w->text, ", tangent_u: mdl_to_internal(");
    put_value(w, tangent);
    text_char(&w->text, ')');
}

static void put_scatter(struct writer *w)
{
    const char *mode = w->leaf->mode;
    bool splits = find(covers, w->leaf) && strcmp(mode, "RT") == 0; /* the base transmits */
    if (strcmp(mode, "T") == 0)
        text_str(&w->text, ", mode: df::scatter_transmit");
    else if (strcmp(mode, "RT") == 0 && !splits)
        text_str(&w->text, ", mode: df::scatter_reflect_transmit");
}

/* Schlick's curve with the input color82 bends by its last colour. */
static ir_ref edge_of(const struct leaf *leaf)
{
    ir_ref color82 = leaf->inputs[INPUT_color82];
    if (!color82 || ir_const_is(leaf->tree->graph, color82, 1.0f))
        return leaf->inputs[INPUT_color90];
    return FORMULA(leaf->tree->shader, "mx_rise_edge", leaf->inputs[INPUT_color0], color82,
                   leaf->inputs[INPUT_color90], leaf->inputs[INPUT_exponent]);
}

static ir_ref albedo_of(const struct leaf *leaf)
{
    return closure_call(leaf->tree->shader, leaf->tree->host, leaf->ref, LEAF_ALBEDO, NULL);
}

/* Special names; false: the name is an input's. */
static bool put_special(struct writer *w, const char *name)
{
    struct leaf *leaf = w->leaf;
    if (strcmp(name, "normal") == 0) {
        put_normal(w);
    } else if (strcmp(name, "tangent") == 0) {
        put_tangent(w);
    } else if (strcmp(name, "scatter") == 0) {
        put_scatter(w);
    } else if (strcmp(name, "distribution") == 0) {
        const char *word = word_of(leaf->tree, leaf->inputs[INPUT_distribution]);
        text_str(&w->text, !word || strcmp(word, "ggx") == 0 ? "ggx" : "beckmann");
    } else if (strcmp(name, "over") == 0) {
        text_str(&w->text, leaf->base ? ", base: " : "");
        if (leaf->base)
            put_value(w, leaf->base);
    } else {
        ir_ref value = strcmp(name, "lobe") == 0     ? leaf->lobe
                       : strcmp(name, "base") == 0   ? leaf->base
                       : strcmp(name, "weight") == 0 ? leaf->weight
                       : strcmp(name, "edge") == 0   ? edge_of(leaf)
                       : strcmp(name, "albedo") == 0 ? albedo_of(leaf)
                                                     : 0;
        if (value)
            put_value(w, value);
        return value != 0;
    }
    return true;
}

/* "roughness.x" */
static void put_input(struct writer *w, const char *name)
{
    size_t len = strcspn(name, ".");
    for (unsigned i = 0; i < NUM_INPUTS; i++) {
        if (strncmp(input_names[i], name, len) != 0 || input_names[i][len])
            continue;
        assert(w->leaf->inputs[i]); /* a row names only inputs of its leaf */
        put_value(w, name[len] ? part(w, (enum leaf_input)i, name[len + 1] == 'y')
                               : w->leaf->inputs[i]);
        return;
    }
    assert(false); /* a row names an input that the table has */
}

static ir_ref written(struct leaf *leaf, const char *form, ir_type_id type)
{
    struct writer w = {.leaf = leaf};
    struct arena *arena = leaf->tree->shader->arena;
    text_init(&w.text, arena);
    while (*form) {
        size_t len = strcspn(form, "{");
        text_mem(&w.text, form, len);
        form += len;
        if (!*form)
            break;
        const char *end = strchr(form, '}'),
                   *name = arena_strndup(arena, form + 1, (size_t)(end - form - 1));
        if (!put_special(&w, name))
            put_input(&w, name);
        form = end + 1;
    }
    return mdl_call(leaf->tree, text_cstr(&w.text), type, w.args, w.num_args);
}

/* ---- Lobes ---- */

static bool is_film(const struct leaf *leaf)
{
    ir_ref thickness = leaf->inputs[INPUT_thinfilm_thickness];
    return thickness && !ir_const_is(leaf->tree->graph, thickness, 0.0f);
}

static ir_ref filmed(struct leaf *leaf, ir_ref closure)
{
    if (!is_film(leaf))
        return closure;
    leaf->lobe = closure;
    return written(
        leaf,
        "df::thin_film(thickness: {thinfilm_thickness}, ior: color({thinfilm_ior}), base: {lobe})",
        IR_TYPE_BSDF);
}

/* The index that fits Schlick's reflectance at normal incidence. */
static ir_ref index_of(const struct leaf *leaf)
{
    struct ir_graph *g = leaf->tree->graph;
    if (leaf->inputs[INPUT_ior])
        return ir_convert(g, IR_TYPE_VEC3, leaf->inputs[INPUT_ior]);
    ir_ref frontal = FORMULA(leaf->tree->shader, "mx_mean", leaf->inputs[INPUT_color0]);
    return ir_convert(g, IR_TYPE_VEC3, FORMULA(leaf->tree->shader, "mx_index_of_frontal", frontal));
}

static void note_refraction(struct leaf *leaf)
{
    bool refracts = leaf->inputs[INPUT_scatter_mode] && strcmp(leaf->mode, "R") != 0;
    if (refracts && !leaf->tree->ior)
        leaf->tree->ior = index_of(leaf);
}

static ir_ref plain_lobe(struct leaf *leaf)
{
    bool is_new = leaf->tree->has_new_sheen && strcmp(leaf->family, "mx_sheen_bsdf") == 0
                  && word_of(leaf->tree, leaf->inputs[INPUT_mode])
                  && strcmp(word_of(leaf->tree, leaf->inputs[INPUT_mode]), "zeltner") == 0;
    const char *form =
        is_new ? "df::microflake_sheen_bsdf(roughness: {roughness}, tint: color({color}))"
               : find(lobes, leaf);
    return form ? written(leaf, form, IR_TYPE_BSDF) : 0;
}

/* Facets that send light back stand in the place of those that mirror it. */
static ir_ref lobe_of(struct leaf *leaf)
{
    struct mdl_tree *t = leaf->tree;
    ir_ref turned = leaf->inputs[INPUT_retroreflective], lobe = plain_lobe(leaf);
    const char *form = strcmp(leaf->mode, "T") == 0 ? NULL : find(retros, leaf);
    if (!form || is_false(t, turned))
        return lobe;
    ir_ref back = written(leaf, form, IR_TYPE_BSDF);
    return mdl_mixed(t, lobe, back, ir_convert(t->graph, IR_TYPE_FLOAT, turned));
}

/* Weighted, with its own normal, over the base if there is one. */
static ir_ref weighted(struct leaf *leaf)
{
    struct writer normal = {.leaf = leaf};
    text_init(&normal.text, leaf->tree->shader->arena);
    put_normal(&normal);
    if (ir_const_is(leaf->tree->graph, leaf->weight, 1.0f) && !normal.text.len)
        return leaf->lobe;
    return written(leaf, "df::weighted_layer(weight: {weight}, layer: {lobe}{over}{normal})",
                   IR_TYPE_BSDF);
}

/* The transmitted part of a leaf that splits light between both sides. */
static ir_ref transmitted(struct leaf *leaf)
{
    struct leaf other = *leaf;
    other.mode = "T";
    return plain_lobe(&other);
}

static ir_ref bsdf_over(struct leaf *leaf, ir_ref base)
{
    const char *form = find(covers, leaf);
    leaf->lobe = lobe_of(leaf);
    if (!leaf->lobe)
        return 0;
    note_refraction(leaf);
    if (!form) {
        leaf->lobe = filmed(leaf, leaf->lobe);
        leaf->base = base;
        return weighted(leaf);
    }
    bool splits = strcmp(leaf->mode, "RT") == 0;
    if (!splits) {
        leaf->base = base;
        return filmed(leaf, written(leaf, form, IR_TYPE_BSDF));
    }
    ir_ref weight = leaf->weight;
    leaf->weight = ir_const_float(leaf->tree->graph, 1.0f);
    leaf->base = transmitted(leaf);
    leaf->lobe = filmed(leaf, written(leaf, form, IR_TYPE_BSDF));
    leaf->weight = weight;
    leaf->base = base;
    return weighted(leaf);
}

/* ---- Other leaves ---- */

static const char no_closure[] = "no closure for '%s', and a function cannot replace it";

/* The light of a cone is even up to its edge; MDL has it as a spot with the fall-off of a plane. */
static const struct mdl_light *cone(struct leaf *leaf)
{
    struct mdl_tree *t = leaf->tree;
    struct ir_graph *g = t->graph;
    ir_ref angle = ir_op1(g, IR_RADIANS, leaf->inputs[INPUT_inner_angle]);
    ir_ref edf = mdl_call(t, "df::spot_edf(exponent: 1.0, spread: $0, global_distribution: false)",
                          IR_TYPE_EDF, &angle, 1);
    ir_ref share = FORMULA(t->shader, "mx_cone_share", angle);
    return mdl_light(t, edf, ir_mul(g, leaf->inputs[INPUT_color], share));
}

/* An edf whose radiance depends on the angle, over its base. */
static struct mdl_parts factor(struct mdl_tree *t, ir_ref ref)
{
    struct leaf leaf = leaf_of(t, ref);
    ir_ref base = ir_arg(t->graph, ref, ir_get(t->graph, ref)->num_args - 1);
    struct mdl_parts parts = {0}, below = t->of[base];
    for (const struct mdl_light *light = below.light; light; light = light->next) {
        leaf.base =
            light->edf ? light->edf : mdl_call(t, "df::diffuse_edf()", IR_TYPE_EDF, NULL, 0);
        struct mdl_parts one = {0};
        one.light = mdl_light(t,
                              written(&leaf,
                                      "df::directional_factor(normal_tint: color({color0}), "
                                      "grazing_tint: color({color90}), exponent: {exponent}, "
                                      "base: {base})",
                                      IR_TYPE_EDF),
                              light->radiance);
        parts = mdl_parts_sum(t, parts, one);
    }
    return parts;
}

/* The radius is the mean free path. */
static void add_subsurface(struct leaf *leaf, struct mdl_parts *parts)
{
    struct mdl_tree *t = leaf->tree;
    struct ir_graph *g = t->graph;
    ir_ref albedo = FORMULA(t->shader, "mx_scattering_albedo", leaf->inputs[INPUT_color]),
           extinction = FORMULA(t->shader, "mx_extinction", leaf->inputs[INPUT_radius]);
    parts->scattering = ir_mul(g, albedo, extinction);
    parts->absorption = ir_sub(g, extinction, parts->scattering);
    parts->anisotropy = leaf->inputs[INPUT_anisotropy];
    parts->into = leaf->weight;
}

static struct mdl_parts medium(struct mdl_tree *t, ir_ref ref)
{
    return (struct mdl_parts){
        .absorption = closure_call(t->shader, t->host, ref, LEAF_ABSORPTION, NULL),
        .scattering = closure_call(t->shader, t->host, ref, LEAF_SCATTERING, NULL),
        .anisotropy = closure_call(t->shader, t->host, ref, LEAF_ANISOTROPY, NULL),
    };
}

/* MDL has one tint of all paths through a fibre: the mean of three. */
static ir_ref hair_tint(const struct leaf *leaf)
{
    ir_ref r = leaf->inputs[INPUT_tint_R], tt = leaf->inputs[INPUT_tint_TT],
           trt = leaf->inputs[INPUT_tint_TRT];
    if (r == tt && r == trt)
        return r;
    return FORMULA(leaf->tree->shader, "mx_mean", r, tt, trt);
}

static struct mdl_parts hair(struct leaf *leaf)
{
    struct mdl_tree *t = leaf->tree;
    ir_ref args[2] = {
        ir_mul(t->graph, hair_tint(leaf), leaf->weight),
        written(leaf,
                MDL_HAIR_BSDF
                "roughness_R: {roughness_R}, roughness_TT: {roughness_TT}, "
                "roughness_TRT: {roughness_TRT}, cuticle_angle: {cuticle_angle}, "
                "absorption_coefficient: color({absorption_coefficient}), ior: {ior})",
                IR_TYPE_BSDF)};
    bool is_white = ir_const_is(t->graph, args[0], 1.0f);
    return (struct mdl_parts){.hair = is_white ? args[1]
                                               : mdl_call(t, MDL_TINT "tint: color($0), base: $1)",
                                                          IR_TYPE_BSDF, args, 2)};
}

static struct mdl_parts bsdf_leaf(struct mdl_tree *t, ir_ref ref, struct leaf *leaf)
{
    struct mdl_parts parts = {0};
    bool is_clear =
        closure_has(t->shader, t->host, ref, LEAF_TRANSMITTANCE)
        && ir_const_is(t->graph, closure_call(t->shader, t->host, ref, LEAF_ALBEDO, NULL), 0.0f);
    if (is_clear)
        return parts;
    if (strcmp(leaf->family, "mx_chiang_hair_bsdf") == 0)
        return hair(leaf);
    if (strcmp(leaf->family, "mx_subsurface_bsdf") == 0)
        add_subsurface(leaf, &parts);
    else if (leaf->inputs[INPUT_scatter_mode] && strcmp(leaf->mode, "R") != 0)
        parts.into = leaf->weight;
    parts.bsdf = bsdf_over(leaf, 0);
    parts.bsdf = mdl_scaled(t, parts.bsdf, closure_call(t->shader, t->host, ref, LEAF_TINT, NULL));
    parts.light = mdl_light(t, 0, closure_call(t->shader, t->host, ref, LEAF_EMISSION, NULL));
    if (!parts.bsdf && !closure_has(t->shader, t->host, ref, LEAF_EMISSION))
        t->lacks = mdl_lacks(t, no_closure, leaf->family);
    return parts;
}

struct mdl_parts mdl_leaf(struct mdl_tree *t, ir_ref ref)
{
    const struct ir_node node = *ir_get(t->graph, ref);
    if (closure_source(t->shader, ref)) {
        t->lacks = mdl_lacks(t, no_closure,
                             str_text(t->shader->strings, t->graph->callees.items[node.attr].name));
        return (struct mdl_parts){0};
    }
    if (closure_has(t->shader, t->host, ref, LEAF_FACTOR))
        return mdl_parts_scaled(t, factor(t, ref), ir_arg(t->graph, ref, 0), false);
    struct leaf leaf = leaf_of(t, ref);
    struct mdl_parts parts = {0};
    if (node.type == IR_TYPE_BSDF)
        return bsdf_leaf(t, ref, &leaf);
    if (node.type == IR_TYPE_VDF)
        parts = medium(t, ref);
    else if (leaf.inputs[INPUT_inner_angle])
        parts.light = cone(&leaf);
    else
        parts.light = mdl_light(t, 0, closure_call(t->shader, t->host, ref, LEAF_EMISSION, NULL));
    return mdl_parts_scaled(t, parts, leaf.weight, true);
}

bool mdl_leaf_covers(struct mdl_tree *t, ir_ref ref)
{
    struct leaf leaf = leaf_of(t, ref);
    bool has_own = closure_has(t->shader, t->host, ref, LEAF_TINT)
                   || closure_has(t->shader, t->host, ref, LEAF_TRANSMITTANCE);
    bool is_opaque = !closure_has(t->shader, t->host, ref, LEAF_THROUGHPUT);
    return !has_own && (find(covers, &leaf) || is_opaque || strcmp(leaf.mode, "R") != 0);
}

ir_ref mdl_leaf_over(struct mdl_tree *t, ir_ref ref, ir_ref base)
{
    struct leaf leaf = leaf_of(t, ref);
    return bsdf_over(&leaf, base);
}
