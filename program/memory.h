// SPDX-License-Identifier: Apache-2.0
/* Memory of the programs, which end if memory is exhausted. Free it with free. */
#ifndef MXG_PROGRAM_MEMORY_H
#define MXG_PROGRAM_MEMORY_H

#include <stdarg.h>
#include <stddef.h>

/* `tell` is called before the program ends because memory is exhausted. */
void memory_on_exhaustion(void (*tell)(void));

/* Ends the program because memory is exhausted. */
_Noreturn void memory_fail(void);

/* Zeroed, and aligned for any object. */
void *memory_alloc(size_t size);
/* Like realloc. */
void *memory_resize(void *memory, size_t size);

/* Formats into new memory. */
#if defined(__GNUC__)
__attribute__((format(printf, 1, 0)))
#endif
char *
memory_format(const char *format, va_list args);

#endif
