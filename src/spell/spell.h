// SPDX-License-Identifier: Apache-2.0
/*
 * The state of the speller while it writes one stage, and the functions that its files share with
 * each other and with the hooks of targets.
 */
#ifndef MXG_SPELL_SPELL_H
#define MXG_SPELL_SPELL_H

#include "deferred/deferred.h"
#include "shader/names.h"
#include "shader/verbatim.h"
#include "spell/target.h"
#include "tree/reach.h"

/* ---- program.c: functions that are no functions of a library ---- */

struct spell_program {
    const struct lang_unit *unit;
    struct lang_reach reach; /* what the stage calls */
    const char **functions;  /* by id: names in the output */
    const struct source_resources *resources;
};

/* An image or buffer of the stage's programs. */
struct spell_resource {
    const struct deferred_resource *resource;
    uint32_t binding, set;
    unsigned access; /* 1 reads, 2 writes, 3 both */
};
enum { SPELL_READS = 1, SPELL_WRITES = 2 };

/* ---- struct_maker.c: functions that build structs ---- */

struct spell_maker {
    const struct lang_unit *unit;
    ir_type_id type;
    const char *type_name, *name;
    bool is_called; /* for the code that writes the maker beside the struct */
};

/* ---- The state ---- */

struct spell {
    const struct target *target;
    const struct target_frame *frame; /* of the target or its base; NULL: it has none */
    const struct spell_options *options;
    const struct shader *shader;
    const struct shader_stage *stage;
    enum shader_stage_id stage_id;
    struct arena *scratch;
    struct text *out;
    VEC(struct spell_mark) marks;        /* ascending */
    size_t verbatim_begin, verbatim_end; /* verbatim source in `out`: its lines stay unbroken */
    struct name_set names;
    struct lang_style *style; /* of the target's syntax; of halves: while a half is written */
    /* of whole floats, and of half floats where these are types; NULL: they are not */
    struct lang_style *whole_style, *half_style;
    struct lang_names lang_names; /* for the portable printer */
    /*
     * Writes a node without a local: spell_node, or spell_typed_node if the target has forms that
     * depend on types.
     */
    void (*write_node)(struct spell *spell, ir_ref ref, const struct ir_node *node,
                       enum lang_precedence least);
    /* by interface variable: its expression in this stage; NULL: the stage does not read it */
    struct spell_name *variables;
    /* by id: names of the portable functions that the stage reaches */
    const char **functions;
    const char **graph_functions; /* by index: names of IR functions */
    /* by index: indices of the variables of the interface that the function gets; NULL: none */
    struct spell_passed {
        VEC(uint32_t) variables;
    } * passed;
    const char **user_types;   /* by index in the unit: names of structs */
    struct spell_name *locals; /* by index: names of the stage's mutable variables */
    /* by node: 1 + index of the first name of its LET in let_names; 0: the node is an expression */
    uint32_t *local_of;
    VEC(struct spell_name) let_names;
    /* the struct of the results of the graph's function that is written, and their number; NULL */
    const char *graph_results;
    uint32_t num_graph_results;
    VEC(str_id) wanted_names; /* names that several locals of the function want, sorted */
    /* of a shader that is a function: its parameters are copied to file scope */
    bool shares_vertex_data;
    const char *loop_index;      /* inside LIGHTS and SAMPLES: the variable of the loop */
    struct spell_name loop_turn; /* inside SAMPLES: the variable with the sample's turn */
    struct name_set paths;       /* of the comments so far */
    VEC(const char *) helpers;   /* texts of spell_helper, each once */
    VEC(struct spell_maker) makers;
    VEC(struct spell_program) programs;
    const struct spell_program *program; /* that is being written; NULL: none */
    void *target_data;                   /* belongs to the target while its hook runs */
    uint8_t *origins_seen;               /* origins whose path is known; NULL: no comments */
    uint8_t *kinds;                      /* by node: precision.c; NULL: all values have all bits */
};

/* ---- precision.c: values that bear half floats, if the options ask for them. ---- */

/* Fills spell->kinds and the styles of halves, which the functions below read. */
void spell_find_kinds(struct spell *spell);
bool spell_is_half(const struct spell *spell, ir_ref ref);
/*
 * True if the text of the node has a type of half floats: the name of its local, or what arithmetic
 * makes of halves.
 */
bool spell_has_half_text(const struct spell *spell, ir_ref ref);
/* "mediump vec3", "vec3h" */
struct text_word spell_half_type(struct spell *spell, ir_type_id type);
/* A uniform or a texture that has the qualifier. */
bool spell_is_half_variable(const struct spell *spell, const struct shader_variable *variable);

/* ---- expression.c ---- */

/* Writes a node. Adds parentheses if it binds less tightly than `least`. */
void spell_expression(struct spell *spell, ir_ref ref, enum lang_precedence least);
void spell_value(struct spell *spell, ir_ref ref); /* for its local, which may be a half float */
void spell_node(struct spell *spell, ir_ref ref, const struct ir_node *node,
                enum lang_precedence least);
void spell_typed_node(struct spell *spell, ir_ref ref, const struct ir_node *node,
                      enum lang_precedence least);
/*
 * Writes an argument of a call: a texture, followed by its sampler if the language has separate
 * samplers.
 */
void spell_argument(struct spell *spell, ir_ref ref);
/*
 * Writes "f(a, b", the name and operands of a call without the end. Returns the number of
 * arguments.
 */
unsigned spell_call_open(struct spell *spell, ir_ref call);
struct lang_type_text spell_type_text(const struct spell *spell, ir_type_id type);
void spell_type(struct spell *spell, ir_type_id type);
/* Writes the value of a variable of the interface, whose name or path is `name`. */
void spell_read(struct spell *spell, const struct shader_variable *variable, struct text_word name,
                enum lang_precedence least);
/* Declares a variable by a phrase: "float x[3]", "var x: array<f32, 3>". */
void spell_variable(struct spell *spell, enum lang_phrase phrase, ir_type_id type,
                    struct spell_name name);

/* The name of a portable function that the current text calls. */
static inline const char *spell_function_name(const struct spell *spell, uint32_t function)
{
    return spell->lang_names.function(spell->lang_names.user_data, function);
}

/* ---- local.c ---- */

/*
 * Finds the names that several locals of a function want. Called before the function's statements.
 */
void spell_plan_locals(struct spell *spell, const struct effect_list *statements);
/* The name of a call with several results; each result adds its own name. */
struct spell_name spell_call_base(struct spell *spell, ir_ref call);
/* The name of a local before names_unique. Its operands already have their names. */
struct spell_name spell_local_base(struct spell *spell, ir_ref ref);

/* ---- statement.c ---- */

/* Begins a line, which comes from this origin of the graph (0: none). */
void spell_open_line(struct spell *spell, unsigned indent, uint32_t origin);

/* Writes the head of an `if`, up to the end of its line. */
void spell_if(struct spell *spell, unsigned indent, ir_ref condition, bool braces);

/* Writes one effect that opens no branch and closes no block; of a loop, its head. */
void spell_effect(struct spell *spell, unsigned indent, const struct effect *effect);
void spell_graph_function(struct spell *spell, const struct shader_function *function);

/* ---- block.c ---- */

/* Writes statements with this indentation. Their locals are named in a new scope. */
void spell_statements(struct spell *spell, const struct effect_list *statements, unsigned indent);

/* ---- passed.c: what functions of graphs cannot see ---- */

/* Called when the variables of the interface have their names. */
void spell_find_passed(struct spell *spell);
/* The end of a list of parameters or arguments; `is_first`: the list is empty before it. */
void spell_passed(struct spell *spell, uint32_t function, bool declares, bool is_first);

/* ---- interface_variables.c: declarations above the functions, for frames ---- */

void spell_name_interface(struct spell *spell);
/* The variable that has the variables of a block as members; NULL: there is none. */
const char *spell_instance(const struct spell *spell, enum shader_block block);
/* True if functions of the stage may read vertex data, which must then be at file scope. */
bool spell_functions_read_vertex_data(const struct spell *spell);
/* True for a function of other code, which sets the vertex data and reads the outputs. */
bool spell_is_called(const struct spell *spell);
/* True if the stage reads vertex data, or sets it. */
bool spell_reads_vertex_data(const struct spell *spell);
/*
 * True if the vertex data is at file scope, in a language whose main has it as a parameter: then
 * main copies between the two.
 */
bool spell_shares_vertex_data(const struct spell *spell);
/* Calls a function for each block of uniforms. */
void spell_uniform_blocks(struct spell *spell,
                          void (*write)(struct spell *spell, enum shader_block block));
/* Loops over the positions of a block's variables in the interface. */
#define SPELL_EACH_OF_BLOCK(i, spell, block) \
    for (uint32_t i = (spell)->shader->interface.first_of_block[block]; \
         i < (spell)->shader->interface.first_of_block[(block) + 1]; i++)
/* The variable at a position in the interface. */
const struct shader_variable *spell_interface_variable(const struct spell *spell, uint32_t place);
/* True if the stage uses the variable, or a variable of the block. */
bool spell_uses(const struct spell *spell, const struct shader_variable *variable);
bool spell_uses_block(const struct spell *spell, enum shader_block block);
/* Declares a variable of the interface by a phrase, under another name: "vec3 name[4]". */
void spell_declare(struct spell *spell, enum lang_phrase phrase,
                   const struct shader_variable *variable, struct spell_name name);
/* Writes the structs of the stage's functions. */
void spell_structs(struct spell *spell);

/* ---- program.c ---- */

void spell_find_programs(struct spell *spell); /* of the stage's calls */
void spell_program_structs(struct spell *spell);
/* Variables and functions of the programs: behind open_context. */
void spell_programs(struct spell *spell);
/*
 * The resource with the lowest binding of at least `binding`; false: there is none. Each frame
 * declares them.
 */
bool spell_resource_from(const struct spell *spell, uint32_t binding, struct spell_resource *out);
#define SPELL_EACH_RESOURCE(r, spell) \
    for (struct spell_resource r = {0}; spell_resource_from((spell), r.binding, &(r)); r.binding++)
/* The row of the target's table for a resource. */
const struct target_image *spell_image(const struct spell *spell, const struct spell_resource *r);
/* The variable that has the uniforms of passes, where blocks are variables (target.instances). */
#define SPELL_FRAME_INSTANCE "mx_uniforms"
/* The type of a member of a uniform buffer. */
ir_type_id spell_member_type(const struct deferred_member *member);
/* True if a program reads gl_FragCoord: the position among the vertex data. */
bool spell_reads_position(const struct spell *spell);
/*
 * True if depth is tested before the pixel stage, which writes images: only fragments that are
 * seen may do so.
 */
bool spell_tests_early(const struct spell *spell);
/* The name of a struct of the program that is being written. */
const char *spell_program_type(struct spell *spell, ir_type_id type);

/* ---- struct_maker.c ---- */

/* Gives a struct of the stage a maker with a name at file scope: "make_Outer". */
void spell_name_maker(struct spell *spell, ir_type_id type);
/* Gives a maker to a struct of a unit, whose name in the output is known. */
void spell_add_maker(struct spell *spell, const struct lang_unit *unit, ir_type_id type,
                     const char *type_name);
/* The maker of a struct, by the struct's name in the output; NULL: it has none. */
struct spell_maker *spell_find_maker(const struct spell *spell, const char *type_name);
/* "Outer make_Outer(vec2 a, float b) { Outer made; made.a = a; … return made; }" */
void spell_write_maker(const struct spell *spell, const struct spell_maker *maker,
                       struct text *out);

/* ---- helper.c: for the hooks `form` and `maker` of a target ---- */

struct text *spell_new_text(struct spell *spell); /* lives as long as the stage is written */
/* The form of a call: "choose($0, $1, $2)". */
const struct lang_pieces *spell_call_form(struct spell *spell, const char *text);
/* The name of the type of a result or operand of `use`. */
const char *spell_use_type(struct spell *spell, const struct lang_use *use, ir_type_id type);
/*
 * Writes `from` with names of types: $T of the result, $0, $1, … of the operands; $S of the result
 * and $A of the first operand as a part of a name.
 */
void spell_expand(struct spell *spell, const struct lang_use *use, const char *from,
                  struct text *out);
/*
 * Declares a function that the language lacks, once, above the functions of the shader. The text
 * must live as long as the stage is written.
 */
void spell_helper(struct spell *spell, const char *text);
/* Declares a helper whose text has the marks of spell_expand. */
void spell_add_helper(struct spell *spell, const struct lang_use *use, const char *declaration);
/*
 * Hook `maker` of a target whose structs have no constructors: a helper builds the struct. User
 * data is the spell.
 */
const char *spell_helper_maker(void *user_data, const char *type);
/* lang_names.array by target->array_type: a helper declares the type and builds an array. */
const char *spell_array_type(void *user_data, struct text_word element, uint32_t length);

/* ---- wrap.c ---- */

/* Breaks the long lines of spell->out from `begin` on, and moves the marks. */
void spell_wrap(struct spell *spell, size_t begin);

/* ---- stage.c ---- */

/* True if the stage reads u_lightData. */
static inline bool spell_has_light_data(const struct spell *spell)
{
    return spell->stage->has_lights && spell->shader->lights == LIGHTS_IN_SHADER;
}

/* The version of the language: that of the options, or the target's first. */
static inline const char *spell_version(const struct spell *spell)
{
    const char *version = spell->options->version;
    return version ? version : spell->target->versions[0];
}

void spell_title(struct spell *spell); /* "Gold · surfacematerial · …", without a newline */

/* Writes the stage of a C-like target: declarations, functions, main. */
void spell_stage(struct spell *spell, enum shader_stage_id stage);

/* ---- host_functions.c ---- */

/* Declares the functions of the host that the stage calls, in languages that need it. */
void spell_host_functions(struct spell *spell);
/* The member of a context whose type is a struct of the host, with its functions. */
#define SPELL_HOST_INSTANCE "mxg_host"
/* True if the stage calls functions of the host. */
bool spell_asks_host(const struct spell *spell);
/* Before the names of what the host has: "mxg_host." in a language with contexts. */
const char *spell_host_prefix(const struct spell *spell);
/* A function by name, as the stage calls it. */
const char *spell_host_name(const struct spell *spell, str_id name);

/* ---- verbatim_text.c ---- */

/* The verbatim sources of the stage and the helpers that they use, each once. */
void spell_verbatim_sources(struct spell *spell);
/*
 * Writes a text without the host's names. In the file of a function, which may have several, one
 * guard per text keeps equal texts to one.
 */
void spell_once(struct spell *spell, const char *text, size_t len);
/* Takes the names that these declare at file scope. */
void spell_take_source_names(struct spell *spell);

/* Writes "// …", the first sentence of the library's comment above a function, if there is one. */
void spell_function_doc(struct spell *spell, uint32_t function);
/* Writes the first sentence of `doc`, the comment of a function of a program. */
void spell_doc(struct spell *spell, str_id doc);

/*
 * Writes words of a document as the text of a comment. Nothing in it ends the line or joins it with
 * the next one.
 */
void spell_comment(struct spell *spell, const char *text, size_t len);
/* A name of the frame in the source: "PublicUniforms", "wood_PublicUniforms". */
static inline const char *spell_frame_name(const struct spell *spell, const char *name)
{
    return names_of_frame(spell->shader, name);
}
static inline void spell_text(struct spell *spell, const char *text)
{
    text_str(spell->out, text);
}
static inline void spell_name(struct spell *spell, struct spell_name name)
{
    text_mem(spell->out, name.text, name.len);
}
static inline struct text_word spell_word(struct spell_name name)
{
    return (struct text_word){name.text, name.len};
}
static inline struct spell_name spell_name_of(const struct strpool *strings, str_id id)
{
    return (struct spell_name){str_text(strings, id), str_len(strings, id)};
}
/* Writes several texts: SPELL(spell, "in ", name, ";\n"). */
#define SPELL(spell, ...) spell_texts((spell), (const char *const[]){__VA_ARGS__, NULL})
static inline void spell_texts(struct spell *spell, const char *const *texts)
{
    while (*texts)
        text_str(spell->out, *texts++);
}
static inline void spell_number(struct spell *spell, uint32_t number)
{
    text_u32(spell->out, number);
}
static inline void spell_indent(struct spell *spell, unsigned indent)
{
    while (indent--)
        text_mem(spell->out, "    ", 4);
}
/* Notes that the rest of the current line comes from an origin. */
static inline void spell_mark(struct spell *spell, uint32_t origin)
{
    assert(spell->marks.len == 0 || vec_last(&spell->marks).at <= spell->out->len);
    if (origin)
        vec_push(spell->scratch, &spell->marks, (struct spell_mark){spell->out->len, origin});
}
/* True if a variable of this type has a separate sampler. */
static inline bool spell_has_sampler(const struct spell *spell, ir_type_id type)
{
    return spell->target->syntax->sampler_type
           && (type == IR_TYPE_SAMPLER || type == IR_TYPE_SAMPLER_ARRAY);
}
static inline bool spell_can(const struct spell *spell, uint64_t cap)
{
    return (spell->target->caps & cap) != 0;
}

#endif
