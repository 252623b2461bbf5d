#include "round_next.glsl"
void round_trip(out float result) { discard; }
