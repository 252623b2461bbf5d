// SPDX-License-Identifier: Apache-2.0
/* The functions that WebAssembly imports from native.js: what C cannot do there, and the callbacks
 * of a context. */
#ifndef MXG_JS_HOST_H
#define MXG_JS_HOST_H

#include <mxgen/scene.h>

#define IMPORT(name) __attribute__((import_module("mxgen"), import_name(#name)))

/* Calls work(arg). Returns false if host_throw(trap) ended it; the stack is then as before the
 * call. */
IMPORT(try) bool host_try(void (*work)(void *arg), void *arg, const void *trap);
IMPORT(throw) _Noreturn void host_throw(const void *trap);

/* Write a message and end the instance. */
IMPORT(abort) _Noreturn void host_abort(const char *message);

/* The callbacks of mxg_resolver and mxg_context_desc; `context` is a number that native.js gave. */
IMPORT(open)
bool host_open(void *context, const char *from, const char *ref, mxg_blob *blob,
               const char **out_reason);
IMPORT(release) void host_release(void *context, mxg_blob *blob);
IMPORT(list_folder)
size_t host_list_folder(void *context, const char *from, const char *folder, char *names,
                        size_t capacity);
IMPORT(cancel) bool host_cancel(void *context);
IMPORT(read_texels)
bool host_read_texels(void *context, const char *from, const char *file, const char *layer,
                      uint32_t size, float *out_texels);

/* Takes a piece of the text that the current call writes. */
IMPORT(write) bool host_write(void *user_data, const char *data, size_t size);

/* The parameter of mxg_scene_add_primitives; `adding` is a number that native.js gave. */
IMPORT(next_primitive)
bool host_next_primitive(void *adding, uint32_t last, mxg_primitive *primitive);

#endif
