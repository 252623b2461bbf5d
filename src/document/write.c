// SPDX-License-Identifier: Apache-2.0
#include "document/document.h"

#include <assert.h>

static void write_escaped(struct text *out, const char *value, size_t len)
{
    static const char special[] = "&<>\"\n\r\t";
    static const char *const entities[] = {"&amp;", "&lt;",  "&gt;", "&quot;",
                                           "&#10;", "&#13;", "&#9;"};
    for (size_t i = 0; i < len; i++) {
        const char *found = value[i] ? strchr(special, value[i]) : NULL;
        if (found)
            text_str(out, entities[found - special]);
        else
            text_char(out, value[i]);
    }
}

static void write_attr(const struct document *doc, str_id name, str_id value, struct text *out)
{
    text_char(out, ' ');
    text_str(out, str_text(doc->strings, name));
    text_str(out, "=\"");
    write_escaped(out, str_text(doc->strings, value), str_len(doc->strings, value));
    text_char(out, '"');
}

static void indent(struct text *out, uint32_t depth)
{
    while (depth--)
        text_str(out, "  ");
}

static void write_start_tag(const struct document *doc, elem_id element, struct text *out)
{
    const struct element *e = doc_element(doc, element);
    text_char(out, '<');
    text_str(out, str_text(doc->strings, e->category));
    if (e->name)
        write_attr(doc, STR_name, e->name, out);
    const struct attribute *attrs = doc_attrs(doc, element);
    for (uint32_t i = 0; i < e->num_attrs; i++)
        write_attr(doc, attrs[i].name, attrs[i].value, out);
    text_str(out, e->first_child ? ">\n" : "/>\n");
}

void doc_write(const struct document *doc, elem_id root, struct text *out)
{
    uint32_t depth = 0;
    if (!doc_element(doc, root)->parent)
        text_str(out, "<?xml version=\"1.0\"?>\n");
    for (elem_id element = root, next; element; element = next) {
        indent(out, depth);
        write_start_tag(doc, element, out);
        next = doc_element(doc, element)->first_child;
        if (next) {
            depth++;
            continue;
        }
        while (element != root && !(next = doc_element(doc, element)->next)) {
            element = doc_element(doc, element)->parent;
            assert(depth > 0);
            indent(out, --depth);
            text_fmt(out, "</%s>\n", str_text(doc->strings, doc_element(doc, element)->category));
        }
    }
}
