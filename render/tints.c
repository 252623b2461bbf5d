// SPDX-License-Identifier: Apache-2.0
#include "render/tints.h"

#include "render/bind_shader.h"

#include <stdio.h>
#include <string.h>

bool tints_is_number(const mxg_variable *variable)
{
    return variable->block == MXG_BLOCK_PUBLIC_UNIFORMS
           && strcmp(variable->document_type, "filename") == 0;
}

/* The number of a table; the count of tables: it is not there. */
static uint32_t find(const struct tints *tints, const char *file)
{
    uint32_t i = 0;
    while (i < tints->count && strcmp(tints->names[i], file) != 0)
        ++i;
    return i;
}

static bool add(struct tints *tints, struct bind *bind, uint32_t index,
                const mxg_variable *variable)
{
    const char *users = bind_user_value(bind, variable), *file = users ? users : variable->file;
    bool is_checker = false;
    if (find(tints, file) < tints->count)
        return true;
    if (tints->count == TINTS_MAX)
        return bind_fail(bind, "the materials of a picture have more than 64 tables of tints");
    if (!bind_read_texture(bind, index, variable, users, &tints->parts[tints->count], &is_checker))
        return false;
    tints->names[tints->count++] = file;
    return true;
}

static bool add_all(struct tints *tints, struct bind *bind)
{
    bool good = true;
    for (uint32_t i = 0; good && i < mxg_result_num_variables(bind->result); ++i) {
        mxg_variable variable = {sizeof variable};
        mxg_result_variable(bind->result, i, &variable);
        if (tints_is_number(&variable))
            good = add(tints, bind, i, &variable);
    }
    return good;
}

bool tints_open(struct tints *tints, struct bind *const *binds, size_t count)
{
    static uint8_t white[4] = {255, 255, 255, 255};
    static const struct image none = {.width = 1, .height = 1, .pixels = white};
    bool good = true;
    for (size_t i = 0; good && i < count; ++i) {
        binds[i]->tints = tints;
        good = add_all(tints, binds[i]);
    }
    if (good
        && !image_tables(tints->count ? tints->parts : &none, tints->count ? tints->count : 1,
                         &tints->image))
        good = count ? bind_fail(binds[0], "out of memory") : false;
    return good;
}

uint32_t tints_find(const struct tints *tints, const char *file)
{
    uint32_t found = find(tints, file);
    return found < tints->count ? found : 0;
}

void tints_close(struct tints *tints)
{
    for (uint32_t i = 0; i < TINTS_MAX; ++i)
        image_finish(&tints->parts[i]);
    image_finish(&tints->image);
}
