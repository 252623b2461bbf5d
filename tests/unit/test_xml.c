// SPDX-License-Identifier: Apache-2.0
/*
 * From XML text to elements: places, encodings, what is tolerated, what is refused, includes,
 * running out of memory.
 */
#include "document_fixture.h"

#define ROOT "<materialx version=\"1.39\">"

static struct diag_place place_of(struct fixture *f, const char *path, str_id attr)
{
    return doc_attr_place(&f->doc, doc_find(&f->doc, path, strlen(path)), attr);
}

static void test_places(void)
{
    struct fixture f;
    fixture_read(&f,
                 "<?xml version=\"1.0\"?>\n"
                 "<!-- h\xc3\xa4user <a b='c'> -->\n"
                 "<materialx version=\"1.39\">\n"
                 "  <constant name=\"\xc3\xa4\xc3\xb6\xf0\x9f\x98\x80\" doc='a &lt; \"b\"&#10;' "
                 "type=\"float\"><input name=\"value\"\n"
                 "     type = \"float\"\r\n"
                 "  value='0.5'/></constant>\n"
                 "</materialx>\n",
                 NULL);
    REQUIRE(f.read);
    REQUIRE_EQ(doc_place(&f.doc, f.doc.root).line, 3);
    const char *path = "\xc3\xa4\xc3\xb6\xf0\x9f\x98\x80/value";
    struct diag_place value = place_of(&f, path, STR_value), type = place_of(&f, path, STR_type);
    struct diag_place input = place_of(&f, path, STR_EMPTY),
                      doc = place_of(&f, "\xc3\xa4\xc3\xb6\xf0\x9f\x98\x80", STR_doc);
    REQUIRE_STR(value.file, "test.mtlx");
    REQUIRE_EQ(input.line, 4);
    REQUIRE_EQ(input.column, 59);
    REQUIRE_EQ(type.line, 5);
    REQUIRE_EQ(type.column, 14);
    REQUIRE_EQ(value.line, 6);
    REQUIRE_EQ(value.column, 10);
    REQUIRE_EQ(doc.column, 29);
    str_id text = doc_attr_value(&f.doc, doc_element(&f.doc, f.doc.root)->first_child, STR_doc);
    REQUIRE_STR(str_text(&f.strings, text), "a < \"b\"\n");
    fixture_close(&f);
}

static void test_everything_is_kept(void)
{
    REQUIRE_TREE(
        ROOT "<a:b name=\"n\" my:x=\"1\" xmlns:my=\"urn:y\" "
             "unknown=\"&amp;\"><strange/></a:b></materialx>",
        NULL,
        "<a:b name=\"n\" my:x=\"1\" xmlns:my=\"urn:y\" unknown=\"&amp;\">\n  <strange/>\n</a:b>\n");
}

static void test_refused(void)
{
    REQUIRE_MESSAGES("", NULL, "1:1 file-empty");
    REQUIRE_MESSAGES(" \n ", NULL, "1:1 file-empty");
    REQUIRE_MESSAGES("hello", NULL, "1:1 xml-not-xml");
    REQUIRE_MESSAGES("{\"a\": 1}", NULL, "1:1 xml-not-xml");
    REQUIRE_MESSAGES("<html><a/></html>", NULL, "1:1 xml-root");
    REQUIRE_MESSAGES("<!DOCTYPE materialx [<!ENTITY a \"b\">]>\n" ROOT "</materialx>", NULL,
                     "1:21 xml-doctype");
    REQUIRE_MESSAGES(ROOT "\n<nodegraph name=\"g\">\n", NULL, "3:1 xml-truncated");
    REQUIRE_MESSAGES(ROOT "\n<nodegraph name=\"g\"", NULL, "2:20 xml-truncated");
    REQUIRE_MESSAGES(ROOT "\n<a></b></materialx>", NULL, "2:8 xml-syntax");
    REQUIRE_MESSAGES(ROOT "<a x=\"1\" x=\"2\"/></materialx>", NULL, "1:41 xml-syntax");
    REQUIRE_MESSAGES(ROOT "<a>this & that</a></materialx>", NULL,
                     "1:27 xml-stray-text, 1:36 xml-syntax");
    REQUIRE_MESSAGES(ROOT "<a x=\"\xff\"/></materialx>", NULL, "1:33 xml-encoding");
    REQUIRE_MESSAGES("<?xml version=\"1.0\" encoding=\"klingon\"?>" ROOT "</materialx>", NULL,
                     "1:1 xml-unknown-encoding");
    REQUIRE_MESSAGES(ROOT "</materialx>" ROOT "</materialx>", NULL, "1:39 xml-syntax");
}

static void test_tolerated(void)
{
    REQUIRE_MESSAGES(ROOT "<input file=\"a.<UDIM>.<b>.png\"/></materialx>", NULL,
                     "1:42 xml-raw-less-than, 1:49 xml-raw-less-than");
    REQUIRE_TREE(ROOT "<a b=\"x < y\"/></materialx>", NULL, "<a b=\"x &lt; y\"/>\n");
    /* a quote is missing */
    REQUIRE_MESSAGES(ROOT "<a b=\"c/>\n<d e=\"f\"/></materialx>", NULL, "2:1 xml-syntax");
    REQUIRE_TREE(ROOT "<a b=\"<x> & &y; &amp;\x7f\"/></materialx>", NULL,
                 "<a b=\"&lt;x&gt; &amp; &amp;y; &amp;\x7f\"/>\n");
    REQUIRE_MESSAGES(ROOT "<a b='x && y'/></materialx>", NULL,
                     "1:35 xml-raw-ampersand, 1:36 xml-raw-ampersand");
    /* no byte can stand in */
    REQUIRE_MESSAGES(ROOT "<a b=\"<x>\x7f`~^|$%@*{}[]+\\\"/></materialx>", NULL, "1:33 xml-syntax");
    REQUIRE_MESSAGES("\xef\xbb\xbf" ROOT "<a/></materialx>", NULL, "1:1 xml-byte-order-mark");
    REQUIRE_MESSAGES("\n\n<?xml version=\"1.0\"?>\n" ROOT "<a></materialx>", NULL,
                     "1:1 xml-text-before-declaration, 4:42 xml-syntax");
    REQUIRE_MESSAGES("Licence: none\n" ROOT "</materialx>", NULL,
                     "1:1 xml-text-before-declaration");
    REQUIRE_MESSAGES("<!-- -->\n<?xml version=\"1.0\"?>\n" ROOT "</materialx>", NULL,
                     "1:1 xml-text-before-declaration");
    REQUIRE_MESSAGES("<!-- -->\n" ROOT "</materialx>", NULL, "");
    REQUIRE_MESSAGES(ROOT "</materialx>\"", NULL, "1:39 xml-text-after-root");
    REQUIRE_MESSAGES(ROOT "stray <a/> text</materialx>", NULL, "1:1 xml-stray-text");
    REQUIRE_MESSAGES("<materialx></materialx>", NULL, "1:1 version-missing");
    REQUIRE_MESSAGES("<materialx version=\"2.0\"></materialx>", NULL, "1:21 version-newer");
    REQUIRE_MESSAGES("<materialx version=\"new\"></materialx>", NULL, "1:21 version-bad");
}

/* Text of ASCII as UTF-16. */
static size_t encode_utf16(const char *text, bool big_endian, bool mark, char *out)
{
    size_t n = 0, high = big_endian ? 0 : 1;
    if (mark) {
        out[high] = '\xfe';
        out[1 - high] = '\xff';
        n = 2;
    }
    for (; *text; text++, n += 2) {
        out[n + high] = 0;
        out[n + 1 - high] = *text;
    }
    return n;
}

static void test_encodings(void)
{
    const char *text =
        "<?xml version=\"1.0\" encoding=\"UTF-16\"?>\n" ROOT "<a name=\"b\"/></materialx>";
    for (int variant = 0; variant < 4; variant++) {
        char bytes[512];
        struct fixture f;
        fixture_init(&f);
        fixture_read_bytes(&f, bytes, encode_utf16(text, variant & 1, variant & 2, bytes), NULL);
        REQUIRE_STR(fixture_messages(&f), "");
        REQUIRE_EQ(doc_place(&f.doc, doc_find(&f.doc, "b", 1)).column, 27);
        fixture_close(&f);
    }
    struct fixture f;
    fixture_init(&f);
    fixture_read_bytes(&f, "\xff\xfe<\0\0\xd8<\0", 8, NULL); /* half a surrogate pair */
    REQUIRE_STR(fixture_messages(&f), "1:1 xml-encoding");
    fixture_close(&f);
    REQUIRE_TREE("<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>" ROOT
                 "<a b=\"\xe4\"/></materialx>",
                 NULL, "<a b=\"\xc3\xa4\"/>\n");
}

static void test_limits(void)
{
    struct xml_limits limits = {.max_depth = 3, .max_elements = 5};
    static const struct {
        const char *text, *messages;
    } cases[] = {
        {ROOT "<a><b/></a></materialx>", ""},
        {ROOT "<a><b><c/></b></a></materialx>", "1:33 xml-depth"},
        {ROOT "<a/><a/><a/><a/><a/></materialx>", "1:43 too-many-elements"},
        {ROOT "<template vars=\"t\" rows=\"a; b; c; d; e; f\"><@t@/></template></materialx>",
         "1:70 xml-syntax"},
        {ROOT "<template vars=\"t\" rows=\"a; b; c; d; e; f\"><x/></template></materialx>",
         "1:1 too-many-elements"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct fixture f;
        fixture_init(&f);
        fixture_read_bytes(&f, cases[i].text, strlen(cases[i].text), &limits);
        REQUIRE_STR(fixture_messages(&f), cases[i].messages);
        fixture_close(&f);
    }
}

#define XI "<materialx version=\"1.39\" xmlns:xi=\"http://www.w3.org/2001/XInclude\">"

static const struct fixture_file files[] = {
    {"a.mtlx", "<materialx version=\"1.39\" colorspace=\"acescg\" fileprefix=\"p/\"><c "
               "name=\"one\"/><c name=\"two\" fileprefix=\"\"/></materialx>"},
    {"nested.mtlx", XI "<xi:include href=\"a.mtlx\"/><c name=\"three\"/></materialx>"},
    {"loop.mtlx", XI "<xi:include href=\"loop2.mtlx\"/></materialx>"},
    {"loop2.mtlx", XI "<xi:include href=\"loop.mtlx\"/></materialx>"},
    {"broken.mtlx", ROOT "<c>"},
    {"old.mtlx", "<materialx version=\"1.37\"><atan2 name=\"x\" type=\"float\"><parameter "
                 "name=\"in1\"/></atan2></materialx>"},
    {NULL, NULL},
};

static void test_includes(void)
{
    REQUIRE_TREE(XI "<c name=\"zero\"/><xi:include href=\"a.mtlx\"/><c name=\"last\"/></materialx>",
                 files,
                 "<c name=\"zero\"/>\n"
                 "<c name=\"one\" colorspace=\"acescg\" fileprefix=\"p/\"/>\n"
                 "<c name=\"two\" fileprefix=\"\" colorspace=\"acescg\"/>\n"
                 "<c name=\"last\"/>\n");
    REQUIRE_TREE(XI "<xi:include href=\"nested.mtlx\"/><xi:include href=\"a.mtlx\"/></materialx>",
                 files,
                 "<c name=\"one\" colorspace=\"acescg\" fileprefix=\"p/\"/>\n"
                 "<c name=\"two\" fileprefix=\"\" colorspace=\"acescg\"/>\n"
                 "<c name=\"three\"/>\n");
    REQUIRE_TREE(XI "<atan2 name=\"y\" type=\"float\"><input name=\"iny\"/></atan2><xi:include "
                    "href=\"old.mtlx\"/></materialx>",
                 files,
                 "<atan2 name=\"y\" type=\"float\">\n  <input name=\"iny\"/>\n</atan2>\n"
                 "<atan2 name=\"x\" type=\"float\">\n  <input name=\"inx\"/>\n</atan2>\n");
    REQUIRE_TREE(XI "<xi:include href=\"none\"><xi:fallback><d/><xi:include "
                    "href=\"a.mtlx\"/></xi:fallback></xi:include></materialx>",
                 files,
                 "<d/>\n<c name=\"one\" colorspace=\"acescg\" fileprefix=\"p/\"/>\n"
                 "<c name=\"two\" fileprefix=\"\" colorspace=\"acescg\"/>\n");
    REQUIRE_TREE(XI "<xi:include href=\"nested.mtlx\"><xi:fallback><xi:include "
                    "href=\"none\"/></xi:fallback></xi:include></materialx>",
                 NULL, "");
}

static void test_bad_includes(void)
{
    REQUIRE_MESSAGES(XI "\n<xi:include href=\"none.mtlx\"/></materialx>", files,
                     "2:19 include-missing");
    REQUIRE_MESSAGES(XI "\n<xi:include/></materialx>", files, "2:1 include-no-href");
    REQUIRE_MESSAGES(XI "\n<xi:include href=\"a.mtlx\" parse=\"text\"/></materialx>", files,
                     "2:1 include-part");
    REQUIRE_MESSAGES(XI "\n<xi:include href=\"a.mtlx\" xpointer=\"x\"/></materialx>", files,
                     "2:1 include-part");
    REQUIRE_MESSAGES(
        XI "\n<xi:include href=\"loop.mtlx\"/></materialx>", files,
        "loop2.mtlx:1:88 include-cycle, loop.mtlx:1:70 include-from, 2:1 include-from");
    REQUIRE_MESSAGES(XI "\n<xi:include href=\"broken.mtlx\"/></materialx>", files,
                     "broken.mtlx:1:30 xml-truncated, 2:1 include-from");
    REQUIRE_MESSAGES(ROOT "\n<xi:include href=\"a.mtlx\"/></materialx>", files,
                     "2:1 xml-undeclared-prefix");
    REQUIRE_MESSAGES(XI "<xi:include href=\"test.mtlx\"/></materialx>",
                     ((const struct fixture_file[]){{"test.mtlx", "x"}, {NULL, NULL}}),
                     "1:88 include-cycle");
    struct fixture_file chain[40];
    char names[40][16], texts[40][128];
    for (int i = 0; i < 39; i++) {
        snprintf(names[i], sizeof names[i], "%d", i);
        snprintf(texts[i], sizeof texts[i], XI "<xi:include href=\"%d\"/></materialx>", i + 1);
        chain[i] = (struct fixture_file){names[i], texts[i]};
    }
    chain[39] = (struct fixture_file){NULL, NULL};
    struct fixture f;
    fixture_read(&f, XI "<xi:include href=\"0\"/></materialx>", chain);
    REQUIRE(!f.read);
    REQUIRE_EQ(f.diags.items.items[0].id, DIAG_ID_include_depth);
    fixture_close(&f);
}

static void test_files(void)
{
    struct fixture f;
    fixture_init(&f);
    f.files = files;
    struct xml_files access = {&f, fixture_open_file, fixture_release};
    strpool_init(&f.strings, &f.arena, NULL);
    diag_list_init(&f.diags, &f.arena);
    doc_init(&f.doc, &f.arena, &f.strings, NULL);
    REQUIRE(xml_read_file(&f.doc, &access, NULL, "a.mtlx", &f.diags));
    REQUIRE(xml_read_file(&f.doc, &access, NULL, "old.mtlx", &f.diags)); /* joins the first */
    REQUIRE(doc_find(&f.doc, "one", 3) && doc_find(&f.doc, "x/inx", 5));
    REQUIRE(!xml_read_file(&f.doc, &access, NULL, "none.mtlx", &f.diags));
    REQUIRE_STR(fixture_messages(&f), "none.mtlx:0:0 file-missing");
    fixture_close(&f);
}

static bool read_with_little_memory(size_t used_before, size_t allocations)
{
    const char *text = XI
        "<xi:include href=\"nested.mtlx\"/><xi:include href=\"old.mtlx\"/>"
        "<template vars=\"t\" rows=\"a; b\"><c name=\"@t@\"/></template><a b=\"<c>\"/></materialx>";
    struct fixture f;
    fixture_init(&f);
    f.files = files;
    volatile bool done = false;
    if (setjmp(f.trap.place) == 0) {
        for (size_t used = 0; used < used_before; used += 64)
            arena_alloc(&f.arena, 64);
        f.allocations_left = allocations;
        fixture_read_bytes(&f, text, strlen(text), NULL);
        REQUIRE_STR(fixture_messages(&f), "1:194 xml-raw-less-than");
        done = true;
    }
    fixture_close(&f);
    return done;
}

/*
 * Memory runs out at every allocation, and, as arenas take it in large pieces, with their first
 * piece used up to many different points: nothing leaks, and files are closed.
 */
static void test_memory(void)
{
    for (size_t used = 0; used < 16 << 10; used += 64) {
        size_t allocations = 0;
        while (!read_with_little_memory(used, allocations))
            allocations++;
    }
}

/* One read grows linearly with the number of elements and with their depth below one parent. */
static void test_size(void)
{
    enum { NODES = 50000 };
    struct fixture f;
    fixture_init(&f);
    struct text text;
    text_init(&text, &f.arena);
    text_str(&text, ROOT);
    for (unsigned i = 0; i < NODES; i++)
        text_fmt(&text,
                 "\n<add name=\"n%u\" type=\"float\"><input name=\"in1\" type=\"float\" "
                 "nodename=\"n%u\"/></add>",
                 i, i - 1);
    text_str(&text, "</materialx>");
    fixture_read_bytes(&f, text.data, text.len, NULL);
    REQUIRE(f.read);
    REQUIRE_EQ(doc_place(&f.doc, doc_find(&f.doc, "n49999", 6)).line, NODES + 1);
    fixture_close(&f);
}

int main(void)
{
    xml_startup();
    test_places();
    test_everything_is_kept();
    test_refused();
    test_tolerated();
    test_encodings();
    test_limits();
    test_includes();
    test_bad_includes();
    test_files();
    test_memory();
    test_size();
    return test_report("xml");
}
