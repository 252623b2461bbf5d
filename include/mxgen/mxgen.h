// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen compiles MaterialX documents to shaders. This header is what a host needs on the first day;
 * those that it includes at its end are the rest of the public interface.
 *
 *     mxg_context *ctx;
 *     mxg_context_create(NULL, &ctx);
 *     mxg_library *lib = mxg_library_builtin(ctx);
 *     mxg_document *doc;
 *     mxg_document_load(ctx, lib, "gold.mtlx", &doc);
 *     mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
 *     desc.target = "glsl";
 *     mxg_result *res;
 *     mxg_generate(ctx, doc, &desc, &res);
 *     puts(mxg_result_source(res, MXG_STAGE_PIXEL, NULL));
 *
 * Objects and lifetimes
 *     context    allocator, resolver, limits, cancel callback      until mxg_context_destroy
 *     library    node definitions; immutable, reference-counted    until the last mxg_library_unref
 *     document   a loaded document; immutable; holds its library   until mxg_document_destroy
 *     options    values by key; belongs to the caller              until mxg_options_destroy
 *     scene      paths of primitives                               until mxg_scene_destroy
 *     bindings   the layers of each primitive under a look;        until mxg_bindings_destroy
 *                immutable; holds its document and its scene
 *     result     source, reflection and diagnostics of one call;   until mxg_result_destroy
 *                immutable; holds its document
 * An accessor returns data of its object: the data lives as long as the object. The caller frees
 * objects and nothing else. A context must outlive the objects that it made. Every destroy function
 * accepts NULL, and an accessor of NULL returns 0, NULL or MXG_ERROR_ARGUMENT.
 *
 * Errors: the returned mxg_status reports mistakes of the caller and missing resources of the
 * machine. Errors in a document are diagnostics of the document or of the result; both exist even
 * if the call fails.
 *
 * Threads: different contexts are independent. One thread at a time may use a context or make an
 * object with it. Any number of threads may read the same library, document or result, if each
 * generates with its own context. One thread at a time may set options.
 *
 * Strings are UTF-8 and NUL-terminated. A function that makes a text for the call writes at most
 * `capacity` bytes with a NUL to `buffer`, which may be NULL if `capacity` is 0, and returns the
 * full length without the NUL. CONTRIBUTING.md of the project has the grammar of the names. The
 * library does not print, read environment variables or change the locale, and opens files only
 * through the resolver.
 */
#ifndef MXGEN_MXGEN_H
#define MXGEN_MXGEN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(_WIN32)
#define MXG_API
#else
#define MXG_API __attribute__((visibility("default")))
#endif

/*
 * A struct begins with its size, so that later versions can add members. Initialise it with
 * `mxg_variable variable = MXG_INIT(mxg_variable);`. All other members become 0, which is the
 * default value of every member that the caller may set.
 */
// clang-format off
#ifdef __cplusplus
#define MXG_INIT(type) [] { type sized = type(); sized.size = sizeof sized; return sized; }()
#else
#define MXG_INIT(type) {.size = sizeof(type)}
#endif
// clang-format on

/* An index that is none. */
#define MXG_NONE 0xffffffffu

/* ---- Version ---- */

/* major: incompatible; minor: additions; patch: neither. The soname contains the major version. */
#define MXG_VERSION_MAJOR 0
#define MXG_VERSION_MINOR 1
#define MXG_VERSION_PATCH 0

/* The version of the library at run time: "0.1.0". */
MXG_API const char *mxg_version_string(void);

/* ---- Status ---- */

typedef enum mxg_status {
    MXG_OK = 0,
    /* the document, library or request has errors; the diagnostics list them */
    MXG_ERROR_DOCUMENT = 1,
    /* a required object is NULL, an index is out of range, or a struct has an unknown size */
    MXG_ERROR_ARGUMENT = 2,
    MXG_ERROR_MEMORY = 3,    /* the allocator failed, or the context reached its memory limit */
    MXG_ERROR_CANCELLED = 4, /* the cancel callback returned true */
    MXG_STATUS_MAX_ENUM = 0x7fffffff
} mxg_status;

MXG_API const char *mxg_status_string(mxg_status status);

typedef struct mxg_context mxg_context;
typedef struct mxg_library mxg_library;
typedef struct mxg_document mxg_document;
typedef struct mxg_options mxg_options;
typedef struct mxg_result mxg_result;
typedef struct mxg_scene mxg_scene;
typedef struct mxg_bindings mxg_bindings;

/* ---- Context ---- */

/*
 * Like realloc, with the old size as well; a new_size of 0 frees. Returning NULL for a size above 0
 * is a failure, and the current call returns MXG_ERROR_MEMORY. Any thread that uses the context or
 * an object of it calls this function, so several threads may call it at once: accessors make some
 * texts on first use, and the last unref frees. It must not call mxgen.
 */
typedef void *(*mxg_realloc_fn)(void *user_data, void *block, size_t old_size, size_t new_size);

/* The bytes of a file. The host lends them from open to release. */
typedef struct mxg_blob {
    /* canonical name: messages show it, and includes in the file are relative to it */
    const char *name;
    const char *data;
    size_t size;
    void *handle; /* for the host's use */
} mxg_blob;

/*
 * Finds files. `from` is the canonical name of the referring file, or "" if the caller named the
 * file. *out_blob is zero on entry; a blob without a name takes the name `ref`. On failure open
 * returns false and may point *out_reason at a text that lives until the next call. If the file
 * exists but cannot be read, open also sets out_blob->name: the diagnostic is then
 * "file-unreadable" instead of "file-missing". mxgen calls release once for each successful open,
 * before the API call returns.
 */
typedef struct mxg_resolver {
    void *user_data;
    bool (*open)(void *user_data, const char *from, const char *ref, mxg_blob *out_blob,
                 const char **out_reason);
    void (*release)(void *user_data, mxg_blob *blob);
    /*
     * Lists the files of a texture folder. `folder` is relative like `ref`; "" is the folder of
     * `from`. Writes each name with its NUL into `names` and returns the number of bytes that all
     * names need, or 0 if the folder does not exist. If the result exceeds `capacity`, mxgen
     * ignores `names` and calls again. NULL: an image has the tiles (<UDIM>) that the document
     * lists.
     */
    size_t (*list_folder)(void *user_data, const char *from, const char *folder, char *names,
                          size_t capacity);
} mxg_resolver;

typedef struct mxg_context_desc {
    size_t size;            /* sizeof(mxg_context_desc) */
    mxg_realloc_fn realloc; /* NULL: realloc and free of the C library */
    void *realloc_user_data;
    /* copied. NULL: paths are relative to the referring file, then to the working directory */
    const mxg_resolver *resolver;
    /* mxg_generate and mxg_inspect call it repeatedly and stop when it returns true; may be NULL */
    bool (*cancel)(void *user_data);
    void *cancel_user_data;
    /* bytes of the context, its objects and the files it reads without a resolver; 0 = unlimited */
    size_t max_memory;
    uint32_t max_file_mib;      /* 0 = 256 */
    uint32_t max_elements;      /* 0 = 16,000,000 */
    uint32_t max_nodes;         /* IR nodes of one generation; 0 = 64,000,000 */
    uint32_t max_output_mib;    /* 0 = 256 */
    uint32_t max_errors;        /* errors that a call keeps, with their notes; 0 = 20 */
    uint32_t max_depth;         /* nesting of elements; more than 200 is 200; 0 = 128 */
    uint32_t max_include_depth; /* nesting of includes; more than 200 is 200; 0 = 16 */
    uint32_t max_includes;      /* files that a document includes; 0 = 4,096 */
    /*
     * Changes the severity of diagnostics. Words, separated by commas: "error" makes all warnings
     * errors, "error=ID" makes one an error, "no-error=ID" undoes that, "no-ID" disables a warning,
     * "ID" makes a warning of a diagnostic that is off by default. NULL: the severities of the
     * catalogue. An unknown word returns MXG_ERROR_ARGUMENT.
     */
    const char *warnings;
    /*
     * Shader source in documents (libraries may always contain source). By default, mxgen accepts
     * source in the portable language, which it parses and prints, and refuses source for one
     * target, which it would copy into the shader unread. trust: accept all source. sandbox without
     * trust: accept none.
     */
    bool trust;
    /*
     * Without a resolver: a document may only refer to files in or below an include root or the
     * folder of a file that the caller named.
     */
    bool sandbox;
    const char *const *include_roots; /* folders; num_include_roots of them */
    size_t num_include_roots;
    /*
     * Folders to search for the source files of implementations and for included documents, after
     * the folder of the referring file and the folders of libraries; num_source_paths of them
     */
    const char *const *source_paths;
    size_t num_source_paths;
    /*
     * Code for nodes (node.h), num_node_codes of them; of two for the same definition the first one
     * counts. It replaces the implementations of libraries and documents. The structs, their texts
     * and their user data live as long as the context.
     */
    const struct mxg_node_code *const *node_codes;
    size_t num_node_codes;
    /*
     * Targets of the host (dialect.h), num_dialects of them. MXG_ERROR_ARGUMENT for a name that is
     * taken, an unknown base, version or option, or a bad value. The texts live as long as the
     * context.
     */
    const struct mxg_dialect *const *dialects;
    size_t num_dialects;
    /*
     * Reads textures for estimates (slabs.h); copied. NULL: a texture counts as a few fixed
     * colours, as one that cannot be read.
     */
    const struct mxg_texel_reader *texels;
} mxg_context_desc;
#define MXG_CONTEXT_DESC_INIT MXG_INIT(mxg_context_desc)

/* desc may be NULL: all defaults. */
MXG_API mxg_status mxg_context_create(const mxg_context_desc *desc, mxg_context **out_context);
/* Why mxg_context_create returns MXG_ERROR_ARGUMENT for `desc`; length 0 if it does not. */
MXG_API size_t mxg_context_desc_error(const mxg_context_desc *desc, char *buffer, size_t capacity);
MXG_API void mxg_context_destroy(mxg_context *context);

/*
 * Why `from`, a file that the caller names, may not refer to the file at `path`: in a sandbox it is
 * outside of the folder of `from` and of the include roots; it is a pipe, a device or a folder; it
 * is larger than max_file_mib. NULL: it may, or there is no such file. For hosts that open the
 * files of scenes; a text outside does not tell whether the file exists. The text is constant.
 */
MXG_API const char *mxg_context_file_fault(const mxg_context *context, const char *from,
                                           const char *path);

/* ---- Diagnostics ---- */

typedef enum mxg_severity {
    MXG_SEVERITY_ERROR,
    MXG_SEVERITY_WARNING,
    MXG_SEVERITY_NOTE,
    MXG_SEVERITY_MAX_ENUM = 0x7fffffff
} mxg_severity;

typedef struct mxg_diagnostic {
    size_t size; /* in: sizeof(mxg_diagnostic) */
    mxg_severity severity;
    const char *id;                /* stable, for example "type-mismatch" */
    const char *message;           /* one line, without the location */
    const char *file;              /* NULL: no file */
    uint32_t line, column, length; /* from 1, columns in code points; 0 = unknown */
    uint32_t parent; /* for a note: index of its error or warning; otherwise its own index */
    uint32_t num_arguments;
    const char *path; /* of an element that an edit added and that has no line; otherwise "" */
} mxg_diagnostic;

/*
 * The diagnostics of a library, document or result, in order of discovery. Notes follow the
 * diagnostic that they explain.
 */
typedef struct mxg_diagnostics mxg_diagnostics;
MXG_API uint32_t mxg_diagnostics_num_items(const mxg_diagnostics *list);
/* number of errors, including errors beyond max_errors */
MXG_API uint32_t mxg_diagnostics_num_errors(const mxg_diagnostics *list);
MXG_API mxg_status mxg_diagnostics_item(const mxg_diagnostics *list, uint32_t index,
                                        mxg_diagnostic *out);
/*
 * Returns what the format of the kind (mxg_diagnostic_kind.message) leaves open, as texts in its
 * order: the file of "missing-texture", both types of "type-mismatch". NULL: there is none.
 */
MXG_API const char *mxg_diagnostics_argument(const mxg_diagnostics *list, uint32_t item,
                                             uint32_t index);
/*
 * Formats one diagnostic as compilers do. With the line of the file where it is, without the line's
 * end, the text shows the line with a caret; `line` may be NULL. The last line has no end. The
 * length is 0 if there is no such diagnostic or no memory.
 */
MXG_API size_t mxg_diagnostics_format(const mxg_diagnostics *list, uint32_t index, const char *line,
                                      size_t line_size, bool colour, char *buffer, size_t capacity);

MXG_API const mxg_diagnostics *mxg_library_diagnostics(const mxg_library *library);
MXG_API const mxg_diagnostics *mxg_document_diagnostics(const mxg_document *document);
MXG_API const mxg_diagnostics *mxg_result_diagnostics(const mxg_result *result);
MXG_API const mxg_diagnostics *mxg_scene_diagnostics(const mxg_scene *scene);
MXG_API const mxg_diagnostics *mxg_bindings_diagnostics(const mxg_bindings *bindings);

/* ---- Library ---- */

/* The built-in library. The caller owns a reference. */
MXG_API mxg_library *mxg_library_builtin(mxg_context *context);

/*
 * Makes a library from `base` (NULL: empty) and the given files, folders (every .mtlx below) or
 * library images (.mxlib). A new definition replaces a definition of the same name in `base`. An
 * image must be the first path and needs `base` NULL. *out_library is set even with
 * MXG_ERROR_DOCUMENT: it has the diagnostics. An implementation with faults is a warning here, and
 * an error of each node that needs it. Folders belong to the file system; the resolver reads the
 * files in them.
 */
MXG_API mxg_status mxg_library_load(mxg_context *context, mxg_library *base,
                                    const char *const *paths, size_t num_paths,
                                    mxg_library **out_library);
MXG_API mxg_library *mxg_library_ref(mxg_library *library); /* atomic; returns its argument */
MXG_API void mxg_library_unref(mxg_library *library);

/*
 * The files of the library and of its bases, for depfiles and watchers. The built-in library has
 * none.
 */
MXG_API uint32_t mxg_library_num_files(const mxg_library *library);
MXG_API const char *mxg_library_file(const mxg_library *library, uint32_t index);

/* ---- Document ---- */

/*
 * Loads and resolves a file. *out_document is set whenever memory allows, also with
 * MXG_ERROR_DOCUMENT. If one part has an error, for example a missing include, the renderables of
 * the other parts remain. A file that is not XML has no renderables.
 */
MXG_API mxg_status mxg_document_load(mxg_context *context, mxg_library *library, const char *path,
                                     mxg_document **out_document);
/* Loads a document from memory. `name` appears in messages and is the base of includes. */
MXG_API mxg_status mxg_document_parse(mxg_context *context, mxg_library *library, const char *name,
                                      const char *data, size_t size, mxg_document **out_document);
MXG_API void mxg_document_destroy(mxg_document *document);

/* The files of the document, itself first, for depfiles and watchers. */
MXG_API uint32_t mxg_document_num_files(const mxg_document *document);
MXG_API const char *mxg_document_file(const mxg_document *document, uint32_t index);

/*
 * Elements that mxgen can generate, in document order: the materials. A document without materials
 * has its graph outputs and the shaders that nothing uses.
 */
typedef struct mxg_renderable {
    size_t size;          /* in */
    const char *path;     /* "Gold", "NG_marble1/out" */
    const char *type;     /* "material", "surfaceshader", "color3" … */
    const char *category; /* "surfacematerial", "output" … */
} mxg_renderable;
MXG_API uint32_t mxg_document_num_renderables(const mxg_document *document);
MXG_API mxg_status mxg_document_renderable(const mxg_document *document, uint32_t index,
                                           mxg_renderable *out);
/*
 * True if a look or a look group, by its path, assigns renderable `index`. Looks are the children
 * of the root with the category "look" (mxg_document_element); scene.h has their slots.
 */
MXG_API bool mxg_document_has_assignment(const mxg_document *document, const char *look,
                                         uint32_t index);

/*
 * Checks every node, connection and value of the document against its library, without generating.
 * What reading found is in mxg_document_diagnostics alone, so a text that is no XML has no errors
 * here.
 */
MXG_API mxg_status mxg_validate(mxg_context *context, const mxg_document *document,
                                mxg_result **out_result);

/* ---- Options ---- */

MXG_API mxg_status mxg_options_create(mxg_context *context, mxg_options **out_options);
MXG_API void mxg_options_destroy(mxg_options *options);
/*
 * Sets an option by key from text ("true", "16", "reduced"); lists append. MXG_ERROR_ARGUMENT for
 * an unknown key or a bad value.
 */
MXG_API mxg_status mxg_options_set(mxg_options *options, const char *key, const char *value);
/* The reason why the last mxg_options_set failed; length 0 if it did not. */
MXG_API size_t mxg_options_error(const mxg_options *options, char *buffer, size_t capacity);

/* ---- Generation ---- */

typedef enum mxg_stage {
    MXG_STAGE_VERTEX,
    MXG_STAGE_PIXEL,
    MXG_NUM_STAGES,
    MXG_STAGE_MAX_ENUM = 0x7fffffff
} mxg_stage;

typedef struct mxg_generate_desc {
    size_t size;
    const char *target; /* name of a target, for example "glsl" */
    /*
     * Path of the element to generate: a material, shader, node or output ("Gold",
     * "NG_marble1/out"), an output of a node ("split/outr"), a graph with one output, or a look
     * with one material. NULL: the first renderable of the document.
     */
    const char *element;
    const mxg_options *options; /* NULL: default options */
    /*
     * Leaves out the source. The result has the diagnostics, the variables and the topology, so a
     * host can look for a program that it already has. The call takes a third less time. Only the
     * limit max_output_mib can fail later, when the source is written. OSL networks keep their
     * layers.
     */
    bool without_source;
    /*
     * Only checks that the element can be generated. The result has the diagnostics and the files
     * beside the document, but no source, variables or info. The call takes a third of the time;
     * the steps that it leaves out cannot fail.
     */
    bool only_diagnostics;
    /*
     * A stack of bindings (mxgen/scene.h) to generate in the place of an element: its layers as one
     * shader. The bindings are those of the document. NULL: an element.
     */
    const mxg_bindings *bindings;
    uint32_t stack; /* less than mxg_bindings_num_stacks */
} mxg_generate_desc;
#define MXG_GENERATE_DESC_INIT MXG_INIT(mxg_generate_desc)

/*
 * *out_result is set whenever memory allows. With MXG_ERROR_DOCUMENT it has diagnostics but no
 * source.
 */
MXG_API mxg_status mxg_generate(mxg_context *context, const mxg_document *document,
                                const mxg_generate_desc *desc, mxg_result **out_result);

/*
 * The module that materials of MDL import with the option `mdl-module`, which `desc` sets, too
 * (docs/mdl.md): a result with one source, of the pixel stage, whose name (mxg_shader_info) is that
 * of the module. It has functions of the library, and depends on the library, the name and the
 * version of the language alone. `desc` names a target and options only.
 */
MXG_API mxg_status mxg_generate_module(mxg_context *context, mxg_library *library,
                                       const mxg_generate_desc *desc, mxg_result **out_result);

MXG_API void mxg_result_destroy(mxg_result *result);

/*
 * The source of a stage; NULL if the shader has no such stage. OSL has a vertex stage only for
 * displacement.
 */
MXG_API const char *mxg_result_source(const mxg_result *result, mxg_stage stage, size_t *out_size);
/*
 * With the option `osl-network`, the sources above list layers, values and connections in the
 * syntax of OSL's ShaderGroupBegin. The parts are the shaders of the layers: one file "<name>.osl"
 * each. Two parts of the same name are equal, also across elements.
 */
typedef struct mxg_part {
    size_t size;      /* in */
    const char *name; /* "ND_dielectric_bsdf_scatter_mode_T" */
    const char *source;
    size_t source_size;
    const char *nodedef; /* "ND_dielectric_bsdf"; "" for the last shader of a group */
} mxg_part;
MXG_API uint32_t mxg_result_num_parts(const mxg_result *result);
MXG_API mxg_status mxg_result_part(const mxg_result *result, uint32_t index, mxg_part *out);

/* Names of the functions that the pixel stage calls and the host writes (docs/hosts.md). */
MXG_API uint32_t mxg_result_num_host_functions(const mxg_result *result);
MXG_API const char *mxg_result_host_function(const mxg_result *result, uint32_t index);

/* Files beside those of the document that the shader depends on: photometric profiles. */
MXG_API uint32_t mxg_result_num_files(const mxg_result *result);
MXG_API const char *mxg_result_file(const mxg_result *result, uint32_t index);

/* The text of mxg_inspect, mxg_rewrite, … */
MXG_API const char *mxg_result_text(const mxg_result *result, size_t *out_size);

#ifdef __cplusplus
}
#endif

/* The rest, by subject. */
#include <mxgen/library.h>
#include <mxgen/document.h>
#include <mxgen/reflection.h>
#include <mxgen/catalogue.h>
#include <mxgen/inspect.h>
#include <mxgen/scene.h>
#include <mxgen/slabs.h>
#include <mxgen/passes.h>
#include <mxgen/storage.h>
#include <mxgen/dialect.h>
#include <mxgen/node.h>

#endif
