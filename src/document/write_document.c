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

static void write_text_attr(const char *name, const char *value, size_t len, struct text *out)
{
    text_char(out, ' ');
    text_str(out, name);
    text_str(out, "=\"");
    write_escaped(out, value, len);
    text_char(out, '"');
}

static void write_attr(const struct document *doc, str_id name, str_id value, struct text *out)
{
    write_text_attr(str_text(doc->strings, name), str_text(doc->strings, value),
                    str_len(doc->strings, value), out);
}

static void indent(struct text *out, uint32_t depth)
{
    while (depth--)
        text_str(out, "  ");
}

/*
 * Blank lines as the reader counts them, also where elements between them are gone: several count
 * as one, and those at the begin and at the end of an element do not count.
 */
struct layout {
    bool is_first;  /* nothing stands in the element yet */
    bool has_blank; /* a blank line comes before what follows */
};

static void begin_line(struct layout *layout, struct text *out)
{
    if (layout->has_blank)
        text_char(out, '\n');
    *layout = (struct layout){0};
}

/* Comments and blank lines on lines of their own. */
static void write_comments(const struct document *doc, elem_id element, enum comment_place place,
                           uint32_t depth, struct layout *layout, struct text *out)
{
    for (uint32_t i = doc_first_comment(doc, element, place); i; i = doc_comment_at(doc, i)->next) {
        str_id text = doc_comment_at(doc, i)->text;
        if (!text) {
            layout->has_blank = !layout->is_first;
            continue;
        }
        begin_line(layout, out);
        indent(out, depth);
        text_str(out, str_text(doc->strings, text));
        text_char(out, '\n');
    }
}

static void end_line(const struct document *doc, elem_id element, struct text *out)
{
    for (uint32_t i = doc_first_comment(doc, element, COMMENT_BEHIND); i;
         i = doc_comment_at(doc, i)->next) {
        text_char(out, element != doc->root ? ' ' : '\n');
        text_str(out, str_text(doc->strings, doc_comment_at(doc, i)->text));
    }
    text_char(out, '\n');
}

/* True if an element below the root has the prefix "xi", which the reader gives to XInclude. */
static bool has_includes(const struct document *doc, elem_id root)
{
    str_id include = str_find(doc->strings, "xi:include", 10);
    elem_id at = root;
    while (at && include && doc_element(doc, at)->category != include)
        at = doc_next_in_tree(doc, root, at);
    return at && include;
}

static bool has_content(const struct document *doc, elem_id element)
{
    uint32_t last = doc_first_comment(doc, element, COMMENT_LAST);
    while (last && !doc_comment_at(doc, last)->text)
        last = doc_comment_at(doc, last)->next;
    return doc_element(doc, element)->first_child || last;
}

static void write_start_tag(const struct document *doc, elem_id element, uint32_t depth,
                            struct layout *layout, struct text *out)
{
    const struct element *e = doc_element(doc, element);
    write_comments(doc, element, COMMENT_BEFORE, depth, layout, out);
    begin_line(layout, out);
    layout->is_first = has_content(doc, element);
    indent(out, depth);
    text_char(out, '<');
    text_str(out, str_text(doc->strings, e->category));
    if (e->name)
        write_attr(doc, STR_name, e->name, out);
    const struct attribute *attrs = doc_attrs(doc, element);
    bool declares_xi = element == doc->root && has_includes(doc, element);
    const char *prefix =
        e->file != doc_element(doc, doc->root)->file
            ? doc_prefix_from(doc, element, doc_place(doc, doc->root).file, out->arena)
            : NULL;
    for (uint32_t i = 0; i < e->num_attrs; i++) {
        bool is_xi = declares_xi && strcmp(str_text(doc->strings, attrs[i].name), "xmlns:xi") == 0,
             is_prefix = prefix && attrs[i].name == STR_fileprefix;
        if (!is_xi && !is_prefix)
            write_attr(doc, attrs[i].name, attrs[i].value, out);
    }
    if (declares_xi)
        text_str(out, " xmlns:xi=\"http://www.w3.org/2001/XInclude\"");
    if (prefix)
        write_text_attr("fileprefix", prefix, strlen(prefix), out);
    if (has_content(doc, element)) {
        text_str(out, ">\n");
    } else {
        text_str(out, "/>");
        end_line(doc, element, out);
    }
}

static void write_end_tag(const struct document *doc, elem_id element, uint32_t depth,
                          struct layout *layout, struct text *out)
{
    write_comments(doc, element, COMMENT_LAST, depth + 1, layout, out);
    *layout = (struct layout){0};
    indent(out, depth);
    text_fmt(out, "</%s>", str_text(doc->strings, doc_element(doc, element)->category));
    end_line(doc, element, out);
}

void doc_write_part(const struct document *doc, elem_id root, const struct doc_choice *choice,
                    struct text *out)
{
    uint32_t depth = 0;
    struct layout layout = {0};
    if (!doc_element(doc, root)->parent)
        text_str(out, "<?xml version=\"1.0\"?>\n");
    for (elem_id element = root, next; element; element = next) {
        bool is_left_out = choice && depth == 1 && !choice->take(choice->user_data, element, out);
        if (!is_left_out)
            write_start_tag(doc, element, depth, &layout, out);
        next = is_left_out ? 0 : doc_element(doc, element)->first_child;
        if (next) {
            depth++;
            continue;
        }
        if (!is_left_out && has_content(doc, element))
            write_end_tag(doc, element, depth, &layout, out);
        while (element != root && !(next = doc_next_written(doc, element))) {
            element = doc_parent_written(doc, element);
            assert(depth > 0);
            write_end_tag(doc, element, --depth, &layout, out);
        }
    }
}

void doc_write(const struct document *doc, elem_id root, struct text *out)
{
    doc_write_part(doc, root, NULL, out);
}
