// SPDX-License-Identifier: Apache-2.0
/*
 * Specialising a function without constant arguments gives the same result in every shader. So the
 * packer of a library does it once: it replaces trees by the trees of the versions (plan.c), which
 * a generation can use unchanged.
 *
 * Functions keep their ids and parameters. The step rewrites all arrays that trees refer to,
 * without the dropped parts.
 */
#include "base/hash.h"
#include "specialise/spec.h"

#include <assert.h>

struct copier {
    const struct lang_unit *from; /* unit of the tree that is copied */
    struct lang_unit *to;
    const struct lang_unit *made; /* layer of the versions */
    VEC(lang_ref) calls; /* calls of the function; a call comes after the calls in its arguments */
    uint8_t *is_used;    /* by slot */
    struct table runs;   /* 1 + a function, for each distinct sequence of slots */
    bool is_simple;      /* no call has very many arguments, or arguments with effects */
    bool asks;           /* whether the compiler knows a value */
};

static uint32_t copy_words(struct copier *c, const struct lang_unit *from, uint32_t first,
                           uint32_t count)
{
    uint32_t at = c->to->words.len;
    if (count)
        memcpy(vec_extend(c->to->arena, &c->to->words, count), from->words.items + first,
               count * sizeof(union ir_word));
    return at;
}

static uint32_t given_function(const struct copier *c, uint32_t id)
{
    if (id < c->made->base_functions)
        return id;
    id -= c->made->base_functions;
    assert(id < c->made->versions.len);
    return c->made->versions.items[id].origin;
}

static bool is_simple_call(const struct copier *c, const struct lang_node *call)
{
    uint32_t num_args = 0;
    for (lang_ref arg = call->b; arg; arg = ast_node(c->to, arg)->next, num_args++)
        if (lang_has_effects(c->to, arg))
            return false;
    return num_args <= SPEC_MAX_PARAMS;
}

static lang_ref copy_node(void *user_data, struct lang_node node)
{
    struct copier *c = user_data;
    lang_ref copy = c->to->nodes.len;
    switch (node.kind) {
    case LANG_CONST:
        node.a = copy_words(c, c->from, node.a, ir_type_info(node.type)->components);
        node.c = 0;
        break;
    case LANG_VAR: c->is_used[node.a] = true; break;
    case LANG_ASSIGN: node.c = 0; break;
    case LANG_OP: c->asks |= node.op == IR_KNOWN; break;
    case LANG_CALL:
        node.a = given_function(c, node.a);
        c->is_simple &= is_simple_call(c, &node);
        vec_push(c->to->arena, &c->calls, copy);
        break;
    default: break;
    }
    vec_push(c->to->arena, &c->to->nodes, node);
    return copy;
}

static uint32_t copy_refs(struct copier *c, const uint32_t *ids, uint32_t count, bool are_functions)
{
    uint32_t at = c->to->refs.len;
    for (uint32_t i = 0; i < count; i++)
        vec_push(c->to->arena, &c->to->refs, are_functions ? given_function(c, ids[i]) : ids[i]);
    return at;
}

static bool reads_option(const struct copier *c, const struct lang_function *fn)
{
    for (uint32_t i = 0; i < fn->num_globals; i++)
        if (lang_global(c->made, ast_globals(c->to, fn)[i], NULL)->kind == LANG_GLOBAL_OPTION)
            return true;
    return false;
}

/*
 * True if a generation would not change the tree of a function, unless arguments or callees are
 * constant.
 */
static bool is_final(const struct copier *c, const struct lang_function *fn)
{
    if (fn->flags & LANG_FN_EXPRESSION || !c->is_simple || c->asks || reads_option(c, fn))
        return false;
    for (uint32_t i = 0; i < fn->num_params; i++)
        if (!c->is_used[i] && ast_slot(c->to, fn, i)->mode == LANG_IN)
            return false;
    return true;
}

/*
 * Shares equal sequences of slots, because many expressions have inputs of equal names and types.
 */
static uint32_t copy_slots(struct copier *c, const struct lang_function *fn)
{
    const struct lang_slot *slots = ast_slot(c->from, fn, 0);
    uint32_t hash = hash_bytes(slots, fn->num_slots * sizeof *slots);
    for (uint32_t at = hash, found; (found = table_next(&c->runs, hash, &at));) {
        const struct lang_function *other = &c->to->functions.items[found - 1];
        if (other->num_slots == fn->num_slots
            && memcmp(ast_slot(c->to, other, 0), slots, fn->num_slots * sizeof *slots) == 0)
            return other->first_slot;
    }
    /* the index of the function that this one becomes, + 1 */
    table_add(&c->runs, c->to->arena, hash, c->to->functions.len + 1);
    uint32_t first = c->to->slots.len;
    memcpy(vec_extend(c->to->arena, &c->to->slots, fn->num_slots), slots,
           fn->num_slots * sizeof *slots);
    return first;
}

static struct lang_function copy_version(struct copier *c, uint32_t version)
{
    struct lang_function fn = *lang_function(c->made, version, &c->from);
    assert(fn.num_params <= fn.num_slots);
    c->calls.len = 0;
    c->is_simple = true;
    c->asks = false;
    c->is_used = arena_zalloc(c->to->arena, fn.num_slots);
    if (fn.body)
        fn.body = lang_copy(c->from, fn.body, c->to, copy_node, c);
    fn.first_slot = fn.num_slots ? copy_slots(c, &fn) : 0;
    const uint32_t *callees = ast_callees(c->from, &fn), *globals = ast_globals(c->from, &fn);
    fn.first_ref = copy_refs(c, callees, fn.num_callees, true);
    copy_refs(c, globals, fn.num_globals, false);
    return fn;
}

static struct lang_function copy_function(struct copier *c, uint32_t id, uint32_t version)
{
    struct lang_function fn = copy_version(c, version);
    assert(fn.num_params == lang_function(c->made, id, NULL)->num_params);
    fn.num_calls = c->calls.len;
    assert(ast_calls(c->to, &fn) == c->to->refs.items + c->to->refs.len);
    for (uint32_t i = 0; i < c->calls.len; i++)
        vec_push(c->to->arena, &c->to->refs, c->calls.items[i]);
    fn.flags |= lang_function(c->made, id, NULL)->flags & LANG_FN_STRINGS;
    if (is_final(c, &fn))
        fn.flags |= LANG_FN_FINAL;
    return fn;
}

/*
 * Makes the version of each function without constant arguments, with all parameters. Inline
 * expressions are always inlined.
 */
static uint32_t *make_versions(struct lang_unit *made, uint32_t first, uint32_t count)
{
    uint32_t *versions = ARENA_ARRAY(made->arena, uint32_t, count);
    for (uint32_t i = 0; i < count; i++) {
        bool is_called = !(lang_function(made, first + i, NULL)->flags & LANG_FN_EXPRESSION);
        versions[i] = is_called ? plan_note_any(made, first + i) : LANG_NONE;
    }
    lang_plan_finish(made);
    for (uint32_t i = 0; i < count; i++)
        versions[i] = versions[i] != LANG_NONE ? lang_plan_version(made, versions[i]) : first + i;
    return versions;
}

void lang_make_canonical(struct lang_unit *unit)
{
    struct lang_unit made, to = *unit;
    lang_unit_init(&made, unit->arena, unit->strings, unit);
    const uint32_t *versions = make_versions(&made, unit->base_functions, unit->functions.len);
    struct copier c = {.to = &to, .made = &made};
    memset(&to.nodes, 0, sizeof to.nodes);
    memset(&to.slots, 0, sizeof to.slots);
    memset(&to.words, 0, sizeof to.words);
    memset(&to.refs, 0, sizeof to.refs);
    memset(&to.functions, 0, sizeof to.functions);
    vec_push(unit->arena, &to.nodes, (struct lang_node){0});
    for (uint32_t i = 0; i < unit->functions.len; i++) {
        assert(to.functions.len == i);
        struct lang_function fn = copy_function(&c, unit->base_functions + i, versions[i]);
        vec_push(unit->arena, &to.functions, fn);
    }
    for (uint32_t i = 0; i < unit->globals.len; i++) {
        struct lang_global *global = &unit->globals.items[i];
        global->words = copy_words(&c, unit, global->words, global->num_words);
    }
    for (uint32_t i = 0; i < unit->files.len; i++) {
        struct lang_file *file = &unit->files.items[i];
        file->first_include =
            copy_refs(&c, unit->refs.items + file->first_include, file->num_includes, false);
    }
    assert(to.functions.len == unit->functions.len && made.functions.len == made.versions.len);
    *unit = to;
}
