// expect-error@+1: unknown-source-token 39
void seen(out vec3 result) { result = $viewpoint; }
