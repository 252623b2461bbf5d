// SPDX-License-Identifier: Apache-2.0
/*
 * The frame of a material: what it reads of the renderer's state, its parameters, and its parts,
 * which stand in a `let`.
 */
#include "generators/mdl/mdl.h"

const char *const mdl_part_names[NUM_MDL_PARTS] = {
#define PART(id, TYPE, text) text,
#include "generators/mdl/parts.def"
#undef PART
};

static const char *text_of(const struct spell *spell, str_id id)
{
    return str_text(spell->shader->strings, id);
}

/* ---- What the renderer knows ---- */

struct known {
    const char *name, *call, *declaration;
};

static const struct known streams[] = {
#define STREAM(...) {__VA_ARGS__},
#include "generators/mdl/streams.def"
};
static const struct known uniforms[] = {
#define UNIFORM(...) {__VA_ARGS__},
#include "generators/mdl/streams.def"
};
static const struct known helpers[] = {
#define HELPER(name, declaration) {name, NULL, declaration},
#include "generators/mdl/streams.def"
};

#define FIND(rows, name) find((rows), sizeof(rows) / sizeof *(rows), (name))
static const struct known *find(const struct known *rows, size_t n, const char *name)
{
    for (size_t i = 0; i < n; i++)
        if (strcmp(rows[i].name, name) == 0)
            return &rows[i];
    return NULL;
}

/* The helpers whose names the text so far has. */
static void use_helpers(struct spell *spell)
{
    const char *text = text_cstr(spell->out);
    for (size_t i = 0; i < sizeof helpers / sizeof *helpers; i++) {
        const char *at = strstr(text, helpers[i].name);
        if (at && at[strlen(helpers[i].name)] == '(')
            spell_helper(spell, helpers[i].declaration);
    }
}

bool mdl_lacks_uniform(const char *semantic)
{
    static const char *const absent[] = {
#define ABSENT(beginning) beginning,
#include "generators/mdl/streams.def"
    };
    bool is_absent = false;
    for (size_t i = 0; i < sizeof absent / sizeof *absent; i++)
        is_absent |= strncmp(semantic, absent[i], strlen(absent[i])) == 0;
    return is_absent;
}

/* "scene::data_lookup_float("wear", 0.5)": data that the scene has beside the state. */
static const char *scene_data(struct spell *spell, const struct shader_variable *variable,
                              const char *name)
{
    struct text *text = spell_new_text(spell), *before = spell->out;
    bool is_bool = variable->type == IR_TYPE_BOOL;
    ir_type_id type = is_bool ? IR_TYPE_INT : variable->type;
    struct ir_value value = {.type = type};
    if (variable->has_default)
        value = variable->value;
    spell->out = text;
    SPELL(spell, is_bool ? "(" : "", "scene::data_lookup_", spell->style->types[type].bytes, "(");
    mdl_write_string(spell, name);
    spell_text(spell, ", ");
    lang_print_value(spell->style, NULL, type, value.w, LANG_PREC_COMMA, text);
    spell_text(spell, is_bool ? ") != 0)" : ")");
    spell->out = before;
    return text_cstr(text);
}

static const char *after(const char *text, const char *prefix)
{
    size_t len = strlen(prefix);
    return strncmp(text, prefix, len) == 0 ? text + len : NULL;
}

/* The expression of a stream or private uniform. */
static const char *value_of(struct spell *spell, const struct shader_variable *variable)
{
    bool is_stream = variable->block == BLOCK_VERTEX_DATA;
    const char *name = text_of(spell, is_stream ? variable->name : variable->semantic), *rest;
    const struct known *known = is_stream ? FIND(streams, name) : FIND(uniforms, name);
    if (known) {
        if (known->declaration)
            spell_helper(spell, known->declaration);
        return known->call;
    }
    if (is_stream && (rest = after(name, "texcoord_"))) {
        struct text *text = spell_new_text(spell);
        text_fmt(text, "mdl_texcoord(%s)", rest);
        return text_cstr(text);
    }
    rest = is_stream ? after(name, "geomprop_") : after(name, "geomprop:");
    return scene_data(spell, variable, rest ? rest : name);
}

static bool is_parameter(const struct spell *spell, const struct shader_variable *variable)
{
    return (variable->block == BLOCK_PUBLIC_UNIFORMS || variable->block == BLOCK_TEXTURES)
           && spell_uses(spell, variable);
}

static bool is_color(const struct shader_variable *variable)
{
    return variable->type == IR_TYPE_VEC3 && variable->doc_type == STR_color3;
}

/* "bsdf surface_scattering": what an output is in the `let`. */
static const char *output_text(struct spell *spell, const struct shader_variable *variable)
{
    struct text *text = spell_new_text(spell);
    bool is_hair = strcmp(text_of(spell, variable->semantic), mdl_part_names[MDL_HAIR]) == 0;
    text_fmt(text, "%s %s", is_hair ? "hair_bsdf" : spell->style->types[variable->type].bytes,
             text_of(spell, variable->name));
    return text_cstr(text);
}

/* The text with which the rest of the file reads or writes a variable. */
static const char *variable_text(struct spell *spell, const struct shader_variable *variable)
{
    if (variable->block == BLOCK_OUTPUTS)
        return output_text(spell, variable);
    if (!is_parameter(spell, variable))
        return value_of(spell, variable);
    if (!is_color(variable))
        return text_of(spell, variable->name);
    struct text *text = spell_new_text(spell);
    text_fmt(text, "float3(%s)", text_of(spell, variable->name));
    return text_cstr(text);
}

static void name_variables(struct spell *spell)
{
    for (uint32_t i = 0; i < spell->shader->interface.used.len; i++) {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        if (!spell_uses(spell, variable))
            continue;
        const char *text = variable_text(spell, variable);
        spell->variables[spell->shader->interface.used.items[i]] =
            (struct spell_name){text, strlen(text)};
    }
}

/* ---- The file above the material ---- */

static void declare(struct spell *spell)
{
    static const char *const modules[] = {"anno", "df", "math", "scene", "state", "tex"};
    const struct shader_module *module = &spell->shader->module;
    name_variables(spell);
    SPELL(spell, "mdl ", spell_version(spell), ";\n\n// ");
    if (module->is_shader)
        SPELL(spell, module->name, " · module · ", spell->options->generator);
    else
        spell_title(spell);
    spell_text(spell, "\n\n");
    for (size_t i = 0; i < sizeof modules / sizeof *modules; i++)
        SPELL(spell, "import ::", modules[i], "::*;\n");
    if (module->is_shader)
        spell->style->exports = "export ";
    else if (spell->stage->reach.needs_module)
        SPELL(spell, "import ::", module->name, "::*;\n");
    spell_text(spell, spell->stage->reach.user_types.len ? "\n" : "");
    spell_structs(spell);
}

/* ---- Parameters ---- */

static void write_default(struct spell *spell, const struct shader_variable *variable)
{
    struct ir_value value = {.type = variable->type};
    if (variable->has_default)
        value = variable->value;
    if (variable->type == IR_TYPE_SAMPLER) {
        mdl_write_texture(spell, variable);
        return;
    }
    size_t begin = spell->out->len;
    lang_print_value(spell->style, spell->shader->strings, value.type, value.w, LANG_PREC_COMMA,
                     spell->out);
    if (!is_color(variable))
        return;
    const char *parts = arena_strndup(spell->scratch, spell->out->data + begin + strlen("float3"),
                                      spell->out->len - begin - strlen("float3"));
    spell->out->len = begin;
    SPELL(spell, "color", parts);
}

/* The type with its frequency: "uniform bool". */
static const char *parameter_type(struct spell *spell, const struct shader_variable *variable)
{
    if (!is_parameter(spell, variable))
        return NULL;
    struct text *text = spell_new_text(spell);
    bool is_uniform = variable->type == IR_TYPE_BOOL || variable->type == IR_TYPE_STRING;
    text_fmt(text, "%s%s", is_uniform ? "uniform " : "",
             is_color(variable) ? "color" : spell->style->types[variable->type].bytes);
    return text_cstr(text);
}

static void write_parameters(struct spell *spell, enum shader_block block, unsigned *count)
{
    for (uint32_t i = 0; i < spell->shader->interface.used.len; i++) {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        if (variable->block != block || !is_parameter(spell, variable))
            continue;
        spell_text(spell, (*count)++ ? ",\n    " : "\n    ");
        SPELL(spell, parameter_type(spell, variable), " ", text_of(spell, variable->name), " = ");
        write_default(spell, variable);
        mdl_write_annotations(spell, variable);
    }
}

static const char *material_name(struct spell *spell)
{
    const struct shader *shader = spell->shader;
    if (spell->options->shader_name)
        return spell->options->shader_name;
    const char *name =
        text_of(spell, shader->interface.rules.neutral_names ? 0 : shader->reflection.path);
    name = *name ? name : "neutral";
    return names_unique(&spell->names, name, strlen(name)).text;
}

static void open(struct spell *spell)
{
    unsigned count = 0;
    SPELL(spell, "export material ", material_name(spell), "(");
    write_parameters(spell, BLOCK_PUBLIC_UNIFORMS, &count);
    write_parameters(spell, BLOCK_TEXTURES, &count);
    SPELL(spell, count ? "\n)\n= " : ")\n= ", spell->stage->statements.len ? "let {\n" : "");
}

/* ---- Parts ---- */

/* The name of a part in the `let`; NULL: the material has none. */
static const char *part_name(const struct spell *spell, enum mdl_part part)
{
    for (uint32_t i = 0; i < spell->shader->interface.used.len; i++) {
        const struct shader_variable *variable = spell_interface_variable(spell, i);
        if (variable->block == BLOCK_OUTPUTS
            && strcmp(text_of(spell, variable->semantic), mdl_part_names[part]) == 0)
            return text_of(spell, variable->name);
    }
    return NULL;
}

/* The fields of the struct material: FIELD(part, depth of the struct, field). */
struct field {
    enum mdl_part part;
    const char *in, *name, *form;
};

static const struct field fields[] = {
    {MDL_THIN_WALLED, NULL, "thin_walled", "$0"},
    {MDL_SCATTERING, "surface: material_surface", "scattering", "$0"},
    {MDL_EMISSION, "surface: material_surface", "emission",
     "material_emission(emission: $0, intensity: "},
    {MDL_BACK_SCATTERING, "backface: material_surface", "scattering", "$0"},
    {MDL_BACK_EMISSION, "backface: material_surface", "emission",
     "material_emission(emission: $0, intensity: "},
    {MDL_IOR, NULL, "ior", "color($0)"},
    {MDL_VOLUME, "volume: material_volume", "scattering", "$0"},
    {MDL_ABSORPTION, "volume: material_volume", "absorption_coefficient", "color($0)"},
    {MDL_SCATTER, "volume: material_volume", "scattering_coefficient", "color($0)"},
    {MDL_VOLUME_INTENSITY, "volume: material_volume", "emission_intensity", "color($0)"},
    {MDL_DISPLACEMENT, "geometry: material_geometry", "displacement", "mdl_to_internal($0)"},
    {MDL_OPACITY, "geometry: material_geometry", "cutout_opacity", "$0"},
    {MDL_HAIR, NULL, "hair", "$0"},
};

static void write_field(struct spell *spell, const struct field *field)
{
    SPELL(spell, field->name, ": ");
    lang_put_phrase(field->form, lang_word(part_name(spell, field->part)), spell->out);
    if (field->part == MDL_EMISSION || field->part == MDL_BACK_EMISSION)
        SPELL(spell, "color(", part_name(spell, field->part + 1), "))");
}

static void close(struct spell *spell)
{
    const char *in = NULL;
    bool is_first = true;
    SPELL(spell, spell->stage->statements.len ? "} in " : "", "material(");
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
        if (!part_name(spell, fields[i].part))
            continue;
        bool goes_on = in && fields[i].in && strcmp(in, fields[i].in) == 0;
        if (in && !goes_on)
            spell_text(spell, ")");
        spell_text(spell, goes_on ? ",\n        " : is_first ? "\n    " : ",\n    ");
        if (!goes_on && fields[i].in)
            SPELL(spell, fields[i].in, "(\n        ");
        write_field(spell, &fields[i]);
        in = fields[i].in;
        is_first = false;
    }
    SPELL(spell, in ? ")" : "", is_first ? ");\n" : "\n);\n");
    use_helpers(spell);
}

const struct target_frame mdl_frame = {
    .declare = declare, .open = open, .close = close, .passed_type = parameter_type};
