// Table of guide fields and their nuclei.
#include "objects/common/tables.h"

#define BIT(kind) (1u << (kind))

static const EnumName FIELD_KINDS[] = {{"uniform", FIELD_UNIFORM},     {"radial", FIELD_RADIAL},
                                       {"vortex", FIELD_VORTEX},       {"nuclei", FIELD_NUCLEI},
                                       {"grid", FIELD_GRID},           {"curl", FIELD_CURL},
                                       {"curvature", FIELD_CURVATURE}, {"volume", FIELD_VOLUME},
                                       {"point", FIELD_POINT},         {0}};
const EnumName field_profiles[] = {
    {"swept", PROFILE_SWEPT}, {"constant", PROFILE_CONSTANT}, {"grown", PROFILE_GROWN}, {0}};
static const EnumName NUCLEUS_KINDS[] = {
    {"point", NUCLEUS_POINT}, {"line", NUCLEUS_LINE}, {"surface", NUCLEUS_SURFACE}, {0}};

#define NUCLEI (BIT(FIELD_NUCLEI) | BIT(FIELD_GRID))

static const Key NUCLEUS_KEYS[] = {
    {KEY_OF(Nucleus, kind, "kind", KEY_ENUM), .flags = KEY_REQUIRED, .names = NUCLEUS_KINDS,
     .doc = "point: `position`; line: from `position` to `end`, such as the axis of a trunk; "
            "surface: that of the shapes in `envelope`."},
    {KEY_OF(Nucleus, position, "position", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 3,
     .kinds = BIT(NUCLEUS_POINT) | BIT(NUCLEUS_LINE), .unit = "m",
     .doc = "The point, or the line's start, in the scene's space."},
    {KEY_OF(Nucleus, end, "end", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 3,
     .kinds = BIT(NUCLEUS_LINE), .unit = "m", .doc = "The line's end."},
    {KEY_OF(Nucleus, shapes, "envelope", KEY_LIST), .flags = KEY_REQUIRED,
     .count_offset = offsetof(Nucleus, shape_count), .count = 1000, .table = &shape_table,
     .kinds = BIT(NUCLEUS_SURFACE),
     .doc = "Shapes, combined in this order. Their surface is represented by 20,000 points."},
    {KEY_OF(Nucleus, normal, "normal", KEY_VECTOR), .count = 3,
     .doc = "Normal of the nucleus, about which the field is turned near it unless the field has a "
            "`vector`; a longer one turns further. Zero = the line's direction, otherwise up."},
    {0},
};

static const Table NUCLEUS_TABLE = {
    .name = "field_nucleus",
    .doc = "A nucleus that a guide field leads away from: a point, a line or a surface.",
    .example = "objects:\n"
               "  - name: wound\n"
               "    tree:\n"
               "      trunk:\n"
               "        stems: 5\n"
               "        fields:\n"
               "          - kind: nuclei\n"
               "            turn: 360\n"
               "            nuclei: [{kind: line, position: [0, 0, 0], end: [0, 5, 0]}]\n",
    .size = sizeof(Nucleus),
    .keys = NUCLEUS_KEYS,
    .kind_key = "kind",
    .check = check_nucleus};

static const Key FIELD_KEYS[] = {
    {KEY_OF(FieldParams, kind, "kind", KEY_ENUM), .flags = KEY_REQUIRED, .names = FIELD_KINDS,
     .doc =
         "uniform: `vector` everywhere; radial: away from `center`; vortex: around the axis "
         "`vector` through `center`; nuclei: away from the nearest nucleus, turned by `turn`; "
         "grid: the same, sampled on voxels; curl: swirling curl noise; curvature: along the lines "
         "of "
         "curvature of the envelope's surface, on the side of `vector`; volume: the vectors of a "
         "grid in `file`, or the way in which a scalar grid's values rise; point: `vector` at "
         "`center`, fading over `scale`."},
    {KEY_OF(FieldParams, weight, "weight", KEY_FLOAT), .low = -1000, .high = 1000,
     .doc = "Weight in the sum of the fields; a negative weight reverses the field."},
    {KEY_OF(FieldParams, vector, "vector", KEY_VECTOR), .count = 3,
     .kinds =
         BIT(FIELD_UNIFORM) | BIT(FIELD_VORTEX) | BIT(FIELD_POINT) | BIT(FIELD_CURVATURE) | NUCLEI,
     .doc = "Direction of the field; for vortex, nuclei and grid, the axis of rotation. For nuclei "
            "and grid, zero = the normal of the nearest nucleus: of a start on a surface the "
            "surface's, of a line its direction, otherwise up."},
    {KEY_OF(FieldParams, center, "center", KEY_VECTOR), .flags = KEY_NO_DEFAULT,
     .given_offset = offsetof(FieldParams, centered), .count = 3,
     .kinds = BIT(FIELD_RADIAL) | BIT(FIELD_VORTEX) | BIT(FIELD_POINT), .unit = "m",
     .doc = "Centre of the field; default: the object's position, or the origin of its envelope's "
            "first shape."},
    {KEY_OF(FieldParams, nucleus, "nuclei", KEY_LIST),
     .count_offset = offsetof(FieldParams, nucleus_count), .count = 1000, .kinds = NUCLEI,
     .table = &NUCLEUS_TABLE,
     .doc = "Nuclei that the field leads away from. Default: the nodes from which the element "
            "grows: of a crown those of the trunk, otherwise its start points."},
    {KEY_OF(FieldParams, turn, "turn", KEY_FLOAT), .kinds = NUCLEI, .low = -36000, .high = 36000,
     .unit = "degrees",
     .doc = "Angle that a streamline sweeps from the nucleus to the rim (profile swept), that "
            "growth sweeps on this way (grown), or by which every vector is turned (constant)."},
    {KEY_OF(FieldParams, rim, "rim", KEY_FLOAT), .kinds = NUCLEI, .high = 1e6, .unit = "m",
     .doc = "Distance of the rim from the nucleus; 0 = as far as the attractors' bounds."},
    {KEY_OF(FieldParams, scale, "scale", KEY_FLOAT),
     .kinds = BIT(FIELD_CURL) | BIT(FIELD_POINT) | BIT(FIELD_VOLUME), .flags = KEY_ABOVE,
     .high = 1e6, .unit = "m",
     .doc = "Wavelength of the noise (curl), distance over which the vector fades (point), or the "
            "file's unit (volume)."},
    {KEY_OF(FieldParams, least, "least", KEY_BOOL), .kinds = BIT(FIELD_CURVATURE),
     .doc = "Along the least curvature (of a branch or a wrinkle: its length) instead of the "
            "greatest (around it)."},
    {KEY_OF(FieldParams, file, "file", KEY_FILE), .flags = KEY_REQUIRED, .kinds = BIT(FIELD_VOLUME),
     .doc = "VDB file with a grid of float vectors or of floats."},
    {KEY_OF(FieldParams, grid, "grid", KEY_TEXT), .kinds = BIT(FIELD_VOLUME),
     .doc = "Name of the grid; default: the first of floats or vectors."},
    {KEY_OF(FieldParams, position, "position", KEY_VECTOR), .count = 3, .kinds = BIT(FIELD_VOLUME),
     .unit = "m", .doc = "Position of the file's origin."},
    {KEY_OF(FieldParams, rotation, "rotation", KEY_VECTOR), .count = 3, .kinds = BIT(FIELD_VOLUME),
     .unit = "degrees", .doc = "Rotation of the file's space about x, then y, then z."},
    {KEY_OF(FieldParams, profile, "profile", KEY_ENUM), .kinds = NUCLEI, .names = field_profiles,
     .doc =
         "swept: the turn increases along a streamline from the nucleus; grown: it increases more, "
         "by what the attractors' outward pull takes back of it at this `weight` and "
         "field_weight; constant: every vector is turned by the same angle."},
    {KEY_OF(FieldParams, spherical, "spherical", KEY_BOOL), .kinds = NUCLEI,
     .doc = "Measure the sweep by the polar angle on a sphere about the centre of the envelope's "
            "first shape, instead of by distance."},
    {KEY_OF(FieldParams, surface, "surface", KEY_BOOL), .kinds = NUCLEI,
     .doc = "Turn about the attractors' surface normals instead of `vector` (grid: turn about "
            "`vector`, then stay in the surface's tangent plane)."},
    {KEY_OF(FieldParams, resolution, "resolution", KEY_INT), .kinds = BIT(FIELD_GRID), .high = 1024,
     .doc = "Voxels along the longest side; 0 = 48."},
    {0},
};

static void field_defaults(const Node *given, int kind, void *out)
{
    (void)given;
    *(FieldParams *)out = field_params_default(kind < 0 ? FIELD_UNIFORM : (FieldKind)kind);
}

const Table guide_field_table = {
    .name = "field",
    .doc = "A guide vector field, which steers growth: it makes a tree lean, wind or swirl. "
           "Several fields are summed with their weights.",
    .example = "objects:\n"
               "  - name: wound\n"
               "    tree:\n"
               "      crown:\n"
               "        fields:\n"
               "          - {kind: vortex, vector: [0, 1, 0], weight: 0.8}\n"
               "          - {kind: curl, scale: 3, weight: 0.3}\n",
    .size = sizeof(FieldParams),
    .keys = FIELD_KEYS,
    .kind_key = "kind",
    .kind_defaults = field_defaults,
    .check = check_field};
