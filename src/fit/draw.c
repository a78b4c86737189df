// The picture of the way of a fit: misfit, parameters and measures over the evaluations.
#include "fit/fit.h"

#include "base/c_locale.h"
#include "base/file_writer.h"
#include "base/key_path.h"
#include "base/markup.h"
#include "fit/misfit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LONGEST_PATH = 32 }; // characters, beside a diagram

// pixels
enum { WIDTH = 960, LEFT = 250, RIGHT = 30, TOP = 56, ROW = 96, PLOT = 64, BOTTOM = 40 };

// One diagram: values over the evaluations.
typedef struct Diagram {
    const Fit *fit;
    FileWriter *w;
    int top;          // of the plot
    double low, high; // of the axis
    bool logarithmic;
} Diagram;

static double place_x(const Fit *fit, int64_t index)
{
    double steps = fit->count > 1 ? (double)(fit->count - 1) : 1.0;
    return LEFT + (WIDTH - LEFT - RIGHT) * (double)index / steps;
}

static double place_y(const Diagram *d, double value)
{
    double share = d->logarithmic ? log(value / d->low) / log(d->high / d->low)
                                  : (value - d->low) / (d->high - d->low);
    share = share < 0.0 ? 0.0 : (share > 1.0 ? 1.0 : share);
    return d->top + PLOT * (1.0 - share);
}

static void put_text(const Diagram *d, double x, double y, const char *anchor, const char *class,
                     const char *text)
{
    file_writer_print(d->w, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" class=\"%s\">", x, y,
                      anchor, class);
    markup_text(d->w, text);
    file_writer_text(d->w, "</text>\n");
}

// Frame, name at the left, ends of the axis, the best evaluation's line.
static void put_frame(const Diagram *d, const char *name, const char *of)
{
    char text[64];
    put_text(d, 16, d->top + 0.5 * PLOT, "start", "name", name);
    put_text(d, 16, d->top + 0.5 * PLOT + 16, "start", "small", of);
    snprintf(text, sizeof text, "%.4g", d->high);
    put_text(d, LEFT - 8, d->top + 9, "end", "small", text);
    snprintf(text, sizeof text, "%.4g", d->low);
    put_text(d, LEFT - 8, d->top + PLOT, "end", "small", text);
    file_writer_print(d->w,
                      "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" class=\"frame\"/>\n",
                      LEFT, d->top, WIDTH - LEFT - RIGHT, PLOT);
    double x = place_x(d->fit, d->fit->best);
    file_writer_print(d->w, "<line x1=\"%.1f\" y1=\"%d\" x2=\"%.1f\" y2=\"%d\" class=\"best\"/>\n",
                      x, d->top, x, d->top + PLOT);
}

static void put_dot(const Diagram *d, int64_t index, double value)
{
    if (isfinite(value)) {
        file_writer_print(d->w, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\" class=\"%s\"/>\n",
                          place_x(d->fit, index), place_y(d, value),
                          index == d->fit->best ? "4" : "2.5",
                          index == d->fit->best ? "chosen" : "dot");
    }
}

static void draw_misfit(Diagram d)
{
    const Fit *fit = d.fit;
    d.low = 0.0;
    for (int64_t i = 0; i < fit->count; i++) {
        double misfit = fit->steps[i].misfit;
        d.high = isfinite(misfit) && misfit > d.high ? misfit : d.high;
    }
    d.high = d.high > 0.0 ? d.high : 1.0;
    put_frame(&d, "misfit", "0 = all targets met; line: the best so far");
    file_writer_text(d.w, "<polyline class=\"way\" points=\"");
    double lowest = d.high;
    for (int64_t i = 0; i < fit->count; i++) {
        lowest = fit->steps[i].misfit < lowest ? fit->steps[i].misfit : lowest;
        file_writer_print(d.w, "%.1f,%.1f ", place_x(fit, i), place_y(&d, lowest));
    }
    file_writer_text(d.w, "\"/>\n");
    for (int64_t i = 0; i < fit->count; i++) {
        put_dot(&d, i, fit->steps[i].misfit);
    }
}

static void draw_parameter(Diagram d, int index)
{
    const FitParameter *p = &d.fit->parameters[index];
    d.low = p->low;
    d.high = p->high;
    d.logarithmic = p->logarithmic;
    size_t length = strlen(p->path), most = LONGEST_PATH;
    char path[LONGEST_PATH + 8]; // its end
    snprintf(path, sizeof path, "%s%s", length > most ? "..." : "",
             p->path + (length > most ? length - most : 0));
    put_frame(&d, key_path_end(p->path), path);
    for (int64_t i = 0; i < d.fit->count; i++) {
        put_dot(&d, i, d.fit->steps[i].parameters[index]);
    }
}

static void draw_target(Diagram d, int index)
{
    const SceneTarget *t = &d.fit->scene->targets[index];
    bool has_low = t->low > -TARGET_NO_BOUND, has_high = t->high < TARGET_NO_BOUND;
    d.low = has_low ? t->low : t->high;
    d.high = has_high ? t->high : t->low;
    for (int64_t i = 0; i < d.fit->count; i++) {
        double value = d.fit->steps[i].measures[index];
        if (isfinite(value)) {
            d.low = value < d.low ? value : d.low;
            d.high = value > d.high ? value : d.high;
        }
    }
    d.high = d.high > d.low ? d.high : d.low + 1.0;
    double top = has_high ? place_y(&d, t->high) : d.top;
    double bottom = has_low ? place_y(&d, t->low) : d.top + PLOT;
    file_writer_print(d.w,
                      "<rect x=\"%d\" y=\"%.1f\" width=\"%d\" height=\"%.1f\" class=\"range\"/>\n",
                      LEFT, top, WIDTH - LEFT - RIGHT, bottom - top > 1.0 ? bottom - top : 1.0);
    put_frame(&d, t->measure, t->object);
    for (int64_t i = 0; i < d.fit->count; i++) {
        put_dot(&d, i, d.fit->steps[i].measures[index]);
    }
}

static void put_head(const Fit *fit, FileWriter *w, int height)
{
    file_writer_print(w,
                      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" "
                      "viewBox=\"0 0 %d %d\">\n<style>text{font:13px sans-serif;fill:#222}"
                      ".title{font-size:17px}.small{font-size:11px;fill:#666}"
                      ".frame{fill:none;stroke:#bbb}.range{fill:#d9ead3}"
                      ".best{stroke:#c0392b;stroke-dasharray:3 3}.way{fill:none;stroke:#222}"
                      ".dot{fill:#4a6fa5}.chosen{fill:#c0392b}</style>\n"
                      "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n",
                      WIDTH, height, WIDTH, height);
    const FitStep *best = &fit->steps[fit->best];
    char text[160];
    snprintf(text, sizeof text, "%lld evaluations; the best, number %lld, %s",
             (long long)fit->count, (long long)fit->best + 1,
             best->met ? "meets all targets" : "misses targets");
    put_text(&(Diagram){.w = w}, 16, 30, "start", "title", text);
}

static void put_diagrams(const Fit *fit, FileWriter *w)
{
    Diagram d = {.fit = fit, .w = w, .top = TOP};
    draw_misfit(d);
    for (int i = 0; i < fit->parameter_count; i++) {
        d.top += ROW;
        draw_parameter(d, i);
    }
    for (int i = 0; i < fit->scene->target_count; i++) {
        d.top += ROW;
        draw_target(d, i);
    }
    d.top += PLOT + 20;
    put_text(&d, LEFT, d.top, "start", "small", "evaluation 1");
    char text[32];
    snprintf(text, sizeof text, "%lld", (long long)fit->count);
    put_text(&d, WIDTH - RIGHT, d.top, "end", "small", text);
    put_text(&d, 0.5 * (LEFT + WIDTH - RIGHT), d.top, "middle", "small",
             "green: the target's range; red: the best evaluation");
}

bool fit_draw(const Fit *fit, const char *file, Error *e)
{
    CLocale locale;
    FileWriter *w = file_writer_open(file, e);
    if (!w || !c_locale_enter(&locale, e)) {
        file_writer_close(w, false, NULL);
        return false;
    }
    int rows = 1 + fit->parameter_count + fit->scene->target_count;
    put_head(fit, w, TOP + rows * ROW - (ROW - PLOT) + BOTTOM);
    put_diagrams(fit, w);
    file_writer_text(w, "</svg>\n");
    c_locale_leave(&locale);
    return file_writer_close(w, true, e);
}
