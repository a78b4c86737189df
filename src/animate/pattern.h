// Names of frames' files: "oak-%04d.png" with the frame's number in it. What the user writes is
// read here alone and never handed to printf.
#ifndef RAMIFY_ANIMATE_PATTERN_H
#define RAMIFY_ANIMATE_PATTERN_H

#include "base/error.h"

// Holds exactly one number: %d, or %Nd and %0Nd with 1 to 9 digits at least; %% stands for a
// percent sign. ERROR_INPUT says what is wrong.
bool pattern_check(const char *pattern, Error *e);

// The name of a frame's file on the heap; pattern must have passed pattern_check.
char *pattern_name(const char *pattern, int frame, Error *e);

#endif
