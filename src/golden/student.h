// Student's t distribution (Boost.Math).
#ifndef RAMIFY_GOLDEN_STUDENT_H
#define RAMIFY_GOLDEN_STUDENT_H

// Probability that |T| with this many degrees of freedom (> 0, need not be an integer) exceeds |t|.
double student_two_sided(double t, double freedom);

// The |z| that a normal variable exceeds with probability p (0..1; at most 37).
double normal_of_two_sided(double p);

#endif
