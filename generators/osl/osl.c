// SPDX-License-Identifier: Apache-2.0
/*
 * Open Shading Language 1.14 and later: one shader per file, with closures for scattered light
 * (docs/osl.md).
 */
#include "generators/osl/osl.h"

#include "shader/verbatim.h"
#include "generators/osl/closure_tree.h"

#include <assert.h>

/* ---- The file ---- */

/* Vectors that OSL lacks. */
static const struct {
    ir_type_id type;
    const char *name, *text;
} structs[] = {
    {IR_TYPE_VEC2, "vector2", "struct vector2 {\n    float x, y;\n};\n"},
    {IR_TYPE_VEC4, "vector4", "struct vector4 {\n    float x, y, z, w;\n};\n"},
#define OF_INTEGERS(of, letter) \
    {IR_TYPE_##of##2, letter "vector2", "struct " letter "vector2 {\n    int x, y;\n};\n"}, \
        {IR_TYPE_##of##3, letter "vector3", "struct " letter "vector3 {\n    int x, y, z;\n};\n"}, \
    { \
        IR_TYPE_##of##4, letter "vector4", "struct " letter "vector4 {\n    int x, y, z, w;\n};\n" \
    }
    OF_INTEGERS(BVEC, "b"),
    OF_INTEGERS(IVEC, "i"),
    OF_INTEGERS(UVEC, "u"),
#undef OF_INTEGERS
};
enum { NUM_STRUCTS = sizeof structs / sizeof *structs };

/* The types, and operations on them, that verbatim source needs; only its text shows them. */
static void note_verbatim_types(struct osl *osl, str_id text)
{
    const char *source = str_text(osl->spell->shader->strings, text);
    for (size_t i = 0; i < NUM_STRUCTS; i++) {
        if (!(osl->types >> structs[i].type & 1) && !strstr(source, structs[i].name))
            continue;
        osl->types |= 1u << structs[i].type;
        if (structs[i].type == IR_TYPE_VEC2 || structs[i].type == IR_TYPE_VEC4)
            osl_add_struct_functions(osl, structs[i].type, source);
    }
}

static void note_helper_types(struct osl *osl)
{
    const struct spell *spell = osl->spell;
    uint64_t helpers = shader_stage_helpers(spell->shader, spell->stage, spell->scratch);
    for (unsigned i = 0; helpers >> i; i++)
        for (size_t k = 0; k < NUM_STRUCTS && helpers >> i & 1; k++)
            if (strstr(shader_helper_text(spell->shader, i), structs[k].name))
                osl->types |= 1u << structs[k].type;
}

/* Writes the structs and helpers that the rest of the file needs, above it. */
static void write_declarations(struct osl *osl)
{
    struct spell *spell = osl->spell;
    struct source_list sources = {0};
    for (uint32_t i = 0; i < spell->stage->verbatim.len; i++) {
        const struct shader_verbatim *v =
            &spell->shader->sources.calls.items[spell->stage->verbatim.items[i]];
        for (uint32_t k = 0; k < v->num_sources; k++)
            shader_collect_sources(spell->shader,
                                   spell->shader->sources.refs.items[v->first_source + k],
                                   spell->scratch, &sources);
        note_verbatim_types(osl, v->expression);
    }
    for (uint32_t i = 0; i < sources.len; i++)
        note_verbatim_types(osl, spell->shader->sources.all.items[sources.items[i]].text);
    note_helper_types(osl);
    for (size_t i = 0; i < NUM_STRUCTS; i++)
        if (osl->types >> structs[i].type & 1)
            SPELL(spell, structs[i].text, "\n");
    for (uint32_t i = 0; i < osl->helpers.len; i++)
        SPELL(spell, osl->helpers.items[i], "\n");
}

static const char *shader_type(const struct spell *spell)
{
    static const char *const words[] = {
        [SHADER_VALUE] = "shader", [SHADER_SURFACE] = "surface", [SHADER_VOLUME] = "volume"};
    return spell->stage_id == STAGE_VERTEX ? "displacement" : words[spell->shader->reflection.kind];
}

/*
 * "NG_out": from the element's path. oslc names its file after the shader, so a displacement beside
 * a surface has a name of its own.
 */
static const char *shader_name(struct spell *spell)
{
    const struct shader *shader = spell->shader;
    if (spell->options->shader_name)
        return spell->options->shader_name;
    struct text name;
    text_init(&name, spell->scratch);
    text_str(&name, str_text(shader->strings,
                             shader->interface.rules.neutral_names ? 0 : shader->reflection.path));
    if (!name.len)
        text_str(&name, "neutral");
    if (spell->stage_id == STAGE_VERTEX && shader->stages[STAGE_PIXEL].effects.len)
        text_str(&name, "_displacement");
    return names_unique(&spell->names, text_cstr(&name), name.len).text;
}

/*
 * A function of a graph may read streams and parameters, which are in scope in the shader alone: it
 * stands there, indented like other statements.
 */
static void write_graph_functions(struct spell *spell)
{
    struct text *out = spell->out;
    size_t begin = out->len;
    uint32_t mark = spell->marks.len;
    for (uint32_t i = 0; i < spell->stage->functions.len; i++)
        spell_graph_function(spell, &spell->stage->functions.items[i]);
    size_t end = out->len;
    const char *written = arena_strndup(spell->scratch, out->data + begin, end - begin);
    out->len = begin;
    for (size_t i = begin; i < end; i++) {
        bool begins_line = i == begin || written[i - begin - 1] == '\n';
        if (begins_line && written[i - begin] != '\n')
            spell_indent(spell, 1);
        for (; mark < spell->marks.len && spell->marks.items[mark].at == i; mark++)
            spell->marks.items[mark].at = out->len;
        text_char(out, written[i - begin]);
    }
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
    write_graph_functions(spell);
    spell_statements(spell, &spell->stage->statements, 1);
    if (spell->stage_id == STAGE_VERTEX)
        spell_text(spell, "    N = normalize(calculatenormal(P));\n");
    spell_text(spell, "}\n");
}

static void start(struct osl *osl)
{
    struct spell *spell = osl->spell;
    const struct lang_unit *unit = spell->shader->unit;
    osl->called = ARENA_ARRAY(spell->scratch, bool, unit->base_functions + unit->functions.len);
    osl->read = ARENA_ARRAY(spell->scratch, bool, unit->base_globals + unit->globals.len);
    spell->target_data = osl;
    spell->write_node = spell_typed_node;
    spell->lang_names.form = osl_form;
    spell->lang_names.type = osl_note_type;
    spell->lang_names.function = osl_function_name;
    spell->lang_names.global = osl_global_name;
    spell->lang_names.maker = osl_maker;
    osl_index_helpers(osl);
    osl_name_interface(osl);
    osl_name_same_functions(spell);
    osl_name_makers(osl);
    osl_find_kinds(osl);
}

/*
 * Writes from the end of the file to its beginning, because each part marks the declarations that
 * must stand above it.
 */
static void write_stage(struct spell *spell, enum shader_stage_id stage)
{
    (void)stage;
    struct osl osl = {.spell = spell};
    struct text *out = spell->out, shader, functions, types;
    start(&osl);
    text_init(&shader, spell->scratch);
    spell->out = &shader;
    write_shader(&osl);
    text_init(&functions, spell->scratch);
    spell->out = &functions;
    spell_verbatim_sources(spell);
    osl_write_functions(&osl, &functions);
    text_init(&types, spell->scratch);
    osl_write_structs(&osl, &types);
    spell->out = out;
    spell_text(spell, "// ");
    spell_title(spell);
    spell_text(spell, "\n\n");
    write_declarations(&osl);
    text_mem(out, types.data, types.len);
    spell->verbatim_begin += out->len;
    spell->verbatim_end += out->len;
    text_mem(out, functions.data, functions.len);
    for (uint32_t i = 0; i < spell->marks.len; i++)
        spell->marks.items[i].at += out->len;
    text_mem(out, shader.data, shader.len);
}

const struct target target_osl = {
    .name = "osl",
    .materialx_name = "genosl",
    .brief = "Open Shading Language 1.14 and later",
    .caps = CAP_OVERLOADS | CAP_BITWISE | CAP_IMPLICIT_LOD | CAP_STRINGS | CAP_NAMED_WHOLES
            | CAP_TYPED_TEXTURES | CAP_MISSING_COLORS | CAP_SCOPED_PARAMETERS | CAP_INDEXED_TANGENTS
            | CAP_PICKS | CAP_DERIVATIVES | CAP_METADATA,
    .closures = &osl_closures,
    .network = &osl_network,
    .source = &osl_source,
    .syntax = &osl_syntax,
    .position = "P",
    .stage_suffix = {"displacement.osl", "osl"},
    .node_type = osl_node_type,
    .stage = write_stage,
};
