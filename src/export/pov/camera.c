// The camera by its vectors: position, the film's middle on the plane at distance 1, and the film's
// sides. With lens shift the middle is not straight ahead.
#include "export/pov/pov.h"

#include "render/camera.h"

// In double precision: POV-Ray warns of vectors that are not perpendicular to ten digits.
typedef struct Axis {
    double x, y, z;
} Axis;

static Axis axis_of(Vec3 v)
{
    return (Axis){(double)v.x, (double)v.y, (double)v.z};
}

static double axis_dot(Axis a, Axis b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static Axis axis_madd(Axis a, double s, Axis b)
{
    return (Axis){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static Axis axis_unit(Axis a)
{
    double scale = 1.0 / sqrt(axis_dot(a, a));
    return (Axis){a.x * scale, a.y * scale, a.z * scale};
}

static void write_axis(Pov *pov, const char *name, Axis a, double scale)
{
    file_writer_print(pov->out, "    %s <%.17g,%.17g,%.17g>\n", name, a.x * scale, a.y * scale,
                      a.z * scale);
}

// POV-Ray's lens reaches a quarter of its `aperture` to all sides.
static void write_lens(Pov *pov, const CameraFrame *frame, Axis middle)
{
    Vec3 ahead = vec3((float)middle.x, (float)middle.y, (float)middle.z);
    file_writer_text(pov->out, "    focal_point ");
    pov_point(pov, vec3_madd(frame->position, frame->focus, ahead));
    file_writer_print(pov->out, "\n    aperture %.9g blur_samples 64 confidence 0.95 variance 0\n",
                      (double)(2.0f * pov->world->camera.aperture * pov->unit));
}

void pov_camera(Pov *pov)
{
    const FilmParams *film = &pov->world->film;
    const Camera *camera = &pov->world->camera;
    CameraFrame frame = camera_frame(camera, film->width, film->height);
    Axis ahead = axis_unit(axis_of(frame.forward));
    Axis right = axis_of(frame.across);
    right = axis_unit(axis_madd(right, -axis_dot(right, ahead), ahead));
    Axis up = axis_of(vec3_neg(frame.down));
    up = axis_madd(up, -axis_dot(up, ahead), ahead);
    up = axis_unit(axis_madd(up, -axis_dot(up, right), right));
    double pixel = (double)frame.pixel_angle, height = pixel * film->height;
    Axis middle = axis_madd(ahead, height * (double)camera->shift_x, right);
    middle = axis_madd(middle, height * (double)camera->shift_y, up);
    file_writer_text(pov->out, "camera {\n    perspective\n    location ");
    pov_point(pov, frame.position);
    file_writer_text(pov->out, "\n");
    write_axis(pov, "direction", middle, 1.0);
    write_axis(pov, "right", right, pixel * film->width);
    write_axis(pov, "up", up, height);
    if (camera->aperture > 0.0f) {
        write_lens(pov, &frame, middle);
    }
    file_writer_text(pov->out, "}\n\n");
}
