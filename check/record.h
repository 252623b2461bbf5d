// SPDX-License-Identifier: Apache-2.0
/*
 * The outcome of a document. Workers make records, the cache stores them, and all reports come from
 * them. As text a record is one JSON object (docs/check.md).
 */
#ifndef MXG_CHECK_RECORD_H
#define MXG_CHECK_RECORD_H

#include "program/store.h"

#include <mxgen/mxgen.h>

#include <stdbool.h>
#include <stdint.h>

#define CHECK_FORMAT_VERSION 1 /* version of records and reports in JSON */

/* The first failure: the step that fails, in order. */
#define CHECK_FAILURES(X) \
    X(PASSED, "passed")     /* no failure */ \
    X(LOAD, "load")         /* the file is no document, or a part of it is missing */ \
    X(VALIDATE, "validate") /* validation against the library */ \
    X(TRANSLATE, "translate") \
    X(GENERATE, "generate") \
    X(COMPILE, "compile") \
    X(RENDER, "render") \
    X(BUDGET, "budget") \
    X(CRASH, "crash")     /* the program that checked it died */ \
    X(TIMEOUT, "timeout") /* or exceeded the time limit */ \
    X(MEMORY, "memory")   /* or the limit of memory */

enum check_failure {
#define FAILURE(name, text) CHECK_##name,
    CHECK_FAILURES(FAILURE)
#undef FAILURE
        NUM_CHECK_FAILURES
};

/* "passed", "load" … */
extern const char *const check_failure_names[NUM_CHECK_FAILURES];

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

/* The explanation of a message; members as below. */
struct check_note {
    const char *text, *file;
    uint32_t line, column, length;
};

struct check_message {
    mxg_severity severity;
    const char *id, *text;
    const char *file;              /* "": none */
    uint32_t line, column, length; /* 0: unknown */
    const char *element, *target;  /* the first place of the message; "": the document */
    const char *rendered; /* printed like a compiler message, with notes and the source line */
    struct check_note *notes;
    size_t num_notes;
    /* since the baseline, in SARIF's words: "new", "unchanged", "absent"; "": no comparison */
    const char *state;
};

/*
 * A part of a measure: a function or node with its instructions, a node with its bytes of uniforms,
 * a texture.
 */
struct check_part {
    enum measure measure;
    const char *name;
    uint64_t count;
};

/* An element for one target. */
struct check_shader {
    const char *target;
    enum check_failure failed;
    bool compiled;        /* the target has a compiler */
    const char *topology; /* hexadecimal; "" without a shader, or in a brief record */
    uint64_t measures[NUM_MEASURES];
    struct check_part *parts; /* per measure the largest parts, in order */
    size_t num_parts;
    uint32_t *messages; /* indices of messages of the document */
    size_t num_messages;
    double generate_ms, compile_ms;
};

/* The value of a published input, or the file of a texture. */
struct check_setting {
    const char *path, *value;
};

/* A step of a budget of slabs. Errors are of all steps so far, mean CIEDE2000; "": unknown. */
struct check_step {
    const char *text;
    uint32_t closures_before, closures_after, bytes_before, bytes_after;
    const char *estimated, *drawn;
};

struct check_element {
    const char *path, *type;
    struct check_shader *shaders;
    size_t num_shaders;
    /* of the first target that has a shader, in its order; none in a brief record */
    struct check_setting *values, *textures;
    size_t num_values, num_textures;
    const char *picture;   /* a PNG in base64; "": none */
    const char *slabs;     /* their tree, as `mxgen inspect --slabs` shows it; "": none */
    const char *signature; /* signature of the picture, see picture.h */
    /* where options make slabs cheaper: a PNG without them, and the mean CIEDE2000 between both */
    const char *full, *drawn_error; /* "": none */
    struct check_step *steps;       /* of that budget */
    size_t num_steps;
};

/* Differences from a baseline: kind, name, meaning, whether it fails a run without --fail-on. */
#define CHECK_CHANGES(X) \
    X(FAILS, "fails", "a document or shader fails that passed or was missing", true) \
    X(NEW_ERRORS, "new-errors", "a document has an error that the baseline lacks", true) \
    X(UNCOMPILED, "uncompiled", "no compiler has seen a shader that was compiled", true) \
    X(FIXED, "fixed", "a document or shader passes that failed", false) \
    X(GONE_ERRORS, "gone-errors", "a document no longer has an error", false) \
    X(NEW_WARNINGS, "new-warnings", "a document has a warning that the baseline lacks", false) \
    X(GONE_WARNINGS, "gone-warnings", "a document no longer has a warning", false) \
    X(TOPOLOGY, "topology", "a shader differs in more than the values of uniforms", false) \
    X(SIZE, "size", "a measure differs", false) \
    X(VALUES, "values", "a published input has another value", false) \
    X(TEXTURES, "textures", "a material reads another texture file", false) \
    X(PICTURE, "picture", "a material looks different", false) \
    X(NEW, "new", "a document or element is new", false) \
    X(GONE, "gone", "a document or element is gone", false)

enum check_change_kind {
#define CHANGE(name, text, meaning, fails) CHANGE_##name,
    CHECK_CHANGES(CHANGE)
#undef CHANGE
        NUM_CHECK_CHANGES
};

extern const char *const check_change_names[NUM_CHECK_CHANGES];
extern const char *const check_change_meanings[NUM_CHECK_CHANGES];

/* A set of kinds: bit k stands for kind k. */
typedef uint32_t check_change_set;

/* The kinds that always fail a run. */
extern const check_change_set check_failing_changes;

struct check_change {
    enum check_change_kind kind;
    const char *element, *target; /* "": the document; all targets */
    const char *text;
    /* a new message, of the document; NULL: the change is no message. Not stored */
    const struct check_message *message;
};

struct check_document {
    uint64_t index; /* index among all documents, including other shards */
    const char *file;
    const char *name; /* its path below the root (root.h); "": it is outside */
    enum check_failure failed;
    struct check_message *messages; /* each once, in order of discovery */
    size_t num_messages;
    uint32_t num_hidden; /* errors beyond the limit, which `messages` lacks */
    const char **files;  /* files that were read, the document first */
    size_t num_files;
    /*
     * folders of textures and of missing files, with a '/' at the end: the record depends on the
     * names in them
     */
    const char **folders;
    size_t num_folders;
    /* images of pictures and budgets, existing or not: the record depends on their content */
    const char **images;
    size_t num_images;
    struct check_element *elements;
    size_t num_elements;
    double load_ms, validate_ms, render_ms;
    struct check_change *changes; /* differences from the baseline */
    size_t num_changes;
    struct check_message *gone_messages; /* of the baseline, which the document no longer has */
    size_t num_gone_messages;
};

/* Sets a failure, unless an earlier one is set. */
void check_fail(enum check_failure *failed, enum check_failure failure);

/*
 * The failure of the document itself, or CHECK_PASSED: failures of its shaders do not
 * count.
 */
enum check_failure check_own_failure(const struct check_document *document);

/* True if the document has a change of one of these kinds. */
bool check_has_change(const struct check_document *document, check_change_set kinds);

/* Appends a message, which need not have a state; returns its index. */
uint32_t check_add_message(struct store *store, struct check_document *document,
                           const struct check_message *message);

/*
 * Appends the folders that may contain a file: the folder of the file that names it, and the
 * working directory.
 */
void check_add_place(struct store *store, struct check_document *document, const char *from,
                     const char *file);

/* Appends a file or an image once and copies its name. */
void check_add_file(struct store *store, struct check_document *document, const char *path);
void check_add_image(struct store *store, struct check_document *document, const char *path);

#endif
