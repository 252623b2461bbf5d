// SPDX-License-Identifier: Apache-2.0
/*
 * blur: a shader computes its input at one point, but the input is a graph, which the builder can
 * build again for other texture coordinates:
 *
 *     blur(in) = Σ weight[i] weight[j] in(uv + size (node[i], node[j])),  i, j = 0..2
 *
 * The nodes are those of three-point quadrature (Abramowitz and Stegun, "Handbook of Mathematical
 * Functions", 25.4.30 and 25.4.46), exact if the input is a polynomial of degree 5 over the kernel.
 * The footprint of a texture read is as wide as the distance between nodes, so smaller mip levels
 * cover the space between them.
 *
 * IR nodes that do not depend on texture coordinates stay unchanged.
 *
 * Around a point of a surface, in place of texture coordinates, all that changes over the surface
 * moves, along two axes of the surface: its change by a pixel, over that of the position.
 */
#include "build/recorder.h"

#include "ir/arithmetic.h"
#include "shader/formula.h"

enum { POINTS = 3, TAPS = POINTS * POINTS, MAX_MOVED = 2000 };
enum { KERNEL_BOX, KERNEL_GAUSSIAN };

static const struct kernel {
    const char *name;
    float node, side, middle; /* the outer node, in sizes; the weights */
} kernels[] = {
    /* Gauss-Legendre: sqrt(3/5) of half the size */
    [KERNEL_BOX] = {"box", 0.38729833f, 5.0f / 18.0f, 8.0f / 18.0f},
    /* Gauss-Hermite: sqrt(3) standard deviations; a size is six of them */
    [KERNEL_GAUSSIAN] = {"gaussian", 0.28867513f, 1.0f / 6.0f, 4.0f / 6.0f},
};

struct blur {
    struct builder *b;
    const uint8_t *needed;
    ir_ref in;
    ir_ref offsets[TAPS][2]; /* of texture coordinates, or along the axes of the surface */
    ir_ref skew;   /* of the axes: how much of x is in a step down the picture; 0: no surface */
    ir_ref *moved; /* TAPS per node: 0 if it depends on nothing that moves */
    uint32_t num_moved;
    bool is_unknown; /* it depends on an argument of the function around it */
    bool is_layered; /* it depends on another layer of an OSL network */
};

static const struct kernel *find_kernel(const struct builder *b, ir_ref filtertype)
{
    struct ir_value value;
    bool known =
        filtertype && ir_get_const(b->graph, filtertype, &value) && value.type == IR_TYPE_STRING;
    const char *name = known ? build_text(b, value.w[0].u) : "";
    for (size_t i = 0; i < sizeof kernels / sizeof *kernels; i++)
        if (strcmp(name, kernels[i].name) == 0)
            return &kernels[i];
    return &kernels[KERNEL_BOX];
}

static void set_offsets(struct blur *blur, const struct kernel *kernel, ir_ref x, ir_ref y)
{
    struct ir_graph *g = blur->b->graph;
    for (int tap = 0; tap < TAPS; tap++)
        for (int axis = 0; axis < 2; axis++) {
            int step = (axis == 0 ? tap % POINTS : tap / POINTS) - 1;
            blur->offsets[tap][axis] =
                ir_mul(g, axis == 0 ? x : y, ir_const_float(g, (float)step * kernel->node));
        }
}

static ir_ref *moved_of(const struct blur *blur, ir_ref ref)
{
    return &blur->moved[(size_t)ref * TAPS];
}

/* A stream that moves: all of them on the surface, else texture coordinates. */
static bool moves(const struct blur *blur, const struct ir_node *node)
{
    const struct shader *shader = blur->b->shader;
    if (node->op != IR_STREAM)
        return false;
    const char *name =
        str_text(shader->strings, shader->interface.variables.items[node->attr].name);
    return blur->skew ? ir_type_is_float(node->type) : strncmp(name, "texcoord_", 9) == 0;
}

static void move_texcoord(struct blur *blur, ir_ref ref)
{
    struct ir_graph *g = blur->b->graph;
    ir_type_id type = ir_type_of(g, ref);
    for (int tap = 0; tap < TAPS; tap++) {
        ir_ref parts[3] = {blur->offsets[tap][0], blur->offsets[tap][1], ir_const_float(g, 0.0f)};
        ir_ref offset = ir_construct(g, type, parts, ir_type_info(type)->components);
        moved_of(blur, ref)[tap] = ir_add(g, ref, offset);
    }
}

/* The axes of the surface are the steps of a pixel to the right, and down without a part of that.
 */
static void move_stream(struct blur *blur, ir_ref ref)
{
    struct ir_graph *g = blur->b->graph;
    ir_ref right = ir_op1(g, IR_DFDX, ref), down = ir_op1(g, IR_DFDY, ref);
    down = ir_sub(g, down, ir_mul(g, right, blur->skew));
    for (int tap = 0; tap < TAPS; tap++) {
        ir_ref x = ir_mul(g, right, blur->offsets[tap][0]),
               y = ir_mul(g, down, blur->offsets[tap][1]);
        moved_of(blur, ref)[tap] = ir_add(g, ref, ir_add(g, x, y));
    }
}

/* The width of a read along an axis whose outer nodes are these taps. */
static ir_ref footprint(struct blur *blur, ir_ref uv, enum ir_op derivative, int before, int behind)
{
    const ir_ref *taps = moved_of(blur, uv);
    ir_ref screen = ir_op1(blur->b->graph, derivative, uv);
    return FORMULA(blur->b->shader, "mx_blur_footprint", taps[before], taps[behind], screen);
}

static void move_texture(struct blur *blur, ir_ref ref)
{
    struct ir_graph *g = blur->b->graph;
    ir_ref file = ir_arg(g, ref, 0), uv = ir_arg(g, ref, 1);
    ir_ref dx = footprint(blur, uv, IR_DFDX, 3, 5), dy = footprint(blur, uv, IR_DFDY, 1, 7);
    for (int tap = 0; tap < TAPS; tap++) {
        ir_ref args[4] = {file, moved_of(blur, uv)[tap], dx, dy};
        moved_of(blur, ref)[tap] = ir_build(g, IR_TEX_GRAD, IR_TYPE_VEC4, 0, args, 4);
    }
}

/* The derivative of texture coordinates for a read, as wide as the distance between nodes. */
static ir_ref widened(struct blur *blur, ir_ref gradient, enum ir_op derivative, int before,
                      int behind)
{
    struct ir_graph *g = blur->b->graph;
    ir_ref uv = ir_get(g, gradient)->op == derivative ? ir_arg(g, gradient, 0) : 0;
    return uv && moved_of(blur, uv)[0] ? footprint(blur, uv, derivative, before, behind) : gradient;
}

/* Reads of tiles, and of images with filters in shader code. */
static void move_gradient_texture(struct blur *blur, ir_ref ref)
{
    struct ir_graph *g = blur->b->graph;
    ir_ref at = ir_arg(g, ref, 1), dx = widened(blur, ir_arg(g, ref, 2), IR_DFDX, 3, 5),
           dy = widened(blur, ir_arg(g, ref, 3), IR_DFDY, 1, 7);
    for (int tap = 0; tap < TAPS; tap++) {
        ir_ref moved = moved_of(blur, at)[tap],
               args[4] = {ir_arg(g, ref, 0), moved ? moved : at, dx, dy};
        moved_of(blur, ref)[tap] = ir_build(g, IR_TEX_GRAD, IR_TYPE_VEC4, 0, args, 4);
    }
}

static void move_node(struct blur *blur, ir_ref ref)
{
    struct ir_graph *g = blur->b->graph;
    const struct ir_node node = *ir_get(g, ref);
    ir_ref *args = ARENA_ARRAY(blur->b->arena, ir_ref, node.num_args);
    for (int tap = 0; tap < TAPS; tap++) {
        for (uint32_t i = 0; i < node.num_args; i++) {
            ir_ref arg = ir_arg(g, ref, i), moved = moved_of(blur, arg)[tap];
            args[i] = moved ? moved : arg;
        }
        moved_of(blur, ref)[tap] = ir_copy(g, ref, args);
    }
}

static bool follows(const struct blur *blur, ir_ref ref)
{
    const struct ir_node *node = ir_get(blur->b->graph, ref);
    bool any = moves(blur, node);
    for (uint32_t i = 0; i < node->num_args && !any; i++)
        any = moved_of(blur, ir_arg(blur->b->graph, ref, i))[0] != 0;
    return any;
}

static void move(struct blur *blur, ir_ref ref)
{
    const struct ir_node *node = ir_get(blur->b->graph, ref);
    blur->is_unknown |= node->op == IR_PARAM;
    blur->is_layered |= node->op == IR_STREAM && blur->b->recorded
                        && recorder_layer_of(blur->b->recorded, node->attr);
    if (!follows(blur, ref) || ++blur->num_moved > MAX_MOVED)
        return;
    if (node->op == IR_STREAM && blur->skew)
        move_stream(blur, ref);
    else if (node->op == IR_STREAM)
        move_texcoord(blur, ref);
    else if (node->op == IR_TEX)
        move_texture(blur, ref);
    else if (node->op == IR_TEX_GRAD)
        move_gradient_texture(blur, ref);
    else
        move_node(blur, ref);
}

static ir_ref sum(struct blur *blur, const struct kernel *kernel)
{
    struct ir_graph *g = blur->b->graph;
    ir_ref total = 0;
    for (int tap = 0; tap < TAPS; tap++) {
        float x = tap % POINTS == 1 ? kernel->middle : kernel->side,
              y = tap / POINTS == 1 ? kernel->middle : kernel->side;
        ir_ref part = ir_mul(g, moved_of(blur, blur->in)[tap], ir_const_float(g, x * y));
        total = total ? ir_add(g, total, part) : part;
    }
    return total;
}

static ir_ref stay_sharp(struct builder *b, ir_ref in, elem_id node, const char *why)
{
    const struct document *doc = &b->lib->doc;
    diag_add(b->diags, DIAG_ID_blur_left_out, doc_place(doc, node),
             build_text(b, doc_element(doc, node)->category), why);
    return in;
}

/* The mean; `in` itself, after a message about a node, where it cannot be moved. */
static ir_ref mean(struct blur *blur, const struct kernel *kernel, elem_id node)
{
    struct builder *b = blur->b;
    ir_ref in = blur->in;
    blur->is_layered = b->recorder != NULL;
    blur->needed = ir_mark(b->graph, &in, 1, b->arena);
    blur->moved = ARENA_ARRAY(b->arena, ir_ref, ((size_t)in + 1) * TAPS);
    for (ir_ref ref = 1; ref <= in && blur->num_moved <= MAX_MOVED && !blur->is_layered; ref++)
        if (blur->needed[ref])
            move(blur, ref);
    if (blur->is_layered)
        return stay_sharp(b, in, node,
                          "a layer of an OSL network cannot evaluate it at other places");
    if (blur->num_moved > MAX_MOVED)
        return stay_sharp(b, in, node, "it is too large to evaluate nine times");
    if (blur->is_unknown)
        return stay_sharp(b, in, node,
                          "its graph became a function of the shader, because many nodes use it");
    return moved_of(blur, in)[0] ? sum(blur, kernel) : in;
}

ir_ref build_blur(struct builder *b, ir_ref in, ir_ref size, ir_ref filtertype, elem_id node)
{
    if (!in || ir_is_const(b->graph, in) || ir_const_is(b->graph, size, 0.0f))
        return in;
    const struct kernel *kernel = find_kernel(b, filtertype);
    struct blur blur = {.b = b, .in = in};
    set_offsets(&blur, kernel, size, size);
    return mean(&blur, kernel, node);
}

ir_ref build_blur_around(struct builder *b, ir_ref in, ir_ref position, ir_ref deviation)
{
    struct ir_graph *g = b->graph;
    const struct kernel *kernel = &kernels[KERNEL_GAUSSIAN];
    struct blur blur = {.b = b, .in = in};
    ir_ref right = ir_op1(g, IR_DFDX, position), down = ir_op1(g, IR_DFDY, position);
    blur.skew = FORMULA(b->shader, "mx_blur_skew", right, down);
    down = ir_sub(g, down, ir_mul(g, right, blur.skew));
    ir_ref size = ir_scaled(g, deviation, 6.0f);
    ir_ref x = FORMULA(b->shader, "mx_blur_over_length", size, right),
           y = FORMULA(b->shader, "mx_blur_over_length", size, down);
    set_offsets(&blur, kernel, x, y);
    return mean(&blur, kernel, build_element_origin(g)->element);
}
