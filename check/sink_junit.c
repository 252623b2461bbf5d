// SPDX-License-Identifier: Apache-2.0
/*
 * --junit: one suite per document, with one case for the document and one per element and target,
 * in the form that CI servers show.
 */
#include "check/sink.h"
#include "cli/markup.h"

#include <string.h>

static void begin(struct sink *sink)
{
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"mxgen check\">\n",
          sink->out);
}

static bool is_document_stage(enum check_stage stage)
{
    return stage == CHECK_LOAD || stage == CHECK_VALIDATE || stage == CHECK_CRASH
           || stage == CHECK_TIMEOUT;
}

static bool is_error(const struct check_message *message)
{
    return message->severity == MXG_SEVERITY_ERROR;
}

static void write_failure(FILE *out, enum check_stage stage, const struct check_message *first)
{
    fprintf(out, "><failure type=\"%s\" message=\"", first ? first->id : check_stage_names[stage]);
    markup_text(out, first ? first->text : check_stage_names[stage]);
    fputs("\">", out);
}

static void begin_case(struct sink *sink, const struct check_document *document,
                       const char *element, const char *target, double ms)
{
    fputs("<testcase classname=\"", sink->out);
    markup_text(sink->out, document->file);
    fputs("\" name=\"", sink->out);
    markup_text(sink->out, element);
    fprintf(sink->out, *target ? ", %s\"" : "\"%s", target);
    if (sink->run->with_times)
        fprintf(sink->out, " time=\"%.3f\"", ms / 1e3);
}

/* The case of the document: it fails if the document, or its worker, failed. */
static void write_document_case(struct sink *sink, const struct check_document *document)
{
    const struct check_message *first = NULL;
    begin_case(sink, document, "document", "", document->load_ms + document->validate_ms);
    if (!is_document_stage(document->failed)) {
        fputs("/>\n", sink->out);
        return;
    }
    for (size_t i = 0; i < document->num_messages && !first; ++i)
        first = is_error(&document->messages[i]) ? &document->messages[i] : NULL;
    write_failure(sink->out, document->failed, first);
    for (size_t i = 0; i < document->num_messages; ++i)
        if (is_error(&document->messages[i]))
            markup_text(sink->out, document->messages[i].rendered);
    fputs("</failure></testcase>\n", sink->out);
}

static void write_shader_case(struct sink *sink, const struct check_document *document,
                              const struct check_element *element,
                              const struct check_shader *shader)
{
    const struct check_message *first = NULL;
    begin_case(sink, document, element->path, shader->target,
               shader->generate_ms + shader->compile_ms);
    if (!shader->failed) {
        fputs("/>\n", sink->out);
        return;
    }
    for (size_t i = 0; i < shader->num_messages && !first; ++i)
        first = is_error(&document->messages[shader->messages[i]])
                    ? &document->messages[shader->messages[i]]
                    : NULL;
    write_failure(sink->out, shader->failed, first);
    for (size_t i = 0; i < shader->num_messages; ++i)
        if (is_error(&document->messages[shader->messages[i]]))
            markup_text(sink->out, document->messages[shader->messages[i]].rendered);
    fputs("</failure></testcase>\n", sink->out);
}

static void write_document(struct sink *sink, const struct check_document *document)
{
    size_t tests = 1, failures = is_document_stage(document->failed);
    for (size_t i = 0; i < document->num_elements; ++i) {
        tests += document->elements[i].num_shaders;
        for (size_t k = 0; k < document->elements[i].num_shaders; ++k)
            failures += document->elements[i].shaders[k].failed != CHECK_PASSED;
    }
    fputs("<testsuite name=\"", sink->out);
    markup_text(sink->out, document->file);
    fprintf(sink->out, "\" tests=\"%zu\" failures=\"%zu\" errors=\"0\" skipped=\"0\">\n", tests,
            failures);
    write_document_case(sink, document);
    for (size_t i = 0; i < document->num_elements; ++i)
        for (size_t k = 0; k < document->elements[i].num_shaders; ++k)
            write_shader_case(sink, document, &document->elements[i],
                              &document->elements[i].shaders[k]);
    fputs("</testsuite>\n", sink->out);
}

static void end(struct sink *sink, const struct check_totals *totals)
{
    (void)totals;
    fputs("</testsuites>\n", sink->out);
}

const struct sink_kind sink_junit = {
    "junit", "writes JUnit XML, with a test case for each element and target", begin,
    write_document, end};
