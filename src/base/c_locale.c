#include "base/c_locale.h"

bool c_locale_enter(CLocale *locale, Error *e)
{
    locale->own = newlocale(LC_ALL_MASK, "C", NULL);
    if (!locale->own) {
        return error_set(e, ERROR_MEMORY, "out of memory for the C locale");
    }
    locale->before = uselocale(locale->own);
    return true;
}

void c_locale_leave(CLocale *locale)
{
    uselocale(locale->before);
    freelocale(locale->own);
}
