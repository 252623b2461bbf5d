// SPDX-License-Identifier: Apache-2.0
/*
 * Names of slots (docs/slots.md, "Names"):
 *
 *     name = part [ "|" part ] [ "::" part ]      slot, vertical layer, override
 *     part = ( letter | digit | "_" ) { ... }     ASCII
 */
#ifndef MXG_BIND_NAME_H
#define MXG_BIND_NAME_H

#include "base/text.h"

#include <stdbool.h>

/* The parts of a name, in the order in which names are compared. */
enum slot_part { SLOT_SLOT, SLOT_VERTICAL, SLOT_OVERRIDE, NUM_SLOT_PARTS };

struct slot_name {
    struct text_word parts[NUM_SLOT_PARTS]; /* len 0: absent; `slot` never is */
};

/* The slot of an assignment that names none. */
#define SLOT_DEFAULT "000"

/* Splits a name. Returns NULL, or the fault of the name: "is empty". The parts point into `text`.
 */
const char *slot_parse(const char *text, size_t len, struct slot_name *out);

/* Writes a name: "000|010::020". */
void slot_write(const struct slot_name *name, struct text *out);

/*
 * Writes a name as USD identifiers (ASH paper, appendix B): "_000:over:_010:_:_020". Every part
 * gets one '_' in front, so that no part is one of the bare words, and both ways are exact.
 */
void slot_encode(const struct slot_name *name, struct text *out);

/*
 * Reads the identifiers that slot_encode writes, as far as they go. Returns the text after them,
 * which is empty or begins with ':'; NULL if the text does not begin with a name. The parts point
 * into `text`.
 */
const char *slot_decode(const char *text, size_t len, struct slot_name *out);

#endif
