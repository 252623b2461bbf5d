// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen: MaterialX documents to shaders. The whole public interface.
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
 *     result     source, reflection and diagnostics of one call;   until mxg_result_destroy
 *                immutable; holds its document
 * Whatever an accessor returns lives as long as the object asked. Nothing is returned for the
 * caller to free but objects. A context must outlive what was made with it. Destroying NULL is
 * allowed.
 *
 * Errors: functions return an mxg_status for what the *caller* did or the machine lacks. Faults of
 * a document are diagnostics, found in the document or result, which exist even then.
 *
 * Threads: different contexts are independent. One context, and objects while they are made with
 * it, belong to one thread at a time; a library, document or result may be read by any number of
 * threads, each generating with a context of its own. Options belong to one thread while they are
 * set.
 *
 * Strings are UTF-8 and NUL-terminated; lengths are given where a text may be large. The library
 * prints nothing, reads no environment variable, changes no locale and opens no file but through
 * the resolver.
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
 * Structs begin with their size, by which they can grow: `mxg_variable variable =
 * MXG_INIT(mxg_variable);`. All else of it is 0: of what the caller describes that is the default.
 */
// clang-format off
#ifdef __cplusplus
#define MXG_INIT(type) [] { type sized = type(); sized.size = sizeof sized; return sized; }()
#else
#define MXG_INIT(type) {.size = sizeof(type)}
#endif
// clang-format on

/* ---- Version ---- */

/* major: incompatible; minor: additions; patch: neither. The soname carries the major. */
#define MXG_VERSION_MAJOR 0
#define MXG_VERSION_MINOR 1
#define MXG_VERSION_PATCH 0

/*
 * The version of the library at run time, as major * 1000000 + minor * 1000 + patch, and as text
 * "0.1.0".
 */
MXG_API uint32_t mxg_version(void);
MXG_API const char *mxg_version_string(void);

/* ---- Status ---- */

typedef enum mxg_status {
    MXG_OK = 0,
    MXG_ERROR_DOCUMENT = 1, /* the document, library or request has errors: read the diagnostics */
    /* NULL where an object must be, an index out of range, a struct of unknown size */
    MXG_ERROR_ARGUMENT = 2,
    MXG_ERROR_MEMORY = 3,    /* the allocator failed, or the context's memory limit was reached */
    MXG_ERROR_CANCELLED = 4, /* the cancel callback said so */
    MXG_ERROR_INTERNAL = 5,  /* a bug of mxgen */
    MXG_STATUS_MAX_ENUM = 0x7fffffff
} mxg_status;

MXG_API const char *mxg_status_string(mxg_status status);

typedef struct mxg_context mxg_context;
typedef struct mxg_library mxg_library;
typedef struct mxg_document mxg_document;
typedef struct mxg_options mxg_options;
typedef struct mxg_result mxg_result;

/* ---- Context ---- */

/*
 * As realloc, told both sizes; new_size 0 frees. NULL for a size above 0 is a failure, which the
 * current call reports as MXG_ERROR_MEMORY. Called on every thread that uses the context or an
 * object made with it, perhaps on several at once: some texts are made when they are asked for
 * first, and whoever gives up the last reference frees. It must not call mxgen.
 */
typedef void *(*mxg_realloc_fn)(void *user_data, void *block, size_t old_size, size_t new_size);

/* A file's bytes, borrowed from the host between open and release. */
typedef struct mxg_blob {
    /* canonical name: what messages show and what includes in it are relative to */
    const char *name;
    const char *data;
    size_t size;
    void *handle; /* the host's own */
} mxg_blob;

/*
 * How files are found. `from` is the canonical name of the referring file, "" for a file named by
 * the caller. *out_blob is zeroed before; without a name the file keeps `ref`. On failure open
 * returns false, may point *out_reason at a text that lives until the next call, and sets
 * out_blob->name where the file is there but cannot be read: "file-unreadable" instead of
 * "file-missing". release is called once for each successful open, before the call of mxgen
 * returns.
 */
typedef struct mxg_resolver {
    void *user_data;
    bool (*open)(void *user_data, const char *from, const char *ref, mxg_blob *out_blob,
                 const char **out_reason);
    void (*release)(void *user_data, mxg_blob *blob);
    /*
     * The names in a folder of textures, which `folder` names as `ref` names a file ("" is that of
     * `from`): each with its NUL behind it, into `names`. Returns the bytes that all names need, 0
     * for no such folder; where that is more than `capacity`, nothing is read and it is called
     * again. NULL: the tiles of images (<UDIM>) are those that the document lists.
     */
    size_t (*list_folder)(void *user_data, const char *from, const char *folder, char *names,
                          size_t capacity);
} mxg_resolver;

typedef struct mxg_context_desc {
    size_t size;            /* sizeof(mxg_context_desc) */
    mxg_realloc_fn realloc; /* NULL: the C library's */
    void *realloc_user_data;
    /* copied; NULL: files relative to the referring file, then to the working directory */
    const mxg_resolver *resolver;
    /* asked now and then by mxg_generate and mxg_inspect; true stops them. NULL: never */
    bool (*cancel)(void *user_data);
    void *cancel_user_data;
    /* bytes of the context, its objects and the files it reads without a resolver; 0 = unlimited */
    size_t max_memory;
    uint32_t max_file_mib;      /* 0 = 256 */
    uint32_t max_elements;      /* 0 = 16,000,000 */
    uint32_t max_nodes;         /* IR operations of a generation; 0 = 64,000,000 */
    uint32_t max_output_mib;    /* 0 = 256 */
    uint32_t max_errors;        /* errors kept per call, with what belongs to them; 0 = 20 */
    uint32_t max_depth;         /* of elements in elements, up to 200; 0 = 128 */
    uint32_t max_include_depth; /* of files in files, up to 200; 0 = 16 */
    uint32_t max_includes;      /* files that a document includes; 0 = 4,096 */
    /*
     * Which warnings are told and which are errors, by words separated by commas: "error" for all,
     * "error=ID", "no-error=ID", "no-ID", "ID" (of something that is only a note otherwise). NULL:
     * as they are. A word that is none of these is MXG_ERROR_ARGUMENT.
     */
    const char *warnings;
    /*
     * Source that documents bring (libraries may bring any). Without either: portable source, which
     * mxgen reads and writes anew; source for one target is refused, since what is not portable of
     * it would be passed on as it is. trust: all. sandbox without trust: none.
     */
    bool trust;
    /*
     * Without a resolver: files that documents refer to must lie in or below the folder of a file
     * that the caller named, or one of the include roots.
     */
    bool sandbox;
    const char *const *include_roots; /* folders; num_include_roots of them */
    size_t num_include_roots;
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
    const char *id;                /* "type-mismatch": stable */
    const char *message;           /* one line, no location inside */
    const char *file;              /* NULL: none */
    uint32_t line, column, length; /* from 1, columns in code points; 0 = unknown */
    uint32_t parent;               /* for a note: index of its message; else the own index */
} mxg_diagnostic;

/*
 * Diagnostics of whatever can have them; each list is in order of discovery, notes behind their
 * message.
 */
typedef struct mxg_diagnostics mxg_diagnostics;
MXG_API uint32_t mxg_diagnostics_count(const mxg_diagnostics *list);
/* how many errors, those not kept included */
MXG_API uint32_t mxg_diagnostics_errors(const mxg_diagnostics *list);
MXG_API uint32_t mxg_diagnostics_warnings(const mxg_diagnostics *list);
MXG_API mxg_status mxg_diagnostics_get(const mxg_diagnostics *list, uint32_t index,
                                       mxg_diagnostic *out);
/*
 * Renders one as compilers do, with the source line and a caret where `source` (may be NULL) holds
 * the file's text. Writes at most `capacity` bytes with a NUL; returns the length it needs without
 * the NUL, 0 where there is none or no memory.
 */
MXG_API size_t mxg_diagnostics_format(const mxg_diagnostics *list, uint32_t index,
                                      const char *source, size_t source_size, bool colour,
                                      char *buffer, size_t capacity);
/* The same where the source line is at hand, without its end; NULL: unknown. */
MXG_API size_t mxg_diagnostics_format_line(const mxg_diagnostics *list, uint32_t index,
                                           const char *line, size_t line_size, bool colour,
                                           char *buffer, size_t capacity);

/* Everything that can be said, for lists and help: `mxgen explain`. Static. */
typedef struct mxg_diagnostic_kind {
    size_t size;           /* in: sizeof(mxg_diagnostic_kind) */
    const char *id;        /* "type-mismatch": stable */
    mxg_severity severity; /* unless the context's `warnings` say otherwise */
    const char *message;   /* with %s and %u where something is put in */
    const char *cause, *cure;
    /*
     * An example as a difference: lines that begin with "- " make it wrong, with "+ " right, with "
     * " are of both; "== NAME" begins another file than example.mtlx; "$ ", "-$ ", "+$ " are the
     * arguments of mxgen, where these matter. "": there is none.
     */
    const char *example;
} mxg_diagnostic_kind;
MXG_API uint32_t mxg_num_diagnostic_kinds(void);
MXG_API mxg_status mxg_get_diagnostic_kind(uint32_t index, mxg_diagnostic_kind *out);

MXG_API const mxg_diagnostics *mxg_library_diagnostics(const mxg_library *library);
MXG_API const mxg_diagnostics *mxg_document_diagnostics(const mxg_document *document);
MXG_API const mxg_diagnostics *mxg_result_diagnostics(const mxg_result *result);

/* ---- Library ---- */

/* The library that is built in, with a reference for the caller. */
MXG_API mxg_library *mxg_library_builtin(mxg_context *context);

/*
 * A library of `base` (may be NULL: an empty one) and the given files, folders (every .mtlx below)
 * or library images (.mxlib). Where a definition stands in both, the new one wins. An image stands
 * on no base, and is the first of the paths. *out_library is set even with MXG_ERROR_DOCUMENT, for
 * its diagnostics. Folders are those of the file system; what lies in them is read through the
 * resolver.
 */
MXG_API mxg_status mxg_library_load(mxg_context *context, mxg_library *base,
                                    const char *const *paths, size_t num_paths,
                                    mxg_library **out_library);
MXG_API mxg_library *mxg_library_ref(mxg_library *library); /* atomic; returns its argument */
MXG_API void mxg_library_unref(mxg_library *library);

/*
 * Files that were read for it and for what it stands on: for depfiles and watchers. The built-in
 * library has none.
 */
MXG_API uint32_t mxg_library_num_files(const mxg_library *library);
MXG_API const char *mxg_library_file(const mxg_library *library, uint32_t index);

/*
 * The library image, for mxg_library_load and for embedding; it lives as long as the library. Only
 * of libraries on no base.
 */
MXG_API mxg_status mxg_library_image(mxg_library *library, const void **out_data, size_t *out_size);
/* The library as a plain MaterialX document: templates expanded. */
MXG_API mxg_status mxg_library_expand(mxg_library *library, const char **out_text,
                                      size_t *out_size);

typedef struct mxg_nodedef {
    size_t size;                                            /* in */
    const char *name, *node, *version, *group, *doc, *file; /* "" where absent */
    uint32_t num_inputs, num_outputs;
    bool has_implementation; /* for some target */
    bool is_default_version; /* what a node without a version means */
} mxg_nodedef;

typedef struct mxg_port {
    size_t size; /* in */
    /* "" where absent */
    const char *name, *type, *value, *defaultgeomprop, *enum_names, *unit, *doc;
    bool uniform;
    bool advanced; /* uiadvanced */
    /* "" where absent */
    const char *enum_values, *unittype, *uiname, *uifolder, *uimin, *uimax, *uisoftmin, *uisoftmax,
        *uistep;
} mxg_port;

/* those of its base included */
MXG_API uint32_t mxg_library_num_nodedefs(const mxg_library *library);
MXG_API mxg_status mxg_library_nodedef(const mxg_library *library, uint32_t index,
                                       mxg_nodedef *out);
/* Port `index` of a definition: inputs first, then outputs. */
MXG_API mxg_status mxg_library_port(const mxg_library *library, uint32_t nodedef, uint32_t index,
                                    mxg_port *out);
/* Whether the definition has an implementation that the target (by name) can use. */
MXG_API bool mxg_library_supports(const mxg_library *library, uint32_t nodedef, const char *target);

/* ---- Document ---- */

/*
 * Loads and resolves a file. *out_document is set whenever memory allows, also with
 * MXG_ERROR_DOCUMENT: errors of one part, such as an include that is not there, leave the
 * renderables of the others; what is no XML has none.
 */
MXG_API mxg_status mxg_document_load(mxg_context *context, mxg_library *library, const char *path,
                                     mxg_document **out_document);
/* The same from memory; `name` is for messages and as the base of includes. */
MXG_API mxg_status mxg_document_parse(mxg_context *context, mxg_library *library, const char *name,
                                      const char *data, size_t size, mxg_document **out_document);
MXG_API void mxg_document_destroy(mxg_document *document);

/* Files that were read, the document itself first: for depfiles and watchers. */
MXG_API uint32_t mxg_document_num_files(const mxg_document *document);
MXG_API const char *mxg_document_file(const mxg_document *document, uint32_t index);

/*
 * Elements that can be generated: materials; without any, outputs of graphs and shaders that
 * nothing uses. In document order.
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
 * Those that a look, or a group of looks, assigns; MXG_ERROR_ARGUMENT behind the last, and where
 * `look` is the path of anything else.
 */
MXG_API mxg_status mxg_document_look_material(const mxg_document *document, const char *look,
                                              uint32_t index, mxg_renderable *out);

/*
 * Checks the whole document against its library without generating: every node, connection and
 * value.
 */
MXG_API mxg_status mxg_document_validate(mxg_context *context, const mxg_document *document,
                                         mxg_result **out_result);

/* ---- Targets and options ---- */

typedef struct mxg_target {
    size_t size; /* in */
    const char *name, *materialx_name, *brief;
    /*
     * file endings of vertex and pixel stage (OSL: of displacement and shader); NULL: no such stage
     */
    const char *stage_suffix[2];
} mxg_target;
MXG_API uint32_t mxg_num_targets(void);
MXG_API mxg_status mxg_get_target(uint32_t index, mxg_target *out);

typedef enum mxg_option_type {
    MXG_OPTION_BOOL,
    MXG_OPTION_INT,
    MXG_OPTION_STRING,
    MXG_OPTION_ENUM,
    MXG_OPTION_LIST,
    MXG_OPTION_MAX_ENUM = 0x7fffffff
} mxg_option_type;
typedef struct mxg_option {
    size_t size;     /* in */
    const char *key; /* "interface" */
    mxg_option_type type;
    const char *values;  /* ENUM: "complete|authored|reduced"; INT: "0..1024" */
    const char *initial; /* the default, as text */
    const char *doc;
} mxg_option;
/*
 * Every option of generation: hosts build their interface, and the command line its flags, from it.
 */
MXG_API uint32_t mxg_num_options(void);
MXG_API mxg_status mxg_get_option(uint32_t index, mxg_option *out);

MXG_API mxg_status mxg_options_create(mxg_context *context, mxg_options **out_options);
MXG_API void mxg_options_destroy(mxg_options *options);
/*
 * Sets an option by key from text ("true", "16", "reduced"); lists append. MXG_ERROR_ARGUMENT for
 * an unknown key or a bad value; mxg_options_error then says what is wrong.
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
    const char *target; /* name of a target: "glsl" */
    /*
     * Path of what to generate: a material, shader, node or output, "Gold" or "NG_marble1/out"; an
     * output of a node, "split/outr"; a graph with one output, or a look with one material. NULL:
     * the document's first renderable.
     */
    const char *element;
    const mxg_options *options; /* NULL: defaults */
    /*
     * Everything but the source: diagnostics, variables, the topology by which a host finds a
     * program that it has already. A third cheaper. Nothing but the limit max_output_mib can be
     * violated by writing the source. Networks of OSL have their layers all the same.
     */
    bool without_source;
    /*
     * Only whether it can be generated: diagnostics, and files beside the document. There is no
     * source, no variable and no info; what is left to do then cannot fail. A third of the time.
     */
    bool only_diagnostics;
} mxg_generate_desc;
#define MXG_GENERATE_DESC_INIT MXG_INIT(mxg_generate_desc)

/*
 * *out_result is set whenever memory allows. With MXG_ERROR_DOCUMENT it has diagnostics and no
 * source.
 */
MXG_API mxg_status mxg_generate(mxg_context *context, const mxg_document *document,
                                const mxg_generate_desc *desc, mxg_result **out_result);
MXG_API void mxg_result_destroy(mxg_result *result);

/*
 * The source of a stage; NULL where there is none: of a vertex stage of OSL where nothing is
 * displaced.
 */
MXG_API const char *mxg_result_source(const mxg_result *result, mxg_stage stage, size_t *out_size);
/*
 * With the option `osl-network` the sources above are lists of layers, values and connections, as
 * OSL's ShaderGroupBegin takes them, and these are the shaders of the layers: a file each,
 * "<name>.osl". Shaders of one name are equal, whatever the element.
 */
typedef struct mxg_part {
    size_t size;      /* in */
    const char *name; /* "ND_dielectric_bsdf_scatter_mode_T" */
    const char *source;
    size_t source_size;
    const char *nodedef; /* "ND_dielectric_bsdf"; "" of the shader that ends a group */
} mxg_part;
MXG_API uint32_t mxg_result_num_parts(const mxg_result *result);
MXG_API mxg_status mxg_result_part(const mxg_result *result, uint32_t index, mxg_part *out);

/* The place in the document that a line (from 1) of a stage's source comes from; false: none. */
MXG_API bool mxg_result_source_place(const mxg_result *result, mxg_stage stage, uint32_t line,
                                     const char **out_file, uint32_t *out_line,
                                     uint32_t *out_column, const char **out_path);

/*
 * The path of the node that a line was written for, also of one inside of a definition:
 * "SR_gold/coat_bsdf". Writes at most `capacity` bytes with a NUL; returns the length it needs
 * without the NUL, 0 where there is none or no memory.
 */
MXG_API size_t mxg_result_source_path(const mxg_result *result, mxg_stage stage, uint32_t line,
                                      char *buffer, size_t capacity);

/*
 * The path of the node that closure `index` was evaluated for, in the same way; there are
 * num_closures of mxg_shader_info.
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
    MXG_NUM_BLOCKS,
    MXG_BLOCK_MAX_ENUM = 0x7fffffff
} mxg_block;

typedef struct mxg_variable {
    size_t size;      /* in */
    const char *name; /* as in the source; members of blocks without the block's name */
    mxg_block block;
    uint32_t stages;           /* bit s: stage s reads it */
    const char *type;          /* in the shading language's terms: "vec3", "sampler2D" */
    const char *document_type; /* "color3"; "" for private variables */
    const char *path;          /* "SR_gold/base_color"; "" for private variables */
    const char *semantic;      /* "worldMatrix", "geomprop:st"; "" for public ones */
    const char *colorspace, *unit;
    uint32_t array_length; /* 0: not an array */
    uint32_t set, binding, location;
    uint32_t offset, byte_size, array_stride, matrix_stride; /* std140 */
    uint32_t num_values; /* components of the default; 0: none */
    float values[16];    /* integers and booleans as numbers */
    /* textures */
    const char *file, *uaddressmode, *vaddressmode, *filtertype;
    /* user interface, from the definition: "" where absent */
    const char *uiname, *uifolder, *uimin, *uimax, *uisoftmin, *uisoftmax, *doc;
    /*
     * textures: the layer of the file, by name; the frames of a sequence; the tiles of an image,
     * whose files are layers of an array
     */
    const char *layer, *framerange, *frameendaction;
    int32_t frameoffset;
    uint32_t num_tiles;
    const char *unittype;
    /* user interface; names and values are separated by commas */
    const char *uistep, *enum_names, *enum_values;
    bool advanced; /* uiadvanced */
    bool flat;     /* not interpolated between vertices */
} mxg_variable;
MXG_API uint32_t mxg_result_num_variables(const mxg_result *result);
MXG_API mxg_status mxg_result_variable(const mxg_result *result, uint32_t index, mxg_variable *out);
/*
 * A tile of a texture: what texture coordinates from (u, v) to (u + 1, v + 1) show, and which is
 * layer `tile` of the array.
 */
typedef struct mxg_tile {
    size_t size; /* in */
    const char *file;
    int32_t u, v;
} mxg_tile;
MXG_API mxg_status mxg_result_tile(const mxg_result *result, uint32_t variable, uint32_t tile,
                                   mxg_tile *out);
/*
 * The file of a texture, or of a tile of it, at a frame: {frame} and {04frame} replaced, with the
 * offset, range and end action that the document gives. Writes as much as fits and a NUL; returns
 * the length, 0 where there is no file for the frame: the default is shown.
 */
MXG_API size_t mxg_result_texture_file(const mxg_result *result, uint32_t variable, uint32_t tile,
                                       int32_t frame, char *out, size_t capacity);

/* Index of the variable of a document path; false: there is none (unused, or compiled in). */
MXG_API bool mxg_result_find_variable(const mxg_result *result, const char *path,
                                      uint32_t *out_index);

/* Inputs whose value is compiled in: changing one needs a new generation. */
typedef struct mxg_compiled_input {
    size_t size; /* in */
    const char *path, *type, *value;
} mxg_compiled_input;
MXG_API uint32_t mxg_result_num_compiled_inputs(const mxg_result *result);
MXG_API mxg_status mxg_result_compiled_input(const mxg_result *result, uint32_t index,
                                             mxg_compiled_input *out);

/*
 * How a host draws what a shader gives: as it is; with a depth test alone, since pixels below
 * u_alphaThreshold are discarded and the others have alpha 1; or blended over what is behind, in
 * order. Colours are premultiplied.
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
     * equal for shaders that differ in names and uniform values alone; made when `size` reaches
     * this far
     */
    uint64_t topology;
    uint32_t num_closures, num_textures, num_lights;
    bool transparent, lit;
    bool displaced; /* the vertex stage moves the surface: give it small triangles */
    mxg_alpha alpha;
} mxg_shader_info;
MXG_API mxg_status mxg_result_info(const mxg_result *result, mxg_shader_info *out);

/* All of the above as JSON (docs/reflection.md). NULL without a shader or without memory. */
MXG_API const char *mxg_result_reflection_json(const mxg_result *result, size_t *out_size);

/* ---- Looking inside ---- */

typedef enum mxg_view {
    MXG_VIEW_ELEMENTS, /* the element tree and what can be rendered */
    MXG_VIEW_GRAPH,    /* nodes and connections as text */
    MXG_VIEW_DOT,      /* the same for Graphviz */
    MXG_VIEW_IR,       /* the optimised IR, parseable (docs/ir.md) */
    MXG_VIEW_CLOSURES, /* leaves with weights */
    MXG_VIEW_STATISTICS,
    MXG_VIEW_MAX_ENUM = 0x7fffffff
} mxg_view;
/*
 * A text for people; *out_result holds it as mxg_result_text. desc says element, target and options
 * where the view needs them.
 */
MXG_API mxg_status mxg_inspect(mxg_context *context, const mxg_document *document, mxg_view view,
                               const mxg_generate_desc *desc, mxg_result **out_result);
MXG_API const char *mxg_result_text(const mxg_result *result, size_t *out_size);

#ifdef __cplusplus
}
#endif

#endif
