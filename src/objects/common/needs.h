// Estimates of the memory that objects will take, from the counts in their parameters.
//
// The estimates are measured averages, meant to be right within a factor of NEEDS_FACTOR. They
// cover arrays during growth, the geometry and the ray tracer's structures.
#ifndef RAMIFY_OBJECTS_COMMON_NEEDS_H
#define RAMIFY_OBJECTS_COMMON_NEEDS_H

#define NEEDS_FACTOR 3.0

// Sum of the needs of several objects, added by Kind.needs.
typedef struct Needs {
    double bytes;         // sum
    double copied_faces;  // instanced faces that the ray tracer copies; see COPY_FACES_LIMIT
    int object;           // now adding
    int largest_object;   // of the largest single need; -1 = none
    double largest;       // bytes of it
    double largest_count; // items of it
    char largest_key[64];
} Needs;

// Adds count items of `each` bytes. key: the kind's key that sets the count, "leaves.max_count".
void needs_add(Needs *needs, const char *key, double count, double each);

// Adds count instances of a mesh with `faces` faces.
void needs_add_copies(Needs *needs, const char *key, double count, double faces);

// Adds count instances of `parts` large parts together.
void needs_add_groups(Needs *needs, const char *key, double count, int parts);

// Adds growth with so many attractors, drawn as curves.
void needs_add_growth(Needs *needs, const char *key, double attractors);

// The same with a skin of `levels` subdivisions over branches thicker than `twig` tip radii.
void needs_add_skinned_growth(Needs *needs, const char *key, double attractors, int levels,
                              double twig);

// Adds a skin of so many triangles.
void needs_add_skin(Needs *needs, const char *key, double triangles);

// Adds an imported file, at `each` bytes of memory per byte of the file. Adds nothing if the file
// cannot be examined; reading it reports the error.
void needs_add_file(Needs *needs, const char *key, const char *file, double each);

// Adds an imported mesh.
void needs_add_mesh_file(Needs *needs, const char *key, const char *file);

#endif
