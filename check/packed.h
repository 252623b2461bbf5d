// SPDX-License-Identifier: Apache-2.0
/*
 * A record in bytes, as it goes from a worker to `mxgen check`: numbers as the machine has them,
 * texts with their length. Text that is no UTF-8 has U+FFFD in place of what is none, as in JSON.
 */
#ifndef MXG_CHECK_PACKED_H
#define MXG_CHECK_PACKED_H

#include "check/record.h"

/* Room for one record after the other. */
struct packed {
    char *bytes;
    size_t size, capacity;
};

/*
 * Writes the record in place of the one before; the store is for what it needs on the way. Bytes
 * are to be freed in the end.
 */
void check_pack_document(struct packed *out, struct store *store,
                         const struct check_document *document);

/* NULL where the bytes are no record. Its texts are those in the bytes, which must live as long. */
struct check_document *check_unpack_document(struct store *store, const char *bytes, size_t size);

#endif
