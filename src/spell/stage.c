// SPDX-License-Identifier: Apache-2.0
/* A stage of a C-like target, section by section: version, interface, functions, main. */
#include "base/hash.h"
#include "spell/spell.h"
#include "tree/ast.h"

#include <assert.h>

/* ---- Names of functions and types ---- */

/* Compares types by their names in the output: a target may use one type for several. */
static bool equal_types(const struct spell *spell, ir_type_id a, ir_type_id b)
{
    const struct lang_syntax *syntax = spell->target->syntax;
    return a == b
           || (a < IR_NUM_TYPES && b < IR_NUM_TYPES
               && strcmp(lang_syntax_type(syntax, a), lang_syntax_type(syntax, b)) == 0);
}

static bool equal_parameters(const struct spell *spell, uint32_t a, uint32_t b)
{
    const struct lang_unit *la, *lb;
    const struct lang_function *fa = lang_function(spell->shader->unit, a, &la),
                               *fb = lang_function(spell->shader->unit, b, &lb);
    if (fa->num_params != fb->num_params)
        return false;
    for (uint32_t i = 0; i < fa->num_params; i++)
        if (!equal_types(spell, la->slots.items[fa->first_slot + i].type,
                         lb->slots.items[fb->first_slot + i].type))
            return false;
    return true;
}

/*
 * Functions of equal source names, as chains of positions in the stage's reach, which count from 1.
 */
struct overloads {
    uint32_t *last; /* by hash of the name */
    uint32_t mask;
    uint32_t *before; /* by position */
};

static struct overloads overloads_init(const struct spell *spell)
{
    uint32_t n = spell->stage->reach.functions.len, slots = 16;
    while (slots < 2 * n)
        slots *= 2;
    assert((slots & (slots - 1)) == 0);
    return (struct overloads){.last = ARENA_ARRAY(spell->scratch, uint32_t, slots),
                              .mask = slots - 1,
                              .before = ARENA_ARRAY(spell->scratch, uint32_t, n + 1)};
}

/*
 * The name of an earlier function of the same source name, if this function can overload it; NULL:
 * it cannot.
 */
static const char *overload_of(const struct spell *spell, struct overloads *overloads,
                               uint32_t index, str_id name)
{
    const uint32_t *ids = spell->stage->reach.functions.items;
    uint32_t *last = &overloads->last[hash_pair(name, 0) & overloads->mask];
    assert(*last <= index);
    const char *shared = NULL;
    bool clash = false;
    for (uint32_t place = *last; place; place = overloads->before[place]) {
        assert(overloads->before[place] < place);
        uint32_t id = ids[place - 1];
        if (lang_function(spell->shader->unit, id, NULL)->name != name)
            continue;
        clash |= equal_parameters(spell, id, ids[index]);
        shared = spell->functions[id]; /* at the end of the chain: the first function's name */
    }
    overloads->before[index + 1] = *last;
    *last = index + 1;
    return clash ? NULL : shared;
}

static void name_functions(struct spell *spell)
{
    const struct shader *shader = spell->shader;
    struct overloads overloads = overloads_init(spell);
    for (uint32_t id = 0; id < shader->unit->num_module; id++)
        spell->functions[id] = shader->unit->module[id];
    for (uint32_t i = 0; i < spell->stage->reach.functions.len; i++) {
        uint32_t id = spell->stage->reach.functions.items[i];
        const struct lang_function *fn = lang_function(shader->unit, id, NULL);
        str_id source = fn->name;
        if (lang_module_name(shader->unit, id))
            continue;
        if (!fn->body) { /* the host has named it */
            spell->functions[id] = spell_host_name(spell, source);
            names_take(&spell->names, str_text(shader->strings, source),
                       str_len(shader->strings, source));
            continue;
        }
        const char *name =
            spell_can(spell, CAP_OVERLOADS) ? overload_of(spell, &overloads, i, source) : NULL;
        if (!name)
            name = names_unique(&spell->names, str_text(shader->strings, source),
                                str_len(shader->strings, source))
                       .text;
        spell->functions[id] = name;
    }
    for (uint32_t i = 0; i < spell->stage->functions.len; i++) {
        uint32_t index = spell->stage->functions.items[i].function;
        str_id source = shader->graph->functions.items[index].name;
        spell->graph_functions[index] =
            names_unique(&spell->names, str_text(shader->strings, source),
                         str_len(shader->strings, source))
                .text;
    }
}

static void name_types(struct spell *spell)
{
    const struct lang_reach *reach = &spell->stage->reach;
    for (uint32_t i = 0; i < reach->user_types.len; i++) {
        str_id name = lang_user_type(spell->shader->unit, reach->user_types.items[i], NULL)->name;
        spell->user_types[reach->user_types.items[i] - IR_TYPE_FIRST_USER] =
            names_unique(&spell->names, str_text(spell->shader->strings, name),
                         str_len(spell->shader->strings, name))
                .text;
    }
}

static const char *function_name(void *user_data, uint32_t id)
{
    const struct spell *spell = user_data;
    return spell->functions[id];
}

static const char *global_name(void *user_data, uint32_t id)
{
    struct spell *spell = user_data;
    uint32_t variable = shader_global_variable(spell->shader, id);
    if (variable == UINT32_MAX)
        return NULL;
    struct spell_name name = spell->variables[variable];
    if (!shader_block_type(spell->shader, spell->style->syntax,
                           &spell->shader->interface.variables.items[variable]))
        return name.text;
    struct text value, *out = spell->out;
    text_init(&value, spell->scratch);
    spell->out = &value;
    spell_read(spell, &spell->shader->interface.variables.items[variable], spell_word(name),
               LANG_PREC_POSTFIX);
    spell->out = out;
    return text_cstr(&value);
}

static const char *user_type_name(void *user_data, ir_type_id type)
{
    assert(type >= IR_TYPE_FIRST_USER);
    const struct spell *spell = user_data;
    return spell->user_types[type - IR_TYPE_FIRST_USER];
}

/* ---- Sections ---- */

/* "Gold · surfacematerial · mxgen 0.1 · vulkan · reduced · 1 closure · 0 textures" */
void spell_title(struct spell *spell)
{
    const struct shader *shader = spell->shader;
    const char *parts[] = {str_text(shader->strings, shader->reflection.name),
                           str_text(shader->strings, shader->reflection.element_type),
                           spell->options->generator, spell->target->name,
                           spell->options->interface};
    uint32_t textures = 0;
    for (uint32_t i = 0; i < shader->interface.used.len; i++) {
        const struct shader_variable *variable = shader_interface_variable(shader, i);
        textures += variable->block == BLOCK_TEXTURES && !variable->semantic;
    }
    for (size_t i = spell->shader->interface.rules.neutral_names ? 2 : 0;
         i < sizeof parts / sizeof *parts; i++) {
        if (!parts[i] || !*parts[i])
            continue;
        spell_comment(spell, parts[i], strlen(parts[i]));
        spell_text(spell, " · ");
    }
    text_count(spell->out, shader->reflection.closures.len, "closure", "closures");
    spell_text(spell, " · ");
    text_count(spell->out, textures, "texture", "textures");
}

static bool is_variable(const struct spell *spell, uint32_t global)
{
    return shader_global_variable(spell->shader, global) != UINT32_MAX;
}

/* By position in the reach: whether a function reads variables of the interface or is the host's.
 */
static const bool *find_readers(const struct spell *spell)
{
    const struct lang_reach *reach = &spell->stage->reach;
    const struct lang_unit *unit = spell->shader->unit, *layer;
    bool *readers = ARENA_ARRAY(spell->scratch, bool, reach->functions.len + 1),
         *by_id = ARENA_ARRAY(spell->scratch, bool, unit->base_functions + unit->functions.len + 1);
    for (uint32_t i = 0; i < reach->functions.len; i++) {
        uint32_t id = reach->functions.items[i];
        const struct lang_function *fn = lang_function(unit, id, &layer);
        readers[i] = !fn->body;
        for (uint32_t k = 0; k < fn->num_globals; k++)
            readers[i] |= is_variable(spell, ast_globals(layer, fn)[k]);
        for (uint32_t k = 0; k < fn->num_callees; k++)
            readers[i] |= by_id[ast_callees(layer, fn)[k]];
        by_id[id] = readers[i];
    }
    return readers;
}

static void write_function(struct spell *spell, uint32_t id)
{
    if (!lang_function(spell->shader->unit, id, NULL)->body)
        return;
    lang_print_results(spell->style, &spell->lang_names, spell->shader->unit, id, spell->out);
    spell_function_doc(spell, id);
    lang_print_function(spell->style, &spell->lang_names, spell->shader->unit, id, spell->out);
    spell_text(spell, "\n");
}

/* Functions follow their callees: those that read nothing call nobody else. */
static void write_portable_functions(struct spell *spell)
{
    const struct lang_reach *reach = &spell->stage->reach;
    const bool *readers = spell->frame->open_context ? find_readers(spell) : NULL;
    for (uint32_t i = 0; readers && i < reach->functions.len; i++)
        if (!readers[i])
            write_function(spell, reach->functions.items[i]);
    if (readers)
        spell->frame->open_context(spell);
    spell_programs(spell);
    for (uint32_t i = 0; i < reach->functions.len; i++)
        if (!readers || readers[i])
            write_function(spell, reach->functions.items[i]);
}

static void write_functions(struct spell *spell)
{
    const struct lang_reach *reach = &spell->stage->reach;
    size_t before = spell->out->len;
    for (uint32_t i = 0; i < reach->globals.len; i++)
        if (!is_variable(spell, reach->globals.items[i]))
            lang_print_constant(spell->style, &spell->lang_names, spell->shader->unit,
                                reach->globals.items[i], spell->out);
    if (spell->out->len > before)
        spell_text(spell, "\n");
    spell_verbatim_sources(spell);
    write_portable_functions(spell);
    spell_find_passed(spell);
    for (uint32_t i = 0; i < spell->stage->functions.len; i++)
        spell_graph_function(spell, &spell->stage->functions.items[i]);
}

/*
 * Writes the helpers after the functions and main, because these ask for helpers; then joins the
 * texts in order.
 */
static void join(struct spell *spell, struct text *out, const struct text *body)
{
    spell->out = out;
    for (uint32_t i = 0; i < spell->helpers.len; i++) {
        bool is_before_blank = i + 1 == spell->helpers.len && body->len && *body->data == '\n';
        spell_once(spell, spell->helpers.items[i], strlen(spell->helpers.items[i]));
        spell_text(spell, is_before_blank ? "" : "\n");
    }
    for (uint32_t i = 0; i < spell->marks.len; i++)
        spell->marks.items[i].at += (uint32_t)out->len;
    text_mem(out, body->data, body->len);
}

static void write_main(struct spell *spell, const struct target_frame *frame)
{
    frame->open(spell);
    names_open_scope(&spell->names);
    spell_statements(spell, &spell->stage->statements, 1);
    if (frame->close)
        frame->close(spell);
    else
        spell_text(spell, "}\n");
}

void spell_stage(struct spell *spell, enum shader_stage_id stage)
{
    (void)stage;
    struct text *out = spell->out, body;
    const struct target_frame *frame = spell->shader->role->frame;
    frame = frame ? frame : spell->frame;
    frame->declare(spell);
    if (!spell->shader->role->frame)
        spell_host_functions(spell);
    spell_program_structs(spell);
    spell_text(spell, "\n");
    if (spell->lang_names.form || spell->lang_names.maker) {
        text_init(&body, spell->scratch);
        spell->out = &body;
    }
    write_functions(spell);
    if (!spell->shader->sources.pass.lacks_surface && !spell->shader->module.is_shader)
        write_main(spell, frame);
    if (spell->frame->close_context)
        spell->frame->close_context(spell);
    if (spell->out != out)
        join(spell, out, &body);
}

/* ---- Entry ---- */

/* The target's syntax for a stage without neighbours on the screen. */
static const struct lang_syntax *syntax_alone(struct spell *spell)
{
    struct lang_syntax *syntax = ARENA_NEW(spell->scratch, struct lang_syntax);
    *syntax = *spell->target->syntax;
    syntax->base = spell->target->syntax;
    syntax->forms = lang_syntax_forms_alone(syntax);
    syntax->without_neighbours = true;
    return syntax;
}

static void init(struct spell *spell)
{
    const struct shader *shader = spell->shader;
    struct arena *arena = spell->scratch;
    const struct lang_unit *unit = shader->unit;
    spell->variables = ARENA_ARRAY(arena, struct spell_name, shader->interface.variables.len + 1);
    uint32_t num_functions = unit->base_functions + unit->functions.len;
    spell->functions =
        arena_alloc(arena, mem_array_size(arena->mem, num_functions, sizeof *spell->functions));
    spell->graph_functions = ARENA_ARRAY(arena, const char *, shader->graph->functions.len + 1);
    spell->user_types =
        ARENA_ARRAY(arena, const char *, unit->base_user_types + unit->user_types.len + 1);
    spell->locals = ARENA_ARRAY(arena, struct spell_name, shader->effects.locals.len + 1);
    spell->local_of = ARENA_ARRAY(arena, uint32_t, shader->graph->nodes.len);
    spell->lang_names =
        (struct lang_names){.user_data = spell,
                            .function = function_name,
                            .global = global_name,
                            .user_type = user_type_name,
                            .maker = spell->target->maker,
                            .array = spell->target->array_type ? spell_array_type : NULL,
                            .form = spell->target->form};
    bool has_neighbours = spell->stage_id == STAGE_PIXEL
                              ? shader->role->derivatives == DERIVATIVES_OF_SCREEN
                              : !shader->reflection.displaced;
    spell->style =
        shader->style && has_neighbours ? shader->style : arena_alloc(arena, sizeof *spell->style);
    if (spell->style != shader->style)
        lang_style_init(spell->style, has_neighbours ? spell->target->syntax : syntax_alone(spell),
                        arena);
    names_init(&spell->names, arena, spell->style->syntax);
    spell->names.rules = &shader->interface.naming;
    if (spell->options->comments && spell->options->path
        && !spell->shader->interface.rules.neutral_names) {
        names_init(&spell->paths, arena, NULL);
        spell->origins_seen = ARENA_ARRAY(arena, uint8_t, shader->graph->origins.len);
    }
    if (spell->options->shader_name)
        names_take(&spell->names, spell->options->shader_name, strlen(spell->options->shader_name));
    spell->shares_vertex_data =
        shader->role->is_in_host_file && spell_functions_read_vertex_data(spell);
    spell->write_node =
        lang_is_typed(spell->style->syntax, &spell->lang_names) ? spell_typed_node : spell_node;
    spell_find_kinds(spell);
    spell_name_interface(spell);
    spell_take_source_names(spell);
    name_types(spell);
    name_functions(spell);
    spell_find_programs(spell);
}

void spell_shader_stage(const struct target *target, const struct spell_options *options,
                        const struct shader *shader, enum shader_stage_id stage,
                        struct arena *scratch, struct text *out, struct spell_mark **out_marks,
                        uint32_t *out_num_marks)
{
    struct spell spell = {
        .target = target,
        .options = options,
        .shader = shader,
        .stage = &shader->stages[stage],
        .stage_id = stage,
        .scratch = scratch,
        .out = out,
    };
    size_t begin = out->len;
    const struct target *writer = target;
    while (!writer->stage && !writer->frame)
        writer = writer->base;
    spell.frame = writer->frame;
    init(&spell);
    (writer->stage ? writer->stage : spell_stage)(&spell, stage);
    assert(spell.out == out && out->len >= begin);
    spell_wrap(&spell, begin);
    *out_marks = spell.marks.items;
    *out_num_marks = spell.marks.len;
}
