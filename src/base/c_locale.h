// Decimal points in numbers read and written, whatever the language of the calling program.
#ifndef RAMIFY_BASE_C_LOCALE_H
#define RAMIFY_BASE_C_LOCALE_H

#include "base/error.h"

#include <locale.h>

typedef struct CLocale {
    locale_t own, before;
} CLocale;

// Puts the calling thread into the C locale. ERROR_MEMORY; then there is nothing to leave.
bool c_locale_enter(CLocale *locale, Error *e);

// Back to the locale before.
void c_locale_leave(CLocale *locale);

#endif
