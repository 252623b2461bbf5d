// SPDX-License-Identifier: Apache-2.0
/*
 * Cases that a text file holds. A line "== WORDS" begins one, a line "--" ends what goes in, and a
 * blank line ends what must come out. What stands between two cases is for readers.
 */
#ifndef MXG_TESTS_UNIT_CASES_H
#define MXG_TESTS_UNIT_CASES_H

#include "test.h"

struct test_case {
    char words[128], in[8192], out[8192]; /* words without "== "; out is empty without a "--" */
};

static inline void test_case_add(char *text, size_t capacity, const char *line)
{
    size_t len = strlen(text), more = strlen(line);
    if (len + more < capacity)
        memcpy(text + len, line, more + 1);
    else
        test_count(false, __FILE__, __LINE__, "a case has too little room");
}

/* Reads the next case; false if there is none. */
static inline bool test_case_next(FILE *file, struct test_case *out)
{
    char line[1024], *to = NULL;
    memset(out, 0, sizeof *out);
    while (fgets(line, sizeof line, file)) {
        if (!to && strncmp(line, "== ", 3) == 0) {
            line[strcspn(line, "\n")] = '\0';
            test_case_add(out->words, sizeof out->words, line + 3);
            to = out->in;
        } else if (to && line[0] == '\n') {
            return true;
        } else if (to == out->in && strcmp(line, "--\n") == 0) {
            to = out->out;
        } else if (to) {
            test_case_add(to, sizeof out->in, line);
        }
    }
    return to != NULL;
}

/* Runs all cases of a file, and prints those that fail. */
static inline void test_cases(const char *path, void run(const struct test_case *c))
{
    static struct test_case c;
    FILE *file = path ? fopen(path, "r") : NULL;
    bool has_cases = false;
    while (file && test_case_next(file, &c)) {
        unsigned num_failed = test_num_failed;
        run(&c);
        if (test_num_failed > num_failed)
            printf("    case '%s'\n%s", c.words, c.in);
        has_cases = true;
    }
    REQUIRE(has_cases);
    if (file)
        fclose(file);
}

#endif
