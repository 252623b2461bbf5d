// SPDX-License-Identifier: Apache-2.0
/* The stage of `--stage`: its objects, and the material that each look gives to each of them. */
#ifndef MXG_EXPORT_DRESSED_SITE_H
#define MXG_EXPORT_DRESSED_SITE_H

#include "program/name_table.h"
#include "render/site.h"

#include <mxgen/scene.h>

/* A look on an object. */
struct site_dress {
    bool is_hidden;
    char *material; /* its name; NULL: none */
};

struct dressed_site {
    struct site site;
    const char **looks; /* NULL alone: a document without looks */
    size_t num_looks;
    struct site_dress *dresses; /* those of a look one after the other, by object */
    struct name_table worn;     /* the names of their materials */
    struct name_table told;     /* lost layers */
};

/* false after reporting an error. Call dressed_site_close in any case. */
bool dressed_site_open(struct dressed_site *stage, struct cli *cli, const char *path);
/*
 * Finds the materials by a look of a document, which lives longer; `look` NULL: by all of them, or
 * by the first one, if the format has no variants. Tells the others, and layers that a single
 * material cannot have. false after reporting an error.
 */
bool dressed_site_bind(struct dressed_site *stage, struct cli *cli, const mxg_document *document,
                       const char *look, bool has_variants);
void dressed_site_close(struct dressed_site *stage);

const struct site_dress *dressed_site_dress(const struct dressed_site *stage, size_t look,
                                            uint32_t object);
/* True if a look shows the object. */
bool dressed_site_shows(const struct dressed_site *stage, uint32_t object);

#endif
