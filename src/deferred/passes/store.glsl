// The first function that a material calls, for each slab from the top down. Returns how many closures there are.

int mx_store_closure(int before, vec3 diffuse_albedo, vec3 f0, vec3 f90, float roughness, float anisotropy, vec3 normal, vec3 tangent,
                     float second_roughness, float second_roughness_weight, float fuzz_amount, vec3 fuzz_color, float fuzz_roughness,
                     vec3 free_path, float phase_anisotropy, float is_thick, float glint_density, vec2 glint_uv, float tint_index,
                     float tint_weight, float blur, vec3 steady, vec3 color, vec3 decay, float spreads)
{
    vec2 extent = mx_glint_extent(glint_uv); // before a branch: neighbours differ
    vec3 light = steady + color;
    if (max(light.x, max(light.y, light.z)) <= 0.0)
        return before;
    mx_keep(MxClosure(diffuse_albedo, f0, f90, roughness, anisotropy, normal, tangent, second_roughness, second_roughness_weight,
                      fuzz_amount, fuzz_color, fuzz_roughness, free_path, phase_anisotropy, is_thick, glint_density, glint_uv, extent,
                      tint_index, tint_weight, blur, steady, color, decay, spreads));
    return before + 1;
}
