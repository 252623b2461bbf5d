// SPDX-License-Identifier: Apache-2.0
/* Source for one target, which mxgen copies into the shader. */
#include "library/index_priv.h"

#include <assert.h>

static bool ends_with(const char *text, const char *end)
{
    size_t n = strlen(text), m = strlen(end);
    return n >= m && strcmp(text + n - m, end) == 0;
}

bool index_is_inline(const struct indexer *ix, str_id file)
{
    return ends_with(index_text(ix, file), ".inline");
}

str_id index_read_source(struct indexer *ix, elem_id element, str_id file, struct diag_list *diags)
{
    const char *name, *text, *reason = "the context cannot read files";
    size_t len;
    if (!ix->reader
        || !ix->reader->read(ix->reader->user_data, index_file(ix, element), index_text(ix, file),
                             &name, &text, &len, &reason)) {
        diag_add(diags, DIAG_ID_missing_source_file,
                 doc_attr_place(&ix->lib->doc, element, STR_file), index_text(ix, file),
                 index_text(ix, doc_element(&ix->lib->doc, element)->name), reason);
        return 0;
    }
    return str_intern(&ix->lib->strings, text, len);
}

/* Keeps the first fault: the reason why the source is not portable. */
static void keep_reason(struct indexer *ix, struct verbatim *verbatim,
                        const struct diag_list *faults)
{
    if (!faults->items.len)
        return;
    const struct diag *first = &faults->items.items[0];
    verbatim->reason = str_intern_z(&ix->lib->strings, first->message);
    if (first->place.file)
        verbatim->reason_file = str_intern_z(&ix->lib->strings, first->place.file);
    verbatim->reason_line = first->place.line;
    verbatim->reason_column = first->place.column;
}

bool index_verbatim(struct indexer *ix, struct implementation *impl, const struct diag_list *faults)
{
    str_id file = index_attr(ix, impl->element, STR_file);
    struct diag_list unread;
    diag_list_init(&unread, ix->arena);
    struct verbatim verbatim = {
        .source = file ? index_read_source(ix, impl->element, file, &unread)
                       : index_attr(ix, impl->element, STR_sourcecode),
        .function =
            file && !index_is_inline(ix, file) ? index_attr(ix, impl->element, STR_function) : 0};
    if (!verbatim.source)
        return false;
    keep_reason(ix, &verbatim, faults);
    impl->kind = IMPL_VERBATIM;
    impl->ref = ix->lib->base_verbatims + ix->lib->verbatims.len;
    vec_push(ix->arena, &ix->lib->verbatims, verbatim);
    return true;
}
