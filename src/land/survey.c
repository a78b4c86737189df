#include "land/survey.h"

#include "base/memory.h"
#include "base/plugin.h"
#include "land/survey_raster.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static HeightField *make_field(const SurveyHeader *header, Error *e)
{
    Vec2 cell = {(float)header->cell[0], (float)header->cell[1]};
    Vec2 origin = {-0.5f * cell.x * (float)(header->columns - 1),
                   -0.5f * cell.y * (float)(header->rows - 1)};
    return height_field_new(header->columns, header->rows, cell, origin, e);
}

// ---- holes ----

typedef struct Level { // a grid of heights, NaN = none
    int columns, rows;
    float *height;
} Level;

// Mean of the up to four samples below sample i of the next coarser level.
static float mean_below(const Level *fine, const Level *coarse, int64_t i)
{
    float sum = 0.0f, count = 0.0f;
    for (int k = 0; k < 4; k++) {
        int x = 2 * (int)(i % coarse->columns) + k % 2, y = 2 * (int)(i / coarse->columns) + k / 2;
        if (x < fine->columns && y < fine->rows) {
            float height = fine->height[(int64_t)y * fine->columns + x];
            sum += isnan(height) ? 0.0f : height;
            count += isnan(height) ? 0.0f : 1.0f;
        }
    }
    return count > 0.0f ? sum / count : NAN;
}

// The coarser level at sample i of the finer one, bilinearly.
static float height_above(const Level *fine, const Level *coarse, int64_t i)
{
    int64_t at_column = i % fine->columns, at_row = i / fine->columns;
    float x = 0.5f * (float)at_column - 0.25f, y = 0.5f * (float)at_row - 0.25f;
    x = clampf(x, 0.0f, (float)(coarse->columns - 1));
    y = clampf(y, 0.0f, (float)(coarse->rows - 1));
    int column = (int)x, row = (int)y;
    int right = column + 1 < coarse->columns ? 1 : 0;
    int down = row + 1 < coarse->rows ? coarse->columns : 0;
    const float *h = coarse->height + (int64_t)row * coarse->columns + column;
    float u = x - (float)column, v = y - (float)row;
    return lerpf(lerpf(h[0], h[right], u), lerpf(h[down], h[down + right], u), v);
}

// Push and pull (Gortler et al., "The Lumigraph", SIGGRAPH 1996): a hole takes the heights of the
// next coarser level, whose holes are filled first.
static bool fill_holes(Level *fine, Error *e)
{
    int64_t count = (int64_t)fine->columns * fine->rows, holes = 0;
    for (int64_t i = 0; i < count; i++) {
        holes += isnan(fine->height[i]);
    }
    if (holes == 0) {
        return true;
    }
    if (holes == count) {
        return error_set(e, ERROR_INPUT, "no sample has data");
    }
    Level coarse = {(fine->columns + 1) / 2, (fine->rows + 1) / 2, NULL};
    int64_t coarse_count = (int64_t)coarse.columns * coarse.rows;
    coarse.height = memory_alloc(coarse_count, sizeof *coarse.height, e);
    for (int64_t i = 0; coarse.height && i < coarse_count; i++) {
        coarse.height[i] = mean_below(fine, &coarse, i);
    }
    bool done = coarse.height && fill_holes(&coarse, e);
    for (int64_t i = 0; done && i < count; i++) {
        if (isnan(fine->height[i])) {
            fine->height[i] = height_above(fine, &coarse, i);
        }
    }
    free(coarse.height);
    return done;
}

// ---- reading ----

static bool header_is_sound(const SurveyHeader *header, Error *e)
{
    bool sound = header->columns >= 2 && header->rows >= 2 && header->columns <= HEIGHT_FIELD_MAX &&
                 header->rows <= HEIGHT_FIELD_MAX && header->cell[0] > 0.0 &&
                 header->cell[1] > 0.0 && header->cell[0] < 1e6 && header->cell[1] < 1e6;
    return sound || error_set(e, ERROR_INPUT, "a raster of %d x %d samples, %g x %g m apart",
                              header->columns, header->rows, header->cell[0], header->cell[1]);
}

// Reads the place that follows the header.
static bool receive_place(ChildOutput *output, const SurveyHeader *header, HeightField *field,
                          Error *e)
{
    if (header->reference < 0 || header->reference > SURVEY_REFERENCE_MOST) {
        return error_set(e, ERROR_INPUT, "a reference system of %d bytes", header->reference);
    }
    char *reference = memory_alloc_zero((int64_t)header->reference + 1, 1, e);
    if (!reference || !child_read(output, reference, header->reference, 1, e)) {
        free(reference);
        return false;
    }
    bool known = header->placed && isfinite(header->middle[0]) && isfinite(header->middle[1]) &&
                 header->unit[0] > 0.0 && header->unit[1] > 0.0;
    field->place = known ? memory_alloc_zero(1, sizeof *field->place, e) : NULL;
    if (!field->place) {
        free(reference);
        return !known;
    }
    bool named = header->reference > 0;
    *field->place = (GeoPlace){.reference = named ? reference : NULL,
                               .east = header->middle[0],
                               .north = header->middle[1],
                               .unit_x = 1.0 / header->unit[0],
                               .unit_z = 1.0 / header->unit[1]};
    if (!named) {
        free(reference);
    }
    return true;
}

static HeightField *receive(ChildOutput *output, Error *e)
{
    SurveyHeader header;
    if (!child_read(output, &header, 1, sizeof header, e) || !header_is_sound(&header, e)) {
        return NULL;
    }
    HeightField *field = make_field(&header, e);
    if (!field || !receive_place(output, &header, field, e) ||
        !child_read(output, field->height, height_field_count(field), sizeof(float), e) ||
        !fill_holes(&(Level){field->columns, field->rows, field->height}, e)) {
        height_field_free(field);
        return NULL;
    }
    return field;
}

HeightField *survey_read(const char *file, int band, const Run *run, Error *e)
{
    const SurveyCodec *codec = plugin_table(GDAL_PLUGIN, SURVEY_CODEC, sizeof(SurveyCodec), e);
    if (!codec) {
        return NULL;
    }
    if (access(file, R_OK) != 0) {
        error_set(e, ERROR_INPUT, "'%s': %s", file, strerror(errno));
        return NULL;
    }
    codec->start();
    SurveyJob job = {file, band};
    ChildJob child = {.task = codec->read,
                      .data = &job,
                      .file = file,
                      .wanted = "a raster of heights that GDAL reads, such as a GeoTIFF",
                      .seconds = 300.0,
                      .memory = INT64_C(4) << 30};
    ChildOutput output;
    if (!child_run(&child, run, &output, e)) {
        return NULL;
    }
    HeightField *field = receive(&output, e);
    child_output_close(&output);
    if (!field && e->code == ERROR_INPUT) {
        error_prefix(e, "'%s': ", file);
    }
    return field;
}
