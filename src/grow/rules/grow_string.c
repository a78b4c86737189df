#include "grow/rules/grow_string.h"

#include "base/memory.h"
#include "grow/lsystem/turtle.h"
#include "grow/rules/sectors.h"

#include <stdlib.h>
#include <string.h>

// Turtle state: the last direction taken, and the rotation since.
typedef struct Place {
    int32_t direction;
    TurtleFrame frame; // in (heading, left, up) components of that direction's own frame
} Place;

typedef struct Builder {
    GrowString *string;
    Place now;
    Place *stack;
    int64_t depth, capacity;
} Builder;

static const TurtleFrame STRAIGHT = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

// A node's normal is the turtle's up, its side the turtle's left.
static Vec3 heading_normal_side(Vec3 heading_left_up)
{
    return vec3(heading_left_up.x, heading_left_up.z, heading_left_up.y);
}

static bool add(GrowString *string, GrowDirection direction, Error *e)
{
    if (string->count >= INT32_MAX) {
        return error_set(e, ERROR_INPUT, "the string has more F's than can be counted");
    }
    if (!memory_reserve(&string->direction, &string->capacity, string->count + 1,
                        sizeof *string->direction, e)) {
        return false;
    }
    string->direction[string->count++] = direction;
    return true;
}

static bool forward(Builder *b, float length, Error *e)
{
    GrowDirection direction = {.heading = heading_normal_side(b->now.frame.heading),
                               .normal = heading_normal_side(b->now.frame.up),
                               .length = length,
                               .parent = b->now.direction};
    b->now = (Place){(int32_t)b->string->count, STRAIGHT};
    return add(b->string, direction, e);
}

static bool bracket(Builder *b, char symbol, int64_t place, Error *e)
{
    if (symbol == '[') {
        if (!memory_reserve(&b->stack, &b->capacity, b->depth + 1, sizeof *b->stack, e)) {
            return false;
        }
        b->stack[b->depth++] = b->now;
        return true;
    }
    if (b->depth == 0) {
        return error_set(e, ERROR_INPUT, "symbol %lld of the string, ']', closes no '['",
                         (long long)place + 1);
    }
    b->now = b->stack[--b->depth];
    return true;
}

static bool read_module(Builder *b, const ModuleString *modules, int64_t place, float degrees,
                        Error *e)
{
    char symbol = modules->module[place].symbol;
    if (symbol == 'F') {
        float length = (float)module_parameter(modules, place, 0, 1.0);
        return length > 0.0f ? forward(b, length, e)
                             : error_set(e, ERROR_INPUT,
                                         "symbol %lld of the string is F(%g); a branch's length "
                                         "must be above 0",
                                         (long long)place + 1, (double)length);
    }
    if (symbol == 'f') {
        return error_set(e, ERROR_INPUT,
                         "symbol %lld of the string, 'f', jumps; a branch can only grow (F)",
                         (long long)place + 1);
    }
    if (symbol == '$') {
        return error_set(e, ERROR_INPUT,
                         "symbol %lld of the string, '$', asks for the vertical, which a branch "
                         "that grows freely does not know; use + - & ^ \\ / |",
                         (long long)place + 1);
    }
    if (symbol == '[' || symbol == ']') {
        return bracket(b, symbol, place, e);
    }
    turtle_turn(&b->now.frame, symbol, (float)module_parameter(modules, place, 0, (double)degrees));
    return true;
}

// Reorders directions so that followers of the same one are contiguous, breadth first, in the
// string's order.
static bool sort_by_parent(GrowString *string, Error *e)
{
    int64_t count = string->count;
    GrowDirection *sorted = memory_alloc(count, sizeof *sorted, e);
    int32_t *old = memory_alloc(2 * count, sizeof *old, e), *next = old ? old + count : NULL;
    int32_t *head = memory_alloc(count, sizeof *head, e); // first follower; the others are chained
                                                          // in `next`
    if (!sorted || !old || !head) {
        free(sorted);
        free(old);
        free(head);
        return false;
    }
    memset(head, -1, (size_t)count * sizeof *head);
    for (int64_t i = count - 1; i > 0; i--) {
        int32_t parent = string->direction[i].parent;
        next[i] = head[parent];
        head[parent] = (int32_t)i;
    }
    int64_t placed = 1;
    old[0] = 0;
    sorted[0] = string->direction[0];
    for (int64_t i = 0; i < placed; i++) {
        sorted[i].first = (int32_t)placed;
        for (int32_t child = head[old[i]]; child >= 0; child = next[child]) {
            old[placed] = child;
            sorted[placed] = string->direction[child];
            sorted[placed++].parent = (int32_t)i;
        }
        sorted[i].followers = (int32_t)placed - sorted[i].first;
        if (sorted[i].followers > string->most_followers) {
            string->most_followers = sorted[i].followers;
        }
    }
    memcpy(string->direction, sorted, (size_t)count * sizeof *sorted);
    free(sorted);
    free(old);
    free(head);
    return true;
}

static bool check(const Builder *b, Error *e)
{
    const GrowString *string = b->string;
    if (b->depth > 0) {
        return error_set(e, ERROR_INPUT, "the string leaves %lld '[' open; close them with ']'",
                         (long long)b->depth);
    }
    if (string->count < 2) {
        return error_set(e, ERROR_INPUT, "the string has no F, so that nothing can grow");
    }
    return string->most_followers <= MAX_SECTORS ||
           error_set(e, ERROR_INPUT,
                     "the string branches into %d directions at once; at most %d are possible",
                     string->most_followers, MAX_SECTORS);
}

bool grow_string_init(GrowString *string, const ModuleString *modules, float degrees, Error *e)
{
    *string = (GrowString){0};
    Builder b = {.string = string, .now = {0, STRAIGHT}};
    bool done =
        add(string, (GrowDirection){.heading = {1, 0, 0}, .normal = {0, 1, 0}, .length = 1.0f}, e);
    for (int64_t i = 0; done && i < modules->count; i++) {
        done = read_module(&b, modules, i, degrees, e);
    }
    done = done && sort_by_parent(string, e) && check(&b, e);
    free(b.stack);
    if (!done) {
        grow_string_clear(string);
    }
    return done;
}

void grow_string_clear(GrowString *string)
{
    free(string->direction);
    *string = (GrowString){0};
}
