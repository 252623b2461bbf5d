// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "import/gltf_source.h"

#include "program/files.h"
#include "program/gltf_inputs.h"
#include "program/limit.h"
#include "program/memory.h"

#include <ctype.h>
#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/types.h>

enum { MAX_BUFFERS = 4096 };

/* ---- Faults ---- */

bool gltf_source_fail(struct gltf_source *source, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(source->fault, sizeof source->fault, format, args);
    va_end(args);
    for (char *c = source->fault; *c; ++c)
        *c = (unsigned char)*c < ' ' ? '?' : *c; /* a text of the file does not end the line */
    return false;
}

bool gltf_source_spend(struct gltf_source *source, uint64_t bytes)
{
    uint64_t limit = limit_of_file(source->size);
    if (bytes > limit || source->spent > limit - bytes)
        return gltf_source_fail(source, "it needs too much memory for its size");
    source->spent += bytes;
    return true;
}

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
                     : mxg_context_file_fault(source->context, source->path, path);
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

/* The bytes of a buffer before it that has the same URI. */
static bool share_buffer(struct gltf_source *source, size_t index, const char *uri)
{
    for (size_t i = 0; i < source->num_buffers; ++i) {
        const struct gltf_bytes *other = &source->buffers[i];
        if (i == index || !other->data || other->is_shared
            || strcmp(json_text_of(gltf_source_item(source, "buffers", i), "uri"), uri) != 0)
            continue;
        source->buffers[index] = *other;
        source->buffers[index].is_shared = true;
        return true;
    }
    return false;
}

static void read_buffer(struct gltf_source *source, size_t index)
{
    const char *uri = json_text_of(gltf_source_item(source, "buffers", index), "uri"),
               *fault = NULL;
    struct gltf_bytes *out = &source->buffers[index];
    char *path = NULL;
    out->is_tried = true;
    if (!*uri && index == 0) {
        *out = source->chunk;
        out->is_tried = out->is_shared = true;
    }
    if (!*uri || share_buffer(source, index, uri))
        return;
    out->data = gltf_source_resolve(source, uri, &out->size, &path, &fault);
    if (path && !(out->data = (uint8_t *)files_read(path, &out->size)))
        fault = strerror(errno);
    if (!out->data && fault)
        out->fault = cli_format("'%.200s': %s", uri, fault);
    source->size += out->size;
    free(path);
}

const uint8_t *gltf_source_view(struct gltf_source *source, size_t index, size_t *out_size)
{
    const json_t *view = gltf_source_item(source, "bufferViews", index);
    size_t number = gltf_index_of(view, "buffer"), begin = json_count_of(view, "byteOffset");
    *out_size = json_count_of(view, "byteLength");
    if (number >= source->num_buffers) {
        gltf_source_fail(source, "there is no bufferViews[%zd] with a buffer", (ssize_t)index);
        return NULL;
    }
    struct gltf_bytes *bytes = &source->buffers[number];
    if (!bytes->is_tried)
        read_buffer(source, number);
    if (bytes->data && begin <= bytes->size && *out_size <= bytes->size - begin)
        return bytes->data + begin;
    if (bytes->data)
        gltf_source_fail(source, "bufferViews[%zu] ends behind the %zu bytes of buffers[%zu]",
                         index, bytes->size, number);
    else
        gltf_source_fail(source, "buffers[%zu] has no bytes%s%s", number, bytes->fault ? ": " : "",
                         bytes->fault ? bytes->fault : "");
    return NULL;
}

/* ---- Extensions ---- */

/* True if mxgen reads an extension, in meshes or in materials. */
static bool is_known(const char *extension)
{
    static const char *const others[] = {"EXT_mesh_gpu_instancing", "KHR_lights_punctual",
                                         "KHR_materials_unlit",     "KHR_materials_variants",
                                         "KHR_mesh_quantization",   "KHR_texture_transform"};
    for (size_t i = 0; i < sizeof others / sizeof *others; ++i)
        if (strcmp(extension, others[i]) == 0)
            return true;
    for (size_t i = 0; i < gltf_num_inputs; ++i)
        if (gltf_inputs[i].object && strcmp(extension, gltf_inputs[i].object) == 0)
            return strncmp(extension, "KHR_", 4) == 0;
    return false;
}

/* glTF 2.0, 3.12: a file that requires an unknown extension is not to be loaded. */
static bool check_required(struct gltf_source *source)
{
    const json_t *required = json_object_get(source->root, "extensionsRequired");
    for (size_t i = 0; i < json_array_size(required); ++i) {
        const char *name = json_string_value(json_array_get(required, i));
        if (!name || !is_known(name))
            return gltf_source_fail(source,
                                    "it requires the extension '%.100s' (extensionsRequired[%zu]), "
                                    "which mxgen does not read; save it without that extension",
                                    name ? name : "", i);
    }
    return true;
}

/* ---- Numbers of the schema ---- */

/* Members that count bytes: whole numbers of 0 or more, or absent. */
static const struct {
    const char *array, *shown, *path[3];
} counts[] = {
    {"accessors", "byteOffset", {"byteOffset"}},
    {"accessors", "sparse.indices.byteOffset", {"sparse", "indices", "byteOffset"}},
    {"accessors", "sparse.values.byteOffset", {"sparse", "values", "byteOffset"}},
    {"bufferViews", "byteOffset", {"byteOffset"}},
    {"bufferViews", "byteLength", {"byteLength"}},
    {"bufferViews", "byteStride", {"byteStride"}},
    {"buffers", "byteLength", {"byteLength"}},
};

static bool is_count_or_absent(const json_t *value)
{
    return !value || (json_is_integer(value) && json_integer_value(value) >= 0);
}

/* Otherwise such a number would be read as an absent one. */
static bool check_counts(struct gltf_source *source)
{
    for (size_t row = 0; row < sizeof counts / sizeof *counts; ++row) {
        const json_t *item;
        size_t i;
        json_array_foreach(json_object_get(source->root, counts[row].array), i, item)
        {
            for (size_t part = 0; part < 3 && counts[row].path[part]; ++part)
                item = json_object_get(item, counts[row].path[part]);
            if (!is_count_or_absent(item))
                return gltf_source_fail(source, "%s[%zu].%s is no whole number from 0",
                                        counts[row].array, i, counts[row].shown);
        }
    }
    return is_count_or_absent(json_object_get(source->root, "scene"))
           || gltf_source_fail(source, "its \"scene\" is no whole number from 0");
}

/* "2.0" is what mxgen reads, also where the file says that a newer version is better. */
static bool check_version(struct gltf_source *source)
{
    const json_t *asset = json_object_get(source->root, "asset");
    const char *least = json_text_of(asset, "minVersion");
    if (strncmp(json_text_of(asset, "version"), "2.", 2) != 0)
        return gltf_source_fail(source, "its \"asset\" does not say the version 2.0 of glTF");
    return !*least || strcmp(least, "2.0") == 0
           || gltf_source_fail(source, "it needs the version %.16s of glTF; mxgen reads 2.0",
                               least);
}

/* ---- The file ---- */

static uint32_t word_at(const char *data)
{
    uint32_t word = 0;
    for (int i = 3; i >= 0; --i)
        word = word << 8 | (uint8_t)data[i];
    return word;
}

static bool parse(struct gltf_source *source, const char *text, size_t size)
{
    json_error_t error;
    size_t blanks = 0;
    while (blanks < size && strchr(" \t\r\n", text[blanks]))
        blanks++;
    if (blanks == size || text[blanks] != '{')
        return gltf_source_fail(source, "it is no glTF");
    source->root = json_loadb(text, size, 0, &error);
    if (!source->root)
        gltf_source_fail(source, "line %d, column %d of its JSON: %s", error.line, error.column,
                         error.text);
    return source->root != NULL;
}

/* The chunks of a binary file: the JSON, then bytes. */
static bool parse_binary(struct gltf_source *source, const char *data, size_t size)
{
    enum { WHOLE = 8, HEADER = 12, CHUNK = 8, VERSION = 2 };
    size_t length = size >= HEADER + CHUNK ? word_at(data + HEADER) : 0;
    if (size < HEADER + CHUNK || word_at(data + 4) != VERSION
        || memcmp(data + HEADER + 4, "JSON", 4) != 0 || length > size - HEADER - CHUNK)
        return gltf_source_fail(source, "it is no binary glTF 2.0");
    if (word_at(data + WHOLE) != size)
        return gltf_source_fail(source, "it has %zu bytes, and its header says %u", size,
                                (unsigned)word_at(data + WHOLE));
    const char *next = data + HEADER + CHUNK + length;
    size_t left = size - HEADER - CHUNK - length;
    if (left >= CHUNK && memcmp(next + 4, "BIN", 4) == 0 && word_at(next) <= left - CHUNK) {
        source->chunk.size = word_at(next);
        source->chunk.data = memory_alloc(source->chunk.size + 1);
        memcpy(source->chunk.data, next + CHUNK, source->chunk.size);
    }
    return parse(source, data + HEADER + CHUNK, length);
}

bool gltf_source_is(const char *path)
{
    static const char *const endings[] = {".gltf", ".glb"};
    const char *dot = strrchr(files_base_name(path), '.');
    char begin[4] = "";
    for (size_t i = 0; dot && i < sizeof endings / sizeof *endings; ++i)
        if (strcasecmp(dot, endings[i]) == 0)
            return true;
    FILE *file = fopen(path, "rb");
    bool is_binary = file && fread(begin, sizeof begin, 1, file) == 1
                     && memcmp(begin, "glTF", sizeof begin) == 0;
    if (file)
        fclose(file);
    return is_binary;
}

bool gltf_source_open(struct gltf_source *source, const mxg_context *context, const char *path)
{
    *source = (struct gltf_source){.context = context, .path = path};
    size_t size = 0;
    char *data = files_read(path, &size);
    if (!data)
        return gltf_source_fail(source, "%s", strerror(errno));
    source->size = size;
    bool is_binary = size >= 4 && memcmp(data, "glTF", 4) == 0,
         good = is_binary ? parse_binary(source, data, size) : parse(source, data, size);
    free(data);
    if (!good)
        return false;
    if (!check_version(source) || !check_counts(source))
        return false;
    source->num_buffers = json_array_size(json_object_get(source->root, "buffers"));
    if (source->num_buffers > MAX_BUFFERS)
        return gltf_source_fail(source, "it has %zu buffers; the limit is %d", source->num_buffers,
                                MAX_BUFFERS);
    source->buffers = memory_alloc((source->num_buffers + 1) * sizeof *source->buffers);
    return check_required(source);
}

void gltf_source_close(struct gltf_source *source)
{
    for (size_t i = 0; source->buffers && i < source->num_buffers; ++i) {
        free(source->buffers[i].fault);
        if (!source->buffers[i].is_shared)
            free(source->buffers[i].data);
    }
    free(source->buffers);
    free(source->chunk.data);
    json_decref(source->root);
}
