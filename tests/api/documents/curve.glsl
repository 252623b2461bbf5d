vec3 curve(vec3 x) { return x * x * (3.0 - 2.0 * x); }
