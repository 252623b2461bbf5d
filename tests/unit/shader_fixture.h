// SPDX-License-Identifier: Apache-2.0
/* A shader made by hand: what test_shader.c and test_spell.c build on. */
#ifndef MXG_TESTS_SHADER_FIXTURE_H
#define MXG_TESTS_SHADER_FIXTURE_H

#include "base/trap.h"
#include "library/formulas.h"
#include "one_file.h"
#include "spell/target.h"

#include <stdio.h>
#include <stdlib.h>

struct fixture {
    struct mem mem;
    struct trap trap;
    struct arena arena;
    struct strpool strings;
    struct ir_graph graph;
    struct lang_unit unit;
    struct shader shader;
    uint32_t file;  /* of the portable functions */
    uint32_t color; /* a vec3 local */
};

static inline str_id word(struct fixture *f, const char *text)
{
    return str_intern_z(&f->strings, text);
}

/* `source`: portable functions, or NULL. */
static inline void fixture_open(struct fixture *f, const char *source)
{
    memset(f, 0, sizeof *f);
    mem_init(&f->mem, NULL, NULL);
    f->mem.trap = &f->trap;
    arena_init(&f->arena, &f->mem);
    strpool_init(&f->strings, &f->arena, NULL);
    ir_graph_init(&f->graph, &f->arena, &f->strings);
    lang_unit_init(&f->unit, &f->arena, &f->strings, NULL);
    library_add_formulas(&f->unit);
    shader_init(&f->shader, &roles[ROLE_raster], &f->arena, &f->strings, &f->graph, &f->unit);
    f->shader.reflection.name = word(f, "Gold");
    f->shader.reflection.element_type = word(f, "surfacematerial");
    f->color = shader_add_local(&f->shader, word(f, "color"), IR_TYPE_VEC3);
    if (!source)
        return;
    f->file = parse_one_file(&f->unit, arena_strndup(&f->arena, source, strlen(source)));
}

static inline void fixture_close(struct fixture *f)
{
    arena_finish(&f->arena);
}

/* Names the nodes built from here on. */
static inline void name(struct fixture *f, const char *text)
{
    f->graph.origin = ir_add_origin(&f->graph, word(f, text), 1, 0);
}

static inline ir_ref uniform(struct fixture *f, const char *text, ir_type_id type)
{
    struct shader_variable v = {.name = word(f, text), .type = type, .path = word(f, text)};
    v.block = type == IR_TYPE_SAMPLER ? BLOCK_TEXTURES : BLOCK_PUBLIC_UNIFORMS;
    v.has_default = type != IR_TYPE_SAMPLER;
    v.value.type = type;
    return shader_read(&f->shader, shader_add_variable(&f->shader, &v));
}

static inline ir_ref number(struct fixture *f, float value)
{
    return ir_const_float(&f->graph, value);
}
static inline ir_ref op1(struct fixture *f, enum ir_op op, ir_ref a)
{
    return ir_op1(&f->graph, op, a);
}
static inline ir_ref op2(struct fixture *f, enum ir_op op, ir_ref a, ir_ref b)
{
    return ir_op2(&f->graph, op, a, b);
}
static inline ir_ref vec3_of(struct fixture *f, ir_ref a)
{
    return ir_construct(&f->graph, IR_TYPE_VEC3, &a, 1);
}
/* A member of the light at hand, for effects inside of EFFECT_LIGHTS. */
static inline ir_ref light_member(struct fixture *f, const char *text)
{
    uint32_t member = shader_light_member(&f->shader, word(f, text), IR_TYPE_VEC3);
    return ir_build(&f->graph, IR_CONTEXT, IR_TYPE_VEC3, member, NULL, 0);
}
static inline ir_ref light_direction(struct fixture *f)
{
    return light_member(f, "direction");
}
static inline ir_ref read_color(struct fixture *f)
{
    return ir_build(&f->graph, IR_LOCAL, IR_TYPE_VEC3, f->color, NULL, 0);
}

static inline uint32_t function(struct fixture *f, const char *text)
{
    return lang_find_function(&f->unit, f->file, word(f, text), NULL, 0);
}

static inline ir_ref call(struct fixture *f, const char *text, const ir_ref *args,
                          unsigned num_args)
{
    ir_type_id types[8];
    for (unsigned i = 0; i < num_args; i++)
        types[i] = ir_type_of(&f->graph, args[i]);
    uint32_t id = function(f, text);
    if (id == LANG_NONE) /* one of several */
        id = lang_find_function(&f->unit, f->file, word(f, text), types, num_args);
    const struct lang_function *fn = lang_function(&f->unit, id, NULL);
    struct ir_callee callee = {
        .index = id, .name = fn->name, .derivative = (fn->flags & LANG_FN_DERIVATIVE) != 0};
    return ir_build(&f->graph, IR_CALL, fn->return_type, ir_add_callee(&f->graph, callee), args,
                    num_args);
}

static inline ir_ref result(struct fixture *f, ir_ref of, uint32_t index, ir_type_id type)
{
    return ir_build(&f->graph, IR_RESULT, type, index, &of, 1);
}

static inline void effect(struct fixture *f, enum effect_kind kind, uint32_t index, ir_ref value)
{
    shader_effect(&f->shader, STAGE_PIXEL,
                  (struct effect){.kind = (uint8_t)kind, .index = index, .value = value});
}

static inline void accumulate(struct fixture *f, ir_ref value)
{
    effect(f, EFFECT_ACCUMULATE, f->color, value);
}

static inline uint32_t add_output(struct fixture *f)
{
    struct shader_variable out = {
        .name = word(f, "out1"), .block = BLOCK_OUTPUTS, .type = IR_TYPE_VEC4};
    return shader_add_variable(&f->shader, &out);
}

/* color and an alpha of 1 to a new output */
static inline void write_color(struct fixture *f)
{
    ir_ref parts[] = {read_color(f), number(f, 1)};
    effect(f, EFFECT_OUTPUT, add_output(f), ir_construct(&f->graph, IR_TYPE_VEC4, parts, 2));
}

#endif
