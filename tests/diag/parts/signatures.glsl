// Source that is not portable, because of `discard`, with functions that do not fit.
// expect-note@+1: not-portable 30
void few(out float result) { discard; }
void wide(vec3 a, out float result) { discard; }
void lobe(vec3 color, inout BSDF bsdf) { discard; }
