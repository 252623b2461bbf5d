vec2 mx_transform_uv(vec2 uv, vec2 scale, vec2 offset)
{
    return uv * scale + offset;
}
