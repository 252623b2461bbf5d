// SPDX-License-Identifier: Apache-2.0
/*
 * Places that do not depend on the folder of a run. A document has a path as given and a name below
 * the root; the difference between the two also applies to its other files.
 */
#ifndef MXG_CHECK_BELOW_ROOT_H
#define MXG_CHECK_BELOW_ROOT_H

#include "check/record.h"

/* The name below the root of a file that the document uses; `path` itself if it is elsewhere. */
const char *place_name(struct store *store, const struct check_document *document,
                       const char *path);

/* A text in which the document has its name instead of its path. */
const char *place_text(struct store *store, const struct check_document *document,
                       const char *text);

/*
 * A hash that stays the same if other lines of the document change, or the folder of the run:
 * severity, id, name of the file, and text.
 */
uint64_t place_hash(const struct check_document *document, const struct check_message *message);

#endif
