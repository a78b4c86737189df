// Measures of a sea: of its spectrum, and of its tiles as the eye finds them.
#include "objects/sea/sea.h"

#include <math.h>

bool sea_measure(const void *given, const Grown *grown, const Recipe *recipe, MeasureList *list,
                 Error *e)
{
    (void)grown;
    enum { SAMPLES = 512 };
    const SeaParams *params = given;
    WaveSpectrum spectrum = sea_spectrum(params);
    Waves *waves = sea_waves(params, recipe->seed, recipe->run, e);
    if (!waves) {
        return false;
    }
    double size = (double)waves->tile[0].size, squares = 0.0, foam = 0.0;
    for (int i = 0; i < SAMPLES * SAMPLES; i++) {
        WavePoint point;
        int column = i % SAMPLES, row = i / SAMPLES;
        float x = (float)(size * column / SAMPLES), z = (float)(size * row / SAMPLES);
        waves_at(waves, x, z, 0.0f, &point);
        squares += (double)point.displacement.y * (double)point.displacement.y;
        foam += (double)waves_foam(waves, &point).cover;
    }
    waves_free(waves);
    double count = (double)SAMPLES * SAMPLES, nan = (double)NAN;
    double peak = wave_number(spectrum.peak, spectrum.depth), turn = 6.283185307179586;
    return measures_add(list, "wave_height", 4.0 * sqrt(squares / count), "m", nan, nan, e) &&
           measures_add(list, "wave_length", turn / peak, "m", nan, nan, e) &&
           measures_add(list, "wave_period", turn / spectrum.peak, "s", nan, nan, e) &&
           measures_add(list, "slope_variance",
                        wave_spectrum_slopes(&spectrum, 0.25 * peak, turn / 0.017), "", nan, nan,
                        e) &&
           measures_add(list, "foam_cover", foam / count, "", nan, nan, e);
}
