// Keeps a slab unless nothing of it is seen. Returns how many closures there are.
int mx_store(int before, MxClosure c)
{
    vec3 light = c.steady + c.color;
    if (max(light.x, max(light.y, light.z)) <= 0.0)
        return before;
    mx_keep(c);
    return before + 1;
}
