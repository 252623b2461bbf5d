// SPDX-License-Identifier: Apache-2.0
/*
 * Archives as USDZ has them: ZIP (PKWARE, APPNOTE 6.3) without compression, in which the bytes of
 * each file begin at a multiple of 64. Libraries that write ZIP leave no say about that.
 */
#ifndef MXG_EXPORT_ZIP_H
#define MXG_EXPORT_ZIP_H

#include "program/memory.h"

#include <stdbool.h>
#include <stdint.h>

/* Zero-initialise it. */
struct zip {
    struct memory_bytes files, directory;
    uint32_t num;
};

/* Adds a file; false if the archive would have 4 GiB or more. */
bool zip_add(struct zip *zip, const char *name, const void *data, size_t size);
/* Ends the archive, whose bytes are then in `files`; false as above. */
bool zip_end(struct zip *zip);
void zip_finish(struct zip *zip);

#endif
