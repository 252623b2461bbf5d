// SPDX-License-Identifier: Apache-2.0
/* bench-map N: maps the built-in library N times. */
#include <mxgen/mxgen.h>

#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv)
{
    bool good = argc == 2;
    for (long i = good ? strtol(argv[1], NULL, 10) : 0; good && i > 0; --i) {
        mxg_context *context;
        good = mxg_context_create(NULL, &context) == MXG_OK;
        mxg_library *library = mxg_library_builtin(context);
        good = good && mxg_library_num_nodedefs(library) > 0;
        mxg_library_unref(library);
        mxg_context_destroy(context);
    }
    if (!good)
        fputs("usage: bench-map N\n", stderr);
    return good ? 0 : 1;
}
