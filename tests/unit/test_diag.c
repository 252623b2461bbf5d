// SPDX-License-Identifier: Apache-2.0
/* Diagnostics: the catalogue, the list and its limit, rendering, suggestions. */
#include "diag/diag.h"

#include "test.h"

static struct mem mem;
static struct arena arena;

static struct diag_place at(uint32_t line, uint32_t column, uint32_t length)
{
    return (struct diag_place){"wood.mtlx", line, column, length};
}

static const char *render(const struct diag *diag, const char *line, bool colour)
{
    struct text text;
    text_init(&text, &arena);
    diag_render(diag, line, line ? strlen(line) : 0, colour, &text);
    return text_cstr(&text);
}

static bool has_flag(const char *text)
{
    for (const char *at = text; (at = strstr(at, "--")) != NULL; at += 2)
        if (at[2] >= 'a' && at[2] <= 'z' && (at - text < 7 || memcmp(at - 7, "usdcat ", 7) != 0))
            return true;
    return false;
}

/* A host has no command line: messages of the library name options by their keys. */
static void check_flags(const char *id, enum diag_id i)
{
    const struct diag_explanation *explanation = diag_explain(i);
    if (!REQUIRE(!has_flag(diag_id_format(i)) && !has_flag(explanation->cause)
                 && !has_flag(explanation->cure)))
        printf("    %s names a flag\n", id);
}

/*
 * Ids are distinct, lower-case words with hyphens; formats use what diag.h allows and say
 * something.
 */
static void test_catalogue(void)
{
    static const char *const formats[] = {
#define DIAG(id, severity, stable, format) format,
#include "diag/catalogue.def"
#undef DIAG
    };
    for (unsigned i = 0; i < DIAG_NUM_IDS; i++) {
        const char *id = diag_id_text((enum diag_id)i);
        if (!REQUIRE(strspn(id, "abcdefghijklmnopqrstuvwxyz-") == strlen(id)))
            printf("    %s\n", id);
        for (unsigned k = 0; k < i; k++)
            REQUIRE(strcmp(id, diag_id_text((enum diag_id)k)) != 0);
        REQUIRE(formats[i][0] != '\0' && !strchr(formats[i], '\n'));
        if (i < DIAG_ID_output_failed || i >= DIAG_ID_xml_not_xml) /* the others: of the programs */
            check_flags(id, (enum diag_id)i);
        for (const char *p = strchr(formats[i], '%'); p; p = strchr(p + 1, '%'))
            if (!REQUIRE(strchr("sud", p[1]) && p[1]))
                printf("    %s\n", formats[i]);
    }
}

static void test_list(void)
{
    struct diag_list list;
    diag_list_init(&list, &arena);
    char name[] = "wood.mtlx";
    diag_add(&list, DIAG_ID_unknown_node, (struct diag_place){name, 3, 5, 0}, "mux",
             " (did you mean 'mix'?)");
    diag_add(&list, DIAG_ID_defined_here, at(1, 1, 0), "mix");
    diag_add(&list, DIAG_ID_connected_here, at(2, 1, 0), "mix");
    diag_add(&list, DIAG_ID_version_missing, at(1, 1, 0));
    diag_add(&list, DIAG_ID_upgraded, at(1, 1, 0), "a node was renamed");
    name[0] = 'g'; /* the list has its own copy */
    REQUIRE_EQ(list.items.len, 5);
    REQUIRE_EQ(list.num_errors, 1);
    const struct diag *items = list.items.items;
    REQUIRE_STR(items[0].message, "unknown node <mux> (did you mean 'mix'?)");
    REQUIRE_EQ(items[0].num_arguments, 2);
    REQUIRE_STR(items[0].arguments[0], "mux");
    REQUIRE_STR(items[0].arguments[1], " (did you mean 'mix'?)");
    REQUIRE_EQ(items[3].num_arguments, 0);
    REQUIRE_STR(items[0].place.file, "wood.mtlx");
    REQUIRE_EQ(items[0].severity, DIAG_ERROR);
    REQUIRE_EQ(items[1].severity, DIAG_NOTE);
    REQUIRE_EQ(items[1].parent, 0);
    REQUIRE_EQ(items[2].parent, 0);
    REQUIRE_EQ(items[3].parent, 3);
    REQUIRE_EQ(items[3].severity, DIAG_WARNING);
    REQUIRE_EQ(items[4].severity, DIAG_REMARK);
    REQUIRE_EQ(items[4].parent, 4);
}

/* Numbers are texts, and a copy has its own. */
static void test_arguments(void)
{
    struct arena other;
    struct diag_list list, copies;
    arena_init(&other, &mem);
    diag_list_init(&list, &other);
    diag_list_init(&copies, &arena);
    diag_add(&list, DIAG_ID_index_out_of_range, at(1, 1, 0), -3, 4u, 3u);
    diag_repeat(&copies, &list.items.items[0]);
    arena_finish(&other);
    const struct diag *copy = &copies.items.items[0];
    REQUIRE_EQ(copy->num_arguments, 3);
    REQUIRE_STR(copy->arguments[0], "-3");
    REQUIRE_STR(copy->arguments[1], "4");
    REQUIRE_STR(copy->arguments[2], "3");
    /* a note that counts tells the newest number */
    diag_add(&copies, DIAG_ID_include_missing, at(1, 1, 0), "base.mtlx", "no such file");
    diag_add(&copies, DIAG_ID_unknown_node, at(2, 1, 0), "a", "");
    diag_add(&copies, DIAG_ID_unknown_node, at(3, 1, 0), "b", "");
    const struct diag *note = &copies.items.items[2];
    REQUIRE_EQ(note->id, DIAG_ID_consequences);
    REQUIRE_EQ(note->num_arguments, 3);
    REQUIRE_STR(note->arguments[0], "2");
    REQUIRE_STR(note->arguments[1], "s");
}

/* Puts messages of line 9 to the last line of the scope. */
static void move_away(void *user_data, struct diag_list *list)
{
    const uint32_t *line = user_data;
    if (list->items.items[list->last].place.line == 9)
        diag_move(list, at(*line, 1, 0));
}

/*
 * A list has what is the same at one place once, with its notes, and the limit counts it once. Two
 * messages that moved to two places are two.
 */
static void test_repeated(void)
{
    struct diag_list list;
    uint32_t line = 20;
    diag_list_init(&list, &arena);
    list.max_errors = 2;
    list.trace = move_away;
    list.trace_data = &line;
    for (unsigned i = 0; i < 3; i++) {
        diag_add(&list, DIAG_ID_cycle, at(1, 1, 0), "a, b, a");
        diag_add(&list, DIAG_ID_connected_here, at(2, 1, 0), "a");
        diag_add(&list, DIAG_ID_version_missing, at(1, 1, 0));
    }
    REQUIRE_EQ(list.items.len, 3);
    REQUIRE_EQ(list.num_errors, 3);
    diag_add(&list, DIAG_ID_cycle, at(1, 1, 0), "a, c, a");
    diag_add(&list, DIAG_ID_version_missing, at(9, 1, 0));
    diag_add(&list, DIAG_ID_version_missing, at(9, 1, 0));
    line = 21;
    diag_add(&list, DIAG_ID_version_missing, at(9, 1, 0));
    REQUIRE_EQ(list.items.len, 6);
    const struct diag *items = list.items.items;
    REQUIRE_STR(items[3].message, "the graph has a cycle: a, c, a");
    REQUIRE_EQ(items[4].place.line, 20);
    REQUIRE_EQ(items[5].place.line, 21);
    REQUIRE_EQ(items[5].parent, 5);
}

/*
 * Errors beyond the limit are counted; they go with their notes, and one note says so. Warnings
 * still come.
 */
static void test_limit(void)
{
    struct diag_list list;
    diag_list_init(&list, &arena);
    list.max_errors = 2;
    for (unsigned i = 0; i < 5; i++) {
        diag_add(&list, DIAG_ID_cycle, at(i + 1, 1, 0), "a, b, a");
        diag_add(&list, DIAG_ID_connected_here, at(9, 1, 0), "a");
    }
    diag_add(&list, DIAG_ID_version_missing, at(1, 1, 0));
    REQUIRE_EQ(list.num_errors, 5);
    /* two errors, each with a note; the note about the rest; the warning */
    REQUIRE_EQ(list.items.len, 6);
    REQUIRE_STR(list.items.items[4].message, "more than 2 errors; the rest is not shown");
    REQUIRE_EQ(list.items.items[4].parent, 2);
    REQUIRE_EQ(list.items.items[5].id, DIAG_ID_version_missing);
}

static void test_text(void)
{
    struct diag diag = {
        .id = DIAG_ID_unknown_node, .message = "unknown node <mux>", .place = at(2, 3, 4)};
    static const char root[] = "<materialx>", line[] = "  <mux name='a'/>", end[] = "</materialx>";
    REQUIRE_STR(render(&diag, line, false),
                "wood.mtlx:2:3: error: unknown node <mux> [unknown-node]\n"
                "      <mux name='a'/>\n"
                "      ^~~~\n");
    REQUIRE_STR(render(&diag, NULL, false),
                "wood.mtlx:2:3: error: unknown node <mux> [unknown-node]\n");
    diag.place = at(1, 1, 0);
    REQUIRE_STR(render(&diag, root, false),
                "wood.mtlx:1:1: error: unknown node <mux> [unknown-node]\n"
                "    <materialx>\n"
                "    ^\n");
    REQUIRE_STR(render(&diag, root, true),
                "\x1b[1mwood.mtlx:1:1: \x1b[1;31merror: \x1b[0munknown node <mux> [unknown-node]\n"
                "    <materialx>\n"
                "    \x1b[1;32m^\x1b[0m\n");
    diag.place = at(0, 0, 0);
    REQUIRE_STR(render(&diag, root, false),
                "wood.mtlx: error: unknown node <mux> [unknown-node]\n");
    diag.place = (struct diag_place){0};
    REQUIRE_STR(render(&diag, root, false), "error: unknown node <mux> [unknown-node]\n");
    diag.place = at(1, 80, 1);
    REQUIRE_STR(render(&diag, root, false),
                "wood.mtlx:1:80: error: unknown node <mux> [unknown-node]\n");
    diag.severity = DIAG_NOTE;
    diag.place = at(3, 12, 9); /* the underline ends with the line */
    REQUIRE_STR(render(&diag, end, false), "wood.mtlx:3:12: note: unknown node <mux>\n"
                                           "    </materialx>\n"
                                           "               ^\n");
}

/*
 * Columns are code points; tabs stay tabs under tabs; escapes of the document do not reach the
 * terminal.
 */
static void test_columns(void)
{
    struct diag diag = {
        .id = DIAG_ID_unknown_node, .message = "evil \x1b[2J\xc2\x9b", .place = at(1, 7, 2)};
    REQUIRE_STR(render(&diag, "\t\xc3\xa4\xe2\x82\xac\t<\x1bxy", false),
                "wood.mtlx:1:7: error: evil ?[2J? [unknown-node]\n"
                "    \t\xc3\xa4\xe2\x82\xac\t<?xy\n"
                "    \t  \t  ^~\n");
    char line[400];
    memset(line, '-', sizeof line - 1);
    line[sizeof line - 1] = '\0';
    line[299] = 'X';
    diag.place = at(1, 300, 3);
    const char *shown = render(&diag, line, false);
    const char *second = strchr(shown, '\n') + 1, *third = strchr(second, '\n') + 1;
    REQUIRE(strncmp(second, "    ...---", 10) == 0);
    REQUIRE(third - second <= 180);
    REQUIRE_EQ(strchr(second, 'X') - second, strchr(third, '^') - third);
    diag.place = at(1, 1, 1);
    shown = render(&diag, line, false);
    REQUIRE(strstr(shown, "---...\n    ^\n") != NULL);
}

static const char *suggest(const char *word, const char *const *candidates, size_t count)
{
    struct diag_list list;
    diag_list_init(&list, &arena);
    return diag_suggest(&list, word, candidates, count);
}

/* Names that differ in a word or a number are no misspellings of each other. */
static void test_suggest_other_names(void)
{
    static const char *const inputs[] = {"fuzz_roughness", "base_diffuse_roughness", "node1", "c1"};
    static const char *const defs[] = {"ND_lama_surface", "ND_standard_surface_surfaceshader_100",
                                       "ND_standard_surface_surfaceshader"};
    REQUIRE_STR(suggest("base_roughness", inputs, 1), "");
    REQUIRE_STR(suggest("base_roughness", inputs, 4), " (did you mean 'base_diffuse_roughness'?)");
    REQUIRE_STR(suggest("node2", inputs, 4), "");
    REQUIRE_STR(suggest("s1", inputs, 4), "");
    REQUIRE_STR(suggest("1c", inputs, 4), " (did you mean 'c1'?)");
    REQUIRE_STR(suggest("node", inputs, 4), " (did you mean 'node1'?)");
    REQUIRE_STR(suggest("ND_standard_surface", defs, 1), "");
    REQUIRE_STR(suggest("ND_standard_surface", defs, 3),
                " (did you mean 'ND_standard_surface_surfaceshader'?)");
}

/* So that a document which is wrong throughout is reported in linear time. */
static void test_suggestions_end(void)
{
    struct diag_list list;
    const char *candidates[] = {"image"};
    unsigned given = 0;
    diag_list_init(&list, &arena);
    for (unsigned i = 0; i < 1000; i++)
        given += *diag_suggest(&list, "imge", candidates, 1) != '\0';
    REQUIRE(given > 0 && given < 100);
    REQUIRE(!diag_may_guess(&list));
}

static void test_suggest(void)
{
    static const char *const nodes[] = {"multiply", "mix",     "image", "standard_surface",
                                        "noise2d",  "noise3d", "Mix"};
    static const struct {
        const char *word, *suggestion;
    } cases[] = {
        {"mulitply", " (did you mean 'multiply'?)"}, /* a swap is one mistake */
        {"imge", " (did you mean 'image'?)"},
        {"standardsurface", " (did you mean 'standard_surface'?)"},
        {"STANDARD_SURFACE", " (did you mean 'standard_surface'?)"},
        {"noise4d", " (did you mean 'noise2d'?)"},
        {"max", " (did you mean 'mix'?)"},
        {"mix", " (did you mean 'Mix'?)"}, /* the word itself is no help */
        {"glossiness", ""},
        {"lerp", " (did you mean 'mix'?)"}, /* an alias */
        {"noise", " (did you mean 'noise2d'?)"},
        {"standard", " (did you mean 'standard_surface'?)"}, /* the beginning of a name */
        {"standard_surface_shader", " (did you mean 'standard_surface'?)"},
        {"noise2d1", " (did you mean 'noise2d'?)"},
        {"x", ""},
        {"", ""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        REQUIRE_STR(suggest(cases[i].word, nodes, sizeof nodes / sizeof *nodes),
                    cases[i].suggestion);
    char longest[300];
    memset(longest, 'a', sizeof longest - 1);
    longest[sizeof longest - 1] = '\0';
    const char *candidates[] = {longest};
    REQUIRE_STR(suggest(longest + 1, candidates, 1), "");
    REQUIRE_STR(suggest("aaaa", candidates, 1), "");
    REQUIRE_STR(suggest("aaaa", NULL, 0), "");
}

int main(void)
{
    mem_init(&mem, NULL, NULL);
    arena_init(&arena, &mem);
    test_catalogue();
    test_list();
    test_arguments();
    test_repeated();
    test_limit();
    test_text();
    test_columns();
    test_suggest();
    test_suggest_other_names();
    test_suggestions_end();
    arena_finish(&arena);
    REQUIRE_EQ(mem.used, 0);
    return test_report("diag");
}
