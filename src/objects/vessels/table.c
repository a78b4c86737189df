// Blood vessels.
#include "objects/common/tables.h"
#include "objects/vessels/vessels.h"

static const EnumName VISCOSITIES[] = {
    {"constant", FLOW_CONSTANT}, {"measured", FLOW_MEASURED}, {0}};
static const EnumName ENDS[] = {
    {"equal_pressure", FLOW_EQUAL_PRESSURE}, {"equal_flow", FLOW_EQUAL_FLOW}, {0}};

static const Key FLOW_KEYS[] = {
    {KEY_OF(FlowParams, viscosity, "viscosity", KEY_ENUM), .names = VISCOSITIES,
     .doc =
         "constant: 3.5 mPa s everywhere, as Murray assumes; measured: dependent on diameter and "
         "hematocrit, as in living microvessels (Pries 1994)."},
    {KEY_OF(FlowParams, ends, "ends", KEY_ENUM), .names = ENDS,
     .doc = "What all ends have in common: equal_pressure (flow follows the resistances) or "
            "equal_flow (as Murray's radii assume)."},
    {KEY_OF(FlowParams, hematocrit, "hematocrit", KEY_FLOAT), .high = 0.9,
     .doc = "Volume of cells in the blood, for the measured viscosity."},
    {KEY_OF(FlowParams, velocity, "velocity", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .unit = "m/s", .doc = "Mean velocity in the section of each root, which sets the flow."},
    {KEY_OF(FlowParams, pressure, "pressure", KEY_FLOAT), .low = -1e7, .high = 1e7, .unit = "Pa",
     .doc = "Pressure at the root of the arteries."},
    {KEY_OF(FlowParams, return_pressure, "vein_pressure", KEY_FLOAT), .low = -1e7, .high = 1e7,
     .unit = "Pa", .doc = "Pressure at the root of the veins."},
    {0},
};

static const Table FLOW_TABLE = {
    .name = "flow",
    .doc =
        "Steady flow by Poiseuille's law, which `ramify measure` reports and network files hold; "
        "it changes no geometry.",
    .example = "objects:\n"
               "  - name: organ\n"
               "    vessels:\n"
               "      envelope: [{shape: ellipsoid, size: [0.05, 0.03, 0.04]}]\n"
               "      flow: {viscosity: measured, velocity: 0.3}\n",
    .size = sizeof(FlowParams),
    .keys = FLOW_KEYS};

static const Key GREAT_KEYS[] = {
    {KEY_OF(GreatVessel, vein, "vein", KEY_BOOL), .doc = "A vein; otherwise an artery."},
    {KEY_OF(GreatVessel, from, "from", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 3, .unit = "m",
     .doc = "Where it begins. The first artery and the first vein begin there; others leave the "
            "nearest vessel of their tree, and run from there to this point first."},
    {KEY_OF(GreatVessel, to, "to", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 3, .unit = "m",
     .doc = "Where it ends and branches on."},
    {KEY_OF(GreatVessel, by, "by", KEY_VECTOR), .count = 3, .unit = "m",
     .given_offset = offsetof(GreatVessel, bent),
     .doc = "Point toward which its way bends (the middle control point of a quadratic Bezier "
            "curve); default: it runs straight."},
    {KEY_OF(GreatVessel, sweep, "sweep", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Way over which it turns away from the vessel that it leaves: it begins in that "
            "one's direction, as branches leave with the flow, and continues another's end "
            "without a bend; 0 = it turns off at once."},
    {0},
};

static const Table GREAT_TABLE = {
    .name = "great",
    .doc =
        "Great vessels, placed by hand, from which growth starts in place of the stem at the inlet "
        "or of a body's own vessels. They may lie outside of the envelope. Those of arteries and "
        "veins must not touch.",
    .example =
        "objects:\n"
        "  - name: liver\n"
        "    vessels:\n"
        "      envelope: [{shape: ellipsoid, size: [0.1, 0.05, 0.06]}]\n"
        "      great:\n"
        "        - {from: [0, -0.08, 0], to: [0, -0.02, 0]}\n"
        "        - {from: [0, -0.02, 0], to: [0.06, 0, 0], by: [0.02, 0.01, 0], sweep: 0.01}\n"
        "        - {from: [0, -0.03, 0], to: [-0.06, 0, 0], by: [-0.02, 0.01, 0], sweep: 0.01}\n"
        "        - {vein: true, from: [0, -0.08, 0.02], to: [0, -0.01, 0.02]}\n",
    .size = sizeof(GreatVessel),
    .keys = GREAT_KEYS};

static const Key VESSELS_KEYS[] = {
    {KEY_OF(VesselsParams, terminals, "terminals", KEY_INT64), .low = 2, .high = 1e8,
     .doc = "Number of vessel ends, of arteries and veins together."},
    {KEY_OF(VesselsParams, veins, "veins", KEY_BOOL),
     .doc =
         "Grow arteries and veins, which share the organ without touching; false = arteries only."},
    {KEY_OF(VesselsParams, inlet, "inlet", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Where the vessels enter; [0, 0, 0] = the hilum, the surface point nearest to the "
            "centre. A body is supplied from its heart."},
    {KEY_OF(VesselsParams, great, "great", KEY_LIST),
     .count_offset = offsetof(VesselsParams, great_count), .table = &GREAT_TABLE, .count = 1000,
     .doc = "Great vessels, from which growth starts; default: a stem at the inlet, or those of a "
            "body."},
    {KEY_OF(VesselsParams, root_radius, "root_radius", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Radius of the artery's root; 0 = proportional to the organ."},
    {KEY_OF(VesselsParams, vein_radius, "vein_radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .doc = "Radius of the vein's root, relative to the artery's."},
    {KEY_OF(VesselsParams, law.exponent, "exponent", KEY_FLOAT), .high = 10,
     .doc = "Exponent e of Murray's law, r_parent^e = sum of r_child^e; 0 = dependent on size, as "
            "in arteries: 3 up to 0.1 mm, 2.7 up to 1 mm, 2.3 above."},
    {KEY_OF(VesselsParams, gap, "gap", KEY_FLOAT), .high = 100,
     .doc = "Minimum distance between an artery and a vein, in radii of the finest vessels."},
    {KEY_OF(VesselsParams, turn, "turn", KEY_BOOL),
     .doc = "Rotate the subtrees below each fork to Murray's angles, or bend their first segments "
            "where the whole would leave the organ or touch the other tree."},
    {KEY_OF(VesselsParams, curve_radius, "curve_radius", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Vessels thinner than this are rendered as round curves, others get a skin; 0 = all "
            "are curves."},
    {KEY_OF(VesselsParams, skin_levels, "skin_levels", KEY_INT), .high = 4,
     .doc = "Number of subdivision levels of the thick vessels' skin."},
    {KEY_OF(VesselsParams, ring_spacing, "ring_spacing", KEY_FLOAT), .low = 0.1, .high = 100,
     .doc =
         "Distance between the rings of faces of the skin, in radii of the vessel: the mesh is as "
         "fine as its vessels are thin. A curve_radius of 1e-9 gives all vessels a skin."},
    {KEY_OF(VesselsParams, wall, "wall", KEY_FLOAT), .high = 0.9,
     .doc = "Thickness of the wall where the vessels that have a skin are cut open at their roots, "
            "in radii; 0 = their ends are closed and round."},
    {KEY_OF(VesselsParams, flow, "flow", KEY_GROUP), .table = &FLOW_TABLE,
     .doc = "Pressure and flow of the blood, for measures and network files."},
    ELEMENT_ROWS(VesselsParams),
    {0},
};

static void vessels_defaults(void *out)
{
    *(VesselsParams *)out = vessels_params_default();
}

static bool check_vessels(const Mapping *mapping, void *params)
{
    const ElementParams *element = &((const VesselsParams *)params)->element;
    if (element->shape_count == 0) {
        return mapping_fail(mapping, NULL, " has no envelope; it must name the organ to fill");
    }
    const VesselsParams *vessels = params;
    for (int i = 0; i < vessels->great_count; i++) {
        if (!(vec3_distance(vessels->great[i].from, vessels->great[i].to) > 0.0f)) {
            return mapping_fail(mapping, "great", " has a vessel that ends where it begins");
        }
    }
    return check_element(mapping, element);
}

const Table vessels_table = {
    .name = "vessels",
    .doc = "Blood vessels that fill an organ or a body (Tanaka et al., section 5.4), with radii "
           "and angles by Murray's laws. The envelope is required. Materials: artery, vein.",
    .example = "objects:\n"
               "  - name: organ\n"
               "    vessels: {envelope: [{shape: ellipsoid, size: [0.05, 0.03, 0.04]}], terminals: "
               "3000}\n",
    .size = sizeof(VesselsParams),
    .keys = VESSELS_KEYS,
    .defaults = vessels_defaults,
    .check = check_vessels};
