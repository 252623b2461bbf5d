// SPDX-License-Identifier: Apache-2.0
/* Limits of the memory of this process; allocations past them fail. */
#ifndef MXG_PROGRAM_LIMIT_H
#define MXG_PROGRAM_LIMIT_H

#include <stdint.h>

#define LIMIT_NONE UINT64_MAX

/*
 * Limits the bytes of data of this process and of the children that it starts; LIMIT_NONE: as it
 * was when the process began. A lower limit from outside stays. The address sanitizer maps
 * terabytes, so there is no limit with it.
 */
void limit_data(uint64_t bytes);

/*
 * The bytes that a program may take for what it makes of a file of so many bytes: 256 MiB, and 160
 * for each.
 */
uint64_t limit_of_file(uint64_t size);

/* The bytes of data that the process has now; 0: unknown. */
uint64_t limit_data_used(void);

#endif
