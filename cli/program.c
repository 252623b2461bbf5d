// SPDX-License-Identifier: Apache-2.0
/* Finds the mxgen programs, which lie in one folder. */
#define _POSIX_C_SOURCE 200809L
#include "cli/cli.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The folder of this program, with a '/' at the end; "" if the system does not provide it. */
static const char *program_folder(char *buffer, size_t capacity)
{
    ssize_t len = readlink("/proc/self/exe", buffer, capacity - 1);
    buffer[len > 0 ? len : 0] = '\0';
    char *slash = strrchr(buffer, '/');
    if (slash)
        slash[1] = '\0';
    return buffer;
}

char *cli_program(const char *name)
{
    char folder[4096];
    char *path = cli_format("%s%s", program_folder(folder, sizeof folder), name);
    if (access(path, X_OK) == 0)
        return path;
    free(path);
    return cli_format("%s", name);
}
