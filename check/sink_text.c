// SPDX-License-Identifier: Apache-2.0
/*
 * The report for people: failures with their reasons, and a summary at the end. With a baseline it
 * tells only what has changed, and first of all the changes that fail the run. --stats adds the
 * slowest and the largest.
 */
#include "check/sink.h"
#include "check/spool.h"
#include "program/warning_groups.h"
#include "program/memory.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { NUM_TOP = 10 };

/* The largest items by one measure, in order. */
struct top {
    struct top_row {
        double value;
        char *name;
    } rows[NUM_TOP];
    size_t len;
};

struct text_state {
    struct top slowest, largest;
    FILE *others; /* changes that do not fail the run: after those that do */
};

static void begin(struct sink *sink)
{
    struct text_state *state = sink->state = calloc(1, sizeof(struct text_state));
    if (state && sink->run->is_compared && !sink->run->quiet)
        state->others = spool_begin();
}

/* ---- Rankings ---- */

static void rank(struct top *top, double value, const char *file, const char *element,
                 const char *target)
{
    size_t at = top->len;
    while (at > 0 && top->rows[at - 1].value < value)
        --at;
    if (at == NUM_TOP)
        return;
    size_t room = strlen(file) + strlen(element) + strlen(target) + 8;
    char *name = malloc(room);
    if (!name)
        return;
    snprintf(name, room, *element ? "%s '%s', %s" : "%s", file, element, target);
    if (top->len == NUM_TOP)
        free(top->rows[--top->len].name);
    memmove(top->rows + at + 1, top->rows + at, (top->len - at) * sizeof *top->rows);
    top->rows[at] = (struct top_row){value, name};
    ++top->len;
}

static void print_top(FILE *out, const struct top *top, const char *title, const char *unit)
{
    if (top->len)
        fprintf(out, "%s\n", title);
    for (size_t i = 0; i < top->len; ++i)
        fprintf(out, "%12.1f %s  %s\n", top->rows[i].value, unit, top->rows[i].name);
}

static void free_top(struct top *top)
{
    for (size_t i = 0; i < top->len; ++i)
        free(top->rows[i].name);
}

/*
 * Times belong to documents, sizes to shaders: instructions, or bytes if nothing was compiled.
 */
static void rank_document(struct text_state *state, const struct check_document *document)
{
    double total = document->load_ms + document->validate_ms + document->render_ms;
    for (size_t i = 0; i < document->num_elements; ++i) {
        const struct check_element *element = &document->elements[i];
        for (size_t k = 0; k < element->num_shaders; ++k) {
            const struct check_shader *shader = &element->shaders[k];
            total += shader->generate_ms + shader->compile_ms;
            rank(&state->largest, (double)shader->measures[MEASURE_SOURCE_BYTES] / 1e3,
                 document->file, element->path, shader->target);
        }
    }
    rank(&state->slowest, total, document->file, "", "");
}

/* ---- Documents ---- */

static bool has_warning(const struct check_document *document)
{
    for (size_t i = 0; i < document->num_messages; ++i)
        if (document->messages[i].severity == MXG_SEVERITY_WARNING)
            return true;
    return false;
}

static struct group_key key_of_message(const struct check_message *message)
{
    return (struct group_key){.id = message->id, .file = message->file, .text = message->text};
}

static bool key_of_warning(const void *messages, uint32_t index, struct group_key *out_key)
{
    const struct check_message *message = (const struct check_message *)messages + index;
    *out_key = key_of_message(message);
    return message->severity == MXG_SEVERITY_WARNING;
}

/* Per message the targets whose shaders have it, as bits in their order. The caller frees them. */
static uint32_t *find_targets(const struct check_run *run, const struct check_document *document)
{
    _Static_assert(MAX_TARGETS <= 32, "a target is a bit");
    uint32_t *targets = memory_alloc(document->num_messages * sizeof *targets);
    for (size_t i = 0; i < document->num_elements; ++i)
        for (size_t k = 0; k < document->elements[i].num_shaders; ++k) {
            const struct check_shader *shader = &document->elements[i].shaders[k];
            unsigned bit = 0;
            while (bit < run->num_targets && strcmp(run->targets[bit], shader->target) != 0)
                ++bit;
            for (size_t m = 0; bit < run->num_targets && m < shader->num_messages; ++m)
                targets[shader->messages[m]] |= UINT32_C(1) << bit;
        }
    return targets;
}

/* "note: for the targets glsl, osl", if these are some of the targets of the run. */
static void note_targets(FILE *out, const struct check_run *run, uint32_t targets)
{
    unsigned count = 0;
    for (size_t bit = 0; bit < run->num_targets; ++bit)
        count += targets >> bit & 1u;
    if (!count || count == run->num_targets)
        return;
    const char *before = count == 1 ? "note: for the target " : "note: for the targets ";
    for (size_t bit = 0; bit < run->num_targets; ++bit)
        if (targets >> bit & 1u) {
            fprintf(out, "%s%s", before, run->targets[bit]);
            before = ", ";
        }
    fputc('\n', out);
}

static void print_messages(FILE *out, const struct check_run *run,
                           const struct check_document *document, bool with_warnings)
{
    const struct check_message *messages = document->messages;
    uint32_t *targets = find_targets(run, document);
    struct groups groups = groups_make(messages, (uint32_t)document->num_messages, key_of_warning);
    for (uint32_t i = 0; i < document->num_messages; ++i) {
        if (groups.first[i] != i || (messages[i].severity != MXG_SEVERITY_ERROR && !with_warnings))
            continue;
        fputs(messages[i].rendered, out);
        struct group_rest rest = {0};
        for (uint32_t k = groups.next[i]; k; k = groups.next[k])
            group_rest_add(&rest, messages[k].line);
        group_rest_print(&rest, out);
        note_targets(out, run, targets[i]);
    }
    groups_finish(&groups);
    free(targets);
}

/* "'Coated': the layer 'coat': slabs 2 to 1, bytes 28 to 16, error estimated 1.71, drawn 1.46"
 */
static void print_steps(FILE *out, const struct check_document *document)
{
    for (size_t i = 0; i < document->num_elements; ++i) {
        const struct check_element *element = &document->elements[i];
        for (size_t k = 0; k < element->num_steps; ++k) {
            const struct check_step *step = &element->steps[k];
            fprintf(out,
                    "  '%s': %s: slabs %" PRIu32 " to %" PRIu32 ", bytes %" PRIu32 " to %" PRIu32
                    ", error estimated %s, drawn %s\n",
                    element->path, step->text, step->closures_before, step->closures_after,
                    step->bytes_before, step->bytes_after,
                    *step->estimated ? step->estimated : "unknown",
                    *step->drawn ? step->drawn : "unknown");
        }
    }
}

static bool has_steps(const struct check_document *document)
{
    for (size_t i = 0; i < document->num_elements; ++i)
        if (document->elements[i].num_steps)
            return true;
    return false;
}

static void print_verdict(struct sink *sink, const char *verdict,
                          const struct check_document *document, bool with_warnings)
{
    FILE *out = sink->out;
    progress_clear(sink->run->progress);
    fprintf(out, "%s %s", verdict, document->file);
    fprintf(out, document->failed ? " (%s)\n" : "\n", check_failure_names[document->failed]);
    print_messages(out, sink->run, document, with_warnings);
    if (!sink->run->quiet)
        print_steps(out, document);
}

/*
 * Prints lines such as "changed a.mtlx (topology) 'Gold' for glsl: another shader: …", and under a
 * new message its source line and notes.
 */
static void print_change(FILE *out, const struct check_document *document,
                         const struct check_change *change, bool fails)
{
    const char *rest = change->message ? strchr(change->message->rendered, '\n') : NULL;
    fprintf(out, "%s %s (%s)", fails ? "FAILED" : "changed", document->file,
            check_change_names[change->kind]);
    if (*change->element)
        fprintf(out, " '%s'", change->element);
    fprintf(out, "%s%s: %s\n", *change->target ? " for " : "", change->target, change->text);
    fputs(rest ? rest + 1 : "", out);
}

static bool key_of_change(const void *changes, uint32_t index, struct group_key *out_key)
{
    const struct check_change *change = (const struct check_change *)changes + index;
    if (change->message)
        *out_key = key_of_message(change->message);
    return change->message && change->message->severity == MXG_SEVERITY_WARNING;
}

/*
 * The changes that fail the run go to the report, the others after them. Equal new warnings are one
 * change.
 */
static void print_changes(struct sink *sink, const struct check_document *document)
{
    struct text_state *state = sink->state;
    FILE *others = state && state->others ? state->others : sink->out;
    const struct check_change *changes = document->changes;
    struct groups groups = groups_make(changes, (uint32_t)document->num_changes, key_of_change);
    for (uint32_t i = 0; i < document->num_changes; ++i) {
        bool fails = sink->run->fail_on >> changes[i].kind & 1u;
        if (groups.first[i] != i || (!fails && sink->run->quiet))
            continue;
        if (fails)
            progress_clear(sink->run->progress);
        FILE *out = fails ? sink->out : others;
        print_change(out, document, &changes[i], fails);
        struct group_rest rest = {0};
        for (uint32_t k = groups.next[i]; k; k = groups.next[k])
            group_rest_add(&rest, changes[k].message->line);
        group_rest_print(&rest, out);
    }
    groups_finish(&groups);
}

static void print_document(struct sink *sink, const struct check_document *document)
{
    const struct check_run *run = sink->run;
    if (run->with_times && sink->state)
        rank_document(sink->state, document);
    if (run->is_compared && document->failed && run->verbose
        && !check_has_change(document, run->fail_on))
        print_verdict(sink, "known", document, true);
    else if (!run->is_compared && document->failed)
        print_verdict(sink, "FAILED", document, !run->quiet);
    else if (!document->failed
             && (run->verbose
                 || ((has_warning(document) || has_steps(document)) && !run->quiet
                     && !run->is_compared)))
        print_verdict(sink, "passed", document, !run->quiet);
    print_changes(sink, document);
}

static void print_kinds(FILE *out, const struct check_totals *totals, check_change_set kinds,
                        const char *before)
{
    for (int kind = 0; kind < NUM_CHECK_CHANGES; ++kind) {
        if (!totals->changes[kind] || !(kinds >> kind & 1u))
            continue;
        fprintf(out, "%s%s %" PRIu64, before, check_change_names[kind], totals->changes[kind]);
        before = ", ";
    }
}

/* "since the baseline: 2 documents fail (fails 1, new-errors 2); others: size 4" */
static void print_comparison(FILE *out, const struct check_totals *totals, check_change_set fail_on)
{
    bool has_others = false;
    for (int kind = 0; kind < NUM_CHECK_CHANGES; ++kind)
        has_others = has_others || (totals->changes[kind] && !(fail_on >> kind & 1u));
    fputs("since the baseline: ", out);
    if (totals->failing) {
        fprintf(out, "%" PRIu64 " document%s", totals->failing,
                totals->failing == 1 ? " fails" : "s fail");
        print_kinds(out, totals, fail_on, " (");
        fputs(has_others ? "); " : ")", out);
    }
    if (has_others)
        print_kinds(out, totals, ~fail_on, totals->failing ? "others: " : "");
    fputs(totals->failing || has_others ? "\n" : "no change\n", out);
}

/* ---- Summary ---- */

/* "1 document", "2 documents" */
static void print_count(FILE *out, const char *before, uint64_t count, const char *what)
{
    fprintf(out, "%s%" PRIu64 " %s%s", before, count, what, count == 1 ? "" : "s");
}

static void print_failures(FILE *out, const struct check_totals *totals)
{
    uint64_t passed = totals->failed[CHECK_PASSED], failed = totals->documents - passed;
    fprintf(out, "%" PRIu64 " passed, %" PRIu64 " failed", passed, failed);
    const char *separator = " (";
    for (int failure = CHECK_PASSED + 1; failure < NUM_CHECK_FAILURES; ++failure) {
        if (!totals->failed[failure])
            continue;
        fprintf(out, "%s%s %" PRIu64, separator, check_failure_names[failure],
                totals->failed[failure]);
        separator = ", ";
    }
    if (totals->known)
        fprintf(out, "; known %" PRIu64, totals->known);
    print_count(out, failed ? "), " : ", ", totals->errors, "error");
    print_count(out, ", ", totals->warnings, "warning");
    fputc('\n', out);
}

static void print_times(FILE *out, const struct check_totals *totals)
{
    const struct {
        const char *what;
        double ms;
    } rows[] = {{"load", totals->load_ms},
                {"validate", totals->validate_ms},
                {"generate", totals->generate_ms},
                {"compile", totals->compile_ms},
                {"render", totals->render_ms}};
    double sum = 0.0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i)
        sum += rows[i].ms;
    fputs("time:", out);
    for (size_t i = 0; i < sizeof rows / sizeof *rows && sum > 0.0; ++i)
        if (rows[i].ms > 0.0)
            fprintf(out, "%s %s %.2f s (%.0f %%)", i ? "," : "", rows[i].what, rows[i].ms / 1e3,
                    100.0 * rows[i].ms / sum);
    fputc('\n', out);
}

/* Prints the collected state, and frees it. */
static void print_state(const struct sink *sink, struct text_state *state,
                        const struct check_totals *totals)
{
    if (sink->fault && state->others)
        fclose(state->others);
    else if (!sink->fault && spool_end(state->others, sink->out))
        fputs("note: the other changes are lost: no temporary file could be written\n", sink->out);
    if (!sink->fault && sink->run->with_times) {
        print_top(sink->out, &state->slowest, "slowest documents:", "ms");
        print_top(sink->out, &state->largest, "largest shaders:", "kB");
        print_times(sink->out, totals);
    }
    free_top(&state->slowest);
    free_top(&state->largest);
    free(state);
}

static void end(struct sink *sink, const struct check_totals *totals)
{
    if (sink->state)
        print_state(sink, sink->state, totals);
    if (sink->fault)
        return;
    for (size_t i = 0; i < totals->num_uncompiled; ++i)
        fprintf(sink->out,
                "note: shaders for '%s' were not compiled: no compiler for it is installed\n",
                totals->uncompiled[i]);
    print_count(sink->out, "", totals->documents, "document");
    print_count(sink->out, ", ", totals->elements, "element");
    print_count(sink->out, ", ", totals->shaders, "shader");
    if (totals->empty)
        print_count(sink->out, "; ", totals->empty, "document");
    fputs(totals->empty ? " without an element to generate" : "", sink->out);
    if (totals->cached)
        print_count(sink->out, "; ", totals->cached, "document");
    fputs(totals->cached ? " unchanged since last checked\n" : "\n", sink->out);
    if (sink->run->is_compared)
        print_comparison(sink->out, totals, sink->run->fail_on);
    print_failures(sink->out, totals);
}

const struct sink_kind sink_text = {"text", NULL, begin, print_document, print_changes, end};
