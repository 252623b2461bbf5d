// SPDX-License-Identifier: Apache-2.0
/* The calls of an edit share this state. */
#ifndef MXG_API_EDIT_H
#define MXG_API_EDIT_H

#include "api/api.h"

/* A reference to an element that the edit removed. */
struct lost_reference {
    elem_id user, parent; /* `parent` had the element */
    str_id attr, name;
    uint16_t kind; /* enum element_kind of the element */
};

struct mxg_edit {
    struct object object;            /* owns the texts of errors; holds the document */
    mxg_document *document;          /* NULL: the edit has made it */
    bool is_unchecked;               /* it has elements that no call below checked and indexed */
    VEC(struct lost_reference) lost; /* in the arena of the document */
    struct text error;
};

static inline struct document *edit_tree(const mxg_edit *edit)
{
    return &edit->document->layer.doc;
}

/* The arguments of a public function; each uses those it needs. */
struct edit_change {
    mxg_edit *edit;
    elem_id element, other, before;
    const char *category, *name, *type, *text;
    const mxg_document *source;
    const float *numbers;
    uint32_t num_numbers;
    const elem_id *nodes;
    uint32_t num_nodes;
    elem_id result;
    bool failed;
};

/* Runs work(change). The status of the call: MXG_ERROR_ARGUMENT after edit_fail. */
mxg_status edit_run(struct edit_change *change, void (*work)(void *arg));

/* Gives the reason why the change fails. Without memory it has no text. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void edit_fail(struct edit_change *change, const char *format, ...);

/* These checks return false after edit_fail. */
/* A text that goes into the document; NULL counts as empty. */
bool edit_check_text(struct edit_change *change, const char *what, const char *text);
bool edit_check_name(struct edit_change *change, const char *what, const char *name);
/* The name of an element or attribute, which is one of XML, too. */
bool edit_check_xml_name(struct edit_change *change, const char *what, const char *name);
/* A name that no element below the parent has. */
bool edit_check_new_name(struct edit_change *change, elem_id parent, const char *name);
/* The document may have so many elements more. */
bool edit_check_room(struct edit_change *change, uint64_t num);
/* The number is that of an element; 0 becomes the root, if that is allowed. */
bool edit_check_element(struct edit_change *change, elem_id *element, bool may_be_root);

/* The element of a name directly below; 0: none. */
elem_id edit_child(const mxg_edit *edit, elem_id parent, const char *name);
elem_id edit_add(struct edit_change *change, elem_id parent, const char *category, const char *name,
                 const char *type);
/* The name of an element, or its category if it has no name. */
const char *edit_label(const mxg_edit *edit, elem_id element);
/* Backdrops around an element contain another one of the name in its place; 0: nothing. */
void edit_replace_in_frames(struct edit_change *change, elem_id element, str_id name);
/* The text in the pool of the document; NULL is "". */
str_id edit_word(const struct edit_change *change, const char *text);

/*
 * The tree of the edit with the definitions that it knows, those of its origin: what it defines
 * itself is unknown. For reading, until the next change.
 */
void edit_view(const mxg_edit *edit, struct library *out);
/* The definition of a node, and the view. LIBRARY_NONE: there is none. */
uint32_t edit_find_definition(const struct edit_change *change, elem_id node, struct library *view);

/*
 * The type of what `other` gives by its output `text`, NULL: the only one. "": it is unknown.
 */
const char *edit_source_type(const struct edit_change *change);

/* The nodegraph that implements a definition for every target; 0: there is none. */
elem_id edit_find_graph(const struct library *lib, uint32_t nodedef);
/* edit_scope.c: what an element inherits that counts for it; NULL: it does not. */
enum { EDIT_NUM_SCOPES = 3 };
struct edit_scope {
    const char *values[EDIT_NUM_SCOPES];
};
void edit_note_scope(const struct document *doc, elem_id element, struct edit_scope *out);
/* Lets an element at its new place inherit what it had. */
void edit_keep_scope(struct edit_change *change, elem_id element, const struct edit_scope *scope);

/* Fails if the nodes of this graph cannot have the values of the node that the change is of. */
void edit_check_flat(struct edit_change *change, const struct library *lib, uint32_t nodedef,
                     elem_id graph);

#endif
