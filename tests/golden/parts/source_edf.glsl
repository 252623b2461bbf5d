// A factor of another emission.
void tinted_edf(ClosureData closureData, vec3 tint, EDF base, out EDF result)
{
    result = vec3(0.0);
    if (closureData.closureType == CLOSURE_TYPE_EMISSION)
        result = base * tint * abs(dot(closureData.N, closureData.V));
}
