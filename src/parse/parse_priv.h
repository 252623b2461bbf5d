// SPDX-License-Identifier: Apache-2.0
/*
 * Declarations that the files of the parse room share: tokens, the parser's state, the checks that
 * build typed trees.
 */
#ifndef MXG_PARSE_PARSE_PRIV_H
#define MXG_PARSE_PARSE_PRIV_H

#include "parse/parse.h"
#include "tree/precedence.h"

/* lex.c */

/*
 * SYMBOL(ID, text, role, op, precedence): punctuation, longest first. BINARY symbols are operators
 * between operands, SET symbols assign; `op` is an enum ir_op (IR_NUM_OPS for plain '=').
 */
#define LANG_SYMBOLS(SYMBOL) \
    SYMBOL(SHL_SET, "<<=", SET, IR_SHL, 0) \
    SYMBOL(SHR_SET, ">>=", SET, IR_SHR, 0) \
    SYMBOL(SHL, "<<", BINARY, IR_SHL, LANG_PREC_SHIFT) \
    SYMBOL(SHR, ">>", BINARY, IR_SHR, LANG_PREC_SHIFT) \
    SYMBOL(LE, "<=", BINARY, IR_LE, LANG_PREC_COMPARE) \
    SYMBOL(GE, ">=", BINARY, IR_GE, LANG_PREC_COMPARE) \
    SYMBOL(EQ, "==", BINARY, IR_EQ, LANG_PREC_EQUAL) \
    SYMBOL(NE, "!=", BINARY, IR_NE, LANG_PREC_EQUAL) \
    SYMBOL(LAND, "&&", BINARY, IR_LAND, LANG_PREC_LAND) \
    SYMBOL(LOR, "||", BINARY, IR_LOR, LANG_PREC_LOR) \
    SYMBOL(LXOR, "^^", BINARY, IR_LXOR, LANG_PREC_LXOR) \
    SYMBOL(INCREMENT, "++", STEP, IR_ADD, 0) \
    SYMBOL(DECREMENT, "--", STEP, IR_SUB, 0) \
    SYMBOL(ADD_SET, "+=", SET, IR_ADD, 0) \
    SYMBOL(SUB_SET, "-=", SET, IR_SUB, 0) \
    SYMBOL(MUL_SET, "*=", SET, IR_MUL, 0) \
    SYMBOL(DIV_SET, "/=", SET, IR_DIV, 0) \
    SYMBOL(REM_SET, "%=", SET, IR_REM, 0) \
    SYMBOL(AND_SET, "&=", SET, IR_AND, 0) \
    SYMBOL(OR_SET, "|=", SET, IR_OR, 0) \
    SYMBOL(XOR_SET, "^=", SET, IR_XOR, 0) \
    SYMBOL(SET, "=", SET, IR_NUM_OPS, 0) \
    SYMBOL(LT, "<", BINARY, IR_LT, LANG_PREC_COMPARE) \
    SYMBOL(GT, ">", BINARY, IR_GT, LANG_PREC_COMPARE) \
    SYMBOL(ADD, "+", BINARY, IR_ADD, LANG_PREC_SUM) \
    SYMBOL(SUB, "-", BINARY, IR_SUB, LANG_PREC_SUM) \
    SYMBOL(MUL, "*", BINARY, IR_MUL, LANG_PREC_PRODUCT) \
    SYMBOL(DIV, "/", BINARY, IR_DIV, LANG_PREC_PRODUCT) \
    SYMBOL(REM, "%", BINARY, IR_REM, LANG_PREC_PRODUCT) \
    SYMBOL(AND, "&", BINARY, IR_AND, LANG_PREC_AND) \
    SYMBOL(OR, "|", BINARY, IR_OR, LANG_PREC_OR) \
    SYMBOL(XOR, "^", BINARY, IR_XOR, LANG_PREC_XOR) \
    SYMBOL(NOT, "!", OTHER, IR_NOT, 0) \
    SYMBOL(TILDE, "~", OTHER, IR_BITNOT, 0) \
    SYMBOL(QUESTION, "?", OTHER, IR_SELECT, 0) \
    SYMBOL(COLON, ":", OTHER, IR_NUM_OPS, 0) \
    SYMBOL(SEMICOLON, ";", OTHER, IR_NUM_OPS, 0) \
    SYMBOL(COMMA, ",", OTHER, IR_NUM_OPS, 0) \
    SYMBOL(DOT, ".", OTHER, IR_NUM_OPS, 0) \
    SYMBOL(OPEN, "(", OTHER, IR_NUM_OPS, 0) \
    SYMBOL(CLOSE, ")", OTHER, IR_NUM_OPS, 0) \
    SYMBOL(OPEN_INDEX, "[", OTHER, IR_NUM_OPS, 0) \
    SYMBOL(CLOSE_INDEX, "]", OTHER, IR_NUM_OPS, 0) \
    SYMBOL(OPEN_BLOCK, "{", OTHER, IR_NUM_OPS, 0) \
    SYMBOL(CLOSE_BLOCK, "}", OTHER, IR_NUM_OPS, 0)

/* KEYWORD(ID, text). REFUSED keywords belong to GLSL but not to the portable language. */
#define LANG_KEYWORDS(KEYWORD) \
    KEYWORD(CONST, "const") \
    KEYWORD(IN, "in") \
    KEYWORD(OUT, "out") \
    KEYWORD(INOUT, "inout") \
    KEYWORD(UNIFORM, "uniform") \
    KEYWORD(STRUCT, "struct") \
    KEYWORD(IF, "if") \
    KEYWORD(ELSE, "else") \
    KEYWORD(FOR, "for") \
    KEYWORD(WHILE, "while") \
    KEYWORD(DO, "do") \
    KEYWORD(BREAK, "break") \
    KEYWORD(CONTINUE, "continue") \
    KEYWORD(RETURN, "return") \
    KEYWORD(TRUE, "true") \
    KEYWORD(FALSE, "false") \
    KEYWORD(REFUSED, "switch") \
    KEYWORD(REFUSED, "case") \
    KEYWORD(REFUSED, "default") \
    KEYWORD(REFUSED, "goto") \
    KEYWORD(REFUSED, "discard") \
    KEYWORD(REFUSED, "precision") \
    KEYWORD(REFUSED, "lowp") \
    KEYWORD(REFUSED, "mediump") \
    KEYWORD(REFUSED, "highp") \
    KEYWORD(REFUSED, "layout") \
    KEYWORD(REFUSED, "invariant") \
    KEYWORD(REFUSED, "attribute") \
    KEYWORD(REFUSED, "varying")

enum token_kind {
    TOKEN_END,
    TOKEN_BAD, /* invalid; `reason` is the message */
    TOKEN_NAME,
    TOKEN_INT,
    TOKEN_UINT,
    TOKEN_FLOAT,
    TOKEN_STRING,    /* text without its quotes */
    TOKEN_INPUT,     /* {{name}}: text is the name */
    TOKEN_DIRECTIVE, /* a line that begins with '#': text is the whole line */
#define SYMBOL(ID, text, role, op, precedence) TOKEN_##ID,
    LANG_SYMBOLS(SYMBOL)
#undef SYMBOL
    /* keywords */
    TOKEN_CONST,
    TOKEN_IN,
    TOKEN_OUT,
    TOKEN_INOUT,
    TOKEN_UNIFORM,
    TOKEN_STRUCT,
    TOKEN_IF,
    TOKEN_ELSE,
    TOKEN_FOR,
    TOKEN_WHILE,
    TOKEN_DO,
    TOKEN_BREAK,
    TOKEN_CONTINUE,
    TOKEN_RETURN,
    TOKEN_TRUE,
    TOKEN_FALSE,
    TOKEN_REFUSED,
    TOKEN_NUM_KINDS
};

enum symbol_role { SYMBOL_OTHER, SYMBOL_BINARY, SYMBOL_SET, SYMBOL_STEP };

struct symbol {
    const char *text;
    uint8_t len, role, op, precedence;
};
/* NULL if the kind is not a symbol. */
const struct symbol *lex_symbol(enum token_kind kind);

struct token {
    enum token_kind kind;
    const char *text; /* points into the source */
    size_t len;
    uint32_t line, column, columns; /* `columns`: its width in code points */
    const char *comment;            /* the line comments right above it; NULL = none */
    size_t comment_len;
    union ir_word value; /* value of a number */
    const char *reason;  /* reason of a TOKEN_BAD */
};

struct lexer {
    const char *at, *end;
    uint32_t line, column;
    bool line_begins; /* the line has only blanks so far */
    bool inputs;      /* "{{" begins an input */
};

void lex_begin(struct lexer *lexer, const char *text, size_t len, uint32_t line, uint32_t column);
void lex_next(struct lexer *lexer, struct token *out_token);

/* parse.c: the parser's state */

enum {
    PARSE_MAX_ERRORS = 20,
    PARSE_MAX_DEPTH = 200, /* depth limit of statements and parentheses, and of expression trees */
    PARSE_MAX_INCLUDES = 32,
    PARSE_MAX_ARRAY = 65535,
};

struct local { /* a parameter or local variable in scope */
    str_id name;
    ir_type_id type; /* VOID: the declaration had an error; uses report nothing */
    uint16_t slot;
    bool read_only;
    bool has_value; /* a const with a constant value */
    uint32_t words; /* its value, in unit->words */
    uint32_t place;
};

struct tree_origin { /* data of a node that only the parser needs */
    uint32_t place;  /* line << 12 | column in the function's file */
    uint8_t height;  /* height as an expression */
};

struct tree_chain {
    lang_ref first, last;
};

struct parser {
    struct lang_unit *unit;
    struct diag_list *diags;
    const struct lang_reader *reader; /* NULL in an expression */
    const struct parser *includer;    /* the parser of the file that includes this one */
    unsigned include_depth;
    const char *file_name;
    uint32_t file; /* id; LANG_NONE outside files */
    /* files with visible declarations, including this file */
    VEC(uint32_t) visible;
    uint32_t first_user_type; /* the first user type of this file */
    struct lexer lexer;
    struct token token; /* the current token */
    struct token last;  /* the previous token */
    unsigned depth, num_errors;
    /* after a syntax error, until parse_recover: suppresses messages */
    bool panic;
    bool stopped;    /* stopped after too many errors */
    bool is_program; /* lang_parse_program */
    /* of the current statement of a program: what comes before it */
    struct tree_chain before;
    /* the last message was reported, so its notes may follow */
    bool reported;
    uint32_t first_node;             /* the first node of this parse … */
    VEC(struct tree_origin) origins; /* … and the origins of the nodes from there */
    VEC(lang_ref) operands;          /* stack of operands that wait for their node */
    /* the function being parsed */
    ir_type_id return_type;
    unsigned loops;
    uint32_t first_slot;
    uint32_t scope; /* index in locals where the innermost scope begins */
    VEC(struct local) locals;
    const struct lang_input *inputs; /* inputs of an inline expression */
    unsigned num_inputs;
};

void parse_advance(struct parser *p);
bool parse_accept(struct parser *p, enum token_kind kind);
/* reports an error and panics if the current token is another one */
bool parse_expect(struct parser *p, enum token_kind kind);
/* parse_expect for a whole construct: "an expression" */
void parse_unexpected(struct parser *p, const char *expected);
struct token parse_peek(const struct parser *p); /* the token after the current one */
bool parse_is_word(const struct token *token, const char *word); /* a name with this text */
/* expects a name and consumes it; 0 after an error */
str_id parse_name(struct parser *p);
/*
 * Skips to a safe point after an error: past the next ';', or to (at file level past) the '}' that
 * closes the block.
 */
void parse_recover(struct parser *p, bool at_file_level);
bool parse_enter(struct parser *p); /* enters one level; false, and panic, beyond PARSE_MAX_DEPTH */
void parse_leave(struct parser *p);

uint32_t parse_place(const struct token *token);
struct diag_place parse_where(const struct parser *p, uint32_t place, uint32_t length);
struct diag_place parse_where_token(const struct parser *p, const struct token *token);
struct diag_place parse_where_function(const struct parser *p,
                                       const struct lang_function *function);
bool parse_may_report(struct parser *p);
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
/* formats text in the diagnostics' arena */
const char *
parse_say(struct parser *p, const char *format, ...);
const char *parse_text(const struct parser *p, str_id name);
/* the token as messages show it */
const char *parse_token_text(struct parser *p, const struct token *token);
const char *parse_type_text(struct parser *p, ir_type_id type);

/*
 * PARSE_ERROR(p, where, id, …): the arguments fit the format of the id. PARSE_NOTE adds to the
 * previous error.
 */
#define PARSE_ERROR(p, where, id, ...) \
    (parse_may_report(p) ? diag_add((p)->diags, DIAG_ID_##id, (where), __VA_ARGS__) : (void)0)
#define PARSE_NOTE(p, where, id, ...) \
    ((p)->reported ? diag_add((p)->diags, DIAG_ID_##id, (where), __VA_ARGS__) : (void)0)
#define PARSE_TYPE_ERROR(p, place, ...) \
    PARSE_ERROR(p, parse_where(p, place, 0), lang_type, parse_say(p, __VA_ARGS__))
#define PARSE_SYNTAX_ERROR(p, token, ...) \
    PARSE_ERROR(p, parse_where_token(p, token), lang_syntax, parse_say(p, __VA_ARGS__))

/* The state to restore after a failed parse. */
struct parse_mark {
    uint32_t nodes, slots, functions, globals, files, words, refs, user_types, members;
};
struct parse_mark parse_mark(const struct lang_unit *unit);
void parse_roll_back(struct lang_unit *unit, const struct parse_mark *mark);
/* Removes the tree of a constant expression, and all but the last `keep` words. */
void parse_drop_tree(struct parser *p, const struct parse_mark *mark, uint32_t keep);
void parse_init(struct parser *p, struct lang_unit *unit, struct diag_list *diags);
void parse_begin(struct parser *p, const char *file_name, const char *text, size_t len,
                 uint32_t line, uint32_t column, bool inputs);

/* declaration.c, statement.c, expression.c */

void parse_declarations(struct parser *p); /* a whole file */
void parse_define(struct parser *p);       /* after #define, to the end of the line */
/* program_expressions.c */
/*
 * In a program, "++" or "--" before or behind a target inside of an expression: the value is a
 * local, which p->before sets.
 */
lang_ref parse_step_inside(struct parser *p, enum token_kind kind, lang_ref target, bool is_prefix,
                           uint32_t place);
/*
 * In a program, a choice of which only one arm may run: then p->before has a branch. Languages
 * compute both operands of a choice.
 */
lang_ref parse_choice(struct parser *p, lang_ref choice);
/* Empties p->before into a chain. */
void parse_flush(struct parser *p, struct tree_chain *chain);
void parse_directive(struct parser *p); /* file.c: at a TOKEN_DIRECTIVE */
bool parse_at_type(struct parser *p);   /* true if a type begins here (a struct's name counts) */
/* A type without array suffix; VOID, with *out_bad set, after an error. */
ir_type_id parse_type(struct parser *p, bool may_be_void, bool *out_bad);
/*
 * Parses `[n]` after a type or name: the array type, VOID after an error. `[]`: VOID with
 * *out_unsized set; an error if out_unsized is NULL.
 */
ir_type_id parse_array_suffix(struct parser *p, ir_type_id element, bool *out_unsized);
/* After '=': a value converted to the type, or (unsized) an array of it; 0 after errors. */
lang_ref parse_initialiser(struct parser *p, ir_type_id type, bool unsized);
lang_ref parse_block(struct parser *p); /* from '{' to '}'; the caller opens the scope */
bool parse_returns(const struct parser *p, lang_ref block); /* every path ends in a return */
lang_ref parse_expression(struct parser *p); /* 0 after an error, which is already reported */

/* lookup.c: a new variable of the function; type VOID if its declaration had an error */
struct local *parse_add_local(struct parser *p, const struct token *name_token, str_id name,
                              ir_type_id type, bool is_const);

/* tree_nodes.c: building nodes */

static inline struct lang_node *tree_node(struct parser *p, lang_ref ref)
{
    return &p->unit->nodes.items[ref];
}
uint32_t tree_place(const struct parser *p, lang_ref ref); /* the place of a node of this parse */
lang_ref tree_new(struct parser *p, enum lang_kind kind, enum ir_op op, ir_type_id type,
                  uint32_t place);
lang_ref tree_const(struct parser *p, const struct ir_value *value, uint32_t place);
/*
 * An op over operands, which it chains; over literals, its value if it is finite. 0, after a
 * message, if the tree would be too high.
 */
lang_ref tree_op(struct parser *p, enum ir_op op, ir_type_id type, uint32_t attr,
                 const lang_ref *args, unsigned num_args, uint32_t place);
lang_ref tree_call(struct parser *p, uint32_t function, ir_type_id type, const lang_ref *args,
                   unsigned num_args, uint32_t place);
lang_ref tree_swizzle(struct parser *p, lang_ref a, const uint8_t *components, unsigned count,
                      uint32_t place);
static inline ir_type_id tree_type(const struct parser *p, lang_ref ref)
{
    return p->unit->nodes.items[ref].type;
}

void tree_append(struct parser *p, struct tree_chain *chain, lang_ref ref); /* ignores 0 */
void tree_join(struct parser *p, struct tree_chain *chain, struct tree_chain more);

/* conversions.c */

/* rank of arithmetic scalars, in the order of implicit conversion; 0 for other types */
unsigned check_rank(ir_type_id scalar);
/* component type; VOID for user types and opaque ones */
unsigned check_rank_of(ir_type_id type); /* rank of its components */
bool check_is_vector(ir_type_id type);   /* also of bools */
/* The type of equal shape with components of a higher rank; VOID if there is none. */
ir_type_id check_with_rank(ir_type_id type, unsigned rank);
bool check_converts(ir_type_id from, ir_type_id to); /* implicitly, or equal */
bool check_is_array(const struct parser *p, ir_type_id type, ir_type_id *out_element,
                    uint32_t *out_length);

/* check_operator.c: conversions and operators */

/* an explicit CONVERT; folds constants */
lang_ref check_cast(struct parser *p, lang_ref a, ir_type_id type);
/* Converts implicitly; if this is impossible, reports "WHAT is X; Y was expected" and returns 0. */
lang_ref check_convert(struct parser *p, lang_ref a, ir_type_id type, const char *what);
/* converts the arguments to their highest scalar type */
bool check_unify(struct parser *p, lang_ref *args, unsigned num_args, unsigned min_rank);
lang_ref check_unary(struct parser *p, enum ir_op op, lang_ref a, uint32_t place);
lang_ref check_binary(struct parser *p, enum ir_op op, lang_ref a, lang_ref b, uint32_t place);
lang_ref check_select(struct parser *p, lang_ref condition, lang_ref a, lang_ref b, uint32_t place);
lang_ref check_member(struct parser *p, lang_ref a, const struct token *name);
lang_ref check_index(struct parser *p, lang_ref a, lang_ref index, uint32_t place);
/* reports an error, or marks the variable as assigned */
bool check_assignable(struct parser *p, lang_ref target, const char *doing);
lang_ref check_assign(struct parser *p, enum ir_op op, lang_ref target, lang_ref value,
                      uint32_t place);

/* check_call.c, check_construct.c */

lang_ref check_call(struct parser *p, const struct token *name, lang_ref *args, unsigned num_args);
lang_ref check_construct(struct parser *p, ir_type_id type, lang_ref *args, unsigned num_args,
                         uint32_t place);
bool check_is_builtin(const char *name, size_t len);

/* check_const.c */

/* the value of a constant expression */
bool check_value(struct parser *p, lang_ref ref, struct ir_value *out_value);
/*
 * Appends the words of a constant of built-in or array type to unit->words; false if it is not
 * constant.
 */
bool check_words(struct parser *p, lang_ref ref, uint32_t *out_words, uint32_t *out_num_words);

/* check_function.c: the callees and globals of bodies */

/* sets callees, flags and order; false on recursion */
bool check_finish_functions(struct parser *p, uint32_t first_function);

/* lookup.c: names through files and layers */

/* VOID if there is none */
ir_type_id lookup_type(const struct lang_unit *unit, const char *name, size_t len);
/* adds the type if it is new */
ir_type_id lookup_array(struct lang_unit *unit, ir_type_id element, uint32_t length);
uint32_t lookup_global(const struct lang_unit *unit, const uint32_t *files, uint32_t num_files,
                       str_id name);
/* Iterates over the functions of a name; start with *cursor = {0, 0}. LANG_NONE at the end. */
struct lookup_cursor {
    uint32_t file, function;
};
uint32_t lookup_next_function(const struct lang_unit *unit, const uint32_t *files,
                              uint32_t num_files, str_id name, struct lookup_cursor *cursor);
struct local *lookup_local(struct parser *p, str_id name);
/*
 * The function that accepts arguments of these types with the fewest implicit conversions.
 * LANG_NONE if no function does, or, with *out_ambiguous set, if two do.
 */
uint32_t lookup_overload(const struct lang_unit *unit, const uint32_t *files, uint32_t num_files,
                         str_id name, const ir_type_id *types, unsigned num_types,
                         bool *out_ambiguous);
/* The function with exactly these parameter types. */
uint32_t lookup_exact(const struct lang_unit *unit, const uint32_t *files, uint32_t num_files,
                      str_id name, const ir_type_id *types, unsigned num_types);
enum lookup_suggestion { LOOKUP_VALUES, LOOKUP_FUNCTIONS, LOOKUP_TYPES };
const char *lookup_suggest(struct parser *p, const char *word, enum lookup_suggestion what);
const struct lang_slot *lookup_param(const struct lang_unit *unit, uint32_t function,
                                     unsigned index);

#endif
