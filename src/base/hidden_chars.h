// SPDX-License-Identifier: Apache-2.0
/*
 * Code points that nobody sees, but that move the cursor of a terminal, or hide or reorder the text
 * beside them: control characters (General_Category Cc), Unicode's Bidi_Control, separators of
 * lines, and what is ignored by default and is no part of a word, as the joiners and the variation
 * selectors are (Unicode 15, DerivedCoreProperties.txt, Default_Ignorable_Code_Point). Texts for
 * people have '?' in their place, names of files '_'.
 */
#ifndef MXG_BASE_HIDDEN_CHARS_H
#define MXG_BASE_HIDDEN_CHARS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

static inline bool hidden_code(uint32_t code)
{
    static const struct {
        uint32_t first, last;
    } hidden[] = {{0x00, 0x1f},     {0x7f, 0x9f},     {0xad, 0xad},     {0x61c, 0x61c},
                  {0x180e, 0x180e}, {0x200b, 0x200b}, {0x200e, 0x200f}, {0x2028, 0x202e},
                  {0x2060, 0x206f}, {0xfeff, 0xfeff}, {0xfff9, 0xfffb}, {0xe0000, 0xe007f}};
    size_t i = 0;
    while (i < sizeof hidden / sizeof *hidden && code > hidden[i].last)
        ++i;
    return i < sizeof hidden / sizeof *hidden && code >= hidden[i].first;
}

#endif
