// SPDX-License-Identifier: Apache-2.0
/*
 * Materials of a USD layer as elements of a document. A UsdShade network becomes a nodegraph for
 * the patterns, and nodes beside it for the shaders. The inputs of the Material are the interface
 * of the nodegraph.
 */
#include "bind/materials.h"
#include "bind/shade_type.h"

#include "base/hash.h"

#include <assert.h>

/* A node that was made; its inputs are read later, so no network is too deep. */
struct made_node {
    usda_prim_id prim;
    elem_id element;
    uint32_t nodedef;
};

/* An output of the nodegraph. */
struct made_output {
    elem_id node;
    str_id port, name;
};

struct maker {
    const struct scene *scene;
    const struct usda_layer *layer;
    struct library *lib;
    struct document *doc;
    struct arena *scratch;
    struct diag_list *diags;
    usda_prim_id material;
    const char *name; /* of the material in the document */
    elem_id graph;    /* 0: not made yet */
    uint16_t file;
    VEC(struct made_node) nodes; /* of the material */
    VEC(struct made_output) outputs;
    VEC(str_id) interface;
    struct table node_table;      /* (prim, material) → 1 + index in `nodes` */
    struct table output_table;    /* (node, port) → the same in `outputs` */
    struct table interface_table; /* (name, material) → the same in `interface` */
    bool is_broken;
};

/* Where a connection ends. */
struct source {
    uint32_t node; /* 1 + index in `nodes`; 0: a value */
    str_id port;
    const struct usda_property *value; /* NULL: nothing */
    bool is_interface;                 /* the value is an input of the Material */
};

static str_id intern(struct maker *m, struct text_word word)
{
    return str_intern(m->doc->strings, word.bytes, word.len);
}

static void set(struct maker *m, elem_id element, const char *name, str_id value)
{
    doc_set_attr(m->doc, element, str_intern_z(m->doc->strings, name), value);
}

static elem_id add(struct maker *m, elem_id parent, const char *category, str_id name,
                   uint32_t line, uint32_t column)
{
    return doc_add_element(m->doc, parent, str_intern_z(m->doc->strings, category), name, m->file,
                           line, (uint16_t)(column < UINT16_MAX ? column : UINT16_MAX));
}

/* ---- Names ---- */

/* Adds an element whose name no other one below the parent has: a number follows one that is taken.
 */
static elem_id add_free(struct maker *m, elem_id parent, const char *category, struct text *name,
                        const struct usda_prim *at)
{
    size_t len = name->len;
    str_id id = str_intern(m->doc->strings, name->data, len);
    for (unsigned suffix = 2;
         doc_child(m->doc, parent, id)
         || (parent == m->doc->root && scene_has_material(m->scene, text_cstr(name)));
         suffix++) {
        name->len = len;
        text_fmt(name, "_%u", suffix);
        id = str_intern(m->doc->strings, name->data, name->len);
    }
    elem_id added = add(m, parent, category, id, at->line, at->column);
    doc_index_element(m->doc, added);
    return added;
}

/* The names from below a prim down to another one, joined by '_'. */
static struct text name_below(struct maker *m, usda_prim_id above, usda_prim_id prim,
                              bool with_above)
{
    const struct usda_prim *prims = m->layer->prims.items;
    usda_prim_id chain[64];
    uint32_t num = 0;
    struct text text;
    for (; prim && prim != above && num < 64; prim = prims[prim].parent)
        chain[num++] = prim;
    text_init(&text, m->scratch);
    if (with_above)
        text_str(&text, m->name);
    while (num) {
        text_str(&text, text.len ? "_" : "");
        text_put(&text, prims[chain[--num]].name);
    }
    return text;
}

/* ---- Values ---- */

static void write_numbers(struct text *text, struct text_word value)
{
    double number;
    for (bool more = false; usda_next_number(&value, &number); more = true) {
        text_str(text, more ? ", " : "");
        if (number >= -16777216 && number <= 16777216 && number == (double)(int32_t)number)
            text_i32(text, (int32_t)number);
        else
            text_float(text, (float)number);
    }
}

/* The value as MaterialX writes it. */
static str_id value_text(struct maker *m, const struct usda_property *property)
{
    struct text_word value = usda_value(property), word = value;
    struct text text;
    text_init(&text, m->scratch);
    if (value.len && strchr("\"'", *value.bytes)) {
        text_put(&text, usda_unquoted(value));
    } else if (value.len && *value.bytes == '@') {
        size_t marks = value.len >= 6 && memcmp(value.bytes, "@@@", 3) == 0 ? 3 : 1;
        text_mem(&text, value.bytes + marks, value.len - 2 * marks);
    } else if (usda_is(property->type, "bool")) {
        text_str(&text, usda_is(word, "1") || usda_is(word, "true") ? "true" : "false");
    } else {
        write_numbers(&text, value);
    }
    return str_intern(m->doc->strings, text.data, text.len);
}

/* ---- Types ---- */

static struct diag_place place_of(const struct maker *m, const struct usda_property *property)
{
    return (struct diag_place){m->layer->file, property->line, property->column, 0};
}

static const char *text_of(struct maker *m, struct text_word word)
{
    return arena_strndup(m->diags->arena, word.bytes, word.len);
}

/*
 * Reports a property whose type is another than the wanted one, or whose value is none of its type.
 * Each place is reported once, however many inputs read it.
 */
static void check_type(struct maker *m, const struct usda_property *property, const char *wanted)
{
    const char *name = text_of(m, property->name), *type = text_of(m, property->type);
    if (!shade_type_agrees(property->type, wanted))
        diag_add(m->diags, DIAG_ID_usda_type, place_of(m, property), name, type, wanted);
    else if (property->value.len && *property->value.bytes != '<' && !shade_value_fits(property))
        diag_add(m->diags, DIAG_ID_usda_value, place_of(m, property), name,
                 text_of(m, usda_value(property)), type);
}

/* ---- Nodes ---- */

/* The definition of a shader; USD's own shaders are nodes of MaterialX, too. */
static uint32_t definition_of(struct maker *m, usda_prim_id prim)
{
    static const char *const own[][2] = {
        {"UsdPreviewSurface", "ND_UsdPreviewSurface_surfaceshader"},
        {"UsdUVTexture", "ND_UsdUVTexture_23"},
        {"UsdTransform2d", "ND_UsdTransform2d"},
        {"UsdPrimvarReader_float", "ND_UsdPrimvarReader_float"},
        {"UsdPrimvarReader_float2", "ND_UsdPrimvarReader_vector2"},
        {"UsdPrimvarReader_float3", "ND_UsdPrimvarReader_vector3"},
        {"UsdPrimvarReader_float4", "ND_UsdPrimvarReader_vector4"},
        {"UsdPrimvarReader_int", "ND_UsdPrimvarReader_integer"}};
    const struct usda_prim *at = &m->layer->prims.items[prim];
    const struct usda_property *id = usda_find_attribute(m->layer, at, "info:id");
    struct text_word rest = id ? id->value : (struct text_word){0}, word = {0};
    if (id)
        usda_next_item(&rest, &word);
    str_id name = intern(m, word);
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        if (usda_is(word, own[i][0]))
            name = str_intern_z(m->doc->strings, own[i][1]);
    uint32_t found = library_nodedef_by_name(m->lib, name);
    if (found != LIBRARY_NONE)
        return found;
    struct diag_place place = {m->layer->file, id ? id->line : at->line,
                               id ? id->column : at->column, 0};
    diag_add(m->diags, DIAG_ID_usda_shader, place,
             arena_strndup(m->diags->arena, at->name.bytes, at->name.len),
             arena_strndup(m->diags->arena, word.bytes, word.len));
    m->is_broken = true;
    return LIBRARY_NONE;
}

static bool is_shader_type(struct maker *m, doc_type type)
{
    const char *name = str_text(m->doc->strings, library_type_name(m->lib, type));
    size_t len = strlen(name);
    return len > 6 && strcmp(name + len - 6, "shader") == 0;
}

/* The outputs of a definition. */
static const struct port *outputs_of(struct maker *m, uint32_t nodedef, uint32_t *out_num)
{
    const struct nodedef *def = library_nodedef(m->lib, nodedef);
    *out_num = def->num_outputs;
    return library_ports(m->lib, nodedef, NULL) + def->num_inputs;
}

static elem_id graph_of(struct maker *m)
{
    if (!m->graph) {
        const struct usda_prim *material = &m->layer->prims.items[m->material];
        struct text name;
        text_init(&name, m->scratch);
        text_str(&name, m->name);
        text_str(&name, "_graph");
        m->graph = add_free(m, m->doc->root, "nodegraph", &name, material);
    }
    return m->graph;
}

/* The node of a Shader prim: 1 + index; makes it on first use. 0: it has no definition. */
static uint32_t node_of(struct maker *m, usda_prim_id prim)
{
    uint32_t hash = hash_pair(prim, m->material);
    for (uint32_t at = hash, found; (found = table_next(&m->node_table, hash, &at));)
        if (found <= m->nodes.len && m->nodes.items[found - 1].prim == prim)
            return found;
    uint32_t nodedef = definition_of(m, prim), num;
    if (nodedef == LIBRARY_NONE)
        return 0;
    const struct usda_prim *at = &m->layer->prims.items[prim];
    const struct port *outputs = outputs_of(m, nodedef, &num);
    bool is_shader = is_shader_type(m, outputs[0].type);
    const char *category = str_text(m->doc->strings, library_nodedef(m->lib, nodedef)->node);
    struct text name = name_below(m, m->material, prim, is_shader);
    elem_id element = add_free(m, is_shader ? m->doc->root : graph_of(m), category, &name, at);
    set(m, element, "type",
        num == 1 ? library_type_name(m->lib, outputs[0].type)
                 : str_intern_z(m->doc->strings, "multioutput"));
    set(m, element, "nodedef", library_nodedef(m->lib, nodedef)->name);
    vec_push(m->scratch, &m->nodes, (struct made_node){prim, element, nodedef});
    table_add(&m->node_table, m->scratch, hash, m->nodes.len);
    return m->nodes.len;
}

/* ---- Connections ---- */

static const struct usda_property *connection_of(struct maker *m, usda_prim_id prim,
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
    const struct port *outputs = outputs_of(m, nodedef, &num);
    str_id port = intern(m, name);
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
    struct source out = {.node = node_of(m, prim)};
    if (!out.node)
        return out;
    if (name.len > prefix)
        out.port = port_of(m, m->nodes.items[out.node - 1].nodedef,
                           (struct text_word){name.bytes + prefix, name.len - prefix});
    if (out.port)
        return out;
    diag_add(m->diags, DIAG_ID_usda_connection, place_of(m, connection),
             text_of(m, connection->name), text_of(m, path));
    return (struct source){0};
}

/* Follows "/M/NG.outputs:x" through the ports of graphs to a shader, or to a value. */
static struct source follow(struct maker *m, const struct usda_property *connection)
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
        connection = connection_of(m, prim, name);
        const char *text = arena_strndup(m->scratch, name.bytes, name.len);
        out.value = usda_find_attribute(m->layer, &m->layer->prims.items[prim], text);
        out.is_interface = prim == m->material;
        if (!prim || (!connection && !out.value))
            diag_add(m->diags, DIAG_ID_usda_connection, place_of(m, before),
                     text_of(m, before->name), text_of(m, path));
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
    const struct port *outputs = outputs_of(m, node->nodedef, &num);
    struct text text;
    text_init(&text, m->scratch);
    text_fmt(&text, "%s_%s", str_text(m->doc->strings, doc_element(m->doc, node->element)->name),
             str_text(m->doc->strings, port));
    str_id name = str_intern(m->doc->strings, text.data, text.len);
    const struct usda_prim *at = &m->layer->prims.items[node->prim];
    elem_id output = add(m, m->graph, "output", name, at->line, at->column);
    for (uint32_t i = 0; i < num; i++)
        if (outputs[i].name == port)
            set(m, output, "type", library_type_name(m->lib, outputs[i].type));
    set(m, output, "nodename", doc_element(m->doc, node->element)->name);
    if (num > 1)
        set(m, output, "output", port);
    vec_push(m->scratch, &m->outputs, (struct made_output){node->element, port, name});
    table_add(&m->output_table, m->scratch, hash, m->outputs.len);
    return name;
}

static void connect(struct maker *m, elem_id input, elem_id user, const struct source *from)
{
    const struct made_node *node = &m->nodes.items[from->node - 1];
    bool is_inside = doc_element(m->doc, user)->parent == m->graph;
    uint32_t num;
    outputs_of(m, node->nodedef, &num);
    if (doc_element(m->doc, node->element)->parent == m->doc->root || is_inside) {
        set(m, input, "nodename", doc_element(m->doc, node->element)->name);
        if (num > 1)
            set(m, input, "output", from->port);
        return;
    }
    set(m, input, "nodegraph", doc_element(m->doc, m->graph)->name);
    set(m, input, "output", output_of(m, node, from->port));
}

/* The input of the nodegraph for an input of the Material. */
static void add_interface(struct maker *m, str_id name, str_id type,
                          const struct usda_property *property)
{
    uint32_t hash = hash_pair(name, m->material);
    for (uint32_t at = hash, found; (found = table_next(&m->interface_table, hash, &at));)
        if (found <= m->interface.len && m->interface.items[found - 1] == name)
            return;
    vec_push(m->scratch, &m->interface, name);
    table_add(&m->interface_table, m->scratch, hash, m->interface.len);
    elem_id input = add(m, graph_of(m), "input", name, property->line, property->column);
    set(m, input, "type", type);
    set(m, input, "value", value_text(m, property));
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
        str_id name = intern(m, (struct text_word){property->name.bytes + strlen(prefix),
                                                   property->name.len - strlen(prefix)});
        str_id type = doc_attr_value(m->doc, input, str_intern_z(m->doc->strings, "type"));
        add_interface(m, name, type, property);
        set(m, input, "interfacename", name);
        return;
    }
    set(m, input, "value", value_text(m, property));
    if (property->color_space.len)
        set(m, input, "colorspace", intern(m, property->color_space));
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
        diag_add(m->diags, DIAG_ID_usda_type, place_of(m, property), text_of(m, property->name),
                 text_of(m, property->type), "a type of MaterialX");
    return type ? str_intern_z(m->doc->strings, type) : 0;
}

/* Reads one property of a shader, "inputs:bg" or "inputs:bg.connect". */
static void read_input(struct maker *m, const struct made_node *node,
                       const struct usda_property *property)
{
    static const char prefix[] = "inputs:", connect_end[] = ".connect";
    struct text_word name = property->name;
    if (name.len <= strlen(prefix) || memcmp(name.bytes, prefix, strlen(prefix)) != 0)
        return;
    bool is_connection =
        name.len > strlen(connect_end)
        && memcmp(name.bytes + name.len - strlen(connect_end), connect_end, strlen(connect_end))
               == 0;
    if (!is_connection && connection_of(m, node->prim, name))
        return; /* the connection wins */
    name.bytes += strlen(prefix);
    name.len -= strlen(prefix) + (is_connection ? strlen(connect_end) : 0);
    str_id input_name = intern(m, name), type = input_type(m, node, input_name, property);
    struct source from = is_connection ? follow(m, property) : (struct source){.value = property};
    if (!type)
        return;
    check_type(m, property, str_text(m->doc->strings, type));
    if (from.value && from.value != property)
        check_type(m, from.value, str_text(m->doc->strings, type));
    if (!from.node && !from.value)
        return;
    elem_id input = add(m, node->element, "input", input_name, property->line, property->column);
    set(m, input, "type", type);
    if (from.node)
        connect(m, input, node->element, &from);
    else
        set_value(m, input, node->element, &from);
}

/* ---- Materials ---- */

/* Adds the shader of a product to the material; true if it has one. */
static bool add_product(struct maker *m, elem_id material, const char *const *outputs,
                        const char *product)
{
    const struct usda_prim *prim = &m->layer->prims.items[m->material];
    for (; *outputs; outputs++) {
        const struct usda_property *connection =
            connection_of(m, m->material, (struct text_word){*outputs, strlen(*outputs)});
        if (!connection)
            continue;
        struct source from = follow(m, connection);
        if (!from.node)
            return false;
        elem_id input = add(m, material, "input", str_intern_z(m->doc->strings, product),
                            prim->line, prim->column);
        set(m, input, "type", str_intern_z(m->doc->strings, product));
        connect(m, input, material, &from);
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
        for (uint32_t k = prim->first_property; k < usda_end_property(prim); k++)
            read_input(m, &node, &properties[k]);
    }
}

static void begin(struct maker *m, const struct scene_material *material)
{
    m->material = material->prim;
    m->name = material->name;
    m->graph = 0;
    m->is_broken = false;
    m->nodes.len = m->outputs.len = m->interface.len = 0;
}

static void add_material(struct maker *m, const struct scene_material *from)
{
    static const char *const surfaces[] = {"outputs:mtlx:surface", "outputs:surface", NULL};
    static const char *const displacements[] = {"outputs:mtlx:displacement", "outputs:displacement",
                                                NULL};
    const struct usda_prim *at = &m->layer->prims.items[from->prim];
    begin(m, from);
    elem_id material = add(m, m->doc->root, "surfacematerial",
                           str_intern_z(m->doc->strings, from->name), at->line, at->column);
    set(m, material, "type", str_intern_z(m->doc->strings, "material"));
    doc_index_element(m->doc, material);
    add_product(m, material, surfaces, "surfaceshader");
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
    elem_id node = add(m, m->graph, "constant", name, value->line, value->column);
    elem_id input =
        add(m, node, "input", str_intern_z(m->doc->strings, "value"), value->line, value->column);
    set(m, node, "type", type);
    set(m, input, "type", type);
    set(m, input, "value", value_text(m, value));
    if (value->color_space.len)
        set(m, input, "colorspace", intern(m, value->color_space));
    return name;
}

static void add_override_output(struct maker *m, const struct usda_property *property)
{
    struct text_word name = override_name(property);
    const char *type_name = shade_type(property->type);
    if (name.len && !type_name)
        diag_add(m->diags, DIAG_ID_usda_type, place_of(m, property), text_of(m, property->name),
                 text_of(m, property->type), "a type of MaterialX");
    if (!name.len || !type_name || doc_child(m->doc, m->graph, intern(m, name)))
        return;
    struct text_word own = {property->name.bytes, strlen("outputs:") + name.len};
    const struct usda_property *connection = connection_of(m, m->material, own);
    struct source from = connection ? follow(m, connection) : (struct source){.value = property};
    if (from.value)
        check_type(m, from.value, type_name);
    if (!from.node && (!from.value || !usda_value(from.value).len))
        return;
    str_id type = str_intern_z(m->doc->strings, type_name);
    str_id constant = from.node ? 0 : add_constant(m, name, type, from.value);
    elem_id output = add(m, m->graph, "output", intern(m, name), property->line, property->column);
    set(m, output, "type", type);
    if (from.node)
        connect(m, output, output, &from);
    else
        set(m, output, "nodename", constant);
    doc_index_element(m->doc, output);
}

/* A Material without terminals, or a NodeGraph, as a nodegraph of its name. */
static void add_override(struct maker *m, const struct scene_material *from)
{
    const struct usda_prim *at = &m->layer->prims.items[from->prim];
    const struct usda_property *properties = m->layer->properties.items;
    begin(m, from);
    m->graph = add(m, m->doc->root, "nodegraph", str_intern_z(m->doc->strings, from->name),
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

/* The materials of overrides that the scene binds. */
static struct table bound_overrides(const struct scene *scene, struct arena *scratch)
{
    struct table table = {0};
    for (uint32_t i = 0; i < scene->bindings.len; i++) {
        const struct scene_binding *binding = &scene->bindings.items[i];
        const char *name = binding->material;
        if (!binding->is_removed && strstr(binding->name, "::") && !is_bound(scene, &table, name))
            table_add(&table, scratch, hash_bytes(name, strlen(name)), i + 1);
    }
    return table;
}

/* ---- All prims ---- */

/* True if the document that takes the materials has an element of this name. */
static bool has_element(struct maker *m, struct text_word name)
{
    elem_id found = doc_child(m->doc, m->doc->root, intern(m, name));
    return found && doc_element(m->doc, found)->file != m->file;
}

/* True if the document has an element of the material's name, or of its prim's. */
static bool is_replaced(struct maker *m, const struct scene_material *material)
{
    return has_element(m, (struct text_word){material->name, strlen(material->name)})
           || has_element(m, m->layer->prims.items[material->prim].name);
}

void bind_add_materials(const struct scene *scene, struct library *lib, struct arena *scratch,
                        struct diag_list *diags)
{
    struct maker m = {.scene = scene,
                      .layer = &scene->layer,
                      .lib = lib,
                      .doc = &lib->doc,
                      .scratch = scratch,
                      .diags = diags};
    const struct table bound = bound_overrides(scene, scratch);
    for (uint32_t i = 0; i < scene->materials.len; i++) {
        const struct scene_material *material = &scene->materials.items[i];
        if (material->is_graph && !is_bound(scene, &bound, material->name))
            continue;
        if (!m.file)
            m.file = doc_add_file(m.doc, str_intern_z(m.doc->strings, scene->layer.file));
        if (is_replaced(&m, material))
            continue;
        if (material->is_graph || is_override(&m, &m.layer->prims.items[material->prim]))
            add_override(&m, material);
        else
            add_material(&m, material);
    }
}
