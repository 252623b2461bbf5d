// SPDX-License-Identifier: Apache-2.0
/*
 * The interpreter: a call with constant arguments becomes values.
 *
 * A value of any type is the sequence of its scalars (structs by member, arrays by element), so a
 * member, an element or a column of a variable is a range of its words. Behaviour that GLSL leaves
 * undefined ends the evaluation.
 */
#include "tree/interpret.h"

#include "tree/ast.h"

#include <assert.h>

enum {
    MAX_CALL_DEPTH = 64,
    MAX_EXPRESSION_DEPTH = 400,
    MAX_WORDS = 1 << 16,
    MAX_CALL_STEPS = 20000, /* of one constant */
    MAX_STEPS = 4000000,    /* of all constants of a generation: half a second */
};

struct frame { /* an active call */
    const struct lang_unit *layer;
    const struct lang_function *fn;
    union ir_word *words; /* words of all slots */
    uint32_t *offsets;    /* by slot: its first word */
    uint8_t *defined;     /* by slot: it has a value */
    union ir_word *result;
};

struct eval {
    const struct lang_unit *unit;
    struct arena *scratch;
    uint32_t *steps_left;
    unsigned call_depth, expression_depth;
    struct frame frame;
};

/* The target of an assignment: consecutive words, or up to 4 words that a swizzle selects. */
struct place {
    union ir_word *base;
    ir_type_id type;
    bool scattered;
    uint8_t map[4];
};

static bool eval_expression(struct eval *ev, lang_ref ref, union ir_word *out);
static bool eval_function(struct eval *ev, const struct frame *frame);

/* Copying words takes time, too: a step is a node, or this many words. */
enum { WORDS_PER_STEP = 16 };

/* False if the steps do not suffice. */
static bool spend(struct eval *ev, uint32_t steps)
{
    bool suffices = *ev->steps_left >= steps;
    *ev->steps_left = suffices ? *ev->steps_left - steps : 0;
    return suffices;
}

/* Places */

static bool find_index(struct eval *ev, lang_ref ref, uint32_t limit, uint32_t *out_index)
{
    union ir_word index;
    if (!eval_expression(ev, ref, &index))
        return false;
    *out_index = index.u;
    return index.u < limit;
}

static void select_word(struct place *place, uint32_t index)
{
    assert(!place->scattered || index < sizeof place->map);
    place->base += place->scattered ? place->map[index] : index;
    place->scattered = false;
}

static bool find_element(struct eval *ev, const struct lang_node *node, ir_type_id container,
                         struct place *place)
{
    uint32_t size = ast_type_words(ev->unit, node->type), index;
    if (size == 0
        || !find_index(ev, ast_node(ev->frame.layer, node->a)->next,
                       ast_type_words(ev->unit, container) / size, &index))
        return false;
    assert(size == 1 || !place->scattered);
    if (size == 1)
        select_word(place, index);
    else
        place->base += index * size;
    return true;
}

static void find_swizzle(const struct lang_node *node, struct place *place)
{
    assert(node->b >> 8 <= sizeof place->map);
    uint8_t map[4] = {0};
    for (unsigned i = 0; i < node->b >> 8; i++) {
        uint8_t from = node->b >> 2 * i & 3;
        map[i] = place->scattered ? place->map[from] : from;
    }
    memcpy(place->map, map, sizeof map);
    place->scattered = true;
}

/* The words of a constant. The generation sets the values of options. */
static const union ir_word *global_words(struct eval *ev, const struct lang_node *node)
{
    const struct lang_unit *layer;
    const struct lang_global *global = lang_global(ev->unit, node->a, &layer);
    return global->kind == LANG_GLOBAL_CONST ? layer->words.items + global->words : NULL;
}

static bool find_place(struct eval *ev, lang_ref ref, struct place *place)
{
    const struct lang_node *node = ast_node(ev->frame.layer, ref);
    if (node->kind == LANG_VAR) {
        *place = (struct place){.base = ev->frame.words + ev->frame.offsets[node->a],
                                .type = node->type};
        return true;
    }
    if (node->kind == LANG_GLOBAL) { /* read-only: the parser rejects assignments to globals */
        *place = (struct place){.base = (union ir_word *)(uintptr_t)global_words(ev, node),
                                .type = node->type};
        return place->base != NULL;
    }
    ir_type_id container = ast_node(ev->frame.layer, node->a)->type;
    if (node->kind != LANG_OP || !find_place(ev, node->a, place))
        return false;
    ir_type_id type;
    switch (node->op) {
    case IR_SWIZZLE: find_swizzle(node, place); break;
    case IR_MEMBER:
        place->base += ast_member_offset(ev->unit, container, node->b, ast_type_words, &type);
        break;
    default:
        if (!find_element(ev, node, container, place))
            return false;
    }
    place->type = node->type;
    return true;
}

static void load(struct eval *ev, const struct place *place, union ir_word *out)
{
    uint32_t size = ast_type_words(ev->unit, place->type);
    assert(!place->scattered || size <= sizeof place->map);
    for (uint32_t i = 0; i < size; i++)
        out[i] = place->base[place->scattered ? place->map[i] : i];
}

static void store(struct eval *ev, const struct place *place, const union ir_word *words)
{
    uint32_t size = ast_type_words(ev->unit, place->type);
    assert(!place->scattered || size <= sizeof place->map);
    for (uint32_t i = 0; i < size; i++)
        place->base[place->scattered ? place->map[i] : i] = words[i];
}

/* Expressions */

static bool eval_aggregate(struct eval *ev, lang_ref first, union ir_word *out)
{
    for (lang_ref ref = first; ref; ref = ast_node(ev->frame.layer, ref)->next) {
        if (!eval_expression(ev, ref, out))
            return false;
        out += ast_type_words(ev->unit, ast_node(ev->frame.layer, ref)->type);
    }
    return true;
}

/* A part of a value without a place, such as the result of a call. */
static bool eval_part(struct eval *ev, const struct lang_node *node, union ir_word *out)
{
    const struct lang_node *whole = ast_node(ev->frame.layer, node->a);
    uint32_t num_words = ast_type_words(ev->unit, whole->type);
    union ir_word *words = arena_alloc(ev->scratch, num_words * sizeof *words);
    if (!eval_expression(ev, node->a, words))
        return false;
    uint32_t size = ast_type_words(ev->unit, node->type), offset, index;
    ir_type_id type;
    if (node->op == IR_MEMBER) {
        offset = ast_member_offset(ev->unit, whole->type, node->b, ast_type_words, &type);
    } else {
        if (size == 0 || !find_index(ev, whole->next, num_words / size, &index))
            return false;
        offset = index * size;
    }
    assert(offset + size <= num_words);
    memcpy(out, words + offset, size * sizeof *out);
    return true;
}

static bool eval_builtin(struct eval *ev, const struct lang_node *node, union ir_word *out)
{
    struct ir_value args[AST_MAX_OPERANDS], result;
    unsigned count = 0;
    for (lang_ref ref = node->a; ref; ref = ast_node(ev->frame.layer, ref)->next) {
        ir_type_id type = ast_node(ev->frame.layer, ref)->type;
        if (ast_is_user_type(type) || ir_type_info(type)->components == 0
            || count == AST_MAX_OPERANDS)
            return false;
        args[count].type = type;
        if (!eval_expression(ev, ref, args[count++].w))
            return false;
    }
    if (!ir_eval_op(node->op, node->type, node->b, args, count, &result))
        return false;
    memcpy(out, result.w, ir_type_info(node->type)->components * sizeof *out);
    return true;
}

static bool eval_logic(struct eval *ev, const struct lang_node *node, union ir_word *out)
{
    if (!eval_expression(ev, node->a, out))
        return false;
    bool decided = out->u == (node->op == IR_LOR);
    return decided || eval_expression(ev, ast_node(ev->frame.layer, node->a)->next, out);
}

static bool eval_select(struct eval *ev, const struct lang_node *node, union ir_word *out)
{
    union ir_word condition;
    if (!eval_expression(ev, node->a, &condition))
        return false;
    lang_ref taken = ast_node(ev->frame.layer, node->a)->next;
    if (!condition.u)
        taken = ast_node(ev->frame.layer, taken)->next;
    return eval_expression(ev, taken, out);
}

static bool eval_op(struct eval *ev, const struct lang_node *node, union ir_word *out)
{
    switch (node->op) {
    case IR_SELECT: return eval_select(ev, node, out);
    case IR_LAND:
    case IR_LOR: return eval_logic(ev, node, out);
    case IR_MEMBER:
    case IR_INDEX: return eval_part(ev, node, out);
    case IR_CONSTRUCT:
        return ast_is_user_type(node->type) ? eval_aggregate(ev, node->a, out)
                                            : eval_builtin(ev, node, out);
    default: return eval_builtin(ev, node, out);
    }
}

/*
 * The variable or global that contains the expression; NULL for the result of a computation.
 */
static const struct lang_node *place_root(const struct lang_unit *layer,
                                          const struct lang_node *node)
{
    while (node->kind == LANG_OP
           && (node->op == IR_SWIZZLE || node->op == IR_MEMBER || node->op == IR_INDEX))
        node = ast_node(layer, node->a);
    return node->kind == LANG_VAR || node->kind == LANG_GLOBAL ? node : NULL;
}

static bool eval_place(struct eval *ev, lang_ref ref, const struct lang_node *root,
                       union ir_word *out)
{
    assert(root->kind != LANG_VAR || root->a < ev->frame.fn->num_slots);
    struct place place;
    if ((root->kind == LANG_VAR && !ev->frame.defined[root->a]) || !find_place(ev, ref, &place))
        return false;
    load(ev, &place, out);
    return true;
}

/* Calls */

static bool open_frame(struct eval *ev, uint32_t id, struct frame *frame)
{
    *frame = (struct frame){0};
    frame->fn = lang_function(ev->unit, id, &frame->layer);
    assert(frame->fn->num_params <= frame->fn->num_slots);
    frame->offsets = arena_alloc(ev->scratch, frame->fn->num_slots * sizeof *frame->offsets);
    frame->defined = arena_zalloc(ev->scratch, frame->fn->num_slots);
    uint32_t size = 0;
    for (uint32_t i = 0; i < frame->fn->num_slots && size <= MAX_WORDS; i++) {
        frame->offsets[i] = size;
        size += ast_type_words(ev->unit, ast_slot(frame->layer, frame->fn, i)->type);
    }
    uint32_t result = ast_type_words(ev->unit, frame->fn->return_type);
    if (size > MAX_WORDS || result > MAX_WORDS || !spend(ev, (size + result) / WORDS_PER_STEP))
        return false;
    frame->words = arena_zalloc(ev->scratch, (size + result) * sizeof *frame->words);
    frame->result = frame->words + size;
    return true;
}

/* Copies arguments to the callee's frame; places[] receives the target of each out parameter. */
static bool eval_arguments(struct eval *ev, lang_ref first, struct frame *callee,
                           struct place *places)
{
    uint32_t i = 0;
    for (lang_ref ref = first; ref; ref = ast_node(ev->frame.layer, ref)->next, i++) {
        const struct lang_slot *param = ast_slot(callee->layer, callee->fn, i);
        if (param->mode != LANG_IN && !find_place(ev, ref, &places[i]))
            return false;
        if (param->mode != LANG_OUT
            && !eval_expression(ev, ref, callee->words + callee->offsets[i]))
            return false;
        callee->defined[i] = param->mode != LANG_OUT;
    }
    assert(i == callee->fn->num_params);
    return true;
}

static bool return_outputs(struct eval *ev, lang_ref first, const struct frame *callee,
                           const struct place *places)
{
    uint32_t i = 0;
    for (lang_ref ref = first; ref; ref = ast_node(ev->frame.layer, ref)->next, i++) {
        if (ast_slot(callee->layer, callee->fn, i)->mode == LANG_IN)
            continue;
        if (!callee->defined[i])
            return false;
        store(ev, &places[i], callee->words + callee->offsets[i]);
        ev->frame.defined[ast_target_slot(ev->frame.layer, ref)] = 1;
    }
    assert(i == callee->fn->num_params);
    return true;
}

static bool eval_call(struct eval *ev, const struct lang_node *node, union ir_word *out)
{
    struct frame callee;
    if (!open_frame(ev, node->a, &callee))
        return false;
    struct place *places = arena_alloc(ev->scratch, callee.fn->num_params * sizeof *places);
    if (!eval_arguments(ev, node->b, &callee, places) || !eval_function(ev, &callee)
        || !return_outputs(ev, node->b, &callee, places))
        return false;
    memcpy(out, callee.result, ast_type_words(ev->unit, node->type) * sizeof *out);
    return true;
}

static bool eval_any(struct eval *ev, lang_ref ref, union ir_word *out)
{
    const struct lang_node *node = ast_node(ev->frame.layer, ref);
    switch (node->kind) {
    case LANG_CONST:
        memcpy(out, ast_words(ev->frame.layer, node),
               ast_type_words(ev->unit, node->type) * sizeof *out);
        return true;
    case LANG_VAR:
    case LANG_INPUT:
        memcpy(out, ev->frame.words + ev->frame.offsets[node->a],
               ast_type_words(ev->unit, node->type) * sizeof *out);
        return ev->frame.defined[node->a];
    case LANG_CALL: return eval_call(ev, node, out);
    default: break;
    }
    const struct lang_node *root = place_root(ev->frame.layer, node);
    return root ? eval_place(ev, ref, root, out) : eval_op(ev, node, out);
}

static bool eval_expression(struct eval *ev, lang_ref ref, union ir_word *out)
{
    uint32_t num_words = ast_type_words(ev->unit, ast_node(ev->frame.layer, ref)->type);
    if (ev->expression_depth == MAX_EXPRESSION_DEPTH || !spend(ev, 1 + num_words / WORDS_PER_STEP))
        return false;
    ev->expression_depth++;
    bool ok = eval_any(ev, ref, out);
    ev->expression_depth--;
    return ok;
}

/* Statements */

enum flow { FLOW_NEXT, FLOW_BREAK, FLOW_CONTINUE, FLOW_RETURN, FLOW_FAIL };

static enum flow run_one(struct eval *ev, lang_ref ref); /* runs a statement or a block */

static union ir_word *temporary(struct eval *ev, ir_type_id type, union ir_word *small)
{
    uint32_t size = ast_type_words(ev->unit, type);
    return size <= 16 ? small : arena_alloc(ev->scratch, size * sizeof *small);
}

static bool run_declare(struct eval *ev, const struct lang_node *node)
{
    assert(node->a < ev->frame.fn->num_slots);
    ev->frame.defined[node->a] = 0;
    if (!node->b)
        return true;
    union ir_word small[16],
        *value = temporary(ev, ast_node(ev->frame.layer, node->b)->type, small);
    if (!eval_expression(ev, node->b, value))
        return false;
    uint32_t size = ast_type_words(ev->unit, ast_node(ev->frame.layer, node->b)->type);
    memcpy(ev->frame.words + ev->frame.offsets[node->a], value, size * sizeof *value);
    ev->frame.defined[node->a] = 1;
    return true;
}

/* x op= y computes `x op y` in the types of the operands, then converts to the type of x. */
static bool apply_operator(struct eval *ev, const struct lang_node *node, const struct place *place,
                           union ir_word *words)
{
    if (!ev->frame.defined[ast_target_slot(ev->frame.layer, node->a)])
        return false;
    struct ir_value args[2] = {{.type = place->type},
                               {.type = ast_node(ev->frame.layer, node->b)->type}},
                    result;
    if (ast_is_user_type(args[0].type) || ast_is_user_type(args[1].type))
        return false;
    load(ev, place, args[0].w);
    memcpy(args[1].w, words, ir_type_info(args[1].type)->components * sizeof *words);
    if (!ir_eval_op(node->op, place->type, 0, args, 2, &result))
        return false;
    memcpy(words, result.w, ir_type_info(place->type)->components * sizeof *words);
    return true;
}

static bool run_assign(struct eval *ev, const struct lang_node *node)
{
    union ir_word small[16],
        *value = temporary(ev, ast_node(ev->frame.layer, node->b)->type, small);
    struct place place;
    if (!eval_expression(ev, node->b, value) || !find_place(ev, node->a, &place))
        return false;
    if (node->op != IR_NUM_OPS && !apply_operator(ev, node, &place, value))
        return false;
    assert(place.type == ast_node(ev->frame.layer, node->b)->type || node->op != IR_NUM_OPS);
    store(ev, &place, value);
    ev->frame.defined[ast_target_slot(ev->frame.layer, node->a)] = 1;
    return true;
}

static enum flow run_if(struct eval *ev, const struct lang_node *node)
{
    union ir_word condition;
    if (!eval_expression(ev, node->a, &condition))
        return FLOW_FAIL;
    lang_ref taken = condition.u ? node->b : node->c;
    return taken ? run_one(ev, taken) : FLOW_NEXT;
}

static enum flow run_loop(struct eval *ev, const struct lang_node *node)
{
    bool test_first = node->kind != LANG_DO;
    lang_ref step = ast_step(ev->frame.layer, node);
    if (node->kind == LANG_FOR && node->a && run_one(ev, node->a) == FLOW_FAIL)
        return FLOW_FAIL;
    for (;;) {
        union ir_word condition = {.u = 1};
        if (test_first && node->b && !eval_expression(ev, node->b, &condition))
            return FLOW_FAIL;
        if (!condition.u || !spend(ev, 1))
            return condition.u ? FLOW_FAIL : FLOW_NEXT;
        enum flow flow = node->c ? run_one(ev, node->c) : FLOW_NEXT;
        if (flow == FLOW_FAIL || flow == FLOW_RETURN)
            return flow;
        if (flow == FLOW_BREAK)
            return FLOW_NEXT;
        if (step && run_one(ev, step) == FLOW_FAIL)
            return FLOW_FAIL;
        test_first = true;
    }
}

static enum flow run_return(struct eval *ev, const struct lang_node *node)
{
    return !node->a || eval_expression(ev, node->a, ev->frame.result) ? FLOW_RETURN : FLOW_FAIL;
}

static enum flow run_call(struct eval *ev, const struct lang_node *node)
{
    union ir_word small[16],
        *unused = temporary(ev, ast_node(ev->frame.layer, node->a)->type, small);
    return eval_expression(ev, node->a, unused) ? FLOW_NEXT : FLOW_FAIL;
}

static enum flow run_list(struct eval *ev, lang_ref first)
{
    for (lang_ref ref = first; ref; ref = ast_node(ev->frame.layer, ref)->next) {
        enum flow flow = run_one(ev, ref);
        if (flow != FLOW_NEXT)
            return flow;
    }
    return FLOW_NEXT;
}

static enum flow run_one(struct eval *ev, lang_ref ref)
{
    const struct lang_node *node = ast_node(ev->frame.layer, ref);
    switch (node->kind) {
    case LANG_DECLARE: return run_declare(ev, node) ? FLOW_NEXT : FLOW_FAIL;
    case LANG_ASSIGN: return run_assign(ev, node) ? FLOW_NEXT : FLOW_FAIL;
    case LANG_EXPR: return run_call(ev, node);
    case LANG_IF: return run_if(ev, node);
    case LANG_FOR:
    case LANG_WHILE:
    case LANG_DO: return run_loop(ev, node);
    case LANG_BLOCK: return run_list(ev, node->a);
    case LANG_RETURN: return run_return(ev, node);
    case LANG_BREAK: return FLOW_BREAK;
    default: return FLOW_CONTINUE;
    }
}

static bool eval_function(struct eval *ev, const struct frame *frame)
{
    if (ev->call_depth == MAX_CALL_DEPTH)
        return false;
    struct frame caller = ev->frame;
    ev->frame = *frame;
    ev->call_depth++;
    enum flow flow = run_one(ev, frame->fn->body);
    ev->call_depth--;
    ev->frame = caller;
    return flow == FLOW_RETURN || (flow == FLOW_NEXT && frame->fn->return_type == IR_TYPE_VOID);
}

static bool is_plain(ir_type_id type)
{
    return !ast_is_user_type(type) && ir_type_info(type)->components > 0;
}

bool lang_eval_call(const struct lang_unit *unit, uint32_t id, const struct ir_value *args,
                    struct ir_value *results, uint32_t *steps_left, struct arena *scratch)
{
    struct eval ev = {.unit = unit, .scratch = scratch, .steps_left = steps_left};
    struct frame frame;
    if (!open_frame(&ev, id, &frame))
        return false;
    for (uint32_t i = 0; i < frame.fn->num_params; i++) {
        const struct lang_slot *param = ast_slot(frame.layer, frame.fn, i);
        if (!is_plain(param->type))
            return false;
        if (param->mode == LANG_OUT)
            continue;
        memcpy(frame.words + frame.offsets[i], args++->w,
               ir_type_info(param->type)->components * sizeof *frame.words);
        frame.defined[i] = 1;
    }
    bool returns = frame.fn->return_type != IR_TYPE_VOID;
    if ((returns && !is_plain(frame.fn->return_type)) || !eval_function(&ev, &frame))
        return false;
    assert(ev.call_depth == 0 && ev.expression_depth == 0);
    if (returns)
        *results++ = ast_value(frame.fn->return_type, frame.result);
    for (uint32_t i = 0; i < frame.fn->num_params; i++) {
        const struct lang_slot *param = ast_slot(frame.layer, frame.fn, i);
        if (param->mode == LANG_IN)
            continue;
        if (!frame.defined[i])
            return false;
        *results++ = ast_value(param->type, frame.words + frame.offsets[i]);
    }
    return true;
}

bool lang_eval_constant(struct lang_unit *generated, uint32_t id, const struct ir_value *args,
                        struct ir_value *results, struct arena *scratch)
{
    uint32_t left = MAX_STEPS - generated->eval_steps,
             allowed = left < MAX_CALL_STEPS ? left : MAX_CALL_STEPS, unused = allowed;
    bool ok = lang_eval_call(generated, id, args, results, &unused, scratch);
    generated->eval_steps += allowed - unused;
    return ok;
}
