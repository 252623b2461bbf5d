// SPDX-License-Identifier: Apache-2.0
/*
 * Verbatim source in a shader: the texts that a call needs, the $tokens that stand for names of
 * mxgen's shaders, and the helpers that such source calls without including them.
 *
 *     file: #include "lib/x.glsl"   the text of x.glsl, at its first #include in the stage
 *           $envRadiance            u_envRadiance, which becomes a variable of the interface
 *           mx_square(a)            a helper of the target, above all files
 */
#ifndef MXG_SHADER_VERBATIM_H
#define MXG_SHADER_VERBATIM_H

#include "base/table.h"
#include "shader/shader.h"

/* A function, type or macro of the target's prelude. Its text may use helpers before it. */
struct source_helper {
    const char *name, *text;
    const char *text_1_38; /* beside closures of MaterialX 1.38; NULL: the same */
};

struct source_token {
    const char *name;     /* without '$' */
    const char *text;     /* what stands for it; NULL: the variable */
    const char *variable; /* a private uniform, without "u_" */
};

/* The token for the instance of vertex data. The '.' after it is left out, too. */
#define SOURCE_INSTANCE "vd"

enum { SOURCE_MAX_HELPERS = 64 };

/* The verbatim source of a target: generators. */
struct source_language {
    const struct source_helper *helpers;
    const struct source_token *tokens; /* beside the names of uniforms and streams */
    const char *const *derivatives;    /* functions that need adjacent pixels */
    const char *const *absent;         /* names that source may expect, and no helper has */
    uint8_t num_helpers, num_tokens, num_derivatives, num_absent;
};

/* The structs that functions of source take and give. */
enum source_struct {
    SOURCE_STRUCT_CLOSURE_DATA,
    SOURCE_STRUCT_BSDF,
    SOURCE_STRUCT_BSDF_1_38, /* has the parameters of a thin film, too */
    SOURCE_STRUCT_VDF,
    SOURCE_STRUCT_SURFACE,
    SOURCE_STRUCT_DISPLACEMENT,
    SOURCE_STRUCT_LIGHT,
    NUM_SOURCE_STRUCTS
};

/* The question that a closure answers: for the current light, for light from behind… */
enum source_context {
    SOURCE_REFLECTION,
    SOURCE_TRANSMISSION,
    SOURCE_INDIRECT,
    SOURCE_EMISSION,
    NUM_SOURCE_CONTEXTS
};

/* How a function takes the context, before the inputs of its node. */
enum source_convention {
    SOURCE_CLOSURE_DATA, /* one struct, for every context: MaterialX 1.39 */
    SOURCE_CLOSURE_BSDF, /* the same, of a VDF that is a BSDF: MaterialX before 1.39.5 */
    /*
     * MaterialX 1.38: (L, V, P, occlusion) for reflection, (V) for transmission and indirect,
     * (N, V) for emission
     */
    SOURCE_VALUES,
    SOURCE_NOTHING, /* a volume of MaterialX 1.38 */
    SOURCE_NATIVE,  /* in a target with closures: the result is one */
};

/* A closure in source, the callee of a LEAF. Operands of the LEAF: 1, then all inputs in order. */
struct source_leaf {
    uint8_t convention;                     /* enum source_convention */
    uint8_t answers;                        /* bits by context: where it contributes light */
    uint32_t verbatim[NUM_SOURCE_CONTEXTS]; /* in shader->verbatim; UINT32_MAX: there is none */
    const ir_type_id *operand_types;        /* of the inputs */
    uint32_t nodedef;                       /* number of its definition */
};

/* Images and buffers beside the interface of the shader: deferred/deferred.h. */
struct source_resources {
    uint32_t reads, writes; /* bits by binding */
    uint32_t set;           /* with CAP_SETS */
};

/* A text: a file. */
struct shader_source {
    str_id text;
    /* the text is a program (parse/parse.h), which the target's language has to be made of; NULL:
     * it is in that language */
    const struct lang_unit *program;
    struct source_resources resources;      /* of a program */
    uint32_t first_include, num_includes;   /* in source_refs: a source per #include, in order */
    uint32_t first_variable, num_variables; /* in source_refs: variables of its tokens */
    uint32_t first_name, num_names;         /* in source_refs: str_id of the names it declares */
    uint32_t first_function, num_functions; /* in source_functions */
    uint64_t uses, declares;                /* bits: names of helpers */
    bool has_derivatives;                   /* in macros, which any function may name */
};

/* A function that a text defines. */
struct source_function {
    str_id name;
    uint32_t first_call, num_calls; /* in source_refs: str_id of the functions that it calls */
    bool has_derivatives;           /* it calls a function that needs adjacent pixels */
};

/* The text or variable of a token. */
struct shader_token {
    str_id name;
    const char *text; /* NULL: */
    uint32_t variable;
};

/* Makes the helpers known, before the first source or expression. */
void shader_index_helpers(struct shader *shader);

/* The type of a struct in the shader's graph. */
ir_type_id shader_source_struct(struct shader *shader, enum source_struct which);
/* The type of a closure in functions of a convention, whose context is one struct or not. */
ir_type_id shader_closure_struct(struct shader *shader, enum source_convention convention,
                                 ir_type_id type);
static inline bool source_has_closure_data(enum source_convention convention)
{
    return convention == SOURCE_CLOSURE_DATA || convention == SOURCE_CLOSURE_BSDF;
}

/*
 * Adds a text; `includes` are the sources of its #include lines, in order. Its tokens become
 * variables. Returns its index; UINT32_MAX if a token is unknown, with the place in the text.
 */
struct source_fault {
    const char *token;
    uint32_t line, column;
};
uint32_t shader_add_source(struct shader *shader, str_id text, const uint32_t *includes,
                           uint32_t num_includes, struct source_fault *out_fault);

/* Adds a program, whose functions are called as those of a text, with its tree. */
uint32_t shader_add_program(struct shader *shader, str_id text, const struct lang_unit *program,
                            struct source_resources resources);

/* Adds a source and its includes to `out`, each once. */
struct source_list { /* layout of VEC(uint32_t) */
    uint32_t *items;
    uint32_t len, cap;
};
void shader_collect_sources(const struct shader *shader, uint32_t source, struct arena *arena,
                            struct source_list *out);

/* True if the function or the expression of a verbatim source needs adjacent pixels. */
bool shader_needs_neighbours(const struct shader *shader, const struct shader_verbatim *verbatim,
                             struct arena *scratch);

/* Marks the variables that the sources of a stage read. */
void shader_mark_sources(struct shader *shader, enum shader_stage_id stage);

const char *shader_helper_text(const struct shader *shader, unsigned helper);

/* The bits of the helpers that a stage must contain. */
uint64_t shader_stage_helpers(const struct shader *shader, const struct shader_stage *stage,
                              struct arena *scratch);

const struct shader_token *shader_find_token(const struct shader *shader, const char *name,
                                             size_t len);

#endif
