// SPDX-License-Identifier: Apache-2.0
/*
 * The effects of a material pass:
 *
 *     stored = 0
 *     for each slab, from the top down: stored = mx_store_closure(stored, values, weights)
 *     stored = mx_finish_closures(stored)
 *     out1 = vec4(emission, occlusion)
 *
 * The functions stand in passes/write.glsl, passes/store.glsl and closure.c, which go into the
 * shader as its own source. A payload has those of passes/pack.glsl instead of the former, and its
 * words are the outputs.
 */
#include "deferred/deferred.h"

#include "deferred/deferred_priv.h"
#include "deferred/texts.h"
#include "shader/formula.h"
#include "shader/verbatim.h"
#include "slabs/bytes.h"

#include <assert.h>
#include <math.h>

static bool is_of_family(const struct shader *shader, ir_ref leaf, const char *family)
{
    if (ir_get(shader->graph, leaf)->op != IR_LEAF)
        return false;
    str_id name = shader->graph->callees.items[ir_get(shader->graph, leaf)->attr].name;
    return strcmp(str_text(shader->strings, name), family) == 0;
}

bool deferred_is_mark(const struct shader *shader, ir_ref leaf)
{
    return is_of_family(shader, leaf, "mx_slab_mark_bsdf");
}

ir_ref deferred_backlight(const struct shader *shader, const struct closure_list *list)
{
    for (uint32_t i = 0; i < list->leaves.len; i++)
        if (is_of_family(shader, list->leaves.items[i].leaf, "mx_translucent_bsdf"))
            return list->leaves.items[i].leaf;
    return 0;
}

ir_ref deferred_misfit(const struct shader *shader, ir_ref root)
{
    const struct ir_graph *g = shader->graph;
    const uint8_t *needed = ir_mark(g, &root, 1, shader->arena);
    for (ir_ref ref = 1; ref <= root; ref++) {
        uint8_t op = ir_get(g, ref)->op;
        if (needed[ref] && op == IR_LEAF && ir_type_of(g, ref) == IR_TYPE_BSDF)
            return ref;
    }
    return 0;
}

uint32_t deferred_callee(struct shader *shader, str_id function, uint32_t source)
{
    uint32_t first = shader->sources.refs.len;
    vec_push(shader->arena, &shader->sources.refs, source);
    struct shader_verbatim verbatim = {
        .first_source = first, .num_sources = 1, .function = function};
    vec_push(shader->arena, &shader->sources.calls, verbatim);
    return ir_add_callee(shader->graph, (struct ir_callee){.kind = IR_CALLEE_VERBATIM,
                                                           .index = shader->sources.calls.len - 1,
                                                           .name = function});
}

/* A call of a function of write.glsl: the number of closures that are stored after it. */
static ir_ref call(struct shader *shader, const char *name, ir_type_id type, uint32_t source,
                   const ir_ref *args, unsigned n)
{
    uint32_t callee = deferred_callee(shader, str_intern_z(shader->strings, name), source);
    return ir_build(shader->graph, IR_VERBATIM, type, callee, args, n);
}

void deferred_assign(struct shader *shader, enum effect_kind kind, uint32_t index, ir_ref value)
{
    shader_effect(shader, STAGE_PIXEL,
                  (struct effect){.kind = (uint8_t)kind, .index = index, .value = value});
}

static ir_ref times(struct ir_graph *g, ir_ref color, ir_ref scalar)
{
    ir_ref white = ir_const_splat(g, IR_TYPE_VEC3, 1.0f);
    color = color ? ir_convert(g, IR_TYPE_VEC3, color) : white;
    return ir_convert(g, IR_TYPE_VEC3, ir_op2(g, IR_MUL, color, scalar));
}

/* steady, color, decay of docs/slabs.md, and whether the light of mirrors is spread. */
static void find_weights(struct shader *shader, const struct closure_leaf *leaf, bool spreads,
                         ir_ref out[4])
{
    struct ir_graph *g = shader->graph;
    ir_ref black = ir_const_splat(g, IR_TYPE_VEC3, 0.0f);
    out[0] = times(g, leaf->color, leaf->scalar);
    out[1] = out[2] = black;
    out[3] = ir_const_float(g, spreads ? 1.0f : 0.0f);
    if (!leaf->decay)
        return;
    out[1] = out[0];
    out[0] = leaf->steady ? times(g, leaf->steady, leaf->scalar) : black;
    out[2] = ir_convert(g, IR_TYPE_VEC3, leaf->decay);
}

/* True if a scattering medium lies above the leaf: with spreading, it has no way left. */
static bool is_spread(const struct closure_list *spread, const struct closure_leaf *leaf)
{
    for (uint32_t i = 0; leaf->decay && i < spread->leaves.len; i++)
        if (spread->leaves.items[i].leaf == leaf->leaf)
            return !spread->leaves.items[i].decay;
    return false;
}

/* ---- Order ---- */

/* The order of a walk from a closure to its operands, tops before bases: from 1; 0: no part. */
static void visit_operands(const struct shader *shader, ir_ref root, uint32_t *out_order)
{
    const struct ir_graph *g = shader->graph;
    VEC(ir_ref) open = {0};
    uint32_t num = 0;
    vec_push(shader->arena, &open, root);
    while (open.len) {
        ir_ref ref = vec_last(&open);
        open.len--;
        if (!ref || out_order[ref])
            continue;
        out_order[ref] = ++num;
        const struct ir_node *node = ir_get(g, ref);
        bool is_layer = node->op == IR_LAYER;
        for (uint32_t i = 0; i < node->num_args; i++) {
            ir_ref arg = ir_arg(g, ref, is_layer ? node->num_args - 1 - i : i);
            if (ir_is_closure(g, arg))
                vec_push(shader->arena, &open, arg);
        }
    }
}

/* The marks of a list, the top first. Of a mix, the second operand comes first. */
static struct closure_list marks_of(const struct shader *shader, ir_ref bsdf,
                                    const struct closure_list *list)
{
    struct closure_list marks = {0};
    uint32_t *order = ARENA_ARRAY(shader->arena, uint32_t, bsdf + 1);
    visit_operands(shader, bsdf, order);
    for (uint32_t i = 0; i < list->leaves.len; i++) {
        struct closure_leaf leaf = list->leaves.items[i];
        if (!deferred_is_mark(shader, leaf.leaf))
            continue;
        assert(leaf.leaf <= bsdf && order[leaf.leaf]);
        vec_push(shader->arena, &marks.leaves, leaf);
        uint32_t at = marks.leaves.len - 1;
        for (; at > 0 && order[marks.leaves.items[at - 1].leaf] > order[leaf.leaf]; at--)
            marks.leaves.items[at] = marks.leaves.items[at - 1];
        marks.leaves.items[at] = leaf;
    }
    return marks;
}

/* ---- Sizes ---- */

/* The words of a closure in whole floats. */
enum {
    WORDS_float = 1,
    WORDS_vec2 = 2,
    WORDS_vec3 = 3,
#define CLOSURE_VALUE(type, name, from, doc) +WORDS_##type
    WHOLE_WORDS =
#include "deferred/closure.def"
#undef CLOSURE_VALUE
};

/* True for a weight that a word has room for. */
static bool is_light_enough(const struct ir_graph *g, const struct closure_leaf *leaf)
{
    const float rounding = 1e-4f;
    return closure_most_weight(g, leaf) <= 1.0f + rounding;
}

static bool is_white(const struct ir_graph *g, const struct closure_leaf *leaf)
{
    return !leaf->decay && !leaf->color && ir_const_is(g, leaf->scalar, 1.0f);
}

/* marks: the top first. */
static struct stored_slab *slabs_of(const struct shader *shader, const struct closure_list *marks)
{
    const struct ir_graph *g = shader->graph;
    uint32_t num = marks->leaves.len;
    struct stored_slab *slabs = ARENA_ARRAY(shader->arena, struct stored_slab, num + 1);
    for (uint32_t i = 0; i < num; i++) {
        const ir_ref *in = ir_args(g, marks->leaves.items[i].leaf);
        slabs[i] = (struct stored_slab){
            .diffuse_albedo = in[MARK_diffuse_albedo],
            .f90 = in[MARK_f90],
            .anisotropy = in[MARK_anisotropy],
            .second_roughness_weight = in[MARK_second_roughness_weight],
            .fuzz_amount = in[MARK_fuzz_amount],
            .free_path = in[MARK_free_path],
            .normal = in[MARK_normal],
            .has_tint = !ir_const_is(g, in[MARK_tint_weight], 0.0f),
            .has_glints = !ir_const_is(g, in[MARK_glint_density], 0.0f),
            .is_whole = is_white(g, &marks->leaves.items[i]),
        };
    }
    return slabs;
}

/* The walk leaves out what nobody sees; the cost before it counts one side of each choice. */
static uint32_t count_words(const struct ir_graph *g, const struct stored_slab *slabs, uint32_t num,
                            const struct deferred_layout *layout)
{
    if (layout->storage == STORAGE_FLOAT)
        return DEFERRED_TARGET_WORDS + WHOLE_WORDS * num;
    uint32_t words = slab_stored_pixel(g, slabs, num);
    if (words > layout->max_words)
        words = layout->max_words;
    return words > DEFERRED_TARGET_WORDS ? words : DEFERRED_TARGET_WORDS;
}

/* The classes that mx_class_of and mx_finish_closures may choose, as bits. */
static uint32_t find_classes(const struct ir_graph *g, const struct stored_slab *slabs,
                             uint32_t num)
{
    struct stored_features has = slab_stored_features(g, slabs, num);
    return num ? 1u << CLASS_SIMPLE | (uint32_t)has.any << CLASS_SINGLE
                     | (uint32_t)has.many << CLASS_COMPLEX | (uint32_t)has.special << CLASS_SPECIAL
               : 0;
}

static void measure(struct shader *shader, const struct closure_list *marks,
                    const struct deferred_layout *layout)
{
    if (layout->role->returns == RETURNS_PAYLOAD) {
        shader->reflection.stored_words = DEFERRED_PAYLOAD_WORDS;
        return;
    }
    const struct stored_slab *slabs = slabs_of(shader, marks);
    shader->reflection.stored_words = count_words(shader->graph, slabs, marks->leaves.len, layout);
    shader->reflection.stored_classes = find_classes(shader->graph, slabs, marks->leaves.len);
}

/* ---- Effects ---- */

/*
 * The number of a table of tints, which the host chooses: an integer in place of the texture.
 * weight: constant 0 needs no table.
 */
static ir_ref table_of(struct shader *shader, ir_ref texture, ir_ref weight)
{
    struct ir_graph *g = shader->graph;
    const struct ir_node *node = ir_get(g, texture);
    if (ir_const_is(g, weight, 0.0f))
        return ir_const_float(g, 0.0f);
    assert(node->op == IR_TEXTURE);
    struct shader_variable number = shader->interface.variables.items[node->attr];
    struct text name;
    text_init(&name, shader->arena);
    text_fmt(&name, "%s_number", str_text(shader->strings, number.name));
    number.name = str_intern(shader->strings, name.data, name.len);
    number.block = BLOCK_PUBLIC_UNIFORMS;
    number.type = IR_TYPE_INT;
    number.has_default = true;
    number.value = (struct ir_value){.type = IR_TYPE_INT};
    uint32_t index = shader_add_variable(shader, &number);
    return ir_convert(g, IR_TYPE_FLOAT, shader_read(shader, index));
}

/*
 * True for a tangent, and coordinates with their extent, that nobody reads: they need no vertex
 * attribute.
 */
static bool is_unread(const struct ir_graph *g, ir_ref mark, unsigned operand,
                      const struct deferred_layout *layout)
{
    bool has_glints =
        layout->role->returns != RETURNS_PAYLOAD && deferred_has_part(g, mark, MARK_glint_density);
    bool is_turned =
        layout->storage == STORAGE_FLOAT || deferred_has_part(g, mark, MARK_anisotropy);
    if (operand == MARK_tangent)
        return !has_glints && !is_turned;
    return (operand == MARK_glint_uv || operand == MARK_glint_extent) && !has_glints;
}

/* Whole storage has the tangent, because the samples of the environment lie along it. */
static ir_ref value_of(struct shader *shader, ir_ref mark, unsigned operand,
                       const struct deferred_layout *layout)
{
    struct ir_graph *g = shader->graph;
    ir_ref value = ir_arg(g, mark, operand);
    if (operand == MARK_tint_index)
        return table_of(shader, value, ir_arg(g, mark, MARK_tint_weight));
    return is_unread(g, mark, operand, layout) ? ir_const_splat(g, ir_type_of(g, value), 0.0f)
                                               : value;
}

static void store_leaf(struct shader *shader, const struct closure_leaf *leaf, bool spreads,
                       uint32_t local, uint32_t source, const struct deferred_layout *layout)
{
    enum { NUM_WEIGHTS = 4 };
    struct ir_graph *g = shader->graph;
    ir_ref args[NUM_MARK_OPERANDS + NUM_WEIGHTS];
    unsigned n = 0;
    assert(ir_get(g, leaf->leaf)->num_args == NUM_MARK_OPERANDS);
    args[n++] = ir_build(g, IR_LOCAL, IR_TYPE_INT, local, NULL, 0);
    for (unsigned i = MARK_weight + 1; i < NUM_MARK_OPERANDS; i++)
        args[n++] = value_of(shader, leaf->leaf, i, layout);
    find_weights(shader, leaf, spreads, args + n);
    deferred_assign(shader, EFFECT_ASSIGN, local,
                    call(shader, "mx_store_closure", IR_TYPE_INT, source, args, n + NUM_WEIGHTS));
    shader_add_closure(shader, leaf->leaf);
}

/* Outputs of a program are those of the shader. finished: the result of mx_finish_closures. */
static const char stored_word[] = "// A word of the targets, after the closures.\n"
                                  "uint mx_stored_word(int finished, int index)\n{\n"
                                  "    return index == 0 ? mx_word0 : index == 1 ? mx_word1 "
                                  ": mx_word2;\n}\n";

/* The text of what packs and keeps closures. */
static void write_keeper(const struct deferred_layout *layout, struct text *out)
{
    if (layout->role->returns == RETURNS_WORDS)
        deferred_write_lines(deferred_words, false, out);
    deferred_write_lines(layout->role->returns == RETURNS_PAYLOAD ? deferred_pack : deferred_write,
                         layout->role->returns == RETURNS_WORDS, out);
    if (layout->role->returns == RETURNS_WORDS)
        deferred_write_lines(deferred_words_end, false, out);
}

static bool is_pixel_stage(const struct deferred_layout *layout)
{
    return layout->role->returns == RETURNS_SLABS;
}

static struct source_resources resources_of_words(const struct deferred_layout *layout,
                                                  uint32_t words)
{
    bool has_layers = is_pixel_stage(layout) && words > DEFERRED_TARGET_WORDS;
    return (struct source_resources){
        .reads = has_layers && layout->tests_late ? 1u << RESOURCE_DEPTH : 0,
        .writes = has_layers ? 1u << RESOURCE_WORDS : 0,
        .set = layout->set};
}

struct source_resources deferred_of_material(const struct deferred_layout *layout, uint32_t words)
{
    struct source_resources resources = resources_of_words(layout, words);
    if (layout->has_decals && is_pixel_stage(layout) && words)
        resources.reads |= DEFERRED_DECAL_IMAGES;
    return resources;
}

uint32_t deferred_add_source(struct shader *shader, const struct deferred_layout *layout,
                             const struct source_resources *resources, struct text *text)
{
    struct source_fault fault;
    struct text program;
    if (!layout->parse) {
        uint32_t source = shader_add_source(
            shader, str_intern(shader->strings, text->data, text->len), NULL, 0, &fault);
        assert(source != UINT32_MAX);
        return source;
    }
    text_init(&program, shader->arena);
    deferred_make_program(text_cstr(text), resources, &program);
    return shader_add_program(shader, str_intern(shader->strings, program.data, program.len),
                              layout->parse(shader, &program), *resources);
}

static uint32_t add_source(struct shader *shader, const struct deferred_layout *layout)
{
    bool is_pixel = is_pixel_stage(layout),
         has_more = layout->role->returns != RETURNS_PAYLOAD
                    && shader->reflection.stored_words > DEFERRED_TARGET_WORDS;
    const struct source_resources resources =
        resources_of_words(layout, shader->reflection.stored_words);
    struct text text;
    text_init(&text, shader->arena);
    deferred_write_storage(layout, &text);
    text_fmt(&text, "#define MX_WORDS %u\n", (unsigned)shader->reflection.stored_words);
    if (is_pixel && has_more && !layout->parse)
        deferred_declare(RESOURCE_WORDS, layout, false, true, &text);
    write_keeper(layout, &text);
    if (has_more && layout->storage == STORAGE_FLOAT)
        deferred_write_put(&text);
    deferred_write_lines(deferred_store_closure, false, &text);
    deferred_write_store(&text);
    text_str(&text, layout->parse && is_pixel ? stored_word : "");
    return deferred_add_source(shader, layout, &resources, &text);
}

/* open: the part of the environment that arrives; 0: all. */
static void write_color(struct shader *shader, ir_ref emission, ir_ref open)
{
    struct ir_graph *g = shader->graph;
    ir_ref parts[2] = {emission ? ir_convert(g, IR_TYPE_VEC3, emission)
                                : ir_const_splat(g, IR_TYPE_VEC3, 0.0f),
                       open ? open : ir_const_float(g, 1.0f)};
    uint32_t out = shader_add_variable(
        shader,
        &(struct shader_variable){.name = STR_out1, .block = BLOCK_OUTPUTS, .type = IR_TYPE_VEC4});
    deferred_assign(shader, EFFECT_OUTPUT, out, ir_construct(g, IR_TYPE_VEC4, parts, 2));
}

/* Outputs of words, by the function of the program that has them by number. */
static void write_words(struct shader *shader, const char *function, const char *name,
                        uint32_t source, ir_ref stored, int num)
{
    for (int i = 0; i < num; i++) {
        struct text text;
        text_init(&text, shader->arena);
        text_fmt(&text, name, i);
        str_id word = str_intern(shader->strings, text.data, text.len);
        ir_ref place[2] = {stored, ir_const_int(shader->graph, i)};
        deferred_assign(shader, EFFECT_OUTPUT, shader_output(shader, word, IR_TYPE_UINT),
                        call(shader, function, IR_TYPE_UINT, source, place, 2));
    }
}

/* The end of a material pass. */
static void finish_pass(struct shader *shader, const struct deferred_layout *layout,
                        uint32_t source, uint32_t local, const struct closure_stored *surface,
                        ir_ref emission)
{
    ir_ref stored = ir_build(shader->graph, IR_LOCAL, IR_TYPE_INT, local, NULL, 0);
    deferred_assign(shader, EFFECT_ASSIGN, local,
                    call(shader, "mx_finish_closures", IR_TYPE_INT, source, &stored, 1));
    write_color(shader, emission, surface->open);
    if (layout->parse)
        write_words(shader, "mx_stored_word", "word%d", source, stored, DEFERRED_TARGET_WORDS);
}

/* ---- Functions ---- */

ir_ref deferred_given(struct shader *shader, str_id name, ir_type_id type)
{
    const struct shader_variable given = {
        .name = name, .block = BLOCK_VERTEX_DATA, .type = type, .semantic = name};
    for (uint32_t i = 0; i < shader->interface.variables.len; i++) {
        const struct shader_variable *known = &shader->interface.variables.items[i];
        if (known->block == BLOCK_VERTEX_DATA && known->semantic == name)
            return shader_read(shader, i);
    }
    return shader_read(shader, shader_add_variable(shader, &given));
}

/* The number of stored closures at first. A function of a pixel begins with its place, for noise.
 */
static ir_ref begin(struct shader *shader, const struct deferred_layout *layout, uint32_t source)
{
    struct ir_graph *g = shader->graph;
    if (layout->role->returns != RETURNS_WORDS)
        return ir_const_int(g, 0);
    ir_ref place = ir_const_splat(g, IR_TYPE_VEC2, 0.0f);
    if (layout->storage == STORAGE_DITHER)
        place = deferred_given(shader, str_intern_z(shader->strings, "pixel"), IR_TYPE_VEC2);
    return call(shader, "mx_begin_words", IR_TYPE_INT, source, &place, 1);
}

/* The end of a function of a pixel: the light of the surface, its opacity, an output per word. */
static void finish_words(struct shader *shader, uint32_t source, uint32_t local,
                         const struct closure_stored *surface, ir_ref emission)
{
    ir_ref alpha = surface->alpha;
    struct ir_graph *g = shader->graph;
    ir_ref stored = ir_build(g, IR_LOCAL, IR_TYPE_INT, local, NULL, 0);
    uint32_t num = shader->reflection.stored_words;
    deferred_assign(shader, EFFECT_ASSIGN, local,
                    call(shader, "mx_finish_closures", IR_TYPE_INT, source, &stored, 1));
    deferred_assign(shader, EFFECT_OUTPUT, shader_output(shader, STR_color, IR_TYPE_VEC3),
                    emission ? ir_convert(g, IR_TYPE_VEC3, emission) : ir_black(g));
    deferred_assign(shader, EFFECT_OUTPUT, shader_output(shader, STR_alpha, IR_TYPE_FLOAT),
                    alpha ? alpha : ir_const_float(g, 1.0f));
    if (surface->open)
        deferred_assign(shader, EFFECT_OUTPUT, shader_output(shader, STR_occlusion, IR_TYPE_FLOAT),
                        surface->open);
    write_words(shader, "mx_packed_word", "word_%d", source, stored, (int)num);
}

/* ---- Payloads ---- */

/* A surface whose weights and emission have its opacity. */
static void premultiply(struct shader *shader, const struct closure_stored *surface,
                        struct closure_list *marks, ir_ref *emission)
{
    struct ir_graph *g = shader->graph;
    if (!surface->alpha || surface->premultiplied)
        return;
    for (uint32_t i = 0; i < marks->leaves.len; i++) {
        ir_ref *scalar = &marks->leaves.items[i].scalar;
        *scalar = ir_op2(g, IR_MUL, *scalar, surface->alpha);
    }
    if (*emission)
        *emission = times(g, *emission, surface->alpha);
}

/* An input of a slab as far as there is light for it; what goes beyond is told. */
static ir_ref limited(struct shader *shader, ir_ref mark, const char *name, ir_ref value)
{
    struct ir_graph *g = shader->graph;
    const float rounding = 1e-4f;
    struct ir_value known = {.type = IR_TYPE_VOID};
    bool is_too_much = ir_get_const(g, value, &known)
                       && fmaxf(fmaxf(known.w[0].f, known.w[1].f), known.w[2].f) > 1 + rounding;
    if (is_too_much)
        deferred_note_lost_weight(shader, mark, name);
    return ir_op2(g, IR_MIN, value, ir_const_splat(g, ir_type_of(g, value), 1.0f));
}

/* A mark with as much light as one with a weight of 1 or more has: args are its operands. */
static void weigh(struct shader *shader, ir_ref mark, ir_ref weight, ir_ref *args)
{
    struct ir_graph *g = shader->graph;
    ir_ref diffuse =
        FORMULA(shader, "mx_blend_diffuse", args[MARK_f0], args[MARK_diffuse_albedo], weight);
    args[MARK_f0] = limited(shader, mark, "f0", ir_mul(g, args[MARK_f0], weight));
    args[MARK_diffuse_albedo] = limited(shader, mark, "diffuse_albedo",
                                        FORMULA(shader, "mx_blend_albedo", args[MARK_f0], diffuse));
    if (!deferred_has_part(g, mark, MARK_fuzz_amount))
        return;
    ir_ref mean = FORMULA(shader, "mx_mean", weight);
    args[MARK_fuzz_amount] =
        limited(shader, mark, "fuzz_amount", ir_mul(g, args[MARK_fuzz_amount], mean));
}

/*
 * No word has a weight above 1, as a sum of equal slabs has: their albedo, f0 and fuzz are more.
 * That is for payloads and functions; a material pass draws such a sum forward, which is exact.
 */
static void take_weights(struct shader *shader, struct closure_list *marks)
{
    struct ir_graph *g = shader->graph;
    for (uint32_t i = 0; i < marks->leaves.len; i++) {
        struct closure_leaf *leaf = &marks->leaves.items[i];
        ir_ref args[NUM_MARK_OPERANDS];
        if (is_light_enough(g, leaf))
            continue;
        if (leaf->decay) {
            deferred_note_lost_weight(shader, leaf->leaf, "diffuse_albedo");
            continue;
        }
        ir_ref weight = times(g, leaf->color, leaf->scalar);
        memcpy(args, ir_args(g, leaf->leaf), sizeof args);
        weigh(shader, leaf->leaf, ir_op2(g, IR_MAX, weight, ir_white(g)), args);
        const struct ir_node *node = ir_get(g, leaf->leaf);
        leaf->color = ir_op2(g, IR_MIN, weight, ir_white(g));
        leaf->scalar = ir_const_float(g, 1.0f);
        leaf->leaf = ir_build(g, IR_LEAF, IR_TYPE_BSDF, node->attr, args, NUM_MARK_OPERANDS);
    }
}

/* The end of a payload function: an output per word. */
static void finish_payload(struct shader *shader, uint32_t source, uint32_t local, ir_ref emission,
                           ir_ref alpha)
{
    struct ir_graph *g = shader->graph;
    ir_ref stored = ir_build(g, IR_LOCAL, IR_TYPE_INT, local, NULL, 0);
    ir_ref args[3] = {stored, emission ? ir_convert(g, IR_TYPE_VEC3, emission) : 0, alpha};
    if (!emission)
        args[1] = ir_const_splat(g, IR_TYPE_VEC3, 0.0f);
    if (!alpha)
        args[2] = ir_const_float(g, 1.0f);
    deferred_assign(shader, EFFECT_ASSIGN, local,
                    call(shader, "mx_finish_payload", IR_TYPE_INT, source, args, 3));
    write_words(shader, "mx_payload_word", "word_%d", source, stored, DEFERRED_PAYLOAD_WORDS);
}

/* The values of a decal, one pixel of each image. marks: of its only slab, or none. */
static void put_decal(struct shader *shader, const struct closure_host *host,
                      const struct closure_list *marks, ir_ref alpha)
{
    struct ir_graph *g = shader->graph;
    ir_ref usual_normal = closure_normal(shader, host);
    const struct closure_leaf *leaf = marks->leaves.items;
    ir_ref opacity = alpha ? alpha : ir_const_float(g, 1.0f);
    for (uint32_t i = 0; i < marks->leaves.len; i++)
        shader_add_closure(shader, leaf[i].leaf);
    deferred_put_decal(shader, marks->leaves.len ? leaf->leaf : 0,
                       marks->leaves.len ? times(g, leaf->color, leaf->scalar) : 0, opacity,
                       usual_normal);
}

/* ---- Entry ---- */

const char *deferred_why_no_room(const struct shader *shader, const struct closure_list *list)
{
    bool may_be_forward = shader->role->returns == RETURNS_SLABS;
    for (uint32_t i = 0; may_be_forward && i < list->leaves.len; i++)
        if (deferred_is_mark(shader, list->leaves.items[i].leaf)
            && !is_light_enough(shader->graph, &list->leaves.items[i]))
            return "a sum of equal slabs may weigh more than 1";
    return deferred_backlight(shader, list) ? "no word has the light from behind a sheet" : NULL;
}

void deferred_store(struct shader *shader, const struct closure_host *host,
                    const struct closure_stored *surface)
{
    struct closure_list spread = {0};
    struct closure_host spreading = *host;
    const struct deferred_layout *layout = host->store_data;
    spreading.spreads = true;
    closure_flatten(shader, &spreading, surface->bsdf, &spread);
    struct closure_list marks = marks_of(shader, surface->bsdf, surface->list);
    ir_ref emission = deferred_painted_light(shader, layout, surface->emission);
    take_weights(shader, &marks);
    if (layout->role->returns == RETURNS_PAYLOAD)
        premultiply(shader, surface, &marks, &emission);
    shader->reflection.closures.len = 0; /* lights of slabs are no closures of their own here */
    deferred_note_lost(shader, layout, surface->list, &marks);
    if (deferred_is_decal(layout)) {
        deferred_note_lost_light(shader, emission);
        put_decal(shader, host, &marks, surface->alpha);
        return;
    }
    uint32_t local = shader_add_local(shader, str_intern_z(shader->strings, "stored"), IR_TYPE_INT);
    measure(shader, &marks, layout);
    uint32_t source = add_source(shader, layout);
    deferred_assign(shader, EFFECT_VAR, local, begin(shader, layout, source));
    for (uint32_t i = 0; i < marks.leaves.len; i++) {
        const struct closure_leaf *leaf = &marks.leaves.items[i];
        store_leaf(shader, leaf, is_spread(&spread, leaf), local, source, layout);
    }
    if (layout->role->returns == RETURNS_PAYLOAD)
        finish_payload(shader, source, local, emission, surface->alpha);
    else if (layout->role->returns == RETURNS_WORDS)
        finish_words(shader, source, local, surface, emission);
    else
        finish_pass(shader, layout, source, local, surface, emission);
}
