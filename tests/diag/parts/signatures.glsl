// Source that is not portable, because of `discard`, with functions that do not fit.
// expect-note@+1: not-portable 30
void few(out float result) { discard; }
void wide(vec3 a, out float result) { discard; }
void lobe(vec3 color, inout BSDF bsdf) { discard; }
void number_for_flag(int a, out float result) { discard; }
void flag_for_number(bool a, out float result) { discard; }
void fraction_for_number(float a, out float result) { discard; }
void color_of_texture(vec3 a, out float result) { discard; }
