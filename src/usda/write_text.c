// SPDX-License-Identifier: Apache-2.0
#include "usda/write_text.h"

#include "base/hash.h"
#include "usda/usda.h"

bool usda_is_identifier(struct text_word name)
{
    bool good = name.len && usda_is_letter(name.bytes[0]);
    for (size_t i = 1; i < name.len && good; i++)
        good = usda_is_letter(name.bytes[i]) || usda_is_digit(name.bytes[i]);
    return good;
}

void usda_put_indent(struct usda_text *text, uint32_t depth)
{
    for (uint32_t i = 0; i < depth; i++)
        text_str(text->out, "    ");
}

void usda_put_name(struct usda_text *text, struct text_word name)
{
    if (usda_is_identifier(name)) {
        text_put(text->out, name);
        return;
    }
    text->num_changed++;
    if (!name.len || usda_is_digit(name.bytes[0]))
        text_char(text->out, '_');
    for (size_t i = 0; i < name.len; i++) {
        char c = name.bytes[i];
        text_char(text->out, usda_is_letter(c) || usda_is_digit(c) ? c : '_');
    }
    text_fmt(text->out, "_%x", (unsigned)hash_bytes(name.bytes, name.len));
}

void usda_put_string(struct usda_text *text, struct text_word string)
{
    text_char(text->out, '"');
    for (size_t i = 0; i < string.len; i++) {
        unsigned char c = (unsigned char)string.bytes[i];
        if (c == '"' || c == '\\')
            text_fmt(text->out, "\\%c", c);
        else if (c < 0x20 || c == 0x7f)
            text_fmt(text->out, "\\x%02x", (unsigned)c);
        else
            text_char(text->out, (char)c);
    }
    text_char(text->out, '"');
}
