// SPDX-License-Identifier: Apache-2.0
/*
 * Code that compiled without a message: the interfaces of a document often have one code, and
 * compilers that are programs take a third of a second to start. For one thread.
 */
#ifndef MXG_COMPILE_KNOWN_H
#define MXG_COMPILE_KNOWN_H

#include "compile/compile.h"

/* A number for the code of all stages and parts, without comments, and what a host adds to it. */
uint64_t known_key(const char *target, const mxg_result *result);

/* Fills in the sizes of `out`, which is empty; it has no SPIR-V. False if the code is not known. */
bool known_find(uint64_t key, struct compiled *out);
void known_add(uint64_t key, const struct compiled *compiled);

#endif
