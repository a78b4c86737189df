// The camera: a thin lens with shift.
#ifndef RAMIFY_RENDER_CAMERA_H
#define RAMIFY_RENDER_CAMERA_H

#include "base/vec.h"

typedef struct Camera {
    Vec3 position, target, up;
    float fov;              // degrees, vertical
    float aperture;         // m, diameter of the lens; 0 = pinhole
    float focus_distance;   // m; 0 = the distance to target
    float shift_x, shift_y; // lens shift, in image heights: keeps verticals upright when looking up
} Camera;

typedef struct CameraFrame {
    Vec3 position, forward;
    Vec3 across, down;   // steps of one pixel on the plane at distance 1
    Vec3 corner;         // from position to the film's top left corner on that plane
    Vec3 lens_x, lens_y; // radius of the lens along the film's axes; 0 for a pinhole
    float focus;         // m, distance of the plane in focus along forward
    float pixel_angle;   // rad, of a pixel in the middle
} CameraFrame;

// Where things are seen from: detail follows their size on the screen, from the nearest of these.
typedef struct Views {
    const Vec3 *eye;   // borrowed
    int count;         // 0 = none: full detail
    float pixel_angle; // rad
    float detail;      // see RenderParams
} Views;

CameraFrame camera_frame(const Camera *camera, int width, int height);

// The ray through the film at (x, y) pixels from the top left corner and the lens at two uniform
// numbers; direction is unit.
void camera_ray(const CameraFrame *frame, float x, float y, const float lens[2], Vec3 *origin,
                Vec3 *direction);

#endif
