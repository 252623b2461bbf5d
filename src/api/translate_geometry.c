// SPDX-License-Identifier: Apache-2.0
/*
 * Normals and tangents: inputs that the geometry fills unless a document connects them. Each goes
 * to the input of the new model with the same meaning. UsdPreviewSurface has a normal in tangent
 * space, so the map stands there in place of its <normalmap>, and comes out of it again.
 */
#include "api/translate.h"

enum meaning translate_meaning_of(const mxg_port *port)
{
    bool is_normal = strcmp(port->defaultgeomprop, "Nworld") == 0;
    bool is_tangent = strcmp(port->defaultgeomprop, "Tworld") == 0;
    bool is_coat = strstr(port->name, "coat") != NULL;
    if (is_normal || is_tangent)
        return (enum meaning)(MEANING_NORMAL + is_tangent + 2 * is_coat);
    return strcmp(port->name, "normal") == 0 && strcmp(port->type, "vector3") == 0 ? MEANING_MAPPED
                                                                                   : MEANING_NONE;
}

static struct translated_input *find_input(const struct translation *t, enum meaning meaning)
{
    for (uint32_t i = 0; i < t->inputs.len; i++)
        if (translate_meaning_of(&t->inputs.items[i].port) == meaning)
            return &t->inputs.items[i];
    return NULL;
}

static struct operand number(float value)
{
    return (struct operand){
        .kind = OPERAND_CONSTANT, .type = VALUE_FLOAT, .value = ir_value_float(value)};
}

static struct operand vector(float xy, float z)
{
    return (struct operand){.kind = OPERAND_CONSTANT,
                            .type = VALUE_VECTOR3,
                            .value = {.type = IR_TYPE_VEC3, .w = {{.f = xy}, {.f = xy}, {.f = z}}}};
}

/* a * scale + offset of vectors, as two nodes. */
static struct operand scaled(struct translation *t, struct operand a, struct operand scale,
                             struct operand offset)
{
    struct operand product =
        value_nodes_call(&t->nodes, "multiply", VALUE_VECTOR3, "in1", a, "in2", scale);
    return value_nodes_call(&t->nodes, "add", VALUE_VECTOR3, "in1", product, "in2", offset);
}

mxg_element translate_find_graph_output(const struct translation *t, mxg_element graph,
                                        const char *name)
{
    mxg_element_info info = {.size = sizeof info};
    mxg_document_element(t->document, graph, &info);
    for (mxg_element child = info.first_child; child; child = info.next) {
        mxg_document_element(t->document, child, &info);
        if (strcmp(info.category, "output") == 0 && (!*name || strcmp(info.name, name) == 0))
            return child;
    }
    return 0;
}

mxg_element translate_find_source(const struct translation *t, mxg_element port)
{
    enum { MAX_GRAPHS = 1000 };
    for (unsigned i = 0; i < MAX_GRAPHS; i++) {
        mxg_connection connection = {.size = sizeof connection};
        mxg_element_info info = {.size = sizeof info};
        if (mxg_document_connection(t->document, port, &connection) != MXG_OK)
            return 0;
        mxg_document_element(t->document, connection.source, &info);
        if (!connection.source || strcmp(info.category, "nodegraph") != 0)
            return connection.source;
        port = translate_find_graph_output(t, connection.source, connection.output);
    }
    return 0;
}

/*
 * Replaces the leaf of a normal in the world by that of its map: the input `in` of the <normalmap>,
 * if the surface can reach it. False: it cannot.
 */
static bool take_map(struct translation *t, uint32_t leaf, float *out_scale)
{
    mxg_element map = translate_find_source(t, t->sources.items[leaf].element);
    mxg_element_info info = {.size = sizeof info};
    mxg_document_element(t->document, map, &info);
    mxg_element in = map && strcmp(info.category, "normalmap") == 0
                         ? mxg_document_find_element(t->document, map, "in")
                         : 0;
    mxg_connection connection = {.size = sizeof connection};
    if (!in || mxg_document_connection(t->document, in, &connection) != MXG_OK
        || *connection.interfacename)
        return false;
    mxg_element scale = mxg_document_find_element(t->document, map, "scale");
    mxg_value value = {.size = sizeof value, .values = {1.0f}};
    if (scale
        && (mxg_document_value(t->document, scale, &value) != MXG_OK
            || strcmp(value.type, "float") != 0))
        return false;
    t->sources.items[leaf].map = in;
    *out_scale = value.values[0];
    return true;
}

static bool translate_one(struct translation *t, uint32_t leaf, enum meaning from)
{
    struct translated_input *same = find_input(t, from);
    struct operand value = {.kind = OPERAND_LEAF, .type = VALUE_VECTOR3, .index = leaf};
    float scale = 1.0f;
    struct translated_input *other = find_input(t, from == MEANING_NORMAL   ? MEANING_MAPPED
                                                   : from == MEANING_MAPPED ? MEANING_NORMAL
                                                                            : from);
    if (same) {
        same->value = value;
    } else if (other && from == MEANING_MAPPED) {
        value = scaled(t, value, number(0.5f), number(0.5f));
        other->value =
            value_nodes_call(&t->nodes, "normalmap", VALUE_VECTOR3, "in", value, NULL, value);
    } else if (other && take_map(t, leaf, &scale)) {
        other->value = scaled(t, value, vector(2.0f * scale, 2.0f), vector(-scale, -1.0f));
    } else {
        return false;
    }
    (same ? same : other)->is_set = true;
    return true;
}

void translate_geometry(struct translation *t)
{
    for (uint32_t i = 0; i < t->sources.len; i++) {
        struct source_input *source = &t->sources.items[i];
        enum meaning meaning = translate_meaning_of(&source->port);
        if (meaning != MEANING_NONE && source->is_connected)
            source->is_used = translate_one(t, i, meaning);
    }
}
