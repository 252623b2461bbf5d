// SPDX-License-Identifier: Apache-2.0
/* Translation of surfaces: what the files translate*.c share. */
#ifndef MXG_API_TRANSLATE_H
#define MXG_API_TRANSLATE_H

#include "api/generation.h"
#include "translate/nodes.h"

#include <mxgen/document.h>

/* Where the value of an input of the new surface comes from. */
struct translated_input {
    mxg_port port; /* of the model */
    bool is_set;   /* else it keeps its default */
    struct operand value;
};

/* An input of the old surface. Its index is that of a leaf (OPERAND_LEAF). */
struct source_input {
    mxg_port port;   /* of its definition */
    elem_id element; /* 0: the default of the definition */
    bool is_connected;
    enum value_type type;
    bool is_used;           /* the new surface depends on it */
    elem_id map;            /* not 0: the leaf is what this input reads, in place of `element` */
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
    const char *model;                  /* a node category: "gltf_pbr" */
    uint32_t definition;                /* of the model */
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
    const char *draft_name; /* of its nodes: with the number of the step, 0 for the surface */
    mxg_options *options;
    mxg_result *value; /* of the output in work */
    mxg_document *product;
};

/* Ends the work if there is no memory. */
static inline void translate_expect(const struct translation *t, bool good)
{
    if (!good)
        mem_fail(t->arena->mem);
}

/* translate_models.c */
/* Finds the model; false after a diagnostic. */
bool translate_find_model(struct translation *t);
/* Fills `chain`; false: no translation leads from the category to the model. */
bool translate_find_chain(struct translation *t, const char *category);
/* The input or output of a definition by name; false: there is none. */
bool translate_find_port(const struct translation *t, uint32_t definition, const char *name,
                         bool is_output, mxg_port *out);

/* The output of a translation that is the value of an input: "base_color_out". */
const char *translate_output_name(const struct translation *t, const char *input);

/* translate_draft.c: fills `draft`, `sources`. */
void translate_make_draft(struct translation *t, uint32_t definition);
/* True if a text has the value of a port's default, however it is spelt. */
bool translate_is_default(const mxg_port *port, const struct strpool *strings, const char *text);
/* True if the document connects the input, or gives it another value than the default. */
bool translate_is_authored(const struct translation *t, const struct source_input *source);
/* The name of the draft's node of a step. */
const char *translate_step_name(const struct translation *t, unsigned step);
/* True if the surface itself has a value; else t->value has the errors. */
bool translate_can_build(struct translation *t);
/*
 * True if the shader of the draft's surface of a step reads an input that is a uniform. `uniforms`
 * lists paths of inputs.
 */
bool translate_surface_reads(struct translation *t, unsigned step, const char *input,
                             const char *uniforms);
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
void translate_geometry(struct translation *t);

/*
 * translate_idle.c: leaves out inputs on which the new surface does not depend: the roughness of a
 * coat that it does not have.
 */
void translate_drop_idle(struct translation *t);

/* translate_write.c */
/* Replaces the surface in `edit`. */
void translate_write(struct translation *t);

#endif
