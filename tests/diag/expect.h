// SPDX-License-Identifier: Apache-2.0
/* Messages that documents say they give, and the comparison with those given. */
#ifndef MXG_TESTS_DIAG_EXPECT_H
#define MXG_TESTS_DIAG_EXPECT_H

#include <stdbool.h>

enum { EXPECT_MAX_MESSAGES = 256, EXPECT_MAX_FILES = 32, EXPECT_ANYWHERE = -1 };

struct message {
    char file[128]; /* base name */
    char id[64];
    char text[200];    /* of given messages */
    int severity;      /* as mxg_severity */
    long line, column; /* column 0: any; line EXPECT_ANYWHERE: any place in any file */
    bool matched;
};

struct messages {
    struct message items[EXPECT_MAX_MESSAGES];
    unsigned len;
};

/* The expectations of a document: read from it and the files it reads, each once. */
struct expectations {
    struct messages messages;
    char files[EXPECT_MAX_FILES][128];
    unsigned num_files;
};

extern const char *const severity_names[3];

const char *base_name(const char *path); /* "" for NULL */
char *read_text(const char *path);       /* up to 1 MiB, to be freed; "" where it cannot be read */

/* Adds the expectations of a file; false where one of them cannot be understood. */
bool expect_read(struct expectations *expectations, const char *path);

/* Adds a message unless it is there. */
void messages_add(struct messages *messages, const struct message *message);

/* Marks in both lists what fits; an expectation of any place fits any number of times. */
void expect_match(struct expectations *expectations, struct messages *given);

#endif
