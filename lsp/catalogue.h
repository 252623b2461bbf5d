// SPDX-License-Identifier: Apache-2.0
/*
 * The names that documents can use: definitions of the library and of a document, types, units,
 * geometric properties, colour spaces.
 */
#ifndef MXG_LSP_CATALOGUE_H
#define MXG_LSP_CATALOGUE_H

#include "lsp/session.h"

/* A word with what it belongs to: a unit with its kind, a geometric property with its type. */
struct catalogue_word {
    const char *name, *of;
};
struct catalogue_words {
    struct catalogue_word *items;
    size_t len;
};

enum catalogue_kind {
    CATALOGUE_TYPES,
    CATALOGUE_UNITS,
    CATALOGUE_UNIT_TYPES,
    CATALOGUE_GEOMPROPS,
    CATALOGUE_COLORSPACES,
    CATALOGUE_TARGETS,
    NUM_CATALOGUE_KINDS
};

/* The words of the library. Reads the library if nothing did. */
const struct catalogue_words *catalogue_words(struct lsp_session *session,
                                              enum catalogue_kind kind);
/* Reads the library before somebody asks. False: it is read. */
bool catalogue_prepare(struct lsp_session *session);
void catalogue_destroy(struct catalogue *catalogue);

/* ---- Definitions ---- */

/* Those of the library and then those of the document, as it was read last. */
uint32_t catalogue_num_nodedefs(const struct lsp_query *query);
bool catalogue_nodedef(const struct lsp_query *query, uint32_t index, mxg_nodedef *out);
bool catalogue_port(const struct lsp_query *query, uint32_t nodedef, uint32_t index, mxg_port *out);

/*
 * The first definition of a node from an index on, MXG_NONE: there is none. Begin with 0, go on
 * with the index after the one found.
 */
uint32_t catalogue_next(const struct lsp_query *query, const char *node, uint32_t from);
uint32_t catalogue_find_nodedef(const struct lsp_query *query, const char *name);

/* The port of this name among inputs or outputs. */
bool catalogue_find_port(const struct lsp_query *query, uint32_t nodedef, const char *name,
                         bool is_output, mxg_port *out);

/*
 * The definition of the node, as far as the text tells: by its `nodedef`, or by category, version,
 * type and types of inputs. Of a nodegraph, the one that it implements. MXG_NONE: there is none.
 */
uint32_t catalogue_resolve(const struct lsp_query *query, uint32_t element);

/* The port that an <input> of a node stands for. */
bool catalogue_port_of(const struct lsp_query *query, uint32_t input, mxg_port *out);

#endif
