// SPDX-License-Identifier: Apache-2.0
/* Finds the mxgen programs, which lie in one folder, and runs them. */
#define _POSIX_C_SOURCE 200809L
#include "program/cli.h"
#include "program/parent.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

/* The folder of this program, with a '/' at the end; "" if the system does not provide it. */
static const char *program_folder(char *buffer, size_t capacity)
{
    ssize_t len = readlink("/proc/self/exe", buffer, capacity - 1);
    buffer[len > 0 ? len : 0] = '\0';
    char *slash = strrchr(buffer, '/');
    if (slash)
        slash[1] = '\0';
    return buffer;
}

char *cli_program(const char *name)
{
    char folder[4096];
    char *path = cli_format("%s%s", program_folder(folder, sizeof folder), name);
    if (access(path, X_OK) == 0)
        return path;
    free(path);
    return cli_format("%s", name);
}

int cli_start_logged(char *const *arguments, const char *log, pid_t *out_process)
{
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    if (log) {
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log, O_WRONLY | O_CREAT | O_EXCL,
                                         0600);
        posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    }
    parent_announce();
    int reason = posix_spawnp(out_process, arguments[0], &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    return reason;
}

int cli_run_logged(char *const *arguments, const char *log, int *out_status)
{
    pid_t process;
    int reason = cli_start_logged(arguments, log, &process);
    while (!reason && waitpid(process, out_status, 0) < 0)
        if (errno != EINTR)
            reason = errno;
    return reason;
}

bool cli_run(struct report *report, char *const *arguments, int *out_status)
{
    int reason = cli_run_logged(arguments, NULL, out_status);
    if (reason)
        report_error(report, "no-renderer", "cannot start '%s': %s", arguments[0],
                     strerror(reason));
    return !reason;
}
