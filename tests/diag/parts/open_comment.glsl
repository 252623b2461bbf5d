void open_comment(out float result) { result = unpackHalf2x16(0u).x; }
// expect-error@+1: lang-syntax 1
/* and so on
