#include "objects/common/leaves.h"

#include "base/random.h"

enum { STREAM_EMERGENCE = 20 }; // of a leaf

static float own(float value, float default_value)
{
    return value > 0.0f ? value : default_value;
}

// Needles and scales: numbers of their own.
static void give_needles(LeafParams *form, const LeavesParams *leaves, float piece)
{
    bool tuft = form->shape == LEAF_TUFT, scales = form->shape == LEAF_SCALES;
    form->bundle = leaves->bundle > 1 ? leaves->bundle : 1;
    if (tuft || scales) {
        form->needles = (int)own(leaves->needles, tuft ? 30.0f : 16.0f);
        form->shoot = own(leaves->shoot, tuft ? 0.005f : 3.0f * leaves->length);
        form->needle_angle = own(leaves->needle_angle, tuft ? 60.0f : 40.0f);
        return;
    }
    form->side_shoots = leaves->side_shoots;
    form->shoot = own(leaves->shoot, form->side_shoots > 0 ? 0.3f : piece);
    float count = own(leaves->needles, 16.0f) * 100.0f * form->shoot;
    const float most = 20000.0f;
    form->needles = (int)(count < most ? count : most);
    form->needles = form->needles > 1 ? form->needles : 1;
    form->needle_angle = own(leaves->needle_angle, form->bundle > 1 ? 38.0f : 55.0f);
}

LeafParams leaves_form(const LeavesParams *leaves, float piece)
{
    LeafParams form = {.length = leaves->length,
                       .width = leaves->width,
                       .petiole = leaves->petiole,
                       .nod = leaves->nod,
                       .fold = leaves->fold,
                       .curl = leaves->curl,
                       .wave = leaves->wave,
                       .lobes = leaves->lobes,
                       .lobe_depth = leaves->lobe_depth,
                       .detail = leaves->detail,
                       .shape = leaves->shape,
                       .widest = leaves->widest,
                       .tip = leaves->tip,
                       .sickle = leaves->sickle,
                       .teeth = leaves->teeth,
                       .tooth_depth = own(leaves->tooth_depth, 0.05f),
                       .double_teeth = leaves->double_teeth,
                       .wear = leaves->wear,
                       .compound = leaves->compound,
                       .leaflet_width = leaves->leaflet_width,
                       .taper = leaves->taper,
                       .comb = leaves->comb,
                       .flush = leaves->flush};
    // Young leaves are folded and straight.
    if (leaves->emergence < 1.0f) {
        float young = 1.0f - leaves->emergence;
        form.fold = clampf(form.fold + 62.0f * young, -90.0f, 84.0f);
        form.curl *= leaves->emergence;
    }
    if (form.shape == LEAF_PALMATE) {
        form.lobes |= 1; // with one in the middle
    }
    bool twice = form.compound == COMPOUND_BIPINNATE;
    int usual = twice ? 12 : form.compound == COMPOUND_PALMATE ? 5 : 9;
    form.leaflets = leaves->leaflets > 0 ? leaves->leaflets : usual;
    form.leaflets_of_part = leaves->leaflets_of_part > 0 ? leaves->leaflets_of_part : 20;
    if (form.shape == LEAF_NEEDLES || form.shape == LEAF_TUFT || form.shape == LEAF_SCALES) {
        give_needles(&form, leaves, piece);
    }
    return form;
}

int leaves_per_node(const LeavesParams *leaves)
{
    switch (leaves->arrangement) {
    case ARRANGE_OPPOSITE:
        return 2;
    case ARRANGE_WHORLED:
        return leaves->per_node > 0 ? leaves->per_node : 3;
    case ARRANGE_SPURS:
        return leaves->per_node > 0 ? leaves->per_node : 5;
    case ARRANGE_ROSETTE:
        return leaves->per_node > 0 ? leaves->per_node : 40;
    default:
        return 1;
    }
}

int leaves_at_node(const LeavesParams *leaves)
{
    bool skirted = leaves->arrangement == ARRANGE_ROSETTE;
    return leaves_per_node(leaves) + (skirted ? leaves->withered : 0);
}

float leaves_emergence(const LeavesParams *leaves, uint64_t key)
{
    const float spread = 0.25f;
    if (leaves->emergence >= 1.0f) {
        return 1.0f;
    }
    float ahead = random_unit(random_key(key, STREAM_EMERGENCE));
    return clampf(leaves->emergence * (1.0f + spread) - spread * ahead, 0.0f, 1.0f);
}
