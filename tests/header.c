// SPDX-License-Identifier: Apache-2.0
/*
 * The public header stands alone, and says the same to C and C++ (header.cpp includes this file).
 */
#include <mxgen/mxgen.h>

#include <stdio.h>

int main(void)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_context_desc context = MXG_CONTEXT_DESC_INIT;
    mxg_variable variable = MXG_INIT(mxg_variable);
    bool good = variable.size == sizeof variable && !variable.name && desc.size == sizeof desc
                && !desc.target && context.size == sizeof context && !context.realloc
                && *mxg_version_string();
    printf("header: %d passed, %d failed, 0 skipped\n", good, !good);
    return good ? 0 : 1;
}
