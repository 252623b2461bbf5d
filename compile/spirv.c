// SPDX-License-Identifier: Apache-2.0
#include "compile/spirv.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define HEADER_WORDS 5
/* SPIR-V 1.0, sections 3.32.2, 3.32.3, 3.32.5 and 3.32.9; decorations: 3.20 */
enum spirv_op {
    OP_SOURCE = 3,
    OP_NAME = 5,
    OP_LINE = 8,
    OP_ENTRY_POINT = 15,
    OP_FUNCTION = 54,
    OP_FUNCTION_END = 56,
    OP_DECORATE = 71,
    OP_NO_LINE = 317
};

struct counter {
    const uint32_t *words;
    size_t num_words;
    uint32_t entry_point, function; /* ids; 0: none */
    uint32_t line, total;
    struct spirv_part *parts;
    size_t num_parts;
    bool failed; /* no memory */
};

/* The name of an id, looked for among the names in front of all functions. */
static const char *find_name(const struct counter *counter, uint32_t id)
{
    for (size_t i = HEADER_WORDS; i < counter->num_words && counter->words[i] >> 16;
         i += counter->words[i] >> 16) {
        enum spirv_op op = (enum spirv_op)(counter->words[i] & 0xffff);
        if (op == OP_FUNCTION)
            break;
        if (op == OP_NAME && counter->words[i + 1] == id)
            return (const char *)&counter->words[i + 2];
    }
    return "";
}

static void add_part(struct counter *counter, uint32_t line)
{
    struct spirv_part *more =
        counter->failed ? NULL : realloc(counter->parts, (counter->num_parts + 1) * sizeof *more);
    if (!more) {
        counter->failed = true;
        return;
    }
    counter->parts = more;
    counter->parts[counter->num_parts++] =
        (struct spirv_part){find_name(counter, counter->function), line, 0};
}

static void count_instruction(struct counter *counter)
{
    uint32_t line = counter->function == counter->entry_point ? counter->line : 0;
    const struct spirv_part *last =
        counter->num_parts ? &counter->parts[counter->num_parts - 1] : NULL;
    if (line && (!last || last->line != line))
        add_part(counter, line);
    if (counter->num_parts && !counter->failed)
        ++counter->parts[counter->num_parts - 1].instructions;
    ++counter->total;
}

static void visit(struct counter *counter, const uint32_t *instruction)
{
    enum spirv_op op = (enum spirv_op)(*instruction & 0xffff);
    if (op == OP_LINE || op == OP_NO_LINE) {
        counter->line = op == OP_LINE ? instruction[2] : 0;
        return;
    }
    if (op == OP_FUNCTION_END)
        counter->function = 0;
    if (counter->function)
        count_instruction(counter);
    if (op == OP_ENTRY_POINT)
        counter->entry_point = instruction[2];
    if (op == OP_FUNCTION) {
        counter->function = instruction[2];
        counter->line = 0;
        add_part(counter, 0);
    }
}

uint32_t spirv_count(const uint32_t *words, size_t num_words, struct spirv_part **out_parts,
                     size_t *out_num_parts)
{
    struct counter counter = {.words = words, .num_words = num_words};
    for (size_t i = HEADER_WORDS; i < num_words && words[i] >> 16; i += words[i] >> 16)
        visit(&counter, words + i);
    if (counter.failed)
        counter.num_parts = 0;
    if (out_parts) {
        *out_parts = counter.parts;
        *out_num_parts = counter.num_parts;
    } else {
        free(counter.parts);
    }
    return counter.total;
}

void spirv_hide_language(uint32_t *words, size_t num_words)
{
    for (size_t i = HEADER_WORDS; i < num_words && words[i] >> 16; i += words[i] >> 16)
        if ((words[i] & 0xffff) == OP_SOURCE)
            words[i + 1] = 0;
}

void spirv_store_uniforms(uint32_t *words, size_t num_words)
{
    enum { BLOCK = 2, BUFFER_BLOCK = 3 };
    for (size_t i = HEADER_WORDS; i < num_words && words[i] >> 16; i += words[i] >> 16)
        if ((words[i] & 0xffff) == OP_DECORATE && words[i + 2] == BLOCK)
            words[i + 2] = BUFFER_BLOCK;
}
