// SPDX-License-Identifier: Apache-2.0
#include "slabs/estimate.h"

#include "ir/arithmetic.h"

#include "lower/lower.h"
#include "slabs/difference.h"
#include "slabs/slab_nodes.h"
#include "slabs/places.h"

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

/* The eye from one side, at one place of the ball. */
struct sight {
    struct slab_eye *eye;
    unsigned at;
    struct ir_value view, lights[NUM_LIGHTS];
    struct ir_eval_env env;        /* of the evaluator */
    struct ir_evaluator evaluator; /* trees share most nodes, so it keeps their values */
};

/* The colours of a tree, in threes: surfaces, of each the glances, of each the lights. */
struct look {
    VEC(float) colors;
    bool is_known; /* false: the evaluator cannot compute a value */
};

struct slab_eye {
    struct shader *shader;
    const struct slabs_host *host;
    ir_ref first;                    /* the tree that others are compared with */
    ir_ref view, lights[NUM_LIGHTS]; /* vec3: stand for directions */
    struct slab_glances glances;     /* that show all that varies in the first tree */
    struct sight *sights;            /* of the glances; NULL: nobody has looked yet */
    struct look whole;               /* of the first tree */
    uint64_t num_steps;              /* of the evaluator */
    uint64_t builds_before;          /* of the graph, when the eye opened */
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
    const struct sight *sight = user_data;
    const float *texels = texels_of(sight->eye->host, ir_get(graph, ir_arg(graph, ref, 0))),
                *texel = fixed_texels[sight->at % NUM_TEXELS];
    *out = (struct ir_value){.type = ir_type_of(graph, ref)};
    if (texels && place && ir_type_is_float(place->type))
        texel = texels + texel_at(place->w) * 4;
    for (unsigned i = 0; i < 4; i++)
        out->w[i].f = texel[i];
    return true;
}

static bool direction(const struct sight *sight, ir_ref ref, struct ir_value *out)
{
    const struct slab_eye *eye = sight->eye;
    if (ref == eye->view) {
        *out = sight->view;
        return true;
    }
    for (unsigned i = 0; i < NUM_LIGHTS; i++)
        if (ref == eye->lights[i]) {
            *out = sight->lights[i];
            return true;
        }
    return false;
}

static bool source(void *user_data, const struct ir_graph *graph, ir_ref ref, struct ir_value *out)
{
    const struct sight *sight = user_data;
    const struct slab_eye *eye = sight->eye;
    const struct ir_node *node = ir_get(graph, ref);
    *out = (struct ir_value){.type = node->type};
    if (direction(sight, ref, out))
        return true;
    switch (node->op) {
    case IR_UNIFORM:
        *out = eye->shader->interface.variables.items[node->attr].value;
        return out->type == node->type;
    case IR_STREAM:
        slabs_place_stream(sight->at, eye->shader->interface.variables.items[node->attr].name, out);
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
    struct slab_eye *eye = ((struct sight *)user_data)->eye;
    uint32_t steps_left = LANG_MAX_STEPS;
    uint32_t num =
        lang_eval_node(eye->shader->unit, graph, ref, args, &steps_left, eye->host->scratch, out);
    eye->num_steps += LANG_MAX_STEPS - steps_left;
    arena_finish(eye->host->scratch);
    return num;
}

/* ---- Light ---- */

/* Adds what one lobe sends to the viewer: of the environment, of each light, and its own. */
static void add_lobe(const struct slab_eye *eye, const struct closure_host *host,
                     const struct closure_leaf *leaf, ir_ref sums[NUM_LIGHTS])
{
    struct shader *shader = eye->shader;
    struct ir_graph *g = shader->graph;
    ir_ref zero = ir_const_float(g, 0.0f), mean = ir_const_float(g, CLOSURE_MEAN_WAY);
    ir_ref even = ir_black(g);
    ir_ref albedo = closure_call(shader, host, leaf->leaf, LEAF_ALBEDO, NULL),
           glow = closure_call(shader, host, leaf->leaf, LEAF_EMISSION, NULL);
    if (albedo) {
        albedo = ir_mul(g, albedo, closure_weight(shader, leaf, mean));
        even = ir_add(g, even, ir_scaled(g, albedo, AMBIENT));
    }
    if (glow)
        glow = ir_mul(g, glow, closure_weight(shader, leaf, zero));
    for (unsigned i = 0; i < NUM_LIGHTS; i++) {
        ir_ref sum = even,
               value = closure_call(shader, host, leaf->leaf, LEAF_EVAL, &eye->lights[i]);
        if (value) {
            ir_ref way = closure_way(shader, host, eye->lights[i]);
            ir_ref lit = ir_mul(g, value, closure_weight(shader, leaf, way));
            sum = ir_add(g, sum, ir_scaled(g, lit, RADIANCE));
        }
        sum = glow ? ir_add(g, sum, glow) : sum;
        sums[i] = ir_add(g, sums[i], ir_convert(g, IR_TYPE_VEC3, sum));
    }
}

/* The colours of a closure by light; where it shows what is behind, before a grey background. */
static void colors_of(const struct slab_eye *eye, ir_ref lobes, bool shows_behind,
                      ir_ref out[NUM_LIGHTS])
{
    struct ir_graph *g = eye->shader->graph;
    struct closure_probe probe;
    struct closure_list list;
    closure_probe(eye->host->closures, eye->view, &probe);
    ir_ref none = ir_const_float(g, 0.0f), behind = ir_black(g);
    if (shows_behind) {
        behind = closure_throughput(eye->shader, &probe.host, lobes, none);
        behind = ir_scaled(g, behind, BACKGROUND);
    }
    for (unsigned i = 0; i < NUM_LIGHTS; i++)
        out[i] = behind;
    closure_flatten(eye->shader, &probe.host, lobes, &list);
    for (uint32_t i = 0; i < list.leaves.len; i++)
        add_lobe(eye, &probe.host, &list.leaves.items[i], out);
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

static void open_sight(struct slab_eye *eye, struct sight *out)
{
    *out = (struct sight){.eye = eye, .view = value_of_three(0.0f, 0.0f, 1.0f)};
    out->env =
        (struct ir_eval_env){.user_data = out, .source = source, .call = call, .texture = texture};
    ir_evaluator_init(&out->evaluator, eye->shader->graph, &out->env, eye->shader->arena);
}

static bool evaluate(struct sight *sight, ir_ref color, struct ir_value *out)
{
    uint64_t before = sight->evaluator.num_steps;
    bool is_known = ir_evaluate(&sight->evaluator, color, out);
    sight->eye->num_steps += sight->evaluator.num_steps - before;
    return is_known;
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
static ir_ref signature_of(const struct slab_eye *eye, ir_ref root)
{
    struct ir_graph *g = eye->shader->graph;
    struct slab_nodes nodes;
    slabs_find_nodes(eye->shader->graph, root, eye->shader->arena, &nodes);
    ir_ref sum = 0, least = ir_const_splat(g, IR_TYPE_VEC3, -1.0f), most = ir_white(g);
    unsigned number = 0;
    for (uint32_t at = 1; at < nodes.items.len; at++) {
        ir_ref ref = nodes.items.items[at];
        uint32_t num_args = ir_get(g, ref)->num_args;
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

/* False: some values are unknown. */
static bool find_glances(struct slab_eye *eye)
{
    const struct shader *shader = eye->shader;
    float values[SLAB_NUM_PLACES * 3];
    ir_ref signature = signature_of(eye, eye->first);
    struct sight sight;
    open_sight(eye, &sight);
    for (sight.at = 0; signature && sight.at < SLAB_NUM_PLACES; sight.at++) {
        struct ir_value value;
        ir_evaluator_forget(&sight.evaluator);
        if (!evaluate(&sight, signature, &value))
            return false;
        for (unsigned c = 0; c < 3; c++)
            values[sight.at * 3 + c] = value.w[c].f;
    }
    slabs_choose_glances(signature ? values : NULL, shader->arena, &eye->glances);
    return true;
}

/* ---- Looks ---- */

/* Stand-ins for its directions; an eye without them adds no nodes to the graph. */
static void name_directions(struct slab_eye *eye)
{
    struct ir_graph *g = eye->shader->graph;
    eye->view = closure_probe_direction(g, 0);
    for (unsigned i = 0; i < NUM_LIGHTS; i++)
        eye->lights[i] = closure_probe_direction(g, 1 + i);
}

static void look_at(struct slab_eye *eye, const ir_ref colors[NUM_LIGHTS], struct look *out)
{
    for (uint32_t i = 0; i < eye->glances.items.len * NUM_LIGHTS && out->is_known; i++) {
        struct ir_value value = {.type = IR_TYPE_VOID};
        out->is_known = evaluate(&eye->sights[i / NUM_LIGHTS], colors[i % NUM_LIGHTS], &value);
        for (unsigned c = 0; c < 3; c++)
            vec_push(eye->shader->arena, &out->colors, value.w[c].f);
    }
}

/* The colours of a surface, or of a closure that is the root; other nodes have none. */
static void look_at_node(struct slab_eye *eye, ir_ref ref, ir_ref root, struct look *out)
{
    struct ir_graph *g = eye->shader->graph;
    uint8_t op = ir_get(g, ref)->op;
    bool is_surface = op == IR_SLAB_SURFACE || op == IR_SURFACE_SHADER,
         is_closure = ref == root && ir_type_of(g, ref) == IR_TYPE_BSDF;
    if ((!is_surface && !is_closure) || (is_surface && !ir_arg(g, ref, 0)))
        return;
    ir_ref walked = slabs_walk(eye->shader, eye->host, ref), colors[NUM_LIGHTS];
    colors_of(eye, is_surface ? ir_arg(g, walked, 0) : walked,
              op != IR_SURFACE_SHADER, /* <surface> has its own opacity */
              colors);
    look_at(eye, colors, out);
}

/* All surfaces below a root. */
static void look(struct slab_eye *eye, ir_ref root, struct look *out)
{
    struct slab_nodes nodes;
    *out = (struct look){.is_known = true};
    slabs_find_nodes(eye->shader->graph, root, eye->shader->arena, &nodes);
    for (uint32_t i = 1; i < nodes.items.len && out->is_known; i++)
        look_at_node(eye, nodes.items.items[i], root, out);
}

struct slab_eye *slabs_open_eye(struct shader *shader, const struct slabs_host *host, ir_ref first)
{
    struct slab_eye *eye = ARENA_NEW(shader->arena, struct slab_eye);
    *eye = (struct slab_eye){
        .shader = shader, .host = host, .first = first, .builds_before = shader->graph->num_builds};
    return eye;
}

static void open_sights(struct slab_eye *eye)
{
    name_directions(eye);
    eye->whole.is_known = find_glances(eye);
    const struct slab_glances *glances = &eye->glances;
    eye->sights = ARENA_ARRAY(eye->shader->arena, struct sight, glances->items.len);
    for (uint32_t i = 0; i < glances->items.len; i++) {
        struct sight *sight = &eye->sights[i];
        const struct slab_glance *glance = &glances->items.items[i];
        open_sight(eye, sight);
        sight->at = glance->at;
        sight->view = view_of(glance->view);
        for (unsigned k = 0; k < NUM_LIGHTS; k++)
            sight->lights[k] = light_for(&sight->view, glance->view, k);
    }
    if (eye->whole.is_known)
        look(eye, eye->first, &eye->whole);
}

/* Adds how much two colours of one glance and light differ to each side of the ball. */
static void add_difference(const struct slab_eye *eye, const float *a, const float *b, uint32_t at,
                           double sides[SLAB_NUM_SIDES])
{
    const struct slab_glances *glances = &eye->glances;
    const struct slab_glance *glance = &glances->items.items[at / NUM_LIGHTS % glances->items.len];
    double difference = light_weights[at % NUM_LIGHTS] * color_difference(a + at * 3, b + at * 3);
    for (unsigned i = 0; i < SLAB_NUM_SIDES; i++)
        sides[i] += difference * glance->weights[i];
}

float slabs_estimate(struct slab_eye *eye, ir_ref root)
{
    if (!eye->sights)
        open_sights(eye);
    const struct look *a = &eye->whole;
    struct look b = {0};
    if (a->is_known)
        look(eye, root, &b);
    double sides[SLAB_NUM_SIDES] = {0}, worst = 0.0;
    uint32_t num = a->colors.len / 3, num_looks = eye->glances.items.len * NUM_LIGHTS;
    if (!a->is_known || !b.is_known || a->colors.len != b.colors.len || num == 0)
        return -1.0f;
    for (uint32_t i = 0; i < num; i++)
        add_difference(eye, a->colors.items, b.colors.items, i, sides);
    for (unsigned i = 0; i < SLAB_NUM_SIDES; i++)
        worst = fmax(worst, sides[i]);
    return (float)(worst * num_looks / num); /* the mean of several surfaces */
}

uint64_t slabs_num_steps(const struct slab_eye *eye)
{
    enum { STEPS_OF_BUILD = 8 }; /* a node takes about so long to build */
    uint64_t num_builds = eye->shader->graph->num_builds - eye->builds_before;
    return eye->num_steps + STEPS_OF_BUILD * num_builds;
}

/* ---- Single values ---- */

ir_ref slabs_through(struct shader *shader, const struct slabs_host *host, ir_ref top,
                     ir_ref thickness)
{
    struct ir_graph *g = shader->graph;
    struct slab_eye eye = {.shader = shader, .host = host};
    struct closure_probe probe;
    name_directions(&eye);
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
    struct slab_eye eye = {.shader = shader, .host = host};
    struct sight sight;
    struct ir_value value;
    name_directions(&eye);
    open_sight(&eye, &sight);
    if (!evaluate(&sight, color, &value))
        return -1.0f;
    return (value.w[0].f + value.w[1].f + value.w[2].f) / 3.0f;
}
