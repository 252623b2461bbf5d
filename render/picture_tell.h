// SPDX-License-Identifier: Apache-2.0
/* Messages about the inputs of a shader while a picture is made. */
#ifndef MXG_RENDER_PICTURE_TELL_H
#define MXG_RENDER_PICTURE_TELL_H

#include "render/picture.h"

/* Prints the textures that cannot be read, each once, with its place if it has one. */
void picture_tell_textures(struct painter *painter, const struct bind *bind,
                           const struct subject *subject);
/* Warns about what a bound shader lacks: primvars, and textures in whose place checkers are. */
void picture_tell(struct painter *painter, const struct bind *bind, const struct subject *subject);

#endif
