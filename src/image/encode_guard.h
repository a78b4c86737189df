// Bytes of an encoded picture, and exceptions of C++ libraries as errors: for the .cpp files that
// encode pictures.
#ifndef RAMIFY_IMAGE_ENCODE_GUARD_H
#define RAMIFY_IMAGE_ENCODE_GUARD_H

#include <exception>
#include <new>
#include <string>
#include <vector>

extern "C" {
#include "base/error.h"
}

using Bytes = std::vector<unsigned char>;

// Runs body and converts exceptions to an Error. what: "'x.png' cannot be written"
template <typename Body> bool guarded(const std::string &what, Error *e, Body body)
{
    try {
        return body();
    } catch (const std::bad_alloc &) {
        return error_set(e, ERROR_MEMORY, "%s: out of memory", what.c_str());
    } catch (const std::exception &failure) {
        return error_set(e, ERROR_INTERNAL, "%s: %s", what.c_str(), failure.what());
    } catch (...) {
        return error_set(e, ERROR_INTERNAL, "%s: unknown failure", what.c_str());
    }
}

#endif
