// SPDX-License-Identifier: Apache-2.0
/* Shared by the files of this target. */
#ifndef MXG_GENERATORS_OSL_H
#define MXG_GENERATORS_OSL_H

#include "spell/spell.h"

extern const struct lang_syntax osl_syntax;
extern const struct target target_osl;
extern const struct target_network osl_network; /* network.c */

/* A piece of metadata that parameters share. */
struct osl_macro {
    const char *text, *name;
    uint32_t uses;
};

/* What is known while a file is written. */
struct osl {
    struct spell *spell;
    /* by interface variable: the parameter that a stream of several numbers comes as */
    const char **arrays;
    uint8_t *kinds; /* per node of three components: enum osl_kind */
    /* the first row of helpers.def for an op, + 1; 0: there is none */
    uint8_t first_helper[IR_NUM_OPS];
    VEC(struct osl_macro) macros;
    VEC(const char *) helpers; /* functions that the file declares for itself, callees first */
};

/*
 * The IR's vec3 is OSL's `vector`, or `color` where a colour is known to be in it; P is a `point`.
 */
enum osl_kind { OSL_ANY, OSL_VECTOR, OSL_COLOR, OSL_POINT };

/* kinds.c */
void osl_find_kinds(struct osl *osl);
/* "color"; NULL: as its type says */
const char *osl_node_type(const struct spell *spell, ir_ref ref);

void osl_index_helpers(struct osl *osl);
void osl_add_helper(struct osl *osl, const char *text); /* unless it is there */
/* forms.c: lang_names.form; `user_data` is the spell, whose target_data the osl. */
const struct lang_pieces *osl_form(void *user_data, const struct lang_use *use);
bool osl_write_value(const struct lang_style *style, ir_type_id type, const union ir_word *words,
                     struct text *out);

/* functions.c: those of the library that a shader's text needs */
/* that stdosl.h has for one; NULL: none */
const char *osl_same_function(const struct spell *spell, uint32_t id);
void osl_name_same_functions(struct spell *spell);
void osl_write_functions(struct osl *osl, const char *shader, struct text *out);
char osl_type_letter(ir_type_id type); /* as in helpers.def */
bool osl_mentions(const char *text, const char *word);

/*
 * structs.c: those of the document's functions, with what puts them together where `functions` or
 * the shader calls it
 */
void osl_name_makers(struct osl *osl);
const char *osl_maker(void *user_data, const char *type); /* lang_names.maker */
void osl_write_structs(const struct osl *osl, const char *functions, const char *shader,
                       struct text *out);

/*
 * textures.c: the form that reads a texture of the graph; NULL: it is one that a function was
 * given.
 */
const char *osl_texture_call(struct osl *osl, const struct lang_use *use);

/* metadata.c */
void osl_write_macros(struct osl *osl); /* above the shader */
void osl_write_metadata(struct osl *osl, const struct shader_variable *variable);

/* parameters.c */
const struct shader_variable *osl_interface_variable(const struct osl *osl, uint32_t i);
/* in the stage at hand */
bool osl_is_read(const struct osl *osl, const struct shader_variable *variable);
void osl_name_interface(struct osl *osl);
const char *osl_global_name(void *user_data, uint32_t id); /* lang_names.global */
void osl_write_parameters(struct osl *osl);
void osl_write_streams(struct osl *osl);

#endif
