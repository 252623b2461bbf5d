// SPDX-License-Identifier: Apache-2.0
/* Declarations that the files of this target share. */
#ifndef MXG_GENERATORS_MDL_H
#define MXG_GENERATORS_MDL_H

#include "spell/spell.h"

extern const struct target target_mdl;
extern const struct target_closures mdl_closures; /* closures.c */
extern const struct target_frame mdl_frame;       /* frame.c */

/* No name of a document or a library begins with it. */
#define MDL_PREFIX "mdl_"
#define MDL_INFINITY "(1.0 / 0.0)"
#define MDL_NAN "(0.0 / 0.0)"

/* The parts of a material, which closures.c gives and frame.c writes: outputs of the shader. */
enum mdl_part {
#define PART(id, TYPE, text) MDL_##id,
#include "generators/mdl/parts.def"
#undef PART
    NUM_MDL_PARTS
};
extern const char *const mdl_part_names[NUM_MDL_PARTS];

/* A closure of the graph's type BSDF that is a hair_bsdf, and what scales any closure. */
#define MDL_HAIR_BSDF "df::chiang_hair_bsdf("
#define MDL_TINT "df::tint("
#define MDL_COLOR "color("

/* forms.c: lang_names.form; `user_data` is the spell. */
const struct lang_pieces *mdl_form(void *user_data, const struct lang_use *use);

/* frame.c: true if a material cannot read a private uniform, by its semantic. */
bool mdl_lacks_uniform(const char *semantic);

/* textures.c: the form that reads a texture. */
const struct lang_pieces *mdl_texture_form(struct spell *spell, const struct lang_use *use);
/* Writes the value of a texture parameter: texture_2d("./wood.png", tex::gamma_linear). */
void mdl_write_texture(struct spell *spell, const struct shader_variable *variable);

/* annotations.c: " [[ anno::display_name("Base"), … ]]" of a parameter, or nothing. */
void mdl_write_annotations(struct spell *spell, const struct shader_variable *variable);
/* Writes a text between quotation marks. */
void mdl_write_string(struct spell *spell, const char *text);

#endif
