// SPDX-License-Identifier: Apache-2.0
/*
 * Text layers of USD (`#usda 1.0`), as `usdcat --flatten` writes them: prims, their properties and
 * the metadata that binding needs. The reader checks the syntax of the whole file; it keeps values
 * as text.
 */
#ifndef MXG_USDA_USDA_H
#define MXG_USDA_USDA_H

#include "base/table.h"
#include "base/text.h"
#include "diag/diag.h"

typedef uint32_t usda_prim_id; /* 0: the pseudo root */

enum usda_specifier { USDA_DEF, USDA_OVER, USDA_CLASS };

struct usda_property {
    struct text_word name;    /* "material:binding", "points.timeSamples" */
    struct text_word type;    /* of an attribute: "token[]"; of a relationship: "rel" */
    struct text_word value;   /* its text; len 0: none */
    struct text_word bind_as; /* the metadata bindMaterialAs, without quotes */
    struct text_word interpolation, color_space; /* the same for other metadata */
    uint32_t line, column;
};

struct usda_prim {
    struct text_word name, type;
    struct text_word references; /* value of the metadata; len 0: none */
    struct text_word arc;        /* the name of another arc: "payload"; len 0: none */
    usda_prim_id parent, first_child, last_child, next;
    uint32_t first_property, num_properties; /* in a row */
    uint32_t line, column;
    uint8_t specifier; /* enum usda_specifier */
    bool is_variant;   /* it stands in a variant set */
    bool is_inactive;  /* active = false */
    bool is_instance;  /* instanceable = true */
};

/* The property and the attribute that a prim has under a name. */
struct usda_named {
    usda_prim_id prim;
    uint32_t first;     /* property of this name; 0: it has samples alone */
    uint32_t samples;   /* the first property with its time samples; 0: none */
    uint32_t attribute; /* usda_find_attribute */
    struct text_word name;
};

struct usda_layer {
    struct arena *arena;
    const char *file;
    struct text_word default_prim, up_axis; /* without quotes; len 0: none */
    struct text_word meters_per_unit;       /* a number; len 0: none */
    VEC(struct usda_prim) prims;            /* a parent stands before its children */
    VEC(struct usda_property) properties;   /* 0 unused */
    VEC(struct usda_named) named;
    struct table children; /* (parent, name) → the first prim */
    struct table names;    /* (prim, name) → 1 + index in `named` */
};

enum { USDA_MAX_DEPTH = 1000 }; /* of prims in each other */

/*
 * Reads a layer of at most `max_elements` prims and properties. The text ends with a NUL and lives
 * as long as the layer. false after a diagnostic; the layer then has what stands before the fault.
 */
bool usda_read(struct usda_layer *layer, const char *file, const char *text, size_t len,
               uint32_t max_elements, struct arena *arena, struct diag_list *diags);

/* prim_tables.c: prims and properties by their names. */
/* The prim that had this name before; 0: none. */
usda_prim_id usda_index_prim(struct usda_layer *layer, usda_prim_id id);
/* Before usda_index_rows, for properties in the order of the file. */
void usda_index_property(struct usda_layer *layer, usda_prim_id prim, uint32_t property);
/* Puts the properties of each prim in a row; `prims` has the prim of each property. */
void usda_index_rows(struct usda_layer *layer, const usda_prim_id *prims, struct arena *scratch);
/* Finds what a prim has under a name; NULL: nothing. */
const struct usda_named *usda_find_named(const struct usda_layer *layer, usda_prim_id prim,
                                         struct text_word name);

/* The property of a name; NULL: none. */
const struct usda_property *usda_find_property(const struct usda_layer *layer,
                                               const struct usda_prim *prim, const char *name);
/* The property after the last one of a prim. */
static inline uint32_t usda_end_property(const struct usda_prim *prim)
{
    return prim->first_property + prim->num_properties;
}

/* The prim at an absolute path, "/a/b"; 0: none. */
usda_prim_id usda_find(const struct usda_layer *layer, const char *path, size_t len);
/* As usda_find, where a prim also has the children of its references inside the layer. */
usda_prim_id usda_find_composed(const struct usda_layer *layer, const char *path, size_t len);

/* Writes the names of a prim and of those above it: "a/b" with '/' between them. */
void usda_join(const struct usda_layer *layer, usda_prim_id prim, char between, struct text *out);

/*
 * Reads the paths or words of a list value, "[</a>, </b>]" or "</a>", one after the other: `at` is
 * the rest of the value. false: no more. A path comes without '<' and '>', a string without quotes.
 */
bool usda_next_item(struct text_word *at, struct text_word *out);

/* Reads the next number of a value: "[(0, 1), (2, 3)]"; true is 1. */
bool usda_next_number(struct text_word *at, double *out);
/*
 * The attribute of a name; without a value of its own, the property with its time samples. NULL:
 * none.
 */
#define USDA_SAMPLES ".timeSamples"
const struct usda_property *usda_find_attribute(const struct usda_layer *layer,
                                                const struct usda_prim *prim, const char *name);
/* The value of a property: its own, or its time sample with the least time; len 0: none. */
struct text_word usda_value(const struct usda_property *property);

/* A letter of an identifier: '_' is one, and so is every byte of a letter beyond ASCII. */
static inline bool usda_is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (c & 0x80);
}
static inline bool usda_is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static inline bool usda_is(struct text_word word, const char *text)
{
    return word.len == strlen(text) && (!word.len || memcmp(word.bytes, text, word.len) == 0);
}

/* A string or a name in quotes without them. */
struct text_word usda_unquoted(struct text_word word);

/* ---- lex.c ---- */

enum usda_token_kind {
    USDA_END,
    USDA_NEWLINE, /* one or more, or ';' */
    USDA_NAME,    /* with ':' and '.' in it */
    USDA_NUMBER,
    USDA_STRING,
    USDA_ASSET,
    USDA_PATH,
    USDA_MARK, /* one character */
    USDA_BAD,  /* `fault` says why */
};

struct usda_token {
    uint8_t kind; /* enum usda_token_kind */
    const char *begin, *end;
    const char *line_begin;
    uint32_t line;
};

struct usda_lexer {
    const char *at, *end;
    const char *line_begin;
    uint32_t line;
    const char *fault;
};

void usda_lexer_init(struct usda_lexer *lexer, const char *text, size_t len);
struct usda_token usda_next_token(struct usda_lexer *lexer);
/* The column of a token, from 1, in code points; saturates, so that long lines cost little. */
uint32_t usda_column(const struct usda_token *token);

#endif
