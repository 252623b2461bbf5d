// SPDX-License-Identifier: Apache-2.0
/*
 * The api room behind mxgen.h: objects and their memory, structs that begin with their size,
 * options. tests/api looks at the same room from outside.
 */
#include "api/generation.h"

#include "tests/api/fixture.h"

static mxg_context *make_context(struct heap *heap, size_t max_memory)
{
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    mxg_context *context = NULL;
    memset(heap, 0, sizeof *heap);
    desc.realloc = heap_realloc;
    desc.realloc_user_data = heap;
    desc.max_memory = max_memory;
    REQUIRE_EQ(mxg_context_create(&desc, &context), MXG_OK);
    return context;
}

/* Everything was given back, and every block with its size. */
static void destroy_context(mxg_context *context, const struct heap *heap)
{
    mxg_context_destroy(context);
    REQUIRE_EQ(heap->held, 0);
    REQUIRE_EQ(heap->wrong_sizes, 0);
}

/* ---- Structs that begin with their size ---- */

struct known { /* as this version knows it */
    size_t size;
    uint32_t a, b;
};

struct newer {
    struct known known;
    uint32_t c, d;
};

static void test_struct_read(void)
{
    struct known out = {9, 9, 9};
    struct newer in = {{sizeof in.known, 1, 2}, 3, 4};
    REQUIRE(struct_read(&out, sizeof out, &in));
    REQUIRE(out.a == 1 && out.b == 2);
    /* an older caller's is shorter: the rest is 0 */
    in.known.size = offsetof(struct known, b);
    REQUIRE(struct_read(&out, sizeof out, &in));
    REQUIRE(out.a == 1 && out.b == 0);
    /* a newer caller's is longer: fine as long as it sets nothing that is not known here */
    in = (struct newer){{sizeof in, 1, 2}, 0, 0};
    REQUIRE(struct_read(&out, sizeof out, &in));
    REQUIRE(out.a == 1 && out.b == 2);
    in.d = 1;
    REQUIRE(!struct_read(&out, sizeof out, &in));
    /* nothing but a size, or less */
    in.known.size = sizeof in.known.size;
    REQUIRE(!struct_read(&out, sizeof out, &in));
    in.known.size = 0;
    REQUIRE(!struct_read(&out, sizeof out, &in));
}

static void test_struct_write(void)
{
    const struct known from = {sizeof from, 1, 2};
    struct newer out = {{offsetof(struct known, b), 8, 8}, 8, 8};
    REQUIRE_EQ(struct_write(&out, &from, sizeof from), MXG_OK);
    REQUIRE(out.known.size == offsetof(struct known, b) && out.known.a == 1 && out.known.b == 8);
    out.known.size = sizeof out; /* what lies beyond is zero */
    REQUIRE_EQ(struct_write(&out, &from, sizeof from), MXG_OK);
    REQUIRE(out.known.b == 2 && out.c == 0 && out.d == 0 && out.known.size == sizeof out);
    out.known.size = sizeof out.known.size;
    REQUIRE_EQ(struct_write(&out, &from, sizeof from), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(struct_write(NULL, &from, sizeof from), MXG_ERROR_ARGUMENT);
}

/* ---- Objects ---- */

struct thing {
    struct object object;
    int number;
};

/* An object lives as long as one that stands on it. */
static void test_references(void)
{
    struct heap heap;
    mxg_context *context = make_context(&heap, 0);
    size_t empty = heap.held;
    struct thing *below = object_new(context, sizeof *below, NULL);
    size_t with_one = heap.held;
    struct thing *above = object_new(context, sizeof *above, &below->object);
    REQUIRE_EQ(above->number, 0);
    REQUIRE(with_one >= empty + sizeof *below && heap.held >= with_one + sizeof *above);
    object_unref(&below->object); /* held by the one above */
    below->number = 7;
    object_ref(&above->object);
    object_unref(&above->object);
    REQUIRE_EQ(below->number, 7);
    object_unref(&above->object);
    REQUIRE_EQ(heap.held, empty);
    object_unref(NULL);
    destroy_context(context, &heap);
}

static void take(void *arg)
{
    struct thing *thing = arg;
    for (int i = 0; i < 64; i++)
        memset(arena_alloc(&thing->object.arena, 1024), 0, 1024);
    thing->number++;
}

/* The context counts what objects hold, and gives no more than its limit. */
static void test_memory(void)
{
    struct heap heap;
    mxg_context *context = make_context(&heap, 0);
    size_t empty = atomic_load(&context->used);
    struct thing *thing = object_new(context, sizeof *thing, NULL);
    REQUIRE_EQ(object_run(&thing->object, take, thing), MXG_OK);
    REQUIRE_EQ(thing->number, 1);
    REQUIRE_EQ(atomic_load(&context->used), heap.held);
    REQUIRE(heap.held >= empty + 65536);
    size_t limit = empty + (heap.held - empty) * 5 / 2; /* room for two */
    object_unref(&thing->object);
    REQUIRE_EQ(atomic_load(&context->used), empty);
    destroy_context(context, &heap);
    context = make_context(&heap, limit);
    struct thing *things[4];
    static const mxg_status expected[] = {MXG_OK, MXG_OK, MXG_ERROR_MEMORY, MXG_OK};
    for (unsigned i = 0; i < 4; i++) {
        things[i] = object_new(context, sizeof *things[i], NULL);
        REQUIRE_EQ(object_run(&things[i]->object, take, things[i]), expected[i]);
        REQUIRE_EQ(things[i]->number, expected[i] == MXG_OK);
        if (i == 2) { /* makes room for another */
            object_unref(&things[1]->object);
            object_unref(&things[2]->object);
        }
    }
    REQUIRE(heap.peak <= limit);
    object_unref(&things[0]->object);
    object_unref(&things[3]->object);
    destroy_context(context, &heap);
}

static void use_scratch(void *arg, struct arena *scratch)
{
    memset(arena_alloc(scratch, *(size_t *)arg), 1, *(size_t *)arg);
}

static void test_scratch(void)
{
    struct heap heap;
    mxg_context *context = make_context(&heap, 100000);
    size_t little = 5000, much = 200000, before = heap.held;
    REQUIRE_EQ(context_run(context, use_scratch, &little), MXG_OK);
    REQUIRE_EQ(context_run(context, use_scratch, &much), MXG_ERROR_MEMORY);
    REQUIRE_EQ(heap.held, before);
    destroy_context(context, &heap);
}

static unsigned texts_written;

static void write_number(const struct object *object, struct text *out)
{
    texts_written++;
    text_fmt(out, "number %u", (unsigned)((const struct thing *)(const void *)object)->number);
}

/* A text is written once, when it is first asked for. */
static void test_texts(void)
{
    struct heap heap;
    mxg_context *context = make_context(&heap, 0);
    struct thing *thing = object_new(context, sizeof *thing, NULL);
    thing->number = 5;
    const struct made_text *text = object_text(&thing->object, 1, write_number);
    REQUIRE_STR(text->data, "number 5");
    REQUIRE_EQ(text->size, strlen("number 5"));
    thing->number = 6;
    REQUIRE(object_text(&thing->object, 1, write_number) == text);
    REQUIRE_EQ(texts_written, 1);
    REQUIRE_STR(object_text(&thing->object, 0, write_number)->data, "number 6");
    REQUIRE_EQ(atomic_load(&context->used), heap.held);
    object_unref(&thing->object);
    destroy_context(context, &heap);
}

static void test_status(void)
{
    struct heap heap;
    mxg_context *context = make_context(&heap, 0);
    struct thing *thing = object_new(context, sizeof *thing, NULL);
    struct diag_list *list = &thing->object.diagnostics.list;
    REQUIRE_EQ(object_status(&thing->object), MXG_OK);
    diag_add(list, DIAG_ID_unknown_input, (struct diag_place){0}, "a", "b", ""); /* a warning */
    REQUIRE_EQ(object_status(&thing->object), MXG_OK);
    diag_add(list, DIAG_ID_no_matching_nodedef, (struct diag_place){0}, "a", "b", "c");
    REQUIRE_EQ(object_status(&thing->object), MXG_ERROR_DOCUMENT);
    object_unref(&thing->object);
    destroy_context(context, &heap);
}

/* ---- Options ---- */

static const struct {
    const char *key, *value;
    enum option_id id;
    bool good;
    int32_t number; /* afterwards, also where the value is refused */
} settings[] = {
    {"max-lights", "0", OPTION_max_lights, true, 0},
    {"max-lights", "1024", OPTION_max_lights, true, 1024},
    {"max-lights", "1025", OPTION_max_lights, false, 3},
    {"max-lights", "-1", OPTION_max_lights, false, 3},
    {"max-lights", "1x", OPTION_max_lights, false, 3},
    {"max-lights", "", OPTION_max_lights, false, 3},
    {"interface", "complete", OPTION_interface, true, 0},
    {"interface", "reduced", OPTION_interface, true, 2},
    {"interface", "reduce", OPTION_interface, false, 0},
    {"interface", "authored|reduced", OPTION_interface, false, 0},
    {"comments", "false", OPTION_comments, true, 0},
    {"comments", "no", OPTION_comments, false, 1},
    {"comment", "true", OPTION_comments, false, 1},
};

static void test_options(void)
{
    struct heap heap;
    mxg_context *context = make_context(&heap, 0);
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        mxg_options *options = NULL;
        REQUIRE_EQ(mxg_options_create(context, &options), MXG_OK);
        const struct option_value *value = &options_values(options)[settings[i].id];
        REQUIRE(!value->is_set);
        REQUIRE_EQ(mxg_options_set(options, settings[i].key, settings[i].value),
                   settings[i].good ? MXG_OK : MXG_ERROR_ARGUMENT);
        REQUIRE_EQ(value->is_set, settings[i].good);
        REQUIRE_EQ(value->number, settings[i].number);
        REQUIRE_EQ(mxg_options_error(options, NULL, 0) > 0, !settings[i].good);
        mxg_options_destroy(options);
    }
    destroy_context(context, &heap);
}

static void test_option_lists(void)
{
    struct heap heap;
    mxg_context *context = make_context(&heap, 0);
    mxg_options *options = NULL;
    REQUIRE_EQ(mxg_options_create(context, &options), MXG_OK);
    const struct option_value *lights = &options_values(options)[OPTION_lights];
    REQUIRE_EQ(lights->list.len, 3);
    REQUIRE_STR(lights->list.items[0], "directional_light=1");
    /* the first setting takes the default's place, each further one appends */
    REQUIRE_EQ(mxg_options_set(options, "lights", "a=1,,b=2"), MXG_OK);
    REQUIRE_EQ(lights->list.len, 2);
    REQUIRE_EQ(mxg_options_set(options, "lights", "c=3"), MXG_OK);
    REQUIRE_EQ(lights->list.len, 3);
    REQUIRE_STR(lights->list.items[2], "c=3");
    REQUIRE_STR(options_values(options)[OPTION_colorspace].text, "lin_rec709");
    REQUIRE_EQ(mxg_options_set(options, "colorspace", "acescg"), MXG_OK);
    REQUIRE_STR(options_values(options)[OPTION_colorspace].text, "acescg");
    mxg_options_destroy(options);
    destroy_context(context, &heap);
}

/* Every option in the table has a default that is a value of its own. */
static void test_option_table(void)
{
    struct heap heap;
    mxg_context *context = make_context(&heap, 0);
    mxg_options *options = NULL;
    REQUIRE_EQ(mxg_options_create(context, &options), MXG_OK);
    REQUIRE_EQ(mxg_catalogue_num_options(), NUM_OPTIONS);
    for (uint32_t i = 0; i < mxg_catalogue_num_options(); i++) {
        mxg_option option = MXG_INIT(mxg_option);
        REQUIRE_EQ(mxg_catalogue_option(i, &option), MXG_OK);
        if (!REQUIRE_EQ(mxg_options_set(options, option.key, option.initial), MXG_OK))
            printf("    %s\n", option.key);
        REQUIRE(*option.doc);
    }
    mxg_options_destroy(options);
    destroy_context(context, &heap);
}

/* ---- Frames of image sequences ---- */

static void test_frame_files(void)
{
    static const struct {
        const char *file, *range, *end_action;
        int32_t offset, frame;
        const char *expected; /* NULL: there is no image */
    } cases[] = {
        {"a.png", "", "", 0, 5, "a.png"},
        {"a.{frame}.png", "", "", 0, 5, "a.5.png"},
        {"a.{04frame}.png", "", "", 0, 5, "a.0005.png"},
        {"a.{04frame}.png", "", "", 10, 5, "a.0015.png"},
        {"{frame}{02frame}", "", "", 0, -7, "-7-7"},
        {"{frames}{5frame}{", "", "", 0, 1, "{frames}{5frame}{"},
        {"{frame}", "10-12", "constant", 0, 12, "12"},
        {"{frame}", "10-12", "constant", 0, 13, NULL},
        {"{frame}", "10-12", "clamp", 0, 13, "12"},
        {"{frame}", "10-12", "clamp", 0, 3, "10"},
        {"{frame}", "10-12", "periodic", 0, 13, "10"},
        {"{frame}", "10-12", "periodic", 0, 9, "12"},
        {"{frame}", "10-12", "mirror", 0, 13, "11"}, /* 10 11 12 11 10 11 … */
        {"{frame}", "10-12", "mirror", 0, 14, "10"},
        {"{frame}", "10-12", "mirror", 0, 9, "11"},
        {"{frame}", "5-5", "mirror", 0, 100, "5"},
        {"{frame}", "12-10", "clamp", 0, 100, "100"}, /* no range */
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char out[64] = "", small[4] = "";
        struct frame_sequence sequence = {cases[i].range, cases[i].end_action, cases[i].offset};
        size_t size = frame_file(cases[i].file, &sequence, cases[i].frame, out, sizeof out);
        if (!REQUIRE_STR(out, cases[i].expected ? cases[i].expected : ""))
            printf("    case %zu\n", i);
        REQUIRE_EQ(size, cases[i].expected ? strlen(cases[i].expected) : 0);
        /* a buffer that is too small keeps the beginning, and the size is told all the same */
        REQUIRE_EQ(frame_file(cases[i].file, &sequence, cases[i].frame, small, sizeof small), size);
        REQUIRE(strlen(small) <= 3 && strncmp(small, out, strlen(small)) == 0);
        REQUIRE_EQ(frame_file(cases[i].file, &sequence, cases[i].frame, NULL, 0), size);
    }
}

/* ---- Files ---- */

static void test_file_source(void)
{
    static const struct memory_file memory[] = {
        {"a.mtlx", "one"}, {"b.mtlx", "two"}, {"locked.mtlx", NULL}, {NULL, NULL}};
    struct memory_files files = {.files = memory};
    mxg_resolver resolver = memory_resolver(&files);
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    mxg_context *context = NULL;
    desc.resolver = &resolver;
    REQUIRE_EQ(mxg_context_create(&desc, &context), MXG_OK);
    struct thing *thing = object_new(context, sizeof *thing, NULL);
    struct diag_list *diags = &thing->object.diagnostics.list;
    struct file_source source;
    const char *data = NULL;
    size_t size = 0;
    file_source_init(&source, &thing->object);
    source.digest = 1;
    REQUIRE(file_source_read(&source, "a.mtlx", &data, &size, diags));
    REQUIRE(size == 3 && memcmp(data, "one", 3) == 0);
    uint64_t one = source.digest;
    REQUIRE(file_source_read(&source, "b.mtlx", &data, &size, diags));
    REQUIRE(one != 1 && source.digest != one); /* of the bytes of both */
    REQUIRE(file_source_read(&source, "a.mtlx", &data, &size, diags));
    REQUIRE_EQ(source.names.len, 2); /* each once */
    REQUIRE(!file_source_read(&source, "none.mtlx", &data, &size, diags));
    REQUIRE(!file_source_read(&source, "locked.mtlx", &data, &size, diags));
    REQUIRE_STR(diag_id_text(diags->items.items[0].id), "file-missing");
    REQUIRE_STR(diag_id_text(diags->items.items[1].id), "file-unreadable");
    file_source_finish(&source);
    REQUIRE_EQ(files.num_open, 0);
    object_unref(&thing->object);
    mxg_context_destroy(context);
}

int main(void)
{
    test_struct_read();
    test_struct_write();
    test_references();
    test_memory();
    test_scratch();
    test_texts();
    test_status();
    test_options();
    test_option_lists();
    test_option_table();
    test_frame_files();
    test_file_source();
    return test_report("api");
}
