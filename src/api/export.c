#include "api/handles.h"

#include "scene/export_scene.h"

bool ramify_export(const RamifyScene *scene, const char *file, const RamifyRun *run,
                   RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    return scene_export(scene_of(scene), file, &own, &e) || api_fail(error, &e);
}

bool ramify_export_check(const char *file, RamifyError *error)
{
    Error e = {0};
    return scene_export_check(file, &e) || api_fail(error, &e);
}

int ramify_export_format_count(void)
{
    return export_format_count();
}

const char *ramify_export_format_ending(int index)
{
    return export_format_at(index)->ending;
}

const char *ramify_export_format_doc(int index)
{
    return export_format_at(index)->doc;
}
