// SPDX-License-Identifier: Apache-2.0
/* Memory of the programs, which end if memory is exhausted. Free it with free. */
#ifndef MXG_PROGRAM_MEMORY_H
#define MXG_PROGRAM_MEMORY_H

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

/* `tell` is called before the program ends because memory is exhausted. */
void memory_on_exhaustion(void (*tell)(void));

/* Ends the program because memory is exhausted. */
_Noreturn void memory_fail(void);

/* Zeroed, and aligned for any object. */
void *memory_alloc(size_t size);
/* Like realloc. */
void *memory_resize(void *memory, size_t size);

/*
 * Room for one more item behind `len` in an array that is empty at first and that nothing else
 * resizes: the capacity doubles at powers of two.
 */
void *memory_grow(void *items, size_t len, size_t item_size);
/* Appends an item to such an array. */
#define MEMORY_PUSH(items, len, ...) \
    ((items) = memory_grow((items), (len), sizeof *(items)), (items)[(len)++] = (__VA_ARGS__))

/* Bytes that grow, and a NUL behind them. Zero-initialise it, and free `data`. */
struct memory_bytes {
    char *data;
    size_t size, capacity;
};
void memory_append(struct memory_bytes *bytes, const void *data, size_t size);
/* A number of `size` bytes, the lowest first. */
void memory_append_number(struct memory_bytes *bytes, uint64_t number, size_t size);

/* Formats into new memory. */
#if defined(__GNUC__)
__attribute__((format(printf, 1, 0)))
#endif
char *
memory_format(const char *format, va_list args);

#endif
