// SPDX-License-Identifier: Apache-2.0
// Grids of tiles. The compiler calls these functions (src/build/tiles.c).

// Number of the cell at a column and a row, row by row.
float mx_tile_cell(vec2 tile, float columns)
{
    return tile.x + tile.y * columns;
}

// True for a column and a row of a grid, whose last ones are known.
bool mx_tile_is_inside(vec2 tile, vec2 last)
{
    bool in_columns = mx_known(last.x == 0.0) ? tile.x == 0.0 : tile.x >= 0.0 && tile.x <= last.x;
    bool in_rows = mx_known(last.y == 0.0) ? tile.y == 0.0 : tile.y >= 0.0 && tile.y <= last.y;
    return in_columns && in_rows;
}
