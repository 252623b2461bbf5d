// SPDX-License-Identifier: Apache-2.0
/*
 * Declarations that the files of the version upgrade share. Each version has one step, which
 * consists of tables and a few functions.
 */
#ifndef MXG_DOCUMENT_UPGRADE_H
#define MXG_DOCUMENT_UPGRADE_H

#include "document/document.h"

struct upgrade {
    struct document *doc;
    struct diag_list *diags;
    elem_id root, end;   /* the elements of the file … */
    elem_id first_added; /* … and the elements that the upgrade added */
    elem_id pass_end;
    int minor;                /* of the current step: 38 upgrades 1.37 to 1.38 */
    struct table definitions; /* nodedefs by node, and by node and type: upgrade_materials.c */
    bool has_definitions;     /* they are those of the document as it is now */
    bool outdated; /* the document declares this version or a later one, so changes are warnings */
};

/*
 * Iterates over the elements that the upgrade changes, without elements that it adds meanwhile. 0
 * after the last.
 */
elem_id upgrade_first(struct upgrade *u);
elem_id upgrade_next(const struct upgrade *u, elem_id element);

str_id upgrade_word(struct upgrade *u, const char *text);
bool upgrade_is(const struct upgrade *u, str_id word, const char *text);
bool upgrade_is_category(const struct upgrade *u, elem_id element, const char *category);
bool upgrade_is_node(const struct upgrade *u, elem_id element);
str_id upgrade_attr(const struct upgrade *u, elem_id element, const char *name);
elem_id upgrade_child(const struct upgrade *u, elem_id parent, const char *name);

/* Reports a change of an element. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
void upgrade_note(struct upgrade *u, elem_id element, const char *format, ...);

/* Warns of a meaning that the upgrade cannot keep. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
void upgrade_tell_loss(struct upgrade *u, elem_id element, const char *format, ...);

/* Changes that keep the name index valid. */
void upgrade_set_name(struct upgrade *u, elem_id element, str_id name);
void upgrade_move(struct upgrade *u, elem_id element, elem_id new_parent);
/* `name`, or `name` with a number if the scope already has the name. */
str_id upgrade_free_name(struct upgrade *u, elem_id scope, const char *name);
/* Adds a node with a free name before `before`, in the same scope. */
elem_id upgrade_add_node(struct upgrade *u, elem_id before, const char *name, const char *category,
                         str_id type);
elem_id upgrade_add_input(struct upgrade *u, elem_id node, const char *name, str_id type,
                          str_id value);
/* Changes the category and removes the nodedef of the old one. */
void upgrade_set_category(struct upgrade *u, elem_id node, const char *category);
void upgrade_remove_input(struct upgrade *u, elem_id node, const char *name);

/* Ports: inputs and outputs. */
/* the nodegraph or document that contains the target of a nodename */
elem_id upgrade_scope(const struct upgrade *u, elem_id port);
/* the node of the nodename; 0: none */
elem_id upgrade_upstream(const struct upgrade *u, elem_id port);
/* the type of the connection's source; 0: unknown */
str_id upgrade_upstream_type(const struct upgrade *u, elem_id port);
/* Lets a value that became a colour have its numbers in any colour space around it. */
void upgrade_keep_numbers(struct upgrade *u, elem_id input);
void upgrade_connect(struct upgrade *u, elem_id port, elem_id node, const char *output);
/*
 * Copies `source` to an input `name` of `node`. A NULL type keeps the type of the source. Does
 * nothing if `source` is 0.
 */
void upgrade_copy_input(struct upgrade *u, elem_id source, elem_id node, const char *name,
                        const char *type);

/* upgrade_materials.c */
void upgrade_opgraphs(struct upgrade *u);           /* 1.34 */
void upgrade_material_overrides(struct upgrade *u); /* 1.36 */
void upgrade_legacy_nodedefs(struct upgrade *u);    /* 1.37 */
void upgrade_materials(struct upgrade *u);          /* 1.38 */

/* upgrade_closures.c */
void upgrade_closures(struct upgrade *u);    /* 1.38 */
void upgrade_complex_ior(struct upgrade *u); /* 1.38 */

/* upgrade_films.c */
void upgrade_thin_films(struct upgrade *u); /* 1.39 */

/* upgrade_defaults.c: writes inputs that had another default before the current step. */
void upgrade_defaults(struct upgrade *u);

/* upgrade_always.c: every version */
/* Gives a node that reads a property of the geometry its inputs, and strings their category. */
void upgrade_property(struct upgrade *u, elem_id element);
void upgrade_always(struct upgrade *u);
/* True if it may change the element. */
bool upgrade_always_changes(const struct document *doc, elem_id element);

/* upgrade_channels.c */
void upgrade_color2_channels(struct upgrade *u); /* 1.38 */
void upgrade_channels(struct upgrade *u);        /* 1.39: attributes, then swizzle nodes */
void upgrade_swizzles(struct upgrade *u);

#endif
