// SPDX-License-Identifier: Apache-2.0
#include "document/document.h"

void doc_upgrade(struct document *doc, elem_id root, elem_id end, struct diag_list *diags)
{
    (void)doc, (void)root, (void)end, (void)diags;
}
