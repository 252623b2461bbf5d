// SPDX-License-Identifier: Apache-2.0
/*
 * How a surface is lit, as a fragment that follows on the one that the surface is itself
 * (lang/fragment.h): leaves are not found and weighted, their functions not called where a shading
 * model's inputs are no constants, its lights the usual ones and nothing is displaced.
 *
 *     key      number of lights, function and type of each
 *     results  what the colour begins with; of each part the leaf, which is the model's, the scalar
 * and the value more     1 if there are lights, number of closures and the elements of their
 * leaves, number of parts and the place of each
 */
#include "closure/closure_priv.h"

#include "lang/fragment.h"

enum { MAX_LIGHTS = 8, MAX_CLOSURES = 60, MAX_PARTS = 100, PART_RESULTS = 3 };

bool closure_is_usual(const struct shader *shader, const struct closure_host *host,
                      const struct closure_lighting *lighting, ir_ref root)
{
    const struct closure_point *point = host->point;
    bool is_new = !point->position && !point->normal && !point->view;
    return root && root == shader->model.root && is_new && lighting->lights && lighting->environment
           && !lighting->two_sided && !shader->scatters && shader->lights.len <= MAX_LIGHTS;
}

static unsigned lights_key(const struct shader *shader, uint16_t *key)
{
    unsigned n = 0;
    key[n++] = (uint16_t)shader->lights.len;
    for (uint32_t i = 0; i < shader->lights.len; i++) {
        key[n++] = (uint16_t)shader->lights.items[i].function;
        key[n++] = (uint16_t)shader->lights.items[i].type;
    }
    return n;
}

/* The key has 16 bits for each. */
static bool has_key(const struct shader *shader)
{
    for (uint32_t i = 0; i < shader->lights.len; i++)
        if (shader->lights.items[i].function > UINT16_MAX || shader->lights.items[i].type < 0
            || shader->lights.items[i].type > UINT16_MAX)
            return false;
    return true;
}

/* ---- What the fragment's host knows ---- */

struct lit {
    struct shader *shader;
    const struct closure_host *host;
    struct closure_lit *state;
};

static ir_ref named(void *user_data, str_id name, ir_type_id type)
{
    const struct lit *l = user_data;
    struct closure_light *light = &l->state->light;
    if (!light->direction && (name == STR_L || name == STR_light))
        closure_sample_light(l->shader, l->host, light);
    switch (name) {
    case STR_V: return closure_view(l->shader, l->host);
    case STR_N: return closure_normal(l->shader, l->host);
    case STR_P: return closure_position(l->shader, l->host);
    case STR_L: return light->direction;
    case STR_light: return light->intensity;
    case STR_sample_index: return ir_build(l->shader->graph, IR_SAMPLE, IR_TYPE_INT, 0, NULL, 0);
    default: return ir_poison(l->shader->graph, type);
    }
}

static str_id name_of(void *user_data, ir_ref node)
{
    const struct lit *l = user_data;
    const struct closure_point *point = l->host->point;
    if (node == point->view || node == point->normal || node == point->position)
        return node == point->view ? STR_V : node == point->normal ? STR_N : STR_P;
    if (node == l->state->light.direction || node == l->state->light.intensity)
        return node == l->state->light.direction ? STR_L : STR_light;
    return ir_get(l->shader->graph, node)->op == IR_SAMPLE ? STR_sample_index : 0;
}

/* The origin that an element of the model has already: of its node. */
static uint32_t origin_of(struct shader *shader, uint32_t element)
{
    struct ir_graph *g = shader->graph;
    uint32_t outer = shader->model.origin;
    if (!element || element == FRAGMENT_OUTER)
        return element ? outer : 0;
    for (uint32_t i = g->origins.len; i-- > 1;)
        if (g->origins.items[i].element == element && g->origins.items[i].parent == outer)
            return i;
    return ir_add_origin(g, 0, element, outer);
}

static void set_origin(void *user_data, uint32_t element)
{
    const struct lit *l = user_data;
    l->shader->graph->origin = origin_of(l->shader, element);
}

static struct fragment_host host_of(struct lit *l)
{
    return (struct fragment_host){.unit = l->shader->unit,
                                  .graph = l->shader->graph,
                                  .lang = l->host->lang,
                                  .user_data = l,
                                  .origin = set_origin,
                                  .own = 0,
                                  .outer = l->shader->model.origin,
                                  .named = named,
                                  .name = name_of};
}

/* ---- Taking down ---- */

struct notes { /* `more` and the results */
    uint16_t codes[3 + MAX_CLOSURES + MAX_PARTS];
    ir_ref results[1 + PART_RESULTS * MAX_PARTS];
    unsigned len, num_results;
};

/* False where a leaf is no element of the model. */
static bool note_closures(struct notes *notes, const struct shader *shader, uint32_t first)
{
    uint32_t count = shader->closures.len - first;
    notes->codes[notes->len++] = (uint16_t)count;
    for (uint32_t i = first; i < shader->closures.len && count <= MAX_CLOSURES; i++) {
        const struct ir_origin *origin = &shader->graph->origins.items[shader->closures.items[i]];
        if (origin->parent != shader->model.origin || !origin->element
            || origin->element >= FRAGMENT_OUTER)
            return false;
        notes->codes[notes->len++] = (uint16_t)origin->element;
    }
    return count <= MAX_CLOSURES;
}

/* The model's leaf that a leaf of weight 1 was made of; 0: none. */
static ir_ref leaf_of_model(const struct shader *shader, ir_ref unit)
{
    const struct ir_graph *g = shader->graph;
    const struct ir_node *node = ir_get(g, unit);
    for (unsigned i = 1; i < shader->model.num_nodes; i++) {
        ir_ref ref = shader->model.nodes[i];
        const struct ir_node *other = ir_get(g, ref);
        if (other->op == IR_LEAF && other->attr == node->attr && other->origin == node->origin
            && other->num_args == node->num_args
            && memcmp(ir_args(g, ref) + 1, ir_args(g, unit) + 1,
                      (node->num_args - 1) * sizeof(ir_ref))
                   == 0)
            return ref;
    }
    return 0;
}

/* False where a part is of no leaf of the model. */
static bool note_parts(struct notes *notes, const struct shader *shader,
                       const struct closure_lit *state)
{
    unsigned count = 0, first = notes->len++;
    for (unsigned place = 0; place < NUM_PLACES; place++)
        for (uint32_t i = 0; i < state->at[place].parts.len; i++) {
            const struct closure_part *part = &state->at[place].parts.items[i];
            ir_ref leaf = leaf_of_model(shader, part->leaf);
            if (!leaf || ++count > MAX_PARTS)
                return false;
            notes->codes[notes->len++] = (uint16_t)place;
            notes->results[notes->num_results++] = leaf;
            notes->results[notes->num_results++] = part->scalar;
            notes->results[notes->num_results++] = part->value;
        }
    notes->codes[first] = (uint16_t)count;
    return true;
}

void closure_record_lit(struct shader *shader, const struct closure_host *host,
                        uint32_t first_closure, struct closure_lit *state)
{
    struct notes notes = {.codes = {state->light.intensity != 0},
                          .results = {state->base},
                          .len = 1,
                          .num_results = 1};
    uint16_t key[1 + 2 * MAX_LIGHTS];
    if (!has_key(shader) || !note_closures(&notes, shader, first_closure)
        || !note_parts(&notes, shader, state))
        return;
    struct lit l = {shader, host, state};
    struct fragment_host fragment_host = host_of(&l);
    fragment_record_follower(&fragment_host, shader->model.fragment,
                             &(struct fragment_follower){.nodes = shader->model.nodes,
                                                         .num_nodes = shader->model.num_nodes,
                                                         .results = notes.results,
                                                         .num_results = notes.num_results,
                                                         .key = key,
                                                         .num_key = lights_key(shader, key),
                                                         .more = notes.codes,
                                                         .num_more = notes.len});
}

/* ---- Restoring ---- */

static bool has_lights(const struct shader *shader, const struct lang_unit *lowest,
                       const struct lang_fragment *fragment)
{
    uint16_t key[1 + 2 * MAX_LIGHTS];
    unsigned num_key = lights_key(shader, key);
    return has_key(shader) && fragment->pattern_len == num_key
           && memcmp(lowest->codes.items + fragment->first_code, key, num_key * sizeof *key) == 0;
}

static const struct lang_fragment *find(struct shader *shader, const struct lang_unit *lowest)
{
    uint16_t follower = lowest->fragments.items[shader->model.fragment - 1].follower;
    const struct lang_fragment *fragment = follower ? &lowest->fragments.items[follower - 1] : NULL;
    return fragment && has_lights(shader, lowest, fragment) ? fragment : NULL;
}

/* The results' nodes stand in `nodes` by the numbers in `results`. */
static void take_parts(struct lit *l, const uint16_t *results, const uint16_t *more,
                       const ir_ref *nodes)
{
    struct shader *shader = l->shader;
    struct closure_lit *state = l->state;
    state->base = nodes[*results++];
    if (*more++ && !state->light.direction)
        closure_sample_light(shader, l->host, &state->light);
    for (unsigned count = *more++; count > 0; count--) {
        uint32_t origin = origin_of(shader, *more++);
        vec_push(shader->arena, &shader->closures, origin);
    }
    for (unsigned count = *more++; count > 0; count--, results += PART_RESULTS) {
        struct closure_parts *list = &state->at[*more++];
        struct closure_part part = {
            .leaf = nodes[results[0]], .scalar = nodes[results[1]], .value = nodes[results[2]]};
        vec_push(shader->arena, &list->parts, part);
    }
}

bool closure_restore_lit(struct shader *shader, const struct closure_host *host,
                         struct closure_lit *state)
{
    const struct lang_unit *lowest = lang_lowest(shader->unit);
    const struct shader_model *model = &shader->model;
    const struct lang_fragment *fragment = shader->unit->recorder ? NULL : find(shader, lowest);
    if (!fragment)
        return false;
    struct lit l = {shader, host, state};
    struct fragment_host fragment_host = host_of(&l);
    uint32_t before = shader->graph->origin;
    shader->graph->origin = 0;
    size_t room = fragment_room(fragment, model->num_nodes - 1);
    ir_ref *nodes = memcpy(arena_alloc(shader->arena, room * sizeof *nodes), model->nodes,
                           model->num_nodes * sizeof *nodes);
    bool *known = memcpy(arena_alloc(shader->arena, room * sizeof *known), model->known,
                         model->num_nodes * sizeof *known);
    const uint16_t *codes =
        fragment_restore(&fragment_host, lowest, fragment, model->num_nodes - 1, nodes, known);
    shader->graph->origin = before;
    if (fragment_host.has_folded) { /* a leaf may be gone */
        state->light = (struct closure_light){0};
        return false;
    }
    unsigned num_results = *codes++;
    take_parts(&l, codes, codes + num_results, nodes);
    return true;
}
