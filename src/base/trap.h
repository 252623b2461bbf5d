// SPDX-License-Identifier: Apache-2.0
/* The place to which mem_fail (mem.h) jumps, for code that sets a trap itself: tests. */
#ifndef MXG_BASE_TRAP_H
#define MXG_BASE_TRAP_H

#include <setjmp.h>

struct trap {
    jmp_buf place;
};

#endif
