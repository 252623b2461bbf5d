// SPDX-License-Identifier: Apache-2.0
/* The words that an input accepts (specification, "Input Elements": enum). */
#include "library/library.h"

static const char *text_of(const struct library *lib, str_id id)
{
    return str_text(&lib->strings, id);
}

/* The words of a list without surrounding spaces. */
struct words {
    const char **items;
    uint32_t len, cap;
};

static void split(const char *list, struct arena *arena, struct words *out)
{
    struct text_word item;
    while (text_next_item(&list, &item))
        vec_push(arena, out, arena_strndup(arena, item.bytes, item.len));
}

int library_enum_index(const char *list, const char *word)
{
    size_t len = strlen(word);
    struct text_word item;
    for (int index = 0; text_next_item(&list, &item); index++)
        if (item.len == len && memcmp(item.bytes, word, len) == 0)
            return index;
    return -1;
}

void library_check_enum(const struct library *lib, const struct port *port, str_id text,
                        struct diag_place place, struct diag_list *diags)
{
    if (!(port->flags & PORT_ENUM) || !text)
        return;
    const char *list = text_of(lib, doc_attr_value(&lib->doc, port->element, STR_enum)),
               *word = text_of(lib, text);
    if (library_enum_index(list, word) >= 0)
        return;
    struct words words = {0};
    split(list, diags->arena, &words);
    diag_add(diags, DIAG_ID_bad_enum_value, place, word, list,
             diag_suggest(diags, word, words.items, words.len));
}

elem_id library_source_words(const struct library *lib, elem_id implementation,
                             const struct port *port)
{
    const struct document *doc = &lib->doc;
    bool may_have = port->flags & PORT_ENUM && doc_element(doc, implementation)->first_child;
    elem_id input = may_have ? doc_child_of_kind(doc, implementation, KIND_INPUT, port->name) : 0;
    return input && doc_attr_value(doc, input, STR_enumvalues) ? input : 0;
}

doc_type library_source_type(const struct library *lib, elem_id implementation,
                             const struct port *port)
{
    elem_id words = library_source_words(lib, implementation, port);
    doc_type type =
        words ? library_type(lib, doc_attr_value(&lib->doc, words, STR_impltype)) : DOC_TYPE_NONE;
    return type ? type : port->type;
}

struct text_word library_enum_value(const char *list, doc_type type, unsigned index)
{
    unsigned size = doc_type_components(type);
    struct text_word item, value = {0};
    size = size ? size : 1;
    for (unsigned i = 0; text_next_item(&list, &item); i++) {
        if (i == index * size)
            value = item;
        if (i + 1 == (index + 1) * size) {
            value.len = (size_t)(item.bytes + item.len - value.bytes);
            return value;
        }
    }
    return (struct text_word){0};
}
