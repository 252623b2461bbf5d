// SPDX-License-Identifier: Apache-2.0
/*
 * The rules of docs/slots.md, each with its counter-case: looks, the primitives of a scene, and the
 * rows of the table that must come of them.
 */
#define _POSIX_C_SOURCE 200809L
#include "fixture.h"

#include <stdlib.h>

static const char prelude[] =
    "<materialx version='1.39'>"
    "<surface name='s' type='surfaceshader'/><displacement name='d' type='displacementshader'/>"
    "<volume name='v' type='volumeshader'/>"
    "<surfacematerial name='A' type='material'>"
    "  <input name='surfaceshader' type='surfaceshader' nodename='s'/></surfacematerial>"
    "<surfacematerial name='B' type='material'>"
    "  <input name='surfaceshader' type='surfaceshader' nodename='s'/></surfacematerial>"
    "<surfacematerial name='D' type='material'>"
    "  <input name='displacementshader' type='displacementshader' nodename='d'/></surfacematerial>"
    "<surfacematerial name='AD' type='material'>"
    "  <input name='surfaceshader' type='surfaceshader' nodename='s'/>"
    "  <input name='displacementshader' type='displacementshader' nodename='d'/></surfacematerial>"
    "<surfacematerial name='Back' type='material'>"
    "  <input name='backsurfaceshader' type='surfaceshader' nodename='s'/></surfacematerial>"
    "<volumematerial name='Fog' type='material'>"
    "  <input name='volumeshader' type='volumeshader' nodename='v'/></volumematerial>"
    "<nodegraph name='NG'><constant name='c' type='float'/>"
    "  <output name='opacity' type='float' nodename='c'/></nodegraph>"
    "<nodegraph name='NG2'><constant name='c' type='float'/>"
    "  <output name='opacity' type='float' nodename='c'/></nodegraph>";

/* Materials, names and places of an assignment, short. */
#define M(slot, material, geom) \
    "<materialassign slot='" slot "' material='" material "' geom='" geom "'/>"
#define C(slot, material, collection) \
    "<materialassign slot='" slot "' material='" material "' collection='" collection "'/>"
#define G(slot, graph, geom) \
    "<materialassign slot='" slot "' nodegraph='" graph "' geom='" geom "'/>"
#define MORE(slot, material, geom) \
    "<materialassign slot='" slot "' material='" material "' geom='" geom "' exclusive='false'/>"
#define LOOK(...) "<look name='L'>" __VA_ARGS__ "</look>"

static const struct rule {
    const char *what;
    const char *looks;
    const char *paths;    /* with blanks between them */
    const char *rows;     /* of some paths: "/a [000 A]\n"; NULL: an error */
    const char *messages; /* ids, with blanks between them */
} rules[] = {
#include "rules.def"
};

static mxg_document *parse_rule(mxg_context *context, const struct rule *rule)
{
    size_t size = strlen(prelude) + strlen(rule->looks) + 32;
    char *text = malloc(size);
    snprintf(text, size, "%s%s</materialx>", prelude, rule->looks);
    mxg_document *document = parse_builtin(context, text);
    free(text);
    return document;
}

static mxg_scene *make_scene(mxg_context *context, const char *paths, bool reverse)
{
    mxg_scene *scene = NULL;
    char *copy = strdup(paths), *list[64];
    size_t num = 0;
    mxg_scene_create(context, &scene);
    for (char *path = strtok(copy, " "); path; path = strtok(NULL, " "))
        list[num++] = path;
    for (size_t i = 0; i < num; i++) {
        const char *path = list[reverse ? num - 1 - i : i];
        REQUIRE(mxg_scene_add_paths(scene, &path, 1) == MXG_OK);
    }
    free(copy);
    return scene;
}

static void check_messages(const struct rule *rule, const mxg_diagnostics *list)
{
    char given[512] = "";
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); i++) {
        mxg_diagnostic d = {sizeof d};
        mxg_diagnostics_item(list, i, &d);
        snprintf(given + strlen(given), sizeof given - strlen(given), "%s%s", *given ? " " : "",
                 d.id);
    }
    if (!REQUIRE_STR(given, rule->messages))
        printf("    of: %s\n", rule->what);
}

/* Behind the cells at the end of a row that say what is removed or asleep, of which rules are
 * silent. */
static const char *skip_idle(const char *at)
{
    for (const char *close; *at == ' ' && (close = strpbrk(at, "])\n")) != NULL; at = close + 1)
        if ((size_t)(close - at) < strlen("removed")
            || (memcmp(close - strlen("removed"), "removed", strlen("removed")) != 0
                && memcmp(close - strlen("asleep"), "asleep", strlen("asleep")) != 0))
            break;
    return at;
}

/* True if the table has the row; runs of blanks count as one. */
static bool has_row(const char *table, const char *row, size_t len)
{
    while (table && *table) {
        const char *at = table;
        size_t i = 0;
        for (; i < len && *at != '\n'; i++, at++) {
            if (*at != row[i])
                break;
            while (*at == ' ' && at[1] == ' ')
                at++;
        }
        if (i == len && *skip_idle(at) == '\n')
            return true;
        table = strchr(table, '\n');
        table += table != NULL;
    }
    return false;
}

static void check_rows(const struct rule *rule, const mxg_bindings *bindings)
{
    char *table = NULL;
    REQUIRE(mxg_bindings_write(bindings, MXG_BINDINGS_TABLE, append, &table) == MXG_OK);
    for (const char *row = rule->rows; *row;) {
        size_t len = strcspn(row, "\n");
        if (!REQUIRE(has_row(table, row, len)))
            printf("    %s: expected '%.*s' in\n%s", rule->what, (int)len, row, table);
        row += len + (row[len] == '\n');
    }
    free(table);
}

static void check_rule(mxg_context *context, const struct rule *rule, bool reverse)
{
    mxg_document *document = parse_rule(context, rule);
    mxg_scene *scene = make_scene(context, rule->paths, reverse);
    mxg_bindings_desc desc = MXG_BINDINGS_DESC_INIT;
    mxg_bindings *bindings = NULL;
    desc.look = strstr(rule->looks, "name='Child'") ? "Child" : "L";
    mxg_status status = mxg_bindings_create(context, document, scene, &desc, &bindings);
    if (!REQUIRE_EQ(status, rule->rows ? MXG_OK : MXG_ERROR_DOCUMENT))
        printf("    of: %s\n", rule->what);
    check_messages(rule, mxg_bindings_diagnostics(bindings));
    if (rule->rows)
        check_rows(rule, bindings);
    mxg_bindings_destroy(bindings);
    mxg_scene_destroy(scene);
    mxg_document_destroy(document);
}

static void test_names(void)
{
    static const struct {
        const char *name, *encoded;
    } names[] = {
        {"050::010", "_050:_:_010"},
        {"000|010::010", "_000:over:_010:_:_010"},
        {"000|010", "_000:over:_010"},
        {"over", "_over"},
        {"over::full", "_over:_:_full"},
        {"_", "__"},
        {"_::_", "__:_:__"},
    };
    char buffer[64], small[5];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        REQUIRE_EQ(mxg_slot_encode(names[i].name, buffer, sizeof buffer), strlen(names[i].encoded));
        REQUIRE_STR(buffer, names[i].encoded);
        REQUIRE_EQ(mxg_slot_decode(names[i].encoded, buffer, sizeof buffer), strlen(names[i].name));
        REQUIRE_STR(buffer, names[i].name);
    }
    REQUIRE_EQ(mxg_slot_encode("050::010", small, sizeof small), 11);
    REQUIRE_STR(small, "_050");
    static const char *const bad[] = {"",       "a b",     "a:b", "a::", "|a",  "a|", "a|b|c",
                                      "a::b|c", "a::b::c", "ä",   ":a",  "a-b", " a"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        REQUIRE_EQ(mxg_slot_encode(bad[i], buffer, sizeof buffer), 0);
    static const char *const bad_codes[] = {"",    "050",        "_050:_",        "_050:_010",
                                            "_",   "_050:over:", "_050:_:010",    "_a:_:_b:over:_c",
                                            "_a:", "_050:full",  "_050:over:_a:_"};
    for (size_t i = 0; i < sizeof bad_codes / sizeof *bad_codes; i++)
        REQUIRE_EQ(mxg_slot_decode(bad_codes[i], buffer, sizeof buffer), 0);
}

/* The queries say of a layer what the table says. */
static void test_queries(mxg_context *context)
{
    const struct rule rule = {
        "queries", LOOK(M("000", "A", "/a") M("000|010", "B", "/a/b") G("000::x", "NG", "/")),
        "/a/b /a/c", "", ""};
    mxg_document *document = parse_rule(context, &rule);
    mxg_scene *scene = make_scene(context, rule.paths, false);
    mxg_bindings *bindings = NULL;
    REQUIRE_EQ(mxg_bindings_create(context, document, scene, NULL, &bindings), MXG_OK);
    uint32_t a = mxg_scene_find_primitive(scene, "/a"), b = mxg_scene_find_primitive(scene, "/a/b"),
             c = mxg_scene_find_primitive(scene, "/a/c");
    REQUIRE_EQ(mxg_bindings_num_layers(bindings, b), 3);
    mxg_layer layer = {sizeof layer};
    REQUIRE_EQ(mxg_bindings_layer(bindings, b, 0, &layer), MXG_OK);
    REQUIRE_STR(layer.slot, "000");
    REQUIRE_STR(layer.material, "A");
    REQUIRE_EQ(layer.from, a);
    REQUIRE_EQ(mxg_bindings_layer(bindings, b, 1, &layer), MXG_OK);
    REQUIRE_EQ(layer.kind, MXG_LAYER_OVERRIDE);
    REQUIRE_EQ(layer.is_nodegraph, true);
    REQUIRE_EQ(layer.from, UINT32_MAX);
    REQUIRE_EQ(mxg_bindings_layer(bindings, b, 2, &layer), MXG_OK);
    REQUIRE_EQ(layer.kind, MXG_LAYER_VERTICAL);
    REQUIRE_EQ(layer.from, b);
    REQUIRE_EQ(mxg_bindings_layer(bindings, b, 3, &layer), MXG_ERROR_ARGUMENT);
    /* /a and /a/c are equal, /a/b differs */
    REQUIRE_EQ(mxg_bindings_num_stacks(bindings), 2);
    REQUIRE_EQ(mxg_bindings_stack(bindings, a), mxg_bindings_stack(bindings, c));
    REQUIRE(mxg_bindings_stack(bindings, a) != mxg_bindings_stack(bindings, b));
    REQUIRE_EQ(mxg_bindings_stack(bindings, 99), UINT32_MAX);
    /* the bindings hold the document and the scene */
    mxg_scene_destroy(scene);
    mxg_document_destroy(document);
    REQUIRE_EQ(mxg_bindings_num_layers(bindings, b), 3);
    mxg_bindings_destroy(bindings);
}

static void test_scene(mxg_context *context)
{
    mxg_scene *scene = NULL;
    char path[16], small[4];
    const char *paths[] = {"/a/b", "a", "//", "/a//b", "/a/c/"};
    mxg_scene_create(context, &scene);
    REQUIRE_EQ(mxg_scene_add_paths(scene, paths, 5), MXG_ERROR_DOCUMENT);
    REQUIRE_EQ(mxg_diagnostics_num_errors(mxg_scene_diagnostics(scene)), 3);
    REQUIRE_EQ(mxg_scene_num_primitives(scene), 3);
    uint32_t b = mxg_scene_find_primitive(scene, "/a/b");
    REQUIRE_EQ(mxg_scene_primitive_path(scene, b, path, sizeof path), 4);
    REQUIRE_STR(path, "/a/b");
    REQUIRE_EQ(mxg_scene_primitive_path(scene, b, small, sizeof small), 4);
    REQUIRE_STR(small, "/a/");
    REQUIRE_EQ(mxg_scene_find_primitive(scene, "/"), UINT32_MAX);
    REQUIRE_EQ(mxg_scene_find_primitive(scene, "/x"), UINT32_MAX);
    mxg_primitive primitive = {sizeof primitive};
    REQUIRE_EQ(mxg_scene_primitive(scene, b, &primitive), MXG_OK);
    REQUIRE_EQ(primitive.parent, mxg_scene_find_primitive(scene, "/a"));
    REQUIRE_EQ(primitive.next_sibling, mxg_scene_find_primitive(scene, "/a/c"));
    REQUIRE_EQ(primitive.first_child, UINT32_MAX);
    mxg_scene_destroy(scene);
}

/* Each allocation may fail: the call says so, and nothing is lost or kept. */
static void test_memory(void)
{
    static const char looks[] =
        "<collection name='x' includegeom='/a, /c*' includecollection='y' excludegeom='/a/b'/>"
        "<collection name='y' includegeom='//[a-c]{1,2}'/>" LOOK(
            C("000", "A", "x") C("000", "B", "y") M("000|010", "B", "/a") G("000::x", "NG", "//*"));
    const struct rule rule = {"memory", looks, "/a/b /a/c1 /c", "", ""};
    mxg_status status = MXG_ERROR_MEMORY;
    for (unsigned fail_at = 1; status == MXG_ERROR_MEMORY; fail_at++) {
        struct heap heap = {0};
        mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
        desc.realloc = heap_realloc;
        desc.realloc_user_data = &heap;
        mxg_context *context = NULL;
        mxg_context_create(&desc, &context);
        mxg_document *document = parse_rule(context, &rule);
        mxg_scene *scene = make_scene(context, rule.paths, false);
        mxg_bindings *bindings = NULL;
        char *json = NULL;
        heap.calls = 0;
        heap.fail_at = fail_at;
        status = mxg_bindings_create(context, document, scene, NULL, &bindings);
        REQUIRE((status == MXG_OK) == (bindings != NULL));
        if (status == MXG_OK)
            status = mxg_bindings_write(bindings, MXG_BINDINGS_JSON, append, &json);
        free(json);
        mxg_bindings_destroy(bindings);
        mxg_scene_destroy(scene);
        mxg_document_destroy(document);
        mxg_context_destroy(context);
        REQUIRE_EQ(heap.held, 0);
        REQUIRE_EQ(heap.wrong_sizes, 0);
    }
    REQUIRE_EQ(status, MXG_OK);
}

/* ---- Many primitives, many layers ---- */

/* Appends a formatted text to a growing one. */
static void add_text(char **text, size_t *len, const char *format, unsigned a, unsigned b,
                     unsigned c)
{
    enum { MAX_PIECE = 256, STEP = 65536 };
    /* room for a piece more than the next multiple of the step */
    if (!*text || *len / STEP != (*len - MAX_PIECE) / STEP)
        *text = realloc(*text, (*len / STEP + 1) * STEP + MAX_PIECE);
    *len += (size_t)snprintf(*text + *len, MAX_PIECE, format, a, b, c);
}

/* A scene of depth 12 with so many leaves. */
static mxg_scene *make_large_scene(mxg_context *context, unsigned num_leaves)
{
    mxg_scene *scene = NULL;
    mxg_scene_create(context, &scene);
    for (unsigned i = 0; i < num_leaves; i++) {
        char path[128];
        const char *list = path;
        snprintf(path, sizeof path, "/set_%u/a/row_%u/b/d/e/f/g/h/i/c_%u/leaf_%u", i / 10000,
                 i / 100, i % 7, i);
        mxg_scene_add_paths(scene, &list, 1);
    }
    return scene;
}

/* 200 assignments with patterns and collections. */
static mxg_document *make_large_look(mxg_context *context)
{
    char *text = NULL;
    size_t len = 0;
    for (unsigned i = 0; i < 20; i++)
        add_text(&text, &len,
                 "<collection name='C%u' includegeom='/set_%u, //leaf_*%u' excludegeom='//c_3'/>",
                 i, i, i);
    add_text(&text, &len, "<look name='L'>", 0, 0, 0);
    for (unsigned i = 0; i < 50; i++) {
        add_text(&text, &len, M("s%u", "A", "//row_?%u"), i % 8, i % 10, 0);
        add_text(&text, &len, M("s%u", "B", "/set_%u/{a,b}//*"), i % 8, i, 0);
        add_text(&text, &len, C("s%u", "D", "C%u"), i % 8, i % 20, 0);
        add_text(&text, &len, G("s%u::x", "NG", "/set_%u//leaf_[0-4]*%u"), i % 8, i, i % 10);
    }
    add_text(&text, &len, "</look>", 0, 0, 0);
    const struct rule rule = {"scale", text, "", "", ""};
    mxg_document *document = parse_rule(context, &rule);
    free(text);
    return document;
}

/* Bytes of a scene with its bindings for each primitive, with its name. */
static double bytes_of_large_scene(unsigned num_leaves, uint32_t *out_stacks)
{
    struct heap heap = {0};
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.realloc = heap_realloc;
    desc.realloc_user_data = &heap;
    mxg_context *context = NULL;
    mxg_bindings *bindings = NULL;
    mxg_context_create(&desc, &context);
    mxg_document *document = make_large_look(context);
    size_t before = heap.held;
    mxg_scene *scene = make_large_scene(context, num_leaves);
    REQUIRE_EQ(mxg_bindings_create(context, document, scene, NULL, &bindings), MXG_OK);
    double bytes = (double)(heap.held - before) / mxg_scene_num_primitives(scene);
    *out_stacks = mxg_bindings_num_stacks(bindings);
    mxg_bindings_destroy(bindings);
    mxg_scene_destroy(scene);
    mxg_document_destroy(document);
    mxg_context_destroy(context);
    REQUIRE_EQ(heap.held, 0);
    return bytes;
}

static void test_many_primitives(unsigned num)
{
    uint32_t few, many;
    double small = bytes_of_large_scene(num / 4, &few), large = bytes_of_large_scene(num, &many);
    printf("bytes for each primitive with its name: %.0f of %u, %.0f of %u; %u stacks\n", small,
           num / 4, large, num, (unsigned)many);
    REQUIRE(small < 100);
    REQUIRE(large < 100);
    REQUIRE(few > 10);
}

static void test_many_layers(mxg_context *context)
{
    enum { NUM = 10000 };
    char *text = NULL;
    size_t len = 0;
    add_text(&text, &len, "<look name='L'>", 0, 0, 0);
    for (unsigned i = 0; i < NUM; i++)
        add_text(&text, &len, M("%05u", "A", "/a"), i, 0, 0);
    add_text(&text, &len, "</look>", 0, 0, 0);
    const struct rule rule = {"layers", text, "/a/b", "", ""};
    mxg_document *document = parse_rule(context, &rule);
    mxg_scene *scene = make_scene(context, rule.paths, false);
    mxg_bindings *bindings = NULL;
    REQUIRE_EQ(mxg_bindings_create(context, document, scene, NULL, &bindings), MXG_OK);
    REQUIRE_EQ(mxg_bindings_num_layers(bindings, 1), NUM);
    mxg_layer layer = {sizeof layer};
    REQUIRE_EQ(mxg_bindings_layer(bindings, 1, NUM - 1, &layer), MXG_OK);
    REQUIRE_STR(layer.slot, "09999");
    mxg_bindings_destroy(bindings);
    mxg_scene_destroy(scene);
    mxg_document_destroy(document);
    free(text);
}

/* A stack in the place of an element: what a host asks for, and what it may not. */
static void test_stacks(mxg_context *context)
{
    const struct rule rule = {
        .looks = LOOK(M("000", "A", "/a") M("050", "B", "/a/b") M("000", "", "/c"))};
    mxg_document *document = parse_rule(context, &rule), *other = parse_rule(context, &rule);
    mxg_scene *scene = make_scene(context, "/a/b /c", false);
    mxg_bindings *bindings = NULL;
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_shader_info info = {sizeof info};
    mxg_result *result = NULL;
    char name[64];
    REQUIRE(mxg_bindings_create(context, document, scene, NULL, &bindings) == MXG_OK);
    desc.target = "vulkan";
    desc.bindings = bindings;
    for (uint32_t i = 0; i < mxg_scene_num_primitives(scene); i++) {
        desc.stack = mxg_bindings_stack(bindings, i);
        REQUIRE(mxg_generate(context, document, &desc, &result) == MXG_OK);
        REQUIRE(mxg_bindings_stack_name(bindings, desc.stack, name, sizeof name) == 22);
        REQUIRE(mxg_result_info(result, &info) == MXG_OK);
        REQUIRE_STR(info.name, name);
        REQUIRE(mxg_result_source(result, MXG_STAGE_PIXEL, NULL) != NULL);
        mxg_result_destroy(result);
    }
    desc.element = "A";
    REQUIRE(mxg_generate(context, document, &desc, &result) == MXG_ERROR_ARGUMENT);
    desc.element = NULL;
    REQUIRE(mxg_generate(context, other, &desc, &result) == MXG_ERROR_ARGUMENT);
    desc.stack = mxg_bindings_num_stacks(bindings);
    REQUIRE(mxg_generate(context, document, &desc, &result) == MXG_ERROR_ARGUMENT);
    REQUIRE(mxg_bindings_stack_name(bindings, desc.stack, name, sizeof name) == 0);
    mxg_bindings_destroy(bindings);
    mxg_scene_destroy(scene);
    mxg_document_destroy(document);
    mxg_document_destroy(other);
}

/* ---- A stage of USD ---- */

static mxg_scene *parse_usda(mxg_context *context, const char *text, mxg_status expected)
{
    mxg_scene *scene = NULL;
    REQUIRE(mxg_scene_parse(context, "test_bind.usda", text, strlen(text), NULL, &scene)
            == expected);
    return scene;
}

/* A collection loses members, those that it excludes, its own primitive, and all. */
static void test_removed_members(mxg_context *context)
{
    static const char stage[] =
        "#usda 1.0\ndef Xform \"r\" (prepend apiSchemas = [\"CollectionAPI:c\"])\n{\n"
        "rel collection:c:includes = [</r/a>, </r/b>]\nrel collection:c:excludes = </r/b/x>\n"
        "rel material:binding:collection:c = [</r.collection:c>, </M>]\n"
        "def Mesh \"a\" {}\ndef Xform \"b\" { def Mesh \"x\" {}\n def Mesh \"y\" {} }\n}\n"
        "def Material \"M\" {}\n";
    static const char *const removed[] = {"/r/a", "/r/b/x", "/r/b/y", "/r/b", "/r"};
    static const struct rule rule = {
        .looks = "<surface name='s9' type='surfaceshader'/><surfacematerial name='M' "
                 "type='material'><input name='surfaceshader' type='surfaceshader' "
                 "nodename='s9'/></surfacematerial>"};
    mxg_document *document = parse_rule(context, &rule);
    for (unsigned set = 1; set < 1u << (sizeof removed / sizeof *removed); set++) {
        mxg_scene *scene = parse_usda(context, stage, MXG_OK);
        mxg_bindings *bindings = NULL;
        for (size_t i = 0; i < sizeof removed / sizeof *removed; i++) {
            uint32_t primitive = mxg_scene_find_primitive(scene, removed[i]);
            if (set >> i & 1 && primitive != MXG_NONE)
                REQUIRE(mxg_scene_remove_primitives(scene, &primitive, 1) == MXG_OK);
        }
        REQUIRE(mxg_bindings_create(context, document, scene, NULL, &bindings) == MXG_OK);
        uint32_t y = mxg_scene_find_primitive(scene, "/r/b/y");
        REQUIRE(y == MXG_NONE || mxg_bindings_num_layers(bindings, y) == 1);
        uint32_t x = mxg_scene_find_primitive(scene, "/r/b/x");
        REQUIRE(x == MXG_NONE || mxg_bindings_num_layers(bindings, x) == 0);
        mxg_bindings_destroy(bindings);
        mxg_scene_destroy(scene);
    }
    mxg_document_destroy(document);
}

/* With a number: only a scene with so many leaves. */
int main(int argc, char **argv)
{
    mxg_context *context = NULL;
    if (argc > 1) {
        test_many_primitives((unsigned)strtoul(argv[1], NULL, 10));
        return test_report("bind");
    }
    REQUIRE(mxg_context_create(NULL, &context) == MXG_OK);
    test_names();
    test_scene(context);
    test_queries(context);
    test_stacks(context);
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++) {
        check_rule(context, &rules[i], false);
        check_rule(context, &rules[i], true); /* the order of the primitives does not matter */
    }
    test_many_layers(context);
    test_removed_members(context);
    mxg_context_destroy(context);
    test_many_primitives(200000);
    test_memory();
    return test_report("bind");
}
