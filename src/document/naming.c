// SPDX-License-Identifier: Apache-2.0
/* Attributes that name elements (references.def), and which elements these are. */
#include "document/document.h"

#include <assert.h>

#define IN(KIND) ((uint64_t)1 << KIND_##KIND)
#define ANYWHERE UINT64_MAX
#define SAME UINT64_MAX

const struct doc_naming doc_namings[DOC_NUM_NAMINGS] = {
#define REFERENCE(attribute, users, targets, place, checked) \
    {STR_##attribute, NAME_##place, users, targets, checked},
#include "document/references.def"
#undef REFERENCE
};

/* A row of the table plus 1; 0: the attribute names no element. */
static const uint8_t row_of_word[STR_NUM_WORDS] = {
#define REFERENCE(attribute, users, targets, place, checked) \
    [STR_##attribute] = DOC_NAMING_##attribute + 1,
#include "document/references.def"
#undef REFERENCE
};

/* The outputs of nodes and graphs are known by these. */
static bool has_source(const struct document *doc, elem_id user)
{
    return doc_attr_value(doc, user, STR_nodename) || doc_attr_value(doc, user, STR_nodegraph);
}

const struct doc_naming *doc_naming(const struct document *doc, elem_id user, str_id attr)
{
    uint8_t row = attr < STR_NUM_WORDS ? row_of_word[attr] : 0;
    const struct doc_naming *naming = row ? &doc_namings[row - 1] : NULL;
    if (!naming || !(naming->users >> doc_element(doc, user)->kind & 1))
        return NULL;
    bool is_standard = attr == STR_type && doc_type_of(doc_attr_value(doc, user, attr));
    return is_standard || (attr == STR_output && has_source(doc, user)) ? NULL : naming;
}

elem_id doc_port_scope(const struct document *doc, elem_id port)
{
    const struct element *e = doc_element(doc, port);
    elem_id beyond = e->parent ? doc_element(doc, e->parent)->parent : 0;
    return e->kind == KIND_OUTPUT || !beyond ? e->parent : beyond;
}

bool doc_is_local_name(enum doc_name_place place)
{
    return place == NAME_IN_SCOPE || place == NAME_IN_INTERFACE || place == NAME_BESIDE
           || place == NAME_IN_DEFINITION;
}

elem_id doc_naming_scope(const struct document *doc, elem_id user, enum doc_name_place place)
{
    bool is_port = place == NAME_IN_SCOPE || place == NAME_IN_INTERFACE;
    elem_id scope = is_port ? doc_port_scope(doc, user) : doc_element(doc, user)->parent;
    return doc_is_local_name(place) ? scope : 0;
}

/* The first element of the target's name and kind in a scope, or else at the root. */
static bool is_first(const struct document *doc, elem_id scope, elem_id target)
{
    const struct element *e = doc_element(doc, target);
    elem_id first = doc_child_of_kind(doc, scope, (enum element_kind)e->kind, e->name);
    return first ? first == target : e->parent == doc->root;
}

bool doc_can_name(const struct document *doc, elem_id user, str_id attr, elem_id element)
{
    const struct doc_naming *naming =
        doc_has_element(doc, user) ? doc_naming(doc, user, attr) : NULL;
    const struct element *e = doc_element(doc, element);
    elem_id scope = doc_port_scope(doc, user), beside = doc_element(doc, user)->parent;
    if (!naming || !doc_attr_value(doc, user, attr) || !(naming->targets >> e->kind & 1))
        return false;
    switch (naming->place) {
    case NAME_AT_ROOT:
    case NAME_IN_SOURCE: return e->parent == doc->root;
    case NAME_IN_SCOPE:
    case NAME_IN_INTERFACE: return scope == e->parent;
    case NAME_BESIDE:
    case NAME_IN_DEFINITION: return beside == e->parent;
    case NAME_IN_SCOPE_OR_AT_ROOT: return is_first(doc, scope, element);
    case NAME_BESIDE_OR_AT_ROOT:
        return e->kind == doc_element(doc, user)->kind && is_first(doc, beside, element);
    case NAME_IN_UNITS:
        return !doc_attr(doc, user, STR_unittype)
               || doc_attr_value(doc, user, STR_unittype)
                      == doc_attr_value(doc, e->parent, STR_unittype);
    case NAME_IN_VARIANTSET:
        return doc_attr_value(doc, user, STR_variantset) == doc_element(doc, e->parent)->name;
    }
    return false;
}

const char *doc_next_name(const char **text, size_t *len)
{
    const char *name = *text + strspn(*text, ", ");
    *len = strcspn(name, ", ");
    *text = name + *len;
    return name;
}

bool doc_has_name(const struct document *doc, elem_id user, str_id attr, str_id name)
{
    const char *text = str_text(doc->strings, doc_attr_value(doc, user, attr)), *part;
    size_t len;
    while (part = doc_next_name(&text, &len), len)
        if (len == str_len(doc->strings, name)
            && memcmp(part, str_text(doc->strings, name), len) == 0)
            return true;
    return false;
}

static elem_id at_root(const struct document *doc, uint64_t kinds, str_id name)
{
    elem_id found = 0;
    for (unsigned kind = 0; kind < NUM_ELEMENT_KINDS && !found; kind++)
        if (kinds >> kind & 1)
            found = doc_top_level(doc, (enum element_kind)kind, name);
    return found;
}

bool doc_names_element(const struct document *doc, elem_id user, const struct doc_naming *naming,
                       str_id name)
{
    elem_id parent = doc_element(doc, user)->parent, found;
    if (naming->place == NAME_IN_VARIANTSET)
        parent = doc_top_level(doc, KIND_VARIANTSET, doc_attr_value(doc, user, STR_variantset));
    else if (naming->place != NAME_BESIDE)
        return at_root(doc, naming->targets, name);
    assert(naming->place == NAME_BESIDE || naming->place == NAME_IN_VARIANTSET);
    found = parent ? doc_child(doc, parent, name) : 0;
    return found && naming->targets >> doc_element(doc, found)->kind & 1;
}
