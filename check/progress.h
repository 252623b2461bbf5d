// SPDX-License-Identifier: Apache-2.0
/* One line on a terminal that shows how far a run is. Elsewhere it shows nothing. */
#ifndef MXG_CHECK_PROGRESS_H
#define MXG_CHECK_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

struct progress {
    bool is_shown;    /* stderr is a terminal that can erase a line */
    bool has_line;    /* the line is visible */
    double last;      /* the time when it was written, in seconds */
    unsigned columns; /* width of the terminal */
};

/* `is_wanted` false: never shows anything. */
void progress_init(struct progress *progress, bool is_wanted);

/* Shows the line, a few times per second: documents that are done, failures, the last document. */
void progress_show(struct progress *progress, uint64_t num_done, uint64_t num_failed,
                   const char *path);

/* Erases the line, before any other output; does nothing for NULL. */
void progress_clear(struct progress *progress);

#endif
