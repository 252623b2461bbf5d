// SPDX-License-Identifier: Apache-2.0
/* Declarations that the files of this target share. */
#ifndef MXG_GENERATORS_OSL_H
#define MXG_GENERATORS_OSL_H

#include "spell/spell.h"

extern const struct target target_osl;
extern const struct target_network osl_network; /* group_text.c */

/* A piece of metadata that parameters share. */
struct osl_macro {
    const char *text, *name;
    uint32_t uses;
};

/* State while a file is written. */
/* A function that copies a struct of a library. */
struct osl_copier {
    ir_type_id type;
    const char *text;
};

struct osl {
    struct spell *spell;
    /* by interface variable: the array parameter of a stream with several components */
    const char **arrays;
    uint8_t *kinds; /* per node of three components: enum osl_kind */
    /* the first row of helpers.def for an op, + 1; 0: none */
    uint8_t first_helper[IR_NUM_OPS];
    VEC(struct osl_macro) macros;
    /* set while text is written: the file must declare these above the text */
    bool *called;              /* per portable function */
    bool *read;                /* per portable global */
    uint32_t types;            /* 1 << type of each built-in type */
    VEC(const char *) helpers; /* functions that the file declares, callees first */
    VEC(struct osl_copier) copiers;
};

/*
 * The IR's vec3 is OSL's `vector`, or `color` if it holds a colour; P is a `point`.
 */
enum osl_kind { OSL_ANY, OSL_VECTOR, OSL_COLOR, OSL_POINT, OSL_NORMAL };

/* syntax.c: tables, and marks of use */
extern const struct lang_syntax osl_syntax;
/*
 * OSL has no literals for these. Its functions return such values instead: log(0) is the lowest
 * float, and 0 / 0 is 0.
 */
#define OSL_INFINITY "3.4028235e+38"
#define OSL_NAN "0.0"
char osl_type_letter(ir_type_id type);                  /* the letter in helpers.def */
void osl_note_type(void *user_data, ir_type_id type);   /* lang_names.type */
const char *osl_type(struct osl *osl, ir_type_id type); /* its name; marks it as used */
void osl_add_helper(struct osl *osl, const char *text); /* adds a helper once */
static inline bool osl_is_struct(ir_type_id type)
{
    return type < IR_NUM_TYPES && ir_type_info(type)->components > 1 && !ir_type_is_matrix(type)
           && type != IR_TYPE_VEC3;
}

/* genosl.c */
extern const struct source_language osl_source;
/* Adds the operators and functions of a struct that a text may need. */
void osl_add_struct_functions(struct osl *osl, ir_type_id type, const char *text);

/* kinds.c */
void osl_find_kinds(struct osl *osl);
/* "color"; NULL: the usual name of its type */
const char *osl_node_type(const struct spell *spell, ir_ref ref);

/* forms.c */
void osl_index_helpers(struct osl *osl);
/* lang_names.form; `user_data` is the spell, whose target_data is the struct osl. */
const struct lang_pieces *osl_form(void *user_data, const struct lang_use *use);

/* functions.c: the called library functions, and their constants */
/* The function of stdosl.h that replaces a library function; NULL: none. */
const char *osl_same_function(const struct spell *spell, uint32_t id);
void osl_name_same_functions(struct spell *spell);
const char *osl_function_name(void *user_data, uint32_t id); /* lang_names.function */
void osl_write_functions(struct osl *osl, struct text *out); /* call this last */

/* struct_setters.c: the structs of the document's functions, with the makers that are called */
void osl_name_makers(struct osl *osl);
const char *osl_maker(void *user_data, const char *type); /* lang_names.maker */
/* True for a type of a library that is no array. */
bool osl_is_library_struct(const struct spell *spell, ir_type_id type);
/* Adds the function of a type once; it is written with the structs. */
void osl_add_copier(struct osl *osl, ir_type_id type, const char *text);
void osl_write_structs(struct osl *osl, struct text *out);

/*
 * textures.c: the form that reads a texture of the graph; NULL for the texture parameter of a
 * function.
 */
const char *osl_texture_call(struct osl *osl, const struct lang_use *use);

/* True if the current stage reads the variable. */
static inline bool osl_is_read(const struct osl *osl, const struct shader_variable *variable)
{
    return variable->stages >> osl->spell->stage_id & 1;
}

/* metadata.c */
void osl_write_macros(struct osl *osl); /* above the shader */
void osl_write_metadata(struct osl *osl, const struct shader_variable *variable);

/* parameters.c */
void osl_name_interface(struct osl *osl);
const char *osl_global_name(void *user_data, uint32_t id); /* lang_names.global */
void osl_write_parameters(struct osl *osl);
void osl_write_streams(struct osl *osl);

#endif
