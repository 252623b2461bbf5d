// SPDX-License-Identifier: Apache-2.0
/*
 * Finds what drives the inputs of a layer's material: products of weaker assignments, then
 * variants, then overrides, of which a later one wins. An output of an override drives the inputs
 * of its name
 *
 *     of the material's node;                   if it has none,
 *     of the interfaces of its nodegraphs;      if they have none,
 *     of its shader nodes.
 */
#include "bind/drive.h"

#include <assert.h>

/* A driver: a variant or an override, or a product. */
struct driver {
    struct diag_place place; /* of an override */
    const char *slot;        /* its name: "050::010"; NULL: no override */
};

struct driving {
    const struct bindings *b;
    const struct library *lib;
    const struct document *doc;
    struct arena *arena;
    struct substance substance;
    struct library_drives *out;
    struct drive_notes *notes; /* NULL: silent */
    elem_id set;               /* of the variant at hand, if it is for some nodes alone; 0 */
};

static const char *text_of(const struct driving *d, str_id id)
{
    return str_text(d->doc->strings, id);
}

static const struct element *element(const struct driving *d, elem_id id)
{
    return doc_element(d->doc, id);
}

/* ---- Inputs ---- */

/* The type of an input and whether it is uniform; false: the owner has no such input. */
struct driven {
    elem_id owner;
    str_id input;
    str_id type;
    bool is_uniform;
};

static bool node_has(struct driving *d, elem_id node, str_id input, struct driven *out)
{
    uint32_t nodedef = library_match(d->lib, node, &d->substance.ignored);
    int port = nodedef == LIBRARY_NONE ? -1 : library_find_input(d->lib, nodedef, input);
    if (port < 0)
        return false;
    const struct port *found = library_ports(d->lib, nodedef, NULL) + port;
    *out = (struct driven){node, input, library_type_name(d->lib, found->type),
                           found->flags & PORT_UNIFORM};
    return true;
}

static bool graph_has(const struct driving *d, elem_id graph, str_id input, struct driven *out)
{
    elem_id found = doc_child_of_kind(d->doc, graph, KIND_INPUT, input);
    if (!found)
        return false;
    str_id uniform = doc_attr_value(d->doc, found, STR_uniform);
    *out = (struct driven){graph, input, doc_attr_value(d->doc, found, STR_type),
                           uniform && strcmp(text_of(d, uniform), "true") == 0};
    return true;
}

/* Every material has a mask, and takes a normal as a product. */
static bool material_has(struct driving *d, str_id input, bool is_product, struct driven *out)
{
    if (node_has(d, d->substance.material, input, out))
        return true;
    bool is_virtual = input == STR_mask || (input == STR_normal && is_product);
    str_id type = input == STR_mask ? STR_float : STR_vector3;
    *out = (struct driven){d->substance.material, input, type, false};
    return is_virtual;
}

/* ---- Sources ---- */

/*
 * The input that holds the value of a source, if it has one: the value of a <constant>, too. So an
 * override of a value gives the shader of another value.
 */
static elem_id holder_of(struct driving *d, elem_id source, const struct binding *binding)
{
    if (binding->kind == BIND_VALUE || binding->kind == BIND_DEFAULT)
        return binding->element ? binding->element : source;
    bool is_constant = binding->kind == BIND_NODE
                       && strcmp(text_of(d, element(d, binding->ref)->category), "constant") == 0;
    elem_id value =
        is_constant ? doc_child_of_kind(d->doc, binding->ref, KIND_INPUT, STR_value) : 0;
    if (!value)
        return 0;
    struct binding end = substance_resolve(&d->substance, value);
    return end.kind == BIND_VALUE ? end.element : 0;
}

static void report(struct driving *d, enum diag_id id, elem_id source, const struct driver *driver,
                   const struct driven *driven, const char *have)
{
    struct text path;
    if (!d->notes || d->notes->seen[source - d->doc->first_element] & DRIVE_REPORTED)
        return;
    d->notes->seen[source - d->doc->first_element] |= DRIVE_REPORTED;
    text_init(&path, d->arena);
    doc_path(d->doc, driven->owner, '/', &path);
    diag_add(d->notes->diags, id, doc_place(d->doc, source), text_of(d, element(d, source)->name),
             driver->slot, text_cstr(&path), text_of(d, driven->input), text_of(d, driven->type),
             have);
}

static void drive(struct driving *d, elem_id source, const struct driver *driver,
                  const struct driven *driven)
{
    str_id type = doc_attr_value(d->doc, source, STR_type);
    struct binding binding = substance_resolve(&d->substance, source);
    elem_id holder = holder_of(d, source, &binding);
    if (d->notes)
        d->notes->seen[source - d->doc->first_element] |= DRIVE_MATCHED;
    if (driver->slot && type != driven->type) {
        report(d, DIAG_ID_override_type, source, driver, driven, text_of(d, type));
        return;
    }
    bool is_constant = binding.kind == BIND_NODE
                       && strcmp(text_of(d, element(d, binding.ref)->category), "constant") == 0;
    if (driver->slot && driven->is_uniform && !holder && !is_constant) {
        report(d, DIAG_ID_override_varies, source, driver, driven, "");
        return;
    }
    library_drive(d->out, d->arena,
                  (struct library_drive){driven->owner, driven->input, holder ? holder : source});
}

/* ---- By name ---- */

/* False if a variant at hand is for other nodes; nodegraphs are no nodes. */
static bool takes(struct driving *d, elem_id owner)
{
    return !d->set
           || (element(d, owner)->kind == KIND_NODE
               && substance_set_takes(&d->substance, d->set, owner));
}

static void drive_by_name(struct driving *d, elem_id source, const struct driver *driver)
{
    str_id name = element(d, source)->name;
    struct driven driven;
    bool any = false;
    if (takes(d, d->substance.material) && material_has(d, name, false, &driven)) {
        drive(d, source, driver, &driven);
        return;
    }
    for (uint32_t i = 0; i < d->substance.graphs.len; i++)
        if (!d->set && graph_has(d, d->substance.graphs.items[i], name, &driven)) {
            drive(d, source, driver, &driven);
            any = true;
        }
    for (uint32_t i = 0; i < d->substance.shaders.len && !any; i++)
        if (takes(d, d->substance.shaders.items[i])
            && node_has(d, d->substance.shaders.items[i], name, &driven))
            drive(d, source, driver, &driven);
}

/* ---- Tokens ---- */

/* A token of this name, and no input of it: of the element, or of its definition. */
static bool has_token(struct driving *d, elem_id owner, str_id name)
{
    struct driven input;
    bool is_graph = element(d, owner)->kind == KIND_NODEGRAPH;
    if (is_graph ? graph_has(d, owner, name, &input) : node_has(d, owner, name, &input))
        return false;
    uint32_t nodedef =
        is_graph ? LIBRARY_NONE : library_match(d->lib, owner, &d->substance.ignored);
    elem_id definition = nodedef == LIBRARY_NONE ? 0 : library_nodedef(d->lib, nodedef)->element;
    return doc_child_of_kind(d->doc, owner, KIND_TOKEN, name)
           || (definition && doc_child_of_kind(d->doc, definition, KIND_TOKEN, name));
}

static bool drive_token_of(struct driving *d, elem_id owner, elem_id source)
{
    str_id name = element(d, source)->name;
    bool has = takes(d, owner) && has_token(d, owner, name);
    if (has)
        library_drive(d->out, d->arena, (struct library_drive){owner, name, source});
    return has;
}

/* A token goes the way of an input: to the material, else to the nodegraphs, else to shaders. */
static void drive_token(struct driving *d, elem_id source)
{
    bool any = false;
    if (drive_token_of(d, d->substance.material, source))
        return;
    for (uint32_t i = 0; i < d->substance.graphs.len; i++)
        any |= drive_token_of(d, d->substance.graphs.items[i], source);
    for (uint32_t i = 0; i < d->substance.shaders.len && !any; i++)
        drive_token_of(d, d->substance.shaders.items[i], source);
}

/* overrides="NG_wood/scale": one input, by its path. */
static void drive_by_path(struct driving *d, elem_id source, const struct driver *driver,
                          const char *path)
{
    const char *slash = strrchr(path, '/');
    str_id input = slash ? str_find(d->doc->strings, slash + 1, strlen(slash + 1)) : 0;
    struct text own;
    struct driven driven;
    text_init(&own, d->arena);
    for (uint32_t i = 0; input && i < d->substance.order.len; i++) {
        elem_id owner = d->substance.order.items[i];
        own.len = 0;
        doc_path(d->doc, owner, '/', &own);
        if (own.len != (size_t)(slash - path) || memcmp(own.data, path, own.len) != 0)
            continue;
        bool has = owner == d->substance.material ? material_has(d, input, false, &driven)
                   : element(d, owner)->kind == KIND_NODEGRAPH ? graph_has(d, owner, input, &driven)
                                                               : node_has(d, owner, input, &driven);
        if (has)
            drive(d, source, driver, &driven);
    }
}

static void drive_output(struct driving *d, elem_id source, const struct driver *driver)
{
    str_id path = doc_attr_value(d->doc, source, STR_overrides);
    if (d->notes && driver->slot)
        drive_note(d->notes, source, driver->place, driver->slot);
    if (path)
        drive_by_path(d, source, driver, text_of(d, path));
    else
        drive_by_name(d, source, driver);
}

/* ---- Products, variants, overrides ---- */

static void add_product(struct driving *d, const struct bind_item *item)
{
    const struct look_assign *a = &d->b->look.assigns.items[item->assign];
    const char *word = bind_product_names[item->product];
    str_id name = str_find(d->doc->strings, word, strlen(word));
    elem_id from = bind_material_node(d->lib, a->target, &d->substance.ignored);
    elem_id source = from && name ? doc_child_of_kind(d->doc, from, KIND_INPUT, name) : 0;
    struct driven driven;
    struct driver product = {.slot = NULL};
    if (!source || !material_has(d, name, true, &driven))
        return;
    drive(d, source, &product, &driven);
    substance_follow(&d->substance, source); /* its graphs and shaders belong to it now */
}

static void add_variant(struct driving *d, const struct look_variant *variant)
{
    struct driver driver = {.slot = NULL};
    bool is_restricted = doc_attr_value(d->doc, variant->set, STR_node)
                         || doc_attr_value(d->doc, variant->set, STR_nodedef);
    d->set = is_restricted ? variant->set : 0;
    for (elem_id e = element(d, variant->variant)->first_child; e; e = element(d, e)->next)
        if (element(d, e)->kind == KIND_INPUT)
            drive_by_name(d, e, &driver);
        else if (element(d, e)->kind == KIND_TOKEN)
            drive_token(d, e);
    d->set = 0;
}

static void add_variants(struct driving *d, uint32_t assign)
{
    const struct variant_list *variants = &d->b->look.assigns.items[assign].variants;
    for (uint32_t i = 0; i < variants->len; i++)
        add_variant(d, &variants->items[i]);
}

/* The inputs that a node has in the document. */
static void add_inputs(struct driving *d, elem_id node, const struct driver *driver)
{
    for (elem_id e = element(d, node)->first_child; e; e = element(d, e)->next)
        if (element(d, e)->kind == KIND_INPUT)
            drive_output(d, e, driver);
}

/*
 * A material as an override: the inputs of its shaders, and its own ones that are no shaders, count
 * as outputs of their names.
 */
static void add_material(struct driving *d, elem_id target, const struct driver *driver)
{
    elem_id material = bind_material_node(d->lib, target, &d->substance.ignored);
    for (elem_id e = material ? element(d, material)->first_child : 0; e; e = element(d, e)->next) {
        str_id type = doc_attr_value(d->doc, e, STR_type);
        if (element(d, e)->kind != KIND_INPUT)
            continue;
        if (type != STR_surfaceshader && type != STR_displacementshader) {
            drive_output(d, e, driver);
            continue;
        }
        struct binding binding = substance_resolve(&d->substance, e);
        if (binding.kind == BIND_NODE)
            add_inputs(d, binding.ref, driver);
    }
}

static void add_override(struct driving *d, const struct bind_item *item)
{
    const struct look_assign *a = &d->b->look.assigns.items[item->assign];
    const struct driver driver = {look_slot_place(&d->b->look, a),
                                  d->b->look.names.items[a->name].text};
    if (a->kind != ASSIGN_GRAPH) {
        add_material(d, a->target, &driver);
        return;
    }
    for (elem_id e = element(d, a->target)->first_child; e; e = element(d, e)->next)
        if (element(d, e)->kind == KIND_OUTPUT)
            drive_output(d, e, &driver);
}

uint32_t bind_num_parts(const struct bind_item *items, uint32_t num)
{
    uint32_t n = 1;
    while (n < num && (items[n].kind == ITEM_PRODUCT || items[n].kind == ITEM_OVERRIDE))
        n++;
    return n;
}

void bind_drives(const struct bindings *b, const struct library *lib, const struct bind_item *items,
                 uint32_t num, struct drive_notes *notes, struct arena *arena,
                 struct library_drives *out)
{
    struct driving d = {
        .b = b, .lib = lib, .doc = &lib->doc, .arena = arena, .out = out, .notes = notes};
    assert(num > 0
           && (items->kind == ITEM_LAYER || items->kind == ITEM_VERTICAL
               || items->kind == ITEM_VOLUME));
    if (num == 1 && !b->look.variants.len)
        return;
    substance_find(&d.substance, lib, b->look.assigns.items[items->assign].target, arena);
    if (!d.substance.material)
        return;
    for (uint32_t i = 1; i < num; i++)
        if (items[i].kind == ITEM_PRODUCT)
            add_product(&d, &items[i]);
    add_variants(&d, items->assign);
    for (uint32_t i = 1; i < num; i++)
        if (items[i].kind == ITEM_OVERRIDE)
            add_override(&d, &items[i]);
}

/* ---- Messages of all stacks ---- */

void drive_note(struct drive_notes *notes, elem_id source, struct diag_place place,
                const char *slot)
{
    uint8_t *seen = &notes->seen[source - notes->first_element];
    if (!(*seen & DRIVE_MET))
        vec_push(notes->arena, &notes->outputs, (struct drive_output){source, place, slot});
    *seen |= DRIVE_MET;
}

static void guess_inputs(struct driving *d, struct diag_guess *guess)
{
    for (uint32_t i = 0; i < d->substance.order.len; i++)
        for (elem_id e = element(d, d->substance.order.items[i])->first_child; e;
             e = element(d, e)->next)
            if (element(d, e)->kind == KIND_INPUT)
                diag_guess_add(guess, text_of(d, element(d, e)->name));
    for (uint32_t i = 0; i < d->substance.shaders.len; i++) {
        uint32_t nodedef =
            library_match(d->lib, d->substance.shaders.items[i], &d->substance.ignored);
        for (unsigned k = 0;
             nodedef != LIBRARY_NONE && k < library_nodedef(d->lib, nodedef)->num_inputs; k++)
            diag_guess_add(guess, text_of(d, library_ports(d->lib, nodedef, NULL)[k].name));
    }
}

/* The nearest name among the inputs of a material that the override is for. */
static const char *nearest(const struct bindings *b, const struct library *lib, const char *slot,
                           const char *name, struct drive_notes *notes)
{
    struct diag_guess guess;
    size_t len = strcspn(slot, ":");
    if (!diag_guess_begin(&guess, notes->diags, name))
        return "";
    for (uint32_t i = 0; i < b->look.assigns.len; i++) {
        const struct look_assign *a = &b->look.assigns.items[i];
        const char *own = b->look.names.items[a->name].text;
        if (a->kind != ASSIGN_LAYER || strlen(own) != len || memcmp(own, slot, len) != 0)
            continue;
        struct driving d = {.b = b, .lib = lib, .doc = &lib->doc, .arena = notes->arena};
        substance_find(&d.substance, lib, a->target, notes->arena);
        guess_inputs(&d, &guess);
    }
    return diag_guess_text(&guess);
}

static void warn_unmatched(const struct bindings *b, const struct library *lib,
                           struct drive_notes *notes)
{
    for (uint32_t i = 0; i < notes->outputs.len; i++) {
        const struct drive_output *o = &notes->outputs.items[i];
        if (notes->seen[o->source - notes->first_element] & DRIVE_MATCHED)
            continue;
        str_id path = doc_attr_value(&lib->doc, o->source, STR_overrides);
        const char *name =
            str_text(lib->doc.strings, path ? path : doc_element(&lib->doc, o->source)->name);
        diag_add(notes->diags, DIAG_ID_override_unmatched, doc_place(&lib->doc, o->source), name,
                 o->slot, path ? "" : nearest(b, lib, o->slot, name, notes));
    }
}

void bind_check_drives(const struct bindings *b, const struct library *lib, struct arena *scratch,
                       struct diag_list *diags)
{
    struct drive_notes notes = {.arena = scratch,
                                .diags = diags,
                                .first_element = lib->doc.first_element,
                                .seen = ARENA_ARRAY(scratch, uint8_t, doc_num_elements(&lib->doc))};
    for (uint32_t i = 0; i < b->stacks.len; i++) {
        const struct bind_state *state = &b->states.items[b->stacks.items[i].state];
        const struct bind_item *items = b->items.items + state->first_item;
        for (uint32_t k = 0, num; k < state->num_items; k += num) {
            struct library_drives drives = {0};
            num = bind_num_parts(items + k, state->num_items - k);
            if (items[k].kind == ITEM_LAYER || items[k].kind == ITEM_VERTICAL)
                bind_drives(b, lib, items + k, num, &notes, scratch, &drives);
        }
    }
    warn_unmatched(b, lib, &notes);
}
