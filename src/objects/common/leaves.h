// Leaves of several kinds of objects: their form, their places on the twigs, the season.
#ifndef RAMIFY_OBJECTS_COMMON_LEAVES_H
#define RAMIFY_OBJECTS_COMMON_LEAVES_H

#include "mesh/leaf/leaf.h"

#include <stdint.h>

// Where leaves stand on a twig.
typedef enum LeafArrangement {
    ARRANGE_SPIRAL,     // one a node, turned by the phyllotaxis
    ARRANGE_ALTERNATE,  // one a node, five in two turns
    ARRANGE_DISTICHOUS, // one a node, in two rows left and right
    ARRANGE_OPPOSITE,   // two a node, each pair across the last
    ARRANGE_WHORLED,    // several a node, each whorl between those of the last
    ARRANGE_SPURS,      // in clusters on short shoots along the twig
    ARRANGE_ROSETTE     // around the ends of twigs or trunks alone
} LeafArrangement;

typedef struct LeavesParams {
    // Number and place.
    int64_t max_count; // 0 = bare
    float spacing;     // m between nodes along a twig
    float twig_radius; // m: only branches thinner than this bear leaves
    LeafArrangement arrangement;
    int per_node;      // leaves of a whorl, a short shoot or a rosette; 0 = the arrangement's own
    int withered;      // dead leaves that hang below a rosette, in autumn_color
    float phyllotaxis; // degrees about the twig between successive nodes; 137.5 in nature
    float crowding;    // 0..1: how much closer the last five nodes of a twig are
    int tip_leaves;    // nodes at a twig's end whose leaves are smaller toward it; 0 = none
    int base_leaves;   // the same at the lower end of its leafy part, from a third of the size
    float foot;        // m of a twig's leafy part, from its lower end, that bear leaves; 0 = all
    float angle;       // degrees between a leaf and its twig; of a rosette that of its lowest
    float droop;       // 0..1, from the twig's frame to hanging and facing the light
    float hang;        // 0..1: how far blades hang straight down
    float plane;       // 0..1: how far leaves turn into the flat spray of their twig

    // Form: see LeafParams.
    LeafShape shape;
    float length, width;  // m
    float size_variation; // 0..1
    float petiole;        // m
    float nod;            // degrees from the stalk to the blade, downward
    float fold;           // degrees that the halves fold up about the midrib
    float curl;           // degrees that the blade bends along its length
    float wave;
    float widest, tip;
    float sickle; // degrees
    int lobes;    // oak: a side, 0 = a plain oval; palmate: of the leaf
    float lobe_depth;
    int teeth;
    float tooth_depth;
    bool double_teeth;
    float wear;
    LeafCompound compound;
    int leaflets, leaflets_of_part;
    float leaflet_width; // m
    float taper;
    float needles; // shape needles: per cm of shoot; tuft, scales: of each; 0 = the shape's own
    int bundle, side_shoots;
    float shoot;        // m; 0 = the shape's own
    float needle_angle; // degrees; 0 = the shape's own
    float comb;
    float flush;  // share of every shoot, at its tip, that grew this year
    int variants; // different leaf meshes
    int detail;   // of a leaf's mesh: 1 for whole trees, 2 for close-ups, 3 from centimetres

    // Season.
    float emergence; // 0..1: from closed buds to full-grown leaves
    float autumn;    // 0..1: share of the leaves that have turned
    float fall;      // 0..1: share of the leaves that are shed
    float litter;    // 0..1: share of the shed leaves that lie on the ground
} LeavesParams;

extern const struct Table leaves_table;

// Form of the leaf mesh, with the shape's own numbers in place of 0. piece: m, length of the twig
// that a piece with needles covers.
LeafParams leaves_form(const LeavesParams *leaves, float piece);

// Do leaves cover their twig piece by piece, as needles do?
static inline bool leaves_are_pieces(const LeavesParams *leaves)
{
    return leaves->shape == LEAF_NEEDLES && leaves->side_shoots == 0;
}

// Living leaves of a node.
int leaves_per_node(const LeavesParams *leaves);

// All of a node: of a rosette the withered ones come after the living.
int leaves_at_node(const LeavesParams *leaves);

// How far the leaf with this key has grown, 0..1: some are ahead of others.
float leaves_emergence(const LeavesParams *leaves, uint64_t key);

#endif
