// SPDX-License-Identifier: Apache-2.0
/*
 * The catalogue: what this version of mxgen has, whatever is loaded. For lists, help and user
 * interfaces of a host.
 */
#include <mxgen/mxgen.h>

#ifndef MXGEN_CATALOGUE_H
#define MXGEN_CATALOGUE_H

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Targets and options ---- */

typedef struct mxg_target {
    size_t size; /* in */
    const char *name, *materialx_name, *brief;
    /*
     * file endings of the vertex and the pixel stage (OSL: of displacement and shader); NULL: no
     * such stage
     */
    const char *stage_suffix[2];
    /*
     * of the passes of mxg_generate_pass: of a compute stage, and of functions alone; NULL: the
     * target has no passes
     */
    const char *pass_suffix[2];
} mxg_target;
MXG_API uint32_t mxg_catalogue_num_targets(void);
MXG_API mxg_status mxg_catalogue_target(uint32_t index, mxg_target *out);

typedef enum mxg_option_type {
    MXG_OPTION_BOOL,
    MXG_OPTION_INT,
    MXG_OPTION_STRING,
    MXG_OPTION_ENUM,
    MXG_OPTION_LIST,
    MXG_OPTION_FLOAT, /* empty: not set */
    MXG_OPTION_MAX_ENUM = 0x7fffffff
} mxg_option_type;
typedef struct mxg_option {
    size_t size;     /* in */
    const char *key; /* "interface" */
    mxg_option_type type;
    /*
     * ENUM, or LIST of such items: "complete|authored|reduced"; INT, FLOAT: "0..1024"; STRING:
     * "identifier"; LIST, STRING that names something: ""
     */
    const char *values;
    const char *initial; /* the default, as text */
    const char *doc;
} mxg_option;
/*
 * Every option of generation. The command line makes its flags from this list; a host can make its
 * user interface from it.
 */
MXG_API uint32_t mxg_catalogue_num_options(void);
MXG_API mxg_status mxg_catalogue_option(uint32_t index, mxg_option *out);
/*
 * True if the option has a meaning for the target; a target ignores the others, so one set of
 * options serves several targets. False for an unknown index or target.
 */
MXG_API bool mxg_catalogue_has_option(uint32_t index, const char *target);

/* ---- Semantics ---- */

/*
 * The meaning of a variable without a path: space, unit, direction and range (docs/reflection.md
 * has the table). World space is right-handed, vectors are columns, matrices are stored column by
 * column, and clip space is that of the host's projectionMatrix.
 */
typedef struct mxg_semantic {
    size_t size; /* in */
    mxg_block block;
    /*
     * mxg_variable.semantic; the name of a member of LightData; "texcoord:*": '*' stands for an
     * index, the name of a property, or a variant of a matrix
     */
    const char *semantic;
    const char *type; /* "vec3"; "": several */
    const char *doc;
} mxg_semantic;
MXG_API uint32_t mxg_catalogue_num_semantics(void);
MXG_API mxg_status mxg_catalogue_semantic(uint32_t index, mxg_semantic *out);

/* ---- Diagnostics ---- */

/* Every diagnostic that mxgen can report, for lists and help: `mxgen explain`. Static. */
typedef struct mxg_diagnostic_kind {
    size_t size;           /* in: sizeof(mxg_diagnostic_kind) */
    const char *id;        /* stable, for example "type-mismatch" */
    mxg_severity severity; /* default; the context's `warnings` can change it */
    const char *message;   /* a format with %s and %u */
    const char *cause, *cure;
    /*
     * An example as a diff. Lines with "- " belong to the wrong version, lines with "+ " to the
     * right one, lines with two spaces to both. "== NAME" begins another file than example.mtlx. "$
     * ", "-$ " and "+$ " give the arguments of mxgen if they matter. "": no example.
     */
    const char *example;
} mxg_diagnostic_kind;
MXG_API uint32_t mxg_catalogue_num_diagnostic_kinds(void);
MXG_API mxg_status mxg_catalogue_diagnostic_kind(uint32_t index, mxg_diagnostic_kind *out);

#ifdef __cplusplus
}
#endif

#endif
