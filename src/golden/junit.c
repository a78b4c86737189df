#include "golden/junit.h"

#include "base/markup.h"

static void attribute(FileWriter *w, const char *name, const char *text)
{
    file_writer_print(w, " %s=\"", name);
    markup_text(w, text);
    file_writer_text(w, "\"");
}

static void problem(FileWriter *w, const char *element, const GoldenResult *result)
{
    file_writer_print(w, "    <%s", element);
    attribute(w, "type", golden_status_name(result->status));
    attribute(w, "message", result->message);
    file_writer_text(w, ">");
    markup_text(w, result->message);
    if (result->compared && result->comparison.same_size) {
        const Comparison *c = &result->comparison;
        file_writer_print(w,
                          "\nRMSE %.6g, maximum %.6g at (%d, %d), %.6g %% of the pixels over "
                          "%.6g, perceptual %.6g",
                          c->difference.rmse, c->difference.maximum, c->difference.worst_x,
                          c->difference.worst_y, 100.0 * c->difference.failing,
                          result->limits.threshold > 0.0 ? result->limits.threshold : 0.0,
                          c->perceptual);
    }
    file_writer_print(w, "</%s>\n", element);
}

static void test_case(FileWriter *w, const char *suite, const GoldenResult *result)
{
    file_writer_text(w, "  <testcase");
    attribute(w, "classname", suite);
    attribute(w, "name", result->name);
    file_writer_print(w, " time=\"%.3f\">\n", result->seconds);
    switch (result->status) {
    case GOLDEN_DIFFERENT:
    case GOLDEN_MISSING:
        problem(w, "failure", result);
        break;
    case GOLDEN_FAILED:
        problem(w, "error", result);
        break;
    default:
        break;
    }
    file_writer_text(w, "  </testcase>\n");
}

static void orphans(FileWriter *w, const GoldenResults *results)
{
    if (results->counts[GOLDEN_ORPHAN] == 0) {
        return;
    }
    file_writer_text(w, "  <system-out>");
    for (int64_t i = 0; i < results->count; i++) {
        if (results->item[i].status == GOLDEN_ORPHAN) {
            markup_text(w, results->item[i].name);
            file_writer_print(w, ": %s\n", results->item[i].message);
        }
    }
    file_writer_text(w, "</system-out>\n");
}

bool junit_write(const char *file, const char *suite, const GoldenResults *results, Error *e)
{
    FileWriter *w = file_writer_open(file, e);
    if (!w) {
        return false;
    }
    double seconds = 0.0;
    for (int64_t i = 0; i < results->count; i++) {
        seconds += results->item[i].seconds;
    }
    const int *counts = results->counts;
    file_writer_text(w, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n<testsuite");
    attribute(w, "name", suite);
    file_writer_print(
        w, " tests=\"%lld\" failures=\"%d\" errors=\"%d\" skipped=\"0\" time=\"%.3f\">\n",
        (long long)results->count - counts[GOLDEN_ORPHAN],
        counts[GOLDEN_DIFFERENT] + counts[GOLDEN_MISSING], counts[GOLDEN_FAILED], seconds);
    for (int64_t i = 0; i < results->count; i++) {
        if (results->item[i].status != GOLDEN_ORPHAN) {
            test_case(w, suite, &results->item[i]);
        }
    }
    orphans(w, results);
    file_writer_text(w, "</testsuite>\n</testsuites>\n");
    return file_writer_close(w, true, e);
}
