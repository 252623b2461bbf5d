// SPDX-License-Identifier: Apache-2.0
/*
 * <ambientocclusion>: how open the surface is, from 0 to 1. A path tracer traces it for each node
 * of other numbers, as a stream; rasters have it from a map of the host or from a primvar.
 */
#include "dynamic/dynamic.h"
#include "closure/closure.h"

#include <stdio.h>

static ir_ref stream_of(struct builder *b, const char *name)
{
    return shader_stream(b->shader, str_intern_z(b->shader->strings, name), IR_TYPE_FLOAT);
}

/* A geometry without the primvar is open. */
static void open_by_default(struct builder *b, uint32_t index)
{
    struct shader_variable *variable = &b->shader->interface.variables.items[index];
    variable->has_default = true;
    variable->value = ir_value_float(1.0f);
    if (!variable->slot)
        variable->slot = b->slot;
}

static ir_ref primvar(struct builder *b)
{
    ir_ref stream = stream_of(b, "geomprop_ambientocclusion");
    uint32_t index = ir_get(b->graph, stream)->attr, attribute;
    open_by_default(b, index);
    if (shader_attribute(b->shader, index, &attribute))
        open_by_default(b, attribute);
    return stream;
}

static bool has_semantic(const struct builder *b, ir_ref stream, const char *semantic)
{
    const struct shader_variable *v =
        &b->shader->interface.variables.items[ir_get(b->graph, stream)->attr];
    return strcmp(build_text(b, v->semantic), semantic) == 0;
}

/*
 * A stream for these numbers, which its semantic has: "occlusion:90,1e+38". Nodes of equal numbers
 * share one.
 */
static ir_ref traced(struct builder *b, float angle, float distance)
{
    char semantic[64], name[32];
    snprintf(semantic, sizeof semantic, "occlusion:%.9g,%.9g", (double)angle, (double)distance);
    for (unsigned number = 0;; number++) {
        snprintf(name, sizeof name, "occlusion_%u", number);
        bool is_new = number >= b->num_occlusions;
        ir_ref stream = stream_of(b, name);
        uint32_t index = ir_get(b->graph, stream)->attr;
        if (is_new) {
            b->num_occlusions = number + 1;
            b->shader->interface.variables.items[index].semantic =
                str_intern_z(b->shader->strings, semantic);
        }
        if (has_semantic(b, stream, semantic))
            return stream;
    }
}

static ir_ref as_asked(struct builder *b)
{
    switch (b->options->occlusion) {
    case OCCLUSION_MAP: return closure_occlusion(b->shader, b->options->texture_origin == 1);
    case OCCLUSION_PRIMVAR: return primvar(b);
    case OCCLUSION_NONE: break;
    }
    return ir_const_float(b->graph, 1.0f);
}

bool dynamic_occlusion(void *user_data, mxg_build *build, mxg_ref *results)
{
    struct builder *b = build->b;
    mxg_value angle = MXG_INIT(mxg_value), distance = MXG_INIT(mxg_value);
    ir_ref open = 0;
    (void)user_data;
    if (!mxg_build_require_constant(build, "coneangle", &angle)
        || !mxg_build_require_constant(build, "maxdistance", &distance))
        return false;
    switch (b->shader->role->occlusion) {
    case OCCLUSION_OF_OPTION: open = as_asked(b); break;
    case OCCLUSION_OF_PRIMVAR: open = primvar(b); break;
    case OCCLUSION_TRACED: open = traced(b, angle.values[0], distance.values[0]); break;
    }
    results[0] = code_issue(build, open);
    return true;
}
