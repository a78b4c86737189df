#include "cli/fit_report.h"

#include "base/json.h"
#include "base/key_path.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { LEAST_COLUMN = 10, MOST_COLUMN = 20 };

// ---- the table

static int column_width(const char *title)
{
    int length = (int)strlen(title);
    return length < LEAST_COLUMN ? LEAST_COLUMN : (length > MOST_COLUMN ? MOST_COLUMN : length);
}

static void print_title(const char *title)
{
    printf("  %*.*s", column_width(title), MOST_COLUMN, title);
}

static void print_value(const char *title, double value)
{
    if (isfinite(value)) {
        printf("  %*.6g", column_width(title), value);
    } else {
        printf("  %*s", column_width(title), "-");
    }
}

static RamifyTarget target_at(const FitReport *report, int index)
{
    RamifyTarget target;
    ramify_scene_target(report->scene, index, &target);
    return target;
}

static void print_head(const FitReport *report)
{
    for (int i = 0; i < report->range_count; i++) {
        const RamifyRange *range = &report->ranges[i];
        printf("vary    %s in %.9g .. %.9g%s\n", range->path, range->low, range->high,
               range->logarithmic ? ", logarithmic" : "");
    }
    for (int i = 0; i < report->target_count; i++) {
        RamifyTarget target = target_at(report, i);
        printf("target  %s %s in %.9g .. %.9g\n", target.object, target.measure, target.low,
               target.high);
    }
    printf("   no     misfit");
    for (int i = 0; i < report->range_count; i++) {
        print_title(key_path_end(report->ranges[i].path));
    }
    for (int i = 0; i < report->target_count; i++) {
        print_title(target_at(report, i).measure);
    }
    printf("\n");
}

static void print_line(const FitReport *report, const RamifyFit *fit, int index, bool best)
{
    RamifyEvaluation step;
    ramify_fit_evaluation(fit, index, &step);
    printf("%c%4d", best ? '*' : ' ', index + 1);
    print_value("", step.misfit);
    for (int i = 0; i < report->range_count; i++) {
        print_value(key_path_end(report->ranges[i].path), step.parameters[i]);
    }
    for (int i = 0; !step.failure && i < report->target_count; i++) {
        print_value(target_at(report, i).measure, step.measures[i]);
    }
    printf("%s%s\n", step.failure ? "  " : "", step.failure ? step.failure : "");
}

void fit_report_last(const FitReport *report, const RamifyFit *fit)
{
    RamifyFitInfo info;
    ramify_fit_info(fit, &info);
    if (info.evaluation_count == 1) {
        print_head(report);
    }
    print_line(report, fit, info.evaluation_count - 1, info.best == info.evaluation_count - 1);
    fflush(stdout);
}

void fit_report_best(const FitReport *report, const RamifyFit *fit)
{
    RamifyFitInfo info;
    RamifyEvaluation best;
    ramify_fit_info(fit, &info);
    ramify_fit_evaluation(fit, info.best, &best);
    printf("best    evaluation %d, misfit %.6g:", info.best + 1, best.misfit);
    for (int i = 0; i < report->range_count; i++) {
        printf(" --set %s=%.9g", report->ranges[i].path, best.parameters[i]);
    }
    printf("\n");
}

// ---- JSON

static void print_json_numbers(const char *key, const double *value, int count)
{
    printf("\"%s\": [", key);
    for (int i = 0; i < count; i++) {
        printf("%s", i > 0 ? ", " : "");
        json_put_number(stdout, value[i], 9);
    }
    printf("]");
}

static void print_json_terms(const FitReport *report, const RamifyEvaluation *best)
{
    printf("\"parameters\": [");
    for (int i = 0; i < report->range_count; i++) {
        const RamifyRange *range = &report->ranges[i];
        printf("%s\n  {\"path\": ", i > 0 ? "," : "");
        json_put_string(stdout, range->path);
        printf(", \"low\": %.9g, \"high\": %.9g, \"value\": %.9g}", range->low, range->high,
               best->parameters[i]);
    }
    printf("],\n\"targets\": [");
    for (int i = 0; i < report->target_count; i++) {
        RamifyTarget target = target_at(report, i);
        double value = best->measures[i];
        printf("%s\n  {\"object\": ", i > 0 ? "," : "");
        json_put_string(stdout, target.object);
        printf(", \"measure\": ");
        json_put_string(stdout, target.measure);
        printf(", \"low\": ");
        json_put_number(stdout, target.low, 9);
        printf(", \"high\": ");
        json_put_number(stdout, target.high, 9);
        printf(", \"value\": ");
        json_put_number(stdout, value, 9);
        printf(", \"met\": %s}", value >= target.low && value <= target.high ? "true" : "false");
    }
    printf("]");
}

void fit_report_json(const FitReport *report, const RamifyFit *fit)
{
    RamifyFitInfo info;
    RamifyEvaluation step;
    ramify_fit_info(fit, &info);
    ramify_fit_evaluation(fit, info.best, &step);
    printf("{\"met\": %s, \"best\": %d,\n", info.met ? "true" : "false", info.best + 1);
    print_json_terms(report, &step);
    printf(",\n\"evaluations\": [");
    for (int i = 0; i < info.evaluation_count; i++) {
        ramify_fit_evaluation(fit, i, &step);
        printf("%s\n  {\"misfit\": ", i > 0 ? "," : "");
        json_put_number(stdout, step.misfit, 9);
        printf(", ");
        print_json_numbers("parameters", step.parameters, report->range_count);
        printf(", ");
        print_json_numbers("measures", step.measures, report->target_count);
        if (step.failure) {
            printf(", \"failure\": ");
            json_put_string(stdout, step.failure);
        }
        printf("}");
    }
    printf("]}\n");
}
