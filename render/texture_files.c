// SPDX-License-Identifier: Apache-2.0
/*
 * The files of a document's texture as one image: the current frame, its file layer, its tiles; the
 * default colour if there is no file.
 */
#include "program/cli.h"
#include "program/memory.h"
#include "render/bind_shader.h"
#include "render/default_tokens.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Makes an image of the node's default colour, otherwise black. */
static void make_default(const mxg_variable *variable, struct image *out)
{
    float *texel = memory_alloc(4 * sizeof *texel);
    *out = (struct image){.width = 1, .height = 1, .is_float = true, .pixels = texel};
    texel[3] = 1.0f;
    for (uint32_t i = 0; i < variable->num_values && i < 4; ++i)
        texel[i] = variable->values[i];
}

/* Magenta and black, so that it does not look like a material. */
static void make_checker(struct image *out)
{
    enum { SIZE = 8 };
    uint8_t *texel = memory_alloc(SIZE * SIZE * 4);
    *out = (struct image){.width = SIZE, .height = SIZE, .pixels = texel};
    for (int i = 0; i < SIZE * SIZE; ++i, texel += 4) {
        texel[0] = texel[2] = (i % SIZE + i / SIZE) % 2 ? 0 : 255;
        texel[3] = 255;
    }
}

/* A texture of the shader: its variable, and the file that the user names in its place. */
struct texture {
    const mxg_variable *variable;
    const char *users; /* NULL: the document's file */
};

static void add_fault(struct bind *bind, const struct texture *texture, const char *path,
                      const char *why)
{
    struct bind_fault fault = {texture->users ? NULL : texture->variable->file, ""};
    if (texture->users)
        snprintf(fault.reason, sizeof fault.reason, "cannot read '%.200s' for '%.100s': %.180s",
                 path, texture->variable->path, why);
    else
        snprintf(fault.reason, sizeof fault.reason, "cannot read the texture '%.250s': %.200s",
                 path, why);
    MEMORY_PUSH(bind->faults, bind->num_faults, fault);
}

/* The texture is usable; the caller prints the reason as a warning. */
static void warn_bad_pixels(struct bind *bind, const char *path, const struct image *image)
{
    bind->id = "bad-pixels";
    snprintf(bind->reason, sizeof bind->reason,
             "the texture '%.250s' has pixels that are NaN or infinite (%llu); they are 0 here",
             path, (unsigned long long)image->num_bad);
}

static bool read_path(struct bind *bind, const struct texture *texture, const char *path,
                      struct image *out, bool *out_checker)
{
    char reason[256];
    if (bind->files && outputs_has(bind->files, path)) {
        return bind_fail_as(bind, "output-clash",
                            "the picture would overwrite the texture '%.250s'; choose another name",
                            path);
    }
    const char *fault =
        bind->tokens ? mxg_context_file_fault(bind->tokens->context, bind->document, path) : NULL;
    if (fault)
        snprintf(reason, sizeof reason, "%s", fault);
    else if (image_read(path, texture->variable->layer, out, reason, sizeof reason)) {
        if (out->num_bad)
            warn_bad_pixels(bind, path, out);
        return true;
    }
    *out_checker = true;
    add_fault(bind, texture, path, reason);
    make_checker(out);
    return true;
}

static bool read_file(struct bind *bind, const struct texture *texture, const char *file,
                      struct image *out, bool *out_checker)
{
    char *name = bind->tokens ? tokens_replace(bind->tokens, file) : NULL,
         *path = cli_beside(texture->users ? bind->document : texture->variable->origin,
                            name ? name : file);
    free(name);
    bool good = read_path(bind, texture, path, out, out_checker);
    free(path);
    return good;
}

static bool read_tile(struct bind *bind, uint32_t index, const struct texture *texture,
                      uint32_t tile, struct image *out, bool *out_checker)
{
    char file[4096];
    if (mxg_result_texture_file(bind->result, index, tile, bind->scene->frame, file, sizeof file))
        return read_file(bind, texture, file, out, out_checker);
    make_default(texture->variable, out);
    return true;
}

bool bind_read_texture(struct bind *bind, uint32_t index, const mxg_variable *variable,
                       const char *file, struct image *out, bool *out_checker)
{
    const struct texture texture = {variable, file};
    if (file && *file)
        return read_file(bind, &texture, file, out, out_checker);
    if (file) {
        make_default(variable, out);
        return true;
    }
    if (!variable->num_tiles)
        return read_tile(bind, index, &texture, 0, out, out_checker);
    struct image *tiles = memory_alloc(variable->num_tiles * sizeof *tiles);
    bool good = true;
    for (uint32_t i = 0; good && i < variable->num_tiles; ++i)
        good = read_tile(bind, index, &texture, i, &tiles[i], out_checker);
    if (good && !image_stack(tiles, variable->num_tiles, out))
        good = bind_fail(bind, "out of memory");
    for (uint32_t i = 0; i < variable->num_tiles; ++i)
        image_finish(&tiles[i]);
    free(tiles);
    return good;
}
