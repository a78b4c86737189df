#include "grow/lsystem/turtle.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

enum { CHECK_EVERY = 65536 };

// Heading up (+Y), back to +Z: plane drawings rotate in the plane z = 0.
static TurtleFrame frame_default(void)
{
    return (TurtleFrame){{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}};
}

TurtleParams turtle_params_default(void)
{
    return (TurtleParams){.step = 1.0f, .angle = 30.0f, .shrink = 1.0f, .seed = 1};
}

// Re-orthonormalises the frame about its heading.
static TurtleFrame frame_clean(TurtleFrame frame)
{
    Vec3 h = vec3_normalize(frame.heading);
    Vec3 up = vec3_madd(frame.up, -vec3_dot(frame.up, h), h);
    up = vec3_dot(up, up) > 1e-12f ? vec3_normalize(up) : vec3_perpendicular(h);
    return (TurtleFrame){h, vec3_cross(up, h), up};
}

static TurtleFrame turn_about(TurtleFrame frame, Vec3 axis, float radians)
{
    float s, c;
    exact_sincos(radians, &s, &c);
    return frame_clean((TurtleFrame){vec3_rotate(frame.heading, axis, c, s),
                                     vec3_rotate(frame.left, axis, c, s),
                                     vec3_rotate(frame.up, axis, c, s)});
}

// Rolls until L is horizontal and U points up; a vertical turtle is unchanged.
static TurtleFrame level(TurtleFrame frame)
{
    Vec3 left = vec3_cross(vec3(0, 1, 0), frame.heading);
    if (vec3_dot(left, left) < 1e-10f) {
        return frame;
    }
    left = vec3_normalize(left);
    return (TurtleFrame){frame.heading, left, vec3_cross(frame.heading, left)};
}

bool turtle_turn(TurtleFrame *frame, char symbol, float degrees)
{
    float radians = degrees * RADIANS_PER_DEGREE;
    switch (symbol) {
    case '+':
        *frame = turn_about(*frame, frame->up, radians);
        return true;
    case '-':
        *frame = turn_about(*frame, frame->up, -radians);
        return true;
    case '&':
        *frame = turn_about(*frame, frame->left, radians);
        return true;
    case '^':
        *frame = turn_about(*frame, frame->left, -radians);
        return true;
    case '\\':
        *frame = turn_about(*frame, frame->heading, -radians);
        return true;
    case '/':
        *frame = turn_about(*frame, frame->heading, radians);
        return true;
    case '|':
        frame->heading = vec3_neg(frame->heading);
        frame->left = vec3_neg(frame->left);
        return true;
    case '$':
        *frame = level(*frame);
        return true;
    default:
        return false;
    }
}

typedef struct Turtle {
    TurtleFrame frame;
    Vec3 position;
    float width;
    int64_t node; // current node; -1 before drawing and after a jump
} Turtle;

typedef struct Drawing {
    const ModuleString *string;
    const TurtleParams *params;
    OutTree *tree;
    Turtle now;
    Turtle *stack;
    int64_t depth, stack_capacity;
    int32_t *children; // number of children, per node
    int64_t children_capacity;
    int64_t roots;
} Drawing;

static int64_t add_node(Drawing *d, Vec3 position, int64_t parent, Error *e)
{
    OutTree *tree = d->tree;
    uint64_t id = parent >= 0 ? out_tree_child_id(tree->id[parent], d->children[parent]++)
                              : random_key(d->params->seed, (uint64_t)d->roots++);
    int32_t birth = parent >= 0 ? tree->birth[parent] + 1 : 0;
    int64_t node = out_tree_add_node(tree, position, parent, birth, 0, id, e);
    if (node < 0 ||
        !memory_reserve(&d->children, &d->children_capacity, node + 1, sizeof *d->children, e)) {
        return -1;
    }
    d->children[node] = 0;
    tree->normal[node] = d->now.frame.up;
    tree->radius[node] = 0.5f * d->now.width;
    return node;
}

// Bends toward the tropism vector (Lindenmayer 1968, The Algorithmic Beauty of Plants 2.1).
static void bend(Drawing *d)
{
    const TurtleParams *p = d->params;
    Vec3 axis = vec3_cross(d->now.frame.heading, p->tropism);
    float length = vec3_length(axis);
    if (p->elasticity != 0.0f && length > 1e-9f) {
        d->now.frame =
            turn_about(d->now.frame, vec3_scale(axis, 1.0f / length), p->elasticity * length);
    }
}

static bool move(Drawing *d, float length, bool draws, Error *e)
{
    Turtle *turtle = &d->now;
    if (draws && turtle->node < 0) {
        turtle->node = add_node(d, turtle->position, -1, e);
        if (turtle->node < 0) {
            return false;
        }
    }
    turtle->position = vec3_madd(turtle->position, length, turtle->frame.heading);
    if (!vec3_finite(turtle->position)) {
        return error_set(e, ERROR_INPUT, "the turtle walks out of all bounds; shorten its steps");
    }
    turtle->node = draws ? add_node(d, turtle->position, turtle->node, e) : -1;
    bend(d);
    return !draws || turtle->node >= 0;
}

static bool push(Drawing *d, Error *e)
{
    if (!memory_reserve(&d->stack, &d->stack_capacity, d->depth + 1, sizeof *d->stack, e)) {
        return false;
    }
    d->stack[d->depth++] = d->now;
    return true;
}

static bool pop(Drawing *d, int64_t place, Error *e)
{
    if (d->depth == 0) {
        return error_set(e, ERROR_INPUT, "symbol %lld of the string, ']', closes no '['",
                         (long long)place + 1);
    }
    d->now = d->stack[--d->depth];
    return true;
}

static bool interpret(Drawing *d, int64_t place, Error *e)
{
    const TurtleParams *p = d->params;
    char symbol = d->string->module[place].symbol;
    float length = p->step * (float)module_parameter(d->string, place, 0, 1.0);
    switch (symbol) {
    case 'F':
        return move(d, length, true, e);
    case 'f':
        return move(d, length, false, e);
    case '[':
        return push(d, e);
    case ']':
        return pop(d, place, e);
    case '!':
        d->now.width =
            (float)module_parameter(d->string, place, 0, (double)(d->now.width * p->shrink));
        return true;
    default:
        break;
    }
    float degrees = (float)module_parameter(d->string, place, 0, (double)p->angle);
    if (p->noise > 0.0f) {
        degrees += p->noise * random_normal(random_key(p->seed, (uint64_t)place));
    }
    turtle_turn(&d->now.frame, symbol, degrees);
    return true;
}

static bool draw(Drawing *d, const Run *run, Error *e)
{
    for (int64_t i = 0; i < d->string->count; i++) {
        if (i % CHECK_EVERY == 0 && run_is_cancelled(run)) {
            return run_cancel_error(e);
        }
        if (!interpret(d, i, e)) {
            return false;
        }
    }
    if (d->depth > 0) {
        return error_set(e, ERROR_INPUT, "the string leaves %lld '[' open; close them with ']'",
                         (long long)d->depth);
    }
    return d->tree->count > 0 ||
           error_set(e, ERROR_INPUT, "the string draws nothing; it needs an F");
}

OutTree *turtle_draw(const ModuleString *string, const TurtleParams *params, const Run *run,
                     Error *e)
{
    Drawing d = {.string = string,
                 .params = params,
                 .tree = out_tree_new(e),
                 .now = {frame_default(), params->position, params->width, -1}};
    bool done = d.tree && draw(&d, run, e);
    free(d.stack);
    free(d.children);
    if (!done) {
        out_tree_free(d.tree);
        return NULL;
    }
    return d.tree;
}
