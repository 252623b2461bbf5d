// SPDX-License-Identifier: Apache-2.0
/* mxg_context_desc.read_texels: mxgen-render, which has OpenImageIO, reads the file. */
#ifndef MXG_PROGRAM_TEXEL_READER_H
#define MXG_PROGRAM_TEXEL_READER_H

#include <stdbool.h>
#include <stdint.h>

/* The first word of its arguments; then come the file, its layer, and the size. */
#define CLI_TEXELS "--texels"

/* user_data is not used. False: there is no renderer, or it cannot read the file. */
bool cli_read_texels(void *user_data, const char *from, const char *file, const char *layer,
                     uint32_t size, float *out_texels);

#endif
