// SPDX-License-Identifier: Apache-2.0
/* The layers of a state, and the stacks of equal layers. */
#include "base/hash.h"
#include "bind/bind.h"

#include <assert.h>

static const struct look_assign *assign_of(const struct bindings *b, const struct stand *stand)
{
    return &b->look.assigns.items[stand->assign];
}

/* ---- From stands to items ---- */

static void add_item(struct bindings *b, enum item_kind kind, const struct stand *stand,
                     unsigned product)
{
    struct bind_item item = {stand->assign, stand->level, (uint8_t)kind, (uint8_t)product};
    vec_push(b->arena, &b->items, item);
}

/* The products that a layer lacks and a weaker assignment has. */
static uint8_t add_products(struct bindings *b, const struct stand *weaker, uint8_t had)
{
    uint8_t products = assign_of(b, weaker)->products & (uint8_t)~had;
    for (unsigned i = 0; i < NUM_PRODUCTS; i++)
        if (products >> i & 1)
            add_item(b, ITEM_PRODUCT, weaker, i);
    return had | products;
}

/*
 * The layer of one name: the strongest assignment, and products of the next weaker ones as long as
 * `exclusive` shares them and none removes. A volume or a light binds beside it: it follows the
 * layer. True if there is a layer.
 */
static bool add_layer(struct bindings *b, enum item_kind kind, const struct stand *stands,
                      uint32_t num)
{
    const struct stand *beside[NUM_PRODUCTS] = {NULL};
    bool has_layer = false;
    uint8_t had = 0;
    for (uint32_t i = 0; i < num; i++) {
        const struct look_assign *a = assign_of(b, &stands[i]);
        if (a->kind == ASSIGN_REMOVAL)
            break;
        if (a->kind != ASSIGN_LAYER) {
            if (!beside[a->kind - ASSIGN_VOLUME])
                beside[a->kind - ASSIGN_VOLUME] = &stands[i];
        } else if (has_layer) {
            had = add_products(b, &stands[i], had);
        } else {
            add_item(b, kind, &stands[i], 0);
            has_layer = true;
            had = a->products;
        }
        if (!a->is_shared)
            break;
    }
    for (unsigned i = 0; i < 2; i++)
        if (beside[i])
            add_item(b, i ? ITEM_LIGHT : ITEM_VOLUME, beside[i], 0);
    return has_layer;
}

/* The number of stands of the name that begins the list. */
static uint32_t num_of_name(const struct stand *stands, uint32_t num)
{
    uint32_t n = 1;
    while (n < num && stands[n].name == stands->name)
        n++;
    return n;
}

/* The slot and the layer that a walk through the names has met last, as 1 + their numbers. */
struct met {
    uint32_t slot, layer;
};

/* True if a name hangs on a slot or a layer that is not there. */
static bool is_asleep(const struct look_name *name, struct met met)
{
    if (name->name.parts[SLOT_OVERRIDE].len)
        return met.layer != name->layer + 1;
    return name->name.parts[SLOT_VERTICAL].len && met.slot != name->slot + 1;
}

/* Adds what one name says in a state: its stands, the strongest first. */
static void add_name(struct bindings *b, uint32_t state, const struct stand *stands, uint32_t num,
                     struct met *met, struct layer_notes *notes)
{
    const struct look_name *name = &b->look.names.items[stands->name];
    bool is_override = name->name.parts[SLOT_OVERRIDE].len,
         is_vertical = name->name.parts[SLOT_VERTICAL].len,
         has_target = assign_of(b, stands)->target;
    if (name->is_muted)
        return;
    if (is_asleep(name, *met)) {
        if (has_target)
            notes->sleeps_at[stands->name] = state + 1;
        return;
    }
    if (is_override) {
        if (has_target)
            add_item(b, ITEM_OVERRIDE, stands, 0);
        return;
    }
    if (!add_layer(b, is_vertical ? ITEM_VERTICAL : ITEM_LAYER, stands, num))
        return;
    notes->has_layer[name->layer] = true;
    met->layer = name->layer + 1;
    if (!is_vertical)
        met->slot = name->slot + 1;
}

/* ---- Stacks ---- */

static uint64_t hash_text(uint64_t hash, const char *text)
{
    return hash_stable(hash, text, strlen(text) + 1);
}

static uint64_t hash_item(const struct bindings *b, const struct bind_item *item, uint64_t hash)
{
    const struct bind_look *look = &b->look;
    const struct look_assign *a = &look->assigns.items[item->assign];
    const struct document *doc = look->doc;
    uint8_t kinds[3] = {item->kind, item->product, a->kind};
    hash = hash_stable(hash, kinds, sizeof kinds);
    hash = hash_text(hash, look->names.items[a->name].text);
    hash = hash_text(hash, doc_name(doc, a->target));
    for (uint32_t i = 0; i < a->variants.len; i++) {
        const struct look_variant *v = &a->variants.items[i];
        hash = hash_text(hash, doc_name(doc, v->set));
        hash = hash_text(hash, doc_name(doc, v->variant));
    }
    return hash;
}

static bool are_equal(const struct bind_look *look, const struct bind_item *x,
                      const struct bind_item *y)
{
    const struct look_assign *a = &look->assigns.items[x->assign],
                             *b = &look->assigns.items[y->assign];
    if (x->kind != y->kind || x->product != y->product || a->name != b->name
        || a->target != b->target || a->kind != b->kind || a->variants.len != b->variants.len)
        return false;
    for (uint32_t i = 0; i < a->variants.len; i++)
        if (a->variants.items[i].variant != b->variants.items[i].variant)
            return false;
    return true;
}

static bool has_items(const struct bindings *b, const struct bind_stack *stack,
                      const struct bind_state *state)
{
    const struct bind_state *other = &b->states.items[stack->state];
    bool same = other->num_items == state->num_items;
    for (uint32_t i = 0; same && i < state->num_items; i++)
        same = are_equal(&b->look, &b->items.items[other->first_item + i],
                         &b->items.items[state->first_item + i]);
    return same;
}

void bind_stack(struct bindings *b, uint32_t number, bool adds)
{
    struct bind_state *state = &b->states.items[number];
    uint64_t hash = HASH_STABLE_SEED;
    for (uint32_t i = 0; i < state->num_items; i++)
        hash = hash_item(b, &b->items.items[state->first_item + i], hash);
    uint32_t key = (uint32_t)(hash ^ hash >> 32);
    for (uint32_t at = key, found; (found = table_next(&b->stack_table, key, &at));)
        if (has_items(b, &b->stacks.items[found - 1], state)) {
            state->stack = found - 1;
            return;
        }
    if (!adds)
        return;
    state->stack = b->stacks.len;
    vec_push(b->arena, &b->stacks, (struct bind_stack){.state = number, .hash = hash});
    table_add(&b->stack_table, b->arena, key, b->stacks.len);
}

void bind_layers(struct bindings *b, uint32_t number, struct stands *stands,
                 struct layer_notes *notes)
{
    struct bind_state *state = &b->states.items[number];
    struct met met = {0};
    state->first_item = b->items.len;
    bind_stands(b, state, stands);
    for (uint32_t i = 0, num; i < stands->len; i += num) {
        num = num_of_name(&stands->items[i], stands->len - i);
        add_name(b, number, &stands->items[i], num, &met, notes);
    }
    state->num_items = b->items.len - state->first_item;
    state->stack = STACK_NONE;
}
