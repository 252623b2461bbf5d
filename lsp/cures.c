// SPDX-License-Identifier: Apache-2.0
#include "lsp/cures.h"

#include <string.h>

static const struct cure {
    const char *id;
    enum lsp_tag tag;
} cures[] = {
#define CURE(id, tag) {id, tag},
#include "lsp/cures.def"
#undef CURE
};

enum lsp_tag cures_tag(const char *id)
{
    for (size_t i = 0; i < sizeof cures / sizeof *cures; ++i)
        if (strcmp(cures[i].id, id) == 0)
            return cures[i].tag;
    return LSP_NO_TAG;
}
