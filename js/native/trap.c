// SPDX-License-Identifier: Apache-2.0
/* The unwinding of mem.h in WebAssembly: the host catches the exception that it throws (calls.js).
 */
#include "base/mem.h"
#include "native/host.h"

#include <stdlib.h>

struct trap {
    struct mem *mem; /* an address of its own for each trap */
};

void mem_fail(struct mem *mem)
{
    if (!mem->trap)
        abort(); /* a call outside all public entry points: a bug in mxgen, not in the caller */
    host_throw(mem->trap);
}

bool mem_try(struct mem *mem, void (*work)(void *arg), void *arg)
{
    struct trap here = {mem}, *outer = mem->trap;
    mem->trap = &here;
    bool done = host_try(work, arg, &here);
    mem->trap = outer;
    return done;
}
