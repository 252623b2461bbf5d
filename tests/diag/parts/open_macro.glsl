void open_macro(out float result) { result = unpackHalf2x16(0u).x; }
// expect-error@+2: lang-syntax 15
#define TWICE(x) \
    ((x) + (x)\
