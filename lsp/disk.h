// SPDX-License-Identifier: Apache-2.0
/*
 * The files that documents name. What the editor has open stands for the file on the disk. Files
 * are in or below the folder of the document or the folders of the workspace; links are resolved
 * before paths are compared (mxg_context_file_fault).
 */
#ifndef MXG_LSP_DISK_H
#define MXG_LSP_DISK_H

#include <mxgen/mxgen.h>

/* A file that the editor has open. */
struct disk_file {
    const char *path, *bytes;
    size_t size;
};

/* A view of the disk. One thread at a time uses it. */
struct disk {
    mxg_context *gate; /* tells which files may be read */
    const char *from;  /* the document whose files are read; it lives as long as the view */
    const struct disk_file *files;
    size_t num_files;
};

/*
 * The files in and below some folders, and below the include roots of `desc`. False: out of memory.
 */
bool disk_open(struct disk *disk, const mxg_context_desc *desc, char *const *folders,
               size_t num_folders);
void disk_close(struct disk *disk);

/* The path of `ref` beside the file `from`, without "." and "..". The caller frees it. */
char *disk_join(const char *from, const char *ref);

/* Finds files as without a resolver: beside the referring file, then in the working directory. */
mxg_resolver disk_resolver(struct disk *disk);

/* True if disk->from may read what `file`, one of its files, names, or if that does not exist. */
bool disk_may_read(const struct disk *disk, const char *file, const char *ref);

/*
 * The bytes of a file on the disk, with a NUL after them, which the caller frees; NULL: there is
 * none that disk->from may read. At most `limit` bytes from its begin; 0: all.
 */
char *disk_read(const struct disk *disk, const char *path, size_t limit, size_t *out_size);

/* The names in a folder, each with its NUL; folders end with '/'. The caller frees them. */
char *disk_list(const struct disk *disk, const char *folder, size_t *out_size);

#endif
