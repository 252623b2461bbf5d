// SPDX-License-Identifier: Apache-2.0
/*
 * Budgets of slabs (docs/slabs.md of the project).
 */
#include <mxgen/mxgen.h>

#ifndef MXGEN_SLABS_H
#define MXGEN_SLABS_H

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Reads textures for the estimated errors of budgets: mxg_context_desc.texels. mxgen calls it at
 * most once per texture of a call, from the thread of the call, where steps of a budget are
 * estimated: with the option max-error, or if the warnings budget-step are shown. It must not call
 * mxgen.
 */
typedef struct mxg_texel_reader {
    void *user_data;
    /*
     * The means of `size` by `size` equal parts of a texture, rows from the top, RGBA each, without
     * a change of colour space. `from` and `file` are as in mxg_resolver.open; `layer` is the name
     * of the file's layer, or "". False: it cannot be read.
     */
    bool (*read_texels)(void *user_data, const char *from, const char *file, const char *layer,
                        uint32_t size, float *out_texels);
} mxg_texel_reader;

/*
 * CIEDE2000 (Sharma, Wu and Dalal 2005) between linear colours of Rec. 709, cut to 0 to 1: budgets
 * of slabs and their pictures are measured by it.
 */
MXG_API double mxg_color_difference(const float a[3], const float b[3]);

#ifdef __cplusplus
}
#endif

#endif
