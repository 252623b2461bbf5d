// SPDX-License-Identifier: Apache-2.0
/* What a test program needs: checks that are counted, and the line that script/test sums up. */
#ifndef MXG_TESTS_CHECK_H
#define MXG_TESTS_CHECK_H

#include <stdio.h>
#include <string.h>

static int check_passed, check_failed, check_skipped;

/* Counts a check; a false one is printed with its place. Gives the condition. */
#define CHECK(condition) check_that((condition) ? 1 : 0, __FILE__, __LINE__, #condition)
#define CHECK_STR(got, expected) check_str((got), (expected), __FILE__, __LINE__)
#define CHECK_INT(got, expected) check_int((long long)(got), (long long)(expected), __FILE__, __LINE__, #got)
/* Counts a check that cannot be made here, and says why. */
#define SKIP(reason) (++check_skipped, (void)printf("skip: %s\n", (reason)))

static inline int check_that(int good, const char *file, int line, const char *text)
{
    if (good)
        ++check_passed;
    else
        ++check_failed, printf("%s:%d: failed: %s\n", file, line, text);
    return good;
}

static inline int check_str(const char *got, const char *expected, const char *file, int line)
{
    int good = got && expected ? strcmp(got, expected) == 0 : got == expected;
    if (!check_that(good, file, line, "texts differ"))
        printf("  expected: %s\n  got:      %s\n", expected ? expected : "(none)", got ? got : "(none)");
    return good;
}

static inline int check_int(long long got, long long expected, const char *file, int line, const char *text)
{
    if (!check_that(got == expected, file, line, text))
        printf("  expected: %lld\n  got:      %lld\n", expected, got);
    return got == expected;
}

/* The last line of a test program; returns its exit code. */
static inline int check_summary(const char *name)
{
    printf("%s: %d passed, %d failed, %d skipped\n", name, check_passed, check_failed, check_skipped);
    return check_failed ? 1 : 0;
}

#endif
