// Height fields as pictures and Esri ASCII grids. One goes to FILE, several to FILE-OBJECT.
#include "export/heights.h"

#include "base/file_name.h"
#include "base/file_writer.h"
#include "base/number_text.h"
#include "export/asset_path.h"
#include "export/formats.h"
#include "image/image.h"
#include "land/geotiff.h"

#include <stdio.h>
#include <stdlib.h>

// Key and value pairs for image.h; ends with an empty key.
static void describe_field(const HeightField *field, float low, float high, char *text, size_t size)
{
    const struct {
        const char *key;
        float value;
    } pairs[] = {{"ramify:low", low}, {"ramify:high", high}, {"ramify:cell", field->cell.x}};
    size_t used = 0;
    for (int i = 0; i < 3 && used + 64 < size; i++) {
        used += (size_t)snprintf(text + used, size - used, "%s", pairs[i].key) + 1;
        used += (size_t)snprintf(text + used, size - used, "%.9g", (double)pairs[i].value) + 1;
    }
    text[used] = '\0';
}

static bool write_picture(const HeightField *field, const char *file, Error *e)
{
    float low, high;
    char metadata[256];
    height_field_range(field, &low, &high);
    describe_field(field, low, high, metadata, sizeof metadata);
    if (file_name_ends(file, ".exr")) {
        Image image = {field->columns, field->rows, 1, field->height};
        ImageLayer layer = {"", "Y", &image};
        return image_write_exr(file, &layer, 1, metadata, e);
    }
    Image *scaled = image_new(field->columns, field->rows, 1, e);
    if (!scaled) {
        return false;
    }
    float scale = high > low ? 1.0f / (high - low) : 0.0f;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        float h = field->height[i];
        scaled->pixel[i] = isfinite(h) ? (h - low) * scale : 0.0f;
    }
    bool done = image_write_grey16(file, scaled, metadata, e);
    image_free(scaled);
    return done;
}

static void write_row(FileWriter *out, const float *height, int columns)
{
    for (int i = 0; i < columns; i++) {
        char text[FLOAT_TEXT_MOST + 1], *end = float_text(text, height[i]);
        if (!isfinite(height[i])) {
            end = text + snprintf(text, sizeof text, "-9999");
        }
        *end++ = i + 1 < columns ? ' ' : '\n';
        file_writer_bytes(out, text, (size_t)(end - text));
    }
}

// North is -z, so the land seen from above looks as on a map.
static bool write_asc(const HeightField *field, const char *file, Error *e)
{
    FileWriter *out = file_writer_open(file, e);
    if (!out) {
        return false;
    }
    double dx = (double)field->cell.x, dz = (double)field->cell.y;
    double south = (double)field->origin.y + dz * ((double)field->rows - 0.5);
    file_writer_print(out, "ncols %d\nnrows %d\n", field->columns, field->rows);
    file_writer_print(out, "xllcorner %.9g\nyllcorner %.9g\n", (double)field->origin.x - 0.5 * dx,
                      -south);
    if (dx == dz) {
        file_writer_print(out, "cellsize %.9g\n", dx);
    } else {
        file_writer_print(out, "dx %.9g\ndy %.9g\n", dx, dz);
    }
    file_writer_text(out, "NODATA_value -9999\n");
    for (int row = 0; row < field->rows; row++) {
        write_row(out, field->height + (int64_t)row * field->columns, field->columns);
    }
    return file_writer_close(out, true, e);
}

bool export_height_field(const HeightField *field, const char *file, const Run *run, Error *e)
{
    if (file_name_ends(file, ".asc")) {
        return write_asc(field, file, e);
    }
    if (file_name_ends(file, ".png") || file_name_ends(file, ".exr")) {
        return write_picture(field, file, e);
    }
    if (file_name_ends(file, ".tif")) {
        return geotiff_write(field, file, run, e);
    }
    return error_set(e, ERROR_INPUT, "heights in '%s'; its ending must be .png, .exr, .asc or .tif",
                     file);
}

static bool write(const ExportSource *source, const char *file, const Run *run, Error *e)
{
    int count = 0;
    for (int i = 0; i < source->object_count; i++) {
        count += source->land[i] != NULL;
    }
    bool done =
        count > 0 || error_set(e, ERROR_INPUT, "no object of '%s' is land; heights need a terrain",
                               source->title);
    for (int i = 0; done && i < source->object_count; i++) {
        if (source->land[i] && run_is_cancelled(run)) {
            done = run_cancel_error(e);
        } else if (source->land[i]) {
            char *own = count == 1 ? NULL : asset_of_object(file, source->object_name[i], e);
            done = (count == 1 || own) &&
                   export_height_field(source->land[i], own ? own : file, run, e);
            free(own);
        }
    }
    return done;
}

const ExportFormat asc_format = {".asc", "heights of land, Esri ASCII grid", 0, EXPORT_LAND, write};
const ExportFormat exr_format = {".exr", "heights of land, float picture", 0, EXPORT_LAND, write};
const ExportFormat png_format = {".png", "heights of land, 16-bit picture", 0, EXPORT_LAND, write};
const ExportFormat tif_format = {".tif", "heights of land, GeoTIFF", 0, EXPORT_LAND, write};
