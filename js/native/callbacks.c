// SPDX-License-Identifier: Apache-2.0
/* The callbacks as C functions, whose addresses a mxg_context_desc can hold. */
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
                                    bool cancels, mxg_context **out_context);

mxg_status mxgen_js_context(mxg_context_desc *desc, void *host, bool lists_folders, bool cancels,
                            mxg_context **out_context)
{
    mxg_resolver resolver = resolvers[lists_folders];
    resolver.user_data = host;
    desc->resolver = &resolver;
    desc->cancel = cancels ? host_cancel : NULL;
    desc->cancel_user_data = host;
    return mxg_context_create(desc, out_context);
}
