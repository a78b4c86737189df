// Where a braided river's water is. Most of a valley is dry: terraces and slopes.
#include "land/braid_parts.h"

#include <string.h>

enum { REACH = 2 }; // cells: flow comes to the next one, its load moves the bed of the one after

BraidSpan braid_wet_span(const Braid *b, BraidSpan among, int row)
{
    int64_t here = (int64_t)row * b->side;
    const float *h = b->depth + here, *x = b->flow_x + here, *z = b->flow_z + here;
    int begin = among.begin, end = among.end;
    while (begin < end && h[begin] == 0.0f && x[begin] == 0.0f && z[begin] == 0.0f) {
        begin++;
    }
    while (begin < end && h[end - 1] == 0.0f && x[end - 1] == 0.0f && z[end - 1] == 0.0f) {
        end--;
    }
    return (BraidSpan){begin, end};
}

static void include(BraidSpan *span, BraidSpan wet, int side)
{
    if (wet.begin == wet.end) {
        return;
    }
    int begin = wet.begin > REACH ? wet.begin - REACH : 0;
    int end = wet.end < side - REACH ? wet.end + REACH : side;
    bool empty = span->begin == span->end;
    span->begin = empty || begin < span->begin ? begin : span->begin;
    span->end = empty || end > span->end ? end : span->end;
}

void braid_widen(Braid *b)
{
    for (int row = 0; row < b->side; row++) {
        for (int k = -REACH; k <= REACH; k++) {
            include(b->span + row, b->wet[(row + k + b->side) % b->side], b->side);
        }
    }
}

void braid_begin(Braid *b)
{
    for (int64_t i = 0; i < braid_count(b); i++) {
        b->ground[i] = (float)b->bed[i];
    }
    for (int row = 0; row < b->side; row++) {
        b->wet[row] = braid_wet_span(b, (BraidSpan){0, b->side}, row);
    }
    braid_widen(b);
}
