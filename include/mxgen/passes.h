// SPDX-License-Identifier: Apache-2.0
/*
 * Passes of the deferred pipeline (docs/deferred.md of the project).
 */
#include <mxgen/mxgen.h>

#ifndef MXGEN_PASSES_H
#define MXGEN_PASSES_H

#ifdef __cplusplus
extern "C" {
#endif

/*
 * The passes of the deferred pipeline that belong to no material (docs/deferred.md), in their
 * order. Their texts depend on the options alone. A pass is a result with one source, of a compute
 * stage, in the place of the pixel stage; a lighting pass has variables, as a surface has. A pass
 * that the options do not ask for ("diffuse", "blur") has no source and no reflection. `desc` names
 * a target and options only.
 */
MXG_API uint32_t mxg_catalogue_num_passes(void);
MXG_API const char *mxg_catalogue_pass(uint32_t index); /* NULL: there is no such pass */
MXG_API mxg_status mxg_generate_pass(mxg_context *context, uint32_t index,
                                     const mxg_generate_desc *desc, mxg_result **out_result);

/* How a pass runs. */
typedef struct mxg_pass {
    size_t size; /* in */
    const char *name;
    /* invocations of a group, which covers a tile of as many pixels; 0: functions without a main */
    uint32_t group_size[3];
    /* the buffer `tiles` has the command of its dispatch; else a group per tile */
    bool is_indirect;
    uint32_t dispatch_offset; /* of that command, in bytes */
    uint32_t reads, writes;   /* bits of resources, by their index */
} mxg_pass;
/* MXG_ERROR_ARGUMENT: the result is no pass. */
MXG_API mxg_status mxg_result_pass(const mxg_result *result, mxg_pass *out);

#ifdef __cplusplus
}
#endif

#endif
