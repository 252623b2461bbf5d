// SPDX-License-Identifier: Apache-2.0
#include "render/picture_tell.h"

#include <stdio.h>
#include <string.h>

/* ---- Textures that cannot be read ---- */

/* True for a text that was not printed about this document. */
static bool is_new(struct painter *painter, const mxg_document *document, const char *text)
{
    bool is_new;
    if (painter->told_document != document)
        names_finish(&painter->told_textures);
    painter->told_document = document;
    names_add(&painter->told_textures, text, &is_new);
    return is_new;
}

/* The document's messages about files that do not exist, by the names of the files. */
struct missing {
    mxg_result *result;      /* NULL: not asked for yet */
    struct name_table files; /* indices of diagnostics */
};

static void find_missing(struct missing *missing, mxg_context *context,
                         const mxg_document *document)
{
    mxg_validate(context, document, &missing->result);
    const mxg_diagnostics *list = mxg_result_diagnostics(missing->result);
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); ++i) {
        mxg_diagnostic diagnostic = {sizeof diagnostic};
        mxg_diagnostics_item(list, i, &diagnostic);
        if (strcmp(diagnostic.id, "missing-texture") != 0)
            continue;
        bool is_first;
        struct name_entry *entry =
            names_add(&missing->files, mxg_diagnostics_argument(list, i, 0), &is_first);
        entry->value = is_first ? i : entry->value;
    }
}

void picture_tell_textures(struct painter *painter, const struct bind *bind,
                           const struct subject *subject)
{
    struct report *report = &painter->cli->report;
    struct missing missing = {0};
    for (size_t i = 0; i < bind->num_faults && !(painter->checker && report->quiet); ++i) {
        const struct bind_fault *fault = &bind->faults[i];
        if (!is_new(painter, subject->document, fault->reason))
            continue;
        if (fault->file && !missing.result)
            find_missing(&missing, painter->cli->context, subject->document);
        const struct name_entry *place =
            fault->file ? names_find(&missing.files, fault->file) : NULL;
        if (place)
            fputs(report_render(report, mxg_result_diagnostics(missing.result),
                                (uint32_t)place->value),
                  stderr);
        else if (painter->checker)
            report_warning(report, "missing-texture", "%s", fault->reason);
        else
            report_error(report, "missing-texture", "%s", fault->reason);
    }
    names_finish(&missing.files);
    mxg_result_destroy(missing.result);
}

/* ---- Primvars ---- */

static void tell_type(struct painter *painter, const struct bind_mistyped *mistyped,
                      const struct subject *subject)
{
    const struct primvar *primvar = mistyped->primvar;
    char place[512] = "";
    if (primvar->file)
        snprintf(place, sizeof place, " (%s:%u:%u)", primvar->file, primvar->line, primvar->column);
    report_warning(&painter->cli->report, "primvar-type",
                   "the primvar '%s' of '%s'%s has the type '%.*s', and '%s' reads %u number%s; "
                   "%s",
                   primvar->name, mistyped->object, place, primvar->type_len, primvar->type,
                   subject_name(subject), mistyped->num_read, mistyped->num_read == 1 ? "" : "s",
                   primvar->components ? "the first numbers of it count"
                                       : "the default, or 0, stands in");
}

static void tell_occlusion(struct painter *painter, const struct bind *bind)
{
    if (!painter->told_occlusion)
        report_warning(&painter->cli->report, "missing-primvar",
                       "'%s' has no primvar 'ambientocclusion', which the slot '%s' reads; rasters "
                       "compute no occlusion, so 1 (open) stands in, there and elsewhere; "
                       "--path-trace computes it",
                       bind->lacking, bind->lacking_slot);
    painter->told_occlusion = true;
}

void picture_tell(struct painter *painter, const struct bind *bind, const struct subject *subject)
{
    if (bind->num_lacking && strcmp(bind->lacked, "ambientocclusion") == 0)
        tell_occlusion(painter, bind);
    else if (bind->num_lacking)
        report_warning(
            &painter->cli->report, "missing-primvar",
            "'%s' has no primvar for '%s', which '%s' reads%s; its default, or 0, stands "
            "in",
            bind->lacking, bind->lacked, subject_name(subject),
            bind->num_lacking > 1 ? " (and others)" : "");
    for (uint32_t i = 0; i < bind->num_mistyped; ++i)
        tell_type(painter, &bind->mistyped[i], subject);
    picture_tell_textures(painter, bind, subject); /* checkers replace them */
    if (bind->reason[0])                           /* a texture has bad pixels */
        report_warning(&painter->cli->report, bind->id, "%s", bind->reason);
}
