// SPDX-License-Identifier: Apache-2.0
/* Declarations that the files of the room deferred share. */
#ifndef MXG_DEFERRED_DEFERRED_PRIV_H
#define MXG_DEFERRED_DEFERRED_PRIV_H

#include "deferred/deferred.h"

#include "shader/verbatim.h"

enum {
    DEFERRED_DECAL_IMAGES = 0xf << RESOURCE_DECAL_ALBEDO, /* bits by binding */
};

/* Operands of a mark: its weight, then the inputs of slab_mark_bsdf. */
enum mark_operand {
    MARK_weight,
#define CLOSURE_VALUE(type, name, from, doc) OPERAND_##from(name)
#define OPERAND_MARK(name) MARK_##name,
#define OPERAND_ABOVE(name)
#include "deferred/closure.def"
#undef OPERAND_MARK
#undef OPERAND_ABOVE
#undef CLOSURE_VALUE
    NUM_MARK_OPERANDS
};

/* ---- store_effects.c ---- */

/* True for the mark of a slab. */
bool deferred_is_mark(const struct shader *shader, ir_ref leaf);
/* The leaf of a sheet's light from behind (slabs_host.lit_from_behind); 0: there is none. */
ir_ref deferred_backlight(const struct shader *shader, const struct closure_list *list);
/* Adds a text of passes in the language of the target. Returns its source. */
uint32_t deferred_add_source(struct shader *shader, const struct deferred_layout *layout,
                             const struct source_resources *resources, struct text *text);
/* The callee of a function of such a source, for IR_VERBATIM. */
uint32_t deferred_callee(struct shader *shader, str_id function, uint32_t source);
/* A value that the caller of a function gives. */
ir_ref deferred_given(struct shader *shader, str_id name, ir_type_id type);
/* An effect of the pixel stage. */
void deferred_assign(struct shader *shader, enum effect_kind kind, uint32_t index, ir_ref value);

/* ---- decals.c ---- */

/* The light of a material, of which decals in images leave a part. emission 0: there is none. */
ir_ref deferred_painted_light(struct shader *shader, const struct deferred_layout *layout,
                              ir_ref emission);
/*
 * The outputs of a decal for images: the slab of a mark with its weight, vec3; mark 0: nothing but
 * opacity. A slab with the usual normal has no normal of its own, and leaves that of the base.
 */
void deferred_put_decal(struct shader *shader, ir_ref mark, ir_ref weight, ir_ref opacity,
                        ir_ref usual_normal);

/* ---- lost.c ---- */

/* False where a slab lacks what an operand is the amount of; for f90, the hue. */
bool deferred_has_part(const struct ir_graph *g, ir_ref mark, enum mark_operand operand);
/* Notes what the form has no room for, of a list and its marks. */
void deferred_note_lost(struct shader *shader, const struct deferred_layout *layout,
                        const struct closure_list *all, const struct closure_list *marks);
/* Notes the light of a decal, which its images have no room for; 0: it has none. */
void deferred_note_lost_light(struct shader *shader, ir_ref emission);
/* Notes what a sum of equal slabs has more of, by an input of the slab, than there is room for. */
void deferred_note_lost_weight(struct shader *shader, ir_ref mark, const char *part);

/* ---- pass_texts.c and others ---- */

/*
 * pass_texts.c: writes lines of texts.h. Lines that begin with '@' are for texts with functions of
 * the host, for its passes, and for storage outside of a pixel stage (is_hosts), those that begin
 * with
 * '%' for others.
 */
void deferred_write_lines(const char *const *lines, bool is_hosts, struct text *out);
/* Writes the numbers that C and the texts share, and record.glsl: the first part of every pass. */
void deferred_write_storage(const struct deferred_layout *layout, struct text *out);

/*
 * pass_program.c: writes texts of passes as a program (parse/parse.h) that reads and writes these
 * resources.
 */
void deferred_make_program(const char *glsl, const struct source_resources *resources,
                           struct text *out);

/* closure.c, for record.glsl: the struct MxClosure. */
void deferred_write_struct(struct text *out);
/* For write.glsl and read.glsl with whole floats: mx_put_whole and mx_get_whole. */
void deferred_write_put(struct text *out);
void deferred_write_get(struct text *out);
/* After store.glsl: mx_store_closure. */
void deferred_write_store(struct text *out);
/* Types and names of the values join a hash. */
uint64_t deferred_hash_values(uint64_t hash);

/* resources.c: declares the buffers for programs: uniforms, and words that functions read. */
void deferred_declare_buffers(struct text *out);
/* Declares a resource for those who read or write it. */
void deferred_declare(enum deferred_binding binding, const struct deferred_layout *layout,
                      bool reads, bool writes, struct text *out);
/* After all declarations: the functions by which passes read and write buffers. */
void deferred_write_access(uint32_t reads, uint32_t writes, struct text *out);

#endif
