// Bright stars, as places and magnitudes.
#ifndef RAMIFY_RENDER_SKY_STAR_CATALOG_H
#define RAMIFY_RENDER_SKY_STAR_CATALOG_H

#include <stdint.h>

#define STAR_CATALOG_FAINTEST 5.5f // magnitude

typedef struct CatalogStar {
    int32_t declination;     // thousandths of a degree, ascending in the catalogue
    int32_t right_ascension; // likewise
    int16_t magnitude;       // visual, hundredths
    uint16_t temperature;    // K
} CatalogStar;

extern const CatalogStar star_catalog[];
extern const int star_catalog_count;

#endif
