// wet_metal · slab_surface · mxgen 0.1 · vulkan · reduced · 1 closure · 0 textures

struct Surface {
    vec4 decal_albedo;
    vec4 decal_f0;
    vec4 decal_normal;
    vec4 decal_roughness;
};

Surface surface()
{
    Surface result;
    result.decal_albedo = vec4(0.6579555, 0.3332806, 0.17180733, 1.0);
    result.decal_f0 = vec4(0.5916348, 0.4240101, 0.24454294, 1.0);
    result.decal_normal = vec4(0.0);
    result.decal_roughness = vec4(0.5423652, 0.0, 0.0, 1.0);
    return result;
}
