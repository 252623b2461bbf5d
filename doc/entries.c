// SPDX-License-Identifier: Apache-2.0
/* Turns the definitions of a library into entries of the reference. */
#include "doc/manual.h"

#include <stdlib.h>
#include <string.h>

const char *manual_keep(struct manual *manual, char *text)
{
    const char *kept = store_text(&manual->store, text, strlen(text));
    free(text);
    return kept;
}

/* ---- Texts ---- */

static struct manual_texts make_texts(struct manual *manual, size_t capacity)
{
    return (struct manual_texts){.items =
                                     store_alloc(&manual->store, capacity * sizeof(const char *))};
}

static void add_distinct(struct manual_texts *texts, const char *text)
{
    for (size_t i = 0; i < texts->len; ++i)
        if (strcmp(texts->items[i], text) == 0)
            return;
    if (*text)
        texts->items[texts->len++] = text;
}

static bool are_same(const struct manual_texts *a, const struct manual_texts *b)
{
    bool same = a->len == b->len;
    for (size_t i = 0; same && i < a->len; ++i)
        same = strcmp(a->items[i], b->items[i]) == 0;
    return same;
}

/* ---- Ports ---- */

static struct manual_port *find_port(const struct manual_edition *edition, const char *name,
                                     bool is_output)
{
    for (size_t i = 0; i < edition->num_ports; ++i)
        if (edition->ports[i].is_output == is_output && strcmp(edition->ports[i].name, name) == 0)
            return &edition->ports[i];
    return NULL;
}

static void add_port(struct manual *manual, struct manual_edition *edition, const mxg_port *port,
                     bool is_output)
{
    struct manual_port *row = find_port(edition, port->name, is_output);
    if (!row) {
        row = &edition->ports[edition->num_ports++];
        *row = (struct manual_port){.name = port->name,
                                    .folder = port->uifolder,
                                    .is_output = is_output,
                                    .uniform = port->uniform};
        for (unsigned column = 0; column < MANUAL_NUM_COLUMNS; ++column)
            row->cells[column] = make_texts(manual, edition->num_variants);
    }
    for (unsigned column = 0; column < MANUAL_NUM_COLUMNS; ++column)
        if (!is_output || column != MANUAL_DEFAULT)
            add_distinct(&row->cells[column],
                         manual_cell(manual, port, (enum manual_column)column));
}

/* Inputs, then outputs, in the order of their first appearance among the variants. */
static void add_ports(struct manual *manual, struct manual_edition *edition)
{
    size_t capacity = 0;
    for (size_t i = 0; i < edition->num_variants; ++i)
        capacity += edition->variants[i].def.num_inputs + edition->variants[i].def.num_outputs;
    edition->ports = store_alloc(&manual->store, capacity * sizeof *edition->ports);
    for (unsigned is_output = 0; is_output < 2; ++is_output) {
        for (size_t i = 0; i < edition->num_variants; ++i) {
            const struct manual_variant *variant = &edition->variants[i];
            uint32_t num_inputs = variant->def.num_inputs;
            uint32_t begin = is_output ? num_inputs : 0,
                     end = is_output ? num_inputs + variant->def.num_outputs : num_inputs;
            for (; begin < end; ++begin) {
                mxg_port port = {sizeof port};
                if (mxg_library_port(manual->library, variant->index, begin, &port) == MXG_OK)
                    add_port(manual, edition, &port, is_output);
            }
        }
    }
}

static bool is_same_port(const struct manual_port *a, const struct manual_port *b)
{
    bool same = a->uniform == b->uniform;
    for (unsigned column = 0; same && column < MANUAL_NUM_COLUMNS; ++column)
        same = are_same(&a->cells[column], &b->cells[column]);
    return same;
}

/* An edition after the first keeps only the ports that differ. */
static void keep_differences(struct manual *manual, struct manual_edition *edition,
                             const struct manual_edition *first)
{
    edition->missing = make_texts(manual, first->num_ports);
    for (size_t i = 0; i < first->num_ports; ++i)
        if (!find_port(edition, first->ports[i].name, first->ports[i].is_output))
            add_distinct(&edition->missing, first->ports[i].name);
    size_t kept = 0;
    for (size_t i = 0; i < edition->num_ports; ++i) {
        const struct manual_port *port = &edition->ports[i],
                                 *other = find_port(first, port->name, port->is_output);
        if (!other || !is_same_port(port, other))
            edition->ports[kept++] = *port;
    }
    edition->num_ports = kept;
}

static const char *signature(struct manual *manual, const struct manual_variant *variant)
{
    uint32_t num_inputs = variant->def.num_inputs,
             num_ports = num_inputs + variant->def.num_outputs;
    char *text = cli_format("(");
    for (uint32_t i = 0; i < num_ports; ++i) {
        mxg_port port = {sizeof port};
        if (mxg_library_port(manual->library, variant->index, i, &port) != MXG_OK)
            continue;
        const char *between = i == num_inputs ? ") \xe2\x86\x92 " : i ? ", " : "";
        bool named = i < num_inputs || variant->def.num_outputs > 1;
        char *longer = cli_format("%s%s%s%s%s", text, between, named ? port.name : "",
                                  named ? ": " : "", port.type);
        free(text);
        text = longer;
    }
    return manual_keep(manual, text);
}

/* ---- Order ---- */

/* Compares versions as numbers between dots. */
static int compare_versions(const char *a, const char *b)
{
    while (*a || *b) {
        char *end_a, *end_b;
        unsigned long x = strtoul(a, &end_a, 10), y = strtoul(b, &end_b, 10);
        if (x != y)
            return x < y ? -1 : 1;
        if (end_a == a && end_b == b)
            return strcmp(a, b);
        a = end_a + (*end_a == '.');
        b = end_b + (*end_b == '.');
    }
    return 0;
}

/* By group, node, version (the default one, then from new to old), position in the library. */
static int compare_variants(const void *left, const void *right)
{
    const struct manual_variant *a = left, *b = right;
    int order = strcmp(a->def.group, b->def.group);
    if (order == 0)
        order = strcmp(a->def.node, b->def.node);
    if (order == 0)
        order = (int)b->def.is_default_version - (int)a->def.is_default_version;
    if (order == 0)
        order = -compare_versions(a->def.version, b->def.version);
    return order ? order : a->index < b->index ? -1 : 1;
}

static bool is_same_node(const struct manual_variant *a, const struct manual_variant *b)
{
    return strcmp(a->def.group, b->def.group) == 0 && strcmp(a->def.node, b->def.node) == 0;
}

/* The number of leading variants that belong to one edition. */
static size_t count_edition(const struct manual_variant *variants, size_t num)
{
    size_t len = 1;
    while (len < num && strcmp(variants[len].def.version, variants[0].def.version) == 0)
        ++len;
    return len;
}

/* ---- Entries ---- */

static void add_targets(struct manual *manual, struct manual_node *node,
                        const struct manual_variant *variants)
{
    node->targets = make_texts(manual, manual->num_targets);
    for (uint32_t t = 0; t < manual->num_targets; ++t) {
        mxg_target target = {sizeof target};
        bool all = mxg_catalogue_target(t, &target) == MXG_OK;
        for (size_t i = 0; all && i < node->num_variants; ++i)
            all = mxg_library_has_implementation(manual->library, variants[i].index, target.name);
        if (all)
            add_distinct(&node->targets, target.name);
    }
}

/*
 * The node's name. In a second group with this name (math and pbr both have "add") also the group's
 * name.
 */
static const char *unique_id(struct manual *manual, const mxg_nodedef *def)
{
    bool is_new;
    names_add(&manual->names, def->node, &is_new);
    return is_new ? def->node : manual_keep(manual, cli_format("%s-%s", def->node, def->group));
}

/* The entry of `num` definitions of one node. */
static void add_node(struct manual *manual, const struct manual_variant *variants, size_t num)
{
    const mxg_nodedef *def = &variants[0].def;
    const char *id = unique_id(manual, def);
    struct manual_node *node = &manual->nodes[manual->num_nodes++];
    *node = (struct manual_node){.id = id,
                                 .name = def->node,
                                 .group = def->group,
                                 .text = def->doc,
                                 .file = def->file,
                                 .num_variants = num};
    node->editions = store_alloc(&manual->store, num * sizeof *node->editions);
    for (size_t i = 0; i < num;) {
        struct manual_edition *edition = &node->editions[node->num_editions++];
        edition->version = variants[i].def.version;
        edition->variants = &variants[i];
        edition->num_variants = count_edition(&variants[i], num - i);
        add_ports(manual, edition);
        i += edition->num_variants;
    }
    for (size_t i = 1; i < node->num_editions; ++i)
        keep_differences(manual, &node->editions[i], &node->editions[0]);
    add_targets(manual, node, variants);
}

void manual_init(struct manual *manual, const mxg_library *library, uint32_t first)
{
    uint32_t end = mxg_library_num_nodedefs(library);
    *manual = (struct manual){.library = library, .num_targets = mxg_catalogue_num_targets()};
    struct manual_variant *variants = store_alloc(&manual->store, (end - first) * sizeof *variants);
    for (uint32_t i = first; i < end; ++i) {
        struct manual_variant *variant = &variants[manual->num_variants];
        *variant = (struct manual_variant){.index = i, .def = {sizeof variant->def}};
        if (mxg_library_nodedef(library, i, &variant->def) != MXG_OK)
            continue;
        if (!*variant->def.group)
            variant->def.group = "other";
        variant->signature = signature(manual, variant);
        ++manual->num_variants;
    }
    qsort(variants, manual->num_variants, sizeof *variants, compare_variants);
    manual->nodes = store_alloc(&manual->store, manual->num_variants * sizeof *manual->nodes);
    for (size_t i = 0; i < manual->num_variants;) {
        size_t len = 1;
        while (i + len < manual->num_variants && is_same_node(&variants[i], &variants[i + len]))
            ++len;
        add_node(manual, &variants[i], len);
        i += len;
    }
}
