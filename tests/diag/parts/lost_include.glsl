// A file that does not exist.
// expect-error@+1: missing-source-file 10
#include "parts/nowhere.glsl"
void lost(out float result) { discard; }
