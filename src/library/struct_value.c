// SPDX-License-Identifier: Apache-2.0
/*
 * Values of struct types, "{0.5;{1, 2};true}": one value for each member (specification, "Custom
 * Data Types").
 */
#include "library/library.h"

static struct text_word trimmed(struct text_word word)
{
    while (word.len && strchr(" \t\r\n", word.bytes[0]))
        word = (struct text_word){word.bytes + 1, word.len - 1};
    while (word.len && strchr(" \t\r\n", word.bytes[word.len - 1]))
        word.len--;
    return word;
}

/* The text of the first member in `*rest`, without blanks around it; moves past its ';'. */
static struct text_word next_member(struct text_word *rest)
{
    size_t len = 0, depth = 0;
    for (; len < rest->len && (depth || rest->bytes[len] != ';'); len++) {
        depth += rest->bytes[len] == '{';
        depth -= depth > 0 && rest->bytes[len] == '}';
    }
    struct text_word member = {rest->bytes, len};
    size_t past = len < rest->len ? len + 1 : len;
    *rest = (struct text_word){rest->bytes + past, rest->len - past};
    return trimmed(member);
}

bool library_split_struct(const struct library *lib, doc_type type, struct text_word text,
                          bool is_default, struct arena *arena, struct member_values *out)
{
    const struct document *doc = &lib->doc;
    struct text_word rest = trimmed(text);
    *out = (struct member_values){0};
    if (!is_default) {
        if (rest.len < 2 || rest.bytes[0] != '{' || rest.bytes[rest.len - 1] != '}')
            return false;
        rest = (struct text_word){rest.bytes + 1, rest.len - 2};
    }
    elem_id e = doc_element(doc, library_typedef(lib, type))->first_child;
    for (; e; e = doc_element(doc, e)->next) {
        struct member_value member = {library_type(lib, doc_attr_value(doc, e, STR_type)), {0}};
        if (doc_element(doc, e)->kind != KIND_MEMBER || !member.type)
            continue;
        str_id own = doc_attr_value(doc, e, STR_value);
        member.text = is_default ? (struct text_word){str_text(&lib->strings, own),
                                                      str_len(&lib->strings, own)}
                                 : next_member(&rest);
        vec_push(arena, out, member);
    }
    return (is_default || rest.len == 0) && out->len > 0;
}

static bool is_valid(const struct library *lib, doc_type type, struct text_word text,
                     struct arena *arena)
{
    struct member_values members;
    if (type < DOC_TYPE_FIRST_USER)
        return doc_value_is_valid(type, arena_strndup(arena, text.bytes, text.len), text.len);
    if (!library_split_struct(lib, type, text, false, arena, &members))
        return false;
    for (uint32_t i = 0; i < members.len; i++)
        if (!is_valid(lib, members.items[i].type, members.items[i].text, arena))
            return false;
    return true;
}

void library_report_struct(const struct library *lib, doc_type type, const char *text,
                           struct diag_place place, struct diag_list *diags)
{
    diag_add(diags, DIAG_ID_bad_value, place, text,
             str_text(&lib->strings, library_type_name(lib, type)),
             ": a value of a struct has one value for each member, as in '{0.5;true}'");
}

void library_check_struct(const struct library *lib, elem_id element, struct arena *scratch,
                          struct diag_list *diags)
{
    str_id text = doc_attr_value(&lib->doc, element, STR_value);
    doc_type type =
        text ? library_type(lib, doc_attr_value(&lib->doc, element, STR_type)) : DOC_TYPE_NONE;
    struct text_word all = {str_text(&lib->strings, text), str_len(&lib->strings, text)};
    if (type >= DOC_TYPE_FIRST_USER && !is_valid(lib, type, all, scratch))
        library_report_struct(lib, type, all.bytes, doc_attr_place(&lib->doc, element, STR_value),
                              diags);
}
