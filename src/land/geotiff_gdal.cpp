// GeoTIFF through GDAL 3, encoded in memory. Part of the plug-in ramify-gdal.so.
#include "land/gdal_internal.h"

#include <gdal/cpl_vsi.h>
#include <gdal/ogr_srs_api.h>

#include <cmath>
#include <new>
#include <vector>

extern "C" {
#include "land/geotiff_child.h"
}

namespace
{

const char *const NAME = "/vsimem/land.tif";
const char *const LOCAL = "LOCAL_CS[\"local, in metres\",UNIT[\"metre\",1],"
                          "AXIS[\"x\",EAST],AXIS[\"y\",NORTH]]";

bool give_place(GDALDatasetH set, const HeightField *field)
{
    const GeoPlace *place = field->place;
    double unit_x = place ? place->unit_x : 1.0, unit_z = place ? place->unit_z : 1.0;
    double width = field->cell.x, height = field->cell.y;
    double west = field->origin.x - 0.5 * width, north = field->origin.y - 0.5 * height;
    double transform[6] = {(place ? place->east : 0.0) + west * unit_x,
                           width * unit_x,
                           0.0,
                           (place ? place->north : 0.0) - north * unit_z,
                           0.0,
                           -height * unit_z};
    const char *reference = place && place->reference ? place->reference : LOCAL;
    return GDALSetGeoTransform(set, transform) == CE_None &&
           GDALSetProjection(set, reference) == CE_None;
}

bool give_heights(GDALDatasetH set, const GeoTiffJob *job)
{
    const HeightField *field = job->field;
    GDALRasterBandH band = GDALGetRasterBand(set, 1);
    std::vector<float> line(static_cast<size_t>(field->columns));
    bool done = GDALSetRasterNoDataValue(band, static_cast<double>(job->missing)) == CE_None;
    for (int row = 0; done && row < field->rows; row++) {
        const float *height = field->height + static_cast<int64_t>(row) * field->columns;
        for (int i = 0; i < field->columns; i++) {
            line[static_cast<size_t>(i)] = std::isfinite(height[i]) ? height[i] : job->missing;
        }
        done = GDALRasterIO(band, GF_Write, 0, row, field->columns, 1, line.data(), field->columns,
                            1, GDT_Float32, 0, 0) == CE_None;
    }
    return done;
}

bool encode(const GeoTiffJob *job, Error *e)
{
    GDALDriverH driver = GDALGetDriverByName("GTiff");
    const char *const options[] = {"COMPRESS=DEFLATE", "PREDICTOR=3", nullptr};
    gdal::Dataset set(driver ? GDALCreate(driver, NAME, job->field->columns, job->field->rows, 1,
                                          GDT_Float32, const_cast<char **>(options))
                             : nullptr);
    if (!set || !give_place(set.get(), job->field) || !give_heights(set.get(), job)) {
        return gdal::fail(e, ERROR_IO, "GDAL cannot encode it");
    }
    CPLErrorReset();
    set.reset();
    return CPLGetLastErrorType() < CE_Failure || gdal::fail(e, ERROR_IO, "GDAL cannot complete it");
}

bool write_job(const void *data, ChildOutput *output, Error *e)
{
    try {
        vsi_l_offset size = 0;
        if (!encode(static_cast<const GeoTiffJob *>(data), e)) {
            return false;
        }
        const GByte *bytes = VSIGetMemFileBuffer(NAME, &size, FALSE);
        return bytes ? child_write(output, bytes, static_cast<int64_t>(size), 1, e)
                     : gdal::fail(e, ERROR_IO, "GDAL has encoded nothing");
    } catch (const std::bad_alloc &) {
        return error_set(e, ERROR_MEMORY, "out of memory for a GeoTIFF");
    } catch (...) {
        return error_set(e, ERROR_IO, "GDAL failed");
    }
}

} // namespace

extern "C" {
extern const GeoTiffCodec geotiff_codec_gdal;
const GeoTiffCodec geotiff_codec_gdal = {sizeof(GeoTiffCodec), gdal::start, write_job};
}
