// OpenVDB grids of envelopes, guide fields and clouds, written by grid_file.h.
#include "export/formats.h"

static bool write(const ExportSource *source, const char *file, const Run *run, Error *e)
{
    if (run_is_cancelled(run)) {
        return run_cancel_error(e);
    }
    return grid_file_write(source->grids, file, e);
}

const ExportFormat vdb_format = {".vdb", "envelopes, guide fields and clouds as OpenVDB grids", 0,
                                 EXPORT_GRIDS, write};
