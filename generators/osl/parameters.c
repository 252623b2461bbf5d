// SPDX-License-Identifier: Apache-2.0
/*
 * What stands between the parentheses of a shader, and the locals at its beginning: parameters with metadata, streams, outputs.
 *
 * A stream that OSL knows is an expression; any other is a parameter with lockgeom=0, which renderers fill from the primitive's variable
 * of that name. Those of two and four components are arrays there, since renderers do not fill structs.
 */
#include "generators/osl/osl.h"

struct expression_row {
    const char *name, *expression;
};

static const struct expression_row stream_rows[] = {
#define STREAM(name, expression) {name, expression},
#include "generators/osl/streams.def"
};

static const struct expression_row uniform_rows[] = {
#define UNIFORM(semantic, expression) {semantic, expression},
#include "generators/osl/streams.def"
};

static const char *find_row(const struct expression_row *rows, size_t count, const char *name)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(rows[i].name, name) == 0)
            return rows[i].expression;
    return NULL;
}

static const struct shader_variable *interface_variable(const struct osl *osl, uint32_t i)
{
    return &osl->spell->shader->variables.items[osl->spell->shader->interface.items[i]];
}

static const char *text_of(const struct osl *osl, str_id id)
{
    return str_text(osl->spell->shader->strings, id);
}

/* The OSL expression that gives a variable; NULL: it is a parameter. */
static const char *expression_of(const struct osl *osl, const struct shader_variable *variable)
{
    if (variable->block == BLOCK_VERTEX_DATA)
        return find_row(stream_rows, sizeof stream_rows / sizeof *stream_rows, text_of(osl, variable->name));
    if (variable->block == BLOCK_PRIVATE_UNIFORMS)
        return find_row(uniform_rows, sizeof uniform_rows / sizeof *uniform_rows, text_of(osl, variable->semantic));
    return NULL;
}

static bool is_read(const struct osl *osl, const struct shader_variable *variable)
{
    return variable->stages >> osl->spell->stage_id & 1;
}

/* "st" of the stream "geomprop_st": the name of the primitive's variable. */
static const char *primitive_name(const char *stream)
{
    return strncmp(stream, "geomprop_", 9) == 0 ? stream + 9 : strncmp(stream, "u_geomprop_", 11) == 0 ? stream + 11
           : strncmp(stream, "u_", 2) == 0 ? stream + 2 : stream;
}

/* The closure that surfaces and volumes end in is a variable of OSL. */
static bool is_result(const struct osl *osl, const struct shader_variable *variable)
{
    return variable->block == BLOCK_OUTPUTS && ir_type_is_closure(variable->type) && osl->spell->shader->kind != SHADER_VALUE;
}

static unsigned array_length(const struct shader_variable *variable)
{
    return variable->type == IR_TYPE_VEC2 ? 2 : variable->type == IR_TYPE_VEC4 ? 4 : 0;
}

static bool is_stream(const struct shader_variable *variable)
{
    return variable->block == BLOCK_VERTEX_DATA || variable->block == BLOCK_PRIVATE_UNIFORMS;
}

/* P, dPdu: a variable of every shader, which needs no other name. */
static bool is_global(const char *expression)
{
    return strlen(expression) <= 4 && !strpbrk(expression, "( ");
}

/* "st_value": the struct that an array is put into. */
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
    osl->arrays = ARENA_ARRAY(spell->scratch, const char *, spell->shader->interface.len);
    for (uint32_t i = 0; i < spell->shader->interface.len; i++) {
        const struct shader_variable *variable = interface_variable(osl, i);
        const char *name = text_of(osl, variable->name);
        const char *expression = expression_of(osl, variable);
        if (is_stream(variable) && !expression && array_length(variable))
            osl->arrays[i] = names_unique(&spell->names, primitive_name(name), strlen(primitive_name(name))).text;
        else if (is_stream(variable) && !expression)
            name = primitive_name(name);
        if (is_result(osl, variable))
            name = "Ci";
        else if (expression && is_global(expression))
            name = expression;
        else if (osl->arrays[i])
            name = value_name(spell, name);
        else if (is_stream(variable))
            name = names_unique(&spell->names, name, strlen(name)).text;
        spell->variables[spell->shader->interface.items[i]] = (struct spell_name){name, strlen(name)};
    }
}

/* Functions do not see the shader's locals: they have expressions for them. */
const char *osl_global_name(void *user_data, uint32_t id)
{
    struct spell *spell = user_data;
    const struct osl *osl = spell->target_data;
    uint32_t index = shader_global_variable(spell->shader, id);
    if (index == UINT32_MAX)
        return NULL;
    const char *expression = expression_of(osl, &spell->shader->variables.items[index]);
    if (!expression || is_global(expression))
        return spell->variables[index].text;
    struct text text;
    text_init(&text, spell->scratch);
    text_fmt(&text, strchr(expression, ' ') ? "(%s)" : "%s", expression);
    return text_cstr(&text);
}

/* ---- Metadata ---- */

static void write_string(struct spell *spell, const char *text)
{
    text_json_string(spell->out, text, strlen(text));
}

/* "[[ " or ", " in front of the next piece. */
static void open_piece(struct spell *spell, unsigned *count)
{
    spell_text(spell, (*count)++ ? ", " : " [[ ");
}

static void write_hint(struct spell *spell, const char *name, const char *text, unsigned *count)
{
    if (!text || !*text)
        return;
    open_piece(spell, count);
    SPELL(spell, "string ", name, " = ");
    write_string(spell, text);
}

static void write_limit(struct spell *spell, const char *name, const char *text, ir_type_id type, unsigned *count)
{
    bool is_scalar = type == IR_TYPE_FLOAT || type == IR_TYPE_INT;
    if (!text || !*text || !is_scalar)
        return;
    open_piece(spell, count);
    SPELL(spell, type == IR_TYPE_INT ? "int " : "float ", name, " = ");
    size_t len = strlen(text);
    while (strchr(text, '.') && len > 1 && (text[len - 1] == '0' || text[len - 1] == '.') && text[len - 2] != '-')
        if (text[--len] == '.') /* "1.0" is 1 */
            break;
    text_mem(spell->out, text, len);
}

/* A label that only says the name again, "Base Color" of base_color, is what user interfaces make of the name themselves. */
static bool says_name(const char *label, const char *name)
{
    for (; *label && *name; label++, name++)
        if ((*label == ' ' ? '_' : *label | 0x20) != (*name == '_' ? '_' : *name | 0x20))
            return false;
    return *label == *name;
}

static void write_label(struct spell *spell, const char *name, const char *label, unsigned *count)
{
    if (label && !says_name(label, name))
        write_hint(spell, "label", label, count);
}

/* Of colours and images; those in the working space need no word. */
static const char *colorspace_of(const struct osl *osl, const struct shader_variable *variable)
{
    const char *space = text_of(osl, variable->colorspace), *type = text_of(osl, variable->doc_type);
    bool has_space = strcmp(type, "color3") == 0 || strcmp(type, "color4") == 0 || variable->type == IR_TYPE_SAMPLER;
    const char *working = osl->spell->options->colorspace;
    return has_space && !(working && strcmp(space, working) == 0) ? space : NULL;
}

static const char *first_of(const char *a, const char *b)
{
    return a && *a ? a : b;
}

/* "a:0|b:1" of the words "a, b" and the values "0, 1", which count from 0 where there are none. */
static void write_choices(struct spell *spell, const char *names, const char *values, unsigned *count)
{
    open_piece(spell, count);
    spell_text(spell, "string widget = \"mapper\", string options = \"");
    for (unsigned i = 0; *names; i++) {
        size_t n = strcspn(names, ","), m = strcspn(values, ",");
        spell_text(spell, i ? "|" : "");
        text_mem(spell->out, names, n);
        text_char(spell->out, ':');
        if (*values)
            text_mem(spell->out, values, m);
        else
            spell_number(spell, i);
        names += n + (names[n] == ',');
        names += strspn(names, " ");
        values += m + (values[m] == ',');
        values += strspn(values, " ");
    }
    spell_text(spell, "\"");
}

static void write_widget(struct spell *spell, const struct shader_variable *variable, const struct shader_ui *ui, unsigned *count)
{
    bool has_choices = variable->type == IR_TYPE_INT && ui->enum_names && *ui->enum_names;
    if (has_choices)
        write_choices(spell, ui->enum_names, ui->enum_values ? ui->enum_values : "", count);
    else
        write_hint(spell, "widget", variable->type == IR_TYPE_BOOL      ? "checkBox"
                                    : variable->type == IR_TYPE_SAMPLER ? "filename"
                                                                        : NULL, count);
}

static void write_metadata(struct osl *osl, const struct shader_variable *variable)
{
    struct spell *spell = osl->spell;
    struct shader_ui ui = {0};
    unsigned count = 0;
    if (spell->options->metadata == 0)
        return;
    if (spell->options->ui)
        spell->options->ui(spell->options->user_data, variable, &ui);
    write_label(spell, text_of(osl, variable->name), ui.name, &count);
    write_hint(spell, "page", ui.folder, &count);
    write_limit(spell, "min", first_of(ui.soft_min, ui.min), variable->type, &count);
    write_limit(spell, "max", first_of(ui.soft_max, ui.max), variable->type, &count);
    write_widget(spell, variable, &ui, &count);
    write_hint(spell, "colorspace", colorspace_of(osl, variable), &count);
    if (spell->options->metadata > 1)
        write_hint(spell, "help", ui.doc, &count);
    if (count)
        spell_text(spell, " ]]");
}

/* ---- Parameters ---- */

static const char *type_name(const struct osl *osl, const struct shader_variable *variable)
{
    if (variable->type == IR_TYPE_VEC3 && strcmp(text_of(osl, variable->doc_type), "color3") == 0)
        return "color";
    return lang_syntax_type(osl->spell->target->syntax, variable->type);
}

static void write_default(struct osl *osl, const struct shader_variable *variable)
{
    struct spell *spell = osl->spell;
    struct ir_value value = variable->value;
    if (variable->type == IR_TYPE_SAMPLER) {
        write_string(spell, text_of(osl, variable->file));
        return;
    }
    if (ir_type_is_closure(variable->type)) {
        spell_text(spell, "0");
        return;
    }
    if (!variable->has_default)
        value = (struct ir_value){.type = variable->type};
    bool is_struct = array_length(variable) != 0;
    if (variable->type == IR_TYPE_VEC3) {
        struct text vector;
        text_init(&vector, spell->scratch);
        lang_print_value(spell->style, NULL, value.type, value.w, LANG_PREC_COMMA, &vector);
        SPELL(spell, type_name(osl, variable), text_cstr(&vector) + strlen("vector"));
    } else if (is_struct) { /* {x, y} */
        for (unsigned i = 0; i < array_length(variable); i++) {
            spell_text(spell, i ? ", " : "{");
            lang_print_value(spell->style, NULL, IR_TYPE_FLOAT, &value.w[i], LANG_PREC_COMMA, spell->out);
        }
        spell_text(spell, "}");
    } else {
        lang_print_value(spell->style, spell->shader->strings, value.type, value.w, LANG_PREC_COMMA, spell->out);
    }
}

static void next_parameter(struct spell *spell, unsigned *count)
{
    spell_text(spell, (*count)++ ? ",\n    " : "(\n    ");
}

static void write_inputs(struct osl *osl, enum shader_block block, unsigned *count)
{
    struct spell *spell = osl->spell;
    for (uint32_t i = 0; i < spell->shader->interface.len; i++) {
        const struct shader_variable *variable = interface_variable(osl, i);
        if (variable->block != block || !is_read(osl, variable))
            continue;
        next_parameter(spell, count);
        SPELL(spell, type_name(osl, variable), " ", text_of(osl, variable->name), " = ");
        write_default(osl, variable);
        write_metadata(osl, variable);
    }
}

static void write_stream_parameters(struct osl *osl, unsigned *count)
{
    struct spell *spell = osl->spell;
    for (uint32_t i = 0; i < spell->shader->interface.len; i++) {
        const struct shader_variable *variable = interface_variable(osl, i);
        if (!is_stream(variable) || !is_read(osl, variable) || expression_of(osl, variable))
            continue;
        next_parameter(spell, count);
        if (array_length(variable)) {
            SPELL(spell, "float ", osl->arrays[i], "[");
            spell_number(spell, array_length(variable));
            spell_text(spell, "] = ");
        } else {
            SPELL(spell, type_name(osl, variable), " ", spell->variables[spell->shader->interface.items[i]].text, " = ");
        }
        write_default(osl, variable);
        spell_text(spell, " [[ int lockgeom = 0 ]]");
    }
}

static void write_outputs(struct osl *osl, unsigned *count)
{
    struct spell *spell = osl->spell;
    for (uint32_t i = 0; i < spell->shader->interface.len; i++) {
        const struct shader_variable *variable = interface_variable(osl, i);
        if (variable->block != BLOCK_OUTPUTS || !is_read(osl, variable) || is_result(osl, variable))
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

void osl_write_streams(struct osl *osl)
{
    struct spell *spell = osl->spell;
    for (uint32_t i = 0; i < spell->shader->interface.len; i++) {
        const struct shader_variable *variable = interface_variable(osl, i);
        const char *expression = expression_of(osl, variable), *name = spell->variables[spell->shader->interface.items[i]].text;
        bool is_local = expression ? !is_global(expression) : array_length(variable) > 0;
        if (!is_stream(variable) || !is_read(osl, variable) || !is_local)
            continue;
        SPELL(spell, "    ", type_name(osl, variable), " ", name, " = ");
        if (expression) {
            SPELL(spell, expression, ";\n");
            continue;
        }
        SPELL(spell, lang_syntax_type(spell->target->syntax, variable->type), "(");
        for (unsigned k = 0; k < array_length(variable); k++) {
            SPELL(spell, k ? ", " : "", osl->arrays[i], "[");
            spell_number(spell, k);
            spell_text(spell, "]");
        }
        spell_text(spell, ");\n");
    }
}
