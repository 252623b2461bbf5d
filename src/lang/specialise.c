// SPDX-License-Identifier: Apache-2.0
/* Versions of functions: finding those that exist, making new ones. The partial evaluator is in spec_*.c. */
#include "lang/specialise.h"

#include "base/hash.h"

static struct lang_versions *versions_of(struct lang_unit *unit)
{
    if (!unit->versions)
        unit->versions = ARENA_NEW(unit->arena, struct lang_versions);
    return unit->versions;
}

bool spec_is_worth_binding(const struct ir_value *value)
{
    return value->type == IR_TYPE_BOOL || value->type == IR_TYPE_STRING;
}

/* The table of versions */

static uint32_t words_of(const struct lang_unit *unit, lang_ref constant)
{
    return ir_type_info(ast_node(unit, constant)->type)->components;
}

static uint32_t hash_key(const struct lang_unit *unit, uint32_t id, const lang_ref *bound, uint32_t num_bound, bool keeps)
{
    uint64_t h = hash_mix(id, keeps);
    for (uint32_t i = 0; i < num_bound; i++) {
        if (!bound[i])
            continue;
        const union ir_word *words = ast_words(unit, ast_node(unit, bound[i]));
        h = hash_mix(h, i);
        for (uint32_t k = 0; k < words_of(unit, bound[i]); k++)
            h = hash_mix(h, words[k].u);
    }
    return (uint32_t)(h ^ (h >> 32));
}

static bool is_version(const struct lang_unit *unit, const struct version *version, uint32_t hash, uint32_t id,
                       const lang_ref *bound, uint32_t num_bound, bool keeps)
{
    if (version->hash != hash || version->from != id || version->keeps_unused != keeps)
        return false;
    const lang_ref *other = unit->versions->bound.items + version->first_bound;
    for (uint32_t i = 0; i < num_bound; i++) {
        if (!bound[i] != !other[i])
            return false;
        if (bound[i] && memcmp(ast_words(unit, ast_node(unit, bound[i])), ast_words(unit, ast_node(unit, other[i])),
                               words_of(unit, bound[i]) * sizeof(union ir_word)) != 0)
            return false;
    }
    return true;
}

static void grow_table(struct lang_unit *unit)
{
    struct lang_versions *versions = unit->versions;
    uint32_t slots = versions->table ? (versions->table_mask + 1) * 2 : 64;
    versions->table = ARENA_ARRAY(unit->arena, uint32_t, slots);
    versions->table_mask = slots - 1;
    for (uint32_t i = 0; i < versions->items.len; i++) {
        uint32_t slot = versions->items.items[i].hash & versions->table_mask;
        while (versions->table[slot])
            slot = (slot + 1) & versions->table_mask;
        versions->table[slot] = i + 1;
    }
}

/* The version's index in items, or where it is new, its place in the table's *out_slot and LANG_NONE. */
static uint32_t find_version(const struct lang_unit *unit, uint32_t hash, uint32_t id, const lang_ref *bound,
                             uint32_t num_bound, bool keeps, uint32_t *out_slot)
{
    const struct lang_versions *versions = unit->versions;
    uint32_t slot = hash & versions->table_mask;
    for (; versions->table[slot]; slot = (slot + 1) & versions->table_mask) {
        uint32_t index = versions->table[slot] - 1;
        if (is_version(unit, &versions->items.items[index], hash, id, bound, num_bound, keeps))
            return index;
    }
    *out_slot = slot;
    return LANG_NONE;
}

/* Making a version */

static struct spec begin(struct lang_unit *unit, const struct lang_bindings *options, uint32_t id, bool keeps)
{
    struct spec s = {.unit = unit, .options = options, .keeps_unused = keeps, .flags = LANG_FN_PURE | LANG_FN_STRAIGHT};
    versions_of(unit); /* has the scratch stack */
    s.fn = *lang_function(unit, id, &s.layer);
    s.flags |= s.fn.flags & LANG_FN_EXPRESSION;
    s.known = ARENA_ARRAY(unit->arena, lang_ref, s.fn.num_slots);
    s.uses = arena_zalloc(unit->arena, s.fn.num_slots);
    s.mentions = ARENA_ARRAY(unit->arena, lang_ref, s.fn.num_slots);
    s.literals = arena_zalloc(unit->arena, s.fn.num_slots);
    return s;
}

/* Bound parameters become what is known at the start; one that is assigned becomes a local. */
static void bind(struct spec *s, const lang_ref *bound, uint32_t num_bound, struct chain *out)
{
    for (uint32_t i = 0; i < num_bound; i++) {
        if (!bound[i])
            continue;
        s->changed = true;
        s->known[i] = bound[i];
        lang_ref value = spec_add(s, *spec_node(s, bound[i]));
        spec_node(s, value)->c = 0;
        spec_append(s, out, spec_add(s, (struct lang_node){.kind = LANG_DECLARE, .a = i, .b = value}));
    }
}

static bool is_dropped(const struct spec *s, const lang_ref *bound, uint32_t num_bound, uint32_t param)
{
    if (param < num_bound && bound[param])
        return true;
    return param < SPEC_MAX_PARAMS && !s->keeps_unused && !s->uses[param]
           && ast_slot(s->layer, &s->fn, param)->mode == LANG_IN;
}

/* Slots of the result: the parameters that are left, then what else is named. */
static void finish_slots(struct spec *s, const lang_ref *bound, uint32_t num_bound, struct lang_function *out)
{
    uint32_t *numbers = ARENA_ARRAY(s->unit->arena, uint32_t, s->fn.num_slots);
    out->first_slot = s->unit->slots.len;
    uint32_t count = 0;
    for (unsigned pass = 0; pass < 2; pass++) {
        for (uint32_t i = 0; i < s->fn.num_slots; i++) {
            bool is_param = i < s->fn.num_params && !is_dropped(s, bound, num_bound, i);
            if (pass == 0 ? !is_param : is_param || !s->uses[i])
                continue;
            struct lang_slot slot = *ast_slot(s->layer, &s->fn, i);
            slot.assigned = (s->uses[i] & SLOT_WRITTEN) != 0;
            if (slot.type == IR_TYPE_STRING && is_param)
                s->flags |= LANG_FN_STRINGS;
            numbers[i] = count++;
            vec_push(s->unit->arena, &s->unit->slots, slot);
        }
        if (pass == 0)
            out->num_params = (uint16_t)count;
    }
    out->num_slots = (uint16_t)count;
    for (uint32_t i = 0; i < s->vars.len; i++)
        spec_node(s, s->vars.items[i])->a = numbers[spec_node(s, s->vars.items[i])->a];
    for (uint32_t i = 0; i < s->fn.num_params && i < SPEC_MAX_PARAMS; i++)
        if (is_dropped(s, bound, num_bound, i))
            out->dropped[i / 32] |= 1u << i % 32;
}

static uint32_t push_refs(struct lang_unit *unit, const uint32_t *ids, uint32_t count)
{
    uint32_t first = unit->refs.len;
    for (uint32_t i = 0; i < count; i++)
        vec_push(unit->arena, &unit->refs, ids[i]);
    return first;
}

static uint32_t finish(struct spec *s, uint32_t id, const lang_ref *bound, uint32_t num_bound, lang_ref body)
{
    struct lang_unit *unit = s->unit;
    struct lang_function fn = s->fn;
    fn.origin = id + 1;
    fn.dropped[0] = fn.dropped[1] = 0;
    finish_slots(s, bound, num_bound, &fn);
    fn.flags = s->flags;
    fn.body = spec_add(s, (struct lang_node){.kind = LANG_BLOCK, .a = body});
    fn.num_nodes = s->num_nodes;
    fn.num_callees = s->callees.len;
    fn.first_callee = push_refs(unit, s->callees.items, s->callees.len);
    fn.num_globals = s->globals.len;
    fn.first_global = push_refs(unit, s->globals.items, s->globals.len);
    vec_push(unit->arena, &unit->functions, fn);
    return unit->base_functions + unit->functions.len - 1;
}

static bool drops_anything(const struct spec *s)
{
    for (uint32_t i = 0; i < s->fn.num_params; i++)
        if (is_dropped(s, NULL, 0, i))
            return true;
    return false;
}

static uint32_t make_version(struct lang_unit *unit, const struct lang_bindings *options, uint32_t id, const lang_ref *bound,
                             uint32_t num_bound, bool keeps)
{
    uint32_t nodes = unit->nodes.len, words = unit->words.len, functions = unit->functions.len;
    struct spec s = begin(unit, options, id, keeps);
    for (uint32_t i = 0; i < s.fn.num_params; i++)
        if (ast_slot(s.layer, &s.fn, i)->mode != LANG_IN)
            s.uses[i] = SLOT_READ;
    struct chain statements = {0};
    bind(&s, bound, num_bound, &statements);
    spec_statements(&s, ast_node(s.layer, s.fn.body)->a, &statements);
    lang_ref body = spec_sweep(&s, statements.first);
    if (spec_is_planned(unit))
        body = spec_forward(&s, body);
    if (s.changed || drops_anything(&s))
        return finish(&s, id, bound, num_bound, body);
    if (unit->functions.len == functions) { /* nothing refers to what was built */
        unit->nodes.len = nodes;
        unit->words.len = words;
    }
    return id;
}

void spec_visit(struct lang_unit *unit, uint32_t id, const lang_ref *bound)
{
    uint32_t num_bound = lang_function(unit, id, NULL)->num_params;
    struct spec s = begin(unit, NULL, id, false);
    struct chain statements = {0};
    bind(&s, bound, num_bound < SPEC_MAX_PARAMS ? num_bound : SPEC_MAX_PARAMS, &statements);
    spec_statements(&s, ast_node(s.layer, s.fn.body)->a, &statements);
}

/* Constants that are part of a tree may become something else there. */
static uint32_t copy_bound(struct lang_unit *unit, const lang_ref *bound, uint32_t num_bound)
{
    struct lang_versions *versions = unit->versions;
    uint32_t first = versions->bound.len;
    for (uint32_t i = 0; i < num_bound; i++) {
        lang_ref copy = bound[i] ? unit->nodes.len : 0;
        if (copy)
            vec_push(unit->arena, &unit->nodes, *ast_node(unit, bound[i]));
        vec_push(unit->arena, &versions->bound, copy);
    }
    return first;
}

uint32_t spec_function(struct lang_unit *unit, const struct lang_bindings *options, uint32_t id, const lang_ref *bound,
                       bool keeps_unused)
{
    struct lang_versions *versions = versions_of(unit);
    uint32_t num_bound = lang_function(unit, id, NULL)->num_params;
    if (num_bound > SPEC_MAX_PARAMS)
        num_bound = SPEC_MAX_PARAMS;
    bool is_free = true;
    for (uint32_t i = 0; i < num_bound; i++)
        is_free &= !bound[i];
    bool is_done = id >= unit->base_functions; /* a version needs no second look */
    if (is_free && ((is_done && !spec_is_planned(unit)) || versions->depth == SPEC_MAX_DEPTH))
        return id;
    if (!versions->table || (versions->items.len + 1) * 2 > versions->table_mask)
        grow_table(unit);
    uint32_t hash = hash_key(unit, id, bound, num_bound, keeps_unused), slot;
    if (spec_is_planned(unit)) /* what was found before the plan does not count any more */
        hash = ~hash;
    uint32_t index = find_version(unit, hash, id, bound, num_bound, keeps_unused, &slot);
    if (index != LANG_NONE)
        return versions->items.items[index].to;
    uint32_t first_bound = copy_bound(unit, bound, num_bound);
    lang_ref copies[SPEC_MAX_PARAMS];
    if (num_bound)
        memcpy(copies, versions->bound.items + first_bound, num_bound * sizeof *copies);
    versions->depth++;
    uint32_t to = make_version(unit, options, id, copies, num_bound, keeps_unused);
    versions->depth--;
    struct version version = {.from = id, .to = to, .hash = hash, .first_bound = first_bound, .keeps_unused = keeps_unused};
    if (find_version(unit, hash, id, bound, num_bound, keeps_unused, &slot) == LANG_NONE) { /* the table may have grown */
        vec_push(unit->arena, &versions->items, version);
        versions->table[slot] = versions->items.len;
    }
    return to;
}

static bool is_bindable(const struct lang_unit *layer, const struct lang_function *fn, uint32_t param)
{
    const struct lang_slot *slot = ast_slot(layer, fn, param);
    return slot->mode == LANG_IN && !ast_is_user_type(slot->type) && ir_type_info(slot->type)->components > 0;
}

uint32_t lang_specialise(struct lang_unit *generated, uint32_t id, const struct lang_bindings *bindings)
{
    const struct lang_unit *layer;
    struct lang_function fn = *lang_function(generated, id, &layer);
    lang_ref bound[SPEC_MAX_PARAMS] = {0};
    struct spec s = {.unit = generated};
    if (fn.flags & LANG_FN_EXPRESSION)
        return id;
    for (uint32_t i = 0; bindings->bound && i < fn.num_params && i < SPEC_MAX_PARAMS; i++)
        if (bindings->bound[i] && is_bindable(layer, &fn, i))
            bound[i] = spec_constant(&s, bindings->bound[i], 0);
    return spec_function(generated, bindings, id, bound, false);
}

bool lang_param_dropped(const struct lang_unit *generated, uint32_t version, uint32_t given, unsigned index)
{
    if (version == given || index >= SPEC_MAX_PARAMS)
        return false;
    return lang_function(generated, version, NULL)->dropped[index / 32] >> index % 32 & 1;
}
