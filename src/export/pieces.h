// All surfaces of a world as meshes, one after the other. Curves become tubes some thousand at a
// time, so that at most a few megabytes are held twice.
#ifndef RAMIFY_EXPORT_PIECES_H
#define RAMIFY_EXPORT_PIECES_H

#include "export/vertex.h"
#include "mesh/geometry.h"

typedef struct ExportPiece {
    int64_t part; // index into the geometry
    const ExportSurface *surface;
    const Transform *place; // NULL = as it is
    InstanceLook look;      // as for export_surface_vertices
} ExportPiece;

Aabb export_piece_bounds(const ExportPiece *piece);

// Returning false, with e set, ends the walk.
typedef bool (*ExportVisit)(void *user, const ExportPiece *piece, Error *e);

// The pieces of part number index: of each instance if placed, else of its mesh alone. wants: of
// vertex.h. ERROR_CANCELLED when the user interrupts.
bool export_part_pieces(const ExportSource *source, int64_t index, bool placed, unsigned wants,
                        const Run *run, ExportVisit visit, void *user, Error *e);

// The pieces of all parts, instances written out. Reports progress from share begin to share end.
bool export_all_pieces(const ExportSource *source, unsigned wants, float begin, float end,
                       const Run *run, ExportVisit visit, void *user, Error *e);

// Totals of such a walk.
typedef struct ExportTally {
    int64_t vertices, faces, triangles; // a quad is one face
} ExportTally;

ExportTally export_part_tally(const ExportSource *source, int64_t index, bool placed);
ExportTally export_all_tally(const ExportSource *source);

// Warns if writing out instances makes very many triangles.
void export_warn_of_instances(const ExportSource *source, const Run *run);

// Vertices of a piece in blocks of at most EXPORT_BLOCK.
enum { EXPORT_BLOCK = 32768 };

#endif
