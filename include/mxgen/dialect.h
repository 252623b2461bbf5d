// SPDX-License-Identifier: Apache-2.0
/*
 * Targets of a host: mxg_context_desc.dialects, and mxg_plugin.dialects for the command line.
 */
#include <mxgen/mxgen.h>

#ifndef MXGEN_DIALECT_H
#define MXGEN_DIALECT_H

#ifdef __cplusplus
extern "C" {
#endif

/*
 * A target of the host: a target of mxgen under another name. A <targetdef> of this name, with
 * `inherit`, lets libraries have implementations for it; those for the base serve it, too.
 */
typedef struct mxg_dialect {
    size_t size;         /* sizeof(mxg_dialect) */
    const char *name;    /* for mxg_generate_desc.target and for libraries: "mygl" */
    const char *base;    /* "glsl", or "genglsl" */
    const char *version; /* of the language: the default of `target-version`; NULL: that of base */
    /* other defaults of options: key, value, key, value …; num_options is the number of pairs */
    const char *const *options;
    size_t num_options;
    /* file endings of the vertex and the pixel stage; NULL: those of base */
    const char *stage_suffix[2];
} mxg_dialect;

#ifdef __cplusplus
}
#endif

#endif
