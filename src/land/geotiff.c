#include "land/geotiff.h"

#include "base/file_writer.h"
#include "base/plugin.h"
#include "land/geotiff_child.h"
#include "land/survey_raster.h"

// Copies what the child has encoded into the file.
static bool write_file(ChildOutput *output, const char *file, Error *e)
{
    FileWriter *out = file_writer_open(file, e);
    bool done = out;
    while (done && output->left > 0) {
        char block[4096];
        int64_t count = output->left < (int64_t)sizeof block ? output->left : (int64_t)sizeof block;
        done = child_read(output, block, count, 1, e);
        if (done) {
            file_writer_bytes(out, block, (size_t)count);
        }
    }
    return file_writer_close(out, done, e) && done;
}

bool geotiff_write(const HeightField *field, const char *file, const Run *run, Error *e)
{
    const GeoTiffCodec *codec = plugin_table(GDAL_PLUGIN, GEOTIFF_CODEC, sizeof(GeoTiffCodec), e);
    if (!codec) {
        return false;
    }
    codec->start();
    GeoTiffJob job = {field, GEOTIFF_MISSING};
    ChildJob child = {.task = codec->write,
                      .data = &job,
                      .file = file,
                      .worker = "writer",
                      .wanted = "a height field that GDAL encodes",
                      .seconds = 300.0,
                      .memory = (INT64_C(1) << 30) + 16 * height_field_count(field)};
    ChildOutput output;
    if (!child_run(&child, run, &output, e)) {
        return false;
    }
    bool done = write_file(&output, file, e);
    child_output_close(&output);
    return done;
}
