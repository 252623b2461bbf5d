// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
/*
 * Wide documents, most of them wrong throughout: validation takes time in proportion to their size,
 * whatever is many of. Eight times the elements may take 24 times as long, for caches and for what
 * else runs on the machine; what is quadratic takes 64 times.
 */
#include <mxgen/mxgen.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* '#' stands for a number from 0, '^' for the one behind it. */
static const struct shape {
    const char *name, *before, *first, *between, *second, *after;
} shapes[] = {
    {"nodes", "", "<constant name='c#' type='float'/>", "",
     "<output name='o#' type='float' nodename='c#'/>", ""},
    {"unknown nodes", "", "<xadd# name='c#' type='float'/>", "", "", ""},
    {"unknown types", "", "<constant name='c#' type='flot#'/>", "", "", ""},
    {"unknown attributes", "", "<constant name='c#' type='float' typo#='1'/>", "", "", ""},
    {"declared attributes", "", "<attributedef name='A#' attrname='a#' type='string'/>", "",
     "<constant name='c#' type='float' a#='1'/>", ""},
    {"unknown inputs", "<constant name='c' type='float'>",
     "<input name='i#' type='float' value='0'/>", "</constant>", "", ""},
    {"dangling nodes", "",
     "<add name='a#' type='float'><input name='in1' type='float' nodename='xa#'/></add>", "", "",
     ""},
    {"dangling interfaces", "<nodegraph name='N'>", "<input name='i#' type='float' value='0'/>", "",
     "<dot name='d#' type='float'><input name='in' type='float' interfacename='xi#'/></dot>",
     "</nodegraph>"},
    {"dangling graphs", "", "<nodegraph name='N#'/>", "",
     "<output name='o#' type='float' nodegraph='xN#'/>", ""},
    {"dangling outputs", "<nodegraph name='N'>", "<output name='o#' type='float' value='1'/>",
     "</nodegraph>", "<output name='p#' type='float' nodegraph='N' output='xo#'/>", ""},
    {"colour spaces", "",
     "<constant name='c#' type='color3'><input name='value' type='color3' value='1,1,1' "
     "colorspace='srgb_tx#'/></constant>",
     "", "", ""},
    {"units", "",
     "<unittypedef name='t#'/><unitdef name='u#' unittype='t#'><unit name='n#' "
     "scale='1'/></unitdef>",
     "",
     "<constant name='c#' type='float'><input name='value' type='float' value='1' unittype='t#' "
     "unit='n#'/></constant>",
     ""},
    {"unknown units", "", "<unitdef name='u#' unittype='t#'><unit name='n#' scale='1'/></unitdef>",
     "",
     "<constant name='c#' type='float'><input name='value' type='float' value='1' "
     "unit='xn#'/></constant>",
     ""},
    {"types", "", "<typedef name='t#'><member name='m' type='float' value='1'/></typedef>", "",
     "<constant name='c#' type='t#'/>", ""},
    {"definitions of one node", "",
     "<nodedef name='D#' node='g'><output name='out' type='float'/></nodedef>", "", "", ""},
    {"definitions", "", "<nodedef name='D#' node='g#'><output name='out' type='float'/></nodedef>",
     "", "<g# name='n#' type='float' nodedef='xD#'/>", ""},
    {"ports", "<nodedef name='D' node='g'>", "<input name='i#' type='float' value='0'/>",
     "<output name='out' type='float'/></nodedef>", "", ""},
    {"implementations", "<nodedef name='D' node='g'><output name='out' type='float'/></nodedef>",
     "<implementation name='I#' nodedef='D' target='t#' nodegraph='G'/>",
     "<nodegraph name='G'><constant name='c' type='float'/><output name='out' type='float' "
     "nodename='c'/></nodegraph>",
     "", ""},
    {"functional graphs", "",
     "<nodedef name='D#' node='g#'><output name='out' type='float'/></nodedef>", "",
     "<nodegraph name='G#' nodedef='D#'><constant name='c' type='float'/><output name='out' "
     "type='float' nodename='c'/></nodegraph>",
     ""},
    {"inheritance", "<nodedef name='D0' node='g0'><output name='out' type='float'/></nodedef>",
     "<nodedef name='D^' node='g^' inherit='D#'/>", "", "", ""},
    {"properties of geometry",
     "<nodedef name='D' node='g'><output name='out' type='float'/></nodedef>",
     "<geompropdef name='p#' type='vector3' geomprop='g'/>", "", "", ""},
    {"chains of graphs",
     "<nodegraph name='G0'><input name='in' type='float' value='1'/><output name='out' "
     "type='float' interfacename='in'/></nodegraph>",
     "<nodegraph name='G^'><input name='in' type='float' nodegraph='G#'/><dot name='d' "
     "type='float'><input name='in' type='float' interfacename='in'/></dot>"
     "<output name='out' type='float' nodename='d'/></nodegraph>",
     "", "", ""},
    {"looks", "", "<look name='l#'><materialassign name='a' material='x#' geom='/g'/></look>", "",
     "<surfacematerial name='x#' type='material'/>", ""},
    {"collections", "", "<collection name='c^' includecollection='c#'/>", "", "", ""},
    {"geometry", "", "<collection name='c#' includegeom='/a[,/b{,/c#'/>", "", "", ""},
    {"equal names", "", "<constant name='c' type='float'/>", "", "", ""},
};

/* ---- Documents ---- */

struct text {
    char *data;
    size_t len, room;
};

static void add(struct text *text, const char *part, unsigned number)
{
    size_t most = strlen(part) * 8 + 64;
    if (text->len + most > text->room) {
        text->room = text->room * 2 + most;
        text->data = realloc(text->data, text->room);
        if (!text->data)
            exit(1);
    }
    for (; *part; ++part) {
        if (*part == '#' || *part == '^')
            text->len += (size_t)snprintf(text->data + text->len, 16, "%u",
                                          *part == '^' ? number + 1 : number);
        else
            text->data[text->len++] = *part;
    }
}

static struct text document(const struct shape *shape, unsigned count)
{
    struct text text = {NULL, 0, 0};
    add(&text, "<materialx version='1.39'>\n", 0);
    add(&text, shape->before, 0);
    for (unsigned i = 0; i < count; ++i)
        add(&text, shape->first, i);
    add(&text, shape->between, 0);
    for (unsigned i = 0; i < count; ++i)
        add(&text, shape->second, i);
    add(&text, shape->after, 0);
    add(&text, "</materialx>\n", 0);
    return text;
}

/* ---- Time ---- */

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

static double validation_time(const struct text *text)
{
    mxg_context *context = NULL;
    mxg_document *document = NULL;
    mxg_result *result = NULL;
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.max_elements = 10000000;
    mxg_context_create(&desc, &context);
    mxg_library *library = mxg_library_builtin(context);
    double begin = seconds();
    if (mxg_document_parse(context, library, "wide.mtlx", text->data, text->len, &document)
        == MXG_OK)
        mxg_document_validate(context, document, &result);
    double time = seconds() - begin;
    mxg_result_destroy(result);
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return time;
}

/* The least of some runs, which others on the machine have disturbed least. */
static double least_time(const struct shape *shape, unsigned count)
{
    struct text text = document(shape, count);
    double least = 1e9;
    for (unsigned i = 0; i < 3; ++i) {
        double time = validation_time(&text);
        least = time < least ? time : least;
    }
    free(text.data);
    return least;
}

/* How many messages with this id the document gets when it is loaded. */
static unsigned count_messages(const struct text *text, const char *id)
{
    mxg_context *context = NULL;
    mxg_document *document = NULL;
    unsigned count = 0;
    mxg_context_create(NULL, &context);
    mxg_library *library = mxg_library_builtin(context);
    mxg_document_parse(context, library, "wide.mtlx", text->data, text->len, &document);
    const mxg_diagnostics *list = mxg_document_diagnostics(document);
    for (uint32_t i = 0; i < mxg_diagnostics_count(list); ++i) {
        mxg_diagnostic diagnostic = {sizeof diagnostic};
        mxg_diagnostics_get(list, i, &diagnostic);
        count += strcmp(diagnostic.id, id) == 0;
    }
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return count;
}

/* True if `most` ports of a shape are accepted, and one more gets one message. */
static bool is_limited(const struct shape *ports, unsigned most)
{
    struct text good = document(ports, most), bad = document(ports, most + 1);
    bool limited =
        count_messages(&good, "too-many-ports") == 0 && count_messages(&bad, "too-many-ports") == 1;
    free(good.data);
    free(bad.data);
    if (!limited)
        printf("failed: too-many-ports, %s\n", ports->name);
    return limited;
}

/* A definition has at most 1,024 inputs and 64 outputs. */
static bool are_ports_limited(void)
{
    static const struct shape inputs = {"inputs",
                                        "<nodedef name='D' node='g'>",
                                        "<input name='i#' type='float' value='0'/>",
                                        "<output name='out' type='float'/></nodedef>",
                                        "",
                                        ""},
                              outputs = {"outputs",
                                         "<nodedef name='D' node='g'>",
                                         "<output name='o#' type='float'/>",
                                         "</nodedef>",
                                         "",
                                         ""};
    return is_limited(&inputs, 1024) && is_limited(&outputs, 64);
}

int main(void)
{
    enum { FEW = 4000, MANY = 8 * FEW };
    unsigned passed = are_ports_limited(), failed = !passed;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; ++i) {
        double few = least_time(&shapes[i], FEW), many = least_time(&shapes[i], MANY);
        if (many < 24 * few + 0.002) {
            ++passed;
            continue;
        }
        ++failed;
        printf("failed: %s: %.1f ms for %d, %.1f ms for %d\n", shapes[i].name, few * 1e3, FEW,
               many * 1e3, MANY);
    }
    printf("wide: %u passed, %u failed, 0 skipped\n", passed, failed);
    return failed ? 1 : 0;
}
