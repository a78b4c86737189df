// One waterfall, private to fall_path.c, fall_strands.c, fall_mesh.c and falls.c: its water leaves
// the lip as a sheet and breaks up into white strands.
#ifndef RAMIFY_OBJECTS_TERRAIN_FALL_H
#define RAMIFY_OBJECTS_TERRAIN_FALL_H

#include "objects/terrain/drawn.h"

#define FALL_GRAVITY 9.81f // m/s^2

enum {
    FALL_STEPS = 160, // of a strand's path
    FALL_LAYERS = 4,  // of strands behind each other
    FALL_ACROSS = 72  // strands of a layer, at most
};

// Kinds of random numbers of a fall, after those of its strands.
enum {
    FALL_STREAM_TONGUES = FALL_ACROSS * FALL_LAYERS,
    FALL_STREAM_SPRAY,
    FALL_STREAM_CLOTS,
    FALL_STREAM_WATER,
    FALL_STREAM_SHEET
};

// How finely a fall is drawn.
typedef struct FallDetail {
    int columns;     // strands of a layer; 0 = it is too small to be seen
    int rows, sheet; // rows of a strand, and of the sheet
} FallDetail;

typedef struct Fall {
    const Terrain *terrain;
    const DrawnLand *land;
    int32_t lip; // node of the river
    float level; // m, of the pool
    Vec3 way, across;
    float half, speed; // m, half the width; m/s, at the lip
    float cover;       // how closely strands stand together at the foot, 0..1
    FallDetail detail;
    bool breaks; // below the lip its strands become white water
} Fall;

// Sets what follows from lip and level. main: the main child of each node of the river.
void fall_init(Fall *fall, const int32_t *main);

static inline int fall_strand_count(const Fall *fall)
{
    return fall->detail.columns * FALL_LAYERS;
}

// A number of a fall for its noises and random choices.
uint64_t fall_stream(const Fall *fall, int stream);

// Where a strand leaves the lip, -1..1 across; its width, relative to the mean; half its width in m
// where it has fallen by this share of the height.
float fall_strand_side(const Fall *fall, int strand);
float fall_strand_width(const Fall *fall, int strand);
float fall_strand_half(const Fall *fall, int strand, float share);

// How white a strand is, 0..1.
float fall_strand_white(const Fall *fall, int strand);

// Its path, of the number of places that it returns. *step: s between two.
int fall_strand_path(const Fall *fall, int strand, Vec3 place[FALL_STEPS], float *step);

// Rocks at the lip part the water into tongues: its share at a place across, about 1.
float fall_tongue(const Fall *fall, float side);

// Where the water leaves the lip at a place across, and its path as one sheet.
Vec3 fall_start(const Fall *fall, float side);
int fall_sheet_path(const Fall *fall, float side, Vec3 place[FALL_STEPS], float *step);

// Sheet and strands, where they are drawn. The caller frees the mesh.
Mesh *fall_mesh(const Fall *fall, Error *e);

#endif
