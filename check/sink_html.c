// SPDX-License-Identifier: Apache-2.0
/*
 * --html: a gallery in one self-contained page: the totals, the failures, then all other elements.
 * The page is well-formed XML too. gallery.js sorts and hides the cards; without it the page shows
 * all of them.
 */
#include "check/by_element.h"
#include "check/sink.h"
#include "check/spool.h"
#include "program/cli.h"
#include "program/warning_groups.h"
#include "program/markup.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Cards in the order of the page. */
enum rank { FAILS_THE_RUN, KNOWN_FAILURE, OTHER, NUM_RANKS };

/* The cards wait in spools, because the totals and the failures precede them. */
struct html_state {
    struct markup cards[NUM_RANKS];
};

/* The state of a card: of its document, its element, and their messages and changes. */
struct facts {
    enum check_failure failure;
    check_change_set changes;
    bool has_warning, has_error;
};

/*
 * A card: an element, or a document (`element` NULL). It shows its own messages and changes: those
 * of a document with many elements are on the card of the document.
 */
struct card {
    const struct check_document *document;
    const struct check_element *element;
    bool is_gone;
    struct index_list messages, changes;
    struct facts facts;
};

static void begin(struct sink *sink)
{
    struct html_state *state = sink->state = calloc(1, sizeof *state);
    for (int i = 0; state && i < NUM_RANKS; ++i)
        state->cards[i].file = spool_begin();
    for (int i = 0; i < NUM_RANKS; ++i)
        if (!state || !state->cards[i].file)
            sink->fault = strerror(errno);
}

/* ---- Facts about a card ---- */

static uint64_t largest(const struct check_element *element, size_t measure)
{
    uint64_t value = 0;
    for (size_t i = 0; i < element->num_shaders; ++i)
        if (element->shaders[i].measures[measure] > value)
            value = element->shaders[i].measures[measure];
    return value;
}

static const struct check_message *message_at(const struct card *card, uint32_t index)
{
    return &card->document->messages[card->messages.items[index]];
}

static const struct check_change *change_at(const struct card *card, uint32_t index)
{
    return &card->document->changes[card->changes.items[index]];
}

/* Adds the messages and changes of the card; `of_all`: those that count for all its elements. */
static void add_facts(struct facts *facts, const struct card *card, bool of_all)
{
    for (uint32_t i = 0; i < card->messages.count; ++i) {
        const struct check_message *message = message_at(card, i);
        if (of_all && *message->element)
            continue;
        facts->has_warning = facts->has_warning || message->severity == MXG_SEVERITY_WARNING;
        facts->has_error = facts->has_error || message->severity == MXG_SEVERITY_ERROR;
    }
    for (uint32_t i = 0; i < card->changes.count; ++i)
        if (!of_all || !*change_at(card, i)->element)
            facts->changes |= 1u << change_at(card, i)->kind;
    for (size_t i = 0; card->element && i < card->element->num_shaders; ++i)
        check_fail(&facts->failure, card->element->shaders[i].failed);
}

static enum rank rank_of(const struct check_run *run, const struct card *card)
{
    bool failed = card->facts.failure != CHECK_PASSED;
    if (run->is_compared ? (card->facts.changes & run->fail_on) != 0 : failed)
        return FAILS_THE_RUN;
    return failed ? KNOWN_FAILURE : OTHER;
}

/* ---- Parts of a card ---- */

static void write_picture(struct markup *out, const char *png, const char *about)
{
    if (*png)
        markup_put(out,
                   "<img alt=\"%s\" title=\"%s\" loading=\"lazy\" "
                   "src=\"data:image/png;base64,%s\"/>",
                   about, about, png);
}

static void write_head(struct markup *out, const struct check_run *run, const struct card *card)
{
    enum rank rank = rank_of(run, card);
    bool failed = card->facts.failure != CHECK_PASSED;
    markup_put(out, "<article class=\"%s%s%s%s%s%s\"",
               card->is_gone ? "gone"
               : failed      ? "failed"
                             : "passed",
               rank == FAILS_THE_RUN ? " fails" : "", card->facts.has_warning ? " warned" : "",
               card->facts.changes ? " changed" : "", card->messages.count ? " wide" : "",
               card->element && card->element->num_shaders > 4 ? " wide" : "");
    for (size_t i = 0; card->element && i < NUM_MEASURES; ++i)
        markup_put(out, " data-%s=\"%" PRIu64 "\"", measure_infos[i].option + strlen("max-"),
                   largest(card->element, i));
    markup_put(out, ">");
    write_picture(out, card->element ? card->element->picture : "", "");
    write_picture(out, card->element ? card->element->full : "", "without a budget");
    markup_put(out, "<h2>");
    markup_put(out, "%s", card->element ? card->element->path : "document");
    markup_put(out, " <b>%s</b></h2><p>",
               card->is_gone           ? "gone"
               : rank == KNOWN_FAILURE ? "failed, as in the baseline"
               : failed                ? "failed"
               : rank == FAILS_THE_RUN ? "passed, but changed"
                                       : "passed");
    markup_put(out, "%s", card->document->file);
    markup_put(out, "</p>");
    if (card->element && *card->element->drawn_error)
        markup_put(out, "<p>drawn error of the budget: %s</p>", card->element->drawn_error);
}

static void write_slabs(struct markup *out, const struct check_element *element)
{
    if (*element->slabs)
        markup_put(out, "<details><summary>slabs</summary><pre>%s</pre></details>", element->slabs);
}

static void write_steps(struct markup *out, const struct check_element *element)
{
    if (!element->num_steps)
        return;
    markup_put(out, "<table><tr><th>step</th><th>closures</th><th>bytes</th><th>estimated</th>"
                    "<th>drawn</th></tr>");
    for (size_t i = 0; i < element->num_steps; ++i) {
        const struct check_step *step = &element->steps[i];
        markup_put(out, "<tr><td>");
        markup_put(out, "%s", step->text);
        markup_put(out,
                   "</td><td>%" PRIu32 " to %" PRIu32 "</td><td>%" PRIu32 " to %" PRIu32
                   "</td><td>%s</td><td>%s</td></tr>",
                   step->closures_before, step->closures_after, step->bytes_before,
                   step->bytes_after, step->estimated, step->drawn);
    }
    markup_put(out, "</table>");
}

/* "The compiler rejects the shader for glsl: 'x' is undeclared": the first failure in words. */
static void write_reason(struct markup *out, const struct card *card)
{
    static const char *const words[NUM_CHECK_FAILURES] = {
        [CHECK_LOAD] = "The document cannot be loaded",
        [CHECK_VALIDATE] = "The document does not match the node library",
        [CHECK_TRANSLATE] = "The document cannot have the other shading model",
        [CHECK_GENERATE] = "mxgen cannot generate the shader",
        [CHECK_COMPILE] = "The compiler rejects the shader",
        [CHECK_RENDER] = "The element cannot be rendered",
        [CHECK_BUDGET] = "The shader exceeds its budget",
        [CHECK_CRASH] = "The worker crashed",
        [CHECK_TIMEOUT] = "A step takes too long",
    };
    enum check_failure failure = card->facts.failure;
    const struct check_message *first = NULL;
    if (failure == CHECK_PASSED)
        return;
    markup_put(out, "<p class=\"why\">%s", words[failure]);
    const char *before = " for ";
    for (size_t i = 0; card->element && i < card->element->num_shaders; ++i) {
        if (card->element->shaders[i].failed != failure)
            continue;
        markup_put(out, "%s%s", before, card->element->shaders[i].target);
        before = ", ";
    }
    for (uint32_t i = 0; i < card->messages.count && !first; ++i)
        if (message_at(card, i)->severity == MXG_SEVERITY_ERROR)
            first = message_at(card, i);
    markup_put(out, first ? ": " : "");
    markup_put(out, "%s", first ? first->text : "");
    markup_put(out, "</p>");
}

/* A row per measure and a column per target. */
static void write_table(struct markup *out, const struct check_element *element)
{
    markup_put(out, "<table><tr><th></th>");
    for (size_t k = 0; k < element->num_shaders; ++k)
        markup_put(out, "<th>%s</th>", element->shaders[k].target);
    markup_put(out, "</tr><tr><th>result</th>");
    for (size_t k = 0; k < element->num_shaders; ++k)
        markup_put(out, "<td>%s</td>",
                   element->shaders[k].failed ? check_failure_names[element->shaders[k].failed]
                                              : "passed");
    for (size_t i = 0; i < NUM_MEASURES; ++i) {
        markup_put(out, "</tr><tr><th>%s</th>", measure_infos[i].noun);
        for (size_t k = 0; k < element->num_shaders; ++k)
            markup_put(out,
                       !*element->shaders[k].topology
                               || (i == MEASURE_INSTRUCTIONS && !element->shaders[k].compiled)
                           ? "<td></td>"
                           : "<td>%" PRIu64 "</td>",
                       element->shaders[k].measures[i]);
    }
    markup_put(out, "</tr></table>");
}

/* New messages are shown as messages. */
static void write_changes(struct markup *out, const struct check_run *run, const struct card *card)
{
    for (uint32_t i = 0; i < card->changes.count; ++i) {
        const struct check_change *change = change_at(card, i);
        if (change->message)
            continue;
        markup_put(out,
                   "<p class=\"change%s\">%s: ", run->fail_on >> change->kind & 1u ? " fails" : "",
                   check_change_names[change->kind]);
        if (*change->element && (!card->element || strcmp(change->element, card->element->path))) {
            markup_put(out, "'");
            markup_put(out, "%s", change->element);
            markup_put(out, "': ");
        }
        markup_put(out, "%s%s", change->target, *change->target ? ": " : "");
        markup_put(out, "%s", change->text);
        markup_put(out, "</p>");
    }
}

/*
 * A printed message: its sentences can wrap, but source lines and the carets under them must not.
 */
static void write_message(struct markup *out, const struct check_message *message)
{
    static const char margin[] = "    ";
    bool in_source = false;
    markup_put(out, "<div class=\"message %s\">",
               message->severity == MXG_SEVERITY_ERROR ? "error" : "warning");
    if (strcmp(message->state, "new") == 0)
        markup_put(out, "<b>new</b>");
    for (const char *line = message->rendered; *line;) {
        size_t len = strcspn(line, "\n");
        bool is_source = strncmp(line, margin, strlen(margin)) == 0;
        char *text = cli_copy(line, len);
        if (in_source && !is_source)
            markup_put(out, "</pre>");
        if (!in_source || !is_source)
            markup_put(out, is_source ? "<pre>" : "<p>");
        markup_put(out, "%s", text);
        markup_put(out, is_source ? "\n" : "</p>");
        in_source = is_source;
        line += len + (line[len] == '\n');
        free(text);
    }
    markup_put(out, in_source ? "</pre></div>" : "</div>");
}

static bool key_of_warning(const void *messages, uint32_t index, struct group_key *out_key)
{
    const struct check_message *message = message_at(messages, index);
    *out_key = (struct group_key){message->id, message->file, message->text, message->state};
    return message->severity == MXG_SEVERITY_WARNING;
}

static void write_rest(struct markup *out, const struct card *card, const struct groups *groups,
                       uint32_t first)
{
    struct group_rest rest = {0};
    for (uint32_t i = groups->next[first]; i; i = groups->next[i])
        group_rest_add(&rest, message_at(card, i)->line);
    if (!rest.count)
        return;
    markup_put(out, "<p class=\"rest\">");
    group_rest_print(&rest, out->file);
    markup_put(out, "</p>");
}

static void write_messages(struct markup *out, const struct card *card)
{
    struct groups groups = groups_make(card, card->messages.count, key_of_warning);
    for (uint32_t i = 0; i < card->messages.count; ++i) {
        if (groups.first[i] != i)
            continue;
        write_message(out, message_at(card, i));
        write_rest(out, card, &groups, i);
    }
    groups_finish(&groups);
}

/* The elements that a document had. */
static void write_lost(struct markup *out, const struct check_document *document)
{
    for (size_t i = 0; i < document->num_elements; ++i) {
        markup_put(out, i ? ", " : "<p>Its elements were ");
        markup_put(out, "%s", document->elements[i].path);
    }
    markup_put(out, document->num_elements ? ".</p>" : "");
}

/* ---- Cards ---- */

static void write_card(struct sink *sink, const struct card *card)
{
    struct html_state *state = sink->state;
    if (sink->fault)
        return;
    struct markup *out = &state->cards[rank_of(sink->run, card)];
    write_head(out, sink->run, card);
    write_reason(out, card);
    if (card->element)
        write_table(out, card->element);
    if (card->element)
        write_steps(out, card->element);
    if (card->element)
        write_slabs(out, card->element);
    write_changes(out, sink->run, card);
    write_messages(out, card);
    if (card->is_gone)
        write_lost(out, card->document);
    markup_put(out, "</article>\n");
}

static struct card card_of(const struct by_element *by, size_t part)
{
    const struct check_document *document = by->document;
    return (struct card){.document = document,
                         .element = part ? &document->elements[part - 1] : NULL,
                         .messages = by_element_messages(by, part),
                         .changes = by_element_changes(by, part)};
}

/* Documents without elements have a card, and those with messages or changes of their own. */
static void write_cards(struct sink *sink, const struct by_element *by)
{
    const struct check_document *document = by->document;
    struct card whole = card_of(by, 0);
    struct facts of_all = {.failure = check_own_failure(document)};
    whole.facts.failure = of_all.failure;
    add_facts(&whole.facts, &whole, false);
    add_facts(&of_all, &whole, true);
    if (document->num_elements == 0 || whole.messages.count || whole.changes.count)
        write_card(sink, &whole);
    for (size_t i = 1; i <= document->num_elements; ++i) {
        struct card card = card_of(by, i);
        card.facts = of_all;
        add_facts(&card.facts, &card, false);
        write_card(sink, &card);
    }
}

static void write_document(struct sink *sink, const struct check_document *document)
{
    struct by_element by;
    by_element_init(&by, document);
    write_cards(sink, &by);
    by_element_finish(&by);
}

static void write_gone(struct sink *sink, const struct check_document *document)
{
    struct check_document plain = *document;
    struct by_element by;
    plain.num_elements = plain.num_messages = 0;
    by_element_init(&by, &plain);
    struct card card = card_of(&by, 0);
    card.document = document;
    card.is_gone = true;
    add_facts(&card.facts, &card, false);
    write_card(sink, &card);
    by_element_finish(&by);
}

/* ---- The page ---- */

static void write_controls(struct markup *out)
{
    static const struct {
        const char *value, *text;
    } statuses[] = {{"", "all"},
                    {"fails", "fails the run"},
                    {"failed", "failed"},
                    {"warned", "with warnings"},
                    {"changed", "changed"},
                    {"gone", "gone"},
                    {"passed", "passed"}};
    markup_put(out, "<header><h1>mxgen check</h1>"
                    "<input type=\"search\" placeholder=\"file, element, message\" "
                    "aria-label=\"filter\"/>"
                    "<select id=\"status\" aria-label=\"status\">");
    for (size_t i = 0; i < sizeof statuses / sizeof *statuses; ++i)
        markup_put(out, "<option value=\"%s\">%s</option>", statuses[i].value, statuses[i].text);
    markup_put(out, "</select><select id=\"order\" aria-label=\"order\">"
                    "<option value=\"index\">failures first</option>");
    for (size_t i = 0; i < NUM_MEASURES; ++i)
        markup_put(out, "<option value=\"%s\">most %s</option>", measure_infos[i].key,
                   measure_infos[i].noun);
    markup_put(out, "</select><output></output></header>\n");
}

/* The time of the report, which SOURCE_DATE_EPOCH can set (reproducible-builds.org). */
static void write_date(struct markup *out)
{
    const char *fixed = getenv("SOURCE_DATE_EPOCH");
    time_t now = fixed ? (time_t)strtoll(fixed, NULL, 10) : time(NULL);
    const struct tm *utc = gmtime(&now);
    char text[32] = "";
    if (utc)
        strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", utc);
    markup_put(out, "<time>%s</time>", text);
}

static void write_total(struct markup *out, const char *class, uint64_t count, const char *noun)
{
    markup_put(out, "<li class=\"%s\"><b>%" PRIu64 "</b> %s</li>", count ? class : "", count, noun);
}

static void write_totals(struct markup *out, const struct check_run *run,
                         const struct check_totals *totals)
{
    markup_put(out, "<section><p>");
    write_date(out);
    markup_put(out, ", mxgen %s, targets", mxg_version_string());
    for (size_t i = 0; i < run->num_targets; ++i)
        markup_put(out, "%s %s", i ? "," : "", run->targets[i]);
    markup_put(out, run->compiles ? "</p><ul>" : ", not compiled</p><ul>");
    write_total(out, "bad", totals->documents - totals->failed[CHECK_PASSED], "failed");
    for (int failure = CHECK_PASSED + 1; failure < NUM_CHECK_FAILURES; ++failure)
        if (totals->failed[failure])
            write_total(out, "part", totals->failed[failure], check_failure_names[failure]);
    write_total(out, "good", totals->failed[CHECK_PASSED], "passed");
    write_total(out, "", totals->documents, "documents");
    write_total(out, "", totals->elements, "elements");
    write_total(out, "", totals->shaders, "shaders");
    write_total(out, "bad", totals->errors, "errors");
    write_total(out, "warn", totals->warnings, "warnings");
    markup_put(out, "</ul>");
    if (run->is_compared) {
        markup_put(out, "<ul>");
        write_total(out, totals->failing ? "bad" : "good", totals->failing,
                    "failing since the baseline");
        write_total(out, "", totals->known, "known to fail");
        for (int kind = 0; kind < NUM_CHECK_CHANGES; ++kind)
            if (totals->changes[kind])
                write_total(out, run->fail_on >> kind & 1u ? "bad" : "part", totals->changes[kind],
                            check_change_names[kind]);
        markup_put(out, "</ul>");
    }
    markup_put(out, "</section>\n");
}

static void end(struct sink *sink, const struct check_totals *totals)
{
    struct html_state *state = sink->state;
    struct markup page = {sink->out}, *out = &page;
    markup_put(out, "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>"
                    "<meta name=\"viewport\" content=\"width=device-width\"/><title>mxgen "
                    "check</title>\n<style>\n");
    markup_lines(out, gallery_style);
    markup_put(out, "</style></head><body>\n");
    write_controls(out);
    write_totals(out, sink->run, totals);
    markup_put(out, "<main>\n");
    for (int i = 0; state && i < NUM_RANKS; ++i) {
        const char *fault = spool_end(state->cards[i].file, page.file);
        sink->fault = sink->fault ? sink->fault : fault;
    }
    markup_put(out, "</main>\n<script>\n//<![CDATA[\n");
    markup_lines(out, gallery_script);
    markup_put(out, "//]]>\n</script></body></html>\n");
    free(state);
}

const struct sink_kind sink_html = {
    "html", "writes a gallery as one HTML page", begin, write_document, write_gone, end};
