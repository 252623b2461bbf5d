// SPDX-License-Identifier: Apache-2.0
/*
 * The reference of a library, from its definitions in mxgen.h. All definitions of a node in a group
 * form one entry, in which each input has one row for all variants.
 */
#ifndef MXG_DOC_MANUAL_H
#define MXG_DOC_MANUAL_H

#include "program/cli.h"
#include "program/name_table.h"
#include "program/store.h"

#include <mxgen/mxgen.h>

#include <stdio.h>

/* The texts of a port: the columns of its row. */
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
 * An input or output of an edition. A cell has the distinct texts of the variants, in their order.
 */
struct manual_port {
    const char *name, *folder; /* folder in user interfaces; "" = none */
    bool is_output, uniform;
    struct manual_texts cells[MANUAL_NUM_COLUMNS];
};

struct manual_variant {
    uint32_t index; /* index in the library */
    mxg_nodedef def;
    const char *signature; /* "(fg: color3, bg: color3, mix: float) → color3" */
};

/* The definitions of a node in one version, its variants of type. */
struct manual_edition {
    const char *version; /* "" = none */
    const struct manual_variant *variants;
    size_t num_variants;
    /* in editions after the first: the ports that differ from it, unless all do */
    struct manual_port *ports;
    size_t num_ports;
    struct manual_texts missing; /* inputs of the first edition that this one lacks */
};

struct manual_node {
    const char *id; /* unique id of the entry */
    const char *name, *group, *text, *file;
    struct manual_edition *editions; /* the default edition first */
    size_t num_editions, num_variants;
    struct manual_texts targets; /* targets with an implementation of every variant */
    const char *picture;         /* file beside the pages; NULL: none */
};

struct manual {
    const mxg_library *library;
    struct manual_node *nodes; /* in order of group, then name */
    size_t num_nodes, num_variants;
    uint32_t num_targets;
    struct store store;      /* owns all other memory of the reference */
    struct name_table names; /* of nodes */
};

/* entries.c: the definitions from `first` on. */
void manual_init(struct manual *manual, const mxg_library *library, uint32_t first);

/* A copy that lives as long as the reference; frees the text. */
const char *manual_keep(struct manual *manual, char *text);

/* cells.c: the text of a port in a column; "" for none. */
const char *manual_cell(struct manual *manual, const mxg_port *port, enum manual_column column);

/* html.c, markdown.c */
void manual_write_html(const struct manual *manual, FILE *out);
void manual_write_markdown(const struct manual *manual, FILE *out);

/*
 * node_pictures.c: draws all suitable nodes into `folder`/pictures, each picture beside its
 * document. False after a message about a failed picture.
 */
bool manual_draw(struct manual *manual, struct cli *cli, const char *folder);

#endif
