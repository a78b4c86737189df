#include "objects/tree/fate.h"

#include "base/exact_math.h"
#include "base/random.h"

// Of the seed of a tree's hazards; those of its limbs and of its fork are in hazards.c.
enum {
    STREAM_WIDTH = 1,
    STREAM_BARE = 2,
    STREAM_LOST = 3,
    STREAM_FORK = 4,
    STREAM_FORK_HEIGHT = 5,
    STREAM_TOP = 9,
    STREAM_TOP_HEIGHT = 10,
    STREAM_DEATH = 11,
    STREAM_NEIGHBOURS = 12,
    STREAM_PITCH = 16,
    STREAM_BROKEN = 19,
    STREAM_NEIGHBOUR = 20 // .. + NEIGHBOUR_STREAMS each
};

enum { NEIGHBOUR_STREAMS = 4 };

#define WIDEST 1.7f     // factor on all limbs, and the inverse of the least
#define LEAST_SNAG 0.5f // of the height: what is left of a dead tree

static float draw(uint64_t seed, int stream)
{
    return random_unit(random_key(seed, (uint64_t)stream));
}

static void draw_neighbours(Fate *fate, uint64_t seed)
{
    float many = draw(seed, STREAM_NEIGHBOURS);
    fate->neighbours = many < 0.2f ? 0 : (many < 0.6f ? 1 : (many < 0.85f ? 2 : 3));
    for (int i = 0; i < fate->neighbours; i++) {
        int stream = STREAM_NEIGHBOUR + NEIGHBOUR_STREAMS * i;
        Neighbour *one = &fate->neighbour[i];
        exact_sincos(2.0f * PI_F * draw(seed, stream), &one->sine, &one->cosine);
        one->top = lerpf(0.35f, 1.05f, draw(seed, stream + 1));
        one->strength = lerpf(0.5f, 1.0f, draw(seed, stream + 2));
    }
}

Fate fate_draw(const HazardParams *h, uint64_t seed)
{
    float normal = random_normal(random_key(seed, STREAM_WIDTH));
    float width = (float)exact_exp((double)(h->width * normal));
    Fate fate = {.width = clampf(width, 1.0f / WIDEST, WIDEST),
                 .pitch = FATE_OWN_PITCH * h->angle * random_normal(random_key(seed, STREAM_PITCH)),
                 .bare = h->bare_below * draw(seed, STREAM_BARE),
                 .lost = clampf(2.0f * h->lost_limbs * draw(seed, STREAM_LOST), 0.0f, 0.95f),
                 .dead = draw(seed, STREAM_DEATH) < h->dead,
                 .broken = lerpf(LEAST_SNAG, 1.1f, draw(seed, STREAM_BROKEN))};
    if (draw(seed, STREAM_FORK) < h->forked_top) {
        fate.fork = lerpf(0.5f, 0.85f, draw(seed, STREAM_FORK_HEIGHT));
    } else if (draw(seed, STREAM_TOP) < h->dead_top) {
        fate.top = lerpf(0.72f, 0.93f, draw(seed, STREAM_TOP_HEIGHT));
    }
    draw_neighbours(&fate, seed);
    return fate;
}
