// Things: objects of which copies stand in many places, as those of a scattering or a row.
#ifndef RAMIFY_OBJECTS_COMMON_THINGS_H
#define RAMIFY_OBJECTS_COMMON_THINGS_H

#include "objects/kind.h"

// One of the objects that are copied.
typedef struct Thing {
    SceneObject object; // without a name; first, for the offsets of the kinds' keys
    float share;        // of the copies, relative to the other things'
} Thing;

typedef struct Things {
    Thing *list; // owned by the scene's arena
    int count;
    int variants; // of each thing
} Things;

// Where the copies stand.
typedef struct ThingPlaces {
    Transform *place; // of each copy, from a thing at the origin
    int *thing;       // of each copy: which one, thing * variants + variant
    int64_t count;
} ThingPlaces;

// Room for most places, of which none is taken yet. Clear with thing_places_free, also on failure.
bool thing_places_alloc(ThingPlaces *places, int64_t most, Error *e);
void thing_places_free(ThingPlaces *places);

// The thing at u, 0..1, of all shares.
int things_choose(const Things *things, float u);

// Share of the places that are kept where the noise of clumps has this value; clumping: 0 = all ..
// 1 = none between clumps.
float things_clump_share(float clumping, float noise);

// Parts of a Kind: its further_material and needs.
const char *things_material(const Things *things, int index);
void things_need(const Things *things, int64_t copies, Needs *needs);

// Builds each variant that stands somewhere once, and instances it.
bool things_geometry(const Things *things, const ThingPlaces *places, const Placing *placing,
                     Error *e);

// The rows of a STRUCT with Things things: what is copied.
extern const struct Table thing_table;
#define THINGS_ROWS(STRUCT)                                                                  \
    {                                                                                        \
        KEY_OF(STRUCT, things.list, "things", KEY_LIST),                                     \
            .flags = KEY_REQUIRED, .low = 1, .count_offset = offsetof(STRUCT, things.count), \
            .count = 100, .table = &thing_table, .doc = "What is copied."                    \
    }
#define VARIANTS_ROW(STRUCT)                                                                       \
    {                                                                                              \
        KEY_OF(STRUCT, things.variants, "variants", KEY_INT),                                      \
            .low = 1, .high = 1000,                                                                \
            .doc = "Number of different individuals of each thing; all others are copies of them." \
    }

#endif
