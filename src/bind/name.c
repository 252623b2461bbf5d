// SPDX-License-Identifier: Apache-2.0
#include "bind/name.h"

static bool is_part_char(char c)
{
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static size_t part_len(const char *text, const char *end)
{
    const char *at = text;
    while (at < end && is_part_char(*at))
        at++;
    return (size_t)(at - text);
}

static bool begins(const char *text, const char *end, const char *word)
{
    size_t len = strlen(word);
    return (size_t)(end - text) >= len && memcmp(text, word, len) == 0;
}

/* Each part but the first, with its separator in names and between USD identifiers. */
static const struct {
    enum slot_part part;
    const char *separator, *identifier;
} joints[] = {{SLOT_VERTICAL, "|", ":over:"}, {SLOT_OVERRIDE, "::", ":_:"}};
enum { NUM_JOINTS = sizeof joints / sizeof *joints };

static const char *fault_of_rest(const char *text, const char *end)
{
    if (text == end)
        return NULL;
    if (*text == ':' && text + 1 < end && text[1] != ':')
        return "has one ':', and an override has two, as in 010::020";
    if (*text == '|' || *text == ':')
        return "has parts that no slot has; only slot|vertical::override may follow each other";
    return "has a character that is no letter, digit or '_'";
}

const char *slot_parse(const char *text, size_t len, struct slot_name *out)
{
    const char *end = text + len;
    *out = (struct slot_name){0};
    if (!len)
        return "is empty";
    out->parts[SLOT_SLOT] = (struct text_word){text, part_len(text, end)};
    if (!out->parts[SLOT_SLOT].len && (*text == '|' || *text == ':'))
        return "has no slot in front";
    text += out->parts[SLOT_SLOT].len;
    for (size_t i = 0; i < NUM_JOINTS; i++) {
        if (!begins(text, end, joints[i].separator))
            continue;
        text += strlen(joints[i].separator);
        struct text_word *part = &out->parts[joints[i].part];
        *part = (struct text_word){text, part_len(text, end)};
        if (!part->len && (text == end || *text == ':' || *text == '|'))
            return joints[i].part == SLOT_VERTICAL ? "has no vertical layer after '|'"
                                                   : "has no override after '::'";
        text += part->len;
    }
    return fault_of_rest(text, end);
}

void slot_write(const struct slot_name *name, struct text *out)
{
    text_put(out, name->parts[SLOT_SLOT]);
    for (size_t i = 0; i < NUM_JOINTS; i++)
        if (name->parts[joints[i].part].len) {
            text_str(out, joints[i].separator);
            text_put(out, name->parts[joints[i].part]);
        }
}

void slot_encode(const struct slot_name *name, struct text *out)
{
    text_char(out, '_');
    text_put(out, name->parts[SLOT_SLOT]);
    for (size_t i = 0; i < NUM_JOINTS; i++)
        if (name->parts[joints[i].part].len) {
            text_str(out, joints[i].identifier);
            text_char(out, '_');
            text_put(out, name->parts[joints[i].part]);
        }
}

/* A part with '_' in front of it; false if there is none. */
static bool decode_part(const char **text, const char *end, struct text_word *out)
{
    size_t len = part_len(*text, end);
    if (len < 2 || **text != '_')
        return false;
    *out = (struct text_word){*text + 1, len - 1};
    *text += len;
    return true;
}

const char *slot_decode(const char *text, size_t len, struct slot_name *out)
{
    const char *end = text + len;
    *out = (struct slot_name){0};
    if (!decode_part(&text, end, &out->parts[SLOT_SLOT]))
        return NULL;
    for (size_t i = 0; i < NUM_JOINTS; i++) {
        if (!begins(text, end, joints[i].identifier))
            continue;
        text += strlen(joints[i].identifier);
        if (!decode_part(&text, end, &out->parts[joints[i].part]))
            return NULL;
    }
    return text == end || *text == ':' ? text : NULL;
}
