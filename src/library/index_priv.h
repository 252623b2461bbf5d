// SPDX-License-Identifier: Apache-2.0
/* Declarations that the files which fill a library layer share. */
#ifndef MXG_LIBRARY_INDEX_PRIV_H
#define MXG_LIBRARY_INDEX_PRIV_H

#include "base/scan.h"
#include "library/library.h"

#include <assert.h>

/* The ports of a nodedef in the layer's list, with those that it inherits: inputs, then outputs. */
struct port_list {
    elem_id nodedef;
    uint32_t first;
    uint16_t num_inputs, num_outputs;
    uint16_t depth; /* nodedefs in its chain of inheritance, which the first one ends */
    bool is_open;   /* what it inherits is not known yet */
};

struct indexer {
    struct library *lib;
    struct arena *arena;
    const struct lang_reader *reader;
    struct diag_list *diags;
    struct table claims; /* definition and target -> index of an implementation + 1 */
    VEC(struct port_list) port_lists;
    struct table port_table; /* nodedef -> index of its list + 1 */
};

enum {
    INDEX_MAX_PORTS = 1024,   /* inputs of a definition, because lookups are linear */
    INDEX_MAX_VARIANTS = 256, /* definitions of a node, and implementations of a definition */
    INDEX_MAX_TARGETS = 64,   /* of a definition or an implementation */
};

static inline const char *index_text(const struct indexer *ix, str_id id)
{
    return str_text(&ix->lib->strings, id);
}

/* The value of an attribute; 0: absent. */
static inline str_id index_attr(const struct indexer *ix, elem_id element, str_id name)
{
    return doc_attr_value(&ix->lib->doc, element, name);
}

/* The name of the file that an element stands in; "" without a file. */
static inline const char *index_file(const struct indexer *ix, elem_id element)
{
    const char *name = doc_place(&ix->lib->doc, element).file;
    return name ? name : "";
}

/* The type of an element; false after a diagnostic. */
bool index_type(struct indexer *ix, elem_id element, doc_type *out_type);

/*
 * ports.c: the ports of a nodedef of this layer or a lower one; those of the nodedefs that it
 * inherits come first into the layer's list. The result is valid until the next call.
 */
const struct port_list *index_ports(struct indexer *ix, elem_id nodedef);

/* targets.c: the names in the attribute `target`, each once; at least one, 0: for all targets. */
struct index_targets {
    str_id items[INDEX_MAX_TARGETS];
    uint32_t len;
};
void index_read_targets(struct indexer *ix, elem_id element, struct index_targets *out);

/* implement.c: adds the implementation of an <implementation>, or of a functional <nodegraph>. */
void index_implementation(struct indexer *ix, elem_id element);
void index_functional_graph(struct indexer *ix, elem_id element);
/* Notes a graph of this layer as the implementation with this own index, unless it is one. */
void index_note_graph(struct indexer *ix, elem_id graph, uint32_t own);
/*
 * Gives mxgen's own code to operators of closures and to materials that lack an implementation for
 * a target of mxgen. Generators of MaterialX read materials themselves, so its libraries implement
 * few of them.
 */
void index_operators(struct indexer *ix);
/* Links the implementations of each definition, the first one at its head. */
void index_link_implementations(struct indexer *ix);

/* Finds the function of an implementation in a parsed file; false after a diagnostic. */
bool index_find_function(struct indexer *ix, struct implementation *impl, str_id name,
                         uint32_t file, struct diag_list *diags);
/*
 * Parses one inline expression per output: of the <implementation>, or of its <output> children.
 */
bool index_parse_expressions(struct indexer *ix, struct implementation *impl, str_id source,
                             uint32_t file, struct diag_list *diags);
/* Makes an implementation report these diagnostics when a node uses it. */
void index_break(struct library *lib, struct implementation *impl, const struct diag_list *faults);

/*
 * served.c: makes an implementation without source one by portable source of mxgen; false if none
 * serves its node.
 */
bool index_served(struct indexer *ix, struct implementation *impl);

/* verbatim_implementations.c */

/*
 * The text of a source file, interned; 0 after a diagnostic. `from` is the file that refers to it.
 */
str_id index_read_source(struct indexer *ix, elem_id element, str_id file, struct diag_list *diags);
/*
 * An expression for one target without the semicolons at its end: MaterialX makes statements of
 * expressions.
 */
str_id index_expression(struct indexer *ix, str_id source);
/* True if the file holds an inline expression. */
bool index_is_inline(const struct indexer *ix, str_id file);
/*
 * Makes an implementation verbatim: source for one target, which `faults` say is not portable.
 * false after diagnostics: the source cannot be read, or its function does not fit.
 */
bool index_verbatim(struct indexer *ix, struct implementation *impl, const struct diag_list *faults,
                    struct diag_list *diags);

/* portable.c */

/* True if the source of an implementation may use the functions of MaterialX's generators. */
bool index_has_prelude(const struct indexer *ix, const struct implementation *impl);
/*
 * Parses a file of such an implementation, or, with ref NULL, these functions alone: LANG_NONE
 * after diagnostics.
 */
uint32_t index_parse_with_prelude(struct indexer *ix, const char *from, const char *ref,
                                  struct diag_place where, struct diag_list *diags);
/*
 * The path of an #include. "$fileTransformUv" is the file that transforms texture coordinates, in
 * the language of the including file `from`.
 */
const char *index_include_path(struct indexer *ix, const char *from, const char *path);
/* The text with each token replaced, interned. */
str_id index_replace_token(struct indexer *ix, const char *text, size_t len, const char *token,
                           const char *replacement);

/* source_files.c */

/*
 * The source file `ref` with the files that it includes; LIBRARY_NONE after a diagnostic at
 * `where`. `from` is the name of the referring file, `user` the name of the user in the message.
 */
uint32_t index_source_file(struct indexer *ix, const char *from, const char *ref, const char *user,
                           struct diag_place where, struct diag_list *diags);
/*
 * Finds the files of library_implied_includes that a verbatim source needs; false after a
 * diagnostic.
 */
bool index_implied_includes(struct indexer *ix, const struct implementation *impl,
                            struct verbatim *verbatim, struct diag_list *diags);

struct source_parameter {
    struct scan_word type, name; /* len 0: unknown, because of a macro or a $token */
};
enum { INDEX_MAX_PARAMETERS = 255 }; /* of SPIR-V, and of the portable language */
enum { SOURCE_NO_FUNCTION = -1, SOURCE_MANY_PARAMETERS = -2 };
/*
 * The parameters of a function that a source file or one of its includes defines. Returns their
 * number, or a value below 0.
 */
int index_source_function(const struct indexer *ix, uint32_t file, const char *name,
                          struct source_parameter *out);

#endif
