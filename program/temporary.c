// SPDX-License-Identifier: Apache-2.0
#define _DEFAULT_SOURCE /* getentropy, flock */
#include "program/temporary.h"

#include "program/name_table.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
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
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};
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

int temporary_lock(const char *path, int flags, int mode)
{
    struct stat opened, named;
    int fd = open(path, flags | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0)
        return -1;
    if (fstat(fd, &opened) == 0 && opened.st_uid == geteuid() && flock(fd, LOCK_EX | mode) == 0
        && lstat(path, &named) == 0 && named.st_ino == opened.st_ino
        && named.st_dev == opened.st_dev)
        return fd;
    close(fd);
    return -1;
}

/* True for the first of a few folders in a row; a folder may come again after many others. */
static bool is_new_folder(const char *folder)
{
    enum { NUM_KNOWN = 64 };
    static _Atomic uint64_t known[NUM_KNOWN];
    uint64_t hash = names_hash(NAMES_HASH_OF_NOTHING, folder);
    return atomic_exchange(&known[hash % NUM_KNOWN], hash) != hash;
}

/* Removes a file that nobody locks. */
static void remove_left(const char *folder, const char *name)
{
    size_t size = strlen(folder) + strlen(name) + 2;
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%s/%s", folder, name);
    int fd = path ? temporary_lock(path, O_RDWR, LOCK_NB) : -1;
    if (fd >= 0) {
        unlink(path);
        close(fd);
    }
    free(path);
}

void temporary_sweep(const char *folder)
{
    DIR *entries = is_new_folder(folder) ? opendir(folder) : NULL;
    for (const struct dirent *entry; entries && (entry = readdir(entries)) != NULL;) {
        size_t len = strlen(entry->d_name), end = strlen(TEMPORARY_SUFFIX);
        if (len > end && strcmp(entry->d_name + len - end, TEMPORARY_SUFFIX) == 0)
            remove_left(folder, entry->d_name);
    }
    if (entries)
        closedir(entries);
}
