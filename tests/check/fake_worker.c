// SPDX-License-Identifier: Apache-2.0
/*
 * In place of mxgen-check: does what the document's name says. Of a name with "dies", "hangs" or "lies" it dies, hangs,
 * or answers with something that is no record; with "slow" it takes a while; all others pass.
 */
#define _POSIX_C_SOURCE 200809L
#include "cli/check/protocol.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static void answer(const char *path)
{
    char record[4096];
    if (strstr(path, "dies"))
        raise(SIGKILL);
    while (strstr(path, "hangs"))
        pause();
    if (strstr(path, "slow"))
        nanosleep(&(struct timespec){.tv_nsec = 200000000}, NULL);
    int len = strstr(path, "lies") ? snprintf(record, sizeof record, "{\"file\":")
                                   : snprintf(record, sizeof record, "{\"file\":\"%s\",\"status\":\"passed\"}", path);
    frame_write(STDOUT_FILENO, FRAME_RECORD, record, (size_t)len);
}

int main(void)
{
    struct frame_header header;
    frame_write(STDOUT_FILENO, FRAME_READY, "", 0);
    for (char *path; (path = frame_read(STDIN_FILENO, &header)) != NULL; free(path)) {
        frame_write(STDOUT_FILENO, FRAME_MARK, "validate", 8);
        answer(path);
    }
    return 0;
}
