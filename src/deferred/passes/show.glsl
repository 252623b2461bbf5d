// Draws what is stored.

// From blue over green to red.
vec3 mx_heat(float value)
{
    float x = clamp(value, 0.0, 1.0);
    return clamp(vec3(2.0 * x - 1.0, 1.0 - abs(2.0 * x - 1.0), 1.0 - 2.0 * x), 0.0, 1.0);
}

// Draws the value of a pixel that the host chose.
void mx_run(uvec2 group, uvec2 place)
{
    ivec2 pixel = mx_pixel_in(group, place);
    if (mx_is_outside(pixel))
        return;
    MxReader reader = mx_open(pixel);
    vec3 shown = vec3(0.0), covered = vec3(0.0), through = vec3(0.0), albedo = vec3(0.0);
    while (reader.next < reader.num_closures) {
        MxClosure c = mx_next(reader);
        vec3 weight = c.steady + c.color; // of light along the normal, before media
        covered += c.steady;
        through += c.color * c.decay;
        albedo += weight * c.diffuse_albedo;
    }
    float words = reader.class_ == MX_EMPTY ? 0.0 : float(3u + reader.at);
    if (mx_show == MX_SHOW_CLASSES)
        shown = vec3[MX_NUM_CLASSES](vec3(0.0), vec3(0.0, 0.6, 0.0), vec3(0.8, 0.6, 0.0), vec3(0.8, 0.0, 0.0),
                                     vec3(0.6, 0.0, 0.8))[reader.class_];
    else if (mx_show == MX_SHOW_BYTES)
        shown = vec3(4.0 * words / 255.0);
    else if (mx_show == MX_SHOW_CLOSURES)
        shown = vec3(float(reader.num_closures) / 255.0);
    else if (mx_show == MX_SHOW_COVERAGE)
        shown = covered;
    else if (mx_show == MX_SHOW_TRANSMITTANCE)
        shown = through;
    else
        shown = albedo;
    imageStore(mx_lit, pixel, vec4(shown, reader.class_ == MX_EMPTY ? 0.0 : 1.0));
}
