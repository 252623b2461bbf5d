// SPDX-License-Identifier: Apache-2.0
#include "none.glsl" // expect-error: missing-source-file 10
vec3 tint(vec3 color) { return color; }
