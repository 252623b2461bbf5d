// SPDX-License-Identifier: Apache-2.0
/* The text as `mxgen format` writes it, as an edit of the lines that differ. */
#include "lsp/formatting.h"

#include "lsp/handlers.h"
#include "lsp/wire.h"
#include "program/cli.h"
#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

/* The part without the lines that both texts begin and end with. */
static struct span differing(const struct text *old, const char *bytes, size_t size,
                             struct span *out_new)
{
    uint32_t start = 0, end = 0, len = (uint32_t)size, least = len < old->len ? len : old->len;
    while (start < least && old->bytes[start] == bytes[start])
        ++start;
    while (start > 0 && old->bytes[start - 1] != '\n')
        --start;
    while (end < least - start && old->bytes[old->len - 1 - end] == bytes[len - 1 - end])
        ++end;
    while (end > 0 && old->bytes[old->len - end] != '\n')
        --end;
    if (end > 0 && end < old->len && old->bytes[old->len - end - 1] == '\r')
        --end; /* no position is between the bytes of a line end */
    *out_new = (struct span){start, len - end};
    return (struct span){start, old->len - end};
}

/* A copy with the line ends that the document has: those of its first line. */
static char *with_line_ends(const struct text *old, const char *bytes, size_t *size)
{
    const char *end = memchr(old->bytes, '\n', old->len);
    bool is_crlf = end && end > old->bytes && end[-1] == '\r';
    size_t num = 0, len = 0;
    for (size_t i = 0; i < *size; ++i)
        num += is_crlf && bytes[i] == '\n';
    char *made = memory_alloc(*size + num + 1);
    for (size_t i = 0; i < *size; ++i) {
        if (is_crlf && bytes[i] == '\n')
            made[len++] = '\r';
        made[len++] = bytes[i];
    }
    *size = len;
    return made;
}

json_t *formatting_edits(const struct lsp_query *query, mxg_rewriting rewriting)
{
    mxg_result *result = NULL;
    size_t size = 0;
    mxg_rewrite(query->session->context, rewriting, query->document->path, query->text->bytes,
                query->text->len, &result);
    const char *written = result ? mxg_result_text(result, &size) : NULL;
    char *bytes = written ? with_line_ends(query->text, written, &size) : NULL;
    json_t *edits = bytes ? json_array() : NULL;
    if (bytes && (size != query->text->len || memcmp(bytes, query->text->bytes, size) != 0)) {
        struct span changed, old = differing(query->text, bytes, size, &changed);
        char *text = cli_copy(bytes + changed.start, changed.end - changed.start);
        json_array_append_new(edits, wire_edit(query->session, query->text, old, text));
        free(text);
    }
    free(bytes);
    mxg_result_destroy(result);
    return edits;
}

json_t *handle_formatting(struct lsp_session *session, const json_t *params,
                          struct lsp_error *error)
{
    struct lsp_query query;
    if (!lsp_query(session, params, &query, error))
        return NULL;
    return formatting_edits(&query, MXG_REWRITE_FORMAT);
}
