// SPDX-License-Identifier: Apache-2.0
#include "check/check.h"

#include <stdlib.h>
#include <string.h>

const struct sink_kind *const sink_kinds[NUM_SINK_KINDS] = {
    [SINK_JSON] = &sink_json, [SINK_SARIF] = &sink_sarif,     [SINK_JUNIT] = &sink_junit,
    [SINK_HTML] = &sink_html, [SINK_DEPFILE] = &sink_depfile, [SINK_BASELINE] = &sink_baseline,
};

static void begin_sink(struct sink *sink, const struct sink_kind *kind, const struct check_run *run,
                       FILE *out)
{
    sink->kind = kind;
    sink->run = run;
    sink->out = out;
    if (kind->begin)
        kind->begin(sink);
}

size_t reports_args(struct check_reports *reports, struct arg *args)
{
    for (size_t i = 0; i < NUM_SINK_KINDS; ++i)
        args[i] = (struct arg){sink_kinds[i]->option, 0, ARG_TEXT, "FILE", sink_kinds[i]->help,
                               &reports->paths[i]};
    return NUM_SINK_KINDS;
}

const char *reports_misuse(const struct check_reports *reports)
{
    unsigned num_on_stdout = 0;
    for (size_t i = 0; i < NUM_SINK_KINDS; ++i)
        num_on_stdout += reports->paths[i] && strcmp(reports->paths[i], "-") == 0;
    return num_on_stdout > 1 ? "two reports would be one standard output; name a file for each"
                             : NULL;
}

bool reports_claim(const struct check_reports *reports, struct outputs *outputs,
                   struct report *report)
{
    bool good = true;
    for (size_t i = 0; i < NUM_SINK_KINDS; ++i) {
        if (!reports->paths[i])
            continue;
        char *owner = cli_format("--%s", sink_kinds[i]->option);
        good = outputs_write(outputs, report, reports->paths[i], owner) && good;
        free(owner);
    }
    return good;
}

bool reports_begin(struct check_reports *reports, struct report *report)
{
    bool good = true, is_stdout_taken = false;
    for (size_t i = 0; i < SINK_DEPFILE; ++i)
        if (reports->paths[i])
            reports->run.outputs[reports->run.num_outputs++] = reports->paths[i];
    for (size_t i = 0; i < NUM_SINK_KINDS; ++i) {
        struct sink *sink = &reports->files[i];
        const char *path = reports->paths[i];
        const char *reason = path ? files_begin(&sink->stream, path) : NULL;
        if (reason) {
            report_error(report, "output-failed", "cannot write '%s': %s", path, reason);
            good = false;
        } else if (path) {
            is_stdout_taken = is_stdout_taken || sink->stream.out == stdout;
            begin_sink(sink, sink_kinds[i], &reports->run, sink->stream.out);
        }
    }
    begin_sink(&reports->text, &sink_text, &reports->run, is_stdout_taken ? stderr : stdout);
    if (!good)
        reports_end(reports, report, false);
    return good;
}

/* ---- Sums ---- */

static void add_uncompiled(struct check_totals *totals, const char *target,
                           const struct check_run *run)
{
    for (size_t i = 0; i < totals->num_uncompiled; ++i)
        if (strcmp(totals->uncompiled[i], target) == 0)
            return;
    for (size_t i = 0; i < run->num_targets && totals->num_uncompiled < MAX_TARGETS; ++i)
        if (strcmp(run->targets[i], target) == 0)
            totals->uncompiled[totals->num_uncompiled++] = run->targets[i];
}

static void add_shader(struct check_totals *totals, const struct check_shader *shader,
                       const struct check_run *run)
{
    ++totals->shaders;
    totals->generate_ms += shader->generate_ms;
    totals->compile_ms += shader->compile_ms;
    if (!shader->compiled && shader->failed != CHECK_GENERATE && run->compiles)
        add_uncompiled(totals, shader->target, run);
}

static void add_changes(struct check_totals *totals, const struct check_document *document,
                        const struct check_run *run)
{
    bool has[NUM_CHECK_CHANGES] = {false};
    for (size_t i = 0; i < document->num_changes; ++i)
        has[document->changes[i].kind] = true;
    for (size_t i = 0; i < NUM_CHECK_CHANGES; ++i)
        totals->changes[i] += has[i];
    bool fails = check_has_change(document, run->fail_on);
    totals->failing += fails;
    totals->known += run->is_compared && document->failed && !fails;
}

static void add_document(struct check_totals *totals, const struct check_document *document,
                         const struct check_run *run)
{
    ++totals->documents;
    ++totals->failed[document->failed];
    totals->empty += document->num_elements == 0 && !document->failed;
    totals->elements += document->num_elements;
    for (size_t i = 0; i < document->num_messages; ++i) {
        totals->errors += document->messages[i].severity == MXG_SEVERITY_ERROR;
        totals->warnings += document->messages[i].severity == MXG_SEVERITY_WARNING;
    }
    for (size_t i = 0; i < document->num_elements; ++i)
        for (size_t k = 0; k < document->elements[i].num_shaders; ++k)
            add_shader(totals, &document->elements[i].shaders[k], run);
    add_changes(totals, document, run);
    totals->load_ms += document->load_ms;
    totals->validate_ms += document->validate_ms;
    totals->render_ms += document->render_ms;
}

/* ---- Documents ---- */

static void write_document(struct sink *sink, const struct check_document *document)
{
    if (!sink->out)
        return;
    sink->kind->document(sink, document);
    ++sink->num_documents;
}

void reports_document(struct check_reports *reports, const struct check_document *document)
{
    add_document(&reports->totals, document, &reports->run);
    for (size_t i = 0; i < NUM_SINK_KINDS; ++i)
        write_document(&reports->files[i], document);
    write_document(&reports->text, document);
}

void reports_gone(struct check_reports *reports, const struct check_document *document)
{
    struct check_totals *totals = &reports->totals;
    ++totals->gone;
    ++totals->changes[CHANGE_GONE];
    totals->failing += check_has_change(document, reports->run.fail_on);
    for (size_t i = 0; i <= NUM_SINK_KINDS; ++i) {
        struct sink *sink = i < NUM_SINK_KINDS ? &reports->files[i] : &reports->text;
        if (!sink->out || !sink->kind->gone)
            continue;
        sink->kind->gone(sink, document);
        ++sink->num_gone;
    }
}

bool reports_are_good(const struct check_reports *reports)
{
    const struct check_totals *totals = &reports->totals;
    if (reports->run.accepts)
        return true;
    return reports->run.is_compared ? totals->failing == 0
                                    : totals->failed[CHECK_PASSED] == totals->documents;
}

bool reports_end(struct check_reports *reports, struct report *report, bool keep)
{
    bool good = true;
    for (size_t i = 0; i < NUM_SINK_KINDS; ++i) {
        struct sink *sink = &reports->files[i];
        if (!sink->out)
            continue;
        sink->kind->end(sink, &reports->totals);
        const char *fault = sink->fault, *reason = files_end(&sink->stream, keep && !fault);
        reason = fault ? fault : reason;
        if (reason)
            report_error(report, "output-failed", "cannot write '%s': %s", reports->paths[i],
                         reason);
        good = good && !reason;
    }
    if (!keep)
        reports->text.fault = "the run failed";
    reports->text.kind->end(&reports->text, &reports->totals);
    return good;
}
