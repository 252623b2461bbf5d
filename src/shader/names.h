// SPDX-License-Identifier: Apache-2.0
/*
 * names: unique identifiers, of interface variables and of everything that a stage declares.
 *
 * There is no global counter: the second "roughness" of a function is "roughness_2", so that a
 * small edit of the input gives a small difference in the output. A word that the language reserves
 * gets an underscore.
 */
#ifndef MXG_SHADER_NAMES_H
#define MXG_SHADER_NAMES_H

#include "base/table.h"
#include "print/print.h"

struct name_entry {
    const char *text;
    uint32_t len;
    uint32_t scope; /* 0: file scope; else a function, whose names are free again after it */
    uint32_t next;  /* the number to try for the next of this name */
};

struct spell_name { /* as it is written */
    const char *text;
    size_t len;
};

struct name_set {
    struct arena *arena;
    const struct lang_syntax *syntax; /* NULL: no word is reserved */
    VEC(struct name_entry) entries;
    struct table table; /* entry + 1 */
    uint32_t scope;     /* of the function at hand; 0 outside */
};

void names_init(struct name_set *names, struct arena *arena, const struct lang_syntax *syntax);
/* Takes the names of the frame that the speller writes around every shader: "main", "vd"… */
void names_take_frame(struct name_set *names);
/* A new function: the names of the one before are free again. */
void names_open_scope(struct name_set *names);
/* Texts that these two get must live as long as the set. */
/* `text` as an identifier, with a number behind it if the name is reserved or taken. */
struct spell_name names_unique(struct name_set *names, const char *text, size_t len);
/* Takes a name as it is; false if it is taken already. */
bool names_take(struct name_set *names, const char *text, size_t len);
/* Would names_unique give an identifier as it is, but for the underscore of reserved words? */
bool names_is_free(const struct name_set *names, const char *text, size_t len);

#endif
