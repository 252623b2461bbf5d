// SPDX-License-Identifier: Apache-2.0
/*
 * Dynamic implementations: named streams, and the constructors of closures and shaders. Each is
 * code for a node like that of a host (mxgen/node.h). Few of them need more of the builder than a
 * host has.
 */
#include "dynamic/code.h"
#include "dynamic/dynamic.h"

#include <stdio.h>

enum { MAX_OPERANDS = 4 };

/* An input that a definition may lack: then 0. */
static mxg_ref optional_input(mxg_build *build, const char *wanted)
{
    const char *name = NULL;
    for (uint32_t i = 0; i < build->def->num_inputs; i++)
        if (strcmp(mxg_build_port(build, i, NULL), wanted) == 0)
            name = wanted;
    return name ? mxg_build_input(build, name) : 0;
}

/* An op of inputs; the name NULL stands for an absent operand. */
static bool op_of(mxg_build *build, const char *op, const char *const *inputs, uint32_t n,
                  mxg_ref *results)
{
    mxg_ref args[MAX_OPERANDS];
    assert(n <= MAX_OPERANDS);
    for (uint32_t i = 0; i < n; i++)
        args[i] = inputs[i] ? optional_input(build, inputs[i]) : 0;
    results[0] = mxg_build_op(build, op, NULL, args, n);
    return true;
}

static mxg_ref op1(mxg_build *build, const char *op, mxg_ref a)
{
    return mxg_build_op(build, op, NULL, &a, 1);
}

static mxg_ref op2(mxg_build *build, const char *op, mxg_ref a, mxg_ref b)
{
    return mxg_build_op(build, op, NULL, (mxg_ref[]){a, b}, 2);
}

/* ---- streams ---- */

/* The index in an input; false after a report. */
static bool read_index(mxg_build *build, int32_t *out)
{
    mxg_value index = MXG_INIT(mxg_value);
    if (!mxg_build_require_constant(build, "index", &index))
        return false;
    *out = index.integer;
    if (index.integer < 0)
        mxg_build_report_error(build, "index", "the index is negative; the first one is 0");
    return index.integer >= 0;
}

/* The stream "texcoord_2" for 2. */
static mxg_ref numbered_stream(mxg_build *build, const char *prefix, int32_t number)
{
    char name[32];
    snprintf(name, sizeof name, "%s%d", prefix, number);
    return mxg_build_stream(build, name, NULL);
}

/*
 * Fits a stream of `have` components to the node's output: drops components, or fills with 0.
 */
static mxg_ref fit_components(mxg_build *build, mxg_ref value, unsigned have)
{
    static const char *const names[] = {NULL, "x", "xy", "xyz", "xyzw"};
    unsigned want = ir_type_info(build->type)->components, n = 1;
    mxg_ref parts[4] = {value};
    if (want < have)
        return mxg_build_swizzle(build, value, names[want]);
    if (want == have)
        return value;
    for (unsigned i = have; i < want; i++)
        parts[n++] = mxg_build_number(build, "float", (const float[]){0.0f}, 1);
    return mxg_build_op(build, "construct", ir_type_text(build->type), parts, n);
}

static bool indexed_stream(mxg_build *build, const char *prefix, unsigned components,
                           mxg_ref *results)
{
    int32_t index;
    if (!read_index(build, &index))
        return false;
    results[0] = fit_components(build, numbered_stream(build, prefix, index), components);
    return true;
}

static bool build_texcoord(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    return indexed_stream(build, "texcoord_", 2, results);
}

static bool build_geomcolor(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    return indexed_stream(build, "color_", 4, results);
}

/*
 * Tangent and bitangent for texture coordinates other than the first. They follow from the change
 * of the point P and of the coordinates from pixel to pixel, up to a positive factor:
 *
 *     T = (dP/dx · dv/dy - dP/dy · dv/dx) sign D
 *     B = (dP/dy · du/dx - dP/dx · du/dy) sign D
 *     D = du/dx · dv/dy - du/dy · dv/dx
 */
static mxg_ref tangent_of(mxg_build *build, mxg_ref point, mxg_ref uv, bool along_v)
{
    const char *first = along_v ? "dFdy" : "dFdx", *second = along_v ? "dFdx" : "dFdy";
    mxg_ref du_dx = mxg_build_swizzle(build, op1(build, "dFdx", uv), "x"),
            du_dy = mxg_build_swizzle(build, op1(build, "dFdy", uv), "x"),
            dv_dx = mxg_build_swizzle(build, op1(build, "dFdx", uv), "y"),
            dv_dy = mxg_build_swizzle(build, op1(build, "dFdy", uv), "y");
    mxg_ref plus = op2(build, "mul", op1(build, first, point), along_v ? du_dx : dv_dy);
    mxg_ref minus = op2(build, "mul", op1(build, second, point), along_v ? du_dy : dv_dx);
    mxg_ref sum = op2(build, "sub", plus, minus);
    plus = op2(build, "mul", du_dx, dv_dy);
    minus = op2(build, "mul", du_dy, dv_dx);
    mxg_ref area = op2(build, "sub", plus, minus);
    return op1(build, "normalize", op2(build, "mul", sum, op1(build, "sign", area)));
}

static bool build_axis(mxg_build *build, const char *object, const char *world, bool along_v,
                       mxg_ref *results)
{
    mxg_value space = MXG_INIT(mxg_value);
    int32_t index = 0;
    if (((build->b->options->caps & CAP_INDEXED_TANGENTS) && !read_index(build, &index))
        || !mxg_build_require_constant(build, "space", &space))
        return false;
    bool is_world = strcmp(space.text, "world") == 0;
    if (index == 0) {
        results[0] =
            op1(build, "normalize", mxg_build_stream(build, is_world ? world : object, NULL));
        return true;
    }
    mxg_ref uv = numbered_stream(build, "texcoord_", index);
    mxg_ref point = mxg_build_stream(build, is_world ? "positionWorld" : "positionObject", NULL);
    results[0] = tangent_of(build, point, uv, along_v);
    return true;
}

static bool build_tangent(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    return build_axis(build, "tangentObject", "tangentWorld", false, results);
}

static bool build_bitangent(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    return build_axis(build, "bitangentObject", "bitangentWorld", true, results);
}

static bool blur(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    ir_ref in = dynamic_arg(build, STR_in), size = dynamic_arg(build, STR_size),
           filter = dynamic_arg(build, STR_filtertype);
    results[0] =
        code_issue(build, build_blur(build->b, in, size, filter, build->frame->node.element));
    return true;
}

/* ---- closures ---- */

static bool build_layer(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    ir_ref top = dynamic_arg(build, STR_top);
    if (dynamic_needs_thickness(build, top))
        dynamic_warn_of_thickness(build, "0.01 cm");
    if (top && ir_get(build->b->graph, top)->op == IR_SLAB)
        dynamic_check_base(build, top);
    return op_of(build, "layer", (const char *const[]){"top", "base"}, 2, results);
}

static bool build_mix(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    return op_of(build, ir_type_is_closure(build->type) ? "closure_mix" : "shader_mix",
                 (const char *const[]){"bg", "fg", "mix"}, 3, results);
}

static bool build_add(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    return op_of(build, "closure_add", (const char *const[]){"in1", "in2"}, 2, results);
}

static bool build_multiply(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    return op_of(build, "closure_scale", (const char *const[]){"in1", "in2"}, 2, results);
}

static bool thin_film(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    ir_ref thickness = dynamic_arg(build, STR_thickness), ior = dynamic_arg(build, STR_ior),
           base = dynamic_arg(build, STR_base);
    results[0] =
        code_issue(build, build_film(build->b, thickness, ior, base, build->frame->node.element));
    return true;
}

static bool measured_edf(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    ir_ref color = dynamic_arg(build, STR_color), normal = dynamic_arg(build, STR_normal),
           file = dynamic_arg(build, STR_file);
    results[0] = code_issue(
        build, build_measured_edf(build->b, color, normal, file, build->frame->node.element));
    return true;
}

/* ---- shaders ---- */

static bool build_surface(void *user_data, mxg_build *build, mxg_ref *results)
{
    struct ir_value is_thin;
    (void)user_data;
    if (dynamic_needs_thickness(build, dynamic_arg(build, STR_bsdf))
        && build_initial(build->b, dynamic_arg(build, STR_thin_walled), &is_thin) && is_thin.w[0].u)
        dynamic_warn_of_thickness(build, "that of a body, in spite of 'thin_walled'");
    return op_of(build, "surface", (const char *const[]){"bsdf", "edf", "opacity", "thin_walled"},
                 4, results);
}

static bool build_surface_unlit(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    mxg_ref emission = mxg_build_input(build, "emission_color");
    emission = op2(build, "mul", emission, mxg_build_input(build, "emission"));
    mxg_ref transmission = mxg_build_input(build, "transmission_color");
    transmission = op2(build, "mul", transmission, mxg_build_input(build, "transmission"));
    mxg_ref args[3] = {emission, transmission, mxg_build_input(build, "opacity")};
    results[0] = mxg_build_op(build, "surface_unlit", NULL, args, 3);
    return true;
}

static bool build_volume(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    return op_of(build, "volume", (const char *const[]){"vdf", "edf"}, 2, results);
}

static bool build_light(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    return op_of(build, "light", (const char *const[]){"edf", "intensity", "exposure"}, 3, results);
}

static bool build_displacement(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    return op_of(build, "displacement", (const char *const[]){"displacement", "scale"}, 2, results);
}

static bool build_surfacematerial(void *user_data, mxg_build *build, mxg_ref *results)
{
    mxg_ref args[] = {optional_input(build, "surfaceshader"),
                      optional_input(build, "backsurfaceshader"),
                      optional_input(build, "displacementshader"), 0};
    (void)user_data;
    if (!args[2])
        args[2] = code_issue(build, build_own_displacement(build->b, build->frame));
    results[0] = mxg_build_op(build, "material", NULL, args, 4);
    return true;
}

/* The argument of an input that the node sets; 0: it does not. */
static mxg_ref set_input(mxg_build *build, const char *name)
{
    const struct binding *bindings = build->frame->bindings;
    for (unsigned i = 0; bindings && i < build->def->num_inputs; i++)
        if (strcmp(mxg_build_port(build, i, NULL), name) == 0 && bindings[i].kind == BIND_DEFAULT)
            return 0;
    return mxg_build_input(build, name);
}

/* A mask or cut-out; 0: it is 1. */
static ir_ref set_share(const mxg_build *build, str_id name)
{
    ir_ref value = dynamic_arg(build, name);
    return ir_const_is(build->b->graph, value, 1.0f) ? 0 : value;
}

/* A constant mode, an enum ir_slot_mode; -1 after a report. */
static int constant_mode(mxg_build *build, const char *input)
{
    mxg_value value = MXG_INIT(mxg_value);
    if (!mxg_build_require_constant(build, input, &value))
        return -1;
    int mode = build_mode(value.text);
    if (mode < 0)
        mxg_build_report_error(build, input, "the modes are add, mix and none");
    return mode;
}

static bool build_substance(void *user_data, mxg_build *build, mxg_ref *results)
{
    int displacement = constant_mode(build, "displacement_mode"),
        normal = constant_mode(build, "normal_mode");
    if (displacement < 0 || normal < 0 || !build_surfacematerial(user_data, build, results))
        return false;
    ir_ref args[4] = {0, 0, set_share(build, STR_mask), set_share(build, STR_cutout)};
    if (!code_ref(build, results[0], &args[0])
        || !code_ref(build, set_input(build, "normal"), &args[1]))
        return false;
    if (args[1] || args[2] || args[3] || displacement != IR_SLOT_MIX)
        results[0] = code_issue(
            build, ir_build(build->b->graph, IR_SUBSTANCE, build->type,
                            build_modes((unsigned)displacement, (unsigned)normal), args, 4));
    return true;
}

static bool build_volumematerial(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    return op_of(build, "material", (const char *const[]){NULL, NULL, NULL, "volumeshader"}, 4,
                 results);
}

/*
 * The implementation of a choice: the first input is an index, from 0, into the inputs after it.
 * For a material the choice may have any type, because any value can be the root of a shader.
 */
static bool build_chosen_input(void *user_data, mxg_build *build, mxg_ref *results)
{
    struct builder *b = build->b;
    mxg_value number = MXG_INIT(mxg_value);
    (void)user_data;
    if (build->def->num_inputs < 2)
        return dynamic_misfit(build, "the built-in code needs a number and inputs to choose from");
    if (library_type_ir(b->lib, build->ports[0].type) != IR_TYPE_INT)
        return dynamic_misfit(build, "the built-in code needs an integer as its first input");
    if (!mxg_build_require_constant(build, build_text(b, build->ports[0].name), &number))
        return false;
    if (number.integer < 0 || number.integer >= build->def->num_inputs - 1)
        return dynamic_misfit(build, "it has no input with this number");
    ir_ref chosen = build->frame->args[number.integer + 1];
    bool is_any = build->type == IR_TYPE_MATERIAL,
         may_be_absent =
             is_any || ir_type_is_closure(build->type) || ir_type_is_shader(build->type);
    bool fits = chosen ? is_any || ir_type_of(b->graph, chosen) == build->type : may_be_absent;
    results[0] = code_issue(build, chosen);
    return fits || dynamic_misfit(build, "the chosen input has another type than the output");
}

/* ---- what the code needs of a definition, which may be one of the document ---- */

#define OF(type) ((uint32_t)1 << IR_TYPE_##type)
#define COLORS (OF(FLOAT) | OF(VEC3) | OF(VEC4))
#define VECTORS (OF(FLOAT) | OF(VEC2) | OF(VEC3) | OF(VEC4))
#define CLOSURES (OF(BSDF) | OF(EDF) | OF(VDF))
#define AOVS (OF(BOOL) | OF(INT) | VECTORS | OF(BSDF) | OF(EDF))
#define SHADERS (OF(SURFACE) | OF(VOLUME) | OF(DISPLACEMENT))
#define SAME 0u /* as the output */
static_assert(IR_NUM_TYPES <= 32, "a set of types has 32 bits");

enum { MAX_NEEDED = NUM_SLAB_INPUTS };

static const struct dynamic_node {
    str_id node;
    mxg_build_fn build;
    uint32_t output; /* sets of types */
    struct {
        str_id name;
        uint32_t types;
    } inputs[MAX_NEEDED];
} dynamic_nodes[] = {
    {STR_texcoord, build_texcoord, VECTORS, {{STR_index, OF(INT)}}},
    {STR_geomcolor, build_geomcolor, VECTORS, {{STR_index, OF(INT)}}},
    {STR_tangent, build_tangent, OF(VEC3), {{STR_space, OF(STRING)}, {STR_index, OF(INT)}}},
    {STR_bitangent, build_bitangent, OF(VEC3), {{STR_space, OF(STRING)}, {STR_index, OF(INT)}}},
    {STR_geompropvalue,
     dynamic_geomprop,
     VECTORS | OF(BOOL) | OF(INT),
     {{STR_geomprop, OF(STRING)}, {STR_default, SAME}}},
    {STR_geompropvalueuniform,
     dynamic_geomprop,
     OF(STRING) | OF(SAMPLER),
     {{STR_geomprop, OF(STRING)}, {STR_default, SAME}}},
    {STR_UsdPrimvarReader,
     dynamic_primvar,
     VECTORS | OF(BOOL) | OF(INT) | OF(STRING) | OF(SAMPLER),
     {{STR_varname, OF(STRING)}, {STR_fallback, SAME}}},
    {STR_blur,
     blur,
     VECTORS,
     {{STR_in, SAME}, {STR_size, OF(FLOAT)}, {STR_filtertype, OF(STRING)}}},
    {STR_layer, build_layer, OF(BSDF), {{STR_top, SAME}, {STR_base, OF(BSDF) | OF(VDF)}}},
    {STR_mix,
     build_mix,
     CLOSURES | SHADERS,
     {{STR_bg, SAME}, {STR_fg, SAME}, {STR_mix, OF(FLOAT)}}},
    {STR_add, build_add, CLOSURES, {{STR_in1, SAME}, {STR_in2, SAME}}},
    {STR_multiply, build_multiply, CLOSURES, {{STR_in1, SAME}, {STR_in2, OF(FLOAT) | OF(VEC3)}}},
    {STR_thinfilmbsdf,
     thin_film,
     OF(BSDF),
     {{STR_thickness, OF(FLOAT)}, {STR_ior, OF(FLOAT)}, {STR_base, OF(BSDF)}}},
    {STR_measured_edf,
     measured_edf,
     OF(EDF),
     {{STR_color, OF(VEC3)}, {STR_normal, OF(VEC3)}, {STR_file, OF(SAMPLER)}}},
    {STR_slab,
     dynamic_slab,
     OF(BSDF),
     {
#define SLAB_INPUT(name, type) {STR_##name, OF(type)},
#include "slabs/slabs.def"
#undef SLAB_INPUT
     }},
    {STR_slab_layer,
     dynamic_slab_layer,
     OF(BSDF),
     {{STR_top, SAME}, {STR_base, SAME}, {STR_thickness, OF(FLOAT)}}},
    {STR_slab_mix,
     dynamic_slab_mix,
     OF(BSDF),
     {{STR_bg, SAME}, {STR_fg, SAME}, {STR_mix, OF(FLOAT)}}},
    {STR_slab_coverage, dynamic_slab_coverage, OF(BSDF), {{STR_in, SAME}, {STR_weight, OF(FLOAT)}}},
    {STR_slab_select,
     dynamic_slab_select,
     OF(BSDF),
     {{STR_in1, SAME}, {STR_in2, SAME}, {STR_mask, OF(FLOAT)}}},
    {STR_slab_surface,
     dynamic_slab_surface,
     OF(SURFACE),
     {{STR_bsdf, OF(BSDF)}, {STR_thin, OF(BOOL)}, {STR_surface_thickness, OF(FLOAT)}}},
    {STR_surface,
     build_surface,
     OF(SURFACE),
     {{STR_bsdf, OF(BSDF)},
      {STR_edf, OF(EDF)},
      {STR_opacity, OF(FLOAT)},
      {STR_thin_walled, OF(BOOL)}}},
    {STR_surface_unlit,
     build_surface_unlit,
     OF(SURFACE),
     {{STR_emission, OF(FLOAT)},
      {STR_emission_color, OF(VEC3)},
      {STR_transmission, OF(FLOAT)},
      {STR_transmission_color, OF(VEC3)},
      {STR_opacity, OF(FLOAT)}}},
    {STR_volume, build_volume, OF(VOLUME), {{STR_vdf, OF(VDF)}, {STR_edf, OF(EDF)}}},
    {STR_light,
     build_light,
     OF(LIGHT),
     {{STR_edf, OF(EDF)}, {STR_intensity, OF(FLOAT)}, {STR_exposure, OF(FLOAT)}}},
    {STR_displacement,
     build_displacement,
     OF(DISPLACEMENT),
     {{STR_displacement, OF(FLOAT) | OF(VEC3)}, {STR_scale, OF(FLOAT)}}},
    {STR_surfacematerial,
     build_surfacematerial,
     OF(MATERIAL),
     {{STR_surfaceshader, OF(SURFACE)},
      {STR_backsurfaceshader, OF(SURFACE)},
      {STR_displacementshader, OF(DISPLACEMENT)}}},
    {STR_substance,
     build_substance,
     OF(MATERIAL),
     {{STR_surfaceshader, OF(SURFACE)},
      {STR_backsurfaceshader, OF(SURFACE)},
      {STR_displacementshader, OF(DISPLACEMENT)},
      {STR_normal, OF(VEC3)},
      {STR_mask, OF(FLOAT)},
      {STR_cutout, OF(FLOAT)},
      {STR_displacement_mode, OF(STRING)},
      {STR_normal_mode, OF(STRING)}}},
    {STR_ambientocclusion,
     dynamic_occlusion,
     OF(FLOAT),
     {{STR_coneangle, OF(FLOAT)}, {STR_maxdistance, OF(FLOAT)}}},
    {STR_aov, dynamic_aov, AOVS, {{STR_name, OF(STRING)}, {STR_value, SAME}}},
    {STR_aovpass,
     dynamic_aovpass,
     AOVS,
     {{STR_name, OF(STRING)}, {STR_source, OF(STRING)}, {STR_shader, OF(SURFACE)}}},
    {STR_volumematerial, build_volumematerial, OF(MATERIAL), {{STR_volumeshader, OF(VOLUME)}}},
    {STR_chosen_input, build_chosen_input, ~0u, {{0}}},
};

static bool is_in(ir_type_id type, uint32_t set)
{
    return type < IR_NUM_TYPES && set >> type & 1;
}

/* Closures and shaders may be absent; other inputs may not. */
static bool has_input(const struct mxg_build *build, str_id name, uint32_t types)
{
    for (unsigned i = 0; i < build->def->num_inputs; i++)
        if (build->ports[i].name == name) {
            ir_type_id type = library_type_ir(build->b->lib, build->ports[i].type);
            return types == SAME ? type == build->type : is_in(type, types);
        }
    return (types & ~(CLOSURES | SHADERS)) == 0 && types != SAME;
}

static const struct dynamic_node *find_code(str_id name)
{
    for (size_t i = 0; i < sizeof dynamic_nodes / sizeof *dynamic_nodes; i++)
        if (dynamic_nodes[i].node == name)
            return &dynamic_nodes[i];
    return NULL;
}

bool build_is_combined(const struct builder *b, const struct frame *frame)
{
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    const struct port *ports = library_ports(b->lib, frame->node.nodedef, NULL);
    bool is_result = false, is_operand = false;
    ir_type_id type = library_type_ir(b->lib, ports[def->num_inputs].type);
    for (unsigned i = 0; i < def->num_inputs + def->num_outputs; i++) {
        ir_type_id of_port = library_type_ir(b->lib, ports[i].type);
        bool is_opaque = ir_type_is_closure(of_port) || ir_type_is_shader(of_port);
        is_result |= is_opaque && i >= def->num_inputs;
        is_operand |= is_opaque && i < def->num_inputs;
    }
    /* closures of a target combine without the structs that hardware targets have for shaders */
    return find_code(def->node) && is_result
           && (is_operand || ((b->options->caps & CAP_CLOSURES) && !ir_type_is_closure(type)));
}

/* The first difference between the definition and the needs of the code; NULL: none. */
static const char *find_misfit(const struct mxg_build *build, const struct dynamic_node *code)
{
    if (build->def->num_outputs != 1 || !is_in(build->type, code->output))
        return "the built-in code computes one output of another type";
    for (unsigned i = 0; i < MAX_NEEDED && code->inputs[i].name; i++)
        if (!has_input(build, code->inputs[i].name, code->inputs[i].types)) {
            struct text fault;
            text_init(&fault, build->b->arena);
            text_fmt(&fault, "the built-in code needs the input '%s' with the type %s",
                     build_text(build->b, code->inputs[i].name),
                     code->inputs[i].types == SAME ? "of the output"
                                                   : "of the built-in definition");
            return text_cstr(&fault);
        }
    return NULL;
}

/* mxg_build_fn: the code for the node, if it fits the definition. */
static bool build_by_code(void *user_data, mxg_build *build, mxg_ref *results)
{
    const struct frame *frame = build->frame;
    bool is_chosen = frame->impl->kind == IMPL_DYNAMIC && frame->impl->ref == STR_chosen_input;
    const struct dynamic_node *code = find_code(is_chosen ? STR_chosen_input : build->def->node);
    if (!code) {
        struct builder *b = build->b;
        diag_add(b->diags, DIAG_ID_missing_dynamic, doc_place(&b->lib->doc, frame->impl->element),
                 build_text(b, frame->impl->name), build_text(b, build->def->node));
        return false;
    }
    const char *fault = find_misfit(build, code);
    return fault ? dynamic_misfit(build, fault) : code->build(user_data, build, results);
}

void build_dynamic(struct builder *b, const struct frame *frame, ir_ref *results)
{
    assert(frame->impl->nodedef == frame->node.nodedef);
    code_run(b, frame, build_by_code, NULL, NULL, results);
}
