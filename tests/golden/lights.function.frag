// M · surfacematerial · mxgen 0.1 · glsl · reduced · 1 closure · 0 textures

uniform vec3 wall_u_viewPosition = vec3(0.0);
#ifndef MXG_LIGHTS
#define MXG_LIGHTS
int mxg_light_count();
void mxg_light(int i, vec3 P, out vec3 L, out vec3 radiance);
#endif
struct wall_Surface {
    vec3 color;
    float alpha;
};

wall_Surface wall_surface(vec3 positionWorld, vec3 normalWorld)
{
    wall_Surface result;
    vec3 color = vec3(0.0);
    // lights
    vec3 N = normalize(normalWorld);
    vec3 facing = faceforward(N, -normalize(wall_u_viewPosition - positionWorld), N);
    // from the last light, so that drivers do not unroll the loop
    for (int i = mxg_light_count() - 1; i >= 0; --i) {
        // bsdf
        vec3 light_L, light_radiance;
        mxg_light(i, positionWorld, light_L, light_radiance);
        color += light_radiance * (max(dot(light_L, facing), 1e-8) * 0.31830987 * 0.8);
    }
    result.color = color;
    result.alpha = 1.0;
    return result;
}
