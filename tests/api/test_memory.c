// SPDX-License-Identifier: Apache-2.0
/*
 * Every allocation of a cycle fails once, and memory is limited: a status says so, nothing leaks,
 * and the next cycle works.
 */
#include "documents.h"

static mxg_status use_result(const mxg_result *result)
{
    size_t size = 0;
    char line[256];
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(mxg_result_diagnostics(result)); i++)
        mxg_diagnostics_format(mxg_result_diagnostics(result), i, NULL, 0, false, line,
                               sizeof line);
    return mxg_result_reflection_json(result, &size) ? MXG_OK : MXG_ERROR_MEMORY;
}

static mxg_status generate(mxg_context *context, mxg_library *library, const mxg_options *options)
{
    mxg_document *document = NULL;
    mxg_result *result = NULL, *view = NULL;
    mxg_generate_desc desc = {sizeof desc, "glsl", NULL, options};
    mxg_status status = mxg_document_load(context, library, "main.mtlx", &document);
    if (status == MXG_OK)
        status = mxg_generate(context, document, &desc, &result);
    if (status == MXG_OK)
        status = use_result(result);
    if (status == MXG_OK)
        status = mxg_inspect(context, document, MXG_VIEW_CLOSURES, &desc, &view);
    mxg_result_destroy(view);
    mxg_result_destroy(result);
    mxg_document_destroy(document);
    return status;
}

/* A layer on the built-in library, options, a generation with everything that is made on demand. */
static mxg_status cycle(const mxg_context_desc *desc)
{
    static const char *const paths[] = {"tint.mtlx"};
    mxg_context *context = NULL;
    mxg_library *builtin = NULL, *library = NULL;
    mxg_options *options = NULL;
    mxg_status status = mxg_context_create(desc, &context);
    if (status == MXG_OK)
        status =
            mxg_library_load(context, builtin = mxg_library_builtin(context), paths, 1, &library);
    if (status == MXG_OK && (!mxg_library_xml(library, NULL) || !mxg_library_losses(library)))
        status = MXG_ERROR_MEMORY;
    if (status == MXG_OK)
        status = mxg_options_create(context, &options);
    if (status == MXG_OK)
        status = mxg_options_set(options, "uniform", "S/coat,G/*");
    if (status == MXG_OK)
        status = generate(context, library, options);
    mxg_options_destroy(options);
    mxg_library_unref(library);
    mxg_library_unref(builtin);
    mxg_context_destroy(context);
    return status;
}

static struct memory_files files = {.files = documents};
static mxg_resolver resolver;

static mxg_context_desc counted(struct heap *heap)
{
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    resolver = memory_resolver(&files);
    desc.realloc = heap_realloc;
    desc.realloc_user_data = heap;
    desc.resolver = &resolver;
    return desc;
}

static void require_clean(const struct heap *heap)
{
    REQUIRE_EQ(heap->held, 0);
    REQUIRE_EQ(heap->wrong_sizes, 0);
    REQUIRE_EQ(files.num_opened, files.num_released);
}

static void test_failures(bool fails_from)
{
    mxg_status status = MXG_ERROR_MEMORY;
    unsigned k = 0;
    while (status != MXG_OK && ++k < 5000) {
        struct heap heap = {.fail_at = k, .fails_from = fails_from};
        mxg_context_desc desc = counted(&heap);
        status = cycle(&desc);
        REQUIRE(status == MXG_ERROR_MEMORY || status == MXG_OK);
        if (heap.calls < k)
            REQUIRE_EQ(status, MXG_OK);
        else if (status == MXG_OK && !fails_from) /* what failed was not needed */
            status = MXG_ERROR_MEMORY;
        require_clean(&heap);
    }
    REQUIRE(k > 20 && k < 5000);
}

/* A failure leaves objects as they were: the same context goes on. */
static void test_context_goes_on(void)
{
    struct heap heap = {0};
    mxg_context_desc desc = counted(&heap);
    mxg_context *context = NULL;
    REQUIRE_EQ(mxg_context_create(&desc, &context), MXG_OK);
    static const char *const paths[] = {"tint.mtlx"};
    mxg_library *builtin = mxg_library_builtin(context), *library = NULL;
    REQUIRE_EQ(mxg_library_load(context, builtin, paths, 1, &library), MXG_OK);
    size_t before = heap.held;
    for (unsigned k = 1; k < 30; k++) {
        heap.calls = 0;
        heap.fail_at = k;
        mxg_status status = generate(context, library, NULL);
        REQUIRE(status == MXG_ERROR_MEMORY || (status == MXG_OK && heap.calls < k));
        REQUIRE_EQ(heap.held, before);
        heap.fail_at = 0;
        REQUIRE_EQ(generate(context, library, NULL), MXG_OK);
    }
    mxg_library_unref(library);
    mxg_library_unref(builtin);
    mxg_context_destroy(context);
    require_clean(&heap);
}

/* Whatever the limit, no more is held; what a cycle takes without one is enough. */
static void test_limit(void)
{
    struct heap unlimited = {0};
    mxg_context_desc desc = counted(&unlimited);
    REQUIRE_EQ(cycle(&desc), MXG_OK);
    unsigned refused = 0;
    for (size_t limit = 1000; limit < unlimited.peak; limit += limit / 8) {
        struct heap heap = {0};
        desc = counted(&heap);
        desc.max_memory = limit;
        mxg_status status = cycle(&desc);
        REQUIRE(status == MXG_ERROR_MEMORY || status == MXG_OK);
        REQUIRE(heap.peak <= limit);
        refused += status == MXG_ERROR_MEMORY;
        require_clean(&heap);
    }
    REQUIRE(refused > 10);
    struct heap heap = {0};
    desc = counted(&heap);
    desc.max_memory = unlimited.peak;
    REQUIRE_EQ(cycle(&desc), MXG_OK);
    require_clean(&heap);
}

/*
 * Files that mxgen reads itself count too, and running out of memory while reading one is not a
 * missing file.
 */
static void test_own_files(const char *path)
{
    mxg_status status = MXG_ERROR_MEMORY;
    for (unsigned k = 1; status != MXG_OK && k < 100; k++) {
        struct heap heap = {.fail_at = k};
        mxg_context_desc desc = counted(&heap);
        desc.resolver = NULL;
        mxg_context *context = NULL;
        mxg_document *document = NULL;
        mxg_library *library = NULL;
        status = mxg_context_create(&desc, &context);
        if (status == MXG_OK)
            status =
                mxg_document_load(context, library = mxg_library_builtin(context), path, &document);
        REQUIRE(status == MXG_ERROR_MEMORY || status == MXG_OK);
        mxg_document_destroy(document);
        mxg_library_unref(library);
        mxg_context_destroy(context);
        require_clean(&heap);
    }
    REQUIRE_EQ(status, MXG_OK);
    for (size_t limit = 1000; limit < 200000; limit += limit / 8) {
        struct heap heap = {0};
        mxg_context_desc desc = counted(&heap);
        desc.resolver = NULL;
        desc.max_memory = limit;
        mxg_context *context = NULL;
        mxg_document *document = NULL;
        mxg_library *library = NULL;
        if (mxg_context_create(&desc, &context) == MXG_OK)
            mxg_document_load(context, library = mxg_library_builtin(context), path, &document);
        REQUIRE(heap.peak <= limit);
        mxg_document_destroy(document);
        mxg_library_unref(library);
        mxg_context_destroy(context);
        require_clean(&heap);
    }
}

/* Texts made of the library that is built in go with the context. */
static void test_builtin_text(void)
{
    struct heap heap = {0};
    mxg_context_desc desc = counted(&heap);
    mxg_context *context = NULL;
    REQUIRE_EQ(mxg_context_create(&desc, &context), MXG_OK);
    mxg_library *builtin = mxg_library_builtin(context);
    REQUIRE(mxg_library_xml(builtin, NULL));
    mxg_library_unref(builtin);
    mxg_context_destroy(context);
    require_clean(&heap);
}

/* Packing generates, with memory of its own beside that of what is generated. */
static mxg_status pack(const mxg_context_desc *desc, size_t *out_size)
{
    static const char *const paths[] = {"model.mtlx"};
    mxg_context *context = NULL;
    mxg_library *library = NULL;
    const void *data;
    mxg_status status = mxg_context_create(desc, &context);
    if (status == MXG_OK)
        status = mxg_library_load(context, NULL, paths, 1, &library);
    if (status == MXG_OK)
        status = mxg_library_image(library, &data, out_size);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return status;
}

static void test_pack(void)
{
    struct heap unlimited = {0};
    mxg_context_desc desc = counted(&unlimited);
    size_t whole = 0, size = 0;
    REQUIRE_EQ(pack(&desc, &whole), MXG_OK);
    for (unsigned k = 1; k <= unlimited.calls; k++) {
        struct heap heap = {.fail_at = k};
        desc = counted(&heap);
        mxg_status status = pack(&desc, &size);
        REQUIRE(status == MXG_ERROR_MEMORY || (status == MXG_OK && size == whole));
        require_clean(&heap);
    }
}

/* Formatting messages leaves the count of the context's memory as it was. */
static void test_count_of_messages(void)
{
    static const struct memory_file warned[] = {
        {"main.mtlx", "<materialx><constant name='c' type='float' unknown='1'/>"
                      "<output name='o' type='float' nodename='c'/></materialx>"},
        {NULL, NULL}};
    struct memory_files source = {.files = warned};
    struct heap heap = {0};
    mxg_context_desc desc = counted(&heap);
    desc.max_memory = (size_t)16 << 20;
    mxg_resolver own = memory_resolver(&source);
    desc.resolver = &own;
    mxg_context *context = NULL;
    mxg_document *document = NULL;
    char line[256];
    REQUIRE_EQ(mxg_context_create(&desc, &context), MXG_OK);
    mxg_library *library = mxg_library_builtin(context);
    REQUIRE_EQ(mxg_document_load(context, library, "main.mtlx", &document), MXG_OK);
    const mxg_diagnostics *list = mxg_document_diagnostics(document);
    REQUIRE(mxg_diagnostics_num_items(list) > 0);
    for (int i = 0; i < 10000; i++) /* a few bytes that stay counted fill the limit */
        REQUIRE(mxg_diagnostics_format(list, 0, NULL, 0, false, line, sizeof line) > 0);
    mxg_document_destroy(document);
    REQUIRE_EQ(mxg_document_load(context, library, "main.mtlx", &document), MXG_OK);
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    REQUIRE_EQ(heap.held, 0);
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    test_failures(false);
    test_failures(true);
    test_context_goes_on();
    test_limit();
    test_builtin_text();
    test_count_of_messages();
    test_own_files(argv[1]);
    test_pack();
    return test_report("api-memory");
}
