// SPDX-License-Identifier: Apache-2.0
#include "program/translated.h"

mxg_document *translated_load(struct cli *cli, const char *path, const char *model)
{
    mxg_document *from = cli_load(cli, path), *document = NULL;
    if (!model || !from)
        return from;
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
    mxg_document_destroy(from);
    return document;
}
