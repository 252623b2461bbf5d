// SPDX-License-Identifier: Apache-2.0
/*
 * The variables between a shader and its host, and the streams from the vertex stage to the pixel
 * stage.
 *
 * Names at file scope are unique. The table shader->names finds a variable by its name, without its
 * block: members are written without their block, so two blocks cannot have members of one name.
 * Only vertex data has its own scope.
 */
#include "shader/shader.h"

#include "base/hash.h"

#include <assert.h>

const char *shader_block_name(const struct shader *shader, enum shader_block block)
{
    static const char *const names[BLOCK_OWN] = {
        [BLOCK_PUBLIC_UNIFORMS] = "PublicUniforms",
        [BLOCK_PRIVATE_UNIFORMS] = "PrivateUniforms",
        [BLOCK_LIGHT_DATA] = "LightData",
        [BLOCK_TEXTURES] = "Textures",
        [BLOCK_APP_DATA] = "AppData",
        [BLOCK_VERTEX_DATA] = "VertexData",
        [BLOCK_OUTPUTS] = "Outputs",
    };
    if (block < BLOCK_OWN)
        return names[block];
    str_id own = shader->interface.own_blocks[block - BLOCK_OWN];
    return own ? str_text(shader->strings, own) : "";
}

bool shader_block_has_uniforms(enum shader_block block)
{
    return block == BLOCK_PUBLIC_UNIFORMS || block == BLOCK_PRIVATE_UNIFORMS || block >= BLOCK_OWN;
}

const char *shader_block_type(const struct shader *shader, const struct lang_syntax *syntax,
                              const struct shader_variable *variable)
{
    enum shader_block block = (enum shader_block)variable->block;
    bool is_in_block = shader->interface.rules.blocks
                       && (shader_block_has_uniforms(block) || block == BLOCK_LIGHT_DATA);
    return variable->type == IR_TYPE_BOOL && is_in_block ? syntax->block_bool : NULL;
}

/*
 * room for the variables of a shading model, because variables are large and moving them is
 * expensive
 */
enum { FIRST_VARIABLES = 80 };

void shader_init(struct shader *shader, const struct role *role, struct arena *arena,
                 struct strpool *strings, struct ir_graph *graph, struct lang_unit *unit)
{
    *shader = (struct shader){.role = role,
                              .lights = role->lights,
                              .arena = arena,
                              .strings = strings,
                              .graph = graph,
                              .unit = unit,
                              .interface.max_lights = 3,
                              .interface.naming.prefix = "",
                              .interface.naming_of_members.prefix = "",
                              .reflection.function = "",
                              .reflection.function_type = "",
                              .reflection.device_features = ""};
    for (int stage = 0; stage < NUM_STAGES; stage++)
        shader->stages[stage].reach.arena = arena;
    vec_reserve(arena, &shader->interface.variables, FIRST_VARIABLES);
}

/* ---- Names ---- */

/* Members of structs and of blocks with an instance name have their own scopes. */
static uint32_t name_scope(const struct shader *shader, enum shader_block block)
{
    bool is_member = block == BLOCK_LIGHT_DATA || block == BLOCK_VERTEX_DATA
                     || (block == BLOCK_OUTPUTS && shader->role->is_in_host_file);
    return is_member ? (uint32_t)block : NUM_BLOCKS;
}

/* 1 + index of the variable of this name and scope; 0: there is none. */
static uint32_t find(const struct shader *shader, uint32_t scope, str_id name)
{
    uint32_t hash = hash_pair(name, scope);
    for (uint32_t at = hash, found; (found = table_next(&shader->interface.names, hash, &at));) {
        assert(found <= shader->interface.variables.len);
        const struct shader_variable *variable = &shader->interface.variables.items[found - 1];
        if (variable->name == name && name_scope(shader, variable->block) == scope)
            return found;
    }
    return 0;
}

/* The names of a scope. The language is known before the first variable. */
static struct name_set *names_of(struct shader *shader, uint32_t scope)
{
    struct name_set *names = &shader->interface.taken[scope];
    if (!names->arena) {
        names_init(names, shader->arena, shader->style ? shader->style->syntax : NULL);
        if (scope != BLOCK_LIGHT_DATA)
            names->rules = scope == NUM_BLOCKS ? &shader->interface.naming
                                               : &shader->interface.naming_of_members;
        names_take_frame(names, shader);
    }
    return names;
}

bool shader_name_is_free(struct shader *shader, str_id name)
{
    return names_is_free(names_of(shader, NUM_BLOCKS), str_text(shader->strings, name),
                         str_len(shader->strings, name));
}

static str_id unique_name(struct shader *shader, uint32_t scope, str_id wanted)
{
    const char *text = str_text(shader->strings, wanted);
    struct spell_name name =
        names_unique(names_of(shader, scope), text, str_len(shader->strings, wanted));
    return name.text == text ? wanted : str_intern(shader->strings, name.text, name.len);
}

/* True if the file around the function declares the variable, because the host names it. */
static bool is_hosts(const struct shader *shader, const struct shader_variable *variable)
{
    bool is_private = variable->block == BLOCK_PRIVATE_UNIFORMS || variable->block >= BLOCK_OWN;
    bool may_be = is_private || (variable->block == BLOCK_TEXTURES && variable->semantic);
    return shader->role->is_in_host_file && may_be
           && names_renamed(&shader->interface.naming, str_text(shader->strings, variable->name),
                            str_len(shader->strings, variable->name));
}

uint32_t shader_add_variable(struct shader *shader, const struct shader_variable *variable)
{
    uint32_t scope = name_scope(shader, variable->block);
    str_id name = unique_name(shader, scope, variable->name);
    assert(!find(shader, scope, name));
    uint32_t index = shader->interface.variables.len;
    table_add(&shader->interface.names, shader->arena, hash_pair(name, scope), index + 1);
    vec_push(shader->arena, &shader->interface.variables, *variable);
    vec_last(&shader->interface.variables).is_hosts = is_hosts(shader, variable);
    vec_last(&shader->interface.variables).name = name;
    return index;
}

void shader_make_parameter(struct shader *shader, uint32_t variable, str_id name, str_id doc_type)
{
    uint32_t scope = name_scope(shader, BLOCK_PUBLIC_UNIFORMS);
    struct shader_variable *v = &shader->interface.variables.items[variable];
    assert(v->block == BLOCK_VERTEX_DATA);
    v->block = BLOCK_PUBLIC_UNIFORMS;
    v->name = unique_name(shader, scope, name);
    v->doc_type = doc_type;
    table_add(&shader->interface.names, shader->arena, hash_pair(v->name, scope), variable + 1);
}

uint32_t shader_output(struct shader *shader, str_id name, ir_type_id type)
{
    assert(type != IR_TYPE_BOOL);
    uint32_t found = shader_find_variable(shader, BLOCK_OUTPUTS, name);
    if (found != UINT32_MAX) {
        assert(shader->interface.variables.items[found].type == type);
        return found;
    }
    return shader_add_variable(
        shader, &(struct shader_variable){.name = name, .block = BLOCK_OUTPUTS, .type = type});
}

uint32_t shader_find_variable(const struct shader *shader, enum shader_block block, str_id name)
{
    uint32_t found = find(shader, name_scope(shader, block), name);
    return found && shader->interface.variables.items[found - 1].block == block ? found - 1
                                                                                : UINT32_MAX;
}

/*
 * The variable with the type that a stage reads: for arrays of built-in types, the type of an
 * element.
 */
ir_ref shader_read(struct shader *shader, uint32_t variable)
{
    assert(variable < shader->interface.variables.len);
    const struct shader_variable *v = &shader->interface.variables.items[variable];
    enum ir_op op = v->block == BLOCK_TEXTURES                                    ? IR_TEXTURE
                    : v->block == BLOCK_APP_DATA || v->block == BLOCK_VERTEX_DATA ? IR_STREAM
                                                                                  : IR_UNIFORM;
    ir_type_id type = v->array_length
                          ? (ir_type_id)ir_add_array(shader->graph, v->type, v->array_length)
                          : v->type;
    return ir_build(shader->graph, op, type, variable, NULL, 0);
}

/* ---- Variables by name ---- */

static uint32_t find_binding(const struct shader *shader, enum shader_block block, str_id asked,
                             ir_type_id scalar)
{
    uint32_t hash = hash_pair(asked, 0);
    for (uint32_t at = hash, found;
         (found = table_next(&shader->interface.binding_table, hash, &at));) {
        const struct shader_binding *binding = &shader->interface.bindings.items[found - 1];
        if (binding->asked == asked && binding->block == block && binding->scalar == scalar)
            return binding->variable;
    }
    return UINT32_MAX;
}

static ir_type_id scalar_of(ir_type_id type)
{
    return type < IR_NUM_TYPES ? ir_type_info(type)->scalar : type;
}

static uint32_t bind(struct shader *shader, const struct shader_variable *variable)
{
    uint32_t index = shader_add_variable(shader, variable);
    assert(find_binding(shader, variable->block, variable->name, scalar_of(variable->type))
           == UINT32_MAX);
    vec_push(
        shader->arena, &shader->interface.bindings,
        (struct shader_binding){variable->name, variable->block, scalar_of(variable->type), index});
    table_add(&shader->interface.binding_table, shader->arena, hash_pair(variable->name, 0),
              shader->interface.bindings.len);
    return index;
}

/* Textures have no place among the other uniforms. */
static enum shader_block uniform_block(ir_type_id type)
{
    return type == IR_TYPE_SAMPLER ? BLOCK_TEXTURES : BLOCK_PRIVATE_UNIFORMS;
}

uint32_t shader_global_variable(const struct shader *shader, uint32_t global_id)
{
    const struct lang_global *global = lang_global(shader->unit, global_id, NULL);
    if (global->kind == LANG_GLOBAL_UNIFORM)
        return find_binding(shader, uniform_block(global->type), global->name,
                            scalar_of(global->type));
    if (global->kind == LANG_GLOBAL_STREAM)
        return find_binding(shader, BLOCK_VERTEX_DATA, global->name, scalar_of(global->type));
    return UINT32_MAX;
}

/* ---- Uniforms ---- */

struct uniform_row {
    str_id semantic;
    ir_type_id type;
    float value;
};

static const struct uniform_row uniform_rows[] = {
#define HALF_TURN 2 /* around y: an environment map starts behind the viewer */
#define UNIFORM(name, TYPE, value) {STR_##name, IR_TYPE_##TYPE, value},
#include "shader/streams.def"
};
enum {
#define UNIFORM(name, TYPE, value) ROW_##name,
#include "shader/streams.def"
};

static const struct uniform_row *find_uniform(str_id name)
{
    switch (name) {
        /* clang-format takes the include for a part of the macro. */
// clang-format off
#define UNIFORM(name, TYPE, value) case STR_u_##name: return &uniform_rows[ROW_##name];
#include "shader/streams.def"
        // clang-format on
    default: return NULL;
    }
}

bool shader_knows_uniform(str_id name)
{
    return find_uniform(name) != NULL;
}

static str_id semantic_of(struct shader *shader, str_id name)
{
    const char *text = str_text(shader->strings, name);
    return strncmp(text, "u_", 2) == 0 ? str_intern_z(shader->strings, text + 2) : name;
}

static struct ir_value default_value(ir_type_id type, float number)
{
    struct ir_value value = {.type = type};
    const struct ir_type_info *info = ir_type_info(type);
    if (type == IR_TYPE_INT || type == IR_TYPE_UINT || type == IR_TYPE_BOOL) {
        value.w[0].i = (int32_t)number;
        return value;
    }
    uint32_t step = info->columns > 1 ? info->columns + 1u : 1;
    for (uint32_t i = 0; i < info->components; i += step)
        value.w[i].f = number;
    if (number == HALF_TURN) {
        static const float diagonal[] = {-1, 1, -1, 1};
        for (uint32_t i = 0; i < 4; i++)
            value.w[i * step].f = diagonal[i];
    }
    return value;
}

ir_type_id shader_uniform_type(str_id name)
{
    const struct uniform_row *row = find_uniform(name);
    return row ? row->type : IR_TYPE_VOID;
}

uint32_t shader_private_uniform(struct shader *shader, str_id name, ir_type_id type,
                                uint16_t array_length)
{
    const struct uniform_row *row = find_uniform(name);
    type = row ? row->type : type;
    enum shader_block block = uniform_block(type);
    uint32_t found = find_binding(shader, block, name, scalar_of(type));
    if (found != UINT32_MAX)
        return found;
    struct shader_variable variable = {
        .name = name, .block = (uint8_t)block, .type = type, .array_length = array_length};
    variable.rank = row ? (uint16_t)(row - uniform_rows + 1) : 0;
    if (variable.block == BLOCK_PRIVATE_UNIFORMS && variable.type < IR_NUM_TYPES && !array_length) {
        variable.has_default = true;
        variable.value = default_value(variable.type, row ? row->value : 0);
    }
    variable.semantic = row ? row->semantic : semantic_of(shader, name);
    return bind(shader, &variable);
}

enum shader_block shader_own_block(struct shader *shader, str_id name)
{
    for (int i = 0; i < MAX_OWN_BLOCKS; i++) {
        if (shader->interface.own_blocks[i] == name)
            return (enum shader_block)(BLOCK_OWN + i);
        if (shader->interface.own_blocks[i])
            continue;
        if (!shader_name_is_free(shader, name))
            return NUM_BLOCKS;
        names_take(names_of(shader, NUM_BLOCKS), str_text(shader->strings, name),
                   str_len(shader->strings, name));
        shader->interface.own_blocks[i] = name;
        return (enum shader_block)(BLOCK_OWN + i);
    }
    return NUM_BLOCKS;
}

uint32_t shader_own_uniform(struct shader *shader, enum shader_block block, str_id name,
                            ir_type_id type)
{
    assert(block >= BLOCK_OWN && block < NUM_BLOCKS && type != IR_TYPE_SAMPLER);
    uint32_t found = find_binding(shader, block, name, scalar_of(type));
    if (found != UINT32_MAX)
        return found;
    return bind(shader, &(struct shader_variable){.name = name,
                                                  .block = (uint8_t)block,
                                                  .type = type,
                                                  .has_default = true,
                                                  .value = default_value(type, 0),
                                                  .semantic = semantic_of(shader, name)});
}

uint32_t shader_asked_uniform(const struct shader *shader, str_id name)
{
    return find_binding(shader, BLOCK_PRIVATE_UNIFORMS, name, scalar_of(shader_uniform_type(name)));
}

/* The name of a member is its semantic, unless the language reserves the word. */
static uint32_t add_light_member(struct shader *shader, str_id name, ir_type_id type, bool binds)
{
    const struct shader_variable member = {.name = name, .block = BLOCK_LIGHT_DATA, .type = type};
    uint32_t added = binds ? bind(shader, &member) : shader_add_variable(shader, &member);
    struct shader_variable *variable = &shader->interface.variables.items[added];
    variable->semantic = variable->name == name ? 0 : name;
    return added;
}

uint32_t shader_light_member(struct shader *shader, str_id name, ir_type_id type)
{
    if (find_binding(shader, BLOCK_LIGHT_DATA, STR_type, IR_TYPE_INT) == UINT32_MAX)
        (void)add_light_member(shader, STR_type, IR_TYPE_INT, true);
    uint32_t found = find_binding(shader, BLOCK_LIGHT_DATA, name, scalar_of(type));
    if (found != UINT32_MAX && shader->interface.variables.items[found].type == type)
        return found;
    return add_light_member(shader, name, type, found == UINT32_MAX);
}

/* ---- Streams ---- */

enum stream_space { SPACE_OBJECT, SPACE_POINT, SPACE_VECTOR, SPACE_NORMAL, SPACE_BITANGENT };

struct stream_row {
    str_id name; /* 0: a family, which shares `attribute` with its attributes */
    ir_type_id type;
    const char *attribute;
    uint8_t space; /* enum stream_space */
};

static const struct stream_row stream_rows[] = {
#define STREAM(name, TYPE, attribute, SPACE) {STR_##name, IR_TYPE_##TYPE, attribute, SPACE_##SPACE},
#define FAMILY(name, TYPE) {0, IR_TYPE_##TYPE, name, SPACE_OBJECT},
#include "shader/streams.def"
};

/* *out_suffix receives the part after the name of the family. */
static const struct stream_row *find_stream(const struct shader *shader, str_id name,
                                            const char **out_suffix)
{
    *out_suffix = "";
    for (size_t i = 0; i < sizeof stream_rows / sizeof *stream_rows; i++) {
        const struct stream_row *row = &stream_rows[i];
        if (row->name && row->name != name)
            continue;
        if (row->name)
            return row;
        const char *text = str_text(shader->strings, name);
        size_t len = strlen(row->attribute);
        if (strncmp(text, row->attribute, len) == 0 && text[len]) {
            *out_suffix = text + len;
            return row;
        }
    }
    return NULL;
}

/* The type of a stream between stages: attributes and vertex data cannot be booleans. */
static ir_type_id carried_type(const struct stream_row *row, ir_type_id wanted)
{
    if (row->type != IR_TYPE_VOID)
        return row->type;
    return wanted == IR_TYPE_BOOL ? IR_TYPE_INT : wanted;
}

static str_id concat(struct shader *shader, const char *a, const char *b, const char *c)
{
    struct text text;
    text_init(&text, shader->arena);
    text_str(&text, a);
    text_str(&text, b);
    text_str(&text, c);
    return str_intern(shader->strings, text_cstr(&text), text.len);
}

/* "position:object", "normal:world", "texcoord:0", "geomprop:st". */
static str_id stream_semantic(struct shader *shader, const struct stream_row *row,
                              const char *suffix)
{
    if (*suffix) {
        struct text family;
        text_init(&family, shader->arena);
        text_mem(&family, row->attribute, strlen(row->attribute) - 1);
        return concat(shader, text_cstr(&family), ":", suffix);
    }
    const char *name = str_text(shader->strings, row->name);
    bool world = strstr(name, "World") != NULL;
    if (!world && !strstr(name, "Object"))
        return row->name;
    struct text what;
    text_init(&what, shader->arena);
    text_mem(&what, name, strlen(name) - (world ? 5 : 6));
    return concat(shader, text_cstr(&what), ":", world ? "world" : "object");
}

static bool is_flat(ir_type_id type)
{
    return scalar_of(type) == IR_TYPE_INT;
}

/* 1 + the first attribute with this semantic and type; 0: none. */
static uint32_t find_attribute(const struct shader *shader, str_id semantic, ir_type_id type)
{
    uint32_t hash = hash_pair(semantic, 0);
    for (uint32_t at = hash, found;
         (found = table_next(&shader->interface.attributes, hash, &at));) {
        const struct shader_variable *v = &shader->interface.variables.items[found - 1];
        if (v->semantic == semantic && v->type == type)
            return found;
    }
    return 0;
}

static ir_ref attribute(struct shader *shader, const struct stream_row *row, const char *suffix,
                        ir_type_id type)
{
    str_id name = concat(shader, "i_", row->attribute, suffix);
    uint32_t index = find_binding(shader, BLOCK_APP_DATA, name, scalar_of(type));
    if (index == UINT32_MAX) {
        struct shader_variable variable = {.name = name, .block = BLOCK_APP_DATA, .type = type};
        variable.rank = (uint16_t)(row - stream_rows);
        variable.semantic = *suffix ? stream_semantic(shader, row, suffix)
                                    : concat(shader, row->attribute, ":", "object");
        index = bind(shader, &variable);
        if (!find_attribute(shader, variable.semantic, type))
            table_add(&shader->interface.attributes, shader->arena, hash_pair(variable.semantic, 0),
                      index + 1);
    }
    return shader_read(shader, index);
}

bool shader_attribute(const struct shader *shader, uint32_t stream, uint32_t *out_index)
{
    assert(stream < shader->interface.variables.len);
    const struct shader_variable *variable = &shader->interface.variables.items[stream];
    uint32_t found = find_attribute(shader, variable->semantic, variable->type);
    *out_index = found - 1;
    return found != 0;
}

static ir_ref transform(struct shader *shader, str_id matrix, ir_ref vector, float w)
{
    struct ir_graph *graph = shader->graph;
    ir_ref m = shader_read(shader, shader_private_uniform(shader, matrix, IR_TYPE_MAT4, 0));
    ir_ref parts[] = {vector, ir_const_float(graph, w)};
    ir_ref v = ir_construct(graph, IR_TYPE_VEC4, parts, 2);
    return ir_build(graph, IR_MUL, IR_TYPE_VEC4, 0, (ir_ref[]){m, v}, 2);
}

static ir_ref xyz(struct ir_graph *graph, ir_ref v)
{
    return ir_swizzle(graph, v, (uint8_t[]){0, 1, 2}, 3);
}

/* The source streams of a stream have its suffix: "normalWorld" for "bitangentWorld". */
static ir_ref vertex_expression(struct shader *shader, const struct stream_row *row,
                                const char *suffix, ir_type_id type)
{
    struct ir_graph *graph = shader->graph;
    if (row->space == SPACE_BITANGENT) {
        ir_ref normal = shader_vertex_stream(shader, concat(shader, "normal", row->attribute, ""),
                                             IR_TYPE_VOID);
        ir_ref tangent = shader_vertex_stream(shader, concat(shader, "tangent", row->attribute, ""),
                                              IR_TYPE_VOID);
        return ir_op2(graph, IR_CROSS, normal, tangent);
    }
    ir_ref a = attribute(shader, row, suffix, type);
    switch ((enum stream_space)row->space) {
    case SPACE_POINT: {
        ir_ref point = transform(shader, STR_u_worldMatrix, a, 1);
        ir_suggest_name(graph, point, STR_positionWorld, IR_NAME_ROLE);
        return xyz(graph, point);
    }
    case SPACE_VECTOR:
        return ir_op1(graph, IR_NORMALIZE, xyz(graph, transform(shader, STR_u_worldMatrix, a, 0)));
    case SPACE_NORMAL:
        return ir_op1(graph, IR_NORMALIZE,
                      xyz(graph, transform(shader, STR_u_worldInverseTransposeMatrix, a, 0)));
    default: return a;
    }
}

/* Converts the carried value to the requested type. */
static ir_ref as_wanted(struct ir_graph *graph, ir_ref value, ir_type_id wanted)
{
    ir_type_id type = ir_type_of(graph, value);
    if (wanted == IR_TYPE_VOID || wanted == type)
        return value;
    unsigned have = ir_type_info(type)->components, want = ir_type_info(wanted)->components;
    if (want == have)
        return ir_convert(graph, wanted, value);
    if (want > have) {
        ir_ref parts[4] = {value};
        for (unsigned i = have; i < want; i++)
            parts[i - have + 1] = ir_const_float(graph, 0);
        return ir_construct(graph, wanted, parts, want - have + 1);
    }
    return ir_swizzle(graph, value, (uint8_t[]){0, 1, 2, 3}, want);
}

ir_ref shader_vertex_stream(struct shader *shader, str_id name, ir_type_id type)
{
    const char *suffix;
    const struct stream_row *row = find_stream(shader, name, &suffix);
    if (!row || (row->type == IR_TYPE_VOID && type == IR_TYPE_VOID))
        return 0;
    return as_wanted(shader->graph, vertex_expression(shader, row, suffix, carried_type(row, type)),
                     type);
}

ir_ref shader_stream(struct shader *shader, str_id name, ir_type_id type)
{
    const char *suffix;
    const struct stream_row *row = find_stream(shader, name, &suffix);
    if (!row || (row->type == IR_TYPE_VOID && type == IR_TYPE_VOID))
        return 0;
    ir_type_id carried = carried_type(row, type);
    uint32_t index = find_binding(shader, BLOCK_VERTEX_DATA, name, scalar_of(carried));
    if (index == UINT32_MAX) {
        struct shader_variable variable = {
            .name = name, .block = BLOCK_VERTEX_DATA, .type = carried};
        variable.rank = (uint16_t)(row - stream_rows);
        variable.flat = is_flat(carried);
        variable.semantic = stream_semantic(shader, row, suffix);
        index = bind(shader, &variable);
        ir_push_name(shader->graph, name); /* a local of the vertex stage */
        ir_ref value = vertex_expression(shader, row, suffix, carried);
        ir_pop_origin(shader->graph);
        shader_effect(shader, STAGE_VERTEX,
                      (struct effect){.kind = EFFECT_OUTPUT, .index = index, .value = value});
    }
    return as_wanted(shader->graph, shader_read(shader, index), type);
}

/* The variable that carries this value already; UINT32_MAX: there is none. */
static uint32_t find_computed(const struct shader *shader, ir_ref value)
{
    const struct effect_list *effects = &shader->stages[STAGE_VERTEX].effects;
    for (uint32_t i = 0; i < effects->len; i++)
        if (effects->items[i].kind == EFFECT_OUTPUT && effects->items[i].value == value
            && shader->interface.variables.items[effects->items[i].index].is_computed)
            return effects->items[i].index;
    return UINT32_MAX;
}

ir_ref shader_at_vertices(struct shader *shader, ir_ref value)
{
    const struct effect_list *effects = &shader->stages[STAGE_VERTEX].effects;
    for (uint32_t i = effects->len; i-- > 0;) { /* vertex data may read earlier ones */
        const struct effect *effect = &effects->items[i];
        if (effect->kind != EFFECT_OUTPUT)
            continue;
        ir_suggest_name(shader->graph, effect->value,
                        shader->interface.variables.items[effect->index].name, IR_NAME_ROLE);
        value = ir_replace(shader->graph, value, shader_read(shader, effect->index), effect->value,
                           shader->arena);
    }
    return value;
}

ir_ref shader_interpolate(struct shader *shader, str_id name, ir_ref value)
{
    ir_type_id type = ir_type_of(shader->graph, value);
    value = shader_at_vertices(shader, value);
    uint32_t index = find_computed(shader, value);
    assert(ir_type_info(type)->scalar != IR_TYPE_BOOL && !ir_type_is_matrix(type));
    if (index == UINT32_MAX) {
        struct shader_variable variable = {.name = name,
                                           .block = BLOCK_VERTEX_DATA,
                                           .type = type,
                                           .flat = ir_type_info(type)->scalar != IR_TYPE_FLOAT,
                                           .is_computed = true,
                                           .rank = UINT16_MAX,
                                           .semantic = name};
        index = shader_add_variable(shader, &variable);
        shader_effect(shader, STAGE_VERTEX,
                      (struct effect){.kind = EFFECT_OUTPUT, .index = index, .value = value});
    }
    return shader_read(shader, index);
}

void shader_effect(struct shader *shader, enum shader_stage_id stage, struct effect effect)
{
    assert(effect.value < shader->graph->nodes.len);
    vec_push(shader->arena, &shader->stages[stage].effects, effect);
}

void shader_add_closure(struct shader *shader, ir_ref leaf)
{
    vec_push(shader->arena, &shader->reflection.closures, ir_get(shader->graph, leaf)->origin);
}

uint32_t shader_add_local(struct shader *shader, str_id name, ir_type_id type)
{
    vec_push(shader->arena, &shader->effects.locals,
             (struct shader_local){.name = name, .type = type});
    return shader->effects.locals.len - 1;
}
