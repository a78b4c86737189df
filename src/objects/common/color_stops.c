// Scales of colours.
#include "objects/common/tables.h"

#include <stdio.h>

static const Key STOP_KEYS[] = {
    {KEY_OF(ColorStop, at, "at", KEY_FLOAT), .flags = KEY_REQUIRED, .high = 1,
     .doc = "Altitude, as a fraction of the land's relief."},
    {KEY_OF(ColorStop, color, "color", KEY_COLOR), .flags = KEY_REQUIRED, .high = 1,
     .doc = "Reflectance there."},
    {0},
};

const Table color_stop_table = {.name = "color_stop",
                                .doc = "A point of a scale of colours.",
                                .size = sizeof(ColorStop),
                                .keys = STOP_KEYS};

bool check_color_stops(const Mapping *mapping, const ColorStop *stops, int count)
{
    for (int i = 1; i < count; i++) {
        if (stops[i].at <= stops[i - 1].at) {
            char key[32];
            snprintf(key, sizeof key, "colors.%d", i);
            return mapping_fail(mapping, key,
                                " is at the altitude %g, the one before it at %g; altitudes must "
                                "ascend",
                                (double)stops[i].at, (double)stops[i - 1].at);
        }
    }
    return true;
}
