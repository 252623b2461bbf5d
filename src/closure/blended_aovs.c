// SPDX-License-Identifier: Apache-2.0
/*
 * The AOVs of a surface, which go the way of its other parts: a weight scales them, a sum adds
 * them, a mix mixes them. Integers and booleans cannot be scaled: they come from the surface of the
 * greatest weight, which is noted beside them.
 */
#include "closure/closure_priv.h"

#include <assert.h>

static bool is_whole(const struct ir_graph *g, ir_ref value)
{
    ir_type_id type = ir_type_of(g, value);
    return type == IR_TYPE_INT || type == IR_TYPE_BOOL;
}

void closure_find_aovs(struct shader *shader, ir_ref root)
{
    const struct ir_graph *g = shader->graph;
    for (uint32_t i = 0; i < shader->interface.num_listed_aovs; i++)
        shader->interface.aovs.items[i].is_output = true;
    if (!root || !shader->interface.aovs.len || shader->interface.lists_aovs)
        return;
    const uint8_t *needed = ir_mark(g, &root, 1, shader->arena);
    for (ir_ref ref = 1; ref <= root; ref++)
        if (needed[ref] && ir_get(g, ref)->op == IR_AOV)
            shader->interface.aovs.items[ir_get(g, ref)->attr].is_output = true;
}

struct closure_aovs closure_aovs_of(struct shader *shader)
{
    struct closure_aovs aovs = {.num = shader->interface.aovs.len};
    aovs.items = ARENA_ARRAY(shader->arena, struct closure_aov, aovs.num);
    for (uint32_t i = 0; i < aovs.num; i++)
        aovs.items[i].weight = ir_const_float(shader->graph, 1.0f);
    return aovs;
}

static struct closure_aovs copy_of(struct ir_graph *g, struct closure_aovs aovs)
{
    struct closure_aov *items = ARENA_ARRAY(g->arena, struct closure_aov, aovs.num);
    if (aovs.num)
        memcpy(items, aovs.items, aovs.num * sizeof *items);
    aovs.items = items;
    return aovs;
}

struct closure_aovs closure_aovs_with(struct ir_graph *g, struct closure_aovs aovs, uint32_t index,
                                      ir_ref value, ir_ref alpha)
{
    assert(index < aovs.num);
    aovs = copy_of(g, aovs);
    aovs.items[index] = (struct closure_aov){value, ir_const_float(g, 1.0f)};
    if (alpha) {
        struct closure_aovs one = {1, &aovs.items[index]};
        aovs.items[index] = closure_aovs_scaled(g, one, alpha).items[0];
    }
    return aovs;
}

static ir_ref scaled(struct ir_graph *g, ir_ref value, ir_ref factor)
{
    ir_ref args[2] = {value, factor};
    if (!value || is_whole(g, value) || ir_const_is(g, factor, 1.0f))
        return value;
    if (ir_is_closure(g, value))
        return ir_build(g, IR_CLOSURE_SCALE, ir_type_of(g, value), 0, args, 2);
    return ir_op2(g, IR_MUL, value, factor);
}

struct closure_aovs closure_aovs_scaled(struct ir_graph *g, struct closure_aovs aovs, ir_ref factor)
{
    aovs = copy_of(g, aovs);
    for (uint32_t i = 0; i < aovs.num; i++) {
        aovs.items[i].value = scaled(g, aovs.items[i].value, factor);
        aovs.items[i].weight = ir_op2(g, IR_MUL, aovs.items[i].weight, factor);
    }
    return aovs;
}

static ir_ref nothing_like(struct ir_graph *g, ir_ref value)
{
    return ir_type_of(g, value) == IR_TYPE_BOOL ? ir_const_bool(g, false) : ir_const_int(g, 0);
}

static struct closure_aov sum(struct ir_graph *g, struct closure_aov a, struct closure_aov b)
{
    struct closure_aov out = {a.value ? a.value : b.value, ir_op2(g, IR_MAX, a.weight, b.weight)};
    ir_ref args[2] = {a.value, b.value};
    if (!out.value)
        return out;
    if (is_whole(g, out.value)) {
        ir_ref first = a.value ? a.value : nothing_like(g, out.value),
               second = b.value ? b.value : nothing_like(g, out.value);
        out.value = ir_op3(g, IR_SELECT, ir_op2(g, IR_GE, a.weight, b.weight), first, second);
    } else if (a.value && b.value) {
        out.value = ir_is_closure(g, a.value)
                        ? ir_build(g, IR_CLOSURE_ADD, ir_type_of(g, a.value), 0, args, 2)
                        : ir_op2(g, IR_ADD, a.value, b.value);
    }
    return out;
}

struct closure_aovs closure_aovs_sum(struct ir_graph *g, struct closure_aovs a,
                                     struct closure_aovs b)
{
    if (!a.num || !b.num)
        return a.num ? a : b;
    assert(a.num == b.num);
    a = copy_of(g, a);
    for (uint32_t i = 0; i < a.num; i++)
        a.items[i] = sum(g, a.items[i], b.items[i]);
    return a;
}

struct closure_aovs closure_aovs_weighing(struct ir_graph *g, struct closure_aovs aovs,
                                          ir_ref weight)
{
    aovs = copy_of(g, aovs);
    for (uint32_t i = 0; i < aovs.num; i++)
        aovs.items[i].weight = weight ? weight : ir_const_float(g, 1.0f);
    return aovs;
}

struct closure_aovs closure_aovs_mixed(struct ir_graph *g, struct closure_aovs bg,
                                       struct closure_aovs fg, ir_ref mix)
{
    if (!bg.num && !fg.num)
        return bg;
    assert(bg.num == fg.num);
    bg = closure_aovs_scaled(g, bg, ir_one_minus(g, mix));
    fg = closure_aovs_scaled(g, fg, mix);
    return closure_aovs_sum(g, bg, fg);
}

struct closure_aovs closure_aovs_coated(struct ir_graph *g, struct closure_aovs base,
                                        struct closure_aovs top, ir_ref presence)
{
    if (!base.num || !top.num)
        return base;
    assert(base.num == top.num);
    struct closure_aovs below = closure_aovs_scaled(g, base, ir_one_minus(g, presence));
    base = copy_of(g, base);
    for (uint32_t i = 0; i < base.num; i++)
        if (top.items[i].value)
            base.items[i].value = sum(g, below.items[i], top.items[i]).value;
    return base;
}

/* ---- Outputs ---- */

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* By enum aov_output; a name has it behind "aov". */
static const char *const output_kinds[] = {"", "_weight", "_response", "_light"};

/* "aov_dirt", an identifier. */
static str_id output_name(struct shader *shader, const struct shader_aov *aov, const char *kind)
{
    struct text name;
    size_t len;
    text_init(&name, shader->arena);
    text_str(&name, "aov");
    text_str(&name, kind);
    text_char(&name, '_');
    for (const char *c = str_text(shader->strings, aov->name); *c; c++)
        text_char(&name, is_letter(*c) ? *c : '_');
    const char *identifier = identifier_from(text_cstr(&name), name.len, shader->arena, &len);
    return str_intern(shader->strings, identifier, len);
}

ir_type_id closure_aov_type(const struct shader *shader, uint32_t index)
{
    ir_type_id type = shader->interface.aovs.items[index].type;
    return type == IR_TYPE_BOOL ? IR_TYPE_INT : ir_type_is_closure(type) ? IR_TYPE_VEC3 : type;
}

uint32_t closure_aov_output(struct shader *shader, uint32_t index, enum aov_output which,
                            ir_type_id type)
{
    struct shader_aov *aov = &shader->interface.aovs.items[index];
    struct text semantic;
    text_init(&semantic, shader->arena);
    text_str(&semantic, "aov");
    text_str(&semantic, output_kinds[which]);
    text_char(&semantic, ':');
    text_str(&semantic, str_text(shader->strings, aov->name));
    struct shader_variable variable = {
        .name = output_name(shader, aov, output_kinds[which]),
        .block = BLOCK_OUTPUTS,
        .type = type,
        .doc_type = aov->doc_type,
        .element = aov->element,
        .semantic = str_intern(shader->strings, text_cstr(&semantic), semantic.len)};
    uint32_t added = shader_add_variable(shader, &variable);
    if (which == AOV_VALUE)
        aov->variable = added;
    return added;
}

ir_ref closure_aov_value(struct shader *shader, uint32_t index, ir_ref value)
{
    struct ir_graph *g = shader->graph;
    ir_type_id type = closure_aov_type(shader, index);
    if (value)
        return ir_convert(g, type, value);
    return type == IR_TYPE_INT ? ir_const_int(g, 0) : ir_const_splat(g, type, 0.0f);
}
