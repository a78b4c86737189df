// Rasters of heights through GDAL 3. Part of the plug-in ramify-gdal.so.
#include "land/gdal_internal.h"

#include <gdal/cpl_conv.h>
#include <gdal/ogr_srs_api.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <string>
#include <vector>

extern "C" {
#include "base/exact_math.h"
#include "land/height_field.h"
#include "land/survey_raster.h"
}

namespace
{

const double PI = 3.14159265358979323846;

// Metres of a degree of longitude and of latitude on the ellipsoid WGS 84.
void degree_lengths(double latitude, double length[2])
{
    const double a = 6378137.0, e2 = 0.00669437999014, radian = PI / 180.0;
    double s, c;
    exact_sincos_double(latitude * radian, &s, &c);
    double w = std::sqrt(1.0 - e2 * s * s);
    length[0] = radian * a / w * c;
    length[1] = radian * a * (1.0 - e2) / (w * w * w);
}

// Without a spatial reference: small numbers are degrees.
bool is_in_degrees(GDALDatasetH set, const double place[6])
{
    OGRSpatialReferenceH reference = GDALGetSpatialRef(set);
    if (reference) {
        return OSRIsGeographic(reference);
    }
    return std::fabs(place[0]) <= 360.0 && std::fabs(place[3]) <= 90.0 && std::fabs(place[1]) < 0.2;
}

// Metres between samples to the east and to the south, and whether the first row is the southern.
bool find_cells(GDALDatasetH set, SurveyHeader &header, bool *upward, Error *e)
{
    double place[6] = {0.0, 1.0, 0.0, 0.0, 0.0, -1.0};
    bool placed = GDALGetGeoTransform(set, place) == CE_None;
    if (place[2] != 0.0 || place[4] != 0.0) {
        return error_set(e, ERROR_INPUT,
                         "its rows do not run from west to east; warp it north up first "
                         "(gdalwarp)");
    }
    double unit[2] = {1.0, 1.0};
    if (placed && is_in_degrees(set, place)) {
        degree_lengths(place[3] + 0.5 * place[5] * GDALGetRasterYSize(set), unit);
    } else if (placed && GDALGetSpatialRef(set)) {
        unit[0] = unit[1] = OSRGetLinearUnits(GDALGetSpatialRef(set), nullptr);
    }
    *upward = place[5] > 0.0;
    header.placed = placed;
    for (int i = 0; i < 2; i++) {
        double step = i == 0 ? place[1] : place[5];
        int count = i == 0 ? GDALGetRasterXSize(set) : GDALGetRasterYSize(set);
        header.cell[i] = std::fabs(step) * unit[i];
        header.middle[i] = place[3 * i] + 0.5 * step * count;
        header.unit[i] = unit[i];
    }
    return true;
}

// Metres of a unit of heights, by the name that the file gives it.
double height_unit(GDALRasterBandH band)
{
    const char *name = GDALGetRasterUnitType(band);
    bool feet =
        name && (EQUALN(name, "ft", 2) || EQUALN(name, "feet", 4) || EQUALN(name, "foot", 4));
    bool survey_feet = name && (EQUAL(name, "us-ft") || EQUALN(name, "US survey", 9));
    return survey_feet ? 1200.0 / 3937.0 : (feet ? 0.3048 : 1.0);
}

void convert(GDALRasterBandH band, std::vector<float> &height)
{
    int has_missing = 0, given = 0;
    double missing = GDALGetRasterNoDataValue(band, &has_missing);
    double scale = GDALGetRasterScale(band, &given), unit = height_unit(band);
    double offset = GDALGetRasterOffset(band, &given);
    for (float &h : height) {
        bool none = !std::isfinite(h) || (has_missing && h == static_cast<float>(missing));
        h = none ? std::numeric_limits<float>::quiet_NaN()
                 : static_cast<float>((h * scale + offset) * unit);
    }
}

bool read_heights(GDALRasterBandH band, const SurveyHeader &header, std::vector<float> &height,
                  Error *e)
{
    GDALRasterIOExtraArg options;
    INIT_RASTERIO_EXTRA_ARG(options);
    options.eResampleAlg = GRIORA_Average;
    height.resize(static_cast<size_t>(header.columns) * static_cast<size_t>(header.rows));
    if (GDALRasterIOEx(band, GF_Read, 0, 0, GDALGetRasterBandXSize(band),
                       GDALGetRasterBandYSize(band), height.data(), header.columns, header.rows,
                       GDT_Float32, 0, 0, &options) != CE_None) {
        return gdal::fail(e, ERROR_INPUT, "its heights cannot be read");
    }
    convert(band, height);
    return true;
}

// The reference system as WKT; empty where the file has none.
std::string reference_of(GDALDatasetH set)
{
    OGRSpatialReferenceH reference = GDALGetSpatialRef(set);
    char *text = nullptr;
    std::string wkt;
    if (reference && OSRExportToWkt(reference, &text) == OGRERR_NONE && text) {
        wkt = text;
    }
    CPLFree(text);
    return wkt.size() <= SURVEY_REFERENCE_MOST ? wkt : std::string();
}

bool send(ChildOutput *output, const SurveyHeader &header, const std::string &reference,
          const std::vector<float> &height, bool upward, Error *e)
{
    bool done = child_write(output, &header, 1, sizeof header, e) &&
                child_write(output, reference.data(), header.reference, 1, e);
    for (int row = 0; done && row < header.rows; row++) {
        int from = upward ? header.rows - 1 - row : row;
        const float *line =
            height.data() + static_cast<size_t>(from) * static_cast<size_t>(header.columns);
        done = child_write(output, line, header.columns, sizeof *line, e);
    }
    return done;
}

bool read_raster(const SurveyJob *job, ChildOutput *output, Error *e)
{
    gdal::Dataset set(
        GDALOpenEx(job->file, GDAL_OF_RASTER | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
    if (!set) {
        return gdal::fail(e, ERROR_INPUT, "GDAL knows no raster in it");
    }
    int bands = GDALGetRasterCount(set.get());
    if (job->band > bands) {
        return error_set(e, ERROR_INPUT, "it has %d band%s, not %d", bands, bands == 1 ? "" : "s",
                         job->band);
    }
    SurveyHeader header = {};
    bool upward = false;
    if (!find_cells(set.get(), header, &upward, e)) {
        return false;
    }
    int columns = GDALGetRasterXSize(set.get()), rows = GDALGetRasterYSize(set.get());
    header.columns = std::min<int>(columns, HEIGHT_FIELD_MAX);
    header.rows = std::min<int>(rows, HEIGHT_FIELD_MAX);
    header.cell[0] *= static_cast<double>(columns) / header.columns;
    header.cell[1] *= static_cast<double>(rows) / header.rows;
    std::string reference = reference_of(set.get());
    header.reference = static_cast<int32_t>(reference.size());
    std::vector<float> height;
    return read_heights(GDALGetRasterBand(set.get(), job->band), header, height, e) &&
           send(output, header, reference, height, upward, e);
}

bool read_job(const void *data, ChildOutput *output, Error *e)
{
    try {
        return read_raster(static_cast<const SurveyJob *>(data), output, e);
    } catch (const std::bad_alloc &) {
        return error_set(e, ERROR_MEMORY, "out of memory for its heights");
    } catch (...) {
        return error_set(e, ERROR_INPUT, "GDAL failed");
    }
}

} // namespace

extern "C" {
extern const SurveyCodec survey_codec_gdal;
const SurveyCodec survey_codec_gdal = {sizeof(SurveyCodec), gdal::start, read_job};
}
