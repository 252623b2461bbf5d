// SPDX-License-Identifier: Apache-2.0
/*
 * A plug-in with nodes in C. Their definitions are in studio.mtlx.
 *
 *     cc -shared -fPIC studio.c $(pkg-config --cflags mxgen) -o studio.so
 *     mxgen felt.mtlx --plugin ./studio.so
 */
#include <mxgen/mxgen.h>

#include <stdio.h>
#include <stdlib.h>

/* ---- curve: reads its knots, which are text, and builds a sum of ramps ---- */

enum { MAX_KNOTS = 64 };

struct knot {
    float at, value;
};

/* "0:0, 0.5:0.8, 1:1"; 0: the text is no list of ascending knots. */
static int read_knots(const char *text, struct knot *out)
{
    int n = 0;
    for (;;) {
        char *end;
        struct knot knot;
        knot.at = strtof(text, &end);
        if (end == text || *end != ':' || n == MAX_KNOTS || (n && !(knot.at > out[n - 1].at)))
            return 0;
        text = end + 1;
        knot.value = strtof(text, &end);
        if (end == text)
            return 0;
        out[n++] = knot;
        text = end + (*end == ',');
        if (!*end)
            return n;
        if (*end != ',')
            return 0;
    }
}

static bool build_curve(void *user_data, mxg_build *build, mxg_ref *results)
{
    static const char *const names[] = {"sum", "x", "at", "slope", "width"};
    struct knot knots[MAX_KNOTS];
    mxg_value text = MXG_INIT(mxg_value);
    (void)user_data;
    if (!mxg_build_require_constant(build, "knots", &text))
        return false;
    int n = read_knots(text.text, knots);
    if (n == 0) {
        mxg_build_report_error(build, "knots",
                               "expected knots in ascending order, such as '0:0, 1:1'");
        return false;
    }
    mxg_ref x = mxg_build_input(build, "in"),
            sum = mxg_build_number(build, "float", &knots[0].value, 1);
    for (int i = 1; i < n && sum; ++i) {
        float width = knots[i].at - knots[i - 1].at,
              slope = (knots[i].value - knots[i - 1].value) / width;
        mxg_ref args[] = {sum, x, mxg_build_number(build, "float", &knots[i - 1].at, 1),
                          mxg_build_number(build, "float", &slope, 1),
                          mxg_build_number(build, "float", &width, 1)};
        sum = mxg_build_expression(build, "float",
                                   "{{sum}} + {{slope}} * clamp({{x}} - {{at}}, 0.0, {{width}})",
                                   names, args, 5);
    }
    results[0] = sum;
    return true;
}

/* ---- placed_texcoord: has code for two stages ---- */

static bool build_placed_texcoord(void *user_data, mxg_build *build, mxg_ref *results)
{
    static const char *const names[] = {"uv", "scale", "offset"};
    char stream[32];
    mxg_value index = MXG_INIT(mxg_value);
    (void)user_data;
    if (!mxg_build_require_constant(build, "index", &index))
        return false;
    snprintf(stream, sizeof stream, "texcoord_%d", index.integer);
    const mxg_ref args[] = {mxg_build_stream(build, stream, "vec2"),
                            mxg_build_input(build, "scale"), mxg_build_input(build, "offset")};
    mxg_ref placed =
        mxg_build_expression(build, "vec2", "{{uv}} * {{scale}} + {{offset}}", names, args, 3);
    results[0] = mxg_build_interpolation(build, "placed_texcoord", placed);
    return true;
}

/* ---- fuzz_bsdf: a closure of other nodes ---- */

static bool build_fuzz(void *user_data, mxg_build *build, mxg_ref *results)
{
    static const char *const sheen[] = {"weight", "color", "roughness"};
    static const char *const diffuse[] = {"color", "roughness"};
    const float half = 0.5f, rough = 0.8f;
    mxg_ref layers[2];
    const mxg_ref fibres[] = {mxg_build_input(build, "fuzz"), mxg_build_input(build, "fuzz_color"),
                              mxg_build_number(build, "float", &half, 1)};
    const mxg_ref base[] = {mxg_build_input(build, "color"),
                            mxg_build_number(build, "float", &rough, 1)};
    (void)user_data;
    if (!mxg_build_node(build, "ND_sheen_bsdf", sheen, fibres, 3, &layers[0], 1)
        || !mxg_build_node(build, "ND_oren_nayar_diffuse_bsdf", diffuse, base, 2, &layers[1], 1))
        return false;
    results[0] = mxg_build_op(build, "layer", NULL, layers, 2);
    return true;
}

/* ---- weathered: reads what the host sets once for all shaders of a frame ---- */

static bool build_weathered(void *user_data, mxg_build *build, mxg_ref *results)
{
    static const char *const names[] = {"in", "dust", "amount"};
    const mxg_build_uniform frame = {.size = sizeof frame,
                                     .name = "u_studioDust",
                                     .type = "float",
                                     .semantic = "studio:dust",
                                     .block = "StudioFrame"};
    (void)user_data;
    const mxg_ref args[] = {mxg_build_input(build, "in"), mxg_build_input(build, "dust"),
                            mxg_build_add_uniform(build, &frame)};
    results[0] =
        mxg_build_expression(build, "vec3", "mix({{in}}, {{dust}}, {{amount}})", names, args, 3);
    return true;
}

/* ---- The plug-in ---- */

static const mxg_node_code curve = {sizeof curve, "ND_curve_float", NULL, 1, build_curve, NULL,
                                    NULL};
static const mxg_node_code placed_texcoord = {
    sizeof placed_texcoord, "placed_texcoord", NULL, 1, build_placed_texcoord, NULL, NULL};
static const mxg_node_code weathered = {
    sizeof weathered, "ND_weathered_color3", NULL, 1, build_weathered, NULL, NULL};
static const mxg_node_code fuzz = {sizeof fuzz, "ND_fuzz_bsdf", NULL, 1, build_fuzz, NULL, NULL};

/* Not code: a cheaper definition for one target. */
static const mxg_node_code cheap = {.size = sizeof cheap,
                                    .name = "ND_unifiednoise3d_float",
                                    .target = "essl",
                                    .version = 1,
                                    .instead = "ND_noise3d_float"};

/* A target: GLSL 3.30 with uniforms in blocks, in files with the endings of the studio. */
static const char *const studiogl_options[] = {"uniform-blocks", "true"};
static const mxg_dialect studiogl = {.size = sizeof studiogl,
                                     .name = "studiogl",
                                     .base = "glsl",
                                     .version = "330",
                                     .options = studiogl_options,
                                     .num_options = 1,
                                     .stage_suffix = {"vs.glsl", "fs.glsl"}};

MXG_API const mxg_plugin *mxgen_plugin(void);
const mxg_plugin *mxgen_plugin(void)
{
    static const mxg_node_code *const nodes[] = {&curve, &placed_texcoord, &fuzz, &weathered,
                                                 &cheap};
    static const char *const libraries[] = {"studio.mtlx"};
    static const mxg_dialect *const dialects[] = {&studiogl};
    static const mxg_plugin plugin = {.version = MXG_PLUGIN_VERSION,
                                      .name = "studio",
                                      .nodes = nodes,
                                      .num_nodes = 5,
                                      .libraries = libraries,
                                      .num_libraries = 1,
                                      .dialects = dialects,
                                      .num_dialects = 1};
    return &plugin;
}
