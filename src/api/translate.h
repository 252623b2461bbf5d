// SPDX-License-Identifier: Apache-2.0
/* Translation of surfaces: what the files translate*.c share. */
#ifndef MXG_API_TRANSLATE_H
#define MXG_API_TRANSLATE_H

#include "api/generation.h"
#include "translate/value_nodes.h"

#include <mxgen/document.h>

/* Where the value of an input of the new surface comes from. */
struct translated_input {
    mxg_port port;      /* of the model */
    const char *output; /* of the last translation, which has the value */
    bool is_set;        /* else it keeps its default */
    struct operand value;
};

/* An input of the old surface. Its index is that of a leaf (OPERAND_LEAF). */
struct source_input {
    mxg_port port;    /* of its definition */
    elem_id element;  /* 0: the default of the definition */
    const char *text; /* not NULL: the value at a surface between, which has no element */
    bool is_connected;
    enum value_type type;
    bool has_other; /* the translation says which value needs no counterpart: not the default */
    bool is_used;   /* the new surface depends on it */
    elem_id map;    /* not 0: the leaf is what this input reads, in place of `element` */
    const char *map_output; /* the output of the map's graph for it; NULL: none is added yet */
};

/* A node of the library that computes the inputs of one model from those of another. */
struct translation_step {
    uint32_t definition;
    const char *from, *to;
    bool has_version;
};

struct translation {
    mxg_context *context;
    mxg_library *library;
    const mxg_document *document;
    const char *wanted;                 /* the caller's model, a node category: "gltf_pbr" */
    const char *model;                  /* of the pass: that one, or the first made of slabs */
    uint32_t definition;                /* of the model */
    bool joins;                         /* a surface that is made of others becomes one */
    uint8_t *readers;                   /* per element, where it joins: who reads a surface */
    VEC(struct translation_step) steps; /* all that there are */
    struct diag_list *diags;
    struct arena *kept;  /* of the result */
    struct arena *arena; /* empty between two surfaces */
    mxg_edit *edit;      /* makes the new document */
    /* the surface in work */
    elem_id surface;
    VEC(uint32_t) chain; /* definitions of the translations that lead to the model, in order */
    VEC(struct source_input) sources;
    VEC(struct translated_input) inputs;
    struct value_nodes nodes;
    /* the document with a node for each step, and one of the model that the surface has now */
    mxg_edit *draft_edit;
    mxg_document *draft;
    mxg_document *whole_draft; /* put aside while `draft` begins with a surface between */
    const char *draft_name;    /* of its nodes: with the number of the step, 0 for the surface */
    mxg_options *options;
    mxg_result *value; /* of the output in work */
    mxg_document *product;
    /* the pass over closures: translate_closures.c */
    const struct translation_step *slab_step; /* from slabs; NULL: there is none */
    elem_id *seen;                            /* per element: the last surface that needs it */
    uint32_t num_left;                        /* surfaces without another translation */
    VEC(elem_id) closures;                    /* the surface, and what it is made of */
    VEC(elem_id) leaves;                      /* their inputs with connected values */
    bool has_changed;                         /* a surface has another model now */
    VEC(elem_id) replaced; /* closures of all surfaces so far, and what definitions had inside */
    /* definitions: translate_flatten.c */
    VEC(elem_id) opened;    /* closures and surfaces that definitions had inside */
    uint32_t num_flattened; /* nodes of this level */
    uint8_t *patterns;      /* per definition: what is known of it */
};

/* Ends the work if there is no memory. */
static inline void translate_expect(const struct translation *t, bool good)
{
    if (!good)
        mem_fail(t->arena->mem);
}

/* translate_surfaces.c */
/* A message at the surface, whose second argument is the model. */
void translate_report(const struct translation *t, enum diag_id id, const char *first,
                      const char *third);
/* Repeats the errors of what was built last. */
void translate_repeat_errors(struct translation *t);
/* Gives an input of the model a value of the graph of t->value. 0: it has faults. */
void translate_set_input(struct translation *t, struct translated_input *input, ir_ref root);
/* False after a message: the new surface could not have the name, or the old one has faults. */
bool translate_is_sound(struct translation *t);
void translate_forget_surface(struct translation *t);
/* An edit of the document; and its end, after which the document is t->product. */
void translate_start_edit(struct translation *t);
void translate_commit_edit(struct translation *t);
/*
 * Visits the surfaces of the document that are not made of other ones, or, where these are joined,
 * that are not parts of other ones alone; or its materials.
 */
void translate_visit_surfaces(struct translation *t,
                              void (*visit)(struct translation *t, elem_id surface));
void translate_visit_materials(struct translation *t,
                               void (*visit)(struct translation *t, elem_id material));
/* Visits the surfaces of the document, which then is t->product, as t->edit made it. */
void translate_each_surface(struct translation *t,
                            void (*visit)(struct translation *t, elem_id surface));

/* translate_models.c */
/* Finds the default definition of a surface, whose category is a model. */
bool translate_find_surface(const struct translation *t, const char *model, uint32_t *out);
/* Finds the model; false after a diagnostic. */
bool translate_find_model(struct translation *t);
/* Fills `chain`; false: no translation leads from the category to the model `to`. */
bool translate_find_chain(struct translation *t, const char *category, const char *to);
/* True if the node is the model that is wanted, or a translation leads there. */
bool translate_leads(struct translation *t, elem_id node);
/* The input or output of a definition by name; false: there is none. */
bool translate_find_port(const struct translation *t, uint32_t definition, const char *name,
                         bool is_output, mxg_port *out);

/* The output of a translation that is the value of an input: "base_color_out". */
const char *translate_output_name(const struct translation *t, const char *input);

/* translate_draft.c: fills `sources` with the inputs of the surface, of this definition. */
void translate_read_sources(struct translation *t, uint32_t definition);
/* Fills `draft`: the sources are those of a surface of this definition, where `chain` begins. */
void translate_make_draft(struct translation *t, uint32_t definition);
/* An edit of a new draft, without nodes; and its end, which makes it t->draft. */
void translate_start_draft(struct translation *t);
void translate_commit_draft(struct translation *t);
/* Runs steps of a generation over an element, for any target or this one. The result is t->value.
 */
void translate_generate(struct translation *t, const mxg_document *document, const char *path,
                        const char *uniforms, void steps(struct generation *g), void *user_data);
/* True if a text has the value of a port's default, however it is spelt. */
bool translate_is_default(const mxg_port *port, const struct strpool *strings, const char *text);
/* True if the document connects the input, or gives it another value than the default. */
bool translate_is_authored(const struct translation *t, const struct source_input *source);
/* The text of its value, or of the default. */
const char *translate_value_of(const struct translation *t, const struct source_input *source);
/* A constant as the text of an attribute. */
const char *translate_text_of(const struct translation *t, const struct operand *constant);
const char *translate_text_of_zero(const struct translation *t, enum value_type type);
/* The start of names that no element of the root has. */
const char *translate_free_name(const struct translation *t);
/* The name of the draft's node of a step. */
const char *translate_step_name(const struct translation *t, unsigned step);
void translate_generate_for(struct translation *t, const struct target *target,
                            const mxg_document *document, const char *path, const char *uniforms,
                            void steps(struct generation *g), void *user_data);
/* The value of an element in the graph of t->value; 0: it has none. */
ir_ref translate_build_path(struct translation *t, const mxg_document *document, const char *path,
                            const char *uniforms);
/* True if the surface itself has a value; else t->value has the errors. */
bool translate_can_build(struct translation *t);
/*
 * The paths of inputs of the draft that become uniforms: those that are connected, and one more by
 * its index, or all that are set.
 */
#define TRANSLATE_ALL_INPUTS UINT32_MAX
#define TRANSLATE_CONNECTED (UINT32_MAX - 1)
const char *translate_uniforms(const struct translation *t, uint32_t more);
/*
 * The value of an output of a translation in the graph of t->value, with uniforms as above; 0: it
 * has none.
 */
ir_ref translate_build(struct translation *t, unsigned step, const char *output, uint32_t more);
/* The source that a node of the graph stands for; sources.len: none. */
uint32_t translate_source_of(const struct translation *t, const struct ir_graph *graph, ir_ref ref);

/* translate_geometry.c: normals and tangents. */
enum meaning {
    MEANING_NONE,
    MEANING_NORMAL,
    MEANING_TANGENT,
    MEANING_COAT_NORMAL,
    MEANING_COAT_TANGENT,
    MEANING_MAPPED
};
enum meaning translate_meaning_of(const mxg_port *port);
/* The output of a graph by name; "": its first one. 0: there is none. */
mxg_element translate_find_graph_output(const struct translation *t, mxg_element graph,
                                        const char *name);
/*
 * The element that gives the value of a connected input, through the outputs of graphs. 0: there is
 * none, or the connections are a cycle.
 */
mxg_element translate_find_source(const struct translation *t, mxg_element port);
void translate_geometry(struct translation *t);

/*
 * translate_idle.c: leaves out inputs on which the new surface does not depend: the roughness of a
 * coat that it does not have. Keeps what no shader of either model reads, and both have: an
 * occlusion.
 */
void translate_keep_for_others(struct translation *t);
void translate_drop_idle(struct translation *t);

/*
 * translate_reads.c. True if the shader of the draft's surface of a step reads an input that is a
 * uniform. `uniforms` lists paths of inputs.
 */
bool translate_surface_reads(struct translation *t, unsigned step, const char *input,
                             const char *uniforms);
/* True if it is another shader where an input has `other` in place of its own value. */
bool translate_surface_differs(struct translation *t, unsigned step, const char *input,
                               const char *own, const char *other, const char *uniforms);
/* True if a nodegraph implements the model, and does not read the input at all. */
bool translate_is_for_others(const struct translation *t, uint32_t definition, const char *input);
/*
 * True if an input of a definition does nothing, because its weight is 0, or that of its weight.
 * `value_of` is the text of the value of an input; NULL: it varies.
 */
bool translate_is_off(struct translation *t, uint32_t definition, const char *input,
                      const char *value_of(struct translation *t, const char *input));

/*
 * translate_losses.c: warns about inputs that change the old surface and not the new one, and about
 * those of the surfaces between.
 */
void translate_report_losses(struct translation *t);

/*
 * translate_closures.c: surfaces that are made of closures, or of what has no translation, become
 * the first model on the way from slabs.
 */
void translate_closures(struct translation *t);
/*
 * Fills t->closures and t->leaves for t->surface. A closure that several of its parts have is in
 * the list once; translate_forget_closures begins anew, for all surfaces of a document.
 */
void translate_find_closures(struct translation *t);
void translate_forget_closures(struct translation *t);

/* translate_remains.c: removes closures of t->replaced that nothing reads. */
void translate_remove_remains(struct translation *t);

/*
 * translate_flatten.c: puts definitions that are nodegraphs in the place of their nodes, where what
 * is inside of them has to stand in the document.
 */
void translate_definitions(struct translation *t);

/* translate_write.c */
/*
 * Gives an input a constant. Colours are in the working space; a document whose default is another
 * space has to say so.
 */
void translate_set_constant(const struct translation *t, mxg_element node, const char *input,
                            const struct operand *value);
/* Replaces the surface in `edit`. */
void translate_write(struct translation *t);

#endif
