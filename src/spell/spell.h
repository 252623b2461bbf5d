// SPDX-License-Identifier: Apache-2.0
/*
 * Inside the speller: the state of one stage's output, and what its files offer each other and the
 * targets' hooks.
 */
#ifndef MXG_SPELL_SPELL_H
#define MXG_SPELL_SPELL_H

#include "shader/names.h"
#include "spell/target.h"

/* ---- maker.c: functions that put structs together ---- */

struct spell_maker {
    ir_type_id type;
    const char *type_name, *name;
    bool is_called; /* for who writes it beside the struct */
};

/* ---- The state ---- */

struct spell {
    const struct target *target;
    const struct target_frame *frame; /* the target's or its base's; NULL: there is none */
    const struct spell_options *options;
    const struct shader *shader;
    const struct shader_stage *stage;
    enum shader_stage_id stage_id;
    struct arena *scratch;
    struct text *out;
    VEC(struct spell_mark) marks;        /* ascending */
    size_t verbatim_begin, verbatim_end; /* source of the document in `out`: no line is broken */
    bool blocks;                         /* uniforms stand in blocks */
    struct name_set names;
    struct lang_style *style;     /* of the target's syntax */
    struct lang_names lang_names; /* for the portable printer */
    /*
     * Writes a node that has no local: spell_node, or spell_typed_node where the target has forms
     * of its own by type.
     */
    void (*write_node)(struct spell *spell, ir_ref ref, const struct ir_node *node,
                       enum lang_precedence least);
    /* how each interface variable is read in this stage; NULL: it is not */
    struct spell_name *variables;
    const char **functions;       /* names of portable functions by id, of those that are reached */
    const char **graph_functions; /* names of IR functions by index */
    const char **user_types;      /* names of structs by index, of the unit */
    struct spell_name *locals;    /* names of the stage's mutable variables */
    /* node of a LET to its first name in let_names, + 1; 0: it is an expression */
    uint32_t *local_of;
    VEC(struct spell_name) let_names;
    VEC(str_id) wanted_names;  /* of the function's locals, sorted */
    const char *loop_index;    /* in LIGHTS and SAMPLES: the loop's variable */
    struct name_set paths;     /* shown in comments so far */
    VEC(const char *) helpers; /* spell_helper */
    VEC(struct spell_maker) makers;
    void *target_data;     /* the target's own, while its hook runs */
    uint8_t *origins_seen; /* origins whose path was asked for; NULL: no comments */
};

/* ---- expression.c ---- */

/* Writes a node so that it binds at least as tightly as `least`. */
void spell_expression(struct spell *spell, ir_ref ref, enum lang_precedence least);
void spell_node(struct spell *spell, ir_ref ref, const struct ir_node *node,
                enum lang_precedence least);
void spell_typed_node(struct spell *spell, ir_ref ref, const struct ir_node *node,
                      enum lang_precedence least);
/* An argument of a call: a texture with its sampler, where the language has these apart. */
void spell_argument(struct spell *spell, ir_ref ref);
/*
 * "f(a, b": the name and operands of a call, unfinished. Returns how many arguments were written.
 */
unsigned spell_call_open(struct spell *spell, ir_ref call);
void spell_type(struct spell *spell, ir_type_id type);
/* "float x[3]" */
void spell_variable(struct spell *spell, ir_type_id type, struct spell_name name);

/* The name of a portable function, which the text at hand calls. */
static inline const char *spell_function_name(const struct spell *spell, uint32_t function)
{
    return spell->lang_names.function(spell->lang_names.user_data, function);
}

/* ---- local.c ---- */

/* Before a function's statements: which names several of its locals want. */
void spell_plan_locals(struct spell *spell, const struct effect_list *statements);
/* The name of a call with several results, each of which adds its own. */
struct spell_name spell_call_base(struct spell *spell, ir_ref call);
/* What a local is called, before names_unique; its operands have their names already. */
struct spell_name spell_local_base(struct spell *spell, ir_ref ref);

/* ---- statement.c ---- */

/* Statements with the given indentation, which name their locals in a new scope. */
void spell_statements(struct spell *spell, const struct effect_list *statements, unsigned indent);
void spell_graph_function(struct spell *spell, const struct shader_function *function);

/* ---- declare.c: what frames need to declare what stands above the functions ---- */

void spell_name_interface(struct spell *spell);
/* Loops over the places in the interface of a block's variables. */
#define SPELL_EACH_OF_BLOCK(i, spell, block) \
    for (uint32_t i = (spell)->shader->first_of_block[block]; \
         i < (spell)->shader->first_of_block[(block) + 1]; i++)
/* The variable at a place in the interface. */
const struct shader_variable *spell_interface_variable(const struct spell *spell, uint32_t place);
/* Does the stage use the variable; or one of the block's? */
bool spell_uses(const struct spell *spell, const struct shader_variable *variable);
bool spell_uses_block(const struct spell *spell, enum shader_block block);
/* "vec3 name[4]": a variable with its type, under a name that may differ from its own. */
void spell_declare(struct spell *spell, const struct shader_variable *variable,
                   struct spell_name name);
/* The structs of the stage's functions. */
void spell_structs(struct spell *spell);

/* ---- maker.c ---- */

/* Gives a struct of the stage a maker, which is named at file scope: "make_Outer". */
void spell_name_maker(struct spell *spell, ir_type_id type);
/* By the struct's name in the output; NULL: it has none. */
struct spell_maker *spell_find_maker(const struct spell *spell, const char *type_name);
/* "Outer make_Outer(vec2 a, float b) { Outer made; made.a = a; … return made; }" */
void spell_write_maker(const struct spell *spell, const struct spell_maker *maker,
                       struct text *out);

/* ---- wrap.c ---- */

/* Breaks the long lines of spell->out from `begin` on; marks move along. */
void spell_wrap(struct spell *spell, size_t begin);

/* ---- stage.c ---- */

/*
 * A function of the text that the language lacks, declared once above those of the shader. Texts
 * live as long as the stage is written.
 */
void spell_helper(struct spell *spell, const char *text);
void spell_title(struct spell *spell); /* "Gold · surfacematerial · …", without a newline */

/* The stage of C-like targets: declarations, functions, main. */
void spell_stage(struct spell *spell, enum shader_stage_id stage);

/* ---- source.c ---- */

/* The verbatim sources of the stage and the helpers that they use, each once. */
void spell_verbatim_sources(struct spell *spell);
/* Takes the names that these declare at file scope. */
void spell_take_source_names(struct spell *spell);

/* "// …": the first sentence that the library has on a function; may write nothing. */
void spell_function_doc(struct spell *spell, uint32_t function);

/*
 * The text of a comment, of a document's words: nothing in it ends the line or joins it with the
 * next one.
 */
void spell_comment(struct spell *spell, const char *text, size_t len);
static inline void spell_text(struct spell *spell, const char *text)
{
    text_str(spell->out, text);
}
static inline void spell_name(struct spell *spell, struct spell_name name)
{
    text_mem(spell->out, name.text, name.len);
}
static inline struct spell_name spell_name_of(const struct strpool *strings, str_id id)
{
    return (struct spell_name){str_text(strings, id), str_len(strings, id)};
}
/* Several texts in a row: SPELL(spell, "in ", name, ";\n"). */
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
/* Notes that what follows on the line at hand comes from an origin. */
static inline void spell_mark(struct spell *spell, uint32_t origin)
{
    assert(spell->marks.len == 0 || vec_last(&spell->marks).at <= spell->out->len);
    if (origin)
        vec_push(spell->scratch, &spell->marks, (struct spell_mark){spell->out->len, origin});
}
/* Does a sampler of its own belong to what has this type? */
static inline bool spell_has_sampler(const struct spell *spell, ir_type_id type)
{
    return spell->target->syntax->sampler_type
           && (type == IR_TYPE_SAMPLER || type == IR_TYPE_SAMPLER_ARRAY);
}
static inline bool spell_can(const struct spell *spell, uint32_t cap)
{
    return (spell->target->caps & cap) != 0;
}

#endif
