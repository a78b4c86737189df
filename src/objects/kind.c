#include "objects/kind.h"

#include "objects/kinds.h"

#define KIND_POINTER(NAME) &kind_##NAME,
static const Kind *const ALL[] = {KINDS(KIND_POINTER)};

const Kind *kind_at(int index)
{
    return index < (int)(sizeof ALL / sizeof ALL[0]) ? ALL[index] : NULL;
}

static bool cut(const Kind *kind, const void *params, const OutTree *whole, float grow_to,
                OutTree *tree, Error *e)
{
    return kind->tip_radius ? out_tree_rejuvenate(tree, grow_to, kind->tip_radius(params, whole), e)
                            : out_tree_keep_births(tree, grow_to, e);
}

// A node that is nowhere would keep what is built on it busy for ever.
static bool grow_whole(const Kind *kind, const void *params, const Recipe *recipe, Grown *whole,
                       Error *e)
{
    return kind->grow(params, recipe, whole, e) &&
           (out_tree_check(whole->tree, e) || recipe_fail(recipe, NULL, e));
}

bool kind_grow(const Kind *kind, const void *params, const Recipe *recipe, float grow_to,
               Grown *memory, Grown *grown, Error *e)
{
    Grown own = {0}, *whole = memory ? memory : &own;
    *grown = (Grown){0};
    if (!kind->grow) {
        return true;
    }
    if (!whole->tree && !grow_whole(kind, params, recipe, whole, e)) {
        grown_clear(whole);
        return false;
    }
    bool alone = !memory && grow_to >= 1.0f; // the whole growth is not kept
    grown->tree = alone ? whole->tree : out_tree_copy(whole->tree, e);
    bool done =
        grown->tree && cut(kind, params, whole->tree, grow_to, grown->tree, e) &&
        (!recipe->carrier || recipe->carrier->carry(recipe->carrier->user, grown->tree, e)) &&
        (!kind->finish || kind->finish(params, recipe, whole, grown, e));
    if (alone) {
        whole->tree = NULL;
    }
    grown_clear(&own);
    if (!done) {
        grown_clear(grown);
    }
    return done;
}
