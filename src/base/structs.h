// SPDX-License-Identifier: Apache-2.0
/*
 * Structs of the public interface. They begin with their size, so that later versions can add
 * members: the struct of an older caller is shorter than this version's, the struct of a newer
 * caller is longer.
 */
#ifndef MXG_BASE_STRUCTS_H
#define MXG_BASE_STRUCTS_H

#include <mxgen/mxgen.h>

/*
 * Copies a struct of the caller. false if its size is unknown, or if it sets members that this
 * version does not have.
 */
bool struct_read(void *out, size_t out_size, const void *in);
/*
 * Copies `from` up to the size of the caller's struct and zeroes the rest; both begin with their
 * size.
 */
mxg_status struct_write(void *out, const void *from, size_t from_size);

#endif
