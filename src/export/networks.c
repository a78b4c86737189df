#include "export/networks.h"

#include "base/c_locale.h"
#include "base/memory.h"
#include "outtree/strahler.h"

#include <stdlib.h>

const char *const network_column[NETWORK_COLUMNS] = {
    "from",       "to",         "parent",    "length", "radius",        "resistance",
    "inertance",  "compliance", "stiffness", "flow",   "pressure_from", "pressure_to",
    "wall_shear", "strahler",   "order",     "element"};

static void fill_row(const Network *network, const int32_t *strahler, int64_t segment)
{
    const Segment *s = &network->segments.segment[segment];
    const Flow *flow = &network->flow;
    FlowLumped lumped = flow_lumped(flow, network->tree, s);
    double *row = network->row[segment];
    row[NETWORK_FROM] = s->from;
    row[NETWORK_TO] = s->to;
    row[NETWORK_PARENT] = s->parent;
    row[NETWORK_LENGTH] = s->length;
    row[NETWORK_RADIUS] = s->radius;
    row[NETWORK_RESISTANCE] = lumped.resistance;
    row[NETWORK_INERTANCE] = lumped.inertance;
    row[NETWORK_COMPLIANCE] = lumped.compliance;
    row[NETWORK_STIFFNESS] = flow_wall_stiffness(s->radius);
    row[NETWORK_FLOW] = flow->flow[s->to];
    row[NETWORK_PRESSURE_FROM] = flow->pressure[s->from];
    row[NETWORK_PRESSURE_TO] = flow->pressure[s->to];
    row[NETWORK_WALL_SHEAR] = flow_wall_shear(flow->viscosity[s->to], flow->flow[s->to],
                                              (double)network->tree->radius[s->to]);
    row[NETWORK_STRAHLER] = strahler[s->to];
    row[NETWORK_ORDER] = network->orders.order[segment];
    row[NETWORK_ELEMENT] = network->orders.element[segment];
}

// Appends the node of a tree to the network of its root. place: of each node in its network.
static bool add_node(OutTree *to, const OutTree *from, int64_t node, int32_t *place, Error *e)
{
    int32_t parent = from->parent[node];
    int64_t added = out_tree_add_node(to, from->position[node], parent < 0 ? -1 : place[parent],
                                      from->birth[node], from->colony[node], from->id[node], e);
    if (added >= 0) {
        to->radius[added] = from->radius[node];
        to->normal[added] = from->normal[node];
        place[node] = (int32_t)added;
    }
    return added >= 0;
}

static bool begin_network(NetworkList *list, int object, int32_t colony, Error *e)
{
    if (!memory_reserve(&list->network, &list->capacity, list->count + 1, sizeof *list->network,
                        e)) {
        return false;
    }
    list->network[list->count] =
        (Network){.object = object, .colony = colony, .tree = out_tree_new(e)};
    return list->network[list->count++].tree;
}

// Distributes the nodes of an object's tree to networks. of: the network of each node.
static bool split_tree(NetworkList *list, int object, const OutTree *tree, int64_t *of,
                       int32_t *place, Error *e)
{
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        if (parent < 0 && !begin_network(list, object, tree->colony[i], e)) {
            return false;
        }
        of[i] = parent < 0 ? list->count - 1 : of[parent];
        // a node's parent is before it, so a root has begun a network; NOLINTNEXTLINE
        if (!add_node(list->network[of[i]].tree, tree, i, place, e)) {
            return false;
        }
    }
    return true;
}

static void clear_network(Network *network)
{
    out_tree_free(network->tree);
    segments_free(&network->segments);
    flow_free(&network->flow);
    diameter_orders_free(&network->orders);
    free(network->row);
    free(network->line);
    free(network->line_start);
}

// Nodes of each segment, found from its end.
static bool find_lines(Network *network, Error *e)
{
    const OutTree *tree = network->tree;
    const SegmentList *list = &network->segments;
    network->line = memory_alloc(tree->count + list->count, sizeof *network->line, e);
    network->line_start = memory_alloc(list->count + 1, sizeof *network->line_start, e);
    if (!network->line || !network->line_start) {
        return false;
    }
    network->line_start[0] = 0;
    for (int64_t i = 0; i < list->count; i++) {
        const Segment *segment = &list->segment[i];
        int64_t count = 1;
        for (int32_t k = segment->to; k != segment->from; k = tree->parent[k]) {
            count++;
        }
        int64_t at = network->line_start[i + 1] = network->line_start[i] + count;
        for (int32_t k = segment->to; k != segment->from; k = tree->parent[k]) {
            network->line[--at] = k;
        }
        network->line[--at] = segment->from;
    }
    return true;
}

static bool find_rows(Network *network, Error *e)
{
    int32_t *strahler = memory_alloc(network->tree->count, sizeof *strahler, e);
    network->row = memory_alloc(network->segments.count, sizeof *network->row, e);
    bool done = strahler && network->row;
    if (done) {
        out_tree_strahler(network->tree, strahler);
        for (int64_t i = 0; i < network->segments.count; i++) {
            fill_row(network, strahler, i);
        }
    }
    free(strahler);
    return done;
}

// Computes what is known of a network.
static bool fill_network(Network *network, const ExportSource *source, Error *e)
{
    const OutTree *tree = network->tree;
    FlowParams params = source->flow ? source->flow[network->object] : flow_params_default();
    bool done = segments_init(&network->segments, tree, e) && find_lines(network, e) &&
                diameter_orders_init(&network->orders, tree, &network->segments, e) &&
                flow_init(&network->flow, tree, &params, e) && find_rows(network, e);
    if (!done) {
        error_prefix(e, "object '%s': ", source->object_name[network->object]);
    }
    return done;
}

static bool add_object(NetworkList *list, const ExportSource *source, int object, Error *e)
{
    const OutTree *tree = source->tree[object];
    int64_t first = list->count, kept = first;
    int64_t *of = memory_alloc(tree->count, sizeof *of, e);
    int32_t *place = memory_alloc(tree->count, sizeof *place, e);
    bool done = of && place && split_tree(list, object, tree, of, place, e);
    free(of);
    free(place);
    for (int64_t i = first; done && i < list->count; i++) {
        if (list->network[i].tree->count > 1) {
            Network network = list->network[i];
            list->network[i] = list->network[kept]; // empty, or the same
            list->network[kept++] = network;
        }
    }
    for (int64_t i = kept; done && i < list->count; i++) {
        clear_network(&list->network[i]);
    }
    list->count = done ? kept : list->count;
    for (int64_t i = first; done && i < list->count; i++) {
        done = fill_network(&list->network[i], source, e);
    }
    return done;
}

static void free_networks(NetworkList *list)
{
    for (int64_t i = 0; i < list->count; i++) {
        clear_network(&list->network[i]);
    }
    free(list->network);
    *list = (NetworkList){0};
}

static bool init_networks(NetworkList *list, const ExportSource *source, const Run *run, Error *e)
{
    *list = (NetworkList){.source = source};
    bool done = true;
    for (int i = 0; done && i < source->object_count; i++) {
        if (source->tree[i]) {
            done =
                (!run_is_cancelled(run) || run_cancel_error(e)) && add_object(list, source, i, e);
        }
    }
    if (done && list->count == 0) {
        done = error_set(e, ERROR_INPUT,
                         "no object of '%s' grows; networks need vessels, a tree or another "
                         "growing thing",
                         source->title);
    }
    if (!done) {
        free_networks(list);
    }
    return done;
}

bool networks_write(const ExportSource *source, const char *file, const Run *run,
                    void (*write)(FileWriter *out, const NetworkList *list), Error *e)
{
    NetworkList list;
    if (!init_networks(&list, source, run, e)) {
        return false;
    }
    CLocale locale;
    FileWriter *out = file_writer_open(file, e);
    bool done = out && c_locale_enter(&locale, e);
    if (done) {
        write(out, &list);
        c_locale_leave(&locale);
    }
    free_networks(&list);
    return file_writer_close(out, done, e) && done;
}
