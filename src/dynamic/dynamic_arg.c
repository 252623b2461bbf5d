// SPDX-License-Identifier: Apache-2.0
/* Arguments and faults of the definitions that code of mxgen serves. */
#include "dynamic/dynamic.h"

ir_ref dynamic_arg(const mxg_build *build, str_id name)
{
    for (unsigned i = 0; i < build->def->num_inputs; i++)
        if (build->ports[i].name == name)
            return build->frame->args[i];
    return 0;
}

bool dynamic_misfit(const mxg_build *build, const char *fault)
{
    struct builder *b = build->b;
    diag_add(b->diags, DIAG_ID_function_signature,
             doc_place(&b->lib->doc, build->frame->impl->element), build_text(b, build->def->node),
             build_text(b, build->def->name), fault);
    return false;
}
