void cloth_bsdf_reflection(vec3 L, vec3 V, vec3 P, float occlusion, float weight, vec3 color, inout BSDF bsdf)
{
    bsdf.throughput = vec3(1.0 - weight);
    bsdf.response = color * weight * occlusion * abs(dot(L, V)) * (bsdf.thickness > 0.0 ? bsdf.ior : 1.0) + 0.0 * P;
}

void cloth_bsdf_transmission(vec3 V, float weight, vec3 color, inout BSDF bsdf)
{
    bsdf.throughput = vec3(1.0 - weight);
}

void cloth_bsdf_indirect(vec3 V, float weight, vec3 color, inout BSDF bsdf)
{
    bsdf.throughput = vec3(1.0 - weight);
    bsdf.response = color * weight * textureLod($envIrradiance, V.xy, 0.0).rgb;
}

void lamp_edf(vec3 N, vec3 V, vec3 color, out EDF result)
{
    result = color * abs(dot(N, V));
}
