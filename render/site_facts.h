// SPDX-License-Identifier: Apache-2.0
/*
 * Facts that a document states about the primitives of a site in <geominfo>: its geomprops are
 * constant primvars where the geometry has none of the name, its tokens are parts of the names of
 * files.
 */
#ifndef MXG_RENDER_SITE_FACTS_H
#define MXG_RENDER_SITE_FACTS_H

#include "program/name_table.h"
#include "render/bind_shader.h"

#include <mxgen/mxgen.h>

/* The primvars of an object: its own, and behind them those of a <geominfo>. */
struct site_primvars {
    struct scene_object all; /* with nothing else */
    uint32_t num_own;        /* of a <geominfo>; they belong to the list */
};

/* The lists that objects and subjects share. Zero-initialise it, and set the first three members.
 */
struct site_facts {
    const mxg_context *context;
    const mxg_document *document;
    const mxg_bindings *bindings;
    struct name_table known; /* by what a list is made of: its number, from 1 */
    struct site_primvars *lists;
    size_t num_lists;
    struct bind_tokens *tokens;
    size_t num_tokens;
    struct name_table read; /* the tokens in the names of the document's files */
    bool knows_files;       /* `read` is there */
};

/* Gives an object the geomprops of its primitive beside its own primvars. */
void site_add_geomprops(struct site_facts *facts, uint32_t primitive, struct scene_object *object);
/* The number of the tokens of a primitive that files of the document read; 0: there are none. */
uint32_t site_tokens(struct site_facts *facts, uint32_t primitive);
void site_facts_finish(struct site_facts *facts);

#endif
