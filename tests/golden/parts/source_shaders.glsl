void flat_shader(vec3 color, vec3 opacity, out surfaceshader result)
{
    result.color = color * opacity;
    result.transparency = vec3(1.0) - opacity;
}

void lift(float height, out displacementshader result)
{
    result.offset = vec3(0.0, height, 0.0);
    result.scale = 2.0;
}
