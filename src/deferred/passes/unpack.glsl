// Payloads of rays: a closure, its light and its opacity.

vec3 mx_view; // of the ray at hand

// The closure of a payload.
MxClosure mx_open_payload(MxPayload p)
{
    MxRecord r = MxRecord(p.words[0], p.words[1], uint[2](p.words[2], p.words[3]), p.words[4], p.words[5], p.words[6], p.words[7],
                          0u, uint[4](0u, 0u, 0u, 0u), p.words[8]);
    return mx_unpack(r, mx_uncut_normal(p.words[8], 16u), mx_uncut(r.body, 20u, 8u));
}

// Emission, and the opacity that the light has already.
vec4 mx_emission_of(MxPayload p)
{
    return vec4(unpackHalf2x16(p.words[9]), unpackHalf2x16(p.words[10]));
}
