// The clear film of a cascade: a sheet between even strands, as far as neighbours run side by side
// on the rock.
#include "base/memory.h"
#include "objects/cascade/cascade.h"

#include <stdlib.h>

enum { COLUMNS = 160, ROWS = 400 }; // strands; steps of their ways

typedef struct Film {
    const CascadePlace *place; // ROWS of each column
    int count[COLUMNS];        // of a column's places
    float widest;              // m between neighbours that are one sheet
    Mesh *mesh;
} Film;

static bool is_sheet(const Film *film, int column, int row)
{
    bool sheet = true;
    for (int i = 0; i < 2; i++) {
        const CascadePlace *left = film->place + (int64_t)column * ROWS + row + i;
        const CascadePlace *right = left + ROWS;
        sheet = sheet && left->on_rock && right->on_rock &&
                vec3_distance(left->at, right->at) < film->widest;
    }
    return sheet;
}

static void add_faces(Film *film)
{
    Mesh *mesh = film->mesh;
    mesh->face_count = 0;
    for (int column = 0; column + 1 < COLUMNS; column++) {
        int rows = film->count[column] < film->count[column + 1] ? film->count[column]
                                                                 : film->count[column + 1];
        for (int row = 0; row + 1 < rows; row++) {
            if (is_sheet(film, column, row)) { // counter-clockwise from outside
                uint32_t *corner = mesh->index + 4 * mesh->face_count++;
                uint32_t v = (uint32_t)(column * ROWS + row);
                corner[0] = v;
                corner[1] = v + 1;
                corner[2] = v + 1 + ROWS;
                corner[3] = v + ROWS;
            }
        }
    }
}

static void follow(Film *film, CascadePlace *place, const CascadeParams *params,
                   const Recipe *recipe)
{
    CascadeParams even = *params;
    even.strands = COLUMNS;
    even.wander = 0.0f;
#pragma omp parallel for schedule(dynamic) num_threads(recipe->run->threads)
    for (int i = 0; i < COLUMNS; i++) {
        CascadePlace *own = place + (int64_t)i * ROWS;
        film->count[i] = cascade_way(&even, recipe->surface, recipe->seed, i, own, ROWS);
        for (int k = 0; k < ROWS; k++) {
            film->mesh->position[i * ROWS + k] =
                own[k < film->count[i] ? k : film->count[i] - 1].at;
        }
    }
}

Mesh *cascade_film(const CascadeParams *params, const Recipe *recipe, Error *e)
{
    CascadePlace *place = memory_alloc((int64_t)COLUMNS * ROWS, sizeof *place, e);
    Film film = {.place = place,
                 .widest = 3.0f * vec3_distance(params->from, params->to) / COLUMNS};
    film.mesh =
        place ? mesh_new(4, COLUMNS * ROWS, (COLUMNS - 1) * (ROWS - 1), MESH_NORMAL, e) : NULL;
    if (film.mesh) {
        follow(&film, place, params, recipe);
        add_faces(&film);
    }
    free(place);
    if (film.mesh && !mesh_compute_normals(film.mesh, e)) {
        mesh_free(film.mesh);
        return NULL;
    }
    return film.mesh;
}
