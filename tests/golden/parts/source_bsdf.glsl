#include "lib/lobes.glsl"
#include "lib/common.glsl"

// A soft lobe over its base: it answers for the light, for the surroundings and for light from behind.
void soft_bsdf(ClosureData closureData, float weight, vec3 color, vec3 normal, int shape_of, inout BSDF bsdf)
{
    vec3 N = facing(normal, closureData.V);
    float rim = shape(1.0 - clamp(dot(N, closureData.V), 0.0, 1.0));
    bsdf.throughput = vec3(1.0 - weight * rim);
    if (closureData.closureType == CLOSURE_TYPE_REFLECTION) {
        float cosine = clamp(dot(N, closureData.L), 0.0, 1.0);
        bsdf.response = color * weight * (shape_of == 1 ? rim : cosine) * closureData.occlusion;
    } else if (closureData.closureType == CLOSURE_TYPE_INDIRECT) {
        bsdf.response = color * weight * rim * textureLod($envIrradianceSampler2D, N.xy, 0.0).rgb * $envLightIntensity;
    } else if (closureData.closureType == CLOSURE_TYPE_TRANSMISSION) {
        bsdf.response = color * weight * 0.1;
    }
}
