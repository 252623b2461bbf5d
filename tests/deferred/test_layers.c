// SPDX-License-Identifier: Apache-2.0
/* A stack of layers of slabs by the deferred pipeline, whole and with a budget. */
#include "deferred/pictures.h"
#include "unit/test.h"

enum { NUM_LAYERS = 8 };

/* Eight layers of slabs, each with its colour, roughness and, but for the
 * first, mask. */
static void write_layers(char *text, size_t size)
{
    size_t len =
        (size_t)snprintf(text, size, "<materialx version='1.39'><normal name='n' type='vector3'/>");
    for (int i = 0; i < NUM_LAYERS; ++i)
        len +=
            (size_t)snprintf(text + len, size - len,
                             "<slab name='b%d' type='BSDF'><input name='diffuse_albedo' "
                             "type='color3' "
                             "value='0.%d, 0.%d, 0.%d'/><input name='roughness' type='float' "
                             "value='0.%d'/></slab>"
                             "<slab_surface name='s%d' type='surfaceshader'>"
                             "<input name='bsdf' type='BSDF' nodename='b%d'/></slab_surface>"
                             "<dotproduct name='d%d' type='float'><input name='in1' type='vector3' "
                             "nodename='n'/>"
                             "<input name='in2' type='vector3' value='0.%d, -0.%d, "
                             "0.%d'/></dotproduct>"
                             "<smoothstep name='k%d' type='float'><input name='in' type='float' "
                             "nodename='d%d'/>"
                             "<input name='low' type='float' value='-0.3'/></smoothstep>"
                             "<substance name='m%d' type='material'>"
                             "<input name='surfaceshader' type='surfaceshader' nodename='s%d'/>"
                             "<input name='mask' type='float' %s/></substance>",
                             i, i + 1, 3 * i % 8 + 1, 5 * i % 8 + 1, i + 2, i, i, i, 2 * i % 9,
                             4 * i % 9, 5 * i % 9, i, i, i, i,
                             i ? (const char[]){'n', 'o', 'd', 'e', 'n', 'a', 'm', 'e', '=', '\'',
                                                'k', (char)('0' + i), '\'', 0}
                               : "value='1'");
    len += (size_t)snprintf(text + len, size - len, "<look name='L'>");
    for (int i = 0; i < NUM_LAYERS; ++i)
        len += (size_t)snprintf(text + len, size - len,
                                "<materialassign name='a%d' slot='00%d' material='m%d' geom='/'/>",
                                i, i, i);
    snprintf(text + len, size - len, "</look></materialx>");
}

/* The most closures that a pixel of the middle column stores. */
static uint32_t most_closures(struct drawing *d)
{
    uint32_t words[MAX_WORDS] = {0}, most = 0;
    for (uint32_t y = 0; y < SIZE; y += 4)
        if (REQUIRE(stored_read(d->passes.stored, SIZE / 2, y, words, 3)) && words[0]
            && (words[1] >> 28) + 1 > most)
            most = (words[1] >> 28) + 1;
    return most;
}

/* A picture of the stack, with a budget or 0, and the closures of its pixels. */
static void test_stack(struct bench *b, const char *name, uint32_t budget,
                       const int expected[NUM_STORAGES])
{
    struct drawing d;
    char closures[12];
    snprintf(closures, sizeof closures, "%u", (unsigned)budget);
    mxg_options_set(b->options, "max-slabs", closures);
    picture_test(b, name, expected, ALL_STORAGES);
    if (drawing_open(b, name, "round", UINT32_MAX, &d))
        REQUIRE_EQ(most_closures(&d), budget ? budget : NUM_LAYERS);
    drawing_close(&d);
}

static bool bind_layers(struct bench *b, mxg_scene *scene)
{
    static const char *const path = "/ball";
    static char text[1 << 14];
    write_layers(text, sizeof text);
    return bench_parse(b, "layers.mtlx", text)
           && REQUIRE_EQ(mxg_scene_add_paths(scene, &path, 1), MXG_OK)
           && REQUIRE_EQ(mxg_bindings_create(b->context, b->document, scene, NULL, &b->bindings),
                         MXG_OK)
           && REQUIRE_EQ(mxg_bindings_num_stacks(b->bindings), 1);
}

int main(void)
{
    static const struct {
        uint32_t budget; /* 0: none */
        const char *name;
        int expected[NUM_STORAGES];
    } rows[] = {
#define MATERIAL(document, element, float_db, dither_db, round_db, payload_db)
#define MODEL(element, what, float_db, dither_db, round_db)
#define LAYERS(closures, name, float_db, dither_db, round_db) \
    {closures, name, {float_db, dither_db, round_db}},
#include "deferred/pictures.def"
    };
    struct bench b = {0};
    mxg_scene *scene = NULL;
    if (!bench_open_ball(&b))
        return 77;
    REQUIRE_EQ(mxg_scene_create(b.context, &scene), MXG_OK);
    if (scene && bind_layers(&b, scene))
        for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i)
            test_stack(&b, rows[i].name, rows[i].budget, rows[i].expected);
    mxg_bindings_destroy(b.bindings);
    mxg_scene_destroy(scene);
    bench_close(&b);
    return test_report("deferred-layers");
}
