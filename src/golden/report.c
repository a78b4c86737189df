#include "golden/report.h"

#include "base/markup.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// report.html, report.css and report.js, embedded while building (see the Makefile).
extern const char report_html[], report_css[], report_js[];

enum { FIT_WIDTH = 336 }; // approximate initial width of a picture, pixels

typedef struct Listed {
    const GoldenResult *result;
} Listed;

typedef struct Page {
    FileWriter *w;
    const char *title, *ours, *stored;
    const Listed *sorted;
    const GoldenResults *results;
} Page;

// Sorts results that need attention first.
static int rank_of(GoldenStatus status)
{
    static const int ranks[] = {[GOLDEN_FAILED] = 0, [GOLDEN_DIFFERENT] = 1, [GOLDEN_MISSING] = 2,
                                [GOLDEN_STORED] = 3, [GOLDEN_ORPHAN] = 4,    [GOLDEN_ALIKE] = 5};
    return ranks[status];
}

// By rank, then in the order of the results (all are in one array).
static int by_rank(const void *x, const void *y)
{
    const GoldenResult *a = ((const Listed *)x)->result, *b = ((const Listed *)y)->result;
    int ranks = rank_of(a->status) - rank_of(b->status);
    return ranks != 0 ? ranks : (a > b) - (a < b);
}

static bool has_numbers(const GoldenResult *r)
{
    return r->compared && r->comparison.same_size;
}

// ---- summary and table

static void write_sum(const Page *p)
{
    static const GoldenStatus order[] = {GOLDEN_FAILED, GOLDEN_DIFFERENT, GOLDEN_MISSING,
                                         GOLDEN_STORED, GOLDEN_ORPHAN,    GOLDEN_ALIKE};
    const int *counts = p->results->counts;
    const char *separator = "";
    for (size_t i = 0; i < sizeof order / sizeof order[0]; i++) {
        if (counts[order[i]] > 0) {
            file_writer_print(p->w, "%s%d %s", separator, counts[order[i]],
                              golden_status_name(order[i]));
            separator = ", ";
        }
    }
}

static void write_row(const Page *p, const GoldenResult *r, int number)
{
    const char *status = golden_status_name(r->status);
    file_writer_print(p->w,
                      "<tr class=\"%s\"><td><span class=\"tag %s\">%s</span></td><td><a "
                      "href=\"#s%d\">",
                      status, status, status, number);
    markup_text(p->w, r->name);
    file_writer_text(p->w, "</a></td>");
    if (has_numbers(r)) {
        const Comparison *c = &r->comparison;
        file_writer_print(p->w, "<td>%.6g</td><td>%.6g</td><td>", c->difference.rmse,
                          c->difference.maximum);
        if (!c->statistical) {
            file_writer_print(p->w, "%.6g %%", 100.0 * c->difference.failing);
        }
        file_writer_print(p->w, "</td><td>%.6g</td>", c->perceptual);
    } else {
        file_writer_text(p->w, "<td></td><td></td><td></td><td></td>");
    }
    file_writer_print(p->w, "<td>%.2f</td></tr>\n", r->seconds);
}

static void write_rows(const Page *p)
{
    for (int64_t i = 0; i < p->results->count; i++) {
        write_row(p, p->sorted[i].result, (int)i);
    }
}

// ---- section of a picture

static void write_image(const Page *p, const Png *png, int width, int height, const char *class,
                        const char *what, const char *name)
{
    file_writer_print(p->w, "<img class=\"%s\" width=\"%d\" height=\"%d\" alt=\"", class, width,
                      height);
    markup_text(p->w, name);
    file_writer_text(p->w, ", ");
    markup_text(p->w, what);
    file_writer_text(p->w, "\" src=\"data:image/png;base64,");
    markup_base64(p->w, png->bytes, png->size);
    file_writer_text(p->w, "\">");
}

static void write_slider(const Page *p, const GoldenResult *r)
{
    const Comparison *c = &r->comparison;
    file_writer_text(p->w, "<figure><div class=\"frame pair\">");
    write_image(p, &c->stored, c->width, c->height, "stored", p->stored, r->name);
    write_image(p, &c->ours, c->width, c->height, "ours", p->ours, r->name);
    file_writer_text(p->w, "<span class=\"edge\"></span><input type=\"range\" min=\"0\" "
                           "max=\"100\" step=\"0.5\" value=\"50\" aria-label=\"");
    markup_text(p->w, r->name);
    file_writer_text(p->w, ": percentage from the left that shows ");
    markup_text(p->w, p->ours);
    file_writer_text(p->w, "\"></div><figcaption><span>left: ");
    markup_text(p->w, p->ours);
    file_writer_text(p->w, ", right: ");
    markup_text(p->w, p->stored);
    file_writer_text(p->w, "</span><button type=\"button\">Flip</button></figcaption></figure>\n");
}

static void write_plain(const Page *p, const GoldenResult *r, const Png *png, int width, int height,
                        const char *what)
{
    file_writer_text(p->w, "<figure><div class=\"frame\">");
    write_image(p, png, width, height, "plain", what, r->name);
    file_writer_text(p->w, "</div><figcaption><span>");
    markup_text(p->w, what);
    file_writer_text(p->w, "</span></figcaption></figure>\n");
}

static void write_map(const Page *p, const GoldenResult *r)
{
    const Comparison *c = &r->comparison;
    file_writer_text(p->w, "<figure><div class=\"frame\">");
    write_image(p, &c->map, c->width, c->height, "map", "difference", r->name);
    if (!c->statistical && c->difference.maximum > 0.0) {
        file_writer_print(p->w,
                          "<span class=\"spot\" style=\"left:%.3f%%;top:%.3f%%\" title=\"largest "
                          "difference\"></span>",
                          100.0 * (c->difference.worst_x + 0.5) / c->width,
                          100.0 * (c->difference.worst_y + 0.5) / c->height);
    }
    file_writer_print(p->w,
                      "</div><figcaption><span>%s</span><span>−%g<span class=\"heat\"></span>+%g"
                      "</span></figcaption></figure>\n",
                      c->statistical ? "Z of 8 x 8 blocks" : "difference, amplified", c->scale,
                      c->scale);
}

// Initial zoom that fits four pictures into a row: an integer factor if enlarged.
static double fit_of(int width)
{
    int whole = FIT_WIDTH / width;
    return whole >= 1 ? whole : (double)FIT_WIDTH / width;
}

static void write_pictures(const Page *p, const GoldenResult *r)
{
    const Comparison *c = &r->comparison;
    if (!c->ours.bytes) {
        return;
    }
    file_writer_print(p->w, "<div class=\"panels\" style=\"--w:%d;--fit:%.4g\">\n", c->width,
                      fit_of(c->width));
    if (c->map.bytes) {
        write_slider(p, r);
        write_map(p, r);
    }
    write_plain(p, r, &c->ours, c->width, c->height, p->ours);
    if (c->stored.bytes) {
        file_writer_print(p->w, "<div style=\"--w:%d\">", c->stored_width);
        write_plain(p, r, &c->stored, c->stored_width, c->stored_height, p->stored);
        file_writer_text(p->w, "</div>");
    }
    file_writer_text(p->w, "</div>\n");
}

static void write_number(const Page *p, const char *key, const char *name, double value,
                         const char *unit)
{
    file_writer_print(p->w, "<div><dt>%s</dt><dd data-key=\"%s\">", name, key);
    if (isinf(value)) {
        file_writer_text(p->w, "∞");
    } else {
        file_writer_print(p->w, "%.6g", value);
    }
    file_writer_print(p->w, "%s%s</dd></div>", unit[0] ? " " : "", unit);
}

static void write_limit(const Page *p, const char *name, double value, double factor,
                        const char *unit)
{
    if (value >= 0.0) {
        file_writer_print(p->w, "<div><dt>%s</dt><dd><small>%.6g%s%s</small></dd></div>", name,
                          value * factor, unit[0] ? " " : "", unit);
    }
}

static void write_noise(const Page *p, const GoldenResult *r)
{
    const NoiseVerdict *noise = &r->comparison.noise;
    write_number(p, "p", "p, corrected", noise->p, "");
    write_number(p, "alpha", "alpha", r->alpha, "");
    write_number(p, "z", "Z of the worst block", noise->worst.z, "");
    file_writer_print(p->w,
                      "<div><dt>blocks that differ</dt><dd data-key=\"rejected\">%lld <small>of "
                      "%lld</small></dd></div>",
                      (long long)noise->rejected, (long long)noise->tests);
}

static void write_numbers(const Page *p, const GoldenResult *r)
{
    const Comparison *c = &r->comparison;
    const ImageDifference *d = &c->difference;
    file_writer_text(p->w, "<dl>");
    if (c->statistical) {
        write_noise(p, r);
    }
    write_number(p, "rmse", "RMSE", d->rmse, "");
    write_number(p, "maximum", "maximum", d->maximum, "");
    file_writer_print(p->w, "<div><dt>worst pixel</dt><dd data-key=\"worst\">%d, %d</dd></div>",
                      d->worst_x, d->worst_y);
    write_number(p, "mean", "mean", d->mean, "");
    if (!c->statistical) {
        write_number(p, "failing", "pixels over threshold", 100.0 * d->failing, "%");
    }
    write_number(p, "psnr", "PSNR", c->psnr, "dB");
    write_number(p, "perceptual", "perceptual (FLIP)", c->perceptual, "");
    write_limit(p, "RMSE allowed", r->limits.max_rmse, 1.0, "");
    write_limit(p, "threshold", r->limits.threshold, 1.0, "");
    write_limit(p, "share allowed", r->limits.max_failing, 100.0, "%");
    file_writer_print(p->w, "<div><dt>size</dt><dd><small>%d x %d</small></dd></div></dl>\n",
                      c->width, c->height);
}

static void write_section(const Page *p, const GoldenResult *r, int number)
{
    const char *status = golden_status_name(r->status);
    file_writer_print(p->w, "<section id=\"s%d\" class=\"%s\"><h2>", number, status);
    markup_text(p->w, r->name);
    file_writer_print(p->w, "</h2><span class=\"tag %s\">%s</span>\n", status, status);
    if (r->message[0]) {
        file_writer_text(p->w, "<p class=\"why\">");
        markup_text(p->w, r->message);
        file_writer_text(p->w, "</p>\n");
    }
    write_pictures(p, r);
    if (has_numbers(r)) {
        write_numbers(p, r);
    }
    file_writer_text(p->w, "</section>\n");
}

static void write_sections(const Page *p)
{
    for (int64_t i = 0; i < p->results->count; i++) {
        write_section(p, p->sorted[i].result, (int)i);
    }
}

// ---- the page

static void write_title(const Page *p)
{
    markup_text(p->w, p->title);
}

static void write_ours(const Page *p)
{
    markup_text(p->w, p->ours);
}

static void write_style(const Page *p)
{
    file_writer_text(p->w, report_css);
}

static void write_script(const Page *p)
{
    file_writer_text(p->w, report_js);
}

// Placeholders {{name}} in report.html.
static const struct Placeholder {
    const char *name;
    void (*write)(const Page *p);
} PLACEHOLDERS[] = {
    {"{{title}}", write_title},       {"{{ours}}", write_ours}, {"{{style}}", write_style},
    {"{{script}}", write_script},     {"{{sum}}", write_sum},   {"{{rows}}", write_rows},
    {"{{sections}}", write_sections},
};

static void write_page(const Page *p)
{
    const char *text = report_html, *mark;
    while ((mark = strstr(text, "{{"))) {
        file_writer_bytes(p->w, text, (size_t)(mark - text));
        text = mark + 2;
        for (size_t i = 0; i < sizeof PLACEHOLDERS / sizeof PLACEHOLDERS[0]; i++) {
            size_t length = strlen(PLACEHOLDERS[i].name);
            if (strncmp(mark, PLACEHOLDERS[i].name, length) == 0) {
                PLACEHOLDERS[i].write(p);
                text = mark + length;
            }
        }
    }
    file_writer_text(p->w, text);
}

bool report_write(const char *file, const char *title, const char *ours, const char *stored,
                  const GoldenResults *results, Error *e)
{
    Listed *sorted = memory_alloc(results->count, sizeof *sorted, e);
    Page page = {sorted ? file_writer_open(file, e) : NULL, title, ours, stored, sorted, results};
    bool done = page.w;
    if (done) {
        for (int64_t i = 0; i < results->count; i++) {
            sorted[i] = (Listed){&results->item[i]};
        }
        qsort(sorted, (size_t)results->count, sizeof *sorted, by_rank);
        write_page(&page);
        done = file_writer_close(page.w, true, e);
    }
    free(sorted);
    return done;
}
