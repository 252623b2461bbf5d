// SPDX-License-Identifier: Apache-2.0
/*
 * A record in bytes, as it goes from a worker to `mxgen check`: numbers as the machine has them, texts with their length. Text that is no
 * UTF-8 has U+FFFD in place of what is none, as in JSON.
 */
#ifndef MXG_CLI_CHECK_PACKED_H
#define MXG_CLI_CHECK_PACKED_H

#include "cli/check/record.h"

/* The bytes, in the store. */
char *check_pack_document(struct store *store, const struct check_document *document, size_t *out_size);

/* NULL where the bytes are no record. Its texts are those in the bytes, which must live as long. */
struct check_document *check_unpack_document(struct store *store, const char *bytes, size_t size);

#endif
