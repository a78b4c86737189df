// Shared by the files of the GLB writer: plan.c lays out the buffer, glb.c writes the bytes, json.c
// and nodes.c describe them, material.c and image.c write materials and pictures.
#ifndef RAMIFY_EXPORT_GLTF_GLB_H
#define RAMIFY_EXPORT_GLTF_GLB_H

#include "base/json.h"
#include "export/pieces.h"
#include "render/sky/sun_sky.h"
#include "render/world.h"

#include <stdio.h>

typedef enum GlbPlacing {
    GLB_ONCE,  // no instances
    GLB_NODES, // a node each
    GLB_PAIRS, // two nodes each, one turned within the other: together they shear
    GLB_GPU,   // EXT_mesh_gpu_instancing
    GLB_FLAT   // written out
} GlbPlacing;

// One part of the geometry as a mesh with one primitive. Its vertices are interleaved.
typedef struct GlbPart {
    int64_t index; // of the geometry's part
    GlbPlacing placing;
    bool refused; // written out because nodes cannot express its instances
    int64_t vertices, triangles;
    bool normal, uv, radius, birth;
    bool color, growth; // COLOR_0; COLOR_1, or COLOR_0 where there is no color
    bool glow;          // TEXCOORD_1: places on the ramp of glows
    Aabb bounds;        // of the vertices as written: of one instance unless flat
    int stride;         // bytes a vertex
    int64_t vertex_at, index_at, instance_at; // bytes into the buffer
} GlbPart;

// A picture of the file.
typedef struct GlbImage {
    const char *color, *alpha; // the files it comes from; borrowed; NULL or "" = none
    const Material *ramp;      // borrowed: the material whose ramp it is, or NULL
    unsigned char *bytes;      // owned
    int64_t size, at;
    bool jpeg; // otherwise PNG
} GlbImage;

typedef struct Glb {
    const ExportSource *source;
    const Run *run;
    GlbPart *part; // owned
    int64_t part_count;
    int *material; // owned; for each of the world's: its number in the file, -1 = unused
    int material_count;
    float *strongest; // owned; for each of the world's: the largest glow if it varies, else 0
    GlbImage *image;  // owned
    int64_t image_count, image_capacity;
    int64_t buffer_size; // bytes
    Sun sun;             // or moon; radiance 0 = none
} Glb;

// Fills all other members; source and run are set. Warns of what readers may not support.
bool glb_plan(Glb *glb, Error *e);

// Sets ERROR_INPUT for a file of that many bytes.
bool glb_too_large(Error *e, double bytes);

// Numbers the materials that parts use and reads their pictures.
bool glb_gather_materials(Glb *glb, Error *e);

bool glb_has_image(const Material *material);

// Reads the picture of a material unless it was read; glb_image_number finds it: -1 = none.
bool glb_add_image(Glb *glb, const Material *material, Error *e);
int64_t glb_image_number(const Glb *glb, const Material *material);

// Varying glow of curves has no counterpart in glTF: a picture of 256 shades of the material's
// light, from none to the strongest, is the emissive texture and TEXCOORD_1 looks it up.
bool glb_add_ramp(Glb *glb, const Material *material, Error *e);
int64_t glb_ramp_number(const Glb *glb, const Material *material); // -1 = none
float glb_ramp_place(float share); // of the strongest glow, 0..1: u on the ramp

// Textures, images and their samplers, with a comma before.
void glb_put_images(const Glb *glb, FILE *json);

// "materials": [...], and textures, images and a sampler where there are any; each with a comma
// before it.
void glb_put_materials(const Glb *glb, FILE *json);

// Counts per part: buffer views (vertices, triangles, tables of instances), accessors (for
// vertices, triangles, instances), instances.
int64_t glb_part_views(const GlbPart *part);
int64_t glb_part_accessors(const GlbPart *part);
int64_t glb_instance_count(const Glb *glb, const GlbPart *part);

void glb_put_part_name(const Glb *glb, const GlbPart *part, FILE *json); // "name":"..."

// Nodes and scene; the camera; lights, where glb_light_count is not 0. Each with a comma before it.
void glb_put_nodes(const Glb *glb, FILE *json);
void glb_put_camera(const Glb *glb, FILE *json);
void glb_put_lights(const Glb *glb, FILE *json);
int glb_light_count(const Glb *glb);

// The names of the material extensions that are used, each quoted with a comma behind it.
void glb_put_material_extensions(const Glb *glb, FILE *json);

// All of the JSON as heap text that the caller frees.
char *glb_json(const Glb *glb, size_t *size, Error *e);

// Writes pieces of JSON. Numbers are the shortest that read back to the same.
void json_put_float(FILE *json, float value);
void json_put_floats(FILE *json, const char *key, const float *value, int count); // "key":[...]
void json_put_color(FILE *json, const char *key, Vec3 value);

#endif
