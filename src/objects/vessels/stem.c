#include "objects/vessels/stem.h"
#include "base/random.h"

// The hilum: the surface point nearest to the surface's centroid, such as the hollow of a kidney or
// the flat side of a liver.
static Vec3 find_hilum(const Mesh *surface, Vec3 *middle)
{
    double sum[4] = {0, 0, 0, 0};
    for (int64_t f = 0; f < surface->face_count; f++) {
        const uint32_t *corner = surface->index + f * surface->face_size;
        Vec3 a = surface->position[corner[0]], b = surface->position[corner[1]],
             c = surface->position[corner[2]];
        double area = (double)vec3_length(vec3_cross(vec3_sub(b, a), vec3_sub(c, a)));
        Vec3 center = vec3_scale(vec3_add(vec3_add(a, b), c), 1.0f / 3.0f);
        sum[0] += area * (double)center.x;
        sum[1] += area * (double)center.y;
        sum[2] += area * (double)center.z;
        sum[3] += area;
    }
    *middle = vec3((float)(sum[0] / sum[3]), (float)(sum[1] / sum[3]), (float)(sum[2] / sum[3]));
    Vec3 best = surface->position[surface->index[0]];
    for (int64_t v = 0; v < surface->face_count * surface->face_size; v++) {
        Vec3 p = surface->position[surface->index[v]];
        best = vec3_distance(p, *middle) < vec3_distance(best, *middle) ? p : best;
    }
    return best;
}

bool vessels_plant_stem(OutTree *tree, const VesselsParams *params, const Envelope *envelope,
                        int32_t colony, float root_radius, float reach, uint64_t seed, Error *e)
{
    enum { PIECES = 16 };
    Vec3 middle, inlet = find_hilum(envelope_surface(envelope), &middle);
    if (params->inlet.x != 0.0f || params->inlet.y != 0.0f || params->inlet.z != 0.0f) {
        inlet = params->inlet;
    }
    Vec3 inward = vec3_normalize(vec3_sub(middle, inlet));
    if (!(vec3_dot(inward, inward) > 0.0f)) {
        inward = vec3(0, 1, 0);
    }
    // The artery above, the vein below, slightly apart.
    Vec3 up = vec3_madd(vec3(0, 1, 0), -inward.y, inward);
    up = vec3_dot(up, up) > 1e-4f ? vec3_normalize(up) : vec3_perpendicular(inward);
    float aside = params->veins ? 0.7f * root_radius * (1.0f + params->vein_radius) : 0.0f;
    Vec3 entry = vec3_madd(inlet, colony == VESSELS_ARTERIES ? aside : -aside, up);
    float outside = 0.45f * reach, depth = vec3_distance(inlet, middle);
    depth = depth < 0.22f * reach ? depth : 0.22f * reach;
    uint64_t id = random_key(seed, (uint64_t)colony);
    int64_t parent = -1;
    for (int i = 0; i <= PIECES; i++) {
        float along = -outside + (outside + depth) * (float)i / PIECES;
        parent = out_tree_add_node(tree, vec3_madd(entry, along, inward), parent, 0, colony, id, e);
        if (parent < 0) {
            return false;
        }
        id = out_tree_child_id(id, 0);
    }
    return true;
}
