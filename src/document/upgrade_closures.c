// SPDX-License-Identifier: Apache-2.0
/* Changes of 1.38 and 1.39 to the layering of closures. */
#include "document/upgrade.h"

/*
 * Before 1.38 a BSDF had its base as an input; now <layer> combines them. The <layer> gets the name
 * that other elements use.
 */
static void split_layer(struct upgrade *u, elem_id top)
{
    struct document *doc = u->doc;
    elem_id base = upgrade_child(u, top, "base");
    if (!base)
        return;
    if (!doc_is_connected(u->doc, base)) {
        doc_remove_element(doc, base);
        return;
    }
    str_id name = doc_element(doc, top)->name;
    struct text top_name;
    text_init(&top_name, doc->arena);
    text_str(&top_name, str_text(doc->strings, name));
    text_str(&top_name, "_top");
    elem_id layer = upgrade_add_node(u, top, text_cstr(&top_name), "layer", STR_BSDF);
    str_id free = doc_element(doc, layer)->name;
    upgrade_set_name(u, top, free);
    upgrade_set_name(u, layer, name);
    doc_move_before(doc, top, layer);
    elem_id input = upgrade_add_input(u, layer, "top", STR_BSDF, STR_EMPTY);
    upgrade_connect(u, input, top, NULL);
    upgrade_move(u, base, layer);
    upgrade_note(u, top, "the input 'base' of <%s> is now a <layer>",
                 str_text(doc->strings, doc_element(doc, top)->category));
}

static void set_transmission(struct upgrade *u, elem_id node)
{
    upgrade_remove_input(u, node, "interior");
    if (!upgrade_child(u, node, "scatter_mode"))
        upgrade_add_input(u, node, "scatter_mode", STR_string, upgrade_word(u, "T"));
}

/* Conductors have physical parameters since 1.38; <artistic_ior> converts the artistic ones. */
static void add_artistic_ior(struct upgrade *u, elem_id conductor)
{
    static const char *const artistic[] = {"reflectivity", "edge_color"}, *const physical[] = {
                                                                              "ior", "extinction"};
    struct document *doc = u->doc;
    if (!upgrade_child(u, conductor, artistic[0]) && !upgrade_child(u, conductor, artistic[1]))
        return;
    elem_id converter =
        upgrade_add_node(u, conductor, "artistic_ior", "artistic_ior", STR_multioutput);
    for (int i = 0; i < 2; i++) {
        upgrade_copy_input(u, upgrade_child(u, conductor, artistic[i]), converter, artistic[i],
                           NULL);
        upgrade_remove_input(u, conductor, artistic[i]);
    }
    for (int i = 0; i < 2; i++) {
        elem_id output =
            doc_add_like(doc, converter, STR_output, upgrade_word(u, physical[i]), converter);
        doc_add_attr(doc, output, (struct attribute){.name = STR_type, .value = STR_color3});
        doc_index_element(doc, output);
        upgrade_connect(u, upgrade_add_input(u, conductor, physical[i], STR_color3, STR_EMPTY),
                        converter, physical[i]);
    }
    upgrade_note(u, conductor, "'reflectivity' and 'edge_color' are now inputs of <artistic_ior>");
}

static const struct {
    const char *old, *new;
    void (*change)(struct upgrade *u, elem_id node);
} closures_138[] = {
    {"dielectric_brdf", "dielectric_bsdf", split_layer},
    {"dielectric_btdf", "dielectric_bsdf", set_transmission},
    {"generalized_schlick_brdf", "generalized_schlick_bsdf", split_layer},
    {"sheen_brdf", "sheen_bsdf", split_layer},
    {"thin_film_brdf", "thin_film_bsdf", split_layer},
    {"conductor_brdf", "conductor_bsdf", add_artistic_ior},
};

static void upgrade_closure(struct upgrade *u, elem_id node)
{
    for (size_t i = 0; i < sizeof closures_138 / sizeof *closures_138; i++) {
        if (!upgrade_is_category(u, node, closures_138[i].old))
            continue;
        upgrade_set_category(u, node, closures_138[i].new);
        upgrade_note(u, node, "<%s> is now <%s>", closures_138[i].old, closures_138[i].new);
        closures_138[i].change(u, node);
        return;
    }
}

/* The outputs of <artistic_ior> changed from vectors to colours. */
static void convert_artistic_ior(struct upgrade *u, elem_id input)
{
    struct document *doc = u->doc;
    elem_id source = upgrade_upstream(u, input), node = doc_element(doc, input)->parent;
    if (!source || doc_element(doc, input)->kind != KIND_INPUT
        || doc_attr_value(doc, input, STR_type) != STR_vector3
        || !upgrade_is_category(u, source, "artistic_ior"))
        return;
    elem_id convert = upgrade_add_node(u, node, "convert", "convert", STR_vector3);
    upgrade_copy_input(u, input, convert, "in", "color3");
    upgrade_connect(u, input, convert, NULL);
    upgrade_note(u, input, "the outputs of <artistic_ior> are now color3");
}

static void set_artistic_output_types(struct upgrade *u, elem_id node)
{
    for (elem_id e = doc_element(u->doc, node)->first_child; e; e = doc_element(u->doc, e)->next)
        if (doc_element(u->doc, e)->kind == KIND_OUTPUT)
            doc_set_attr(u->doc, e, STR_type, STR_color3);
}

/*
 * <complex_ior> gave the artistic parameters of a metal by its index of refraction. It has no
 * successor, but behind it <artistic_ior> gives that index again.
 */
static const struct {
    const char *name, *value; /* an output of <artistic_ior>, and the default of <complex_ior> */
} complex_inputs[] = {{"ior", "0.271, 0.677, 1.316"}, {"extinction", "3.609, 2.625, 2.292"}};

/* The <complex_ior> that gives both inputs of the <artistic_ior> before a port; 0: none does. */
static elem_id complex_before(const struct upgrade *u, elem_id port)
{
    static const char *const artistic[] = {"reflectivity", "edge_color"};
    elem_id converter = upgrade_upstream(u, port), found[2] = {0};
    if (!converter || !upgrade_is_category(u, converter, "artistic_ior"))
        return 0;
    for (int i = 0; i < 2; i++) {
        elem_id input = upgrade_child(u, converter, artistic[i]);
        if (input && upgrade_is(u, doc_attr_value(u->doc, input, STR_output), artistic[i]))
            found[i] = upgrade_upstream(u, input);
    }
    bool is_one = found[0] && found[0] == found[1];
    return is_one && upgrade_is_category(u, found[0], "complex_ior") ? found[0] : 0;
}

/* Reads an input of <complex_ior>, which is a vector, in place of the node. */
static void read_complex(struct upgrade *u, elem_id port, elem_id complex)
{
    struct document *doc = u->doc;
    str_id output = doc_attr_value(doc, port, STR_output),
           type = doc_attr_value(doc, port, STR_type);
    elem_id node = doc_element(doc, port)->parent;
    size_t row = upgrade_is(u, output, complex_inputs[1].name);
    elem_id source = upgrade_child(u, complex, complex_inputs[row].name);
    if (!source)
        source = upgrade_add_input(u, complex, complex_inputs[row].name, STR_vector3,
                                   upgrade_word(u, complex_inputs[row].value));
    if (doc_is_connected(u->doc, source) && type == STR_color3) {
        elem_id convert = upgrade_add_node(u, node, "convert", "convert", STR_color3);
        upgrade_copy_input(u, source, convert, "in", NULL);
        upgrade_connect(u, port, convert, NULL);
        doc_remove_attr(doc, port, STR_output);
        return;
    }
    doc_remove_attr(doc, port, STR_nodename);
    doc_remove_attr(doc, port, STR_output);
    for (uint32_t i = 0; i < doc_element(doc, source)->num_attrs; i++) {
        struct attribute attr = doc_attrs(doc, source)[i];
        if (attr.name != STR_name && attr.name != STR_type)
            doc_set_attr(doc, port, attr.name, attr.value);
    }
}

/* Removes nodes of a category that nothing reads any more. */
static void remove_unread(struct upgrade *u, const char *category)
{
    struct document *doc = u->doc;
    bool *is_read = ARENA_ARRAY(doc->arena, bool, doc->elements.len);
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        elem_id node = upgrade_upstream(u, e);
        if (node)
            is_read[node - doc->first_element] = true;
    }
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e))
        if (upgrade_is_category(u, e, category) && !is_read[e - doc->first_element])
            doc_remove_element(doc, e);
}

void upgrade_complex_ior(struct upgrade *u)
{
    struct document *doc = u->doc;
    bool has_some = false;
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        elem_id complex = doc_element(doc, e)->kind == KIND_INPUT ? complex_before(u, e) : 0;
        if (!complex)
            continue;
        read_complex(u, e, complex);
        upgrade_note(u, e, "'%s' has the value of <complex_ior>, which is no node any more",
                     doc_name(doc, e));
        has_some = true;
    }
    if (has_some) {
        remove_unread(u, "artistic_ior");
        remove_unread(u, "complex_ior");
    }
}

void upgrade_closures(struct upgrade *u)
{
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        if (!upgrade_is_node(u, e))
            continue;
        if (upgrade_is_category(u, e, "artistic_ior"))
            set_artistic_output_types(u, e);
        upgrade_closure(u, e);
    }
    upgrade_complex_ior(u);
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e))
        convert_artistic_ior(u, e);
}
