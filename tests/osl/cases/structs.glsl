// SPDX-License-Identifier: Apache-2.0
// Structs in structs, made from variables.
struct Inner {
    vec2 p;
    float s;
};
struct Outer {
    Inner i;
    vec2 made;
    vec3 c;
};
struct Pair {
    Inner first;
    Inner second;
};

Outer outer_of(Inner i, vec2 q)
{
    return Outer(i, q, vec3(q.x, i.s, 1.0));
}

vec3 nested(float x, int n)
{
    Outer o = Outer(Inner(vec2(x), 0.0), vec2(x), vec3(0.0));
    for (int k = 0; k < n; ++k)
        o = outer_of(Inner(o.made + vec2(1.0, 2.0), x + float(k)), vec2(o.i.p.y, 3.0));
    vec2 pairs[2] = vec2[2](o.made, o.i.p);
    return vec3(o.i.p.x, pairs[n - 2].y, o.made.x) + o.c;
}

float sum(Pair pair, int n)
{
    float total = 0.0;
    for (int k = 0; k < n; ++k)
        total += pair.first.p.x + pair.second.p.y * pair.second.s;
    return total;
}

float twice(float x, int n)
{
    Inner one = Inner(vec2(x * float(n), 3.0), 2.0);
    return sum(Pair(one, one), n);
}
