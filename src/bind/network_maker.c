// SPDX-License-Identifier: Apache-2.0
#include "bind/network_maker.h"
#include "bind/shade_type.h"

#include "base/hash.h"

str_id maker_intern(struct maker *m, struct text_word word)
{
    return str_intern(m->doc->strings, word.bytes, word.len);
}

void maker_set(struct maker *m, elem_id element, const char *name, str_id value)
{
    doc_set_attr(m->doc, element, str_intern_z(m->doc->strings, name), value);
}

elem_id maker_add(struct maker *m, elem_id parent, const char *category, str_id name, uint32_t line,
                  uint32_t column)
{
    return doc_add_element(m->doc, parent, str_intern_z(m->doc->strings, category), name, m->file,
                           line, (uint16_t)(column < UINT16_MAX ? column : UINT16_MAX));
}

/* ---- Names ---- */

elem_id maker_add_free(struct maker *m, elem_id parent, const char *category, struct text *name,
                       const struct usda_prim *at)
{
    size_t len = name->len;
    str_id id = str_intern(m->doc->strings, name->data, len);
    for (unsigned suffix = 2;
         doc_child(m->doc, parent, id)
         || (parent == m->doc->root && scene_material_named(m->scene, text_cstr(name)));
         suffix++) {
        name->len = len;
        text_fmt(name, "_%u", suffix);
        id = str_intern(m->doc->strings, name->data, name->len);
    }
    elem_id added = maker_add(m, parent, category, id, at->line, at->column);
    /* colours of USD are linear, whatever the document says of its own */
    if (parent == m->doc->root && doc_attr_value(m->doc, parent, STR_colorspace))
        maker_set(m, added, "colorspace", str_intern_z(m->doc->strings, "lin_rec709"));
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

str_id maker_value(struct maker *m, const struct usda_property *property)
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

struct diag_place maker_place(const struct maker *m, const struct usda_property *property)
{
    return (struct diag_place){m->layer->file, property->line, property->column, 0};
}

const char *maker_text(struct maker *m, struct text_word word)
{
    return arena_strndup(m->diags->arena, word.bytes, word.len);
}

void maker_check_type(struct maker *m, const struct usda_property *property, const char *wanted)
{
    const char *name = maker_text(m, property->name), *type = maker_text(m, property->type);
    if (!shade_type_agrees(property->type, wanted))
        diag_add(m->diags, DIAG_ID_usda_type, maker_place(m, property), name, type, wanted);
    else if (property->value.len && *property->value.bytes != '<' && !shade_value_fits(property))
        diag_add(m->diags, DIAG_ID_usda_value, maker_place(m, property), name,
                 maker_text(m, usda_value(property)), type);
}

/* ---- Nodes ---- */

/* The definition of a shader; USD's own shaders are nodes of MaterialX, too. */
static uint32_t definition_of(struct maker *m, usda_prim_id prim,
                              const struct preview_shader **out_preview)
{
    const struct usda_prim *at = &m->layer->prims.items[prim];
    const struct usda_property *id = usda_find_attribute(m->layer, at, "info:id");
    struct text_word rest = id ? id->value : (struct text_word){0}, word = {0};
    if (id)
        usda_next_item(&rest, &word);
    *out_preview = preview_find(word);
    str_id name = *out_preview ? str_intern_z(m->doc->strings, (*out_preview)->nodedef)
                               : maker_intern(m, word);
    uint32_t found = library_nodedef_by_name(m->lib, name);
    if (found != LIBRARY_NONE)
        return found;
    struct diag_place place = {m->layer->file, id ? id->line : at->line,
                               id ? id->column : at->column, 0};
    diag_add(m->diags, DIAG_ID_usda_shader, place, maker_text(m, at->name), maker_text(m, word));
    return LIBRARY_NONE;
}

static bool is_shader_type(struct maker *m, doc_type type)
{
    const char *name = str_text(m->doc->strings, library_type_name(m->lib, type));
    size_t len = strlen(name);
    return len > 6 && strcmp(name + len - 6, "shader") == 0;
}

const struct port *maker_outputs(struct maker *m, uint32_t nodedef, uint32_t *out_num)
{
    const struct nodedef *def = library_nodedef(m->lib, nodedef);
    *out_num = def->num_outputs;
    return library_ports(m->lib, nodedef, NULL) + def->num_inputs;
}

static str_id type_of(struct maker *m, const struct port *outputs, uint32_t num)
{
    return num == 1 ? library_type_name(m->lib, outputs[0].type)
                    : str_intern_z(m->doc->strings, "multioutput");
}

elem_id maker_graph(struct maker *m)
{
    if (!m->graph) {
        const struct usda_prim *material = &m->layer->prims.items[m->material];
        struct text name;
        text_init(&name, m->scratch);
        text_str(&name, m->name);
        text_str(&name, "_graph");
        m->graph = maker_add_free(m, m->doc->root, "nodegraph", &name, material);
    }
    return m->graph;
}

uint32_t maker_node(struct maker *m, usda_prim_id prim)
{
    uint32_t hash = hash_pair(prim, m->material);
    for (uint32_t at = hash, found; (found = table_next(&m->node_table, hash, &at));)
        if (found <= m->nodes.len && m->nodes.items[found - 1].prim == prim)
            return found;
    const struct preview_shader *preview;
    uint32_t nodedef = definition_of(m, prim, &preview), num;
    if (nodedef == LIBRARY_NONE)
        return 0;
    const struct usda_prim *at = &m->layer->prims.items[prim];
    const struct port *outputs = maker_outputs(m, nodedef, &num);
    bool is_shader = is_shader_type(m, outputs[0].type);
    const char *category = str_text(m->doc->strings, library_nodedef(m->lib, nodedef)->node);
    struct text name = name_below(m, m->material, prim, is_shader);
    elem_id element =
        maker_add_free(m, is_shader ? m->doc->root : maker_graph(m), category, &name, at);
    maker_set(m, element, "type", type_of(m, outputs, num));
    maker_set(m, element, "nodedef", library_nodedef(m->lib, nodedef)->name);
    vec_push(m->scratch, &m->nodes,
             (struct made_node){
                 .prim = prim, .element = element, .nodedef = nodedef, .preview = preview});
    table_add(&m->node_table, m->scratch, hash, m->nodes.len);
    return m->nodes.len;
}

/* Connects an input of a node, which has no element for it yet. */
static void connect_input(struct maker *m, const struct made_node *node, const char *name,
                          const struct source *from)
{
    const struct usda_prim *at = &m->layer->prims.items[node->prim];
    str_id id = str_intern_z(m->doc->strings, name);
    elem_id input = maker_add(m, node->element, "input", id, at->line, at->column);
    int index = library_find_input(m->lib, node->nodedef, id);
    doc_type type = library_ports(m->lib, node->nodedef, NULL)[index].type;
    maker_set(m, input, "type", library_type_name(m->lib, type));
    maker_connect(m, input, node->element, from);
}

/* Adds a node for the prim of another one, named after it; node 0: it has no definition. */
static struct source add_node(struct maker *m, const struct made_node *of, const char *nodedef,
                              const char *suffix)
{
    uint32_t found = library_nodedef_by_name(m->lib, str_intern_z(m->doc->strings, nodedef)), num;
    if (found == LIBRARY_NONE)
        return (struct source){0};
    const struct port *outputs = maker_outputs(m, found, &num);
    struct text name;
    text_init(&name, m->scratch);
    text_fmt(&name, "%s_%s", doc_name(m->doc, of->element), suffix);
    const char *category = str_text(m->doc->strings, library_nodedef(m->lib, found)->node);
    elem_id element =
        maker_add_free(m, maker_graph(m), category, &name, &m->layer->prims.items[of->prim]);
    maker_set(m, element, "type", type_of(m, outputs, num));
    maker_set(m, element, "nodedef", library_nodedef(m->lib, found)->name);
    vec_push(m->scratch, &m->nodes,
             (struct made_node){
                 .prim = of->prim, .element = element, .nodedef = found, .is_made = true});
    return (struct source){.node = m->nodes.len, .port = outputs[0].name};
}

struct source maker_add_after(struct maker *m, const struct source *from, const char *nodedef,
                              const char *input, const char *suffix)
{
    const struct made_node before = m->nodes.items[from->node - 1];
    struct source added = add_node(m, &before, nodedef, suffix);
    if (!added.node)
        return *from;
    const struct made_node after = m->nodes.items[added.node - 1];
    connect_input(m, &after, input, from);
    return added;
}

struct source maker_add_before(struct maker *m, const struct made_node *node, const char *nodedef,
                               const char *input, const char *suffix)
{
    struct source added = add_node(m, node, nodedef, suffix);
    if (added.node)
        connect_input(m, node, input, &added);
    return added;
}
