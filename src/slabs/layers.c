// SPDX-License-Identifier: Apache-2.0
#include "slabs/slabs.h"

bool slabs_is_layer(const struct ir_graph *g, ir_ref ref)
{
    uint8_t op = ir_get(g, ref)->op;
    return op == IR_LAYER || op == IR_SLAB_LAYER;
}

ir_ref slabs_layer_thickness(struct ir_graph *g, ir_ref layer)
{
    return ir_get(g, layer)->op == IR_SLAB_LAYER ? ir_arg(g, layer, 2)
                                                 : ir_const_float(g, SLABS_LAYER_THICKNESS);
}

ir_ref slabs_sheet_thickness(const struct ir_graph *g, ir_ref surface)
{
    struct ir_value is_thin;
    bool is_sheet = ir_get(g, surface)->op == IR_SLAB_SURFACE
                    && ir_get_const(g, ir_arg(g, surface, 1), &is_thin) && is_thin.w[0].u;
    return is_sheet ? ir_arg(g, surface, 2) : 0;
}
