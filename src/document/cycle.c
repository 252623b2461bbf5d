// SPDX-License-Identifier: Apache-2.0
/* Reports a cycle of nodes, the same for every walk that finds it. */
#include "document/document.h"

#include <assert.h>

enum { MAX_TOLD = 16 }; /* nodes of a cycle that the message names */

static struct diag_place link_place(const struct document *doc, elem_id port)
{
    for (size_t i = 0; i < DOC_NUM_CONNECTIONS; i++)
        if (doc_attr(doc, port, doc_connections[i]))
            return doc_attr_place(doc, port, doc_connections[i]);
    return doc_place(doc, port);
}

/* The upgrade of old documents makes nodes that the text does not have. */
static bool is_in_text(const struct document *doc, elem_id node)
{
    return doc_name_place(doc, node).column != doc_place(doc, node).column;
}

/* Leaves out nodes that are not in the text, unless none is. */
static uint32_t keep_text(const struct document *doc, struct doc_cycle_link *links, uint32_t n)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < n; i++)
        if (is_in_text(doc, links[i].node))
            links[kept++] = links[i];
    return kept ? kept : n;
}

/* The message follows the data: links[i] reads links[i + 1], so the data runs to lower indices. */
void doc_report_cycle(const struct document *doc, struct doc_cycle_link *links, uint32_t n,
                      struct diag_list *diags)
{
    assert(n > 0);
    n = keep_text(doc, links, n);
    uint32_t first = 0;
    for (uint32_t i = 1; i < n; i++)
        if (links[i].node < links[first].node)
            first = i;
    uint32_t told = n < MAX_TOLD ? n : MAX_TOLD;
    struct text path;
    text_init(&path, diags->arena);
    for (uint32_t i = 0; i < told; i++)
        text_fmt(&path, "%s -> ", doc_name(doc, links[(first + n - i) % n].node));
    text_str(&path, told < n ? "…" : doc_name(doc, links[first].node));
    diag_add(diags, DIAG_ID_cycle, doc_name_place(doc, links[first].node), text_cstr(&path));
    for (uint32_t i = 0; i < told; i++) {
        const struct doc_cycle_link *source = &links[(first + n - i) % n],
                                    *reader = &links[(first + 2 * n - i - 1) % n];
        diag_add(diags, DIAG_ID_reads, link_place(doc, reader->port), doc_name(doc, reader->node),
                 doc_name(doc, source->node));
    }
}
