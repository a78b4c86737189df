#include "config/hint.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LONGEST 64
#define MOST_LISTED 24

static int least(int a, int b)
{
    return a < b ? a : b;
}

int hint_distance(const char *a, const char *b)
{
    int n = (int)strnlen(a, LONGEST), m = (int)strnlen(b, LONGEST);
    if (n >= LONGEST || m >= LONGEST) {
        return 2 * LONGEST;
    }
    int cost[LONGEST + 1][LONGEST + 1]; // optimal string alignment
    for (int i = 0; i <= n; i++) {
        for (int j = 0; j <= m; j++) {
            if (i == 0 || j == 0) {
                cost[i][j] = i + j;
                continue;
            }
            int replaced = cost[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            cost[i][j] = least(replaced, 1 + least(cost[i - 1][j], cost[i][j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                cost[i][j] = least(cost[i][j], cost[i - 2][j - 2] + 1);
            }
        }
    }
    return cost[n][m];
}

int hint_nearest(const char *word, const char *const *known, int count)
{
    int nearest = -1;
    // Up to a third of the letters may differ, but at least one, or two in words of four or more.
    int length = (int)strnlen(word, LONGEST), limit = length < 4 ? 1 : 2 + (length - 4) / 5;
    for (int i = 0; i < count; i++) {
        int longer = (int)strnlen(known[i], LONGEST) - length; // each letter more is a change
        int distance = abs(longer) <= limit ? hint_distance(word, known[i]) : LONGEST;
        if (distance <= limit) {
            limit = distance - 1;
            nearest = i;
        }
    }
    return nearest;
}

void hint_list(const char *const *known, int count, char *text, int size)
{
    int used = 0;
    text[0] = 0;
    for (int i = 0; i < count && used < size; i++) {
        if (i == MOST_LISTED) {
            snprintf(text + used, (size_t)(size - used), ", ...");
            return;
        }
        used += snprintf(text + used, (size_t)(size - used), "%s%s", i ? ", " : "", known[i]);
    }
}

void hint_format(const char *word, const char *const *known, int count, char *text, int size)
{
    int nearest = hint_nearest(word, known, count);
    if (nearest >= 0) {
        snprintf(text, (size_t)size, "did you mean '%s'?", known[nearest]);
    } else if (count == 0) {
        snprintf(text, (size_t)size, "nothing is known here");
    } else {
        char list[512];
        hint_list(known, count, list, sizeof list);
        snprintf(text, (size_t)size, "known: %s", list);
    }
}
