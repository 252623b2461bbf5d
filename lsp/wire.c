// SPDX-License-Identifier: Apache-2.0
#include "lsp/wire.h"

#include "lsp/disk.h"
#include "program/cli.h"
#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

json_t *wire_position(const struct lsp_session *session, const struct text *text, uint32_t offset)
{
    struct position position = text_position(text, offset, session->is_utf8);
    json_t *object = json_object();
    json_object_set_new(object, "line", json_integer(position.line));
    json_object_set_new(object, "character", json_integer(position.column));
    return object;
}

json_t *wire_range(const struct lsp_session *session, const struct text *text, struct span span)
{
    json_t *object = json_object();
    json_object_set_new(object, "start", wire_position(session, text, span.start));
    json_object_set_new(object, "end", wire_position(session, text, span.end));
    return object;
}

json_t *wire_location(const struct lsp_session *session, const char *uri, const struct text *text,
                      struct span span)
{
    json_t *object = json_object();
    json_object_set_new(object, "uri", json_text(uri));
    json_object_set_new(object, "range", wire_range(session, text, span));
    return object;
}

json_t *wire_edit(const struct lsp_session *session, const struct text *text, struct span span,
                  const char *new_text)
{
    json_t *object = json_object();
    json_object_set_new(object, "range", wire_range(session, text, span));
    json_object_set_new(object, "newText", json_text(new_text));
    return object;
}

json_t *wire_workspace_edit(void)
{
    return json_pack("{s:{}}", "changes");
}

json_t *wire_add_edits(json_t *workspace_edit, const char *uri, json_t *edits)
{
    if (json_array_size(edits))
        json_set(json_object_get(workspace_edit, "changes"), uri, edits);
    else
        json_decref(edits);
    return workspace_edit;
}

json_t *wire_span(const struct text *text, struct span span)
{
    char *copy = cli_copy(text->bytes + span.start, span.end - span.start);
    json_t *string = json_text(copy);
    free(copy);
    return string;
}

json_t *wire_markdown(const char *value)
{
    json_t *object = json_object();
    json_object_set_new(object, "kind", json_string("markdown"));
    json_object_set_new(object, "value", json_text(value));
    return object;
}

static uint32_t to_count(const json_t *value)
{
    json_int_t count = json_integer_value(value);
    return count < 0 ? 0 : count > TEXT_MAX ? TEXT_MAX : (uint32_t)count;
}

bool wire_read_position(const struct lsp_session *session, const struct text *text,
                        const json_t *position, uint32_t *out)
{
    const json_t *line = json_object_get(position, "line"),
                 *character = json_object_get(position, "character");
    if (!json_is_integer(line) || !json_is_integer(character))
        return false;
    *out =
        text_offset(text, (struct position){to_count(line), to_count(character)}, session->is_utf8);
    return true;
}

bool wire_read_range(const struct lsp_session *session, const struct text *text,
                     const json_t *range, struct span *out)
{
    return wire_read_position(session, text, json_object_get(range, "start"), &out->start)
           && wire_read_position(session, text, json_object_get(range, "end"), &out->end)
           && out->start <= out->end;
}

/* ---- Addresses (RFC 3986) ---- */

static int hex_digit(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

static bool is_word(const char *text, size_t len, const char *word)
{
    size_t i = 0;
    while (i < len && word[i] && (text[i] == word[i] || text[i] + ('a' - 'A') == word[i]))
        ++i;
    return i == len && !word[i];
}

/* The path of an address of this machine, still with its escapes; NULL: it has none. */
static const char *local_path(const char *uri)
{
    size_t scheme = strcspn(uri, ":");
    if (!uri[scheme] || !is_word(uri, scheme, "file"))
        return NULL;
    const char *path = uri + scheme + 1;
    if (strncmp(path, "//", 2) == 0) {
        const char *host = path + 2;
        size_t len = strcspn(host, "/");
        if (len && !is_word(host, len, "localhost"))
            return NULL;
        path = host + len;
    }
    return *path == '/' ? path : NULL;
}

char *wire_path(const char *uri)
{
    const char *at = local_path(uri);
    if (!at)
        return NULL;
    bool has_end = false;
    char *path = memory_alloc(strlen(at) + 1), *out = path;
    for (; *at; ++at) {
        int high = *at == '%' ? hex_digit(at[1]) : -1, low = high < 0 ? -1 : hex_digit(at[2]);
        *out = low < 0 ? *at : (char)(high * 16 + low);
        has_end |= !*out++;
        at += low < 0 ? 0 : 2;
    }
    char *clean = has_end ? NULL : disk_join("", path); /* no file has a name with a NUL */
    free(path);
    return clean;
}

char *wire_uri(const char *path)
{
    static const char digits[] = "0123456789ABCDEF", plain[] = "/-._~!$&'()*+,;=:@";
    char *uri = memory_alloc(strlen(path) * 3 + 8), *out = uri;
    memcpy(out, "file://", 7);
    out += 7;
    for (; *path; ++path) {
        unsigned char c = (unsigned char)*path;
        bool is_plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')
                        || strchr(plain, c);
        if (is_plain) {
            *out++ = (char)c;
        } else {
            *out++ = '%';
            *out++ = digits[c >> 4];
            *out++ = digits[c & 15];
        }
    }
    *out = '\0';
    return uri;
}
