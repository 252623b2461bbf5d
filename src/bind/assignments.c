// SPDX-License-Identifier: Apache-2.0
/* Reads assignments of materials, and of variants. */
#include "base/hash.h"
#include "bind/look.h"

static const char *text_of(const struct bind_look *look, str_id id)
{
    return str_text(look->doc->strings, id);
}

static const char *category_of(const struct bind_look *look, elem_id element)
{
    return text_of(look, doc_element(look->doc, element)->category);
}

/* ---- Names ---- */

uint32_t look_intern_name(struct bind_look *look, const struct slot_name *name, const char *text,
                          size_t len)
{
    uint32_t hash = hash_bytes(text, len);
    for (uint32_t at = hash, found; (found = table_next(&look->name_table, hash, &at));)
        if (strcmp(look->names.items[found - 1].text, text) == 0)
            return found - 1;
    struct look_name added = {.name = *name, .text = text, .number = look->names.len};
    vec_push(look->arena, &look->names, added);
    table_add(&look->name_table, look->arena, hash, look->names.len);
    return look->names.len - 1;
}

static bool read_name(struct bind_look *look, elem_id element, struct slot_name *out,
                      const char **out_text)
{
    const struct attribute *slot = doc_attr(look->doc, element, STR_slot);
    const char *text = slot ? text_of(look, slot->value) : SLOT_DEFAULT;
    const char *fault = slot_parse(text, strlen(text), out);
    *out_text = text;
    if (fault)
        diag_add(look->diags, DIAG_ID_bad_slot, doc_attr_place(look->doc, element, STR_slot), text,
                 fault);
    return !fault;
}

/* ---- Materials ---- */

static bool is_given(const struct document *doc, elem_id input)
{
    return doc_attr(doc, input, STR_value) || doc_attr_value(doc, input, STR_nodename)
           || doc_attr_value(doc, input, STR_nodegraph) || doc_attr_value(doc, input, STR_output);
}

/* A material with a shader of another kind and no surface binds beside the stack. */
static uint8_t kind_of_material(const struct bind_look *look, elem_id material)
{
    const struct document *doc = look->doc;
    bool has_surface = false, has_volume = false, has_light = false;
    for (elem_id e = doc_element(doc, material)->first_child; e; e = doc_element(doc, e)->next) {
        str_id type = doc_attr_value(doc, e, STR_type);
        has_surface |= type == STR_surfaceshader || type == STR_displacementshader;
        has_volume |= type == STR_volumeshader;
        has_light |= type == STR_lightshader;
    }
    bool is_volume = doc_element(doc, material)->category == STR_volumematerial;
    if (has_surface)
        return ASSIGN_LAYER;
    return has_volume || is_volume ? ASSIGN_VOLUME : has_light ? ASSIGN_LIGHT : ASSIGN_LAYER;
}

static uint8_t products_of(const struct bind_look *look, elem_id material)
{
    const struct document *doc = look->doc;
    uint8_t products = 0;
    for (elem_id e = doc_element(doc, material)->first_child; e; e = doc_element(doc, e)->next) {
        const char *name = text_of(look, doc_element(doc, e)->name);
        for (unsigned i = 0; i < NUM_PRODUCTS; i++)
            if (strcmp(name, bind_product_names[i]) == 0 && is_given(doc, e))
                products |= (uint8_t)(1u << i);
    }
    return products;
}

/* A nodegraph with a material as output; 0: none. */
static elem_id graph_of_material(const struct document *doc, str_id name)
{
    elem_id graph = doc_top_level(doc, KIND_NODEGRAPH, name);
    return graph && doc_outputs(doc, graph, STR_material).first ? graph : 0;
}

/* Gives an assignment the material of this name; false: there is none. */
static bool set_material(struct bind_look *look, struct look_assign *assign, str_id name)
{
    const struct document *doc = look->doc;
    elem_id found = doc_top_level(doc, KIND_NODE, name);
    if (found && doc_attr_value(doc, found, STR_type) != STR_material)
        found = 0;
    else if (!found)
        found = graph_of_material(doc, name);
    if (!found)
        return false;
    assign->target = found;
    assign->kind = kind_of_material(look, found);
    assign->products = products_of(look, found);
    return true;
}

/* Reports a name that several materials of the stage have, with their places; false: none have. */
static bool report_namesakes(struct bind_look *look, const char *name, struct diag_place place)
{
    enum { MAX_SHOWN = 4 };
    const struct scene *scene = look->scene;
    const struct scene_material *material =
        scene ? scene_namesakes(scene, (struct text_word){name, strlen(name)}) : NULL;
    if (!material || material->num < 2)
        return false;
    diag_add(look->diags, DIAG_ID_ambiguous_material, place, name, (unsigned)material->num,
             material->name);
    for (unsigned i = 0; material && i < MAX_SHOWN; i++) {
        const struct usda_prim *at = &scene->layer.prims.items[material->prim];
        struct diag_place here = {scene->layer.file, at->line, at->column, 0};
        diag_add(look->diags, DIAG_ID_defined_here, here, material->name);
        material = scene_next_namesake(scene, material);
    }
    return true;
}

static bool find_material(struct bind_look *look, struct look_assign *assign)
{
    const struct document *doc = look->doc;
    str_id name = doc_attr_value(doc, assign->element, STR_material);
    bool found = !name || set_material(look, assign, name);
    if (!found
        && !report_namesakes(look, str_text(doc->strings, name),
                             doc_attr_place(doc, assign->element, STR_material)))
        look_report_unknown(look, assign->element, STR_material, "material", KIND_NODE);
    return found;
}

static bool find_graph(struct bind_look *look, struct look_assign *assign)
{
    str_id name = doc_attr_value(look->doc, assign->element, STR_nodegraph);
    if (!name)
        return true;
    assign->target = doc_top_level(look->doc, KIND_NODEGRAPH, name);
    assign->kind = ASSIGN_GRAPH;
    if (!assign->target)
        look_report_unknown(look, assign->element, STR_nodegraph, "nodegraph", KIND_NODEGRAPH);
    return assign->target;
}

/* A material that makes no layer has no slot but the first. */
static void move_beside(struct bind_look *look, const struct look_assign *assign,
                        struct slot_name *name, const char **text)
{
    if (strcmp(*text, SLOT_DEFAULT) != 0)
        diag_add(look->diags, DIAG_ID_beside_slot, look_slot_place(look, assign),
                 category_of(look, assign->target), SLOT_DEFAULT);
    *text = SLOT_DEFAULT;
    slot_parse(*text, strlen(*text), name);
}

bool look_has_both(struct bind_look *look, elem_id element, str_id one, str_id other)
{
    const struct document *doc = look->doc;
    bool has_both = doc_attr(doc, element, one) && doc_attr(doc, element, other);
    if (has_both)
        diag_add(look->diags, DIAG_ID_assign_both, doc_place(doc, element),
                 category_of(look, element), str_text(doc->strings, one),
                 str_text(doc->strings, other));
    return has_both;
}

/* The material or nodegraph; false after an error. */
static bool read_target(struct bind_look *look, struct look_assign *assign, struct slot_name *name,
                        const char **text)
{
    const struct document *doc = look->doc;
    elem_id element = assign->element;
    bool is_override = name->parts[SLOT_OVERRIDE].len,
         has_material = doc_attr(doc, element, STR_material),
         has_graph = doc_attr(doc, element, STR_nodegraph);
    assign->kind = ASSIGN_REMOVAL;
    if (look_has_both(look, element, STR_material, STR_nodegraph))
        return false;
    if (has_graph && !is_override) {
        diag_add(look->diags, DIAG_ID_override_needed, doc_attr_place(doc, element, STR_nodegraph),
                 *text, *text);
        return false;
    }
    if (!has_material && !has_graph)
        diag_add(look->diags, DIAG_ID_assign_nothing, doc_place(doc, element), *text);
    if (!(has_graph ? find_graph(look, assign) : find_material(look, assign)))
        return false;
    if (is_override && assign->target && !has_graph)
        assign->kind = ASSIGN_LAYER;
    if (assign->kind == ASSIGN_VOLUME || assign->kind == ASSIGN_LIGHT)
        move_beside(look, assign, name, text);
    return true;
}

/* ---- Places ---- */

bool look_check_place(struct bind_look *look, elem_id element)
{
    const struct document *doc = look->doc;
    if (look_has_both(look, element, STR_geom, STR_collection))
        return false;
    if (!doc_attr_value(doc, element, STR_geom) && !doc_attr_value(doc, element, STR_collection))
        diag_add(look->diags, DIAG_ID_assign_nowhere, doc_place(doc, element),
                 category_of(look, element));
    return true;
}

bool look_read_place(struct bind_look *look, struct look_assign *assign)
{
    const struct document *doc = look->doc;
    elem_id element = assign->element;
    str_id geom = doc_attr_value(doc, element, STR_geom),
           collection = doc_attr_value(doc, element, STR_collection);
    if (geom)
        look_read_geometry(
            look, element, STR_geom,
            (struct look_matcher){.owner = look->assigns.len, .kind = MATCHER_ASSIGN});
    if (collection)
        assign->collection = look_read_collection(look, collection, element, STR_collection);
    return !collection || assign->collection;
}

static void read_exclusive(struct bind_look *look, struct look_assign *assign, bool is_override)
{
    const struct attribute *attr = doc_attr(look->doc, assign->element, STR_exclusive);
    if (!attr || attr->value != STR_false)
        return;
    assign->is_shared = assign->target && !is_override;
    if (!assign->is_shared)
        diag_add(look->diags, DIAG_ID_useless_exclusive,
                 doc_attr_place(look->doc, assign->element, STR_exclusive),
                 is_override ? "an override" : "a removal");
}

void look_read_assign(struct bind_look *look, elem_id element, uint32_t ordinal)
{
    const struct document *doc = look->doc;
    struct look_assign assign = {.element = element,
                                 .look = doc_element(doc, element)->parent,
                                 .ordinal = ordinal,
                                 .first_variant = look->variants.len};
    struct slot_name name;
    const char *text;
    bool good = read_name(look, element, &name, &text);
    good = good && read_target(look, &assign, &name, &text);
    if (!good)
        return;
    read_exclusive(look, &assign, name.parts[SLOT_OVERRIDE].len);
    for (elem_id e = doc_element(doc, element)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_VARIANTASSIGN)
            look_read_variant(look, e);
    assign.num_variants = look->variants.len - assign.first_variant;
    /* last, because the matcher names the assignment */
    if (!look_check_place(look, element) || !look_read_place(look, &assign))
        return;
    assign.name = look_intern_name(look, &name, text, strlen(text));
    vec_push(look->arena, &look->assigns, assign);
}

/* ---- Bindings of the scene ---- */

/* Gives an assignment the material, or for an override the nodegraph, of this name. */
static bool set_bound(struct bind_look *look, struct look_assign *assign, const char *text,
                      bool is_override)
{
    str_id name = str_find(look->doc->strings, text, strlen(text));
    if (name && set_material(look, assign, name))
        return true;
    elem_id graph = name && is_override ? doc_top_level(look->doc, KIND_NODEGRAPH, name) : 0;
    if (!graph)
        return false;
    assign->target = graph;
    assign->kind = ASSIGN_GRAPH;
    return true;
}

/* The materials of a scene are those of the document, by the names of their prims, or its own. */
static bool find_bound(struct bind_look *look, struct look_assign *assign,
                       const struct scene_binding *binding, bool is_override)
{
    const char *material = binding->material;
    if (!*material || set_bound(look, assign, material, is_override)
        || (binding->leaf && set_bound(look, assign, binding->leaf, is_override)))
        return true;
    if (report_namesakes(look, material, binding->place))
        return false;
    struct diag_guess guess;
    const char *near = "";
    if (diag_guess_begin(&guess, look->diags, material)) {
        look_guess(look, &guess, KIND_NODE);
        near = diag_guess_text(&guess);
    }
    if (binding->place.file) /* of a stage, whose other parts count, as in USD */
        diag_add(look->diags, DIAG_ID_usda_binding, binding->place, material, near);
    else
        diag_add(look->diags, DIAG_ID_unknown_assigned, binding->place, "material", material, near);
    return false;
}

/* A new matcher without primitives: 1 + its number. match_prim follows before the next one. */
static uint32_t add_matcher(struct bind_look *look, uint32_t owner, enum matcher_kind kind)
{
    vec_push(look->arena, &look->matchers,
             (struct look_matcher){
                 .owner = owner, .kind = (uint8_t)kind, .first_prim = look->matched.len});
    return look->matchers.len;
}

/* The last matcher matches at the path of a primitive. */
static void match_prim(struct bind_look *look, prim_id prim)
{
    struct text *path = &look->written;
    path->len = 0;
    scene_path(look->scene, prim, path);
    pattern_add_path(&look->patterns, path->data, path->len, look->matchers.len - 1);
    vec_push(look->arena, &look->matched, prim);
    vec_last(&look->matchers).num_prims++;
}

void look_match_prim(struct bind_look *look, enum matcher_kind kind, prim_id prim)
{
    add_matcher(look, look->assigns.len, kind);
    match_prim(look, prim);
}

/*
 * A matcher of the members of a collection that are excluded, or of those that are not: its number.
 * Members that were removed from the scene match nothing.
 */
static uint32_t match_members(struct bind_look *look, const struct scene_binding *binding,
                              bool is_excluded)
{
    const struct scene_member *members = &look->scene->members.items[binding->first_member];
    uint32_t added = add_matcher(look, 0, MATCHER_MEMBER);
    for (uint32_t i = 0; i < binding->num_members; i++)
        if (members[i].is_excluded == is_excluded && scene_has(look->scene, members[i].prim))
            match_prim(look, members[i].prim);
    return added - 1;
}

/* The members of the collection that a binding of the scene uses: their number from 1. */
static uint32_t find_members(struct bind_look *look, const struct scene_binding *binding)
{
    uint32_t hash = hash_pair(binding->first_member, binding->num_members), at = hash, found;
    while ((found = table_next(&look->member_table, hash, &at)))
        if (look->members.items[found - 1].first_member == binding->first_member
            && look->members.items[found - 1].num_members == binding->num_members)
            return found;
    struct look_members added = {.first_member = binding->first_member,
                                 .num_members = binding->num_members};
    added.include = match_members(look, binding, false);
    added.exclude = match_members(look, binding, true);
    vec_push(look->arena, &look->members, added);
    table_add(&look->member_table, look->arena, hash, look->members.len);
    return look->members.len;
}

void look_read_binding(struct bind_look *look, uint32_t number)
{
    const struct scene_binding *binding = &look->scene->bindings.items[number];
    struct look_assign assign = {.binding = number + 1, .kind = ASSIGN_REMOVAL};
    struct slot_name name;
    const char *text = binding->name;
    slot_parse(text, strlen(text), &name); /* the reader of the scene has checked it */
    if (!find_bound(look, &assign, binding, name.parts[SLOT_OVERRIDE].len != 0))
        return;
    if (name.parts[SLOT_OVERRIDE].len && assign.target && assign.kind != ASSIGN_GRAPH)
        assign.kind = ASSIGN_LAYER;
    if (assign.kind == ASSIGN_VOLUME || assign.kind == ASSIGN_LIGHT)
        move_beside(look, &assign, &name, &text);
    if (binding->is_collection)
        assign.members = find_members(look, binding);
    look_match_prim(look, assign.members ? MATCHER_BOUND : MATCHER_ASSIGN, binding->prim);
    assign.name = look_intern_name(look, &name, text, strlen(text));
    vec_push(look->arena, &look->assigns, assign);
}

void look_read_variant(struct bind_look *look, elem_id element)
{
    const struct document *doc = look->doc;
    str_id set_name = doc_attr_value(doc, element, STR_variantset),
           name = doc_attr_value(doc, element, STR_variant);
    elem_id set = doc_top_level(doc, KIND_VARIANTSET, set_name);
    if (!set) {
        look_report_unknown(look, element, STR_variantset, "variantset", KIND_VARIANTSET);
        return;
    }
    elem_id variant = doc_child_of_kind(doc_layer(doc, set), set, KIND_VARIANT, name);
    if (!variant)
        look_report_unknown(look, element, STR_variant, "variant", KIND_VARIANT);
    else
        vec_push(look->arena, &look->variants, (struct look_variant){set, variant});
}
