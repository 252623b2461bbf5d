// SPDX-License-Identifier: Apache-2.0
/* How OpenImageIO writes to a stream of C. */
#ifndef MXG_RENDER_IMAGE_STREAM_H
#define MXG_RENDER_IMAGE_STREAM_H

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

/*
 * OpenImageIO writes the date into each OpenEXR file, and equal pictures would differ. It leaves
 * out an attribute of a type that OpenEXR does not have, and says so only with its option "debug".
 */
inline void leave_out_date(const OIIO::ImageOutput &output, OIIO::ImageSpec &spec)
{
    const unsigned char none = 0;
    if (std::strcmp(output.format_name(), "openexr") != 0)
        return;
    OIIO::attribute("debug", 0);
    spec.attribute("DateTime", OIIO::TypeDesc(OIIO::TypeDesc::UINT8), &none);
}

/*
 * Writers of formats that open a file do not tell all faults of the disk, and libjpeg ends the
 * process. A stream keeps its fault, so whoever closes it sees each.
 */
class stream_proxy final : public OIIO::Filesystem::IOProxy
{
  public:
    explicit stream_proxy(std::FILE *stream) : IOProxy("", Write), stream(stream)
    {
    }
    const char *proxytype() const override
    {
        return "stream";
    }
    int64_t tell() override
    {
        return ftello(stream);
    }
    bool seek(int64_t offset) override
    {
        return fseeko(stream, offset, SEEK_SET) == 0;
    }
    size_t write(const void *data, size_t size) override
    {
        size_t written = std::fwrite(data, 1, size, stream);
        if (written < size && !fault)
            fault = errno;
        return written;
    }
    void flush() const override
    {
        std::fflush(stream);
    }

    /* Why an image is not written: what the disk says, or else the writer. */
    std::string reason(const OIIO::ImageOutput &output) const
    {
        std::string said = output.geterror();
        return fault ? std::strerror(fault) : said;
    }

  private:
    std::FILE *stream;
    int fault = 0;
};

#endif
