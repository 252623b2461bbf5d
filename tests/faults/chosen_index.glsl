float pick(vec3 v, int i)
{
    float sum = 0.0;
    mat3 m = mat3(1.0);
    for (int k = 0; k < 9; k++) {
        m[i] = v;
        sum += v[i] * float(k) + sin(m[i].x);
    }
    return sum;
}
