// SPDX-License-Identifier: Apache-2.0
#include "program/slab_view.h"

json_t *slab_view_read(const struct cli *cli, const mxg_document *document, const char *element,
                       const char *target, const mxg_options *options)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_result *result = NULL;
    size_t size = 0;
    desc.target = target;
    desc.element = element;
    desc.options = options;
    mxg_inspect(cli->context, document, MXG_VIEW_SLABS_JSON, &desc, &result);
    const char *text = result ? mxg_result_text(result, &size) : NULL;
    json_t *view = text ? json_loadb(text, size, 0, NULL) : NULL;
    mxg_result_destroy(result);
    return view;
}
