// SPDX-License-Identifier: Apache-2.0
#include "bind/glob.h"

#include "base/hash.h"
#include "base/num.h"

#include <assert.h>
#include <stdlib.h>

enum edge_kind { EDGE_FREE, EDGE_CHAR, EDGE_ANY, EDGE_RANGES };

enum { NO_NODES = 1, FIRST_STATE = 2 }; /* deterministic states */
enum { MAX_STATES = 4096, MAX_NESTING = 64 };

void glob_set_init(struct glob_set *set, struct arena *arena)
{
    *set = (struct glob_set){.arena = arena};
    arena_init(&set->state_arena, arena->mem);
    vec_push(arena, &set->edges, (struct glob_edge){0});
}

void glob_set_finish(struct glob_set *set)
{
    arena_finish(&set->state_arena);
}

/* The code point at *text, which moves behind it. A byte outside UTF-8 counts as one. */
static uint32_t read_char(const char **text, const char *end)
{
    const unsigned char *at = (const unsigned char *)*text;
    size_t left = (size_t)(end - *text);
    unsigned len = at[0] >= 0xf0 ? 4 : at[0] >= 0xe0 ? 3 : at[0] >= 0xc0 ? 2 : 1;
    uint32_t c = len == 1 ? at[0] : at[0] & (0x7fu >> len);
    bool good = len <= left;
    for (unsigned i = 1; i < len && good; i++) {
        good = (at[i] & 0xc0u) == 0x80;
        c = c << 6 | (at[i] & 0x3fu);
    }
    *text += good ? len : 1;
    return good ? c : at[0];
}

/* ---- From the text to the automaton ---- */

struct compiler {
    struct glob_set *set;
    const char *at, *end;
    uint32_t node;                                   /* the end of the part that is read */
    uint32_t begins[MAX_NESTING], ends[MAX_NESTING]; /* of the open braces */
    unsigned depth;
};

static uint32_t add_node(struct glob_set *set)
{
    vec_push(set->arena, &set->nodes, 0);
    vec_push(set->arena, &set->glob_of_goal, 0);
    return set->nodes.len - 1;
}

static void add_edge(struct glob_set *set, uint32_t from, struct glob_edge edge)
{
    edge.next = set->nodes.items[from];
    set->nodes.items[from] = set->edges.len;
    vec_push(set->arena, &set->edges, edge);
}

/* Consumes one code point, to a new node. */
static void consume(struct compiler *c, struct glob_edge edge)
{
    edge.to = add_node(c->set);
    add_edge(c->set, c->node, edge);
    c->node = edge.to;
}

static const char *compile_set(struct compiler *c)
{
    struct glob_set *set = c->set;
    struct glob_edge edge = {.kind = EDGE_RANGES, .value = set->ranges.len};
    while (c->at < c->end && *c->at != ']') {
        uint32_t first = read_char(&c->at, c->end), last = first;
        if (c->end - c->at >= 2 && c->at[0] == '-' && c->at[1] != ']') {
            c->at++;
            last = read_char(&c->at, c->end);
        }
        if (last < first)
            return "has a range in '[]' whose end lies before its begin";
        vec_push(set->arena, &set->ranges, (struct glob_range){first, last});
    }
    if (c->at == c->end)
        return "has a '[' without ']'";
    c->at++;
    edge.count = set->ranges.len - edge.value;
    if (!edge.count)
        return "has nothing between '[' and ']'";
    consume(c, edge);
    return NULL;
}

static void compile_star(struct compiler *c)
{
    uint32_t loop = add_node(c->set);
    add_edge(c->set, c->node, (struct glob_edge){.kind = EDGE_FREE, .to = loop});
    add_edge(c->set, loop, (struct glob_edge){.kind = EDGE_ANY, .to = loop});
    c->node = loop;
}

static void skip_blanks(struct compiler *c)
{
    while (c->at < c->end && *c->at == ' ')
        c->at++;
}

/* An alternative begins at a node of its own. */
static void begin_alternative(struct compiler *c)
{
    c->node = add_node(c->set);
    add_edge(c->set, c->begins[c->depth - 1], (struct glob_edge){.kind = EDGE_FREE, .to = c->node});
    skip_blanks(c);
}

static void end_alternative(struct compiler *c)
{
    add_edge(c->set, c->node, (struct glob_edge){.kind = EDGE_FREE, .to = c->ends[c->depth - 1]});
}

static const char *open_brace(struct compiler *c)
{
    if (c->depth == MAX_NESTING)
        return "nests braces too deep";
    c->begins[c->depth] = c->node;
    c->ends[c->depth++] = add_node(c->set);
    begin_alternative(c);
    return NULL;
}

static const char *close_brace(struct compiler *c)
{
    if (!c->depth)
        return "has a '}' without '{'";
    end_alternative(c);
    c->node = c->ends[--c->depth];
    return NULL;
}

/* Blanks around alternatives say nothing; those behind one are followed by ',' or '}'. */
static bool is_blank_before_end(const struct compiler *c)
{
    const char *at = c->at;
    while (at < c->end && *at == ' ')
        at++;
    return c->depth && at > c->at && at < c->end && (*at == ',' || *at == '}');
}

static const char *compile_char(struct compiler *c)
{
    if (is_blank_before_end(c)) {
        skip_blanks(c);
        return NULL;
    }
    uint32_t letter = read_char(&c->at, c->end);
    switch (letter) {
    case '*': compile_star(c); return NULL;
    case '?': consume(c, (struct glob_edge){.kind = EDGE_ANY}); return NULL;
    case '[': return compile_set(c);
    case ']': return "has a ']' without '['";
    case '{': return open_brace(c);
    case '}': return close_brace(c);
    default: break;
    }
    if (letter == ',' && c->depth) {
        end_alternative(c);
        begin_alternative(c);
    } else {
        consume(c, (struct glob_edge){.kind = EDGE_CHAR, .value = letter});
    }
    return NULL;
}

static const char *compile(struct glob_set *set, const char *text, size_t len, uint32_t *out_goal)
{
    struct compiler c = {.set = set, .at = text, .end = text + len};
    const char *fault = NULL;
    uint32_t first = c.node = add_node(set);
    while (!fault && c.at < c.end)
        fault = compile_char(&c);
    if (!fault && c.depth)
        fault = "has a '{' without '}'";
    *out_goal = c.node;
    /* node 0 is where every glob begins */
    if (!fault && first)
        add_edge(set, 0, (struct glob_edge){.kind = EDGE_FREE, .to = first});
    return fault;
}

bool glob_is_plain(const char *text, size_t len)
{
    for (size_t i = 0; i < len; i++)
        if (strchr("*?[]{}", text[i]))
            return false;
    return true;
}

static void drop_states(struct glob_set *set)
{
    arena_finish(&set->state_arena);
    memset(&set->states, 0, sizeof set->states);
    memset(&set->members, 0, sizeof set->members);
    memset(&set->matches, 0, sizeof set->matches);
    memset(&set->work, 0, sizeof set->work);
    memset(&set->marks, 0, sizeof set->marks);
    memset(&set->state_table, 0, sizeof set->state_table);
    set->epoch = 0;
}

const char *glob_add(struct glob_set *set, const char *text, size_t len, uint32_t *out_glob)
{
    uint32_t hash = hash_bytes(text, len), goal;
    for (uint32_t at = hash, found; (found = table_next(&set->table, hash, &at));) {
        const struct glob_name *name = &set->texts.items[found - 1];
        if (name->len == len && memcmp(name->text, text, len) == 0) {
            *out_glob = found - 1;
            return NULL;
        }
    }
    if (!set->nodes.len)
        add_node(set);
    const char *fault = compile(set, text, len, &goal);
    if (fault)
        return fault;
    drop_states(set);
    *out_glob = set->goals.len;
    vec_push(set->arena, &set->goals, goal);
    set->glob_of_goal.items[goal] = set->goals.len;
    vec_push(set->arena, &set->texts,
             (struct glob_name){arena_strndup(set->arena, text, len), len});
    table_add(&set->table, set->arena, hash, set->goals.len);
    return NULL;
}

/* ---- Deterministic states ---- */

static void visit(struct glob_set *set, uint32_t node)
{
    if (set->marks.items[node] == set->epoch)
        return;
    set->marks.items[node] = set->epoch;
    vec_push(&set->state_arena, &set->work, node);
}

static void begin_set(struct glob_set *set)
{
    while (set->marks.len < set->nodes.len)
        vec_push(&set->state_arena, &set->marks, 0);
    set->epoch++;
    set->work.len = 0;
}

/* Follows the edges that consume nothing, from the nodes in `work`. */
static void close_set(struct glob_set *set)
{
    for (uint32_t i = 0; i < set->work.len; i++)
        for (uint32_t e = set->nodes.items[set->work.items[i]]; e; e = set->edges.items[e].next)
            if (set->edges.items[e].kind == EDGE_FREE)
                visit(set, set->edges.items[e].to);
    num_sort(set->work.items, set->work.len);
}

static uint32_t make_state(struct glob_set *set, uint32_t hash)
{
    struct arena *arena = &set->state_arena;
    struct glob_state state = {.first_member = set->members.len,
                               .num_members = set->work.len,
                               .first_match = set->matches.len};
    for (uint32_t i = 0; i < set->work.len; i++) {
        uint32_t glob = set->glob_of_goal.items[set->work.items[i]];
        vec_push(arena, &set->members, set->work.items[i]);
        if (glob)
            vec_push(arena, &set->matches, glob - 1);
    }
    state.num_matches = set->matches.len - state.first_match;
    if (state.num_matches)
        num_sort(&set->matches.items[state.first_match], state.num_matches);
    vec_push(arena, &set->states, state);
    table_add(&set->state_table, arena, hash, set->states.len - 1);
    return set->states.len - 1;
}

/* The state of the nodes in `work`. */
static uint32_t intern_state(struct glob_set *set)
{
    size_t size = set->work.len * sizeof *set->work.items;
    uint32_t hash = hash_bytes(set->work.items, size);
    for (uint32_t at = hash, found; (found = table_next(&set->state_table, hash, &at));) {
        const struct glob_state *state = &set->states.items[found];
        if (state->num_members == set->work.len
            && memcmp(&set->members.items[state->first_member], set->work.items, size) == 0)
            return found;
    }
    return make_state(set, hash);
}

static bool is_consumed(const struct glob_set *set, const struct glob_edge *edge, uint32_t letter)
{
    if (edge->kind == EDGE_CHAR)
        return edge->value == letter;
    for (uint32_t i = 0; edge->kind == EDGE_RANGES && i < edge->count; i++) {
        const struct glob_range *range = &set->ranges.items[edge->value + i];
        if (range->first <= letter && letter <= range->last)
            return true;
    }
    return edge->kind == EDGE_ANY;
}

static uint32_t step(struct glob_set *set, uint32_t from, uint32_t letter)
{
    begin_set(set);
    for (uint32_t i = 0; i < set->states.items[from].num_members; i++) {
        uint32_t node = set->members.items[set->states.items[from].first_member + i];
        for (uint32_t e = set->nodes.items[node]; e; e = set->edges.items[e].next)
            if (is_consumed(set, &set->edges.items[e], letter))
                visit(set, set->edges.items[e].to);
    }
    close_set(set);
    uint32_t to = intern_state(set);
    if (letter < GLOB_ASCII)
        set->states.items[from].next[letter] = to;
    return to;
}

static void start_states(struct glob_set *set)
{
    drop_states(set);
    vec_push(&set->state_arena, &set->states, (struct glob_state){0});
    begin_set(set);
    intern_state(set);
    visit(set, 0);
    close_set(set);
    uint32_t first = intern_state(set);
    assert(first == FIRST_STATE);
    (void)first;
}

const uint32_t *glob_match(struct glob_set *set, const char *name, size_t len, uint32_t *out_num)
{
    *out_num = 0;
    if (!set->goals.len)
        return NULL;
    if (!set->states.len || set->states.len > MAX_STATES)
        start_states(set);
    uint32_t state = FIRST_STATE;
    for (const char *at = name, *end = name + len; at < end && state != NO_NODES;) {
        uint32_t letter = read_char(&at, end);
        uint32_t next = letter < GLOB_ASCII ? set->states.items[state].next[letter] : 0;
        state = next ? next : step(set, state, letter);
    }
    const struct glob_state *last = &set->states.items[state];
    *out_num = last->num_matches;
    return set->matches.items + last->first_match;
}
