// SPDX-License-Identifier: Apache-2.0
/*
 * The reference of a library: its definitions as mxgen.h tells them, put together for readers. All
 * definitions of a node in a group become one entry, in which each input stands once with what its
 * variants have in common.
 */
#ifndef MXG_DOC_MANUAL_H
#define MXG_DOC_MANUAL_H

#include "cli/cli.h"
#include "cli/store.h"

#include <mxgen/mxgen.h>

#include <stdio.h>

/* What a port says, and the columns of its row. */
enum manual_column {
    MANUAL_TYPE,
    MANUAL_DEFAULT,
    MANUAL_VALUES,
    MANUAL_MEANING,
    MANUAL_NUM_COLUMNS
};

struct manual_texts {
    const char **items;
    size_t len;
};

/*
 * An input or output of an edition; a cell has the texts in which the variants differ, in their
 * order.
 */
struct manual_port {
    const char *name, *folder; /* of the user interface; "" */
    bool is_output, uniform;
    struct manual_texts cells[MANUAL_NUM_COLUMNS];
};

struct manual_variant {
    uint32_t index; /* in the library */
    mxg_nodedef def;
    const char *signature; /* "(fg: color3, bg: color3, mix: float) → color3" */
};

/* The definitions of a node in one version, its variants of type. */
struct manual_edition {
    const char *version; /* "" */
    const struct manual_variant *variants;
    size_t num_variants;
    /* of an edition behind the first: those that differ from it, unless they are all */
    struct manual_port *ports;
    size_t num_ports;
    struct manual_texts missing; /* inputs of the first edition that this one lacks */
};

struct manual_node {
    const char *id; /* of the entry: unique */
    const char *name, *group, *text, *file;
    struct manual_edition *editions; /* the default one first */
    size_t num_editions, num_variants;
    struct manual_texts targets; /* that have an implementation of every variant */
    const char *picture;         /* file beside the pages; NULL */
};

struct manual {
    const mxg_library *library;
    struct manual_node *nodes; /* by group, then by name */
    size_t num_nodes, num_variants;
    uint32_t num_targets;
    struct store store; /* of all of the above */
};

/* model.c: the definitions from `first` on. */
void manual_init(struct manual *manual, const mxg_library *library, uint32_t first);

/* A copy that lives as long as the reference; frees the text. */
const char *manual_keep(struct manual *manual, char *text);

/* cells.c: what a port says in a column; "" for nothing. */
const char *manual_cell(struct manual *manual, const mxg_port *port, enum manual_column column);

/* html.c, markdown.c */
void manual_write_html(const struct manual *manual, FILE *out);
void manual_write_markdown(const struct manual *manual, FILE *out);

/*
 * picture.c: draws what can be pictured into `folder`/pictures, each picture beside the document it
 * shows. False after telling that a picture could not be made.
 */
bool manual_draw(struct manual *manual, struct cli *cli, const char *folder);

#endif
