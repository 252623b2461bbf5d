// SPDX-License-Identifier: Apache-2.0
/*
 * Dynamic implementations: named streams, and the constructors of closures and shaders, each of
 * which is an op of the IR.
 */
#include "build/build_priv.h"

struct call {
    struct builder *b;
    const struct frame *frame;
    const struct nodedef *def;
    const struct port *ports;
    ir_type_id type; /* type of the first output */
};

static ir_ref arg(const struct call *c, str_id name)
{
    for (unsigned i = 0; i < c->def->num_inputs; i++)
        if (c->ports[i].name == name)
            return c->frame->args[i];
    return 0;
}

static ir_ref build_op(const struct call *c, enum ir_op op, const ir_ref *args, unsigned n)
{
    return ir_build(c->b->graph, op, c->type, 0, args, n);
}

static ir_ref misfit(const struct call *c, const char *fault)
{
    diag_add(c->b->diags, DIAG_ID_function_signature,
             doc_place(&c->b->lib->doc, c->frame->impl->element), build_text(c->b, c->def->node),
             build_text(c->b, c->def->name), fault);
    return ir_poison(c->b->graph, c->type);
}

/* ---- streams ---- */

static ir_ref not_constant(const struct call *c, str_id input)
{
    /* the fault is already reported */
    if (ir_get(c->b->graph, arg(c, input))->op == IR_POISON)
        return ir_poison(c->b->graph, c->type);
    diag_add(c->b->diags, DIAG_ID_input_must_be_constant,
             doc_place(&c->b->lib->doc, c->frame->node.element), build_text(c->b, input),
             build_text(c->b, c->def->node));
    return ir_poison(c->b->graph, c->type);
}

static ir_ref named_stream(const struct call *c, const char *prefix, str_id name, uint32_t number,
                           ir_type_id type)
{
    struct text full;
    text_init(&full, c->b->arena);
    text_str(&full, prefix);
    if (name)
        text_str(&full, build_text(c->b, name));
    else
        text_u32(&full, number);
    return shader_stream(c->b->shader, str_intern(c->b->shader->strings, full.data, full.len),
                         type);
}

/*
 * Fits a stream to the number of components of the node's output: drops components, or fills with
 * 0.
 */
static ir_ref fit_components(const struct call *c, ir_ref value)
{
    static const uint8_t first[] = {0, 1, 2, 3};
    struct ir_graph *g = c->b->graph;
    unsigned have = ir_type_info(ir_type_of(g, value))->components,
             want = ir_type_info(c->type)->components;
    if (want < have)
        return ir_swizzle(g, value, first, want);
    if (want == have)
        return value;
    ir_ref parts[4] = {value};
    unsigned n = 1;
    for (unsigned i = have; i < want; i++)
        parts[n++] = ir_const_float(g, 0.0f);
    return ir_construct(g, c->type, parts, n);
}

static ir_ref indexed_stream(const struct call *c, const char *prefix, ir_type_id type)
{
    struct ir_value index;
    if (!build_initial(c->b, arg(c, STR_index), &index) || index.w[0].i < 0)
        return not_constant(c, STR_index);
    return fit_components(c, named_stream(c, prefix, 0, (uint32_t)index.w[0].i, type));
}

static ir_ref build_texcoord(const struct call *c)
{
    return indexed_stream(c, "texcoord_", IR_TYPE_VEC2);
}

static ir_ref build_geomcolor(const struct call *c)
{
    return indexed_stream(c, "color_", IR_TYPE_VEC4);
}

/* The change of a value, or of a part of it, from pixel to pixel. */
static ir_ref change(const struct call *c, enum ir_op axis, ir_ref value, int part)
{
    assert(part < (int)ir_type_info(ir_type_of(c->b->graph, value))->components);
    ir_ref all = ir_op1(c->b->graph, axis, value);
    return part < 0 ? all : ir_component(c->b->graph, all, (unsigned)part);
}

/*
 * Tangent and bitangent for texture coordinates other than the first. They follow from the change
 * of the point P and of the coordinates from pixel to pixel, up to a positive factor:
 *
 *     T = (dP/dx · dv/dy - dP/dy · dv/dx) sign D
 *     B = (dP/dy · du/dx - dP/dx · du/dy) sign D
 *     D = du/dx · dv/dy - du/dy · dv/dx
 */
static ir_ref tangent_of(const struct call *c, ir_ref point, ir_ref uv, bool along_v)
{
    struct ir_graph *g = c->b->graph;
    enum ir_op first = along_v ? IR_DFDY : IR_DFDX, second = along_v ? IR_DFDX : IR_DFDY;
    int across = along_v ? 0 : 1; /* the coordinate that does not change along the tangent */
    ir_ref sum = ir_op2(
        g, IR_SUB, ir_op2(g, IR_MUL, change(c, first, point, -1), change(c, second, uv, across)),
        ir_op2(g, IR_MUL, change(c, second, point, -1), change(c, first, uv, across)));
    ir_ref area =
        ir_op2(g, IR_SUB, ir_op2(g, IR_MUL, change(c, IR_DFDX, uv, 0), change(c, IR_DFDY, uv, 1)),
               ir_op2(g, IR_MUL, change(c, IR_DFDY, uv, 0), change(c, IR_DFDX, uv, 1)));
    return ir_op1(g, IR_NORMALIZE, ir_op2(g, IR_MUL, sum, ir_op1(g, IR_SIGN, area)));
}

static ir_ref build_axis(const struct call *c, str_id object, str_id world, bool along_v)
{
    struct ir_value index = {.type = IR_TYPE_INT}, space;
    if (c->b->options->indexed_tangents
        && (!build_initial(c->b, arg(c, STR_index), &index) || index.w[0].i < 0))
        return not_constant(c, STR_index);
    if (!ir_get_const(c->b->graph, arg(c, STR_space), &space))
        return not_constant(c, STR_space);
    bool is_world = space.w[0].u == STR_world;
    if (index.w[0].i == 0)
        return ir_op1(c->b->graph, IR_NORMALIZE,
                      shader_stream(c->b->shader, is_world ? world : object, IR_TYPE_VEC3));
    ir_ref uv = named_stream(c, "texcoord_", 0, (uint32_t)index.w[0].i, IR_TYPE_VEC2);
    ir_ref point = shader_stream(c->b->shader, is_world ? STR_positionWorld : STR_positionObject,
                                 IR_TYPE_VEC3);
    return tangent_of(c, point, uv, along_v);
}

static ir_ref build_tangent(const struct call *c)
{
    return build_axis(c, STR_tangentObject, STR_tangentWorld, false);
}

static ir_ref build_bitangent(const struct call *c)
{
    return build_axis(c, STR_bitangentObject, STR_bitangentWorld, true);
}

/* Records the value that hosts bind if the geometry lacks the property. */
static void record_default(const struct call *c, uint32_t index)
{
    assert(index < c->b->shader->variables.len);
    struct shader_variable *variable = &c->b->shader->variables.items[index];
    struct ir_value value;
    if (!variable->has_default && build_initial(c->b, arg(c, STR_default), &value)
        && value.type == variable->type) {
        variable->has_default = true;
        variable->value = value;
    }
}

static ir_ref geomprop_uniform(const struct call *c, str_id name)
{
    struct text full;
    text_init(&full, c->b->arena);
    text_fmt(&full, "u_geomprop_%s", build_text(c->b, name));
    str_id id = str_intern(c->b->shader->strings, full.data, full.len);
    uint32_t variable = shader_private_uniform(c->b->shader, id, c->type, 0);
    if (c->type == IR_TYPE_BOOL)
        record_default(c, variable);
    return ir_build(c->b->graph, c->type == IR_TYPE_SAMPLER ? IR_TEXTURE : IR_UNIFORM, c->type,
                    variable, NULL, 0);
}

/*
 * Booleans cannot be interpolated, and strings cannot be streams: hosts set them per object (as in
 * MaterialX 1.39).
 */
static ir_ref build_geompropvalue(const struct call *c)
{
    struct ir_value name;
    if (!ir_get_const(c->b->graph, arg(c, STR_geomprop), &name))
        return not_constant(c, STR_geomprop);
    if (!name.w[0].u)
        return arg(c, STR_default); /* the node names no property */
    if (c->type == IR_TYPE_STRING)
        return arg(c, STR_default);
    if (c->type == IR_TYPE_BOOL || c->type == IR_TYPE_SAMPLER)
        return geomprop_uniform(c, name.w[0].u);
    ir_ref stream = named_stream(c, "geomprop_", name.w[0].u, 0, c->type);
    uint32_t attribute;
    if (ir_get(c->b->graph, stream)->op == IR_STREAM) {
        record_default(c, ir_get(c->b->graph, stream)->attr);
        if (shader_attribute(c->b->shader, ir_get(c->b->graph, stream)->attr, &attribute))
            record_default(c, attribute);
    }
    return stream;
}

static ir_ref blur(const struct call *c)
{
    return build_blur(c->b, arg(c, STR_in), arg(c, STR_size), arg(c, STR_filtertype),
                      c->frame->node.element);
}

/* ---- closures; ref 0 is "no closure", the neutral element of these ops ---- */

static ir_ref build_layer(const struct call *c)
{
    ir_ref args[2] = {arg(c, STR_top), arg(c, STR_base)};
    if (!args[0] || !args[1])
        return args[0] ? args[0] : args[1];
    return build_op(c, IR_LAYER, args, 2);
}

static ir_ref build_mix(const struct call *c)
{
    ir_ref args[3] = {arg(c, STR_bg), arg(c, STR_fg), arg(c, STR_mix)};
    if (ir_const_is(c->b->graph, args[2], 0.0f) || args[0] == args[1])
        return args[0];
    if (ir_const_is(c->b->graph, args[2], 1.0f))
        return args[1];
    return build_op(c, ir_type_is_closure(c->type) ? IR_CLOSURE_MIX : IR_SHADER_MIX, args, 3);
}

static ir_ref build_add(const struct call *c)
{
    ir_ref args[2] = {arg(c, STR_in1), arg(c, STR_in2)};
    if (!args[0] || !args[1])
        return args[0] ? args[0] : args[1];
    return build_op(c, IR_CLOSURE_ADD, args, 2);
}

static ir_ref build_multiply(const struct call *c)
{
    ir_ref args[2] = {arg(c, STR_in1), arg(c, STR_in2)};
    if (!args[0] || ir_const_is(c->b->graph, args[1], 1.0f))
        return args[0];
    return build_op(c, IR_CLOSURE_SCALE, args, 2);
}

static ir_ref thin_film(const struct call *c)
{
    return build_film(c->b, arg(c, STR_thickness), arg(c, STR_ior), arg(c, STR_base),
                      c->frame->node.element);
}

static ir_ref measured_edf(const struct call *c)
{
    return build_measured_edf(c->b, arg(c, STR_color), arg(c, STR_normal), arg(c, STR_file),
                              c->frame->node.element);
}

/* ---- slabs ---- */

/* A layer of an OSL network is complete before anyone knows where its slabs lie. */
static bool is_in_network(const struct call *c)
{
    if (c->b->recorder)
        diag_add(c->b->diags, DIAG_ID_slab_in_network,
                 doc_place(&c->b->lib->doc, c->frame->node.element),
                 build_text(c->b, c->def->node));
    return c->b->recorder != NULL;
}

/* Parts of slabs that have no code yet: an error, so that none is lost in silence. */
static ir_ref not_yet(const struct call *c, str_id input, const char *part)
{
    diag_add(c->b->diags, DIAG_ID_slab_part_missing,
             doc_place(&c->b->lib->doc, c->frame->node.element), build_text(c->b, input),
             build_text(c->b, c->def->node), part);
    return ir_poison(c->b->graph, c->type);
}

/* True if an input has its default of 0, false or no file, or the definition lacks it. */
static bool is_off(const struct call *c, str_id input)
{
    struct ir_value value;
    ir_ref ref = arg(c, input);
    if (!ref)
        return true;
    if (ir_get(c->b->graph, ref)->op == IR_TEXTURE)
        return !*build_text(c->b,
                            c->b->shader->variables.items[ir_get(c->b->graph, ref)->attr].file);
    return build_initial(c->b, ref, &value) && value.w[0].u == 0;
}

static ir_ref build_slab(const struct call *c)
{
    static const str_id names[NUM_SLAB_INPUTS] = {
#define SLAB_INPUT(name, type) STR_##name,
#include "slabs/slabs.def"
#undef SLAB_INPUT
    };
    if (!is_off(c, STR_glint_density))
        return not_yet(c, STR_glint_density, "glints");
    if (!is_off(c, STR_specular_lut))
        return not_yet(c, STR_specular_lut, "tints by view and light");
    if (build_slab_definition(c->b) == LIBRARY_NONE)
        return misfit(c, "the library lacks the definition 'ND_slab_lobes'");
    if (is_in_network(c))
        return ir_poison(c->b->graph, c->type);
    ir_ref args[NUM_SLAB_OPERANDS];
    for (unsigned i = 0; i < NUM_SLAB_INPUTS; i++)
        args[i] = arg(c, names[i]);
    args[SLAB_coverage] = ir_const_float(c->b->graph, 1.0f);
    return build_op(c, IR_SLAB, args, NUM_SLAB_OPERANDS);
}

static ir_ref build_slab_layer(const struct call *c)
{
    ir_ref args[3] = {arg(c, STR_top), arg(c, STR_base), arg(c, STR_thickness)};
    if (!is_off(c, STR_blend_parameters))
        return not_yet(c, STR_blend_parameters, "parameter blending");
    return args[0] ? build_op(c, IR_SLAB_LAYER, args, 3) : args[1];
}

/* bg (1 - share) + fg share; 0 is no matter. */
static ir_ref beside(const struct call *c, ir_ref bg, ir_ref fg, ir_ref share)
{
    ir_ref args[3] = {bg, fg, share};
    if (!is_off(c, STR_blend_parameters))
        return not_yet(c, STR_blend_parameters, "parameter blending");
    if (bg == fg || ir_const_is(c->b->graph, share, 0.0f))
        return bg;
    return ir_const_is(c->b->graph, share, 1.0f) ? fg : build_op(c, IR_CLOSURE_MIX, args, 3);
}

static ir_ref build_slab_mix(const struct call *c)
{
    return beside(c, arg(c, STR_bg), arg(c, STR_fg), arg(c, STR_mix));
}

static ir_ref build_slab_coverage(const struct call *c)
{
    return beside(c, 0, arg(c, STR_in), arg(c, STR_weight));
}

static ir_ref build_slab_select(const struct call *c)
{
    struct ir_graph *g = c->b->graph;
    ir_ref is_second = ir_op2(g, IR_GT, arg(c, STR_mask), ir_const_float(g, 0.5f));
    ir_ref one = ir_const_float(g, 1.0f), zero = ir_const_float(g, 0.0f);
    return beside(c, arg(c, STR_in1), arg(c, STR_in2), ir_op3(g, IR_SELECT, is_second, one, zero));
}

static ir_ref build_slab_surface(const struct call *c)
{
    struct ir_value thin;
    if (!build_initial(c->b, arg(c, STR_thin), &thin))
        return not_constant(c, STR_thin);
    ir_ref args[3] = {arg(c, STR_bsdf), ir_const_bool(c->b->graph, thin.w[0].u != 0),
                      arg(c, STR_surface_thickness)};
    return build_op(c, IR_SLAB_SURFACE, args, 3);
}

/* ---- shaders ---- */

static ir_ref build_surface(const struct call *c)
{
    ir_ref args[4] = {arg(c, STR_bsdf), arg(c, STR_edf), arg(c, STR_opacity),
                      arg(c, STR_thin_walled)};
    return build_op(c, IR_SURFACE_SHADER, args, 4);
}

static ir_ref build_surface_unlit(const struct call *c)
{
    struct ir_graph *g = c->b->graph;
    ir_ref args[3] = {ir_op2(g, IR_MUL, arg(c, STR_emission_color), arg(c, STR_emission)),
                      ir_op2(g, IR_MUL, arg(c, STR_transmission_color), arg(c, STR_transmission)),
                      arg(c, STR_opacity)};
    return build_op(c, IR_SURFACE_UNLIT, args, 3);
}

static ir_ref build_volume(const struct call *c)
{
    ir_ref args[2] = {arg(c, STR_vdf), arg(c, STR_edf)};
    return build_op(c, IR_VOLUME_SHADER, args, 2);
}

static ir_ref build_light(const struct call *c)
{
    ir_ref args[3] = {arg(c, STR_edf), arg(c, STR_intensity), arg(c, STR_exposure)};
    return build_op(c, IR_LIGHT_SHADER, args, 3);
}

static ir_ref build_displacement(const struct call *c)
{
    ir_ref args[2] = {arg(c, STR_displacement), arg(c, STR_scale)};
    return build_op(c, IR_DISPLACEMENT_SHADER, args, 2);
}

static ir_ref build_surfacematerial(const struct call *c)
{
    ir_ref args[4] = {arg(c, STR_surfaceshader), arg(c, STR_backsurfaceshader),
                      arg(c, STR_displacementshader), 0};
    return build_op(c, IR_MATERIAL, args, 4);
}

/* The argument of an input that the node sets; 0: it does not. */
static ir_ref said(const struct call *c, str_id name)
{
    for (unsigned i = 0; c->frame->bindings && i < c->def->num_inputs; i++)
        if (c->ports[i].name == name && c->frame->bindings[i].kind == BIND_DEFAULT)
            return 0;
    return arg(c, name);
}

static int mode(const struct call *c, str_id name)
{
    struct ir_value value;
    if (!build_initial(c->b, arg(c, name), &value))
        return -1;
    return build_mode(build_text(c->b, value.w[0].u));
}

static ir_ref build_substance(const struct call *c)
{
    ir_ref material = build_surfacematerial(c),
           args[4] = {material, said(c, STR_normal), arg(c, STR_mask), arg(c, STR_cutout)};
    int displacement = mode(c, STR_displacement_mode), normal = mode(c, STR_normal_mode);
    if (displacement < 0 || normal < 0)
        return not_constant(c, displacement < 0 ? STR_displacement_mode : STR_normal_mode);
    for (unsigned i = 2; i < 4; i++)
        if (ir_const_is(c->b->graph, args[i], 1.0f))
            args[i] = 0;
    bool is_plain = !args[1] && !args[2] && !args[3] && displacement == IR_SLOT_MIX;
    return is_plain ? material
                    : ir_build(c->b->graph, IR_SUBSTANCE, c->type,
                               build_modes((unsigned)displacement, (unsigned)normal), args, 4);
}

static ir_ref build_volumematerial(const struct call *c)
{
    ir_ref args[4] = {0, 0, 0, arg(c, STR_volumeshader)};
    return build_op(c, IR_MATERIAL, args, 4);
}

/*
 * The implementation of a choice: the first input is an index, from 0, into the inputs after it.
 * For a material the choice may have any type, because any value can be the root of a shader.
 */
static ir_ref build_chosen_input(const struct call *c)
{
    struct ir_value number = {.type = IR_TYPE_VOID};
    if (c->def->num_inputs < 2)
        return misfit(c, "the built-in code needs a number and inputs to choose from");
    if (!build_initial(c->b, c->frame->args[0], &number) || number.type != IR_TYPE_INT)
        return not_constant(c, c->ports[0].name);
    if (number.w[0].u >= c->def->num_inputs - 1u)
        return misfit(c, "it has no input with this number");
    ir_ref chosen = c->frame->args[number.w[0].u + 1];
    bool is_any = c->type == IR_TYPE_MATERIAL,
         may_be_absent = is_any || ir_type_is_closure(c->type) || ir_type_is_shader(c->type);
    bool fits = chosen ? is_any || ir_type_of(c->b->graph, chosen) == c->type : may_be_absent;
    return fits ? chosen : misfit(c, "the chosen input has another type than the output");
}

/* ---- what the code needs of a definition, which may be one of the document ---- */

#define OF(type) ((uint32_t)1 << IR_TYPE_##type)
#define COLORS (OF(FLOAT) | OF(VEC3) | OF(VEC4))
#define VECTORS (OF(FLOAT) | OF(VEC2) | OF(VEC3) | OF(VEC4))
#define CLOSURES (OF(BSDF) | OF(EDF) | OF(VDF))
#define SHADERS (OF(SURFACE) | OF(VOLUME) | OF(DISPLACEMENT))
#define SAME 0u /* as the output */
static_assert(IR_NUM_TYPES <= 32, "a set of types has 32 bits");

enum { MAX_NEEDED = NUM_SLAB_INPUTS };

static const struct dynamic_node {
    str_id node;
    ir_ref (*build)(const struct call *call);
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
     build_geompropvalue,
     VECTORS | OF(BOOL) | OF(INT),
     {{STR_geomprop, OF(STRING)}, {STR_default, SAME}}},
    {STR_geompropvalueuniform,
     build_geompropvalue,
     OF(STRING) | OF(SAMPLER),
     {{STR_geomprop, OF(STRING)}, {STR_default, SAME}}},
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
     build_slab,
     OF(BSDF),
     {
#define SLAB_INPUT(name, type) {STR_##name, OF(type)},
#include "slabs/slabs.def"
#undef SLAB_INPUT
     }},
    {STR_slab_layer,
     build_slab_layer,
     OF(BSDF),
     {{STR_top, SAME}, {STR_base, SAME}, {STR_thickness, OF(FLOAT)}}},
    {STR_slab_mix,
     build_slab_mix,
     OF(BSDF),
     {{STR_bg, SAME}, {STR_fg, SAME}, {STR_mix, OF(FLOAT)}}},
    {STR_slab_coverage, build_slab_coverage, OF(BSDF), {{STR_in, SAME}, {STR_weight, OF(FLOAT)}}},
    {STR_slab_select,
     build_slab_select,
     OF(BSDF),
     {{STR_in1, SAME}, {STR_in2, SAME}, {STR_mask, OF(FLOAT)}}},
    {STR_slab_surface,
     build_slab_surface,
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
    {STR_volumematerial, build_volumematerial, OF(MATERIAL), {{STR_volumeshader, OF(VOLUME)}}},
    {STR_chosen_input, build_chosen_input, ~0u, {{0}}},
};

static bool is_in(ir_type_id type, uint32_t set)
{
    return type < IR_NUM_TYPES && set >> type & 1;
}

/* Closures and shaders may be absent; other inputs may not. */
static bool has_input(const struct call *c, str_id name, uint32_t types)
{
    for (unsigned i = 0; i < c->def->num_inputs; i++)
        if (c->ports[i].name == name) {
            ir_type_id type = library_type_ir(c->b->lib, c->ports[i].type);
            return types == SAME ? type == c->type : is_in(type, types);
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

/* The first difference between the definition and the needs of the code; NULL: none. */
static const char *find_misfit(const struct call *c, const struct dynamic_node *code)
{
    if (c->def->num_outputs != 1 || !is_in(c->type, code->output))
        return "the built-in code computes one output of another type";
    for (unsigned i = 0; i < MAX_NEEDED && code->inputs[i].name; i++)
        if (!has_input(c, code->inputs[i].name, code->inputs[i].types)) {
            struct text fault;
            text_init(&fault, c->b->arena);
            text_fmt(&fault, "the built-in code needs the input '%s' with the type %s",
                     build_text(c->b, code->inputs[i].name),
                     code->inputs[i].types == SAME ? "of the output"
                                                   : "of the built-in definition");
            return text_cstr(&fault);
        }
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
           && (is_operand || (b->options->closures && !ir_type_is_closure(type)));
}

bool build_dynamic(struct builder *b, const struct frame *frame, ir_ref *results)
{
    assert(frame->impl->nodedef == frame->node.nodedef);
    struct call call = {b, frame, library_nodedef(b->lib, frame->node.nodedef),
                        library_ports(b->lib, frame->node.nodedef, NULL), IR_TYPE_VOID};
    call.type = library_type_ir(b->lib, call.ports[call.def->num_inputs].type);
    bool is_chosen = frame->impl->kind == IMPL_DYNAMIC && frame->impl->ref == STR_chosen_input;
    const struct dynamic_node *code = find_code(is_chosen ? STR_chosen_input : call.def->node);
    if (!code)
        diag_add(b->diags, DIAG_ID_missing_dynamic, doc_place(&b->lib->doc, frame->impl->element),
                 build_text(b, frame->impl->name), build_text(b, call.def->node));
    const char *fault = code ? find_misfit(&call, code) : NULL;
    if (code && !fault)
        results[0] = code->build(&call);
    else if (fault)
        misfit(&call, fault);
    return code && !fault;
}
