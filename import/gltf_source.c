// SPDX-License-Identifier: Apache-2.0
#include "import/gltf_source.h"

#include "program/files.h"
#include "program/memory.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* ---- URIs: RFC 3986, RFC 2397 and RFC 4648 ---- */

static int hex_of(char c)
{
    static const char digits[] = "0123456789abcdef";
    const char *at = c ? strchr(digits, tolower((unsigned char)c)) : NULL;
    return at ? (int)(at - digits) : -1;
}

/* The text with "%20" as a space. The caller frees it. */
static char *decode_percent(const char *uri)
{
    char *text = cli_format("%s", uri), *to = text;
    for (const char *from = text; *from; ++to) {
        int high = *from == '%' ? hex_of(from[1]) : -1, low = high >= 0 ? hex_of(from[2]) : -1;
        bool is_escaped = low >= 0 && (high || low);
        *to = is_escaped ? (char)(16 * high + low) : *from;
        from += is_escaped ? 3 : 1;
    }
    *to = '\0';
    return text;
}

static int digit_of(char c)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *at = c ? strchr(digits, c) : NULL;
    return at ? (int)(at - digits) : -1;
}

/* The bytes up to the first character that is no digit of base64. */
static uint8_t *decode_base64(const char *text, size_t *out_size)
{
    uint8_t *data = memory_alloc(strlen(text) + 1);
    uint32_t bits = 0, num_bits = 0;
    *out_size = 0;
    for (int digit; (digit = digit_of(*text)) >= 0; ++text) {
        bits = bits << 6 | (uint32_t)digit;
        num_bits += 6;
        if (num_bits < 8)
            continue;
        num_bits -= 8;
        data[(*out_size)++] = (uint8_t)(bits >> num_bits);
    }
    return data;
}

uint8_t *gltf_source_resolve(const struct gltf_source *source, const char *uri, size_t *out_size,
                             char **out_path, const char **out_fault)
{
    static const char mark[] = ";base64,";
    const char *encoded = strncmp(uri, "data:", strlen("data:")) == 0 ? strstr(uri, mark) : NULL;
    *out_path = NULL;
    *out_fault = NULL;
    if (encoded)
        return decode_base64(encoded + strlen(mark), out_size);
    if (strstr(uri, "://") || strncmp(uri, "data:", strlen("data:")) == 0)
        return NULL;
    char *name = decode_percent(uri), *path = cli_beside(source->path, name);
    *out_fault = strchr(name, '\\')
                     ? "a URI has '/' between folders; documents read '\\' as that, too"
                     : mxg_context_file_fault(source->cli->context, source->path, path);
    free(name);
    if (*out_fault)
        free(path);
    else
        *out_path = path;
    return NULL;
}

/* ---- Buffers ---- */

const json_t *gltf_source_item(const struct gltf_source *source, const char *array, size_t index)
{
    return json_array_get(json_object_get(source->root, array), index);
}

size_t gltf_index_of(const json_t *object, const char *key)
{
    const json_t *value = json_object_get(object, key);
    return json_is_integer(value) && json_integer_value(value) >= 0
               ? (size_t)json_integer_value(value)
               : SIZE_MAX;
}

static void read_buffer(struct gltf_source *source, size_t index, struct gltf_bytes *out)
{
    const char *uri = json_text_of(gltf_source_item(source, "buffers", index), "uri"), *fault;
    char *path = NULL;
    out->is_tried = true;
    if (!*uri)
        return;
    out->data = gltf_source_resolve(source, uri, &out->size, &path, &fault);
    if (path)
        out->data = (uint8_t *)files_read(path, &out->size);
    free(path);
}

const uint8_t *gltf_source_view(struct gltf_source *source, size_t index, size_t *out_size)
{
    const json_t *view = gltf_source_item(source, "bufferViews", index);
    size_t number = gltf_index_of(view, "buffer"), begin = json_count_of(view, "byteOffset");
    *out_size = json_count_of(view, "byteLength");
    if (number >= source->num_buffers)
        return NULL;
    struct gltf_bytes *bytes = &source->buffers[number];
    if (!bytes->is_tried)
        read_buffer(source, number, bytes);
    if (number == 0 && !bytes->data)
        bytes = &source->chunk;
    bool fits = bytes->data && begin <= bytes->size && *out_size <= bytes->size - begin;
    return fits ? bytes->data + begin : NULL;
}

/* ---- The file ---- */

static uint32_t word_at(const char *data)
{
    uint32_t word = 0;
    for (int i = 3; i >= 0; --i)
        word = word << 8 | (uint8_t)data[i];
    return word;
}

static bool fail(const struct gltf_source *source, const char *why)
{
    report_error(&source->cli->report, "import-file", "cannot read '%s': %s", source->path, why);
    return false;
}

static bool parse(struct gltf_source *source, const char *text, size_t size)
{
    json_error_t error;
    size_t blanks = 0;
    while (blanks < size && strchr(" \t\r\n", text[blanks]))
        blanks++;
    if (blanks == size || text[blanks] != '{')
        return fail(source, "it is no glTF, the only format that import reads");
    source->root = json_loadb(text, size, 0, &error);
    if (!source->root)
        report_error(&source->cli->report, "import-file",
                     "cannot read '%s': line %d, column %d of its JSON: %s", source->path,
                     error.line, error.column, error.text);
    return source->root != NULL;
}

/* The chunks of a binary file: the JSON, then bytes. */
static bool parse_binary(struct gltf_source *source, const char *data, size_t size)
{
    enum { HEADER = 12, CHUNK = 8, VERSION = 2 };
    size_t length = size >= HEADER + CHUNK ? word_at(data + HEADER) : 0;
    if (size < HEADER + CHUNK || word_at(data + 4) != VERSION
        || memcmp(data + HEADER + 4, "JSON", 4) != 0 || length > size - HEADER - CHUNK)
        return fail(source, "it is no binary glTF 2.0");
    const char *next = data + HEADER + CHUNK + length;
    size_t left = size - HEADER - CHUNK - length;
    if (left >= CHUNK && memcmp(next + 4, "BIN", 4) == 0 && word_at(next) <= left - CHUNK) {
        source->chunk.size = word_at(next);
        source->chunk.data = memory_alloc(source->chunk.size + 1);
        memcpy(source->chunk.data, next + CHUNK, source->chunk.size);
    }
    return parse(source, data + HEADER + CHUNK, length);
}

bool gltf_source_open(struct gltf_source *source, struct cli *cli, const char *path)
{
    *source = (struct gltf_source){.cli = cli, .path = path};
    const char *fault = mxg_context_file_fault(cli->context, path, path);
    size_t size = 0;
    char *data = fault ? NULL : files_read(path, &size);
    if (!data)
        return fail(source, fault ? fault : strerror(errno));
    bool is_binary = size >= 4 && memcmp(data, "glTF", 4) == 0,
         good = is_binary ? parse_binary(source, data, size) : parse(source, data, size);
    free(data);
    if (!good)
        return false;
    if (strncmp(json_text_of(json_object_get(source->root, "asset"), "version"), "2.", 2) != 0)
        return fail(source, "its \"asset\" does not say the version 2.0 of glTF");
    source->num_buffers = json_array_size(json_object_get(source->root, "buffers"));
    source->buffers = memory_alloc((source->num_buffers + 1) * sizeof *source->buffers);
    return true;
}

void gltf_source_close(struct gltf_source *source)
{
    for (size_t i = 0; i < source->num_buffers; ++i)
        free(source->buffers[i].data);
    free(source->buffers);
    free(source->chunk.data);
    json_decref(source->root);
}
