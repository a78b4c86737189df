// What every cmocka program of ours starts with.
#ifndef RAMIFY_TESTS_TESTING_H
#define RAMIFY_TESTS_TESTING_H

// cmocka.h wants these first, in this order
// clang-format off
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>
// clang-format on

#endif
