// The value that decals put at this pixel, and in w the part of the base that they leave.
vec4 mx_decal(int image)
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    if (image == 0)
        return texelFetch(mx_decal_albedo, pixel, 0);
    if (image == 1)
        return texelFetch(mx_decal_f0, pixel, 0);
    if (image == 2)
        return texelFetch(mx_decal_normal, pixel, 0);
    return texelFetch(mx_decal_roughness, pixel, 0);
}
