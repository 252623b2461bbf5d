// SPDX-License-Identifier: Apache-2.0
/*
 * Checks of single elements: place, name, attributes, type, value. validate_links.c checks
 * references.
 */
#include "document/validate_elements.h"

#include <assert.h>

#define IN(KIND) ((uint64_t)1 << KIND_##KIND)
#define IN_INTERFACE (IN(NODEDEF) | IN(NODEGRAPH) | IN(NODE))

/*
 * The rules of MaterialX 1.39 for each kind of element: valid parents, a required name, required
 * attributes.
 */
static const struct {
    uint64_t parents;
    bool named;
    str_id required[3];
} rules[NUM_ELEMENT_KINDS] = {
    [KIND_NODE] = {IN(MATERIALX) | IN(NODEGRAPH), true, {STR_type}},
    [KIND_MATERIALX] = {0, false, {STR_version}},
    [KIND_NODEDEF] = {IN(MATERIALX), true, {STR_node}},
    [KIND_NODEGRAPH] = {IN(MATERIALX) | IN(NODEGRAPH), true, {0}},
    [KIND_INPUT] = {IN(MATERIALX) | IN_INTERFACE | IN(IMPLEMENTATION) | IN(VARIANT),
                    true,
                    {STR_type}},
    [KIND_OUTPUT] = {IN(MATERIALX) | IN_INTERFACE | IN(IMPLEMENTATION), true, {0}},
    [KIND_TOKEN] = {IN(MATERIALX) | IN_INTERFACE | IN(VARIANT) | IN(GEOMINFO), true, {STR_type}},
    [KIND_TOKENDEFAULT] = {IN(MATERIALX), true, {STR_type}},
    [KIND_IMPLEMENTATION] = {IN(MATERIALX), true, {0}},
    [KIND_TYPEDEF] = {IN(MATERIALX), true, {0}},
    [KIND_MEMBER] = {IN(TYPEDEF), true, {STR_type}},
    [KIND_GEOMPROPDEF] = {IN(MATERIALX), true, {STR_type}},
    [KIND_GEOMINFO] = {IN(MATERIALX), true, {0}},
    [KIND_GEOMPROP] = {IN(GEOMINFO), true, {STR_type}},
    [KIND_GEOMATTR] = {IN(GEOMINFO), true, {STR_type}},
    [KIND_COLLECTION] = {IN(MATERIALX), true, {0}},
    [KIND_LOOK] = {IN(MATERIALX), true, {0}},
    [KIND_LOOKGROUP] = {IN(MATERIALX), true, {STR_looks}},
    [KIND_MATERIALASSIGN] = {IN(LOOK), false, {0}},
    [KIND_PROPERTY] = {IN(PROPERTYSET), true, {STR_type}},
    [KIND_PROPERTYSET] = {IN(MATERIALX), true, {0}},
    [KIND_PROPERTYASSIGN] = {IN(LOOK), false, {STR_property, STR_type}},
    [KIND_PROPERTYSETASSIGN] = {IN(LOOK), false, {STR_propertyset}},
    [KIND_VISIBILITY] = {IN(LOOK), false, {0}},
    [KIND_VARIANT] = {IN(VARIANTSET), true, {0}},
    [KIND_VARIANTSET] = {IN(MATERIALX), true, {0}},
    [KIND_VARIANTASSIGN] = {IN(LOOK) | IN(MATERIALASSIGN), false, {STR_variantset, STR_variant}},
    [KIND_UNITTYPEDEF] = {IN(MATERIALX), true, {0}},
    [KIND_UNITDEF] = {IN(MATERIALX), true, {STR_unittype}},
    [KIND_UNIT] = {IN(UNITDEF), true, {STR_scale}},
    [KIND_TARGETDEF] = {IN(MATERIALX), true, {0}},
    [KIND_ATTRIBUTEDEF] = {IN(MATERIALX), true, {STR_attrname, STR_type}},
    [KIND_BACKDROP] = {IN(MATERIALX) | IN(NODEGRAPH), true, {0}},
};

/* Without one of these attributes an element is empty, or 0. The first is that which most have. */
static const struct {
    enum element_kind kind;
    str_id either[2];
} purposes[] = {
    {KIND_TOKENDEFAULT, {STR_value}},   {KIND_MEMBER, {STR_value}},
    {KIND_GEOMPROP, {STR_value}},       {KIND_PROPERTY, {STR_value}},
    {KIND_PROPERTYASSIGN, {STR_value}}, {KIND_COLLECTION, {STR_includegeom, STR_includecollection}},
};

static const char *text_of(const struct validation *v, str_id id)
{
    return str_text(v->doc->strings, id);
}

/* The reader turns an unknown element into a node. */
static bool is_foreign(const struct validation *v, elem_id element)
{
    const struct element *e = doc_element(v->doc, element);
    return e->kind == KIND_NODE && e->parent && doc_element(v->doc, e->parent)->kind == KIND_NODE;
}

/* Elements that later versions dropped, and that the document's own version does not upgrade. */
static const struct outdated {
    const char *name, *version, *advice;
} outdated_elements[] = {
#define OF_MATERIALS ", but the document has a later version; version=\"1.37\" would upgrade it"
    {"shaderref", "1.37", OF_MATERIALS},
    {"bindinput", "1.37", OF_MATERIALS},
    {"bindparam", "1.37", OF_MATERIALS},
    {"bindtoken", "1.37", OF_MATERIALS},
    {"materialinherit", "1.37", OF_MATERIALS},
    {"material", "1.37", OF_MATERIALS},
#undef OF_MATERIALS
    {"collectionadd", "1.35", "; write includegeom and includecollection on the <collection>"},
    {"collectionremove", "1.35", "; write excludegeom on the <collection>"},
};

/* NULL: the element is none of them. */
static const struct outdated *outdated(const struct document *doc, elem_id element)
{
    const struct element *e = doc_element(doc, element);
    const char *category = e->kind == KIND_NODE ? str_text(doc->strings, e->category) : "";
    for (size_t i = 0; i < sizeof outdated_elements / sizeof *outdated_elements; i++)
        if (strcmp(outdated_elements[i].name, category) == 0)
            return &outdated_elements[i];
    return NULL;
}

static bool has_outdated(const struct document *doc, elem_id element)
{
    for (elem_id e = doc_element(doc, element)->first_child; e; e = doc_element(doc, e)->next)
        if (outdated(doc, e))
            return true;
    return false;
}

/* A library may define a node <material>, which has a type and no <shaderref>. */
static bool may_be_node(const struct document *doc, elem_id element)
{
    return doc_attr(doc, element, STR_type) && !has_outdated(doc, element);
}

bool doc_is_outdated(const struct document *doc, elem_id element)
{
    return outdated(doc, element)
           && (doc_element(doc, element)->category != STR_material || !may_be_node(doc, element));
}

void doc_report_outdated(const struct document *doc, elem_id element, struct diag_list *diags)
{
    const struct outdated *old = outdated(doc, element);
    assert(old);
    diag_add(diags, DIAG_ID_outdated_element, doc_place(doc, element), old->name, old->version,
             old->advice);
}

/* Reports the first one of a document. */
static void check_age(struct validation *v, elem_id element)
{
    if (!v->has_age_note)
        doc_report_outdated(v->doc, element, v->diags);
    v->has_age_note = true;
}

/* false after reporting that the element is not allowed here. */
static bool check_place(struct validation *v, elem_id element)
{
    const struct element *e = doc_element(v->doc, element);
    const struct element *parent = doc_element(v->doc, e->parent);
    assert(parent->kind < NUM_ELEMENT_KINDS && parent->kind < 64);
    if (doc_is_outdated(v->doc, element)) {
        check_age(v, element);
        return false;
    }
    if (rules[e->kind].parents >> parent->kind & 1)
        return true;
    diag_add(v->diags, is_foreign(v, element) ? DIAG_ID_foreign_element : DIAG_ID_misplaced_element,
             doc_place(v->doc, element), text_of(v, e->category), text_of(v, parent->category));
    return false;
}

static void check_name(struct validation *v, elem_id element)
{
    const struct element *e = doc_element(v->doc, element);
    if (!e->name && rules[e->kind].named)
        diag_add(v->diags, DIAG_ID_name_missing, doc_place(v->doc, element),
                 text_of(v, e->category));
    if (e->name && !doc_is_name(text_of(v, e->name)))
        diag_add(v->diags, DIAG_ID_bad_name, doc_name_place(v->doc, element), text_of(v, e->name));
}

static void check_required(struct validation *v, elem_id element)
{
    const struct element *e = doc_element(v->doc, element);
    /* nodedef-nodename */
    bool is_node_told = e->kind == KIND_NODEDEF && doc_attr(v->doc, element, STR_nodename);
    for (size_t i = 0; i < 3 && rules[e->kind].required[i] && !is_node_told; i++)
        if (!doc_attr(v->doc, element, rules[e->kind].required[i]))
            diag_add(v->diags, DIAG_ID_missing_attribute, doc_place(v->doc, element),
                     text_of(v, e->category), text_of(v, rules[e->kind].required[i]));
    if (e->kind == KIND_IMPLEMENTATION && !doc_attr(v->doc, element, STR_nodedef)
        && !doc_attr(v->doc, element, STR_nodegraph))
        diag_add(v->diags, DIAG_ID_missing_attribute, doc_place(v->doc, element),
                 text_of(v, e->category), "nodedef");
    for (size_t i = 0; i < sizeof purposes / sizeof *purposes; i++) {
        const str_id *either = purposes[i].either;
        if (e->kind == purposes[i].kind && !doc_attr(v->doc, element, either[0])
            && !doc_attr(v->doc, element, either[1]) && !has_outdated(v->doc, element))
            diag_add(v->diags, DIAG_ID_incomplete, doc_place(v->doc, element),
                     text_of(v, e->category), text_of(v, either[0]));
    }
    /* The outputs of an implementation have the types of the definition's outputs. */
    if (e->kind == KIND_OUTPUT && !doc_attr(v->doc, element, STR_type)
        && doc_element(v->doc, e->parent)->kind != KIND_IMPLEMENTATION)
        diag_add(v->diags, DIAG_ID_missing_attribute, doc_place(v->doc, element),
                 text_of(v, e->category), "type");
}

static const char *suggest_type(const struct document *doc, const char *type,
                                struct diag_list *diags)
{
    struct diag_guess guess;
    if (!diag_guess_begin(&guess, diags, type))
        return "";
    for (doc_type t = DOC_TYPE_NONE + 1; t < DOC_NUM_TYPES; t++)
        diag_guess_add(&guess, str_text(doc->strings, doc_type_name(t)));
    for (const struct document *layer = doc; layer; layer = layer->base)
        for (elem_id e = doc_element(layer, layer->root)->first_child; e;
             e = doc_element(layer, e)->next)
            if (doc_element(layer, e)->kind == KIND_TYPEDEF)
                diag_guess_add(&guess, str_text(doc->strings, doc_element(layer, e)->name));
    return diag_guess_text(&guess);
}

void doc_report_type(const struct document *doc, elem_id element, struct diag_list *diags)
{
    const char *type = str_text(doc->strings, doc_attr_value(doc, element, STR_type));
    if (!*type) {
        diag_add(diags, DIAG_ID_missing_attribute, doc_place(doc, element),
                 str_text(doc->strings, doc_element(doc, element)->category), "type");
        return;
    }
    diag_add(diags, DIAG_ID_unknown_type, doc_attr_place(doc, element, STR_type), type,
             suggest_type(doc, type, diags));
}

static bool has_value(str_id attr)
{
    return attr == STR_value || attr == STR_default || attr == STR_uimin || attr == STR_uimax
           || attr == STR_uisoftmin || attr == STR_uisoftmax || attr == STR_uistep;
}

/* interfacename-ignored */
static bool refers_to_itself(const struct document *doc, elem_id element)
{
    const struct element *e = doc_element(doc, element), *owner = doc_element(doc, e->parent);
    str_id name = doc_attr_value(doc, element, STR_interfacename);
    return name && e->kind == KIND_INPUT && owner->kind == KIND_NODEGRAPH
           && !doc_child_of_kind(doc, owner->parent, KIND_INPUT, name);
}

/*
 * True for a value that generation reads, and so may not be empty: a connection replaces it, and a
 * definition has none.
 */
static bool counts(const struct document *doc, elem_id element)
{
    elem_id parent = doc_element(doc, element)->parent;
    return doc_is_port(doc, element) && doc_element(doc, parent)->kind != KIND_NODEDEF
           && (!doc_is_connected(doc, element) || refers_to_itself(doc, element));
}

static void check_value(struct validation *v, elem_id element, doc_type type, str_id attr,
                        str_id value)
{
    size_t len = str_len(v->doc->strings, value);
    struct diag_place place = doc_attr_place(v->doc, element, attr);
    if (doc_type_is_float(type))
        doc_report_infinite(text_of(v, value), place, v->diags);
    if (!value && (attr != STR_value || !counts(v->doc, element)))
        return;
    if (attr == STR_value && doc_read_loosely(type, text_of(v, value), len, NULL)) {
        /* the definition of a node has a suggestion: library_report_loose */
        if (doc_element(v->doc, doc_element(v->doc, element)->parent)->kind != KIND_NODE)
            doc_report_loose(v->doc, element, type, "", v->diags);
    } else if (!doc_value_is_valid(type, text_of(v, value), len))
        doc_report_value(type, text_of(v, doc_type_name(type)), text_of(v, value), place, v->diags);
}

static void check_type_and_values(struct validation *v, elem_id element)
{
    const struct attribute *attrs = doc_attrs(v->doc, element);
    const struct element *e = doc_element(v->doc, element);
    str_id name = doc_attr_value(v->doc, element, STR_type);
    doc_type type = doc_type_of(name);
    if (name && !type && !doc_top_level(v->doc, KIND_TYPEDEF, name))
        doc_report_type(v->doc, element, v->diags);
    if (!type || e->kind == KIND_NODE)
        return;
    for (uint32_t i = 0; i < e->num_attrs; i++)
        if (has_value(attrs[i].name))
            check_value(v, element, type, attrs[i].name, attrs[i].value);
}

static void check_bindings(struct validation *v, elem_id element)
{
    const struct element *e = doc_element(v->doc, element);
    const struct attribute *attrs = doc_attrs(v->doc, element);
    int connections = 0;
    for (uint32_t i = 0; i < e->num_attrs; i++)
        connections += attrs[i].value
                       && (attrs[i].name == STR_nodename || attrs[i].name == STR_nodegraph
                           || attrs[i].name == STR_interfacename);
    if (connections > 1)
        diag_add(v->diags, DIAG_ID_several_connections, doc_place(v->doc, element),
                 text_of(v, e->name));
    else if (connections && doc_attr_value(v->doc, element, STR_value)
             && !refers_to_itself(v->doc, element))
        diag_add(v->diags, DIAG_ID_value_and_connection, doc_attr_place(v->doc, element, STR_value),
                 text_of(v, e->name));
}

static void check_has_output(struct validation *v, elem_id element)
{
    const struct element *e = doc_element(v->doc, element);
    for (elem_id child = e->first_child; child; child = doc_element(v->doc, child)->next)
        if (doc_element(v->doc, child)->kind == KIND_OUTPUT)
            return;
    /* it inherits outputs, too */
    bool inherits = doc_attr_value(v->doc, element, STR_inherit) != 0;
    if (!inherits)
        diag_add(v->diags, DIAG_ID_no_output, doc_place(v->doc, element), text_of(v, e->category),
                 text_of(v, e->name));
}

static void check_standing(struct validation *v, elem_id element)
{
    bool is_placed = check_place(v, element);
    if (is_placed)
        check_required(v, element);
    if (doc_is_port(v->doc, element))
        check_bindings(v, element);
}

void doc_check_children(const struct document *doc, elem_id parent, struct diag_list *diags)
{
    struct validation v = {.doc = doc, .diags = diags, .arena = diags->arena};
    for (elem_id e = doc_element(doc, parent)->first_child; e; e = doc_element(doc, e)->next)
        check_standing(&v, e);
}

static void check_element(struct validation *v, elem_id element)
{
    if (element != v->doc->root) /* the reader checks the version of the root */
        check_standing(v, element);
    check_name(v, element);
    check_type_and_values(v, element);
    /* the attributes of other elements have no effect */
    if (!is_foreign(v, element) && !doc_is_outdated(v->doc, element))
        validate_attributes(v, element);
    validate_geometry(v, element);
    if (doc_element(v->doc, element)->kind == KIND_NODEDEF)
        check_has_output(v, element);
}

void doc_validate(const struct document *doc, struct diag_list *diags)
{
    struct validation v = {.doc = doc, .diags = diags, .arena = diags->arena};
    for (elem_id e = doc->root; e; e = doc_next_in_tree(doc, doc->root, e))
        check_element(&v, e);
    validate_links(&v);
}
