// SPDX-License-Identifier: Apache-2.0
/*
 * Slots: several materials on one primitive of a scene (docs/slots.md of the project).
 */
#include <mxgen/mxgen.h>

#ifndef MXGEN_SCENE_H
#define MXGEN_SCENE_H

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Names of slots ---- */

/*
 * Slot names in USD: "050::010" is "_050:_:_010". Length 0: the input is no name.
 */
MXG_API size_t mxg_slot_encode(const char *name, char *buffer, size_t capacity);
MXG_API size_t mxg_slot_decode(const char *identifiers, char *buffer, size_t capacity);

/* ---- Scenes ---- */

/*
 * An empty scene, or the scene of a file: a list with one path in each line ('#' begins a comment),
 * or a USD text layer (.usda), which brings bindings of its own. `purpose` chooses among these:
 * "full", "preview", or NULL for those of all purposes.
 * *out_scene is set whenever memory allows, also with MXG_ERROR_DOCUMENT: it has the diagnostics.
 */
MXG_API mxg_status mxg_scene_create(mxg_context *context, mxg_scene **out_scene);
MXG_API mxg_status mxg_scene_load(mxg_context *context, const char *path, const char *purpose,
                                  mxg_scene **out_scene);
/*
 * The scene of a USD text layer that the host has, such as what UsdStage::ExportToString composes.
 * `name` appears in messages, and textures of its materials are found from there. The text is
 * copied.
 */
MXG_API mxg_status mxg_scene_parse(mxg_context *context, const char *name, const char *data,
                                   size_t size, const char *purpose, mxg_scene **out_scene);
MXG_API void mxg_scene_destroy(mxg_scene *scene);
/*
 * Adds primitives by their paths, "/set/table", and those above them. MXG_ERROR_DOCUMENT if a path
 * is none; the others are added. A change of a scene, also by the functions below, makes its
 * bindings say nothing any more (0, MXG_NONE, MXG_ERROR_ARGUMENT): call mxg_bindings_create
 * again, which needs little time with member `previous` of mxg_bindings_desc.
 */
MXG_API mxg_status mxg_scene_add_paths(mxg_scene *scene, const char *const *paths,
                                       size_t num_paths);

typedef struct mxg_primitive {
    size_t size; /* in */
    /* of mxg_scene_primitive; MXG_NONE: none */
    uint32_t parent, first_child, next_sibling;
    const char *name; /* name_len bytes, without a NUL */
    size_t name_len;
    const char *type; /* of USD or the host: "Mesh", type_len bytes; "": unknown */
    size_t type_len;
} mxg_primitive;

/*
 * Adds paths as mxg_scene_add_paths does, from a callback, which gives one primitive in each call
 * and returns false at the end: `parent` (MXG_NONE: none), `name`, which may be a path below the
 * parent, "b/c", and `type`; the texts live until the next call. `last` is the number of the
 * primitive before, also if the scene had it already; MXG_NONE: there is none, or it was faulty.
 * The callback must not use the scene.
 */
MXG_API mxg_status mxg_scene_add_primitives(mxg_scene *scene,
                                            bool (*next_primitive)(void *user_data, uint32_t last,
                                                                   mxg_primitive *out),
                                            void *user_data);
/*
 * Removes primitives, all below them, and their bindings. MXG_ERROR_ARGUMENT if a number is none of
 * a primitive: all stay.
 */
MXG_API mxg_status mxg_scene_remove_primitives(mxg_scene *scene, const uint32_t *primitives,
                                               size_t num_primitives);
/*
 * Primitives have numbers from 0 on, below this one; a parent has a lower one than its children.
 * The others keep theirs when some are removed, whose numbers say MXG_ERROR_ARGUMENT from then on.
 */
MXG_API uint32_t mxg_scene_num_primitives(const mxg_scene *scene);
MXG_API mxg_status mxg_scene_primitive(const mxg_scene *scene, uint32_t index, mxg_primitive *out);
/* The number of a primitive; MXG_NONE: there is none of this path. */
MXG_API uint32_t mxg_scene_find_primitive(const mxg_scene *scene, const char *path);
/* Length 0: there is no such primitive. */
MXG_API size_t mxg_scene_primitive_path(const mxg_scene *scene, uint32_t index, char *buffer,
                                        size_t capacity);

/* ---- Bindings of the scene itself ---- */

/*
 * Binds a material to a slot of a primitive, or a nodegraph or a material to an override; ""
 * removes what the primitive would inherit. It replaces the direct bindings of the slot there, also
 * those of a file. Primitive MXG_NONE is the whole scene. Bindings of a scene count as earlier
 * than those of a look. MXG_ERROR_DOCUMENT if the slot's name is none; mxg_bindings_create finds
 * the material.
 */
MXG_API mxg_status mxg_scene_set_binding(mxg_scene *scene, uint32_t primitive, const char *slot,
                                         const char *material);
/* Removes the direct bindings of a slot there; what the primitive inherits shows again. */
MXG_API mxg_status mxg_scene_remove_binding(mxg_scene *scene, uint32_t primitive, const char *slot);

typedef struct mxg_slot_binding {
    size_t size; /* in */
    const char *slot;
    const char *material; /* or the nodegraph; "": a removal */
    bool is_collection;   /* it is for the members of a collection */
    bool is_strong;       /* it beats the bindings of the scene below it */
    bool is_purpose;      /* it is for the purpose of mxg_scene_load */
    const char *file;     /* "": from mxg_scene_set_binding */
    uint32_t line;
} mxg_slot_binding;
/* The bindings that stand at a primitive (MXG_NONE: the whole scene). Texts live until a change.
 */
MXG_API uint32_t mxg_scene_num_bindings(const mxg_scene *scene, uint32_t primitive);
MXG_API mxg_status mxg_scene_binding(const mxg_scene *scene, uint32_t primitive, uint32_t index,
                                     mxg_slot_binding *out);

/* ---- Properties of USD ---- */

/* The primitives of a list have none. Texts are those of the file, and have no NUL. */
typedef struct mxg_property {
    size_t size; /* in */
    const char *name;
    size_t name_len;
    const char *type; /* "point3f[]"; "rel" of a relationship */
    size_t type_len;
    const char *interpolation; /* "faceVarying"; "": not said */
    size_t interpolation_len;
    const char *value; /* "[(0, 0, 0), (1, 0, 0)]", of time samples the first; "": none */
    size_t value_len;
    const char *file;
    uint32_t line, column;
} mxg_property;
/* An instance of a reference has the properties of its prototype that it does not set itself. */
MXG_API uint32_t mxg_scene_num_properties(const mxg_scene *scene, uint32_t primitive);
MXG_API mxg_status mxg_scene_property(const mxg_scene *scene, uint32_t primitive, uint32_t index,
                                      mxg_property *out);
/* MXG_NONE: the primitive has no property of this name. */
MXG_API uint32_t mxg_scene_find_property(const mxg_scene *scene, uint32_t primitive,
                                         const char *name);
/*
 * The numbers of a property in a row; true is 1. Writes at most `capacity` of them, and returns
 * how many there are.
 */
MXG_API size_t mxg_scene_property_numbers(const mxg_scene *scene, uint32_t primitive,
                                          const char *name, double *out, size_t capacity);
/*
 * Word `index` of a property: a string or token without quotes, or a path. Length 0: there
 * is none.
 */
MXG_API size_t mxg_scene_property_word(const mxg_scene *scene, uint32_t primitive, const char *name,
                                       uint32_t index, char *buffer, size_t capacity);
/*
 * The primitives that a relationship names in a row; MXG_NONE: the scene does not have it. Writes
 * at most `capacity` of them, and returns how many there are.
 */
MXG_API size_t mxg_scene_property_targets(const mxg_scene *scene, uint32_t primitive,
                                          const char *name, uint32_t *out, size_t capacity);
/* 'Y' or 'Z'. */
MXG_API char mxg_scene_up_axis(const mxg_scene *scene);
/* Metres in a unit of the scene; 0.01 if a file of USD does not say it, 0 of a list. */
MXG_API double mxg_scene_meters_per_unit(const mxg_scene *scene);

/*
 * A copy of a document with the materials of a stage of USD that it lacks, as nodes and nodegraphs.
 * A UsdShade network becomes a nodegraph for the patterns and nodes for the shaders; inputs of the
 * Material become the interface of the nodegraph. NULL as document: only these materials.
 * *out_document is set like that of mxg_document_parse.
 */
MXG_API mxg_status mxg_document_import(mxg_context *context, mxg_library *library,
                                       const mxg_document *document, const mxg_scene *scene,
                                       mxg_document **out_document);

/* ---- Bindings ---- */

typedef struct mxg_bindings_desc {
    size_t size;
    /*
     * a look, or a look group with a default; NULL: the only look, or just the bindings of the
     * scene if the document has no look
     */
    const char *look;
    /* names that alone count, with all that hangs on them; names that do not count */
    const char *const *solo, *const *mute;
    size_t num_solo, num_mute;
    /*
     * bindings of the same scene before it or the document changed; what they know is not found
     * again. The result is the same.
     */
    const mxg_bindings *previous;
} mxg_bindings_desc;
#define MXG_BINDINGS_DESC_INIT MXG_INIT(mxg_bindings_desc)

/*
 * Finds the layers of each primitive of a scene. Instances of a PointInstancer that the document
 * names, "/set/forest[12]", become primitives of the scene. desc may be NULL: all defaults.
 * *out_bindings is
 * set whenever memory allows; with MXG_ERROR_DOCUMENT the faulty assignments are missing.
 */
MXG_API mxg_status mxg_bindings_create(mxg_context *context, const mxg_document *document,
                                       mxg_scene *scene, const mxg_bindings_desc *desc,
                                       mxg_bindings **out_bindings);
MXG_API void mxg_bindings_destroy(mxg_bindings *bindings);
/*
 * The number of primitives whose assignments were found: all, or with `previous` those at or below
 * a new primitive or a place where an assignment or a collection stands that was not there. A
 * removed assignment, or another material, needs none.
 */
MXG_API uint32_t mxg_bindings_num_resolved_primitives(const mxg_bindings *bindings);

typedef enum mxg_layer_kind {
    MXG_LAYER,          /* a slot; the base comes first */
    MXG_LAYER_PRODUCT,  /* a product that the layer before takes from a weaker assignment */
    MXG_LAYER_OVERRIDE, /* of the layer before; a later one wins */
    MXG_LAYER_VERTICAL, /* over the MXG_LAYER before */
    MXG_LAYER_VOLUME,   /* beside the stack */
    MXG_LAYER_LIGHT,
    MXG_LAYER_MAX_ENUM = 0x7fffffff
} mxg_layer_kind;

typedef struct mxg_layer {
    size_t size; /* in */
    mxg_layer_kind kind;
    const char *slot;     /* the whole name: "050::010" */
    const char *material; /* the material, or the nodegraph if is_nodegraph */
    bool is_nodegraph;
    const char *product;       /* MXG_LAYER_PRODUCT: "mask"; else "" */
    uint32_t from;             /* the primitive where the assignment stands; MXG_NONE: "/" */
    const char *look, *assign; /* the assignment ("" if it has no name), or the scene's property */
    const char *file;          /* of the assignment */
    uint32_t line;
} mxg_layer;
/* The layers of a primitive, base first; a product, override or vertical layer follows its layer.
 */
MXG_API uint32_t mxg_bindings_num_layers(const mxg_bindings *bindings, uint32_t primitive);
MXG_API mxg_status mxg_bindings_layer(const mxg_bindings *bindings, uint32_t primitive,
                                      uint32_t index, mxg_layer *out);
/*
 * Primitives with equal layers have the same stack. MXG_NONE: there is no such primitive, or it is
 * a group of a stage, and nothing that is drawn has its layers.
 */
MXG_API uint32_t mxg_bindings_num_stacks(const mxg_bindings *bindings);
MXG_API uint32_t mxg_bindings_stack(const mxg_bindings *bindings, uint32_t primitive);
/*
 * The name of a stack, which follows from its content: "stack_8a5f7a0f9c2f6f0e".
 * mxg_generate makes its shader: members `bindings` and `stack` of
 * mxg_generate_desc. Stacks whose shaders have one topology can share a program.
 */
MXG_API size_t mxg_bindings_stack_name(const mxg_bindings *bindings, uint32_t stack, char *buffer,
                                       size_t capacity);

typedef enum mxg_fact_kind {
    MXG_FACT_GEOMPROP,   /* a geometric property, of a <geominfo> */
    MXG_FACT_TOKEN,      /* a token for file names, of a <geominfo>, or a <tokendefault> */
    MXG_FACT_PROPERTY,   /* of a <propertyassign> or a <propertysetassign> */
    MXG_FACT_VISIBILITY, /* the name is the vistype, "" for all; the value "true" or "false" */
    MXG_FACT_MAX_ENUM = 0x7fffffff
} mxg_fact_kind;

/* A fact that the document states about a primitive beside its layers. */
typedef struct mxg_fact {
    size_t size; /* in */
    mxg_fact_kind kind;
    /* as in the document; a geometric property in the unit of its <geompropdef>, or in lin_rec709
     */
    const char *name, *type, *value;
    /*
     * the renderer that a property is for; the geometry that sees a visibility, paths or
     * "collection:NAME"; "": all
     */
    const char *target;
    uint32_t from; /* the primitive where it stands; MXG_NONE: "/" */
    const char *file;
    uint32_t line;
} mxg_fact;
/* The strongest of each kind, name and target, found as the layers are. */
MXG_API uint32_t mxg_bindings_num_facts(const mxg_bindings *bindings, uint32_t primitive);
MXG_API mxg_status mxg_bindings_fact(const mxg_bindings *bindings, uint32_t primitive,
                                     uint32_t index, mxg_fact *out);

typedef enum mxg_bindings_format {
    MXG_BINDINGS_TABLE, /* a line for each primitive */
    MXG_BINDINGS_TABLE_COLOUR,
    MXG_BINDINGS_JSON,
    /* a layer over the stage with slot bindings; MXG_ERROR_DOCUMENT after all is written: some are
     * lost */
    MXG_BINDINGS_USDA,
    MXG_BINDINGS_FORMAT_MAX_ENUM = 0x7fffffff
} mxg_bindings_format;
/* Writes all bindings as text, in pieces. Stops when `write` returns false. */
MXG_API mxg_status mxg_bindings_write(const mxg_bindings *bindings, mxg_bindings_format format,
                                      bool (*write)(void *user_data, const char *data, size_t size),
                                      void *user_data);
/* Writes the reasons of one primitive's layers: every assignment that was considered. */
MXG_API mxg_status mxg_bindings_write_reasons(const mxg_bindings *bindings, uint32_t primitive,
                                              bool (*write)(void *user_data, const char *data,
                                                            size_t size),
                                              void *user_data);

#ifdef __cplusplus
}
#endif

#endif
