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
    for (; *list; list += *list == ',') {
        list += strspn(list, " ");
        size_t len = strcspn(list, ","), trimmed = len;
        while (trimmed && list[trimmed - 1] == ' ')
            trimmed--;
        vec_push(arena, out, arena_strndup(arena, list, trimmed));
        list += len;
    }
}

/* Looks a word up without splitting the list, because most values are valid. */
static bool has(const char *list, const char *word, size_t len)
{
    for (const char *p = list; *p; p += *p == ',') {
        p += strspn(p, " ");
        size_t n = strcspn(p, ","), trimmed = n;
        while (trimmed && p[trimmed - 1] == ' ')
            trimmed--;
        if (trimmed == len && memcmp(p, word, len) == 0)
            return true;
        p += n;
    }
    return false;
}

void library_check_enum(const struct library *lib, const struct port *port, str_id text,
                        struct diag_place place, struct diag_list *diags)
{
    if (!(port->flags & PORT_ENUM) || !text)
        return;
    const char *list = text_of(lib, doc_attr_value(&lib->doc, port->element, STR_enum)),
               *word = text_of(lib, text);
    if (has(list, word, strlen(word)))
        return;
    struct words words = {0};
    split(list, diags->arena, &words);
    diag_add(diags, DIAG_ID_bad_enum_value, place, word, list,
             diag_suggest(diags, word, words.items, words.len));
}
