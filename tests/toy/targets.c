// SPDX-License-Identifier: Apache-2.0
/* The list of targets with the toy: the linker takes it in place of the library's own. */
#include "generators/glsl/glsl.h"

extern const struct target target_toy;

const struct target *const targets[] = {&target_glsl, &target_toy, NULL};
