#include "land/tile_places.h"

#include <math.h>
#include <stdlib.h>

void tile_places_clear(TilePlaces *places)
{
    free(places->tile);
    *places = (TilePlaces){0};
}

// A place on a face: its height there, and the least of its barycentric coordinates, which is
// negative beside the face.
typedef struct FacePlace {
    double least, height;
} FacePlace;

static FacePlace place_on(const Mesh *mesh, int64_t face, double x, double z)
{
    const uint32_t *corner = mesh->index + 3 * face;
    Vec3 a = mesh->position[corner[0]], b = mesh->position[corner[1]],
         c = mesh->position[corner[2]];
    double bx = (double)b.x - (double)a.x, bz = (double)b.z - (double)a.z;
    double cx = (double)c.x - (double)a.x, cz = (double)c.z - (double)a.z;
    double px = x - (double)a.x, pz = z - (double)a.z, area = bx * cz - bz * cx;
    double of_b = (px * cz - pz * cx) / area, of_c = (bx * pz - bz * px) / area;
    double of_a = 1.0 - of_b - of_c;
    return (FacePlace){fmin(of_a, fmin(of_b, of_c)),
                       of_a * (double)a.y + of_b * (double)b.y + of_c * (double)c.y};
}

static int clamped(double value, int most)
{
    return value < 0.0 ? 0 : value < (double)most ? (int)value : most;
}

float tile_places_height(const TilePlaces *places, const Mesh *mesh, float x, float z)
{
    double u = ((double)x - places->origin[0]) / places->side;
    double v = ((double)z - places->origin[1]) / places->side;
    int tile_column = clamped(u, places->count - 1), tile_row = clamped(v, places->count - 1);
    const DrawnTile *tile = &places->tile[(int64_t)tile_row * places->count + tile_column];
    int cells = tile->cells, across = cells - 2;
    int column = clamped((u - tile_column) * cells, cells - 1) - 1;
    int row = clamped((v - tile_row) * cells, cells - 1) - 1;
    bool inner = column >= 0 && row >= 0 && column < across && row < across;
    int64_t within = inner ? 2 * ((int64_t)row * across + column) : 2 * (int64_t)across * across;
    int64_t first = tile->first_face + within;
    int64_t end = inner ? first + 2 : tile->first_face + tile->face_count;
    FacePlace best = {-INFINITY, 0.0};
    for (int64_t face = first; face < end; face++) {
        FacePlace at = place_on(mesh, face, (double)x, (double)z);
        best = at.least > best.least ? at : best;
    }
    return (float)best.height;
}
