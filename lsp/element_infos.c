// SPDX-License-Identifier: Apache-2.0
#include "lsp/element_infos.h"

#include <string.h>

const struct element_info element_infos[] = {
#define ELEMENT(category, parents, doc) {category, parents, doc},
#include "lsp/elements.def"
#undef ELEMENT
};
const size_t num_element_infos = sizeof element_infos / sizeof *element_infos;

const struct attribute_info attribute_infos[] = {
#define ATTRIBUTE(name, elements, doc) {name, elements, doc},
#include "lsp/attributes.def"
#undef ATTRIBUTE
};
const size_t num_attribute_infos = sizeof attribute_infos / sizeof *attribute_infos;

const struct element_info *elements_find(const char *category)
{
    for (size_t i = 0; i < num_element_infos; ++i)
        if (strcmp(element_infos[i].category, category) == 0)
            return &element_infos[i];
    return NULL;
}

const struct attribute_info *attributes_find(const char *name)
{
    for (size_t i = 0; i < num_attribute_infos; ++i)
        if (strcmp(attribute_infos[i].name, name) == 0)
            return &attribute_infos[i];
    return NULL;
}

static bool has_word(const char *words, const char *word)
{
    size_t len = strlen(word);
    for (const char *at = words; *at;) {
        size_t part = strcspn(at, " ");
        if (part == len && memcmp(at, word, len) == 0)
            return true;
        at += part + (at[part] == ' ');
    }
    return false;
}

bool elements_fit(const char *words, const char *category)
{
    return has_word(words, "*") || has_word(words, elements_find(category) ? category : "node");
}
