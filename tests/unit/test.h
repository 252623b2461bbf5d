// SPDX-License-Identifier: Apache-2.0
/*
 * The tools of a unit test. A failed requirement is printed with its place and counted; the test
 * goes on.
 *
 *     int main(void)
 *     {
 *         REQUIRE_EQ(1 + 1, 2);
 *         return test_report("arithmetic");
 *     }
 */
#ifndef MXG_TESTS_UNIT_TEST_H
#define MXG_TESTS_UNIT_TEST_H

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* One of each for all files of a program. */
__attribute__((weak)) unsigned test_num_passed, test_num_failed;

static inline bool test_count(bool passed, const char *file, int line, const char *what)
{
    if (passed)
        test_num_passed++;
    else
        test_num_failed++;
    if (!passed)
        printf("%s:%d: %s\n", file, line, what);
    return passed;
}

static inline bool test_equal(long long a, long long b, const char *file, int line,
                              const char *what)
{
    bool passed = test_count(a == b, file, line, what);
    if (!passed)
        printf("    %lld, not %lld\n", a, b);
    return passed;
}

static inline bool test_same_text(const char *a, const char *b, const char *file, int line,
                                  const char *what)
{
    bool passed = test_count(a && b && strcmp(a, b) == 0, file, line, what);
    if (!passed)
        printf("---- is\n%s\n---- should be\n%s\n----\n", a ? a : "(null)", b ? b : "(null)");
    return passed;
}

/* Each gives whether it held. */
#define REQUIRE(condition) test_count((condition), __FILE__, __LINE__, #condition)
#define REQUIRE_EQ(a, b) \
    test_equal((long long)(a), (long long)(b), __FILE__, __LINE__, #a " == " #b)
#define REQUIRE_STR(a, b) test_same_text((a), (b), __FILE__, __LINE__, #a)

/* Prints the sum; what main returns: 77, which means skipped, where nothing was required. */
static inline int test_report(const char *name)
{
    printf("%s: %u passed, %u failed\n", name, test_num_passed, test_num_failed);
    return test_num_failed ? 1 : test_num_passed ? 0 : 77;
}

#endif
