// SPDX-License-Identifier: Apache-2.0
float even(int n);
float odd(int n) { return n == 0 ? 0.0 : even(n - 1); }
// expect-error@+1: lang-recursion 7
float even(int n) { return n == 0 ? 1.0 : odd(n - 1); }
vec3 tint(vec3 color) { return color * even(3); }
