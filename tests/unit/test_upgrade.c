// SPDX-License-Identifier: Apache-2.0
/* Documents of earlier versions, and what they become. */
#include "cases.h"
#include "document_fixture.h"

/* "VERSION": what a document of a version becomes. */
static void upgrades(const struct test_case *c)
{
    struct fixture f;
    fixture_init(&f);
    struct text text;
    text_init(&text, &f.arena);
    text_fmt(&text, "<materialx version=\"%s\">%s</materialx>", c->words, c->in);
    fixture_read_bytes(&f, text.data, text.len, NULL);
    REQUIRE_STR(fixture_tree(&f), c->out);
    REQUIRE_STR(str_text(&f.strings, doc_attr_value(&f.doc, f.doc.root, STR_version)), "1.39");
    fixture_close(&f);
}

static void test_remarks(void)
{
    struct fixture f;
    fixture_read(&f,
                 "<materialx version=\"1.38\">\n<atan2 name=\"a\">\n<input "
                 "name=\"in1\"/></atan2></materialx>",
                 NULL);
    REQUIRE_EQ(f.diags.items.len, 1);
    REQUIRE_EQ(f.diags.items.items[0].id, DIAG_ID_upgraded);
    REQUIRE_EQ(f.diags.items.items[0].place.line, 3);
    REQUIRE_STR(f.diags.items.items[0].message, "1.39: input 'in1' is now 'iny'");
    fixture_close(&f);
}

/* Memory runs out at many different points of an upgrade: nothing leaks. */
static void test_memory(void)
{
    const char *text = "<materialx version=\"1.37\"><material name=\"M\"><shaderref name=\"S\" "
                       "node=\"s\"/></material>"
                       "<conductor_brdf name=\"a\"><input name=\"edge_color\"/></conductor_brdf>"
                       "<dielectric_brdf name=\"b\"><input name=\"base\" nodename=\"a\" "
                       "channels=\"r\"/></dielectric_brdf></materialx>";
    for (volatile size_t used = 0; used < 16 << 10; used += 64) {
        struct fixture f;
        fixture_init(&f);
        if (setjmp(f.trap.place) == 0) {
            for (size_t n = 0; n < used; n += 64)
                arena_alloc(&f.arena, 64);
            f.allocations_left = 1; /* for the reader's own arena */
            fixture_read_bytes(&f, text, strlen(text), NULL);
        }
        fixture_close(&f);
    }
}

/* The argument is the path of upgrade.txt. */
int main(int argc, char **argv)
{
    xml_startup();
    test_cases(argc > 1 ? argv[1] : NULL, upgrades);
    test_remarks();
    test_memory();
    return test_report("upgrade");
}
