// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_PRINT_PRINT_H
#define MXG_PRINT_PRINT_H

#include "base/text.h"
#include "tree/precedence.h"
#include "tree/tree.h"

/*
 * print.c: trees as text. A table of a language drives one printer for all C-like targets. The
 * expressions of the IR use the same forms.
 */

/*
 * The spelling of an op in a target: "$0 * $1", with $0…$3 for the operands and $T for the name of
 * the result's type. `precedence` belongs to the form. An operand between parentheses, brackets or
 * commas needs no parentheses. The operands of `infix` forms ("$0 op $1") associate to the left,
 * and those of `?:` to the right. All other operands ("-$0", "$0[$1]", "$0 - $1 * floor($0 / $1)")
 * must be postfix expressions. CONSTRUCT ("$T(operands)"), SWIZZLE, MEMBER and calls have no form.
 */
struct lang_form {
    const char *text;   /* NULL: the target cannot spell it */
    uint8_t precedence; /* enum lang_precedence */
    bool infix;
};

/*
 * Phrases: texts of a language with $T for the name of a type, $N for a name, $V for a value, $P
 * for parameters, $L for a length, and $0…$2 for operands.
 */
enum lang_phrase {
    /* the length of an array follows the name, if the language has no PHRASE_ARRAY */
    PHRASE_PLAIN,          /* type and name alone, in a declaration of a frame: "$T $N" */
    PHRASE_LOCAL,          /* "$T $N", "var $N: $T" */
    PHRASE_LOCAL_CONSTANT, /* a local with a constant value: "const $T $N" */
    PHRASE_VALUE,          /* a local that keeps its first value: "$T $N", "let $N: $T" */
    PHRASE_CONSTANT,       /* at file scope: "const $T $N = $V;", "#define $N $V" */
    PHRASE_VARIABLE,       /* at file scope: "$T $N", "static $T $N" */
    PHRASE_MEMBER,         /* of a struct: "$T $N;" */
    PHRASE_STRUCT_END,     /* "};" */
    PHRASE_PARAM_IN,       /* without assignments: "const $T $N" */
    PHRASE_PARAM_ASSIGNED, /* an input with assignments */
    PHRASE_PARAM_OUT,      /* "out $T $N", "$N: ptr<function, $T>" */
    PHRASE_PARAM_INOUT,
    PHRASE_FUNCTION,   /* the head of a function: "$T $N($P)" */
    PHRASE_PROCEDURE,  /* the head of a function without a result: "void $N($P)" */
    PHRASE_ARRAY,      /* the type of an array: "array<$T, $L>"; NULL: lengths follow names */
    PHRASE_REFERENCE,  /* an argument for a result: "$0", "&$0" */
    PHRASE_REFERENCED, /* such a parameter in its function: "$0", "(*$0)" */
    PHRASE_FOR,        /* "for ($0; $1; $2)" */
    PHRASE_WHILE,      /* "while ($0)" */
    PHRASE_DO,         /* the line before the body: "do {" */
    PHRASE_DO_END,     /* the line after it: "} while ($0);" */
    PHRASE_INCREMENT,  /* "++$0" */
    PHRASE_DECREMENT,  /* "--$0" */
    PHRASE_DISCARD,    /* ends a pixel without a result: "discard" */
    NUM_PHRASES
};

struct lang_style;

struct lang_syntax {
    const char *name; /* "glsl" */
    /* has the rows that are absent here; NULL for the portable syntax */
    const struct lang_syntax *base;
    const char *const *type_names; /* [IR_NUM_TYPES], NULL entries: from base */
    /*
     * [IR_NUM_TYPES]: the types of half floats, to which values are converted. NULL: from base. If
     * no base has them, declarations have the qualifier mediump.
     */
    const char *const *half_types;
    const char *const *phrases;    /* [NUM_PHRASES], NULL entries: from base */
    const struct lang_form *forms; /* [IR_NUM_OPS], text NULL: from base */
    /*
     * [IR_NUM_OPS], text NULL: from `forms`. The forms for a shader without neighbours on the
     * screen, for example a vertex stage. NULL: from base.
     */
    const struct lang_form *forms_alone;
    const char *const *reserved; /* identifiers that must be renamed, sorted by byte value */
    uint32_t num_reserved;
    const char *reserved_prefix; /* no identifier begins with it; NULL: none */
    bool begins_with_letter;     /* an identifier; otherwise it may begin with '_' */
    uint8_t argument_level;      /* the precedence that an argument needs; 0: LANG_PREC_ASSIGN */
    /* parameters are read-only: an assigned parameter is copied to a local first */
    bool copies_params;
    bool plain_scalars; /* the language has no bool and uint: their literals are int literals */
    /*
     * functions have no parameters for results: they return a struct of all results, which stands
     * above the function (results.c). Needs a reserved_prefix.
     */
    bool results_in_struct;
    bool arrays_are_local;    /* functions declare the constant arrays that they read */
    bool one_per_declaration; /* "float x, y;" is two declarations */
    bool always_braces;       /* also around a single statement */
    bool no_directives; /* nor prototypes: declarations stand in any order, and once in a file */
    const char *float_suffix, *half_suffix; /* of literals: 1.0f, 1.0h; NULL: none */
    const char *infinity, *nan;             /* expressions, the highest precedence (docs/ir.md) */
    /* max(v, vec3(0.0)), although the language also has max(v, 0.0) */
    bool wide_constants;
    bool lists_components; /* vec3(1.0, 1.0, 1.0), because the language has no vec3(1.0) */
    /* array constructors are {a, b} instead of float[2](a, b); behind PHRASE_ARRAY, if there is one
     */
    bool array_braces;
    bool struct_braces; /* a struct is made so: "S{a, b}" */
    /*
     * Constructors take as many components as they need: v.xy for vec2(v), and a product with the
     * identity for mat3(x).
     */
    bool exact_constructors;
    /* a vector of a scalar: "($T)$0"; text NULL: the constructor */
    struct lang_form splat;
    /*
     * The type of a boolean in a block of uniforms, and the form of its value: "uint", "$0 != 0u".
     * NULL: a block has booleans.
     */
    const char *block_bool;
    struct lang_form block_bool_value;
    /*
     * The type of the sampler beside each texture, "SamplerState t_sampler" beside "Texture2D t",
     * also among parameters and arguments. NULL: textures are samplers.
     */
    const char *sampler_type;
    bool sizes_count_layers; /* the size of a texture array ends with the number of layers */
    /* library images contain the text of functions in this syntax, which other syntaxes may use */
    bool in_images;
    /* reads of neighbouring pixels differ from the texts in library images */
    bool without_neighbours;
    /*
     * Writes a literal of a type that the language lacks. false: the type has ordinary literals.
     * NULL: the language lacks no type.
     */
    bool (*write_value)(const struct lang_style *style, ir_type_id type, const union ir_word *words,
                        struct text *out);
};

/* The precedence that an argument of a call needs. */
static inline enum lang_precedence lang_argument_level(const struct lang_syntax *syntax)
{
    return syntax->argument_level ? (enum lang_precedence)syntax->argument_level : LANG_PREC_ASSIGN;
}
const struct lang_form *lang_syntax_form(const struct lang_syntax *syntax, enum ir_op op);
const struct lang_form *lang_syntax_forms_alone(const struct lang_syntax *syntax);
const char *lang_syntax_type(const struct lang_syntax *syntax, ir_type_id type);
const char *lang_syntax_phrase(const struct lang_syntax *syntax, enum lang_phrase phrase);
/* The prefix of a name as which no identifier begins: "x"; "": it needs none. */
const char *lang_syntax_beginning(const struct lang_syntax *syntax, const char *name);
bool lang_syntax_is_reserved(const struct lang_syntax *syntax, const char *name, size_t len);

/* style.c: a syntax prepared for printing, with the rows of its bases and with parsed forms. */

enum { LANG_MAX_PIECES = 9, LANG_PIECE_TYPE = 255 };

/* A parsed form: characters, operand, characters, operand, …, characters. */
struct lang_pieces {
    const char *text;   /* the form; NULL: the target cannot spell the op */
    uint8_t precedence; /* enum lang_precedence */
    bool infix;
    bool spreads; /* a constant beside a vector is written as a vector */
    uint8_t num;  /* number of operands */
    uint16_t op;  /* enum ir_op; IR_NUM_OPS: the form was made at run time */
    struct lang_piece {
        uint8_t index; /* index of the operand, or LANG_PIECE_TYPE for the name of the type */
        uint8_t least; /* the precedence that the operand needs */
        bool joins;    /* an operand that has the op of the form needs no parentheses */
        struct text_word before;
    } pieces[LANG_MAX_PIECES];
    struct text_word rest; /* characters after the last operand */
};

/* The precedence that an operand needs which has this op; IR_NUM_OPS: it is no operation. */
static inline enum lang_precedence lang_least(const struct lang_pieces *form,
                                              const struct lang_piece *piece, unsigned op)
{
    return (enum lang_precedence)(piece->joins && op == form->op ? form->precedence : piece->least);
}

/* True for the form "$0", whose text is that of its operand, with parentheses where that needs
 * them. */
static inline bool lang_is_operand(const struct lang_pieces *form)
{
    return form->num == 1 && !form->pieces[0].before.len && !form->rest.len
           && form->pieces[0].index != LANG_PIECE_TYPE;
}

struct lang_style {
    const struct lang_syntax *syntax;
    struct arena *arena;
    bool from_images;         /* copy the text of functions from library images */
    const char *float_suffix; /* of literals; "" */
    const char *exports;      /* before functions and structs that other files see: "export "; "" */
    struct text_word types[IR_NUM_TYPES];
    const char *phrases[NUM_PHRASES];
    struct lang_pieces *forms[IR_NUM_OPS]; /* parsed forms, each on first use */
};

void lang_style_init(struct lang_style *style, const struct lang_syntax *syntax,
                     struct arena *arena);
/* A style whose floats are the half floats of the language; NULL: it has no such types. */
struct lang_style *lang_style_of_halves(const struct lang_style *style, struct arena *arena);
const struct lang_pieces *lang_style_split(struct lang_style *style, enum ir_op op);
/* a form made at run time, which lives as long as the arena */
const struct lang_pieces *lang_form_of(struct arena *arena, const char *text,
                                       enum lang_precedence precedence);
static inline const struct lang_pieces *lang_style_form(struct lang_style *style, enum ir_op op)
{
    return style->forms[op] ? style->forms[op] : lang_style_split(style, op);
}
/* The use of an op, for targets whose spelling depends on types. */
struct lang_use {
    enum ir_op op;
    ir_type_id type;
    uint32_t attr;              /* of SWIZZLE and MEMBER, as in struct ir_node */
    const ir_type_id *operands; /* types of the operands */
    unsigned num_operands;
    /* the values of operands that are constants, NULL of others; NULL: nobody knows */
    const union ir_word *const *constants;
    /*
     * SWIZZLE or INDEX as the target of an assignment: the last operand is the new value of the
     * parts, and the form is the whole with this value. NULL: the language assigns parts.
     * IR_NUM_OPS: the variable is in its own new value, the operand, and the form is this value.
     * NULL: as it is.
     */
    bool is_store;
    /* bit i: the text may repeat operand i, for example a variable */
    uint32_t named;
    ir_ref node; /* the graph's node; 0 in a tree */
};

/*
 * The names of functions, globals and user types in the output. The strings must live as long as
 * the printing. If a callback is NULL or returns NULL, the name is the name in the source.
 */
struct lang_names {
    void *user_data;
    /* Receives each built-in type whose name is written; may be NULL. */
    void (*type)(void *user_data, ir_type_id type);
    const char *(*function)(void *user_data, uint32_t id);
    const char *(*global)(void *user_data, uint32_t id);
    const char *(*user_type)(void *user_data, ir_type_id type);
    /*
     * The function that builds a struct, by the struct's name in the output; NULL: its constructor
     * does.
     */
    const char *(*maker)(void *user_data, const char *type);
    /*
     * For a language whose arrays are no values (PHRASE_ARRAY is NULL): the name of the type of an
     * array, for the result of a function; with "make_" before it the function that builds one. By
     * the name of the element in the output. NULL: the language has array constructors.
     */
    const char *(*array)(void *user_data, struct text_word element, uint32_t length);
    /*
     * The form of an op, also of CONSTRUCT, SWIZZLE and INDEX, for languages where types decide it;
     * NULL: the form of the syntax.
     */
    const struct lang_pieces *(*form)(void *user_data, const struct lang_use *use);
};

/*
 * Constant expressions of GLSL: a literal beyond the range of float is infinity (GLSL 4.60 section
 * 4.1.4), and IEEE 754 defines 0 / 0.
 */
#define LANG_INFINITY "1e39"
#define LANG_NAN "(0.0 / 0.0)"

extern const struct lang_syntax lang_syntax_portable; /* prints the portable language */

/* `names` may be NULL below: then the source has the names. */
void lang_print_type(const struct lang_style *style, const struct lang_names *names,
                     const struct lang_unit *unit, ir_type_id type, struct text *out);
/*
 * A member's name in the output: a reserved word of the language gets an underscore. Names of
 * built-in functions are free, because a member hides nothing.
 */
const char *lang_member_name(const struct lang_style *style, const struct strpool *strings,
                             str_id name);
/* The suffix of the sampler beside a texture. No other name has it. */
#define LANG_SAMPLER_SUFFIX "_sampler"

/* results.c: functions of languages with results_in_struct, whose results are a struct. */

/* Between the name of a module and that of its function: "mxgen::f". */
#define LANG_OF_MODULE "::"
/*
 * "mdl_results_f", "mxgen::mdl_results_f": the struct of the results of a function, by its name in
 * the output.
 */
const char *lang_results_name(const struct lang_syntax *syntax, const char *function,
                              struct arena *arena);
/* The member of the value that the function returns in the portable language. */
#define LANG_RESULTS_VALUE "value"
/* True if a portable function returns such a struct. */
bool lang_has_results(const struct lang_syntax *syntax, const struct lang_unit *unit, uint32_t id);

/* declare.c: declarations by the phrases of the syntax. */

/* The name of a type, or of the type of an array's elements, with the length of the array or 0. */
struct lang_type_text {
    struct text_word name;
    uint32_t length;
};
struct lang_type_text lang_type_text(const struct lang_style *style, const struct lang_names *names,
                                     const struct lang_unit *unit, ir_type_id type);
/* The name of a built-in type, which names->type receives. */
static inline struct text_word lang_type_name(const struct lang_style *style,
                                              const struct lang_names *names, ir_type_id type)
{
    assert(type < IR_NUM_TYPES);
    if (names && names->type)
        names->type(names->user_data, type);
    return style->types[type];
}
/* "float[3]", "array<f32, 3>" */
void lang_put_type(const struct lang_style *style, struct lang_type_text type, struct text *out);

/* A declaration while it is written. */
struct lang_declaration {
    const char *rest; /* of the phrase */
    struct lang_type_text type;
    struct text_word name;
};
/* Writes the phrase up to $V or $P, which the caller writes; or to its end. */
void lang_declare(const struct lang_style *style, struct lang_declaration *declaration,
                  struct text *out);
/* Begins a declaration: lang_declare writes what follows $V or $P. */
static inline struct lang_declaration lang_open(const struct lang_style *style,
                                                enum lang_phrase phrase, struct lang_type_text type,
                                                struct text_word name, struct text *out)
{
    struct lang_declaration declaration = {style->phrases[phrase], type, name};
    lang_declare(style, &declaration, out);
    return declaration;
}
/*
 * Writes a phrase up to its next '$' and moves *phrase past the letter, which it returns; '\0': the
 * phrase is at its end.
 */
char lang_next(const char **phrase, struct text *out);
/* Writes a phrase with one operand. */
void lang_put_phrase(const char *phrase, struct text_word operand, struct text *out);
/* ", SamplerState t_sampler" after the parameter of a texture, if textures have separate samplers.
 */
void lang_put_sampler(const struct lang_style *style, struct text_word texture, struct text *out);
/* A variable of a unit's type. */
void lang_print_variable(const struct lang_style *style, const struct lang_names *names,
                         const struct lang_unit *unit, enum lang_phrase phrase, ir_type_id type,
                         struct text_word name, struct text *out);
static inline struct text_word lang_word(const char *text)
{
    return (struct text_word){text, strlen(text)};
}

/*
 * convert.c: the form of a conversion or a constructor in a language with its own splat or with
 * exact constructors; NULL: the form of the syntax. The form lives as long as the arena.
 */
const struct lang_pieces *lang_conversion(const struct lang_syntax *syntax,
                                          const struct lang_use *use, struct arena *arena);
/* True if forms depend on types, by the names' hook or by lang_conversion. */
static inline bool lang_is_typed(const struct lang_syntax *syntax, const struct lang_names *names)
{
    return (names && names->form) || syntax->exact_constructors || syntax->splat.text;
}
/* The form for these types; NULL: the form of the syntax. */
const struct lang_pieces *lang_typed_form(const struct lang_syntax *syntax,
                                          const struct lang_names *names,
                                          const struct lang_use *use, struct arena *arena);

/*
 * Writes a value: vec3(1.0) for equal components, with parentheses if `least` requires them, for
 * example (-1.0). `strings` may be NULL if the value is not a string.
 */
void lang_print_value(const struct lang_style *style, const struct strpool *strings,
                      ir_type_id type, const union ir_word *words, enum lang_precedence least,
                      struct text *out);
/* The struct of a function's results, which stands above the function and its comment, if any. */
void lang_print_results(struct lang_style *style, const struct lang_names *names,
                        const struct lang_unit *unit, uint32_t id, struct text *out);
void lang_print_function(struct lang_style *style, const struct lang_names *names,
                         const struct lang_unit *unit, uint32_t id, struct text *out);
/*
 * texts.c: stores the texts of a unit's functions, in memory of the arena. Styles of that syntax
 * copy them.
 */
void lang_make_texts(struct lang_unit *unit, const struct lang_syntax *syntax, struct arena *arena);
/* Writes "const float PI = 3.14;" or "struct S {…};", each with a newline. */
void lang_print_constant(const struct lang_style *style, const struct lang_names *names,
                         const struct lang_unit *unit, uint32_t global_id, struct text *out);
void lang_print_struct(const struct lang_style *style, const struct lang_names *names,
                       const struct lang_unit *unit, ir_type_id type, struct text *out);

#endif
