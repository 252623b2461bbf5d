// SPDX-License-Identifier: Apache-2.0
// Structs that are assigned from their own parts.

struct twin
{
    pair first;
    float weights[2];
    pair second;
};

vec3 swapped(float x)
{
    pair p = pair(x, 2.0 * x);
    p = pair(p.b, p.a);
    float weights[2] = float[](1.0, x);
    twin t = twin(p, weights, pair(x, 3.0));
    t = twin(t.second, t.weights, t.first);
    return vec3(p.a - p.b, t.first.b * t.weights[1], t.second.a);
}
