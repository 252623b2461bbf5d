// SPDX-License-Identifier: Apache-2.0
/*
 * USD's own shaders are nodes of MaterialX, but have more: tokens, defaults, the colour space and
 * the arithmetic of textures, and displacement. preview.c has the tables.
 */
#include "bind/network_maker.h"

/* ---- Tokens ---- */

/* The property of an input: "inputs:st". */
static const char *property_name(struct maker *m, const char *input)
{
    struct text text;
    text_init(&text, m->scratch);
    text_fmt(&text, "inputs:%s", input);
    return text_cstr(&text);
}

/* The connection of an input; NULL: it has none. */
static const struct usda_property *connection_of(struct maker *m, usda_prim_id prim,
                                                 const char *name)
{
    const char *property = property_name(m, name);
    return maker_connection(m, prim, (struct text_word){property, strlen(property)});
}

/* The property with the value of an input itself; NULL: it has none. */
static const struct usda_property *own_value(struct maker *m, usda_prim_id prim, const char *name)
{
    return usda_find_attribute(m->layer, &m->layer->prims.items[prim], property_name(m, name));
}

/* The property that gives an input its value or connection; NULL: none. */
static const struct usda_property *given(struct maker *m, usda_prim_id prim, const char *name)
{
    const struct usda_property *connection = connection_of(m, prim, name);
    return connection ? connection : own_value(m, prim, name);
}

/* The value of an input, also through its connection; NULL: it has none. */
static const struct usda_property *value_of(struct maker *m, usda_prim_id prim, const char *name)
{
    const struct usda_property *connection = connection_of(m, prim, name);
    return connection ? maker_follow(m, connection).value : own_value(m, prim, name);
}

/* The token that a property has; len 0: it has none. */
static struct text_word token_of(const struct usda_property *property)
{
    struct text_word value = property ? usda_value(property) : (struct text_word){0};
    return value.len && strchr("\"'", *value.bytes) ? usda_unquoted(value) : (struct text_word){0};
}

/* The word of MaterialX for the token of an input; NULL: it has none. Reports an unknown token. */
static const char *word_of(struct maker *m, const struct made_node *node, const char *name)
{
    const struct usda_property *property = value_of(m, node->prim, name);
    struct text_word token = token_of(property);
    const struct preview_token *row = NULL;
    struct text known;
    text_init(&known, m->diags->arena);
    while (token.len && (row = preview_next_token(name, row))) {
        if (usda_is(token, row->token))
            return row->word;
        text_fmt(&known, "%s%s", known.len ? ", " : "", row->token);
    }
    if (token.len)
        diag_add(m->diags, DIAG_ID_usda_token, maker_place(m, property),
                 maker_text(m, property->name), maker_text(m, token), text_cstr(&known));
    return NULL;
}

/* ---- Inputs ---- */

/* True if the input has a value, or none, and the value is a node of its own. */
static bool is_constant(struct maker *m, const struct made_node *node,
                        const struct preview_input *row)
{
    const struct usda_property *connection =
        row->constant ? connection_of(m, node->prim, row->input) : NULL;
    return row->constant && !(connection && maker_follow(m, connection).node);
}

str_id usd_input(struct maker *m, const struct made_node *node, struct text_word name)
{
    const struct preview_input *row =
        node->preview ? preview_find_input(node->preview, name) : NULL;
    if (!row)
        return maker_intern(m, name);
    /* a value of older files, which is no token, is one of MaterialX */
    bool is_word = row->has_tokens && token_of(value_of(m, node->prim, row->input)).len;
    return row->name && !is_word && !is_constant(m, node, row)
               ? str_intern_z(m->doc->strings, row->name)
               : 0;
}

static void add_value(struct maker *m, const struct made_node *node, const char *name,
                      const char *value)
{
    const struct usda_prim *at = &m->layer->prims.items[node->prim];
    str_id id = str_intern_z(m->doc->strings, name);
    doc_type type =
        library_ports(m->lib, node->nodedef, NULL)[library_find_input(m->lib, node->nodedef, id)]
            .type;
    elem_id input = maker_add(m, node->element, "input", id, at->line, at->column);
    maker_set(m, input, "type", library_type_name(m->lib, type));
    maker_set(m, input, "value", str_intern_z(m->doc->strings, value));
}

/* Makes the node that the value of an input is. */
static void add_constant(struct maker *m, const struct made_node *node,
                         const struct preview_input *row)
{
    const struct usda_property *property = given(m, node->prim, row->input);
    struct source made = maker_add_before(m, node, row->constant, row->name, row->input);
    const struct made_node constant = made.node ? m->nodes.items[made.node - 1] : *node;
    if (made.node && property)
        maker_read_input(m, &constant, property, STR_value);
}

void usd_add_values(struct maker *m, const struct made_node *node)
{
    const struct preview_input *row = NULL;
    while (node->preview && (row = preview_next_input(node->preview, row))) {
        if (!row->name)
            continue;
        const char *word = row->has_tokens ? word_of(m, node, row->input) : NULL;
        bool is_given = value_of(m, node->prim, row->input) != NULL;
        if (word || (row->otherwise && !is_given))
            add_value(m, node, row->name, word ? word : row->otherwise);
        if (is_constant(m, node, row))
            add_constant(m, node, row);
    }
}

void usd_set_color_space(struct maker *m, const struct made_node *node, elem_id input,
                         const struct usda_property *file)
{
    enum { BEGIN = 1 << 18 }; /* headers of images lie in it */
    const char *word = word_of(m, node, "sourceColorSpace");
    bool is_auto = !word || !*word;
    if (is_auto && file->color_space.len) {
        maker_set(m, input, "colorspace", maker_intern(m, file->color_space));
        return;
    }
    if (is_auto) {
        const char *name = str_text(m->doc->strings, maker_value(m, file));
        unsigned char *buffer = arena_alloc(m->scratch, BEGIN);
        size_t size = m->images->read(m->images->user_data, name, buffer, BEGIN);
        word = bind_image_is_srgb(name, buffer, size) ? "srgb_texture" : "none";
        arena_release(m->scratch, buffer, BEGIN);
    }
    maker_set(m, input, "colorspace", str_intern_z(m->doc->strings, word));
}

/* ---- Outputs ---- */

/* The texture after its scale and bias. */
static struct source scaled_texture(struct maker *m, uint32_t texture)
{
    static const char *const steps[][3] = {{"scale", "ND_multiply_color4", "scaled"},
                                           {"bias", "ND_add_color4", "biased"}};
    const struct made_node node = m->nodes.items[texture - 1];
    struct source at = {.node = texture,
                        .port = maker_outputs(m, node.nodedef, &(uint32_t){0})[0].name};
    for (size_t i = 0; i < 2 && !node.last; i++) {
        const struct usda_property *property = given(m, node.prim, steps[i][0]);
        if (!property)
            continue;
        at = maker_add_after(m, &at, steps[i][1], "in1", steps[i][2]);
        const struct made_node added = m->nodes.items[at.node - 1];
        maker_read_input(m, &added, property, str_intern_z(m->doc->strings, "in2"));
    }
    if (!node.last)
        m->nodes.items[texture - 1].last = at.node;
    at.node = m->nodes.items[texture - 1].last;
    return at;
}

struct source usd_texture_output(struct maker *m, uint32_t texture, struct text_word name)
{
    static const char *const ports[][2] = {
        {"r", "outr"}, {"g", "outg"}, {"b", "outb"}, {"a", "outa"}};
    struct source whole = scaled_texture(m, texture);
    if (usda_is(name, "rgb"))
        return maker_add_after(m, &whole, "ND_convert_color4_color3", "in", "rgb");
    for (size_t i = 0; i < sizeof ports / sizeof *ports; i++)
        if (usda_is(name, ports[i][0])) {
            struct source out = maker_add_after(m, &whole, "ND_separate4_color4", "in", "channels");
            out.port = str_intern_z(m->doc->strings, ports[i][1]);
            return out;
        }
    return (struct source){.node = texture};
}

struct source usd_displacement(struct maker *m, const struct made_node *surface)
{
    const struct usda_property *property = given(m, surface->prim, "displacement");
    uint32_t nodedef =
        library_nodedef_by_name(m->lib, str_intern_z(m->doc->strings, "ND_displacement_float"));
    if (!property || nodedef == LIBRARY_NONE)
        return (struct source){0};
    struct text name;
    text_init(&name, m->scratch);
    text_fmt(&name, "%s_displacement", m->name);
    struct made_node node = {.prim = surface->prim, .nodedef = nodedef, .is_made = true};
    node.element = maker_add_free(m, m->doc->root, "displacement", &name,
                                  &m->layer->prims.items[surface->prim]);
    maker_set(m, node.element, "type", STR_displacementshader);
    vec_push(m->scratch, &m->nodes, node);
    struct source out = {.node = m->nodes.len,
                         .port = maker_outputs(m, nodedef, &(uint32_t){0})[0].name};
    maker_read_input(m, &node, property, str_intern_z(m->doc->strings, "displacement"));
    return out;
}
