// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen check: reads documents and writes verdicts. Workers (pool.h) make a record of each
 * document; this file orders, judges and reports the records.
 */
#define _POSIX_C_SOURCE 200809L
#include "check/measure_budget.h"
#include "check/cache.h"
#include "check/check.h"
#include "check/gate.h"
#include "check/document_paths.h"
#include "program/cli_targets.h"
#include "program/scene_file.h"
#include "program/json_values.h"
#include "check/pool.h"
#include "check/progress.h"
#include "check/protocol.h"
#include "check/record_json.h"
#include "program/files.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define MAX_JOBS 1024
#define MAX_TIME_LIMIT 86400 /* seconds */

/* A document from its assignment to its report. */
struct slot {
    char *path;
    uint64_t index; /* index among all documents */
    struct cache_key key;
    json_t *cached; /* its record from the cache */
    char *record;   /* a worker's answer; NULL: not yet */
    size_t size;
    bool is_done;
    enum check_failure failed; /* the reason for a missing record */
    char *reason;
};

struct check {
    struct cli cli;
    struct arg_list target_args, files_from, targets, worker_args;
    size_t jobs, time_limit, memory_limit;
    bool no_compile, render, stats;
    bool needs_measures;    /* every document needs measures */
    bool needs_errors_only; /* only errors need their printed form */
    struct check_reports reports;
    struct check_inputs inputs;
    struct pool pool;
    struct cache cache;
    struct progress progress;
    struct budget budget;
    struct gate gate;
    struct check_root root;
    const char *root_folder; /* NULL: the working directory */
    const char *budget_args[NUM_MEASURES];
    const char *cache_folder, *shard, *translate, *accept;
    struct scene_place stage; /* without a file: none */
    uint64_t num_found;       /* number of documents, including other shards */

    /* a ring: limits how far workers can be ahead of the report */
    struct outputs outputs; /* the files of the reports, and the inputs of the whole run */
    bool has_clash;         /* a document is one of the former: no report may be written */

    struct slot *slots;
    size_t num_slots;
    uint64_t first, last; /* documents in the ring: the next one to report, and the end */
};

static struct slot *slot_of(struct check *check, uint64_t number)
{
    return &check->slots[number % check->num_slots];
}

/* ---- Records ---- */

/* The record of a document whose worker died or timed out. */
static struct check_document *make_failure(struct store *store, const struct slot *slot)
{
    struct check_document *document = store_alloc(store, sizeof *document);
    const char *id = slot->failed == CHECK_TIMEOUT  ? "check-timeout"
                     : slot->failed == CHECK_MEMORY ? "check-memory"
                                                    : "check-crashed";
    char *rendered = cli_format("%s: error: %s [%s]\n", slot->path, slot->reason, id);
    document->file = slot->path;
    document->failed = slot->failed;
    check_add_message(
        store, document,
        &(struct check_message){.id = id,
                                .text = slot->reason,
                                .file = slot->path,
                                .element = "",
                                .target = "",
                                .rendered = store_text(store, rendered, strlen(rendered))});
    free(rendered);
    return document;
}

static void forget_times(struct check_document *document)
{
    document->load_ms = document->validate_ms = document->render_ms = 0.0;
    for (size_t i = 0; i < document->num_elements; ++i)
        for (size_t k = 0; k < document->elements[i].num_shaders; ++k)
            document->elements[i].shaders[k].generate_ms =
                document->elements[i].shaders[k].compile_ms = 0.0;
}

/*
 * The record before any judgement, which the cache stores. NULL: there is none.
 */
static struct check_document *read_record(struct check *check, struct store *store,
                                          const struct slot *slot)
{
    struct check_document *document = NULL;
    if (slot->cached)
        document = record_from_json(store, slot->cached);
    else if (slot->record)
        document = record_from_text(store, slot->record, slot->size);
    if (document && slot->cached)
        forget_times(document);
    else if (document)
        cache_put(&check->cache, &slot->key, document);
    return document;
}

static void finish_slot(struct slot *slot)
{
    json_decref(slot->cached);
    free(slot->path);
    free(slot->record);
    free(slot->reason);
    *slot = (struct slot){0};
}

static void show_progress(struct check *check, const struct check_document *document)
{
    const struct check_totals *totals = &check->reports.totals;
    uint64_t failed = check->reports.run.is_compared
                          ? totals->failing
                          : totals->documents - totals->failed[CHECK_PASSED];
    progress_show(&check->progress, totals->documents, failed, document->file);
}

/* A report would overwrite the file, so the run ends without reports. */
static void check_clash(struct check *check, const char *path)
{
    if (check->has_clash || !outputs_has(&check->outputs, path))
        return;
    check->has_clash = true;
    report_error(&check->cli.report, "output-clash",
                 "a report would overwrite the input '%s'; choose another name", path);
}

static void report_slot(struct check *check, struct slot *slot)
{
    struct store store = {0};
    struct check_document *document = read_record(check, &store, slot);
    if (!document) {
        if (!slot->failed)
            slot->failed = CHECK_CRASH;
        if (!slot->reason)
            slot->reason = cli_format("mxgen-check gave no readable record");
        document = make_failure(&store, slot);
    }
    document->index = slot->index;
    document->name = check_root_name(&check->root, &store, document->file);
    for (size_t i = 0; i < document->num_files; ++i)
        check_clash(check, document->files[i]);
    budget_judge(&check->budget, &store, document);
    gate_compare(&check->gate, &check->reports, &store, document, &check->cli.report);
    check->reports.totals.cached += slot->cached != NULL;
    reports_document(&check->reports, document);
    show_progress(check, document);
    store_finish(&store);
    finish_slot(slot);
}

static void report_finished_slots(struct check *check)
{
    for (; check->first < check->last && slot_of(check, check->first)->is_done; ++check->first)
        report_slot(check, slot_of(check, check->first));
}

/* ---- Work ---- */

/* Adds a document to the hash of all of them, by which a merge knows the shards of one run. */
static void hash_path(struct check *check, const char *path)
{
    struct store store = {0};
    const char *name = check_root_name(&check->root, &store, path);
    uint64_t *hash = &check->reports.run.list_hash;
    *hash = names_hash(names_hash(*hash, *name ? name : path), "\n");
    store_finish(&store);
}

/* The next document of this shard; NULL at the end. */
static const char *next_path(struct check *check)
{
    const struct check_run *run = &check->reports.run;
    for (const char *path; (path = inputs_next(&check->inputs)) != NULL;) {
        uint64_t number = check->num_found++;
        if (!run->num_shards)
            return path;
        hash_path(check, path);
        if (number % run->num_shards + 1 == run->shard)
            return path;
    }
    return NULL;
}

/* The parts of the record that neither a report nor the document's budget needs. */
static uint32_t task_note(struct check *check, const char *path)
{
    bool is_brief = !check->needs_measures && !budget_has_file(&check->budget, path);
    return (is_brief ? TASK_BRIEF : 0) | (check->needs_errors_only ? TASK_ERRORS_ONLY : 0);
}

/* Assigns the next document, or takes its record from the cache; false at the end. */
static bool give_next(struct check *check)
{
    const char *path = next_path(check);
    if (!path)
        return false;
    check_clash(check, path);
    struct slot *slot = slot_of(check, check->last++);
    *slot = (struct slot){.path = cli_copy(path, strlen(path)), .index = check->num_found - 1};
    slot->cached = cache_find(&check->cache, path, &slot->key);
    slot->is_done = slot->cached != NULL;
    if (!slot->is_done)
        pool_give(&check->pool, (struct pool_task){slot->path, task_note(check, path),
                                                   (size_t)(check->last - 1)});
    return true;
}

static bool take_answer(struct check *check)
{
    struct pool_answer answer;
    if (!pool_wait(&check->pool, &answer))
        return false;
    struct slot *slot = slot_of(check, answer.ticket);
    slot->record = answer.record;
    slot->size = answer.size;
    slot->failed = answer.failed;
    slot->reason = answer.reason;
    slot->is_done = true;
    return true;
}

static void check_all(struct check *check)
{
    bool more = true;
    while (!check->pool.fault && !check->has_clash && (more || check->pool.num_open)) {
        while (more && pool_wants(&check->pool) && check->last - check->first < check->num_slots)
            more = give_next(check);
        if (check->pool.num_open)
            take_answer(check);
        report_finished_slots(check);
    }
    progress_clear(&check->progress);
    if (check->pool.fault)
        report_error(&check->cli.report, "check-failed", "%s", check->pool.fault);
}

/* ---- Arguments ---- */

/* Splits "glsl,vulkan" and finds each name among the targets. */
static bool find_targets(struct check *check)
{
    for (size_t i = 0; i < check->target_args.len; ++i) {
        for (const char *at = check->target_args.items[i]; *at;) {
            size_t len = strcspn(at, ",");
            mxg_target target;
            if (!cli_find_target(&check->cli, at, len, &target))
                return false;
            if (check->targets.len == MAX_TARGETS) {
                fprintf(stderr, "mxgen: more than %d targets\n", MAX_TARGETS);
                return false;
            }
            args_append(&check->targets, target.name);
            at += len + (at[len] == ',');
        }
    }
    if (check->targets.len == 0)
        args_append(&check->targets, "glsl");
    return cli_options_apply(&check->cli, check->targets.items, check->targets.len);
}

static void add_worker_arg(struct check *check, const char *name, const char *value)
{
    args_append(&check->worker_args,
                value ? cli_format("--%s=%s", name, value) : cli_format("%s", name));
}

/* "2/8" */
static bool parse_shard(struct check *check)
{
    char *end = NULL;
    struct check_run *run = &check->reports.run;
    if (!check->shard)
        return true;
    run->shard = strtoul(check->shard, &end, 10);
    run->num_shards = *end == '/' ? strtoul(end + 1, &end, 10) : 0;
    if (*end == '\0' && run->shard >= 1 && run->shard <= run->num_shards
        && run->num_shards <= MAX_SHARDS)
        return true;
    fprintf(stderr, "mxgen: '%s' is not a shard; write K/N, from 1/N to N/N\n", check->shard);
    return false;
}

static bool parse_budgets(struct check *check)
{
    for (int i = 0; i < NUM_MEASURES; ++i)
        if (check->budget_args[i]
            && !budget_add(&check->budget, (enum measure)i, check->budget_args[i]))
            return false;
    return true;
}

/* The command line of a worker: the same library, limits and options. */
static void make_worker_args(struct check *check)
{
    char *program = cli_program("mxgen-check");
    args_append(&check->worker_args, program);
    for (size_t i = 0; i < check->targets.len; ++i)
        add_worker_arg(check, "target", check->targets.items[i]);
    if (check->no_compile)
        add_worker_arg(check, "--no-compile", NULL);
    if (check->render)
        add_worker_arg(check, "--render", NULL);
    if (check->translate)
        add_worker_arg(check, "translate", check->translate);
    if (check->accept)
        add_worker_arg(check, "accept", check->accept);
    if (check->stage.file)
        add_worker_arg(check, "stage", check->stage.file);
    if (check->stage.look)
        add_worker_arg(check, "look", check->stage.look);
    if (check->stage.purpose)
        add_worker_arg(check, "purpose", check->stage.purpose);
    if (check->memory_limit)
        args_append(&check->worker_args, cli_format("--memory-limit=%zu", check->memory_limit));
    cli_forward(&check->cli, &check->worker_args);
    args_append(&check->worker_args, NULL);
}

static bool open_root(struct check *check)
{
    if (check_root_open(&check->root, check->root_folder))
        return true;
    report_error(&check->cli.report, "file-missing", "cannot open '%s': %s",
                 check->root_folder ? check->root_folder : ".", strerror(errno));
    return false;
}

/* Names the inputs of all documents, for the depfile. */
static void name_inputs(struct check *check)
{
    struct arg_list *inputs = &check->reports.run.inputs;
    for (uint32_t i = 0; i < mxg_library_num_files(check->cli.library); ++i)
        args_append(inputs, mxg_library_file(check->cli.library, i));
    for (size_t i = 0; i < check->files_from.len; ++i)
        if (strcmp(check->files_from.items[i], "-") != 0)
            args_append(inputs, check->files_from.items[i]);
    for (size_t i = 0; i < check->cli.parser.inputs.len; ++i)
        if (check->cli.parser.inputs.items[i][0] == '@')
            args_append(inputs, check->cli.parser.inputs.items[i] + 1);
    if (check->reports.run.is_compared)
        args_append(inputs, check->gate.path);
}

static bool prepare(struct check *check)
{
    const struct cli *cli = &check->cli;
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    if (check->jobs == 0)
        check->jobs = cores > 0 ? (size_t)cores : 1;
    if (check->jobs > MAX_JOBS)
        check->jobs = MAX_JOBS;
    if (check->time_limit == 0)
        check->time_limit = MAX_TIME_LIMIT;
    struct check_run *run = &check->reports.run;
    run->targets = check->targets.items;
    run->num_targets = check->targets.len;
    run->quiet = cli->quiet;
    run->verbose = cli->verbose;
    run->compiles = !check->no_compile;
    run->with_times = check->stats;
    if (!open_root(check)
        || !gate_open(&check->gate, &check->reports, check->root.given, &check->cli.report))
        return false;
    name_inputs(check);
    const char *const *paths = check->reports.paths;
    check->needs_measures = check->stats || check->cache_folder || check->budget.command_line.len
                            || run->is_compared || paths[SINK_JSON] || paths[SINK_HTML]
                            || paths[SINK_BASELINE];
    check->needs_errors_only =
        cli->quiet && !check->needs_measures && !paths[SINK_SARIF] && !paths[SINK_JUNIT];
    check->num_slots = 2 * pool_capacity(check->jobs) + 64;
    check->slots = calloc(check->num_slots, sizeof *check->slots);
    bool good = reports_claim(&check->reports, &check->outputs, &check->cli.report);
    for (size_t i = 0; i < run->inputs.len; ++i) {
        /* --update-baseline replaces the baseline that it reads */
        bool is_replaced = check->gate.update && check->gate.path
                           && strcmp(run->inputs.items[i], check->gate.path) == 0;
        good =
            (is_replaced || outputs_read(&check->outputs, &check->cli.report, run->inputs.items[i]))
            && good;
    }
    return good && check->slots && reports_begin(&check->reports, &check->cli.report);
}

/* Reports a missing renderer once instead of for every element. */
static bool find_renderer(struct check *check)
{
    char *program = check->render || check->accept ? cli_program("mxgen-render") : NULL;
    bool found = !program || files_find_program(program);
    if (!found)
        report_error(&check->cli.report, "no-renderer",
                     "there is no '%s': it is built where Vulkan and OpenImageIO are installed",
                     program);
    free(program);
    return found;
}

/* Exit code 1 if anything failed, or if there was nothing to check. */
static int run(struct check *check)
{
    struct report *report = &check->cli.report;
    const struct check_totals *totals = &check->reports.totals;
    if (!find_renderer(check) || !prepare(check))
        return EXIT_FAULT;
    make_worker_args(check);
    inputs_init(&check->inputs, &check->cli.parser.inputs, &check->files_from);
    check->cache = (struct cache){
        .folder = check->cache_folder,
        .max_file_size = (uint64_t)(cli_max_file_size(&check->cli)) << 20,
        .time_limit = (uint64_t)check->time_limit * 1000000000u,
    };
    cache_init(&check->cache, &check->worker_args, check->cli.library);
    pool_init(&check->pool, (char *const *)(uintptr_t)check->worker_args.items, check->jobs,
              (double)check->time_limit);
    check->pool.memory_limit = check->memory_limit;
    progress_init(&check->progress, !check->cli.quiet);
    check->reports.run.progress = &check->progress;
    check_all(check);
    gate_tell_gone(&check->gate, &check->reports);
    reports_end(&check->reports, report, !check->pool.fault && !check->has_clash);
    if (check->cache.fault)
        fprintf(stderr, "warning: the cache '%s' cannot be written: %s [output-failed]\n",
                check->cache_folder, check->cache.fault);
    if (check->budget.num_unjudged)
        report_warning(report, "budget-unjudged",
                       "the budget of instructions does not hold for %" PRIu64
                       " shaders, which were not compiled",
                       check->budget.num_unjudged);
    if (totals->documents == 0 && !check->num_found && !check->inputs.failed && !check->pool.fault)
        report_error(report, "nothing-to-check", "found no document to check");
    bool good = !report->errors && !check->inputs.failed && reports_are_good(&check->reports);
    return good ? EXIT_DONE : EXIT_FAULT;
}

static void finish(struct check *check)
{
    for (; check->slots && check->first < check->last; ++check->first) /* after a fault */
        finish_slot(slot_of(check, check->first));
    free(check->slots);
    pool_finish(&check->pool);
    cache_finish(&check->cache);
    budget_finish(&check->budget);
    gate_finish(&check->gate);
    check_root_finish(&check->root);
    inputs_finish(&check->inputs);
    outputs_finish(&check->outputs);
    args_free(&check->worker_args);
    free(check->target_args.items);
    free(check->files_from.items);
    free(check->targets.items);
    free(check->reports.run.inputs.items);
    cli_finish(&check->cli);
}

static bool is_error(const char *text)
{
    char *end;
    double value = strtod(text, &end);
    return *text && !*end && value >= 0;
}

/* The reason why --stage cannot stand with the other arguments; NULL if it can. */
static const char *find_stage_misuse(const struct check *check)
{
    if (!check->stage.file)
        return check->stage.look || check->stage.purpose ? "--look and --purpose need --stage"
                                                         : NULL;
    if (check->render)
        return "--render draws materials; 'mxgen render --stage' draws the scene";
    if (check->translate)
        return "--translate takes materials, not the stacks of --stage";
    return check->cache_folder ? "--cache does not know the files that a stage is composed of"
                               : NULL;
}

static const char *find_misuse(const struct check *check)
{
    if (check->cli.parser.inputs.len == 0 && check->files_from.len == 0)
        return "nothing to check is named; see --help";
    if (check->accept && !check->translate)
        return "--accept is the drawn error of --translate MODEL";
    if (check->accept && !is_error(check->accept))
        return "--accept takes a number, at least 0";
    if (check->no_compile && check->budget_args[MEASURE_INSTRUCTIONS])
        return "--max-instructions counts those of compiled shaders; leave out --no-compile";
    bool has_report = false;
    for (size_t i = 0; i < SINK_DEPFILE; ++i)
        has_report = has_report || check->reports.paths[i];
    if (check->reports.paths[SINK_DEPFILE] && !has_report)
        return "a depfile tells what a report depends on: write one too, --json FILE";
    const char *misuse = find_stage_misuse(check);
    return misuse ? misuse : reports_misuse(&check->reports);
}

static int run_if_sensible(struct check *check)
{
    const char *misuse = find_misuse(check);
    if (misuse)
        fprintf(stderr, "mxgen: %s\n", misuse);
    return !misuse && find_targets(check) && parse_shard(check) && parse_budgets(check)
                   && gate_parse(&check->gate, &check->reports)
               ? run(check)
               : EXIT_USAGE;
}

int command_check(const struct command *command, int argc, char **argv)
{
    json_use_memory();
    if (argc > 1 && strcmp(argv[1], "merge") == 0)
        return check_merge(command, argc - 1, argv + 1);
    struct check check = {.time_limit = 120, .memory_limit = 4096, .budget.cli = &check.cli};
    struct arg args[18 + NUM_GATE_ARGS + NUM_SINK_KINDS + NUM_MEASURES] = {
        {"target", 't', ARG_LIST, "T,...", "targets (default: glsl)", &check.target_args},
        {"jobs", 'j', ARG_SIZE, "N",
         "documents checked at the same time; 0: number of cores (default: 0)", &check.jobs,
         .high = MAX_JOBS},
        {"files-from", 0, ARG_LIST, "FILE",
         "reads paths from a file, one on each line; '-' is standard input", &check.files_from},
        {"no-compile", 0, ARG_FLAG, NULL, "does not compile the shaders", &check.no_compile},
        {"render", 0, ARG_FLAG, NULL,
         "renders each element, for the gallery and for comparison with a baseline", &check.render},
        {"translate", 0, ARG_TEXT, "MODEL",
         "checks the documents with their surfaces as another shading model", &check.translate},
        {"accept", 0, ARG_TEXT, "ERROR",
         "for --translate: an element fails whose pictures before and after differ by more (mean "
         "CIEDE2000 of three views)",
         &check.accept},
        {"stage", 0, ARG_TEXT, "FILE",
         "a scene: checks the shader of each distinct stack of its primitives, in place of those "
         "of materials",
         &check.stage.file},
        {"look", 0, ARG_TEXT, "LOOK", "the look for --stage, or a look group with a default",
         &check.stage.look},
        {"purpose", 0, ARG_TEXT, "WORD",
         "for --stage: also takes the bindings of the scene for this purpose",
         &check.stage.purpose},
        {"time-limit", 0, ARG_SIZE, "S",
         "limit in seconds for one step: one element for one target; 0: none (default: 120)",
         &check.time_limit, .high = MAX_TIME_LIMIT},
        {"memory-limit", 0, ARG_SIZE, "MIB",
         "limit of the memory of a worker; 0: none (default: 4096)", &check.memory_limit},
        {"cache", 0, ARG_PATH, "DIR", "keeps results, and checks only changed documents again",
         &check.cache_folder},
        {"shard", 0, ARG_TEXT, "K/N",
         "checks part K of N; 'mxgen check merge' joins the JSON reports", &check.shard},
        {"root", 0, ARG_TEXT, "DIR",
         "names documents in reports and baselines by their path below this folder (default: the "
         "working directory)",
         &check.root_folder},
        {"stats", 0, ARG_FLAG, NULL, "prints times, the slowest documents and the largest shaders",
         &check.stats},
    };
    size_t num_args = 0;
    while (args[num_args].name)
        ++num_args;
    num_args += reports_args(&check.reports, args + num_args);
    num_args += gate_args(&check.gate, args + num_args);
    for (int i = 0; i < NUM_MEASURES; ++i)
        args[num_args++] = (struct arg){
            measure_infos[i].option, 0,       ARG_TEXT, "N | T=N,...", measure_infos[i].meaning,
            &check.budget_args[i],   ARG_MORE};
    int code;
    if (cli_start(&check.cli, command, args, num_args, CLI_GENERATES, argc, argv, &code))
        code = run_if_sensible(&check);
    finish(&check);
    return code;
}
