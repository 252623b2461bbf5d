// SPDX-License-Identifier: Apache-2.0
/* Definitions of a library to entries of the reference. */
#include "cli/doc/doc.h"

#include <stdlib.h>
#include <string.h>

/* ---- Memory ---- */

struct block {
    struct block *next;
    char *text; /* of cli_format; else the memory stands behind the block */
};

static struct block *add_block(struct doc *doc, size_t size)
{
    struct block *block = calloc(1, sizeof *block + size);
    if (!block) {
        fputs("mxgen: out of memory\n", stderr);
        exit(EXIT_FAULT);
    }
    block->next = doc->blocks;
    doc->blocks = block;
    return block;
}

void *doc_alloc(struct doc *doc, size_t size)
{
    return add_block(doc, size) + 1;
}

const char *doc_keep(struct doc *doc, char *text)
{
    add_block(doc, 0)->text = text;
    return text;
}

void doc_finish(struct doc *doc)
{
    for (struct block *block = doc->blocks; block;) {
        struct block *next = block->next;
        free(block->text);
        free(block);
        block = next;
    }
}

/* ---- Texts ---- */

static struct doc_texts make_texts(struct doc *doc, size_t capacity)
{
    return (struct doc_texts){.items = doc_alloc(doc, capacity * sizeof(const char *))};
}

static void add_distinct(struct doc_texts *texts, const char *text)
{
    for (size_t i = 0; i < texts->len; ++i)
        if (strcmp(texts->items[i], text) == 0)
            return;
    if (*text)
        texts->items[texts->len++] = text;
}

static bool are_same(const struct doc_texts *a, const struct doc_texts *b)
{
    bool same = a->len == b->len;
    for (size_t i = 0; same && i < a->len; ++i)
        same = strcmp(a->items[i], b->items[i]) == 0;
    return same;
}

/* ---- Ports ---- */

static struct doc_port *find_port(const struct doc_edition *edition, const char *name, bool is_output)
{
    for (size_t i = 0; i < edition->num_ports; ++i)
        if (edition->ports[i].is_output == is_output && strcmp(edition->ports[i].name, name) == 0)
            return &edition->ports[i];
    return NULL;
}

static void add_port(struct doc *doc, struct doc_edition *edition, const mxg_port *port, bool is_output)
{
    struct doc_port *row = find_port(edition, port->name, is_output);
    if (!row) {
        row = &edition->ports[edition->num_ports++];
        *row = (struct doc_port){
            .name = port->name, .folder = port->uifolder, .is_output = is_output, .uniform = port->uniform};
        for (unsigned column = 0; column < DOC_NUM_COLUMNS; ++column)
            row->cells[column] = make_texts(doc, edition->num_variants);
    }
    for (unsigned column = 0; column < DOC_NUM_COLUMNS; ++column)
        if (!is_output || column != DOC_DEFAULT)
            add_distinct(&row->cells[column], doc_cell(doc, port, (enum doc_column)column));
}

/* Inputs, then outputs, each kind in the order in which the variants first have them. */
static void add_ports(struct doc *doc, struct doc_edition *edition)
{
    size_t capacity = 0;
    for (size_t i = 0; i < edition->num_variants; ++i)
        capacity += edition->variants[i].def.num_inputs + edition->variants[i].def.num_outputs;
    edition->ports = doc_alloc(doc, capacity * sizeof *edition->ports);
    for (unsigned is_output = 0; is_output < 2; ++is_output) {
        for (size_t i = 0; i < edition->num_variants; ++i) {
            const struct doc_variant *variant = &edition->variants[i];
            uint32_t num_inputs = variant->def.num_inputs;
            uint32_t begin = is_output ? num_inputs : 0, end = is_output ? num_inputs + variant->def.num_outputs : num_inputs;
            for (; begin < end; ++begin) {
                mxg_port port = {sizeof port};
                if (mxg_library_port(doc->library, variant->index, begin, &port) == MXG_OK)
                    add_port(doc, edition, &port, is_output);
            }
        }
    }
}

static bool is_same_port(const struct doc_port *a, const struct doc_port *b)
{
    bool same = a->uniform == b->uniform;
    for (unsigned column = 0; same && column < DOC_NUM_COLUMNS; ++column)
        same = are_same(&a->cells[column], &b->cells[column]);
    return same;
}

/* An edition behind the first keeps the ports in which it differs. */
static void keep_differences(struct doc *doc, struct doc_edition *edition, const struct doc_edition *first)
{
    edition->missing = make_texts(doc, first->num_ports);
    for (size_t i = 0; i < first->num_ports; ++i)
        if (!find_port(edition, first->ports[i].name, first->ports[i].is_output))
            add_distinct(&edition->missing, first->ports[i].name);
    size_t kept = 0;
    for (size_t i = 0; i < edition->num_ports; ++i) {
        const struct doc_port *port = &edition->ports[i], *other = find_port(first, port->name, port->is_output);
        if (!other || !is_same_port(port, other))
            edition->ports[kept++] = *port;
    }
    edition->num_ports = kept;
}

static const char *signature(struct doc *doc, const struct doc_variant *variant)
{
    uint32_t num_inputs = variant->def.num_inputs, num_ports = num_inputs + variant->def.num_outputs;
    char *text = cli_format("(");
    for (uint32_t i = 0; i < num_ports; ++i) {
        mxg_port port = {sizeof port};
        if (mxg_library_port(doc->library, variant->index, i, &port) != MXG_OK)
            continue;
        const char *between = i == num_inputs ? ") \xe2\x86\x92 " : i ? ", " : "";
        bool named = i < num_inputs || variant->def.num_outputs > 1;
        char *longer = cli_format("%s%s%s%s%s", text, between, named ? port.name : "", named ? ": " : "", port.type);
        free(text);
        text = longer;
    }
    return doc_keep(doc, text);
}

/* ---- Order ---- */

/* Of versions as numbers between dots. */
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

/* By group, node, version (the default one, then from new to old), place in the library. */
static int compare_variants(const void *left, const void *right)
{
    const struct doc_variant *a = left, *b = right;
    int order = strcmp(a->def.group, b->def.group);
    if (order == 0)
        order = strcmp(a->def.node, b->def.node);
    if (order == 0)
        order = (int)b->def.is_default_version - (int)a->def.is_default_version;
    if (order == 0)
        order = -compare_versions(a->def.version, b->def.version);
    return order ? order : a->index < b->index ? -1 : 1;
}

static bool is_same_node(const struct doc_variant *a, const struct doc_variant *b)
{
    return strcmp(a->def.group, b->def.group) == 0 && strcmp(a->def.node, b->def.node) == 0;
}

/* How many of the variants from the first on belong to one edition. */
static size_t count_edition(const struct doc_variant *variants, size_t num)
{
    size_t len = 1;
    while (len < num && strcmp(variants[len].def.version, variants[0].def.version) == 0)
        ++len;
    return len;
}

/* ---- Entries ---- */

static void add_targets(struct doc *doc, struct doc_node *node, const struct doc_variant *variants)
{
    node->targets = make_texts(doc, doc->num_targets);
    for (uint32_t t = 0; t < doc->num_targets; ++t) {
        mxg_target target = {sizeof target};
        bool all = mxg_get_target(t, &target) == MXG_OK;
        for (size_t i = 0; all && i < node->num_variants; ++i)
            all = mxg_library_supports(doc->library, variants[i].index, target.name);
        if (all)
            add_distinct(&node->targets, target.name);
    }
}

/* The entry of `num` definitions of one node. */
static void add_node(struct doc *doc, const struct doc_variant *variants, size_t num)
{
    struct doc_node *node = &doc->nodes[doc->num_nodes++];
    const mxg_nodedef *def = &variants[0].def;
    *node = (struct doc_node){.name = def->node, .group = *def->group ? def->group : "other", .text = def->doc,
                              .file = def->file, .num_variants = num};
    node->editions = doc_alloc(doc, num * sizeof *node->editions);
    for (size_t i = 0; i < num;) {
        struct doc_edition *edition = &node->editions[node->num_editions++];
        edition->version = variants[i].def.version;
        edition->variants = &variants[i];
        edition->num_variants = count_edition(&variants[i], num - i);
        add_ports(doc, edition);
        i += edition->num_variants;
    }
    for (size_t i = 1; i < node->num_editions; ++i)
        keep_differences(doc, &node->editions[i], &node->editions[0]);
    add_targets(doc, node, variants);
}

void doc_init(struct doc *doc, const mxg_library *library, uint32_t first)
{
    uint32_t end = mxg_library_num_nodedefs(library);
    *doc = (struct doc){.library = library, .num_targets = mxg_num_targets()};
    struct doc_variant *variants = doc_alloc(doc, (end - first) * sizeof *variants);
    for (uint32_t i = first; i < end; ++i) {
        struct doc_variant *variant = &variants[doc->num_variants];
        *variant = (struct doc_variant){.index = i, .def = {sizeof variant->def}};
        if (mxg_library_nodedef(library, i, &variant->def) == MXG_OK)
            variants[doc->num_variants++].signature = signature(doc, variant);
    }
    qsort(variants, doc->num_variants, sizeof *variants, compare_variants);
    doc->nodes = doc_alloc(doc, doc->num_variants * sizeof *doc->nodes);
    for (size_t i = 0; i < doc->num_variants;) {
        size_t len = 1;
        while (i + len < doc->num_variants && is_same_node(&variants[i], &variants[i + len]))
            ++len;
        add_node(doc, &variants[i], len);
        i += len;
    }
}
