// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "program/parent.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/prctl.h>
#endif

#define VARIABLE "MXGEN_PARENT" /* the process id of the program that starts another one */

void parent_follow(void)
{
    const char *text = getenv(VARIABLE);
    if (!text)
        return; /* the user started this program */
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    if (strtol(text, NULL, 10) != (long)getppid()) { /* it ended before the call */
        fputs("mxgen: the program that started this one has ended\n", stderr);
        _exit(1);
    }
    parent_announce();
}

void parent_announce(void)
{
    char text[32];
    snprintf(text, sizeof text, "%ld", (long)getpid());
    setenv(VARIABLE, text, 1);
}
