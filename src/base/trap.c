// SPDX-License-Identifier: Apache-2.0
/* The unwinding of mem.h by setjmp. */
#include "base/trap.h"

#include "base/mem.h"

#include <stdlib.h>

void mem_fail(struct mem *mem)
{
    if (!mem->trap)
        abort(); /* a call outside all public entry points: a bug in mxgen, not in the caller */
    longjmp(mem->trap->place, 1);
}

bool mem_try(struct mem *mem, void (*work)(void *arg), void *arg)
{
    struct trap here, *outer = mem->trap;
    mem->trap = &here;
    if (setjmp(here.place)) {
        mem->trap = outer;
        return false;
    }
    work(arg);
    mem->trap = outer;
    return true;
}
