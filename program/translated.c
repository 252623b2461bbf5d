// SPDX-License-Identifier: Apache-2.0
#include "program/translated.h"

#include <stdlib.h>

mxg_document *translated_parse(struct cli *cli, const mxg_document *from, const char *path,
                               const char *model, translated_way *translate,
                               mxg_result **out_result, mxg_status *out_status)
{
    mxg_document *document = NULL;
    size_t size = 0;
    *out_status = translate(cli->context, from, model, out_result);
    const char *text = mxg_result_text(*out_result, &size);
    if (*out_status == MXG_OK && text)
        *out_status = mxg_document_parse(cli->context, cli->library, path, text, size, &document);
    return document;
}

mxg_document *translated_make(struct cli *cli, const mxg_document *from, const char *path,
                              const char *model, translated_way *translate)
{
    mxg_result *result = NULL;
    mxg_status status;
    /* lines of the new text are none of the file; its textures are beside the file */
    char *name = cli_format("%s as %s", path, model);
    mxg_document *document = translated_parse(cli, from, name, model, translate, &result, &status);
    free(name);
    report_list(&cli->report, mxg_result_diagnostics(result));
    report_status(&cli->report, status);
    mxg_result_destroy(result);
    return document;
}

mxg_document *translated_load(struct cli *cli, const char *path, const char *model)
{
    mxg_document *from = cli_load(cli, path);
    if (!model || !from)
        return from;
    mxg_document *document = translated_make(cli, from, path, model, mxg_translate);
    mxg_document_destroy(from);
    return document;
}
