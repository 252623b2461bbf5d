// SPDX-License-Identifier: Apache-2.0
/* Checks for attributes that MaterialX does not have, or not on this kind of element. */
#include "document/validate_elements.h"

#include <assert.h>

#define IN(KIND) ((uint64_t)1 << KIND_##KIND)
#define ANYWHERE UINT64_MAX
#define PORTS (IN(INPUT) | IN(OUTPUT))
#define VALUES \
    (IN(INPUT) | IN(TOKEN) | IN(TOKENDEFAULT) | IN(MEMBER) | IN(GEOMPROPDEF) | IN(GEOMPROP) \
     | IN(GEOMATTR) | IN(PROPERTY) | IN(PROPERTYASSIGN))
#define ON_GEOMETRY \
    (IN(MATERIALASSIGN) | IN(VISIBILITY) | IN(PROPERTYASSIGN) | IN(PROPERTYSETASSIGN))

static const uint64_t kinds_of_word[STR_NUM_WORDS] = {
#define ATTRIBUTE(name, kinds, type) [STR_##name] = kinds,
#include "document/attributes.def"
#undef ATTRIBUTE
};

static const uint8_t types[STR_NUM_WORDS] = {
#define ATTRIBUTE(name, kinds, type) [STR_##name] = DOC_TYPE_##type,
#include "document/attributes.def"
#undef ATTRIBUTE
};

static const char *text_of(const struct validation *v, str_id id)
{
    return str_text(v->doc->strings, id);
}

static void note_declared(struct validation *v)
{
    const struct strpool *strings = v->doc->strings;
    v->declared = ARENA_ARRAY(v->arena, uint8_t, strings->first + strings->num);
    for (const struct document *doc = v->doc; doc; doc = doc->base)
        for (elem_id e = doc->has_attributedefs ? doc_element(doc, doc->root)->first_child : 0; e;
             e = doc_element(doc, e)->next)
            if (doc_element(doc, e)->kind == KIND_ATTRIBUTEDEF)
                v->declared[doc_attr_value(doc, e, STR_attrname)] = 1;
}

/* True if an <attributedef> declares the attribute ("Custom Attributes and Inputs"). */
static bool is_declared(struct validation *v, str_id name)
{
    if (!v->declared)
        note_declared(v);
    return v->declared[name];
}

/* Prefers the attributes of this kind of element. */
static const char *suggest(struct validation *v, enum element_kind kind, str_id name)
{
    const char *names[STR_NUM_WORDS];
    size_t count = 0;
    for (str_id word = 1; word < STR_NUM_WORDS; word++)
        if (kinds_of_word[word] >> kind & 1)
            names[count++] = text_of(v, word);
    return diag_suggest(v->diags, text_of(v, name), names, count);
}

void doc_check_attribute(const struct document *doc, elem_id element, str_id name,
                         struct diag_list *diags)
{
    const struct attribute *attr = doc_attr(doc, element, name);
    assert(name < STR_NUM_WORDS);
    if (attr && types[name] != DOC_TYPE_string
        && !doc_value_is_valid(types[name], str_text(doc->strings, attr->value),
                               str_len(doc->strings, attr->value)))
        diag_add(diags, DIAG_ID_attribute_value, doc_attr_place(doc, element, name),
                 str_text(doc->strings, attr->value), str_text(doc->strings, name),
                 str_text(doc->strings, doc_element(doc, element)->category),
                 str_text(doc->strings, doc_type_name(types[name])));
}

/* Reports an attribute that has no meaning here, or says nothing. */
static void check_attribute(struct validation *v, elem_id element, str_id name)
{
    const struct element *e = doc_element(v->doc, element);
    const char *text = text_of(v, name);
    uint64_t kinds = name < STR_NUM_WORDS ? kinds_of_word[name] : 0;
    if (kinds >> e->kind & 1)
        doc_check_attribute(v->doc, element, name, v->diags);
    /* a prefix marks the attribute of another program */
    if (kinds >> e->kind & 1 || strchr(text, ':') || is_declared(v, name))
        return;
    struct diag_place place = doc_attr_name_place(v->doc, element, name);
    if (kinds)
        diag_add(v->diags, DIAG_ID_misplaced_attribute, place, text, text_of(v, e->category));
    if (kinds)
        return;
    const char *suggestion = suggest(v, (enum element_kind)e->kind, name);
    diag_add(v->diags, DIAG_ID_unknown_attribute, place, text,
             *suggestion ? suggestion : "; an <attributedef> can declare it");
    return;
}

void validate_attributes(struct validation *v, elem_id element)
{
    const struct element *e = doc_element(v->doc, element);
    const struct attribute *attrs = doc_attrs(v->doc, element);
    for (uint32_t i = 0; i < e->num_attrs; i++)
        check_attribute(v, element, attrs[i].name);
}
