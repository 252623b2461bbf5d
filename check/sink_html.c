// SPDX-License-Identifier: Apache-2.0
/*
 * --html: a gallery in one self-contained page, with filters and sorting. The page is well-formed
 * XML too. gallery.js sorts and hides the cards; without it the page shows all of them.
 */
#include "check/sink.h"
#include "cli/markup.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static void begin(struct sink *sink)
{
    fputs("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>"
          "<meta name=\"viewport\" content=\"width=device-width\"/><title>mxgen "
          "check</title>\n<style>\n",
          sink->out);
    markup_lines(sink->out, gallery_style);
    fputs("</style></head><body>\n<header><h1>mxgen check</h1>"
          "<input type=\"search\" placeholder=\"file, element, message\" aria-label=\"filter\"/>"
          "<select id=\"status\" aria-label=\"status\"><option value=\"\">all</option>"
          "<option value=\"failed\">failed</option><option value=\"warned\">with warnings</option>"
          "<option value=\"changed\">changed</option><option "
          "value=\"passed\">passed</option></select>"
          "<select id=\"order\" aria-label=\"order\"><option value=\"index\">in order</option>",
          sink->out);
    for (size_t i = 0; i < NUM_MEASURES; ++i)
        fprintf(sink->out, "<option value=\"%s\">most %s</option>", measure_infos[i].key,
                measure_infos[i].noun);
    fputs("</select><output></output></header>\n<main>\n", sink->out);
}

/* ---- A card for each element ---- */

static uint64_t largest(const struct check_element *element, size_t measure)
{
    uint64_t value = 0;
    for (size_t i = 0; i < element->num_shaders; ++i)
        if (element->shaders[i].measures[measure] > value)
            value = element->shaders[i].measures[measure];
    return value;
}

static const char *stage_of(const struct check_document *document,
                            const struct check_element *element)
{
    enum check_stage failed = CHECK_PASSED;
    for (size_t i = 0; element && i < element->num_shaders; ++i)
        check_fail(&failed, element->shaders[i].failed);
    /* a fault of the document counts for all its elements */
    check_fail(&failed,
               element && document->failed > CHECK_VALIDATE ? CHECK_PASSED : document->failed);
    return check_stage_names[failed];
}

/* A change of the document counts for all its elements. */
static bool is_change_of(const struct check_change *change, const struct check_element *element)
{
    return !element || !*change->element || strcmp(change->element, element->path) == 0;
}

static bool has_changed(const struct check_document *document, const struct check_element *element)
{
    for (size_t i = 0; i < document->num_changes; ++i)
        if (is_change_of(&document->changes[i], element))
            return true;
    return false;
}

static void write_changes(FILE *out, const struct check_document *document,
                          const struct check_element *element)
{
    for (size_t i = 0; i < document->num_changes; ++i) {
        const struct check_change *change = &document->changes[i];
        if (!is_change_of(change, element))
            continue;
        fprintf(out, "<p class=\"change\">%s: %s%s", check_change_names[change->kind],
                change->target, *change->target ? ": " : "");
        markup_text(out, change->text);
        fputs("</p>", out);
    }
}

static void begin_card(struct sink *sink, const struct check_document *document,
                       const struct check_element *element)
{
    const char *stage = stage_of(document, element);
    bool warned = false;
    for (size_t i = 0; i < document->num_messages; ++i)
        warned = warned || document->messages[i].severity == MXG_SEVERITY_WARNING;
    bool passed = strcmp(stage, check_stage_names[CHECK_PASSED]) == 0;
    fprintf(sink->out, "<article class=\"%s%s%s\"", passed ? "passed" : "failed",
            warned ? " warned" : "", has_changed(document, element) ? " changed" : "");
    for (size_t i = 0; element && i < NUM_MEASURES; ++i)
        fprintf(sink->out, " data-%s=\"%" PRIu64 "\"", measure_infos[i].option + strlen("max-"),
                largest(element, i));
    putc('>', sink->out);
    if (element && *element->picture) {
        fputs("<img alt=\"\" loading=\"lazy\"", sink->out);
        fprintf(sink->out, " src=\"data:image/png;base64,%s\"/>", element->picture);
    }
    fputs("<h2>", sink->out);
    markup_text(sink->out, element ? element->path : "document");
    fprintf(sink->out, " <b>%s</b></h2><p>", stage);
    markup_text(sink->out, document->file);
    fputs("</p>", sink->out);
}

static void write_table(FILE *out, const struct check_element *element)
{
    fputs("<table><tr><th>target</th><th></th>", out);
    for (size_t i = 0; i < NUM_MEASURES; ++i)
        fprintf(out, "<th>%s</th>", measure_infos[i].noun);
    fputs("</tr>", out);
    for (size_t k = 0; k < element->num_shaders; ++k) {
        const struct check_shader *shader = &element->shaders[k];
        fprintf(out, "<tr><td>%s</td><td>%s</td>", shader->target,
                check_stage_names[shader->failed]);
        for (size_t i = 0; i < NUM_MEASURES; ++i)
            fprintf(out,
                    i == MEASURE_INSTRUCTIONS && !shader->compiled ? "<td></td>"
                                                                   : "<td>%" PRIu64 "</td>",
                    shader->measures[i]);
        fputs("</tr>", out);
    }
    fputs("</table>", out);
}

/* Messages of the document stand on every card, messages of an element on its own card. */
static bool is_about(const struct check_message *message, const struct check_element *element)
{
    return !element || !*message->element || strcmp(message->element, element->path) == 0;
}

static void write_card(struct sink *sink, const struct check_document *document,
                       const struct check_element *element)
{
    begin_card(sink, document, element);
    if (element)
        write_table(sink->out, element);
    write_changes(sink->out, document, element);
    for (size_t i = 0; i < document->num_messages; ++i) {
        const struct check_message *message = &document->messages[i];
        if (!is_about(message, element))
            continue;
        fprintf(sink->out, "<pre class=\"%s\">",
                message->severity == MXG_SEVERITY_ERROR ? "error" : "warning");
        markup_text(sink->out, message->rendered);
        fputs("</pre>", sink->out);
    }
    fputs("</article>\n", sink->out);
}

static void write_document(struct sink *sink, const struct check_document *document)
{
    for (size_t i = 0; i < document->num_elements; ++i)
        write_card(sink, document, &document->elements[i]);
    if (document->num_elements == 0)
        write_card(sink, document, NULL);
}

static void end(struct sink *sink, const struct check_totals *totals)
{
    fprintf(sink->out,
            "</main>\n<footer>%" PRIu64 " documents, %" PRIu64 " failed, %" PRIu64
            " elements, %" PRIu64 " shaders</footer>\n",
            totals->documents, totals->documents - totals->failed[CHECK_PASSED], totals->elements,
            totals->shaders);
    fputs("<script>\n//<![CDATA[\n", sink->out);
    markup_lines(sink->out, gallery_script);
    fputs("//]]>\n</script></body></html>\n", sink->out);
}

const struct sink_kind sink_html = {"html", "writes a gallery as one HTML page", begin,
                                    write_document, end};
