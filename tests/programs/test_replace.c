// SPDX-License-Identifier: Apache-2.0
/* The temporary file of a replaced file is locked until it has its name, so that no other process
 * takes it for one that a killed process left. */
#define _GNU_SOURCE /* mkdtemp, renameat */
#include "program/files.h"
#include "program/temporary.h"

#include "unit/test.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <unistd.h>

static int num_renamed;

/* Stands for that of the C library: another process may look at the file at this moment. */
int rename(const char *old_name, const char *new_name)
{
    int fd = temporary_lock(old_name, O_RDWR, LOCK_NB);
    REQUIRE_EQ(fd, -1);
    if (fd >= 0)
        close(fd);
    num_renamed++;
    return renameat(AT_FDCWD, old_name, AT_FDCWD, new_name);
}

static void require_text(const char *path, const char *text)
{
    size_t size;
    char *data = files_read(path, &size);
    REQUIRE_STR(data, text);
    free(data);
}

int main(void)
{
    char folder[] = "replace.XXXXXX";
    REQUIRE(mkdtemp(folder) && chdir(folder) == 0);
    REQUIRE(files_write("file", "old", 3) == NULL && num_renamed == 0);
    REQUIRE(files_write("file", "new", 3) == NULL && num_renamed == 1);
    require_text("file", "new");
    REQUIRE(files_replace("file", "newer", 5) == NULL && num_renamed == 2);
    require_text("file", "newer");
    REQUIRE(unlink("file") == 0 && chdir("..") == 0 && rmdir(folder) == 0);
    return test_report("replace");
}
