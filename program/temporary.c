// SPDX-License-Identifier: Apache-2.0
#define _DEFAULT_SOURCE /* getentropy */
#include "program/temporary.h"

#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { MAX_FILES = 32 }; /* a program writes a few files at a time; more are not removed */

static _Atomic(const char *) files[MAX_FILES];

static uint32_t random_number(void)
{
    static atomic_uint count;
    uint32_t number;
    struct timespec now;
    if (getentropy(&number, sizeof number) == 0)
        return number;
    clock_gettime(CLOCK_REALTIME, &now);
    return (uint32_t)now.tv_nsec * 2654435761u ^ (uint32_t)getpid() << 8
           ^ atomic_fetch_add(&count, 1);
}

char *temporary_name(const char *before, const char *after)
{
    size_t size = strlen(before) + strlen(after) + 16;
    char *name = malloc(size);
    if (name)
        snprintf(name, size, "%s.%08x%s", before, (unsigned)random_number(), after);
    return name;
}

/* unlink and raise are safe in a handler; the second delivery has the default effect. */
static void remove_all(int number)
{
    for (size_t i = 0; i < MAX_FILES; ++i) {
        const char *path = atomic_load(&files[i]);
        if (path)
            unlink(path);
    }
    raise(number);
}

/* A signal that the caller ignores, as nohup does, stays ignored. */
static void catch_signals(void)
{
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ};
    static bool is_done;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers && !is_done; ++i) {
        struct sigaction old;
        struct sigaction action = {.sa_handler = remove_all, .sa_flags = (int)SA_RESETHAND};
        sigemptyset(&action.sa_mask);
        if (sigaction(numbers[i], NULL, &old) == 0 && old.sa_handler == SIG_DFL)
            sigaction(numbers[i], &action, NULL);
    }
    is_done = true;
}

void temporary_note(const char *path)
{
    catch_signals();
    for (size_t i = 0; i < MAX_FILES; ++i) {
        const char *free_place = NULL;
        if (atomic_compare_exchange_strong(&files[i], &free_place, path))
            return;
    }
}

void temporary_forget(const char *path)
{
    for (size_t i = 0; i < MAX_FILES; ++i) {
        const char *expected = path;
        if (atomic_compare_exchange_strong(&files[i], &expected, NULL))
            return;
    }
}
