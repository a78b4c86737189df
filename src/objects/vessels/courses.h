// Courses of a body's great arteries and veins through its trunk and limbs, to fingers and toes.
#ifndef RAMIFY_OBJECTS_VESSELS_COURSES_H
#define RAMIFY_OBJECTS_VESSELS_COURSES_H

#include <stdbool.h>

enum { MOST_COURSES = 20, MOST_COURSE_POINTS = 14 };

// In a body of height 1 (see shape/body.h): the body's left is +x.
typedef struct Course {
    int from_course, from_point;   // where it branches from another; -1 = the heart
    int right_course, right_point; // where the right one branches if elsewhere; 0 = as the left
    bool both_sides;               // this is the left one; the right mirrors it
    int count;
    float point[MOST_COURSE_POINTS][3];
} Course;

// The arteries' or the veins' courses, the one from the heart first; *count of them, at most
// MOST_COURSES. Static.
const Course *vessels_courses(bool veins, int *count);

#endif
