#include "curve.glsl"
void tint(vec3 color, float by, out vec3 result) { result = curve(color * by); }
