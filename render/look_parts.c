// SPDX-License-Identifier: Apache-2.0
#include "render/look_parts.h"

#include "render/bake_plan.h"

#include <string.h>

static bool changes_inputs(const mxg_document *document, mxg_element part, const char *category)
{
    return strcmp(category, "variantassign") == 0
           || (strcmp(category, "materialassign") == 0
               && bake_attribute(document, part, "nodegraph"));
}

void look_parts(const mxg_document *document, const char *look,
                void (*tell)(void *user_data, const char *look, const mxg_element_info *part),
                void *user_data)
{
    enum { MAX_LOOKS = 100 }; /* a circle of looks is told as such */
    for (unsigned i = 0; look && *look && i < MAX_LOOKS; ++i) {
        mxg_element element = mxg_document_find_element(document, 0, look);
        if (!element)
            return;
        mxg_element_info info = bake_element(document, element);
        for (mxg_element part = info.first_child; part; part = info.next) {
            info = bake_element(document, part);
            if (changes_inputs(document, part, info.category))
                tell(user_data, look, &info);
        }
        look = bake_attribute(document, element, "inherit");
    }
}
