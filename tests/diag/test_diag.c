// SPDX-License-Identifier: Apache-2.0
/*
 * Documents with faults, and the messages they must give: no more, no fewer. A document says them
 * beside the fault,
 *
 *     <!-- expect-error@+1: type-mismatch 14 -->      severity, line (here: the next), id, column
 * (optional)
 *
 * in itself or in a file it reads (there perhaps behind //). The place is @+N or @-N lines from the
 * comment, @N line N, @0 no line, @* any place in any file, any number of times, and without @ the
 * comment's own line. A first line "<!-- mxgen: key=value ... -->" has options: target, element,
 * library, warnings, trust=yes, sandbox=yes, limits (max-errors …), and those of generation. Every
 * document is loaded, validated, and everything in it that can be rendered is generated.
 *
 *     test_diag FOLDER              and every id of the catalogue must be expected in a document or
 * listed in FOLDER/elsewhere.txt test_diag --must-fail FOLDER  every document must break one of
 * these rules: the test of this program
 *
 * A document whose name begins with '_' is parked: its first line says why.
 */
#define _POSIX_C_SOURCE 200809L
#include "expect.h"

#include <mxgen/mxgen.h>

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const ids[] = {
#define DIAG(id, severity, stable, format) stable,
#include "diag/catalogue.def"
#undef DIAG
};
enum { NUM_IDS = sizeof ids / sizeof *ids };
static bool covered[NUM_IDS];

struct case_ {
    const char *name;
    struct expectations expected;
    struct messages given;
    unsigned num_faults;
    bool silent, no_library;

    mxg_context *context;
    mxg_library *library;
    mxg_document *document;
    mxg_options *options;
    char target[128], element[128]; /* element "": all */
};

static void fault(struct case_ *c, const char *what, const struct message *m)
{
    ++c->num_faults;
    if (c->silent)
        return;
    if (m)
        printf("%s:%ld:%ld: %s: %s %s: %s\n", m->file, m->line, m->column, what,
               severity_names[m->severity], m->id, m->text);
    else
        printf("%s: %s\n", c->name, what);
}

static void read_expectations(struct case_ *c, const char *path)
{
    if (!expect_read(&c->expected, path))
        fault(c, "an expectation cannot be understood", NULL);
}

/* ---- What is given ---- */

/* Loading, validating and generating may say the same; once is enough. */
static void collect(struct case_ *c, const mxg_diagnostics *list)
{
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); ++i) {
        mxg_diagnostic d = {sizeof d};
        mxg_diagnostics_item(list, i, &d);
        struct message m = {.severity = (int)d.severity, .line = d.line, .column = d.column};
        snprintf(m.file, sizeof m.file, "%s", d.file ? base_name(d.file) : c->name);
        snprintf(m.id, sizeof m.id, "%s", d.id);
        snprintf(m.text, sizeof m.text, "%s", d.message);
        messages_add(&c->given, &m);
    }
}

/* Any status but these two would be the caller's fault, ours. */
static bool status_is_good(struct case_ *c, mxg_status status)
{
    if (status != MXG_OK && status != MXG_ERROR_DOCUMENT)
        fault(c, mxg_status_string(status), NULL);
    return status == MXG_OK;
}

static void generate(struct case_ *c, const char *element)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = c->target;
    desc.element = element;
    desc.options = c->options;
    mxg_result *result = NULL;
    bool good = status_is_good(c, mxg_generate(c->context, c->document, &desc, &result));
    collect(c, mxg_result_diagnostics(result));
    if (good != (mxg_result_source(result, MXG_STAGE_PIXEL, NULL) != NULL))
        fault(c, good ? "no source without an error" : "an error and yet a source", NULL);
    mxg_result_destroy(result);
}

static void check_document(struct case_ *c)
{
    if (!status_is_good(c, mxg_document_load(c->context, c->library, c->name, &c->document))) {
        collect(c, mxg_document_diagnostics(c->document));
        return;
    }
    collect(c, mxg_document_diagnostics(c->document));
    mxg_result *result = NULL;
    status_is_good(c, mxg_validate(c->context, c->document, &result));
    collect(c, mxg_result_diagnostics(result));
    mxg_result_destroy(result);
    uint32_t count = mxg_document_num_renderables(c->document);
    for (uint32_t i = 0; i < count && !c->element[0]; ++i) {
        mxg_renderable renderable = {sizeof renderable};
        mxg_document_renderable(c->document, i, &renderable);
        generate(c, renderable.path);
    }
    if (c->element[0] || count == 0)
        generate(c, c->element[0] ? c->element : NULL);
}

/* ---- Options on the first line ---- */

static bool set_limit(mxg_context_desc *desc, const char *key, const char *value)
{
    static char warnings[128];
    if (strcmp(key, "warnings") == 0) {
        snprintf(warnings, sizeof warnings, "%s", value);
        desc->warnings = warnings;
        return true;
    }
    desc->trust = desc->trust || strcmp(key, "trust") == 0;
    desc->sandbox = desc->sandbox || strcmp(key, "sandbox") == 0;
    if (strcmp(key, "trust") == 0 || strcmp(key, "sandbox") == 0)
        return true;
    const struct {
        const char *key;
        uint32_t *out;
    } limits[] = {{"max-file-size", &desc->max_file_mib},
                  {"max-elements", &desc->max_elements},
                  {"max-nodes", &desc->max_nodes},
                  {"max-output-size", &desc->max_output_mib},
                  {"max-errors", &desc->max_errors},
                  {"max-depth", &desc->max_depth},
                  {"max-include-depth", &desc->max_include_depth},
                  {"max-includes", &desc->max_includes}};
    for (size_t i = 0; i < sizeof limits / sizeof *limits; ++i) {
        if (strcmp(key, limits[i].key) != 0)
            continue;
        *limits[i].out = (uint32_t)strtoul(value, NULL, 10);
        return true;
    }
    return false;
}

/* Two rounds: limits are the context's and make it; the rest needs it. */
static void apply_options(struct case_ *c, const char *line, mxg_context_desc *limits)
{
    char key[64], value[128];
    int end = 0;
    for (; sscanf(line, " %63[a-z-]=%127s%n", key, value, &end) == 2; line += end) {
        mxg_context_desc ignored = MXG_CONTEXT_DESC_INIT;
        if (set_limit(limits ? limits : &ignored, key, value) || limits)
            continue;
        if (strcmp(key, "target") == 0) {
            snprintf(c->target, sizeof c->target, "%s", value);
        } else if (strcmp(key, "element") == 0) {
            snprintf(c->element, sizeof c->element, "%s", value);
        } else if (strcmp(key, "library") == 0) {
            const char *path = value;
            mxg_library *base = c->library;
            c->no_library =
                !status_is_good(c, mxg_library_load(c->context, base, &path, 1, &c->library));
            collect(c, mxg_library_diagnostics(c->library));
            mxg_library_unref(base);
            read_expectations(c, value);
            for (uint32_t i = 0; i < mxg_library_num_files(c->library); ++i)
                read_expectations(c, mxg_library_file(c->library, i));
        } else if (mxg_options_set(c->options, key, value) != MXG_OK) {
            char reason[256];
            mxg_options_error(c->options, reason, sizeof reason);
            fault(c, reason, NULL);
        }
    }
}

static void start(struct case_ *c)
{
    char *text = read_text(c->name);
    const char *line = strncmp(text, "<!-- mxgen:", 11) == 0 ? text + 11 : "";
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    apply_options(c, line, &desc);
    mxg_context_create(&desc, &c->context);
    mxg_options_create(c->context, &c->options);
    c->library = mxg_library_builtin(c->context);
    apply_options(c, line, NULL);
    free(text);
}

/* ---- The comparison ---- */

static void compare(struct case_ *c)
{
    expect_match(&c->expected, &c->given);
    for (unsigned i = 0; i < c->given.len; ++i)
        if (!c->given.items[i].matched)
            fault(c, "unexpected", &c->given.items[i]);
    for (unsigned i = 0; i < c->expected.messages.len; ++i) {
        const struct message *m = &c->expected.messages.items[i];
        if (!m->matched)
            fault(c, "missing", m);
        for (int id = 0; id < NUM_IDS && m->matched; ++id)
            covered[id] = covered[id] || strcmp(ids[id], m->id) == 0;
    }
}

/* Whether the document gives what it says. */
static bool run_case(const char *name, bool silent)
{
    static struct case_ c; /* large */
    c = (struct case_){.name = name, .silent = silent, .target = "glsl"};
    start(&c);
    if (!c.no_library)
        check_document(&c);
    read_expectations(&c, name);
    for (uint32_t i = 0; i < mxg_document_num_files(c.document); ++i)
        read_expectations(&c, mxg_document_file(c.document, i));
    compare(&c);
    mxg_document_destroy(c.document);
    mxg_options_destroy(c.options);
    mxg_library_unref(c.library);
    mxg_context_destroy(c.context);
    return c.num_faults == 0;
}

/* ---- Coverage ---- */

/* Whether a text mentions an id, as written or as C code does. */
static bool mentions(const char *text, const char *id)
{
    char word[64];
    snprintf(word, sizeof word, "%s", id);
    for (char *c = word; *c; ++c)
        *c = *c == '-' ? '_' : *c;
    return strstr(text, id) || strstr(text, word);
}

/* elsewhere.txt: "id file" per line: a test that mentions the id; or "id - reason". */
static unsigned check_coverage(void)
{
    unsigned faults = 0;
    bool listed[NUM_IDS] = {false};
    char id[64], where[128], line[512];
    FILE *list = fopen("elsewhere.txt", "r");
    while (list && fgets(line, sizeof line, list)) {
        if (line[0] == '#' || sscanf(line, "%63s %127s", id, where) != 2)
            continue;
        for (int i = 0; i < NUM_IDS; ++i)
            listed[i] = listed[i] || strcmp(ids[i], id) == 0;
        char *text = read_text(where);
        if (where[0] != '-' && !mentions(text, id) && ++faults)
            printf("elsewhere.txt: '%s' does not mention %s\n", where, id);
        free(text);
    }
    if (list)
        fclose(list);
    for (int i = 0; i < NUM_IDS; ++i)
        if (covered[i] == listed[i] && ++faults)
            printf("%s: %s\n", ids[i],
                   covered[i] ? "has a document, but is listed in elsewhere.txt"
                              : "no document expects it");
    return faults;
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

int main(int argc, char **argv)
{
    bool must_fail = argc > 2 && strcmp(argv[1], "--must-fail") == 0;
    const char *folder = argv[argc - 1];
    DIR *dir = argc > 1 && chdir(folder) == 0 ? opendir(".") : NULL;
    char *names[512];
    size_t count = 0;
    unsigned passed = 0, failed = 0, parked = 0;
    for (struct dirent *entry; dir && count < 512 && (entry = readdir(dir)) != NULL;) {
        const char *dot = strrchr(entry->d_name, '.');
        if (dot && strcmp(dot, ".mtlx") == 0)
            names[count++] = strdup(entry->d_name);
    }
    if (dir)
        closedir(dir);
    qsort(names, count, sizeof *names, compare_names);
    for (size_t i = 0; i < count; ++i) {
        bool good = names[i][0] == '_' || run_case(names[i], must_fail) != must_fail;
        if (names[i][0] == '_' && ++parked)
            printf("skip: %s is parked\n", names[i]);
        if (!good && must_fail)
            printf("%s: was accepted\n", names[i]);
        *(good ? &passed : &failed) += names[i][0] != '_';
        free(names[i]);
    }
    failed += must_fail ? 0 : check_coverage();
    failed += count == 0;
    printf("diag%s: %u passed, %u failed, %u skipped\n", must_fail ? "-runner" : "", passed, failed,
           parked);
    return failed ? 1 : 0;
}
