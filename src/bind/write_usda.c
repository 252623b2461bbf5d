// SPDX-License-Identifier: Apache-2.0
/*
 * The bindings of a look as slot bindings of USD: a layer with all primitives, in which a primitive
 * says what its parent does not (docs/slots.md, "In USD").
 */
#include "bind/bind.h"
#include "usda/text.h"

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
    struct usda_text text;
    struct said_list own, above;
    VEC(uint32_t) materials; /* marks by assignment target, in order of appearance */
    struct table seen;
    uint32_t num_lost; /* items that slot bindings cannot hold */
};

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

static struct text_word target_name(const struct usda_writer *u, uint32_t target)
{
    const struct document *doc = u->w->b->look.doc;
    const char *name = str_text(doc->strings, doc_element(doc, target)->name);
    return (struct text_word){name, strlen(name)};
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
    struct usda_text *out = &u->text;
    bool is_plain = target && is_base(u, name);
    usda_put_indent(out, depth);
    usda_put(out, is_plain ? "rel material:binding" : "rel material:slotBinding:");
    if (!is_plain)
        slot_encode(&u->w->b->look.names.items[name].name, out->out);
    if (target) {
        usda_put(out, " = </Looks/");
        usda_put_name(out, target_name(u, target));
        usda_put(out, ">\n");
        note_material(u, target);
    } else {
        usda_put(out, " = None\n");
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
    usda_put_indent(&u->text, 1);
    usda_put(&u->text, "uniform token[] material:slotOrder = [");
    for (uint32_t i = 0; i < look->order_parts.len; i++) {
        usda_put(&u->text, i ? ", " : "");
        usda_put_string(&u->text, look->order_parts.items[i]);
    }
    usda_put(&u->text, "]\n");
}

/* The names of the materials, which a file with their networks may fill. */
static void put_materials(struct usda_writer *u)
{
    const struct document *doc = u->w->b->look.doc;
    if (!u->materials.len)
        return;
    usda_put(&u->text, "over \"Looks\"\n{\n");
    for (uint32_t i = 0; i < u->materials.len; i++) {
        bool is_graph = doc_element(doc, u->materials.items[i])->kind == KIND_NODEGRAPH;
        usda_put(&u->text, is_graph ? "    over NodeGraph \"" : "    over Material \"");
        usda_put_name(&u->text, target_name(u, u->materials.items[i]));
        usda_put(&u->text, "\"\n    {\n    }\n");
    }
    usda_put(&u->text, "}\n");
}

static void put_prim_name(struct usda_writer *u, prim_id prim)
{
    const struct scene_prim *at = &u->w->b->scene->prims.items[prim];
    usda_put(&u->text, "\"");
    usda_put_name(&u->text, (struct text_word){at->name, at->name_len});
    usda_put(&u->text, "\"\n");
}

/* Opens a primitive, and closes the bodies that end before `next`; 0: all. */
static void put_prim(struct usda_writer *u, prim_id prim, prim_id next)
{
    const struct scene *scene = u->w->b->scene;
    uint32_t depth = scene_depth(scene, prim), open = next ? scene_depth(scene, next) : 1;
    usda_put_indent(&u->text, depth - 1);
    usda_put(&u->text, "def ");
    put_prim_name(u, prim);
    usda_put_indent(&u->text, depth - 1);
    usda_put(&u->text, "{\n");
    if (prim == scene->prims.items[0].first_child)
        put_order(u);
    put_bindings(u, prim, depth);
    for (; depth >= open; depth--) {
        usda_put_indent(&u->text, depth - 1);
        usda_put(&u->text, "}\n");
    }
}

uint32_t bind_write_usda(struct bind_writer *w)
{
    const struct scene *scene = w->b->scene;
    struct usda_writer u = {.w = w, .text = {.out = w->out}};
    prim_id first = scene->prims.items[0].first_child;
    usda_put(&u.text, "#usda 1.0\n(\n");
    if (first) {
        usda_put(&u.text, "    defaultPrim = ");
        put_prim_name(&u, first);
    }
    usda_put(&u.text, ")\n");
    for (prim_id prim = scene_next(scene, 0), next; prim; prim = next) {
        next = scene_next(scene, prim);
        put_prim(&u, prim, next);
        if (w->flush)
            w->flush(w->user_data, w->out);
    }
    put_materials(&u);
    return u.num_lost + u.text.num_changed;
}
