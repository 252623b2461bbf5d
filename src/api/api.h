// SPDX-License-Identifier: Apache-2.0
/*
 * Declarations that the files of the api room share: the objects behind the public headers.
 *
 * Every object owns its memory, because any thread may drop the last reference. Work on an object
 * runs inside object_run, which catches a lack of memory (base/mem.h). Afterwards the object is
 * immutable, except for texts that their first use writes.
 */
#ifndef MXG_API_API_H
#define MXG_API_API_H

#include "base/structs.h"
#include "build/build.h"
#include "spell/target.h"
#include "xml/reader.h"

#include <mxgen/mxgen.h>

#include <stdatomic.h>

/* ---- Objects: object.c ---- */

struct mxg_diagnostics {
    struct diag_list list;
    struct object *owner;
};

struct made_text { /* a text in its own block */
    struct mem mem;
    struct arena arena;
    const char *data;
    size_t size;
};

enum { OBJECT_MAX_TEXTS = 3 };

struct object {
    struct mxg_context *context;
    /*
     * the object that it refers to and keeps alive: for a document its library, for a result its
     * document
     */
    struct object *below;
    atomic_uint refs;
    size_t size;    /* size of this block */
    size_t counted; /* bytes that the context counts for this object */
    struct mem mem;
    struct arena arena; /* owns all its data */
    struct mxg_diagnostics diagnostics;
    _Atomic(struct made_text *) texts[OBJECT_MAX_TEXTS];
};

/*
 * A zeroed block of `size` bytes that begins with a struct object and holds a reference to `below`,
 * which may be NULL. NULL: out of memory.
 */
void *object_new(struct mxg_context *context, size_t size, struct object *below);
void object_init(struct object *object, struct mxg_context *context, size_t size);
void object_ref(struct object *object);
void object_unref(struct object *object); /* accepts NULL */
/* frees all data except the block; for an object embedded in another */
void object_empty(struct object *object);

/* Updates the memory use of the object in the context, and the remaining limit in the object. */
void object_settle(struct object *object);

/* Runs work(arg) with the trap of the object. Returns MXG_OK or MXG_ERROR_MEMORY. */
mxg_status object_run(struct object *object, void (*work)(void *arg), void *arg);

/*
 * Runs work(arg, scratch) with temporary memory, which it frees afterwards. Returns MXG_OK or
 * MXG_ERROR_MEMORY.
 */
mxg_status context_run(struct mxg_context *context, void (*work)(void *arg, struct arena *scratch),
                       void *arg);

/*
 * Text `index` of the object. The first call writes it with `write`; any thread may call. NULL: out
 * of memory.
 */
const struct made_text *object_text(const struct object *object, unsigned index,
                                    void (*write)(const struct object *object, struct text *out));

/* MXG_OK, or MXG_ERROR_DOCUMENT if the object has errors. */
static inline mxg_status object_status(const struct object *object)
{
    return object->diagnostics.list.num_errors ? MXG_ERROR_DOCUMENT : MXG_OK;
}

/* ---- The objects ---- */

struct mxg_library {
    struct object object;
    struct library layer;
    const void *image; /* the mapped library image; NULL for a layer from files */
    size_t image_size;
    VEC(const char *) files; /* names of the files that it was read from */
    /* its folders and those of its base: places of source files, with a '/' at the end */
    VEC(const char *) folders;
};

/* A target of a host. */
struct dialect {
    struct target target;
    const char *versions[16]; /* that of the host first */
    const char *const *options;
    size_t num_options;
};

struct mxg_context {
    struct mem mem;     /* for this block; all objects have the same allocator */
    atomic_size_t used; /* bytes of all objects of the context */
    size_t max_memory;  /* 0 = unlimited */
    mxg_resolver resolver;
    bool (*cancel)(void *user_data);
    void *cancel_user_data;
    mxg_texel_reader texels;
    struct xml_limits xml_limits;
    uint32_t max_nodes, max_output_mib, max_errors;
    struct diag_policy policy;
    bool sandbox;
    enum library_trust trust;   /* for verbatim source in documents */
    struct sandbox_root *roots; /* canonical */
    struct source_path *source_paths;
    mxg_node_code *codes; /* num_codes of them */
    uint32_t num_codes;
    struct dialect *dialects; /* num_dialects of them */
    uint32_t num_dialects, max_dialects;
    struct mxg_library builtin; /* size 0: this build has no built-in library */
};

/*
 * The renderables of a document in order: runs of those that were found in the document that stands
 * in one piece, and single ones.
 */
struct renderable_run {
    uint32_t start;   /* place of its first one in the list */
    uint32_t first;   /* index of its first one in `found` */
    elem_id element;  /* not 0: this one only */
    const char *path; /* of the single one; NULL: its name */
};

struct renderables {
    const elem_id *found;
    const char *const *paths; /* parallel to `found`; NULL: its name */
    VEC(struct renderable_run) runs;
    uint32_t num;
    bool are_materials; /* else outputs, and shaders without a user */
};

struct mxg_document {
    struct object object;
    struct library layer; /* above the library layers of its library */
    VEC(const char *) files;
    struct renderables renderables;
    /* the document whose elements and definitions this one shares; NULL: it has its own */
    const struct mxg_document *origin;
    bool is_silent; /* its definitions have nothing to report, so that another may share them */
};

/* Why a description makes no context. */
struct refusal {
    char text[512]; /* "": unknown */
};
/* context.c: true if none of the texts is NULL. */
bool context_has_texts(const char *const *texts, size_t num_texts);
/* context.c: writes the reason. Returns MXG_ERROR_ARGUMENT. */
mxg_status refuse(struct refusal *why, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* dialect.c: takes the targets of the description. */
mxg_status dialects_take(struct mxg_context *context, const mxg_context_desc *desc,
                         struct refusal *why);
void dialects_finish(struct mxg_context *context);
/* A target of mxgen, or of the host; NULL: unknown. */
const struct target *context_target(const struct mxg_context *context, const char *name);
/* The dialect that is a target; NULL: it is one of mxgen. */
const struct dialect *context_dialect(const struct mxg_context *context,
                                      const struct target *target);

/* target.c: true if mxgen or the context has the target of this MaterialX name. */
bool target_exists(const void *context, const char *materialx_name);

/*
 * codes.c: copies the nodes in C of the description. codes_finish also frees what a failure leaves.
 */
mxg_status codes_take(struct mxg_context *context, const mxg_context_desc *desc,
                      struct refusal *why);
void codes_finish(struct mxg_context *context);
/* True if code serves a definition for the target; NULL: for any. */
bool codes_serve(const struct mxg_context *context, const char *nodedef, const char *node,
                 const struct target *target);

/* ---- Files: open_file.c ---- */

/* The resolver of the context, as an interface for other rooms. */
struct file_source {
    struct object *object; /* the object that reads the files; owns their names */
    const mxg_resolver *resolver;
    struct arena scratch;    /* owns the texts of source files */
    VEC(const char *) names; /* canonical names of all files, each once */
    struct table table;      /* their indices + 1 */
    mxg_blob blob;
    bool is_open;              /* the source must release `blob` */
    uint64_t digest;           /* hash of the bytes of all files; 0 at the start: no hash */
    VEC(const char *) folders; /* of libraries, to search for source files */
};

/*
 * open_file.c: folders to search for source files, from the context's description. false: out of
 * memory.
 */
bool source_path_add(struct mxg_context *context, const char *folder);
void source_paths_finish(struct mxg_context *context);
/* The folder of a library, and its parent: libraries name files relative to both. */
void file_source_add_folder(struct file_source *source, const char *folder);

void file_source_init(struct file_source *source, struct object *object);
/* Adds a canonical name, if it is new; the object owns the copy that it returns. */
const char *file_source_remember(struct file_source *source, const char *name);
void file_source_finish(struct file_source *source); /* also call this after a jump out of memory */
struct xml_files file_source_for_xml(struct file_source *source);
struct lang_reader file_source_for_lang(struct file_source *source);
/*
 * Fills a buffer with the first bytes of a file that another one names; their number, 0 if it
 * cannot be read.
 */
size_t file_source_begin(struct file_source *source, const char *from, const char *ref,
                         unsigned char *buffer, size_t capacity);
/* The bytes of a file, valid as long as the object; false after a diagnostic. */
bool file_source_read(struct file_source *source, const char *path, const char **out_data,
                      size_t *out_size, struct diag_list *diags);

/*
 * The default resolver, which reads files with stdio. If a read runs out of memory, the reason is
 * stdio_no_memory.
 */
mxg_resolver stdio_resolver(struct mxg_context *context);
/*
 * build_options.texture_fault: with the default resolver a sandbox refuses textures outside,
 * whether they exist or not, also for hosts that read names as URLs. `context` is a struct
 * mxg_context.
 */
const char *stdio_texture_fault(void *context, const char *from, const char *file);
/* True if the context has this resolver. */
bool stdio_is_resolver(const struct mxg_context *context);
/* The first bytes of a file as the resolver finds it, without the rest; their number. */
size_t stdio_begin(struct mxg_context *context, const char *from, const char *ref,
                   unsigned char *buffer, size_t capacity);
extern const char stdio_no_memory[];

/*
 * sandbox.c: lets documents read files in the folder of a file that the caller names. false: out of
 * memory.
 */
bool sandbox_admit_file(struct mxg_context *context, const char *file);
bool sandbox_admit_folder(struct mxg_context *context, const char *folder);
/* The reason why a document may not read a file; NULL if it may. */
const char *sandbox_fault(const struct mxg_context *context, const char *path);
/* Why a sandbox refuses a document that the caller names: it is a link to a file outside. */
const char *sandbox_named_fault(const struct mxg_context *context, const char *path);
extern const char sandbox_outside[]; /* this reason for a file outside */
/* Judges a file that a host reads later, so it may be missing, or a pattern of names. */
const char *sandbox_texture_fault(const struct mxg_context *context, const char *path);
void sandbox_finish(struct mxg_context *context);

/*
 * library_folder.c: true if the path is a folder.
 */
bool folder_exists(const char *path);
struct path_list {
    const char **items;
    uint32_t len, cap;
};
/*
 * Appends the regular files below a folder whose names end with `suffix`, sorted. Follows links to
 * folders, and lists each folder once. Returns NULL, or the reason why a folder is unreadable.
 */
const char *folder_list(struct arena *arena, const char *path, const char *suffix,
                        struct path_list *out);

/* ---- Options: options.c, options.def ---- */

enum option_id {
#define OPTION(id, key, type, caps, task, values, initial, doc) OPTION_##id,
#include "api/options.def"
#undef OPTION
    NUM_OPTIONS
};

struct option_value {
    int32_t number;   /* BOOL, INT: the value; ENUM: index of the word */
    float real;       /* FLOAT: the value; below 0: not set */
    const char *text; /* STRING, FLOAT: the value; ENUM: the word */
    VEC(const char *) list;
    bool is_set; /* differs from the default */
};

/*
 * The values for a target, in the arena: the defaults, which a dialect may change, where `options`
 * is NULL or sets nothing, and of the options that do not apply to the target.
 */
struct option_value *options_for(const struct target *target, const mxg_options *options,
                                 struct arena *arena, const struct dialect *dialect);
/* Why an option cannot have the value for the target; NULL: it can. */
const char *option_fault(const struct target *target, const char *key, const char *value,
                         struct arena *arena);
const struct option_value *options_values(const mxg_options *options); /* as set */
const char *option_key(enum option_id option);                         /* "interface" */
enum role_task option_task(enum option_id option); /* that a role may leave to others */
/* Sets a value to the default. */
void option_reset(enum option_id option, struct arena *arena, struct option_value *value);
/* True if a value is not the default; of a list always. */
bool option_differs(enum option_id option, const struct option_value *value);
/* A hash of all values. */
uint64_t options_hash(const struct option_value *values);

/* ---- Definitions: library.c ---- */

/* mxg_library_nodedef and its neighbours, for the layer of a library or of a document. */
mxg_status definition_info(const struct mxg_context *context, const struct library *lib,
                           uint32_t index, mxg_nodedef *out);
mxg_status definition_port(const struct library *lib, uint32_t nodedef, uint32_t index,
                           mxg_port *out);
uint32_t definition_num_implementations(const struct library *lib, uint32_t nodedef);
mxg_status definition_implementation(const struct library *lib, uint32_t nodedef, uint32_t index,
                                     mxg_implementation *out);

/* ---- Documents: document.c ---- */

/* Gives the layer of a document the trust and the targets of its context. */
void document_follow_context(struct mxg_document *document);

/*
 * Indexes a document whose tree is complete, and finds its renderables. The document takes the
 * names of `files`.
 */
void document_finish(struct mxg_document *document, struct file_source *files);

/*
 * shared_origin.c: finishes an edited document that shares the definitions of its origin. false:
 * the definitions may differ, or too much does; nothing is done then.
 */
bool edit_share(struct mxg_document *document, struct arena *scratch, struct diag_list *diags);

/* ---- Elements: renderable.c, renderables.c, element_path.c ---- */

/* Finds the renderables of a document in one piece. */
void document_find_renderables(struct mxg_document *document);
/* True if an element belongs to the renderables of a document, with or without materials. */
bool renderable_is_listed(const struct document *doc, elem_id element, bool are_materials);
/* The path of a renderable, in the arena; NULL: it is its name. */
const char *renderable_new_path(const struct document *doc, elem_id element, struct arena *arena);
/* A renderable by its place in the list. */
elem_id renderable_at(const struct mxg_document *document, uint32_t index);
const char *renderable_path(const struct mxg_document *document, uint32_t index);
/* The document, which an edit begins, has the renderables of `from`. */
void renderables_begin(struct mxg_document *document, const struct mxg_document *from);
/*
 * Changes the renderables as the edit has changed the document. false: they may be others
 * altogether, because the first material came or the last one went.
 */
bool renderables_follow(struct mxg_document *document, struct arena *scratch);

/*
 * The node or <output> to generate for a path: the element, the only output of a nodegraph, or the
 * material of a look. NULL: the first renderable. 0 after a diagnostic. Also gives the output of a
 * node: its name (empty if the path has none) and index.
 */
elem_id document_find_element(const struct mxg_document *document, const char *path,
                              struct diag_list *diags, str_id *out_output, unsigned *out_index);

#endif
