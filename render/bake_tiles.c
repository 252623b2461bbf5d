// SPDX-License-Identifier: Apache-2.0
#include "render/bake_tiles.h"

#include "program/memory.h"

#include <string.h>

void bake_tiles_add(struct bake_tiles *tiles, struct bake_tile tile)
{
    uint32_t at = 0;
    const struct bake_tile *items = tiles->items;
    while (at < tiles->num
           && (items[at].v < tile.v || (items[at].v == tile.v && items[at].u < tile.u)))
        ++at;
    if (at < tiles->num && items[at].u == tile.u && items[at].v == tile.v)
        return;
    tiles->items = memory_grow(tiles->items, tiles->num, sizeof *tiles->items);
    memmove(tiles->items + at + 1, tiles->items + at, (tiles->num - at) * sizeof *tiles->items);
    tiles->items[at] = tile;
    ++tiles->num;
}

bool bake_tiles_are_equal(const struct bake_tiles *a, const struct bake_tiles *b)
{
    return a->num == b->num && memcmp(a->items, b->items, a->num * sizeof *a->items) == 0;
}
