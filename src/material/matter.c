// SPDX-License-Identifier: Apache-2.0
/*
 * The surface is taken apart twice. Light that goes along the normal tells what the surface
 * transmits and emits: there all closures have one frame, so that values are formulas of the
 * inputs alone. What reflects becomes slabs, and a budget blends them until one lies under a coat
 * at most.
 */
#include "material/matter.h"

#include "material/changed_closures.h"
#include "shader/formula.h"
#include "slabs/slabs.h"

struct taking {
    struct builder *builder;
    struct ir_graph *graph;
    struct closure_host closures; /* of the frame */
    struct matter *out;
};

/* "dielectric_bsdf" */
static const char *name_of(struct taking *t, ir_ref leaf)
{
    const struct family *family = build_leaf_family(t->builder, ir_get(t->graph, leaf)->attr);
    const char *name = build_text(t->builder, family->name);
    return strncmp(name, "mx_", 3) == 0 ? name + 3 : name;
}

/* ---- Light along the normal ---- */

static ir_ref in_frame(struct taking *t, ir_ref leaf)
{
    leaf = build_with_operand(t->builder, leaf, "normal", ir_axis(t->graph, 2));
    return build_with_operand(t->builder, leaf, "tangent", ir_axis(t->graph, 0));
}

/* Notes the medium of a volume, which no other part of the light is. */
static void take_medium(struct taking *t, ir_ref leaf)
{
    struct shader *shader = t->builder->shader;
    t->out->absorption = closure_call(shader, &t->closures, leaf, LEAF_ABSORPTION, NULL);
    t->out->scattering = closure_call(shader, &t->closures, leaf, LEAF_SCATTERING, NULL);
    t->out->phase_anisotropy = closure_call(shader, &t->closures, leaf, LEAF_ANISOTROPY, NULL);
}

/* Notes what makes light differ by direction. */
static void find_direction(struct taking *t, ir_ref leaf)
{
    static const char *const inputs[] = {"color90", "inner_angle", "file"};
    for (size_t i = 0; i < sizeof inputs / sizeof *inputs; i++) {
        if (!build_leaf_operand(t->builder, leaf, inputs[i]))
            continue;
        t->out->lost_input = inputs[i];
        t->out->lost_of = name_of(t, leaf);
    }
}

static ir_ref framed_part(void *user_data, ir_ref ref)
{
    struct taking *t = user_data;
    if (ir_type_of(t->graph, ref) == IR_TYPE_EDF)
        find_direction(t, ref);
    if (ir_type_of(t->graph, ref) == IR_TYPE_VDF)
        take_medium(t, ref);
    return ir_get(t->graph, ref)->op == IR_SLAB ? 0 : in_frame(t, ref);
}

/* The sum of what leaves say, each with its weight; vec3. */
static ir_ref sum_of_leaves(struct taking *t, ir_ref root,
                            ir_ref (*value)(struct taking *t, ir_ref leaf))
{
    struct ir_graph *g = t->graph;
    struct closure_list list;
    ir_ref sum = ir_black(g), straight = ir_const_float(g, 0.0f);
    root = build_with_parts(t->builder, root, framed_part, t);
    closure_flatten(t->builder->shader, &t->closures, root, &list);
    for (uint32_t i = 0; i < list.leaves.len; i++) {
        ir_ref of_leaf = value(t, list.leaves.items[i].leaf);
        ir_ref weight = closure_weight(t->builder->shader, &list.leaves.items[i], straight);
        if (of_leaf)
            sum = ir_add(g, sum, ir_convert(g, IR_TYPE_VEC3, ir_mul(g, of_leaf, weight)));
    }
    return sum;
}

static ir_ref light_through(struct taking *t, ir_ref leaf)
{
    return closure_through(t->builder->shader, &t->closures, leaf);
}

static ir_ref emitted_light(struct taking *t, ir_ref leaf)
{
    return closure_call(t->builder->shader, &t->closures, leaf, LEAF_EMISSION, NULL);
}

/* ---- What reflects ---- */

/* A diffuse slab with the albedo of a leaf that no slab stands for. */
static ir_ref diffuse_part(struct taking *t, ir_ref leaf)
{
    struct ir_graph *g = t->graph;
    t->out->other = name_of(t, leaf);
    ir_ref albedo =
        closure_call(t->builder->shader, &t->closures, in_frame(t, leaf), LEAF_ALBEDO, NULL);
    albedo = albedo ? ir_convert(g, IR_TYPE_VEC3, albedo) : ir_black(g);
    return build_slab_like(t->builder, leaf, ir_mul(g, albedo, ir_arg(g, leaf, 0)));
}

/* A film on an interface; of several it is the last one. */
static void take_film(struct taking *t, ir_ref leaf)
{
    ir_ref thickness = build_leaf_operand(t->builder, leaf, "thinfilm_thickness");
    if (!thickness || ir_const_is(t->graph, thickness, 0.0f))
        return;
    t->out->film_thickness = thickness;
    t->out->film_ior = build_leaf_operand(t->builder, leaf, "thinfilm_ior");
}

/* Notes an input of a closure that no slab has. */
static void find_lost_input(struct taking *t, ir_ref leaf)
{
    static const struct {
        const char *name, *word; /* its value where nothing is lost; NULL: 0 */
    } inputs[] = {{"retroreflective", NULL}, {"distribution", "ggx"}, {"mode", "zeltner"}};
    for (size_t i = 0; i < sizeof inputs / sizeof *inputs; i++) {
        struct ir_value value;
        ir_ref operand = build_leaf_operand(t->builder, leaf, inputs[i].name);
        bool is_known = operand && ir_get_const(t->graph, operand, &value);
        bool is_lost = operand && !is_known;
        if (is_known && inputs[i].word)
            is_lost = strcmp(build_text(t->builder, value.w[0].u), inputs[i].word) != 0;
        else if (is_known)
            is_lost = value.w[0].u != 0;
        if (is_lost) {
            t->out->lost_input = inputs[i].name;
            t->out->lost_of = name_of(t, leaf);
        }
    }
}

/* Where light goes through, nothing lies below: matter there is an interface over black. */
static ir_ref reflecting_part(void *user_data, ir_ref ref)
{
    struct taking *t = user_data;
    struct ir_value mode;
    if (ir_get(t->graph, ref)->op == IR_SLAB)
        return ref;
    if (ir_type_of(t->graph, ref) != IR_TYPE_BSDF) /* a medium, which take_medium knows */
        return 0;
    ir_ref operand = build_leaf_operand(t->builder, ref, "scatter_mode");
    const char *word = operand && ir_get_const(t->graph, operand, &mode)
                           ? build_text(t->builder, mode.w[0].u)
                           : "R";
    if (strcmp(word, "T") == 0)
        return build_slab_like(t->builder, ref, ir_black(t->graph));
    if (strcmp(word, "R") != 0)
        ref = build_with_operand(
            t->builder, ref, "scatter_mode",
            ir_const_string(t->graph, str_intern_z(t->builder->shader->strings, "R")));
    if (!build_slab_of(t->builder, ref, false, true))
        return diffuse_part(t, ref);
    take_film(t, ref);
    find_lost_input(t, ref);
    return ref;
}

/* ---- A base under a coat ---- */

/* The closure below coverages, which multiply into *coverage. */
static ir_ref uncovered(struct ir_graph *g, ir_ref ref, ir_ref *coverage)
{
    while (ref && ir_get(g, ref)->op == IR_CLOSURE_MIX
           && (!ir_arg(g, ref, 0) || !ir_arg(g, ref, 1))) {
        ir_ref mix = ir_arg(g, ref, 2);
        *coverage = ir_mul(g, *coverage, ir_arg(g, ref, 0) ? ir_one_minus(g, mix) : mix);
        ref = ir_arg(g, ref, 0) ? ir_arg(g, ref, 0) : ir_arg(g, ref, 1);
    }
    return ref;
}

static bool is_slab(const struct ir_graph *g, ir_ref ref)
{
    return ref && ir_get(g, ref)->op == IR_SLAB;
}

/* Clear matter over other matter. */
static bool is_coat(const struct ir_graph *g, ir_ref ref)
{
    return is_slab(g, ref) && ir_const_is(g, ir_arg(g, ref, SLAB_diffuse_albedo), 0.0f)
           && !ir_const_is(g, ir_arg(g, ref, SLAB_mean_free_path), 0.0f);
}

/* Takes the coat from a tree; returns what lies below it, or the tree without one. */
static ir_ref take_coat(struct taking *t, ir_ref tree)
{
    struct ir_graph *g = t->graph;
    ir_ref coverage = ir_const_float(g, 1.0f), inner = uncovered(g, tree, &coverage);
    if (!ir_const_is(g, coverage, 1.0f) || !slabs_is_layer(g, inner))
        return tree;
    ir_ref coat = uncovered(g, ir_arg(g, inner, 0), &coverage),
           thickness = slabs_layer_thickness(g, inner);
    if (!is_coat(g, coat))
        return tree;
    t->out->coat = coat;
    t->out->thickness = thickness;
    t->out->coat_coverage = ir_mul(g, coverage, ir_arg(g, coat, SLAB_coverage));
    return ir_arg(g, inner, 1);
}

/* One slab for a tree, with its coverage; 0: a closure is left that no slab stands for. */
static ir_ref only_slab(struct taking *t, struct arena *scratch, ir_ref tree, ir_ref *coverage)
{
    const struct slab_budget budget = {
        .max_slabs = 1, .max_error = -1.0f, .max_steps = -1, .blends_all = true};
    struct slab_report *report = &t->out->report, rest;
    tree = build_budget_slabs(t->builder, &t->closures, scratch, &budget, tree, &rest);
    for (uint32_t i = 0; i < rest.steps.len; i++)
        vec_push(t->builder->arena, &report->steps, rest.steps.items[i]);
    report->error += rest.error;
    report->is_too_much |= rest.is_too_much;
    ir_ref slab = uncovered(t->graph, tree, coverage);
    if (!is_slab(t->graph, slab))
        return 0;
    *coverage = ir_mul(t->graph, *coverage, ir_arg(t->graph, slab, SLAB_coverage));
    return slab;
}

static void find_slabs(struct taking *t, struct arena *scratch, ir_ref bsdf)
{
    static const struct slab_budget two = {.max_slabs = 2, .max_error = -1.0f, .max_steps = -1};
    struct ir_graph *g = t->graph;
    struct matter *out = t->out;
    ir_ref whole = build_with_parts(t->builder, bsdf, reflecting_part, t),
           one = ir_const_float(g, 1.0f);
    if (!whole)
        return;
    ir_ref tree = build_budget_slabs(t->builder, &t->closures, scratch, &two, whole, &out->report);
    tree = take_coat(t, tree);
    ir_ref coverage = one;
    out->base = tree ? only_slab(t, scratch, tree, &coverage) : 0;
    if (out->coat && !ir_const_is(g, coverage, 1.0f)) { /* the coat lies over holes, too */
        out->report = (struct slab_report){0};
        coverage = one;
        out->coat = 0;
        out->base = only_slab(t, scratch, whole, &coverage);
    }
    out->opacity = ir_mul(g, out->opacity, coverage);
}

/* ---- The surface ---- */

bool build_matter(struct builder *b, const struct closure_host *closures, struct arena *scratch,
                  ir_ref root, struct matter *out)
{
    struct ir_graph *g = b->graph;
    struct closure_point point = {.normal = ir_axis(g, 2), .view = ir_axis(g, 2)};
    struct taking t = {.builder = b, .graph = g, .closures = *closures, .out = out};
    ir_ref surface = closure_without_aovs(g, closure_sides_of(g, root).front);
    if (!surface || ir_type_of(g, surface) != IR_TYPE_SURFACE)
        return false;
    t.closures.point = &point;
    uint8_t op = ir_get(g, surface)->op;
    struct closure_surface parts = op == IR_SLAB_SURFACE
                                       ? (struct closure_surface){.bsdf = ir_arg(g, surface, 0)}
                                       : closure_surface_of(b->shader, &t.closures, surface);
    ir_ref thin = op == IR_SLAB_SURFACE     ? ir_arg(g, surface, 1)
                  : op == IR_SURFACE_SHADER ? ir_arg(g, surface, 3)
                                            : 0;
    *out = (struct matter){.had_slabs = slabs_has(b->shader, parts.bsdf)};
    out->is_thin = thin ? thin : ir_const_bool(g, false);
    out->opacity = parts.alpha ? parts.alpha : ir_const_float(g, 1.0f);
    if (parts.premultiplied) /* the definition multiplies again */
        parts = closure_picked(g, parts);
    out->transmits = sum_of_leaves(&t, parts.bsdf, light_through);
    out->emits = sum_of_leaves(&t, parts.edf, emitted_light);
    if (parts.unlit)
        out->emits = ir_add(g, out->emits, ir_convert(g, IR_TYPE_VEC3, parts.unlit));
    find_slabs(&t, scratch, parts.bsdf);
    return true;
}

/* ---- A definition over matter ---- */

static ir_ref slab_input(struct builder *b, ir_ref slab, const char *name)
{
    static const char *const names[NUM_SLAB_INPUTS] = {
#define SLAB_INPUT(name, type) #name,
#include "slabs/slabs.def"
#undef SLAB_INPUT
    };
    for (unsigned i = 0; slab && i < NUM_SLAB_INPUTS; i++)
        if (strcmp(names[i], name) == 0)
            return ir_arg(b->graph, slab, i);
    return 0;
}

/* 0: the input keeps its default. */
static ir_ref input_of_matter(struct builder *b, const struct matter *m, const char *name)
{
    static const char of_coat[] = "coat_";
    const struct {
        const char *name;
        ir_ref value;
    } others[] = {{"transmits", m->transmits},
                  {"emits", m->emits},
                  {"film_thickness", m->film_thickness},
                  {"film_ior", m->film_ior},
                  {"absorption", m->absorption},
                  {"scattering", m->scattering},
                  {"medium_anisotropy", m->phase_anisotropy},
                  {"opacity", m->opacity},
                  {"thin_walled", m->is_thin},
                  {"coat_coverage", m->coat_coverage},
                  {"coat_thickness", m->thickness},
                  {"coat_blurs", ir_const_float(b->graph, m->had_slabs ? 1.0f : 0.0f)}};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (strcmp(others[i].name, name) == 0)
            return others[i].value;
    return strncmp(name, of_coat, strlen(of_coat)) == 0
               ? slab_input(b, m->coat, name + strlen(of_coat))
               : slab_input(b, m->base, name);
}

void build_apply_to_matter(struct builder *b, const char *definition, const struct matter *matter,
                           ir_ref *results)
{
    uint32_t id = build_definition_named(b, definition);
    const struct nodedef *def = library_nodedef(b->lib, id);
    const struct port *ports = library_ports(b->lib, id, NULL);
    ir_ref *args = ARENA_ARRAY(b->arena, ir_ref, def->num_inputs);
    for (unsigned i = 0; i < def->num_inputs; i++) {
        args[i] = input_of_matter(b, matter, build_text(b, ports[i].name));
        args[i] = args[i] ? args[i] : build_default(b, &ports[i]);
    }
    build_apply(b, id, build_doc(b)->root, args, results);
}
