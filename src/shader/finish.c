// SPDX-License-Identifier: Apache-2.0
/*
 * finish: makes a built shader ready for the speller. The pixel stage comes first, because it
 * decides which vertex data the vertex stage must write.
 */
#include "shader/verbatim.h"

#include <assert.h>

static void mark_read(struct shader *shader, uint32_t variable, enum shader_stage_id stage)
{
    assert(variable < shader->interface.variables.len && stage < NUM_STAGES);
    shader->interface.variables.items[variable].stages |= (uint8_t)(1u << stage);
}

static void complete_loops(struct shader *shader, enum shader_stage_id id)
{
    struct shader_stage *stage = &shader->stages[id];
    for (uint32_t i = 0; i < stage->effects.len; i++)
        stage->has_lights |= stage->effects.items[i].kind == EFFECT_LIGHTS;
    if (!stage->has_lights || shader->lights != LIGHTS_IN_SHADER)
        return;
    mark_read(shader, shader_private_uniform(shader, STR_u_numActiveLightSources, IR_TYPE_INT, 0),
              id);
    mark_read(shader, shader_light_member(shader, STR_type, IR_TYPE_INT), id);
    for (uint32_t i = 0; i < shader->interface.light_members.len; i++)
        mark_read(shader, shader->interface.light_members.items[i], id);
}

/* Adds the host data that called portable functions and verbatim sources read. */
static void add_globals(struct shader *shader, enum shader_stage_id id)
{
    const struct lang_reach *reach = &shader->stages[id].reach;
    shader_mark_sources(shader, id);
    for (uint32_t i = 0; i < reach->globals.len; i++) {
        const struct lang_global *global = lang_global(shader->unit, reach->globals.items[i], NULL);
        if (global->kind == LANG_GLOBAL_UNIFORM)
            mark_read(shader,
                      shader_private_uniform(shader, global->name, global->type,
                                             (uint16_t)global->array_length),
                      id);
        else if (global->kind == LANG_GLOBAL_STREAM
                 && shader_stream(shader, global->name, global->type))
            mark_read(shader, shader_global_variable(shader, reach->globals.items[i]), id);
    }
}

static void mark_outputs(struct shader *shader, enum shader_stage_id id)
{
    const struct effect_list *effects = &shader->stages[id].effects;
    for (uint32_t i = 0; i < effects->len; i++)
        if (effects->items[i].kind == EFFECT_OUTPUT)
            mark_read(shader, effects->items[i].index, id);
}

/* Drops the vertex data that the pixel stage does not read, and adds the position. */
static void complete_vertex_stage(struct shader *shader)
{
    struct effect_list *effects = &shader->stages[STAGE_VERTEX].effects;
    bool has_position = false;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < effects->len; i++)
        if (effects->items[i].kind == EFFECT_POSITION) {
            effects->items[i].value = shader_at_vertices(shader, effects->items[i].value);
            has_position = true;
        }
    for (uint32_t i = 0; i < effects->len; i++) {
        const struct effect *effect = &effects->items[i];
        if (effect->kind != EFFECT_OUTPUT
            || shader->interface.variables.items[effect->index].stages)
            effects->items[kept++] = *effect;
    }
    assert(kept <= effects->len);
    effects->len = kept;
    if (has_position)
        return;
    struct ir_graph *graph = shader->graph;
    ir_ref world = shader_vertex_stream(shader, STR_positionWorld, IR_TYPE_VOID);
    ir_ref homogeneous = ir_arg(graph, world, 0); /* the stream is this value without w */
    assert(ir_type_of(graph, homogeneous) == IR_TYPE_VEC4);
    ir_ref matrix = shader_read(
        shader, shader_private_uniform(shader, STR_u_viewProjectionMatrix, IR_TYPE_MAT4, 0));
    ir_ref position = ir_build(graph, IR_MUL, IR_TYPE_VEC4, 0, (ir_ref[]){matrix, homogeneous}, 2);
    shader_effect(shader, STAGE_VERTEX,
                  (struct effect){.kind = EFFECT_POSITION, .value = position});
}

/* Functions that the pixel stage calls and the host writes. */
static void find_host_functions(struct shader *shader)
{
    static const char *const lights[] = {"mxg_light_count", "mxg_light"};
    const struct shader_stage *stage = &shader->stages[STAGE_PIXEL];
    bool has_lights = stage->has_lights && shader->lights == LIGHTS_OF_HOST;
    for (unsigned i = 0; has_lights && i < sizeof lights / sizeof *lights; i++)
        vec_push(shader->arena, &shader->reflection.host_functions,
                 str_intern_z(shader->strings, lights[i]));
    for (uint32_t i = 0; i < stage->reach.functions.len; i++) {
        const struct lang_function *fn =
            lang_function(shader->unit, stage->reach.functions.items[i], NULL);
        if (!fn->body)
            vec_push(shader->arena, &shader->reflection.host_functions, fn->name);
    }
}

static void name_neutrally(struct shader *shader)
{
    uint32_t uniforms = 0, textures = 0;
    for (uint32_t i = 0; i < shader->interface.used.len; i++) {
        struct shader_variable *variable = shader_interface_variable(shader, i);
        bool texture = variable->block == BLOCK_TEXTURES && !variable->semantic;
        if (variable->block != BLOCK_PUBLIC_UNIFORMS && !texture)
            continue;
        struct text name;
        text_init(&name, shader->arena);
        text_str(&name, shader->interface.naming.prefix);
        text_str(&name, texture ? "t_" : "u_");
        text_u32(&name, texture ? textures++ : uniforms++);
        variable->name = str_intern(shader->strings, text_cstr(&name), name.len);
    }
}

static void finish_vertex_stage(struct shader *shader)
{
    if (shader->role->stages != STAGES_NONE) {
        complete_vertex_stage(shader);
        mark_outputs(shader, STAGE_VERTEX);
        shader_schedule(shader, STAGE_VERTEX);
        add_globals(shader, STAGE_VERTEX);
    }
}

/*
 * A language without a vertex stage has a separate displacement shader, if the document displaces
 * the surface. Vertex data are expressions there.
 */
static void finish_displacement(struct shader *shader)
{
    struct effect_list *effects = &shader->stages[STAGE_VERTEX].effects;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < effects->len; i++)
        if (effects->items[i].kind == EFFECT_POSITION)
            effects->items[kept++] = effects->items[i];
    assert(kept <= effects->len);
    effects->len = kept;
    if (kept) {
        shader_schedule(shader, STAGE_VERTEX);
        add_globals(shader, STAGE_VERTEX);
    }
}

void shader_finish(struct shader *shader, const struct shader_layout_rules *rules)
{
    assert(shader->interface.used.len == 0);
    shader->interface.rules = *rules;
    shader_specialise_calls(shader, rules->typed_textures);
    shader_drop_idle(shader, STAGE_PIXEL);
    complete_loops(shader, STAGE_PIXEL);
    mark_outputs(shader, STAGE_PIXEL);
    shader_schedule(shader, STAGE_PIXEL);
    add_globals(shader, STAGE_PIXEL);
    find_host_functions(shader);
    if (rules->one_stage)
        finish_displacement(shader);
    else
        finish_vertex_stage(shader);
    ir_assert_valid(shader->graph, "after the last pass");
    shader_layout(shader);
    if (rules->neutral_names)
        name_neutrally(shader);
}
