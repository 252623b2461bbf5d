// SPDX-License-Identifier: Apache-2.0
/* Memos: a table of graphs with their arguments. */
#include "build/build_priv.h"

#include "base/hash.h"

static uint32_t hash_args(uint32_t impl, const ir_ref *args, uint32_t n)
{
    uint64_t h = hash_mix(0, impl);
    for (uint32_t i = 0; i < n; i++)
        h = hash_mix(h, args[i]);
    return (uint32_t)(h ^ (h >> 32));
}

static void grow_memos(struct builder *b)
{
    uint32_t slots = b->memo_table ? (b->memo_mask + 1) * 2 : 32;
    b->memo_table = ARENA_ARRAY(b->arena, uint32_t, slots);
    b->memo_mask = slots - 1;
    assert(b->memos.len * 2 <= b->memo_mask);
    for (uint32_t i = 0; i < b->memos.len; i++) {
        uint32_t slot = b->memos.items[i].hash & b->memo_mask;
        while (b->memo_table[slot])
            slot = (slot + 1) & b->memo_mask;
        b->memo_table[slot] = i + 1;
    }
}

struct memo *build_memo(struct builder *b, uint32_t impl, const ir_ref *args, uint32_t n)
{
    if (!b->memo_table || b->memos.len * 2 > b->memo_mask)
        grow_memos(b);
    uint32_t hash = hash_args(impl, args, n);
    assert(b->memos.len <= b->memo_mask);
    uint32_t slot = hash & b->memo_mask;
    for (; b->memo_table[slot]; slot = (slot + 1) & b->memo_mask) {
        struct memo *m = &b->memos.items[b->memo_table[slot] - 1];
        if (m->hash == hash && m->impl == impl
            && (n == 0 || memcmp(m->args, args, n * sizeof *args) == 0))
            return m;
    }
    vec_push(b->arena, &b->memos,
             (struct memo){.hash = hash, .impl = impl, .args = args, .num_args = n});
    b->memo_table[slot] = b->memos.len;
    return &vec_last(&b->memos);
}
