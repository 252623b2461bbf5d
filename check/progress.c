// SPDX-License-Identifier: Apache-2.0
#define _DEFAULT_SOURCE /* TIOCGWINSZ */
#include "check/progress.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#define INTERVAL 0.1 /* seconds between two lines */

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

void progress_init(struct progress *progress, bool is_wanted)
{
    const char *term = getenv("TERM");
    struct winsize size = {0};
    *progress = (struct progress){.columns = 80};
    progress->is_shown =
        is_wanted && isatty(STDERR_FILENO) && term && *term && strcmp(term, "dumb") != 0;
    if (progress->is_shown && ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col)
        progress->columns = size.ws_col;
}

/* The end of a path that fits into the line, from the beginning of a code point. */
static const char *fitting_end(const char *path, size_t room)
{
    size_t len = strlen(path);
    const char *at = len > room ? path + (len - room) : path;
    while (((unsigned char)*at & 0xc0) == 0x80)
        ++at;
    return at;
}

void progress_show(struct progress *progress, uint64_t num_done, uint64_t num_failed,
                   const char *path)
{
    char counts[96];
    if (!progress->is_shown || now() - progress->last < INTERVAL)
        return;
    int len = snprintf(counts, sizeof counts, "%" PRIu64 " checked, %" PRIu64 " failed: ", num_done,
                       num_failed);
    size_t room = progress->columns > (unsigned)len + 1 ? progress->columns - (unsigned)len - 1 : 0;
    fprintf(stderr, "\r\033[K%.*s%s", (int)progress->columns - 1, counts, fitting_end(path, room));
    fflush(stderr);
    progress->has_line = true;
    progress->last = now();
}

void progress_clear(struct progress *progress)
{
    if (!progress || !progress->has_line)
        return;
    fputs("\r\033[K", stderr);
    progress->has_line = false;
}
