// SPDX-License-Identifier: Apache-2.0
/* Declarations that the files of the xml room share. */
#ifndef MXG_XML_XML_PRIV_H
#define MXG_XML_XML_PRIV_H

#include "xml/reader.h"

struct _xmlParserCtxt;

/* A place in the text of a source. */
struct xml_position {
    size_t offset;
    uint32_t line;   /* 0: unknown */
    uint32_t before; /* code points of the line before the offset */
};

/*
 * Characters that attribute values should not have as they are, but files do. For each a byte that
 * the file does not have stands in, so positions stay.
 */
enum { XML_NUM_RAW = 2 };
#define XML_RAW_CHARACTERS "<&"
struct xml_raw {
    size_t at;
    char character;
};

/* The current file. Its text is UTF-8 without a byte-order mark; mxgen converts other encodings. */
struct xml_source {
    const char *name; /* canonical; includes in the file are relative to it */
    uint16_t file;
    const char *text;
    size_t size;
    size_t start; /* start of the XML after skipped text */
    /* raw '<' and '&' in attribute values, which the text replaces by stand-ins */
    VEC(struct xml_raw) raw;
    char stand_ins[XML_NUM_RAW]; /* as long as there are raw ones */
    elem_id root;
    bool is_ascii;                /* a column is a byte */
    struct xml_position position; /* the last tag or value */
    elem_id current;              /* the innermost open element */
    uint32_t depth;               /* open elements */
    VEC(str_id) comments;         /* read, but not yet given to an element; 0: a blank line */
    elem_id ended;                /* the element that ended last on the current line; 0 = none */
    uint32_t num_line_ends;       /* after the last tag or comment */
    bool is_first;                /* nothing stands between the last start tag and here */
    bool warned_prefix, warned_text;
};

/* A file of this document, to detect cycles and to include each file once. */
struct xml_file {
    str_id name; /* canonical */
    bool open;   /* the parser is inside this file: including it is a cycle */
};

struct xml_reader {
    struct document *doc;
    struct mem *mem;
    const struct xml_files *files;
    struct xml_limits limits;
    struct diag_list *diags;
    struct arena scratch; /* texts and lists; freed after reading */
    struct _xmlParserCtxt *parser;
    void *handle; /* of the open file, for files->release */
    bool handle_open;
    struct xml_source *source;
    /*
     * <xi:include> elements of the open files, innermost last; replaced after the parse of the file
     */
    VEC(elem_id) includes;
    VEC(struct xml_file) opened;
    uint32_t include_depth;
    bool stopped;       /* the current source has an error: further callbacks do nothing */
    char raw_character; /* the error may be a raw one in an attribute value; 0: it is not … */
    struct diag_place raw_place; /* … here */
    bool repair_failed;
    bool out_of_memory; /* inside a callback or in libxml2 */
};

/* The place at an offset into the current source. Fast if the offsets ascend. */
struct diag_place xml_place(struct xml_reader *reader, size_t offset);
/* The column of the offset; sets the line in source->position. */
uint32_t xml_column(struct xml_source *source, size_t offset);

/* encoding.c: converts the bytes of a file to UTF-8 text for libxml2. false after a reported error.
 */
bool xml_prepare_text(struct xml_reader *reader, const char *data, size_t size);
/* false after an error: a start tag has too many attributes. */
bool xml_check_attributes(struct xml_reader *reader);
/*
 * Replaces raw characters of attribute values by stand-ins, in a copy of the source's text. false
 * if there are none, or no bytes to stand in.
 */
bool xml_repair_text(struct xml_reader *reader);

/*
 * read_comment.c: gives the comments of a file to elements. Each function is called for one part of
 * the text, in the order of the text; none does anything if the document keeps no comments.
 */
void xml_see_comment(struct xml_reader *reader, str_id text);
void xml_see_start(struct xml_reader *reader, elem_id element);
void xml_see_end(struct xml_reader *reader, elem_id element);
void xml_see_file_end(struct xml_reader *reader, elem_id root);

/* sax.c: parses the source into elements below source->root. false after a reported error. */
bool xml_parse_source(struct xml_reader *reader);

/*
 * include.c: replaces the <xi:include> elements of a source, from index `first` of
 * reader->includes, by the included elements.
 */
void xml_process_includes(struct xml_reader *reader, const struct xml_source *source,
                          uint32_t first);

/* reader.c */
/*
 * Reads the text of a file with its includes into a separate root, and upgrades it. The root stays
 * outside the tree unless it is the root of the document. 0 after an error.
 */
elem_id xml_read_text(struct xml_reader *reader, const char *name, uint16_t file, elem_id root,
                      const char *data, size_t size);
/*
 * Moves the children of a root before `sibling`, or to the end of `parent` if `sibling` is 0,
 * together with the attributes of their scope.
 */
void xml_merge_root(struct document *doc, elem_id root, elem_id parent, elem_id sibling);
/*
 * Opens the file `ref` of the file `from`; xml_close_file releases it. Only one file is open at a
 * time. For *out_name after a failure see xml_files.
 */
bool xml_open_file(struct xml_reader *reader, const char *from, const char *ref,
                   const char **out_name, const char **out_data, size_t *out_size,
                   const char **out_reason);
void xml_close_file(struct xml_reader *reader);

#endif
