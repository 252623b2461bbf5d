// SPDX-License-Identifier: Apache-2.0
/* Why an assignment won, lost, removes or sleeps, for one primitive. */
#include "bind/bind.h"

struct explanation {
    const struct bindings *b;
    const struct bind_state *state;
    prim_id prim;
    struct text *out;
};

static void put_path(const struct explanation *e, uint32_t level)
{
    size_t begin = e->out->len;
    scene_path(e->b->scene, bind_prim_at(e->b, e->prim, level), e->out);
    text_show(e->out, begin);
}

static void put_assign(const struct explanation *e, uint32_t assign)
{
    size_t begin = e->out->len;
    look_assign_name(&e->b->look, assign, e->out);
    text_show(e->out, begin);
}

/* Writes what the assignment assigns: "material Dust", "nodegraph NG", "nothing". */
static void put_target(const struct explanation *e, const struct look_assign *a)
{
    const struct document *doc = e->b->look.doc;
    if (!a->target)
        text_str(e->out, "nothing");
    else
        text_fmt(e->out, "%s %s", a->kind == ASSIGN_GRAPH ? "nodegraph" : "material",
                 doc_name(doc, a->target));
}

static void put_head(const struct explanation *e, uint32_t assign, uint32_t level)
{
    const struct bind_look *look = &e->b->look;
    const struct look_assign *a = &look->assigns.items[assign];
    struct diag_place place = look_assign_place(look, a);
    size_t begin = e->out->len;
    text_fmt(e->out, "  %s  ", look->names.items[a->name].text);
    put_target(e, a);
    text_str(e->out, ", ");
    put_assign(e, assign);
    text_fmt(e->out, " (%s:%u)", place.file ? place.file : "", (unsigned)place.line);
    if (level) {
        text_str(e->out, " at ");
        put_path(e, level);
    }
    text_show(e->out, begin);
    text_str(e->out, "\n      ");
}

static bool is_for_purpose(const struct bind_look *look, const struct look_assign *a)
{
    return a->binding && look->scene->bindings.items[a->binding - 1].is_purpose;
}

/* The reason why `weak` loses to `strong`, which stands before it in the order of strength. */
static void put_loss(const struct explanation *e, const struct stand *weak,
                     const struct stand *strong)
{
    const struct bind_look *look = &e->b->look;
    const struct look_assign *w = &look->assigns.items[weak->assign],
                             *s = &look->assigns.items[strong->assign];
    text_str(e->out, s->target ? "loses to " : "is removed by ");
    put_assign(e, strong->assign);
    if (strong->level > weak->level) {
        text_str(e->out, ", which stands deeper, at ");
        put_path(e, strong->level);
    } else if (is_for_purpose(look, s) && !is_for_purpose(look, w))
        text_fmt(e->out, ", which is for the purpose '%s'", e->b->scene->purpose);
    else if (w->collection && s->collection && look_contains(look, w->collection, s->collection))
        text_str(e->out, ", whose collection this one's includes");
    else if (w->binding && !s->binding)
        text_str(e->out, ", which a look has");
    else if (w->look != s->look)
        text_str(e->out, ", which a look has that inherits from this one");
    else if (s->binding && strong->level < weak->level)
        text_str(e->out, ", which is stronger than bindings of the scene below it");
    else if (s->members && !w->members)
        text_str(e->out, ", because at one prim a collection beats a direct binding");
    else if (s->members && w->members)
        text_str(e->out, ", because the first of several collections wins");
    else if (strong->assign > weak->assign)
        text_str(e->out, ", which stands later in the file");
    else
        text_str(e->out, ", because this one steps back behind a collection in its own");
}

/* The item of an assignment, if it has one; -1: none. */
static int find_item(const struct explanation *e, uint32_t assign)
{
    for (uint32_t i = 0; i < e->state->num_items; i++)
        if (e->b->items.items[e->state->first_item + i].assign == assign)
            return (int)i;
    return -1;
}

static void put_item(const struct explanation *e, uint32_t assign, int index)
{
    static const char *const effects[] = {
        [ITEM_LAYER] = "wins: a layer",
        [ITEM_OVERRIDE] = "wins: an override",
        [ITEM_VERTICAL] = "wins: a vertical layer",
        [ITEM_VOLUME] = "wins: the volume beside the stack",
        [ITEM_LIGHT] = "wins: the light beside the stack",
    };
    const struct bind_item *items = &e->b->items.items[e->state->first_item];
    if (items[index].kind != ITEM_PRODUCT) {
        text_str(e->out, effects[items[index].kind]);
        return;
    }
    text_str(e->out, "gives what stronger ones lack and share:");
    for (uint32_t i = (uint32_t)index; i < e->state->num_items; i++)
        if (items[i].kind == ITEM_PRODUCT && items[i].assign == assign)
            text_fmt(e->out, " %s", bind_product_names[items[i].product]);
}

/* Writes what the strongest assignment of a name does if it gives no item. */
static void put_idle(const struct explanation *e, const struct look_name *name,
                     const struct look_assign *a)
{
    struct slot_name owner = name->name;
    if (name->is_muted) {
        text_str(e->out, "is muted");
        return;
    }
    if (!a->target && !name->name.parts[SLOT_OVERRIDE].len
        && !name->name.parts[SLOT_VERTICAL].len) {
        text_str(e->out, "removes the slot");
        return;
    }
    if (!a->target) {
        text_str(e->out, "removes the name");
        return;
    }
    text_str(e->out, "sleeps: there is no layer in ");
    owner.parts[owner.parts[SLOT_OVERRIDE].len ? SLOT_OVERRIDE : SLOT_VERTICAL].len = 0;
    slot_write(&owner, e->out);
}

static void put_stand(const struct explanation *e, const struct stand *first, const struct stand *s)
{
    const struct bind_look *look = &e->b->look;
    const struct look_assign *a = &look->assigns.items[s->assign];
    int item = find_item(e, s->assign);
    put_head(e, s->assign, s->level);
    if (item >= 0)
        put_item(e, s->assign, item);
    else if (s == first)
        put_idle(e, &look->names.items[s->name], a);
    else
        put_loss(e, s, s - 1);
    text_char(e->out, '\n');
}

/* Assignments whose collection includes the primitive and excludes it again. */
static void put_excluded(const struct explanation *e)
{
    const struct bind_look *look = &e->b->look;
    for (uint32_t i = 0; i < look->assigns.len; i++) {
        uint32_t collection = look->assigns.items[i].collection;
        if (!collection || !bind_is_excluded(e->b, e->state, collection))
            continue;
        elem_id element = look->collections.items[collection - 1].element;
        put_head(e, i, 0);
        text_fmt(e->out, "does not stand here: the collection %s excludes the primitive\n",
                 doc_name(look->doc, element));
    }
}

void bind_explain(const struct bindings *b, prim_id prim, struct arena *scratch, struct text *out)
{
    struct explanation e = {b, bind_state_of(b, prim), prim, out};
    struct stands stands = {.scratch = scratch};
    const struct stand *first = NULL;
    scene_path(b->scene, prim, out);
    text_char(out, '\n');
    bind_stands(b, e.state, &stands);
    for (uint32_t i = 0; i < stands.len; i++) {
        if (!first || stands.items[i].name != first->name)
            first = &stands.items[i];
        put_stand(&e, first, &stands.items[i]);
    }
    put_excluded(&e);
    if (!stands.len)
        text_str(out, "  no assignment stands here: the default substance\n");
}
