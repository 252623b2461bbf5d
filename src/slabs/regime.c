// SPDX-License-Identifier: Apache-2.0
#include "slabs/regime.h"

enum { MAX_NODES = 256 };

struct search {
    ir_ref seen[MAX_NODES];
    unsigned num;
};

static void add(struct search *s, ir_ref ref)
{
    for (unsigned i = 0; i < s->num; i++)
        if (s->seen[i] == ref)
            return;
    if (ref && s->num < MAX_NODES)
        s->seen[s->num++] = ref;
}

/* True if a value is not the same all over a surface; also if it is long, because then it never is.
 */
static bool varies(const struct ir_graph *g, ir_ref value)
{
    struct search s = {.seen = {value}, .num = 1};
    for (unsigned i = 0; i < s.num; i++) {
        const struct ir_node *node = ir_get(g, s.seen[i]);
        bool is_even = node->op == IR_CONST || node->op == IR_UNIFORM;
        if (!is_even && node->num_args == 0)
            return true;
        for (uint32_t k = 0; k < node->num_args; k++)
            add(&s, ir_arg(g, s.seen[i], k));
    }
    return s.num == MAX_NODES;
}

uint32_t slab_regime(const struct ir_graph *g, const ir_ref *in)
{
    ir_ref albedo = in[SLAB_diffuse_albedo];
    bool is_opaque = ir_const_is(g, in[SLAB_mean_free_path], 0.0f);
    bool is_lit = ir_is_const(g, albedo) ? !ir_const_is(g, albedo, 0.0f) : varies(g, albedo);
    return is_opaque || is_lit ? SLAB_NEVER_CLEAR : 0;
}

ir_ref slab_regime_albedo(struct ir_graph *g, uint32_t attr, ir_ref path, ir_ref albedo)
{
    bool is_opaque = ir_const_is(g, path, 0.0f);
    bool may_be_black = !is_opaque && (attr & SLAB_NEVER_CLEAR) && !ir_is_const(g, albedo);
    return may_be_black ? ir_op2(g, IR_MAX, albedo, ir_const_float(g, SLAB_BLACK)) : albedo;
}
