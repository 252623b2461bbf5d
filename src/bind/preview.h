// SPDX-License-Identifier: Apache-2.0
/*
 * USD's own shaders (the specification "UsdPreviewSurface"): the nodes of MaterialX that they are,
 * and what MaterialX writes in another way.
 */
#ifndef MXG_BIND_PREVIEW_H
#define MXG_BIND_PREVIEW_H

#include "usda/usda.h"

struct preview_shader {
    const char *id, *nodedef;
};

/* An input that MaterialX has in another form. */
struct preview_input {
    const char *id, *input; /* of the shader */
    const char *name;       /* of the input in MaterialX; NULL: it has none */
    const char *otherwise;  /* the value where the stage has none; NULL: that of the definition */
    bool has_tokens;        /* preview_next_token lists them */
    const char *constant;   /* the definition of the node that a value becomes; NULL: it is one */
};

struct preview_token {
    const char *input, *token;
    const char *word; /* of MaterialX */
};

/* The shader of an id; NULL: it is none of USD. */
const struct preview_shader *preview_find(struct text_word id);
static inline bool preview_is_texture(const struct preview_shader *shader)
{
    return strcmp(shader->id, "UsdUVTexture") == 0;
}

/* The row of an input; NULL: it is the same in MaterialX. */
const struct preview_input *preview_find_input(const struct preview_shader *shader,
                                               struct text_word name);
/* The rows of a shader, and the tokens of an input, one by one: `at` is NULL at first; NULL: the
 * end. */
const struct preview_input *preview_next_input(const struct preview_shader *shader,
                                               const struct preview_input *at);
const struct preview_token *preview_next_token(const char *input, const struct preview_token *at);

#endif
