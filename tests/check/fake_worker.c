// SPDX-License-Identifier: Apache-2.0
/*
 * In place of mxgen-check: does what the document's name says. Of a name with "dies", "hangs" or
 * "lies" it dies, hangs, or answers with something that is no record; with "slow" it takes a while;
 * all others pass.
 */
#define _POSIX_C_SOURCE 200809L
#include "check/protocol.h"
#include "check/record_json.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static void answer(struct channel *channel, const char *path)
{
    size_t size;
    char *record = record_to_text(&(struct check_document){.file = path}, &size);
    if (strstr(path, "dies"))
        raise(SIGKILL);
    while (strstr(path, "hangs"))
        pause();
    if (strstr(path, "slow"))
        nanosleep(&(struct timespec){.tv_nsec = 200000000}, NULL);
    channel_answer(channel, record, strstr(path, "lies") ? size / 2 : size);
    free(record);
}

int main(void)
{
    struct channel channel;
    struct frame task;
    if (!channel_open(&channel, STDIN_FILENO, STDOUT_FILENO))
        return 2;
    while (channel_next(&channel, &task)) {
        channel_mark(&channel, CHECK_VALIDATE, "", "");
        answer(&channel, task.body);
    }
    channel_close(&channel);
    return 0;
}
