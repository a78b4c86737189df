#include "animate/video.h"

#include "base/memory.h"
#include "image/quantise.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

struct Video {
    char *file;        // final name
    char *part;        // name until complete
    int width, height; // even
    pid_t ffmpeg;      // 0 = not running
    int frames;   // socket to ffmpeg's input: unlike a pipe, writing to it after its end raises no
                  // SIGPIPE
    int said;     // ffmpeg's stderr: a file in memory
    uint8_t *row; // bytes of a row
};

extern char **environ;

// ---- ffmpeg

bool video_check(Error *e)
{
    const char *path = getenv("PATH");
    while (path && *path) {
        char name[PATH_MAX];
        size_t length = strcspn(path, ":");
        snprintf(name, sizeof name, "%.*s/ffmpeg", (int)length, length ? path : ".");
        struct stat status;
        if (access(name, X_OK) == 0 && stat(name, &status) == 0 && S_ISREG(status.st_mode)) {
            return true;
        }
        path += length + (path[length] == ':');
    }
    return error_set(e, ERROR_IO,
                     "ffmpeg is not installed, which makes films; install it, or write single "
                     "frames as in -o frame-%%04d.png");
}

// The last line that ffmpeg wrote, which tells why it failed.
static void last_words(const Video *video, char *text, size_t size)
{
    char all[4096];
    off_t length = lseek(video->said, 0, SEEK_END);
    off_t from = length > (off_t)sizeof all - 1 ? length - ((off_t)sizeof all - 1) : 0;
    ssize_t count = pread(video->said, all, sizeof all - 1, from);
    all[count > 0 ? count : 0] = 0;
    for (size_t end = strlen(all); end > 0 && all[end - 1] == '\n';) {
        all[--end] = 0;
    }
    const char *line = strrchr(all, '\n');
    snprintf(text, size, "%.*s", (int)size - 1, line ? line + 1 : all);
}

// Waits for ffmpeg to end; true if it succeeded.
static bool wait_for(Video *video)
{
    int status = -1;
    while (waitpid(video->ffmpeg, &status, 0) < 0 && errno == EINTR) {
    }
    video->ffmpeg = 0;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

static bool ffmpeg_error(const Video *video, Error *e)
{
    char words[512];
    last_words(video, words, sizeof words);
    return error_set(e, ERROR_IO, "'%s' cannot be written: ffmpeg: %s", video->file,
                     *words ? words : "it ended without a word");
}

// A process group of its own, so that Ctrl-C reaches only us.
static bool spawn(Video *video, int input, char *const *arguments, Error *e)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t none;
    sigemptyset(&none);
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, video->said, STDERR_FILENO);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setsigmask(&attributes, &none);
    int reason = posix_spawnp(&video->ffmpeg, "ffmpeg", &actions, &attributes, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (reason != 0) {
        video->ffmpeg = 0;
        return error_set(e, ERROR_IO, "'%s' cannot be written: ffmpeg does not start: %s",
                         video->file, strerror(reason));
    }
    return true;
}

static bool start(Video *video, double fps, Error *e)
{
    char size[32], rate[32], output[PATH_MAX];
    snprintf(size, sizeof size, "%dx%d", video->width, video->height);
    snprintf(rate, sizeof rate, "%.9g", fps);
    char *comma = strchr(rate, ',');
    if (comma) {
        *comma = '.'; // whatever the locale
    }
    snprintf(output, sizeof output, "file:%s", video->part);
    // A fixed number of threads: x264's bits depend on it. Players want bt709 and the index first.
    // clang-format off
    const char *const arguments[] = {
        "ffmpeg", "-hide_banner", "-loglevel", "error",
        "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", size, "-framerate", rate, "-i", "pipe:0", "-an",
        "-vf", "scale=in_range=full:out_range=tv:out_color_matrix=bt709,format=yuv420p",
        "-sws_flags", "accurate_rnd+full_chroma_int",
        "-c:v", "libx264", "-preset", "medium", "-crf", "16", "-threads", "4",
        "-pix_fmt", "yuv420p", "-color_range", "tv",
        "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709",
        "-movflags", "+faststart", "-fflags", "+bitexact", "-flags:v", "+bitexact",
        "-map_metadata", "-1", "-f", "mp4", "-y", output, NULL};
    // clang-format on
    int pair[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0) {
        return error_set(e, ERROR_IO, "'%s' cannot be written: %s", video->file, strerror(errno));
    }
    video->frames = pair[0];
    bool done = spawn(video, pair[1], (char *const *)arguments, e);
    close(pair[1]);
    return done;
}

// ---- films

Video *video_open(const char *file, const char *part, int width, int height, double fps, Error *e)
{
    if (width < 2 || height < 2) {
        error_set(e, ERROR_INPUT, "a film of %d x %d pixels; it must have 2 x 2 at least", width,
                  height);
        return NULL;
    }
    Video *video = memory_alloc_zero(1, sizeof *video, e);
    if (!video) {
        return NULL;
    }
    video->frames = video->said = -1;
    video->width = width & ~1;
    video->height = height & ~1;
    video->file = memory_copy_string(file, e);
    video->part = memory_copy_string(part, e);
    video->row = memory_alloc((int64_t)video->width * video->height, 3, e);
    video->said = memfd_create("ffmpeg", MFD_CLOEXEC);
    bool sound = video->file && video->part && video->row;
    if (sound && video->said < 0) {
        sound = error_set(e, ERROR_IO, "'%s' cannot be written: %s", file, strerror(errno));
    }
    if (sound) {
        unlink(part); // the ffmpeg of a killed run may still write to it
    }
    if (!sound || !start(video, fps, e)) {
        video_close(video, false, NULL);
        return NULL;
    }
    return video;
}

static bool send_all(Video *video, const uint8_t *bytes, size_t size, Error *e)
{
    while (size > 0) {
        ssize_t sent = send(video->frames, bytes, size, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) {
            continue;
        }
        if (sent <= 0) {
            wait_for(video);
            return ffmpeg_error(video, e);
        }
        bytes += sent;
        size -= (size_t)sent;
    }
    return true;
}

bool video_add(Video *video, const Image *frame, Error *e)
{
    if (frame->width < video->width || frame->height < video->height || frame->channels < 3) {
        return error_set(e, ERROR_INPUT, "a frame of %d x %d pixels in a film of %d x %d",
                         frame->width, frame->height, video->width, video->height);
    }
    uint8_t *out = video->row;
    for (int y = 0; y < video->height; y++) {
        const float *p = frame->pixel + (int64_t)y * frame->width * frame->channels;
        for (int x = 0; x < video->width; x++, p += frame->channels) {
            float over = frame->channels == 4 ? p[3] : 1.0f;
            for (int c = 0; c < 3; c++) {
                *out++ = quantise_dithered(p[c] * over, x, y, c);
            }
        }
    }
    return send_all(video, video->row, (size_t)(out - video->row), e);
}

// Syncs the file to disk and renames it.
static bool publish(Video *video, Error *e)
{
    int descriptor = open(video->part, O_RDONLY | O_CLOEXEC);
    bool done = descriptor >= 0 && fsync(descriptor) == 0;
    int reason = errno;
    if (descriptor >= 0) {
        close(descriptor);
    }
    if (done && rename(video->part, video->file) != 0) {
        done = false;
        reason = errno;
    }
    return done ||
           error_set(e, ERROR_IO, "'%s' cannot be written: %s", video->file, strerror(reason));
}

bool video_close(Video *video, bool keep, Error *e)
{
    if (!video) {
        return false;
    }
    bool done = false;
    if (!keep && video->ffmpeg > 0) {
        kill(video->ffmpeg, SIGKILL);
    }
    if (video->frames >= 0) {
        close(video->frames); // end of ffmpeg's input
    }
    if (video->ffmpeg > 0) {
        done = wait_for(video) && keep;
        if (keep && !done) {
            ffmpeg_error(video, e);
        }
    }
    done = done && publish(video, e);
    if (!done && video->part) {
        unlink(video->part);
    }
    if (video->said >= 0) {
        close(video->said);
    }
    free(video->row);
    free(video->part);
    free(video->file);
    free(video);
    return done;
}
