// SPDX-License-Identifier: Apache-2.0
/*
 * Displacement: both stages evaluate D over the surface before the displacement.
 *
 *     vertex stage    position = u_viewProjectionMatrix · (P + D)
 *     pixel stage     the shaded point is P + D, and its normal is N':
 *
 *         N' = N + g(P + D) - g(P),    g(X) = normalize(dX/dx × dX/dy) on the side of N
 *
 * (A path tracer moves its mesh first and computes N' itself.)
 *
 * The facet normals g cancel in the difference, so the surface stays smooth. A material reads the
 * geometry of the surface before the displacement, except the normal: every read gives N', also in
 * functions.
 */
#include "closure/closure_priv.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"

#include <assert.h>

static ir_ref stream(struct shader *shader, str_id name)
{
    return shader_stream(shader, name, IR_TYPE_VEC3);
}

/*
 * The offset: a height along the normal, or (x, y, z) along tangent, bitangent and normal. 0: no
 * displacement.
 */
static ir_ref offset_of_shader(struct shader *shader, ir_ref displacement, ir_ref scale)
{
    struct ir_graph *g = shader->graph;
    if (ir_const_is(g, displacement, 0.0f) || ir_const_is(g, scale, 0.0f))
        return 0;
    ir_ref amount = ir_mul(g, displacement, scale), normal = stream(shader, STR_normalWorld);
    if (ir_type_of(g, amount) == IR_TYPE_FLOAT)
        return FORMULA(shader, "mx_displacement", amount, normal);
    return FORMULA(shader, "mx_displacement", amount, normal, stream(shader, STR_tangentWorld));
}

static ir_ref mixed(struct ir_graph *g, ir_ref bg, ir_ref fg, ir_ref mix)
{
    ir_ref nothing = ir_black(g);
    return bg || fg ? ir_mix(g, bg ? bg : nothing, fg ? fg : nothing, mix) : 0;
}

/* Operands precede their node, so one pass finds nested mixes. */
ir_ref closure_offset(struct shader *shader, ir_ref root)
{
    struct ir_graph *g = shader->graph;
    assert(ir_type_of(g, root) == IR_TYPE_DISPLACEMENT);
    ir_ref *known = ARENA_ARRAY(shader->arena, ir_ref, root + 1);
    uint8_t *needed = ir_mark(g, &root, 1, shader->arena);
    for (ir_ref ref = 1; ref <= root; ref++) {
        const struct ir_node node = *ir_get(g, ref);
        if (!needed[ref] || node.type != IR_TYPE_DISPLACEMENT)
            continue;
        ir_push_origin(g, node.origin);
        if (node.op == IR_DISPLACEMENT_SHADER)
            known[ref] = offset_of_shader(shader, ir_arg(g, ref, 0), ir_arg(g, ref, 1));
        else if (node.op == IR_UNIFORM) /* the offset, an output of another OSL layer */
            known[ref] = ir_build(g, IR_UNIFORM, IR_TYPE_VEC3, node.attr, NULL, 0);
        else if (node.op == IR_SHADER_MIX)
            known[ref] =
                mixed(g, known[ir_arg(g, ref, 0)], known[ir_arg(g, ref, 1)], ir_arg(g, ref, 2));
        else if (node.op == IR_CLOSURE_ADD)
            known[ref] = ir_sum(g, known[ir_arg(g, ref, 0)], known[ir_arg(g, ref, 1)]);
        else if (node.op == IR_CLOSURE_SCALE && known[ir_arg(g, ref, 0)])
            known[ref] = ir_mul(g, known[ir_arg(g, ref, 0)], ir_arg(g, ref, 1));
        ir_pop_origin(g);
    }
    assert(!known[root] || ir_type_of(g, known[root]) == IR_TYPE_VEC3);
    return known[root];
}

static ir_ref bent_normal(struct shader *shader, ir_ref before, ir_ref after)
{
    ir_push_name(shader->graph, STR_facet);
    ir_ref normal =
        FORMULA(shader, "mx_displaced_normal", before, after, stream(shader, STR_normalWorld));
    ir_pop_origin(shader->graph);
    return normal;
}

static void move_vertices(struct shader *shader, ir_ref point)
{
    struct ir_graph *g = shader->graph;
    assert(ir_type_of(g, point) == IR_TYPE_VEC3);
    ir_ref parts[2] = {point, ir_const_float(g, 1.0f)};
    ir_ref matrix = shader_read(
        shader, shader_private_uniform(shader, STR_u_viewProjectionMatrix, IR_TYPE_MAT4, 0));
    ir_ref args[2] = {matrix, ir_construct(g, IR_TYPE_VEC4, parts, 2)};
    shader_effect(shader, STAGE_VERTEX,
                  (struct effect){.kind = EFFECT_POSITION,
                                  .value = ir_build(g, IR_MUL, IR_TYPE_VEC4, 0, args, 2)});
}

/*
 * A path tracer calls this output for each vertex before it moves the mesh, and then computes the
 * normals.
 */
static void output_offset(struct shader *shader, ir_ref offset)
{
    struct ir_graph *g = shader->graph;
    ir_ref parts[2] = {offset, ir_const_float(g, 0.0f)};
    uint32_t out = shader_output(shader, STR_out8, IR_TYPE_VEC4);
    shader_effect(shader, STAGE_PIXEL,
                  (struct effect){.kind = EFFECT_OUTPUT,
                                  .index = out,
                                  .value = ir_construct(g, IR_TYPE_VEC4, parts, 2)});
}

static ir_ref view_from(struct shader *shader, ir_ref point)
{
    struct ir_graph *g = shader->graph;
    ir_ref viewer =
        shader_read(shader, shader_private_uniform(shader, STR_u_viewPosition, IR_TYPE_VEC3, 0));
    return ir_op1(g, IR_NORMALIZE, ir_sub(g, viewer, point));
}

/* The surface with the normal after displacement; moved 0: that of the stream. */
static ir_ref shaded(struct shader *shader, ir_ref surface, ir_ref moved)
{
    struct ir_graph *g = shader->graph;
    if (surface && ir_get(g, surface)->op == IR_SLOTS)
        return closure_shade_slots(shader, surface, moved);
    if (!surface || !moved)
        return surface;
    return ir_replace(g, surface, stream(shader, STR_normalWorld), moved, shader->arena);
}

/* Matter has the normals of layers already, over that of the stream. */
static ir_ref shaded_matter(struct shader *shader, ir_ref matter, ir_ref moved)
{
    struct ir_graph *g = shader->graph;
    const struct ir_node node = *ir_get(g, matter);
    ir_ref *args = ARENA_ARRAY(shader->arena, ir_ref, node.num_args);
    for (uint32_t i = 0; i < node.num_args; i++)
        args[i] = shaded(shader, ir_arg(g, matter, i), moved);
    return ir_build(g, IR_MATTER, node.type, 0, args, node.num_args);
}

static ir_ref shaded_root(struct shader *shader, ir_ref root, ir_ref moved)
{
    bool is_matter = root && ir_get(shader->graph, root)->op == IR_MATTER;
    return is_matter ? shaded_matter(shader, root, moved) : shaded(shader, root, moved);
}

ir_ref closure_displace(struct shader *shader, const struct closure_host *host, ir_ref surface,
                        ir_ref displacement)
{
    struct ir_graph *g = shader->graph;
    ir_ref offset = displacement ? closure_offset(shader, displacement) : 0;
    if (!offset)
        return shaded_root(shader, surface, 0);
    shader->reflection.displaced = true;
    if (shader->role->derivatives == DERIVATIVES_NONE) /* the host gives the moved surface */
        return shaded_root(shader, surface, 0);
    struct closure_point *point = host->point;
    ir_ref before = stream(shader, STR_positionWorld);
    ir_push_name(g, STR_P);
    point->position = ir_add(g, before, offset);
    ir_change_name(g, STR_N);
    bool has_rays = shader->role->derivatives == DERIVATIVES_OF_RAYS;
    point->normal = has_rays ? ir_op1(g, IR_NORMALIZE, stream(shader, STR_normalMoved))
                             : bent_normal(shader, before, point->position);
    ir_change_name(g, STR_V);
    if (!has_rays)
        point->view = view_from(shader, point->position);
    ir_pop_origin(g);
    if (shader->role->returns == RETURNS_PATH)
        output_offset(shader, offset);
    else
        move_vertices(shader, point->position);
    return shaded_root(shader, surface, point->normal);
}
