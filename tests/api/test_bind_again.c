// SPDX-License-Identifier: Apache-2.0
/*
 * Binding again after a change: the result is that of binding anew, and only primitives at or below
 * the change are resolved.
 */
#define _POSIX_C_SOURCE 200809L
#include "fixture.h"

#include <stdlib.h>

enum { MAX_LINES = 12, MAX_LINE = 160, NUM_COLLECTIONS = 3, TEXT_SIZE = 16384 };

/* ---- A look that changes line by line ---- */

struct look {
    char lines[MAX_LINES][MAX_LINE];
    char includes[NUM_COLLECTIONS][MAX_LINE];
};

static mxg_document *parse_look(mxg_context *context, const struct look *look)
{
    static const char head[] =
        "<materialx version='1.39'><surface name='s' type='surfaceshader'/>"
        "<surfacematerial name='A' type='material'>"
        "  <input name='surfaceshader' type='surfaceshader' nodename='s'/></surfacematerial>"
        "<surfacematerial name='B' type='material'>"
        "  <input name='surfaceshader' type='surfaceshader' nodename='s'/></surfacematerial>"
        "<nodegraph name='NG'><constant name='c' type='float'/>"
        "  <output name='mask' type='float' nodename='c'/></nodegraph>";
    static char text[TEXT_SIZE];
    int len = snprintf(text, sizeof text, "%s", head);
    for (unsigned i = 0; i < NUM_COLLECTIONS; i++)
        len += snprintf(text + len, sizeof text - (size_t)len, "<collection name='C%u' %s/>", i,
                        look->includes[i]);
    len += snprintf(text + len, sizeof text - (size_t)len, "<look name='L'>");
    for (unsigned i = 0; i < MAX_LINES; i++)
        len += snprintf(text + len, sizeof text - (size_t)len, "%s", look->lines[i]);
    snprintf(text + len, sizeof text - (size_t)len, "</look></materialx>");
    return parse_builtin(context, text);
}

/* ---- Comparison ---- */

static char *text_of(const mxg_bindings *bindings)
{
    char *text = NULL;
    mxg_diagnostic d = {sizeof d};
    REQUIRE(mxg_bindings_write(bindings, MXG_BINDINGS_JSON, append, &text) == MXG_OK);
    const mxg_diagnostics *list = mxg_bindings_diagnostics(bindings);
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); i++) {
        mxg_diagnostics_item(list, i, &d);
        append(&text, d.message, strlen(d.message));
        append(&text, "\n", 1);
    }
    return text;
}

static void add_facts(const mxg_bindings *bindings, const mxg_scene *scene, char **text)
{
    for (uint32_t i = 0; i < mxg_scene_num_primitives(scene); i++)
        for (uint32_t k = 0; k < mxg_bindings_num_facts(bindings, i); k++) {
            mxg_fact fact = {sizeof fact};
            char line[MAX_LINE];
            mxg_bindings_fact(bindings, i, k, &fact);
            snprintf(line, sizeof line, "%u %s=%s from %d\n", (unsigned)i, fact.name, fact.value,
                     (int)fact.from);
            append(text, line, strlen(line));
        }
}

/* Those that were not removed. */
static uint32_t count_primitives(const mxg_scene *scene)
{
    uint32_t num = 0;
    mxg_primitive primitive = {sizeof primitive};
    for (uint32_t i = 0; i < mxg_scene_num_primitives(scene); i++)
        num += mxg_scene_primitive(scene, i, &primitive) == MXG_OK;
    return num;
}

/* A scene with the same paths in the same order, which never had others. */
static mxg_scene *copy_scene(mxg_context *context, const mxg_scene *scene)
{
    mxg_scene *copy = NULL;
    REQUIRE_EQ(mxg_scene_create(context, &copy), MXG_OK);
    for (uint32_t i = 0; i < mxg_scene_num_primitives(scene); i++) {
        char buffer[64];
        const char *path = buffer;
        if (mxg_scene_primitive_path(scene, i, buffer, sizeof buffer))
            REQUIRE_EQ(mxg_scene_add_paths(copy, &path, 1), MXG_OK);
    }
    return copy;
}

/* Binds with and without `*previous`, which the result then replaces. Gives the resolved ones. */
static uint32_t bind_again(mxg_context *context, const mxg_document *document, mxg_scene *scene,
                           mxg_bindings **previous)
{
    mxg_bindings_desc desc = MXG_BINDINGS_DESC_INIT;
    mxg_bindings *anew = NULL, *again = NULL;
    REQUIRE_EQ(mxg_bindings_create(context, document, scene, &desc, &anew), MXG_OK);
    desc.previous = *previous;
    REQUIRE_EQ(mxg_bindings_create(context, document, scene, &desc, &again), MXG_OK);
    REQUIRE_EQ(mxg_bindings_num_resolved_primitives(anew), count_primitives(scene));
    char *expected = text_of(anew), *given = text_of(again);
    add_facts(anew, scene, &expected);
    add_facts(again, scene, &given);
    if (!REQUIRE(strcmp(given, expected) == 0))
        printf("again:\n%s\nanew:\n%s\n", given, expected);
    free(expected);
    free(given);
    uint32_t num = mxg_bindings_num_resolved_primitives(again);
    mxg_bindings_destroy(anew);
    mxg_bindings_destroy(*previous);
    *previous = again;
    return num;
}

/* ---- Counts ---- */

/* Adds `num` primitives below another one. */
struct row {
    uint32_t parent, num, next;
    uint32_t first; /* the number of the first one */
    char name[16];
};

static bool next_of_row(void *user_data, uint32_t last, mxg_primitive *out)
{
    struct row *row = user_data;
    if (row->next == 1)
        row->first = last;
    if (row->next == row->num)
        return false;
    snprintf(row->name, sizeof row->name, "p%u", (unsigned)row->next++);
    out->parent = row->parent;
    out->name = row->name;
    out->name_len = strlen(row->name);
    out->type = "Mesh";
    out->type_len = 4;
    return true;
}

static uint32_t add_row(mxg_scene *scene, uint32_t parent, uint32_t num)
{
    struct row row = {.parent = parent, .num = num};
    REQUIRE_EQ(mxg_scene_add_primitives(scene, next_of_row, &row), MXG_OK);
    return row.first;
}

/* /p0../p9, each with 20 primitives p0../p19 below */
enum { NUM_ROOTS = 10, NUM_BELOW = 20, NUM_ALL = NUM_ROOTS * (NUM_BELOW + 1) };

static mxg_scene *make_scene(mxg_context *context)
{
    mxg_scene *scene = NULL;
    mxg_scene_create(context, &scene);
    uint32_t first = add_row(scene, UINT32_MAX, NUM_ROOTS);
    for (uint32_t i = 0; i < NUM_ROOTS; i++)
        add_row(scene, first + i, NUM_BELOW);
    REQUIRE_EQ(mxg_scene_num_primitives(scene), NUM_ALL);
    return scene;
}

#define ASSIGN(slot, material, geom) \
    "<materialassign slot='" slot "' material='" material "' geom='" geom "'/>"

static void set_line(struct look *look, unsigned line, const char *text)
{
    snprintf(look->lines[line], MAX_LINE, "%s", text);
}

static const struct change {
    const char *before, *after; /* lines of a look */
    uint32_t num;               /* primitives that are resolved again */
} changes[] = {
    {"", "", 0},
    {"", ASSIGN("050", "B", "/p3"), NUM_BELOW + 1},
    {"", ASSIGN("050", "B", "/p3/"), NUM_BELOW + 1},
    {"", ASSIGN("050", "B", "/p3/p4"), 1},
    {"", ASSIGN("050", "B", "/p3/p4, /p5/p6, p7/p8, /none"), 3},
    {"", ASSIGN("050", "B", "/"), NUM_ALL},
    {"", ASSIGN("050", "B", "/p3, /p3/p4"), NUM_BELOW + 1},
    {"", ASSIGN("050", "B", "/p[3-4]"), 2 * (NUM_BELOW + 1)},
    {"", ASSIGN("050", "B", "/*/p1"), NUM_ROOTS},
    {"", ASSIGN("050", "B", "//p1"), NUM_ROOTS + NUM_BELOW},
    {"", ASSIGN("050", "B", "/p2//*"), NUM_BELOW},
    {"", "<materialassign material='B' collection='C1'/>", NUM_BELOW + 2},
    /* another material, a removal, another slot, another order: the places are the same */
    {ASSIGN("050", "B", "/p3"), ASSIGN("050", "A", "/p3"), 0},
    {ASSIGN("050", "B", "/p3"), ASSIGN("050", "", "/p3"), 0},
    {ASSIGN("050", "B", "/p3"), ASSIGN("010", "B", "/p3"), 0},
    {ASSIGN("050", "B", "/p3"), ASSIGN("050", "B", "/p3") ASSIGN("060", "A", "/p3"), 0},
    {ASSIGN("050", "B", "/p3") ASSIGN("050", "A", "//p3"),
     ASSIGN("050", "A", "//p3") ASSIGN("050", "B", "/p3"), 0},
    {ASSIGN("050", "B", "/p3"), "", 0},
    /* an exclusion knows only where it begins */
    {"<materialassign material='B' collection='C2'/>", ASSIGN("050", "B", "//p3"),
     NUM_ROOTS + NUM_BELOW},
    /* another place: what lies below the new one */
    {ASSIGN("050", "B", "/p3"), ASSIGN("050", "B", "/p3/p4"), 1},
    {ASSIGN("050", "B", "/p3"), ASSIGN("050", "B", "/p3, /p4"), 2 * (NUM_BELOW + 1)},
};

static void test_changes(mxg_context *context)
{
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        struct look look = {.includes = {"", "includegeom='/p1, /p2/p3' excludegeom='/p1/p4'",
                                         "includegeom='/' excludegeom='//p3'"}};
        mxg_scene *scene = make_scene(context);
        mxg_bindings *bindings = NULL;
        set_line(&look, 0, ASSIGN("000", "A", "/p1, /p3//p4"));
        set_line(&look, 1, changes[i].before);
        mxg_document *before = parse_look(context, &look);
        set_line(&look, 1, changes[i].after);
        mxg_document *after = parse_look(context, &look);
        REQUIRE_EQ(bind_again(context, before, scene, &bindings), NUM_ALL);
        if (!REQUIRE_EQ(bind_again(context, after, scene, &bindings), changes[i].num))
            printf("    from %s to %s\n", changes[i].before, changes[i].after);
        mxg_document_destroy(before);
        mxg_document_destroy(after);
        mxg_bindings_destroy(bindings);
        mxg_scene_destroy(scene);
    }
}

/* New primitives, and bindings of the scene that come and go. */
static void test_scene_changes(mxg_context *context, bool with_leaves)
{
    struct look look = {.includes = {"", "", ""}};
    mxg_scene *scene = make_scene(context);
    mxg_bindings *bindings = NULL;
    set_line(&look, 0, with_leaves ? ASSIGN("050", "B", "//*") : ASSIGN("050", "B", "/p0"));
    mxg_document *document = parse_look(context, &look);
    uint32_t leaf = mxg_scene_find_primitive(scene, "/p3/p4"),
             root = mxg_scene_find_primitive(scene, "/p3");
    REQUIRE_EQ(bind_again(context, document, scene, &bindings), NUM_ALL);
    REQUIRE_EQ(mxg_bindings_num_layers(bindings, leaf), with_leaves ? 1 : 0);
    /* a leaf gets a primitive below: it is none any more, which a pattern may ask for */
    add_row(scene, leaf, 1);
    REQUIRE_EQ(mxg_bindings_num_layers(bindings, 0), 0);
    REQUIRE_EQ(bind_again(context, document, scene, &bindings), with_leaves ? 2 : 1);
    REQUIRE_EQ(mxg_bindings_num_layers(bindings, leaf), 0);
    /* the second one below changes nothing above */
    const char *path = "/p3/p4/second";
    REQUIRE_EQ(mxg_scene_add_paths(scene, &path, 1), MXG_OK);
    REQUIRE_EQ(bind_again(context, document, scene, &bindings), 1);
    const char *paths[] = {"/new/a", "/new/b", "/p5/new"};
    REQUIRE_EQ(mxg_scene_add_paths(scene, paths, 3), MXG_OK);
    REQUIRE_EQ(bind_again(context, document, scene, &bindings), 4);
    REQUIRE_EQ(mxg_scene_set_binding(scene, root, "000", "A"), MXG_OK);
    REQUIRE_EQ(bind_again(context, document, scene, &bindings), NUM_BELOW + 3);
    mxg_layer layer = {sizeof layer};
    REQUIRE_EQ(mxg_bindings_layer(bindings, leaf, 0, &layer), MXG_OK);
    REQUIRE_STR(layer.material, "A");
    REQUIRE_EQ(layer.from, root);
    REQUIRE_STR(layer.assign, "material:slotBinding:_000");
    REQUIRE_EQ(mxg_scene_set_binding(scene, root, "000", "B"), MXG_OK);
    REQUIRE_EQ(bind_again(context, document, scene, &bindings), 0);
    REQUIRE_EQ(mxg_bindings_layer(bindings, leaf, 0, &layer), MXG_OK);
    REQUIRE_STR(layer.material, "B");
    REQUIRE_EQ(mxg_scene_set_binding(scene, leaf, "000", ""), MXG_OK);
    REQUIRE_EQ(bind_again(context, document, scene, &bindings), 3);
    REQUIRE_EQ(mxg_bindings_num_layers(bindings, leaf), 0);
    REQUIRE_EQ(mxg_scene_remove_binding(scene, leaf, "000"), MXG_OK);
    REQUIRE_EQ(bind_again(context, document, scene, &bindings), 0);
    REQUIRE_EQ(mxg_bindings_num_layers(bindings, leaf), 1);
    mxg_bindings_destroy(bindings);
    mxg_scene_destroy(scene);
    mxg_document_destroy(document);
}

/* ---- The functions of a scene ---- */

static bool give_one(void *user_data, uint32_t last, mxg_primitive *out)
{
    mxg_primitive **next = user_data;
    (void)last;
    if (!*next)
        return false;
    size_t size = out->size;
    *out = **next;
    out->size = size;
    *next = NULL;
    return true;
}

static mxg_status add_one(mxg_scene *scene, uint32_t parent, const char *name)
{
    mxg_primitive given = {.parent = parent, .name = name, .name_len = strlen(name)},
                  *next = &given;
    return mxg_scene_add_primitives(scene, give_one, &next);
}

static void test_primitives(mxg_context *context)
{
    mxg_scene *scene = NULL;
    mxg_primitive primitive = {sizeof primitive};
    mxg_scene_create(context, &scene);
    REQUIRE_EQ(add_row(scene, UINT32_MAX, 2), 0);
    REQUIRE_EQ(mxg_scene_primitive(scene, 0, &primitive), MXG_OK);
    REQUIRE_EQ(primitive.type_len, 4);
    REQUIRE(memcmp(primitive.type, "Mesh", 4) == 0);
    REQUIRE_EQ(add_one(scene, 1, "b/c"), MXG_OK);
    uint32_t c = mxg_scene_find_primitive(scene, "/p1/b/c");
    REQUIRE_EQ(mxg_scene_primitive(scene, c, &primitive), MXG_OK);
    REQUIRE_EQ(primitive.type_len, 0);
    REQUIRE_EQ(add_one(scene, 1, "b/c"), MXG_OK);
    REQUIRE_EQ(mxg_scene_num_primitives(scene), 4);
    const char *const faulty[] = {"", "/b", "b//c"};
    for (size_t i = 0; i < sizeof faulty / sizeof *faulty; i++)
        REQUIRE_EQ(add_one(scene, 1, faulty[i]), MXG_ERROR_DOCUMENT);
    REQUIRE_EQ(add_one(scene, 99, "b"), MXG_ERROR_DOCUMENT);
    REQUIRE_EQ(mxg_diagnostics_num_errors(mxg_scene_diagnostics(scene)), 4);
    REQUIRE_EQ(mxg_scene_num_primitives(scene), 4);
    REQUIRE_EQ(mxg_scene_add_primitives(scene, NULL, NULL), MXG_ERROR_ARGUMENT);
    mxg_scene_destroy(scene);
}

static void test_bindings_of_scene(mxg_context *context)
{
    mxg_scene *scene = NULL;
    mxg_slot_binding binding = {sizeof binding};
    mxg_scene_create(context, &scene);
    add_row(scene, UINT32_MAX, 2);
    REQUIRE_EQ(mxg_scene_set_binding(scene, 1, "050::010", "NG"), MXG_OK);
    REQUIRE_EQ(mxg_scene_set_binding(scene, 1, "050", "A"), MXG_OK);
    REQUIRE_EQ(mxg_scene_set_binding(scene, 1, "050::010", ""), MXG_OK);
    REQUIRE_EQ(mxg_scene_set_binding(scene, UINT32_MAX, "050", "B"), MXG_OK);
    REQUIRE_EQ(mxg_scene_num_bindings(scene, 0), 0);
    REQUIRE_EQ(mxg_scene_num_bindings(scene, 1), 2);
    REQUIRE_EQ(mxg_scene_num_bindings(scene, 2), 0);
    REQUIRE_EQ(mxg_scene_binding(scene, 1, 1, &binding), MXG_OK);
    REQUIRE_STR(binding.slot, "050::010");
    REQUIRE_STR(binding.material, "");
    REQUIRE_STR(binding.file, "");
    REQUIRE_EQ(mxg_scene_binding(scene, 1, 2, &binding), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_scene_binding(scene, UINT32_MAX, 0, &binding), MXG_OK);
    REQUIRE_STR(binding.material, "B");
    REQUIRE_EQ(mxg_scene_remove_binding(scene, 1, "050"), MXG_OK);
    REQUIRE_EQ(mxg_scene_remove_binding(scene, 1, "050"), MXG_OK);
    REQUIRE_EQ(mxg_scene_num_bindings(scene, 1), 1);
    REQUIRE_EQ(mxg_scene_set_binding(scene, 2, "050", "A"), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_scene_set_binding(scene, 1, NULL, "A"), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_scene_set_binding(scene, 1, "050", NULL), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_scene_set_binding(scene, 1, "a:b", "A"), MXG_ERROR_DOCUMENT);
    REQUIRE_EQ(mxg_scene_remove_binding(scene, 1, ""), MXG_ERROR_DOCUMENT);
    REQUIRE_EQ(mxg_diagnostics_num_errors(mxg_scene_diagnostics(scene)), 2);
    mxg_scene_destroy(scene);
}

/* A name with a bracket or a comma is a name, not a pattern. */
static void test_plain_names(mxg_context *context)
{
    struct look look = {.includes = {"", "", ""}};
    mxg_document *document = parse_look(context, &look);
    mxg_scene *scene = NULL;
    mxg_bindings *bindings = NULL;
    mxg_scene_create(context, &scene);
    REQUIRE_EQ(add_one(scene, UINT32_MAX, "a[1],*"), MXG_OK);
    REQUIRE_EQ(add_one(scene, UINT32_MAX, "a1"), MXG_OK);
    REQUIRE_EQ(mxg_scene_set_binding(scene, 0, "000", "A"), MXG_OK);
    bind_again(context, document, scene, &bindings);
    REQUIRE_EQ(mxg_bindings_num_layers(bindings, 0), 1);
    REQUIRE_EQ(mxg_bindings_num_layers(bindings, 1), 0);
    mxg_bindings_destroy(bindings);
    mxg_scene_destroy(scene);
    mxg_document_destroy(document);
}

/* Primitives go: what is below them goes, too, and only a parent that is a leaf now is new. */
static void test_removals(mxg_context *context, bool with_leaves)
{
    struct look look = {.includes = {"", "", ""}};
    mxg_scene *scene = make_scene(context);
    mxg_bindings *bindings = NULL;
    mxg_primitive primitive = {sizeof primitive};
    char path[64];
    set_line(&look, 0, with_leaves ? ASSIGN("050", "B", "//*") : ASSIGN("050", "B", "/p0"));
    mxg_document *document = parse_look(context, &look);
    const char *extra[] = {"/p3/p4/a/b", "/p3/p4/c"};
    REQUIRE_EQ(mxg_scene_add_paths(scene, extra, 2), MXG_OK);
    uint32_t above = mxg_scene_find_primitive(scene, "/p3/p4"),
             a = mxg_scene_find_primitive(scene, "/p3/p4/a"),
             b = mxg_scene_find_primitive(scene, "/p3/p4/a/b"),
             c = mxg_scene_find_primitive(scene, "/p3/p4/c");
    REQUIRE_EQ(mxg_scene_set_binding(scene, b, "000", "A"), MXG_OK);
    REQUIRE_EQ(bind_again(context, document, scene, &bindings), NUM_ALL + 3);
    REQUIRE_EQ(mxg_bindings_num_layers(bindings, above), 0);
    REQUIRE_EQ(mxg_scene_remove_primitives(scene, &a, 1), MXG_OK);
    REQUIRE_EQ(mxg_bindings_num_layers(bindings, 0), 0);
    REQUIRE_EQ(bind_again(context, document, scene, &bindings), 0);
    REQUIRE_EQ(mxg_scene_find_primitive(scene, "/p3/p4/a"), UINT32_MAX);
    REQUIRE_EQ(mxg_scene_find_primitive(scene, "/p3/p4/a/b"), UINT32_MAX);
    REQUIRE_EQ(mxg_scene_primitive(scene, b, &primitive), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_scene_primitive_path(scene, a, path, sizeof path), 0);
    REQUIRE_EQ(mxg_scene_num_bindings(scene, b), 0);
    REQUIRE_EQ(mxg_scene_set_binding(scene, b, "000", "A"), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_scene_remove_primitives(scene, &b, 1), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_scene_remove_primitives(scene, NULL, 1), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_scene_remove_primitives(scene, NULL, 0), MXG_OK);
    REQUIRE_EQ(add_one(scene, a, "x"), MXG_ERROR_DOCUMENT);
    REQUIRE_EQ(mxg_bindings_stack(bindings, b), UINT32_MAX);
    REQUIRE_EQ(mxg_scene_primitive(scene, above, &primitive), MXG_OK);
    REQUIRE_EQ(primitive.first_child, c);
    /* the last one below: the parent is a leaf */
    uint32_t both[] = {c, above, c};
    REQUIRE_EQ(mxg_scene_remove_primitives(scene, both, 1), MXG_OK);
    REQUIRE_EQ(bind_again(context, document, scene, &bindings), with_leaves ? 1 : 0);
    REQUIRE_EQ(mxg_bindings_num_layers(bindings, above), with_leaves ? 1 : 0);
    /* a path that comes again has another number, and no bindings */
    REQUIRE_EQ(mxg_scene_add_paths(scene, extra, 2), MXG_OK);
    REQUIRE(mxg_scene_find_primitive(scene, "/p3/p4/a/b") > c);
    REQUIRE_EQ(bind_again(context, document, scene, &bindings), with_leaves ? 4 : 3);
    REQUIRE_EQ(mxg_bindings_num_layers(bindings, mxg_scene_find_primitive(scene, "/p3/p4/a/b")),
               with_leaves ? 1 : 0);
    /* several at once, one of them twice, and one below another */
    both[0] = both[2] = mxg_scene_find_primitive(scene, "/p3/p4/c");
    REQUIRE_EQ(mxg_scene_remove_primitives(scene, both, 3), MXG_OK);
    REQUIRE_EQ(bind_again(context, document, scene, &bindings), 0);
    REQUIRE_EQ(mxg_scene_find_primitive(scene, "/p3/p4"), UINT32_MAX);
    REQUIRE(mxg_scene_find_primitive(scene, "/p3/p3") != UINT32_MAX);
    mxg_scene *copy = copy_scene(context, scene);
    mxg_bindings *of_copy = NULL;
    bind_again(context, document, copy, &of_copy);
    char *expected = text_of(of_copy), *given = text_of(bindings);
    REQUIRE_STR(given, expected);
    free(expected);
    free(given);
    mxg_bindings_destroy(of_copy);
    mxg_scene_destroy(copy);
    mxg_bindings_destroy(bindings);
    mxg_scene_destroy(scene);
    mxg_document_destroy(document);
}

/* Bindings of a scene say nothing after it changed. */
static void test_stale(mxg_context *context)
{
    struct look look = {.includes = {"", "", ""}};
    set_line(&look, 0, ASSIGN("000", "A", "/"));
    mxg_document *document = parse_look(context, &look);
    mxg_scene *scene = make_scene(context), *other = make_scene(context);
    mxg_bindings *bindings = NULL, *made = NULL;
    mxg_bindings_desc desc = MXG_BINDINGS_DESC_INIT;
    mxg_generate_desc generate = MXG_GENERATE_DESC_INIT;
    mxg_result *result = NULL;
    mxg_layer layer = {sizeof layer};
    char *text = NULL, name[64];
    bind_again(context, document, scene, &bindings);
    REQUIRE_EQ(mxg_scene_set_binding(scene, 0, "000", "B"), MXG_OK);
    REQUIRE_EQ(mxg_bindings_num_layers(bindings, 0), 0);
    REQUIRE_EQ(mxg_bindings_layer(bindings, 0, 0, &layer), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_bindings_num_facts(bindings, 0), 0);
    REQUIRE_EQ(mxg_bindings_stack(bindings, 0), UINT32_MAX);
    REQUIRE_EQ(mxg_bindings_num_stacks(bindings), 0);
    REQUIRE_EQ(mxg_bindings_stack_name(bindings, 0, name, sizeof name), 0);
    REQUIRE_EQ(mxg_bindings_write(bindings, MXG_BINDINGS_JSON, append, &text), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_bindings_write_reasons(bindings, 0, append, &text), MXG_ERROR_ARGUMENT);
    generate.target = "glsl";
    generate.bindings = bindings;
    REQUIRE_EQ(mxg_generate(context, document, &generate, &result), MXG_ERROR_ARGUMENT);
    desc.previous = bindings;
    REQUIRE_EQ(mxg_bindings_create(context, document, other, &desc, &made), MXG_ERROR_ARGUMENT);
    mxg_bindings_destroy(bindings);
    mxg_scene_destroy(scene);
    mxg_scene_destroy(other);
    mxg_document_destroy(document);
}

/* ---- Random edits ---- */

static uint32_t random_state;

static unsigned pick(unsigned num)
{
    random_state = random_state * 1664525u + 1013904223u;
    return (random_state >> 10) % num;
}

static const char *const geoms[] = {
    "/",     "/p1",        "/p1/p2",    "/p2/p1, /p3",     "//p1",       "/p[12]//*", "//*",
    "/p1//", "/p{1,2}/p?", "/*/p?/p0*", "/p1/p1//p2, /p2", "/p0//p3//*", "p3/",       "/p4//p[!2]",
};
enum { NUM_GEOMS = sizeof geoms / sizeof *geoms };
static const char *const slots[] = {"000", "050", "050::010", "000|010", "050|010::a", "9", "10"};
enum { NUM_SLOTS = sizeof slots / sizeof *slots };

static void random_line(char *line)
{
    const char *slot = slots[pick(NUM_SLOTS)];
    bool is_override = strstr(slot, "::");
    const char *target = pick(4) == 0 ? "" : is_override ? "NG" : pick(2) ? "A" : "B";
    char place[64];
    if (pick(3) == 0)
        snprintf(place, sizeof place, "collection='C%u'", pick(NUM_COLLECTIONS));
    else
        snprintf(place, sizeof place, "geom='%s'", geoms[pick(NUM_GEOMS)]);
    if (pick(8) == 0)
        snprintf(line, MAX_LINE, "<visibility name='v%u' vistype='camera' visible='%s' %s/>",
                 pick(1000), pick(2) ? "true" : "false", place);
    else
        snprintf(line, MAX_LINE, "<materialassign slot='%s' %s='%s' %s %s/>", slot,
                 is_override ? "nodegraph" : "material", target, place,
                 !is_override && *target && pick(4) == 0 ? "exclusive='false'" : "");
}

static void random_collection(struct look *look, unsigned i)
{
    char nested[32] = "";
    if (i && pick(2))
        snprintf(nested, sizeof nested, "includecollection='C%u'", pick(i));
    snprintf(look->includes[i], MAX_LINE, "includegeom='%s' excludegeom='%s' %s",
             geoms[pick(NUM_GEOMS)], pick(2) ? geoms[1 + pick(NUM_GEOMS - 1)] : "", nested);
}

static void change_scene(mxg_scene *scene)
{
    uint32_t num = mxg_scene_num_primitives(scene), at = num ? pick(num + 1) : 0;
    uint32_t prim = at == num ? UINT32_MAX : at;
    char name[16];
    mxg_primitive info = {sizeof info};
    if (prim != UINT32_MAX && mxg_scene_primitive(scene, prim, &info) != MXG_OK)
        return; /* it was removed */
    switch (pick(5)) {
    case 4:
        REQUIRE_EQ(mxg_scene_remove_primitives(scene, &prim, 1),
                   prim == UINT32_MAX ? MXG_ERROR_ARGUMENT : MXG_OK);
        break;
    case 0: mxg_scene_remove_binding(scene, prim, slots[pick(NUM_SLOTS)]); break;
    case 1: mxg_scene_set_binding(scene, prim, slots[pick(2)], pick(3) ? "A" : ""); break;
    default:
        snprintf(name, sizeof name, pick(4) ? "p%u" : "p%u/p1", pick(5));
        REQUIRE_EQ(add_one(scene, prim, name), MXG_OK);
    }
}

static void test_random(mxg_context *context, uint32_t seed)
{
    struct look look = {.includes = {"", "", ""}};
    mxg_scene *scene = NULL;
    mxg_bindings *bindings = NULL;
    uint32_t resolved = 0, all = 0;
    random_state = seed * 2654435761u;
    mxg_scene_create(context, &scene);
    add_row(scene, UINT32_MAX, 5);
    mxg_document *document = parse_look(context, &look);
    for (unsigned step = 0; step < 40; step++) {
        if (pick(2)) {
            if (pick(4) == 0)
                random_collection(&look, pick(NUM_COLLECTIONS));
            else if (pick(4) == 0)
                set_line(&look, pick(MAX_LINES), "");
            else
                random_line(look.lines[pick(MAX_LINES)]);
            mxg_document_destroy(document);
            document = parse_look(context, &look);
        } else {
            for (unsigned i = pick(4) + 1; i; i--)
                change_scene(scene);
        }
        resolved += bind_again(context, document, scene, &bindings);
        all += count_primitives(scene);
    }
    REQUIRE(resolved < all);
    mxg_bindings_destroy(bindings);
    mxg_scene_destroy(scene);
    mxg_document_destroy(document);
}

/* Each allocation may fail: the call says so, and the bindings before stay as they are. */
static void test_memory(void)
{
    struct look look = {.includes = {"", "", ""}};
    mxg_status status = MXG_ERROR_MEMORY;
    set_line(&look, 0, ASSIGN("000", "A", "/p1, //p2"));
    for (unsigned fail_at = 1; status == MXG_ERROR_MEMORY; fail_at++) {
        struct heap heap = {0};
        mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
        mxg_bindings_desc bind = MXG_BINDINGS_DESC_INIT;
        desc.realloc = heap_realloc;
        desc.realloc_user_data = &heap;
        mxg_context *context = NULL;
        mxg_bindings *bindings = NULL, *again = NULL;
        mxg_context_create(&desc, &context);
        set_line(&look, 1, "");
        mxg_document *before = parse_look(context, &look);
        set_line(&look, 1, ASSIGN("050", "A", "//p[3-4]//{a,p*}"));
        mxg_document *after = parse_look(context, &look);
        mxg_scene *scene = make_scene(context);
        REQUIRE_EQ(mxg_bindings_create(context, before, scene, NULL, &bindings), MXG_OK);
        bind.previous = bindings;
        heap.calls = 0;
        heap.fail_at = fail_at;
        status = mxg_scene_set_binding(scene, 3, "050", "A");
        if (status == MXG_OK)
            status = add_one(scene, 3, "new");
        if (status == MXG_OK)
            status = mxg_scene_remove_primitives(
                scene, &(uint32_t){mxg_scene_find_primitive(scene, "/p1/p1")}, 1);
        if (status == MXG_OK)
            status = mxg_bindings_create(context, after, scene, &bind, &again);
        heap.fail_at = 0;
        REQUIRE((status == MXG_OK) == (again != NULL));
        mxg_bindings_destroy(again);
        REQUIRE_EQ(mxg_bindings_create(context, after, scene, &bind, &again), MXG_OK);
        mxg_bindings_destroy(again);
        mxg_bindings_destroy(bindings);
        mxg_scene_destroy(scene);
        mxg_document_destroy(before);
        mxg_document_destroy(after);
        mxg_context_destroy(context);
        REQUIRE_EQ(heap.held, 0);
        REQUIRE_EQ(heap.wrong_sizes, 0);
    }
    REQUIRE_EQ(status, MXG_OK);
}

int main(void)
{
    mxg_context *context = NULL;
    REQUIRE(mxg_context_create(NULL, &context) == MXG_OK);
    test_primitives(context);
    test_bindings_of_scene(context);
    test_plain_names(context);
    test_changes(context);
    test_scene_changes(context, false);
    test_scene_changes(context, true);
    test_removals(context, false);
    test_removals(context, true);
    test_stale(context);
    for (uint32_t seed = 1; seed <= 60; seed++)
        test_random(context, seed);
    mxg_context_destroy(context);
    test_memory();
    return test_report("bind_again");
}
