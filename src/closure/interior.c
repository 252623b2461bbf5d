// SPDX-License-Identifier: Apache-2.0
/*
 * The medium inside a surface, for path tracers (docs/library.md, "Volumes"):
 *
 *     out13 = vec4(scattering, phase anisotropy), out14 = vec4(extinction, 0)
 *
 * They are those where light goes in. A medium that positions alone decide has them everywhere:
 * out14 then has the semantic `varies`, and the tracer asks at each place.
 */
#include "closure/scatter.h"

const struct closure_leaf *interior_behind(const struct closure_scatter *s,
                                           const struct scattering *leaf)
{
    for (uint32_t p = 0; p < s->num_parts; p++)
        if (leaf->in[p] && leaf->in[p]->interior)
            return leaf->in[p];
    return NULL;
}

/* ---- What there is ---- */

static bool scatters(struct closure_scatter *s, ir_ref interior)
{
    struct closure_medium medium = {0};
    if (interior)
        closure_medium(s->shader, s->host, interior, &medium);
    return interior && !ir_const_is(s->graph, medium.scattering, 0.0f);
}

/* True if the graph has a volume inside a surface. */
static bool has_interior(const struct ir_graph *g)
{
    bool any = false;
    for (ir_ref ref = 1; ref < g->nodes.len && !any; ref++) {
        ir_ref base = ir_get(g, ref)->op == IR_LAYER ? ir_arg(g, ref, 1) : 0;
        any = base && ir_type_of(g, base) == IR_TYPE_VDF;
    }
    return any;
}

/* True if a medium inside the surface may scatter. Of a stack the layers are not known yet. */
static bool any_interior_scatters(struct closure_scatter *s)
{
    bool any = s->is_stack && has_interior(s->graph);
    for (uint32_t i = 0; s->pile && i < s->pile->levels.len; i++)
        any = any || scatters(s, s->pile->levels.items[i].interior);
    for (uint32_t i = 0; !s->pile && i < s->leaves.len; i++) {
        const struct scattering *leaf = &s->leaves.items[i];
        const struct closure_leaf *solid = interior_behind(s, leaf);
        any = any || (leaf->share && solid && scatters(s, solid->interior));
    }
    return any;
}

static bool varies_by_place(struct closure_scatter *s, ir_ref interior)
{
    struct closure_medium medium;
    closure_medium(s->shader, s->host, interior, &medium);
    const ir_ref values[3] = {medium.scattering, medium.extinction, medium.anisotropy};
    return closure_variation_of(s->shader, values, 3) == VARIES_BY_PLACE;
}

/* The one medium of all leaves, if it differs from place to place; 0: it does not. */
static ir_ref find_everywhere(struct closure_scatter *s)
{
    ir_ref interior = 0;
    for (uint32_t i = 0; i < s->leaves.len; i++) {
        const struct scattering *leaf = &s->leaves.items[i];
        const struct closure_leaf *solid = leaf->share ? interior_behind(s, leaf) : NULL;
        if (solid && interior && solid->interior != interior)
            return 0;
        interior = solid ? solid->interior : interior;
    }
    return interior && varies_by_place(s, interior) ? interior : 0;
}

void interior_declare(struct closure_scatter *s)
{
    s->everywhere = s->is_stack || s->pile ? 0 : find_everywhere(s);
    if (s->everywhere || !any_interior_scatters(s))
        return;
    ir_ref black = ir_const_splat(s->graph, IR_TYPE_VEC4, 0.0f);
    s->scattering = scatter_local(s, STR_scattering, black);
    s->extinction = scatter_local(s, STR_extinction, scatter_grey(s, 0.0f));
}

/* ---- Outputs ---- */

static ir_ref scattering_of(struct closure_scatter *s, const struct closure_medium *medium)
{
    const ir_ref parts[2] = {medium->scattering, medium->anisotropy};
    return ir_construct(s->graph, IR_TYPE_VEC4, parts, 2);
}

void interior_take(struct closure_scatter *s, ir_ref interior)
{
    struct closure_medium medium;
    if (!interior || s->scattering == UINT32_MAX)
        return;
    closure_medium(s->shader, s->host, interior, &medium);
    scatter_effect(s, EFFECT_ASSIGN, s->scattering, scattering_of(s, &medium));
    scatter_effect(s, EFFECT_ASSIGN, s->extinction, medium.extinction);
}

static void write(struct closure_scatter *s, ir_ref scattering, ir_ref extinction)
{
    uint32_t out = shader_output(s->shader, STR_out13, IR_TYPE_VEC4);
    scatter_effect(s, EFFECT_OUTPUT, out, scattering);
    scatter_write_output(s, STR_out14, extinction, scatter_number(s, 0.0f));
}

void interior_write(struct closure_scatter *s)
{
    struct closure_medium medium;
    const struct shader_variable varies = {
        .name = STR_out14, .block = BLOCK_OUTPUTS, .type = IR_TYPE_VEC4, .semantic = STR_varies};
    if (s->everywhere) {
        shader_add_variable(s->shader, &varies);
        closure_medium(s->shader, s->host, s->everywhere, &medium);
        write(s, scattering_of(s, &medium), medium.extinction);
    } else if (s->scattering != UINT32_MAX) {
        ir_ref scattering = scatter_read(s, s->scattering),
               extinction = scatter_read(s, s->extinction);
        write(s, scattering, extinction);
    }
}
