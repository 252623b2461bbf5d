// SPDX-License-Identifier: Apache-2.0
/*
 * The documents to check, each once: files; all .mtlx files below folders, in the order of their
 * names; patterns of glob(7); and lists with one path per line, "@list". Memory depends on the
 * current folder, not on the number of documents.
 */
#ifndef MXG_CHECK_DOCUMENT_PATHS_H
#define MXG_CHECK_DOCUMENT_PATHS_H

#include "program/name_table.h"
#include "program/args.h"

struct check_inputs {
    struct input_source *sources; /* the innermost first */
    struct name_table seen;       /* paths that were returned already */
    char *path;
    bool failed; /* a list could not be read */
};

/* `files_from` are names of lists, "-" is standard input. The caller keeps the lists alive. */
void inputs_init(struct check_inputs *inputs, const struct arg_list *paths,
                 const struct arg_list *files_from);
void inputs_finish(struct check_inputs *inputs);

/*
 * The path of the next document, valid until the next call; NULL at the end. Returns names of
 * missing files unchanged.
 */
const char *inputs_next(struct check_inputs *inputs);

#endif
