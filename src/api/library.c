// SPDX-License-Identifier: Apache-2.0
/* Libraries: the built-in library, and libraries from files, folders and images. */
#include "api/api.h"

#include "base/hash.h"
#include "specialise/specialise.h"

#include <assert.h>

mxg_library *mxg_library_ref(mxg_library *library)
{
    if (library)
        object_ref(&library->object);
    return library;
}

void mxg_library_unref(mxg_library *library)
{
    object_unref(library ? &library->object : NULL);
}

mxg_library *mxg_library_builtin(mxg_context *context)
{
    return context && context->builtin.image ? mxg_library_ref(&context->builtin) : NULL;
}

/* ---- Loading ---- */

struct load {
    mxg_library *library, *base;
    const char *const *paths;
    size_t num_paths;
    struct file_source files;
};

static bool is_image(const char *path)
{
    size_t len = strlen(path);
    return len > 6 && strcmp(path + len - 6, ".mxlib") == 0;
}

static void refuse_image(struct load *load, const char *path, const char *reason)
{
    diag_add(&load->library->object.diagnostics.list, DIAG_ID_image_bad,
             (struct diag_place){.file = path}, path, reason);
}

static void map_image(void *arg)
{
    struct load *load = arg;
    mxg_library *library = load->library;
    assert(load->num_paths == 1 && library->layer.doc.elements.len == 0);
    const char *data;
    size_t size;
    if (!file_source_read(&load->files, load->paths[0], &data, &size,
                          &library->object.diagnostics.list))
        return;
    const char *fault = library_map_image(&library->layer, data, size, true);
    if (fault) {
        refuse_image(load, load->paths[0], fault);
        return;
    }
    library->image = data;
    library->image_size = size;
    library_report_foreign(&library->layer, &load->files.scratch,
                           &library->object.diagnostics.list);
}

static void read_file(struct load *load, const char *path)
{
    struct xml_files files = file_source_for_xml(&load->files);
    mxg_library *library = load->library;
    if (!sandbox_admit_file(library->object.context, path))
        mem_fail(&library->object.mem);
    xml_read_file(&library->layer.doc, &files, &library->object.context->xml_limits, path,
                  &library->object.diagnostics.list);
}

static void read_path(struct load *load, const char *path)
{
    struct diag_list *diags = &load->library->object.diagnostics.list;
    if (is_image(path)) {
        refuse_image(load, path,
                     "an image has no base library: name it first, without the built-in library");
        return;
    }
    if (!folder_exists(path)) {
        read_file(load, path);
        return;
    }
    struct path_list found = {0};
    const char *reason = folder_list(&load->files.scratch, path, ".mtlx", &found);
    if (reason)
        diag_add(diags, DIAG_ID_file_unreadable, (struct diag_place){.file = path}, path, reason);
    for (uint32_t i = 0; i < found.len; i++)
        read_file(load, found.items[i]);
}

static const char *text_of(const struct library *lib, str_id id)
{
    return str_text(&lib->strings, id);
}

/*
 * Warns of each implementation with faults and tells the first of them. All are errors of the nodes
 * that need it.
 */
static void report_broken(mxg_library *library)
{
    const struct library *layer = &library->layer;
    struct diag_list *diags = &library->object.diagnostics.list;
    for (uint32_t i = 0; i < layer->impls.len; i++) {
        const struct implementation *impl = &layer->impls.items[i];
        if (impl->kind != IMPL_BROKEN)
            continue;
        assert(impl->count > 0 && impl->ref + impl->count <= layer->deferred->items.len);
        const struct diag *fault = &layer->deferred->items.items[impl->ref];
        diag_add(diags, DIAG_ID_broken_implementation, doc_name_place(&layer->doc, impl->element),
                 text_of(layer, impl->name),
                 text_of(layer, library_nodedef(layer, impl->nodedef)->name));
        diag_add(diags, DIAG_ID_fault_of_source, fault->place, fault->message);
    }
}

static void read_paths(void *arg)
{
    struct load *load = arg;
    mxg_library *library = load->library;
    struct lang_reader reader = file_source_for_lang(&load->files);
    library_init(&library->layer, &library->object.arena, load->base ? &load->base->layer : NULL);
    for (uint32_t i = 0; load->base && i < load->base->folders.len; i++)
        vec_push(&library->object.arena, &load->files.folders, load->base->folders.items[i]);
    for (size_t i = 0; i < load->num_paths; i++)
        if (folder_exists(load->paths[i]))
            file_source_add_folder(&load->files, load->paths[i]);
    library->folders.items = load->files.folders.items;
    library->folders.len = load->files.folders.len;
    load->files.digest = hash_mix(HASH_STABLE_SEED, load->base ? load->base->layer.digest : 0);
    for (size_t i = 0; i < load->num_paths; i++)
        read_path(load, load->paths[i]);
    library->layer.knows_target = target_exists;
    library->layer.target_user_data = library->object.context;
    library_leave_older(&library->layer, &library->object.diagnostics.list);
    library_index(&library->layer, &reader, &library->object.diagnostics.list);
    library->layer.digest = load->files.digest;
    library_resolve_graphs(&library->layer, &library->object.diagnostics.list);
    report_broken(library);
    library_report_foreign(&library->layer, &load->files.scratch,
                           &library->object.diagnostics.list);
    lang_make_canonical(&library->layer.unit);
}

/* Makes one library layer: `work` reads the paths. */
static mxg_status load_layer(mxg_context *context, mxg_library *base, const char *const *paths,
                             size_t num_paths, void (*work)(void *), mxg_library **out)
{
    struct load load = {.library =
                            object_new(context, sizeof *load.library, base ? &base->object : NULL),
                        .base = base,
                        .paths = paths,
                        .num_paths = num_paths};
    if (!load.library)
        return MXG_ERROR_MEMORY;
    struct object *object = &load.library->object;
    file_source_init(&load.files, object);
    mxg_status status = object_run(object, work, &load);
    load.library->files.items = load.files.names.items;
    load.library->files.len = load.files.names.len;
    file_source_finish(&load.files);
    if (status != MXG_OK) {
        object_unref(object);
        return status;
    }
    *out = load.library;
    return object_status(object);
}

mxg_status mxg_library_load(mxg_context *context, mxg_library *base, const char *const *paths,
                            size_t num_paths, mxg_library **out_library)
{
    if (out_library)
        *out_library = NULL;
    if (!context || !out_library || !context_has_texts(paths, num_paths)
        || (base && object_status(&base->object) != MXG_OK))
        return MXG_ERROR_ARGUMENT;
    if (base || num_paths == 0 || !is_image(paths[0]))
        return load_layer(context, base, paths, num_paths, read_paths, out_library);
    /* A library image is the lowest layer; further paths form a layer above it. */
    mxg_status status = load_layer(context, NULL, paths, 1, map_image, out_library);
    if (status != MXG_OK || num_paths == 1)
        return status;
    mxg_library *image = *out_library;
    *out_library = NULL;
    status = load_layer(context, image, paths + 1, num_paths - 1, read_paths, out_library);
    mxg_library_unref(image);
    return status;
}

/* ---- Files ---- */

static const mxg_library *base_of(const mxg_library *library)
{
    return (const mxg_library *)library->object.below;
}

uint32_t mxg_library_num_files(const mxg_library *library)
{
    uint32_t count = 0;
    for (; library; library = base_of(library))
        count += library->files.len;
    return count;
}

const char *mxg_library_file(const mxg_library *library, uint32_t index)
{
    for (; library; library = base_of(library)) {
        uint32_t below = mxg_library_num_files(base_of(library));
        if (index >= below)
            return index - below < library->files.len ? library->files.items[index - below] : NULL;
    }
    return NULL;
}

/* ---- As image and as text ---- */

enum { TEXT_IMAGE, TEXT_EXPANDED, TEXT_LOSSES, NUM_LIBRARY_TEXTS };
_Static_assert((int)NUM_LIBRARY_TEXTS <= OBJECT_MAX_TEXTS, "an object has room for them");

/* The syntax in which images hold functions; NULL: no target has one. */
static const struct lang_syntax *image_syntax(void)
{
    for (const struct target *const *target = targets; *target; target++)
        if ((*target)->syntax->in_images)
            return (*target)->syntax;
    return NULL;
}

static void write_image(const struct object *object, struct text *out)
{
    const mxg_library *library = (const mxg_library *)object;
    library_write_image(&library->layer, image_syntax(), out);
}

static void write_expanded(const struct object *object, struct text *out)
{
    library_write(&((const mxg_library *)object)->layer, out);
}

/* The data are a pointer to the diagnostics, which are complete, and live in the same block. */
static void write_losses(const struct object *object, struct text *out)
{
    const mxg_library *library = (const mxg_library *)object;
    struct mxg_diagnostics *losses = ARENA_NEW(out->arena, struct mxg_diagnostics);
    losses->owner = (struct object *)(uintptr_t)object; /* it is never const */
    diag_list_init(&losses->list, out->arena);
    losses->list.max_errors = object->context->max_errors;
    losses->list.policy = &object->context->policy;
    library_report_losses(&library->layer, &losses->list);
    text_mem(out, (const char *)&losses, sizeof losses);
}

mxg_status mxg_library_image(mxg_library *library, const void **out_data, size_t *out_size)
{
    if (!library || !out_data || !out_size || library->object.below)
        return MXG_ERROR_ARGUMENT;
    const struct diag_list *deferred = library->layer.deferred; /* NULL: from an image */
    if (object_status(&library->object) != MXG_OK || (deferred && deferred->items.len))
        return MXG_ERROR_DOCUMENT;
    *out_data = library->image;
    *out_size = library->image_size;
    if (library->image)
        return MXG_OK;
    const struct made_text *made = object_text(&library->object, TEXT_IMAGE, write_image);
    if (!made)
        return MXG_ERROR_MEMORY;
    assert(made->size % 16 == 0);
    *out_data = made->data;
    *out_size = made->size;
    return MXG_OK;
}

const char *mxg_library_xml(mxg_library *library, size_t *out_size)
{
    const struct made_text *made =
        library ? object_text(&library->object, TEXT_EXPANDED, write_expanded) : NULL;
    if (out_size)
        *out_size = made ? made->size : 0;
    return made ? made->data : NULL;
}

const mxg_diagnostics *mxg_library_losses(mxg_library *library)
{
    const struct made_text *made =
        library ? object_text(&library->object, TEXT_LOSSES, write_losses) : NULL;
    const mxg_diagnostics *losses = NULL;
    if (made)
        memcpy(&losses, made->data, sizeof losses);
    return losses;
}

/* ---- Definitions ---- */

static const char *attr_text(const struct library *lib, elem_id element, str_id name)
{
    return text_of(lib, doc_attr_value(&lib->doc, element, name));
}

uint32_t mxg_library_num_nodedefs(const mxg_library *library)
{
    return library ? library_num_nodedefs(&library->layer) : 0;
}

/* True if an implementation serves the target; `target` NULL: any target. */
static bool serves(const struct library *lib, const struct implementation *impl,
                   const struct target *target)
{
    return impl->kind != IMPL_BROKEN
           && (!target || library_is_portable(lib, impl)
               || target_is_a(target, text_of(lib, impl->target)));
}

/* Implementation `index` of a definition, those of higher layers first; NULL: it has fewer. */
static const struct implementation *implementation_at(const struct library *lib, uint32_t id,
                                                      uint32_t index)
{
    for (const struct library *layer = lib;; layer = layer->base) {
        bool is_own = id >= layer->base_nodedefs;
        uint32_t next =
            is_own ? library_nodedef(lib, id)->first_impl : library_first_override(layer, id);
        while (next != LIBRARY_NONE) {
            const struct implementation *impl = library_impl(lib, next, NULL);
            assert(impl->nodedef == id);
            if (index-- == 0)
                return impl;
            next = impl->next;
        }
        if (is_own)
            return NULL;
    }
}

static bool has_implementation(const struct mxg_context *context, const struct library *lib,
                               uint32_t id, const struct target *target)
{
    const struct nodedef *def = library_nodedef(lib, id);
    const struct implementation *impl;
    if (codes_serve(context, text_of(lib, def->name), text_of(lib, def->node), target))
        return true;
    for (uint32_t i = 0; (impl = implementation_at(lib, id, i)) != NULL; i++)
        if (serves(lib, impl, target))
            return true;
    return false;
}

bool mxg_library_has_implementation(const mxg_library *library, uint32_t nodedef,
                                    const char *target)
{
    const struct target *found =
        library && target ? context_target(library->object.context, target) : NULL;
    return found && nodedef < mxg_library_num_nodedefs(library)
           && has_implementation(library->object.context, &library->layer, nodedef, found);
}

mxg_status definition_info(const struct mxg_context *context, const struct library *lib,
                           uint32_t index, mxg_nodedef *out)
{
    if (index >= library_num_nodedefs(lib))
        return MXG_ERROR_ARGUMENT;
    const struct nodedef *def = library_nodedef(lib, index);
    const char *file = doc_place(&lib->doc, def->element).file;
    mxg_nodedef full = {
        .name = text_of(lib, def->name),
        .node = text_of(lib, def->node),
        .version = text_of(lib, def->version),
        .group = attr_text(lib, def->element, STR_nodegroup),
        .doc = attr_text(lib, def->element, STR_doc),
        .file = file ? file : "",
        .num_inputs = def->num_inputs,
        .num_outputs = def->num_outputs,
        .has_implementation = has_implementation(context, lib, index, NULL),
        .is_default_version = !def->version || def->is_default_version,
    };
    return struct_write(out, &full, sizeof full);
}

mxg_status mxg_library_nodedef(const mxg_library *library, uint32_t index, mxg_nodedef *out)
{
    return library ? definition_info(library->object.context, &library->layer, index, out)
                   : MXG_ERROR_ARGUMENT;
}

mxg_status definition_port(const struct library *lib, uint32_t nodedef, uint32_t index,
                           mxg_port *out)
{
    if (nodedef >= library_num_nodedefs(lib))
        return MXG_ERROR_ARGUMENT;
    const struct nodedef *def = library_nodedef(lib, nodedef);
    if (index >= (uint32_t)def->num_inputs + def->num_outputs)
        return MXG_ERROR_ARGUMENT;
    const struct port *port = library_ports(lib, nodedef, NULL) + index;
    mxg_port full = {
        .name = text_of(lib, port->name),
        .type = text_of(lib, library_type_name(lib, port->type)),
        .value = text_of(lib, port->value),
        .defaultgeomprop = index < def->num_inputs ? text_of(lib, port->geomprop) : "",
        .unit = attr_text(lib, port->element, STR_unit),
        .uniform = port->flags & PORT_UNIFORM,
        .advanced = doc_attr_is_true(&lib->doc, port->element, STR_uiadvanced),
        .unittype = attr_text(lib, port->element, STR_unittype),
#define UI(member, attribute, key) .member = attr_text(lib, port->element, STR_##attribute),
#include "shader/ui.def"
#undef UI
    };
    return struct_write(out, &full, sizeof full);
}

mxg_status mxg_library_port(const mxg_library *library, uint32_t nodedef, uint32_t index,
                            mxg_port *out)
{
    return library ? definition_port(&library->layer, nodedef, index, out) : MXG_ERROR_ARGUMENT;
}

/* ---- Implementations ---- */

uint32_t definition_num_implementations(const struct library *lib, uint32_t nodedef)
{
    uint32_t num = 0;
    while (nodedef < library_num_nodedefs(lib) && implementation_at(lib, nodedef, num))
        num++;
    return num;
}

mxg_status definition_implementation(const struct library *lib, uint32_t nodedef, uint32_t index,
                                     mxg_implementation *out)
{
    const struct implementation *impl =
        nodedef < library_num_nodedefs(lib) ? implementation_at(lib, nodedef, index) : NULL;
    if (!impl)
        return MXG_ERROR_ARGUMENT;
    bool is_graph = doc_element(&lib->doc, impl->element)->kind == KIND_NODEGRAPH;
    mxg_implementation full = {
        .name = text_of(lib, impl->name),
        .target = text_of(lib, impl->target),
        .nodegraph =
            is_graph ? text_of(lib, impl->name) : attr_text(lib, impl->element, STR_nodegraph),
        .file = attr_text(lib, impl->element, STR_file),
        .function = attr_text(lib, impl->element, STR_function),
        .sourcecode = attr_text(lib, impl->element, STR_sourcecode),
    };
    return struct_write(out, &full, sizeof full);
}

uint32_t mxg_library_num_implementations(const mxg_library *library, uint32_t nodedef)
{
    return library ? definition_num_implementations(&library->layer, nodedef) : 0;
}

mxg_status mxg_library_implementation(const mxg_library *library, uint32_t nodedef, uint32_t index,
                                      mxg_implementation *out)
{
    return library ? definition_implementation(&library->layer, nodedef, index, out)
                   : MXG_ERROR_ARGUMENT;
}
