// SPDX-License-Identifier: Apache-2.0
/* Declarations that the files of the room deferred share. */
#ifndef MXG_DEFERRED_DEFERRED_PRIV_H
#define MXG_DEFERRED_DEFERRED_PRIV_H

#include "deferred/deferred.h"

/* passes.c: writes lines of texts.h. */
void deferred_write_lines(const char *const *lines, struct text *out);
/* Writes the numbers that C and the texts share, and record.glsl: the first part of every pass. */
void deferred_write_storage(const struct deferred_layout *layout, struct text *out);

/* resources.c: declares a resource for those who read or write it. */
void deferred_declare(enum deferred_binding binding, const struct deferred_layout *layout,
                      bool reads, bool writes, struct text *out);

#endif
