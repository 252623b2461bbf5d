// SPDX-License-Identifier: Apache-2.0
// The rest of path.glsl for media inside each other.
//
// A path and each of its rays to lights has the medium that it is in, and behind that, in `media`, those around it, from the outermost.
// Matter that overlaps is not mixed: light is in what it came into last, and inside that the surfaces of what is around are not there.

const uint OF_PATH = 0u; // whose media: of the path, or of the shadow with this number, from 1

Medium no_medium()
{
    return Medium(vec3(0.0), 0u, vec3(0.0), 0.0, vec3(0.0), 0u, vec2(-1.0, 0.0), ~0u, 0u);
}

// A number of the object and of its side that a direction meets; that of the other side differs in the last bit.
uint side_of(Hit hit, vec3 direction)
{
    Corner a = corners[hit.triangle * 3u];
    vec3 u = corners[hit.triangle * 3u + 1u].position_s.xyz - a.position_s.xyz,
         v = corners[hit.triangle * 3u + 2u].position_s.xyz - a.position_s.xyz;
    return (a.object + 1u) * 4u + IS_BODY + (dot(cross(u, v), direction) < 0.0 ? 0u : 1u);
}

bool is_same_object(uint body, uint other)
{
    return body / 4u == other / 4u;
}

float majorant_of(uint body)
{
    return body == 0u ? 0.0 : objects[body / 4u - 1u].majorant;
}

uint place_around(uint ray, uint i)
{
    return (i * NUM_RAYS + ray) * camera.frame.x * camera.frame.y + pixel_number();
}

// The innermost medium around the ray that is of this object; the count where none is.
uint find_around(uint ray, uint count, uint body)
{
    uint i = count;
    while (i > 0u && !is_same_object(media[place_around(ray, i - 1u)].body, body))
        --i;
    return i > 0u ? i - 1u : count;
}

void remove_around(uint ray, inout uint count, uint at)
{
    for (--count; at < count; ++at)
        media[place_around(ray, at)] = media[place_around(ray, at + 1u)];
}

// Where there is no room, the outermost medium is forgotten.
void add_around(uint ray, inout uint count, Medium medium)
{
    uint most = uint(camera.forward.w);
    if (medium.body == 0u)
        return;
    if (count == most)
        remove_around(ray, count, 0u);
    media[place_around(ray, count++)] = medium;
}

Medium take_around(uint ray, inout uint count)
{
    if (count == 0u)
        return no_medium();
    return media[place_around(ray, --count)];
}

void enter_medium(inout Path path, Medium medium)
{
    add_around(OF_PATH, path.around, path.medium);
    path.medium = medium;
}

bool is_in_body(Path path)
{
    return (path.medium.body & IS_BODY) != 0u;
}

// The solid that this side bounds.
bool is_in_solid(Path path, uint side)
{
    return is_same_object(side, path.medium.body) && !is_in_body(path);
}

// Out of this object, also where the path is in another one that overlaps. The sides of a solid may be objects of their own.
void leave_medium(inout Path path, uint body)
{
    uint at = find_around(OF_PATH, path.around, body);
    if (is_same_object(path.medium.body, body) || (at == path.around && !is_in_body(path)))
        path.medium = take_around(OF_PATH, path.around);
    else if (at < path.around)
        remove_around(OF_PATH, path.around, at);
}

// A shadow begins in what its path is in.
void copy_media(Path path, inout Shadow ray, uint number)
{
    ray.body = path.medium.body;
    ray.extinction = is_in_body(path) ? path.medium.extinction : vec3(0.0);
    ray.number = path.medium.level.y;
    ray.around = path.around;
    for (uint i = 0u; i < path.around; ++i)
        media[place_around(number, i)] = media[place_around(OF_PATH, i)];
}

void enter_medium(inout Shadow ray, uint number, uint body, vec3 extinction)
{
    Medium medium = no_medium();
    medium.body = ray.body;
    medium.extinction = ray.extinction;
    medium.level.y = ray.number;
    add_around(number, ray.around, medium);
    ray.body = body;
    ray.extinction = extinction;
    ray.number = at_level.y;
}

void leave_medium(inout Shadow ray, uint number)
{
    Medium medium = take_around(number, ray.around);
    ray.body = medium.body;
    ray.extinction = medium.extinction;
    ray.number = medium.level.y;
}
