// SPDX-License-Identifier: Apache-2.0
/* Limits at their boundary, cancelling at every question, and the host's files. */
#include "documents.h"

static mxg_document *parse(mxg_context *context, const char *text, mxg_status expected)
{
    mxg_document *document = NULL;
    mxg_library *library = mxg_library_builtin(context);
    REQUIRE_EQ(mxg_document_parse(context, library, "limit.mtlx", text, strlen(text), &document),
               expected);
    mxg_library_unref(library);
    return document;
}

/* A graph of `count` operations in a row; to be freed. */
static char *chain(unsigned count)
{
    char *text = malloc(256 + 200 * (size_t)count), *at = text;
    at += sprintf(
        at, "<materialx version=\"1.39\"><nodegraph name=\"G\"><time name=\"n0\" type=\"float\"/>");
    for (unsigned i = 1; i <= count; i++)
        at += sprintf(
            at,
            "<%s name=\"n%u\" type=\"float\"><input name=\"in1\" type=\"float\" nodename=\"n%u\"/>"
            "<input name=\"in2\" type=\"float\" value=\"%u.5\"/></%s>",
            i % 2 ? "multiply" : "modulo", i, i - 1, i, i % 2 ? "multiply" : "modulo");
    sprintf(at, "<output name=\"out\" type=\"float\" nodename=\"n%u\"/></nodegraph></materialx>",
            count);
    return text;
}

struct outcome {
    mxg_status status;
    bool is_limited; /* with the diagnostic in question */
    size_t size;     /* of the source */
};

static struct outcome generate(const mxg_context_desc *limits, const char *text, const char *id)
{
    struct outcome out = {0};
    mxg_context *context = NULL;
    REQUIRE_EQ(mxg_context_create(limits, &context), MXG_OK);
    mxg_document *document = parse(context, text, MXG_OK);
    mxg_generate_desc desc = {sizeof desc, "glsl", NULL, NULL};
    mxg_result *result = NULL;
    out.status = mxg_generate(context, document, &desc, &result);
    out.is_limited = has_diagnostic(mxg_result_diagnostics(result), id);
    const char *source = mxg_result_source(result, MXG_STAGE_PIXEL, &out.size);
    REQUIRE((source != NULL) == (out.status == MXG_OK));
    mxg_result_destroy(result);
    mxg_document_destroy(document);
    mxg_context_destroy(context);
    return out;
}

static void test_max_nodes(void)
{
    char *text = chain(50);
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    size_t size = generate(&desc, text, "node-limit").size;
    REQUIRE(size > 0);
    struct outcome outcome = {MXG_ERROR_DOCUMENT, true, 0};
    for (desc.max_nodes = 1; desc.max_nodes < 1000 && outcome.status != MXG_OK; desc.max_nodes++) {
        outcome = generate(&desc, text, "node-limit");
        REQUIRE(outcome.status == MXG_OK
                || (outcome.status == MXG_ERROR_DOCUMENT && outcome.is_limited));
    }
    REQUIRE_EQ(outcome.size, size);
    REQUIRE(desc.max_nodes > 50 && desc.max_nodes < 1000);
    free(text);
}

/* A call that only tells diagnostics knows of the limit, although it does less. */
static void test_max_nodes_of_diagnostics(void)
{
    static const char text[] = "<materialx version=\"1.39\"><standard_surface name=\"S\" "
                               "type=\"surfaceshader\"/></materialx>";
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    bool was_limited = false, was_made = false;
    for (desc.max_nodes = 100; desc.max_nodes < 3000; desc.max_nodes += 100) {
        mxg_context *context = NULL;
        REQUIRE_EQ(mxg_context_create(&desc, &context), MXG_OK);
        mxg_document *document = parse(context, text, MXG_OK);
        mxg_generate_desc job = MXG_GENERATE_DESC_INIT;
        job.target = "glsl";
        mxg_result *whole = NULL, *told = NULL;
        mxg_status status = mxg_generate(context, document, &job, &whole);
        job.only_diagnostics = true;
        REQUIRE_EQ(mxg_generate(context, document, &job, &told), status);
        was_limited |= status != MXG_OK;
        was_made |= status == MXG_OK;
        mxg_result_destroy(whole);
        mxg_result_destroy(told);
        mxg_document_destroy(document);
        mxg_context_destroy(context);
    }
    REQUIRE(was_limited && was_made);
}

static void test_max_elements(void)
{
    /* the root, a graph, 51 nodes with two inputs each but the first, an output */
    char *text = chain(50);
    uint32_t count = 1 + 1 + 1 + 3 * 50 + 1;
    for (uint32_t limit = count - 1; limit <= count; limit++) {
        mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
        desc.max_elements = limit;
        mxg_context *context = NULL;
        mxg_context_create(&desc, &context);
        mxg_document *document = parse(context, text, limit < count ? MXG_ERROR_DOCUMENT : MXG_OK);
        REQUIRE_EQ(has_diagnostic(mxg_document_diagnostics(document), "too-many-elements"),
                   limit < count);
        mxg_document_destroy(document);
        mxg_context_destroy(context);
    }
    free(text);
}

/* The limit is in MiB: one graph is just below, one just above. */
static void test_max_output(void)
{
    enum { MIB = 1 << 20 };
    char *short_text = chain(1000), *long_text = chain(2000);
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    size_t size = generate(&desc, short_text, "output-limit").size;
    size_t per_node = (generate(&desc, long_text, "output-limit").size - size) / 1000;
    free(short_text);
    free(long_text);
    unsigned nodes = (unsigned)(MIB / per_node);
    short_text = chain(nodes - nodes / 4);
    long_text = chain(nodes + nodes / 4);
    size = generate(&desc, short_text, "output-limit").size;
    REQUIRE(size < MIB && generate(&desc, long_text, "output-limit").size > MIB);
    desc.max_output_mib = 1;
    REQUIRE_EQ(generate(&desc, short_text, "output-limit").size, size);
    struct outcome refused = generate(&desc, long_text, "output-limit");
    REQUIRE(refused.status == MXG_ERROR_DOCUMENT && refused.is_limited);
    desc.max_output_mib = 2;
    REQUIRE_EQ(generate(&desc, long_text, "output-limit").status, MXG_OK);
    free(short_text);
    free(long_text);
}

/* A file of exactly the limit is good; one byte more is not. */
static void test_max_file(void)
{
    static const char document[] = "<materialx version=\"1.39\"/>";
    enum { MIB = 1 << 20 };
    char *text = malloc(MIB + 2);
    memset(text, ' ', MIB + 1);
    memcpy(text, document, strlen(document));
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.max_file_mib = 1;
    mxg_context *context = NULL;
    mxg_context_create(&desc, &context);
    for (int more = 0; more < 2; more++) {
        text[MIB + more] = '\0';
        text[MIB + more - 1] = '\n';
        mxg_document *read = parse(context, text, more ? MXG_ERROR_DOCUMENT : MXG_OK);
        REQUIRE_EQ(has_diagnostic(mxg_document_diagnostics(read), "file-too-large"), more);
        mxg_document_destroy(read);
        text[MIB] = ' ';
    }
    mxg_context_destroy(context);
    free(text);
}

static void test_max_errors(void)
{
    char text[2048] = "<materialx version=\"1.39\">";
    for (int i = 0; i < 10; i++)
        sprintf(text + strlen(text), "<unheard_of name=\"n%d\" type=\"float\"/>", i);
    strcat(text, "</materialx>");
    for (uint32_t limit = 9; limit <= 10; limit++) {
        mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
        desc.max_errors = limit;
        mxg_context *context = NULL;
        mxg_context_create(&desc, &context);
        mxg_document *document = parse(context, text, MXG_OK);
        mxg_result *result = NULL;
        REQUIRE_EQ(mxg_validate(context, document, &result), MXG_ERROR_DOCUMENT);
        const mxg_diagnostics *list = mxg_result_diagnostics(result);
        REQUIRE_EQ(mxg_diagnostics_num_errors(list), 10);
        REQUIRE_EQ(mxg_diagnostics_num_items(list), 10); /* nine and a note, or ten */
        REQUIRE_EQ(has_diagnostic(list, "too-many-errors"), limit < 10);
        mxg_result_destroy(result);
        mxg_document_destroy(document);
        mxg_context_destroy(context);
    }
}

/* ---- Cancelling ---- */

static bool count_down(void *user_data)
{
    unsigned *left = user_data;
    return *left && --*left == 0;
}

static void test_cancel(void)
{
    unsigned left = 0, questions = 0;
    struct memory_files files = {.files = documents};
    mxg_resolver resolver = memory_resolver(&files);
    mxg_context_desc limits = MXG_CONTEXT_DESC_INIT;
    limits.resolver = &resolver;
    limits.cancel = count_down;
    limits.cancel_user_data = &left;
    mxg_context *context = NULL;
    mxg_context_create(&limits, &context);
    mxg_library *library = mxg_library_builtin(context);
    mxg_document *document = NULL;
    REQUIRE_EQ(mxg_document_load(context, library, "main.mtlx", &document), MXG_OK);
    mxg_generate_desc desc = {sizeof desc, "glsl", NULL, NULL};
    mxg_status status = MXG_ERROR_CANCELLED;
    while (status != MXG_OK && questions < 10000) {
        left = ++questions;
        mxg_result *result = NULL;
        status = mxg_generate(context, document, &desc, &result);
        REQUIRE(result && (status == MXG_OK || status == MXG_ERROR_CANCELLED));
        REQUIRE_EQ(mxg_result_source(result, MXG_STAGE_PIXEL, NULL) != NULL, status == MXG_OK);
        mxg_result_destroy(result);
    }
    REQUIRE(questions > 3 && questions < 10000);
    left = 1;
    mxg_result *result = NULL;
    REQUIRE_EQ(mxg_inspect(context, document, MXG_VIEW_STATISTICS, &desc, &result),
               MXG_ERROR_CANCELLED);
    mxg_result_destroy(result);
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
}

/* ---- Files ---- */

static void load(struct memory_files *files, const char *name, const char *fault)
{
    mxg_resolver resolver = memory_resolver(files);
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.resolver = &resolver;
    mxg_context *context = NULL;
    mxg_document *document = NULL;
    mxg_result *result = NULL;
    mxg_context_create(&desc, &context);
    mxg_library *library = mxg_library_builtin(context);
    mxg_status status = mxg_document_load(context, library, name, &document);
    if (status == MXG_OK)
        status = mxg_validate(context, document, &result);
    REQUIRE_EQ(status, fault ? MXG_ERROR_DOCUMENT : MXG_OK);
    REQUIRE(!fault || has_diagnostic(mxg_document_diagnostics(document), fault)
            || has_diagnostic(mxg_result_diagnostics(result), fault));
    REQUIRE_EQ(files->num_open, 0);
    REQUIRE_EQ(files->num_opened, files->num_released);
    mxg_result_destroy(result);
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
}

static void test_files(void)
{
    static const char *const faults[] = {"file-missing", "include-missing", "missing-source-file",
                                         "missing-source-file", NULL};
    struct memory_files files = {.files = documents};
    for (unsigned i = 0; i < 5; i++) { /* main.mtlx, tint.mtlx, tint.glsl, curve.glsl, none */
        files.fail_at = i + 1;
        load(&files, "main.mtlx", faults[i]);
    }
    REQUIRE_EQ(files.num_opened, 0 + 1 + 2 + 3 + 4);
    static const struct memory_file locked[] = {{"locked.mtlx", NULL}, {NULL, NULL}};
    files = (struct memory_files){.files = locked};
    load(&files, "locked.mtlx", "file-unreadable");
    load(&files, "other.mtlx", "file-missing");
}

/* ---- Files of a size that no memory has: who reads a byte of one crashes ---- */

struct endless_files {
    struct memory_files files;
    const char *endless; /* the name of the file that is one */
};

static bool endless_open(void *user_data, const char *from, const char *ref, mxg_blob *out_blob,
                         const char **out_reason)
{
    struct endless_files *files = user_data;
    if (!memory_open(&files->files, from, ref, out_blob, out_reason))
        return false;
    if (strcmp(out_blob->name, files->endless) == 0) {
        out_blob->data = (const char *)(uintptr_t)64; /* no page of it can be read */
        out_blob->size = (size_t)1 << (sizeof(size_t) * 8 - 4);
    }
    return true;
}

static void endless_release(void *user_data, mxg_blob *blob)
{
    memory_release(&((struct endless_files *)user_data)->files, blob);
}

/* The limit counts before a byte is hashed, copied or parsed, of documents and of libraries. */
static void test_endless_files(void)
{
    static const char *const names[] = {"main.mtlx", "tint.mtlx", "tint.glsl", "curve.glsl"};
    for (unsigned i = 0; i < 2 * sizeof names / sizeof *names; i++) {
        struct endless_files files = {{.files = documents}, names[i / 2]};
        mxg_resolver resolver = {&files, endless_open, endless_release, NULL};
        bool is_library = i % 2, is_source = i / 2 >= 2; /* which breaks its implementation alone */
        const char *fault = !is_source   ? "file-too-large"
                            : is_library ? "broken-implementation"
                                         : "missing-source-file";
        mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
        desc.resolver = &resolver;
        mxg_context *context = NULL;
        mxg_context_create(&desc, &context);
        mxg_library *base = mxg_library_builtin(context), *library = NULL;
        mxg_document *document = NULL;
        mxg_status status = is_library ? mxg_library_load(context, base, names, 1, &library)
                                       : mxg_document_load(context, base, *names, &document);
        mxg_result *result = NULL;
        if (document && status == MXG_OK)
            status = mxg_validate(context, document, &result);
        REQUIRE_EQ(status, is_source && is_library ? MXG_OK : MXG_ERROR_DOCUMENT);
        REQUIRE(has_diagnostic(is_library ? mxg_library_diagnostics(library)
                                          : mxg_document_diagnostics(document),
                               fault)
                || has_diagnostic(mxg_result_diagnostics(result), fault));
        REQUIRE_EQ(files.files.num_opened, files.files.num_released);
        mxg_result_destroy(result);
        mxg_document_destroy(document);
        mxg_library_unref(library);
        mxg_library_unref(base);
        mxg_context_destroy(context);
    }
}

/* The resolver that a context without one has. */
static void test_own_resolver(const char *folder)
{
    mxg_context *context = NULL;
    mxg_context_create(NULL, &context);
    mxg_library *library = mxg_library_builtin(context);
    mxg_document *document = NULL;
    REQUIRE_EQ(mxg_document_load(context, library, folder, &document), MXG_ERROR_DOCUMENT);
    REQUIRE(has_diagnostic(mxg_document_diagnostics(document), "file-unreadable"));
    mxg_document_destroy(document);
    REQUIRE_EQ(mxg_document_load(context, library, "none/at/all.mtlx", &document),
               MXG_ERROR_DOCUMENT);
    REQUIRE(has_diagnostic(mxg_document_diagnostics(document), "file-missing"));
    mxg_document_destroy(document);
    char path[4096];
    snprintf(path, sizeof path, "%s/nested/main.mtlx", folder); /* includes "./../part.mtlx" */
    REQUIRE_EQ(mxg_document_load(context, library, path, &document), MXG_OK);
    REQUIRE_EQ(mxg_document_num_files(document), 2);
    snprintf(path, sizeof path, "%s/part.mtlx", folder);
    REQUIRE_STR(mxg_document_file(document, 1), path);
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    test_max_nodes();
    test_max_nodes_of_diagnostics();
    test_max_elements();
    test_max_output();
    test_max_file();
    test_max_errors();
    test_cancel();
    test_files();
    test_endless_files();
    test_own_resolver(argv[1]);
    return test_report("api-limits");
}
