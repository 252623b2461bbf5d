// SPDX-License-Identifier: Apache-2.0
/*
 * A shader between IR and text: interface variables in blocks, and a list of statements per stage,
 * which a target prints.
 *
 *     build + closure ─→ variables, effects ─schedule→ statements ─layout→ offsets ─spell→ text
 *                                                                         └→ reflection
 */
#ifndef MXG_SHADER_SHADER_H
#define MXG_SHADER_SHADER_H

#include "ir/ir.h"
#include "print/print.h"
#include "shader/names.h"
#include "shader/role.h"
#include "tree/reach.h"

#include <assert.h>

/* Blocks of the ShaderX convention; docs/reflection.md describes their contents. */
enum shader_block {
    BLOCK_PUBLIC_UNIFORMS,
    BLOCK_PRIVATE_UNIFORMS,
    BLOCK_LIGHT_DATA,  /* members of struct LightData, the element type of the array u_lightData */
    BLOCK_TEXTURES,    /* samplers, public (from file inputs) or private (environment) */
    BLOCK_APP_DATA,    /* vertex attributes */
    BLOCK_VERTEX_DATA, /* vertex stage to pixel stage */
    BLOCK_OUTPUTS,     /* pixel outputs */
    BLOCK_OWN,         /* the first of the blocks that nodes in C declare */
    NUM_BLOCKS = BLOCK_OWN + 4
};
enum { MAX_OWN_BLOCKS = NUM_BLOCKS - BLOCK_OWN };
struct shader;
/* "PublicUniforms" …; "" for an own block that the shader has not. */
const char *shader_block_name(const struct shader *shader, enum shader_block block);
/* True for the blocks that can be buffers, except the array of lights. */
bool shader_block_has_uniforms(enum shader_block block);
struct shader_variable;
/*
 * The type that the source declares a variable with, if it is not that of its values: a boolean in
 * a block of a language that has none there. NULL: the type of the values.
 */
const char *shader_block_type(const struct shader *shader, const struct lang_syntax *syntax,
                              const struct shader_variable *variable);

/* The possible values of the alpha output: 1; 0 or 1; any. */
enum shader_alpha { ALPHA_OPAQUE, ALPHA_MASK, ALPHA_BLEND };

enum shader_stage_id { STAGE_VERTEX, STAGE_PIXEL, NUM_STAGES };

/* The reaction of a host to a new value of an input. */
enum shader_update {
    UPDATE_UNIFORM, /* set the variable */
    UPDATE_SHADER,  /* generate again, because the build read the initial value */
};

/* The mode in which a node reads a texture, from its inputs of these names; 0: absent. */
struct shader_sampling {
    str_id uaddressmode, vaddressmode, filtertype;
    str_id layer;                      /* name of the file layer; "layerx" for input "filex" */
    str_id framerange, frameendaction; /* the available frames of a sequence: "10-99" */
    int32_t frameoffset;               /* offset from the current frame */
};

/* An AOV: a further output of the pixel stage, by a name of the document. */
struct shader_aov {
    str_id name, doc_type; /* "dirt", "color3"; a BSDF or EDF is its light */
    ir_type_id type;       /* of its values */
    uint32_t element;      /* of the document: the first node that has it; 0: none yet */
    bool is_output;        /* closure_find_aovs */
    uint32_t variable;     /* closure_aov_output: of its value */
};

/* A tile: one of several files of an image, which covers a unit square of texture coordinates. */
struct shader_tile {
    str_id file;
    int32_t u, v; /* its lower left corner */
};

struct shader_variable {
    /* as printed: "u_viewPosition", "SR_gold_base_color"; unique at file scope */
    str_id name;
    uint8_t block; /* enum shader_block */
    /* 1 << STAGE_… for each stage that reads or writes it; 0: unused and not declared */
    uint8_t stages;
    uint8_t update; /* enum shader_update */
    bool has_default;
    bool has_reader;  /* for textures: `sampling` and the default belong to a node */
    bool flat;        /* not interpolated (integer streams) */
    bool is_hosts;    /* a function reads it under a name of the host, which declares it */
    bool is_computed; /* vertex data with a value of the document: shader_interpolate */
    uint16_t rank;    /* order within the block: the row of streams.def; equal ranks by index */
    ir_type_id type;
    uint16_t array_length; /* 0: not an array */
    str_id doc_type;       /* "color3"; 0 for variables without a document type */
    str_id path;           /* element path of the document's input; 0 for private variables */
    str_id slot;           /* the layer of a stack that the input belongs to; 0: no stack */
    uint32_t element;      /* document element of the variable; 0 = none */
    uint32_t definition;   /* element of the nodedef's input, for ui attributes; 0 = none */
    str_id colorspace, unit, unittype;
    /* for private uniforms and streams: "worldMatrix", "position:world", "geomprop:st" … */
    str_id semantic;
    struct ir_value value; /* default; type VOID if there is none */
    /* textures */
    /* resolved filename with fileprefix; contains tokens of geometry and host: <UDIM>, {frame} */
    str_id file;
    str_id origin; /* the file that names it: an include, a library; 0: the document */
    struct shader_sampling sampling;
    /* variable of the default + 1, if the target reads the default with the texture; 0: `value` */
    uint32_t fallback;
    /* uniform of the default + 1: it identifies the default, because its value can change */
    uint32_t default_from;
    /* in shader->tiles: the array layers of a SAMPLER_ARRAY, in order */
    uint32_t first_tile, num_tiles;
    /* layout.c */
    uint32_t set, binding, location;
    uint32_t sampler_binding; /* of a texture: the binding of its sampler */
    uint32_t offset, size, array_stride, matrix_stride; /* in a block, in bytes */
};

/* The kind of a shader for targets without stages. */
enum shader_kind { SHADER_VALUE, SHADER_SURFACE, SHADER_VOLUME };

/* An input of the document whose value is compiled in. A new value needs a new shader. */
struct shader_compiled_input {
    uint32_t element;    /* holds the value; or the node whose definition does */
    uint32_t definition; /* element of the nodedef's input; 0 = none */
    str_id doc_type;
};

/* A bound light shader: its number in u_lightData[].type and its code. */
struct shader_light {
    int32_t type;
    str_id name; /* of the node, for comments and reflection */
    /* lang function: inputs, P, out direction, out intensity; or LANG_NONE with */
    uint32_t function;
    /*
     * lang function of one of its points, for roles that trace paths: inputs, P, random numbers,
     * out direction, out intensity, out distance; or LANG_NONE
     */
    uint32_t sample;
    /* verbatim source: (LightData, P, out lightshader); or UINT32_MAX with */
    uint32_t source;
    /* a LIGHT_SHADER over members of LightData, with a position and a direction */
    ir_ref shader;
    uint32_t position, direction; /* variables, for a LIGHT_SHADER */
    /* its inputs: indices of variables in shader->light_members */
    uint32_t first_member, num_members;
};

/* Verbatim source, the callee of a VERBATIM node. The id of the callee is its index. */
struct shader_verbatim {
    /* in source_refs: the sources that the call needs, in their order (shader/verbatim.h) */
    uint32_t first_source, num_sources;
    bool needs_neighbours; /* shader_needs_neighbours */
    /* the function, with the operands and an `out` argument per RESULT; 0: use `expression` */
    str_id function;
    str_id expression; /* {{i}} stands for operand i */
    /* types of a function's results, in shader->result_types; RESULT 1 is the first */
    uint32_t num_results, first_result;
    const char *const *result_names; /* for names of locals; NULL: "result" */
    bool has_initial; /* the last operands are the values of the results before the call */
};

/*
 * Effects: the actions of a stage in order, before scheduling. END closes IF, LIGHTS and SAMPLES.
 */
enum effect_kind {
    EFFECT_VAR,        /* declares mutable variable `index` with initial value `value` */
    EFFECT_ACCUMULATE, /* variable `index` += value */
    EFFECT_ASSIGN,     /* variable `index` = value */
    EFFECT_OUTPUT,     /* interface variable `index` (pixel output or vertex data) = value */
    EFFECT_POSITION,   /* the vertex's clip position = value */
    EFFECT_IF,         /* if (value) { */
    EFFECT_LIGHTS,     /* for each active light {; CONTEXT nodes read its data */
    EFFECT_TURN,    /* before SAMPLES: turn of the first sample = value; text: of which closure */
    EFFECT_SAMPLES, /* for `value` samples {; SAMPLE nodes are the index of each, and its turn */
    EFFECT_NEXT,    /* at the end of SAMPLES: the turn of the next sample = value */
    EFFECT_ELSE,    /* } else { of the IF */
    EFFECT_END,     /* } */
    EFFECT_COMMENT, /* a line of comment: text */
    EFFECT_DISCARD, /* alpha test: if (value) discard */
    /* added by schedule.c */
    /* a local for node `value`; for a call with several results, a local for each */
    EFFECT_LET,
    /* result `index` of an IR function = value; result 0, the return value, comes last */
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
    bool is_settled; /* no effect changes it after the first that reads it */
};

struct effect_list { /* layout of VEC(struct effect) */
    struct effect *items;
    uint32_t len, cap;
};

struct shader_function {           /* an IR function that a stage needs */
    uint32_t function;             /* in graph->functions */
    struct effect_list statements; /* LETs and RESULTs */
};

struct shader_stage {
    struct effect_list effects;    /* as built */
    struct effect_list statements; /* scheduled: effects and LETs */
    struct lang_reach reach;       /* portable functions and globals that the statements need */
    VEC(struct shader_function) functions; /* required IR functions, callees first */
    VEC(uint32_t) verbatim; /* required verbatim sources, each once, in order of use */
    bool has_lights;        /* contains a light loop */
};

/* a stream, attribute or private uniform under its requested name */
struct shader_binding {
    str_id asked;
    uint8_t block;
    ir_type_id scalar; /* streams of one name may differ in type */
    uint32_t variable;
};

struct shader_buffer {
    uint32_t set, binding;
    uint32_t size;   /* in bytes; of LightData: of the whole array */
    uint32_t stride; /* distance between lights in LightData */
};

/* Where the members of a block of uniforms stand. */
enum shader_packing {
    PACKING_STD140, /* OpenGL 4.5 core specification, section 7.6.2.2 */
    /*
     * Constant buffers of Direct3D: a vector does not cross a row of 16 bytes and is aligned to
     * its components otherwise. What follows an array or a matrix begins a row, which Direct3D
     * leaves to packoffset and Vulkan asks for.
     */
    PACKING_CBUFFER,
    /*
     * Structs of Metal (Metal Shading Language Specification, section 2.2): those of C, where a
     * vector of 3 has the size of one of 4, and a bool has one byte.
     */
    PACKING_METAL,
};

/* The needs of a target, from its table and the options. */
struct shader_layout_rules {
    bool blocks; /* uniforms stand in blocks */
    enum shader_packing packing;
    bool bindings;          /* sets and bindings are numbered, locations given */
    bool own_numbers;       /* blocks and textures are numbered apart, and each without gaps */
    bool sampler_bindings;  /* the sampler of a texture has a binding of its own, the next one */
    bool neutral_names;     /* public variables are numbered: equal topology, equal names */
    bool one_stage;         /* there is no vertex stage */
    bool typed_textures;    /* texture() gives one or three channels where no more are wanted */
    bool names_wholes;      /* parts are taken of variables only: v.x, but not (a + b).x */
    uint32_t set;           /* descriptor set of everything */
    uint32_t first_binding; /* of the private uniforms; the other bindings follow */
};

struct source_language;
struct shader_source;
struct shader_token;
struct source_leaf;

/* The variables that a host sets and reads: interface.c, layout.c. */
struct shader_interface {
    VEC(struct shader_variable) variables;
    VEC(struct shader_tile) tiles;
    VEC(struct shader_aov) aovs; /* IR_AOV has an index in it */
    /* the options list the outputs: the first ones; otherwise all that the root has */
    bool lists_aovs;
    uint32_t num_listed_aovs;
    /* used variables, block by block, in the order of their layout */
    VEC(uint32_t) used;
    /* start of each block in `used`, and the end of the last */
    uint32_t first_of_block[NUM_BLOCKS + 1];
    /* uniform blocks; size 0 if absent */
    struct shader_buffer buffers[NUM_BLOCKS];
    str_id own_blocks[MAX_OWN_BLOCKS]; /* names, in the order of declaration; 0: none */
    VEC(struct shader_light) lights;
    VEC(uint32_t) light_members;
    uint32_t max_lights; /* elements of u_lightData */
    VEC(struct shader_binding) bindings;
    struct table binding_table;            /* by name, to indices + 1 */
    struct table attributes;               /* by semantic, to variables of app data + 1 */
    struct table names;                    /* names to variables + 1 */
    struct name_set taken[NUM_BLOCKS + 1]; /* by scope */
    struct name_rules naming;              /* of variables, functions and types */
    struct name_rules naming_of_members;   /* of vertex data: without a prefix */
    const char *const *reserved;           /* names that the host keeps for itself */
    uint32_t num_reserved;
    struct shader_layout_rules rules; /* of shader_finish */
};

/* Locals and loops that the effects of all stages share: interface.c. */
struct shader_effects {
    VEC(struct shader_local) locals;
    uint32_t num_light_loops, num_sample_loops; /* so far; each has its own lights or samples */
};

/* Source of the target in its own language: verbatim.h. */
struct shader_sources {
    const struct source_language *language; /* of the target; NULL: it has none */
    VEC(struct shader_verbatim) calls;
    VEC(ir_type_id) result_types; /* of the functions that are called */
    VEC(struct shader_source) all;
    VEC(struct source_function) functions;
    VEC(uint32_t) refs;
    VEC(struct shader_token) tokens; /* of all sources */
    VEC(struct source_leaf) leaves;
    bool is_1_38;              /* it has closures of MaterialX 1.38 */
    struct table helper_table; /* names of the target's helpers to bits + 1 */
    /*
     * A pass over pixels or rays (deferred_add_pass): a program, whose mx_run() a compute stage
     * calls.
     */
    struct source_pass {
        uint32_t program;   /* a source + 1; 0: the shader is none */
        bool lacks_surface; /* there is no function beside the program */
        bool runs;          /* a compute stage calls it; otherwise all functions are the host's */
        bool has_group;     /* the invocations of a group have bits in common: mx_or_in_group() */
    } pass;
};

/* A part of a slab that the role has no room for: an input of the slab. */
struct shader_lost {
    uint32_t origin;
    const char *part, *why;
};

/* On paths: a call of a function whose derivatives are 0, because it has not become nodes. */
struct shader_flat_call {
    uint32_t origin;
    str_id function;
};

/* Closures of the language that stand for a leaf without one. */
struct shader_stand_in {
    uint32_t origin; /* of the leaf */
    unsigned num_closures;
    double error; /* the share of the leaf's light that they send elsewhere */
};

/* Facts of the whole, which a host is told: api/reflection.c. */
struct shader_reflection {
    str_id name;         /* of the element: "Gold" */
    str_id element_type; /* "surfacematerial" */
    str_id path;
    VEC(struct shader_compiled_input) compiled;
    VEC(uint32_t) closures;     /* the evaluated closures, as origins of their leaves */
    VEC(str_id) host_functions; /* that the pixel stage calls: after shader_finish */
    uint64_t codes;         /* a hash of the nodes in C and their versions; part of the topology */
    uint8_t kind;           /* enum shader_kind */
    str_id value_type;      /* document type of a shader for a plain value */
    uint8_t alpha;          /* enum shader_alpha */
    bool transparent;       /* by analysis: the alpha output may be below 1 */
    bool lit;               /* reads lights or environment */
    bool displaced;         /* the vertex stage moves the surface */
    const char *not_walked; /* on paths: why its media are tables; NULL: they are not */
    const char *not_traced; /* on paths: why a volume is not drawn; NULL: it is */
    VEC(struct shader_lost) lost;
    VEC(struct shader_stand_in) stand_ins;
    VEC(struct shader_flat_call) flat_calls;
    const char *not_stored; /* where pixels store slabs: why it lights itself; NULL: it does not */
    /* words that it stores per pixel, at most, or in a payload; 0: it lights itself */
    uint32_t stored_words;
    uint32_t stored_classes; /* that its pixels may have, as bits (docs/deferred.md) */
    /* names of the function and of the struct that it returns; "": it is no function of a host */
    const char *function, *function_type;
    /* of the host's device, which the shader needs, with commas between; "": none */
    const char *device_features;
};

struct shader {
    const struct role *role; /* what it is for */
    enum role_lights lights; /* that of the role, or LIGHTS_OF_HOST, which an option asks for */
    bool has_two_sources;    /* the second output is what the surface lets through */
    bool picks;              /* one layer of a stack, by a random number */
    struct arena *arena;
    struct strpool *strings;
    struct ir_graph *graph;
    /* the unit of the generation, above the units of the library: contains the specialisations */
    struct lang_unit *unit;
    struct lang_style *style; /* its reserved words are not valid for variables; NULL: none */
    struct shader_module {
        const char *name; /* that has functions of libraries for the shader; NULL: none has */
        bool is_shader;   /* the shader is the module */
    } module;
    struct shader_interface interface;
    struct shader_effects effects;
    struct shader_sources sources;
    struct shader_reflection reflection;
    struct shader_stage stages[NUM_STAGES];
};

/* The function of a shader that is one, and the struct that it returns, in the frame. */
#define SHADER_FUNCTION "surface"
#define SHADER_FUNCTION_RESULT "Surface"

void shader_init(struct shader *shader, const struct role *role, struct arena *arena,
                 struct strpool *strings, struct ir_graph *graph, struct lang_unit *unit);

/* module_names.c */

/*
 * Leaves to a module of this name what is the same in each shader of the first `num_functions`
 * functions, those of the libraries. Before the first call of a function; the shader has its style.
 */
void shader_import_module(struct shader *shader, const char *name, uint32_t num_functions);
/* Makes the shader the module that it imports, after shader_finish: it has all these functions. */
void shader_become_module(struct shader *shader);

/* interface.c */

/* The variable at `place` in the order of the layout: after shader_finish. */
static inline struct shader_variable *shader_interface_variable(const struct shader *shader,
                                                                uint32_t place)
{
    const struct shader_interface *interface = &shader->interface;
    assert(place < interface->used.len && interface->used.items[place] < interface->variables.len);
    return &interface->variables.items[interface->used.items[place]];
}

/*
 * Adds a variable. Converts the name to a valid identifier and makes it unique with a number.
 * Returns its index.
 */
uint32_t shader_add_variable(struct shader *shader, const struct shader_variable *variable);
/* Makes a stream a public uniform, which no input of the document has: an output of other code. */
void shader_make_parameter(struct shader *shader, uint32_t variable, str_id name, str_id doc_type);
/* At file scope, apart from the underscore for reserved words. */
bool shader_name_is_free(struct shader *shader, str_id name);
/*
 * The pixel output of this name; adds it behind the others if absent. Its location follows theirs
 * (shader_layout). Its type has no boolean, because no attachment has.
 */
uint32_t shader_output(struct shader *shader, str_id name, ir_type_id type);
/* UINT32_MAX: none. */
uint32_t shader_find_variable(const struct shader *shader, enum shader_block block, str_id name);

/* True if streams.def has the private uniform. */
bool shader_knows_uniform(str_id name);

/* The IR node that reads a variable: UNIFORM, TEXTURE or STREAM by its block. */
ir_ref shader_read(struct shader *shader, uint32_t variable);

/*
 * The block of a node in C by its name; adds it if absent. NUM_BLOCKS: MAX_OWN_BLOCKS exist, or the
 * name is taken at file scope.
 */
enum shader_block shader_own_block(struct shader *shader, str_id name);
/*
 * The uniform of this name in an own block; adds it, with default 0, if absent. The one that is
 * there may have another type.
 */
uint32_t shader_own_uniform(struct shader *shader, enum shader_block block, str_id name,
                            ir_type_id type);

/* The private number that shader_private_uniform added for a name; UINT32_MAX: none. */
uint32_t shader_asked_uniform(const struct shader *shader, str_id name);

/*
 * The member of LightData with this name and type; adds it if absent. `type` exists from the first
 * call.
 */
uint32_t shader_light_member(struct shader *shader, str_id name, ir_type_id type);

/* The type of the uniform with a ShaderX name; VOID: there is none of this name. */
ir_type_id shader_uniform_type(str_id name);

/*
 * The private uniform or texture with a ShaderX name ("u_worldMatrix"). The first use adds it with
 * the type, default and semantic of streams.def; a name outside the table takes the type of the
 * caller.
 */
uint32_t shader_private_uniform(struct shader *shader, str_id name, ir_type_id type,
                                uint16_t array_length);

/*
 * The IR node of a geometric stream in the pixel stage ("normalWorld", "texcoord_0",
 * "geomprop_st"…). Adds the vertex data, the attributes and matrices that it needs, and its
 * computation in the vertex stage. `type` VOID means the type of the stream; texcoord_N may also be
 * VEC3, color_N FLOAT or VEC3, and geomprop_* any type. 0: there is no such stream.
 */
ir_ref shader_stream(struct shader *shader, str_id name, ir_type_id type);
/*
 * The IR node, in the pixel stage, of a value that the vertex stage computes instead. `name` is for
 * its variable. The type is an int, a float or a vector of these. No function that the value calls
 * reads a stream.
 */
ir_ref shader_interpolate(struct shader *shader, str_id name, ir_ref value);
/*
 * The value with the vertex data that it reads computed from attributes: the pixel stage, which may
 * not need these data, does not get them, and positions are alike whatever it reads.
 */
ir_ref shader_at_vertices(struct shader *shader, ir_ref value);
/* The vertex attribute that a stream copies; false: the vertex stage computes the stream. */
bool shader_attribute(const struct shader *shader, uint32_t stream, uint32_t *out_index);
/* The expression of the stream in the vertex stage, for displacement. */
ir_ref shader_vertex_stream(struct shader *shader, str_id name, ir_type_id type);

void shader_effect(struct shader *shader, enum shader_stage_id stage, struct effect effect);

/* Adds a leaf to the evaluated closures. */
void shader_add_closure(struct shader *shader, ir_ref leaf);
uint32_t shader_add_local(struct shader *shader, str_id name, ir_type_id type);

/*
 * identifier.c: true if text is an identifier that a shader may declare; converts text to an
 * identifier: other characters become '_', no leading digit, no
 * "__", no prefix "gl_"; "x" for an empty text; long texts are cut. Returns the text itself if it
 * is an identifier.
 */
bool identifier_is(const char *text, size_t len);
const char *identifier_from(const char *text, size_t len, struct arena *arena, size_t *out_len);

/*
 * finish.c: the last step before spelling. Adds the interface variables that the statements need,
 * removes vertex data that the pixel stage does not read, schedules both stages and lays out the
 * interface. Nothing can be added afterwards.
 */
void shader_finish(struct shader *shader, const struct shader_layout_rules *rules);

/*
 * calls.c: gives each portable function the one version that all its calls share, and builds the
 * graph anew of what the effects need; refs from before are gone. With typed_textures, TEX gives
 * one or three channels where no more are wanted. Part of shader_finish.
 */
void shader_specialise_calls(struct shader *shader, bool typed_textures);

/*
 * idle_effects.c: drops effects that change nothing, such as a loop over samples that reflect
 * nothing. Part of shader_finish.
 */
void shader_drop_idle(struct shader *shader, enum shader_stage_id stage);

/*
 * The variable of a uniform or stream that a portable function reads; UINT32_MAX for constants, and
 * before shader_finish.
 */
uint32_t shader_global_variable(const struct shader *shader, uint32_t global_id);

/*
 * layout.c: True if the source gives the variables of a block their locations: outputs have them in
 * every target as soon as there are several, because their order alone says nothing to a host.
 */
bool shader_has_locations(const struct shader *shader, enum shader_block block);
/* layout.c: True for the second source of a blend, an output at the location of the first. */
bool shader_is_second_source(const struct shader_variable *variable);

/* topology.c: a hash of a finished shader without names and uniform values. */
uint64_t shader_topology(const struct shader *shader, struct arena *scratch);

/* layout.c: sizes and alignments of std140 (OpenGL 4.5 core, section 7.6.2.2). */
uint32_t std140_align(ir_type_id type, bool array);
/* For an array with the padding after its last element. */
uint32_t std140_size(ir_type_id type, uint16_t array_length);
/*
 * Fills shader->interface from the stages of the variables and, by the rules, offsets, bindings and
 * locations.
 */
void shader_layout(struct shader *shader);

/*
 * schedule.c: decides which nodes become locals, and in which region. Collects the functions of the
 * stage, and sets the bit of the stage in its variables. A node with several uses, or a node that
 * would make an expression too long, becomes a LET in the innermost region (IF, LIGHTS, SAMPLES)
 * that dominates its uses. Loop-invariant nodes move out of loops. Nodes with derivatives stay
 * outside IF, loops and the arms of SELECT, and before any DISCARD. Nodes that read a LOCAL belong
 * to the effect that uses them.
 */
void shader_schedule(struct shader *shader, enum shader_stage_id stage);

/* The number of results that a call returns through out arguments. Such a call is a statement. */
unsigned shader_call_outs(const struct shader *shader, ir_ref call);
/* Returns what a CALL (a lang function) or a VERBATIM node (an index in shader->verbatim) calls. */
static inline uint32_t shader_callee(const struct shader *shader, ir_ref call)
{
    return shader->graph->callees.items[ir_get(shader->graph, call)->attr].index;
}

/* json.c: the reflection as JSON (docs/reflection.md). */

/* The document's data about a variable for a user interface; the strings may be NULL. */
struct shader_ui {
#define UI(member, attribute, key) const char *member;
#include "shader/ui.def"
#undef UI
    bool advanced;
};
/* An input that is compiled in, as text. */
struct shader_compiled_text {
    const char *path, *type, *value;
    bool authored; /* the document has the value, not the definition */
    struct shader_ui ui;
};
struct reflect; /* reflect.h */
struct json;
struct network;
struct shader_reflect_options {
    const char *target, *generator; /* "vulkan", "mxgen 0.1.0" */
    uint64_t topology;
    void *user_data;
    /* Fills the strings for a variable, which is zeroed before; NULL: none. */
    void (*ui)(void *user_data, const struct shader_variable *variable, struct shader_ui *out);
    /* Describes an item of shader->compiled; NULL: nothing is compiled in. */
    void (*compiled)(void *user_data, uint32_t index, struct shader_compiled_text *out);
    /* Adds items to the object of a shader; NULL: there are none. */
    void (*more)(void *user_data, struct json *json);
    const struct network *network; /* described in the place of the shader; NULL: it is none */
    void (*reflect_network)(const struct network *network, struct reflect *r);
};
void shader_reflect_json(const struct shader *shader, const struct shader_reflect_options *options,
                         struct text *out);

#endif
