// SPDX-License-Identifier: Apache-2.0
/*
 * XInclude (W3C, 1.1) as MaterialX uses it: the top-level elements of a whole document replace the
 * <xi:include>.
 */
#include "xml/xml_priv.h"

#include <assert.h>

static struct xml_file *find_opened(struct xml_reader *reader, str_id name)
{
    for (uint32_t i = 0; i < reader->opened.len; i++)
        if (reader->opened.items[i].name == name)
            return &reader->opened.items[i];
    return NULL;
}

static str_id attr_by_text(const struct document *doc, elem_id element, const char *name)
{
    str_id id = str_find(doc->strings, name, strlen(name));
    return id ? doc_attr_value(doc, element, id) : STR_EMPTY;
}

/* The place of the attribute href, or of the element if it is absent. */
static struct diag_place href_place(const struct document *doc, elem_id include)
{
    return doc_attr_place(doc, include, str_find(doc->strings, "href", 4));
}

/* Reports "a.mtlx, b.mtlx, a.mtlx": the open files from the one that is included again. */
static void report_cycle(struct xml_reader *reader, elem_id include, const char *name)
{
    struct strpool *strings = reader->doc->strings;
    struct text path;
    text_init(&path, &reader->scratch);
    bool inside = false;
    for (uint32_t i = 0; i < reader->opened.len; i++) {
        const char *file = str_text(strings, reader->opened.items[i].name);
        inside |= strcmp(file, name) == 0;
        if (inside && reader->opened.items[i].open) {
            text_str(&path, file);
            text_str(&path, " includes ");
        }
    }
    text_str(&path, name);
    diag_add(reader->diags, DIAG_ID_include_cycle, href_place(reader->doc, include), name,
             text_cstr(&path));
}

/* Replaces an unreadable include by the content of its <xi:fallback>. */
static bool use_fallback(struct document *doc, elem_id include)
{
    str_id fallback = str_find(doc->strings, "xi:fallback", 11);
    elem_id child = doc_element(doc, include)->first_child;
    while (child && doc_element(doc, child)->category != fallback)
        child = doc_element(doc, child)->next;
    if (!child)
        return false;
    for (elem_id moved; (moved = doc_element(doc, child)->first_child) != 0;)
        doc_move_before(doc, moved, include);
    return true;
}

static void include_opened(struct xml_reader *reader, elem_id include, const char *name,
                           const char *data, size_t size)
{
    struct document *doc = reader->doc;
    str_id id = str_intern_z(doc->strings, name);
    const struct xml_file *opened = find_opened(reader, id);
    if (opened) {
        xml_close_file(reader);
        if (opened->open)
            report_cycle(reader, include, name);
        return; /* otherwise the file is already included */
    }
    uint32_t index = reader->opened.len, num_errors = reader->diags->num_errors;
    vec_push(&reader->scratch, &reader->opened, (struct xml_file){id, true});
    reader->include_depth++;
    elem_id root = xml_read_text(reader, name, doc_add_file(doc, id), 0, data, size);
    reader->include_depth--;
    assert(index < reader->opened.len && reader->opened.items[index].open);
    reader->opened.items[index].open = false;
    if (root)
        xml_merge_root(doc, root, 0, include);
    if (reader->diags->num_errors != num_errors)
        diag_add(reader->diags, DIAG_ID_include_from, doc_place(doc, include));
}

static void process(struct xml_reader *reader, const struct xml_source *source, elem_id include)
{
    assert(!reader->handle_open && reader->include_depth <= reader->limits.max_include_depth);
    struct document *doc = reader->doc;
    str_id said = attr_by_text(doc, include, "href");
    const char *href = str_text(
        doc->strings, doc_fix_path(doc->strings, said, href_place(doc, include), reader->diags));
    const char *parse = str_text(doc->strings, attr_by_text(doc, include, "parse"));
    const char *name, *data, *reason;
    size_t size;
    if (attr_by_text(doc, include, "xpointer"))
        diag_add(reader->diags, DIAG_ID_include_part, doc_place(doc, include), "xpointer");
    else if (*parse && strcmp(parse, "xml") != 0)
        diag_add(reader->diags, DIAG_ID_include_part, doc_place(doc, include), "parse=\"text\"");
    else if (!*href)
        diag_add(reader->diags, DIAG_ID_include_no_href, doc_place(doc, include));
    else if (reader->include_depth >= reader->limits.max_include_depth)
        diag_add(reader->diags, DIAG_ID_include_depth, href_place(doc, include),
                 (unsigned)reader->limits.max_include_depth);
    else if (reader->opened.len > reader->limits.max_includes)
        diag_add(reader->diags, DIAG_ID_too_many_includes, href_place(doc, include),
                 (unsigned)reader->limits.max_includes);
    else if (xml_open_file(reader, source->name, href, &name, &data, &size, &reason))
        include_opened(reader, include, name, data, size);
    else if (!use_fallback(doc, include))
        diag_add(reader->diags, DIAG_ID_include_missing, href_place(doc, include), href, reason);
}

void xml_process_includes(struct xml_reader *reader, const struct xml_source *source,
                          uint32_t first)
{
    uint32_t end = reader->includes.len;
    assert(first <= end);
    for (uint32_t i = first; i < end; i++) {
        elem_id include = reader->includes.items[i];
        if (!doc_is_within(reader->doc, include, source->root))
            continue; /* it was inside an unused fallback, which has left the tree */
        process(reader, source, include);
        assert(reader->includes.len == end);
        doc_remove_element(reader->doc, include);
    }
}
