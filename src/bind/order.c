// SPDX-License-Identifier: Apache-2.0
/* The order of the names of a look: base first. */
#include "base/hash.h"
#include "bind/look.h"

#include <assert.h>
#include <stdlib.h>

static const char *text_of(const struct bind_look *look, str_id id)
{
    return str_text(look->doc->strings, id);
}

static int compare_bytes(struct text_word a, struct text_word b)
{
    size_t len = a.len < b.len ? a.len : b.len;
    int order = len ? memcmp(a.bytes, b.bytes, len) : 0;
    return order ? order : (a.len > b.len) - (a.len < b.len);
}

/* ---- The slotorder ---- */

static uint32_t rank_of(const struct bind_look *look, struct text_word part)
{
    uint32_t hash = hash_bytes(part.bytes, part.len);
    for (uint32_t at = hash, found; (found = table_next(&look->order_table, hash, &at));)
        if (compare_bytes(look->order_parts.items[found - 1], part) == 0)
            return found - 1;
    return UINT32_MAX;
}

/* The slotorder of the look, or of the scene if no look has one; NULL: none. */
static const char *order_of(const struct bind_look *look)
{
    if (look->order)
        return text_of(look, doc_attr_value(look->doc, look->order, STR_slotorder));
    return look->scene ? look->scene->slot_order : NULL;
}

static struct diag_place place_of_order(const struct bind_look *look)
{
    return look->order ? doc_attr_place(look->doc, look->order, STR_slotorder)
                       : look->scene->slot_order_place;
}

static void report_order(struct bind_look *look, const char *part, const char *fault)
{
    diag_add(look->diags, DIAG_ID_bad_slot_order, place_of_order(look), part, fault);
}

static void read_part(struct bind_look *look, const char *text, size_t len)
{
    struct slot_name name;
    const char *fault = slot_parse(text, len, &name);
    bool is_part = !fault && name.parts[SLOT_SLOT].len == len;
    struct text_word part = {text, len};
    const char *shown = arena_strndup(look->arena, text, len);
    if (!is_part) {
        report_order(look, shown, "is no part of a name");
    } else if (rank_of(look, part) != UINT32_MAX) {
        report_order(look, shown, "is listed twice");
    } else {
        vec_push(look->arena, &look->order_parts, part);
        table_add(&look->order_table, look->arena, hash_bytes(text, len), look->order_parts.len);
    }
}

void look_read_order(struct bind_look *look)
{
    const char *text = order_of(look);
    look->order_parts.len = 0;
    look->order_table = (struct table){0};
    while (text && *text) {
        const char *end = text + strcspn(text, ","), *last = end;
        while (text < last && *text == ' ')
            text++;
        while (text < last && last[-1] == ' ')
            last--;
        read_part(look, text, (size_t)(last - text));
        text = end + (*end == ',');
    }
}

/* ---- Comparison ---- */

/* An absent part lies below every other one. */
static int compare_parts(const struct look_name *a, const struct look_name *b, unsigned part)
{
    struct text_word x = a->name.parts[part], y = b->name.parts[part];
    if (!x.len || !y.len)
        return (x.len > 0) - (y.len > 0);
    if (a->ranks[part] != b->ranks[part])
        return a->ranks[part] < b->ranks[part] ? -1 : 1;
    return compare_bytes(x, y);
}

static int compare_names(const void *a, const void *b)
{
    int order = 0;
    for (unsigned part = 0; part < NUM_SLOT_PARTS && !order; part++)
        order = compare_parts(a, b, part);
    return order;
}

static bool have_same(const struct look_name *a, const struct look_name *b, unsigned num_parts)
{
    for (unsigned part = 0; part < num_parts; part++)
        if (compare_bytes(a->name.parts[part], b->name.parts[part]) != 0)
            return false;
    return true;
}

/* ---- Warnings ---- */

static bool is_number(struct text_word part)
{
    for (size_t i = 0; i < part.len; i++)
        if (part.bytes[i] < '0' || part.bytes[i] > '9')
            return false;
    return part.len;
}

static int compare_values(struct text_word a, struct text_word b)
{
    for (; a.len && *a.bytes == '0'; a.bytes++, a.len--)
        continue;
    for (; b.len && *b.bytes == '0'; b.bytes++, b.len--)
        continue;
    return a.len != b.len ? (a.len < b.len ? -1 : 1) : compare_bytes(a, b);
}

/* The last part that a name has. */
static unsigned last_part(const struct look_name *name)
{
    return name->name.parts[SLOT_OVERRIDE].len   ? SLOT_OVERRIDE
           : name->name.parts[SLOT_VERTICAL].len ? SLOT_VERTICAL
                                                 : SLOT_SLOT;
}

/*
 * Numbers whose order is not the order of their bytes: the number before, `below`, is greater.
 * `first`: the first assignment of each name, which is its place.
 */
static void check_numbers(struct bind_look *look, const uint32_t *first, uint32_t below,
                          uint32_t above)
{
    const struct look_name *a = &look->names.items[below], *b = &look->names.items[above];
    unsigned part = last_part(b);
    struct text_word x = a->name.parts[part], y = b->name.parts[part];
    bool are_siblings = last_part(a) == part && have_same(a, b, part);
    if (!are_siblings || a->ranks[part] != UINT32_MAX || b->ranks[part] != UINT32_MAX
        || !is_number(x) || !is_number(y) || compare_values(x, y) <= 0)
        return;
    struct diag_place place = look_slot_place(look, &look->assigns.items[first[above]]);
    diag_add(look->diags, DIAG_ID_uneven_slots, place, b->text, a->text);
}

/*
 * Reports each name whose greatest sibling below it is a greater number. `greatest` is the sibling
 * by kind of part.
 */
static void check_all_numbers(struct bind_look *look)
{
    uint32_t greatest[NUM_SLOT_PARTS], *first = ARENA_ARRAY(look->arena, uint32_t, look->names.len);
    memset(greatest, 0xff, sizeof greatest);
    for (uint32_t i = look->assigns.len; i-- > 0;)
        first[look->assigns.items[i].name] = i;
    for (uint32_t i = 0; i < look->names.len; i++) {
        const struct look_name *name = &look->names.items[i];
        unsigned part = last_part(name);
        uint32_t *best = &greatest[part];
        bool is_first = *best == UINT32_MAX || !have_same(&look->names.items[*best], name, part);
        if (!is_number(name->name.parts[part]) || name->ranks[part] != UINT32_MAX)
            continue;
        if (!is_first)
            check_numbers(look, first, *best, i);
        if (is_first
            || compare_values(look->names.items[*best].name.parts[part], name->name.parts[part])
                   < 0)
            *best = i;
    }
}

static void check_unlisted(struct bind_look *look)
{
    struct text list;
    text_init(&list, look->arena);
    for (uint32_t i = 0; i < look->names.len; i++) {
        const struct look_name *name = &look->names.items[i];
        unsigned part = last_part(name);
        if (name->ranks[part] != UINT32_MAX)
            continue;
        text_fmt(&list, "%s'%s'", list.len ? ", " : "", name->text);
    }
    if (list.len && look->order_parts.len)
        diag_add(look->diags, DIAG_ID_unlisted_slots, place_of_order(look), text_cstr(&list));
}

/* Parts that are listed and that nothing has. */
static void check_unused(struct bind_look *look)
{
    bool *is_used = ARENA_ARRAY(look->arena, bool, look->order_parts.len);
    struct text list;
    text_init(&list, look->arena);
    for (uint32_t i = 0; i < look->names.len; i++)
        for (unsigned k = 0; k < NUM_SLOT_PARTS; k++)
            if (look->names.items[i].name.parts[k].len
                && look->names.items[i].ranks[k] != UINT32_MAX)
                is_used[look->names.items[i].ranks[k]] = true;
    for (uint32_t i = 0; i < look->order_parts.len; i++) {
        struct text_word part = look->order_parts.items[i];
        if (!is_used[i])
            text_fmt(&list, "%s'%.*s'", list.len ? ", " : "", (int)part.len, part.bytes);
    }
    if (list.len)
        diag_add(look->diags, DIAG_ID_unused_order, place_of_order(look), text_cstr(&list));
}

/* ---- Sorting ---- */

static void rank_names(struct bind_look *look)
{
    for (uint32_t i = 0; i < look->names.len; i++)
        for (unsigned part = 0; part < NUM_SLOT_PARTS; part++) {
            struct look_name *name = &look->names.items[i];
            name->ranks[part] =
                name->name.parts[part].len ? rank_of(look, name->name.parts[part]) : 0;
        }
}

static void number_layers(struct bind_look *look)
{
    for (uint32_t i = 1; i < look->names.len; i++) {
        struct look_name *before = &look->names.items[i - 1], *name = before + 1;
        name->slot = before->slot + !have_same(before, name, SLOT_VERTICAL);
        name->layer = before->layer + !have_same(before, name, SLOT_OVERRIDE);
    }
}

void look_sort_names(struct bind_look *look)
{
    look_read_order(look);
    rank_names(look);
    if (look->names.len > 1)
        qsort(look->names.items, look->names.len, sizeof *look->names.items, compare_names);
    number_layers(look);
    uint32_t *moved = ARENA_ARRAY(look->arena, uint32_t, look->names.len);
    for (uint32_t i = 0; i < look->names.len; i++)
        moved[look->names.items[i].number] = i;
    for (uint32_t i = 0; i < look->assigns.len; i++)
        look->assigns.items[i].name = moved[look->assigns.items[i].name];
    check_all_numbers(look);
    check_unlisted(look);
    check_unused(look);
}
