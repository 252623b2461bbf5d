// SPDX-License-Identifier: Apache-2.0
/*
 * A record that is written as JSON and read again is as it was; what is no record is none, whatever
 * it is.
 */
#define _POSIX_C_SOURCE 200809L
#include "program/json_values.h"
#include "check/record_json.h"
#include "unit/test.h"

#include <stdlib.h>

static struct check_document *make_document(void)
{
    static struct check_note notes[] = {{"defined here", "b.mtlx", 1, 2, 3},
                                        {"and so on", "", 0, 0, 0}};
    static struct check_message messages[] = {
        {MXG_SEVERITY_WARNING, "unused-node", "nobody uses 'a'", "a.mtlx", 4, 7, 2, "", NULL,
         "a.mtlx:4:7: warning: …\n", notes, 2, "new"},
        {MXG_SEVERITY_ERROR, "bad-value", "'x' is no number", "a.mtlx", 5, 1, 0, "M", "glsl", NULL,
         NULL, 0, ""},
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
    static struct check_setting values[] = {{"SR/base", "0.5"}, {"SR/empty", ""}},
                                textures[] = {{"I/file", "wood.png"}};
    static struct check_step steps[] = {{"one slab", 3, 2, 40, 28, "0.2", "0.44"}};
    static struct check_element elements[] = {{.path = "M",
                                               .type = "material",
                                               .shaders = shaders,
                                               .num_shaders = 2,
                                               .values = values,
                                               .num_values = 2,
                                               .textures = textures,
                                               .num_textures = 1,
                                               .picture = "cGljdHVyZQ==",
                                               .signature = "1,2",
                                               .slabs = "PHN2Zy8+",
                                               .full = "ZnVsbA==",
                                               .drawn_error = "1.35",
                                               .steps = steps,
                                               .num_steps = 1},
                                              {.path = "N"}};
    static const char *files[] = {"a.mtlx", "b.mtlx"}, *folders[] = {"./"}, *images[] = {"c.png"};
    static struct check_document document = {.file = "../a.mtlx",
                                             .name = "a.mtlx",
                                             .num_hidden = 7,
                                             .gone_messages = messages,
                                             .num_gone_messages = 1,
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

static char *text_of(const struct check_document *document, bool with_times)
{
    json_t *json = record_to_json(document, with_times);
    char *text = json_dumps(json, JSON_STYLE);
    json_decref(json);
    return text;
}

static void test_arrives(void)
{
    struct store store = {0};
    char *before = text_of(make_document(), true);
    struct check_document *document = record_from_text(&store, before, strlen(before));
    REQUIRE(document != NULL);
    char *after = document ? text_of(document, true) : NULL;
    REQUIRE_STR(after, before);
    REQUIRE_STR(document ? document->messages[1].rendered : NULL, "");
    REQUIRE_EQ(document ? document->elements[0].shaders[0].parts[1].count : 0, 1ull << 40);
    free(before);
    free(after);
    store_finish(&store);
}

static void test_times(void)
{
    char *text = text_of(make_document(), false);
    REQUIRE(!strstr(text, "Ms"));
    free(text);
    text = text_of(make_document(), true);
    REQUIRE(strstr(text, "\"compileMs\":12.25") != NULL);
    free(text);
}

static void test_no_utf8(void)
{
    struct store store = {0};
    struct check_part part = {MEASURE_TEXTURES, "\x80", 1};
    struct check_shader shader = {.target = "glsl", .parts = &part, .num_parts = 1};
    struct check_element element = {.path = "M", .shaders = &shader, .num_shaders = 1};
    char *text = text_of(&(struct check_document){.file = "a\xff\xc3\xa4.mtlx",
                                                  .elements = &element,
                                                  .num_elements = 1},
                         true);
    const struct check_document *document = record_from_text(&store, text, strlen(text));
    REQUIRE_STR(document ? document->file : NULL, "a\xef\xbf\xbd\xc3\xa4.mtlx");
    REQUIRE_STR(document ? document->elements[0].shaders[0].parts[0].name : NULL, "\xef\xbf\xbd");
    free(text);
    store_finish(&store);
}

/* A member of another kind, or with a word that it cannot have, leaves no record. */
static void test_damaged_members(void)
{
    static const char *const members[] = {
        "",
        "\"status\":\"faild\"",
        "\"status\":\"failed\"",
        "\"status\":\"failed\",\"failure\":\"?\"",
        "\"status\":\"passed\",\"failure\":\"load\"",
        "\"status\":\"passed\",\"files\":{}",
        "\"status\":\"passed\",\"name\":7",
        "\"status\":\"passed\",\"loadMs\":\"1\"",
        "\"status\":\"passed\",\"messages\":[1]",
        "\"status\":\"passed\",\"messages\":[{\"line\":5000000000}]",
        "\"status\":\"passed\",\"messages\":[{\"line\":-1}]",
        "\"status\":\"passed\",\"messages\":[{\"severity\":\"eror\"}]",
        "\"status\":\"passed\",\"elements\":[{\"shaders\":[{}]}]",
        "\"status\":\"passed\",\"elements\":[{\"values\":{\"a\":1}}]",
        "\"status\":\"passed\",\"elements\":[{\"shaders\":[{\"status\":\"passed\",\"messages\":[0]}"
        "]}]",
        "\"status\":\"passed\",\"elements\":[{\"shaders\":[{\"status\":\"passed\",\"closures\":1e3}"
        "]}]",
    };
    static const char good[] = "{\"file\":\"a\",\"status\":\"passed\",\"elements\":[{\"shaders\":[{"
                               "\"status\":\"passed\"}]}]}";
    struct store store = {0};
    REQUIRE(record_from_text(&store, good, sizeof good - 1) != NULL);
    for (size_t i = 0; i < sizeof members / sizeof *members; ++i) {
        char text[256];
        int len =
            snprintf(text, sizeof text, "{\"file\":\"a\"%s%s}", *members[i] ? "," : "", members[i]);
        REQUIRE(!record_from_text(&store, text, (size_t)len));
    }
    store_finish(&store);
}

static void test_no_record(void)
{
    static const char *const none[] = {"[]", "{}", "{\"file\":1}", "{\"file\":\"\"}", "1"};
    struct store store = {0};
    for (size_t i = 0; i < sizeof none / sizeof *none; ++i)
        REQUIRE(!record_from_text(&store, none[i], strlen(none[i])));
    char *text = text_of(make_document(), true);
    for (size_t size = strlen(text), len = 0; len < size; ++len)
        REQUIRE(!record_from_text(&store, text, len));
    /* any byte another: a record or none, and nothing beyond the text is read */
    for (char *at = text; *at; ++at) {
        char was = *at;
        *at = (char)~was;
        struct check_document *document = record_from_text(&store, text, strlen(text));
        free(document ? text_of(document, true) : NULL);
        *at = was;
    }
    free(text);
    store_finish(&store);
}

int main(void)
{
    test_arrives();
    test_times();
    test_no_utf8();
    test_damaged_members();
    test_no_record();
    return test_report("record");
}
