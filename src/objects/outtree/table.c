// The general out-tree: points, growth, thickness, what is seen.
#include "objects/common/tables.h"
#include "objects/outtree/outtree.h"

static const Key POINT_KEYS[] = {
    {KEY_OF(PlacedPoint, position, "position", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 3,
     .unit = "m",
     .doc = "Position; with points.place: surface it moves to the nearest point of the envelope's "
            "surface."},
    {KEY_OF(PlacedPoint, group, "group", KEY_INT), .high = 1,
     .doc = "0: a start point (node type), from which an out-tree grows; 1: an attractor."},
    {KEY_OF(PlacedPoint, normal, "normal", KEY_VECTOR), .count = 3,
     .doc = "Normal, about which guide fields turn; in a volume also the first heading of the "
            "rules sectors and string. Default: the surface's; in a volume up."},
    {0},
};

static const Table POINT_TABLE = {.name = "placed_point",
                                  .doc = "A point placed by hand.",
                                  .size = sizeof(PlacedPoint),
                                  .keys = POINT_KEYS};

static const Key PLACED_KEYS[] = {
    {KEY_OF(PlacedParams, points, "points", KEY_LIST),
     .count_offset = offsetof(PlacedParams, count), .count = 100000, .table = &POINT_TABLE,
     .doc = "The points: start points (group 0) and attractors (group 1)."},
    {KEY_OF(PlacedParams, step, "step", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Distance between nodes that grow toward placed attractors; 0 = half of the mean "
            "distance from an attractor to the nearest other."},
    {KEY_OF(PlacedParams, kill, "kill", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Kill distance of placed attractors; 0 = their mean distance."},
    {KEY_OF(PlacedParams, influence, "influence", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Influence distance of placed attractors; 0 = 6 mean distances."},
    {0},
};

static const Table PLACED_TABLE = {
    .name = "placed",
    .doc = "Points placed by hand, of two types (Tanaka et al., section 4.2). Attractors among "
           "them are the first level; growth.levels adds scattered ones.",
    .example = "objects:\n"
               "  - name: two\n"
               "    outtree:\n"
               "      placed:\n"
               "        points:\n"
               "          - {position: [-0.3, 0, 0], group: 0}\n"
               "          - {position: [0.3, 0, 0], group: 0}\n"
               "          - {position: [-0.2, 0.5, 0], group: 1}\n"
               "          - {position: [0.2, 0.6, 0.1], group: 1}\n",
    .size = sizeof(PlacedParams),
    .keys = PLACED_KEYS};

static const Key STARTS_KEYS[] = {
    {KEY_OF(StartsParams, count, "count", KEY_INT), .high = 10000,
     .doc = "Number of start points placed on the envelope's surface, as far as possible from "
            "each other and from those placed by hand; 0 = 1 if none is placed by hand."},
    {KEY_OF(StartsParams, direction, "direction", KEY_VECTOR), .count = 3,
     .doc = "The first one, if none is placed by hand, is the surface's farthest point in this "
            "direction."},
    {0},
};

static const Table STARTS_TABLE = {.name = "starts",
                                   .doc = "Start points placed by the program.",
                                   .size = sizeof(StartsParams),
                                   .keys = STARTS_KEYS};

static const Key STRING_KEYS[] = {
    {KEY_OF(StringParams, axiom, "axiom", KEY_TEXT),
     .doc = "Axiom (initial string) of the L-system; default: X."},
    {KEY_OF(StringParams, rules, "rules", KEY_TEXT),
     .doc = "Rules of the L-system, one per line or separated by ';'; default: X -> "
            "[+FX][-FX]FX (Horiuchi et al.)."},
    {KEY_OF(StringParams, generations, "generations", KEY_INT), .low = 1, .high = 40,
     .doc = "Number of times the rules are applied."},
    {KEY_OF(StringParams, angle, "angle", KEY_FLOAT), .high = 180, .unit = "degrees",
     .doc = "Angle of turns that have no parameter."},
    {KEY_OF(StringParams, group, "group", KEY_FLOAT), .flags = KEY_ABOVE, .high = 360,
     .unit = "degrees",
     .doc = "Angular width of a direction, which owns the attractors within half of it."},
    {KEY_OF(StringParams, regularity, "regularity", KEY_FLOAT), .high = 1,
     .doc = "Regularity of directions: 0 = toward the attractors that a direction owns, 1 = "
            "exactly as the L-system says."},
    {KEY_OF(StringParams, length, "length", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Length of growth steps next to the start point; 0 = the level's step."},
    {KEY_OF(StringParams, length_tip, "length_tip", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Length of growth steps farthest from the start point; 0 = length."},
    {0},
};

static bool check_string(const Mapping *mapping, void *params)
{
    const StringParams *string = params;
    return (!string->rules && !string->axiom) ||
           check_grammar(mapping, string->axiom, string->rules);
}

static const Table STRING_TABLE = {
    .name = "string",
    .doc = "The L-system of growth.rule: string (Horiuchi et al.): it gives the directions in "
           "which a node may grow, attractors the available space.",
    .example = "objects:\n"
               "  - name: fan\n"
               "    outtree:\n"
               "      growth: {rule: string, levels: [{attractors: 800, step: 0.8, kill: 0.7}]}\n"
               "      string: {rules: 'X -> [+FX][-FX]FX', generations: 8, angle: 25}\n",
    .size = sizeof(StringParams),
    .keys = STRING_KEYS,
    .check = check_string};

static const EnumName RADII_MODELS[] = {{"pipe", OUTTREE_PIPE},   {"murray", OUTTREE_MURRAY},
                                        {"birth", OUTTREE_BIRTH}, {"order", OUTTREE_ORDER},
                                        {"even", OUTTREE_EVEN},   {0}};

static const Key THICKNESS_KEYS[] = {
    {KEY_OF(ThicknessParams, model, "model", KEY_ENUM), .names = RADII_MODELS,
     .doc = "pipe: r_parent^e = sum of r_child^e; murray: the same with the exponent measured in "
            "arteries, 3 to 2.3 by size; birth: thickness increases with age; order: each order "
            "of branching is thinner by a factor; even: all the same."},
    {KEY_OF(ThicknessParams, exponent, "exponent", KEY_FLOAT), .low = 1, .high = 10,
     .doc = "Exponent e of the pipe model."},
    {KEY_OF(ThicknessParams, tip, "tip", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Radius of the tips; 0 = 0.12 of the mean distance between nodes."},
    {KEY_OF(ThicknessParams, root, "root", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Radius at the start points; 0 = as the pipe model gives, 8 tips (birth) or 4 tips "
            "(order). Not of murray and even."},
    {KEY_OF(ThicknessParams, ratio, "ratio", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1,
     .doc = "Factor from one order of branching to the next, for the model order."},
    {0},
};

static const Table THICKNESS_TABLE = {.name = "outtree_radii",
                                      .doc = "Thickness of the branches.",
                                      .size = sizeof(ThicknessParams),
                                      .keys = THICKNESS_KEYS};

static const Key WANDER_KEYS[] = {
    {KEY_OF(WanderParams, amplitude, "amplitude", KEY_FLOAT), .high = 10,
     .doc = "Deviation of branches from their course (fractional Brownian motion): standard "
            "deviation at the end of a free branch as long as the envelope, as a fraction of that "
            "length; 0 = none. On a surface, branches stay on it."},
    {KEY_OF(WanderParams, hurst, "hurst", KEY_FLOAT), .flags = KEY_ABOVE | KEY_BELOW, .high = 1,
     .doc = "Hurst exponent of the deviation; a smaller one is rougher."},
    {KEY_OF(WanderParams, segment, "segment", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Distance between nodes along branches that are divided anew before they deviate; 0 = "
            "as they grew."},
    {KEY_OF(WanderParams, pin_forks, "pin_forks", KEY_BOOL),
     .doc = "Forks and tips stay in place; else branches move along with their forks."},
    {0},
};

static const Table WANDER_TABLE = {.name = "jitter",
                                   .doc = "Jitter of the branches.",
                                   .size = sizeof(WanderParams),
                                   .keys = WANDER_KEYS};

static const EnumName FORMS[] = {
    {"tubes", OUTTREE_TUBES}, {"blades", OUTTREE_BLADES}, {"none", OUTTREE_NONE}, {0}};

static const Key BLADES_KEYS[] = {
    {KEY_OF(BladeParams, relief, "relief", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .doc = "Height of a blade's rib, relative to its half-width."},
    {KEY_OF(BladeParams, white, "rime", KEY_FLOAT), .high = 1,
     .doc = "Fraction of the side branches that have the rime_material."},
    {0},
};

static const Table BLADES_TABLE = {.name = "blades",
                                   .doc = "Flat crystals, for form: blades.",
                                   .size = sizeof(BladeParams),
                                   .keys = BLADES_KEYS};

static const Key LAMPS_KEYS[] = {
    {KEY_OF(LampsParams, max_count, "max_count", KEY_INT64), .high = 1e7,
     .doc = "Maximum number of lamps, spread evenly over the tips; 0 = none."},
    {KEY_OF(LampsParams, radius, "radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "m", .doc = "Radius of a lamp."},
    {KEY_OF(LampsParams, drop, "drop", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Distance by which lamps hang below their tips."},
    {KEY_OF(LampsParams, variation, "variation", KEY_FLOAT), .high = 1,
     .doc = "Variation of their sizes: radii lie evenly between 1 - variation and 1 times radius."},
    {0},
};

static const Table LAMPS_TABLE = {.name = "lamps",
                                  .doc = "Glowing balls at the tips of branches.",
                                  .size = sizeof(LampsParams),
                                  .keys = LAMPS_KEYS};

static const EnumName AROUND[] = {
    {"tips", SHOW_TIPS}, {"starts", SHOW_STARTS}, {"nodes", SHOW_NODES}, {0}};

#define SHOW_RADIUS .high = 1000, .unit = "m"

static const Key SHOW_KEYS[] = {
    {KEY_OF(ShowParams, attractors, "attractors", KEY_FLOAT), SHOW_RADIUS,
     .doc = "Radius of balls at the attractors that are left of the last level begun, in the state "
            "of growth that is shown (grow_to, growth.max_steps); 0 = not shown, as below."},
    {KEY_OF(ShowParams, nodes, "nodes", KEY_FLOAT), SHOW_RADIUS,
     .doc = "Radius of balls at all nodes."},
    {KEY_OF(ShowParams, starts, "starts", KEY_FLOAT), SHOW_RADIUS,
     .doc = "Radius of balls at the start points."},
    {KEY_OF(ShowParams, edges, "edges", KEY_FLOAT), SHOW_RADIUS,
     .doc = "Radius of straight lines from all nodes to their parents, in the object's material."},
    {KEY_OF(ShowParams, pulls, "pulls", KEY_FLOAT), SHOW_RADIUS,
     .doc = "Radius of lines from these attractors to the nodes that they pull: the nearest within "
            "the influence distance."},
    {KEY_OF(ShowParams, kill, "kill", KEY_FLOAT), SHOW_RADIUS,
     .doc = "Radius of the lines of circles as large as the kill distance, in node_material."},
    {KEY_OF(ShowParams, influence, "influence", KEY_FLOAT), SHOW_RADIUS,
     .doc = "Radius of the lines of circles as large as the influence distance, in "
            "attractor_material."},
    {KEY_OF(ShowParams, around, "around", KEY_ENUM), .names = AROUND,
     .doc = "Nodes that these circles are drawn around."},
    {KEY_OF(ShowParams, band, "band", KEY_FLOAT), SHOW_RADIUS,
     .doc = "Radius of balls at the voxels of the envelope's narrow-band level set, in a slice "
            "through its middle: node_material inside, attractor_material outside."},
    {KEY_OF(ShowParams, facing, "facing", KEY_VECTOR), .count = 3,
     .doc = "Normal of the circles and the slice: the direction to the camera."},
    {0},
};

static bool check_show(const Mapping *mapping, void *params)
{
    return vec3_length(((const ShowParams *)params)->facing) > 0.0f ||
           mapping_fail(mapping, "facing", " is zero; it must have a direction");
}

static const Table SHOW_TABLE = {
    .name = "show",
    .doc = "Growth itself made visible: its attractors, nodes and distances.",
    .example = "objects:\n"
               "  - name: diagram\n"
               "    outtree:\n"
               "      growth: {max_steps: 12, levels: [{attractors: 300}]}\n"
               "      show: {attractors: 0.02, nodes: 0.015, kill: 0.003, pulls: 0.002}\n",
    .size = sizeof(ShowParams),
    .keys = SHOW_KEYS,
    .check = check_show};

static const Key FURTHER_KEYS[] = {
    {KEY_OF(FurtherParams, element, "growth", KEY_GROUP), .table = &growth_table,
     .doc = "How this growth proceeds; its levels are required."},
    {KEY_OF(FurtherParams, element.fields, "fields", KEY_LIST),
     .count_offset = offsetof(FurtherParams, element.field_count), .count = 100,
     .table = &guide_field_table, .doc = "Guide vector fields of this growth."},
    {KEY_OF(FurtherParams, segment, "segment", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Distance between nodes along the branches so far, which are divided anew before this "
            "growth starts from them; 0 = as they grew."},
    {0},
};

static void further_defaults(void *out)
{
    ((FurtherParams *)out)->element.growth.field_weight = 1.0f;
}

static bool check_further(const Mapping *mapping, void *params)
{
    const FurtherParams *further = params;
    return further->element.level_count > 0 ||
           mapping_fail(mapping, "growth.levels", " is missing; list the levels of this growth");
}

static const Table FURTHER_TABLE = {
    .name = "further",
    .doc = "A growth that follows the others in the same envelope, from all nodes so far.",
    .example = "objects:\n"
               "  - name: feather\n"
               "    outtree:\n"
               "      points: {place: surface}\n"
               "      growth: {levels: [{attractors: 60}]}\n"
               "      further:\n"
               "        - growth:\n"
               "            {rule: sectors, sector_angle: 60, sector_axis: true, max_angle: 61,\n"
               "             levels: [{attractors: 3000, step: 0.55, kill: 0.9, influence: 5}]}\n",
    .size = sizeof(FurtherParams),
    .keys = FURTHER_KEYS,
    .defaults = further_defaults,
    .check = check_further};

static const Key OUTTREE_KEYS[] = {
    ELEMENT_ROWS(OuttreeParams),
    {KEY_OF(OuttreeParams, further, "further", KEY_LIST),
     .count_offset = offsetof(OuttreeParams, further_count), .count = 100, .table = &FURTHER_TABLE,
     .doc = "Growths that follow in the same envelope, each from all nodes so far, with its own "
            "rule and fields: the sides of a crystal's spines, the twigs of limbs."},
    {KEY_OF(OuttreeParams, placed, "placed", KEY_GROUP), .table = &PLACED_TABLE,
     .doc = "Start points and attractors placed by hand."},
    {KEY_OF(OuttreeParams, starts, "starts", KEY_GROUP), .table = &STARTS_TABLE,
     .doc = "Start points placed by the program."},
    {KEY_OF(OuttreeParams, string, "string", KEY_GROUP), .table = &STRING_TABLE,
     .doc = "The L-system of the rule string."},
    {KEY_OF(OuttreeParams, radii, "radii", KEY_GROUP), .table = &THICKNESS_TABLE,
     .doc = "Thickness of the branches."},
    {KEY_OF(OuttreeParams, jitter, "jitter", KEY_GROUP), .table = &WANDER_TABLE,
     .doc = "Jitter of the branches."},
    {KEY_OF(OuttreeParams, crossings, "crossings", KEY_BOOL),
     .doc = "May branches on a surface cross? If not, each ends where it would cross an older one, "
            "as crystals do."},
    {KEY_OF(OuttreeParams, lift, "lift", KEY_FLOAT), .high = 1e4, .unit = "m",
     .doc = "Distance by which nodes are moved along their normals after growth: over a surface, "
            "their height above it."},
    {KEY_OF(OuttreeParams, form, "form", KEY_ENUM), .names = FORMS,
     .doc = "tubes: round branches, with skin and leaves; blades: flat crystals with a rib along "
            "the normal, twice as wide as the radius; none: only what `show` draws."},
    {KEY_OF(OuttreeParams, skin, "skin", KEY_GROUP), .table = &skin_table,
     .doc = "Surface of tubes."},
    {KEY_OF(OuttreeParams, blades, "blades", KEY_GROUP), .table = &BLADES_TABLE,
     .doc = "Shape of blades."},
    {KEY_OF(OuttreeParams, leaves, "leaves", KEY_GROUP), .table = &leaves_table,
     .doc = "Leaves on thin tubes; none unless max_count is set."},
    {KEY_OF(OuttreeParams, lamps, "lamps", KEY_GROUP), .table = &LAMPS_TABLE,
     .doc = "Glowing balls at the tips of branches; none unless max_count is set."},
    {KEY_OF(OuttreeParams, show, "show", KEY_GROUP), .table = &SHOW_TABLE,
     .doc = "Growth itself made visible: its attractors, nodes and distances."},
    {0},
};

static void outtree_defaults(void *out)
{
    *(OuttreeParams *)out = outtree_params_default();
}

static bool check_placed(const Mapping *mapping, const OuttreeParams *params)
{
    const PlacedParams *placed = &params->placed;
    if (placed->kill > 0.0f && placed->influence > 0.0f && placed->kill >= placed->influence) {
        return mapping_fail(mapping, "placed.kill",
                            " is %g m; it must be less than influence, %g m, or attractors are "
                            "removed before they pull",
                            (double)placed->kill, (double)placed->influence);
    }
    bool own_box = params->element.shape_count == 0 && !outtree_scatters(params);
    return !own_box || params->element.points.place == SCATTER_VOLUME ||
           mapping_fail(mapping, NULL,
                        " places attractors on a surface but has no envelope; give it one");
}

// An object's surface is a shape that exists already, and possibly a sheet.
static bool check_over(const Mapping *mapping, const OuttreeParams *outtree)
{
    if (outtree->element.shape_count > 1) {
        return load_fail(mapping->loader, node_get(mapping->given, "envelope")->first->next,
                         "%s: nothing can be joined to the surface of an object or cut from it; "
                         "it must be the only shape",
                         mapping_path(mapping, "envelope"));
    }
    if (outtree->element.points.place != SCATTER_SURFACE) {
        return mapping_fail(mapping, "points.place",
                            " is volume, but the surface of an object has no inside; it must be "
                            "surface");
    }
    if (outtree->element.points.anchored) {
        return mapping_fail(mapping, "points.anchored",
                            " needs an envelope with an inside, which the surface of an object "
                            "has not; leave it out");
    }
    return outtree->show.band <= 0.0f ||
           mapping_fail(mapping, "show.band",
                        " needs an envelope with an inside, which the surface of an object has "
                        "not; leave it out");
}

static bool check_outtree(const Mapping *mapping, void *params)
{
    const OuttreeParams *outtree = params;
    ElementParams element = outtree->element;
    if (outtree_over(outtree)) {
        if (!check_over(mapping, outtree)) {
            return false;
        }
        element.shape_count = 0;
    }
    if (!(vec3_length(outtree->starts.direction) > 0.0f)) {
        return mapping_fail(mapping, "starts.direction", " is zero; it must have a direction");
    }
    return check_string_element(mapping, &element) && check_placed(mapping, outtree);
}

const Table outtree_table = {
    .name = "outtree",
    .doc = "A general out-tree (Tanaka et al., sections 3 and 4): grown in any envelope or over "
           "its surface, from any start points, toward scattered and placed attractors, by any "
           "rule and in any guide fields. The other kinds are recipes for particular things. "
           "Materials: clay, leaf, lamp, attractor, node, rime.",
    .example = "objects:\n"
               "  - name: veins\n"
               "    outtree:\n"
               "      envelope: [{shape: ellipsoid, size: [0.5, 0.7, 0.5]}]\n"
               "      points: {place: surface}\n"
               "      growth: {levels: [{attractors: 2000, step: 0.4}], max_children: 2}\n"
               "      starts: {count: 3}\n"
               "      radii: {exponent: 3, tip: 0.002}\n",
    .size = sizeof(OuttreeParams),
    .keys = OUTTREE_KEYS,
    .defaults = outtree_defaults,
    .check = check_outtree};
