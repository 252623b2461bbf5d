// SPDX-License-Identifier: Apache-2.0
/* Accessors of glTF 2.0 (section 3.6.2): elements of numbers, which are read one at a time. */
#ifndef MXG_IMPORT_GLTF_ACCESSOR_H
#define MXG_IMPORT_GLTF_ACCESSOR_H

#include "import/gltf_source.h"

/* The largest element is a matrix. */
enum { GLTF_MAX_WIDTH = 16 };

/* Elements that differ from those of the accessor's bytes. */
struct gltf_sparse {
    size_t count;
    const uint8_t *indices, *values;
    unsigned index_kind;
};

struct gltf_accessor {
    size_t index, count;
    unsigned width, kind; /* numbers of an element, and their type */
    bool is_normalized;
    const uint8_t *data; /* NULL: zeros */
    size_t stride;
    struct gltf_sparse sparse;
};

/*
 * Opens an accessor whose elements have `least` to `most` numbers. All elements are inside of the
 * buffers then. false after a fault. The source keeps the bytes.
 */
bool gltf_accessor_open(struct gltf_source *source, size_t index, unsigned least, unsigned most,
                        struct gltf_accessor *out);

/*
 * Reads element `at`, which the accessor has. Normalized integers become numbers from -1 or 0 to 1.
 */
void gltf_accessor_read(const struct gltf_accessor *accessor, size_t at,
                        double out[GLTF_MAX_WIDTH]);

/* Reads it as floats. false after a fault: one of them is not finite. */
bool gltf_accessor_floats(struct gltf_source *source, const struct gltf_accessor *accessor,
                          size_t at, float *out);

/* True if the numbers are integers without a sign. */
bool gltf_accessor_has_counts(const struct gltf_accessor *accessor);

#endif
