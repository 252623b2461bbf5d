// SPDX-License-Identifier: Apache-2.0
/* The callbacks as C functions, whose addresses a mxg_context_desc can hold. */
#include <mxgen/mxgen.h>

#include "native/host.h"

static const mxg_resolver resolvers[] = {
    {.open = host_open, .release = host_release},
    {.open = host_open, .release = host_release, .list_folder = host_list_folder},
};

/*
 * mxg_context_create for JavaScript. `host` is the number of the callbacks; the other arguments
 * tell which callbacks there are. `desc` has the other members.
 */
MXG_API mxg_status mxgen_js_context(mxg_context_desc *desc, void *host, bool lists_folders,
                                    bool cancels, bool reads_texels, mxg_context **out_context);

mxg_status mxgen_js_context(mxg_context_desc *desc, void *host, bool lists_folders, bool cancels,
                            bool reads_texels, mxg_context **out_context)
{
    /* the description has them afterwards, too, when JavaScript asks what is wrong with it */
    static mxg_resolver resolver;
    static mxg_texel_reader reader;
    resolver = resolvers[lists_folders];
    resolver.user_data = host;
    desc->resolver = &resolver;
    desc->cancel = cancels ? host_cancel : NULL;
    desc->cancel_user_data = host;
    reader = (mxg_texel_reader){host, host_read_texels};
    desc->texels = reads_texels ? &reader : NULL;
    return mxg_context_create(desc, out_context);
}

/* mxg_bindings_write and mxg_bindings_write_reasons; the pieces go to the import `write`. */
MXG_API mxg_status mxgen_js_bindings_write(const mxg_bindings *bindings,
                                           mxg_bindings_format format);
MXG_API mxg_status mxgen_js_bindings_write_reasons(const mxg_bindings *bindings,
                                                   uint32_t primitive);

mxg_status mxgen_js_bindings_write(const mxg_bindings *bindings, mxg_bindings_format format)
{
    return mxg_bindings_write(bindings, format, host_write, NULL);
}

mxg_status mxgen_js_bindings_write_reasons(const mxg_bindings *bindings, uint32_t primitive)
{
    return mxg_bindings_write_reasons(bindings, primitive, host_write, NULL);
}

/* mxg_scene_add_primitives; the import `next_primitive` gives the primitives. */
MXG_API mxg_status mxgen_js_scene_add_primitives(mxg_scene *scene, void *adding);

mxg_status mxgen_js_scene_add_primitives(mxg_scene *scene, void *adding)
{
    return mxg_scene_add_primitives(scene, host_next_primitive, adding);
}
