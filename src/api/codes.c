// SPDX-License-Identifier: Apache-2.0
/* The codes of a context: nodes in C (mxgen/node.h). */
#include "api/api.h"

#include <assert.h>

static mxg_status check(const mxg_context *context, const mxg_node_code *code, struct refusal *why)
{
    if (!code->name || !*code->name)
        return refuse(why, "a code for a node has no name");
    if ((code->build != NULL) == (code->instead != NULL))
        return refuse(why, "the code for '%s' needs one of build and instead", code->name);
    if (code->target && !target_exists(context, code->target))
        return refuse(why,
                      "the code for '%s' is for the unknown target '%s'; expected a name of "
                      "MaterialX, for example 'genglsl'",
                      code->name, code->target);
    return MXG_OK;
}

mxg_status codes_take(struct mxg_context *context, const mxg_context_desc *desc,
                      struct refusal *why)
{
    mxg_status status = MXG_OK;
    size_t size = desc->num_node_codes * sizeof *context->codes;
    assert(!context->codes);
    if (!desc->num_node_codes)
        return MXG_OK;
    if (!desc->node_codes || desc->num_node_codes > UINT32_MAX / sizeof *context->codes)
        return refuse(why, "node_codes does not have num_node_codes items");
    context->codes = context->mem.realloc(context->mem.user_data, NULL, 0, size);
    if (!context->codes)
        return MXG_ERROR_MEMORY;
    context->num_codes = (uint32_t)desc->num_node_codes;
    atomic_fetch_add(&context->used, size);
    for (uint32_t i = 0; i < context->num_codes && status == MXG_OK; i++) {
        const mxg_node_code *given = desc->node_codes[i];
        status = given && struct_read(&context->codes[i], sizeof *context->codes, given)
                     ? check(context, &context->codes[i], why)
                     : refuse(why, "node_codes[%u] is NULL, or its size is not set", i);
    }
    return status;
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
