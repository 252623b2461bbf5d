// Source of an operator of closures, which is not portable.
void scaled(ClosureData data, BSDF lobe, float factor, inout BSDF bsdf) { bsdf.response = lobe.response * factor; }
