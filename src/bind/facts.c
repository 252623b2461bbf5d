// SPDX-License-Identifier: Apache-2.0
/*
 * Finds what a document says of primitives beside their layers: geometric properties and tokens of
 * <geominfo>, properties and visibility of a look. They stand at paths as assignments of materials
 * do, so a fact is an assignment whose name is that of the fact, and the strongest one counts.
 */
#include "bind/bind.h"

const char *const bind_fact_words[NUM_FACTS] = {
    [FACT_GEOMPROP] = "geomprop",
    [FACT_TOKEN] = "token",
    [FACT_PROPERTY] = "property",
    [FACT_VISIBILITY] = "visibility",
};

static const char *text_of_id(const struct document *doc, str_id id)
{
    return str_text(doc->strings, id);
}

static const char *value_of(const struct document *doc, elem_id element, str_id attr)
{
    return text_of_id(doc, doc_attr_value(doc, element, attr));
}

enum bind_fact_kind bind_fact_kind(const struct document *doc, elem_id fact)
{
    switch (doc_element(doc, fact)->kind) {
    case KIND_TOKEN:
    case KIND_TOKENDEFAULT: return FACT_TOKEN;
    case KIND_GEOMPROP:
    case KIND_GEOMATTR: return FACT_GEOMPROP;
    case KIND_VISIBILITY: return FACT_VISIBILITY;
    default: return FACT_PROPERTY;
    }
}

const char *bind_fact_name(const struct document *doc, elem_id fact)
{
    enum element_kind kind = (enum element_kind)doc_element(doc, fact)->kind;
    return kind == KIND_VISIBILITY       ? value_of(doc, fact, STR_vistype)
           : kind == KIND_PROPERTYASSIGN ? value_of(doc, fact, STR_property)
                                         : doc_name(doc, fact);
}

/*
 * The renderer that a property is for; the viewers of a visibility, as paths or as a collection;
 * "" for all.
 */
static const char *target_of(struct bind_look *look, elem_id fact)
{
    const struct document *doc = look->doc;
    if (doc_element(doc, fact)->kind != KIND_VISIBILITY)
        return value_of(doc, fact, STR_target);
    if (doc_attr_value(doc, fact, STR_viewergeom))
        return doc_prefixed_geometry(doc, fact, STR_viewergeom, look->arena);
    const char *collection = value_of(doc, fact, STR_viewercollection);
    struct text target;
    text_init(&target, look->arena);
    if (*collection)
        text_fmt(&target, "collection:%s", collection);
    return text_cstr(&target);
}

/* Facts of one kind, name and target replace each other. */
static uint32_t key_of(struct bind_look *look, elem_id fact, const char *target)
{
    struct text key;
    struct slot_name none = {0};
    text_init(&key, look->arena);
    text_fmt(&key, "%s:%s:%s", bind_fact_words[bind_fact_kind(look->doc, fact)],
             bind_fact_name(look->doc, fact), target);
    return look_intern_name(look, &none, text_cstr(&key), key.len);
}

/* Numbers as a value of a document. */
static const char *write_numbers(struct bind_look *look, const float *numbers, unsigned num)
{
    struct text out;
    text_init(&out, look->arena);
    for (unsigned i = 0; i < num; i++) {
        text_str(&out, i ? ", " : "");
        text_float(&out, numbers[i]);
    }
    return text_cstr(&out);
}

/* The numbers of a <geomprop> of a type; false: its value has a fault. */
static bool read_numbers(const struct bind_look *look, elem_id fact, doc_type type, float *out)
{
    const char *text = value_of(look->doc, fact, STR_value);
    struct ir_value value;
    if (!doc_parse_value(type, text, strlen(text), NULL, &value))
        return false;
    for (unsigned i = 0; i < ir_type_info(value.type)->components; i++)
        out[i] = value.w[i].f;
    return true;
}

/*
 * The colour of a <geomprop> in the space in which geometry has its own colours; NULL: it has this
 * space.
 */
static const char *converted_color(struct bind_look *look, elem_id fact, doc_type type)
{
    const struct document *doc = look->doc;
    const char *space =
        library_canonical_space(text_of_id(doc, doc_inherited_attr(doc, fact, STR_colorspace)));
    float numbers[4];
    if (!*space || strcmp(space, "none") == 0 || strcmp(space, library_color_hub) == 0
        || !read_numbers(look, fact, type, numbers))
        return NULL;
    if (library_convert_color(look->lib, space, numbers, look->arena))
        return write_numbers(look, numbers, doc_type_components(type));
    elem_id owner = doc_attr_owner(doc, fact, STR_colorspace);
    library_report_space(look->lib, space, doc_attr_place(doc, owner, STR_colorspace), look->diags);
    return NULL;
}

/*
 * The value of a <geomprop> in the unit that its <geompropdef> names, which is that of the
 * geometry's own values; NULL: it has this unit, or it is no measure.
 */
static const char *converted_measure(struct bind_look *look, elem_id fact, doc_type type)
{
    const struct document *doc = look->doc;
    const struct geomprop *def = library_geomprop(look->lib, doc_element(doc, fact)->name);
    str_id unit = doc_attr_value(doc, fact, STR_unit),
           usual = def ? doc_attr_value(doc, def->element, STR_unit) : 0;
    float from, to, numbers[16];
    if (!unit || unit == usual || !doc_type_is_measure(type))
        return NULL;
    if (!usual) {
        diag_add(look->diags, DIAG_ID_unit_lost, doc_attr_place(doc, fact, STR_unit),
                 text_of_id(doc, doc_element(doc, fact)->name), text_of_id(doc, unit));
        return NULL;
    }
    str_id kind = library_unit_type_of(look->lib, usual);
    if (!library_unit_scale(look->lib, kind, unit, &from)
        || !library_unit_scale(look->lib, kind, usual, &to)) {
        library_report_unit(look->lib, kind, unit, doc_attr_place(doc, fact, STR_unit),
                            look->diags);
        return NULL;
    }
    if (!read_numbers(look, fact, type, numbers))
        return NULL;
    for (unsigned i = 0; i < doc_type_components(type); i++)
        numbers[i] *= from / to;
    return write_numbers(look, numbers, doc_type_components(type));
}

/*
 * The value of a fact with geomprefixes, of a geometric property as geometry would have it, and of
 * a visibility with its default; NULL: as in the document.
 */
static const char *converted(struct bind_look *look, elem_id fact)
{
    doc_type type = doc_type_of(doc_attr_value(look->doc, fact, STR_type));
    if (bind_fact_kind(look->doc, fact) == FACT_VISIBILITY)
        return doc_attr_value(look->doc, fact, STR_visible) == STR_false ? "false" : "true";
    if (doc_is_geometry(look->doc, fact, STR_value))
        return doc_prefixed_geometry(look->doc, fact, STR_value, look->arena);
    if (bind_fact_kind(look->doc, fact) != FACT_GEOMPROP)
        return NULL;
    return doc_type_is_color(type) ? converted_color(look, fact, type)
                                   : converted_measure(look, fact, type);
}

/* Adds a fact for the matcher or the collection of `assign`. */
static void add_assign(struct bind_look *look, struct look_assign assign, elem_id fact)
{
    assign.fact_target = target_of(look, fact);
    assign.name = key_of(look, fact, assign.fact_target);
    assign.value = converted(look, fact);
    vec_push(look->arena, &look->assigns, assign);
}

/* A <tokendefault> stands at "/", and is weaker than all that stands there, too. */
static void add_default(struct bind_look *look, elem_id fact)
{
    look_match_prim(look, MATCHER_ASSIGN, 0);
    add_assign(look, (struct look_assign){.element = fact, .target = fact, .kind = ASSIGN_LAYER},
               fact);
}

/* Adds a fact that stands where `placed` says. */
static void add_fact(struct bind_look *look, elem_id placed, elem_id fact)
{
    struct look_assign assign = {.element = placed,
                                 .look = doc_element(look->doc, placed)->parent,
                                 .target = fact,
                                 .kind = ASSIGN_LAYER};
    if (look_read_place(look, &assign))
        add_assign(look, assign, fact);
}

static void add_children(struct bind_look *look, elem_id placed, elem_id parent)
{
    const struct document *doc = look->doc;
    for (elem_id e = look_check_place(look, placed) ? doc_element(doc, parent)->first_child : 0; e;
         e = doc_element(doc, e)->next)
        add_fact(look, placed, e);
}

static void add_visibility(struct bind_look *look, elem_id element)
{
    doc_check_attribute(look->doc, element, STR_visible, look->diags);
    bool is_clear = !look_has_both(look, element, STR_viewergeom, STR_viewercollection);
    if (look_check_place(look, element) && is_clear)
        add_fact(look, element, element);
}

static void add_of_look(struct bind_look *look, elem_id element)
{
    const struct document *doc = look->doc;
    for (elem_id e = doc_element(doc, element)->first_child; e; e = doc_element(doc, e)->next) {
        enum element_kind kind = (enum element_kind)doc_element(doc, e)->kind;
        if (kind == KIND_VISIBILITY)
            add_visibility(look, e);
        if (kind == KIND_PROPERTYASSIGN && look_check_place(look, e))
            add_fact(look, e, e);
        if (kind != KIND_PROPERTYSETASSIGN)
            continue;
        elem_id set = doc_top_level(doc, KIND_PROPERTYSET, doc_attr_value(doc, e, STR_propertyset));
        if (set)
            add_children(look, e, set);
        else
            look_report_unknown(look, e, STR_propertyset, "propertyset", KIND_PROPERTYSET);
    }
}

/* The facts that stand beside all looks. */
static void add_global(struct bind_look *look)
{
    const struct document *doc = look->doc;
    for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_TOKENDEFAULT)
            add_default(look, e);
    for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_GEOMINFO)
            add_children(look, e, e);
}

void look_check_facts(const struct library *lib, elem_id element, const struct scene *scene,
                      struct arena *arena, struct diag_list *diags)
{
    struct bind_look look;
    look_begin(&look, lib, element, scene, arena, diags);
    if (!element)
        add_global(&look);
    look_each_ancestor(&look, add_of_look);
    look_finish(&look);
}

static void read_facts(struct bind_look *look, const struct library *lib, elem_id element,
                       const struct scene *scene, struct arena *arena, struct diag_list *diags)
{
    look_begin(look, lib, element, scene, arena, diags);
    add_global(look);
    look_each_ancestor(look, add_of_look);
    look_close_collections(look);
}

/*
 * Reports, once, that two <geominfo>s give one geometry a value: `hidden` is of the same name as
 * the one before it, which is stronger.
 */
static void check_twice(struct bindings *b, const struct stand *hidden, bool *is_told)
{
    struct bind_look *look = &b->look;
    const struct look_assign *weak = &look->assigns.items[hidden->assign],
                             *strong = &look->assigns.items[hidden[-1].assign];
    bool are_infos = doc_element(look->doc, weak->element)->kind == KIND_GEOMINFO
                     && doc_element(look->doc, strong->element)->kind == KIND_GEOMINFO;
    if (!are_infos || hidden->level != hidden[-1].level || is_told[hidden->assign])
        return;
    is_told[hidden->assign] = true;
    diag_add(look->diags, DIAG_ID_geominfo_twice, doc_place(look->doc, strong->target),
             bind_fact_words[bind_fact_kind(look->doc, strong->target)],
             bind_fact_name(look->doc, strong->target));
    diag_add(look->diags, DIAG_ID_defined_here, doc_place(look->doc, weak->target),
             bind_fact_name(look->doc, weak->target));
}

/* The strongest of each name. */
static void list_facts(struct bindings *b, uint32_t state, struct stands *stands, bool *is_told)
{
    struct bind_state *s = &b->states.items[state];
    s->first_item = b->items.len;
    bind_stands(b, s, stands);
    for (uint32_t i = 0; i < stands->len; i++) {
        const struct stand *stand = &stands->items[i];
        if (i && stand->name == stand[-1].name)
            check_twice(b, stand, is_told);
        else
            vec_push(b->arena, &b->items,
                     (struct bind_item){stand->assign, stand->level, ITEM_LAYER, 0});
    }
    s->num_items = b->items.len - s->first_item;
}

void bind_facts(struct bindings *b, const struct library *lib, elem_id look,
                const struct scene *scene, const struct bindings *before, struct arena *arena,
                struct arena *scratch, struct diag_list *diags)
{
    struct stands stands = {.scratch = scratch};
    *b = (struct bindings){.arena = arena, .scene = scene};
    read_facts(&b->look, lib, look, scene, arena, diags);
    if (!b->look.assigns.len)
        return;
    bind_find_states(b, before, scratch);
    bool *is_told = ARENA_ARRAY(scratch, bool, b->look.assigns.len);
    for (uint32_t i = 0; i < b->states.len; i++)
        list_facts(b, i, &stands, is_told);
}
