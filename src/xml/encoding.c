// SPDX-License-Identifier: Apache-2.0
/*
 * Converts the bytes of a file to UTF-8 text: encodings, byte-order marks, text before the XML, raw
 * characters in attribute values.
 */
#include "xml/xml_priv.h"

#include <assert.h>

static bool has_prefix(const char *text, size_t len, const char *prefix, size_t prefix_len)
{
    return len >= prefix_len && memcmp(text, prefix, prefix_len) == 0;
}

static size_t find_text(const char *text, size_t len, size_t from, const char *wanted)
{
    assert(from <= len);
    size_t n = strlen(wanted);
    for (const char *p = text + from; (p = memchr(p, wanted[0], (size_t)(text + len - p))) != NULL;
         p++)
        if (has_prefix(p, (size_t)(text + len - p), wanted, n))
            return (size_t)(p - text);
    return len;
}

/* libxml2 compares each attribute of an element with all others. */
enum { MAX_ATTRIBUTES = 1024 };

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

static char *put_utf8(char *out, uint32_t code)
{
    if (code < 0x80) {
        *out++ = (char)code;
    } else if (code < 0x800) {
        *out++ = (char)(0xc0 | code >> 6);
        *out++ = (char)(0x80 | (code & 0x3f));
    } else if (code < 0x10000) {
        *out++ = (char)(0xe0 | code >> 12);
        *out++ = (char)(0x80 | (code >> 6 & 0x3f));
        *out++ = (char)(0x80 | (code & 0x3f));
    } else {
        *out++ = (char)(0xf0 | code >> 18);
        *out++ = (char)(0x80 | (code >> 12 & 0x3f));
        *out++ = (char)(0x80 | (code >> 6 & 0x3f));
        *out++ = (char)(0x80 | (code & 0x3f));
    }
    return out;
}

/* UTF-16 (RFC 2781); false for an unpaired surrogate or an incomplete unit. */
static bool decode_utf16(struct xml_reader *reader, const unsigned char *bytes, size_t size,
                         bool big_endian)
{
    char *text = arena_alloc(&reader->scratch, size / 2 * 3), *out = text;
    size_t high = big_endian ? 0 : 1, low = 1 - high;
    for (size_t i = 0; i + 1 < size; i += 2) {
        uint32_t code = (uint32_t)bytes[i + high] << 8 | bytes[i + low];
        if (code >= 0xd800 && code < 0xe000) {
            uint32_t next =
                i + 3 < size ? (uint32_t)bytes[i + 2 + high] << 8 | bytes[i + 2 + low] : 0;
            if (code >= 0xdc00 || next < 0xdc00 || next >= 0xe000)
                return false;
            code = 0x10000 + ((code - 0xd800) << 10) + (next - 0xdc00);
            i += 2;
        }
        out = put_utf8(out, code);
    }
    assert((size_t)(out - text) <= size / 2 * 3);
    reader->source->text = text;
    reader->source->size = (size_t)(out - text);
    return size % 2 == 0;
}

static void decode_latin1(struct xml_reader *reader)
{
    struct xml_source *source = reader->source;
    char *text = arena_alloc(&reader->scratch, mem_array_size(reader->mem, source->size, 2)),
         *out = text;
    for (size_t i = 0; i < source->size; i++)
        out = put_utf8(out, (unsigned char)source->text[i]);
    assert((size_t)(out - text) <= source->size * 2);
    source->text = text;
    source->size = (size_t)(out - text);
}

/* The encoding in the XML declaration, in lower case. */
static void declared_encoding(const struct xml_source *source, char *out, size_t out_size)
{
    const char *text = source->text + source->start;
    size_t len = source->size - source->start, n = 0;
    size_t end =
        has_prefix(text, len, "<?xml", 5) ? find_text(text, len < 1024 ? len : 1024, 0, "?>") : 0;
    size_t at = find_text(text, end, 0, "encoding");
    while (at < end && text[at] != '"' && text[at] != '\'')
        at++;
    for (at++; at < end && text[at] != '"' && text[at] != '\'' && n + 1 < out_size; at++)
        out[n++] = (char)(text[at] >= 'A' && text[at] <= 'Z' ? text[at] + 32 : text[at]);
    assert(n < out_size && end <= len);
    out[n] = '\0';
}

static bool apply_declared_encoding(struct xml_reader *reader)
{
    char name[32];
    declared_encoding(reader->source, name, sizeof name);
    if (!*name || strcmp(name, "utf-8") == 0 || strcmp(name, "utf8") == 0
        || strcmp(name, "us-ascii") == 0 || strcmp(name, "ascii") == 0)
        return true;
    if (strcmp(name, "iso-8859-1") == 0 || strcmp(name, "latin1") == 0) {
        decode_latin1(reader);
        return true;
    }
    diag_add(reader->diags, DIAG_ID_xml_unknown_encoding, xml_place(reader, reader->source->start),
             name);
    return false;
}

/*
 * libxml2 inspects the first four bytes and takes zeros for an encoding with wider units, even if
 * the encoding is set.
 */
static bool check_first_bytes(struct xml_reader *reader)
{
    const struct xml_source *source = reader->source;
    size_t left = source->size - source->start;
    if (!memchr(source->text + source->start, '\0', left < 4 ? left : 4))
        return true;
    diag_add(reader->diags, DIAG_ID_xml_encoding, xml_place(reader, source->start), "UTF-8");
    return false;
}

/* Finds the start of the XML: '<?xml', or '<materialx' after other text. */
static bool find_start(struct xml_reader *reader)
{
    struct xml_source *source = reader->source;
    const char *text = source->text;
    size_t size = source->size, first = 0;
    while (first < size && is_blank(text[first]))
        first++;
    if (first == size) {
        diag_add(reader->diags, DIAG_ID_file_empty, xml_place(reader, 0), source->name);
        return false;
    }
    if (first == 0 && has_prefix(text, size, "<?xml", 5))
        return true;
    size_t root = find_text(text, size, 0, "<materialx");
    size_t declaration = find_text(text, root, 0, "<?xml ");
    if (text[first] != '<' && root == size && declaration == size) {
        diag_add(reader->diags, DIAG_ID_xml_not_xml, xml_place(reader, first));
        return false;
    }
    if (declaration < root)
        source->start = declaration;
    else if (text[first] != '<')
        source->start = root;
    if (source->start)
        diag_add(reader->diags, DIAG_ID_xml_text_before, xml_place(reader, 0));
    assert(source->start <= source->size);
    return check_first_bytes(reader);
}

bool xml_prepare_text(struct xml_reader *reader, const char *data, size_t size)
{
    struct xml_source *source = reader->source;
    source->text = data;
    source->size = size;
    bool utf16_le = has_prefix(data, size, "\xff\xfe", 2) || has_prefix(data, size, "<\0", 2);
    bool utf16_be = has_prefix(data, size, "\xfe\xff", 2) || has_prefix(data, size, "\0<", 2);
    if (utf16_le || utf16_be) {
        size_t mark = data[0] == '<' || data[1] == '<' ? 0 : 2;
        if (!decode_utf16(reader, (const unsigned char *)data + mark, size - mark, utf16_be)) {
            diag_add(reader->diags, DIAG_ID_xml_encoding, xml_place(reader, 0), "UTF-16");
            return false;
        }
        return find_start(reader);
    }
    if (has_prefix(data, size, "\xef\xbb\xbf", 3)) {
        source->text += 3;
        source->size -= 3;
        diag_add(reader->diags, DIAG_ID_xml_bom, xml_place(reader, 0));
        return find_start(reader);
    }
    return find_start(reader) && apply_declared_encoding(reader);
}

/* True at "&lt;", "&#38;" or "&#x26;": without a DOCTYPE there are no other references. */
static bool is_reference(const char *text, size_t len)
{
    static const char *const names[] = {"&lt;", "&gt;", "&amp;", "&quot;", "&apos;"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (has_prefix(text, len, names[i], strlen(names[i])))
            return true;
    if (!has_prefix(text, len, "&#", 2))
        return false;
    bool is_hex = len > 2 && text[2] == 'x';
    const char *digits = is_hex ? "0123456789abcdefABCDEF" : "0123456789";
    size_t first = is_hex ? 3 : 2, at = first;
    while (at < len && text[at] && strchr(digits, text[at]))
        at++;
    return at > first && at < len && text[at] == ';';
}

/* Replaces what is raw in the quoted value at `at`; returns the end of the value. */
static size_t repair_value(struct xml_reader *reader, char *text, size_t len, size_t at, char quote)
{
    for (; at < len && text[at] != quote; at++) {
        const char *raw = text[at] ? strchr(XML_RAW_CHARACTERS, text[at]) : NULL;
        if (!raw || (*raw == '&' && is_reference(text + at, len - at)))
            continue;
        text[at] = reader->source->stand_ins[raw - XML_RAW_CHARACTERS];
        vec_push(&reader->scratch, &reader->source->raw, (struct xml_raw){at, *raw});
    }
    return at;
}

/*
 * Finds bytes that XML allows and that the text does not have; false: there are too few. Real files
 * do not contain DEL.
 */
static bool choose_stand_ins(struct xml_source *source)
{
    static const char candidates[] = "\x7f`~^|$%@*{}[]+\\";
    unsigned num = 0;
    for (const char *c = candidates; *c && num < XML_NUM_RAW; c++)
        if (!memchr(source->text, *c, source->size))
            source->stand_ins[num++] = *c;
    return num == XML_NUM_RAW;
}

static size_t skip_past(const char *text, size_t len, size_t at, const char *end)
{
    size_t found = find_text(text, len, at, end);
    return found == len ? len : found + strlen(end);
}

/* The end of a comment, character data or an instruction; `at` itself for a tag. */
static size_t skip_other(const char *text, size_t len, size_t at)
{
    static const struct {
        const char *begin, *end;
    } others[] = {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (has_prefix(text + at, len - at, others[i].begin, strlen(others[i].begin)))
            return skip_past(text, len, at, others[i].end);
    return at;
}

/* The end of a tag, and the number of its attributes. A quote without an end ends the text. */
static size_t skip_tag(const char *text, size_t len, size_t at, uint32_t *out_attributes)
{
    for (*out_attributes = 0; at < len && text[at] != '>' && text[at] != '<'; at++) {
        *out_attributes += text[at] == '=';
        if (text[at] != '"' && text[at] != '\'')
            continue;
        const char *end = memchr(text + at + 1, text[at], len - at - 1);
        at = end ? (size_t)(end - text) : len - 1;
    }
    return at;
}

bool xml_check_attributes(struct xml_reader *reader)
{
    const struct xml_source *source = reader->source;
    const char *text = source->text, *tag = text + source->start;
    size_t len = source->size;
    while ((tag = memchr(tag, '<', (size_t)(text + len - tag))) != NULL) {
        size_t begin = (size_t)(tag - text), end = skip_other(text, len, begin);
        uint32_t attributes = 0;
        if (end == begin)
            end = skip_tag(text, len, begin + 1, &attributes);
        if (attributes > MAX_ATTRIBUTES) {
            diag_add(reader->diags, DIAG_ID_xml_attributes, xml_place(reader, begin),
                     MAX_ATTRIBUTES);
            return false;
        }
        tag = text + end;
    }
    return true;
}

bool xml_repair_text(struct xml_reader *reader)
{
    struct xml_source *source = reader->source;
    assert(source->raw.len == 0);
    size_t len = source->size;
    if (!choose_stand_ins(source))
        return false;
    char *text = arena_strndup(&reader->scratch, source->text, len);
    for (size_t at = source->start; at < len;) {
        size_t end = text[at] == '<' ? skip_other(text, len, at) : at + 1;
        if (end != at) {
            at = end;
            continue;
        }
        for (at++; at < len && text[at] != '>'; at++)
            if (text[at] == '"' || text[at] == '\'')
                at = repair_value(reader, text, len, at + 1, text[at]);
    }
    source->text = text;
    return source->raw.len > 0;
}
