// SPDX-License-Identifier: Apache-2.0
/*
 * Large graphs: chains (each node reads the one before it) and diamonds (each reads the one before
 * it twice, so that there are 2^n paths) of up to a million nodes, definitions nested in
 * definitions, and limits. Everything must be generated, with a source that grows in proportion to
 * the graph. How many instructions that takes is measured by bench/.
 *
 *     test_growth [NODES]      the largest number of nodes; default 1,000,000
 */
#include <mxgen/mxgen.h>

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static unsigned passed, failed;

static void check(bool good, const char *what, size_t a, size_t b)
{
    ++*(good ? &passed : &failed);
    if (!good)
        printf("failed: %s (%zu, %zu)\n", what, a, b);
}

/* ---- Documents ---- */

struct text {
    char *data;
    size_t len, room;
};

static void add(struct text *text, const char *format, ...)
{
    char line[512];
    va_list args;
    va_start(args, format);
    int len = vsnprintf(line, sizeof line, format, args);
    va_end(args);
    if (text->len + sizeof line > text->room) {
        text->room = text->room * 2 + sizeof line;
        text->data = realloc(text->data, text->room);
        if (!text->data)
            exit(1);
    }
    memcpy(text->data + text->len, line, (size_t)len + 1);
    text->len += (size_t)len;
}

enum shape { CHAIN, DIAMOND, NUM_SHAPES };
static const char *const shape_names[NUM_SHAPES] = {"chain", "diamond"};

/* sin(position) over and over; in a diamond n_i = n_(i-1) + n_(i-1)², which no rule shortens. */
static void add_node(struct text *text, enum shape shape, unsigned i)
{
    if (shape == CHAIN)
        add(text,
            "<sin name=\"n%u\" type=\"vector3\"><input name=\"in\" type=\"vector3\" "
            "nodename=\"n%u\"/></sin>\n",
            i, i - 1);
    else
        add(text,
            "<%s name=\"n%u\" type=\"vector3\"><input name=\"in1\" type=\"vector3\" "
            "nodename=\"n%u\"/>"
            "<input name=\"in2\" type=\"vector3\" nodename=\"n%u\"/></%s>\n",
            i % 2 ? "multiply" : "add", i, i - 1, i - 1, i % 2 ? "multiply" : "add");
}

static struct text graph(enum shape shape, unsigned nodes)
{
    struct text text = {NULL, 0, 0};
    add(&text, "<materialx version=\"1.39\"><nodegraph name=\"NG\">\n<position name=\"n0\" "
               "type=\"vector3\"/>\n");
    for (unsigned i = 1; i <= nodes; ++i)
        add_node(&text, shape, i);
    add(&text, "<output name=\"out\" type=\"vector3\" nodename=\"n%u\"/></nodegraph></materialx>",
        nodes);
    return text;
}

/*
 * Each definition uses the one below it twice, with different arguments: inlined it would be
 * 2^depth nodes.
 */
static struct text nested(unsigned depth)
{
    struct text text = {NULL, 0, 0};
    add(&text, "<materialx version=\"1.39\">\n");
    for (unsigned i = 0; i <= depth; ++i) {
        add(&text,
            "<nodedef name=\"ND_d%u\" node=\"d%u\"><input name=\"in\" type=\"float\"/><output "
            "name=\"out\" type=\"float\"/></nodedef>"
            "<nodegraph name=\"NG_d%u\" nodedef=\"ND_d%u\">",
            i, i, i, i);
        if (i == 0)
            add(&text, "<sin name=\"sum\" type=\"float\"><input name=\"in\" type=\"float\" "
                       "interfacename=\"in\"/></sin>");
        else
            add(&text,
                "<d%u name=\"a\" type=\"float\"><input name=\"in\" type=\"float\" "
                "interfacename=\"in\"/></d%u>"
                "<d%u name=\"b\" type=\"float\"><input name=\"in\" type=\"float\" "
                "nodename=\"a\"/></d%u>"
                "<add name=\"sum\" type=\"float\"><input name=\"in1\" type=\"float\" "
                "nodename=\"a\"/>"
                "<input name=\"in2\" type=\"float\" nodename=\"b\"/></add>",
                i - 1, i - 1, i - 1, i - 1);
        add(&text, "<output name=\"out\" type=\"float\" nodename=\"sum\"/></nodegraph>\n");
    }
    add(&text,
        "<time name=\"t\" type=\"float\"/><d%u name=\"n\" type=\"float\"><input name=\"in\" "
        "type=\"float\" nodename=\"t\"/></d%u>"
        "<output name=\"out\" type=\"float\" nodename=\"n\"/></materialx>",
        depth, depth);
    return text;
}

/* ---- Generation ---- */

static bool has_id(const mxg_diagnostics *list, const char *id)
{
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); ++i) {
        mxg_diagnostic d = {sizeof d};
        mxg_diagnostics_item(list, i, &d);
        if (strcmp(d.id, id) == 0)
            return true;
    }
    return false;
}

static void print_first(const mxg_diagnostics *list)
{
    char line[1024] = "";
    if (mxg_diagnostics_num_items(list))
        mxg_diagnostics_format(list, 0, NULL, 0, false, line, sizeof line);
    printf("    %.1000s\n", line);
}

/*
 * Bytes of source of an element; 0: none. Errors are printed, except for `expected`, which must be
 * among them.
 */
static size_t generate(const struct text *text, const char *element, const mxg_context_desc *desc,
                       const char *expected)
{
    mxg_context *context = NULL;
    mxg_document *document = NULL;
    mxg_result *result = NULL;
    mxg_generate_desc how = MXG_GENERATE_DESC_INIT;
    how.target = "glsl";
    how.element = element;
    size_t size = 0;
    mxg_context_create(desc, &context);
    mxg_library *library = mxg_library_builtin(context);
    mxg_status status =
        mxg_document_parse(context, library, "growth.mtlx", text->data, text->len, &document);
    const mxg_diagnostics *list = mxg_document_diagnostics(document);
    if (status == MXG_OK) {
        status = mxg_generate(context, document, &how, &result);
        list = mxg_result_diagnostics(result);
        mxg_result_source(result, MXG_STAGE_PIXEL, &size);
    }
    if (expected)
        check(status == MXG_ERROR_DOCUMENT && has_id(list, expected), expected, (size_t)status,
              size);
    else if (status != MXG_OK)
        print_first(list);
    mxg_result_destroy(result);
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return size;
}

static void check_shape(enum shape shape, unsigned max_nodes)
{
    double first = 0;
    for (unsigned nodes = 1000; nodes <= max_nodes; nodes *= 10) {
        struct text text = graph(shape, nodes);
        size_t size = generate(&text, "NG/out", NULL, NULL);
        free(text.data);
        check(size > 0, shape_names[shape], nodes, size);
        /* Bytes per node: names get longer by a digit, no more. */
        if (nodes == 1000)
            first = (double)size / 1000;
        check((double)size / nodes <= first + 12, "source grows in proportion", nodes, size);
    }
}

static void check_nesting(void)
{
    size_t sizes[2];
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.max_nodes = 100000;
    for (unsigned i = 0; i < 2; ++i) {
        struct text text = nested(i ? 40 : 10);
        sizes[i] = generate(&text, "out", &desc, NULL);
        free(text.data);
    }
    check(sizes[0] > 0 && sizes[1] > 0 && sizes[1] < 8 * sizes[0], "definitions in definitions",
          sizes[0], sizes[1]);
    struct text deep = nested(2000);
    generate(&deep, "out", NULL, "graph-depth");
    free(deep.data);
}

static void check_limits(void)
{
    struct text text = graph(DIAMOND, 100000);
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.max_file_mib = 1;
    generate(&text, "NG/out", &desc, "file-too-large");
    desc = (mxg_context_desc)MXG_CONTEXT_DESC_INIT;
    desc.max_output_mib = 1;
    generate(&text, "NG/out", &desc, "output-limit");
    desc = (mxg_context_desc)MXG_CONTEXT_DESC_INIT;
    desc.max_nodes = 1000;
    generate(&text, "NG/out", &desc, "node-limit");
    desc = (mxg_context_desc)MXG_CONTEXT_DESC_INIT;
    desc.max_elements = 1000;
    generate(&text, "NG/out", &desc, "too-many-elements");
    free(text.data);
}

/* ---- Limits of documents ---- */

/* How many messages with this id a document gets when it is loaded. */
static unsigned count_messages(const struct text *text, const char *id)
{
    mxg_context *context = NULL;
    mxg_document *document = NULL;
    unsigned count = 0;
    mxg_context_create(NULL, &context);
    mxg_library *library = mxg_library_builtin(context);
    mxg_document_parse(context, library, "growth.mtlx", text->data, text->len, &document);
    const mxg_diagnostics *list = mxg_document_diagnostics(document);
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); ++i) {
        mxg_diagnostic diagnostic = {sizeof diagnostic};
        mxg_diagnostics_item(list, i, &diagnostic);
        count += strcmp(diagnostic.id, id) == 0;
    }
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return count;
}

/* `part`, in which %u is a number, may be repeated so many times. */
static const struct repeated {
    const char *what, *id, *before, *part, *after;
    unsigned most;
} repeated[] = {
    {"inputs", "too-many-ports", "<nodedef name='D' node='g'>",
     "<input name='i%u' type='float' value='0'/>", "<output name='out' type='float'/></nodedef>",
     1024},
    {"outputs", "too-many-ports", "<nodedef name='D' node='g'>",
     "<output name='o%u' type='float'/>", "</nodedef>", 64},
    {"attributes", "xml-attributes", "<constant ", "a%u='1' ", "/>", 1024},
    {"attributes with a quote and '>'", "xml-attributes", "<constant ", "a%u=\"'>\" ", "/>", 1024},
    {"definitions of a node", "too-many-variants", "",
     "<nodedef name='D%u' node='g'><output name='out' type='float'/></nodedef>", "", 256},
    {"implementations of a definition", "too-many-variants",
     "<nodedef name='D' node='g'><output name='out' type='float'/></nodedef>",
     "<implementation name='I%u' nodedef='D' sourcecode='1.0'/>", "", 256},
    {"implementations of a definition of the library", "too-many-variants", "",
     "<implementation name='I%u' nodedef='ND_sin_float' sourcecode='1.0'/>", "", 256},
};

static struct text repeat(const struct repeated *r, unsigned count)
{
    struct text text = {NULL, 0, 0};
    add(&text, "<materialx version='1.39'>%s", r->before);
    for (unsigned i = 0; i < count; ++i) {
        const char *number = strstr(r->part, "%u");
        add(&text, "%.*s%u%s", (int)(number - r->part), r->part, i, number + 2);
    }
    add(&text, "%s</materialx>", r->after);
    return text;
}

static void check_repeated(void)
{
    for (size_t i = 0; i < sizeof repeated / sizeof *repeated; ++i) {
        const struct repeated *r = &repeated[i];
        struct text most = repeat(r, r->most), more = repeat(r, r->most + 3);
        check(count_messages(&most, r->id) == 0, r->what, r->most, 0);
        check(count_messages(&more, r->id) == 1, r->what, r->most + 3, 1);
        free(most.data);
        free(more.data);
    }
}

int main(int argc, char **argv)
{
    unsigned max_nodes = argc > 1 ? (unsigned)strtoul(argv[1], NULL, 10) : 1000000;
    for (int shape = 0; shape < NUM_SHAPES; ++shape)
        check_shape((enum shape)shape, max_nodes);
    check_nesting();
    check_limits();
    check_repeated();
    printf("growth: %u passed, %u failed, 0 skipped\n", passed, failed);
    return failed ? 1 : 0;
}
