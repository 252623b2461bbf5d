// SPDX-License-Identifier: Apache-2.0
/*
 * What the files of the api room share: the objects behind mxgen.h.
 *
 * Every object has memory of its own, because the last reference to it may go on any thread. Work
 * on an object runs inside object_run, which is where running out of memory ends (base/mem.h); when
 * the work is done the object does not change any more, but for texts that are made when they are
 * first asked for, and what nodes of a document were found to match.
 */
#ifndef MXG_API_API_H
#define MXG_API_API_H

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

struct made_text { /* a text that stands in a block of its own */
    struct mem mem;
    struct arena arena;
    const char *data;
    size_t size;
};

enum { OBJECT_MAX_TEXTS = 2 };

struct object {
    struct mxg_context *context;
    /* what it stands on and keeps alive: the library of a document, the document of a result */
    struct object *below;
    atomic_uint refs;
    size_t size;    /* of the block that begins here */
    size_t counted; /* bytes that the context counts for it */
    struct mem mem;
    struct arena arena; /* everything it holds */
    struct mxg_diagnostics diagnostics;
    _Atomic(struct made_text *) texts[OBJECT_MAX_TEXTS];
};

/*
 * A zeroed block of `size` bytes that begins with a struct object; it holds a reference of `below`,
 * which may be NULL. NULL: no memory.
 */
void *object_new(struct mxg_context *context, size_t size, struct object *below);
void object_init(struct object *object, struct mxg_context *context, size_t size);
void object_ref(struct object *object);
void object_unref(struct object *object); /* NULL is allowed */
/* frees all that it holds but the block: of an object that stands in another's */
void object_empty(struct object *object);

/*
 * Tells the context what the object holds now, and the object what of the context's limit is left
 * to it.
 */
void object_settle(struct object *object);

/* Runs work(arg) with the object's trap set: MXG_OK, or MXG_ERROR_MEMORY when it ran out. */
mxg_status object_run(struct object *object, void (*work)(void *arg), void *arg);

/*
 * Runs work(arg, scratch) with memory of its own, which is freed behind it: MXG_OK, or
 * MXG_ERROR_MEMORY when it ran out.
 */
mxg_status context_run(struct mxg_context *context, void (*work)(void *arg, struct arena *scratch),
                       void *arg);

/*
 * Text `index` of the object, written by `write` when it is asked for first; any thread may ask.
 * NULL: no memory.
 */
const struct made_text *object_text(const struct object *object, unsigned index,
                                    void (*write)(const struct object *object, struct text *out));

/* MXG_OK or, where errors were reported, MXG_ERROR_DOCUMENT. */
static inline mxg_status object_status(const struct object *object)
{
    return object->diagnostics.list.num_errors ? MXG_ERROR_DOCUMENT : MXG_OK;
}

/* ---- Structs of the interface: structs.c ---- */

/*
 * Copies a struct that the caller filled; false where it is of no known size, or sets what this
 * version does not know.
 */
bool struct_read(void *out, size_t out_size, const void *in);
/*
 * Copies `from` as far as the caller's struct reaches and zeroes what lies beyond; both begin with
 * their size.
 */
mxg_status struct_write(void *out, const void *from, size_t from_size);

/* ---- The objects ---- */

struct mxg_library {
    struct object object;
    struct library layer;
    const void *image; /* the bytes that the layer was mapped from; NULL: it was read from files */
    size_t image_size;
    VEC(const char *) files; /* that it was read from */
};

struct mxg_context {
    struct mem mem;     /* of this block; every object has the same allocator */
    atomic_size_t used; /* bytes of the objects made with it */
    size_t max_memory;  /* 0 = unlimited */
    mxg_resolver resolver;
    bool (*cancel)(void *user_data);
    void *cancel_user_data;
    struct xml_limits xml_limits;
    uint32_t max_nodes, max_output_mib, max_errors;
    struct diag_policy policy;
    bool sandbox;
    enum library_trust trust;   /* in the source that documents bring */
    struct sandbox_root *roots; /* canonical */
    struct mxg_library builtin; /* size 0: this build has none */
};

struct mxg_document {
    struct object object;
    struct library layer; /* on its library's */
    VEC(const char *) files;
    VEC(elem_id) renderables;
    const char **renderable_paths;
};

/* ---- Files: files.c ---- */

/* The context's resolver as the readers of other rooms see it. */
struct file_source {
    struct object *object; /* for which files are read; holds their names */
    const mxg_resolver *resolver;
    struct arena scratch;    /* holds texts of sources */
    VEC(const char *) names; /* canonical, of what was read, each once */
    mxg_blob blob;
    bool is_open;    /* `blob` is to be released */
    uint64_t digest; /* of the bytes of all files, where it is not 0 at first */
};

void file_source_init(struct file_source *source, struct object *object);
void file_source_finish(struct file_source *source); /* also after a jump */
struct xml_files file_source_for_xml(struct file_source *source);
struct lang_reader file_source_for_lang(struct file_source *source);
/* The bytes of a file, which live until the object does; false after a diagnostic. */
bool file_source_read(struct file_source *source, const char *path, const char **out_data,
                      size_t *out_size, struct diag_list *diags);

/*
 * Files through stdio: what a context without resolver has. Its reason is stdio_no_memory itself
 * where that was the reason.
 */
mxg_resolver stdio_resolver(struct mxg_context *context);
extern const char stdio_no_memory[];

/*
 * sandbox.c: what the caller names opens its folder to what documents refer to. False: no memory.
 */
bool sandbox_admit_file(struct mxg_context *context, const char *file);
bool sandbox_admit_folder(struct mxg_context *context, const char *folder);
/* Why a file that a document refers to is not opened; NULL: it may be. */
const char *sandbox_fault(const struct mxg_context *context, const char *path);
void sandbox_finish(struct mxg_context *context);

/* folder.c: is the path a folder? And every file below it whose name ends with `suffix`, sorted. */
bool folder_exists(const char *path);
/*
 * The names in a folder, each with its NUL, and the bytes that all need; those that do not fit are
 * left out. NULL, or why not.
 */
const char *folder_names(const char *folder, char *names, size_t capacity, size_t *out_size);
struct path_list {
    const char **items;
    uint32_t len, cap;
};
/* NULL, or why a folder could not be read. */
const char *folder_list(struct arena *arena, const char *path, const char *suffix,
                        struct path_list *out);

/* ---- Options: options.c, options.def ---- */

enum option_id {
#define OPTION(id, key, type, values, initial, doc) OPTION_##id,
#include "api/options.def"
#undef OPTION
    NUM_OPTIONS
};

struct option_value {
    int32_t number;   /* BOOL, INT; ENUM: index of the word */
    const char *text; /* STRING; ENUM: the word */
    VEC(const char *) list;
    bool is_set; /* not the default */
};

/* The defaults; they live in the arena. */
const struct option_value *options_default(struct arena *arena);
const struct option_value *options_values(const mxg_options *options);

/* ---- Elements: renderable.c, element.c ---- */

/* Finds what can be rendered. */
void document_find_renderables(struct mxg_document *document, struct arena *scratch);

/*
 * The node or <output> that a path means to generation: itself, the only output of a graph, the
 * material of a look. NULL: the first that can be rendered. 0 after a diagnostic. Which output of a
 * node it means: its name, empty where the path says none, and its index.
 */
elem_id document_find_element(const struct mxg_document *document, const char *path,
                              struct diag_list *diags, str_id *out_output, unsigned *out_index);

#endif
