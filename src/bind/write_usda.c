// SPDX-License-Identifier: Apache-2.0
/*
 * The bindings of a look as slot bindings of USD: a layer of overs, to be sublayered on the stage
 * (docs/slots.md, "In USD"). A primitive says what its parent does not. Where the stage itself
 * binds at a primitive, the layer says the same names again, because its opinion has to be the
 * stronger one.
 */
#include "bind/bind.h"
#include "usda/write_text.h"

#include <assert.h>

/* The values that a primitive has of one name. */
struct said {
    uint32_t name, target; /* target 0: None */
    uint32_t first, last;  /* of a change: 1 + a binding of the stage that it replaces; 0: none */
};

struct said_list {
    struct said *items;
    uint32_t len, cap;
    uint32_t *at; /* by name: its index, if there is one */
};

enum { SAYS = 1, SAYS_BELOW = 2 }; /* what a primitive has in the layer */

struct usda_writer {
    struct bind_writer *w;
    struct usda_text text;
    struct said_list own, above, changes; /* of the primitive at hand */
    VEC(uint32_t) materials;              /* targets that the stage lacks, in order of appearance */
    struct table seen;
    uint32_t *name_of;         /* by binding of the scene: 1 + its name; 0: it is no assignment */
    VEC(uint32_t) scene_names; /* those names */
    uint32_t *next_of;         /* by binding: the next one of its change, as `first` */
    uint8_t *says;             /* by primitive: bits of SAYS */
    prim_id first;             /* the default prim; 0: none */
    struct text looks;         /* the name of the scope of `materials` */
    uint32_t num_lost;         /* items that slot bindings cannot hold */
};

static const struct look_assign *assign_of(const struct bindings *b, const struct bind_item *item)
{
    return &b->look.assigns.items[item->assign];
}

/* Why slot bindings cannot hold an item of a state; NULL: they hold it. */
static const char *loss_of(const struct usda_writer *u, const struct bind_state *state,
                           uint32_t index)
{
    const struct bindings *b = u->w->b;
    const struct bind_item *items = &b->items.items[state->first_item];
    if (items[index].kind == ITEM_PRODUCT)
        return "a product of a weaker assignment";
    /* items are sorted by name */
    for (uint32_t i = index;
         i-- > 0 && assign_of(b, &items[i])->name == assign_of(b, &items[index])->name;)
        if (items[i].kind != ITEM_PRODUCT)
            return "it stands beside a layer of its name";
    return assign_of(b, &items[index])->variants.len ? "its variants" : NULL;
}

static const struct said *find_said(const struct said_list *list, uint32_t name)
{
    uint32_t at = list->at[name];
    return at < list->len && list->items[at].name == name ? &list->items[at] : NULL;
}

static void add_said(struct usda_writer *u, struct said_list *list, uint32_t name, uint32_t target)
{
    list->at[name] = list->len;
    vec_push(u->w->scratch, list, (struct said){name, target, 0, 0});
}

/* The layers, overrides and vertical layers of a state, by name. */
static void collect(struct usda_writer *u, const struct bind_state *state, struct said_list *out)
{
    const struct bindings *b = u->w->b;
    out->len = 0;
    for (uint32_t i = 0; i < state->num_items; i++) {
        const struct bind_item *item = &b->items.items[state->first_item + i];
        const struct look_assign *assign = assign_of(b, item);
        u->num_lost += loss_of(u, state, i) != NULL;
        if (item->kind != ITEM_PRODUCT && !find_said(out, assign->name))
            add_said(u, out, assign->name, assign->target);
    }
}

/* ---- What a primitive says ---- */

/*
 * The bindings of the stage that the layer replaces: all, or with a purpose those for it, which
 * beat the others.
 */
static bool is_replaced(const struct usda_writer *u, const struct scene_binding *binding)
{
    return !binding->is_removed && (!*u->w->b->scene->purpose || binding->is_purpose);
}

/* Adds a name with what the primitive has of it. */
static void add_change(struct usda_writer *u, uint32_t name)
{
    const struct said *own = find_said(&u->own, name);
    if (!find_said(&u->changes, name))
        add_said(u, &u->changes, name, own ? own->target : 0);
}

/* Adds the name of a binding that is replaced. */
static void add_replaced(struct usda_writer *u, uint32_t binding)
{
    uint32_t name = u->name_of[binding - 1] - 1;
    add_change(u, name);
    struct said *change = &u->changes.items[u->changes.at[name]];
    if (change->last)
        u->next_of[change->last - 1] = binding;
    else
        change->first = binding;
    change->last = binding;
    u->next_of[binding - 1] = 0;
}

/* Adds the names of the stage's own bindings here. True if one of them stands in a collection. */
static bool add_bound(struct usda_writer *u, prim_id prim)
{
    const struct scene *scene = u->w->b->scene;
    bool has_collection = false;
    for (uint32_t at = scene_first_binding(scene, prim); at;) {
        const struct scene_binding *binding = &scene->bindings.items[at - 1];
        if (is_replaced(u, binding) && binding->is_collection)
            has_collection = true;
        else if (is_replaced(u, binding) && u->name_of[at - 1])
            add_replaced(u, at);
        at = binding->next;
    }
    return has_collection;
}

/* Finds what a primitive says; false: nothing. */
static bool find_changes(struct usda_writer *u, prim_id prim)
{
    const struct bindings *b = u->w->b;
    prim_id parent = b->scene->prims.items[prim].parent;
    const struct bind_state *own = bind_state_of(b, prim),
                            *above = parent ? bind_state_of(b, parent) : NULL;
    u->own.len = u->above.len = u->changes.len = 0;
    if (own == above && !scene_first_binding(b->scene, prim))
        return false;
    if (above)
        collect(u, above, &u->above);
    collect(u, own, &u->own);
    for (uint32_t i = 0; i < u->own.len; i++) {
        const struct said *said = &u->own.items[i], *inherited = find_said(&u->above, said->name);
        if (!inherited || inherited->target != said->target)
            add_change(u, said->name);
    }
    for (uint32_t i = 0; i < u->above.len; i++)
        if (!find_said(&u->own, u->above.items[i].name))
            add_change(u, u->above.items[i].name);
    /* a binding for a purpose beats all others, so roots have one of each name */
    for (uint32_t i = 0; i < u->scene_names.len && !parent && *b->scene->purpose; i++)
        add_change(u, u->scene_names.items[i]);
    return add_bound(u, prim) || u->changes.len;
}

/* ---- Materials ---- */

static struct text_word target_name(const struct usda_writer *u, uint32_t target)
{
    const struct document *doc = u->w->b->look.doc;
    const char *name = doc_name(doc, target);
    return (struct text_word){name, strlen(name)};
}

static const struct scene_material *material_of_stage(const struct usda_writer *u, uint32_t target)
{
    return scene_material_named(u->w->b->scene, target_name(u, target).bytes);
}

static void note_material(struct usda_writer *u, uint32_t target)
{
    if (!target || material_of_stage(u, target))
        return;
    for (uint32_t at = target, found; (found = table_next(&u->seen, target, &at));)
        if (u->materials.items[found - 1] == target)
            return;
    vec_push(u->w->scratch, &u->materials, target);
    table_add(&u->seen, u->w->scratch, target, u->materials.len);
}

static void put_name_of(struct usda_writer *u, prim_id prim)
{
    const struct scene_prim *at = &u->w->b->scene->prims.items[prim];
    usda_put_name(&u->text, (struct text_word){at->name, at->name_len});
}

static void put_target(struct usda_writer *u, uint32_t target)
{
    const struct scene_material *material = material_of_stage(u, target);
    usda_put(&u->text, "</");
    if (material) {
        usda_join(&u->w->b->scene->layer, material->prim, '/', u->text.out);
    } else {
        put_name_of(u, u->first);
        usda_put(&u->text, "/");
        text_put(u->text.out, (struct text_word){u->looks.data, u->looks.len});
        usda_put(&u->text, "/");
        usda_put_name(&u->text, target_name(u, target));
    }
    usda_put(&u->text, ">");
}

/* The prim below the default prim that has the materials, as the stage has it; 0: it has none. */
static usda_prim_id find_looks(struct usda_writer *u)
{
    struct text path;
    text_init(&path, u->w->scratch);
    scene_path(u->w->b->scene, u->first, &path);
    text_fmt(&path, "/%s", text_cstr(&u->looks));
    return usda_find(&u->w->b->scene->layer, path.data, path.len);
}

/* Names the scope "Looks", unless the layer has a prim of this name for another reason. */
static void name_looks(struct usda_writer *u)
{
    const struct scene *scene = u->w->b->scene;
    text_init(&u->looks, u->w->scratch);
    text_str(&u->looks, "Looks");
    for (unsigned suffix = 2;; suffix++) {
        prim_id taken = scene_find_child(scene, u->first, u->looks.data, u->looks.len);
        if (!taken || !u->says[taken])
            return;
        u->looks.len = strlen("Looks");
        text_fmt(&u->looks, "_%u", suffix);
    }
}

/* The materials that the stage lacks: prims that a layer with their networks fills. */
static void put_materials(struct usda_writer *u)
{
    const struct document *doc = u->w->b->look.doc;
    if (!u->materials.len)
        return;
    usda_put(&u->text, find_looks(u) ? "    over \"" : "    def Scope \"");
    usda_put(&u->text, text_cstr(&u->looks));
    usda_put(&u->text, "\"\n    {\n");
    for (uint32_t i = 0; i < u->materials.len; i++) {
        bool is_graph = doc_element(doc, u->materials.items[i])->kind == KIND_NODEGRAPH;
        usda_put(&u->text, is_graph ? "        def NodeGraph \"" : "        def Material \"");
        usda_put_name(&u->text, target_name(u, u->materials.items[i]));
        usda_put(&u->text, "\"\n        {\n        }\n");
    }
    usda_put(&u->text, "    }\n");
}

/* ---- Properties ---- */

/* Slot 000, which a tool without slots knows as the plain binding. */
static bool is_base(const struct usda_writer *u, uint32_t name)
{
    return strcmp(u->w->b->look.names.items[name].text, SLOT_DEFAULT) == 0;
}

/* `rel material:binding = </set/Looks/Dust>`; it is weak, also where that of the stage is strong.
 */
static void put_relation(struct usda_writer *u, uint32_t depth, const char *property,
                         uint32_t target, bool was_strong)
{
    usda_put_indent(&u->text, depth);
    usda_put(&u->text, "rel ");
    usda_put(&u->text, property);
    usda_put(&u->text, " = ");
    if (target)
        put_target(u, target);
    else
        usda_put(&u->text, "None");
    usda_put(&u->text, was_strong ? " (bindMaterialAs = \"weakerThanDescendants\")\n" : "\n");
}

/* "material:slotBinding:_050:full", or of slot 000 "material:binding:full". */
static const char *property_of(struct usda_writer *u, struct said said)
{
    const char *purpose = u->w->b->scene->purpose;
    struct text text;
    text_init(&text, u->w->scratch);
    bool is_plain = said.target && is_base(u, said.name);
    text_str(&text, is_plain ? "material:binding" : "material:slotBinding:");
    if (!is_plain)
        slot_encode(&u->w->b->look.names.items[said.name].name, &text);
    text_str(&text, *purpose ? ":" : "");
    text_str(&text, purpose);
    return text_cstr(&text);
}

/* Says a name, in its property and in those that the stage has for it. */
static void put_change(struct usda_writer *u, uint32_t depth, struct said said)
{
    const char *property = property_of(u, said);
    bool is_said = false;
    for (uint32_t at = said.first; at; at = u->next_of[at - 1]) {
        const struct scene_binding *binding = &u->w->b->scene->bindings.items[at - 1];
        put_relation(u, depth, binding->property, said.target, binding->is_strong);
        is_said |= strcmp(binding->property, property) == 0;
    }
    if (!is_said)
        put_relation(u, depth, property, said.target, false);
}

/* Collections of the stage bind nothing any more: their members have bindings of their own. */
static void put_collections(struct usda_writer *u, prim_id prim, uint32_t depth)
{
    const struct scene *scene = u->w->b->scene;
    for (uint32_t at = scene_first_binding(scene, prim); at;) {
        const struct scene_binding *binding = &scene->bindings.items[at - 1];
        if (binding->is_collection && is_replaced(u, binding))
            put_relation(u, depth, binding->property, 0, false);
        at = binding->next;
    }
}

/* Slot 000 comes last: tools without slots let the last binding win. */
static void put_bindings(struct usda_writer *u, prim_id prim, uint32_t depth)
{
    find_changes(u, prim);
    put_collections(u, prim, depth);
    for (unsigned of_base = 0; of_base < 2; of_base++)
        for (uint32_t i = 0; i < u->changes.len; i++)
            if (is_base(u, u->changes.items[i].name) == (of_base != 0))
                put_change(u, depth, u->changes.items[i]);
}

/* The slotorder of the look, or of the scene itself. */
static void put_order(struct usda_writer *u)
{
    const struct bind_look *look = &u->w->b->look;
    if (!look->order_parts.len && !u->w->b->scene->slot_order)
        return;
    usda_put_indent(&u->text, 1);
    usda_put(&u->text, "uniform token[] material:slotOrder = [");
    for (uint32_t i = 0; i < look->order_parts.len; i++) {
        usda_put(&u->text, i ? ", " : "");
        usda_put_string(&u->text, look->order_parts.items[i]);
    }
    usda_put(&u->text, "]\n");
}

/* ---- Prims ---- */

/* Overs below an instance count only if it is none. */
static bool is_instance(const struct usda_writer *u, prim_id prim)
{
    const struct scene *scene = u->w->b->scene;
    for (uint32_t i = scene_source(scene, prim); i; i = scene->sources.items[i - 1].next)
        if (scene->layer.prims.items[scene->sources.items[i - 1].prim].is_instance)
            return true;
    return false;
}

static void put_metadata(struct usda_writer *u, prim_id prim, uint32_t depth)
{
    bool binds = u->says[prim] & SAYS, splits = u->says[prim] & SAYS_BELOW && is_instance(u, prim);
    if (!binds && !splits)
        return;
    usda_put(&u->text, " (\n");
    if (binds) {
        usda_put_indent(&u->text, depth + 1);
        usda_put(&u->text, "prepend apiSchemas = [\"MaterialBindingAPI\"]\n");
    }
    if (splits) {
        usda_put_indent(&u->text, depth + 1);
        usda_put(&u->text, "instanceable = false\n");
    }
    usda_put_indent(&u->text, depth);
    usda_put(&u->text, ")");
}

/* Opens a primitive, and says all but what stands below it. */
static void open_prim(struct usda_writer *u, prim_id prim)
{
    uint32_t depth = scene_depth(u->w->b->scene, prim) - 1;
    usda_put_indent(&u->text, depth);
    usda_put(&u->text, "over \"");
    put_name_of(u, prim);
    usda_put(&u->text, "\"");
    put_metadata(u, prim, depth);
    usda_put(&u->text, "\n");
    usda_put_indent(&u->text, depth);
    usda_put(&u->text, "{\n");
    if (prim == u->first)
        put_order(u);
    if (u->says[prim] & SAYS)
        put_bindings(u, prim, depth + 1);
    if (prim == u->first)
        put_materials(u);
}

static void close_prims(struct usda_writer *u, uint32_t open, uint32_t depth)
{
    while (open > depth) {
        usda_put_indent(&u->text, --open);
        usda_put(&u->text, "}\n");
    }
}

/* A comment about what the layer leaves out; strings keep names of any characters inside of it. */
static void put_loss(struct usda_writer *u, prim_id prim, uint32_t assign, const char *reason)
{
    struct text path, name;
    text_init(&path, u->w->scratch);
    text_init(&name, u->w->scratch);
    scene_path(u->w->b->scene, prim, &path);
    look_assign_name(&u->w->b->look, assign, &name);
    usda_put(&u->text, "# left out: ");
    usda_put_string(&u->text, (struct text_word){name.data, name.len});
    usda_put(&u->text, " at ");
    usda_put_string(&u->text, (struct text_word){path.data, path.len});
    text_fmt(u->text.out, ": %s\n", reason);
}

/* Comments about what stands at a primitive, and slot bindings cannot hold. */
static void put_losses(struct usda_writer *u, prim_id prim)
{
    const struct bindings *b = u->w->b;
    const struct bind_state *state = bind_state_of(b, prim);
    const bool is_instance = scene_is_instance(b->scene, prim);
    for (uint32_t i = 0; i < state->num_items; i++) {
        const struct bind_item *item = &b->items.items[state->first_item + i];
        if (bind_prim_at(b, prim, item->level) != prim)
            continue;
        const char *loss = is_instance ? "USD has no prim for an instance" : loss_of(u, state, i);
        if (loss)
            put_loss(u, prim, item->assign, loss);
    }
}

/* Finds the primitives that the layer has. */
static void mark_prims(struct usda_writer *u)
{
    const struct scene *scene = u->w->b->scene;
    for (prim_id prim = scene_next(scene, 0); prim; prim = scene_next(scene, prim)) {
        if (!find_changes(u, prim))
            continue;
        put_losses(u, prim);
        if (scene_is_instance(scene, prim)) {
            u->num_lost++; /* USD has no prim for it */
            continue;
        }
        u->says[prim] |= SAYS;
        for (uint32_t i = 0; i < u->changes.len; i++)
            note_material(u, u->changes.items[i].target);
        for (prim_id p = scene->prims.items[prim].parent; p && !(u->says[p] & SAYS_BELOW);
             p = scene->prims.items[p].parent)
            u->says[p] |= SAYS_BELOW;
    }
    if (u->first && !u->says[u->first])
        u->says[u->first] = SAYS_BELOW;
    name_looks(u);
}

/* The default prim of the stage, or its first one; 0: it has no primitives. */
static prim_id find_first(const struct scene *scene)
{
    struct text_word name = scene->layer.default_prim;
    prim_id found = name.len ? scene_find_child(scene, 0, name.bytes, name.len) : 0;
    return found ? found : scene->prims.items[0].first_child;
}

/* A layer that opens a stage says its unit and axis itself: those of sublayers do not count. */
static void put_head(struct usda_writer *u)
{
    const struct usda_layer *layer = &u->w->b->scene->layer;
    usda_put(&u->text, "#usda 1.0\n(\n");
    if (u->first) {
        usda_put(&u->text, "    defaultPrim = \"");
        put_name_of(u, u->first);
        usda_put(&u->text, "\"\n");
    }
    if (layer->meters_per_unit.len) {
        usda_put(&u->text, "    metersPerUnit = ");
        text_put(u->text.out, layer->meters_per_unit);
        usda_put(&u->text, "\n");
    }
    if (layer->up_axis.len) {
        usda_put(&u->text, "    upAxis = ");
        usda_put_string(&u->text, layer->up_axis);
        usda_put(&u->text, "\n");
    }
    usda_put(&u->text, ")\n");
}

/* Fills `name_of`, `scene_names`, and makes room for what primitives say of each name. */
static void find_names(struct usda_writer *u)
{
    const struct bind_look *look = &u->w->b->look;
    struct arena *arena = u->w->scratch;
    struct said_list *lists[] = {&u->own, &u->above, &u->changes};
    u->name_of = ARENA_ARRAY(arena, uint32_t, look->scene->bindings.len);
    u->next_of = ARENA_ARRAY(arena, uint32_t, look->scene->bindings.len);
    bool *has_name = ARENA_ARRAY(arena, bool, look->names.len);
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        lists[i]->at = ARENA_ARRAY(arena, uint32_t, look->names.len);
    for (uint32_t i = 0; i < look->assigns.len; i++) {
        const struct look_assign *assign = &look->assigns.items[i];
        if (!assign->binding)
            continue;
        u->name_of[assign->binding - 1] = assign->name + 1;
        if (!has_name[assign->name])
            vec_push(arena, &u->scene_names, assign->name);
        has_name[assign->name] = true;
    }
}

uint32_t bind_write_usda(struct bind_writer *w)
{
    const struct bindings *b = w->b;
    const struct scene *scene = b->scene;
    struct usda_writer u = {.w = w, .text = {.out = w->out}, .first = find_first(scene)};
    find_names(&u);
    u.says = ARENA_ARRAY(w->scratch, uint8_t, scene->prims.len);
    put_head(&u);
    mark_prims(&u);
    uint32_t open = 0;
    for (prim_id prim = scene_next(scene, 0); prim; prim = scene_next(scene, prim)) {
        if (!u.says[prim])
            continue;
        close_prims(&u, open, scene_depth(scene, prim) - 1);
        open_prim(&u, prim);
        open = scene_depth(scene, prim);
        if (w->flush)
            w->flush(w->user_data, w->out);
    }
    close_prims(&u, open, 0);
    return u.num_lost + u.text.num_changed;
}
