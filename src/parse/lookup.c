// SPDX-License-Identifier: Apache-2.0
/*
 * Looks up names through files and layers. Files have few declarations, so all searches are linear.
 */
#include "parse/parse_priv.h"

#include <assert.h>
#include <limits.h>

/* Types */

ir_type_id lookup_type(const struct lang_unit *unit, const char *name, size_t len)
{
    for (ir_type_id type = IR_TYPE_VOID + 1; type <= IR_TYPE_SAMPLER; type++) {
        const char *text = ir_type_text(type);
        if (strlen(text) == len && memcmp(text, name, len) == 0)
            return type;
    }
    str_id id = str_find(unit->strings, name, len);
    for (; id && unit; unit = unit->base)
        for (uint32_t i = unit->user_types.len; i-- > 0;)
            if (unit->user_types.items[i].name == id)
                return (ir_type_id)(IR_TYPE_FIRST_USER + unit->base_user_types + i);
    return IR_TYPE_VOID;
}

ir_type_id lookup_array(struct lang_unit *unit, ir_type_id element, uint32_t length)
{
    assert(length > 0);
    for (const struct lang_unit *layer = unit; layer; layer = layer->base)
        for (uint32_t i = 0; i < layer->user_types.len; i++) {
            const struct ir_user_type *user = &layer->user_types.items[i];
            if (user->array_length == length && user->element == element)
                return (ir_type_id)(IR_TYPE_FIRST_USER + layer->base_user_types + i);
        }
    return lang_add_type(unit, (struct ir_user_type){.array_length = length, .element = element});
}

/* Globals and functions */

uint32_t lookup_global(const struct lang_unit *unit, const uint32_t *files, uint32_t num_files,
                       str_id name)
{
    for (uint32_t f = 0; f < num_files; f++) {
        const struct lang_unit *layer;
        const struct lang_file *file = lang_file(unit, files[f], &layer);
        assert(file->first_global + file->num_globals <= layer->base_globals + layer->globals.len);
        for (uint32_t i = 0; i < file->num_globals; i++)
            if (layer->globals.items[file->first_global - layer->base_globals + i].name == name)
                return file->first_global + i;
    }
    return LANG_NONE;
}

uint32_t lookup_next_function(const struct lang_unit *unit, const uint32_t *files,
                              uint32_t num_files, str_id name, struct lookup_cursor *cursor)
{
    for (; cursor->file < num_files; cursor->file++, cursor->function = 0) {
        const struct lang_unit *layer;
        const struct lang_file *file = lang_file(unit, files[cursor->file], &layer);
        uint32_t first = file->first_function - layer->base_functions;
        assert(first + file->num_functions <= layer->functions.len);
        while (cursor->function < file->num_functions)
            if (layer->functions.items[first + cursor->function++].name == name)
                return file->first_function + cursor->function - 1;
    }
    return LANG_NONE;
}

const struct lang_slot *lookup_param(const struct lang_unit *unit, uint32_t function,
                                     unsigned index)
{
    const struct lang_unit *layer;
    const struct lang_function *f = lang_function(unit, function, &layer);
    assert(index < f->num_params);
    return &layer->slots.items[f->first_slot + index];
}

/*
 * The number of implicit conversions for the arguments; -1 if the function does not accept them.
 */
static int conversions(const struct lang_unit *unit, uint32_t function, const ir_type_id *types,
                       unsigned num_types)
{
    int num = 0;
    if (lang_function(unit, function, NULL)->num_params != num_types)
        return -1;
    for (unsigned i = 0; i < num_types; i++) {
        const struct lang_slot *param = lookup_param(unit, function, i);
        if (types[i] == param->type)
            continue;
        if (param->mode != LANG_IN || !check_converts(types[i], param->type))
            return -1;
        num++;
    }
    return num;
}

uint32_t lookup_overload(const struct lang_unit *unit, const uint32_t *files, uint32_t num_files,
                         str_id name, const ir_type_id *types, unsigned num_types,
                         bool *out_ambiguous)
{
    struct lookup_cursor cursor = {0};
    uint32_t best = LANG_NONE, id;
    int fewest = INT_MAX;
    *out_ambiguous = false;
    while ((id = lookup_next_function(unit, files, num_files, name, &cursor)) != LANG_NONE) {
        int num = conversions(unit, id, types, num_types);
        if (num < 0 || num > fewest)
            continue;
        *out_ambiguous = num == fewest;
        best = num == fewest ? best : id;
        fewest = num;
    }
    return *out_ambiguous ? LANG_NONE : best;
}

uint32_t lookup_exact(const struct lang_unit *unit, const uint32_t *files, uint32_t num_files,
                      str_id name, const ir_type_id *types, unsigned num_types)
{
    struct lookup_cursor cursor = {0};
    uint32_t id;
    while ((id = lookup_next_function(unit, files, num_files, name, &cursor)) != LANG_NONE)
        if (conversions(unit, id, types, num_types) == 0)
            break;
    return id;
}

static uint32_t find_in(const struct lang_unit *unit, const uint32_t *files, uint32_t num_files,
                        str_id name, const ir_type_id *params, unsigned num_params, bool exact)
{
    bool ambiguous;
    if (params)
        return exact
                   ? lookup_exact(unit, files, num_files, name, params, num_params)
                   : lookup_overload(unit, files, num_files, name, params, num_params, &ambiguous);
    struct lookup_cursor cursor = {0};
    uint32_t id = lookup_next_function(unit, files, num_files, name, &cursor);
    return lookup_next_function(unit, files, num_files, name, &cursor) == LANG_NONE ? id
                                                                                    : LANG_NONE;
}

uint32_t lang_find_function(const struct lang_unit *unit, uint32_t file, str_id name,
                            const ir_type_id *params, unsigned num_params)
{
    if (file == LANG_NONE)
        return LANG_NONE;
    const struct lang_unit *layer;
    const struct lang_file *f = lang_file(unit, file, &layer);
    assert(f->first_include + f->num_includes <= layer->refs.len);
    const uint32_t *includes = f->num_includes ? &layer->refs.items[f->first_include] : NULL;
    for (int exact = 1; exact >= 0; exact--) {
        uint32_t id = find_in(unit, &file, 1, name, params, num_params, exact);
        if (id == LANG_NONE)
            id = find_in(unit, includes, f->num_includes, name, params, num_params, exact);
        if (id != LANG_NONE)
            return id;
    }
    return LANG_NONE;
}

/* Locals and suggestions */

struct local *lookup_local(struct parser *p, str_id name)
{
    for (uint32_t i = p->locals.len; i-- > 0;)
        if (p->locals.items[i].name == name)
            return &p->locals.items[i];
    return NULL;
}

static void suggest_declared(struct parser *p, struct diag_guess *guess,
                             enum lookup_suggestion what)
{
    for (uint32_t f = 0; f < p->visible.len; f++) {
        const struct lang_unit *layer;
        const struct lang_file *file = lang_file(p->unit, p->visible.items[f], &layer);
        for (uint32_t i = 0; what == LOOKUP_VALUES && i < file->num_globals; i++)
            diag_guess_add(guess,
                           parse_text(p, lang_global(p->unit, file->first_global + i, NULL)->name));
        for (uint32_t i = 0; what == LOOKUP_FUNCTIONS && i < file->num_functions; i++)
            diag_guess_add(
                guess, parse_text(p, lang_function(p->unit, file->first_function + i, NULL)->name));
    }
}

static void suggest_types(struct parser *p, struct diag_guess *guess)
{
    for (ir_type_id type = IR_TYPE_VOID; type <= IR_TYPE_SAMPLER; type++)
        diag_guess_add(guess, ir_type_text(type));
    for (const struct lang_unit *layer = p->unit; layer; layer = layer->base)
        for (uint32_t i = 0; i < layer->user_types.len; i++)
            if (layer->user_types.items[i].name)
                diag_guess_add(guess, parse_text(p, layer->user_types.items[i].name));
}

const char *lookup_suggest(struct parser *p, const char *word, enum lookup_suggestion what)
{
    struct diag_guess guess;
    if (!diag_guess_begin(&guess, p->diags, word))
        return "";
    suggest_declared(p, &guess, what);
    for (uint32_t i = 0; what == LOOKUP_VALUES && i < p->locals.len; i++)
        diag_guess_add(&guess, parse_text(p, p->locals.items[i].name));
    for (int op = 0; what == LOOKUP_FUNCTIONS && op < IR_NUM_OPS; op++)
        if (ir_op_info((enum ir_op)op)->flags & OP_BUILTIN)
            diag_guess_add(&guess, ir_op_info((enum ir_op)op)->text);
    if (what != LOOKUP_VALUES)
        suggest_types(p, &guess);
    return diag_guess_text(&guess);
}

/* New locals */

static void check_redeclared(struct parser *p, str_id name, const struct token *at)
{
    for (uint32_t i = p->scope; i < p->locals.len; i++)
        if (name && p->locals.items[i].name == name) {
            PARSE_ERROR(p, parse_where_token(p, at), redefinition, parse_text(p, name));
            if (p->reported)
                diag_add(p->diags, DIAG_ID_previous_definition,
                         parse_where(p, p->locals.items[i].place, 0));
            return;
        }
}

struct local *parse_add_local(struct parser *p, const struct token *name_token, str_id name,
                              ir_type_id type, bool is_const)
{
    check_redeclared(p, name, name_token);
    uint32_t slot = p->unit->slots.len - p->first_slot;
    if (slot >= UINT16_MAX) {
        PARSE_ERROR(p, parse_where_token(p, name_token), lang_limit,
                    "the function has too many variables");
        p->panic = true;
    }
    vec_push(p->unit->arena, &p->unit->slots, (struct lang_slot){.name = name, .type = type});
    vec_push(p->unit->arena, &p->locals,
             (struct local){.name = name,
                            .type = type,
                            .slot = (uint16_t)slot,
                            .read_only = is_const,
                            .place = parse_place(name_token)});
    return &vec_last(&p->locals);
}
