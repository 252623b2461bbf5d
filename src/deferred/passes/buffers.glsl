// Buffers as words, for languages other than GLSL.

uint mx_or_in_group(uint bits, uint index); // passes/group.glsl has it in GLSL

// The tile number i of the list of the pass.
uint mx_tile_at(uint i)
{
    return mx_tiles_load(uint(MX_FIRST_TILE) + i);
}

// Adds a tile to the list of a class, whose number of tiles is the first word of its command.
void mx_add_tile(uint class_, uint tile)
{
    uint at = mx_tiles_add(4u * class_, 1u);
    mx_tiles_store(uint(MX_FIRST_TILE) + class_ * mx_num_tiles + at, tile);
}

// The payload number i of the buffer.
MxPayload mx_payload_at(uint i)
{
    MxPayload payload;
    for (int k = 0; k < MX_PAYLOAD_WORDS; ++k)
        payload.words[k] = mx_payloads_load(uint(MX_PAYLOAD_WORDS) * i + uint(k));
    return payload;
}

// A number of the buffer of rays.
float mx_rays_value(uint at)
{
    return uintBitsToFloat(mx_rays_load(at));
}

// The ray number i of the buffer.
MxRay mx_ray_at(uint i)
{
    MxRay ray;
    uint at = 8u * i;
    ray.point = vec4(mx_rays_value(at), mx_rays_value(at + 1u), mx_rays_value(at + 2u), 1.0);
    ray.view = vec4(mx_rays_value(at + 4u), mx_rays_value(at + 5u), mx_rays_value(at + 6u), 0.0);
    return ray;
}
