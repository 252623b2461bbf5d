// SPDX-License-Identifier: Apache-2.0
/*
 * Hashes for tables inside one process and one library image. They differ between versions and byte
 * orders.
 */
#ifndef MXG_BASE_HASH_H
#define MXG_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

static inline uint64_t hash_mix(uint64_t h, uint64_t word)
{
    h = (h ^ word) * 0x9e3779b97f4a7c15u;
    return h ^ (h >> 29);
}

/* All 64 bits: where equal numbers stand for equal bytes, and nothing compares the bytes. */
static inline uint64_t hash_long(uint64_t h, const void *data, size_t size)
{
    const unsigned char *p = data, *end = p + size;
    uint64_t word;
    h = hash_mix(h, size);
    for (; end - p >= 8; p += 8) {
        memcpy(&word, p, sizeof word);
        h = hash_mix(h, word);
    }
    for (word = 0; p < end; p++)
        word = word << 8 | *p;
    return hash_mix(h, word);
}

static inline uint32_t hash_bytes(const void *data, size_t size)
{
    uint64_t h = hash_long(0xcbf29ce484222325u, data, size);
    return (uint32_t)(h ^ (h >> 32));
}

static inline uint32_t hash_pair(uint32_t a, uint32_t b)
{
    uint64_t h = hash_mix(0x51ed270b0a1f39c1u, (uint64_t)a << 32 | b);
    return (uint32_t)(h ^ (h >> 32));
}

/*
 * 64-bit FNV-1a: the same on every machine, for hashes that leave the process (topology hash, image
 * checksum).
 */
static inline uint64_t hash_stable(uint64_t h, const void *data, size_t size)
{
    const unsigned char *p = data;
    for (size_t i = 0; i < size; i++)
        h = (h ^ p[i]) * 0x100000001b3u;
    return h;
}
#define HASH_STABLE_SEED 0xcbf29ce484222325u

#endif
