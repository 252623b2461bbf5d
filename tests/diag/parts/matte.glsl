// SPDX-License-Identifier: Apache-2.0
vec3 matte_eval(vec3 N, vec3 L) { return vec3(0.3 * max(dot(N, L), 0.0)); }
