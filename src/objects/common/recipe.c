#include "objects/common/recipe.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

OutTree *recipe_recall(const Recipe *recipe, int index, Error *e)
{
    return out_tree_copy(recipe->memory->tree[index], e);
}

bool recipe_keep(const Recipe *recipe, int index, const OutTree *tree, Error *e)
{
    if (!recipe->memory) {
        return true;
    }
    out_tree_free(recipe->memory->tree[index]);
    recipe->memory->tree[index] = out_tree_copy(tree, e);
    return recipe->memory->tree[index];
}

bool recipe_keep_ids(const Recipe *recipe, const uint64_t *id, int64_t count, Error *e)
{
    if (!recipe->memory) {
        return true;
    }
    free(recipe->memory->id);
    recipe->memory->id = memory_alloc(count, sizeof *id, e);
    if (recipe->memory->id) {
        memcpy(recipe->memory->id, id, sizeof *id * (size_t)count);
    }
    return recipe->memory->id;
}

void recipe_memory_clear(RecipeMemory *memory)
{
    out_tree_free(memory->tree[0]);
    out_tree_free(memory->tree[1]);
    free(memory->id);
    *memory = (RecipeMemory){0};
}
