// Diffusion-limited aggregates.
#include "objects/common/tables.h"
#include "objects/dla/dla.h"

static const Key DLA_KEYS[] = {
    {KEY_OF(DlaModel, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Position of the first particle."},
    {KEY_OF(DlaModel, rotation, "rotation", KEY_VECTOR), .count = 3, .unit = "degrees",
     .doc = "Rotation about x, then y, then z; without it a planar cluster stands upright, facing "
            "+Z."},
    {KEY_OF(DlaModel, size, "size", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6, .unit = "m",
     .doc = "Largest extent of the whole cluster; it determines the size of particles."},
    {KEY_OF(DlaModel, dimension, "dimension", KEY_INT), .low = 2, .high = 3,
     .doc = "2: walkers and cluster in a plane; 3: in space."},
    {KEY_OF(DlaModel, particles, "particles", KEY_INT64), .low = 1, .high = 2147483647,
     .doc = "Number of particles of the whole cluster."},
    {KEY_OF(DlaModel, thickness, "thickness", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .unit = "particles", .doc = "Thickness of the tips."},
    {KEY_OF(DlaModel, exponent, "exponent", KEY_FLOAT), .low = 1, .high = 100,
     .doc = "Exponent e of the radii, r_parent^e = sum of r_child^e; a larger one gives a more "
            "even thickness."},
    {KEY_OF(DlaModel, swell, "swell", KEY_FLOAT), .high = 1e4, .unit = "particles",
     .doc = "How far a planar cluster bulges out of its plane."},
    {0},
};

static void dla_defaults(void *out)
{
    *(DlaModel *)out = dla_model_default();
}

const Table dla_table = {.name = "dla",
                         .doc = "A diffusion-limited aggregate, like electrodeposited metal; the "
                                "papers compare their method with it. Material: copper.",
                         .example = "objects:\n"
                                    "  - name: dendrite\n"
                                    "    dla: {size: 0.3, particles: 20000}\n",
                         .size = sizeof(DlaModel),
                         .keys = DLA_KEYS,
                         .defaults = dla_defaults};
