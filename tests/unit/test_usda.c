// SPDX-License-Identifier: Apache-2.0
/* Text layers of USD: what parses, and where the faults are. */
#include "base/trap.h"
#include "usda/usda.h"
#include "test.h"

#include <stdlib.h>

#define HEAD "#usda 1.0\n"

static const struct layer {
    const char *text;
    uint32_t line, column; /* of the fault; 0: there is none */
} layers[] = {
    {HEAD, 0, 0},
    {"#usda 1.0", 0, 0},
    {HEAD "( )", 0, 0},
    {HEAD "(\n  \"\"\"doc\n of lines\"\"\"\n  customLayerData = { string a = \"x\"; dictionary b = "
          "{ int c = 1 } }\n)",
     0, 0},
    {HEAD "def \"a\" {}\ndef Mesh \"b\" { }", 0, 0},
    {HEAD "def Mesh \"b\"\n(\n kind = \"group\"\n)\n{\n}\n", 0, 0},
    {HEAD "def \"a\" { int x; int y = 1; float[] z = [1, -2.5e-3, .5, inf, -inf, nan] }", 0, 0},
    {HEAD "def \"a\" { custom uniform token t = \"x\" ( doc = 'd' ) }", 0, 0},
    {HEAD "def \"a\" { matrix4d m = ( (1, 0), (0, 1) ) }", 0, 0},
    {HEAD "def \"a\" { double x.timeSamples = { 0: 1, 1.5: None, } }", 0, 0},
    {HEAD "def \"a\" { color3f inputs:c.connect = </a/b.outputs:c> }", 0, 0},
    {HEAD "def \"a\" { asset f = @a b.png@; asset[] g = [@@@x@@@, @y@] }", 0, 0},
    {HEAD "def \"a\" { rel r; rel s = None; prepend rel t = [</a>, </b>]; delete rel u = </c> }", 0,
     0},
    {HEAD "def \"a\" ( references = @x.usda@</b> (offset = 1) ) {}", 0, 0},
    {HEAD "def \"a\" { def \"b\" {}\n int x = 1 }", 0, 0},
    {HEAD "def \"a\" { variantSet \"v\" = { \"x\" { int y = 1\n def \"c\" {} }\n \"z\" ( kind = "
          "\"a\" ) {} } }",
     0, 0},
    {HEAD "def \"a\" { reorder nameChildren = [\"b\", \"c\"]\n reorder properties = [\"d\"] }", 0,
     0},
    {HEAD "reorder rootPrims = [\"b\", \"a\"]\ndef \"a\" {}", 0, 0},
    {HEAD "# comment\n/* and\n one */ def \"a\" {} // end", 0, 0},
    {HEAD "def \"a\" { string s = 'it\\'s'; string t = '''\n'x'\n''' }", 0, 0},
    {"", 1, 1},
    {"PXR-USDC", 1, 1},
    {"#usda 2.0\ndef \"a\" {}", 1, 7},
    {"#usda 1.0.1\n", 1, 7},
    {"\xef\xbb\xbf" HEAD "def \"a\" {}", 0, 0},
    {"\xef\xbb\xbf" HEAD "def a {}", 2, 7},
    {HEAD "def \"a\" { float[] z = [-nan] }", 0, 0},
    {HEAD "def \"a\" { variantSet \"v\" = { \"x\" { def \"c\" {} }\n \"z\" { def \"c\" {} } } }", 0,
     0},
    {HEAD "def a {}", 2, 7},
    {HEAD "def \"1a\" {}", 2, 5},
    {HEAD "def \"a b\" {}", 2, 5},
    {HEAD "def \"a\" {", 2, 10},
    {HEAD "def \"a\" {}\n}", 3, 1},
    {HEAD "def \"a\" { int x = }", 2, 19},
    {HEAD "def \"a\" { int x = [1, 2 }", 2, 25},
    {HEAD "def \"a\" { int x = [(1, 2] }", 2, 25},
    {HEAD "def \"a\" { string s = \"x\n\" }", 2, 22},
    {HEAD "def \"a\" { rel r = </a\n }", 2, 19},
    {HEAD "def \"a\" { asset f = @x\n }", 2, 21},
    {HEAD "def \"a\" ( kind ) {}", 2, 16},
    {HEAD "def \"a\" ( a = 1 b = 2 ) {}", 2, 17},
    {HEAD "int x = 1", 2, 1},
    {HEAD "def \"\xc3\xa4\" { int x = - }", 2, 19},
    {HEAD "def \"a\" { variantSet \"v\" = { x } }", 2, 30},
};

struct fixture {
    struct mem mem;
    struct arena arena;
    struct diag_list diags;
    struct trap trap;
};

static void start(struct fixture *f)
{
    mem_init(&f->mem, NULL, NULL);
    f->mem.trap = &f->trap;
    arena_init(&f->arena, &f->mem);
    diag_list_init(&f->diags, &f->arena);
}

/* Reads a copy whose end is the end of a block, so that a sanitizer sees a read behind it. */
static bool read_copy(struct fixture *f, struct usda_layer *layer, const char *text, size_t len)
{
    char *copy = malloc(len ? len : 1);
    memcpy(copy, text, len);
    bool good = usda_read(layer, "x.usda", copy, len, 1000000, &f->arena, &f->diags);
    free(copy);
    return good;
}

static void test_layers(void)
{
    for (size_t i = 0; i < sizeof layers / sizeof *layers; i++) {
        struct fixture f;
        struct usda_layer layer;
        if (setjmp(f.trap.place))
            return;
        start(&f);
        bool good = read_copy(&f, &layer, layers[i].text, strlen(layers[i].text));
        bool as_expected = REQUIRE_EQ(good, layers[i].line == 0)
                           && REQUIRE_EQ(f.diags.items.len, layers[i].line != 0);
        if (as_expected && !good)
            as_expected = REQUIRE_EQ(f.diags.items.items[0].place.line, layers[i].line)
                          && REQUIRE_EQ(f.diags.items.items[0].place.column, layers[i].column);
        if (!as_expected)
            printf("    of: %s\n    %s\n", layers[i].text,
                   f.diags.items.len ? f.diags.items.items[0].message : "");
        arena_finish(&f.arena);
    }
}

static const char marks[] = "\"<[)}\n\x80";

/* Reads the text up to a byte, and with other bytes there; false: out of memory. */
static bool damage(const char *text, size_t len, size_t at)
{
    struct fixture f;
    struct usda_layer layer;
    char damaged[1024];
    if (setjmp(f.trap.place))
        return false;
    start(&f);
    read_copy(&f, &layer, text, at);
    memcpy(damaged, text, len);
    for (const char *mark = marks; *mark; mark++) {
        damaged[at] = *mark;
        read_copy(&f, &layer, damaged, len);
    }
    bool is_bounded = f.diags.num_errors <= sizeof marks;
    arena_finish(&f.arena);
    return is_bounded;
}

/* A file that ends anywhere, or has any byte changed, is read without a crash. */
static void test_damage(void)
{
    for (size_t i = 0; i < sizeof layers / sizeof *layers; i++)
        for (size_t len = strlen(layers[i].text), at = 0; at < len; at++)
            REQUIRE(damage(layers[i].text, len, at));
}

static void test_nesting(void)
{
    enum { DEPTH = 100000 };
    struct fixture f;
    struct usda_layer layer;
    struct text text;
    if (setjmp(f.trap.place))
        return;
    start(&f);
    text_init(&text, &f.arena);
    for (int extra = 0; extra < 2; extra++) {
        text.len = 0;
        text_str(&text, HEAD);
        for (int i = 0; i < USDA_MAX_DEPTH + extra; i++)
            text_str(&text, "def \"a\" {");
        for (int i = 0; i < USDA_MAX_DEPTH + extra; i++)
            text_char(&text, '}');
        REQUIRE_EQ(usda_read(&layer, "deep.usda", text.data, text.len, 1000000, &f.arena, &f.diags),
                   !extra);
        REQUIRE(extra || layer.prims.len == USDA_MAX_DEPTH + 1);
    }
    text.len = 0;
    text_str(&text, HEAD "def \"a\" { int x = ");
    for (int i = 0; i < DEPTH; i++)
        text_char(&text, '[');
    REQUIRE(!usda_read(&layer, "deep.usda", text.data, text.len, 1000000, &f.arena, &f.diags));
    arena_finish(&f.arena);
}

static void test_queries(void)
{
    static const char text[] = HEAD "( defaultPrim = \"a\" )\n"
                                    "def Xform \"a\" ( references = </p> ) {\n"
                                    "  rel r = [</x>, </y/z>] ( bindMaterialAs = \"weaker\" )\n"
                                    "  token[] t = [\"one\", 'two']\n"
                                    "  over \"b\" ( payload = @x@ ) {} }";
    struct fixture f;
    struct usda_layer layer;
    struct text_word rest, item;
    if (setjmp(f.trap.place))
        return;
    start(&f);
    REQUIRE(usda_read(&layer, "q.usda", text, strlen(text), 1000000, &f.arena, &f.diags));
    usda_prim_id a = usda_find(&layer, "/a", 2), b = usda_find(&layer, "/a/b", 4);
    REQUIRE(a && b && !usda_find(&layer, "/a/c", 4));
    REQUIRE(usda_is(layer.default_prim, "a"));
    REQUIRE(usda_is(layer.prims.items[a].type, "Xform"));
    REQUIRE_EQ(layer.prims.items[b].specifier, USDA_OVER);
    REQUIRE(usda_is(layer.prims.items[b].arc, "payload"));
    REQUIRE(usda_is(layer.prims.items[a].references, "</p>"));
    const struct usda_property *r = usda_find_property(&layer, &layer.prims.items[a], "r");
    REQUIRE(usda_is(r->bind_as, "weaker") && usda_is(r->type, "rel"));
    rest = r->value;
    REQUIRE(usda_next_item(&rest, &item) && usda_is(item, "/x"));
    REQUIRE(usda_next_item(&rest, &item) && usda_is(item, "/y/z"));
    REQUIRE(!usda_next_item(&rest, &item));
    rest = usda_find_property(&layer, &layer.prims.items[a], "t")->value;
    REQUIRE(usda_next_item(&rest, &item) && usda_is(item, "one"));
    REQUIRE(usda_next_item(&rest, &item) && usda_is(item, "two"));
    REQUIRE(!usda_find_property(&layer, &layer.prims.items[a], "s"));
    arena_finish(&f.arena);
}

/* Prims and properties of equal names, in different orders, and the limit of elements. */
static void test_names(void)
{
    static const char text[] = HEAD "def \"a\" {\n"
                                    "  float x\n  def \"b\" { int of = 1 }\n  float x = 1\n"
                                    "  float y.timeSamples = { 1: 2 }\n  float x = 3\n"
                                    "  float z.timeSamples = { 1: 4 }\n  float z\n"
                                    "  def \"b\" { int of = 2 }\n  float y = 5\n }\n"
                                    "def \"a\" { float x = 6 }\n";
    static const struct {
        const char *name, *value;
        bool is_property; /* also without samples */
    } names[] = {
        {"x", "1", true}, {"y", "5", true}, {"z", "4 ", true}, {"z.timeSamples", "4 ", true}};
    struct fixture f;
    struct usda_layer layer;
    if (setjmp(f.trap.place))
        return;
    start(&f);
    REQUIRE(usda_read(&layer, "n.usda", text, strlen(text), 16, &f.arena, &f.diags));
    const struct usda_prim *a = &layer.prims.items[usda_find(&layer, "/a", 2)];
    REQUIRE_EQ(a->num_properties, 7);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const struct usda_property *found = usda_find_attribute(&layer, a, names[i].name);
        REQUIRE(found && usda_is(usda_value(found), names[i].value));
        REQUIRE((usda_find_property(&layer, a, names[i].name) != NULL) == names[i].is_property);
    }
    for (uint32_t i = a->first_property; i < usda_end_property(a); i++)
        REQUIRE(!usda_is(layer.properties.items[i].name, "of")); /* those of a prim are in a row */
    const struct usda_prim *b = &layer.prims.items[usda_find(&layer, "/a/b", 4)];
    REQUIRE(usda_is(usda_find_property(&layer, b, "of")->value, "1"));
    REQUIRE(!usda_find_property(&layer, b, "x"));
    REQUIRE(!usda_read(&layer, "n.usda", text, strlen(text), 14, &f.arena, &f.diags));
    arena_finish(&f.arena);
}

/* A value and time samples, in both orders: the value counts, and both have the metadata. */
static void test_samples(void)
{
    static const char text[] = HEAD "def \"a\" {\n"
                                    "  float x = 1 (interpolation = \"vertex\")\n"
                                    "  float x.timeSamples = { 0: 2 }\n"
                                    "  float y.timeSamples = { 0: 2 }\n"
                                    "  float y = 1 (interpolation = \"vertex\")\n"
                                    "  float z.timeSamples = { 10: 2, -1.5: (3), 0: None, }\n}\n";
    static const struct {
        const char *name, *value, *interpolation;
    } wanted[] = {{"x", "1", "vertex"},
                  {"y", "1", "vertex"},
                  {"x.timeSamples", "2 ", "vertex"},
                  {"y.timeSamples", "2 ", "vertex"},
                  {"z", "(3)", ""}};
    struct fixture f;
    struct usda_layer layer;
    if (setjmp(f.trap.place))
        return;
    start(&f);
    REQUIRE(usda_read(&layer, "t.usda", text, strlen(text), 16, &f.arena, &f.diags));
    const struct usda_prim *a = &layer.prims.items[usda_find(&layer, "/a", 2)];
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        const struct usda_property *found = usda_find_attribute(&layer, a, wanted[i].name);
        REQUIRE(found && usda_is(usda_value(found), wanted[i].value));
        REQUIRE(usda_is(found->interpolation, wanted[i].interpolation));
    }
    arena_finish(&f.arena);
}

int main(void)
{
    test_samples();
    test_names();
    test_layers();
    test_damage();
    test_nesting();
    test_queries();
    return test_report("usda");
}
