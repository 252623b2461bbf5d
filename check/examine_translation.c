// SPDX-License-Identifier: Apache-2.0
/* --translate: the shaders, pictures and measures are those of the document with another model. */
#include "check/examine.h"
#include "program/translated.h"

#include <stdlib.h>

mxg_document *examine_translated(struct examiner *examiner, mxg_document *document)
{
    mxg_result *result = NULL;
    mxg_status status;
    channel_mark(&examiner->channel, CHECK_TRANSLATE, "", "");
    mxg_document *translated =
        translated_parse(examiner->cli, document, examiner->document->file, examiner->translate,
                         mxg_translate, &result, &status);
    examine_diagnostics(examiner, mxg_result_diagnostics(result), NULL, NULL);
    examine_status(examiner, status, NULL, NULL);
    if (status != MXG_OK)
        check_fail(&examiner->document->failed, CHECK_TRANSLATE);
    mxg_result_destroy(result);
    mxg_document_destroy(document);
    return translated;
}

void examine_likeness(struct examiner *examiner, const struct check_element *element)
{
    const char *folder = examine_folder(examiner);
    char *fault = NULL, *text = NULL;
    channel_mark(&examiner->channel, CHECK_RENDER, element->path, "vulkan");
    double error = folder
                       ? translated_difference(examiner->cli, examiner->document->file,
                                               element->path, examiner->translate, folder, &fault)
                       : -1;
    if (error < 0)
        text = cli_format("there is no drawn error of '%s': %s", element->path,
                          fault ? fault : "there is no folder for pictures");
    else if (error > examiner->accept)
        text = cli_format("'%s' as '%s' looks different by %.3g, which is more than %g (mean "
                          "CIEDE2000 of three views)",
                          element->path, examiner->translate, error, examiner->accept);
    if (text)
        examine_fault(examiner, element->path, error < 0 ? CHECK_RENDER : CHECK_TRANSLATE,
                      error < 0 ? "no-picture" : "translation-error", text);
    free(text);
    free(fault);
}
