// SPDX-License-Identifier: Apache-2.0
/*
 * The reference of a library: its definitions as mxgen.h tells them, put together for readers. All definitions of a node
 * become one entry, in which each input stands once with what its variants have in common.
 */
#ifndef MXG_CLI_DOC_DOC_H
#define MXG_CLI_DOC_DOC_H

#include "cli/cli.h"

#include <mxgen/mxgen.h>

#include <stdio.h>

/* What a port says, and the columns of its row. */
enum doc_column { DOC_TYPE, DOC_DEFAULT, DOC_VALUES, DOC_MEANING, DOC_NUM_COLUMNS };

struct doc_texts {
    const char **items;
    size_t len;
};

/* An input or output of an edition; a cell has the texts in which the variants differ, in their order. */
struct doc_port {
    const char *name, *folder; /* of the user interface; "" */
    bool is_output, uniform;
    struct doc_texts cells[DOC_NUM_COLUMNS];
};

struct doc_variant {
    uint32_t index;        /* in the library */
    mxg_nodedef def;
    const char *signature; /* "(fg: color3, bg: color3, mix: float) → color3" */
};

/* The definitions of a node in one version, its variants of type. */
struct doc_edition {
    const char *version; /* "" */
    const struct doc_variant *variants;
    size_t num_variants;
    struct doc_port *ports; /* of an edition behind the first: those that differ from it, unless they are all */
    size_t num_ports;
    struct doc_texts missing; /* inputs of the first edition that this one lacks */
};

struct doc_node {
    const char *name, *group, *text, *file;
    struct doc_edition *editions; /* the default one first */
    size_t num_editions, num_variants;
    struct doc_texts targets;     /* that have an implementation of every variant */
    const char *picture;          /* file beside the pages; NULL */
};

struct doc {
    const mxg_library *library;
    struct doc_node *nodes; /* by group, then by name */
    size_t num_nodes, num_variants;
    uint32_t num_targets;
    void *blocks; /* all of the above */
};

/* model.c: the definitions from `first` on. */
void doc_init(struct doc *doc, const mxg_library *library, uint32_t first);
void doc_finish(struct doc *doc);

/* Zeroed memory that lives as long as the reference. */
void *doc_alloc(struct doc *doc, size_t size);
/* Takes over a text of cli_format. */
const char *doc_keep(struct doc *doc, char *text);

/* cells.c: what a port says in a column; "" for nothing. */
const char *doc_cell(struct doc *doc, const mxg_port *port, enum doc_column column);

/* html.c, markdown.c */
void doc_write_html(const struct doc *doc, FILE *out);
void doc_write_markdown(const struct doc *doc, FILE *out);

/* page.c: made of page.css and page.js when mxgen is built; ends with NULL. */
extern const char *const doc_style[], *const doc_script[];

/*
 * picture.c: draws what can be pictured into `folder`/pictures, each picture beside the document it shows. False after
 * telling that a picture could not be made.
 */
bool doc_draw(struct doc *doc, struct cli *cli, const char *folder);

#endif
