// SPDX-License-Identifier: Apache-2.0
/*
 * Processes that mxgen programs start end with the program that started them, also if a signal
 * kills it.
 */
#ifndef MXG_PROGRAM_PARENT_H
#define MXG_PROGRAM_PARENT_H

/*
 * At the start of a program: if another mxgen program started it, it dies with that program, or at
 * once if that one has already ended. Its own children then end with it. A script that stands for a
 * program of mxgen starts it by exec.
 */
void parent_follow(void);

/* Before starting children: they end with this program. */
void parent_announce(void);

#endif
