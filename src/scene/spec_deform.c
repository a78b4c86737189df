// Keys of deformations.
#include "scene/scene.h"
#include "scene/spec_check.h"
#include "shape/deformation.h"

#define BIT(KIND) (1u << (KIND))
#define ALONG (BIT(DEFORM_BEND) | BIT(DEFORM_TWIST))

static const EnumName KINDS[] = {{"affine", DEFORM_AFFINE},
                                 {"bend", DEFORM_BEND},
                                 {"twist", DEFORM_TWIST},
                                 {"mesh", DEFORM_MESH},
                                 {0}};

static const Key DEFORM_KEYS[] = {
    {KEY_OF(DeformParams, kind, "kind", KEY_ENUM), .flags = KEY_REQUIRED, .names = KINDS,
     .doc =
         "affine: scaled, sheared, turned and moved; bend: along `axis` into an arc, as by wind; "
         "twist: about `axis`; mesh: as the vertices of one mesh move to those of another."},
    {KEY_OF(DeformParams, pivot, "pivot", KEY_VECTOR), .count = 3,
     .kinds = BIT(DEFORM_AFFINE) | ALONG, .unit = "m",
     .doc = "Point that stays; bends and twists start there."},
    {KEY_OF(DeformParams, rotation, "rotation", KEY_VECTOR), .count = 3,
     .kinds = BIT(DEFORM_AFFINE), .unit = "degrees", .doc = "Rotation about x, then y, then z."},
    {KEY_OF(DeformParams, scale, "scale", KEY_VECTOR), .flags = KEY_SPLAT | KEY_ABOVE, .count = 3,
     .high = 1000, .kinds = BIT(DEFORM_AFFINE), .doc = "Scale along x, y and z, applied first."},
    {KEY_OF(DeformParams, shear, "shear", KEY_VECTOR), .count = 3, .low = -10, .high = 10,
     .kinds = BIT(DEFORM_AFFINE),
     .doc = "Shift of x per y, of x per z and of y per z, applied after the scale."},
    {KEY_OF(DeformParams, move, "move", KEY_VECTOR), .count = 3, .kinds = BIT(DEFORM_AFFINE),
     .unit = "m", .doc = "Translation, applied last."},
    {KEY_OF(DeformParams, axis, "axis", KEY_VECTOR), .count = 3, .kinds = ALONG,
     .doc = "Direction along which it bends, or about which it twists."},
    {KEY_OF(DeformParams, toward, "toward", KEY_VECTOR), .count = 3, .kinds = BIT(DEFORM_BEND),
     .doc = "Direction in which it leans."},
    {KEY_OF(DeformParams, angle, "angle", KEY_FLOAT), .low = -3600, .high = 3600, .kinds = ALONG,
     .unit = "degrees", .doc = "Bend or twist over the whole length."},
    {KEY_OF(DeformParams, length, "length", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6,
     .kinds = ALONG, .unit = "m", .doc = "Length along the axis over which it bends or twists."},
    {KEY_OF(DeformParams, rest, "rest", KEY_FILE), .flags = KEY_REQUIRED, .kinds = BIT(DEFORM_MESH),
     .doc = "Closed mesh in the pose in which the object grows, in the scene's coordinates."},
    {KEY_OF(DeformParams, posed, "posed", KEY_FILE), .flags = KEY_REQUIRED,
     .kinds = BIT(DEFORM_MESH), .doc = "The same mesh, vertex by vertex, in its present pose."},
    {0},
};

static void deform_defaults(const Node *given, int kind, void *out)
{
    (void)given;
    *(DeformParams *)out = (DeformParams){.kind = kind < 0 ? DEFORM_AFFINE : (DeformKind)kind,
                                          .scale = {1, 1, 1},
                                          .axis = {0, 1, 0},
                                          .toward = {1, 0, 0},
                                          .length = 1.0f};
}

static bool check_deform(const Mapping *mapping, void *params)
{
    const DeformParams *deform = params;
    Vec3 across = vec3_cross(deform->axis, deform->toward);
    bool along = deform->kind == DEFORM_BEND || deform->kind == DEFORM_TWIST;
    if (along && !(vec3_dot(deform->axis, deform->axis) > 0.0f)) {
        return mapping_fail(mapping, "axis", " is zero; it must have a direction");
    }
    return deform->kind != DEFORM_BEND || vec3_dot(across, across) > 0.0f ||
           mapping_fail(mapping, "toward", " is zero or along `axis`; it must lean across it");
}

const Table deform_table = {
    .name = "deform",
    .doc = "A deformation of an object that has grown: of its branches, not of its leaves' form.",
    .example =
        "objects:\n"
        "  - name: birch\n"
        "    tree: {height: 9}\n"
        "    deform:\n"
        "      - {kind: bend, toward: [1, 0, 0], angle: 20, length: 9}\n"
        "animation:\n"
        "  frames: 48\n"
        "  tracks:\n"
        "    - {path: objects.birch.deform.0.angle, keys: [{at: 0, value: 15}, {at: 1, value: "
        "22}]}\n",
    .size = sizeof(DeformParams),
    .keys = DEFORM_KEYS,
    .kind_key = "kind",
    .kind_defaults = deform_defaults,
    .check = check_deform};
