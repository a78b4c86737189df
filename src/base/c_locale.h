// Switches a thread to the C locale, so that numbers are read and written with decimal points.
#ifndef RAMIFY_BASE_C_LOCALE_H
#define RAMIFY_BASE_C_LOCALE_H

#include "base/error.h"

#include <locale.h>

typedef struct CLocale {
    locale_t own, before;
} CLocale;

// Puts the calling thread into the C locale. On ERROR_MEMORY there is nothing to leave.
bool c_locale_enter(CLocale *locale, Error *e);

// Restores the previous locale.
void c_locale_leave(CLocale *locale);

#endif
