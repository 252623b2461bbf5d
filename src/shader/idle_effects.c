// SPDX-License-Identifier: Apache-2.0
/*
 * Drops effects that change nothing, once calls have become constants: light that folded to 0, and
 * the loops and branches around it.
 *
 *     color += vec3(0.0)                       nothing
 *     IF { } ELSE { }                          nothing
 *     TURN SAMPLES { NEXT }                    nothing
 *     LIGHTS { VAR L; IF { L = … } }           nothing: it assigns only what it declares
 *     COMMENT before nothing                   nothing
 */
#include "shader/shader.h"

#include <assert.h>

struct open_block {
    uint32_t begin;        /* in the kept effects */
    uint32_t num_declared; /* locals before it */
    bool works;            /* something that it does is seen outside */
};

struct sweep {
    struct shader *shader;
    struct effect_list kept;
    VEC(struct open_block) blocks;
    VEC(uint32_t) declared; /* locals, in order */
};

static void keep(struct sweep *s, struct effect effect)
{
    vec_push(s->shader->arena, &s->kept, effect);
}

/* An effect that is seen outside marks all blocks around it. */
static void mark_all(struct sweep *s)
{
    for (uint32_t i = 0; i < s->blocks.len; i++)
        s->blocks.items[i].works = true;
}

/* A change of a local is seen outside of a block that does not contain its declaration. */
static void mark_assigned(struct sweep *s, uint32_t local)
{
    uint32_t place = 0;
    while (place < s->declared.len && s->declared.items[place] != local)
        place++;
    if (place == s->declared.len) { /* no effect declares it */
        mark_all(s);
        return;
    }
    for (uint32_t i = 0; i < s->blocks.len; i++)
        s->blocks.items[i].works |= place < s->blocks.items[i].num_declared;
}

static bool ends_with(const struct sweep *s, enum effect_kind kind)
{
    return s->kept.len && s->kept.items[s->kept.len - 1].kind == kind;
}

static void open_block(struct sweep *s, enum effect_kind kind)
{
    bool has_turn = kind == EFFECT_SAMPLES && ends_with(s, EFFECT_TURN);
    struct open_block block = {.begin = s->kept.len - has_turn, .num_declared = s->declared.len};
    vec_push(s->shader->arena, &s->blocks, block);
}

/* Drops the comment of an effect that was dropped. */
static void drop_comment(struct sweep *s)
{
    s->kept.len -= ends_with(s, EFFECT_COMMENT);
}

static void close_block(struct sweep *s, struct effect end)
{
    assert(s->blocks.len);
    struct open_block block = s->blocks.items[--s->blocks.len];
    if (block.works) {
        keep(s, end);
        return;
    }
    s->kept.len = block.begin;
    drop_comment(s);
}

static bool is_nothing(const struct shader *shader, const struct effect *effect)
{
    return effect->kind == EFFECT_ACCUMULATE && ir_const_is(shader->graph, effect->value, 0.0f);
}

static void visit(struct sweep *s, const struct effect *effect)
{
    switch ((enum effect_kind)effect->kind) {
    case EFFECT_IF:
    case EFFECT_LIGHTS:
    case EFFECT_SAMPLES: open_block(s, (enum effect_kind)effect->kind); break;
    case EFFECT_END: close_block(s, *effect); return;
    case EFFECT_VAR: vec_push(s->shader->arena, &s->declared, effect->index); break;
    case EFFECT_ASSIGN:
    case EFFECT_ACCUMULATE: mark_assigned(s, effect->index); break;
    case EFFECT_OUTPUT:
    case EFFECT_POSITION:
    case EFFECT_DISCARD: mark_all(s); break;
    default: break;
    }
    keep(s, *effect);
}

void shader_drop_idle(struct shader *shader, enum shader_stage_id stage)
{
    struct effect_list *effects = &shader->stages[stage].effects;
    struct sweep s = {.shader = shader};
    uint32_t i = 0;
    while (i < effects->len && !is_nothing(shader, &effects->items[i]))
        i++;
    if (i == effects->len)
        return;
    for (i = 0; i < effects->len; i++) {
        if (is_nothing(shader, &effects->items[i]))
            drop_comment(&s);
        else
            visit(&s, &effects->items[i]);
    }
    assert(s.blocks.len == 0);
    *effects = s.kept;
}
