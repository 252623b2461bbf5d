// SPDX-License-Identifier: Apache-2.0
/*
 * The parameters of a shader with their metadata, its streams and outputs, and the locals at its
 * beginning.
 *
 * A stream that OSL provides is an expression; any other is a parameter with lockgeom=0, which
 * renderers fill from the primitive variable of that name. Streams of two and four components are
 * arrays in the parameter list, because renderers do not fill structs. A property whose name no
 * parameter can have, such as one with a second default, is a local that asks for it by
 * getattribute (OSL specification, "Renderer state and message passing").
 */
#include "generators/osl/osl.h"

enum row_kind { VARIABLE, EXPRESSION };

struct known_row {
    const char *name, *text;
    enum row_kind kind;
};

static const struct known_row stream_rows[] = {
#define STREAM(name, kind, text) {name, text, kind},
#include "generators/osl/streams.def"
};

static const struct known_row uniform_rows[] = {
#define UNIFORM(semantic, kind, text) {semantic, text, kind},
#include "generators/osl/streams.def"
};

static const struct known_row *find_row(const struct known_row *rows, size_t count,
                                        const char *name)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(rows[i].name, name) == 0)
            return &rows[i];
    return NULL;
}

static const char *text_of(const struct osl *osl, str_id id)
{
    return str_text(osl->spell->shader->strings, id);
}

/* The row of OSL's expression for a variable; NULL: it is a parameter. */
static const struct known_row *known_of(const struct osl *osl,
                                        const struct shader_variable *variable)
{
    if (variable->block == BLOCK_VERTEX_DATA)
        return find_row(stream_rows, sizeof stream_rows / sizeof *stream_rows,
                        text_of(osl, variable->name));
    if (variable->block == BLOCK_PRIVATE_UNIFORMS)
        return find_row(uniform_rows, sizeof uniform_rows / sizeof *uniform_rows,
                        text_of(osl, variable->semantic));
    return NULL;
}

/* "st" for the stream "geomprop_st": the name of the primitive variable. */
static const char *primitive_name(const char *stream)
{
    return strncmp(stream, "geomprop_", 9) == 0      ? stream + 9
           : strncmp(stream, "u_geomprop_", 11) == 0 ? stream + 11
           : strncmp(stream, "u_", 2) == 0           ? stream + 2
                                                     : stream;
}

/* The name of the geometric property that a variable stands for; NULL: it stands for none. */
static const char *property_of(const struct osl *osl, const struct shader_variable *variable)
{
    static const char family[] = "geomprop";
    const char *semantic = variable->semantic ? text_of(osl, variable->semantic) : "";
    size_t len = sizeof family - 1;
    bool is_property =
        strncmp(semantic, family, len) == 0 && (semantic[len] == ':' || semantic[len] == '_');
    return is_property ? semantic + len + 1 : NULL;
}

/*
 * True for the closure result of surfaces and volumes, which is OSL's variable Ci. Closures of AOVs
 * are parameters.
 */
static bool is_result(const struct osl *osl, const struct shader_variable *variable)
{
    return variable->block == BLOCK_OUTPUTS && ir_type_is_closure(variable->type)
           && !variable->semantic && osl->spell->shader->reflection.kind != SHADER_VALUE;
}

static unsigned array_length(const struct shader_variable *variable)
{
    return variable->type == IR_TYPE_VEC2 ? 2 : variable->type == IR_TYPE_VEC4 ? 4 : 0;
}

static bool is_stream(const struct osl *osl, const struct shader_variable *variable)
{
    if (variable->block == BLOCK_TEXTURES)
        return property_of(osl, variable) != NULL;
    return variable->block == BLOCK_VERTEX_DATA
           || (shader_block_has_uniforms((enum shader_block)variable->block)
               && variable->block != BLOCK_PUBLIC_UNIFORMS);
}

/* "st_value": the struct that receives the array. */
static const char *value_name(struct spell *spell, const char *stream)
{
    struct text name;
    text_init(&name, spell->scratch);
    text_fmt(&name, "%s_value", primitive_name(stream));
    return names_unique(&spell->names, text_cstr(&name), name.len).text;
}

void osl_name_interface(struct osl *osl)
{
    struct spell *spell = osl->spell;
    osl->arrays = ARENA_ARRAY(spell->scratch, const char *, spell->shader->interface.used.len);
    for (uint32_t i = 0; i < spell->shader->interface.used.len; i++) {
        const struct shader_variable *variable = spell_interface_variable(osl->spell, i);
        const char *name = text_of(osl, variable->name);
        const struct known_row *known = known_of(osl, variable);
        if (is_stream(osl, variable) && !known && array_length(variable))
            osl->arrays[i] =
                names_unique(&spell->names, primitive_name(name), strlen(primitive_name(name)))
                    .text;
        else if (is_stream(osl, variable) && !known)
            name = primitive_name(name);
        if (is_result(osl, variable))
            name = "Ci";
        else if (known && known->kind == VARIABLE)
            name = known->text;
        else if (osl->arrays[i])
            name = value_name(spell, name);
        else if (is_stream(osl, variable))
            name = names_unique(&spell->names, primitive_name(name), strlen(primitive_name(name)))
                       .text;
        spell->variables[spell->shader->interface.used.items[i]] =
            (struct spell_name){name, strlen(name)};
    }
}

/* Functions do not see the shader's locals, so they get expressions. */
const char *osl_global_name(void *user_data, uint32_t id)
{
    struct spell *spell = user_data;
    struct osl *osl = spell->target_data;
    uint32_t index = shader_global_variable(spell->shader, id);
    osl->read[id] = true;
    if (index == UINT32_MAX)
        return NULL;
    const struct shader_variable *variable = &spell->shader->interface.variables.items[index];
    const struct known_row *known = known_of(osl, variable);
    osl_type(osl, variable->type);
    if (!known || known->kind == VARIABLE)
        return spell->variables[index].text;
    struct text text;
    text_init(&text, spell->scratch);
    text_fmt(&text, strchr(known->text, ' ') ? "(%s)" : "%s", known->text);
    return text_cstr(&text);
}

/* ---- Parameters ---- */

static const char *type_name(struct osl *osl, const struct shader_variable *variable)
{
    bool is_color = variable->type == IR_TYPE_VEC3 && variable->doc_type == STR_color3;
    return is_color ? "color" : osl_type(osl, variable->type);
}

/* "0.5", "1": numbers as people write initial values. */
static void write_number(struct spell *spell, union ir_word word)
{
    struct text number;
    text_init(&number, spell->scratch);
    lang_print_value(spell->style, NULL, IR_TYPE_FLOAT, &word, LANG_PREC_COMMA, &number);
    bool is_whole = number.len > 2 && memcmp(number.data + number.len - 2, ".0", 2) == 0;
    text_mem(spell->out, number.data, number.len - (is_whole ? 2 : 0));
}

/* "a, b, c" */
static void write_numbers(struct spell *spell, const union ir_word *words, unsigned count)
{
    for (unsigned i = 0; i < count; i++) {
        spell_text(spell, i ? ", " : "");
        write_number(spell, words[i]);
    }
}

/* "color(0.8, 0.2, 0.1)", or one number for all three components. */
static void write_triple(struct osl *osl, const struct shader_variable *variable,
                         const union ir_word *words)
{
    struct spell *spell = osl->spell;
    if (words[0].u == words[1].u && words[0].u == words[2].u) {
        write_number(spell, words[0]);
        return;
    }
    SPELL(spell, type_name(osl, variable), "(");
    write_numbers(spell, words, 3);
    spell_text(spell, ")");
}

static void write_default(struct osl *osl, const struct shader_variable *variable)
{
    struct spell *spell = osl->spell;
    struct ir_value value = variable->value;
    if (!variable->has_default)
        value = (struct ir_value){.type = variable->type};
    if (variable->type == IR_TYPE_SAMPLER) {
        text_json_string(spell->out, text_of(osl, variable->file),
                         strlen(text_of(osl, variable->file)));
    } else if (ir_type_is_closure(variable->type)) {
        spell_text(spell, "0");
    } else if (variable->type == IR_TYPE_FLOAT) {
        write_number(spell, value.w[0]);
    } else if (variable->type == IR_TYPE_VEC3) {
        write_triple(osl, variable, value.w);
    } else if (array_length(variable)) {
        spell_text(spell, "{");
        write_numbers(spell, value.w, array_length(variable));
        spell_text(spell, "}");
    } else {
        lang_print_value(spell->style, spell->shader->strings, value.type, value.w, LANG_PREC_COMMA,
                         spell->out);
    }
}

static void next_parameter(struct spell *spell, unsigned *count)
{
    spell_text(spell, (*count)++ ? ",\n    " : "(\n    ");
}

static void write_inputs(struct osl *osl, enum shader_block block, unsigned *count)
{
    struct spell *spell = osl->spell;
    for (uint32_t i = 0; i < spell->shader->interface.used.len; i++) {
        const struct shader_variable *variable = spell_interface_variable(osl->spell, i);
        if (variable->block != block || !osl_is_read(osl, variable) || is_stream(osl, variable))
            continue;
        next_parameter(spell, count);
        SPELL(spell, type_name(osl, variable), " ", text_of(osl, variable->name), " = ");
        write_default(osl, variable);
        osl_write_metadata(osl, variable);
    }
}

/* The variable that a renderer fills: the array of a stream of two or four components, or itself.
 */
static const char *filled_name(const struct osl *osl, uint32_t place)
{
    const struct spell *spell = osl->spell;
    return osl->arrays[place] ? osl->arrays[place]
                              : spell->variables[spell->shader->interface.used.items[place]].text;
}

/* The property that a local asks for, because no parameter has its name; NULL: it is no local. */
static const char *asked_property(const struct osl *osl, uint32_t place)
{
    const struct shader_variable *variable = spell_interface_variable(osl->spell, place);
    const char *property = is_stream(osl, variable) ? property_of(osl, variable) : NULL;
    return property && strcmp(property, filled_name(osl, place)) != 0 ? property : NULL;
}

/* "float st[2] = {0, 0}" */
static void write_stream(struct osl *osl, uint32_t place)
{
    struct spell *spell = osl->spell;
    const struct shader_variable *variable = spell_interface_variable(spell, place);
    SPELL(spell, array_length(variable) ? "float" : type_name(osl, variable), " ",
          filled_name(osl, place));
    if (array_length(variable)) {
        spell_text(spell, "[");
        spell_number(spell, array_length(variable));
        spell_text(spell, "]");
    }
    spell_text(spell, " = ");
    write_default(osl, variable);
}

static void write_stream_parameters(struct osl *osl, unsigned *count)
{
    struct spell *spell = osl->spell;
    for (uint32_t i = 0; i < spell->shader->interface.used.len; i++) {
        const struct shader_variable *variable = spell_interface_variable(osl->spell, i);
        if (!is_stream(osl, variable) || !osl_is_read(osl, variable) || known_of(osl, variable)
            || asked_property(osl, i))
            continue;
        next_parameter(spell, count);
        write_stream(osl, i);
        spell_text(spell, " [[ int lockgeom = 0 ]]");
    }
}

static void write_outputs(struct osl *osl, unsigned *count)
{
    struct spell *spell = osl->spell;
    for (uint32_t i = 0; i < spell->shader->interface.used.len; i++) {
        const struct shader_variable *variable = spell_interface_variable(osl->spell, i);
        if (variable->block != BLOCK_OUTPUTS || !osl_is_read(osl, variable)
            || is_result(osl, variable))
            continue;
        next_parameter(spell, count);
        SPELL(spell, "output ", type_name(osl, variable), " ", text_of(osl, variable->name), " = ");
        write_default(osl, variable);
    }
}

void osl_write_parameters(struct osl *osl)
{
    unsigned count = 0;
    write_inputs(osl, BLOCK_PUBLIC_UNIFORMS, &count);
    write_inputs(osl, BLOCK_TEXTURES, &count);
    write_stream_parameters(osl, &count);
    write_outputs(osl, &count);
    spell_text(osl->spell, count ? ")\n" : "()\n");
}

static void write_vector(struct osl *osl, uint32_t place)
{
    struct spell *spell = osl->spell;
    const struct shader_variable *variable = spell_interface_variable(spell, place);
    SPELL(spell, osl_type(osl, variable->type), "(");
    for (unsigned k = 0; k < array_length(variable); k++) {
        SPELL(spell, k ? ", " : "", osl->arrays[place], "[");
        spell_number(spell, k);
        spell_text(spell, "]");
    }
    spell_text(spell, ");\n");
}

static void write_question(struct osl *osl, uint32_t place, const char *property)
{
    struct spell *spell = osl->spell;
    spell_text(spell, "    ");
    write_stream(osl, place);
    spell_text(spell, ";\n    getattribute(");
    text_json_string(spell->out, property, strlen(property));
    SPELL(spell, ", ", filled_name(osl, place), ");\n");
}

void osl_write_streams(struct osl *osl)
{
    struct spell *spell = osl->spell;
    for (uint32_t i = 0; i < spell->shader->interface.used.len; i++) {
        const struct shader_variable *variable = spell_interface_variable(osl->spell, i);
        const struct known_row *known = known_of(osl, variable);
        const char *name = spell->variables[spell->shader->interface.used.items[i]].text,
                   *property = known ? NULL : asked_property(osl, i);
        bool is_local = known ? known->kind == EXPRESSION : array_length(variable) > 0;
        if (!is_stream(osl, variable) || !osl_is_read(osl, variable))
            continue;
        if (property)
            write_question(osl, i, property);
        if (!is_local)
            continue;
        SPELL(spell, "    ", type_name(osl, variable), " ", name, " = ");
        if (known)
            SPELL(spell, known->text, ";\n");
        else
            write_vector(osl, i);
    }
}
