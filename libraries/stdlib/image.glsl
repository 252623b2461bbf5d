// SPDX-License-Identifier: Apache-2.0
// Textures. Address modes and filters are the sampler's work: reflection tells them to the host. On demand they are
// arithmetic on coordinates, of which no more is left than the modes ask for: those are known at compile time.

// Who applies the modes: 0 the host's sampler; 1 it, but for cubic filters and borders of a colour, which are made below; 2 the
// functions below, over a sampler that repeats and filters linearly; 3 a texture() that does all but borders of a colour.
const int option_texture_modes = 0;

// Where v is 0 in the textures of the host: 0 at the bottom of the image, 1 at its top.
const int option_texture_origin = 0;

// Cubic B-spline filtering by four linear lookups: Christian Sigg and Markus Hadwiger, "Fast Third-Order Texture
// Filtering", GPU Gems 2, 2005, chapter 20. Each lookup stands for two texels of a row and two of a column, between
// which it lies by the ratio of their weights.
vec4 mx_sample_cubic(sampler2D file, vec2 uv)
{
    vec2 size = vec2(textureSize(file, 0));
    vec2 texel = uv * size - 0.5;
    vec2 f = fract(texel);
    vec2 g = 1.0 - f;
    vec2 w0 = g * g * g / 6.0;
    vec2 w1 = 2.0 / 3.0 - f * f * (1.0 - 0.5 * f);
    vec2 w2 = 2.0 / 3.0 - g * g * (1.0 - 0.5 * g);
    vec2 w3 = f * f * f / 6.0;

    vec2 low = (floor(texel) - 0.5 + w1 / (w0 + w1)) / size;
    vec2 high = (floor(texel) + 1.5 + w3 / (w2 + w3)) / size;
    vec2 t = w2 + w3;
    vec2 dx = dFdx(uv);
    vec2 dy = dFdy(uv);
    return mix(mix(textureGrad(file, low, dx, dy), textureGrad(file, vec2(high.x, low.y), dx, dy), t.x),
               mix(textureGrad(file, vec2(low.x, high.y), dx, dy), textureGrad(file, high, dx, dy), t.x), t.y);
}

vec4 mx_sample(sampler2D file, vec2 uv, string filtertype)
{
    if (option_texture_origin == 1)
        uv.y = 1.0 - uv.y;
    if ((option_texture_modes == 1 || option_texture_modes == 2) && filtertype == "cubic")
        return mx_sample_cubic(file, uv);
    if (option_texture_modes == 2 && filtertype == "closest") {
        vec2 size = vec2(textureSize(file, 0));
        return textureLod(file, (floor(uv * size) + 0.5) / size, 0.0);
    }
    return texture(file, uv);
}

// A coordinate in the image. Half a texel is kept from the border, lest the repeating sampler mixes in the other side
// (of which cubic filtering, which reaches a texel further, still sees a little).
float mx_address(float x, int size, string mode)
{
    if (mode == "periodic")
        return x;
    float mirrored = mode == "mirror" ? 1.0 - abs(mod(x, 2.0) - 1.0) : x;
    float border = 0.5 / float(size);
    return clamp(mirrored, border, 1.0 - border);
}

// Beyond a border that is of the default's colour, where the shader has to know it.
bool mx_beyond(vec2 uv, string uaddressmode, string vaddressmode)
{
    bool beyond_u = (uaddressmode == "constant" || uaddressmode == "black") && (uv.x < 0.0 || uv.x > 1.0);
    bool beyond_v = (vaddressmode == "constant" || vaddressmode == "black") && (uv.y < 0.0 || uv.y > 1.0);
    return option_texture_modes != 0 && (beyond_u || beyond_v);
}

vec4 mx_image(sampler2D file, vec2 texcoord, string uaddressmode, string vaddressmode, string filtertype)
{
    if (option_texture_modes != 2)
        return mx_sample(file, texcoord, filtertype);
    ivec2 size = textureSize(file, 0);
    vec2 uv = vec2(mx_address(texcoord.x, size.x, uaddressmode), mx_address(texcoord.y, size.y, vaddressmode));
    return mx_sample(file, uv, filtertype);
}

// Longitude 0, in the middle of the image, is +z; latitude runs from -y at the bottom to +y at the top.
vec2 mx_latlong(vec3 direction, float rotation)
{
    float longitude = 0.5 - atan(direction.x, direction.z) / 6.2831853 + rotation / 360.0;
    float latitude = 0.5 + asin(direction.y) / 3.1415927;
    return vec2(longitude, latitude);
}

vec4 mx_latlong_image(sampler2D file, vec3 direction, float rotation)
{
    vec2 uv = mx_latlong(direction, rotation);
    float v = option_texture_origin == 1 ? 1.0 - uv.y : uv.y;
    return texture(file, vec2(uv.x, mx_address(v, textureSize(file, 0).y, "clamp"))); // poles do not meet
}

// The textures along three axes, mixed by the direction of the normal.
vec4 mx_triplanar(sampler2D filex, sampler2D filey, sampler2D filez, vec3 position, vec3 normal, int upaxis,
                  float blend, string filtertype)
{
    vec2 along_x = upaxis == 2 ? position.yz : position.zy;
    vec2 along_y = upaxis == 0 ? position.zx : position.xz;
    vec2 along_z = upaxis == 0 ? vec2(-position.y, position.x) : position.xy;

    vec3 weight = abs(normalize(normal));
    weight /= dot(weight, vec3(1.0));
    weight = pow(weight, vec3(1.0 / clamp(blend, 0.03, 1.0))); // below 0.03 powers lose all precision
    weight /= dot(weight, vec3(1.0));
    return mx_sample(filex, along_x, filtertype) * weight.x +
           mx_sample(filey, along_y, filtertype) * weight.y +
           mx_sample(filez, along_z, filtertype) * weight.z;
}
