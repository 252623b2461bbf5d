// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen lsp: the language server over standard input and output. A message stands behind a header
 * with its length, as in HTTP ("Base Protocol" of the specification, LSP 3.17).
 */
#define _XOPEN_SOURCE 700 /* realpath, pipe, poll */
#include "cli/commands.h"
#include "lsp/lsp.h"
#include "program/json_values.h"
#include "program/memory.h"

#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_HEADER = 4096, MAX_MESSAGE = 1 << 30, READ_SIZE = 64 << 10 };

/* Bytes that came and that no message has taken yet. */
struct input {
    char *bytes;
    size_t start, end, capacity;
    bool is_over, has_wrong_header;
};

static void send_framed(void *user_data, const char *message, size_t size)
{
    (void)user_data;
    printf("Content-Length: %zu\r\n\r\n", size);
    fwrite(message, 1, size, stdout);
    fflush(stdout);
}

static void receive(struct input *input)
{
    if (input->start)
        memmove(input->bytes, input->bytes + input->start, input->end - input->start);
    input->end -= input->start;
    input->start = 0;
    if (input->capacity - input->end < READ_SIZE + 1) {
        input->capacity = input->capacity * 2 + READ_SIZE + 1;
        input->bytes = memory_resize(input->bytes, input->capacity);
    }
    ssize_t num = read(STDIN_FILENO, input->bytes + input->end, input->capacity - input->end - 1);
    if (num < 0 && errno == EINTR)
        return;
    input->end += num > 0 ? (size_t)num : 0;
    input->bytes[input->end] = '\0';
    input->is_over = num <= 0;
}

/* The length that a header states; false: it states none that a message can have. */
static bool read_length(const char *header, size_t *out)
{
    static const char key[] = "content-length:";
    size_t at = 0;
    while (key[at] && (header[at] | 0x20) == (key[at] | 0x20))
        ++at;
    if (key[at]) {
        const char *line = strstr(header, "\r\n");
        return line && line[2] && line[2] != '\r' && read_length(line + 2, out);
    }
    char *end;
    unsigned long long length = strtoull(header + at, &end, 10);
    *out = (size_t)length;
    return end != header + at && *end == '\r' && length <= MAX_MESSAGE;
}

/* Takes a whole message from the input; valid until the next call. NULL: none is there yet. */
static const char *take_message(struct input *input, size_t *out_size)
{
    const char *header = input->bytes + input->start,
               *end = input->end > input->start ? strstr(header, "\r\n\r\n") : NULL;
    size_t available = input->end - input->start, length;
    if (!end) {
        input->has_wrong_header = available > MAX_HEADER;
        return NULL;
    }
    if (!read_length(header, &length)) {
        input->has_wrong_header = true;
        return NULL;
    }
    size_t head = (size_t)(end - header) + 4;
    if (available - head < length)
        return NULL;
    input->start += head + length;
    *out_size = length;
    return header + head;
}

/* ---- Checks in a thread ---- */

/* The check that runs, and a pipe, to which its thread writes at the end. */
struct checker {
    struct lsp_check *check; /* NULL: none runs */
    pthread_t thread;
    int ends[2]; /* of the pipe */
};

static void *run_check(void *user_data)
{
    struct checker *checker = user_data;
    lsp_check_run(checker->check);
    ssize_t written;
    do
        written = write(checker->ends[1], "", 1);
    while (written < 0 && errno == EINTR);
    return NULL;
}

/* Without another thread the check runs here. */
static void begin_check(struct checker *checker, struct lsp_session *session)
{
    struct lsp_check *check = checker->check ? NULL : lsp_session_begin_check(session);
    if (!check)
        return;
    checker->check = check;
    if (pthread_create(&checker->thread, NULL, run_check, checker) == 0)
        return;
    checker->check = NULL;
    lsp_check_run(check);
    lsp_session_end_check(session, check);
}

static void end_check(struct checker *checker, struct lsp_session *session)
{
    char byte;
    while (read(checker->ends[0], &byte, 1) < 0 && errno == EINTR)
        continue;
    pthread_join(checker->thread, NULL);
    lsp_session_end_check(session, checker->check);
    checker->check = NULL;
}

/* Waits for a message or for the end of the check. Returns whether there is a message. */
static bool wait_for_message(struct checker *checker, struct lsp_session *session)
{
    struct pollfd waits[] = {{.fd = STDIN_FILENO, .events = POLLIN},
                             {.fd = checker->ends[0], .events = POLLIN}};
    bool has_message = poll(waits, 1, 0) > 0;
    if (!has_message && !checker->check && lsp_session_prepare(session))
        return false;
    if (!has_message)
        poll(waits, 2, -1);
    if (!has_message && waits[1].revents)
        end_check(checker, session);
    return has_message || waits[0].revents;
}

/* Answers messages until the client ends the session; a check begins when none waits. */
static int serve(struct lsp_session *session, struct checker *checker)
{
    struct input input = {0};
    bool is_clean = false;
    while (!lsp_session_is_over(session, &is_clean) && !input.is_over) {
        size_t size;
        const char *message = take_message(&input, &size);
        if (message) {
            lsp_session_handle(session, message, size);
            continue;
        }
        if (input.has_wrong_header) {
            fprintf(stderr, "mxgen lsp: a message has no 'Content-Length' of up to %d bytes\n",
                    MAX_MESSAGE);
            break;
        }
        begin_check(checker, session);
        if (wait_for_message(checker, session))
            receive(&input);
    }
    if (checker->check)
        end_check(checker, session);
    free(input.bytes);
    return is_clean ? EXIT_DONE : EXIT_FAULT;
}

/*
 * The pictures of a reference, which the caller frees; NULL: there is no reference, or after a
 * report it has no pictures.
 */
static char *find_pictures(struct report *report, const char *reference)
{
    char *folder = reference ? cli_format("%s/pictures", reference) : NULL,
         *found = folder ? realpath(folder, NULL) : NULL;
    if (reference && !found)
        report_error(report, "file-missing",
                     "there is no folder '%s': 'mxgen library doc --pictures -o %s' makes it",
                     folder, reference);
    free(folder);
    return found;
}

int command_lsp(const struct command *command, int argc, char **argv)
{
    struct cli cli;
    int code;
    bool uses_stdio; /* editors write it; it is the only way */
    const char *reference = NULL;
    const struct arg args[] = {
        {"reference", 0, ARG_TEXT, "DIR",
         "shows the pictures of nodes in DIR, which 'mxgen library doc --pictures' has made",
         &reference},
        {"stdio", 0, ARG_FLAG, NULL, "uses standard input and output, as always", &uses_stdio},
    };
    if (cli_start(&cli, command, args, sizeof args / sizeof *args, 0, argc, argv, &code)) {
        json_use_memory();
        char *pictures = find_pictures(&cli.report, reference);
        struct lsp_desc desc = {.library = cli.library,
                                .send = send_framed,
                                .messages_url = MESSAGES_URL,
                                .pictures = pictures};
        char *warnings = cli_describe_context(&cli, &desc.context);
        struct lsp_session *session = lsp_session_create(&desc);
        struct checker checker = {NULL};
        code = EXIT_FAULT;
        if (session && (pictures || !reference) && pipe(checker.ends) == 0)
            code = serve(session, &checker);
        lsp_session_destroy(session);
        free(warnings);
        free(pictures);
    }
    cli_finish(&cli);
    return code;
}
