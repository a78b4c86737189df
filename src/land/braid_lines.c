#include "land/braid_lines.h"

#include "base/memory.h"
#include "base/vec.h"

#include <math.h>

float *braid_lines_new(const Braid *b, Error *e)
{
    int side = b->side;
    float *lines = memory_alloc((int64_t)side * (side + 1), sizeof *lines, e);
    for (int row = 0; lines && row < side; row++) {
        const float *flow = b->flow_z + (int64_t)row * side;
        float *line = lines + (int64_t)row * (side + 1);
        double all = 0.0, sum = 0.0;
        for (int c = 0; c < side; c++) {
            all += (double)flow[c];
        }
        double scale = all > 0.0 ? b->width / all : 0.0;
        for (int c = 0; c <= side; c++) {
            line[c] = (float)(scale * sum);
            sum += c < side ? (double)flow[c] : 0.0;
        }
    }
    return lines;
}

float braid_line_at(const Braid *b, const float *lines, double u, double v)
{
    int side = b->side, column = (int)floor(u), row = (int)floor(v);
    column = column < 0 ? 0 : column >= side ? side - 1 : column;
    row = row < 0 ? 0 : row >= side ? side - 1 : row;
    float s = (float)(u - column), t = (float)(v - row);
    const float *north = lines + (int64_t)row * (side + 1) + column;
    const float *south = lines + (int64_t)((row + 1) % side) * (side + 1) + column;
    return lerpf(lerpf(north[0], north[1], s), lerpf(south[0], south[1], s), t);
}
