// SPDX-License-Identifier: Apache-2.0
/* Functions of POSIX that the library uses and wasi-libc does not declare; clang includes this
 * header first. */
#ifndef MXG_JS_POSIX_H
#define MXG_JS_POSIX_H

char *realpath(const char *restrict path, char *restrict resolved);

#endif
