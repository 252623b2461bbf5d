// SPDX-License-Identifier: Apache-2.0
/* The whole of glTF, as text with files beside it, or as one binary file. */
#include "export/gltf.h"

#include "program/files.h"
#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

/* ---- JSON ---- */

static json_t *member(json_t *object, const char *key, json_t *(*make)(void))
{
    json_t *value = json_object_get(object, key);
    if (!value) {
        value = make();
        json_set(object, key, value);
    }
    return value;
}

json_t *gltf_object(json_t *object, const char *key)
{
    return member(object, key, json_object);
}

json_t *gltf_array(json_t *object, const char *key)
{
    return member(object, key, json_array);
}

size_t gltf_append(json_t *array, json_t *value)
{
    json_array_append_new(array, value);
    return json_array_size(array) - 1;
}

size_t gltf_add(json_t *array, json_t *value)
{
    size_t index;
    json_t *item;
    json_array_foreach(array, index, item) if (json_equal(item, value))
    {
        json_decref(value);
        return index;
    }
    return gltf_append(array, value);
}

/* ---- The buffer ---- */

enum { ALIGNMENT = 4, WORD = 4 };

static void pad(struct memory_bytes *out, char with)
{
    while (out->size % ALIGNMENT)
        memory_append(out, &with, 1);
}

size_t gltf_add_view(struct gltf *gltf, const void *data, size_t size, int target)
{
    json_t *view = json_object();
    pad(&gltf->buffer, 0);
    json_set(view, "buffer", json_integer(0));
    json_set(view, "byteOffset", json_integer((json_int_t)gltf->buffer.size));
    json_set(view, "byteLength", json_integer((json_int_t)size));
    json_set_count(view, "target", (uint64_t)target);
    memory_append(&gltf->buffer, data, size);
    return gltf_append(gltf_array(gltf->root, "bufferViews"), view);
}

/* ---- Files ---- */

/* A name as a URI (RFC 3986): other bytes than unreserved ones as their hexadecimal numbers. */
static char *escape(const char *name)
{
    static const char free_ones[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~";
    char *out = memory_alloc(3 * strlen(name) + 1), *at = out;
    for (; *name; ++name) {
        if (strchr(free_ones, *name))
            *at++ = *name;
        else
            at += snprintf(at, 4, "%%%02X", (unsigned char)*name);
    }
    return out;
}

/* An image in a file of its own. */
static bool add_image_file(struct gltf *gltf, const struct gltf_texture_file *file, json_t *image)
{
    char *stem = write_stem(gltf->writing),
         *name = cli_format("%s_%s.%s", stem, file->name, file->file.ending), *uri = escape(name);
    bool good = write_beside(gltf->writing, name, file->file.data, file->file.size);
    json_set_text(image, "uri", uri);
    free(stem);
    free(name);
    free(uri);
    return good;
}

static void add_image_view(struct gltf *gltf, const struct gltf_texture_file *file, json_t *image)
{
    bool is_png = strcmp(file->file.ending, "png") == 0;
    size_t view = gltf_add_view(gltf, file->file.data, file->file.size, 0);
    json_set(image, "bufferView", json_integer((json_int_t)view));
    json_set_text(image, "mimeType", is_png ? "image/png" : "image/jpeg");
    json_set_text(image, "name", file->name);
}

/* Images and nodes. */
static bool make(struct gltf *gltf, bool is_binary)
{
    bool *tangents = memory_alloc((gltf->flat->num_materials + 1) * sizeof *tangents), good = true;
    json_t *asset = gltf_object(gltf->root, "asset");
    char *generator = cli_format("mxgen %s", mxg_version_string());
    json_set_text(asset, "version", "2.0");
    json_set_text(asset, "generator", generator);
    for (size_t i = 0; good && i < gltf->flat->num_materials; ++i)
        good = gltf_add_material(gltf, &gltf->flat->materials[i], &tangents[i]);
    for (size_t i = 0; good && i < gltf->num_files; ++i) {
        json_t *image = json_object();
        json_array_append_new(gltf_array(gltf->root, "images"), image);
        if (is_binary)
            add_image_view(gltf, &gltf->files[i], image);
        else
            good = add_image_file(gltf, &gltf->files[i], image);
    }
    if (good)
        gltf_add_nodes(gltf, tangents);
    free(generator);
    free(tangents);
    return good;
}

static char *text_of(const struct gltf *gltf, size_t style)
{
    char *text = json_dumps(gltf->root, JSON_REAL_PRECISION(9) | style);
    if (!text)
        memory_fail();
    return text;
}

static bool write_text(struct gltf *gltf)
{
    char *stem = write_stem(gltf->writing), *name = cli_format("%s.bin", stem), *uri = escape(name);
    json_set(gltf->root, "buffers",
             json_pack("[{s:s, s:I}]", "uri", uri, "byteLength", (json_int_t)gltf->buffer.size));
    char *text = text_of(gltf, JSON_INDENT(2)), *lines = cli_format("%s\n", text);
    bool good =
        write_beside(gltf->writing, name, gltf->buffer.data, gltf->buffer.size)
        && write_beside(gltf->writing, files_base_name(gltf->writing->path), lines, strlen(lines));
    free(text);
    free(lines);
    free(uri);
    free(name);
    free(stem);
    return good;
}

/* The length and the type of a chunk, which begins where the buffer ends. */
static void append_chunk(struct memory_bytes *out, const char type[4], const void *data,
                         size_t size, char padding)
{
    memory_append_number(out, (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT, WORD);
    memory_append(out, type, 4);
    memory_append(out, data, size);
    pad(out, padding);
}

/* Section 4.4: a header, the JSON, the buffer; lengths are 32 bits. */
static bool write_binary(struct gltf *gltf)
{
    json_set(gltf->root, "buffers",
             json_pack("[{s:I}]", "byteLength", (json_int_t)gltf->buffer.size));
    enum { HEADER = 12, CHUNK = 8 };
    char *text = text_of(gltf, JSON_COMPACT);
    struct memory_bytes whole = {0};
    size_t size = HEADER + 2 * CHUNK + (strlen(text) + 3) / ALIGNMENT * ALIGNMENT
                  + (gltf->buffer.size + 3) / ALIGNMENT * ALIGNMENT;
    bool good = size <= UINT32_MAX;
    if (good) {
        memory_append(&whole, "glTF", 4);
        memory_append_number(&whole, 2, WORD);
        memory_append_number(&whole, size, WORD);
        append_chunk(&whole, "JSON", text, strlen(text), ' ');
        append_chunk(&whole, "BIN\0", gltf->buffer.data, gltf->buffer.size, 0);
        good = write_beside(gltf->writing, files_base_name(gltf->writing->path), whole.data,
                            whole.size);
    } else {
        report_error(&gltf->writing->cli->report, "output-failed",
                     "cannot write '%s': a .glb has at most 4 GiB; write a .gltf",
                     gltf->writing->path);
    }
    free(whole.data);
    free(text);
    return good;
}

static bool write(struct writing *writing, const struct flat *flat, bool is_binary)
{
    struct gltf gltf = {.flat = flat, .writing = writing, .root = json_object()};
    bool good = make(&gltf, is_binary) && (is_binary ? write_binary(&gltf) : write_text(&gltf));
    for (size_t i = 0; i < gltf.num_files; ++i) {
        free(gltf.files[i].key);
        free(gltf.files[i].name);
        free(gltf.files[i].file.data);
    }
    free(gltf.files);
    free(gltf.buffer.data);
    json_decref(gltf.root);
    return good;
}

bool gltf_write(struct writing *writing, const struct flat *flat)
{
    return write(writing, flat, false);
}

bool gltf_write_binary(struct writing *writing, const struct flat *flat)
{
    return write(writing, flat, true);
}
