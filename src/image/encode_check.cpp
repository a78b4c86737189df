#include "image/encode_check.h"

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>

namespace
{

const int ROWS_AT_A_TIME = 64;

// The mean difference of a row, in steps of 8 bits. White noise has 3 at the quality of our JPEGs.
const double JPEG_LIMIT = 16.0;

bool has_metadata(const Encoding &job, const OIIO::ImageSpec &found)
{
    if (std::strcmp(job.format, "jpeg") == 0) { // all of it is one text
        return !job.metadata || !*job.metadata || found.find_attribute("ImageDescription");
    }
    bool all = true;
    for (const char *key = job.metadata; key && *key; key += std::strlen(key) + 1) {
        all = all && found.find_attribute(key);
        key += std::strlen(key) + 1; // over the value
    }
    return all;
}

bool same_row(const Encoding &job, const unsigned char *wanted, const unsigned char *found,
              size_t size)
{
    if (std::strcmp(job.format, "jpeg") != 0) {
        return std::memcmp(wanted, found, size) == 0;
    }
    double sum = 0.0;
    for (size_t i = 0; i < size; i++) {
        sum += std::abs(int(wanted[i]) - int(found[i]));
    }
    return sum <= JPEG_LIMIT * double(size);
}

bool same_pixels(const Encoding &job, OIIO::ImageInput &input)
{
    const OIIO::ImageSpec &spec = job.spec;
    size_t row = size_t(spec.width) * size_t(spec.nchannels) * spec.format.size();
    Bytes block(row * size_t(ROWS_AT_A_TIME));
    const auto *wanted = static_cast<const unsigned char *>(job.pixels);
    bool same = true;
    for (int y = 0; same && y < spec.height; y += ROWS_AT_A_TIME) {
        int rows = std::min(ROWS_AT_A_TIME, spec.height - y);
        same = input.read_scanlines(0, 0, y, y + rows, 0, 0, spec.nchannels, spec.format,
                                    block.data());
        for (int i = 0; same && i < rows; i++) {
            same = same_row(job, wanted + size_t(y + i) * row, block.data() + size_t(i) * row, row);
        }
    }
    return same;
}

} // namespace

bool encoded_well(const Encoding &job, const Bytes &bytes)
{
    OIIO::Filesystem::IOMemReader proxy(const_cast<unsigned char *>(bytes.data()), bytes.size());
    auto input = OIIO::ImageInput::create(job.format);
    OIIO::ImageSpec found, config;
    config.attribute("oiio:UnassociatedAlpha", 1); // as stored
    std::string name = std::string("memory.") + job.format;
    if (!input || !input->set_ioproxy(&proxy) || !input->open(name, found, config)) {
        return false;
    }
    const OIIO::ImageSpec &spec = job.spec;
    return found.width == spec.width && found.height == spec.height &&
           found.nchannels == spec.nchannels && has_metadata(job, found) &&
           same_pixels(job, *input);
}
