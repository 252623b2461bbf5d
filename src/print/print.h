// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_PRINT_PRINT_H
#define MXG_PRINT_PRINT_H

#include "base/text.h"
#include "tree/precedence.h"
#include "tree/tree.h"

/*
 * print.c: trees as text. One printer for all C-like targets, driven by a table; the IR's
 * expressions use the same forms.
 */

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
    const char *infinity, *nan;      /* expressions, the highest precedence (docs/ir.md) */
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

/*
 * Constant expressions of GLSL: a literal beyond the range of float is infinity (GLSL 4.60 section
 * 4.1.4), and IEEE 754 defines 0 / 0.
 */
#define LANG_INFINITY "1e39"
#define LANG_NAN "(0.0 / 0.0)"

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
