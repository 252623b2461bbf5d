// SPDX-License-Identifier: Apache-2.0
/*
 * The light at hand, inside the loop over lights: which of the bound light shaders it is decides direction and intensity. All are
 * expressions over the members of u_lightData[i]; what they share is computed once.
 *
 *     L = type == 1 ? L₁ : type == 2 ? L₂ : L₃,  the same for the intensity; a light of unknown type is dark
 */
#include "closure/closure_priv.h"

/* Light functions are seen through: there is one call of each. */
enum { MAX_LIGHT_NODES = 400 };

static ir_ref member(struct shader *shader, uint32_t variable)
{
    return ir_build(shader->graph, IR_CONTEXT, shader->variables.items[variable].type, variable, NULL, 0);
}

/* Direction and intensity as the function of one light shader gives them. */
static void sample(struct shader *shader, const struct lang_host *host, const struct shader_light *light, ir_ref point,
                   ir_ref *results)
{
    ir_ref *args = ARENA_ARRAY(shader->arena, ir_ref, light->num_members + 1);
    for (uint32_t i = 0; i < light->num_members; i++)
        args[i] = member(shader, shader->light_members.items[light->first_member + i]);
    args[light->num_members] = point;
    lang_lower_call(shader->unit, shader->graph, host, light->function, args, results);
}

/* "point_light" of mx_point_light. */
static const char *light_name(const struct shader *shader, const struct shader_light *light)
{
    const char *name = str_text(shader->strings, lang_function(shader->unit, light->function, NULL)->name);
    return strncmp(name, "mx_", 3) == 0 ? name + 3 : name;
}

static uint32_t named(struct shader *shader, str_id name)
{
    return ir_add_origin(shader->graph, name, 0, 0);
}

void closure_sample_light(struct shader *shader, const struct closure_host *host, ir_ref *direction, ir_ref *intensity)
{
    struct ir_graph *g = shader->graph;
    struct lang_host see_through = *host->lang;
    see_through.max_inline_nodes = MAX_LIGHT_NODES;
    uint32_t before = g->origin, direction_origin = named(shader, STR_L), intensity_origin = named(shader, STR_light);
    ir_ref point = closure_position(shader, host);
    ir_ref type = member(shader, shader_light_member(shader, STR_type, IR_TYPE_INT));
    *direction = 0;
    *intensity = ir_const_splat(g, IR_TYPE_VEC3, 0.0f);
    for (uint32_t i = shader->lights.len; i-- > 0;) {
        const struct shader_light *light = &shader->lights.items[i];
        ir_ref results[2];
        g->origin = named(shader, str_intern_z(shader->strings, light_name(shader, light)));
        sample(shader, &see_through, light, point, results);
        ir_ref is_this = ir_op2(g, IR_EQ, type, ir_const_int(g, light->type));
        g->origin = direction_origin;
        *direction = *direction && *direction != results[0] ? ir_op3(g, IR_SELECT, is_this, results[0], *direction) : results[0];
        g->origin = intensity_origin;
        *intensity = ir_op3(g, IR_SELECT, is_this, results[1], *intensity);
    }
    g->origin = before;
}
