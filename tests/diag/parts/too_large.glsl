// SPDX-License-Identifier: Apache-2.0
struct empty { }; // expect-error: lang-limit
vec3 tint(vec3 color) { return color; }
