// SPDX-License-Identifier: Apache-2.0
/* SHA-256 (FIPS 180-4): names for contents that nobody can make two of. */
#ifndef MXG_CLI_SHA256_H
#define MXG_CLI_SHA256_H

#include <stddef.h>
#include <stdint.h>

enum { SHA256_HEX = 64 };

struct sha256 {
    uint32_t state[8];
    uint64_t size; /* bytes added */
    unsigned char block[64];
};

void sha256_init(struct sha256 *sha);
void sha256_add(struct sha256 *sha, const void *data, size_t size);
/* A text with its length before it, so that two texts are not taken for one. */
void sha256_add_text(struct sha256 *sha, const char *text);
/* Writes the hash in hexadecimal with a NUL; the state is used up. */
void sha256_hex(struct sha256 *sha, char out[SHA256_HEX + 1]);

#endif
