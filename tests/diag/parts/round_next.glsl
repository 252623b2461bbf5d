// expect-error@+2: include-cycle 10
// expect-note@+1: include-from 10
#include "round.glsl"
