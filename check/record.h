// SPDX-License-Identifier: Apache-2.0
/*
 * The outcome of a document. Workers make such records, the cache keeps them, and every report is
 * written from them. As text a record is one JSON object (docs/check.md).
 */
#ifndef MXG_CHECK_RECORD_H
#define MXG_CHECK_RECORD_H

#include "cli/store.h"

#include <mxgen/mxgen.h>

#include <stdbool.h>
#include <stdint.h>

#define CHECK_FORMAT_VERSION 1 /* of records and reports in JSON */

/* Where something failed first, in order. */
#define CHECK_STAGES(X) \
    X(PASSED, "passed")     /* nowhere */ \
    X(LOAD, "load")         /* it is no document, or a part of it is missing */ \
    X(VALIDATE, "validate") /* against the library */ \
    X(GENERATE, "generate") \
    X(COMPILE, "compile") \
    X(RENDER, "render") \
    X(BUDGET, "budget") \
    X(CRASH, "crash")     /* the program that checked it died */ \
    X(TIMEOUT, "timeout") /* or did not end */

enum check_stage {
#define STAGE(name, text) CHECK_##name,
    CHECK_STAGES(STAGE)
#undef STAGE
        NUM_CHECK_STAGES
};

/* "passed", "load" … */
extern const char *const check_stage_names[NUM_CHECK_STAGES];

enum measure {
#define MEASURE(name, key, option, noun, meaning) MEASURE_##name,
#include "check/measures.def"
#undef MEASURE
    NUM_MEASURES
};

struct measure_info {
    const char *key, *option, *noun, *meaning;
};
extern const struct measure_info measure_infos[NUM_MEASURES];

struct check_message {
    mxg_severity severity;
    const char *id, *text;
    const char *file;              /* "": none */
    uint32_t line, column, length; /* 0: unknown */
    const char *element, *target;  /* that it was met first for; "": the document */
    const char *rendered;          /* as a compiler shows it, with notes and the source line */
};

/*
 * What a shader has so much for: a function or node with its instructions, a node with its bytes of
 * uniforms, a texture.
 */
struct check_part {
    enum measure measure;
    const char *name;
    uint64_t count;
};

/* An element for one target. */
struct check_shader {
    const char *target;
    enum check_stage failed;
    bool compiled;        /* there was a compiler for the target */
    const char *topology; /* hexadecimal; "" where nothing was generated, or in a brief record */
    uint64_t measures[NUM_MEASURES];
    struct check_part *parts; /* of each measure the largest first; some are left out */
    size_t num_parts;
    uint32_t *messages; /* indices into those of the document */
    size_t num_messages;
    double generate_ms, compile_ms;
};

struct check_element {
    const char *path, *type;
    struct check_shader *shaders;
    size_t num_shaders;
    const char *picture;   /* a PNG in base64; "": none was drawn */
    const char *signature; /* of the picture, see picture.h */
};

/* What differs from a baseline. */
#define CHECK_CHANGES(X) \
    X(FAILS, "fails") /* newly */ \
    X(FIXED, "fixed") \
    X(TOPOLOGY, "topology") \
    X(SIZE, "size") \
    X(PICTURE, "picture") \
    X(NEW, "new") \
    X(GONE, "gone")

enum check_change_kind {
#define CHANGE(name, text) CHANGE_##name,
    CHECK_CHANGES(CHANGE)
#undef CHANGE
        NUM_CHECK_CHANGES
};

extern const char *const check_change_names[NUM_CHECK_CHANGES];

struct check_change {
    enum check_change_kind kind;
    const char *element, *target; /* "": the document; all targets */
    const char *text;
};

struct check_document {
    uint64_t index; /* among all documents, those of other shards too */
    const char *file;
    enum check_stage failed;
    struct check_message *messages; /* each once, in order of discovery */
    size_t num_messages;
    const char **files; /* that were read, itself first */
    size_t num_files;
    /* of textures and of what is missing, with a '/' behind: the names in them matter */
    const char **folders;
    size_t num_folders;
    /* that the pictures show, whether they are there or not: what is in them matters */
    const char **images;
    size_t num_images;
    struct check_element *elements;
    size_t num_elements;
    double load_ms, validate_ms, render_ms;
    struct check_change *changes; /* since the baseline */
    size_t num_changes;
};

/* The document's failure becomes that of the stage, unless it failed earlier. */
void check_fail(enum check_stage *failed, enum check_stage stage);

/* Whether two messages tell the same. */
bool check_is_same_message(const struct check_message *a, const struct check_message *b);

/* Appends a message; returns its index. */
uint32_t check_add_message(struct store *store, struct check_document *document,
                           const struct check_message *message);

/*
 * Appends the folders that a file may lie in: beside the one that names it, and in the working
 * directory.
 */
void check_add_place(struct store *store, struct check_document *document, const char *from,
                     const char *file);

/* Appends a file, or an image, once; the name is copied. */
void check_add_file(struct store *store, struct check_document *document, const char *path);
void check_add_image(struct store *store, struct check_document *document, const char *path);

#endif
