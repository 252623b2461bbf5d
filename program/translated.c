// SPDX-License-Identifier: Apache-2.0
#include "program/translated.h"

mxg_document *translated_make(struct cli *cli, const mxg_document *from, const char *path,
                              const char *model)
{
    mxg_document *document = NULL;
    mxg_result *result = NULL;
    mxg_status status = mxg_translate(cli->context, from, model, &result);
    if (result)
        report_list(&cli->report, mxg_result_diagnostics(result));
    size_t size = 0;
    const char *text = mxg_result_text(result, &size);
    if (report_status(&cli->report, status) && text) {
        status = mxg_document_parse(cli->context, cli->library, path, text, size, &document);
        report_status(&cli->report, status);
    }
    mxg_result_destroy(result);
    return document;
}

mxg_document *translated_load(struct cli *cli, const char *path, const char *model)
{
    mxg_document *from = cli_load(cli, path);
    if (!model || !from)
        return from;
    mxg_document *document = translated_make(cli, from, path, model);
    mxg_document_destroy(from);
    return document;
}
