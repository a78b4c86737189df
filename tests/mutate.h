// Broken copies of sound files, the same for the same key: for tests of what reads them.
#ifndef RAMIFY_TESTS_MUTATE_H
#define RAMIFY_TESTS_MUTATE_H

#include "base/random.h"

#include <ctype.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

// Puts text in the place of the bytes [from, to), as far as it fits into capacity.
static inline size_t mutate_replace(unsigned char *data, size_t size, size_t capacity, size_t from,
                                    size_t to, const void *text, size_t length)
{
    if (size - (to - from) + length > capacity) {
        return size;
    }
    memmove(data + from + length, data + to, size - to);
    memcpy(data + from, text, length);
    return size - (to - from) + length;
}

// One change at a place: a bit, a byte, a digit, a number for a strange one, a piece gone or twice.
static inline size_t mutate_once(unsigned char *data, size_t size, size_t capacity, uint64_t draw)
{
    static const char *const strange[] = {"nan",  "-inf", "1e999", "-1", "4294967296", "1e-320",
                                          "0x10", "--",   "",      "0",  "2147483647", "9e18"};
    size_t at = (size_t)(draw >> 20) % size, end = at;
    unsigned char piece[64];
    switch (draw % 6) {
    case 0:
        data[at] = (unsigned char)(data[at] ^ (1 << (draw >> 8) % 8));
        return size;
    case 1:
        data[at] = (unsigned char)(draw >> 8);
        return size;
    case 2:
        data[at] = isdigit(data[at]) ? (unsigned char)"0123456789-e."[(draw >> 8) % 13] : data[at];
        return size;
    case 3:
        while (at < size && !isdigit(data[at])) {
            at++;
        }
        for (end = at; end < size && (isalnum(data[end]) || data[end] == '.');) {
            end++;
        }
        const char *word = strange[(draw >> 8) % (sizeof strange / sizeof strange[0])];
        return mutate_replace(data, size, capacity, at, end, word, strlen(word));
    default:
        end = at + (size_t)(draw >> 8) % sizeof piece;
        end = end < size ? end : size;
        memcpy(piece, data + at, end - at);
        return mutate_replace(data, size, capacity, at, draw % 6 == 4 ? end : at, piece,
                              draw % 6 == 4 ? 0 : end - at);
    }
}

// Cuts data off or changes it in up to eight places; returns the size it has then.
static inline size_t mutate(unsigned char *data, size_t size, size_t capacity, uint64_t key)
{
    if (random_key(key, 0) % 8 == 0) {
        return (size_t)(random_key(key, 1) % size);
    }
    int changes = 1 + (int)(random_key(key, 2) % 8);
    for (int i = 0; i < changes && size > 0; i++) {
        size = mutate_once(data, size, capacity, random_key(key, 10 + (uint64_t)i));
    }
    return size;
}

#endif
