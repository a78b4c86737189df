// The uneven girth of wood: what makes a limb other than a hose. Limbs swell where others leave
// them or were shed, strands of wood run down from there, and the section between is not round.
#ifndef RAMIFY_SKIN_GIRTH_H
#define RAMIFY_SKIN_GIRTH_H

#include "skin/plan.h"

// Sets the girths of a chain that has its axis, from its children's nodes and its first node's id,
// and adds what is the same all around to the radii. Does nothing unless the plan's parameters ask
// for it.
bool skin_girth_make(SkinPlan *plan, int32_t chain, Error *e);

// The girth at an arc length from the axis' start; a round one if the plan has none.
SkinGirth skin_girth_at(const SkinPlan *plan, int32_t chain, float along);

// The same, of angles that are counted from `turn` radians on.
SkinGirth skin_girth_turned(SkinGirth girth, float turn);

// Leaves out orders above the given one, as those that a ring of few sides would show as others.
void skin_girth_limit(SkinGirth *girth, int order);

// Distance from the axis to the surface over the radius, at an angle with this cosine and sine to
// the axis' side.
float skin_girth_reach(const SkinGirth *girth, float cosine, float sine);

// The same, toward a direction (m or unit) from a point of the axis.
float skin_girth_toward(const SkinPlan *plan, int32_t chain, const SkinPoint *at, Vec3 direction);

#endif
