// SPDX-License-Identifier: Apache-2.0
vec3 tint(vec3 color)
{
    return color * vec3(1.0, 0.9, 0.8);
}
