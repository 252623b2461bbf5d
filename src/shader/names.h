// SPDX-License-Identifier: Apache-2.0
/*
 * names: unique identifiers for interface variables and all declarations of a stage.
 *
 * There is no global counter: the second "roughness" of a function is "roughness_2", so a small
 * edit of the input gives a small difference in the output. A reserved word of the language gets an
 * underscore.
 */
#ifndef MXG_SHADER_NAMES_H
#define MXG_SHADER_NAMES_H

#include "base/table.h"
#include "print/print.h"

struct name_entry {
    const char *text;
    uint32_t len;
    /* 0: file scope; UINT32_MAX: none any more; otherwise a function, which frees its names at its
     * end */
    uint32_t scope;
    uint32_t next; /* next number to try for this name */
};

struct spell_name { /* in the output */
    const char *text;
    size_t len;
};

/* The names that the host chooses: the options `prefix` and `rename`. */
struct name_rules {
    const char *prefix; /* of all names at file scope; "": none */
    struct name_pair {
        const char *from, *to; /* the name without prefix; the name in the source */
        size_t from_len;
    } * renamed;
    uint32_t num_renamed;
};
/* The name that the host gives; NULL: it gives none. */
const char *names_renamed(const struct name_rules *rules, const char *text, size_t len);

struct name_set {
    struct arena *arena;
    /* of names at file scope; NULL: none. Set after names_init */
    const struct name_rules *rules;
    const struct lang_syntax *syntax; /* NULL: no word is reserved */
    VEC(struct name_entry) entries;
    struct table table;  /* 1 + index of the entry */
    uint32_t scope;      /* of the current function; 0 at file scope */
    VEC(uint32_t) taken; /* by the current function, in order */
};

void names_init(struct name_set *names, struct arena *arena, const struct lang_syntax *syntax);
struct shader;
struct role;
/*
 * Takes the names in the frame of every shader ("main", "vd", …), and those that its host keeps or
 * gives.
 */
void names_take_frame(struct name_set *names, const struct shader *shader);
/* A name of the frame as it is in the source: "PublicUniforms", "wood_PublicUniforms". */
const char *names_of_frame(const struct shader *shader, const char *name);
/* True if the frame of a role has the name for anything but `but`, once names are changed. */
bool names_frame_has(const struct name_rules *rules, const struct role *role, const char *name,
                     const char *but, struct arena *arena);
/* Opens the scope of a new function, which frees the names of the previous one. */
void names_open_scope(struct name_set *names);
/*
 * Opens a block of the function. names_close_block frees the names of the block; `block` is the
 * result of names_open_block. A name in a block differs from those of the blocks around it.
 */
uint32_t names_open_block(const struct name_set *names);
void names_close_block(struct name_set *names, uint32_t block);
/* The texts for the next two functions must live as long as the set. */
/*
 * Makes `text` an identifier, with a number as suffix if the name is taken. At file scope the rules
 * apply first.
 */
struct spell_name names_unique(struct name_set *names, const char *text, size_t len);
/* Takes a name unchanged; false if it is taken already. */
bool names_take(struct name_set *names, const char *text, size_t len);
/*
 * True if names_unique would return the identifier unchanged, apart from the underscore of a
 * reserved word.
 */
bool names_is_free(const struct name_set *names, const char *text, size_t len);

#endif
