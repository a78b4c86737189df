// The out-trees of a source as networks of vessels: one for each root, with segments, flow and
// orders.
#ifndef RAMIFY_EXPORT_NETWORKS_H
#define RAMIFY_EXPORT_NETWORKS_H

#include "base/file_writer.h"
#include "export/export.h"
#include "outtree/diameter_orders.h"

// Numbers of a segment (SI units): what files hold of each. Integers up to NETWORK_LENGTH and from
// NETWORK_STRAHLER on.
enum {
    NETWORK_FROM, // nodes of the network's tree
    NETWORK_TO,
    NETWORK_PARENT, // segment; -1 at the root
    NETWORK_LENGTH,
    NETWORK_RADIUS,
    NETWORK_RESISTANCE,
    NETWORK_INERTANCE,
    NETWORK_COMPLIANCE,
    NETWORK_STIFFNESS,
    NETWORK_FLOW,
    NETWORK_PRESSURE_FROM,
    NETWORK_PRESSURE_TO,
    NETWORK_WALL_SHEAR,
    NETWORK_STRAHLER,
    NETWORK_ORDER, // by diameter
    NETWORK_ELEMENT,
    NETWORK_COLUMNS
};

extern const char *const network_column[NETWORK_COLUMNS]; // names

typedef struct Network {
    int object;     // index in the source
    int32_t colony; // of the root
    OutTree *tree;  // all that grows from the root; owned
    SegmentList segments;
    Flow flow;
    DiameterOrders orders;
    double (*row)[NETWORK_COLUMNS]; // of each segment; owned
    // nodes of the segments, from their first to their last: segment i has those from line_start[i]
    // to before line_start[i + 1]; owned
    int32_t *line;
    int64_t *line_start;
} Network;

typedef struct NetworkList {
    const ExportSource *source; // borrowed
    Network *network;           // owned
    int64_t count, capacity;
} NetworkList;

// Computes the networks of the source and writes them to the file with `write`, in the C locale.
// Roots from which nothing grows are left out. ERROR_INPUT, with the object's name, when a vessel
// has no radius, and when nothing grows at all; ERROR_IO.
bool networks_write(const ExportSource *source, const char *file, const Run *run,
                    void (*write)(FileWriter *out, const NetworkList *list), Error *e);

static inline bool network_column_is_whole(int column)
{
    return column < NETWORK_LENGTH || column >= NETWORK_STRAHLER;
}

#endif
