// SPDX-License-Identifier: Apache-2.0
/* The codes of a context: nodes in C (mxgen/node.h). */
#include "api/api.h"

#include <assert.h>

static bool is_usable(const mxg_context *context, const mxg_node_code *code)
{
    return code->name && *code->name && (code->build != NULL) != (code->instead != NULL)
           && (!code->target || target_exists(context, code->target));
}

mxg_status codes_take(struct mxg_context *context, const mxg_context_desc *desc)
{
    size_t size = desc->num_node_codes * sizeof *context->codes;
    assert(!context->codes);
    if (!desc->num_node_codes)
        return MXG_OK;
    if (!desc->node_codes || desc->num_node_codes > UINT32_MAX / sizeof *context->codes)
        return MXG_ERROR_ARGUMENT;
    context->codes = context->mem.realloc(context->mem.user_data, NULL, 0, size);
    if (!context->codes)
        return MXG_ERROR_MEMORY;
    context->num_codes = (uint32_t)desc->num_node_codes;
    atomic_fetch_add(&context->used, size);
    for (uint32_t i = 0; i < context->num_codes; i++)
        if (!desc->node_codes[i]
            || !struct_read(&context->codes[i], sizeof *context->codes, desc->node_codes[i])
            || !is_usable(context, &context->codes[i]))
            return MXG_ERROR_ARGUMENT;
    return MXG_OK;
}

void codes_finish(struct mxg_context *context)
{
    if (context->codes)
        context->mem.realloc(context->mem.user_data, context->codes,
                             context->num_codes * sizeof *context->codes, 0);
}

bool codes_serve(const struct mxg_context *context, const char *nodedef, const char *node,
                 const struct target *target)
{
    for (uint32_t i = 0; i < context->num_codes; i++) {
        const mxg_node_code *code = &context->codes[i];
        bool is_named = strcmp(code->name, nodedef) == 0 || strcmp(code->name, node) == 0;
        if (is_named && (!target || !code->target || target_is_a(target, code->target)))
            return true;
    }
    return false;
}
