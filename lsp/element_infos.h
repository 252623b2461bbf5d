// SPDX-License-Identifier: Apache-2.0
/* MaterialX's own elements and attributes with a line about each (elements.def, attributes.def). */
#ifndef MXG_LSP_ELEMENT_INFOS_H
#define MXG_LSP_ELEMENT_INFOS_H

#include <stdbool.h>
#include <stddef.h>

struct element_info {
    const char *category;
    const char *parents; /* words: categories, "node" for any node */
    const char *doc;
};
extern const struct element_info element_infos[];
extern const size_t num_element_infos;

struct attribute_info {
    const char *name;
    const char *elements; /* words: categories, "node" for any node; "*": all */
    const char *doc;
};
extern const struct attribute_info attribute_infos[];
extern const size_t num_attribute_infos;

/* NULL: there is none; an element of this category is a node. */
const struct element_info *elements_find(const char *category);
/* NULL: there is none. */
const struct attribute_info *attributes_find(const char *name);
/* True if a list of words has the category, or "node" where the category names a node, or "*". */
bool elements_fit(const char *words, const char *category);

#endif
