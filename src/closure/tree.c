// SPDX-License-Identifier: Apache-2.0
/*
 * Closures as the target's own, for languages that have some: the tree stays. Leaves become calls
 * of the target's closures, by the rows that it gives (closure.h), and shaders become one closure:
 *
 *     surface(bsdf, edf, opacity)   mix(transparent, bsdf + edf, opacity)
 *
 * Everything is a node that is older than its users, so one pass upwards rewrites the tree.
 */
#include "closure/closure_priv.h"

struct leaf_inputs { /* their names, of the leaf that was asked last */
    uint32_t callee;
    VEC(const char *) names; /* NULL: the operand has none */
};

struct tree {
    struct shader *shader;
    struct ir_graph *graph;
    const struct closure_host *host;
    struct leaf_inputs *inputs;
    ir_ref *of;  /* per node of closure or shader type: what became of it; 0: nothing */
    ir_ref thin; /* whether the surface is a shell without an inside; 0: it is none */
    /* of the leaf at hand: whether it reflects back to where the light came from; 0: it does not */
    ir_ref turned;
    enum side { BOTH_SIDES, REFLECTED, TRANSMITTED } side; /* what is wanted of the leaf at hand */
};

/* ---- Arguments ---- */

static void name_inputs(const struct tree *t, const struct ir_node *leaf)
{
    struct leaf_inputs *inputs = t->inputs;
    if (inputs->callee == leaf->attr && inputs->names.len + 1 == leaf->num_args)
        return;
    inputs->callee = leaf->attr;
    inputs->names.len = 0;
    for (unsigned i = 0; i + 1 < leaf->num_args; i++)
        vec_push(t->shader->arena, &inputs->names,
                 t->host->leaf_input(t->host->user_data, leaf->attr, i));
}

/* The operand of a leaf by the name of its input; 0: there is none. */
static ir_ref input(const struct tree *t, ir_ref leaf, const char *name, size_t len)
{
    name_inputs(t, ir_get(t->graph, leaf));
    for (unsigned i = 0; i < t->inputs->names.len; i++) {
        const char *have = t->inputs->names.items[i];
        if (have && strncmp(have, name, len) == 0 && have[len] == '\0')
            return ir_arg(t->graph, leaf, i + 1);
    }
    return 0;
}

static bool is_string(const struct tree *t, ir_ref value, const char *text)
{
    struct ir_value constant;
    return value && ir_get_const(t->graph, value, &constant) && constant.type == IR_TYPE_STRING
           && strcmp(str_text(t->shader->strings, constant.w[0].u), text) == 0;
}

static bool scatters(const struct tree *t, ir_ref leaf, enum side side)
{
    return !is_string(t, input(t, leaf, "scatter_mode", 12), side == REFLECTED ? "T" : "R");
}

/*
 * A tint that counts on the side that it is for; black where the leaf does not scatter there, or
 * something else is wanted.
 */
static ir_ref scattered(struct tree *t, ir_ref leaf, ir_ref tint, enum side side)
{
    bool counts = scatters(t, leaf, side) && (t->side == BOTH_SIDES || t->side == side);
    return counts ? tint : ir_const_splat(t->graph, IR_TYPE_VEC3, 0.0f);
}

/* Facets that mirror about the view direction send light back along it. */
static ir_ref facing(struct tree *t, ir_ref normal)
{
    return t->turned ? ir_build(t->graph, IR_SELECT, IR_TYPE_VEC3, 0,
                                (ir_ref[]){t->turned, closure_view(t->shader, t->host), normal}, 3)
                     : normal;
}

/*
 * Schlick's curve F is bent by color82 at 82 degrees (Hoffman 2019, "Fresnel Equations Considered
 * Harmful"). Closures know no such colour, so the one at 90 degrees is chosen for which the plain
 * curve passes through the same reflectance there:
 *
 *     F'(82) = color82 · F(82),    color90' = color90 - (1 - color82) · F(82) / q,    q =
 * (6/7)^exponent
 */
static ir_ref bent_edge(struct tree *t, ir_ref leaf, ir_ref color90)
{
    struct ir_graph *g = t->graph;
    ir_ref color82 = input(t, leaf, "color82", 7), color0 = input(t, leaf, "color0", 6);
    if (ir_const_is(g, color82, 1.0f))
        return color90;
    ir_ref q = ir_op2(g, IR_POW, ir_const_float(g, 6.0f / 7.0f), input(t, leaf, "exponent", 8));
    ir_ref at82 =
        ir_op2(g, IR_MUL, closure_one_minus(g, color82), ir_op3(g, IR_MIX, color0, color90, q));
    ir_ref edge = ir_op2(g, IR_SUB, color90, ir_op2(g, IR_DIV, at82, q));
    return ir_op2(g, IR_MAX, edge, ir_const_float(g, 0.0f));
}

/* Ops that work component by component, and have no other meaning for scalars. */
static bool is_componentwise(enum ir_op op)
{
    uint8_t rule = ir_op_info(op)->rule;
    return rule == IR_RULE_SAME
               ? op != IR_NORMALIZE && op != IR_CROSS && op != IR_REFLECT && op != IR_FACEFORWARD
           : rule == IR_RULE_SPLAT ? op != IR_REFRACT
                                   : rule == IR_RULE_ARITH || op == IR_SELECT;
}

enum { MAX_DEPTH = 12 };

/*
 * A component of a vector, as far down as that goes: languages without vectors of two components
 * are spared them. (Roughness is one, of which closures take the parts.)
 */
static ir_ref component(struct ir_graph *g, ir_ref value, unsigned index, unsigned depth)
{
    const struct ir_node node = *ir_get(g, value);
    bool is_plain = depth && is_componentwise(node.op) && ir_type_info(node.type)->columns == 1;
    for (uint32_t i = 0; i < node.num_args; i++)
        is_plain &= !ir_type_is_matrix(ir_type_of(g, ir_arg(g, value, i)));
    if (!is_plain || node.num_args > 3)
        return ir_component(g, value, index);
    ir_ref args[3];
    for (uint32_t i = 0; i < node.num_args; i++) {
        args[i] = ir_arg(g, value, i);
        if (ir_type_info(ir_type_of(g, args[i]))->components > 1)
            args[i] = component(g, args[i], index, depth - 1);
    }
    ir_push_origin(g, node.origin);
    ir_ref built = ir_build(g, (enum ir_op)node.op, ir_type_info(node.type)->scalar, node.attr,
                            args, node.num_args);
    ir_pop_origin(g);
    return built;
}

/*
 * One word of a row: an input's name, perhaps with a part (".x", ".y"), with a direction in which
 * the light is scattered (".reflected",
 * ".transmitted"), "white" as a tint, or with what becomes of a normal (".facing") and of Schlick's
 * last colour (".bent"); or a constant: a digit, or text in quotes.
 */
static ir_ref argument(struct tree *t, ir_ref leaf, const char *word, size_t len)
{
    if (word[0] >= '0' && word[0] <= '9')
        return ir_const_int(t->graph, word[0] - '0');
    if (word[0] == '\'')
        return ir_const_string(t->graph, str_intern(t->shader->strings, word + 1, len - 2));
    const char *dot = memchr(word, '.', len);
    size_t name_len = dot ? (size_t)(dot - word) : len;
    bool is_white = name_len == 5 && memcmp(word, "white", 5) == 0;
    ir_ref value =
        is_white ? ir_const_splat(t->graph, IR_TYPE_VEC3, 1.0f) : input(t, leaf, word, name_len);
    if (!dot || !value)
        return value;
    if (dot[1] == 'r')
        return scattered(t, leaf, value, REFLECTED);
    if (dot[1] == 't')
        return scattered(t, leaf, value, TRANSMITTED);
    if (dot[1] == 'f')
        return facing(t, value);
    if (dot[1] == 'b')
        return bent_edge(t, leaf, value);
    return component(t->graph, value, dot[1] == 'x' ? 0 : 1, MAX_DEPTH);
}

struct arguments {
    ir_ref refs[32];
    unsigned count;
};

static void add_words(struct tree *t, ir_ref leaf, const char *words, struct arguments *out)
{
    while (*words && out->count < 32) {
        size_t len = strcspn(words, " ");
        ir_ref value = argument(t, leaf, words, len);
        assert(value);
        out->refs[out->count++] = value;
        words += len + (words[len] == ' ');
    }
}

/* ---- Leaves ---- */

static ir_ref call(struct tree *t, const char *name, ir_type_id type, const ir_ref *args,
                   unsigned n)
{
    str_id id = str_intern_z(t->shader->strings, name);
    uint32_t callee = ir_add_callee(
        t->graph, (struct ir_callee){.kind = IR_CALLEE_CLOSURE, .index = id, .name = id});
    return ir_build(t->graph, IR_LEAF, type, callee, args, n);
}

/* The number that a colour has in all of its parts; the colour itself, where there is none. */
static ir_ref number_of(const struct ir_graph *g, ir_ref color)
{
    const struct ir_node *node = ir_get(g, color);
    bool is_splat = (node->op == IR_CONSTRUCT || node->op == IR_CONVERT) && node->num_args == 1;
    return is_splat && ir_type_of(g, ir_arg(g, color, 0)) == IR_TYPE_FLOAT ? ir_arg(g, color, 0)
                                                                           : color;
}

static ir_ref scaled(struct tree *t, ir_ref closure, ir_ref factor)
{
    if (!closure || !factor || ir_const_is(t->graph, factor, 1.0f))
        return closure;
    if (ir_const_is(t->graph, factor, 0.0f))
        return 0;
    ir_ref args[2] = {closure, number_of(t->graph, factor)};
    return ir_build(t->graph, IR_CLOSURE_SCALE, ir_type_of(t->graph, closure), 0, args, 2);
}

static ir_ref sum(struct tree *t, ir_ref a, ir_ref b)
{
    ir_ref args[2] = {a, b};
    if (!a || !b)
        return a ? a : b;
    return ir_build(t->graph, IR_CLOSURE_ADD, ir_type_of(t->graph, a), 0, args, 2);
}

/* By what one closure is multiplied in another; 0: it is not in there. */
static ir_ref factor_over(struct tree *t, ir_ref closure, ir_ref scale)
{
    const struct ir_node *node = ir_get(t->graph, scale);
    ir_ref factor = 0;
    for (; node->op == IR_CLOSURE_SCALE; node = ir_get(t->graph, scale)) {
        ir_ref own = ir_arg(t->graph, scale, 1);
        scale = ir_arg(t->graph, scale, 0);
        factor = factor ? ir_op2(t->graph, IR_MUL, own, factor) : own;
        if (scale == closure)
            return factor;
    }
    return 0;
}

static ir_ref mixed(struct tree *t, ir_ref bg, ir_ref fg, ir_ref mix)
{
    ir_ref args[3] = {bg, fg, mix};
    if (ir_const_is(t->graph, mix, 0.0f) || bg == fg)
        return bg;
    if (ir_const_is(t->graph, mix, 1.0f))
        return fg;
    if (!bg)
        return scaled(t, fg, mix);
    if (!fg)
        return scaled(t, bg, closure_one_minus(t->graph, mix));
    ir_ref factor = factor_over(t, bg, fg);
    if (factor) /* the closure once, by a mix of 1 and the factor */
        return scaled(t, bg,
                      ir_op3(t->graph, IR_MIX,
                             ir_const_splat(t->graph, ir_type_of(t->graph, factor), 1.0f), factor,
                             mix));
    return ir_build(t->graph, IR_CLOSURE_MIX, ir_type_of(t->graph, bg), 0, args, 3);
}

static ir_ref layered(struct tree *t, ir_ref top, ir_ref base)
{
    ir_ref args[2] = {top, base};
    if (!top || !base)
        return top ? top : base;
    return ir_build(t->graph, IR_LAYER, IR_TYPE_BSDF, 0, args, 2);
}

static ir_ref transparent(struct tree *t)
{
    return call(t, t->host->rows->transparent, IR_TYPE_BSDF, NULL, 0);
}

/*
 * Does an option of a row say anything? Its first input is 0, false or the usual word where it does
 * not.
 */
static bool is_wanted(const struct tree *t, ir_ref leaf, const struct closure_option *option)
{
    ir_ref value = input(t, leaf, option->input, strlen(option->input));
    if (!value || ir_const_is(t->graph, value, 0.0f))
        return false;
    struct ir_value constant;
    if (!ir_get_const(t->graph, value, &constant))
        return true;
    return constant.type == IR_TYPE_STRING ? is_string(t, value, option->unless)
                                           : constant.w[0].u != 0;
}

static ir_ref side_call(struct tree *t, ir_ref leaf, const struct closure_row *row, enum side side)
{
    t->side = side;
    struct arguments args = {.count = 0};
    add_words(t, leaf, row->arguments, &args);
    for (const struct closure_option *option = row->options; option && option->input; option++)
        if (is_wanted(t, leaf, option))
            add_words(t, leaf, option->arguments, &args);
    return call(t, row->closure, ir_type_of(t->graph, leaf), args.refs, args.count);
}

/*
 * Facets that mirror about the view direction are met head-on, whatever the angle to the surface
 * is: they are to reflect as much more as they would at that angle.
 */
static ir_ref turned_factor(struct tree *t, ir_ref leaf)
{
    struct ir_graph *g = t->graph;
    ir_ref cosine =
        ir_op1(g, IR_ABS,
               ir_op2(g, IR_DOT, input(t, leaf, "normal", 6), closure_view(t->shader, t->host)));
    struct closure_interface interface = {.color0 = input(t, leaf, "color0", 6),
                                          .color90 = input(t, leaf, "color90", 7),
                                          .exponent = input(t, leaf, "exponent", 8),
                                          .ior = input(t, leaf, "ior", 3),
                                          .extinction = input(t, leaf, "extinction", 10)};
    ir_ref more =
        closure_fresnel_rise(g, &interface, ir_op2(g, IR_MIN, cosine, ir_const_float(g, 1.0f)));
    ir_ref one = ir_const_splat(g, ir_type_of(g, more), 1.0f);
    return ir_build(g, IR_SELECT, ir_type_of(g, more), 0, (ir_ref[]){t->turned, more, one}, 3);
}

/*
 * Through a shell without an inside light goes on as it came, in the colour that the leaf has for
 * transmission.
 */
static ir_ref straight(struct tree *t, ir_ref leaf, const char *word)
{
    ir_ref tint = argument(t, leaf, word, strcspn(word, " "));
    return scaled(t, transparent(t), tint);
}

/* "tint.transmitted" of a row; NULL: its leaf has no other side. */
static const char *transmitted_word(const struct closure_row *row)
{
    const char *at = strstr(row->arguments, ".transmitted");
    while (at && at > row->arguments && at[-1] != ' ')
        at--;
    return at;
}

static bool is_false(const struct tree *t, ir_ref value)
{
    struct ir_value constant;
    return !value || (ir_get_const(t->graph, value, &constant) && constant.w[0].u == 0);
}

/*
 * One closure; of leaves that transmit one for each side, where the sides differ in more than in
 * tints.
 */
static ir_ref row_call(struct tree *t, ir_ref leaf, const struct closure_row *row)
{
    const char *word = transmitted_word(row);
    bool transmits = word && scatters(t, leaf, TRANSMITTED),
         reflects = !word || scatters(t, leaf, REFLECTED);
    ir_ref turned = reflects ? input(t, leaf, "retroreflective", 15) : 0,
           thin = transmits ? t->thin : 0;
    t->turned = is_false(t, turned) ? 0 : turned;
    ir_ref whole = t->turned && transmits ? 0 : side_call(t, leaf, row, BOTH_SIDES);
    ir_ref reflected = reflects && (!whole || thin) ? side_call(t, leaf, row, REFLECTED) : 0;
    if (t->turned) {
        ir_ref factor = turned_factor(t, leaf);
        whole = scaled(t, whole, factor);
        reflected = scaled(t, reflected, factor);
    }
    t->turned = 0;
    if (!whole)
        whole = sum(t, reflected, side_call(t, leaf, row, TRANSMITTED));
    t->side = BOTH_SIDES;
    return thin ? mixed(t, whole, layered(t, reflected, straight(t, leaf, word)),
                        ir_convert(t->graph, IR_TYPE_FLOAT, thin))
                : whole;
}

/* Emission and media are what the leaf's own functions give for the view at hand. */
static ir_ref emission(struct tree *t, ir_ref leaf)
{
    ir_ref radiance = closure_call(t->shader, t->host, leaf, LEAF_EMISSION, NULL);
    return radiance && !ir_const_is(t->graph, radiance, 0.0f)
               ? call(t, t->host->rows->emission, IR_TYPE_EDF, &radiance, 1)
               : 0;
}

static ir_ref medium(struct tree *t, ir_ref leaf)
{
    struct ir_graph *g = t->graph;
    ir_ref zero = ir_const_splat(g, IR_TYPE_VEC3, 0.0f);
    ir_ref absorption = closure_call(t->shader, t->host, leaf, LEAF_ABSORPTION, NULL);
    ir_ref scattering = closure_call(t->shader, t->host, leaf, LEAF_SCATTERING, NULL);
    ir_ref anisotropy = closure_call(t->shader, t->host, leaf, LEAF_ANISOTROPY, NULL);
    absorption = absorption ? absorption : zero;
    ir_ref extinction = scattering ? ir_op2(g, IR_ADD, absorption, scattering) : absorption;
    ir_ref albedo = scattering ? ir_op2(g, IR_DIV, scattering, extinction) : zero;
    ir_ref args[3] = {albedo, extinction, anisotropy ? anisotropy : ir_const_float(g, 0.0f)};
    return call(t, t->host->rows->medium, IR_TYPE_VDF, args, 3);
}

static ir_ref leaf_call(struct tree *t, ir_ref leaf)
{
    const struct ir_node node = *ir_get(t->graph, leaf);
    const uint32_t *functions = t->host->leaf_functions(t->host->user_data, node.attr);
    if (functions[LEAF_FACTOR] != LANG_NONE)
        return scaled(t, t->of[ir_arg(t->graph, leaf, node.num_args - 1)],
                      closure_call(t->shader, t->host, leaf, LEAF_FACTOR, NULL));
    const char *family = str_text(t->shader->strings, t->graph->callees.items[node.attr].name);
    ir_ref result = 0;
    const struct closure_row *row = t->host->rows->rows;
    while (row->family && strcmp(row->family, family) != 0)
        row++;
    if (row->family)
        result = row_call(t, leaf, row);
    else if (node.type == IR_TYPE_EDF)
        result = emission(t, leaf);
    else if (node.type == IR_TYPE_VDF)
        result = medium(t, leaf);
    else
        t->shader->unknown_closure = t->graph->callees.items[node.attr].name;
    return scaled(t, result, ir_arg(t->graph, leaf, 0));
}

/* ---- Shaders ---- */

static ir_ref seen_through(struct tree *t, ir_ref closure, ir_ref opacity)
{
    if (!opacity || ir_const_is(t->graph, opacity, 1.0f))
        return closure;
    t->shader->transparent = true;
    return mixed(t, transparent(t), closure, opacity);
}

static ir_ref unlit(struct tree *t, ir_ref emitted, ir_ref transmitted, ir_ref opacity)
{
    ir_ref color = ir_convert(t->graph, IR_TYPE_VEC3, emitted);
    ir_ref glow = call(t, t->host->rows->emission, IR_TYPE_EDF, &color, 1), through = 0;
    if (!ir_const_is(t->graph, transmitted, 0.0f)) {
        t->shader->transparent = true;
        through = scaled(t, transparent(t), ir_convert(t->graph, IR_TYPE_VEC3, transmitted));
    }
    return seen_through(t, sum(t, glow, through), opacity);
}

/* intensity · 2^exposure of what is emitted */
static ir_ref light(struct tree *t, ir_ref edf, ir_ref intensity, ir_ref exposure)
{
    ir_ref scale = ir_op2(t->graph, IR_MUL, intensity, ir_op1(t->graph, IR_EXP2, exposure));
    return scaled(t, edf, scale);
}

static ir_ref rewrite(struct tree *t, ir_ref ref)
{
    ir_ref a[4] = {0};
    const struct ir_node *node = ir_get(t->graph, ref);
    if (node->op == IR_LEAF)
        return leaf_call(t, ref);
    memcpy(a, ir_args(t->graph, ref), (node->num_args < 4 ? node->num_args : 4) * sizeof *a);
    switch (node->op) {
    case IR_LAYER: return layered(t, t->of[a[0]], t->of[a[1]]);
    case IR_CLOSURE_MIX:
    case IR_SHADER_MIX: return mixed(t, t->of[a[0]], t->of[a[1]], a[2]);
    case IR_CLOSURE_ADD: return sum(t, t->of[a[0]], t->of[a[1]]);
    case IR_CLOSURE_SCALE: return scaled(t, t->of[a[0]], a[1]);
    case IR_SURFACE_SHADER: return seen_through(t, sum(t, t->of[a[0]], t->of[a[1]]), a[2]);
    case IR_SURFACE_UNLIT: return unlit(t, a[0], a[1], a[2]);
    case IR_VOLUME_SHADER: return sum(t, t->of[a[0]], t->of[a[1]]);
    case IR_LIGHT_SHADER: return light(t, t->of[a[0]], a[1], a[2]);
    case IR_UNIFORM: /* what another layer of a network gives */
        return ir_build(t->graph, IR_UNIFORM, IR_TYPE_BSDF, node->attr, NULL, 0);
    default: return 0;
    }
}

static ir_ref closure_of(struct tree *t, ir_ref root)
{
    if (!root)
        return 0;
    t->of = ARENA_ARRAY(t->shader->arena, ir_ref, root + 1);
    bool is_thin =
        ir_get(t->graph, root)->op == IR_SURFACE_SHADER && !is_false(t, ir_arg(t->graph, root, 3));
    t->thin = is_thin ? ir_arg(t->graph, root, 3) : 0;
    uint8_t *needed = ir_mark(t->graph, &root, 1, t->shader->arena);
    for (ir_ref ref = 1; ref <= root; ref++) {
        if (!needed[ref] || !(ir_get(t->graph, ref)->flags & IR_NODE_CLOSURE))
            continue;
        ir_push_origin_of(t->graph, ref);
        t->of[ref] = rewrite(t, ref);
        ir_pop_origin(t->graph);
    }
    return t->of[root];
}

/* ---- Effects ---- */

static ir_ref incident(struct shader *shader)
{
    str_id name = str_intern_z(shader->strings, "u_incident");
    return shader_read(shader, shader_private_uniform(shader, name, IR_TYPE_VEC3, 0));
}

/* The way from the eye is given to such a shader. */
static ir_ref with_incident(struct shader *shader, ir_ref root)
{
    uint32_t eye = shader_find_variable(shader, BLOCK_PRIVATE_UNIFORMS, STR_u_viewPosition);
    if (eye == UINT32_MAX)
        return root;
    ir_ref point = shader_stream(shader, STR_positionWorld, IR_TYPE_VEC3),
           from = shader_read(shader, eye), way = incident(shader);
    root = ir_replace(shader->graph, root, ir_op2(shader->graph, IR_SUB, point, from), way,
                      shader->arena);
    ir_ref back = ir_op1(shader->graph, IR_NEG, way);
    return ir_replace(shader->graph, root, ir_op2(shader->graph, IR_SUB, from, point), back,
                      shader->arena);
}

/* It is given a unit normal, too: nothing came between it and the surface. */
static ir_ref with_unit_normal(struct shader *shader, ir_ref root)
{
    ir_ref normal = shader_stream(shader, STR_normalWorld, IR_TYPE_VEC3),
           unit = ir_op1(shader->graph, IR_NORMALIZE, normal);
    return ir_replace(shader->graph, root, unit, normal, shader->arena);
}

static void effect(struct tree *t, enum effect_kind kind, uint32_t index, ir_ref value)
{
    if (kind == EFFECT_OUTPUT)
        value = with_unit_normal(t->shader, with_incident(t->shader, value));
    shader_effect(t->shader, STAGE_PIXEL,
                  (struct effect){.kind = (uint8_t)kind, .index = index, .value = value});
}

static uint32_t output(struct tree *t, const char *name, ir_type_id type, str_id doc_type)
{
    str_id id = str_intern_z(t->shader->strings, name);
    return shader_add_variable(
        t->shader, &(struct shader_variable){
                       .name = id, .block = BLOCK_OUTPUTS, .type = type, .doc_type = doc_type});
}

/* No closure at all is black. */
static ir_ref or_black(struct tree *t, ir_ref closure)
{
    ir_ref black = ir_const_splat(t->graph, IR_TYPE_VEC3, 0.0f);
    return closure ? closure : call(t, t->host->rows->emission, IR_TYPE_EDF, &black, 1);
}

/* Those that are left: weights of 0 have dropped some. */
static void add_closures(const struct tree *t, const ir_ref *roots, uint32_t num_roots)
{
    const uint8_t *needed = ir_mark(t->graph, roots, num_roots, t->shader->arena);
    for (ir_ref ref = 1; ref < t->graph->nodes.len; ref++)
        if (needed[ref] && ir_get(t->graph, ref)->op == IR_LEAF)
            shader_add_closure(t->shader, ref);
}

static void emit_sides(struct tree *t, ir_ref front, ir_ref back)
{
    struct ir_graph *g = t->graph;
    uint32_t out = output(t, t->host->rows->output, IR_TYPE_BSDF, 0);
    front = or_black(t, closure_of(t, front));
    if (!back) {
        add_closures(t, &front, 1);
        effect(t, EFFECT_OUTPUT, out, front);
        return;
    }
    str_id name = str_intern_z(t->shader->strings, "u_backfacing");
    ir_ref behind =
        shader_read(t->shader, shader_private_uniform(t->shader, name, IR_TYPE_BOOL, 0));
    back = or_black(t, closure_of(t, back));
    add_closures(t, (ir_ref[]){front, back}, 2);
    effect(t, EFFECT_IF, 0, ir_op1(g, IR_NOT, behind));
    effect(t, EFFECT_OUTPUT, out, front);
    effect(t, EFFECT_END, 0, 0);
    effect(t, EFFECT_IF, 0, behind);
    effect(t, EFFECT_OUTPUT, out, back);
    effect(t, EFFECT_END, 0, 0);
}

/* A shader of its own, which moves the point: the vertex stage. */
static void emit_displacement(struct tree *t, ir_ref displacement)
{
    ir_ref offset = displacement ? closure_offset(t->shader, displacement) : 0;
    if (!offset)
        return;
    ir_ref before = shader_stream(t->shader, STR_positionWorld, IR_TYPE_VEC3);
    ir_ref moved = with_unit_normal(t->shader, ir_op2(t->graph, IR_ADD, before, offset));
    t->shader->displaced = true;
    shader_effect(t->shader, STAGE_VERTEX,
                  (struct effect){.kind = EFFECT_POSITION, .value = moved});
}

static bool emit_value(struct tree *t, ir_ref root)
{
    ir_type_id type = ir_type_of(t->graph, root);
    if (type >= IR_NUM_TYPES || type == IR_TYPE_SAMPLER || type == IR_TYPE_VOID)
        return false;
    t->shader->kind = SHADER_VALUE;
    effect(t, EFFECT_OUTPUT, output(t, "out", type, t->shader->value_type), root);
    return true;
}

/* What is shaded is seen along a ray, which such languages know. */
static ir_ref view(struct shader *shader)
{
    struct ir_graph *g = shader->graph;
    ir_push_name(g, str_intern_z(shader->strings, "incident"));
    ir_ref way = ir_op1(g, IR_NORMALIZE, incident(shader));
    ir_change_name(g, STR_V);
    ir_ref view = ir_op1(g, IR_NEG, way);
    ir_pop_origin(g);
    return view;
}

bool closure_emit_tree(struct shader *shader, const struct closure_host *host, ir_ref root)
{
    host->point->view = view(shader);
    struct tree t = {
        .shader = shader, .graph = shader->graph, .host = host, .inputs = &(struct leaf_inputs){0}};
    ir_ref front = root, back = 0,
           displacement = root && ir_type_of(t.graph, root) == IR_TYPE_DISPLACEMENT ? root : 0;
    if (root && ir_get(t.graph, root)->op == IR_MATERIAL) {
        front = ir_arg(t.graph, root, 0);
        back = ir_arg(t.graph, root, 1);
        displacement = ir_arg(t.graph, root, 2);
        if (!front)
            front = ir_arg(t.graph, root, 3);
    }
    emit_displacement(&t, displacement);
    if (displacement == root)
        return shader->displaced;
    ir_type_id type = front ? ir_type_of(t.graph, front) : IR_TYPE_SURFACE;
    if (!ir_type_is_closure(type) && !ir_type_is_shader(type))
        return emit_value(&t, front);
    shader->kind = type == IR_TYPE_VOLUME || type == IR_TYPE_VDF ? SHADER_VOLUME : SHADER_SURFACE;
    emit_sides(&t, front, back);
    return !shader->unknown_closure;
}

static bool emit_result(struct tree *t, const struct closure_result *result)
{
    ir_type_id type = ir_type_of(t->graph, result->value);
    ir_ref value = result->value;
    str_id doc_type = result->doc_type;
    if (type == IR_TYPE_DISPLACEMENT) {
        value = closure_offset(t->shader, value);
        type = IR_TYPE_VEC3;
        doc_type = 0;
    } else if (ir_type_is_closure(type) || ir_type_is_shader(type)) {
        value = closure_of(t, value);
        type = IR_TYPE_BSDF;
    }
    uint32_t out = output(t, str_text(t->shader->strings, result->name), type, doc_type);
    if (!value && type == IR_TYPE_VEC3)
        value = ir_const_splat(t->graph, type, 0.0f);
    if (value) /* no closure at all is what the output is at first */
        effect(t, EFFECT_OUTPUT, out, value);
    else
        t->shader->variables.items[out].stages = 1 << STAGE_PIXEL;
    return !t->shader->unknown_closure;
}

bool closure_emit_node(struct shader *shader, const struct closure_host *host,
                       const struct closure_result *results, unsigned n)
{
    host->point->view = view(shader);
    struct tree t = {
        .shader = shader, .graph = shader->graph, .host = host, .inputs = &(struct leaf_inputs){0}};
    shader->kind = SHADER_VALUE;
    bool good = true;
    const struct effect_list *effects = &shader->stages[STAGE_PIXEL].effects;
    for (unsigned i = 0; i < n; i++)
        good = results[i].value && emit_result(&t, &results[i]) && good;
    for (uint32_t i = 0; i < effects->len; i++)
        add_closures(&t, &effects->items[i].value, 1);
    return good;
}
