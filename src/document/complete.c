// SPDX-License-Identifier: Apache-2.0
/* The steps that every complete tree takes, whether a file or an edit made it. */
#include "document/document.h"

void doc_complete(struct document *doc, struct diag_list *diags)
{
    doc_expand_templates(doc, diags);
    doc_rewrite_aovs(doc);
    doc_fix_paths(doc, diags);
    doc_qualify_names(doc, diags);
    doc_index_names(doc, diags);
    doc_inherit_values(doc, diags);
    doc_index_references(doc);
    doc_index_outputs(doc);
}
