// SPDX-License-Identifier: Apache-2.0
/* The library room: definitions, what nodes match, what ports are connected to, the image. */
#include "cases.h"
#include "layers_fixture.h"
#include "specialise/specialise.h"
#include "tree/interpret.h"

#include <math.h>
#include <stdlib.h>

static const struct layer_file files[] = {
    {"wave.glsl", "float wave(float x, float speed) { return x * speed; }\n"
                  "void split(vec3 v, out float low, out float high) { low = v.x; high = v.z; }\n"},
    {"matte.glsl", "vec3 matte_eval(vec3 color, vec3 L) { return color * L.z; }\n"
                   "vec3 matte_albedo(vec3 color) { return color; }\n"},
    {"old.c", "void old(float x, float by, int mode, out float y) { goto end; end: y = x; }\n"},
    {"typed.c",
     "void typed(float x, float by, float mode, out float y) { goto end; end: y = x; }\n"},
    {NULL, NULL},
};

#define NODEDEF(name, node, attributes, ports) \
    "<nodedef name='" name "' node='" node "' " attributes ">" ports "</nodedef>"
#define INPUT(name, type, more) "<input name='" name "' type='" type "' " more "/>"
#define OUTPUT(name, type) "<output name='" name "' type='" type "'/>"
#define IMPL(name, nodedef, more) "<implementation name='" name "' nodedef='" nodedef "' " more "/>"

static char standard[8192]; /* the library below the documents, from library.txt */

static uint32_t def(struct layers *l, const char *name)
{
    return library_nodedef_by_name(&l->lib, layers_word(l, name));
}

/* ---- Definitions ---- */

/* "in amount | out": the inputs and outputs of a definition with their default values. */
static const char *ports_of(struct layers *l, const char *name)
{
    struct text text;
    text_init(&text, &l->arena);
    uint32_t id = def(l, name);
    if (!REQUIRE(id != LIBRARY_NONE))
        return "";
    const struct nodedef *nodedef = library_nodedef(&l->lib, id);
    const struct port *ports = library_ports(&l->lib, id, NULL);
    unsigned count = nodedef->num_inputs + nodedef->num_outputs;
    for (unsigned i = 0; i < count; i++) {
        text_fmt(&text, "%s%s %s",
                 i == 0                     ? ""
                 : i == nodedef->num_inputs ? " | "
                                            : ", ",
                 str_text(&l->lib.strings, library_type_name(&l->lib, ports[i].type)),
                 str_text(&l->lib.strings, ports[i].name));
        if (ports[i].flags & PORT_HAS_VALUE)
            text_fmt(&text, " %s", str_text(&l->lib.strings, ports[i].value));
    }
    return text_cstr(&text);
}

static void test_lookup(void)
{
    struct layers l;
    layers_open(&l, files, standard,
                NODEDEF("ND_own", "own", "", OUTPUT("out", "float"))
                    NODEDEF("ND_gain_vector2", "gain", "", OUTPUT("out", "vector2")));
    REQUIRE_STR(layers_messages(&l), "");
    REQUIRE_EQ(library_num_nodedefs(&l.base), 10);
    REQUIRE_EQ(library_num_nodedefs(&l.lib), 12);
    REQUIRE_EQ(def(&l, "ND_gain_float"), 0);
    REQUIRE_EQ(def(&l, "ND_own"), 10); /* ids count through the layers */
    REQUIRE_EQ(def(&l, "ND_none"), LIBRARY_NONE);
    REQUIRE_EQ(def(&l, "NG_tone_2"), LIBRARY_NONE); /* an element of another kind */
    REQUIRE_STR(layers_text(&l, library_nodedef(&l.lib, 1)->name), "ND_gain_color3");
    REQUIRE_STR(ports_of(&l, "ND_gain_float"),
                "float in 0.5, float amount 1, string mode linear | float out");
    uint32_t gain = def(&l, "ND_gain_float");
    REQUIRE_EQ(library_find_input(&l.lib, gain, layers_word(&l, "amount")), 1);
    REQUIRE_EQ(library_find_input(&l.lib, gain, layers_word(&l, "out")), -1);
    REQUIRE_EQ(library_find_output(&l.lib, gain, layers_word(&l, "out")), 0);
    REQUIRE_EQ(library_find_output(&l.lib, gain, layers_word(&l, "in")), -1);
    const struct port *mode = library_ports(&l.lib, gain, NULL) + 2;
    REQUIRE_EQ(mode->flags, PORT_UNIFORM | PORT_HAS_VALUE | PORT_ENUM);
    const struct library *layer = NULL;
    const struct port *normal = library_ports(&l.lib, def(&l, "ND_split_color3"), &layer);
    REQUIRE_STR(layers_text(&l, normal->geomprop), "Nworld");
    REQUIRE(layer == &l.base);
    /* definitions of a node: of one layer each, in the order of the document */
    uint32_t own = library_first_of_node(&l.base, layers_word(&l, "gain"));
    REQUIRE_EQ(own, 0);
    REQUIRE_EQ(l.base.nodedefs.items[own].next_same_node, 1);
    REQUIRE_EQ(l.base.nodedefs.items[1].next_same_node, LIBRARY_NONE);
    REQUIRE_EQ(library_first_of_node(&l.lib, layers_word(&l, "gain")), 1);
    REQUIRE_EQ(library_first_of_node(&l.lib, layers_word(&l, "tone")), LIBRARY_NONE);
    layers_close(&l);
}

static void test_types(void)
{
    struct layers l;
    layers_open(&l, files, standard, "<typedef name='mine'/>");
    doc_type span = library_type(&l.lib, layers_word(&l, "span"));
    REQUIRE_EQ(library_type(&l.lib, layers_word(&l, "color3")), DOC_TYPE_color3);
    REQUIRE_EQ(library_type(&l.lib, layers_word(&l, "colour")), DOC_TYPE_NONE);
    REQUIRE_EQ(span, DOC_TYPE_FIRST_USER);
    REQUIRE_EQ(library_type(&l.lib, layers_word(&l, "handle")), DOC_TYPE_FIRST_USER + 1);
    REQUIRE_EQ(library_type(&l.lib, layers_word(&l, "mine")), DOC_TYPE_FIRST_USER + 2);
    REQUIRE_STR(layers_text(&l, library_type_name(&l.lib, span)), "span");
    REQUIRE_EQ(library_type_ir(&l.lib, span), IR_TYPE_FIRST_USER); /* a struct */
    REQUIRE_EQ(library_type_ir(&l.lib, DOC_TYPE_FIRST_USER + 1), IR_TYPE_VOID);
    REQUIRE_EQ(library_type_ir(&l.lib, DOC_TYPE_color3), IR_TYPE_VEC3);
    const struct ir_user_type *type = &l.base.unit.user_types.items[0];
    REQUIRE_EQ(type->num_members, 2);
    REQUIRE_EQ(l.base.unit.members.items[type->first_member + 1].type, IR_TYPE_VEC3);
    layers_close(&l);
}

static void test_inheritance(void)
{
    struct layers l;
    layers_open(&l, files, standard,
                NODEDEF("ND_tone_4", "tone", "version='4.0' inherit='ND_tone_3'",
                        INPUT("own", "float", "value='1'"))
                    NODEDEF("ND_lost", "lost", "inherit='ND_nothing'", OUTPUT("out", "float"))
                        NODEDEF("ND_a", "a", "inherit='ND_b'", OUTPUT("out", "float"))
                            NODEDEF("ND_b", "b", "inherit='ND_a'", ""));
    REQUIRE_STR(layers_messages(&l), "inherit-missing, inherit-cycle");
    REQUIRE_STR(ports_of(&l, "ND_tone_1"), "float in 1 | float out");
    REQUIRE_STR(ports_of(&l, "ND_tone_2"), "float curve 3, float in 1 | float out");
    /* its own ports first, and what it declares again counts once */
    REQUIRE_STR(ports_of(&l, "ND_tone_3"), "float in 7, integer last 5, float curve 3 | float out");
    REQUIRE_STR(ports_of(&l, "ND_tone_4"),
                "float own 1, float in 7, integer last 5, float curve 3 | float out");
    layers_close(&l);
}

/* "expression, verbatim genold": the implementations of a definition in its layer. */
static const char *implementations(struct layers *l, const char *name)
{
    static const char *const kinds[] = {"expression", "function", "family",  "graph",
                                        "dynamic",    "verbatim", "foreign", "broken"};
    struct text text;
    text_init(&text, &l->arena);
    for (uint32_t i = library_nodedef(&l->lib, def(l, name))->first_impl; i != LIBRARY_NONE;) {
        const struct implementation *impl = library_impl(&l->lib, i, NULL);
        text_fmt(&text, "%s%s", text.len ? ", " : "", kinds[impl->kind]);
        if (impl->target)
            text_fmt(&text, " %s", layers_text(l, impl->target));
        i = impl->next;
    }
    return text_cstr(&text);
}

static void test_implementations(void)
{
    struct layers l;
    layers_open(&l, files, standard,
                IMPL("IM_own", "ND_gain_float", "sourcecode='{{in}}'")
                    IMPL("IM_lost", "ND_lost", "sourcecode='1.0'")
                        NODEDEF("ND_here", "here", "", OUTPUT("out", "float"))
                            IMPL("IM_here", "ND_here", "sourcecode='2.0'"));
    /* faults of an implementation are told when it is used; an unknown definition at once */
    REQUIRE_STR(layers_messages(&l), "implementation-unknown-nodedef");
    REQUIRE_STR(implementations(&l, "ND_gain_float"), "expression, verbatim genold");
    REQUIRE_STR(implementations(&l, "ND_texcoord_vector2"), "dynamic");
    REQUIRE_STR(implementations(&l, "ND_split_color3"), "function");
    REQUIRE_STR(implementations(&l, "ND_tone_1"), "broken");
    REQUIRE_STR(implementations(&l, "ND_tone_2"), "graph");
    REQUIRE_STR(implementations(&l, "ND_matte"), "family");
    REQUIRE_STR(implementations(&l, "ND_here"), "expression");
    REQUIRE_STR(implementations(&l, "ND_gain_color3"), "");
    REQUIRE_EQ(l.base.deferred->items.len, 1);
    REQUIRE_STR(diag_id_text(l.base.deferred->items.items[0].id), "lang-expected");
    /* the document's implementation of a definition below */
    REQUIRE_EQ(l.lib.overrides.num, 1);
    for (uint32_t i = 0; i < l.lib.impls.len; i++) {
        const struct implementation *impl = &l.lib.impls.items[i];
        bool is_own = strcmp(layers_text(&l, impl->name), "IM_own") == 0;
        REQUIRE_EQ(library_first_override(&l.lib, impl->nodedef),
                   is_own ? l.lib.base_impls + i : LIBRARY_NONE);
        REQUIRE(!is_own || impl->next == LIBRARY_NONE);
    }
    const struct family *family = library_family(&l.lib, 0);
    REQUIRE_STR(layers_text(&l, family->name), "matte");
    REQUIRE(family->functions[FAMILY_EVAL] != LANG_NONE);
    REQUIRE(family->functions[FAMILY_ALBEDO] != LANG_NONE);
    REQUIRE_EQ(family->functions[FAMILY_THROUGHPUT], LANG_NONE);
    const struct verbatim *verbatim = library_verbatim(&l.lib, 0, NULL);
    REQUIRE_STR(layers_text(&l, verbatim->function), "old");
    REQUIRE_STR(layers_text(&l, library_source(&l.lib, verbatim->file, NULL)->text), files[2].text);
    layers_close(&l);
}

/* Source takes the type of the values that it has for words. */
static void test_source_types(void)
{
#define TYPED "target='gentyped' file='typed.c' function='typed'"
    struct layers l;
    layers_open(&l, files, standard,
                "<implementation name='IM_typed' nodedef='ND_gain_float' " TYPED ">"
                "<input name='mode' type='string' enumvalues='1.5, 2.5' impltype='float'/>"
                "</implementation>");
    REQUIRE_EQ(l.lib.impls.len, 1);
    REQUIRE_EQ(l.lib.impls.items[0].kind, IMPL_VERBATIM);
    layers_close(&l);
    layers_open(&l, files, standard, IMPL("IM_typed", "ND_gain_float", TYPED));
    REQUIRE_EQ(l.lib.impls.items[0].kind, IMPL_BROKEN);
    layers_close(&l);
#undef TYPED
}

static void test_trust(void)
{
    static const struct {
        enum library_trust trust;
        const char *portable, *of_target;
    } cases[] = {{LIBRARY_TRUST_ALL, "expression", "verbatim genold"},
                 {LIBRARY_TRUST_PORTABLE, "expression", "broken genold"},
                 {LIBRARY_TRUST_GRAPHS, "broken", "broken genold"}};
    static const char document[] = NODEDEF("ND_a", "a", "", OUTPUT("out", "float"))
        IMPL("IM_a", "ND_a", "sourcecode='1.0'") NODEDEF("ND_b", "b", "", OUTPUT("out", "float"))
            IMPL("IM_b", "ND_b", "target='genold' sourcecode='goto'");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct layers l;
        layers_begin(&l, files);
        library_init(&l.base, &l.arena, NULL);
        layers_read(&l, &l.base, "base.mtlx", standard);
        library_init(&l.lib, &l.arena, &l.base);
        l.lib.trust = cases[i].trust;
        layers_read(&l, &l.lib, "document.mtlx", document);
        REQUIRE_STR(implementations(&l, "ND_a"), cases[i].portable);
        REQUIRE_STR(implementations(&l, "ND_b"), cases[i].of_target);
        layers_close(&l);
    }
}

/* ---- What nodes match ---- */

/* "match": the definition that the node n matches, and on lines of their own what is reported. */
static void run_case(const struct test_case *c)
{
    if (strcmp(c->words, "base") == 0) {
        snprintf(standard, sizeof standard, "%s", c->in);
        return;
    }
    struct layers l;
    struct text found;
    layers_open(&l, files, standard, c->in);
    uint32_t id = library_match(&l.lib, layers_element(&l, "n"), &l.diags);
    const char *messages = layers_messages(&l);
    text_init(&found, &l.arena);
    text_fmt(&found, "%s\n%s%s",
             id == LIBRARY_NONE ? "-" : layers_text(&l, library_nodedef(&l.lib, id)->name),
             messages, *messages ? "\n" : "");
    REQUIRE_STR(text_cstr(&found), c->out);
    layers_close(&l);
}

/* ---- What ports are connected to ---- */

/* "value 0.5", "node n2/1": what an input or output gets its value from. */
static const char *describe_binding(struct layers *l, const struct binding *b)
{
    struct text text;
    text_init(&text, &l->arena);
    switch (b->kind) {
    case BIND_DEFAULT: text_str(&text, "default"); break;
    case BIND_VALUE:
        text_fmt(&text, "value %s",
                 layers_text(l, doc_attr_value(&l->lib.doc, b->element, STR_value)));
        break;
    case BIND_NODE:
        text_fmt(&text, "node %s/%u", layers_text(l, doc_element(&l->lib.doc, b->ref)->name),
                 (unsigned)b->output);
        break;
    case BIND_INTERFACE:
        text_fmt(&text, "interface %s/%u", layers_text(l, b->ref), (unsigned)b->input);
        break;
    default: text_str(&text, "error"); break;
    }
    return text_cstr(&text);
}

static void require_binding(const char *document, const char *path, doc_type type,
                            const char *expected, const char *messages, const char *file, int line)
{
    struct layers l;
    layers_open(&l, files, standard, document);
    struct resolve_out out = {.arena = l.diags.arena};
    struct binding b = library_resolve_port(&l.lib, layers_element(&l, path), type, &out, &l.diags);
    test_same_text(describe_binding(&l, &b), expected, file, line, document);
    test_same_text(layers_messages(&l), messages, file, line, document);
    layers_close(&l);
}
#define REQUIRE_BINDING(document, path, type, expected, messages) \
    require_binding(document, path, DOC_TYPE_##type, expected, messages, __FILE__, __LINE__)

static void test_connections(void)
{
    static const char graph[] =
        "<nodegraph name='g'><input name='k' type='float' value='0.75'/>"
        "<split name='s' type='multioutput'/>"
        "<gain name='a' type='float'><input name='in' type='float' interfacename='k'/></gain>"
        "<gain name='b' type='float'><input name='in' type='float' nodename='s' output='high'/>"
        "</gain><output name='one' type='float' nodename='b'/>"
        "<output name='two' type='color3' nodename='c'/></nodegraph>"
        "<gain name='n' type='float'><input name='in' type='float' nodegraph='g' output='one'/>"
        "</gain><gain name='m' type='float'><input name='in' type='float' value='0.25'/></gain>"
        "<gain name='o' type='float'><input name='in' type='float'/></gain>"
        "<gain name='p' type='float'><input name='in' type='float' nodegraph='g'/></gain>"
        "<gain name='q' type='color3'><input name='in' type='color3' nodename='m'/></gain>"
        "<gain name='r' type='float'><input name='in' type='float' nodename='nn'/></gain>"
        "<gain name='t' type='float'><input name='in' type='float' nodename='b'/></gain>"
        "<gain name='u' type='float'><input name='in' type='float' nodegraph='g' output='three'/>"
        "</gain><gain name='v' type='float'><input name='in' type='float' nodename='s2'/></gain>"
        "<split name='s2' type='multioutput'/>";
    REQUIRE_BINDING(graph, "m/in", float, "value 0.25", "");
    REQUIRE_BINDING(graph, "o/in", float, "default", "");
    REQUIRE_BINDING(graph, "g/b/in", float, "node s/1", "");
    REQUIRE_BINDING(graph, "n/in", float, "node b/0", "");     /* through an output */
    REQUIRE_BINDING(graph, "g/a/in", float, "value 0.75", ""); /* through an interface input */
    REQUIRE_BINDING(graph, "p/in", float, "node b/0", "output-needed");
    REQUIRE_BINDING(graph, "v/in", float, "node s2/0", "output-needed");
    REQUIRE_BINDING(graph, "q/in", color3, "error", "type-mismatch, connected-here");
    REQUIRE_BINDING(graph, "r/in", float, "error", "dangling-nodename");
    REQUIRE_BINDING(graph, "t/in", float, "error", "dangling-nodename, in-other-graph");
    REQUIRE_BINDING(graph, "u/in", float, "error", "dangling-output");
    REQUIRE_BINDING(graph, "g/two", color3, "error", "dangling-nodename");
}

static void test_interfaces(void)
{
    static const char document[] =
        NODEDEF("ND_double", "double", "",
                INPUT("x", "float", "") INPUT("y", "float", "value='1'") OUTPUT(
                    "out", "float")) "<nodegraph name='NG' nodedef='ND_double'>"
                                     "<gain name='a' type='float'><input name='in' type='float' "
                                     "interfacename='y'/></gain>"
                                     "<output name='out' type='float' nodename='a'/></nodegraph>";
    struct layers l;
    layers_open(&l, files, standard, document);
    elem_id in = layers_element(&l, "NG/a/in"), graph = layers_element(&l, "NG");
    struct resolve_out out = {.arena = l.diags.arena};
    struct binding b = library_resolve_port(&l.lib, in, DOC_TYPE_float, &out, &l.diags);
    REQUIRE_STR(describe_binding(&l, &b), "interface y/0");
    REQUIRE_EQ(library_graph_around(&l.lib, in), graph);
    uint32_t nodedef = library_implemented_nodedef(&l.lib, graph);
    REQUIRE_EQ(nodedef, def(&l, "ND_double"));
    const struct port *port = library_ports(&l.lib, def(&l, "ND_gain_float"), NULL);
    REQUIRE_EQ(library_resolve_interface(&l.lib, in, nodedef, &b, port, &l.diags), 1);
    REQUIRE_STR(layers_messages(&l), "");
    struct binding wrong = b;
    wrong.ref = layers_word(&l, "z");
    REQUIRE_EQ(library_resolve_interface(&l.lib, in, nodedef, &wrong, port, &l.diags), -1);
    REQUIRE_STR(layers_messages(&l), "dangling-interfacename, graph-inputs");
    struct port color = *port;
    color.type = DOC_TYPE_color3;
    REQUIRE_EQ(library_resolve_interface(&l.lib, in, nodedef, &b, &color, &l.diags), -1);
    REQUIRE_STR(layers_messages(&l), "type-mismatch, connected-here");
    layers_close(&l);
}

/* Connections that lead back to where they began: an error, in time. */
static void test_cycles(void)
{
    static const char document[] =
        "<nodegraph name='g'><input name='k' type='float' nodegraph='g' output='out'/>"
        "<output name='out' type='float' interfacename='k'/></nodegraph>"
        "<gain name='n' type='float'><input name='in' type='float' nodegraph='g'/></gain>";
    REQUIRE_BINDING(document, "n/in", float, "error", "cycle");
}

/* Nodes of the library's own graphs are resolved ahead, with interface inputs by number. */
static void test_resolved_graphs(void)
{
    struct layers l;
    layers_open(&l, files, standard, "");
    REQUIRE_EQ(l.base.graph_nodes.len, 2);
    const struct graph_node *first = &l.base.graph_nodes.items[0], *second = first + 1;
    const struct binding *b = l.base.bindings.items;
    REQUIRE_EQ(first->nodedef, def(&l, "ND_gain_float"));
    REQUIRE_EQ(library_element_info(&l.lib, second->element, NULL), 1);
    REQUIRE_STR(describe_binding(&l, &b[first->first_binding]), "interface in/1");
    REQUIRE_STR(describe_binding(&l, &b[first->first_binding + 1]), "value 4");
    REQUIRE_STR(describe_binding(&l, &b[first->first_binding + 2]), "default");
    REQUIRE_STR(describe_binding(&l, &b[second->first_binding]), "node first/0");
    REQUIRE_STR(describe_binding(&l, &b[second->first_binding + 1]), "interface curve/0");
    layers_close(&l);
}

/* ---- Units, colour spaces, geometric properties, words ---- */

static void test_units(void)
{
    struct layers l;
    layers_open(&l, files, standard,
                "<unitdef name='UD' unittype='distance'><unit name='league' scale='4000'/>"
                "</unitdef>");
    str_id distance = layers_word(&l, "distance"), angle = layers_word(&l, "angle"),
           shoe = layers_word(&l, "shoe"), foot = layers_word(&l, "foot"),
           league = layers_word(&l, "league");
    float scale = 0;
    REQUIRE(library_unit_scale(&l.lib, distance, foot, &scale) && scale == 0.25f);
    REQUIRE(library_unit_scale(&l.lib, shoe, foot, &scale) && scale == 3.0f);
    REQUIRE(library_unit_scale(&l.lib, distance, league, &scale) && scale == 4000.0f);
    REQUIRE(!library_unit_scale(&l.lib, angle, foot, &scale));
    REQUIRE(!library_unit_scale(&l.base, distance, league, &scale)); /* of the layer above */
    REQUIRE(library_unit_scale(&l.lib, 0, layers_word(&l, "degree"), &scale) && scale == 1.0f);
    REQUIRE(library_has_unit_type(&l.lib, shoe));
    REQUIRE(!library_has_unit_type(&l.lib, foot));
    REQUIRE_EQ(library_unit_type_of(&l.lib, league), distance);
    REQUIRE_EQ(library_unit_type_of(&l.lib, angle), 0);
    library_report_unit(&l.lib, distance, angle, (struct diag_place){0}, &l.diags);
    REQUIRE_STR(layers_messages(&l), "unknown-unit");
    layers_close(&l);
}

static void test_spaces(void)
{
    struct layers l;
    layers_open(&l, files, standard, "");
    REQUIRE_STR(library_canonical_space("ACEScg"), "acescg");
    REQUIRE_STR(library_canonical_space("srgb_texture"), "srgb_texture");
    REQUIRE_STR(library_canonical_space("of my own"), "of my own");
    REQUIRE_EQ(library_color_transform(&l.lib, "acescg", library_color_hub, "color3"),
               def(&l, "ND_acescg_to_lin_rec709_color3"));
    REQUIRE_EQ(library_color_transform(&l.lib, "acescg", library_color_hub, "color4"),
               LIBRARY_NONE);
    REQUIRE_EQ(library_color_transform(&l.lib, "lin_rec709", "acescg", "color3"), LIBRARY_NONE);
    layers_close(&l);
}

static void test_geomprops(void)
{
    struct layers l;
    layers_open(&l, files, standard, "<geompropdef name='own' type='color3'/>");
    const struct geomprop *uv = library_geomprop(&l.lib, layers_word(&l, "UV1"));
    REQUIRE(uv && uv->index == 1 && uv->type == DOC_TYPE_vector2);
    REQUIRE_EQ(uv->nodedef, def(&l, "ND_texcoord_vector2"));
    const struct geomprop *normal = library_geomprop(&l.lib, layers_word(&l, "Nworld"));
    REQUIRE_STR(layers_text(&l, normal->space), "world");
    REQUIRE_EQ(normal->nodedef, LIBRARY_NONE); /* this library has no node that gives it */
    REQUIRE_EQ(library_geomprop(&l.lib, layers_word(&l, "wear"))->geomprop, 0);
    REQUIRE_EQ(library_geomprop(&l.lib, layers_word(&l, "own"))->type, DOC_TYPE_color3);
    REQUIRE(!library_geomprop(&l.base, layers_word(&l, "own")));
    REQUIRE(!library_geomprop(&l.lib, layers_word(&l, "ND_gain_float")));
    layers_close(&l);
}

static void test_enums(void)
{
    static const struct {
        const char *word;
        bool good;
    } cases[] = {{"linear", true},
                 {"cubic", true},
                 {"cub", false},
                 {"linear, cubic", false},
                 {" cubic", false}};
    struct layers l;
    layers_open(&l, files, standard, "");
    const struct port *ports = library_ports(&l.lib, def(&l, "ND_gain_float"), NULL);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        library_check_enum(&l.lib, &ports[2], layers_word(&l, cases[i].word),
                           (struct diag_place){0}, &l.diags);
        REQUIRE_STR(layers_messages(&l), cases[i].good ? "" : "bad-enum-value");
    }
    library_check_enum(&l.lib, &ports[2], 0, (struct diag_place){0}, &l.diags); /* not set */
    library_check_enum(&l.lib, &ports[0], layers_word(&l, "x"), (struct diag_place){0}, &l.diags);
    REQUIRE_STR(layers_messages(&l), "");
    layers_close(&l);
}

/* ---- The image ---- */

struct image {
    char *data; /* aligned for any object, as a mapped file is */
    size_t size;
};

static struct image pack(struct layers *l)
{
    struct text text;
    text_init(&text, &l->arena);
    lang_make_canonical(&l->base.unit);
    library_write_image(&l->base, NULL, &text);
    struct image image = {malloc(text.len), text.len};
    memcpy(image.data, text.data, text.len);
    return image;
}

/* Everything that can be asked of the library below a document. */
static const char *everything(struct layers *l)
{
    struct text text;
    text_init(&text, &l->arena);
    doc_write(&l->base.doc, l->base.doc.root, &text);
    for (uint32_t i = 0; i < l->base.nodedefs.len; i++) {
        const char *name = layers_text(l, l->base.nodedefs.items[i].name);
        text_fmt(&text, "%s: %s: %s\n", name, ports_of(l, name), implementations(l, name));
    }
    for (uint32_t i = 0; i < l->base.bindings.len; i++)
        text_fmt(&text, "%s\n", describe_binding(l, &l->base.bindings.items[i]));
    for (uint32_t i = 0; i < l->base.units.len; i++)
        text_fmt(&text, "%s %s %g\n", layers_text(l, l->base.units.items[i].name),
                 layers_text(l, l->base.units.items[i].type), (double)l->base.units.items[i].scale);
    for (uint32_t i = 0; i < l->base.geomprops.len; i++)
        text_fmt(&text, "%s %u\n", layers_text(l, l->base.geomprops.items[i].name),
                 l->base.geomprops.items[i].nodedef);
    for (uint32_t i = 0; i < l->base.families.len; i++)
        for (unsigned k = 0; k < NUM_FAMILY_MEMBERS; k++)
            text_fmt(&text, "%u ", l->base.families.items[i].functions[k]);
    return text_cstr(&text);
}

/* wave.glsl's function, run: the code of functions is in the image, too. */
static float run_split(struct layers *l)
{
    uint32_t id = LANG_NONE;
    struct ir_value in = {IR_TYPE_VEC3, {{.f = 1}, {.f = 2}, {.f = 3}}}, out[2];
    for (uint32_t i = 0; i < l->lib.base->impls.len; i++)
        if (l->lib.base->impls.items[i].kind == IMPL_FUNCTION)
            id = l->lib.base->impls.items[i].ref;
    if (!REQUIRE(id != LANG_NONE)
        || !REQUIRE(lang_eval_call(&l->lib.unit, id, &in, out, &(uint32_t){1000}, &l->arena)))
        return NAN;
    return out[1].w[0].f;
}

static const char *standing_on(struct layers *l, const struct image *image)
{
    const char *fault = library_map_image(&l->base, image->data, image->size, true);
    if (fault)
        return fault;
    library_init(&l->lib, &l->arena, &l->base);
    layers_read(l, &l->lib, "document.mtlx", "<tone name='n' type='float'/>");
    return NULL;
}

static void test_image(void)
{
    struct layers l, mapped;
    layers_open(&l, files, standard, "");
    struct image image = pack(&l), again;
    layers_begin(&mapped, files);
    REQUIRE_STR(standing_on(&mapped, &image) ? "refused" : "mapped", "mapped");
    REQUIRE_STR(everything(&mapped), everything(&l));
    uint32_t id = library_match(&mapped.lib, layers_element(&mapped, "n"), &mapped.diags);
    REQUIRE_EQ(id, def(&l, "ND_tone_2"));
    REQUIRE(run_split(&mapped) == 3.0f && run_split(&l) == 3.0f);
    /* the image of equal documents is equal */
    layers_close(&l);
    layers_open(&l, files, standard, "<tone name='n' type='float'/>");
    again = pack(&l);
    REQUIRE(again.size == image.size && memcmp(again.data, image.data, image.size) == 0);
    layers_close(&mapped);
    layers_close(&l);
    free(again.data);
    free(image.data);
}

static const char *refusal(struct image image)
{
    struct library lib;
    const char *fault = library_map_image(&lib, image.data, image.size, true);
    return fault ? fault : "mapped";
}

/* The header has in front of all else: magic, fingerprint, checksum and size. */
enum { IMAGE_MAGIC = 8, IMAGE_FINGERPRINT = 16, IMAGE_CHECKSUM = 24, IMAGE_SIZE = 32 };

/* A word of the reason. */
static const char *expected_refusal(size_t damaged)
{
    return damaged < IMAGE_MAGIC         ? "" /* it is something else */
           : damaged < IMAGE_FINGERPRINT ? "version"
           : damaged < IMAGE_CHECKSUM    ? "checksum"
           : damaged < IMAGE_SIZE        ? "truncated"
                                         : "checksum";
}

static bool is_refused(struct image image, const char *word)
{
    const char *reason = refusal(image);
    bool good = strcmp(reason, "mapped") != 0 && strstr(reason, word);
    if (!good)
        printf("    the image is %s, not refused for '%s'\n", reason, word);
    return good;
}

/* A flipped bit anywhere, an end that is missing, a place that no file is mapped to. */
static void test_damage(void)
{
    struct layers l;
    layers_open(&l, files, standard, "");
    struct image image = pack(&l);
    REQUIRE_STR(refusal(image), "mapped");
    for (size_t i = 0; i < image.size; i += i < 1024 ? 1 : 61) {
        image.data[i] ^= (char)(1 << i % 8);
        if (!REQUIRE(is_refused(image, expected_refusal(i))))
            printf("    byte %zu\n", i);
        image.data[i] ^= (char)(1 << i % 8);
    }
    for (size_t size = 0; size < image.size; size += size < 1024 ? 1 : 997)
        REQUIRE(is_refused((struct image){image.data, size}, ""));
    REQUIRE(is_refused((struct image){image.data, image.size - 1}, "truncated"));
    REQUIRE(is_refused((struct image){image.data + 8, image.size - 8}, "aligned"));
    struct library lib; /* unchecked bytes are for what was built in */
    image.data[image.size - 1] ^= 1;
    REQUIRE(!library_map_image(&lib, image.data, image.size, false));
    layers_close(&l);
    free(image.data);
}

/* The argument is the path of library.txt. */
int main(int argc, char **argv)
{
    test_cases(argc > 1 ? argv[1] : NULL, run_case);
    test_lookup();
    test_types();
    test_inheritance();
    test_implementations();
    test_source_types();
    test_trust();
    test_connections();
    test_interfaces();
    test_cycles();
    test_resolved_graphs();
    test_units();
    test_spaces();
    test_geomprops();
    test_enums();
    test_image();
    test_damage();
    return test_report("library");
}
