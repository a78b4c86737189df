// The spectrum of a wind sea: JONSWAP (Hasselmann et al. 1973), for finite depth by the TMA factor
// (Bouws et al. 1985), spread over directions by Donelan et al. (1985) with the high frequencies of
// Banner (1990). Its tail is too flat for waves shorter than metres, whose steepness grows with the
// wind: wave_spectrum_steepen adds to them.
#ifndef RAMIFY_OBJECTS_SEA_SPECTRUM_H
#define RAMIFY_OBJECTS_SEA_SPECTRUM_H

#define GRAVITY 9.81 // m/s^2

typedef struct WaveSpectrum {
    double depth;      // m; 0 = deep
    double level;      // Phillips' alpha
    double peak;       // rad/s
    double peakedness; // gamma
    double ripples;    // variance of slopes that the shortest waves have more, per e-fold of length
} WaveSpectrum;

// wind: m/s at 10 m, > 0; fetch: m, > 0. The sea does not grow beyond a fully developed one.
WaveSpectrum wave_spectrum(double wind, double fetch, double depth);

// Steepens waves shorter than 3 m, down to `shortest` m, until all have the share of the slopes
// that Cox and Munk found beyond those of the spectrum.
void wave_spectrum_steepen(WaveSpectrum *s, double wind, double shortest, double share);

// Variance per frequency at omega (rad/s), m^2 s; without the ripples.
double wave_spectrum_at(const WaveSpectrum *s, double omega);

// What a spectrum has at one wave number, and how it spreads over the directions.
typedef struct WaveRing {
    double all;    // variance per area of wave numbers, m^4, times radian: of all directions
    double beta;   // the spread is sech^2(beta angle)
    double within; // tanh(pi beta): half its integral, times beta
} WaveRing;

WaveRing wave_spectrum_ring(const WaveSpectrum *s, double k); // k: 1/m

// Variance per area of wave numbers, m^4, of what runs at an angle from the wind.
double wave_ring_density(const WaveRing *ring, double angle);

// Variance (m^2) of the surface: the integral over all frequencies.
double wave_spectrum_variance(const WaveSpectrum *s);

// Variance of the slopes, summed over both axes, of waves with wave numbers low..high (1/m).
double wave_spectrum_slopes(const WaveSpectrum *s, double low, double high);

// The dispersion relation omega^2 = g k tanh(k depth); depth 0 = deep.
double wave_frequency(double k, double depth);
double wave_number(double omega, double depth);
double wave_group_speed(double k, double depth); // m/s

// Variance of the slopes of a clean sea, summed over both axes (Cox and Munk 1954).
double cox_munk_slopes(double wind);

// Share of a sea that whitecaps cover (Monahan and O'Muircheartaigh 1980; Monahan 1986).
double monahan_whitecaps(double wind);

#endif
