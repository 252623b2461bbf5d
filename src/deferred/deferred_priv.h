// SPDX-License-Identifier: Apache-2.0
/* Declarations that the files of the room deferred share. */
#ifndef MXG_DEFERRED_DEFERRED_PRIV_H
#define MXG_DEFERRED_DEFERRED_PRIV_H

#include "deferred/deferred.h"

#include "shader/verbatim.h"

/*
 * passes.c: writes lines of texts.h. Lines that begin with '@' are for texts with functions of the
 * host, for its passes, and for storage outside of a pixel stage (is_hosts), those that begin with
 * '%' for others.
 */
void deferred_write_lines(const char *const *lines, bool is_hosts, struct text *out);
/* Writes the numbers that C and the texts share, and record.glsl: the first part of every pass. */
void deferred_write_storage(const struct deferred_layout *layout, struct text *out);

/*
 * program.c: writes texts of passes as a program (parse/parse.h) that reads and writes these
 * resources.
 */
void deferred_make_program(const char *glsl, const struct source_resources *resources,
                           struct text *out);

/* closure.c, for record.glsl: the struct MxClosure. */
void deferred_write_struct(struct text *out);
/* For write.glsl and read.glsl with whole floats: mx_put_whole and mx_get_whole. */
void deferred_write_put(struct text *out);
void deferred_write_get(struct text *out);
/* After store.glsl: mx_store_closure. */
void deferred_write_store(struct text *out);
/* Types and names of the values join a hash. */
uint64_t deferred_hash_values(uint64_t hash);

/* resources.c: declares the buffers for programs: uniforms, and words that functions read. */
void deferred_declare_buffers(struct text *out);
/* Declares a resource for those who read or write it. */
void deferred_declare(enum deferred_binding binding, const struct deferred_layout *layout,
                      bool reads, bool writes, struct text *out);
/* After all declarations: the functions by which passes read and write buffers. */
void deferred_write_access(uint32_t reads, uint32_t writes, struct text *out);

#endif
