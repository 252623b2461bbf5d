// SPDX-License-Identifier: Apache-2.0
#include "render/image_rows.h"
#include "render/image_guard.h"
#include "render/image_stream.h"

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>

struct image_rows {
    stream_proxy proxy;
    std::unique_ptr<OIIO::ImageOutput> output;
    uint32_t done = 0;
    explicit image_rows(std::FILE *out) : proxy(out)
    {
    }
};

namespace
{

OIIO::TypeDesc type_of(const image_format &format)
{
    if (format.is_float)
        return format.depth == 16 ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
    return format.depth == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8;
}

bool begin(const char *path, const image_format &format, image_rows &rows, char *reason,
           size_t capacity)
{
    rows.output = OIIO::ImageOutput::create(path);
    if (!rows.output)
        return fail(reason, capacity, OIIO::geterror());
    rows.output->set_ioproxy(&rows.proxy);
    OIIO::ImageSpec spec(static_cast<int>(format.width), static_cast<int>(format.height),
                         static_cast<int>(format.channels), type_of(format));
    spec.attribute("oiio:ColorSpace", format.is_srgb ? "sRGB" : "Linear");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("CompressionQuality", 95);
    leave_out_date(*rows.output, spec);
    return rows.output->open(path, spec) || fail(reason, capacity, rows.proxy.reason(*rows.output));
}

} // namespace

struct image_rows *image_rows_begin(FILE *out, const char *path, const struct image_format *format,
                                    char *reason, size_t capacity)
{
    std::unique_ptr<image_rows> rows;
    bool good = guard(reason, capacity, [&] {
        rows = std::make_unique<image_rows>(out);
        return begin(path, *format, *rows, reason, capacity);
    });
    return good ? rows.release() : nullptr;
}

bool image_rows_add(struct image_rows *rows, uint32_t count, const float *values, char *reason,
                    size_t capacity)
{
    return guard(reason, capacity, [&] {
        int first = static_cast<int>(rows->done);
        rows->done += count;
        return rows->output->write_scanlines(first, static_cast<int>(rows->done), 0,
                                             OIIO::TypeDesc::FLOAT, values)
               || fail(reason, capacity, rows->proxy.reason(*rows->output));
    });
}

bool image_rows_end(struct image_rows *rows, char *reason, size_t capacity)
{
    if (!rows)
        return true;
    std::unique_ptr<image_rows> owned(rows);
    return guard(reason, capacity, [&] {
        return owned->output->close()
               || fail(reason, capacity, owned->proxy.reason(*owned->output));
    });
}
