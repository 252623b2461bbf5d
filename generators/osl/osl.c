// SPDX-License-Identifier: Apache-2.0
/*
 * Open Shading Language 1.14 and later: one shader per file, closures for what scatters light
 * (docs/osl.md).
 */
#include "generators/osl/osl.h"

static const struct lang_words reserved[] = {
#define RESERVED(length, words) LANG_WORDS(length, words),
#include "generators/osl/reserved.def"
};

#define CALL(op, text) [IR_##op] = {text, LANG_PREC_POSTFIX, false}

static const struct lang_form forms[IR_NUM_OPS] = {
    [IR_LXOR] = {"$0 != $1", LANG_PREC_EQUAL, true},
    CALL(ATAN2, "atan2($0, $1)"),
    CALL(RSQRT, "inversesqrt($0)"),
    CALL(INVERSE, "(1 / $0)"),
    CALL(DFDX, "Dx($0)"),
    CALL(DFDY, "Dy($0)"),
    CALL(LAYER, "layer($0, $1)"),
    CALL(CLOSURE_MIX, "mix($0, $1, $2)"),
    [IR_CLOSURE_ADD] = {"$0 + $1", LANG_PREC_SUM, true},
    [IR_CLOSURE_SCALE] = {"$0 * $1", LANG_PREC_PRODUCT, true},
};

static const char *const type_names[IR_NUM_TYPES] = {
    [IR_TYPE_BOOL] = "int",          [IR_TYPE_INT] = "int",
    [IR_TYPE_UINT] = "int",          [IR_TYPE_FLOAT] = "float",
    [IR_TYPE_IVEC2] = "ivector2",    [IR_TYPE_VEC2] = "vector2",
    [IR_TYPE_VEC3] = "vector",       [IR_TYPE_VEC4] = "vector4",
    [IR_TYPE_MAT2] = "matrix",       [IR_TYPE_MAT3] = "matrix",
    [IR_TYPE_MAT4] = "matrix",       [IR_TYPE_STRING] = "string",
    [IR_TYPE_SAMPLER] = "string",    [IR_TYPE_BSDF] = "closure color",
    [IR_TYPE_EDF] = "closure color", [IR_TYPE_VDF] = "closure color",
};

const struct lang_syntax osl_syntax = {
    .name = "osl",
    .base = &lang_syntax_portable,
    .type_names = type_names,
    .forms = forms,
    .reserved = reserved,
    .max_reserved = sizeof reserved / sizeof *reserved - 1,
    .param_in = "",
    .param_in_assigned = "",
    .param_out = "output ",
    .param_inout = "output ",
    .copies_params = true,
    .plain_scalars = true,
    .defines_constants = true,
    .array_braces = true,
    .write_value = osl_write_value,
};

/* ---- Closures (stdosl.h of OSL 1.14) ---- */

static const struct closure_option film[] = {
    {"thinfilm_thickness", NULL,
     "'thinfilm_thickness' thinfilm_thickness 'thinfilm_ior' thinfilm_ior"},
    {0}};
static const struct closure_option energy[] = {
    {"energy_compensation", NULL, "'energy_compensation' energy_compensation"}, {0}};
static const struct closure_option zeltner[] = {{"mode", "zeltner", "'mode' 1"}, {0}};

static const struct closure_row closure_rows[] = {
#define CLOSURE(name, closure, arguments, options) {"mx_" #name, closure, arguments, options},
#include "generators/osl/closures.def"
    {0}};

static const struct closure_rows closures = {
    .rows = closure_rows,
    .emission = "uniform_edf",
    .medium = "anisotropic_vdf",
    .transparent = "transparent_bsdf",
    .output = "Ci",
};

/* ---- The file ---- */

static const struct {
    const char *name, *text;
} structs[] = {
    {"vector2", "struct vector2 {\n    float x, y;\n};\n"},
    {"vector4", "struct vector4 {\n    float x, y, z, w;\n};\n"},
    {"ivector2", "struct ivector2 {\n    int x, y;\n};\n"},
};

static bool is_word(const char *at, const char *begin, size_t len)
{
    const char *letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    return !strchr(letters, at[len]) && (at == begin || !strchr(letters, at[-1]));
}

bool osl_mentions(const char *text, const char *word)
{
    size_t len = strlen(word);
    for (const char *at = text; (at = strstr(at, word)) != NULL; at += len)
        if (is_word(at, text, len) || at[len] == '\0')
            return true;
    return false;
}

/* Above the rest stand the structs and helpers that it mentions. */
static void write_declarations(struct osl *osl, const char *above, const char *shader)
{
    struct spell *spell = osl->spell;
    for (size_t i = 0; i < sizeof structs / sizeof *structs; i++) {
        bool needed = osl_mentions(above, structs[i].name) || osl_mentions(shader, structs[i].name);
        for (uint32_t k = 0; k < osl->helpers.len && !needed; k++)
            needed = osl_mentions(osl->helpers.items[k], structs[i].name);
        if (needed)
            SPELL(spell, structs[i].text, "\n");
    }
    for (uint32_t i = 0; i < osl->helpers.len; i++)
        SPELL(spell, osl->helpers.items[i], "\n");
}

static const char *shader_type(const struct spell *spell)
{
    static const char *const words[] = {
        [SHADER_VALUE] = "shader", [SHADER_SURFACE] = "surface", [SHADER_VOLUME] = "volume"};
    return spell->stage_id == STAGE_VERTEX ? "displacement" : words[spell->shader->kind];
}

/* "NG_out": the element's path. */
static const char *shader_name(struct spell *spell)
{
    if (spell->options->shader_name)
        return spell->options->shader_name;
    const char *path =
        str_text(spell->shader->strings, spell->options->neutral_names ? 0 : spell->shader->path);
    return *path ? names_unique(&spell->names, path, strlen(path)).text : "neutral";
}

static void write_shader(struct osl *osl)
{
    struct spell *spell = osl->spell;
    osl_write_macros(osl);
    SPELL(spell, shader_type(spell), " ", shader_name(spell));
    osl_write_parameters(osl);
    spell_text(spell, "{\n");
    names_open_scope(&spell->names);
    osl_write_streams(osl);
    spell_statements(spell, &spell->stage->statements, 1);
    if (spell->stage_id == STAGE_VERTEX)
        spell_text(spell, "    N = normalize(calculatenormal(P));\n");
    spell_text(spell, "}\n");
}

static void write_graph_functions(struct spell *spell)
{
    for (uint32_t i = 0; i < spell->stage->functions.len; i++)
        spell_graph_function(spell, &spell->stage->functions.items[i]);
}

/* The shader is written first: it decides what stands above it. */
static void write_stage(struct spell *spell, enum shader_stage_id stage)
{
    (void)stage;
    struct osl osl = {.spell = spell};
    struct text *out = spell->out, shader, functions, above;
    spell->target_data = &osl;
    spell->lang_names.form = osl_form;
    spell->write_node = spell_typed_node;
    spell->lang_names.global = osl_global_name;
    osl_index_helpers(&osl);
    osl_name_interface(&osl);
    osl_name_same_functions(spell);
    osl_name_makers(&osl);
    spell->lang_names.maker = osl_maker;
    osl_find_kinds(&osl);
    text_init(&shader, spell->scratch);
    spell->out = &shader;
    write_graph_functions(spell);
    write_shader(&osl);
    text_init(&functions, spell->scratch);
    spell->out = &functions;
    spell_verbatim_sources(spell);
    osl_write_functions(&osl, text_cstr(&shader), &functions);
    text_init(&above, spell->scratch);
    osl_write_structs(&osl, text_cstr(&functions), text_cstr(&shader), &above);
    text_str(&above, text_cstr(&functions));
    spell->out = out;
    spell_text(spell, "// ");
    spell_title(spell);
    spell_text(spell, "\n\n");
    write_declarations(&osl, text_cstr(&above), text_cstr(&shader));
    size_t moved = out->len + above.len - functions.len;
    spell->verbatim_begin += moved;
    spell->verbatim_end += moved;
    SPELL(spell, text_cstr(&above));
    for (uint32_t i = 0; i < spell->marks.len; i++)
        spell->marks.items[i].at += out->len;
    text_mem(out, shader.data, shader.len);
}

const struct target target_osl = {
    .name = "osl",
    .materialx_name = "genosl",
    .brief = "Open Shading Language 1.14 and later",
    .caps = CAP_OVERLOADS | CAP_BITWISE | CAP_IMPLICIT_LOD | CAP_CLOSURES | CAP_STRINGS
            | CAP_NAMED_WHOLES | CAP_TYPED_TEXTURES | CAP_MISSING_COLORS,
    .closures = &closures,
    .network = &osl_network,
    .syntax = &osl_syntax,
    .position = "P",
    .stage_suffix = {"displacement.osl", "osl"},
    .node_type = osl_node_type,
    .stage = write_stage,
};
