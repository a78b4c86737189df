// Out-trees to skin: random ones and nasty ones.
#ifndef RAMIFY_TESTS_TREE_SAMPLES_H
#define RAMIFY_TESTS_TREE_SAMPLES_H

#include "base/random.h"
#include "outtree/out_tree.h"
#include "outtree/radii.h"
#include "testing.h"

static inline int64_t sample_add(OutTree *tree, Vec3 at, int64_t parent, float radius)
{
    int64_t i = out_tree_add_node(tree, at, parent, (int32_t)tree->count, 0,
                                  random_key(7, (uint64_t)tree->count), NULL);
    assert_true(i >= 0);
    tree->radius[i] = radius;
    return i;
}

// n nodes along a straight line from `from` (a node, or -1: then the first is the root).
static inline int64_t sample_line(OutTree *tree, int64_t from, Vec3 start, Vec3 step, int n,
                                  float radius)
{
    for (int i = from < 0 ? 0 : 1; i <= n; i++) {
        from = sample_add(tree, vec3_madd(start, (float)i, step), from, radius);
    }
    return from;
}

// A random walk that branches at random; wobble: radians or so that it turns a step.
static inline OutTree *sample_walk(uint64_t seed, int nodes, float branching, float wobble,
                                   bool pipe)
{
    OutTree *tree = out_tree_new(NULL);
    assert_non_null(tree);
    Vec3 *heading = calloc((size_t)nodes, sizeof *heading);
    assert_non_null(heading);
    heading[0] = vec3(0, 1, 0);
    sample_add(tree, vec3(0, 0, 0), -1, 0.1f);
    for (int i = 1; i < nodes; i++) {
        uint64_t key = random_key(seed, (uint64_t)i);
        bool forks = random_unit(random_key(key, 0)) < branching;
        int parent = forks ? (int)(random_unit(random_key(key, 1)) * (float)i) : i - 1;
        Vec3 turn = random_direction(random_key(key, 2));
        heading[i] =
            vec3_normalize(vec3_madd(heading[parent], forks ? 3.0f * wobble : wobble, turn));
        sample_add(tree, vec3_madd(tree->position[parent], 0.1f, heading[i]), parent,
                   random_range(random_key(key, 3), 0.0f, 0.2f));
    }
    if (pipe) {
        out_tree_pipe_radii(tree, 2.4f, 0.01f, 0.15f);
    }
    free(heading);
    return tree;
}

enum { NASTY_COUNT = 12 };

static inline OutTree *sample_nasty(int kind)
{
    OutTree *tree = out_tree_new(NULL);
    assert_non_null(tree);
    Vec3 up = vec3(0, 1, 0);
    int64_t end;
    switch (kind) {
    case 0: // a single node
        sample_add(tree, vec3(1, 2, 3), -1, 0.1f);
        break;
    case 1: // a single node without thickness
        sample_add(tree, vec3(0, 0, 0), -1, 0.0f);
        break;
    case 2: // all nodes in one place
        for (int i = 0; i < 20; i++) {
            sample_add(tree, vec3(0, 0, 0), i ? i / 2 : -1, 0.1f);
        }
        break;
    case 3: // a thick zig-zag
        for (int i = 0; i < 60; i++) {
            sample_add(tree, vec3(i & 1 ? 0.3f : 0.0f, 0.05f * (float)i, 0), i - 1, 0.2f);
        }
        break;
    case 4: // there and exactly back, twice
        end = sample_line(tree, -1, vec3(0, 0, 0), vec3(0, 0.1f, 0), 20, 0.1f);
        end = sample_line(tree, end, vec3(0, 2, 0), vec3(0, -0.1f, 0), 40, 0.1f);
        sample_line(tree, end, vec3(0, -2, 0), vec3(0, 0.1f, 0), 60, 0.1f);
        break;
    case 5: // a hundred children at one node
        end = sample_line(tree, -1, vec3(0, 0, 0), vec3(0, 0.1f, 0), 5, 0.1f);
        for (int i = 0; i < 100; i++) {
            Vec3 way = random_direction((uint64_t)i);
            sample_line(tree, end, vec3(0, 0.5f, 0), vec3_scale(way, 0.1f), 8, 0.05f);
        }
        break;
    case 6: // thick children on a thin parent, which never gets thicker itself
        end = sample_line(tree, -1, vec3(0, 0, 0), vec3(0, 0.1f, 0), 20, 0.01f);
        sample_line(tree, end, vec3(0, 2, 0), vec3(0.1f, 0, 0), 20, 0.3f);
        sample_line(tree, 10, vec3(0, 1, 0), vec3(0, 0.02f, 0.1f), 20, 0.29f);
        break;
    case 7: // children that leave straight ahead and straight back
        end = sample_line(tree, -1, vec3(0, 0, 0), vec3(0, 0.1f, 0), 20, 0.1f);
        sample_line(tree, 10, vec3(0, 1, 0), vec3(0, 0.11f, 0), 30, 0.05f);
        sample_line(tree, 10, vec3(0, 1, 0), vec3(0, -0.1f, 0), 30, 0.05f);
        break;
    case 8: // very thick and very short, many roots
        for (int i = 0; i < 9; i++) {
            end = sample_add(tree, vec3((float)i, 0, 0), -1, 5.0f);
            sample_line(tree, end, vec3((float)i, 0, 0), vec3_scale(up, 0.01f), 3, 4.0f);
        }
        break;
    case 9: // many children that all want the same place, in the same direction
        end = sample_line(tree, -1, vec3(0, 0, 0), vec3(0, 0.1f, 0), 30, 0.1f);
        for (int i = 0; i < 40; i++) {
            sample_line(tree, 15, vec3(0, 1.5f, 0), vec3(0.1f, 0, 0), 10, 0.08f);
        }
        break;
    case 10: // tiny and far from the origin
        end = sample_line(tree, -1, vec3(1000, 0, 0), vec3(0, 1e-3f, 0), 50, 2e-4f);
        sample_line(tree, 25, vec3(1000, 0.025f, 0), vec3(1e-3f, 1e-3f, 0), 20, 1e-4f);
        break;
    default: // a spiral as tight as its own radius, with children all along
        for (int i = 0; i < 200; i++) {
            float s = sinf(0.3f * (float)i), c = cosf(0.3f * (float)i);
            sample_add(tree, vec3(0.2f * c, 0.01f * (float)i, 0.2f * s), i - 1, 0.15f);
        }
        for (int i = 0; i < 200; i += 5) {
            Vec3 way = random_direction((uint64_t)i + 99);
            sample_line(tree, i, tree->position[i], vec3_scale(way, 0.1f), 6, 0.03f);
        }
        break;
    }
    return tree;
}

#endif
