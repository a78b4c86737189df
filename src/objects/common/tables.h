// Tables and checks shared by the tables of several kinds (see config/table.h).
#ifndef RAMIFY_OBJECTS_COMMON_TABLES_H
#define RAMIFY_OBJECTS_COMMON_TABLES_H

#include "config/load.h"
#include "objects/common/element.h"
#include "render/material/material.h"

// Of an element's envelope, points, growth and guide fields.
extern const Table shape_table, points_table, growth_table, guide_field_table;
extern const EnumName field_profiles[];
extern const Table color_stop_table; // of a scale of colours
extern const Table map_range_table;  // of a condition on a map of land (land/where.h)

// The rows of an element (trunk, crown, roots): envelope, voxel, points, growth, fields.
#define ELEMENT_ROWS(STRUCT)                                                                      \
    {KEY_OF(STRUCT, element.shapes, "envelope", KEY_LIST),                                        \
     .count_offset = offsetof(STRUCT, element.shape_count), .count = 1000, .table = &shape_table, \
     .doc = "Region to grow in: shapes, combined in this order. Default: a shape of the kind's "  \
            "own, in proportion."},                                                               \
        {KEY_OF(STRUCT, element.voxel, "voxel", KEY_FLOAT), .high = 100, .unit = "m",             \
         .doc = "Voxel size of the envelope's level set, unless it is a single plain shape; 0 = " \
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

// ---- parts of Table.check

// The list under `envelope`.
bool check_shapes(const Mapping *mapping, const char *key, const Shape *shapes, int count);

// Envelope, points and growth of a mapping with ELEMENT_ROWS.
bool check_element(const Mapping *mapping, const ElementParams *element);

// The same for a kind that has an L-system for the rule string; check_element refuses that rule.
bool check_string_element(const Mapping *mapping, const ElementParams *element);

// Checks a mesh file's name, size and header. path: from the mapping's key `file`.
bool check_mesh_file(const Mapping *mapping, const char *path);

// The scale of colours under `colors` ascends.
bool check_color_stops(const Mapping *mapping, const ColorStop *stops, int count);

// A least and a greatest value under a key are in this order.
bool check_range(const Mapping *mapping, const char *key, const float range[2]);

// No factor of the mapping's `scale` is 0.
bool check_scale(const Mapping *mapping, Vec3 scale);

// An L-system's axiom and rules; NULL = not given.
bool check_grammar(const Mapping *mapping, const char *axiom, const char *rules);

// ---- checks of the tables above: see Table.check

bool check_shape(const Mapping *mapping, void *shape); // also computes its transform
bool check_level(const Mapping *mapping, void *level);
bool check_growth(const Mapping *mapping, void *element); // also fills in what the levels omit
bool check_field(const Mapping *mapping, void *field);
bool check_nucleus(const Mapping *mapping, void *nucleus);

#endif
