#include "lib/lobes.glsl"

// Fog over a lobe: what it adds does not come from the lobe, so it must count once and not with each sample of the lobe.
void fogged_bsdf(ClosureData closureData, BSDF base, float fog, inout BSDF bsdf)
{
    bsdf.throughput = base.throughput;
    bsdf.response = base.response * (1.0 - fog) + vec3(fog * 0.1);
}
