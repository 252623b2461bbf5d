// SPDX-License-Identifier: Apache-2.0
/*
 * A document with the files that include it or that it includes, also through others: in all of
 * them a name at the root means one element.
 */
#ifndef MXG_LSP_FAMILY_H
#define MXG_LSP_FAMILY_H

#include "lsp/query.h"

struct family_file {
    struct lsp_document *document; /* the editor's, or made of the file on the disk */
    bool is_own;                   /* made here */
    bool is_member;
    struct arg_list includes; /* paths */
};

struct family {
    struct family_file *files;
    size_t num_files;
};

/*
 * Reads what the editor has open, and the documents in and below the folders of the workspace, up
 * to 2,000; none of them is a member. Call family_finish.
 */
void family_scan(struct lsp_session *session, struct family *out);
/* As family_scan, with the members of the family of a document. */
void family_find(struct lsp_session *session, struct lsp_document *document, struct family *out);
void family_finish(struct family *family);

/* A query of a file, at no place. True: the file is a member. */
bool family_query(const struct family *family, size_t index, struct lsp_session *session,
                  struct lsp_query *out);

/*
 * True if a name in an attribute of another file is that of the target: an element at the root of
 * the text of `of`, or an output of a nodegraph there. *name then is without its namespace.
 */
bool family_names(const struct lsp_query *of, uint32_t target, const struct lsp_query *in,
                  uint32_t element, const struct model_attribute *attribute, struct span *name);
/* The part of a name behind its namespace: "gold" of "studio:gold". */
struct span family_local_name(const struct lsp_query *query, struct span name);
/*
 * True if another file of the family may use the target, an input of a definition: it has nodes of
 * this definition, or it names the definition.
 */
bool family_uses_input(const struct family *family, const struct lsp_query *of, uint32_t target);
/* True for an element that other files can name. */
bool family_can_name(const struct lsp_query *of, uint32_t target);

#endif
