// What objects will take in memory, told by the counts of their parameters before anything is made
// of them.
//
// Estimates are measured averages. They are meant to be right within a factor of NEEDS_FACTOR for
// what a count is made for: arrays while it grows, its geometry and what the ray tracer makes of
// it.
#ifndef RAMIFY_OBJECTS_COMMON_NEEDS_H
#define RAMIFY_OBJECTS_COMMON_NEEDS_H

#define NEEDS_FACTOR 3.0

// The needs of some objects, as kinds add them (Kind.needs).
typedef struct Needs {
    double bytes;        // of all
    double copied_faces; // that the ray tracer copies out so far; see COPY_FACES_LIMIT
    int object;          // that is adding
    int largest_object;  // of the largest single need; -1 = none
    double largest;      // bytes of it
    char largest_key[64];
} Needs;

// count things of `each` bytes. key: of the object's kind that says how many, "leaves.max_count".
void needs_add(Needs *needs, const char *key, double count, double each);

// count instances of a mesh of so many faces.
void needs_add_copies(Needs *needs, const char *key, double count, double faces);

// Growth to so many attractors, drawn as curves.
void needs_add_growth(Needs *needs, const char *key, double attractors);

// The same with a skin of so many levels over all that is thicker than `twig` radii of a tip.
void needs_add_skinned_growth(Needs *needs, const char *key, double attractors, int levels,
                              double twig);

// What an imported file makes, at `each` bytes of memory for a byte of the file. A file that cannot
// be looked at needs none; reading it will say why.
void needs_add_file(Needs *needs, const char *key, const char *file, double each);

// An imported mesh.
void needs_add_mesh_file(Needs *needs, const char *key, const char *file);

#endif
