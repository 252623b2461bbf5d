// SPDX-License-Identifier: Apache-2.0
/*
 * Which documents are checked, one after the other and each once: files; folders, all of whose
 * .mtlx below are meant, in order of their names; patterns of glob(7); and lists with a path on
 * each line, "@list". Memory follows from the folder at hand, not from all that there is.
 */
#ifndef MXG_CHECK_INPUTS_H
#define MXG_CHECK_INPUTS_H

#include "check/names.h"
#include "cli/args.h"

struct check_inputs {
    struct input_source *sources; /* the innermost first */
    struct name_table seen;       /* paths that were given out */
    char *path;
    bool failed; /* a list could not be read */
};

/* `files_from` are names of lists, "-" is standard input. The lists must live on. */
void inputs_init(struct check_inputs *inputs, const struct arg_list *paths,
                 const struct arg_list *files_from);
void inputs_finish(struct check_inputs *inputs);

/*
 * The next document's path, valid until the next call; NULL at the end. What does not exist is
 * given out as it is.
 */
const char *inputs_next(struct check_inputs *inputs);

#endif
