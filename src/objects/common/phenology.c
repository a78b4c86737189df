#include "objects/common/phenology.h"

#include "base/vec.h"
#include "config/load.h"

// Spring comes 4 days later per degree of latitude (Hopkins 1918, Periodical events and natural
// law); autumn earlier by about half of that (Gill et al. 2015, Annals of Botany 116).
#define SPRING_DELAY (4.0f / 30.4f) // months per degree
#define AUTUMN_DELAY (-2.0f / 30.4f)
#define REFERENCE_LATITUDE 50.0f
#define MOST_SHIFT 2.0f // months
#define MIDSUMMER 7.0f  // when neither counts

static const Key PHENOLOGY_KEYS[] = {
    {KEY_OF(Phenology, leafing, "leafing", KEY_VECTOR), .count = 2, .low = 1, .high = 13,
     .unit = "months",
     .doc = "When leaves unfold: from the first open buds to grown leaves; 4.5 = middle of April."},
    {KEY_OF(Phenology, turning, "turning", KEY_VECTOR), .count = 2, .low = 1, .high = 13,
     .unit = "months", .doc = "When leaves turn colour, from the first to the last."},
    {KEY_OF(Phenology, falling, "falling", KEY_VECTOR), .count = 2, .low = 1, .high = 13,
     .unit = "months", .doc = "When leaves fall, from the first to the last."},
    {KEY_OF(Phenology, evergreen, "evergreen", KEY_BOOL),
     .doc = "Leaves stay green all year; the times do not count."},
    {0},
};

static bool check_phenology(const Mapping *mapping, void *params)
{
    const Phenology *p = params;
    const struct {
        const char *key;
        const float *span;
        float after;
    } spans[] = {{"leafing", p->leafing, 0.0f},
                 {"turning", p->turning, p->leafing[1]},
                 {"falling", p->falling, p->turning[0]}};
    for (int i = 0; i < 3; i++) {
        if (!(spans[i].span[0] < spans[i].span[1])) {
            return mapping_fail(mapping, spans[i].key, " must begin before it ends, in one year");
        }
        if (spans[i].span[0] < spans[i].after) {
            return mapping_fail(mapping, spans[i].key,
                                " begins too early; the order is leafing, turning, falling");
        }
    }
    return true;
}

const Table phenology_table = {
    .name = "phenology",
    .doc = "The year of the leaves at 50 degrees north, as the tree's season uses it. Times are "
           "months: 1 = begin of January, 4.5 = middle of April.",
    .example =
        "objects:\n"
        "  - name: larch\n"
        "    tree:\n"
        "      season: 10.7\n"
        "      phenology: {leafing: [4.2, 5.2], turning: [10.2, 11], falling: [10.8, 11.6]}\n",
    .size = sizeof(Phenology),
    .keys = PHENOLOGY_KEYS,
    .check = check_phenology};

Phenology phenology_default(void)
{
    return (Phenology){{4.6f, 5.6f}, {9.8f, 10.9f}, {10.3f, 11.7f}, false};
}

float phenology_time(float season, float latitude)
{
    if (season == 0.0f) {
        return 0.0f;
    }
    float time = latitude < 0.0f ? (season < 7.0f ? season + 6.0f : season - 6.0f) : season;
    float north = latitude < 0.0f ? -latitude : latitude;
    float delay = time < MIDSUMMER ? SPRING_DELAY : AUTUMN_DELAY;
    float way = smoothstepf(0.0f, 2.0f, time < MIDSUMMER ? MIDSUMMER - time : time - MIDSUMMER);
    float shift = clampf((north - REFERENCE_LATITUDE) * delay, -MOST_SHIFT, MOST_SHIFT);
    return clampf(time - way * shift, 1.0f, 13.0f);
}

bool phenology_is_within(const float span[2], float time)
{
    if (time == 0.0f || (span[0] == 0.0f && span[1] == 0.0f)) {
        return true;
    }
    return span[0] <= span[1] ? span[0] <= time && time <= span[1]
                              : time >= span[0] || time <= span[1];
}

static float share(float time, float begin, float end)
{
    return clampf((time - begin) / (end - begin), 0.0f, 1.0f);
}

void phenology_apply(const Phenology *phenology, float season, float latitude, LeavesParams *leaves)
{
    leaves->emergence = 1.0f;
    leaves->autumn = leaves->fall = leaves->litter = 0.0f;
    if (phenology->evergreen) {
        return;
    }
    float time = phenology_time(season, latitude);
    const float *leafing = phenology->leafing, *turning = phenology->turning;
    const float *falling = phenology->falling;
    if (time >= leafing[0]) {
        leaves->emergence = share(time, leafing[0], leafing[1]);
        leaves->autumn = share(time, turning[0], turning[1]);
        leaves->fall = share(time, falling[0], falling[1]);
        leaves->litter = 1.0f;
    } else { // last year's leaves, which rot until the new ones come
        leaves->autumn = leaves->fall = 1.0f;
        leaves->litter = 1.0f - share(time, 1.0f, leafing[0]);
    }
}

bool phenology_check(const Mapping *mapping, const Phenology *phenology, float season,
                     float latitude, LeavesParams *leaves)
{
    if (season > 0.0f && season < 1.0f) {
        return mapping_fail(mapping, "season",
                            " is %g; months begin at 1, and 0 means that leaves tell the season",
                            (double)season);
    }
    if (season > 0.0f) {
        phenology_apply(phenology, season, latitude, leaves);
    }
    return true;
}
