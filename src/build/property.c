// SPDX-License-Identifier: Apache-2.0
/*
 * Properties of the geometry by name: variables that hosts fill. A variable also has the value of a
 * geometry without the property, so readers with different values have a variable each, and these
 * share the semantic, by which hosts find the property.
 */
#include "base/hash.h"
#include "build/build_priv.h"

/* "geomprop_fade" for the first variable; the others have a name that no property can have. */
static str_id asked_name(struct builder *b, const struct property *property, bool is_stream,
                         unsigned number)
{
    struct text name;
    text_init(&name, b->arena);
    text_fmt(&name, "%sgeomprop_%s", is_stream ? "" : "u_", build_text(b, property->name));
    if (number > 1)
        text_fmt(&name, ":%u", number);
    return str_intern(b->shader->strings, name.data, name.len);
}

static str_id semantic_of(struct builder *b, const struct property *property, bool is_stream)
{
    struct text name;
    text_init(&name, b->arena);
    text_fmt(&name, "geomprop%s%s", is_stream ? ":" : "_", build_text(b, property->name));
    return str_intern(b->shader->strings, name.data, name.len);
}

/* True if a variable has the same value for a geometry without the property; 0 without any. */
static bool has_value(const struct shader_variable *variable, const struct property *property)
{
    if (property->type == IR_TYPE_SAMPLER)
        return variable->file == (property->texture ? property->texture->file : 0);
    for (unsigned i = 0; i < ir_type_info(property->type)->components; i++) {
        uint32_t mine = property->value ? property->value->w[i].u : 0;
        if (mine != (variable->has_default ? variable->value.w[i].u : 0))
            return false;
    }
    return true;
}

static void set_value(struct builder *b, uint32_t index, const struct property *property,
                      str_id semantic)
{
    struct shader_variable *variable = &b->shader->interface.variables.items[index];
    if (property->texture) {
        struct shader_variable of_property = *variable;
        *variable = *property->texture;
        variable->name = of_property.name;
        variable->has_reader = false;
    }
    variable->semantic = semantic;
    if (property->value) {
        variable->has_default = true;
        variable->value = *property->value;
    }
}

static ir_ref variable_of(struct builder *b, const struct property *property, bool is_stream,
                          unsigned number)
{
    str_id name = asked_name(b, property, is_stream, number);
    return is_stream
               ? shader_stream(b->shader, name, property->type)
               : shader_read(b->shader, shader_private_uniform(b->shader, name, property->type, 0));
}

static uint32_t hash_of(const struct property *property, str_id semantic)
{
    uint32_t hash = hash_pair(semantic, property->type);
    if (property->type == IR_TYPE_SAMPLER)
        return hash_pair(hash, property->texture ? property->texture->file : 0);
    for (unsigned i = 0; i < ir_type_info(property->type)->components; i++)
        hash = hash_pair(hash, property->value ? property->value->w[i].u : 0); /* as has_value */
    return hash;
}

/* The variable of an equal property; UINT32_MAX: there is none yet. */
static uint32_t find_variable(const struct builder *b, const struct property *property,
                              str_id semantic, uint32_t hash)
{
    for (uint32_t at = hash, found; (found = table_next(&b->properties, hash, &at));) {
        const struct shader_variable *variable = &b->shader->interface.variables.items[found - 1];
        if (variable->semantic == semantic && variable->type == property->type
            && has_value(variable, property))
            return found - 1;
    }
    return UINT32_MAX;
}

/* The last number of the names of a property, among variables of one scalar type. */
static unsigned *last_number(struct builder *b, str_id semantic, ir_type_id type)
{
    ir_type_id scalar = build_is_number(type) ? ir_type_info(type)->scalar : type;
    uint32_t hash = hash_pair(semantic, scalar);
    for (uint32_t at = hash, found; (found = table_next(&b->property_table, hash, &at));) {
        struct property_name *name = &b->property_names.items[found - 1];
        if (name->semantic == semantic && name->scalar == scalar)
            return &name->last;
    }
    vec_push(b->arena, &b->property_names, (struct property_name){semantic, scalar, 0});
    table_add(&b->property_table, b->arena, hash, b->property_names.len);
    return &vec_last(&b->property_names).last;
}

static ir_ref read_property(struct builder *b, const struct property *property)
{
    bool is_stream = property->type != IR_TYPE_BOOL && property->type != IR_TYPE_SAMPLER;
    str_id semantic = semantic_of(b, property, is_stream);
    uint32_t hash = hash_of(property, semantic), equal = find_variable(b, property, semantic, hash);
    if (equal != UINT32_MAX)
        return shader_read(b->shader, equal);
    unsigned *last = last_number(b, semantic, property->type);
    for (;;) {
        uint32_t known = b->shader->interface.variables.len, attribute;
        ir_ref ref = variable_of(b, property, is_stream, ++*last);
        const struct ir_node *node = ir_get(b->graph, ref);
        bool is_variable =
            node->op == IR_STREAM || node->op == IR_UNIFORM || node->op == IR_TEXTURE;
        if (!is_variable) /* of another type */
            continue;
        uint32_t index = node->attr;
        if (index < known && !has_value(&b->shader->interface.variables.items[index], property))
            continue;
        table_add(&b->properties, b->arena, hash, index + 1);
        if (index < known)
            return ref;
        if (is_stream && shader_attribute(b->shader, index, &attribute))
            set_value(b, attribute, property, semantic);
        set_value(b, index, property, semantic);
        return shader_read(b->shader, index);
    }
}

/* The factor from the unit that a <geompropdef> names; 1: it names none. */
static float unit_factor(struct builder *b, const struct property *property)
{
    const char *name = build_text(b, property->name);
    str_id id = str_find(&b->lib->strings, name, strlen(name));
    const struct geomprop *prop = id ? library_geomprop(b->lib, id) : NULL;
    bool has_unit = prop && build_is_number(property->type) && ir_type_is_float(property->type)
                    && doc_attr_value(&b->lib->doc, prop->element, STR_unit);
    return has_unit ? build_unit_factor(b, prop->element, 0) : 1.0f;
}

/*
 * The geometry has a property in its unit, and the shader in that of the options. The value that
 * stands in is an input of a node, and has the shader's unit.
 */
ir_ref build_property(struct builder *b, const struct property *property)
{
    float factor = unit_factor(b, property);
    struct property of_geometry = *property;
    struct ir_value value;
    if (factor == 1.0f)
        return read_property(b, property);
    if (property->value) {
        value = *property->value;
        for (unsigned i = 0; i < ir_type_info(value.type)->components; i++)
            value.w[i].f /= factor;
        of_geometry.value = &value;
    }
    ir_ref read = read_property(b, &of_geometry);
    return ir_op2(b->graph, IR_MUL, read, ir_const_float(b->graph, factor));
}
