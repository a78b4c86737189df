#include "objects/ground/pond.h"

#include "base/exact_math.h"
#include "base/noise.h"
#include "base/random.h"
#include "config/table.h"

enum { STREAM_BAYS = 1, STREAM_NOTCHES = 2, STREAM_RIM = 3 }; // of a pond
#define BANKS 0.6f // width of the banks, as a share of the distance to the shore
#define BAYS 0.55f // of the radius: of the largest bays; of the notches in them
#define NOTCHES 0.05f

Pond pond_default(void)
{
    return (Pond){.radius = 5.0f, .depth = 1.0f, .bank = 0.15f, .irregularity = 0.5f};
}

float pond_reach(const Pond *pond)
{
    return (1.0f + (BAYS + NOTCHES) * pond->irregularity) * pond->radius * (1.0f + BANKS);
}

float pond_shore(const Pond *pond, uint64_t seed, float x, float z)
{
    float wide = 1.3f, fine = 1.5f * pond->radius; // notches of about a metre
    float bays = noise_plane_fractal(wide * x, wide * z, 3, random_key(seed, STREAM_BAYS));
    float notches = noise_plane_fractal(fine * x, fine * z, 3, random_key(seed, STREAM_NOTCHES));
    float share = BAYS * clampf(bays, -1.0f, 1.0f) + NOTCHES * clampf(notches, -1.0f, 1.0f);
    return pond->radius * (1.0f + pond->irregularity * share);
}

float pond_share(const Pond *pond, uint64_t seed, float x, float z)
{
    float dx = x - pond->position[0], dz = z - pond->position[1];
    float r = sqrtf(dx * dx + dz * dz);
    return r > 1e-6f * pond->radius ? r / pond_shore(pond, seed, dx / r, dz / r) : 0.0f;
}

// A shelf along the shore that falls gently, then a bowl. On a slope the land below the water's
// level is raised to a dam.
float pond_height(const PondSite *site, float x, float z, float land)
{
    const Pond *pond = site->pond;
    float share = pond_share(pond, site->seed, x, z);
    if (share < 1.0f) {
        float bowl = 1.0f - share * share;
        return site->level - pond->depth * bowl * (0.35f + 0.65f * bowl);
    }
    float out = (share - 1.0f) / BANKS, left = 1.0f - out;
    if (left <= 0.0f) {
        return land;
    }
    float rise = land - site->level, least = 0.5f * pond->bank;
    rise += rise < least ? (least - rise) * smoothstepf(0.0f, 0.5f, left) : 0.0f;
    return site->level + rise * (1.0f - left * left);
}

// ---- meshes

// Rings of vertices about the middle, from the middle itself or as a band.
typedef struct Rings {
    int sectors, rings;
    bool whole; // with a vertex in the middle, the last one
} Rings;

static int sectors_of(const Pond *pond)
{
    return (int)clampf(2.0f * PI_F * pond->radius / 0.08f, 96.0f, 1024.0f);
}

static Mesh *rings_new(const Rings *r, Error *e)
{
    int64_t band = (int64_t)(r->rings - 1) * r->sectors * 2;
    Mesh *mesh = mesh_new(3, (int64_t)r->rings * r->sectors + (r->whole ? 1 : 0),
                          band + (r->whole ? r->sectors : 0), MESH_NORMAL | MESH_UV | MESH_SITE, e);
    if (!mesh) {
        return NULL;
    }
    uint32_t *corner = mesh->index, sectors = (uint32_t)r->sectors;
    for (uint32_t ring = 0; ring + 1 < (uint32_t)r->rings; ring++) {
        for (uint32_t s = 0; s < sectors; s++) { // counter-clockwise from above
            uint32_t a = ring * sectors + s, b = ring * sectors + (s + 1) % sectors;
            const uint32_t two[6] = {a, a + sectors, b + sectors, a, b + sectors, b};
            for (int k = 0; k < 6; k++) {
                *corner++ = two[k];
            }
        }
    }
    for (uint32_t s = 0; r->whole && s < sectors; s++) {
        *corner++ = (uint32_t)r->rings * sectors;
        *corner++ = s;
        *corner++ = (s + 1) % sectors;
    }
    return mesh;
}

static Vec2 direction_of(int sector, int sectors)
{
    float sine, cosine;
    exact_sincos(2.0f * PI_F * (float)sector / (float)sectors, &sine, &cosine);
    return (Vec2){sine, cosine};
}

static void set_vertex(Mesh *mesh, int64_t vertex, Vec3 p)
{
    mesh->position[vertex] = p;
    mesh->normal[vertex] = vec3(0, 1, 0);
    mesh->uv[vertex] = (Vec2){p.x, p.z};
}

Mesh *pond_water_mesh(const PondSite *site, Error *e)
{
    const float under = 1.03f; // of the distance to the shore: the bank is above the water there
    const Pond *pond = site->pond;
    Rings rings = {sectors_of(pond), 1, true};
    Mesh *mesh = rings_new(&rings, e);
    for (int s = 0; mesh && s < rings.sectors; s++) {
        Vec2 way = direction_of(s, rings.sectors);
        float r = under * pond_shore(pond, site->seed, way.x, way.y);
        set_vertex(mesh, s,
                   vec3(pond->position[0] + r * way.x, site->level, pond->position[1] + r * way.y));
    }
    if (mesh) {
        set_vertex(mesh, rings.sectors, vec3(pond->position[0], site->level, pond->position[1]));
    }
    return mesh;
}

// Distance (m) from the middle to where mud ends and grass begins: a ragged line a little above the
// water.
static float rim_of(const PondSite *site, Vec2 way)
{
    const Pond *pond = site->pond;
    float scale = 2.5f * pond->radius;
    float ragged =
        noise_plane_fractal(way.x * scale, way.y * scale, 3, random_key(site->seed, STREAM_RIM));
    float wet = clampf(0.5f + ragged, 0.1f, 1.0f) * 0.06f;
    return pond_shore(pond, site->seed, way.x, way.y) * (1.03f + wet);
}

static int rings_of(const Pond *pond)
{
    return (int)clampf(pond->radius / 0.12f, 16.0f, 96.0f);
}

// Banks, those under snow, and the bed have the same rings.
int64_t pond_faces(const Pond *pond)
{
    return (int64_t)sectors_of(pond) * (6 * rings_of(pond) + 2);
}

// site.x: depth over 1 m + itself; site.y: how wet it is, 1 in the water.
static void set_bed(Mesh *mesh, int64_t vertex, const PondSite *site, const PondLand *land,
                    Vec2 way, float r)
{
    const Pond *pond = site->pond;
    Vec3 p = land->point(land->user, pond->position[0] + r * way.x, pond->position[1] + r * way.y);
    float depth = site->level - p.y, above = -depth / (0.6f * pond->bank);
    depth = depth > 0.0f ? depth : 0.0f;
    set_vertex(mesh, vertex, p);
    mesh->site[vertex] = (Vec2){depth / (1.0f + depth), clampf(1.0f - above, 0.0f, 1.0f)};
}

static Mesh *with_normals(Mesh *mesh, Error *e)
{
    if (mesh && !mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}

Mesh *pond_bed_mesh(const PondSite *site, const PondLand *land, Error *e)
{
    Rings rings = {sectors_of(site->pond), rings_of(site->pond), true};
    Mesh *mesh = rings_new(&rings, e);
    for (int s = 0; mesh && s < rings.sectors; s++) {
        Vec2 way = direction_of(s, rings.sectors);
        float rim = rim_of(site, way);
        for (int ring = 0; ring < rings.rings; ring++) {
            float share = (float)(ring + 1) / (float)rings.rings;
            set_bed(mesh, (int64_t)ring * rings.sectors + s, site, land, way, share * rim);
        }
    }
    if (mesh) {
        set_bed(mesh, (int64_t)rings.rings * rings.sectors, site, land, (Vec2){0.0f, 1.0f}, 0.0f);
    }
    return with_normals(mesh, e);
}

Mesh *pond_bank_mesh(const PondSite *site, const PondLand *land, const PondMargin *margin, Error *e)
{
    const Pond *pond = site->pond;
    Rings rings = {sectors_of(pond), rings_of(pond), false};
    Mesh *mesh = rings_new(&rings, e);
    for (int s = 0; mesh && s < rings.sectors; s++) {
        Vec2 way = direction_of(s, rings.sectors);
        float rim = rim_of(site, way), end = pond_reach(pond) + margin->outer;
        for (int ring = 0; ring < rings.rings; ring++) {
            float share = (float)ring / (float)(rings.rings - 1);
            float r = lerpf(rim, end, share * (0.4f + 0.6f * share));
            set_bed(mesh, (int64_t)ring * rings.sectors + s, site, land, way, r);
        }
    }
    mesh = with_normals(mesh, e);
    for (int s = 0; mesh && s < rings.sectors; s++) { // its edge goes down into the land
        mesh->position[(int64_t)(rings.rings - 1) * rings.sectors + s].y -=
            0.05f + 0.1f * margin->outer;
    }
    return mesh;
}

// ---- keys

static const Key POND_KEYS[] = {
    {KEY_OF(Pond, position, "position", KEY_VECTOR), .count = 2, .unit = "m",
     .doc = "Its middle, [x, z]."},
    {KEY_OF(Pond, radius, "radius", KEY_FLOAT), .low = 0.3, .high = 1000, .unit = "m",
     .doc = "Distance from the middle to the shore, on the average."},
    {KEY_OF(Pond, depth, "depth", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100, .unit = "m",
     .doc = "Depth of the water in the middle."},
    {KEY_OF(Pond, bank, "bank", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100, .unit = "m",
     .doc = "How far the water is below the lowest land around it."},
    {KEY_OF(Pond, irregularity, "irregularity", KEY_FLOAT), .high = 1,
     .doc = "Outline: 0 = a circle, 1 = deep bays and spits."},
    {0},
};

static void pond_defaults(void *out)
{
    *(Pond *)out = pond_default();
}

const Table pond_table = {
    .name = "pond",
    .doc = "A pond in the ground: a basin of mud with clear water. Plants, scattered things and "
           "fallen leaves keep out of it; with in_water, scattered things stand in it. Materials: "
           "ground/water, ground/bed.",
    .example = "objects:\n"
               "  - name: meadow\n"
               "    ground: {ponds: [{position: [2, -8], radius: 6, depth: 1.2}]}\n"
               "  - name: reeds\n"
               "    scatter: {count: 80, center: [-1, 0, -11], radius: 3, in_water: true, things: "
               "[{tree: {species: common_reed}}]}\n",
    .size = sizeof(Pond),
    .keys = POND_KEYS,
    .defaults = pond_defaults};
