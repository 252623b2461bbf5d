// SPDX-License-Identifier: Apache-2.0
#include "lsp/family.h"

#include "lsp/check_document.h"
#include "lsp/named_elements.h"
#include "lsp/system.h"
#include "lsp/wire.h"
#include "program/cli.h"
#include "program/files.h"
#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

/* A workspace may be a whole disk. */
enum { MAX_FILES = 2000, MAX_FOLDERS = 4000 };

/* The text of a document without a place in it. */
static struct lsp_query query_of(struct lsp_session *session, struct lsp_document *document)
{
    return (struct lsp_query){session, document, &document->text, &document->model, 0};
}

/* ---- Files ---- */

static struct family_file *find(const struct family *family, const char *path)
{
    for (size_t i = 0; i < family->num_files; ++i)
        if (strcmp(family->files[i].document->path, path) == 0)
            return &family->files[i];
    return NULL;
}

static void list_includes(struct lsp_session *session, struct family_file *file)
{
    const struct lsp_query query = query_of(session, file->document);
    for (uint32_t i = 0; i < query.model->num_elements; ++i) {
        struct span href = query_is(&query, i, "xi:include") ? query_value(&query, i, "href")
                                                             : (struct span){0, 0};
        if (href.start == href.end)
            continue;
        char *name = cli_copy(query.text->bytes + href.start, href.end - href.start);
        args_append(&file->includes, disk_join(file->document->path, name));
        free(name);
    }
}

static void add(struct lsp_session *session, struct family *family, struct lsp_document *document,
                bool is_own)
{
    MEMORY_PUSH(family->files, family->num_files,
                (struct family_file){.document = document, .is_own = is_own});
    list_includes(session, &family->files[family->num_files - 1]);
}

/* Adds a file of the disk that the session may read and the family does not have. */
static void add_path(struct lsp_session *session, struct family *family, const char *path)
{
    size_t size = 0;
    char *bytes = family->num_files < MAX_FILES && !find(family, path)
                      ? disk_read(&session->disk, path, 0, &size)
                      : NULL;
    if (!bytes || size > TEXT_MAX) {
        free(bytes);
        return;
    }
    struct lsp_document *document = memory_alloc(sizeof *document);
    document->uri = wire_uri(path);
    document->path = cli_copy(path, strlen(path));
    document->is_file = true;
    text_set(&document->text, bytes, size);
    model_read(&document->model, &document->text);
    add(session, family, document, true);
    free(bytes);
}

/*
 * Adds the documents in a folder, and the folders in it to the list. A link to a folder leads to
 * files outside, or to files that the walk meets under their own names.
 */
static void add_folder(struct lsp_session *session, struct family *family, struct arg_list *folders,
                       const char *folder)
{
    static const char ending[] = ".mtlx";
    size_t size = 0;
    char *names = disk_list(&session->disk, folder, &size), *inside = cli_format("%s/", folder);
    for (size_t at = 0; at < size; at += strlen(names + at) + 1) {
        const char *name = names + at;
        size_t len = strlen(name);
        bool is_folder = len && name[len - 1] == '/',
             is_document = len > strlen(ending) && strcmp(name + len - strlen(ending), ending) == 0;
        char *path = disk_join(inside, name);
        if (is_folder && *name != '.' && folders->len < MAX_FOLDERS && !system_is_link(path))
            args_append(folders, cli_format("%s", path));
        else if (is_document)
            add_path(session, family, path);
        free(path);
    }
    free(inside);
    free(names);
}

/* Near folders come first, so a limit cuts off the deep ones. */
static void add_folders(struct lsp_session *session, struct family *family)
{
    struct arg_list folders = {0};
    for (size_t i = 0; i < session->num_folders; ++i)
        args_append(&folders, cli_format("%s", session->folders[i]));
    for (size_t i = 0; i < folders.len && family->num_files < MAX_FILES; ++i)
        add_folder(session, family, &folders, folders.items[i]);
    args_free(&folders);
}

/* ---- Members ---- */

static bool includes(const struct family_file *file, const struct lsp_document *other)
{
    for (size_t i = 0; i < file->includes.len; ++i)
        if (strcmp(file->includes.items[i], other->path) == 0)
            return true;
    return false;
}

/* Makes the neighbours of a member members; true if there is a new one. */
static bool spread(struct lsp_session *session, struct family *family, size_t index)
{
    bool is_new = false;
    for (size_t i = 0; i < family->files[index].includes.len; ++i)
        add_path(session, family, family->files[index].includes.items[i]);
    for (size_t i = 0; i < family->num_files; ++i) {
        struct family_file *file = &family->files[i], *member = &family->files[index];
        if (file->is_member
            || (!includes(member, file->document) && !includes(file, member->document)))
            continue;
        file->is_member = is_new = true;
    }
    return is_new;
}

void family_scan(struct lsp_session *session, struct family *out)
{
    *out = (struct family){0};
    session->disk.from = check_origin(NULL);
    for (struct lsp_document *open = session->documents; open; open = open->next)
        add(session, out, open, false);
    add_folders(session, out);
}

void family_find(struct lsp_session *session, struct lsp_document *document, struct family *out)
{
    family_scan(session, out);
    session->disk.from = check_origin(document);
    for (size_t i = 0; i < out->num_files; ++i)
        out->files[i].is_member = out->files[i].document == document;
    for (bool is_new = true; is_new;) {
        is_new = false;
        for (size_t i = 0; i < out->num_files; ++i)
            is_new |= out->files[i].is_member && spread(session, out, i);
    }
}

void family_finish(struct family *family)
{
    for (size_t i = 0; i < family->num_files; ++i) {
        struct family_file *file = &family->files[i];
        args_free(&file->includes);
        if (file->is_own)
            lsp_document_destroy(file->document);
    }
    free(family->files);
}

bool family_query(const struct family *family, size_t index, struct lsp_session *session,
                  struct lsp_query *out)
{
    *out = query_of(session, family->files[index].document);
    return family->files[index].is_member;
}

/* ---- Names ---- */

static bool is_same(const struct lsp_query *a, struct span of_a, const struct lsp_query *b,
                    struct span of_b)
{
    size_t len = of_a.end - of_a.start;
    return len == of_b.end - of_b.start
           && memcmp(a->text->bytes + of_a.start, b->text->bytes + of_b.start, len) == 0;
}

/* The element whose name other files have: the nodegraph of an output, or the target itself. */
static uint32_t named_of(const struct lsp_query *of, uint32_t target)
{
    uint32_t parent = of->model->elements[target].parent;
    return query_is(of, target, "output") && query_is(of, parent, "nodegraph") ? parent : target;
}

bool family_can_name(const struct lsp_query *of, uint32_t target)
{
    uint32_t root = query_root(of);
    return root != MODEL_NONE && of->model->elements[named_of(of, target)].parent == root;
}

struct span family_local_name(const struct lsp_query *query, struct span name)
{
    for (uint32_t at = name.end; at > name.start; --at)
        if (query->text->bytes[at - 1] == ':')
            return (struct span){at, name.end};
    return name;
}

/* The namespace of a text; empty: it has none. */
static struct span namespace_of(const struct lsp_query *query)
{
    uint32_t root = query_root(query);
    return root == MODEL_NONE ? (struct span){0, 0} : query_value(query, root, "namespace");
}

/* True if a name of one text is, with its namespace, that of an element of the other one. */
static bool is_full_name(const struct lsp_query *of, struct span own, const struct lsp_query *in,
                         struct span name)
{
    const struct span local = family_local_name(in, name), space = namespace_of(of),
                      written = {name.start,
                                 local.start > name.start ? local.start - 1 : name.start};
    bool has_space = written.start < written.end;
    return is_same(of, own, in, local)
           && (has_space ? is_same(of, space, in, written)
                         : space.start == space.end || is_same(of, space, in, namespace_of(in)));
}

bool family_names(const struct lsp_query *of, uint32_t target, const struct lsp_query *in,
                  uint32_t element, const struct model_attribute *attribute, struct span *name)
{
    uint32_t named = named_of(of, target);
    struct span own = query_value(of, target, "name"), whole = *name;
    bool is_output = query_equals(in->text, attribute->name, "output");
    if (!family_can_name(of, target) || is_output != (named != target)
        || !names_other_files(in, element, attribute))
        return false;
    if (is_output) {
        const struct model_attribute *graph = query_attribute(in, element, "nodegraph");
        struct span of_graph = graph ? graph->value : whole;
        return graph && is_same(of, own, in, whole)
               && family_names(of, named, in, element, graph, &of_graph);
    }
    *name = family_local_name(in, whole);
    bool is_node = query_equals(in->text, attribute->name, "nodename");
    return is_full_name(of, own, in, whole)
           && names_target_of(in, element, attribute, whole) == MODEL_NONE
           && (!is_node || names_scope(in, element) == query_root(in));
}

/* True for a value of this name in a <variant>, which changes inputs of any definition. */
static bool is_in_variant(const struct lsp_query *in, uint32_t element, const struct lsp_query *of,
                          struct span name)
{
    uint32_t parent = in->model->elements[element].parent;
    return query_is(in, parent, "variant")
           && is_same(of, name, in, query_value(in, element, "name"));
}

bool family_uses_input(const struct family *family, const struct lsp_query *of, uint32_t target)
{
    uint32_t nodedef = of->model->elements[target].parent;
    if (!query_is(of, target, "input") || !query_is(of, nodedef, "nodedef"))
        return false;
    const struct span own = query_value(of, nodedef, "name"),
                      category = query_value(of, nodedef, "node");
    for (size_t i = 0; i < family->num_files; ++i) {
        struct lsp_query in;
        if (!family_query(family, i, of->session, &in) || in.document == of->document)
            continue;
        for (uint32_t e = 0; e < in.model->num_elements; ++e) {
            const struct span names[] = {query_value(&in, e, "nodedef"),
                                         query_value(&in, e, "inherit")};
            bool uses =
                is_same(of, category, &in, family_local_name(&in, in.model->elements[e].name))
                || is_in_variant(&in, e, of, query_value(of, target, "name"));
            if (uses || is_full_name(of, own, &in, names[0])
                || is_full_name(of, own, &in, names[1]))
                return true;
        }
    }
    return false;
}
