// SPDX-License-Identifier: Apache-2.0
/*
 * Files that people and machines leave beside documents: mxgen.toml with budgets, the profile of a
 * platform, and the JSON reports of checks. Nothing of an input ends the program, and everything it
 * makes is freed.
 */
#define _DEFAULT_SOURCE /* mkstemps, mkdtemp */
#include "fuzz.h"

#include "check/measure_budget.h"
#include "check/record_json.h"
#include "check/report_reader.h"
#include "program/cli.h"
#include "program/profile.h"
#include "program/store.h"

#include <string.h>
#include <unistd.h>

static void read_budgets(const char *text)
{
    const struct cli cli = {0};
    struct store store = {0};
    struct budget_rules rules = {0};
    struct check_message fault = {0};
    budget_read_toml(&cli, &store, "mxgen.toml", text, &rules, &fault);
    FUZZ_REQUIRE(!fault.id || fault.line);
    for (size_t i = 0; i < rules.len; i++)
        FUZZ_REQUIRE(rules.items[i].measure < NUM_MEASURES && rules.items[i].target);
    store_finish(&store);
}

static void read_profile(const char *path)
{
    mxg_context *context = NULL;
    mxg_options *options = NULL;
    struct profile profile = {0};
    if (mxg_context_create(NULL, &context) == MXG_OK
        && mxg_options_create(context, &options) == MXG_OK)
        profile_apply(&profile, options, path);
    profile_finish(&profile);
    mxg_options_destroy(options);
    mxg_context_destroy(context);
}

static void read_report(const char *path)
{
    struct report_reader reader = {0};
    uint64_t first = 0, offset;
    bool has_one = false;
    reader_open(&reader, path);
    while (!reader.fault && reader_next(&reader, &offset)) {
        struct store store = {0};
        first = has_one ? first : offset;
        has_one = true;
        record_from_json(&store, reader.document);
        store_finish(&store);
    }
    /* what has an offset is there again */
    FUZZ_REQUIRE(!has_one || reader.fault || reader_read_at(&reader, first));
    reader_close(&reader);
}

/* The readers open files by name. */
void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    char path[] = P_tmpdir "/mxgen-fuzz-XXXXXX.toml", *text = malloc(size + 1);
    int file = mkstemps(path, 5);
    FUZZ_REQUIRE(text && file >= 0 && write(file, data, size) == (ssize_t)size);
    close(file);
    memcpy(text, data, size);
    text[size] = '\0';
    (void)heap; /* programs end where memory is exhausted */
    if (size && data[0] == '{') {
        read_report(path);
    } else {
        read_budgets(text);
        read_profile(path);
    }
    unlink(path);
    free(text);
}
