// SPDX-License-Identifier: Apache-2.0
/*
 * The build room: what elements of a document become. Values are computed by the IR's evaluator,
 * with uniforms at their defaults.
 */
#include "build/build_priv.h"

#include "cases.h"
#include "layers_fixture.h"
#include "spell/target.h"

#include <stdlib.h>

static const struct layer_file files[] = {
    {"matte.glsl", "vec3 matte_eval(vec3 color, float shade, vec3 L) { return color * shade; }\n"},
    {"lamp.glsl", "void lamp(float power, vec3 P, out vec3 L, out vec3 light)\n"
                  "{ L = P; light = vec3(power); }\n"},
    {"mode.glsl", "float mode_of(int mode, int level) { return float(mode * 2 + level) + 2.0; }\n"},
    {NULL, NULL},
};

static char standard[8192]; /* the library below the documents, from build.txt */

struct work {
    struct layers layers;
    struct strpool strings;
    struct lang_unit unit;
    struct ir_graph graph;
    struct shader shader;
    struct build_options options;
    str_id targets[2];
    struct builder *builder;
};

static void work_open(struct work *w, const char *document)
{
    memset(w, 0, sizeof *w);
    layers_open(&w->layers, files, standard, document);
    struct arena *arena = &w->layers.arena;
    strpool_init(&w->strings, arena, &w->layers.lib.strings);
    lang_unit_init(&w->unit, arena, &w->strings, &w->layers.lib.unit);
    ir_graph_init(&w->graph, arena, &w->strings);
    shader_init(&w->shader, &roles[ROLE_raster], arena, &w->strings, &w->graph, &w->unit);
    w->options.colorspace = str_intern_z(&w->strings, "lin_rec709");
    w->options.distance_unit = str_intern_z(&w->strings, "meter");
    w->options.targets = w->targets;
}

/* The value of an element; 0 after an error. */
static ir_ref work_build(struct work *w, const char *path)
{
    if (!w->builder)
        w->builder = build_start(&w->layers.lib, &w->options, &w->shader, &w->layers.diags);
    return build_element(w->builder, layers_element(&w->layers, path), 0);
}

static void work_close(struct work *w)
{
    ir_ref at = 0;
    const char *fault = ir_check(&w->graph, &at);
    if (!REQUIRE(!fault))
        printf("    node %u: %s\n", at, fault);
    layers_close(&w->layers);
}

static bool value_of_source(void *user_data, const struct ir_graph *graph, ir_ref ref,
                            struct ir_value *out)
{
    const struct work *w = user_data;
    const struct ir_node *node = ir_get(graph, ref);
    if (node->op != IR_UNIFORM)
        return false;
    *out = w->shader.interface.variables.items[node->attr].value;
    return w->shader.interface.variables.items[node->attr].has_default;
}

/* "6": the value; "poison", "nothing", or "?" where it is not known yet. */
static const char *value_text(struct work *w, ir_ref ref)
{
    struct text text;
    struct ir_value value;
    struct ir_eval_env env = {.user_data = w, .source = value_of_source};
    text_init(&text, &w->layers.arena);
    if (!ref)
        return "nothing";
    if (ir_get(&w->graph, ref)->op == IR_POISON)
        return "poison";
    if (!ir_eval(&w->graph, ref, &env, &w->layers.arena, &value))
        return "?";
    for (unsigned i = 0; i < ir_type_info(value.type)->components; i++)
        text_fmt(&text, "%s%g", i ? " " : "", (double)value.w[i].f);
    return text_cstr(&text);
}

/* "n_in=0.25 n_amount=2": the uniforms that were made, with their defaults. */
static const char *uniforms(struct work *w)
{
    struct text text;
    text_init(&text, &w->layers.arena);
    for (uint32_t i = 0; i < w->shader.interface.variables.len; i++) {
        const struct shader_variable *v = &w->shader.interface.variables.items[i];
        if (v->block == BLOCK_PUBLIC_UNIFORMS)
            text_fmt(&text, "%s%s=%g", text.len ? " " : "", str_text(&w->strings, v->name),
                     (double)v->value.w[0].f);
    }
    return text_cstr(&text);
}

/* "value": that of element n of a document, and on a line of its own what is reported. */
static void run_case(const struct test_case *c)
{
    if (strcmp(c->words, "base") == 0) {
        snprintf(standard, sizeof standard, "%s", c->in);
        return;
    }
    struct work w;
    struct text is;
    work_open(&w, c->in);
    const char *value = value_text(&w, work_build(&w, "n")), *messages = layers_messages(&w.layers);
    text_init(&is, &w.layers.arena);
    text_fmt(&is, "%s\n%s%s", value, messages, *messages ? "\n" : "");
    REQUIRE_STR(text_cstr(&is), c->out);
    work_close(&w);
}

/* ---- The interface ---- */

/* in is authored, amount is not; m is upstream. */
static const char authored[] =
    "<gain name='m' type='float'><input name='in' type='float' value='7'/></gain>"
    "<gain name='n' type='float'><input name='in' type='float' value='0.25'/></gain>"
    "<gain name='o' type='float'><input name='in' type='float' nodename='m'/></gain>"
    "<nodegraph name='g'><input name='k' type='float' value='4'/>"
    "<gain name='a' type='float'><input name='in' type='float' interfacename='k'/></gain>"
    "<output name='out' type='float' nodename='a'/></nodegraph>";

static void test_interface(void)
{
    static const char *const amount[] = {"n/amount"}, *const all[] = {"**"}, *const in[] = {"*/in"};
    static const struct {
        const char *element;
        enum build_interface interface;
        const char *const *uniform, *const *constant;
        const char *expected, *value;
        unsigned compiled; /* inputs that are compiled in */
    } cases[] = {
        {"n", INTERFACE_COMPLETE, NULL, NULL, "n_in=0.25 n_amount=2", "0.5", 0},
        {"n", INTERFACE_AUTHORED, NULL, NULL, "n_in=0.25", "0.5", 1},
        {"n", INTERFACE_REDUCED, NULL, NULL, "", "0.5", 2},
        {"n", INTERFACE_REDUCED, amount, NULL, "n_amount=2", "0.5", 1},
        {"n", INTERFACE_COMPLETE, NULL, in, "n_amount=2", "0.5", 1},
        {"n", INTERFACE_REDUCED, amount, all, "", "0.5", 2},          /* constant wins */
        {"o", INTERFACE_COMPLETE, NULL, NULL, "o_amount=2", "28", 2}, /* m is no part of it */
        {"o", INTERFACE_COMPLETE, all, NULL, "m_in=7 m_amount=2 o_amount=2", "28", 0},
        {"g/out", INTERFACE_COMPLETE, NULL, NULL, "g_k=4", "8", 1},
        {"g/out", INTERFACE_AUTHORED, NULL, NULL, "g_k=4", "8", 1},
        {"g/out", INTERFACE_REDUCED, NULL, NULL, "", "8", 2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct work w;
        work_open(&w, authored);
        w.options.interface = cases[i].interface;
        w.options.uniform_globs = cases[i].uniform;
        w.options.num_uniform_globs = cases[i].uniform != NULL;
        w.options.constant_globs = cases[i].constant;
        w.options.num_constant_globs = cases[i].constant != NULL;
        REQUIRE_STR(value_text(&w, work_build(&w, cases[i].element)), cases[i].value);
        REQUIRE_STR(uniforms(&w), cases[i].expected);
        REQUIRE_EQ(w.shader.reflection.compiled.len, cases[i].compiled);
        work_close(&w);
    }
}

static void test_variables(void)
{
    struct work w;
    work_open(&w, authored);
    w.options.caps = CAP_SCOPED_PARAMETERS;
    work_build(&w, "n");
    REQUIRE_STR(uniforms(&w), "in=0.25 amount=2");
    const struct shader_variable *v = &w.shader.interface.variables.items[0];
    REQUIRE_STR(str_text(&w.strings, v->path), "n/in");
    REQUIRE_STR(str_text(&w.strings, v->doc_type), "float");
    REQUIRE_EQ(v->type, IR_TYPE_FLOAT);
    REQUIRE_EQ(v->update, UPDATE_UNIFORM);
    REQUIRE_EQ(v->element, layers_element(&w.layers, "n/in"));
    REQUIRE_EQ(w.shader.interface.variables.items[1].element, layers_element(&w.layers, "n"));
    work_close(&w);
}

static void test_globs(void)
{
    static const struct {
        const char *glob, *path;
        bool matches;
    } cases[] = {
        {"a/b", "a/b", true},
        {"a/b", "a/bc", false},
        {"a/?", "a/b", true},
        {"a?b", "a/b", false},
        {"*", "a/b", false},
        {"*/*", "a/b", true},
        {"**", "a/b/c", true},
        {"a/**/c", "a/x/y/c", true},
        {"a/*/c", "a/x/y/c", false},
        {"**/c", "a/b/c", true},
        {"*b*", "abc", true},
        {"*a*b", "xxaxxb", true},
        {"*a*b", "xxbxxa", false},
        {"", "", true},
        {"", "a", false},
        {"a*", "a", true},
        {"**x", "a/b", false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        if (!REQUIRE_EQ(build_glob_matches(cases[i].glob, cases[i].path), cases[i].matches))
            printf("    '%s' and '%s'\n", cases[i].glob, cases[i].path);
}

/* ---- Properties ---- */

static void test_properties(void)
{
    struct work w;
    work_open(&w, "<worn name='n' type='float'/>"
                  "<worn name='m' type='float'><input name='in' type='float' value='1'/></worn>");
    ir_ref root = work_build(&w, "n");
    REQUIRE_EQ(ir_get(&w.graph, root)->op, IR_STREAM);
    REQUIRE_STR(layers_messages(&w.layers), "");
    REQUIRE_EQ(work_build(&w, "m"), root); /* the property counts, as for MaterialX */
    REQUIRE_STR(layers_messages(&w.layers), "geomprop-literal");
    work_close(&w);
}

/* ---- Demand ---- */

/* Only what is needed is looked at; the order of the document does not count. */
static void test_need(void)
{
    static const char document[] =
        "<plus name='n' type='float'><input name='a' type='float' nodename='late'/></plus>"
        "<gain name='bad' type='float'><input name='in' type='float' value='x'/></gain>"
        "<nonsense name='odd' type='float'/>"
        "<gain name='c1' type='float'><input name='in' type='float' nodename='c2'/></gain>"
        "<gain name='c2' type='float'><input name='in' type='float' nodename='c1'/></gain>"
        "<gain name='late' type='float'><input name='in' type='float' value='4'/></gain>";
    struct work w;
    work_open(&w, document);
    REQUIRE_STR(value_text(&w, work_build(&w, "c1")), "nothing");
    REQUIRE_STR(layers_messages(&w.layers), "cycle, reads, reads");
    REQUIRE_STR(value_text(&w, work_build(&w, "odd")), "nothing");
    REQUIRE_STR(layers_messages(&w.layers), "unknown-node");
    /* and what is left is as good as before */
    REQUIRE_STR(value_text(&w, work_build(&w, "n")), "9");
    REQUIRE_STR(layers_messages(&w.layers), "");
    work_close(&w);
}

/* A fault is told once; what follows from it is poison and says nothing. */
static void test_poison(void)
{
    static const char document[] =
        "<gain name='bad' type='float'><input name='in' type='float' value='x'/></gain>"
        "<plus name='n' type='float'><input name='a' type='float' nodename='bad'/>"
        "<input name='b' type='float' nodename='bad'/></plus>"
        "<nonsense name='odd' type='float'/>"
        "<plus name='m' type='float'><input name='a' type='float' nodename='odd'/>"
        "<input name='b' type='float' nodename='n'/></plus>"
        "<shade name='k' type='float'><input name='color' type='color3' nodename='n'/></shade>";
    struct work w;
    work_open(&w, document);
    REQUIRE_STR(value_text(&w, work_build(&w, "n")), "poison");
    REQUIRE_STR(layers_messages(&w.layers), "bad-value");
    REQUIRE_STR(value_text(&w, work_build(&w, "m")), "poison");
    REQUIRE_STR(layers_messages(&w.layers), "unknown-node");
    REQUIRE_STR(value_text(&w, work_build(&w, "k")), "poison");
    REQUIRE_STR(layers_messages(&w.layers), "type-mismatch, connected-here");
    work_close(&w);
}

/* A node is built once however many read it: one uniform stands for its input. */
static void test_sharing(void)
{
    struct work w;
    static const char *const all[] = {"**"};
    work_open(&w,
              "<gain name='m' type='float'/>"
              "<plus name='n' type='float'><input name='a' type='float' nodename='m'/>"
              "<input name='b' type='float' nodename='m'/></plus>"
              "<twice name='t' type='float'><input name='x' type='float' nodename='m'/></twice>"
              "<twice name='u' type='float'><input name='x' type='float' nodename='m'/></twice>");
    w.options.uniform_globs = all;
    w.options.num_uniform_globs = 1;
    REQUIRE_STR(value_text(&w, work_build(&w, "n")), "12");
    REQUIRE_STR(uniforms(&w), "m_in=3 m_amount=2");
    /* and a graph once for equal arguments */
    REQUIRE_EQ(work_build(&w, "t"), work_build(&w, "u"));
    work_close(&w);
}

enum { DEPTH = 20000 };

/* p0 reads p1 reads p2 …: each adds 1, and the last gives 6. To be freed. */
static char *make_chain(void)
{
    size_t room = (size_t)DEPTH * 96 + 64, len = 0;
    char *document = malloc(room);
    for (int i = 0; document && i < DEPTH; i++)
        len += (size_t)snprintf(document + len, room - len,
                                "<plus name='p%d' type='float'><input name='a' type='float' "
                                "nodename='p%d'/></plus>",
                                i, i + 1);
    if (document)
        snprintf(document + len, room - len, "<gain name='p%d' type='float'/>", DEPTH);
    return document;
}

/* Nothing recurses on the C stack. */
static void test_depth(void)
{
    struct work w;
    char *document = make_chain();
    work_open(&w, document);
    w.options.interface = INTERFACE_REDUCED;
    REQUIRE_STR(value_text(&w, work_build(&w, "p0")), "20006");
    REQUIRE_STR(layers_messages(&w.layers), "");
    work_close(&w);
    free(document);
}

struct patience {
    unsigned asked, stops_at; /* 0: never */
};

static bool is_over(void *user_data)
{
    struct patience *patience = user_data;
    return ++patience->asked == patience->stops_at;
}

static void test_cancel(void)
{
    struct patience patiences[] = {{0, 2}, {0, 0}};
    char *document = make_chain();
    for (unsigned i = 0; i < 2; i++) {
        struct work w;
        work_open(&w, document);
        w.options.cancel = is_over;
        w.options.cancel_user_data = &patiences[i];
        work_build(&w, "p0");
        REQUIRE_EQ(build_cancelled(w.builder), i == 0);
        work_close(&w);
    }
    REQUIRE_EQ(patiences[0].asked, 2); /* and not again */
    REQUIRE(patiences[1].asked > 2);
    free(document);
}

/* ---- Implementations ---- */

/* The nearest target counts; of equal ones, the document's. */
static void test_targets(void)
{
    static const char plain[] = "<which name='n' type='float'/>",
                      own[] = "<which name='n' type='float'/>"
                              "<implementation name='I' nodedef='ND_which' sourcecode='8.0'/>",
                      own_gen[] = "<which name='n' type='float'/><implementation name='I' "
                                  "nodedef='ND_which' target='gen' sourcecode='9.0'/>",
                      own_graph[] = "<which name='n' type='float'/><nodegraph name='G' "
                                    "nodedef='ND_which' target='gen'><gain name='g' "
                                    "type='float'/><output name='out' type='float' "
                                    "nodename='g'/></nodegraph>",
                      own_list[] = "<which name='n' type='float'/><nodegraph name='G' "
                                   "nodedef='ND_which' target=' gen ,other'><gain name='g' "
                                   "type='float'/><output name='out' type='float' "
                                   "nodename='g'/></nodegraph>",
                      own_source[] = "<which name='n' type='float'/><implementation name='I' "
                                     "nodedef='ND_which' target='other,gen' sourcecode='9.0'/>",
                      only[] = "<only name='n' type='float'/>",
                      ink[] = "<ink name='n' type='float'/>",
                      inked[] = "<inked name='n' type='float'/>",
                      sole[] = "<sole name='n' type='float'/>",
                      named[] = "<sole name='n' type='float' nodedef='ND_sole'/>";
    /* the specification's "Custom Inputs": what one target knows, the others ignore */
    static const char filter[] =
        "<nodedef name='ND_gain_maya' node='gain' target='maya, sub' inherit='ND_gain'>"
        "<input name='filter' type='float' value='1'/></nodedef>"
        "<implementation name='I' nodedef='ND_gain_maya' sourcecode='{{in}} + {{filter}}'/>"
        "<gain name='n' type='float'><input name='filter' type='float' value='0.5'/></gain>";
    static const struct {
        const char *targets[2], *document, *expected, *messages;
        unsigned num_foreign; /* of the targets, the last ones, whose language is another */
    } cases[] = {
        {{NULL}, plain, "1", "", 0},
        {{"gen"}, plain, "2", "", 0},
        {{"sub", "gen"}, plain, "3", "", 0},
        {{"new", "gen"}, plain, "2", "", 0}, /* inherited */
        {{"new"}, plain, "1", "", 0},
        {{NULL}, own, "8", "", 0},
        {{"gen"}, own, "2", "", 0},
        {{"gen"}, own_gen, "9", "", 0},
        {{"sub", "gen"}, own_gen, "3", "", 0},
        {{"gen"}, only, "4", "", 0},
        {{"new"}, only, "nothing", "missing-implementation, accepted-targets, defined-here", 0},
        {{"new", "gen"}, own_gen, "9", "", 0},
        {{"new", "gen"}, own_gen, "1", "", 1},   /* source has a language, */
        {{"new", "gen"}, own_graph, "6", "", 1}, /* a graph has none */
        {{"new"}, own_graph, "1", "", 0},
        {{"gen"}, own_list, "6", "", 0},
        {{"other"}, own_list, "6", "", 0},
        {{"new"}, own_list, "1", "", 0},
        {{"gen"}, own_source, "9", "", 0},
        {{"other"}, own_source, "9", "", 0},
        {{"sub", "gen"}, own_source, "3", "", 0},
        {{NULL}, ink, "8", "", 0}, /* definitions have targets, too */
        {{"gen"}, ink, "4", "", 0},
        {{"old"}, ink, "4", "", 0},
        {{"sub", "gen"}, ink, "6", "", 0},
        {{"new", "gen"}, ink, "4", "", 0},
        {{"new"}, ink, "8", "", 0},
        {{"gen"}, inked, "4", "", 0}, /* in a graph of the library, too */
        {{"new"}, inked, "8", "", 0},
        {{NULL}, sole, "5", "", 0},
        {{"gen"}, sole, "5", "", 0},
        {{"new"}, sole, "nothing", "definition-of-other-target, accepted-targets", 0},
        {{"new"}, named, "5", "", 0}, /* who names one has chosen */
        {{"maya"}, filter, "3.5", "", 0},
        {{"sub", "gen"}, filter, "3.5", "", 0},
        {{"gen"}, filter, "6", "", 0},
        {{NULL}, filter, "6", "", 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct work w;
        work_open(&w, cases[i].document);
        for (unsigned t = 0; t < 2 && cases[i].targets[t]; t++)
            w.targets[w.options.num_targets++] = str_intern_z(&w.strings, cases[i].targets[t]);
        w.options.num_languages = w.options.num_targets - cases[i].num_foreign;
        if (!REQUIRE_STR(value_text(&w, work_build(&w, "n")), cases[i].expected))
            printf("    case %zu\n", i);
        REQUIRE_STR(layers_messages(&w.layers), cases[i].messages);
        work_close(&w);
    }
}

/* Weight first, then the inputs in order. */
static void test_leaves(void)
{
    struct work w;
    work_open(&w, "<matte name='n' type='BSDF'><input name='weight' type='float' value='0.25'/>"
                  "<input name='shade' type='float' value='0.75'/></matte>"
                  "<matte name='m' type='BSDF'><input name='weight' type='float' value='0'/>"
                  "</matte>");
    w.options.interface = INTERFACE_REDUCED;
    ir_ref leaf = work_build(&w, "n");
    if (REQUIRE(leaf && ir_get(&w.graph, leaf)->op == IR_LEAF)) {
        uint32_t callee = ir_get(&w.graph, leaf)->attr;
        REQUIRE_EQ(ir_type_of(&w.graph, leaf), IR_TYPE_BSDF);
        REQUIRE_EQ(ir_get(&w.graph, leaf)->num_args, 3);
        REQUIRE(ir_const_is(&w.graph, ir_arg(&w.graph, leaf, 0), 0.25f));
        REQUIRE(ir_const_is(&w.graph, ir_arg(&w.graph, leaf, 1), 0.75f));
        REQUIRE(ir_const_is(&w.graph, ir_arg(&w.graph, leaf, 2), 0.0f));
        REQUIRE_STR(build_leaf_input(w.builder, callee, 0), "shade");
        REQUIRE_STR(build_leaf_input(w.builder, callee, 1), "color");
        REQUIRE(!build_leaf_input(w.builder, callee, 2));
        REQUIRE_STR(str_text(&w.strings, build_leaf_family(w.builder, callee)->name), "matte");
    }
    REQUIRE_EQ(work_build(&w, "m"), 0); /* of weight 0 */
    REQUIRE_STR(layers_messages(&w.layers), "");
    work_close(&w);
}

/* Lights that a host binds: definitions by their node, with numbers. */
static void test_lights(void)
{
    static const struct {
        const char *items[2];
        unsigned num_lights;
        int32_t type; /* of the last */
        const char *messages;
    } cases[] = {
        {{"lamp"}, 1, 1, ""},
        {{"lamp=7"}, 1, 7, ""},
        {{"none", "lamp"}, 1, 2, ""},
        {{"lamp", "lamp=1"}, 1, 1, "bad-option"},
        {{"lamp=", "lamp=x"}, 0, 0, "bad-option, bad-option"},
        {{"lamp=5000000000"}, 0, 0, "bad-option"},
        {{"torch"}, 0, 0, "unknown-light"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct work w;
        work_open(&w, "<gain name='n' type='float'/>");
        work_build(&w, "n");
        build_lights(w.builder, cases[i].items, cases[i].items[1] ? 2 : 1, true);
        REQUIRE_EQ(w.shader.interface.lights.len, cases[i].num_lights);
        REQUIRE_STR(layers_messages(&w.layers), cases[i].messages);
        if (w.shader.interface.lights.len) {
            const struct shader_light *light = &vec_last(&w.shader.interface.lights);
            const uint32_t *members = w.shader.interface.light_members.items + light->first_member;
            const struct shader_variable *member = &w.shader.interface.variables.items[members[0]];
            REQUIRE_EQ(light->type, cases[i].type);
            REQUIRE(light->function != LANG_NONE && light->num_members == 1);
            REQUIRE_STR(str_text(&w.strings, member->name), "power");
        }
        work_close(&w);
    }
}

/* The argument is the path of build.txt. */
int main(int argc, char **argv)
{
    test_cases(argc > 1 ? argv[1] : NULL, run_case);
    test_interface();
    test_variables();
    test_globs();
    test_properties();
    test_need();
    test_poison();
    test_sharing();
    test_depth();
    test_cancel();
    test_targets();
    test_leaves();
    test_lights();
    return test_report("build");
}
