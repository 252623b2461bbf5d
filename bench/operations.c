// SPDX-License-Identifier: Apache-2.0
#include "bench/operations.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define HEADER_WORDS 5
#define BOUND_WORD 3

/* SPIR-V 1.0, sections 3.7, 3.20 and 3.32 */
enum {
    OP_UNDEF = 1,
    OP_LINE = 8,
    OP_EXT_INST = 12,
    OP_ENTRY_POINT = 15,
    OP_TYPE_INT = 21,
    OP_TYPE_FLOAT = 22,
    OP_TYPE_VECTOR = 23,
    OP_TYPE_MATRIX = 24,
    OP_TYPE_POINTER = 32,
    OP_CONSTANT_TRUE = 41,
    OP_CONSTANT = 43,
    OP_FUNCTION = 54,
    OP_FUNCTION_END = 56,
    OP_VARIABLE = 59,
    OP_LOAD = 61,
    OP_STORE = 62,
    OP_DECORATE = 71,
    OP_COMPOSITE_CONSTRUCT = 80,
    OP_IMAGE_SAMPLE = 87,
    OP_IMAGE_READ = 98,
    OP_CONVERT_U_TO_F = 112,
    OP_I_ADD = 128,
    OP_PHI = 245,
    OP_LOOP_MERGE = 246,
    OP_SELECTION_MERGE = 247,
    OP_LABEL = 248,
    OP_BRANCH = 249,
    OP_BRANCH_CONDITIONAL = 250,
    OP_SWITCH = 251,
    OP_RETURN = 253,
    OP_UNREACHABLE = 255,
    OP_NO_LINE = 317,
    STORAGE_OUTPUT = 3,
    STORAGE_PRIVATE = 6,
    DECORATION_LOCATION = 30,
    DECORATION_INDEX = 32
};

struct range {
    uint32_t first, last;
};

static bool is_in(uint32_t op, const struct range *ranges, size_t count)
{
    for (size_t i = 0; i < count; ++i)
        if (op >= ranges[i].first && op <= ranges[i].last)
            return true;
    return false;
}

/* Returns what computes; the others move values, or only say something. */
static bool is_operation(uint32_t op)
{
    static const struct range ranges[] = {
        {OP_EXT_INST, OP_EXT_INST},       /* functions */
        {OP_IMAGE_SAMPLE, OP_IMAGE_READ}, /* samples of textures */
        {103, 107},                       /* their sizes */
        {109, 123},                       /* conversions */
        {126, 191},                       /* arithmetic, logic, comparisons */
        {194, 205},                       /* bits */
        {207, 215},                       /* derivatives */
        {OP_BRANCH_CONDITIONAL, OP_SWITCH},
    };
    return is_in(op, ranges, sizeof ranges / sizeof *ranges);
}

/* Whether the words behind the first are a type and the result's id. */
static bool has_type(uint32_t op)
{
    static const struct range ranges[] = {
        {OP_UNDEF, OP_UNDEF},
        {OP_EXT_INST, OP_EXT_INST},
        {OP_CONSTANT_TRUE, 55},
        {57, OP_LOAD},
        {65, 70},
        {77, OP_IMAGE_READ},
        {100, 107},
        {109, 215},
        {OP_PHI, OP_PHI},
    };
    return is_in(op, ranges, sizeof ranges / sizeof *ranges);
}

static bool ends_block(uint32_t op)
{
    return op == OP_LOOP_MERGE || op == OP_SELECTION_MERGE
           || (op >= OP_BRANCH && op <= OP_UNREACHABLE);
}

/* The facts about an id. */
struct known {
    uint32_t components;      /* of a type, or of the value's type */
    uint32_t of;              /* of a pointer or a vector: the type in it */
    bool is_first, is_second; /* a variable: of location 0; of index 1 there */
};

struct text {
    uint32_t *words;
    size_t num, capacity;
};

struct pass {
    const uint32_t *words;
    size_t num_words;
    enum count_of what;
    struct known *known;
    uint32_t bound, next_id;
    uint32_t entry_point, function;                      /* ids */
    uint32_t uint_type, float_type, vector_type, output; /* 0: not found */
    uint32_t counter, one;
    uint32_t weight; /* of the block up to here */
    bool is_added;   /* to the counter */
    bool failed;     /* no memory */
    struct text globals, functions;
};

/* ---- Text ---- */

static void put_words(struct pass *pass, struct text *text, const uint32_t *words, size_t count)
{
    if (text->num + count > text->capacity) {
        size_t capacity = (text->num + count) * 2;
        uint32_t *more = realloc(text->words, capacity * sizeof *more);
        if (!more) {
            pass->failed = true;
            return;
        }
        text->words = more;
        text->capacity = capacity;
    }
    memcpy(text->words + text->num, words, count * sizeof *words);
    text->num += count;
}

static void put(struct pass *pass, struct text *text, uint32_t op, const uint32_t *operands,
                uint32_t count)
{
    const uint32_t head = (count + 1) << 16 | op;
    put_words(pass, text, &head, 1);
    put_words(pass, text, operands, count);
}

#define PUT(pass, text, op, ...) \
    put(pass, text, op, (const uint32_t[]){__VA_ARGS__}, \
        (uint32_t)(sizeof((const uint32_t[]){__VA_ARGS__}) / sizeof(uint32_t)))

/* ---- What the module says ---- */

/* No id is 0, so a literal among operands says nothing. */
static struct known *about(struct pass *pass, uint32_t id)
{
    return &pass->known[id < pass->bound ? id : 0];
}

static void note_type(struct pass *pass, uint32_t op, const uint32_t *words)
{
    struct known *type = about(pass, words[1]);
    type->components = 1;
    switch (op) {
    case OP_TYPE_INT:
        if (words[2] == 32 && !words[3])
            pass->uint_type = words[1];
        break;
    case OP_TYPE_VECTOR:
    case OP_TYPE_MATRIX:
        type->of = words[2];
        type->components = about(pass, words[2])->components * words[3];
        break;
    case OP_TYPE_POINTER: type->of = words[3]; break;
    default: break;
    }
}

static void note_output(struct pass *pass, const uint32_t *words)
{
    const struct known *variable = about(pass, words[2]);
    uint32_t type = about(pass, words[1])->of;
    if (words[3] != STORAGE_OUTPUT || !variable->is_first || variable->is_second
        || about(pass, type)->components != 4)
        return;
    pass->output = words[2];
    pass->vector_type = type;
    pass->float_type = about(pass, type)->of;
}

static void note(struct pass *pass, uint32_t op, const uint32_t *words)
{
    uint32_t count = *words >> 16;
    if (op == OP_ENTRY_POINT)
        pass->entry_point = words[2];
    if (op == OP_DECORATE && count == 4) {
        about(pass, words[1])->is_first |= words[2] == DECORATION_LOCATION && words[3] == 0;
        about(pass, words[1])->is_second |= words[2] == DECORATION_INDEX && words[3] == 1;
    }
    if (op >= 19 && op <= 39 && count > 1)
        note_type(pass, op, words);
    if (has_type(op) && count > 2)
        about(pass, words[2])->components = about(pass, words[1])->components;
    if (op == OP_VARIABLE)
        note_output(pass, words);
}

/* ---- Counting ---- */

/* The components of the largest value that the operation takes or gives. */
static uint32_t size_of(struct pass *pass, uint32_t op, const uint32_t *words)
{
    if (!is_operation(op))
        return 0;
    if (!has_type(op))
        return 1; /* a branch */
    uint32_t size = about(pass, words[1])->components, count = *words >> 16;
    bool takes_images = op >= OP_IMAGE_SAMPLE && op <= 107;
    for (uint32_t i = op == OP_EXT_INST ? 5 : 3; i < count && !takes_images; ++i)
        if (about(pass, words[i])->components > size)
            size = about(pass, words[i])->components;
    return size;
}

static uint32_t weight_of(struct pass *pass, uint32_t op, const uint32_t *words)
{
    bool moves_nothing = op == OP_LABEL || op == OP_VARIABLE || op == OP_LINE || op == OP_NO_LINE
                         || op == OP_LOOP_MERGE || op == OP_SELECTION_MERGE;
    switch (pass->what) {
    case COUNT_OPERATIONS: return size_of(pass, op, words);
    case COUNT_READS: return op >= OP_IMAGE_SAMPLE && op <= OP_IMAGE_READ;
    default: return !moves_nothing;
    }
}

static uint32_t load_counter(struct pass *pass)
{
    PUT(pass, &pass->functions, OP_LOAD, pass->uint_type, pass->next_id, pass->counter);
    return pass->next_id++;
}

static void add_block(struct pass *pass)
{
    uint32_t number = pass->next_id++, before = load_counter(pass), after = pass->next_id++;
    PUT(pass, &pass->globals, OP_CONSTANT, pass->uint_type, number, pass->weight);
    PUT(pass, &pass->functions, OP_I_ADD, pass->uint_type, after, before, number);
    PUT(pass, &pass->functions, OP_STORE, pass->counter, after);
    pass->is_added = true;
}

static void write_output(struct pass *pass)
{
    uint32_t number = load_counter(pass), red = pass->next_id++, color = pass->next_id++;
    PUT(pass, &pass->functions, OP_CONVERT_U_TO_F, pass->float_type, red, number);
    PUT(pass, &pass->functions, OP_COMPOSITE_CONSTRUCT, pass->vector_type, color, red, red, red,
        pass->one);
    PUT(pass, &pass->functions, OP_STORE, pass->output, color);
}

/* An instruction of a function. */
static void visit(struct pass *pass, uint32_t op, const uint32_t *words)
{
    uint32_t count = *words >> 16;
    if (op == OP_LABEL) {
        pass->weight = 0;
        pass->is_added = false;
    }
    if (!pass->is_added)
        pass->weight += weight_of(pass, op, words);
    if (ends_block(op) && !pass->is_added) {
        if (op == OP_LOOP_MERGE || op == OP_SELECTION_MERGE) /* the branch follows */
            pass->weight += weight_of(pass, words[count] & 0xffff, words + count);
        add_block(pass);
    }
    if (op == OP_RETURN && pass->function == pass->entry_point)
        write_output(pass);
    put_words(pass, &pass->functions, words, count);
}

/* ---- The module ---- */

/* Between the module's own globals and its functions. */
static void declare(struct pass *pass)
{
    uint32_t zero = pass->next_id++, pointer = pass->next_id++, one = 0;
    const float one_as_float = 1.0f;
    memcpy(&one, &one_as_float, sizeof one);
    if (!pass->uint_type) {
        pass->uint_type = pass->next_id++;
        PUT(pass, &pass->globals, OP_TYPE_INT, pass->uint_type, 32, 0);
    }
    pass->counter = pass->next_id++;
    pass->one = pass->next_id++;
    PUT(pass, &pass->globals, OP_CONSTANT, pass->uint_type, zero, 0);
    PUT(pass, &pass->globals, OP_CONSTANT, pass->float_type, pass->one, one);
    PUT(pass, &pass->globals, OP_TYPE_POINTER, pointer, STORAGE_PRIVATE, pass->uint_type);
    PUT(pass, &pass->globals, OP_VARIABLE, pointer, pass->counter, STORAGE_PRIVATE, zero);
}

static void read_module(struct pass *pass)
{
    bool is_declared = false;
    put_words(pass, &pass->globals, pass->words, HEADER_WORDS);
    for (size_t i = HEADER_WORDS; i < pass->num_words && pass->words[i] >> 16;
         i += pass->words[i] >> 16) {
        const uint32_t *words = pass->words + i;
        uint32_t op = *words & 0xffff;
        note(pass, op, words);
        if (op == OP_FUNCTION) {
            if (!pass->output)
                return;
            if (!is_declared)
                declare(pass);
            is_declared = true;
            pass->function = words[2];
        }
        if (is_declared)
            visit(pass, op, words);
        else
            put_words(pass, &pass->globals, words, *words >> 16);
    }
}

uint32_t *operations_instrument(const uint32_t *words, size_t num_words, enum count_of what,
                                size_t *out_num_words)
{
    struct pass pass = {.words = words, .num_words = num_words, .what = what};
    pass.bound = pass.next_id = words[BOUND_WORD];
    pass.known = calloc(pass.bound, sizeof *pass.known);
    if (!pass.known)
        return NULL;
    read_module(&pass);
    put_words(&pass, &pass.globals, pass.functions.words, pass.functions.num);
    bool good = pass.output && !pass.failed;
    if (good)
        pass.globals.words[BOUND_WORD] = pass.next_id;
    else
        free(pass.globals.words);
    free(pass.functions.words);
    free(pass.known);
    *out_num_words = good ? pass.globals.num : 0;
    return good ? pass.globals.words : NULL;
}
