// SPDX-License-Identifier: Apache-2.0
/*
 * Upgrades documents of MaterialX 1.22 to 1.38 to 1.39, with one step per version that changed
 * something. The tables below contain all renames; functions in upgrade_*.c change the structure of
 * graphs.
 */
#include "document/upgrade.h"

#include "base/num.h"

#include <assert.h>

enum { FIRST_MINOR = 22, CURRENT_MINOR = 39 };

/* Types with a new name since 1.<minor>. */
static const struct {
    int minor;
    const char *old, *new;
} type_renames[] = {
    {23, "vector", "vector3"},
    {35, "matrix", "matrix44"},
    {38, "color2", "vector2"},
};

static const struct {
    int minor;
    const char *category; /* NULL: any */
    const char *old, *new;
    bool only_if_absent; /* keep the new attribute if it exists */
} attr_renames[] = {
    {24, "shader", "shadername", "node", false},
    {25, "input", "graphname", "opgraph", false},
    {34, "shader", "shaderprogram", "node", false},
    {34, "bindinput", "opgraph", "nodegraph", true},
    {34, "bindinput", "graphoutput", "output", true},
    {35, NULL, "default", "value", true},
    {37, "geomattrvalue", "attrname", "geomprop", false},
};

/* Elements other than nodes. */
static const struct {
    int minor;
    const char *old, *new;
} element_renames[] = {
    {24, "assign", "materialassign"}, {34, "opgraph", "nodegraph"}, {34, "shader", "nodedef"},
    {34, "geomattr", "geomprop"},     {37, "geomattr", "geomprop"},
};

/* Restricts a rename to some nodes of a category. */
enum condition {
    ALWAYS,
    TYPE_IS,      /* the node's type is `argument` */
    IN_TYPE_IS,   /* the type of its input "in" is */
    HAS_INPUT,    /* it has an input `argument` */
    HAS_NO_SPACE, /* neither fromspace nor tospace */
};

/* The first matching row applies. `inputs` is "old>new …", all renamed at once. */
static const struct node_rename {
    int minor;
    const char *old;
    enum condition condition;
    const char *argument, *new, *inputs;
} node_renames[] = {
    {26, "constant", ALWAYS, NULL, "constant", "color>value"},
    {37, "invert", TYPE_IS, "matrix33", "invertmatrix", ""},
    {37, "invert", TYPE_IS, "matrix44", "invertmatrix", ""},
    {37, "rotate", TYPE_IS, "vector2", "rotate2d", ""},
    {37, "rotate", ALWAYS, NULL, "rotate3d", ""},
    {37, "compare", ALWAYS, NULL, "ifgreatereq", "intest>value1 cutoff>value2 in1>in2 in2>in1"},
    {37, "transformpoint", HAS_NO_SPACE, NULL, "transformmatrix", ""},
    {37, "transformvector", HAS_NO_SPACE, NULL, "transformmatrix", ""},
    {37, "transformnormal", HAS_NO_SPACE, NULL, "transformmatrix", ""},
    {37, "combine", HAS_INPUT, "in4", "combine4", ""},
    {37, "combine", HAS_INPUT, "in3", "combine3", ""},
    {37, "combine", ALWAYS, NULL, "combine2", ""},
    {37, "separate", IN_TYPE_IS, "color4", "separate4", ""},
    {37, "separate", IN_TYPE_IS, "vector4", "separate4", ""},
    {37, "separate", IN_TYPE_IS, "color3", "separate3", ""},
    {37, "separate", IN_TYPE_IS, "vector3", "separate3", ""},
    {37, "separate", HAS_INPUT, "in", "separate2", ""},
    {37, "geomattrvalue", ALWAYS, NULL, "geompropvalue", "attrname>geomprop"},
    {38, "atan2", ALWAYS, NULL, "atan2", "in1>in2 in2>in1"},
    {38, "diffuse_brdf", ALWAYS, NULL, "oren_nayar_diffuse_bsdf", ""},
    {38, "burley_diffuse_brdf", ALWAYS, NULL, "burley_diffuse_bsdf", ""},
    {38, "diffuse_btdf", ALWAYS, NULL, "translucent_bsdf", ""},
    {38, "subsurface_brdf", ALWAYS, NULL, "subsurface_bsdf", ""},
    {39, "atan2", ALWAYS, NULL, "atan2", "in1>iny in2>inx"},
};

#define LENGTH(array) (sizeof(array) / sizeof *(array))

static void rename_type(struct upgrade *u, elem_id element)
{
    str_id type = doc_attr_value(u->doc, element, STR_type);
    for (size_t i = 0; type && i < LENGTH(type_renames); i++) {
        if (type_renames[i].minor != u->minor || !upgrade_is(u, type, type_renames[i].old))
            continue;
        doc_set_attr(u->doc, element, STR_type, upgrade_word(u, type_renames[i].new));
        upgrade_note(u, element, "type '%s' is now '%s'", type_renames[i].old, type_renames[i].new);
        return;
    }
}

static void rename_attrs(struct upgrade *u, elem_id element)
{
    for (size_t i = 0; i < LENGTH(attr_renames); i++) {
        const char *category = attr_renames[i].category;
        if (attr_renames[i].minor != u->minor
            || (category && !upgrade_is_category(u, element, category)))
            continue;
        str_id value = upgrade_attr(u, element, attr_renames[i].old),
               new = upgrade_word(u, attr_renames[i].new);
        if (!value || (attr_renames[i].only_if_absent && doc_attr(u->doc, element, new)))
            continue;
        doc_set_attr(u->doc, element, new, value);
        doc_remove_attr(u->doc, element, upgrade_word(u, attr_renames[i].old));
        upgrade_note(u, element, "attribute '%s' is now '%s'", attr_renames[i].old,
                     attr_renames[i].new);
    }
}

static void rename_element(struct upgrade *u, elem_id element)
{
    for (size_t i = 0; i < LENGTH(element_renames); i++) {
        if (element_renames[i].minor != u->minor
            || !upgrade_is_category(u, element, element_renames[i].old))
            continue;
        doc_set_category(u->doc, element, upgrade_word(u, element_renames[i].new));
        upgrade_note(u, element, "<%s> is now <%s>", element_renames[i].old,
                     element_renames[i].new);
        return;
    }
}

static bool fits(const struct upgrade *u, elem_id node, const struct node_rename *row)
{
    elem_id in;
    switch (row->condition) {
    case ALWAYS: return true;
    case TYPE_IS: return upgrade_is(u, doc_attr_value(u->doc, node, STR_type), row->argument);
    case IN_TYPE_IS:
        in = upgrade_child(u, node, "in");
        return in && upgrade_is(u, doc_attr_value(u->doc, in, STR_type), row->argument);
    case HAS_INPUT: return upgrade_child(u, node, row->argument) != 0;
    case HAS_NO_SPACE:
        return !upgrade_child(u, node, "fromspace") && !upgrade_child(u, node, "tospace");
    }
    return false;
}

/* Renames inputs, all at once, so that two can swap names. */
static void rename_inputs(struct upgrade *u, elem_id node, const char *pairs)
{
    enum { MAX_PAIRS = 4 };
    elem_id inputs[MAX_PAIRS] = {0};
    str_id names[MAX_PAIRS];
    size_t count = 0;
    for (; *pairs; count++, pairs += strspn(pairs, " ")) {
        assert(count < MAX_PAIRS);
        size_t old_len = strcspn(pairs, ">"), new_len = strcspn(pairs + old_len + 1, " ");
        inputs[count] = doc_child(u->doc, node, str_find(u->doc->strings, pairs, old_len));
        names[count] = str_intern(u->doc->strings, pairs + old_len + 1, new_len);
        pairs += old_len + 1 + new_len;
    }
    for (size_t i = 0; i < count; i++) {
        if (!inputs[i])
            continue;
        upgrade_note(u, inputs[i], "input '%s' is now '%s'", doc_name(u->doc, inputs[i]),
                     str_text(u->doc->strings, names[i]));
        doc_set_name(u->doc, inputs[i], names[i]);
    }
    for (size_t i = 0; i < count; i++)
        if (inputs[i])
            doc_index_element(u->doc, inputs[i]);
}

static void rename_node(struct upgrade *u, elem_id node)
{
    for (const struct node_rename *row = node_renames; row < node_renames + LENGTH(node_renames);
         row++) {
        if (row->minor != u->minor || !upgrade_is_category(u, node, row->old)
            || !fits(u, node, row))
            continue;
        if (strcmp(row->old, row->new) != 0) {
            upgrade_set_category(u, node, row->new);
            upgrade_note(u, node, "<%s> is now <%s>", row->old, row->new);
        }
        rename_inputs(u, node, row->inputs);
        return;
    }
}

static void apply_tables(struct upgrade *u)
{
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        rename_type(u, e);
        rename_attrs(u, e);
        rename_element(u, e);
        if (upgrade_is_node(u, e))
            rename_node(u, e);
    }
}

/* 1.35: the name of a material assignment was the name of its material. */
static void name_assigned_materials(struct upgrade *u)
{
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        const struct element *element = doc_element(u->doc, e);
        if (element->kind != KIND_MATERIALASSIGN || doc_attr(u->doc, e, STR_material))
            continue;
        doc_set_attr(u->doc, e, STR_material, element->name);
        upgrade_note(u, e, "<materialassign> names its material with 'material'");
    }
}

/* Replaces all occurrences of a text in a value. */
static void replace_in_value(struct upgrade *u, elem_id element, const char *old, const char *new)
{
    struct document *doc = u->doc;
    const char *value = str_text(doc->strings, doc_attr_value(doc, element, STR_value)),
               *found = strstr(value, old);
    if (!found)
        return;
    struct text text;
    text_init(&text, doc->arena);
    for (; found; value = found + strlen(old), found = strstr(value, old)) {
        text_mem(&text, value, (size_t)(found - value));
        text_str(&text, new);
    }
    text_str(&text, value);
    doc_set_attr(doc, element, STR_value, str_intern(doc->strings, text.data, text.len));
    upgrade_note(u, element, "'%s' is now '%s'", old, new);
}

/*
 * 1.36: "/" instead of "*" means all geometry; tile tokens use angle brackets; inheritance is an
 * attribute.
 */
static void upgrade_values_and_inheritance(struct upgrade *u)
{
    struct document *doc = u->doc;
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        str_id type = doc_attr_value(doc, e, STR_type);
        elem_id parent = doc_element(doc, e)->parent;
        bool material = upgrade_is_category(u, e, "materialinherit"),
             look = upgrade_is_category(u, e, "lookinherit");
        if (type == STR_geomname && upgrade_is(u, doc_attr_value(doc, e, STR_value), "*"))
            replace_in_value(u, e, "*", "/");
        if (type == STR_filename) {
            replace_in_value(u, e, "%UDIM", "<UDIM>");
            replace_in_value(u, e, "%UVTILE", "<UVTILE>");
        }
        if (parent && (material || look)) {
            doc_set_attr(doc, parent, STR_inherit,
                         doc_attr_value(doc, e, material ? STR_material : STR_look));
            doc_remove_element(doc, e);
            upgrade_note(u, e, "<%s> is now the attribute 'inherit'",
                         material ? "materialinherit" : "lookinherit");
        }
    }
    upgrade_material_overrides(u);
}

/* 1.37: the outputs of a nodedef have its type. */
static void move_nodedef_type(struct upgrade *u, elem_id nodedef)
{
    struct document *doc = u->doc;
    assert(doc_element(doc, nodedef)->kind == KIND_NODEDEF);
    str_id type = doc_attr_value(doc, nodedef, STR_type),
           default_input = doc_attr_value(doc, nodedef, STR_defaultinput);
    doc_remove_attr(doc, nodedef, STR_type);
    doc_remove_attr(doc, nodedef, STR_defaultinput);
    if (type == STR_multioutput || doc_child(doc, nodedef, STR_out))
        return;
    elem_id output = doc_add_like(doc, nodedef, STR_output, STR_out, nodedef);
    doc_add_attr(doc, output, (struct attribute){.name = STR_type, .value = type});
    if (default_input)
        doc_add_attr(doc, output,
                     (struct attribute){.name = STR_defaultinput, .value = default_input});
    doc_index_element(doc, output);
    upgrade_note(u, nodedef, "the type of a <nodedef> is that of its <output>");
}

/* 1.37: a backdrop is an element with attributes, instead of a node with parameters. */
static void upgrade_backdrop(struct upgrade *u, elem_id backdrop)
{
    struct document *doc = u->doc;
    assert(doc_element(doc, backdrop)->kind == KIND_BACKDROP);
    for (elem_id e = doc_element(doc, backdrop)->first_child, next; e; e = next) {
        next = doc_element(doc, e)->next;
        if (!upgrade_is_category(u, e, "parameter"))
            continue;
        doc_set_attr(doc, backdrop, doc_element(doc, e)->name, doc_attr_value(doc, e, STR_value));
        doc_remove_element(doc, e);
        upgrade_note(u, e, "the <parameter> of a <backdrop> is now an attribute");
    }
}

static void upgrade_definitions(struct upgrade *u)
{
    upgrade_legacy_nodedefs(u);
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        const struct element *element = doc_element(u->doc, e);
        if (element->kind == KIND_NODEDEF && doc_attr_value(u->doc, e, STR_type))
            move_nodedef_type(u, e);
        else if (element->kind == KIND_BACKDROP)
            upgrade_backdrop(u, e);
        else
            upgrade_property(u, e); /* was <geomattrvalue> */
    }
}

/* 1.38: parameters are inputs, and uniform inputs in a nodedef. */
static void upgrade_parameters(struct upgrade *u)
{
    struct document *doc = u->doc;
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        elem_id parent = doc_element(doc, e)->parent;
        if (doc_element(doc, e)->category != STR_parameter || !parent)
            continue;
        doc_set_category(doc, e, STR_input);
        if (doc_element(doc, parent)->kind == KIND_NODEDEF)
            doc_set_attr(doc, e, STR_uniform, STR_true);
        upgrade_note(u, e, "<parameter> is now <input>");
    }
}

/* "name_node", with a number if that name exists. */
static str_id name_beside(struct upgrade *u, elem_id scope, str_id name)
{
    struct text text;
    text_init(&text, u->doc->arena);
    text_mem(&text, str_text(u->doc->strings, name), str_len(u->doc->strings, name));
    str_id id;
    do {
        text_str(&text, "_node");
        id = str_intern(u->doc->strings, text.data, text.len);
    } while (doc_child(u->doc, scope, id));
    return id;
}

/*
 * 1.38: nodes and interface inputs of a nodegraph share one scope, so a node with the name of an
 * input gets a new name.
 */
static void rename_clashing_nodes(struct upgrade *u)
{
    struct document *doc = u->doc;
    str_id *new_names = ARENA_ARRAY(doc->arena, str_id, doc->elements.len);
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        str_id interface = doc_attr_value(doc, e, STR_interfacename);
        elem_id scope = interface ? upgrade_scope(u, e) : 0,
                node = scope ? doc_child(doc, scope, interface) : 0;
        if (node && doc_element(doc, node)->kind == KIND_NODE
            && doc_element(doc, scope)->kind == KIND_NODEGRAPH)
            new_names[node - doc->first_element] = name_beside(u, scope, interface);
    }
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        elem_id node = upgrade_upstream(u, e);
        if (node && new_names[node - doc->first_element])
            doc_set_attr(doc, e, STR_nodename, new_names[node - doc->first_element]);
    }
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        str_id name = new_names[e - doc->first_element];
        if (!name)
            continue;
        upgrade_note(u, e, "node '%s', called like an input of its graph, is now '%s'",
                     doc_name(doc, e), str_text(doc->strings, name));
        upgrade_set_name(u, e, name);
    }
}

static void upgrade_graphs(struct upgrade *u)
{
    upgrade_materials(u);
    upgrade_closures(u);
    rename_clashing_nodes(u);
    upgrade_parameters(u);
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        if (doc_element(u->doc, e)->kind == KIND_NODEGRAPH)
            doc_remove_attr(u->doc, e, STR_version);
    }
}

/* 1.39: an input has a value or a connection, not both. */
static void remove_overridden_values(struct upgrade *u)
{
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        const struct element *element = doc_element(u->doc, e);
        if (element->kind != KIND_INPUT || !element->parent
            || doc_element(u->doc, element->parent)->kind != KIND_NODE
            || !doc_attr(u->doc, e, STR_value) || !doc_is_connected(u->doc, e))
            continue;
        doc_remove_attr(u->doc, e, STR_value);
        upgrade_note(u, e, "the value of the connected input '%s' is gone",
                     str_text(u->doc->strings, element->name));
    }
}

/* 1.39: the radius of subsurface scattering is a colour. */
static void upgrade_subsurface(struct upgrade *u, elem_id node)
{
    elem_id radius = upgrade_child(u, node, "radius");
    if (!radius || doc_attr_value(u->doc, radius, STR_type) != STR_vector3)
        return;
    upgrade_note(u, radius, "the input 'radius' of <subsurface_bsdf> is now a color3");
    if (doc_is_connected(u->doc, radius) || doc_attr(u->doc, radius, STR_unit)) {
        elem_id convert = upgrade_add_node(u, node, "convert", "convert", STR_color3);
        upgrade_copy_input(u, radius, convert, "in", NULL);
        doc_remove_attr(u->doc, radius, STR_value);
        doc_remove_attr(u->doc, radius, STR_unit);
        doc_remove_attr(u->doc, radius, STR_unittype);
        upgrade_connect(u, radius, convert, NULL);
    }
    doc_set_attr(u->doc, radius, STR_type, STR_color3);
    upgrade_keep_numbers(u, radius);
}

/* A definition of a library changes its input as a node does. */
static void upgrade_subsurface_definition(struct upgrade *u, elem_id nodedef)
{
    elem_id radius = upgrade_child(u, nodedef, "radius");
    if (!upgrade_is(u, doc_attr_value(u->doc, nodedef, STR_node), "subsurface_bsdf") || !radius
        || doc_attr_value(u->doc, radius, STR_type) != STR_vector3)
        return;
    doc_set_attr(u->doc, radius, STR_type, STR_color3);
    upgrade_keep_numbers(u, radius);
    upgrade_note(u, radius, "the input 'radius' of <subsurface_bsdf> is now a color3");
}

/* 1.39: <switch> has ten inputs; before, a value above 5 selected the first. */
static void upgrade_switch(struct upgrade *u, elem_id node)
{
    elem_id which = upgrade_child(u, node, "which");
    str_id value = which ? doc_attr_value(u->doc, which, STR_value) : STR_EMPTY;
    float number;
    if (!value
        || !num_parse_float(str_text(u->doc->strings, value), str_len(u->doc->strings, value),
                            &number)
        || number < 5.0f)
        return;
    doc_set_attr(u->doc, which, STR_value, upgrade_word(u, "0"));
    upgrade_note(u, which, "'which' beyond the five inputs of <switch> meant the first");
}

/*
 * 1.39: <normalmap> only supports tangent space; in object space it computed normalize(in * 2 - 1).
 */
static void replace_object_normalmap(struct upgrade *u, elem_id node)
{
    struct document *doc = u->doc;
    elem_id multiply = upgrade_add_node(u, node, "normalmap_multiply", "multiply", STR_vector3);
    if (upgrade_child(u, node, "in"))
        upgrade_copy_input(u, upgrade_child(u, node, "in"), multiply, "in1", NULL);
    else
        upgrade_add_input(u, multiply, "in1", STR_vector3, upgrade_word(u, "0.5, 0.5, 1.0"));
    upgrade_add_input(u, multiply, "in2", STR_float, upgrade_word(u, "2.0"));
    elem_id subtract = upgrade_add_node(u, node, "normalmap_subtract", "subtract", STR_vector3);
    upgrade_connect(u, upgrade_add_input(u, subtract, "in1", STR_vector3, STR_EMPTY), multiply,
                    NULL);
    upgrade_add_input(u, subtract, "in2", STR_float, upgrade_word(u, "1.0"));
    while (doc_element(doc, node)->first_child)
        doc_remove_element(doc, doc_element(doc, node)->first_child);
    upgrade_set_category(u, node, "normalize");
    upgrade_connect(u, upgrade_add_input(u, node, "in", STR_vector3, STR_EMPTY), subtract, NULL);
    upgrade_note(u, node, "<normalmap> in object space is now <normalize> of in * 2 - 1");
}

/*
 * Adds an input of the cross product. Without a value it is the geometric vector, the default of
 * the normal map.
 */
static void add_cross_input(struct upgrade *u, elem_id node, const char *name, elem_id cross,
                            const char *in)
{
    elem_id source = upgrade_child(u, node, name);
    if (source) {
        upgrade_copy_input(u, source, cross, in, NULL);
        return;
    }
    elem_id geometry = upgrade_add_node(u, cross, name, name, STR_vector3);
    upgrade_add_input(u, geometry, "space", STR_string, STR_world);
    upgrade_connect(u, upgrade_add_input(u, cross, in, STR_vector3, STR_EMPTY), geometry, NULL);
}

/* 1.39: the bitangent is an input; it was normalize(cross(normal, tangent)). */
static void upgrade_normalmap(struct upgrade *u, elem_id node)
{
    elem_id space = upgrade_child(u, node, "space");
    if (space && upgrade_is(u, doc_attr_value(u->doc, space, STR_value), "object")) {
        replace_object_normalmap(u, node);
        return;
    }
    if (space && doc_is_connected(u->doc, space))
        upgrade_tell_loss(u, space,
                          "<normalmap> has no input 'space'; its normals are read in tangent "
                          "space, whatever this connection says");
    if (space) {
        doc_remove_element(u->doc, space);
        upgrade_note(u, node, "<normalmap> has no input 'space'");
    }
    if (doc_attr(u->doc, node, STR_nodedef)) {
        doc_remove_attr(u->doc, node, STR_nodedef);
        upgrade_note(u, node, "the definition of <normalmap> is found by its types");
    }
    bool has_frame = upgrade_child(u, node, "normal") || upgrade_child(u, node, "tangent");
    if (!has_frame || upgrade_child(u, node, "bitangent"))
        return;
    elem_id normalize = upgrade_add_node(u, node, "normalmap_bitangent", "normalize", STR_vector3);
    elem_id cross = upgrade_add_node(u, normalize, "normalmap_cross", "crossproduct", STR_vector3);
    add_cross_input(u, node, "normal", cross, "in1");
    add_cross_input(u, node, "tangent", cross, "in2");
    upgrade_connect(u, upgrade_add_input(u, normalize, "in", STR_vector3, STR_EMPTY), cross, NULL);
    upgrade_connect(u, upgrade_add_input(u, node, "bitangent", STR_vector3, STR_EMPTY), normalize,
                    NULL);
    upgrade_note(
        u, node,
        "<normalmap> has an input 'bitangent', the normalized cross product of normal and tangent");
}

static void upgrade_nodes(struct upgrade *u)
{
    upgrade_channels(u);
    remove_overridden_values(u);
    upgrade_thin_films(u);
    upgrade_swizzles(u);
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        if (doc_element(u->doc, e)->kind == KIND_NODEDEF)
            upgrade_subsurface_definition(u, e);
        if (!upgrade_is_node(u, e))
            continue;
        if (upgrade_is_category(u, e, "subsurface_bsdf"))
            upgrade_subsurface(u, e);
        else if (upgrade_is_category(u, e, "switch"))
            upgrade_switch(u, e);
        else if (upgrade_is_category(u, e, "normalmap"))
            upgrade_normalmap(u, e);
    }
}

/* The functions of a step, before and after its tables. */
static const struct {
    int minor;
    void (*before)(struct upgrade *u), (*after)(struct upgrade *u);
} steps[] = {
    {23, NULL, NULL},
    {24, NULL, NULL},
    {25, NULL, NULL},
    {26, NULL, NULL},
    {34, NULL, upgrade_opgraphs},
    {35, NULL, name_assigned_materials},
    {36, NULL, upgrade_values_and_inheritance},
    {37, NULL, upgrade_definitions},
    {38, upgrade_color2_channels, upgrade_graphs},
    {39, NULL, upgrade_nodes},
};

static bool parse_version(const char *text, size_t len, int64_t *out_major, int64_t *out_minor)
{
    const char *dot = memchr(text, '.', len);
    size_t before = dot ? (size_t)(dot - text) : 0;
    return dot && num_parse_int(text, before, out_major) == before
           && num_parse_int(dot + 1, len - before - 1, out_minor) != 0 && *out_major >= 1
           && *out_minor >= 0;
}

bool doc_is_current_version(const char *text)
{
    int64_t major = 0, minor = 0;
    return parse_version(text, strlen(text), &major, &minor) && major == 1
           && minor == CURRENT_MINOR;
}

/*
 * The minor version of 1.x. Reports an invalid version; CURRENT_MINOR if there is nothing to
 * upgrade.
 */
static int read_version(struct document *doc, elem_id root, struct diag_list *diags)
{
    str_id version = doc_attr_value(doc, root, STR_version);
    struct diag_place place = doc_attr_place(doc, root, STR_version);
    const char *text = str_text(doc->strings, version);
    int64_t major = 0, minor = 0;
    if (!version)
        diag_add(diags, DIAG_ID_version_missing, place);
    else if (!parse_version(text, str_len(doc->strings, version), &major, &minor))
        diag_add(diags, DIAG_ID_version_bad, place, text);
    else if (major > 1 || minor > CURRENT_MINOR)
        diag_add(diags, DIAG_ID_version_newer, place, text);
    else
        return (int)minor;
    return CURRENT_MINOR;
}

/* True for what 1.38 and 1.39 removed, and documents of these versions still contain. */
static bool is_outdated(const struct document *doc, elem_id element)
{
    str_id complex_ior = str_find(doc->strings, "complex_ior", 11),
           category = doc_element(doc, element)->category;
    return doc_attr(doc, element, STR_channels) || category == STR_parameter
           || (complex_ior && category == complex_ior);
}

static bool has_outdated(const struct document *doc, elem_id root, elem_id end)
{
    for (elem_id e = root; e < end; e++)
        if (is_outdated(doc, e))
            return true;
    return false;
}

/* Documents of 1.38 and 1.39 still contain the type color2, which 1.38 removed. */
static void replace_color2(struct upgrade *u)
{
    str_id color2 = str_find(u->doc->strings, "color2", 6);
    bool has_it = false;
    for (elem_id e = color2 ? u->root : u->end; e < u->end && !has_it; e++)
        has_it = doc_attr_value(u->doc, e, STR_type) == color2;
    if (!has_it)
        return;
    doc_index_names(u->doc, NULL);
    u->minor = 38;
    upgrade_color2_channels(u);
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e))
        rename_type(u, e);
}

static void upgrade_from(struct document *doc, elem_id root, elem_id end, int minor,
                         struct diag_list *diags)
{
    assert(root < end && end <= doc->first_element + doc->elements.len);
    struct upgrade u = {.doc = doc,
                        .diags = diags,
                        .root = root,
                        .end = end,
                        .first_added = doc->first_element + doc->elements.len};
    /*
     * Documents that declare 1.38 or 1.39 still contain constructs which these versions removed.
     * Ignoring them would change the look.
     */
    u.minor = CURRENT_MINOR;
    upgrade_always(&u);
    if (minor >= 38)
        replace_color2(&u);
    u.outdated = minor >= CURRENT_MINOR;
    if (u.outdated && !has_outdated(doc, root, end))
        return;
    doc_index_names(doc, NULL);
    if (minor >= 38) {
        u.minor = 38;
        upgrade_parameters(&u);
        upgrade_complex_ior(&u);
    }
    if (u.outdated) {
        u.minor = CURRENT_MINOR;
        upgrade_channels(&u);
        return;
    }
    vec_push(doc->arena, &doc->older, (struct doc_range){root, end});
    for (size_t i = 0; i < LENGTH(steps); i++) {
        u.minor = steps[i].minor;
        assert(i == 0 || steps[i].minor > steps[i - 1].minor);
        if (u.minor <= minor)
            continue;
        upgrade_defaults(&u);
        if (steps[i].before)
            steps[i].before(&u);
        apply_tables(&u);
        if (steps[i].after)
            steps[i].after(&u);
    }
    doc_set_attr(doc, root, STR_version, upgrade_word(&u, "1.39"));
}

void doc_upgrade(struct document *doc, elem_id root, elem_id end, struct diag_list *diags)
{
    upgrade_from(doc, root, end, read_version(doc, root, diags), diags);
}

void doc_upgrade_edit(struct document *doc, struct diag_list *diags)
{
    upgrade_from(doc, doc->root, doc->first_element + doc->elements.len, CURRENT_MINOR, diags);
}

bool doc_needs_upgrade(const struct document *doc, elem_id element)
{
    str_id color2 = str_find(doc->strings, "color2", 6);
    return is_outdated(doc, element) || upgrade_always_changes(doc, element)
           || (color2 && doc_attr_value(doc, element, STR_type) == color2);
}
