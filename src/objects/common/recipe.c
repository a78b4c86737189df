#include "objects/common/recipe.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

void grown_clear(Grown *grown)
{
    out_tree_free(grown->tree);
    if (grown->free_state) {
        grown->free_state(grown->state);
    }
    *grown = (Grown){0};
}

bool placing_add(const Placing *placing, Part part, int role, Error *e)
{
    if (!part.mesh && !part.curves) {
        part_clear(&part);
        return false;
    }
    part.kind = part.curves ? PART_CURVES : PART_MESH;
    part.material = placing->material[role];
    part.object = placing->object;
    return geometry_add(placing->geometry, part, e);
}

const char *recipe_name(const Recipe *recipe, const char *part, char name[RECIPE_NAME_SIZE])
{
    snprintf(name, RECIPE_NAME_SIZE, "%s%s%s", recipe->label, part ? ", " : "", part ? part : "");
    return name;
}

void recipe_warn(const Recipe *recipe, const char *part, const char *format, ...)
{
    char text[1024], name[RECIPE_NAME_SIZE];
    va_list values;
    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);
    run_warn(recipe->run, "%s: %s", recipe_name(recipe, part, name), text);
}

bool recipe_fail(const Recipe *recipe, const char *part, Error *e)
{
    char name[RECIPE_NAME_SIZE];
    error_prefix(e, "%s: ", recipe_name(recipe, part, name));
    return false;
}
