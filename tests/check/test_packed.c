// SPDX-License-Identifier: Apache-2.0
/*
 * A record that goes from a worker to `mxgen check` arrives as it was; bytes that are no record are
 * none, whatever they are.
 */
#define _POSIX_C_SOURCE 200809L
#include "check/packed.h"
#include "unit/test.h"

#include <stdlib.h>

static struct check_document *make_document(void)
{
    static struct check_message messages[] = {
        {MXG_SEVERITY_WARNING, "unused-node", "nobody uses 'a'", "a.mtlx", 4, 7, 2, "", NULL,
         "a.mtlx:4:7: warning: …\n"},
        {MXG_SEVERITY_ERROR, "bad-value", "'x' is no number", "a.mtlx", 5, 1, 0, "M", "glsl", NULL},
    };
    static struct check_part parts[] = {{MEASURE_TEXTURES, "wood", 1},
                                        {MEASURE_UNIFORM_BYTES, "", 1ull << 40}};
    static uint32_t indices[] = {1, 0};
    static struct check_shader shaders[] = {{"glsl",
                                             CHECK_COMPILE,
                                             true,
                                             "0123456789abcdef",
                                             {1, 2, 3},
                                             parts,
                                             2,
                                             indices,
                                             2,
                                             0.5,
                                             12.25},
                                            {.target = "osl"}};
    static struct check_element elements[] = {{"M", "material", shaders, 2, "cGljdHVyZQ==", "1,2"},
                                              {.path = "N"}};
    static const char *files[] = {"a.mtlx", "b.mtlx"}, *folders[] = {"./"}, *images[] = {"c.png"};
    static struct check_document document = {.file = "a.mtlx",
                                             .failed = CHECK_COMPILE,
                                             .messages = messages,
                                             .num_messages = 2,
                                             .files = files,
                                             .num_files = 2,
                                             .folders = folders,
                                             .num_folders = 1,
                                             .images = images,
                                             .num_images = 1,
                                             .elements = elements,
                                             .num_elements = 2,
                                             .load_ms = 1.0};
    return &document;
}

static char *json_of(const struct check_document *document)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    check_write_document(out, document, true);
    fclose(out);
    return text;
}

static void test_arrives(void)
{
    struct store store = {0};
    struct packed packed = {0};
    check_pack_document(&packed, &store, make_document());
    check_pack_document(&packed, &store, make_document()); /* in place of the first */
    struct check_document *read = check_unpack_document(&store, packed.bytes, packed.size);
    REQUIRE(read != NULL);
    char *before = json_of(make_document()), *after = read ? json_of(read) : NULL;
    REQUIRE_STR(after, before);
    REQUIRE_STR(read ? read->messages[1].rendered : NULL, "");
    free(before);
    free(after);
    free(packed.bytes);
    store_finish(&store);
}

static void test_no_utf8(void)
{
    struct store store = {0};
    struct packed packed = {0};
    check_pack_document(&packed, &store, &(struct check_document){.file = "a\xff\xc3\xa4.mtlx"});
    const struct check_document *read = check_unpack_document(&store, packed.bytes, packed.size);
    REQUIRE_STR(read ? read->file : NULL, "a\xef\xbf\xbd\xc3\xa4.mtlx");
    free(packed.bytes);
    store_finish(&store);
}

static void test_no_record(void)
{
    struct store store = {0};
    struct packed packed = {0};
    check_pack_document(&packed, &store, make_document());
    char *bytes = packed.bytes;
    size_t size = packed.size;
    for (size_t len = 0; len < size; ++len)
        REQUIRE(!check_unpack_document(&store, bytes, len));
    /* any byte another: a record or none, and nothing beyond the bytes is read */
    for (size_t at = 0; at < size; ++at) {
        char was = bytes[at];
        bytes[at] = (char)~was;
        struct check_document *read = check_unpack_document(&store, bytes, size);
        free(read ? json_of(read) : NULL);
        bytes[at] = was;
    }
    free(bytes);
    store_finish(&store);
}

int main(void)
{
    test_arrives();
    test_no_utf8();
    test_no_record();
    return test_report("packed");
}
