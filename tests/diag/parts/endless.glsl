// expect-error@+1: lang-syntax 1
#ifdef FAST
void endless(out float result) { discard; }
