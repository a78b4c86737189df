#include "image/oidn.h"

#include <dlfcn.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The part of Open Image Denoise's C interface that is used here; values as in its oidn.h.
enum { DEVICE_CPU = 1, FORMAT_FLOAT3 = 3, FAILURE_MEMORY = 4, FAILURE_CANCELLED = 6 };

typedef struct Device Device;
typedef struct Filter Filter;
typedef bool Monitor(void *user, double done); // false: cancel

typedef struct Library {
    void *handle;
    Device *(*new_device)(int type);
    void (*set_device_bool)(Device *, const char *name, bool value);
    void (*set_device_int)(Device *, const char *name, int value);
    int (*get_device_int)(Device *, const char *name);
    void (*commit_device)(Device *);
    int (*get_error)(Device *, const char **message);
    void (*release_device)(Device *);
    Filter *(*new_filter)(Device *, const char *type);
    void (*set_image)(Filter *, const char *name, void *data, int format, size_t width,
                      size_t height, size_t offset, size_t pixel_stride, size_t row_stride);
    void (*set_filter_bool)(Filter *, const char *name, bool value);
    void (*set_monitor)(Filter *, Monitor *monitor, void *user);
    void (*commit_filter)(Filter *);
    void (*execute_filter)(Filter *);
    void (*release_filter)(Filter *);
} Library;

typedef struct Symbol {
    size_t offset;        // of the pointer in Library
    const char *name;     // in version 2
    const char *old_name; // in version 1; NULL = the same
} Symbol;

static const Symbol SYMBOLS[] = {
    {offsetof(Library, new_device), "oidnNewDevice", NULL},
    {offsetof(Library, set_device_bool), "oidnSetDeviceBool", "oidnSetDevice1b"},
    {offsetof(Library, set_device_int), "oidnSetDeviceInt", "oidnSetDevice1i"},
    {offsetof(Library, get_device_int), "oidnGetDeviceInt", "oidnGetDevice1i"},
    {offsetof(Library, commit_device), "oidnCommitDevice", NULL},
    {offsetof(Library, get_error), "oidnGetDeviceError", NULL},
    {offsetof(Library, release_device), "oidnReleaseDevice", NULL},
    {offsetof(Library, new_filter), "oidnNewFilter", NULL},
    {offsetof(Library, set_image), "oidnSetSharedFilterImage", NULL},
    {offsetof(Library, set_filter_bool), "oidnSetFilterBool", "oidnSetFilter1b"},
    {offsetof(Library, set_monitor), "oidnSetFilterProgressMonitorFunction", NULL},
    {offsetof(Library, commit_filter), "oidnCommitFilter", NULL},
    {offsetof(Library, execute_filter), "oidnExecuteFilter", NULL},
    {offsetof(Library, release_filter), "oidnReleaseFilter", NULL},
};

static bool resolve(Library *library, Error *e)
{
    for (size_t i = 0; i < sizeof SYMBOLS / sizeof SYMBOLS[0]; i++) {
        const Symbol *symbol = &SYMBOLS[i];
        void *address = dlsym(library->handle, symbol->name);
        if (!address && symbol->old_name) {
            address = dlsym(library->handle, symbol->old_name);
        }
        if (!address) {
            return error_set(e, ERROR_INPUT, "the library has no function %s", symbol->name);
        }
        // ISO C has no cast from an object's address to a function's.
        memcpy((char *)library + symbol->offset, &address, sizeof address);
    }
    return true;
}

static void library_close(Library *library)
{
    if (library->handle) {
        dlclose(library->handle);
    }
}

// Returns whether the library could be loaded; appends the reason to `why` if not.
static bool load(Library *library, const char *name, Error *why)
{
    // Stays in memory after dlclose, because its threads may outlive the device.
    library->handle = dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (!library->handle) {
        size_t used = strlen(why->message);
        snprintf(why->message + used, sizeof why->message - used, "%s%s", used ? "; " : "",
                 dlerror());
    }
    return library->handle;
}

static bool library_open(Library *library, Error *e)
{
    const char *named = getenv(OIDN_VARIABLE);
    Error why = {0};
    *library = (Library){0};
    bool loaded = named && *named ? load(library, named, &why)
                                  : load(library, "libOpenImageDenoise.so.2", &why) ||
                                        load(library, "libOpenImageDenoise.so.1", &why);
    if (loaded && resolve(library, &why)) {
        return true;
    }
    library_close(library);
    error_set(
        e, ERROR_INPUT,
        "Open Image Denoise cannot be loaded (%.400s); install its library, version 1 "
        "or 2 (https://openimagedenoise.org), or name the file in the environment variable %s",
        why.message, OIDN_VARIABLE);
    return false;
}

// Turns the device's first error since the last call into ours. made: what the calls before
// created; NULL is an error.
static bool check_device(const Library *library, Device *device, const void *made, const Run *run,
                         Error *e)
{
    const char *message = NULL;
    int code = library->get_error(device, &message);
    if (code == FAILURE_CANCELLED && run && run_is_cancelled(run)) {
        return run_cancel_error(e);
    }
    if (code == 0 && made) {
        return true;
    }
    return error_set(e, code == FAILURE_MEMORY ? ERROR_MEMORY : ERROR_INTERNAL,
                     "Open Image Denoise failed: %s", message ? message : "it gives no reason");
}

// The CPU, not a GPU: it can read our memory, and its results do not depend on the graphics driver.
// NULL: get_error tells why.
static Device *device_new(const Library *library, int threads)
{
    // resolve has set it, which the analyzer cannot follow
    Device *device = library->new_device(DEVICE_CPU); // NOLINT(clang-analyzer-core.CallAndMessage)
    if (device) {
        library->set_device_int(device, "numThreads", threads);
        library->set_device_bool(device, "setAffinity", false); // do not pin the host's threads
        library->commit_device(device);
    }
    return device;
}

int image_oidn_version(Error *e)
{
    Library library;
    if (!library_open(&library, e)) {
        return 0;
    }
    Device *device = device_new(&library, 1);
    int version = 0;
    if (check_device(&library, device, device, NULL, e)) {
        version = library.get_device_int(device, "version");
    }
    if (device) {
        library.release_device(device);
    }
    library_close(&library);
    return version;
}

static bool goes_on(void *user, double done)
{
    (void)done;
    return !run_is_cancelled(user);
}

static void set_image(const Library *library, Filter *filter, const char *name, const Image *image)
{
    // The library only reads all but the output.
    library->set_image(filter, name, image->pixel, FORMAT_FLOAT3, (size_t)image->width,
                       (size_t)image->height, 0, sizeof(float) * (size_t)image->channels, 0);
}

typedef struct Images {
    const Image *color, *albedo, *normal;
    Image *out;
} Images;

static bool filter_images(const Library *library, const Images *images, const Run *run, Error *e)
{
    Device *device = device_new(library, run->threads);
    bool done = check_device(library, device, device, run, e);
    if (done) {
        Run monitored = *run;
        Filter *filter = library->new_filter(device, "RT");
        if (filter) { // otherwise check_device reports it
            set_image(library, filter, "color", images->color);
            set_image(library, filter, "albedo", images->albedo);
            set_image(library, filter, "normal", images->normal);
            set_image(library, filter, "output", images->out);
            library->set_filter_bool(filter, "hdr", true);
            library->set_monitor(filter, goes_on, &monitored);
            library->commit_filter(filter);
            library->execute_filter(filter);
            library->release_filter(filter);
        }
        done = check_device(library, device, filter, run, e);
    }
    if (device) {
        library->release_device(device);
    }
    return done;
}

static bool fits(const Image *color, const Image *guide)
{
    return guide->width == color->width && guide->height == color->height && guide->channels == 3;
}

static bool check_images(const Images *images, Error *e)
{
    bool good = images->color->channels == 3 || images->color->channels == 4;
    good = good && fits(images->color, images->albedo) && fits(images->color, images->normal);
    return good || error_set(e, ERROR_INPUT,
                             "cannot denoise: color, albedo and normal must be of one size and "
                             "have 3 or 4, 3 and 3 channels");
}

Image *image_denoise_oidn(const Image *color, const Image *albedo, const Image *normal,
                          const Run *run, Error *e)
{
    Images images = {color, albedo, normal, NULL};
    Library library;
    if (!check_images(&images, e) || !library_open(&library, e)) {
        return NULL;
    }
    images.out = image_new(color->width, color->height, color->channels, e);
    bool done = images.out;
    if (done) {
        size_t floats = (size_t)color->width * (size_t)color->height * (size_t)color->channels;
        memcpy(images.out->pixel, color->pixel, floats * sizeof(float)); // for alpha
        done = filter_images(&library, &images, run, e);
    }
    library_close(&library);
    if (!done) {
        image_free(images.out);
        images.out = NULL;
    }
    return images.out;
}
