// SPDX-License-Identifier: Apache-2.0
/* The meanings of the variables that the host supplies. */
#include "api/api.h"

static const mxg_semantic table[] = {
#define SEMANTIC(BLOCK, semantic, type, doc) \
    {sizeof(mxg_semantic), MXG_BLOCK_##BLOCK, semantic, type, doc},
#include "shader/semantics.def"
};

uint32_t mxg_catalogue_num_semantics(void)
{
    return sizeof table / sizeof *table;
}

mxg_status mxg_catalogue_semantic(uint32_t index, mxg_semantic *out)
{
    return index < mxg_catalogue_num_semantics()
               ? struct_write(out, &table[index], sizeof table[index])
               : MXG_ERROR_ARGUMENT;
}
