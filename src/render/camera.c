#include "render/camera.h"

#include "render/warp.h"

CameraFrame camera_frame(const Camera *camera, int width, int height)
{
    CameraFrame frame = {.position = camera->position};
    Vec3 view = vec3_sub(camera->target, camera->position);
    frame.forward = vec3_normalize(view);
    Vec3 right = vec3_cross(frame.forward, camera->up);
    right = vec3_length(right) > 1e-6f * vec3_length(camera->up)
                ? vec3_normalize(right)
                : vec3_perpendicular(frame.forward); // looking along up
    Vec3 up = vec3_cross(right, frame.forward);
    float half = tanf(0.5f * camera->fov * RADIANS_PER_DEGREE);
    float pixel = 2.0f * half / (float)height;
    frame.across = vec3_scale(right, pixel);
    frame.down = vec3_scale(up, -pixel);
    float left = -half * (float)width / (float)height + 2.0f * half * camera->shift_x;
    float top = half + 2.0f * half * camera->shift_y;
    frame.corner = vec3_add(frame.forward, vec3_madd(vec3_scale(right, left), top, up));
    frame.lens_x = vec3_scale(right, 0.5f * camera->aperture);
    frame.lens_y = vec3_scale(up, 0.5f * camera->aperture);
    frame.focus = camera->focus_distance > 0.0f ? camera->focus_distance : vec3_length(view);
    frame.pixel_angle = pixel;
    return frame;
}

void camera_ray(const CameraFrame *frame, float x, float y, const float lens[2], Vec3 *origin,
                Vec3 *direction)
{
    Vec3 to_film = vec3_madd(vec3_madd(frame->corner, x, frame->across), y, frame->down);
    *origin = frame->position;
    if (vec3_dot(frame->lens_x, frame->lens_x) > 0.0f) {
        Vec2 disc = warp_disc(lens[0], lens[1]);
        Vec3 shift = vec3_madd(vec3_scale(frame->lens_x, disc.x), disc.y, frame->lens_y);
        *origin = vec3_add(*origin, shift);
        to_film = vec3_madd(vec3_scale(to_film, frame->focus), -1.0f, shift);
    }
    *direction = vec3_normalize(to_film);
}
