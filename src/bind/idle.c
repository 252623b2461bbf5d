// SPDX-License-Identifier: Apache-2.0
/* Names of a state without an item: those that are removed, and those that sleep. */
#include "bind/bind.h"

/* Marks the assignments that have items, because a state may have thousands. */
static void mark_items(const struct bindings *b, const struct bind_state *state,
                       struct arena *scratch, struct idle_list *list)
{
    if (!list->marks)
        list->marks = ARENA_ARRAY(scratch, uint32_t, b->look.assigns.len);
    list->epoch++;
    for (uint32_t i = 0; i < state->num_items; i++)
        list->marks[b->items.items[state->first_item + i].assign] = list->epoch;
}

void bind_find_idle(const struct bindings *b, const struct bind_state *state, struct stands *stands,
                    struct idle_list *out)
{
    out->len = 0;
    bind_stands(b, state, stands);
    mark_items(b, state, stands->scratch, out);
    for (uint32_t i = 0, next; i < stands->len; i = next) {
        const struct stand *first = &stands->items[i];
        for (next = i + 1; next < stands->len && stands->items[next].name == first->name; next++)
            continue;
        bool is_removed = !b->look.assigns.items[first->assign].target;
        /* a removal of nothing is none */
        if (!b->look.names.items[first->name].is_muted && out->marks[first->assign] != out->epoch
            && (!is_removed || next > i + 1))
            vec_push(stands->scratch, out,
                     (struct bind_idle){{first->assign, first->level, 0, 0}, is_removed});
    }
}
