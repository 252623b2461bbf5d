/* SPDX-License-Identifier: Apache-2.0 */
/* libxml2's configuration: the headers that the parser uses. */
#define HAVE_CTYPE_H 1
#define HAVE_ERRNO_H 1
#define HAVE_FCNTL_H 1
#define HAVE_LIMITS_H 1
#define HAVE_MATH_H 1
#if !defined(__wasm__) && !defined(_WIN32)
#define HAVE_PTHREAD_H 1
#endif
#define HAVE_SNPRINTF 1
#define HAVE_STDARG_H 1
#define HAVE_STDINT_H 1
#define HAVE_STDLIB_H 1
#define HAVE_STRING_H 1
#define HAVE_SYS_STAT_H 1
#define HAVE_SYS_TYPES_H 1
#define HAVE_UNISTD_H 1
#define HAVE_VA_COPY 1
#define HAVE_VSNPRINTF 1
#define STDC_HEADERS 1
#define XML_SOCKLEN_T int
