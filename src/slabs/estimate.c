// SPDX-License-Identifier: Apache-2.0
#include "slabs/estimate.h"

#include "ir/arithmetic.h"

#include "lower/lower.h"
#include "slabs/difference.h"

#include <math.h>

/*
 * Points of the disc that a ball covers, by rings of equal area, and by angles around its centre:
 * threads and brushed metal look different from each. For each two lights beside the mirror, along
 * and across the plane of the view, and one from the side. In the mirror itself all colours are
 * white.
 */
enum { NUM_LIGHTS = 3, NUM_TEXELS = 4 };
/* How much of a picture such light is; fitted to the drawn errors of the examples. */
static const float light_weights[NUM_LIGHTS] = {0.1f, 0.1f, 0.3f};
#define GOLDEN_ANGLE 2.3999632f
#define TILT 0.2f /* of the half vector of the lights beside the mirror: a tangent */

#define AMBIENT 0.5f
#define RADIANCE 1.5f
#define BACKGROUND 0.5f

struct eye {
    struct shader *shader;
    const struct slabs_host *host;
    ir_ref view, light; /* vec3: stand for directions */
    unsigned at;        /* a place of the ball */
    uint64_t num_steps; /* of the evaluator so far */
    struct ir_value view_value, light_value;
};

/* ---- Sources ---- */

static struct ir_value value_of_three(float x, float y, float z)
{
    return (struct ir_value){.type = IR_TYPE_VEC3, .w = {{.f = x}, {.f = y}, {.f = z}}};
}

/* A colour, a number and a bump at once, for a texture that cannot be read. */
static const float fixed_texels[NUM_TEXELS][4] = {{0.5f, 0.5f, 0.9f, 1},
                                                  {0.3f, 0.45f, 0.8f, 1},
                                                  {0.7f, 0.55f, 0.9f, 1},
                                                  {0.45f, 0.35f, 0.85f, 1}};

static const float *texels_of(const struct slabs_host *host, const struct ir_node *node)
{
    return node->op == IR_TEXTURE && host->texels ? host->texels(host->user_data, node->attr)
                                                  : NULL;
}

/* The number of a texel, as if the texture repeated. The top row is at v = 1. */
static size_t texel_at(const union ir_word *place)
{
    unsigned at[2];
    for (unsigned i = 0; i < 2; i++) {
        float part = place[i].f - floorf(place[i].f);
        at[i] = part >= 0.0f && part < 1.0f ? (unsigned)(part * SLABS_TEXELS) : 0;
    }
    return (size_t)(SLABS_TEXELS - 1 - at[1]) * SLABS_TEXELS + at[0];
}

static bool texture(void *user_data, const struct ir_graph *graph, ir_ref ref,
                    const struct ir_value *place, struct ir_value *out)
{
    const struct eye *eye = user_data;
    const float *texels = texels_of(eye->host, ir_get(graph, ir_arg(graph, ref, 0))),
                *texel = fixed_texels[eye->at % NUM_TEXELS];
    *out = (struct ir_value){.type = ir_type_of(graph, ref)};
    if (texels && place && ir_type_is_float(place->type))
        texel = texels + texel_at(place->w) * 4;
    for (unsigned i = 0; i < 4; i++)
        out->w[i].f = texel[i];
    return true;
}

static bool source(void *user_data, const struct ir_graph *graph, ir_ref ref, struct ir_value *out)
{
    const struct eye *eye = user_data;
    const struct ir_node *node = ir_get(graph, ref);
    *out = (struct ir_value){.type = node->type};
    if (ref == eye->view || ref == eye->light) {
        *out = ref == eye->view ? eye->view_value : eye->light_value;
        return true;
    }
    switch (node->op) {
    case IR_UNIFORM:
        *out = eye->shader->interface.variables.items[node->attr].value;
        return out->type == node->type;
    case IR_STREAM:
        slabs_place_stream(eye->at, eye->shader->interface.variables.items[node->attr].name, out);
        return ir_type_is_float(node->type);
    case IR_DFDX:
    case IR_DFDY:
    case IR_FWIDTH: return true;
    default: return false;
    }
}

static uint32_t call(void *user_data, const struct ir_graph *graph, ir_ref ref,
                     const struct ir_value *args, struct ir_value *out)
{
    struct eye *eye = user_data;
    uint32_t steps_left = LANG_MAX_STEPS;
    uint32_t num =
        lang_eval_node(eye->shader->unit, graph, ref, args, &steps_left, eye->host->scratch, out);
    eye->num_steps += LANG_MAX_STEPS - steps_left;
    return num;
}

/* ---- Light ---- */

/* Returns what one lobe sends to the viewer: of the environment, of the light, and its own. */
static ir_ref light_of(struct eye *eye, const struct closure_host *host,
                       const struct closure_leaf *leaf)
{
    struct shader *shader = eye->shader;
    struct ir_graph *g = shader->graph;
    ir_ref zero = ir_const_float(g, 0.0f), mean = ir_const_float(g, CLOSURE_MEAN_WAY);
    ir_ref sum = ir_black(g);
    ir_ref albedo = closure_call(shader, host, leaf->leaf, LEAF_ALBEDO, NULL),
           value = closure_call(shader, host, leaf->leaf, LEAF_EVAL, &eye->light),
           glow = closure_call(shader, host, leaf->leaf, LEAF_EMISSION, NULL);
    if (albedo) {
        ir_ref even = ir_mul(g, albedo, closure_weight(shader, leaf, mean));
        sum = ir_add(g, sum, ir_scaled(g, even, AMBIENT));
    }
    if (value) {
        ir_ref way = closure_way(shader, host, eye->light);
        ir_ref lit = ir_mul(g, value, closure_weight(shader, leaf, way));
        sum = ir_add(g, sum, ir_scaled(g, lit, RADIANCE));
    }
    if (glow)
        sum = ir_add(g, sum, ir_mul(g, glow, closure_weight(shader, leaf, zero)));
    return ir_convert(g, IR_TYPE_VEC3, sum);
}

/* The colour of a closure; where it shows what is behind, before a grey background. */
static ir_ref color_of(struct eye *eye, ir_ref lobes, bool shows_behind)
{
    struct ir_graph *g = eye->shader->graph;
    struct closure_probe probe;
    struct closure_list list;
    closure_probe(eye->host->closures, eye->view, &probe);
    ir_ref none = ir_const_float(g, 0.0f), sum = ir_black(g);
    if (shows_behind) {
        sum = closure_throughput(eye->shader, &probe.host, lobes, none);
        sum = ir_scaled(g, sum, BACKGROUND);
    }
    closure_flatten(eye->shader, &probe.host, lobes, &list);
    for (uint32_t i = 0; i < list.leaves.len; i++)
        sum = ir_add(g, sum, light_of(eye, &probe.host, &list.leaves.items[i]));
    return sum;
}

/* ---- Colours ---- */

/* The view of a point, turned around the normal. */
static struct ir_value view_of(unsigned point)
{
    float square = ((float)point + 0.5f) / SLAB_NUM_VIEWS, turn = GOLDEN_ANGLE * (float)point;
    float sine = sqrtf(square), cosine = sqrtf(1.0f - square);
    return value_of_three(sine * cosf(turn), sine * sinf(turn), cosine);
}

static struct ir_value light_for(const struct ir_value *view, unsigned point, unsigned which)
{
    float angle = GOLDEN_ANGLE * (float)point + (which == 0 ? 0.0f : 1.5707963f), along = 0.0f;
    float scale = 1.0f / sqrtf(1.0f + TILT * TILT);
    float half[3] = {-TILT * cosf(angle) * scale, -TILT * sinf(angle) * scale, scale};
    if (which == NUM_LIGHTS - 1)
        return value_of_three(0.48f, 0.36f, 0.8f);
    for (unsigned c = 0; c < 3; c++)
        along += 2.0f * view->w[c].f * half[c];
    return value_of_three(along * half[0] - view->w[0].f, along * half[1] - view->w[1].f,
                          along * half[2] - view->w[2].f);
}

static bool evaluate(struct eye *eye, ir_ref color, struct ir_value *out)
{
    const struct ir_eval_env env = {
        .user_data = eye, .source = source, .call = call, .texture = texture};
    bool good = ir_eval(eye->shader->graph, color, &env, eye->host->scratch, out);
    eye->num_steps += color;
    arena_finish(eye->host->scratch);
    return good;
}

static bool look_at(struct eye *eye, ir_ref color, const struct slab_glance *glance,
                    struct slab_look *out)
{
    eye->at = glance->at;
    eye->view_value = view_of(glance->view);
    for (unsigned i = 0; i < NUM_LIGHTS; i++) {
        struct ir_value value;
        eye->light_value = light_for(&eye->view_value, glance->view, i);
        if (!evaluate(eye, color, &value))
            return false;
        for (unsigned c = 0; c < 3; c++)
            vec_push(eye->shader->arena, &out->colors, value.w[c].f);
    }
    return true;
}

/* ---- Places ---- */

/* Weights that no few of them add up to 0 by chance. */
static ir_ref weight_of(struct ir_graph *g, unsigned number)
{
    ir_ref parts[3];
    for (unsigned c = 0; c < 3; c++) {
        float turn = GOLDEN_ANGLE * (float)(number * 3 + c + 1);
        parts[c] = ir_const_float(g, cosf(turn));
    }
    return ir_construct(g, IR_TYPE_VEC3, parts, 3);
}

/* A vec3 that tells unlike places apart: a sum of all operands of closures. 0: nothing varies. */
static ir_ref signature_of(const struct eye *eye, const uint8_t *needed, ir_ref root)
{
    struct ir_graph *g = eye->shader->graph;
    ir_ref sum = 0, least = ir_const_splat(g, IR_TYPE_VEC3, -1.0f), most = ir_white(g);
    unsigned number = 0;
    for (ir_ref ref = 1; ref <= root; ref++) {
        bool is_matter =
            needed[ref]
            && (ir_type_is_closure(ir_type_of(g, ref)) || ir_type_is_shader(ir_type_of(g, ref)));
        uint32_t num_args = is_matter ? ir_get(g, ref)->num_args : 0;
        for (uint32_t i = 0; i < num_args; i++) {
            ir_ref arg = ir_arg(g, ref, i);
            ir_type_id type = arg ? ir_type_of(g, arg) : IR_TYPE_VOID;
            if ((type != IR_TYPE_FLOAT && type != IR_TYPE_VEC3) || ir_is_const(g, arg))
                continue;
            ir_ref value = ir_op3(g, IR_CLAMP, ir_convert(g, IR_TYPE_VEC3, arg), least, most);
            sum = ir_sum(g, sum, ir_mul(g, value, weight_of(g, number++)));
        }
    }
    return sum;
}

/* Glances that show all that varies. */
static bool find_glances(struct eye *eye, ir_ref root, struct slab_glances *out)
{
    const struct shader *shader = eye->shader;
    float values[SLAB_NUM_PLACES * 3];
    ir_ref signature = signature_of(eye, ir_mark(shader->graph, &root, 1, shader->arena), root);
    eye->view_value = eye->light_value = value_of_three(0.0f, 0.0f, 1.0f);
    for (eye->at = 0; signature && eye->at < SLAB_NUM_PLACES; eye->at++) {
        struct ir_value value;
        if (!evaluate(eye, signature, &value))
            return false;
        for (unsigned c = 0; c < 3; c++)
            values[eye->at * 3 + c] = value.w[c].f;
    }
    slabs_choose_glances(signature ? values : NULL, shader->arena, out);
    return true;
}

static struct eye open_eye(struct shader *shader, const struct slabs_host *host)
{
    struct eye eye = {.shader = shader, .host = host};
    eye.view = closure_probe_direction(shader->graph, 0);
    eye.light = closure_probe_direction(shader->graph, 1);
    return eye;
}

/* The colours of a surface, or of a closure that is the root; other nodes have none. */
static bool look_at_node(struct eye *eye, ir_ref ref, ir_ref root, struct slab_look *out)
{
    struct ir_graph *g = eye->shader->graph;
    uint8_t op = ir_get(g, ref)->op;
    bool is_surface = op == IR_SLAB_SURFACE || op == IR_SURFACE_SHADER,
         is_closure = ref == root && ir_type_of(g, ref) == IR_TYPE_BSDF, good = true;
    if ((!is_surface && !is_closure) || (is_surface && !ir_arg(g, ref, 0)))
        return true;
    ir_ref walked = slabs_walk(eye->shader, eye->host, ref);
    ir_ref color = color_of(eye, is_surface ? ir_arg(g, walked, 0) : walked,
                            op != IR_SURFACE_SHADER); /* <surface> has its own opacity */
    for (uint32_t i = 0; i < out->glances.items.len && good; i++)
        good = look_at(eye, color, &out->glances.items.items[i], out);
    return good;
}

void slabs_look(struct shader *shader, const struct slabs_host *host, ir_ref root,
                const struct slab_look *like, struct slab_look *out)
{
    struct eye eye = open_eye(shader, host);
    *out = (struct slab_look){.is_known = true};
    if (like)
        out->glances = like->glances;
    else
        out->is_known = find_glances(&eye, root, &out->glances);
    const uint8_t *needed = ir_mark(shader->graph, &root, 1, shader->arena);
    for (ir_ref ref = 1; ref <= root && out->is_known; ref++)
        out->is_known = !needed[ref] || look_at_node(&eye, ref, root, out);
    out->num_steps = eye.num_steps;
}

float slabs_difference(const struct slab_look *a, const struct slab_look *b)
{
    double sum = 0.0;
    uint32_t num = a->colors.len / 3, num_glances = a->glances.items.len;
    if (!a->is_known || !b->is_known || a->colors.len != b->colors.len || num == 0)
        return -1.0f;
    for (uint32_t i = 0; i < num; i++)
        sum += light_weights[i % NUM_LIGHTS]
               * a->glances.items.items[i / NUM_LIGHTS % num_glances].weight
               * color_difference(a->colors.items + i * 3, b->colors.items + i * 3);
    return (float)(sum * num_glances * NUM_LIGHTS / num); /* the mean of several surfaces */
}

ir_ref slabs_through(struct shader *shader, const struct slabs_host *host, ir_ref top,
                     ir_ref thickness)
{
    struct ir_graph *g = shader->graph;
    struct eye eye = open_eye(shader, host);
    struct closure_probe probe;
    closure_probe(host->closures, eye.view, &probe);
    ir_ref args[3] = {top, ir_const_bool(g, true), thickness};
    ir_ref sheet = ir_build(g, IR_SLAB_SURFACE, IR_TYPE_SURFACE, 0, args, 3);
    struct slabs_host on_matter = *host;
    on_matter.is_on_matter = true;
    ir_ref walked = slabs_walk(shader, &on_matter, sheet),
           mean = ir_const_float(g, CLOSURE_MEAN_WAY);
    return closure_throughput(shader, &probe.host, ir_arg(g, walked, 0), mean);
}

float slabs_brightness(struct shader *shader, const struct slabs_host *host, ir_ref color)
{
    struct eye eye = open_eye(shader, host);
    struct ir_value value;
    eye.view_value = value_of_three(0.0f, 0.0f, 1.0f);
    if (!evaluate(&eye, color, &value))
        return -1.0f;
    return (value.w[0].f + value.w[1].f + value.w[2].f) / 3.0f;
}
