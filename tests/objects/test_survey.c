// Land from surveyed rasters: places and units against closed forms, holes, rivers, bad files.
#include "land/geotiff.h"
#include "land/height_measure.h"
#include "land/survey.h"
#include "making.h"
#include "objects/terrain/terrain.h"
#include "testing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/ramify-survey-XXXXXX";
static char asc_file[64], vrt_file[64];

static int make_folder(void **state)
{
    (void)state;
    if (!mkdtemp(folder)) {
        return -1;
    }
    snprintf(asc_file, sizeof asc_file, "%s/land.asc", folder);
    snprintf(vrt_file, sizeof vrt_file, "%s/land.vrt", folder);
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    unlink(asc_file);
    unlink(vrt_file);
    return rmdir(folder);
}

typedef float HeightAt(int column, int row);

static void write_asc(int columns, int rows, double x, double y, double cell, HeightAt *height)
{
    FILE *file = fopen(asc_file, "w");
    assert_non_null(file);
    fprintf(file, "ncols %d\nnrows %d\nxllcorner %.9f\nyllcorner %.9f\ncellsize %.9f\n", columns,
            rows, x, y, cell);
    fprintf(file, "NODATA_value -9999\n");
    for (int i = 0; i < columns * rows; i++) {
        fprintf(file, "%.4f ", (double)height(i % columns, i / columns));
    }
    assert_int_equal(fclose(file), 0);
}

// Another look at the same file: GDAL's virtual raster.
static void write_vrt(int columns, int rows, const char *transform, const char *unit)
{
    FILE *file = fopen(vrt_file, "w");
    assert_non_null(file);
    fprintf(file,
            "<VRTDataset rasterXSize=\"%d\" rasterYSize=\"%d\"><GeoTransform>%s</GeoTransform>"
            "<VRTRasterBand dataType=\"Float32\" band=\"1\"><UnitType>%s</UnitType>"
            "<SimpleSource><SourceFilename relativeToVRT=\"1\">land.asc</SourceFilename>"
            "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>",
            columns, rows, transform, unit);
    assert_int_equal(fclose(file), 0);
}

static HeightField *read_band(const char *file, int band, Error *e)
{
    Run run = run_default();
    return survey_read(file, band, &run, e);
}

static HeightField *read_sound(const char *file)
{
    Error e = {0};
    HeightField *field = read_band(file, 1, &e);
    if (!field) {
        fail_msg("%s", e.message);
    }
    return field;
}

static float ramp(int column, int row)
{
    return (float)column + 100.0f * (float)row;
}

static void assert_near(float value, double wanted, double tolerance)
{
    if (!(fabs((double)value - wanted) <= tolerance)) {
        fail_msg("%.9g, not %.9g +- %g", (double)value, wanted, tolerance);
    }
}

// Metres stay metres; rows run from north to south; the field is centred.
static void metres_stay_metres(void **state)
{
    (void)state;
    write_asc(30, 20, 500000.0, 4000000.0, 25.0, ramp);
    HeightField *field = read_sound(asc_file);
    assert_int_equal(field->columns, 30);
    assert_int_equal(field->rows, 20);
    assert_near(field->cell.x, 25.0, 1e-4);
    assert_near(field->cell.y, 25.0, 1e-4);
    assert_near(field->origin.x, -0.5 * 29 * 25, 1e-3);
    assert_near(field->origin.y, -0.5 * 19 * 25, 1e-3);
    assert_near(field->height[30 * 7 + 4], 704.0, 1e-3);
    height_field_free(field);
}

static void assert_same_place(const HeightField *a, const HeightField *b)
{
    assert_true(a->columns == b->columns && a->rows == b->rows);
    assert_near(a->cell.x, (double)b->cell.x, 1e-5 * (double)b->cell.x);
    assert_near(a->cell.y, (double)b->cell.y, 1e-5 * (double)b->cell.y);
    assert_non_null(a->place);
    assert_non_null(b->place);
    assert_true(fabs(a->place->east - b->place->east) < 1e-6 * fabs(b->place->east));
    assert_true(fabs(a->place->north - b->place->north) < 1e-6 * fabs(b->place->north));
    assert_true(fabs(a->place->unit_x / b->place->unit_x - 1.0) < 1e-6);
    assert_true(fabs(a->place->unit_z / b->place->unit_z - 1.0) < 1e-6);
}

// What is read and written as a GeoTIFF has the same heights, and in metres the same place.
static void a_geotiff_keeps_heights_and_place(void **state)
{
    (void)state;
    const double corners[2][3] = {{500000.0, 4000000.0, 25.0}, {7.5, 46.5, 0.001}};
    char tif_file[64];
    snprintf(tif_file, sizeof tif_file, "%s/land.tif", folder);
    for (int k = 0; k < 2; k++) {
        write_asc(30, 20, corners[k][0], corners[k][1], corners[k][2], ramp);
        HeightField *field = read_sound(asc_file);
        double east = corners[k][0] + 15.0 * corners[k][2];
        assert_true(fabs(field->place->east - east) < 1e-6 * east);
        Run run = run_default();
        Error e = {0};
        if (!geotiff_write(field, tif_file, &run, &e)) {
            fail_msg("%s", e.message);
        }
        HeightField *again = read_sound(tif_file);
        if (k == 0) { // the local system that degrees without a system get is one of metres
            assert_same_place(again, field);
        }
        assert_memory_equal(again->height, field->height, 30 * 20 * sizeof(float));
        height_field_free(again);
        height_field_free(field);
    }
    unlink(tif_file);
}

// Lengths of a degree at 46.5 degrees north, by the usual series in cosines of the latitude:
// 111412.84 cos p - 93.5 cos 3p + 0.118 cos 5p and 111132.92 - 559.82 cos 2p + 1.175 cos 4p.
static void degrees_become_metres(void **state)
{
    (void)state;
    write_asc(60, 60, 8.0, 46.475, 1.0 / 1200, ramp);
    HeightField *field = read_sound(asc_file);
    assert_near(field->cell.x, 76762.5 / 1200, 0.02);
    assert_near(field->cell.y, 111161.0 / 1200, 0.02);
    height_field_free(field);
}

static void other_rows_and_units_are_understood(void **state)
{
    (void)state;
    write_asc(10, 8, 500000.0, 4000000.0, 25.0, ramp);
    write_vrt(10, 8, "500000, 25, 0, 4000000, 0, 25", "ft"); // the first row is the southern
    HeightField *field = read_sound(vrt_file);
    assert_near(field->height[0], 700.0 * 0.3048, 1e-3);
    assert_near(field->height[7 * 10 + 9], 9.0 * 0.3048, 1e-3);
    height_field_free(field);
}

static float slope_with_hole(int column, int row)
{
    bool hole = column > 10 && column < 19 && row > 5 && row < 15;
    return hole ? -9999.0f : 3.0f * (float)column + 2.0f * (float)row;
}

// A hole in an even slope is filled nearly evenly, and nothing else changes.
static void holes_are_filled_from_around(void **state)
{
    (void)state;
    write_asc(30, 20, 500000.0, 4000000.0, 25.0, slope_with_hole);
    HeightField *field = read_sound(asc_file);
    for (int i = 0; i < 30 * 20; i++) {
        double wanted = 3.0 * (i % 30) + 2.0 * (double)(i / 30);
        bool hole = slope_with_hole(i % 30, i / 30) < 0.0f;
        assert_near(field->height[i], wanted, hole ? 9.0 : 1e-3);
    }
    height_field_free(field);
}

static void assert_refused(const char *file, int band, const char *why)
{
    Error e = {0};
    HeightField *field = read_band(file, band, &e);
    assert_null(field);
    assert_int_equal(e.code, ERROR_INPUT);
    char text[1024];
    error_format(&e, text, sizeof text);
    if (!strstr(text, why) || !strstr(text, file)) {
        fail_msg("'%s' does not name %s and '%s'", text, file, why);
    }
}

static float nothing(int column, int row)
{
    (void)column;
    (void)row;
    return -9999.0f;
}

static void bad_rasters_are_refused(void **state)
{
    (void)state;
    assert_refused("/tmp/ramify-no-such-file.tif", 1, "No such file");
    write_asc(10, 8, 0.0, 0.0, 25.0, ramp);
    assert_refused(asc_file, 2, "it has 1 band, not 2");
    write_vrt(10, 8, "0, 25, 3, 0, 3, -25", "m");
    assert_refused(vrt_file, 1, "north up");
    write_asc(10, 8, 0.0, 0.0, 25.0, nothing);
    assert_refused(asc_file, 1, "no sample has data");
    FILE *file = fopen(asc_file, "w");
    assert_non_null(file);
    fputs("these are words\n", file);
    fclose(file);
    assert_refused(asc_file, 1, "GDAL");
}

// ---- as terrain ----

// A valley along the middle column that falls to the south.
static float valley(int column, int row)
{
    return 2.0f * fabsf((float)column - 40.0f) + 0.5f * (80.0f - (float)row) + 300.0f;
}

static TerrainParams surveyed(float size)
{
    TerrainParams params = terrain_params_default();
    params.form = TERRAIN_SURVEY;
    params.size = size;
    params.resolution = 128;
    params.rivers.count = 40;
    params.rivers.water = 0.01f;
    params.survey.file = asc_file;
    params.noise.iterations = 0;
    return params;
}

// Of the valley of 1600 m. False and e when refused.
static bool grow_valley(const TerrainParams *params, Grown *grown, Error *e)
{
    write_asc(81, 81, 500000.0, 4000000.0, 20.0, valley);
    Run run = run_default();
    Recipe recipe = {.seed = 5, .label = "land", .run = &run};
    return kind_grow(&kind_terrain, params, &recipe, 1.0f, NULL, grown, e);
}

static void a_surveyed_valley_gets_its_river(void **state)
{
    (void)state;
    TerrainParams params = surveyed(1280.0f);
    Error e = {0};
    Run run = run_default();
    Grown grown;
    if (!grow_valley(&params, &grown, &e)) {
        fail_msg("%s", e.message);
    }
    int64_t widest = 0;
    for (int64_t i = 0; i < grown.tree->count; i++) {
        widest = grown.tree->radius[i] > grown.tree->radius[widest] ? i : widest;
    }
    Vec3 mouth = grown.tree->position[widest]; // drains all the square, at its southern rim
    assert_near(mouth.x, 0.0, 25.0);
    assert_near(mouth.z, 640.0, 25.0);
    assert_near(grown.tree->radius[widest], 0.01 * 1280.0, 0.01 * 128.0);
    HeightField *field = terrain_heights(&params, &grown, &run, &e);
    assert_non_null(field);
    float low, high;
    height_field_range(field, &low, &high);
    assert_near(high - low, 64.0 + 32.0, 9.0); // and a bed
    assert_near(height_field_at(field, 400.0f, 0.0f) - height_field_at(field, 200.0f, 0.0f), 20.0,
                1.0);
    assert_int_equal(height_field_pits(field), 0);
    height_field_free(field);
    grown_clear(&grown);
}

static void a_square_beyond_the_raster_is_refused(void **state)
{
    (void)state;
    TerrainParams params = surveyed(1700.0f);
    Error e = {0};
    Grown grown;
    assert_false(grow_valley(&params, &grown, &e));
    assert_non_null(strstr(e.message, "covers 1600 x 1600 m; a square of 1700 m"));
    grown_clear(&grown);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(metres_stay_metres),
        cmocka_unit_test(a_geotiff_keeps_heights_and_place),
        cmocka_unit_test(degrees_become_metres),
        cmocka_unit_test(other_rows_and_units_are_understood),
        cmocka_unit_test(holes_are_filled_from_around),
        cmocka_unit_test(bad_rasters_are_refused),
        cmocka_unit_test(a_surveyed_valley_gets_its_river),
        cmocka_unit_test(a_square_beyond_the_raster_is_refused),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
