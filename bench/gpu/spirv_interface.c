// SPDX-License-Identifier: Apache-2.0
/*
 * Reads a module's words once (SPIR-V specification, section 2.3): decorations, types and constants
 * precede the variables that use them. The modules are those of glslang, which are valid.
 */
#include "spirv_interface.h"

#include <stdlib.h>

enum opcode {
    OP_TYPE_INT = 21,
    OP_TYPE_FLOAT = 22,
    OP_TYPE_VECTOR = 23,
    OP_TYPE_IMAGE = 25,
    OP_TYPE_ARRAY = 28,
    OP_TYPE_POINTER = 32,
    OP_CONSTANT = 43,
    OP_VARIABLE = 59,
    OP_DECORATE = 71,
};
enum decoration { LOCATION = 30, BINDING = 33, DESCRIPTOR_SET = 34 };
enum storage { UNIFORM_CONSTANT = 0, INPUT = 1, UNIFORM = 2, OUTPUT = 3, STORAGE_BUFFER = 12 };
enum { HEADER = 5, MAGIC = 0x07230203 };
#define ABSENT UINT32_MAX

struct id {                          /* a result of the module */
    uint32_t of;                     /* a pointer's or array's type */
    uint32_t count;                  /* components, elements, or the value of a constant */
    bool is_array;                   /* else any other type */
    bool is_integer, is_stored;      /* a number or its vector; an image without a sampler */
    uint32_t set, binding, location; /* ABSENT without decoration */
};

static void decorate(struct id *id, uint32_t decoration, uint32_t value)
{
    if (decoration == LOCATION)
        id->location = value;
    else if (decoration == BINDING)
        id->binding = value;
    else if (decoration == DESCRIPTOR_SET)
        id->set = value;
}

static VkDescriptorType resource_type(uint32_t storage, bool is_stored)
{
    return is_stored                     ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE
           : storage == UNIFORM_CONSTANT ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
           : storage == STORAGE_BUFFER   ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER
                                         : VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
}

/* Both stages may have the same resource. */
static bool add_resource(const struct id *ids, const struct id *variable, uint32_t storage,
                         struct shader_interface *out)
{
    const struct id *type = &ids[ids[variable->of].of];
    for (uint32_t i = 0; i < out->num_resources; i++)
        if (out->resources[i].set == variable->set
            && out->resources[i].layout.binding == variable->binding)
            return true;
    if (out->num_resources == MAX_RESOURCES || variable->set >= MAX_SETS)
        return false;
    out->resources[out->num_resources++] =
        (struct resource){variable->set,
                          {.binding = variable->binding,
                           .descriptorType = resource_type(storage, type->is_stored),
                           .descriptorCount = type->is_array ? type->count : 1,
                           .stageFlags = VK_SHADER_STAGE_ALL}};
    return true;
}

static bool add_variable(const struct id *ids, const struct id *variable, uint32_t storage,
                         VkShaderStageFlagBits stage, struct shader_interface *out)
{
    if (variable->binding != ABSENT && variable->set != ABSENT)
        return add_resource(ids, variable, storage, out);
    if (variable->location == ABSENT)
        return true;
    if (stage == VK_SHADER_STAGE_VERTEX_BIT && storage == INPUT) {
        if (out->num_inputs == MAX_INPUTS)
            return false;
        out->inputs[out->num_inputs].location = variable->location;
        out->inputs[out->num_inputs++].components = ids[ids[variable->of].of].count;
    }
    bool is_output = stage == VK_SHADER_STAGE_FRAGMENT_BIT && storage == OUTPUT;
    if (!is_output)
        return true;
    if (variable->location >= MAX_OUTPUTS)
        return false;
    out->is_integer[variable->location] = ids[ids[variable->of].of].is_integer;
    if (variable->location >= out->num_outputs)
        out->num_outputs = variable->location + 1;
    return true;
}

static bool read_instruction(const uint32_t *word, struct id *ids, VkShaderStageFlagBits stage,
                             struct shader_interface *out)
{
    uint32_t length = word[0] >> 16;
    switch (word[0] & 0xffff) {
    case OP_TYPE_INT:
        ids[word[1]].is_integer = true;
        ids[word[1]].count = 1;
        break;
    case OP_TYPE_FLOAT: ids[word[1]].count = 1; break;
    case OP_TYPE_VECTOR:
        ids[word[1]].count = word[3];
        ids[word[1]].is_integer = ids[word[2]].is_integer;
        break;
    case OP_TYPE_IMAGE: ids[word[1]].is_stored = word[7] == 2; break;
    case OP_TYPE_ARRAY:
        ids[word[1]].of = word[2];
        ids[word[1]].count = ids[word[3]].count;
        ids[word[1]].is_array = true;
        break;
    case OP_TYPE_POINTER: ids[word[1]].of = word[3]; break;
    case OP_CONSTANT: ids[word[2]].count = word[3]; break;
    case OP_DECORATE:
        if (length > 3)
            decorate(&ids[word[1]], word[2], word[3]);
        break;
    case OP_VARIABLE:
        ids[word[2]].of = word[1];
        return add_variable(ids, &ids[word[2]], word[3], stage, out);
    default: break;
    }
    return true;
}

bool interface_of_module(const uint32_t *words, size_t num_words, VkShaderStageFlagBits stage,
                         struct shader_interface *out)
{
    if (num_words < HEADER || words[0] != MAGIC)
        return false;
    uint32_t bound = words[3];
    struct id *ids = calloc(bound, sizeof *ids);
    bool is_good = ids != NULL;
    for (uint32_t i = 0; is_good && i < bound; i++)
        ids[i].set = ids[i].binding = ids[i].location = ABSENT;
    for (size_t at = HEADER; is_good && at < num_words;) {
        size_t length = words[at] >> 16;
        is_good =
            length > 0 && length <= num_words - at && read_instruction(words + at, ids, stage, out);
        at += length;
    }
    free(ids);
    return is_good;
}
