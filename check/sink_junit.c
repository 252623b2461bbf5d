// SPDX-License-Identifier: Apache-2.0
/*
 * --junit: one suite per document, with one case for the document and one per element and target,
 * in the form that CI servers show. With a baseline a case fails if a change fails the run; a known
 * failure is a skipped case.
 */
#include "check/by_element.h"
#include "check/sink.h"
#include "check/spool.h"
#include "program/cli.h"
#include "program/markup.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum outcome { PASSED, FAILED, SKIPPED, NUM_OUTCOMES };

/* The suites wait in a spool, because the sums precede them. */
struct junit_state {
    struct markup suites;
    uint64_t tests, counts[NUM_OUTCOMES];
    double ms;
};

static void begin(struct sink *sink)
{
    struct junit_state *state = sink->state = calloc(1, sizeof *state);
    if (state)
        state->suites.file = spool_begin();
    if (!state || !state->suites.file)
        sink->fault = strerror(errno);
}

/* A case: the document (element and shader NULL), or an element for a target. */
struct junit_case {
    const struct check_document *document;
    const struct check_element *element;
    const struct check_shader *shader;
    struct index_list changes; /* of the element */
};

static bool is_error(const struct check_message *message)
{
    return message->severity == MXG_SEVERITY_ERROR;
}

/* A change belongs to its shader, else to the document. */
static bool is_change_of(const struct check_change *change, const struct junit_case *test)
{
    bool has_shader = *change->element && *change->target;
    return test->shader ? strcmp(change->element, test->element->path) == 0
                              && strcmp(change->target, test->shader->target) == 0
                        : !has_shader;
}

/* The changes among which those of a case are, in the document's order; NULL after the last. */
static const struct check_change *change_at(const struct junit_case *test, size_t index)
{
    const struct check_document *document = test->document;
    size_t count = test->shader ? test->changes.count : document->num_changes;
    if (index >= count)
        return NULL;
    return &document->changes[test->shader ? test->changes.items[index] : index];
}

static enum check_failure failure_of(const struct junit_case *test)
{
    return test->shader ? test->shader->failed : check_own_failure(test->document);
}

/* The first change of a case that fails the run; NULL: there is none. */
static const struct check_change *find_failing(const struct check_run *run,
                                               const struct junit_case *test)
{
    const struct check_change *change;
    for (size_t i = 0; (change = change_at(test, i)) != NULL; ++i)
        if ((run->fail_on >> change->kind & 1u) && is_change_of(change, test))
            return change;
    return NULL;
}

/* True for the only case of a document that is gone. */
static bool is_gone(const struct junit_case *test)
{
    const struct check_document *document = test->document;
    return document->num_changes && document->changes[0].kind == CHANGE_GONE
           && !*document->changes[0].element;
}

static enum outcome outcome_of(const struct check_run *run, const struct junit_case *test)
{
    bool fails =
        run->is_compared ? find_failing(run, test) != NULL : failure_of(test) != CHECK_PASSED;
    return fails ? FAILED : failure_of(test) || is_gone(test) ? SKIPPED : PASSED;
}

/* ---- Texts ---- */

/* The messages of a case: those of its shader, or those of the document and no shader. */
static const struct check_message *message_at(const struct junit_case *test, size_t index)
{
    const struct check_document *document = test->document;
    if (test->shader)
        return index < test->shader->num_messages
                   ? &document->messages[test->shader->messages[index]]
                   : NULL;
    return index < document->num_messages ? &document->messages[index] : NULL;
}

static const struct check_message *find_error(const struct junit_case *test)
{
    const struct check_message *message;
    for (size_t i = 0; (message = message_at(test, i)) != NULL; ++i)
        if (is_error(message))
            return message;
    return NULL;
}

/* All errors of a failed case, then all changes that fail the run. */
static void write_text(struct sink *sink, struct markup *out, const struct junit_case *test)
{
    const struct check_message *message;
    for (size_t i = 0; failure_of(test) && (message = message_at(test, i)) != NULL; ++i)
        if (is_error(message))
            markup_put(out, "%s", message->rendered);
    const struct check_change *change;
    for (size_t i = 0; (change = change_at(test, i)) != NULL; ++i) {
        if (!(sink->run->fail_on >> change->kind & 1u) || !is_change_of(change, test))
            continue;
        markup_put(out, "%s: ", check_change_names[change->kind]);
        markup_put(out, "%s", change->text);
        markup_put(out, "\n");
    }
}

static void write_outcome(struct sink *sink, struct markup *out, const struct junit_case *test)
{
    enum outcome outcome = outcome_of(sink->run, test);
    const struct check_change *change = find_failing(sink->run, test);
    bool has_new = change && change->message;
    const struct check_message *first = has_new            ? change->message
                                        : failure_of(test) ? find_error(test)
                                                           : NULL;
    const char *failure = check_failure_names[failure_of(test)];
    if (outcome == PASSED) {
        markup_put(out, "/>\n");
    } else if (outcome == SKIPPED) {
        markup_put(out, is_gone(test) ? "><skipped message=\"gone: "
                                      : "><skipped message=\"known failure: ");
        markup_put(out, "%s",
                   is_gone(test) ? test->document->changes[0].text
                   : first       ? first->text
                                 : failure);
        markup_put(out, "\"/></testcase>\n");
    } else {
        markup_put(out, "><failure type=\"%s\" message=\"",
                   first    ? first->id
                   : change ? check_change_names[change->kind]
                            : failure);
        markup_put(out, "%s", first ? first->text : change ? change->text : failure);
        markup_put(out, "\">");
        write_text(sink, out, test);
        markup_put(out, "</failure></testcase>\n");
    }
}

/* ---- Cases ---- */

static void begin_case(struct sink *sink, struct markup *out, const struct junit_case *test,
                       double ms)
{
    markup_put(out, "<testcase classname=\"");
    markup_put(out, "%s", test->document->file);
    markup_put(out, "\" name=\"");
    markup_put(out, "%s", test->element ? test->element->path : "document");
    if (test->shader)
        markup_put(out, ", %s", test->shader->target);
    markup_put(out, "\"");
    if (sink->run->with_times)
        markup_put(out, " time=\"%.3f\"", ms / 1e3);
}

/* Calls a function for each case of a document. */
static void for_each_case(struct sink *sink, const struct by_element *by,
                          void (*visit)(struct sink *sink, const struct junit_case *test))
{
    const struct check_document *document = by->document;
    visit(sink, &(struct junit_case){document, NULL, NULL, {NULL, 0}});
    for (size_t i = 0; i < document->num_elements; ++i)
        for (size_t k = 0; k < document->elements[i].num_shaders; ++k)
            visit(sink, &(struct junit_case){document, &document->elements[i],
                                             &document->elements[i].shaders[k],
                                             by_element_changes(by, i + 1)});
}

static double time_of(const struct junit_case *test)
{
    return test->shader ? test->shader->generate_ms + test->shader->compile_ms
                        : test->document->load_ms + test->document->validate_ms;
}

static void count_case(struct sink *sink, const struct junit_case *test)
{
    struct junit_state *state = sink->state;
    ++state->tests;
    ++state->counts[outcome_of(sink->run, test)];
    state->ms += time_of(test);
}

static void write_case(struct sink *sink, const struct junit_case *test)
{
    struct junit_state *state = sink->state;
    begin_case(sink, &state->suites, test, time_of(test));
    write_outcome(sink, &state->suites, test);
}

static void write_counts(struct sink *sink, struct markup *out, const struct junit_state *state)
{
    markup_put(
        out, " tests=\"%" PRIu64 "\" failures=\"%" PRIu64 "\" errors=\"0\" skipped=\"%" PRIu64 "\"",
        state->tests, state->counts[FAILED], state->counts[SKIPPED]);
    if (sink->run->with_times)
        markup_put(out, " time=\"%.3f\"", state->ms / 1e3);
    markup_put(out, ">\n");
}

static void write_document(struct sink *sink, const struct check_document *document)
{
    struct junit_state *state = sink->state;
    if (sink->fault)
        return;
    struct junit_state before = *state, own = {0};
    struct by_element by;
    by_element_init(&by, document);
    for_each_case(sink, &by, count_case);
    own.tests = state->tests - before.tests;
    own.ms = state->ms - before.ms;
    for (int i = 0; i < NUM_OUTCOMES; ++i)
        own.counts[i] = state->counts[i] - before.counts[i];
    markup_put(&state->suites, "<testsuite name=\"");
    markup_put(&state->suites, "%s", document->file);
    markup_put(&state->suites, "\"");
    write_counts(sink, &state->suites, &own);
    for_each_case(sink, &by, write_case);
    markup_put(&state->suites, "</testsuite>\n");
    by_element_finish(&by);
}

/* A document that is gone has one case: it fails, or is skipped. */
static void write_gone(struct sink *sink, const struct check_document *document)
{
    struct check_document plain = *document;
    plain.num_elements = plain.num_messages = 0;
    plain.failed = CHECK_PASSED;
    write_document(sink, &plain);
}

static void end(struct sink *sink, const struct check_totals *totals)
{
    struct junit_state *state = sink->state;
    struct markup out = {sink->out};
    (void)totals;
    if (!sink->fault) {
        markup_put(&out,
                   "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"mxgen check\"");
        write_counts(sink, &out, state);
        sink->fault = spool_end(state->suites.file, sink->out);
        markup_put(&out, "</testsuites>\n");
    }
    free(state);
}

const struct sink_kind sink_junit = {
    "junit",    "writes JUnit XML, with a test case for each element and target",
    begin,      write_document,
    write_gone, end};
