// The camera, by its vectors: position, the film's middle on the plane at distance 1, and the
// film's sides. Lens shift is a middle that is not straight ahead.
#include "export/pov.h"

#include "render/camera.h"

// POV-Ray's lens reaches a quarter of its `aperture` to all sides.
static void write_lens(Pov *pov, const CameraFrame *frame, Vec3 middle)
{
    file_writer_text(pov->out, "    focal_point ");
    pov_point(pov, vec3_madd(frame->position, frame->focus, middle));
    file_writer_print(pov->out, "\n    aperture %.9g blur_samples 64 confidence 0.95 variance 0\n",
                      (double)(2.0f * pov->world->camera.aperture * pov->unit));
}

void pov_camera(Pov *pov)
{
    const FilmParams *film = &pov->world->film;
    CameraFrame frame = camera_frame(&pov->world->camera, film->width, film->height);
    Vec3 right = vec3_scale(frame.across, (float)film->width);
    Vec3 down = vec3_scale(frame.down, (float)film->height);
    Vec3 middle = vec3_madd(vec3_madd(frame.corner, 0.5f, right), 0.5f, down);
    file_writer_text(pov->out, "camera {\n    perspective\n    location ");
    pov_point(pov, frame.position);
    file_writer_text(pov->out, "\n    direction ");
    pov_vector(pov, middle);
    file_writer_text(pov->out, "\n    right ");
    pov_vector(pov, right);
    file_writer_text(pov->out, "\n    up ");
    pov_vector(pov, vec3_neg(down));
    file_writer_text(pov->out, "\n");
    if (pov->world->camera.aperture > 0.0f) {
        write_lens(pov, &frame, middle);
    }
    file_writer_text(pov->out, "}\n\n");
}
