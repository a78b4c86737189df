#include "render/accel/accel_internal.h"

#include <string.h>

static RTCGeometry single_mesh(const AccelPiece *piece)
{
    const Mesh *mesh = piece->mesh;
    bool joined = piece->pairs.count > 0, quads = joined || mesh->face_size == 4;
    RTCGeometry geometry = rtcNewGeometry(piece->accel->device, quads ? RTC_GEOMETRY_TYPE_QUAD
                                                                      : RTC_GEOMETRY_TYPE_TRIANGLE);
    Vec3 *position = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(Vec3), (size_t)mesh->vertex_count);
    rtcSetSharedGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, quads ? RTC_FORMAT_UINT4 : RTC_FORMAT_UINT3,
        joined ? piece->pairs.corner : mesh->index, 0, (size_t)(quads ? 4 : 3) * 4,
        (size_t)(joined ? piece->pairs.count : mesh->face_count));
    if (position) {
        const Vec3 *drawn = piece->diced.mesh ? piece->diced.displaced : mesh->position;
        memcpy(position, drawn, (size_t)mesh->vertex_count * sizeof(Vec3));
    }
    return geometry;
}

static RTCGeometry copied_mesh(const AccelPiece *piece)
{
    const Mesh *mesh = piece->mesh;
    bool quads = mesh->face_size == 4;
    int64_t vertices = mesh->vertex_count, corners = mesh->face_count * mesh->face_size;
    RTCGeometry geometry = rtcNewGeometry(piece->accel->device, quads ? RTC_GEOMETRY_TYPE_QUAD
                                                                      : RTC_GEOMETRY_TYPE_TRIANGLE);
    Vec3 *position = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(Vec3), (size_t)(vertices * piece->count));
    uint32_t *index = rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, quads ? RTC_FORMAT_UINT4 : RTC_FORMAT_UINT3,
        (size_t)mesh->face_size * 4, (size_t)(mesh->face_count * piece->count));
    for (int64_t k = 0; k < piece->count && position && index; k++) {
        const Transform *t = &piece->part->instance[accel_instance(piece, k)];
        for (int64_t i = 0; i < vertices; i++) {
            *position++ = transform_point(t, mesh->position[i]);
        }
        for (int64_t i = 0; i < corners; i++) {
            *index++ = mesh->index[i] + (uint32_t)(k * vertices);
        }
    }
    return geometry;
}

static RTCGeometry round_curves(AccelPiece *piece)
{
    const CurveSet *curves = piece->part->curves;
    RTCGeometry geometry =
        rtcNewGeometry(piece->accel->device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    size_t points = (size_t)curves->point_count;
    size_t segments = points - (size_t)curves->curve_count;
    float *vertex =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, points);
    uint32_t *index =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, 4, segments);
    uint8_t *flags =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_FLAGS, 0, RTC_FORMAT_UCHAR, 1, segments);
    piece->segment = index;
    if (!vertex || !index || !flags) {
        return geometry;
    }
    for (size_t i = 0; i < points; i++) {
        Vec3 p = curves->position[i];
        memcpy(vertex + 4 * i, (float[4]){p.x, p.y, p.z, curves->radius[i]}, 16);
    }
    for (int64_t k = 0; k < curves->curve_count; k++) {
        int64_t first = curves->first[k], last = curves->first[k + 1] - 1;
        for (int64_t i = first; i < last; i++) {
            *index++ = (uint32_t)i;
            *flags++ = (uint8_t)((i > first ? RTC_CURVE_FLAG_NEIGHBOR_LEFT : 0) |
                                 (i + 1 < last ? RTC_CURVE_FLAG_NEIGHBOR_RIGHT : 0));
        }
    }
    return geometry;
}

RTCGeometry accel_piece_geometry(AccelPiece *piece)
{
    return !piece->mesh    ? round_curves(piece)
           : piece->copied ? copied_mesh(piece)
                           : single_mesh(piece);
}

RTCGeometry accel_light_geometry(const Accel *accel, const Light *light)
{
    bool quad = light->kind == LIGHT_QUAD;
    RTCGeometry geometry = rtcNewGeometry(accel->device, quad ? RTC_GEOMETRY_TYPE_QUAD
                                                              : RTC_GEOMETRY_TYPE_SPHERE_POINT);
    if (quad) {
        Vec3 far = vec3_add(light->corner, vec3_add(light->edge_u, light->edge_v));
        Vec3 corner[4] = {light->corner, vec3_add(light->corner, light->edge_u), far,
                          vec3_add(light->corner, light->edge_v)};
        void *vertex = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                               RTC_FORMAT_FLOAT3, sizeof(Vec3), 4);
        void *index =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 16, 1);
        if (vertex && index) {
            memcpy(vertex, corner, sizeof corner);
            memcpy(index, (uint32_t[4]){0, 1, 2, 3}, 16);
        }
    } else {
        void *vertex =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, 1);
        if (vertex) {
            Vec3 c = light->center;
            memcpy(vertex, (float[4]){c.x, c.y, c.z, light->radius}, 16);
        }
    }
    return geometry;
}
