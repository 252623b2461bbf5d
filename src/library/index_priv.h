// SPDX-License-Identifier: Apache-2.0
/* Declarations that the files which fill a library layer share. */
#ifndef MXG_LIBRARY_INDEX_PRIV_H
#define MXG_LIBRARY_INDEX_PRIV_H

#include "library/library.h"

struct indexer {
    struct library *lib;
    struct arena *arena;
    const struct lang_reader *reader;
    struct diag_list *diags;
};

enum { INDEX_MAX_PORTS = 1024 }; /* of the inputs of a definition, because lookups are linear */

static inline const char *index_text(const struct indexer *ix, str_id id)
{
    return str_text(&ix->lib->strings, id);
}

/* The value of an attribute; 0: absent. */
static inline str_id index_attr(const struct indexer *ix, elem_id element, str_id name)
{
    return doc_attr_value(&ix->lib->doc, element, name);
}

/* The name of the file that an element stands in; "" without a file. */
static inline const char *index_file(const struct indexer *ix, elem_id element)
{
    const char *name = doc_place(&ix->lib->doc, element).file;
    return name ? name : "";
}

/* implement.c: adds the implementation of an <implementation>, or of a functional <nodegraph>. */
void index_implementation(struct indexer *ix, elem_id element);
void index_functional_graph(struct indexer *ix, elem_id element);
/* Links the implementations of each definition, the first one at its head. */
void index_link_implementations(struct library *lib);

/* verbatim.c */

/* The text of a source file, interned; 0 after a diagnostic. */
str_id index_read_source(struct indexer *ix, elem_id element, str_id file, struct diag_list *diags);
/* True if the file holds an inline expression. */
bool index_is_inline(const struct indexer *ix, str_id file);
/*
 * Makes an implementation verbatim: source for one target, which `faults` say is not portable.
 * false if the source cannot be read.
 */
bool index_verbatim(struct indexer *ix, struct implementation *impl, const struct diag_list *faults);

#endif
