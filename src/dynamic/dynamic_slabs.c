// SPDX-License-Identifier: Apache-2.0
/* The nodes of slabs (docs/slabs.md): each is an op of the IR, which the walk of src/slabs reads.
 */
#include "dynamic/dynamic.h"
#include "slabs/hidden_slabs.h"
#include "slabs/regime.h"

#include <math.h>

/* True if an input has its default of 0, false or no file, or the definition lacks it. */
static bool is_off(const mxg_build *build, str_id input)
{
    struct builder *b = build->b;
    struct ir_value value;
    ir_ref ref = dynamic_arg(build, input);
    if (!ref)
        return true;
    if (ir_get(b->graph, ref)->op == IR_TEXTURE)
        return !*build_text(b,
                            b->shader->interface.variables.items[ir_get(b->graph, ref)->attr].file);
    return build_initial(b, ref, &value) && value.w[0].u == 0;
}

/* Warns where the node does not have the input. */
static void check_has(const mxg_build *build, str_id input, enum diag_id warning)
{
    struct builder *b = build->b;
    elem_id node = build->frame->node.element;
    if (!doc_child(&b->lib->doc, node, input))
        diag_add(b->diags, warning, doc_place(&b->lib->doc, node), build_text(b, build->def->node));
}

/* The parts that the document does not have, also behind a uniform, because their code is long. */
static void leave_out(const mxg_build *build, ir_ref *args)
{
    ir_ref nothing = ir_const_float(build->b->graph, 0.0f);
    if (is_off(build, STR_glint_density))
        args[SLAB_glint_density] = nothing;
    if (!is_off(build, STR_specular_lut))
        return;
    if (!ir_const_is(build->b->graph, args[SLAB_specular_lut_weight], 0.0f)
        && doc_child(&build->b->lib->doc, build->frame->node.element, STR_specular_lut_weight))
        check_has(build, STR_specular_lut, DIAG_ID_slab_without_table);
    args[SLAB_specular_lut] = 0;
    args[SLAB_specular_lut_weight] = nothing;
}

/* ---- Values that matter cannot have ---- */

enum bounds { SHARE, LENGTH, SIGNED, LOGARITHM, NUM_BOUNDS };

static const struct {
    float low, high;
    const char *text;
} bounds[NUM_BOUNDS] = {
    [SHARE] = {0.0f, 1.0f, "0 to 1"},
    [LENGTH] = {0.0f, INFINITY, "0 or more"},
    [SIGNED] = {-1.0f, 1.0f, "-1 to 1"},
    [LOGARITHM] = {0.0f, 88.0f, "0 to 88, the logarithm of a float"},
};

/* The part of a value that is out of its bounds; NULL: there is none. */
static const float *stray_part(const struct ir_value *value, enum bounds in)
{
    for (unsigned i = 0; i < ir_type_info(value->type)->components; i++)
        if (!(value->w[i].f >= bounds[in].low && value->w[i].f <= bounds[in].high))
            return &value->w[i].f;
    return NULL;
}

/* The input that has the value of another one: that of the <constant> which it reads, or itself. */
static elem_id valued_input(const struct document *doc, elem_id input)
{
    enum { MAX_CONSTANTS = 8 }; /* documents of errors have circles */
    for (int i = 0; i < MAX_CONSTANTS; i++) {
        elem_id node = doc_named_node(doc, input);
        bool is_constant = node && doc_element(doc, node)->category == STR_constant;
        elem_id value = is_constant ? doc_child(doc, node, STR_value) : 0;
        if (!value)
            break;
        input = value;
    }
    return input;
}

/* The place of the value of an input in the document, or of the node that is given it otherwise. */
static struct diag_place place_of_value(const mxg_build *build, str_id input)
{
    const struct document *doc = &build->b->lib->doc;
    elem_id node = build->frame->node.element, given = doc_child(doc, node, input);
    return given ? doc_attr_place(doc, valued_input(doc, given), STR_value) : doc_place(doc, node);
}

/* Values of the document, also where the host may change them. */
static void check_bounds(const mxg_build *build, str_id input, ir_ref ref, enum bounds in)
{
    struct builder *b = build->b;
    struct ir_value value;
    const float *stray = ref && build_initial(b, ref, &value) && ir_type_is_float(value.type)
                             ? stray_part(&value, in)
                             : NULL;
    if (!stray)
        return;
    struct text text;
    text_init(&text, b->arena);
    text_float(&text, *stray);
    diag_add(b->diags, DIAG_ID_slab_not_physical, place_of_value(build, input),
             build_text(b, input), build_text(b, build->def->node), text_cstr(&text),
             bounds[in].text);
}

static void check_slab(const mxg_build *build, const str_id *names, const ir_ref *args)
{
    static const struct {
        enum slab_operand input;
        enum bounds in;
    } checked[] = {
        {SLAB_diffuse_albedo, SHARE},
        {SLAB_f0, SHARE},
        {SLAB_f90, LENGTH},
        {SLAB_roughness, SHARE},
        {SLAB_anisotropy, SIGNED},
        {SLAB_second_roughness, SHARE},
        {SLAB_second_roughness_weight, SHARE},
        {SLAB_fuzz_amount, SHARE},
        {SLAB_fuzz_color, SHARE},
        {SLAB_fuzz_roughness, SIGNED},
        {SLAB_mean_free_path, LENGTH},
        {SLAB_phase_anisotropy, SIGNED},
        {SLAB_emission, LENGTH},
        {SLAB_glint_density, LOGARITHM},
        {SLAB_specular_lut_weight, SHARE},
    };
    for (size_t i = 0; i < sizeof checked / sizeof *checked; i++)
        check_bounds(build, names[checked[i].input], args[checked[i].input], checked[i].in);
}

/* ---- Thickness ---- */

/* True for a slab with a medium that light goes through, also behind a uniform. */
static bool needs_thickness(struct builder *b, ir_ref slab)
{
    struct ir_value value;
    ir_ref path = ir_arg(b->graph, slab, SLAB_mean_free_path);
    return !build_initial(b, path, &value) || value.w[0].f > 0 || value.w[1].f > 0
           || value.w[2].f > 0;
}

/* The operands of an operator that have its thickness: the bits 0 and 1. */
static unsigned operands_of(uint8_t op)
{
    switch (op) {
    case IR_CLOSURE_MIX:
    case IR_CLOSURE_ADD: return 3;
    case IR_CLOSURE_SCALE: return 1;
    case IR_LAYER: /* has told of its own top */
    case IR_SLAB_LAYER: return 2;
    default: return 0;
    }
}

bool dynamic_needs_thickness(const mxg_build *build, ir_ref closure)
{
    enum { MAX_OPEN = 32, MAX_VISITS = 256 };
    struct builder *b = build->b;
    ir_ref open[MAX_OPEN] = {closure};
    unsigned num = closure ? 1 : 0;
    for (unsigned visits = 0; num && visits < MAX_VISITS; visits++) {
        ir_ref ref = open[--num];
        uint8_t op = ir_get(b->graph, ref)->op;
        if (op == IR_SLAB && needs_thickness(b, ref))
            return true;
        for (unsigned i = 0, taken = operands_of(op); i < 2; i++)
            if (taken >> i & 1 && ir_arg(b->graph, ref, i) && num < MAX_OPEN)
                open[num++] = ir_arg(b->graph, ref, i);
    }
    return false;
}

void dynamic_warn_of_thickness(const mxg_build *build, const char *instead)
{
    struct builder *b = build->b;
    diag_add(b->diags, DIAG_ID_slab_without_thickness,
             doc_place(&b->lib->doc, build->frame->node.element), build_text(b, build->def->node),
             instead);
}

/* ---- Nodes ---- */

static bool finish(mxg_build *build, enum ir_op op, uint32_t attr, const ir_ref *args, unsigned n,
                   mxg_ref *results)
{
    build_leave_layer(build->b); /* nobody knows where the slabs lie before the tree is complete */
    results[0] = code_issue(build, ir_build(build->b->graph, op, build->type, attr, args, n));
    return true;
}

/* The attribute of an operator: 1 asks to blend the parameters of its slabs. */
static uint32_t blends(const mxg_build *build)
{
    return !is_off(build, STR_blend_parameters);
}

bool dynamic_slab(void *user_data, mxg_build *build, mxg_ref *results)
{
    static const str_id names[NUM_SLAB_INPUTS] = {
#define SLAB_INPUT(name, type) STR_##name,
#include "slabs/slabs.def"
#undef SLAB_INPUT
    };
    (void)user_data;
    if (build_slab_definition(build->b) == LIBRARY_NONE)
        return dynamic_misfit(build, "the library lacks the definition 'ND_slab_lobes'");
    ir_ref args[NUM_SLAB_OPERANDS];
    for (unsigned i = 0; i < NUM_SLAB_INPUTS; i++)
        args[i] = dynamic_arg(build, names[i]);
    args[SLAB_coverage] = ir_const_float(build->b->graph, 1.0f);
    leave_out(build, args);
    check_slab(build, names, args);
    uint32_t attr = build_slab_lacks(build->b) | slab_regime(build->b->graph, args);
    return finish(build, IR_SLAB, attr, args, NUM_SLAB_OPERANDS, results);
}

/* By the values of the document. */
static bool is_opaque(void *user_data, ir_ref slab)
{
    return !needs_thickness(user_data, slab);
}

void dynamic_check_base(const mxg_build *build, ir_ref top)
{
    struct builder *b = build->b;
    elem_id node = build->frame->node.element;
    bool has_base = doc_child(&b->lib->doc, node, STR_base) != 0;
    if (!has_base || slabs_hides(b->graph, top, is_opaque, b, b->arena))
        diag_add(b->diags, has_base ? DIAG_ID_slab_hides_base : DIAG_ID_slab_without_base,
                 doc_place(&b->lib->doc, node), build_text(b, build->def->node));
}

bool dynamic_slab_layer(void *user_data, mxg_build *build, mxg_ref *results)
{
    ir_ref args[3] = {dynamic_arg(build, STR_top), dynamic_arg(build, STR_base),
                      dynamic_arg(build, STR_thickness)};
    (void)user_data;
    check_bounds(build, STR_thickness, args[2], LENGTH);
    dynamic_check_base(build, args[0]);
    if (args[1])
        check_has(build, STR_top, DIAG_ID_slab_without_top);
    if (args[0])
        return finish(build, IR_SLAB_LAYER, blends(build), args, 3, results);
    results[0] = code_issue(build, args[1]);
    return true;
}

/* bg (1 - share) + fg share; 0 is no matter. */
static bool beside(mxg_build *build, ir_ref bg, ir_ref fg, ir_ref share, mxg_ref *results)
{
    struct ir_graph *g = build->b->graph;
    share = ir_share(g, share);
    ir_ref args[3] = {bg, fg, share};
    bool is_bg = bg == fg || ir_const_is(g, share, 0.0f), is_fg = ir_const_is(g, share, 1.0f);
    if (!is_bg && !is_fg)
        return finish(build, IR_CLOSURE_MIX, blends(build), args, 3, results);
    results[0] = code_issue(build, is_bg ? bg : fg);
    return true;
}

bool dynamic_slab_mix(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    ir_ref bg = dynamic_arg(build, STR_bg), fg = dynamic_arg(build, STR_fg),
           share = dynamic_arg(build, STR_mix);
    check_bounds(build, STR_mix, share, SHARE);
    return beside(build, bg, fg, share, results);
}

bool dynamic_slab_coverage(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    ir_ref in = dynamic_arg(build, STR_in), share = dynamic_arg(build, STR_weight);
    check_bounds(build, STR_weight, share, SHARE);
    return beside(build, 0, in, share, results);
}

bool dynamic_slab_select(void *user_data, mxg_build *build, mxg_ref *results)
{
    struct ir_graph *g = build->b->graph;
    (void)user_data;
    ir_ref is_second = ir_op2(g, IR_GT, dynamic_arg(build, STR_mask), ir_const_float(g, 0.5f));
    ir_ref one = ir_const_float(g, 1.0f), zero = ir_const_float(g, 0.0f);
    ir_ref in1 = dynamic_arg(build, STR_in1), in2 = dynamic_arg(build, STR_in2);
    return beside(build, in1, in2, ir_op3(g, IR_SELECT, is_second, one, zero), results);
}

bool dynamic_slab_surface(void *user_data, mxg_build *build, mxg_ref *results)
{
    mxg_value thin = MXG_INIT(mxg_value);
    (void)user_data;
    if (!mxg_build_require_constant(build, "thin", &thin))
        return false;
    ir_ref args[3] = {dynamic_arg(build, STR_bsdf),
                      ir_const_bool(build->b->graph, thin.values[0] != 0),
                      dynamic_arg(build, STR_surface_thickness)};
    check_bounds(build, STR_surface_thickness, args[2], LENGTH);
    return finish(build, IR_SLAB_SURFACE, 0, args, 3, results);
}
