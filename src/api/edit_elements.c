// SPDX-License-Identifier: Apache-2.0
/* One change of an edit: its checks, and the changes of elements. */
#include "api/edit.h"

#include <stdarg.h>

/* ---- Reading ---- */

static elem_id in_tree(const mxg_edit *edit, mxg_element element)
{
    return doc_has_element(edit_tree(edit), element) ? element : 0;
}

mxg_element mxg_edit_find_element(const mxg_edit *edit, mxg_element below, const char *path)
{
    if (!edit || !edit->document || !path)
        return 0;
    elem_id start = below ? in_tree(edit, below) : edit_tree(edit)->root;
    return start ? doc_find_below(edit_tree(edit), start, path, strlen(path)) : 0;
}

elem_id edit_child(const mxg_edit *edit, elem_id parent, const char *name)
{
    const struct document *doc = edit_tree(edit);
    return doc_child(doc, parent, str_find(doc->strings, name, strlen(name)));
}

size_t mxg_edit_error(const mxg_edit *edit, char *buffer, size_t capacity)
{
    return edit ? text_copy(edit->error.data, edit->error.len, buffer, capacity)
                : text_copy("", 0, buffer, capacity);
}

/* ---- One change ---- */

struct error_job {
    struct text *out;
    const char *format;
    va_list *args;
};

static void write_error(void *arg)
{
    struct error_job *job = arg;
    job->out->len = 0;
    text_vfmt(job->out, job->format, *job->args);
    text_cstr(job->out);
}

void edit_fail(struct edit_change *change, const char *format, ...)
{
    va_list args;
    struct error_job job = {&change->edit->error, format, &args};
    change->failed = true;
    va_start(args, format);
    object_run(&change->edit->object, write_error, &job);
    va_end(args);
}

static void index_restored(void *arg)
{
    doc_index_restored(arg);
}

mxg_status edit_run(struct edit_change *change, void (*work)(void *arg))
{
    if (!change->edit->document) {
        edit_fail(change, "the edit has made its document");
        return MXG_ERROR_ARGUMENT;
    }
    struct document *doc = edit_tree(change->edit);
    mxg_status status = object_run(&change->edit->document->object, work, change);
    if (status == MXG_OK && doc->origin && doc->whole->left_out.len)
        status = object_run(&change->edit->document->object, index_restored, doc);
    return status == MXG_OK && change->failed ? MXG_ERROR_ARGUMENT : status;
}

str_id edit_word(const struct edit_change *change, const char *text)
{
    return str_intern_z(edit_tree(change->edit)->strings, text ? text : "");
}

/* XML 1.0 has no other control characters. */
static bool is_text(const char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text < ' ' && *text != '\t' && *text != '\n' && *text != '\r')
            return false;
    return true;
}

bool edit_check_text(struct edit_change *change, const char *what, const char *text)
{
    if (text && (!is_text(text) || !text_is_utf8(text, strlen(text))))
        edit_fail(change, "the %s has bytes that XML cannot hold; texts are UTF-8", what);
    return !change->failed;
}

bool edit_check_name(struct edit_change *change, const char *what, const char *name)
{
    if (!name || !*name)
        edit_fail(change, "the %s is missing", what);
    else if (edit_check_text(change, what, name) && !doc_is_name(name))
        edit_fail(change, "'%s' is no name; a name has letters, digits and '_', and no digit first",
                  name);
    return !change->failed;
}

bool edit_check_xml_name(struct edit_change *change, const char *what, const char *name)
{
    static const char *const reserved[] = {"xml", "xmlns", "xi"};
    if (!edit_check_name(change, what, name))
        return false;
    const char *colon = strchr(name, ':');
    size_t len = colon ? (size_t)(colon - name) : strlen(name);
    for (size_t i = 0; i < sizeof reserved / sizeof *reserved; i++)
        if (strlen(reserved[i]) == len && memcmp(reserved[i], name, len) == 0)
            edit_fail(change, "'%s' has a meaning in XML, so it is no %s of an edit", name, what);
    if (colon && strchr(colon + 1, ':'))
        edit_fail(change, "'%s' has two prefixes, and XML allows one", name);
    return !change->failed;
}

bool edit_check_new_name(struct edit_change *change, elem_id parent, const char *name)
{
    if (edit_check_name(change, "name", name) && edit_child(change->edit, parent, name))
        edit_fail(change, "there is an element '%s' already", name);
    return !change->failed;
}

const char *edit_label(const mxg_edit *edit, elem_id element)
{
    const struct document *doc = edit_tree(edit);
    const struct element *e = doc_element(doc, element);
    return str_text(doc->strings, e->name ? e->name : e->category);
}

bool edit_check_element(struct edit_change *change, elem_id *element, bool may_be_root)
{
    const struct document *doc = edit_tree(change->edit);
    if (!*element && may_be_root)
        *element = doc->root;
    if (!in_tree(change->edit, *element) || (*element == doc->root && !may_be_root))
        edit_fail(change, "there is no such element");
    return !change->failed;
}

bool edit_check_room(struct edit_change *change, uint64_t num)
{
    const struct document *doc = edit_tree(change->edit);
    if (doc->max_elements && doc_num_elements(doc) + num > doc->max_elements)
        edit_fail(change, "the document would have more elements than the context allows");
    return !change->failed;
}

elem_id edit_add(struct edit_change *change, elem_id parent, const char *category, const char *name,
                 const char *type)
{
    struct document *doc = edit_tree(change->edit);
    elem_id element =
        doc_add_element(doc, parent, edit_word(change, category), edit_word(change, name),
                        doc_element(doc, doc->root)->file, 0, 0);
    if (type && *type)
        doc_set_attr(doc, element, STR_type, edit_word(change, type));
    doc_index_change(doc, element);
    return element;
}

static void add(void *arg)
{
    struct edit_change *c = arg;
    bool is_named = c->name && *c->name;
    if (edit_check_element(c, &c->element, true) && edit_check_xml_name(c, "category", c->category)
        && (!is_named || edit_check_new_name(c, c->element, c->name))
        && edit_check_text(c, "type", c->type) && edit_check_room(c, 1))
        c->result = edit_add(c, c->element, c->category, c->name, c->type);
}

mxg_element mxg_edit_add_element(mxg_edit *edit, mxg_element parent, const char *category,
                                 const char *name, const char *type)
{
    struct edit_change change = {
        .edit = edit, .element = parent, .category = category, .name = name, .type = type};
    return edit && edit_run(&change, add) == MXG_OK ? change.result : 0;
}

/* ---- The tree ---- */

static void lose_reference(void *arg, elem_id user, str_id attr)
{
    const struct edit_change *c = arg;
    const struct element *e = doc_element(edit_tree(c->edit), c->element);
    struct lost_reference lost = {user, e->parent, attr, e->name, e->kind};
    vec_push(&c->edit->document->object.arena, &c->edit->lost, lost);
}

struct framing {
    struct document *doc;
    str_id old, name;
};

static void replace_in_frame(void *arg, elem_id user, str_id attr)
{
    const struct framing *framing = arg;
    if (attr == STR_contains)
        doc_replace_name(framing->doc, user, attr, framing->old, framing->name);
}

void edit_replace_in_frames(struct edit_change *change, elem_id element, str_id name)
{
    struct document *doc = edit_tree(change->edit);
    struct framing framing = {doc, doc_element(doc, element)->name, name};
    doc_visit_users(doc, element, replace_in_frame, &framing);
}

static void remove_element(void *arg)
{
    struct edit_change *c = arg;
    if (!edit_check_element(c, &c->element, false))
        return;
    edit_replace_in_frames(c, c->element, 0);
    doc_visit_users(edit_tree(c->edit), c->element, lose_reference, c);
    doc_remove_element(edit_tree(c->edit), c->element);
}

mxg_status mxg_edit_remove_element(mxg_edit *edit, mxg_element element)
{
    struct edit_change change = {.edit = edit, .element = element};
    return edit ? edit_run(&change, remove_element) : MXG_ERROR_ARGUMENT;
}

static void move(void *arg)
{
    struct edit_change *c = arg;
    struct document *doc = edit_tree(c->edit);
    if (!edit_check_element(c, &c->element, false) || !edit_check_element(c, &c->other, true)
        || (c->before && !edit_check_element(c, &c->before, false)))
        return;
    const char *name = doc_name(doc, c->element);
    if (doc_is_within(doc, c->other, c->element) || c->before == c->element)
        edit_fail(c, "'%s' cannot move below or before itself", edit_label(c->edit, c->element));
    else if (c->before && doc_element(doc, c->before)->parent != c->other)
        edit_fail(c, "'%s' is not below the parent, so '%s' cannot move before it",
                  edit_label(c->edit, c->before), edit_label(c->edit, c->element));
    else if (*name && doc_element(doc, c->element)->parent != c->other
             && edit_child(c->edit, c->other, name))
        edit_fail(c, "there is an element '%s' already", name);
    if (c->failed)
        return;
    struct edit_scope scope;
    edit_note_scope(doc, c->element, &scope);
    if (doc_element(doc, c->element)->parent != c->other)
        edit_replace_in_frames(c, c->element, 0);
    if (c->before)
        doc_move_before(doc, c->element, c->before);
    else
        doc_move_element(doc, c->element, c->other);
    edit_keep_scope(c, c->element, &scope);
    doc_index_change(doc, c->element);
}

mxg_status mxg_edit_move_element(mxg_edit *edit, mxg_element element, mxg_element parent,
                                 mxg_element before)
{
    struct edit_change change = {
        .edit = edit, .element = element, .other = parent, .before = before};
    return edit ? edit_run(&change, move) : MXG_ERROR_ARGUMENT;
}

/* Names of files keep their meaning in the folder of another document. */
static void keep_files(struct edit_change *c, const struct document *from)
{
    struct document *doc = edit_tree(c->edit);
    const char *folder = doc_place(doc, doc->root).file;
    elem_id copy = c->result;
    for (elem_id e = c->other; e && copy && !c->failed; e = doc_next_in_tree(from, c->other, e)) {
        const char *prefix = doc_prefix_from(from, e, folder, &c->edit->document->object.arena);
        if (prefix)
            doc_set_attr(doc, copy, STR_fileprefix, edit_word(c, prefix));
        copy = doc_next_in_tree(doc, c->result, copy);
    }
}

static void copy(void *arg)
{
    struct edit_change *c = arg;
    if (!c->source)
        edit_fail(c, "the document to copy from is missing");
    if (!edit_check_element(c, &c->element, true))
        return;
    const struct document *from = &c->source->layer.doc;
    if (!doc_has_element(from, c->other) || c->other == from->root) {
        edit_fail(c, "the document to copy from has no such element");
        return;
    }
    const char *name = c->name && *c->name ? c->name : doc_name(from, c->other);
    if (*name && !edit_check_new_name(c, c->element, name))
        return;
    struct edit_scope scope;
    edit_note_scope(from, c->other, &scope);
    c->result =
        doc_copy_element(edit_tree(c->edit), c->element, from, c->other, edit_word(c, name));
    if (c->result) {
        edit_keep_scope(c, c->result, &scope);
        keep_files(c, from);
    } else {
        edit_fail(c, "the document would have more elements than the context allows");
    }
}

mxg_element mxg_edit_copy_element(mxg_edit *edit, mxg_element parent, const mxg_document *document,
                                  mxg_element element, const char *name)
{
    struct edit_change change = {
        .edit = edit, .element = parent, .source = document, .other = element, .name = name};
    return edit && edit_run(&change, copy) == MXG_OK ? change.result : 0;
}
