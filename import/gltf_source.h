// SPDX-License-Identifier: Apache-2.0
/*
 * A file of glTF 2.0 (Khronos, glTF 2.0 Specification, 2.0.1), as text or binary (section 4.4):
 * its JSON, and the bytes that it has in itself or in files beside it.
 */
#ifndef MXG_IMPORT_GLTF_SOURCE_H
#define MXG_IMPORT_GLTF_SOURCE_H

#include "program/cli.h"
#include "program/json_values.h"

struct gltf_bytes {
    uint8_t *data; /* NULL: not read yet, or it cannot be */
    size_t size;
    bool is_tried;
    bool is_shared; /* a buffer before it has the bytes */
    char *fault;    /* why there are none; may be NULL */
};

struct gltf_source {
    const mxg_context *context; /* which says what the file may refer to */
    const char *path;
    json_t *root;
    struct gltf_bytes chunk;    /* of a binary file */
    struct gltf_bytes *buffers; /* by index */
    size_t num_buffers;
    uint64_t size, spent; /* bytes that were read, and those made of them */
    char fault[384];      /* the last one: what is wrong, with its place in the JSON */
};

/* True for the name, or the first bytes, of a file of glTF. */
bool gltf_source_is(const char *path);
/*
 * Reads a file that may be read. false after a fault: it is no glTF 2.0, or requires an extension
 * that mxgen does not read. gltf_source_close follows in any case.
 */
bool gltf_source_open(struct gltf_source *source, const mxg_context *context, const char *path);
void gltf_source_close(struct gltf_source *source);

/* Sets the fault. Returns false. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
bool gltf_source_fail(struct gltf_source *source, const char *format, ...);
/*
 * Counts memory or work that the file causes. false after a fault: it is much for the size of the
 * file.
 */
bool gltf_source_spend(struct gltf_source *source, uint64_t bytes);

/* The item of an array of the root: "images"; NULL: there is none. */
const json_t *gltf_source_item(const struct gltf_source *source, const char *array, size_t index);
/* A member that is the index of something; SIZE_MAX: there is none. */
size_t gltf_index_of(const json_t *object, const char *key);

/* The bytes of a part of a buffer; NULL after a fault: they are not there. */
const uint8_t *gltf_source_view(struct gltf_source *source, size_t index, size_t *out_size);

/*
 * Follows a URI. Returns the bytes of a "data:" URI, which the caller frees; or NULL, and the path
 * of a file, which the caller frees, or why it must not be read. NULL and NULL: it is no path.
 */
uint8_t *gltf_source_resolve(const struct gltf_source *source, const char *uri, size_t *out_size,
                             char **out_path, const char **out_fault);

#endif
