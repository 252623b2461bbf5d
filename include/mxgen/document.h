// SPDX-License-Identifier: Apache-2.0
/*
 * Documents as objects: their text, their elements, and edits.
 */
#include <mxgen/mxgen.h>

#ifndef MXGEN_DOCUMENT_H
#define MXGEN_DOCUMENT_H

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Elements ---- */

/*
 * The number of an element in a document; 0: none. A document that an edit makes keeps the numbers
 * of the document that it comes from. The tree is the one that generation sees: after includes,
 * templates, the upgrade to 1.39, and with namespaces in the names. Elements of the library are not
 * part of it. Functions below accept any number: one that is not in the document counts as 0.
 */
typedef uint32_t mxg_element;

/*
 * By path below an element, "NG_marble1/out"; "" is the element itself, and `below` 0 is the root,
 * <materialx>.
 */
MXG_API mxg_element mxg_document_find_element(const mxg_document *document, mxg_element below,
                                              const char *path);
/* The length is 0 for the root and for no element. */
MXG_API size_t mxg_document_element_path(const mxg_document *document, mxg_element element,
                                         char *buffer, size_t capacity);

typedef struct mxg_element_info {
    size_t size;                           /* in */
    const char *category;                  /* "nodegraph", "input", "standard_surface" */
    const char *name;                      /* "" if it has none */
    const char *type;                      /* the attribute `type`; "" if absent */
    mxg_element parent, first_child, next; /* 0: none */
    uint32_t num_attributes;               /* without the name */
    /* where the element begins: line and column from 1; file NULL and line 0 after an edit */
    const char *file;
    uint32_t line, column;
} mxg_element_info;
MXG_API mxg_status mxg_document_element(const mxg_document *document, mxg_element element,
                                        mxg_element_info *out);

typedef struct mxg_attribute {
    size_t size; /* in */
    const char *name, *value;
} mxg_attribute;
MXG_API mxg_status mxg_document_attribute(const mxg_document *document, mxg_element element,
                                          uint32_t index, mxg_attribute *out);
/* The index of an attribute; MXG_NONE: it is absent. */
MXG_API uint32_t mxg_document_find_attribute(const mxg_document *document, mxg_element element,
                                             const char *name);

/* The value of an input, output, token or other element with `value`. */
typedef struct mxg_value {
    size_t size; /* in */
    const char *type, *text;
    /*
     * Components of a number, integer, boolean (0 or 1), colour, vector or matrix; 0 for all other
     * types, and for a text that is not a value of the type.
     */
    uint32_t num_values;
    float values[16];
    int32_t integer; /* the exact value of an integer */
} mxg_value;
/* MXG_ERROR_ARGUMENT if the element has no value. */
MXG_API mxg_status mxg_document_value(const mxg_document *document, mxg_element element,
                                      mxg_value *out);

/* The element that an input or output is connected to, as the document says it. */
typedef struct mxg_connection {
    size_t size; /* in */
    /*
     * A node or nodegraph; for an `interfacename` the input of the nodegraph, or 0 if a definition
     * declares the input.
     */
    mxg_element source;
    const char *output; /* the name of the output of `source`; "" if the document names none */
    const char *interfacename; /* "" if absent */
} mxg_connection;
/*
 * MXG_ERROR_ARGUMENT if the element is not connected. MXG_ERROR_DOCUMENT if it names an element
 * that does not exist.
 */
MXG_API mxg_status mxg_document_connection(const mxg_document *document, mxg_element port,
                                           mxg_connection *out);

/*
 * The definition of a node, or of the nodegraph that implements it. The index counts through the
 * library and the document: mxg_document_nodedef. MXG_NONE: there is none, or it does not fit; the
 * diagnostics of mxg_validate give the reason.
 */
MXG_API uint32_t mxg_document_find_nodedef(const mxg_document *document, mxg_element element);
/* Like mxg_library_nodedef and its neighbours, with the definitions of the document as well. */
MXG_API uint32_t mxg_document_num_nodedefs(const mxg_document *document);
MXG_API mxg_status mxg_document_nodedef(const mxg_document *document, uint32_t index,
                                        mxg_nodedef *out);
MXG_API mxg_status mxg_document_port(const mxg_document *document, uint32_t nodedef, uint32_t index,
                                     mxg_port *out);
MXG_API uint32_t mxg_document_num_implementations(const mxg_document *document, uint32_t nodedef);
MXG_API mxg_status mxg_document_implementation(const mxg_document *document, uint32_t nodedef,
                                               uint32_t index, mxg_implementation *out);

/*
 * The document as MaterialX XML, in the layout of MXG_REWRITE_FORMAT; comments stay, includes are
 * replaced by the elements of their files, where a `fileprefix` leads to the files beside them.
 * Reading the text gives an equal tree but for this. NULL: out of memory.
 */
MXG_API const char *mxg_document_xml(const mxg_document *document, size_t *out_size);

/* ---- Edits ---- */

/*
 * Makes a document from another one, or from nothing. Documents stay immutable: mxg_edit_commit
 * makes the next one, which shares memory with the document that it comes from. An edit takes time
 * and memory for its changes, however large the document. Only a change of a definition, the first
 * material of a document, the removal of the last one, and what is upgraded take the time of an
 * index of the whole, and so does an edit after as many changes as the document has elements.
 *
 *     mxg_edit *edit;
 *     mxg_edit_create(ctx, lib, NULL, "gold", &edit);
 *     mxg_element shader =
 *         mxg_edit_add_element(edit, 0, "standard_surface", "SR", "surfaceshader");
 *     mxg_edit_set_value(edit, shader, "base_color", NULL, "0.9, 0.6, 0.2");
 *     mxg_element material = mxg_edit_add_element(edit, 0, "surfacematerial", "Gold", "material");
 *     mxg_edit_connect_input(edit, material, "surfaceshader", shader, NULL);
 *     mxg_edit_commit(edit, &doc);
 *     mxg_edit_destroy(edit);
 *
 * An edit that fails changes nothing, returns MXG_ERROR_ARGUMENT (or 0 for an element), and
 * mxg_edit_error gives the reason. The calls check what they can check alone: names, places in the
 * tree, text that XML can hold. mxg_edit_commit checks the rest like mxg_document_parse, and
 * upgrades what documents of version 1.39 still contain of earlier ones: the document is that of
 * its text. One thread at a time may use an edit.
 */
typedef struct mxg_edit mxg_edit;

/*
 * `from` NULL: an empty document of version 1.39, whose `name` appears in messages; files that it
 * names are relative to it (NULL: "<edit>"). Otherwise the document `from` with its name, whose
 * library must be `library`. `from` may end before the edit; its context must outlive the document
 * that the edit makes.
 */
MXG_API mxg_status mxg_edit_create(mxg_context *context, mxg_library *library,
                                   const mxg_document *from, const char *name, mxg_edit **out_edit);

/* An element of the edit, as it is now. */
MXG_API mxg_element mxg_edit_find_element(const mxg_edit *edit, mxg_element below,
                                          const char *path);

/*
 * Appends an element; parent 0 is the root. `name` and `type` may be NULL. A name must be valid and
 * new below the parent. The category has one prefix at most, and not "xml", "xmlns" or "xi": an
 * edit includes no files; mxg_edit_copy_element copies their elements.
 */
MXG_API mxg_element mxg_edit_add_element(mxg_edit *edit, mxg_element parent, const char *category,
                                         const char *name, const char *type);
/*
 * Sets an attribute; a value of NULL removes it. "name" works like mxg_edit_rename_element. The
 * attributes and prefixes of XML ("xmlns", "xml:lang") cannot be set, and no two attributes that
 * differ in their prefixes alone. The version of the root is 1.39.
 */
MXG_API mxg_status mxg_edit_set_attribute(mxg_edit *edit, mxg_element element,
                                          const char *attribute, const char *value);
/*
 * Renames an element, and changes every attribute that names it: of connections, definitions,
 * types, units, looks, frames of editors. An input or token of a nodedef has its new name also in
 * nodes, variants, implementations and nodedefs that have it from there. Names inside of values
 * stay ("[token]" of a file, "{{input}}" of source code).
 */
MXG_API mxg_status mxg_edit_rename_element(mxg_edit *edit, mxg_element element, const char *name);
/*
 * Gives an input of a node a value, and removes its connection. Adds the input if the node has
 * none of this name. `type` NULL: the type of the input that is there, or else the type that the
 * definition of the node gives it. An edit does not know the definitions that it adds itself.
 */
MXG_API mxg_status mxg_edit_set_value(mxg_edit *edit, mxg_element node, const char *input,
                                      const char *type, const char *value);
/*
 * Sets a number, integer, boolean, colour, vector or matrix. An integer is whole and from -2^24 to
 * 2^24, where floats have all of them; others are set as text. A boolean is 0 or 1.
 */
MXG_API mxg_status mxg_edit_set_numbers(mxg_edit *edit, mxg_element node, const char *input,
                                        const char *type, const float *values, uint32_t num_values);
/*
 * Connects an input of a node, or an <output> element (then `input` is NULL), to a node or
 * nodegraph beside it, to a nodegraph of the root, or to an input of the nodegraph around it.
 * Removes the value. Adds the input if it is missing, with the type of `from`, or of its output
 * `output` (NULL: the only one).
 */
MXG_API mxg_status mxg_edit_connect_input(mxg_edit *edit, mxg_element node, const char *input,
                                          mxg_element from, const char *output);
/*
 * Removes an element with all below it. References to it that are still there at the end are errors
 * of mxg_edit_commit's document.
 */
MXG_API mxg_status mxg_edit_remove_element(mxg_edit *edit, mxg_element element);
/*
 * Moves an element before another one (`before` 0: to the end) below `parent` (0: the root). Its
 * values keep their meaning: it gets the attributes `colorspace`, `fileprefix` and `geomprefix`
 * that it inherited, where the new place says something else.
 */
MXG_API mxg_status mxg_edit_move_element(mxg_edit *edit, mxg_element element, mxg_element parent,
                                         mxg_element before);
/*
 * Appends a copy of an element of any document, with all below it. `name` NULL or "" keeps the
 * name, which must be new below the parent. Its values keep their meaning, as those of an element
 * that moves.
 */
MXG_API mxg_element mxg_edit_copy_element(mxg_edit *edit, mxg_element parent,
                                          const mxg_document *document, mxg_element element,
                                          const char *name);
/*
 * Replaces a node by the nodes of the nodegraph that implements its definition. Their names begin
 * with its name; the one behind its only output has the name itself, and whatever read the node
 * reads its outputs there. They give the values that the node gave: inputs of the definition are
 * those of the node, or their defaults. A node whose values they cannot give stays, with the reason
 * in mxg_edit_error: its results are converted from the colour space of a file that its graph
 * changes, or it reads an interface in another unit than its own. Nodes with definitions that are
 * nodegraphs stay as they are; each takes a call of its own. An edit does not know the definitions
 * that it adds itself.
 */
MXG_API mxg_status mxg_edit_flatten_node(mxg_edit *edit, mxg_element node);

/*
 * Moves nodes of the root into a new nodegraph, in this order, and returns it. Each source outside
 * that they read becomes an input of the nodegraph, with the name of the input that reads it first;
 * each result that others read becomes an output, "NODE_out" or "NODE_OUTPUT". Names
 * that the nodegraph has already get a number. An element that refers to a node otherwise, as the
 * assignment of a material does, is an error.
 */
MXG_API mxg_element mxg_edit_group_nodes(mxg_edit *edit, const mxg_element *nodes,
                                         uint32_t num_nodes, const char *name);

/*
 * Makes the definition `name` of the kind of node `node` from a nodegraph of the root, which then
 * implements it, and returns the definition. Inputs and tokens of the nodegraph become those of the
 * definition; its outputs stay and are declared there, too. Where elements read the nodegraph, or
 * its inputs read elements, a node of the definition takes its place, with a name like `node`. An
 * element that refers to the nodegraph otherwise is an error.
 */
MXG_API mxg_element mxg_edit_define_nodegraph(mxg_edit *edit, mxg_element nodegraph,
                                              const char *name, const char *node);

/* The reason of the last failure; length 0 if no call failed. */
MXG_API size_t mxg_edit_error(const mxg_edit *edit, char *buffer, size_t capacity);

/*
 * Makes the document, which ends the edit: further calls fail. *out_document is set whenever memory
 * allows, also with MXG_ERROR_DOCUMENT. Diagnostics name an element that the edit added by its
 * path, because it has no line.
 */
MXG_API mxg_status mxg_edit_commit(mxg_edit *edit, mxg_document **out_document);
MXG_API void mxg_edit_destroy(mxg_edit *edit);

/* ---- Text for text ---- */

typedef enum mxg_rewriting {
    /*
     * The document as it is, in one layout: an element per line, two spaces per level, the name as
     * the first attribute, at most one blank line in a row. Comments, includes and the order of
     * elements and attributes stay.
     */
    MXG_REWRITE_FORMAT,
    /*
     * Formats after the upgrade of an older version (1.22 to 1.38) to 1.39. The remarks `upgraded`
     * in the diagnostics describe each change. Files that it includes stay as they are.
     */
    MXG_REWRITE_UPGRADE,
    MXG_REWRITING_MAX_ENUM = 0x7fffffff
} mxg_rewriting;

/*
 * Reads a document and writes it again: mxg_result_text returns the text. `data` NULL: reads the
 * file `name` with the resolver. *out_result is set whenever memory allows; with
 * MXG_ERROR_DOCUMENT, for example for a text that is not XML, it has diagnostics but no text.
 */
MXG_API mxg_status mxg_rewrite(mxg_context *context, mxg_rewriting rewriting, const char *name,
                               const char *data, size_t size, mxg_result **out_result);

/* ---- Other models ---- */

/*
 * The document with each surface as one of another model, a node category like "gltf_pbr": its
 * inputs become graphs of the old surface's inputs, and constants where those are. The translations
 * are nodes of the library and of the document (docs/translate.md); surfaces of closures become
 * slabs first. mxg_result_text returns the new document as XML; warnings tell what is lost. A
 * surface that has the model already stays. *out_result is set whenever memory allows; with
 * MXG_ERROR_DOCUMENT it has diagnostics but no text.
 */
MXG_API mxg_status mxg_translate(mxg_context *context, const mxg_document *document,
                                 const char *model, mxg_result **out_result);

/*
 * mxg_translate for formats whose materials have one surface each: a surface that is made of
 * others, such as their <mix>, becomes one by way of slabs, and what only such surfaces read goes.
 */
MXG_API mxg_status mxg_translate_joined(mxg_context *context, const mxg_document *document,
                                        const char *model, mxg_result **out_result);

#ifdef __cplusplus
}
#endif

#endif
