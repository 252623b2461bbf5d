// SPDX-License-Identifier: Apache-2.0
/*
 * Reports. Each kind is told of the documents one by one, in order, writes what it has to say at
 * once and keeps nothing of them: memory does not grow with their number.
 */
#ifndef MXG_CHECK_SINK_H
#define MXG_CHECK_SINK_H

#include "cli/args.h"
#include "check/record.h"
#include "cli/files.h"

enum { MAX_TARGETS = 16, MAX_SHARDS = 1000000 };

/* Sums over all documents. */
struct check_totals {
    uint64_t documents, empty /* no elements */, elements, shaders, errors, warnings, cached;
    /* documents, by the stage; at CHECK_PASSED those that passed */
    uint64_t failed[NUM_CHECK_STAGES];
    /* since a baseline: documents with such a change; CHANGE_GONE: those that are not there too */
    uint64_t changes[NUM_CHECK_CHANGES];
    const char *uncompiled[MAX_TARGETS]; /* targets that there is no compiler for */
    size_t num_uncompiled;
    double load_ms, validate_ms, generate_ms, compile_ms, render_ms; /* of all workers */
};

/* What all reports are about. */
struct check_run {
    const char *const *targets;
    size_t num_targets;
    bool quiet, verbose, compiles;
    bool is_compared;           /* with a baseline */
    bool with_times;            /* reports tell times, which differ from run to run */
    uint64_t shard, num_shards; /* from 1; 0: this is all */
    const char *outputs[8];     /* the reports that are written to files */
    size_t num_outputs;
    /* files that were read for the run as a whole: libraries, lists, the baseline */
    struct arg_list inputs;
};

struct sink {
    const struct sink_kind *kind;
    const struct check_run *run;
    struct files_stream stream;
    FILE *out; /* of the stream */
    uint64_t num_documents;
    void *state; /* of the kind; freed by its end */
};

struct sink_kind {
    const char *option, *help;        /* "--json FILE" */
    void (*begin)(struct sink *sink); /* NULL: nothing to do */
    void (*document)(struct sink *sink, const struct check_document *document);
    void (*end)(struct sink *sink, const struct check_totals *totals);
};

/* All kinds that write files; text is always written. What a depfile is about comes before it. */
enum { SINK_JSON, SINK_SARIF, SINK_JUNIT, SINK_HTML, SINK_DEPFILE, SINK_BASELINE, NUM_SINK_KINDS };
extern const struct sink_kind *const sink_kinds[NUM_SINK_KINDS];
extern const struct sink_kind sink_text, sink_json, sink_sarif, sink_junit, sink_html, sink_depfile,
    sink_baseline;

#endif
