// SPDX-License-Identifier: Apache-2.0
/*
 * File names with backslashes, which programs on Windows write. MaterialX reads '/' and '\\' alike,
 * but only Windows opens such a file.
 */
#include "document/document.h"

str_id doc_fix_path(struct strpool *strings, str_id path, struct diag_place where,
                    struct diag_list *diags)
{
    const char *text = str_text(strings, path);
    if (!strchr(text, '\\'))
        return path;
    char *fixed = arena_strndup(diags->arena, text, str_len(strings, path));
    for (char *c = fixed; (c = strchr(c, '\\')) != NULL;)
        *c = '/';
    diag_add(diags, DIAG_ID_backslash, where, text, fixed);
    return str_intern(strings, fixed, str_len(strings, path));
}

static bool is_path(const struct document *doc, elem_id element, str_id attr)
{
    return attr == STR_fileprefix || attr == STR_file
           || (attr == STR_value && doc_attr_value(doc, element, STR_type) == STR_filename);
}

void doc_fix_paths_of(struct document *doc, elem_id element, struct diag_list *diags)
{
    for (uint32_t i = 0; i < doc_element(doc, element)->num_attrs; i++) {
        struct attribute attr = doc_attrs(doc, element)[i];
        if (!is_path(doc, element, attr.name))
            continue;
        str_id fixed =
            doc_fix_path(doc->strings, attr.value, doc_attr_place(doc, element, attr.name), diags);
        if (fixed != attr.value)
            doc_set_attr(doc, element, attr.name, fixed);
    }
}

void doc_fix_paths(struct document *doc, struct diag_list *diags)
{
    for (elem_id e = doc->root; e; e = doc_next_in_tree(doc, doc->root, e))
        doc_fix_paths_of(doc, e, diags);
}
