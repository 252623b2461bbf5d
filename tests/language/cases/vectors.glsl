// SPDX-License-Identifier: Apache-2.0
// Vectors of bools, ints and unsigned ints in the portable language.

vec4 numbers(bvec4 v)
{
    return vec4(v);
}

vec4 order(vec3 a, vec3 b)
{
    bvec3 less = lessThan(a, b), most = lessThanEqual(a, b);
    bvec3 more = greaterThan(a, b), least = greaterThanEqual(a, b);
    // a bit for each relation
    vec3 bits = vec3(less) + 2.0 * vec3(most) + 4.0 * vec3(more) + 8.0 * vec3(least);
    return vec4(bits, any(equal(a, b)) ? 1.0 : 0.0);
}

vec4 logic(vec4 a, vec4 b)
{
    bvec4 same = equal(a, b), other = notEqual(a, b);
    bvec4 none = not(same);
    if (none != other)
        return vec4(-1.0);
    bool every = all(greaterThan(b.xy, a.xy));
    none[int(a.w)] = every;
    return numbers(bvec4(none.wzy, any(same)));
}

vec3 chosen(vec3 a, vec3 b, float limit)
{
    vec3 either = mix(a, b, greaterThan(b, vec3(limit)));
    either.xy = mix(either.yx, vec2(7.0), isnan(either.xy));
    return either;
}

vec3 of_ints(vec3 a, int n)
{
    ivec3 i = ivec3(a) - n;
    i.zx += ivec2(n, 2 * n);
    ivec4 j = max(ivec4(i, -n), ivec4(-1));
    bvec3 small = lessThan(j.xyz, ivec3(n));
    return vec3(abs(i) * ivec3(j.w)) + vec3(small) * 0.5;
}

vec3 of_bits(vec3 a, int n)
{
    uvec3 u = floatBitsToUint(a);
    uvec3 high = (u >> 23) & 0xffu;
    uvec2 low = (u.xy << uvec2(n)) >> uvec2(29u);
    high.xy ^= low;
    high.z = max(high.z, uint(n)) % 100u;
    bvec3 odd = notEqual(high & uvec3(1u), uvec3(0u));
    return vec3(high) + mix(vec3(0.0), vec3(0.25), odd) + uintBitsToFloat(u) - intBitsToFloat(ivec3(u));
}

vec3 hashed(vec3 a, int n)
{
    uvec3 u = uvec3(ivec3(a)) * 747796405u + uint(n);
    u ^= u.yzx >> 16u;
    u = ~u / uvec3(3u, 5u, 7u);
    return vec3(u % 1000u) + vec3(lessThan(u, u.yzx));
}
