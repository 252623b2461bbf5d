// SPDX-License-Identifier: Apache-2.0
/*
 * A shader between IR and text: interface variables in blocks, and per stage a list of statements
 * that a target spells.
 *
 *     build + closure ─→ shader (variables, effects) ─layout→ offsets, locations ─schedule→
 * statements ─spell→ text └→ reflection
 */
#ifndef MXG_SHADER_SHADER_H
#define MXG_SHADER_SHADER_H

#include "ir/ir.h"
#include "lang/lang.h"

/* Blocks of the ShaderX convention; docs/reflection.md tells of their contents. */
enum shader_block {
    BLOCK_PUBLIC_UNIFORMS,
    BLOCK_PRIVATE_UNIFORMS,
    BLOCK_LIGHT_DATA,  /* members of struct LightData, elements of the array u_lightData */
    BLOCK_TEXTURES,    /* samplers, public (from file inputs) or private (environment) */
    BLOCK_APP_DATA,    /* vertex attributes */
    BLOCK_VERTEX_DATA, /* vertex stage to pixel stage */
    BLOCK_OUTPUTS,     /* pixel outputs */
    NUM_BLOCKS
};
const char *shader_block_name(enum shader_block block); /* "PublicUniforms" … */

/* What the alpha that is written may be: 1, 0 or 1, anything. */
enum shader_alpha { ALPHA_OPAQUE, ALPHA_MASK, ALPHA_BLEND };

enum shader_stage_id { STAGE_VERTEX, STAGE_PIXEL, NUM_STAGES };

/* What a host must do when the value of an input changes. */
enum shader_update {
    UPDATE_UNIFORM, /* set the variable */
    UPDATE_SHADER,  /* generate again: the value is compiled in */
};

/* How a node reads a texture: what its inputs of these names say; 0: nothing. */
struct shader_sampling {
    str_id uaddressmode, vaddressmode, filtertype;
    str_id layer;                      /* of the file, by name; "layerx" of "filex" */
    str_id framerange, frameendaction; /* which frames of a sequence there are: "10-99" */
    int32_t frameoffset;               /* added to the current frame */
};

/* One file of an image that is made of several, each for a unit square of texture coordinates. */
struct shader_tile {
    str_id file;
    int32_t u, v; /* its lower left corner */
};

struct shader_variable {
    /* as spelled: "u_viewPosition", "SR_gold_base_color"; unique among what stands at file scope */
    str_id name;
    uint8_t block; /* enum shader_block */
    /*
     * 1 << STAGE_… of each stage that reads it, or writes it; 0: nothing does, it is not declared
     */
    uint8_t stages;
    uint8_t update; /* enum shader_update */
    bool has_default;
    bool has_reader; /* of textures: `sampling` and the default are those of a node */
    bool flat;       /* not interpolated (integer streams) */
    uint16_t rank;   /* place within its block: the row of streams.def; equal ranks by index */
    ir_type_id type;
    uint16_t array_length; /* 0: not an array */
    str_id doc_type;       /* "color3"; 0 where the document has no say */
    str_id path;           /* element path of the document's input; 0 for private variables */
    uint32_t element;      /* document element that the variable comes from; 0 = none */
    uint32_t definition;   /* element of the nodedef's input: ui attributes; 0 = none */
    str_id colorspace, unit, unittype;
    /* of private uniforms and streams: "worldMatrix", "position:world", "geomprop:st" … */
    str_id semantic;
    struct ir_value value; /* default; type VOID where there is none */
    /* textures */
    /* resolved file name, with fileprefix; tokens of geometry and host kept: <UDIM>, {frame} */
    str_id file;
    struct shader_sampling sampling;
    /* variable that the default is, + 1, where the target reads it with the texture; 0: `value` */
    uint32_t fallback;
    /*
     * uniform that the default is, + 1: reads are told apart by it and not by its value, which may
     * change
     */
    uint32_t default_from;
    /* in shader->tiles, which are the layers of a SAMPLER_ARRAY in this order */
    uint32_t first_tile, num_tiles;
    /* layout.c */
    uint32_t set, binding, location;
    uint32_t offset, size, array_stride, matrix_stride; /* in a block, in bytes */
};

/* What a shader of a target without stages is. */
enum shader_kind { SHADER_VALUE, SHADER_SURFACE, SHADER_VOLUME };

/*
 * Inputs whose value is compiled in: reported to hosts, which must know that a change needs a new
 * shader.
 */
struct shader_compiled_input {
    str_id path, doc_type, value;
    uint32_t element;
};

/* A light shader bound by the host: its number in u_lightData[].type and what samples it. */
struct shader_light {
    int32_t type;
    str_id name; /* of its node, for comments and reflection */
    /* lang function: inputs, P, out direction, out intensity; LANG_NONE: */
    uint32_t function;
    /* a LIGHT_SHADER over members of LightData: it stands at a position and faces a direction */
    ir_ref shader;
    uint32_t position, direction; /* variables; only of a LIGHT_SHADER */
    /* its inputs as LightData members: in shader->light_members (variable indices) */
    uint32_t first_member, num_members;
};

/*
 * Target source that mxgen does not parse: what a VERBATIM node calls. The id of the node's callee
 * is its index.
 */
struct shader_verbatim {
    str_id source; /* definitions that the call needs: written once, above; 0 = none */
    /* called with the operands, then an `out` argument for each RESULT; or 0, and then */
    str_id function;
    str_id expression; /* operand i stands where {{i}} is written */
    /* types of a function's results, in shader->result_types; RESULT 1 is the first */
    uint32_t num_results, first_result;
};

/*
 * Effects: what a stage does, in order, before scheduling. Structured: IF, LIGHTS and SAMPLES end
 * with END.
 */
enum effect_kind {
    EFFECT_VAR,        /* declares mutable variable `index` with initial value `value` */
    EFFECT_ACCUMULATE, /* variable `index` += value */
    EFFECT_ASSIGN,     /* variable `index` = value */
    EFFECT_OUTPUT,     /* interface variable `index` (pixel output or vertex data) = value */
    EFFECT_POSITION,   /* the vertex's clip position = value */
    EFFECT_IF,         /* if (value) { */
    EFFECT_LIGHTS,     /* for each active light {; CONTEXT nodes inside read its data */
    EFFECT_SAMPLES,    /* for each sample of the environment {; SAMPLE inside is its index */
    EFFECT_END,        /* } */
    EFFECT_COMMENT,    /* a line of comment: text */
    EFFECT_DISCARD,    /* alpha test: if (value) discard */
    /* added by schedule.c */
    /* local constant for node `value`; of a call with several results, locals for all of them */
    EFFECT_LET,
    /* result `index` of an IR function = value; the returned one, 0, comes last */
    EFFECT_RESULT,
};

struct effect {
    uint8_t kind; /* enum effect_kind */
    uint32_t index;
    ir_ref value;
    str_id text;
};

struct shader_local { /* a mutable variable: EFFECT_VAR, read by LOCAL nodes */
    str_id name;
    ir_type_id type;
};

struct effect_list { /* a vector, as of VEC(struct effect) */
    struct effect *items;
    uint32_t len, cap;
};

struct shader_function {           /* an IR function that a stage needs */
    uint32_t function;             /* in graph->functions */
    struct effect_list statements; /* LETs and RESULTs */
};

struct shader_stage {
    struct effect_list effects;    /* as built */
    struct effect_list statements; /* scheduled: effects with LETs between them */
    struct lang_reach reach;       /* portable functions and globals that the statements need */
    VEC(struct shader_function) functions; /* IR functions needed, callees first */
    VEC(uint32_t) verbatim;                /* verbatim sources needed, each once, in order of use */
    bool has_lights;                       /* it loops over lights */
};

/* a stream, attribute or private uniform by the name that it was asked for */
struct shader_binding {
    str_id asked;
    uint8_t block;
    ir_type_id scalar; /* streams of one name may differ in this */
    uint32_t variable;
};

struct shader_buffer {
    uint32_t set, binding;
    uint32_t size;   /* in bytes; of LightData: of the whole array */
    uint32_t stride; /* of LightData: from light to light */
};

struct shader {
    struct arena *arena;
    struct strpool *strings;
    struct ir_graph *graph;
    /* the generation's unit: specialisations, on the library's units */
    struct lang_unit *unit;
    struct lang_style *style; /* whose reserved words variables must not have; NULL: none */
    VEC(struct shader_variable) variables;
    VEC(struct shader_tile) tiles;
    VEC(struct shader_compiled_input) compiled;
    VEC(struct shader_local) locals;
    VEC(struct shader_light) lights;
    VEC(uint32_t) light_members;
    VEC(struct shader_verbatim) verbatim;
    VEC(ir_type_id) result_types; /* of verbatim functions */
    /* variables that stages use, block by block, in the order of their layout */
    VEC(uint32_t) interface;
    /* in `interface`: where each block begins, and where the last one ends */
    uint32_t first_of_block[NUM_BLOCKS + 1];
    /* open addressing: names at file scope to variables, see interface.c */
    uint32_t *names;
    uint32_t names_mask;
    VEC(struct shader_binding) bindings;
    /* of blocks of uniforms; size 0 where there is none */
    struct shader_buffer buffers[NUM_BLOCKS];
    struct shader_stage stages[NUM_STAGES];
    uint32_t max_lights; /* elements of u_lightData */
    str_id name;         /* of the element: "Gold" */
    str_id element_type; /* "surfacematerial" */
    str_id path;
    VEC(uint32_t) closures; /* that are evaluated, by the origins of their leaves */
    uint8_t kind;           /* enum shader_kind */
    /* of the document: what the element gives, where that is a plain value */
    str_id value_type;
    /* only variables have parts that can be named: from the rules of layout */
    bool names_wholes;
    bool transparent; /* found by analysis: the alpha written may be below 1 */
    uint8_t alpha;    /* enum shader_alpha */
    bool lit;         /* reads lights or environment */
    bool displaced;   /* the vertex stage moves the surface */
    /* it is no program but a function of path tracers: there is no vertex stage */
    bool scatters;
    /* uniforms stand in blocks: each reading costs an access beside the load */
    bool in_blocks;
    /* the speller's: by node, 0 between the lists of statements; from shader_finish */
    uint32_t *local_of;
    /* the function of a leaf that the target has no closure for; 0: there is none */
    str_id unknown_closure;
    bool numbered; /* sets, bindings and locations are given */
};

void shader_init(struct shader *shader, struct arena *arena, struct strpool *strings,
                 struct ir_graph *graph, struct lang_unit *unit);

/* interface.c */

/*
 * Adds a variable; the name is made a valid identifier, and unique by a number behind it. Returns
 * its index.
 */
uint32_t shader_add_variable(struct shader *shader, const struct shader_variable *variable);
/* at file scope, but for the underscore of reserved words */
bool shader_name_is_free(struct shader *shader, str_id name);
/* UINT32_MAX: none */
uint32_t shader_find_variable(const struct shader *shader, enum shader_block block, str_id name);

/* The IR node that reads a variable: UNIFORM, TEXTURE or STREAM by its block. */
ir_ref shader_read(struct shader *shader, uint32_t variable);

/*
 * The member of LightData with this name and type, added where there is none; `type` is there from
 * the first call on.
 */
uint32_t shader_light_member(struct shader *shader, str_id name, ir_type_id type);

/*
 * The private uniform or texture of a ShaderX name ("u_worldMatrix"), added at first use with the
 * type, default and semantic of streams.def; the type is the caller's for names that the table does
 * not have.
 */
uint32_t shader_private_uniform(struct shader *shader, str_id name, ir_type_id type,
                                uint16_t array_length);

/*
 * IR node for a geometric stream as the pixel stage reads it ("normalWorld", "texcoord_0",
 * "geomprop_st"…): adds the vertex data, the attributes and matrices it needs, and the vertex
 * stage's computation of it. `type` VOID means the stream's own; texcoord_N may be asked for as
 * VEC3 and color_N as FLOAT or VEC3; geomprop_* is of any type that is asked for. 0: there is no
 * such stream.
 */
ir_ref shader_stream(struct shader *shader, str_id name, ir_type_id type);
/* The vertex attribute that a stream of that index is as it is; false: it is computed. */
bool shader_attribute(const struct shader *shader, uint32_t stream, uint32_t *out_index);
/* The same seen from inside the vertex stage: the expression itself (for displacement). */
ir_ref shader_vertex_stream(struct shader *shader, str_id name, ir_type_id type);

void shader_effect(struct shader *shader, enum shader_stage_id stage, struct effect effect);

/* Counts a leaf among the closures that are evaluated. */
void shader_add_closure(struct shader *shader, ir_ref leaf);
uint32_t shader_add_local(struct shader *shader, str_id name, ir_type_id type);

/*
 * identifier.c: text as an identifier: other characters become '_', no leading digit, no "__", no
 * "gl_" in front; "x" for nothing; what is very long is cut. The text itself where it is one
 * already.
 */
const char *identifier_from(const char *text, size_t len, struct arena *arena, size_t *out_len);

/*
 * finish.c: the last step before spelling. Adds what the stages' statements need from the host,
 * drops vertex data that the pixel stage does not read, schedules both stages and lays the
 * interface out. Nothing may be added after it.
 */
/* Where the members of a block of uniforms stand. */
enum shader_packing {
    PACKING_STD140, /* OpenGL 4.5 core specification, section 7.6.2.2 */
    /*
     * Constant buffers of Direct3D: a vector does not cross a row of 16 bytes and is aligned to
     * its components otherwise. What follows an array or a matrix begins a row, which Direct3D
     * leaves to packoffset and Vulkan asks for.
     */
    PACKING_CBUFFER,
};

struct shader_layout_rules { /* from the target's table and the options */
    bool blocks;             /* uniforms stand in blocks */
    enum shader_packing packing;
    bool bindings;       /* sets and bindings are numbered, locations given */
    bool neutral_names;  /* public variables are numbered: equal topology, equal names */
    bool one_stage;      /* there is no vertex stage */
    bool typed_textures; /* texture() gives one or three channels where no more are wanted */
    bool names_wholes;   /* parts are taken of variables only: v.x, but not (a + b).x */
    uint32_t set;        /* descriptor set of everything */
};
void shader_finish(struct shader *shader, const struct shader_layout_rules *rules);

/*
 * calls.c: gives each portable function the one version that all its calls share. Part of
 * shader_finish.
 */
void shader_specialise_calls(struct shader *shader);

/*
 * The variable of a uniform or stream that a portable function reads; UINT32_MAX for constants, and
 * before shader_finish.
 */
uint32_t shader_global_variable(const struct shader *shader, uint32_t global_id);

/*
 * topology.c: a hash of everything but names and uniform values, of a finished shader; computed
 * when asked for.
 */
uint64_t shader_topology(const struct shader *shader, struct arena *scratch);

/* layout.c: sizes and alignments of std140 (OpenGL 4.5 core, section 7.6.2.2). */
uint32_t std140_align(ir_type_id type, bool array);
/* of an array: with the padding behind its last element */
uint32_t std140_size(ir_type_id type, uint16_t array_length);
/*
 * Fills shader->interface and, with the rules, offsets, bindings and locations, from the variables'
 * stages.
 */
void shader_layout(struct shader *shader, const struct shader_layout_rules *rules);

/*
 * schedule.c: decides which nodes become locals and where, and collects what the stage needs:
 * functions, and the stage's bit in the variables that it reads. A node used more than once, or one
 * that would make an expression too long, is a LET in the innermost region that dominates its uses
 * (IF, LIGHTS, SAMPLES). What does not change from turn to turn is moved out of loops, and nodes
 * with derivatives stay outside of IF and loops, of the arms of SELECT, and before any DISCARD.
 * Nodes that read a LOCAL belong to the effect that uses them.
 */
void shader_schedule(struct shader *shader, enum shader_stage_id stage);

/*
 * Results of a call that it hands out through arguments, beside what it returns; such a call is a
 * statement.
 */
unsigned shader_call_outs(const struct shader *shader, ir_ref call);
/* What a CALL (a lang function) or a VERBATIM node (an index in shader->verbatim) calls. */
static inline uint32_t shader_callee(const struct shader *shader, ir_ref call)
{
    return (uint32_t)shader->graph->callees.items[ir_get(shader->graph, call)->attr].id;
}
/* The id of the callee of VERBATIM nodes, apart from those of functions. */
#define SHADER_VERBATIM_ID(index) ((uint64_t)2 << 32 | (index))

/* json.c: the reflection as JSON (docs/reflection.md). */

/* What the document says about a variable for a user interface; the strings may be NULL. */
struct shader_ui {
    const char *name, *folder, *min, *max, *soft_min, *soft_max, *step, *doc, *enum_names,
        *enum_values;
    bool advanced;
};
struct shader_reflect_options {
    const char *target, *generator; /* "vulkan", "mxgen 0.1.0" */
    void *user_data;
    /* Fills the strings for a variable, which is zeroed before; NULL: none. */
    void (*ui)(void *user_data, const struct shader_variable *variable, struct shader_ui *out);
    const struct network_group *groups; /* num_groups: it is a network, and no more */
    uint32_t num_groups;
};
void shader_reflect_json(const struct shader *shader, const struct shader_reflect_options *options,
                         struct text *out);

#endif
