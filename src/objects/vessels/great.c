// The great arteries and veins of a body along their courses, from which growth starts.
#include "base/random.h"
#include "objects/vessels/courses.h"
#include "objects/vessels/stem.h"

#define NODE_SPACING 0.006f // of the height

float vessels_aorta_radius(const Shape *body)
{
    Vec3 up = transform_vector(&body->transform, vec3(0, body->size.x, 0));
    return 0.0066f * vec3_length(up);
}

typedef struct Planting {
    OutTree *tree;
    const Shape *body;
    int32_t colony;
    // nodes of each course's points, left and right
    int64_t node[MOST_COURSES][2][MOST_COURSE_POINTS + 1];
} Planting;

static Vec3 place(const Planting *p, Vec3 at)
{
    return transform_point(&p->body->transform, vec3_scale(at, p->body->size.x));
}

// Interpolates between b and c, with slopes from their neighbours (Catmull-Rom).
static Vec3 between(Vec3 a, Vec3 b, Vec3 c, Vec3 d, float t)
{
    Vec3 m0 = vec3_scale(vec3_sub(c, a), 0.5f), m1 = vec3_scale(vec3_sub(d, b), 0.5f);
    float t2 = t * t, t3 = t2 * t;
    Vec3 p = vec3_scale(b, 2.0f * t3 - 3.0f * t2 + 1.0f);
    p = vec3_madd(p, t3 - 2.0f * t2 + t, m0);
    p = vec3_madd(p, -2.0f * t3 + 3.0f * t2, c);
    return vec3_madd(p, t3 - t2, m1);
}

// Adds the nodes of one course on one side; point[0] is where it starts, `from` a point before
// that.
static bool follow(Planting *p, const Vec3 *point, int count, Vec3 from, int64_t parent,
                   int64_t *node, uint64_t id, Error *e)
{
    for (int i = 0; i + 1 < count; i++) {
        Vec3 before = i > 0 ? point[i - 1] : from, after = point[i + 2 < count ? i + 2 : count - 1];
        int pieces = (int)(vec3_distance(point[i], point[i + 1]) / NODE_SPACING) + 1;
        for (int k = 1; k <= pieces; k++) {
            float t = (float)k / (float)pieces;
            Vec3 at = place(p, between(before, point[i], point[i + 1], after, t));
            int32_t birth = p->tree->birth[parent] + 1;
            parent = out_tree_add_node(p->tree, at, parent, birth, p->colony, id, e);
            if (parent < 0) {
                return false;
            }
            id = out_tree_child_id(id, 0);
        }
        node[i + 1] = parent;
    }
    return true;
}

static Vec3 to_vec3(const float at[3], bool right)
{
    return vec3(right ? -at[0] : at[0], at[1], at[2]);
}

// A point before the first of a branch, so that it leaves between its mother's direction and its
// own; the first point itself if it leaves against her direction. last: her point before it, or
// herself, if she begins there.
static Vec3 point_before(Vec3 last, Vec3 first, Vec3 next)
{
    Vec3 along = vec3_normalize(vec3_sub(first, last)), own = vec3_sub(next, first);
    bool with_flow = vec3_dot(along, own) > 0.0f; // false for a mother that begins here
    return with_flow ? vec3_madd(first, -vec3_length(own), along) : first;
}

static bool plant_course(Planting *p, const Course *courses, int number, bool right, uint64_t seed,
                         Error *e)
{
    const Course *course = &courses[number];
    Vec3 point[MOST_COURSE_POINTS + 1];
    Vec3 before = to_vec3(course->point[0], right);
    int count = 0;
    int64_t *node = p->node[number][right], parent;
    uint64_t id = random_key(random_key(seed, (uint64_t)number), right);
    if (course->from_course < 0) {
        point[count++] = to_vec3(course->point[0], right);
        parent = out_tree_add_node(p->tree, place(p, point[0]), -1, 0, p->colony, id, e);
        if (parent < 0) {
            return false;
        }
        id = out_tree_child_id(id, 0);
    } else {
        bool other = right && (course->right_course > 0 || course->right_point > 0);
        int mother = other ? course->right_course : course->from_course;
        int at = other ? course->right_point : course->from_point;
        const Course *from = &courses[mother];
        bool side = right && from->both_sides;
        parent = p->node[mother][side][at];
        if (right && !other && !side && at + 1 < from->count) {
            // both sides leave the middle one after the other, because forks are binary
            parent = p->tree->parent[p->tree->parent[parent]];
        }
        point[count++] = to_vec3(from->point[at], side);
        before = to_vec3(from->point[at > 0 ? at - 1 : 0], side);
    }
    node[0] = parent;
    for (int i = course->from_course < 0; i < course->count; i++) {
        point[count++] = to_vec3(course->point[i], right);
    }
    before = point_before(before, point[0], point[1]);
    if (!follow(p, point, count, before, parent, node, id, e)) {
        return false;
    }
    if (course->from_course >= 0) { // index the points as in the table, without the first
        for (int i = 0; i + 1 < count; i++) {
            node[i] = node[i + 1];
        }
    }
    return true;
}

bool vessels_plant_great(OutTree *tree, const Shape *body, int32_t colony, uint64_t seed, Error *e)
{
    Planting p = {.tree = tree, .body = body, .colony = colony};
    int count;
    const Course *courses = vessels_courses(colony == VESSELS_VEINS, &count);
    uint64_t key = random_key(seed, (uint64_t)colony);
    for (int i = 0; i < count; i++) {
        for (int right = 0; right < (courses[i].both_sides ? 2 : 1); right++) {
            if (!plant_course(&p, courses, i, right, key, e)) {
                return false;
            }
        }
    }
    return true;
}
