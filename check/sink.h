// SPDX-License-Identifier: Apache-2.0
/*
 * Reports. Each kind receives the documents one by one, in order, writes its output at once and
 * keeps no document, so memory does not grow with their number.
 */
#ifndef MXG_CHECK_SINK_H
#define MXG_CHECK_SINK_H

#include "check/progress.h"
#include "check/record.h"
#include "program/args.h"
#include "program/files.h"

enum { MAX_TARGETS = 16, MAX_SHARDS = 1000000 };

/* Sums over all documents. */
struct check_totals {
    uint64_t documents, empty /* no elements */, elements, shaders, errors, warnings, cached;
    /* documents by failure; at CHECK_PASSED: documents that passed */
    uint64_t failed[NUM_CHECK_FAILURES];
    /*
     * differences from a baseline: documents with such a change, with any change that fails the
     * run, and documents that the run lacks
     */
    uint64_t changes[NUM_CHECK_CHANGES], failing, gone;
    uint64_t known;                      /* failed documents without a change that fails the run */
    const char *uncompiled[MAX_TARGETS]; /* targets without a compiler */
    size_t num_uncompiled;
    double load_ms, validate_ms, generate_ms, compile_ms, render_ms; /* sums over all workers */
};

/* Facts about the run, for all reports. */
struct check_run {
    const char *const *targets;
    size_t num_targets;
    bool quiet, verbose, compiles;
    bool is_compared;           /* the run compares with a baseline */
    uint64_t list_hash;         /* of the names of all documents, those of other shards too */
    bool accepts;               /* it writes the baseline: no change and no failure fails it */
    check_change_set fail_on;   /* the changes that fail it */
    struct progress *progress;  /* the text report erases it before it prints; NULL: none */
    bool with_times;            /* reports include times, which differ from run to run */
    uint64_t shard, num_shards; /* from 1; 0: the run has no shards */
    const char *outputs[8];     /* names of the report files */
    size_t num_outputs;
    /* files that the whole run depends on: libraries, lists, the baseline */
    struct arg_list inputs;
};

struct sink {
    const struct sink_kind *kind;
    const struct check_run *run;
    struct files_stream stream;
    FILE *out; /* the file of the report */
    uint64_t num_documents, num_gone;
    const char *fault; /* the reason why the report is incomplete; NULL: none */
    void *state;       /* private state; `end` frees it */
};

struct sink_kind {
    const char *option, *help;        /* "--json FILE" */
    void (*begin)(struct sink *sink); /* NULL: nothing to do */
    void (*document)(struct sink *sink, const struct check_document *document);
    /* A document of the baseline that the run lacks, after all others; NULL: not reported. */
    void (*gone)(struct sink *sink, const struct check_document *document);
    void (*end)(struct sink *sink, const struct check_totals *totals);
};

/*
 * The kinds that write files; the text report always exists. The depfile is last because it names
 * the others.
 */
enum { SINK_JSON, SINK_SARIF, SINK_JUNIT, SINK_HTML, SINK_DEPFILE, SINK_BASELINE, NUM_SINK_KINDS };
extern const struct sink_kind *const sink_kinds[NUM_SINK_KINDS];
extern const struct sink_kind sink_text, sink_json, sink_sarif, sink_junit, sink_html, sink_depfile,
    sink_baseline;

#endif
