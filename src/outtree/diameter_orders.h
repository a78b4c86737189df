// Orders of vessels by diameter (diameter-defined Strahler system: Kassab 1993, Jiang 1994), beside
// the topological ones of strahler.h. A vessel that takes up a much thinner one keeps its order,
// and vessels of one order are of one size.
#ifndef RAMIFY_OUTTREE_DIAMETER_ORDERS_H
#define RAMIFY_OUTTREE_DIAMETER_ORDERS_H

#include "outtree/segments.h"

enum { MOST_DIAMETER_ORDERS = 32 };

// The vessels of one order. Elements are segments of that order in series.
typedef struct OrderClass {
    int64_t segments, elements;
    double diameter, diameter_spread; // m: mean over the segments, standard deviation
    double length;                    // m: mean over the elements
} OrderClass;

typedef struct DiameterOrders {
    int32_t highest;                         // order; 0 = there are no segments
    OrderClass of[MOST_DIAMETER_ORDERS + 1]; // of[1 .. highest]
    int32_t *order;                          // of each segment; owned
    int32_t *element;                        // of each segment; owned
    int64_t element_count;
    // connectivity[m][n]: mean number of elements of order m that spring from one of order n
    double connectivity[MOST_DIAMETER_ORDERS + 1][MOST_DIAMETER_ORDERS + 1];
    double number, diameter_ratio, length_ratio; // mean ratios of neighbouring orders (RB, RD, RL);
                                                 // NAN if there are fewer than two orders
} DiameterOrders;

// Segments begin with their Strahler order. Their order then is that of the class in whose range
// their diameter D is: the range of order n ends half way between the mean plus the standard
// deviation of n and the mean minus the standard deviation of n + 1; half way between the means,
// where that end is not between them, since few vessels of one order may differ much. Repeated
// until no segment changes (at most 100 times). Where two segments of an element's order leave it,
// the thicker one continues it, the first if they are equal.
bool diameter_orders_init(DiameterOrders *orders, const OutTree *tree, const SegmentList *list,
                          Error *e);
void diameter_orders_free(DiameterOrders *orders);

#endif
