#include "config/node_number.h"

#include <stdlib.h>

double node_number(const Node *map, const char *key)
{
    const char *text = node_get_text(map, key);
    return text ? strtod(text, NULL) : 0.0;
}

float node_component(const Node *list, int index)
{
    const Node *item = list ? list->first : NULL;
    while (item && index-- > 0) {
        item = item->next;
    }
    return item && item->text ? strtof(item->text, NULL) : 0.0f;
}

Vec3 node_vector(const Node *map, const char *key)
{
    const Node *list = node_get(map, key);
    return vec3(node_component(list, 0), node_component(list, 1), node_component(list, 2));
}
