// SPDX-License-Identifier: Apache-2.0
/* What the files of the xml room share. */
#ifndef MXG_XML_INTERNAL_H
#define MXG_XML_INTERNAL_H

#include "xml/reader.h"

struct _xmlParserCtxt;

/* A place in the text of a source: `offset` is in that line. */
struct xml_position {
    size_t offset, line_begin;
    uint32_t line; /* 0: not known yet */
};

/* A name that libxml2 keeps once, and its id. */
struct xml_name {
    const char *text;
    str_id id;
};

/* The file being read. Its text is UTF-8 without a byte-order mark, whatever the file had. */
struct xml_source {
    const char *name; /* canonical: what includes in it are relative to */
    uint16_t file;
    const char *text;
    size_t size;
    size_t start; /* where the XML begins, behind text that was skipped */
    /* offsets of raw '<' in attribute values, where XML_RAW_LESS stands now */
    VEC(size_t) raw_less;
    elem_id root;
    bool is_ascii;                /* a column is a byte */
    struct xml_position position; /* of the last tag or value seen */
    elem_id current;              /* the innermost open element */
    uint32_t depth;               /* open elements */
    bool warned_prefix, warned_text;
};

/*
 * Stands for a raw '<' inside attribute values of a repaired text: one byte, so that positions
 * stay, and one that XML allows but no sane file contains (DEL). A file that does contain it is not
 * repaired.
 */
enum { XML_RAW_LESS = 0x7f };

/* A file of this reading: for cycles and for including once. */
struct xml_file {
    str_id name; /* canonical */
    bool open;   /* it is being read now: including it is a cycle */
};

struct xml_reader {
    struct document *doc;
    struct mem *mem;
    const struct xml_files *files;
    struct xml_limits limits;
    struct diag_list *diags;
    struct arena scratch; /* texts, lists: gone when reading ends */
    struct _xmlParserCtxt *parser;
    void *handle; /* of the file that is open, for files->release */
    bool handle_open;
    struct xml_source *source;
    /*
     * <xi:include> elements of the files being read, innermost last; replaced when the file is
     * parsed
     */
    VEC(elem_id) includes;
    VEC(struct xml_file) opened;
    uint32_t include_depth;
    bool stopped;                     /* of the current source: no further callback matters */
    bool raw_less;                    /* it stopped at a raw '<' in an attribute value … */
    struct diag_place raw_less_place; /* … here */
    bool repair_failed;
    bool out_of_memory; /* inside a callback or in libxml2 */
};

/*
 * The place `offset` bytes into the current source; cheap where it lies behind the last one asked
 * for.
 */
struct diag_place xml_place(struct xml_reader *reader, size_t offset);
/* The column of that, and the line in source->position. */
uint32_t xml_column(struct xml_source *source, size_t offset);

/*
 * text.c: from the bytes of a file to UTF-8 text that libxml2 can parse. false: an error was
 * reported.
 */
bool xml_prepare_text(struct xml_reader *reader, const char *data, size_t size);
/*
 * Makes the raw '<' in attribute values XML_RAW_LESS, in a copy of the source's text; false where
 * that cannot be.
 */
bool xml_repair_text(struct xml_reader *reader);

/* parse.c: the source's text becomes elements below source->root. false: an error was reported. */
bool xml_parse_source(struct xml_reader *reader);

/*
 * include.c: replaces the <xi:include> elements of a source, from index `first` of
 * reader->includes, by what they include.
 */
void xml_process_includes(struct xml_reader *reader, const struct xml_source *source,
                          uint32_t first);

/* reader.c */
/*
 * Reads a file's text and all that it includes into a root of its own, which stays outside of the
 * tree unless it is the document's root; upgraded to the current version. 0: no tree.
 */
elem_id xml_read_text(struct xml_reader *reader, const char *name, uint16_t file, elem_id root,
                      const char *data, size_t size);
/*
 * Moves a root's children before `sibling`, or to the end of `parent` where that is 0; what it says
 * about its scope goes with them.
 */
void xml_merge_root(struct document *doc, elem_id root, elem_id parent, elem_id sibling);
/*
 * Opens the file that `ref` means in the file `from`; xml_close_file releases it. One is open at a
 * time. *out_name after a failure: xml_files.
 */
bool xml_open_file(struct xml_reader *reader, const char *from, const char *ref,
                   const char **out_name, const char **out_data, size_t *out_size,
                   const char **out_reason);
void xml_close_file(struct xml_reader *reader);

#endif
