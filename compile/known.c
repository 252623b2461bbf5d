// SPDX-License-Identifier: Apache-2.0
#include "compile/known.h"

#include <string.h>

enum { MAX_KNOWN = 4096 }; /* the newest stay */

static struct known {
    uint64_t key;
    uint32_t body_instructions[MXG_NUM_STAGES];
} known[MAX_KNOWN];
static size_t num_known;

/* FNV-1a, 64 bits: http://www.isthe.com/chongo/tech/comp/fnv/ */
static const uint64_t offset_basis = 0xcbf29ce484222325u, prime = 0x100000001b3u;

static uint64_t add_bytes(uint64_t key, const char *bytes, size_t len)
{
    for (size_t i = 0; i < len; i++)
        key = (key ^ (unsigned char)bytes[i]) * prime;
    return (key ^ len) * prime; /* where a text ends */
}

/* Lines of comments alone are no code. */
static uint64_t add_code(uint64_t key, const char *source)
{
    for (const char *line = source; line && *line;) {
        size_t len = strcspn(line, "\n"), indent = strspn(line, " ");
        if (strncmp(line + indent, "//", 2) != 0)
            key = add_bytes(key, line, len);
        line += len + (line[len] == '\n');
    }
    return key * prime;
}

uint64_t known_key(const char *target, const mxg_result *result)
{
    mxg_shader_info info = MXG_INIT(mxg_shader_info);
    mxg_result_info(result, &info);
    uint64_t key = add_bytes(offset_basis, target, strlen(target));
    key = add_bytes(key, info.function, strlen(info.function));
    for (int stage = 0; stage < MXG_NUM_STAGES; stage++)
        key = add_code(key, mxg_result_source(result, (mxg_stage)stage, NULL));
    for (uint32_t i = 0; i < mxg_result_num_parts(result); i++) {
        mxg_part part = MXG_INIT(mxg_part);
        mxg_result_part(result, i, &part);
        key = add_code(key, part.source);
    }
    return key;
}

bool known_find(uint64_t key, struct compiled *out)
{
    size_t count = num_known < MAX_KNOWN ? num_known : MAX_KNOWN;
    for (size_t i = 0; i < count; i++) {
        if (known[i].key != key)
            continue;
        for (int stage = 0; stage < MXG_NUM_STAGES; stage++)
            out->stages[stage].body_instructions = known[i].body_instructions[stage];
        return true;
    }
    return false;
}

void known_add(uint64_t key, const struct compiled *compiled)
{
    struct known *item = &known[num_known++ % MAX_KNOWN];
    item->key = key;
    for (int stage = 0; stage < MXG_NUM_STAGES; stage++)
        item->body_instructions[stage] = compiled->stages[stage].body_instructions;
}
