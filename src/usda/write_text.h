// SPDX-License-Identifier: Apache-2.0
/*
 * Text of USD that is written. Syntax is what the program says; names and strings of others go
 * through functions of their own, which always escape.
 */
#ifndef MXG_USDA_WRITE_TEXT_H
#define MXG_USDA_WRITE_TEXT_H

#include "base/text.h"

struct usda_text {
    struct text *out;
    uint32_t num_changed; /* names that are no identifiers of USD */
};

/* Writes syntax. */
static inline void usda_put(struct usda_text *text, const char *syntax)
{
    text_str(text->out, syntax);
}
/* Writes 4 blanks for each level. */
void usda_put_indent(struct usda_text *text, uint32_t depth);
/*
 * Writes a name as an identifier, without quotes. Each character that an identifier cannot have
 * becomes '_', and then a hash of the name stands at the end, so that names stay distinct.
 */
void usda_put_name(struct usda_text *text, struct text_word name);
/* Writes a string in quotes. */
void usda_put_string(struct usda_text *text, struct text_word string);

/* True for a name that is an identifier of USD: letters, digits and '_', and no digit in front. */
bool usda_is_identifier(struct text_word name);

#endif
