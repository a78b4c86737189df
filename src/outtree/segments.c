#include "outtree/segments.h"

#include "base/memory.h"

#include <stdlib.h>

static void add_piece(SegmentList *list, const OutTree *tree, const int32_t *children, int64_t node)
{
    int32_t parent = tree->parent[node], above = list->of_node[parent];
    bool begins = above < 0 || children[parent] != 1;
    if (begins) {
        list->segment[list->count] = (Segment){.from = parent, .parent = above};
        list->of_node[node] = (int32_t)list->count++;
        if (above >= 0) {
            list->segment[above].children++;
        }
    } else {
        list->of_node[node] = above;
    }
    Segment *segment = &list->segment[list->of_node[node]];
    double length = (double)vec3_distance(tree->position[node], tree->position[parent]);
    segment->to = (int32_t)node;
    segment->length += length;
    segment->radius += length * (double)tree->radius[node]; // divided by the length at the end
}

static void find_segments(SegmentList *list, const OutTree *tree, const int32_t *children)
{
    for (int64_t i = 0; i < tree->count; i++) {
        list->of_node[i] = -1;
        if (tree->parent[i] >= 0) {
            add_piece(list, tree, children, i);
        }
    }
    for (int64_t i = 0; i < list->count; i++) {
        Segment *segment = &list->segment[i];
        segment->radius = segment->length > 0.0 ? segment->radius / segment->length
                                                : (double)tree->radius[segment->to];
    }
}

bool segments_init(SegmentList *list, const OutTree *tree, Error *e)
{
    *list = (SegmentList){.segment = memory_alloc(tree->count, sizeof *list->segment, e),
                          .of_node = memory_alloc(tree->count, sizeof *list->of_node, e)};
    int32_t *children = out_tree_count_children(tree, e);
    bool done = list->segment && list->of_node && children;
    if (done) {
        find_segments(list, tree, children);
    } else {
        segments_free(list);
    }
    free(children);
    return done;
}

void segments_free(SegmentList *list)
{
    free(list->segment);
    free(list->of_node);
    *list = (SegmentList){0};
}
