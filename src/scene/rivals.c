#include "scene/rivals.h"

#include "base/memory.h"
#include "grow/light/stand.h"
#include "grow/room.h"
#include "shape/point_hash.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>

// One rival's place in the contest.
typedef struct Player {
    Rival *rival;
    struct Contested *all;
    int index;
    PointHash *points; // its axis, in the scene, at intervals of half a gap
    Aabb box;          // of these
    Vec3 *node;        // its nodes, in the scene
    int64_t node_count, node_capacity;
    int64_t *told; // per other player: how many of its nodes this one knows
    Vec3 *news;    // the others' new nodes, in its own space
    int64_t news_capacity;
    bool gives; // leaves to the shared light
    Vec3 *leaf; // these, in the scene
    int64_t leaf_capacity;
    int64_t older[2]; // nodes that it had when light was last carried, and the time before
    bool done;
    Room room;
    pthread_t thread;
} Player;

// Lock and condition guard `turn` and `done`. Everything else belongs to the player whose turn it
// is.
typedef struct Contested {
    Player *player;
    int count, turn;
    int64_t round; // how often turns have gone around
    int64_t lit;   // round in which light was carried
    RoomTrials trials;
    LightStand *stand; // light that all share who grow by it
    bool stop;         // one failed
    pthread_mutex_t lock;
    pthread_cond_t moved;
} Contested;

static Vec3 into_scene(const Rival *rival, Vec3 p)
{
    return transform_point(&rival->to_scene, p);
}

// Directions and places of the scene in the rival's own space: to_scene is a rotation and a
// translation.
static Vec3 turned_back(const Rival *rival, Vec3 v)
{
    const Transform *t = &rival->to_scene;
    return vec3(t->m[0][0] * v.x + t->m[1][0] * v.y + t->m[2][0] * v.z,
                t->m[0][1] * v.x + t->m[1][1] * v.y + t->m[2][1] * v.z,
                t->m[0][2] * v.x + t->m[1][2] * v.y + t->m[2][2] * v.z);
}

static Vec3 out_of_scene(const Rival *rival, Vec3 p)
{
    const Transform *t = &rival->to_scene;
    return turned_back(rival, vec3_sub(p, vec3(t->m[0][3], t->m[1][3], t->m[2][3])));
}

// ---- the room

static bool is_beyond(Aabb box, Vec3 p, float distance)
{
    Vec3 out = vec3_max(vec3_sub(box.low, p), vec3_sub(p, box.high));
    return out.x > distance || out.y > distance || out.z > distance;
}

// Distance to the rivals' nodes beyond the gap, at most a gap.
static float rivals_clearance(const Player *me, Vec3 p, Vec3 *away)
{
    float gap = me->rival->gap, least = 2.0f * gap;
    for (int i = 0; i < me->all->count; i++) {
        Vec3 nearest;
        const Player *other = &me->all->player[i];
        if (i != me->index && !is_beyond(other->box, p, least) &&
            point_hash_nearest(other->points, p, &least, &nearest)) {
            *away = vec3_normalize(vec3_sub(p, nearest));
        }
    }
    return least - gap;
}

static float clearance(const void *user, Vec3 p, Vec3 *away)
{
    const Player *me = user;
    const Rival *rival = me->rival;
    Vec3 at = into_scene(rival, p), to_rivals = vec3(0, 0, 0);
    float least = INFINITY;
    *away = vec3(0, 0, 0);
    if (rival->obstacles) {
        least = obstacles_clearance(rival->obstacles, at, away);
    }
    if (me->all) {
        float gap = rivals_clearance(me, at, &to_rivals);
        if (gap < least) {
            least = gap;
            *away = to_rivals;
        }
    }
    *away = turned_back(rival, *away);
    return least;
}

static float obstacle(const void *user, Vec3 p)
{
    Vec3 away;
    const Rival *rival = ((const Player *)user)->rival;
    return obstacles_clearance(rival->obstacles, into_scene(rival, p), &away);
}

static bool allows(const void *user, Vec3 p)
{
    const Rival *rival = ((const Player *)user)->rival;
    return !rival->obstacles || obstacles_allow(rival->obstacles, into_scene(rival, p));
}

// ---- turns

static void pass_turn(Contested *all)
{
    for (int i = 1; i <= all->count; i++) {
        int next = (all->turn + i) % all->count;
        if (!all->player[next].done) {
            all->round += next <= all->turn;
            all->turn = next;
            break;
        }
    }
    pthread_cond_broadcast(&all->moved);
}

// Waits with the lock held.
static void await_turn(Player *me)
{
    while (me->all->turn != me->index) {
        pthread_cond_wait(&me->all->moved, &me->all->lock);
    }
}

// Adds the nodes from `first` on, and points along the way from their parents.
static bool publish(Player *me, const OutTree *tree, int64_t first, Error *e)
{
    if (first == 0) { // a growth begins: nodes may have moved since the last one
        point_hash_clear(me->points);
        me->box = aabb_empty();
        me->node_count = 0;
        for (int i = 0; i < me->all->count; i++) {
            me->all->player[i].told[me->index] = 0;
            me->told[i] = 0;
        }
    }
    if (!memory_reserve(&me->node, &me->node_capacity, tree->count, sizeof *me->node, e)) {
        return false;
    }
    float interval = 0.5f * me->rival->gap;
    for (int64_t i = first; i < tree->count; i++) {
        Vec3 here = into_scene(me->rival, tree->position[i]);
        Vec3 from = tree->parent[i] >= 0 ? me->node[tree->parent[i]] : here;
        int64_t steps = 1 + (int64_t)fminf(vec3_distance(from, here) / interval, 1e6f);
        for (int64_t k = 1; k <= steps; k++) {
            Vec3 p = vec3_lerp(from, here, (float)k / (float)steps);
            me->box = aabb_add(me->box, p);
            if (!point_hash_add(me->points, p, e)) {
                return false;
            }
        }
        me->node[i] = here;
        me->node_count = i + 1;
    }
    return true;
}

static bool collect(Player *me, int64_t *count, Error *e)
{
    *count = 0;
    for (int i = 0; i < me->all->count; i++) {
        const Player *other = &me->all->player[i];
        int64_t from = me->told[i], more = other->node_count - from;
        if (i == me->index || more < 1) {
            continue;
        }
        if (!memory_reserve(&me->news, &me->news_capacity, *count + more, sizeof *me->news, e)) {
            return false;
        }
        for (int64_t k = from; k < other->node_count; k++) {
            me->news[(*count)++] = out_of_scene(me->rival, other->node[k]);
        }
        me->told[i] = other->node_count;
    }
    return true;
}

static bool meet(void *user, const OutTree *tree, int64_t first, const Vec3 **rival, int64_t *count,
                 Error *e)
{
    Player *me = user;
    Contested *all = me->all;
    if (!publish(me, tree, first, e)) {
        return false;
    }
    pthread_mutex_lock(&all->lock);
    pass_turn(all);
    await_turn(me);
    bool stop = all->stop;
    pthread_mutex_unlock(&all->lock);
    if (stop || !collect(me, count, e)) {
        return stop ? run_cancel_error(e) : false;
    }
    *rival = me->news;
    return true;
}

// ---- shared light

static bool give_leaves(void *user, const Vec3 *leaf, int64_t count, float area, float cell,
                        Error *e)
{
    Player *me = user;
    if (!memory_reserve(&me->leaf, &me->leaf_capacity, count, sizeof *me->leaf, e)) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        me->leaf[i] = into_scene(me->rival, leaf[i]);
    }
    me->gives = true;
    return light_stand_give(me->all->stand, me->index, me->leaf, count, area, cell, e);
}

// Nodes of a rival that gives no leaves shade as leaves do, each in the rounds after its birth.
static bool give_nodes(Player *other, const Player *me, Error *e)
{
    const int64_t *older = other->older;
    int64_t from = older[1] < other->node_count ? older[1] : other->node_count;
    float area, cell;
    light_stand_leaf(me->all->stand, me->index, &area, &cell);
    if (!light_stand_give(me->all->stand, other->index, other->node + from,
                          other->node_count - from, area, cell, e)) {
        return false;
    }
    if (!other->done) {
        other->older[1] = older[0];
        other->older[0] = other->node_count;
    }
    return true;
}

// The first of a round carries the light, before any has grown; all of the round read it.
static bool carry_light(void *user, int threads, Error *e)
{
    Player *me = user;
    Contested *all = me->all;
    if (all->lit == all->round) {
        return true;
    }
    for (int i = 0; i < all->count; i++) {
        Player *other = &all->player[i];
        if (!other->gives && !give_nodes(other, me, e)) {
            return false;
        }
    }
    all->lit = all->round;
    return light_stand_solve(all->stand, threads, e);
}

static float light(const void *user, Vec3 p)
{
    const Player *me = user;
    return light_stand_light(me->all->stand, into_scene(me->rival, p));
}

static Vec3 brightest(const void *user, Vec3 p)
{
    const Player *me = user;
    return turned_back(me->rival, light_stand_brightest(me->all->stand, into_scene(me->rival, p)));
}

static void *play(void *user)
{
    Player *me = user;
    Rival *rival = me->rival;
    pthread_mutex_lock(&me->all->lock);
    await_turn(me);
    bool stop = me->all->stop;
    pthread_mutex_unlock(&me->all->lock);
    bool grown =
        stop ? run_cancel_error(&rival->error)
             : rival->kind->grow(rival->params, &rival->recipe, &rival->whole, &rival->error);
    pthread_mutex_lock(&me->all->lock);
    me->done = true;
    me->all->stop = me->all->stop || !grown;
    pass_turn(me->all);
    pthread_mutex_unlock(&me->all->lock);
    return NULL;
}

// ---- the contest

static bool join_contest(Contested *all, int index, Rival *rival, Error *e)
{
    Player *me = &all->player[index];
    *me = (Player){.rival = rival, .all = all, .index = index, .box = aabb_empty()};
    me->room = (Room){.clearance = clearance,
                      .obstacle = rival->obstacles ? obstacle : NULL,
                      .allows = allows,
                      .meet = meet,
                      .user = me,
                      .trials = &all->trials};
    if (!rival->obstacles) { // these shade it alone
        me->room.give_leaves = give_leaves;
        me->room.carry_light = carry_light;
        me->room.light = light;
        me->room.brightest = brightest;
    }
    rival->recipe.room = &me->room;
    me->points = point_hash_new(2.0f * rival->gap, e);
    me->told = memory_alloc_zero(all->count, sizeof *me->told, e);
    return me->points && me->told;
}

static void leave_contest(Player *me)
{
    me->rival->recipe.room = NULL;
    point_hash_free(me->points);
    free(me->node);
    free(me->told);
    free(me->news);
    free(me->leaf);
}

// Starts the threads; a player whose thread does not start is done.
static bool start(Contested *all, int *started, Error *e)
{
    for (*started = 0; *started < all->count; ++*started) {
        Player *me = &all->player[*started];
        if (pthread_create(&me->thread, NULL, play, me) != 0) {
            return error_set(e, ERROR_MEMORY, "no thread for it can be started");
        }
    }
    return true;
}

static bool contend(Contested *all, Error *e)
{
    int started;
    pthread_mutex_lock(&all->lock); // nobody plays before all are there
    bool done = start(all, &started, e);
    for (int i = started; i < all->count; i++) {
        all->player[i].done = true;
    }
    all->stop = !done;
    all->turn = 0;
    pthread_mutex_unlock(&all->lock);
    for (int i = 0; i < started; i++) {
        pthread_join(all->player[i].thread, NULL);
    }
    return done;
}

static bool grow_alone(Rival *rival)
{
    Player me = {.rival = rival};
    Room room = {.clearance = clearance, .obstacle = obstacle, .allows = allows, .user = &me};
    rival->recipe.room = rival->obstacles ? &room : NULL;
    bool done = rival->kind->grow(rival->params, &rival->recipe, &rival->whole, &rival->error);
    rival->recipe.room = NULL;
    return done;
}

// The first that failed by itself.
static int find_failed(const Rival *rival, int count)
{
    for (int i = 0; i < count; i++) {
        if (rival[i].error.code != ERROR_NONE && rival[i].error.code != ERROR_CANCELLED) {
            return i;
        }
    }
    return 0;
}

bool rivals_grow(Rival *rival, int count, int *failed)
{
    *failed = 0;
    if (count == 1) {
        return grow_alone(rival);
    }
    Error *e = &rival[0].error;
    Contested all = {.count = count, .lit = -1, .lock = PTHREAD_MUTEX_INITIALIZER};
    pthread_cond_init(&all.moved, NULL);
    all.player = memory_alloc_zero(count, sizeof *all.player, e);
    all.stand = all.player ? light_stand_new(count, e) : NULL;
    bool done = all.stand;
    int joined = 0;
    for (; done && joined < count; joined++) {
        done = join_contest(&all, joined, &rival[joined], e);
    }
    done = done && contend(&all, e);
    for (int i = 0; i < joined; i++) {
        leave_contest(&all.player[i]);
    }
    free(all.player);
    free(all.trials.trial);
    light_stand_free(all.stand);
    pthread_cond_destroy(&all.moved);
    *failed = find_failed(rival, count);
    return done && !all.stop;
}
