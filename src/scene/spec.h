// The tables of scene files, one spec_*.c a subject.
#ifndef RAMIFY_SCENE_SPEC_H
#define RAMIFY_SCENE_SPEC_H

#include "config/table.h"

extern const Table scene_table; // the root

// Tables that another file's table uses.
extern const Table sky_table, light_table, material_table, medium_table, object_table,
    animation_table;
extern const Table radii_table, leaves_table, skin_table;                      // spec_tree.c
extern const Table shape_table, points_table, growth_table, guide_field_table; // spec_element.c

// The parameters of kinds.
extern const Table tree_table, coral_table, lsystem_table, vessels_table, forest_table,
    ground_table, frost_table, dla_table, lightning_table, sculpture_table, terrain_table,
    venation_table, fracture_table, skeleton_table;
extern const Table mesh_table, solid_table; // spec_drawn.c

// The rows of an element (trunk, crown, roots): envelope, voxel, points, growth, fields.
#define ELEMENT_ROWS(STRUCT)                                                                      \
    {KEY_OF(STRUCT, element.shapes, "envelope", KEY_LIST),                                        \
     .count_offset = offsetof(STRUCT, element.shape_count), .count = 1000, .table = &shape_table, \
     .doc = "The region to grow in: shapes joined, cut and intersected in this order. Left out: " \
            "a form of the kind's own, in proportion."},                                          \
        {KEY_OF(STRUCT, element.voxel, "voxel", KEY_FLOAT), .high = 100, .unit = "m",             \
         .doc = "Voxel size of the envelope's level set, where it is not one plain shape; 0 = "   \
                "1/128 of its largest extent."},                                                  \
        {KEY_OF(STRUCT, element, "points", KEY_GROUP), .table = &points_table,                    \
         .doc = "How attractors are scattered in the envelope."},                                 \
        {KEY_OF(STRUCT, element, "growth", KEY_GROUP), .table = &growth_table,                    \
         .doc = "How the element grows toward its attractors."},                                  \
    {                                                                                             \
        KEY_OF(STRUCT, element.fields, "fields", KEY_LIST),                                       \
            .count_offset = offsetof(STRUCT, element.field_count), .count = 100,                  \
            .table = &guide_field_table,                                                          \
            .doc = "Guide vector fields that steer the growth, summed with their weights."        \
    }

#endif
