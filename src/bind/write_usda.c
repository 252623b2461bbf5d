// SPDX-License-Identifier: Apache-2.0
/*
 * The bindings of a look as slot bindings of USD: a layer with all primitives, in which a primitive
 * says what its parent does not (docs/slots.md, "In USD").
 */
#include "bind/bind.h"

#include <assert.h>

/* The values that a primitive has of one name. */
struct said {
    uint32_t name, target;
};

struct said_list {
    struct said *items;
    uint32_t len, cap;
};

struct usda_writer {
    struct bind_writer *w;
    struct said_list own, above;
    VEC(uint32_t) materials; /* marks by assignment target, in order of appearance */
    struct table seen;
    uint32_t num_lost; /* items that slot bindings cannot hold */
};

static void indent(struct text *out, uint32_t depth)
{
    text_fmt(out, "%*s", (int)(4 * depth), "");
}

/* The layers, overrides and vertical layers of a state, by name. */
static void collect(struct usda_writer *u, const struct bind_state *state, struct said_list *out)
{
    const struct bindings *b = u->w->b;
    out->len = 0;
    for (uint32_t i = 0; i < state->num_items; i++) {
        const struct bind_item *item = &b->items.items[state->first_item + i];
        const struct look_assign *assign = &b->look.assigns.items[item->assign];
        bool is_second = false;
        for (uint32_t k = 0; k < out->len; k++)
            is_second |= out->items[k].name == assign->name;
        u->num_lost += item->kind == ITEM_PRODUCT || is_second || assign->num_variants != 0;
        if (item->kind != ITEM_PRODUCT && !is_second)
            vec_push(u->w->scratch, out, (struct said){assign->name, assign->target});
    }
}

static const struct said *find_said(const struct said_list *list, uint32_t name)
{
    for (uint32_t i = 0; i < list->len; i++)
        if (list->items[i].name == name)
            return &list->items[i];
    return NULL;
}

static const char *target_name(const struct usda_writer *u, uint32_t target)
{
    const struct document *doc = u->w->b->look.doc;
    return str_text(doc->strings, doc_element(doc, target)->name);
}

static void note_material(struct usda_writer *u, uint32_t target)
{
    for (uint32_t at = target, found; (found = table_next(&u->seen, target, &at));)
        if (u->materials.items[found - 1] == target)
            return;
    vec_push(u->w->scratch, &u->materials, target);
    table_add(&u->seen, u->w->scratch, target, u->materials.len);
}

/* Slot 000, which a tool without slots knows as the plain binding. */
static bool is_base(const struct usda_writer *u, uint32_t name)
{
    return strcmp(u->w->b->look.names.items[name].text, "000") == 0;
}

/*
 * `material:slotBinding:_050 = </Looks/Dust>`, or of slot 000 `material:binding`; target 0: None.
 */
static void put_binding(struct usda_writer *u, uint32_t depth, uint32_t name, uint32_t target)
{
    struct text *out = u->w->out;
    bool is_plain = target && is_base(u, name);
    indent(out, depth);
    text_str(out, is_plain ? "rel material:binding" : "rel material:slotBinding:");
    if (!is_plain)
        slot_encode(&u->w->b->look.names.items[name].name, out);
    if (target) {
        text_fmt(out, " = </Looks/%s>\n", target_name(u, target));
        note_material(u, target);
    } else {
        text_str(out, " = None\n");
    }
}

/* The bindings of slot 000, or all others, that differ from those above. */
static void put_changes(struct usda_writer *u, uint32_t depth, bool of_base)
{
    for (uint32_t i = 0; i < u->own.len; i++) {
        const struct said *said = &u->own.items[i], *inherited = find_said(&u->above, said->name);
        if (is_base(u, said->name) == of_base && (!inherited || inherited->target != said->target))
            put_binding(u, depth, said->name, said->target);
    }
}

static void put_bindings(struct usda_writer *u, prim_id prim, uint32_t depth)
{
    const struct bindings *b = u->w->b;
    prim_id parent = b->scene->prims.items[prim].parent;
    const struct bind_state *own = bind_state_of(b, prim),
                            *above = parent ? bind_state_of(b, parent) : NULL;
    if (own == above)
        return;
    u->above.len = 0;
    if (above)
        collect(u, above, &u->above);
    collect(u, own, &u->own);
    put_changes(u, depth, false);
    for (uint32_t i = 0; i < u->above.len; i++)
        if (!find_said(&u->own, u->above.items[i].name))
            put_binding(u, depth, u->above.items[i].name, 0);
    /* tools without slots let the last one win */
    put_changes(u, depth, true);
}

/* The slotorder of the look, or of the scene itself. */
static void put_order(struct usda_writer *u)
{
    const struct bind_look *look = &u->w->b->look;
    if (!look->order_parts.len)
        return;
    indent(u->w->out, 1);
    text_str(u->w->out, "uniform token[] material:slotOrder = [");
    for (uint32_t i = 0; i < look->order_parts.len; i++) {
        text_str(u->w->out, i ? ", \"" : "\"");
        text_put(u->w->out, look->order_parts.items[i]);
        text_char(u->w->out, '"');
    }
    text_str(u->w->out, "]\n");
}

/* The names of the materials, which a file with their networks may fill. */
static void put_materials(struct usda_writer *u)
{
    const struct document *doc = u->w->b->look.doc;
    if (!u->materials.len)
        return;
    text_str(u->w->out, "over \"Looks\"\n{\n");
    for (uint32_t i = 0; i < u->materials.len; i++) {
        bool is_graph = doc_element(doc, u->materials.items[i])->kind == KIND_NODEGRAPH;
        text_fmt(u->w->out, "    over %s \"%s\"\n    {\n    }\n",
                 is_graph ? "NodeGraph" : "Material", target_name(u, u->materials.items[i]));
    }
    text_str(u->w->out, "}\n");
}

uint32_t bind_write_usda(struct bind_writer *w)
{
    const struct scene *scene = w->b->scene;
    const struct scene_prim *prims = scene->prims.items;
    struct usda_writer u = {.w = w};
    prim_id first = prims[0].first_child;
    text_str(w->out, "#usda 1.0\n(\n");
    if (first)
        text_fmt(w->out, "    defaultPrim = \"%.*s\"\n", (int)prims[first].name_len,
                 prims[first].name);
    text_str(w->out, ")\n");
    for (prim_id prim = scene_next(scene, 0), next; prim; prim = next) {
        uint32_t depth = scene_depth(scene, prim);
        indent(w->out, depth - 1);
        text_fmt(w->out, "def \"%.*s\"\n", (int)prims[prim].name_len, prims[prim].name);
        indent(w->out, depth - 1);
        text_str(w->out, "{\n");
        if (prim == first)
            put_order(&u);
        put_bindings(&u, prim, depth);
        next = scene_next(scene, prim);
        uint32_t open = next ? scene_depth(scene, next) : 1;
        for (; depth >= open; depth--) { /* the bodies that end here */
            indent(w->out, depth - 1);
            text_str(w->out, "}\n");
        }
        if (w->flush)
            w->flush(w->user_data, w->out);
    }
    put_materials(&u);
    return u.num_lost;
}
