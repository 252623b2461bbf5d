#include "common.glsl"

vec3 facing(vec3 N, vec3 V)
{
    return dot(N, V) < 0.0 ? -N : N;
}
