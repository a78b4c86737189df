#include "image/encode_bytes.h"

#include <OpenImageIO/filesystem.h>

#include <cstring>
#include <string>

#include "image/encode_check.h"
#include "image/png_text.h"

namespace
{

const size_t ROOM_FOR_HEADER = 1 << 20;

// OpenImageIO collects a line for each thing that fails after the first.
std::string first_line(const std::string &text)
{
    return text.substr(0, text.find('\n'));
}

} // namespace

bool encode(const Encoding &job, Bytes &bytes, Error *e)
{
    // Room for all: libjpeg and libpng cannot bear an exception while they write.
    bytes.reserve(size_t(job.spec.image_bytes()) + ROOM_FOR_HEADER);
    OIIO::ImageSpec spec = job.spec;
    spec.attribute("DateTime", ""); // no time stamp: equal pictures give equal files
    spec.attribute("Software", "ramify");
    OIIO::Filesystem::IOVecOutput proxy(bytes);
    OIIO::attribute("threads", 1); // none that a child process could wait for (base/child.h)
    OIIO::attribute("debug", 0);   // errors are ours to tell
    auto output = OIIO::ImageOutput::create(job.format);
    if (!output || !output->supports("ioproxy")) {
        return error_set(e, ERROR_INTERNAL, "OpenImageIO has no %s writer", job.format);
    }
    std::string name = std::string("memory.") + job.format;
    bool done = output->set_ioproxy(&proxy) && output->open(name, spec) &&
                output->write_image(spec.format, job.pixels) && output->close();
    if (!done) {
        return error_set(e, ERROR_INTERNAL, "%s", first_line(output->geterror()).c_str());
    }
    // Not as OpenImageIO's attributes, which would stay in memory until the process ends.
    if (std::strcmp(job.format, "png") == 0) {
        png_add_texts(bytes, job.metadata);
    }
    return encoded_well(job, bytes) ||
           error_set(e, ERROR_MEMORY, "what was written is not complete; out of memory");
}
