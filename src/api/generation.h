// SPDX-License-Identifier: Apache-2.0
/*
 * A generation in steps, for mxg_generate, which takes all steps, and for inspect.c, which stops
 * after some.
 */
#ifndef MXG_API_GENERATION_H
#define MXG_API_GENERATION_H

#include "api/api.h"
#include "closure/closure.h"
#include "deferred/deferred.h"
#include "slabs/budget.h"

#include <assert.h>

/*
 * For comments and reflection. The patch number is missing because it does not affect the output.
 */
#define GENERATOR_NAME "mxgen 0.1"

struct stage_source {
    const char *text; /* NULL: the target has no such stage */
    size_t size;
    const struct spell_mark *marks;
    uint32_t num_marks;
    const uint32_t *lines; /* where each line begins */
    uint32_t num_lines;
};

void source_find_lines(struct stage_source *source, struct arena *arena); /* source_map.c */
/* source_map.c: the innermost element of the document itself that an origin comes from; 0: none. */
elem_id result_element_of(const mxg_result *result, uint32_t origin);

struct mxg_result {
    struct object object; /* keeps the document alive */
    const mxg_document *document;
    const struct target *target;
    struct strpool strings; /* a layer above the strings of the document */
    struct lang_unit unit;
    struct ir_graph graph;
    struct shader shader;
    struct stage_source stages[NUM_STAGES];
    struct network network;  /* option `network`: replaces `shader`; arena NULL: no network */
    VEC(const char *) files; /* files read during the generation */
    /* paths by origin of the graph; filled on demand during generation */
    const char **origin_paths;
    uint64_t options;               /* a hash of the options */
    str_id colorspace;              /* of the values that it computes with */
    struct deferred_layout storage; /* of a material that stores, and of a pass */
    enum deferred_pass pass;        /* of a role that is one */
    bool has_shader;                /* the generation succeeded */
    struct slab_report slabs;       /* of the generation */
    const char *text;               /* the text of mxg_inspect, or NULL */
    size_t text_size;
};

struct generation {
    mxg_result *result;
    const mxg_document *document;
    mxg_generate_desc desc;
    struct option_value *options;
    elem_id element;
    str_id output_name; /* output of a node from the path, with its index */
    unsigned output;
    struct builder *builder;
    struct build_options build_options;
    uint32_t slab_features_off; /* bits of enum slab_feature */
    struct closure_host closure_host;
    struct closure_point point;
    struct closure_lighting lighting;
    ir_ref root;
    const char *lacks; /* by what the target cannot have the closures; NULL: it can */
    struct arena scratch;
    struct arena estimates;   /* of the looks of slabs; empty between them */
    struct file_source files; /* the files that the generation reads */
    struct lang_reader reader;
    bool cancelled;
    const struct role *role;    /* of the shader; NULL: that which the options say */
    enum deferred_class stored; /* that a pass lights; CLASS_EMPTY: it lights none */
    ir_ref misfit; /* a closure that is no slab, so the material is drawn forward; 0: none */
    struct closure_above above;
    void *user_data; /* for the caller's `steps` */
};

static inline struct diag_list *diags_of(struct generation *g)
{
    return &g->result->object.diagnostics.list;
}

/* False: there is no description, or it names no target, or it has members of a later version. */
bool generation_names_target(const mxg_generate_desc *desc);

/*
 * Makes a result with `steps`, which runs with the trap of the result. `desc` may be NULL for steps
 * without generation; MXG_ERROR_ARGUMENT if it is missing or invalid.
 */
mxg_status generation_run(mxg_context *context, const mxg_document *document,
                          const mxg_generate_desc *desc, void (*steps)(struct generation *),
                          void *user_data, mxg_result **out_result);

/* All steps of mxg_generate. */
void generation_run_all(struct generation *g);
/* The steps in order; each returns false after a diagnostic. */
bool generation_start(struct generation *g); /* target, element, options */
bool generation_build(struct generation *g); /* g->root */
/* prepares the closure room; generation_emit calls it itself */
void generation_start_closures(struct generation *g);
/* closure_names.c: gives different names to the closures below the root, for locals and comments */
void generation_name_closures(struct generation *g);
/*
 * slabs.c: makes the slabs below the root cheaper, as the options ask; needs the closures' host.
 * False, after a message, where they cannot be cheap enough.
 */
bool generation_budget_slabs(struct generation *g);
/* False, after a message, where a tree has more slabs than anybody may walk to. */
bool generation_slabs_are_few(struct generation *g, const struct slab_report *report);
/* The budget of the options. */
struct slab_budget generation_slab_budget(const struct generation *g);
/* Reads the option `features`. */
void generation_slab_features(struct generation *g);
/* "1.25", or "unknown" for an error below 0. */
void generation_write_error(struct text *out, float error);
/* Replaces the slabs below the root by their lobes; needs the closures' host. */
void generation_walk_slabs(struct generation *g);
/* slabs.c: warns about media that a path tracer does not walk through */
void generation_tell_media(struct generation *g);
/* makes the effects of the stages; later steps cannot fail */
bool generation_emit(struct generation *g);
bool generation_light(struct generation *g);  /* the same after generation_start_closures */
bool generation_finish(struct generation *g); /* scheduling and layout */
bool generation_spell(struct generation *g);  /* source */
/* all steps between build and source; false also where the description asks for none */
bool generation_shade(struct generation *g);
/* replaces the last two steps */
bool generation_make_network(struct generation *g); /* network.c */

/* deferred.c: the deferred pipeline. */
/* The storage that a role writes or reads. */
struct deferred_layout generation_storage(const struct generation *g);
/* Sets the hooks of the closures' host. */
void generation_defer(struct generation *g);
/* Why a pixel cannot store the material. */
const char *generation_why_not_stored(struct generation *g);
/* Warns about a material whose shader lights itself; reports one with too many closures. */
void generation_tell_storage(struct generation *g);
/* Before budgets: leaves out what a slab cannot stand for, where the document hides it. */
void generation_hide_misfits(struct generation *g);
/*
 * After budgets, about closures that are no slabs: with the option `slabs` the material is drawn
 * forward, else false after a diagnostic.
 */
bool generation_can_store(struct generation *g);

/* generation.c: shared with network.c. */
struct shader_layout_rules generation_layout_rules(const struct generation *g);
struct spell_options generation_spell_options(const struct generation *g);
bool generation_has_stage(const mxg_result *result, int stage);
void generation_report_not_renderable(struct generation *g, const char *why);

/* frames.c: the frames of an image sequence, as in documents: "10-99", "clamp". */
struct frame_sequence {
    const char *range, *end_action;
    int32_t offset;
};
/* Writes the file of a frame like mxg_result_texture_file. */
size_t frame_file(const char *file, const struct frame_sequence *sequence, int32_t frame, char *out,
                  size_t capacity);

/* Variable `index` of mxg_result_variable. */
static inline const struct shader_variable *result_variable(const mxg_result *result,
                                                            uint32_t index)
{
    return shader_interface_variable(&result->shader, index);
}

/* The texts that results write when they are needed. */
enum { TEXT_REFLECTION, TEXT_TOPOLOGY, TEXT_COMPILED, NUM_RESULT_TEXTS };
_Static_assert((int)NUM_RESULT_TEXTS <= OBJECT_MAX_TEXTS, "an object has room for them");

/* storage.c: shader_reflect_options.more; user_data is the mxg_result. */
void result_storage(void *user_data, struct json *json);

/* reflection.c: the user interface data of a variable; user_data is the mxg_result. */
void result_ui(void *user_data, const struct shader_variable *variable, struct shader_ui *out);
/* As result_ui, for an input by its element (0: none) and the element of its definition. */
void result_input_ui(const mxg_result *result, elem_id element, elem_id definition,
                     struct shader_ui *out);
/* A hash: equal for shaders that can share a program. false: out of memory. */
bool result_topology(const mxg_result *result, uint64_t *out_topology);

/* uniform_block.c: the bytes of a block; 0: it is in no buffer. */
size_t block_size(const mxg_result *result, mxg_block block);
/* Fills the buffer of a block, which has `block_size` bytes, with the values of the result. */
void block_pack(const mxg_result *result, mxg_block block, void *bytes);
/* Writes a value to its place in a buffer. */
void block_write_words(const struct shader_variable *v, const union ir_word *words, char *to);

/* result_inputs.c: shader_reflect_options.compiled; user_data is the mxg_result. */
void result_compiled(void *user_data, uint32_t index, struct shader_compiled_text *out);

/*
 * undefined.c: false, after a diagnostic, if the roots, or the effects of a shader, need a value
 * that is undefined. `where` is the element of the message if the value comes from none.
 */
bool generation_is_defined(struct generation *g, const struct ir_graph *graph, const ir_ref *roots,
                           uint32_t num_roots, elem_id where);
bool generation_effects_are_defined(struct generation *g, const struct shader *shader,
                                    elem_id where);

/* losses.c: this element; where there is none, the one that the shader is for. */
elem_id generation_element_of(const struct generation *g, uint32_t origin);
/* Tells of parts of slabs that the role has no room for. */
void generation_tell_lost(struct generation *g);
/* Tells functions whose derivatives are 0 on paths. */
void generation_tell_flat_calls(struct generation *g);
/* Tells of patterns without the derivatives that they ask for: before closures add their own. */
void generation_tell_flat_patterns(struct generation *g);
/* Tells closures that stand for leaves which the language has no closure for. */
void generation_tell_stand_ins(struct generation *g);
/* capacity.c: warns about AOVs that a payload has no room for. */
void generation_tell_lost_aovs(struct generation *g);
/* False, after a diagnostic, if a stack has more textures than the target can read. */
bool generation_keeps_textures(struct generation *g);
/* False, after a diagnostic, if the vertex stage has more attributes than the target can read. */
bool generation_keeps_attributes(struct generation *g);
/* False, after a diagnostic, if AOVs are more than the attachments of the host. */
bool generation_keeps_outputs(struct generation *g);
/* Sets the features of a device that the finished shader needs. */
void generation_tell_features(struct generation *g, bool has_halves);

/*
 * role.c: finds the role; false, after diagnostics, if the target cannot have it, or if the values
 * of options have no meaning with it or with each other.
 */
bool generation_find_role(struct generation *g);
/* role.c: false, after diagnostics, if the target has no modules, or no option names one. */
bool generation_has_module(struct generation *g);
/* target_names.c: sets the names of targets in the build options. */
void generation_name_targets(struct generation *g);
/* host_names.c: false, after diagnostics, if a name that the host chooses is none. */
bool generation_check_names(struct generation *g);
/* The items of the option `rename`. */
void naming_pairs(const struct option_value *value, struct arena *arena, struct name_rules *out);

/* globs.c: warns about patterns in options that match nothing. */
void generation_check_globs(struct generation *g);

/*
 * graph_view.c: prints nodes and connections, of the whole document or of the part that an element
 * needs.
 */
void graph_view_text(struct generation *g, struct text *out);
void graph_view_dot(struct generation *g, struct text *out);

#endif
