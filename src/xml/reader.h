// SPDX-License-Identifier: Apache-2.0
/*
 * From XML text to an element tree. libxml2 is used here and nowhere else, by SAX2, with no network
 * and no external entities.
 */
#ifndef MXG_XML_READER_H
#define MXG_XML_READER_H

#include "document/document.h"

struct xml_limits {
    uint32_t max_depth;         /* of elements; 0: 128 */
    uint32_t max_include_depth; /* 0: 16 */
    uint32_t max_includes;      /* files, each once; 0: 4,096 */
    uint32_t max_elements;      /* 0: 16,000,000 */
    uint32_t max_file_mib;      /* 0: 256 */
};

/* How files are found and read; see mxg_resolver in mxgen.h. All strings UTF-8, NUL-terminated. */
struct xml_files {
    void *user_data;
    /*
     * Opens `ref` as it stands in `from` ("" for a file named by the user). On success the bytes
     * are valid until `release`, and *out_name is the canonical name, valid as long as the
     * document's arena (copy it there). false: *out_reason says why, and *out_name is NULL unless
     * the file is there but cannot be read.
     */
    bool (*open)(void *user_data, const char *from, const char *ref, const char **out_name,
                 const char **out_data, size_t *out_size, void **out_handle,
                 const char **out_reason);
    void (*release)(void *user_data, void *handle);
};

/* Called once per process before any parsing, thread-safe. */
void xml_startup(void);

/*
 * Parses a file (with its XIncludes, whose children join the root's) into a document that doc_init
 * has made. Templates are expanded, the version upgraded, names indexed. false when an error was
 * reported; the tree is then partial.
 */
bool xml_read_file(struct document *doc, const struct xml_files *files,
                   const struct xml_limits *limits, const char *name, struct diag_list *diags);

/* The same from memory; `name` is for messages and as the base of includes. */
bool xml_read_memory(struct document *doc, const struct xml_files *files,
                     const struct xml_limits *limits, const char *name, const char *data,
                     size_t size, struct diag_list *diags);

#endif
