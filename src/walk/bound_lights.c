// SPDX-License-Identifier: Apache-2.0
/*
 * The lights that a host binds: definitions of light shaders, and <light> elements of the document.
 */
#include "base/num.h"
#include "build/build_priv.h"
#include "parse/parse.h"

#include <assert.h>

/* Options have no place in a file. */
static const struct diag_place nowhere = {0};

static bool gives_light(const struct library *layer, const struct nodedef *def)
{
    return def->num_outputs == 1
           && layer->ports.items[def->first_port + def->num_inputs].type == DOC_TYPE_lightshader;
}

/* The definition of a light shader by the name of its node. */
static uint32_t find_light(const struct builder *b, const char *node, size_t len)
{
    const struct library *lib = b->lib;
    str_id name = str_find(b->shader->strings, node, len);
    for (const struct library *layer = name ? lib : NULL; layer; layer = layer->base)
        for (uint32_t i = library_first_of_node(layer, name); i != LIBRARY_NONE;
             i = layer->nodedefs.items[i].next_same_node)
            if (gives_light(layer, &layer->nodedefs.items[i])
                && library_target_fit(lib, layer->base_nodedefs + i))
                return layer->base_nodedefs + i;
    return LIBRARY_NONE;
}

/* The EDF input of the node `light` is no member, because it is a connection. */
static bool is_member(const struct builder *b, const struct port *input)
{
    return !ir_type_is_closure(library_type_ir(b->lib, input->type));
}

/* The inputs of a light shader become members of LightData. */
static struct shader_light start_light(struct builder *b, uint32_t nodedef, int32_t type)
{
    struct shader *shader = b->shader;
    const struct nodedef *def = library_nodedef(b->lib, nodedef);
    const struct port *ports = library_ports(b->lib, nodedef, NULL);
    struct shader_light light = {.type = type,
                                 .name = def->node,
                                 .function = LANG_NONE,
                                 .sample = LANG_NONE,
                                 .source = UINT32_MAX,
                                 .first_member = shader->interface.light_members.len};
    for (uint32_t i = 0; i < def->num_inputs; i++)
        if (is_member(b, &ports[i]))
            vec_push(
                b->arena, &shader->interface.light_members,
                shader_light_member(shader, ports[i].name, library_type_ir(b->lib, ports[i].type)));
    light.num_members = shader->interface.light_members.len - light.first_member;
    assert(light.num_members <= def->num_inputs);
    return light;
}

/* Hosts that do not set a member leave it at the default of its definition. */
static void set_default(struct builder *b, const struct port *input, uint32_t member)
{
    assert(member < b->shader->interface.variables.len);
    struct shader_variable *variable = &b->shader->interface.variables.items[member];
    ir_ref value = variable->has_default || input->geomprop ? 0 : build_default(b, input);
    if (value)
        variable->has_default = ir_get_const(b->graph, value, &variable->value);
}

/* A light made of nodes has a position and a direction, which the host sets. */
static void place_light(struct builder *b, struct shader_light *light)
{
    light->position = shader_light_member(b->shader, STR_position, IR_TYPE_VEC3);
    light->direction = shader_light_member(b->shader, STR_direction, IR_TYPE_VEC3);
}

static ir_ref read_member(struct builder *b, uint32_t variable)
{
    assert(variable < b->shader->interface.variables.len);
    return ir_build(b->graph, IR_CONTEXT, b->shader->interface.variables.items[variable].type,
                    variable, NULL, 0);
}

/* The LIGHT_SHADER of a definition made of nodes, over the light's members; 0 after an error. */
static ir_ref shader_of(struct builder *b, uint32_t nodedef, const struct shader_light *light)
{
    assert(light->first_member + light->num_members <= b->shader->interface.light_members.len);
    const struct nodedef *def = library_nodedef(b->lib, nodedef);
    const struct port *ports = library_ports(b->lib, nodedef, NULL);
    const uint32_t *members = b->shader->interface.light_members.items + light->first_member;
    ir_ref *args = ARENA_ARRAY(b->arena, ir_ref, def->num_inputs + 1), result = 0;
    uint32_t next = 0;
    for (uint32_t i = 0; i < def->num_inputs; i++)
        if (is_member(b, &ports[i]))
            args[i] = read_member(b, members[next++]);
    next = 0;
    for (uint32_t i = 0; i < def->num_inputs; i++)
        if (is_member(b, &ports[i]))
            set_default(b, &ports[i], members[next++]);
    assert(next == light->num_members);
    build_apply(b, nodedef, b->lib->doc.root, args, &result);
    return result && ir_get(b->graph, result)->op == IR_LIGHT_SHADER ? result : 0;
}

/*
 * The function NAME_sample beside the function of a light, with the same inputs; LANG_NONE: the
 * light has no size.
 */
static uint32_t find_sample(const struct builder *b, const struct shader_light *light)
{
    const struct shader *shader = b->shader;
    const struct lang_function *fn = lang_function(shader->unit, light->function, NULL);
    ir_type_id *types = ARENA_ARRAY(b->arena, ir_type_id, light->num_members + 5);
    uint32_t num = 0;
    for (; num < light->num_members; num++)
        types[num] = shader->interface.variables
                         .items[shader->interface.light_members.items[light->first_member + num]]
                         .type;
    static const ir_type_id others[] = {IR_TYPE_VEC3, IR_TYPE_VEC2, IR_TYPE_VEC3, IR_TYPE_VEC3,
                                        IR_TYPE_FLOAT};
    for (unsigned i = 0; i < 5; i++)
        types[num++] = others[i];
    struct text name;
    text_init(&name, b->arena);
    text_fmt(&name, "%s_sample", str_text(shader->strings, fn->name));
    str_id id = str_find(shader->strings, text_cstr(&name), name.len);
    return id ? lang_find_function(shader->unit, fn->file, id, types, num) : LANG_NONE;
}

/* Adds a light shader by its definition: a function, or nodes over the members. */
static bool add_defined_light(struct builder *b, uint32_t nodedef, int32_t type)
{
    struct shader_light light = start_light(b, nodedef, type);
    const struct implementation *impl = build_best_implementation(b, nodedef);
    bool is_source = impl && impl->kind == IMPL_VERBATIM && build_is_light_source(b, impl);
    if (impl && impl->kind == IMPL_FUNCTION)
        light.function = impl->ref;
    if (light.function != LANG_NONE && b->shader->role->returns == RETURNS_PATH)
        light.sample = find_sample(b, &light);
    if (is_source && (light.source = build_light_source(b, impl)) == UINT32_MAX)
        return false;
    if (light.function == LANG_NONE && !is_source) {
        place_light(b, &light);
        light.shader = shader_of(b, nodedef, &light);
        if (!light.shader)
            return false;
    }
    vec_push(b->arena, &b->shader->interface.lights, light);
    return true;
}

/*
 * Adds a light of the document: a <light> with its EDF. Its inputs belong to the shader's
 * interface.
 */
static bool add_light_element(struct builder *b, const char *path, int32_t type)
{
    const struct document *doc = &b->lib->doc;
    elem_id element = doc_find(doc, path, strlen(path));
    if (!element || doc_attr_value(doc, element, STR_type) != STR_lightshader)
        return false;
    struct shader_light light = {.type = type,
                                 .name = doc_element(doc, element)->name,
                                 .function = LANG_NONE,
                                 .sample = LANG_NONE,
                                 .source = UINT32_MAX};
    light.shader = build_element(b, element, 0);
    if (!light.shader || ir_get(b->graph, light.shader)->op != IR_LIGHT_SHADER
        || !ir_arg(b->graph, light.shader, 0))
        return false;
    place_light(b, &light);
    vec_push(b->arena, &b->shader->interface.lights, light);
    return true;
}

/* True if a host can describe the light without a connected node. */
static bool stands_alone(const struct library *layer, const struct nodedef *def)
{
    const struct port *inputs = layer->ports.items + def->first_port;
    for (uint32_t i = 0; i < def->num_inputs; i++)
        if (inputs[i].type == DOC_TYPE_lightshader || inputs[i].type == DOC_TYPE_EDF)
            return false;
    return true;
}

/* Writes the definitions of light shaders, for a message. */
static void put_lights(const struct builder *b, struct text *out)
{
    const char *separator = "; expected one of: ";
    for (const struct library *layer = b->lib; layer; layer = layer->base)
        for (uint32_t i = 0; i < layer->nodedefs.len; i++) {
            const struct nodedef *def = &layer->nodedefs.items[i];
            if (!gives_light(layer, def) || !stands_alone(layer, def))
                continue;
            text_fmt(out, "%s%s", separator, str_text(b->shader->strings, def->node));
            separator = ", ";
        }
}

/*
 * The hint for a node whose definition is a function: the definition is a light, the node is not.
 */
static const char *light_hint(struct builder *b, const char *item, size_t len)
{
    const struct document *doc = &b->lib->doc;
    elem_id element = doc_find(doc, item, len);
    struct text hint;
    text_init(&hint, b->arena);
    if (!element || doc_attr_value(doc, element, STR_type) != STR_lightshader) {
        put_lights(b, &hint);
        return text_cstr(&hint);
    }
    const char *node = str_text(doc->strings, doc_element(doc, element)->category);
    text_fmt(&hint,
             strcmp(node, "light") == 0 ? "; the node has no EDF"
                                        : "; bind '%s' and let the host set its members",
             node);
    return text_cstr(&hint);
}

static bool has_light(const struct shader *shader, int32_t type)
{
    for (uint32_t i = 0; i < shader->interface.lights.len; i++)
        if (shader->interface.lights.items[i].type == type)
            return true;
    return false;
}

/* The number after "=" of an item, or `next`; false after a diagnostic. */
static bool number_of(struct builder *b, const char *item, int64_t next, int32_t *out)
{
    const char *sign = strchr(item, '='), *number = sign ? sign + 1 : "";
    int64_t type = next;
    size_t len = strlen(number);
    bool is_number = !sign || (len && num_parse_int(number, len, &type) == len);
    const char *expected = !is_number || type < INT32_MIN || type > INT32_MAX ? "'node=number'"
                           : has_light(b->shader, (int32_t)type)
                               ? "a number that no other light uses"
                               : NULL;
    if (expected)
        diag_add(b->diags, DIAG_ID_bad_option, nowhere, item, "lights", expected);
    *out = expected ? 0 : (int32_t)type;
    return !expected;
}

void build_lights(struct builder *b, const char *const *items, uint32_t num_items, bool is_explicit)
{
    for (uint32_t i = 0; i < num_items; i++) {
        const char *name = arena_strndup(b->arena, items[i], strcspn(items[i], "="));
        int32_t type;
        if (strcmp(items[i], "none") == 0 || !number_of(b, items[i], (int64_t)i + 1, &type))
            continue;
        uint32_t nodedef = find_light(b, name, strlen(name)), before = b->diags->num_errors;
        bool is_bound = nodedef != LIBRARY_NONE ? add_defined_light(b, nodedef, type)
                                                : add_light_element(b, name, type);
        if (!is_bound && is_explicit && b->diags->num_errors == before)
            diag_add(b->diags, DIAG_ID_unknown_light, nowhere, name,
                     light_hint(b, name, strlen(name)));
    }
}
