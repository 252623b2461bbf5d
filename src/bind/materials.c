// SPDX-License-Identifier: Apache-2.0
/*
 * Materials of a USD layer as elements of a document. A UsdShade network becomes a nodegraph for
 * the patterns, and nodes beside it for the shaders. The inputs of the Material are the interface
 * of the nodegraph.
 */
#include "bind/network_maker.h"
#include "bind/shade_type.h"

#include "base/hash.h"

/* ---- Connections ---- */

const struct usda_property *maker_connection(struct maker *m, usda_prim_id prim,
                                             struct text_word name)
{
    struct text text;
    text_init(&text, m->scratch);
    text_put(&text, name);
    text_str(&text, ".connect");
    return usda_find_property(m->layer, &m->layer->prims.items[prim], text_cstr(&text));
}

/*
 * The port of a definition that USD names; 0: there is none. The only one may have another name:
 * UsdPreviewSurface has "surface" in the place of "out".
 */
static str_id port_of(struct maker *m, uint32_t nodedef, struct text_word name)
{
    uint32_t num;
    const struct port *outputs = maker_outputs(m, nodedef, &num);
    str_id port = maker_intern(m, name);
    for (uint32_t i = 0; i < num; i++)
        if (outputs[i].name == port)
            return port;
    return num == 1 ? outputs[0].name : 0;
}

/* The end of a connection at an output of a Shader prim. A shader without definition was told. */
static struct source end_at(struct maker *m, usda_prim_id prim, struct text_word name,
                            const struct usda_property *connection, struct text_word path)
{
    const size_t prefix = strlen("outputs:");
    struct source out = {.node = maker_node(m, prim)};
    if (!out.node)
        return out;
    const struct made_node *node = &m->nodes.items[out.node - 1];
    struct text_word port = {name.bytes + prefix, name.len > prefix ? name.len - prefix : 0};
    if (port.len && node->preview && preview_is_texture(node->preview))
        out = usd_texture_output(m, out.node, port);
    else if (port.len)
        out.port = port_of(m, node->nodedef, port);
    if (out.port)
        return out;
    diag_add(m->diags, DIAG_ID_usda_connection, maker_place(m, connection),
             maker_text(m, connection->name), maker_text(m, path));
    return (struct source){0};
}

struct source maker_follow(struct maker *m, const struct usda_property *connection)
{
    enum { MAX_HOPS = 64 };
    struct source out = {0};
    for (unsigned hop = 0; connection && hop < MAX_HOPS; hop++) {
        struct text_word rest = connection->value, path;
        if (!usda_next_item(&rest, &path) || usda_is(path, "None"))
            return out;
        const char *dot = memchr(path.bytes, '.', path.len);
        size_t len = dot ? (size_t)(dot - path.bytes) : path.len;
        usda_prim_id prim = usda_find(m->layer, path.bytes, len);
        struct text_word name = {dot ? dot + 1 : path.bytes, dot ? path.len - len - 1 : 0};
        const struct usda_property *before = connection;
        if (prim && dot && usda_is(m->layer->prims.items[prim].type, "Shader"))
            return end_at(m, prim, name, connection, path);
        connection = maker_connection(m, prim, name);
        const char *text = arena_strndup(m->scratch, name.bytes, name.len);
        out.value = usda_find_attribute(m->layer, &m->layer->prims.items[prim], text);
        out.is_interface = prim == m->material;
        if (!prim || (!connection && !out.value))
            diag_add(m->diags, DIAG_ID_usda_connection, maker_place(m, before),
                     maker_text(m, before->name), maker_text(m, path));
    }
    return out;
}

/* The output of the nodegraph for a port of its node. */
static str_id output_of(struct maker *m, const struct made_node *node, str_id port)
{
    uint32_t num, hash = hash_pair(node->element, port);
    for (uint32_t at = hash, found; (found = table_next(&m->output_table, hash, &at));)
        if (found <= m->outputs.len && m->outputs.items[found - 1].node == node->element
            && m->outputs.items[found - 1].port == port)
            return m->outputs.items[found - 1].name;
    const struct port *outputs = maker_outputs(m, node->nodedef, &num);
    struct text text;
    text_init(&text, m->scratch);
    text_fmt(&text, "%s_%s", doc_name(m->doc, node->element), str_text(m->doc->strings, port));
    str_id name = str_intern(m->doc->strings, text.data, text.len);
    const struct usda_prim *at = &m->layer->prims.items[node->prim];
    elem_id output = maker_add(m, m->graph, "output", name, at->line, at->column);
    for (uint32_t i = 0; i < num; i++)
        if (outputs[i].name == port)
            maker_set(m, output, "type", library_type_name(m->lib, outputs[i].type));
    maker_set(m, output, "nodename", doc_element(m->doc, node->element)->name);
    if (num > 1)
        maker_set(m, output, "output", port);
    vec_push(m->scratch, &m->outputs, (struct made_output){node->element, port, name});
    table_add(&m->output_table, m->scratch, hash, m->outputs.len);
    return name;
}

static str_id port_type(struct maker *m, const struct source *from)
{
    uint32_t num;
    const struct port *outputs = maker_outputs(m, m->nodes.items[from->node - 1].nodedef, &num);
    while (num && outputs[num - 1].name != from->port)
        num--;
    return num ? library_type_name(m->lib, outputs[num - 1].type) : 0;
}

/* The definition between two types that are one of USD; NULL: they are not. */
static const char *conversion_of(const char *from, const char *to)
{
    static const char *const rows[][3] = {{"color3", "vector3", "ND_convert_color3_vector3"},
                                          {"vector3", "color3", "ND_convert_vector3_color3"},
                                          {"color4", "vector4", "ND_convert_color4_vector4"},
                                          {"vector4", "color4", "ND_convert_vector4_color4"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (strcmp(from, rows[i][0]) == 0 && strcmp(to, rows[i][1]) == 0)
            return rows[i][2];
    return NULL;
}

/* Connects an input of another type to a node that converts, where USD needs none. */
static struct source converted(struct maker *m, const struct source *from, str_id wanted)
{
    str_id type = port_type(m, from);
    const char *to = str_text(m->doc->strings, wanted);
    const char *nodedef = type ? conversion_of(str_text(m->doc->strings, type), to) : NULL;
    return nodedef ? maker_add_after(m, from, nodedef, "in", to) : *from;
}

void maker_connect(struct maker *m, elem_id input, elem_id user, const struct source *to)
{
    str_id wanted = doc_attr_value(m->doc, input, STR_type);
    const struct source source = converted(m, to, wanted), *from = &source;
    const struct made_node *node = &m->nodes.items[from->node - 1];
    bool is_inside = doc_element(m->doc, user)->parent == m->graph;
    uint32_t num;
    maker_outputs(m, node->nodedef, &num);
    if (doc_element(m->doc, node->element)->parent == m->doc->root || is_inside) {
        maker_set(m, input, "nodename", doc_element(m->doc, node->element)->name);
        if (num > 1)
            maker_set(m, input, "output", from->port);
        return;
    }
    maker_set(m, input, "nodegraph", doc_element(m->doc, m->graph)->name);
    maker_set(m, input, "output", output_of(m, node, from->port));
}

/*
 * The input of the nodegraph for an input of the Material; false: it has another type, because one
 * type of USD is several of MaterialX.
 */
static bool add_interface(struct maker *m, str_id name, str_id type,
                          const struct usda_property *property)
{
    uint32_t hash = hash_pair(name, m->material);
    for (uint32_t at = hash, found; (found = table_next(&m->interface_table, hash, &at));)
        if (found <= m->interface.len && m->interface.items[found - 1].name == name)
            return m->interface.items[found - 1].type == type;
    vec_push(m->scratch, &m->interface, (struct made_input){name, type});
    table_add(&m->interface_table, m->scratch, hash, m->interface.len);
    elem_id input = maker_add(m, maker_graph(m), "input", name, property->line, property->column);
    maker_set(m, input, "type", type);
    maker_set(m, input, "value", maker_value(m, property));
    return true;
}

/* Sets an input of a node to a value. */
static void set_value(struct maker *m, elem_id input, elem_id user, const struct source *from)
{
    static const char prefix[] = "inputs:";
    const struct usda_property *property = from->value;
    if (!property->value.len && !usda_value(property).len)
        return;
    bool is_inside = doc_element(m->doc, user)->parent == m->graph;
    if (from->is_interface && is_inside && property->name.len > strlen(prefix)) {
        str_id name = maker_intern(m, (struct text_word){property->name.bytes + strlen(prefix),
                                                         property->name.len - strlen(prefix)});
        if (add_interface(m, name, doc_attr_value(m->doc, input, STR_type), property)) {
            maker_set(m, input, "interfacename", name);
            return;
        }
    }
    maker_set(m, input, "value", maker_value(m, property));
    if (property->color_space.len)
        maker_set(m, input, "colorspace", maker_intern(m, property->color_space));
}

/* The type of an input: that of the definition, or USD's; 0 after a diagnostic. */
static str_id input_type(struct maker *m, const struct made_node *node, str_id name,
                         const struct usda_property *property)
{
    int found = library_find_input(m->lib, node->nodedef, name);
    if (found >= 0)
        return library_type_name(m->lib, library_ports(m->lib, node->nodedef, NULL)[found].type);
    const char *type = shade_type(property->type);
    if (!type)
        diag_add(m->diags, DIAG_ID_usda_type, maker_place(m, property),
                 maker_text(m, property->name), maker_text(m, property->type),
                 "a type of MaterialX");
    return type ? str_intern_z(m->doc->strings, type) : 0;
}

/* ---- Inputs ---- */

static void add_input(struct maker *m, const struct made_node *node,
                      const struct usda_property *property, str_id name, str_id type,
                      const struct source *from)
{
    elem_id input = maker_add(m, node->element, "input", name, property->line, property->column);
    maker_set(m, input, "type", type);
    if (from->node) {
        maker_connect(m, input, node->element, from);
        return;
    }
    set_value(m, input, node->element, from);
    if (node->preview && preview_is_texture(node->preview) && type == STR_filename)
        usd_set_color_space(m, node, input, from->value);
}

/* The name of an input that a property has or connects, "bg"; len 0: it is no input. */
static struct text_word input_name(const struct usda_property *property, bool *out_is_connection)
{
    static const char prefix[] = "inputs:", connect_end[] = ".connect";
    const size_t begin = strlen(prefix), end = strlen(connect_end);
    struct text_word name = property->name;
    *out_is_connection = false;
    if (name.len <= begin || memcmp(name.bytes, prefix, begin) != 0)
        return (struct text_word){0};
    *out_is_connection =
        name.len > end && memcmp(name.bytes + name.len - end, connect_end, end) == 0;
    return (struct text_word){name.bytes + begin,
                              name.len - begin - (*out_is_connection ? end : 0)};
}

void maker_read_input(struct maker *m, const struct made_node *node,
                      const struct usda_property *property, str_id name)
{
    bool is_connection;
    input_name(property, &is_connection);
    str_id type = input_type(m, node, name, property);
    struct source from =
        is_connection ? maker_follow(m, property) : (struct source){.value = property};
    if (!type)
        return;
    if (!from.node) /* of a connection to a node, the types of its ends count */
        maker_check_type(m, property, str_text(m->doc->strings, type));
    if (from.value && from.value != property)
        maker_check_type(m, from.value, str_text(m->doc->strings, type));
    if (from.node || from.value)
        add_input(m, node, property, name, type, &from);
}

/* Reads one property of a shader, "inputs:bg" or "inputs:bg.connect". */
static void read_property(struct maker *m, const struct made_node *node,
                          const struct usda_property *property)
{
    bool is_connection;
    struct text_word name = input_name(property, &is_connection);
    if (!name.len)
        return;
    if (!is_connection && maker_connection(m, node->prim, property->name))
        return; /* the connection wins */
    str_id own = usd_input(m, node, name);
    if (own)
        maker_read_input(m, node, property, own);
}

/* ---- Materials ---- */

/* Adds the shader of a product to the material; true if it has one. */
static bool add_product(struct maker *m, elem_id material, const char *const *outputs,
                        const char *product)
{
    const struct usda_prim *prim = &m->layer->prims.items[m->material];
    for (; *outputs; outputs++) {
        const struct usda_property *connection =
            maker_connection(m, m->material, (struct text_word){*outputs, strlen(*outputs)});
        if (!connection)
            continue;
        struct source from = maker_follow(m, connection);
        if (!from.node)
            return false;
        const struct made_node node = m->nodes.items[from.node - 1];
        if (node.preview && strcmp(product, "displacementshader") == 0)
            from = usd_displacement(m, &node);
        if (!from.node)
            return false;
        elem_id input = maker_add(m, material, "input", str_intern_z(m->doc->strings, product),
                                  prim->line, prim->column);
        maker_set(m, input, "type", str_intern_z(m->doc->strings, product));
        maker_connect(m, input, material, &from);
        return true;
    }
    return false;
}

/* Makes the inputs of all nodes, which makes more nodes. */
static void read_inputs(struct maker *m)
{
    const struct usda_property *properties = m->layer->properties.items;
    for (uint32_t i = 0; i < m->nodes.len; i++) { /* grows while it is read */
        struct made_node node = m->nodes.items[i];
        const struct usda_prim *prim = &m->layer->prims.items[node.prim];
        if (node.is_made)
            continue;
        usd_add_values(m, &node);
        for (uint32_t k = prim->first_property; k < usda_end_property(prim); k++)
            read_property(m, &node, &properties[k]);
    }
}

static void begin(struct maker *m, const struct scene_material *material)
{
    m->material = material->prim;
    m->name = material->name;
    m->graph = 0;
    m->nodes.len = m->outputs.len = m->interface.len = 0;
}

/* The outputs of a Material that other renderers read: "outputs:arnold:surface". */
static const char *foreign_outputs(struct maker *m)
{
    const struct usda_prim *prim = &m->layer->prims.items[m->material];
    struct text list;
    text_init(&list, m->diags->arena);
    for (uint32_t i = prim->first_property; i < usda_end_property(prim); i++) {
        struct text_word name = m->layer->properties.items[i].name;
        const size_t end = strlen(".connect");
        if (name.len > end && memcmp(name.bytes + name.len - end, ".connect", end) == 0)
            name.len -= end;
        if (name.len > 8 && memcmp(name.bytes, "outputs:", 8) == 0) {
            text_str(&list, list.len ? ", " : " (it has ");
            text_put(&list, name);
        }
    }
    text_str(&list, list.len ? ")" : "");
    return text_cstr(&list);
}

/* The default substance (docs/slots.md) for a Material without a surface. */
static void add_default(struct maker *m, elem_id material)
{
    const struct usda_prim *at = &m->layer->prims.items[m->material];
    const struct {
        const char *category, *type, *input, *input_type, *value;
    } steps[] = {{"oren_nayar_diffuse_bsdf", "BSDF", "color", "color3", "0.8, 0.8, 0.8"},
                 {"surface", "surfaceshader", "bsdf", "BSDF", NULL}};
    str_id before = 0;
    elem_id input;
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        struct text name;
        text_init(&name, m->scratch);
        text_fmt(&name, "%s_%s", m->name, steps[i].category);
        elem_id node = maker_add_free(m, m->doc->root, steps[i].category, &name, at);
        maker_set(m, node, "type", str_intern_z(m->doc->strings, steps[i].type));
        input = maker_add(m, node, "input", str_intern_z(m->doc->strings, steps[i].input), at->line,
                          at->column);
        maker_set(m, input, "type", str_intern_z(m->doc->strings, steps[i].input_type));
        maker_set(m, input, before ? "nodename" : "value",
                  before ? before : str_intern_z(m->doc->strings, steps[i].value));
        before = doc_element(m->doc, node)->name;
    }
    input = maker_add(m, material, "input", STR_surfaceshader, at->line, at->column);
    maker_set(m, input, "type", STR_surfaceshader);
    maker_set(m, input, "nodename", before);
}

static void add_material(struct maker *m, const struct scene_material *from, bool is_bound)
{
    static const char *const surfaces[] = {"outputs:mtlx:surface", "outputs:surface", NULL};
    static const char *const displacements[] = {"outputs:mtlx:displacement", "outputs:displacement",
                                                NULL};
    const struct usda_prim *at = &m->layer->prims.items[from->prim];
    begin(m, from);
    elem_id material = maker_add(m, m->doc->root, "surfacematerial",
                                 str_intern_z(m->doc->strings, from->name), at->line, at->column);
    maker_set(m, material, "type", str_intern_z(m->doc->strings, "material"));
    doc_index_element(m->doc, material);
    if (!add_product(m, material, surfaces, "surfaceshader")) {
        if (is_bound)
            diag_add(m->diags, DIAG_ID_usda_material,
                     (struct diag_place){m->layer->file, at->line, at->column, 0},
                     maker_text(m, at->name), foreign_outputs(m));
        add_default(m, material);
    }
    add_product(m, material, displacements, "displacementshader");
    read_inputs(m);
}

/* ---- Overrides ---- */

/* Returns what a property says as an output: its name; len 0: it is no output, or a terminal. */
static struct text_word override_name(const struct usda_property *property)
{
    static const char prefix[] = "outputs:", connect_end[] = ".connect";
    static const char *const terminals[] = {"surface", "displacement", "volume"};
    struct text_word name = property->name, none = {0};
    size_t len = strlen(prefix), end = strlen(connect_end);
    if (name.len <= len || memcmp(name.bytes, prefix, len) != 0)
        return none;
    name = (struct text_word){name.bytes + len, name.len - len};
    if (name.len > end && memcmp(name.bytes + name.len - end, connect_end, end) == 0)
        name.len -= end;
    /* terminals may have a render context in front, "outputs:mtlx:surface" */
    if (memchr(name.bytes, ':', name.len))
        return none;
    for (size_t i = 0; i < sizeof terminals / sizeof *terminals; i++)
        if (usda_is(name, terminals[i]))
            return none;
    return name;
}

/* True if a Material is an override: it has outputs, and no terminal is among them. */
static bool is_override(const struct maker *m, const struct usda_prim *prim)
{
    static const char prefix[] = "outputs:";
    const struct usda_property *properties = m->layer->properties.items;
    bool found = false;
    for (uint32_t i = prim->first_property; i < usda_end_property(prim); i++) {
        struct text_word name = properties[i].name;
        bool is_output = name.len > strlen(prefix) && !memcmp(name.bytes, prefix, strlen(prefix));
        if (is_output && !override_name(&properties[i]).len)
            return false;
        found = found || is_output;
    }
    return found;
}

/* The node of a value that an output has. */
static str_id add_constant(struct maker *m, struct text_word output, str_id type,
                           const struct usda_property *value)
{
    struct text text;
    text_init(&text, m->scratch);
    text_put(&text, output);
    text_str(&text, "_value");
    str_id name = str_intern(m->doc->strings, text.data, text.len);
    elem_id node = maker_add(m, m->graph, "constant", name, value->line, value->column);
    elem_id input = maker_add(m, node, "input", str_intern_z(m->doc->strings, "value"), value->line,
                              value->column);
    maker_set(m, node, "type", type);
    maker_set(m, input, "type", type);
    maker_set(m, input, "value", maker_value(m, value));
    if (value->color_space.len)
        maker_set(m, input, "colorspace", maker_intern(m, value->color_space));
    return name;
}

static void add_override_output(struct maker *m, const struct usda_property *property)
{
    struct text_word name = override_name(property);
    const char *type_name = shade_type(property->type);
    if (name.len && !type_name)
        diag_add(m->diags, DIAG_ID_usda_type, maker_place(m, property),
                 maker_text(m, property->name), maker_text(m, property->type),
                 "a type of MaterialX");
    if (!name.len || !type_name || doc_child(m->doc, m->graph, maker_intern(m, name)))
        return;
    struct text_word own = {property->name.bytes, strlen("outputs:") + name.len};
    const struct usda_property *connection = maker_connection(m, m->material, own);
    struct source from =
        connection ? maker_follow(m, connection) : (struct source){.value = property};
    if (from.value)
        maker_check_type(m, from.value, type_name);
    if (!from.node && (!from.value || !usda_value(from.value).len))
        return;
    str_id type = str_intern_z(m->doc->strings, type_name);
    str_id constant = from.node ? 0 : add_constant(m, name, type, from.value);
    elem_id output =
        maker_add(m, m->graph, "output", maker_intern(m, name), property->line, property->column);
    maker_set(m, output, "type", type);
    if (from.node)
        maker_connect(m, output, output, &from);
    else
        maker_set(m, output, "nodename", constant);
    doc_index_element(m->doc, output);
}

/* A Material without terminals, or a NodeGraph, as a nodegraph of its name. */
static void add_override(struct maker *m, const struct scene_material *from)
{
    const struct usda_prim *at = &m->layer->prims.items[from->prim];
    const struct usda_property *properties = m->layer->properties.items;
    begin(m, from);
    m->graph = maker_add(m, m->doc->root, "nodegraph", str_intern_z(m->doc->strings, from->name),
                         at->line, at->column);
    doc_index_element(m->doc, m->graph);
    for (uint32_t i = at->first_property; i < usda_end_property(at); i++)
        add_override_output(m, &properties[i]);
    read_inputs(m);
}

static bool is_bound(const struct scene *scene, const struct table *bound, const char *name)
{
    uint32_t hash = hash_bytes(name, strlen(name));
    for (uint32_t at = hash, found; (found = table_next(bound, hash, &at));)
        if (strcmp(name, scene->bindings.items[found - 1].material) == 0)
            return true;
    return false;
}

/* The materials that the scene binds, or only those of overrides. */
static struct table bound_names(const struct scene *scene, bool only_overrides,
                                struct arena *scratch)
{
    struct table table = {0};
    for (uint32_t i = 0; i < scene->bindings.len; i++) {
        const struct scene_binding *binding = &scene->bindings.items[i];
        const char *name = binding->material;
        bool counts = !only_overrides || strstr(binding->name, "::");
        if (!binding->is_removed && counts && !is_bound(scene, &table, name))
            table_add(&table, scratch, hash_bytes(name, strlen(name)), i + 1);
    }
    return table;
}

/* ---- All prims ---- */

/* True if the document that takes the materials has an element of this name. */
static bool has_element(struct maker *m, struct text_word name)
{
    elem_id found = doc_child(m->doc, m->doc->root, maker_intern(m, name));
    return found && doc_element(m->doc, found)->file != m->file;
}

/* True if the document has an element of the material's name, or of its prim's. */
static bool is_replaced(struct maker *m, const struct scene_material *material)
{
    return has_element(m, (struct text_word){material->name, strlen(material->name)})
           || has_element(m, m->layer->prims.items[material->prim].name);
}

void bind_add_materials(const struct scene *scene, struct library *lib,
                        const struct bind_images *images, struct arena *scratch,
                        struct diag_list *diags)
{
    struct maker m = {.scene = scene,
                      .layer = &scene->layer,
                      .lib = lib,
                      .doc = &lib->doc,
                      .images = images,
                      .scratch = scratch,
                      .diags = diags};
    const struct table bound = bound_names(scene, false, scratch),
                       overrides = bound_names(scene, true, scratch);
    for (uint32_t i = 0; i < scene->materials.len; i++) {
        const struct scene_material *material = &scene->materials.items[i];
        if (material->is_graph && !is_bound(scene, &overrides, material->name))
            continue;
        if (!m.file)
            m.file = doc_add_file(m.doc, str_intern_z(m.doc->strings, scene->layer.file));
        if (is_replaced(&m, material))
            continue;
        if (material->is_graph || is_override(&m, &m.layer->prims.items[material->prim]))
            add_override(&m, material);
        else
            add_material(&m, material, is_bound(scene, &bound, material->name));
    }
}
