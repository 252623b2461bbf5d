// SPDX-License-Identifier: Apache-2.0
/*
 * A target: a table with inheritance and a few hooks. Passes lower the graph by capability bits; a
 * back end only prints.
 */
#ifndef MXG_SPELL_TARGET_H
#define MXG_SPELL_TARGET_H

#include "closure/closure.h"
#include "shader/role.h"
#include "shader/network.h"

struct spell; /* spell/spell.h */

/* For a language with closures: the renderer handles lights, layers and weights. */
struct target_closures {
    /* no shader knows where it is seen from: weights of layers are those along the normal */
    bool lacks_view;
    /*
     * Replaces closure_emit: writes the effects for a root of any type. false if the type has no
     * meaning, or if the language lacks something; *out_lacks then says what, otherwise it is
     * unchanged: "no closure for 'x'".
     */
    bool (*emit)(struct shader *shader, const struct closure_host *host, ir_ref root,
                 const char **out_lacks);
};

struct reflect; /* shader/reflect.h */

/* For a language whose hosts combine one shader per node: option `network`. */
struct target_network {
    const char
        *end_layer; /* name of the last layer of a group, unless the group ends with a value */
    /*
     * True for BSDFs of a family, by its name and functions (enum leaf_function), that have no
     * layer of their own: what stands for them needs their values.
     */
    bool (*fits_family)(const char *family, const uint32_t *functions);
    /* Decides the kind of program and the required nodes, from network->results. */
    void (*plan)(struct network *network);
    /*
     * The effects of one node's shader, whose outputs have these names. Closures and shaders of any
     * kind are closures, those of other layers are uniforms, and a displacement is the offset.
     * false as for target_closures.emit.
     */
    bool (*emit_node)(struct shader *shader, const struct closure_host *host,
                      const struct network_output *outputs, unsigned n, const char **out_lacks);
    /* Adds the shaders that do not belong to a node, after the shaders of nodes. */
    void (*add_parts)(struct network *network);
    /* The text of a stage; empty: there is no such stage. */
    void (*write)(const struct network *network, enum shader_stage_id stage, struct text *out);
    uint64_t (*topology)(const struct network *network); /* hash without values */
    /* Writes keys of the current object (docs/reflection.md). */
    void (*reflect)(const struct network *network, struct reflect *r);
};

/*
 * The text around the functions and statements of a stage, which spell_stage writes. A hook may be
 * NULL: it writes nothing.
 */
struct target_frame {
    /* declares structs, uniforms, textures, stage inputs and outputs, below the first lines */
    void (*declare)(struct spell *spell);
    void (*open)(struct spell *spell); /* writes "void main()\n{\n" and the first lines of main */
    /* writes the last lines of main, its brace and what follows it; NULL: the brace */
    void (*close)(struct spell *spell);
    /*
     * For a language without variables at file scope: opens what has the variables of the interface
     * as members. Constants, and functions that read none of these variables, stand above it; main
     * and the other functions follow. A frame of a role has the hooks of its target here.
     */
    void (*open_context)(struct spell *spell);
    /* after main; may not be NULL beside the other, and may stand without it */
    void (*close_context)(struct spell *spell);
    /*
     * The type of a parameter that functions of graphs cannot see, and get as an argument of its
     * name; NULL: they see the variable.
     */
    const char *(*passed_type)(struct spell *spell, const struct shader_variable *variable);
    /*
     * Declares structs, uniforms and textures for a shader that is a function in a file of the host
     * (spell/function_frame.c); nothing that stands once per file.
     */
    void (*declare_for_function)(struct spell *spell);
};

/* A function without a body in a program (parse/parse.h): its text in the language. */
struct target_function {
    const char *name, *text;
};

/*
 * An image or buffer of programs. In the texts, $N is the name of the resource. A buffer is read as
 * words of 32 bits.
 */
struct target_image {
    const char *kind, *format; /* of struct deferred_resource */
    unsigned access;           /* 1 reads, 2 writes, 3 both */
    const char *type;          /* its type in the language */
    const char *functions[4];  /* of programs that read and write it, each "T $N_load(…) …" */
};

/* Capabilities that the first versions of a language lack; caps 0: there are none. */
struct target_since {
    uint64_t caps;
    const char *version; /* the first that has them */
};

struct target {
    const char *name;           /* "glsl": --target */
    const char *materialx_name; /* "genglsl": the target of implementations */
    const struct target *base;  /* provides missing hooks and rows */
    const char *brief;          /* one line for --help and introspection */
    uint64_t caps;
    uint32_t max_textures;   /* that a stage can read; 0: that of base, or no limit */
    uint32_t max_attributes; /* locations that a vertex stage can read; 0: the device limits them */
    const char *lacks_aovs;  /* why materials have none; NULL: they may have some */
    /* values of the option `version`, the default first; "#version" takes it */
    const char *const *versions;
    struct target_since since;
    const struct lang_syntax *syntax;
    const struct target_closures *closures; /* NULL: no closures */
    const struct source_language *source;   /* of verbatim source; NULL: from base */
    const struct target_network *network;   /* NULL: no networks */
    const struct target_frame *frame;       /* of spell_stage; NULL: from base */
    /*
     * The form of an op for languages where types decide it (struct lang_names); user_data is the
     * spell. NULL: the syntax has all forms.
     */
    const struct lang_pieces *(*form)(void *user_data, const struct lang_use *use);
    /*
     * The function that builds a struct, for languages without such constructors (struct
     * lang_names)
     */
    const char *(*maker)(void *user_data, const char *type);
    /*
     * Texts of helpers, by the enum of the language whose `form` the target has; NULL, also an
     * entry: those of that language.
     */
    const char *const *helpers;
    /*
     * Declares the type of an array whose values functions return, with $T, $N and $L as in phrases
     * (lang_names.array): "typedef $T $N[$L];". NULL: arrays are values.
     */
    const char *array_type;
    /* functions of programs, NULL-terminated; NULL: from base */
    const struct target_function *functions;
    uint32_t first_resource; /* the number of the first resource of programs */
    bool tests_late; /* pixel stages that write images run before the depth test: they read depth */
    /* features of a device that half floats and a second source of a blend need; NULL: none */
    const char *half_feature, *sources_feature;
    const char *any_format; /* of images of any format of floats; NULL: the host chooses */
    const struct target_image *images; /* ends with kind NULL; NULL: from base */
    enum shader_packing packing;       /* of blocks of uniforms */
    /* the language's own, NULL-terminated: a module of functions has another name; NULL: the
     * language has no modules */
    const char *const *modules;
    /*
     * By block: the variable that has the block's variables as members, "u_pub" of u_pub.base.
     * NULL, also for a block: they stand at file scope. Blocks of nodes in C have "u_" before their
     * name.
     */
    const char *const *instances;
    const char *position; /* of a vertex; ".x": of the vertex data; NULL: gl_Position */
    const char *stage_suffix[NUM_STAGES]; /* file endings: "vert", "frag" */
    const char *pass_suffix[2]; /* of passes: of a compute stage, of functions; with CAP_PASSES */
    /*
     * The type of a node's local, or of each result of a call, if it differs from the IR's type.
     * May be NULL, and may return NULL for the IR's type.
     */
    const char *(*node_type)(const struct spell *spell, ir_ref ref);
    /* Writes one stage. NULL: from base; the C-like targets share spell_stage. */
    void (*stage)(struct spell *spell, enum shader_stage_id stage);
};

/* generators/generators.c: every target, NULL-terminated. */
extern const struct target *const targets[];
/* Its capabilities, with those that follow from its members. */
uint64_t target_capabilities(const struct target *target);
/*
 * The capabilities of `wanted` that the target lacks in a version of its language; NULL or "": the
 * default version.
 */
uint64_t target_lacks(const struct target *target, const char *version, uint64_t wanted);
const struct target *target_find(const char *name); /* by name or MaterialX name; NULL: unknown */
/*
 * True if `target` is `name` or inherits from it, by MaterialX name ("essl" inherits from
 * "genglsl").
 */
bool target_is_a(const struct target *target, const char *materialx_name);

/* The roles of shaders, in the order of roles.def. */
enum role_id {
#define ROLE(id, ...) ROLE_##id,
#include "spell/roles.def"
#undef ROLE
    NUM_ROLES
};
extern const struct role roles[NUM_ROLES];
const struct role *role_find(const char *name);        /* NULL: unknown */
extern const struct target_frame spell_function_frame; /* function_frame.c */

/* Support of a target for an op. */
enum spell_support {
    SPELL_NO, /* a document with this op is an error */
    /* lowered before spelling: closures become sums, string comparisons become constants */
    SPELL_LOWERED,
    SPELL_YES,
};
enum spell_support spell_support(const struct target *target, enum ir_op op);

struct spell_options {
    const char *version;    /* of the language; NULL: the default */
    const char *generator;  /* for the first comment: "mxgen 0.1" */
    const char *interface;  /* "complete", "authored", "reduced" */
    const char *colorspace; /* working colour space */
    /* metadata of parameters: 0 none, 1 for user interfaces, 2 with documentation */
    int metadata;
    bool vulkan_attributes;  /* of HLSL: [[vk::binding(3, 0)]] */
    const char *shader_name; /* unique among functions and shaders; NULL: from the element's path */
    bool comments;           /* write element paths as comments */
    bool halves;             /* colours are half floats */
    void *user_data;
    /* The element path for the comment of an origin; NULL: none. May be NULL. */
    const char *(*path)(void *user_data, uint32_t origin);
    /* The user interface data of a variable; may be NULL. */
    void (*ui)(void *user_data, const struct shader_variable *variable, struct shader_ui *out);
};

/*
 * The position in the source at which the text of an origin begins, to map compiler messages back.
 */
struct spell_mark {
    size_t at;
    uint32_t origin;
};

/* Writes the source of one stage to `out`, and its marks in order to `*out_marks`. */
void spell_shader_stage(const struct target *target, const struct spell_options *options,
                        const struct shader *shader, enum shader_stage_id stage,
                        struct arena *scratch, struct text *out, struct spell_mark **out_marks,
                        uint32_t *out_num_marks);

#endif
