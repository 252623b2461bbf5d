// SPDX-License-Identifier: Apache-2.0
/*
 * Layers that differ only in values. A picked layer needs its patterns, but closures that several
 * layers have stand once, over variables:
 *
 *     if (the first)  { color = ...; roughness = ...; }
 *     if (the second) { color = ...; roughness = ...; }
 *     the closures of both with color and roughness
 *
 * So the code of closures does not grow with the layers, pixels with different picks run it
 * together, and a driver that masks branches in place of taking them computes it once.
 *
 * Two trees of closures are alike if their nodes are: op, function, number of operands. Operands
 * that are no closures may differ, if a variable can hold them.
 */
#include "closure/closure_priv.h"

#include "base/hash.h"

#include <assert.h>
#include <stdlib.h>

/* Nodes that stand at the same place of each member: `num` of them, in `refs`. */
struct alike {
    uint32_t first;
    ir_ref became;
};

struct merging {
    struct shader *shader;
    struct ir_graph *graph;
    uint32_t num; /* members */
    VEC(ir_ref) refs;
    VEC(struct alike) items; /* 0 unused */
    struct table table;
    struct closure_merged *out; /* NULL: only to see whether they are alike */
};

static const ir_ref *refs_of(const struct merging *m, uint32_t item)
{
    return &m->refs.items[m->items.items[item].first];
}

static bool are_equal(const ir_ref *refs, uint32_t num)
{
    for (uint32_t i = 1; i < num; i++)
        if (refs[i] != refs[0])
            return false;
    return true;
}

static bool can_vary(ir_type_id type)
{
    return type == IR_TYPE_FLOAT || type == IR_TYPE_INT || type == IR_TYPE_BOOL
           || (type >= IR_TYPE_VEC2 && type <= IR_TYPE_VEC4);
}

/* The item of different nodes; 0: it is not there. */
static uint32_t find_item(const struct merging *m, const ir_ref *refs, uint32_t hash)
{
    for (uint32_t at = hash, found; (found = table_next(&m->table, hash, &at));)
        if (memcmp(refs_of(m, found), refs, m->num * sizeof *refs) == 0)
            return found;
    return 0;
}

/* Notes nodes at one place; false if they cannot be merged. */
static bool add_item(struct merging *m, const ir_ref *refs)
{
    struct ir_graph *g = m->graph;
    if (are_equal(refs, m->num))
        return true;
    for (uint32_t i = 0; i < m->num; i++) {
        if (!refs[i] || ir_type_of(g, refs[i]) != ir_type_of(g, refs[0]))
            return false;
        const struct ir_node *node = ir_get(g, refs[i]), *first = ir_get(g, refs[0]);
        bool is_alike =
            node->op == first->op && node->attr == first->attr && node->num_args == first->num_args;
        if (ir_is_closure(m->graph, refs[i]) ? !is_alike : !can_vary(node->type))
            return false;
    }
    uint32_t hash = hash_bytes(refs, m->num * sizeof *refs);
    if (find_item(m, refs, hash))
        return true;
    struct alike item = {.first = m->refs.len};
    for (uint32_t i = 0; i < m->num; i++)
        vec_push(m->shader->arena, &m->refs, refs[i]);
    vec_push(m->shader->arena, &m->items, item);
    table_add(&m->table, m->shader->arena, hash, m->items.len - 1);
    return true;
}

/* Notes the operands of all closures below those that are noted. */
static bool add_operands(struct merging *m)
{
    ir_ref *args = ARENA_ARRAY(m->shader->arena, ir_ref, m->num);
    for (uint32_t item = 1; item < m->items.len; item++) {
        ir_ref first = *refs_of(m, item);
        if (!ir_is_closure(m->graph, first))
            continue;
        for (uint32_t k = 0; k < ir_get(m->graph, first)->num_args; k++) {
            for (uint32_t i = 0; i < m->num; i++)
                args[i] = ir_arg(m->graph, refs_of(m, item)[i], k);
            if (!add_item(m, args))
                return false;
        }
    }
    return true;
}

static struct merging begin(struct shader *shader, uint32_t num)
{
    struct merging m = {.shader = shader, .graph = shader->graph, .num = num};
    vec_push(shader->arena, &m.items, (struct alike){0});
    return m;
}

/* The parts of a surface that members may have. */
enum { NUM_PARTS = 3 };

static ir_ref *part_of(struct closure_surface *s, unsigned part)
{
    return part == 0 ? &s->bsdf : part == 1 ? &s->edf : &s->unlit;
}

static bool add_parts(struct merging *m, struct closure_surface *const *members)
{
    ir_ref *refs = ARENA_ARRAY(m->shader->arena, ir_ref, m->num);
    for (unsigned part = 0; part < NUM_PARTS; part++) {
        for (uint32_t i = 0; i < m->num; i++)
            refs[i] = *part_of(members[i], part);
        if (!add_item(m, refs))
            return false;
    }
    return add_operands(m);
}

bool closure_are_alike(struct shader *shader, struct closure_surface *a, struct closure_surface *b)
{
    struct closure_surface *members[] = {a, b};
    struct merging m = begin(shader, 2);
    return add_parts(&m, members);
}

/* ---- The merged surface ---- */

/* The name of the operand that a variable stands for: "roughness" of a leaf; 0: none. */
static str_id name_of(const struct merging *m, const struct closure_host *host, ir_ref closure,
                      uint32_t operand)
{
    const struct ir_node *node = ir_get(m->graph, closure);
    if (node->op != IR_LEAF || operand == 0 || closure_source(m->shader, closure))
        return operand == 0 || node->op == IR_CLOSURE_SCALE ? STR_weight : STR_picked;
    const uint32_t *functions = host->leaf_functions(host->user_data, node->attr);
    for (unsigned i = 0; i < NUM_LEAF_FUNCTIONS; i++) {
        if (functions[i] == LANG_NONE)
            continue;
        const struct lang_unit *unit;
        const struct lang_function *fn = lang_function(m->shader->unit, functions[i], &unit);
        if (operand - 1 < fn->num_params)
            return unit->slots.items[fn->first_slot + operand - 1].name;
    }
    return STR_picked;
}

static ir_ref varied(struct merging *m, uint32_t item, str_id name)
{
    const ir_ref *refs = refs_of(m, item);
    ir_type_id type = ir_type_of(m->graph, refs[0]);
    uint32_t local = shader_add_local(m->shader, name, type);
    m->shader->effects.locals.items[local].is_settled = true;
    struct closure_variable variable = {local, m->out->values.len};
    for (uint32_t i = 0; i < m->num; i++)
        vec_push(m->shader->arena, &m->out->values, refs[i]);
    vec_push(m->shader->arena, &m->out->variables, variable);
    return ir_build(m->graph, IR_LOCAL, type, local, NULL, 0);
}

/* Returns what stands for nodes at one place. */
static ir_ref became(struct merging *m, const ir_ref *refs, str_id name)
{
    if (are_equal(refs, m->num))
        return refs[0];
    uint32_t item = find_item(m, refs, hash_bytes(refs, m->num * sizeof *refs));
    assert(item);
    struct alike *known = &m->items.items[item];
    if (!known->became)
        known->became = varied(m, item, name);
    return known->became;
}

static void build_closure(struct merging *m, const struct closure_host *host, uint32_t item)
{
    ir_ref first = *refs_of(m, item);
    const struct ir_node node = *ir_get(m->graph, first);
    ir_ref *args = ARENA_ARRAY(m->shader->arena, ir_ref, node.num_args + 1u),
           *refs = ARENA_ARRAY(m->shader->arena, ir_ref, m->num);
    for (uint32_t k = 0; k < node.num_args; k++) {
        for (uint32_t i = 0; i < m->num; i++)
            refs[i] = ir_arg(m->graph, refs_of(m, item)[i], k);
        args[k] = became(m, refs, name_of(m, host, first, k));
    }
    m->items.items[item].became = ir_copy(m->graph, first, args);
}

struct place {
    ir_ref ref;
    uint32_t item;
};

static int compare_places(const void *a, const void *b)
{
    const struct place *x = a, *y = b;
    return x->ref != y->ref ? (x->ref < y->ref ? -1 : 1)
                            : (x->item > y->item) - (x->item < y->item);
}

/* Builds the closures, operands first. */
static void build_closures(struct merging *m, const struct closure_host *host)
{
    VEC(struct place) places = {0};
    for (uint32_t item = 1; item < m->items.len; item++)
        if (ir_is_closure(m->graph, *refs_of(m, item)))
            vec_push(m->shader->arena, &places, (struct place){*refs_of(m, item), item});
    if (places.len)
        qsort(places.items, places.len, sizeof *places.items, compare_places);
    for (uint32_t i = 0; i < places.len; i++)
        build_closure(m, host, places.items[i].item);
}

void closure_merge(struct shader *shader, const struct closure_host *host,
                   struct closure_surface *const *members, uint32_t num, struct closure_merged *out)
{
    struct merging m = begin(shader, num);
    bool are_alike = add_parts(&m, members);
    assert(are_alike);
    (void)are_alike;
    *out = (struct closure_merged){.surface = *members[0]};
    m.out = out;
    build_closures(&m, host);
    ir_ref *refs = ARENA_ARRAY(shader->arena, ir_ref, num);
    for (unsigned part = 0; part < NUM_PARTS; part++) {
        for (uint32_t i = 0; i < num; i++)
            refs[i] = *part_of(members[i], part);
        *part_of(&out->surface, part) = became(&m, refs, STR_picked);
    }
    out->surface.aovs.num = 0;
}
