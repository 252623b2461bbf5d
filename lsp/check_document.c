// SPDX-License-Identifier: Apache-2.0
#include "lsp/check_document.h"

#include "program/cli.h"
#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

const char *check_origin(const struct lsp_document *document)
{
    return document && document->is_file ? document->path : "/dev/null/none";
}

/* Copies what the editor has open. */
static void take_texts(struct lsp_check *check, const struct lsp_session *session,
                       const struct lsp_document *own)
{
    struct disk_file *files = NULL;
    for (const struct lsp_document *document = session->documents; document;
         document = document->next) {
        files = store_grow(&check->texts, files, check->disk.num_files, sizeof *files);
        if (document == own)
            check->index = check->disk.num_files;
        files[check->disk.num_files++] =
            (struct disk_file){store_text(&check->texts, document->path, strlen(document->path)),
                               store_text(&check->texts, document->text.bytes, document->text.len),
                               document->text.len};
    }
    check->disk.files = files;
}

struct lsp_check *check_create(const struct lsp_session *session,
                               const struct lsp_document *document)
{
    struct lsp_check *check = memory_alloc(sizeof *check);
    const char *origin = check_origin(document);
    check->path = cli_copy(document->path, strlen(document->path));
    check->edition = document->edition;
    check->desc = session->desc.context;
    check->library = mxg_library_ref(session->desc.library);
    check->disk.from = store_text(&check->texts, origin, strlen(origin));
    take_texts(check, session, document);
    if (disk_open(&check->disk, &check->desc, session->folders, session->num_folders))
        return check;
    check_destroy(check);
    return NULL;
}

void check_destroy(struct lsp_check *check)
{
    if (!check)
        return;
    mxg_document_destroy(check->read);
    mxg_context_destroy(check->context);
    mxg_library_unref(check->library);
    disk_close(&check->disk);
    store_finish(&check->texts);
    findings_clear(&check->findings);
    free(check->path);
    free(check);
}

static bool is_xml(const mxg_document *document)
{
    const mxg_diagnostics *list = mxg_document_diagnostics(document);
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); ++i) {
        mxg_diagnostic item = {sizeof item};
        mxg_diagnostics_item(list, i, &item);
        if (item.severity == MXG_SEVERITY_ERROR && strncmp(item.id, "xml-", 4) == 0)
            return false;
    }
    return true;
}

/* Nobody knows whether a texture outside of the workspace is missing. */
static void leave_out_unread(struct lsp_check *check)
{
    struct findings *findings = &check->findings;
    size_t kept = 0;
    for (size_t i = 0; i < findings->len; ++i) {
        const struct finding *finding = &findings->items[i];
        bool is_texture = strcmp(finding->id, "missing-texture") == 0 && finding->num_arguments;
        if (!is_texture || disk_may_read(&check->disk, finding->path, finding->arguments[0]))
            findings->items[kept++] = *finding;
    }
    findings->len = kept;
}

static void validate(struct lsp_check *check)
{
    mxg_result *result = NULL;
    mxg_validate(check->context, check->read, &result);
    if (result)
        findings_add(&check->findings, mxg_result_diagnostics(result), check->path);
    leave_out_unread(check);
    mxg_result_destroy(result);
}

void lsp_check_run(struct lsp_check *check)
{
    mxg_context_desc desc = check->desc;
    const mxg_resolver resolver = disk_resolver(&check->disk);
    const struct disk_file *file = &check->disk.files[check->index];
    desc.resolver = &resolver;
    if (mxg_context_create(&desc, &check->context) != MXG_OK)
        return;
    mxg_status status = mxg_document_parse(check->context, check->library, check->path, file->bytes,
                                           file->size, &check->read);
    if (!check->read)
        return;
    check->is_xml = is_xml(check->read);
    findings_add(&check->findings, mxg_document_diagnostics(check->read), check->path);
    /* a document that errors leave empty has no more to check, as for `mxgen validate` */
    if (status == MXG_OK || mxg_document_num_renderables(check->read))
        validate(check);
}
