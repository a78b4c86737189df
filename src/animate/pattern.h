// File names of frames: "oak-%04d.png" contains the frame's number. User-supplied patterns are
// parsed here and never passed to printf.
#ifndef RAMIFY_ANIMATE_PATTERN_H
#define RAMIFY_ANIMATE_PATTERN_H

#include "base/error.h"

// Checks that the pattern has exactly one number: %d, %Nd or %0Nd with N from 1 to 9; %% is a
// percent sign. ERROR_INPUT says what is wrong.
bool pattern_check(const char *pattern, Error *e);

// The file name of a frame, heap text; pattern must have passed pattern_check.
char *pattern_name(const char *pattern, int frame, Error *e);

#endif
