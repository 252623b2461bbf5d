// SPDX-License-Identifier: Apache-2.0
/* Collections, and lists of geometry. */
#include "base/hash.h"
#include "bind/look.h"

#include <assert.h>

static const char *text_of(const struct bind_look *look, str_id id)
{
    return str_text(look->doc->strings, id);
}

/* ---- Lists of geometry ---- */

struct list {
    struct bind_look *look;
    elem_id element;
    str_id attr;
    const char *prefix;
    uint32_t matcher; /* 1 + number; 0: the list was empty so far */
};

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static void report_prefixed(const struct list *list, const char *name, const char *whole)
{
    diag_add(list->look->diags, DIAG_ID_prefixed_name,
             doc_attr_place(list->look->doc, list->element, list->attr), name, list->prefix, whole);
}

/* The prefix is joined as plain text, before the pattern is read. */
static void read_geometry_name(struct list *list, struct look_matcher matcher, const char *text,
                               size_t len)
{
    struct bind_look *look = list->look;
    struct text whole;
    text_init(&whole, look->arena);
    text_str(&whole, list->prefix);
    text_mem(&whole, text, len);
    if (*list->prefix && *text == '/')
        report_prefixed(list, arena_strndup(look->arena, text, len), text_cstr(&whole));
    if (!list->matcher) {
        vec_push(look->arena, &look->matchers, matcher);
        list->matcher = look->matchers.len;
    }
    if (look_match_instance(look, (struct text_word){whole.data, whole.len}, list->matcher - 1))
        return;
    const char *fault =
        pattern_add(&look->patterns, text_cstr(&whole), whole.len, list->matcher - 1);
    look->matchers.items[list->matcher - 1].has_fault |= fault != NULL;
    if (fault)
        diag_add(look->diags, DIAG_ID_bad_pattern,
                 doc_attr_place(look->doc, list->element, list->attr), text_cstr(&whole), fault);
}

struct text_word look_next_name(const char **list)
{
    while (**list) {
        const char *text = *list, *end = pattern_name_end(text), *last = end;
        *list = end + (*end == ',');
        while (text < last && is_blank(*text))
            text++;
        while (text < last && is_blank(last[-1]))
            last--;
        if (text < last)
            return (struct text_word){text, (size_t)(last - text)};
    }
    return (struct text_word){0};
}

uint32_t look_read_geometry(struct bind_look *look, elem_id element, str_id attr,
                            struct look_matcher matcher)
{
    struct list list = {look, element, attr, .prefix = ""};
    const char *text = text_of(look, doc_attr_value(look->doc, element, attr));
    list.prefix = text_of(look, doc_inherited_attr(look->doc, element, STR_geomprefix));
    matcher.prefix = list.prefix;
    matcher.list = text;
    for (struct text_word name; (name = look_next_name(&text)).len;)
        read_geometry_name(&list, matcher, name.bytes, name.len);
    return list.matcher;
}

/* ---- Collections ---- */

/* A collection whose nested ones are being read. */
struct step {
    elem_id element;
    const char *rest; /* of its includecollection */
    uint32_t number;  /* in `collections`, once it is read */
    VEC(uint32_t) nested;
};

struct steps {
    struct step *items;
    uint32_t len, cap;
};

/* Its number from 1; 0: it is not read yet. */
static uint32_t find_read(const struct bind_look *look, elem_id element)
{
    uint32_t hash = hash_pair(element, 0);
    for (uint32_t at = hash, found; (found = table_next(&look->collection_table, hash, &at));)
        if (look->collections.items[found - 1].element == element)
            return found;
    return 0;
}

static void report_cycle(struct bind_look *look, const struct steps *steps, elem_id again)
{
    struct text path;
    text_init(&path, look->arena);
    uint32_t i = steps->len;
    while (steps->items[--i].element != again)
        continue;
    for (; i < steps->len; i++)
        text_fmt(&path, "%s -> ",
                 text_of(look, doc_element(look->doc, steps->items[i].element)->name));
    const char *name = text_of(look, doc_element(look->doc, again)->name);
    text_str(&path, name);
    diag_add(look->diags, DIAG_ID_collection_cycle,
             doc_attr_place(look->doc, vec_last(steps).element, STR_includecollection), name,
             text_cstr(&path));
}

static bool is_open(const struct steps *steps, elem_id element)
{
    for (uint32_t i = 0; i < steps->len; i++)
        if (steps->items[i].element == element)
            return true;
    return false;
}

static void enter(struct bind_look *look, struct steps *steps, elem_id element)
{
    const char *nested = text_of(look, doc_attr_value(look->doc, element, STR_includecollection));
    vec_push(look->arena, steps, (struct step){.element = element, .rest = nested});
}

/* The last step has all its nested collections: adds it, and gives its number to its user. */
static uint32_t leave(struct bind_look *look, struct steps *steps)
{
    struct step *step = &vec_last(steps);
    struct look_collection added = {
        .element = step->element, .first_nested = look->nested.len, .num_nested = step->nested.len};
    uint32_t number = look->collections.len;
    for (uint32_t i = 0; i < step->nested.len; i++)
        vec_push(look->arena, &look->nested, step->nested.items[i]);
    added.include =
        look_read_geometry(look, step->element, STR_includegeom,
                           (struct look_matcher){.owner = number, .kind = MATCHER_INCLUDE});
    added.exclude =
        look_read_geometry(look, step->element, STR_excludegeom,
                           (struct look_matcher){.owner = number, .kind = MATCHER_EXCLUDE});
    vec_push(look->arena, &look->collections, added);
    table_add(&look->collection_table, look->arena, hash_pair(step->element, 0), number + 1);
    (void)vec_pop(steps);
    if (steps->len)
        vec_push(look->arena, &vec_last(steps).nested, number);
    return number + 1;
}

/* The next name of the last step's list. */
static void read_nested(struct bind_look *look, struct steps *steps)
{
    struct step *step = &vec_last(steps);
    step->rest += strspn(step->rest, ", \t\n");
    size_t len = strcspn(step->rest, ", \t\n");
    str_id name = len ? str_find(look->doc->strings, step->rest, len) : 0;
    elem_id element = name ? doc_top_level(look->doc, KIND_COLLECTION, name) : 0;
    step->rest += len;
    uint32_t read = element ? find_read(look, element) : 0;
    if (len && !element)
        look_report_unknown(look, step->element, STR_includecollection, "collection",
                            KIND_COLLECTION);
    else if (read)
        vec_push(look->arena, &step->nested, read - 1);
    else if (element && is_open(steps, element))
        report_cycle(look, steps, element);
    else if (element)
        enter(look, steps, element);
}

uint32_t look_read_collection(struct bind_look *look, str_id name, elem_id user, str_id attr)
{
    elem_id element = doc_top_level(look->doc, KIND_COLLECTION, name);
    if (!element) {
        look_report_unknown(look, user, attr, "collection", KIND_COLLECTION);
        return 0;
    }
    uint32_t number = find_read(look, element);
    struct steps steps = {0};
    if (!number)
        enter(look, &steps, element);
    while (steps.len) {
        if (vec_last(&steps).rest[strspn(vec_last(&steps).rest, ", \t\n")])
            read_nested(look, &steps);
        else
            number = leave(look, &steps);
    }
    assert(number);
    return number;
}

/* Adds a nested collection, and what it contains. */
static void add_contained(struct bind_look *look, uint64_t *own, uint32_t inner, uint32_t words)
{
    uint32_t row = look->rows[inner];
    own[inner / 64] |= (uint64_t)1 << inner % 64;
    for (uint32_t w = 0; row && w < words; w++)
        own[w] |= look->contains.items[(size_t)(row - 1) * words + w];
}

/* Fills the sets of the collections that each collection contains, at any depth. */
static void contain_nested(struct bind_look *look)
{
    uint32_t num = look->collections.len, words = (num + 63) / 64, num_rows = 0;
    look->rows = ARENA_ARRAY(look->arena, uint32_t, num);
    for (uint32_t i = 0; i < num; i++)
        if (look->collections.items[i].num_nested)
            look->rows[i] = ++num_rows;
    if (!num_rows)
        return;
    look->contains.items = ARENA_ARRAY(look->arena, uint64_t, (size_t)num_rows * words);
    for (uint32_t i = 0; i < num; i++) {
        const struct look_collection *c = &look->collections.items[i];
        for (uint32_t n = 0; n < c->num_nested; n++) {
            uint32_t inner = look->nested.items[c->first_nested + n];
            assert(inner < i);
            add_contained(look, look->contains.items + (size_t)(look->rows[i] - 1) * words, inner,
                          words);
        }
    }
}

/* A number of a list, and the list. */
struct listed {
    uint32_t list, number;
};
struct listed_numbers {
    struct listed *items;
    uint32_t len, cap;
};

/* Each list has its numbers in the order of `listed`. */
static struct look_lists make_lists(struct arena *arena, uint32_t num_lists,
                                    const struct listed_numbers *listed)
{
    struct look_lists lists = {ARENA_ARRAY(arena, uint32_t, (size_t)num_lists + 1),
                               ARENA_ARRAY(arena, uint32_t, listed->len)};
    uint32_t *ends = lists.first, begin = 0;
    for (uint32_t i = 0; i < listed->len; i++)
        ends[listed->items[i].list + 1]++;
    for (uint32_t i = 0; i < num_lists; i++) {
        uint32_t len = ends[i + 1];
        ends[i + 1] = begin; /* until it is filled */
        begin += len;
    }
    for (uint32_t i = 0; i < listed->len; i++)
        lists.items[ends[listed->items[i].list + 1]++] = listed->items[i].number;
    return lists;
}

void look_close_collections(struct bind_look *look)
{
    struct listed_numbers users = {0}, assigned = {0};
    if (!look->collections.len)
        return;
    contain_nested(look);
    for (uint32_t i = 0; i < look->collections.len; i++) {
        const struct look_collection *c = &look->collections.items[i];
        for (uint32_t n = 0; n < c->num_nested; n++)
            vec_push(look->arena, &users,
                     (struct listed){look->nested.items[c->first_nested + n], i});
    }
    for (uint32_t i = 0; i < look->assigns.len; i++)
        if (look->assigns.items[i].collection)
            vec_push(look->arena, &assigned,
                     (struct listed){look->assigns.items[i].collection - 1, i});
    look->users = make_lists(look->arena, look->collections.len, &users);
    look->assigned = make_lists(look->arena, look->collections.len, &assigned);
}
