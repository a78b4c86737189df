#include "config/scalar.h"

#include "base/exact_math.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define LONGEST 64

// Copies text without the underscores between digits; false when it is too long or has other ones.
static bool strip_underscores(const char *text, char *out)
{
    size_t used = 0;
    for (size_t i = 0; text[i]; i++) {
        if (text[i] == '_') {
            if (i == 0 || !isalnum((unsigned char)text[i - 1]) ||
                !isalnum((unsigned char)text[i + 1])) {
                return false;
            }
            continue;
        }
        if (used + 1 >= LONGEST) {
            return false;
        }
        out[used++] = text[i];
    }
    out[used] = 0;
    return used > 0;
}

static bool special_number(const char *text, double *value)
{
    double sign = *text == '-' ? -1.0 : 1.0;
    text += *text == '-' || *text == '+';
    text += *text == '.';
    if (strcasecmp(text, "nan") == 0) {
        *value = NAN;
        return true;
    }
    *value = sign * INFINITY;
    return strcasecmp(text, "inf") == 0 || strcasecmp(text, "infinity") == 0;
}

static bool is_hexadecimal(const char *digits)
{
    return digits[0] == '0' && (digits[1] == 'x' || digits[1] == 'X');
}

bool scalar_number(const char *text, double *value)
{
    char number[LONGEST];
    if (special_number(text, value)) {
        return true;
    }
    if (!strip_underscores(text, number)) {
        return false;
    }
    const char *digits = number + (*number == '-' || *number == '+');
    if (is_hexadecimal(digits)) {
        bool negative, too_large;
        uint64_t magnitude;
        bool valid = scalar_integer(text, &negative, &magnitude, &too_large);
        *value = negative ? -(double)magnitude : (double)magnitude;
        return valid;
    }
    if (!isdigit((unsigned char)*digits) &&
        !(*digits == '.' && isdigit((unsigned char)digits[1]))) {
        return false;
    }
    if (*digits == '0' && isdigit((unsigned char)digits[1])) {
        return false; // ambiguous: octal in YAML 1.1, but decimal to most readers
    }
    char *end;
    *value = strtod(number, &end);
    return *end == 0;
}

bool scalar_integer(const char *text, bool *negative, uint64_t *magnitude, bool *too_large)
{
    char number[LONGEST];
    *too_large = *negative = false;
    *magnitude = 0;
    if (!strip_underscores(text, number)) {
        return false;
    }
    *negative = *number == '-';
    const char *digits = number + (*number == '-' || *number == '+');
    bool hexadecimal = is_hexadecimal(digits);
    if (hexadecimal ? isxdigit((unsigned char)digits[2])
                    : isdigit((unsigned char)*digits) &&
                          !(*digits == '0' && isdigit((unsigned char)digits[1]))) {
        char *end;
        errno = 0;
        *magnitude = strtoull(digits, &end, hexadecimal ? 16 : 10);
        *too_large = errno == ERANGE && *end == 0;
        if (*end == 0) {
            return !*too_large;
        }
    }
    double value;
    if (hexadecimal || !scalar_number(text, &value) || !(floor(value) == value)) {
        return false;
    }
    *too_large = !(fabs(value) <= 9007199254740992.0);
    *negative = value < 0.0;
    *magnitude = *too_large ? 0 : (uint64_t)fabs(value);
    return !*too_large;
}

bool scalar_truth(const char *text, bool *value)
{
    static const char *const words[] = {"true", "True", "TRUE", "yes",   "Yes",   "YES",
                                        "on",   "On",   "ON",   "false", "False", "FALSE",
                                        "no",   "No",   "NO",   "off",   "Off",   "OFF"};
    for (int i = 0; i < 18; i++) {
        if (strcmp(text, words[i]) == 0) {
            *value = i < 9;
            return true;
        }
    }
    return false;
}

void scalar_from_float(float value, char *text)
{
    for (int digits = 6; digits <= 9; digits++) {
        snprintf(text, 32, "%.*g", digits, (double)value);
        if (strtof(text, NULL) == value) {
            return;
        }
    }
}

void scalar_from_double(double value, char *text)
{
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(text, 32, "%.*g", digits, value);
        if (strtod(text, NULL) == value) {
            return;
        }
    }
}

// IEC 61966-2-1, 8 bits to linear.
static float linear_from_srgb(int byte)
{
    float x = (float)byte / 255.0f;
    return x <= 0.04045f ? x / 12.92f : exact_pow((x + 0.055f) / 1.055f, 2.4f);
}

bool scalar_color(const char *text, float rgb[3])
{
    unsigned bits;
    int read = 0;
    if (strlen(text) != 7 || text[0] != '#' || strspn(text + 1, "0123456789abcdefABCDEF") != 6 ||
        sscanf(text, "#%6x%n", &bits, &read) != 1 || read != 7) { // NOLINT
        return false;
    }
    for (int i = 0; i < 3; i++) {
        rgb[i] = linear_from_srgb((int)(bits >> (16 - 8 * i) & 255));
    }
    return true;
}
