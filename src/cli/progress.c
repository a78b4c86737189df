#include "cli/progress.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define BAR_WIDTH 30
#define TERMINAL_INTERVAL 0.1 // s
#define LINE_INTERVAL 10.0

double clock_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void progress_start(Progress *progress, bool quiet)
{
    *progress = (Progress){.quiet = quiet, .terminal = isatty(STDERR_FILENO) == 1};
    atomic_flag_clear(&progress->busy);
}

static void format_time(double seconds, char *text, size_t size)
{
    long s = seconds < 359999.0 ? lround(seconds) : 359999;
    if (s < 60) {
        snprintf(text, size, "%ld s", s);
    } else if (s < 3600) {
        snprintf(text, size, "%ld min %02ld s", s / 60, s % 60);
    } else {
        snprintf(text, size, "%ld h %02ld min", s / 3600, s / 60 % 60);
    }
}

// ", 1.3 M samples/s, 12 s left", as far as known.
static void format_outlook(const Progress *p, double done, double now, char *text, size_t size)
{
    double elapsed = now - p->stage_start;
    int used = 0;
    text[0] = 0;
    if (elapsed < 0.2 || done <= 0.0) {
        return;
    }
    if (p->work > 0.0 && strcmp(p->stage, "trace") == 0) {
        used = snprintf(text, size, ", %.2f M samples/s", done * p->work / elapsed * 1e-6);
    }
    if (elapsed > 0.5 && done < 1.0) {
        char left[40];
        format_time(elapsed * (1.0 - done) / done, left, sizeof left);
        snprintf(text + used, size - (size_t)used, ", %s left", left);
    }
}

static void show(Progress *p, double done, double now)
{
    char outlook[100];
    format_outlook(p, done, now, outlook, sizeof outlook);
    int percent = (int)(100.0 * done);
    if (!p->terminal) {
        fprintf(stderr, "%s %d %%%s\n", p->stage, percent, outlook);
        return;
    }
    char bar[BAR_WIDTH + 1];
    int filled = (int)(done * BAR_WIDTH);
    memset(bar, '#', (size_t)filled);
    memset(bar + filled, '.', (size_t)(BAR_WIDTH - filled));
    bar[BAR_WIDTH] = 0;
    fprintf(stderr, "\r\033[K%-9s [%s] %3d %%%s", p->stage, bar, percent, outlook);
    fflush(stderr);
    p->shown = true;
}

// "frame 3 of 72" and "frame 4 of 72" are the same stage.
static bool same_stage(const char *a, const char *b)
{
    size_t word = strcspn(a, " ");
    return strncmp(a, b, word) == 0 && (b[word] == 0 || b[word] == ' ');
}

void progress_report(void *user, const char *stage, double done)
{
    Progress *p = user;
    if (p->quiet || atomic_flag_test_and_set(&p->busy)) {
        return; // another thread is printing
    }
    double now = clock_seconds();
    bool same = same_stage(p->stage, stage);
    snprintf(p->stage, sizeof p->stage, "%s", stage);
    if (!same) {
        p->stage_start = now;
        p->last = p->terminal ? 0.0 : now;
    }
    if (now - p->last >= (p->terminal ? TERMINAL_INTERVAL : LINE_INTERVAL)) {
        show(p, done < 0.0 ? 0.0 : (done > 1.0 ? 1.0 : done), now);
        p->last = now;
    }
    atomic_flag_clear(&p->busy);
}

void progress_end(Progress *progress)
{
    if (progress->shown) {
        fputs("\r\033[K", stderr);
        progress->shown = false;
    }
}

void progress_warn(void *user, const char *message)
{
    Progress *p = user;
    if (!p->quiet) {
        progress_end(p);
        fprintf(stderr, "ramify: warning: %s\n", message);
    }
}
