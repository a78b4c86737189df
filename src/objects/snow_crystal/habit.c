// The diagram of habits: which crystals grow in which weather.
#include "base/exact_math.h"
#include "objects/snow_crystal/snow_crystal.h"

enum { HABITS = 5 };

// Rates that grow each habit, near those of the paper's figures.
static const SnowfakeRates HABIT[HABITS] = {
    {0.45f, 1.05f, 0.1f, 0.15f, 0.001f, 0.08f, 6e-4f},     // solid plate
    {0.38f, 1.06f, 0.35f, 0.112f, 0.001f, 0.14f, 6e-4f},   // sectored plate
    {0.36f, 1.09f, 0.01f, 0.0745f, 0.0001f, 0.14f, 1e-5f}, // star with plates at its tips
    {0.42f, 1.08f, 0.15f, 0.075f, 0.001f, 0.12f, 1e-4f},   // stellar dendrite
    {0.58f, 1.3f, 0.08f, 0.025f, 0.003f, 0.07f, 5e-5f}};   // fernlike dendrite

bool snow_is_flat(float temperature)
{
    return temperature > -3.5f || (temperature < -10.0f && temperature >= -22.0f);
}

// How readily branches form, 0 .. 1: facets are most unstable at -15 and -2 degrees.
static float branching(float temperature)
{
    double cold = ((double)temperature + 15.0) / 4.0, mild = ((double)temperature + 2.0) / 1.5;
    return (float)(temperature < -6.0f ? exact_exp(-cold * cold) : 0.5 * exact_exp(-mild * mild));
}

float snow_habit(const SnowWeather *weather)
{
    const float fern = 0.22f; // g/m^3: fernlike dendrites at -15 degrees
    float vigour = 0.35f + 0.65f * branching(weather->temperature);
    float habit = (float)(HABITS - 1) * weather->supersaturation / fern * vigour;
    return habit < (float)(HABITS - 1) ? habit : (float)(HABITS - 1);
}

SnowfakeRates snow_habit_rates(float habit)
{
    int i = (int)habit;
    if (i >= HABITS - 1) {
        return HABIT[HABITS - 1];
    }
    return snowfake_rates_between(&HABIT[i], &HABIT[i + 1], habit - (float)i);
}
