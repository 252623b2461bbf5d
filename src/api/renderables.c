// SPDX-License-Identifier: Apache-2.0
/* The list of the renderables of a document, and how it follows an edit. */
#include "api/api.h"

#include <assert.h>

static const uint32_t NOT_LISTED = UINT32_MAX;

/* ---- Reading ---- */

/* The run of a place: the last one that starts at it or before. */
static uint32_t run_at(const struct renderables *list, uint32_t index)
{
    uint32_t low = 0, high = list->runs.len;
    assert(index < list->num && list->runs.items[0].start == 0);
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (list->runs.items[middle].start <= index)
            low = middle;
        else
            high = middle;
    }
    return low;
}

elem_id renderable_at(const struct mxg_document *document, uint32_t index)
{
    const struct renderables *list = &document->renderables;
    const struct renderable_run *run = &list->runs.items[run_at(list, index)];
    return run->element ? run->element : list->found[run->first + (index - run->start)];
}

const char *renderable_path(const struct mxg_document *document, uint32_t index)
{
    const struct renderables *list = &document->renderables;
    const struct renderable_run *run = &list->runs.items[run_at(list, index)];
    const char *path = run->element ? run->path : list->paths[run->first + (index - run->start)];
    const struct document *doc = &document->layer.doc;
    return path ? path : doc_name(doc, renderable_at(document, index));
}

static uint32_t len_of(const struct renderables *list, uint32_t run)
{
    uint32_t end = run + 1 < list->runs.len ? list->runs.items[run + 1].start : list->num;
    return end - list->runs.items[run].start;
}

static uint32_t place_in(const struct renderables *list, elem_id element)
{
    for (uint32_t i = 0; i < list->runs.len; i++) {
        const struct renderable_run *run = &list->runs.items[i];
        uint32_t len = run->element ? 0 : len_of(list, i);
        if (run->element == element)
            return run->start;
        for (uint32_t k = 0; k < len; k++)
            if (list->found[run->first + k] == element)
                return run->start + k;
    }
    return NOT_LISTED;
}

/* ---- Changing ---- */

static void insert_run(struct mxg_document *document, uint32_t at, struct renderable_run run)
{
    struct renderables *list = &document->renderables;
    vec_push(&document->object.arena, &list->runs, run);
    memmove(list->runs.items + at + 1, list->runs.items + at,
            (list->runs.len - 1 - at) * sizeof *list->runs.items);
    list->runs.items[at] = run;
}

static void remove_run(struct renderables *list, uint32_t at)
{
    list->runs.len--;
    memmove(list->runs.items + at, list->runs.items + at + 1,
            (list->runs.len - at) * sizeof *list->runs.items);
}

/* The number of the run that starts at a place, after a run is split there if need be. */
static uint32_t split(struct mxg_document *document, uint32_t place)
{
    struct renderables *list = &document->renderables;
    if (place == list->num)
        return list->runs.len;
    uint32_t at = run_at(list, place);
    struct renderable_run run = list->runs.items[at];
    if (run.start == place)
        return at;
    run.first += place - run.start;
    run.start = place;
    insert_run(document, at + 1, run);
    return at + 1;
}

static void remove_at(struct mxg_document *document, uint32_t place)
{
    struct renderables *list = &document->renderables;
    uint32_t at = split(document, place);
    if (len_of(list, at) == 1)
        remove_run(list, at);
    else
        list->runs.items[at++].first++;
    for (; at < list->runs.len; at++)
        list->runs.items[at].start--;
    list->num--;
}

static void insert_at(struct mxg_document *document, uint32_t place, elem_id element)
{
    struct renderables *list = &document->renderables;
    uint32_t at = split(document, place);
    const char *path = renderable_new_path(&document->layer.doc, element, &document->object.arena);
    insert_run(document, at, (struct renderable_run){place, 0, element, path});
    list->num++;
    for (uint32_t i = at + 1; i < list->runs.len; i++)
        list->runs.items[i].start++;
}

/* ---- An edit ---- */

void renderables_begin(struct mxg_document *document, const struct mxg_document *from)
{
    struct renderables *list = &document->renderables;
    struct arena *arena = &document->object.arena;
    *list = from->renderables;
    memset(&list->runs, 0, sizeof list->runs);
    for (uint32_t i = 0; i < from->renderables.runs.len; i++) {
        struct renderable_run run = from->renderables.runs.items[i];
        if (run.path)
            run.path = arena_strndup(arena, run.path, strlen(run.path));
        vec_push(arena, &list->runs, run);
    }
}

struct candidates {
    struct arena *arena;
    const struct document *doc;
    VEC(elem_id) elements;
};

static bool is_in(const struct document *doc, elem_id element)
{
    return element && element >= doc->first_element
           && element - doc->first_element < doc_num_elements(doc);
}

static void add(struct candidates *c, elem_id element)
{
    if (is_in(c->doc, element) && (!c->elements.len || vec_last(&c->elements) != element))
        vec_push(c->arena, &c->elements, element);
}

/* The element at the top level that is an element or its parent; 0: it is deeper, or removed. */
static elem_id top_of(const struct document *doc, elem_id element)
{
    if (!is_in(doc, element))
        return 0;
    elem_id parent = doc_element(doc, element)->parent;
    return parent == doc->root                                       ? element
           : parent && doc_element(doc, parent)->parent == doc->root ? parent
                                                                     : 0;
}

/* In one of the documents, the outputs of a graph, and the shaders that a tree of elements names.
 */
static void add_tree(struct candidates *c, const struct document *doc, elem_id top)
{
    for (elem_id at = top; at; at = doc_next_in_tree(doc, top, at)) {
        add(c, at);
        add(c, doc_named_node(doc, at));
    }
}

/* Also true for the neighbours of what has moved. */
static bool has_new_place(const struct document *doc, elem_id element)
{
    return doc_link(doc, element)->previous != doc_link(doc->origin, element)->previous;
}

/* The elements that a change may list or take from the list, where outputs and shaders are listed.
 */
static void add_outputs(struct candidates *c, const struct doc_change *change)
{
    const struct document *doc = c->doc;
    elem_id element = doc->first_element + change->index;
    bool is_new = change->index >= doc->shared.elements,
         has_moved = !is_new && has_new_place(doc, element);
    if (element == doc->root || (doc_is_same(doc, change) && !has_moved))
        return;
    add(c, element);
    if (doc_has_element(doc, element)) {
        if (is_new || has_moved || doc_is_renamed(doc, change))
            add_tree(c, doc, element);
        add(c, doc_named_node(doc, element));
    }
    if (is_new || !doc_has_element(doc->origin, element))
        return;
    if (doc_is_renamed(doc, change))
        add_tree(c, doc->origin, element);
    add(c, doc_named_node(doc->origin, element));
}

static void add_materials(struct candidates *c, const struct doc_change *change)
{
    elem_id element = c->doc->first_element + change->index, parent = change->element.parent;
    if (element == c->doc->root)
        return;
    add(c, element);
    add(c, parent == c->doc->root ? 0 : top_of(c->doc, parent));
}

/* True if a material may have come, gone or moved. */
static bool may_change(const struct mxg_document *document, elem_id element)
{
    const struct document *doc = &document->layer.doc;
    const struct renderables *list = &document->renderables;
    bool is_listed = renderable_is_listed(doc, element, true);
    for (uint32_t i = 0; i < list->runs.len; i++)
        if (list->runs.items[i].element == element)
            return true;
    if (element - doc->first_element >= doc->shared.elements)
        return is_listed;
    return is_listed != renderable_is_listed(doc->origin, element, true)
           || (is_listed && has_new_place(doc, element));
}

/* The element before another one in the order of the document; 0: there is none. */
static elem_id before(const struct document *doc, elem_id element, bool at_top_only)
{
    elem_id at = doc_link(doc, element)->previous;
    if (!at)
        return at_top_only || doc_element(doc, element)->parent == doc->root
                   ? 0
                   : doc_element(doc, element)->parent;
    while (!at_top_only && doc_link(doc, at)->last_child)
        at = doc_link(doc, at)->last_child;
    return at;
}

static elem_id after(const struct document *doc, elem_id element, bool at_top_only)
{
    return at_top_only ? doc_element(doc, element)->next
                       : doc_next_in_tree(doc, doc->root, element);
}

/* The place for an element: searched both ways, because most are at the end or beside another. */
static uint32_t new_place(const struct mxg_document *document, elem_id element)
{
    const struct document *doc = &document->layer.doc;
    const struct renderables *list = &document->renderables;
    bool are_materials = list->are_materials;
    for (elem_id low = element, high = element;;) {
        uint32_t place = NOT_LISTED;
        low = before(doc, low, are_materials);
        high = after(doc, high, are_materials);
        if (!low || !high)
            return low ? list->num : 0;
        if (renderable_is_listed(doc, low, are_materials)
            && (place = place_in(list, low)) != NOT_LISTED)
            return place + 1;
        if (renderable_is_listed(doc, high, are_materials)
            && (place = place_in(list, high)) != NOT_LISTED)
            return place;
    }
}

static bool update(struct mxg_document *document, const struct candidates *c)
{
    struct renderables *list = &document->renderables;
    const struct document *doc = c->doc;
    for (uint32_t i = 0; i < c->elements.len; i++) {
        if (!list->are_materials && renderable_is_listed(doc, c->elements.items[i], true))
            return false; /* the first material */
        uint32_t place = place_in(list, c->elements.items[i]);
        if (place != NOT_LISTED)
            remove_at(document, place);
    }
    for (uint32_t i = 0; i < c->elements.len; i++) {
        elem_id element = c->elements.items[i];
        if (doc_has_element(doc, element) && renderable_is_listed(doc, element, list->are_materials)
            && place_in(list, element) == NOT_LISTED)
            insert_at(document, new_place(document, element), element);
    }
    return list->num || !list->are_materials;
}

bool renderables_follow(struct mxg_document *document, struct arena *scratch)
{
    const struct document *doc = &document->layer.doc;
    struct candidates c = {.arena = scratch, .doc = doc}, tops = c;
    for (uint32_t i = 0; i < doc->changes.len; i++) {
        const struct doc_change *change = doc->changes.items[i];
        if (change->is_fresh && document->renderables.are_materials)
            add_materials(&tops, change);
        else if (change->is_fresh)
            add_outputs(&c, change);
    }
    for (uint32_t i = 0; i < tops.elements.len; i++)
        if (may_change(document, tops.elements.items[i]))
            add(&c, tops.elements.items[i]);
    return update(document, &c);
}
