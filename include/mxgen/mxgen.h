// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen compiles MaterialX documents to shaders. This header and those that it
 * includes are the whole public interface.
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
 * accepts NULL.
 *
 * Errors: the returned mxg_status reports mistakes of the caller and missing resources of the
 * machine. Errors in a document are diagnostics of the document or of the result; both exist even
 * if the call fails.
 *
 * Threads: different contexts are independent. One thread at a time may use a context or make an
 * object with it. Any number of threads may read the same library, document or result, if each
 * generates with its own context. One thread at a time may set options.
 *
 * Strings are UTF-8 and NUL-terminated. Functions return the length of a text that may be large.
 * The library does not print, read environment variables or change the locale, and opens files only
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
    MXG_ERROR_INTERNAL = 5,  /* a bug in mxgen */
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

/*
 * A target of the host: a target of mxgen under another name. A <targetdef> of this name, with
 * `inherit`, lets libraries have implementations for it; those for the base serve it, too.
 */
typedef struct mxg_dialect {
    size_t size;         /* sizeof(mxg_dialect) */
    const char *name;    /* for mxg_generate_desc.target and for libraries: "mygl" */
    const char *base;    /* "glsl", or "genglsl" */
    const char *version; /* of the language: the default of `target-version`; NULL: that of base */
    /* pairs of a key and a value, num_options of them: other defaults of options */
    const char *const *options;
    size_t num_options;
    /* file endings of the vertex and the pixel stage; NULL: those of base */
    const char *stage_suffix[2];
} mxg_dialect;

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
    uint32_t max_depth;         /* nesting of elements, up to 200; 0 = 128 */
    uint32_t max_include_depth; /* nesting of includes, up to 200; 0 = 16 */
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
     * Targets of the host, num_dialects of them. MXG_ERROR_ARGUMENT for a name that is taken, an
     * unknown base, version or option, or a bad value. The texts live as long as the context.
     */
    const mxg_dialect *const *dialects;
    size_t num_dialects;
    /*
     * Reads a texture for the estimated errors of budgets (docs/slabs.md): the means of `size` by
     * `size` equal parts, rows from the top, RGBA each, without a change of colour space. `from`
     * and `file` are as in mxg_resolver.open; `layer` is the name of the file's layer, or "".
     * False: it cannot be read. mxgen calls it at most once per texture of a call, from the thread
     * of the call, where steps of a budget are estimated: with the option max-error, or if the
     * warnings budget-step are shown. It must not call mxgen. NULL: a texture counts as a few fixed
     * colours, as one that cannot be read.
     */
    bool (*read_texels)(void *user_data, const char *from, const char *file, const char *layer,
                        uint32_t size, float *out_texels);
    void *texels_user_data;
} mxg_context_desc;
#define MXG_CONTEXT_DESC_INIT MXG_INIT(mxg_context_desc)

/* desc may be NULL: all defaults. */
MXG_API mxg_status mxg_context_create(const mxg_context_desc *desc, mxg_context **out_context);
MXG_API void mxg_context_destroy(mxg_context *context);

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
    uint32_t parent;  /* for a note: index of its error or warning; otherwise its own index */
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
 * Formats one diagnostic as compilers do. If `source`, which may be NULL, contains the text of the
 * file, the output shows the source line with a caret. Writes at most `capacity` bytes including a
 * NUL; returns the full length without the NUL, or 0 if there is no such diagnostic or no memory.
 */
MXG_API size_t mxg_diagnostics_format(const mxg_diagnostics *list, uint32_t index,
                                      const char *source, size_t source_size, bool colour,
                                      char *buffer, size_t capacity);
/* The same, if the caller has only the source line (without its line end; NULL: unknown). */
MXG_API size_t mxg_diagnostics_format_line(const mxg_diagnostics *list, uint32_t index,
                                           const char *line, size_t line_size, bool colour,
                                           char *buffer, size_t capacity);

/* Every diagnostic that mxgen can report, for lists and help: `mxgen explain`. Static. */
typedef struct mxg_diagnostic_kind {
    size_t size;           /* in: sizeof(mxg_diagnostic_kind) */
    const char *id;        /* stable, for example "type-mismatch" */
    mxg_severity severity; /* default; the context's `warnings` can change it */
    const char *message;   /* a format with %s and %u */
    const char *cause, *cure;
    /*
     * An example as a diff. Lines with "- " belong to the wrong version, lines with "+ " to the
     * right one, lines with two spaces to both. "== NAME" begins another file than example.mtlx. "$
     * ", "-$ " and "+$ " give the arguments of mxgen if they matter. "": no example.
     */
    const char *example;
} mxg_diagnostic_kind;
MXG_API uint32_t mxg_catalogue_num_diagnostic_kinds(void);
MXG_API mxg_status mxg_catalogue_diagnostic_kind(uint32_t index, mxg_diagnostic_kind *out);

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

/*
 * The library image, for mxg_library_load and for embedding. It lives as long as the library. The
 * library must have no base, and no implementation with faults (MXG_ERROR_DOCUMENT).
 */
MXG_API mxg_status mxg_library_image(mxg_library *library, const void **out_data, size_t *out_size);
/* The library as a plain MaterialX document with all templates expanded. */
MXG_API mxg_status mxg_library_xml(mxg_library *library, const char **out_text, size_t *out_size);
/*
 * What this document lacks: a warning `expand-loss` for each input that mxgen's code for a node
 * reads, and the node's graph for other tools does not. They live as long as the library. NULL: out
 * of memory.
 */
MXG_API const mxg_diagnostics *mxg_library_losses(mxg_library *library);

typedef struct mxg_nodedef {
    size_t size;                                            /* in */
    const char *name, *node, *version, *group, *doc, *file; /* "" if absent */
    uint32_t num_inputs, num_outputs;
    bool has_implementation; /* for at least one target */
    bool is_default_version; /* a node without a version uses this definition */
} mxg_nodedef;

typedef struct mxg_port {
    size_t size; /* in */
    /* "" if absent */
    const char *name, *type, *value, *defaultgeomprop, *enum_names, *unit, *doc;
    bool uniform;
    bool advanced; /* uiadvanced */
    /* "" if absent */
    const char *enum_values, *unittype, *uiname, *uifolder, *uimin, *uimax, *uisoftmin, *uisoftmax,
        *uistep;
} mxg_port;

/* The count includes the definitions of the bases. */
MXG_API uint32_t mxg_library_num_nodedefs(const mxg_library *library);
MXG_API mxg_status mxg_library_nodedef(const mxg_library *library, uint32_t index,
                                       mxg_nodedef *out);
/* Port `index` of a definition: first the inputs, then the outputs. */
MXG_API mxg_status mxg_library_port(const mxg_library *library, uint32_t nodedef, uint32_t index,
                                    mxg_port *out);
/* True if the definition has an implementation for the target (by name). */
MXG_API bool mxg_library_has_implementation(const mxg_library *library, uint32_t nodedef,
                                            const char *target);

/* ---- Document ---- */

/*
 * Loads and resolves a file. *out_document is set whenever memory allows, also with
 * MXG_ERROR_DOCUMENT. If one part has an error, for example a missing include, the renderables of
 * the other parts remain. A file that is not XML has no renderables.
 */
MXG_API mxg_status mxg_document_load(mxg_context *context, mxg_library *library, const char *path,
                                     mxg_document **out_document);
/* The same from memory. `name` appears in messages and is the base of includes. */
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
 * The materials that a look or a look group assigns. MXG_ERROR_ARGUMENT if `index` is behind the
 * last one or `look` is not the path of a look.
 */
MXG_API mxg_status mxg_document_look_material(const mxg_document *document, const char *look,
                                              uint32_t index, mxg_renderable *out);

/*
 * Checks every node, connection and value of the document against its library, without generating.
 */
MXG_API mxg_status mxg_validate(mxg_context *context, const mxg_document *document,
                                mxg_result **out_result);

/* The elements of documents, edits, and documents as text. */
#include <mxgen/document.h>
/* Scenes, and the layers of materials of their primitives. */
#include <mxgen/scene.h>
/* Nodes that a host or a plug-in implements in C. */
#include <mxgen/node.h>

/* ---- Targets and options ---- */

typedef struct mxg_target {
    size_t size; /* in */
    const char *name, *materialx_name, *brief;
    /*
     * file endings of the vertex and the pixel stage (OSL: of displacement and shader); NULL: no
     * such stage
     */
    const char *stage_suffix[2];
} mxg_target;
MXG_API uint32_t mxg_catalogue_num_targets(void);
MXG_API mxg_status mxg_catalogue_target(uint32_t index, mxg_target *out);

typedef enum mxg_option_type {
    MXG_OPTION_BOOL,
    MXG_OPTION_INT,
    MXG_OPTION_STRING,
    MXG_OPTION_ENUM,
    MXG_OPTION_LIST,
    MXG_OPTION_FLOAT, /* empty: not set */
    MXG_OPTION_MAX_ENUM = 0x7fffffff
} mxg_option_type;
typedef struct mxg_option {
    size_t size;     /* in */
    const char *key; /* "interface" */
    mxg_option_type type;
    const char *values;  /* ENUM: "complete|authored|reduced"; INT, FLOAT: "0..1024" */
    const char *initial; /* the default, as text */
    const char *doc;
} mxg_option;
/*
 * Every option of generation. The command line makes its flags from this list; a host can make its
 * user interface from it.
 */
MXG_API uint32_t mxg_catalogue_num_options(void);
MXG_API mxg_status mxg_catalogue_option(uint32_t index, mxg_option *out);
/*
 * True if the option has a meaning for the target; a target ignores the others, so one set of
 * options serves several targets. False for an unknown index or target.
 */
MXG_API bool mxg_catalogue_has_option(uint32_t index, const char *target);

MXG_API mxg_status mxg_options_create(mxg_context *context, mxg_options **out_options);
MXG_API void mxg_options_destroy(mxg_options *options);
/*
 * Sets an option by key from text ("true", "16", "reduced"); lists append. Returns
 * MXG_ERROR_ARGUMENT for an unknown key or a bad value; mxg_options_error then explains the error.
 */
MXG_API mxg_status mxg_options_set(mxg_options *options, const char *key, const char *value);
MXG_API const char *mxg_options_error(const mxg_options *options);

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
 * The passes of the deferred pipeline that belong to no material (docs/deferred.md), in their
 * order. Their texts depend on the options alone. A pass is a result with one source, of a compute
 * stage, in the place of the pixel stage; a lighting pass has variables, as a surface has. A pass
 * that the options do not ask for ("diffuse", "blur") has no source and no reflection. `desc` names
 * a target and options only.
 */
MXG_API uint32_t mxg_catalogue_num_passes(void);
MXG_API const char *mxg_catalogue_pass(uint32_t index); /* NULL: there is no such pass */
MXG_API mxg_status mxg_generate_pass(mxg_context *context, uint32_t index,
                                     const mxg_generate_desc *desc, mxg_result **out_result);

/*
 * A resource that the passes share, and material passes write, in descriptor set binding-set + 1 of
 * the target vulkan. Its binding is its index. The JSON of a pass has the same.
 */
typedef struct mxg_pass_resource {
    size_t size;      /* in */
    const char *name; /* "words" */
    const char *kind; /* "image2D", "image2DArray", "sampler2D", "buffer" or "uniform" */
    /* "r32ui"; "any": every format of floats; "std430", "std140": of buffers; "": of samplers */
    const char *format;
    const char *doc;
    uint32_t num_layers;  /* of "image2DArray"; 0 of "words": as many as the materials need */
    uint32_t byte_size;   /* of a buffer, without its arrays per tile or pixel */
    uint32_t num_members; /* of a buffer */
} mxg_pass_resource;
MXG_API uint32_t mxg_catalogue_num_pass_resources(void);
MXG_API mxg_status mxg_catalogue_pass_resource(uint32_t index, mxg_pass_resource *out);

/* A member of a buffer. */
typedef struct mxg_pass_member {
    size_t size;        /* in */
    const char *name;   /* as in the source: "mx_to_world" */
    const char *type;   /* "mat4", or the name of a struct */
    const char *values; /* the words of its numbers, from 0, separated by '|'; "": any number */
    const char *doc;
    const char *per; /* "tile" or "pixel": the array is as long for each of them; "": one array */
    uint32_t offset; /* in bytes, from the buffer or the struct */
    uint32_t array_length, array_stride; /* 0: no array */
    uint32_t matrix_stride;              /* 0: no matrix */
    bool
        is_nested; /* in the struct that is the type of the last member before that is not nested */
} mxg_pass_member;
MXG_API mxg_status mxg_catalogue_pass_member(uint32_t resource, uint32_t index,
                                             mxg_pass_member *out);

/* How a pass runs. */
typedef struct mxg_pass {
    size_t size; /* in */
    const char *name;
    uint32_t group_size[3]; /* invocations of a group, which covers a tile of as many pixels */
    bool
        is_indirect; /* the buffer `tiles` has the command of its dispatch; else a group per tile */
    uint32_t dispatch_offset; /* of that command, in bytes */
    uint32_t reads, writes;   /* bits of resources, by their index */
} mxg_pass;
/* MXG_ERROR_ARGUMENT: the result is no pass. */
MXG_API mxg_status mxg_result_pass(const mxg_result *result, mxg_pass *out);
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

/* The place in the document that produced a line (from 1) of a stage's source; false: none. */
MXG_API bool mxg_result_source_place(const mxg_result *result, mxg_stage stage, uint32_t line,
                                     const char **out_file, uint32_t *out_line,
                                     uint32_t *out_column, const char **out_path);

/*
 * The path of the node that produced a line, also of a node inside a definition:
 * "SR_gold/coat_bsdf". Writes at most `capacity` bytes including a NUL; returns the full length
 * without the NUL, or 0 if there is no path or no memory.
 */
MXG_API size_t mxg_result_source_path(const mxg_result *result, mxg_stage stage, uint32_t line,
                                      char *buffer, size_t capacity);

/*
 * The path of the node that produced closure `index` (below num_closures of mxg_shader_info), in
 * the same way.
 */
MXG_API size_t mxg_result_closure_path(const mxg_result *result, uint32_t index, char *buffer,
                                       size_t capacity);

/* Files beside those of the document that the shader depends on: photometric profiles. */
MXG_API uint32_t mxg_result_num_files(const mxg_result *result);
MXG_API const char *mxg_result_file(const mxg_result *result, uint32_t index);

/* ---- Reflection ---- */

typedef enum mxg_block {
    MXG_BLOCK_PUBLIC_UNIFORMS,
    MXG_BLOCK_PRIVATE_UNIFORMS,
    MXG_BLOCK_LIGHT_DATA,
    MXG_BLOCK_TEXTURES,
    MXG_BLOCK_APP_DATA,
    MXG_BLOCK_VERTEX_DATA,
    MXG_BLOCK_OUTPUTS,
    /*
     * The blocks that nodes in C declare (mxg_build_uniform.block), in the order of their
     * declaration. Their bindings follow those of the textures.
     */
    MXG_BLOCK_OWN_1,
    MXG_BLOCK_OWN_2,
    MXG_BLOCK_OWN_3,
    MXG_BLOCK_OWN_4,
    MXG_NUM_BLOCKS,
    MXG_BLOCK_MAX_ENUM = 0x7fffffff
} mxg_block;

typedef struct mxg_variable {
    size_t size;      /* in */
    const char *name; /* as in the source; a member does not include the name of its block */
    mxg_block block;
    uint32_t stages;           /* bit s: stage s reads the variable */
    const char *type;          /* a type of the shading language: "vec3", "sampler2D" */
    const char *document_type; /* "color3"; "" for private variables */
    const char *path;          /* "SR_gold/base_color"; "" for private variables */
    const char *semantic;      /* "worldMatrix", "geomprop:st"; "" for public variables */
    const char *colorspace, *unit;
    uint32_t array_length; /* 0: not an array */
    uint32_t set, binding, location;
    uint32_t offset, byte_size, array_stride, matrix_stride; /* in a block */
    uint32_t num_values; /* components of the default; 0: none */
    float values[16];    /* integers and booleans as numbers */
    /*
     * textures. `file` has the fileprefix of the document; a name that is not absolute is relative
     * to the folder of the file of the document that has the input: mxg_document_file, or the file
     * of the element (mxg_element_info.file) where it comes from an include
     */
    const char *file, *uaddressmode, *vaddressmode, *filtertype;
    /* for user interfaces, from the definition; "" if absent */
    const char *uiname, *uifolder, *uimin, *uimax, *uisoftmin, *uisoftmax, *doc;
    /*
     * textures: the name of the file's layer; the frames of a sequence; the tiles of an image,
     * whose files are the layers of a texture array
     */
    const char *layer, *framerange, *frameendaction;
    int32_t frameoffset;
    uint32_t num_tiles;
    const char *unittype;
    /* for user interfaces; commas separate names and values */
    const char *uistep, *enum_names, *enum_values;
    bool advanced;   /* uiadvanced */
    bool flat;       /* not interpolated between vertices */
    int32_t integer; /* the exact default of an integer */
    /* of a stack: the slot or vertical layer that the input belongs to: "050", "000|010" */
    const char *slot;
    /* of the sampler beside a texture; equal to `binding` where both have one */
    uint32_t sampler_binding;
} mxg_variable;
MXG_API uint32_t mxg_result_num_variables(const mxg_result *result);
MXG_API mxg_status mxg_result_variable(const mxg_result *result, uint32_t index, mxg_variable *out);
/*
 * A tile of a texture. It covers the texture coordinates from (u, v) to (u + 1, v + 1) and is layer
 * `tile` of the texture array.
 */
typedef struct mxg_tile {
    size_t size; /* in */
    const char *file;
    int32_t u, v;
} mxg_tile;
MXG_API mxg_status mxg_result_tile(const mxg_result *result, uint32_t variable, uint32_t tile,
                                   mxg_tile *out);
/*
 * The file of a texture, or of one of its tiles, at a frame. Replaces {frame} and {04frame} and
 * applies the document's offset, range and end action. Writes as much as fits and a NUL; returns
 * the full length, or 0 if the frame has no file: the host then shows the default colour.
 */
MXG_API size_t mxg_result_texture_file(const mxg_result *result, uint32_t variable, uint32_t tile,
                                       int32_t frame, char *out, size_t capacity);

/*
 * Index of the variable for a document path; false: no variable has it, because the input is unused
 * or compiled in.
 */
MXG_API bool mxg_result_find_variable(const mxg_result *result, const char *path,
                                      uint32_t *out_index);

/*
 * Inputs of the document whose value is compiled in. A new value needs an edit (document.h) and a
 * new generation.
 */
typedef struct mxg_compiled_input {
    size_t size; /* in */
    const char *path, *type;
    const char *value; /* as written: "0.5", "oren_nayar"; "" for zero */
    bool authored;     /* the document has the value; otherwise it is the default */
    /* for user interfaces, like those of mxg_variable */
    bool advanced;
    const char *uiname, *uifolder, *uimin, *uimax, *uisoftmin, *uisoftmax, *uistep, *enum_names,
        *enum_values, *doc;
} mxg_compiled_input;
MXG_API uint32_t mxg_result_num_compiled_inputs(const mxg_result *result);
MXG_API mxg_status mxg_result_compiled_input(const mxg_result *result, uint32_t index,
                                             mxg_compiled_input *out);

/* The effect of a new value of an input on a shader. */
typedef enum mxg_input_state {
    MXG_INPUT_UNKNOWN,  /* the document has no input of this path */
    MXG_INPUT_UNUSED,   /* no effect: the shader does not need the input */
    MXG_INPUT_UNIFORM,  /* a variable has the value: mxg_result_find_variable */
    MXG_INPUT_COMPILED, /* needs a new generation: mxg_result_compiled_input */
    /* no value: the input is connected, or its default is a property of the geometry */
    MXG_INPUT_CONNECTED,
    MXG_INPUT_STATE_MAX_ENUM = 0x7fffffff
} mxg_input_state;
/*
 * The state of an input of a node ("SR_gold/base_color", whether the document writes the input or
 * not) or of a nodegraph ("NG_marble/scale"). UNKNOWN also without a shader, and in a network,
 * whose layers have the inputs as parameters.
 */
MXG_API mxg_input_state mxg_result_input_state(const mxg_result *result, const char *path);

/*
 * How a host draws the shader. OPAQUE: without blending. MASK: with the depth test alone; the
 * shader discards pixels below u_alphaThreshold and writes alpha 1 for the others. BLEND: back to
 * front, blended over the pixels behind. Colours are premultiplied.
 */
typedef enum mxg_alpha {
    MXG_ALPHA_OPAQUE,
    MXG_ALPHA_MASK,
    MXG_ALPHA_BLEND,
    MXG_ALPHA_MAX_ENUM = 0x7fffffff
} mxg_alpha;

typedef struct mxg_shader_info {
    size_t size; /* in */
    const char *name, *path, *target;
    /*
     * A hash: equal for shaders that differ only in names and uniform values. mxg_result_info
     * computes it only if `size` includes this member.
     */
    uint64_t topology;
    uint32_t num_closures, num_textures, num_lights;
    bool transparent, lit;
    bool displaced; /* the vertex stage moves the surface: draw it with small triangles */
    mxg_alpha alpha;
    /*
     * With role=function: the names of the function and of the struct that it returns. Its
     * parameters are the variables of MXG_BLOCK_VERTEX_DATA, its members those of
     * MXG_BLOCK_OUTPUTS, both in order. "": a program
     */
    const char *function, *function_type;
    /*
     * Words of 32 bits that it stores per pixel, at most, for the passes of the deferred pipeline,
     * or that its payload has (docs/deferred.md); 0: it lights itself.
     */
    uint32_t stored_words;
    uint32_t layout; /* of stored words: equal in all materials and passes that fit together */
    /*
     * Classes of pixels, as bits, by the number of their command in `tiles` (docs/deferred.md):
     * that a material may store, or that a pass lights. A pass whose classes no material of a
     * picture has need not run. 0: of other passes.
     */
    uint32_t stored_classes;
} mxg_shader_info;
MXG_API mxg_status mxg_result_info(const mxg_result *result, mxg_shader_info *out);

/*
 * The meaning of a variable without a path: space, unit, direction and range (docs/reflection.md
 * has the table). World space is right-handed, vectors are columns, matrices are stored column by
 * column, and clip space is that of the host's projectionMatrix.
 */
typedef struct mxg_semantic {
    size_t size; /* in */
    mxg_block block;
    /*
     * mxg_variable.semantic; the name of a member of LightData; "texcoord:*": '*' stands for an
     * index, the name of a property, or a variant of a matrix
     */
    const char *semantic;
    const char *type; /* "vec3"; "": several */
    const char *doc;
} mxg_semantic;
MXG_API uint32_t mxg_catalogue_num_semantics(void);
MXG_API mxg_status mxg_catalogue_semantic(uint32_t index, mxg_semantic *out);

/* ---- Values ---- */

typedef enum mxg_change {
    MXG_CHANGE_NOTHING, /* the program and its values stay */
    MXG_CHANGE_VALUES,  /* the program stays; some variables have other values */
    MXG_CHANGE_SHADER,  /* another program */
    MXG_CHANGE_MAX_ENUM = 0x7fffffff
} mxg_change;
/*
 * What a host changes to draw `after` in place of `before`, for example after an edit. Both come
 * from the same target and options; `after` may have no source (without_source). A variable has the
 * same index in both results, unless the answer is SHADER.
 *
 * Writes the indices of the variables with other values, at most `capacity` of them, and returns
 * their number in *out_num (may be NULL). For a texture, another file, layer, tile, address mode or
 * colour of the border counts. Paths and texts for user interfaces may differ: take them from
 * `after`. SHADER also if one of the results has no shader, if the way of drawing differs
 * (mxg_shader_info), or if the values of a network differ.
 */
MXG_API mxg_change mxg_result_change(const mxg_result *before, const mxg_result *after,
                                     uint32_t *variables, uint32_t capacity, uint32_t *out_num);

/* A block of the interface. Its variables have consecutive indices. */
typedef struct mxg_block_info {
    size_t size;      /* in */
    const char *name; /* "PublicUniforms"; "" for an own block that the shader has not */
    uint32_t first_variable, num_variables;
    /*
     * For uniforms in a buffer; 0 if the target or the options declare single uniforms. LightData:
     * the bytes of the array u_lightData.
     */
    uint32_t byte_size;
    uint32_t set, binding;               /* of the buffer */
    uint32_t array_length, array_stride; /* LightData: the lights, and their distance in bytes */
} mxg_block_info;
MXG_API mxg_status mxg_result_block(const mxg_result *result, mxg_block block, mxg_block_info *out);

/*
 * Fills a buffer of uniforms with the default values, ready for upload: std140, or the packing of
 * constant buffers for HLSL. Numbers are 32 bits wide, a boolean is 0 or 1, a matrix has its
 * columns matrix_stride bytes apart, and bytes between members are 0. Lights are 0. Returns
 * byte_size of the block; writes nothing if `capacity` is less.
 */
MXG_API size_t mxg_result_pack_block(const mxg_result *result, mxg_block block, void *bytes,
                                     size_t capacity);
/*
 * Writes the value of one variable to its place in such a buffer; `element` is the light of a
 * member of LightData, or the element of an array, else 0. Integers and booleans come as numbers.
 * MXG_ERROR_ARGUMENT if the variable is in no buffer, the number of values is not that of its type,
 * or `capacity` is too small.
 */
MXG_API mxg_status mxg_result_pack_value(const mxg_result *result, uint32_t variable,
                                         uint32_t element, const float *values, uint32_t num_values,
                                         void *bytes, size_t capacity);

/*
 * Fills a buffer like mxg_result_pack_block, with the values that another document has for the
 * program: the next document after an edit of inputs that are uniforms (mxg_result_input_state).
 * Reads these inputs and nothing else, so it is much faster than a generation, which
 * mxg_result_change needs. MXG_ERROR_DOCUMENT if the document has another node or no value there,
 * for example because the input is connected; the buffer is then not filled, and the host
 * generates. MXG_ERROR_ARGUMENT if the document has another library, the block is in no buffer, or
 * `capacity` is too small.
 */
MXG_API mxg_status mxg_document_pack_block(const mxg_document *document, const mxg_result *program,
                                           mxg_block block, void *bytes, size_t capacity);

/* A light shader of the result: u_lightData[i].type selects it for light i. */
typedef struct mxg_light_type {
    size_t size; /* in */
    int32_t type;
    const char *name;     /* of its function, or of its node */
    bool is_shader;       /* made of nodes: also reads the members `position` and `direction` */
    uint32_t num_members; /* the members of LightData that it reads as its inputs */
} mxg_light_type;
MXG_API uint32_t mxg_result_num_light_types(const mxg_result *result);
MXG_API mxg_status mxg_result_light_type(const mxg_result *result, uint32_t index,
                                         mxg_light_type *out);
/* The variable of member `member`. false: there is none, or no stage reads it. */
MXG_API bool mxg_result_light_member(const mxg_result *result, uint32_t index, uint32_t member,
                                     uint32_t *out_variable);

/*
 * The variables, inputs and info above as JSON (docs/reflection.md). NULL without a shader or
 * without memory.
 */
MXG_API const char *mxg_result_reflection_json(const mxg_result *result, size_t *out_size);

/* ---- Looking inside ---- */

typedef enum mxg_view {
    MXG_VIEW_ELEMENTS, /* the element tree and the renderables */
    MXG_VIEW_GRAPH,    /* nodes and connections as text */
    MXG_VIEW_DOT,      /* the same for Graphviz */
    MXG_VIEW_IR,       /* the optimised IR, parseable (docs/ir.md) */
    MXG_VIEW_CLOSURES, /* leaves with weights */
    MXG_VIEW_STATISTICS,
    MXG_VIEW_SLABS,      /* the tree of slabs, what they cost, and steps to one slab (docs/slabs.md)
                          */
    MXG_VIEW_SLABS_JSON, /* the same as JSON */
    MXG_VIEW_SLABS_SVG,  /* the same as a picture */
    MXG_VIEW_MAX_ENUM = 0x7fffffff
} mxg_view;
/*
 * CIEDE2000 (Sharma, Wu and Dalal 2005) between linear colours of Rec. 709, cut to 0 to 1: budgets
 * of slabs and their pictures are measured by it.
 */
MXG_API double mxg_color_difference(const float a[3], const float b[3]);
/*
 * A text for people. *out_result holds it; mxg_result_text returns it. desc selects the element,
 * target and options if the view needs them.
 */
MXG_API mxg_status mxg_inspect(mxg_context *context, const mxg_document *document, mxg_view view,
                               const mxg_generate_desc *desc, mxg_result **out_result);
MXG_API const char *mxg_result_text(const mxg_result *result, size_t *out_size);

#ifdef __cplusplus
}
#endif

#endif
