// SPDX-License-Identifier: Apache-2.0
#define _GNU_SOURCE /* O_DIRECTORY, flock, nftw */
#include "program/scratch.h"

#include "program/cli.h"
#include "program/temporary.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#define PREFIX "mxgen-scratch-"

const char *scratch_root(void)
{
    const char *root = getenv("TMPDIR");
    return root && *root ? root : "/tmp";
}

static int remove_one(const char *path, const struct stat *info, int kind, struct FTW *place)
{
    (void)info, (void)kind, (void)place;
    return remove(path);
}

static void remove_tree(const char *path)
{
    enum { MAX_OPEN = 16 };
    nftw(path, remove_one, MAX_OPEN, FTW_DEPTH | FTW_PHYS);
}

static int lock(const char *path, int mode)
{
    return temporary_lock(path, O_RDONLY | O_DIRECTORY, mode);
}

/* Removes folders that nobody locks, once in a process. */
static void sweep(const char *root)
{
    static atomic_flag is_done = ATOMIC_FLAG_INIT;
    DIR *folder = atomic_flag_test_and_set(&is_done) ? NULL : opendir(root);
    for (const struct dirent *entry; folder && (entry = readdir(folder)) != NULL;) {
        if (strncmp(entry->d_name, PREFIX, strlen(PREFIX)) != 0)
            continue;
        char *path = cli_format("%s/%s", root, entry->d_name);
        int fd = lock(path, LOCK_NB);
        if (fd >= 0) {
            remove_tree(path);
            close(fd);
        }
        free(path);
    }
    if (folder)
        closedir(folder);
}

bool scratch_make(struct scratch *scratch)
{
    enum { MAX_TRIES = 100 };
    const char *root = scratch_root();
    sweep(root);
    for (int i = 0; i < MAX_TRIES; ++i) {
        *scratch = (struct scratch){cli_format("%s/" PREFIX "XXXXXX", root), -1};
        if (!mkdtemp(scratch->path))
            break;
        scratch->lock = lock(scratch->path, 0);
        /* without a lock it was swept, or the file system has none: there nobody sweeps */
        if (scratch->lock >= 0 || access(scratch->path, W_OK) == 0)
            return true;
        free(scratch->path);
        scratch->path = NULL;
    }
    int reason = errno;
    free(scratch->path);
    *scratch = (struct scratch){0};
    errno = reason;
    return false;
}

void scratch_remove(struct scratch *scratch)
{
    if (!scratch->path)
        return;
    remove_tree(scratch->path);
    if (scratch->lock >= 0)
        close(scratch->lock);
    free(scratch->path);
    *scratch = (struct scratch){0};
}
