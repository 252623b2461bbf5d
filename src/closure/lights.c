// SPDX-License-Identifier: Apache-2.0
/*
 * The current light in the light loop: the type of the bound light chooses direction and intensity.
 * Both are expressions over the members of u_lightData[i]. With several types they are variables,
 * so that a light computes only what its type needs:
 *
 *     if (type == 1) { L = L₁; intensity = I₁; }
 *     else { L = L₂; intensity = type == 2 ? I₂ : 0; }
 *
 * A light of unknown type is dark. Where all intensities are the light's colour times a number, the
 * variable is the number.
 */
#include "closure/closure_priv.h"

#include "ir/arithmetic.h"
#include "lower/lower.h"
#include "shader/formula.h"

#include <assert.h>

/* Light functions are inlined: each has one call. */
enum { MAX_LIGHT_NODES = 400 };

#define FAR 1e30f /* the distance of a light without a position */

static ir_ref member(struct shader *shader, uint32_t variable)
{
    assert(shader->interface.variables.items[variable].block == BLOCK_LIGHT_DATA);
    return ir_build(shader->graph, IR_CONTEXT, shader->interface.variables.items[variable].type,
                    variable, NULL, 0);
}

/*
 * Direction and intensity from the function of one light shader; of one of its points, with its
 * distance, if the light has a size.
 */
static void call_function(struct shader *shader, const struct closure_host *host,
                          const struct shader_light *light, ir_ref *results)
{
    assert(light->first_member + light->num_members <= shader->interface.light_members.len);
    struct lang_host see_through = *host->lang;
    see_through.max_inline_nodes = MAX_LIGHT_NODES;
    bool has_size = light->sample != LANG_NONE;
    ir_ref *args = ARENA_ARRAY(shader->arena, ir_ref, light->num_members + 2);
    for (uint32_t i = 0; i < light->num_members; i++)
        args[i] = member(shader, shader->interface.light_members.items[light->first_member + i]);
    args[light->num_members] = closure_position(shader, host);
    if (has_size)
        args[light->num_members + 1] = ir_convert(shader->graph, IR_TYPE_VEC2,
                                                  shader_stream(shader, STR_random, IR_TYPE_VEC4));
    lang_lower_call(shader->unit, shader->graph, &see_through,
                    has_size ? light->sample : light->function, args, results);
}

/*
 * Direction and intensity from verbatim source, which takes u_lightData[i] as a whole and the
 * shaded point.
 */
static void call_source(struct shader *shader, const struct closure_host *host,
                        const struct shader_light *light, ir_ref *results)
{
    struct ir_graph *g = shader->graph;
    const struct shader_verbatim *verbatim = &shader->sources.calls.items[light->source];
    ir_type_id type = shader->sources.result_types.items[verbatim->first_result];
    uint32_t callee = ir_add_callee(g, (struct ir_callee){.kind = IR_CALLEE_VERBATIM,
                                                          .index = light->source,
                                                          .name = verbatim->function});
    str_id name = str_intern_z(shader->strings, "LightData");
    struct ir_member member_of = {STR_type, IR_TYPE_INT};
    ir_type_id whole = (ir_type_id)ir_add_struct(g, name, &member_of, 1);
    ir_ref args[] = {ir_build(g, IR_CONTEXT, whole, IR_WHOLE_LIGHT, NULL, 0),
                     closure_position(shader, host)};
    ir_ref call = ir_build(g, IR_VERBATIM, IR_TYPE_VOID, callee, args, 2);
    ir_ref result = ir_build(g, IR_RESULT, type, 1, &call, 1);
    results[0] = ir_build(g, IR_MEMBER, IR_TYPE_VEC3, 1, &result, 1);
    results[1] = ir_build(g, IR_MEMBER, IR_TYPE_VEC3, 0, &result, 1);
}

/*
 * The emission of a light along `to_point`; the light's normal is the direction that it faces. 0:
 * no emission.
 */
static ir_ref emission(struct shader *shader, const struct closure_host *host, ir_ref edf,
                       ir_ref facing, ir_ref to_point)
{
    struct ir_graph *g = shader->graph;
    struct closure_point point = {
        .position = closure_position(shader, host), .normal = facing, .view = to_point};
    struct closure_host at_light = *host;
    at_light.point = &point;
    at_light.way_in = NULL;
    ir_ref sum = 0;
    struct closure_list list;
    closure_flatten(shader, &at_light, edf, &list);
    for (uint32_t i = 0; i < list.leaves.len; i++) {
        const struct closure_leaf *leaf = &list.leaves.items[i];
        ir_ref value = closure_call(shader, &at_light, leaf->leaf, LEAF_EMISSION, NULL);
        value = value ? ir_convert(g, IR_TYPE_VEC3,
                                   ir_product(g, value, ir_product(g, leaf->color, leaf->scalar)))
                      : 0;
        sum = value && sum ? ir_op2(g, IR_ADD, sum, value) : value ? value : sum;
    }
    return sum;
}

/* From the shaded point to the light whose member is `position`. */
static ir_ref to_light(struct shader *shader, const struct closure_host *host, uint32_t position)
{
    ir_ref at = member(shader, position);
    return ir_sub(shader->graph, at, closure_position(shader, host));
}

/*
 * A light made of nodes: its EDF at u_lightData[i].position, facing u_lightData[i].direction.
 *
 */
static void sample_emitter(struct shader *shader, const struct closure_host *host,
                           const struct shader_light *light, ir_ref *results)
{
    struct ir_graph *g = shader->graph;
    ir_ref facing = ir_op1(g, IR_NORMALIZE, member(shader, light->direction));
    ir_ref away = to_light(shader, host, light->position);
    ir_ref distance = ir_op1(g, IR_LENGTH, away);
    ir_ref normal = shader_stream(shader, STR_normalWorld, IR_TYPE_VEC3);
    ir_ref root =
        ir_replace(g, light->shader, normal, member(shader, light->direction), shader->arena);
    results[0] = ir_div(g, away, distance);
    ir_ref emitted = ir_arg(g, root, 0) ? emission(shader, host, ir_arg(g, root, 0), facing,
                                                   ir_op1(g, IR_NEG, results[0]))
                                        : 0;
    results[1] = emitted ? FORMULA(shader, "mx_light_of_emitter", emitted, ir_arg(g, root, 1),
                                   ir_arg(g, root, 2), distance)
                         : ir_black(g);
}

/*
 * The current light of a host: void mxg_light(int i, vec3 P, out vec3 L, out vec3 radiance).
 */
static void call_host(struct shader *shader, const struct closure_host *host,
                      struct closure_light *out)
{
    static const char *const names[] = {"L", "radiance"};
    struct ir_graph *g = shader->graph;
    struct shader_verbatim light = {.result_names = names,
                                    .function = str_intern_z(shader->strings, "mxg_light"),
                                    .num_results = 2,
                                    .first_result = shader->sources.result_types.len};
    for (uint32_t i = 0; i < light.num_results; i++)
        vec_push(shader->arena, &shader->sources.result_types, IR_TYPE_VEC3);
    vec_push(shader->arena, &shader->sources.calls, light);
    uint32_t callee = ir_add_callee(g, (struct ir_callee){.kind = IR_CALLEE_VERBATIM,
                                                          .index = shader->sources.calls.len - 1,
                                                          .name = light.function});
    ir_ref args[] = {ir_build(g, IR_CONTEXT, IR_TYPE_INT, IR_LIGHT_INDEX, NULL, 0),
                     closure_position(shader, host)};
    ir_push_name(g, STR_light);
    ir_ref call = ir_build(g, IR_VERBATIM, IR_TYPE_VOID, callee, args, 2);
    ir_pop_origin(g);
    out->direction = ir_build(g, IR_RESULT, IR_TYPE_VEC3, 1, &call, 1);
    out->intensity = ir_build(g, IR_RESULT, IR_TYPE_VEC3, 2, &call, 1);
}

static ir_ref type_of_light(struct shader *shader)
{
    return member(shader, shader_light_member(shader, STR_type, IR_TYPE_INT));
}

/* ---- The choice of the type ---- */

/* One type of light. */
struct one_light {
    ir_ref is_this; /* bool */
    ir_ref direction, intensity, distance;
};

/* True if the role asks for distances, and for lights of a size at one of their points. */
static bool is_for_paths(const struct shader *shader)
{
    return shader->role->returns == RETURNS_PATH;
}

/* The distance of a light without a size. */
static ir_ref distance_of(struct shader *shader, const struct closure_host *host,
                          const struct shader_light *light)
{
    if (light->shader)
        return ir_op1(shader->graph, IR_LENGTH, to_light(shader, host, light->position));
    for (uint32_t m = 0; m < light->num_members; m++) {
        uint32_t variable = shader->interface.light_members.items[light->first_member + m];
        const struct shader_variable *v = &shader->interface.variables.items[variable];
        if (v->name == STR_position && v->type == IR_TYPE_VEC3)
            return ir_op1(shader->graph, IR_LENGTH, to_light(shader, host, variable));
    }
    return ir_const_float(shader->graph, FAR);
}

static void sample_one(struct shader *shader, const struct closure_host *host,
                       const struct shader_light *light, struct one_light *out)
{
    struct ir_graph *g = shader->graph;
    ir_ref results[3] = {0}, type = type_of_light(shader);
    ir_push_name(g, light->name);
    if (light->shader)
        sample_emitter(shader, host, light, results);
    else if (light->source != UINT32_MAX)
        call_source(shader, host, light, results);
    else
        call_function(shader, host, light, results);
    *out = (struct one_light){.is_this = ir_op2(g, IR_EQ, type, ir_const_int(g, light->type)),
                              .direction = results[0],
                              .intensity = results[1],
                              .distance = results[2]};
    if (is_for_paths(shader) && !out->distance)
        out->distance = distance_of(shader, host, light);
    ir_pop_origin(g);
}

/* The colour of u_lightData[i] in colour · number; 0: the intensity is no such product. */
static ir_ref color_of(const struct ir_graph *g, ir_ref intensity, ir_ref *out_number)
{
    if (ir_get(g, intensity)->op != IR_MUL)
        return 0;
    for (unsigned i = 0; i < 2; i++) {
        ir_ref color = ir_arg(g, intensity, i), number = ir_arg(g, intensity, 1 - i);
        *out_number = number;
        if (ir_get(g, color)->op == IR_CONTEXT && ir_type_of(g, color) == IR_TYPE_VEC3
            && ir_type_of(g, number) == IR_TYPE_FLOAT)
            return color;
    }
    return 0;
}

/* Divides the intensities by the colour that they have in common. 0: there is none. */
static ir_ref split_color(const struct ir_graph *g, struct one_light *lights, uint32_t num)
{
    ir_ref number, common = color_of(g, lights->intensity, &number);
    for (uint32_t i = 1; i < num; i++)
        if (color_of(g, lights[i].intensity, &number) != common)
            return 0;
    for (uint32_t i = 0; common && i < num; i++)
        color_of(g, lights[i].intensity, &lights[i].intensity);
    return common;
}

static void choose(struct shader *shader, struct closure_light *out, enum effect_kind kind,
                   uint32_t local, ir_ref value)
{
    vec_push(shader->arena, &out->choice,
             (struct effect){.kind = (uint8_t)kind, .index = local, .value = value});
}

/* A variable of the light loop, set before its first use. */
static uint32_t declare(struct shader *shader, struct closure_light *out, str_id name, ir_ref first)
{
    uint32_t local = shader_add_local(shader, name, ir_type_of(shader->graph, first));
    shader->effects.locals.items[local].is_settled = true;
    choose(shader, out, EFFECT_VAR, local, 0);
    return local;
}

static ir_ref read_variable(struct shader *shader, uint32_t local)
{
    struct ir_graph *g = shader->graph;
    ir_ref light = ir_build(g, IR_CONTEXT, IR_TYPE_INT, IR_LIGHT_INDEX, NULL, 0);
    return ir_build(g, IR_LOCAL, shader->effects.locals.items[local].type, local, &light, 1);
}

static bool have_one_direction(const struct one_light *lights, uint32_t num)
{
    for (uint32_t i = 1; i < num; i++)
        if (lights[i].direction != lights->direction)
            return false;
    return true;
}

/* Several types: the last one stands for all others, dark. */
static void choose_light(struct shader *shader, struct one_light *lights, uint32_t num,
                         struct closure_light *out)
{
    struct ir_graph *g = shader->graph;
    ir_ref color = split_color(g, lights, num);
    uint32_t direction = declare(shader, out, STR_L, lights->direction),
             intensity = declare(shader, out, STR_intensity, lights->intensity);
    bool has_direction = false, has_distance = lights->distance != 0;
    uint32_t distance =
        has_distance ? declare(shader, out, STR_away, lights->distance) : UINT32_MAX;
    for (uint32_t i = 0; i < num; i++) {
        bool is_common = !has_direction && have_one_direction(&lights[i], num - i);
        if (is_common)
            choose(shader, out, EFFECT_ASSIGN, direction, lights[i].direction);
        has_direction |= is_common;
        if (i + 1 < num)
            choose(shader, out, EFFECT_IF, 0, lights[i].is_this);
        if (!has_direction)
            choose(shader, out, EFFECT_ASSIGN, direction, lights[i].direction);
        choose(shader, out, EFFECT_ASSIGN, intensity, lights[i].intensity);
        if (has_distance)
            choose(shader, out, EFFECT_ASSIGN, distance, lights[i].distance);
        if (i + 1 < num)
            choose(shader, out, EFFECT_ELSE, 0, 0);
    }
    for (uint32_t i = 1; i < num; i++)
        choose(shader, out, EFFECT_END, 0, 0);
    out->direction = read_variable(shader, direction);
    out->intensity = ir_product(g, color, read_variable(shader, intensity));
    out->distance = has_distance ? read_variable(shader, distance) : 0;
}

void closure_sample_light(struct shader *shader, const struct closure_host *host,
                          struct closure_light *out)
{
    struct ir_graph *g = shader->graph;
    closure_position(shader, host); /* once, outside the loop */
    *out = (struct closure_light){.distance = ir_const_float(g, FAR)};
    if (shader->lights == LIGHTS_OF_HOST) {
        call_host(shader, host, out);
        return;
    }
    uint32_t num = shader->interface.lights.len;
    assert(num > 0);
    struct one_light *lights = ARENA_ARRAY(shader->arena, struct one_light, num);
    for (uint32_t i = num; i-- > 0;)
        sample_one(shader, host, &shader->interface.lights.items[i], &lights[i]);
    struct one_light *last = &lights[num - 1];
    ir_ref dark = ir_const_splat(g, IR_TYPE_VEC3, 0.0f);
    last->intensity = ir_op3(g, IR_SELECT, last->is_this, last->intensity, dark);
    if (num > 1) {
        choose_light(shader, lights, num, out);
        return;
    }
    out->direction = last->direction;
    out->intensity = last->intensity;
    out->distance = last->distance;
    ir_suggest_name(g, out->direction, STR_L, IR_NAME_ROLE);
    ir_suggest_name(g, out->intensity, STR_light, IR_NAME_ROLE);
}
