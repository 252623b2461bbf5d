// SPDX-License-Identifier: Apache-2.0
/* Makes the version of a variant. The other files of this room hold the steps. */
#include "specialise/spec.h"

#include <assert.h>

static struct variant *variant_of(const struct spec *s)
{
    return &s->unit->plan->variants.items[s->variant];
}

static void reserve_slots(struct spec *s)
{
    if (s->fn.num_slots <= s->cap_slots)
        return;
    s->cap_slots = s->fn.num_slots < 64 ? 64 : s->fn.num_slots * 2u;
    s->known = ARENA_ARRAY(s->unit->arena, lang_ref, s->cap_slots);
    s->slots = ARENA_ARRAY(s->unit->arena, struct spec_slot, s->cap_slots);
}

static struct spec *open_variant(struct lang_unit *unit, uint32_t variant)
{
    struct spec *s = unit->plan->spec;
    s->variant = variant;
    s->fn = *lang_function(unit, variant_of(s)->function, &s->layer);
    assert(variant < unit->plan->variants.len && s->fn.num_params <= s->fn.num_slots);
    reserve_slots(s);
    return s;
}

static bool is_bound(const struct spec *s, uint32_t param)
{
    assert(param < s->fn.num_params);
    fact known = s->unit->plan->facts.items[variant_of(s)->first_fact + param];
    return known != FACT_UNSEEN && known != FACT_VARIES;
}

/* Bound parameters start as constants; an assigned one becomes a local. */
static void bind(struct spec *s, struct chain *out)
{
    for (uint32_t i = 0; i < s->fn.num_params; i++) {
        if (!is_bound(s, i))
            continue;
        struct lang_node value = {.kind = LANG_CONST, .type = ast_slot(s->layer, &s->fn, i)->type};
        value.a = s->unit->plan->facts.items[variant_of(s)->first_fact + i] - 1;
        s->changed = true;
        s->known[i] = spec_add(s, value);
        spec_append(
            s, out,
            spec_add(s, (struct lang_node){.kind = LANG_DECLARE, .a = i, .b = s->known[i]}));
    }
}

/* Records the arguments of a function whose tree stays unchanged. */
static void note_call(struct spec *s, const struct lang_node *call)
{
    struct lang_unit *unit = s->unit;
    fact args[SPEC_MAX_PARAMS];
    uint32_t i = 0;
    for (lang_ref ref = call->b; ref; ref = ast_node(s->layer, ref)->next, i++) {
        assert(i < SPEC_MAX_PARAMS);
        const struct lang_node *arg = ast_node(s->layer, ref);
        args[i] = arg->kind == LANG_CONST ? unit->words.len + 1 : FACT_VARIES;
        if (arg->kind != LANG_CONST)
            continue;
        uint32_t count = ir_type_info(arg->type)->components;
        memcpy(vec_extend(unit->arena, &unit->words, count), ast_words(s->layer, arg),
               count * sizeof(union ir_word));
    }
    uint32_t called = plan_note_call(unit, call->a, args, false);
    vec_push(unit->arena, &unit->plan->calls, called);
}

/* A function of the host or of a module takes all its arguments. */
static bool begin_final(struct spec *s)
{
    bool is_elsewhere = !s->fn.body || lang_module_name(s->unit, variant_of(s)->function);
    if (!(s->fn.flags & LANG_FN_FINAL) && !is_elsewhere)
        return false;
    for (uint32_t i = 0; i < s->fn.num_params && !is_elsewhere; i++)
        if (is_bound(s, i))
            return false;
    uint32_t first_call = s->unit->plan->calls.len;
    for (uint32_t i = 0; i < s->fn.num_calls && !is_elsewhere; i++)
        note_call(s, ast_node(s->layer, ast_calls(s->layer, &s->fn)[i]));
    struct variant *v = variant_of(s);
    v->is_final = true;
    v->first_call = first_call;
    return true;
}

/* True if all callees keep their trees too. */
static bool stays_final(const struct spec *s)
{
    const struct lang_plan *plan = s->unit->plan;
    uint32_t first_call = variant_of(s)->first_call;
    if (lang_module_name(s->unit, variant_of(s)->function))
        return true;
    for (uint32_t i = 0; i < s->fn.num_calls; i++) {
        assert(plan->calls.items[first_call + i] < plan->variants.len);
        const struct variant *called = &plan->variants.items[plan->calls.items[first_call + i]];
        if (called->version != called->function)
            return false;
    }
    return true;
}

static void forward(struct spec *s)
{
    uint32_t first_call = s->unit->plan->calls.len;
    if (s->fn.num_slots)
        memset(s->known, 0, s->fn.num_slots * sizeof *s->known);
    s->changed = false;
    struct chain statements = {0};
    bind(s, &statements);
    spec_statements(s, ast_node(s->layer, s->fn.body)->a, &statements);
    struct variant *v = variant_of(s);
    v->body = statements.first;
    v->changed = s->changed;
    v->first_call = first_call;
    assert(s->unit->plan->calls.len >= first_call);
    v->num_calls = s->unit->plan->calls.len - first_call;
}

static void begin(struct lang_unit *unit, uint32_t variant)
{
    struct spec *s = open_variant(unit, variant);
    if (!begin_final(s))
        forward(s);
}

/* Slots of the result: the remaining parameters, then the other named slots. */

static bool is_dropped(const struct spec *s, uint32_t param)
{
    return is_bound(s, param)
           || (param < SPEC_MAX_PARAMS && !variant_of(s)->keeps_unused && !s->slots[param].uses
               && ast_slot(s->layer, &s->fn, param)->mode == LANG_IN);
}

static void add_slot(struct spec *s, uint32_t index, struct lang_function *out)
{
    struct lang_slot slot = *ast_slot(s->layer, &s->fn, index);
    slot.assigned = (s->slots[index].uses & SLOT_WRITTEN) != 0;
    s->slots[index].number = out->num_slots++;
    vec_push(s->unit->arena, &s->unit->slots, slot);
}

static void finish_slots(struct spec *s, struct lang_function *out, struct lang_version *version)
{
    out->first_slot = s->unit->slots.len;
    out->num_slots = 0;
    for (uint32_t i = 0; i < s->fn.num_params; i++) {
        if (s->slots[i].is_dropped) {
            version->dropped[i / 32] |= 1u << i % 32;
            continue;
        }
        if (ast_slot(s->layer, &s->fn, i)->type == IR_TYPE_STRING)
            out->flags |= LANG_FN_STRINGS;
        add_slot(s, i, out);
    }
    out->num_params = out->num_slots;
    for (uint32_t i = 0; i < s->fn.num_slots; i++)
        if (s->slots[i].uses && (i >= s->fn.num_params || s->slots[i].is_dropped))
            add_slot(s, i, out);
    assert(s->unit->slots.len == out->first_slot + out->num_slots);
    assert(out->num_slots <= s->fn.num_slots);
    for (uint32_t i = 0; i < s->vars.len; i++) {
        struct lang_node *node = spec_node(s, s->vars.items[i]);
        node->a = s->slots[node->a].number;
    }
}

static uint32_t add_version(struct spec *s, lang_ref body)
{
    struct lang_unit *unit = s->unit;
    struct lang_function fn = s->fn;
    struct lang_version version = {.origin = variant_of(s)->function, .variant = s->variant};
    fn.flags &= LANG_FN_EXPRESSION;
    finish_slots(s, &fn, &version);
    assert(fn.num_params <= s->fn.num_params);
    fn.body = spec_add(s, (struct lang_node){.kind = LANG_BLOCK, .a = body});
    lang_uses_record(&s->uses, unit, &fn);
    lang_inherit_flags(unit, &fn);
    while (unit->versions.len < unit->functions.len) /* functions that the parser wrote */
        vec_push(unit->arena, &unit->versions, (struct lang_version){.origin = LANG_NONE});
    vec_push(unit->arena, &unit->functions, fn);
    vec_push(unit->arena, &unit->versions, version);
    assert(unit->versions.len == unit->functions.len);
    return unit->base_functions + unit->functions.len - 1;
}

static void start_backward(struct spec *s)
{
    s->vars.len = s->longs.len = s->num_lists = 0;
    lang_uses_init(&s->uses);
    if (s->fn.num_slots)
        memset(s->slots, 0, s->fn.num_slots * sizeof *s->slots);
    for (uint32_t i = 0; i < s->fn.num_params; i++)
        if (ast_slot(s->layer, &s->fn, i)->mode != LANG_IN)
            s->slots[i].uses = SLOT_READ;
}

static void finish(struct lang_unit *unit, uint32_t variant)
{
    struct spec *s = open_variant(unit, variant);
    if (variant_of(s)->is_final) {
        if (stays_final(s)) {
            variant_of(s)->version = variant_of(s)->function;
            return;
        }
        forward(s); /* the plan has its calls already, so this pass adds no arguments */
    }
    s->changed = variant_of(s)->changed;
    start_backward(s);
    spec_resolve(s);
    lang_ref body = spec_single(s, spec_sweep(s, variant_of(s)->body));
    for (uint32_t i = 0; i < s->fn.num_params; i++)
        s->changed |= s->slots[i].is_dropped = is_dropped(s, i);
    variant_of(s)->version = s->changed ? add_version(s, body) : variant_of(s)->function;
}

void lang_plan_finish(struct lang_unit *unit)
{
    struct lang_plan *plan = plan_of(unit);
    for (uint32_t id = plan->num_ids; id-- > 0;) /* the loop adds callees with smaller ids */
        for (uint32_t link = plan->first_variant[id]; link;
             link = plan->variants.items[link - 1].next)
            begin(unit, link - 1);
    for (uint32_t id = 0; id < plan->num_ids; id++)
        for (uint32_t link = plan->first_variant[id]; link;
             link = plan->variants.items[link - 1].next)
            finish(unit, link - 1);
}
