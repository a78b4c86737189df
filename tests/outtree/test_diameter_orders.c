// Orders by diameter and their connectivity on trees that can be counted by hand.
#include "outtree/diameter_orders.h"
#include "outtree/strahler.h"
#include "testing.h"

#include <math.h>

#define assert_near(a, b) assert_true(fabs((double)(a) - (double)(b)) < 1e-5)

static int64_t add(OutTree *tree, Vec3 p, int64_t parent, float diameter)
{
    int64_t node = out_tree_add_node(tree, p, parent, 0, 0, (uint64_t)tree->count, NULL);
    assert_true(node >= 0);
    tree->radius[node] = 0.5f * diameter;
    return node;
}

enum { SIDES = 20 };

// A trunk of 21 segments of diameter 4 and length 1, each but the last with a side vessel of
// diameter 2 and length 3 (in two pieces), which forks into two ends of diameter 1 and length 0.5.
static OutTree *bush(void)
{
    OutTree *tree = out_tree_new(NULL);
    int64_t trunk = add(tree, vec3(0, 0, 0), -1, 4.0f);
    for (int i = 1; i <= SIDES + 1; i++) {
        float y = (float)i;
        trunk = add(tree, vec3(0, y, 0), trunk, 4.0f);
        if (i <= SIDES) {
            int64_t side = add(tree, vec3(1, y, 0), trunk, 2.0f);
            side = add(tree, vec3(3, y, 0), side, 2.0f);
            add(tree, vec3(3, y, 0.5f), side, 1.0f);
            add(tree, vec3(3, y, -0.5f), side, 1.0f);
        }
    }
    return tree;
}

static void segments_run_from_fork_to_fork(void **state)
{
    (void)state;
    OutTree *tree = bush();
    SegmentList list;
    assert_true(segments_init(&list, tree, NULL));
    assert_int_equal(list.count, SIDES + 1 + 3 * SIDES);
    double length = 0.0;
    for (int64_t i = 0; i < list.count; i++) {
        const Segment *s = &list.segment[i];
        length += s->length;
        assert_true(s->parent < i);
        assert_true(s->parent < 0 ? tree->parent[s->from] < 0
                                  : list.segment[s->parent].to == s->from);
    }
    assert_near(length, SIDES + 1 + 3 * SIDES + SIDES);
    assert_int_equal(list.segment[0].children, 2);
    assert_int_equal(list.of_node[0], -1);
    segments_free(&list);
    out_tree_free(tree);
}

// A tree, its segments and their orders.
typedef struct Ordered {
    OutTree *tree;
    SegmentList list;
    DiameterOrders orders;
} Ordered;

static Ordered order_tree(OutTree *tree)
{
    Ordered o = {.tree = tree};
    assert_true(segments_init(&o.list, tree, NULL));
    assert_true(diameter_orders_init(&o.orders, tree, &o.list, NULL));
    return o;
}

static void free_ordered(Ordered *o)
{
    diameter_orders_free(&o->orders);
    segments_free(&o->list);
    out_tree_free(o->tree);
}

static void orders_follow_the_diameter(void **state)
{
    (void)state;
    Ordered o = order_tree(bush());
    assert_int_equal(o.orders.highest, 3);
    for (int64_t i = 0; i < o.list.count; i++) {
        double d = 2.0 * o.list.segment[i].radius;
        assert_int_equal(o.orders.order[i], d > 3.0 ? 3 : (d > 1.5 ? 2 : 1));
    }
    // Topology alone puts the trunk's end into the lowest order.
    int32_t *topological = calloc((size_t)o.tree->count, sizeof *topological);
    assert_non_null(topological);
    out_tree_strahler(o.tree, topological);
    assert_int_equal(topological[o.list.segment[o.list.count - 1].to], 1);
    assert_near(2.0 * o.list.segment[o.list.count - 1].radius, 4.0);
    free(topological);
    free_ordered(&o);
}

static void tables_are_those_counted_by_hand(void **state)
{
    (void)state;
    Ordered o = order_tree(bush());
    const OrderClass *of = o.orders.of;
    assert_int_equal(of[1].segments, 2 * SIDES);
    assert_int_equal(of[2].segments, SIDES);
    assert_int_equal(of[3].segments, SIDES + 1);
    assert_int_equal(of[1].elements, 2 * SIDES);
    assert_int_equal(of[2].elements, SIDES);
    assert_int_equal(of[3].elements, 1); // all in series
    assert_int_equal(o.orders.element_count, 3 * SIDES + 1);
    for (int n = 1; n <= 3; n++) {
        assert_near(of[n].diameter, n == 3 ? 4.0 : n);
        assert_near(of[n].diameter_spread, 0.0);
        for (int m = 1; m <= 3; m++) {
            double wanted = m == 2 && n == 3 ? SIDES : (m == 1 && n == 2 ? 2.0 : 0.0);
            assert_near(o.orders.connectivity[m][n], wanted);
        }
    }
    assert_near(of[1].length, 0.5);
    assert_near(of[2].length, 3.0);
    assert_near(of[3].length, SIDES + 1);
    assert_near(o.orders.diameter_ratio, 2.0);
    assert_near(o.orders.number, sqrt(2.0 * SIDES)); // from 40 to 1 over two orders
    assert_near(o.orders.length_ratio, sqrt((SIDES + 1) / 0.5));
    free_ordered(&o);
}

// A trunk of four segments of diameter 4, each with a side end of diameter 1, and an end of
// diameter 9 beyond them. By topology the ends are order 1: diameters 1, 1, 1, 1 and 9, mean 2.6,
// standard deviation 3.2; the trunk is order 2: 4 and 0. The range of order 1 by Jiang 1994 ends at
// (2.6 + 3.2 + 4 - 0) / 2 = 4.9, above the mean of order 2, and takes the trunk in. Half way
// between the means, at 3.3, it leaves the trunk out; then the orders are {1} and {4, 9}.
static void overlapping_orders_are_split_between_their_means(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    int64_t trunk = add(tree, vec3(0, 0, 0), -1, 4.0f);
    for (int i = 1; i <= 4; i++) {
        trunk = add(tree, vec3(0, (float)i, 0), trunk, 4.0f);
        add(tree, vec3(1, (float)i, 0), trunk, 1.0f);
    }
    add(tree, vec3(0, 5, 0), trunk, 9.0f);
    Ordered o = order_tree(tree);
    assert_int_equal(o.orders.highest, 2);
    for (int64_t i = 0; i < o.list.count; i++) {
        assert_int_equal(o.orders.order[i], o.list.segment[i].radius > 1.0 ? 2 : 1);
    }
    assert_near(o.orders.of[1].diameter, 1.0);
    assert_near(o.orders.of[1].diameter_spread, 0.0);
    assert_near(o.orders.of[2].diameter, 5.0); // of 4, 4, 4, 4 and 9
    assert_near(o.orders.of[2].diameter_spread, 2.0);
    assert_int_equal(o.orders.of[2].elements, 1);
    assert_near(o.orders.connectivity[1][2], 4.0);
    free_ordered(&o);
}

// A trunk of eight segments, of diameters 2.6 and 5.4 in turn, with side ends of diameters 1
// and 2.9 in turn and one more end of 1 at its own. By topology the ends are order 1: mean 1.84,
// standard deviation 0.94, so up to 2.79; the trunk is order 2: 4.0 and 1.4, so from 2.6. These
// ranges overlap, and the orders part at the overlap's middle, 2.69: ends of 2.9 and segments
// of 2.6 change their orders. Then both ranges leave a gap, 2.51 to 2.9, and its middle changes
// nothing. Half way between the means, at 2.92, the ends of 2.9 would have stayed.
static void orders_part_in_the_middle_of_overlap_and_gap(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    int64_t trunk = add(tree, vec3(0, 0, 0), -1, 2.6f);
    for (int i = 1; i <= 8; i++) {
        trunk = add(tree, vec3(0, (float)i, 0), trunk, i % 2 ? 2.6f : 5.4f);
        add(tree, vec3(1, (float)i, 0), trunk, i % 2 ? 1.0f : 2.9f);
    }
    add(tree, vec3(0, 9, 0), trunk, 1.0f);
    Ordered o = order_tree(tree);
    assert_int_equal(o.orders.highest, 2);
    for (int64_t i = 0; i < o.list.count; i++) {
        assert_int_equal(o.orders.order[i], 2.0 * o.list.segment[i].radius > 2.75 ? 2 : 1);
    }
    assert_int_equal(o.orders.of[1].segments, 9);
    assert_near(o.orders.of[1].diameter, (5 * 1.0 + 4 * 2.6) / 9);
    assert_int_equal(o.orders.of[2].segments, 8);
    assert_near(o.orders.of[2].diameter, 4.15);
    assert_near(o.orders.of[2].diameter_spread, 1.25);
    free_ordered(&o);
}

static void empty_trees_have_no_orders(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    add(tree, vec3(0, 0, 0), -1, 1.0f);
    Ordered o = order_tree(tree);
    assert_int_equal(o.list.count, 0);
    assert_int_equal(o.orders.highest, 0);
    assert_true(isnan(o.orders.number));
    free_ordered(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(segments_run_from_fork_to_fork),
        cmocka_unit_test(orders_follow_the_diameter),
        cmocka_unit_test(tables_are_those_counted_by_hand),
        cmocka_unit_test(overlapping_orders_are_split_between_their_means),
        cmocka_unit_test(orders_part_in_the_middle_of_overlap_and_gap),
        cmocka_unit_test(empty_trees_have_no_orders),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
