// The year of a plant's leaves: when they unfold, turn and fall.
#ifndef RAMIFY_OBJECTS_COMMON_PHENOLOGY_H
#define RAMIFY_OBJECTS_COMMON_PHENOLOGY_H

#include "config/table.h"
#include "objects/common/leaves.h"

// Times are months and fractions of a month, 1 = begin of January, 4.5 = middle of April, at 50
// degrees north. Begin and end of each.
typedef struct Phenology {
    float leafing[2]; // from the first buds that break to grown leaves
    float turning[2]; // of the leaves' colour, from the first to the last
    float falling[2]; // of the leaves
    bool evergreen;   // leaves stay
} Phenology;

Phenology phenology_default(void); // an oak's

// The month at 50 degrees north that a season at a latitude is like: spring is later and autumn
// earlier in the north. season 0: 0.
float phenology_time(float season, float latitude);

// Is the time, if it is not 0, within the months of the span ([11, 3] goes over the new year)? A
// span of 0 is all year.
bool phenology_is_within(const float span[2], float time);

// The state of the leaves at a time of the year: sets emergence, autumn, fall and litter. latitude:
// degrees, negative in the south, where the year begins in July.
void phenology_apply(const Phenology *phenology, float season, float latitude,
                     LeavesParams *leaves);

// The check of a plant's key `season`: applies it unless it is 0. False if it is before January.
bool phenology_check(const Mapping *mapping, const Phenology *phenology, float season,
                     float latitude, LeavesParams *leaves);

extern const Table phenology_table;

// Rows of the keys season, latitude and phenology of a STRUCT.
#define PHENOLOGY_ROWS(STRUCT)                                                                     \
    {KEY_OF(STRUCT, season, "season", KEY_FLOAT), .high = 13, .unit = "months",                    \
     .doc =                                                                                        \
         "Time of the year as a month and its fraction: 1 = begin of January, 10.5 = middle of "   \
         "October. It sets emergence, autumn, fall and litter of leaves by the phenology; 0 = "    \
         "as leaves has them."},                                                                   \
        {KEY_OF(STRUCT, latitude, "latitude", KEY_FLOAT), .low = -90, .high = 90,                  \
         .unit = "degrees",                                                                        \
         .doc =                                                                                    \
             "Latitude for the season: spring comes 4 days later per degree to the north and "     \
             "autumn "                                                                             \
             "2 days earlier; south of the equator (negative) the year is turned by six months."}, \
    {                                                                                              \
        KEY_OF(STRUCT, phenology, "phenology", KEY_GROUP), .table = &phenology_table,              \
                                                           .doc = "The year of the leaves."        \
    }

#endif
