// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen-pack: packs the node library during the build of mxgen. It is the compiler without a
 * built-in library.
 *
 *     mxgen-pack IMAGE DEPFILE ROOT FOLDER...
 *
 * Folders are relative to ROOT, so the image does not depend on the location of ROOT.
 */
#define _POSIX_C_SOURCE 200809L
#include "program/files.h"
#include "program/report.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Reads files below the root and records their names for the depfile. */
struct recorder {
    FILE *depfile;
    const char *root;
};

/*
 * The path of `ref` beside the file `from`, without "./" and "folder/../"; NULL if memory is
 * exhausted.
 */
static char *resolve_name(const char *from, const char *ref)
{
    const char *slash = strrchr(from, '/');
    size_t folder = slash ? (size_t)(slash - from) + 1 : 0;
    char *name = malloc(folder + strlen(ref) + 1);
    if (!name)
        return NULL;
    size_t len = folder;
    memcpy(name, from, folder);
    while (strncmp(ref, "./", 2) == 0)
        ref += 2;
    for (; strncmp(ref, "../", 3) == 0 && len > 0; ref += 3) {
        do
            --len;
        while (len > 0 && name[len - 1] != '/');
    }
    memcpy(name + len, ref, strlen(ref) + 1);
    return name;
}

static bool open_file(void *user_data, const char *from, const char *ref, mxg_blob *out_blob,
                      const char **out_reason)
{
    const struct recorder *recorder = user_data;
    char *name = resolve_name(from, ref);
    char *data = name ? files_read(name, &out_blob->size) : NULL;
    if (!data) {
        *out_reason = strerror(errno);
        free(name);
        return false;
    }
    fprintf(recorder->depfile, " %s/%s", recorder->root, name);
    out_blob->name = name;
    out_blob->data = data;
    return true;
}

static void release_file(void *user_data, mxg_blob *blob)
{
    (void)user_data;
    free((void *)(uintptr_t)blob->name);
    free((void *)(uintptr_t)blob->data);
}

/* Loads the folders and writes their image; false after a message. */
static bool pack(struct recorder *recorder, const char *image, const char *const *folders,
                 size_t num_folders)
{
    const mxg_resolver resolver = {recorder, open_file, release_file, NULL};
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.resolver = &resolver;
    struct report report;
    report_init(&report);
    mxg_context *context = NULL;
    mxg_library *library = NULL;
    const void *data = NULL;
    size_t size = 0;
    mxg_status status = mxg_context_create(&desc, &context);
    if (status == MXG_OK)
        status = mxg_library_load(context, NULL, folders, num_folders, &library);
    if (library)
        report_list(&report, mxg_library_diagnostics(library));
    if (status == MXG_OK)
        status = mxg_library_image(library, &data, &size);
    if (status == MXG_ERROR_DOCUMENT && report.errors == 0)
        report_error(&report, "broken-implementation",
                     "the image has no faulty implementations; correct those above");
    bool good = report_status(&report, status);
    const char *reason = good ? files_write(image, data, size) : NULL;
    if (reason)
        report_error(&report, "output-failed", "cannot write '%s': %s", image, reason);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    report_finish(&report);
    return good && !reason;
}

int main(int argc, char **argv)
{
    if (argc < 5) {
        fputs("usage: mxgen-pack IMAGE DEPFILE ROOT FOLDER...\n", stderr);
        return 2;
    }
    char folder[4096];
    struct recorder recorder = {fopen(argv[2], "w"), argv[3]};
    if (!recorder.depfile || !getcwd(folder, sizeof folder) || chdir(recorder.root) != 0) {
        fprintf(stderr, "mxgen-pack: cannot start: %s\n", strerror(errno));
        return 1;
    }
    size_t room = strlen(folder) + strlen(argv[1]) + 2;
    char *image = malloc(room); /* absolute, because ROOT is the working directory from here on */
    snprintf(image, room, "%s%s%s", argv[1][0] == '/' ? "" : folder, argv[1][0] == '/' ? "" : "/",
             argv[1]);
    fprintf(recorder.depfile, "%s:", argv[1]);
    bool good = pack(&recorder, image, (const char *const *)argv + 4, (size_t)argc - 4);
    fputc('\n', recorder.depfile);
    good = fclose(recorder.depfile) == 0 && good;
    free(image);
    return good ? 0 : 1;
}
