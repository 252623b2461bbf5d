// SPDX-License-Identifier: Apache-2.0
/*
 * The text that a document of an edit writes can be read again, and gives the document: an edit
 * refuses what would be wrong XML or an include, and what the reader upgrades, the edit upgrades.
 */
#include "documents.h"

#include <mxgen/document.h>

#define GRAPH \
    "<nodegraph name=\"N\"><constant name=\"c\" type=\"color3\"/><sin name=\"s\" type=\"float\">" \
    "<input name=\"in\" type=\"float\" nodename=\"c\"/></sin>" \
    "<output name=\"out\" type=\"float\" nodename=\"s\"/></nodegraph>"

static const char text[] = "<materialx version=\"1.39\" xmlns:p=\"u\" xmlns:q=\"u\">" GRAPH
                           "<constant name=\"k\" type=\"color3\"><input name=\"value\" "
                           "type=\"color3\" value=\"1, 0, 0\"/></constant><look name=\"L\"/>"
                           "<output name=\"o\" type=\"float\" nodegraph=\"N\" p:z=\"1\"/>"
                           "</materialx>";

struct fixture {
    mxg_context *context;
    mxg_library *library;
    mxg_document *document;
};

static mxg_document *parse(const struct fixture *f, const char *xml)
{
    mxg_document *document = NULL;
    REQUIRE_EQ(mxg_document_parse(f->context, f->library, "text.mtlx", xml, strlen(xml), &document),
               MXG_OK);
    return document;
}

static void open_fixture(struct fixture *f)
{
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    REQUIRE_EQ(mxg_context_create(&desc, &f->context), MXG_OK);
    f->library = mxg_library_builtin(f->context);
    f->document = parse(f, text);
}

static void close_fixture(struct fixture *f)
{
    mxg_document_destroy(f->document);
    mxg_library_unref(f->library);
    mxg_context_destroy(f->context);
}

static mxg_edit *begin(const struct fixture *f)
{
    mxg_edit *edit = NULL;
    REQUIRE_EQ(mxg_edit_create(f->context, f->library, f->document, NULL, &edit), MXG_OK);
    return edit;
}

/* ---- Refused ---- */

static const struct {
    const char *path, *attribute, *value, *reason;
} attributes[] = {
    {"", "xmlns", "http://x", "has a meaning in XML"},
    {"", "xmlns:x", "", "has a meaning in XML"},
    {"", "xmlns:x", "http://x", "has a meaning in XML"},
    {"", "xmlns:xi", "http://x", "has a meaning in XML"},
    {"N", "xmlns:xmlns", "http://x", "has a meaning in XML"},
    {"N", "xml:space", "1", "has a meaning in XML"},
    {"N", "xml:id", "1 2", "has a meaning in XML"},
    {"N", "a:b:c", "1", "two prefixes"},
    {"o", "q:z", "2", "may be one with 'q:z' to XML"},
    {"", "version", "x", "is 1.39"},
    {"", "version", "", "is 1.39"},
    {"", "version", "1.36", "is 1.39"},
    {"", "version", "1.40", "is 1.39"},
    {"", "version", "2.39", "is 1.39"},
    {"", "version", NULL, "is 1.39"},
};

static const struct {
    const char *category, *reason;
} categories[] = {
    {"xi:include", "has a meaning in XML"}, {"xi:fallback", "has a meaning in XML"},
    {"xmlns", "has a meaning in XML"},      {"xmlns:add", "has a meaning in XML"},
    {"xml:add", "has a meaning in XML"},    {"a:b:c", "two prefixes"},
};

static void failed_for(const mxg_edit *edit, const char *reason)
{
    char said[256];
    mxg_edit_error(edit, said, sizeof said);
    if (!REQUIRE(strstr(said, reason)))
        printf("    %s: %s\n", reason, said);
}

static void test_refused(const struct fixture *f)
{
    mxg_edit *edit = begin(f);
    mxg_document *after = NULL;
    for (size_t i = 0; i < sizeof attributes / sizeof *attributes; i++) {
        REQUIRE_EQ(mxg_edit_set_attribute(edit, edited_at(edit, attributes[i].path),
                                          attributes[i].attribute, attributes[i].value),
                   MXG_ERROR_ARGUMENT);
        failed_for(edit, attributes[i].reason);
    }
    for (size_t i = 0; i < sizeof categories / sizeof *categories; i++) {
        REQUIRE_EQ(mxg_edit_add_element(edit, 0, categories[i].category, "x", "float"), 0);
        failed_for(edit, categories[i].reason);
    }
    REQUIRE_EQ(commit(edit, &after), MXG_OK);
    REQUIRE_STR(mxg_document_xml(after, NULL), mxg_document_xml(f->document, NULL));
    mxg_document_destroy(after);
}

/* ---- Written as it is read ---- */

/* An attribute of an element, or an element "CATEGORY TYPE" with an input of a value. */
static const struct {
    const char *path, *attribute, *value;
    const char *written; /* a part of the text of the document */
} changes[] = {
    {"o", "p:z", "2", "p:z=\"2\""},
    {"o", "q:other", "2", "q:other=\"2\""},
    {"", "xmlns:q", NULL, "<materialx version=\"1.39\" xmlns:p=\"u\">"},
    {"", "version", "1.39", "version=\"1.39\""},
    {"N/s/in", "channels", "g", "<extract "},
    {"N/c", "doc", "True", "doc=\"True\""},
    {"N/c", "inherit", "k",
     "<input name=\"value\" type=\"color3\" value=\"1, 0, 0\"/>\n    </constant>\n    <sin"},
    {NULL, "parameter float", "1", "<input name=\"value\" type=\"float\" value=\"1\"/>"},
    {NULL, "input boolean", "True", "value=\"true\""},
    {NULL, "input color2", "1, 2", "type=\"vector2\""},
    {NULL, "geompropvalue string", "st", "<geompropvalueuniform "},
    {NULL, "geompropvalue float", "st", "<geompropvalue "},
};

static void change(mxg_edit *edit, size_t i)
{
    const char *attribute = changes[i].attribute, *type = strchr(attribute, ' ');
    if (changes[i].path) {
        REQUIRE_EQ(mxg_edit_set_attribute(edit, edited_at(edit, changes[i].path), attribute,
                                          changes[i].value),
                   MXG_OK);
        return;
    }
    char category[32];
    snprintf(category, sizeof category, "%.*s", (int)(type++ - attribute), attribute);
    bool is_port = strcmp(category, "geompropvalue") != 0;
    mxg_element node =
        mxg_edit_add_element(edit, 0, is_port ? "constant" : category, "added", type);
    mxg_element input =
        mxg_edit_add_element(edit, node, is_port ? category : "input",
                             is_port ? "value" : "geomprop", is_port ? type : "string");
    REQUIRE_EQ(mxg_edit_set_attribute(edit, input, "value", changes[i].value), MXG_OK);
}

static void test_written(const struct fixture *f)
{
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        mxg_edit *edit = begin(f);
        mxg_document *after = NULL;
        change(edit, i);
        REQUIRE_EQ(commit(edit, &after), MXG_OK);
        const char *xml = mxg_document_xml(after, NULL);
        if (!REQUIRE(strstr(xml, changes[i].written)))
            printf("%s\n", xml);
        mxg_document *read = parse(f, xml);
        REQUIRE_EQ(mxg_diagnostics_num_items(mxg_document_diagnostics(read)), 0);
        REQUIRE_STR(mxg_document_xml(read, NULL), xml);
        mxg_document_destroy(read);
        mxg_document_destroy(after);
    }
}

/* ---- Faults are those of the text ---- */

/* Steps of an edit: "PATH ATTRIBUTE VALUE", or "+ PARENT CATEGORY NAME TYPE", "-": none. */
static const struct {
    const char *steps[8];
    const char *messages; /* of the end of the edit */
} faulty[] = {
    {{"N/c inherit zz"}, "inherit-missing "},
    {{"N/s inherit k"}, "inherit-category "},
    {{"k inherit k"}, "inherit-cycle "},
    {{"+ - constant a color3", "+ a input value color3", "a/value value x", "+ - constant b color3",
      "b inherit a"},
     ""},
    {{"N/s/in nodename -", "N/c inherit k"}, ""}, /* nothing uses k any more */
    {{"+ L materialassign m float"}, ""},
    {{"+ L materialassign m -", "L/m type float"}, ""},
    {{"+ L materialassign - -", "+ L materialassign - -"}, ""},
    {{"+ L materialassign m surfaceshader", "L/m material k", "L/m collection x"}, ""},
};

static void step(mxg_edit *edit, const char *words)
{
    char word[5][16] = {0};
    sscanf(words, "%15s %15s %15s %15s %15s", word[0], word[1], word[2], word[3], word[4]);
    const char *given[5];
    for (int i = 0; i < 5; i++)
        given[i] = strcmp(word[i], "-") == 0 ? NULL : word[i];
    if (strcmp(word[0], "+") == 0)
        REQUIRE(mxg_edit_add_element(edit, given[1] ? edited_at(edit, given[1]) : 0, word[2],
                                     given[3], given[4]));
    else
        REQUIRE_EQ(mxg_edit_set_attribute(edit, edited_at(edit, word[0]), word[1], given[2]),
                   MXG_OK);
}

/* "id " of each diagnostic, all of which have a place. */
static void list(const mxg_diagnostics *diagnostics, char *out)
{
    *out = '\0';
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(diagnostics); i++) {
        mxg_diagnostic item = {.size = sizeof item};
        REQUIRE_EQ(mxg_diagnostics_item(diagnostics, i, &item), MXG_OK);
        REQUIRE(item.line || item.path[0]);
        out += sprintf(out, "%s ", item.id);
    }
}

static void list_faults(const struct fixture *f, const mxg_document *document, char *out)
{
    mxg_result *result = NULL;
    mxg_validate(f->context, document, &result);
    list(mxg_result_diagnostics(result), out);
    mxg_result_destroy(result);
}

static void test_faulty(const struct fixture *f)
{
    for (size_t i = 0; i < sizeof faulty / sizeof *faulty; i++) {
        mxg_edit *edit = begin(f);
        mxg_document *after = NULL, *read = NULL;
        char said[1024], faults[1024], faults_of_text[1024];
        for (int k = 0; faulty[i].steps[k]; k++)
            step(edit, faulty[i].steps[k]);
        commit(edit, &after);
        list(mxg_document_diagnostics(after), said);
        REQUIRE_STR(said, faulty[i].messages);
        const char *xml = mxg_document_xml(after, NULL);
        mxg_document_parse(f->context, f->library, "text.mtlx", xml, strlen(xml), &read);
        list_faults(f, after, faults);
        list_faults(f, read, faults_of_text);
        REQUIRE_STR(faults, faults_of_text);
        mxg_document_destroy(read);
        mxg_document_destroy(after);
    }
}

int main(void)
{
    struct fixture f;
    open_fixture(&f);
    test_refused(&f);
    test_written(&f);
    test_faulty(&f);
    close_fixture(&f);
    return test_report("api-edit_written");
}
