// SPDX-License-Identifier: Apache-2.0
// Writes one map of light as files that the page reads, by OpenImageIO. Argument: a folder, which
// exists.
#include <OpenImageIO/imageio.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace
{

constexpr int width = 256, height = 128;

struct format {
    const char *file, *compression;
    OIIO::TypeDesc type;
};

/* A warm ground, a cold sky, a green lamp, and a small sun. */
std::vector<float> make_map()
{
    std::vector<float> pixels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float up = 1 - (static_cast<float>(y) + 0.5f) / height;
            const bool is_lamp = std::abs(x - 60) < 12 && std::abs(y - 50) < 6;
            const bool is_sun = std::abs(x - 150) < 2 && std::abs(y - 30) < 2;
            pixels.push_back(is_sun ? 300.f : 0.4f - 0.2f * up);
            pixels.push_back(is_sun ? 200.f : is_lamp ? 20.f : 0.3f);
            pixels.push_back(is_sun ? 100.f : 0.1f + 0.6f * up);
        }
    return pixels;
}

bool write(const std::string &path, const format &format, const std::vector<float> &pixels)
{
    OIIO::ImageSpec spec(width, height, 3, format.type);
    if (format.compression)
        spec.attribute("compression", format.compression);
    auto out = OIIO::ImageOutput::create(path);
    return out && out->open(path, spec) && out->write_image(OIIO::TypeDesc::FLOAT, pixels.data())
           && out->close();
}

} // namespace

int main(int argc, char **argv)
{
    const format formats[] = {{"runs.hdr", nullptr, OIIO::TypeDesc::FLOAT},
                              {"none.exr", "none", OIIO::TypeDesc::FLOAT},
                              {"rle.exr", "rle", OIIO::TypeDesc::HALF},
                              {"zips.exr", "zips", OIIO::TypeDesc::FLOAT},
                              {"zip.exr", "zip", OIIO::TypeDesc::HALF},
                              {"piz_half.exr", "piz", OIIO::TypeDesc::HALF},
                              {"piz_float.exr", "piz", OIIO::TypeDesc::FLOAT},
                              {"pxr24.exr", "pxr24", OIIO::TypeDesc::FLOAT},
                              {"dwaa.exr", "dwaa", OIIO::TypeDesc::HALF},
                              {"b44.exr", "b44", OIIO::TypeDesc::HALF}};
    const std::vector<float> pixels = make_map();
    for (const format &format : formats)
        if (argc != 2 || !write(std::string(argv[1]) + "/" + format.file, format, pixels)) {
            std::fprintf(stderr, "write_maps: cannot write %s\n", format.file);
            return 1;
        }
    return 0;
}
