// SPDX-License-Identifier: Apache-2.0
/*
 * Reads XML text into an element tree. Only this room uses libxml2: the SAX2 interface, without
 * network and external entities.
 */
#ifndef MXG_XML_READER_H
#define MXG_XML_READER_H

#include "document/document.h"

/* The steps after the parser. */
enum xml_steps {
    XML_ALL_STEPS, /* XIncludes, upgrade of the version, templates, namespaces */
    XML_UPGRADE,   /* only the upgrade: for a tool that writes the file again */
    XML_NO_STEPS   /* the tree is the text */
};

struct xml_limits {
    uint32_t max_depth;         /* nesting of elements; 0: 128 */
    uint32_t max_include_depth; /* 0: 16 */
    uint32_t max_includes;      /* number of included files; 0: 4,096 */
    uint32_t max_elements;      /* 0: 16,000,000 */
    uint32_t max_file_mib;      /* 0: 256 */
    enum xml_steps steps;
};

/* Finds and reads files; see mxg_resolver in mxgen.h. All strings are UTF-8 and NUL-terminated. */
struct xml_files {
    void *user_data;
    /*
     * Opens `ref`, relative to `from` ("" for a file of the caller). On success the bytes are valid
     * until `release`, and *out_name is the canonical name, valid as long as the document's arena
     * (copy it there). On failure *out_reason is the reason, and *out_name is NULL unless the file
     * exists but is unreadable.
     */
    bool (*open)(void *user_data, const char *from, const char *ref, const char **out_name,
                 const char **out_data, size_t *out_size, void **out_handle,
                 const char **out_reason);
    void (*release)(void *user_data, void *handle);
};

/* Initialises libxml2 once per process. Thread-safe. */
void xml_startup(void);

/*
 * Parses a file into a document of doc_init, takes the steps, and after all of them indexes names.
 * Keeps comments if the document says so. false after a reported error; the tree is then partial.
 */
bool xml_read_file(struct document *doc, const struct xml_files *files,
                   const struct xml_limits *limits, const char *name, struct diag_list *diags);

/* Reads a document from memory. `name` appears in messages and is the base of includes. */
bool xml_read_memory(struct document *doc, const struct xml_files *files,
                     const struct xml_limits *limits, const char *name, const char *data,
                     size_t size, struct diag_list *diags);

#endif
