// SPDX-License-Identifier: Apache-2.0
/*
 * The portable shading language (docs/shading-language.md): from text to typed trees, and what can
 * be done with them.
 *
 * A unit is the set of functions of one library layer. Source files are parsed and type-checked
 * once, when a library is packed; the result is flat arrays without pointers, so it is part of the
 * library image. Trees are immutable: specialising a function makes a new one in a unit of the
 * generation.
 *
 *     text ─lex→ tokens ─parse+check→ typed tree ─┬ lower:      a call becomes IR nodes
 * (straight-line code, known branches) ├ specialise: constant arguments bound, dead code dropped ├
 * evaluate:   a value └ print:      text in the language of a syntax table
 */
#ifndef MXG_LANG_LANG_H
#define MXG_LANG_LANG_H

#include "base/strpool.h"
#include "base/text.h"
#include "diag/diag.h"
#include "ir/ir.h"

/* The tree */

typedef uint32_t lang_ref; /* index of a node in its unit; 0 = none */

enum lang_kind {
    /* expressions */
    LANG_CONST,  /* a: index in unit->words; type says how many */
    LANG_VAR,    /* a: slot of a parameter or local of the function */
    LANG_GLOBAL, /* a: index in unit->globals */
    LANG_INPUT,  /* a: slot of an inline expression's {{input}} */
    /*
     * op: enum ir_op (operators and built-ins; attr in b for SWIZZLE and MEMBER); first operand a,
     * chained by next
     */
    LANG_OP,
    LANG_CALL, /* a: function id; first argument b, chained by next */
    /* statements */
    LANG_DECLARE, /* a: slot; b: initialiser or 0 */
    /*
     * a: target expression (VAR, SWIZZLE, INDEX, MEMBER of one); b: value; op: IR_NUM_OPS for =,
     * else the operator of `op=`
     */
    LANG_ASSIGN,
    LANG_EXPR, /* a: a call for its effect */
    LANG_IF,   /* a: condition; b: then block; c: else block or 0 */
    /* a: init statement or 0; b: condition or 0; c: body block, which has the step */
    LANG_FOR,
    LANG_WHILE, /* b: condition; c: body block */
    LANG_DO,    /* b: condition; c: body block */
    /* a: first statement, chained by next; b: of the body of a FOR, its step statement or 0 */
    LANG_BLOCK,
    LANG_RETURN, /* a: value or 0 */
    LANG_BREAK,
    LANG_CONTINUE,
    LANG_NUM_KINDS
};

/*
 * Which of a node's fields are its children, by kind; `next`, where it is set, is a sibling. ast.c
 */
enum lang_child_field { LANG_CHILD_A = 1, LANG_CHILD_B = 2, LANG_CHILD_C = 4 };
extern const uint8_t lang_child_fields[LANG_NUM_KINDS];

struct lang_node {
    uint8_t kind;
    uint8_t op;
    ir_type_id type; /* of an expression */
    lang_ref next;   /* next sibling: operand, argument or statement */
    uint32_t a, b, c;
};

enum lang_param_mode { LANG_IN, LANG_OUT, LANG_INOUT };

struct lang_slot { /* a parameter or local variable */
    str_id name;
    ir_type_id type;
    uint8_t mode;     /* enum lang_param_mode; of a parameter */
    uint8_t assigned; /* somebody assigns it after its declaration */
};

enum lang_function_flags {
    /* it or what it calls reads derivatives or textures with implicit level of detail */
    LANG_FN_DERIVATIVE = 1,
    LANG_FN_PURE = 2,     /* it and what it calls read no uniform, stream, option or sampler */
    LANG_FN_STRAIGHT = 4, /* no loops, nor in what it calls: may be lowered to IR whole */
    /* it has string parameters: to be specialised before it is printed for hardware */
    LANG_FN_STRINGS = 8,
    /* an inline expression: no name, LANG_INPUT slots, body is RETURN expr */
    LANG_FN_EXPRESSION = 16,
    LANG_FN_FINAL = 32, /* nothing to specialise, unless arguments or callees are: canon.c */
};

struct lang_function {
    str_id name;
    str_id doc; /* the first sentence of the comment above it; 0: none */
    uint16_t flags;
    ir_type_id return_type;
    uint16_t num_params, num_slots; /* parameters come first among the slots */
    uint32_t first_slot;            /* in unit->slots */
    lang_ref body;                  /* a BLOCK */
    uint32_t file;                  /* index in unit->files */
    uint32_t place;
    uint32_t num_nodes; /* size of the body: for inlining decisions */
    /* in unit->refs: function ids called directly, each once */
    uint32_t first_callee, num_callees;
    uint32_t first_global, num_globals; /* in unit->refs: globals read directly, each once */
    /* in unit->refs, where it is LANG_FN_FINAL: its CALL nodes, arguments first */
    uint32_t first_call, num_calls;
};

struct lang_version {    /* what a function of a generation's layer is (plan.c) */
    uint32_t origin;     /* id of the function that it was made from */
    uint32_t dropped[2]; /* bit i is set where parameter i of that is gone */
};

enum lang_global_kind {
    LANG_GLOBAL_CONST,
    LANG_GLOBAL_UNIFORM,
    LANG_GLOBAL_STREAM,
    LANG_GLOBAL_OPTION
};

struct lang_global {
    str_id name;
    uint8_t kind; /* enum lang_global_kind */
    ir_type_id type;
    /*
     * value of a CONST or OPTION of built-in or array type, in unit->words (arrays: elements in
     * order)
     */
    uint32_t words;
    uint32_t num_words;
    uint32_t array_length; /* of a uniform array; 0 = none */
    uint32_t file;
};

struct lang_file {
    str_id name;                          /* as given to the reader */
    uint32_t first_include, num_includes; /* in unit->refs: files included directly */
    /* ids of the functions that the file itself defines are contiguous */
    uint32_t first_function, num_functions;
    uint32_t first_global, num_globals;
};

struct lang_unit;

struct lang_host { /* how globals become IR nodes */
    void *user_data;
    /*
     * The IR node for a uniform or stream (by its name and type); option constants give a constant.
     */
    ir_ref (*global)(void *user_data, struct ir_graph *graph, const struct lang_unit *unit,
                     uint32_t global_id);
    /*
     * What a built-in function of textures gives where the texture is not a plain one; 0: it is
     * plain. Functions that are given such a texture, which the portable language has no name for,
     * are lowered whatever their size. May be NULL.
     */
    ir_ref (*texture)(void *user_data, enum ir_op op, const ir_ref *args);
    /*
     * the same limit for the called function itself and what it calls directly; 0: max_inline_nodes
     */
    uint32_t max_outer_nodes;
    /* functions larger than this are called, not lowered, unless their result folds to constants */
    uint32_t max_inline_nodes;
};

/*
 * A layer of functions. Function, file, global and type ids count through the layers (base first);
 * node, slot, word and ref indices are the layer's own. User type ids also count through the
 * layers.
 */
struct lang_unit {
    const struct lang_unit *base;
    struct strpool *strings;
    struct arena *arena; /* NULL in an image layer */
    /* how many the layers below have */
    uint32_t base_functions, base_files, base_globals, base_user_types;
    VEC(struct lang_node) nodes; /* [0] unused; cap 0 in an image layer */
    VEC(struct lang_slot) slots;
    VEC(struct lang_function) functions;
    VEC(struct lang_global) globals;
    VEC(struct lang_file) files;
    VEC(union ir_word) words;
    VEC(uint32_t) refs;
    VEC(struct ir_user_type) user_types;
    VEC(struct ir_member) members;
    /* Of an image layer: */
    /* where the text of each function begins, and where the last one's ends (texts.c) */
    VEC(uint32_t) texts;
    VEC(char) text_bytes;
    /* Of a generation's layer: */
    /* who knows the options, and the graph that their values are nodes of; from lang_lower_call */
    struct lang_host host;
    struct ir_graph *graph;
    VEC(struct lang_version) versions; /* by function */
    /* plan.c: which constants functions take for granted; NULL until the shader stands */
    struct lang_plan *plan;
};

void lang_unit_init(struct lang_unit *unit, struct arena *arena, struct strpool *strings,
                    const struct lang_unit *base);

/*
 * Access by id through the layers. *out_unit (may be NULL) receives the layer, which the function's
 * own indices refer to.
 */
static inline const struct lang_function *lang_function(const struct lang_unit *unit, uint32_t id,
                                                        const struct lang_unit **out_unit)
{
    while (id < unit->base_functions)
        unit = unit->base;
    if (out_unit)
        *out_unit = unit;
    return &unit->functions.items[id - unit->base_functions];
}

static inline const struct lang_global *lang_global(const struct lang_unit *unit, uint32_t id,
                                                    const struct lang_unit **out_unit)
{
    while (id < unit->base_globals)
        unit = unit->base;
    if (out_unit)
        *out_unit = unit;
    return &unit->globals.items[id - unit->base_globals];
}

static inline const struct lang_file *lang_file(const struct lang_unit *unit, uint32_t id,
                                                const struct lang_unit **out_unit)
{
    while (id < unit->base_files)
        unit = unit->base;
    if (out_unit)
        *out_unit = unit;
    return &unit->files.items[id - unit->base_files];
}

static inline const struct ir_user_type *lang_user_type(const struct lang_unit *unit,
                                                        ir_type_id type,
                                                        const struct lang_unit **out_unit)
{
    uint32_t id = (uint32_t)type - IR_TYPE_FIRST_USER;
    while (id < unit->base_user_types)
        unit = unit->base;
    if (out_unit)
        *out_unit = unit;
    return &unit->user_types.items[id - unit->base_user_types];
}

#define LANG_NONE UINT32_MAX /* no function, file… */

/* parse.c (lex.c, check.c): text to trees */

/*
 * Where source files come from: false with *out_reason set where a file cannot be read. `from` is
 * the including file or "".
 */
struct lang_reader {
    void *user_data;
    bool (*read)(void *user_data, const char *from, const char *ref, const char **out_name,
                 const char **out_text, size_t *out_len, const char **out_reason);
};

/*
 * Parses a file with its includes, each file once per unit and the layers below. LANG_NONE after
 * errors, which are in diags.
 */
uint32_t lang_parse_file(struct lang_unit *unit, const struct lang_reader *reader, const char *from,
                         const char *ref, struct diag_place where, struct diag_list *diags);

struct lang_input {
    str_id name;
    ir_type_id type;
};

/*
 * Parses an inline expression; {{name}} stands for an input. `file` (or LANG_NONE) makes its
 * functions and declarations visible. The result is a function of the unit with LANG_FN_EXPRESSION:
 * its slots are the inputs in order (all of them, used or not), its body returns the expression,
 * converted to `type`. `where` is the place of the first character. LANG_NONE after errors.
 */
uint32_t lang_parse_expression(struct lang_unit *unit, const char *text, size_t len,
                               const struct lang_input *inputs, unsigned num_inputs,
                               ir_type_id type, uint32_t file, struct diag_place where,
                               struct diag_list *diags);

/*
 * A function by name in a file and its includes; `params` (may be NULL: then the only one of that
 * name) chooses among overloads by exact types, then by implicit conversion. LANG_NONE where there
 * is none.
 */
uint32_t lang_find_function(const struct lang_unit *unit, uint32_t file, str_id name,
                            const ir_type_id *params, unsigned num_params);

/* lower.c: calls into IR */

/*
 * Builds a call of function `id`: args are one IR node per `in`/`inout` parameter in order (for
 * expressions: per input; a ref of 0 means the input is absent and must not be read). results
 * receives the returned value, if any, then each `out`/`inout` parameter. Straight-line code and
 * branches that are known or can be merged by SELECT become nodes; all-constant calls are
 * evaluated; anything else becomes a CALL with all its arguments, which lang_plan_call is told when
 * the shader stands. Writes num_results (lang_num_results) refs. Never fails: POISON after an
 * error. `generated` is the unit of the generation: versions of functions go there; its base is the
 * library's unit.
 */
void lang_lower_call(struct lang_unit *generated, struct ir_graph *graph,
                     const struct lang_host *host, uint32_t id, const ir_ref *args,
                     ir_ref *results);
unsigned lang_num_results(const struct lang_unit *unit, uint32_t id);

/*
 * plan.c (specialise.c): one version per function for a whole shader. First lang_plan_call for
 * every call in the IR, then lang_plan_finish, then lang_plan_version of what each lang_plan_call
 * returned.
 *
 * A version has some parameters bound to constants: those that all calls agree on, and strings and
 * flags, which choose what a function is, so that calls with others get versions of their own.
 * Options have their values. Code is folded, branches that are never taken, locals and assignments
 * nobody needs are dropped, small functions put in place of their calls. Bound parameters are gone,
 * and `in` parameters that turn out to be unused: whoever calls a version passes what
 * lang_param_dropped leaves. The version is the function itself where nothing changes.
 */
/* a constant's words, or NULL */
uint32_t lang_plan_call(struct lang_unit *generated, uint32_t id, const union ir_word *const *args);
void lang_plan_finish(struct lang_unit *generated);
uint32_t lang_plan_version(const struct lang_unit *generated, uint32_t call);

/* Is parameter `index` of the function that was given to lang_plan_call gone from its version? */
bool lang_param_dropped(const struct lang_unit *generated, uint32_t version, uint32_t given,
                        unsigned index);

/*
 * canon.c: replaces the trees of a layer's functions by what specialising makes of them where
 * nothing is known of their arguments. For a library, once everything that is parsed for it has
 * been; no generation may use it yet.
 */
void lang_make_canonical(struct lang_unit *unit);
/* eval.c */

/*
 * Calls a function with constant arguments (built-in types; samplers not allowed). false where it
 * reads a uniform, stream or texture, runs for more than `max_steps`, or hits undefined behaviour.
 * results as for lang_lower_call.
 */
bool lang_eval_call(const struct lang_unit *unit, uint32_t id, const struct ir_value *args,
                    struct ir_value *results, uint32_t max_steps, struct arena *scratch);

/* reach.c */

/*
 * Adds to `functions` (ids, callees before callers, each once) what function `id` needs, itself
 * last, and to `globals` what these read.
 */
struct lang_reach {
    struct arena *arena;
    VEC(uint32_t) functions, globals;
    VEC(ir_type_id) user_types; /* structs used in signatures and locals, in order of need */
    uint8_t *seen_functions, *seen_globals, *seen_types;
    uint32_t cap_functions, cap_globals, cap_types;
};
void lang_reach_add(struct lang_reach *reach, const struct lang_unit *unit, uint32_t id);

/*
 * print.c: trees as text. One printer for all C-like targets, driven by a table; the IR's
 * expressions use the same forms.
 */

/* binds tighter as it grows; an operand is parenthesised when its own is lower */
enum lang_precedence {
    LANG_PREC_COMMA,
    LANG_PREC_ASSIGN,
    LANG_PREC_TERNARY,
    LANG_PREC_LOR,
    LANG_PREC_LXOR,
    LANG_PREC_LAND,
    LANG_PREC_OR,
    LANG_PREC_XOR,
    LANG_PREC_AND,
    LANG_PREC_EQUAL,
    LANG_PREC_COMPARE,
    LANG_PREC_SHIFT,
    LANG_PREC_SUM,
    LANG_PREC_PRODUCT,
    LANG_PREC_UNARY,
    LANG_PREC_POSTFIX,
    LANG_PREC_PRIMARY
};

/*
 * How a target spells one op: "$0 * $1" with $0…$3 the operands, $T the result type's name.
 * `precedence` is the form's own. An operand between parentheses, brackets or commas needs none;
 * else those of `infix` forms ("$0 op $1") associate to the left,
 * `?:` to the right, and operands of anything else ("-$0", "$0[$1]", "$0 - $1 * floor($0 / $1)")
 * must be postfix expressions. CONSTRUCT ("$T(operands)"), SWIZZLE, MEMBER and calls have no form.
 */
struct lang_form {
    const char *text;   /* NULL: the target cannot spell it */
    uint8_t precedence; /* enum lang_precedence */
    bool infix;
};

struct lang_style;

struct lang_syntax {
    const char *name; /* "glsl" */
    /* rows absent here come from there; NULL for the portable form itself */
    const struct lang_syntax *base;
    const char *const *type_names; /* [IR_NUM_TYPES], NULL entries: from base */
    const struct lang_form *forms; /* [IR_NUM_OPS], text NULL: from base */
    /*
     * [IR_NUM_OPS], text NULL: from `forms`. The forms of a shader that knows no neighbours on the
     * screen, as vertex stages do not; NULL: from base.
     */
    const struct lang_form *forms_alone;
    const char *const *reserved; /* identifiers that must be renamed, sorted by byte value */
    uint32_t num_reserved;
    /* prefix of a parameter that is never assigned: "const " in GLSL, "" elsewhere */
    const char *param_in;
    const char *param_in_assigned;       /* prefix of one that is: "" in GLSL */
    const char *param_out, *param_inout; /* "out ", "inout "; OSL: "output " */
    /* parameters are read-only: one that is assigned is copied to a local first */
    bool copies_params;
    bool plain_scalars; /* neither bool nor uint: their literals are those of int */
    /* no variables at file scope: "#define X 1.0"; arrays are declared in functions */
    bool defines_constants;
    const char *constant;            /* prefix of a constant at file scope: "const " */
    bool float_literals_need_suffix; /* 1.0f */
    bool wide_constants;             /* max(v, vec3(0.0)), where a target has max(v, 0.0), too */
    bool array_braces;               /* arrays are built as {a, b}, not float[2](a, b) */
    /*
     * The type of a sampler that stands beside each texture, "SamplerState t_sampler" beside
     * "Texture2D t", also among parameters and arguments; NULL: textures are samplers.
     */
    const char *sampler_type;
    bool sizes_count_layers; /* the size of a texture array has the number of layers behind it */
    /* library images hold functions as text in it: of one syntax, which others may take over */
    bool in_images;
    /* what a pixel learns of its neighbours is spelled otherwise than in those texts */
    bool without_neighbours;
    /*
     * Writes a literal of a type that the language lacks; false: it is written like the others.
     * NULL: there is no such type.
     */
    bool (*write_value)(const struct lang_style *style, ir_type_id type, const union ir_word *words,
                        struct text *out);
};

const struct lang_form *lang_syntax_form(const struct lang_syntax *syntax, enum ir_op op);
const struct lang_form *lang_syntax_forms_alone(const struct lang_syntax *syntax);
const char *lang_syntax_type(const struct lang_syntax *syntax, ir_type_id type);
bool lang_syntax_is_reserved(const struct lang_syntax *syntax, const char *name, size_t len);

/*
 * style.c: a syntax made ready to print much in it, with the rows of its bases at hand and its
 * forms taken apart.
 */

enum { LANG_MAX_PIECES = 9, LANG_PIECE_TYPE = 255 };

/* A form as characters, operand, characters, operand … characters. */
struct lang_pieces {
    const char *text;   /* of the form; NULL: the target cannot spell it */
    uint8_t precedence; /* enum lang_precedence */
    bool infix;
    bool spreads; /* constants beside a vector are written as vectors */
    uint8_t num;  /* how many operands */
    struct lang_piece {
        uint8_t index; /* of the operand, or LANG_PIECE_TYPE for the type's name */
        uint8_t least; /* precedence that the operand needs */
        struct text_word before;
    } pieces[LANG_MAX_PIECES];
    struct text_word rest; /* behind the last */
};

struct lang_style {
    const struct lang_syntax *syntax;
    struct arena *arena;
    bool from_images; /* functions are taken from there, where they are */
    struct text_word types[IR_NUM_TYPES];
    struct lang_pieces *forms[IR_NUM_OPS]; /* each is made when it is first asked for */
};

void lang_style_init(struct lang_style *style, const struct lang_syntax *syntax,
                     struct arena *arena);
const struct lang_pieces *lang_style_split(struct lang_style *style, enum ir_op op);
/* out->text NULL for no form */
void lang_form_split(const struct lang_form *form, struct lang_pieces *out);
static inline const struct lang_pieces *lang_style_form(struct lang_style *style, enum ir_op op)
{
    return style->forms[op] ? style->forms[op] : lang_style_split(style, op);
}
/* An op at hand, for targets whose spelling depends on types. */
struct lang_use {
    enum ir_op op;
    ir_type_id type;
    uint32_t attr;              /* of SWIZZLE and MEMBER, as in struct ir_node */
    const ir_type_id *operands; /* their types */
    unsigned num_operands;
    /* bit i: operand i is a variable, or something else that may be written twice */
    uint32_t named;
    ir_ref node; /* of the graph; 0 in a tree */
};

/*
 * How names of functions, globals and user types appear in the output; the strings live at least as
 * long as the printing. A callback of NULL, or one that returns NULL, stands for the name in the
 * source.
 */
struct lang_names {
    void *user_data;
    /* Told of each built-in type whose name is written; may be NULL. */
    void (*type)(void *user_data, ir_type_id type);
    const char *(*function)(void *user_data, uint32_t id);
    const char *(*global)(void *user_data, uint32_t id);
    const char *(*user_type)(void *user_data, ir_type_id type);
    /*
     * The function that puts a struct together, by the struct's name in the output; NULL: its
     * constructor.
     */
    const char *(*maker)(void *user_data, const char *type);
    /*
     * The form of an op, CONSTRUCT, SWIZZLE and INDEX included, where types decide; NULL: the
     * syntax's own.
     */
    const struct lang_pieces *(*form)(void *user_data, const struct lang_use *use);
};

extern const struct lang_syntax lang_syntax_portable; /* prints what the parser reads */

/* `names` may be NULL below: the names of the source. */
void lang_print_type(const struct lang_style *style, const struct lang_names *names,
                     const struct lang_unit *unit, ir_type_id type, struct text *out);
/*
 * A member's name in the output: an underscore follows a word of the language. Built-in functions
 * are none here, since a member hides nothing.
 */
const char *lang_member_name(const struct lang_style *style, const struct strpool *strings,
                             str_id name);
/* Ends the name of the sampler that stands beside a texture. No other name ends so. */
#define LANG_SAMPLER_SUFFIX "_sampler"
/* "float x[3]": a variable with its type. */
void lang_print_variable(const struct lang_style *style, const struct lang_names *names,
                         const struct lang_unit *unit, ir_type_id type, const char *name,
                         struct text *out);
/*
 * vec3(1.0) when equal; `strings` may be NULL where the value is not a string. In parentheses where
 * `least` asks for them: -1.0.
 */
void lang_print_value(const struct lang_style *style, const struct strpool *strings,
                      ir_type_id type, const union ir_word *words, enum lang_precedence least,
                      struct text *out);
void lang_print_function(struct lang_style *style, const struct lang_names *names,
                         const struct lang_unit *unit, uint32_t id, struct text *out);
/*
 * texts.c: the texts of a unit's functions, in memory of the arena; they are then written as they
 * stand in styles of that syntax.
 */
void lang_make_texts(struct lang_unit *unit, const struct lang_syntax *syntax, struct arena *arena);
/* "const float PI = 3.14;", and "struct S {…};", each with its newline. */
void lang_print_constant(const struct lang_style *style, const struct lang_names *names,
                         const struct lang_unit *unit, uint32_t global_id, struct text *out);
void lang_print_struct(const struct lang_style *style, const struct lang_names *names,
                       const struct lang_unit *unit, ir_type_id type, struct text *out);

#endif
