// SPDX-License-Identifier: Apache-2.0
/* Versions, status texts, contexts. */
#include "api/api.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#define TEXT_OF(number) #number
#define VERSION_TEXT(major, minor, patch) TEXT_OF(major) "." TEXT_OF(minor) "." TEXT_OF(patch)

const char *mxg_version_string(void)
{
    return VERSION_TEXT(MXG_VERSION_MAJOR, MXG_VERSION_MINOR, MXG_VERSION_PATCH);
}

const char *mxg_status_string(mxg_status status)
{
    switch (status) {
    case MXG_OK: return "ok";
    case MXG_ERROR_DOCUMENT: return "the document has errors";
    case MXG_ERROR_ARGUMENT: return "bad argument";
    case MXG_ERROR_MEMORY: return "out of memory";
    case MXG_ERROR_CANCELLED: return "cancelled";
    default: return "unknown status";
    }
}

/* The embedded library image: library/builtin_image.S. */
extern const char mxg_builtin_image[], mxg_builtin_image_end[];

static void map_builtin(struct mxg_context *context)
{
    struct mxg_library *builtin = &context->builtin;
    size_t size = (size_t)(mxg_builtin_image_end - mxg_builtin_image);
    object_init(&builtin->object, context, 0);
    /* The image is part of the program, so it needs no validation. */
    if (!size || library_map_image(&builtin->layer, mxg_builtin_image, size, false))
        return;
    builtin->image = mxg_builtin_image;
    builtin->image_size = size;
}

static uint32_t or_default(uint32_t limit, uint32_t standard)
{
    return limit ? limit : standard;
}

/* ---- Refusals ---- */

mxg_status refuse(struct refusal *why, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(why->text, sizeof why->text, format, args);
    va_end(args);
    return MXG_ERROR_ARGUMENT;
}

bool context_has_texts(const char *const *texts, size_t num_texts)
{
    for (size_t i = 0; i < num_texts; i++)
        if (!texts || !texts[i])
            return false;
    return true;
}

/* Reads the description and its words. */
static mxg_status read_desc(const mxg_context_desc *desc, mxg_context_desc *out,
                            struct diag_policy *policy, struct refusal *why)
{
    if (desc && !struct_read(out, sizeof *out, desc))
        return refuse(why, "the size is not set; begin with MXG_CONTEXT_DESC_INIT");
    if (out->resolver && (!out->resolver->open || !out->resolver->release))
        return refuse(why, "the resolver needs both open and release");
    if (!context_has_texts(out->include_roots, out->num_include_roots))
        return refuse(why, "include_roots does not have num_include_roots items");
    if (!context_has_texts(out->source_paths, out->num_source_paths))
        return refuse(why, "source_paths does not have num_source_paths items");
    const char *fault = diag_policy_parse(policy, out->warnings ? out->warnings : "");
    return fault ? refuse(why,
                          "warnings has the unknown word '%.*s'; expected error, error=ID, "
                          "no-error=ID, no-ID or ID, with an ID of a diagnostic",
                          (int)strcspn(fault, ", "), fault)
                 : MXG_OK;
}

/* Copies the folders of the description; false: out of memory. */
static bool take_folders(mxg_context *context, const mxg_context_desc *d)
{
    bool is_good = true;
    for (size_t i = 0; i < d->num_include_roots && is_good; i++)
        is_good = sandbox_admit_folder(context, d->include_roots[i]);
    for (size_t i = d->num_source_paths; i-- > 0 && is_good;)
        is_good = source_path_add(context, d->source_paths[i]);
    return is_good;
}

static mxg_status create(const mxg_context_desc *desc, mxg_context **out_context,
                         struct refusal *why)
{
    mxg_context_desc d = MXG_CONTEXT_DESC_INIT;
    struct diag_policy policy;
    mxg_status status = read_desc(desc, &d, &policy, why);
    if (status != MXG_OK)
        return status;
    struct mem mem;
    mem_init(&mem, d.realloc, d.realloc_user_data);
    size_t size = sizeof(mxg_context);
    mxg_context *context =
        d.max_memory && d.max_memory < size ? NULL : mem.realloc(mem.user_data, NULL, 0, size);
    if (!context)
        return MXG_ERROR_MEMORY;
    memset(context, 0, size);
    context->mem = mem;
    atomic_init(&context->used, size);
    context->max_memory = d.max_memory;
    context->policy = policy;
    context->cancel = d.cancel;
    context->cancel_user_data = d.cancel_user_data;
    if (d.texels)
        context->texels = *d.texels;
    context->xml_limits = (struct xml_limits){.max_depth = d.max_depth,
                                              .max_include_depth = d.max_include_depth,
                                              .max_includes = d.max_includes,
                                              .max_elements = d.max_elements,
                                              .max_file_mib = or_default(d.max_file_mib, 256)};
    context->max_nodes = or_default(d.max_nodes, 64000000);
    context->max_output_mib = or_default(d.max_output_mib, 256);
    context->max_errors = or_default(d.max_errors, 20);
    context->sandbox = d.sandbox;
    context->trust = d.trust     ? LIBRARY_TRUST_ALL
                     : d.sandbox ? LIBRARY_TRUST_GRAPHS
                                 : LIBRARY_TRUST_PORTABLE;
    status = take_folders(context, &d) ? dialects_take(context, &d, why) : MXG_ERROR_MEMORY;
    if (status == MXG_OK)
        status = codes_take(context, &d, why);
    if (status != MXG_OK) {
        mxg_context_destroy(context);
        return status;
    }
    xml_startup();
    context->resolver = d.resolver ? *d.resolver : stdio_resolver(context);
    map_builtin(context);
    *out_context = context;
    return MXG_OK;
}

mxg_status mxg_context_create(const mxg_context_desc *desc, mxg_context **out_context)
{
    struct refusal why = {0};
    if (!out_context)
        return MXG_ERROR_ARGUMENT;
    *out_context = NULL;
    return create(desc, out_context, &why);
}

size_t mxg_context_desc_error(const mxg_context_desc *desc, char *buffer, size_t capacity)
{
    struct refusal why = {0};
    mxg_context *context = NULL;
    create(desc, &context, &why);
    mxg_context_destroy(context);
    return text_copy(why.text, strlen(why.text), buffer, capacity);
}

void mxg_context_destroy(mxg_context *context)
{
    if (!context)
        return;
    assert(atomic_load(&context->used) >= sizeof *context);
    object_empty(&context->builtin.object);
    sandbox_finish(context);
    source_paths_finish(context);
    codes_finish(context);
    dialects_finish(context);
    context->mem.realloc(context->mem.user_data, context, sizeof *context, 0);
}
