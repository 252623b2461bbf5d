// SPDX-License-Identifier: Apache-2.0
/*
 * Materials before 1.38 were elements: a <material> contained <shaderref>s, which bound values and
 * graphs to the inputs of a shader, in the earliest versions through the shader's definition. Both
 * are nodes now.
 */
#include "document/upgrade.h"

#include "base/hash.h"

#include <assert.h>

static bool is_shader_ref(const struct upgrade *u, elem_id element)
{
    return doc_element(u->doc, element)->parent && upgrade_is_category(u, element, "shaderref");
}

static elem_id find_top_level(const struct upgrade *u, str_id name)
{
    elem_id found = name ? doc_child(u->doc, u->root, name) : 0;
    for (const struct document *layer = u->doc; layer && name && !found; layer = layer->base)
        found = doc_child(layer, layer->root, name);
    return found;
}

static str_id nodedef_type(const struct document *doc, elem_id nodedef)
{
    str_id type = doc_attr_value(doc, nodedef, STR_type);
    for (elem_id e = doc_element(doc, nodedef)->first_child; e && !type;
         e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_OUTPUT)
            type = doc_attr_value(doc, e, STR_type);
    return type;
}

static bool defines(const struct document *doc, elem_id nodedef, str_id node, str_id type)
{
    return doc_attr_value(doc, nodedef, STR_node) == node
           && (!type || nodedef_type(doc, nodedef) == type);
}

/* The first definition of a node, with this type if `type` is set; 0: none. */
static elem_id find_definition(const struct upgrade *u, str_id node, str_id type)
{
    uint32_t hash = hash_pair(node, type);
    for (uint32_t at = hash, found; (found = table_next(&u->definitions, hash, &at));)
        if (defines(u->doc, found, node, type))
            return found;
    return 0;
}

static void add_definitions(struct upgrade *u, elem_id root)
{
    for (elem_id e = doc_element(u->doc, root)->first_child; e; e = doc_element(u->doc, e)->next) {
        str_id node = doc_element(u->doc, e)->kind == KIND_NODEDEF
                          ? doc_attr_value(u->doc, e, STR_node)
                          : STR_EMPTY;
        const str_id types[] = {STR_EMPTY, node ? nodedef_type(u->doc, e) : STR_EMPTY};
        for (size_t i = 0; i < 2 && node; i++)
            if (!find_definition(u, node, types[i]))
                table_add(&u->definitions, u->doc->arena, hash_pair(node, types[i]), e);
    }
}

/* Finds the definitions anew: of the file first, then of the document and its libraries. */
static void find_definitions(struct upgrade *u)
{
    u->definitions = (struct table){0};
    u->has_definitions = true;
    add_definitions(u, u->root);
    for (const struct document *layer = u->doc; layer; layer = layer->base)
        if (layer->root != u->root)
            add_definitions(u, layer->root);
}

/* The definition of the shader of a shaderref, from the document or its library; 0: unknown. */
static elem_id shader_definition(struct upgrade *u, elem_id shader_ref)
{
    const struct document *doc = u->doc;
    str_id name = doc_attr_value(doc, shader_ref, STR_nodedef),
           node = doc_attr_value(doc, shader_ref, STR_node);
    if (name)
        return find_top_level(u, name);
    if (node && !u->has_definitions)
        find_definitions(u);
    return node ? find_definition(u, node, doc_attr_value(doc, shader_ref, STR_type)) : 0;
}

enum { MAX_INPUTS = 1024 }; /* of a definition, as in its use */

/* The first child of a definition; `*left` counts the children that a walk may visit. */
static elem_id first_input(const struct document *doc, elem_id nodedef, unsigned *left)
{
    *left = MAX_INPUTS;
    return nodedef ? doc_element(doc, nodedef)->first_child : 0;
}

static elem_id next_input(const struct document *doc, elem_id input, unsigned *left)
{
    return --*left ? doc_element(doc, input)->next : 0;
}

/* 1.34 */

/* Parameters of type opgraphnode connected nodes. */
static void connect_opgraph_node(struct upgrade *u, elem_id parameter)
{
    struct document *doc = u->doc;
    elem_id parent = doc_element(doc, parameter)->parent;
    str_id node = doc_attr_value(doc, parameter, STR_value);
    if (doc_element(doc, parent)->kind == KIND_OUTPUT) {
        if (doc_element(doc, parameter)->name == STR_in)
            doc_set_attr(doc, parent, STR_nodename, node);
        doc_remove_element(doc, parameter);
    } else if (upgrade_is_node(u, parent)) {
        doc_set_category(doc, parameter, STR_input);
        doc_remove_attr(doc, parameter, STR_value);
        doc_set_attr(doc, parameter, STR_nodename, node);
        str_id type = upgrade_upstream_type(u, parameter);
        doc_set_attr(doc, parameter, STR_type, type ? type : STR_color3);
    }
    upgrade_note(u, parameter, "a <parameter> of type opgraphnode is now the attribute 'nodename'");
}

static void set_shader_type(struct upgrade *u, elem_id element)
{
    struct document *doc = u->doc;
    if (!upgrade_attr(u, element, "shadertype"))
        return;
    doc_set_attr(doc, element, STR_type, STR_surfaceshader);
    if (is_shader_ref(u, element))
        doc_remove_attr(doc, element, upgrade_word(u, "shadertype"));
}

/* A shaderref without a reference had the name of its definition. */
static void name_definition(struct upgrade *u, elem_id shader_ref)
{
    struct document *doc = u->doc;
    if (shader_definition(u, shader_ref))
        return;
    str_id name = doc_element(doc, shader_ref)->name;
    elem_id nodedef = find_top_level(u, name);
    if (!nodedef || doc_element(doc, nodedef)->kind != KIND_NODEDEF)
        return;
    doc_set_attr(doc, shader_ref, STR_nodedef, name);
    doc_set_attr(doc, shader_ref, STR_node, doc_attr_value(doc, nodedef, STR_node));
    upgrade_note(u, shader_ref, "<shaderref> names its definition with 'nodedef'");
}

static elem_id add_binding(struct upgrade *u, elem_id shader_ref, elem_id input)
{
    struct document *doc = u->doc;
    elem_id binding = doc_add_like(doc, shader_ref, upgrade_word(u, "bindinput"),
                                   doc_element(doc, input)->name, input);
    doc_add_attr(
        doc, binding,
        (struct attribute){.name = STR_type, .value = doc_attr_value(doc, input, STR_type)});
    doc_index_element(doc, binding);
    assert(doc_element(doc, binding)->parent == shader_ref);
    return binding;
}

/* Graphs were connected to the inputs of a definition. */
static void bind_graphs(struct upgrade *u, elem_id shader_ref)
{
    struct document *doc = u->doc;
    unsigned left;
    for (elem_id e = first_input(doc, shader_definition(u, shader_ref), &left); e;
         e = next_input(doc, e, &left)) {
        str_id graph = upgrade_attr(u, e, "opgraph"), output = upgrade_attr(u, e, "graphoutput");
        if (!graph || !output || doc_child(doc, shader_ref, doc_element(doc, e)->name))
            continue;
        elem_id binding = add_binding(u, shader_ref, e);
        doc_set_attr(doc, binding, STR_nodegraph, graph);
        doc_set_attr(doc, binding, STR_output, output);
        upgrade_note(u, e,
                     "a graph is connected where the shader is used, not where it is defined");
    }
}

static bool has_number(const struct table *table, uint32_t number)
{
    uint32_t hash = hash_pair(number, 0);
    for (uint32_t at = hash, found; (found = table_next(table, hash, &at));)
        if (found == number)
            return true;
    return false;
}

/* Collects the tiles of all geometry (spec 1.34: the geometry property "udimset"). */
static void collect_udims(struct upgrade *u)
{
    struct document *doc = u->doc;
    struct text list;
    text_init(&list, doc->arena);
    elem_id first = 0;
    struct table known = {0};
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        const struct element *element = doc_element(doc, e);
        if (element->kind != KIND_GEOMPROP || !upgrade_is(u, element->name, "udim"))
            continue;
        str_id udim = doc_attr_value(doc, e, STR_value);
        if (udim && !has_number(&known, udim)) {
            table_add(&known, doc->arena, hash_pair(udim, 0), udim);
            text_str(&list, list.len ? ", " : "");
            text_str(&list, str_text(doc->strings, udim));
        }
        first = first ? first : e;
    }
    if (!first)
        return;
    elem_id info = doc_add_like(doc, u->root, STR_geominfo, upgrade_word(u, "udimset_info"), first);
    elem_id set = doc_add_like(doc, info, STR_geomprop, upgrade_word(u, "udimset"), first);
    doc_add_attr(doc, set, (struct attribute){.name = STR_type, .value = STR_stringarray});
    doc_add_attr(doc, set,
                 (struct attribute){.name = STR_value,
                                    .value = str_intern(doc->strings, list.data, list.len)});
    upgrade_note(u, first, "the values of 'udim' are listed by 'udimset'");
}

void upgrade_opgraphs(struct upgrade *u)
{
    struct document *doc = u->doc;
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        set_shader_type(u, e);
        if (upgrade_is(u, doc_attr_value(doc, e, STR_type), "opgraphnode")
            && doc_element(doc, e)->parent)
            connect_opgraph_node(u, e);
    }
    u->has_definitions = false;
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        if (is_shader_ref(u, e)) {
            name_definition(u, e);
            bind_graphs(u, e);
        }
    }
    collect_udims(u);
}

/* 1.36 */

/* Binds the inputs of a shader that its material overrides by their public names. */
static void apply_overrides(struct upgrade *u, elem_id shader_ref)
{
    struct document *doc = u->doc;
    elem_id material = doc_element(doc, shader_ref)->parent;
    unsigned left;
    for (elem_id e = first_input(doc, shader_definition(u, shader_ref), &left); e;
         e = next_input(doc, e, &left)) {
        str_id name = upgrade_attr(u, e, "publicname");
        elem_id override = name ? doc_child(doc, material, name) : 0;
        if (override && upgrade_is_category(u, override, "override")
            && !doc_child(doc, shader_ref, doc_element(doc, e)->name))
            doc_set_attr(doc, add_binding(u, shader_ref, e), STR_value,
                         doc_attr_value(doc, override, STR_value));
    }
}

static bool is_in_material(const struct upgrade *u, elem_id element)
{
    elem_id parent = doc_element(u->doc, element)->parent;
    return parent && doc_element(u->doc, parent)->category == STR_material;
}

void upgrade_material_overrides(struct upgrade *u)
{
    u->has_definitions = false;
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e))
        if (is_shader_ref(u, e) && is_in_material(u, e))
            apply_overrides(u, e);
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        if (!is_in_material(u, e) || !upgrade_is_category(u, e, "override"))
            continue;
        doc_remove_element(u->doc, e);
        upgrade_note(u, e, "<override> is now a binding of the shader's input");
    }
}

/*
 * 1.37: removes definitions of former <shader> elements, which repeat the shader's own definition.
 */
void upgrade_legacy_nodedefs(struct upgrade *u)
{
    struct document *doc = u->doc;
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        elem_id nodedef =
            is_shader_ref(u, e) ? find_top_level(u, doc_attr_value(doc, e, STR_nodedef)) : 0;
        if (!nodedef || !upgrade_attr(u, nodedef, "shadertype"))
            continue;
        if (!doc_attr_value(doc, e, STR_node))
            doc_set_attr(doc, e, STR_node, doc_attr_value(doc, nodedef, STR_node));
        doc_remove_attr(doc, e, STR_nodedef);
    }
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        if (doc_element(doc, e)->kind != KIND_NODEDEF || !upgrade_attr(u, e, "shadertype"))
            continue;
        doc_remove_element(doc, e);
        upgrade_note(u, e, "<shader> is gone; the library defines <%s>",
                     str_text(doc->strings, doc_attr_value(doc, e, STR_node)));
    }
}

/* 1.38 */

static void convert_bindings(struct upgrade *u, elem_id shader)
{
    struct document *doc = u->doc;
    for (elem_id e = doc_element(doc, shader)->first_child, next; e; e = next) {
        next = doc_element(doc, e)->next;
        if (upgrade_is_category(u, e, "bindinput") || upgrade_is_category(u, e, "bindparam"))
            doc_set_category(doc, e, STR_input);
        else if (upgrade_is_category(u, e, "bindtoken"))
            doc_set_category(doc, e, STR_token);
        else
            doc_remove_element(doc, e);
    }
}

/* The category of the node for a shaderref. */
static str_id shader_category(struct upgrade *u, elem_id shader_ref, elem_id nodedef)
{
    str_id node = doc_attr_value(u->doc, shader_ref, STR_node);
    if (node || nodedef)
        return nodedef ? doc_attr_value(u->doc, nodedef, STR_node) : node;
    /* By convention, ND_standard_surface_surfaceshader defines standard_surface. */
    const char *name = str_text(u->doc->strings, doc_attr_value(u->doc, shader_ref, STR_nodedef));
    const char *start = strncmp(name, "ND_", 3) == 0 ? name + 3 : name, *end = strrchr(start, '_');
    return str_intern(u->doc->strings, start, end ? (size_t)(end - start) : strlen(start));
}

/*
 * Converts the shaderref to a node before the material. Returns its type, or 0 if it names no
 * shader.
 */
static str_id convert_shader_ref(struct upgrade *u, elem_id shader_ref, elem_id material)
{
    assert(doc_element(u->doc, material)->parent == u->root);
    struct document *doc = u->doc;
    elem_id nodedef = shader_definition(u, shader_ref);
    str_id category = shader_category(u, shader_ref, nodedef),
           type = nodedef ? nodedef_type(doc, nodedef) : STR_EMPTY;
    if (!doc_is_name(str_text(doc->strings, category))) {
        upgrade_note(u, shader_ref, "<shaderref> names no shader, and is left out");
        return 0;
    }
    str_id name = upgrade_free_name(u, u->root, doc_name(doc, shader_ref));
    doc_move_before(doc, shader_ref, material);
    assert(doc_element(doc, shader_ref)->next == material);
    upgrade_set_name(u, shader_ref, name);
    doc_set_category(doc, shader_ref, category);
    doc_remove_attr(doc, shader_ref, STR_node);
    doc_set_attr(doc, shader_ref, STR_type, type ? type : STR_surfaceshader);
    convert_bindings(u, shader_ref);
    upgrade_note(u, shader_ref, "<shaderref> is now the node <%s>",
                 str_text(doc->strings, category));
    return doc_attr_value(doc, shader_ref, STR_type);
}

static void convert_material(struct upgrade *u, elem_id material)
{
    struct document *doc = u->doc;
    bool volume = false;
    elem_id next = doc_element(doc, material)->first_child;
    /* up to the inputs that this loop adds */
    for (elem_id e; (e = next) != 0 && doc_element(doc, e)->kind != KIND_INPUT;) {
        next = doc_element(doc, e)->next;
        str_id type = is_shader_ref(u, e) ? convert_shader_ref(u, e, material) : STR_EMPTY;
        if (!type) {
            doc_remove_element(doc, e);
        } else if (!doc_child(doc, material, type)) {
            elem_id input =
                upgrade_add_input(u, material, str_text(doc->strings, type), type, STR_EMPTY);
            doc_set_attr(doc, input, STR_nodename, doc_element(doc, e)->name);
            volume |= type == STR_volumeshader;
        }
    }
    doc_set_category(doc, material, volume ? STR_volumematerial : STR_surfacematerial);
    doc_set_attr(doc, material, STR_type, STR_material);
    upgrade_note(u, material, "<material> is now the node <%s>",
                 volume ? "volumematerial" : "surfacematerial");
}

/*
 * A material without shaders is of the category of the one that it inherits from:
 * inherited_values.c gives it the inputs.
 */
static void take_category(struct upgrade *u, elem_id heir)
{
    enum { MAX_INHERITANCE = 64 }; /* a longer chain is a cycle */
    struct document *doc = u->doc;
    elem_id from = heir;
    for (int depth = 0; from && depth < MAX_INHERITANCE && !doc_element(doc, from)->first_child;
         depth++)
        from = doc_child(doc, u->root, doc_attr_value(doc, from, STR_inherit));
    if (from && doc_element(doc, from)->category == STR_volumematerial)
        doc_set_category(doc, heir, STR_volumematerial);
}

void upgrade_materials(struct upgrade *u)
{
    struct document *doc = u->doc;
    u->has_definitions = false;
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e))
        if (doc_element(doc, e)->category == STR_material && doc_element(doc, e)->parent == u->root)
            convert_material(u, e);
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e))
        if (doc_element(doc, e)->category == STR_surfacematerial
            && doc_attr_value(doc, e, STR_inherit))
            take_category(u, e);
}
