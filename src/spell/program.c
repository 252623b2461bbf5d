// SPDX-License-Identifier: Apache-2.0
/*
 * Programs (parse/parse.h) in the text of a stage: structs, variables, and the functions that the
 * stage calls.
 */
#include "spell/spell.h"
#include "tree/ast.h"
#include "tree/reach.h"

/* ---- Names ---- */

static const char *function_name(void *user_data, uint32_t id)
{
    const struct spell *spell = user_data;
    return spell->program->functions[id];
}

static const char *position_name(const struct spell *spell)
{
    struct text name;
    text_init(&name, spell->scratch);
    text_fmt(&name, "%s%s", spell_frame_name(spell, "vd"), spell->target->position);
    return text_cstr(&name);
}

/* A uniform of the passes, where blocks of uniforms are variables. */
static const char *member_name(const struct spell *spell, str_id name)
{
    struct text text;
    text_init(&text, spell->scratch);
    text_fmt(&text, SPELL_FRAME_INSTANCE ".%s", str_text(spell->shader->strings, name));
    return text_cstr(&text);
}

/* The pixel that a pass lights, which it tells functions of the host. */
static const char *hosts_name(const struct spell *spell, str_id name)
{
    struct text text;
    const char *prefix = spell_host_prefix(spell);
    if (!*prefix || strcmp(str_text(spell->shader->strings, name), "mxg_pixel") != 0)
        return NULL;
    text_init(&text, spell->scratch);
    text_fmt(&text, "%smxg_pixel", prefix);
    return text_cstr(&text);
}

/* Inputs of a program are variables of the interface, if it has such a name. */
static const char *global_name(void *user_data, uint32_t id)
{
    const struct spell *spell = user_data;
    const struct lang_global *global = lang_global(spell->program->unit, id, NULL);
    if (global->kind == LANG_GLOBAL_UNIFORM && spell->target->instances)
        return member_name(spell, global->name);
    if (global->kind == LANG_GLOBAL_VARIABLE)
        return hosts_name(spell, global->name);
    if (global->kind != LANG_GLOBAL_STREAM)
        return NULL;
    if (strcmp(str_text(spell->shader->strings, global->name), "gl_FragCoord") == 0)
        return position_name(spell);
    for (uint32_t i = 0; i < spell->shader->interface.used.len; i++) {
        uint32_t variable = spell->shader->interface.used.items[i];
        if (spell->shader->interface.variables.items[variable].name == global->name)
            return spell->variables[variable].text;
    }
    return NULL;
}

static struct lang_names names_of(struct spell *spell)
{
    return (struct lang_names){.user_data = spell,
                               .function = function_name,
                               .global = global_name,
                               .maker = spell->target->maker,
                               .array = spell->target->array_type ? spell_array_type : NULL,
                               .form = spell->target->form};
}

/* ---- What the stage calls ---- */

static struct spell_program *program_of(struct spell *spell, const struct shader_source *source)
{
    const struct lang_unit *unit = source->program;
    for (uint32_t i = 0; i < spell->programs.len; i++)
        if (spell->programs.items[i].unit == unit)
            return &spell->programs.items[i];
    struct spell_program program = {
        .unit = unit, .resources = &source->resources, .reach = {.arena = spell->scratch}};
    program.functions = ARENA_ARRAY(spell->scratch, const char *, unit->functions.len + 1);
    vec_push(spell->scratch, &spell->programs, program);
    return &vec_last(&spell->programs);
}

/* A later function of the same name has another one in languages without overloads. */
static void name_functions(struct spell *spell, struct spell_program *program)
{
    const struct lang_unit *unit = program->unit;
    for (uint32_t i = 0; i < unit->functions.len; i++) {
        str_id name = unit->functions.items[i].name;
        bool is_first = true;
        for (uint32_t k = 0; k < i; k++)
            is_first &= unit->functions.items[k].name != name;
        const char *text = str_text(unit->strings, name);
        bool is_kept = is_first || spell_can(spell, CAP_OVERLOADS);
        if (is_kept)
            names_take(&spell->names, text, strlen(text));
        program->functions[i] =
            is_kept ? text : names_unique(&spell->names, text, strlen(text)).text;
    }
}

/* Adds a function, or all that have a body, and what they call. */
static void reach(struct spell_program *program, str_id name, bool all)
{
    for (uint32_t i = 0; i < program->unit->functions.len; i++) {
        const struct lang_function *fn = &program->unit->functions.items[i];
        if (fn->body && (all || fn->name == name))
            lang_reach_add(&program->reach, program->unit, i);
    }
}

/*
 * True for a pass with functions of its host behind it, which may read what the pixel stores. Where
 * they are members of a struct above the pass, they cannot.
 */
static bool is_read_by_host(const struct spell *spell)
{
    return spell->shader->reflection.host_functions.len && !*spell_host_prefix(spell);
}

/* The stage of a pass calls the function that runs it, or its host may call all. */
static void find_pass(struct spell *spell)
{
    static const char top[] = "mx_read_top";
    const struct source_pass *pass = &spell->shader->sources.pass;
    if (!pass->program)
        return;
    struct spell_program *program =
        program_of(spell, &spell->shader->sources.all.items[pass->program - 1]);
    const str_id run = str_find(spell->shader->strings, "mx_run", strlen("mx_run"));
    reach(program, run, !pass->runs);
    if (is_read_by_host(spell))
        reach(program, str_find(spell->shader->strings, top, sizeof top - 1), false);
}

void spell_find_programs(struct spell *spell)
{
    const struct shader_sources *sources = &spell->shader->sources;
    for (uint32_t i = 0; i < spell->stage->verbatim.len; i++) {
        const struct shader_verbatim *call = &sources->calls.items[spell->stage->verbatim.items[i]];
        const struct shader_source *source =
            call->num_sources ? &sources->all.items[sources->refs.items[call->first_source]] : NULL;
        /* several shaders of one file share a program, which has all functions then */
        if (source && source->program)
            reach(program_of(spell, source), call->function, spell->shader->role->is_in_host_file);
    }
    find_pass(spell);
    for (uint32_t i = 0; i < spell->programs.len; i++)
        name_functions(spell, &spell->programs.items[i]);
}

/* ---- Texts ---- */

/* Writes what follows from `begin` on once per file. */
static void guard(struct spell *spell, size_t begin)
{
    struct text copy;
    text_init(&copy, spell->scratch);
    text_mem(&copy, spell->out->data + begin, spell->out->len - begin);
    spell->out->len = begin;
    if (copy.len)
        spell_once(spell, copy.data, copy.len);
}

void spell_program_structs(struct spell *spell)
{
    for (uint32_t i = 0; i < spell->programs.len; i++) {
        const struct spell_program *program = spell->program = &spell->programs.items[i];
        const struct lang_names names = names_of(spell);
        size_t begin = spell->out->len;
        for (uint32_t k = 0; k < program->reach.user_types.len; k++) {
            ir_type_id type = program->reach.user_types.items[k];
            lang_print_struct(spell->style, &names, program->unit, type, spell->out);
            if (spell->target->maker)
                spell_add_maker(spell, program->unit, type, spell_program_type(spell, type));
        }
        guard(spell, begin);
    }
    spell->program = NULL;
}

static void write_variable(struct spell *spell, const struct lang_names *names, uint32_t id)
{
    const struct lang_unit *unit = spell->program->unit;
    const struct lang_global *global = lang_global(unit, id, NULL);
    if (global->kind != LANG_GLOBAL_VARIABLE || hosts_name(spell, global->name))
        return;
    lang_print_variable(spell->style, names, unit, PHRASE_VARIABLE, global->type,
                        lang_word(str_text(unit->strings, global->name)), spell->out);
    if (global->num_words) {
        spell_text(spell, " = ");
        lang_print_value(spell->style, unit->strings, global->type,
                         unit->words.items + global->words, LANG_PREC_ASSIGN, spell->out);
    }
    spell_text(spell, ";\n");
}

/* ---- Functions without a body in the program ---- */

/* The text of a function of the language; NULL: it is none. */
static const char *text_of(const struct target *target, const char *name)
{
    while (!target->functions && target->base)
        target = target->base;
    const struct target_function *function = target->functions;
    while (function->name && strcmp(function->name, name) != 0)
        function++;
    return function->text;
}

/* True if the text is that of the function: "… $N_load(…) …" of mx_words_load for "words". */
static bool is_text_of(const struct spell *spell, const char *text, const char *image,
                       const char *name)
{
    struct text own;
    const char *suffix = strstr(text, "$N") + strlen("$N");
    text_init(&own, spell->scratch);
    text_fmt(&own, "mx_%s%.*s", image, (int)strcspn(suffix, "("), suffix);
    return strcmp(text_cstr(&own), name) == 0;
}

/* Writes a function of an image. False: it is none, and the stage writes it. */
static bool write_of_image(struct spell *spell, const char *name)
{
    SPELL_EACH_RESOURCE(r, spell)
    {
        const struct target_image *image = spell_image(spell, &r);
        for (size_t i = 0; i < sizeof image->functions / sizeof *image->functions; i++) {
            const char *text = image->functions[i];
            if (!text || !is_text_of(spell, text, r.resource->name, name))
                continue;
            while (lang_next(&text, spell->out))
                SPELL(spell, "mx_", r.resource->name);
            return true;
        }
    }
    return false;
}

static void write_function(struct spell *spell, const struct lang_names *names, uint32_t id)
{
    const struct lang_unit *unit = spell->program->unit;
    const struct lang_function *fn = lang_function(unit, id, NULL);
    if (fn->body) {
        lang_print_results(spell->style, names, unit, id, spell->out);
        if (fn->doc)
            spell_doc(spell, fn->doc);
        lang_print_function(spell->style, names, unit, id, spell->out);
    } else {
        const char *name = str_text(unit->strings, fn->name);
        const char *text = text_of(spell->target, name);
        if (text)
            spell_text(spell, text);
        else if (!write_of_image(spell, name))
            return;
    }
    spell_text(spell, "\n");
}

void spell_programs(struct spell *spell)
{
    for (uint32_t i = 0; i < spell->programs.len; i++) {
        const struct spell_program *program = spell->program = &spell->programs.items[i];
        const struct lang_names names = names_of(spell);
        size_t begin = spell->out->len;
        for (uint32_t k = 0; k < program->reach.globals.len; k++)
            write_variable(spell, &names, program->reach.globals.items[k]);
        spell_text(spell, spell->out->len > begin ? "\n" : "");
        for (uint32_t k = 0; k < program->reach.functions.len; k++)
            write_function(spell, &names, program->reach.functions.items[k]);
        if (!spell->frame->open_context) /* otherwise each context has its own */
            guard(spell, begin);
    }
    spell->program = NULL;
}
