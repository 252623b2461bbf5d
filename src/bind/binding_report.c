// SPDX-License-Identifier: Apache-2.0
/* Bindings as a table for people, and as JSON for programs. */
#include "base/json.h"
#include "bind/bind.h"

static const struct look_assign *assign_of(const struct bind_writer *w,
                                           const struct bind_item *item)
{
    return &w->b->look.assigns.items[item->assign];
}

static const char *name_of(const struct bind_writer *w, elem_id element)
{
    const struct document *doc = w->b->look.doc;
    return element ? doc_name(doc, element) : "";
}

static const char *slot_of(const struct bind_writer *w, const struct bind_item *item)
{
    return w->b->look.names.items[assign_of(w, item)->name].text;
}

void bind_writer_init(struct bind_writer *w)
{
    text_init(&w->path, w->scratch);
    text_init(&w->name, w->scratch);
    w->stands.scratch = w->scratch;
}

static void flush(struct bind_writer *w)
{
    enum { PIECE = 1 << 16 };
    if (w->out->len > PIECE)
        w->flush(w->user_data, w->out);
}

/* A primitive, and its depth: the path of an item that is set here has as many levels. */
struct place {
    prim_id prim;
    uint32_t level;
    const struct bind_item *items;
    uint32_t num_items;
};

static struct place place_of(const struct bind_writer *w, prim_id prim)
{
    const struct bind_state *state = bind_state_of(w->b, prim);
    return (struct place){prim, scene_depth(w->b->scene, prim) + 1,
                          w->b->items.items + state->first_item, state->num_items};
}

/* ---- The table ---- */

/* A name without the part that the item before it has shown: "::010" behind "050". */
static const char *short_name(const struct bind_writer *w, const struct bind_item *item)
{
    const struct look_name *name = &w->b->look.names.items[assign_of(w, item)->name];
    const struct text_word *parts = name->name.parts;
    if (parts[SLOT_OVERRIDE].len)
        return parts[SLOT_OVERRIDE].bytes - strlen("::");
    return parts[SLOT_VERTICAL].len ? parts[SLOT_VERTICAL].bytes - strlen("|") : name->text;
}

/* "[" set here, bright; "(" inherited, dim. */
static void put_open(struct bind_writer *w, bool is_here)
{
    if (w->colour)
        text_str(w->out, is_here ? "\033[1m" : "\033[2m");
    text_char(w->out, is_here ? '[' : '(');
}

static void put_close(struct bind_writer *w, bool is_here)
{
    text_char(w->out, is_here ? ']' : ')');
    if (w->colour)
        text_str(w->out, "\033[0m");
}

static void put_cell(struct bind_writer *w, const struct place *place, const struct bind_item *item)
{
    const struct look_assign *a = assign_of(w, item);
    bool is_here = item->level == place->level;
    put_open(w, is_here);
    size_t begin = w->out->len;
    if (item->kind == ITEM_PRODUCT)
        text_fmt(w->out, "%s of", bind_product_names[item->product]);
    else if (item->kind == ITEM_VOLUME || item->kind == ITEM_LIGHT)
        text_str(w->out, item->kind == ITEM_VOLUME ? "volume" : "light");
    else
        text_str(w->out, short_name(w, item));
    text_fmt(w->out, " %s", name_of(w, a->target));
    text_show(w->out, begin);
    put_close(w, is_here);
}

/* The names that the primitive has without a layer; neighbours often share a state. */
static const struct idle_list *idle_of(struct bind_writer *w, prim_id prim)
{
    const struct bind_state *state = bind_state_of(w->b, prim);
    if (w->idle_state != state)
        bind_find_idle(w->b, state, &w->stands, &w->idle);
    w->idle_state = state;
    return &w->idle;
}

/* "[050 removed]", "(050::010 pattern asleep)" */
static void put_idle_cells(struct bind_writer *w, const struct place *place)
{
    const struct idle_list *idle = idle_of(w, place->prim);
    for (uint32_t i = 0; i < idle->len; i++) {
        const struct bind_item *item = &idle->items[i].item;
        bool is_here = item->level == place->level;
        text_str(w->out, "  ");
        put_open(w, is_here);
        size_t begin = w->out->len;
        text_str(w->out, slot_of(w, item));
        if (idle->items[i].is_removed)
            text_str(w->out, " removed");
        else
            text_fmt(w->out, " %s asleep", name_of(w, assign_of(w, item)->target));
        text_show(w->out, begin);
        put_close(w, is_here);
    }
}

static void put_row(struct bind_writer *w, prim_id prim, size_t width)
{
    struct place place = place_of(w, prim);
    size_t begin = w->out->len;
    scene_path(w->b->scene, prim, w->out);
    text_show(w->out, begin);
    size_t len = text_width(w->out->data + begin, w->out->len - begin);
    text_fmt(w->out, "%*s", (int)(width > len ? width - len : 0) + 2, "");
    for (uint32_t i = 0; i < place.num_items; i++) {
        if (i)
            text_str(w->out, place.items[i].kind == ITEM_LAYER ? "  " : " ");
        put_cell(w, &place, &place.items[i]);
    }
    if (!place.num_items)
        text_str(w->out, scene_is_group(w->b->scene, prim) ? "-" : "default");
    put_idle_cells(w, &place);
    text_char(w->out, '\n');
}

static size_t path_width(const struct scene *scene)
{
    enum { MAX_WIDTH = 60 };
    size_t width = 4, len = 0;
    for (prim_id prim = scene_next(scene, 0); prim; prim = scene_next(scene, prim)) {
        len = 0;
        for (prim_id p = prim; p && len <= MAX_WIDTH; p = scene->prims.items[p].parent)
            len += text_width(scene->prims.items[p].name, scene->prims.items[p].name_len) + 1;
        width = len > width ? len : width;
    }
    return width < MAX_WIDTH ? width : MAX_WIDTH;
}

void bind_write_table(struct bind_writer *w)
{
    const struct scene *scene = w->b->scene;
    size_t width = path_width(scene);
    text_fmt(w->out, "%-*s  layers, base first: [set here] (inherited)\n", (int)width, "path");
    for (prim_id prim = scene_next(scene, 0); prim; prim = scene_next(scene, prim)) {
        put_row(w, prim, width);
        flush(w);
    }
}

/* ---- JSON ---- */

void bind_stack_name(const struct bindings *b, uint32_t stack, char out[BIND_STACK_NAME_SIZE])
{
    static const char prefix[] = "stack_", digits[] = "0123456789abcdef";
    uint64_t hash = b->stacks.items[stack].hash;
    memcpy(out, prefix, sizeof prefix - 1);
    for (unsigned i = 0; i < 16; i++)
        out[sizeof prefix - 1 + i] = digits[hash >> (60 - 4 * i) & 15];
    out[BIND_STACK_NAME_SIZE - 1] = '\0';
}

static void put_stack_name(struct bind_writer *w, uint32_t stack)
{
    char name[BIND_STACK_NAME_SIZE];
    bind_stack_name(w->b, stack, name);
    text_fmt(w->out, "\"%s\"", name);
}

static void put_path(struct bind_writer *w, prim_id prim)
{
    w->path.len = 0;
    scene_path(w->b->scene, prim, &w->path);
    text_json_string(w->out, w->path.data, w->path.len);
}

/* Material or nodegraph, where it stands, and the assignment. */
static void put_source(struct bind_writer *w, struct json *json, const struct place *place,
                       const struct bind_item *item)
{
    const struct look_assign *a = assign_of(w, item);
    struct diag_place at = look_assign_place(&w->b->look, a);
    if (a->target)
        json_put_text(json, a->kind == ASSIGN_GRAPH ? "nodegraph" : "material",
                      name_of(w, a->target));
    json_key(json, "from");
    put_path(w, bind_prim_at(w->b, place->prim, item->level));
    json_put_bool(json, "inherited", item->level != place->level);
    w->name.len = 0;
    look_assign_name(&w->b->look, item->assign, &w->name);
    text_fmt(&w->name, " %s:%u", at.file ? at.file : "", (unsigned)at.line);
    json_put_text(json, "assign", text_cstr(&w->name));
}

static void put_variants(struct bind_writer *w, struct json *json, const struct bind_item *item)
{
    const struct variant_list *variants = &assign_of(w, item)->variants;
    if (!variants->len)
        return;
    json_key(json, "variants");
    json_open(json, '[');
    for (uint32_t i = 0; i < variants->len; i++) {
        json_item(json);
        json_open(json, '{');
        json_put_text(json, "variantset", name_of(w, variants->items[i].set));
        json_put_text(json, "variant", name_of(w, variants->items[i].variant));
        json_close(json, '}');
    }
    json_close(json, ']');
}

/* The items of a kind that belong to the layer at `*at`: up to the next layer. */
static void put_parts(struct bind_writer *w, struct json *json, const struct place *place,
                      uint32_t first, enum item_kind kind)
{
    bool is_open = false;
    for (uint32_t i = first; i < place->num_items; i++) {
        const struct bind_item *item = &place->items[i];
        if (item->kind == ITEM_LAYER || item->kind == ITEM_VERTICAL)
            break;
        if (item->kind != kind)
            continue;
        if (!is_open) {
            json_key(json, kind == ITEM_PRODUCT ? "products" : "overrides");
            json_open(json, kind == ITEM_PRODUCT ? '{' : '[');
            is_open = true;
        }
        if (kind == ITEM_PRODUCT)
            json_key(json, bind_product_names[item->product]);
        else
            json_item(json);
        json_open(json, '{');
        if (kind == ITEM_OVERRIDE)
            json_put_text(json, "slot", slot_of(w, item));
        put_source(w, json, place, item);
        json_close(json, '}');
    }
    if (is_open)
        json_close(json, kind == ITEM_PRODUCT ? '}' : ']');
}

/* One layer without its vertical ones. */
static void put_layer(struct bind_writer *w, struct json *json, const struct place *place,
                      uint32_t index)
{
    const struct bind_item *item = &place->items[index];
    json_put_text(json, "slot", slot_of(w, item));
    put_source(w, json, place, item);
    put_variants(w, json, item);
    put_parts(w, json, place, index + 1, ITEM_PRODUCT);
    put_parts(w, json, place, index + 1, ITEM_OVERRIDE);
}

/* The vertical layers behind the layer at `index`. */
static void put_verticals(struct bind_writer *w, struct json *json, const struct place *place,
                          uint32_t index)
{
    bool is_open = false;
    for (uint32_t i = index + 1; i < place->num_items && place->items[i].kind != ITEM_LAYER; i++) {
        if (place->items[i].kind != ITEM_VERTICAL)
            continue;
        if (!is_open) {
            json_key(json, "vertical");
            json_open(json, '[');
            is_open = true;
        }
        json_item(json);
        json_open(json, '{');
        put_layer(w, json, place, i);
        json_close(json, '}');
    }
    if (is_open)
        json_close(json, ']');
}

static void put_beside(struct bind_writer *w, struct json *json, const struct place *place)
{
    for (uint32_t i = 0; i < place->num_items; i++) {
        const struct bind_item *item = &place->items[i];
        if (item->kind != ITEM_VOLUME && item->kind != ITEM_LIGHT)
            continue;
        json_key(json, item->kind == ITEM_VOLUME ? "volume" : "light");
        json_open(json, '{');
        json_put_text(json, "slot", slot_of(w, item));
        put_source(w, json, place, item);
        put_variants(w, json, item);
        json_close(json, '}');
    }
}

/* The names that are removed, or those that sleep. */
static void put_idle(struct bind_writer *w, struct json *json, const struct place *place,
                     bool is_removed)
{
    const struct idle_list *idle = idle_of(w, place->prim);
    bool is_open = false;
    for (uint32_t i = 0; i < idle->len; i++) {
        if (idle->items[i].is_removed != is_removed)
            continue;
        if (!is_open) {
            json_key(json, is_removed ? "removed" : "asleep");
            json_open(json, '[');
            is_open = true;
        }
        json_item(json);
        json_open(json, '{');
        json_put_text(json, "slot", slot_of(w, &idle->items[i].item));
        put_source(w, json, place, &idle->items[i].item);
        json_close(json, '}');
    }
    if (is_open)
        json_close(json, ']');
}

static void put_primitive(struct bind_writer *w, struct json *json, prim_id prim)
{
    struct place place = place_of(w, prim);
    json_item(json);
    json_open_flat(json, '{');
    json_key(json, "path");
    put_path(w, prim);
    if (bind_state_of(w->b, prim)->stack != STACK_NONE) {
        json_key(json, "stack");
        put_stack_name(w, bind_state_of(w->b, prim)->stack);
    }
    json_key(json, "layers");
    json_open(json, '[');
    for (uint32_t i = 0; i < place.num_items; i++) {
        if (place.items[i].kind != ITEM_LAYER)
            continue;
        json_item(json);
        json_open(json, '{');
        put_layer(w, json, &place, i);
        put_verticals(w, json, &place, i);
        json_close(json, '}');
    }
    json_close(json, ']');
    put_beside(w, json, &place);
    put_idle(w, json, &place, true);
    put_idle(w, json, &place, false);
    json_close(json, '}');
}

/* The primitives of each stack, in the order of the scene: lists that one pass fills. */
struct members {
    prim_id *items;
    uint32_t *ends; /* by stack; the list of a stack ends where that of the next begins */
};

static struct members find_members(const struct bind_writer *w)
{
    const struct bindings *b = w->b;
    struct members m = {ARENA_ARRAY(w->scratch, prim_id, b->scene->prims.len),
                        ARENA_ARRAY(w->scratch, uint32_t, b->stacks.len + 1)};
    for (uint32_t i = 1; i < b->stacks.len; i++)
        m.ends[i] = m.ends[i - 1] + b->stacks.items[i - 1].num_prims;
    for (prim_id prim = scene_next(b->scene, 0); prim; prim = scene_next(b->scene, prim))
        if (bind_state_of(b, prim)->stack != STACK_NONE)
            m.items[m.ends[bind_state_of(b, prim)->stack]++] = prim;
    return m;
}

static void put_stack(struct bind_writer *w, struct json *json, const struct members *members,
                      uint32_t number)
{
    const struct bind_stack *stack = &w->b->stacks.items[number];
    json_item(json);
    json_open_flat(json, '{');
    json_key(json, "name");
    put_stack_name(w, number);
    json_key(json, "primitives");
    json_open(json, '[');
    for (uint32_t i = members->ends[number] - stack->num_prims; i < members->ends[number]; i++) {
        json_item(json);
        put_path(w, members->items[i]);
        flush(w);
    }
    json_close(json, ']');
    json_close(json, '}');
}

void bind_write_json(struct bind_writer *w)
{
    const struct scene *scene = w->b->scene;
    struct json json = {.out = w->out};
    struct members members = find_members(w);
    json_open(&json, '{');
    json_key(&json, "primitives");
    json_open(&json, '[');
    for (prim_id prim = scene_next(scene, 0); prim; prim = scene_next(scene, prim)) {
        put_primitive(w, &json, prim);
        flush(w);
    }
    json_close(&json, ']');
    json_key(&json, "stacks");
    json_open(&json, '[');
    for (uint32_t i = 0; i < w->b->stacks.len; i++)
        put_stack(w, &json, &members, i);
    json_close(&json, ']');
    json_close(&json, '}');
    text_char(w->out, '\n');
}
