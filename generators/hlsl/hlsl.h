// SPDX-License-Identifier: Apache-2.0
/*
 * High Level Shading Language, for Direct3D and Vulkan.
 *
 * A matrix in HLSL is the transpose: its rows are the columns of the portable language. So M[i] is
 * the same vector in both, constructors take the same values in the same order, and a host writes
 * the same bytes into buffers. M * v is mul(v, M), and A * B is mul(B, A).
 */
#ifndef MXG_GENERATORS_HLSL_H
#define MXG_GENERATORS_HLSL_H

#include "spell/spell.h"

extern const struct target target_hlsl;
extern const struct lang_syntax hlsl_syntax;
extern const struct target_function hlsl_functions[];
extern const struct target_image hlsl_images[];

/* forms.c: hook of struct target, and the helpers, for `helpers` of a dialect. */
const struct lang_pieces *hlsl_form(void *user_data, const struct lang_use *use);
enum helper {
#define HELPER(ID, text) HELPER_##ID,
#include "generators/hlsl/helpers.def"
#undef HELPER
    NUM_HLSL_HELPERS
};

/* ---- frame.c ---- */

extern const struct target_frame hlsl_frame;
/* "float3 u_x": a variable of the interface under its own name. */
void hlsl_variable(struct spell *spell, const struct shader_variable *variable);
/* "    row_major float4x4 u_m": a line of a constant buffer without its end. */
void hlsl_member(struct spell *spell, const struct shader_variable *variable);
/* "[[vk::binding(3, 0)]] " */
void hlsl_vulkan_binding(struct spell *spell, uint32_t binding, uint32_t set);
/*
 * "RWTexture2D<uint> mx_word0", "cbuffer MxFrame": an image or buffer of programs. Returns the
 * letter of its registers.
 */
char hlsl_resource(struct spell *spell, const struct spell_resource *r);
/* The end of its declaration: the members of a constant buffer, and ";". */
void hlsl_members(struct spell *spell, const struct spell_resource *r);
void hlsl_light_struct(struct spell *spell); /* "struct LightData {…};" */
void hlsl_light_member(struct spell *spell); /* "    LightData u_lightData[3];" */

/* ---- stage_io.c: inputs and outputs of a stage, and its main, for frames ---- */

/* The parts that differ between HLSL and its dialects. */
struct hlsl_io {
    const char *heads[NUM_STAGES]; /* of main: "void main(" */
    /* vertex data and properties of the geometry have their names as semantics */
    bool own_semantics;
    bool places_sources; /* the two sources of a blend say their places in Vulkan */
};

/* Declares the vertex data, and the results of a function that other code calls. */
void hlsl_declare_io(struct spell *spell, const struct hlsl_io *io);
void hlsl_open_main(struct spell *spell, const struct hlsl_io *io);
void hlsl_close_main(struct spell *spell);
/* The compute stage of a pass, if it has one. */
void hlsl_write_run(struct spell *spell, const char *attribute, const char *name);

#endif
