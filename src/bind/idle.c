// SPDX-License-Identifier: Apache-2.0
/* What a state has no item for: names that are removed, and names that sleep. */
#include "bind/bind.h"

static bool has_item(const struct bindings *b, const struct bind_state *state, uint32_t assign)
{
    for (uint32_t i = 0; i < state->num_items; i++)
        if (b->items.items[state->first_item + i].assign == assign)
            return true;
    return false;
}

void bind_find_idle(const struct bindings *b, const struct bind_state *state, struct stands *stands,
                    struct idle_list *out)
{
    out->len = 0;
    bind_stands(b, state, stands);
    for (uint32_t i = 0, next; i < stands->len; i = next) {
        const struct stand *first = &stands->items[i];
        for (next = i + 1; next < stands->len && stands->items[next].name == first->name; next++)
            continue;
        bool is_removed = !b->look.assigns.items[first->assign].target;
        /* a removal of nothing is none */
        if (!b->look.names.items[first->name].is_muted && !has_item(b, state, first->assign)
            && (!is_removed || next > i + 1))
            vec_push(stands->scratch, out,
                     (struct bind_idle){{first->assign, first->level, 0, 0}, is_removed});
    }
}
