// SPDX-License-Identifier: Apache-2.0
/* Edits: changes of a document until they become a document. */
#include "api/scene.h"
#include "bind/materials.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>

struct mxg_edit {
    struct object object;   /* owns the texts of errors; holds the document */
    mxg_document *document; /* NULL: the edit has made it */
    bool is_unchecked;      /* it has elements that no call below checked and indexed */
    struct text error;
};

static struct document *tree_of(const mxg_edit *edit)
{
    return &edit->document->layer.doc;
}

/* ---- Begin ---- */

struct begin_job {
    mxg_edit *edit;
    struct library *base;
    const mxg_document *from;
    const char *name;
};

static void begin_empty(struct document *doc, const char *name)
{
    uint16_t file = doc_add_file(doc, str_intern_z(doc->strings, name));
    doc_set_place(doc, doc->root, file, 0, 0);
    doc_set_attr(doc, doc->root, STR_version, str_intern_z(doc->strings, "1.39"));
    doc->is_global = doc->keeps_comments = true;
}

/* The document whose elements a document that begins with `from` shares. */
static const mxg_document *origin_of(const mxg_document *from)
{
    const struct document *shared = from ? doc_to_share(&from->layer.doc) : NULL;
    while (from && &from->layer.doc != shared)
        from = from->origin;
    return from;
}

/* True if elements are in the tree again that the edited document leaves out. */
static bool begin_from(mxg_document *document, const mxg_document *from)
{
    struct arena *arena = &document->object.arena;
    struct library *layer = &document->layer;
    document->origin = origin_of(from);
    library_init(layer, arena, from->layer.base);
    strpool_init(&layer->strings, arena, &document->origin->layer.strings);
    doc_begin_edit(&layer->doc, arena, &layer->strings, &from->layer.doc,
                   &document->origin->layer.doc);
    bool is_restored = doc_restore_left_out(&layer->doc, &from->layer.doc);
    renderables_begin(document, from);
    for (uint32_t i = 0; i < from->files.len; i++) {
        const char *file = from->files.items[i];
        vec_push(arena, &document->files, arena_strndup(arena, file, strlen(file)));
    }
    return is_restored;
}

static void begin_document(void *arg)
{
    struct begin_job *job = arg;
    mxg_document *document = job->edit->document;
    struct arena *arena = &document->object.arena;
    struct library *layer = &document->layer;
    if (job->from) {
        job->edit->is_unchecked = begin_from(document, job->from);
    } else {
        const char *name = job->name ? job->name : "<edit>";
        library_init(layer, arena, job->base);
        begin_empty(&layer->doc, name);
        vec_push(arena, &document->files, arena_strndup(arena, name, strlen(name)));
    }
    document_follow_context(document);
    layer->doc.max_elements = document->object.context->xml_limits.max_elements;
}

/* The document holds its origin, which holds the library. */
static mxg_edit *new_edit(mxg_context *context, mxg_library *library, const mxg_document *from)
{
    /* only its reference count changes */
    struct object *origin = from ? (struct object *)(uintptr_t)&origin_of(from)->object : NULL;
    mxg_document *document =
        object_new(context, sizeof *document, origin ? origin : &library->object);
    if (!document)
        return NULL;
    mxg_edit *edit = object_new(context, sizeof *edit, &document->object);
    object_unref(&document->object); /* the edit holds it */
    if (!edit)
        return NULL;
    edit->document = document;
    text_init(&edit->error, &edit->object.arena);
    return edit;
}

mxg_status mxg_edit_create(mxg_context *context, mxg_library *library, const mxg_document *from,
                           const char *name, mxg_edit **out_edit)
{
    if (out_edit)
        *out_edit = NULL;
    if (!context || !library || !out_edit || object_status(&library->object) != MXG_OK
        || (from && from->layer.base != &library->layer))
        return MXG_ERROR_ARGUMENT;
    struct begin_job job = {new_edit(context, library, from), &library->layer, from, name};
    if (!job.edit)
        return MXG_ERROR_MEMORY;
    mxg_status status = object_run(&job.edit->document->object, begin_document, &job);
    if (status == MXG_OK)
        *out_edit = job.edit;
    else
        mxg_edit_destroy(job.edit);
    return status;
}

void mxg_edit_destroy(mxg_edit *edit)
{
    object_unref(edit ? &edit->object : NULL);
}

/* ---- Reading ---- */

static elem_id in_tree(const mxg_edit *edit, mxg_element element)
{
    return doc_has_element(tree_of(edit), element) ? element : 0;
}

mxg_element mxg_edit_find_element(const mxg_edit *edit, mxg_element below, const char *path)
{
    if (!edit || !edit->document || !path)
        return 0;
    elem_id start = below ? in_tree(edit, below) : tree_of(edit)->root;
    return start ? doc_find_below(tree_of(edit), start, path, strlen(path)) : 0;
}

static elem_id child_of(const mxg_edit *edit, elem_id parent, const char *name)
{
    const struct document *doc = tree_of(edit);
    return doc_child(doc, parent, str_find(doc->strings, name, strlen(name)));
}

size_t mxg_edit_error(const mxg_edit *edit, char *buffer, size_t capacity)
{
    return edit ? text_copy(edit->error.data, edit->error.len, buffer, capacity)
                : text_copy("", 0, buffer, capacity);
}

/* ---- One change ---- */

/* The arguments of a public function; each uses those it needs. */
struct change {
    mxg_edit *edit;
    elem_id element, other, before;
    const char *category, *name, *type, *text;
    const mxg_document *source;
    const float *numbers;
    uint32_t num_numbers;
    elem_id result;
    bool failed;
};

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

/* Without memory the error has no text. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static void
fail(struct change *change, const char *format, ...)
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

static mxg_status run(struct change *change, void (*work)(void *arg))
{
    if (!change->edit->document) {
        fail(change, "the edit has made its document");
        return MXG_ERROR_ARGUMENT;
    }
    struct document *doc = tree_of(change->edit);
    mxg_status status = object_run(&change->edit->document->object, work, change);
    if (status == MXG_OK && doc->origin && doc->whole->left_out.len)
        status = object_run(&change->edit->document->object, index_restored, doc);
    return status == MXG_OK && change->failed ? MXG_ERROR_ARGUMENT : status;
}

static str_id word(const struct change *change, const char *text)
{
    return str_intern_z(tree_of(change->edit)->strings, text ? text : "");
}

/* XML 1.0 has no other control characters. */
static bool is_text(const char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text < ' ' && *text != '\t' && *text != '\n' && *text != '\r')
            return false;
    return true;
}

/* Checks a text that goes into the document; NULL counts as empty. */
static bool check_text(struct change *change, const char *what, const char *text)
{
    if (text && (!is_text(text) || !text_is_utf8(text, strlen(text))))
        fail(change, "the %s has bytes that XML cannot hold; texts are UTF-8", what);
    return !change->failed;
}

static bool check_xml_name(struct change *change, const char *what, const char *name)
{
    if (!name || !*name)
        fail(change, "the %s is missing", what);
    else if (check_text(change, what, name) && !doc_is_name(name))
        fail(change, "'%s' is no name; a name has letters, digits and '_', and no digit first",
             name);
    return !change->failed;
}

/* A new name below a parent. */
static bool check_new_name(struct change *change, elem_id parent, const char *name)
{
    if (check_xml_name(change, "name", name) && child_of(change->edit, parent, name))
        fail(change, "there is an element '%s' already", name);
    return !change->failed;
}

/* The name of an element, or its category if it has no name. */
static const char *label(const struct document *doc, elem_id element)
{
    const struct element *e = doc_element(doc, element);
    return str_text(doc->strings, e->name ? e->name : e->category);
}

/* The element of a number; for 0 the root, if that is allowed. */
static bool find_element(struct change *change, elem_id *element, bool may_be_root)
{
    const struct document *doc = tree_of(change->edit);
    if (!*element && may_be_root)
        *element = doc->root;
    if (!in_tree(change->edit, *element) || (*element == doc->root && !may_be_root))
        fail(change, "there is no such element");
    return !change->failed;
}

static bool check_room(struct change *change)
{
    if (doc_is_full(tree_of(change->edit)))
        fail(change, "the document has as many elements as the context allows");
    return !change->failed;
}

static elem_id add_element(struct change *change, elem_id parent, const char *category,
                           const char *name, const char *type)
{
    struct document *doc = tree_of(change->edit);
    elem_id element = doc_add_element(doc, parent, word(change, category), word(change, name),
                                      doc_element(doc, doc->root)->file, 0, 0);
    if (type && *type)
        doc_set_attr(doc, element, STR_type, word(change, type));
    doc_index_change(doc, element);
    return element;
}

static void add(void *arg)
{
    struct change *c = arg;
    bool is_named = c->name && *c->name;
    if (find_element(c, &c->element, true) && check_xml_name(c, "category", c->category)
        && (!is_named || check_new_name(c, c->element, c->name)) && check_text(c, "type", c->type)
        && check_room(c))
        c->result = add_element(c, c->element, c->category, c->name, c->type);
}

mxg_element mxg_edit_add_element(mxg_edit *edit, mxg_element parent, const char *category,
                                 const char *name, const char *type)
{
    struct change change = {
        .edit = edit, .element = parent, .category = category, .name = name, .type = type};
    return edit && run(&change, add) == MXG_OK ? change.result : 0;
}

static void rename_element(void *arg)
{
    struct change *c = arg;
    if (!find_element(c, &c->element, false))
        return;
    const struct document *doc = tree_of(c->edit);
    const struct element *e = doc_element(doc, c->element);
    if (c->text && strcmp(str_text(doc->strings, e->name), c->text) == 0)
        return;
    if (check_new_name(c, e->parent, c->text))
        doc_rename(tree_of(c->edit), c->element, word(c, c->text));
}

mxg_status mxg_edit_rename_element(mxg_edit *edit, mxg_element element, const char *name)
{
    struct change change = {.edit = edit, .element = element, .text = name};
    return edit ? run(&change, rename_element) : MXG_ERROR_ARGUMENT;
}

static void set(void *arg)
{
    struct change *c = arg;
    if (!find_element(c, &c->element, true) || !check_xml_name(c, "attribute", c->name)
        || !check_text(c, "value", c->text))
        return;
    if (c->text)
        doc_set_attr(tree_of(c->edit), c->element, word(c, c->name), word(c, c->text));
    else
        doc_remove_attr(tree_of(c->edit), c->element, word(c, c->name));
    doc_index_change(tree_of(c->edit), c->element);
}

mxg_status mxg_edit_set_attribute(mxg_edit *edit, mxg_element element, const char *attribute,
                                  const char *value)
{
    if (attribute && strcmp(attribute, "name") == 0)
        return mxg_edit_rename_element(edit, element, value);
    struct change change = {.edit = edit, .element = element, .name = attribute, .text = value};
    return edit ? run(&change, set) : MXG_ERROR_ARGUMENT;
}

/* ---- Inputs ---- */

/* Checks that `name` is an input of the node, or may become one. */
static bool check_input(struct change *c)
{
    if (!find_element(c, &c->element, false) || !check_xml_name(c, "input", c->name))
        return false;
    elem_id input = child_of(c->edit, c->element, c->name);
    if (input && doc_element(tree_of(c->edit), input)->kind != KIND_INPUT)
        fail(c, "'%s' is not an input", c->name);
    return !c->failed && (input || check_room(c));
}

/* The input, with its type. `type` NULL keeps the type of an input that is there. */
static elem_id make_input(struct change *c, const char *type)
{
    struct document *doc = tree_of(c->edit);
    elem_id input = child_of(c->edit, c->element, c->name);
    if (!input)
        return add_element(c, c->element, "input", c->name, type);
    if (type) {
        doc_set_attr(doc, input, STR_type, word(c, type));
        doc_index_change(doc, input);
    }
    return input;
}

static void remove_attrs(struct document *doc, elem_id element, const str_id *attrs, size_t num)
{
    for (size_t i = 0; i < num; i++)
        doc_remove_attr(doc, element, attrs[i]);
}

/* The attributes that say where a port takes its value from. */
static const str_id sources[] = {STR_nodename, STR_nodegraph, STR_interfacename, STR_output,
                                 STR_value};

/* The type of the input after the change. Fails if the input is new and has no type. */
static doc_type input_type(struct change *c)
{
    const struct document *doc = tree_of(c->edit);
    elem_id input = child_of(c->edit, c->element, c->name);
    str_id name = input ? doc_attr_value(doc, input, STR_type) : STR_EMPTY;
    const char *type = c->type ? c->type : str_text(doc->strings, name);
    if (!*type)
        fail(c, "the input '%s' is new; give its type", c->name);
    return doc_type_of(str_find(doc->strings, type, strlen(type)));
}

static void set_value(void *arg)
{
    struct change *c = arg;
    struct document *doc = tree_of(c->edit);
    if (!check_input(c) || !check_text(c, "type", c->type) || !check_text(c, "value", c->text))
        return;
    doc_type type = input_type(c);
    if (!c->text)
        fail(c, "the value of '%s' is missing", c->name);
    if (!c->failed && !doc_value_is_valid(type, c->text, strlen(c->text)))
        fail(c, "'%s' is no value of the type of the input", c->text);
    if (c->failed)
        return;
    elem_id input = make_input(c, c->type);
    remove_attrs(doc, input, sources, sizeof sources / sizeof *sources - 1);
    doc_set_attr(doc, input, STR_value, word(c, c->text));
}

mxg_status mxg_edit_set_value(mxg_edit *edit, mxg_element node, const char *input, const char *type,
                              const char *value)
{
    struct change change = {
        .edit = edit, .element = node, .name = input, .type = type, .text = value};
    return edit ? run(&change, set_value) : MXG_ERROR_ARGUMENT;
}

/* The shortest text that reads as the same numbers. */
static void write_numbers(const struct change *c, doc_type type, struct text *out)
{
    for (uint32_t i = 0; i < c->num_numbers; i++) {
        text_str(out, i ? ", " : "");
        if (type == DOC_TYPE_boolean)
            text_str(out, c->numbers[i] != 0 ? "true" : "false");
        else if (type == DOC_TYPE_integer)
            text_fmt(out, "%.0f", (double)c->numbers[i]);
        else
            text_float(out, c->numbers[i]);
    }
}

static void set_numbers(void *arg)
{
    struct change *c = arg;
    if (!check_input(c) || !check_text(c, "type", c->type))
        return;
    doc_type type = input_type(c);
    uint32_t num = type == DOC_TYPE_boolean ? 1 : doc_type_components(type);
    if (!c->numbers)
        fail(c, "the numbers of '%s' are missing", c->name);
    if (!c->failed && (!num || num != c->num_numbers))
        fail(c, "the type of '%s' does not have %u component%s", c->name, (unsigned)c->num_numbers,
             c->num_numbers == 1 ? "" : "s");
    for (uint32_t i = 0; !c->failed && i < num; i++)
        if (!isfinite(c->numbers[i]))
            fail(c, "a value of '%s' is infinite or not a number", c->name);
    if (c->failed)
        return;
    struct text text;
    text_init(&text, &c->edit->document->object.arena);
    write_numbers(c, type, &text);
    c->text = text_cstr(&text);
    set_value(c);
}

mxg_status mxg_edit_set_numbers(mxg_edit *edit, mxg_element node, const char *input,
                                const char *type, const float *values, uint32_t num_values)
{
    struct change change = {.edit = edit,
                            .element = node,
                            .name = input,
                            .type = type,
                            .numbers = values,
                            .num_numbers = num_values};
    return edit ? run(&change, set_numbers) : MXG_ERROR_ARGUMENT;
}

/* ---- Connections ---- */

/* The attribute with which a port in `scope` names `from`; 0 after an error. */
static str_id connecting_attr(struct change *c, elem_id scope)
{
    const struct document *doc = tree_of(c->edit);
    const struct element *from = doc_element(doc, c->other);
    bool is_beside = from->parent == scope;
    if (from->kind == KIND_NODE && is_beside)
        return STR_nodename;
    if (from->kind == KIND_NODEGRAPH && (is_beside || from->parent == doc->root))
        return STR_nodegraph;
    if (from->kind == KIND_INPUT && from->parent == scope
        && doc_element(doc, scope)->kind == KIND_NODEGRAPH)
        return STR_interfacename;
    fail(c, "'%s' is no node or nodegraph beside the port, and no input of the graph around it",
         label(doc, c->other));
    return 0;
}

/* The type of an output of a node, by its definition; "" if that is unknown. */
static const char *output_type(const struct change *c)
{
    const struct library *lib = &c->edit->document->layer;
    struct diag_list diags;
    diag_list_init(&diags, &c->edit->document->object.arena);
    uint32_t nodedef = library_match(lib, c->other, &diags);
    str_id name = c->text ? str_find(&lib->strings, c->text, strlen(c->text)) : STR_EMPTY;
    int output = nodedef == LIBRARY_NONE ? -1 : library_find_output(lib, nodedef, name);
    if (output < 0)
        return "";
    const struct nodedef *def = library_nodedef(lib, nodedef);
    return str_text(
        &lib->strings,
        library_type_name(lib, library_ports(lib, nodedef, NULL)[def->num_inputs + output].type));
}

/* The type of the value that `from` gives; "" if it is unknown. */
static const char *source_type(const struct change *c)
{
    const struct document *doc = tree_of(c->edit);
    elem_id typed = c->other;
    if (doc_element(doc, c->other)->kind == KIND_NODEGRAPH) {
        elem_id output = c->text ? child_of(c->edit, c->other, c->text) : 0;
        for (elem_id e = doc_element(doc, c->other)->first_child; e && !output && !c->text;
             e = doc_element(doc, e)->next)
            output = doc_element(doc, e)->kind == KIND_OUTPUT ? e : 0;
        typed = output;
    }
    str_id type = typed ? doc_attr_value(doc, typed, STR_type) : STR_EMPTY;
    return doc_type_of(type) == DOC_TYPE_multioutput ? output_type(c)
                                                     : str_text(doc->strings, type);
}

static void connect(void *arg)
{
    struct change *c = arg;
    struct document *doc = tree_of(c->edit);
    if (!find_element(c, &c->element, false) || !find_element(c, &c->other, false)
        || !check_text(c, "output", c->text) || (c->name && !check_input(c)))
        return;
    if (!c->name && doc_element(doc, c->element)->kind != KIND_OUTPUT) {
        fail(c, "without an input the element to connect is an <output>");
        return;
    }
    str_id attr = connecting_attr(c, doc_element(doc, c->element)->parent);
    const char *type = attr ? source_type(c) : "";
    if (!attr)
        return;
    if (!*type) {
        if (c->text)
            fail(c, "the type of output '%s' of '%s' is unknown", c->text, label(doc, c->other));
        else
            fail(c, "the type of '%s' is unknown; name one of its outputs", label(doc, c->other));
        return;
    }
    elem_id port = c->name ? make_input(c, type) : c->element;
    remove_attrs(doc, port, sources, sizeof sources / sizeof *sources);
    doc_set_attr(doc, port, attr, doc_element(doc, c->other)->name);
    if (c->text)
        doc_set_attr(doc, port, STR_output, word(c, c->text));
    doc_index_change(doc, port);
}

mxg_status mxg_edit_connect_input(mxg_edit *edit, mxg_element node, const char *input,
                                  mxg_element from, const char *output)
{
    struct change change = {
        .edit = edit, .element = node, .name = input, .other = from, .text = output};
    return edit ? run(&change, connect) : MXG_ERROR_ARGUMENT;
}

/* ---- The tree ---- */

static void remove_element(void *arg)
{
    struct change *c = arg;
    if (find_element(c, &c->element, false))
        doc_remove_element(tree_of(c->edit), c->element);
}

mxg_status mxg_edit_remove_element(mxg_edit *edit, mxg_element element)
{
    struct change change = {.edit = edit, .element = element};
    return edit ? run(&change, remove_element) : MXG_ERROR_ARGUMENT;
}

static void move(void *arg)
{
    struct change *c = arg;
    struct document *doc = tree_of(c->edit);
    if (!find_element(c, &c->element, false) || !find_element(c, &c->other, true)
        || (c->before && !find_element(c, &c->before, false)))
        return;
    const char *name = str_text(doc->strings, doc_element(doc, c->element)->name);
    if (doc_is_within(doc, c->other, c->element) || c->before == c->element)
        fail(c, "'%s' cannot move below or before itself", label(doc, c->element));
    else if (c->before && doc_element(doc, c->before)->parent != c->other)
        fail(c, "'%s' is not below the parent, so '%s' cannot move before it",
             label(doc, c->before), label(doc, c->element));
    else if (*name && doc_element(doc, c->element)->parent != c->other
             && child_of(c->edit, c->other, name))
        fail(c, "there is an element '%s' already", name);
    if (c->failed)
        return;
    if (c->before)
        doc_move_before(doc, c->element, c->before);
    else
        doc_move_element(doc, c->element, c->other);
    doc_index_change(doc, c->element);
}

mxg_status mxg_edit_move_element(mxg_edit *edit, mxg_element element, mxg_element parent,
                                 mxg_element before)
{
    struct change change = {.edit = edit, .element = element, .other = parent, .before = before};
    return edit ? run(&change, move) : MXG_ERROR_ARGUMENT;
}

static void copy(void *arg)
{
    struct change *c = arg;
    if (!c->source)
        fail(c, "the document to copy from is missing");
    if (!find_element(c, &c->element, true))
        return;
    const struct document *from = &c->source->layer.doc;
    if (!doc_has_element(from, c->other) || c->other == from->root) {
        fail(c, "the document to copy from has no such element");
        return;
    }
    const char *name =
        c->name ? c->name : str_text(from->strings, doc_element(from, c->other)->name);
    if (*name && !check_new_name(c, c->element, name))
        return;
    c->result = doc_copy_element(tree_of(c->edit), c->element, from, c->other, word(c, name));
    if (!c->result)
        fail(c, "the document would have more elements than the context allows");
}

mxg_element mxg_edit_copy_element(mxg_edit *edit, mxg_element parent, const mxg_document *document,
                                  mxg_element element, const char *name)
{
    struct change change = {
        .edit = edit, .element = parent, .source = document, .other = element, .name = name};
    return edit && run(&change, copy) == MXG_OK ? change.result : 0;
}

/* ---- End ---- */

struct end_job {
    mxg_document *document;
    bool is_unchecked;
    struct file_source files;
};

static const mxg_document *whole_of(const mxg_document *origin)
{
    while (origin->origin)
        origin = origin->origin;
    return origin;
}

/* Leaves the origin: the document gets arrays and definitions of its own. */
static void stand_alone(mxg_document *document)
{
    doc_leave_origin(&document->layer.doc);
    strpool_leave_base(&document->layer.strings, &whole_of(document->origin)->layer.strings);
    struct library own = document->layer;
    library_init(&document->layer, &document->object.arena, own.base);
    document->layer.doc = own.doc;
    document->layer.strings = own.strings;
    document->layer.doc.strings = &document->layer.strings;
    document_follow_context(document);
    document->origin = NULL;
}

static void end_document(void *arg)
{
    struct end_job *job = arg;
    mxg_document *document = job->document;
    struct document *doc = &document->layer.doc;
    struct diag_list *diags = &document->object.diagnostics.list;
    if (document->origin && !job->is_unchecked && edit_share(document, &job->files.scratch, diags))
        return;
    for (uint32_t i = 0; i < document->files.len; i++)
        file_source_remember(&job->files, document->files.items[i]);
    if (document->origin)
        stand_alone(document);
    doc_keep_paths(doc);
    doc_complete(doc, diags);
    document_finish(document, &job->files);
}

/* A document that stands alone holds the library in the place of its former origin. */
static void hold_library(struct object *object, const mxg_document *origin)
{
    struct object *former = object->below, *library = whole_of(origin)->object.below;
    assert(former == &origin->object);
    object_ref(library);
    object->below = library;
    object_unref(former);
}

mxg_status mxg_edit_commit(mxg_edit *edit, mxg_document **out_document)
{
    if (out_document)
        *out_document = NULL;
    if (!edit || !edit->document || !out_document)
        return MXG_ERROR_ARGUMENT;
    struct end_job job = {.document = edit->document, .is_unchecked = edit->is_unchecked};
    struct object *object = &edit->document->object;
    const mxg_document *origin = edit->document->origin;
    file_source_init(&job.files, object);
    mxg_status status = object_run(object, end_document, &job);
    file_source_finish(&job.files);
    if (status == MXG_OK) {
        if (origin && !edit->document->origin)
            hold_library(object, origin);
        object_ref(object);
        *out_document = edit->document;
        status = object_status(object);
    }
    edit->document = NULL;
    return status;
}

/* ---- Materials of a stage ---- */

struct materials_job {
    mxg_document *document;
    const mxg_scene *scene;
    struct file_source files;
    struct arena scratch;
};

static size_t read_image(void *user_data, const char *file, unsigned char *buffer, size_t capacity)
{
    struct materials_job *job = user_data;
    return file_source_begin(&job->files, job->scene->scene.layer.file, file, buffer, capacity);
}

static void add_materials(void *arg)
{
    struct materials_job *job = arg;
    const struct bind_images images = {job, read_image};
    bind_add_materials(&job->scene->scene, &job->document->layer, &images, &job->scratch,
                       &job->document->object.diagnostics.list);
}

mxg_status mxg_document_import(mxg_context *context, mxg_library *library,
                               const mxg_document *document, const mxg_scene *scene,
                               mxg_document **out_document)
{
    mxg_edit *edit;
    if (out_document)
        *out_document = NULL;
    if (!scene || !out_document)
        return MXG_ERROR_ARGUMENT;
    mxg_status status = mxg_edit_create(context, library, document, "<stage>", &edit);
    if (status != MXG_OK)
        return status;
    struct materials_job job = {.document = edit->document, .scene = scene};
    edit->is_unchecked = true;
    arena_init(&job.scratch, &edit->document->object.mem);
    file_source_init(&job.files, &edit->document->object);
    status = object_run(&edit->document->object, add_materials, &job);
    file_source_finish(&job.files);
    arena_finish(&job.scratch);
    if (status == MXG_OK)
        status = mxg_edit_commit(edit, out_document);
    mxg_edit_destroy(edit);
    return status;
}
