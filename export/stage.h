// SPDX-License-Identifier: Apache-2.0
/* The stage of `--stage`: its objects, and the material that each look gives to each of them. */
#ifndef MXG_EXPORT_STAGE_H
#define MXG_EXPORT_STAGE_H

#include "program/name_table.h"
#include "render/site.h"

#include <mxgen/scene.h>

/* A look on an object. */
struct stage_dress {
    bool is_hidden;
    char *material; /* its name; NULL: none */
};

struct stage {
    struct site site;
    const char **looks; /* NULL alone: a document without looks */
    size_t num_looks;
    struct stage_dress *dresses; /* those of a look one after the other, by object */
    struct name_table worn;      /* the names of their materials */
    struct name_table told;      /* lost layers */
};

/* false after reporting an error. Call stage_close in any case. */
bool stage_open(struct stage *stage, struct cli *cli, const char *path);
/*
 * Finds the materials by a look of a document, which lives longer; `look` NULL: by all of them, or
 * by the first one, if the format has no variants. Tells the others, and layers that a single
 * material cannot have. false after reporting an error.
 */
bool stage_bind(struct stage *stage, struct cli *cli, const mxg_document *document,
                const char *look, bool has_variants);
void stage_close(struct stage *stage);

const struct stage_dress *stage_dress(const struct stage *stage, size_t look, uint32_t object);
/* True if a look shows the object. */
bool stage_shows(const struct stage *stage, uint32_t object);

#endif
