// SPDX-License-Identifier: Apache-2.0
#include "xml/xml_priv.h"

#include <assert.h>
#include <libxml/parser.h>

/* Files */

bool xml_open_file(struct xml_reader *reader, const char *from, const char *ref,
                   const char **out_name, const char **out_data, size_t *out_size,
                   const char **out_reason)
{
    assert(!reader->handle_open);
    const struct xml_files *files = reader->files;
    const char *name = NULL, *reason = NULL;
    reader->handle_open = files
                          && files->open(files->user_data, from, ref, &name, out_data, out_size,
                                         &reader->handle, &reason);
    *out_reason = reason ? reason : "the context cannot read files";
    *out_name = name ? arena_strndup(&reader->scratch, name, strlen(name)) : NULL;
    return reader->handle_open;
}

void xml_close_file(struct xml_reader *reader)
{
    if (reader->handle_open)
        reader->files->release(reader->files->user_data, reader->handle);
    reader->handle_open = false;
}

static const str_id scope_attrs[] = {STR_colorspace, STR_fileprefix, STR_geomprefix, STR_namespace};

/*
 * Moves the scope attributes of a root to a child. An absent namespace means the global one, even
 * inside a document with a namespace.
 */
static void carry_scope(struct document *doc, elem_id root, elem_id child, bool into_namespace)
{
    for (size_t i = 0; i < sizeof scope_attrs / sizeof *scope_attrs; i++) {
        str_id name = scope_attrs[i];
        const struct attribute *scope = doc_attr(doc, root, name);
        if ((scope || (name == STR_namespace && into_namespace)) && !doc_attr(doc, child, name))
            doc_add_attr(
                doc, child,
                (struct attribute){.name = name, .value = scope ? scope->value : STR_EMPTY});
    }
}

void xml_merge_root(struct document *doc, elem_id root, elem_id parent, elem_id sibling)
{
    assert(!doc_element(doc, root)->parent);
    bool into_namespace =
        doc_inherited_attr(doc, sibling ? sibling : parent, STR_namespace) != STR_EMPTY;
    for (elem_id child = doc_element(doc, root)->first_child; child;
         child = doc_element(doc, root)->first_child) {
        carry_scope(doc, root, child, into_namespace);
        if (sibling)
            doc_move_before(doc, child, sibling);
        else
            doc_move_element(doc, child, parent);
    }
}

elem_id xml_read_text(struct xml_reader *reader, const char *name, uint16_t file, elem_id root,
                      const char *data, size_t size)
{
    struct document *doc = reader->doc;
    struct xml_source source = {.name = name, .file = file, .root = root}, *outer = reader->source;
    if (size > (uint64_t)reader->limits.max_file_mib << 20) {
        struct diag_place place = {.file = name};
        diag_add(reader->diags, DIAG_ID_file_too_large, place, name,
                 (unsigned)reader->limits.max_file_mib);
        return 0;
    }
    if (!root)
        source.root = doc_add_element(doc, 0, STR_materialx, STR_EMPTY, file, 1, 1);
    uint32_t first_include = reader->includes.len;
    reader->source = &source;
    bool parsed = xml_prepare_text(reader, data, size) && xml_parse_source(reader);
    reader->source = outer;
    xml_close_file(reader); /* the text is no longer needed; only one file is open at a time */
    elem_id end = doc->first_element + doc->elements.len;
    if (parsed) {
        if (reader->limits.steps == XML_ALL_STEPS)
            xml_process_includes(reader, &source, first_include);
        if (reader->limits.steps != XML_NO_STEPS)
            doc_upgrade(doc, source.root, end, reader->diags);
    }
    assert(reader->includes.len >= first_include && reader->source == outer);
    reader->includes.len = first_include;
    return parsed ? source.root : 0;
}

/* Reading as a whole */

struct reading {
    struct xml_reader reader;
    const char *name, *data; /* data NULL: the file `name` */
    size_t size;
};

static void set_defaults(struct xml_limits *limits, const struct xml_limits *given)
{
    *limits = given ? *given : (struct xml_limits){0};
    if (limits->max_depth == 0 || limits->max_depth > 200)
        limits->max_depth = limits->max_depth ? 200 : 128; /* libxml2 has a limit of 256 */
    if (limits->max_include_depth == 0 || limits->max_include_depth > 200)
        limits->max_include_depth = limits->max_include_depth ? 200 : 16;
    if (limits->max_includes == 0)
        limits->max_includes = 4096;
    if (limits->max_elements == 0)
        limits->max_elements = 16000000;
    if (limits->max_file_mib == 0)
        limits->max_file_mib = 256;
}

/*
 * The first file of a document fills its root; the children of further files join them, like an
 * include.
 */
static void read_data(struct reading *reading, const char *name, uint16_t file)
{
    struct xml_reader *reader = &reading->reader;
    struct document *doc = reader->doc;
    const struct element *root = doc_element(doc, doc->root);
    bool is_first = !root->first_child && !root->num_attrs && !root->file;
    vec_push(&reader->scratch, &reader->opened,
             (struct xml_file){str_intern_z(doc->strings, name), true});
    elem_id added =
        xml_read_text(reader, name, file, is_first ? doc->root : 0, reading->data, reading->size);
    if (added && !is_first)
        xml_merge_root(doc, added, doc->root, 0);
}

static void read_file(struct reading *reading)
{
    struct xml_reader *reader = &reading->reader;
    const char *canonical, *reason;
    if (!xml_open_file(reader, "", reading->name, &canonical, &reading->data, &reading->size,
                       &reason)) {
        enum diag_id id = canonical ? DIAG_ID_file_unreadable : DIAG_ID_file_missing;
        diag_add(reader->diags, id, (struct diag_place){.file = reading->name}, reading->name,
                 reason);
        return;
    }
    read_data(reading, canonical,
              doc_add_file(reader->doc, str_intern_z(reader->doc->strings, reading->name)));
}

static void read_all(void *arg)
{
    struct reading *reading = arg;
    struct xml_reader *reader = &reading->reader;
    struct document *doc = reader->doc;
    doc->max_elements = reader->limits.max_elements;
    if (reading->data)
        read_data(reading, reading->name,
                  doc_add_file(doc, str_intern_z(doc->strings, reading->name)));
    else
        read_file(reading);
    if (reader->limits.steps == XML_ALL_STEPS)
        doc_complete(doc, reader->diags);
}

static bool read_guarded(struct reading *reading, const struct xml_limits *limits)
{
    struct xml_reader *reader = &reading->reader;
    reader->mem = reader->doc->arena->mem;
    set_defaults(&reader->limits, limits);
    arena_init(&reader->scratch, reader->mem);
    uint32_t num_errors = reader->diags->num_errors;
    bool done = mem_try(reader->mem, read_all, reading);
    xml_close_file(reader);
    xmlFreeParserCtxt(reader->parser);
    arena_finish(&reader->scratch);
    if (!done)
        mem_fail(reader->mem);
    return reader->diags->num_errors == num_errors;
}

bool xml_read_file(struct document *doc, const struct xml_files *files,
                   const struct xml_limits *limits, const char *name, struct diag_list *diags)
{
    struct reading reading = {.reader = {.doc = doc, .files = files, .diags = diags}, .name = name};
    return read_guarded(&reading, limits);
}

bool xml_read_memory(struct document *doc, const struct xml_files *files,
                     const struct xml_limits *limits, const char *name, const char *data,
                     size_t size, struct diag_list *diags)
{
    struct reading reading = {.reader = {.doc = doc, .files = files, .diags = diags},
                              .name = name,
                              .data = data ? data : "",
                              .size = size};
    return read_guarded(&reading, limits);
}
