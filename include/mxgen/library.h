// SPDX-License-Identifier: Apache-2.0
/*
 * Libraries as files, and their definitions.
 */
#include <mxgen/mxgen.h>

#ifndef MXGEN_LIBRARY_H
#define MXGEN_LIBRARY_H

#ifdef __cplusplus
extern "C" {
#endif

/*
 * The library image, for mxg_library_load and for embedding. It lives as long as the library. The
 * library must have no base, and no implementation with faults (MXG_ERROR_DOCUMENT).
 */
MXG_API mxg_status mxg_library_image(mxg_library *library, const void **out_data, size_t *out_size);
/*
 * The library as a plain MaterialX document with all templates expanded. It lives as long as the
 * library. NULL: out of memory.
 */
MXG_API const char *mxg_library_xml(mxg_library *library, size_t *out_size);
/*
 * Lists what this document lacks: a warning `expand-loss` for each input that mxgen's code for a
 * node reads, and the node's graph for other tools does not. They live as long as the library.
 * NULL: out of memory.
 */
MXG_API const mxg_diagnostics *mxg_library_losses(mxg_library *library);

typedef struct mxg_nodedef {
    size_t size;                                            /* in */
    const char *name, *node, *version, *group, *doc, *file; /* "" if absent */
    uint32_t num_inputs, num_outputs;
    bool has_implementation; /* for at least one target */
    bool is_default_version; /* a node without a version uses this definition */
} mxg_nodedef;

typedef struct mxg_port {
    size_t size; /* in */
    /* "" if absent */
    const char *name, *type, *value, *defaultgeomprop, *enum_names, *unit, *doc;
    bool uniform;
    bool advanced; /* uiadvanced */
    /* "" if absent */
    const char *enum_values, *unittype, *uiname, *uifolder, *uimin, *uimax, *uisoftmin, *uisoftmax,
        *uistep;
} mxg_port;

/* The count includes the definitions of the bases. */
MXG_API uint32_t mxg_library_num_nodedefs(const mxg_library *library);
MXG_API mxg_status mxg_library_nodedef(const mxg_library *library, uint32_t index,
                                       mxg_nodedef *out);
/* Port `index` of a definition: first the inputs, then the outputs. */
MXG_API mxg_status mxg_library_port(const mxg_library *library, uint32_t nodedef, uint32_t index,
                                    mxg_port *out);

/* An implementation gives a definition its meaning: an <implementation>, or a nodegraph with a
 * `nodedef`. */
typedef struct mxg_implementation {
    size_t size; /* in */
    /* "" if absent; `target` is MaterialX's name, "genosl", and absent in one for every target */
    const char *name, *target, *nodegraph, *file, *function, *sourcecode;
} mxg_implementation;
/* Those of a document or of a library above the definition's come first. */
MXG_API uint32_t mxg_library_num_implementations(const mxg_library *library, uint32_t nodedef);
MXG_API mxg_status mxg_library_implementation(const mxg_library *library, uint32_t nodedef,
                                              uint32_t index, mxg_implementation *out);
/*
 * True if the definition has an implementation for the target (by name), also one in C that the
 * context has.
 */
MXG_API bool mxg_library_has_implementation(const mxg_library *library, uint32_t nodedef,
                                            const char *target);

#ifdef __cplusplus
}
#endif

#endif
