// SPDX-License-Identifier: Apache-2.0
/*
 * A target: a table with inheritance and few hooks. Passes lower by capability bits; a back end
 * only spells.
 */
#ifndef MXG_SPELL_TARGET_H
#define MXG_SPELL_TARGET_H

#include "closure/closure.h"
#include "shader/network.h"

enum target_caps {
    /* a vertex stage computes what the pixel stage reads; else shaders read the geometry itself */
    CAP_VERTEX_STAGE = 1 << 0,
    CAP_UNIFORM_BLOCKS = 1 << 1,   /* uniforms must stand in blocks */
    CAP_BLOCK_OPTION = 1 << 2,     /* uniforms may stand in blocks: --uniform-blocks */
    CAP_UNIFORM_DEFAULTS = 1 << 3, /* uniforms may have initial values */
    CAP_BINDINGS = 1 << 4,         /* layout(binding) and locations */
    CAP_BLOCK_STAGE_IO = 1 << 5,   /* stage inputs and outputs may stand in an interface block */
    CAP_PRECISION = 1 << 6,        /* needs default precision statements */
    CAP_OVERLOADS = 1 << 7,        /* functions may be overloaded */
    CAP_BITWISE = 1 << 8,          /* unsigned integers and bit operators */
    CAP_IMPLICIT_LOD = 1 << 9,     /* texture() in pixel stages */
    CAP_STRINGS = 1 << 10,         /* the language has strings */
    /* the tiles of an image are layers of one texture; else its host, or texture(), finds them */
    CAP_TEXTURE_ARRAYS = 1 << 11,
    CAP_NAMED_WHOLES = 1 << 12, /* parts are taken of variables only: v.x, but not (a + b).x */
    /* texture() gives as many channels as are wanted: one, three or four */
    CAP_TYPED_TEXTURES = 1 << 13,
    CAP_MISSING_COLORS = 1 << 14, /* texture() is told what to give where there is no image */
    /* texture() is told address modes and filters, but no borders of a colour; else samplers are */
    CAP_READS_SAY_MODES = 1 << 15,
    /* each shader has a scope of its own for its parameters: names need no node in front */
    CAP_SCOPED_PARAMETERS = 1 << 16,
    /* tangents follow the coordinates of their index; else, as in MaterialX, the first */
    CAP_INDEXED_TANGENTS = 1 << 17,
    CAP_SETS = 1 << 18, /* with CAP_BINDINGS: layout(set, binding) */
};

struct spell; /* spell/spell.h */

/* Of a language with closures: the renderer knows lights, layers and weights. */
struct target_closures {
    /*
     * Writes the effects for a root of any type, in the place of closure_emit. False where the type
     * has no meaning, or where a leaf has no closure in the language: *out_unknown is its family
     * then, else it stays.
     */
    bool (*emit)(struct shader *shader, const struct closure_host *host, ir_ref root,
                 str_id *out_unknown);
};

struct reflect; /* shader/reflect.h */

/* Of a language whose hosts put a shader together of one per node: option `network`. */
struct target_network {
    /* Decides by network->results what the program is, and which nodes it needs. */
    void (*plan)(struct network *network);
    /*
     * The effects of one node's shader, whose outputs have these names: closures and shaders of any
     * kind are closures, those of other layers are uniforms, and a displacement is the offset.
     * False as target_closures.emit.
     */
    bool (*emit_node)(struct shader *shader, const struct closure_host *host,
                      const struct network_output *outputs, unsigned n, str_id *out_unknown);
    /* Adds the shaders that are of no node, once those of nodes stand. */
    void (*add_parts)(struct network *network);
    /* The text of a stage; nothing: there is no such stage. */
    void (*write)(const struct network *network, enum shader_stage_id stage, struct text *out);
    uint64_t (*topology)(const struct network *network); /* of everything but values */
    /* Keys of the object at hand (docs/reflection.md). */
    void (*reflect)(const struct network *network, struct reflect *r);
};

/*
 * What stands around the functions and statements of a stage, which spell_stage writes. Hooks may
 * be NULL: nothing stands there.
 */
struct target_frame {
    /* Names that the hooks write beside those of all languages (declare.c); NULL-terminated. */
    const char *const *names;
    /* Structs, uniforms, textures, stage inputs and outputs, below the language's first lines. */
    void (*declare)(struct spell *spell);
    void (*open)(struct spell *spell);  /* "void main()\n{\n", and what main begins with */
    void (*close)(struct spell *spell); /* what main ends with, before its brace */
};

struct target {
    const char *name;           /* "glsl": --target */
    const char *materialx_name; /* "genglsl": target of implementations */
    const struct target *base;  /* hooks and rows absent here come from there */
    const char *brief;          /* one line for --help and introspection */
    uint32_t caps;
    /* values of the option `version`, first is the default; "#version" is written with it */
    const char *const *versions;
    const struct lang_syntax *syntax;
    const struct target_closures *closures; /* NULL: the language has none */
    const struct target_network *network;   /* NULL: shaders of the target are whole */
    const struct target_frame *frame;       /* of spell_stage; NULL: from base */
    /*
     * The form of an op where types decide (struct lang_names); user_data is the spell. NULL: the
     * syntax says all.
     */
    const struct lang_pieces *(*form)(void *user_data, const struct lang_use *use);
    /* The function that puts a struct together (struct lang_names), where there is no constructor
     */
    const char *(*maker)(void *user_data, const char *type);
    enum shader_packing packing; /* of blocks of uniforms */
    const char *position; /* what the vertex stage writes the position to; NULL: gl_Position */
    const char *stage_suffix[NUM_STAGES]; /* "vert", "frag"; file endings */
    /*
     * The type of a node's local, or of each result of a call, where it does not follow from the
     * IR's type; may be NULL, and return it.
     */
    const char *(*node_type)(const struct spell *spell, ir_ref ref);
    /* Writes one stage. NULL: from base; the C-like targets share spell_stage. */
    void (*stage)(struct spell *spell, enum shader_stage_id stage);
};

/* generators/generators.c: every target, NULL-terminated. */
extern const struct target *const targets[];
const struct target *target_find(const char *name); /* by name or MaterialX name; NULL */
/* True where `target` is `name` or inherits it by MaterialX name ("essl" inherits "genglsl"). */
bool target_is_a(const struct target *target, const char *materialx_name);

/* Can the target write an op? */
enum spell_support {
    SPELL_NO, /* documents that need it cannot be generated */
    /* gone before spelling: closures become sums, strings are compared at compile time */
    SPELL_LOWERED,
    SPELL_YES,
};
enum spell_support spell_support(const struct target *target, enum ir_op op);

struct spell_options {
    const char *version;    /* of the target; NULL = default */
    const char *generator;  /* for the first comment: "mxgen 0.1" */
    const char *interface;  /* "complete", "authored", "reduced" */
    const char *colorspace; /* the working space */
    /* of parameters: 0 none, 1 what user interfaces need, 2 with their documentation */
    int metadata;
    bool uniform_blocks;
    bool vulkan_attributes; /* of HLSL: [[vk::binding(3, 0)]] */
    bool neutral_names;
    const char *shader_name; /* no other function or shader has it; NULL: from the element's path */
    bool comments;           /* paths as comments */
    void *user_data;
    /* The element path that a comment shows for an origin; NULL: none. The function may be NULL. */
    const char *(*path)(void *user_data, uint32_t origin);
    /* What the document says about a variable for a user interface; may be NULL. */
    void (*ui)(void *user_data, const struct shader_variable *variable, struct shader_ui *out);
};

/* Where in the source the text of an origin begins: for mapping compiler messages back. */
struct spell_mark {
    size_t at;
    uint32_t origin;
};

/* Writes one stage's source to `out`; its marks, in order, go to `*out_marks`. */
void spell_shader_stage(const struct target *target, const struct spell_options *options,
                        const struct shader *shader, enum shader_stage_id stage,
                        struct arena *scratch, struct text *out, struct spell_mark **out_marks,
                        uint32_t *out_num_marks);

#endif
