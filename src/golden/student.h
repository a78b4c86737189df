// Student's t distribution (Boost.Math).
#ifndef RAMIFY_GOLDEN_STUDENT_H
#define RAMIFY_GOLDEN_STUDENT_H

// Probability that |T| of so many degrees of freedom (> 0; need not be whole) exceeds |t|.
double student_two_sided(double t, double freedom);

// |z| of a normal variable that exceeds it as seldom as p says (0..1; at most 37 comes out).
double normal_of_two_sided(double p);

#endif
