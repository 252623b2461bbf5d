// SPDX-License-Identifier: Apache-2.0
/*
 * Looking inside: a document or a shader as a text for people, and where a shader comes from.
 */
#include <mxgen/mxgen.h>

#ifndef MXGEN_INSPECT_H
#define MXGEN_INSPECT_H

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Views ---- */

typedef enum mxg_view {
    MXG_VIEW_ELEMENTS, /* the element tree and the renderables */
    MXG_VIEW_GRAPH,    /* nodes and connections as text */
    MXG_VIEW_DOT,      /* the same for Graphviz */
    MXG_VIEW_IR,       /* the optimised IR (docs/ir.md) */
    MXG_VIEW_CLOSURES, /* leaves with weights */
    MXG_VIEW_STATISTICS,
    /* the tree of slabs, what they cost, and steps to one slab (docs/slabs.md) */
    MXG_VIEW_SLABS,
    MXG_VIEW_SLABS_JSON, /* the same as JSON */
    MXG_VIEW_MAX_ENUM = 0x7fffffff
} mxg_view;
/*
 * A text for people. *out_result holds it; mxg_result_text returns it. desc selects the element,
 * target and options if the view needs them.
 */
MXG_API mxg_status mxg_inspect(mxg_context *context, const mxg_document *document, mxg_view view,
                               const mxg_generate_desc *desc, mxg_result **out_result);

/* ---- Places ---- */

/* A place in a document. */
typedef struct mxg_place {
    size_t size; /* in */
    const char *file;
    uint32_t line, column;
    const char *path; /* of the element: "SR_gold/base_color" */
} mxg_place;
/*
 * The place in the document that produced a line (from 1) of a stage's source. MXG_ERROR_ARGUMENT:
 * there is none.
 */
MXG_API mxg_status mxg_result_source_place(const mxg_result *result, mxg_stage stage, uint32_t line,
                                           mxg_place *out);

/*
 * The path of the node that produced a line, also of a node inside a definition:
 * "SR_gold/coat_bsdf". Length 0: there is no path, or no memory.
 */
MXG_API size_t mxg_result_source_path(const mxg_result *result, mxg_stage stage, uint32_t line,
                                      char *buffer, size_t capacity);

/*
 * The path of the node that produced closure `index` (below num_closures of mxg_shader_info), in
 * the same way.
 */
MXG_API size_t mxg_result_closure_path(const mxg_result *result, uint32_t index, char *buffer,
                                       size_t capacity);

#ifdef __cplusplus
}
#endif

#endif
