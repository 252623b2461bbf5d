// SPDX-License-Identifier: Apache-2.0
#include "render/image.h"
#include "render/image_guard.h"
#include "render/image_stream.h"

#include "program/files.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

namespace
{

/* A device or a pipe may never end. */
bool check_file(const char *path, char *reason, size_t capacity)
{
    struct stat info;
    if (stat(path, &info) != 0)
        return fail(reason, capacity, std::strerror(errno));
    return S_ISREG(info.st_mode) || fail(reason, capacity, "it is not a regular file");
}

/* The header of a small file can promise any size, so these limits come before allocation. */
constexpr int max_side = 1 << 16;
constexpr size_t max_texels = size_t{1} << 28;

bool check_size(const OIIO::ImageSpec &spec, char *reason, size_t capacity)
{
    if (spec.width <= 0 || spec.height <= 0)
        return fail(reason, capacity, "the picture is empty");
    if (spec.width <= max_side && spec.height <= max_side
        && static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height) <= max_texels)
        return true;
    return fail(reason, capacity,
                "its header says " + std::to_string(spec.width) + " x "
                    + std::to_string(spec.height) + " pixels; the limit is "
                    + std::to_string(max_side) + " for a side and " + std::to_string(max_texels)
                    + " in total");
}

/* Replaces components that are NaN or infinite by 0; returns the number of their texels. */
size_t repair(float *texels, size_t count)
{
    size_t bad = 0;
    for (size_t i = 0; i < count; ++i, texels += 4) {
        bool is_finite = true;
        for (size_t c = 0; c < 4; ++c) {
            if (std::isfinite(texels[c]))
                continue;
            texels[c] = 0.0f;
            is_finite = false;
        }
        bad += !is_finite;
    }
    return bad;
}

/* Expands a pixel to four channels: grey, grey and alpha, colour, colour and alpha. */
template <typename T> void spread(T *pixels, size_t count, int channels, T one)
{
    for (size_t i = count; i-- > 0;) {
        const T *in = pixels + i * static_cast<size_t>(channels);
        bool grey = channels < 3;
        T r = in[0], g = grey ? in[0] : in[1], b = grey ? in[0] : in[2];
        T a = channels == 2 ? in[1] : channels >= 4 ? in[3] : one;
        T *out = pixels + i * 4;
        out[0] = r, out[1] = g, out[2] = b, out[3] = a;
    }
}

/* Channels [begin, end) of a subimage. */
struct Part {
    int subimage = 0, begin = 0, end = 0;
};

/*
 * Finds the part of this name, or the channels "name.R", "name.G"… of a part; "" selects the first
 * part.
 */
bool find_layer(OIIO::ImageInput &input, const std::string &layer, Part &out)
{
    for (int subimage = 0; input.seek_subimage(subimage, 0); ++subimage) {
        const OIIO::ImageSpec &spec = input.spec();
        out = {subimage, 0, spec.nchannels};
        if (layer.empty() || spec.get_string_attribute("oiio:subimagename") == layer
            || spec.get_string_attribute("name") == layer)
            return true;
        auto belongs = [&](int channel) {
            return spec.channelnames[static_cast<size_t>(channel)].rfind(layer + '.', 0) == 0;
        };
        while (out.begin < spec.nchannels && !belongs(out.begin))
            ++out.begin;
        for (out.end = out.begin; out.end < spec.nchannels && belongs(out.end);)
            ++out.end;
        if (out.end > out.begin)
            return true;
    }
    return false;
}

bool read_level(OIIO::ImageInput &input, int level, const Part &part, struct image &image,
                size_t first_texel)
{
    size_t count = size_t{image_level_size(image.width, static_cast<uint32_t>(level))}
                   * image_level_size(image.height, static_cast<uint32_t>(level));
    char *pixels =
        static_cast<char *>(image.pixels) + first_texel * 4 * (image.is_float ? sizeof(float) : 1);
    OIIO::TypeDesc type = image.is_float ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
    int channels = part.end - part.begin;
    if (!input.read_image(part.subimage, level, part.begin, part.end, type, pixels))
        return false;
    if (!image.is_float) {
        spread(reinterpret_cast<uint8_t *>(pixels), count, channels, uint8_t{255});
        return true;
    }
    spread(reinterpret_cast<float *>(pixels), count, channels, 1.0f);
    image.num_bad += repair(reinterpret_cast<float *>(pixels), count);
    return true;
}

/* Number of levels in the file, each half the size of the one before. */
uint32_t count_levels(OIIO::ImageInput &input, uint32_t width, uint32_t height)
{
    uint32_t levels = 1;
    while (input.seek_subimage(0, static_cast<int>(levels))
           && input.spec().width == static_cast<int>(image_level_size(width, levels))
           && input.spec().height == static_cast<int>(image_level_size(height, levels)))
        ++levels;
    return levels;
}

/* The sum of the texels of the first `levels` levels. */
size_t count_texels(const struct image &image, uint32_t levels)
{
    size_t texels = 0;
    for (uint32_t i = 0; i < levels; ++i)
        texels += size_t{image_level_size(image.width, i)} * image_level_size(image.height, i);
    return texels;
}

bool read_levels(const char *path, const char *layer, bool all, struct image *out, char *reason,
                 size_t capacity)
{
    if (!check_file(path, reason, capacity))
        return false;
    OIIO::ImageSpec wanted; /* as they are stored: a texture's alpha may be any number */
    wanted.attribute("oiio:UnassociatedAlpha", 1);
    auto input = OIIO::ImageInput::open(path, &wanted);
    if (!input)
        return fail(reason, capacity, OIIO::geterror());
    Part part;
    if (!find_layer(*input, layer, part))
        return fail(reason, capacity, std::string("it has no layer '") + layer + "'");
    const OIIO::ImageSpec spec = input->spec(part.subimage);
    part.end = part.end - part.begin < 4 ? part.end : part.begin + 4;
    if (!check_size(spec, reason, capacity))
        return false;
    if (part.end <= part.begin)
        return fail(reason, capacity, "the picture is empty");
    out->is_float = spec.format != OIIO::TypeDesc::UINT8;
    out->width = static_cast<uint32_t>(spec.width);
    out->height = static_cast<uint32_t>(spec.height);
    uint32_t levels = all ? count_levels(*input, out->width, out->height) : 1;
    out->pixels = std::malloc(count_texels(*out, levels) * 4 * (out->is_float ? sizeof(float) : 1));
    if (!out->pixels)
        return fail(reason, capacity, "out of memory");
    out->levels = levels > 1 ? levels : 0;
    for (uint32_t i = 0; i < levels; ++i)
        if (!read_level(*input, static_cast<int>(i), part, *out, count_texels(*out, i)))
            return fail(reason, capacity, input->geterror());
    return true;
}

bool read_guarded(const char *path, const char *layer, bool all, struct image *out, char *reason,
                  size_t capacity)
{
    *out = {};
    bool good = guard(reason, capacity,
                      [&] { return read_levels(path, layer, all, out, reason, capacity); });
    if (!good)
        image_finish(out);
    return good;
}

} // namespace

bool image_read(const char *path, const char *layer, struct image *out, char *reason,
                size_t capacity)
{
    return read_guarded(path, layer, false, out, reason, capacity);
}

bool image_read_levels(const char *path, struct image *out, char *reason, size_t capacity)
{
    return read_guarded(path, "", true, out, reason, capacity);
}

bool image_find_size(const char *path, uint32_t *out, char *reason, size_t capacity)
{
    return guard(reason, capacity, [&] {
        if (!check_file(path, reason, capacity))
            return false;
        auto input = OIIO::ImageInput::open(path);
        if (!input)
            return fail(reason, capacity, OIIO::geterror());
        const OIIO::ImageSpec &spec = input->spec();
        *out = static_cast<uint32_t>(std::max(spec.width, spec.height));
        return check_size(spec, reason, capacity);
    });
}

bool image_is_linear(const char *path)
{
    static const char *const endings[] = {".exr", ".hdr"};
    size_t len = std::strlen(path);
    for (const char *ending : endings)
        if (len >= 4 && strcasecmp(path + len - 4, ending) == 0)
            return true;
    return false;
}

namespace
{

OIIO::ImageSpec describe(const struct image &image, const OIIO::ImageOutput &output)
{
    int channels = output.supports("alpha") ? 4 : 3;
    OIIO::TypeDesc type = image.is_float ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
    OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), channels,
                         type);
    spec.attribute("oiio:ColorSpace", image.is_float ? "Linear" : "sRGB");
    if (!image.is_float)
        spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("CompressionQuality", 95);
    leave_out_date(output, spec);
    if (image.levels) {
        spec.tile_width = spec.tile_height = 64;
        spec.attribute("textureformat", "Plain Texture"); /* makes OpenEXR read levels */
    }
    return spec;
}

/* The picture and its planes, channel by channel. */
bool write_planes(OIIO::ImageOutput &output, const char *path, const struct image &image)
{
    OIIO::ImageSpec spec = describe(image, output);
    size_t pixels = static_cast<size_t>(image.width) * image.height,
           channels = 4 + image.num_planes;
    std::vector<float> values(pixels * channels);
    const float *color = static_cast<const float *>(image.pixels);
    spec.nchannels = static_cast<int>(channels);
    for (uint32_t i = 0; i < image.num_planes; ++i)
        spec.channelnames.push_back(image.planes[i].name);
    for (size_t i = 0; i < pixels; ++i) {
        float *out = &values[i * channels];
        std::copy(color + 4 * i, color + 4 * i + 4, out);
        for (uint32_t k = 0; k < image.num_planes; ++k)
            out[4 + k] = image.planes[k].values[i * image.planes[k].stride];
    }
    return output.open(path, spec) && output.write_image(spec.format, values.data())
           && output.close();
}

bool write_pixels(OIIO::ImageOutput &output, const char *path, const struct image &image)
{
    OIIO::ImageSpec spec = describe(image, output);
    size_t texel = 4 * (image.is_float ? sizeof(float) : 1);
    const char *pixels = static_cast<const char *>(image.pixels);
    bool good = true;
    for (uint32_t level = 0; good && level < (image.levels ? image.levels : 1); ++level) {
        spec.width = spec.full_width = static_cast<int>(image_level_size(image.width, level));
        spec.height = spec.full_height = static_cast<int>(image_level_size(image.height, level));
        good = output.open(path, spec,
                           level ? OIIO::ImageOutput::AppendMIPLevel : OIIO::ImageOutput::Create)
               && output.write_image(spec.format, pixels, static_cast<OIIO::stride_t>(texel));
        pixels += texel * static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height);
    }
    return output.close() && good;
}

bool can_write(const std::string &name, char *reason, size_t capacity)
{
    std::string folder = name.substr(0, name.rfind('/') + 1);
    struct stat info;
    auto output = OIIO::ImageOutput::create(name);
    if (!output || !output->supports("ioproxy")) {
        OIIO::geterror();
        return fail(reason, capacity, "unknown image format; use .png, .jpg, .exr or .hdr");
    }
    if (stat(name.c_str(), &info) == 0 && S_ISDIR(info.st_mode))
        return fail(reason, capacity, std::strerror(EISDIR));
    return access(folder.empty() ? "." : folder.c_str(), W_OK) == 0
           || fail(reason, capacity, std::strerror(errno));
}

bool write_file(const files_stream &stream, const struct image &image, char *reason,
                size_t capacity)
{
    const char *path = stream.path;
    stream_proxy proxy(stream.out);
    auto output = OIIO::ImageOutput::create(path);
    if (!output)
        return fail(reason, capacity, OIIO::geterror());
    output->set_ioproxy(&proxy);
    bool has_planes = image.num_planes && output->supports("nchannels");
    bool good =
        has_planes ? write_planes(*output, path, image) : write_pixels(*output, path, image);
    return good || fail(reason, capacity, proxy.reason(*output));
}

} // namespace

bool image_can_write(const char *path, char *reason, size_t capacity)
{
    return guard(reason, capacity, [&] { return can_write(path, reason, capacity); });
}

bool image_write(const char *path, const struct image *image, char *reason, size_t capacity)
{
    struct files_stream stream;
    const char *fault = files_begin(&stream, path);
    if (fault)
        return fail(reason, capacity, fault);
    bool good =
        guard(reason, capacity, [&] { return write_file(stream, *image, reason, capacity); });
    fault = files_end(&stream, good);
    return fault ? fail(reason, capacity, fault) : good;
}
