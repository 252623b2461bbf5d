// SPDX-License-Identifier: Apache-2.0
#include "render/look_parts.h"

#include <string.h>

static const char *attribute_of(const mxg_document *document, mxg_element element, const char *name)
{
    mxg_attribute attribute = {sizeof attribute};
    uint32_t index = mxg_document_find_attribute(document, element, name);
    return mxg_document_attribute(document, element, index, &attribute) == MXG_OK ? attribute.value
                                                                                  : NULL;
}

static bool changes_inputs(const mxg_document *document, mxg_element part, const char *category)
{
    return strcmp(category, "variantassign") == 0
           || (strcmp(category, "materialassign") == 0
               && attribute_of(document, part, "nodegraph"));
}

void look_parts(const mxg_document *document, const char *look,
                void (*tell)(void *user_data, const char *look, const mxg_element_info *part),
                void *user_data)
{
    enum { MAX_LOOKS = 100 }; /* a circle of looks is told as such */
    for (unsigned i = 0; look && *look && i < MAX_LOOKS; ++i) {
        mxg_element element = mxg_document_find_element(document, 0, look);
        mxg_element_info info = {sizeof info};
        if (!element)
            return;
        mxg_document_element(document, element, &info);
        for (mxg_element part = info.first_child; part; part = info.next) {
            mxg_document_element(document, part, &info);
            if (changes_inputs(document, part, info.category))
                tell(user_data, look, &info);
        }
        look = attribute_of(document, element, "inherit");
    }
}
