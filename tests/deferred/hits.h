// SPDX-License-Identifier: Apache-2.0
/* Compute shaders that call the function of a payload where rays hit the ball of the tests. */
#ifndef MXG_TESTS_DEFERRED_HITS_H
#define MXG_TESTS_DEFERRED_HITS_H

#include "deferred/drawing.h"

enum { HITS_ROOM = 1 << 17 }; /* bytes of a text */

/* The use of the function's result. */
enum hits {
    HITS_STORED,  /* it stands in the buffer `payloads`, with its ray */
    HITS_BLENDED, /* it is a decal, blended into the images of decals */
};
/* Writes the text; false after a failed requirement. */
bool hits_write(const struct bench *b, const mxg_result *result, enum hits hits, char *out,
                size_t room);
/* Pixels that face the viewer: edges differ, because a mesh has corners. */
bool hits_faces(size_t pixel);

#endif
