// SPDX-License-Identifier: Apache-2.0
/*
 * Shaders that mxgen did not write: GLSL for Vulkan in NAME.vert and NAME.frag, and NAME.json, a
 * reflection as mxgen writes it (docs/reflection.md). bench/gpu/reflect.py makes one for any shader
 * whose names are those of MaterialX.
 */
#ifndef MXG_BENCH_FOREIGN_H
#define MXG_BENCH_FOREIGN_H

#include "program/json_values.h"
#include "render/bind_shader.h"

enum { FOREIGN_MAX_VARIABLES = 512 };

struct foreign {
    struct bind_program program; /* points to the members below */
    char *sources[MXG_NUM_STAGES];
    mxg_variable variables[FOREIGN_MAX_VARIABLES];
    json_t *reflection;
};

/* Reads the files of `stem`, a path up to the dot. NULL: there is none. Ends the program where one
 * cannot be read. foreign_close. */
struct foreign *foreign_open(const char *stem);
void foreign_close(struct foreign *foreign);

#endif
