#include "render/sky/air_glow.h"

#define HIGHEST 60.0 // km: above it is hardly any air
// Sine of the lowest depression of the sun that is told apart: lower, hardly anything glows.
#define SUNKEN 0.25
#define SUNKEN_PART 0.25f // of the entries, for the sun below the horizon

double air_glow_radius(int height)
{
    double s = (double)height / (GLOW_HEIGHTS - 1);
    return GROUND_RADIUS + fmax(1e-3, HIGHEST * s * s);
}

// Entries are denser where the sun is near the horizon.
double air_glow_sun(int sun)
{
    const double part = (double)SUNKEN_PART;
    double s = (double)sun / (GLOW_SUNS - 1);
    double below = (part - s) / part, above = (s - part) / (1.0 - part);
    return s < part ? -SUNKEN * below * below : above * above;
}

double air_tilt(int tilt, int tilts)
{
    double u = -1.0 + 2.0 * (tilt + 0.5) / tilts;
    return u * fabs(u);
}

double air_turn(int turn, int turns)
{
    return (double)PI_F * (turn + 0.5) / turns;
}

// An entry and the weight of the next.
typedef struct Between {
    int first;
    float share;
} Between;

static Between within(float x, int low, int high)
{
    x = clampf(x, (float)low, (float)high);
    int first = x < (float)high ? (int)x : high - 1;
    return (Between){first, x - (float)first};
}

static Between between(float x, int count)
{
    return within(x, 0, count - 1);
}

static Between height_of(double r)
{
    float s = sqrtf(fmaxf((float)((r - GROUND_RADIUS) / HIGHEST), 0.0f));
    return between(s * (float)(GLOW_HEIGHTS - 1), GLOW_HEIGHTS);
}

// The inverse of air_glow_sun.
static float sun_index(float mu_sun)
{
    float s = mu_sun < 0.0f ? SUNKEN_PART * (1.0f - sqrtf(-mu_sun / (float)SUNKEN))
                            : SUNKEN_PART + (1.0f - SUNKEN_PART) * sqrtf(mu_sun);
    return clampf(s * (float)(GLOW_SUNS - 1), 0.0f, (float)(GLOW_SUNS - 1));
}

void air_glow_set_suns(AirGlow *glow, double sine)
{
    // 12 degrees: a level ray is 8 degrees long up to 60 km; light of further orders comes from
    // nearer.
    const double along = 0.97814760, across = 0.20791169; // cosine and sine
    double cosine = sqrt(fmax(0.0, 1.0 - sine * sine));
    double lowest = sine < -along ? -1.0 : sine * along - cosine * across;
    double highest = sine > along ? 1.0 : sine * along + cosine * across;
    float low = sun_index((float)lowest), high = sun_index((float)highest);
    glow->first_sun = (int)fminf(floorf(low), (float)(GLOW_SUNS - 2));
    glow->last_sun = (int)fmaxf(ceilf(high), (float)(glow->first_sun + 1));
}

static Between tilt_of(double mu)
{
    float u = mu < 0.0 ? -sqrtf((float)-mu) : sqrtf((float)mu);
    return between(0.5f * (u + 1.0f) * GLOW_TILTS - 0.5f, GLOW_TILTS);
}

GlowPair air_glow_at(const AirGlow *glow, double r, double mu_sun, double mu, float turn)
{
    Between h = height_of(r), m = tilt_of(mu);
    Between s = within(sun_index((float)mu_sun), glow->first_sun, glow->last_sun);
    Between t = between(turn / PI_F * GLOW_TURNS - 0.5f, GLOW_TURNS);
    GlowPair sum = {{{0.0f}}, {{0.0f}}};
    for (int corner = 0; corner < 16; corner++) {
        int dh = corner & 1, ds = corner >> 1 & 1, dm = corner >> 2 & 1, dt = corner >> 3;
        float weight = (dh ? h.share : 1.0f - h.share) * (ds ? s.share : 1.0f - s.share) *
                       (dm ? m.share : 1.0f - m.share) * (dt ? t.share : 1.0f - t.share);
        if (weight < 1e-6f) {
            continue; // directions of the table's own
        }
        const GlowPair *pair = &glow->at[h.first + dh][s.first + ds][m.first + dm][t.first + dt];
        for (int i = 0; i < SPECTRUM_BANDS; i++) {
            sum.air.v[i] += weight * pair->air.v[i];
            sum.dust.v[i] += weight * pair->dust.v[i];
        }
    }
    return sum;
}
