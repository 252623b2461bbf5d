// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "program/temporary.h"

#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <unistd.h>

enum { MAX_FILES = 32 }; /* a program writes a few files at a time; more are not removed */

static _Atomic(const char *) files[MAX_FILES];

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
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
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
