// A stand-in for Open Image Denoise's library, compiled with VERSION=1 or 2: those of its functions
// that ramify calls, under the names of that version. It checks the calls, fails as the environment
// variable FAKE_OIDN says, and otherwise "denoises" to color / 2 + albedo / 4 + normal / 8.
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#if VERSION == 1
#define oidnSetDeviceBool oidnSetDevice1b
#define oidnSetDeviceInt oidnSetDevice1i
#define oidnGetDeviceInt oidnGetDevice1i
#define oidnSetFilterBool oidnSetFilter1b
#endif

enum { INVALID = 2, MEMORY = 4, UNSUPPORTED = 5, CANCELLED = 6 };

typedef struct Device {
    int threads, error;
    bool free_threads, committed;
    const char *message;
} Device;

typedef struct FakeImage {
    char *data;
    size_t width, height, stride;
} FakeImage;

typedef struct Filter {
    Device *device;
    FakeImage image[4]; // color, albedo, normal, output
    bool hdr, committed;
    bool (*monitor)(void *user, double done);
    void *user;
} Filter;

static bool fails(const char *how)
{
    const char *wanted = getenv("FAKE_OIDN");
    return wanted && strcmp(wanted, how) == 0;
}

static void fail(Device *device, int error, const char *message)
{
    if (!device->error) {
        device->error = error;
        device->message = message;
    }
}

Device *oidnNewDevice(int type);
void oidnSetDeviceBool(Device *device, const char *name, bool value);
void oidnSetDeviceInt(Device *device, const char *name, int value);
int oidnGetDeviceInt(Device *device, const char *name);
void oidnCommitDevice(Device *device);
int oidnGetDeviceError(Device *device, const char **message);
void oidnReleaseDevice(Device *device);
Filter *oidnNewFilter(Device *device, const char *type);
void oidnSetSharedFilterImage(Filter *filter, const char *name, void *data, int format,
                              size_t width, size_t height, size_t offset, size_t pixel_stride,
                              size_t row_stride);
void oidnSetFilterBool(Filter *filter, const char *name, bool value);
void oidnSetFilterProgressMonitorFunction(Filter *filter, bool (*monitor)(void *, double),
                                          void *user);
void oidnCommitFilter(Filter *filter);
void oidnExecuteFilter(Filter *filter);
void oidnReleaseFilter(Filter *filter);

Device *oidnNewDevice(int type)
{
    return type == 1 && !fails("device") ? calloc(1, sizeof(Device)) : NULL;
}

void oidnSetDeviceBool(Device *device, const char *name, bool value)
{
    device->free_threads = strcmp(name, "setAffinity") == 0 && !value;
}

void oidnSetDeviceInt(Device *device, const char *name, int value)
{
    device->threads = strcmp(name, "numThreads") == 0 ? value : 0;
}

int oidnGetDeviceInt(Device *device, const char *name)
{
    return device->committed && strcmp(name, "version") == 0 ? VERSION * 10000 + 300 : 0;
}

void oidnCommitDevice(Device *device)
{
    device->committed = device->threads >= 1 && device->free_threads;
    if (!device->committed) {
        fail(device, INVALID, "device without threads");
    }
}

int oidnGetDeviceError(Device *device, const char **message)
{
    if (!device) {
        *message = "no such device";
        return UNSUPPORTED;
    }
    int error = device->error;
    *message = device->message;
    device->error = 0;
    device->message = NULL;
    return error;
}

void oidnReleaseDevice(Device *device)
{
    free(device);
}

Filter *oidnNewFilter(Device *device, const char *type)
{
    Filter *filter = device->committed && strcmp(type, "RT") == 0 && !fails("filter")
                         ? calloc(1, sizeof *filter)
                         : NULL;
    if (filter) {
        filter->device = device;
    } else {
        fail(device, INVALID, "no such filter");
    }
    return filter;
}

void oidnSetSharedFilterImage(Filter *filter, const char *name, void *data, int format,
                              size_t width, size_t height, size_t offset, size_t pixel_stride,
                              size_t row_stride)
{
    static const char *const names[] = {"color", "albedo", "normal", "output"};
    for (int i = 0; i < 4; i++) {
        if (strcmp(name, names[i]) == 0 && format == 3 && offset == 0 && row_stride == 0) {
            filter->image[i] = (FakeImage){data, width, height, pixel_stride};
        }
    }
}

void oidnSetFilterBool(Filter *filter, const char *name, bool value)
{
    filter->hdr = strcmp(name, "hdr") == 0 && value;
}

void oidnSetFilterProgressMonitorFunction(Filter *filter, bool (*monitor)(void *, double),
                                          void *user)
{
    filter->monitor = monitor;
    filter->user = user;
}

void oidnCommitFilter(Filter *filter)
{
    const FakeImage *image = filter->image;
    filter->committed = filter->hdr;
    for (int i = 0; i < 4; i++) {
        filter->committed = filter->committed && image[i].data &&
                            image[i].width == image[0].width && image[i].height == image[0].height;
    }
}

void oidnExecuteFilter(Filter *filter)
{
    const FakeImage *image = filter->image;
    if (fails("memory")) {
        fail(filter->device, MEMORY, "no room");
        return;
    }
    if (!filter->committed || fails("execute")) {
        fail(filter->device, INVALID, "not committed");
        return;
    }
    for (size_t i = 0; i < image[0].width * image[0].height; i++) {
        float in[3][3], out[3];
        if (i % image[0].width == 0 && filter->monitor && !filter->monitor(filter->user, 0.5)) {
            fail(filter->device, CANCELLED, "cancelled");
            return;
        }
        for (int k = 0; k < 3; k++) {
            memcpy(in[k], image[k].data + i * image[k].stride, sizeof in[k]);
        }
        for (int c = 0; c < 3; c++) {
            out[c] = in[0][c] / 2 + in[1][c] / 4 + in[2][c] / 8;
        }
        memcpy(image[3].data + i * image[3].stride, out, sizeof out);
    }
}

void oidnReleaseFilter(Filter *filter)
{
    free(filter);
}
