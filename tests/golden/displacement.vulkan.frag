#version 450
// Moved · surfacematerial · mxgen 0.1 · vulkan · reduced · 1 closure · 1 texture

layout(set = 0, binding = 0, std140) uniform PrivateUniforms {
    mat4 u_worldMatrix;
    mat4 u_worldInverseTransposeMatrix;
    mat4 u_viewProjectionMatrix;
    vec3 u_viewPosition;
    mat4 u_envMatrix;
    float u_envLightIntensity;
};
layout(set = 0, binding = 3) uniform sampler2D height_file;
layout(set = 0, binding = 4) uniform sampler2D u_envIrradiance;
layout(location = 0) in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec3 tangentWorld;
    vec2 texcoord_0;
} vd;
layout(location = 0) out vec4 out1;

// 1 on a line of this radius between two points, 0 beside it.
// Here radius = 0.1, point1 = vec2(0.25), point2 = vec2(0.75).
float mx_line(const vec2 p)
{
    vec2 from = p - vec2(0.25);
    return distance(from, vec2(0.5) * clamp(dot(from, vec2(0.5)) / 0.5, 0.0, 1.0)) > 0.1 ? 0.0 : 1.0;
}

// The angle, over pi, with this sine and cosine; the cosine is not negative. It errs by 2.9e-5 at most.
float mx_half_turn(const float sine, const float cosine)
{
    return sine * (0.4999709 + cosine * (cosine * (0.2302802 + cosine * (0.0398298 * cosine - 0.1351235)) - 0.3164252));
}

// The square of the distance of the unit direction d from the vertical axis, never 0.
float mx_map_square(const vec3 d)
{
    return d.x * d.x + (d.z * d.z + 1e-16);
}

// The point of the latitude-longitude picture for the unit direction d, to a tenth of a texel in 4096.
vec2 mx_map_point(const vec3 d)
{
    float square = mx_map_square(d);
    float stretch = inversesqrt(square);
    return vec2(fract((d.z > 0.0 ? -0.5 : 0.5) * (mx_half_turn(d.x * stretch, abs(d.z) * stretch) + 0.5) + 0.25),
        0.5 - mx_half_turn(d.y, square * stretch));
}

void main()
{
    vec3 color = vec3(0.0);
    // environment: bsdf
    vec3 Ng = normalize(vd.normalWorld);
    float both = texture(height_file, vd.texcoord_0).x * mx_line(vd.texcoord_0);
    vec3 displacement = normalize(vd.tangentWorld) * 0.1 + Ng * both;
    vec3 P = mix(displacement, Ng * (both * 0.5), 0.25) + vd.positionWorld;
    vec3 facet = normalize(cross(dFdx(P), dFdy(P)));
    vec3 facet_normal = faceforward(facet, -Ng, facet);
    vec3 facet_2 = normalize(cross(dFdx(vd.positionWorld), dFdy(vd.positionWorld)));
    vec3 displaced_normal = normalize(Ng + (facet_normal - faceforward(facet_2, -Ng, facet_2)));
    color += textureLod(u_envIrradiance,
        mx_map_point(normalize(mat3(u_envMatrix)
        * faceforward(displaced_normal, -normalize(u_viewPosition - P), displaced_normal))), 0.0).xyz
        * (u_envLightIntensity * 0.18);
    out1 = vec4(color, 1.0);
}
