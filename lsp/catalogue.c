// SPDX-License-Identifier: Apache-2.0
#include "lsp/catalogue.h"

#include "lsp/query.h"
#include "program/memory.h"
#include "program/store.h"

#include <stdlib.h>
#include <string.h>

struct catalogue {
    struct store store;
    struct catalogue_words words[NUM_CATALOGUE_KINDS];
    /* definitions of the library in the order of their nodes; `of` is unused */
    struct named_nodedef {
        const char *node;
        uint32_t index;
    } * nodes;
    uint32_t num_nodes;
};

/* ---- Words ---- */

static void add_word(struct catalogue *catalogue, enum catalogue_kind kind, const char *name,
                     const char *of)
{
    struct catalogue_words *words = &catalogue->words[kind];
    for (size_t i = 0; i < words->len; ++i)
        if (strcmp(words->items[i].name, name) == 0)
            return;
    words->items = store_grow(&catalogue->store, words->items, words->len, sizeof *words->items);
    words->items[words->len++] =
        (struct catalogue_word){store_text(&catalogue->store, name, strlen(name)),
                                store_text(&catalogue->store, of, strlen(of))};
}

/* Which elements of a library have words, with the attribute that tells what each belongs to. */
static const struct word_source {
    const char *category, *of;
    enum catalogue_kind kind;
} word_sources[] = {
    {"typedef", "semantic", CATALOGUE_TYPES},
    {"unittypedef", "", CATALOGUE_UNIT_TYPES},
    {"geompropdef", "type", CATALOGUE_GEOMPROPS},
    {"targetdef", "", CATALOGUE_TARGETS},
};

static void add_units(struct catalogue *catalogue, const struct lsp_query *query, uint32_t unitdef)
{
    char name[QUERY_NAME], of[QUERY_NAME];
    query_text(query, unitdef, "unittype", of, sizeof of);
    for (uint32_t unit = model_first(query->model, unitdef); unit != MODEL_NONE;
         unit = model_next(query->model, unit))
        add_word(catalogue, CATALOGUE_UNITS, query_text(query, unit, "name", name, sizeof name),
                 of);
}

/* A transform of colours names two spaces, "A_to_B". */
static void add_colorspaces(struct catalogue *catalogue, const char *node)
{
    const char *between = strstr(node, "_to_");
    if (!between)
        return;
    char *from = store_text(&catalogue->store, node, (size_t)(between - node));
    add_word(catalogue, CATALOGUE_COLORSPACES, from, "");
    add_word(catalogue, CATALOGUE_COLORSPACES, between + 4, "");
}

static void read_words(struct catalogue *catalogue, const char *xml, size_t size)
{
    struct text text = {0};
    struct model model = {0};
    text_set(&text, xml, size);
    model_read(&model, &text);
    struct lsp_query query = {.text = &text, .model = &model};
    uint32_t root = query_root(&query);
    for (uint32_t e = root == MODEL_NONE ? root : model_first(&model, root); e != MODEL_NONE;
         e = model_next(&model, e)) {
        char name[QUERY_NAME], of[QUERY_NAME];
        if (query_is(&query, e, "unitdef"))
            add_units(catalogue, &query, e);
        for (size_t i = 0; i < sizeof word_sources / sizeof *word_sources; ++i)
            if (query_is(&query, e, word_sources[i].category))
                add_word(catalogue, word_sources[i].kind,
                         query_text(&query, e, "name", name, sizeof name),
                         query_text(&query, e, word_sources[i].of, of, sizeof of));
    }
    text_finish(&text);
    model_finish(&model);
}

static int compare_nodes(const void *a, const void *b)
{
    const struct named_nodedef *first = a, *second = b;
    int order = strcmp(first->node, second->node);
    return order ? order : first->index < second->index ? -1 : first->index > second->index;
}

static void read_nodes(struct catalogue *catalogue, const mxg_library *library)
{
    catalogue->num_nodes = mxg_library_num_nodedefs(library);
    catalogue->nodes =
        store_alloc(&catalogue->store, (catalogue->num_nodes + 1) * sizeof *catalogue->nodes);
    for (uint32_t i = 0; i < catalogue->num_nodes; ++i) {
        mxg_nodedef nodedef = {sizeof nodedef};
        mxg_library_nodedef(library, i, &nodedef);
        catalogue->nodes[i] = (struct named_nodedef){nodedef.node, i};
        if (strcmp(nodedef.group, "colortransform") == 0)
            add_colorspaces(catalogue, nodedef.node);
    }
    qsort(catalogue->nodes, catalogue->num_nodes, sizeof *catalogue->nodes, compare_nodes);
}

static struct catalogue *get(struct lsp_session *session)
{
    if (session->catalogue)
        return session->catalogue;
    struct catalogue *catalogue = memory_alloc(sizeof *catalogue);
    size_t size = 0;
    const char *xml = mxg_library_xml(session->desc.library, &size);
    if (xml)
        read_words(catalogue, xml, size);
    read_nodes(catalogue, session->desc.library);
    session->catalogue = catalogue;
    return catalogue;
}

const struct catalogue_words *catalogue_words(struct lsp_session *session, enum catalogue_kind kind)
{
    return &get(session)->words[kind];
}

bool catalogue_prepare(struct lsp_session *session)
{
    if (session->catalogue)
        return false;
    get(session);
    return true;
}

void catalogue_destroy(struct catalogue *catalogue)
{
    if (catalogue)
        store_finish(&catalogue->store);
    free(catalogue);
}

/* ---- Definitions ---- */

static const mxg_document *read_last(const struct lsp_query *query)
{
    return query->document ? query->document->parsed : NULL;
}

uint32_t catalogue_num_nodedefs(const struct lsp_query *query)
{
    const mxg_document *document = read_last(query);
    return document ? mxg_document_num_nodedefs(document)
                    : mxg_library_num_nodedefs(query->session->desc.library);
}

bool catalogue_nodedef(const struct lsp_query *query, uint32_t index, mxg_nodedef *out)
{
    const mxg_document *document = read_last(query);
    *out = (mxg_nodedef){sizeof *out};
    return (document ? mxg_document_nodedef(document, index, out)
                     : mxg_library_nodedef(query->session->desc.library, index, out))
           == MXG_OK;
}

bool catalogue_port(const struct lsp_query *query, uint32_t nodedef, uint32_t index, mxg_port *out)
{
    const mxg_document *document = read_last(query);
    *out = (mxg_port){sizeof *out};
    return (document ? mxg_document_port(document, nodedef, index, out)
                     : mxg_library_port(query->session->desc.library, nodedef, index, out))
           == MXG_OK;
}

/* The first definition of the node in the library from an index on. */
static uint32_t next_in_library(const struct catalogue *catalogue, const char *node, uint32_t from)
{
    uint32_t low = 0, high = catalogue->num_nodes;
    const struct named_nodedef key = {node, from};
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (compare_nodes(&catalogue->nodes[middle], &key) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    bool is_found = low < catalogue->num_nodes && strcmp(catalogue->nodes[low].node, node) == 0;
    return is_found ? catalogue->nodes[low].index : MXG_NONE;
}

uint32_t catalogue_next(const struct lsp_query *query, const char *node, uint32_t from)
{
    const struct catalogue *catalogue = get(query->session);
    uint32_t found =
        from < catalogue->num_nodes ? next_in_library(catalogue, node, from) : MXG_NONE;
    if (found != MXG_NONE)
        return found;
    uint32_t num = catalogue_num_nodedefs(query);
    for (uint32_t i = from < catalogue->num_nodes ? catalogue->num_nodes : from; i < num; ++i) {
        mxg_nodedef nodedef;
        if (catalogue_nodedef(query, i, &nodedef) && strcmp(nodedef.node, node) == 0)
            return i;
    }
    return MXG_NONE;
}

uint32_t catalogue_find_nodedef(const struct lsp_query *query, const char *name)
{
    for (uint32_t i = catalogue_num_nodedefs(query); i-- > 0;) {
        mxg_nodedef nodedef;
        if (catalogue_nodedef(query, i, &nodedef) && strcmp(nodedef.name, name) == 0)
            return i;
    }
    return MXG_NONE;
}

bool catalogue_find_port(const struct lsp_query *query, uint32_t nodedef, const char *name,
                         bool is_output, mxg_port *out)
{
    mxg_nodedef info;
    if (nodedef == MXG_NONE || !catalogue_nodedef(query, nodedef, &info))
        return false;
    uint32_t first = is_output ? info.num_inputs : 0,
             num = is_output ? info.num_outputs : info.num_inputs;
    for (uint32_t i = 0; i < num; ++i)
        if (catalogue_port(query, nodedef, first + i, out) && strcmp(out->name, name) == 0)
            return true;
    return false;
}

/* ---- The definition of a node ---- */

static bool has_type(const struct lsp_query *query, uint32_t index, const mxg_nodedef *nodedef,
                     const char *type)
{
    mxg_port port;
    if (!*type)
        return true;
    if (nodedef->num_outputs != 1)
        return strcmp(type, "multioutput") == 0;
    return catalogue_port(query, index, nodedef->num_inputs, &port) && strcmp(port.type, type) == 0;
}

/* How many inputs of the node fit the definition; below 0: one does not. */
static int count_fits(const struct lsp_query *query, uint32_t element, uint32_t nodedef)
{
    int fits = 0;
    for (uint32_t child = model_first(query->model, element); child != MODEL_NONE;
         child = model_next(query->model, child)) {
        char name[QUERY_NAME], type[QUERY_NAME];
        mxg_port port;
        if (!query_is(query, child, "input"))
            continue;
        query_text(query, child, "name", name, sizeof name);
        query_text(query, child, "type", type, sizeof type);
        bool is_known = catalogue_find_port(query, nodedef, name, false, &port);
        if (is_known && *type && strcmp(port.type, type) != 0)
            return -1;
        fits += is_known;
    }
    return fits;
}

/* How well a definition fits a node; below 0: it does not. */
static int score(const struct lsp_query *query, uint32_t element, uint32_t index)
{
    mxg_nodedef nodedef;
    char version[QUERY_NAME], type[QUERY_NAME];
    if (!catalogue_nodedef(query, index, &nodedef))
        return -1;
    query_text(query, element, "version", version, sizeof version);
    bool has_version = *version ? strcmp(version, nodedef.version) == 0
                                : nodedef.is_default_version || !*nodedef.version;
    int fits = count_fits(query, element, index);
    bool is_of_type =
        has_type(query, index, &nodedef, query_text(query, element, "type", type, sizeof type));
    return (fits >= 0 ? 2 * fits + 1 : 0) + (is_of_type ? 1 << 16 : 0)
           + (has_version ? 1 << 12 : 0);
}

uint32_t catalogue_resolve(const struct lsp_query *query, uint32_t element)
{
    char name[QUERY_NAME], category[QUERY_NAME];
    if (element == MODEL_NONE)
        return MXG_NONE;
    query_text(query, element, "nodedef", name, sizeof name);
    if (*name)
        return catalogue_find_nodedef(query, name);
    query_category(query, element, category, sizeof category);
    uint32_t best = MXG_NONE;
    int best_score = -1;
    for (uint32_t i = 0; (i = catalogue_next(query, category, i)) != MXG_NONE; ++i) {
        int points = score(query, element, i);
        if (points > best_score) {
            best = i;
            best_score = points;
        }
    }
    return best;
}

bool catalogue_port_of(const struct lsp_query *query, uint32_t input, mxg_port *out)
{
    char name[QUERY_NAME];
    if (input == MODEL_NONE)
        return false;
    uint32_t node = query->model->elements[input].parent;
    query_text(query, input, "name", name, sizeof name);
    return query_is_node(query, node)
           && catalogue_find_port(query, catalogue_resolve(query, node), name, false, out);
}
