#include "objects/tree/hazards.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/tree/fate.h"

#include <stdlib.h>

// Of the tree's seed.
enum { STREAM_HAZARDS = 61 };

// Of the seed of a tree's hazards, beside those of fate.c: of its fork, and of its limbs.
enum {
    STREAM_FORK_SIDE = 6,
    STREAM_FORK_TURN = 7,
    STREAM_FORK_SIZE = 8,
    STREAM_PATCHES = 13,
    STREAM_BREAK = 14,
    STREAM_LENGTH = 15,
    STREAM_PITCH = 16,
    STREAM_LOOSE = 17,
    STREAM_SHADE = 18
};

enum { FORK_CHILD = 977 };

#define DEAD_TIPS 1.1f     // radii of a tip: thinner wood falls off dead limbs
#define HELD_TO_DEATH 0.3f // share of its length: a low limb that is held back to less dies
#define OWN_LENGTH 0.5f    // of the width's deviation: that of the limbs of one tree
#define STEEPEST 50.0f     // degrees
#define STIFF_TOP 0.4f     // of a limb's turn, at the top: young limbs have turned less
#define SHADE_SPREAD 0.16f // of the height: over it dead limbs give way to living ones
#define SAFE_TOP 0.88f     // of the height: limbs above are not lost
#define DEAD_FOOT 0.03f    // of the height: a dead tree keeps its bark below
#define PATCH_HEIGHT 0.22f // of the height: of the patches in which limbs are lost
#define PATCHY 0.6f        // how far patches, not chance, decide

typedef struct Limb {
    int32_t node;       // its first
    float height;       // of its base, share of the tree's
    float sine, cosine; // of its azimuth
    float reach;        // m: from its base to its farthest node
    Vec3 from, to;      // m: its base as it grew, and where it is moved to
    float factor;       // on its length
    bool dead;
} Limb;

typedef struct Lot {
    float luck; // those with the least are lost
    int32_t limb;
} Lot;

// All that is done to one tree.
typedef struct Hazard {
    OutTree *tree;
    const TreeParams *params;
    uint64_t seed;
    Fate fate;
    Limb *limb;
    int64_t limbs;
    int32_t *limb_of; // per node: number of its limb; -1 = on the trunk or a stub
} Hazard;

bool tree_has_hazards(const HazardParams *h)
{
    return h->width > 0.0f || h->angle > 0.0f || h->loosening > 0.0f || h->crowding > 0.0f ||
           h->bare_below > 0.0f || h->lost_limbs > 0.0f || h->forked_top > 0.0f ||
           h->dead_top > 0.0f || h->dead > 0.0f;
}

static float draw(uint64_t seed, int stream)
{
    return random_unit(random_key(seed, (uint64_t)stream));
}

// ---- a forked top

// Height of a point, as a share of the tree's.
static float share_of(const TreeParams *params, Vec3 p)
{
    return (p.y - params->position.y) / params->height;
}

// The node of the trunk's axis above which it forks, and the one that follows there; false if the
// trunk is too low.
static bool find_fork(const Hazard *z, int64_t *below, int64_t *above)
{
    const OutTree *tree = z->tree;
    for (int64_t i = 1; i < tree->count; i++) {
        if (tree->colony[i] == TREE_TRUNK && tree->parent[i] > 0 &&
            share_of(z->params, tree->position[i]) > z->fate.fork) {
            *above = i;
            *below = tree->parent[i];
            return true;
        }
    }
    return false;
}

// Moves a node of one of two tops aside: they part in a curve and then rise side by side.
static Vec3 aside(Vec3 p, Vec3 base, Vec3 way, float spread)
{
    float t = (p.y - base.y) / (1.5f * spread);
    return t > 0.0f ? vec3_madd(p, spread * t / (1.0f + t), way) : p;
}

// Another top beside the first: a copy of what is above the fork, turned about it and smaller.
static bool fork_top(Hazard *z, Error *e)
{
    OutTree *tree = z->tree;
    int64_t below, above, count = tree->count;
    if (z->fate.fork <= 0.0f || !find_fork(z, &below, &above)) {
        return true;
    }
    float side_sine, side_cosine, sine, cosine;
    exact_sincos(2.0f * PI_F * draw(z->seed, STREAM_FORK_SIDE), &side_sine, &side_cosine);
    exact_sincos(lerpf(1.5f, 2.5f, draw(z->seed, STREAM_FORK_TURN)), &sine, &cosine);
    float size = lerpf(0.7f, 1.0f, draw(z->seed, STREAM_FORK_SIZE));
    float spread = 0.035f * z->params->height * size;
    Vec3 way = vec3(side_sine, 0.0f, side_cosine), base = tree->position[below];
    int32_t *copy = memory_alloc(count, sizeof *copy, e);
    for (int64_t i = 0; copy && i < count; i++) {
        int32_t parent = tree->parent[i];
        copy[i] = i == above ? (int32_t)below : (parent >= 0 ? copy[parent] : -1);
        if (copy[i] < 0) {
            continue;
        }
        int64_t made = out_tree_copy_node(tree, copy[i], tree, i, e);
        if (made < 0) {
            free(copy);
            return false;
        }
        Vec3 from = vec3_scale(vec3_sub(tree->position[i], base), size);
        from = vec3_add(base, vec3_rotate(from, vec3(0, 1, 0), cosine, sine));
        tree->id[made] = out_tree_child_id(tree->id[i], FORK_CHILD);
        tree->position[made] = aside(from, base, vec3_neg(way), spread);
        tree->position[i] = aside(tree->position[i], base, way, spread);
        copy[i] = (int32_t)made;
    }
    bool done = copy;
    free(copy);
    return done;
}

// ---- limbs

static void list_limbs(Hazard *z)
{
    const OutTree *tree = z->tree;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        bool crown = tree->colony[i] == TREE_CROWN && parent >= 0;
        z->limb_of[i] = crown ? z->limb_of[parent] : -1;
        if (crown && tree->colony[parent] == TREE_TRUNK) {
            z->limb_of[i] = (int32_t)z->limbs;
            z->limb[z->limbs++] = (Limb){.node = (int32_t)i,
                                         .from = tree->position[parent],
                                         .to = tree->position[parent],
                                         .height = share_of(z->params, tree->position[parent]),
                                         .factor = 1.0f};
        }
        if (z->limb_of[i] >= 0) {
            Limb *limb = &z->limb[z->limb_of[i]];
            Vec3 from = vec3_sub(tree->position[i], limb->from);
            float reach = sqrtf(vec3_dot(from, from)),
                  level = sqrtf(from.x * from.x + from.z * from.z);
            if (reach > limb->reach && level > 0.0f) {
                limb->reach = reach;
                limb->sine = from.x / level;
                limb->cosine = from.z / level;
            }
        }
    }
}

// What the neighbours leave of a limb's length.
static float held_back(const Fate *fate, const Limb *limb, float crowding)
{
    float left = 1.0f;
    for (int i = 0; i < fate->neighbours; i++) {
        const Neighbour *n = &fate->neighbour[i];
        float facing = n->sine * limb->sine + n->cosine * limb->cosine;
        float side = smoothstepf(0.0f, 0.85f, facing);
        float below = 1.0f - smoothstepf(n->top - 0.3f, n->top, limb->height);
        left *= 1.0f - crowding * n->strength * side * below;
    }
    return left;
}

static int by_luck(const void *a, const void *b)
{
    const Lot *p = a, *q = b;
    if (p->luck != q->luck) {
        return p->luck < q->luck ? -1 : 1;
    }
    return p->limb < q->limb ? -1 : (p->limb > q->limb);
}

// Kills the fate's share of the limbs below the top, in patches of height and side.
static bool lose_limbs(Hazard *z, Error *e)
{
    Lot *lot = memory_alloc(z->limbs + 1, sizeof *lot, e);
    uint64_t patches = random_key(z->seed, STREAM_PATCHES);
    int64_t count = 0;
    for (int64_t k = 0; lot && k < z->limbs; k++) {
        const Limb *limb = &z->limb[k];
        Vec3 at = vec3(limb->sine, limb->height / PATCH_HEIGHT, limb->cosine);
        float chance = random_unit(random_key(patches, z->tree->id[limb->node]));
        if (limb->height < SAFE_TOP) {
            float luck = PATCHY * noise_space(at, patches) + (1.0f - PATCHY) * chance;
            lot[count++] = (Lot){luck, (int32_t)k};
        }
    }
    if (lot) {
        qsort(lot, (size_t)count, sizeof *lot, by_luck);
    }
    int64_t lost = (int64_t)(z->fate.lost * (float)count + 0.5f);
    for (int64_t k = 0; lot && k < lost; k++) {
        z->limb[lot[k].limb].dead = true;
    }
    bool done = lot;
    free(lot);
    return done;
}

// Moves limbs down the trunk, each by a part of the way to the whorl below its own.
static bool loosen_whorls(Hazard *z, Error *e)
{
    OutTree *tree = z->tree;
    float loosening = z->params->hazards.loosening;
    int32_t *borne = memory_alloc_zero(tree->count, sizeof *borne, e); // limbs of a trunk's node
    for (int64_t k = 0; borne && k < z->limbs; k++) {
        borne[tree->parent[z->limb[k].node]]++;
    }
    for (int64_t k = 0; borne && k < z->limbs; k++) {
        Limb *limb = &z->limb[k];
        int32_t at = tree->parent[limb->node], below = tree->parent[at];
        int free_nodes = 1; // to move to, its own among them
        while (below > 0 && borne[below] < 2) {
            free_nodes++;
            below = tree->parent[below];
        }
        float way = loosening * draw(random_key(z->seed, tree->id[limb->node]), STREAM_LOOSE);
        for (int down = (int)(way * (float)free_nodes); down > 0; down--) {
            at = tree->parent[at];
        }
        tree->parent[limb->node] = at;
        limb->to = tree->position[at];
        limb->height = share_of(z->params, limb->to);
    }
    bool done = borne;
    free(borne);
    return done;
}

static void shape_limb(const Hazard *z, Limb *limb)
{
    const HazardParams *h = &z->params->hazards;
    uint64_t key = random_key(z->seed, z->tree->id[limb->node]);
    float own = OWN_LENGTH * h->width * random_normal(random_key(key, STREAM_LENGTH));
    float left = held_back(&z->fate, limb, h->crowding);
    limb->factor = z->fate.width * left * (float)exact_exp((double)clampf(own, -1.0f, 0.5f));
    bool starved = left < HELD_TO_DEATH && limb->height < 0.6f;
    float shade = z->fate.bare - SHADE_SPREAD * draw(key, STREAM_SHADE);
    limb->dead = z->fate.dead || limb->height < shade || starved;
}

// By how much a limb has turned down, degrees.
static float pitch_of(const Hazard *z, const Limb *limb)
{
    uint64_t key = random_key(z->seed, z->tree->id[limb->node]);
    float own =
        FATE_OWN_PITCH * z->params->hazards.angle * random_normal(random_key(key, STREAM_PITCH));
    float degrees = (z->fate.pitch + own) * lerpf(1.0f, STIFF_TOP, limb->height);
    return clampf(degrees, -STEEPEST, STEEPEST);
}

static void move_limbs(Hazard *z)
{
    OutTree *tree = z->tree;
    int32_t turned = -1; // the limb that sine and cosine are of
    float sine = 0.0f, cosine = 1.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        if (z->limb_of[i] < 0) {
            continue;
        }
        const Limb *limb = &z->limb[z->limb_of[i]];
        if (z->limb_of[i] != turned) {
            exact_sincos(pitch_of(z, limb) * RADIANS_PER_DEGREE, &sine, &cosine);
            turned = z->limb_of[i];
        }
        Vec3 level = vec3(limb->cosine, 0.0f, -limb->sine); // across the limb
        Vec3 from = vec3_rotate(vec3_sub(tree->position[i], limb->from), level, cosine, sine);
        tree->position[i] = vec3_madd(limb->to, limb->factor, from);
    }
}

static bool shape_limbs(Hazard *z, Error *e)
{
    if (!loosen_whorls(z, e)) {
        return false;
    }
    for (int64_t k = 0; k < z->limbs; k++) {
        shape_limb(z, &z->limb[k]);
    }
    move_limbs(z);
    return true;
}

// ---- death

// Is the node part of what has broken off a dead limb?
static bool is_broken_off(const Hazard *z, int64_t i)
{
    const Limb *limb = &z->limb[z->limb_of[i]];
    const OutTree *tree = z->tree;
    float left = draw(random_key(z->seed, tree->id[limb->node]), STREAM_BREAK);
    Vec3 from = vec3_sub(tree->position[i], limb->to);
    float most = limb->factor * limb->reach * lerpf(0.2f, 1.1f, left);
    return vec3_dot(from, from) > most * most;
}

// Marks what is dead as snags, and drops what has fallen.
static bool let_die(Hazard *z, Error *e)
{
    OutTree *tree = z->tree;
    bool *keep = memory_alloc(tree->count, sizeof *keep, e);
    float thin = DEAD_TIPS * z->params->radii.tip;
    for (int64_t i = 0; keep && i < tree->count; i++) {
        const Limb *limb = z->limb_of[i] >= 0 ? &z->limb[z->limb_of[i]] : NULL;
        float height = share_of(z->params, limb ? limb->to : tree->position[i]);
        float from = z->fate.dead ? DEAD_FOOT : z->fate.top;
        bool top = from > 0.0f && height > from;
        bool crown = tree->colony[i] == TREE_CROWN;
        bool dead = (limb && limb->dead) || (top && tree->parent[i] >= 0);
        keep[i] = !dead || !crown || (tree->radius[i] >= thin && !(limb && is_broken_off(z, i)));
        keep[i] = keep[i] && !(z->fate.dead && height > z->fate.broken);
        tree->colony[i] = dead ? TREE_SNAGS : tree->colony[i];
    }
    bool done = keep && out_tree_keep_nodes(tree, keep, e);
    free(keep);
    return done;
}

bool tree_befall(OutTree *tree, const TreeParams *params, uint64_t seed, Error *e)
{
    if (!tree_has_hazards(&params->hazards)) {
        return true;
    }
    Hazard z = {.tree = tree, .params = params, .seed = random_key(seed, STREAM_HAZARDS)};
    z.fate = fate_draw(&params->hazards, z.seed);
    if (!fork_top(&z, e)) {
        return false;
    }
    z.limb = memory_alloc(tree->count, sizeof *z.limb, e);
    z.limb_of = z.limb ? memory_alloc(tree->count, sizeof *z.limb_of, e) : NULL;
    bool done = z.limb_of;
    if (done) {
        list_limbs(&z);
        done = shape_limbs(&z, e) && lose_limbs(&z, e) && let_die(&z, e);
    }
    free(z.limb);
    free(z.limb_of);
    return done;
}

bool tree_is_dead(const OutTree *tree, const HazardParams *hazards)
{
    bool living = hazards->dead <= 0.0f;
    for (int64_t i = 0; i < tree->count && !living; i++) {
        living = tree->colony[i] == TREE_CROWN;
    }
    return !living;
}
